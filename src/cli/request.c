/* request.c -- options, by getopt_long, with our own words for what is wrong */
#include <getopt.h>
#include <stddef.h>
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"
#include "out/columns.h"

/* Where in the request an option goes: a flag if it takes no value, else its text; OWN: take() has more to do. */
#define TO(member) offsetof(struct request, member)
enum { OWN = 0 };

const struct cli_option cli_options[] = {
    {"format", "csv|ndjson|json", 'f', "run check study modes stability diff sweep explain list",
     "form of records and tables (default csv); check: json, csv", TO(format)},
    {"output", "FILE", 'o', "run study plot diff sweep animate",
     "write there; renamed from FILE.part when whole (plot: .svg, .png, .pdf; animate: .html, .glb, .pvd, .svg)",
     TO(output)},
    {"set", "PATH=VALUE", 's', "run check study plot modes stability list diff sweep explain animate",
     "change the deck: --set integrate.ratio=10", OWN},
    {"columns", "'t,hub.*'", 'c', "run plot diff animate",
     "columns in place of the deck's, also NAME=EXPRESSION of columns", OWN},
    {"every", "SECONDS", 0, "run plot diff sweep animate", "time between records", OWN},
    {"every-steps", "N", 0, "run", "major steps between records", OWN},
    {"until", "SECONDS", 0, "run study plot diff sweep explain animate", "end of the run", OWN},
    {"stats", "[FILE]", 0, "run", "counts and CPU time of the run, to stderr or FILE", OWN},
    {"progress", "auto|always|never", 0, "run sweep", "progress line on stderr (auto: on a terminal)", TO(progress)},
    {"units", NULL, 0, "run", "CSV: units in a second line, [s],[rad]; NDJSON and JSON have them always", TO(units)},
    {"final-state", "FILE", 0, "run", "where it ends, for 'initial: {from: FILE}'", TO(final_state)},
    {"resume", "FILE", 0, "run", "go on from a checkpoint, with -o behind what is there of the records",
     TO(resume_from)},
    {"strict", NULL, 0, "run check", "warnings and rejected steps give exit 1", TO(strict)},
    {"verify", NULL, 0, "run", "a second run at half the step or a tenth of the tolerance; what differs", TO(verify)},
    {"schemes", "a,b", 0, "study stability", "schemes to compare (default: those that make sense for the deck)",
     TO(schemes)},
    {"ratios", "1,5,10", 0, "study stability", "ratios for sub-cycling schemes", TO(ratios)},
    {"steps", "h1,h2", 0, "study stability", "minor steps of schemes that take one (default: the deck's and its parts)",
     TO(steps)},
    {"tolerances", "1e-3,1e-5", 0, "study", "of schemes that choose their own steps (default: 1e-2 to 1e-9)",
     TO(tolerances)},
    {"pick", "ERROR", 0, "study", "print the cheapest setting of that error as lines of a deck, nothing else",
     TO(pick)},
    {"repeats", "N", 0, "study", "time each run N times, keep the least (0: no times; default: up to 3)", TO(repeats)},
    {"budget", "SECONDS|none", 0, "study", "CPU time that it may take, foretold by counts (default 60)", TO(budget)},
    {"plot", "FILE", 0, "study stability", "a picture, by gnuplot: FILE.svg, FILE.png or FILE.pdf", TO(plot)},
    {"report", "FILE.html", 0, "study", "one page: sentences, diagram, table, curves, deck", TO(page)},
    {"script", NULL, 0, "study plot stability", "print what gnuplot would be given, draw nothing", TO(script)},
    {"absolute", NULL, 0, "study", "errors in the unit of the worst column", TO(absolute)},
    {"rel", "1e-6,PATTERN=1e-3", 0, "diff", "allowed difference, as a share of the column's largest value in A",
     TO(rel)},
    {"abs", "1e-12,PATTERN=X", 0, "diff", "and in the column's unit, added to that", TO(abs)},
    {"over", "NAME=VALUES", 0, "sweep", "a parameter or deck path: [a, b], from:to:n, from:to:log:n, ~normal(mean,sd)",
     OWN},
    {"sample", "N", 0, "sweep", "how often what has a distribution is drawn: normal, uniform, loguniform", TO(sample)},
    {"seed", "N", 0, "sweep", "of what is drawn (default 1)", TO(seed)},
    {"latin", NULL, 0, "sweep", "draw by Latin hypercube: each N-th part of a range once", TO(latin)},
    {"of", "'max(a.b), last(t)'", 0, "sweep", "numbers to keep of each run (default: last of every column)", TO(of)},
    {"times", NULL, 0, "sweep", "a column of CPU seconds", TO(times)},
    {"jobs", "N", 0, "sweep", "points at once (default: one for each processor)", TO(jobs)},
    {"resume", NULL, 0, "sweep", "go on with what --output FILE holds already", TO(resume)},
    {"shard", "I/N", 0, "sweep", "the I-th of N parts only", TO(shard)},
    {"list", NULL, 0, "sweep", "print a command for each point, run nothing", TO(list)},
    {"slurm", "N", 0, "sweep", "print a job script of N tasks, run nothing", TO(slurm)},
    {"merge", NULL, 0, "sweep", "put tables of parts together: the words are files", TO(merge)},
    {"at", "SECONDS", 0, "modes stability", "linearise there instead of at the start", TO(at)},
    {"expanded", NULL, 0, "check", "print the deck after parameters, repeat, include, --set, defaults", TO(expanded)},
    {"no-trial", NULL, 0, "check", "no trial runs: steps by the frequencies at the start", TO(no_trial)},
    {"quiet", NULL, 'q', NULL, "no plan line, no summary", TO(quiet)},
    {"verbose", NULL, 'v', "run", "the counts of --stats on stderr", TO(verbose)},
    {"max-memory", "SIZE", 0, NULL, "exit 7 rather than take more: 500M, 4G (default: 3/4 of the machine's)",
     TO(max_memory)},
    {"max-time", "SECONDS", 0, NULL, "end in good order after so long by the clock, exit 7", TO(max_time)},
    {"color", "auto|always|never", 0, NULL, "colours in messages (auto: on a terminal)", TO(color)},
    {"version", NULL, 'V', NULL, "print the version", TO(version)},
    {"help", NULL, 'h', NULL, "print this", TO(help)},
    {0},
};

