/* outline.h -- curves of planar bodies that others touch: a profile y(x), free above it, and a cam r(phi), free outside.
 *
 * Between the points of its table a curve is a cubic spline with continuous second derivatives, natural at the ends of a
 * profile, which goes on straight there, and periodic for a cam (de Boor, A Practical Guide to Splines, 1978, ch. IV). */
#ifndef FMDSUB_KIND_OUTLINE_H
#define FMDSUB_KIND_OUTLINE_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/keys.h"

struct outline {
    bool closed; /* a cam: x is the angle [rad], y the radius [m]; else x, y [m] */
    int n;
    const double *x, *y, *bend; /* [n], of a cam [n + 1]: table, x ascending; second derivatives */
    int samples;
    const double *sample; /* [2 x samples]: points of it, at the table and half-way to the next */
};

/* The curve through the points, two or more, of a cam three or more whose angles lie within one turn. */
const struct outline *outline_make(const struct points *table, bool closed, struct arena *life);

/* Its point at u, x or angle; [2]. */
void outline_point(const struct outline *o, double *c, double u);

/* The point of it nearest to p and the unit normal there, to the free side; all [2], axes of the curve. */
void outline_nearest(const struct outline *o, double *at, double *normal, const double *p);

/* How far p is from it, outside positive, and the normal there in the world, [3]: ex its x axis there, d from its origin to
 * p. */
double outline_meet(const struct outline *o, double *normal, const double *ex, const double *d);

/* The largest curvature of its hollows [1/m], 0 where it has none, and about where, x of the table. */
double outline_hollow(const struct outline *o, double *where);

/* The least y between its points, about. */
double outline_least(const struct outline *o);

#endif
