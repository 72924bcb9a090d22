/* slopes.c -- rows into K = dr/dq and C = dr/dv. */
#include "force/parts.h"

static void outer_reduced(const struct reduction *to, double *A, const struct row *row, const struct row *column,
                          double scale)
{
    const double *y = to->y, *z = row == column ? to->y : to->z;
    to->row(to->self, to->y, row);
    if (row != column) to->row(to->self, to->z, column);
    for (int j = 0; j < to->n; j++)
        for (int i = 0; z[j] != 0 && i < to->n; i++) A[i + (size_t)to->n * (size_t)j] += scale * y[i] * z[j];
}

void outer(const struct elements *e, double *A, const struct row *row, const struct row *column, double scale)
{
    const size_t n = (size_t)e->model->n;
    if (!A || scale == 0) return;
    if (e->to) {
        outer_reduced(e->to, A, row, column, scale);
        return;
    }
    for (int j = 0; j < column->n; j++)
        for (int i = 0; i < row->n; i++)
            A[row->k[i] + n * (size_t)column->k[j]] += scale * row->x[row->k[i]] * column->x[column->k[j]];
}

/* A += scale e_k e_k' */
static void along(struct elements *e, double *A, int k, double scale)
{
    if (A && !e->to) A[(size_t)k * (size_t)(e->model->n + 1)] += scale;
    if (!e->to) return;
    row_clear(&e->row);
    row_add(&e->row, k, 1);
    outer(e, A, &e->row, &e->row, scale);
}

void row_between(struct row *o, const struct elements *e, const struct sweep *s, int a, const double *at_a, int b,
                 const double *at_b, const double *dir)
{
    row_clear(o);
    row_add_body(o, &e->measures, s, b, at_b, dir, 1);
    row_add_body(o, &e->measures, s, a, at_a, dir, -1);
}

void elements_slopes(struct elements *e, struct sweep *s, double *K, double *C, const struct instant *x, enum rate cls)
{
    if (x->qa && x->qb && e->ends[cls]) {
        measure_end(e, x, 0, cls);
        measure_end(e, x, 1, cls);
    }
    for (int i = first_of(e->nplain, cls); i < last_of(e->nplain, cls); i++) {
        const struct plain *p = &e->plain[i];
        along(e, K, p->iv, p->k);
        along(e, C, p->iv, p->c);
    }
    for (int i = first_of(e->nother, cls); i < last_of(e->nother, cls); i++) {
        struct part_of *p = &e->other[i];
        p->kind->slopes(e, s, p, K, C, x);
    }
    row_clear(&e->row);
    row_clear(&e->column);
}

void elements_slopes_reduced(struct elements *e, struct sweep *s, double *K, double *C, const struct instant *x,
                             enum rate cls, const struct reduction *to)
{
    e->to = to;
    elements_slopes(e, s, K, C, x, cls);
    e->to = NULL;
}

bool elements_are_none(const struct elements *e)
{
    return e->nplain[ALL] == 0 && e->nother[ALL] == 0;
}

bool elements_are_diagonal(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (!e->other[i].diagonal) return false;
    return true;
}

void elements_diagonal(struct elements *e, double *d, double cc, double ck, const struct instant *x)
{
    for (int i = 0; i < e->nplain[ALL]; i++) d[e->plain[i].iv] += cc * e->plain[i].c + ck * e->plain[i].k;
    for (int i = 0; i < e->nother[ALL]; i++) {
        struct part_of *p = &e->other[i];
        if (p->kind->diagonal) p->kind->diagonal(e, p, d, cc, ck, x);
    }
}
