/* decouple_apply.c -- what P = [1; -W] and its like make of vectors of fast and slow rows, see decouple.h. */
#include "engine/matrix.h"
#include "engine/motion.h"
#include "la/dense.h"
#include "multirate/decouple.h"

void gemv_from_many(double *y, const double *x, double s, const double *A, const double *e, int rows, int cols, int ld)
{
    copy(y, x, rows);
    gemv_few(y, s, A, e, rows, cols, ld);
}

void decouple_recoil(const struct decouple *p, double *y, double s, const double *x)
{
    if (p->reach) gemv_few(y, s, p->W, x, p->reach, p->ns, p->nl);
}

void decouple_both(const struct decouple *p, double *restrict v, double *restrict a, const double *restrict y,
                   const double *restrict b, int m)
{
    const int ns = p->ns, rows = p->reach < m ? p->reach : m;
    const double *restrict W = p->W, v0 = v[0], a0 = a[0];
    double *restrict vl = v + ns, *restrict al = a + ns;
    for (int i = 0; i < rows; i++) {
        vl[i] = y[i] - W[i] * v0;
        al[i] = b[i] - W[i] * a0;
    }
    for (int j = 1; j < ns; j++) {
        const double vj = v[j], aj = a[j];
        W += p->nl;
        for (int i = 0; i < rows; i++) {
            vl[i] -= W[i] * vj;
            al[i] -= W[i] * aj;
        }
    }
    for (int i = rows; i < m; i++) {
        vl[i] = y[i];
        al[i] = b[i];
    }
}

/* Slow row i of P (y, v), its y given, for one, two or three fast coordinates. */
INTO static inline double few_row(const struct decouple *p, double y, const double *v, int i, int few)
{
    const double *W = p->W + i;
    double x = y - W[0] * v[0];
    if (few > 1) x -= W[p->nl] * v[1];
    if (few > 2) x -= W[2 * p->nl] * v[2];
    return x;
}

/* Slow rows of P (y, x) for one or two fast coordinates, or for many. */
INTO static inline void few_out(const struct decouple *p, double *restrict slow, const double *restrict y,
                                const double *x, int rows, int few)
{
    const double v[2] = {x[0], few > 1 ? x[1] : 0};
    for (int i = 0; i < rows; i++) slow[i] = few_row(p, y[i], v, i, few);
}

APART void many_out(const struct decouple *p, double *restrict slow, const double *restrict y, const double *x,
                    int rows)
{
    for (int i = 0; i < rows; i++) slow[i] = y[i];
    for (int j = 0; j < p->ns; j++) {
        const double *restrict W = p->W + (long)j * p->nl, xj = x[j];
        for (int i = 0; i < rows; i++) slow[i] -= W[i] * xj;
    }
}

void decouple_out(const struct decouple *p, double *out, const double *y, const double *x, int m)
{
    int ns = p->ns, rows = p->reach < m ? p->reach : m;
    double *slow = out + ns;
    if (out != x) copy(out, x, ns);
    if (ns == 1)
        few_out(p, slow, y, out, rows, 1);
    else if (ns == 2)
        few_out(p, slow, y, out, rows, 2);
    else
        many_out(p, slow, y, out, rows);
    if (rows < m) copy(slow + rows, y + rows, m - rows);
}

/* decouple_there() down to the slow row `rows`; u, w, d: the fast rows, which are asked for again and again. */
INTO static inline void few_rows(const struct decouple *p, double *restrict v, double *restrict a, double *restrict q1,
                                 const double *restrict q0, const double *restrict x, const double *restrict y,
                                 const double *restrict b, double s, int rows, int few)
{
    double u[3], w[3], d[3];
    for (int j = 0; j < few; j++) {
        u[j] = v[j], w[j] = a[j], d[j] = x[j];
        q1[j] = q0[j] + x[j];
    }
    v += few, a += few, q1 += few, q0 += few;
    for (int i = 0; i < rows; i++) {
        a[i] = few_row(p, b[i], w, i, few);
        v[i] = few_row(p, y[i], u, i, few);
        q1[i] = q0[i] + few_row(p, s * y[i], d, i, few);
    }
}

INTO static inline void few_there(const struct decouple *p, const struct decouple_there *o, int rows, int few)
{
    few_rows(p, o->v, o->a, o->q1, o->q0, o->x, o->y, o->b, o->s, rows, few);
}

/* One by one, as each needs registers for so many columns of W only. */
APART void one_there(const struct decouple *p, const struct decouple_there *o, int rows)
{
    few_there(p, o, rows, 1);
}

APART void two_there(const struct decouple *p, const struct decouple_there *o, int rows)
{
    few_there(p, o, rows, 2);
}

APART void three_there(const struct decouple *p, const struct decouple_there *o, int rows)
{
    few_there(p, o, rows, 3);
}

