/* ledger.c -- the balance (2-26*), see ledger.h.
 *
 * The verdict is on the run as a whole: in the first steps from rest all works are near zero, and a quadrature of
 * second order (Newmark's) is off by a third of them, however small the step. */
#include "ledger/ledger.h"

#include <float.h>
#include <math.h>

#include "base/recall.h"
#include "base/scalar.h"

void ledger_open(struct ledger *o, double delta, double least, double kinetic, double elastic, double gravity)
{
    *o = (struct ledger){.delta = delta, .least = least};
    o->kinetic0 = o->kinetic = kinetic;
    o->elastic0 = o->elastic = elastic;
    o->gravity0 = o->gravity = gravity;
}

/* A relative error of velocities is twice that in their energy: ||W|| is at least so large that this is within the
 * balance at the usual delta. */
void ledger_tolerate(struct ledger *o, double tolerance)
{
    static const double USUAL_DELTA = .01;
    o->motion = 2 * tolerance / USUAL_DELTA;
}

/* What round-off of energies may come to. */
static double noise(const struct ledger *o)
{
    static const double ROUND_OFF = 1e4 * DBL_EPSILON;
    return larger(o->least, ROUND_OFF * (fabs(o->gravity) + fabs(o->gravity0) + o->kinetic + fabs(o->elastic)));
}

/* The floor of ||W||: where little work is done, as on a body that spins freely, the balance is measured against a
 * small share of the energy at the start; and the round-off of energies is not held against it. */
static double least_norm(const struct ledger *o)
{
    static const double share = 1e-2;
    const double there = larger(share * (o->kinetic0 + fabs(o->elastic0)), o->motion * o->kinetic0);
    return larger(there, noise(o));
}

bool ledger_stands(const struct ledger *o)
{
    static const double LITTLE = 1e6;
    return !(o->norm > LITTLE * noise(o));
}

/* Useful numerical damping takes less than this of resolved motion in one step; of motion that the step does not
 * resolve it takes a considerable part. */
static bool is_burst(const struct ledger *o, double lost)
{
    static const double SUDDEN = 1e-4;
    return fabs(lost) > SUDDEN * larger(o->kinetic + fabs(o->elastic), o->kinetic0 + fabs(o->elastic0));
}

void ledger_add(struct ledger *o, const double *work, double lost, double left)
{
    if (lost != 0 && is_burst(o, lost)) o->burst += lost;
    for (int i = 0; i < LEDGER_CHANNELS; i++) o->work[i] += work[i];
    o->lost += lost;
    o->gained = larger(o->gained, -o->lost);
    o->left += left;
}

void ledger_strike(struct ledger *o, double struck)
{
    o->struck += struck;
}

/* Works that change by `swing` from values of at most ||W|| in sum have come to at least swing - ||W||. */
void ledger_swing(struct ledger *o, double swing)
{
    o->norm = larger(o->norm, swing - o->norm);
}

void ledger_look(struct ledger *o, double t, double kinetic, double elastic, double gravity)
{
    o->kinetic = kinetic;
    o->elastic = elastic;
    o->gravity = gravity;
    double kin = kinetic - o->kinetic0;
    double taken = o->lost + o->struck - o->work[LEDGER_DAMPER] - o->work[LEDGER_FRICTION];
    double internal = elastic - o->elastic0 + taken;
    double drive = o->work[LEDGER_DRIVE], external = o->work[LEDGER_EXTERNAL] - (gravity - o->gravity0);
    o->residual = kin + internal - external - drive;
    o->norm = larger(o->norm, larger(fabs(kin) + fabs(internal) + fabs(external) + fabs(drive), least_norm(o)));
    if (fabs(o->residual) > o->worst || isnan(o->residual)) {
        o->worst = fabs(o->residual);
        o->t_worst = t;
    }
}

struct ledger_verdict ledger_judge(const struct ledger *o)
{
    const double of = larger(o->norm, o->kinetic0 + fabs(o->elastic0));
    if (o->gained * o->norm > o->worst * of) return (struct ledger_verdict){true, o->gained, of};
    return (struct ledger_verdict){false, o->worst, o->norm};
}

double ledger_share(const struct ledger *o)
{
    const struct ledger_verdict v = ledger_judge(o);
    return v.of > 0 ? v.wrong / v.of : 0;
}

bool ledger_broken(const struct ledger *o)
{
    return !(ledger_share(o) <= o->delta);
}

void ledger_recall(struct ledger *o, struct recall *r)
{
    recall_within(r, "ledger");
    recall_one(r, "kinetic0", o->kinetic0);
    recall_one(r, "elastic0", o->elastic0);
    recall_one(r, "gravity0", o->gravity0);
    recall_one(r, "kinetic", o->kinetic);
    recall_one(r, "elastic", o->elastic);
    recall_one(r, "gravity", o->gravity);
    recall_list(r, "work", o->work, LEDGER_CHANNELS);
    recall_one(r, "lost", o->lost);
    recall_one(r, "burst", o->burst);
    recall_one(r, "gained", o->gained);
    recall_one(r, "left", o->left);
    recall_one(r, "residual", o->residual);
    recall_one(r, "norm", o->norm);
    recall_one(r, "worst", o->worst);
    recall_one(r, "t_worst", o->t_worst);
    recall_without(r);
}

static double between(double a, double b, double x)
{
    return a + x * (b - a);
}

void ledger_between(struct ledger *o, const struct ledger *before, double x, double kinetic, double elastic,
                    double gravity)
{
    o->kinetic = kinetic;
    o->elastic = elastic;
    o->gravity = gravity;
    for (int c = 0; c < LEDGER_CHANNELS; c++) o->work[c] = between(before->work[c], o->work[c], x);
    o->lost = between(before->lost, o->lost, x);
    o->struck = between(before->struck, o->struck, x);
    o->residual = between(before->residual, o->residual, x);
}
