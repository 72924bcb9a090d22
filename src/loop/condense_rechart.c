/* condense_rechart.c -- a better split between major steps.
 *
 * Split anew when |G| has grown: dependents run away from the independents. */
#include <math.h>

#include "loop/condense_parts.h"

static void fit(struct condense *o, int i)
{
    solve_fit(&o->solve, i);
    closing_fit(&o->closing, i);
}

double condense_choose(struct condense *o, int i)
{
    split_choose(&o->split, &o->split.part[i]);
    fit(o, i);
    return solve_try(&o->solve, i);
}

void condense_number(struct condense *o)
{
    split_number(&o->split);
    o->ode.n = o->split.n;
    o->ode.ns = o->split.ns;
}

/* Have dependent coordinates come to run away from the independent ones?  Where all splits are singular alike, as in a
 * flat posture, the rates stay moderate.  At the base of the tangent. */
static bool gain_too_large(struct condense *o, int i)
{
    static const double LARGE = 3; /* rate of a dependent coordinate per unit: time to look for a better split */
    struct part *p = &o->split.part[i];
    p->gain = closing_gain(&o->closing, i);
    p->least_gain = fmin(p->least_gain, p->gain);
    return p->resplit_due = p->gain > fmax(LARGE, 2 * p->least_gain);
}

/* A new split, if there is a better one. */
static int improve(struct condense *o, int i)
{
    struct part *p = &o->split.part[i];
    split_keep(&o->split, p);
    p->least_gain = condense_choose(o, i) > 0 ? solve_gain(&o->solve, i) : INFINITY;
    if (p->least_gain < p->gain / 2) return 1;
    split_return(&o->split, p);
    fit(o, i);
    p->least_gain = p->gain;
    return 0;
}

/* Whole velocities first, then the splits, then the velocities of the new independent ones.  The tangent is the one on
 * which the next step begins.  Where these cannot be found, the split stays, and the next step says so. */
int condense_rechart(struct ode2 *ode, double *q, double *v, double t)
{
    struct condense *o = ode->self;
    int changed = 0, wanted = 0;
    struct ode2 *tree = &o->tree->ode;
    if (tree->chart && condense_rates(o, o->vt, NULL, q, v, NULL, t, NULL) == OK)
        tree->chart->rechart(tree, q, o->vt, t); /* its coordinates stay */
    if (!closing_tangent(&o->closing, q)) return 0;
    for (int i = 0; i < o->split.npart; i++) wanted += gain_too_large(o, i);
    if (!wanted || condense_rates(o, o->vt, NULL, q, v, NULL, t, NULL) != OK) return 0;
    for (int i = 0; i < o->split.npart; i++)
        if (o->split.part[i].resplit_due) changed |= improve(o, i);
    if (!changed) return 0;
    condense_number(o);
    o->charts++;
    for (int i = 0; i < o->ode.n; i++) v[i] = o->vt[o->split.ind[i]];
    return 1;
}
