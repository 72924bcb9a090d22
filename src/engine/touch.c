/* touch.c -- see touch.h: what all its parts share, and the run of a step from impact to impact */
#include "engine/touch.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/scalar.h"
#include "engine/accel.h"
#include "engine/motion.h"
#include "engine/touch_parts.h"

enum { MOST_IMPACTS = 50, NO_END = 20000, TRIALS = 60 };
static const double CLOSED = 1e-12; /* of a usual gap: where an impact is found */
static const double DEEP = 1e-6;    /* likewise: where one has gone through the other */
static const double SHORT = 1e-4;   /* of a step: no shorter part is looked at for what may be passed in it */
static const double DRAWN = 1e-9;   /* likewise at the start */
static const double AT_REST = 1e-9; /* of the largest velocity */

/* ---- memory ---- */

static void open_rows(struct touch_rows *o, int rows, int n, struct arena *life)
{
    o->G = TAKE_MATRIX(life, double, rows, n);
    o->b = TAKE(life, double, rows);
}

/* Displacements of different units are weighed by their usual sizes. */
static void weigh(struct touch *o)
{
    for (int i = 0; i < o->ode->n; i++) {
        const double size = o->ode->size ? o->ode->size(o->ode, i) : 1;
        o->weight[i] = size > 0 ? 1 / (size * size) : 1;
    }
}

struct touch *touch_open(struct stepper *s, struct arena *life)
{
    struct touch *o = TAKE(life, struct touch, 1);
    const struct ode2 *ode = s->ode;
    const int m = ode->contact->m, rows = ode->contact->nrow, n = ode->n;
    int **whole[] = {&o->first,   &o->on,     &o->closed,  &o->state, &o->contact,
                     &o->closed0, &o->state0, &o->closed1, &o->state1};
    double **of_rows[] = {&o->p, &o->u, &o->u1, &o->l, &o->p0, &o->p1};
    double **of_n[] = {&o->v1, &o->vm, &o->a, &o->dx, &o->r, &o->y, &o->vf, &o->weight};
    double **of_m[] = {&o->size, &o->g, &o->g0, &o->g1, &o->impulse};
    o->ode = ode;
    o->c = ode->contact;
    o->stepper = s;
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) *whole[i] = TAKE(life, int, m);
    for (size_t i = 0; i < sizeof of_rows / sizeof *of_rows; i++) *of_rows[i] = TAKE(life, double, rows);
    for (size_t i = 0; i < sizeof of_n / sizeof *of_n; i++) *of_n[i] = TAKE(life, double, n);
    for (size_t i = 0; i < sizeof of_m / sizeof *of_m; i++) *of_m[i] = TAKE(life, double, m);
    o->impacts = TAKE(life, long, m);
    o->shown = TAKE(life, struct touch_state, m);
    o->cone = TAKE(life, struct cone, m);
    o->q = TAKE(life, double, ode->nq);
    o->q1 = TAKE(life, double, ode->nq);
    o->X = TAKE_MATRIX(life, double, n, rows);
    o->W = TAKE_MATRIX(life, double, rows, rows);
    open_rows(&o->middle, rows, n, life);
    open_rows(&o->end, rows, n, life);
    matrix_open(&o->J, ode, &s->effort, life);
    matrix_open(&o->M, ode, &s->effort, life);
    single_open(&o->start, ode, life);
    single_open(&o->part, ode, life);
    for (int i = 1; i < m; i++) o->first[i] = o->first[i - 1] + 1 + o->c->of[i - 1].across;
    for (int i = 0; i < m; i++) o->size[i] = o->c->of[i].size;
    weigh(o);
    return o;
}

/* ---- the contacts that are looked at ---- */

void touch_choose(struct touch *o, double *p)
{
    o->n = o->rows = 0;
    for (int i = 0; i < o->c->m; i++) {
        if (!o->on[i]) continue;
        const int across = o->c->of[i].across;
        o->contact[o->n] = i;
        o->cone[o->n++] = (struct cone){.row = o->rows, .across = across};
        for (int j = 0; j <= across; j++) o->l[o->rows++] = p[o->first[i] + j];
    }
}

