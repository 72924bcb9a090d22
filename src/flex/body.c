/* body.c -- see body.h
 *
 * The change of frame: node 0 stands at x0 + u0 and is turned by R0 = cay(theta + tau), theta = psi_0 q, tau =
 * q'T_0q/2. Seen from the frame that moves with it, a particle stands where
 *
 *     x + u' = x0 + R0' (x + u - x0 - u0),     d = x - x0,
 *
 * and with R0' = 1 - [theta]x + [theta]x^2 / 2 - [tau]x + ..., to second order in q,
 *
 *     u' = u - u0 - theta x d - theta x (phi q - phi_0 q) + theta x (theta x d) / 2 - tau x d.
 *
 * Its linear part is affine in x: phi_j' = phi_j + b_j - P_j x with P_j = [psi_0j]x, b_j = P_j x0 - phi_0j.  Its
 * quadratic part gives, symmetrised,
 *
 *     S_ij' = S_ij - S_0ij - P_i (phi_j - phi_0j) - P_j (phi_i - phi_0i) + (P_i P_j + P_j P_i) d / 2 - [T_0ij]x d.
 *
 * A node's own turn R is R0' R there: with psi' = psi - psi_0 and cay(a)' cay(b) = cay(b - a - a x b / 2 + ...)
 *
 *     T_ij' = T_ij - T_0ij - (psi_0i x psi_j + psi_0j x psi_i) / 2.
 *
 * The new integrals follow term by term from the old ones, with int x dm = 0 and P' = -P. */
#include "flex/statics.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"
#include "la/vec3.h"

static void take_node(struct flex_node *o, int n, bool stiffening, struct arena *life)
{
    o->phi = TAKE(life, double, 3 * n);
    o->psi = TAKE(life, double, 3 * n);
    o->S = stiffening ? TAKE(life, double, 3 * n * n) : NULL;
    o->T = stiffening ? TAKE(life, double, 3 * n * n) : NULL;
}

struct flex_body *flex_body_take(int n, int nnode, int nstress, bool stiffening, struct arena *life)
{
    struct flex_body *o = TAKE(life, struct flex_body, 1);
    o->n = n;
    o->nnode = nnode;
    o->node = TAKE(life, struct flex_node, nnode);
    for (int k = 0; k < nnode; k++) take_node(&o->node[k], n, stiffening, life);
    o->nstress = nstress;
    o->stress = TAKE(life, struct flex_stress, nstress);
    for (int k = 0; k < nstress; k++)
        o->stress[k] =
            (struct flex_stress){NULL, TAKE(life, double, 6 * n), TAKE(life, double, n), TAKE(life, double, n), false};
    o->f = TAKE(life, double, 3 * n);
    o->xf = TAKE(life, double, 9 * n);
    o->ff = TAKE(life, double, 9 * n * n);
    o->rpsi = TAKE(life, double, 3 * n);
    o->ppsi = TAKE(life, double, n *n);
    o->s = stiffening ? TAKE(life, double, 3 * n * n) : NULL;
    o->xs = stiffening ? TAKE(life, double, 9 * n * n) : NULL;
    o->K = TAKE(life, double, n *n);
    o->D = TAKE(life, double, n *n);
    o->hertz = TAKE(life, double, n);
    return o;
}

/* O += s a b'. */
static void add_outer(double *O, double s, const double *a, const double *b)
{
    for (int j = 0; j < 3; j++) v3_axpy(O + 3 * j, s * b[j], a);
}

/* The part of rotary inertia I that particles around the centre can have, as P = int d d' dm = tr I/2 - I; I keeps
 * the excess where one principal moment is above the sum of the others. */
static void spread(double *P, double *I)
{
    double X[9], A[9], lambda[3];
    memcpy(A, I, sizeof A);
    eigen_symmetric(lambda, X, A, 3);
    const double excess = fmax(lambda[2] - lambda[1] - lambda[0], 0);
    const double half = (lambda[0] + lambda[1] + lambda[2] - excess) / 2;
    memset(I, 0, 9 * sizeof *I);
    memset(P, 0, 9 * sizeof *P);
    add_outer(I, excess, X + 6, X + 6);
    for (int a = 0; a < 3; a++) add_outer(P, half - lambda[a] + (a == 2 ? excess : 0), X + 3 * a, X + 3 * a);
}

/* A small body turned to second order is particles at d around its centre that are displaced, against it, by
 *
 *     theta x d + 1/2 q_i q_j L_ij d,   L_ij = (theta_i theta_j' + theta_j theta_i')/2 - theta_i.theta_j + [T_ij]x;
 *
 * of their integrals those of products of two d stay.  Of its turns it takes A psi q. */
