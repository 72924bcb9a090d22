/* outcome.c -- see outcome.h */
#include "study/outcome.h"

#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "base/text.h"
#include "multirate/schemes.h"

/* Rows as they come, and whether to go on. */
struct keeper {
    struct outcome *to;
    const struct sim *sim;
    const struct price *price;
    double most; /* [s] */
    const struct outcome_watch *watch;
    struct arena *life;
};

static enum status keep_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct keeper *k = sink->self;
    (void)report;
    k->to->n = meta->n;
    return OK;
}

static enum status look(struct keeper *k)
{
    const struct stepper *s = &k->sim->stepper;
    const struct outcome_watch *w = k->watch;
    k->to->seconds = price_seconds(k->price, s->kind, &s->effort);
    k->to->reached = k->sim->x.t;
    k->to->over = !(k->to->seconds <= k->most) || (w && w->hopeless && w->hopeless(w->self, k->to));
    return k->to->over ? E_LIMIT : OK;
}

void outcome_keep(struct outcome *o, const double *x, struct arena *life)
{
    o->x = arena_more(life, o->x, o->rows, &o->capacity, (size_t)o->n * sizeof *o->x);
    memcpy(o->x + (size_t)o->rows++ * (size_t)o->n, x, (size_t)o->n * sizeof *x);
}

static enum status keep_row(struct sink *sink, const double *x, struct report *report)
{
    struct keeper *k = sink->self;
    (void)report;
    outcome_keep(k->to, x, k->life);
    TRY(look(k));
    k->to->over = k->watch && k->watch->enough && k->watch->enough(k->watch->self, k->to);
    return k->to->over ? E_LIMIT : OK;
}

static enum status keep_passed(struct sink *sink, struct report *report)
{
    (void)report;
    return look(sink->self);
}

static const struct sink_ops memory_ops = {.meta = keep_meta, .row = keep_row, .passed = keep_passed};

bool by_tolerance(const struct stepper_kind *kind)
{
    return key_find(kind->keys, "tolerance") != NULL;
}

bool setting_together(const struct setting *a, const struct setting *b)
{
    return a->kind == b->kind && a->ratio == b->ratio && a->order == b->order;
}

struct integrate outcome_plan(struct step_options *how, const struct setting *setting, const struct subject *subject)
{
    struct integrate plan = subject->scene->integrate;
    *how = *(const struct step_options *)plan.options;
    how->tolerance = isfinite(setting->tolerance) ? setting->tolerance : 0;
    if (setting->order > 0) how->order = setting->order;
    if (how->tolerance > 0) how->order = 2; /* what a tolerance is for */
    if (key_find(setting->kind->keys, "gamma") && strcmp(plan.scheme, setting->kind->name) != 0)
        how->rho_infinity = 1; /* Newmark's is of order 1 where it damps: not for another scheme's wish */
    plan.scheme = setting->kind->name;
    plan.options = how;
    plan.until = subject->until;
    plan.ratio = setting->ratio;
    plan.step = isfinite(setting->step) ? setting->step : subject->every;
    return plan;
}

static const struct sim_options *quiet(struct sim_options *o, const struct subject *subject)
{
    *o = (struct sim_options){.version = subject->version, .rest = subject->rest, .counting = true};
    return o;
}

enum status outcome_check(const struct setting *setting, const struct subject *subject, struct report *report)
{
    struct sim_options options;
    struct step_options how;
    struct sim sim;
    const struct integrate plan = outcome_plan(&how, setting, subject);
    struct arena *scratch = arena_open();
    const enum status status =
        sim_open(&sim, subject->scene, &plan, quiet(&options, subject), subject->diags, scratch, report);
    arena_close(scratch);
    return status;
}

enum status outcome_run(struct outcome *o, const struct setting *setting, double most, const struct subject *subject,
                        struct arena *life, struct report *report)
{
    return outcome_watched(o, setting, most, NULL, subject, life, report);
}

