/* sink.h -- what a run writes into.
 *
 * A run tells a sink, in this order: meta once, then rows and events as they come, end once, also
 * when the run was stopped; tick now and then between, passed every so many steps.  Nothing reported depends on the clock or the
 * machine: same deck, same bytes.  The writers below are sinks on a stream; a study is another.
 *
 * csv      One header line of plain names, then one line a row; a value that is not finite is an
 *          empty field.  Events, meta and summary are not written.
 *
 * ndjson   One object a line, "type" first, so that `jq 'select(.type == "row")'` sorts them and a row
 *          goes flat into any data frame:
 *              {"type":"meta","program":"fmdsub","version":...,"title":...,"deck":...,"hash":...,
 *               "settings":{...},"units":{"t":"s","hub.angle":"rad"},"columns":["t","hub.angle"]}
 *              {"type":"row","t":0,"hub.angle":0.5}
 *              {"type":"event","t":0.25,"kind":"stop","text":"..."}
 *              {"type":"summary","status":"done",...}
 *          A value that is not finite is null.  A column called "type" is refused.
 *
 * json     One object for short runs, rows as arrays and one to a line; whole at the end, also of a
 *          run that was stopped (summary tells).  Events wait in memory for the end.
 *              {"meta":{...,"units":{...}},
 *              "columns":["t","hub.angle"],
 *              "rows":[
 *              [0,0.5]
 *              ,[0.01,0.5005]
 *              ],
 *              "events":[
 *              {"t":0.25,"kind":"stop","text":"..."}
 *              ],
 *              "summary":{...}}
 */
#ifndef FMDSUB_OUT_SINK_H
#define FMDSUB_OUT_SINK_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/status.h"
#include "out/columns.h"
#include "out/stream.h"

/* A fact with its name, in the order it is to be reported. */
enum pair_kind { PAIR_NUMBER, PAIR_TEXT, PAIR_BOOL };

struct pair {
    const char *key;
    enum pair_kind kind;
    double number;    /* PAIR_NUMBER; not finite: null */
    const char *text; /* PAIR_TEXT; NULL: null */
    bool truth;       /* PAIR_BOOL */
};

static inline struct pair pair_number(const char *key, double number)
{
    return (struct pair){.key = key, .kind = PAIR_NUMBER, .number = number};
}

static inline struct pair pair_text(const char *key, const char *text)
{
    return (struct pair){.key = key, .kind = PAIR_TEXT, .text = text};
}

static inline struct pair pair_bool(const char *key, bool truth)
{
    return (struct pair){.key = key, .kind = PAIR_BOOL, .truth = truth};
}

struct run_meta {
    const char *version; /* of the program */
    const char *title;   /* of the deck; NULL: none */
    const char *deck;    /* its name as given */
    const char *hash;    /* of its text, FNV-1a, 64 bits in hex */
    int nsettings;
    const struct pair *settings; /* [nsettings] resolved: scheme, step, ratio, until, ... */
    int n;
    const struct column *columns; /* [n] the chosen ones, t first */
};

struct run_summary {
    int n;
    const struct pair *facts; /* [n] status, t_end, steps, evaluations, energy residual, ... */
};

struct sink;

/* row is required; who has nothing to do with the rest leaves it NULL.  Texts and arrays belong to the caller
 * and are read before the call returns.  A failure stays: whatever is reported after it returns it again. */
struct sink_ops {
    enum status (*meta)(struct sink *sink, const struct run_meta *meta, struct report *report);
    /* x [n]: the chosen columns.  Allocates nothing. */
    enum status (*row)(struct sink *sink, const double *x, struct report *report);
    enum status (*event)(struct sink *sink, double t, const char *kind, const char *text, struct report *report);
    enum status (*end)(struct sink *sink, const struct run_summary *summary, struct report *report);
    /* now: monotonic time [s]; cheap, for every major step: what waited 0.2 s is sent. */
    enum status (*tick)(struct sink *sink, double now, struct report *report);
    /* Behind every record and every so many steps, by count: what ends a run by its work is looked at here, not by a clock. */
    enum status (*passed)(struct sink *sink, struct report *report);
};

struct sink {
    const struct sink_ops *ops;
    void *self;
};

/* A sink that is NULL, or has no such slot, takes nothing. */
static inline enum status sink_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    return sink && sink->ops->meta ? sink->ops->meta(sink, meta, report) : OK;
}

static inline enum status sink_event(struct sink *sink, double t, const char *kind, const char *text,
                                     struct report *report)
{
    return sink && sink->ops->event ? sink->ops->event(sink, t, kind, text, report) : OK;
}

static inline enum status sink_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    return sink && sink->ops->end ? sink->ops->end(sink, summary, report) : OK;
}

static inline enum status sink_tick(struct sink *sink, double now, struct report *report)
{
    return sink && sink->ops->tick ? sink->ops->tick(sink, now, report) : OK;
}

static inline enum status sink_passed(struct sink *sink, struct report *report)
{
    return sink && sink->ops->passed ? sink->ops->passed(sink, report) : OK;
}

/* The writers, a NULL name at the end.  open makes a sink that writes to stream, which the caller
 * opened and closes; its memory is life's. */
struct format {
    const char *name;  /* option word: "csv" */
    const char *brief; /* one line for help and manual */
    struct sink (*open)(struct stream *stream, struct arena *life);
};

extern const struct format formats[];
/* NULL: there is none of that name. */
const struct format *format_find(const char *name);

struct sink csv_open(struct stream *stream, struct arena *life);
/* With a second line of units, "[s],[rad]". */
struct sink csv_open_units(struct stream *stream, struct arena *life);
struct sink ndjson_open(struct stream *stream, struct arena *life);
struct sink json_open(struct stream *stream, struct arena *life);

#endif
