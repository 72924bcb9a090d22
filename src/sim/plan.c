/* plan.c -- how many steps, when a record is due, which columns */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "multirate/schemes.h"
#include "sim/parts.h"

static const double MOST_STEPS = 1e12, MOST_BYTES = 1e12;

static bool near_whole(double x)
{
    return fabs(x - round(x)) <= 1e-9 * fmax(1, fabs(x));
}

static enum status find_scheme(struct sim *sim, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const char *names[32];
    int n = 0;
    for (; n < 32 && stepper_kinds[n]; n++) names[n] = stepper_kinds[n]->name;
    const struct stepper_kind *kind = stepper_find(p->scheme);
    if (kind) {
        sim->stepper.kind = kind;
        return OK;
    }
    const struct node *at = node_find(p->node, "scheme");
    diag_error(diags, at, AT_VALUE, "E-unknown-scheme", "unknown scheme '%.60s'", p->scheme);
    const char *nearest = text_nearest(p->scheme, names, n);
    if (nearest)
        diag_hint(diags, "did you mean '%s'?", nearest);
    else
        diag_hint(diags, "`fmdsub list schemes` shows them");
    return E_DECK;
}

/* At ratio 1, with nothing that only it can do, a sub-cycling scheme is its single-rate twin: that one runs. */
static void prefer_single_rate(struct sim *sim)
{
    const struct stepper_kind *kind = sim->stepper.kind;
    if (sim->options.general || sim->plan.ratio != 1 || !kind->single) return;
    for (const struct key *k = kind->keys; k->name; k++)
        if (k->flags & KEY_NEUTRAL && !key_is_default(k, sim->plan.options)) return;
    sim->stepper.kind = kind->single;
}

static enum status missing_step(struct sim *sim, struct diags *diags)
{
    const struct step_options *o = sim->plan.options;
    diag_error(diags, sim->plan.node, AT_KEY, "E-missing-key", "scheme %s needs a 'step'", sim->plan.scheme);
    if (o->tolerance > 0) diag_hint(diags, "'tolerance' is for schemes that choose their steps, such as dopri5");
    return E_DECK;
}

static enum status check_tolerance(struct sim *sim, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const struct step_options *o = p->options;
    const struct node *at = node_find(p->node, "tolerance");
    bool adaptive = sim->stepper.kind->adaptive;
    if (adaptive && !(o->tolerance > 0)) {
        if (at) return E_DECK; /* it is there and was refused */
        diag_error(diags, p->node, AT_KEY, "E-missing-key", "scheme %s needs a 'tolerance'", sim->stepper.kind->name);
        return E_DECK;
    }
    return OK;
}

static enum status plan_every(struct sim *sim, double H, struct diags *diags)
{
    const struct output *out = &sim->scene->output;
    if (out->every_steps) {
        sim->every = out->every_steps;
        return OK;
    }
    if (!(out->every > 0)) {
        sim->every = 1;
        return OK;
    }
    double steps = out->every / H;
    sim->every = (long)fmin(fmax(1, round(steps)), (double)(sim->before + sim->majors));
    if (near_whole(steps) && steps > 0.5) return OK;
    double below = floor(steps) * H, above = ceil(steps) * H;
    if (below > 0)
        diag_error(diags, out->every_node, AT_VALUE, "E-every",
                   "every %.12g s is not a multiple of the major step %.12g s; the nearest are %.12g and %.12g",
                   out->every, H, below, above);
    else
        diag_error(diags, out->every_node, AT_VALUE, "E-every", "every %.12g s is shorter than the major step, %.12g s",
                   out->every, H);
    return E_DECK;
}

