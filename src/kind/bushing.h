/* bushing.h -- springs and dampers in all directions between two markers. */
#ifndef FMDSUB_KIND_BUSHING_H
#define FMDSUB_KIND_BUSHING_H

#include "kind/force.h"

struct bushing {
    struct markers on;
    double k[3], kr[3]; /* [N/m], [N m/rad] along and about the axes of the marker on body a */
    double c[3], cr[3]; /* [N s/m], [N m s/rad] */
};
extern const struct force_kind force_bushing;

#endif
