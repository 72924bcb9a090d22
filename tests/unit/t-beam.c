/* t-beam.c -- beams made into reduced bodies: frequencies, statics, sections, frames, rotation, stresses.
 *
 * Exact frequencies: roots of the transcendental equations (Blevins, Formulas for Natural Frequency and Mode Shape,
 * 1979), Timoshenko's by transfer matrix; the rotating beam: Wright, Smith, Thresher & Wang, J. Appl. Mech. 49 (1982)
 * 197, continued by power series in 60 digits. */
#include "flex/beam.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "unit/rods.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { MOST = 60 };

static const double ROOT_ONLY[] = {0}, BOTH[] = {0, 1};
static const double CLAMPED_FREE[] = {1.8751040687119611, 4.694091132974175, 7.854757438237613,
                                      10.995540734875467, 14.13716839104647, 17.278759532088237};
static const double CLAMPED_CLAMPED[] = {4.730040744862704,  7.853204624095838, 10.995607838001671,
                                         14.137165491257464, 17.27875965739948, 20.42035224562606};
static const double CLAMPED_PINNED[] = {3.926602312047919,  7.068582745628732, 10.210176122813031,
                                        13.351768777754094, 16.49336143134641, 19.634954084936208};

static void near(double a, double b, double relative)
{
    if (!(fabs(a - b) <= relative * fabs(b))) fail_msg("%.15g is not %.15g to %g", a, b, relative);
}

static double error(const double *hertz, const double *exact, int n)
{
    double worst = 0;
    for (int i = 0; i < n; i++) worst = fmax(worst, fabs(hertz[i] / exact[i] - 1));
    return worst;
}

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

/* q = K^-1 phi' F at the node; its displacement and turn. */
static void deflect(double *u, double *turn, const struct flex_body *o, const struct flex_node *node, const double *F,
                    double *q)
{
    v3_set(u, 0, 0, 0);
    v3_set(turn, 0, 0, 0);
    for (int j = 0; j < o->n; j++) {
        q[j] = v3_dot(node->phi + 3 * j, F) / o->K[j * (o->n + 1)];
        v3_axpy(u, q[j], node->phi + 3 * j);
        v3_axpy(turn, q[j], node->psi + 3 * j);
    }
}

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

/* A skew beam with lumps: mass, centre, inertia about it, and the elastic mass matrix 1. */
static void test_rigid(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.04, 0.02);
    struct flex_beam o = bar(3, 1, 7, 6, &c, 2, BOTH);
    struct flex_lump lump[2] = {{0.3, 2, {0.1, 0.2, 0.3, 0.01, 0.02, 0.03}}, {1, 5, {0}}};
    double at[3], d[3], Me[MOST * MOST], m, s, e[3], xx = 0;
    const double a[3] = {1, 2, 3}, b[3] = {2.5, 1, 4.2}, axis[3] = {0.3, -0.4, 0.5};
    (void)state;
    c.rotary = 1;
    memcpy(o.a, a, sizeof a);
    memcpy(o.b, b, sizeof b);
    matrix_of_vector(o.R, axis);
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
    for (int k = 0; k < 9; k++) assert_true(fabs(body->xx[k] - xx * e[k % 3] * e[k / 3]) < 1e-12 * xx);
    double polar = o.density * (c.Iy + c.Iz) * L, trace = 2 * polar + 0.6, along;
    double h[3];
    near(body->rot[0] + body->rot[4] + body->rot[8], trace, 1e-12);
    m3_mul(h, body->rot, e);
    s3_mul(d, lump[0].inertia, e);
    along = polar + v3_dot(e, d);
    near(v3_dot(e, h), along, 1e-12);
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
    near(f->rot[8], s->rot[8], 1e-13);
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
            assert_true(fabs(f->rpsi[3 * i + 2] - s->rpsi[3 * j + 2]) < 1e-8);
        }
    assert_int_equal(found, f->n);
    arena_close(life);
}

/* ---- sections that vary ---- */

static const struct flex_section *tapered(struct flex_section *c, double twist)
{
    c[0] = rectangle(0, 0.04, 0.02);
    c[1] = rectangle(1, 0.02, 0.01);
    c[1].twist = twist;
    return c;
}

