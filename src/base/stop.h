/* stop.h -- the one global: the signal that asks a run to end after the step under way, or to give that up where it is one
 * of very many minor ones; 0: none. */
#ifndef FMDSUB_BASE_STOP_H
#define FMDSUB_BASE_STOP_H

#include <signal.h>

#include "base/status.h"

extern volatile sig_atomic_t stop;

/* How it ends what is under way: E_SIGHUP, E_SIGINT, E_SIGTERM, E_LIMIT (CPU time, --max-time); OK: there was none. */
enum status stop_status(void);

/* The limit that it tells of, such as "CPU time"; NULL: it is somebody's wish. */
const char *stop_limit(void);

#endif
