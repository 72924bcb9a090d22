/* particles.h -- flexible bodies made of small bodies, and random planar trees that hold them.
 *
 * A small body has mass m, inertia j, stands at x + phi q + 1/2 q' S q and is turned by psi . q; the tables of a
 * flexible body are sums over them.  A tree has rigid and flexible bodies; what hangs on a flexible one stands at a
 * node. */
#ifndef FMDSUB_TESTS_PARTICLES_H
#define FMDSUB_TESTS_PARTICLES_H

#include "flex/body.h"
#include "unit/trees.h"

enum { PARTICLES = 12, MODES = 4, NODES = 4 };

struct particle {
    double m, j, x[2], phi[2 * MODES], psi[MODES], S[2 * MODES * MODES];
};

struct cloud {
    struct particle p[PARTICLES];
    struct flex_body body;
};

/* Symmetric >= 0 [n x n]. */
static inline double *random_form(struct tree_dice *d, int n, struct arena *arena)
{
    double *A = TAKE(arena, double, n *n), B[MODES * MODES];
    for (int i = 0; i < n * n; i++) B[i] = tree_roll(d, -3, 3);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++) A[i + n * j] += B[i + n * k] * B[j + n * k];
    return A;
}

static inline void random_S(double *S, struct tree_dice *d, int n)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++)
            for (int c = 0; c < 2; c++) S[c + 2 * (i + n * j)] = S[c + 2 * (j + n * i)] = tree_roll(d, -.5, .5);
}

static inline void cloud_scatter(struct cloud *o, struct tree_dice *d, int n, bool stiffening)
{
    double mass = 0, at[2] = {0, 0};
    for (int i = 0; i < PARTICLES; i++) {
        struct particle *p = &o->p[i];
        p->m = tree_roll(d, .05, .2);
        p->j = tree_roll(d, 0, .02);
        for (int c = 0; c < 2; c++) p->x[c] = tree_roll(d, -1, 1), at[c] += p->m * p->x[c];
        for (int k = 0; k < 2 * n; k++) p->phi[k] = tree_roll(d, -.5, .5);
        for (int k = 0; k < n; k++) p->psi[k] = tree_roll(d, -.5, .5);
        if (stiffening) random_S(p->S, d, n);
        mass += p->m;
    }
    for (int i = 0; i < PARTICLES; i++)
        for (int c = 0; c < 2; c++) o->p[i].x[c] -= at[c] / mass;
}

static inline void add_products(struct flex_body *b, const struct particle *p, int n)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const int ij = i + n * j;
            b->ppsi[ij] += p->j * p->psi[i] * p->psi[j];
            for (int c = 0; c < 2; c++) {
                if (b->s) b->s[c + 3 * ij] += p->m * p->S[c + 2 * ij];
                for (int e = 0; e < 2; e++) {
                    b->ff[9 * ij + c + 3 * e] += p->m * p->phi[c + 2 * i] * p->phi[e + 2 * j];
                    if (b->xs) b->xs[9 * ij + c + 3 * e] += p->m * p->x[c] * p->S[e + 2 * ij];
                }
            }
        }
}

static inline void add_particle(struct flex_body *b, const struct particle *p, int n)
{
    b->mass += p->m;
    b->rot[8] += p->j;
    for (int c = 0; c < 2; c++)
        for (int e = 0; e < 2; e++) b->xx[c + 3 * e] += p->m * p->x[c] * p->x[e];
    for (int k = 0; k < n; k++) {
        b->rpsi[3 * k + 2] += p->j * p->psi[k];
        for (int c = 0; c < 2; c++) {
            b->f[c + 3 * k] += p->m * p->phi[c + 2 * k];
            for (int e = 0; e < 2; e++) b->xf[9 * k + c + 3 * e] += p->m * p->x[c] * p->phi[e + 2 * k];
        }
    }
    add_products(b, p, n);
}

