/* explain_deck.c -- fmdsub explain DECK: which effects its scene has, what decided, what each costs and changes.
 *
 * The deck is run as it is and, for every effect that may be turned, once more with that one turned the other way: what it
 * costs and changes is what these two runs say, their counts at the instructions of study/price_table.h.  Long runs are cut to a
 * second's worth. */
#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "base/text.h"
#include "cli/chosen.h"
#include "cli/cli.h"
#include "out/facts.h"
#include "study/auto.h"
#include "study/flip.h"

static const double SECOND = 1; /* of CPU by price, a run */

enum told_state { STATE_ON, STATE_OFF, STATE_WATCHED, STATE_ABSENT }; /* watched: off, and told by run */
static const char *const states[] = {"on", "off", "watched", "absent"};

struct told {
    enum told_state state;
    const char *by;
    char number[160];
    bool flipped; /* and so: */
    double cost;  /* of a run with it turned the other way, less that as it is, over that */
    double change;
    const char *column;
    const char *why; /* it cannot be turned */
};

/* ---- what the scene has ---------------------------------------------------------------------------------------- */

static int flexible_bodies(const struct model *m)
{
    int n = 0;
    for (int i = 1; i < m->nbody; i++) n += m->body[i].flex != NULL;
    return n;
}

/* The least first frequency of flexible bodies held at their inboard joints [rad/s]; 0: not known. */
static double lowest(const struct model *m)
{
    double w = INFINITY;
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].flex && m->body[i].flex->hertz) w = fmin(w, 2 * acos(-1) * m->body[i].flex->hertz[0]);
    return isfinite(w) ? w : 0;
}

static void tell_plane(struct told *o, const struct sim *sim)
{
    if (sim->model->space == 2) {
        o->state = STATE_ABSENT;
        snprintf(o->number, sizeof o->number, "the deck is planar");
        return;
    }
    o->state = sim_in_plane(sim) ? STATE_OFF : STATE_ON;
    if (sim->flat)
        snprintf(o->number, sizeof o->number, "0: every joint keeps its bodies in planes of one normal");
    else if (sim->spatial.name)
        snprintf(o->number, sizeof o->number, "'%.60s' %s", sim->spatial.name, sim->spatial.why);
}

static void tell_gravity(struct told *o, const struct sim *sim)
{
    const double *g = sim->scene->gravity;
    const double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    snprintf(o->number, sizeof o->number, "|g| = %.4g m/s2", size);
    if (size == 0) o->state = STATE_ABSENT;
}

static void tell_gyroscopic(struct told *o, const struct sim *sim)
{
    int n = 0;
    for (int i = 1; i < sim->model->nbody; i++) n += !sim->model->body[i].flex && !sim->model->body[i].at_node;
    snprintf(o->number, sizeof o->number, "%d rigid bod%s in space", n, n == 1 ? "y" : "ies");
    if (sim->model->space == 3 && !sim_in_plane(sim) && n > 0) return;
    o->state = STATE_ABSENT;
    snprintf(o->number, sizeof o->number, "0 in the plane");
}

static void tell_stiffening(struct told *o, const struct flip *run)
{
    const double w = lowest(run->sim.model);
    if (w > 0)
        snprintf(o->number, sizeof o->number, "(Omega/w1)^2 = %.3g, Omega = %.4g rad/s, w1 = %.4g rad/s",
                 (run->spin / w) * (run->spin / w), run->spin, w);
}

/* The most of any beam: [0] rotary inertia, [1] shear, see struct scene_body. */
static double stoutest(const struct scene *scene, int k)
{
    double most = 0;
    for (int i = 1; i < scene->nbody; i++) most = fmax(most, scene->body[i].stout[k]);
    return most;
}

