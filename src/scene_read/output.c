/* output.c -- records: how often, which columns */
#include <string.h>

#include "base/text.h"
#include "expr/expr.h"
#include "scene_read/parts.h"

static void read_every(struct builder *b, struct output *o, const struct node *n)
{
    o->every_node = n;
    if (n->type == NODE_MAP) {
        struct every_keys k = {0};
        if (read_keys(&k, keys_every, n, NULL, "'every'", &b->reader)) return;
        o->every_steps = k.steps;
        return;
    }
    if (read_number(&o->every, n, NULL, &b->reader)) return;
    if (o->every > 0) return;
    diag_error(b->diags, n, AT_VALUE, "E-range", "'every' must be positive");
}

/* Names are those of columns, which are known when there is a model: until then any is. */
static int any_name(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)name, (void)error;
    *slot = 0;
    *value = 0;
    return 0;
}

/* A member of {name: expression, ...}: its name, and whether the expression is one. */
static int read_formula(struct builder *b, struct output_column *o, const struct node *n)
{
    const struct expr_names names = {.find = any_name, .self = NULL};
    struct expr *expr;
    double x;
    *o = (struct output_column){n->key, n, -1};
    if (!text_is_name(n->key) || strcmp(n->key, "type") == 0 || expr_is_word(n->key)) {
        diag_error(b->diags, n, AT_KEY, "E-name", "'%.60s' cannot name a column", n->key);
        return 1;
    }
    if (deck_parameter(&x, n->key, b->reader.deck) == 0) {
        diag_error(b->diags, n, AT_KEY, "E-duplicate-name", "'%s' is a parameter already", n->key);
        return 1;
    }
    return deck_expr(&expr, n, &names, b->reader.deck) != OK;
}

bool is_output_formula(const struct deck *deck, const char *name)
{
    const struct node *output = node_find(deck->root, "output"), *list = NULL;
    if (output && output->type == NODE_MAP) list = node_find(output, "columns");
    for (int i = 0; list && list->type == NODE_LIST && i < list->count; i++)
        if (list->item[i]->type == NODE_MAP && node_find(list->item[i], name)) return true;
    return false;
}

/* One item of the list; *count columns of it are there. */
static int read_column(struct builder *b, struct output_column *list, int *count, const struct node *n)
{
    int errors = 0;
    if (n->type == NODE_SCALAR) {
        list[(*count)++] = (struct output_column){NULL, n, find_owner(b->scene, n->text)};
        return 0;
    }
    if (n->type == NODE_LIST || n->count == 0) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "expected the name of a column, a pattern or {name: expression}");
        return 1;
    }
    for (int i = 0; i < n->count; i++) errors += read_formula(b, &list[(*count)++], n->item[i]);
    return errors;
}

static void read_columns(struct builder *b, struct output *o, const struct node *n)
{
    int most = 0;
    if (read_list(n, "'columns'", &b->reader)) {
        if (n->type == NODE_MAP) diag_hint(b->diags, "write [name, pattern, {name: expression}]");
        return;
    }
    if (n->count == 0) {
        diag_error(b->diags, n, AT_VALUE, "E-count", "'columns' is empty");
        diag_hint(b->diags, "without it all coordinates and rates are written; t is in every record");
        return;
    }
    for (int i = 0; i < n->count; i++) most += n->item[i]->type == NODE_MAP ? n->item[i]->count : 1;
    struct output_column *list = TAKE(b->life, struct output_column, most);
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) read_column(b, list, &o->ncolumn, n->item[i]);
    o->column = list;
}

void read_output(struct builder *b, const struct node *n)
{
    struct output *o = &b->scene->output;
    struct output_keys k = {0};
    *o = (struct output){.node = n};
    if (!n || read_keys(&k, keys_output, n, NULL, "'output'", &b->reader)) return;
    if (k.every) read_every(b, o, k.every);
    if (k.columns) read_columns(b, o, k.columns);
}
