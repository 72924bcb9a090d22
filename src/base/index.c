/* index.c -- see index.h */
#include "base/index.h"

#include <string.h>

#include "base/hash.h"

static const char *name_of(const char *const *name, size_t stride, int i)
{
    return *(const char *const *)(const void *)((const char *)name + (size_t)i * stride);
}

/* The place of the text in the table: of the thing that has it, or a free one. */
static int place(const struct index *o, const char *text, size_t len, const char *const *name, size_t stride)
{
    int i = (int)(hash_bytes(HASH_NOTHING, text, len) & (uint64_t)(o->room - 1));
    for (; o->at[i]; i = (i + 1) & (o->room - 1)) {
        const char *have = name_of(name, stride, o->at[i] - 1);
        if (strlen(have) == len && memcmp(have, text, len) == 0) break;
    }
    return i;
}

/* A table in which `count` things find room, still without any. */
static void make_room(struct index *o, int count)
{
    enum { LEAST = 16 };
    o->n = 0;
    o->room = o->room ? o->room : LEAST;
    while (o->room / 2 <= count) o->room *= 2;
    o->at = TAKE(o->life, int, o->room);
}

int index_find(struct index *o, const char *text, size_t len, const char *const *name, size_t stride, int count)
{
    if (o->room / 2 <= count) make_room(o, count);
    for (; o->n < count; o->n++) {
        const char *new = name_of(name, stride, o->n);
        if (!new) continue;
        int *at = &o->at[place(o, new, strlen(new), name, stride)];
        if (*at == 0) *at = o->n + 1;
    }
    return o->at[place(o, text, len, name, stride)] - 1;
}
