/* motion.h -- how the engine moves positions: through ode2_move, or q0 + s dx without one. */
#ifndef FMDSUB_ENGINE_MOTION_H
#define FMDSUB_ENGINE_MOTION_H

#include <float.h>
#include <math.h>
#include <string.h>

#include "la/vector.h"
#include "system/ode2.h"

/* q1 = q0 (+) s dx, at time t; q1 may be q0. */
static inline void motion_point(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s,
                                double t)
{
    if (o->move)
        o->move->point(o, q1, q0, dx, s, t);
    else
        vector_move(q1, q0, s, dx, o->n);
}

/* The same for an iterate that is itself to be corrected, by motion_again().  Are loops left open? */
static inline bool motion_first(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s,
                                double t)
{
    if (o->move && o->move->first) return o->move->first(o, q1, q0, dx, s, t);
    motion_point(o, q1, q0, dx, s, t);
    return false;
}

/* The same, to round-off, where q1 holds it for another dx; open, and what is returned: as again() has it. */
static inline bool motion_again(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s,
                                double t, int open)
{
    if (o->move && o->move->again) return o->move->again(o, q1, q0, dx, s, t, open);
    motion_point(o, q1, q0, dx, s, t);
    return false;
}

/* The same, where q1 holds a posture nearby. */
static inline void motion_onward(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s,
                                 double t, int open)
{
    if (o->move && o->move->onward)
        o->move->onward(o, q1, q0, dx, s, t, open);
    else
        motion_point(o, q1, q0, dx, s, t);
}

/* dx with q1 = q0 (+) dx. */
static inline void motion_diff(const struct ode2 *o, double *dx, const double *q1, const double *q0)
{
    if (o->move)
        o->move->diff(o, dx, q1, q0);
    else
        vector_move(dx, q1, -1, q0, o->n);
}

/* dx' where q1 = q0 (+) dx moves with velocity v at time t. */
static inline void motion_rate(const struct ode2 *o, double *rate, const double *q1, const double *q0, const double *dx,
                               const double *v, double t)
{
    if (o->move)
        o->move->rate(o, rate, q1, q0, dx, v, t);
    else
        memcpy(rate, v, (size_t)o->n * sizeof *v);
}

/* What the straight way h v of a step misses of rotations, as bend() has it; false: nothing, off is not set. */
static inline bool motion_bend(const struct ode2 *o, double *off, const double *v, const double *a, int order)
{
    if (!o->move || !o->move->bend) return false;
    o->move->bend(o, off, v, a, order);
    return true;
}

/* A time right behind a corner at t, on the way to `to`: farther than the round-off in which owners take t for the
 * corner's own time. */
static inline double motion_behind(double t, double to)
{
    const double least = nextafter(t, to), far = t + (to > t ? 16 : -16) * DBL_EPSILON * fabs(t);
    return fabs(far - t) > fabs(least - t) ? far : least;
}

/* Does what is told of time change at t, and is it asked for there? */
static inline int motion_sides(const struct ode2 *o, double t)
{
    return o->breaks && o->breaks->sides && o->breaks->sides(o, t);
}

static inline void copy(double *to, const double *from, int n)
{
    memcpy(to, from, (size_t)n * sizeof *to);
}

static inline void zero(double *x, int n)
{
    memset(x, 0, (size_t)n * sizeof *x);
}

static inline double dot(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * y[i];
    return sum;
}

/* u [n] := the displacement at the part x of a step h by Hermite's cubic: dx all of it, v0 and v1 its rates at both ends. */
static inline void motion_cubic(double *u, const double *dx, const double *v0, const double *v1, int n, double h,
                                double x)
{
    const double y = 1 - x;
    for (int i = 0; i < n; i++) u[i] = x * x * (3 - 2 * x) * dx[i] + h * x * y * (y * v0[i] - x * v1[i]);
}

#endif
