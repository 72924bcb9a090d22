/* local_error.c -- see local_error.h */
#include "engine/local_error.h"

#include <math.h>
#include <string.h>

#include "base/scalar.h"

void local_error_open(struct local_error *o, int n, struct arena *life)
{
    double **vector[] = {&o->mean, &o->jerk, &o->new_mean, &o->new_jerk, &o->position, &o->velocity};
    *o = (struct local_error){.n = n};
    for (size_t i = 0; i < sizeof vector / sizeof *vector; i++) *vector[i] = TAKE(life, double, n);
}

void local_error_forget(struct local_error *o)
{
    o->known = 0;
    o->h = 0;
}

/* At the start the mean acceleration of a step of no length stands for the step before, and nothing is known of s: what vibrates
 * within the step changes all of j, and s is taken to be j/h.  Who puts such a step there himself knows no s. */
static double fourth(const struct local_error *o, int i, double h)
{
    if (o->known == 0) return o->new_jerk[i] / h;
    return o->h > 0 ? (o->new_jerk[i] - o->jerk[i]) / o->h : 0;
}

void local_error_try(struct local_error *o, const double *dv, const double *a0, double h, double c)
{
    const double *before = o->known > 0 ? o->mean : a0, off = c * h * h * h;
    const double apart = (h + o->h) / 2;
    for (int i = 0; i < o->n; i++) {
        o->new_mean[i] = dv[i] / h;
        o->new_jerk[i] = (o->new_mean[i] - before[i]) / apart;
        o->position[i] = off * o->new_jerk[i];
        o->velocity[i] = off * fourth(o, i, h);
    }
}

void local_error_end(const struct local_error *o, double *apart, bool kept, const double *a, double h)
{
    const double *mean = kept ? o->mean : o->new_mean, *jerk = kept ? o->jerk : o->new_jerk;
    for (int i = 0; i < o->n; i++) apart[i] = a[i] - mean[i] - h / 2 * jerk[i];
}

void local_error_apart(double *position, double *velocity, const double *apart, double h, int n)
{
    for (int i = 0; i < n; i++) {
        const double off = h / 6 * fabs(apart[i]);
        velocity[i] = worse(fabs(velocity[i]), off);
        position[i] = worse(fabs(position[i]), h / 2 * off);
    }
}

static void swap(double **a, double **b)
{
    double *x = *a;
    *a = *b;
    *b = x;
}

void local_error_keep(struct local_error *o, double h)
{
    swap(&o->mean, &o->new_mean);
    swap(&o->jerk, &o->new_jerk);
    o->h = h;
    if (o->known < 2) o->known++;
}

void local_error_copy(struct local_error *to, const struct local_error *from)
{
    memcpy(to->mean, from->mean, (size_t)to->n * sizeof *to->mean);
    memcpy(to->jerk, from->jerk, (size_t)to->n * sizeof *to->jerk);
    to->h = from->h;
    to->known = from->known;
}

void local_error_recall(struct local_error *o, struct recall *r)
{
    recall_within(r, "local");
    recall_list(r, "mean", o->mean, (size_t)o->n);
    recall_list(r, "jerk", o->jerk, (size_t)o->n);
    recall_one(r, "h", o->h);
    recall_one(r, "known", o->known);
    recall_without(r);
}
