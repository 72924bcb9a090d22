/* badalloc.c -- malloc(3) and its like that fail, put between a program and the C library by LD_PRELOAD.
 *
 * BADALLOC=K         the K-th call fails, the others do not
 * BADALLOC_TELL=FILE the number of calls is written there when the program ends */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);

static long calls, wanted;
static int tell = -1;

__attribute__((constructor)) static void begin(void)
{
    const char *k = getenv("BADALLOC"), *file = getenv("BADALLOC_TELL");

    if (file) tell = open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600); /* before the program may open less */
    calls = 0;
    wanted = k ? atol(k) : 0;
}

__attribute__((destructor)) static void end(void)
{
    if (tell >= 0) dprintf(tell, "%ld\n", calls);
}

static int refused(void)
{
    if (__atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED) != wanted) return 0;
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t bytes)
{
    return refused() ? NULL : __libc_malloc(bytes);
}

void *calloc(size_t n, size_t bytes)
{
    return refused() ? NULL : __libc_calloc(n, bytes);
}

void *realloc(void *p, size_t bytes)
{
    return refused() ? NULL : __libc_realloc(p, bytes);
}