enum { MOST_OPTIONS = 64, FIRST_CODE = 1000 };

static int count_options(void)
{
    int n = 0;
    while (cli_options[n].name) n++;
    return n;
}

/* The first word that is a verb, as far as it can be seen before options are read. */
static const char *probable_verb(int argc, char **argv)
{
    for (int k = 1; k < argc; k++)
        for (int i = 0; cli_options[i].name; i++)
            if (*argv[k] && cli_options[i].verbs && cli_serves(&cli_options[i], argv[k])) return argv[k];
    return "";
}

/* One name may be two options: run --resume FILE, sweep --resume.  Of those the verb's own is meant, else the first. */
static bool is_meant(int option, const char *verb)
{
    const char *name = cli_options[option].name;
    int meant = -1;
    for (int i = count_options() - 1; i >= 0; i--)
        if (strcmp(cli_options[i].name, name) == 0 && (meant < 0 || !cli_serves(&cli_options[meant], verb))) meant = i;
    return meant == option;
}

static void build(struct option *longs, char *shorts, const char *verb)
{
    int n = count_options();
    *shorts++ = ':';
    for (int i = 0; i < n; i++) {
        const struct cli_option *o = &cli_options[i];
        int takes = !o->value ? no_argument : o->value[0] == '[' ? optional_argument : required_argument;
        if (is_meant(i, verb)) *longs++ = (struct option){o->name, takes, NULL, FIRST_CODE + i};
        if (!o->letter) continue;
        *shorts++ = o->letter;
        if (takes == required_argument) *shorts++ = ':';
    }
    *shorts = 0;
}

/* The option of a code that getopt_long returned; -1: none. */
static int option_of(int code)
{
    if (code >= FIRST_CODE) return code - FIRST_CODE;
    for (int i = 0; cli_options[i].name; i++)
        if (cli_options[i].letter == code) return i;
    return -1;
}

static enum status unknown_option(const char *word, struct report *report)
{
    const char *names[MOST_OPTIONS];
    char bare[64];
    int n = count_options();
    for (int i = 0; i < n; i++) names[i] = cli_options[i].name;
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(word + strspn(word, "-"), "="), word + strspn(word, "-"));
    for (int i = 0; i < n; i++)
        if (strcmp(names[i], bare) == 0) return fail(report, E_USAGE, "option '--%s' takes no value", bare);
    const char *nearest = text_nearest(bare, names, n);
    if (nearest)
        return fail(report, E_USAGE, "unknown option '%.80s': did you mean '--%s'? (fmdsub --help)", word, nearest);
    return fail(report, E_USAGE, "unknown option '%.80s' (fmdsub --help)", word);
}

static enum status add_set(struct request *o, const char *option, const char *set, struct report *report)
{
    if (o->nset == MOST_SETS) return fail(report, E_USAGE, "more than %d settings", MOST_SETS);
    o->option[o->nset] = option;
    o->set[o->nset++] = set;
    return OK;
}

static enum status add_assignment(struct request *o, const char *set, struct report *report)
{
    if (!strchr(set, '=') || *set == '=') return fail(report, E_USAGE, "--set takes PATH=VALUE, not '%.40s'", set);
    return add_set(o, NULL, set, report);
}

static enum status add_columns(struct request *o, const char *list, struct arena *life, struct report *report)
{
    int n;
    const char **item = columns_split(&n, list, life);
    o->columns = list;
    if (!n) return fail(report, E_USAGE, "--columns names no column");
    return add_set(o, "--columns", columns_setting(item, n, life), report);
}

