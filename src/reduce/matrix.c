/* matrix.c -- see matrix.h */
#include "reduce/matrix.h"

#include <assert.h>
#include <math.h>
#include <string.h>
#include <strings.h>

enum { MOST_ENTRIES = 500000000 };

static enum status take(struct triplets *o, int capacity, struct text *text, struct arena *scratch)
{
    if (capacity > MOST_ENTRIES) {
        return fail(text->report, E_LIMIT, "%s: more than %d entries", text->path, MOST_ENTRIES);
    }
    o->capacity = capacity;
    o->i = TAKE(scratch, int, capacity);
    o->j = TAKE(scratch, int, capacity);
    o->v = TAKE(scratch, double, capacity);
    o->line = TAKE(scratch, int, capacity);
    return OK;
}

static enum status read_entry(struct triplets *o, char *at, const struct matrix_rows *rows, struct text *text)
{
    int i, j;
    double v;
    if (!word_int(&at, &i) || !word_int(&at, &j) || !word_real(&at, &v) || !word_end(at))
        return text_bad(text, "expected 'row column value'");
    if (i < 1 || i > rows->n || j < 1 || j > rows->n)
        return text_bad(text, "row %d, column %d: the matrix has %d rows", i, j, rows->n);
    if (!isfinite(v)) return text_bad(text, "row %d, column %d: the value is not finite", i, j);
    if (i == j && v < 0) return text_bad(text, "row %d: the diagonal is negative, %.6g", i, v);
    assert(o->count < o->capacity);
    int at_entry = o->count++;
    o->i[at_entry] = rows->to[i - 1];
    o->j[at_entry] = rows->to[j - 1];
    o->v[at_entry] = v * rows->scale;
    o->line[at_entry] = text->line;
    return OK;
}

static enum status build(struct sparse *o, const struct triplets *t, struct text *text, struct arena *life)
{
    if (!t->count) return fail(text->report, E_DECK, "%s: error: the matrix is empty", text->path);
    return sparse_build(o, t, text, life);
}

static enum status triples(struct sparse *o, struct text *text, const struct matrix_rows *rows, struct arena *scratch,
                           struct arena *life)
{
    struct triplets t = {.n = rows->size, .half = true};
    TRY(take(&t, text->lines, text, scratch));
    for (char *line; (line = text_line(text));)
        if (!word_end(line)) TRY(read_entry(&t, line, rows, text));
    return build(o, &t, text, life);
}

/* A file in one of the two forms. */
static enum status read_by(enum status (*form)(struct sparse *o, struct text *text, const struct matrix_rows *rows,
                                               struct arena *scratch, struct arena *life),
                           struct sparse *o, const char *path, const struct matrix_rows *rows, struct arena *life,
                           struct report *report)
{
    struct arena *scratch = arena_open();
    struct text text;
    enum status status = text_open(&text, path, scratch, report);
    if (status == OK) status = form(o, &text, rows, scratch, life);
    arena_close(scratch);
    return status;
}

enum status matrix_read_triples(struct sparse *o, const char *path, const struct matrix_rows *rows, struct arena *life,
                                struct report *report)
{
    return read_by(triples, o, path, rows, life, report);
}

static bool next_word(char **at, const char *word)
{
    char *start = *at + strspn(*at, " \t");
    size_t n = strlen(word);
    if (strncasecmp(start, word, n) != 0 || !strchr(" \t", start[n])) return false;
    *at = start + n;
    return true;
}

/* And not the counts of a file that has lost its banner. */
static bool is_entry(char *at, const struct matrix_rows *rows, const struct text *text)
{
    int i, j;
    double v;
    if (!word_int(&at, &i) || !word_int(&at, &j) || !word_real(&at, &v) || !word_end(at)) return false;
    return !(i == rows->n && j == rows->n && v >= rows->n && v <= text->lines && v == floor(v));
}

static enum status read_banner(bool *half, char *at, struct text *text)
{
    if (!at || !next_word(&at, "%%MatrixMarket"))
        return text_bad(text, "expected the line '%%%%MatrixMarket matrix ...'");
    if (!next_word(&at, "matrix") || !next_word(&at, "coordinate"))
        return text_bad(text, "only 'matrix coordinate' is read");
    if (!next_word(&at, "real") && !next_word(&at, "integer"))
        return text_bad(text, "only real and integer values are read");
    *half = next_word(&at, "symmetric");
    if (!*half && !next_word(&at, "general")) return text_bad(text, "only symmetric and general matrices are read");
    return OK;
}

/* Entries alone, as Abaqus writes them (*MATRIX OUTPUT, FORMAT=COORDINATE): one triangle or both, which shows. */
static enum status bare(struct sparse *o, char *line, struct text *text, const struct matrix_rows *rows,
                        struct arena *scratch, struct arena *life)
{
    struct triplets t = {.n = rows->size};
    bool above = false, below = false;
    TRY(take(&t, text->lines, text, scratch));
    for (; line; line = text_line(text)) {
        char *at = line;
        int i, j;
        if (word_end(line)) continue;
        if (word_int(&at, &i) && word_int(&at, &j)) above |= i<j, below |= i> j;
        TRY(read_entry(&t, line, rows, text));
    }
    t.half = !(above && below);
    return build(o, &t, text, life);
}

/* The counts: rows, columns, entries. */
static enum status read_counts(int *entries, const struct matrix_rows *rows, struct text *text)
{
    int m, n;
    char *at;
    do {
        at = text_line(text);
    } while (at && (*at == '%' || word_end(at)));
    if (!at || !word_int(&at, &m) || !word_int(&at, &n) || !word_int(&at, entries) || !word_end(at) || *entries < 0)
        return text_bad(text, "expected the counts 'rows columns entries'");
    if (m != n) return text_bad(text, "the matrix is not square: %d rows, %d columns", m, n);
    if (m != rows->n) return text_bad(text, "the matrix has %d rows, the nodes have %d freedoms", m, rows->n);
    return OK;
}

static enum status market(struct sparse *o, struct text *text, const struct matrix_rows *rows, struct arena *scratch,
                          struct arena *life)
{
    struct triplets t = {.n = rows->size};
    int entries;
    char *first = text_line(text);
    if (first && is_entry(first, rows, text)) return bare(o, first, text, rows, scratch, life);
    TRY(read_banner(&t.half, first, text));
    TRY(read_counts(&entries, rows, text));
    if (entries > text->lines)
        return text_bad(text, "%d entries are said, the file has %d lines", entries, text->lines);
    TRY(take(&t, entries, text, scratch));
    for (char *line; (line = text_line(text));) {
        if (word_end(line)) continue;
        if (t.count == entries) return text_bad(text, "there are more entries than the %d that are said", entries);
        TRY(read_entry(&t, line, rows, text));
    }
    if (t.count < entries) return text_bad(text, "the file ends after %d of %d entries", t.count, entries);
    return build(o, &t, text, life);
}

enum status matrix_read_market(struct sparse *o, const char *path, const struct matrix_rows *rows, struct arena *life,
                               struct report *report)
{
    return read_by(market, o, path, rows, life, report);
}
