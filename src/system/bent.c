/* bent.c -- see bent.h */
#include "system/bent.h"

#include <math.h>

#include "flex/spin.h"
#include "la/vec3.h"

/* h, h', h'' by the body's coordinates: h = f q + q'S q/2, h' = H q', h'' = H q'' + q''S q' with H = f + S q. */
static void first_moment(double *h, double *h1, double *h2, const struct model_body *b, const double *q,
                         const double *v, const double *a)
{
    const struct flex_body *o = b->flex;
    v3_set(h, 0, 0, 0);
    v3_set(h1, 0, 0, 0);
    v3_set(h2, 0, 0, 0);
    for (int j = 0; j < o->n; j++) {
        double H[3], half[3], turn[3] = {0, 0, 0};
        v3_copy(H, o->f + 3 * j);
        v3_copy(half, H);
        for (int i = 0; o->s && i < o->n; i++) {
            const double *s = o->s + 3 * (i + o->n * j);
            v3_axpy(H, q[b->mode_q[i]], s);
            v3_axpy(half, q[b->mode_q[i]] / 2, s);
            v3_axpy(turn, v[b->mode_v[i]], s);
        }
        v3_axpy(h, q[b->mode_q[j]], half);
        v3_axpy(h1, v[b->mode_v[j]], H);
        v3_axpy(h2, v[b->mode_v[j]], turn);
        if (a) v3_axpy(h2, a[b->mode_v[j]], H);
    }
}

void bent_centre(struct pose *frame, const struct model_body *b, const double *q, const double *v, const double *a)
{
    double h[3], h1[3], h2[3], part[3][3], across[3];
    first_moment(part[0], part[1], part[2], b, q, v, a);
    m3_mul(h, frame->R, part[0]);
    m3_mul(h1, frame->R, part[1]);
    m3_mul(h2, frame->R, part[2]);
    v3_cross(across, frame->w, h);
    v3_axpy(frame->r, 1 / b->mass, h);
    v3_cross_add(h2, frame->al, h);
    v3_cross_add(h2, frame->w, across);
    v3_cross_add(h2, frame->w, h1);
    v3_cross_add(h2, frame->w, h1);
    v3_axpy(frame->a, 1 / b->mass, h2);
    v3_add(h1, across);
    v3_axpy(frame->v, 1 / b->mass, h1);
}

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
