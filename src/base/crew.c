/* crew.c -- see crew.h */
#include "base/crew.h"

#include <errno.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/stop.h"

enum { PATIENCE = 200 }; /* [ms] a signal may have to wait */

/* A piece is its length and its bytes; the last one of a job that came to its end is its report. */
struct head {
    size_t n;
    bool last;
};

struct member {
    pid_t pid; /* 0: not begun, or over */
    int job;
    int from; /* the pipe; -1: closed */
    bool over, heard;
    struct report end;
    char *bytes; /* [capacity] */
    size_t used, capacity;
    size_t taken; /* of these have been heard */
    void *piece;  /* [room] heard last, where any order will do */
    size_t room;
};

static enum status write_all(int to, const void *bytes, size_t n)
{
    for (const char *at = bytes; n > 0;) {
        const ssize_t sent = write(to, at, n);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return E_SIGPIPE;
        at += sent;
        n -= (size_t)sent;
    }
    return OK;
}

static enum status tell(int to, const void *bytes, size_t n, bool last)
{
    struct head head;
    memset(&head, 0, sizeof head);
    head.n = n;
    head.last = last;
    TRY(write_all(to, &head, sizeof head));
    return write_all(to, bytes, n);
}

enum status crew_tell(int to, const void *bytes, size_t n)
{
    return tell(to, bytes, n, false);
}

/* Never returns.  The child ends with its parent, however that ends. */
static void be_child(const struct crew *o, int i, int to, pid_t parent)
{
    struct report end = {0};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(E_BUG);
    const enum status status = o->work(o->self, i, to, &end);
    end.status = status;
    if (tell(to, &end, sizeof end, true) != OK) _exit(E_SIGPIPE);
    exit((int)status);
}

static enum status begin(struct member *m, const struct crew *o, int i, struct report *report)
{
    *m = (struct member){
        .job = i, .from = -1, .bytes = m->bytes, .capacity = m->capacity, .piece = m->piece, .room = m->room};
    int ends[2];
    const pid_t parent = getpid();
    if (pipe(ends) != 0) return fail(report, E_LIMIT, "no pipe for a process of its own: %s", strerror(errno));
    (void)fflush(NULL); /* or the child would write it again */
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        be_child(o, i, ends[1], parent);
    }
    const int error = errno;
    close(ends[1]);
    m->from = ends[0];
    m->pid = pid;
    if (pid > 0) return OK;
    close(ends[0]);
    m->from = -1;
    return fail(report, E_LIMIT, "no process of its own can be started: %s", strerror(error));
}

/* One that ended without a report: out of memory, which it has said itself, or ended from outside. */
static void bury(struct member *m)
{
    int how = 0;
    while (waitpid(m->pid, &how, 0) < 0 && errno == EINTR) continue;
    m->pid = 0;
    m->over = true;
    if (m->end.status != OK || m->end.text[0]) return;
    if (WIFSIGNALED(how))
        (void)fail(&m->end, E_LIMIT, "a process of its own was ended by signal %d", WTERMSIG(how));
    else
        m->end.status = (enum status)WEXITSTATUS(how);
}

static void make_room(struct member *m, size_t more, struct arena *life)
{
    if (m->used + more <= m->capacity) return;
    m->capacity = 2 * (m->used + more);
    char *wider = arena_take(life, m->capacity, 1);
    if (m->used) memcpy(wider, m->bytes, m->used);
    m->bytes = wider;
}

/* What has come, kept; the end of the pipe is the end of the job. */
static void receive(struct member *m, struct arena *life)
{
    char piece[1 << 16];
    const ssize_t n = read(m->from, piece, sizeof piece);
    if (n < 0 && errno == EINTR) return;
    if (n > 0) {
        make_room(m, (size_t)n, life);
        memcpy(m->bytes + m->used, piece, (size_t)n);
        m->used += (size_t)n;
        return;
    }
    close(m->from);
    m->from = -1;
    bury(m);
}

/* A piece in a place of its own, aligned. */
static void *place_of(struct member *m, const struct crew *o, size_t n, struct arena *life)
{
    if (!o->any_order) return arena_take(life, n, 1);
    if (n > m->room) {
        m->room = 2 * n;
        m->piece = arena_take(life, m->room, 1);
    }
    return m->piece;
}

