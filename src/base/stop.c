/* stop.c -- see stop.h */
#include "base/stop.h"

volatile sig_atomic_t stop;

enum status stop_status(void)
{
    switch (stop) {
    case 0:
        return OK;
    case SIGHUP:
        return E_SIGHUP;
    case SIGINT:
        return E_SIGINT;
    case SIGTERM:
        return E_SIGTERM;
    default:
        return E_LIMIT;
    }
}

const char *stop_limit(void)
{
    return stop == SIGXCPU ? "CPU time" : stop == SIGALRM ? "time (--max-time)" : NULL;
}
