/* stream.h -- bytes on their way out.
 *
 * A record is a line: every record ends with a newline, and what leaves this process in one write
 * ends at the end of a record, so a reader, or a file after a crash, has whole records.  Into a pipe
 * at most PIPE_BUF (4096) bytes go at once where records are that short: such writes are atomic, and
 * two programs may share the pipe.
 *
 * The buffer is written when 64 KiB are full, when stream_tick finds that 0.2 s have passed, and at
 * the end.  Writing is a loop over write(2): interruptions (EINTR), short writes and descriptors
 * that others made non-blocking are waited out.  SIGPIPE and SIGXFSZ should be ignored, so that they
 * arrive here as errors.  The first failure stays: later records are dropped, every call returns it.
 *
 *     E_SIGPIPE  the reader left; nothing needs to be said
 *     E_FILE     anything else, with the system's words; a cut record is taken back where the file
 *                allows it */
#ifndef FMDSUB_OUT_STREAM_H
#define FMDSUB_OUT_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "base/arena.h"
#include "base/status.h"

enum { STREAM_FULL = 1 << 16 };
#define STREAM_PATIENCE 0.2 /* [s] */

struct stream {
    int fd;
    const char *name;   /* in messages */
    const char *target; /* [path] of a file of our own; NULL: someone else's descriptor */
    const char *part;   /* [path] where it is written; NULL: the target itself, or renamed */
    bool pipe;          /* write in atomic pieces */
    bool mute;          /* what is put is dropped */
    enum status status; /* of the first failure */
    char *bytes;        /* [capacity] */
    size_t capacity, used;
    double flushed;    /* [s] monotonic time of the last flush by stream_tick */
    long long written; /* bytes that left */
    long long before;  /* and that left before, by another process */
    struct arena *life;
    ssize_t (*write)(int fd, const void *bytes, size_t n); /* the system's; a test puts its own here */
};

/* An open descriptor, such as 1; it stays open.  E_FILE when it is closed already. */
enum status stream_open(struct stream *s, int fd, const char *name, struct arena *life, struct report *report);

/* The file `path`, written as path.part (a leftover of that name is overwritten) and renamed by
 * stream_close.  Something other than a plain file, such as /dev/null or a named pipe, is written
 * directly.  E_FILE also when another process is writing path.part. */
enum status stream_create(struct stream *s, const char *path, struct arena *life, struct report *report);

/* The same that goes on behind the first `bytes` of an unfinished path.part; what lies behind them is cut.  E_FILE where
 * there is none, or it is shorter. */
enum status stream_resume(struct stream *s, const char *path, long long bytes, struct arena *life,
                          struct report *report);

/* The file `path` so, NULL: standard output. */
enum status stream_to(struct stream *s, const char *path, struct arena *life, struct report *report);

/* Drops what is put from now on; no longer. */
void stream_mute(struct stream *s, bool mute);

/* The part file of `path`; NULL: that is written directly. */
const char *stream_part(const char *path, struct arena *life);

/* Makes room for records of up to `most` bytes: none of those allocates then. */
void stream_reserve(struct stream *s, size_t most);

/* Place for a record of at most `most` bytes; stream_end says where it ended, after its newline. */
char *stream_begin(struct stream *s, size_t most);
enum status stream_end(struct stream *s, const char *end, struct report *report);

/* Text that is one or more whole records. */
enum status stream_put(struct stream *s, const char *text, size_t len, struct report *report);

/* What is no records, such as a picture. */
enum status stream_bytes(struct stream *s, const void *bytes, size_t len, struct report *report);

/* To be called often; now is a monotonic time [s].  The first call writes at once. */
enum status stream_tick(struct stream *s, double now, struct report *report);
enum status stream_flush(struct stream *s, struct report *report);

/* The last flush, then: a file of our own is synced and, if whole, renamed to its path; otherwise
 * it stays as path.part, unless empty.  Returns the first failure of all. */
enum status stream_close(struct stream *s, bool whole, struct report *report);

/* stream_close after what ended with `status`, whole if that is OK: the first failure of both, and its words. */
enum status stream_finish(struct stream *s, enum status status, struct report *report);

/* After stream_close: the path of what was kept unfinished; NULL: nothing. */
const char *stream_kept(const struct stream *s);

#endif
