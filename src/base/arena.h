/* arena.h -- the one way of memory.
 *
 * Two arenas: one for the life of a run, one for scratch inside a step.  Everything is taken from
 * them and nothing is freed singly; building takes everything, stepping takes nothing.  Out of
 * memory is one line on stderr and exit 7, here and nowhere else; how much there is, base/limits.h tells the system. */
#ifndef FMDSUB_BASE_ARENA_H
#define FMDSUB_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct arena;

/* A place to come back to: everything taken after the mark is given back at once. */
struct arena_mark {
    void *block;
    size_t used;
};

struct arena *arena_open(void);
/* One that is closed with another. */
struct arena *arena_within(struct arena *life);
/* Runs what was deferred, last first, then frees all.  NULL is allowed. */
void arena_close(struct arena *arena);

/* Zeroed, aligned for any type, never NULL.  bytes = 0 gives a valid pointer. */
void *arena_take(struct arena *arena, size_t count, size_t bytes);
#define TAKE(arena, type, n) ((type *)arena_take(arena, (size_t)(n), sizeof(type)))
/* rows x columns, both counts: no product of them overflows, here or in an int that counts the elements. */
#define TAKE_MATRIX(arena, type, rows, columns)                                                                        \
    ((type *)arena_take_matrix(arena, (size_t)(rows), (size_t)(columns), sizeof(type)))
void *arena_take_matrix(struct arena *arena, size_t rows, size_t columns, size_t bytes);

/* May so many bytes more be taken?  For what is needed only where nothing better serves, so that a run can end in good
 * order instead. */
bool arena_allows(size_t count, size_t bytes);

/* A list of n items of `bytes` with room for one more: itself, or in a place of twice the room. */
void *arena_more(struct arena *arena, void *list, int n, int *capacity, size_t bytes);

/* A copy of len bytes with a 0 after them. */
char *arena_copy(struct arena *arena, const char *text, size_t len);
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
char *
arena_print(struct arena *arena, const char *format, ...);

/* A library could not allocate: says so and ends. */
_Noreturn void memory_ended(void);

/* Memory for foreign code that is not told of failing (hooks of cJSON, buffers), free() gives it back; and a stream that
 * takes none but itself, NULL with errno as of fopen(). */
void *memory_or_end(size_t bytes);
/* What foreign code has had from the system itself; NULL: it has had none. */
void *there_or_end(void *object);
FILE *file_or_end(const char *path, const char *mode);
/* To read, with a buffer; NULL: it cannot be opened. */
FILE *file_to_read(const char *path);
/* As getdelim(3). */
ssize_t line_or_end(char **line, size_t *room, int end, FILE *file);
/* A file that is text in memory, the caller's to free() behind words_close(). */
FILE *words_open(char **text, size_t *n);
void words_close(FILE *words, char *const *text);

/* A foreign object joins: release(object) runs when the arena closes. */
void arena_defer(struct arena *arena, void (*release)(void *object), void *object);

struct arena_mark arena_mark(const struct arena *arena);
void arena_rewind(struct arena *arena, struct arena_mark mark);

/* Bytes that the system has given for it. */
size_t arena_held(const struct arena *arena);
/* Bytes taken since opening, and the times the arena asked the system for memory. */
size_t arena_used(const struct arena *arena);
long arena_grown(const struct arena *arena);

#endif
