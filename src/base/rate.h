/* rate.h -- the two classes of a sub-cycled system: what takes the minor step, what the major one. */
#ifndef FMDSUB_BASE_RATE_H
#define FMDSUB_BASE_RATE_H

enum rate { FAST = 1, SLOW = 2, ALL = 3 };

#endif
