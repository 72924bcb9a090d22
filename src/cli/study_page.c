/* study_page.c -- a study as one page that needs nothing else: what it says, the diagram, the table, curves of the reference, the
 * deck, and what it takes to make it again */
#include "cli/study_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "out/number.h"

enum { WIDE = 760, TALL = 420, LEFT = 70, RIGHT = 190, TOP = 20, BOTTOM = 50, PALETTE = 8, CURVES = 6, POINTS = 400 };
static const char *const palette[PALETTE] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#56b4e9", "#e69f00", "#7d5ba6", "#4a4a4a"};

static void put_text(FILE *to, const char *text)
{
    for (; *text; text++) {
        const char c = *text;
        fputs(c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : (char[]){c, 0}, to);
    }
}

static void put_number(FILE *to, double x)
{
    char number[NUMBER_MOST + 1];
    number[isfinite(x) ? number_round(number, x == 0 ? 0 : x, 4) : 0] = 0;
    fputs(*number ? number : "&ndash;", to);
}

/* ---- a frame with two axes ---- */

struct axes {
    FILE *to;
    double low[2], high[2]; /* of x and y; of logarithms those */
    bool logs;
};

static double across(const struct axes *o, double x)
{
    return LEFT + (WIDE - LEFT - RIGHT) * (x - o->low[0]) / (o->high[0] - o->low[0]);
}

static double upward(const struct axes *o, double y)
{
    return TALL - BOTTOM - (TALL - TOP - BOTTOM) * (y - o->low[1]) / (o->high[1] - o->low[1]);
}

static void widen(struct axes *o, double x, double y)
{
    const double at[2] = {x, y};
    for (int k = 0; k < 2; k++) {
        o->low[k] = fmin(o->low[k], at[k]);
        o->high[k] = fmax(o->high[k], at[k]);
    }
}

static void open_axes(struct axes *o, FILE *to, bool logs)
{
    *o = (struct axes){to, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}, logs};
}

static void put_tick(const struct axes *o, int axis, double at)
{
    const double x = axis ? LEFT : across(o, at), y = axis ? upward(o, at) : TALL - BOTTOM;
    fprintf(o->to, "<path class=\"grid\" d=\"M%.1f %.1fL%.1f %.1f\"/><text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">",
            x, y, axis ? (double)(WIDE - RIGHT) : x, axis ? y : (double)TOP, axis ? x - 8 : x, axis ? y + 4 : y + 18,
            axis ? "end" : "middle");
    if (o->logs)
        fprintf(o->to, "1e%.0f", at);
    else
        put_number(o->to, at);
    fputs("</text>\n", o->to);
}

static void put_axes(struct axes *o, const char *x, const char *y)
{
    for (int k = 0; k < 2; k++) {
        if (o->logs) {
            o->low[k] = floor(o->low[k]);
            o->high[k] = ceil(o->high[k]);
        }
        if (!(o->high[k] > o->low[k])) o->high[k] = o->low[k] + 1;
    }
    fprintf(o->to, "<svg viewBox=\"0 0 %d %d\" role=\"img\">\n", WIDE, TALL);
    for (int k = 0; k < 2; k++) {
        const double span = o->high[k] - o->low[k];
        const double step =
            o->logs ? ceil(span / 8)
                    : pow(10, floor(log10(span / 4))) * (span / pow(10, floor(log10(span / 4))) > 8 ? 2 : 1);
        for (double at = ceil(o->low[k] / step) * step; at <= o->high[k] + 1e-9 * span; at += step)
            put_tick(o, k, fabs(at) < 1e-9 * span ? 0 : at);
    }
    fprintf(o->to,
            "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s</text><text x=\"14\" y=\"%d\" text-anchor=\"middle\" "
            "transform=\"rotate(-90 14 %d)\">",
            (LEFT + WIDE - RIGHT) / 2, TALL - 8, x, (TOP + TALL - BOTTOM) / 2, (TOP + TALL - BOTTOM) / 2);
    put_text(o->to, y);
    fputs("</text>\n", o->to);
}

static void put_key(const struct axes *o, int line, const char *name)
{
    fprintf(o->to, "<path d=\"M%d %dh22\" stroke=\"%s\" stroke-width=\"2\"/><text x=\"%d\" y=\"%d\">",
            WIDE - RIGHT + 14, TOP + 8 + 20 * line, palette[line % PALETTE], WIDE - RIGHT + 42, TOP + 12 + 20 * line);
    put_text(o->to, name);
    fputs("</text>\n", o->to);
}

/* ---- error over work ---- */

static bool is_drawn(const struct study_row *r)
{
    return r->status == OK && r->errors.worst > 0 && isfinite(r->errors.worst) && r->work > 0;
}

/* The rows of a scheme and ratio in the order of their work. */
static int line_of(const struct study_row **list, const struct study *o, const struct study_row *of)
{
    int n = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!is_drawn(r) || !setting_together(&r->setting, &of->setting)) continue;
        int at = n++;
        for (; at > 0 && list[at - 1]->work > r->work; at--) list[at] = list[at - 1];
        list[at] = r;
    }
    return n;
}

