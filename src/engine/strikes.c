/* strikes.c -- see strikes.h */
#include "engine/strikes.h"

#include <math.h>
#include <stdio.h>

#include "base/scalar.h"
#include "engine/motion.h"

static const double LIKE = .05;  /* of the largest: two strikes that differ by less are alike */
static const double BRIEF = .25; /* of the longest time between two edges: a strike takes less, */
static const double TURNS = .1;  /* changes a velocity by that much of its largest, */
static const double TIMES = 2;   /* and that many times as quickly as it changed before */

void strikes_open(struct strikes *o, int n, struct arena *life)
{
    *o = (struct strikes){.n = n, .pace = -1, .top = TAKE(life, double, n)};
    for (int k = 0; k < STRIKES_KEPT; k++) o->v[k] = TAKE(life, double, n);
}

static bool is_like(const struct strikes *o, const double *v, double gap, int k)
{
    if (fabs(gap - o->gap[k]) > LIKE * o->longest) return false;
    for (int i = 0; i < o->n; i++)
        if (fabs(v[i] - o->v[k][i]) > LIKE * o->top[i]) return false;
    return true;
}

/* Has something struck and parted again since the last edge?  By how much velocities have changed, most of all, beside their largest. */
static bool has_struck(struct strikes *o, const double *v, double gap)
{
    const double *before = o->v[(o->seen + STRIKES_KEPT - 1) % STRIKES_KEPT];
    double turned = 0;
    if (o->seen == o->anew) return false;
    for (int i = 0; i < o->n; i++)
        if (o->top[i] > 0) turned = larger(turned, fabs(v[i] - before[i]) / o->top[i]);
    const double pace = gap > 0 ? turned / gap : 0;
    const bool quick = o->pace >= 0 && pace > TIMES * o->pace;
    o->pace = pace;
    return quick && turned > TURNS && gap <= BRIEF * o->longest;
}

void strikes_note(struct strikes *o, const double *v, double t)
{
    const double gap = o->seen > 0 ? fabs(t - o->t) : 0;
    const long kept = o->seen - o->anew < STRIKES_KEPT ? o->seen - o->anew : STRIKES_KEPT;
    bool like = !has_struck(o, v, gap);
    o->longest = larger(o->longest, gap);
    for (int i = 0; i < o->n; i++) o->top[i] = larger(o->top[i], fabs(v[i]));
    for (long k = 1; k <= kept && !like; k++) like = is_like(o, v, gap, (int)((o->seen - k) % STRIKES_KEPT));
    const int here = (int)(o->seen++ % STRIKES_KEPT);
    o->unlike += !like;
    o->t = t;
    o->gap[here] = gap;
    copy(o->v[here], v, o->n);
}

void strikes_rechart(struct strikes *o)
{
    o->anew = o->seen;
    o->pace = -1;
    zero(o->top, o->n);
}

void strikes_recall(struct strikes *o, struct recall *r)
{
    recall_within(r, "strikes");
    recall_one(r, "seen", o->seen);
    recall_one(r, "unlike", o->unlike);
    recall_one(r, "anew", o->anew);
    recall_one(r, "t", o->t);
    recall_one(r, "longest", o->longest);
    recall_one(r, "pace", o->pace);
    recall_list(r, "top", o->top, o->n);
    recall_list(r, "gap", o->gap, STRIKES_KEPT);
    for (int k = 0; k < STRIKES_KEPT; k++) {
        char name[24];
        snprintf(name, sizeof name, "v%d", k);
        recall_list(r, name, o->v[k], o->n);
    }
    recall_without(r);
}
