/* diff.c -- fmdsub diff: two records side by side, column by column, at the times that both have
 *
 * A column is the same where |b - a| <= abs + rel max|a| at all of these times, a of the first record, b of the second. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/cli.h"
#include "cli/curves.h"
#include "out/columns.h"
#include "out/table.h"
#include "out/targets.h"

static const double REL = 1e-6, ABS = 1e-12; /* where nobody says otherwise */
static const double SAME_TIME = 1e-9;        /* of the interval between records */

/* What is allowed of the columns that fit a pattern; the last one that fits counts. */
struct rule {
    const char *pattern;
    double rel, abs; /* NAN: not said here */
};

struct diff {
    const struct curves *a, *b;
    int nrule;
    struct rule *rule; /* [nrule] */
    int npattern;
    const char **pattern; /* [npattern] of the columns that are compared; 0: all */
    int n;
    int *ia, *ib; /* [n] rows of the same time */
    int differ, compared;
};

/* ---- what is allowed ---- */

static enum status add_rule(struct diff *o, const char *option, const char *item, struct arena *life,
                            struct report *report)
{
    const char *equal = strrchr(item, '='), *number = equal ? equal + 1 : item;
    char *end;
    const double x = strtod(number, &end);
    if (end == number || *end || !(x >= 0) || !isfinite(x))
        return fail(report, E_USAGE, "--%s takes NUMBER or PATTERN=NUMBER, separated by commas, not '%.80s'", option,
                    item);
    const bool rel = strcmp(option, "rel") == 0;
    o->rule[o->nrule++] =
        (struct rule){equal ? arena_copy(life, item, (size_t)(equal - item)) : "*", rel ? x : NAN, rel ? NAN : x};
    return OK;
}

static enum status read_rules(struct diff *o, const struct request *request, struct arena *life, struct report *report)
{
    int nrel = 0, nabs = 0;
    const char **rel = request->rel ? columns_split(&nrel, request->rel, life) : NULL;
    const char **abs = request->abs ? columns_split(&nabs, request->abs, life) : NULL;
    if (request->rel && !nrel) return fail(report, E_USAGE, "--rel names no number");
    if (request->abs && !nabs) return fail(report, E_USAGE, "--abs names no number");
    o->rule = TAKE(life, struct rule, nrel + nabs);
    for (int i = 0; i < nrel; i++) TRY(add_rule(o, "rel", rel[i], life, report));
    for (int i = 0; i < nabs; i++) TRY(add_rule(o, "abs", abs[i], life, report));
    return OK;
}

static double allowed(const struct diff *o, const char *name, double largest)
{
    double rel = REL, abs = ABS;
    for (int i = 0; i < o->nrule; i++) {
        if (!text_match(o->rule[i].pattern, name)) continue;
        if (!isnan(o->rule[i].rel)) rel = o->rule[i].rel;
        if (!isnan(o->rule[i].abs)) abs = o->rule[i].abs;
    }
    return abs + rel * largest;
}

/* ---- times ---- */

static double at(const struct curves *o, int row, int column)
{
    return o->x[(size_t)row * (size_t)o->n + (size_t)column];
}

static double first(const struct curves *o)
{
    return at(o, 0, 0);
}

static double last(const struct curves *o)
{
    return at(o, o->rows - 1, 0);
}

static double interval(const struct curves *o)
{
    return o->rows > 1 ? (last(o) - first(o)) / (o->rows - 1) : INFINITY;
}

static double same_time(const struct diff *o)
{
    const double each = fmin(interval(o->a), interval(o->b));
    return SAME_TIME * (isfinite(each) && each > 0 ? each : fmax(1, fabs(last(o->a))));
}

/* Rows of the same time, each taken once: what is written twice at a jump meets what the other has twice. */
static enum status match_times(struct diff *o, struct arena *life, struct report *report)
{
    const double little = same_time(o);
    o->ia = TAKE(life, int, o->a->rows);
    o->ib = TAKE(life, int, o->a->rows);
    for (int i = 0, j = 0; i < o->a->rows && j < o->b->rows;) {
        const double d = at(o->b, j, 0) - at(o->a, i, 0);
        if (fabs(d) <= little) {
            o->ia[o->n] = i++;
            o->ib[o->n++] = j++;
        } else if (d > 0)
            i++;
        else
            j++;
    }
    if (o->n) return OK;
    return fail(report, E_USAGE, "%s and %s have no time in common: %s %.12g to %.12g and %.12g to %.12g", o->a->file,
                o->b->file, o->a->column[0].name, first(o->a), last(o->a), first(o->b), last(o->b));
}

/* ---- columns ---- */

static bool is_asked(const struct diff *o, const char *name)
{
    for (int i = 0; i < o->npattern; i++)
        if (text_match(o->pattern[i], name)) return true;
    return o->npattern == 0;
}

static const struct table_column columns[] = {{"column", NULL, 0},  {"unit", NULL, 0},   {"difference", NULL, 3},
                                              {"allowed", NULL, 3}, {"t", "at t", 12},   {"a", NULL, 12},
                                              {"b", NULL, 12},      {"verdict", NULL, 0}};

static void put(struct table *table, const struct column *c, const double x[5], const char *verdict)
{
    table_text(table, c->name);
    table_text(table, c->unit ? c->unit : "");
    for (int i = 0; i < 5; i++) table_number(table, x[i]);
    table_text(table, verdict);
}

