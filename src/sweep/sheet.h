/* sheet.h -- the table of a sweep: a row a point, all of it texts, so that it is the same however it came together.
 *
 *     point,k,"max(arm.root.bending)",exit
 *     1,1000,2.5e7,0 */
#ifndef FMDSUB_SWEEP_SHEET_H
#define FMDSUB_SWEEP_SHEET_H

#include <stdio.h>

#include "out/stream.h"
#include "out/table.h"

struct sheet {
    int n;                             /* columns: the first is the point's number, the last how it ended */
    const struct table_column *column; /* [n] */
    long rows;                         /* places */
    int capacity;
    const char ***row; /* [rows][n] by the point's number less 1; NULL: it is not there */
    struct arena *life;
};

/* Reads the rows of a CSV file that another sweep has written; lines of names between them are skipped.  A sheet
 * without columns takes over those of the file, another one refuses a file with other columns.  An incomplete last
 * line is left out. */
enum status sheet_read(struct sheet *o, FILE *file, const char *name, struct report *report);

/* Row of point `i` (from 0): texts [o->n], kept as they are. */
void sheet_keep(struct sheet *o, long i, const char **text);

/* Writes the line of names, or the beginning of a JSON list; row i; the end of the list. */
enum status sheet_begin(const struct sheet *o, struct table_line *line, struct stream *stream, struct report *report);
enum status sheet_put(const struct sheet *o, long i, struct table_line *line, struct stream *stream,
                      struct report *report);
enum status sheet_end(struct table_line *line, struct stream *stream, struct report *report);

#endif
