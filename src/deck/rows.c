/* rows.c -- tables of two columns: in the deck, in a file beside it, or by a name among `tables`. */
#include <string.h>

#include "deck/read.h"

/* n: the table, or the file it is from. */
static int keep_points(struct points *o, const double *rows, int count, const struct node *n, struct reader *rd)
{
    double *x = TAKE(rd->deck->arena, double, count), *y = TAKE(rd->deck->arena, double, count);
    for (int i = 0; i < count; i++) {
        x[i] = rows[2 * i];
        y[i] = rows[2 * i + 1];
        if (i == 0 || x[i] > x[i - 1]) continue;
        diag_error(rd->diags, n->type == NODE_LIST ? n->item[i] : n, AT_VALUE, "E-table",
                   "the first numbers of a table must increase: %g after %g", x[i], x[i - 1]);
        return 1;
    }
    *o = (struct points){count, x, y};
    if (count > 0) return 0;
    diag_error(rd->diags, n, AT_VALUE, "E-table", "an empty table");
    return 1;
}

static int read_rows(struct points *o, const struct node *list, struct reader *rd)
{
    const char *what = arena_print(rd->deck->arena, "'%s'", list->key);
    if (read_list(list, what, rd)) return 1;
    double *rows = TAKE(rd->deck->arena, double, 2 * list->count);
    what = arena_print(rd->deck->arena, "a row of '%s'", list->key);
    for (int i = 0; i < list->count; i++)
        if (read_vector(rows + 2 * i, 2, list->item[i], what, rd)) return 1;
    return keep_points(o, rows, list->count, list, rd);
}

int read_table_file(struct points *o, const struct node *n, struct reader *rd)
{
    const char *name;
    double *rows;
    int count;
    if (read_text(&name, n, NULL, rd) || deck_csv(&rows, &count, 2, n, rd->deck) != OK) return 1;
    return keep_points(o, rows, count, n, rd);
}

static const struct node *tables_of(const struct reader *rd)
{
    const struct node *all = node_find(rd->deck->root, "tables");
    return all && all->type == NODE_MAP ? all : NULL;
}

int read_named_table(struct points *o, const struct node *n, struct reader *rd)
{
    const struct node *file = n->type == NODE_MAP ? node_find(n, "file") : NULL;
    if (n->reported) return 1;
    if (n->type == NODE_LIST) return read_rows(o, n, rd);
    if (file && n->count == 1) return read_table_file(o, file, rd);
    diag_error(rd->diags, n, AT_VALUE, "E-table", "expected [[x, y], ...] or {file: name}");
    return 1;
}

static int by_name(struct points *o, const struct node *n, struct reader *rd)
{
    enum { WORDS = 1000 };
    const struct node *all = tables_of(rd), *found = all ? node_find(all, n->text) : NULL;
    const char *words[WORDS];
    int count = 0;
    if (found) return read_named_table(o, found, rd);
    for (int i = 0; all && i < all->count && count < WORDS; i++) words[count++] = all->item[i]->key;
    read_unknown(n, AT_VALUE, "E-table", "table", n->text, words, count, rd);
    if (count == 0) diag_hint(rd->diags, "tables by name stand in 'tables': {NAME: [[x, y], ...]}; a file is 'file'");
    return 1;
}

int read_table(struct points *o, const struct node *n, struct reader *rd)
{
    if (n->reported) return 1;
    return n->type == NODE_SCALAR && !node_is_null(n) ? by_name(o, n, rd) : read_rows(o, n, rd);
}
