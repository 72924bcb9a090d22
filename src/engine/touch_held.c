/* touch_held.c -- a step of the midpoint rule in which closed contacts push; see touch.h */
#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "engine/touch_parts.h"

enum { LIMIT = 60, RENEW = 6 };
static const double EXACT = 1e-15, ENOUGH = 1e-11, STILL = 1e-13; /* of the largest velocity */
static const double SOON = 1e-3;                                  /* of a usual step */
static const double ROUGH = 4 * DBL_EPSILON;                      /* of usual gaps */
static const double NOISE = 64;                                   /* round-offs of a gap */

/* Where v1 leads: the instant in the middle, and the end. */
static struct instant place(struct touch *o, const struct state *x, double h, double t1)
{
    const int n = o->ode->n;
    for (int i = 0; i < n; i++) {
        o->vm[i] = .5 * (x->v[i] + o->v1[i]);
        o->a[i] = (o->v1[i] - x->v[i]) / h;
        o->dx[i] = h * o->vm[i];
    }
    const double middle = x->t + .5 * (t1 - x->t);
    motion_point(o->ode, o->q, x->q, o->dx, .5, middle);
    motion_point(o->ode, o->q1, x->q, o->dx, 1, t1);
    return (struct instant){.t = middle,
                            .q = o->q,
                            .v = o->vm,
                            .a = o->a,
                            .qa = x->q,
                            .qb = o->ode->pointwise ? NULL : o->q1,
                            .ta = x->t,
                            .tb = t1};
}

/* The row G in the middle such that it does exactly the change of the gap; `size` is that of the displacement, squared.
 * Where that is a matter of round-off of gaps, or of an iterate that is far off, the row stays: along a displacement that
 * is next to nothing it would turn by much. */
static void correct_row(const struct touch *o, double *G, double change, double size, double rough)
{
    static const double MOST = .1; /* of the row */
    const int n = o->ode->n;
    const double off = change - dot(G, o->dx, n);
    if (fabs(off) <= rough) return;
    double own = 0;
    for (int j = 0; j < n; j++) own += G[j] * G[j] / o->weight[j];
    if (off * off > MOST * MOST * own * size) return;
    for (int j = 0; j < n; j++) G[j] += off / size * o->weight[j] * o->dx[j];
}

static void correct_normals(struct touch *o, double h)
{
    const int n = o->ode->n;
    double size = 0;
    for (int i = 0; i < n; i++) size += o->weight[i] * o->dx[i] * o->dx[i];
    if (!(size > DBL_MIN)) return;
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k], row = o->cone[k].row;
        const double change = o->g1.gap[i] - o->g0.gap[i] - h * o->middle.b[row];
        correct_row(o, o->middle.G + row * n, change, size, ROUGH * o->size[i]);
    }
}

/* Is a part of a step so short that round-off of gaps over it would be speeds?  Then rates at its end are held, not gaps, as
 * in an impact: what comes nearer along them loses its energy. */
static bool is_short(const struct touch *o, double h)
{
    static const double SPEED = 1e-8; /* of the largest velocity */
    return touch_noise(o, h) > SPEED * o->top;
}

static enum status rows_there(struct touch *o, const struct instant *x, double h, struct trouble *why)
{
    const struct ode2_contact *c = o->c;
    TRY(c->gap(o->c, &o->g1, o->reach, o->q1, x->tb, why));
    TRY(c->rows(o->c, o->middle.G, o->middle.b, o->contact, o->n, o->q, x->t, why));
    TRY(c->rows(o->c, o->end.G, o->end.b, o->contact, o->n, o->q1, x->tb, why));
    if (!is_short(o, h)) correct_normals(o, h);
    return OK;
}

/* Do steps go by tolerance? */
static bool is_tolerant(const struct touch *o)
{
    return o->stepper->options.tolerance > 0;
}

/* What an impact was found beside its place is mended soon behind it, but not in a part of next to no length: that
 * would take any speed. So what lies deeper, as one impact leaves it beside another, takes a usual step. With steps by tolerance,
 * which may be of any length, it stays. */
static double left_open(const struct touch *o, int i, double h)
{
    const double most = 2 * TOUCH_CLOSED * o->size[i], left = smaller(most, o->g0.gap[i]);
    const double soon = (left < -most ? 1 : SOON) * o->usual;
    if (is_tolerant(o)) return left;
    return h < soon ? (1 - h / soon) * left : 0;
}

double touch_noise(const struct touch *o, double h)
{
    double size = 0;
    for (int k = 0; k < o->n; k++) size = larger(size, larger(1, o->cone[k].mu) * o->size[o->contact[k]]);
    return DBL_EPSILON * size / h;
}

/* Of rates. */
static double roughness(const struct touch *o, double h)
{
    return is_short(o, h) ? 0 : NOISE * touch_noise(o, h);
}

/* Across two directions the way turns: of what slides well friction goes by the way in the middle of the step, that at its end is
 * of first order. */
