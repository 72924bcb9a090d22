/* neglects.c -- what effects that the deck has turned off would have changed, by Rayleigh's shares at records.
 *
 * lambda = |sum q.d|/sum q.Kq and w^2 = sum v.v/sum q.q over the records so far, T the time since the start: a share lambda
 * of the stiffness has changed what bends by min(2, lambda max(1, w T/2)); a damper of the rate mu by 1 - exp(-mu T/2)
 * of what swings, sqrt(sum v.Mv/sum q.Kq) of it.  Bodies in loops are forced by these, where it is 4 times too much, and
 * other effects have no such estimate: for them, and where it comes near the tolerance, a second run with the effect says
 * (study/left_out.c; make watched shows both). */
#include <math.h>

#include "la/rot.h"
#include "la/vec3.h"
#include "sim/parts.h"

void neglects_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    struct neglects *o = &sim->neglects;
    if (!m->off) return;
    o->of = TAKE(life, struct neglect, m->nbody);
    for (int i = 1; i < m->nbody; i++) {
        struct neglected *of = m->body[i].component < 0 ? neglected_open(&m->body[i], life) : NULL;
        if (!of) continue;
        const int n = m->body[i].nmode;
        o->of[o->n++] = (struct neglect){.body = i,
                                         .of = of,
                                         .q = TAKE(life, double, n),
                                         .q1 = TAKE(life, double, n),
                                         .a = TAKE(life, double, n),
                                         .t_stiffening = -1,
                                         .t_damping = -1};
    }
}

/* What its node's small bodies pass on. */
static void add_loads(const struct sim *sim, struct neglect *o, const struct pose *pose)
{
    const struct model *m = sim->model;
    for (int i = o->body + 1; i < m->nbody; i++) {
        double f[3], n[3], fb[3], nb[3];
        if (!m->body[i].at_node || m->body[i].parent != o->body) continue;
        system_reaction(sim->system, f, n, m->body[i].joint);
        v3_scale(f, -1, f);
        v3_scale(n, -1, n);
        m3_tmul(fb, pose->R, f);
        m3_tmul(nb, pose->R, n);
        neglected_load(o->of, m->body[i].node, fb, nb, o->q);
    }
}

static void look(struct sim *sim, struct neglect *o)
{
    const struct model_body *b = &sim->model->body[o->body];
    const double *rates = system_rates(sim->system), *accel = system_accelerations(sim->system);
    struct pose pose;
    double g[3], a[3], w[3], al[3];
    system_pose(sim->system, &pose, o->body);
    v3_diff(g, pose.a, sim->model->gravity);
    m3_tmul(a, pose.R, g);
    m3_tmul(w, pose.R, pose.w);
    m3_tmul(al, pose.R, pose.al);
    for (int k = 0; k < b->nmode; k++) {
        o->q[k] = sim->x.q[b->mode_q[k]];
        o->q1[k] = rates[b->mode_v[k]];
        o->a[k] = accel[b->mode_v[k]];
        o->q2 += o->q[k] * o->q[k];
        o->v2 += o->q1[k] * o->q1[k];
    }
    const struct neglected_motion x = {a, w, al, o->q, o->q1, o->a};
    neglected_inertia(o->of, &x);
    if (neglected_stiffens(o->of)) add_loads(sim, o, &pose);
    neglected_sum(&o->sum, o->of, o->q, o->q1);
}

static void pass(double *most, double *t, double share, const struct sim *sim)
{
    const double tolerance = sim->scene->effects.tolerance;
    if (!(share > *most)) return;
    *most = share;
    if (tolerance > 0 && share > tolerance && *t < 0) *t = sim->x.t;
}

static double since_start(const struct sim *sim)
{
    return sim->x.t - sim->model->t0;
}

static double stiffening_share(const struct sim *sim, const struct neglect *o)
{
    const double lambda = o->sum.stiff > 0 ? fabs(o->sum.work) / o->sum.stiff : 0;
    const double omega = o->q2 > 0 ? sqrt(o->v2 / o->q2) : 0;
    return fmin(2, lambda * fmax(1, omega * since_start(sim) / 2));
}

/* Of what swings, beside what stands: as its energies are. */
static double damping_share(const struct sim *sim, const struct neglect *o)
{
    const double mu = o->sum.inertia > 0 ? o->sum.power / o->sum.inertia : 0;
    const double swings = o->sum.stiff > 0 ? sqrt(fmin(1, o->sum.inertia / o->sum.stiff)) : 0;
    return swings * (1 - exp(-mu * since_start(sim) / 2));
}

void neglects_note(struct sim *sim)
{
    struct neglects *o = &sim->neglects;
    if (o->n == 0) return;
    if (record_evaluate(sim, EVALUATE_REACTION) != OK) return;
    for (int i = 0; i < o->n; i++) {
        struct neglect *k = &o->of[i];
        look(sim, k);
        if (neglected_stiffens(k->of)) pass(&k->stiffening, &k->t_stiffening, stiffening_share(sim, k), sim);
        if (neglected_damps(k->of)) pass(&k->damping, &k->t_damping, damping_share(sim, k), sim);
    }
}

