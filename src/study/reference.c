/* reference.c -- see reference.h */
#include "study/reference.h"

#include <math.h>
#include <string.h>

#include "base/crew.h"
#include "study/reference_parts.h"

static const double PARTED = 1e-3;    /* of the range: coordinates that differ by more have parted */
static const double UNCERTAIN = 1e-2; /* of the range: columns that differ by more are not compared */
static const double LEAST = .1;       /* of the run: a horizon before that is no reference */
static const double EACH = .7;        /* of what the reference may cost, for one of its runs at the most */
static const double RESTS = 1e-8;     /* of its size: a column whose range is less is constant */
static const double LOST = 1e-9;      /* of the largest column of the unit: less is round-off */
enum { ATTEMPTS = 3 };                /* pairs of runs, until one comes to its end */

static void find_ranges(struct reference *o, const struct outcome *run, double end)
{
    for (int c = 0; c < o->run.n; c++) {
        double low = INFINITY, high = -INFINITY;
        for (int r = 0; r < run->rows && outcome_row(run, r)[0] <= end; r++) {
            low = fmin(low, outcome_row(run, r)[c]);
            high = fmax(high, outcome_row(run, r)[c]);
        }
        o->range[c] = high - low;
        o->largest[c] = fmax(fabs(low), fabs(high));
    }
}

/* The size of round-off in each column: by the largest column of its unit, or a usual change of a coordinate.  A
 * mode that nothing moves has it, next to one that bends; or the angle of a block that slides. */
static void find_least(struct reference *o, const struct subject *subject)
{
    for (int c = 0; c < o->run.n; c++) {
        double most = subject->column[c].usual;
        for (int k = 0; k < o->run.n; k++)
            if (same_unit(&subject->column[c], &subject->column[k])) most = fmax(most, o->largest[k]);
        o->least[c] = LOST * most;
    }
}

/* A difference relative to the column's range, or to its size if it is constant. */
static double share(const struct reference *o, int c, double difference)
{
    const double size = o->range[c] > RESTS * o->largest[c] ? o->range[c] : o->largest[c];
    return difference == 0 ? 0 : difference / fmax(size, o->least[c]);
}

/* Is the difference of a coordinate more than `parted` of its range?  And more than the tolerance of the second run,
 * relative to a usual change, for the range of a short part of the run may be next to nothing. */
static bool part(const struct reference *o, int c, double difference, double parted,
                 const struct outcome_column *column)
{
    const double within = o->second.tolerance > 0 ? o->second.tolerance * column->usual : 0;
    return column->rate >= 0 && difference > within && share(o, c, difference) > parted;
}

static bool rows_part(const struct reference *o, const double *a, const double *b, double parted,
                      const struct subject *subject)
{
    for (int c = 0; c < o->run.n; c++)
        if (part(o, c, fabs(a[c] - b[c]), parted, &subject->column[c])) return true;
    return false;
}

/* The last common time before coordinates part. */
static void find_horizon(struct reference *o, const struct outcome *second, double parted,
                         const struct subject *subject)
{
    int r[2] = {-1, -1};
    o->whole = true;
    o->horizon = 0;
    while (o->whole && outcome_next(r, &o->run, second)) {
        const double *a = outcome_row(&o->run, r[0]), *b = outcome_row(second, r[1]);
        o->whole = !rows_part(o, a, b, parted, subject);
        if (o->whole) o->horizon = a[0];
    }
}

static void find_uncertainty(struct reference *o, const struct outcome *second, double uncertain,
                             struct subject *subject)
{
    int r[2] = {-1, -1};
    memset(o->uncertain, 0, sizeof *o->uncertain * (size_t)o->run.n);
    while (outcome_next(r, &o->run, second)) {
        const double *a = outcome_row(&o->run, r[0]), *b = outcome_row(second, r[1]);
        if (a[0] > o->horizon) break;
        for (int c = 0; c < o->run.n; c++) o->uncertain[c] = fmax(o->uncertain[c], share(o, c, fabs(a[c] - b[c])));
    }
    for (int c = 0; c < o->run.n; c++) {
        struct outcome_column *column = &subject->column[c];
        if (column->rate >= 0) o->apart = fmax(o->apart, o->uncertain[c]);
        if (!column->compared || o->uncertain[c] <= uncertain) continue;
        column->compared = false;
        if (o->left_out++ == 0) o->left_out_name = column->name;
    }
}

