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
    k->to->kept.n = meta->n;
    return OK;
}

static enum status keep_row(struct sink *sink, const double *x, struct report *report)
{
    struct keeper *k = sink->self;
    struct flip *o = k->to;
    (void)report;
    outcome_keep(&o->kept, x, k->life);
    if (o->sim.ndeflection) o->spin = fmax(o->spin, sim_spin(&o->sim));
    return OK;
}

static const struct sink_ops keeping = {.meta = keep_meta, .row = keep_row};

enum status flip_run(struct flip *o, const struct scene *scene, double until, struct diags *diags, struct arena *life,
                     struct report *report)
{
    const struct sim_options options = {0};
    struct integrate plan = scene->integrate;
    struct price price, counted;
    *o = (struct flip){0};
    struct keeper keeper = {o, life};
    struct sink sink = {&keeping, &keeper};
    if (until > 0) plan.until = fmin(until, plan.until);
    TRY(sim_open(&o->sim, scene, &plan, &options, diags, life, report));
    price_find(&price, &o->sim);
    price_count(&counted, &o->sim);
    o->kept.status = sim_run(&o->sim, &sink, &o->kept.report);
    o->kept.effort = o->sim.stepper.effort;
    o->kept.seconds = price_whole(&price, o->sim.stepper.kind, &o->kept.effort);
    o->instructions = price_whole(&counted, o->sim.stepper.kind, &o->kept.effort);
    o->until = o->sim.x.t;
    o->column = outcome_columns(&o->sim, life);
    return OK;
}

static double largest(const struct outcome *a, int i)
{
    double most = 0;
    for (int row = 0; row < a->rows; row++) most = fmax(most, fabs(outcome_row(a, row)[i]));
    return most;
}

double flip_usual(const struct flip *a, int i, const struct flip *b, int k)
{
    static const double LOST = 1e-9;
    double most = 0;
    for (int c = 1; c < a->kept.n; c++)
        if (same_unit(&a->column[c], &a->column[i])) most = fmax(most, largest(&a->kept, c));
    most = fmax(largest(&a->kept, i), LOST * most);
    return most > 0 ? most : largest(&b->kept, k);
}

int flip_column(const struct flip *o, const char *name)
{
    for (int i = 0; i < o->kept.n; i++)
        if (strcmp(o->column[i].name, name) == 0) return i;
    return -1;
}

static double change(const struct outcome *a, int i, const struct outcome *b, int k)
{
    double most = 0;
    for (int row[2] = {-1, -1}; outcome_next(row, a, b);)
        most = fmax(most, fabs(outcome_row(b, row[1])[k] - outcome_row(a, row[0])[i]));
    return most;
}

static int common_times(const struct outcome *a, const struct outcome *b)
{
    int n = 0;
    for (int row[2] = {-1, -1}; outcome_next(row, a, b);) n++;
    return n;
}

double flip_change(const char **column, const struct flip *a, const struct flip *b)
{
    double worst = 0;
    *column = NULL;
    if (common_times(&a->kept, &b->kept) < 2) return NAN; /* the start tells nothing */
    for (int i = 1; i < a->kept.n; i++) {
        const int k = flip_column(b, a->column[i].name);
        if (!a->column[i].compared || k < 0) continue;
        const double moved = change(&a->kept, i, &b->kept, k), x = moved > 0 ? moved / flip_usual(a, i, b, k) : 0;
        if (*column && !(x > worst)) continue;
        worst = x;
        *column = a->column[i].name;
    }
    return worst;
}
