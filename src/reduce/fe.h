/* fe.h -- a finite-element body: nodes with three displacements each, stiffness and mass, in SI units.
 *
 * Freedom 3 I + k is the displacement of node I along k.  The body is free: a rigid motion costs no energy, and its
 * mass matrix is made of blocks m_IJ 1, as that of any solid element is (each component interpolated alike).
 *
 *     CalculiX     JOB.sti, JOB.mas, JOB.dof of *FREQUENCY, SOLVER=MATRIXSTORAGE, and the mesh, JOB.inp
 *                  rows `i j value`, one triangle; .dof: `node.direction` of every row
 *     Matrix Market   matrix coordinate real symmetric (or general), and a CSV table of nodes */
#ifndef FMDSUB_REDUCE_FE_H
#define FMDSUB_REDUCE_FE_H

#include "reduce/mesh.h"
#include "reduce/sparse.h"

struct fe_units { /* SI units in one unit of the input */
    double length, mass, time;
};

struct fe_source {
    const char *job;           /* CalculiX: JOB; or NULL */
    const char *mesh;          /* .inp; NULL: JOB.inp */
    const char *K, *M, *table; /* Matrix Market */
    struct fe_units units;
};

struct fe {
    int n;              /* nodes with freedoms */
    const int *id;      /* [n] their numbers, ascending */
    const double *x;    /* [3 x n] [m] */
    struct sparse K, M; /* [3n x 3n] [N/m], [kg] */
    struct mesh mesh;   /* as read, units of the file */
    struct fe_units units;
    struct files read;      /* all that it was read from */
    double mass, centre[3]; /* [kg], [m] */
    double size;            /* largest distance from the centre of mass [m] */
};

enum status fe_read(struct fe *o, const struct fe_source *from, struct arena *life, struct report *report);

/* Another stiffness of the same body, such as a prestressed one: `path` .sti (with .dof beside it) or .mtx (all
 * rows); has [3n]: the freedoms it has; others are zero rows.  fe_stiffness_files: what it reads. */
void fe_stiffness_files(struct files *files, const char *path);
enum status fe_read_stiffness(struct sparse *K, bool *has, const struct fe *fe, const char *path, struct arena *life,
                              struct report *report);

int fe_node(const struct fe *fe, int id); /* -1: none */

/* y = M x for one displacement component, by the scalar matrix m_IJ [n]. */
void fe_mass_scalar(double *y, const struct fe *fe, const double *x);

/* "node 17, y" */
const char *fe_freedom(const struct fe *fe, int freedom, struct arena *life);

#endif
