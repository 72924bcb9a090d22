/* summary.c -- see summary.h */
#include "reduce/summary.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "out/table.h"
#include "reduce/rigid.h"

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* r'M r less what the nodes of a rigid reference hold: those never move. */
static double movable(double *r, double *Mr, const struct fe *fe, const struct tie *reference)
{
    sparse_mul(Mr, &fe->M, r);
    double all = dot(r, Mr, 3 * fe->n);
    if (!reference->rigid) return all;
    for (int i = 0; i < reference->n; i++)
        for (int a = 0; a < 3; a++) Mr[3 * reference->node[i] + a] = NAN; /* marks */
    for (int i = 0; i < 3 * fe->n; i++)
        if (!isnan(Mr[i])) r[i] = 0;
    sparse_mul(Mr, &fe->M, r);
    return all - dot(r, Mr, 3 * fe->n);
}

void words_effective(double *e, const struct fe *fe, const struct basis *basis, const struct tie *reference,
                     struct arena *life)
{
    double *r = TAKE(life, double, basis->size), *Mr = TAKE(life, double, basis->size);
    for (int k = 0; k < 6; k++) {
        rigid_motion(r, fe, reference->x, k);
        for (int j = 0; j < basis->n; j++) {
            double g = dot(r, basis->MV + (size_t)j * (size_t)basis->size, basis->size);
            e[k + 6 * j] = g * g;
        }
        double whole = movable(r, Mr, fe, reference);
        for (int j = 0; j < basis->n; j++) e[k + 6 * j] = whole > 0 ? e[k + 6 * j] / whole : 0;
    }
}

static const struct table_column columns[] = {{"mode", NULL, 6}, {"f", "f [Hz]", 7}, {"x", NULL, 3},  {"y", NULL, 3},
                                              {"z", NULL, 3},    {"rx", NULL, 3},    {"ry", NULL, 3}, {"rz", NULL, 3}};

static double plain(double x)
{
    return x < 1e-6 ? 0 : x;
}

static void print_table(const double *e, const double *left, const struct basis *basis, struct arena *life)
{
    struct table *table = table_open(columns, sizeof columns / sizeof *columns, life);
    for (int j = 0; j < basis->n; j++) {
        table_number(table, j + 1);
        table_number(table, sqrt(basis->lambda[j]) / 6.28318530717958647693);
        for (int k = 0; k < 6; k++) table_number(table, plain(e[k + 6 * j]));
    }
    table_number(table, NAN);
    table_number(table, NAN);
    for (int k = 0; k < 6; k++) table_number(table, plain(left[k]));
    fprintf(stderr, "effective mass and inertia of the modes, shares; last line: left out\n%s",
            table_draw(table, life));
}

void summary_print(const struct fe *fe, const struct basis *basis, const struct tie *reference, bool quiet,
                   struct arena *life)
{
    double *e = TAKE(life, double, 6 * basis->n), left[6] = {1, 1, 1, 1, 1, 1};
    words_effective(e, fe, basis, reference, life);
    for (int k = 0; k < 6; k++)
        for (int j = 0; j < basis->n; j++) left[k] -= e[k + 6 * j];
    if (!quiet) {
        fprintf(stderr, "%d nodes, mass %.6g kg, centre of mass %.6g %.6g %.6g m, %d modes\n", fe->n, fe->mass,
                fe->centre[0], fe->centre[1], fe->centre[2], basis->n);
        print_table(e, left, basis, life);
        if (basis->next > 0 && basis->fixed)
            fprintf(stderr, "modes with the interfaces held: up to %.6g Hz kept, from %.6g Hz left out\n", basis->last,
                    basis->next);
    }
    for (int k = 0; k < 3; k++)
        if (left[k] > 0.1)
            fprintf(stderr, "warning: along %c %.0f%% of the effective mass is left out: take more modes\n", "xyz"[k],
                    100 * left[k]);
    if (basis->next > 0 && basis->fixed && basis->next < 1.05 * basis->last)
        fprintf(stderr, "warning: the first mode left out, %.6g Hz, is close to the last one kept, %.6g Hz\n",
                basis->next, basis->last);
}
