/* matrix.c -- see matrix.h */
#include "engine/matrix.h"

#include "engine/motion.h"
#include "la/dense.h"

enum { LARGE = 1 << 17 }; /* numbers: a run may have no memory for these and for all else; less ends it as any other */

enum status matrix_need(double **A, int rows, int columns, struct arena *life, double t, struct trouble *why)
{
    if (*A) return OK;
    const bool large = (size_t)rows * (size_t)columns > LARGE;
    if (large && !arena_allows((size_t)rows * (size_t)columns, sizeof **A)) {
        (void)trouble_set(why, TROUBLE_MEMORY, -1, (double)rows * columns * (double)sizeof **A, t);
        return E_LIMIT;
    }
    *A = TAKE_MATRIX(life, double, rows, columns);
    return OK;
}

void matrix_open(struct matrix *m, const struct ode2 *ode, struct effort *effort, struct arena *life)
{
    int n = ode->n;
    *m = (struct matrix){.ode = ode, .effort = effort, .life = life};
    m->swap = TAKE(life, int, n);
    m->live = TAKE(life, struct live, n);
    m->structured = ode->direct && n >= ode->direct->least && ode->direct->factor && ode->direct->solve;
    if (m->structured) m->F = arena_take(life, 1, ode->direct->factor_size);
    double **dense[] = {&m->J, &m->K, &m->C, &m->spare};
    const bool now = !m->structured && (size_t)n * (size_t)n <= LARGE; /* else with the first factor: need_dense() */
    for (int i = 0; i < 4 && now; i++) *dense[i] = TAKE_MATRIX(life, double, n, n);
}

static enum status need_dense(struct matrix *m, double t, struct trouble *why)
{
    double **dense[] = {&m->J, &m->K, &m->C, &m->spare};
    for (int i = 0; i < 4; i++) TRY(matrix_need(dense[i], m->ode->n, m->ode->n, m->life, t, why));
    return OK;
}

int factor_dense(double *J, int *swap, double *spare, enum matrix_form *form, int n)
{
    copy(spare, J, n * n);
    if (dense_asymmetry(J, n, n) <= 1e-12) {
        *form = MATRIX_CHOLESKY;
        if (dense_cholesky(J, n, n) < 0) return -1;
        copy(J, spare, n * n); /* a negative slope: the matrix may still be regular */
    }
    *form = MATRIX_LU;
    return dense_lu(J, swap, n, n);
}

void solve_dense(const double *J, const int *swap, enum matrix_form form, double *x, int n)
{
    if (form == MATRIX_CHOLESKY)
        dense_cholesky_solve(J, x, n, n);
    else
        dense_lu_solve(J, swap, x, n, n);
}

/* Which columns of K and C are not zero, and where. */
static void find_live(struct matrix *m)
{
    int n = m->ode->n;
    m->nlive = 0;
    for (int j = 0; j < n; j++) {
        const double *K = m->K + j * n, *C = m->C + j * n;
        int from = 0, to = n;
        while (from < n && K[from] == 0 && C[from] == 0) from++;
        while (to > from && K[to - 1] == 0 && C[to - 1] == 0) to--;
        if (from < to) m->live[m->nlive++] = (struct live){j, from, to};
    }
}

static enum status factor_full(struct matrix *m, double cc, double ck, const struct instant *x, struct trouble *why)
{
    const struct ode2 *o = m->ode;
    int n = o->n;
    TRY(need_dense(m, x->t, why));
    TRY(o->ops->slopes(o, m->K, m->C, x, ALL, why));
    if (o->ops->turning) TRY(o->ops->turning(o, m->K, m->C, x, ALL, why));
    TRY(o->ops->mass(o, m->J, x->q, x->t, ALL, why));
    m->effort->slow++;
    m->effort->fast++;
    find_live(m);
    for (int i = 0; i < n * n; i++) m->J[i] += cc * m->C[i] + ck * m->K[i];
    int pivot = factor_dense(m->J, m->swap, m->spare, &m->form, n);
    return pivot < 0 ? OK : trouble_set(why, TROUBLE_SINGULAR, pivot, 0, x->t);
}

enum status matrix_factor(struct matrix *m, double cc, double ck, const struct instant *x, struct trouble *why)
{
    m->effort->factors++;
    m->nlive = 0;
    if (m->structured) {
        m->form = MATRIX_DIRECT;
        if (m->ode->direct->factor(m->ode, m->F, 1, cc, ck, x, why) == OK) return OK;
        m->structured = 0;
    }
    return factor_full(m, cc, ck, x, why);
}

void matrix_solve(const struct matrix *m, double *x)
{
    if (m->form == MATRIX_DIRECT)
        m->ode->direct->solve(m->ode, m->F, x);
    else
        solve_dense(m->J, m->swap, m->form, x, m->ode->n);
}

/* Of what is symmetric the lower half: column j of it is the first of what is left without those before. */
void matrix_inverse(const struct matrix *m, double *B, int ld)
{
    const int n = m->ode->n;
    zero(B, ld * n);
    for (int j = 0; j < n; j++) {
        double *x = B + j * (ld + 1);
        x[0] = 1;
        if (m->form != MATRIX_CHOLESKY) {
            matrix_solve(m, x - j);
            continue;
        }
        dense_cholesky_solve(m->J + j * (n + 1), x, n - j, n);
        for (int i = 1; i < n - j; i++) x[i * ld] = x[i];
    }
}

void matrix_push(const struct matrix *m, double *x, double h, const double *v, const double *a)
{
    int n = m->ode->n;
    zero(x, n);
    for (int k = 0; k < m->nlive; k++) {
        const struct live *l = &m->live[k];
        const double *K = m->K + l->column * n, *C = m->C + l->column * n;
        const double sv = h * v[l->column], sa = h * a[l->column];
        for (int i = l->from; i < l->to; i++) x[i] += sv * K[i] + sa * C[i];
    }
}

void form_recall(enum matrix_form *form, struct recall *r)
{
    int word = (int)*form;
    recall_one(r, "form", word);
    *form = (enum matrix_form)word;
}

static enum status dense_recall(struct matrix *m, struct recall *r)
{
    const int n = m->ode->n;
    TRY(need_dense(m, 0, NULL));
    recall_list(r, "J", m->J, n * n);
    recall_list(r, "K", m->K, n * n);
    recall_list(r, "C", m->C, n * n);
    recall_list(r, "swap", m->swap, n);
    recall_one(r, "nlive", m->nlive);
    recall_each(r, "column", m->live, column, n);
    recall_each(r, "from", m->live, from, n);
    recall_each(r, "to", m->live, to, n);
    return OK;
}

enum status matrix_recall(struct matrix *m, struct recall *r)
{
    enum status status = OK;
    recall_within(r, "matrix");
    form_recall(&m->form, r);
    recall_one(r, "structured", m->structured);
    if (m->form == MATRIX_DIRECT)
        recall_list(r, "factor", (double *)m->F, m->ode->direct->factor_size / sizeof(double));
    else if (m->form != MATRIX_NONE)
        status = dense_recall(m, r);
    recall_without(r);
    return status;
}
