/* mesh.c -- lists that grow and are sorted when the file is read; see mesh.h */
#include "reduce/mesh.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "reduce/mesh_parts.h"

void mesh_add_node(struct mesh *o, int id, const double *x, struct arena *life)
{
    int capacity = o->capacity;
    o->id = arena_more(life, o->id, o->n, &capacity, sizeof *o->id);
    o->x = arena_more(life, o->x, o->n, &o->capacity, 3 * sizeof *o->x);
    o->id[o->n] = id;
    memcpy(o->x + 3 * (size_t)o->n++, x, 3 * sizeof *x);
}

struct mesh_set *mesh_add_set(struct mesh *o, const char *name, size_t len, struct arena *life)
{
    for (int i = 0; i < o->nset; i++)
        if (strlen(o->set[i].name) == len && strncasecmp(o->set[i].name, name, len) == 0) return o->set + i;
    o->set = arena_more(life, o->set, o->nset, &o->set_capacity, sizeof *o->set);
    o->set[o->nset] = (struct mesh_set){.name = arena_copy(life, name, len)};
    return o->set + o->nset++;
}

void mesh_add_member(struct mesh_set *set, int id, struct arena *life)
{
    set->id = arena_more(life, set->id, set->n, &set->capacity, sizeof *set->id);
    set->id[set->n++] = id;
}

struct mesh_element *mesh_add_element(struct mesh *o, struct arena *life)
{
    o->element = arena_more(life, o->element, o->nelement, &o->element_capacity, sizeof *o->element);
    return o->element + o->nelement++;
}

struct order {
    int id, at;
};

static int compare_order(const void *a, const void *b)
{
    const struct order *p = a, *q = b;
    return p->id != q->id ? (p->id > q->id) - (p->id < q->id) : (p->at > q->at) - (p->at < q->at);
}

static int compare_id(const void *a, const void *b)
{
    const int *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* Nodes by number; of a node given again the last place counts, as in CalculiX. */
static void sort_nodes(struct mesh *o, struct arena *life)
{
    struct order *order = TAKE(life, struct order, o->n);
    int *id = TAKE(life, int, o->n), n = 0;
    double *x = TAKE(life, double, 3 * (size_t)o->n);
    int *rows = o->rows ? TAKE(life, int, 3 * (size_t)o->n) : NULL;
    for (int i = 0; i < o->n; i++) order[i] = (struct order){o->id[i], i};
    qsort(order, (size_t)o->n, sizeof *order, compare_order);
    for (int i = 0; i < o->n; i++) {
        if (i + 1 < o->n && order[i + 1].id == order[i].id) continue;
        id[n] = order[i].id;
        memcpy(x + 3 * (size_t)n, o->x + 3 * (size_t)order[i].at, 3 * sizeof *x);
        if (rows) memcpy(rows + 3 * (size_t)n, o->rows + 3 * (size_t)order[i].at, 3 * sizeof *rows);
        n++;
    }
    o->n = n;
    o->id = id;
    o->x = x;
    o->rows = rows;
}

void mesh_sort(struct mesh *o, struct arena *life)
{
    sort_nodes(o, life);
    for (struct mesh_set *s = o->set; s < o->set + o->nset; s++) {
        int n = 0;
        if (s->n) qsort(s->id, (size_t)s->n, sizeof *s->id, compare_id);
        for (int i = 0; i < s->n; i++)
            if (!n || s->id[n - 1] != s->id[i]) s->id[n++] = s->id[i];
        s->n = n;
    }
}

int mesh_node(const struct mesh *mesh, int id)
{
    const int *at = mesh->n ? bsearch(&id, mesh->id, (size_t)mesh->n, sizeof *mesh->id, compare_id) : NULL;
    return at ? (int)(at - mesh->id) : -1;
}

const struct mesh_set *mesh_set(const struct mesh *mesh, const char *name)
{
    for (int i = 0; i < mesh->nset; i++)
        if (strcasecmp(mesh->set[i].name, name) == 0) return mesh->set + i;
    return NULL;
}