/* On the steps of a run from t = 0, where the start is the end of one of them: then two runs are the same as one. */
static enum status count_steps(struct sim *sim, double H, struct report *report)
{
    const double start = sim->scene->start, until = sim->plan.until, past = start / H;
    if (!(until / H <= MOST_STEPS && past <= MOST_STEPS))
        return fail(report, E_LIMIT, "%.3g major steps to t = %g s: the limit is %g", until / H, until, MOST_STEPS);
    const bool along = near_whole(past);
    sim->before = along ? lround(past) : 0;
    sim->origin = along ? 0 : start;
    const double steps = (until - sim->origin) / H;
    sim->majors = (near_whole(steps) ? lround(steps) : (long)ceil(steps)) - sim->before;
    if (sim->majors < 1) sim->majors = 1;
    return OK;
}

enum status plan_steps(struct sim *sim, struct diags *diags, struct report *report)
{
    struct integrate *p = &sim->plan;
    TRY(find_scheme(sim, diags));
    TRY(check_tolerance(sim, diags));
    if (!(p->until > 0)) return E_DECK;
    prefer_single_rate(sim);
    double H = p->step * p->ratio;
    if (sim->stepper.kind->adaptive) { /* its steps are its own: one call from record to record */
        const struct output *out = &sim->scene->output;
        H = out->every > 0 ? out->every : p->step > 0 ? H : (p->until - sim->scene->start) / 100;
        p->step = H;
        p->ratio = 1;
    } else if (!(p->step > 0)) {
        return missing_step(sim, diags);
    }
    TRY(count_steps(sim, H, report));
    return plan_every(sim, H, diags);
}

/* ---- columns ---- */

static void choose_default(struct sim *sim, struct arena *life)
{
    const struct catalogue *c = &sim->catalogue;
    int *index = TAKE(life, int, c->n), n = 0;
    for (int i = 0; i < c->n; i++) {
        const struct origin *s = &c->origin[i];
        bool wanted = s->type == FROM_TIME || s->type == FROM_Q || s->type == FROM_V;
        if (sim->options.counting) wanted = wanted || s->type == FROM_MEASURE;
        if (wanted || (s->type == FROM_ENERGY && s->k == ENERGY_RESIDUAL)) index[n++] = i;
    }
    sim->chosen = (struct selection){n, index, -1};
}

/* Does the column's name begin with that of a joint outside of the tree? */
static bool closes_loop(const struct sim *sim, const char *column)
{
    const struct scene *s = sim->scene;
    const size_t len = strcspn(column, ".");
    for (int i = 0; i < s->njoint; i++)
        if (column[len] && strlen(s->joint[i].name) == len && memcmp(s->joint[i].name, column, len) == 0)
            return sim->model->joint_of[i] < 0;
    return false;
}

/* What a name that is a column's up to a dot has to offer. */
static void hint_columns(const struct sim *sim, const char *pattern, struct diags *diags)
{
    enum { SHOWN = 8 };
    char text[400] = "";
    const size_t len = strcspn(pattern, ".");
    int n = 0;
    for (int i = 0; i < sim->catalogue.n; i++) {
        const char *name = sim->catalogue.column[i].name;
        if (strncmp(name, pattern, len) != 0 || name[len] != '.' || n++ >= SHOWN) continue;
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%.40s", n > 1 ? ", " : "", name);
    }
    if (n) diag_hint(diags, "known here: %s%s", text, n > SHOWN ? ", ..." : "");
}

static void hint(const struct sim *sim, const char *pattern, const struct report *told, struct diags *diags)
{
    if (closes_loop(sim, pattern))
        diag_hint(diags,
                  "this joint closes a loop and has no coordinates; ask for a measure, or choose another for the "
                  "loop by its 'loop: true'");
    else if (!strstr(told->text, "did you mean"))
        hint_columns(sim, pattern, diags);
}

