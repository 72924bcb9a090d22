/* bushing.h -- springs and dampers in all directions between two markers. */
#ifndef FMDSUB_KIND_BUSHING_H
#define FMDSUB_KIND_BUSHING_H

#include "kind/force.h"

/* Whose axes it measures along. */
enum bushing_axes { AXES_FIRST, AXES_SECOND, AXES_MIDDLE, AXES_WORLD };

struct bushing {
    struct markers on;
    int axes;                        /* enum bushing_axes */
    double k[3], kr[3];              /* [N/m], [N m/rad] along and about the axes */
    double c[3], cr[3];              /* [N s/m], [N m s/rad] */
    double preload[3], preload_r[3]; /* [N], [N m] on the second body, at rest */
    double rest[3], rest_r[3];       /* [m], [rad] where stiffness gives nothing */
};

#endif
