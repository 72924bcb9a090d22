/* mesh_parts.h -- how the readers of meshes fill one */
#ifndef FMDSUB_REDUCE_MESH_PARTS_H
#define FMDSUB_REDUCE_MESH_PARTS_H

#include "reduce/mesh.h"

void mesh_add_node(struct mesh *o, int id, const double *x, struct arena *life);
/* The set of that name (case does not count), made if it is new. */
struct mesh_set *mesh_add_set(struct mesh *o, const char *name, size_t len, struct arena *life);
void mesh_add_member(struct mesh_set *set, int id, struct arena *life);
struct mesh_element *mesh_add_element(struct mesh *o, struct arena *life);
void mesh_sort(struct mesh *o, struct arena *life);

#endif