static enum status choose_by_deck(struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct output *out = &sim->scene->output;
    const char **patterns = TAKE(life, const char *, out->npattern);
    for (int i = 0; i < out->npattern; i++) patterns[i] = out->pattern[i]->text;
    enum status status = OK;
    for (int i = 0; i < out->npattern; i++) { /* every wrong pattern is told */
        struct report report = {0};
        struct selection one;
        if (columns_select(&one, sim->catalogue.column, sim->catalogue.n, &patterns[i], 1, E_DECK, life, &report) == OK)
            continue;
        diag_error(diags, out->pattern[i], AT_VALUE, "E-unknown-column", "%s", report.text);
        hint(sim, patterns[i], &report, diags);
        status = E_DECK;
    }
    TRY(status);
    return columns_select(&sim->chosen, sim->catalogue.column, sim->catalogue.n, patterns, out->npattern, E_DECK, life,
                          NULL);
}

static int by_name(const void *a, const void *b)
{
    const struct column *x = *(const struct column *const *)a, *y = *(const struct column *const *)b;
    int order = strcmp(x->name, y->name);
    return order ? order : (x > y) - (x < y);
}

/* Where the deck names the joint or measure that a column belongs to; NULL: neither. */
static const struct node *owner(const struct sim *sim, const char *column)
{
    const struct scene *s = sim->scene;
    size_t len = strcspn(column, ".");
    for (int i = 0; i < s->njoint; i++)
        if (column[len] && strlen(s->joint[i].name) == len && memcmp(s->joint[i].name, column, len) == 0)
            return s->joint[i].node;
    for (int i = 0; i < s->nmeasure; i++)
        if (s->measure[i].name && strcmp(s->measure[i].name, column) == 0) return s->measure[i].node;
    return NULL;
}

/* Two things of one name may make two columns of one name: a body's angle and a joint's. */
static enum status refuse_twins(const struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct catalogue *c = &sim->catalogue;
    const struct column **sorted = TAKE(life, const struct column *, c->n);
    enum status status = OK;
    const struct node *told = NULL;
    for (int i = 0; i < c->n; i++) sorted[i] = &c->column[i];
    qsort(sorted, (size_t)c->n, sizeof *sorted, by_name);
    for (int i = 1; i < c->n; i++) {
        if (strcmp(sorted[i]->name, sorted[i - 1]->name) != 0) continue;
        const struct node *at = owner(sim, sorted[i]->name);
        if (!at) at = sim->scene->deck->root;
        if (at != told)
            diag_error(diags, at, AT_KEY, "E-duplicate-name", "column '%.80s' has two meanings: %s, and %s",
                       sorted[i]->name, sorted[i - 1]->brief, sorted[i]->brief);
        told = at;
        status = E_DECK;
    }
    return status;
}

/* Records to come, before the first is written. */
static enum status foretell(const struct sim *sim, struct report *report)
{
    enum { BYTES_A_NUMBER = 18 };
    double records = (double)sim->majors / (double)(sim->every ? sim->every : 1) + 1;
    double bytes = records * sim->chosen.n * BYTES_A_NUMBER;
    if (bytes <= MOST_BYTES) return OK;
    return fail(report, E_LIMIT, "%.3g records of %d columns are about %.3g bytes: the limit is %g; raise 'every'",
                records, sim->chosen.n, bytes, MOST_BYTES);
}

enum status plan_columns(struct sim *sim, struct diags *diags, struct arena *life, struct report *report)
{
    catalogue_build(&sim->catalogue, sim->scene, sim->model, life);
    TRY(refuse_twins(sim, diags, life));
    if (sim->scene->output.npattern && !sim->options.counting)
        TRY(choose_by_deck(sim, diags, life));
    else
        choose_default(sim, life);
    sim->needs = catalogue_needs(&sim->catalogue, &sim->chosen);
    sim->row = TAKE(life, double, sim->chosen.n);
    sim->columns = TAKE(life, struct column, sim->chosen.n);
    for (int i = 0; i < sim->chosen.n; i++) sim->columns[i] = sim->catalogue.column[sim->chosen.index[i]];
    return foretell(sim, report);
}
