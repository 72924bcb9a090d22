/* recall.c -- see recall.h */
#include "base/recall.h"

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 16 }; /* of a number */

void recall_keep(struct recall *r, struct arena *arena)
{
    *r = (struct recall){.arena = arena};
}

void recall_back(struct recall *r, struct recalled *span, int n)
{
    *r = (struct recall){.back = true, .span = span, .n = n};
}

void recall_within(struct recall *r, const char *object)
{
    const size_t used = strlen(r->within);
    snprintf(r->within + used, sizeof r->within - used, "%s.", object);
}

void recall_without(struct recall *r)
{
    char *last = strrchr(r->within, '.');
    *last = 0;
    last = strrchr(r->within, '.');
    *(last ? last + 1 : r->within) = 0;
}

/* ---- names ----------------------------------------------------------------------------------------------------- */

static bool is_called(const struct recall *r, const struct recalled *s, const char *name)
{
    const size_t used = strlen(r->within);
    return strncmp(s->name, r->within, used) == 0 && strcmp(s->name + used, name) == 0;
}

static const char *find(struct recall *r, const char *name)
{
    for (int i = 0; i < r->n; i++) {
        const int k = (r->next + i) % r->n;
        if (!is_called(r, &r->span[k], name)) continue;
        r->next = k + 1;
        return r->span[k].text;
    }
    return NULL;
}

bool recall_has(const struct recall *r, const char *object)
{
    const size_t used = strlen(r->within), more = strlen(object);
    if (!r->back) return true;
    for (int i = 0; i < r->n; i++) {
        const char *name = r->span[i].name;
        if (strncmp(name, r->within, used) == 0 && strncmp(name + used, object, more) == 0 && name[used + more] == '.')
            return true;
    }
    return false;
}

static void blame(struct recall *r, const char *name)
{
    if (!*r->wrong) snprintf(r->wrong, sizeof r->wrong, "%s%s", r->within, name);
}

/* ---- numbers --------------------------------------------------------------------------------------------------- */

typedef uint64_t (*reader)(const void *x);
typedef void (*writer)(void *x, uint64_t bits);

static char *put_zeros(char *to, size_t zeros)
{
    return zeros == 0 ? to : zeros == 1 ? to + sprintf(to, "0 ") : to + sprintf(to, "z%zu ", zeros);
}

static void keep(struct recall *r, const char *name, const char *x, size_t n, size_t stride, reader read)
{
    char *text = arena_take(r->arena, n + 1, DIGITS + 1), *to = text;
    size_t zeros = 0;
    for (size_t i = 0; i < n; i++) {
        const uint64_t bits = read(x + i * stride);
        if (bits == 0) {
            zeros++;
            continue;
        }
        to = put_zeros(to, zeros);
        to += sprintf(to, "%" PRIx64 " ", bits);
        zeros = 0;
    }
    to = put_zeros(to, zeros);
    if (to > text) to[-1] = 0;
    r->span = arena_more(r->arena, r->span, r->n, &r->capacity, sizeof *r->span);
    r->span[r->n++] = (struct recalled){arena_print(r->arena, "%s%s", r->within, name), text};
    r->size += strlen(text);
}

/* The next number, or the zeros that stand there; false: none. */
static bool number(const char **text, uint64_t *bits, size_t *zeros)
{
    char *end;
    while (**text == ' ') ++*text;
    const bool many = **text == 'z';
    *bits = 0;
    *zeros = 0;
    if (many)
        *zeros = strtoull(*text + 1, &end, 10);
    else
        *bits = strtoull(*text, &end, 16);
    if (end == *text + many) return false;
    *text = end;
    return true;
}

static bool take(const char *text, char *x, size_t n, size_t stride, writer write)
{
    for (size_t i = 0; i < n;) {
        uint64_t bits;
        size_t zeros;
        if (!number(&text, &bits, &zeros) || zeros > n - i) return false;
        if (zeros == 0) write(x + i++ * stride, bits);
        for (; zeros > 0; zeros--) write(x + i++ * stride, 0);
    }
    return *text == 0;
}

static void span(struct recall *r, const char *name, void *x, size_t n, size_t stride, reader read, writer write)
{
    if (!r->back) {
        keep(r, name, x, n, stride, read);
        return;
    }
    const char *text = find(r, name);
    if (!text || !take(text, x, n, stride, write)) blame(r, name);
}

#define BOTH_WAYS(type, kind, to_bits, from_bits)                                                                      \
    static uint64_t read_##kind(const void *from)                                                                      \
    {                                                                                                                  \
        type x;                                                                                                        \
        uint64_t bits;                                                                                                 \
        memcpy(&x, from, sizeof x);                                                                                    \
        to_bits;                                                                                                       \
        return bits;                                                                                                   \
    }                                                                                                                  \
    static void write_##kind(void *to, uint64_t bits)                                                                  \
    {                                                                                                                  \
        type x;                                                                                                        \
        from_bits;                                                                                                     \
        memcpy(to, &x, sizeof x);                                                                                      \
    }                                                                                                                  \
    void recall_##kind##s(struct recall *r, const char *name, type *x, size_t n, size_t stride)                        \
    {                                                                                                                  \
        span(r, name, x, n, stride, read_##kind, write_##kind);                                                        \
    }

BOTH_WAYS(double, double, memcpy(&bits, &x, sizeof bits), memcpy(&x, &bits, sizeof x))
BOTH_WAYS(int, int, bits = (uint64_t)(int64_t)x, x = (int)(int64_t)bits)
BOTH_WAYS(long, long, bits = (uint64_t)(int64_t)x, x = (long)(int64_t)bits)
BOTH_WAYS(bool, bool, bits = x, x = bits != 0)
