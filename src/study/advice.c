/* advice.c -- see advice.h */
#include "study/advice.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/text.h"
#include "multirate/schemes.h"
#include "study/trial.h"

static const double levels[] = {1e-2, 1e-4, 1e-6};
enum { LEVELS = sizeof levels / sizeof *levels };
static const double AIM = .5; /* of the error that is told: the safety factor */

static struct advised *add(struct advice *o)
{
    return &o->entry[o->n++];
}

/* The order with which errors fall, seen between two settings; at most `most`. */
static double power(const struct tried *f, double most)
{
    static const double LEAST = .5;
    if (f->n < 2 || !(f->error[1] > 0) || !isfinite(f->error[0])) return most;
    const double seen = log(f->error[0] / f->error[1]) / fabs(log(f->at[1] / f->at[0]));
    return seen > .65 * most ? most : fmax(LEAST, seen);
}

/* By what the whole run misses more than a part of it: in proportion to time, or as what a loose run misses has grown, if that
 * is more; and what nobody has looked at may be as bad again. */
static double later(const struct tried *f)
{
    return (2 - f->share) * fmax(1 / f->share, f->growth);
}

/* The error of a run of the whole time with setting i. */
static double ahead(const struct tried *f, int i)
{
    return f->error[i] * later(f);
}

/* What the balance of energy is off by in the whole run with setting i, over half of what it may be. */
static double balance(const struct tried *f, const struct trial *t, int i)
{
    return f->energy[i] / f->share / (AIM * t->delta);
}

/* Major steps to an interval for the error `aim`, where corners lie inside steps, and errors depend on where: the
 * coarsest setting tried from which on all finer ones reach it; else finer ones yet, by that order from the worst of
 * the last three. */
static double steps_by_trial(const struct tried *f, double aim, int order)
{
    enum { LAST = 3 };
    int good = f->nlevel;
    double worst = 0;
    while (good > 0 && f->level[good - 1].error * later(f) <= aim) good--;
    if (good < f->nlevel) return f->level[good].at;
    for (int i = f->nlevel < LAST ? 0 : f->nlevel - LAST; i < f->nlevel; i++)
        if (f->level[i].error < UNRESOLVED)
            worst = fmax(worst, pow(f->level[i].at, order) * f->level[i].error * later(f));
    return pow(worst / aim, 1. / order);
}

/* x rounded to twelve figures, as a deck would have it. */
static double plain(double x)
{
    char text[32];
    snprintf(text, sizeof text, "%.12g", x);
    return strtod(text, NULL);
}

/* Forces of rigid contacts are means over a step: what the round-off of positions makes of them, eps L/h^2 beside accelerations
 * that move things by some L in the run, is not to be seen beside the error. */
static bool shows_round_off(const struct trial *t, double step, double error)
{
    static const double SOME = 9;
    const double n = (t->until - t->start) / step;
    return t->scene.ncontact > 0 && n * n * DBL_EPSILON > SOME * error;
}

static void advise_step(struct advice *o, const struct trial *t, double error)
{
    static const double MOST = 1e9; /* major steps in all */
    const struct tried *f = &t->fixed;
    const double per = t->every / (t->until - t->start);
    const int order = stepper_find(f->scheme)->order;
    const double aim = AIM * error, smooth = f->at[1] * pow(ahead(f, 1) / aim, 1 / power(f, order));
    const double by_balance = f->at[1] * pow(balance(f, t, 1), 1 / power(f, order));
    const double m = fmax(t->unseen ? steps_by_trial(f, aim, t->falls) : smooth, by_balance);
    const double steps = t->base * trial_handy(fmax(m, LEAST_STEPS * per) / t->base);
    const double step = plain(t->every / steps / f->ratio);
    if (!(steps <= MOST * per)) return;
    if (!corners_met(&t->corners, step * f->ratio, &o->corner)) {
        o->no_steps = "loads or drives bend or jump at times that are no ends of equal steps";
        return;
    }
    *add(o) = (struct advised){.error = error,
                               .scheme = f->scheme,
                               .ratio = f->ratio,
                               .step = step,
                               .tolerance = NAN,
                               .work = f->work[1] / f->share * steps / f->at[1],
                               .dear = shows_round_off(t, step, error)};
    o->whole = o->entry[o->n - 1].work;
}

