/* growth.c -- do small differences between motions grow along the run?
 *
 * Near one state small differences follow d'' = A d + B d'.  Their growth rate is the largest real part of the
 * eigenvalues of [0 1; A, B], with A and B by differences of accelerations.  This is no Lyapunov exponent: what
 * grows at one place may shrink at the next.  Along an orbit, where differences grow only in proportion to time, the
 * rate is positive everywhere.  In either case sums of local errors are too small where it is positive all along the
 * run. */
#include <complex.h>
#include <math.h>

#include "engine/accel.h"
#include "engine/motion.h"
#include "engine/single.h"
#include "la/schur.h"
#include "sim/parts.h"

enum { FEW_FREEDOMS = 10, MOST_FREEDOMS = 40 };
static const double PART = .02;  /* of a run's evaluations */
static const double BLUR = 1e-4; /* of the largest eigenvalue: round-off of the differences, for a double eigenvalue */

/* Cost of one place in evaluations, that of the eigenvalues included. */
static double price(int n)
{
    return 2 * n + 1 + (n > FEW_FREEDOMS ? n * n / 2. : 0);
}

int growth_places(const struct sim *sim)
{
    const int n = sim->stepper.ode->n;
    if (n > MOST_FREEDOMS || sim->stepper.touch) return 0;
    return (int)(PART * (double)sim->stepper.effort.slow / price(n));
}

/* Accelerations a [n] with coordinate i, or velocity i - n, displaced by *by, a small part of its usual size; i < 0:
 * none. */
static enum status accelerations(double *a, double *by, struct sim *sim, const struct growth_place *p, int i)
{
    static const double SMALL = 1e-7;
    const struct ode2 *o = sim->stepper.ode;
    struct trust *t = &sim->trust;
    const int n = o->n;
    for (int k = 0; k < n; k++) t->dq[k] = 0;
    copy(t->dv, p->v, n);
    *by = i < 0 ? 0 : SMALL * ode2_usual(o, i < n ? i : i - n);
    if (i >= n) *by *= fmax(1, p->pace), t->dv[i - n] += *by;
    if (i >= 0 && i < n) t->dq[i] = *by;
    motion_point(o, sim->look->q, p->q, t->dq, 1, p->t);
    return accel_solve(sim->stepper.accel, a, NULL, sim->look->q, t->dv, p->t, &sim->trouble);
}

/* [0 1; A, B] by column [2n x 2n]. */
static enum status linearize(double *J, struct sim *sim, const struct growth_place *p, struct arena *scratch)
{
    const int n = sim->stepper.ode->n;
    double *a0 = TAKE(scratch, double, n), *a = TAKE(scratch, double, n), by;
    TRY(accelerations(a0, &by, sim, p, -1));
    for (int i = 0; i < 2 * n; i++) {
        TRY(accelerations(a, &by, sim, p, i));
        for (int k = 0; k < n; k++) J[2 * n * i + n + k] = (a[k] - a0[k]) / by;
        if (i >= n) J[2 * n * i + i - n] = 1;
    }
    return OK;
}

double growth_at(struct sim *sim, const struct growth_place *p, double *blur)
{
    const struct effort effort = sim->stepper.effort;
    const int m = 2 * sim->stepper.ode->n;
    struct arena *scratch = arena_open();
    double *J = TAKE_MATRIX(scratch, double, m, m), most = 0, fastest = 0;
    double complex *s = TAKE(scratch, double complex, m);
    const bool known = linearize(J, sim, p, scratch) == OK && schur_eigen(s, NULL, J, m, scratch);
    for (int i = 0; known && i < m; i++) {
        most = fmax(most, creal(s[i]));
        fastest = fmax(fastest, cabs(s[i]));
    }
    *blur = known ? BLUR * fastest : INFINITY;
    arena_close(scratch);
    sim->stepper.effort = effort;
    return most;
}
