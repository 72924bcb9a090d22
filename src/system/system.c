/* system.c -- a model as mechanics: its tree, with loops closed over it, and what the output asks for.
 *
 * All that is called in the step loop works in the sweep of the tree; what the output asks for stands in `view`, which
 * the step loop leaves alone. */
#include "system/parts.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "tree/sizes.h"

/* --- building ----------------------------------------------------------------------------------- */

static void build_loops(struct system *s, struct arena *life)
{
    s->loops = condense_build(&s->tree, s->model->q0, s->model->v0, life);
    s->shown = loops_build(s->model, s->ops, life);
    s->lambda = TAKE(life, double, s->shown->nrow);
}

struct system *system_build(const struct model *m, struct arena *life)
{
    struct system *s = TAKE(life, struct system, 1);
    s->model = m;
    open_build(&s->tree, m, life);
    s->ops = s->tree.ops;
    s->view = s->ops->build(m, FOR_RECORDS, NULL, life);
    s->q = TAKE(life, double, m->nq);
    s->v = TAKE(life, double, m->n);
    s->a = TAKE(life, double, m->n);
    s->r = TAKE(life, double, m->n);
    s->effect = TAKE(life, struct effect, m->nforce);
    for (int i = 0; i < 2; i++) {
        s->near_q[i] = TAKE(life, double, m->nq);
        s->near_v[i] = TAKE(life, double, m->n);
    }
    if (m->nloop) build_loops(s, life);
    if (m->ncontact) touching_build(s, life);
    return s;
}

struct ode2 *system_ode2(struct system *s)
{
    return s->loops ? condense_ode2(s->loops) : &s->tree.ode;
}

enum status system_start(struct system *s, double *q, double *v, struct report *report)
{
    const struct ode2 *o = system_ode2(s);
    if (s->loops && condense_started(s->loops)->status != OK) {
        *report = condense_started(s->loops)->report;
        return condense_started(s->loops)->status;
    }
    memcpy(q, s->loops ? condense_q(s->loops) : s->model->q0, sizeof *q * (size_t)o->nq);
    memcpy(v, s->loops ? condense_v(s->loops) : s->model->v0, sizeof *v * (size_t)o->n);
    open_move(&s->tree, q, s->v);
    open_begin(&s->tree, &(struct instant){.t = s->model->t0, .q = q, .v = s->v});
    return OK;
}

void system_recall(struct system *s, struct recall *r)
{
    recall_one(r, "constraint_worst", s->constraint_worst);
    open_recall(&s->tree, r);
    if (s->windings && recall_has(r, "windings")) windings_recall(s->windings, r);
    if (s->loops) condense_recall(s->loops, r);
    if (!s->seen) return;
    recall_within(r, "seen");
    system_recall(s->seen, r);
    recall_without(r);
}

struct condense *system_loops(const struct system *s)
{
    return system_seen(s)->loops;
}

struct condense *system_loops_stepped(const struct system *s)
{
    return s->loops;
}

int system_place(const struct system *s, int i)
{
    return s->loops ? condense_place(s->loops, i) : i;
}

int system_floating(const struct system *s)
{
    return s->tree.floating.n;
}

long system_charts(const struct system *s)
{
    return s->loops ? condense_charts(s->loops) : 0;
}

double system_constraint_worst(const struct system *s)
{
    return s->constraint_worst;
}

void system_note_closure(struct system *s, const double *q, double t)
{
    if (s->loops) s->constraint_worst = fmax(s->constraint_worst, condense_worst(s->loops, q, t));
}

double system_length(const struct system *s)
{
    return sizes_length(system_seen(s)->model);
}

/* --- at an output instant ------------------------------------------------------------------------ */

static void evaluate_energies(struct system *s, struct energies *e, struct sweep *sweep, const double *q,
                              const double *v)
{
    s->ops->energy(sweep, &e->kinetic, &e->gravity);
    if (s->flat) e->gravity += s->flat->level;
    e->elastic = elements_stored(s->tree.elements, sweep, q, v) + elastic_stored(&s->tree.elastic, q);
}

/* v of all coordinates. */
static enum status evaluate_rates(struct system *s, const double *q, const double *v, double t, struct trouble *why)
{
    memcpy(s->q, q, sizeof *q * (size_t)s->model->nq);
    if (!s->loops) {
        memcpy(s->v, v, sizeof *v * (size_t)s->model->n);
        return OK;
    }
    TRY(condense_rates(s->loops, s->v, NULL, q, v, NULL, t, why));
    s->constraint_worst = fmax(s->constraint_worst, condense_worst(s->loops, q, t));
    return OK;
}

