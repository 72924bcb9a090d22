/* t-motion.c -- the inertia of a flexible body against particles, and against differences of its own energy. */
#include "flex/motion.h"

#include "la/dense.h"
#include "unit/clouds.h"
#include "unit/near.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { N = CLOUD_MOST, SEEDS = 40 };

struct scene {
    struct arena *arena;
    struct cloud *cloud;
    struct flex_kernel *k;
    struct flex_shape shape;
    int n;
    double v[3], w[3], a[3], al[3], q[N], q1[N], q2[N];
};

static void open_scene(struct scene *o, unsigned seed, unsigned flags)
{
    struct tree_dice d = {seed + 5};
    o->arena = arena_open();
    o->n = 1 + (int)(seed % N);
    o->cloud = random_cloud(o->n, seed, flags, o->arena);
    o->k = flex_kernel_build(&o->cloud->body, o->arena);
    flex_shape_take(&o->shape, o->k, o->arena);
    double *const part[] = {o->v, o->w, o->a, o->al};
    for (int i = 0; i < 4; i++) cloud_field(part[i], &d, 3, 2);
    cloud_field(o->q, &d, o->n, .5);
    cloud_field(o->q1, &d, o->n, 1);
    cloud_field(o->q2, &d, o->n, 2);
}

static void cross(double *o, const double *a, const double *b)
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        o[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static void add_cross(double *o, double s, const double *a, const double *b)
{
    double x[3];
    cross(x, a, b);
    for (int i = 0; i < 3; i++) o[i] += s * x[i];
}

static double dot(const double *a, const double *b, int n)
{
    double x = 0;
    for (int i = 0; i < n; i++) x += a[i] * b[i];
    return x;
}

static void inertia(double *F, double *N3, double *Q, struct scene *o, bool elastic)
{
    flex_shape_at(&o->shape, o->k, o->q);
    flex_inertia(F, N3, Q, o->k, &o->shape, o->a, o->w, o->al, o->q, o->q1, o->q2, elastic);
}

/* ---- particles ---- */

/* Sum over particles of m s x acceleration and so on, acceleration of a particle in frame axes. */
static void particles_need(double *F, double *N3, double *Q, const struct scene *o)
{
    memset(F, 0, 3 * sizeof *F), memset(N3, 0, 3 * sizeof *N3), memset(Q, 0, sizeof *Q * N);
    for (int k = 0; k < CLOUD_PARTICLES; k++) {
        const struct particle *p = &o->cloud->p[k];
        double s[3], d[3 * N], u1[3] = {0}, acc[3], ws[3];
        cloud_place(s, d, p, o->q, o->n);
        memcpy(acc, o->a, sizeof acc);
        for (int i = 0; i < o->n; i++)
            for (int c = 0; c < 3; c++) {
                u1[c] += d[c + 3 * i] * o->q1[i];
                acc[c] += d[c + 3 * i] * o->q2[i];
                for (int j = 0; j < o->n; j++) acc[c] += p->S[c + 3 * (i + o->n * j)] * o->q1[i] * o->q1[j];
            }
        cross(ws, o->w, s);
        add_cross(acc, 1, o->al, s);
        add_cross(acc, 1, o->w, ws);
        add_cross(acc, 2, o->w, u1);
        for (int c = 0; c < 3; c++) F[c] += p->m * acc[c];
        add_cross(N3, p->m, s, acc);
        for (int i = 0; i < o->n; i++) Q[i] += p->m * dot(d + 3 * i, acc, 3);
    }
}

static void particles_carry(double *P, double *L, double *T, const struct scene *o)
{
    memset(P, 0, 3 * sizeof *P), memset(L, 0, 3 * sizeof *L), *T = 0;
    for (int k = 0; k < CLOUD_PARTICLES; k++) {
        const struct particle *p = &o->cloud->p[k];
        double s[3], d[3 * N], v[3];
        cloud_place(s, d, p, o->q, o->n);
        memcpy(v, o->v, sizeof v);
        add_cross(v, 1, o->w, s);
        for (int i = 0; i < o->n; i++)
            for (int c = 0; c < 3; c++) v[c] += d[c + 3 * i] * o->q1[i];
        for (int c = 0; c < 3; c++) P[c] += p->m * v[c];
        add_cross(L, p->m, s, v);
        *T += .5 * p->m * dot(v, v, 3);
    }
}

/* Displacements linear in q: nothing is dropped. */
static void test_particles(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        double F[3], N3[3], Q[N], of_F[3], of_N[3], of_Q[N], T, of_T;
        open_scene(&o, seed, 0);
        inertia(F, N3, Q, &o, false);
        particles_need(of_F, of_N, of_Q, &o);
        NEAR(F, of_F, 3, 1e-13);
        NEAR(N3, of_N, 3, 1e-13);
        NEAR(Q, of_Q, o.n, 1e-13);
        flex_momentum(F, N3, NULL, o.k, &o.shape, o.v, o.w, o.q1);
        T = flex_kinetic(o.k, &o.shape, o.v, o.w, o.q1);
        particles_carry(of_F, of_N, &of_T, &o);
        NEAR(F, of_F, 3, 1e-13);
        NEAR(N3, of_N, 3, 1e-13);
        NEAR(&T, &of_T, 1, 1e-13);
        arena_close(o.arena);
    }
}

