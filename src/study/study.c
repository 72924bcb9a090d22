/* study.c -- see study.h */
#include "study/study.h"

#include <math.h>
#include <string.h>

#include "base/crew.h"
#include "probe/modes.h"
#include "study/grid.h"

static const double REFERENCE = .5; /* of the budget */
static const double EQUAL = .3;     /* of it, in equal parts for all chains */
static const double WORTH = .05;    /* [s] runs that cost more than the reference and this are of no use */
static const double ENOUGH = 1e-8;  /* no error below this is asked for */
static const double DOUBTFUL = 10;  /* times the reference's uncertainty */

/* ---- one run, and a chain of them, in a child ------------------------------------------------------------------ */

struct work {
    const struct study *study;
    struct grid *grid;
    const struct study_options *options;
    double *share; /* [grid->n] of each chain, with its times [s] */
    struct study *into;
};

/* What a chain tells: a row, or where it ends. */
struct news {
    bool gap;
    struct study_row row;
    struct study_gap end;
};

/* How often a run of so many predicted seconds is timed. */
static int repeats(const struct study_options *options, double seconds)
{
    if (options->repeats >= 0) return options->repeats;
    return seconds < .1 ? 3 : seconds < .5 ? 2 : 1;
}

static void fill_row(struct study_row *row, const struct setting *setting, const struct outcome *run,
                     const struct study *o)
{
    *row = (struct study_row){.setting = *setting,
                              .seconds = run->seconds,
                              .work = run->work,
                              .cpu = NAN,
                              .effort = run->effort,
                              .energy = run->energy_share,
                              .status = run->status};
    reference_compare(&row->errors, &o->reference, &o->subject, run);
    const int c = row->errors.column;
    row->worst = c < 0 ? "" : o->subject.column[c].name;
    row->unit = c < 0 || !o->subject.column[c].unit ? "" : o->subject.column[c].unit;
    row->uncertain = c < 0 ? 0 : o->reference.uncertain[c];
    row->doubtful = row->errors.worst > 0 && row->errors.worst < DOUBTFUL * row->uncertain;
}

/* One run in at most so many predicted seconds; *over: it would be more. */
static enum status run_one(struct study_row *row, bool *over, const struct setting *setting, double most,
                           const struct study *o, struct report *report)
{
    struct outcome run;
    struct arena *life = arena_open();
    enum status status = outcome_run(&run, setting, most, &o->subject, life, report);
    if (status == OK) {
        fill_row(row, setting, &run, o);
        *over = run.over;
        if (run.status == E_LIMIT && !run.over)
            status = fail(report, run.status, "%s: %.900s", setting->kind->name, run.report.text);
        else if (row->errors.instants < 1 && run.status != E_NUMERIC && !run.over)
            status = fail(report, E_USAGE, "step %g s: its records and the reference's have no instant in common",
                          setting->step);
    }
    arena_close(life);
    return status;
}

/* Of a ladder: what costs more than the reference is of no use. */
static double worth(const struct chain *chain, const struct study *o)
{
    return chain->ladder ? fmax(WORTH, o->reference.seconds) : INFINITY;
}

static enum status tell_gap(int to, struct study_gap gap)
{
    struct news news;
    memset(&news, 0, sizeof news);
    news.gap = true;
    news.end = gap;
    return crew_tell(to, &news, sizeof news);
}

/* Does a ladder end here? */
static bool enough(const struct study_row *row)
{
    return row->errors.worst <= ENOUGH || row->doubtful;
}

/* A step that is too long for a scheme, and says nothing but that: one of two rates is shown all the same. */
static bool useless(const struct chain *chain, const struct study_row *row)
{
    return chain->ladder && row->status != OK && row->status != E_VERDICT && !row->setting.kind->two_rates;
}

static enum status work_chain(void *self, int i, int to, struct report *report)
{
    const struct work *o = self;
    const struct chain *chain = &o->grid->chain[i];
    const double most = worth(chain, o->study), unit = o->study->subject.price.evaluation;
    double left = o->share[i], last = chain->last;
    bool none = chain->from == 0;
    for (int k = left > 0 ? chain->from : chain->n; k < chain->n; k++) {
        const struct setting *setting = &chain->setting[k];
        struct news news;
        bool over;
        memset(&news, 0, sizeof news);
        const double next = k ? last * grid_growth(setting - 1, setting) : 0, times = 1 + repeats(o->options, next);
        if (next > most || next * times > left)
            return tell_gap(to, (struct study_gap){*setting, i, none, !(next > most), next / unit});
        const double allowed = fmin(left / 2, most);
        TRY(run_one(&news.row, &over, setting, allowed, o->study, report));
        if (over) return tell_gap(to, (struct study_gap){*setting, i, none, left / 2 < most, news.row.work});
        if (!useless(chain, &news.row)) {
            TRY(crew_tell(to, &news, sizeof news));
            none = false;
        }
        last = news.row.seconds;
        left -= last * (1 + repeats(o->options, last));
        if (chain->ladder && enough(&news.row)) break;
    }
    return OK;
}

