/* trial_fixed.c -- what fixed steps miss, by runs at halved steps; see trial.h */
#include <math.h>

#include "multirate/schemes.h"
#include "study/trial.h"

/* A scheme of fixed steps: the deck's, where its errors fall with the step. */
static const struct stepper_kind *fixed_kind(const struct scene *scene)
{
    const struct stepper_kind *kind = stepper_find(scene->integrate.scheme);
    return kind && !kind->adaptive && !kind->yardstick ? kind : stepper_find("midpoint");
}

/* Major steps to the run: a hundred, or so many times two that there are some to a step of the scheme of high order. */
static double first_steps(const struct trial *t)
{
    const double wanted = 2 * (double)t->steps / t->own.share;
    return LEAST_STEPS * exp2(fmax(0, floor(log2(wanted / LEAST_STEPS))));
}

/* The next run: m major steps to an interval of records, up to `end`, that takes about `seconds`. */
struct next {
    double m, end, seconds;
};

static struct next first_run(const struct trial *t)
{
    static const double A_STEP = 4; /* evaluations */
    const double by = fmax(1, t->multiple), per = t->every / (t->until - t->start);
    struct next next = {.end = t->reference.horizon};
    next.m = by * fmax(1, ceil(first_steps(t) * per / by - 1e-9));
    next.seconds = A_STEP * next.m * t->fixed.ratio * (next.end - t->start) / t->every * t->subject.price.evaluation;
    return next;
}

/* A shorter part of the run where that one takes so long that there is nothing left for another; true: it is another
 * part. */
static bool shorten(struct next *next, const struct trial *t)
{
    enum { LEFT = 3 };
    const double before = next->end;
    while (t->used + LEFT * next->seconds > t->most) {
        const double span = next->end - t->start, records = floor(span / t->every / 4 + 1e-9);
        if (records < 1) break;
        next->end = t->start + records * t->every;
        next->seconds *= records * t->every / span;
    }
    return next->end < before;
}

static void note(struct tried *f, double m, double error, double work)
{
    if (f->n) {
        f->at[0] = f->at[1];
        f->error[0] = f->error[1];
        f->work[0] = f->work[1];
    }
    f->n = f->n ? 2 : 1;
    f->at[1] = m;
    f->error[1] = error;
    f->work[1] = work;
}

static enum status attempt(struct next *next, struct trial *t, const struct stepper_kind *kind)
{
    struct errors e;
    struct outcome run;
    struct arena *life = arena_open();
    const struct setting setting = {kind, NAN, t->every / next->m / t->fixed.ratio, t->fixed.ratio};
    t->reference.horizon = t->subject.until = next->end;
    const enum status status = trial_attempt(&run, t, &setting, t->most - t->used, life);
    reference_compare(&e, &t->reference, &t->subject, &run);
    arena_close(life);
    t->fixed.share = (next->end - t->start) / (t->until - t->start);
    note(&t->fixed, next->m, run.rows < 2 || isnan(e.worst) ? INFINITY : e.worst, run.work);
    next->seconds = run.seconds;
    return status;
}

/* Is what the last runs have missed told well enough to go on from? */
static bool told(const struct trial *t, int order)
{
    static const double KNOWN = .05, SMALL = 1e-3, LEAST = 5e-7; /* less than anybody asks for */
    const struct tried *f = &t->fixed;
    if (f->error[1] < LEAST && f->share == t->own.share) return true;
    return f->n == 2 && f->error[1] <= KNOWN &&
           (f->error[0] / f->error[1] >= pow(2, order - .6) || f->error[1] <= SMALL);
}

enum status trial_fixed(struct trial *t)
{
    const struct stepper_kind *kind = fixed_kind(&t->scene);
    const double horizon = t->reference.horizon;
    enum status status = OK;
    t->fixed = (struct tried){.scheme = kind->name, .ratio = kind->two_rates ? t->scene.integrate.ratio : 1};
    struct next next = first_run(t);
    while (status == OK && t->used < t->most) {
        if (shorten(&next, t)) t->fixed.n = 0;
        status = attempt(&next, t, kind);
        if (told(t, kind->order)) break;
        next.m *= 2;
        next.seconds *= 2;
    }
    t->reference.horizon = horizon;
    return status;
}
