/* signal.c -- values given by an expression or by a table of time; see force.h */
#include <math.h>

#include "expr/expr.h"
#include "kind/force.h"

/* The table's piece with t[i] <= t < t[i + 1]; by halving. */
static int piece(const struct signal *s, double t)
{
    int lo = 0, hi = s->n - 1;
    while (hi - lo > 1) {
        int mid = lo + (hi - lo) / 2;
        if (s->t[mid] <= t)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

/* An empty table is 0. */
static double table_value(double *slope, const struct signal *s, double t)
{
    *slope = 0;
    if (s->n == 0) return 0;
    if (t <= s->t[0]) return s->x[0];
    if (t >= s->t[s->n - 1]) return s->x[s->n - 1];
    int i = piece(s, t);
    *slope = (s->x[i + 1] - s->x[i]) / (s->t[i + 1] - s->t[i]);
    return s->x[i] + *slope * (t - s->t[i]);
}

double signal_value(const struct signal *s, const double *slot)
{
    double slope;
    return s->expr ? expr_value(s->expr, slot) : table_value(&slope, s, slot[0]);
}

double signal_slopes(const struct signal *s, double *d, const double *slot, const int *which, int n)
{
    if (s->expr) return expr_slopes(s->expr, d, slot, which, n);
    double slope, x = table_value(&slope, s, slot[0]);
    for (int i = 0; i < n; i++) d[i] = which[i] == 0 ? slope : 0;
    return x;
}

bool signal_reads_time(const struct signal *s)
{
    int first = -1;
    return s->expr ? expr_reads(s->expr, &first, 1) > 0 && first == 0 : s->n > 0;
}

double signal_next(const struct signal *s, double t)
{
    if (s->expr || s->n == 0 || t >= s->t[s->n - 1]) return INFINITY;
    return t < s->t[0] ? s->t[0] : s->t[piece(s, t) + 1];
}