/* Node 0 is the reference. */
static inline void cloud_nodes(struct flex_body *b, struct tree_dice *d, int n, bool stiffening, struct arena *arena)
{
    b->nnode = NODES;
    b->node = TAKE(arena, struct flex_node, NODES);
    for (int i = 0; i < NODES; i++) {
        struct flex_node *o = &b->node[i];
        double S[2 * MODES * MODES] = {0};
        o->phi = TAKE(arena, double, 3 * n);
        o->psi = TAKE(arena, double, 3 * n);
        if (stiffening) o->S = TAKE(arena, double, 3 * n * n);
        for (int c = 0; c < 2; c++) o->x[c] = tree_roll(d, -1, 1);
        if (i == 0) continue;
        for (int k = 0; k < n; k++) {
            for (int c = 0; c < 2; c++) o->phi[c + 3 * k] = tree_roll(d, -.5, .5);
            o->psi[2 + 3 * k] = tree_roll(d, -.5, .5);
        }
        if (stiffening) random_S(S, d, n);
        for (int k = 0; stiffening && k < n * n; k++)
            for (int c = 0; c < 2; c++) o->S[c + 3 * k] = S[c + 2 * k];
    }
}

/* n <= MODES coordinates. */
static inline struct cloud *random_cloud(struct tree_dice *d, int n, bool stiffening, struct arena *arena)
{
    struct cloud *o = TAKE(arena, struct cloud, 1);
    struct flex_body *b = &o->body;
    cloud_scatter(o, d, n, stiffening);
    b->n = n;
    b->f = TAKE(arena, double, 3 * n);
    b->xf = TAKE(arena, double, 9 * n);
    b->ff = TAKE(arena, double, 9 * n * n);
    b->rpsi = TAKE(arena, double, 3 * n);
    b->ppsi = TAKE(arena, double, n *n);
    if (stiffening) b->s = TAKE(arena, double, 3 * n * n), b->xs = TAKE(arena, double, 9 * n * n);
    b->K = random_form(d, n, arena);
    if (tree_pick(d, 3)) b->D = random_form(d, n, arena);
    for (int i = 0; i < PARTICLES; i++) add_particle(b, &o->p[i], n);
    cloud_nodes(b, d, n, stiffening, arena);
    return o;
}

/* --- trees --------------------------------------------------------------------------------------- */

struct grove {
    struct model m;
    struct model_body *body;
    struct model_joint *joint;
    struct cloud **cloud; /* [nbody] NULL: rigid, or at a node */
};

static inline void grove_flexible(struct grove *o, struct tree_dice *d, int i, bool stiffening, struct arena *arena)
{
    struct model_body *b = &o->body[i];
    struct cloud *c = o->cloud[i] = random_cloud(d, tree_pick(d, MODES + 1), stiffening, arena);
    b->flex = &c->body;
    b->nmode = c->body.n;
    b->mode_q = TAKE(arena, int, b->nmode);
    b->mode_v = TAKE(arena, int, b->nmode);
    b->mass = c->body.mass;
    b->inertia[2] = c->body.xx[0] + c->body.xx[4] + c->body.rot[8];
}

static inline void grove_node(struct grove *o, struct tree_dice *d, int i, int parent)
{
    struct model_body *b = &o->body[i], *p = &o->body[parent];
    double x[3];
    *b = (struct model_body){.name = "node", .parent = parent, .joint = i - 1, .at_node = true};
    b->node = tree_pick(d, NODES);
    memcpy(b->R, p->R, sizeof b->R);
    tree_mv(x, p->R, p->flex->node[b->node].x);
    for (int c = 0; c < 3; c++) b->at[c] = p->at[c] + x[c];
    struct model_joint *j = &o->joint[i - 1];
    *j = (struct model_joint){.name = "hold", .type = JOINT_FIXED, .parent = parent, .child = i};
    memcpy(j->a, p->flex->node[b->node].x, sizeof j->a);
    for (int c = 0; c < 9; c += 4) j->Ea[c] = j->Eb[c] = 1;
}

