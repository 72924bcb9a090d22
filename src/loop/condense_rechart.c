/* condense_rechart.c -- a better split between major steps.
 *
 * Split anew when |G| has grown: dependents run away from the independents. */
#include <math.h>

#include "loop/condense_parts.h"

/* Rate of a dependent coordinate per unit of an independent one: time to look for a better split.  Errors of a step grow
 * with the square of it, or so: equal-armed slider-crank, slider first: of 3 (and of twice the least, and half of it to
 * be worth a change) 2.5 to 5 times the error. */
static const double LARGE = 2;

static void fit(struct condense *o, int i)
{
    solve_fit(&o->solve, i);
    closing_fit(&o->closing, i);
}

double condense_choose(struct condense *o, int i, const double *unit, double fast)
{
    split_choose(&o->split, &o->split.part[i], unit, fast);
    fit(o, i);
    return o->split.part[i].chosen = solve_try(&o->solve, i);
}

void condense_number(struct condense *o)
{
    split_number(&o->split);
    o->ode.n = o->split.n;
    o->ode.ns = o->split.ns;
}

/* Does it matter which of the independent coordinates are fast?  Not where all are. */
static bool has_both(const struct part *p)
{
    return p->nfast > 0 && p->nfast < p->ni;
}

void condense_watch(struct condense *o, int i)
{
    struct part *p = &o->split.part[i];
    p->best_gain = solve_gain(&o->solve, i);
    p->least_gain = p->nfast ? p->best_gain : fmin(LARGE, p->best_gain);
}

/* Have dependent coordinates come to run away from the independent ones?  Where all splits are singular alike, as in a
 * flat posture, the rates stay moderate.  At the base of the tangent. */
static bool gain_too_large(struct condense *o, int i)
{
    static const double WORSE = 1.5; /* than it has been since the last look */
    struct part *p = &o->split.part[i];
    p->gain = closing_gain(&o->closing, i);
    p->least_gain = fmin(p->least_gain, p->gain);
    p->best_gain = fmin(p->best_gain, p->gain);
    return p->resplit_due = p->gain > fmax(LARGE, WORSE * p->least_gain);
}

static void note_nearest(struct condense *o, int i, double t)
{
    const struct part *p = &o->split.part[i];
    const struct factor *at = &o->solve.block[i].C_qd;
    const double ratio = p->nr > 0 ? factor_ratio(at, o->rows.size) / p->chosen : 1;
    if (ratio < o->nearest.ratio) o->nearest = (struct nearest){ratio, t, factor_weakest(at, o->rows.size)};
}

/* Another split: is its gain this much less? */
static bool gains(struct condense *o, int i, double fast)
{
    static const double WORTH = 1.5;
    struct part *p = &o->split.part[i];
    p->least_gain = condense_choose(o, i, o->split.reach, fast) > 0 ? solve_gain(&o->solve, i) : INFINITY;
    return p->least_gain < p->gain / WORTH;
}

/* A new split, if there is a better one: with the fast coordinates of the deck independent while that helps, or while
 * they are not much worse than they were at best.  A short stiff slide has a large gain always, and tells its vibration
 * best: telescope.yaml without it has 9 times the error. */
static int improve(struct condense *o, int i)
{
    static const double KEEP_FAST = 1e-2, MUCH = 2;
    struct part *p = &o->split.part[i];
    const bool may_drop = !has_both(p) || p->gain > MUCH * p->best_gain;
    split_keep(&o->split, p);
    if ((has_both(p) && gains(o, i, KEEP_FAST)) || (may_drop && gains(o, i, 1))) {
        split_succeed(&o->split, p, &o->solve.block[i].C_qd);
        p->best_gain = p->least_gain;
        return 1;
    }
    split_return(&o->split, p);
    fit(o, i);
    p->least_gain = p->gain;
    return 0;
}

/* What goes along with v, as velocities of the whole tree in ode.along's places; those of none are taken off: drives move,
 * too. */
static bool take_along(struct condense *o, double *const *whole, const double *q, double t)
{
    if (!o->ode.along[0]) return false;
    if (condense_rates(o, o->rt, NULL, q, o->zero, NULL, t, NULL) != OK) return false;
    for (int k = 0; k < 2; k++) {
        if (condense_rates(o, whole[k], NULL, q, o->ode.along[k], NULL, t, NULL) != OK) return false;
        for (int i = 0; i < o->tree->ode.n; i++) whole[k][i] -= o->rt[i];
    }
    return true;
}

/* Whole velocities first, then the splits, then the velocities of the new independent ones.  The tangent is the one on
 * which the next step begins.  Where these cannot be found, the split stays, and the next step says so. */
int condense_rechart(struct ode2 *ode, double *q, double *v, double t)
{
    struct condense *o = ode->self;
    int changed = 0, wanted = 0;
    struct ode2 *tree = &o->tree->ode;
    const bool known = o->rows.constant && o->judged == o->split.number;
    const bool led = known || closing_tangent_about(&o->closing, q); /* first of all: it takes what the step has left */
    if (led && !o->rows.constant && o->moving && o->moving == rows_number(&o->rows))
        closing_bend(&o->closing, o->vt, o->at);
    if (tree->chart && condense_rates(o, o->vt, NULL, q, v, NULL, t, NULL) == OK)
        tree->chart->rechart(tree, q, o->vt, t); /* its coordinates stay */
    if (known || !led) return 0;
    for (int i = 0; i < o->split.npart; i++) {
        note_nearest(o, i, t);
        wanted += gain_too_large(o, i);
    }
    o->judged = o->split.number;
    if (!wanted) return 0;
    double *const whole[] = {o->va, o->vb};
    const bool along = take_along(o, whole, q, t);
    if (condense_rates(o, o->vt, NULL, q, v, NULL, t, NULL) != OK) return 0;
    for (int i = 0; i < o->split.npart; i++)
        if (o->split.part[i].resplit_due) changed |= improve(o, i);
    condense_number(o); /* also where all have come back to the split that they had */
    if (!changed) return 0;
    o->charts++;
    for (int i = 0; i < o->ode.n; i++) v[i] = o->vt[o->split.ind[i]];
    for (int k = 0; along && k < 2; k++)
        for (int i = 0; i < o->ode.n; i++) o->ode.along[k][i] = whole[k][o->split.ind[i]];
    return 1;
}

void condense_recall(struct condense *o, struct recall *r)
{
    recall_within(r, "loops");
    recall_one(r, "holds", o->holds);
    recall_one(r, "missed", o->missed);
    recall_one(r, "missed_by", o->missed_by);
    recall_one(r, "price", o->ode.price);
    recall_one(r, "charts", o->charts);
    recall_one(r, "nearest", o->nearest.ratio);
    recall_one(r, "nearest_t", o->nearest.t);
    recall_one(r, "nearest_place", o->nearest.place);
    recall_list(r, "drawn", o->rows.loops->drawn, o->rows.loops->nrow);
    recall_list(r, "turned", o->rows.loops->turned, o->model->nloop);
    split_recall(&o->split, r);
    closing_recall(&o->closing, r);
    recall_without(r);
    if (!r->back || *r->wrong) return;
    for (int i = 0; i < o->split.npart; i++) fit(o, i);
    condense_number(o);
}
