/* mesh.h -- nodes, node sets and elements as a mesh file names them.
 *
 * CalculiX / Abaqus .inp: *NODE, *NSET (with GENERATE, other sets), *ELEMENT, *ELSET is passed over, *INCLUDE;
 * everything else is skipped.  Or a CSV table with a heading: node,x,y,z, then optional columns row_x,row_y,row_z
 * (rows of the node's three freedoms in the matrices, from 1; without them rows follow the table) and set (names
 * separated by blanks). */
#ifndef FMDSUB_REDUCE_MESH_H
#define FMDSUB_REDUCE_MESH_H

#include "base/files.h"
#include "reduce/text.h"

struct mesh_set {
    const char *name;
    int n, capacity;
    int *id; /* [n] numbers of nodes, ascending once the file is read */
};

enum { MOST_CORNERS = 20 };

struct mesh_element {
    int id, nodes;
    char type[8];           /* "C3D20R", upper case */
    int node[MOST_CORNERS]; /* numbers */
};

struct mesh {
    int n, capacity;
    int *id;   /* [n] ascending once the file is read */
    double *x; /* [3 x n] in the units of the file */
    int *rows; /* [3 x n] CSV: rows of the freedoms, from 0; else NULL */
    int nset, set_capacity;
    struct mesh_set *set;
    int nelement, element_capacity;
    struct mesh_element *element; /* the solid ones */
    const char *path;
    struct files read; /* that file, and those it includes */
};

enum status mesh_read_inp(struct mesh *o, const char *path, struct arena *life, struct report *report);
enum status mesh_read_csv(struct mesh *o, const char *path, struct arena *life, struct report *report);

int mesh_node(const struct mesh *mesh, int id); /* where it stands in the list; -1: nowhere */
const struct mesh_set *mesh_set(const struct mesh *mesh, const char *name);

#endif
