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
 * that say the same.  Where M is singular, a little is put on its diagonal.
 *
 * What the deck gives is held, if it can be: rows dq_i = 0 go with C_q, small beside those of the loops, which full
 * pivoting takes before them.  Where not all of it fits in the end, the deck gives too much, and nothing is held: then all of
 * it is near. */
#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/pivot.h"
#include "loop/condense_parts.h"

static const double CLOSES = 1e-9; /* |C| that is a posture's */

struct projection {
    int n, rows; /* coordinates; loops' rows and those of what is held */
    int *held;   /* [n] places in v that the deck gives */
    int nheld;
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
    const int n = o->rows.n, rows = o->rows.loops->nrow + n;
    return (struct projection){.n = n,
                               .held = TAKE(life, int, n),
                               .M = TAKE_MATRIX(life, double, n, n),
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

/* Rows of what is held, and the same in Y; their pivots are to be LITTLE of the loops' largest. */
static void hold(struct projection *p, const struct loops *l)
{
    static const double LITTLE = 1e-4;
    double most = 0;
    for (int r = 0; r < l->nrow; r++) {
        double sum = 0;
        for (int k = 0; k < p->n; k++) sum += p->Cq[r * p->n + k] * p->Y[r * p->n + k];
        most = fmax(most, sum);
    }
    for (int i = 0; i < p->nheld; i++) {
        double *row = p->Cq + (l->nrow + i) * p->n, *y = p->Y + (l->nrow + i) * p->n;
        memset(y, 0, sizeof *y * (size_t)p->n);
        y[p->held[i]] = 1;
        dense_cholesky_solves(p->M, y, p->n, p->n, 1, p->n);
        const double scale = sqrt(LITTLE * most / y[p->held[i]]);
        for (int k = 0; k < p->n; k++) y[k] *= scale;
        row[p->held[i]] = scale;
    }
}

/* Everything at q; its values C go to o->C. */
static enum status prepare(struct projection *p, struct condense *o, const double *q, struct trouble *why)
{
    static const double NOTHING = 1e-10;
    const struct loops *l = o->rows.loops;
    const int n = p->n, rows = p->rows = l->nrow + p->nheld;
    TRY(mass(p, o, q, why));
    rows_linearize(&o->rows, q);
    rows_values_at(o->C, &o->rows, q);
    memset(p->Cq, 0, sizeof *p->Cq * (size_t)(rows * n));
    for (int r = 0; r < l->nrow; r++) {
        const int loop = l->row[r].loop, nk = l->nk[loop];
        for (int k = 0; k < nk; k++) p->Cq[r * n + l->k[loop][k]] = l->Cq[loop][(r - l->first[loop]) * nk + k];
    }
    memcpy(p->Y, p->Cq, sizeof *p->Y * (size_t)(l->nrow * n)); /* C_q by row is C_q' by column */
    dense_cholesky_solves(p->M, p->Y, n, n, l->nrow, n);
    hold(p, l);
    memset(p->S, 0, sizeof *p->S * (size_t)(rows * rows));
    dense_gemtm(p->S, 1, p->Cq, p->Y, rows, n, rows, rows, n, n);
    p->rank = pivot_lu(p->S, p->row, p->col, rows, rows, rows, NULL, rows, NOTHING);
    return OK;
}

/* p->dx := -M^-1 C_q' (C_q M^-1 C_q')^-1 p->x; what is held does not move. */
static void project(struct projection *p)
{
    const int n = p->n, rows = p->rows;
    for (int i = 0; i < p->nheld; i++) p->x[rows - 1 - i] = 0;
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
        project(p);
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
    const int n = p->n, rows = o->rows.loops->nrow;
    TRY(prepare(p, o, o->q, why));
    for (int r = 0; r < rows; r++) p->x[r] = -o->rows.loops->c1[r];
    dense_gemtv(p->x, 1, p->Cq, v, n, rows, n);
    project(p);
    for (int i = 0; i < n; i++) v[i] += p->dx[i];
    return OK;
}

/* Has nothing that is held changed by p->dx, in sizes of which `most` are usual? */
static bool is_held(const struct projection *p, const double *size, double most)
{
    static const double FITS = 1e-6; /* what a deck gives has so many digits */
    for (int i = 0; i < p->nheld; i++)
        if (!(fabs(p->dx[p->held[i]]) <= FITS * most * size[p->held[i]])) return false;
    return true;
}

/* Do the loops allow the rates v?  A row that is nothing but round-off does. */
static bool is_allowed(const struct projection *p, const struct condense *o, const double *v, double most)
{
    static const double NOTHING = 1e-5; /* of a row, whose numbers are of order 1 */
    const struct loops *l = o->rows.loops;
    for (int r = 0; r < l->nrow; r++) {
        double miss = -l->c1[r], size = fabs(l->c1[r]) + NOTHING * most;
        for (int k = 0; k < p->n; k++) {
            miss += p->Cq[r * p->n + k] * v[k];
            size += fabs(p->Cq[r * p->n + k]) * most * o->rows.size[k];
        }
        if (!(fabs(miss) <= CLOSES * size)) return false;
    }
    return true;
}

/* The positions that the deck gives are held, if q0 can be closed with them; else none is. */
static enum status find_positions(struct projection *p, struct condense *o, const double *q0, struct trouble *why)
{
    const struct model *m = o->model;
    const size_t bytes = sizeof *q0 * (size_t)m->nq;
    int row;
    p->nheld = 0;
    for (int i = 0; i < m->ncoordinate && m->given_q; i++)
        if (m->coordinate[i].iv >= 0 && m->given_q[i]) p->held[p->nheld++] = m->coordinate[i].iv;
    if (p->nheld > 0) {
        TRY(close_positions(p, o, why));
        moves_diff(&o->tree->moves, p->dx, o->q, q0);
        if (rows_misfit(o->C, &row, &o->rows, o->q) <= CLOSES && is_held(p, o->rows.size, 1)) return OK;
        memcpy(o->q, q0, bytes);
        condense_count_turns(o, o->q);
        p->nheld = 0;
    }
    return close_positions(p, o, why);
}

/* The rates likewise. */
static enum status find_rates(struct projection *p, struct condense *o, double *v, const double *v0,
                              struct trouble *why)
{
    const struct model *m = o->model;
    p->nheld = 0;
    for (int i = 0; i < m->n && m->given_v; i++)
        if (m->given_v[i]) p->held[p->nheld++] = i;
    if (p->nheld > 0) {
        TRY(close_rates(p, o, v, why));
        double most = 0;
        for (int i = 0; i < p->n; i++) {
            p->dx[i] = v[i] - v0[i];
            most = fmax(most, fabs(v0[i]) * o->rows.per[i]);
        }
        if (is_allowed(p, o, v, most) && is_held(p, o->rows.size, most)) return OK;
        memcpy(v, v0, sizeof *v * (size_t)p->n);
        p->nheld = 0;
    }
    return close_rates(p, o, v, why);
}

static void note(double *most, int *at, const double *dx, int n)
{
    for (int i = 0; i < n; i++)
        if (fabs(dx[i]) > fabs(*most)) *most = dx[i], *at = i;
}

enum status condense_assemble(struct condense *o, double *v, const double *q0, const double *v0)
{
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
    enum status status = find_positions(&p, o, q0, &why);
    if (status == OK) status = find_rates(&p, o, v, v0, &why);
    if (status == OK) {
        moves_diff(&o->tree->moves, p.dx, o->q, q0);
        note(&s->moved, &s->moved_at, p.dx, o->rows.n);
        for (int i = 0; i < o->rows.n; i++) p.dx[i] = v[i] - v0[i];
        note(&s->changed, &s->changed_at, p.dx, o->rows.n);
    }
    arena_close(scratch);
    const double left = rows_misfit(o->C, &row, &o->rows, o->q);
    loops_count_turns(o->rows.loops, COUNT_NEVER);
    if (status == OK && left <= CLOSES) return OK;
    s->blamed = o->rows.loops->row[row].loop;
    return fail(
        &s->report, E_MODEL,
        "the mechanism cannot be assembled from here: constraint '%s' still misses by %.3g of its size; draw it, or "
        "set 'initial', nearer to a posture in which it closes, and look whether its lengths can meet",
        o->model->loop[s->blamed].name, left);
}
