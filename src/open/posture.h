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

static inline bool posture_is(const struct posture *o, const double *q, int nq)
{
    return o->number && memcmp(o->q, q, sizeof *q * (size_t)nq) == 0;
}

/* Takes q; returns its number, a new one where q is another than before. */
static inline long posture_take(struct posture *o, const double *q, int nq)
{
    if (posture_is(o, q, nq)) return o->number;
    memcpy(o->q, q, sizeof *q * (size_t)nq);
    return ++o->number;
}

#endif
