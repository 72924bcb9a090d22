/* t-linear.c -- sub-cycling on random linear systems: energy and stability for any partition, any ratio
 *
 * For constant M > 0, K >= 0, C >= 0 the scheme's energy cannot grow, so the map over a major step has
 * no eigenvalue outside the unit circle.  Both are tested on systems drawn at random, with all terms and
 * with part of mass and stiffness in bodies that are evaluated once per major step.  A small dense
 * implementation of the same scheme, which solves all unknowns of the step at once, agrees with the
 * program, and shows that each of four variants that look equally good is unstable. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "la/dense.h"
#include "unit/oscillators.h"

#include <cmocka.h>

enum { MAP = 2 * LINEAR_MOST };

/* ---- drawing */

enum { CONSERVATIVE, DAMPED, GYROSCOPIC, SLOW_BODIES, KINDS };

/* A random positive matrix in the slow rows and columns of A. */
static void slow_block(double *A, int n, int ns, struct dice *dice, double lo, double hi)
{
    double part[LINEAR_MOST * LINEAR_MOST];
    int nl = n - ns;
    random_positive(part, nl, nl, dice, lo, hi);
    for (int j = 0; j < nl; j++)
        for (int i = 0; i < nl; i++) A[ns + i + (ns + j) * n] = part[i + j * nl];
}

/* K with `loose` zero eigenvalues, the others from lo to hi with both ends met. */
static void stiffness(double *K, int n, int loose, struct dice *dice, double lo, double hi)
{
    memset(K, 0, (size_t)(n * n) * sizeof *K);
    for (int i = loose; i < n; i++) K[i * (n + 1)] = lo * pow(hi / lo, dice_range(dice, 0, 1));
    if (loose < n) K[(n - 1) * (n + 1)] = hi;
    for (int k = 0; k < 3; k++) random_turn(K, n, n, dice);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) K[i + j * n] = K[j + i * n] = (K[i + j * n] + K[j + i * n]) / 2;
}

static void skew(double *G, int n, struct dice *dice, double size)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) {
            double g = dice_range(dice, -size, size);
            G[i + j * n] += g;
            G[j + i * n] -= g;
        }
}

/* Largest frequency 1e3 or less (K up to 1e6, M from about 1). */
static void draw(struct linear *s, struct dice *dice, int n, int ns, int kind, int loose, double span)
{
    linear_open(s, n, ns);
    random_positive(s->M[0], n, n, dice, .3, 3);
    stiffness(s->K[0], n, loose, dice, 1e6 / span, 1e6);
    if (kind == DAMPED) stiffness(s->C[0], n, dice_int(dice, 0, n), dice, .1, 100);
    if (kind == GYROSCOPIC) skew(s->C[0], n, dice, pow(10, dice_range(dice, 0, 2)));
    if (kind == SLOW_BODIES) {
        slow_block(s->M[1], n, ns, dice, .3, 3);
        slow_block(s->K[1], n, ns, dice, 1e6 / span, 1e6);
    }
}

/* ---- spectral radius: log |A^N| / N by squaring, N = 2^36, so that powers of N (defective
 * eigenvalues) and the condition of the eigenvectors weigh less than log(1e6)/7e10 = 2e-10 */

static double norm(const double *A, int m)
{
    double sum = 0;
    for (int i = 0; i < m * m; i++) sum += A[i] * A[i];
    return sqrt(sum);
}

static double radius(const double *A, int m)
{
    static double X[MAP * MAP], Y[MAP * MAP];
    double logarithm = 0, share = 1;
    memcpy(X, A, (size_t)(m * m) * sizeof *A);
    for (int k = 0; k < 36; k++) {
        double size = norm(X, m);
        if (size == 0) return 0;
        if (!isfinite(size)) return INFINITY;
        for (int i = 0; i < m * m; i++) X[i] /= size;
        logarithm += share * log(size);
        share /= 2;
        memset(Y, 0, (size_t)(m * m) * sizeof *Y);
        dense_gemm(Y, 1, X, X, m, m, m, m, m, m);
        memcpy(X, Y, (size_t)(m * m) * sizeof *Y);
    }
    return exp(logarithm + share * log(norm(X, m)));
}