enum status outcome_watched(struct outcome *o, const struct setting *setting, double most,
                            const struct outcome_watch *watch, const struct subject *subject, struct arena *life,
                            struct report *report)
{
    *o = (struct outcome){0};
    struct sim_options options;
    struct step_options how;
    struct sim sim;
    const struct integrate plan = outcome_plan(&how, setting, subject);
    struct keeper keeper = {o, &sim, &subject->price, most, watch, life};
    struct sink sink = {&memory_ops, &keeper};
    TRY(sim_open(&sim, subject->scene, &plan, quiet(&options, subject), subject->diags, life, report));
    o->status = sim_run(&sim, &sink, &o->report);
    o->reached = sim.x.t;
    o->effort = sim.stepper.effort;
    o->energy_share = ledger_share(&sim.ledger);
    o->cpu = sim.cpu;
    o->seconds = price_seconds(&subject->price, setting->kind, &o->effort);
    o->work = round(o->seconds / subject->price.evaluation);
    return stop_limit() ? fail(report, stop_status(), "the limit of %s is reached", stop_limit()) : stop_status();
}

/* Any that opens whatever the deck says of steps. */
static const struct stepper_kind *any_kind(const struct scene *scene)
{
    int i = 0;
    if (scene->ncontact) return stepper_find("midpoint");
    while (!(by_tolerance(stepper_kinds[i]) && stepper_kinds[i]->adaptive && !stepper_kinds[i]->full)) i++;
    return stepper_kinds[i];
}

static const double *keep_rest(const struct sim *sim, struct arena *life)
{
    double *q = TAKE(life, double, sim->whole ? sim->whole->nq : sim->model->nq);
    if (!sim->whole) memcpy(q, sim->x.q, sizeof *q * (size_t)sim->model->nq);
    for (int i = 0; sim->whole && i < sim->whole->n; i++)
        if (sim->from_whole[i] >= 0) q[i] = sim->x.q[sim->from_whole[i]];
    return q;
}

bool same_unit(const struct outcome_column *a, const struct outcome_column *b)
{
    return text_same(a->unit, b->unit);
}

struct outcome_column *outcome_columns(const struct sim *sim, struct arena *life)
{
    struct outcome_column *column = TAKE(life, struct outcome_column, sim->chosen.n);
    for (int i = 0; i < sim->chosen.n; i++)
        column[i] = (struct outcome_column){sim->columns[i].name, sim->columns[i].unit, sim_column_rate(sim, i),
                                            sim_column_compared(sim, i), sim_column_usual(sim, i)};
    return column;
}

enum status subject_open(struct subject *o, const struct scene *scene, const char *version, const double *rest,
                         struct diags *diags, struct arena *life, struct report *report)
{
    const struct integrate *plan = &scene->integrate;
    const double H = plan->step * plan->ratio * (scene->output.every_steps ? (double)scene->output.every_steps : 1);
    const struct setting any = {any_kind(scene), 1e-3, NAN, 1, 0};
    struct sim_options options;
    struct step_options how;
    struct sim sim;
    *o = (struct subject){.scene = scene, .version = version, .until = plan->until, .rest = rest, .diags = diags};
    o->every = scene->output.every > 0 ? scene->output.every : H > 0 ? H : (plan->until - scene->start) / 100;
    const struct integrate open = outcome_plan(&how, &any, o);
    TRY(sim_open(&sim, scene, &open, quiet(&options, o), diags, life, report));
    o->n = sim.stepper.ode->n;
    if (scene->at_rest) o->rest = keep_rest(&sim, life);
    o->ns = sim.stepper.ode->ns;
    o->ncolumn = sim.chosen.n;
    o->column = outcome_columns(&sim, life);
    price_find(&o->price, &sim);
    return OK;
}

bool outcome_next(int *r, const struct outcome *a, const struct outcome *b)
{
    static const double SAME = 1e-9; /* of t: one instant */
    for (r[0]++, r[1]++; r[0] < a->rows && r[1] < b->rows;) {
        const double ta = outcome_row(a, r[0])[0], tb = outcome_row(b, r[1])[0];
        if (fabs(ta - tb) <= SAME * fabs(tb)) return true;
        r[ta < tb ? 0 : 1]++;
    }
    return false;
}
