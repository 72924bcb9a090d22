/* stability_words.c -- what stability.h has found, for people */
#include <math.h>
#include <string.h>

#include "out/script.h"
#include "out/table.h"
#include "study/stability.h"

/* The rows of one scheme and ratio: [from, to). */
static int end_of(const struct stability *o, int from)
{
    int to = from;
    while (to < o->nrow && o->row[to].kind == o->row[from].kind && o->row[to].ratio == o->row[from].ratio) to++;
    return to;
}

static const struct stability_row *worst_of(const struct stability *o, int from, int to)
{
    const struct stability_row *worst = NULL;
    for (const struct stability_row *r = o->row + from; r < o->row + to; r++)
        if (r->known && !r->coarse && (!worst || r->radius / r->own > worst->radius / worst->own)) worst = r;
    return worst;
}

/* "0.001...0.02, 0.1 up": the steps that grow, by the grid. */
static const char *bands(const struct stability *o, int from, int to, struct arena *life)
{
    const char *text = "";
    for (int i = from, end; i < to; i = end) {
        end = stability_band(o, i);
        if (end > to) end = to;
        if (!o->row[i].grows) continue;
        text = arena_print(life, "%s%s%.3g", text, *text ? ", " : "", o->row[i].step);
        if (end == to)
            text = arena_print(life, "%s up", text);
        else if (end - i > 1)
            text = arena_print(life, "%s...%.3g", text, o->row[end - 1].step);
    }
    return *text ? text : "none";
}

enum status stability_print(const struct stability *o, FILE *to, struct arena *life, struct report *report)
{
    static const struct table_column columns[] = {
        {"scheme", NULL, 0},          {"ratio", NULL, 6},
        {"growth", "most growth", 6}, {"step", "at h [s]", 3},
        {"fast", "omega h fast", 3},  {"slow", "omega H slow", 3},
        {"most", "who moves", 0},     {"bands", "unstable h [s]", 0},
    };
    struct table *table = table_open(columns, sizeof columns / sizeof *columns, life);
    for (int i = 0, end; i < o->nrow; i = end) {
        end = end_of(o, i);
        const struct stability_row *r = worst_of(o, i, end);
        table_text(table, o->row[i].kind->name);
        table_number(table, o->row[i].ratio);
        table_number(table, r ? r->radius : NAN);
        table_number(table, r ? r->step : NAN);
        table_number(table, r ? stability_fast(o, r) : NAN);
        table_number(table, r ? stability_slow(o, r) : NAN);
        table_text(table, r ? r->most : "-");
        table_text(table, bands(o, i, end, life));
    }
    return table_print(table, TABLE_DRAWN, to, report);
}

/* "miao 5:1" */
static void put_name(FILE *to, const struct stability_row *r)
{
    fprintf(to, "%s", r->kind->name);
    if (r->ratio > 1) fprintf(to, " %d:1", r->ratio);
}

static void put_worst(const struct stability *o, const struct stability_row *r, int unstable, int tried, FILE *to)
{
    put_name(to, r);
    fprintf(to, " grows at %d of %d steps, most by %.4g a major step at h = %.3g s", unstable, tried, r->radius,
            r->step);
    if (o->fast_top > 0) fprintf(to, ", omega h = %.2g of the fast", stability_fast(o, r));
    if (o->fast_top > 0 && o->slow_top > 0) fprintf(to, " and %.2g of the slow coordinates", stability_slow(o, r));
    if (o->fast_top > 0 && !(o->slow_top > 0)) fputs(" coordinates", to);
    if (!(o->fast_top > 0)) fprintf(to, ", omega h = %.2g", stability_slow(o, r));
    fprintf(to, ", where '%s' moves most", r->most);
    if (r->frequency > 0) fprintf(to, " at %.4g rad/s", r->frequency);
    fputs("\n", to);
}