APART void many_there(const struct decouple *p, const struct decouple_there *o, int rows)
{
    const int ns = p->ns;
    double *restrict q1 = o->q1 + ns;
    decouple_both(p, o->v, o->a, o->y, o->b, rows);
    for (int i = 0; i < rows; i++) q1[i] = o->s * o->y[i];
    for (int j = 0; j < ns; j++) {
        const double *restrict W = p->W + (long)j * p->nl, x = o->x[j];
        for (int i = 0; i < rows; i++) q1[i] -= W[i] * x;
        o->q1[j] = o->q0[j] + x;
    }
    for (int i = 0; i < rows; i++) q1[i] += o->q0[ns + i];
}

/* Slow rows that P leaves alone. */
APART void rest_there(const struct decouple *p, const struct decouple_there *o, int rows, int m)
{
    double *v = o->v + p->ns, *a = o->a + p->ns, *q1 = o->q1 + p->ns;
    const double *q0 = o->q0 + p->ns;
    for (int i = rows; i < m; i++) {
        v[i] = o->y[i];
        a[i] = o->b[i];
        q1[i] = q0[i] + o->s * o->y[i];
    }
}

void decouple_there(const struct decouple *p, const struct decouple_there *o, int m)
{
    const int ns = p->ns, rows = p->reach < m ? p->reach : m;
    if (rows < m) rest_there(p, o, rows, m);
    if (ns == 1)
        one_there(p, o, rows);
    else if (ns == 2)
        two_there(p, o, rows);
    else if (ns == 3)
        three_there(p, o, rows);
    else
        many_there(p, o, rows);
}

void decouple_on(const struct decouple *p, double *restrict q, double s, const double *restrict y,
                 const double *restrict v, int m)
{
    const int ns = p->ns, rows = p->reach < m ? p->reach : m;
    double *restrict slow = q + ns;
    for (int i = 0; i < ns; i++) q[i] += s * v[i];
    if (ns == 1)
        for (int i = 0; i < rows; i++) slow[i] += s * few_row(p, y[i], v, i, 1);
    else if (ns == 2)
        for (int i = 0; i < rows; i++) slow[i] += s * few_row(p, y[i], v, i, 2);
    else if (ns == 3)
        for (int i = 0; i < rows; i++) slow[i] += s * few_row(p, y[i], v, i, 3);
    else
        for (int i = 0; i < rows; i++) {
            double x = y[i];
            for (int j = 0; j < ns; j++) x -= p->W[i + (long)j * p->nl] * v[j];
            slow[i] += s * x;
        }
    for (int i = rows; i < m; i++) slow[i] += s * y[i];
}

/* The fast rows of P' r for two or three fast coordinates in one pass, to the same bits as one by one. */
INTO static inline void few_fast(const struct decouple *p, double *restrict rs, const double *restrict r, int rows,
                                 int few)
{
    const double *restrict W = p->W, *restrict slow = r + few;
    double sum[3] = {0, 0, 0};
    for (int i = 0; i < rows; i++) {
        sum[0] += W[i] * slow[i];
        sum[1] += W[i + p->nl] * slow[i];
        if (few > 2) sum[2] += W[i + 2 * p->nl] * slow[i];
    }
    for (int j = 0; j < few; j++) rs[j] = r[j] - sum[j];
}

void decouple_fast(const struct decouple *p, double *rs, const double *r, int m)
{
    int ns = p->ns, rows = p->reach < m ? p->reach : m;
    if (ns == 2) {
        few_fast(p, rs, r, rows, 2);
        return;
    }
    if (ns == 3) {
        few_fast(p, rs, r, rows, 3);
        return;
    }
    for (int j = 0; j < ns; j++) {
        const double *W = p->W + (long)j * p->nl;
        double sum = 0;
        for (int i = 0; i < rows; i++) sum += W[i] * r[ns + i];
        rs[j] = r[j] - sum;
    }
}

void decouple_slopes(const struct decouple *p, double *K, int m)
{
    int n = p->n, ns = p->ns, rows = p->reach < m ? p->reach : m;
    if (!rows) return;
    dense_gemm(K, -1, K + ns * n, p->W, ns + m, rows, ns, n, n, p->nl);
    dense_gemtm(K, -1, p->W, K + ns, ns, rows, ns + m, n, p->nl, n);
}

void decouple_slow(struct decouple *p, double *x)
{
    if (!p->structured) {
        dense_cholesky_solve(p->L, x, p->nl, p->nl);
        return;
    }
    zero(p->z, p->ns);
    copy(p->z + p->ns, x, p->nl);
    p->ode->direct->solve(p->ode, p->F, p->z);
    copy(x, p->z + p->ns, p->nl);
    decouple_recoil(p, x, 1, p->z);
}
