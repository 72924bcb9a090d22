/* posture.h -- positions that are known again.
 *
 * What depends on positions alone is found once for each posture: it keeps the number of the posture it was found at,
 * and is good while that number stands.  Positions are compared here and nowhere else. */
#ifndef FMDSUB_OPEN_POSTURE_H
#define FMDSUB_OPEN_POSTURE_H

#include <stdbool.h>
#include <string.h>

struct posture {
    double *q;   /* [nq] */
    long number; /* of q: another for other positions, never used again; 0: none yet */
};

/* How many of the first positions are the same; bit by bit, so that NaN and -0 are themselves.  A loop, since mostly
 * the first one differs: a call of memcmp() would cost a mechanism of few bodies 1 percent of its step. */
static inline int posture_same(const struct posture *o, const double *q, int nq)
{
    int i = 0;
    while (i < nq - 1 && memcmp(&o->q[i], &q[i], sizeof *q) == 0 && memcmp(&o->q[i + 1], &q[i + 1], sizeof *q) == 0)
        i += 2;
    while (i < nq && memcmp(&o->q[i], &q[i], sizeof *q) == 0) i++;
    return i;
}

static inline bool posture_is(const struct posture *o, const double *q, int nq)
{
    return o->number && posture_same(o, q, nq) == nq;
}

/* Takes q; returns its number, a new one where q is another than before. */
static inline long posture_take(struct posture *o, const double *q, int nq)
{
    const int same = o->number ? posture_same(o, q, nq) : 0;
    if (o->number && same == nq) return o->number;
    memcpy(o->q + same, q + same, sizeof *q * (size_t)(nq - same));
    return ++o->number;
}

#endif
