/* statics.c -- see statics.h */
#include "flex/statics.h"

#include <math.h>
#include <string.h>

#include "flex/rod.h"
#include "la/band.h"
#include "la/vec3.h"

/* ---- kinds ---- */

/* Energies of the fields W at a station, by kind, times two. */
static void add_energy(double *e, const struct flex_beam *beam, double station, double ds, const double *W)
{
    struct flex_section c;
    rod_section(&c, beam, station);
    const double co = cos(c.twist), si = sin(c.twist), *g = W + ROD_GAMMA, *k = W + ROD_KAPPA;
    const double gy = co * g[1] + si * g[2], gz = co * g[2] - si * g[1];
    const double ky = co * k[1] + si * k[2], kz = co * k[2] - si * k[1];
    e[FLEX_STRETCH] += ds * beam->E * c.A * g[0] * g[0];
    e[FLEX_BENDING_Y] += ds * (beam->E * c.Iz * kz * kz + beam->G * c.A * c.ky * gy * gy);
    if (beam->space == 2) return;
    e[FLEX_TORSION] += ds * beam->G * c.J * k[0] * k[0];
    e[FLEX_BENDING_Z] += ds * (beam->E * c.Iy * ky * ky + beam->G * c.A * c.kz * gz * gz);
}

static enum flex_kind kind_of(const struct rod *rod, const double *phi)
{
    static const double most = 0.9; /* of the energy: else it is mixed */
    double e[4] = {0}, W[12], all = 0;
    for (int k = 0; k < ROD_GAUSS * (rod->nnode - 1); k++) {
        rod_at_point(W, rod, k, phi, 1);
        add_energy(e, rod->beam, rod->point[k].s / rod->length, rod->point[k].ds, W);
    }
    for (int k = 0; k < 4; k++) all += e[k];
    for (int k = 0; k < 4; k++)
        if (e[k] >= most * all) return k;
    return FLEX_MIXED;
}

/* ---- the whole ---- */

/* The six directions d of a node, displacements and rotations along body axes, in the freedoms x of a mesh node. */
static void direction(double *x, const struct rod *rod, const double *axes, int d)
{
    double e[3] = {0, 0, 0}, b[3];
    e[d % 3] = 1;
    m3_tmul(b, axes, e);
    memset(x, 0, (size_t)rod->per * sizeof *x);
    for (int a = 0; a < 3; a++) {
        const int turn = d >= 3;
        if (rod->per == 6)
            x[a + 3 * turn] = b[a];
        else if (turn ? a == 2 : a < 2)
            x[turn ? 2 : a] = b[a];
    }
}

/* Rigid motion of the whole mesh, `d` at the reference node. */
static void rigid(double *R, const struct rod *rod, const double *axes, int reference, int d)
{
    double x[6] = {0};
    direction(x, rod, axes, d);
    for (int k = 0; k < rod->nnode; k++) {
        const double arm = rod->s[k] - rod->s[reference];
        double *at = R + (long)k * rod->per;
        memcpy(at, x, (size_t)rod->per * sizeof *at);
        if (rod->per == 6) {
            at[1] += arm * x[5];
            at[2] -= arm * x[4];
        } else
            at[1] += arm * x[2];
    }
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* A with the reference node held, factored; false: it is not positive. */
static bool held(struct band *L, const struct band *A, int per, int reference, struct arena *scratch)
{
    *L = band_copy(A, scratch);
    for (int a = 0; a < per; a++) band_isolate(L, per * reference + a, 1);
    return band_cholesky(L) < 0;
}

/* o [6 x 6] = B' A^-1 B by columns; work [size]. */
static void through(double *o, const struct band *L, const double *B, double *work)
{
    const int size = L->n;
    for (int j = 0; j < 6; j++) {
        memcpy(work, B + (long)j * size, (size_t)size * sizeof *work);
        band_cholesky_solve(L, work);
        for (int i = 0; i < 6; i++) o[i + 6 * j] = dot(B + (long)i * size, work, size);
    }
}

/* The parts that the modes have. */
static void add_modes(struct flex_statics *o, const double *B, const double *lambda, const double *Phi, int n, int size)
{
    for (int k = 0; k < n; k++) {
        double h[6];
        for (int i = 0; i < 6; i++) h[i] = dot(B + (long)i * size, Phi + (long)k * size, size);
        for (int j = 0; j < 36; j++) {
            o->mass_part[j] += h[j % 6] * h[j / 6];
            if (lambda[k] > 0) o->part[j] += h[j % 6] * h[j / 6] / lambda[k];
        }
    }
}

static void at_nodes(struct flex_statics *o, const struct flex_body *body, const struct rod *rod, const struct band *L,
                     const int *mesh, int reference, const double *axes, struct arena *scratch)
{
    const int size = L->n;
    double *E = TAKE_MATRIX(scratch, double, size, 6), *work = TAKE(scratch, double, size);
    for (int k = 0; k < body->nnode; k++) {
        memset(E, 0, (size_t)(6 * size) * sizeof *E);
        for (int d = 0; d < 6 && mesh[k] != reference; d++)
            direction(E + (long)d * size + (long)mesh[k] * rod->per, rod, axes, d);
        through(o->node + 36 * k, L, E, work);
    }
}

/* How far the modes move [m] and turn [rad] a node of the mesh at most: far [2 x n]. */
static void farthest(double *far, const struct rod *rod, const double *Phi, int n)
{
    const int per = rod->per, size = rod->nnode * per;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < size; i += per) {
            const double *x = Phi + (long)size * j + i;
            far[2 * j] = fmax(far[2 * j], per == 3 ? hypot(x[0], x[1]) : v3_norm(x));
            far[2 * j + 1] = fmax(far[2 * j + 1], per == 3 ? fabs(x[2]) : v3_norm(x + 3));
        }
}

