/* bare_chain.c -- the planar chain by the barest loop one would write for it alone: the limit a general
 * program is measured against.
 *
 * N uniform rods of 1 m and 1 kg, pinned to the origin and to each other, fall from the horizontal.
 * In their absolute angles Lagrange's equations are (rods k = 1...N)
 *
 *     r_i = sum_j A_ij (cos(th_i - th_j) a_j + sin(th_i - th_j) w_j^2) + g b_i cos th_i = 0
 *     A_ij = b_max(i,j),  A_ii = N - i + 1/3,  b_i = N - i + 1/2
 *
 * for a rod hangs on the ends of all before it: its own centre counts 1/2, every rod further out counts
 * 1.  Newmark's method with beta = 1/4, gamma = 1/2 solves r = 0 for a at the end of the step; modified
 * Newton with the dense mass matrix A_ij cos(th_i - th_j) by Cholesky, kept until the convergence slows;
 * the terms of stiffness and gyration it leaves out are of relative size h.  No output, no energies.
 *
 * The iteration ends when the error left, theta/(1 - theta) times the last correction (as a velocity,
 * relative to the largest so far), is below 1e-3 of the local error h/12 |a1 - a0| of Zienkiewicz & Xie
 * (1991), and never later than 1e-8 of scale allows.
 *
 *     bare_chain N h STEPS [REPEATS]    prints the least CPU time of a step [us] and the counts
 *     bare_chain --check REFERENCE.csv  N = 2 against a reference solution: the order and the limit
 *     bare_chain --record N h UNTIL EVERY  the angles between the rods, extrapolated from h and h/2, as CSV */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 64 };
static const double G = 9.81;

struct chain {
    int n;
    double A[MOST], b[MOST]; /* A_ii and b_i */
    double L[MOST * MOST];   /* Cholesky factor by column, its diagonal inverted */
    double th[MOST], w[MOST], a[MOST], aold[MOST];
    double scale, theta;
    int stale;
    long residuals, factors;
};

static void chain_open(struct chain *c, int n)
{
    memset(c, 0, sizeof *c);
    c->n = n;
    for (int i = 0; i < n; i++) {
        c->b[i] = n - i - .5;
        c->A[i] = n - i - 1 + 1. / 3;
    }
    c->theta = c->stale = 1;
}

/* L L' = A_ij cos(th_i - th_j) */
static void chain_factor(struct chain *c, const double *co, const double *si)
{
    int n = c->n;

    for (int j = 0; j < n; j++) {
        double *Lj = c->L + j * n;
        Lj[j] = c->A[j];
        for (int i = j + 1; i < n; i++) Lj[i] = c->b[i] * (co[i] * co[j] + si[i] * si[j]);
    }
    for (int k = 0; k < n; k++) {
        double *restrict Lk = c->L + k * n;
        double d = 1 / sqrt(Lk[k]);
        Lk[k] = d;
        for (int i = k + 1; i < n; i++) Lk[i] *= d;
        for (int j = k + 1; j < n; j++) {
            double *restrict Lj = c->L + j * n, f = Lk[j];
            for (int i = j; i < n; i++) Lj[i] -= f * Lk[i];
        }
    }
    c->factors++;
    c->stale = 0;
}

static void chain_solve(const struct chain *c, double *x)
{
    int n = c->n;

    for (int k = 0; k < n; k++) {
        const double *Lk = c->L + k * n;
        double f = x[k] *= Lk[k];
        for (int i = k + 1; i < n; i++) x[i] -= f * Lk[i];
    }
    for (int k = n - 1; k >= 0; k--) {
        const double *Lk = c->L + k * n;
        double s0 = 0, s1 = 0;
        int i = k + 1;
        for (; i + 1 < n; i += 2) {
            s0 += Lk[i] * x[i];
            s1 += Lk[i + 1] * x[i + 1];
        }
        if (i < n) s0 += Lk[i] * x[i];
        x[k] = (x[k] - s0 - s1) * Lk[k];
    }
}

/* r of the head comment: with X_j = cos th_j a_j - sin th_j w_j^2, Y_j = sin th_j a_j + cos th_j w_j^2 the
 * double sum is one sum of the rods before and one of the rods behind. */
