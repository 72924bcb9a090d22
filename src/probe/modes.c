/* modes.c -- see modes.h */
#include "probe/modes.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "la/dense.h"
#include "la/eigen.h"
#include "probe/damped_mode.h"
#include "probe/linear.h"

/* Turns that move no mass have no frequency: what round-off would make of one is taken out. */
static void clear_idle(const struct linear *l, const struct sim *sim)
{
    double *const of[] = {l->K, l->C, l->G, l->N};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) sim_clear_idle(sim, of[i]);
}

/* Local frequencies: one coordinate moves, the others recoil, w_i^2 = |(M^-1 K)_ii|. */
static void local(struct modes *o, const struct linear *l, const double *X, const double *lambda)
{
    int n = l->n, ns = l->ode->ns;
    for (int i = 0; i < n; i++) { /* M^-1 K = X diag(lambda) X' M */
        double sum = 0;
        for (int j = 0; j < n; j++) {
            double mx = 0;
            for (int k = 0; k < n; k++) mx += X[k + j * n] * l->M[k + i * n];
            sum += X[i + j * n] * lambda[j] * mx;
        }
        double omega = sqrt(fabs(sum));
        if (i < ns && omega > o->fast_top) o->fast_top = omega, o->fast_worst = i;
        if (i >= ns && omega > o->slow_top) o->slow_top = omega, o->slow_worst = i;
    }
}

static double form(const double *A, const double *x, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) sum += x[i] * A[i + j * n] * x[j];
    return sum;
}

static double terms(const double *A, const double *x, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) sum += fabs(x[i] * A[i + j * n] * x[j]);
    return sum;
}

/* Who moves: shares |x_i (M x)_i| in the sum of all, of both parts of x [n x parts].  Where none is negative they are those
 * of the kinetic energy; coordinates that move against each other may take and give many times that. */
static void shares(struct mode *o, const struct linear *l, const double *x, int parts)
{
    int n = l->n;
    double all = 0;
    for (int k = 0; k < 3; k++) o->top[k] = -1;
    for (int i = 0; i < n; i++) {
        double part = 0;
        for (int p = 0; p < parts; p++)
            for (int j = 0; j < n; j++) part += x[i + p * n] * l->M[i + j * n] * x[j + p * n];
        part = fabs(part);
        all += part;
        if (i < l->ode->ns) o->fast += part;
        for (int k = 0; k < 3; k++) {
            if (o->top[k] >= 0 && part <= o->share[k]) continue;
            for (int m = 2; m > k; m--) o->top[m] = o->top[m - 1], o->share[m] = o->share[m - 1];
            o->top[k] = i;
            o->share[k] = part;
            break;
        }
    }
    o->fast /= all;
    for (int k = 0; k < 3 && o->top[k] >= 0; k++) o->share[k] /= all;
}

static void describe(struct mode *o, const struct linear *l, double lambda, const double *x)
{
    *o = (struct mode){.omega = lambda < 0 ? -sqrt(-lambda) : sqrt(lambda)};
    if (lambda > 0) o->damping = form(l->C, x, l->n) / (2 * o->omega);
    shares(o, l, x, 1);
}

/* ---- the same with gyroscopic terms ----
 *
 * In the modes X of (K, M), x = X p, with y = (p', L p), L^2 = diag(lambda) >= 0:
 *
 *     y' = -S y,   S = [g L; -L 0],   g = X'G X,
 *
 * S is antisymmetric, so that the frequencies are its singular values, each twice, and S'S a = omega^2 a,
 * b = S a / omega are the two parts of y (Meirovitch, AIAA J. 12 (1974) 1337). */

static void times(double *y, const double *A, const double *x, int rows, int columns, int stride)
{
    for (int i = 0; i < rows; i++) y[i] = 0;
    for (int j = 0; j < columns; j++)
        for (int i = 0; i < rows; i++) y[i] += A[i + j * stride] * x[j];
}

