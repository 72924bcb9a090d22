/* choose.c -- which columns a run writes */
#include <stdlib.h>
#include <string.h>

#include "sim/parts.h"

static void choose_default(struct sim *sim, struct arena *life)
{
    const struct catalogue *c = &sim->catalogue;
    int *index = TAKE(life, int, c->n), n = 0;
    for (int i = 0; i < c->n; i++) {
        const enum column_use use = c->origin[i].kind->use;
        bool wanted = use == USE_WRITTEN || use == USE_POSITION || use == USE_RATE;
        if (wanted || (use == USE_COUNTED && sim->options.counting)) index[n++] = i;
    }
    sim->chosen = (struct selection){n, index, -1};
}

/* Does the name, or pattern, go on behind that of the thing? */
static bool belongs(const char *name, const struct owner *of)
{
    const size_t len = strlen(of->name);
    return strncmp(name, of->name, len) == 0 && name[len] == '.';
}

/* The thing that a pattern begins with, the one of the longest name; NULL: none. */
static const struct owner *find_owner(const struct catalogue *c, const char *pattern)
{
    const struct owner *best = NULL;
    for (int i = 0; i < c->n; i++) {
        const struct owner *of = c->origin[i].of;
        if (belongs(pattern, of) && (!best || strlen(of->name) > strlen(best->name))) best = of;
    }
    return best;
}

/* What the thing that a pattern begins with has to offer. */
static void hint_columns(const struct catalogue *c, const char *pattern, struct diags *diags)
{
    enum { SHOWN = 8 };
    const struct owner *of = find_owner(c, pattern);
    char text[400] = "";
    int n = 0;
    if (!of) return;
    for (int i = 0; i < c->n; i++) {
        const char *name = c->column[i].name;
        if (!belongs(name, of) || n++ >= SHOWN) continue;
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%.40s", n > 1 ? ", " : "", name);
    }
    diag_hint(diags, "known here: %s%s", text, n > SHOWN ? ", ..." : "");
}

static enum status choose_by_deck(struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct output *out = &sim->scene->output;
    const struct catalogue *c = &sim->catalogue;
    const char **patterns = TAKE(life, const char *, out->ncolumn);
    enum status status = formulas_open(sim, diags, life);
    for (int i = 0; i < out->ncolumn; i++) { /* every wrong pattern is reported */
        struct report report = {0};
        struct selection one;
        patterns[i] = out->column[i].name ? out->column[i].name : out->column[i].node->text;
        if (out->column[i].name || columns_select(&one, c->column, c->n, &patterns[i], 1, E_DECK, life, &report) == OK)
            continue;
        diag_error(diags, out->column[i].node, AT_VALUE, "E-unknown-column", "%s", report.text);
        if (!strstr(report.text, "did you mean")) hint_columns(c, patterns[i], diags);
        status = E_DECK;
    }
    TRY(status);
    return columns_select(&sim->chosen, c->column, c->n, patterns, out->ncolumn, E_DECK, life, NULL);
}

/* The counted columns, then the deck's, t first. */
static enum status choose_counted(struct sim *sim, struct diags *diags, struct arena *life)
{
    choose_default(sim, life);
    if (!sim->scene->output.ncolumn) return OK;
    const struct selection counted = sim->chosen;
    TRY(choose_by_deck(sim, diags, life));
    int *index = TAKE(life, int, counted.n + sim->chosen.n);
    memcpy(index, counted.index, sizeof *index * (size_t)counted.n);
    memcpy(index + counted.n, sim->chosen.index, sizeof *index * (size_t)sim->chosen.n);
    sim->ncounted = counted.n;
    sim->chosen = (struct selection){counted.n + sim->chosen.n, index, -1};
    return OK;
}

static int by_name(const void *a, const void *b)
{
    const struct column *x = *(const struct column *const *)a, *y = *(const struct column *const *)b;
    int order = strcmp(x->name, y->name);
    return order ? order : (x > y) - (x < y);
}

/* The one that the deck names later; NULL: it names neither. */
static const struct node *later(const struct node *a, const struct node *b)
{
    if (!a || !b) return a ? a : b;
    return a->key_mark.line > b->key_mark.line ? a : b;
}

/* Two things of one name may make two columns of one name: a body's angle and a joint's. */
static enum status refuse_twins(const struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct catalogue *c = &sim->catalogue;
    const struct column **sorted = TAKE(life, const struct column *, c->n);
    enum status status = OK;
    const struct node *last = NULL;
    for (int i = 0; i < c->n; i++) sorted[i] = &c->column[i];
    qsort(sorted, (size_t)c->n, sizeof *sorted, by_name);
    for (int i = 1; i < c->n; i++) {
        if (strcmp(sorted[i]->name, sorted[i - 1]->name) != 0) continue;
        const struct node *at =
            later(c->origin[sorted[i - 1] - c->column].of->node, c->origin[sorted[i] - c->column].of->node);
        if (!at) at = sim->scene->deck->root;
        if (at != last)
            diag_error(diags, at, AT_KEY, "E-duplicate-name", "column '%.80s' has two meanings: %s, and %s",
                       sorted[i]->name, sorted[i - 1]->brief, sorted[i]->brief);
        last = at;
        status = E_DECK;
    }
    return status;
}

/* Records to come, before the first is written. */
static enum status foretell(const struct sim *sim, struct report *report)
{
    enum { BYTES_A_NUMBER = 18 };
    static const double MOST_BYTES = 1e12;
    double records = (double)sim->majors / (double)(sim->every ? sim->every : 1) + 1;
    double bytes = records * sim->chosen.n * BYTES_A_NUMBER;
    if (bytes <= MOST_BYTES) return OK;
    return fail(report, E_LIMIT, "%.3g records of %d columns are about %.3g bytes: the limit is %g; raise 'every'",
                records, sim->chosen.n, bytes, MOST_BYTES);
}

enum status choose_columns(struct sim *sim, struct diags *diags, struct arena *life, struct report *report)
{
    const struct catalogue *c = &sim->catalogue;
    catalogue_build(&sim->catalogue, sim->scene, sim->model, life);
    TRY(refuse_twins(sim, diags, life));
    TRY(signals_open(sim, diags, life));
    if (sim->options.counting)
        TRY(choose_counted(sim, diags, life));
    else if (sim->scene->output.ncolumn)
        TRY(choose_by_deck(sim, diags, life));
    else
        choose_default(sim, life);
    sim->row = TAKE(life, double, sim->chosen.n);
    sim->columns = TAKE(life, struct column, sim->chosen.n);
    for (int i = 0; i < sim->chosen.n; i++) {
        sim->columns[i] = c->column[sim->chosen.index[i]];
        sim->needs |= c->origin[sim->chosen.index[i]].needs;
    }
    return foretell(sim, report);
}