static void scale_state(struct scene *o, double s)
{
    for (int i = 0; i < o->n; i++) o->q[i] *= s, o->q1[i] *= s, o->q2[i] *= s;
}

/* With S, F and N are exact to the second order of q and Q to the first. */
static void test_orders(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        double error_F[2], error_N[2], error_Q[2];
        open_scene(&o, seed, CLOUD_S);
        scale_state(&o, 1e-2);
        for (int run = 0; run < 2; run++) {
            double F[3], N3[3], Q[N], of_F[3], of_N[3], of_Q[N];
            inertia(F, N3, Q, &o, false);
            particles_need(of_F, of_N, of_Q, &o);
            error_F[run] = worst(F, of_F, 3);
            error_N[run] = worst(N3, of_N, 3);
            error_Q[run] = worst(Q, of_Q, o.n);
            scale_state(&o, .1);
        }
        assert_true(error_F[0] < 1e-4 && error_N[0] < 1e-4 && error_Q[0] < 1e-2);
        assert_true(error_F[1] < 2e-3 * error_F[0] + 1e-13 && error_N[1] < 2e-3 * error_N[0]);
        assert_true(error_Q[1] < 2e-2 * error_Q[0]);
        arena_close(o.arena);
    }
}

/* ---- energy ---- */

/* The state a time t later, to the second order: v' = a - w x v. */
static void later(struct scene *o, const struct scene *from, double t)
{
    *o = *from;
    double v1[3];
    memcpy(v1, from->a, sizeof v1);
    add_cross(v1, -1, from->w, from->v);
    for (int c = 0; c < 3; c++) o->v[c] += t * v1[c], o->w[c] += t * from->al[c];
    for (int i = 0; i < o->n; i++) {
        o->q[i] += t * (from->q1[i] + .5 * t * from->q2[i]);
        o->q1[i] += t * from->q2[i];
    }
    flex_shape_at(&o->shape, o->k, o->q);
}

/* P, L, dT/dq' and the energy T + V, one after the other. */
static void store(double *x, struct scene *o)
{
    double Me[N * N], H[3 * N], G[3 * N];
    for (int j = 0; j < o->n; j++) flex_mass_column(Me + o->n * j, H + 3 * j, G + 3 * j, o->k, &o->shape, j);
    flex_momentum(x, x + 3, NULL, o->k, &o->shape, o->v, o->w, o->q1);
    for (int i = 0; i < o->n; i++) {
        x[6 + i] = dot(H + 3 * i, o->v, 3) + dot(G + 3 * i, o->w, 3);
        for (int j = 0; j < o->n; j++) x[6 + i] += Me[i < j ? i + o->n * j : j + o->n * i] * o->q1[j];
    }
    x[6 + o->n] = flex_kinetic(o->k, &o->shape, o->v, o->w, o->q1) + flex_elastic(o->k, o->q);
}

