/* rot.c -- rotations; equations and sources in rot.h */
#include "la/rot.h"

#include <math.h>

#include "la/vec3.h"

void quat_mul(double *o, const double *a, const double *b)
{
    double w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    double x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    double y = a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3];
    double z = a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1];
    o[0] = w;
    v3_set(o + 1, x, y, z);
}

/* q /= |q|. */
static void normalise(double *q)
{
    double f = 1 / sqrt(q[0] * q[0] + v3_dot(q + 1, q + 1));
    q[0] *= f;
    v3_scale(q + 1, f, q + 1);
}

void quat_matrix(double *R, const double *q)
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    v3_set(R, 1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y));
    v3_set(R + 3, 2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x));
    v3_set(R + 6, 2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
}

/* Shepperd: 4 times the squares of w, x, y, z; the largest becomes the divisor. */
void quat_of_matrix(double *q, const double *R)
{
    double trace = R[0] + R[4] + R[8];
    double square[4] = {1 + trace, 1 + 2 * R[0] - trace, 1 + 2 * R[4] - trace, 1 + 2 * R[8] - trace};
    int k = 0;
    for (int i = 1; i < 4; i++)
        if (square[i] > square[k]) k = i;
    double sum[4][4] = {{square[0], R[5] - R[7], R[6] - R[2], R[1] - R[3]},
                        {R[5] - R[7], square[1], R[1] + R[3], R[6] + R[2]},
                        {R[6] - R[2], R[1] + R[3], square[2], R[5] + R[7]},
                        {R[1] - R[3], R[6] + R[2], R[5] + R[7], square[3]}};
    double sign = sum[k][0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++) q[i] = sign * sum[k][i];
    normalise(q);
}

void quat_cay(double *q, const double *phi)
{
    double c = 1 / sqrt(1 + v3_dot(phi, phi) / 4);
    q[0] = c;
    v3_scale(q + 1, c / 2, phi);
}

/* Half the angle of cay(phi) is atan(|phi|/2) = alpha; the fraction is (cos s alpha, sin s alpha phi/|phi|).
 * Half of it is the sum of start and end, (1,0) + cay(phi), and needs no trigonometry. */
static void cay_fraction(double *q, const double *phi, double s)
{
    double size = v3_norm(phi);
    if (s == 1) {
        quat_cay(q, phi);
    } else if (s == .5) {
        double c = 1 / sqrt(1 + size * size / 4);
        q[0] = 1 + c;
        v3_scale(q + 1, c / 2, phi);
    } else {
        double alpha = s * atan(size / 2);
        q[0] = cos(alpha);
        v3_scale(q + 1, size > 0 ? sin(alpha) / size : s / 2, phi);
    }
}

void quat_move(double *q1, const double *q0, const double *phi, double s)
{
    double part[4];
    cay_fraction(part, phi, s);
    quat_mul(q1, q0, part);
    normalise(q1);
}

/* conj(q0) * q1 = (c, e); phi = 2 e/c. */
void quat_diff(double *phi, const double *q1, const double *q0)
{
    double part[4];
    quat_mul(part, (double[]){q0[0], -q0[1], -q0[2], -q0[3]}, q1);
    v3_scale(phi, 2 / part[0], part + 1);
}

/* With (c, e) the quaternion of cay(phi), phi = 2 e/c: c' = -e.w/2 and e' = (c w + e x w)/2 give
 * phi' = 2 e'/c - 2 e c'/c^2 = w + phi x w/2 + phi (phi.w)/4. */
void cay_rate(double *rate, const double *phi, const double *w)
{
    v3_cross(rate, phi, w);
    v3_scale(rate, .5, rate);
    v3_add(rate, w);
    v3_axpy(rate, v3_dot(phi, w) / 4, phi);
}

void vector_of_quat(double *phi, const double *q)
{
    double sine = v3_norm(q + 1), sign = q[0] < 0 ? -1 : 1;
    double angle = 2 * atan2(sine, fabs(q[0]));
    v3_scale(phi, sign * (sine > 0 ? angle / sine : 2), q + 1);
}