static void add_spread(struct flex_body *o, const double *P, const double *A, const double *psi, const double *T)
{
    const int n = o->n;
    for (int a = 0; a < 9; a++) o->xx[a] += P[a];
    for (int j = 0; j < n; j++) {
        double pj[3];
        m3_mul(pj, A, psi + 3 * j);
        double Y[9]; /* int d (theta_j x d)' dm = P [theta_j]x' */
        const double turn[9] = {0, pj[2], -pj[1], -pj[2], 0, pj[0], pj[1], -pj[0], 0};
        m3_mulmt(Y, P, turn);
        for (int a = 0; a < 9; a++) o->xf[a + 9 * j] += Y[a];
        for (int i = 0; i < n; i++) {
            double pi[3], t[3] = {0};
            m3_mul(pi, A, psi + 3 * i);
            if (T) v3_copy(t, T + 3 * (i + n * j));
            double *ff = o->ff + 9 * (i + n * j), *xs = o->xs + 9 * (i + n * j);
            for (int c = 0; c < 3; c++) v3_cross_add(ff + 3 * c, pi, Y + 3 * c);
            for (int c = 0; c < 3; c++) { /* row c of L */
                double row[3], x[3];
                v3_scale(row, .5 * pi[c], pj);
                v3_axpy(row, .5 * pj[c], pi);
                row[c] -= v3_dot(pi, pj);
                row[(c + 1) % 3] -= t[(c + 2) % 3];
                row[(c + 2) % 3] += t[(c + 1) % 3];
                m3_mul(x, P, row);
                v3_add(xs + 3 * c, x);
            }
        }
    }
}

/* Inertia I = excess a a': it turns with the frame, and by the small body's turns about a alone, so that its axis does
 * not tilt.  Particles have it with negative masses along a. */
static void add_excess(struct flex_body *o, const double *I, const double *psi)
{
    const double excess = I[0] + I[4] + I[8];
    double P[9], A[9];
    for (int k = 0; k < 9; k++) {
        A[k] = I[k] / excess;
        P[k] = (k % 4 == 0 ? excess / 2 : 0) - I[k];
    }
    add_spread(o, P, A, psi, NULL);
}

/* Inertia that keeps the axes of the frame. */
static void add_constant(struct flex_body *o, const double *I, const double *psi)
{
    const int n = o->n;
    for (int a = 0; a < 9; a++) o->rot[a] += I[a];
    for (int j = 0; j < n; j++) {
        double h[3];
        m3_mul(h, I, psi + 3 * j);
        v3_add(o->rpsi + 3 * j, h);
        for (int i = 0; i < n; i++) o->ppsi[i + n * j] += v3_dot(psi + 3 * i, h);
    }
}

void flex_body_add(struct flex_body *o, const double *x, double m, const double *spin, const double *phi,
                   const double *psi, const double *S, const double *T)
{
    static const double ROUND_OFF = 1e-9;
    const int n = o->n;
    double P[9], I[9], A[9];
    memcpy(I, spin, sizeof I);
    o->mass += m;
    add_outer(o->xx, m, x, x);
    for (int j = 0; j < n; j++) {
        const double *fj = phi + 3 * j;
        v3_axpy(o->f + 3 * j, m, fj);
        add_outer(o->xf + 9 * j, m, x, fj);
        for (int i = 0; i < n; i++) add_outer(o->ff + 9 * (i + n * j), m, phi + 3 * i, fj);
    }
    if (T && o->s) {
        m3_unit(A);
        spread(P, I);
        add_spread(o, P, A, psi, T);
        if (I[0] + I[4] + I[8] > ROUND_OFF * (spin[0] + spin[4] + spin[8])) {
            add_excess(o, I, psi);
            memset(I, 0, sizeof I);
        }
    }
    add_constant(o, I, psi);
    if (!S || !o->s) return;
    for (int k = 0; k < n * n; k++) {
        v3_axpy(o->s + 3 * k, m, S + 3 * k);
        add_outer(o->xs + 9 * k, m, x, S + 3 * k);
    }
}

void flex_mass(double *Me, const struct flex_body *o)
{
    for (int k = 0; k < o->n * o->n; k++) {
        const double *B = o->ff + 9 * k;
        Me[k] = B[0] + B[4] + B[8] + o->ppsi[k];
    }
}

/* The rigid motion taken out, by coordinate. */
struct rigid {
    double x0[3];
    const double *phi, *psi, *S, *T; /* of the new reference; S, T NULL: zero */
    double *b;                       /* [3 x n] */
    double *P;                       /* [9 x n] */
};

static struct rigid rigid_of(const struct flex_node *o, int n, struct arena *life)
{
    struct rigid r = {{o->x[0], o->x[1], o->x[2]}, o->phi, o->psi, o->S, o->T, TAKE(life, double, 3 * n), NULL};
    r.P = TAKE(life, double, 9 * n);
    for (int j = 0; j < n; j++) {
        const double *p = o->psi + 3 * j;
        double P[9] = {0, p[2], -p[1], -p[2], 0, p[0], p[1], -p[0], 0};
        memcpy(r.P + 9 * j, P, sizeof P);
        v3_cross(r.b + 3 * j, p, o->x);
        v3_take(r.b + 3 * j, o->phi + 3 * j);
    }
    return r;
}