static void test_radius(void **state)
{
    (void)state;
    double turn[4] = {cos(1), sin(1), -sin(1), cos(1)}, jordan[4] = {1, 0, 1, 1};
    double half[9] = {.5, 0, 0, 3, .25, 0, 1, 2, -.75};
    assert_true(fabs(radius(turn, 2) - 1) < 1e-10);
    assert_true(fabs(radius(jordan, 2) - 1) < 1e-9);
    assert_true(fabs(radius(half, 3) - .75) < 1e-10);
}

/* ---- the map of one major step, positions in units of velocity over the top frequency */

static const double TOP = 1e3;

static int map_of(double *A, struct linear *s, const struct step_options *o, double h, int ratio)
{
    int n = s->ode.n, m = 2 * n;
    struct run r;
    double q[LINEAR_MOST] = {0}, v[LINEAR_MOST] = {0};
    if (run_open(&r, "subcycle", &s->ode, o, q, v) != OK) return 0;
    int good = 1;
    for (int j = 0; j < m && good; j++) {
        memset(r.q, 0, sizeof r.q);
        memset(r.v, 0, sizeof r.v);
        if (j < n)
            r.q[j] = 1 / TOP;
        else
            r.v[j - n] = 1;
        r.x.t = 0;
        good = stepper_start(&r.stepper, &r.x, NULL) == OK && run_steps(&r, h, ratio, 1) == OK;
        for (int i = 0; i < n; i++) {
            A[i + j * m] = r.q[i] * TOP;
            A[n + i + j * m] = r.v[i];
        }
    }
    run_close(&r);
    return good;
}

/* Energy over `majors` steps from a random state: its change over the first. */
static double energy_change(struct linear *s, const struct step_options *o, struct dice *dice, double h, int ratio,
                            int majors, double *work)
{
    int n = s->ode.n;
    struct run r;
    double q[LINEAR_MOST], v[LINEAR_MOST];
    for (int i = 0; i < n; i++) q[i] = dice_range(dice, -1, 1) / TOP, v[i] = dice_range(dice, -1, 1);
    if (run_open(&r, "subcycle", &s->ode, o, q, v) != OK) return NAN;
    double E0 = linear_energy(s, q, v), E1 = NAN;
    if (run_steps(&r, h, ratio, majors) == OK) E1 = linear_energy(s, r.q, r.v);
    *work = r.work[POWER_DAMPER] / E0;
    run_close(&r);
    return E1 / E0 - 1;
}

/* 1000 systems of 2 to 12 coordinates, stiffness over 6 decades, h w from 0.01 to 30, n up to 50. */
static void test_stability(void **state)
{
    (void)state;
    struct dice dice = {1};
    struct step_options o = step_defaults;
    double worst_radius = 0, worst_loose = 0, worst_energy = 0, A[MAP * MAP];
    o.newton_tolerance = 1e-13;
    for (int k = 0; k < 1000; k++) {
        int kind = k % KINDS, n = 2 + (int)(dice_range(&dice, 0, 1) * dice_range(&dice, 0, 10.999));
        int ns = dice_int(&dice, 1, n - 1), loose = k % 5 == 0 ? dice_int(&dice, 1, n) : 0;
        int ratio = (int)pow(50.99, dice_range(&dice, 0, 1));
        double h = pow(10, dice_range(&dice, -2, 1.5)) / TOP, work;
        struct linear s;
        draw(&s, &dice, n, ns, kind, loose, 1e6);
        assert_true(map_of(A, &s, &o, h, ratio));
        double excess = radius(A, 2 * n) - 1, change = energy_change(&s, &o, &dice, h, ratio, 3, &work);
        if (loose)
            worst_loose = fmax(worst_loose, excess);
        else
            worst_radius = fmax(worst_radius, excess);
        if (kind == DAMPED) assert_true(work <= 0);
        worst_energy = fmax(worst_energy, fabs(change - work)); /* work is zero without dampers */
        if (!(excess <= (loose ? 1e-4 : 1e-9)) || !(fabs(change - work) <= 1e-9))
            print_error("k %d kind %d n %d ns %d ratio %d hw %g loose %d: radius - 1 = %g, energy %g\n", k, kind, n, ns,
                        ratio, h * TOP, loose, excess, change - work);
        assert_true(excess <= (loose ? 1e-4 : 1e-9) && fabs(change - work) <= 1e-9);
    }
    print_message("largest: radius - 1 = %.1e, with zero modes %.1e; energy %.1e\n", worst_radius, worst_loose,
                  worst_energy);
}

