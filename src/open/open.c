/* open.c -- see open.h */
#include "open/open.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/inline.h"
#include "la/dense.h"
#include "tree/sizes.h"

static struct open_tree *tree_of(const struct ode2 *o)
{
    return o->self;
}

/* --- where the bodies stand --------------------------------------------------------------------- */

static bool placed_at(const struct open_tree *s, const double *q)
{
    return s->placed && posture_is(&s->posture, q, s->model->nq);
}

/* Takes q; do the bodies stand there already? */
static bool take_posture(struct open_tree *s, const double *q)
{
    const long before = s->posture.number;
    const bool there = posture_take(&s->posture, q, s->model->nq) == before && s->placed;
    s->placed = true;
    return there;
}

long open_take(struct open_tree *s, const double *q)
{
    s->placed = take_posture(s, q);
    return s->posture.number;
}

long open_place(struct open_tree *s, const double *q)
{
    if (take_posture(s, q)) return s->posture.number;
    s->ops->place(s->sweep, q, ALL);
    s->moved = 0;
    return s->posture.number;
}

long open_move(struct open_tree *s, const double *q, const double *v)
{
    s->ops->move(s->sweep, take_posture(s, q) ? NULL : q, v, ALL);
    return s->moved = s->posture.number;
}

void open_stir_up(struct open_tree *s, const double *v, const double *a)
{
    s->ops->stir_up(s->sweep, v, a, ALL);
    s->moved = s->posture.number;
}

/* --- r, M, slopes ------------------------------------------------------------------------------- */

/* Names the element, if one is to blame, else the row of r, if that is known. */
static enum status not_finite(struct open_tree *s, const double *r, const struct instant *x, enum rate cls,
                              struct trouble *why)
{
    const struct model *m = s->model;
    memset(s->suspect, 0, sizeof *s->suspect * (size_t)m->nforce);
    s->placed = false;
    s->ops->forward(s->sweep, x->q, x->v, x->a, cls);
    elements_load(s->elements, s->sweep, s->d, NULL, NULL, s->suspect, x, cls);
    for (int i = 0; i < m->nforce; i++) {
        if (isfinite(s->suspect[i].force) && isfinite(s->suspect[i].torque)) continue;
        enum status status = trouble_set(why, TROUBLE_LAW, i, s->suspect[i].force, x->t);
        if (why) why->kind = (int)m->force[i].type;
        return status;
    }
    if (!r) return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, x->t);
    int row = 0;
    while (row < m->n - 1 && isfinite(r[row])) row++;
    return trouble_set(why, TROUBLE_NOT_FINITE, row, r[row], x->t);
}

/* n numbers, `stride` apart; four sums, so that they need not wait for each other. */
INTO static inline bool all_finite(const double *r, int n, int stride)
{
    const double *r1 = r + stride, *r2 = r1 + stride, *r3 = r2 + stride;
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    size_t at = 0;
    for (; n >= 4; n -= 4, at += 4 * (size_t)stride) {
        s0 += r[at] * 0;
        s1 += r1[at] * 0;
        s2 += r2[at] * 0;
        s3 += r3[at] * 0;
    }
    for (; n > 0; n--, at += (size_t)stride) s0 += r[at] * 0;
    return s0 + s1 + s2 + s3 == 0;
}

/* Written into both of its callers: chains of a few bodies would feel the call. */
INTO static inline enum status residual(struct open_tree *o, double *r, double *w, double *dk, const struct instant *x,
                                        enum rate cls, bool moved, struct trouble *why)
{
    const int n = o->model->n;
    const bool balanced = o->floating.n > 0 && x->va && cls == ALL;
    struct instant settled;
    if (balanced) {
        floating_place(&o->floating, &settled, x);
        x = &settled;
    }
    for (int i = 0; i < n; i++) r[i] = 0;
    if (w)
        for (int i = 0; i < POWER_CHANNELS; i++) w[i] = 0;
    if (dk) *dk = 0;
    if (!moved || balanced) o->placed = false;
    o->ops->forward(o->sweep, moved ? NULL : x->q, x->v, x->a, cls);
    if (balanced) floating_balance(&o->floating, o->sweep, &settled);
    elements_load(o->elements, o->sweep, r, w, dk, NULL, x, cls);
    if (w && o->elastic.n) w[POWER_DAMPER] -= elastic_lost(&o->elastic, x->v, cls);
    o->ops->backward(o->sweep, r, cls);
    return all_finite(r, cls == FAST && o->ode.near > 0 ? o->ode.near : n, 1) ? OK : not_finite(o, r, x, cls, why);
}

enum status open_resid(struct open_tree *o, double *r, double *w, double *dk, const struct instant *x, enum rate cls,
                       struct trouble *why)
{
    assert(o->placed && o->moved == o->posture.number);
    return residual(o, r, w, dk, x, cls, true, why);
}

