/* craig.c -- see craig.h
 *
 * Families of freedoms that nothing couples (stretch, torsion and the two bendings of a straight beam) are treated one
 * by one, so that modes of equal frequency in different families stay apart. */
#include "flex/craig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "la/eigen.h"

enum { MOST_PER = 6 };
static const double COUPLED = 1e-12; /* entry over the root of its diagonals */

static int picked(const struct craig *o)
{
    int n = 0;
    for (int k = 0; k < o->modes; k++) n += !o->pick || o->pick[k];
    return n;
}

int craig_count(const struct craig *o)
{
    return picked(o) + o->per * (o->ninterface - 1);
}

/* family[k]: the least freedom of a node that freedom k is coupled with, by K or M, directly or not. */
static void families(int *family, const struct craig *o)
{
    for (int k = 0; k < o->per; k++) family[k] = k;
    for (int side = 0; side < 2; side++) {
        const struct band *A = side ? o->M : o->K;
        for (int j = 0; j < A->n; j++)
            for (int i = j + 1; i < A->n && i <= j + A->width; i++) {
                int a = family[i % o->per], b = family[j % o->per], least = a < b ? a : b;
                double size = sqrt(*band_at(A, i, i)) * sqrt(*band_at(A, j, j));
                if (a == b || !(fabs(*band_at(A, i, j)) > COUPLED * size)) continue;
                for (int k = 0; k < o->per; k++)
                    if (family[k] == a || family[k] == b) family[k] = least;
            }
    }
}

static void hold(bool *held, struct band *K, struct band *M, const struct craig *o)
{
    for (int k = 0; k < o->ninterface; k++)
        for (int a = 0; a < o->per; a++) {
            int i = o->interface[k] * o->per + a;
            held[i] = true;
            band_isolate(K, i, 1);
            band_isolate(M, i, 0);
        }
}

/* Puts a mode among those found, ascending; the highest falls out, and *next is the lowest that did. */
static void keep(double *lambda, double *Phi, double *next, int *n, int most, int size, double l, const double *x)
{
    int k = *n;
    const bool full = k == most, fits = !full || (most > 0 && l < lambda[most - 1]);
    if (full) *next = fmin(*next, fits ? lambda[most - 1] : l);
    if (!fits) return;
    if (full) k--;
    for (; k > 0 && lambda[k - 1] > l; k--) {
        lambda[k] = lambda[k - 1];
        memcpy(Phi + (long)k * size, Phi + (long)(k - 1) * size, (size_t)size * sizeof *Phi);
    }
    lambda[k] = l;
    memcpy(Phi + (long)k * size, x, (size_t)size * sizeof *Phi);
    if (*n < most) ++*n;
}

/* lambda [modes], Phi [size x modes]: the lowest modes with all interfaces clamped, family by family; edge: the highest
 * of these, the lowest left out of all that were found. */
static enum status fixed_modes(double *lambda, double *Phi, double *edge, const struct craig *o, const struct band *L,
                               const struct band *M, const bool *held, struct arena *scratch, struct report *report)
{
    int size = M->n, family[MOST_PER], n = 0;
    double *l = TAKE(scratch, double, o->modes), *X = TAKE(scratch, double, o->modes *size);
    bool *use = TAKE(scratch, bool, size);
    families(family, o);
    edge[1] = INFINITY;
    for (int k = 0; k < o->per; k++) {
        int count = 0;
        for (int i = 0; i < size; i++) count += use[i] = !held[i] && family[i % o->per] == k;
        if (count > o->modes) count = o->modes;
        if (count == 0) continue;
        struct arena_mark mark = arena_mark(scratch);
        int done = band_lowest(l, X, L, M, use, count, scratch);
        arena_rewind(scratch, mark);
        if (done == -1) return fail(report, E_MODEL, "the mass matrix of the beam is not positive");
        if (done < 0) return fail(report, E_MODEL, "the modes of the beam do not converge");
        for (int j = 0; j < count; j++) keep(lambda, Phi, edge + 1, &n, o->modes, size, l[j], X + (long)j * size);
    }
    edge[0] = n ? lambda[n - 1] : 0;
    return OK;
}

/* Are these one frequency, as of a round shaft in its two planes, or of its equal spans? */
static bool same(double low, double high)
{
    static const double apart = 2e-6; /* in squares */
    return low > 0 && high - low <= apart * low;
}

/* whole: the numbers of modes next to `modes` that keep all of one frequency or none; the second 0 where there are too
 * few freedoms.  More modes are looked at than are kept, until a frequency ends. */