void flex_statics_make(struct flex_body *o, const struct rod *rod, const struct band *K, const struct band *M,
                       const double *lambda, const double *Phi, const int *mesh, int reference, const double *axes,
                       struct arena *life, struct arena *scratch)
{
    const int size = K->n, per = rod->per;
    struct flex_statics *s = TAKE(life, struct flex_statics, 1);
    double *B = TAKE_MATRIX(scratch, double, size, 6), *R = TAKE(scratch, double, size);
    struct band L;
    o->far = TAKE(life, double, 2 * o->n);
    farthest(o->far, rod, Phi, o->n);
    s->kind = TAKE(life, enum flex_kind, o->n);
    for (int k = 0; k < o->n; k++) s->kind[k] = kind_of(rod, Phi + (long)k * size);
    s->node = TAKE_MATRIX(life, double, 36, o->nnode);
    for (int d = 0; d < 6; d++) {
        rigid(R, rod, axes, reference, d);
        band_mul(B + (long)d * size, M, R);
        for (int a = 0; a < per; a++) B[(long)d * size + per * reference + a] = 0;
    }
    add_modes(s, B, lambda, Phi, o->n, size);
    if (held(&L, M, per, reference, scratch)) through(s->mass, &L, B, R);
    if (!held(&L, K, per, reference, scratch)) return;
    through(s->energy, &L, B, R);
    at_nodes(s, o, rod, &L, mesh, reference, axes, scratch);
    v3_copy(s->along, axes);
    o->statics = s;
}

/* ---- shares ---- */

static double form(const double *A, const double *d)
{
    double sum = 0;
    for (int j = 0; j < 36; j++) sum += d[j % 6] * A[j] * d[j / 6];
    return sum;
}

static double most(const double *A, int from, int to)
{
    double sum = 0;
    for (int k = from; k < to; k++) sum = fmax(sum, A[7 * k]);
    return sum;
}

/* d without displacement or force along the beam. */
static void across(double *o, const struct flex_statics *s, const double *d)
{
    memcpy(o, d, 6 * sizeof *o);
    v3_axpy(o, -v3_dot(d, s->along), s->along);
}

static double size(const double *A, const double *d)
{
    return v3_dot(d, d) * most(A, 0, 3) + v3_dot(d + 3, d + 3) * most(A, 3, 6);
}

/* Of what a force and moment at a node bend there, the modes' part. */
static double at_node(const struct flex_body *o, int node, const double *d)
{
    double kept = 0;
    for (int k = 0; k < o->n; k++) {
        const double lambda = o->K[k * (o->n + 1)];
        const double x = v3_dot(d, o->node[node].phi + 3 * k) + v3_dot(d + 3, o->node[node].psi + 3 * k);
        if (lambda > 0) kept += x * x / lambda;
    }
    return kept;
}

static double part(double kept, double all)
{
    return all > 0 ? fmin(kept / all, 1) : 1;
}

bool flex_kept_of_load(struct flex_kept *o, const struct flex_body *body, int node, const double *d)
{
    const double *C = body->statics->node + 36 * node, all = form(C, d);
    double e[6];
    if (!(all > 0)) return false;
    across(e, body->statics, d);
    *o = (struct flex_kept){part(at_node(body, node, d), all), -1, part(at_node(body, node, e), form(C, e)),
                            form(C, e) / size(C, d)};
    return true;
}

bool flex_kept_of_motion(struct flex_kept *o, const struct flex_body *body, const double *d)
{
    const struct flex_statics *s = body->statics;
    const double all = form(s->energy, d), mass = form(s->mass, d);
    double e[6];
    if (!(all > 0)) return false;
    across(e, s, d);
    *o = (struct flex_kept){part(form(s->part, d), all), mass > 0 ? part(form(s->mass_part, d), mass) : -1,
                            part(form(s->part, e), form(s->energy, e)), form(s->energy, e) / size(s->energy, d)};
    return true;
}