static enum status resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x, unsigned cls,
                         struct trouble *why)
{
    return residual(tree_of(o), r, w, dk, x, (enum rate)cls, false, why);
}

static enum status mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls, struct trouble *why)
{
    struct open_tree *s = tree_of(o);
    if (cls != FAST) open_place(s, q);
    s->placed = placed_at(s, q);
    s->ops->mass(s->sweep, M, s->placed ? NULL : q, cls);
    /* all that enters M enters its diagonal */
    return all_finite(M, cls == FAST && o->near > 0 ? o->near : o->n, o->n + 1)
               ? OK
               : trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, t);
}

static enum status slopes(const struct ode2 *o, double *K, double *C, const struct instant *x, unsigned cls,
                          struct trouble *why)
{
    struct open_tree *s = tree_of(o);
    const size_t nn = (size_t)o->n * (size_t)o->n;
    if (K) memset(K, 0, nn * sizeof *K);
    if (C) memset(C, 0, nn * sizeof *C);
    if (!s->diagonal) {
        const bool there = placed_at(s, x->q);
        s->placed = there;
        s->ops->move(s->sweep, there ? NULL : x->q, x->v, cls);
    }
    elements_slopes(s->elements, s->sweep, K, C, x, (enum rate)cls);
    elastic_slopes(&s->elastic, K, C, o->n, NULL, (enum rate)cls);
    if ((!K || all_finite(K, o->n * o->n, 1)) && (!C || all_finite(C, o->n * o->n, 1))) return OK;
    return x->v ? not_finite(s, NULL, x, (enum rate)cls, why) : trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, x->t);
}

static const struct ode2_ops ops = {.resid = resid, .mass = mass, .slopes = slopes};

/* --- positions ---------------------------------------------------------------------------------- */

static void move_point(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s, double t)
{
    (void)t;
    moves_point(&tree_of(o)->moves, q1, q0, dx, s);
}

static void move_diff(const struct ode2 *o, double *dx, const double *q1, const double *q0)
{
    moves_diff(&tree_of(o)->moves, dx, q1, q0);
}

static void move_rate(const struct ode2 *o, double *dxrate, const double *q1, const double *q0, const double *dx,
                      const double *v, double t)
{
    (void)q1, (void)q0, (void)t;
    moves_rate(&tree_of(o)->moves, dxrate, dx, v);
}

static void move_bend(const struct ode2 *o, double *off, const double *v, const double *a, int order)
{
    moves_bend(&tree_of(o)->moves, off, v, a, order);
}

static const struct ode2_move move = {.point = move_point, .diff = move_diff, .rate = move_rate, .bend = move_bend};

static enum status settle(const struct ode2 *o, double *q1, double *v1, const struct instant *x, struct trouble *why)
{
    (void)why;
    floating_settle(&tree_of(o)->floating, q1, v1, x);
    return OK;
}

/* --- articulated bodies ------------------------------------------------------------------------- */

/* --- after a step ------------------------------------------------------------------------------- */

static void tell(void *self, const struct sweep *s, double dt)
{
    const struct open_tree *o = self;
    elements_turned(o->elements, s, dt);
    if (o->follow) o->follow->note(o->follower, s, dt);
}

static bool counts(const struct open_tree *o)
{
    return o->follow || elements_turn(o->elements);
}

/* Angles in space go on to q, t; v [n of the tree]. */
static void count_turns(struct open_tree *o, const double *q, const double *v, double t)
{
    const int pieces = turns_pieces(&o->turns, q, v, t, o->follow);
    o->placed = false;
    turns_go(&o->turns, o->ops, o->sweep, pieces, tell, o);
    open_move(o, q, v);
    tell(o, o->sweep, pieces > 1 ? 0 : t - o->turns.t);
    turns_begin(&o->turns, q, t);
}

/* And sums of energy.  The coordinates stay. */
static int go_on(struct ode2 *ode, double *q, double *v, double t)
{
    struct open_tree *o = tree_of(ode);
    if (counts(o))
        count_turns(o, q, v, t);
    else
        open_move(o, q, v);
    elements_stepped(o->elements, o->sweep, &(struct instant){.t = t, .q = q, .v = v});
    return 0;
}

static const struct ode2_chart chart = {.rechart = go_on};

void open_begin(struct open_tree *o, const struct instant *x)
{
    turns_begin(&o->turns, x->q, x->t);
    elements_begin(o->elements, o->sweep, x);
}

void open_look(struct open_tree *o, struct sweep *view, const double *q, const double *v, double t)
{
    if (!counts(o)) return;
    elements_look(o->elements, view);
    if (o->follow) o->follow->look(o->follower, view);
    const int pieces = turns_pieces(&o->turns, q, v, t, o->follow);
    turns_go(&o->turns, o->ops, view, pieces, tell, o);
    o->ops->move(view, q, v, ALL);
    tell(o, view, pieces > 1 ? 0 : t - o->turns.t);
}