/* Places in q and v: all that is fast, then the rest; the modes of every second body from its last to its first. */
static inline void grove_number(struct grove *o, const bool *fast_joint, bool *const *fast_mode, bool which)
{
    struct model *m = &o->m;
    for (int i = 1; i < m->nbody; i++) {
        struct model_body *b = &o->body[i];
        struct model_joint *j = &o->joint[i - 1];
        for (int k = 0; fast_joint[i] == which && k < j->nv; k++, m->n++) j->iq[k] = j->iv[k] = m->n;
        for (int k = 0; k < b->nmode; k++) {
            int mode = i % 2 ? k : b->nmode - 1 - k;
            if (fast_mode[i][mode] == which) b->mode_q[mode] = b->mode_v[mode] = m->n, m->n++;
        }
    }
    m->nq = m->n;
    if (which) m->ns = m->n;
}

enum grove_flag { GROVE_FAST = 1, GROVE_STIFFENING = 2, GROVE_ADRIFT = 4, GROVE_CHAIN = 8 };

/* Flexible bodies (two of three) have two nodes behind them; whether a joint or a mode is fast is a matter of luck.
 * ADRIFT: one body on a free joint, all others on it, no gravity. */
static inline struct grove *random_grove(int nbody, unsigned seed, unsigned flags, struct arena *arena)
{
    struct tree_dice dice = {seed * 7919u + (unsigned)nbody * 104729u}, *d = &dice;
    struct grove *o = TAKE(arena, struct grove, 1);
    struct model *m = &o->m;
    int most = 3 * nbody + 1, *holder = TAKE(arena, int, most), nholder = 1, i = 1;
    o->body = TAKE(arena, struct model_body, most);
    o->joint = TAKE(arena, struct model_joint, most);
    o->cloud = TAKE(arena, struct cloud *, most);
    bool *fast_joint = TAKE(arena, bool, most), **fast_mode = TAKE(arena, bool *, most);
    o->body[0] = (struct model_body){.name = "ground", .R = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .parent = -1, .joint = -1};
    for (int made = 0; made < nbody; made++, i++) {
        bool adrift = flags & GROVE_ADRIFT, lone = adrift && made == 0;
        int low = adrift && made;
        int parent = flags & GROVE_CHAIN ? holder[nholder - 1] : holder[low + tree_pick(d, nholder - low)], body = i;
        struct model_body *b = &o->body[i];
        tree_body(b, d, 2);
        b->name = "body", b->parent = parent, b->joint = i - 1;
        if (tree_pick(d, 3)) grove_flexible(o, d, i, flags & GROVE_STIFFENING, arena);
        tree_joint(&o->joint[i - 1], d, o->body, parent, i, 2, lone ? TREE_ADRIFT : 0);
        fast_joint[i] = flags & GROVE_FAST && tree_pick(d, 4) == 0;
        fast_mode[i] = TAKE(arena, bool, MODES);
        b->fast = o->body[parent].fast || (fast_joint[i] && o->joint[i - 1].nv > 0);
        for (int k = 0; k < b->nmode; k++) {
            fast_mode[i][k] = flags & GROVE_FAST && tree_pick(d, 4) == 0;
            b->fast = b->fast || fast_mode[i][k];
        }
        if (!b->flex) holder[nholder++] = i;
        for (int k = 0; b->flex && k < 2; k++) {
            grove_node(o, d, ++i, body);
            o->body[i].fast = b->fast;
            holder[nholder++] = i;
        }
    }
    m->space = 2;
    m->body = o->body, m->joint = o->joint;
    m->nbody = i, m->njoint = i - 1;
    if (!(flags & GROVE_ADRIFT))
        for (int c = 0; c < 2; c++) m->gravity[c] = tree_roll(d, -10, 10);
    grove_number(o, fast_joint, fast_mode, true);
    grove_number(o, fast_joint, fast_mode, false);
    double *q = TAKE(arena, double, m->n), *v = TAKE(arena, double, m->n);
    for (int k = 0; k < m->n; k++) q[k] = tree_roll(d, -1, 1), v[k] = tree_roll(d, -1, 1);
    m->q0 = q, m->v0 = v;
    return o;
}

#endif