static enum status add_over(struct request *o, const char *value, struct report *report)
{
    if (o->nover == MOST_OVERS) return fail(report, E_USAGE, "more than %d times --over", MOST_OVERS);
    o->over[o->nover++] = value;
    return OK;
}

static enum status take(struct request *o, const struct cli_option *option, const char *value, struct arena *life,
                        struct report *report)
{
    const char *name = option->name;
    void *to = (char *)o + option->to;
    if (option->to != OWN && option->value) return *(const char **)to = value, OK;
    if (option->to != OWN) return *(bool *)to = true, OK;
    if (strcmp(name, "set") == 0) return add_assignment(o, value, report);
    if (strcmp(name, "columns") == 0) return add_columns(o, value, life, report);
    if (strcmp(name, "over") == 0) return add_over(o, value, report);
    if (strcmp(name, "every") == 0) return add_set(o, "--every", arena_print(life, "output.every=%s", value), report);
    if (strcmp(name, "every-steps") == 0)
        return add_set(o, "--every-steps", arena_print(life, "output.every={steps: %s}", value), report);
    if (strcmp(name, "until") == 0)
        return add_set(o, "--until", arena_print(life, "integrate.until=%s", value), report);
    o->want_stats = true; /* stats */
    o->stats = value;
    return OK;
}

static enum status check_word(const char *option, const char *word, const char *choices, struct report *report)
{
    size_t len = word ? strlen(word) : 0;
    for (const char *c = choices; word && *c; c += strcspn(c, "|"), c += *c == '|')
        if (strcspn(c, "|") == len && strncmp(c, word, len) == 0) return OK;
    return word ? fail(report, E_USAGE, "--%s takes one of %s, not '%.40s'", option, choices, word) : OK;
}

static enum status check_name(const char *option, const char *file, struct report *report)
{
    return file && !*file ? fail(report, E_USAGE, "%s needs the name of a file", option) : OK;
}

/* Is verb among words, such as "run study"? */
static bool serves(const char *words, const char *verb)
{
    size_t len = strlen(verb);
    for (const char *v = words; *v; v += strcspn(v, " "), v += *v == ' ')
        if (strcspn(v, " ") == len && strncmp(v, verb, len) == 0) return true;
    return false;
}

bool cli_serves(const struct cli_option *option, const char *verb)
{
    return !option->verbs || serves(option->verbs, verb);
}

enum status request_check(const struct request *o, struct report *report)
{
    for (int i = 0; cli_options[i].name; i++)
        if (o->given >> i & 1 && cli_options[i].verbs && !serves(cli_options[i].verbs, o->verb))
            return fail(report, E_USAGE, "'fmdsub %s' has no option '--%s': it belongs to %s", o->verb,
                        cli_options[i].name, cli_options[i].verbs);
    return OK;
}

/* Words with more in them than names and numbers have stand in quotes. */
static const char *command_of(int argc, char **argv, struct arena *life)
{
    const char *o = "fmdsub";
    for (int i = 1; i < argc; i++) {
        const bool plain = *argv[i] && !argv[i][strcspn(argv[i], " \t\n'\"\\$`*?[](){}<>|&;#~!")];
        o = arena_print(life, plain ? "%s %s" : "%s '%s'", o, argv[i]);
    }
    return o;
}

enum status request_read(struct request *o, int argc, char **argv, struct arena *life, struct report *report)
{
    struct option longs[MOST_OPTIONS] = {0};
    char shorts[2 * MOST_OPTIONS];
    *o = (struct request){.command = command_of(argc, argv, life)};
    build(longs, shorts, probable_verb(argc, argv));
    opterr = 0;
    for (int code; (code = getopt_long(argc, argv, shorts, longs, NULL)) != -1;) {
        if (code == ':') return fail(report, E_USAGE, "option '%.80s' needs a value (fmdsub --help)", argv[optind - 1]);
        if (code == '?') return unknown_option(argv[optind - 1], report);
        o->given |= 1ul << option_of(code);
        TRY(take(o, &cli_options[option_of(code)], optarg, life, report));
    }
    if (optind < argc) o->verb = argv[optind++];
    o->nword = argc - optind;
    o->word = argv + optind;
    if (o->output && strcmp(o->output, "-") == 0) o->output = NULL; /* standard output */
    TRY(check_name("--output", o->output, report));
    TRY(check_name("--stats=", o->stats, report));
    TRY(check_name("--final-state", o->final_state, report));
    TRY(check_name("--resume", o->resume_from, report));
    TRY(check_name("--report", o->page, report));
    TRY(check_word("format", o->format, "csv|ndjson|json", report));
    TRY(check_word("progress", o->progress, "auto|always|never", report));
    return check_word("color", o->color, "auto|always|never", report);
}
