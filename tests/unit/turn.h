/* turn.h -- a turn about phi by the angle |phi|, by Rodrigues' formula and by Euler's parameters. */
#ifndef FMDSUB_TESTS_TURN_H
#define FMDSUB_TESTS_TURN_H

#include <math.h>

/* R [9] by column: 1 + sin x/x [phi]x + (1 - cos x)/x^2 [phi]x^2, x = |phi|. */
static inline void turn_matrix(double *R, const double *phi)
{
    double xx = phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2], x = sqrt(xx), half = sin(x / 2);
    double s = x > 0 ? sin(x) / x : 1, c = x > 0 ? 2 * half * half / xx : .5;
    const double H[9] = {0, phi[2], -phi[1], -phi[2], 0, phi[0], phi[1], -phi[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) R[i + 3 * j] = (i == j) + s * H[i + 3 * j] + c * (phi[i] * phi[j] - (i == j) * xx);
}

static inline void turn_quaternion(double *q, const double *phi)
{
    double x = sqrt(phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2]);
    q[0] = cos(x / 2);
    for (int k = 0; k < 3; k++) q[k + 1] = phi[k] * (x > 0 ? sin(x / 2) / x : .5);
}

#endif
