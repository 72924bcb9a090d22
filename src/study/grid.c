/* grid.c -- see grid.h */
#include "study/grid.h"

#include <math.h>

#include "engine/composed.h"
#include "multirate/schemes.h"
#include "study/fourth.h"

enum { USUAL_RATIO = 5 };
static const double tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
static const double parts[] = {4, 2, 1, 1. / 2, 1. / 4, 1. / 8, 1. / 16, 1. / 32}; /* of the deck's step */

/* Something moves fast, and not everything does. */
static bool two_rates(const struct subject *subject)
{
    return subject->ns > 0 && subject->ns < subject->n;
}

/* Is the kind there to take out what it does not resolve, if it is told to?  A scheme of one rate like that costs what the others
 * do, and makes sense where the deck wants it; Newmark's is of order 1 then, and there without. */
static bool damps(const struct stepper_kind *kind)
{
    return !kind->two_rates && key_find(kind->keys, "rho_infinity") && !key_find(kind->keys, "gamma");
}

/* Rigid contacts are cut into steps of one rate, those of other schemes are refused. */
static bool takes_contacts(const struct stepper_kind *kind)
{
    return kind->cut || (kind->two_rates && kind->single && kind->single->cut);
}

static bool makes_sense(const struct stepper_kind *kind, const struct subject *subject)
{
    if (subject->scene->ncontact && !takes_contacts(kind)) return false;
    if (kind == stepper_find(subject->scene->integrate.scheme)) return !too_full(kind, subject);
    return !too_full(kind, subject) && !kind->needs && !damps(kind) && (!kind->two_rates || two_rates(subject));
}

static struct chain *begin(struct grid *o, bool ladder, struct arena *life)
{
    o->chain = arena_more(life, o->chain, o->n, &o->capacity, sizeof *o->chain);
    o->chain[o->n] = (struct chain){.ladder = ladder};
    return &o->chain[o->n++];
}

bool grid_own(struct setting *o, const struct subject *subject)
{
    const struct integrate *plan = &subject->scene->integrate;
    const struct step_options *how = plan->options;
    const struct stepper_kind *kind = stepper_find(plan->scheme);
    const bool tolerance = kind && by_tolerance(kind) && how->tolerance > 0;
    *o = (struct setting){kind, tolerance ? how->tolerance : NAN, tolerance ? NAN : plan->step, 1, 0};
    if (kind && kind->two_rates && !tolerance) o->ratio = plan->ratio;
    if (!tolerance && how->order > 2) o->order = how->order;
    return kind && (tolerance || (plan->step > 0 && !kind->adaptive));
}

bool grid_same(const struct setting *a, const struct setting *b)
{
    const bool step = isfinite(a->step);
    return setting_together(a, b) && step == isfinite(b->step) &&
           (step ? a->step == b->step : a->tolerance == b->tolerance);
}

/* But for what has been run already as the deck's own. */
static void add(struct grid *grid, struct chain *o, struct setting setting, struct arena *life)
{
    const struct chain *own = &grid->chain[0];
    if (own != o && own->n == 1 && grid_same(own->setting, &setting)) return;
    o->setting = arena_more(life, o->setting, o->n, &o->capacity, sizeof *o->setting);
    o->setting[o->n++] = setting;
}

static void add_tolerances(struct grid *o, const struct stepper_kind *kind, const struct study_options *options,
                           struct arena *life)
{
    const int usual = sizeof tolerances / sizeof *tolerances, n = options->ntolerance ? options->ntolerance : usual;
    const double *list = options->ntolerance ? options->tolerance : tolerances;
    struct chain *chain = begin(o, !options->ntolerance, life);
    for (int i = 0; i < n; i++) add(o, chain, (struct setting){kind, list[i], NAN, 1, 0}, life);
}

/* Do records fall on the ends of major steps? */
static bool fits(double step, int ratio, const struct subject *subject)
{
    const double steps = subject->every / (step * ratio);
    return steps > .5 && fabs(steps - round(steps)) <= 1e-9 * steps;
}

static void add_steps(struct grid *o, const struct stepper_kind *kind, int ratio, const struct study_options *options,
                      const struct subject *subject, struct arena *life)
{
    const double h = subject->scene->integrate.step;
    const struct step_options *how = subject->scene->integrate.options;
    const int order = kind->fourth && how->order > 2 ? how->order : 0;
    struct chain *chain = begin(o, !options->nstep, life);
    for (int i = 0; i < options->nstep; i++)
        add(o, chain, (struct setting){kind, NAN, options->step[i], ratio, order}, life);
    for (size_t i = 0; !options->nstep && i < sizeof parts / sizeof *parts; i++)
        if (fits(h * parts[i], ratio, subject))
            add(o, chain, (struct setting){kind, NAN, h * parts[i], ratio, order}, life);
}

