/* meant.h -- the number that a double stands for.
 *
 * 0.001 in a deck is a thousandth, and the double nearest to it is not: 9 times that double prints as
 * 0.009000000000000001.  The decimal of up to 15 digits that reads back to the double is taken to be meant, or else the
 * fraction of small whole numbers that it is nearest to, such as 1/60; else the double itself. */
#ifndef FMDSUB_OUT_MEANT_H
#define FMDSUB_OUT_MEANT_H

struct meant {
    double x, rest; /* the double, and what it misses */
    double p, q;    /* the number is p/q: whole numbers, or the double itself and 1 */
};

struct meant meant_by(double x);

/* a + n b to the nearest double; n a whole number below 2^53. */
double meant_sum(const struct meant *a, double n, const struct meant *b);

/* n b likewise, by one division where n p is exact. */
static inline double meant_times(double n, const struct meant *b)
{
    static const double EXACT = 0x1p53;
    const double p = n * b->p;
    return b->q == 1 || (p < EXACT && p > -EXACT) ? p / b->q : meant_sum(&(struct meant){0, 0, 0, 1}, n, b);
}

#endif
