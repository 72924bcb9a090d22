/* t-stiffening.c -- second-order displacements of beams: the choice of the reference, rotation, buckling.
 *
 * The rotating beam: Wright, Smith, Thresher & Wang, J. Appl. Mech. 49 (1982) 197, continued by power series in 60
 * digits. */
#include "flex/beam.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"
#include "la/vec3.h"
#include "unit/rods.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near(double a, double b, double relative)
{
    if (!(fabs(a - b) <= relative * fabs(b))) fail_msg("%.15g is not %.15g to %g", a, b, relative);
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

static const double SPEED[] = {0, 1, 2, 4, 6, 6}, HUB[] = {0, 0, 0, 0, 0, 1}; /* radius of the hub, of the length */
static const double FLAP[][3] = {{3.5160152685001513, 22.03449156466677, 61.697214413549105},
                                 {3.6816468139579563, 22.181011150582833, 61.84176258715988},
                                 {4.137319573025358, 22.61492195650405, 62.27318410567162},
                                 {5.585001420884815, 24.273349394448704, 63.966760493114904},
                                 {7.360373019310019, 26.809081678497932, 66.68391438150489},
                                 {10.443865869459815, 32.02724398264489, 72.98633548539627}};
static const double CHORD[][3] = {{3.5160152685001513, 22.03449156466677, 61.697214413549105},
                                  {3.5432362696730757, 22.158457880960036, 61.83367690738314},
                                  {3.621796964124125, 22.52631117379783, 62.24105926684468},
                                  {3.897722523639337, 23.941501432136274, 63.841573038134996},
                                  {4.263225420193833, 26.129042470867038, 66.4134356680926},
                                  {8.548352724312892, 31.460202750838455, 72.73929589696903}};

/* K - W^2 G: G is half the second derivative of int |x + u - hub|^2 across the axis, W about z, the hub's radius before
 * the root. */
static void spin(double *lambda, const struct flex_body *o, double W, double radius)
{
    double K[MOST * MOST], M[MOST * MOST], X[MOST * MOST];
    int n = o->n;
    const double hub[2] = {o->node[0].x[0] - radius, o->node[0].x[1]};
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
    for (int k = 0; k < 6; k++) {
        spin(lambda, f, SPEED[k] * unit, HUB[k]);
        for (int i = 0; i < 3; i++) worst = fmax(worst, fabs(sqrt(lambda[i]) / unit / CHORD[k][i] - 1));
        spin(lambda, s, SPEED[k] * unit, HUB[k]); /* chord and flap in pairs, the chord lower */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference),
        cmocka_unit_test(test_rotating),
        cmocka_unit_test(test_buckling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
