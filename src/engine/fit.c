/* fit.c -- see fit.h */
#include "engine/fit.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "la/wide.h"

void fits_recall(struct fit *o, struct recall *r, const char *name, int n, size_t stride)
{
    const size_t many = (size_t)n;
    recall_within(r, name);
    recall_doubles(r, "s11", &o->s11, many, stride);
    recall_doubles(r, "s12", &o->s12, many, stride);
    recall_doubles(r, "s22", &o->s22, many, stride);
    recall_doubles(r, "s01", &o->s01, many, stride);
    recall_doubles(r, "s02", &o->s02, many, stride);
    recall_doubles(r, "last", &o->last, many, stride);
    recall_doubles(r, "before", &o->before, many, stride);
    recall_ints(r, "terms", &o->terms, many, stride);
    recall_without(r);
}

/* ---- side by side ---------------------------------------------------------------------------------------------- */

enum { LISTS = 8, ABREAST = 4, FEW = 4 /* up to so many, calls cost more than they do */ };

int fit_room(int n)
{
    return n > FEW ? (n + ABREAST - 1) / ABREAST * ABREAST : n;
}

void fit_row_open(struct fit_row *o, int n, struct arena *life)
{
    double **list[LISTS] = {&o->s11, &o->s12, &o->s22, &o->s01, &o->s02, &o->last, &o->before, &o->below};
    o->room = fit_room(n);
    o->terms = 0;
    double *all = TAKE_MATRIX(life, double, o->room, LISTS);
    for (int k = 0; k < LISTS; k++) *list[k] = all + (long)k * o->room;
}

void fit_row_forget(struct fit_row *o)
{
    zero(o->s11, LISTS * o->room);
    o->terms = 0;
}

void fit_row_recall(struct fit_row *o, struct recall *r, const char *name, int n)
{
    recall_within(r, name);
    recall_list(r, "s11", o->s11, n);
    recall_list(r, "s12", o->s12, n);
    recall_list(r, "s22", o->s22, n);
    recall_list(r, "s01", o->s01, n);
    recall_list(r, "s02", o->s02, n);
    recall_list(r, "last", o->last, n);
    recall_list(r, "before", o->before, n);
    recall_one(r, "terms", o->terms);
    recall_without(r);
}

static inline struct fit one_of(const struct fit_row *o, int i)
{
    return (struct fit){.s11 = o->s11[i],
                        .s12 = o->s12[i],
                        .s22 = o->s22[i],
                        .s01 = o->s01[i],
                        .s02 = o->s02[i],
                        .last = o->last[i],
                        .before = o->before[i],
                        .terms = o->terms};
}

/* fit_learn() of all. */
WIDE static void sums(double *restrict s11, double *restrict s12, double *restrict s22, double *restrict s01,
                      double *restrict s02, double *restrict last, double *restrict before,
                      const double *restrict delta, int room)
{
    const int n = room / ABREAST * ABREAST; /* as it is: so it is known to be a multiple */
    for (int i = 0; i < n; i++) {
        const double a = last[i], b = before[i], d = delta[i];
        s11[i] = FIT_FADE * s11[i] + a * a;
        s12[i] = FIT_FADE * s12[i] + a * b;
        s22[i] = FIT_FADE * s22[i] + b * b;
        s01[i] = FIT_FADE * s01[i] + d * a;
        s02[i] = FIT_FADE * s02[i] + d * b;
        before[i] = a;
        last[i] = d;
    }
}

void fit_row_learn(struct fit_row *o, const double *delta)
{
    if (o->terms < 2) {
        copy(o->before, o->last, o->room);
        copy(o->last, delta, o->room);
        o->terms++;
        return;
    }
    if (o->room > FEW) {
        sums(o->s11, o->s12, o->s22, o->s01, o->s02, o->last, o->before, delta, o->room);
        return;
    }
    for (int i = 0; i < o->room; i++) {
        struct fit f = one_of(o, i);
        fit_learn(&f, delta[i]);
        o->s11[i] = f.s11, o->s12[i] = f.s12, o->s22[i] = f.s22, o->s01[i] = f.s01, o->s02[i] = f.s02;
        o->last[i] = f.last, o->before[i] = f.before;
    }
}

/* Numerator and denominator of the next one, as fit_next(). */
WIDE static void quotients(double *restrict above, double *restrict below, const double *restrict s11,
                           const double *restrict s12, const double *restrict s22, const double *restrict s01,
                           const double *restrict s02, const double *restrict last, const double *restrict before,
                           int room)
{
    const int n = room / ABREAST * ABREAST;
    for (int i = 0; i < n; i++) {
        const double e = FIT_VAGUE * (s11[i] + s22[i]), a = s11[i] + e, b = s12[i], c = s22[i] + e;
        const double x = s01[i] + e, y = s02[i];
        above[i] = (c * x - b * y) * last[i] + (a * y - b * x) * before[i];
        below[i] = a * c - b * b;
    }
}

void fit_row_next(const struct fit_row *o, double *next)
{
    const double *a = o->last, *b = o->before;
    if (o->room <= FEW) {
        for (int i = 0; i < o->room; i++) {
            const struct fit f = one_of(o, i);
            next[i] = fit_next(&f);
        }
        return;
    }
    quotients(next, o->below, o->s11, o->s12, o->s22, o->s01, o->s02, a, b, o->room);
    for (int i = 0; i < o->room; i++) {
        const double most = FIT_GROWTH * larger(fabs(a[i]), fabs(b[i]));
        next[i] = o->below[i] > 0 ? larger(-most, smaller(most, next[i] / o->below[i])) : a[i];
    }
}
