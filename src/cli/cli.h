/* cli.h -- the command line: what was asked for, and the verbs. */
#ifndef FMDSUB_CLI_CLI_H
#define FMDSUB_CLI_CLI_H

#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/status.h"
#include "deck/diag.h"
#include "sim/load.h"

#define FMDSUB_VERSION "0.1.0"

enum { MOST_SETS = 256, MOST_OVERS = 32 };

/* The command line, read. */
struct request {
    const char *verb;
    int nword;
    char **word; /* what is not an option */
    int nset;
    const char *set[MOST_SETS];    /* --set, and --columns, --every, --until as such */
    const char *option[MOST_SETS]; /* the option it came by; NULL: --set */
    const char *format, *output, *stats, *schemes, *ratios, *steps, *tolerances, *pick, *repeats, *budget, *plot,
        *columns, *at, *final_state, *resume_from, *rel, *abs, *sample, *seed, *of, *jobs, *shard, *slurm;
    const char *page;    /* --report */
    const char *command; /* all of it, as a shell reads it */
    int nover;
    const char *over[MOST_OVERS];
    bool quiet, verbose, want_stats, strict, expanded, absolute, script, units, no_trial, latin, times, resume, list,
        merge, verify, help, version;
    const char *progress, *color, *max_memory, *max_time;
    unsigned long given; /* bit i: option i of the table */
};

/* An option of the program; the table serves the reader, the help and completion. */
struct cli_option {
    const char *name, *value; /* value: its word in the help, NULL: takes none */
    char letter;              /* 0: none */
    const char *verbs;        /* "run study"; NULL: all */
    const char *brief;
    size_t to; /* of struct request: request.c */
};
extern const struct cli_option cli_options[];
bool cli_serves(const struct cli_option *option, const char *verb);

enum status request_read(struct request *o, int argc, char **argv, struct arena *life, struct report *report);
/* An option that would do nothing for the verb is a misunderstanding. */
enum status request_check(const struct request *o, struct report *report);

struct verb {
    const char *name, *usage, *brief;
    enum status (*run)(const struct request *request, struct arena *life, struct report *report);
};
extern const struct verb verbs[];

enum status verb_run(const struct request *request, struct arena *life, struct report *report);
enum status verb_check(const struct request *request, struct arena *life, struct report *report);
enum status verb_study(const struct request *request, struct arena *life, struct report *report);
enum status verb_diff(const struct request *request, struct arena *life, struct report *report);
enum status verb_plot(const struct request *request, struct arena *life, struct report *report);
enum status verb_animate(const struct request *request, struct arena *life, struct report *report);
enum status verb_sweep(const struct request *request, struct arena *life, struct report *report);
enum status verb_modes(const struct request *request, struct arena *life, struct report *report);
enum status verb_stability(const struct request *request, struct arena *life, struct report *report);
enum status verb_selftest(const struct request *request, struct arena *life, struct report *report);
enum status verb_list(const struct request *request, struct arena *life, struct report *report);
enum status verb_schema(const struct request *request, struct arena *life, struct report *report);
enum status verb_explain(const struct request *request, struct arena *life, struct report *report);
/* explain of a deck: its effects */
enum status explain_deck(const struct request *request, struct arena *life, struct report *report);
enum status verb_new(const struct request *request, struct arena *life, struct report *report);

/* The only deck named, read and checked; its warnings and errors are printed. */
enum status cli_load(struct scene **scene, struct diags **diags, const struct request *request, struct arena *life,
                     struct report *report);
/* That deck, which has been read, once more: what it says against these effects (effect_bit()) is not heard. */
enum status cli_load_again(struct scene **scene, struct diags **diags, const struct request *request,
                           const struct scene *before, unsigned unheard, struct arena *life, struct report *report);
/* Likewise, for a run: what it leaves open is chosen (study/auto.h). */
enum status cli_load_run(struct scene **scene, struct diags **diags, const struct request *request, struct arena *life,
                         struct report *report);
/* Files are read below the deck's folder only, and written where the outputs are, where the system can see to it. */
void cli_confine(const struct request *request, struct arena *life);
bool cli_color(const struct request *request);

/* Prints what has been found; the status, as it is if that was found in options.  Stands here, so
 * that lint sees that what has failed is not OK behind it. */
static inline enum status cli_told(const struct diags *diags, const struct request *request, enum status status)
{
    if (!diags) return status;
    diags_print(stderr, diags, cli_color(request));
    return status == E_DECK && diags_status(diags) == E_USAGE ? E_USAGE : status;
}

/* The run on to --at. */
struct sim;
enum status cli_go_to(struct sim *sim, const struct request *request, struct report *report);

/* check --format json, csv */
struct model;
/* A frequency that moves nothing in the whole run is round-off: none. */
double check_omega(const struct sim *sim, double omega);
/* The name of what a body hangs on: of the flexible body at whose node it is. */
const char *check_parent(const struct model *m, int body);
/* advice NULL: not asked for. */
struct advice;
enum status check_json(struct sim *sim, const struct advice *advice, bool rows, struct arena *life,
                       struct report *report);
/* The object as rows of topic, name, fact, value, unit. */
struct cJSON;
enum status check_rows(const struct cJSON *object, struct arena *life, struct report *report);

#endif
