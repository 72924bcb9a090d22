/* particles.h -- random planar flexible bodies made of small bodies.
 *
 * A small body has mass m, inertia j, stands at x + phi q + 1/2 q' S q and is turned by psi . q; the tables of a
 * flexible body are sums over them. */
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

#endif
