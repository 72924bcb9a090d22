/* limits.c -- see limits.h */
#include "base/limits.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include "base/stop.h"

/* The sanitizers' shadow memory counts as taken. */
#if defined(__SANITIZE_ADDRESS__)
enum { COUNTED = 0 };
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
enum { COUNTED = 0 };
#else
enum { COUNTED = 1 };
#endif
#else
enum { COUNTED = 1 };
#endif

bool limit_memory(double bytes)
{
    struct rlimit limit;
    if (!COUNTED) return true;
    if (getrlimit(RLIMIT_AS, &limit) != 0) return false;
    if (limit.rlim_cur != RLIM_INFINITY && (double)limit.rlim_cur <= bytes) return true;
    limit.rlim_cur = (rlim_t)bytes;
    return setrlimit(RLIMIT_AS, &limit) == 0;
}

/* Of the container, by the second generation of control groups; infinite: none is known. */
static double container_memory(void)
{
    char text[40];
    int file = open("/sys/fs/cgroup/memory.max", O_RDONLY | O_CLOEXEC);
    if (file < 0) return INFINITY;
    ssize_t n = read(file, text, sizeof text - 1);
    close(file);
    if (n <= 0 || !(text[0] >= '0' && text[0] <= '9')) return INFINITY; /* "max" */
    text[n] = 0;
    return strtod(text, NULL);
}

double limit_memory_default(void)
{
    const double pages = (double)sysconf(_SC_PHYS_PAGES), page = (double)sysconf(_SC_PAGESIZE);
    const double all = pages > 0 && page > 0 ? pages * page : INFINITY;
    return .75 * fmin(all, container_memory());
}

static void on_alarm(int signal)
{
    static const char words[] = "fmdsub: the limit of time (--max-time) is reached: what was under way is given up\n";
    if (!stop) {
        stop = signal;
        return;
    }
    ssize_t sent = write(STDERR_FILENO, words, sizeof words - 1);
    (void)sent;
    _exit(E_LIMIT);
}

static struct timeval interval(double seconds)
{
    const double whole = floor(seconds);
    return (struct timeval){(time_t)whole, (suseconds_t)(1e6 * (seconds - whole))};
}

bool limit_time(double seconds)
{
    struct sigaction action = {.sa_handler = on_alarm};
    const struct itimerval timer = {.it_value = interval(fmax(seconds, 1e-6)),
                                    .it_interval = interval(1 + seconds / 10)};
    return sigaction(SIGALRM, &action, NULL) == 0 && setitimer(ITIMER_REAL, &timer, NULL) == 0;
}
