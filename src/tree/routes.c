/* routes.c -- see routes.h */
#include "tree/routes.h"

static const struct model_joint *joint_of(const struct model *m, int body)
{
    return &m->joint[m->body[body].joint];
}

static void own(struct routes *o, const struct model *m, struct arena *life)
{
    o->owner = TAKE(life, int, m->n);
    o->local = TAKE(life, int, m->n);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = joint_of(m, i);
        const struct model_body *b = &m->body[i];
        for (int k = 0; k < j->nv; k++) {
            o->owner[j->iv[k]] = i;
            o->local[j->iv[k]] = k;
        }
        for (int k = 0; k < b->nmode; k++) {
            o->owner[b->mode_v[k]] = i;
            o->local[b->mode_v[k]] = j->nv + k;
        }
    }
}

/* The velocities that move body i and not its parent: those of its joint, or at a node the modes of the parent. */
static int step_of(const struct model *m, int i, const int **k)
{
    const struct model_body *b = &m->body[i];
    const struct model_joint *j = joint_of(m, i);
    *k = b->at_node ? m->body[b->parent].mode_v : j->iv;
    return b->at_node ? m->body[b->parent].nmode : j->nv;
}

/* Preorder numbers: a body's tree takes size[i] of them, its children's trees one after the other. */
static void order(struct routes *o, const struct model *m, struct arena *life)
{
    int *size = TAKE(life, int, m->nbody), *next = TAKE(life, int, m->nbody);
    o->enter = TAKE(life, int, m->nbody);
    o->leave = TAKE(life, int, m->nbody);
    for (int i = m->nbody - 1; i >= 0; i--) {
        size[i]++;
        if (i) size[m->body[i].parent] += size[i];
    }
    for (int i = 0; i < m->nbody; i++) {
        int *free_at = i ? &next[m->body[i].parent] : NULL;
        o->enter[i] = i ? *free_at : 0;
        o->leave[i] = o->enter[i] + size[i];
        if (i) *free_at += size[i];
        next[i] = o->enter[i] + 1;
    }
}

/* Every leaf has its path written out; the bodies on it that have none yet share its beginning. */
static void write_paths(struct routes *o, const struct model *m, struct arena *life)
{
    o->npath = TAKE(life, int, m->nbody);
    o->path = TAKE(life, int *, m->nbody);
    const int *own;
    for (int i = 1; i < m->nbody; i++) o->npath[i] = o->npath[m->body[i].parent] + step_of(m, i, &own);
    for (int i = m->nbody - 1; i > 0; i--) {
        if (o->path[i]) continue;
        int *k = TAKE(life, int, o->npath[i]);
        for (int j = i; j > 0; j = m->body[j].parent) {
            int n = step_of(m, j, &own);
            for (int c = 0; c < n; c++) k[o->npath[j] - n + c] = own[c];
            if (!o->path[j]) o->path[j] = k;
        }
    }
}

void routes_build(struct routes *o, const struct model *m, struct arena *life)
{
    own(o, m, life);
    order(o, m, life);
    write_paths(o, m, life);
}
