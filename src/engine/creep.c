/* creep.c -- see creep.h */
#include "engine/creep.h"

#include <math.h>

#include "engine/sides.h"

/* Does the motion come back to a jump again and again as soon as it has left it, or never reach it?  Steps that are taken because of
 * it are all far shorter than the one before it. */
static bool stays(struct adaptive *m)
{
    enum { MOST = 1000 };
    static const double SHORT = .01;
    m->nshort = fabs(m->came) < SHORT * m->held ? m->nshort + (m->jumps > 0) : 0;
    return m->nshort > MOST;
}

bool creep_found(struct adaptive *m, double t, double end)
{
    enum { MANY = 100000 };
    static const double FAR = 1e4, FEW = 1000;
    struct creep *o = &m->creep;
    if (stays(m)) return true;
    if (o->steps++ == 0) o->from = t;
    if (o->steps < MANY) return false;
    const double way = t - o->from;
    o->steps = 0;
    return fabs(end - t) > FAR * fabs(way) && sides_jump(m->sides, m, t, way * FEW / MANY);
}
