/* system.c -- a model as mechanics: the equations of motion (2-4) by inverse dynamics.
 *
 *     r(q, v, a, t) = M^ a - Q^                                              (2-4)
 *
 * is one sweep outwards, the elements, one sweep inwards; M^ comes from composite bodies, a from r(a = 0) by
 * articulated bodies, or by M^ where these do not go (flexible bodies in space).  All that is called in the step loop
 * works in the sweep `work`; what the output asks for stands in `view`, which the step loop leaves alone. */
#include "system/system.h"

#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/vec3.h"
#include "system/condense.h"
#include "system/elastic.h"
#include "system/elements.h"
#include "system/floating.h"
#include "system/moves.h"
#include "system/sizes.h"

struct system {
    const struct model *model;
    const struct sweep_ops *ops;
    struct sweep *work, *view;
    struct elements *elements;
    struct elastic elastic; /* flexible bodies */
    bool diagonal;          /* elements_are_diagonal() */
    struct moves moves;
    struct floating floating; /* what flies freely */
    struct ode2_direct direct;
    struct ode2_breaks breaks;
    struct ode2 ode;        /* of the tree */
    struct condense *loops; /* of the tree with its loops; NULL: none */
    double *M;              /* [n x n] M^ with loops or flexible bodies */
    double *lambda;         /* [rows] at the last see() */
    double constraint_worst;
    void *factor;     /* of M^, for accel() */
    double *at;       /* [nq] where system_energy_at() has put the bodies of `work`, while `placed`: a factor there */
    bool placed;      /* need not find their positions again */
    double *d, *zero; /* [n] */
    double *size;     /* [n] usual changes of the coordinates */
    struct effect *suspect; /* [nforce] for naming the element that is not finite */
    /* at the last see() */
    double *q, *v, *a, *r; /* [nq], [n] */
    struct effect *effect; /* [nforce] */
    struct energies energies;
};

static struct system *system_of(const struct ode2 *o)
{
    return o->self;
}

/* --- r, M, slopes ------------------------------------------------------------------------------- */

/* Names the element, if one is to blame, else the row. */
static enum status not_finite(struct system *s, const double *r, const struct instant *x, enum rate cls,
                              struct trouble *why)
{
    const struct model *m = s->model;
    memset(s->suspect, 0, sizeof *s->suspect * (size_t)m->nforce);
    s->placed = false;
    s->ops->forward(s->work, x->q, x->v, x->a, cls);
    elements_load(s->elements, s->work, s->d, NULL, NULL, s->suspect, x, cls);
    for (int i = 0; i < m->nforce; i++) {
        if (isfinite(s->suspect[i].force)) continue;
        trouble_set(why, TROUBLE_LAW, i, s->suspect[i].force, x->t);
        if (why) why->kind = (int)m->force[i].type;
        return E_NUMERIC;
    }
    int row = 0;
    while (row < m->n - 1 && isfinite(r[row])) row++;
    return trouble_set(why, TROUBLE_NOT_FINITE, row, r[row], x->t);
}

/* n numbers, `stride` apart; four sums, so that they need not wait for each other. */
static bool all_finite(const double *r, int n, int stride)
{
    double sum[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < (size_t)n; i++) sum[i & 3] += r[i * (size_t)stride] * 0;
    return sum[0] + sum[1] + sum[2] + sum[3] == 0;
}

static enum status resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x, unsigned cls,
                         struct trouble *why)
{
    struct system *s = system_of(o);
    enum rate rate = (enum rate)cls;
    struct instant settled;
    const bool balanced = s->floating.n > 0 && x->va && cls == ALL;
    if (balanced) {
        floating_place(&s->floating, &settled, x);
        x = &settled;
    }
    for (int i = 0; i < o->n; i++) r[i] = 0;
    if (w)
        for (int i = 0; i < POWER_CHANNELS; i++) w[i] = 0;
    if (dk) *dk = 0;
    s->placed = false;
    s->ops->forward(s->work, x->q, x->v, x->a, rate);
    if (balanced) floating_balance(&s->floating, s->work, &settled);
    elements_load(s->elements, s->work, r, w, dk, NULL, x, rate);
    if (w && s->elastic.n) w[POWER_DAMPER] -= elastic_lost(&s->elastic, x->v, rate);
    s->ops->backward(s->work, r, rate);
    return all_finite(r, o->n, 1) ? OK : not_finite(s, r, x, rate, why);
}