/* S += the quadratic part of the rigid motion at d = x - x0 where the field less that of node 0 is phi. */
static void add_turn(double *S, const struct rigid *r, int n, int i, int j, const double *d, const double *fi,
                     const double *fj)
{
    const double *pi = r->psi + 3 * i, *pj = r->psi + 3 * j;
    double a[3], b[3];
    v3_cross(a, pj, d);
    v3_axpy(a, -2, fj);
    v3_cross(b, pi, d);
    v3_axpy(b, -2, fi);
    v3_scale(a, 0.5, a);
    v3_scale(b, 0.5, b);
    v3_cross_add(S, pi, a);
    v3_cross_add(S, pj, b);
    if (!r->T) return;
    v3_cross(a, r->T + 3 * (i + n * j), d);
    v3_take(S, a);
}

static void refer_turn(struct flex_node *o, const struct flex_node *old, const struct rigid *r, int n)
{
    for (int k = 0; o->T && k < n * n; k++) {
        const int i = k % n, j = k / n;
        double *T = o->T + 3 * k, x[3];
        if (old->T) v3_copy(T, old->T + 3 * k);
        if (r->T) v3_take(T, r->T + 3 * k);
        v3_cross(x, r->psi + 3 * i, old->psi + 3 * j);
        v3_cross_add(x, r->psi + 3 * j, old->psi + 3 * i);
        v3_axpy(T, -.5, x);
    }
}

static void refer_node(struct flex_node *o, const struct flex_node *old, const struct rigid *r, int n)
{
    double d[3], *phi = o->phi;
    o->name = old->name;
    v3_copy(o->x, old->x);
    v3_diff(d, old->x, r->x0);
    for (int j = 0; j < n; j++) v3_diff(phi + 3 * j, old->phi + 3 * j, r->phi + 3 * j);
    for (int k = 0; o->S && k < n * n; k++) {
        double *S = o->S + 3 * k;
        if (old->S) v3_copy(S, old->S + 3 * k);
        if (r->S) v3_take(S, r->S + 3 * k);
        add_turn(S, r, n, k % n, k / n, d, phi + 3 * (k % n), phi + 3 * (k / n));
    }
    refer_turn(o, old, r, n);
    for (int j = 0; j < n; j++) {
        double turn[3];
        v3_cross(turn, r->psi + 3 * j, d);
        v3_take(phi + 3 * j, turn);
        v3_diff(o->psi + 3 * j, old->psi + 3 * j, r->psi + 3 * j);
    }
}

/* f, xf, rpsi. */
static void refer_single(struct flex_body *o, const struct flex_body *old, const struct rigid *r)
{
    for (int j = 0; j < o->n; j++) {
        double h[3], X[9];
        v3_copy(o->f + 3 * j, old->f + 3 * j);
        v3_axpy(o->f + 3 * j, old->mass, r->b + 3 * j);
        m3_mulm(X, old->xx, r->P + 9 * j);
        for (int a = 0; a < 9; a++) o->xf[a + 9 * j] = old->xf[a + 9 * j] + X[a];
        m3_mul(h, old->rot, r->psi + 3 * j);
        v3_diff(o->rpsi + 3 * j, old->rpsi + 3 * j, h);
    }
}

/* ff_ij' = ff + f_i b_j' + b_i f_j' + m b_i b_j' + xf_i' P_j - P_i xf_j - P_i xx P_j. */
static void refer_pair(struct flex_body *o, const struct flex_body *old, const struct rigid *r, int i, int j)
{
    int n = o->n, k = i + n * j;
    const double *Pi = r->P + 9 * i, *Pj = r->P + 9 * j, *bi = r->b + 3 * i, *bj = r->b + 3 * j;
    double *F = o->ff + 9 * k, X[9], Y[9], h[3];
    memcpy(F, old->ff + 9 * k, sizeof X);
    add_outer(F, 1, old->f + 3 * i, bj);
    add_outer(F, 1, bi, old->f + 3 * j);
    add_outer(F, old->mass, bi, bj);
    m3_tmulm(X, old->xf + 9 * i, Pj);
    for (int a = 0; a < 9; a++) F[a] += X[a];
    m3_mulm(X, old->xx, Pj);
    for (int a = 0; a < 9; a++) X[a] += old->xf[a + 9 * j];
    m3_mulm(Y, Pi, X);
    for (int a = 0; a < 9; a++) F[a] -= Y[a];
    const double *pi = r->psi + 3 * i, *pj = r->psi + 3 * j;
    m3_mul(h, old->rot, pj);
    o->ppsi[k] = old->ppsi[k] - v3_dot(pi, old->rpsi + 3 * j) - v3_dot(pj, old->rpsi + 3 * i) + v3_dot(pi, h);
}

