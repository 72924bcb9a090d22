/* outcome.c -- see outcome.h */
#include "study/outcome.h"

#include <math.h>
#include <string.h>

#include "base/stop.h"

static enum status keep_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct outcome *o = sink->self;
    (void)report;
    o->n = meta->n;
    o->rows = 0;
    return OK;
}

static enum status keep_row(struct sink *sink, const double *x, struct report *report)
{
    struct outcome *o = sink->self;
    (void)report;
    o->x = arena_more(o->life, o->x, o->rows, &o->capacity, (size_t)o->n * sizeof *o->x);
    memcpy(o->x + (size_t)o->rows++ * (size_t)o->n, x, (size_t)o->n * sizeof *x);
    return OK;
}

static enum status keep_event(struct sink *sink, double t, const char *kind, const char *text, struct report *report)
{
    (void)sink, (void)t, (void)kind, (void)text, (void)report;
    return OK;
}

static enum status keep_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    (void)sink, (void)summary, (void)report;
    return OK;
}

static enum status keep_tick(struct sink *sink, double now, struct report *report)
{
    (void)sink, (void)now, (void)report;
    return OK;
}

static const struct sink_ops memory_ops = {keep_meta, keep_row, keep_event, keep_end, keep_tick};

/* Evaluations of the fast part count as the share of coordinates that is fast. */
static double work_of(const struct sim *sim)
{
    static const double PRICE = 3; /* of a matrix, where the system does not know it */
    const struct ode2 *o = sim->stepper.ode;
    const struct effort *e = &sim->stepper.effort;
    const double fast = o->n > 0 ? (double)o->ns / o->n : 0, price = o->price > 0 ? o->price : PRICE;
    return (double)e->slow * (1 - fast) + (double)e->fast * fast + (double)e->factors * price;
}

static void note(struct outcome *o, const struct sim *sim, struct arena *life)
{
    o->n = sim->chosen.n;
    o->column = TAKE(life, struct outcome_column, o->n);
    for (int i = 0; i < o->n; i++)
        o->column[i] =
            (struct outcome_column){sim->columns[i].name, sim_column_rate(sim, i), sim_column_compared(sim, i)};
    o->effort = sim->stepper.effort;
    o->energy_share = ledger_share(&sim->ledger);
    o->cpu = sim->cpu;
    o->work = work_of(sim);
}

enum status outcome_run(struct outcome *o, const struct scene *scene, const struct integrate *plan, const char *version,
                        struct diags *diags, struct arena *life, struct report *report)
{
    const struct sim_options quiet = {.version = version, .counting = true};
    struct sim sim;
    *o = (struct outcome){.life = life};
    TRY(sim_open(&sim, scene, plan, &quiet, diags, life, report));
    struct sink sink = {&memory_ops, o};
    o->status = sim_run(&sim, &sink, &o->report);
    note(o, &sim, life);
    return stop_limit() ? fail(report, stop_status(), "the limit of %s is reached", stop_limit()) : stop_status();
}

struct integrate outcome_plan(struct step_options *how, const char *scheme, double tolerance, const struct scene *scene,
                              double every)
{
    struct integrate plan = scene->integrate;
    *how = *(const struct step_options *)plan.options;
    how->tolerance = tolerance;
    plan.scheme = scheme;
    plan.options = how;
    plan.ratio = 1;
    plan.step = every;
    return plan;
}

enum status outcome_size(int *n, const struct scene *scene, const struct integrate *plan, struct diags *diags,
                         struct report *report)
{
    const struct sim_options quiet = {.counting = true};
    struct arena *life = arena_open();
    struct sim sim;
    const enum status status = sim_open(&sim, scene, plan, &quiet, diags, life, report);
    if (status == OK) *n = sim.stepper.ode->n;
    arena_close(life);
    return status;
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