/* Tip deflection by quadrature of the moment's curvature, force along y: int (L - x)^2 (EI^-1)_yy dx, and _zy. */
static void test_taper_static(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[2], p;
    struct flex_beam o = bar(3, 1, 6, 0, tapered(c, 1.2), 2, BOTH);
    const double F[3] = {0, 100, 0};
    double at[3], u[3], turn[3], q[MOST], y = 0, z = 0;
    enum { CUTS = 2000 };
    (void)state;
    o.nsection = 2;
    struct flex_body *body = made(&o, at, life);
    deflect(u, turn, body, &body->node[1], F, q);
    for (int k = 0; k < CUTS; k++) {
        double x = (k + 0.5) / CUTS, w = (1 - x) * (1 - x) / CUTS * F[1] / o.E, s = sin(1.2 * x), d = cos(1.2 * x);
        p.Iy = c[0].Iy + x * (c[1].Iy - c[0].Iy);
        p.Iz = c[0].Iz + x * (c[1].Iz - c[0].Iz);
        y += w * (d * d / p.Iz + s * s / p.Iy);
        z += w * s * d * (1 / p.Iz - 1 / p.Iy);
    }
    near(u[1], y, 1e-6);
    near(u[2], z, 1e-6);
    arena_close(life);
}

/* Two uniform pieces; the node at the jump is the mesh's own. */
static void test_jump(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[4] = {rectangle(0, 0.02, 0.02), rectangle(0.37, 0.02, 0.02), rectangle(0.37, 0.02, 0.01),
                                rectangle(1, 0.02, 0.01)};
    struct flex_beam o = bar(2, 1, 2, 0, c, 2, BOTH);
    const double F[3] = {50, 10, 0};
    double at[3], u[3], turn[3], q[MOST], rest = 0.63;
    (void)state;
    o.nsection = 4;
    struct flex_body *body = made(&o, at, life);
    deflect(u, turn, body, &body->node[1], F, q);
    near(u[0], F[0] / o.E * (0.37 / c[0].A + rest / c[3].A), 1e-9);
    near(u[1], F[1] / (3 * o.E) * ((1 - pow(rest, 3)) / c[0].Iz + pow(rest, 3) / c[3].Iz), 1e-9);
    near(body->mass, o.density * (0.37 * c[0].A + rest * c[3].A), 1e-13);
    arena_close(life);
}

static void test_taper(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[2];
    double at[3], worst[2];
    (void)state;
    for (int shear = 0; shear < 2; shear++) {
        struct flex_beam o = bar(3, 1, 96, 4, tapered(c, 0.8), 1, ROOT_ONLY);
        o.nsection = 2;
        for (int k = 0; k < 2; k++) c[k].ky = c[k].kz = shear * 5.0 / 6, c[k].rotary = shear;
        const double *fine = made(&o, at, life)->hertz;
        for (int k = 0; k < 2; k++) {
            o.elements = 6 << k;
            worst[k] = error(made(&o, at, life)->hertz, fine, 4);
        }
        assert_true(worst[1] < 1e-3 && worst[0] / worst[1] > (shear ? 7 : 12));
    }
    arena_close(life);
}

/* A twist the same everywhere turns the modes and nothing else. */
static void test_turned(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.03, 0.01), t = c;
    struct flex_beam o = bar(3, 1, 8, 6, &c, 1, ROOT_ONLY);
    const double up[3] = {0.2, -sin(0.7), cos(0.7)};
    double at[3];
    struct flex_body *a = made(&o, at, life), *b, *d;
    (void)state;
    t.twist = 0.7;
    o.section = &t;
    b = made(&o, at, life);
    o.section = &c;
    memcpy(o.up, up, sizeof up);
    d = made(&o, at, life);
    for (int j = 0; j < 6; j++) {
        const double *x = a->node[2].phi + 3 * j, *y = b->node[2].phi + 3 * j, *z = d->node[2].phi + 3 * j;
        double turned[3] = {x[0], cos(0.7) * x[1] - sin(0.7) * x[2], sin(0.7) * x[1] + cos(0.7) * x[2]};
        double sign = v3_dot(turned, y) < 0 ? -1 : 1;
        near(b->hertz[j], a->hertz[j], 1e-9);
        for (int k = 0; k < 3; k++) assert_true(fabs(sign * y[k] - turned[k]) < 1e-7);
        for (int k = 0; k < 3; k++) assert_true(fabs(fabs(z[k]) - fabs(turned[k])) < 1e-7);
    }
    arena_close(life);
}