/* o = X'A X [n x n]; work [n]. */
static void in_modes(double *o, const double *A, const double *X, int n, double *work)
{
    for (int j = 0; j < n; j++) {
        times(work, A, X + j * n, n, n, n);
        for (int i = 0; i < n; i++) {
            o[i + j * n] = 0;
            for (int k = 0; k < n; k++) o[i + j * n] += X[k + i * n] * work[k];
        }
    }
}

/* Do gyroscopic terms count? */
static bool turned(const double *g, double top, int count, int n)
{
    static const double counts = 1e-9; /* of the highest frequency */
    double most = 0;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++) most = fmax(most, fabs(g[i + j * n]));
    return most > counts * top;
}

/* Is damping as much of them as they are?  As where a force reads the rate of a coordinate along which it does not act, such as
 * that of a controller's state: its terms have no counterpart, so that half of each seems gyroscopic. */
static bool one_sided(const double *g, const double *d, double top, int count, int n)
{
    static const double as_much = .1, counts = 1e-9;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < j; i++) {
            const double turns = fabs(g[i + j * n]);
            if (turns > counts * top && fabs(d[i + j * n]) > as_much * turns) return true;
        }
    return false;
}

/* Do circulatory ones?  They are known to the errors of differences. */
static bool circulated(const double *c, const double *lambda, int count, int n)
{
    static const double counts = 1e-3, noise = 1e-8;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < j; i++) {
            const double a = fabs(lambda[i]), b = fabs(lambda[j]);
            if (fabs(c[i + j * n]) > counts * sqrt(a * b) + noise * fmax(a, b)) return true;
        }
    return false;
}

/* S [2n x 2n]; g [n x n], its columns `stride` apart */
static void antisymmetric(double *S, const double *g, const double *lambda, int n, int stride)
{
    int m = 2 * n;
    for (int j = 0; j < n; j++) {
        double root = sqrt(fmax(lambda[j], 0));
        for (int i = 0; i < n; i++) S[i + j * m] = g[i + j * stride];
        S[j + (n + j) * m] = root;
        S[n + j + j * m] = -root;
    }
}

/* One mode of a group of `count` from a [2 count], unit: velocities x' = X p' of both parts, of which half the squares
 * decay by damping; work [2 (n + count)]. */
static void describe_turned(struct mode *o, const struct linear *l, const double *X, const double *S, double omega,
                            const double *a, int count, double *work)
{
    const int n = l->n, m = 2 * count;
    double *b = work, *v = work + m;
    times(b, S, a, m, m, m);
    for (int i = 0; i < m; i++) b[i] /= omega;
    times(v, X, a, n, count, n);
    times(v + n, X, b, n, count, n);
    *o = (struct mode){.omega = omega};
    o->damping = (form(l->C, v, n) + form(l->C, v + n, n)) / (2 * omega);
    shares(o, l, v, 2);
}

/* `count` modes; X, lambda and g [n x n] from the first of them on. */
static void gyroscopic_group(struct mode *o, const struct linear *l, const double *X, const double *lambda,
                             const double *g, int count, struct arena *life)
{
    const int n = l->n, m = 2 * count;
    double *S = TAKE_MATRIX(life, double, m, m), *A = TAKE_MATRIX(life, double, m, m),
           *Y = TAKE_MATRIX(life, double, m, m);
    double *square = TAKE(life, double, m), *work = TAKE(life, double, 2 * (n + m));
    antisymmetric(S, g, lambda, count, n);
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++)
            for (int k = 0; k < m; k++) A[i + j * m] += S[k + i * m] * S[k + j * m];
    eigen_symmetric(square, Y, A, m);
    for (int j = 0; j < count; j++) {
        double omega = sqrt(fmax(square[2 * j], 0));
        if (omega > 1e-6 * sqrt(square[m - 1]))
            describe_turned(&o[j], l, X, S, omega, Y + 2 * j * m, count, work);
        else
            describe(&o[j], l, 0, X + j * n);
    }
}

