/* plot.c -- fmdsub plot: columns of runs over time, as a picture by gnuplot
 *
 * A panel for each pattern of --columns and unit; without --columns a panel for each unit, or where units are not known
 * for each column.  Several files lie over each other in the same panels. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"
#include "cli/curves.h"
#include "cli/gnuplot.h"
#include "cli/recorded.h"
#include "out/columns.h"
#include "out/script.h"
#include "out/targets.h"

enum { MOST_PANELS = 16, MOST_CURVES = 64, MOST_FILES = 32 };
enum {
    PANEL = 210,
    LEFT = 110,
    MIDDLE = 670,
    LETTER = 8,
    MOST_KEY = 480,
    LINES = 16
}; /* [pixels], lines of a terminal */

/* What is drawn together. */
struct panel {
    const char *unit; /* NULL: not known */
    int pattern;
    int n;
    const char *name[MOST_CURVES]; /* [n] of columns */
};

struct plot {
    bool quiet;
    int nfile;
    struct curves *file; /* [nfile] */
    int npanel;
    struct panel panel[MOST_PANELS];
};

static const char *unit_of(const struct plot *o, const char *name)
{
    for (int f = 0; f < o->nfile; f++) {
        const int c = curves_find(&o->file[f], name);
        if (c >= 0 && o->file[f].column[c].unit) return o->file[f].column[c].unit;
    }
    return NULL;
}

static bool is_drawn(const struct plot *o, int pattern, const char *name)
{
    for (int p = 0; p < o->npanel; p++)
        for (int i = 0; i < o->panel[p].n; i++)
            if (o->panel[p].pattern == pattern && strcmp(o->panel[p].name[i], name) == 0) return true;
    return false;
}

/* Is there a record in which both it and what it is drawn over are numbers? */
static bool has_points(const struct curves *o, int c)
{
    for (int r = 0; c >= 0 && r < o->rows; r++) {
        const double *x = o->x + (size_t)r * (size_t)o->n;
        if (isfinite(x[0]) && isfinite(x[c])) return true;
    }
    return false;
}

/* In any file; else it is told that there is nothing to draw. */
static bool can_draw(const struct plot *o, const char *name)
{
    for (int f = 0; f < o->nfile; f++)
        if (has_points(&o->file[f], curves_find(&o->file[f], name))) return true;
    if (o->quiet) return false;
    fputs("fmdsub: no number in column '", stderr);
    text_put(stderr, name);
    fputs("': it is not drawn\n", stderr);
    return false;
}

/* Into the panel of its pattern and unit.  alone: units are not known, and nobody has said what goes together. */
static enum status put_column(struct plot *o, int pattern, const char *name, bool alone, struct report *report)
{
    const char *unit = unit_of(o, name);
    struct panel *panel = NULL;
    if (is_drawn(o, pattern, name) || !can_draw(o, name)) return OK;
    for (int p = 0; p < o->npanel && !(alone && !unit); p++)
        if (o->panel[p].pattern == pattern && text_same(o->panel[p].unit, unit)) panel = &o->panel[p];
    if (!panel) {
        if (o->npanel == MOST_PANELS)
            return fail(report, E_USAGE, "more than %d panels: name the columns with --columns", MOST_PANELS);
        panel = &o->panel[o->npanel++];
        *panel = (struct panel){.unit = unit, .pattern = pattern};
    }
    if (panel->n == MOST_CURVES)
        return fail(report, E_USAGE, "more than %d columns in one panel: name those that are wanted with --columns",
                    MOST_CURVES);
    panel->name[panel->n++] = name;
    return OK;
}

/* Nothing matches, though a run of a deck would have made it. */
static enum status not_found(const struct curves *o, const char *item, const char *name, const struct report *none,
                             struct report *report)
{
    if (strchr(item, '=') && recorded_is(o->file))
        return fail(report, E_USAGE,
                    "%s: '%.200s' is an expression, which only a run computes: draw the deck, or run it with "
                    "--columns \"%.200s\" first; records have the columns that they have",
                    o->file, name, item);
    return fail(report, E_USAGE, "%s: %.900s", o->file, none->text);
}

