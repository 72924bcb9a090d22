/* turned.h -- cosine and sine of an angle, the same bits on every machine.
 *
 * From the nearest of 256 points round the circle it is .0123 rad at most, where short series are good to round-off: within
 * 1.2e-16 of the truth, for a quarter of the instructions of sincos(). */
#ifndef FMDSUB_LA_TURNED_H
#define FMDSUB_LA_TURNED_H

#include <stdint.h>
#include <string.h>

#include "base/inline.h"

/* Points on it, and the angle between two in two parts: times a whole number below 2^20 the first one is exact. */
enum { CIRCLE = 256 };
extern const double circle[CIRCLE][2];
#define CIRCLE_HEAD 0x1.921fb54400000p-6
#define CIRCLE_REST 0x1.0b4611a626331p-40
#define CIRCLE_PER 0x1.45f306dc9c883p+5 /* its inverse */

/* What is far, or not finite: sincos(). */
void turned_far(double x, double *s, double *c);

/* *s, *c of x [rad]. */
INTO static inline void turned(double x, double *s, double *c)
{
    static const double FAR = 1 << 20;    /* turned that often k still has exact multiples of CIRCLE_HEAD */
    static const double WHOLE = 0x1.8p52; /* in the last bits of what is added to it stand whole numbers */
    const double sum = x * CIRCLE_PER + WHOLE, k = sum - WHOLE;
    if (!(k > -FAR && k < FAR)) {
        turned_far(x, s, c);
        return;
    }
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const double *at = circle[bits % CIRCLE];
    const double d = (x - k * CIRCLE_HEAD) - k * CIRCLE_REST, dd = d * d;
    const double sd = d - d * dd * (1. / 6 - dd * (1. / 120 - dd * (1. / 5040))),
                 cd = dd * (.5 - dd * (1. / 24 - dd * (1. / 720)));
    *s = at[1] + (at[0] * sd - at[1] * cd);
    *c = at[0] - (at[1] * sd + at[0] * cd);
}

#endif
