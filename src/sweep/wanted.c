/* wanted.c -- see wanted.h */
#include "sweep/wanted.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/text.h"

enum { LAST, FIRST, LEAST, MOST, LARGEST, RANGE, MEAN, RMS, KINDS };
static const char *const kinds[] = {"last", "first", "min", "max", "absmax", "range", "mean", "rms"};

/* "last, first, ..." for messages. */
static const char *words_of_kinds(struct arena *life)
{
    const char *text = kinds[0];
    for (int i = 1; i < KINDS; i++) text = arena_print(life, "%s, %s", text, kinds[i]);
    return text;
}

/* "max(...)": the function; what is between the parentheses. */
static enum status read_one(struct want *o, const char *text, struct arena *life, struct report *report)
{
    const size_t head = strcspn(text, "("), n = strlen(text);
    const char *word = arena_copy(life, text, head);
    o->text = text;
    for (o->kind = 0; o->kind < KINDS && strcmp(kinds[o->kind], word) != 0;) o->kind++;
    if (o->kind < KINDS && text[head] == '(' && text[n - 1] == ')' && n > head + 2) {
        o->column = arena_copy(life, text + head + 1, n - head - 2);
        return OK;
    }
    const char *nearest = o->kind == KINDS && text[head] ? text_nearest(word, kinds, KINDS) : NULL;
    return fail(report, E_USAGE, "--of '%.80s': expected FUNCTION(COLUMN)%s%s%s, FUNCTION one of %s", text,
                nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "", words_of_kinds(life));
}

static bool is_column(const char *text)
{
    return strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.") == strlen(text);
}

enum status wanted_read(struct wanted *o, const char *list, struct arena *life, struct report *report)
{
    const char **item = columns_split(&o->n, list, life);
    o->want = TAKE(life, struct want, o->n);
    if (!o->n) return fail(report, E_USAGE, "--of names nothing");
    for (int i = 0; i < o->n; i++) {
        struct want *w = &o->want[i];
        TRY(read_one(w, item[i], life, report));
        if (is_column(w->column)) continue;
        w->formula = w->column;
        w->column = arena_print(life, "of%d", i + 1);
    }
    return OK;
}

void wanted_last(struct wanted *o, const struct column *columns, int n, struct arena *life)
{
    o->n = n - 1;
    o->want = TAKE(life, struct want, o->n);
    for (int i = 0; i < o->n; i++)
        o->want[i] = (struct want){
            .text = arena_print(life, "last(%s)", columns[i + 1].name), .column = columns[i + 1].name, .index = i + 1};
}

const char *wanted_setting(const struct wanted *o, struct arena *life)
{
    const char **item = TAKE(life, const char *, o->n + 1);
    item[0] = "t";
    for (int i = 0; i < o->n; i++) {
        const struct want *w = &o->want[i];
        item[i + 1] = w->formula ? arena_print(life, "%s=%s", w->column, w->formula) : w->column;
    }
    return columns_setting(item, o->n + 1, life);
}

enum status wanted_find(struct wanted *o, const struct column *columns, int n, struct report *report)
{
    for (int i = 0; i < o->n; i++) {
        const int c = columns_find(columns, n, o->want[i].column);
        if (c < 0) return fail(report, E_USAGE, "--of '%.80s': no such column", o->want[i].text);
        o->want[i].index = c;
    }
    return OK;
}

static void add(struct tally *o, double t, double x)
{
    const double h = o->rows ? t - o->t : 0;
    if (!o->rows) *o = (struct tally){.first = x, .least = x, .most = x};
    if (x < o->least || isnan(x)) o->least = x; /* what is not a number stays */
    if (x > o->most || isnan(x)) o->most = x;
    if (o->rows) {
        o->sum += h * .5 * (o->last + x);
        o->squares += h * (o->last * o->last + o->last * x + x * x) / 3;
        o->time += h;
    }
    o->rows++;
    o->t = t;
    o->last = x;
}

void wanted_add(struct tally *tally, const struct wanted *o, const double *x)
{
    for (int i = 0; i < o->n; i++) add(&tally[i], x[0], x[o->want[i].index]);
}

double wanted_value(const struct tally *o, const struct want *want)
{
    const double x[KINDS] = {[LAST] = o->last,
                             [FIRST] = o->first,
                             [LEAST] = o->least,
                             [MOST] = o->most,
                             [LARGEST] = fabs(o->least) > fabs(o->most) ? fabs(o->least) : fabs(o->most),
                             [RANGE] = o->most - o->least,
                             [MEAN] = o->time > 0 ? o->sum / o->time : o->last,
                             [RMS] = sqrt(o->time > 0 ? o->squares / o->time : o->last * o->last)};
    return o->rows ? x[want->kind] : NAN;
}