/* rho_infinity < 1: still no growth, and what is lost is booked. */
static void test_damped_scheme(void **state)
{
    (void)state;
    struct dice dice = {9};
    struct step_options o = step_defaults;
    double A[MAP * MAP];
    o.newton_tolerance = 1e-13;
    for (int k = 0; k < 100; k++) {
        int n = dice_int(&dice, 2, 6), ns = dice_int(&dice, 1, n - 1), ratio = dice_int(&dice, 1, 20);
        double h = pow(10, dice_range(&dice, -2, 1.5)) / TOP, work;
        struct linear s;
        o.rho_infinity = dice_range(&dice, 0, 1);
        draw(&s, &dice, n, ns, k % KINDS, 0, 1e6);
        assert_true(map_of(A, &s, &o, h, ratio));
        assert_true(radius(A, 2 * n) <= 1 + 1e-9);
        assert_true(energy_change(&s, &o, &dice, h, ratio, 3, &work) <= work + 1e-9);
    }
}

static double length(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * x[i];
    return sqrt(sum);
}

/* Stiffness over 12 decades, h w up to 60.  Round-off: each of the 2n products and sums in a row of K q
 * errs by eps |K| |q|, so a minor step pushes by up to 2 n eps |K| |q| h in any direction, also along soft
 * ones, where nothing but inertia answers.  This does the work 2 n eps |K| |q| h |v|.  The iteration stops
 * when its corrections are as small as such errors; what it leaves doubles them.  Over N minor steps
 *
 *     |E1 - E0| <= 4 n eps N h |K| |q| |v|,     |K| <= sum of the largest eigenvalues of its parts */
static void test_decades(void **state)
{
    (void)state;
    struct dice dice = {5};
    struct step_options o = step_defaults;
    double worst = 0, largest = 0;
    o.newton_tolerance = 1e-13;
    for (int k = 0; k < 300; k++) {
        int n = dice_int(&dice, 2, 8), ns = dice_int(&dice, 1, n - 1), ratio = dice_int(&dice, 1, 50), majors = 5;
        double h = pow(10, dice_range(&dice, -2, 1.5)) / TOP, q[LINEAR_MOST], v[LINEAR_MOST];
        struct linear s;
        struct run r;
        draw(&s, &dice, n, ns, k % 2 ? SLOW_BODIES : CONSERVATIVE, 0, 1e12);
        for (int i = 0; i < n; i++) q[i] = dice_range(&dice, -1, 1) / TOP, v[i] = dice_range(&dice, -1, 1);
        assert_int_equal(run_open(&r, "subcycle", &s.ode, &o, q, v), OK);
        double E0 = linear_energy(&s, q, v), qs = length(q, n), vs = length(v, n);
        for (int i = 0; i < majors; i++) {
            assert_int_equal(run_steps(&r, h, ratio, 1), OK);
            qs = fmax(qs, length(r.q, n));
            vs = fmax(vs, length(r.v, n));
        }
        double change = fabs(linear_energy(&s, r.q, r.v) - E0);
        double bound = 4 * n * DBL_EPSILON * majors * ratio * h * 2e6 * qs * vs + 1e-14 * E0;
        if (!(change <= bound)) print_error("k %d: %g over %g\n", k, change, bound);
        assert_true(change <= bound);
        worst = fmax(worst, change / bound);
        largest = fmax(largest, change / E0);
        run_close(&r);
    }
    print_message("largest change of energy: %.1e; share of the round-off bound: %.2g\n", largest, worst);
}

