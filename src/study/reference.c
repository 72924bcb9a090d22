/* reference.c -- see reference.h */
#include "study/reference.h"

#include <math.h>
#include <string.h>

static const double PARTED = 1e-3;    /* of the range: coordinates that have parted */
static const double UNCERTAIN = 1e-2; /* of the range: a column that neither run knows */
static const double LEAST = .1;       /* of the run that must be left */
enum { MOST_DENSE = 200 };            /* coordinates up to which full matrices are the cheaper way */

static void find_ranges(struct reference *o)
{
    for (int c = 0; c < o->run.n; c++) {
        double low = INFINITY, high = -INFINITY;
        for (int r = 0; r < o->run.rows && outcome_row(&o->run, r)[0] <= o->horizon; r++) {
            low = fmin(low, outcome_row(&o->run, r)[c]);
            high = fmax(high, outcome_row(&o->run, r)[c]);
        }
        o->range[c] = high - low;
        o->largest[c] = fmax(fabs(low), fabs(high));
    }
}

/* Over the range, or where it has none over its size; what is zero in both runs does not count. */
static double share(const struct reference *o, int c, double difference)
{
    const double size = o->range[c] > 1e-9 * o->largest[c] ? o->range[c] : o->largest[c];
    return difference == 0 ? 0 : difference / size;
}

/* The last common time before coordinates part. */
static void find_horizon(struct reference *o, const struct outcome *second)
{
    int r[2] = {-1, -1};
    double last = 0;
    o->whole = true;
    while (outcome_next(r, &o->run, second)) {
        const double *a = outcome_row(&o->run, r[0]), *b = outcome_row(second, r[1]);
        for (int c = 0; c < o->run.n && o->whole; c++)
            if (o->run.column[c].rate >= 0 && share(o, c, fabs(a[c] - b[c])) > PARTED) o->whole = false;
        if (!o->whole) break;
        last = a[0];
    }
    o->horizon = last;
}

static void find_uncertainty(struct reference *o, const struct outcome *second)
{
    int r[2] = {-1, -1};
    memset(o->uncertain, 0, sizeof *o->uncertain * (size_t)o->run.n);
    while (outcome_next(r, &o->run, second)) {
        const double *a = outcome_row(&o->run, r[0]), *b = outcome_row(second, r[1]);
        if (a[0] > o->horizon) break;
        for (int c = 0; c < o->run.n; c++) o->uncertain[c] = fmax(o->uncertain[c], share(o, c, fabs(a[c] - b[c])));
    }
    for (int c = 0; c < o->run.n; c++) {
        struct outcome_column *column = &o->run.column[c];
        if (column->rate >= 0) o->apart = fmax(o->apart, o->uncertain[c]);
        if (!column->compared || o->uncertain[c] <= UNCERTAIN) continue;
        column->compared = false;
        if (o->left_out++ == 0) o->left_out_name = column->name;
    }
}

static enum status run(struct outcome *o, const char *scheme, double tolerance, const struct scene *scene, double every,
                       const char *version, struct diags *diags, struct arena *life, struct report *report)
{
    struct step_options how;
    const struct integrate plan = outcome_plan(&how, scheme, tolerance, scene, every);
    TRY(outcome_run(o, scene, &plan, version, diags, life, report));
    if (o->status == OK || o->status == E_VERDICT) return OK;
    return fail(report, o->status, "no reference by %s: %.900s", scheme, o->report.text);
}

/* Collocation, and from some size on, where its matrices cost too much, explicit schemes. */
static enum status choose(struct reference *o, const struct scene *scene, double every, struct diags *diags,
                          struct report *report)
{
    struct step_options how;
    const struct integrate plan = outcome_plan(&how, "dopri5", 1e-3, scene, every);
    int n = 0;
    TRY(outcome_size(&n, scene, &plan, diags, report));
    o->small = n <= MOST_DENSE;
    o->scheme = o->small ? "radau9" : "dop853";
    o->second = o->small ? "radau5" : "dopri5";
    return OK;
}

enum status reference_make(struct reference *o, const struct scene *scene, double every, const char *version,
                           struct diags *diags, struct arena *life, struct report *report)
{
    struct outcome second;
    *o = (struct reference){0};
    TRY(choose(o, scene, every, diags, report));
    TRY(run(&o->run, o->scheme, 1e-11, scene, every, version, diags, life, report));
    TRY(run(&second, o->second, 1e-11, scene, every, version, diags, life, report));
    o->uncertain = TAKE(life, double, o->run.n);
    o->range = TAKE(life, double, o->run.n);
    o->largest = TAKE(life, double, o->run.n);
    const double end = outcome_row(&o->run, o->run.rows - 1)[0];
    o->horizon = end;
    find_ranges(o);
    find_horizon(o, &second);
    if (o->horizon - scene->start < LEAST * (end - scene->start))
        return fail(report, E_NUMERIC,
                    "%s and %s part after t = %g s: nothing to compare with (chaos, or a motion that no step resolves)",
                    o->scheme, o->second, o->horizon);
    find_ranges(o);
    find_uncertainty(o, &second);
    return OK;
}

void reference_compare(struct errors *e, const struct reference *o, const struct outcome *run)
{
    int r[2] = {-1, -1};
    bool any = false;
    double last = -INFINITY;
    *e = (struct errors){.fast = NAN, .slow = NAN, .column = -1, .instants = -1};
    while (outcome_next(r, &o->run, run)) {
        const double *a = outcome_row(&o->run, r[0]), *b = outcome_row(run, r[1]);
        if (a[0] > o->horizon) break;
        last = a[0];
        e->instants++;
        for (int c = 0; c < o->run.n; c++) {
            const struct outcome_column *column = &o->run.column[c];
            const double d = fabs(a[c] - b[c]), size = o->largest[c];
            double *to = column->rate > 0 ? &e->fast : &e->slow;
            if (column->rate >= 0 && !(size > 0 ? d / size <= *to : *to >= 0)) *to = size > 0 ? d / size : 0;
            if (!column->compared || share(o, c, d) <= e->worst) continue;
            e->worst = share(o, c, d);
            e->column = c;
        }
    }
    for (int c = 0; c < o->run.n; c++) any |= o->run.column[c].compared;
    if (!any) e->worst = NAN;                                                    /* nothing to be right in */
    if (last < o->horizon * (1 - 1e-9)) e->fast = e->slow = e->worst = INFINITY; /* it stopped on the way */
}