/* 4.65 I/(A l^2) of the stoutest, of bodies from files by their tensors; l to the node farthest from the reference. */
static void tell_rotary(struct told *o, const struct sim *sim)
{
    const struct scene *scene = sim->scene;
    double most = 4.65 * stoutest(scene, 0);
    for (int i = 1; i < scene->nbody; i++) {
        const struct flex_body *f = scene->body[i].flex;
        double l2 = 0, rot = 0;
        if (!f || scene->body[i].stout[0] > 0) continue;
        for (int k = 0; k < f->nnode; k++) {
            const double *x = f->node[k].x, *x0 = f->node[f->reference].x;
            l2 = fmax(l2, pow(x[0] - x0[0], 2) + pow(x[1] - x0[1], 2) + pow(x[2] - x0[2], 2));
        }
        for (int k = 0; k < 9; k += 4) rot = fmax(rot, f->rot[k]);
        if (l2 > 0 && f->mass > 0) most = fmax(most, 4.65 * rot / (f->mass * l2));
    }
    if (most > 0) snprintf(o->number, sizeof o->number, "4.65 I/(A l^2) up to %.3g", most);
}

/* Turned on, it is in all beams whose own key says nothing. */
static void tell_shear(struct told *o, const struct scene *scene)
{
    const double x = stoutest(scene, 1);
    const bool any = scene->in_beams & effect_bit(EFFECT_SHEAR);
    if (!any) o->state = STATE_OFF;
    if (x > 0)
        snprintf(o->number, sizeof o->number, "3 E I/(kappa G A l^2) up to %.3g%s", 3 * x,
                 any ? "" : "; no section gives ky or kz, no beam 'shear: true'");
    else
        snprintf(o->number, sizeof o->number, "%s",
                 any ? "of sections that are not known here" : "no section gives ky or kz, no beam 'shear: true'");
}

static void tell_damping(struct told *o, const struct sim *sim)
{
    const struct model *m = sim->model;
    double zeta = 0;
    bool any = false;
    for (int i = 1; i < m->nbody; i++) {
        const struct flex_body *f = m->body[i].flex;
        for (int k = 0; f && f->D && k < f->n; k++) {
            const double K = f->K[k * (f->n + 1)], D = f->D[k * (f->n + 1)];
            any = any || D != 0;
            if (K > 0) zeta = fmax(zeta, D / (2 * sqrt(K)));
        }
    }
    snprintf(o->number, sizeof o->number, "damping ratios up to %.3g", zeta);
    if (!any && o->state == STATE_ON) o->state = STATE_ABSENT;
}

static void tell_momentum(struct told *o, const struct sim *sim)
{
    const int n = sim_floating(sim);
    o->state = n ? STATE_ON : STATE_OFF;
    if (n)
        snprintf(o->number, sizeof o->number, "%d tree%s", n, n == 1 ? " floats" : "s float");
    else
        snprintf(o->number, sizeof o->number, "nothing floats, or no column momentum.* is written");
}

static void tell_ledger(struct told *o, const struct sim *sim)
{
    o->state = sim->looks_always ? STATE_ON : STATE_OFF;
    snprintf(o->number, sizeof o->number,
             sim->looks_always ? "a column, a watch or a scheme looks at every step"
                               : "looked at in every eighth step");
}

static void tell(struct told *o, enum effect_id id, const struct flip *run)
{
    const struct sim *sim = &run->sim;
    const enum effect_wish wish = effect_wish(&sim->scene->effects, id);
    *o = (struct told){.state = wish == WISH_OFF ? STATE_OFF : STATE_ON, .by = wish == WISH_AUTO ? "default" : "deck"};
    switch (id) {
    case EFFECT_OUT_OF_PLANE:
        tell_plane(o, sim);
        break;
    case EFFECT_GRAVITY:
        tell_gravity(o, sim);
        break;
    case EFFECT_GYROSCOPIC:
        tell_gyroscopic(o, sim);
        break;
    case EFFECT_STIFFENING:
        tell_stiffening(o, run);
        break;
    case EFFECT_DAMPING:
        tell_damping(o, sim);
        break;
    case EFFECT_MOMENTUM:
        tell_momentum(o, sim);
        break;
    case EFFECT_LEDGER:
        tell_ledger(o, sim);
        break;
    case EFFECT_ROTARY:
        tell_rotary(o, sim);
        break;
    case EFFECT_SHEAR:
        tell_shear(o, sim->scene);
        break;
    case EFFECTS:
        break;
    }
    if (sim->model->off & effect_bit(id) && o->state != STATE_ABSENT) {
        o->state = STATE_WATCHED;
        o->by = "deck";
    }
    const bool flexible = id == EFFECT_STIFFENING || id == EFFECT_ROTARY || id == EFFECT_SHEAR || id == EFFECT_DAMPING;
    if (!flexible || flexible_bodies(sim->model)) return;
    o->state = STATE_ABSENT;
    snprintf(o->number, sizeof o->number, "0: no flexible body");
}

