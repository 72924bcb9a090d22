/* decouple.c -- see decouple.h */
#include "multirate/decouple.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/matrix.h"
#include "engine/motion.h"
#include "la/dense.h"

/* Limbs without fast coordinates share no inertia with these: their part of M_LL serves the iteration alone.  Where they hold
 * most of the bodies it is kept until a slow coordinate has moved by FAR of a usual change, or by SHORTER of the way after which a
 * step asked for new matrices, or took a third sweep for one of theirs, if that was beyond NEAR or sweeps left more than SLOWLY
 * of their corrections; each step it may be LONGER.  (tests/bench/arms takes as many sweeps with up to .17 as with a new one in
 * each step; a chain of forty links that falls, a third one from .02 on.) */
static const double FEW_OF_ALL = 1. / 3, FAR = .04, NEAR = .0025, LEAST = 1e-5, SHORTER = .75, LONGER = 1.05;
static const double SLOWLY = .03;

enum { SMALL = 12 };                   /* coordinates up to which full matrices are no slower than structured ones */
enum { FORMED = 12, WITH_ZEROS = 64 }; /* M_f is formed for so many coordinates of fast bodies, of so many in all */

/* Is mass(FAST) less work than what it stands for: an evaluation, and one for each column or row? */
static bool is_formed(const struct decouple *p, const struct ode2_direct *direct)
{
    const int columns = p->ns < p->ml ? p->ns : p->ml;
    return direct || (p->ode->price > 0 && p->ode->price < 1 + columns);
}

void decouple_open(struct decouple *p, const struct ode2 *ode, struct effort *effort, struct arena *life)
{
    const struct ode2_direct *direct = ode->direct;
    int n = ode->n, ns = ode->ns, nl = n - ns;
    *p = (struct decouple){.ode = ode, .effort = effort, .life = life, .n = n, .ns = ns, .nl = nl};
    p->ml = ode->near > 0 ? ode->near - ns : nl;
    p->structured = n > SMALL && direct && direct->stiffen && direct->solve;
    if (!p->structured) p->M = TAKE_MATRIX(life, double, n, n);
    if (!p->structured) p->L = TAKE_MATRIX(life, double, nl, nl);
    p->W = TAKE_MATRIX(life, double, nl, ns);
    p->Mss = TAKE_MATRIX(life, double, ns, ns);
    p->MsW = TAKE_MATRIX(life, double, p->ml, ns);
    p->WMW = TAKE_MATRIX(life, double, ns, ns);
    p->Z = TAKE_MATRIX(life, double, ns, ns);
    p->row = TAKE(life, double, ns);
    p->none = TAKE(life, double, n);
    if (is_formed(p, direct) && ns + p->ml <= FORMED && n <= WITH_ZEROS) p->Mf = TAKE_MATRIX(life, double, n, n);
    p->z = TAKE(life, double, n);
    p->r = TAKE(life, double, n);
    p->a = TAKE(life, double, n);
    if (p->structured) p->F = arena_take(life, 1, direct->factor_size);
    p->limbs = p->structured ? direct->limbs : 1;
    p->far = FAR;
    if (p->limbs < FEW_OF_ALL) p->there = TAKE(life, double, ode->nq);
}

void decouple_dense(struct decouple *p)
{
    p->structured = 0;
    p->lags = false;
}

/* C [ns x ns] += s A' B; for two fast coordinates in one pass. */
static void gram(double *C, double s, const double *A, const double *B, int inner, int ns, int lda, int ldb)
{
    if (ns != 2) {
        dense_gemtm(C, s, A, B, ns, inner, ns, ns, lda, ldb);
        return;
    }
    double sum[4] = {0, 0, 0, 0};
    for (int i = 0; i < inner; i++) {
        sum[0] += A[i] * B[i];
        sum[1] += A[i + lda] * B[i];
        sum[2] += A[i] * B[i + ldb];
        sum[3] += A[i + lda] * B[i + ldb];
    }
    for (int i = 0; i < 4; i++) C[i] += s * sum[i];
}

static int last_row(const double *W, int nl, int ns)
{
    int reach = 0;
    for (int j = 0; j < ns; j++)
        for (int i = nl; i > reach; i--)
            if (W[i - 1 + (long)j * nl] != 0) reach = i;
    return reach;
}

/* Mss := Z^-1, Z [ns x ns] lost. */
static int invert(struct decouple *p)
{
    int ns = p->ns;
    int pivot = dense_cholesky(p->Z, ns, ns);
    if (pivot >= 0) return pivot;
    zero(p->Mss, ns * ns);
    for (int i = 0; i < ns; i++) p->Mss[i * (ns + 1)] = 1;
    dense_cholesky_solves(p->Z, p->Mss, ns, ns, ns, ns);
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < j; i++) p->Mss[j + i * ns] = p->Mss[i + j * ns];
    return -1;
}

