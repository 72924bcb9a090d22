/* flip.c -- see flip.h */
#include "study/flip.h"

#include <math.h>
#include <string.h>

#include "study/price.h"

struct keeper {
    struct flip *to;
    struct arena *life;
};

static enum status keep_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct keeper *k = sink->self;
    (void)report;
    k->to->n = meta->n;
    return OK;
}

static enum status keep_row(struct sink *sink, const double *x, struct report *report)
{
    struct keeper *k = sink->self;
    struct flip *o = k->to;
    (void)report;
    o->x = arena_more(k->life, o->x, o->rows, &o->capacity, (size_t)o->n * sizeof *o->x);
    memcpy(o->x + (size_t)o->rows++ * (size_t)o->n, x, (size_t)o->n * sizeof *x);
    if (o->sim.ndeflection) o->spin = fmax(o->spin, sim_spin(&o->sim));
    return OK;
}

static enum status keep_tick(struct sink *sink, double now, struct report *report)
{
    (void)sink, (void)now, (void)report;
    return OK;
}

static const struct sink_ops keeping = {.meta = keep_meta, .row = keep_row, .tick = keep_tick};

static void note_columns(struct flip *o, struct arena *life)
{
    o->columns = o->sim.columns;
    o->compared = TAKE(life, bool, o->n);
    for (int i = 0; i < o->n; i++) o->compared[i] = sim_column_compared(&o->sim, i);
}

enum status flip_run(struct flip *o, const struct scene *scene, double until, struct diags *diags, struct arena *life,
                     struct report *report)
{
    const struct sim_options options = {0};
    struct integrate plan = scene->integrate;
    struct report own = {0};
    struct price price;
    *o = (struct flip){0};
    struct keeper keeper = {o, life};
    struct sink sink = {&keeping, &keeper};
    if (until > 0) plan.until = fmin(until, plan.until);
    TRY(sim_open(&o->sim, scene, &plan, &options, diags, life, report));
    price_find(&price, &o->sim);
    o->status = sim_run(&o->sim, &sink, &own);
    o->until = o->sim.x.t;
    o->steps = (double)o->sim.stepper.effort.majors;
    o->seconds = price_seconds(&price, o->sim.stepper.kind, &o->sim.stepper.effort) +
                 price_books(&price, &o->sim.stepper.effort);
    note_columns(o, life);
    return OK;
}

static double share(const struct flip *a, int i, const struct flip *b, int k)
{
    double most = 0, change = 0;
    for (int row = 0; row < a->rows && row < b->rows; row++) {
        const double x = a->x[row * a->n + i], y = b->x[row * b->n + k];
        most = fmax(most, fabs(x));
        change = fmax(change, fabs(y - x));
    }
    return most > 0 ? change / most : change > 0 ? INFINITY : 0;
}

double flip_change(const char **column, const struct flip *a, const struct flip *b)
{
    double worst = 0;
    *column = NULL;
    for (int i = 1; i < a->n; i++) {
        const int k = columns_find(b->columns, b->n, a->columns[i].name);
        if (!a->compared[i] || k < 0) continue;
        const double x = share(a, i, b, k);
        if (*column && !(x > worst)) continue;
        worst = x;
        *column = a->columns[i].name;
    }
    return worst;
}