/* ---- turned the other way ---------------------------------------------------------------------------------------- */

static bool is_stopped(const struct flip *run)
{
    return run->kept.status != OK && run->kept.status != E_VERDICT;
}

static void flip(struct told *o, enum effect_id id, const struct flip *run, const struct request *request,
                 struct arena *life)
{
    struct request other = *request;
    struct scene *scene;
    struct diags *diags;
    struct report report = {0};
    struct flip turned;
    if (o->state == STATE_ABSENT || request->nset == MOST_SETS) return;
    other.set[other.nset] =
        arena_print(life, "effects.%s=%s", effect_kinds[id].name, o->state == STATE_ON ? "false" : "true");
    other.option[other.nset++] = NULL;
    const enum status loaded = cli_load_again(&scene, &diags, &other, run->sim.scene,
                                              o->state == STATE_ON ? 0 : effect_bit(id), life, &report);
    if (loaded == OK) auto_same(scene, run->sim.scene);
    if (loaded != OK || flip_run(&turned, scene, run->until, diags, life, &report) != OK) {
        o->why = "it cannot be turned in this scene";
        return;
    }
    o->flipped = true;
    const double from = scene->start, was = run->instructions / (run->until - from);
    o->cost = turned.instructions / (turned.until - from) / was - 1;
    const bool was_on = o->state == STATE_ON; /* of the run with the effect */
    o->change = flip_change(&o->column, was_on ? run : &turned, was_on ? &turned : run);
    if (isnan(o->change)) o->why = "the two runs have no time in common but the start";
    if (turned.kept.status == E_VERDICT && run->kept.status == OK) o->why = "then the run is told wrong";
    if (is_stopped(&turned) && !is_stopped(run)) o->why = "then the run stops";
    if (o->cost == 0 && o->change == 0) o->why = "no difference: there is none of it, or bodies' own keys decide";
}

/* ---- words and JSON ---------------------------------------------------------------------------------------------- */

static void print_row(const struct told *o, enum effect_id id)
{
    printf("%-13s %-6s %-11s %s\n", effect_kinds[id].name, states[o->state],
           o->state == STATE_ABSENT     ? ""
           : strcmp(o->by, "deck") == 0 ? "by the deck"
                                        : "by default",
           o->number);
    if (o->state == STATE_ABSENT) return;
    printf("%-20s ", "");
    if (!o->flipped || (o->cost == 0 && o->change == 0)) {
        printf("%s\n", o->why ? o->why : "");
        return;
    }
    printf("turned %s: %+.3g %% of the cost", o->state == STATE_ON ? "off" : "on", 100 * o->cost);
    if (o->column) printf(", %s changes by %.2g %%", o->column, 100 * o->change);
    printf("%s%s\n", o->why ? "; " : "", o->why ? o->why : "");
}

/* Of bodies whose modes the program has chosen. */
static void print_modes(const struct model *m)
{
    for (int i = 1; i < m->nbody; i++) {
        if (!m->body[i].flex || !m->body[i].flex->chosen) continue;
        printf("%s\n", m->body[i].name);
        chosen_print(stdout, m->body[i].flex->chosen);
    }
}

static void add_modes(cJSON *to, const struct model *m)
{
    cJSON *list = NULL;
    for (int i = 1; i < m->nbody; i++) {
        if (!m->body[i].flex || !m->body[i].flex->chosen) continue;
        if (!list) list = cJSON_AddObjectToObject(to, "modes");
        cJSON_AddItemToObject(list, m->body[i].name, chosen_json(m->body[i].flex->chosen));
    }
}

