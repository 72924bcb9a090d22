/* t-rot.c -- rotations against series, inverses and differences that share nothing with them */
#include "la/rot.h"

#include "la/vec3.h"
#include "unit/trees.h"
#include "unit/turn.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { TRIES = 200 };

/* ---- the textbook's way: [w]x, series, inverse by cofactors ---- */

static void hat(double *W, const double *w)
{
    double H[9] = {0, w[2], -w[1], -w[2], 0, w[0], w[1], -w[0], 0};
    memcpy(W, H, sizeof H);
}

static void product(double *C, const double *A, const double *B)
{
    double X[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            X[i + 3 * j] = 0;
            for (int k = 0; k < 3; k++) X[i + 3 * j] += A[i + 3 * k] * B[k + 3 * j];
        }
    memcpy(C, X, sizeof X);
}

static void inverse(double *B, const double *A)
{
    double C[9], det = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r = (i + 1) % 3, s = (i + 2) % 3, k = (j + 1) % 3, l = (j + 2) % 3;
            C[j + 3 * i] = A[r + 3 * k] * A[s + 3 * l] - A[r + 3 * l] * A[s + 3 * k];
        }
    for (int i = 0; i < 3; i++) det += A[3 * i] * C[i];
    for (int i = 0; i < 9; i++) B[i] = C[i] / det;
}

/* e^A = (e^(A/64))^64, 12 terms of the series. */
static void exponential(double *E, const double *A)
{
    double X[9], term[9];
    for (int i = 0; i < 9; i++) X[i] = A[i] / 64, E[i] = term[i] = i % 4 == 0;
    for (int k = 1; k <= 12; k++) {
        product(term, term, X);
        for (int i = 0; i < 9; i++) E[i] += term[i] /= k;
    }
    for (int k = 0; k < 6; k++) product(E, E, E);
}

/* Largest difference; infinite when one is not a number. */
static double distance(const double *a, const double *b, int n)
{
    double worst = 0;
    for (int i = 0; i < n; i++) worst = fmax(worst, isnan(a[i] - b[i]) ? INFINITY : fabs(a[i] - b[i]));
    return worst;
}

#define NEAR(a, b, n, tolerance) assert_true(distance(a, b, n) <= (tolerance))

static void random_vector(double *x, struct tree_dice *d, double size)
{
    tree_vector(x, d, 3);
    double norm = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int i = 0; i < 3; i++) x[i] *= size / norm;
}

/* ---- tests ---- */

static void test_algebra(void **state)
{
    (void)state;
    struct tree_dice d = {1};
    for (int i = 0; i < TRIES; i++) {
        double A[9], B[9], C[9], D[9], x[3], y[3], z[3], H[9];
        for (int k = 0; k < 9; k++) A[k] = tree_roll(&d, -1, 1), B[k] = tree_roll(&d, -1, 1);
        tree_vector(x, &d, 3), tree_vector(y, &d, 3);
        product(C, A, B);
        m3_mulm(D, A, B);
        NEAR(C, D, 9, 1e-15);
        double At[9], Bt[9];
        for (int k = 0; k < 9; k++) At[k] = A[3 * (k % 3) + k / 3], Bt[k] = B[3 * (k % 3) + k / 3];
        m3_tmulm(D, At, B);
        NEAR(C, D, 9, 1e-15);
        m3_mulmt(D, A, Bt);
        NEAR(C, D, 9, 1e-15);
        v3_cross(z, x, y);
        hat(H, x);
        double w[3];
        m3_mul(w, H, y);
        NEAR(z, w, 3, 1e-15);
        v3_cross_add(z, y, x);
        NEAR(z, ((double[]){0, 0, 0}), 3, 1e-15);
        double S[6] = {A[0], A[4], A[8], A[1], A[2], A[5]}, T[6],
               F[9] = {S[0], S[3], S[4], S[3], S[1], S[5], S[4], S[5], S[2]};
        s3_mul(z, S, x);
        m3_mul(w, F, x);
        NEAR(z, w, 3, 1e-15);
        s3_turn(T, B, S);
        product(C, B, F);
        product(C, C, Bt);
        NEAR(T, ((double[]){C[0], C[4], C[8], C[3], C[6], C[7]}), 6, 1e-14);
    }
}

