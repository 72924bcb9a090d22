/* elastic.c -- see elastic.h */
#include "system/elastic.h"

#include "system/ode2.h"

void elastic_build(struct elastic *o, const struct model *m, struct arena *life)
{
    *o = (struct elastic){.body = TAKE(life, const struct model_body *, m->nbody)};
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].flex) o->body[o->n++] = &m->body[i];
}

static bool in_class(const struct model_body *b, enum rate cls)
{
    return cls & (b->fast ? FAST : SLOW);
}

/* x'A x of a body's coordinates, which stand at `at` in x. */
static double square(const double *A, const double *x, const int *at, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++) {
        double Ax = 0;
        for (int i = 0; i < n; i++) Ax += A[i + n * j] * x[at[i]];
        sum += Ax * x[at[j]];
    }
    return sum;
}

double elastic_stored(const struct elastic *o, const double *q)
{
    double V = 0;
    for (int i = 0; i < o->n; i++) V += .5 * square(o->body[i]->flex->K, q, o->body[i]->mode_q, o->body[i]->nmode);
    return V;
}

double elastic_lost(const struct elastic *o, const double *v, enum rate cls)
{
    double lost = 0;
    for (int i = 0; i < o->n; i++) {
        const struct model_body *b = o->body[i];
        if (b->flex->D && in_class(b, cls)) lost += square(b->flex->D, v, b->mode_v, b->nmode);
    }
    return lost;
}

static void add(double *A, size_t n, const double *part, const struct model_body *b)
{
    if (!A || !part) return;
    for (int j = 0; j < b->nmode; j++)
        for (int i = 0; i < b->nmode; i++) A[(size_t)b->mode_v[i] + n * (size_t)b->mode_v[j]] += part[i + b->nmode * j];
}

void elastic_slopes(const struct elastic *o, double *K, double *C, int n, enum rate cls)
{
    for (int i = 0; i < o->n; i++) {
        if (!in_class(o->body[i], cls)) continue;
        add(K, (size_t)n, o->body[i]->flex->K, o->body[i]);
        add(C, (size_t)n, o->body[i]->flex->D, o->body[i]);
    }
}
