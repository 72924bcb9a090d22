/* t-beam.c -- beams made into reduced bodies: frequencies, statics, the rigid body.
 *
 * Exact frequencies: roots of the transcendental equations (Blevins, Formulas for Natural Frequency and Mode Shape,
 * 1979), Timoshenko's by transfer matrix. */
#include "flex/beam.h"

#include "flex/statics.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"
#include "la/vec3.h"
#include "unit/rods.h"
#include "unit/turn.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near(double a, double b, double relative)
{
    if (!(fabs(a - b) <= relative * fabs(b))) fail_msg("%.15g is not %.15g to %g", a, b, relative);
}

static const double CLAMPED_FREE[] = {1.8751040687119611, 4.694091132974175, 7.854757438237613,
                                      10.995540734875467, 14.13716839104647, 17.278759532088237};
static const double CLAMPED_CLAMPED[] = {4.730040744862704,  7.853204624095838, 10.995607838001671,
                                         14.137165491257464, 17.27875965739948, 20.42035224562606};
static const double CLAMPED_PINNED[] = {3.926602312047919,  7.068582745628732, 10.210176122813031,
                                        13.351768777754094, 16.49336143134641, 19.634954084936208};

/* ---- frequencies of a cantilever ---- */

/* Hertz of bending with beta L = root, of a bar in the plane. */
static double bending(double root, const struct flex_beam *o)
{
    double L = o->b[0], c = sqrt(o->E * o->section->Iz / (o->density * o->section->A));
    return root * root / (L * L) * c / (2 * acos(-1));
}

static double cantilever_error(int elements, int n)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.01, 0.01);
    struct flex_beam o = bar(2, 1, elements, n, &c, 1, ROOT_ONLY);
    double at[3], exact[6];
    for (int i = 0; i < n; i++) exact[i] = bending(CLAMPED_FREE[i], &o);
    double worst = error(made(&o, at, life)->hertz, exact, n);
    arena_close(life);
    return worst;
}

static void test_cantilever(void **state)
{
    (void)state;
    assert_true(cantilever_error(20, 6) < 1e-3);
    for (int elements = 10; elements <= 20; elements *= 2) { /* the order is four */
        double ratio = cantilever_error(elements, 3) / cantilever_error(2 * elements, 3);
        assert_true(ratio > 15 && ratio < 17);
    }
}

/* The textbook's element matrices, assembled full and clamped at the left. */
static void textbook(double *lambda, int elements, double h, double EI, double m)
{
    static const double k[4][4] = {{12, 6, -12, 6}, {6, 4, -6, 2}, {-12, -6, 12, -6}, {6, 2, -6, 4}};
    static const double a[4][4] = {{156, 22, 54, -13}, {22, 4, 13, -3}, {54, 13, 156, -22}, {-13, -3, -22, 4}};
    static double K[MOST * MOST], M[MOST * MOST], X[MOST * MOST];
    int n = 2 * elements;
    memset(K, 0, sizeof K);
    memset(M, 0, sizeof M);
    for (int e = 0; e < elements; e++)
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++) {
                int r = 2 * e + i - 2, s = 2 * e + j - 2;
                double f = (i % 2 ? h : 1) * (j % 2 ? h : 1);
                if (r < 0 || s < 0) continue;
                K[r + n * s] += EI / (h * h * h) * f * k[i][j];
                M[r + n * s] += m * h / 420 * f * a[i][j];
            }
    assert_int_equal(eigen_general(lambda, X, K, M, n), -1);
}

static void test_textbook(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.02, 0.01);
    struct flex_beam o = bar(2, 1, 10, 30, &c, 1, ROOT_ONLY);
    double at[3], lambda[MOST];
    struct flex_body *body = made(&o, at, life);
    (void)state;
    textbook(lambda, 10, 0.1, o.E * c.Iz, o.density * c.A);
    for (int i = 0; i < 20; i++) {
        double hertz = sqrt(lambda[i]) / (2 * acos(-1)), best = INFINITY;
        for (int j = 0; j < body->n; j++) best = fmin(best, fabs(body->hertz[j] / hertz - 1));
        assert_true(best < 1e-8);
    }
    arena_close(life);
}