/* ---- the rows, in the caller ----------------------------------------------------------------------------------- */

/* The same numbers: one of two schemes is the other here, or a tolerance changes nothing, since records keep the steps
 * shorter than it does. */
static bool same(const struct study_row *a, const struct study_row *b)
{
    const struct setting *x = &a->setting, *y = &b->setting;
    const bool step = isfinite(x->step), apart = x->kind != y->kind;
    if (step != isfinite(y->step) || (step && x->step != y->step) || (step && !apart)) return false;
    if (apart && !step && x->tolerance != y->tolerance) return false;
    return a->work == b->work && a->errors.worst == b->errors.worst && a->errors.slow == b->errors.slow;
}

static void show_progress(const struct study *o, const char *what, FILE *to)
{
    if (!to) return;
    if (what)
        fprintf(to, "\r\033[K%s: %d runs", what, o->nrow);
    else
        fputs("\r\033[K", to);
    (void)fflush(to);
}

static enum status hear_news(void *self, int i, const void *bytes, size_t n, struct report *report)
{
    const struct work *w = self;
    struct study *o = w->into;
    const struct news *news = bytes;
    (void)n;
    if (news->gap) {
        o->gap = arena_more(o->life, o->gap, o->ngap, &o->gaps, sizeof *o->gap);
        o->gap[o->ngap++] = news->end;
        return OK;
    }
    for (int k = 0; k < o->nrow && w->grid->chain[i].ladder; k++)
        if (same(&o->row[k], &news->row)) return OK;
    o->row = arena_more(o->life, o->row, o->nrow, &o->rows, sizeof *o->row);
    o->row[o->nrow++] = news->row;
    show_progress(o, "errors", w->options->progress);
    return w->options->repeats == 0 ? w->options->done(w->options->self, &news->row, report) : OK;
}

/* ---- what is left of the budget goes to the best of those that it has cut off ---------------------------------- */

static double spent(const struct study *o, const struct study_options *options)
{
    double seconds = o->reference.spent;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        seconds += r->seconds * (1 + repeats(options, r->seconds));
    return seconds;
}

/* The finest row of a chain; NULL: none. */
static const struct study_row *finest(const struct study *o, const struct chain *chain)
{
    const struct study_row *last = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        for (int k = 0; k < chain->n; k++)
            if (grid_same(&r->setting, &chain->setting[k]) && r->status == OK) last = r;
    return last;
}

/* What an error of a millionth would cost by this chain: what its trial has foretold, or going by its order; INFINITY:
 * nobody knows. */
static double foretold(const struct study *o, const struct grid *grid, const struct study_gap *gap)
{
    static const double WANTED = 1e-6;
    const struct study_row *last = finest(o, &grid->chain[gap->chain]);
    if (!gap->budget) return INFINITY;
    for (const struct trialled *t = o->reference.trial; t < o->reference.trial + o->reference.ntrial; t++)
        if (t->kind == gap->from.kind) return t->rate * (o->subject.until - o->subject.scene->start);
    if (!last || !(last->errors.worst < 1)) return INFINITY;
    return last->seconds * pow(fmax(1, last->errors.worst / WANTED), 1. / last->setting.kind->order);
}

/* Goes on from the gap, which is one no more. */
static void go_on(struct study *o, struct grid *grid, int gap, double *share, double seconds)
{
    struct chain *chain = &grid->chain[o->gap[gap].chain];
    share[o->gap[gap].chain] = seconds;
    const struct study_row *last = finest(o, chain);
    chain->last = last ? last->seconds : 0;
    while (!grid_same(&chain->setting[chain->from], &o->gap[gap].from)) chain->from++;
    o->gap[gap] = o->gap[--o->ngap];
}

static bool choose_best(struct study *o, struct grid *grid, double *share, double seconds)
{
    enum { BEST = 2 };
    int chosen = 0;
    memset(share, 0, sizeof *share * (size_t)grid->n);
    for (; chosen < BEST; chosen++) {
        int best = -1;
        for (int i = 0; i < o->ngap; i++)
            if (isfinite(foretold(o, grid, &o->gap[i])) && share[o->gap[i].chain] == 0 &&
                (best < 0 || foretold(o, grid, &o->gap[i]) < foretold(o, grid, &o->gap[best])))
                best = i;
        if (best < 0) break;
        go_on(o, grid, best, share, seconds / BEST);
    }
    return chosen > 0;
}