static void rates(double *rate, const struct scene *o)
{
    const double h = 1e-3;
    double x[4][7 + N];
    struct scene at;
    for (int i = 0; i < 4; i++) {
        later(&at, o, (i < 2 ? i - 2 : i - 1) * h);
        store(x[i], &at);
    }
    for (int i = 0; i < 7 + o->n; i++) rate[i] = (8 * (x[2][i] - x[1][i]) - (x[3][i] - x[0][i])) / (12 * h);
}

/* d(T - V)/dq. */
static void gradient(double *g, const struct scene *o)
{
    const double h = 1e-3;
    for (int j = 0; j < o->n; j++) {
        double x[4];
        for (int i = 0; i < 4; i++) {
            struct scene at = *o;
            at.q[j] += (i < 2 ? i - 2 : i - 1) * h;
            flex_shape_at(&at.shape, at.k, at.q);
            x[i] = flex_kinetic(at.k, &at.shape, at.v, at.w, at.q1) - flex_elastic(at.k, at.q);
        }
        g[j] = (8 * (x[2] - x[1]) - (x[3] - x[0])) / (12 * h);
    }
}

/* Boltzmann and Hamel's equations of the kernel's T, all terms by differences; and the power. */
static void test_lagrange(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        double F[3], N3[3], Q[N], P[7 + N], rate[7 + N], g[N], power;
        open_scene(&o, seed, CLOUD_S | CLOUD_ROTARY | (seed % 2 ? CLOUD_DAMPED : 0));
        inertia(F, N3, Q, &o, true);
        power = dot(F, o.v, 3) + dot(N3, o.w, 3) + dot(Q, o.q1, o.n);
        const double *D = o.cloud->body.D;
        for (int i = 0; D && i < o.n; i++) {
            double Dq = dot(D + o.n * i, o.q1, o.n);
            power -= Dq * o.q1[i];
            Q[i] -= Dq;
        }
        store(P, &o);
        rates(rate, &o);
        gradient(g, &o);
        NEAR(&rate[6 + o.n], &power, 1, 1e-9);
        add_cross(rate, 1, o.w, P);
        add_cross(rate + 3, 1, o.w, P + 3);
        add_cross(rate + 3, 1, o.v, P);
        for (int i = 0; i < o.n; i++) rate[6 + i] -= g[i];
        NEAR(rate, F, 3, 1e-9);
        NEAR(rate + 3, N3, 3, 1e-9);
        NEAR(rate + 6, Q, o.n, 1e-9);
        arena_close(o.arena);
    }
}

/* Column j of dQ/dx by central differences, x one of o's own q, q1. */
static void difference(double *slope, struct scene *o, double *x)
{
    const double step = 1e-5, at = *x;
    double up[N], down[N], F[3], N3[3];
    *x = at + step;
    inertia(F, N3, up, o, false);
    *x = at - step;
    inertia(F, N3, down, o, false);
    *x = at;
    for (int i = 0; i < o->n; i++) slope[i] = (up[i] - down[i]) / (2 * step);
}