/* Steel, 0.1 x 0.1 x 1 m, shear factor 5/6, rotary inertia: bending in both planes, stretch, torsion. */
static void test_timoshenko(void **state)
{
    static const double exact[] = {82.8943626933222, 496.8145316089103, 1306.698072983852, 2370.3084057433134};
    static const double axial[] = {1293.0485382587126, 3879.1456147761382};
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.1, 0.1);
    double at[3], error[2][4];
    c.ky = c.kz = 5.0 / 6;
    c.rotary = 1;
    (void)state;
    for (int fine = 0; fine < 2; fine++) {
        struct flex_beam o = bar(2, 1, fine ? 40 : 20, 7, &c, 1, ROOT_ONLY);
        const double *f = made(&o, at, life)->hertz; /* bending 1 2, stretch 1, bending 3 4 5, stretch 2 */
        for (int i = 0; i < 4; i++) error[fine][i] = fabs(f[i < 2 ? i : i + 1] / exact[i] - 1);
        for (int i = 0; i < 4; i++) assert_true(error[fine][i] < (fine ? 1e-3 : 4e-3));
        near(f[2], axial[0], 1e-3);
        near(f[6], axial[1], 5e-3);
    }
    for (int i = 1; i < 4; i++) assert_true(error[0][i] / error[1][i] > 3.5); /* elements shorter than deep: two */
    struct flex_beam o = bar(3, 1, 40, 8, &c, 1, ROOT_ONLY);
    const double *f = made(&o, at, life)->hertz;
    double torsion = sqrt(o.G * c.J / (o.density * (c.Iy + c.Iz))) / 4;
    for (int i = 0; i < 4; i++) near(f[i], exact[i / 2], 1e-3);
    near(f[4], torsion, 1e-3);
    near(f[5], axial[0], 1e-3);
    near(f[6], exact[2], 1e-3);
    near(f[7], exact[2], 1e-3);
    arena_close(life);
}

/* Against three-dimensional elasticity: a block 1 x 0.1 x 0.06 m, nu = 0 (Legendre-Ritz, 20 x 10 x 10 terms). */
static void test_solid(void **state)
{
    static const double solid[] = {48.52138, 80.53365, 299.8978, 486.3229, 726.4275, 822.0145, 1254.488, 1291.446};
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.06, 0.1);
    struct flex_beam o = bar(3, 1, 40, 8, &c, 1, ROOT_ONLY);
    double at[3];
    (void)state;
    c.ky = c.kz = 5.0 / 6;
    c.rotary = 1;
    o.E = 7e10;
    o.G = 3.5e10;
    o.density = 2780;
    assert_true(error(made(&o, at, life)->hertz, solid, 8) < 0.01);
    arena_close(life);
}

/* ---- other ends: the reduced body with rigid motion, its two ends held ---- */

/* Mass of (x, y, angle of the frame, q) at rest, and stiffness. */
static void plane_matrices(double *M, double *K, const struct flex_body *o)
{
    int n = o->n, all = n + 3;
    double Me[MOST * MOST];
    flex_mass(Me, o);
    memset(M, 0, (size_t)(all * all) * sizeof *M);
    memset(K, 0, (size_t)(all * all) * sizeof *K);
    M[0] = M[1 + all] = o->mass;
    M[2 + 2 * all] = o->xx[0] + o->xx[4] + o->rot[8];
    for (int j = 0; j < n; j++) {
        double c[3] = {o->f[3 * j], o->f[3 * j + 1], o->xf[3 + 9 * j] - o->xf[1 + 9 * j] + o->rpsi[3 * j + 2]};
        for (int a = 0; a < 3; a++) M[a + all * (3 + j)] = M[3 + j + all * a] = c[a];
        for (int i = 0; i < n; i++) {
            M[3 + i + all * (3 + j)] = Me[i + n * j];
            K[3 + i + all * (3 + j)] = o->K[i + n * j];
        }
    }
}

