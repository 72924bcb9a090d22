/* clouds.h -- random flexible bodies for tests: clouds of particles whose places are exact functions of q.
 *
 * Particle p stands at x_p + phi_p q + q' S_p q/2 in the frame; small solids, turning by psi q, give rotary inertia.
 * The integrals of struct flex_body are sums over them. */
#ifndef FMDSUB_TESTS_CLOUDS_H
#define FMDSUB_TESTS_CLOUDS_H

#include "flex/body.h"
#include "unit/trees.h"

enum cloud_flag { CLOUD_S = 1, CLOUD_ROTARY = 2, CLOUD_DAMPED = 4, CLOUD_T = 8 };
enum { CLOUD_PARTICLES = 30, CLOUD_SOLIDS = 4, CLOUD_NODES = 5, CLOUD_MOST = 8 };

struct particle {
    double m, x[3], phi[3 * CLOUD_MOST], S[3 * CLOUD_MOST * CLOUD_MOST];
};

struct solid {
    double I[9], psi[3 * CLOUD_MOST];
};

struct cloud {
    int n;
    struct particle p[CLOUD_PARTICLES];
    struct solid solid[CLOUD_SOLIDS];
    struct flex_body body;
};

static inline void cloud_field(double *x, struct tree_dice *d, int n, double size)
{
    for (int i = 0; i < n; i++) x[i] = tree_roll(d, -size, size);
}

/* [3 x n x n], symmetric in the last two. */
static inline void cloud_curvature(double *S, struct tree_dice *d, int n)
{
    cloud_field(S, d, 3 * n * n, .3);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++)
            for (int c = 0; c < 3; c++) S[c + 3 * (j + n * i)] = S[c + 3 * (i + n * j)];
}

/* B'B, B [n x n] random. */
static inline void cloud_square(double *A, struct tree_dice *d, int n, double size)
{
    double B[CLOUD_MOST * CLOUD_MOST];
    cloud_field(B, d, n * n, sqrt(size));
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++) A[i + n * j] += B[k + n * i] * B[k + n * j];
}

static inline void cloud_outer(double *B, double s, const double *a, const double *b)
{
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) B[i + 3 * j] += s * a[i] * b[j];
}

static inline void cloud_add_particle(struct flex_body *o, const struct particle *p)
{
    const int n = o->n;
    o->mass += p->m;
    cloud_outer(o->xx, p->m, p->x, p->x);
    for (int j = 0; j < n; j++) {
        const double *phi = p->phi + 3 * j;
        for (int c = 0; c < 3; c++) o->f[c + 3 * j] += p->m * phi[c];
        cloud_outer(o->xf + 9 * j, p->m, p->x, phi);
        for (int i = 0; i < n; i++) cloud_outer(o->ff + 9 * (i + n * j), p->m, p->phi + 3 * i, phi);
    }
    if (!o->s) return;
    for (int k = 0; k < n * n; k++) {
        for (int c = 0; c < 3; c++) o->s[c + 3 * k] += p->m * p->S[c + 3 * k];
        cloud_outer(o->xs + 9 * k, p->m, p->x, p->S + 3 * k);
    }
}

static inline void cloud_add_solid(struct flex_body *o, const struct solid *p)
{
    const int n = o->n;
    for (int i = 0; i < 9; i++) o->rot[i] += p->I[i];
    for (int j = 0; j < n; j++) {
        double L[3];
        tree_mv(L, p->I, p->psi + 3 * j);
        for (int c = 0; c < 3; c++) {
            o->rpsi[c + 3 * j] += L[c];
            for (int i = 0; i < n; i++) o->ppsi[i + n * j] += p->psi[c + 3 * i] * L[c];
        }
    }
}

static inline void cloud_body(struct cloud *o, struct tree_dice *d, unsigned flags, struct arena *arena)
{
    struct flex_body *b = &o->body;
    const int n = o->n, nn = n * n;
    *b = (struct flex_body){.n = n, .nnode = CLOUD_NODES};
    b->node = TAKE(arena, struct flex_node, CLOUD_NODES);
    for (int k = 0; k < CLOUD_NODES; k++) {
        struct flex_node *node = &b->node[k];
        tree_vector(node->x, d, 3);
        node->phi = TAKE(arena, double, 3 * n);
        node->psi = TAKE(arena, double, 3 * n);
        cloud_field(node->phi, d, 3 * n, 1);
        cloud_field(node->psi, d, 3 * n, 1);
        if (flags & CLOUD_T) cloud_curvature(node->T = TAKE(arena, double, 3 * nn), d, n);
        if (!(flags & CLOUD_S)) continue;
        node->S = TAKE(arena, double, 3 * nn);
        cloud_curvature(node->S, d, n);
    }
    b->f = TAKE(arena, double, 3 * n), b->xf = TAKE(arena, double, 9 * n), b->ff = TAKE(arena, double, 9 * nn);
    b->rpsi = TAKE(arena, double, 3 * n), b->ppsi = TAKE(arena, double, nn);
    b->K = TAKE(arena, double, nn);
    if (flags & CLOUD_S) b->s = TAKE(arena, double, 3 * nn), b->xs = TAKE(arena, double, 9 * nn);
    for (int p = 0; p < CLOUD_PARTICLES; p++) cloud_add_particle(b, &o->p[p]);
    for (int p = 0; p < CLOUD_SOLIDS; p++) cloud_add_solid(b, &o->solid[p]);
    cloud_square(b->K, d, n, 5);
    if (!(flags & CLOUD_DAMPED)) return;
    b->D = TAKE(arena, double, nn);
    cloud_square(b->D, d, n, .5);
}

/* n coordinates, at most CLOUD_MOST. */
static inline struct cloud *random_cloud(int n, unsigned seed, unsigned flags, struct arena *arena)
{
    struct tree_dice dice = {seed * 65537u + 3}, *d = &dice;
    struct cloud *o = TAKE(arena, struct cloud, 1);
    double mass = 0, at[3] = {0};
    o->n = n;
    for (int k = 0; k < CLOUD_PARTICLES; k++) {
        struct particle *p = &o->p[k];
        p->m = tree_roll(d, .01, .1);
        tree_vector(p->x, d, 3);
        cloud_field(p->phi, d, 3 * n, 1);
        if (flags & CLOUD_S) cloud_curvature(p->S, d, n);
        mass += p->m;
        for (int c = 0; c < 3; c++) at[c] += p->m * p->x[c];
    }
    for (int k = 0; k < CLOUD_PARTICLES; k++)
        for (int c = 0; c < 3; c++) o->p[k].x[c] -= at[c] / mass;
    for (int k = 0; k < CLOUD_SOLIDS && (flags & CLOUD_ROTARY); k++) {
        cloud_square(o->solid[k].I, d, 3, .1);
        cloud_field(o->solid[k].psi, d, 3 * n, 1);
    }
    cloud_body(o, d, flags, arena);
    return o;
}

/* Where a particle stands in the frame, and its partial velocity [3 x n]. */
static inline void cloud_place(double *s, double *d, const struct particle *p, const double *q, int n)
{
    for (int c = 0; c < 3; c++) s[c] = p->x[c];
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) {
            double Sq = 0;
            for (int j = 0; j < n; j++) Sq += p->S[c + 3 * (i + n * j)] * q[j];
            d[c + 3 * i] = p->phi[c + 3 * i] + Sq;
            s[c] += (p->phi[c + 3 * i] + .5 * Sq) * q[i];
        }
}

#endif
