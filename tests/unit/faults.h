/* faults.h -- what can go wrong while writing, on order, and a look at what arrived. */
#ifndef FMDSUB_TESTS_FAULTS_H
#define FMDSUB_TESTS_FAULTS_H

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

/* The plan of the next writes, for struct stream's `write`. */
static struct {
    size_t most;    /* bytes taken by one call; 0: all */
    int interrupts; /* calls interrupted before each that goes through */
    int fails_at;   /* the call that fails, from 1; 0: none */
    int error;      /* with this errno; 0: by taking nothing */
    int calls;      /* so far */
    int waited;     /* interruptions before the next call that goes through */
    size_t largest; /* bytes offered at once so far */
    int cut;        /* calls whose bytes did not end at the end of a record */
} plan;

static inline ssize_t planned_write(int fd, const void *bytes, size_t n)
{
    plan.calls++;
    if (n > plan.largest) plan.largest = n;
    plan.cut += ((const char *)bytes)[n - 1] != '\n';
    if (plan.calls == plan.fails_at) {
        errno = plan.error;
        return plan.error ? -1 : 0;
    }
    if (plan.waited < plan.interrupts) {
        plan.waited++;
        errno = EINTR;
        return -1;
    }
    plan.waited = 0;
    return write(fd, bytes, plan.most && plan.most < n ? plan.most : n);
}

/* All of a file, with a 0 behind; NULL: it cannot be opened.  free() it. */
static inline char *slurp(const char *path, size_t *size)
{
    int fd = open(path, O_RDONLY);
    if (fd < 0) return NULL;
    size_t room = (size_t)lseek(fd, 0, SEEK_END);
    lseek(fd, 0, SEEK_SET);
    char *text = malloc(room + 1);
    *size = 0;
    for (ssize_t got; *size < room && (got = read(fd, text + *size, room - *size)) > 0;) *size += (size_t)got;
    text[*size] = 0;
    close(fd);
    return text;
}

#endif