static enum status evaluate_accelerations(struct system *s, const double *q, const double *v, double t,
                                          struct trouble *why)
{
    if (s->loops) return condense_accel(s->loops, s->v, s->a, s->lambda, q, v, t, why);
    return s->tree.direct.accel(&s->tree.ode, s->a, NULL, q, v, t, why);
}

/* The multipliers load the bodies like any force. */
static void push_loops(struct system *s, double t)
{
    loops_when(s->shown, t, 0);
    loops_place(s->shown, s->view, s->q);
    loops_push(s->shown, s->view, s->lambda);
}

/* All forces, where s->view has s->q, s->v, s->a; then those of the joints. */
static void load(struct system *s, double t, bool reactions)
{
    const struct instant x = {.t = t, .q = s->q, .v = s->v, .a = s->a};
    memset(s->r, 0, sizeof *s->r * (size_t)s->model->n);
    elements_load(s->tree.elements, s->view, s->r, NULL, NULL, s->effect, &x, ALL);
    if (reactions && s->loops) push_loops(s, t);
    if (reactions) s->ops->backward(s->view, s->r, ALL);
}

static enum status joint_forces(struct system *s, const struct instant *x, struct trouble *why)
{
    memcpy(s->q, x->q, sizeof *s->q * (size_t)s->model->nq);
    if (s->loops) {
        TRY(condense_multipliers(s->loops, s->v, s->a, s->lambda, x, why));
    } else {
        memcpy(s->v, x->v, sizeof *s->v * (size_t)s->model->n);
        memcpy(s->a, x->a, sizeof *s->a * (size_t)s->model->n);
    }
    s->ops->forward(s->view, s->q, s->v, s->a, ALL);
    load(s, x->t, true);
    return OK;
}

enum status system_joint_forces(struct system *s, const struct instant *x, const double *f, struct trouble *why)
{
    elements_press(s->tree.elements, s->contacts, f);
    const enum status status = joint_forces(s, x, why);
    elements_press(s->tree.elements, NULL, NULL);
    return status;
}

static enum status evaluate(struct system *s, const double *q, const double *v, double t, unsigned what,
                            struct trouble *why)
{
    return s->seen ? flat_evaluate(s, q, v, t, what, why) : system_evaluate_itself(s, q, v, t, what, why);
}

enum status system_evaluate_itself(struct system *s, const double *q, const double *v, double t, unsigned what,
                                   struct trouble *why)
{
    const bool reactions = what & EVALUATE_REACTION, forces = reactions || what & EVALUATE_FORCE,
               accelerations = reactions || what & EVALUATE_ACCELERATION;
    TRY(evaluate_rates(s, q, v, t, why));
    if (accelerations) TRY(evaluate_accelerations(s, q, v, t, why));
    open_look(&s->tree, s->view, s->q, s->v, t);
    if (accelerations || forces)
        s->ops->forward(s->view, s->q, s->v, accelerations ? s->a : NULL, ALL);
    else
        s->ops->move(s->view, s->q, s->v, ALL);
    if (forces) load(s, t, reactions);
    if (what & EVALUATE_ENERGY) evaluate_energies(s, &s->energies, s->view, s->q, s->v);
    return OK;
}

enum status system_evaluate(struct system *s, const double *q, const double *v, double t, unsigned what,
                            struct trouble *why)
{
    if (!s->contacts) return evaluate(s, q, v, t, what, why);
    elements_press(s->tree.elements, s->contacts, s->press);
    const enum status status = evaluate(s, q, v, t, what, why);
    elements_press(s->tree.elements, NULL, NULL);
    return status;
}

/* q, v and t at s->q, s->v, s->a moved on by h, in q1 and v1. */
static void move_on(const struct system *s, double *q1, double *v1, double h)
{
    const struct ode2 *tree = &s->tree.ode;
    if (tree->move)
        tree->move->point(tree, q1, s->q, s->v, h, 0);
    else
        for (int i = 0; i < s->model->n; i++) q1[i] = s->q[i] + h * s->v[i];
    for (int i = 0; i < s->model->n; i++) v1[i] = s->v[i] + h * s->a[i];
}

int system_leap(struct system *s, double *before, double *behind, const double *q, const double *v, double t, double h)
{
    struct trouble why;
    struct instant end[2];
    struct leap leap;
    if (evaluate_rates(s, q, v, t, &why) != OK || evaluate_accelerations(s, q, v, t, &why) != OK) return -1;
    for (int i = 0; i < 2; i++) {
        move_on(s, s->near_q[i], s->near_v[i], i ? h : -h);
        end[i] = (struct instant){.t = i ? t + h : t - h, .q = s->near_q[i], .v = s->near_v[i]};
    }
    elements_leap(&leap, s->tree.elements, s->view, &end[0], &end[1]);
    *before = leap.before;
    *behind = leap.behind;
    return leap.force;
}

