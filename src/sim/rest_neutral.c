/* rest_neutral.c -- equilibria that some motion does not leave: a balanced shaft in its bearings, what floats.
 *
 * Of K z = lambda M z the motions of lambda next to nothing are looked at by themselves: z both ways by a small way, all else
 * brought to its balance there by Newton's steps.  Where no force along z comes of it z is neutral: it goes back to where it was
 * drawn, as far as z leads there, and is told.  What is held weakly comes back, what is not stable goes on; a force along z is
 * no equilibrium. */
#include <math.h>
#include <string.h>

#include "engine/motion.h"
#include "la/dense.h"
#include "la/eigen.h"
#include "sim/rest_parts.h"

static const double WEAK = 1e-6;  /* of the largest lambda: differences do not tell it from nothing */
static const double LEAST = 1;    /* that, at least [1/s2] */
static const double FLAT = 1e-6;  /* along the way of z: a period of 6000 s [1/s2] */
static const double STILL = 1e-9; /* what pushes: 5 um in 100 s [m/s2], [rad/s2] */

enum { MOST = 200, PASSES = 3 }; /* coordinates: Jacobi's rotations are dear */

void rest_neutral_open(struct rest *s, struct arena *scratch)
{
    const int n = s->n <= MOST ? s->n : 0;
    double **square[] = {&s->N, &s->Z};
    for (int i = 0; i < 2; i++) *square[i] = TAKE_MATRIX(scratch, double, n, n);
    s->lambda = TAKE(scratch, double, n);
    s->work = TAKE(scratch, double, (2 * n + 1) * n);
}

bool rest_suspects(const struct rest *s, bool held)
{
    static const double NOTHING = 1e-9;
    double least = INFINITY, most = 0;
    if (s->n > MOST) return false;
    for (int i = 0; held && i < s->n; i++) {
        const double pivot = s->J[i + i * s->n], mass = s->M[i + i * s->n], lambda = pivot * pivot / mass;
        least = fmin(least, lambda);
        most = fmax(most, lambda);
    }
    return !held || least < NOTHING * fmax(most, LEAST);
}

static double largest(const double *x, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(x[i]));
    return most;
}

/* dx += Newton's step of all that is held, from residual r. */
static void balance(const struct rest *s, double *dx, const double *r, double weak)
{
    for (int j = 0; j < s->n; j++) {
        const double *z = s->Z + (long)j * s->n, y = s->lambda[j] > weak ? -dot(z, r, s->n) / s->lambda[j] : 0;
        for (int i = 0; i < s->n; i++) dx[i] += y * z[i];
    }
}

/* The force along motion k that comes of going y along it, all else brought into balance. */
static enum status force_there(struct rest *s, double *force, int k, double y, double weak)
{
    struct trouble why;
    const double *z = s->Z + (long)k * s->n;
    for (int i = 0; i < s->n; i++) s->dx[i] = y * z[i];
    for (int pass = 0;; pass++) {
        rest_displaced(s, s->q1, s->dx);
        TRY(rest_resid(s, s->r1, s->q1, &why));
        if (pass == PASSES) break;
        balance(s, s->dx, s->r1, weak);
    }
    *force = dot(z, s->r1, s->n);
    return OK;
}

/* lambda of motion k along its way, the smaller of both directions; not a number: the mechanism does not go there. */
static double along(struct rest *s, int k, double weak)
{
    static const double WAY = 1e-3; /* [m], [rad] */
    const double y = WAY / largest(s->Z + (long)k * s->n, s->n), here = dot(s->Z + (long)k * s->n, s->r, s->n);
    double there, back;
    if (force_there(s, &there, k, y, weak) != OK || force_there(s, &back, k, -y, weak) != OK) return NAN;
    return fmin(there - here, here - back) / y;
}

/* Motion k, which nothing pushes, by what it has beside those that are there. */
static void add(struct rest *s, int k)
{
    double *z = s->N + (long)s->neutral * s->n;
    memcpy(z, s->Z + (long)k * s->n, sizeof *z * (size_t)s->n);
    rest_leave_neutral(s, z);
    const double size = sqrt(dot(z, z, s->n));
    for (int i = 0; i < s->n; i++) z[i] /= size;
    s->neutral++;
}

