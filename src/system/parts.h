/* parts.h -- what the files of system.h share. */
#ifndef FMDSUB_SYSTEM_PARTS_H
#define FMDSUB_SYSTEM_PARTS_H

#include "loop/condense.h"
#include "loop/coordinates.h"
#include "open/open.h"
#include "system/system.h"

struct system {
    const struct model *model;
    const struct sweep_ops *ops;
    struct open_tree tree;
    struct condense *loops;    /* of the tree with its loops; NULL: none */
    struct windings *windings; /* NULL: nobody asks for them */
    struct sweep *view;
    struct loops *shown; /* the loops there */
    double *lambda;      /* [rows] at the last system_evaluate() */
    double constraint_worst;
    /* at the last system_evaluate() */
    double *q, *v, *a, *r;         /* [nq], [n] */
    struct effect *effect;         /* [nforce] */
    double *near_q[2], *near_v[2]; /* [nq], [n] two states of system_leap() */
    struct energies energies;
};

#endif