/* ---- the choice of the reference ---- */

/* A [m x n] := A T, A [m x n x n] in its first or second index. */
static void change(double *A, const double *T, int m, int n, int stride, int many)
{
    double row[MOST];
    for (int k = 0; k < many; k++)
        for (int a = 0; a < m; a++) {
            double *x = A + a + (stride == m ? (long)k * m * n : (long)k * m);
            for (int j = 0; j < n; j++) {
                row[j] = 0;
                for (int i = 0; i < n; i++) row[j] += x[(long)i * stride] * T[i + n * j];
            }
            for (int j = 0; j < n; j++) x[(long)j * stride] = row[j];
        }
}

static void change_pair(double *A, const double *T, int m, int n)
{
    change(A, T, m, n, m, n);
    change(A, T, m, n, m * n, n);
}

static void like(const double *a, const double *b, int n, double tolerance)
{
    double size = 0;
    for (int k = 0; k < n; k++) size = fmax(size, fabs(b[k]));
    for (int k = 0; k < n; k++)
        if (!(fabs(a[k] - b[k]) <= tolerance * size)) fail_msg("entry %d: %.15g, %.15g of %g", k, a[k], b[k], size);
}

/* The modes T of o as it is now held, signs as in those of `wanted` at its node. */
static void modes_of(double *T, const struct flex_body *o, const struct flex_body *wanted, int node)
{
    double K[MOST * MOST], M[MOST * MOST], lambda[MOST];
    int n = o->n;
    memcpy(K, o->K, (size_t)(n * n) * sizeof *K);
    flex_mass(M, o);
    assert_int_equal(eigen_general(lambda, T, K, M, n), -1);
    for (int j = 0; j < n; j++) {
        double product = 0;
        near(lambda[j], wanted->K[j * (n + 1)], 1e-7);
        for (int a = 0; a < 3; a++)
            for (int i = 0; i < n; i++)
                product += T[i + n * j] * (o->node[node].phi[a + 3 * i] * wanted->node[node].phi[a + 3 * j] +
                                           o->node[node].psi[a + 3 * i] * wanted->node[node].psi[a + 3 * j]);
        for (int i = 0; i < n; i++) T[i + n * j] *= product < 0 ? -1 : 1;
    }
}

/* Two interfaces, 0 and `other`, either one the reference.  Nodes: these, a point, both ends. */
static void check_reference(int space, double other)
{
    static const double middle[] = {0.4};
    const double there[] = {0, other}, back[] = {other, 0};
    struct arena *life = arena_open();
    struct flex_section c[2];
    struct flex_beam o = bar(space, 1, 10, 6, tapered(c, 0), 2, there);
    double at[3], T[MOST * MOST];
    o.nsection = 2;
    o.npoint = 1;
    o.point = middle;
    o.stiffening = true;
    for (int k = 0; k < 2; k++) c[k].ky = c[k].kz = 5.0 / 6, c[k].rotary = 1;
    struct flex_body *a = flex_refer(made(&o, at, life), 1, life), *b;
    o.interface = back;
    b = made(&o, at, life);
    int n = a->n;
    modes_of(T, a, b, 2);
    change(a->f, T, 3, n, 3, 1);
    change(a->xf, T, 9, n, 9, 1);
    change(a->rpsi, T, 3, n, 3, 1);
    change_pair(a->ff, T, 9, n);
    change_pair(a->ppsi, T, 1, n);
    change_pair(a->s, T, 3, n);
    change_pair(a->xs, T, 9, n);
    like(a->f, b->f, 3 * n, 1e-7);
    like(a->xf, b->xf, 9 * n, 1e-7);
    like(a->rpsi, b->rpsi, 3 * n, 1e-7);
    like(a->ff, b->ff, 9 * n * n, 1e-7);
    like(a->ppsi, b->ppsi, n * n, 1e-7);
    for (int k = 2; k < 4; k++) {
        change(a->node[k].phi, T, 3, n, 3, 1);
        change_pair(a->node[k].S, T, 3, n);
        like(a->node[k].phi, b->node[k].phi, 3 * n, 1e-7);
    }
    if (space == 2) {
        like(a->s, b->s, 3 * n * n, 1e-7);
        like(a->xs, b->xs, 9 * n * n, 1e-7);
        like(a->node[2].S, b->node[2].S, 3 * n * n, 1e-7);
    }
    /* In space the two frames differ by a turn of second order: across as the distance, nothing along. */
    for (int k = 0; k < n * n; k++) {
        double at2[3], at3[3], size = 1 + v3_norm(a->node[3].S + 3 * k);
        v3_diff(at2, a->node[2].S + 3 * k, b->node[2].S + 3 * k);
        v3_diff(at3, a->node[3].S + 3 * k, b->node[3].S + 3 * k);
        assert_true(fabs(at2[0]) < 1e-7 * size && fabs(at3[0]) < 1e-7 * size);
        v3_axpy(at2, (0.4 - other) / other, at3);
        assert_true(v3_norm(at2) < 1e-7 * size);
    }
    arena_close(life);
}

