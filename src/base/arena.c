/* arena.c -- a list of blocks, each twice the last; see arena.h */
#include "base/arena.h"

#include <errno.h>
#include <limits.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/status.h"

struct block {
    struct block *before;
    size_t capacity, used;
    alignas(max_align_t) unsigned char bytes[];
};

struct deferred {
    struct deferred *before;
    void (*release)(void *object);
    void *object;
};

struct arena {
    struct block *block;
    struct deferred *deferred;
    size_t taken;
    long grown;
};

enum { FIRST_BLOCK = 1 << 16, MOST_BLOCK = 1 << 24, ALIGNMENT = 64, FIRST_ITEMS = 32 };

/* Under the address sanitizer what has not been taken is out of bounds, and a gap stands behind everything that has. */
#if !defined(__SANITIZE_ADDRESS__) && defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
enum { GAP = 64 };
#else
#define ASAN_POISON_MEMORY_REGION(from, bytes) ((void)(from), (void)(bytes))
#define ASAN_UNPOISON_MEMORY_REGION(from, bytes) ((void)(from), (void)(bytes))
enum { GAP = 0 };
#endif

/* Nothing is allocated to say so.  wanted: bytes; 0: not known. */
static _Noreturn void out_of_memory(double wanted)
{
    char words[200];
    struct rlimit limit = {.rlim_cur = RLIM_INFINITY};
    (void)getrlimit(RLIMIT_AS, &limit);
    int n = snprintf(words, sizeof words, "%s: out of memory", program_invocation_short_name);
    if (wanted > 0) n += snprintf(words + n, sizeof words - (size_t)n, ": %.3g MB more were needed", wanted / 1e6);
    if (limit.rlim_cur != RLIM_INFINITY)
        n += snprintf(words + n, sizeof words - (size_t)n,
                      ", and the limit is %.3g MB in all (--max-memory, ulimit -v)", (double)limit.rlim_cur / 1e6);
    words[n++] = '\n';
    ssize_t sent = write(STDERR_FILENO, words, (size_t)n);
    (void)sent;
    _exit(E_LIMIT);
}

void memory_ended(void)
{
    out_of_memory(0);
}

/* What was asked for, which was of so many bytes. */
static void *had(void *memory, size_t bytes)
{
    if (!memory) out_of_memory((double)bytes);
    return memory;
}

void *memory_or_end(size_t bytes)
{
    return had(malloc(bytes), bytes);
}

void *there_or_end(void *object)
{
    return had(object, 0);
}

FILE *file_or_end(const char *path, const char *mode)
{
    FILE *file = fopen(path, mode);
    if (!file && errno == ENOMEM) out_of_memory(sizeof *file);
    if (file) setvbuf(file, NULL, _IONBF, 0);
    return file;
}

FILE *file_to_read(const char *path)
{
    FILE *file = fopen(path, "re");
    if (!file && errno == ENOMEM) out_of_memory(sizeof *file);
    return file;
}

ssize_t line_or_end(char **line, size_t *room, int end, FILE *file)
{
    errno = 0;
    const ssize_t n = getdelim(line, room, end, file);
    if (n < 0 && errno == ENOMEM) out_of_memory((double)*room + 1);
    return n;
}

/* A text that grows as it is written.  The C library's own (open_memstream) says nothing of what it had no memory for. */
struct words {
    char **text;
    size_t *n, room;
};

static ssize_t words_write(void *self, const char *bytes, size_t n)
{
    struct words *o = self;
    if (*o->n + n + 1 > o->room) {
        const size_t room = 2 * (*o->n + n + 1);
        *o->text = had(realloc(*o->text, room), room);
        o->room = room;
    }
    memcpy(*o->text + *o->n, bytes, n);
    *o->n += n;
    (*o->text)[*o->n] = 0;
    return (ssize_t)n;
}

static int words_end(void *self)
{
    free(self);
    return 0;
}

FILE *words_open(char **text, size_t *n)
{
    struct words *o = memory_or_end(sizeof *o);
    *text = memory_or_end(1);
    **text = 0;
    *n = 0;
    *o = (struct words){text, n, 1};
    FILE *words =
        had(fopencookie(o, "w", (cookie_io_functions_t){.write = words_write, .close = words_end}), sizeof *words);
    setvbuf(words, NULL, _IONBF, 0);
    return words;
}

void words_close(FILE *words, char *const *text)
{
    if (fclose(words) != 0 || !*text) out_of_memory(BUFSIZ);
}

