/* source.c -- see source.h */
#include "deck/source.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/text.h"
#include "base/whole.h"

/* ---- lines and places ---- */

/* Bytes of the break at p, 0 if there is none. */
static size_t break_at(const char *p, const char *end)
{
    size_t left = (size_t)(end - p);
    if (left >= 2 && p[0] == '\r' && p[1] == '\n') return 2;
    if (left >= 1 && (p[0] == '\r' || p[0] == '\n')) return 1;
    if (left >= 2 && !memcmp(p, "\xc2\x85", 2)) return 2;
    if (left >= 3 && (!memcmp(p, "\xe2\x80\xa8", 3) || !memcmp(p, "\xe2\x80\xa9", 3))) return 3;
    return 0;
}

/* Lines of the text; their starts go to line[0..n] if it is given. */
static int find_lines(size_t *line, const char *text, size_t len)
{
    const char *end = text + len;
    int n = 1;
    if (line) line[0] = 0;
    for (const char *p = text; p < end;) {
        size_t skip = break_at(p, end);
        p += skip ? skip : 1;
        if (!skip || p == end) continue;
        if (line) line[n] = (size_t)(p - text);
        n++;
    }
    if (line) line[n] = len;
    return n;
}

struct source *source_of(const char *path, const char *text, size_t len, struct arena *arena)
{
    struct source *s = TAKE(arena, struct source, 1);
    *s = (struct source){.path = path, .text = text, .len = len};
    s->lines = find_lines(NULL, text, len);
    size_t *line = TAKE(arena, size_t, s->lines + 1);
    find_lines(line, text, len);
    s->line = line;
    return s;
}

size_t source_line_end(const struct source *s, int line)
{
    size_t start = s->line[line - 1], end = s->line[line];
    for (size_t k = 3; k >= 1; k--)
        if (start + k <= end && break_at(s->text + end - k, s->text + end) == k) return end - k;
    return end;
}

size_t source_offset(const struct source *s, struct mark at)
{
    if (at.line < 1) return 0;
    if (at.line > s->lines) return s->len;
    size_t offset = s->line[at.line - 1], end = s->line[at.line];
    for (int col = 1; col < at.col && offset < end; col++) {
        unsigned code;
        size_t n = text_character(&code, s->text + offset, s->text + end);
        offset += n ? n : 1;
    }
    return offset;
}

struct mark source_mark(const struct source *s, size_t offset)
{
    int low = 0, high = s->lines - 1; /* the last line that starts at or before offset */
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (s->line[middle] <= offset)
            low = middle;
        else
            high = middle - 1;
    }
    struct mark at = {low + 1, 1};
    for (size_t p = s->line[low]; p < offset; at.col++) {
        unsigned code;
        size_t n = text_character(&code, s->text + p, s->text + s->len);
        p += n ? n : 1;
    }
    return at;
}

/* ---- characters ---- */

/* What YAML calls printable. */
static bool printable(unsigned c)
{
    if (c < 0x20) return c == '\t' || c == '\n' || c == '\r';
    return c < 0x7f || c == 0x85 || (c >= 0xa0 && c != 0xfeff && c != 0xfffe && c != 0xffff);
}

enum source_flaw source_check(const struct source *s, size_t *offset)
{
    *offset = 0;
    if (s->len >= 2 && (!memcmp(s->text, "\xff\xfe", 2) || !memcmp(s->text, "\xfe\xff", 2))) return SOURCE_UTF16;
    if (s->len >= 2 && (!s->text[0] != !s->text[1])) return SOURCE_UTF16; /* one letter, one zero */
    for (size_t at = 0; at < s->len;) {
        unsigned code;
        size_t n = text_character(&code, s->text + at, s->text + s->len);
        *offset = at;
        if (n == 0) return SOURCE_UTF8;
        if (code == 0) return SOURCE_ZERO;
        if (!printable(code)) return SOURCE_CONTROL;
        at += n;
    }
    return SOURCE_FINE;
}

/* ---- files ---- */

enum status source_read(struct source **out, int fd, const char *path, size_t max, struct arena *arena,
                        struct report *report)
{
    char *text;
    size_t len;
    *out = NULL;
    TRY(whole_read(&text, &len, fd, path, max, arena, report));
    size_t mark = len >= 3 && !memcmp(text, "\xef\xbb\xbf", 3) ? 3 : 0;
    *out = source_of(path, text + mark, len - mark, arena);
    return OK;
}

/* Without openat2: component by component, no links at all. */
static int open_step_by_step(int folder, const char *name)
{
    char part[256];
    int at = dup(folder);
    while (at >= 0) {
        size_t n = strcspn(name, "/");
        if (n >= sizeof part) return close(at), errno = ENAMETOOLONG, -1;
        memcpy(part, name, n);
        part[n] = 0;
        bool last = name[n] == 0;
        int next = openat(at, part, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (last ? 0 : O_DIRECTORY));
        int error = errno;
        close(at);
        errno = error;
        if (last) return next;
        at = next;
        name += n + 1;
    }
    return -1;
}

static int open_inside(const char *folder, const char *name)
{
    int at = open(*folder ? folder : ".", O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (at < 0) return -1;
    struct open_how how = {.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK,
                           .resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
    int fd = (int)syscall(SYS_openat2, at, name, &how, sizeof how);
    if (fd < 0 && (errno == ENOSYS || errno == EPERM)) fd = open_step_by_step(at, name);
    int error = errno;
    close(at);
    errno = error;
    return fd;
}

static bool has_dots(const char *name)
{
    for (const char *p = name; *p;) {
        size_t n = strcspn(p, "/");
        if (n == 2 && p[0] == '.' && p[1] == '.') return true;
        p += n + (p[n] == '/');
    }
    return false;
}

int source_open_beneath(const char *folder, const char *name, const char **why)
{
    struct stat st;
    *why = "is outside the deck's folder";
    if (*name == '/' || has_dots(name)) return -1;
    int fd = open_inside(folder, name);
    if (fd < 0 && (errno == EXDEV || errno == ELOOP)) return -1;
    *why = fd < 0 ? strerror(errno) : "is not a regular file";
    if (fd < 0) return -1;
    if (!fstat(fd, &st) && S_ISREG(st.st_mode)) return fd;
    close(fd);
    return -1;
}
