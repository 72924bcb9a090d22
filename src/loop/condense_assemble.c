/* condense_assemble.c -- a start that does not fit, made to fit by the least change in the mass metric.
 *
 * Positions first: the step that is least in dq' M dq and takes the linearised equations to zero,
 *
 *     dq = -M^-1 C_q' (C_q M^-1 C_q')^-1 C,
 *
 * again and again until C(q, 0) = 0; then velocities, once, for they enter linearly:
 *
 *     v := v - M^-1 C_q' (C_q M^-1 C_q')^-1 (C_q v + C_t)
 *
 * (mass-orthogonal projections: Bayo & Ledesma, Nonlinear Dynamics 9 (1996) 113).  Redundant rows are left to those
 * that say the same.  Where M is singular, a little is put on its diagonal. */
#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/pivot.h"
#include "loop/condense_parts.h"

struct projection {
    double *M;      /* [nt x nt] factored */
    double *Cq;     /* [rows x nt] by row */
    double *Y;      /* [nt x rows] M^-1 C_q' */
    double *S;      /* [rows x rows] C_q M^-1 C_q', factored with full pivoting */
    int *row, *col; /* [rows] */
    int rank;
    double *x, *work; /* [rows] */
    double *dx;       /* [nt] */
};

static struct projection make(const struct condense *o, struct arena *life)
{
    const int n = o->rows.n, rows = o->rows.loops->nrow;
    return (struct projection){.M = TAKE_MATRIX(life, double, n, n),
                               .Cq = TAKE_MATRIX(life, double, rows, n),
                               .Y = TAKE_MATRIX(life, double, n, rows),
                               .S = TAKE_MATRIX(life, double, rows, rows),
                               .row = TAKE(life, int, rows),
                               .col = TAKE(life, int, rows),
                               .x = TAKE(life, double, rows),
                               .work = TAKE(life, double, rows),
                               .dx = TAKE(life, double, n)};
}

/* M at q, factored; where something moves no mass, with 1e-9 of its largest number, in scales, on the diagonal. */
static enum status mass(struct projection *p, struct condense *o, const double *q, struct trouble *why)
{
    static const double LITTLE = 1e-9;
    const int n = o->rows.n;
    double most = 0;
    TRY(o->tree->ode.ops->mass(&o->tree->ode, p->M, q, 0, ALL, why));
    if (dense_cholesky(p->M, n, n) < 0) return OK;
    TRY(o->tree->ode.ops->mass(&o->tree->ode, p->M, q, 0, ALL, why));
    for (int i = 0; i < n; i++) most = fmax(most, p->M[i + i * n] * o->rows.size[i] * o->rows.size[i]);
    for (int i = 0; i < n; i++) p->M[i + i * n] += LITTLE * most / (o->rows.size[i] * o->rows.size[i]);
    return dense_cholesky(p->M, n, n) < 0 ? OK : trouble_set(why, TROUBLE_MASS, 0, 0, 0);
}

/* Everything at q; its values C go to o->C. */
static enum status prepare(struct projection *p, struct condense *o, const double *q, struct trouble *why)
{
    static const double NOTHING = 1e-10;
    const struct loops *l = o->rows.loops;
    const int n = o->rows.n, rows = l->nrow;
    TRY(mass(p, o, q, why));
    rows_linearize(&o->rows, q);
    rows_values(o->C, &o->rows);
    memset(p->Cq, 0, sizeof *p->Cq * (size_t)(rows * n));
    for (int r = 0; r < rows; r++) {
        const int loop = l->row[r].loop, nk = l->nk[loop];
        for (int k = 0; k < nk; k++) p->Cq[r * n + l->k[loop][k]] = l->Cq[loop][(r - l->first[loop]) * nk + k];
    }
    memcpy(p->Y, p->Cq, sizeof *p->Y * (size_t)(rows * n)); /* C_q by row is C_q' by column */
    dense_cholesky_solves(p->M, p->Y, n, n, rows, n);
    memset(p->S, 0, sizeof *p->S * (size_t)(rows * rows));
    dense_gemtm(p->S, 1, p->Cq, p->Y, rows, n, rows, rows, n, n);
    p->rank = pivot_lu(p->S, p->row, p->col, rows, rows, rows, NULL, rows, NOTHING);
    return OK;
}