bool rest_settles_neutral(struct rest *s)
{
    const int n = s->n;
    bool stable = true;
    if (eigen_graded(s->lambda, s->Z, s->K, s->M, n, s->work) >= 0) return false;
    const double top = fmax(LEAST, fmax(fabs(s->lambda[0]), fabs(s->lambda[n - 1])));
    for (int k = 0; k < n; k++) {
        const double *z = s->Z + (long)k * n, push = dot(z, s->r, n) * largest(z, n);
        if (fabs(s->lambda[k]) <= WEAK * top) {
            s->lambda[k] = along(s, k, WEAK * top);
            if (fabs(s->lambda[k]) <= FLAT && fabs(push) <= STILL) {
                s->lambda[k] = 0;
                add(s, k);
                continue;
            }
        }
        stable &= s->lambda[k] > FLAT;
    }
    memset(s->dx, 0, sizeof *s->dx * (size_t)n);
    balance(s, s->dx, s->r, 0);
    rest_displaced(s, s->q1, s->dx);
    return stable && largest(s->dx, n) <= REST_TINY;
}

int rest_falls(struct rest *s)
{
    static const double NEAR = 1e-9; /* [m], [rad] */
    const int n = s->n;
    int most = 0;
    if (n == 0 || n > MOST || eigen_graded(s->lambda, s->Z, s->K, s->M, n, s->work) >= 0) return -1;
    int falls = 0;
    double top = LEAST;
    for (int k = 0; k < n; k++) {
        if (s->lambda[k] < s->lambda[falls]) falls = k;
        top = fmax(top, fabs(s->lambda[k]));
    }
    if (!(s->lambda[falls] < -WEAK * top)) return -1;
    for (int k = 0; k < n; k++) {
        const double *z = s->Z + (long)k * n, push = fabs(dot(z, s->r, n)) * largest(z, n);
        if (push > fmax(STILL, NEAR * fabs(s->lambda[k]))) return -1;
    }
    const double *z = s->Z + (long)falls * n;
    for (int i = 0; i < n; i++)
        if (fabs(z[i]) > fabs(z[most])) most = i;
    return most;
}

void rest_hold_neutral(const struct rest *s, double *J)
{
    const int n = s->n;
    double most = 0;
    for (int i = 0; s->neutral && i < n; i++) most = fmax(most, fabs(J[i + (long)i * n]));
    for (int k = 0; k < s->neutral; k++) {
        const double *z = s->N + (long)k * n;
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) J[i + (long)j * n] += most * z[i] * z[j];
    }
}

void rest_leave_neutral(const struct rest *s, double *dx)
{
    for (int k = 0; k < s->neutral; k++) {
        const double *z = s->N + (long)k * s->n, y = dot(z, dx, s->n);
        for (int i = 0; i < s->n; i++) dx[i] -= y * z[i];
    }
}

bool rest_goes_back(struct rest *s)
{
    static const double NEAR = 1e-9; /* [m], [rad] */
    struct trouble why;
    for (int i = 0; i < s->n; i++) s->dx[i] = -s->gone[i];
    rest_leave_neutral(s, s->dx);
    for (int i = 0; i < s->n; i++) s->dx[i] = -s->gone[i] - s->dx[i];
    if (s->neutral == 0 || largest(s->dx, s->n) <= NEAR) return false;
    memcpy(s->q, s->q1, sizeof *s->q * (size_t)s->ode->nq);
    rest_displaced(s, s->q1, s->dx);
    memcpy(s->q, s->q1, sizeof *s->q * (size_t)s->ode->nq);
    return rest_resid(s, s->r, s->q, &why) == OK;
}

/* Each by the coordinate that it moves most, the others without that. */
void rest_name_neutral(struct neutral *names, const struct rest *s)
{
    const int n = s->n;
    names->n = s->neutral;
    for (int k = 0; k < s->neutral && k < NEUTRAL_NAMES; k++) {
        double most = 0;
        for (int i = 0; i < n; i++) {
            double sum = 0;
            for (int l = 0; l < s->neutral; l++) sum += s->N[i + (long)l * n] * s->N[i + (long)l * n];
            for (int l = 0; l < k; l++)
                if (names->at[l] == i) sum = 0;
            if (sum > most * (1 + 1e-6)) most = sum, names->at[k] = i;
        }
    }
}

void sim_print_neutral(const struct sim *sim, FILE *to)
{
    const struct neutral *o = &sim->neutral;
    const char *before = "";
    if (!to || o->n == 0) return;
    fputs("static: nothing holds", to);
    for (int k = 0; k < o->n && k < NEUTRAL_NAMES; k++) {
        const char *name = sim_coordinate_name(sim, o->at[k]);
        if (strcmp(name, before) != 0) fprintf(to, "%s '%s'", k > 0 ? "," : "", name); /* a ball joint has three */
        before = name;
    }
    if (o->n > NEUTRAL_NAMES) fprintf(to, " and %d more", o->n - NEUTRAL_NAMES);
    fputs(" where it stands, and nothing pushes it: any posture of it is at rest\n", to);
}
