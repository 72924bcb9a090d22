/* t-body.c -- a reduced body's integrals and its change of frame, against sums over the particles of a cloud.
 *
 * Particles with small bodies, fields drawn by lot.  The new frame's fields come from the exact composition of
 * motions, by differences in q; the new integrals from sums over the particles. */
#include "flex/body.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "flex/choice.h"
#include "la/vec3.h"
#include "unit/turn.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { N = 3, COUNT = 12 };

struct particle {
    double m, x[3], I[9], phi[3 * N], psi[3 * N], S[3 * N * N], T[3 * N * N];
};

static double roll(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 * 2 - 1;
}

static void draw(struct particle *o, uint64_t *dice)
{
    double B[9];
    o->m = 1.5 + roll(dice);
    for (int a = 0; a < 9; a++) B[a] = roll(dice);
    m3_mulmt(o->I, B, B);
    for (int a = 0; a < 3; a++) o->x[a] = roll(dice);
    for (int a = 0; a < 3 * N; a++) o->phi[a] = roll(dice), o->psi[a] = roll(dice);
    for (int j = 0; j < N; j++)
        for (int i = 0; i <= j; i++)
            for (int a = 0; a < 3; a++) {
                o->S[a + 3 * (i + N * j)] = o->S[a + 3 * (j + N * i)] = roll(dice);
                o->T[a + 3 * (i + N * j)] = o->T[a + 3 * (j + N * i)] = roll(dice);
            }
}

/* The centre of mass at the origin; particle 0 is the reference: its fields are zero. */
static void cloud(struct particle *o, uint64_t *dice)
{
    double m = 0, mx[3] = {0};
    for (int k = 0; k < COUNT; k++) {
        draw(&o[k], dice);
        m += o[k].m;
        v3_axpy(mx, o[k].m, o[k].x);
    }
    for (int k = 0; k < COUNT; k++) v3_axpy(o[k].x, -1 / m, mx);
    memset(o[0].phi, 0, sizeof o[0].phi);
    memset(o[0].psi, 0, sizeof o[0].psi);
    memset(o[0].S, 0, sizeof o[0].S);
    memset(o[0].T, 0, sizeof o[0].T);
}

static struct flex_body *gather(const struct particle *p, bool stiffening, struct arena *life)
{
    struct flex_body *o = flex_body_take(N, COUNT, 0, stiffening, life);
    for (int k = 0; k < COUNT; k++) {
        v3_copy(o->node[k].x, p[k].x);
        memcpy(o->node[k].phi, p[k].phi, sizeof p[k].phi);
        memcpy(o->node[k].psi, p[k].psi, sizeof p[k].psi);
        if (stiffening) memcpy(o->node[k].S, p[k].S, sizeof p[k].S);
        if (stiffening) memcpy(o->node[k].T, p[k].T, sizeof p[k].T);
        flex_body_add(o, p[k].x, p[k].m, p[k].I, p[k].phi, p[k].psi, stiffening ? p[k].S : NULL, NULL);
    }
    for (int i = 0; i < N * N; i++) o->K[i] = i, o->D[i] = -i;
    return o;
}

static void near(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g", a, b);
}

/* Every integral against the sum that defines it, entry by entry. */
static void check_integrals(const struct flex_body *o, const struct particle *p, double tolerance)
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            double xx = 0, rot = 0;
            for (int k = 0; k < COUNT; k++) xx += p[k].m * p[k].x[a] * p[k].x[b], rot += p[k].I[a + 3 * b];
            near(o->xx[a + 3 * b], xx, tolerance);
            near(o->rot[a + 3 * b], rot, tolerance);
            for (int j = 0; j < N; j++) {
                double xf = 0;
                for (int k = 0; k < COUNT; k++) xf += p[k].m * p[k].x[a] * p[k].phi[b + 3 * j];
                near(o->xf[a + 3 * b + 9 * j], xf, tolerance);
                for (int i = 0; i < N; i++) {
                    double ff = 0, xs = 0;
                    for (int k = 0; k < COUNT; k++) {
                        ff += p[k].m * p[k].phi[a + 3 * i] * p[k].phi[b + 3 * j];
                        xs += p[k].m * p[k].x[a] * p[k].S[b + 3 * (i + N * j)];
                    }
                    near(o->ff[a + 3 * b + 9 * (i + N * j)], ff, tolerance);
                    if (o->xs) near(o->xs[a + 3 * b + 9 * (i + N * j)], xs, tolerance);
                }
            }
        }
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            double ppsi = 0, s[3] = {0}, f[3] = {0}, rpsi[3] = {0};
            for (int k = 0; k < COUNT; k++) {
                double h[3];
                m3_mul(h, p[k].I, p[k].psi + 3 * j);
                ppsi += v3_dot(p[k].psi + 3 * i, h);
                v3_add(rpsi, h);
                v3_axpy(f, p[k].m, p[k].phi + 3 * j);
                v3_axpy(s, p[k].m, p[k].S + 3 * (i + N * j));
            }
            near(o->ppsi[i + N * j], ppsi, tolerance);
            for (int a = 0; a < 3; a++) {
                near(o->f[a + 3 * j], f[a], tolerance);
                near(o->rpsi[a + 3 * j], rpsi[a], tolerance);
                if (o->s) near(o->s[a + 3 * (i + N * j)], s[a], tolerance);
            }
        }
}