void touch_keep_impulses(struct touch *o, const double *p)
{
    zero(o->p, o->c->nrow);
    for (int k = 0; k < o->n; k++)
        for (int j = 0; j <= o->cone[k].across; j++) o->p[o->first[o->contact[k]] + j] = p[o->cone[k].row + j];
}

void touch_note(struct touch *o, struct touch_event e)
{
    if (o->nevent < MOST_EVENTS)
        o->event[o->nevent++] = e;
    else
        o->lost_events++;
}

void touch_rates(const struct touch *o, double *u, const struct touch_rows *R, const double *v)
{
    for (int i = 0; i < o->rows; i++) u[i] = dot(R->G + i * o->ode->n, v, o->ode->n) + R->b[i];
}

void touch_compliance(struct touch *o, const struct matrix *F, const double *G, const double *G1)
{
    const int n = o->ode->n, rows = o->rows;
    for (int j = 0; j < rows; j++) {
        double *X = o->X + j * n;
        copy(X, G + j * n, n);
        matrix_solve(F, X);
        for (int i = 0; i < rows; i++) o->W[i + j * rows] = dot(G1 + i * n, X, n);
    }
}

void touch_kick(const struct touch *o, double *v, const double *p)
{
    const int n = o->ode->n;
    for (int j = 0; j < o->rows; j++)
        for (int i = 0; i < n; i++) v[i] += o->X[i + j * n] * p[j];
}

static void grow(struct touch *o, const double *v)
{
    for (int i = 0; i < o->ode->n; i++) o->top = larger(o->top, fabs(v[i]));
}

/* ---- the start ---- */

static double across(const struct touch *o, const struct cone *c)
{
    return c->across ? hypot(o->u[c->row + 1], c->across > 1 ? o->u[c->row + 2] : 0) : 0;
}

/* Those that touch where the run starts. */
static void choose_drawn(struct touch *o)
{
    for (int i = 0; i < o->c->m; i++) o->on[i] = o->g[i] <= DRAWN * o->size[i];
    touch_choose(o, o->p);
}

/* Closes what touches and does not move along its gap. */
static enum status close_drawn(struct touch *o, const struct state *x, double h, struct trouble *why)
{
    grow(o, x->v);
    for (int i = 0; i < o->ode->n; i++) o->top = larger(o->top, h * fabs(x->a[i]));
    choose_drawn(o);
    if (o->n == 0) return OK;
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k];
        o->closed[i] = fabs(o->u[c->row]) <= AT_REST * o->top;
        if (o->closed[i]) o->state[i] = c->across && across(o, c) <= AT_REST * o->top ? TOUCH_STICKS : TOUCH_SLIDES;
    }
    return OK;
}

int touch_begin(struct touch *o, double *overlap, const struct state *x, double h, struct trouble *why)
{
    *overlap = 0;
    int deepest = -1;
    o->usual = h;
    if (o->c->gap(o->c, o->g, x->q, x->t, why) != OK) return -1;
    for (int i = 0; i < o->c->m; i++) {
        const double share = o->g[i] / o->size[i];
        if (share < -DRAWN && (deepest < 0 || o->g[i] < *overlap)) *overlap = o->g[deepest = i];
    }
    if (deepest >= 0) return deepest;
    return close_drawn(o, x, h, why) == OK ? -1 : 0;
}

/* ---- a step ---- */

/* What a trial may have to go back to. */
struct saved {
    double t, work[POWER_CHANNELS], lost, left, struck, top;
    int fresh, nevent, lost_events;
    double took;
};