/* s_ij' = s - m S_0 - P_i (f_j - m phi_0j) - P_j (f_i - m phi_0i) - m (P_i P_j + P_j P_i) x0 / 2,
 * xs_ij' = xs + xf_j P_i + xf_i P_j + xx (P_j P_i + P_i P_j) / 2 + xx [T_0]x; s_ij' + m [T_0]x x0. */
static void refer_second(struct flex_body *o, const struct flex_body *old, const struct rigid *r, int i, int j)
{
    int n = o->n, k = i + n * j;
    double d[3], fi[3], fj[3], *s = o->s + 3 * k, *xs = o->xs + 9 * k, X[9], Y[9];
    v3_scale(d, -old->mass, r->x0);
    v3_copy(fi, old->f + 3 * i);
    v3_axpy(fi, -old->mass, r->phi + 3 * i);
    v3_copy(fj, old->f + 3 * j);
    v3_axpy(fj, -old->mass, r->phi + 3 * j);
    v3_copy(s, old->s + 3 * k);
    if (r->S) v3_axpy(s, -old->mass, r->S + 3 * k);
    add_turn(s, r, n, i, j, d, fi, fj);
    memcpy(xs, old->xs + 9 * k, sizeof X);
    for (int side = 0; side < 2; side++) {
        int p = side ? i : j, q = side ? j : i;
        m3_mulm(X, old->xx, r->P + 9 * p);
        for (int a = 0; a < 9; a++) X[a] = X[a] / 2 + old->xf[a + 9 * p];
        m3_mulm(Y, X, r->P + 9 * q);
        for (int a = 0; a < 9; a++) xs[a] += Y[a];
    }
    if (!r->T) return;
    const double *t = r->T + 3 * k, turn[9] = {0, t[2], -t[1], -t[2], 0, t[0], t[1], -t[0], 0};
    m3_mulm(X, old->xx, turn);
    for (int a = 0; a < 9; a++) xs[a] += X[a];
}

static bool moves(const struct flex_node *o, int n)
{
    for (int k = 0; k < 3 * n; k++)
        if (o->phi[k] != 0 || o->psi[k] != 0) return true;
    return false;
}

/* At most: the rigid motion is added where it is farthest. */
static void refer_far(struct flex_body *o, const struct flex_body *old, const struct rigid *r, struct arena *life)
{
    double arm = 0, d[3];
    for (int k = 0; k < old->nnode; k++) {
        v3_diff(d, old->node[k].x, r->x0);
        arm = fmax(arm, v3_norm(d));
    }
    o->far = TAKE(life, double, 2 * o->n);
    for (int j = 0; j < o->n; j++) {
        const double turn = v3_norm(r->psi + 3 * j);
        o->far[2 * j] = old->far[2 * j] + v3_norm(r->phi + 3 * j) + turn * arm;
        o->far[2 * j + 1] = old->far[2 * j + 1] + turn;
    }
}

struct flex_body *flex_refer(const struct flex_body *old, int node, struct arena *life)
{
    int n = old->n;
    struct flex_body *o = flex_body_take(n, old->nnode, 0, old->s != NULL, life);
    struct rigid r = rigid_of(&old->node[node], n, life);
    o->reference = node;
    o->affine = old->affine;
    o->nstress = old->nstress;
    o->stress = old->stress;
    o->mass = old->mass;
    memcpy(o->xx, old->xx, sizeof o->xx);
    memcpy(o->rot, old->rot, sizeof o->rot);
    for (int k = 0; k < n * n; k++) o->K[k] = old->K[k];
    for (int k = 0; old->D && k < n * n; k++) o->D[k] = old->D[k];
    if (!old->D) o->D = NULL;
    o->chosen = old->chosen;
    if (old->far) refer_far(o, old, &r, life);
    if (old->statics) {
        o->statics = TAKE(life, struct flex_statics, 1);
        if (!moves(&old->node[node], n)) *o->statics = *old->statics;
        o->statics->kind = old->statics->kind;
    }
    if (moves(&old->node[node], n) || !old->hertz)
        o->hertz = NULL;
    else
        memcpy(o->hertz, old->hertz, (size_t)n * sizeof *o->hertz);
    for (int k = 0; k < o->nnode; k++) refer_node(&o->node[k], &old->node[k], &r, n);
    refer_single(o, old, &r);
    for (int k = 0; k < n * n; k++) refer_pair(o, old, &r, k % n, k / n);
    for (int k = 0; old->s && k < n * n; k++) refer_second(o, old, &r, k % n, k / n);
    return o;
}
