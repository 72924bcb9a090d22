/* fit.h -- a sequence foreseen by the recursion that its differences follow,
 *
 *     delta_n = c1 delta_n-1 + c2 delta_n-2,
 *
 * fitted to its past by least squares, older terms fading: a vibration that is sampled once a step looks like any
 * frequency, and such a recursion goes through it as well as through a smooth motion, c = (2, -1). */
#ifndef FMDSUB_ENGINE_FIT_H
#define FMDSUB_ENGINE_FIT_H

#include "base/arena.h"
#include "base/recall.h"

/* Normal equations of c1, c2: sums of products of delta_n, delta_n-1, delta_n-2.  All zero: nothing known. */
struct fit {
    double s11, s12, s22, s01, s02;
    double last, before; /* the last two delta */
    int terms;           /* that have been seen, up to two */
};

/* Of n fits, `stride` bytes apart. */
void fits_recall(struct fit *o, struct recall *r, const char *name, int n, size_t stride);

/* As many of one system side by side, for vectors: the same numbers, lists of them [room]. */
struct fit_row {
    double *s11, *s12, *s22, *s01, *s02, *last, *before;
    double *below; /* work */
    int room;      /* a multiple of four: what is not in use stays zero */
    int terms;
};

int fit_room(int n);
void fit_row_open(struct fit_row *o, int n, struct arena *life);
void fit_row_forget(struct fit_row *o);
void fit_row_recall(struct fit_row *o, struct recall *r, const char *name, int n);
/* fit_learn() and fit_next() of each, delta and next [room]. */
void fit_row_learn(struct fit_row *o, const double *delta);
void fit_row_next(const struct fit_row *o, double *next);

static const double FIT_FADE = .9;                    /* weight of the term before */
static const double FIT_VAGUE = 1e-6, FIT_GROWTH = 3; /* of c = (1, 0) against the past; see fit_next() */

static inline void fit_learn(struct fit *o, double delta)
{
    const double fade = FIT_FADE;
    double a = o->last, b = o->before;
    o->before = a;
    o->last = delta;
    if (o->terms < 2) {
        o->terms++;
        return;
    }
    o->s11 = fade * o->s11 + a * a;
    o->s12 = fade * o->s12 + a * b;
    o->s22 = fade * o->s22 + b * b;
    o->s01 = fade * o->s01 + delta * a;
    o->s02 = fade * o->s02 + delta * b;
}

/* The next delta.  What the past does not determine is c = (1, 0).  Where the past was round-off the quotients are
 * noise: it is at most three times what was seen last. */
static inline double fit_next(const struct fit *o)
{
    double e = FIT_VAGUE * (o->s11 + o->s22), a = o->s11 + e, b = o->s12, c = o->s22 + e, x = o->s01 + e, y = o->s02;
    double det = a * c - b * b, last = o->last < 0 ? -o->last : o->last,
           before = o->before < 0 ? -o->before : o->before;
    if (!(det > 0)) return o->last;
    double fitted = ((c * x - b * y) * o->last + (a * y - b * x) * o->before) / det;
    double most = FIT_GROWTH * (last > before ? last : before);
    return fitted > most ? most : fitted < -most ? -most : fitted;
}

#endif