static void turn_ways(const struct touch *o, double h)
{
    static const double WELL = 8; /* times what friction makes of it in a step */
    const int n = o->ode->n;
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k], row = c->row + 1;
        if (c->across < 2 || c->slides || o->state[i] != TOUCH_SLIDES || !(o->took > 0)) continue;
        double mid[2], end[2];
        for (int j = 0; j < 2; j++) {
            mid[j] = dot(o->middle.G + (row + j) * n, o->vm, n) + o->middle.b[row + j];
            end[j] = dot(o->end.G + (row + j) * n, o->v1, n) + o->end.b[row + j];
        }
        const double push = o->p[o->first[i]] * (h / o->took), w = o->W[row + row * o->rows];
        if (hypot(mid[0], mid[1]) <= WELL * c->mu * push * w) continue;
        for (int j = 0; j < 2; j++) o->u[row + j] += 2 * mid[j] - end[j];
    }
}

/* One correction of v1 and p; *err: how large, of velocities. */
static enum status correct(struct touch *o, double *err, struct instant *x, double h, int count, struct trouble *why)
{
    struct effort *effort = &o->stepper->effort;
    const int n = o->ode->n;
    TRY(o->ode->ops->resid(o->ode, o->r, NULL, NULL, x, ALL, why));
    effort->slow++;
    effort->fast++;
    effort->sweeps++;
    if (count % RENEW == 0 && (count > 0 || o->hfactor != h)) {
        TRY(matrix_factor(&o->J, h / 2, h * h / 4, x, why));
        o->hfactor = h;
    }
    TRY(rows_there(o, x, h, why));
    TRY(touch_press(o, x, h, count, why));
    touch_compliance(o, &o->J, o->middle.G, o->end.G);
    copy(o->y, o->r, n);
    matrix_solve(&o->J, o->y);
    for (int i = 0; i < n; i++) o->vf[i] = o->v1[i] - h * o->y[i];
    if (count == 0) touch_grow(o, o->vf); /* without contacts: so of what nothing has moved yet, too */
    touch_rates(o, o->u, &o->end, o->vf);
    for (int k = 0; k < o->n && !is_short(o, h); k++) {
        const int row = o->cone[k].row;
        o->u[row] += 2 / h * (o->g1.gap[o->contact[k]] - left_open(o, o->contact[k], h)) -
                     dot(o->end.G + row * n, o->v1, n) - o->end.b[row];
    }
    turn_ways(o, h);
    const double size = larger(o->top, DBL_MIN);
    if (!cone_solve(o->l, o->W, o->u, o->cone, o->n, o->rows, size, roughness(o, h), &o->work))
        return trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, x->tb);
    touch_kick(o, o->vf, o->l);
    *err = 0;
    for (int i = 0; i < n; i++) {
        const double d = fabs(o->vf[i] - o->v1[i]);
        *err = d <= *err ? *err : d; /* what is not a number stays */
        o->v1[i] = o->vf[i];
    }
    return isfinite(*err) ? OK : trouble_set(why, TROUBLE_CONTACT, o->contact[0], *err, x->tb);
}

bool touch_pressed_so(const struct touch *o)
{
    static const double OFF = 1e-3;
    double most = 0, off = 0;
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        if (!o->c->of[i].joint) continue;
        most = larger(most, o->N[i]);
        off = larger(off, fabs(o->off[i]));
    }
    return off <= OFF * most;
}

static enum status iterate(struct touch *o, struct instant *at, const struct state *x, double h, double t1,
                           struct trouble *why)
{
    const double rough = roughness(o, h);
    double err = INFINITY, least = INFINITY;
    for (int k = 0, since = 0; k < LIMIT; k++) {
        *at = place(o, x, h, t1);
        TRY(correct(o, &err, at, h, k, why));
        const double size = larger(o->top, DBL_MIN);
        since = err < .9 * least ? 0 : since + 1;
        least = smaller(least, err);
        const bool still = err <= EXACT * size || (err <= ENOUGH * size + rough && since > 1);
        if (still && touch_pressed_so(o)) return OK;
    }
    return trouble_set(why, TROUBLE_CONTACT, o->contact[0], err, t1);
}

/* Works: of all else, of friction, of what drives the surfaces. */
static enum status book(struct touch *o, struct instant *at, double h, struct trouble *why)
{
    struct stepper *s = o->stepper;
    double w[POWER_CHANNELS], rub = 0;
    TRY(o->ode->ops->resid(o->ode, o->r, w, NULL, at, ALL, why));
    s->effort.slow++;
    s->effort.fast++;
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += h * w[c];
    touch_rates(o, o->u, &o->middle, o->vm);
    for (int k = 0; k < o->n; k++)
        for (int j = 1; j <= o->cone[k].across; j++) rub += o->l[o->cone[k].row + j] * o->u[o->cone[k].row + j];
    for (int k = 0; k < o->n && is_short(o, h); k++) s->struck -= o->l[o->cone[k].row] * o->u[o->cone[k].row];
    s->work[POWER_FRICTION] += rub;
    s->work[POWER_DRIVE] -= dot(o->l, o->middle.b, o->rows);
    return OK;
}