static enum status mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls, struct trouble *why)
{
    struct system *s = system_of(o);
    s->placed = false;
    s->ops->mass(s->work, M, q, cls);
    /* all that enters M enters its diagonal */
    return all_finite(M, o->n, o->n + 1) ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, t);
}

static enum status slopes(const struct ode2 *o, double *K, double *C, const struct instant *x, unsigned cls,
                          struct trouble *why)
{
    struct system *s = system_of(o);
    const size_t nn = (size_t)o->n * (size_t)o->n;
    if (K) memset(K, 0, nn * sizeof *K);
    if (C) memset(C, 0, nn * sizeof *C);
    s->placed = s->placed && s->diagonal;
    if (!s->diagonal) s->ops->move(s->work, x->q, x->v, cls);
    elements_slopes(s->elements, s->work, K, C, x, (enum rate)cls);
    elastic_slopes(&s->elastic, K, C, o->n, (enum rate)cls);
    if ((K && !all_finite(K, o->n * o->n, 1)) || (C && !all_finite(C, o->n * o->n, 1)))
        return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, x->t);
    return OK;
}

static const struct ode2_ops ops = {.resid = resid, .mass = mass, .slopes = slopes};

/* --- positions ---------------------------------------------------------------------------------- */

static void move_point(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s, double t)
{
    (void)t;
    moves_point(&system_of(o)->moves, q1, q0, dx, s);
}

static void move_diff(const struct ode2 *o, double *dx, const double *q1, const double *q0)
{
    moves_diff(&system_of(o)->moves, dx, q1, q0);
}

static void move_rate(const struct ode2 *o, double *dxrate, const double *q1, const double *q0, const double *dx,
                      const double *v, double t)
{
    (void)q1, (void)q0, (void)t;
    moves_rate(&system_of(o)->moves, dxrate, dx, v);
}

static const struct ode2_move move = {.point = move_point, .diff = move_diff, .rate = move_rate};

static void settle(const struct ode2 *o, double *q1, double *v1, const struct instant *x)
{
    floating_settle(&system_of(o)->floating, q1, v1, x);
}

/* --- articulated bodies ------------------------------------------------------------------------- */

/* x := M^-1 x where the last sweep has stood. */
static enum status solve_mass(struct system *s, double *x, const double *q, double t, struct trouble *why)
{
    const int n = s->model->n;
    if (s->ops->factor(s->work, s->factor, 1, s->zero, NULL)) {
        s->ops->solve(s->work, s->factor, x);
        return OK;
    }
    if (!s->elastic.n) return trouble_set(why, TROUBLE_MASS, -1, 0, t);
    TRY(mass(&s->ode, s->M, q, t, ALL, why));
    int pivot = dense_cholesky(s->M, n, n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, t);
    dense_cholesky_solve(s->M, x, n, n);
    return OK;
}

static enum status accel(const struct ode2 *o, double *a, double *w, const double *q, const double *v, double t,
                         struct trouble *why)
{
    struct system *s = system_of(o);
    const struct instant x = {.t = t, .q = q, .v = v};
    TRY(resid(o, a, w, NULL, &x, ALL, why));
    TRY(solve_mass(s, a, q, t, why));
    for (int i = 0; i < o->n; i++) a[i] = -a[i];
    return OK;
}

static enum status factor(const struct ode2 *o, void *F, double cm, double cc, double ck, const struct instant *x,
                          struct trouble *why)
{
    struct system *s = system_of(o);
    if (!s->diagonal || s->elastic.n) return trouble_set(why, TROUBLE_SINGULAR, -1, 0, x->t);
    memset(s->d, 0, sizeof *s->d * (size_t)o->n);
    elements_diagonal(s->elements, s->d, cc, ck, x);
    s->placed = false;
    return s->ops->factor(s->work, F, cm, s->d, x->q) ? OK : trouble_set(why, TROUBLE_SINGULAR, -1, 0, x->t);
}