/* Differences are compared as they are; a value that only one of them has is a difference beyond all. */
static void compare(struct diff *o, int ca, int cb, struct table *table)
{
    double most = -1, largest = 0;
    int worst = 0;
    for (int k = 0; k < o->n; k++) {
        const double a = at(o->a, o->ia[k], ca), b = at(o->b, o->ib[k], cb);
        const double d = isnan(a) && isnan(b) ? 0 : a == b ? 0 : isfinite(a) && isfinite(b) ? fabs(b - a) : INFINITY;
        if (isfinite(a)) largest = fmax(largest, fabs(a));
        if (d > most) most = d, worst = k;
    }
    const double limit = allowed(o, o->a->column[ca].name, largest);
    const bool differs = !(most <= limit);
    const double x[] = {most, limit, at(o->a, o->ia[worst], 0), at(o->a, o->ia[worst], ca), at(o->b, o->ib[worst], cb)};
    put(table, &o->a->column[ca], x, differs ? "differs" : "same");
    o->differ += differs;
    o->compared++;
}

static void put_lone(struct diff *o, const struct column *c, const char *verdict, struct table *table)
{
    static const double none[] = {NAN, NAN, NAN, NAN, NAN};
    put(table, c, none, verdict);
    o->differ++;
}

/* The column of `in` for column i of `from`: of several of one name the first is the first's; -1: there is none. */
static int counterpart(const struct curves *from, int i, const struct curves *in)
{
    int before = 0;
    for (int k = 1; k < i; k++) before += strcmp(from->column[k].name, from->column[i].name) == 0;
    for (int k = 1; k < in->n; k++)
        if (strcmp(in->column[k].name, from->column[i].name) == 0 && before-- == 0) return k;
    return -1;
}

/* A column that one of them lacks is a difference; with --columns those are compared that both have. */
static void compare_all(struct diff *o, struct table *table)
{
    for (int i = 1; i < o->a->n; i++) {
        const int j = counterpart(o->a, i, o->b);
        if (!is_asked(o, o->a->column[i].name)) continue;
        if (j >= 0)
            compare(o, i, j, table);
        else if (!o->npattern)
            put_lone(o, &o->a->column[i], "only in a", table);
    }
    for (int j = 1; j < o->b->n && !o->npattern; j++)
        if (counterpart(o->b, j, o->a) < 0) put_lone(o, &o->b->column[j], "only in b", table);
}

/* Every pattern is to find something. */
static enum status check_patterns(const struct diff *o, struct report *report)
{
    for (int p = 0; p < o->npattern; p++) {
        bool found = false;
        for (int i = 0; i < o->a->n; i++)
            found = found ||
                    (text_match(o->pattern[p], o->a->column[i].name) && curves_find(o->b, o->a->column[i].name) >= 0);
        if (!found) return fail(report, E_USAGE, "--columns: no column that both have fits '%.80s'", o->pattern[p]);
    }
    return OK;
}

/* ---- the whole ---- */

/* Does one begin or end where the other does not? */
static bool ends_differ(const struct diff *o)
{
    const double little = same_time(o);
    return fabs(first(o->a) - first(o->b)) > little || fabs(last(o->a) - last(o->b)) > little;
}

static void say(const struct diff *o, bool ends)
{
    fprintf(stderr, "%d times compared (a has %d, b %d), %d column%s, %d differ%s\n", o->n, o->a->rows, o->b->rows,
            o->compared, o->compared == 1 ? "" : "s", o->differ, o->differ == 1 ? "s" : "");
    if (ends)
        fprintf(stderr, "the records do not begin and end together: %.12g to %.12g and %.12g to %.12g\n", first(o->a),
                last(o->a), first(o->b), last(o->b));
}

static enum status print(const struct table *table, const struct request *request, struct report *report)
{
    if (!request->output)
        return table_print(table, table_form_of(request->format, isatty(STDOUT_FILENO)), stdout, report);
    FILE *to = file_or_end(request->output, "w");
    if (!to) return fail(report, E_FILE, "%s: cannot open for writing", request->output);
    const enum status status = table_print(table, table_form_of(request->format, false), to, report);
    return fclose(to) == 0 || status != OK ? status : fail(report, E_FILE, "%s: cannot write", request->output);
}

static enum status check(const struct request *request, struct arena *life, struct report *report)
{
    const struct target table = {"--output", request->output, false};
    struct files read = {.arena = life};
    if (request->nword != 2)
        return fail(report, E_USAGE, "'fmdsub diff' takes two: files of records (.csv, .ndjson, .json) or decks");
    for (int i = 0; i < 2; i++) files_add_path(&read, request->word[i]);
    return targets_check(&table, 1, &read, life, report);
}

/* With --columns the patterns choose here, too: files have all that they have. */
static void choose(struct diff *o, const struct request *request, struct arena *life)
{
    if (!request->columns) return;
    o->pattern = columns_split(&o->npattern, request->columns, life);
    for (int i = 0; i < o->npattern; i++) o->pattern[i] = columns_item_name(o->pattern[i], life);
}

enum status verb_diff(const struct request *request, struct arena *life, struct report *report)
{
    struct curves file[2] = {0};
    struct diff o = {.a = &file[0], .b = &file[1]};
    enum status ended = OK;
    TRY(check(request, life, report));
    TRY(read_rules(&o, request, life, report));
    choose(&o, request, life);
    TRY(curves_make(file, request, false, &ended, life, report));
    TRY(ended);
    TRY(match_times(&o, life, report));
    struct table *table = table_open(columns, sizeof columns / sizeof *columns, life);
    TRY(check_patterns(&o, report));
    compare_all(&o, table);
    const bool ends = ends_differ(&o);
    TRY(print(table, request, report));
    if (!request->quiet) say(&o, ends);
    return o.differ || ends ? E_VERDICT : OK;
}
