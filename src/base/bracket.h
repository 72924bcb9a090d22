/* bracket.h -- where a function changes its sign, by Illinois' rule of false position (Dowell & Jarratt, BIT 11 (1971) 168).
 *
 * The function is above 0 at lo and below at hi; where it is 0 at lo the middle is tried.  Where the rule takes long, as where
 * a function that is next to 0 bends down all at once, every other place is the middle. */
#ifndef FMDSUB_BASE_BRACKET_H
#define FMDSUB_BASE_BRACKET_H

#include <stdbool.h>

#include "base/scalar.h"

struct bracket {
    double lo, hi, flo, fhi;
    int side;  /* the end that moved last: 1: lo, -1: hi, 0: none */
    int tried; /* places so far */
};

/* The next place to try. */
static inline double bracket_next(const struct bracket *o)
{
    enum { LONG = 16 };
    const double width = o->hi - o->lo;
    const bool middle = o->tried > LONG && o->tried % 2 == 0;
    const double x = o->flo > 0 && !middle ? o->lo + width * o->flo / (o->flo - o->fhi) : .5 * (o->lo + o->hi);
    return larger(o->lo + 1e-3 * width, smaller(x, o->hi - 1e-6 * width));
}

/* The function is f there. */
static inline void bracket_take(struct bracket *o, double x, double f)
{
    o->tried++;
    if (f > 0) {
        o->lo = x;
        o->flo = f;
        if (o->side == 1) o->fhi /= 2;
        o->side = 1;
    } else {
        o->hi = x;
        o->fhi = f;
        if (o->side == -1) o->flo /= 2;
        o->side = -1;
    }
}

#endif