/* ---- the two runs ---- */

struct both {
    struct outcome run[2];
    struct setting setting[2];
    double most;
    bool last;
    const struct subject *subject;
    struct arena *life;
};

/* At its rate so far the run would not come half of the way for what it may cost. */
static bool is_hopeless(const void *self, const struct outcome *run)
{
    static const double SEEN = .1; /* of what it may cost: from then on the rate is believed */
    const struct both *o = self;
    const double start = o->subject->scene->start, way = o->subject->until - start;
    return run->seconds > SEEN * o->most && (run->reached - start) / run->seconds < .5 * way / o->most;
}

static enum status run_one(void *self, int i, int to, struct report *report)
{
    const struct both *o = self;
    struct outcome run;
    struct arena *life = arena_open();
    const struct outcome_watch watch = {.hopeless = is_hopeless, .self = o};
    enum status status =
        outcome_watched(&run, &o->setting[i], o->most, o->last ? NULL : &watch, o->subject, life, report);
    if (status == OK && !run.over && run.status != OK && run.status != E_VERDICT)
        status = fail(report, run.status, "no reference by %s: %.900s", o->setting[i].kind->name, run.report.text);
    if (status == OK) status = crew_tell(to, &run, sizeof run);
    if (status == OK) status = crew_tell(to, run.x, (size_t)run.rows * (size_t)run.n * sizeof *run.x);
    arena_close(life);
    return status;
}

/* From run_one(): the run first, then its rows. */
static enum status hear_one(void *self, int i, const void *bytes, size_t n, struct report *report)
{
    struct both *o = self;
    struct outcome *run = &o->run[i];
    (void)report;
    if (run->n == 0) {
        memcpy(run, bytes, sizeof *run);
        run->x = NULL;
        return OK;
    }
    run->x = TAKE(o->life, double, n / sizeof(double));
    memcpy(run->x, bytes, n);
    return OK;
}

static enum status run_both(struct reference *o, struct outcome *second, const struct subject *subject, double most,
                            bool last, struct arena *life, struct report *report)
{
    struct both both = {{{0}}, {o->first, o->second}, most, last, subject, life};
    const struct crew crew = {.n = 2, .self = &both, .work = run_one, .hear = hear_one};
    TRY(crew_run(&crew, life, report));
    o->run = both.run[0];
    o->seconds = both.run[0].seconds;
    o->work = both.run[0].work;
    o->spent += both.run[0].seconds + both.run[1].seconds;
    *second = both.run[1];
    return OK;
}

static double common_end(const struct reference *o, const struct outcome *second)
{
    return fmin(outcome_row(&o->run, o->run.rows - 1)[0], outcome_row(second, second->rows - 1)[0]);
}

/* Runs that turn out much dearer than predicted, as of motions that only a small tolerance resolves, are broken off,
 * and two are chosen anew by what those have cost, for what is left of `most`. */
static enum status run_until_enough(struct reference *o, struct outcome *second, struct candidates *among,
                                    struct subject *subject, double most, struct arena *life, struct report *report)
{
    const double start = subject->scene->start;
    for (int i = 1;; i++) {
        const bool last = i == ATTEMPTS || among->n == 0;
        TRY(reference_choose(o, among, subject, most, life, report));
        const double left = i == 1 ? most : most - (o->spent - among->spent);
        TRY(run_both(o, second, subject, EACH * fmax(left, .5 * most), last, life, report));
        candidates_learn(among, &o->first, &o->run);
        candidates_learn(among, &o->second, second);
        const double way = fmin(o->run.reached, second->reached) - start;
        if (last || !(o->run.over || second->over) ||
            (way >= .5 * (subject->until - start) && common_end(o, second) > start))
            return OK;
    }
}

/* Columns that are round-off beside the largest of their unit are not compared. */
static void leave_noise_out(const struct reference *o, struct subject *subject)
{
    static const double NOISE = 1e-11;
    for (int c = 0; c < o->run.n; c++) {
        struct outcome_column *column = subject->column;
        double most = 0;
        for (int i = 0; column[c].unit && i < o->run.n; i++)
            if (same_unit(&column[c], &column[i])) most = fmax(most, o->largest[i]);
        column[c].compared &= o->largest[c] >= NOISE * most;
    }
}