/* C [all]: the row of a node's displacement x, y or its angle. */
static void row_of(double *C, const struct flex_body *o, const struct flex_node *node, int what)
{
    const double rigid[3][3] = {{1, 0, -node->x[1]}, {0, 1, node->x[0]}, {0, 0, 1}};
    memcpy(C, rigid[what], sizeof rigid[what]);
    for (int j = 0; j < o->n; j++) C[3 + j] = what < 2 ? node->phi[3 * j + what] : node->psi[3 * j + 2];
}

/* Eigenvalues with rows C [all x rows] zero. */
static int constrained(double *lambda, double *M, double *K, const double *C, int all, int rows)
{
    static double P[MOST * MOST], N[MOST * MOST], X[MOST * MOST], Mr[MOST * MOST], Kr[MOST * MOST];
    double zero[MOST];
    int n = all - rows;
    memset(P, 0, sizeof P);
    for (int r = 0; r < rows; r++)
        for (int j = 0; j < all; j++)
            for (int i = 0; i < all; i++) P[i + all * j] += C[i + all * r] * C[j + all * r];
    eigen_symmetric(zero, N, P, all); /* the first n columns span the null space */
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            Mr[i + n * j] = Kr[i + n * j] = 0;
            for (int b = 0; b < all; b++)
                for (int a = 0; a < all; a++) {
                    double x = N[a + all * i] * N[b + all * j];
                    Mr[i + n * j] += x * M[a + all * b];
                    Kr[i + n * j] += x * K[a + all * b];
                }
        }
    assert_int_equal(eigen_general(lambda, X, Kr, Mr, n), -1);
    return n;
}

static void check_ends(const char *left, const char *right, const double *roots)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.005, 0.005);
    struct flex_beam o = bar(2, 1, 24, 24, &c, 2, BOTH);
    double at[3], M[MOST * MOST], K[MOST * MOST], C[6 * MOST], lambda[MOST];
    struct flex_body *body = made(&o, at, life);
    int all = body->n + 3, rows = 0, rigid = 0;
    plane_matrices(M, K, body);
    for (const char *p = left; *p; p++) row_of(C + all * rows++, body, &body->node[0], *p - 'x' < 2 ? *p - 'x' : 2);
    for (const char *p = right; *p; p++) row_of(C + all * rows++, body, &body->node[1], *p - 'x' < 2 ? *p - 'x' : 2);
    constrained(lambda, M, K, C, all, rows);
    while (lambda[rigid] < 1e-3) rigid++;
    assert_int_equal(rigid, *left ? 0 : 3);
    for (int i = 0; i < 6; i++) near(sqrt(lambda[rigid + i]) / (2 * acos(-1)), bending(roots[i], &o), 1e-3);
    arena_close(life);
}

static void test_ends(void **state)
{
    static const double pinned[] = {M_PI, 2 * M_PI, 3 * M_PI, 4 * M_PI, 5 * M_PI, 6 * M_PI};
    (void)state;
    check_ends("xyz", "", CLAMPED_FREE);
    check_ends("xyz", "xyz", CLAMPED_CLAMPED);
    check_ends("", "", CLAMPED_CLAMPED); /* free at both: the same roots */
    check_ends("xyz", "y", CLAMPED_PINNED);
    check_ends("xy", "y", pinned);
}

/* ---- statics, and the rigid body ---- */

