/* planar_flex_factor.c -- the modes in the articulated bodies of planar_factor.c.
 *
 * A flexible body with all that hangs on it resists the twist V of its frame and the rates x of its modes with
 *
 *     | I  U | V        U [3 x n], M = cm Me + diag(d) [n x n], both with sum over nodes of B_c' I_c B_c
 *     | U' M | x
 *
 * where I_c is the articulated inertia of the body at node c and B_c its twists by the modes.  The modes are
 * eliminated all together, M = L L',
 *
 *     Z' = M^-1 U',   I := I - U Z',   and on the right side, with p_c the forces at the nodes,
 *     y = b - sum B_c' p_c,   p := p + Z y,   x = M^-1 y - Z' V,   V_c := V_c + B_c x.
 *
 * A mode with d = INFINITY is held: its row of U and its row and column of M are taken out, and its L is INFINITY,
 * so that its x is 0. */
#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/vec3.h"
#include "tree/planar_flex.h"

void planar_flex_start(struct sweep *s, double cm, const double *d, const bool *only)
{
    for (int i = 1; i < s->nbody; i++) {
        struct flexible *b = s->bend[i];
        double h[2], *I = s->part[i].I;
        if (!b || (only && !only[i])) continue;
        planar_flex_shape(b);
        planar_flex_first_moment(h, b);
        I[0] = cm * b->shape.J;
        I[1] = -cm * h[1];
        I[2] = cm * h[0];
        I[3] = I[5] = cm * s->model->body[i].mass;
        planar_flex_own(b);
        for (int k = 0; k < 3 * b->n; k++) b->U[k] *= cm;
        for (int k = 0; k < b->n * b->n; k++) b->M[k] *= cm;
        for (int k = 0; k < b->n; k++)
            if (d[b->iv[k]] != INFINITY) b->M[k + b->n * k] += d[b->iv[k]];
    }
}

/* Row and column k of M [n x n, lower triangle] become those of the unit matrix. */
static void isolate(double *M, int k, int n)
{
    for (int i = 0; i < k; i++) M[k + n * i] = 0;
    for (int i = k + 1; i < n; i++) M[i + n * k] = 0;
    M[k + n * k] = 1;
}

/* I -= U Z' */
static void take_out(double *I, const double *U, const double *Z, int n)
{
    static const int row[6] = {0, 0, 0, 1, 1, 2}, col[6] = {0, 1, 2, 1, 2, 2};
    for (int e = 0; e < 6; e++)
        for (int k = 0; k < n; k++) I[e] -= U[row[e] + 3 * k] * Z[k + n * col[e]];
}

static int eliminate(double *F, double *I, struct flexible *b, const double *d)
{
    const int n = b->n;
    double *L = F + b->at, *Z = L + n * n; /* [n x n], [n x 3] */
    memcpy(L, b->M, sizeof *L * (size_t)(n * n));
    for (int k = 0; k < n; k++) {
        const bool held = d[b->iv[k]] == INFINITY;
        if (held) isolate(L, k, n);
        for (int c = 0; c < 3; c++) Z[k + n * c] = held ? 0 : b->U[c + 3 * k];
    }
    if (dense_cholesky(L, n, n) >= 0) return 0;
    for (int k = 0; k < n; k++)
        if (d[b->iv[k]] == INFINITY) L[k + n * k] = INFINITY;
    dense_cholesky_solves(L, Z, n, n, 3, n);
    take_out(I, b->U, Z, n);
    return 1;
}

int planar_flex_eliminate(struct sweep *s, double *F, int body, const double *d)
{
    struct part *x = &s->part[body];
    const struct node_body *o = s->node_body[body];
    if (o) {
        planar_flex_couple(o, x->I, x->arm);
        for (int k = 0; k < o->of->n; k++) planar_node_body_unit(F + o->at + 3 * k, o, k);
    }
    return s->bend[body] ? eliminate(F, x->I, s->bend[body], d) : 1;
}

/* The modes' right sides stand in x until their body's turn comes. */
void planar_flex_forces(const struct sweep *s, const double *F, double *p, double *x, int body)
{
    const struct node_body *o = s->node_body[body];
    const struct flexible *b = s->bend[body];
    for (int k = 0; o && k < o->of->n; k++) x[o->of->iv[k]] -= v3_dot(F + o->at + 3 * k, p);
    if (!b) return;
    const int n = b->n;
    const double *L = F + b->at, *Z = L + n * n;
    double *y = b->Q;
    for (int k = 0; k < n; k++) y[k] = x[b->iv[k]];
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < n; k++) p[c] += Z[k + n * c] * y[k];
    dense_cholesky_solve(L, y, n, n);
    for (int k = 0; k < n; k++) x[b->iv[k]] = y[k];
}

void planar_flex_twist(const struct sweep *s, const double *F, double *V, double *x, int body)
{
    const struct node_body *o = s->node_body[body];
    const struct flexible *b = s->bend[body];
    for (int k = 0; o && k < o->of->n; k++)
        for (int c = 0; c < 3; c++) V[c] += F[o->at + (size_t)(3 * k + c)] * x[o->of->iv[k]];
    if (!b) return;
    const double *Z = F + b->at + b->n * b->n;
    for (int k = 0; k < b->n; k++) x[b->iv[k]] -= Z[k] * V[0] + Z[k + b->n] * V[1] + Z[k + 2 * b->n] * V[2];
}
