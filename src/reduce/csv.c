/* csv.c -- a mesh as a table of nodes; see mesh.h */
#include <assert.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#include "reduce/mesh_parts.h"

enum column { NODE, X, Y, Z, ROW_X, ROW_Y, ROW_Z, SET, COLUMNS };
static const char *const names[COLUMNS] = {"node", "x", "y", "z", "row_x", "row_y", "row_z", "set"};

/* Which column each of the heading's fields is. */
static enum status read_heading(enum column *of, int *n, struct text *text)
{
    bool seen[COLUMNS] = {false};
    char *at = text_line(text);
    if (!at) return text_bad(text, "the table is empty");
    for (*n = 0; *n < COLUMNS; ++*n) {
        at += strspn(at, " \t");
        size_t len = strcspn(at, ", \t");
        int k = 0;
        while (k < COLUMNS && !(strlen(names[k]) == len && strncasecmp(at, names[k], len) == 0)) k++;
        if (k == COLUMNS || seen[k])
            return text_bad(text, "column '%.*s': expected node,x,y,z[,row_x,row_y,row_z][,set], each once", (int)len,
                            at);
        of[*n] = (enum column)k;
        seen[k] = true;
        at += len;
        if (!word_mark(&at, ',')) {
            ++*n;
            break;
        }
    }
    if (!word_end(at) || !seen[NODE] || !seen[X] || !seen[Y] || !seen[Z])
        return text_bad(text, "the heading should be node,x,y,z[,row_x,row_y,row_z][,set]");
    if (seen[ROW_X] != seen[ROW_Y] || seen[ROW_X] != seen[ROW_Z])
        return text_bad(text, "row_x, row_y and row_z go together");
    return OK;
}

static void join_sets(struct mesh *o, char *at, int id, struct arena *life)
{
    for (at += strspn(at, " \t"); *at; at += strspn(at, " \t")) {
        size_t len = strcspn(at, " \t");
        mesh_add_member(mesh_add_set(o, at, len, life), id, life);
        at += len;
    }
}

struct entry {
    int id, row[3];
    double x[3];
};

static enum status read_field(struct entry *o, enum column c, char **at, struct text *text)
{
    assert(c < SET);
    if (c == NODE) return word_int(at, &o->id) && o->id > 0 ? OK : text_bad(text, "expected a node number");
    if (c <= Z) {
        if (word_real(at, o->x + (c - X)) && isfinite(o->x[c - X])) return OK;
        return text_bad(text, "%s is not a finite number", names[c]);
    }
    if (word_int(at, o->row + (c - ROW_X)) && o->row[c - ROW_X] > 0) return OK;
    return text_bad(text, "%s should be a row of the matrices, from 1", names[c]);
}

static enum status read_row(struct mesh *o, char *at, const enum column *of, int n, struct text *text,
                            struct arena *life)
{
    struct entry e = {.row = {3 * o->n + 1, 3 * o->n + 2, 3 * o->n + 3}};
    char *sets = NULL;
    for (int k = 0; k < n; k++) {
        if (k && !word_mark(&at, ',')) return text_bad(text, "expected %d columns", n);
        if (of[k] == SET) {
            sets = at;
            at += strcspn(at, ",");
        } else
            TRY(read_field(&e, of[k], &at, text));
    }
    if (!word_end(at)) return text_bad(text, "expected %d columns", n);
    for (int k = 0; k < 3; k++) o->rows[3 * o->n + k] = e.row[k] - 1;
    mesh_add_node(o, e.id, e.x, life);
    if (sets) {
        sets[strcspn(sets, ",")] = 0;
        join_sets(o, sets, e.id, life);
    }
    return OK;
}

enum status mesh_read_csv(struct mesh *o, const char *path, struct arena *life, struct report *report)
{
    struct text text;
    enum column of[COLUMNS];
    int n;
    *o = (struct mesh){.path = path, .read = {.arena = life}};
    TRY(text_open(&text, path, life, report));
    files_add_path(&o->read, path);
    TRY(read_heading(of, &n, &text));
    o->rows = TAKE(life, int, 3 * (size_t)text.lines);
    for (char *line; (line = text_line(&text));)
        if (!word_end(line)) TRY(read_row(o, line, of, n, &text, life));
    int given = o->n;
    mesh_sort(o, life);
    if (o->n != given) return text_bad(&text, "a node number occurs twice");
    if (!o->n) return text_bad(&text, "the table has no nodes");
    return OK;
}