/* ---- the step once more, all unknowns at once, with ways to get it wrong */

enum variant { RIGHT, VELOCITY, MICRO_MEAN, UNDECOUPLED };

enum { REF_N = 6, REF_RATIO = 20, UNKNOWNS = REF_N + REF_N * REF_RATIO };

struct reference {
    const struct linear *s;
    enum variant variant;
    double h;
    int ratio;
    double W[REF_N * REF_N]; /* [nl x ns] */
};

/* y (S first) = P (u, x), u slow. */
static void through_P(const struct reference *p, double *y, const double *u, const double *x)
{
    int ns = p->s->ode.ns, nl = p->s->ode.n - ns;
    for (int i = 0; i < ns; i++) y[i] = x[i];
    for (int i = 0; i < nl; i++) {
        y[ns + i] = u[i];
        for (int j = 0; j < ns; j++) y[ns + i] -= p->W[i + j * nl] * x[j];
    }
}

static void reference_W(struct reference *p)
{
    const struct linear *s = p->s;
    int n = s->ode.n, ns = s->ode.ns, nl = n - ns, swap[REF_N];
    double M[REF_N * REF_N];
    memset(p->W, 0, sizeof p->W);
    if (p->variant == UNDECOUPLED) return;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < nl; i++) {
            double m = s->M[0][ns + i + j * n] + s->M[1][ns + i + j * n];
            if (j < ns)
                p->W[i + j * nl] = m;
            else
                M[i + (j - ns) * nl] = m;
        }
    assert_int_equal(dense_lu(M, swap, nl, nl), -1);
    for (int j = 0; j < ns; j++) dense_lu_solve(M, swap, p->W + j * nl, nl, nl);
}

