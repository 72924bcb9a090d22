/* stream.c -- a buffer of whole records over write(2); see stream.h */
#include "out/stream.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/stop.h"

static enum status cannot(struct report *report, const char *verb, const char *name, int error)
{
    return fail(report, E_FILE, "cannot %s '%s': %s", verb, name, strerror(error));
}

static void start(struct stream *s, int fd, const char *name, mode_t mode, struct arena *life)
{
    *s = (struct stream){.fd = fd, .life = life, .flushed = -INFINITY, .write = write};
    s->name = arena_copy(life, name, strlen(name));
    s->pipe = S_ISFIFO(mode);
    stream_reserve(s, 0);
}

enum status stream_open(struct stream *s, int fd, const char *name, struct arena *life, struct report *report)
{
    struct stat st = {0};
    int got = fstat(fd, &st), error = errno;
    start(s, fd, name, st.st_mode, life);
    if (got != 0) return s->status = cannot(report, "write", name, error);
    return OK;
}

/* 0 to 2 may be closed: a data file must not take their place, messages would go into it. */
static int open_above_2(const char *path, int flags)
{
    int fd = open(path, flags | O_WRONLY | O_CLOEXEC | O_NOCTTY, 0666);
    if (fd < 0 || fd > 2) return fd;
    int above = fcntl(fd, F_DUPFD_CLOEXEC, 3), error = errno;
    close(fd);
    errno = error;
    return above;
}

/* Is fd still what path names?  Its writer may have renamed it while we waited at the door. */
static bool is_at(int fd, const char *path)
{
    struct stat ours, there;
    return fstat(fd, &ours) == 0 && stat(path, &there) == 0 && ours.st_dev == there.st_dev &&
           ours.st_ino == there.st_ino;
}

/* The part file, locked, cut to `keep` bytes and with the next to be written behind them; -1 with errno, EWOULDBLOCK:
 * another process writes it.  File systems without locks go without. */
static int open_part(const char *part, int create, off_t keep)
{
    for (;;) {
        int fd = open_above_2(part, create | O_NOFOLLOW | O_NONBLOCK);
        if (fd < 0) return -1;
        bool busy = flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (!busy && !is_at(fd, part)) {
            close(fd);
            continue;
        }
        if (!busy && ftruncate(fd, keep) == 0 && lseek(fd, keep, SEEK_SET) == keep) return fd;
        int error = errno;
        close(fd);
        errno = error;
        return -1;
    }
}

/* Where a link to nothing leads; NULL: it is none. */
static const char *linked(const char *path, struct arena *life)
{
    char to[PATH_MAX];
    const ssize_t n = readlink(path, to, sizeof to - 1);
    const char *slash = strrchr(path, '/');
    if (n <= 0) return NULL;
    to[n] = 0;
    if (*to == '/' || !slash) return arena_copy(life, to, (size_t)n);
    return arena_print(life, "%.*s%s", (int)(slash + 1 - path), path, to);
}

/* Where the file really is, through links; where it will be, if it is not there yet. */
static const char *target_of(const char *path, struct arena *life)
{
    enum { MOST_LINKS = 40 };
    char real[PATH_MAX];
    const char *target = path;
    for (int i = 0; i < MOST_LINKS; i++) {
        if (realpath(target, real)) return arena_copy(life, real, strlen(real));
        const char *next = linked(target, life);
        if (!next) break;
        target = next;
    }
    return arena_copy(life, target, strlen(target));
}

const char *stream_part(const char *path, struct arena *life)
{
    struct stat st;
    bool plain = stat(path, &st) != 0 || S_ISREG(st.st_mode);
    return plain ? arena_print(life, "%s.part", target_of(path, life)) : NULL;
}

enum status stream_create(struct stream *s, const char *path, struct arena *life, struct report *report)
{
    struct stat st = {0};
    bool there = stat(path, &st) == 0;
    start(s, -1, path, st.st_mode, life);
    s->target = target_of(path, life);
    s->part = stream_part(path, life);
    bool plain = s->part != NULL;

    bool allowed = !there || access(path, W_OK) == 0; /* a rename would not ask */
    if (allowed) s->fd = plain ? open_part(s->part, O_CREAT, 0) : open_above_2(path, 0);
    if (s->fd < 0 && allowed && plain && errno == EWOULDBLOCK)
        s->status = fail(report, E_FILE, "cannot write '%s': another process is writing '%s'", path, s->part);
    else if (s->fd < 0 && allowed && errno == EINTR && stop) /* a named pipe that nobody reads */
        s->status = stop_status();
    else if (s->fd < 0)
        s->status = cannot(report, "write", path, errno);
    if (s->fd < 0) s->part = NULL;
    if (s->fd >= 0 && plain && there) (void)fchmod(s->fd, st.st_mode & 0777);
    return s->status;
}

enum status stream_to(struct stream *s, const char *path, struct arena *life, struct report *report)
{
    return path ? stream_create(s, path, life, report) : stream_open(s, STDOUT_FILENO, "standard output", life, report);
}

enum status stream_resume(struct stream *s, const char *path, long long bytes, struct arena *life,
                          struct report *report)
{
    struct stat st = {0};
    const char *part = stream_part(path, life);
    start(s, -1, path, S_IFREG, life);
    s->target = target_of(path, life);
    if (!part || stat(part, &st) != 0)
        return s->status = fail(report, E_FILE, "nothing to go on with: there is no '%s.part'", path);
    if (st.st_size < bytes)
        return s->status = fail(report, E_FILE, "'%s' has %lld bytes, and had %lld when the checkpoint was written",
                                part, (long long)st.st_size, bytes);
    s->fd = open_part(part, 0, (off_t)bytes);
    if (s->fd < 0 && errno == EWOULDBLOCK)
        return s->status = fail(report, E_FILE, "cannot write '%s': another process is writing '%s'", path, part);
    if (s->fd < 0) return s->status = cannot(report, "write", part, errno);
    s->part = part;
    s->written = bytes;
    return OK;
}

