/* table.c -- see table.h */
#include "out/table.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "out/cell.h"
#include "out/number.h"

struct cell {
    double x;
    const char *text; /* NULL: a number */
};

struct table {
    const struct table_column *columns; /* [n] */
    int n;
    struct cell *cells; /* [capacity] by row */
    int used, capacity;
    struct arena *life;
};

struct table *table_open(const struct table_column *columns, int n, struct arena *life)
{
    for (int c = 0; c < n; c++) assert(*columns[c].name && (!columns[c].head || *columns[c].head));
    struct table *table = TAKE(life, struct table, 1);
    *table = (struct table){.columns = columns, .n = n, .life = life};
    return table;
}

static void append(struct table *table, struct cell cell)
{
    table->cells = arena_more(table->life, table->cells, table->used, &table->capacity, sizeof *table->cells);
    table->cells[table->used++] = cell;
}

static const struct table_column *next_column(const struct table *table)
{
    return &table->columns[table->used % table->n];
}

void table_number(struct table *table, double x)
{
    assert(next_column(table)->digits > 0);
    append(table, (struct cell){.x = x});
}

void table_text(struct table *table, const char *text)
{
    assert(next_column(table)->digits == 0);
    append(table, (struct cell){.text = arena_copy(table->life, text, strlen(text))});
}

/* What a person sees of a cell; buffer [NUMBER_MOST + 1] is used for numbers. */
static const char *seen(const struct cell *cell, int digits, char *buffer)
{
    if (cell->text) return cell->text;
    if (!isfinite(cell->x)) return "-";
    buffer[digits >= 17 ? number_write(buffer, cell->x) : number_round(buffer, cell->x, digits)] = 0;
    return buffer;
}

static const char *heading(const struct table_column *column)
{
    return column->head ? column->head : column->name;
}

/* Letters of UTF-8 text. */
static int letters(const char *text)
{
    int n = 0;
    for (; *text; text++) n += (*text & 0xc0) != 0x80;
    return n;
}

static int wider(int width, const char *text)
{
    int n = letters(text);
    return n > width ? n : width;
}

static void measure(int *width, const struct table *table)
{
    char buffer[NUMBER_MOST + 1];
    for (int c = 0; c < table->n; c++) width[c] = wider(0, heading(&table->columns[c]));
    for (int i = 0; i < table->used; i++) {
        int c = i % table->n;
        width[c] = wider(width[c], seen(&table->cells[i], table->columns[c].digits, buffer));
    }
}

static char *blanks(char *to, int n)
{
    memset(to, ' ', (size_t)n);
    return to + n;
}

/* One cell and what stands before it; the last takes the blanks at the end of its row away. */
static char *put_cell(char *to, const char *text, int width, const struct table_column *column, bool first, bool last)
{
    int space = width - letters(text);
    if (!first) to = blanks(to, 2);
    if (column->digits > 0) to = blanks(to, space);
    to = stpcpy(to, text);
    if (column->digits == 0) to = blanks(to, space);
    if (!last) return to;
    while (to[-1] == ' ') to--;
    *to++ = '\n';
    return to;
}

static char *put_head(char *to, const struct table *table, const int *width)
{
    for (int c = 0; c < table->n; c++)
        to = put_cell(to, heading(&table->columns[c]), width[c], &table->columns[c], c == 0, c + 1 == table->n);
    for (int c = 0; c < table->n; c++) {
        memset(to, '-', (size_t)width[c]);
        to = stpcpy(to + width[c], c + 1 < table->n ? "  " : "\n");
    }
    return to;
}

/* Bytes that drawing takes at most: a letter is at most 4 bytes. */
static size_t drawn_bytes(const struct table *table, const int *width)
{
    size_t row = 1;
    for (int c = 0; c < table->n; c++) row += 4 * (size_t)width[c] + 2;
    return row * (size_t)(table->used / table->n + 3) + 1;
}

const char *table_draw(const struct table *table, struct arena *life)
{
    char buffer[NUMBER_MOST + 1];
    int *width = TAKE(life, int, table->n);
    measure(width, table);
    char *text = TAKE(life, char, drawn_bytes(table, width));
    char *to = put_head(text, table, width);
    for (int i = 0; i < table->used; i++) {
        int c = i % table->n;
        const struct table_column *column = &table->columns[c];
        to = put_cell(to, seen(&table->cells[i], column->digits, buffer), width[c], column, c == 0,
                      c + 1 == table->n || i + 1 == table->used);
    }
    return text;
}

static void put_lines(const struct table *table, enum table_form form, FILE *to)
{
    struct table_line line = {.form = form, .to = to};
    table_line_head(&line, table->columns, table->n);
    for (int i = 0; i < table->used; i++) {
        const struct cell *cell = &table->cells[i];
        const int c = i % table->n;
        if (c == 0) table_line_begin(&line);
        if (cell->text)
            table_line_text(&line, &table->columns[c], cell->text);
        else
            table_line_number(&line, &table->columns[c], cell->x);
        if (c + 1 == table->n || i + 1 == table->used) table_line_end(&line);
    }
    table_line_foot(&line);
}

const char *table_csv(const struct table *table, struct arena *life)
{
    char *text = NULL;
    size_t n = 0;
    FILE *to = words_open(&text, &n);
    put_lines(table, TABLE_CSV, to);
    words_close(to, &text);
    const char *copy = arena_copy(life, text, n);
    free(text);
    return copy;
}

enum status table_print(const struct table *table, enum table_form form, FILE *file, struct report *report)
{
    if (form == TABLE_DRAWN)
        fputs(table_draw(table, table->life), file);
    else
        put_lines(table, form, file);
    if (fflush(file) != 0 || ferror(file))
        return fail(report, errno == EPIPE ? E_SIGPIPE : E_FILE, "cannot write the table: %s", strerror(errno));
    return OK;
}