/* item: a pattern, or "name = expression". */
static enum status put_pattern(struct plot *o, int pattern, const char *item, struct arena *life, struct report *report)
{
    const char *words = columns_item_name(item, life);
    int found = 0;
    for (int f = 0; f < o->nfile; f++) {
        const struct curves *curves = &o->file[f];
        struct selection chosen;
        struct report none = {0};
        if (columns_select(&chosen, curves->column, curves->n, &words, 1, E_USAGE, life, &none) != OK) {
            if (f + 1 == o->nfile && !found) return not_found(curves, item, words, &none, report);
            continue;
        }
        for (int i = 1; i < chosen.n; i++, found++)
            TRY(put_column(o, pattern, curves->column[chosen.index[i]].name, false, report));
    }
    return OK;
}

static enum status make_panels(struct plot *o, const struct request *request, struct arena *life, struct report *report)
{
    int n = 0;
    const char **item = request->columns ? columns_split(&n, request->columns, life) : NULL;
    for (int i = 0; i < n; i++)
        if (strcmp(item[i], o->file[0].column[0].name) != 0) TRY(put_pattern(o, i, item[i], life, report));
    for (int f = 0; f < o->nfile && n == 0; f++)
        for (int c = 1; c < o->file[f].n; c++) TRY(put_column(o, 0, o->file[f].column[c].name, true, report));
    return o->npanel ? OK : fail(report, E_USAGE, "no column to draw over %s", o->file[0].column[0].name);
}

/* ---- the script ---- */

/* $file0 ...: the columns that are drawn, and what they are drawn over.  A line ends at what is no number (NaN), and goes
 * on behind it; over a datum that is missing gnuplot would draw it. */
static void put_data(FILE *to, const struct curves *o, int number)
{
    fprintf(to, "$file%d << END\n", number);
    for (int r = 0; r < o->rows; r++)
        for (int c = 0; c < o->n; c++) {
            const double x = o->x[(size_t)r * (size_t)o->n + (size_t)c];
            if (isfinite(x))
                script_put_number(to, x);
            else
                fputs("NaN", to);
            fputc(c + 1 < o->n ? ' ' : '\n', to);
        }
    fputs("END\n", to);
}

static const char *base_name(const char *file)
{
    const char *slash = strrchr(file, '/');
    return slash ? slash + 1 : file;
}

/* "hub.angle", with several files "hub.angle, a.csv" */
static void put_title(FILE *to, const struct plot *o, const char *name, const char *file)
{
    char *title = NULL;
    size_t n = 0;
    FILE *text = words_open(&title, &n);
    fputs(name, text);
    if (o->nfile > 1) fprintf(text, ", %s", base_name(file));
    words_close(text, &title);
    script_put_text(to, title);
    free(title);
}

/* 'name [unit]' for an axis. */
static void put_label(FILE *to, const char *name, const char *unit)
{
    char label[80];
    snprintf(label, sizeof label, "%.60s%s%s%.14s%s", name, *name && unit ? " " : "", unit ? "[" : "", unit ? unit : "",
             unit ? "]" : "");
    script_put_text(to, label);
    fputs(" noenhanced\n", to);
}

/* The colour tells the column and the dashes the file; with one column the colour tells the file. */
static void put_panel(FILE *to, const struct plot *o, const struct panel *p)
{
    int n = 0;
    fputs("set ylabel ", to);
    put_label(to, p->n == 1 ? p->name[0] : "", p->unit);
    fputs("plot ", to);
    for (int i = 0; i < p->n; i++)
        for (int f = 0; f < o->nfile; f++) {
            const int c = curves_find(&o->file[f], p->name[i]);
            if (!has_points(&o->file[f], c)) continue;
            fprintf(to, "%s$file%d using 1:%d with lines lw 1.6 dt %d lc rgb '%s' title ", n++ ? ", \\\n  " : "", f,
                    c + 1, p->n == 1 ? 1 + f / 8 : 1 + (f + i / 8) % 5, script_color(p->n == 1 ? f : i));
            put_title(to, o, p->name[i], o->file[f].file);
        }
    fputc('\n', to);
}

/* Panels stand under each other between these, in shares of the height. */
static void put_place(FILE *to, int i, int n)
{
    const double top = 1 - 12. / (PANEL * n + 60), bottom = 48. / (PANEL * n + 60), each = (top - bottom) / n;
    fprintf(to, "set tmargin at screen %.4f\nset bmargin at screen %.4f\n", top - i * each, top - (i + .9) * each);
}