static void test_tip_force(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.02, 0.01);
    struct flex_beam o = bar(3, 2, 10, 1, &c, 2, BOTH);
    const double F[3] = {1000, 10, 20};
    double at[3], u[3], turn[3], q[MOST], slope = 2 * 2 / 2.0;
    (void)state;
    for (int shear = 0; shear < 2; shear++) {
        c.ky = shear ? 5.0 / 6 : 0;
        c.kz = shear ? 0.8 : 0;
        struct flex_body *body = made(&o, at, life);
        deflect(u, turn, body, &body->node[1], F, q);
        near(u[0], F[0] * 2 / (o.E * c.A), 1e-9);
        near(u[1], F[1] * 8 / (3 * o.E * c.Iz) + shear * F[1] * 2 / (o.G * c.A * 5 / 6), 1e-9);
        near(u[2], F[2] * 8 / (3 * o.E * c.Iy) + shear * F[2] * 2 / (o.G * c.A * 0.8), 1e-9);
        near(turn[2], F[1] * slope / (o.E * c.Iz), 1e-9);
        near(turn[1], -F[2] * slope / (o.E * c.Iy), 1e-9);
    }
    arena_close(life);
}

/* A second place beside one, however close, changes nothing: not what a force at the tip bends, not the first frequency.
 * As a point, as a joint, as a lump without mass, as a second section in between. */
static void test_close(void **state)
{
    const double apart[] = {1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 2e-9};
    const double F[3] = {1000, 10, 20};
    double at[3], u[3], turn[3], q[MOST], first = 0;
    (void)state;
    for (int k = 0; k < 4 * 9; k++) {
        struct arena *life = arena_open();
        const double e = apart[k / 4], two[] = {0.4, 0.4 + e}, joints[] = {0, 1, 0.4, 0.4 + e};
        const struct flex_section c[] = {rectangle(0.4, 0.02, 0.01), rectangle(0.4 + e, 0.02, 0.01)};
        const struct flex_lump lump = {.station = 0.4 + e};
        struct flex_beam o = bar(3, 2, 10, 4, c, 2, joints);
        o.npoint = k % 4 == 1 ? 1 : 2, o.point = two;
        if (k % 4 == 0) o.ninterface = 4, o.npoint = 0;
        if (k % 4 == 1) o.nlump = 1, o.lump = &lump;
        if (k % 4 == 2) o.nsection = 2, o.npoint = 0;
        struct flex_body *body = made(&o, at, life);
        deflect(u, turn, body, &body->node[1], F, q);
        near(u[0], F[0] * 2 / (o.E * c->A), 1e-6);
        near(u[1], F[1] * 8 / (3 * o.E * c->Iz), 1e-6);
        near(u[2], F[2] * 8 / (3 * o.E * c->Iy), 1e-6);
        if (k == 3) first = body->hertz[0];
        if (k > 3 && k % 4) near(body->hertz[0], first, 1e-6);
        arena_close(life);
    }
}