static enum status stiffen(const struct ode2 *o, void *F, const double *d, const double *q, double t,
                           struct trouble *why)
{
    struct system *s = system_of(o);
    s->placed = s->placed && memcmp(s->at, q, sizeof *q * (size_t)o->nq) == 0;
    return s->ops->factor(s->work, F, 1, d, s->placed ? NULL : q) ? OK : trouble_set(why, TROUBLE_SINGULAR, -1, 0, t);
}

static void solve(const struct ode2 *o, const void *F, double *x)
{
    struct system *s = system_of(o);
    s->ops->solve(s->work, F, x);
}

/* --- turns -------------------------------------------------------------------------------------- */

/* Angles in space go on from q; v [n of the tree].  The coordinates stay. */
static int count_turns(struct ode2 *o, double *q, double *v, double t)
{
    struct system *s = system_of(o);
    s->placed = false;
    s->ops->move(s->work, q, v, ALL);
    elements_turned(s->elements, s->work, t);
    return 0;
}

static const struct ode2_chart turns = {.rechart = count_turns};

/* --- kinks in time ------------------------------------------------------------------------------ */

static double next_kink(const struct ode2 *o, double t)
{
    const struct model *m = system_of(o)->model;
    double next = INFINITY;
    for (int i = 0; i < m->nforce; i++)
        if (m->force[i].type == FORCE_VALUE || m->force[i].type == FORCE_LOAD)
            for (int k = 0; k < 3; k++) next = fmin(next, signal_next(&m->force[i].value[k], t));
    return next;
}

/* --- loops -------------------------------------------------------------------------------------- */

static void build_loops(struct system *s, struct arena *life)
{
    const struct model *m = s->model;
    s->loops = condense_build(m, s->ops, &s->ode, s->elements, &s->elastic, &s->moves, m->q0, m->v0, life);
    const int n = condense_ode2(s->loops)->n;
    if (!s->M) s->M = TAKE(life, double, (size_t)n *(size_t)n);
    s->lambda = TAKE(life, double, condense_loops(s->loops)->nrow);
}

/* Accelerations of all coordinates, then the multipliers, which load the bodies like any force. */
static enum status loops_accel(struct system *s, const double *q, const double *v, double t, struct trouble *why)
{
    const struct ode2 *o = condense_ode2(s->loops);
    const struct instant x = {.t = t, .q = q, .v = s->v, .a = s->a};
    TRY(o->ops->resid(o, s->r, NULL, NULL, &(struct instant){.t = t, .q = q, .v = v}, ALL, why));
    TRY(o->ops->mass(o, s->M, q, t, ALL, why));
    int pivot = dense_cholesky(s->M, o->n, o->n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, t);
    dense_cholesky_solve(s->M, s->r, o->n, o->n);
    for (int i = 0; i < o->n; i++) s->r[i] = -s->r[i];
    TRY(condense_rates(s->loops, s->v, s->a, q, v, s->r, t, why));
    TRY(resid(&s->ode, s->r, NULL, NULL, &x, ALL, why));
    condense_lambda(s->loops, s->lambda, s->r);
    return OK;
}

/* --- building ----------------------------------------------------------------------------------- */

static double size_of(const struct ode2 *o, int i)
{
    return system_of(o)->size[i];
}

struct system *system_build(const struct model *m, struct arena *life)
{
    struct system *s = TAKE(life, struct system, 1);
    s->model = m;
    s->ops = m->space == 2 ? &sweep_planar : &sweep_spatial;
    s->work = s->ops->build(m, life);
    s->view = s->ops->build(m, life);
    s->elements = elements_build(m, s->ops, life);
    s->diagonal = elements_are_diagonal(s->elements);
    elastic_build(&s->elastic, m, life);
    if (s->elastic.n) s->M = TAKE(life, double, m->n * m->n);
    moves_build(&s->moves, m, life);
    floating_build(&s->floating, m, s->ops, life);
    const size_t bytes = s->ops->factor_size(s->work);
    s->factor = arena_take(life, 1, bytes);
    s->d = TAKE(life, double, m->n);
    s->zero = TAKE(life, double, m->n);
    s->size = TAKE(life, double, m->n);
    sizes_fill(s->size, m);
    s->at = TAKE(life, double, m->nq);
    s->q = TAKE(life, double, m->nq);
    s->v = TAKE(life, double, m->n);
    s->a = TAKE(life, double, m->n);
    s->r = TAKE(life, double, m->n);
    s->suspect = TAKE(life, struct effect, m->nforce);
    s->effect = TAKE(life, struct effect, m->nforce);
    s->direct = (struct ode2_direct){
        .accel = accel, .factor_size = bytes, .factor = factor, .stiffen = stiffen, .solve = solve};
    bool plain = s->moves.nturn == 0 && s->moves.nfirst == m->n && m->nq == m->n;
    s->breaks = (struct ode2_breaks){.next = next_kink};
    s->ode.self = s;
    const double first = next_kink(&s->ode, -INFINITY);
    s->ode = (struct ode2){.n = m->n,
                           .ns = m->ns,
                           .nq = m->nq,
                           .near = m->near,
                           .price = s->elastic.n ? 3 : 2, /* counted in instructions */
                           .ops = &ops,
                           .move = plain ? NULL : &move,
                           .direct = &s->direct,
                           .chart = elements_turn(s->elements) ? &turns : NULL,
                           .breaks = isinf(first) ? NULL : &s->breaks,
                           .size = size_of,
                           .settle = s->floating.n ? settle : NULL,
                           .self = s};
    if (m->nloop) build_loops(s, life);
    return s;
}

