/* picture.c -- see picture.h
 *
 * One line a scheme and ratio, the Pareto front in grey behind: rows that no other beats in both error and cost.  The
 * slope stands beside the name, as what a further digit costs. */
#include "study/picture.h"

#include <math.h>

#include "out/script.h"

enum cost { BY_TIME, BY_WORK };

static double cost_of(const struct study_row *r, enum cost cost)
{
    return cost == BY_TIME ? r->cpu : r->work;
}

/* A row that has a place in a picture of logarithms. */
static bool drawn(const struct study_row *r)
{
    return r->status == OK && r->errors.worst > 0 && isfinite(r->errors.worst) && r->work > 0;
}

/* The first row of its line? */
static bool leads(const struct study *o, const struct study_row *r)
{
    if (!drawn(r)) return false;
    for (const struct study_row *b = o->row; b < r; b++)
        if (drawn(b) && setting_together(&b->setting, &r->setting)) return false;
    return true;
}

/* Rows in the order of their errors, so that lines do not go to and fro; n of them. */
static int sort(const struct study_row **list, const struct study *o, const struct study_row *of)
{
    int n = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!drawn(r) || (of && !setting_together(&r->setting, &of->setting))) continue;
        int at = n++;
        for (; at > 0 && (of ? list[at - 1]->work > r->work : list[at - 1]->errors.worst < r->errors.worst); at--)
            list[at] = list[at - 1];
        list[at] = r;
    }
    return n;
}

static void put_line(FILE *to, const struct study_row *r)
{
    script_put_number(to, r->work);
    fputc(' ', to);
    script_put_number(to, r->cpu);
    fputc(' ', to);
    script_put_number(to, r->errors.worst);
    fputc('\n', to);
}

/* $line0 ...: work, CPU seconds, error. */
static int put_lines(FILE *to, const struct study *o, const struct study_row **list)
{
    int lines = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!leads(o, r)) continue;
        const int n = sort(list, o, r);
        fprintf(to, "$line%d << END\n", lines++);
        for (int i = 0; i < n; i++) put_line(to, list[i]);
        fputs("END\n", to);
    }
    return lines;
}

/* From the largest error down: a row that is cheaper than all that are more accurate. */
static void put_front(FILE *to, const struct study *o, enum cost cost, const struct study_row **list)
{
    const int n = sort(list, o, NULL);
    fprintf(to, "$front%d << END\n", (int)cost);
    for (int i = 0; i < n; i++) {
        bool best = true;
        for (int k = 0; k < n; k++)
            if (k != i && list[k]->errors.worst <= list[i]->errors.worst &&
                cost_of(list[k], cost) < cost_of(list[i], cost))
                best = false;
        if (best) put_line(to, list[i]);
    }
    fputs("END\n", to);
}

/* Its name, and its slope. */
static void put_title(FILE *to, const struct study *o, const struct study_row *r)
{
    char title[200];
    const double digit = study_digit(o, r);
    int n = snprintf(title, sizeof title, "%s", r->setting.kind->name);
    if (r->setting.order > 2) n += snprintf(title + n, sizeof title - (size_t)n, ", order %d,", r->setting.order);
    if (r->setting.ratio > 1) n += snprintf(title + n, sizeof title - (size_t)n, " %d:1", r->setting.ratio);
    if (isfinite(digit)) snprintf(title + n, sizeof title - (size_t)n, "  x %.2g a digit", digit);
    script_put_text(to, title);
}

static void put_panel(FILE *to, const struct study *o, enum cost cost, double left, double right, bool key)
{
    static const int points[] = {7, 5, 9, 11, 13, 15, 6, 4};
    const int column = cost == BY_TIME ? 2 : 1;
    int i = 0;
    fprintf(to, "set lmargin at screen %g\nset rmargin at screen %g\n", left, right);
    fprintf(to, "set xlabel '%s'\n", cost == BY_TIME ? "CPU time [s]" : "work [evaluations of all bodies]");
    fprintf(to, "%s\n",
            key ? "set key at screen 0.985,0.86 right top Left reverse noenhanced samplen 2 spacing 1.25"
                : "unset key");
    fprintf(to, "plot $front%d using %d:3 with steps lc rgb '#d0d0d0' lw 7 title 'least cost'", (int)cost, column);
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!leads(o, r)) continue;
        fprintf(to, ", \\\n  $line%d using %d:3 with linespoints lw 1.5 ps 0.8 pt %d dt %d lc rgb '%s' title ", i,
                column, points[i % 8], i < 8 ? 1 : 2, script_color(i));
        put_title(to, o, r);
        i++;
    }
    if (o->own && drawn(o->own))
        fprintf(to, ", \\\n  $own using %d:3 with points pt 6 ps 2.2 lw 1.5 lc rgb '#000000' title 'the deck''s own'",
                column);
    fputs("\n", to);
}

/* What the reference itself does not know, as a line across. */
static void put_uncertain(FILE *to, const struct study *o)
{
    double most = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) most = fmax(most, r->uncertain);
    if (!(most > 0)) return;
    fputs("set arrow 1 from graph 0, first ", to);
    script_put_number(to, most);
    fputs(" to graph 1, first ", to);
    script_put_number(to, most);
    fputs(" nohead dt 3 lc rgb '#606060'\nset label 1 ' the reference itself' at graph 0, first ", to);
    script_put_number(to, most);
    fputs(" offset 0,0.6 tc rgb '#606060'\n", to);
}

/* Decades that hold all errors. */
static void put_range(FILE *to, const struct study *o)
{
    double low = INFINITY, high = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!drawn(r)) continue;
        low = fmin(low, fmin(r->errors.worst, r->uncertain > 0 ? r->uncertain / 2 : INFINITY));
        high = fmax(high, r->errors.worst);
    }
    if (!(high > 0)) return;
    fprintf(to, "set yrange [1e%d:1e%d]\n", (int)floor(log10(low)), (int)ceil(log10(high) + 1e-9));
}

void picture_script(const struct study *o, const char *title, FILE *to)
{
    bool times = false;
    struct arena *scratch = arena_open();
    const struct study_row **list = TAKE(scratch, const struct study_row *, o->nrow);
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) times |= drawn(r) && isfinite(r->cpu);
    put_front(to, o, BY_WORK, list);
    if (times) put_front(to, o, BY_TIME, list);
    if (put_lines(to, o, list) == 0) fputs("$line0 << END\n1 1 1\nEND\n", to);
    if (o->own && drawn(o->own)) {
        fputs("$own << END\n", to);
        put_line(to, o->own);
        fputs("END\n", to);
    }
    fputs("set datafile missing '?'\nset logscale xy\nset format xy '10^{%T}'\nset border 3 lc rgb '#404040'\n"
          "set tics nomirror out\nset grid lt 1 lc rgb '#e4e4e4'\nset tmargin at screen 0.86\nset bmargin at screen "
          "0.13\n",
          to);
    put_range(to, o);
    put_uncertain(to, o);
    fputs("set multiplot title ", to);
    script_put_text(to, title);
    fputs(" noenhanced\nset ylabel 'error, over the range of the worst column'\n", to);
    if (times) put_panel(to, o, BY_TIME, .085, .375, false);
    if (times) fputs("unset ylabel\nunset label 1\n", to);
    put_panel(to, o, BY_WORK, times ? .445 : .085, .735, true);
    fputs("unset multiplot\n", to);
    arena_close(scratch);
}
