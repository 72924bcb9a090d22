/* rows.h -- the equations of the loops over a tree, C(q, t) = 0 (2-2): which there are, and C and C_q at a posture.
 *
 * Loops that hang together by their coordinates make a component, whose C_q is kept by rows.  What is found at a posture
 * is good for as long as it has the same number (open/posture.h): asked for there again it costs nothing. */
#ifndef FMDSUB_LOOP_ROWS_H
#define FMDSUB_LOOP_ROWS_H

#include "loop/loops.h"
#include "open/open.h"

/* A rotation with coordinates in a row of C_q: where its numbers are in F. */
struct row_turn {
    int turn; /* of moves */
    int at[3];
};

struct component {
    int nk, *k;      /* coordinates: places in the tree's v, ascending */
    int nrow, *row;  /* numbers of its rows, ascending */
    int *start, *at; /* [nrow + 1]; coordinates of row r: numbers in k, at[start[r]] ... */
    double *F;       /* [start[nrow]] C_q */
    int nturn;
    struct row_turn *turn; /* [nturn] */
};

struct rows {
    struct open_tree *tree;
    struct loops *loops;
    int n; /* velocities of the tree */
    int ncomponent;
    struct component *component;
    int *owner;         /* [n] a coordinate's component; -1: in no loop */
    int *column;        /* [n] its number there */
    bool constant;      /* C_q is the same everywhere: drives along coordinates, gears; no row looks at a body */
    double *size, *per; /* [n] usual change of a coordinate, 1 rad or a length of the mechanism; 1/size */
    long placed;        /* posture at which the loops were looked at; 0: none */
    long linear;        /* posture that C_q is of, any where it is constant; 0: none */
};

void rows_build(struct rows *o, struct open_tree *tree, struct arena *life);

/* The tree at q, and C, or C and C_q, there.  Returns the number of the posture.  A constant C_q that has been made moves
 * nothing. */
long rows_place(struct rows *o, const double *q);
long rows_linearize(struct rows *o, const double *q);
/* Of the C_q where the tree stands. */
static inline long rows_number(const struct rows *o)
{
    return o->constant ? o->linear : o->tree->posture.number;
}
/* C_q becomes that along the Cayley vectors in dx [n], from a base, of the rotations that are marked [nturn of moves]:
 * it is of no posture then. */
void rows_turn(struct rows *o, const double *dx, const bool *marked);

/* C [rows] where rows_place() has been, with drives as they are. */
void rows_values(double *C, const struct rows *o);
/* The same at q; the tree is left where it is if C_q is constant. */
void rows_values_at(double *C, struct rows *o, const double *q);
/* The largest |C|; *row is where, and stays where all are 0. */
double rows_worst(int *row, const struct rows *o, const double *C);
/* Both at q. */
double rows_misfit(double *C, int *row, struct rows *o, const double *q);

#endif