/* Blocks double up to a size; what is larger gets a block of its own. */
static void grow(struct arena *arena, size_t bytes)
{
    size_t capacity = arena->block ? 2 * arena->block->capacity : FIRST_BLOCK;
    if (capacity > MOST_BLOCK) capacity = MOST_BLOCK;
    if (capacity < bytes + ALIGNMENT + GAP) capacity = bytes + ALIGNMENT + GAP;
    struct block *block = memory_or_end(sizeof *block + capacity);
    block->before = arena->block;
    block->capacity = capacity;
    block->used = 0;
    ASAN_POISON_MEMORY_REGION(block->bytes, capacity);
    arena->block = block;
    arena->grown++;
}

struct arena *arena_open(void)
{
    struct arena *arena = memory_or_end(sizeof *arena);
    *arena = (struct arena){0};
    grow(arena, 0);
    return arena;
}

void arena_close(struct arena *arena)
{
    if (!arena) return;
    for (struct deferred *d = arena->deferred; d; d = d->before) d->release(d->object);
    for (struct block *block = arena->block, *before; block; block = before) {
        before = block->before;
        free(block);
    }
    free(arena);
}

/* Bytes from the start of the block to the next aligned address. */
static size_t aligned(const struct block *block)
{
    uintptr_t free_at = (uintptr_t)(block->bytes + block->used);
    return block->used + (size_t)(-free_at & (ALIGNMENT - 1));
}

void *arena_take(struct arena *arena, size_t count, size_t bytes)
{
    if (bytes && count > (SIZE_MAX / 4) / bytes) out_of_memory((double)count * (double)bytes);
    size_t size = count * bytes;
    if (aligned(arena->block) + size + GAP > arena->block->capacity) grow(arena, size);
    size_t start = aligned(arena->block);
    void *memory = arena->block->bytes + start;
    arena->block->used = start + size + GAP;
    ASAN_UNPOISON_MEMORY_REGION(memory, size);
    arena->taken += size;
    memset(memory, 0, size);
    return memory;
}

void *arena_take_matrix(struct arena *arena, size_t rows, size_t columns, size_t bytes)
{
    if (columns && rows > INT_MAX / columns) out_of_memory((double)rows * (double)columns * (double)bytes);
    return arena_take(arena, rows * columns, bytes);
}

bool arena_allows(size_t count, size_t bytes)
{
    if (count == 0 || bytes == 0) return true;
    if (count > (SIZE_MAX / 4) / bytes) return false;
    void *memory = malloc(count * bytes);
    free(memory);
    return memory != NULL;
}

void *arena_more(struct arena *arena, void *list, int n, int *capacity, size_t bytes)
{
    if (n < *capacity) return list;
    if (*capacity > INT_MAX / 2) out_of_memory(2.0 * *capacity * (double)bytes);
    *capacity = *capacity ? 2 * *capacity : FIRST_ITEMS;
    void *more = arena_take(arena, (size_t)*capacity, bytes);
    if (n) memcpy(more, list, (size_t)n * bytes);
    return more;
}

char *arena_copy(struct arena *arena, const char *text, size_t len)
{
    char *copy = arena_take(arena, len + 1, 1);
    memcpy(copy, text, len);
    return copy;
}

char *arena_print(struct arena *arena, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int len = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = arena_take(arena, (size_t)len + 1, 1);
    vsnprintf(text, (size_t)len + 1, format, again);
    va_end(again);
    return text;
}

void arena_defer(struct arena *arena, void (*release)(void *object), void *object)
{
    struct deferred *d = TAKE(arena, struct deferred, 1);
    *d = (struct deferred){arena->deferred, release, object};
    arena->deferred = d;
}

static void close_within(void *arena)
{
    arena_close(arena);
}

struct arena *arena_within(struct arena *life)
{
    struct arena *o = arena_open();
    arena_defer(life, close_within, o);
    return o;
}

struct arena_mark arena_mark(const struct arena *arena)
{
    return (struct arena_mark){arena->block, arena->block->used};
}

/* Blocks grown after the mark go back to the system: a scratch arena that has found its size keeps
 * one block and never asks again. */
void arena_rewind(struct arena *arena, struct arena_mark mark)
{
    while (arena->block != mark.block) {
        struct block *before = arena->block->before;
        free(arena->block);
        arena->block = before;
    }
    arena->block->used = mark.used;
    ASAN_POISON_MEMORY_REGION(arena->block->bytes + mark.used, arena->block->capacity - mark.used);
}

size_t arena_held(const struct arena *arena)
{
    size_t held = 0;
    for (const struct block *b = arena->block; b; b = b->before) held += sizeof *b + b->capacity;
    return held;
}

size_t arena_used(const struct arena *arena)
{
    return arena->taken;
}

long arena_grown(const struct arena *arena)
{
    return arena->grown;
}
