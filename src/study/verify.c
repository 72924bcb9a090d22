/* verify.c -- see verify.h */
#include "study/verify.h"

#include <math.h>
#include <string.h>

static enum status take_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct verify *o = sink->self;
    o->first.n = meta->n;
    return sink_meta(o->to, meta, report);
}

static enum status take_row(struct sink *sink, const double *x, struct report *report)
{
    struct verify *o = sink->self;
    outcome_keep(&o->first, x, o->life);
    return o->to->ops->row(o->to, x, report);
}

static enum status take_event(struct sink *sink, double t, const char *kind, const char *text, struct report *report)
{
    struct verify *o = sink->self;
    return sink_event(o->to, t, kind, text, report);
}

static enum status take_tick(struct sink *sink, double now, struct report *report)
{
    struct verify *o = sink->self;
    return sink_tick(o->to, now, report);
}

static enum status take_second_row(struct sink *sink, const double *x, struct report *report)
{
    struct verify *o = sink->self;
    (void)report;
    outcome_keep(&o->second.run, x, o->life);
    return OK;
}

static const struct sink_ops second_ops = {.row = take_second_row};

/* ---- the second run -------------------------------------------------------------------------------------------- */

/* Its scene, with the records of the first, and its plan. */
static struct integrate plan_finer(struct scene *scene, struct step_options *how, struct verify *o)
{
    struct integrate plan = o->sim->plan;
    *scene = *o->sim->scene;
    *how = *(const struct step_options *)plan.options;
    plan.options = how;
    if (o->sim->stepper.kind->adaptive) {
        o->finer = how->tolerance /= 10;
        return plan;
    }
    o->finer = plan.step /= 2;
    if (!(scene->output.every > 0))
        scene->output.every_steps = 2 * (scene->output.every_steps ? scene->output.every_steps : 1);
    return plan;
}

/* Largest differences in the columns' units. */
static void differ(struct verify *o)
{
    int r[2] = {-1, -1};
    o->differs = TAKE(o->life, double, o->first.n);
    while (outcome_next(r, &o->second.run, &o->first)) {
        const double *a = outcome_row(&o->second.run, r[0]), *b = outcome_row(&o->first, r[1]);
        for (int i = 0; i < o->first.n; i++) o->differs[i] = fmax(o->differs[i], fabs(a[i] - b[i]));
        o->common++;
    }
}

static void compare(struct verify *o)
{
    struct reference *r = &o->second;
    o->subject =
        (struct subject){.until = o->sim->x.t, .ncolumn = o->sim->chosen.n, .column = outcome_columns(o->sim, o->life)};
    differ(o);
    reference_between(r, &o->first, INFINITY, INFINITY, &o->subject, o->life);
    o->worst = -1;
    for (int i = 0; i < o->subject.ncolumn; i++)
        if (o->subject.column[i].compared && (o->worst < 0 || r->uncertain[i] > r->uncertain[o->worst])) o->worst = i;
    o->done = true;
}

static enum status run_finer(struct verify *o, struct report *report)
{
    struct sim sim;
    struct scene scene;
    struct step_options how;
    struct report why = {0};
    struct sink sink = {&second_ops, o};
    o->second.run.n = o->first.n;
    const struct integrate plan = plan_finer(&scene, &how, o);
    const struct sim_options options = {.version = o->sim->options.version, .general = o->sim->options.general};
    enum status status = sim_open(&sim, &scene, &plan, &options, o->diags, o->life, &why);
    if (status == OK) status = sim_run(&sim, &sink, &why);
    if (status == OK || status == E_VERDICT) {
        compare(o);
        return OK;
    }
    return fail(report, status, "--verify: the second run, at %s %g: %.900s",
                o->sim->stepper.kind->adaptive ? "tolerance" : "step", o->finer, why.text);
}

/* ---- told ------------------------------------------------------------------------------------------------------ */

static const char *finer_key(const struct verify *o)
{
    return o->sim->stepper.kind->adaptive ? "verified_tolerance" : "verified_step";
}

static int facts(const struct verify *o, struct pair *fact)
{
    const struct subject *s = &o->subject;
    int n = 0;
    fact[n++] = pair_number(finer_key(o), o->finer);
    fact[n++] = pair_number("verified_difference", o->worst < 0 ? NAN : o->second.uncertain[o->worst]);
    fact[n++] = pair_text("verified_column", o->worst < 0 ? NULL : s->column[o->worst].name);
    for (int i = 0; i < s->ncolumn; i++)
        if (s->column[i].compared)
            fact[n++] = pair_number(arena_print(o->life, "difference.%s", s->column[i].name), o->second.uncertain[i]);
    return n;
}

static enum status take_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    enum { OWN = 3 };
    struct verify *o = sink->self;
    const bool whole = o->sim->status == OK || o->sim->status == E_VERDICT;
    enum status status = whole ? run_finer(o, report) : OK;
    const int most = summary->n + OWN + (o->done ? o->subject.ncolumn : 0);
    struct pair *all = TAKE(o->life, struct pair, most);
    memcpy(all, summary->facts, (size_t)summary->n * sizeof *all);
    const struct run_summary more = {.n = summary->n + (o->done ? facts(o, all + summary->n) : 0), .facts = all};
    const enum status ended = sink_end(o->to, &more, report);
    return status != OK ? status : ended;
}

static const struct sink_ops ops = {
    .meta = take_meta, .row = take_row, .event = take_event, .end = take_end, .tick = take_tick};

void verify_open(struct verify *o, struct sim *sim, struct sink *to, struct diags *diags, struct arena *life)
{
    *o = (struct verify){.to = to, .sim = sim, .diags = diags, .life = life, .worst = -1};
    o->sink = (struct sink){&ops, o};
}

/* What does not change in the second run has no range there. */
static void print_worst(const struct verify *o, FILE *to)
{
    const struct outcome_column *c = &o->subject.column[o->worst];
    const double part = o->second.uncertain[o->worst];
    if (isfinite(part))
        fprintf(to, "most of all '%s', by %.2g of its range\n", c->name, part);
    else
        fprintf(to, "most of all '%s', by %.3g%s%s, which does not change in the second run\n", c->name,
                o->differs[o->worst], c->unit ? " " : "", c->unit ? c->unit : "");
}

void verify_print(const struct verify *o, FILE *to)
{
    const struct reference *r = &o->second;
    if (!o->done) return;
    fprintf(to, "verified by a second run at %s %g: what differs, at most, at the %d records that both have\n",
            o->sim->stepper.kind->adaptive ? "tolerance" : "step", o->finer, o->common);
    fprintf(to, "%-28s %12s %12s  %s\n", "column", "difference", "of its range", "unit");
    for (int i = 0; i < o->subject.ncolumn; i++) {
        const struct outcome_column *c = &o->subject.column[i];
        if (!c->compared) continue;
        fprintf(to, "%-28s %12.3g %12.2g  %s\n", c->name, o->differs[i], r->uncertain[i], c->unit ? c->unit : "");
    }
    if (o->worst >= 0) print_worst(o, to);
}
