/* touch_forces.c -- forces of closed contacts at an instant: with
 *
 *     a = M^-1 (Q + G' f),   G a + G. v + b. >= 0, f_n >= 0, one of them 0
 *
 * and the friction of what sticks or slides there.  G. v + b. is a difference along the motion. */
#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/accel.h"
#include "engine/motion.h"
#include "engine/touch_parts.h"

enum { PASSES = 60 };
static const double ROUND_OFF = 1e-14;

/* c [rows] += sign (G v + b) at q (+) s v, t + s. */
static enum status add_rates(struct touch *o, double *c, const struct state *x, double s, double sign,
                             struct trouble *why)
{
    const struct state there = {x->t + s, o->q1, x->v, x->a};
    for (int i = 0; i < o->ode->n; i++) o->dx[i] = s * x->v[i]; /* a part of v itself would turn by another angle */
    motion_point(o->ode, o->q1, x->q, o->dx, 1, there.t);
    TRY(touch_look(o, o->u1, &o->middle, &there, why));
    for (int i = 0; i < o->rows; i++) c[i] += sign * o->u1[i];
    return OK;
}

/* What round-off of rates makes of their difference over 2 d, in accelerations: rows of points of one body, more than it
 * needs, agree no better. */
static double noise(const struct touch *o, const struct state *x, double d)
{
    double most = 0;
    for (int i = 0; i < o->rows; i++) {
        double sum = fabs(o->end.b[i]);
        for (int j = 0; j < o->ode->n; j++) sum += fabs(o->end.G[i * o->ode->n + j] * x->v[j]);
        most = larger(most, sum);
    }
    return 8 * DBL_EPSILON * most / d;
}

static void directions(struct touch *o)
{
    for (int k = 0; k < o->n; k++) {
        struct cone *c = &o->cone[k];
        const struct ode2_touch *of = &o->c->of[o->contact[k]];
        const double *u = o->u + c->row + 1;
        const double size = touch_slip(o->u, c), *way = o->way + 2 * o->contact[k];
        c->slides = o->state[o->contact[k]] == TOUCH_SLIDES;
        c->mu = c->slides ? of->sliding : of->holding;
        c->preload = of->preload;
        c->sticks = o->forced[o->contact[k]] && !c->slides;
        for (int j = 0; j < c->across && c->slides; j++) /* what has just let go has no speed yet */
            c->slide[j] = touch_sticks(o, o->u, c) ? way[j] : u[j] / size;
    }
}

/* l; joints that rub are pressed by what they themselves do, too. */
static enum status find(struct touch *o, bool *found, const struct state *x, double size, double rough,
                        struct trouble *why)
{
    const int most = o->c->bound ? PASSES : 1;
    double moved = INFINITY;
    for (int k = 0; k < most && moved > ROUND_OFF; k++) {
        copy(o->y, o->a, o->ode->n);
        touch_kick(o, o->y, o->l);
        const struct instant at = {.t = x->t, .q = x->q, .v = x->v, .a = o->y, .ta = x->t, .tb = x->t};
        copy(o->u1, o->l, o->rows);
        TRY(touch_press(o, &at, 1, k, why));
        *found = cone_solve(o->l, o->W, o->u, o->cone, o->n, o->rows, size, rough, &o->work);
        if (!*found) return OK;
        double most_l = DBL_MIN;
        moved = 0;
        for (int i = 0; i < o->rows; i++) {
            moved = larger(moved, fabs(o->l[i] - o->u1[i]));
            most_l = larger(most_l, fabs(o->l[i]));
        }
        moved /= most_l;
    }
    return OK;
}

/* l, where there are none at an instant, as of a rod that jams: the means over the last step. */
static void last_means(struct touch *o)
{
    touch_choose_closed(o);
    for (int i = 0; i < o->rows; i++) o->l[i] = o->took > 0 ? o->l[i] / o->took : 0;
}

enum status touch_forces(struct touch *o, double *f, const struct state *x, struct trouble *why)
{
    const double d = 1e-4 * o->usual;
    zero(f, o->c->nrow);
    o->jammed = false;
    touch_choose_closed(o);
    if (o->n == 0) return OK;
    TRY(touch_look(o, o->u, &o->end, x, why));
    TRY(touch_mass(o, x, why));
    TRY(accel_solve(o->stepper->accel, o->a, NULL, x->q, x->v, x->t, why));
    directions(o);
    zero(o->l, o->rows);
    TRY(add_rates(o, o->l, x, d, 1, why));
    TRY(add_rates(o, o->l, x, -d, -1, why));
    double size = DBL_MIN;
    for (int i = 0; i < o->rows; i++) {
        o->u[i] = dot(o->end.G + i * o->ode->n, o->a, o->ode->n) + o->l[i] / (2 * d);
        size = larger(size, fabs(o->u[i]));
    }
    zero(o->l, o->rows);
    bool found;
    o->rough = noise(o, x, d);
    TRY(find(o, &found, x, size, o->rough, why));
    o->jammed = !found;
    if (!found) last_means(o);
    touch_spread(o, f);
    return OK;
}

enum status touch_accelerations(struct touch *o, struct state *x, struct trouble *why)
{
    TRY(touch_forces(o, o->held, x, why));
    if (o->n == 0) return accel_solve(o->stepper->accel, x->a, NULL, x->q, x->v, x->t, why);
    copy(x->a, o->a, o->ode->n);
    touch_kick(o, x->a, o->l);
    return OK;
}

/* ---- where drives move everything: rates are what drives make of them, b ---- */

static void grow_by_rates(struct touch *o)
{
    for (int i = 0; i < o->rows; i++) o->top = larger(o->top, fabs(o->u[i]));
}

enum status touch_driven_at(struct touch *o, const struct state *x, struct trouble *why)
{
    touch_choose_closed(o);
    if (o->n == 0) return OK;
    TRY(touch_look(o, o->u, &o->end, x, why));
    grow_by_rates(o);
    for (int k = 0; k < o->n; k++) touch_set_slip(o, o->contact[k], o->u, &o->cone[k]);
    TRY(touch_forces(o, o->held, x, why));
    if (o->jammed || !touch_pressed_so(o)) return trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, x->t);
    touch_keep(o);
    o->took = 1;
    return OK;
}

enum status touch_driven_power(struct touch *o, double *w, const struct state *x, struct trouble *why)
{
    TRY(touch_driven_at(o, x, why));
    for (int k = 0; k < o->n; k++)
        for (int j = 1, i = o->cone[k].row + 1; j <= o->cone[k].across; j++, i++)
            w[POWER_FRICTION] += o->l[i] * o->end.b[i];
    w[POWER_DRIVE] -= dot(o->l, o->end.b, o->rows);
    return OK;
}