/* Where nothing grows: what comes nearest. */
static void put_least(const struct stability *o, FILE *to)
{
    const struct stability_row *r = worst_of(o, 0, o->nrow);
    if (!r) return;
    fprintf(to, "least damped: '%s' by ", r->most);
    put_name(to, r);
    fprintf(to, ", %.6g a major step at h = %.3g s\n", r->radius, r->step);
}

/* Does any step of these rows tell something? */
static bool tells(const struct stability *o, int from, int to)
{
    for (int i = from; i < to; i++)
        if (o->row[i].known && !o->row[i].coarse) return true;
    return false;
}

/* Schemes of which no step tells, in one line. */
static void put_untold(const struct stability *o, FILE *to)
{
    int n = 0;
    for (int i = 0, end; i < o->nrow; i = end) {
        end = end_of(o, i);
        if (tells(o, i, end)) continue;
        fputs(n++ ? ", " : "nothing is resolved by any step that was tried: ", to);
        put_name(to, &o->row[i]);
    }
    if (n) fputs("; take shorter ones\n", to);
}

void stability_answer(const struct stability *o, FILE *to)
{
    int stable = 0, unstable = 0;
    if (o->own > 0)
        fprintf(to,
                "the motion itself grows here, by exp(%.3g t): unstable is what grows by more than a fifth faster,\n"
                "steps in which it grows by more than a half tell nothing\n",
                o->own);
    for (int i = 0, end; i < o->nrow; i = end) {
        int grow = 0;
        end = end_of(o, i);
        for (int k = i; k < end; k++) grow += o->row[k].grows;
        if (grow) put_worst(o, worst_of(o, i, end), grow, end - i, to);
        unstable += grow > 0;
        stable += grow == 0 && tells(o, i, end);
    }
    if (stable) fprintf(to, "no growth at any step that was tried:");
    for (int i = 0, end, n = 0; i < o->nrow && stable; i = end) {
        int grow = 0;
        end = end_of(o, i);
        for (int k = i; k < end; k++) grow += o->row[k].grows;
        if (!grow && tells(o, i, end)) fputs(n++ ? ", " : " ", to), put_name(to, &o->row[i]);
    }
    if (stable) fputs("\n", to);
    put_untold(o, to);
    if (!unstable) put_least(o, to);
}

/* ---- as a picture ---------------------------------------------------------------------------------------------- */

static void put_line(FILE *to, const struct stability *o, int from, int end, int number)
{
    fprintf(to, "$line%d << END\n", number);
    for (const struct stability_row *r = o->row + from; r < o->row + end; r++) {
        script_put_number(to, r->step);
        fputc(' ', to);
        script_put_number(to, r->known ? r->radius : NAN);
        fputc('\n', to);
    }
    fputs("END\n", to);
}

void stability_script(const struct stability *o, const char *title, FILE *to)
{
    int lines = 0;
    for (int i = 0, end; i < o->nrow; i = end) put_line(to, o, i, end = end_of(o, i), lines++);
    fputs("set datafile missing '?'\nset logscale xy\nset format x '10^{%T}'\nset border 3 lc rgb '#404040'\n"
          "set tics nomirror out\nset grid lt 1 lc rgb '#e4e4e4'\nset title ",
          to);
    script_put_text(to, title);
    fputs(" noenhanced\nset xlabel 'step [s]'\nset ylabel 'spectral radius of a major step'\n"
          "set key outside right top Left reverse noenhanced samplen 2\nplot 1 lc rgb '#a0a0a0' notitle",
          to);
    for (int i = 0, end, k = 0; i < o->nrow; i = end, k++) {
        char name[80];
        end = end_of(o, i);
        snprintf(name, sizeof name, o->row[i].ratio > 1 ? "%s %d:1" : "%s", o->row[i].kind->name, o->row[i].ratio);
        fprintf(to, ", \\\n  $line%d using 1:2 with lines lw 1.5 dt %d lc rgb '%s' title ", k, 1 + k / 8,
                script_color(k));
        script_put_text(to, name);
    }
    fputs("\n", to);
}