/* Two rates of order 4: from one major step to an interval of records on. */
static void add_fourth(struct grid *o, const struct stepper_kind *kind, int ratio, const struct subject *subject,
                       struct arena *life)
{
    enum { FINEST = 1 << 12 };
    const double every = subject->every;
    struct chain *chain = begin(o, true, life);
    for (int m = 1; m <= FINEST; m *= 2) /* 1, 2, 3, 4, 6, 8, 12 ... */
        for (int k = 2; k < (m > 1 ? 4 : 3); k++) {
            const int steps = m * k / 2;
            add(o, chain, (struct setting){kind, NAN, every / steps / ratio, ratio, 4}, life);
        }
}

/* By what is seen of the motion, from one tolerance to the next. */
static void add_foreseen(struct grid *o, const struct subject *subject, struct arena *life)
{
    enum { LEVELS = 16 };
    static const double LOOSEST = .1, LEVEL = 3;
    struct fourth known;
    struct setting setting, last = {0};
    if (!fourth_look(&known, subject->scene, subject->diags)) return;
    struct chain *chain = begin(o, true, life);
    double tolerance = LOOSEST;
    for (int i = 0; i < LEVELS; i++, tolerance /= LEVEL) {
        if (!fourth_setting(&setting, &known, tolerance) || grid_same(&setting, &last)) continue;
        add(o, chain, setting, life);
        last = setting;
    }
}

/* At the deck's ratio, at a smaller one, since minor steps of order 4 resolve what takes more of order 2, and at those that
 * the motion asks for. */
static void add_fourths(struct grid *o, const struct stepper_kind *kind, const struct study_options *options,
                        const struct subject *subject, struct arena *life)
{
    static const int less[] = {1, 5};
    const struct integrate *plan = &subject->scene->integrate;
    const int usual = plan->ratio > 1 ? plan->ratio : USUAL_RATIO;
    for (int i = 0; i < options->nratio; i++) add_fourth(o, kind, options->ratio[i], subject, life);
    for (size_t i = 0; !options->nratio && i < sizeof less / sizeof *less; i++)
        if (i == 0 || usual / less[i] > 1) add_fourth(o, kind, usual / less[i], subject, life);
    if (!options->nratio && kind == stepper_find("subcycle")) add_foreseen(o, subject, life);
}

/* Where nothing is said of steps, and these may be of order 4. */
static bool takes_fourth(const struct stepper_kind *kind, const struct study_options *options,
                         const struct subject *subject)
{
    struct step_options how = *(const struct step_options *)subject->scene->integrate.options;
    struct misfit why;
    how.order = 4;
    how.tolerance = 0;
    return kind->two_rates && kind->fourth && !options->nstep && !options->ntolerance && !subject->scene->ncontact &&
           two_rates(subject) && composed_fits(&how, &why);
}

/* By tolerance where the kind knows one, unless steps are asked for and it takes them. */
static enum status add_kind(struct grid *o, const struct stepper_kind *kind, const struct study_options *options,
                            const struct subject *subject, struct arena *life, struct report *report)
{
    const struct integrate *plan = &subject->scene->integrate;
    const int usual[] = {plan->ratio > 1 ? plan->ratio : USUAL_RATIO}, single[] = {1};
    const bool all = kind->two_rates && options->nratio;
    const int *ratio = all ? options->ratio : kind->two_rates ? usual : single, n = all ? options->nratio : 1;
    const bool cut = subject->scene->ncontact && kind->two_rates; /* those take fixed steps */
    if (takes_fourth(kind, options, subject)) add_fourths(o, kind, options, subject, life);
    if (by_tolerance(kind) && !cut && (kind->adaptive || !options->nstep)) {
        add_tolerances(o, kind, options, life);
        return OK;
    }
    if (!(plan->step > 0) && !options->nstep) {
        if (!options->nscheme) return OK;
        return fail(report, E_USAGE, "the deck has no 'step': name some for %s with --steps", kind->name);
    }
    for (int i = 0; i < n; i++) add_steps(o, kind, ratio[i], options, subject, life);
    return OK;
}

enum status grid_make(struct grid *o, const struct study_options *options, const struct subject *subject,
                      struct arena *life, struct report *report)
{
    struct setting own;
    *o = (struct grid){0};
    if (!options->nscheme && grid_own(&own, subject)) add(o, begin(o, false, life), own, life);
    for (int i = 0; i < options->nscheme; i++) TRY(add_kind(o, options->scheme[i], options, subject, life, report));
    for (int i = 0; !options->nscheme && stepper_kinds[i]; i++)
        if (makes_sense(stepper_kinds[i], subject)) TRY(add_kind(o, stepper_kinds[i], options, subject, life, report));
    return OK;
}

double grid_growth(const struct setting *last, const struct setting *next)
{
    if (isfinite(last->tolerance)) return pow(last->tolerance / next->tolerance, 1. / (last->kind->order + 1));
    return last->step / next->step;
}
