/* transforms.h -- where the bodies of a tree stand, by products of homogeneous transforms, complex for complex steps:
 * f(x + i e)/e has no difference in it and is exact to round-off (Squire & Trapp 1998). */
#ifndef FMDSUB_TESTS_TRANSFORMS_H
#define FMDSUB_TESTS_TRANSFORMS_H

#include "unit/trees.h"

#include <complex.h>
#undef I

static const double tiny = 0x1p-100;

struct transform {
    double complex T[4][4];
};

static inline struct transform times(struct transform a, struct transform b)
{
    struct transform c = {0};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 4; k++) c.T[i][j] += a.T[i][k] * b.T[k][j];
    return c;
}

static inline struct transform shift(double complex x, double complex y, double complex z)
{
    return (struct transform){{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}}};
}

static inline struct transform turned(const double *R)
{
    return (struct transform){{{R[0], R[3], R[6], 0}, {R[1], R[4], R[7], 0}, {R[2], R[5], R[8], 0}, {0, 0, 0, 1}}};
}

static inline struct transform turned_back(const double *R)
{
    return (struct transform){{{R[0], R[1], R[2], 0}, {R[3], R[4], R[5], 0}, {R[6], R[7], R[8], 0}, {0, 0, 0, 1}}};
}

static inline struct transform about_x(double complex q)
{
    double complex c = ccos(q), s = csin(q);
    return (struct transform){{{1, 0, 0, 0}, {0, c, -s, 0}, {0, s, c, 0}, {0, 0, 0, 1}}};
}

static inline struct transform about_y(double complex q)
{
    double complex c = ccos(q), s = csin(q);
    return (struct transform){{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}, {0, 0, 0, 1}}};
}

static inline struct transform about_z(double complex q)
{
    double complex c = ccos(q), s = csin(q);
    return (struct transform){{{c, -s, 0, 0}, {s, c, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

/* Rotation of a quaternion of any length: v -> q v q* / |q|^2. */
static inline struct transform of_quaternion(const double complex *q)
{
    double complex w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / (w * w + x * x + y * y + z * z);
    return (struct transform){{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y), 0},
                               {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x), 0},
                               {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y), 0},
                               {0, 0, 0, 1}}};
}

/* A joint's child where its parent stands; base and x: the joint's frames on the parent and the child. */
static inline struct transform hang(struct transform *base_out, struct transform *x_out, struct transform parent,
                                    const struct model_joint *j, const double complex *all)
{
    double complex q[7];
    for (int k = 0; k < j->nq; k++) q[k] = all[j->iq[k]];
    struct transform base = times(parent, times(shift(j->a[0], j->a[1], j->a[2]), turned(j->Ea)));
    struct transform back = times(turned_back(j->Eb), shift(-j->b[0], -j->b[1], -j->b[2]));
    struct transform from_b = shift(-j->b[0], -j->b[1], -j->b[2]), x = base;
    switch (j->type) {
    case JOINT_REVOLUTE:
        x = times(base, about_z(q[0]));
        break;
    case JOINT_PRISMATIC:
        x = times(base, shift(0, 0, q[0]));
        break;
    case JOINT_CYLINDRICAL:
        x = times(base, times(shift(0, 0, q[1]), about_z(q[0])));
        break;
    case JOINT_SCREW:
        x = times(base, times(shift(0, 0, tree_pitch(j->number) * q[0]), about_z(q[0])));
        break;
    case JOINT_UNIVERSAL:
        x = times(base, times(about_x(q[0]), about_y(q[1])));
        break;
    case JOINT_PLANAR:
        x = times(base, times(shift(q[0], q[1], 0), about_z(q[2])));
        break;
    case JOINT_SPHERICAL:
        x = times(base, times(turned_back(j->Eb), of_quaternion(q)));
        back = from_b;
        break;
    case JOINT_FREE:
        x = times(base, times(shift(q[0], q[1], q[2]), times(turned_back(j->Eb), of_quaternion(q + 3))));
        back = from_b;
        break;
    case JOINT_FIXED:
    case JOINT_DISTANCE:
    case JOINT_POINT_ON_LINE:
    case JOINT_GEAR:
    case JOINT_RACK:
    case JOINT_TYPES:
        break;
    }
    *base_out = base;
    *x_out = x;
    return times(x, back);
}

/* q moved by dx to first order: a quaternion by q * (0, dx)/2. */
static inline void nudge(double complex *q1, const struct model *m, const double *q, const double *dx,
                         double complex step)
{
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        int plain = tree_turns(j, 3) ? j->nq - 4 : j->nq;
        for (int k = 0; k < plain; k++) q1[j->iq[k]] = q[j->iq[k]] + step * dx[j->iv[k]];
        if (plain == j->nq) continue;
        double a[4], b[3];
        for (int k = 0; k < 4; k++) a[k] = q[j->iq[plain + k]];
        for (int k = 0; k < 3; k++) b[k] = dx[j->iv[plain + k]] / 2;
        double d[4] = {-a[1] * b[0] - a[2] * b[1] - a[3] * b[2], a[0] * b[0] + a[2] * b[2] - a[3] * b[1],
                       a[0] * b[1] + a[3] * b[0] - a[1] * b[2], a[0] * b[2] + a[1] * b[1] - a[2] * b[0]};
        for (int k = 0; k < 4; k++) q1[j->iq[plain + k]] = a[k] + step * d[k];
    }
    for (int b = 1; b < m->nbody; b++)
        for (int k = 0; k < m->body[b].nmode; k++) {
            int iq = m->body[b].mode_q[k];
            q1[iq] = q[iq] + step * dx[m->body[b].mode_v[k]];
        }
}

#endif
