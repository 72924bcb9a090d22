/* film_html.c -- a film as one page that needs nothing else: film_page.c with the data in it */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "film/film.h"
#include "film/film_page.h"
#include "out/number.h"

enum { DIGITS = 6 };

static void put_number(FILE *to, double x, int digits)
{
    char number[NUMBER_MOST + 1];
    if (!isfinite(x)) {
        fputs("null", to);
        return;
    }
    number[number_round(number, x == 0 ? 0 : x, digits)] = 0;
    fputs(number, to);
}

static void put_numbers(FILE *to, const char *name, const double *x, size_t n)
{
    fprintf(to, "\"%s\":[", name);
    for (size_t i = 0; i < n; i++) {
        if (i) putc(',', to);
        put_number(to, x[i], DIGITS);
    }
    putc(']', to);
}

/* A string of JSON that no end of a script is read into. */
static void put_text(FILE *to, const char *text)
{
    putc('"', to);
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c < 0x20 || strchr("\"\\<>&", c))
            fprintf(to, "\\u%04x", c);
        else
            putc(c, to);
    }
    putc('"', to);
}

static void put_whole_numbers(FILE *to, const char *name, const int *x, int n)
{
    fprintf(to, "\"%s\":[", name);
    for (int i = 0; i < n; i++) fprintf(to, i ? ",%d" : "%d", x[i]);
    putc(']', to);
}

static void put_actor(FILE *to, const struct film *o, const struct actor *a)
{
    static const char *const kinds[] = {"solid", "line", "spring"};
    fprintf(to, "{\"k\":\"%s\",\"c\":%u,\"name\":", kinds[a->type], a->color);
    put_text(to, a->name ? a->name : "");
    putc(',', to);
    if (a->type == ACTOR_SOLID) {
        put_numbers(to, "x", a->mesh.x, 3 * (size_t)a->mesh.nv);
        putc(',', to);
        put_whole_numbers(to, "f", a->mesh.tri, 3 * a->mesh.nt);
        putc(',', to);
    } else if (a->type == ACTOR_LINE) {
        fprintf(to, "\"n\":%d,\"nv\":%d,", a->n, a->nv);
        put_numbers(to, "x", a->base, 3 * (size_t)a->nv);
        putc(',', to);
        put_numbers(to, "m", a->mode, 3 * (size_t)a->nv * (size_t)a->n);
        putc(',', to);
        put_whole_numbers(to, "part", a->part, a->npart + 1);
        putc(',', to);
    } else {
        fprintf(to, "\"coils\":%s,", a->coils ? "true" : "false");
    }
    put_numbers(to, "p", a->frame, (size_t)o->frames * (size_t)a->stride);
    fputs("}", to);
}

static void put_column(FILE *to, const struct film *o, int c)
{
    fputs("{\"n\":", to);
    put_text(to, o->column[c].name);
    fputs(",\"u\":", to);
    put_text(to, o->column[c].unit ? o->column[c].unit : "");
    fputs(",\"x\":[", to);
    for (int i = 0; i < o->frames; i++) {
        if (i) putc(',', to);
        put_number(to, o->x[(size_t)i * (size_t)o->ncolumn + (size_t)c], DIGITS);
    }
    fputs("]}", to);
}

static void put_data(FILE *to, const struct film *o)
{
    fputs("const D={\"title\":", to);
    put_text(to, o->title);
    fprintf(to, ",\"space\":%d,\"size\":", o->space);
    put_number(to, o->size, DIGITS);
    putc(',', to);
    put_numbers(to, "low", o->low, 3);
    putc(',', to);
    put_numbers(to, "high", o->high, 3);
    fputs(",\n\"t\":[", to);
    for (int i = 0; i < o->frames; i++) {
        if (i) putc(',', to);
        put_number(to, o->x[(size_t)i * (size_t)o->ncolumn], 12);
    }
    fputs("],\n\"actors\":[", to);
    for (int i = 0; i < o->nactor; i++) {
        fputs(i ? ",\n" : "\n", to);
        put_actor(to, o, &o->actor[i]);
    }
    fputs("],\n\"columns\":[", to);
    for (int c = 1; c < o->ncolumn; c++) {
        fputs(c > 1 ? ",\n" : "\n", to);
        put_column(to, o, c);
    }
    fputs("]};\n", to);
}

enum status film_html(const struct film *o, struct stream *stream, struct report *report)
{
    char *text = NULL;
    size_t n = 0;
    FILE *to = words_open(&text, &n);
    for (int i = 0; film_page_before[i]; i++) fputs(film_page_before[i], to);
    put_data(to, o);
    for (int i = 0; film_page_behind[i]; i++) fputs(film_page_behind[i], to);
    words_close(to, &text);
    const enum status status = stream_bytes(stream, text, n, report);
    free(text);
    return status;
}