void stream_mute(struct stream *s, bool mute)
{
    if (s->mute) s->used = 0;
    s->mute = mute;
}

void stream_reserve(struct stream *s, size_t most)
{
    if (s->capacity >= STREAM_FULL + most) return;
    char *wider = TAKE(s->life, char, STREAM_FULL + most);
    if (s->used) memcpy(wider, s->bytes, s->used);
    s->bytes = wider;
    s->capacity = STREAM_FULL + most;
}

/* Between records less than STREAM_FULL bytes wait, so what stream_reserve made is enough. */
char *stream_begin(struct stream *s, size_t most)
{
    if (s->used + most > s->capacity) stream_reserve(s, 2 * most);
    return s->bytes + s->used;
}

enum status stream_end(struct stream *s, const char *end, struct report *report)
{
    assert(end == s->bytes + s->used || end[-1] == '\n');
    if (s->status != OK) return s->status;
    s->used = (size_t)(end - s->bytes);
    return s->used >= STREAM_FULL ? stream_flush(s, report) : OK;
}

enum status stream_put(struct stream *s, const char *text, size_t len, struct report *report)
{
    char *to = stream_begin(s, len);
    memcpy(to, text, len);
    return stream_end(s, to + len, report);
}

enum status stream_bytes(struct stream *s, const void *bytes, size_t len, struct report *report)
{
    char *to = stream_begin(s, len);
    memcpy(to, bytes, len);
    if (s->status != OK) return s->status;
    s->used += len;
    return stream_flush(s, report);
}

/* The file ends after `done` bytes of the buffer, which may be in the middle of a record: takes that
 * piece back, if this is a plain file and nobody wrote behind it. */
static void take_back(struct stream *s, size_t done)
{
    const char *last = memrchr(s->bytes, '\n', done);
    off_t excess = (off_t)(last ? done - (size_t)(last + 1 - s->bytes) : done);
    struct stat st;
    off_t at = lseek(s->fd, 0, SEEK_CUR);
    if (excess == 0 || at < excess || fstat(s->fd, &st) != 0 || !S_ISREG(st.st_mode) || st.st_size != at) return;
    if (ftruncate(s->fd, at - excess) != 0) return;
    lseek(s->fd, at - excess, SEEK_SET);
    s->written -= excess;
}

static enum status broken(struct stream *s, int error, size_t done, struct report *report)
{
    take_back(s, done);
    s->used = 0;
    if (error == EPIPE || error == ECONNRESET)
        return s->status = fail(report, E_SIGPIPE, "the reader of '%s' left", s->name);
    return s->status =
               fail(report, E_FILE, "cannot write '%s': %s, after %lld bytes", s->name, strerror(error), s->written);
}

/* Bytes to hand over next: into a pipe as many whole records as fit PIPE_BUF, or one longer one. */
static size_t piece(const struct stream *s, const char *from, size_t left)
{
    if (!s->pipe || left <= PIPE_BUF) return left;
    const char *end = memrchr(from, '\n', PIPE_BUF);
    if (!end) end = memchr(from + PIPE_BUF, '\n', left - PIPE_BUF);
    return end ? (size_t)(end + 1 - from) : left;
}

enum status stream_flush(struct stream *s, struct report *report)
{
    if (s->status != OK) return s->status;
    if (s->mute) s->used = 0;
    for (size_t done = 0; done < s->used;) {
        const char *from = s->bytes + done;
        ssize_t sent = s->write(s->fd, from, piece(s, from, s->used - done));
        if (sent > 0) {
            done += (size_t)sent;
            s->written += sent;
        } else if (sent < 0 && errno == EAGAIN) {
            poll(&(struct pollfd){.fd = s->fd, .events = POLLOUT}, 1, -1);
        } else if (sent == 0 || errno != EINTR) {
            return broken(s, sent == 0 ? EIO : errno, done, report);
        }
    }
    s->used = 0;
    return OK;
}

enum status stream_tick(struct stream *s, double now, struct report *report)
{
    if (s->used == 0 || now - s->flushed < STREAM_PATIENCE) return s->status;
    s->flushed = now;
    return stream_flush(s, report);
}

/* Network file systems report at close what they could not store: closing a copy asks, and leaves the
 * descriptor and its lock. */
static bool closes(int fd)
{
    int copy = dup(fd);
    return copy >= 0 && (close(copy) == 0 || errno == EINTR);
}

enum status stream_close(struct stream *s, bool whole, struct report *report)
{
    if (s->fd < 0) return s->status;
    enum status status = stream_flush(s, report);
    if (status == OK && s->part && fsync(s->fd) != 0) status = broken(s, errno, 0, report);
    if (status == OK && !closes(s->fd)) status = broken(s, errno, 0, report);
    if (s->part && s->written == 0 && !(whole && status == OK)) {
        unlink(s->part);
        s->part = NULL;
    }
    if (s->status == OK && s->part && whole) {
        if (rename(s->part, s->target) != 0)
            s->status = fail(report, E_FILE, "cannot rename '%s' to '%s': %s", s->part, s->target, strerror(errno));
        else
            s->part = NULL;
    }
    if (s->target) close(s->fd);
    s->fd = -1;
    return s->status;
}

enum status stream_finish(struct stream *s, enum status status, struct report *report)
{
    struct report late = {0};
    const enum status closed = stream_close(s, status == OK, &late);
    return status != OK || closed == OK ? status : fail(report, closed, "%s", late.text);
}

const char *stream_kept(const struct stream *s)
{
    return s->part;
}
