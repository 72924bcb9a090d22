/* remainder.c -- see remainder.h */
#include "engine/remainder.h"

#include <math.h>

#include "engine/motion.h"

static const double PARALLEL = .98; /* square of the cosine between corrections that are */
static const double MOST = .3;      /* contraction that a kept matrix may have */
enum { OLD = 5 };                   /* steps after which alpha is no longer followed */

void remainder_open(struct remainder *o, int n, struct arena *life)
{
    *o = (struct remainder){.n = n, .first = TAKE(life, double, n)};
}

void remainder_forget(struct remainder *o)
{
    *o = (struct remainder){.n = o->n, .first = o->first};
}

void remainder_recall(struct remainder *o, struct recall *r)
{
    recall_within(r, "remainder");
    recall_one(r, "known", o->known);
    recall_one(r, "alpha", o->alpha);
    recall_one(r, "rate", o->rate);
    recall_one(r, "age", o->age);
    recall_without(r);
}

void remainder_begin(struct remainder *o)
{
    o->known &= ++o->age < OLD;
}

void remainder_first(struct remainder *o, const double *d)
{
    copy(o->first, d, o->n);
}

void remainder_second(struct remainder *o, const double *d, const double *per)
{
    double along = 0, before = 0, after = 0;
    for (int i = 0; i < o->n; i++) {
        const double a = per[i] * o->first[i], b = per[i] * d[i];
        along += a * b;
        before += a * a;
        after += b * b;
    }
    const double was = o->alpha;
    const bool line = o->known && o->age > 0;
    o->known = along * along > PARALLEL * before * after && fabs(along) < MOST * before;
    if (!o->known) return;
    o->alpha = along / before;
    o->rate = line ? (o->alpha - was) / o->age : 0;
    o->age = 0;
}

void remainder_learnt(struct remainder *o)
{
    o->alpha = 0;
}

void remainder_take(const struct remainder *o, double *z, const double *d)
{
    if (!o->known) return;
    const double alpha = o->alpha + o->rate * o->age, more = alpha / (1 - alpha);
    for (int i = 0; i < o->n; i++) z[i] -= more * d[i];
}
