/* reference_choice.c -- which two runs are the reference, at which tolerance, how far: see reference_parts.h */
#include <math.h>

#include "base/crew.h"
#include "multirate/schemes.h"
#include "study/reference_parts.h"

static const double TRIAL = 1e-6;    /* tolerance of the trials */
static const double TRIALS = .2;     /* share of the cost of the reference that goes to these */
static const double MOST_TRIAL = 10; /* of one trial, whatever the budget [s] */
enum { HIGH = 5 };                   /* least order of a scheme that may be a reference */

bool too_full(const struct stepper_kind *kind, const struct subject *subject)
{
    return kind->full && subject->n > MOST_DENSE;
}

static double rate_of(const struct outcome *run, double start)
{
    return run->reached > start ? run->seconds / (run->reached - start) : INFINITY;
}

/* One trial; tells its cost per second of the motion, and its cost [s]. */
static enum status try_one(void *self, int i, int to, struct report *report)
{
    const struct candidates *o = self;
    struct outcome run;
    struct arena *life = arena_open();
    double told[2] = {INFINITY, 0};
    const enum status status = outcome_run(&run, &o->of[i].setting, o->most, o->subject, life, report);
    if (status == OK) told[1] = run.seconds;
    if (status == OK && (run.over || run.rows > 1)) told[0] = rate_of(&run, o->subject->scene->start);
    arena_close(life);
    return status == OK ? crew_tell(to, told, sizeof told) : status;
}

static enum status hear_trial(void *self, int i, const void *bytes, size_t n, struct report *report)
{
    struct candidate *trial = &((struct candidates *)self)->of[i];
    const double *told = bytes;
    (void)n, (void)report;
    trial->rate = told[0];
    trial->cost = told[1];
    return OK;
}

static enum status run_trials(struct candidates *o, double most, struct arena *life, struct report *report)
{
    for (int i = 0; stepper_kinds[i] && o->n < MOST_TRIALS; i++) {
        const struct stepper_kind *kind = stepper_kinds[i];
        if (kind->order >= HIGH && kind->adaptive && !kind->needs && !too_full(kind, o->subject))
            o->of[o->n++] = (struct candidate){{kind, TRIAL, NAN, 1, 0}, INFINITY, 0};
    }
    o->most = fmin(TRIALS * most / o->n, MOST_TRIAL);
    const struct crew crew = {.n = o->n, .self = o, .work = try_one, .hear = hear_trial};
    return crew_run(&crew, life, report);
}

/* Predicted cost of `span` seconds of the motion at a tolerance [s]: steps go with the tolerance to the power
 * 1/(order + 1). */
static double foretold(const struct candidate *o, double tolerance, double span)
{
    return span * o->rate * pow(o->setting.tolerance / tolerance, 1. / (o->setting.kind->order + 1));
}

/* The cheapest at a tolerance, except `but`; NULL: none. */
static const struct candidate *cheapest(const struct candidates *o, double tolerance, const struct candidate *but)
{
    const struct candidate *best = NULL;
    for (int i = 0; i < o->n; i++) {
        const struct candidate *t = &o->of[i];
        if (t == but || !isfinite(t->rate)) continue;
        if (!best || foretold(t, tolerance, 1) < foretold(best, tolerance, 1)) best = t;
    }
    return best;
}

/* Brings the end forward to a record, so that this share of the run is left. */
static void bring_forward(struct reference *o, struct subject *subject, double share)
{
    const double start = subject->scene->start, records = (subject->until - start) / subject->every;
    const double left = fmax(1, floor(share * records));
    if (!(left < records)) return;
    subject->until = start + left * subject->every;
    o->cut = true;
}

/* With rigid contacts: midpoint at two tolerances.  Between impacts its errors are of order 2, and with a tenth of
 * the tolerance a tenth as large: so the second run is off by about the difference of the two, the first by a tenth
 * of that. */
static enum status choose_with_contacts(struct reference *o, struct subject *subject, double most, struct arena *life,
                                        struct report *report)
{
    static const double COARSE = 1e-4, pairs[][2] = {{1e-8, 1e-7}, {1e-7, 1e-6}, {1e-6, 1e-5}};
    enum { PAIRS = sizeof pairs / sizeof *pairs };
    struct outcome run;
    const struct stepper_kind *kind = stepper_find("midpoint");
    const struct setting trial = {kind, COARSE, NAN, 1, 0};
    TRY(outcome_run(&run, &trial, fmin(TRIALS * most, MOST_TRIAL), subject, life, report));
    o->spent += run.seconds;
    if (run.rows < 2) return fail(report, E_NUMERIC, "no reference: midpoint does not take this deck on");
    const double span = subject->until - subject->scene->start, allowed = (1 - TRIALS) * most;
    const double gone = outcome_row(&run, run.rows - 1)[0] - subject->scene->start;
    for (int i = 0; i < PAIRS; i++) {
        const double seconds = run.seconds * span / gone * (sqrt(COARSE / pairs[i][0]) + sqrt(COARSE / pairs[i][1]));
        o->first = (struct setting){kind, pairs[i][0], NAN, 1, 0};
        o->second = (struct setting){kind, pairs[i][1], NAN, 1, 0};
        if (seconds <= allowed) break;
        if (i + 1 == PAIRS) bring_forward(o, subject, allowed / seconds);
    }
    return OK;
}

enum status reference_candidates(struct candidates *among, struct reference *o, const struct subject *subject,
                                 double most, struct arena *life, struct report *report)
{
    *among = (struct candidates){.subject = subject, .until = subject->until};
    if (subject->scene->ncontact) return OK;
    TRY(run_trials(among, most, life, report));
    for (int i = 0; i < among->n; i++) {
        among->spent += among->of[i].cost;
        o->trial[o->ntrial++] = (struct trialled){among->of[i].setting.kind, among->of[i].rate};
    }
    o->spent = among->spent;
    return OK;
}

void candidates_learn(struct candidates *among, const struct setting *setting, const struct outcome *run)
{
    for (struct candidate *c = among->of; c < among->of + among->n; c++)
        if (c->setting.kind == setting->kind) {
            c->setting.tolerance = setting->tolerance;
            c->rate = rate_of(run, among->subject->scene->start);
        }
}

enum status reference_choose(struct reference *o, const struct candidates *among, struct subject *subject, double most,
                             struct arena *life, struct report *report)
{
    static const double pairs[][2] = {{1e-11, 1e-11}, {1e-11, 1e-10}, {1e-11, 1e-9}, {1e-10, 1e-8}};
    static const double ANEW = .3; /* of what the reference may cost, whatever has been spent */
    enum { PAIRS = sizeof pairs / sizeof *pairs };
    o->cut = false;
    subject->until = among->until;
    if (subject->scene->ncontact) return choose_with_contacts(o, subject, most, life, report);
    const double span = subject->until - subject->scene->start;
    const double allowed = fmax((1 - TRIALS) * most - (o->spent - among->spent), ANEW * most);
    for (int i = 0; i < PAIRS; i++) {
        const struct candidate *a = cheapest(among, pairs[i][0], NULL), *b = cheapest(among, pairs[i][1], a);
        if (!a || !b) return fail(report, E_NUMERIC, "no reference: no two schemes of high order take this deck on");
        const double seconds = foretold(a, pairs[i][0], span) + foretold(b, pairs[i][1], span);
        o->first = a->setting;
        o->second = b->setting;
        o->first.tolerance = pairs[i][0];
        o->second.tolerance = pairs[i][1];
        if (seconds <= allowed) break;
        if (i + 1 == PAIRS) bring_forward(o, subject, allowed / seconds);
    }
    return OK;
}