/* Room for the longest of the titles [pixels]. */
static int key_width(const struct plot *o)
{
    size_t name = 0, file = 0;
    for (int p = 0; p < o->npanel; p++)
        for (int i = 0; i < o->panel[p].n; i++)
            if (strlen(o->panel[p].name[i]) > name) name = strlen(o->panel[p].name[i]);
    for (int f = 0; f < o->nfile && o->nfile > 1; f++)
        if (strlen(base_name(o->file[f].file)) + 2 > file) file = strlen(base_name(o->file[f].file)) + 2;
    const size_t width = 70 + LETTER * (name + file);
    return width < MOST_KEY ? (int)width : MOST_KEY;
}

static int picture_width(const struct plot *o)
{
    return LEFT + MIDDLE + key_width(o);
}

/* One for all panels: each would have its own where files and columns end at different times. */
static void put_range(FILE *to, const struct plot *o)
{
    double from = INFINITY, until = -INFINITY;
    for (int f = 0; f < o->nfile; f++)
        for (int r = 0; r < o->file[f].rows; r++) {
            const double x = o->file[f].x[(size_t)r * (size_t)o->file[f].n];
            if (!isfinite(x)) continue;
            from = fmin(from, x);
            until = fmax(until, x);
        }
    if (!(from < until)) return;
    fputs("set xrange [", to);
    script_put_number(to, from);
    fputs(":", to);
    script_put_number(to, until);
    fputs("]\n", to);
}

static void put_script(FILE *to, const struct plot *o, const char *path)
{
    const struct column *over = &o->file[0].column[0];
    const double width = picture_width(o);
    for (int f = 0; f < o->nfile; f++) put_data(to, &o->file[f], f);
    put_range(to, o);
    fputs("set border 3 lc rgb '#404040'\nset tics nomirror out\n"
          "set key at graph 1.02,1 left top Left reverse noenhanced samplen 2 spacing 1.2\n",
          to);
    if (path) fputs("set grid lt 1 lc rgb '#e4e4e4'\n", to);
    if (path)
        fprintf(to, "set lmargin at screen %.4f\nset rmargin at screen %.4f\n", LEFT / width, (LEFT + MIDDLE) / width);
    else
        fputs("set lmargin 10\nset rmargin 26\n", to);
    fprintf(to, "set multiplot layout %d,1\n", o->npanel);
    for (int i = 0; i < o->npanel; i++) {
        const bool last = i + 1 == o->npanel;
        if (path) put_place(to, i, o->npanel);
        if (!last) fputs("set format x ''\n", to);
        if (last) {
            fputs("set format x\nset xlabel ", to);
            put_label(to, over->name, over->unit);
        }
        put_panel(to, o, &o->panel[i]);
    }
    fputs("unset multiplot\n", to);
}

static enum status draw(const struct plot *o, struct gnuplot *gnuplot, const struct request *request,
                        struct arena *life, struct report *report)
{
    struct gnuplot_script script;
    gnuplot_begin(&script, request->output, request->script, picture_width(o), PANEL * o->npanel + 60,
                  LINES * o->npanel);
    put_script(script.to, o, request->output);
    return gnuplot_end(gnuplot, &script, life, report);
}

static enum status check(const struct request *request, struct arena *life, struct report *report)
{
    const struct target picture = {"--output", request->output, true};
    struct files read = {.arena = life};
    if (request->nword < 1) return fail(report, E_USAGE, "'fmdsub plot' takes decks and files of records");
    if (request->nword > MOST_FILES) return fail(report, E_USAGE, "'fmdsub plot' takes up to %d files", MOST_FILES);
    if (request->output && !gnuplot_ending(request->output))
        return fail(report, E_USAGE, "--output: a file that ends in .svg, .png or .pdf, not '%.200s'", request->output);
    for (int i = 0; i < request->nword; i++) files_add_path(&read, request->word[i]);
    return targets_check(&picture, 1, &read, life, report);
}

enum status verb_plot(const struct request *request, struct arena *life, struct report *report)
{
    struct plot *o = TAKE(life, struct plot, 1);
    struct gnuplot gnuplot = {0};
    enum status ended = OK;
    TRY(check(request, life, report));
    o->quiet = request->quiet;
    if (!request->script) TRY(gnuplot_open(&gnuplot, report));
    o->nfile = request->nword;
    o->file = TAKE(life, struct curves, o->nfile);
    enum status status = curves_make(o->file, request, true, &ended, life, report);
    if (status == OK) status = make_panels(o, request, life, report);
    if (status == OK) status = draw(o, &gnuplot, request, life, report);
    gnuplot_close(&gnuplot);
    return status == OK ? ended : status;
}