const struct ode2 *system_ode2(const struct system *s)
{
    return s->loops ? condense_ode2(s->loops) : &s->ode;
}

enum status system_start(const struct system *s, double *q, double *v, struct report *report)
{
    const struct ode2 *o = system_ode2(s);
    if (s->loops && condense_started(s->loops)->status != OK) {
        *report = condense_started(s->loops)->report;
        return condense_started(s->loops)->status;
    }
    memcpy(q, s->loops ? condense_q(s->loops) : s->model->q0, sizeof *q * (size_t)o->nq);
    memcpy(v, s->loops ? condense_v(s->loops) : s->model->v0, sizeof *v * (size_t)o->n);
    return OK;
}

struct condense *system_loops(const struct system *s)
{
    return s->loops;
}

int system_place(const struct system *s, int i)
{
    return s->loops ? condense_place(s->loops, i) : i;
}

long system_charts(const struct system *s)
{
    return s->loops ? condense_charts(s->loops) : 0;
}

double system_constraint_worst(const struct system *s)
{
    return s->constraint_worst;
}

/* --- at an output instant ------------------------------------------------------------------------ */

static void see_energies(struct system *s, struct energies *e, struct sweep *sweep, const double *q, const double *v)
{
    s->ops->energy(sweep, &e->kinetic, &e->gravity);
    e->elastic = elements_stored(s->elements, sweep, q, v) + elastic_stored(&s->elastic, q);
}

enum status system_see(struct system *s, const double *q, const double *v, double t, unsigned what, struct trouble *why)
{
    const struct model *m = s->model;
    memcpy(s->q, q, sizeof *q * (size_t)m->nq);
    if (s->loops) {
        TRY(condense_rates(s->loops, s->v, NULL, q, v, NULL, t, why));
        s->constraint_worst = fmax(s->constraint_worst, condense_worst(s->loops, q, t));
    } else {
        memcpy(s->v, v, sizeof *v * (size_t)m->n);
    }
    if (what & SEE_ACCELERATION) {
        const struct instant x = {.t = t, .q = s->q, .v = s->v, .a = s->a};
        TRY(s->loops ? loops_accel(s, q, v, t, why) : accel(&s->ode, s->a, NULL, q, v, t, why));
        memset(s->r, 0, sizeof *s->r * (size_t)m->n);
        s->ops->forward(s->view, s->q, s->v, s->a, ALL);
        elements_load(s->elements, s->view, s->r, NULL, NULL, s->effect, &x, ALL);
        if (s->loops) condense_push(s->loops, s->view, s->q, s->v, t, s->lambda);
        s->ops->backward(s->view, s->r, ALL);
    } else {
        s->ops->move(s->view, s->q, s->v, ALL);
    }
    if (what & SEE_ENERGY) see_energies(s, &s->energies, s->view, s->q, s->v);
    return OK;
}

const double *system_rates(const struct system *s)
{
    return s->v;
}

const double *system_accelerations(const struct system *s)
{
    return s->a;
}

void system_pose(const struct system *s, struct pose *o, int body)
{
    s->ops->pose(s->view, o, body);
}

