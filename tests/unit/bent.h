/* bent.h -- random trees in space with flexible bodies: random_tree()'s, of which some bodies become clouds; what hung
 * on those hangs on bodies at their nodes. */
#ifndef FMDSUB_TESTS_BENT_H
#define FMDSUB_TESTS_BENT_H

#include "unit/clouds.h"

struct bent {
    struct model *m;
    struct cloud **cloud; /* [nbody] NULL: rigid */
};

/* mass and inertia of the undeformed body. */
static inline void bent_body(struct model_body *b, struct cloud *c, struct arena *arena)
{
    static const int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
    const struct flex_body *f = &c->body;
    b->flex = f;
    b->nmode = f->n;
    b->mode_q = TAKE(arena, int, f->n);
    b->mode_v = TAKE(arena, int, f->n);
    b->mass = f->mass;
    for (int e = 0; e < 6; e++) {
        b->inertia[e] = f->rot[row[e] + 3 * col[e]] - f->xx[row[e] + 3 * col[e]];
        if (e < 3) b->inertia[e] += f->xx[0] + f->xx[4] + f->xx[8];
    }
}

/* Frame of a node body, turned anyhow against the node's axes. */
static inline void bent_node(struct model_body *b, struct model_joint *j, struct tree_dice *d,
                             const struct flex_body *f, int parent, int child)
{
    double q[4];
    *b = (struct model_body){.name = "node", .parent = parent, .joint = child - 1, .at_node = true};
    b->node = tree_pick(d, f->nnode);
    *j = (struct model_joint){.name = "node", .type = JOINT_FIXED, .parent = parent, .child = child};
    memcpy(j->a, f->node[b->node].x, sizeof j->a);
    tree_quaternion(q, d, 3);
    tree_matrix(j->Ea, q);
    tree_quaternion(q, d, 3);
    tree_matrix(j->Eb, q);
}

static inline void bent_number(struct model *m, struct model_body *body, struct model_joint *joint, const bool *fast,
                               const bool *fast_modes, bool which)
{
    for (int i = 1; i < m->nbody; i++) {
        struct model_joint *j = &joint[i - 1];
        for (int k = 0; k < j->nq && fast[i] == which; k++) j->iq[k] = m->nq++;
        for (int k = 0; k < j->nv && fast[i] == which; k++) j->iv[k] = m->n++;
        for (int k = 0; k < body[i].nmode && fast_modes[i] == which; k++)
            body[i].mode_q[k] = m->nq++, body[i].mode_v[k] = m->n++;
    }
}

/* Half of the bodies flexible, of up to `most` coordinates; about two bodies on each of a flexible body's nodes. */
static inline struct bent bent_tree(int nbody, int most, unsigned seed, unsigned flags, unsigned cloud_flags,
                                    struct arena *arena)
{
    struct tree_dice dice = {seed * 31u + 9}, *d = &dice;
    const struct model *from = random_tree(3, nbody, seed, flags, arena);
    struct model *m = TAKE(arena, struct model, 1);
    struct model_body *body = TAKE(arena, struct model_body, 2 * nbody + 1);
    struct model_joint *joint = TAKE(arena, struct model_joint, 2 * nbody);
    struct cloud **cloud = TAKE(arena, struct cloud *, 2 * nbody + 1);
    int *now = TAKE(arena, int, nbody + 1), *at = TAKE(arena, int, 2 * nbody + 1);
    bool *fast = TAKE(arena, bool, 2 * nbody + 1), *fast_modes = TAKE(arena, bool, 2 * nbody + 1);
    *m = *from;
    m->n = m->ns = m->nq = 0, m->ncoordinate = 0;
    body[0] = from->body[0];
    m->nbody = 1;
    for (int i = 1; i <= nbody; i++) {
        int parent = now[from->body[i].parent];
        if (cloud[parent] && at[parent] && tree_pick(d, 2)) {
            parent = at[parent];
        } else if (cloud[parent]) {
            int node = m->nbody++;
            bent_node(&body[node], &joint[node - 1], d, &cloud[parent]->body, parent, node);
            body[node].fast = body[parent].fast;
            parent = at[parent] = node;
        }
        int b = now[i] = m->nbody++;
        bool leaf = from->joint[i - 1].nv && from->joint[i - 1].iv[0] < from->ns;
        body[b] = from->body[i], joint[b - 1] = from->joint[i - 1];
        body[b].parent = joint[b - 1].parent = parent;
        body[b].joint = b - 1, joint[b - 1].child = b;
        if (tree_pick(d, 2)) {
            cloud[b] = random_cloud(1 + tree_pick(d, most), seed * 101u + (unsigned)i, cloud_flags, arena);
            bent_body(&body[b], cloud[b], arena);
        }
        fast[b] = leaf;
        fast_modes[b] = cloud[b] && (leaf || ((flags & TREE_FAST_LEAVES) && tree_pick(d, 3) == 0));
        body[b].fast = body[parent].fast || leaf || fast_modes[b];
    }
    m->njoint = m->nbody - 1;
    m->body = body, m->joint = joint;
    bent_number(m, body, joint, fast, fast_modes, true);
    m->ns = m->n;
    bent_number(m, body, joint, fast, fast_modes, false);
    double *q = TAKE(arena, double, m->nq);
    for (int i = 0; i < m->njoint; i++)
        if (tree_turns(&joint[i], m->space)) tree_quaternion(q + joint[i].iq[joint[i].nq - 4], d, 3);
    m->q0 = q, m->v0 = TAKE(arena, double, m->n);
    return (struct bent){m, cloud};
}

#endif
