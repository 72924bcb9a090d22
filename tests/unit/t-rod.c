/* t-rod.c -- the mesh of a rod, its matrices and fields in exact numbers: textbook elements, rigid motions, Gauss' rule. */
#include "flex/rod.h"

#include <math.h>
#include <string.h>

#include "unit/rods.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near(double a, double b, double within)
{
    if (!(fabs(a - b) <= within)) fail_msg("%.15g is not %.15g by %g", a, b, within);
}

/* ---- mesh ---- */

static void is_mesh(const struct flex_beam *beam, double length, int n, const double *s)
{
    struct arena *life = arena_open();
    struct rod o;
    rod_build(&o, beam, length, life);
    assert_int_equal(o.nnode, n);
    for (int k = 0; k < n; k++) near(o.s[k], s[k], 1e-14);
    for (int k = 0; k < n; k++) assert_int_equal(rod_node(&o, s[k] / length), k);
    arena_close(life);
}

/* Each kind of station alone makes a node of its own, wherever it lies; both ends are nodes without being asked for. */
static void test_stops(void **state)
{
    const double inside[] = {0.3}, two[] = {0.8, 0.3}, twice[] = {0.3, 0.3 + 1e-12};
    const struct flex_lump lump = {.station = 0.3, .mass = 1};
    const struct flex_section c[] = {rectangle(0, .02, .01), rectangle(0.3, .02, .01), rectangle(1, .01, .01)};
    const struct flex_section beyond[] = {rectangle(-0.5, .02, .01), rectangle(1.5, .01, .01)};
    const double one[] = {0, 0.6, 2}, both[] = {0, 0.6, 1.6, 2}, none[] = {0, 2};
    (void)state;
    struct flex_beam o = bar(3, 2, 1, 0, c + 1, 1, inside);
    is_mesh(&o, 2, 3, one);
    o = bar(3, 2, 1, 0, c + 1, 2, two);
    is_mesh(&o, 2, 4, both);
    o = bar(3, 2, 1, 0, c, 2, twice);
    is_mesh(&o, 2, 3, one);
    o = bar(3, 2, 1, 0, c, 1, ROOT_ONLY);
    is_mesh(&o, 2, 2, none);
    o.npoint = 2, o.point = two;
    is_mesh(&o, 2, 4, both);
    o.npoint = 0, o.nlump = 1, o.lump = &lump;
    is_mesh(&o, 2, 3, one);
    o.nlump = 0, o.nsection = 3;
    is_mesh(&o, 2, 3, one);
    o.nsection = 2, o.section = beyond;
    is_mesh(&o, 2, 2, none);
}

/* Equal elements between the stops, none longer than length / elements. */
static void test_pieces(void **state)
{
    const struct flex_section c[] = {rectangle(0, .02, .01)};
    const double inside[] = {0.3}, quarter[] = {0.25}, edge[] = {0.001};
    (void)state;
    struct flex_beam o = bar(3, 2, 4, 0, c, 1, inside);
    is_mesh(&o, 2, 6, (const double[]){0, 0.3, 0.6, 0.6 + 1.4 / 3, 0.6 + 2.8 / 3, 2});
    o = bar(3, 2, 4, 0, c, 1, quarter);
    is_mesh(&o, 2, 5, (const double[]){0, 0.5, 1, 1.5, 2});
    o = bar(3, 1, 2, 0, c, 1, edge);
    is_mesh(&o, 1, 4, (const double[]){0, 0.001, 0.5005, 1});
}

/* The section at a station: of the interval it lies in, the later of two at one station, the first before all. */
static void test_section(void **state)
{
    const struct flex_section c[] = {rectangle(0.2, 1, 1), rectangle(0.4, 3, 1), rectangle(0.4, 10, 1),
                                     rectangle(0.8, 14, 1)};
    const double at[] = {0, 0.2, 0.3, 0.4, 0.5, 0.8, 1}, area[] = {1, 1, 2, 10, 11, 14, 14};
    struct flex_beam o = bar(3, 1, 1, 0, c, 1, ROOT_ONLY);
    (void)state;
    o.nsection = 4;
    for (int i = 0; i < 7; i++) {
        struct flex_section s;
        rod_section(&s, &o, at[i]);
        near(s.A, area[i], 1e-12);
    }
}