void matrix_of_vector(double *R, const double *phi)
{
    const double half = v3_norm(phi) / 2, share = half > 0 ? sin(half) / (2 * half) : .5;
    const double q[4] = {cos(half), share * phi[0], share * phi[1], share * phi[2]};
    quat_matrix(R, q);
}

void vector_of_matrix(double *phi, const double *R)
{
    double q[4];
    quat_of_matrix(q, R);
    vector_of_quat(phi, q);
}

/* Bortz: T = I + [phi]x/2 + k [phi]x^2, k = (1 - (x/2) cot(x/2))/x^2 at x = |phi|; near 0 by its series
 * 1/12 + x^2/720 + x^4/30240. */
void vector_rate(double *T, const double *phi)
{
    double xx = v3_dot(phi, phi), x = sqrt(xx);
    double k = x < .05 ? 1. / 12 + xx * (1. / 720 + xx / 30240) : (1 - x / 2 / tan(x / 2)) / xx;
    for (int j = 0; j < 3; j++) {
        double unit[3] = {j == 0, j == 1, j == 2}, turn[3];
        v3_cross(turn, phi, unit);
        v3_cross(T + 3 * j, phi, turn);
        v3_scale(T + 3 * j, k, T + 3 * j);
        v3_axpy(T + 3 * j, .5, turn);
        v3_add(T + 3 * j, unit);
    }
}

double angle_near(double x, double to)
{
    static const double TURN = 6.283185307179586;
    return x + TURN * round((to - x) / TURN);
}

/* The angle of the direction (c, s); 0 of none. */
static double angle_of(double s, double c)
{
    return s == 0 && c == 0 ? 0 : atan2(s, c);
}

/* The third row of R is (-sin y, cos y sin x, cos y cos x); Rz Ry has the second column (-sin z, cos z, 0). */
void tait_bryan_of_matrix(double *yaw_pitch_roll, const double *R)
{
    const double roll = angle_of(R[5], R[8]), s = sin(roll), c = cos(roll);
    yaw_pitch_roll[2] = roll;
    yaw_pitch_roll[1] = atan2(-R[2], hypot(R[5], R[8]));
    yaw_pitch_roll[0] = atan2(s * R[6] - c * R[3], c * R[4] - s * R[7]);
}

/* The third row of R is (sin e2 sin e3, sin e2 cos e3, cos e2); Rz Rx has the first column (cos e1, sin e1, 0). */
void euler_of_matrix(double *e, const double *R)
{
    const double last = angle_of(R[2], R[5]), s = sin(last), c = cos(last);
    e[2] = last;
    e[1] = atan2(hypot(R[2], R[5]), R[8]);
    e[0] = atan2(c * R[1] - s * R[4], c * R[0] - s * R[3]);
}

int matrix_of_axes(double *R, int i, const double *u, int j, const double *v)
{
    double e[3][3], size = v3_norm(u), reach = v3_norm(v);
    if (!(size > 0 && reach > 0)) return 0;
    v3_scale(e[0], 1 / size, u);
    v3_scale(e[1], 1 / reach, v);
    v3_axpy(e[1], -v3_dot(e[0], e[1]), e[0]);
    double rest = v3_norm(e[1]);
    if (!(rest > 1e-9)) return 0;
    v3_scale(e[1], 1 / rest, e[1]);
    v3_axpy(e[1], -v3_dot(e[0], e[1]), e[0]);
    v3_scale(e[1], 1 / v3_norm(e[1]), e[1]);
    v3_cross(e[2], e[0], e[1]);
    int k = 3 - i - j, even = (i + 1) % 3 == j;
    v3_copy(R + 3 * i, e[0]);
    v3_copy(R + 3 * j, e[1]);
    v3_scale(R + 3 * k, even ? 1 : -1, e[2]);
    return 1;
}
