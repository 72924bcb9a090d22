/* remainder.c -- the work that a stored energy misses over an interval, of third order in its length h.
 *
 * A remainder E goes to the rotations u_k that change the measure,
 *
 *     Q_k += E u_k / (h u.u),
 *
 * where only flexible bodies change it, to their coordinates: Gonzalez, J. Nonlinear Sci. 6 (1996) 449, with this choice
 * of the direction dq.  Between bodies of two trees that fly, of which the roots turn, too, that would push both from
 * outside; and where a tree of several bodies flies its root goes beside its own motion (open/floating.h), so that E does
 * not vanish with the root's turn.  There it goes along the relative motion of the bodies themselves, velocity v of the second against the first
 * at the middle c of the points, and w, as a force and a torque and their opposites,
 *
 *     F = E v / (h N),   n = E l^2 w / (h N),   N = v.v + l^2 w.w,
 *
 * l^2 being the squares of the lever arms of bodies and of the distance: momenta are kept, and it is the same in every frame and
 * from either body.  Where the bodies do not move against each other, nothing is missing. */
#include <float.h>
#include <math.h>

#include "force/parts.h"
#include "la/vec3.h"

/* A turn in a step: E is of third order in it, and that of less is not round-off of what there is but of nothing. */
static const double LEAST_TURN = 1e-7;

static void give_to_rotations(double *r, const struct part_of *p, double E, const struct instant *x)
{
    double h = x->tb - x->ta, vv = 0;
    for (int i = 0; i < p->nturn; i++) vv += x->v[p->turn[i]] * x->v[p->turn[i]];
    if (!(h * h * vv > LEAST_TURN * LEAST_TURN)) return;
    for (int i = 0; i < p->nturn; i++) r[p->turn[i]] -= E / (h * vv) * x->v[p->turn[i]];
}

/* Velocity at c of a frame that moves with the body; its lever arm's square, of the ground 0: it has no place of its own. */
static double velocity_at(double *v, const struct pose *b, bool ground, const double *c, const double *at)
{
    double arm[3], lever[3];
    v3_diff(arm, c, b->r);
    v3_cross(v, b->w, arm);
    v3_add(v, b->v);
    v3_diff(lever, at, b->r);
    return ground ? 0 : v3_dot(lever, lever);
}

static void give_to_pair(const struct elements *e, struct sweep *s, const struct part_of *p, double E, double h,
                         const double *at_a, const double *at_b)
{
    struct pose a, b;
    double c[3], d[3], v[3], va[3], w[3], ll;
    e->ops->pose(s, &a, p->a);
    e->ops->pose(s, &b, p->b);
    v3_sum(c, at_a, at_b);
    v3_scale(c, .5, c);
    v3_diff(d, at_b, at_a);
    ll = v3_dot(d, d) + velocity_at(va, &a, p->a == 0, c, at_a) + velocity_at(v, &b, p->b == 0, c, at_b);
    v3_take(v, va);
    v3_diff(w, b.w, a.w);
    const double N = v3_dot(v, v) + ll * v3_dot(w, w);
    if (!(h * h * N > LEAST_TURN * LEAST_TURN * ll)) return;
    for (int side = 1; side >= -1; side -= 2) {
        double F[3], n[3];
        v3_scale(F, side * E / (h * N), v);
        v3_scale(n, side * E * ll / (h * N), w);
        e->ops->push(s, side > 0 ? p->b : p->a, c, F);
        e->ops->twist(s, side > 0 ? p->b : p->a, n);
    }
}

void give_remainder(const struct elements *e, struct sweep *s, double *r, const struct part_of *p, double E,
                    double scale, const double *at_a, const double *at_b, const struct instant *x)
{
    const double h = x->tb - x->ta;
    if (fabs(E) <= 64 * DBL_EPSILON * scale || h == 0) return;
    if (p->a != p->b)
        give_to_pair(e, s, p, E, h, at_a, at_b);
    else
        give_to_rotations(r, p, E, x);
}