/* p->dx := -M^-1 C_q' (C_q M^-1 C_q')^-1 p->x */
static void project(struct projection *p, const struct condense *o)
{
    const int n = o->rows.n, rows = o->rows.loops->nrow;
    pivot_solve(p->S, p->row, p->col, p->x, p->work, p->rank, rows);
    for (int k = p->rank; k < rows; k++) p->x[p->col[k]] = 0;
    memset(p->dx, 0, sizeof *p->dx * (size_t)n);
    dense_gemv(p->dx, -1, p->Y, p->x, n, rows, n);
}

/* The part of p->dx in which no screw turns by half a turn. */
static double within_a_turn(const struct projection *p, const struct condense *o)
{
    static const double LITTLE = 1;
    double most = LITTLE;
    for (int i = 0; i < o->rows.n; i++) most = fmax(most, fabs(p->dx[i]) * o->rows.per[i]);
    return LITTLE / most;
}

/* Steps on o->q until nothing more is won; each is halved while it makes things worse. */
static enum status close_positions(struct projection *p, struct condense *o, struct trouble *why)
{
    enum { STEPS = 100, HALVINGS = 12 };
    static const double CLOSED = 1e-13;
    const size_t bytes = sizeof *o->q * (size_t)o->model->nq;
    const bool screws = loops_have_screws(o->rows.loops);
    int row = 0;
    double miss = o->start.misfit;
    for (int i = 0; i < STEPS && miss > CLOSED; i++) {
        double next = INFINITY;
        TRY(prepare(p, o, o->q, why));
        memcpy(p->x, o->C, sizeof *p->x * (size_t)o->rows.loops->nrow);
        project(p, o);
        double s = screws ? within_a_turn(p, o) : 1;
        for (int k = 0; k < HALVINGS && !(next < miss); k++, s /= 2) {
            moves_point(&o->tree->moves, o->qtry, o->q, p->dx, s);
            next = rows_misfit(o->C, &row, &o->rows, o->qtry);
        }
        if (!(next < miss)) break;
        memcpy(o->q, o->qtry, bytes);
        miss = next;
        if (screws) loops_count_turns(o->rows.loops, COUNT_ON);
    }
    return OK;
}

/* v [nt] becomes one that the equations at o->q allow. */
static enum status close_rates(struct projection *p, struct condense *o, double *v, struct trouble *why)
{
    const int n = o->rows.n, rows = o->rows.loops->nrow;
    TRY(prepare(p, o, o->q, why));
    for (int r = 0; r < rows; r++) p->x[r] = -o->rows.loops->c1[r];
    dense_gemtv(p->x, 1, p->Cq, v, n, rows, n);
    project(p, o);
    for (int i = 0; i < n; i++) v[i] += p->dx[i];
    return OK;
}

static void note(double *most, int *at, const double *dx, int n)
{
    for (int i = 0; i < n; i++)
        if (fabs(dx[i]) > fabs(*most)) *most = dx[i], *at = i;
}

enum status condense_assemble(struct condense *o, double *v, const double *q0, const double *v0)
{
    static const double FITS = 1e-9;
    struct condense_start *s = &o->start;
    struct trouble why;
    struct arena *scratch = arena_open();
    struct projection p = make(o, scratch);
    int row = 0;
    loops_when(o->rows.loops, o->model->t0, 0);
    memcpy(o->q, q0, sizeof *q0 * (size_t)o->model->nq);
    memcpy(v, v0, sizeof *v * (size_t)o->rows.n);
    condense_count_turns(o, o->q);
    s->misfit = rows_misfit(o->C, &s->misfit_row, &o->rows, o->q);
    enum status status = close_positions(&p, o, &why);
    if (status == OK) status = close_rates(&p, o, v, &why);
    if (status == OK) {
        moves_diff(&o->tree->moves, p.dx, o->q, q0);
        note(&s->moved, &s->moved_at, p.dx, o->rows.n);
        for (int i = 0; i < o->rows.n; i++) p.dx[i] = v[i] - v0[i];
        note(&s->changed, &s->changed_at, p.dx, o->rows.n);
    }
    arena_close(scratch);
    const double left = rows_misfit(o->C, &row, &o->rows, o->q);
    loops_count_turns(o->rows.loops, COUNT_NEVER);
    if (status == OK && left <= FITS) return OK;
    s->blamed = o->rows.loops->row[row].loop;
    return fail(
        &s->report, E_MODEL,
        "the mechanism cannot be assembled from here: constraint '%s' still misses by %.3g of its size; draw it, or "
        "set 'initial', nearer to a posture in which it closes, and look whether its lengths can meet",
        o->model->loop[s->blamed].name, left);
}