/* Has it closed a gap that an impact had left? */
static bool has_mended(const struct touch *o)
{
    for (int k = 0; k < o->n && !is_tolerant(o); k++) {
        const int i = o->contact[k];
        if (fabs(o->g0.gap[i]) > 1e-2 * TOUCH_CLOSED * o->size[i]) return true;
    }
    return false;
}

/* Held along its gap, and across it where it sticks; where it slides, friction is that of what holds it. */
static void hold(const struct touch *o, struct cone *c, int contact)
{
    const double *u = o->u + c->row + 1, *way = o->way + 2 * contact;
    const double slip = touch_slip(o->u, c);
    c->held = true;
    if (touch_sticks(o, o->u, c)) return;
    if (o->c->of[contact].joint) c->across = 0;
    c->slides = true;
    c->mu = o->c->of[contact].sliding;
    for (int j = 0; j < c->across; j++) c->slide[j] = o->forced[contact] ? way[j] : u[j] / slip;
}

/* What friction has done of what has been taken is no impact's. */
static void book_rubbing(struct touch *o)
{
    double rub = 0;
    for (int k = 0; k < o->n; k++)
        for (int j = 1, i = o->cone[k].row + 1; o->cone[k].slides && j <= o->cone[k].across; j++, i++)
            rub += .5 * o->l[i] * (o->u[i] + o->u1[i]);
    o->stepper->struck += rub;
    o->stepper->work[POWER_FRICTION] += rub;
}

/* Takes what is left of the rates along rows that push and stick.  Such as stick within round-off slip by as much: where
 * rows say nearly the same, as of a foot beside a corner, they contradict each other by that. */
static enum status settle(struct touch *o, double h, double t1, struct trouble *why)
{
    const struct state there = {t1, o->q1, o->v1, o->a};
    double most = 0, rough = roughness(o, h);
    const bool mended = o->took == 0 || has_mended(o);
    touch_keep(o);
    int n = 0;
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        if (o->l[o->cone[k].row] > 0 || o->c->of[i].joint) o->contact[n++] = i;
    }
    touch_choose(o, n);
    TRY(touch_look(o, o->u, &o->end, &there, why));
    for (int k = 0; k < o->n; k++) {
        struct cone *c = &o->cone[k];
        hold(o, c, o->contact[k]);
        if (!c->slides) rough = larger(rough, touch_slip(o->u, c));
        most = larger(most, fabs(o->u[c->row]));
    }
    if (o->n == 0 || most <= (mended ? 0 : STILL) * o->top) return OK; /* right behind an impact, to 0 */
    TRY(touch_mass(o, &there, why));
    zero(o->l, o->rows);
    bool found = cone_solve(o->l, o->W, o->u, o->cone, o->n, o->rows, o->top, 0, &o->work);
    if (!found) {
        zero(o->l, o->rows);
        found = cone_solve(o->l, o->W, o->u, o->cone, o->n, o->rows, o->top, rough, &o->work);
    }
    if (!found) return trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, t1);
    copy(o->vf, o->v1, o->ode->n);
    touch_kick(o, o->vf, o->l);
    touch_rates(o, o->u1, &o->end, o->vf);
    touch_strike(o, o->q1, o->v1, t1);
    book_rubbing(o);
    return OK;
}

static void force(const struct touch *o, struct cone *c, int contact)
{
    c->sticks = o->state[contact] == TOUCH_STICKS;
    c->slides = !c->sticks;
    for (int j = 0; j < c->across; j++) c->slide[j] = o->way[2 * contact + j];
}

enum status touch_held(struct touch *o, struct state *x, double h, double t1, struct trouble *why)
{
    const struct ode2 *ode = o->ode;
    struct instant at;
    touch_choose_closed(o);
    if (o->took != h)
        for (int i = 0; i < o->rows; i++) o->l[i] *= o->took > 0 ? h / o->took : 0;
    for (int k = 0; k < o->n; k++) {
        const struct ode2_touch *of = &o->c->of[o->contact[k]];
        o->cone[k].mu = o->state[o->contact[k]] == TOUCH_STICKS ? of->holding : of->sliding;
        o->cone[k].preload = h * of->preload;
        if (o->forced[o->contact[k]]) force(o, &o->cone[k], o->contact[k]);
    }
    TRY(o->c->gap(o->c, &o->g0, o->reach, x->q, x->t, why));
    copy(o->v1, x->v, ode->n);
    for (int i = 0; i < ode->n && !o->stepper->fresh; i++) o->v1[i] += h * x->a[i];
    TRY(iterate(o, &at, x, h, t1, why));
    TRY(book(o, &at, h, why));
    at = place(o, x, h, t1);
    TRY(settle(o, h, t1, why));
    copy(x->q, o->q1, ode->nq);
    copy(x->v, o->v1, ode->n);
    copy(x->a, o->a, ode->n);
    x->t = t1;
    o->took = h;
    o->stepper->fresh = 0;
    return OK;
}
