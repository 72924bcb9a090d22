/* formulas.c -- columns that are expressions of other columns, printed or not, and of parameters: the deck's own, and its
 * signals.
 *
 * They are made when a record is written, of what the other columns say there: no force and no condition reads them. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "expr/expr.h"
#include "sim/parts.h"

static double formula_value(const struct sim *sim, const struct origin *o)
{
    const struct formula *f = &sim->formula[o->index];
    for (int i = 0; i < f->n; i++) f->x[i] = record_value(sim, &sim->catalogue.origin[f->from[i]]);
    return expr_value(f->expr, f->x);
}

const struct column_kind columns_formula[] = {
    {COLUMN("", "", NULL, "expression of the deck", EVALUATE_NOTHING, formula_value)},
    {0},
};

/* Of a table of time. */
static double table_value(const struct sim *sim, const struct origin *o)
{
    return signal_value(&sim->scene->signal[o->index].table, &sim->x.t);
}

static const struct column_kind columns_table[] = {
    {COLUMN("", "", NULL, "table of the deck", EVALUATE_NOTHING, table_value)},
    {0},
};

/* A formula while its names are looked up. */
struct naming {
    const struct output *output;
    const struct catalogue *catalogue;
    struct formula *formula;
    struct arena *life;
};

/* The deck's own column of this name: one that is wrong, or comes later; NULL: none. */
static const struct output_column *own_column(const struct output *out, const char *name)
{
    for (int i = 0; i < out->ncolumn; i++)
        if (out->column[i].name && strcmp(out->column[i].name, name) == 0) return &out->column[i];
    return NULL;
}

static int unknown(const struct naming *o, const char *name, struct expr_error *error)
{
    const struct catalogue *c = o->catalogue;
    const struct output_column *own = own_column(o->output, name);
    if (own && own->node->reported) return 2;
    const char **names = TAKE(o->life, const char *, c->n);
    for (int i = 0; i < c->n; i++) names[i] = c->column[i].name;
    const char *nearest = text_nearest(name, names, c->n);
    if (own)
        snprintf(error->text, sizeof error->text, "column '%.50s' comes later: expressions read those before them",
                 name);
    else if (nearest)
        snprintf(error->text, sizeof error->text, "no column '%.50s' (did you mean '%.40s'?)", name, nearest);
    else
        snprintf(error->text, sizeof error->text, "no column '%.50s', and no parameter", name);
    return 1;
}

static int find_slot(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    struct naming *o = self;
    struct formula *f = o->formula;
    const int column = columns_find(o->catalogue->column, o->catalogue->n, name);
    *slot = -1;
    *value = 0;
    if (column < 0) return unknown(o, name, error);
    for (int i = 0; i < f->n; i++)
        if (f->from[i] == column) return *slot = i, 0;
    f->from = arena_more(o->life, f->from, f->n, &f->capacity, sizeof *f->from);
    f->from[f->n] = column;
    *slot = f->n++;
    return 0;
}

/* The expression of one column; it may read those before it. */
static enum status add_formula(struct sim *sim, const struct output_column *column, struct diags *diags,
                               struct arena *life)
{
    struct catalogue *c = &sim->catalogue;
    struct formula *f = &sim->formula[sim->nformula];
    struct naming naming = {&sim->scene->output, c, f, life};
    struct expr *expr;
    if (columns_find(c->column, c->n, column->name) >= 0) {
        diag_error(diags, column->node, AT_KEY, "E-duplicate-name", "'%.60s' is a column already", column->name);
        return E_DECK;
    }
    TRY(deck_expr(&expr, column->node, &(struct expr_names){.find = find_slot, .self = &naming},
                  (struct deck *)sim->scene->deck));
    f->expr = expr;
    f->x = TAKE(life, double, f->n);
    struct owner *of = TAKE(life, struct owner, 1);
    *of = (struct owner){.name = column->name, .node = column->node};
    struct origin origin = {columns_formula, .of = of, .index = sim->nformula++};
    for (int i = 0; i < f->n; i++) origin.needs |= c->origin[f->from[i]].needs;
    catalogue_add(c, column->name, columns_formula->unit, &origin, life);
    return OK;
}

static void add_table(struct sim *sim, int index, struct arena *life)
{
    const struct scene_signal *s = &sim->scene->signal[index];
    struct owner *of = TAKE(life, struct owner, 1);
    *of = (struct owner){.name = s->name, .node = s->node};
    const struct origin origin = {columns_table, .of = of, .index = index};
    catalogue_add(&sim->catalogue, s->name, columns_table->unit, &origin, life);
}

enum status signals_open(struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct scene *scene = sim->scene;
    enum status status = OK;
    sim->formula = TAKE(life, struct formula, scene->nsignal + scene->output.ncolumn);
    for (int i = 0; i < scene->nsignal; i++) {
        const struct output_column column = {scene->signal[i].name, scene->signal[i].node, -1};
        if (scene->signal[i].is_table)
            add_table(sim, i, life);
        else if (add_formula(sim, &column, diags, life) != OK)
            status = E_DECK;
    }
    return status;
}

enum status formulas_open(struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct output *out = &sim->scene->output;
    enum status status = OK;
    for (int i = 0; i < out->ncolumn; i++)
        if (out->column[i].name && add_formula(sim, &out->column[i], diags, life) != OK) status = E_DECK;
    return status;
}