static enum status whole_groups(int *whole, const double *lambda, const struct craig *o, const struct band *L,
                                const struct band *M, const bool *held, int inner, struct arena *scratch,
                                struct report *report)
{
    enum { FIRST_MORE = 6 };
    double edge[2];
    whole[0] = o->modes - 1;
    while (whole[0] > 0 && same(lambda[whole[0] - 1], lambda[whole[0]])) whole[0]--;
    for (int more = FIRST_MORE;; more *= 2) {
        struct arena_mark mark = arena_mark(scratch);
        struct craig wide = *o;
        wide.modes = o->modes + more < inner ? o->modes + more : inner;
        double *l = TAKE(scratch, double, wide.modes), *Phi = TAKE_MATRIX(scratch, double, M->n, wide.modes);
        TRY(fixed_modes(l, Phi, edge, &wide, L, M, held, scratch, report));
        int end = o->modes;
        while (end < wide.modes && same(l[end - 1], l[end])) end++;
        arena_rewind(scratch, mark);
        whole[1] = end < wide.modes ? end : 0;
        if (whole[1] || wide.modes == inner) return OK;
    }
}

/* Phi [size x ...]: L L' x = -K_b where free, one at freedom b of an interface, zero at the others. */
static void constraint_modes(double *Phi, const struct craig *o, const struct band *L, const bool *held)
{
    int size = L->n;
    for (int k = 1, j = 0; k < o->ninterface; k++)
        for (int a = 0; a < o->per; a++, j++) {
            int b = o->interface[k] * o->per + a;
            double *x = Phi + (long)j * size;
            for (int i = 0; i < size; i++) {
                bool near = abs(i - b) <= L->width;
                x[i] = near && !held[i] ? -*band_at(o->K, i, b) : 0;
            }
            band_cholesky_solve(L, x);
            x[b] = 1;
        }
}

void craig_project(double *R, const struct band *A, const double *Phi, int n, double *work)
{
    for (int j = 0; j < n; j++) {
        band_mul(work, A, Phi + (long)j * A->n);
        for (int i = 0; i <= j; i++) {
            double sum = 0;
            for (int k = 0; k < A->n; k++) sum += Phi[k + (long)i * A->n] * work[k];
            R[i + n * j] = R[j + n * i] = sum;
        }
    }
}

/* Phi := Phi Q, row by row. */
static void turn(double *Phi, const double *Q, int size, int n, double *row)
{
    for (int i = 0; i < size; i++) {
        for (int j = 0; j < n; j++) row[j] = Phi[i + (long)j * size];
        for (int j = 0; j < n; j++) {
            double sum = 0;
            for (int k = 0; k < n; k++) sum += row[k] * Q[k + n * j];
            Phi[i + (long)j * size] = sum;
        }
    }
}

static enum status diagonal(double *lambda, double *Phi, const struct craig *o, struct arena *scratch,
                            struct report *report)
{
    int n = craig_count(o), size = o->K->n;
    double *K = TAKE(scratch, double, n *n), *M = TAKE(scratch, double, n *n), *Q = TAKE(scratch, double, n *n);
    double *work = TAKE(scratch, double, size);
    craig_project(K, o->K, Phi, n, work);
    craig_project(M, o->M, Phi, n, work);
    if (eigen_general(lambda, Q, K, M, n) >= 0)
        return fail(report, E_MODEL,
                    "with %d modes the beam's mass matrix is not positive: beside the masses that it carries its own "
                    "is lost in round-off; take fewer modes, or a density nearer to a real one",
                    o->modes);
    turn(Phi, Q, size, n, work);
    return OK;
}

/* Those of the clamped modes that are wanted, first. */
static void pick(double *lambda, double *Phi, const double *fixed, const double *modes, const struct craig *o)
{
    const int size = o->K->n;
    for (int k = 0, n = 0; k < o->modes; k++) {
        if (o->pick && !o->pick[k]) continue;
        lambda[n] = fixed[k];
        memcpy(Phi + (long)n++ * size, modes + (long)k * size, (size_t)size * sizeof *Phi);
    }
}

enum status craig_reduce(double *lambda, double *Phi, struct craig_edge *edge, const struct craig *o,
                         struct arena *scratch, struct report *report)
{
    int size = o->K->n, inner = size - o->per * o->ninterface;
    struct band L = band_copy(o->K, scratch), M = band_copy(o->M, scratch);
    bool *held = TAKE(scratch, bool, size);
    if (o->modes > inner)
        return fail(report, E_MODEL, "%d modes of a beam with %d freedoms between its joints: more elements are needed",
                    o->modes, inner);
    hold(held, &L, &M, o);
    if (band_cholesky(&L) >= 0) return fail(report, E_MODEL, "the stiffness matrix of the beam is not positive");
    double *fixed = TAKE(scratch, double, o->modes), *modes = TAKE_MATRIX(scratch, double, size, o->modes);
    TRY(fixed_modes(fixed, modes, edge->lambda, o, &L, &M, held, scratch, report));
    edge->parted = !o->pick && same(edge->lambda[0], edge->lambda[1]);
    if (edge->parted) TRY(whole_groups(edge->whole, fixed, o, &L, &M, held, inner, scratch, report));
    pick(lambda, Phi, fixed, modes, o);
    constraint_modes(Phi + (long)picked(o) * size, o, &L, held);
    return o->raw ? OK : diagonal(lambda, Phi, o, scratch, report);
}