static void test_quaternion_and_matrix(void **state)
{
    (void)state;
    struct tree_dice d = {2};
    for (int i = 0; i < TRIES; i++) {
        double a[4], b[4], c[4], A[9], B[9], C[9], AB[9];
        tree_quaternion(a, &d, 3), tree_quaternion(b, &d, 3);
        if (i < 9) { /* half turns about the axes and between them */
            double half[9][4] = {{0, 1, 0, 0},   {0, 0, 1, 0}, {0, 0, 0, 1},  {0, .6, .8, 0},    {0, 0, .6, -.8},
                                 {0, .8, 0, .6}, {1, 0, 0, 0}, {-1, 0, 0, 0}, {0, .48, -.6, .64}};
            memcpy(a, half[i], sizeof a);
        }
        quat_matrix(A, a), quat_matrix(B, b);
        quat_mul(c, a, b);
        quat_matrix(C, c);
        product(AB, A, B);
        NEAR(C, AB, 9, 4e-15);
        /* the sandwich (0, Ax) = a (0, x) a* */
        double x[4] = {0}, y[3], star[4] = {a[0], -a[1], -a[2], -a[3]};
        tree_vector(x + 1, &d, 3);
        m3_mul(y, A, x + 1);
        quat_mul(x, a, x);
        quat_mul(x, x, star);
        NEAR(x + 1, y, 3, 4e-15);
        quat_of_matrix(c, A);
        assert_true(c[0] >= 0);
        quat_matrix(B, c);
        NEAR(A, B, 9, 4e-15);
    }
}

/* cay(phi) = (I - [phi]x/2)^-1 (I + [phi]x/2), near nothing and near half a turn too. */
static void test_cayley(void **state)
{
    (void)state;
    struct tree_dice d = {4};
    for (int i = 0; i < TRIES; i++) {
        double phi[3], q[4], R[9], H[9], P[9], M[9], back[3], q0[4], q1[4];
        double size = pow(10, tree_roll(&d, -9, 3));
        random_vector(phi, &d, size);
        quat_cay(q, phi);
        quat_matrix(R, q);
        hat(H, phi);
        for (int k = 0; k < 9; k++) P[k] = (k % 4 == 0) + H[k] / 2, M[k] = (k % 4 == 0) - H[k] / 2;
        inverse(M, M);
        product(M, M, P);
        NEAR(R, M, 9, size < 30 ? 1e-14 : 1e-11);
        tree_quaternion(q0, &d, 3);
        quat_move(q1, q0, phi, 1);
        if (i % 2)
            for (int k = 0; k < 4; k++) q1[k] = -q1[k];
        quat_diff(back, q1, q0);
        NEAR(back, phi, 3, 1e-15 + 1e-14 * size * (1 + size));
    }
}

/* The fraction s of cay(phi): the same axis, s times the angle 2 atan(|phi|/2), by the series of e^[.]x. */
static void test_fractions(void **state)
{
    (void)state;
    struct tree_dice d = {5};
    const double zero[3] = {0, 0, 0};
    for (int i = 0; i < TRIES; i++) {
        double phi[3], q0[4], q[4], R0[9], R[9], H[9], E[9];
        double size = pow(10, tree_roll(&d, -9, 2));
        double s = i % 3 == 0 ? .5 : i % 3 == 1 ? 1 : tree_roll(&d, -1, 1);
        random_vector(phi, &d, size);
        tree_quaternion(q0, &d, 3);
        quat_move(q, q0, phi, s);
        quat_matrix(R, q), quat_matrix(R0, q0);
        double angle = s * 2 * atan(size / 2);
        hat(H, phi);
        for (int k = 0; k < 9; k++) H[k] *= angle / size;
        exponential(E, H);
        product(E, R0, E);
        NEAR(R, E, 9, 1e-13);
        assert_true(fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) < 1e-15);

        double whole[4], part[4]; /* fractions compose, in place */
        quat_move(whole, q0, phi, 1);
        memcpy(part, q0, sizeof part);
        for (int k = 0; k < 5; k++) quat_move(part, part, phi, .2);
        NEAR(part, whole, 4, 2e-15);
        quat_move(part, q0, phi, .5);
        quat_move(part, part, phi, .5);
        NEAR(part, whole, 4, 2e-15);
        quat_move(part, q0, zero, s);
        NEAR(part, q0, 4, 1e-15);
    }
}

