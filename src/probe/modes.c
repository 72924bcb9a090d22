/* modes.c -- see modes.h */
#include "probe/modes.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"

struct linear {
    const struct ode2 *ode;
    const double *q; /* [nq] posture */
    double t;
    int n;
    double *M, *K, *C; /* [n x n] */
};

static void displaced(const struct linear *l, double *q1, const double *dx)
{
    if (l->ode->move)
        l->ode->move->point(l->ode, q1, l->q, dx, 1, l->t);
    else
        for (int i = 0; i < l->n; i++) q1[i] = l->q[i] + dx[i];
}

/* K by central differences of r at rest, made symmetric. */
static enum status stiffness(struct linear *l, struct arena *life, struct trouble *why)
{
    static const double step = 1e-5; /* [m], [rad] */
    int n = l->n;
    double *q1 = TAKE(life, double, l->ode->nq), *dx = TAKE(life, double, n), *zero = TAKE(life, double, n);
    double *up = TAKE(life, double, n), *down = TAKE(life, double, n);
    struct instant x = {.t = l->t, .q = q1, .v = zero, .ta = l->t, .tb = l->t};
    for (int j = 0; j < n; j++) {
        dx[j] = step;
        displaced(l, q1, dx);
        TRY(l->ode->ops->resid(l->ode, up, NULL, NULL, &x, ALL, why));
        dx[j] = -step;
        displaced(l, q1, dx);
        TRY(l->ode->ops->resid(l->ode, down, NULL, NULL, &x, ALL, why));
        dx[j] = 0;
        for (int i = 0; i < n; i++) l->K[i + j * n] = (up[i] - down[i]) / (2 * step);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) l->K[i + j * n] = l->K[j + i * n] = (l->K[i + j * n] + l->K[j + i * n]) / 2;
    return OK;
}

static enum status linearise(struct linear *l, struct arena *life, struct trouble *why)
{
    int n = l->n;
    double *zero = TAKE(life, double, n);
    l->M = TAKE(life, double, n *n);
    l->K = TAKE(life, double, n *n);
    l->C = TAKE(life, double, n *n);
    struct instant x = {.t = l->t, .q = l->q, .v = zero, .ta = l->t, .tb = l->t};
    TRY(l->ode->ops->mass(l->ode, l->M, l->q, l->t, ALL, why));
    TRY(l->ode->ops->slopes(l->ode, l->K, l->C, &x, ALL, why));
    return stiffness(l, life, why);
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

/* Who moves: shares x_i (M x)_i of the kinetic energy. */
static void shares(struct mode *o, const struct linear *l, const double *x)
{
    int n = l->n;
    for (int k = 0; k < 3; k++) o->top[k] = -1;
    for (int i = 0; i < n; i++) {
        double part = 0;
        for (int j = 0; j < n; j++) part += l->M[i + j * n] * x[j];
        part = fabs(part * x[i]);
        if (i < l->ode->ns) o->fast += part;
        for (int k = 0; k < 3; k++) {
            if (o->top[k] >= 0 && part <= o->share[k]) continue;
            for (int m = 2; m > k; m--) o->top[m] = o->top[m - 1], o->share[m] = o->share[m - 1];
            o->top[k] = i;
            o->share[k] = part;
            break;
        }
    }
}

static void describe(struct mode *o, const struct linear *l, double lambda, const double *x)
{
    int n = l->n;
    double damping = 0;
    *o = (struct mode){.omega = lambda < 0 ? -sqrt(-lambda) : sqrt(lambda)};
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) damping += x[i] * l->C[i + j * n] * x[j];
    if (lambda > 0) o->damping = damping / (2 * o->omega);
    shares(o, l, x);
}

enum status modes_find(struct modes *o, const struct sim *sim, struct arena *life, struct report *report)
{
    const struct ode2 *ode = sim->stepper.ode;
    struct linear l = {.ode = ode, .q = sim->x.q, .t = sim->x.t, .n = ode->n};
    struct trouble why = {0};
    int n = ode->n;
    *o = (struct modes){.slow_worst = -1, .fast_worst = -1};
    if (n > MODES_MOST) return fail(report, E_LIMIT, "modes of more than %d freedoms", MODES_MOST);
    if (n == 0) return OK;
    if (linearise(&l, life, &why) != OK)
        return fail(report, E_NUMERIC, "no linearisation at t = %g s: the residual is not a number", l.t);
    double *lambda = TAKE(life, double, n), *X = TAKE(life, double, n *n), *M = TAKE(life, double, n *n);
    memcpy(M, l.M, sizeof *M * (size_t)(n * n));
    int pivot = eigen_general(lambda, X, l.K, M, n);
    if (pivot >= 0) return fail(report, E_MODEL, "coordinate '%s' moves no mass", sim_coordinate_name(sim, pivot));
    o->n = n;
    o->mode = TAKE(life, struct mode, n);
    for (int j = 0; j < n; j++) describe(&o->mode[j], &l, lambda[j], X + j * n);
    local(o, &l, X, lambda);
    return OK;
}

void modes_suggest(double *h, int *ratio, const struct modes *o, const struct sim *sim)
{
    static const double resolved = 0.1;
    enum { MOST_RATIO = 50 };
    double until = sim->plan.until;
    bool split = o->fast_worst >= 0 && o->fast_top > 0;
    double H = o->slow_top > 0 ? resolved / o->slow_top : until / 100;
    *h = split ? fmin(resolved / o->fast_top, H) : H;
    *h = pow(10, floor(log10(*h))) * floor(*h / pow(10, floor(log10(*h))) * 2 + 1e-9) / 2; /* two figures, down */
    *ratio = split ? (int)fmax(1, fmin(MOST_RATIO, floor(fmin(H, until / 100) / *h))) : 1;
}