void system_point(const struct system *s, double *x, double *xv, double *xa, const struct model_point *p)
{
    struct pose b;
    double d[3], turned[3];
    s->ops->pose(s->view, &b, p->body);
    m3_mul(d, b.R, p->p);
    v3_sum(x, b.r, d);
    v3_cross(turned, b.w, d); /* w x d */
    v3_sum(xv, b.v, turned);
    v3_copy(xa, b.a);
    v3_cross_add(xa, b.al, d);
    v3_cross_add(xa, b.w, turned);
}

void system_centre(const struct system *s, struct pose *o, int body)
{
    s->ops->pose(s->view, o, body);
    if (s->model->body[body].flex) elastic_centre(o, &s->elastic, body, s->q, s->v, s->a);
}

void system_displacement(const struct system *s, double *d, const struct model_point *p)
{
    struct pose frame;
    double x[3], v[3], a[3], away[3];
    system_point(s, x, v, a, p);
    s->ops->pose(s->view, &frame, p->frame);
    v3_diff(away, x, frame.r);
    m3_tmul(d, frame.R, away);
    v3_take(d, p->drawn);
}

double system_stress(const struct system *s, int body, int stress, enum bent_stress part)
{
    return bent_stress(&s->model->body[body], stress, part, s->q);
}

void system_stand(struct system *s, int measure, double x)
{
    elements_stand(s->elements, measure, x);
}

void system_measure(const struct system *s, double *value, double *rate, int measure)
{
    elements_measure(s->elements, s->view, value, rate, measure, s->q, s->v);
}

/* On the deck's second body: the child, or the parent, which feels the opposite. */
void system_reaction(const struct system *s, double *f, double *n, int joint)
{
    s->ops->reaction(s->view, f, n, joint);
    if (!s->model->joint[joint].reversed) return;
    v3_scale(f, -1, f);
    v3_scale(n, -1, n);
}

void system_loop_reaction(const struct system *s, double *f, double *n, int loop)
{
    condense_reaction(s->loops, f, n, loop, s->lambda);
}

void system_drive(const struct system *s, double *force, double *power, int loop)
{
    condense_drive(s->loops, force, power, loop, s->lambda);
}

double system_loop_force(const struct system *s, int loop)
{
    return loops_force(condense_loops(s->loops), loop, s->lambda);
}

void system_force(const struct system *s, double *force, double *elongation, double *power, int i)
{
    *force = s->effect[i].force;
    *elongation = s->effect[i].elongation;
    *power = s->effect[i].power;
}

void system_energies(const struct system *s, struct energies *e)
{
    *e = s->energies;
}

void system_energy_at(struct system *s, struct energies *e, const double *q, const double *v, double t)
{
    struct trouble why;
    if (s->loops) {
        condense_rates(s->loops, s->v, NULL, q, v, NULL, t, &why);
        v = s->v;
    }
    s->ops->move(s->work, q, v, ALL);
    memcpy(s->at, q, sizeof *q * (size_t)s->model->nq);
    s->placed = true;
    see_energies(s, e, s->work, q, v);
}

void system_frame_spin(const struct system *s, double *w, int body)
{
    struct pose frame;
    s->ops->pose(s->work, &frame, body);
    m3_tmul(w, frame.R, frame.w);
}

/* p = sum m v,  L = sum (r x m v + I w) */
void system_momentum(const struct system *s, double *p, double *L)
{
    v3_set(p, 0, 0, 0);
    v3_set(L, 0, 0, 0);
    for (int i = 0; i < s->elastic.n; i++) {
        struct pose b;
        s->ops->pose(s->view, &b, s->elastic.body[i].number);
        elastic_momentum(p, L, &s->elastic.body[i], &b, s->q, s->v);
    }
    for (int i = 1; i < s->model->nbody; i++) {
        const struct model_body *body = &s->model->body[i];
        if (body->flex) continue;
        struct pose b;
        double mv[3], w[3], spin[3], world[3];
        s->ops->pose(s->view, &b, i);
        v3_scale(mv, body->mass, b.v);
        v3_add(p, mv);
        v3_cross_add(L, b.r, mv);
        m3_tmul(w, b.R, b.w);
        s3_mul(spin, body->inertia, w);
        m3_mul(world, b.R, spin);
        v3_add(L, world);
    }
}