/* What the coordinates' forces change by, with the turning frame given. */
static void test_slopes(void **state)
{
    (void)state;
    static const unsigned kinds[] = {0, CLOUD_ROTARY, CLOUD_S, CLOUD_S | CLOUD_ROTARY | CLOUD_DAMPED};
    double all = 0;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        double K[N * N] = {0}, C[N * N] = {0}, dK[N * N], dC[N * N];
        open_scene(&o, seed, kinds[seed % 4]);
        const int n = o.n;
        for (int j = 0; j < n; j++) {
            difference(dK + n * j, &o, &o.q[j]);
            difference(dC + n * j, &o, &o.q1[j]);
        }
        flex_shape_at(&o.shape, o.k, o.q);
        flex_slopes(K, C, o.k, &o.shape, o.a, o.w, o.al, o.q1, o.q2);
        NEAR(K, dK, n * n, 1e-8);
        NEAR(C, dC, n * n, 1e-8);
        for (int i = 0; i < n * n; i++) all += fabs(K[i]) + fabs(C[i]);
        arena_close(o.arena);
    }
    assert_true(all > 1000);
}

/* M [6 + n] by column from unit accelerations, less what is there without. */
static void matrix(double *M, struct scene *o)
{
    const int n = 6 + o->n;
    double none[6 + N], *const at[3] = {o->a, o->al, o->q2};
    for (int i = 0; i < 3; i++) memset(at[i], 0, sizeof *at[i] * (size_t)(i < 2 ? 3 : o->n));
    inertia(none, none + 3, none + 6, o, true);
    for (int j = 0; j < n; j++) {
        double *x = &at[j < 6 ? j / 3 : 2][j < 6 ? j % 3 : j - 6];
        *x = 1;
        inertia(M + n * j, M + n * j + 3, M + n * j + 6, o, true);
        for (int i = 0; i < n; i++) M[i + n * j] -= none[i];
        *x = 0;
    }
}

static void test_matrix(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o, unit;
        double M[(6 + N) * (6 + N)], r[6 + N], other[6 + N], T, of_T = 0, x[6 + N], y[6 + N];
        open_scene(&o, seed, CLOUD_S | CLOUD_ROTARY | CLOUD_DAMPED);
        const int n = 6 + o.n;
        inertia(r, r + 3, r + 6, &o, true);
        unit = o;
        matrix(M, &unit);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < i; j++) assert_true(fabs(M[i + n * j] - M[j + n * i]) < 1e-11);
        inertia(other, other + 3, other + 6, &unit, true);
        memcpy(x, o.a, 24), memcpy(x + 3, o.al, 24), memcpy(x + 6, o.q2, sizeof *x * (size_t)o.n);
        memcpy(y, o.v, 24), memcpy(y + 3, o.w, 24), memcpy(y + 6, o.q1, sizeof *y * (size_t)o.n);
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                other[i] += M[i + n * j] * x[j];
                of_T += .5 * y[i] * M[i + n * j] * y[j];
            }
        NEAR(other, r, n, 1e-12);
        T = flex_kinetic(o.k, &o.shape, o.v, o.w, o.q1);
        NEAR(&T, &of_T, 1, 1e-12);
        arena_close(o.arena);
    }
}

/* The energy is a square: positive however large q is, with second-order displacements, too. */
static void test_positive(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        double M[(6 + N) * (6 + N)];
        open_scene(&o, seed, CLOUD_S | CLOUD_ROTARY);
        scale_state(&o, 10);
        matrix(M, &o);
        assert_true(dense_cholesky(M, 6 + o.n, 6 + o.n) < 0);
        arena_close(o.arena);
    }
}

/* A NULL is zero, and calling twice gives the same bits. */
static void test_nothing(void **state)
{
    (void)state;
    struct scene o;
    double x[6 + N] = {0}, y[6 + N] = {0}, zero[N] = {0};
    open_scene(&o, 7, CLOUD_S | CLOUD_ROTARY | CLOUD_DAMPED);
    flex_shape_at(&o.shape, o.k, o.q);
    flex_inertia(x, x + 3, x + 6, o.k, &o.shape, o.a, o.w, o.al, o.q, zero, zero, true);
    flex_inertia(y, y + 3, y + 6, o.k, &o.shape, o.a, o.w, o.al, o.q, NULL, NULL, true);
    assert_memory_equal(x, y, sizeof x);
    inertia(x, x + 3, x + 6, &o, true);
    inertia(y, y + 3, y + 6, &o, true);
    assert_memory_equal(x, y, sizeof x);
    arena_close(o.arena);
}