static double per_step(const struct flip *run, double x)
{
    return x / fmax(1, (double)run->kept.effort.majors);
}

static void print_words(const struct told *told, const struct flip *run)
{
    const struct sim *sim = &run->sim;
    printf("%s: %s, %.3g instructions a step by counts, runs to t = %.4g s\n", sim->scene->deck->name, sim_space(sim),
           per_step(run, run->instructions), run->until);
    if (is_stopped(run))
        fputs("it does not run to its end: ", stdout), text_put(stdout, run->kept.report.text), puts("");
    for (int i = 0; i < EFFECTS; i++) print_row(&told[i], (enum effect_id)i);
    print_modes(sim->model);
}

static cJSON *row(const struct told *o, enum effect_id id, struct arena *life)
{
    cJSON *to = cJSON_CreateObject();
    cJSON_AddStringToObject(to, "effect", effect_kinds[id].name);
    cJSON_AddStringToObject(to, "state", states[o->state]);
    cJSON_AddStringToObject(to, "by", o->by);
    facts_add(to, "number", facts_text(o->number, life));
    if (o->flipped) {
        facts_add(to, "cost_if_turned", facts_number(o->cost));
        facts_add(to, "change_if_turned", facts_number(o->change));
        facts_add(to, "column", facts_text(o->column, life));
    }
    if (o->why) cJSON_AddStringToObject(to, "note", o->why);
    return to;
}

static enum status print_json(const struct told *told, const struct flip *run, struct arena *life,
                              struct report *report)
{
    cJSON *o = cJSON_CreateObject();
    facts_add(o, "deck", facts_text(run->sim.scene->deck->name, life));
    cJSON_AddStringToObject(o, "motion", sim_space(&run->sim));
    facts_add(o, "instructions_per_step", facts_number(per_step(run, run->instructions)));
    facts_add(o, "seconds_per_step", facts_number(per_step(run, run->kept.seconds)));
    facts_add(o, "until", facts_number(run->until));
    if (is_stopped(run)) cJSON_AddStringToObject(o, "stop", run->kept.report.text);
    cJSON *list = cJSON_AddArrayToObject(o, "effects");
    for (int i = 0; i < EFFECTS; i++) cJSON_AddItemToArray(list, row(&told[i], (enum effect_id)i, life));
    add_modes(o, run->sim.model);
    return facts_print(o, true, report);
}

/* When a second's worth of the run ends, by its first part. */
static double cut_at(const struct flip *part, double from)
{
    const double rate = part->kept.seconds / fmax(part->until - from, 1e-300);
    return from + SECOND / fmax(rate, 1e-300);
}

enum status explain_deck(const struct request *request, struct arena *life, struct report *report)
{
    enum { FIRST = 200 };
    struct scene *scene;
    struct diags *diags = NULL;
    struct flip run = {0};
    struct told told[EFFECTS];
    const bool json = request->format && strcmp(request->format, "json") == 0;
    if (request->format && !json)
        return fail(report, E_USAGE, "'fmdsub explain DECK' prints words, or one object by --format json");
    enum status status = cli_load_run(&scene, &diags, request, life, report);
    if (status == OK) {
        const struct integrate *p = &scene->integrate;
        const double span = p->until - scene->start, H = p->step > 0 ? p->step * p->ratio : span / FIRST;
        status = flip_run(&run, scene, scene->start + FIRST * H, diags, life, report);
        if (status == OK) status = flip_run(&run, scene, cut_at(&run, scene->start), diags_open(life), life, report);
    }
    TRY(cli_told(diags, request, status));
    if (run.kept.status != OK && run.kept.status != E_VERDICT && run.kept.rows == 0)
        return fail(report, run.kept.status, "%s", run.kept.report.text);
    for (int i = 0; i < EFFECTS && !stop; i++) {
        tell(&told[i], (enum effect_id)i, &run);
        flip(&told[i], (enum effect_id)i, &run, request, life);
    }
    if (stop) return stop_status();
    if (json) return print_json(told, &run, life, report);
    print_words(told, &run);
    return OK;
}