/* A skew beam with lumps: mass, centre, inertia about it, and the elastic mass matrix 1. */
static void test_rigid(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.04, 0.02);
    struct flex_beam o = bar(3, 1, 7, 6, &c, 2, BOTH);
    struct flex_lump lump[2] = {{0.3, 2, {0.2, 0.2, 0.3, 0.01, 0.02, 0.03}}, {1, 5, {0}}};
    double at[3], d[3], Me[MOST * MOST], m, s, e[3], xx = 0;
    const double a[3] = {1, 2, 3}, b[3] = {2.5, 1, 4.2}, axis[3] = {0.3, -0.4, 0.5};
    (void)state;
    c.rotary = 1;
    memcpy(o.a, a, sizeof a);
    memcpy(o.b, b, sizeof b);
    turn_matrix(o.R, axis);
    o.nlump = 2;
    o.lump = lump;
    o.stiffening = true;
    struct flex_body *body = made(&o, at, life);
    v3_diff(d, b, a);
    double L = v3_norm(d), rod = o.density * c.A * L;
    m = rod + 7;
    s = (rod / 2 + 2 * 0.3 + 5) / m;
    near(body->mass, m, 1e-14);
    for (int k = 0; k < 3; k++) near(at[k], a[k] + s * d[k], 1e-13);
    xx = rod * (L * L / 12 + (0.5 - s) * (0.5 - s) * L * L) + 2 * (0.3 - s) * (0.3 - s) * L * L +
         5 * (1 - s) * (1 - s) * L * L;
    m3_tmul(e, o.R, d);
    v3_scale(e, 1 / L, e);
    double polar = o.density * (c.Iy + c.Iz) * L, spread = polar + 0.35, all, h[3]; /* half of the traces */
    s3_mul(d, lump[0].inertia, e);
    m3_mul(h, body->xx, e);
    all = body->xx[0] + body->xx[4] + body->xx[8];
    near(all, xx + spread, 1e-12); /* int x.x dm of all particles */
    near(v3_dot(e, h), xx + 0.35 - v3_dot(e, d), 1e-12);
    near(all - v3_dot(e, h), polar + v3_dot(e, d), 1e-12); /* inertia about the axis */
    for (int k = 0; k < 9; k++) assert_true(fabs(body->rot[k]) < 1e-15);
    flex_mass(Me, body);
    for (int k = 0; k < body->n * body->n; k++) assert_true(fabs(Me[k] - (k % (body->n + 1) == 0)) < 1e-11);
    for (int k = 0; k < 3; k++) /* both ends stand where they were drawn */
        for (int end = 0; end < 2; end++) {
            double x[3];
            m3_mul(x, o.R, body->node[end].x);
            near(at[k] + x[k], end ? b[k] : a[k], 1e-12);
        }
    arena_close(life);
}

/* Angular momentum about z of unit rate of a coordinate. */
static double turning(const struct flex_body *o, int j)
{
    return o->xf[3 + 9 * j] - o->xf[1 + 9 * j] + o->rpsi[3 * j + 2];
}

/* Modes of the plane are among those of space, with the same data: all of both. */
static void test_plane_in_space(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.03, 0.01);
    struct flex_beam flat = bar(2, 1, 5, 12, &c, 2, BOTH), solid = bar(3, 1, 5, 24, &c, 2, BOTH);
    double at[3];
    (void)state;
    c.ky = c.kz = 5.0 / 6;
    c.rotary = 1;
    flat.b[1] = solid.b[1] = 0.5;
    flat.stiffening = solid.stiffening = true;
    struct flex_body *f = made(&flat, at, life), *s = made(&solid, at, life);
    int found = 0;
    near(f->xx[0] + f->xx[4] + f->rot[8], s->xx[0] + s->xx[4] + s->rot[8], 1e-13);
    for (int i = 0; i < f->n; i++)
        for (int j = 0; j < s->n; j++) {
            const double *S = s->s + 3 * (j + s->n * j), *F = f->s + 3 * (i + f->n * i);
            if (fabs(s->hertz[j] / f->hertz[i] - 1) > 1e-9 || fabs(s->node[1].phi[3 * j + 2]) > 1e-9) continue;
            found++;
            for (int a = 0; a < 3; a++) {
                assert_true(fabs(f->node[1].phi[3 * i + a] - s->node[1].phi[3 * j + a]) < 1e-8);
                assert_true(fabs(f->f[3 * i + a] - s->f[3 * j + a]) < 1e-8);
                assert_true(fabs(F[a] - S[a]) < 1e-8 * (1 + fabs(S[a])));
            }
            assert_true(fabs(turning(f, i) - turning(s, j)) < 1e-8);
        }
    assert_int_equal(found, f->n);
    arena_close(life);
}

/* ---- damping, refusals ---- */