/* ---- one element ---- */

enum { ALL = 12 };

/* Hermite's cubics: A u + ... of a uniform element without shear (Przemieniecki 1968, 5.116 and 11.34), as a table. */
static void add(double *A, int i, int j, double x)
{
    A[i + ALL * j] = A[j + ALL * i] = x;
}

/* Freedoms a, b at the left and right end of a linear field. */
static void linear(double *K, double *M, int a, double k, double m)
{
    add(K, a, a, k), add(K, a + 6, a + 6, k), add(K, a, a + 6, -k);
    add(M, a, a, m / 3), add(M, a + 6, a + 6, m / 3), add(M, a, a + 6, m / 6);
}

/* Bending by k = E I and m = rho A; sign: +1 for v, rz; -1 for w, ry. */
static void cubic(double *K, double *M, int v, int r, double sign, double k, double m, double h)
{
    const int f[4] = {v, r, v + 6, r + 6};
    const double stiff[4][4] = {{12, 6, -12, 6}, {6, 4, -6, 2}, {-12, -6, 12, -6}, {6, 2, -6, 4}};
    const double heavy[4][4] = {{156, 22, 54, -13}, {22, 4, 13, -3}, {54, 13, 156, -22}, {-13, -3, -22, 4}};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            const double turns = (i % 2 ? sign * h : 1) * (j % 2 ? sign * h : 1);
            add(K, f[i], f[j], k / (h * h * h) * stiff[i][j] * turns);
            add(M, f[i], f[j], m * h / 420 * heavy[i][j] * turns);
        }
}

static void is_band(const struct band *A, const double *B)
{
    double most = 0;
    for (int i = 0; i < ALL * ALL; i++) most = fmax(most, fabs(B[i]));
    for (int j = 0; j < ALL; j++)
        for (int i = 0; i < ALL; i++) near(*band_at(A, i, j), B[i + ALL * j], 1e-12 * most);
}

static void test_element(void **state)
{
    struct arena *life = arena_open();
    const struct flex_section c[] = {rectangle(0, 0.02, 0.01)};
    const struct flex_lump lump = {.station = 1, .mass = 3};
    const double I[9] = {1, .2, .3, .2, 2, .4, .3, .4, 3}, h = 0.5;
    struct flex_beam beam = bar(3, h, 1, 0, c, 1, ROOT_ONLY);
    double K[ALL * ALL] = {0}, M[ALL * ALL] = {0};
    struct band k, m;
    struct rod o;
    (void)state;
    beam.nlump = 1, beam.lump = &lump;
    rod_build(&o, &beam, h, life);
    rod_matrices(&k, &m, &o, I, life);
    linear(K, M, 0, beam.E * c->A / h, beam.density * c->A * h);
    linear(K, M, 3, beam.G * c->J / h, beam.density * (c->Iy + c->Iz) * h);
    cubic(K, M, 1, 5, 1, beam.E * c->Iz, beam.density * c->A, h);
    cubic(K, M, 2, 4, -1, beam.E * c->Iy, beam.density * c->A, h);
    for (int a = 0; a < 3; a++) M[(6 + a) * (ALL + 1)] += 3;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) M[9 + a + ALL * (9 + b)] += I[a + 3 * b];
    is_band(&k, K);
    is_band(&m, M);
    arena_close(life);
}

/* ---- fields ---- */

