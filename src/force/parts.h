/* parts.h -- what the files of the elements share: the table of element kinds, the elements sorted for the loop.
 *
 *     elements.c        all elements of a class, by the table
 *     elements_build.c  how they are sorted
 *     law.c             laws along a measure
 *     signal.c          values along a measure, loads at points and on bodies
 *     between.c         kinds between two markers
 *     remainder.c       work that a stored energy misses over an interval
 *     slopes.c          rows into matrices
 */
#ifndef FMDSUB_FORCE_PARTS_H
#define FMDSUB_FORCE_PARTS_H

#include "contact/contact.h"
#include "force/elements.h"
#include "force/measure.h"

/* A linear spring and damper along a joint coordinate: no gradient, no changing slope. */
struct plain {
    int iq, iv, force;
    double k, c, rest, preload;
};

/* Any other element. */
struct part_of {
    const struct element_kind *kind;
    int force;
    bool stores;             /* it has energy */
    bool diagonal;           /* its slopes, if any, are along joint coordinates one by one, for diagonal() */
    bool linear;             /* its law is affine */
    bool ends;               /* keeps energy by what stood at the interval's ends (see law.c, remainder.c) */
    double end[2];           /* what end() says of these */
    int nstrain;             /* it has at most so many strains: */
    double *strain[2];       /* [nstrain] those at these ends */
    double kref;             /* a law's slope at the last slopes() that was no look */
    bool poles;              /* it may have poles */
    bool bends;              /* its law may have corners */
    bool sums;               /* its energy is summed from step to step */
    bool follows;            /* it knows where the last step went: */
    double came;             /* the measure at its start */
    double stood;            /* and at its end */
    double V;                /* of one that sums: the energy there [J] */
    bool reads;              /* it knows what it has read: */
    double *last, *now;      /* [slots of the force] at the start of the last step, at its end */
    double open[3], pace[3]; /* clear() at two instants and one between, and its rate */
    double whole[3];         /* whole() there, */
    double at_once[3];       /* and the part of it that is there at once */
    int nside, sided[3];     /* values that change sign where it bends or jumps: all; of each signal */
    bool pole;               /* it has grown without bound in a step */
    int a, b; /* the bodies, where each is part of another tree that flies, or one of a tree of several; else both 0 */
    int nturn;
    const int *turn; /* [nturn] else: rotations that change the measure: on one body's path and not on the other's */
};

/* Where loads go; members as the arguments of elements_load(), effect that of the element; r is required. */
struct loading {
    double *r, *w, *dk;
    struct effect *effect;
};

/* What the elements of a type do, force_type in kind/force.h; the sweep is at its last motion. */
struct element_kind {
    /* Optional.  Fills stores, diagonal, linear, ends. */
    void (*sort)(struct part_of *p, const struct model *m, const struct model_force *f);
    /* Required where nside is set.  As elements_sides(), of one. */
    void (*sides)(double *side, double *force, struct elements *e, const struct sweep *s, const struct part_of *p,
                  const struct instant *x);
    /* Required.  As elements_load(). */
    void (*load)(struct elements *e, struct sweep *s, struct part_of *p, const struct loading *to,
                 const struct instant *x);
    /* Required.  As elements_slopes(). */
    void (*slopes)(struct elements *e, struct sweep *s, struct part_of *p, double *K, double *C,
                   const struct instant *x);
    /* Required where diagonal is set and there are slopes. */
    void (*diagonal)(struct elements *e, struct part_of *p, double *d, double cc, double ck, const struct instant *x);
    /* Required where stores is set [J]. */
    double (*stored)(const struct elements *e, const struct sweep *s, const struct part_of *p, const double *q,
                     const double *v);
    /* Required where ends is set: the measure, or the energy, at an end of the interval; fills strain [nstrain], if not
     * NULL. */
    double (*end)(const struct elements *e, const struct sweep *there, const struct model_force *f, const double *q,
                  const double *v, double *strain);
    /* Required where the force's kind has clear(): the measure that it is told, and its rate. */
    double (*place)(double *rate, const struct elements *e, const struct sweep *s, const struct model_force *f,
                    const double *q, const double *v);
    /* Required where follows is set: at the start (begins), and at the end of each step. */
    void (*follow)(struct elements *e, const struct sweep *s, struct part_of *p, const struct instant *x, bool begins);
    /* Required where poles is set: does it grow without bound on the way from there to x? */
    bool (*pole)(struct elements *e, const struct sweep *s, const struct part_of *p, const struct instant *x);
};
extern const struct element_kind element_law, element_value, element_load, element_between;

/* law.c: *dk (elements_load) grows to the change of a slope since slopes(); sharp: beyond SHARP. */
void tell_change(double *dk, const struct part_of *p, double ks, bool sharp);

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
    const struct contacts *contacts; /* that push with */
    const double *press;             /* these forces; NULL: none */
    bool loads;                      /* is there any force, or one of contacts? */
    const struct reduction *to;      /* of elements_slopes_reduced(), while it runs */
    double apart;                    /* time between the last two instants that were looked at [s] */
    double *clear_q, *clear_v; /* [nq], [n] where open[1] and pace[1] of others were found last; NULL: not kept, as */
    bool clear_known;          /* angles that know their past may differ; were they found? */
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

/* signal.c: what a force reads now, behind what it has read last. */
void value_read(struct elements *e, const struct sweep *s, struct part_of *p, const struct instant *x);
/* law.c: had the law a corner in the last step? */
bool law_bent(const struct elements *e, const struct part_of *p);

/* What stood at one end (0: qa, 1: qb) of the interval, for the elements that want to know. */
void measure_end(struct elements *e, const struct instant *x, int end, enum rate cls);

/* remainder.c: the remainder E of work, of terms of the size `scale`, given to the rotations, or to the relative motion
 * of a and b about the middle of the points at_a and at_b [3] of these. */
void give_remainder(const struct elements *e, struct sweep *s, double *r, const struct part_of *p, double E,
                    double scale, const double *at_a, const double *at_b, const struct instant *x);

/* slopes.c: A += scale row' column */
void outer(const struct elements *e, double *A, const struct row *row, const struct row *column, double scale);
/* Row of the relative velocity of two bodies along dir, at a point each or turning (NULL). */
void row_between(struct row *o, const struct elements *e, const struct sweep *s, int a, const double *at_a, int b,
                 const double *at_b, const double *dir);

#endif
