/* contraction.c -- see contraction.h */
#include "engine/contraction.h"

#include <math.h>
#include <string.h>

#include "base/scalar.h"

static const double FADE = .8;     /* a step */
static const double GROWTH = .05;  /* a step, of what is not seen but for the first place */
static const double LEAVES = .5;   /* any matrix that is kept, at most */
static const double LEAST = 1e-6;  /* that is believed, */
static const double SURPRISE = .1; /* of what was foreseen: too good, the slow part is still to come */

void contraction_forget(struct contraction *o)
{
    *o = (struct contraction){.at = 0};
}

static void learn_place(struct prospect *o, double seen, int first)
{
    double x = o->ahead;
    if (seen > 0)
        o->ahead = o->known = larger(seen, FADE * o->known);
    else
        o->ahead = first ? sqrt(x) * sqrt(sqrt(x)) : x + GROWTH * x * (1 - x);
}

/* What this step has shown. */
static void learn(struct contraction *o)
{
    for (int i = 0; i < CONTRACTION_PLACES; i++) {
        learn_place(o->fresh ? &o->anew[i] : &o->old[i], o->seen[i], i == 0);
        o->seen[i] = 0;
    }
    if (o->fresh) memcpy(o->old, o->anew, sizeof o->old);
}

void contraction_begin(struct contraction *o)
{
    if (o->at > 0) learn(o);
    o->at = o->fresh = 0;
}

void contraction_renewed(struct contraction *o)
{
    if (o->at > 0) learn(o);
    memcpy(o->old, o->anew, sizeof o->old);
    o->at = 0;
    o->fresh = 1;
}

/* Quotients may go to and fro: of three corrections the larger one of two is to be expected again. */
double contraction_after(struct contraction *o, double theta, double hearsay)
{
    const int k = o->at++;
    const double now = smaller(1, larger(theta, LEAST)), before = o->theta;
    double ahead = k < CONTRACTION_PLACES ? o->old[k].ahead : 0, worse = 1;
    if (k == 0) return ahead > 0 ? smaller(LEAVES, larger(hearsay, ahead)) : LEAVES;
    if (k <= CONTRACTION_PLACES) {
        const struct prospect *said = &o->old[k - 1];
        o->seen[k - 1] = now;
        if (said->known > 0) worse = larger(1, now / said->known);
        if (now < SURPRISE * said->known) ahead = larger(ahead, said->known);
        if (ahead == 0) ahead = sqrt(now);
    }
    o->theta = now;
    return larger(now, k > 1 ? before : smaller(LEAVES, worse * ahead));
}

static void prospects_recall(struct prospect *o, struct recall *r, const char *name)
{
    recall_within(r, name);
    recall_each(r, "known", o, known, CONTRACTION_PLACES);
    recall_each(r, "ahead", o, ahead, CONTRACTION_PLACES);
    recall_without(r);
}

void contraction_recall(struct contraction *o, struct recall *r)
{
    recall_within(r, "contraction");
    prospects_recall(o->old, r, "old");
    prospects_recall(o->anew, r, "anew");
    recall_list(r, "seen", o->seen, CONTRACTION_PLACES);
    recall_one(r, "theta", o->theta);
    recall_one(r, "at", o->at);
    recall_one(r, "fresh", o->fresh);
    recall_without(r);
}
