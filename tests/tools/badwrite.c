/* badwrite.c -- write(2) that misbehaves, put between a program and the C library by LD_PRELOAD.
 *
 * BADWRITE=eio:K     the K-th call and all after it fail with EIO
 *          enospc:K  likewise with ENOSPC, as on a full disk
 *          eintr:K   every K-th call is interrupted before it writes
 *          short:K   no call writes more than K bytes
 * Only calls to standard output count. */
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static ssize_t real_write(int fd, const void *data, size_t size)
{
    static ssize_t (*next)(int, const void *, size_t);

    if (!next) *(void **)&next = dlsym(RTLD_NEXT, "write");
    return next(fd, data, size);
}

static int refuse(int code)
{
    errno = code;
    return -1;
}

ssize_t write(int fd, const void *data, size_t size)
{
    static long calls;
    const char *mode = getenv("BADWRITE"), *colon = mode ? strchr(mode, ':') : NULL;
    long k = colon ? atol(colon + 1) : 0;

    if (fd != STDOUT_FILENO || k < 1) return real_write(fd, data, size);
    calls++;
    if (strncmp(mode, "eio", 3) == 0 && calls >= k) return refuse(EIO);
    if (strncmp(mode, "enospc", 6) == 0 && calls >= k) return refuse(ENOSPC);
    if (strncmp(mode, "eintr", 5) == 0 && calls % k == 0) return refuse(EINTR);
    if (strncmp(mode, "short", 5) == 0 && size > (size_t)k) size = (size_t)k;
    return real_write(fd, data, size);
}