static void save(struct saved *o, struct single *at, int *closed, int *state, double *p, const struct touch *t,
                 const struct state *x)
{
    const struct stepper *s = t->stepper;
    const size_t m = (size_t)t->c->m;
    *o = (struct saved){.t = x->t, .lost = s->lost, .left = s->left, .struck = s->struck, .top = t->top};
    o->fresh = s->fresh;
    o->nevent = t->nevent;
    o->lost_events = t->lost_events;
    o->took = t->took;
    copy(o->work, s->work, POWER_CHANNELS);
    single_save(at, t->ode, x);
    memcpy(closed, t->closed, m * sizeof *closed);
    memcpy(state, t->state, m * sizeof *state);
    copy(p, t->p, t->c->nrow);
}

static void restore(const struct saved *o, const struct single *at, const int *closed, const int *state,
                    const double *p, struct touch *t, struct state *x)
{
    struct stepper *s = t->stepper;
    const size_t m = (size_t)t->c->m;
    copy(s->work, o->work, POWER_CHANNELS);
    s->lost = o->lost;
    s->left = o->left;
    s->struck = o->struck;
    s->fresh = 1; /* its predictors have gone ahead */
    t->top = o->top;
    t->nevent = o->nevent;
    t->lost_events = o->lost_events;
    t->took = o->took;
    single_restore(at, t->ode, x, o->t);
    memcpy(t->closed, closed, m * sizeof *closed);
    memcpy(t->state, state, m * sizeof *state);
    copy(t->p, p, t->c->nrow);
}

static enum status attempt(struct touch *o, struct state *x, double h, double t1, struct trouble *why)
{
    struct stepper *s = o->stepper;
    bool any = false;
    for (int i = 0; i < o->c->m; i++) any = any || o->closed[i];
    if (any) return touch_held(o, x, h, t1, why);
    zero(o->p, o->c->nrow);
    o->took = h;
    return s->kind->step(s, x, h, 1, t1, why);
}

/* The deepest of the open ones, in usual gaps. */
static enum status deepest(struct touch *o, double *g, const struct state *x, struct trouble *why)
{
    *g = INFINITY;
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    for (int i = 0; i < o->c->m; i++)
        if (!o->closed[i]) *g = smaller(*g, o->g[i] / o->size[i]);
    return OK;
}

/* Of a step that has gone too deep, the part that ends where the first gap is 0, by Illinois' rule of false position. */
static enum status locate(struct touch *o, struct state *x, const struct saved *from, double h, double deep, double g0,
                          struct trouble *why)
{
    double lo = 0, hi = h, glo = larger(g0, 0), ghi = deep, g = deep;
    int side = 0;
    for (int k = 0; k < TRIALS && fabs(g) > CLOSED && hi - lo > 4 * DBL_EPSILON * (fabs(from->t) + h); k++) {
        double part = glo > 0 ? lo + (hi - lo) * glo / (glo - ghi) : .5 * (lo + hi);
        part = larger(lo + 1e-3 * (hi - lo), smaller(part, hi - 1e-6 * (hi - lo)));
        restore(from, &o->part, o->closed1, o->state1, o->p1, o, x);
        TRY(attempt(o, x, part, from->t + part, why));
        TRY(deepest(o, &g, x, why));
        if (g > 0) {
            lo = part;
            glo = g;
            if (side == 1) ghi /= 2;
            side = 1;
        } else {
            hi = part;
            ghi = g;
            if (side == -1) glo /= 2;
            side = -1;
        }
    }
    return OK;
}

/* Contacts that were closed in the part of the step that was taken. */
static enum status renew(struct touch *o, const struct state *x, struct trouble *why)
{
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    for (int i = 0; i < o->c->m; i++) o->on[i] = o->closed[i];
    touch_choose(o, o->p);
    if (o->n == 0) return OK;
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k], was = o->state[i];
        const double ut = across(o, c);
        o->impulse[i] += o->l[c->row];
        if (!(o->l[c->row] > 0) && (o->u[c->row] > CLOSED * o->top || o->g[i] > CLOSED * o->size[i])) {
            o->closed[i] = 0;
            o->state[i] = TOUCH_OPEN;
            touch_note(o, (struct touch_event){.what = TOUCH_OPENS, .contact = i, .t = x->t});
            continue;
        }
        o->state[i] = c->across && ut <= AT_REST * o->top ? TOUCH_STICKS : TOUCH_SLIDES;
        if (c->across && o->state[i] != was)
            touch_note(o,
                       (struct touch_event){.what = was == TOUCH_STICKS ? TOUCH_STARTS_SLIDING : TOUCH_STARTS_STICKING,
                                            .contact = i,
                                            .t = x->t});
    }
    return OK;
}

