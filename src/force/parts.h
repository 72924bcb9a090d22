/* parts.h -- what the files of the elements share: the elements sorted for the loop.
 *
 *     elements.c        laws, signals, loads; all elements of a class
 *     bushing.c         bushings
 *     slopes.c          slopes of all of them
 *     elements_build.c  how they are sorted
 */
#ifndef FMDSUB_FORCE_PARTS_H
#define FMDSUB_FORCE_PARTS_H

#include "force/elements.h"
#include "force/measure.h"

/* A linear spring and damper along a joint coordinate: no gradient, no changing slope. */
struct plain {
    int iq, iv, force;
    double k, c, rest, preload;
};

/* Any other element. */
struct part_of {
    int force;
    bool linear;   /* its law is affine */
    bool ends;     /* keeps energy by what stood at the interval's ends (see elements.c) */
    double end[2]; /* the measure, or a bushing's energy, at the interval's ends */
    double kref;   /* a law's slope at the last slopes() */
    int nturn;
    const int *turn; /* [nturn] rotations that change the measure: on one body's path and not on the other's */
};

struct elements {
    const struct model *model;
    const struct sweep_ops *ops;
    struct measures measures;
    /* sorted fast first: FAST [0, end[FAST]), SLOW [end[FAST], end[ALL]) */
    int nplain[4], nother[4];
    struct plain *plain;
    struct part_of *other;
    bool ends[4];        /* does anything of the class look at the ends? */
    struct sweep *there; /* the bodies they touch at an end of the interval (as its FAST ones); NULL: none */
    int most_slots;
    double *slot, *slope; /* [most_slots] an expression's arguments, its slopes along them */
    int *which;           /* [most_slots] 1, 2, ... */
    struct row row, column;
    const struct reduction *to; /* of elements_slopes_reduced(), while it runs */
};

/* First and last + 1 of a class in a list sorted by class. */
static inline int first_of(const int *n, enum rate cls)
{
    return cls == SLOW ? n[FAST] : 0;
}

static inline int last_of(const int *n, enum rate cls)
{
    return cls == FAST ? n[FAST] : n[ALL];
}

/* Values of the slots of a force. */
void read_slots(struct elements *e, const struct sweep *s, const struct model_force *f, const struct instant *x);

/* What stood at one end (0: qa, 1: qb) of the interval, for the elements that want to know. */
void look_at_end(struct elements *e, const struct instant *x, int end, enum rate cls);

/* A law's force and slopes at the measure s and rate of the instant, or over the interval between the ends. */
void law_over(struct law *o, double *dissipative, const struct force_kind *kind, const void *par, bool linear, double s,
              double rate, const double *end, double t);

/* A bushing's relative motion, in axes of the marker on a: displacement d and its rate, rotation vector phi,
 * relative angular velocity W, T [9] with phi' = T' W. */
struct bush {
    double d[3], rate[3], phi[3], W[3], T[9];
    double E[9];  /* marker axes in the world */
    double at[3]; /* the marker on b */
};
void bushing_at(struct bush *o, const struct elements *e, const struct sweep *s, const struct model_force *f);
double bushing_stored(const struct bush *o, const struct bushing *par);
/* As elements_load(), of one bushing. */
void bushing_load(struct elements *e, struct sweep *s, const struct part_of *p, double *r, double *w,
                  struct effect *effect, const struct instant *x);

/* The remainder E of work, of terms of the size `scale`, given to the rotations. */
void give_to_rotations(double *r, const struct part_of *p, double E, double scale, const struct instant *x);

#endif