/* x rounded down to one figure, 1, 2 or 5, as a deck would have it. */
static double rounded(double x)
{
    const double ten = floor(log10(x) + 1e-9), figure = x / pow(10, ten);
    char text[32];
    snprintf(text, sizeof text, "%de%.0f", figure >= 4.999 ? 5 : figure >= 1.999 ? 2 : 1, ten);
    return strtod(text, NULL);
}

/* Errors are taken to fall a little less than the tolerance does.  A tolerance near the error itself is not advised,
 * since forces of vibrating parts are off by several tolerances. */
static void advise_tolerance(struct advice *o, const struct trial *t, double error)
{
    static const double LEAST = 1e-12, MOST = 1e-3, NEAR = .2;
    const struct tried *f = &t->own;
    const bool contacts = t->scene.ncontact > 0; /* order 2, and forces as means over a step, of order 1 */
    const double dear = contacts ? 1. / 2 : 1. / 9, less = contacts ? .5 : .8;
    const double aim = AIM * error, loose = fmax(ahead(f, 0), 1e-12);
    double x = aim >= loose ? f->at[0] * pow(aim / loose, less) : f->at[1] * pow(aim / ahead(f, 1), 1 / less);
    if (balance(f, t, 0) > 1) x = fmin(x, f->at[0] * pow(balance(f, t, 0), -1 / less));
    if (x < LEAST) return;
    x = rounded(fmin(x, fmin(NEAR * error, MOST)));
    const double seen = log(f->work[1] / f->work[0]) / log(f->at[0] / f->fine); /* between the two runs */
    const double work = x >= f->fine ? f->work[0] * pow(f->at[0] / x, seen) : f->work[1] * pow(f->fine / x, dear);
    *add(o) = (struct advised){
        .error = error, .scheme = f->scheme, .ratio = 1, .step = NAN, .tolerance = x, .work = work / f->share};
}

/* What takes too many evaluations, or a thousand times those of another way to the same error, is told, not advised;
 * where a smaller error takes less work it serves for the larger one, too. */
static void sift(struct advice *o)
{
    static const double MOST = 1e8, TIMES = 1000;
    for (int i = 0; i < o->n; i++) {
        double least = INFINITY;
        for (int k = 0; k < o->n; k++)
            if (o->entry[k].error == o->entry[i].error) least = fmin(least, o->entry[k].work);
        o->entry[i].dear |= o->entry[i].work > fmin(MOST, TIMES * least);
    }
    for (int i = o->n - 1; i >= 0; i--)
        for (int k = i + 1; k < o->n; k++) {
            const struct advised *a = &o->entry[k];
            const bool alike = isfinite(a->step) == isfinite(o->entry[i].step);
            const double error = o->entry[i].error;
            if (!alike || a->dear || !(a->work < o->entry[i].work)) continue;
            o->entry[i] = *a;
            o->entry[i].error = error;
        }
}

/* Columns of which nothing is promised: their names outlive the trial. */
static void note_without(struct advice *o, const struct reference *reference, const struct sim *sim)
{
    o->nwithout = reference->left_out;
    for (int i = 0; o->nwithout && i < sim->chosen.n; i++)
        if (text_same(sim->columns[i].name, reference->left_out_name)) o->without = sim->columns[i].name;
}

enum status advice_find(struct advice *o, const struct sim *sim, struct diags *diags, struct report *report)
{
    struct trial t;
    struct arena *own = arena_open();
    *o = (struct advice){.whole = NAN, .until = NAN, .steps_until = NAN, .corner = NAN};
    enum status status = trial_run(&t, sim, diags, own, report);
    if (status == OK && !t.why) {
        o->until = t.reference.horizon;
        o->parted = !t.reference.whole;
        o->only = t.only;
        note_without(o, &t.reference, sim);
        const bool steps = trial_tells(&t.fixed) && t.fixed.error[1] < UNRESOLVED;
        o->no_steps = t.no_steps;
        o->corner = t.corner;
        o->steps_until = steps ? t.tried_until : NAN;
        for (int i = 0; i < LEVELS; i++) {
            if (steps) advise_step(o, &t, levels[i]);
            if (t.own.n) advise_tolerance(o, &t, levels[i]);
        }
        sift(o);
    }
    o->work = t.work;
    o->why = t.why;
    if (o->why) o->stop = t.stop;
    arena_close(own);
    return status;
}

const struct advised *advice_step(const struct advice *o, double error)
{
    for (int i = 0; i < o->n; i++)
        if (o->entry[i].error == error && isfinite(o->entry[i].step) && !o->entry[i].dear) return &o->entry[i];
    return NULL;
}