/* The impact of all that touches and comes nearer, if there is any. */
static enum status strike(struct touch *o, struct state *x, double h, int *count, struct trouble *why)
{
    int any = 0;
    for (int i = 0; i < o->c->m; i++) o->on[i] = !o->closed[i] && o->g[i] <= 2 * CLOSED * o->size[i];
    for (int i = 0; i < o->c->m; i++) any |= o->on[i];
    if (!any) return OK;
    touch_choose(o, o->p);
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    any = 0;
    for (int k = 0; k < o->n; k++) any |= o->u[o->cone[k].row] < 0;
    if (!any) return OK;
    memcpy(o->closed1, o->on, sizeof *o->on * (size_t)o->c->m);
    if (++*count > NO_END) return trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, x->t);
    return touch_impact(o, x, h, o->closed1, *count > MOST_IMPACTS, why);
}

/* May a gap that is open at both ends of the step h from o->part to x have been closed in between?  Where it falls at first and
 * grows at last it is above both its tangents, if it is convex as that of two balls is. */
static enum status may_have_passed(struct touch *o, bool *passed, const struct state *x, double t0, double h,
                                   struct trouble *why)
{
    bool any = false;
    *passed = false;
    for (int i = 0; i < o->c->m; i++) {
        const double far = 4 * h * o->top * larger(1, o->size[i]);
        o->on[i] = !o->closed[i] && smaller(o->g0[i], o->g[i]) < far;
        any |= o->on[i];
    }
    if (!any) return OK;
    touch_choose(o, o->p);
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, o->part.q, t0, why));
    touch_rates(o, o->u1, &o->end, o->part.v);
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    for (int k = 0; k < o->n; k++) {
        const double a = o->u1[o->cone[k].row], b = o->u[o->cone[k].row];
        const double g0 = o->g0[o->contact[k]], g1 = o->g[o->contact[k]];
        *passed |= a < 0 && b > 0 && g0 + a * (g1 - g0 - b * h) / (a - b) < 0;
    }
    return OK;
}

/* What pushes into what cannot give way, as a drive does, ends the run. */
static enum status none_is_deep(const struct touch *o, double t, struct trouble *why)
{
    for (int i = 0; i < o->c->m; i++)
        if (o->g[i] < -DEEP * o->size[i]) return trouble_set(why, TROUBLE_CONTACT, i, INFINITY, t);
    return OK;
}

/* From impact to impact to t1. */
static enum status parts(struct touch *o, struct state *x, double h, double t1, struct trouble *why)
{
    int impacts = 0;
    double most = INFINITY;
    struct saved from;
    o->hardest = 0;
    while (x->t < t1) {
        double g0, g1, left = smaller(t1 - x->t, most);
        const double end = left < t1 - x->t ? x->t + left : t1;
        bool passed = false;
        if (fabs(left - h) <= 1e-9 * h) left = h;
        TRY(deepest(o, &g0, x, why));
        copy(o->g0, o->g, o->c->m);
        save(&from, &o->part, o->closed1, o->state1, o->p1, o, x);
        TRY(attempt(o, x, left, end, why));
        TRY(deepest(o, &g1, x, why));
        grow(o, x->v);
        if (g1 >= -CLOSED && left > SHORT * h) TRY(may_have_passed(o, &passed, x, from.t, left, why));
        if (passed) {
            restore(&from, &o->part, o->closed1, o->state1, o->p1, o, x);
            most = left / 2;
            continue;
        }
        most = INFINITY;
        if (g1 < -CLOSED) TRY(locate(o, x, &from, left, g1, g0, why));
        grow(o, x->v);
        TRY(renew(o, x, why));
        TRY(strike(o, x, h, &impacts, why));
        TRY(none_is_deep(o, x->t, why));
        if (t1 - x->t <= 1e-12 * h) x->t = t1;
    }
    return OK;
}