static void same(const double *a, const double *b, int n)
{
    for (int k = 0; k < n; k++) near(a[k], b[k], 2e-12);
}

/* What moves the reference node along d and turns about it: every particle goes along u = d + psi x (x - x0). */
static void carried(double *u, const double *d, const struct particle *p, const struct particle *reference)
{
    double arm[3];
    v3_copy(arm, p->x);
    v3_axpy(arm, -1, reference->x);
    v3_cross(u, d + 3, arm);
    v3_add(u, d);
}

/* Inertia between two such motions, its forces on the coordinates, and those of a turn, against sums over the particles.
 * Nothing behind the six numbers of a motion is looked at. */
static void test_loads(void **state)
{
    static const double d[9] = {.3, -.7, .2, 1.1, .4, -.9, NAN, NAN, NAN};
    static const double e[9] = {-.5, .6, .8, .2, -1.3, .7, NAN, NAN, NAN};
    struct arena *life = arena_open();
    struct particle p[COUNT];
    uint64_t dice = 23;
    double between = 0, inertia[N], turning[N];
    (void)state;
    cloud(p, &dice);
    const struct flex_body *o = gather(p, false, life);
    flex_inertia_load(inertia, o, d);
    flex_centrifugal_load(turning, o, d + 3, p[2].x);
    for (int j = 0; j < N; j++) {
        double load = 0, outwards = 0;
        for (int k = 0; k < COUNT; k++) {
            double u[3], arm[3], w[3], h[3];
            carried(u, d, &p[k], &p[0]);
            m3_mul(h, p[k].I, d + 3);
            load -= p[k].m * v3_dot(p[k].phi + 3 * j, u) + v3_dot(p[k].psi + 3 * j, h);
            v3_copy(arm, p[k].x);
            v3_axpy(arm, -1, p[2].x);
            v3_cross(w, d + 3, arm);
            v3_cross(u, d + 3, w);
            outwards -= p[k].m * v3_dot(p[k].phi + 3 * j, u);
        }
        near(inertia[j], load, 1e-12);
        near(turning[j], outwards, 1e-12);
    }
    for (int k = 0; k < COUNT; k++) {
        double u[3], v[3], h[3];
        carried(u, d, &p[k], &p[0]);
        carried(v, e, &p[k], &p[0]);
        m3_mul(h, p[k].I, e + 3);
        between += p[k].m * v3_dot(u, v) + v3_dot(d + 3, h);
    }
    near(flex_inertia_between(o, d, e), between, 1e-12);
    near(flex_inertia_between(o, e, d), between, 1e-12);
    arena_close(life);
}

/* One principal moment far above the sum of the others, on an axis drawn by lot: the mass matrix of turns is psi' I psi and
 * xx is tr I/2 - I, whatever part of it particles can have. */
static void test_excess(void **state)
{
    uint64_t dice = 11;
    (void)state;
    for (int round = 0; round < 9; round++) {
        struct arena *life = arena_open();
        struct flex_body *o = flex_body_take(N, 1, 0, true, life);
        struct particle p;
        double Q[9], I[9] = {0}, Me[N * N], moment[3] = {.7, .4, .2}, none[3 * N] = {0}, origin[3] = {0};
        draw(&p, &dice);
        moment[round % 3] = 2 + roll(&dice) + 1;
        turn_matrix(Q, p.x);
        for (int e = 0; e < 3; e++)
            for (int k = 0; k < 9; k++) I[k] += moment[e] * Q[3 * e + k % 3] * Q[3 * e + k / 3];
        flex_body_add(o, origin, 0, I, none, p.psi, NULL, p.T);
        flex_mass(Me, o);
        for (int j = 0; j < N; j++) {
            double h[3];
            m3_mul(h, I, p.psi + 3 * j);
            for (int i = 0; i < N; i++) near(Me[i + N * j], v3_dot(p.psi + 3 * i, h), 1e-12);
        }
        for (int k = 0; k < 9; k++) near(o->xx[k], (k % 4 == 0 ? (I[0] + I[4] + I[8]) / 2 : 0) - I[k], 1e-12);
        arena_close(life);
    }
}

