/* whole.c -- see whole.h */
#include "base/whole.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/stop.h"

enum status whole_read(char **text, size_t *len, int fd, const char *path, size_t max, struct arena *arena,
                       struct report *report)
{
    struct stat st;
    size_t capacity = 1 << 16;
    *len = 0;
    if (fstat(fd, &st)) return fail(report, E_FILE, "%s: %s", path, strerror(errno));
    if (S_ISDIR(st.st_mode)) return fail(report, E_FILE, "%s: is a directory", path);
    if (S_ISREG(st.st_mode) && st.st_size > (off_t)capacity) capacity = (size_t)st.st_size + 1;
    if (capacity > max) capacity = max + 1;
    *text = TAKE(arena, char, capacity + 1);
    for (;;) {
        if (*len == capacity) {
            char *more = TAKE(arena, char, 2 * capacity + 1);
            memcpy(more, *text, *len);
            *text = more;
            capacity *= 2;
        }
        const ssize_t n = read(fd, *text + *len, capacity - *len);
        if (n == 0) break;
        if (n < 0 && errno == EINTR && stop) return stop_status();
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return fail(report, E_FILE, "%s: %s", path, strerror(errno));
        *len += (size_t)n;
        if (*len > max) return fail(report, E_LIMIT, "%s: larger than %zu bytes", path, max);
    }
    (*text)[*len] = 0;
    return OK;
}