static void take_ranges(struct reference *o, const struct subject *subject, struct arena *life)
{
    o->uncertain = TAKE(life, double, o->run.n);
    o->least = TAKE(life, double, o->run.n);
    o->range = TAKE(life, double, o->run.n);
    o->largest = TAKE(life, double, o->run.n);
    find_ranges(o, &o->run, o->horizon);
    find_least(o, subject);
}

void reference_alone(struct reference *o, const struct outcome *run, const struct subject *subject, struct arena *life)
{
    *o = (struct reference){.run = *run, .horizon = outcome_row(run, run->rows - 1)[0]};
    take_ranges(o, subject, life);
}

bool reference_left(const struct reference *o, const struct outcome *run, double parted, const struct subject *subject)
{
    const int row = run->rows - 1;
    return row < o->run.rows && rows_part(o, outcome_row(&o->run, row), outcome_row(run, row), parted, subject);
}

void reference_up_to(struct reference *o, double end)
{
    o->horizon = end;
    find_ranges(o, &o->run, o->horizon);
}

void reference_between(struct reference *o, const struct outcome *second, double parted, double uncertain,
                       struct subject *subject, struct arena *life)
{
    o->horizon = outcome_row(&o->run, o->run.rows - 1)[0];
    take_ranges(o, subject, life);
    if (second->rows > o->run.rows) find_ranges(o, second, INFINITY); /* they part, and o->run was ended there */
    find_horizon(o, second, parted, subject);
    find_ranges(o, &o->run, o->horizon);
    find_uncertainty(o, second, uncertain, subject);
    leave_noise_out(o, subject);
}

enum status reference_make(struct reference *o, struct subject *subject, double most, struct arena *life,
                           struct report *report)
{
    struct outcome second;
    struct candidates among;
    *o = (struct reference){0};
    TRY(reference_candidates(&among, o, subject, most, life, report));
    TRY(run_until_enough(o, &second, &among, subject, most, life, report));
    const double start = subject->scene->start, end = common_end(o, &second);
    if (!(end > start))
        return fail(report, E_LIMIT,
                    "no reference: the budget takes %s and %s not even to the first record: raise --budget, or write "
                    "records more often",
                    o->first.kind->name, o->second.kind->name);
    if (o->run.over || second.over) o->cut = true;
    o->horizon = end;
    take_ranges(o, subject, life);
    find_horizon(o, &second, PARTED, subject);
    if (o->horizon - start < LEAST * (end - start))
        return fail(report, E_NUMERIC,
                    "%s and %s part after t = %g s: nothing to compare with (chaos, or a motion that no step resolves)",
                    o->first.kind->name, o->second.kind->name, o->horizon);
    find_ranges(o, &o->run, o->horizon);
    find_uncertainty(o, &second, UNCERTAIN, subject);
    leave_noise_out(o, subject);
    if (o->horizon < subject->until) subject->until = o->horizon;
    return OK;
}

void reference_compare(struct errors *e, const struct reference *o, const struct subject *subject,
                       const struct outcome *run)
{
    int r[2] = {-1, -1};
    bool any = false;
    double last = -INFINITY;
    *e = (struct errors){.fast = NAN, .slow = NAN, .column = -1, .instants = -1};
    while (outcome_next(r, &o->run, run)) {
        const double *a = outcome_row(&o->run, r[0]), *b = outcome_row(run, r[1]);
        if (a[0] > o->horizon * (1 + 1e-12)) break;
        last = a[0];
        e->instants++;
        for (int c = 0; c < o->run.n; c++) {
            const struct outcome_column *column = &subject->column[c];
            const double d = fabs(a[c] - b[c]), size = fmax(o->largest[c], o->least[c]);
            double *to = column->rate > 0 ? &e->fast : &e->slow;
            if (column->rate >= 0 && !(size > 0 ? d / size <= *to : *to >= 0)) *to = size > 0 ? d / size : 0;
            if (!column->compared || share(o, c, d) <= e->worst) continue;
            e->worst = share(o, c, d);
            e->absolute = d;
            e->column = c;
        }
    }
    for (int c = 0; c < o->run.n; c++) any |= subject->column[c].compared;
    if (!any) e->worst = e->absolute = NAN; /* nothing to be right in */
    if (last < o->horizon * (1 - 1e-9))
        e->fast = e->slow = e->worst = e->absolute = INFINITY; /* it stopped on the way */
}