/* How far the slow coordinates have moved since all limbs were factored, in usual changes. */
static double moved(const struct decouple *p, const double *q)
{
    double most = 0;
    motion_diff(p->ode, p->z, q, p->there);
    for (int i = p->ns; i < p->n; i++) most = larger(most, fabs(p->z[i]) / ode2_usual(p->ode, i));
    return most;
}

static enum status factor(struct decouple *p, const struct instant *x, enum others others, struct trouble *why)
{
    const bool left = p->there && others == LEFT;
    if (!left) {
        p->moved = p->there && others == WHERE_FAR ? moved(p, x->q) : INFINITY;
        p->lags = p->moved <= p->far;
    }
    const bool whole = !left && !p->lags;
    p->effort->slow += whole;
    TRY(p->ode->direct->stiffen(p->ode, p->F, p->none, x->q, x->t, whole ? ALL : LIMBS, why));
    if (p->there && whole) copy(p->there, x->q, p->ode->nq);
    return OK;
}

void decouple_failed(struct decouple *p)
{
    if (p->lags) p->far = larger(LEAST, SHORTER * p->moved);
}

void decouple_solved(struct decouple *p, int count, int worst, double rate)
{
    const bool slower = count > 2 && worst >= p->ns + p->ml && (p->moved > NEAR || rate > SLOWLY);
    if (p->lags && slower)
        decouple_failed(p);
    else
        p->far = smaller(FAR, LONGER * p->far);
}

static enum status by_structure(struct decouple *p, const struct instant *x, enum others others, struct trouble *why)
{
    const struct ode2_direct *direct = p->ode->direct;
    int ns = p->ns, nl = p->nl;
    TRY(factor(p, x, others, why));
    for (int j = 0; j < ns; j++) {
        zero(p->z, p->n);
        p->z[j] = 1;
        direct->solve(p->ode, p->F, p->z);
        copy(p->Z + j * ns, p->z, ns);
        copy(p->W + (long)j * nl, p->z + ns, nl);
    }
    int pivot = invert(p);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, x->t);
    p->reach = last_row(p->W, nl, ns);
    for (int i = 0; i < p->reach; i++) { /* W = -Z_LS Mss by rows */
        for (int j = 0; j < ns; j++) p->row[j] = -p->W[i + (long)j * nl];
        for (int j = 0; j < ns; j++) p->W[i + (long)j * nl] = dot(p->row, p->Mss + j * ns, ns);
    }
    return OK;
}

/* M^; where M_f is wanted, too, as the sum of M_s and M_f, which is no more work. */
static enum status form_mass(struct decouple *p, const struct instant *x, struct trouble *why)
{
    const int n = p->n, near = p->ns + p->ml;
    const struct ode2 *o = p->ode;
    if (!p->Mf) return o->ops->mass(o, p->M, x->q, x->t, ALL, why);
    TRY(o->ops->mass(o, p->M, x->q, x->t, SLOW, why));
    TRY(o->ops->mass(o, p->Mf, x->q, x->t, FAST, why));
    for (int j = 0; j < near; j++)
        for (int i = 0; i < near; i++) p->M[i + (long)j * n] += p->Mf[i + (long)j * n];
    return OK;
}

static enum status by_matrix(struct decouple *p, const struct instant *x, struct trouble *why)
{
    int n = p->n, ns = p->ns, nl = p->nl;
    TRY(matrix_need(&p->M, n, n, p->life, x->t, why));
    TRY(matrix_need(&p->L, nl, nl, p->life, x->t, why));
    TRY(form_mass(p, x, why));
    dense_copy(p->Mss, p->M, ns, ns, ns, n);
    dense_copy(p->W, p->M + ns, nl, ns, nl, n);
    p->reach = last_row(p->W, nl, ns);
    if (!p->reach) return OK;
    dense_copy(p->L, p->M + ns + ns * n, nl, nl, nl, n);
    int pivot = dense_cholesky(p->L, nl, nl);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, ns + pivot, 0, x->t);
    dense_cholesky_solves(p->L, p->W, nl, nl, ns, nl);
    gram(p->Mss, -1, p->M + ns, p->W, nl, ns, n, nl);
    p->reach = last_row(p->W, nl, ns);
    return OK;
}

/* A power of two by which accelerations are scaled, so that inertial forces are not lost in the round-off of the
 * forces r that they are told from by a difference. */
static double as_large(const struct decouple *p, const double *r, int m)
{
    double force = 0, mass = INFINITY;
    for (int i = 0; i < m; i++) force = fmax(force, fabs(r[i]));
    for (int i = 0; i < p->ns; i++) mass = fmin(mass, p->Mss[i * (p->ns + 1)]);
    return force > mass && force / mass < 0x1p900 ? ldexp(1, ilogb(force / mass) + 1) : 1;
}

/* p->z := M_f p->a, as the rows of the fast bodies at the acceleration s p->a less p->r, over s. */
static enum status inertia(struct decouple *p, struct instant *with, double s, struct trouble *why)
{
    p->effort->fast++;
    with->a = p->a;
    TRY(p->ode->ops->resid(p->ode, p->z, NULL, NULL, with, FAST, why));
    for (int i = 0; i < p->ns + p->ml; i++) p->z[i] = (p->z[i] - p->r[i]) / s;
    return OK;
}

