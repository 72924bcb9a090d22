/* tie.h -- how an interface takes hold of the body: a set of nodes and one small rigid body, at a point.
 *
 *     rigid     the nodes follow it:  u_I = p + theta x (x_I - x)                        (RBE2)
 *     average   it follows the nodes: theta = J^-1 sum d_I x u_I,  d_I = x_I - mean x,
 *               J = sum (d'd 1 - dd'),  p = mean u_I + theta x (x - mean x)              (RBE3, equal weights)
 *
 * Of a single node the rotation is the average of the nodes it shares stiffness with; only its displacement is tied. */
#ifndef FMDSUB_REDUCE_TIE_H
#define FMDSUB_REDUCE_TIE_H

#include "reduce/fe.h"

struct tie_options {
    const char *name;
    const char *where; /* a node set, or node numbers joined by '+' */
    bool rigid;
    bool placed; /* at the point `at` [units of the mesh], else at the mean of the nodes */
    double at[3];
};

struct tie {
    const char *name;
    bool rigid;
    int n;
    const int *node; /* [n] of the body */
    double x[3];     /* [m] */
    int motions;     /* 6, of a single node 3 */
    int ngauge;
    const int *gauge; /* [ngauge] nodes that tell its motion */
    double *A;        /* [6 x 3 ngauge] motion (p, theta) from their displacements */
};

enum status tie_make(struct tie *o, const struct tie_options *options, const struct fe *fe, struct arena *life,
                     struct report *report);

/* No node in two ties. */
enum status tie_check(const struct tie *tie, int n, const struct fe *fe, struct report *report);

/* m [6] = motion of the tie in the displacements u [3 fe->n]. */
void tie_motion(double *m, const struct tie *o, const double *u);

#endif