/* ---- the same with all ----
 *
 * In the modes X again, p'' + X'(G + C) X p' + X'(K + N) X p = 0; g and c have the parts of G and N. */
static bool whole_group(struct mode *o, const struct linear *l, const double *X, const double *g, const double *c,
                        int count, struct arena *life)
{
    const int n = l->n;
    double *x = TAKE(life, double, 2 * n), *G = TAKE_MATRIX(life, double, count, count),
           *K = TAKE_MATRIX(life, double, count, count);
    struct damped_mode *damped_mode = TAKE(life, struct damped_mode, count);
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++) {
            G[i + j * count] = g[i + j * n];
            K[i + j * count] = c[i + j * n];
        }
    if (!damped_modes_find(damped_mode, K, G, count, life)) return false;
    for (int j = 0; j < count; j++) {
        o[j] = (struct mode){.omega = damped_mode[j].omega, .damping = damped_mode[j].damping};
        times(x, X, damped_mode[j].p, n, count, n);
        times(x + n, X, damped_mode[j].p + count, n, count, n);
        shares(&o[j], l, x, 2);
    }
    return true;
}

/* ---- groups of frequencies far apart ---- */

/* What is needed of them all: G, N and C in the modes X of (K, M), [n x n] each. */
struct spectrum {
    const double *X, *lambda; /* [n x n], [n] ascending */
    double *g, *c, *d;
    double *size; /* [n] of the terms that lambda is the sum of */
};

/* Where the group of modes that begins at `from` ends.  What modes j far above do to a slower mode i is of the order
 * of (g_ij / omega_j)^2 and c_ij^2 / (lambda_i lambda_j): nothing, beside the digits that solving both at once costs
 * where a beam is all but massless.  lambda ascends. */
static int group_end(const double *g, const double *c, const double *lambda, int from, int n)
{
    static const double apart = 1e-5, noise = 1e-10;
    int end = from + 1;
    for (int i = from; i < end; i++)
        for (int j = n - 1; j >= end; j--) {
            const double top = fmax(lambda[j], 0), both = sqrt(fmax(lambda[i], 0) * top);
            const bool turns = fmax(fabs(g[i + j * n]), fabs(g[j + i * n])) > apart * sqrt(top);
            const double push = fmax(fabs(c[i + j * n]), fabs(c[j + i * n]));
            if (turns || push > apart * both + noise * top) end = j + 1;
        }
    return end;
}

/* Is there a mode that stiffness alone does not hold?  Round-off is that of the group and of the mode's own terms. */
static bool unstable(const double *lambda, const double *size, int count)
{
    const double most = fmax(fabs(lambda[0]), fabs(lambda[count - 1]));
    return lambda[0] < -(1e-9 * most + 1e-11 * size[0]);
}

/* `count` modes from `from` on.  False: no convergence. */
static bool describe_group(struct mode *o, const struct linear *l, const struct spectrum *s, int from, int count,
                           struct arena *life)
{
    const int n = l->n;
    const double *X = s->X + from * n, *lambda = s->lambda + from;
    double *g = s->g + from * (n + 1), *c = s->c + from * (n + 1), *d = s->d + from * (n + 1);
    const double top = sqrt(fmax(fabs(lambda[0]), fabs(lambda[count - 1])));
    const bool turns = turned(g, top, count, n);
    if (circulated(c, lambda, count, n) ||
        (turns && (unstable(lambda, s->size + from, count) || one_sided(g, d, top, count, n)))) {
        for (int j = 0; j < count; j++) {
            for (int i = 0; i < count; i++) g[i + j * n] += d[i + j * n];
            c[j + n * j] += lambda[j];
        }
        return whole_group(o, l, X, g, c, count, life);
    }
    if (turns)
        gyroscopic_group(o, l, X, lambda, g, count, life);
    else
        for (int j = 0; j < count; j++) describe(&o[j], l, lambda[j], X + j * n);
    return true;
}