/* ---- nodes ---- */

/* w x = W where R' = W R, from the entries that must be antisymmetric. */
static void test_places(void **state)
{
    (void)state;
    const double h = 1e-3;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o, there;
        struct flex_place p, at;
        double x[4][3 + 9 + 6], rate[18], W[9], w[3], dx[3], dw[3];
        open_scene(&o, seed, (seed % 3 ? CLOUD_S : 0) | (seed % 2 ? CLOUD_T : 0));
        flex_place_take(&p, o.k, o.arena);
        flex_place_take(&at, o.k, o.arena);
        flex_place_at(&p, o.k, 2, o.q);
        flex_place_move(&p, o.k, 2, o.q1);
        flex_place_accelerate(&p, o.k, o.q2);
        for (int i = 0; i < 4; i++) {
            later(&there, &o, (i < 2 ? i - 2 : i - 1) * h);
            flex_place_at(&at, o.k, 2, there.q);
            flex_place_move(&at, o.k, 2, there.q1);
            memcpy(x[i], at.x, 24), memcpy(x[i] + 3, at.R, 72);
            memcpy(x[i] + 12, at.v, 24), memcpy(x[i] + 15, at.w, 24);
        }
        for (int i = 0; i < 18; i++) rate[i] = (8 * (x[2][i] - x[1][i]) - (x[3][i] - x[0][i])) / (12 * h);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double RR = 0;
                W[i + 3 * j] = 0;
                for (int k = 0; k < 3; k++) RR += p.R[i + 3 * k] * p.R[j + 3 * k];
                for (int k = 0; k < 3; k++) W[i + 3 * j] += rate[3 + i + 3 * k] * p.R[j + 3 * k];
                assert_true(fabs(RR - (i == j)) < 1e-14);
            }
        for (int i = 0; i < 3; i++) w[i] = W[(i + 2) % 3 + 3 * ((i + 1) % 3)];
        NEAR(rate, p.v, 3, 1e-10);
        NEAR(w, p.w, 3, 1e-10);
        NEAR(rate + 12, p.a, 3, 1e-10);
        NEAR(rate + 15, p.al, 3, 1e-10);
        for (int c = 0; c < 3; c++) {
            dx[c] = dw[c] = 0;
            for (int i = 0; i < o.n; i++) dx[c] += p.dx[c + 3 * i] * o.q1[i], dw[c] += p.dw[c + 3 * i] * o.q1[i];
        }
        NEAR(dx, p.v, 3, 1e-14);
        NEAR(dw, p.w, 3, 1e-14);
        arena_close(o.arena);
    }
}

/* R is the Cayley map: (1 - [theta]x/2) R = 1 + [theta]x/2. */
static void test_cayley(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        struct flex_place p;
        double theta[3] = {0};
        open_scene(&o, seed, 0);
        flex_place_take(&p, o.k, o.arena);
        flex_place_at(&p, o.k, 1, o.q);
        for (int i = 0; i < o.n; i++)
            for (int c = 0; c < 3; c++) theta[c] += .5 * o.cloud->body.node[1].psi[c + 3 * i] * o.q[i];
        for (int i = 0; i < 3; i++) {
            double e[3] = {i == 0, i == 1, i == 2}, left[3], right[3];
            memcpy(left, p.R + 3 * i, sizeof left), memcpy(right, e, sizeof e);
            add_cross(left, -1, theta, p.R + 3 * i);
            add_cross(right, 1, theta, e);
            NEAR(left, right, 3, 1e-14);
        }
        arena_close(o.arena);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_particles), cmocka_unit_test(test_orders),   cmocka_unit_test(test_lagrange),
        cmocka_unit_test(test_matrix),    cmocka_unit_test(test_positive), cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_places),    cmocka_unit_test(test_cayley),   cmocka_unit_test(test_slopes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
