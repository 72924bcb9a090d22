/* json.c -- a whole run as one JSON object; see sink.h
 *
 * Rows go out as they come.  Events belong behind them, so they wait, as text, in an arena of their
 * own; end writes them and closes what is open. */
#include <assert.h>
#include <string.h>

#include "out/cell.h"
#include "out/facts.h"
#include "out/sink.h"

struct note {
    struct note *next;
    const char *line; /* an event, without the comma before it */
};

struct json {
    struct stream *stream;
    struct arena *own; /* events and scratch */
    int n;             /* columns; 0: meta is not written */
    bool rows;         /* a row was written */
    struct note *first, **last;
};

static enum status put_text(struct json *o, const char *text, struct report *report)
{
    return stream_put(o->stream, text, strlen(text), report);
}

static enum status json_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct json *o = sink->self;
    o->n = meta->n;
    stream_reserve(o->stream, (size_t)meta->n * (NUMBER_MOST + 1) + 4);
    cJSON *item = cJSON_CreateObject();
    bool whole = facts_meta(item, meta, o->own);
    if (!whole) cJSON_Delete(item);
    TRY(facts_put(o->stream, "{\"meta\":", whole ? item : NULL, ",\n", report));
    TRY(facts_put(o->stream, "\"columns\":", facts_columns(meta), ",\n", report));
    return put_text(o, "\"rows\":[\n", report);
}

static enum status json_row(struct sink *sink, const double *x, struct report *report)
{
    struct json *o = sink->self;
    char *to = stream_begin(o->stream, (size_t)o->n * (NUMBER_MOST + 1) + 4);
    if (o->rows) *to++ = ',';
    *to++ = '[';
    for (int i = 0; i < o->n; i++) {
        to = cell_put(to, x[i], "null");
        *to++ = ',';
    }
    to[-1] = ']';
    *to++ = '\n';
    o->rows = true;
    return stream_end(o->stream, to, report);
}

static enum status json_event(struct sink *sink, double t, const char *kind, const char *text, struct report *report)
{
    struct json *o = sink->self;
    TRY(o->stream->status);
    cJSON *item = cJSON_CreateObject();
    char *line = facts_event(item, t, kind, text, o->own) ? cJSON_PrintUnformatted(item) : NULL;
    cJSON_Delete(item);
    if (!line) return facts_no_memory(o->stream, report);
    struct note *note = TAKE(o->own, struct note, 1);
    note->line = arena_copy(o->own, line, strlen(line));
    cJSON_free(line);
    *o->last = note;
    o->last = &note->next;
    return OK;
}

static enum status put_events(struct json *o, struct report *report)
{
    TRY(put_text(o, "\"events\":[\n", report));
    for (const struct note *note = o->first; note; note = note->next) {
        char *to = stream_begin(o->stream, strlen(note->line) + 2);
        to = stpcpy(stpcpy(stpcpy(to, note == o->first ? "" : ","), note->line), "\n");
        TRY(stream_end(o->stream, to, report));
    }
    return put_text(o, "],\n", report);
}

static enum status json_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    struct json *o = sink->self;
    assert(o->n > 0);
    TRY(put_text(o, "],\n", report));
    TRY(put_events(o, report));
    cJSON *item = cJSON_CreateObject();
    bool whole = facts_pairs(item, summary->facts, summary->n, o->own);
    if (!whole) cJSON_Delete(item);
    TRY(facts_put(o->stream, "\"summary\":", whole ? item : NULL, "}\n", report));
    return stream_flush(o->stream, report);
}

static enum status json_tick(struct sink *sink, double now, struct report *report)
{
    return stream_tick(((struct json *)sink->self)->stream, now, report);
}

static const struct sink_ops json_ops = {
    .meta = json_meta, .row = json_row, .event = json_event, .end = json_end, .tick = json_tick};

static void close_own(void *own)
{
    arena_close(own);
}

struct sink json_open(struct stream *stream, struct arena *life)
{
    struct json *o = TAKE(life, struct json, 1);
    *o = (struct json){.stream = stream, .own = arena_open()};
    o->last = &o->first;
    arena_defer(life, close_own, o->own);
    return (struct sink){&json_ops, o};
}
