/* trial_fixed.c -- what fixed steps miss, by runs at halved steps; see trial.h */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "multirate/schemes.h"
#include "study/trial.h"

/* A scheme of fixed steps: the deck's, where its errors fall with the step. */
static const struct stepper_kind *fixed_kind(const struct scene *scene)
{
    const struct stepper_kind *kind = stepper_find(scene->integrate.scheme);
    return kind && !kind->adaptive && !kind->yardstick ? kind : stepper_find("midpoint");
}

/* Major steps to the run: a hundred, or so many times two that there are some to a step that the scheme of high order takes
 * where nothing but its tolerance keeps it short, of two rates minor ones; where records do, to a step of it as it is. */
static double first_steps(const struct trial *t)
{
    static const double TO_A_STEP = 8, TO_A_SHORT_ONE = 2;
    if (t->n == 0) return LEAST_STEPS; /* drives alone move all */
    const double wanted = t->freely > 0 ? TO_A_STEP * t->freely / t->fixed.ratio : TO_A_SHORT_ONE * t->steps;
    return LEAST_STEPS * exp2(fmax(0, floor(log2(wanted / LEAST_STEPS))));
}

/* The next run: m major steps to an interval of records, up to `end`, that takes about `seconds`. */
struct next {
    double m, end, seconds;
};

static double price_of(const struct next *next, const struct trial *t)
{
    static const double A_STEP = 4; /* evaluations */
    return A_STEP * next->m * t->fixed.ratio * (next->end - t->start) / t->every * t->subject.price.evaluation;
}

static struct next first_run(const struct trial *t)
{
    const double per = t->every / (t->until - t->start);
    struct next next = {.end = t->reference.horizon};
    const double least = ceil(first_steps(t) * per / t->base - 1e-9);
    next.m = t->base * (least == 3 ? 4 : least); /* about half of it is a setting, too */
    next.seconds = price_of(&next, t);
    return next;
}

/* The last of the corners; before all: none. */
static double last_corner(const struct trial *t)
{
    return t->corners.n ? t->corners.t[t->corners.n - 1] : -INFINITY;
}

/* Is there room for so many runs like the next? */
static bool fits(const struct next *next, const struct trial *t, double runs)
{
    return t->used + runs * next->seconds <= t->most;
}

enum { LEFT = 2 }; /* runs */

/* A shorter part of the run where that one takes so long that there is nothing left for another, as long as no corner is
 * beyond it; true: it is another part. */
static bool shorten(struct next *next, const struct trial *t)
{
    const double before = next->end;
    while (!fits(next, t, LEFT)) {
        const double span = next->end - t->start, records = floor(span / t->every / 2 + 1e-9);
        if (records < 1 || t->start + records * t->every < last_corner(t)) break;
        next->end = t->start + records * t->every;
        next->seconds *= records * t->every / span;
    }
    return next->end < before;
}

/* A run at longer steps than the only one before. */
static void note_coarser(struct tried *f, double m, double error, const struct outcome *run)
{
    f->at[0] = m;
    f->error[0] = error;
    f->work[0] = run->work;
    f->energy[0] = run->energy_share;
    f->n = 2;
    f->level[1] = f->level[0];
    f->level[0] = (struct level){m, error};
    f->nlevel = 2;
}

static void note(struct tried *f, double m, double error, const struct outcome *run)
{
    if (f->n == 1 && m < f->at[1]) {
        note_coarser(f, m, error, run);
        return;
    }
    if (f->n) {
        f->at[0] = f->at[1];
        f->error[0] = f->error[1];
        f->work[0] = f->work[1];
        f->energy[0] = f->energy[1];
    }
    if (f->n == 0) f->nlevel = 0;
    if (f->nlevel < MOST_LEVELS) f->level[f->nlevel++] = (struct level){m, error};
    f->n = f->n ? 2 : 1;
    f->at[1] = m;
    f->error[1] = error;
    f->work[1] = run->work;
    f->energy[1] = run->energy_share;
}

static enum status attempt(struct next *next, struct trial *t, const struct stepper_kind *kind)
{
    struct errors e, loose;
    struct outcome run;
    struct arena *life = arena_open();
    const struct setting setting = {kind, NAN, t->every / next->m / t->fixed.ratio, t->fixed.ratio, 0};
    reference_up_to(&t->reference, next->end);
    t->subject.until = next->end;
    const enum status status = trial_attempt(&run, t, &setting, t->most - t->used, NULL, life);
    reference_compare(&e, &t->reference, &t->subject, &run);
    reference_compare(&loose, &t->reference, &t->subject, &t->loose);
    t->fixed.growth = loose.worst > 0 ? t->own.error[0] / loose.worst : 1;
    arena_close(life);
    t->fixed.share = (next->end - t->start) / (t->until - t->start);
    note(&t->fixed, next->m, run.rows < 2 || isnan(e.worst) ? INFINITY : e.worst, &run);
    next->seconds = run.seconds;
    return status;
}

static const double KNOWN = .05, LITTLE = 5e-7; /* an error that others follow from; less than anybody asks for */

static bool told_enough(const struct trial *t)
{
    return t->fixed.n == 2 && t->fixed.error[1] <= KNOWN;
}

/* What the reference itself may be off by, from what the loose run has missed: no error below is seen. */
static double unknown(const struct trial *t)
{
    static const double SURE = 3;
    return SURE * t->own.error[0] * t->own.fine / t->own.at[0];
}