static bool describe_all(struct modes *o, const struct linear *l, const double *X, const double *lambda,
                         struct arena *life)
{
    const int n = l->n;
    double *work = TAKE(life, double, n);
    struct spectrum s = {X,
                         lambda,
                         TAKE_MATRIX(life, double, n, n),
                         TAKE_MATRIX(life, double, n, n),
                         TAKE_MATRIX(life, double, n, n),
                         TAKE(life, double, n)};
    for (int j = 0; j < n; j++) s.size[j] = terms(l->K, X + j * n, n);
    in_modes(s.g, l->G, X, n, work);
    in_modes(s.c, l->N, X, n, work);
    in_modes(s.d, l->C, X, n, work);
    bool found = true;
    for (int a = 0, b; found && a < n; a = b) {
        b = group_end(s.g, s.c, lambda, a, n);
        found = describe_group(o->mode + a, l, &s, a, b - a, life);
    }
    return found;
}

/* What round-off leaves unknown of the lightest motion's mass: pivots of M against its diagonal.  L [n x n] is for
 * work. */
static double unknown_mass(const double *M, double *L, int n)
{
    double least = 1;
    memcpy(L, M, sizeof *L * (size_t)n * (size_t)n);
    if (dense_cholesky(L, n, n) >= 0) return 1;
    for (int i = 0; i < n; i++) least = fmin(least, L[i + (long)i * n] * L[i + (long)i * n] / M[i + (long)i * n]);
    return DBL_EPSILON / least;
}

enum status modes_find(struct modes *o, const struct sim *sim, struct arena *life, struct report *report)
{
    const struct ode2 *ode = sim->stepper.ode;
    struct linear l = {.ode = ode, .q = sim->x.q, .t = sim->x.t, .n = ode->n, .cls = ALL};
    struct trouble why = {0};
    int n = ode->n;
    *o = (struct modes){.slow_worst = -1, .fast_worst = -1};
    if (n > MODES_MOST) return fail(report, E_LIMIT, "modes of more than %d freedoms", MODES_MOST);
    if (n == 0) return OK;
    if (linearise(&l, life, &why) != OK)
        return fail(report, E_NUMERIC, "no linearisation at t = %g s: the residual is not a number", l.t);
    clear_idle(&l, sim);
    double *lambda = TAKE(life, double, n), *X = TAKE_MATRIX(life, double, n, n);
    int pivot = eigen_graded(lambda, X, l.K, l.M, n, TAKE_MATRIX(life, double, n, 2 * n + 1));
    if (pivot >= 0) return fail(report, E_MODEL, "coordinate '%s' moves no mass", sim_coordinate_name(sim, pivot));
    o->n = n;
    o->doubt = unknown_mass(l.M, TAKE_MATRIX(life, double, n, n), n);
    o->mode = TAKE(life, struct mode, n);
    const bool described = describe_all(o, &l, X, lambda, life);
    if (stop) return stop_status();
    if (!described) return fail(report, E_NUMERIC, "no frequencies at t = %g s: no convergence", l.t);
    local(o, &l, X, lambda);
    return OK;
}

double modes_longest_step(const struct sim *sim)
{
    return (sim->plan.until - sim->scene->start) / 100;
}

void modes_suggest(double *h, int *ratio, const struct modes *o, const struct sim *sim)
{
    static const double resolved = 0.1;
    enum { MOST_RATIO = 50 };
    const double most = modes_longest_step(sim);
    bool split = o->fast_worst >= 0 && o->fast_top > 0;
    double H = o->slow_top > 0 ? fmin(resolved / o->slow_top, most) : most;
    *h = split ? fmin(resolved / o->fast_top, H) : H;
    *h = pow(10, floor(log10(*h))) * floor(*h / pow(10, floor(log10(*h))) * 2 + 1e-9) / 2; /* two figures, down */
    *ratio = split ? (int)fmax(1, fmin(MOST_RATIO, floor(H / *h))) : 1;
}
