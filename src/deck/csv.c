/* csv.c -- columns of numbers from a file beside the deck. */
#include <string.h>

#include "deck/stages.h"

struct csv {
    struct deck *deck;
    const struct source *source;
    int file, columns, rows, capacity, reported, lean;
    double *x; /* [capacity x columns] */
};

/* A field without the blanks around it. */
struct field {
    size_t from, to;
};

static struct span field_span(const struct csv *c, struct field f)
{
    return (struct span){c->file, source_mark(c->source, f.from), source_mark(c->source, f.to)};
}

static struct field trimmed(const char *text, size_t from, size_t to)
{
    while (from < to && (text[from] == ' ' || text[from] == '\t')) from++;
    while (to > from && (text[to - 1] == ' ' || text[to - 1] == '\t')) to--;
    return (struct field){from, to};
}

static bool number(double *out, const char *text, struct field f)
{
    const char *wrong;
    bool minus = f.from < f.to && text[f.from] == '-';
    size_t start = f.from + (minus || (f.from < f.to && text[f.from] == '+'));
    size_t used = expr_number(out, text + start, &wrong);
    if (minus) *out = -*out;
    return used && !wrong && start + used == f.to;
}

/* "0.5": a number in quotes is no number, and no name either. */
static bool quoted_number(const char *text, struct field f)
{
    double value;
    if (f.to - f.from < 2 || !strchr("\"'", text[f.from]) || text[f.to - 1] != text[f.from]) return false;
    return number(&value, text, trimmed(text, f.from + 1, f.to - 1));
}

static double *new_row(struct csv *c)
{
    c->x = arena_more(c->deck->arena, c->x, c->rows, &c->capacity, (size_t)c->columns * sizeof *c->x);
    return c->x + (size_t)c->rows * (size_t)c->columns;
}

static void report_field(struct csv *c, struct field f)
{
    const char *text = c->source->text;
    struct diags *d = c->deck->diags;
    const char *found =
        arena_print(c->deck->arena, "%.*s", (int)(f.to - f.from < 200 ? f.to - f.from : 200), text + f.from);
    c->reported++;
    diag_error_in(d, field_span(c, f), "E-csv",
                  *found ? "expected a number, found '%s'" : "expected a number, found nothing%s", diag_clip(d, found));
    if (memchr(text + f.from, ';', f.to - f.from)) diag_hint(d, "columns are separated by commas");
    if (quoted_number(text, f)) diag_hint(d, "numbers stand without quotes");
}

/* A line of fields: 1 if all are numbers.  count: fields met; bad: the first
 * that is not a number. */
static bool split(const struct csv *c, double *x, struct field line, int *count, struct field *bad)
{
    const char *text = c->source->text;
    bool fine = true;
    *count = 0;
    for (size_t from = line.from; from <= line.to; ++*count) {
        const char *comma = memchr(text + from, ',', line.to - from);
        size_t to = comma ? (size_t)(comma - text) : line.to;
        struct field f = trimmed(text, from, to);
        double value;
        bool ok = number(&value, text, f);
        if (!ok && fine) *bad = f;
        fine &= ok;
        if (*count < c->columns) x[*count] = ok ? value : 0;
        from = to + 1;
    }
    return fine;
}

/* A row of names has no number in it, nor one in quotes. */
static bool names(const struct csv *c, struct field line)
{
    const char *text = c->source->text;
    double value;
    for (size_t from = line.from; from <= line.to;) {
        const char *comma = memchr(text + from, ',', line.to - from);
        size_t to = comma ? (size_t)(comma - text) : line.to;
        struct field f = trimmed(text, from, to);
        if (f.from == f.to || number(&value, text, f) || quoted_number(text, f)) return false;
        if (strchr("+-.0123456789", text[f.from])) return false;
        from = to + 1;
    }
    return true;
}

static void read_line(struct csv *c, struct field line, bool may_be_names)
{
    int count;
    struct field bad = line;
    bool fine = split(c, new_row(c), line, &count, &bad);
    if (count != c->columns) {
        if (c->lean++) return; /* rows of one file are wrong in the same way */
        c->reported++;
        diag_error_in(c->deck->diags, field_span(c, line), "E-csv", "expected %d columns, found %d", c->columns, count);
        if (memchr(c->source->text + line.from, ';', line.to - line.from))
            diag_hint(c->deck->diags, "columns are separated by commas");
    } else if (fine) {
        c->rows++;
    } else if (!may_be_names) {
        report_field(c, bad);
        if (!c->rows && names(c, line))
            diag_hint(c->deck->diags, "one row of names may come first: units stand behind a '#'");
    }
}

static void read_lines(struct csv *c)
{
    bool first = true;
    for (int i = 1; i <= c->source->lines && c->reported < DIAGS_SHOWN; i++) {
        struct field line = trimmed(c->source->text, c->source->line[i - 1], source_line_end(c->source, i));
        if (line.from == line.to || c->source->text[line.from] == '#') continue;
        read_line(c, line, first && names(c, line));
        first = false;
    }
}

enum status deck_csv(double **x, int *rows, int columns, const struct node *file, struct deck *deck)
{
    struct csv c = {.deck = deck, .columns = columns};
    struct source *s = source_beside(file, deck);
    *x = NULL;
    *rows = 0;
    if (!s) return E_DECK;
    c.source = s;
    c.file = diags_add_source(deck->diags, s);
    hash_file(deck, s);
    read_lines(&c);
    if (c.rows == 0 && !c.reported)
        diag_error(deck->diags, file, AT_VALUE, "E-csv", "'%s' holds no rows", diag_clip(deck->diags, file->text)),
            c.reported++;
    *x = c.x;
    *rows = c.rows;
    return c.reported ? E_DECK : OK;
}
