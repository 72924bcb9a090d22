/* stop.h -- the one global: the signal that asks a run to end after its major step; 0: none. */
#ifndef FMDSUB_BASE_STOP_H
#define FMDSUB_BASE_STOP_H

#include <signal.h>

extern volatile sig_atomic_t stop;

#endif
