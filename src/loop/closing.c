/* closing.c -- positions that keep the loops closed.
 *
 * A move is given by its independent part dx_i; the dependent part starts on the tangent at the base, dx_d = G0 dx_i,
 * and goes by Newton's method to C(q0 (+) dx) = 0:
 *
 *     dx_d := dx_d - C_qd^-1 C
 *
 * where the columns of a rotation with dependents are those along its Cayley vector: convergence is quadratic. */
#include <math.h>
#include <string.h>

#include "la/rot.h"
#include "loop/condense_parts.h"

static const double CLOSED = 1e-9;     /* a Newton correction below this leaves its square */
static const double ROUND_OFF = 1e-15; /* |C| that no correction makes less: C_qd is nearly singular */
static const double FAR = 1;           /* a correction this large after two iterations leads elsewhere */
enum { MOST_ITERATIONS = 20 };

void condense_put(struct condense *o, double *q1, const double *base, double s)
{
    moves_point(o->moves, q1, base, o->dx, 1);
    for (int i = 0; s != 1 && i < o->moves->nturn; i++) {
        const struct turn *t = &o->moves->turn[i];
        if (o->bound[i]) continue;
        double q[4], phi[3];
        for (int k = 0; k < 4; k++) q[k] = base[t->iq[k]];
        for (int k = 0; k < 3; k++) phi[k] = o->dxs[t->iv[k]];
        quat_move(q, q, phi, s);
        for (int k = 0; k < 4; k++) q1[t->iq[k]] = q[k];
    }
}

double condense_correct(struct condense *o)
{
    double most = 0;
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        for (int r = 0; r < c->nr; r++) c->x[r] = -o->C[c->of->row[c->kept[r]]];
        component_solve(c, c->x);
        for (int r = 0; r < c->nr; r++) {
            const int k = c->of->k[c->dep[r]];
            const double size = fabs(c->x[r]) * o->rows.per[k];
            o->dx[k] += c->x[r];
            if (size > most || isnan(size)) most = size;
        }
    }
    return most;
}

/* One Newton correction at q1 = base (+) dx; returns its size, or NAN. */
static double correct(struct condense *o, const double *q1)
{
    rows_linearize(&o->rows, q1);
    rows_values(o->C, &o->rows);
    o->factored = 0;
    for (int i = 0; i < o->npart; i++) {
        rows_turn(&o->rows, o->part[i].of, o->dx, o->bound);
        if (!component_factor(&o->part[i])) return NAN;
    }
    return condense_correct(o);
}

/* What the loops miss by; the least of it on the way is kept. */
static double note_miss(struct condense *o)
{
    int row = 0;
    const double most = rows_worst(&row, &o->rows, o->C);
    if (most < o->lost_by) o->lost_by = most, o->lost = o->loops->row[row].loop;
    return most;
}

int condense_close(struct condense *o, double *q1, const double *base, double s)
{
    o->lost_by = INFINITY;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        condense_put(o, q1, base, s);
        double size = correct(o, q1);
        const double miss = size <= CLOSED ? 0 : note_miss(o);
        if (!isfinite(size) || (i >= 2 && size > FAR)) return 0;
        if (size > CLOSED && miss > ROUND_OFF) continue;
        condense_put(o, q1, base, s);
        return 1;
    }
    return 0;
}

/* T0 and s0 of the posture looked at and factored. */
static void lead_at(struct condense *o)
{
    if (o->model->ndrive == 0) return;
    rows_values(o->C, &o->rows);
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        for (int k = 0; k < c->nlead; k++) {
            const int row = c->of->row[c->kept[c->lead[k]]];
            double *x = c->T0 + (size_t)k * (size_t)c->nr;
            memset(x, 0, sizeof *x * (size_t)c->nr);
            x[c->lead[k]] = 1;
            component_solve(c, x);
            c->s0[k] = o->C[row] + o->loops->c[row];
        }
    }
}

static void keep_base(struct part *c)
{
    memcpy(c->base.A - c->band[1], c->A - c->band[1], sizeof *c->A * (size_t)c->nr * (size_t)(c->ld + 1));
    memcpy(c->base.F, c->of->F, sizeof *c->of->F * (size_t)c->of->start[c->of->nrow]);
    memcpy(c->base.swap, c->prow, sizeof *c->prow * (size_t)c->nr);
}

int condense_tangent(struct condense *o, const double *q)
{
    const long base = posture_take(&o->base, q, o->model->nq);
    if (base == o->tangent) return 1;
    o->tangent = 0;
    struct trouble why;
    if (condense_factor(o, q, 0, &why) != OK) return 0;
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        if (c->wide)
            keep_base(c);
        else
            component_G(c, c->G0);
    }
    lead_at(o);
    o->tangent = base;
    return 1;
}

void condense_predict(struct condense *o)
{
    for (int i = 0; i < o->npart; i++) {
        const struct part *c = &o->part[i];
        if (c->wide) {
            for (int j = 0; j < c->ni; j++) c->probe[j] = o->dx[c->of->k[c->ind[j]]];
            component_times_G(c, &c->base, c->x, c->probe);
        }
        for (int r = 0; r < c->nr; r++) {
            double sum = c->wide ? c->x[r] : 0;
            for (int j = 0; !c->wide && j < c->ni; j++)
                sum += c->G0[r + (size_t)j * (size_t)c->nr] * o->dx[c->of->k[c->ind[j]]];
            for (int k = 0; k < c->nlead; k++)
                sum += c->T0[r + k * c->nr] * (o->loops->c[c->of->row[c->kept[c->lead[k]]]] - c->s0[k]);
            o->dx[c->of->k[c->dep[r]]] = sum;
        }
    }
}

void condense_point(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t)
{
    struct condense *o = ode->self;
    condense_spread(o, o->dxs, dx);
    for (int i = 0; i < o->nt; i++) o->dx[i] = s * o->dxs[i];
    loops_when(o->loops, t);
    int closed = condense_tangent(o, q0);
    if (closed) {
        condense_predict(o);
        closed = condense_close(o, q1, o->base.q, s);
    }
    for (int i = 0; !closed && i < o->model->nq; i++) q1[i] = NAN;
}

static void move_diff(const struct ode2 *ode, double *dx, const double *q1, const double *q0)
{
    struct condense *o = ode->self;
    moves_diff(o->moves, o->dxs, q1, q0);
    for (int i = 0; i < ode->n; i++) dx[i] = o->dxs[o->ind[i]];
}

/* A rotation that is independent in part turns with all of its angular velocity. */
static void move_rate(const struct ode2 *ode, double *dxrate, const double *q1, const double *q0, const double *dx,
                      const double *v, double t)
{
    struct condense *o = ode->self;
    struct trouble why;
    condense_spread(o, o->dxs, dx);
    condense_spread(o, o->vt, v);
    bool partly = false;
    for (int i = 0; i < o->moves->nturn; i++) partly |= o->bound[i];
    if (partly) {
        moves_diff(o->moves, o->dxs, q1, q0);
        condense_rates(o, o->vt, NULL, q1, v, NULL, t, &why);
    }
    moves_rate(o->moves, o->at, o->dxs, o->vt);
    for (int i = 0; i < ode->n; i++) dxrate[i] = o->at[o->ind[i]];
}

const struct ode2_move condense_move = {
    .point = condense_point, .again = condense_again, .diff = move_diff, .rate = move_rate};