static void test_damping(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.02, 0.01);
    struct flex_beam o = bar(2, 1, 6, 3, &c, 1, ROOT_ONLY);
    double at[3];
    (void)state;
    assert_null(made(&o, at, life)->D);
    o.zeta = 0.01;
    struct flex_body *body = made(&o, at, life);
    for (int i = 0; i < 3; i++) near(body->D[4 * i], 0.02 * 2 * acos(-1) * body->hertz[i], 1e-12);
    o.zeta = 0;
    o.alpha = 3;
    o.beta = 1e-5;
    body = made(&o, at, life);
    for (int i = 0; i < 3; i++) near(body->D[4 * i], 3 + 1e-5 * body->K[4 * i], 1e-12);
    assert_true(body->D[1] == 0);
    arena_close(life);
}

static void refused(const struct flex_beam *o, const char *why)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *body = NULL;
    double at[3];
    assert_int_equal(flex_beam_make(&body, at, o, life, &report), E_MODEL);
    assert_non_null(strstr(report.text, why));
    assert_null(body);
    arena_close(life);
}

static void test_refusals(void **state)
{
    struct flex_section c = rectangle(0, 0.02, 0.01);
    const struct flex_probe probe = {"edge", 0.5, 1, 0};
    struct flex_beam o = bar(3, 1, 2, 13, &c, 1, ROOT_ONLY);
    (void)state;
    refused(&o, "13 modes of a beam with 12 freedoms");
    o.modes = 2;
    c.J = 0;
    refused(&o, "stiffness");
    c = rectangle(0, 0.02, 0.01);
    o.density = 0;
    refused(&o, "mass");
    o.density = 1000;
    o.up[0] = 1;
    refused(&o, "'up'");
    o.b[0] = 0;
    refused(&o, "one point");
    o.b[0] = 1;
    o.up[0] = 0;
    o.nprobe = 1;
    o.probe = &probe;
    c.y = 0;
    refused(&o, "'edge'");
    o.space = 2;
    c.twist = 0.1;
    refused(&o, "twist");
}

/* ---- what modes keep ---- */

/* A uniform cantilever's modes of unit mass have 4/m at the tip squared, and under unit accelerations of the root across
 * and about it h^2 = m (2 sigma/b)^2 and m L^2 (2/b^2)^2, lambda = b^4 EI/(m L^3); all of them have L^3/(3 EI), and
 * m^2 L^3/(20 EI), 11 m^2 L^5/(420 EI) of energy, m and m L^2/3 of mass. */
static void test_kept(void **state)
{
    (void)state;
    for (int n = 1; n <= 3; n++) {
        struct arena *life = arena_open();
        struct flex_section c = rectangle(0, 0.01, 0.01);
        struct flex_beam o = bar(2, 1, 40, n, &c, 1, ROOT_ONLY);
        double at[3], tip = 0, side = 0, turn = 0, moved = 0, turned = 0;
        const double across[6] = {0, 1, 0, 0, 0, 0}, about[6] = {0, 0, 0, 0, 0, 1}, along[6] = {1, 0, 0, 0, 0, 0};
        const struct flex_body *b = made(&o, at, life);
        struct flex_kept kept;
        for (int i = 0; i < n; i++) {
            const double r = CLAMPED_FREE[i], h = 2 * (sinh(r) - sin(r)) / (cosh(r) + cos(r)) / r, l = pow(r, 4);
            tip += 4 / l, side += h * h / l, turn += 4 / l / l, moved += h * h, turned += 4 / l;
            assert_int_equal(b->statics->kind[i], FLEX_BENDING_Y);
        }
        assert_true(flex_kept_of_load(&kept, b, b->nnode - 1, across));
        near(kept.share, 3 * tip, 1e-5);
        near(kept.across, kept.share, 1e-12);
        assert_true(flex_kept_of_motion(&kept, b, across));
        near(kept.share, 20 * side, 1e-5);
        near(kept.mass, moved, 2e-2); /* the mesh has no root's share */
        assert_true(flex_kept_of_motion(&kept, b, about));
        near(kept.share, 420 * turn / 11, 1e-5);
        near(kept.mass, 3 * turned, 2e-2);
        assert_true(flex_kept_of_motion(&kept, b, along)); /* no stretch is kept: it is stiff */
        assert_true(kept.share < 1e-12 && kept.across == 1 && kept.weight == 0);
        assert_false(flex_kept_of_load(&kept, b, 0, across)); /* the root */
        arena_close(life);
    }
}