/* phi of R = R0 cay(phi) while R' = R [w]x: differences along R e^(h [w]x). */
static void test_rate_of_cayley(void **state)
{
    (void)state;
    struct tree_dice d = {6};
    const double h = 1e-5, none[4] = {1, 0, 0, 0};
    for (int i = 0; i < TRIES; i++) {
        double phi[3], w[3], rate[3], q[4], turned[2][4], x[2][3], hw[3];
        random_vector(phi, &d, tree_roll(&d, 0, 3));
        tree_vector(w, &d, 3);
        cay_rate(rate, phi, w);
        quat_cay(q, phi);
        for (int side = 0; side < 2; side++) {
            double step[4];
            v3_scale(hw, side ? h : -h, w);
            turn_quaternion(step, hw);
            quat_mul(turned[side], q, step);
            quat_diff(x[side], turned[side], none);
        }
        for (int k = 0; k < 3; k++) x[1][k] = (x[1][k] - x[0][k]) / (2 * h);
        NEAR(x[1], rate, 3, 3e-8);
    }
}

static void test_rotation_vector(void **state)
{
    (void)state;
    struct tree_dice d = {7};
    for (int i = 0; i < TRIES; i++) {
        double phi[3], R[9], H[9], E[9], back[3];
        double angle = i % 3 == 0 ? pow(10, tree_roll(&d, -12, 0)) : i % 3 == 1 ? tree_roll(&d, 0, 3.14) : 3.14159265;
        random_vector(phi, &d, angle);
        turn_matrix(R, phi);
        hat(H, phi);
        exponential(E, H);
        NEAR(R, E, 9, 1e-13);
        vector_of_matrix(back, R);
        NEAR(back, phi, 3, angle < .1 ? 1e-15 : 1e-14);
    }
    double nothing[3] = {1, 1, 1}, unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    vector_of_matrix(nothing, unit);
    NEAR(nothing, ((double[]){0, 0, 0}), 3, 0);
}

/* phi' = T w: differences along R e^(h [w]x), from tiny angles over the change of formula to nearly pi. */
static void test_rate_of_rotation_vector(void **state)
{
    (void)state;
    struct tree_dice d = {8};
    const double h = 1e-4;
    for (int i = 0; i < TRIES; i++) {
        double phi[3], w[3], rate[3], T[9], q[4], x[2][3], hw[3], R[9], world[3], same[3];
        random_vector(phi, &d, i % 3 ? tree_roll(&d, .01, .09) : tree_roll(&d, 0, 3));
        tree_vector(w, &d, 3);
        vector_rate(T, phi);
        m3_mul(rate, T, w);
        turn_quaternion(q, phi);
        for (int side = 0; side < 2; side++) {
            double step[4], turned[4];
            v3_scale(hw, side ? h : -h, w);
            turn_quaternion(step, hw);
            quat_mul(turned, q, step);
            vector_of_quat(x[side], turned);
        }
        for (int k = 0; k < 3; k++) x[1][k] = (x[1][k] - x[0][k]) / (2 * h);
        NEAR(x[1], rate, 3, 1e-7);
        turn_matrix(R, phi); /* T' takes the same angular velocity in base axes */
        m3_mul(world, R, w);
        m3_tmul(same, T, world);
        NEAR(same, rate, 3, 1e-14);
    }
    /* both sides of the change of formula agree to the last digits */
    double a[9], b[9], u[3] = {.05 * (1 - 1e-14), 0, 0}, v[3] = {.05 * (1 + 1e-14), 0, 0};
    vector_rate(a, u), vector_rate(b, v);
    NEAR(a, b, 9, 2e-15);
}

static double determinant(const double *R)
{
    double c[3];
    v3_cross(c, R, R + 3);
    return v3_dot(c, R + 6);
}

static void assert_rotation(const double *R)
{
    double X[9];
    m3_tmulm(X, R, R);
    NEAR(X, ((double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}), 9, 1e-15);
    assert_true(fabs(determinant(R) - 1) < 1e-15);
}

