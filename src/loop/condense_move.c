/* condense_move.c -- positions of a tree with loops, as ode2_move has it. */
#include <math.h>
#include <string.h>

#include "loop/condense_parts.h"

static enum way_end go(struct condense *o, double *q1, const double *q0, const double *dx, double s, double t,
                       double beside, double ajar)
{
    loops_where(o->rows.loops, t, beside);
    const enum way_end end = closing_point(&o->closing, q1, &o->lost, q0, dx, s, ajar);
    for (int i = 0; end == WAY_LOST && i < o->model->nq; i++) q1[i] = NAN;
    return end;
}

void condense_point(struct condense *o, double *q1, const double *q0, const double *dx, double s, double t,
                    double beside)
{
    go(o, q1, q0, dx, s, t, beside, 0);
}

static void point(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t)
{
    condense_point(ode->self, q1, q0, dx, s, t, 0);
}

enum { LATE = 3, EARLY = 6 }; /* corrections of a way from a late iterate, from another posture */

static bool nearby(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t,
                   const struct again *how)
{
    struct condense *o = ode->self;
    enum way_end end = WAY_LOST;
    if (!o->rows.constant) {
        loops_when(o->rows.loops, t, 0);
        end = closing_again(&o->closing, q1, q0, dx, s, how);
    }
    if (end == WAY_LOST) condense_point(o, q1, q0, dx, s, t, 0);
    return end == WAY_AJAR;
}

/* Way that an iterate may be left open by: some 1e-12 then.  Where stiff forces hold dependents, accelerations are off by
 * 4e-6 of the last correction. */
static const double SMALL = 1e-6;

static bool first(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t)
{
    return go(ode->self, q1, q0, dx, s, t, 0, SMALL) == WAY_AJAR;
}

static bool again(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t, int open)
{
    const struct again how = {.corrections = LATE, .open = open & OPEN_BEFORE, .ajar = open & OPEN_AFTER ? SMALL : 0};
    return nearby(ode, q1, q0, dx, s, t, &how);
}

static void onward(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t, int open)
{
    const struct condense *o = ode->self;
    const bool known = o->moving && o->moving == rows_number(&o->rows);
    const struct again how = {.corrections = EARLY,
                              .open = o->model->ndrive > 0 || open & OPEN_BEFORE,
                              .left = open & OPEN_AFTER ? SMALL * SMALL : 0,
                              .v = o->vt,
                              .a = known ? o->at : NULL};
    nearby(ode, q1, q0, dx, s, t, &how);
}

enum status condense_lost(const struct condense *o, double t, struct trouble *why)
{
    TRY(condense_driven(o, false, t, why));
    return trouble_set(why, TROUBLE_CLOSURE, o->lost.loop, o->lost.by, t);
}

static void diff(const struct ode2 *ode, double *dx, const double *q1, const double *q0)
{
    const struct condense *o = ode->self;
    moves_diff(&o->tree->moves, o->dx, q1, q0);
    for (int i = 0; i < ode->n; i++) dx[i] = o->dx[o->split.ind[i]];
}

/* A rotation that is independent in part turns with all of its angular velocity.  vt and at stay: they are the motion at the
 * last residual, along which the next way begins. */
static void rate(const struct ode2 *ode, double *dxrate, const double *q1, const double *q0, const double *dx,
                 const double *v, double t)
{
    struct condense *o = ode->self;
    const struct moves *moves = &o->tree->moves;
    enum status status = OK;
    split_spread(&o->split, o->dx, dx);
    split_spread(&o->split, o->va, v);
    bool partly = false;
    for (int i = 0; i < moves->nturn; i++) partly |= o->split.follows[i];
    if (partly) {
        moves_diff(moves, o->dx, q1, q0);
        status = condense_rates(o, o->va, NULL, q1, v, NULL, t, NULL);
    }
    moves_rate(moves, o->vb, o->dx, o->va);
    for (int i = 0; i < ode->n; i++) dxrate[i] = status == OK ? o->vb[o->split.ind[i]] : NAN;
}

static void bend(const struct ode2 *ode, double *off, const double *v, const double *a, int order)
{
    struct condense *o = ode->self;
    split_spread(&o->split, o->va, v);
    split_spread(&o->split, o->dx, a);
    moves_bend(&o->tree->moves, o->vb, o->va, o->dx, order);
    for (int i = 0; i < ode->n; i++) off[i] = o->vb[o->split.ind[i]];
}

const struct ode2_move condense_move = {
    .point = point, .first = first, .again = again, .onward = onward, .diff = diff, .rate = rate, .bend = bend};
