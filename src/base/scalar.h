/* scalar.h -- the larger and the smaller of two numbers, in an instruction each.
 *
 * fmax() and fmin() are calls, a dozen of them in a step.  NaN as b is passed over, as by them; NaN as a stays. */
#ifndef FMDSUB_BASE_SCALAR_H
#define FMDSUB_BASE_SCALAR_H

static inline double larger(double a, double b)
{
    return b > a ? b : a;
}

static inline double smaller(double a, double b)
{
    return b < a ? b : a;
}

/* The larger; what is not a number stays, as a and as b. */
static inline double worse(double a, double b)
{
    return b <= a || a != a ? a : b;
}

#endif