static void chain_resid(const struct chain *c, double *r, const double *co, const double *si, const double *w,
                        const double *a)
{
    int n = c->n;
    double X[MOST], Y[MOST], x = 0, y = 0;

    for (int j = 0; j < n; j++) {
        double ww = w[j] * w[j];
        X[j] = co[j] * a[j] - si[j] * ww;
        Y[j] = si[j] * a[j] + co[j] * ww;
        r[j] = c->A[j] * a[j] + c->b[j] * (co[j] * (x + G) + si[j] * y);
        x += X[j];
        y += Y[j];
    }
    x = y = 0;
    for (int j = n - 1; j >= 0; j--) {
        r[j] += co[j] * x + si[j] * y;
        x += c->b[j] * X[j];
        y += c->b[j] * Y[j];
    }
}

/* a1 from the two last steps; returns the tolerance of the step. */
static double chain_predict(struct chain *c, double *a, double h, int first)
{
    double change = 0;

    for (int i = 0; i < c->n; i++) {
        double da = first ? 0 : c->a[i] - c->aold[i];
        a[i] = c->a[i] + da;
        change = fmax(change, fabs(da));
    }
    if (first) return 1e-10;
    return fmin(1e-8, fmax(1e-13, 1e-3 * h / 12 * change / c->scale));
}

/* One Newmark step; 0 when the iteration does not converge. */
static int chain_step(struct chain *c, double h, int first)
{
    int n = c->n;
    double a[MOST], th[MOST], w[MOST], co[MOST], si[MOST], r[MOST], last = 0;
    double tol = chain_predict(c, a, h, first);

    c->theta = sqrt(c->theta) * sqrt(sqrt(c->theta)); /* one not measured anew grows towards 1 */
    for (int sweep = 0; sweep < 20; sweep++) {
        double most = 0;
        for (int i = 0; i < n; i++) {
            th[i] = c->th[i] + h * c->w[i] + h * h / 4 * (c->a[i] + a[i]);
            w[i] = c->w[i] + h / 2 * (c->a[i] + a[i]);
            sincos(th[i], &si[i], &co[i]);
        }
        if (c->stale) chain_factor(c, co, si);
        chain_resid(c, r, co, si, w, a);
        c->residuals++;
        chain_solve(c, r);
        for (int i = 0; i < n; i++) {
            a[i] -= r[i];
            most = fmax(most, fabs(r[i]));
        }
        double err = h * most / c->scale, theta = sweep ? err / last : c->theta;
        if (sweep && err > 0) c->theta = fmin(1, fmax(theta, 1e-10));
        if (sweep && theta > .3 && last > 1e-12) c->stale = 1;
        int roundoff = theta > .5 && err < 1e-12; /* no further decrease */
        if (err == 0 || roundoff || (theta < 1 && theta / (1 - theta) * err <= tol)) break;
        if (sweep == 19) return 0;
        last = err;
    }
    for (int i = 0; i < n; i++) {
        c->th[i] += h * c->w[i] + h * h / 4 * (c->a[i] + a[i]);
        c->w[i] += h / 2 * (c->a[i] + a[i]);
        c->aold[i] = c->a[i];
        c->a[i] = a[i];
        c->scale = fmax(c->scale, fmax(fabs(c->w[i]), h * fabs(a[i])));
    }
    return 1;
}

/* a at the start: r = 0 at rest. */
static void chain_start(struct chain *c, double h)
{
    double co[MOST] = {0}, si[MOST] = {0}, zero[MOST] = {0};

    for (int i = 0; i < c->n; i++) sincos(c->th[i], &si[i], &co[i]);
    chain_factor(c, co, si);
    chain_resid(c, c->a, co, si, c->w, zero);
    for (int i = 0; i < c->n; i++) c->a[i] = -c->a[i];
    chain_solve(c, c->a);
    for (int i = 0; i < c->n; i++) c->scale = fmax(c->scale, h * fabs(c->a[i]));
}

static int chain_run(struct chain *c, int n, double h, long steps)
{
    chain_open(c, n);
    chain_start(c, h);
    for (long s = 0; s < steps; s++)
        if (!chain_step(c, h, s == 0)) return 0;
    return 1;
}

