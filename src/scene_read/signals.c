/* signals.c -- named values for other expressions: signals; named tables.
 *
 * A signal's expression stands in for its name wherever an expression names it (deck/number.c), so that slopes, corners
 * and jumps are those of the whole.  Each is read by itself first: what is wrong with it is told once, at its own place. */
#include <string.h>

#include "expr/expr.h"
#include "scene_read/parts.h"

void read_tables(struct builder *b, const struct node *n)
{
    if (!n || read_map(n, "'tables'", &b->reader)) return;
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
        struct points any;
        if (read_named_table(&any, n->item[i], &b->reader) == 0) continue;
        n->item[i]->reported = true;
    }
}

const struct signal *find_table_signal(const struct builder *b, const char *name)
{
    for (int i = 0; i < b->scene->nsignal; i++)
        if (b->scene->signal[i].is_table && strcmp(b->scene->signal[i].name, name) == 0)
            return &b->scene->signal[i].table;
    return NULL;
}

/* ---- circles ---- */

static bool is_part(char c)
{
    return c == '_' || c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool mentions(const struct node *n, const char *name)
{
    const size_t len = strlen(name);
    if (n->type != NODE_SCALAR) return false;
    for (const char *p = n->text; (p = strstr(p, name)); p += len)
        if ((p == n->text || !is_part(p[-1])) && !is_part(p[len])) return true;
    return false;
}

/* Signals that wait for nothing but each other are left when all others are taken away, again and again. */
static void refuse_circles(struct builder *b, const struct node *n)
{
    bool *settled = TAKE(b->life, bool, n->count);
    int left = n->count, before, errors = 0;
    do {
        before = left;
        for (int i = 0; i < n->count; i++) {
            bool waits = false;
            for (int k = 0; k < n->count && !waits; k++) waits = !settled[k] && mentions(n->item[i], n->item[k]->key);
            left -= !settled[i] && !waits;
            settled[i] = settled[i] || !waits;
        }
    } while (left < before);
    for (int i = 0; i < n->count; i++) {
        if (settled[i]) continue;
        if (errors++ == 0)
            diag_error(b->diags, n->item[i], AT_VALUE, "E-cycle",
                       "signals in a circle: '%.60s' reads itself, or one that does", n->item[i]->key);
        else
            diag_note(b->diags, n->item[i], AT_VALUE, "this one, too");
        n->item[i]->reported = true;
    }
}

/* ---- the section ---- */

/* A table as an expression of t, for others: y0 + sum of (y1 - y0) ramp(t, t0, t1).  NULL: it has too many points. */
static const char *as_expression(struct builder *b, const struct signal *o)
{
    enum { MOST = 200, LENGTH = 100 };
    if (o->n > MOST) return NULL;
    char *text = TAKE(b->life, char, (o->n + 1) * LENGTH);
    int len = snprintf(text, LENGTH, "%.17g", o->n ? o->x[0] : 0);
    for (int i = 1; i < o->n; i++)
        len += snprintf(text + len, LENGTH, " + (%.17g)*ramp(t, %.17g, %.17g)", o->x[i] - o->x[i - 1], o->t[i - 1],
                        o->t[i]);
    return text;
}

static int read_one(struct builder *b, struct scene_signal *o, struct node *n)
{
    *o = (struct scene_signal){.name = n->key, .node = n, .is_table = n->type == NODE_MAP};
    int errors = wrong_value_name(b, n, "signal");
    if (!errors && find_measure(b->scene, n->key, strlen(n->key)) >= 0) {
        diag_error(b->diags, n, AT_KEY, "E-duplicate-name", "'%s' is a measure already", n->key);
        errors = 1;
    }
    if (!errors) errors = o->is_table ? read_time_table(b, &o->table, n) : check_expression(b, n);
    if (errors) n->reported = true;
    if (!errors && o->is_table) n->text = as_expression(b, &o->table);
    return errors;
}

void read_signals(struct builder *b, const struct node *n)
{
    struct scene *scene = b->scene;
    if (!n || read_map(n, "'signals'", &b->reader)) return;
    scene->signal = TAKE(b->life, struct scene_signal, n->count);
    refuse_circles(b, n);
    for (int tables = 1; tables >= 0; tables--) /* tables first: others read them */
        for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
            struct scene_signal signal;
            if (n->item[i]->reported || (tables && n->item[i]->type != NODE_MAP)) continue;
            if (!read_one(b, &signal, n->item[i]) && !tables) scene->signal[scene->nsignal++] = signal;
        }
}