/* In any direction the share is that of forms of the matrices.  A mode without stiffness has no part of what a force
 * bends: those of the others are left. */
static void test_parts(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.02, 0.01);
    struct flex_beam o = bar(3, 2, 12, 8, &c, 1, ROOT_ONLY);
    const double across[6] = {0, 1, 0, 0, 0, 0}, skew[6] = {0.3, 1, -0.7, 0.2, 0.4, -0.6};
    double at[3];
    struct flex_kept kept;
    (void)state;
    struct flex_body *b = made(&o, at, life);
    const int tip = b->nnode - 1, n = b->n;
    for (int way = 0; way < 2; way++) {
        const double *d = way ? skew : across, *C = b->statics->node + 36 * tip;
        double form = 0, part = 0, bent = 0, most[2] = {0, 0};
        for (int j = 0; j < 36; j++) form += d[j % 6] * C[j] * d[j / 6];
        for (int j = 0; j < 36; j++) bent += (j % 6 ? d[j % 6] : 0) * C[j] * (j / 6 ? d[j / 6] : 0);
        for (int j = 0; j < 6; j++) most[j / 3] = fmax(most[j / 3], C[7 * j]);
        for (int k = 0; k < n; k++) {
            const double *phi = b->node[tip].phi + 3 * k, *psi = b->node[tip].psi + 3 * k;
            const double x = v3_dot(d, phi) + v3_dot(d + 3, psi);
            part += x * x / b->K[k + n * k];
        }
        assert_true(flex_kept_of_load(&kept, b, tip, d));
        near(kept.share, part / form, 1e-12);
        assert_true(kept.mass == -1);
        near(kept.weight, bent / (v3_dot(d, d) * most[0] + v3_dot(d + 3, d + 3) * most[1]), 1e-12);
    }
    assert_true(flex_kept_of_load(&kept, b, tip, across));
    double share = kept.share;
    for (int k = 0; k < n; k++) {
        const double lambda = b->K[k + n * k], x = b->node[tip].phi[1 + 3 * k];
        b->K[k + n * k] = 0;
        share -= x * x / lambda / b->statics->node[36 * tip + 7];
        assert_true(flex_kept_of_load(&kept, b, tip, across));
        if (!(fabs(kept.share - share) < 1e-12))
            fail_msg("%d modes without stiffness: %g, not %g", k + 1, kept.share, share);
    }
    arena_close(life);
}

/* Kinds in space: a flat bar bends in its soft plane first, is wrung, bends in the other. */
static void test_kinds(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.01, 0.4);
    struct flex_beam o = bar(3, 2, 12, 40, &c, 1, ROOT_ONLY);
    double at[3];
    (void)state;
    const struct flex_body *b = made(&o, at, life);
    int count[FLEX_MIXED + 1] = {0};
    for (int i = 0; i < b->n; i++) count[b->statics->kind[i]]++;
    assert_int_equal(b->statics->kind[0], FLEX_BENDING_Z);
    for (int i = 0; i < FLEX_MIXED; i++) assert_true(count[i] > 0);
    assert_int_equal(count[FLEX_MIXED], 0);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cantilever), cmocka_unit_test(test_textbook),       cmocka_unit_test(test_timoshenko),
        cmocka_unit_test(test_solid),      cmocka_unit_test(test_ends),           cmocka_unit_test(test_tip_force),
        cmocka_unit_test(test_rigid),      cmocka_unit_test(test_plane_in_space), cmocka_unit_test(test_damping),
        cmocka_unit_test(test_refusals),   cmocka_unit_test(test_kept),           cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_parts),      cmocka_unit_test(test_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
