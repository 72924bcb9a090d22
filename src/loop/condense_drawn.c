/* condense_drawn.c -- drives at the start: they begin where they are drawn, and must agree with what else holds a freedom. */
#include <math.h>

#include "loop/condense_parts.h"

enum status condense_draw_drives(struct condense *o)
{
    struct loops *l = o->rows.loops;
    int row;
    struct trouble why;
    if (o->model->ndrive == 0) return OK;
    loops_when(l, o->model->t0, 0);
    if (condense_driven(o, false, o->model->t0, &why) != OK)
        return fail(condense_blame(o, why.index), E_MODEL,
                    "drive '%s' or a rate of it is not a number at t = %.9g: look at its expression",
                    o->model->loop[why.index].name, o->model->t0);
    for (int i = 0; i < l->nrow; i++) l->c[i] = 0;
    rows_misfit(o->C, &row, &o->rows, o->q);
    for (int i = 0; i < l->nrow; i++)
        if (l->model->loop[l->row[i].loop].drive) l->drawn[i] = o->C[i];
    loops_partly(l, o->model->t0, 0);
    return OK;
}

/* By how much the redundant rows' rates miss for the velocities vt of the tree, where C_q has been found; the worst. */
static double redundant_rate(int *worst, const struct condense *o, const double *vt)
{
    const struct loops *l = o->rows.loops;
    double most = 0;
    for (const struct part *p = o->split.part; p < o->split.part + o->split.npart; p++)
        for (int r = p->nr; r < p->of->nrow; r++) {
            const int row = p->row[r], loop = l->row[row].loop;
            double rate = -l->c1[row];
            for (int k = 0; k < l->nk[loop]; k++)
                rate += l->Cq[loop][(row - l->first[loop]) * l->nk[loop] + k] * vt[l->k[loop][k]];
            if (fabs(rate) > most) most = fabs(rate), *worst = row;
        }
    return most;
}

/* Are rows redundant where a drive has a say? */
static bool is_contested(const struct condense *o)
{
    const struct loops *l = o->rows.loops;
    bool any = false;
    for (const struct part *p = o->split.part; p < o->split.part + o->split.npart; p++) {
        bool led = false;
        for (int r = 0; r < p->of->nrow; r++) led |= l->model->loop[l->row[p->row[r]].loop].drive != NULL;
        any |= led && p->nr < p->of->nrow;
    }
    return any;
}

enum status condense_agree(struct condense *o)
{
    static const double DISAGREE = 1e-6; /* |C|, and |C'| per second */
    int row = 0;
    if (!is_contested(o)) return OK;
    rows_misfit(o->C, &row, &o->rows, o->q);
    double by = condense_redundant_miss(&row, &o->split, o->C), rate = 0;
    if (by <= DISAGREE) {
        TRY(condense_start_rates(o, o->vt));
        rate = redundant_rate(&row, o, o->vt);
        if (rate <= DISAGREE) return OK;
    }
    return fail(
        condense_blame_row(o, row), E_MODEL,
        "%s '%s' contradicts the others at t = %.9g by %.3g of the mechanism's size%s: drives and loops hold the same "
        "freedom; make them agree, or take one out",
        o->model->loop[o->rows.loops->row[row].loop].drive ? "drive" : "constraint", condense_row_name(o, row),
        o->model->t0, rate > 0 ? rate : by, rate > 0 ? " per second" : "");
}
