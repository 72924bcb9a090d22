/* rigid.c -- see rigid.h */
#include "reduce/rigid.h"

#include "la/vec3.h"

void rigid_at(double *u, const double *x, const double *about, int k)
{
    double axis[3] = {k % 3 == 0, k % 3 == 1, k % 3 == 2}, d[3];
    if (k < 3) {
        v3_copy(u, axis);
        return;
    }
    v3_diff(d, x, about);
    v3_cross(u, axis, d);
}

void rigid_motion(double *r, const struct fe *fe, const double *about, int k)
{
    for (int i = 0; i < fe->n; i++) rigid_at(r + 3 * i, fe->x + 3 * i, about, k);
}
