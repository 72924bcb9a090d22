/* csv.c -- rows as comma-separated values; see sink.h
 *
 * Names of columns are made of letters, digits, '_' and '.', numbers of digits, '-', '+', '.' and
 * 'e': nothing ever needs a quote. */
#include <string.h>

#include "out/cell.h"
#include "out/sink.h"

struct csv {
    struct stream *stream;
    int n;
};

static enum status csv_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct csv *csv = sink->self;
    csv->n = meta->n;
    size_t names = 0, row = (size_t)meta->n * (NUMBER_MOST + 1);
    for (int i = 0; i < meta->n; i++) names += strlen(meta->columns[i].name) + 1;
    stream_reserve(csv->stream, names > row ? names : row);
    char *to = stream_begin(csv->stream, names);
    for (int i = 0; i < meta->n; i++) {
        to = stpcpy(to, meta->columns[i].name);
        *to++ = i + 1 < meta->n ? ',' : '\n';
    }
    return stream_end(csv->stream, to, report);
}

static enum status csv_row(struct sink *sink, const double *x, struct report *report)
{
    struct csv *csv = sink->self;
    char *to = stream_begin(csv->stream, (size_t)csv->n * (NUMBER_MOST + 1));
    for (int i = 0; i < csv->n; i++) {
        to = cell_put(to, x[i], "");
        *to++ = ',';
    }
    to[-1] = '\n';
    return stream_end(csv->stream, to, report);
}

static enum status csv_event(struct sink *sink, double t, const char *kind, const char *text, struct report *report)
{
    (void)t, (void)kind, (void)text, (void)report;
    return ((struct csv *)sink->self)->stream->status;
}

static enum status csv_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    (void)summary;
    return stream_flush(((struct csv *)sink->self)->stream, report);
}

static enum status csv_tick(struct sink *sink, double now, struct report *report)
{
    return stream_tick(((struct csv *)sink->self)->stream, now, report);
}

static const struct sink_ops csv_ops = {csv_meta, csv_row, csv_event, csv_end, csv_tick};

struct sink csv_open(struct stream *stream, struct arena *life)
{
    struct csv *csv = TAKE(life, struct csv, 1);
    csv->stream = stream;
    return (struct sink){&csv_ops, csv};
}