/* MsW = (M_f P_S)_L by its columns: one evaluation for each fast coordinate. */
static enum status by_columns(struct decouple *p, struct instant *with, double s, int rows, struct trouble *why)
{
    int ns = p->ns, ml = p->ml;
    for (int j = 0; j < ns; j++) {
        zero(p->a, ns + ml);
        p->a[j] = s;
        for (int i = 0; i < rows; i++) p->a[ns + i] = -s * p->W[i + (long)j * p->nl];
        TRY(inertia(p, with, s, why));
        copy(p->MsW + j * ml, p->z + ns, ml);
    }
    return OK;
}

/* The same by its rows, M_LS - M_LL W of the fast bodies, since M_f is symmetric: one evaluation for each slow
 * coordinate. */
static enum status by_rows(struct decouple *p, struct instant *with, double s, int rows, struct trouble *why)
{
    int ns = p->ns, ml = p->ml;
    for (int i = 0; i < ml; i++) {
        zero(p->a, ns + ml);
        p->a[ns + i] = s;
        TRY(inertia(p, with, s, why));
        for (int j = 0; j < ns; j++) p->MsW[i + j * ml] = p->z[j] - dot(p->z + ns, p->W + (long)j * p->nl, rows);
    }
    return OK;
}

/* The same from M_f itself, which a tree forms in one pass: for few coordinates. */
static enum status by_fast_mass(struct decouple *p, const struct instant *x, int rows, struct trouble *why)
{
    const int n = p->n, ns = p->ns, ml = p->ml;
    if (p->structured) {
        p->effort->fast++;
        TRY(p->ode->ops->mass(p->ode, p->Mf, x->q, x->t, FAST, why));
    }
    dense_copy(p->MsW, p->Mf + ns, ml, ns, ml, n);
    dense_gemm(p->MsW, -1, p->Mf + ns + (long)ns * n, p->W, ml, rows, ns, ml, n, p->nl);
    return OK;
}

/* The same from M_s, M_LL W - M_LS: where fast bodies hang on all slow ones these are fewer than what moves with the fast
 * ones. */
static enum status by_slow_mass(struct decouple *p, const struct instant *x, int rows, struct trouble *why)
{
    const int n = p->n, ns = p->ns, ml = p->ml;
    const double *M = p->Mf;
    p->effort->slow++;
    TRY(p->ode->ops->mass(p->ode, p->Mf, x->q, x->t, SLOW, why));
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ml; i++) p->MsW[i + j * ml] = -M[ns + i + (long)j * n];
    dense_gemm(p->MsW, 1, M + ns + (long)ns * n, p->W, ml, rows, ns, ml, n, p->nl);
    return OK;
}

static enum status by_mass(struct decouple *p, const struct instant *x, int rows, struct trouble *why)
{
    return p->structured && p->ml == p->nl ? by_slow_mass(p, x, rows, why) : by_fast_mass(p, x, rows, why);
}

/* MsW by columns or rows, whichever takes fewer evaluations. */
static enum status by_evaluations(struct decouple *p, const struct instant *x, int rows, struct trouble *why)
{
    struct instant with = *x;
    with.a = NULL;
    p->effort->fast++;
    TRY(p->ode->ops->resid(p->ode, p->r, NULL, NULL, &with, FAST, why));
    const double s = as_large(p, p->r, p->ns + p->ml);
    return p->ns <= p->ml ? by_columns(p, &with, s, rows, why) : by_rows(p, &with, s, rows, why);
}

/* MsW and W' M_s W from the fast bodies. */
static enum status slow_share(struct decouple *p, const struct instant *x, struct trouble *why)
{
    int ns = p->ns, ml = p->ml, rows = p->reach < ml ? p->reach : ml;
    TRY(p->Mf ? by_mass(p, x, rows, why) : by_evaluations(p, x, rows, why));
    zero(p->WMW, ns * ns);
    gram(p->WMW, 1, p->W, p->MsW, rows, ns, p->nl, ml);
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < j; i++)
            p->WMW[i + j * ns] = p->WMW[j + i * ns] = (p->WMW[i + j * ns] + p->WMW[j + i * ns]) / 2;
    return OK;
}

void decouple_recall(struct decouple *p, struct recall *r)
{
    if (!p->structured || !p->there) return;
    recall_within(r, "limbs");
    recall_list(r, "there", p->there, p->ode->nq);
    recall_one(r, "far", p->far);
    recall_list(r, "factor", (double *)p->F, p->ode->direct->factor_size / sizeof(double));
    recall_without(r);
}

enum status decouple_at(struct decouple *p, const struct instant *x, enum others others, struct trouble *why)
{
    p->effort->fast++;
    if (p->structured && by_structure(p, x, others, why) != OK) decouple_dense(p);
    p->effort->slow += !p->structured;
    if (!p->structured) TRY(by_matrix(p, x, why));
    return p->reach ? slow_share(p, x, why) : OK;
}