void open_follow(struct open_tree *o, const struct follower *follow, void *follower)
{
    o->follow = follow;
    o->follower = follower;
    o->ode.chart = &chart;
}

void open_recall(struct open_tree *o, struct recall *r)
{
    elements_recall(o->elements, r);
    if (counts(o) && recall_has(r, "counted")) turns_recall(&o->turns, r); /* other columns may not have asked */
}

/* --- kinks in time ------------------------------------------------------------------------------ */

static double next_kink(const struct ode2 *o, double t)
{
    const struct model *m = tree_of(o)->model;
    double next = INFINITY;
    for (int i = 0; i < m->nforce; i++)
        for (int k = 0; k < 3; k++) next = fmin(next, signal_next(&m->force[i].value[k], t));
    return next;
}

static int has_sides(const struct ode2 *o, double t)
{
    const struct model *m = tree_of(o)->model;
    for (int i = 0; i < m->nforce; i++)
        for (int k = 0; k < 3; k++)
            if (signal_has_sides(&m->force[i].value[k], t)) return 1;
    return 0;
}

/* --- building ----------------------------------------------------------------------------------- */

static double kinetic(const struct ode2 *ode, const double *q, const double *v, double t)
{
    struct open_tree *o = tree_of(ode);
    double T, V;
    (void)t;
    open_move(o, q, v);
    o->ops->energy(o->sweep, &T, &V);
    return T;
}

static double size_of(const struct ode2 *o, int i)
{
    return tree_of(o)->size[i];
}

/* By as much as a millionth of the mechanism. */
static enum met passed(const struct ode2 *o, const struct instant *a, const struct instant *between,
                       const struct instant *b)
{
    static const double DEEP = 1e-6;
    struct open_tree *s = tree_of(o);
    s->placed = false;
    return elements_passed(s->elements, s->sweep, a, between, b, DEEP * s->length);
}

static double edge(const struct ode2 *o, enum edge_kind *kind)
{
    return elements_edge(tree_of(o)->elements, kind);
}

static void sides(const struct ode2 *o, double *side, double *force, const struct instant *x)
{
    struct open_tree *s = tree_of(o);
    s->placed = false;
    (void)elements_sides(side, force, s->elements, s->sweep, x);
}

/* The tree, built, behind the door of ode2.h. */
static void offer(struct open_tree *o)
{
    const struct model *m = o->model;
    const bool plain = o->moves.nturn == 0 && o->moves.nfirst == m->n && m->nq == m->n;
    o->breaks = (struct ode2_breaks){.next = next_kink, .sides = has_sides};
    o->ode.self = o;
    const double first = next_kink(&o->ode, -INFINITY);
    o->ode = (struct ode2){.n = m->n,
                           .ns = m->ns,
                           .nq = m->nq,
                           .near = m->near,
                           .price = o->elastic.n ? 3 : 2, /* counted in instructions */
                           .ops = &ops,
                           .move = plain ? NULL : &move,
                           .direct = &o->direct,
                           .chart = elements_follow(o->elements) ? &chart : NULL,
                           .breaks = isinf(first) ? NULL : &o->breaks,
                           .kinetic = kinetic,
                           .size = size_of,
                           .bends = elements_may_bend(o->elements),
                           .steep = elements_may_be_steep(o->elements),
                           .workless = m->nforce == 0 && o->elastic.n == 0,
                           .passed = elements_may_be_passed(o->elements) ? passed : NULL,
                           .edge = edge,
                           .nside = elements_sides(NULL, NULL, o->elements, NULL, NULL),
                           .sides = sides,
                           .settle = o->floating.n + o->floating.ntumbler ? settle : NULL,
                           .pointwise = o->floating.n == 0 && elements_are_pointwise(o->elements),
                           .self = o};
}

void open_build(struct open_tree *o, const struct model *m, struct arena *life)
{
    o->model = m;
    o->ops = m->space == 2 ? &sweep_planar : &sweep_spatial;
    o->sweep = o->ops->build(m, FOR_STEPS, NULL, life);
    o->elements = elements_build(m, o->ops, life);
    o->diagonal = elements_are_diagonal(o->elements);
    elastic_build(&o->elastic, m, life);
    if (o->elastic.n) o->M = TAKE_MATRIX(life, double, m->n, m->n);
    moves_build(&o->moves, m, life);
    turns_build(&o->turns, m, &o->moves, life);
    floating_build(&o->floating, m, o->ops, life);
    o->d = TAKE(life, double, m->n);
    o->zero = TAKE(life, double, m->n);
    o->size = TAKE(life, double, m->n);
    sizes_fill(o->size, m);
    o->length = sizes_length(m);
    o->posture.q = TAKE(life, double, m->nq);
    o->suspect = TAKE(life, struct effect, m->nforce);
    open_direct(o, life);
    offer(o);
}
