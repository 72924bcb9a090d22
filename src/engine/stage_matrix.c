/* stage_matrix.c -- see stage_matrix.h */
#include "engine/stage_matrix.h"

#include "engine/motion.h"
#include "la/complex.h"
#include "la/dense.h"

static enum status take_matrices(struct stage_matrix *o, struct arena *life)
{
    const int n = o->ode->n;
    double **real[] = {&o->M, &o->C, &o->K, &o->E, &o->spare};
    for (int i = 0; i < 5; i++) TRY(matrix_need(real[i], n, n, life, 0, &o->why));
    for (int k = 1; k < o->table->nmode; k++) {
        TRY(matrix_need(&o->re[k], n, n, life, 0, &o->why));
        TRY(matrix_need(&o->im[k], n, n, life, 0, &o->why));
    }
    return OK;
}

void stage_matrix_open(struct stage_matrix *o, const struct collocation *table, const struct ode2 *ode,
                       struct effort *effort, struct arena *life)
{
    *o = (struct stage_matrix){.table = table, .ode = ode, .effort = effort};
    for (int k = 0; k < table->nmode; k++) o->swap[k] = TAKE(life, int, ode->n);
    for (int i = 0; i < table->s; i++) o->da[i] = TAKE(life, double, ode->n);
    o->x = TAKE(life, double, ode->n);
    o->y = TAKE(life, double, ode->n);
    o->had = take_matrices(o, life);
}

enum status stage_matrix_form(struct stage_matrix *o, const struct instant *x, struct trouble *why)
{
    const struct ode2 *ode = o->ode;
    if (o->had != OK) *why = o->why;
    TRY(o->had);
    TRY(ode->ops->slopes(ode, o->K, o->C, x, ALL, why));
    if (ode->ops->turning) TRY(ode->ops->turning(ode, o->K, o->C, x, ALL, why));
    TRY(ode->ops->mass(ode, o->M, x->q, x->t, ALL, why));
    o->effort->slow++;
    o->effort->fast++;
    o->h = 0;
    return OK;
}

/* M + z C + z^2 K, z = h lambda, factored; -1, or the column without a pivot. */
static int factor_pair(struct stage_matrix *o, int k, double h)
{
    const int n = o->ode->n;
    const double re = h * o->table->mode[k].re, im = h * o->table->mode[k].im;
    const double re2 = re * re - im * im, im2 = 2 * re * im;
    for (int i = 0; i < n * n; i++) {
        o->re[k][i] = o->M[i] + re * o->C[i] + re2 * o->K[i];
        o->im[k][i] = im * o->C[i] + im2 * o->K[i];
    }
    return complex_lu(o->re[k], o->im[k], o->swap[k], n);
}

enum status stage_matrix_factor(struct stage_matrix *o, double h, double t, struct trouble *why)
{
    const int n = o->ode->n;
    const double g = h * o->table->mode[0].re;
    o->effort->factors++;
    for (int i = 0; i < n * n; i++) o->E[i] = o->M[i] + g * o->C[i] + g * g * o->K[i];
    int pivot = factor_dense(o->E, o->swap[0], o->spare, &o->form, n);
    for (int k = 1; k < o->table->nmode && pivot < 0; k++) pivot = factor_pair(o, k, h);
    if (pivot >= 0) return trouble_set(why, TROUBLE_SINGULAR, pivot, 0, t);
    o->h = h;
    return OK;
}

/* x + i y := -l . r, row k of T^-1. */
static void project(struct stage_matrix *o, const struct collocation_mode *mode, double *const *r)
{
    for (int j = 0; j < o->ode->n; j++) {
        double re = 0, im = 0;
        for (int i = 0; i < o->table->s; i++) re -= mode->lre[i] * r[i][j], im -= mode->lim[i] * r[i][j];
        o->x[j] = re;
        o->y[j] = im;
    }
}

void stage_matrix_solve(struct stage_matrix *o, double *const *r)
{
    const int n = o->ode->n, s = o->table->s;
    for (int i = 0; i < s; i++) zero(o->da[i], n);
    for (int k = 0; k < o->table->nmode; k++) {
        const struct collocation_mode *mode = &o->table->mode[k];
        project(o, mode, r);
        if (k == 0)
            solve_dense(o->E, o->swap[0], o->form, o->x, n);
        else
            complex_lu_solve(o->re[k], o->im[k], o->swap[k], o->x, o->y, n);
        for (int i = 0; i < s; i++)
            for (int j = 0; j < n; j++)
                o->da[i][j] += k == 0 ? mode->tre[i] * o->x[j] : 2 * (mode->tre[i] * o->x[j] - mode->tim[i] * o->y[j]);
    }
    for (int i = 0; i < s; i++) copy(r[i], o->da[i], n);
}

void stage_matrix_error(struct stage_matrix *o, double *e, const double *gu, const double *gv)
{
    const int n = o->ode->n;
    zero(e, n);
    dense_gemv(e, 1, o->M, gv, n, n, n);
    dense_gemv(e, -o->h * o->table->mode[0].re, o->K, gu, n, n, n);
    solve_dense(o->E, o->swap[0], o->form, e, n);
}

enum status stage_matrix_recall(struct stage_matrix *o, struct recall *r)
{
    const size_t n = (size_t)o->ode->n;
    TRY(o->had);
    recall_list(r, "M", o->M, n * n);
    recall_list(r, "C", o->C, n * n);
    recall_list(r, "K", o->K, n * n);
    return OK;
}