/* Rows of the step for unknowns z = (du, d_0 ...) from q0, v0; the end state in q1, v1. */
static void reference_rows(const struct reference *p, double *F, double *q1, double *v1, const double *z,
                           const double *q0, const double *v0)
{
    const struct linear *s = p->s;
    int n = s->ode.n, ns = s->ode.ns, nl = n - ns, N = p->ratio;
    const double *du = z;
    double h = p->h, H = N * h, u0[REF_N], w[REF_N], x[REF_N] = {0}, vs[REF_N], mean_q[REF_N] = {0},
           mean_v[REF_N] = {0};
    double qk[REF_RATIO][REF_N], vk[REF_RATIO][REF_N], ak[REF_RATIO][REF_N], slow[REF_N] = {0};
    for (int i = 0; i < nl; i++) {
        u0[i] = v0[ns + i];
        for (int j = 0; j < ns; j++) u0[i] += p->W[i + j * nl] * v0[j];
        w[i] = u0[i] + du[i] / 2;
    }
    for (int i = 0; i < ns; i++) vs[i] = v0[i];
    for (int k = 0; k < N; k++) {
        const double *d = z + nl + k * ns;
        double f = (k + .5) / N, y[REF_N] = {0}, xm[REF_N], xr[REF_N], step[REF_N] = {0};
        for (int i = 0; i < ns; i++) {
            double dx = h * (vs[i] + d[i] / 2);
            xm[i] = x[i] + dx / 2;
            xr[i] = dx / h;
            x[i] += dx;
            vs[i] += d[i];
        }
        for (int i = 0; i < nl; i++) y[i] = f * H * w[i], step[i] = du[i] / N;
        through_P(p, qk[k], y, xm);
        for (int i = 0; i < nl; i++) y[i] = p->variant == VELOCITY ? u0[i] + f * du[i] : w[i];
        through_P(p, vk[k], y, xr);
        through_P(p, ak[k], step, d);
        for (int i = 0; i < n; i++) {
            qk[k][i] += q0[i];
            mean_q[i] += qk[k][i] / N;
            mean_v[i] += vk[k][i] / N;
        }
    }
    double y[REF_N] = {0}, way[REF_N];
    for (int i = 0; i < nl; i++) y[i] = H * w[i];
    through_P(p, way, y, x);
    for (int i = 0; i < n; i++) {
        q1[i] = q0[i] + way[i];
        if (p->variant == MICRO_MEAN) continue;
        mean_q[i] = (q0[i] + q1[i]) / 2;
        mean_v[i] = (q1[i] - q0[i]) / H;
    }
    for (int i = 0; i < nl; i++) y[i] = u0[i] + du[i];
    through_P(p, v1, y, vs);
    multiply_add(slow, s->K[1], mean_q, n);
    multiply_add(slow, s->C[1], mean_v, n);
    memset(F, 0, (size_t)nl * sizeof *F);
    for (int k = 0; k < N; k++) {
        double r[REF_N] = {0}, force[REF_N] = {0};
        multiply_add(r, s->M[0], ak[k], n);
        multiply_add(r, s->M[1], ak[k], n);
        multiply_add(force, s->K[0], qk[k], n);
        multiply_add(force, s->C[0], vk[k], n);
        for (int i = 0; i < n; i++) r[i] += h * (force[i] + slow[i]);
        for (int i = 0; i < nl; i++) F[i] += r[ns + i];
        for (int j = 0; j < ns; j++) {
            F[nl + k * ns + j] = r[j];
            for (int i = 0; i < nl; i++) F[nl + k * ns + j] -= p->W[i + j * nl] * r[ns + i];
        }
    }
}

/* The map of one major step by the reference. */
static void reference_map(double *A, const struct linear *s, enum variant variant, double h, int ratio)
{
    static double J[UNKNOWNS * UNKNOWNS];
    struct reference p = {.s = s, .variant = variant, .h = h, .ratio = ratio};
    int n = s->ode.n, ns = s->ode.ns, m = n - ns + ns * ratio, swap[UNKNOWNS];
    double z[UNKNOWNS] = {0}, F[UNKNOWNS], q0[REF_N] = {0}, v0[REF_N] = {0}, q1[REF_N], v1[REF_N];
    reference_W(&p);
    for (int j = 0; j < m; j++) {
        z[j] = 1;
        reference_rows(&p, J + j * m, q1, v1, z, q0, v0);
        z[j] = 0;
    }
    assert_int_equal(dense_lu(J, swap, m, m), -1);
    for (int j = 0; j < 2 * n; j++) {
        memset(z, 0, sizeof z);
        memset(q0, 0, sizeof q0);
        memset(v0, 0, sizeof v0);
        if (j < n)
            q0[j] = 1 / TOP;
        else
            v0[j - n] = 1;
        reference_rows(&p, F, q1, v1, z, q0, v0);
        for (int i = 0; i < m; i++) z[i] = -F[i];
        dense_lu_solve(J, swap, z, m, m);
        reference_rows(&p, F, q1, v1, z, q0, v0);
        for (int i = 0; i < n; i++) {
            A[i + j * 2 * n] = q1[i] * TOP;
            A[n + i + j * 2 * n] = v1[i];
        }
    }
}