/* Is what the last runs have missed told well enough to go on from? */
static bool told(const struct trial *t, int order)
{
    static const double SMALL = 1e-3;
    const struct tried *f = &t->fixed;
    const double little = fmax(LITTLE, unknown(t));
    if (t->unseen) return f->n == 2 && f->error[1] < little; /* else nothing is known to go on by */
    if (f->error[1] < little && f->share == t->own.share) return true;
    return told_enough(t) &&
           (f->error[0] / f->error[1] >= pow(f->at[1] / f->at[0], .65 * order) || f->error[1] <= SMALL);
}

static void give_up(struct trial *t, const char *why, double corner)
{
    t->no_steps = why;
    t->corner = corner;
    t->fixed.n = 0;
}

/* Are all corners ends of steps, and within what is compared? */
static bool meets_corners(struct trial *t)
{
    const double grid = corners_grid(&t->corners, t->every);
    t->base = grid > 0 ? corners_both(fmax(1, t->multiple), grid) : 0;
    if (t->base == 0)
        give_up(t, "loads or drives bend or jump at times that are no ends of equal steps", t->corners.t[0]);
    else if (last_corner(t) > t->reference.horizon)
        give_up(t, "trial runs have not come to where a load or drive bends or jumps", last_corner(t));
    return t->base > 0 && !t->no_steps;
}

/* Does what is to come look like the part that was tried?  By the ranges of columns, which in a drift grow with time. */
static bool is_like_the_rest(const struct trial *t, const double *whole)
{
    static const double LESS = .1;
    for (int c = 0; c < t->reference.run.n; c++)
        if (t->subject.column[c].compared && whole[c] > t->reference.least[c] &&
            t->reference.range[c] < LESS * t->fixed.share * whole[c])
            return false;
    return true;
}

/* Has the first run resolved what moves?  Then steps twice as long tell the order for a quarter of what half of them cost. */
static bool coarser_will_do(const struct trial *t)
{
    const struct tried *f = &t->fixed;
    return f->n == 1 && f->error[1] <= KNOWN && f->error[1] >= LITTLE && !t->unseen && f->at[1] > t->base;
}

/* Has enough been seen of the forces that come on? */
static bool may_come_on(const struct trial *t)
{
    return t->comes_on && t->fixed.share < 1 - 1e-9;
}

/* Where drives alone move all the run that is its own reference is the first of these, too, if its steps are the same. */
static bool is_known(struct trial *t, const struct next *next, const struct stepper_kind *kind)
{
    const bool same = t->n == 0 && t->own.n == 0 && next->m == t->own.at[0] && t->fixed.ratio == 1 &&
                      next->end == t->until && text_same(kind->name, t->own.scheme);
    if (!same) return false;
    t->fixed.share = t->fixed.growth = 1;
    note(&t->fixed, next->m, 0, &t->reference.run);
    t->tried_until = next->end;
    return true;
}

static enum status halve_steps(struct trial *t, const struct stepper_kind *kind)
{
    enum status status = OK;
    struct next next = first_run(t);
    const bool whole =
        t->scene.ncontact || t->comes_on; /* what is met in a part of the run is not what is in the rest */
    if (!t->unseen && is_known(t, &next, kind)) return OK;
    while (status == OK && t->used < t->most) {
        if (t->unseen && told_enough(t) && !fits(&next, t, LEFT)) break;
        if (whole && !fits(&next, t, 1)) break;
        if (!whole && shorten(&next, t)) t->fixed.n = 0;
        if ((t->corners.n || t->fixed.n > 0) && !fits(&next, t, 1)) break;
        status = attempt(&next, t, kind);
        if (status == OK && coarser_will_do(t)) {
            struct next coarser = next;
            coarser.m = t->base * floor(next.m / 2 / t->base);
            status = attempt(&coarser, t, kind);
        }
        if (told(t, kind->order)) break;
        next.m *= 2;
        next.seconds *= 2;
    }
    t->tried_until = next.end;
    if (t->scene.ncontact && t->fixed.n < 2)
        give_up(t, "it takes too long to try them to the end, and impacts are rare", NAN);
    return status;
}

bool trial_tells(const struct tried *f)
{
    return f->n == 2 || (f->n == 1 && f->share > .99);
}

enum status trial_fixed(struct trial *t)
{
    const struct stepper_kind *kind = fixed_kind(&t->scene);
    const double horizon = t->reference.horizon;
    double *whole = TAKE(t->life, double, t->reference.run.n);
    memcpy(whole, t->reference.range, sizeof *whole * (size_t)t->reference.run.n);
    t->fixed = (struct tried){.scheme = kind->name, .ratio = kind->two_rates ? t->scene.integrate.ratio : 1};
    if (!meets_corners(t)) return OK;
    const enum status status = halve_steps(t, kind);
    if (!t->no_steps && may_come_on(t))
        give_up(t, "forces may come on, bend or jump behind the part of the run that there was time to try them in",
                NAN);
    if (!t->no_steps && t->corners.n && t->fixed.n > 0 && !(t->fixed.error[1] < UNRESOLVED))
        give_up(t, "those that there was time to try resolve nothing", NAN);
    if (!t->no_steps && t->corners.n && !trial_tells(&t->fixed))
        give_up(t, "steps that end where loads or drives bend or jump are too many to try", t->corners.t[0]);
    if (!t->no_steps && t->fixed.share < COVERED)
        give_up(t,
                "an evaluation to each of the deck's steps, which trials may take, did not do to try them in enough of "
                "the run",
                NAN);
    if (!t->no_steps && !t->reference.whole) give_up(t, "trial runs part on the way", NAN);
    if (!t->no_steps && !is_like_the_rest(t, whole))
        give_up(t, "they were tried in a part of the run that is not like the rest", NAN);
    reference_up_to(&t->reference, horizon);
    return status;
}