/* A small body that turns to second order, as six particles around its centre. */
static void test_turning(void **state)
{
    uint64_t dice = 5;
    (void)state;
    for (int round = 0; round < 20; round++) {
        struct arena *life = arena_open();
        struct flex_body *a = flex_body_take(N, 1, 0, true, life), *b = flex_body_take(N, 1, 0, true, life);
        struct particle p;
        double P[3], Q[9], I[9] = {0}, zero[9] = {0};
        draw(&p, &dice);
        for (int e = 0; e < 3; e++) P[e] = 1 + roll(&dice);
        if (round % 3 == 0) P[round % 9 / 3] = 0; /* a disk: its polar moment is the sum of both others */
        turn_matrix(Q, p.psi);
        for (int e = 0; e < 3; e++)
            for (int k = 0; k < 9; k++) I[k] += P[e] * ((k % 4 == 0) - Q[3 * e + k % 3] * Q[3 * e + k / 3]);
        flex_body_add(a, p.x, p.m, I, p.phi, p.psi, p.S, p.T);
        for (int e = 0; e < 6; e++) {
            struct particle c = p;
            double d[3], size = sqrt(3 * P[e % 3] / p.m);
            v3_scale(d, e < 3 ? size : -size, Q + 3 * (e % 3));
            c.m = p.m / 6;
            v3_add(c.x, d);
            for (int j = 0; j < N; j++) v3_cross_add(c.phi + 3 * j, p.psi + 3 * j, d);
            for (int k = 0; k < N * N; k++) {
                const double *pi = p.psi + 3 * (k % N), *pj = p.psi + 3 * (k / N);
                double x[3];
                for (int side = 0; side < 2; side++) {
                    v3_cross(x, side ? pi : pj, d);
                    v3_scale(x, .5, x);
                    v3_cross_add(c.S + 3 * k, side ? pj : pi, x);
                }
                v3_cross_add(c.S + 3 * k, p.T + 3 * k, d);
            }
            flex_body_add(b, c.x, c.m, zero, c.phi, c.psi, c.S, NULL);
        }
        same(a->xx, b->xx, 9);
        same(a->f, b->f, 3 * N);
        same(a->xf, b->xf, 9 * N);
        same(a->ff, b->ff, 9 * N * N);
        same(a->s, b->s, 3 * N * N);
        same(a->xs, b->xs, 9 * N * N);
        same(a->rot, zero, 9);
        same(a->rpsi, zero, 3 * N);
        same(a->ppsi, zero, N * N);
        arena_close(life);
    }
}

static void test_integrals(void **state)
{
    struct arena *life = arena_open();
    struct particle p[COUNT];
    uint64_t dice = 5;
    double Me[N * N];
    (void)state;
    cloud(p, &dice);
    struct flex_body *o = gather(p, true, life);
    check_integrals(o, p, 1e-13);
    flex_mass(Me, o);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            double sum = 0;
            for (int k = 0; k < COUNT; k++) {
                double h[3];
                m3_mul(h, p[k].I, p[k].psi + 3 * j);
                sum += p[k].m * v3_dot(p[k].phi + 3 * i, p[k].phi + 3 * j) + v3_dot(p[k].psi + 3 * i, h);
            }
            near(Me[i + N * j], sum, 1e-13);
        }
    arena_close(life);
}

/* u = phi q + 1/2 q' S q. */
static void moved(double *u, const struct particle *p, const double *q)
{
    v3_set(u, 0, 0, 0);
    for (int j = 0; j < N; j++) {
        v3_axpy(u, q[j], p->phi + 3 * j);
        for (int i = 0; i < N; i++) v3_axpy(u, q[i] * q[j] / 2, p->S + 3 * (i + N * j));
    }
}

/* How the small body is turned, to second order: psi q + 1/2 q' T q. */
static void turned(double *R, const struct particle *p, const double *q)
{
    double theta[3] = {0};
    for (int j = 0; j < N; j++) {
        v3_axpy(theta, q[j], p->psi + 3 * j);
        for (int i = 0; i < N; i++) v3_axpy(theta, q[i] * q[j] / 2, p->T + 3 * (i + N * j));
    }
    turn_matrix(R, theta);
}

/* The axis of its turn, of the length of its sine, seen from the frame that moves with particle 0's. */
static void turn_seen(double *axis, const struct particle *p, const struct particle *zero, const double *q)
{
    double A[9], B[9], R[9];
    turned(A, zero, q);
    turned(B, p, q);
    m3_tmulm(R, A, B);
    v3_set(axis, (R[5] - R[7]) / 2, (R[6] - R[2]) / 2, (R[1] - R[3]) / 2);
}