static void test_reference(void **state)
{
    (void)state;
    check_reference(2, 1);
    check_reference(3, 1);
    check_reference(2, 0.73); /* inside: the mesh takes it in */
    check_reference(3, 0.73);
}

/* ---- the rotating beam ---- */

static const double SPEED[] = {0, 1, 2, 4, 6};
static const double FLAP[][3] = {{3.5160152685001513, 22.03449156466677, 61.697214413549105},
                                 {3.6816468139579563, 22.181011150582833, 61.84176258715988},
                                 {4.137319573025358, 22.61492195650405, 62.27318410567162},
                                 {5.585001420884815, 24.273349394448704, 63.966760493114904},
                                 {7.360373019310019, 26.809081678497932, 66.68391438150489}};
static const double CHORD[][3] = {{3.5160152685001513, 22.03449156466677, 61.697214413549105},
                                  {3.5432362696730757, 22.158457880960036, 61.83367690738314},
                                  {3.621796964124125, 22.52631117379783, 62.24105926684468},
                                  {3.897722523639337, 23.941501432136274, 63.841573038134996},
                                  {4.263225420193833, 26.129042470867038, 66.4134356680926}};

/* K - W^2 G: G is half the second derivative of int |x + u - hub|^2 across the axis, W about z through the root. */
static void spin(double *lambda, const struct flex_body *o, double W)
{
    double K[MOST * MOST], M[MOST * MOST], X[MOST * MOST];
    int n = o->n;
    const double *hub = o->node[0].x;
    flex_mass(M, o);
    for (int k = 0; k < n * n; k++) {
        const double *ff = o->ff + 9 * k, *xs = o->xs + 9 * k, *s = o->s + 3 * k;
        double G = ff[0] + ff[4] + xs[0] + xs[4] - hub[0] * s[0] - hub[1] * s[1];
        K[k] = o->K[k] - W * W * G;
    }
    assert_int_equal(eigen_general(lambda, X, K, M, n), -1);
}

static void test_rotating(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.001, 0.001);
    struct flex_beam flat = bar(2, 1, 20, 8, &c, 1, ROOT_ONLY), solid = bar(3, 1, 20, 16, &c, 1, ROOT_ONLY);
    double at[3], unit = sqrt(flat.E * c.Iz / (flat.density * c.A)), lambda[MOST], worst = 0;
    (void)state;
    flat.stiffening = solid.stiffening = true;
    struct flex_body *f = made(&flat, at, life), *s = made(&solid, at, life);
    for (int k = 0; k < 5; k++) {
        spin(lambda, f, SPEED[k] * unit);
        for (int i = 0; i < 3; i++) worst = fmax(worst, fabs(sqrt(lambda[i]) / unit / CHORD[k][i] - 1));
        spin(lambda, s, SPEED[k] * unit); /* chord and flap in pairs, the chord lower */
        for (int i = 0; i < 3; i++) {
            worst = fmax(worst, fabs(sqrt(lambda[2 * i]) / unit / CHORD[k][i] - 1));
            worst = fmax(worst, fabs(sqrt(lambda[2 * i + 1]) / unit / FLAP[k][i] - 1));
        }
    }
    assert_true(worst < 1e-4);
    arena_close(life);
}