static enum status run_grid(struct study *o, struct grid *grid, const struct study_options *options, struct arena *life,
                            struct report *report)
{
    struct work work = {o, grid, options, TAKE(life, double, grid->n), o};
    const struct crew crew = {.n = grid->n, .self = &work, .work = work_chain, .hear = hear_news};
    for (int i = 0; i < grid->n; i++) work.share[i] = EQUAL * options->budget / grid->n;
    TRY(crew_run(&crew, life, report));
    const double left = options->budget - spent(o, options);
    if (!(left > 0) || !choose_best(o, grid, work.share, left)) return OK;
    return crew_run(&crew, life, report);
}

/* One at a time, the machine to itself as far as that is ours to say. */
static enum status take_times(struct study *o, const struct study_options *options, struct report *report)
{
    enum status status = OK;
    for (struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        double cpu = INFINITY;
        for (int i = repeats(options, r->seconds); i > 0 && status == OK; i--) {
            struct outcome run;
            struct arena *life = arena_open();
            status = outcome_run(&run, &r->setting, INFINITY, &o->subject, life, report);
            if (status == OK) cpu = fmin(cpu, run.cpu);
            arena_close(life);
        }
        if (status == OK) r->cpu = cpu;
        show_progress(o, NULL, options->progress);
        TRY(options->done(options->self, r, report));
        if (r + 1 < o->row + o->nrow) show_progress(o, "times", options->progress);
    }
    return status;
}

/* Quickest vibration at the start. */
static double find_fastest(const struct subject *subject, const struct setting *setting)
{
    struct sim sim;
    struct modes modes = {0};
    struct step_options how;
    struct report none = {0};
    const struct integrate plan = outcome_plan(&how, setting, subject);
    const struct sim_options options = {.version = subject->version, .counting = true};
    struct arena *scratch = arena_open();
    double fastest = 0;
    if (sim_open(&sim, subject->scene, &plan, &options, subject->diags, scratch, &none) == OK &&
        modes_find(&modes, &sim, scratch, &none) == OK && modes.n > 0)
        fastest = fmax(0, modes.mode[modes.n - 1].omega);
    arena_close(scratch);
    return fastest;
}

static void print_reference(const struct reference *o, const struct subject *subject, double until, FILE *to)
{
    fprintf(to, "reference: %s to %g; %s to %g differs from it by %.2g (relative, worst coordinate)\n",
            o->first.kind->name, o->first.tolerance, o->second.kind->name, o->second.tolerance, o->apart);
    if (!o->whole) fprintf(to, "they part after t = %.6g s: errors are compared up to there\n", o->horizon);
    if (o->cut)
        fprintf(to, "the budget takes it to t = %.6g s of %.6g: errors are compared up to there\n", subject->until,
                until);
    if (o->left_out)
        fprintf(to, "%d column%s of the deck %s known to neither within 1 %% of %s range, and %s not compared: %s%s\n",
                o->left_out, o->left_out > 1 ? "s" : "", o->left_out > 1 ? "are" : "is",
                o->left_out > 1 ? "their" : "its", o->left_out > 1 ? "are" : "is", o->left_out_name,
                o->left_out > 1 ? ", ..." : "");
}

/* Deck errors of settings are told before anything is run. */
static enum status check_grid(const struct grid *grid, const struct subject *subject, struct report *report)
{
    for (int i = 0; i < grid->n; i++)
        for (int k = 0; k < grid->chain[i].n; k++)
            if (!grid->chain[i].ladder || k == 0) TRY(outcome_check(&grid->chain[i].setting[k], subject, report));
    return OK;
}

static void find_own(struct study *o)
{
    struct setting own;
    if (!grid_own(&own, &o->subject)) return;
    for (struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (grid_same(&r->setting, &own)) o->own = r;
}

enum status study_run(struct study *o, const struct scene *scene, const struct study_options *options,
                      struct diags *diags, struct arena *life, struct report *report)
{
    struct grid grid;
    const double until = scene->integrate.until;
    *o = (struct study){.life = life};
    TRY(subject_open(&o->subject, scene, options->version, NULL, diags, life, report));
    TRY(grid_make(&grid, options, &o->subject, life, report));
    TRY(check_grid(&grid, &o->subject, report));
    show_progress(o, "reference", options->progress);
    TRY(reference_make(&o->reference, &o->subject, REFERENCE * options->budget, life, report));
    show_progress(o, NULL, options->progress);
    if (options->log) print_reference(&o->reference, &o->subject, until, options->log);
    enum status status = run_grid(o, &grid, options, life, report);
    find_own(o);
    show_progress(o, NULL, options->progress);
    for (int i = 0; i < o->ngap && o->fastest == 0; i++)
        if (o->gap[i].all) o->fastest = find_fastest(&o->subject, &o->reference.first);
    if (status == OK && options->repeats != 0) return take_times(o, options, report);
    if (options->repeats != 0)
        for (int i = 0; i < o->nrow; i++) TRY(options->done(options->self, &o->row[i], report));
    return status;
}