static void test_orientation_from_axes(void **state)
{
    (void)state;
    struct tree_dice d = {9};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 20; k++) {
                double R[9], u[3], v[3], c[3];
                tree_vector(u, &d, 3), tree_vector(v, &d, 3);
                if (k > 15) v3_scale(v, 1e-6, v), v3_axpy(v, 1, u); /* nearly parallel */
                if (i == j) continue;
                assert_int_equal(matrix_of_axes(R, i, u, j, v), 1);
                assert_rotation(R);
                v3_cross(c, R + 3 * i, u);
                assert_true(v3_norm(c) < 1e-15 && v3_dot(R + 3 * i, u) > 0);
                v3_cross(c, u, v); /* the third axis is normal to both */
                assert_true(v3_dot(R + 3 * j, v) > 0 && fabs(v3_dot(c, R + 3 * j)) < 1e-15);
                assert_int_equal(matrix_of_axes(R, i, u, j, u), 0);
                assert_int_equal(matrix_of_axes(R, i, (double[]){0, 0, 0}, j, u), 0);
            }
}

/* R = turn about z, then about the new axis `second` (0: x, 1: y), then about the newest `third`. */
static void make_up(double *R, const double *angles, int second, int third)
{
    double A[9], B[9], C[9], phi[3] = {0, 0, angles[0]}, psi[3] = {0}, chi[3] = {0};
    psi[second] = angles[1];
    chi[third] = angles[2];
    turn_matrix(A, phi), turn_matrix(B, psi), turn_matrix(C, chi);
    product(R, A, B);
    product(R, R, C);
}

/* Both kinds of three angles of R: finite, in their ranges, and together R. */
static void assert_angles(const double *R)
{
    static const double pi = 3.14159265358979;
    double a[3], again[9];
    tait_bryan_of_matrix(a, R);
    assert_true(fabs(a[0]) <= pi + 1e-14 && fabs(a[1]) <= pi / 2 + 1e-14 && fabs(a[2]) <= pi + 1e-14);
    make_up(again, a, 1, 0);
    NEAR(R, again, 9, 4e-15);
    euler_of_matrix(a, R);
    assert_true(fabs(a[0]) <= pi + 1e-14 && a[1] >= 0 && a[1] <= pi + 1e-14 && fabs(a[2]) <= pi + 1e-14);
    make_up(again, a, 0, 2);
    NEAR(R, again, 9, 4e-15);
}

/* Anywhere, and near where the first axis and the last fall together, down to round-off. */
static void test_three_angles(void **state)
{
    (void)state;
    struct tree_dice d = {10};
    for (int i = 0; i < TRIES; i++) {
        double q[4], R[9];
        tree_quaternion(q, &d, 3);
        quat_matrix(R, q);
        assert_angles(R);
        for (int lock = 0; lock < 4; lock++) {
            const double off = pow(10, -i % 19),
                         middle[] = {1.5707963267948966, -1.5707963267948966, 0, 3.141592653589793};
            make_up(R, (double[]){tree_roll(&d, -3, 3), middle[lock] + off, tree_roll(&d, -3, 3)}, lock < 2,
                    lock < 2 ? 0 : 2);
            assert_angles(R);
        }
    }
}

/* Where they do: the last is 0, the first takes all. */
static void test_three_angles_locked(void **state)
{
    (void)state;
    const double s = .6, c = .8, first = atan2(s, c);
    double a[3];
    tait_bryan_of_matrix(a, (double[]){0, 0, -1, -s, c, 0, c, s, 0}); /* pitch upwards */
    NEAR(a, ((double[]){first, 1.5707963267948966, 0}), 3, 1e-16);
    euler_of_matrix(a, (double[]){c, s, 0, -s, c, 0, 0, 0, 1});
    NEAR(a, ((double[]){first, 0, 0}), 3, 1e-16);
    euler_of_matrix(a, (double[]){c, s, 0, s, -c, 0, 0, 0, -1});
    NEAR(a, ((double[]){first, 3.141592653589793, 0}), 3, 1e-16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_three_angles),
        cmocka_unit_test(test_three_angles_locked),
        cmocka_unit_test(test_algebra),
        cmocka_unit_test(test_quaternion_and_matrix),
        cmocka_unit_test(test_cayley),
        cmocka_unit_test(test_fractions),
        cmocka_unit_test(test_rate_of_cayley),
        cmocka_unit_test(test_rotation_vector),
        cmocka_unit_test(test_rate_of_rotation_vector),
        cmocka_unit_test(test_orientation_from_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
