/* table.h -- a small table for people, or as CSV.
 *
 * Numbers stand right, rounded to the column's significant digits, texts left; two blanks between
 * columns, a rule under the headings:
 *
 *     scheme     ratio   error   time [s]
 *     --------  ------  -------  --------
 *     subcycle       5  1.25e-6      0.14
 *
 * The other forms have plain names and shortest round-trip numbers: CSV, one JSON object a row (NDJSON), or all of them
 * in {"rows":[...]}. */
#ifndef FMDSUB_OUT_TABLE_H
#define FMDSUB_OUT_TABLE_H

#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/status.h"
#include "out/stream.h"

struct table_column {
    const char *name; /* CSV: "time" */
    const char *head; /* for people: "time [s]"; NULL: name */
    int digits;       /* significant digits for people, 17: all; 0: a column of texts */
};

struct table;

/* columns [n] stay the caller's and must outlive the table; no name or heading is empty. */
struct table *table_open(const struct table_column *columns, int n, struct arena *life);

/* The next cell, by row; a new row starts by itself.  Texts are copied.  A number that is not finite
 * shows as "-", in CSV as an empty field. */
void table_number(struct table *table, double x);
void table_text(struct table *table, const char *text);

/* Both forms as text; a last row that is not full ends where it ends. */
const char *table_draw(const struct table *table, struct arena *life);
const char *table_csv(const struct table *table, struct arena *life);

enum table_form { TABLE_DRAWN, TABLE_CSV, TABLE_NDJSON, TABLE_JSON };

/* "csv", "ndjson", "json"; NULL: for people on a terminal, else CSV. */
enum table_form table_form_of(const char *word, bool terminal);

/* On file; E_FILE when it cannot be written. */
enum status table_print(const struct table *table, enum table_form form, FILE *file, struct report *report);

/* One line of a table that is written as it comes: fields by put_..., then the end of the line.  NDJSON and JSON: members of
 * an object.  head: the line of names, of JSON what opens the list. */
struct table_line {
    enum table_form form;
    FILE *to;
    long rows;  /* begun */
    int n;      /* fields of this one so far */
    char *text; /* [size] of table_line_open() */
    size_t size;
};
void table_line_head(struct table_line *o, const struct table_column *columns, int n);
void table_line_begin(struct table_line *o);
void table_line_number(struct table_line *o, const struct table_column *column, double x);
void table_line_text(struct table_line *o, const struct table_column *column, const char *text);
void table_line_end(struct table_line *o);
void table_line_foot(struct table_line *o);

/* In place of a file `to`: what is put between the two goes to a stream, at once. */
void table_line_open(struct table_line *o);
enum status table_line_send(struct table_line *o, struct stream *stream, struct report *report);

#endif