/* The displacement seen from the frame that moves with particle 0's small body, to all orders. */
static void seen(double *u, const struct particle *p, const struct particle *zero, const double *q)
{
    double R[9], u0[3], d[3];
    turned(R, zero, q);
    moved(u, p, q);
    moved(u0, zero, q);
    v3_sum(d, p->x, u);
    v3_take(d, zero->x);
    v3_take(d, u0);
    m3_tmul(u, R, d);
    v3_add(u, zero->x);
    v3_take(u, p->x);
}

/* The particle's fields in the new frame, by central differences. */
static void refer_particle(struct particle *o, const struct particle *p, const struct particle *zero)
{
    static const double h = 3e-4;
    *o = *p;
    for (int j = 0; j < N; j++) {
        double q[N] = {0}, up[3], down[3];
        q[j] = h;
        seen(up, p, zero, q);
        q[j] = -h;
        seen(down, p, zero, q);
        for (int a = 0; a < 3; a++) o->phi[a + 3 * j] = (up[a] - down[a]) / (2 * h);
        v3_diff(o->psi + 3 * j, p->psi + 3 * j, zero->psi + 3 * j);
        for (int i = 0; i < N; i++) {
            double sum[3] = {0}, turn[3] = {0};
            for (int k = 0; k < 4; k++) {
                double both[N] = {0}, u[3];
                both[i] += k & 1 ? -h : h;
                both[j] += k & 2 ? -h : h;
                seen(u, p, zero, both);
                v3_axpy(sum, (k == 0 || k == 3 ? 1 : -1) / (4 * h * h), u);
                turn_seen(u, p, zero, both);
                v3_axpy(turn, (k == 0 || k == 3 ? 1 : -1) / (4 * h * h), u);
            }
            v3_copy(o->T + 3 * (i + N * j), turn);
            v3_copy(o->S + 3 * (i + N * j), sum);
        }
    }
}

static void test_refer(void **state)
{
    struct arena *life = arena_open();
    struct particle p[COUNT], other[COUNT];
    uint64_t dice = 23;
    const double tolerance = 3e-5;
    (void)state;
    cloud(p, &dice);
    struct flex_body *o = flex_refer(gather(p, true, life), 4, life);
    for (int k = 0; k < COUNT; k++) refer_particle(&other[k], &p[k], &p[4]);
    check_integrals(o, other, tolerance);
    assert_int_equal(o->reference, 4);
    assert_null(o->hertz);
    for (int k = 0; k < COUNT; k++)
        for (int a = 0; a < 3 * N * N; a++) {
            near(o->node[k].S[a], other[k].S[a], tolerance);
            near(o->node[k].T[a], other[k].T[a], tolerance);
            if (a < 3 * N) near(o->node[k].phi[a], other[k].phi[a], tolerance);
            if (a < 3 * N) near(o->node[k].psi[a], other[k].psi[a], 1e-15);
            if (k == 4) assert_true(o->node[k].S[a] == 0 && o->node[k].T[a] == 0);
        }
    for (int k = 0; k < N * N; k++) assert_true(o->K[k] == k && o->D[k] == -k);
    arena_close(life);
}

/* To another node and back. */
static void test_back(void **state)
{
    struct arena *life = arena_open();
    struct particle p[COUNT];
    uint64_t dice = 31;
    (void)state;
    for (int stiffening = 0; stiffening < 2; stiffening++) {
        cloud(p, &dice);
        struct flex_body *a = gather(p, stiffening, life), *there = flex_refer(a, 7, life);
        struct flex_body *b = flex_refer(there, 0, life);
        assert_true(fabs(there->f[0] - a->f[0]) > 1e-3);
        same(a->f, b->f, 3 * N);
        same(a->xf, b->xf, 9 * N);
        same(a->ff, b->ff, 9 * N * N);
        same(a->rpsi, b->rpsi, 3 * N);
        same(a->ppsi, b->ppsi, N * N);
        assert_true(stiffening ? b->s && b->xs : !b->s && !b->xs && !b->node[3].S);
        if (stiffening) same(a->s, b->s, 3 * N * N);
        if (stiffening) same(a->xs, b->xs, 9 * N * N);
        for (int k = 0; k < COUNT; k++) {
            same(a->node[k].phi, b->node[k].phi, 3 * N);
            same(a->node[k].psi, b->node[k].psi, 3 * N);
            if (stiffening) same(a->node[k].S, b->node[k].S, 3 * N * N);
            if (stiffening) same(a->node[k].T, b->node[k].T, 3 * N * N);
        }
    }
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_integrals), cmocka_unit_test(test_excess), cmocka_unit_test(test_turning),
        cmocka_unit_test(test_refer),     cmocka_unit_test(test_back),   cmocka_unit_test(test_loads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
