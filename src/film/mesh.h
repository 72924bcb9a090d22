/* mesh.h -- triangles of simple solids, for pictures. */
#ifndef FMDSUB_FILM_MESH_H
#define FMDSUB_FILM_MESH_H

#include "base/arena.h"

struct mesh {
    int nv, nt, vertices, triangles; /* in use; there is room for */
    double *x;                       /* [3 x nv] [m] */
    int *tri;                        /* [3 x nt] counterclockwise from outside */
    int nsolid, solids;              /* each of them convex */
    int *solid;                      /* [2 x nsolid] its first vertex, its first triangle */
    struct arena *life;
};

/* Adds a solid.  R: its axes by column. */
void mesh_box(struct mesh *o, const double *centre, const double *R, const double *half);
void mesh_cylinder(struct mesh *o, const double *a, const double *b, double radius);
void mesh_ball(struct mesh *o, const double *centre, double radius);

#endif