/* ---- check ----------------------------------------------------------------------------------- */

struct sample {
    double t, x[4];
};

static int read_samples(struct sample *s, int most, const char *file)
{
    char line[512];
    int n = 0;
    FILE *f = fopen(file, "r");

    if (!f) return 0;
    while (n < most && fgets(line, sizeof line, f))
        if (sscanf(line, "%lf,%lf,%lf,%lf,%lf", &s[n].t, s[n].x, s[n].x + 1, s[n].x + 2, s[n].x + 3) == 5) n++;
    fclose(f);
    return n;
}

/* The largest difference from the samples up to t = until at step h, halved if both is set: then of the
 * extrapolation (4 x(h/2) - x(h)) / 3. */
static double check_error(const struct sample *s, int n, double until, double h, int extrapolate)
{
    static struct chain c, half;
    double error = 0;

    for (int i = 0; i < n && s[i].t <= until; i++) {
        long steps = lround(s[i].t / h);
        chain_run(&c, 2, h, steps);
        if (extrapolate) chain_run(&half, 2, h / 2, 2 * steps);
        for (int k = 0; k < 4; k++) {
            double x = k < 2 ? c.th[k] : c.w[k - 2], y = k < 2 ? half.th[k] : half.w[k - 2];
            error = fmax(error, fabs((extrapolate ? (4 * y - x) / 3 : x) - s[i].x[k]));
        }
    }
    return error;
}

static int check(const char *file)
{
    static struct sample s[64];
    int n = read_samples(s, 64, file);
    double coarse = check_error(s, n, 2, 1e-3, 0), fine = check_error(s, n, 2, 5e-4, 0);
    double limit = check_error(s, n, 2, 2.5e-4, 1), order = log2(coarse / fine);

    printf("bare chain, N = 2, until 2 s: error %.3g at h = 1e-3, order %.3f, limit within %.3g\n", coarse, order,
           limit);
    return n > 5 && order > 1.9 && order < 2.1 && limit < 1e-6 ? 0 : 1;
}

/* Angles between the rods at the times i EVERY, of fourth order: (4 x(h/2) - x(h)) / 3. */
static int record(int n, double h, double until, double every)
{
    static struct chain c, half;

    printf("t");
    for (int i = 1; i <= n; i++) printf(",pin%d.angle", i);
    for (int s = 0; s <= lround(until / every); s++) {
        long steps = lround(s * every / h);
        double before = 0;
        if (!chain_run(&c, n, h, steps) || !chain_run(&half, n, h / 2, 2 * steps)) return 1;
        printf("\n%.10g", s * every);
        for (int i = 0; i < n; i++) {
            double th = (4 * half.th[i] - c.th[i]) / 3;
            printf(",%.12g", th - before);
            before = th;
        }
    }
    puts("");
    return 0;
}

static double cpu(void)
{
    struct timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int argc, char **argv)
{
    static struct chain c;

    if (argc == 3 && strcmp(argv[1], "--check") == 0) return check(argv[2]);
    if (argc == 6 && strcmp(argv[1], "--record") == 0 && atoi(argv[2]) >= 1 && atoi(argv[2]) <= MOST)
        return record(atoi(argv[2]), atof(argv[3]), atof(argv[4]), atof(argv[5]));
    if (argc < 4 || atoi(argv[1]) < 1 || atoi(argv[1]) > MOST) {
        fputs("usage: bare_chain N h STEPS [REPEATS] | bare_chain --check REFERENCE.csv\n", stderr);
        return 2;
    }
    int n = atoi(argv[1]), repeats = argc > 4 ? atoi(argv[4]) : 1;
    double h = atof(argv[2]), least = INFINITY;
    long steps = atol(argv[3]);

    for (int r = 0; r < repeats; r++) {
        double t = cpu();
        if (!chain_run(&c, n, h, steps)) {
            fprintf(stderr, "bare_chain: no convergence\n");
            return 1;
        }
        least = fmin(least, cpu() - t);
    }
    printf("%.4f us a step, %.3f residuals, %.4f factors a step\n", 1e6 * least / (double)steps,
           (double)c.residuals / (double)steps, (double)c.factors / (double)steps);
    return 0;
}
