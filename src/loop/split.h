/* split.h -- which coordinates of the loops depend on which.
 *
 * LU of a component's C_q with full pivoting picks as many rows as its rank and the columns of the dependent
 * coordinates (Wehage & Haug, J. Mech. Design 104 (1982) 247); columns have weights, and a column is taken late if the
 * deck would rather have it independent.  Rows and dependents then stand in an order that makes C_qd a narrow band. */
#ifndef FMDSUB_LOOP_SPLIT_H
#define FMDSUB_LOOP_SPLIT_H

#include "loop/rows.h"

/* A number of C_q in a used row. */
struct entry {
    int e;    /* in F */
    int k;    /* its coordinate's place in v */
    int at;   /* of a dependent coordinate: in the band of C_qd; of an independent one: its number in ind */
    int slot; /* and among all independent ones */
};

/* The split of one component. */
struct part {
    const struct component *of;
    int nr, ni;       /* rows used, as many dependent coordinates; independent coordinates */
    int nfast;        /* of these fast */
    int *kept;        /* [nrow] numbers of its rows: those used, in order, then those that are redundant */
    int *row;         /* [nrow] the same among all rows */
    int *dep, *ind;   /* [nr], [ni] places in v */
    int *place;       /* [nk] number in dep, or -1 - number in ind */
    int nlead, *lead; /* used rows of drives: numbers in row */
    int band[2], ld;  /* of C_qd, compact: see la/pivot.h */
    int nof_dep;
    struct entry *of_dep, *of_ind;
    int *from;          /* [nr + 1] where the rows of of_ind begin */
    bool runs, runs_on; /* rows are long, and their numbers follow one another: in F and v; in slots as well */
    bool wide;          /* many independents: G is not kept */
    /* the choice */
    double *weight;           /* [nk] of the columns */
    double chosen;            /* pivot ratio when the rows were chosen */
    double gain;              /* split_gain() between the last two steps */
    double least_gain;        /* the least since the last look for a better split */
    double best_gain;         /* the least since the last choice */
    bool resplit_due;         /* dependents run away: it is time for a better one */
    int *loop_of, *row_order; /* [nk], [nrow] the first loop that a coordinate is in, rows: by the order of loops */
    int *prow, *pcol;         /* [nrow], [nk] as the pivots have sorted them */
    double *pivot;            /* [min(nrow, nk)] */
    double *whole;            /* [nrow x nk] C_q of a small component; NULL: pivots are found by rows */
};

struct factor;

struct split {
    const struct rows *rows;
    int npart;
    struct part *part; /* one for each component */
    double *reach;     /* [of the tree's v] a usual change of a coordinate in its loops: split_reach.c */
    int n, ns;         /* independent coordinates, the first ns fast */
    int run;           /* so many of the first follow one another in v, too, where these are more than a few */
    int *ind;          /* [n] their places in v */
    int *slot;         /* [of the tree's v] number in ind; -1: dependent */
    bool *follows;     /* [nturn of moves] a rate of this rotation is dependent */
    long number;       /* of this split: another after each choice; 0: none yet */
    int *kept;         /* a part's split, to go back to */
    int *work;
    double *claim; /* [of a part's coordinates] */
    double *x, *y; /* [of a part's rows or coordinates] */
    struct arena *scratch;
};

void split_build(struct split *o, const struct rows *rows, struct arena *life);

/* Rank of a component's C_q as it is: pivots at least `least` times the first. */
int split_rank(struct split *o, struct part *p, double least);
/* The best split of a component for C_q as it is, in rows->size or in reach as units; the weights of fast coordinates
 * times `fast`. */
void split_choose(struct split *o, struct part *p, const double *unit, double fast);
/* The split as it is now, to go back to by split_return(): one at a time. */
void split_keep(struct split *o, const struct part *p);
void split_return(struct split *o, struct part *p);
/* Everything that follows from a part's kept, dep and ind. */
void split_arrange(struct split *o, struct part *p);
/* All of it: the choices of all components and what they are judged by. */
void split_recall(struct split *o, struct recall *r);
/* Numbers the independent coordinates by the splits of all components. */
void split_number(struct split *o);
bool split_drops(const struct split *o, int row);

/* Largest rate of a dependent coordinate per unit of an independent one, in reaches: exactly by G [nr x ni], or, where
 * they are many, an estimate by C_qd factored. */
double split_gain(const struct split *o, const struct part *p, const double *G);
double split_gain_estimate(const struct split *o, const struct part *p, const struct factor *at);

/* x [n] of the independents into the whole xt, dependents 0. */
void split_spread(const struct split *o, double *restrict xt, const double *restrict x);

/* Loops in order, for loop_of and row_order: split_order.c. */
void split_order(struct split *o, struct part *p);
/* Fills o->reach. */
void split_reach(struct split *o);

/* After a choice by which some of the fast coordinates, those before it in o->kept, have become dependent: who is fast
 * in their place, by C_qd factored; split_fast.c. */
void split_succeed(struct split *o, struct part *p, const struct factor *at);

#endif
