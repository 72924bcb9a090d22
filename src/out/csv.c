/* csv.c -- rows as comma-separated values; see sink.h
 *
 * Names of columns are made of letters, digits, '_' and '.', numbers of digits, '-', '+', '.' and
 * 'e': nothing ever needs a quote. */
#include <string.h>

#include "out/number.h"
#include "out/sink.h"

struct csv {
    struct stream *stream;
    int n;
    size_t most; /* bytes of a line */
    bool units;
};

static enum status names_line(struct csv *csv, const struct run_meta *meta, struct report *report)
{
    char *to = stream_begin(csv->stream, csv->most);
    for (int i = 0; i < meta->n; i++) {
        to = stpcpy(to, meta->columns[i].name);
        *to++ = i + 1 < meta->n ? ',' : '\n';
    }
    return stream_end(csv->stream, to, report);
}

/* "[s],[rad]"; of what has none "[1]". */
static enum status units_line(struct csv *csv, const struct run_meta *meta, struct report *report)
{
    char *to = stream_begin(csv->stream, csv->most);
    for (int i = 0; i < meta->n; i++) {
        const char *unit = meta->columns[i].unit;
        *to++ = '[';
        to = stpcpy(to, unit && *unit ? unit : "1");
        *to++ = ']';
        *to++ = i + 1 < meta->n ? ',' : '\n';
    }
    return stream_end(csv->stream, to, report);
}

static enum status csv_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct csv *csv = sink->self;
    csv->n = meta->n;
    size_t names = 0, units = 0, row = (size_t)meta->n * (NUMBER_MOST + 1);
    for (int i = 0; i < meta->n; i++) {
        names += strlen(meta->columns[i].name) + 1;
        units += 4 + (meta->columns[i].unit ? strlen(meta->columns[i].unit) : 0);
    }
    const size_t head = names > units ? names : units;
    csv->most = head > row ? head : row;
    stream_reserve(csv->stream, csv->most);
    TRY(names_line(csv, meta, report));
    return csv->units ? units_line(csv, meta, report) : OK;
}

static enum status csv_row(struct sink *sink, const double *x, struct report *report)
{
    struct csv *csv = sink->self;
    char *to = number_list(stream_begin(csv->stream, (size_t)csv->n * (NUMBER_MOST + 1)), x, csv->n);
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

static const struct sink_ops csv_ops = {
    .meta = csv_meta, .row = csv_row, .event = csv_event, .end = csv_end, .tick = csv_tick};

static struct sink open_csv(struct stream *stream, bool units, struct arena *life)
{
    struct csv *csv = TAKE(life, struct csv, 1);
    csv->stream = stream;
    csv->units = units;
    return (struct sink){&csv_ops, csv};
}

struct sink csv_open(struct stream *stream, struct arena *life)
{
    return open_csv(stream, false, life);
}

struct sink csv_open_units(struct stream *stream, struct arena *life)
{
    return open_csv(stream, true, life);
}
