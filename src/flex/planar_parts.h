/* planar_parts.h -- the tables of planar.h. */
#ifndef FMDSUB_FLEX_PLANAR_PARTS_H
#define FMDSUB_FLEX_PLANAR_PARTS_H

#include "flex/planar.h"

enum { BLOCKS = 6, RATES = 5, ACROSS = 2 }; /* of a panel; more of them where there is an across */

/* out = base + A x; block b of out begins at at[b].  Rows of out that do not change stand there from the start. */
struct panel {
    int n, size,
        rows; /* size of out; rows of A, whose other blocks are zero; both multiples of 4, what is too many 0 */
    int at[BLOCKS + ACROSS];
    double *base;                         /* [size] */
    double *A;                            /* [rows x n] by tiles */
    const double *table[BLOCKS + ACROSS]; /* [n x n] block b of A by column; NULL: zero */
};

/* y += A x; where A is diagonal, as for modes, [n] numbers will do. */
struct form {
    bool diagonal;
    double *A;
};

struct node {
    double x[2];
    double *psi; /* [n] */
    struct panel d, S;
};

struct flex_planar {
    int n;
    double e1[2];         /* rho is counted along, tau square to it */
    double pivot[2];      /* of the mean frame: the reference node */
    double *mean;         /* [n] its turn by coordinate */
    double mass, jx, rot; /* jx = tr xx */
    double m_inv, j_inv;  /* 1/mass, 1/jx; 0 for a particle */
    double *f, *e, *g;    /* [n x 2], [n], [n]: of the body at rest */
    double *rpsi;         /* [n] */
    struct panel shape;   /* of q: H (x, y), E, C, W^ q, P^' q; E, C across */
    struct panel rates;   /* of q': P^' q', sx, sy, tr xs, X; the last two across */
    struct panel M;       /* of q'': M^ q'' */
    struct form K, D;
    double *rest; /* [n x n] M^ */
    struct node *node;
    /* Of a body described as in space: the part that rotates and stretches with its second principal axis; it has
     * rho, tau, jx and what is made of these alone.  NULL: this struct has all. */
    struct flex_planar *across;
    bool cayley; /* nodes turn by 2 atan(psi q/2) */
};

#endif