/* --- whole turns ------------------------------------------------------------------------------------ */

void system_set_measure(struct system *s, int measure, double x)
{
    elements_set_measure(s->tree.elements, measure, x);
}

static const struct follower winding = {windings_note, windings_look};

void system_follow_turns(struct system *s, struct arena *life)
{
    if (!s->loops || s->model->space == 2) return;
    s->windings = windings_build(s->model, s->ops, life);
    open_follow(&s->tree, &winding, s->windings);
    if (condense_started(s->loops)->status != OK) return;
    open_place(&s->tree, condense_q(s->loops));
    windings_start(s->windings, s->tree.sweep);
}

void system_count_turns(struct system *s, double *q, double t)
{
    struct ode2 *tree = &s->tree.ode;
    double *rest = s->near_v[0];
    if (!tree->chart) return;
    memset(rest, 0, sizeof *rest * (size_t)s->model->n);
    tree->chart->rechart(tree, q, rest, t);
}

void system_set_loop_coordinate(struct system *s, int loop, int k, double x)
{
    if (s->seen) return;
    windings_set(s->windings, loop, k, x);
}

/* --- where the steps stand -------------------------------------------------------------------------- */

enum status system_energy_at(struct system *s, struct energies *e, const double *q, const double *v, double t,
                             struct trouble *why)
{
    if (s->loops) {
        TRY(condense_rates(s->loops, s->v, NULL, q, v, NULL, t, why));
        v = s->v;
    }
    open_move(&s->tree, q, v);
    evaluate_energies(s, e, s->tree.sweep, q, v);
    return OK;
}

/* s->r += weight times the row of one axis, in the tree. */
static void add_spin(struct system *s, const struct turn_axis *of)
{
    struct pose b;
    double e[3];
    const int *k, n = s->ops->path(s->tree.sweep, &k, of->body);
    s->ops->pose(s->tree.sweep, &b, of->body);
    m3_mul(e, b.R, of->axis);
    s->ops->row(s->tree.sweep, s->v, of->body, 0, b.r, NULL, e);
    for (int i = 0; i < n; i++) s->r[k[i]] += of->weight * s->v[i];
}

void system_spin_row(struct system *s, double *row, const double *q, double t, const struct turn_axis *of, int many)
{
    memset(s->r, 0, sizeof *s->r * (size_t)s->model->n);
    open_place(&s->tree, q);
    for (int i = 0; i < many; i++) add_spin(s, &of[i]);
    if (s->loops)
        condense_reduce(s->loops, row, s->r, q, t);
    else
        memcpy(row, s->r, sizeof *row * (size_t)s->model->n);
}

void system_frame_spin(const struct system *s, double *w, int body)
{
    struct pose frame;
    s->ops->pose(s->tree.sweep, &frame, body);
    m3_tmul(w, frame.R, frame.w);
}

double system_start_length(const struct system *s)
{
    return sizes_of_start(s->model);
}

bool system_may_bend(const struct system *s)
{
    return elements_may_bend(s->tree.elements);
}

bool system_may_have_poles(const struct system *s)
{
    return elements_may_have_poles(s->tree.elements);
}

int system_pole(const struct system *s)
{
    return elements_pole(s->tree.elements);
}

int system_pole_to(struct system *s, const double *q, const double *v, double t)
{
    struct trouble why;
    if (system_evaluate_itself(s, q, v, t, 0, &why) != OK) return -1;
    return elements_pole_to(s->tree.elements, s->view, &(struct instant){.t = t, .q = s->q, .v = s->v});
}

enum status system_back(struct system *s, double *q, const double *v, double t, struct trouble *why)
{
    struct ode2 *tree = &s->tree.ode;
    TRY(evaluate_rates(s, q, v, t, why));
    if (tree->chart) tree->chart->rechart(tree, q, s->v, t);
    elements_no_pole(s->tree.elements);
    return OK;
}

bool system_bent(const struct system *s)
{
    return elements_bent(s->tree.elements);
}

void system_apart(const struct system *s, double *d, const struct model_measure *m)
{
    double a[3], b[3], v[3];
    if (s->flat) m = &s->model->measure[m - s->flat->full->measure];
    s->ops->point(s->tree.sweep, a, v, m->a.body, m->a.p);
    s->ops->point(s->tree.sweep, b, v, m->b.body, m->b.p);
    v3_diff(d, b, a);
}

double system_tilt(const struct system *s, int force)
{
    return elements_tilt(s->tree.elements, s->tree.sweep, force);
}