static void put_line(const struct axes *a, const struct study *o, const struct study_row *of, int line,
                     const struct study_row **list)
{
    const int n = line_of(list, o, of);
    char name[80];
    fprintf(a->to, "<path fill=\"none\" stroke-width=\"1.6\" stroke=\"%s\" d=\"", palette[line % PALETTE]);
    for (int i = 0; i < n; i++)
        fprintf(a->to, "%s%.1f %.1f", i ? "L" : "M", across(a, log10(list[i]->work)),
                upward(a, log10(list[i]->errors.worst)));
    fputs("\"/>\n", a->to);
    for (int i = 0; i < n; i++)
        fprintf(a->to, "<circle r=\"4\" fill=\"%s\" cx=\"%.1f\" cy=\"%.1f\"/>\n", palette[line % PALETTE],
                across(a, log10(list[i]->work)), upward(a, log10(list[i]->errors.worst)));
    const struct setting *s = &of->setting;
    const char *order = s->order > 2 ? ", order 4," : "";
    snprintf(name, sizeof name, s->ratio > 1 ? "%s%s %d:1" : "%s%s", s->kind->name, order, s->ratio);
    put_key(a, line, name);
}

static void put_diagram(FILE *to, const struct study *o, struct arena *life)
{
    const struct study_row **list = TAKE(life, const struct study_row *, o->nrow);
    struct axes axes;
    int lines = 0;
    open_axes(&axes, to, true);
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (is_drawn(r)) widen(&axes, log10(r->work), log10(r->errors.worst));
    if (!isfinite(axes.low[0])) return;
    put_axes(&axes, "work [evaluations of all bodies]", "error, over the range of the worst column");
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        bool first = is_drawn(r);
        for (const struct study_row *b = o->row; b < r && first; b++)
            first = !(is_drawn(b) && setting_together(&b->setting, &r->setting));
        if (first) put_line(&axes, o, r, lines++, list);
    }
    if (o->own && is_drawn(o->own))
        fprintf(to, "<circle r=\"8\" fill=\"none\" stroke=\"#000\" stroke-width=\"1.5\" cx=\"%.1f\" cy=\"%.1f\"/>\n",
                across(&axes, log10(o->own->work)), upward(&axes, log10(o->own->errors.worst)));
    fputs("</svg>\n<p class=\"note\">The ring is the deck's own setting.</p>\n", to);
}

/* ---- the table ---- */

static void put_row(FILE *to, const struct study *o, const struct study_row *r)
{
    fprintf(to, "<tr%s><td>%s%s</td><td>", o->own && r == o->own ? " class=\"own\"" : "", r->setting.kind->name,
            r->setting.order > 2 ? ", order 4" : "");
    const double numbers[] = {r->setting.tolerance, r->setting.step, r->setting.ratio, r->errors.worst};
    for (int i = 0; i < 4; i++) {
        put_number(to, numbers[i]);
        fputs("</td><td>", to);
    }
    put_text(to, r->worst ? r->worst : "");
    const double more[] = {r->work, r->cpu, r->energy};
    for (int i = 0; i < 3; i++) {
        fputs("</td><td>", to);
        put_number(to, more[i]);
    }
    fprintf(to, "</td><td>%s</td></tr>\n", r->status == OK ? "ok" : r->status == E_VERDICT ? "balance" : "stopped");
}

static void put_table(FILE *to, const struct study *o)
{
    fputs("<table><tr><th>scheme</th><th>tolerance</th><th>step "
          "[s]</th><th>ratio</th><th>error</th><th>in</th><th>work</th>"
          "<th>CPU [s]</th><th>energy</th><th></th></tr>\n",
          to);
    for (int i = 0; i < o->nrow; i++) put_row(to, o, &o->row[i]);
    fputs("</table>\n", to);
}

/* ---- curves of the reference ---- */

static bool is_energy(const char *name)
{
    return strncmp(name, "energy.", 7) == 0 && strcmp(name, "energy.residual") != 0;
}

/* Of energies those there are, else of what the deck asks for, of one unit. */
static int choose_curves(int *column, const struct study *o)
{
    const struct subject *s = &o->subject;
    int n = 0;
    for (int c = 1; c < s->ncolumn && c < o->reference.run.n && n < CURVES; c++)
        if (is_energy(s->column[c].name)) column[n++] = c;
    for (int c = 1; !n && c < s->ncolumn && c < o->reference.run.n; c++)
        if (s->column[c].compared) column[n++] = c;
    for (int c = column[0] + 1;
         n && n < CURVES && !is_energy(s->column[column[0]].name) && c < s->ncolumn && c < o->reference.run.n; c++)
        if (s->column[c].compared && same_unit(&s->column[c], &s->column[column[0]])) column[n++] = c;
    return n;
}

