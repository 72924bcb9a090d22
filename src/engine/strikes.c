/* strikes.c -- see strikes.h */
#include "engine/strikes.h"

#include <math.h>
#include <stdio.h>

#include "base/scalar.h"
#include "engine/motion.h"

static const double LIKE = .05; /* of the largest: two strikes that differ by less are alike */

void strikes_open(struct strikes *o, int n, struct arena *life)
{
    *o = (struct strikes){.n = n, .top = TAKE(life, double, n)};
    for (int k = 0; k < STRIKES_KEPT; k++) o->v[k] = TAKE(life, double, n);
}

static bool is_like(const struct strikes *o, const double *v, double gap, int k)
{
    if (fabs(gap - o->gap[k]) > LIKE * o->longest) return false;
    for (int i = 0; i < o->n; i++)
        if (fabs(v[i] - o->v[k][i]) > LIKE * o->top[i]) return false;
    return true;
}

/* Is what the edge ends, or what came before that, a brief push?  By what velocities have changed since the last edge. */
static bool is_brief(struct strikes *o, double changed, double gap)
{
    static const double PART = .02, TIMES = 5;
    const double pace = gap > 0 ? changed / gap : 0;
    const bool now = changed > PART && pace > TIMES * o->pace, before = o->changed > PART && o->pace > TIMES * pace;
    o->changed = changed;
    o->pace = pace;
    return now || before;
}

void strikes_note(struct strikes *o, const double *v, double t, bool pushes)
{
    const double gap = o->seen > 0 ? fabs(t - o->t) : 0;
    const long kept = o->seen - o->anew < STRIKES_KEPT ? o->seen - o->anew : STRIKES_KEPT;
    const double *last = o->v[(o->seen + STRIKES_KEPT - 1) % STRIKES_KEPT];
    double changed = 0;
    bool like = false;
    o->longest = larger(o->longest, gap);
    for (int i = 0; i < o->n; i++) {
        o->top[i] = larger(o->top[i], fabs(v[i]));
        if (kept > 0 && o->top[i] > 0) changed = larger(changed, fabs(v[i] - last[i]) / o->top[i]);
    }
    const bool brief = is_brief(o, changed, gap) && kept > 1;
    for (long k = 1; k <= kept && !like; k++) like = is_like(o, v, gap, (int)((o->seen - k) % STRIKES_KEPT));
    const int here = (int)(o->seen++ % STRIKES_KEPT);
    o->unlike += !like && (pushes || brief);
    o->t = t;
    o->gap[here] = gap;
    copy(o->v[here], v, o->n);
}

void strikes_rechart(struct strikes *o)
{
    o->anew = o->seen;
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
    recall_one(r, "changed", o->changed);
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