/* What touches at the start and comes nearer. */
static enum status begin(struct touch *o, struct state *x, double h, struct trouble *why)
{
    int any = 0;
    o->begun = 1;
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    choose_drawn(o);
    if (o->n == 0) return OK;
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    for (int k = 0; k < o->n; k++) any |= !o->closed[o->contact[k]] && o->u[o->cone[k].row] < 0;
    if (!any) return OK;
    memcpy(o->closed1, o->on, sizeof *o->on * (size_t)o->c->m);
    return touch_impact(o, x, h, o->closed1, 0, why);
}

enum status touch_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct touch *o = s->touch;
    const double t0 = x->t;
    const long minors = s->effort.minors, all = o->all;
    const int begun = o->begun;
    struct saved from;
    enum status status = OK;
    save(&from, &o->start, o->closed0, o->state0, o->p0, o, x);
    for (int i = 0; i < o->c->m; i++) o->shown[i].impulse = o->impulse[i], o->shown[i].impacts = o->impacts[i];
    if (!o->begun) status = begin(o, x, h, why);
    for (int k = 1; k <= ratio && status == OK; k++) status = parts(o, x, h, k < ratio ? t0 + k * h : to, why);
    s->effort.minors = minors + (status == OK ? ratio : 0);
    if (status == OK) return OK;
    restore(&from, &o->start, o->closed0, o->state0, o->p0, o, x);
    for (int i = 0; i < o->c->m; i++) o->impulse[i] = o->shown[i].impulse, o->impacts[i] = o->shown[i].impacts;
    o->all = all;
    o->begun = begun;
    return status;
}

enum status touch_driven(struct touch *o, const struct state *x, struct trouble *why)
{
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    return none_is_deep(o, x->t, why);
}

/* ---- for records ---- */

const struct touch_state *touch_state(const struct touch *o, int i)
{
    struct touch_state *s = &o->shown[i];
    *s = (struct touch_state){.state = o->state[i], .impulse = o->impulse[i], .impacts = o->impacts[i]};
    for (int j = 0; j <= o->c->of[i].across && o->took > 0; j++) s->force[j] = o->p[o->first[i] + j] / o->took;
    return s;
}

int touch_events(const struct touch *o, const struct touch_event **list)
{
    *list = o->event;
    return o->nevent;
}

void touch_clear(struct touch *o)
{
    o->nevent = o->lost_events = 0;
}

long touch_impacts(const struct touch *o)
{
    return o->all;
}

bool touch_pushed(const struct touch *o)
{
    for (int i = 0; i < o->c->m; i++)
        if (o->impulse[i] != 0) return true;
    return false;
}

void touch_recall(struct touch *o, struct recall *r)
{
    recall_within(r, "touch");
    recall_one(r, "begun", o->begun);
    recall_list(r, "closed", o->closed, o->c->m);
    recall_list(r, "state", o->state, o->c->m);
    recall_list(r, "p", o->p, o->c->nrow);
    recall_one(r, "took", o->took);
    recall_one(r, "hfactor", o->hfactor);
    recall_list(r, "impulse", o->impulse, o->c->m);
    recall_list(r, "impacts", o->impacts, o->c->m);
    recall_one(r, "all", o->all);
    recall_one(r, "top", o->top);
    recall_list(r, "size", o->size, o->c->m);
    recall_list(r, "weight", o->weight, o->ode->n); /* usual sizes are those of the start */
    (void)matrix_recall(&o->J, r);
    recall_without(r);
}
