/* touch_chosen.c -- which contacts are near, looked at, closed: lists of them, so that no step pays for the others; see touch.h */
#include <math.h>
#include <string.h>

#include "engine/motion.h"
#include "engine/touch_parts.h"

enum status touch_gaps(struct touch *o, const struct state *x, double reach, struct trouble *why)
{
    const size_t bytes = (size_t)o->ode->nq * sizeof *x->q;
    if (o->seen.reach == reach && o->seen.t == x->t && memcmp(o->seen.q, x->q, bytes) == 0) return OK;
    o->seen.reach = NAN;
    TRY(o->c->gap(o->c, &o->g, reach, x->q, x->t, why));
    memcpy(o->seen.q, x->q, bytes);
    o->seen.t = x->t;
    o->seen.reach = reach;
    return OK;
}

static void may_differ(struct touch_saved *o, int i)
{
    if (o->is_other[i]) return;
    o->is_other[i] = 1;
    o->other[o->nother++] = i;
}

void touch_change(struct touch *o, int i)
{
    may_differ(&o->start, i);
    may_differ(&o->part, i);
}

void touch_choose(struct touch *o, int n)
{
    o->n = n;
    o->rows = 0;
    for (int k = 0; k < n; k++) {
        const int i = o->contact[k], across = o->c->of[i].across;
        touch_change(o, i);
        o->cone[k] = (struct cone){.row = o->rows, .across = across};
        for (int j = 0; j <= across; j++) o->l[o->rows++] = o->p[o->first[i] + j];
    }
}

void touch_choose_closed(struct touch *o)
{
    for (int k = 0; k < o->nclosed; k++) o->contact[k] = o->which[k];
    touch_choose(o, o->nclosed);
}

int touch_merge(struct touch *o, int n, const int *list, int nlist)
{
    for (int l = 0, k = 0; l < nlist; l++) {
        while (k < n && o->contact[k] < list[l]) k++;
        if (k < n && o->contact[k] == list[l]) continue;
        for (int j = n++; j > k; j--) o->contact[j] = o->contact[j - 1];
        o->contact[k] = list[l];
    }
    return n;
}

void touch_keep_closed(struct touch *o)
{
    o->nclosed = 0;
    for (int k = 0; k < o->n; k++)
        if (o->closed[o->contact[k]]) o->which[o->nclosed++] = o->contact[k];
}

void touch_keep(struct touch *o)
{
    for (int k = 0; k < o->npushed; k++) {
        const int i = o->pushed[k];
        touch_change(o, i);
        zero(o->p + o->first[i], 1 + o->c->of[i].across);
    }
    o->npushed = o->n;
    for (int k = 0; k < o->n; k++) {
        const int i = o->pushed[k] = o->contact[k];
        copy(o->p + o->first[i], o->l + o->cone[k].row, 1 + o->cone[k].across);
    }
}

void touch_spread(const struct touch *o, double *p)
{
    zero(p, o->c->nrow);
    for (int k = 0; k < o->n; k++) copy(p + o->first[o->contact[k]], o->l + o->cone[k].row, 1 + o->cone[k].across);
}
