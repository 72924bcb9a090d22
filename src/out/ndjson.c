/* ndjson.c -- one JSON object a line; see sink.h */
#include <string.h>

#include "out/cell.h"
#include "out/facts.h"
#include "out/sink.h"

struct ndjson {
    struct stream *stream;
    struct arena *life;
    struct arena *scratch; /* own: events leave life as it is */
    int n;
    const char **before; /* [n] what stands before each value: {"type":"row","t":  ,"hub.angle": */
    size_t *length;      /* [n] of before */
    size_t longest;      /* bytes of a row at most */
};

/* `item` as a line; whole: all its members were added. */
static enum status put_line(struct ndjson *o, cJSON *item, bool whole, struct report *report)
{
    if (!whole) cJSON_Delete(item);
    return facts_put(o->stream, "", whole ? item : NULL, "\n", report);
}

/* Names of columns are made of letters, digits, '_' and '.': they need no escape. */
static void row_keys(struct ndjson *o, const struct run_meta *meta)
{
    o->n = meta->n;
    o->before = TAKE(o->life, const char *, meta->n);
    o->length = TAKE(o->life, size_t, meta->n);
    o->longest = 2; /* } and newline */
    for (int i = 0; i < meta->n; i++) {
        o->before[i] = arena_print(o->life, "%s\"%s\":", i == 0 ? "{\"type\":\"row\"," : ",", meta->columns[i].name);
        o->length[i] = strlen(o->before[i]);
        o->longest += o->length[i] + NUMBER_MOST;
    }
    stream_reserve(o->stream, o->longest);
}

static enum status ndjson_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct ndjson *o = sink->self;
    for (int i = 0; i < meta->n; i++)
        if (strcmp(meta->columns[i].name, "type") == 0)
            return o->stream->status = fail(
                       report, E_DECK, "a column called 'type' cannot be written as ndjson: rename it, or choose csv");
    row_keys(o, meta);
    cJSON *item = cJSON_CreateObject();
    bool whole = facts_add(item, "type", cJSON_CreateString("meta")) && facts_meta(item, meta, o->scratch) &&
                 facts_add(item, "columns", facts_columns(meta));
    return put_line(o, item, whole, report);
}

static enum status ndjson_row(struct sink *sink, const double *x, struct report *report)
{
    struct ndjson *o = sink->self;
    char *to = stream_begin(o->stream, o->longest);
    for (int i = 0; i < o->n; i++) {
        memcpy(to, o->before[i], o->length[i]);
        to = cell_put(to + o->length[i], x[i], "null");
    }
    *to++ = '}';
    *to++ = '\n';
    return stream_end(o->stream, to, report);
}

static enum status ndjson_event(struct sink *sink, double t, const char *kind, const char *text, struct report *report)
{
    struct ndjson *o = sink->self;
    cJSON *item = cJSON_CreateObject();
    bool whole = facts_add(item, "type", cJSON_CreateString("event")) && facts_event(item, t, kind, text, o->scratch);
    return put_line(o, item, whole, report);
}

static enum status ndjson_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    struct ndjson *o = sink->self;
    cJSON *item = cJSON_CreateObject();
    bool whole = facts_add(item, "type", cJSON_CreateString("summary")) &&
                 facts_pairs(item, summary->facts, summary->n, o->scratch);
    TRY(put_line(o, item, whole, report));
    return stream_flush(o->stream, report);
}

static enum status ndjson_tick(struct sink *sink, double now, struct report *report)
{
    return stream_tick(((struct ndjson *)sink->self)->stream, now, report);
}

static const struct sink_ops ndjson_ops = {
    .meta = ndjson_meta, .row = ndjson_row, .event = ndjson_event, .end = ndjson_end, .tick = ndjson_tick};

static void close_scratch(void *scratch)
{
    arena_close(scratch);
}

struct sink ndjson_open(struct stream *stream, struct arena *life)
{
    struct ndjson *o = TAKE(life, struct ndjson, 1);
    *o = (struct ndjson){.stream = stream, .life = life, .scratch = arena_open()};
    arena_defer(life, close_scratch, o->scratch);
    return (struct sink){&ndjson_ops, o};
}
