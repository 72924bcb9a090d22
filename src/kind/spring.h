/* spring.h -- spring and damper along a measure. */
#ifndef FMDSUB_KIND_SPRING_H
#define FMDSUB_KIND_SPRING_H

#include "kind/force.h"

/* f = preload - k (s - rest) - cubic (s - rest)^3 - c s'; s is counted from the measure's zero.  A damper has c only. */
struct spring {
    double k, c, rest, preload;
    double cubic; /* [N/m3] */
};

#endif