/* ---- buckling: K - P S of the loaded end is singular ---- */

static double critical(const struct flex_body *o, const struct flex_node *node, const double *direction)
{
    double K[MOST * MOST], S[MOST * MOST], X[MOST * MOST], lambda[MOST];
    int n = o->n;
    for (int k = 0; k < n * n; k++) {
        K[k] = o->K[k];
        S[k] = v3_dot(direction, node->S + 3 * k);
    }
    assert_int_equal(eigen_general(lambda, X, S, K, n), -1);
    return 1 / lambda[n - 1];
}

/* Euler's column, and a blade that tips over under a load across it: P L^2 = 4.0126 sqrt(EIy GJ) (Prandtl 1899;
 * Timoshenko & Gere, Theory of Elastic Stability, 1961, 6.3). */
static void test_buckling(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.001, 0.02);
    struct flex_beam o = bar(3, 1, 20, 30, &c, 2, BOTH);
    const double push[3] = {-1, 0, 0}, down[3] = {0, -1, 0};
    double at[3], pi = acos(-1);
    (void)state;
    o.stiffening = true;
    struct flex_body *body = made(&o, at, life);
    near(critical(body, &body->node[1], push), pi * pi * o.E * c.Iy / 4, 1e-4);
    near(critical(body, &body->node[1], down), 4.0126 * sqrt(o.E * c.Iy * o.G * c.J), 1e-3);
    arena_close(life);
}

/* ---- stresses ---- */

static void test_stress(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[2];
    const struct flex_probe probe[] = {{"top", 0, 1, 0}, {"corner", 0.5, -1, 1}, {"core", 0.3, 0, 0}};
    struct flex_beam o = bar(3, 1, 5, 3, tapered(c, 0), 2, BOTH);
    const double F[3] = {1000, 20, 30};
    double at[3], u[3], turn[3], q[MOST];
    (void)state;
    o.nsection = 2;
    o.nprobe = 3;
    o.probe = probe;
    struct flex_body *body = made(&o, at, life);
    deflect(u, turn, body, &body->node[1], F, q);
    for (int k = 0; k < 3; k++) {
        double x = probe[k].station, sum[8] = {0};
        for (int j = 0; j < body->n; j++) {
            sum[0] += q[j] * body->stress[k].axial[j];
            sum[1] += q[j] * body->stress[k].bending[j];
            for (int a = 0; a < 6; a++) sum[2 + a] += q[j] * body->stress[k].tensor[a + 6 * j];
        }
#define AT(x_) (c[0].x_ + x * (c[1].x_ - c[0].x_))
        double bend = -F[1] * (1 - x) * probe[k].y * AT(y) / AT(Iz) - F[2] * (1 - x) * probe[k].z * AT(z) / AT(Iy);
        near(sum[0], F[0] / AT(A), 1e-9);
        if (k < 2)
            near(sum[1], bend, 2e-3);
        else
            assert_true(sum[1] == 0);
        near(sum[2], sum[0] + sum[1], 1e-12);
        for (int a = 1; a < 6; a++) assert_true(sum[2 + a] == 0);
        assert_string_equal(body->stress[k].name, probe[k].name);
    }
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cantilever), cmocka_unit_test(test_textbook),       cmocka_unit_test(test_timoshenko),
        cmocka_unit_test(test_solid),      cmocka_unit_test(test_ends),           cmocka_unit_test(test_tip_force),
        cmocka_unit_test(test_rigid),      cmocka_unit_test(test_plane_in_space), cmocka_unit_test(test_taper_static),
        cmocka_unit_test(test_jump),       cmocka_unit_test(test_buckling),       cmocka_unit_test(test_taper),
        cmocka_unit_test(test_turned),     cmocka_unit_test(test_reference),      cmocka_unit_test(test_rotating),
        cmocka_unit_test(test_stress),     cmocka_unit_test(test_damping),        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
