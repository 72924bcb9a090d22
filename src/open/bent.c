/* bent.c -- see bent.h */
#include "open/bent.h"

#include <math.h>

#include "flex/spin.h"
#include "la/vec3.h"

static double along(const double *row, int stride, const struct model_body *b, const double *q)
{
    double sum = 0;
    for (int j = 0; row && j < b->nmode; j++) sum += row[stride * j] * q[b->mode_q[j]];
    return sum;
}

double bent_stress(const struct model_body *b, int stress, enum bent_stress part, const double *q)
{
    const struct flex_stress *s = &b->flex->stress[stress];
    double t[6];
    if (part <= STRESS_YZ) return along(s->tensor + part, 6, b, q);
    if (part == STRESS_AXIAL) return along(s->axial, 1, b, q);
    if (part == STRESS_BENDING) return along(s->bending, 1, b, q);
    for (int i = 0; i < 6; i++) t[i] = along(s->tensor + i, 6, b, q);
    double x = t[0] - t[1], y = t[1] - t[2], z = t[2] - t[0];
    return sqrt((x * x + y * y + z * z) / 2 + 3 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
}

double bent_spin_limit(const struct model_body *b, const double *axis)
{
    static const double ALONG = 0.01; /* of int |x|^2 dm: across the axis */
    const struct flex_body *o = b->flex;
    const double *x = o->node[o->reference].x; /* int (y - x)(y - x)' dm = xx + m x x' */
    double Ae[3], along = o->mass * v3_dot(x, axis) * v3_dot(x, axis);
    m3_mul(Ae, o->xx, axis);
    along += v3_dot(axis, Ae);
    if (along > (1 - ALONG) * (o->xx[0] + o->xx[4] + o->xx[8] + o->mass * v3_dot(x, x))) return INFINITY;
    struct arena *scratch = arena_open();
    double limit = flex_spin_limit(b->flex, axis, scratch);
    arena_close(scratch);
    return limit;
}
