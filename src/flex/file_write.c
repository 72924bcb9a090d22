/* file_write.c -- a reduced body as JSON; see file.h */
#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "flex/file.h"

enum { NUMBER = 32, PER_LINE = 9 };

uint64_t flex_file_checksum(const char *text, size_t n)
{
    uint64_t hash = HASH_NOTHING;
    for (size_t i = 0; i < n; i++)
        if (!isspace((unsigned char)text[i])) hash = hash_bytes(hash, text + i, 1);
    return hash;
}

/* Text that grows. */
struct writer {
    char *text;
    size_t used, capacity;
    struct arena *scratch;
};

static char *reserve(struct writer *w, size_t more)
{
    if (w->used + more >= w->capacity) {
        w->capacity = 2 * (w->capacity + more);
        char *text = TAKE(w->scratch, char, w->capacity);
        if (w->used) memcpy(text, w->text, w->used);
        w->text = text;
    }
    return w->text + w->used;
}

static void put(struct writer *w, const char *text)
{
    size_t n = strlen(text);
    memcpy(reserve(w, n + 1), text, n + 1);
    w->used += n;
}

/* The fewest of 15 to 17 digits that read back. */
static void put_number(struct writer *w, double x)
{
    char *at = reserve(w, NUMBER);
    for (int digits = 15; digits <= 17; digits++) {
        int n = snprintf(at, NUMBER, "%.*g", digits, x);
        if (digits < 17 && strtod(at, NULL) != x) continue;
        w->used += (size_t)n;
        return;
    }
}

static void put_string(struct writer *w, const char *text)
{
    put(w, "\"");
    for (; *text; text++) {
        char piece[8] = {*text, 0};
        if ((unsigned char)*text < 0x20) snprintf(piece, sizeof piece, "\\u%04x", (unsigned)*text);
        if (*text == '"' || *text == '\\') snprintf(piece, sizeof piece, "\\%c", *text);
        put(w, piece);
    }
    put(w, "\"");
}

static void put_array(struct writer *w, const char *before, const char *key, const double *x, int n)
{
    if (!x) return;
    put(w, before);
    put(w, "\"");
    put(w, key);
    put(w, "\": [");
    for (int i = 0; i < n; i++) {
        if (i) put(w, i % PER_LINE ? ", " : ",\n    ");
        put_number(w, x[i]);
    }
    put(w, "]");
}

static void put_node(struct writer *w, const struct flex_node *o, int n)
{
    put(w, "  {");
    if (o->name) {
        put(w, "\"name\": ");
        put_string(w, o->name);
        put(w, ", ");
    }
    put_array(w, "", "x", o->x, 3);
    put_array(w, ",\n   ", "phi", o->phi, 3 * n);
    put_array(w, ",\n   ", "psi", o->psi, 3 * n);
    put_array(w, ",\n   ", "S", o->S, 3 * n * n);
    put_array(w, ",\n   ", "T", o->T, 3 * n * n);
    put(w, "}");
}

static void put_stress(struct writer *w, const struct flex_stress *o, int n)
{
    put(w, "  {\"name\": ");
    put_string(w, o->name);
    put_array(w, ",\n   ", "tensor", o->tensor, 6 * n);
    put_array(w, ",\n   ", "axial", o->axial, n);
    put_array(w, ",\n   ", "bending", o->bending, n);
    put(w, "}");
}

static void put_integrals(struct writer *w, const struct flex_body *o)
{
    const int n = o->n;
    const struct {
        const char *key;
        const double *x;
        int n;
    } all[] = {{"xx", o->xx, 9},         {"rot", o->rot, 9},       {"f", o->f, 3 * n},       {"xf", o->xf, 9 * n},
               {"ff", o->ff, 9 * n * n}, {"rpsi", o->rpsi, 3 * n}, {"ppsi", o->ppsi, n * n}, {"s", o->s, 3 * n * n},
               {"xs", o->xs, 9 * n * n}, {"K", o->K, n * n},       {"D", o->D, n * n},       {"hertz", o->hertz, n}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) put_array(w, ",\n ", all[i].key, all[i].x, all[i].n);
}

static void put_checksum(struct writer *w)
{
    char member[60];
    snprintf(member, sizeof member, "\"checksum\": \"%016" PRIx64 "\"", flex_file_checksum(w->text, w->used));
    put(w, member);
}

const char *flex_file_text(const struct flex_body *o, const double *at, struct arena *life)
{
    struct arena *scratch = arena_open();
    struct writer w = {.scratch = scratch};
    char head[100];
    snprintf(head, sizeof head, "{\"fmdsub_flex\": 1, \"modes\": %d, \"reference\": %d", o->n, o->reference);
    put(&w, head);
    put_array(&w, ",\n ", "at", at, 3);
    put(&w, ",\n \"mass\": ");
    put_number(&w, o->mass);
    put_integrals(&w, o);
    put(&w, ",\n \"nodes\": [\n");
    for (int i = 0; i < o->nnode; i++) {
        if (i) put(&w, ",\n");
        put_node(&w, o->node + i, o->n);
    }
    put(&w, "],\n \"stresses\": [");
    for (int i = 0; i < o->nstress; i++) {
        put(&w, i ? ",\n" : "\n");
        put_stress(&w, o->stress + i, o->n);
    }
    put(&w, "],\n ");
    put_checksum(&w);
    put(&w, "}\n");
    const char *text = arena_copy(life, w.text, w.used);
    arena_close(scratch);
    return text;
}