static void draw_small(struct linear *s, struct dice *dice, int kind, double *h, int *ratio)
{
    int ns = dice_int(dice, 1, 3), nl = dice_int(dice, 1, 3);
    *ratio = dice_int(dice, 1, REF_RATIO);
    *h = pow(10, dice_range(dice, -1, 1.5)) / TOP;
    draw(s, dice, ns + nl, ns, kind, 0, 1e3);
    if (kind == GYROSCOPIC) skew(s->C[0], ns + nl, dice, 300);
    for (int i = 0; kind == SLOW_BODIES && i < (ns + nl) * (ns + nl); i++) s->K[0][i] /= 30;
    if (kind == DAMPED) /* the slow coordinates to the ground */
        for (int i = 0; i < nl; i++) s->C[0][(ns + i) * (ns + nl + 1)] += pow(10, dice_range(dice, 0, 4));
}

/* Program and reference: the same map. */
static void test_reference(void **state)
{
    (void)state;
    struct dice dice = {31};
    struct step_options o = step_defaults;
    double A[MAP * MAP], B[MAP * MAP], worst = 0;
    o.newton_tolerance = 1e-13;
    for (int k = 0; k < 200; k++) {
        struct linear s;
        double h;
        int ratio;
        draw_small(&s, &dice, k % KINDS, &h, &ratio);
        int m = 2 * s.ode.n;
        assert_true(map_of(A, &s, &o, h, ratio));
        reference_map(B, &s, RIGHT, h, ratio);
        for (int i = 0; i < m * m; i++) worst = fmax(worst, fabs(A[i] - B[i]));
        assert_true(worst < 1e-9);
    }
    print_message("largest difference of the maps: %.1e\n", worst);
}

/* Share of unstable systems and the largest radius, the right way and the wrong one. */
static void compare(enum variant wrong, int kind, double least_share)
{
    struct dice dice = {40 + kind};
    struct step_options o = step_defaults;
    double A[MAP * MAP], largest = 0;
    int unstable = 0, count = 250;
    o.newton_tolerance = 1e-13;
    for (int k = 0; k < count; k++) {
        struct linear s;
        double h;
        int ratio;
        draw_small(&s, &dice, kind, &h, &ratio);
        reference_map(A, &s, RIGHT, h, ratio);
        assert_true(radius(A, 2 * s.ode.n) <= 1 + 1e-9);
        reference_map(A, &s, wrong, h, ratio);
        double rho = radius(A, 2 * s.ode.n);
        unstable += rho > 1 + 1e-6;
        largest = fmax(largest, rho);
        if (rho > 1 + 1e-6 && unstable <= 20) { /* the program is stable just there */
            assert_true(map_of(A, &s, &o, h, ratio));
            assert_true(radius(A, 2 * s.ode.n) <= 1 + 1e-9);
        }
    }
    static const char *names[] = {"", "velocities at the middle", "slow bodies at the minor midpoints", "undecoupled"};
    print_message("%s: %.0f %% unstable, radius up to %.2f\n", names[wrong], 100. * unstable / count, largest);
    assert_true(unstable >= least_share * count);
    assert_true(largest > 1.05);
}

static void test_wrong_dampers(void **state)
{
    (void)state;
    compare(VELOCITY, DAMPED, .01);
}

static void test_wrong_gyroscopic(void **state)
{
    (void)state;
    compare(VELOCITY, GYROSCOPIC, .1);
}

static void test_wrong_slow_bodies(void **state)
{
    (void)state;
    compare(MICRO_MEAN, SLOW_BODIES, .02);
}

static void test_wrong_undecoupled(void **state)
{
    (void)state;
    compare(UNDECOUPLED, CONSERVATIVE, .05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_radius),
        cmocka_unit_test(test_stability),
        cmocka_unit_test(test_damped_scheme),
        cmocka_unit_test(test_decades),
        cmocka_unit_test(test_reference),
        cmocka_unit_test(test_wrong_dampers),
        cmocka_unit_test(test_wrong_gyroscopic),
        cmocka_unit_test(test_wrong_slow_bodies),
        cmocka_unit_test(test_wrong_undecoupled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