/* Of a beam in three elements: r = u + theta x x, no strain, no force, at every point and node, tapered and twisted. */
static void test_rigid(void **state)
{
    enum { NODES = 4 };
    struct arena *life = arena_open();
    struct flex_section c[2];
    struct flex_beam beam = bar(3, 3, 3, 0, tapered(c, 0.7), 1, ROOT_ONLY);
    const double u[3] = {.1, -.2, .3}, theta[3] = {.4, .5, -.6};
    double Phi[6 * NODES], W[12], Q[6];
    struct rod o;
    (void)state;
    beam.nsection = 2;
    rod_build(&o, &beam, 3, life);
    assert_int_equal(o.nnode, NODES);
    for (int k = 0; k < NODES; k++) {
        const double r[6] = {u[0], u[1] + theta[2] * k, u[2] - theta[1] * k, theta[0], theta[1], theta[2]};
        memcpy(Phi + 6 * k, r, sizeof r);
    }
    for (int p = 0; p < 3 * ROD_GAUSS; p++) {
        rod_at_point(W, &o, p, Phi, 1);
        const double s = o.point[p].s;
        const double is[12] = {u[0], u[1] + theta[2] * s, u[2] - theta[1] * s, theta[0], theta[1], theta[2]};
        for (int i = 0; i < 12; i++) near(W[i], is[i], 1e-13);
    }
    for (int k = 0; k < NODES; k++) {
        rod_at_node(W, &o, k, Phi, 1);
        for (int i = 0; i < 6; i++) near(W[i], Phi[6 * k + i], 0);
        for (int i = 6; i < 12; i++) near(W[i], 0, 0);
    }
    rod_forces(Q, &o, 0.4, Phi, 1);
    for (int i = 0; i < 6; i++) near(Q[i], 0, 1e-5); /* of E A = 4e7 */
    arena_close(life);
}

/* Pull and torque of 1, 3, 9 in elements of 1 m: linear from middle to middle across the nearer node that nothing loads,
 * the same all along the first where both its ends are loaded.  Moments of shear forces F, H are linear anyway. */
static void test_forces(void **state)
{
    struct arena *life = arena_open();
    const struct flex_section c[] = {rectangle(0, 0.02, 0.01)};
    const double held[] = {0, 1.0 / 3}, pull[] = {1, 3, 9, 0}, F = 7, H = 5;
    struct flex_beam beam = bar(3, 3, 3, 0, c, 1, held);
    const double EA = beam.E * c->A, GJ = beam.G * c->J, Iz = beam.E * c->Iz, Iy = beam.E * c->Iy;
    const double at[] = {0.25, 0.5, 1.2, 1.9, 2.5, 2.75, 3};
    const double is[2][7] = {{0.5, 1, 2.4, 5.4, 9, 10.5, 12}, {1, 1, 1.2, 5.4, 9, 10.5, 12}};
    double Phi[24], Q[6], sum = 0;
    struct rod o;
    (void)state;
    for (int k = 0; k < 4; k++) {
        const double bend = 3 * k * k / 2.0 - k * k * k / 6.0, turn = 3 * k - k * k / 2.0;
        const double r[6] = {sum / EA, F / Iz * bend, H / Iy * bend, sum / GJ, -H / Iy * turn, F / Iz * turn};
        memcpy(Phi + 6 * k, r, sizeof r);
        sum += pull[k];
    }
    for (int fixed = 0; fixed < 2; fixed++) {
        beam.ninterface = 1 + fixed;
        rod_build(&o, &beam, 3, life);
        for (int i = 0; i < 7; i++) {
            const double arm = 3 - at[i], all[6] = {is[fixed][i], F, H, is[fixed][i], -H * arm, F * arm};
            rod_forces(Q, &o, at[i] / 3, Phi, 1);
            for (int k = 0; k < 6; k++) near(Q[k], all[k], 1e-6);
        }
    }
    arena_close(life);
}

/* Gauss' rule on 0 ... 1 takes x^9 exactly, its running integral x^4. */
static void test_gauss(void **state)
{
    (void)state;
    for (int power = 0; power < 2 * ROD_GAUSS; power++) {
        double sum = 0;
        for (int g = 0; g < ROD_GAUSS; g++) sum += rod_gauss.w[g] * pow(rod_gauss.x[g], power);
        near(sum, 1.0 / (power + 1), 1e-15);
        for (int g = 0; g < ROD_GAUSS && power < ROD_GAUSS; g++) {
            double part = 0;
            for (int k = 0; k < ROD_GAUSS; k++) part += rod_gauss.part[g][k] * pow(rod_gauss.x[k], power);
            near(part, pow(rod_gauss.x[g], power + 1) / (power + 1), 1e-15);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stops),   cmocka_unit_test(test_pieces), cmocka_unit_test(test_section),
        cmocka_unit_test(test_element), cmocka_unit_test(test_rigid),  cmocka_unit_test(test_forces),
        cmocka_unit_test(test_gauss),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