static void put_curves(FILE *to, const struct study *o)
{
    const struct outcome *run = &o->reference.run;
    int column[CURVES] = {0};
    const int n = choose_curves(column, o), every = run->rows / POINTS + 1;
    struct axes axes;
    char label[60];
    open_axes(&axes, to, false);
    for (int r = 0; r < run->rows; r++)
        for (int i = 0; i < n; i++)
            if (isfinite(outcome_row(run, r)[column[i]]))
                widen(&axes, outcome_row(run, r)[0], outcome_row(run, r)[column[i]]);
    if (!n || !isfinite(axes.low[0])) return;
    const char *unit = o->subject.column[column[0]].unit;
    snprintf(label, sizeof label, "[%.40s]", unit ? unit : "1");
    fputs("<h2>The motion</h2>\n", to);
    put_axes(&axes, "t [s]", label);
    for (int i = 0; i < n; i++) {
        fprintf(to, "<path fill=\"none\" stroke-width=\"1.4\" stroke=\"%s\" d=\"", palette[i % PALETTE]);
        for (int r = 0, begun = 0; r < run->rows; r += every) {
            const double *x = outcome_row(run, r);
            if (!isfinite(x[column[i]])) continue;
            fprintf(to, "%s%.1f %.1f", begun++ ? "L" : "M", across(&axes, x[0]), upward(&axes, x[column[i]]));
        }
        fputs("\"/>\n", to);
        put_key(&axes, i, o->subject.column[column[i]].name);
    }
    fputs("</svg>\n<p class=\"note\">Of the reference, the run that the others are compared with.</p>\n", to);
}

/* ---- the page ---- */

static const char head[] =
    "<style>body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:60rem;padding:0 1rem;color:#222}"
    "svg{width:100%;background:#fff;border:1px solid #ddd}svg text{font-size:12px;fill:#333}.grid{stroke:#e4e4e4}"
    "table{border-collapse:collapse;width:100%;font-size:13px}td,th{padding:.2rem .5rem;border-bottom:1px solid "
    "#eee;text-align:right}td:first-child,td:nth-child(6),th:first-child{text-align:left}.own{background:#fff4d6}"
    "pre{background:#f6f6f6;padding:.8rem;overflow:auto;font-size:13px}.note{color:#666;font-size:13px}</style>";

/* What a printer of words has to say, as text of the page. */
static void put_said(FILE *to, const struct study *o, const struct study_row *pick, const char *tag)
{
    char *text = NULL;
    size_t n = 0;
    FILE *words = words_open(&text, &n);
    if (pick)
        study_print_pick(o, pick, words);
    else
        study_answer(o, words);
    words_close(words, &text);
    if (!pick)
        for (char *line = text, *next; line && *line; line = next) {
            next = strchr(line, '\n');
            if (next) *next++ = 0;
            fprintf(to, "<%s>", tag);
            put_text(to, line);
            fprintf(to, "</%s>\n", tag);
        }
    else if (text)
        put_text(to, text);
    free(text);
}

static void put_picks(FILE *to, const struct study *o)
{
    static const double errors[] = {1e-2, 1e-4, 1e-6};
    for (int i = 0; i < 3; i++) {
        const struct study_row *row = study_pick(o, errors[i]);
        if (!row) continue;
        fprintf(to, "<p>For an error of %g:</p>\n<pre>", errors[i]);
        put_said(to, o, row, "pre");
        fputs("</pre>\n", to);
    }
}

static void put_made(FILE *to, const struct study *o, const struct study_page *page)
{
    fprintf(to, "<h2>To make it again</h2>\n<p>fmdsub %s, deck ", o->subject.version);
    put_text(to, page->name);
    fputs("; the reference is ", to);
    study_print_setting(&o->reference.first, to);
    fputs(", beside ", to);
    study_print_setting(&o->reference.second, to);
    fprintf(to, ", up to t = %.6g s. Work is counted and the same on every machine; times are not.</p>\n<pre>",
            o->reference.horizon);
    put_text(to, page->command);
    fputs("</pre>\n", to);
}

static void put_page(FILE *to, const struct study *o, const struct study_page *page, struct arena *life)
{
    fputs("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>", to);
    put_text(to, page->title);
    fprintf(to, "</title>%s</head><body>\n<h1>", head);
    put_text(to, page->title);
    fputs("</h1>\n<h2>What accuracy costs</h2>\n", to);
    put_said(to, o, NULL, "p");
    put_diagram(to, o, life);
    put_table(to, o);
    put_picks(to, o);
    put_curves(to, o);
    put_made(to, o, page);
    fputs("<h2>The deck</h2>\n<pre>", to);
    put_text(to, page->deck);
    fputs("</pre>\n</body></html>\n", to);
}

enum status study_page(const struct study *o, const struct study_page *page, struct stream *stream, struct arena *life,
                       struct report *report)
{
    char *text = NULL;
    size_t n = 0;
    FILE *to = words_open(&text, &n);
    put_page(to, o, page, life);
    words_close(to, &text);
    const enum status status = stream_bytes(stream, text, n, report);
    free(text);
    return status;
}