void neglects_recall(struct sim *sim, struct recall *r)
{
    struct neglects *o = &sim->neglects;
    recall_within(r, "neglects");
    recall_each(r, "work", o->of, sum.work, o->n);
    recall_each(r, "stiff", o->of, sum.stiff, o->n);
    recall_each(r, "power", o->of, sum.power, o->n);
    recall_each(r, "inertia", o->of, sum.inertia, o->n);
    recall_each(r, "v2", o->of, v2, o->n);
    recall_each(r, "q2", o->of, q2, o->n);
    recall_each(r, "stiffening", o->of, stiffening, o->n);
    recall_each(r, "damping", o->of, damping, o->n);
    recall_each(r, "t_stiffening", o->of, t_stiffening, o->n);
    recall_each(r, "t_damping", o->of, t_damping, o->n);
    recall_without(r);
}

/* ---- told ---- */

static const struct neglect *worst(const struct neglects *o, bool damping)
{
    const struct neglect *most = NULL;
    for (int i = 0; i < o->n; i++) {
        const struct neglect *k = &o->of[i];
        if (!(damping ? neglected_damps : neglected_stiffens)(k->of)) continue;
        if (!most || (damping ? k->damping > most->damping : k->stiffening > most->stiffening)) most = k;
    }
    return most;
}

/* What is known of an effect: of a column by a second run, or of how a body bends. */
struct said {
    const char *body, *column;
    double share, t, until;
    const struct neglect_found *found; /* NULL: of a body */
};

static bool watched(struct said *o, const struct sim *sim, enum effect_id id)
{
    const bool damping = id == EFFECT_DAMPING;
    const struct neglect_found *found = &sim->neglects.found[id];
    if (found->known) {
        *o = (struct said){NULL, found->column, found->share, found->t, found->until, found};
        return true;
    }
    const struct neglect *k = damping || id == EFFECT_STIFFENING ? worst(&sim->neglects, damping) : NULL;
    if (!k) return false;
    *o = (struct said){sim->model->body[k->body].name,           NULL,     damping ? k->damping : k->stiffening,
                       damping ? k->t_damping : k->t_stiffening, sim->x.t, NULL};
    return true;
}

/* Bodies in loops have no watch. */
static bool watched_everywhere(const struct sim *sim, bool damping)
{
    const struct model *m = sim->model;
    for (int i = 1; i < m->nbody; i++) {
        const struct flex_body *full = m->body[i].full;
        if (m->body[i].component < 0 || !full) continue;
        if (damping ? full->D && !m->body[i].flex->D : full->s && !m->body[i].flex->s) return false;
    }
    return true;
}

bool neglects_unsettled(const struct sim *sim, enum effect_id id)
{
    static const double NEAR = 1. / 3; /* of the tolerance: the watch is right within 3 */
    const double tolerance = sim->scene->effects.tolerance;
    struct said said;
    if (!(sim->model->off & effect_bit(id))) return false;
    if (id == EFFECT_GYROSCOPIC && sim_in_plane(sim)) return false;
    if (!watched(&said, sim, id) || !watched_everywhere(sim, id == EFFECT_DAMPING)) return true;
    return said.share > NEAR * (tolerance > 0 ? tolerance : EFFECTS_TOLERANCE);
}

int neglects_facts(const struct sim *sim, struct pair *facts)
{
    static const char *const names[EFFECTS] = {
#define X(id, name, ...) "neglected_" name,
        EFFECT_ROWS(X)
#undef X
    };
    struct said said;
    int n = 0;
    for (int i = 0; i < EFFECTS; i++)
        if (watched(&said, sim, (enum effect_id)i)) facts[n++] = pair_number(names[i], said.share);
    return n;
}

static void print_found(const struct neglect_found *o, const struct sim *sim, FILE *to)
{
    fprintf(to, ": about %.2g %% of '%s'", 100 * o->share, o->column);
    if (o->acting && o->acting != o->column) fprintf(to, ", %.2g %% of '%s'", 100 * o->acts, o->acting);
    fputs(", by a second run with it", to);
    if (o->until < sim->x.t) fprintf(to, ", to t = %.4g s: longer is not watched", o->until);
    if (o->share <= o->noise) fputs("; the runs' own errors may be as much", to);
}

static void print_watched(const struct sim *sim, enum effect_id id, FILE *to)
{
    struct said o;
    if (watched(&o, sim, id)) {
        fprintf(to, "left out: %s", effect_kinds[id].name);
        if (o.body) fprintf(to, " of '%s': about %.2g %% of how it bends", o.body, 100 * o.share);
        if (o.found) print_found(o.found, sim, to);
        fputc('\n', to);
    } else if (sim->model->off & effect_bit(id)) {
        fprintf(to, "left out: %s: what it would change has not been watched\n", effect_kinds[id].name);
    }
}

void print_neglects(const struct sim *sim, FILE *to)
{
    for (int i = 0; i < EFFECTS; i++) print_watched(sim, (enum effect_id)i, to);
}

static void warn_of(struct sim *sim, enum effect_id id)
{
    struct said o;
    char what[100];
    const double tolerance = sim->scene->effects.tolerance;
    if (!(tolerance > 0) || !watched(&o, sim, id) || !(o.share > tolerance)) return;
    if (o.found && o.share <= o.found->noise) return;
    snprintf(what, sizeof what, o.body ? "how '%.60s' bends" : "'%.60s'", o.body ? o.body : o.column);
    sim_warn(
        sim,
        "%s, turned off by the deck, would change %s by about %.2g %%; the tolerance of 'effects', %g, is passed at t "
        "= %.6g s: turn it on, or give a larger tolerance [W-effect]",
        effect_kinds[id].name, what, 100 * o.share, tolerance, o.t);
}

void warn_of_neglects(struct sim *sim)
{
    for (int i = 0; i < EFFECTS; i++) warn_of(sim, (enum effect_id)i);
}