/* Whole pieces that wait. */
static enum status hear(struct member *m, const struct crew *o, struct arena *life, struct report *report)
{
    struct head head;
    while (m->used - m->taken >= sizeof head) {
        memcpy(&head, m->bytes + m->taken, sizeof head);
        if (m->used - m->taken < sizeof head + head.n) break;
        const char *at = m->bytes + m->taken + sizeof head;
        m->taken += sizeof head + head.n;
        if (head.last) {
            memcpy(&m->end, at, sizeof m->end);
            continue;
        }
        void *aligned = place_of(m, o, head.n, life);
        memcpy(aligned, at, head.n);
        TRY(o->hear(o->self, m->job, aligned, head.n, report));
    }
    return OK;
}

static void pass_on(struct member *m, int n, int signal)
{
    for (int i = 0; i < n; i++)
        if (m[i].pid > 0) kill(m[i].pid, signal);
}

static int processors(void)
{
    cpu_set_t set;
    const int n = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return n > 0 ? n : 1;
}

/* Waits for news of those at work. */
static void wait_for(struct member *m, struct pollfd *fds, int n, struct arena *life)
{
    for (int i = 0; i < n; i++) fds[i] = (struct pollfd){.fd = m[i].from, .events = POLLIN};
    if (poll(fds, (nfds_t)n, PATIENCE) <= 0) return;
    for (int i = 0; i < n; i++)
        if (m[i].from >= 0 && fds[i].revents) receive(&m[i], life);
}

static enum status settle(const struct member *m, const struct crew *o, struct report *report)
{
    if (m->end.status == OK || stop) return OK;
    if (o->lost) return o->lost(o->self, m->job, &m->end, report);
    return m->end.text[0] ? fail(report, m->end.status, "%s", m->end.text) : m->end.status;
}

/* In the order of the jobs as far as they have come, or as they come. */
static enum status hear_all(struct member *m, const struct crew *o, int n, struct arena *life, struct report *report)
{
    for (int i = 0; i < n; i++) {
        if (m[i].heard) continue;
        TRY(hear(&m[i], o, life, report));
        if (!m[i].over && !o->any_order) return OK;
        if (!m[i].over) continue;
        m[i].heard = true;
        TRY(settle(&m[i], o, report));
    }
    return OK;
}

/* Who takes the next job: of n places the first that is done, or where order counts the next. */
static struct member *next_free(struct member *m, const struct crew *o, int n, int job)
{
    if (!o->any_order) return &m[job];
    for (int i = 0; i < n; i++)
        if (m[i].heard) return &m[i];
    return NULL;
}

static enum status run(struct member *m, const struct crew *o, int n, int most, struct arena *life,
                       struct report *report)
{
    struct pollfd *fds = TAKE(life, struct pollfd, n);
    int begun = 0, passed = 0;
    for (;;) {
        int busy = 0;
        for (int i = 0; i < n; i++) busy += m[i].from >= 0;
        for (; begun < o->n && busy < most && !stop; busy++, begun++) {
            struct member *free = next_free(m, o, n, begun);
            if (!free) break;
            TRY(begin(free, o, begun, report));
        }
        if (busy == 0) return hear_all(m, o, o->any_order ? n : begun, life, report);
        wait_for(m, fds, n, life);
        if (stop && !passed++) pass_on(m, n, SIGTERM);
        TRY(hear_all(m, o, o->any_order ? n : begun, life, report));
        if (o->idle) o->idle(o->self);
    }
}

enum status crew_run(const struct crew *o, struct arena *life, struct report *report)
{
    const int most = o->most ? o->most : processors(), n = o->any_order && most < o->n ? most : o->n;
    struct member *m = TAKE(life, struct member, n);
    for (int i = 0; i < n; i++) m[i] = (struct member){.from = -1, .heard = o->any_order};
    const enum status status = run(m, o, n, most, life, report);
    for (int i = 0; i < n; i++) {
        if (m[i].from >= 0) close(m[i].from);
        if (m[i].pid <= 0) continue;
        kill(m[i].pid, SIGKILL);
        bury(&m[i]);
    }
    return status == OK ? stop_status() : status;
}
