/* section.c -- see section.h */
#include "flex/section.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* ---- numbers ---- */

/* a b^3/3 (1 - 192/pi^5 b/a sum tanh(n pi a/(2 b))/n^5), n odd, a >= b */
double rectangle_torsion(double a, double b)
{
    double sum = 0, most = fmax(a, b), least = fmin(a, b);
    for (int n = 39; n > 0; n -= 2) sum += tanh(n * pi * most / (2 * least)) / pow(n, 5);
    return most * pow(least, 3) * (1 - 192 / pow(pi, 5) * least / most * sum) / 3;
}

/* Area and moments, from shape and sizes. */
static void measure(struct flex_section *o)
{
    const double *a = o->size;
    if (o->shape == SHAPE_RECTANGLE) {
        const double y = 2 * a[0], z = 2 * a[1];
        o->A = y * z;
        o->Iz = z * pow(y, 3) / 12;
        o->Iy = y * pow(z, 3) / 12;
        o->J = rectangle_torsion(y, z);
    }
    if (o->shape == SHAPE_ROUND) {
        o->A = pi * (a[0] * a[0] - a[1] * a[1]);
        o->Iy = o->Iz = pi * (pow(a[0], 4) - pow(a[1], 4)) / 4;
        o->J = 2 * o->Iy;
    }
}

void section_rectangle(struct flex_section *o, double y, double z, double nu)
{
    o->shape = SHAPE_RECTANGLE;
    o->y = o->size[0] = y / 2;
    o->z = o->size[1] = z / 2;
    o->ky = o->kz = 10 * (1 + nu) / (12 + 11 * nu);
    measure(o);
}

void section_round(struct flex_section *o, double outer, double inner, double nu)
{
    const double m2 = inner * inner / (outer * outer), ring = (1 + m2) * (1 + m2);
    o->shape = SHAPE_ROUND;
    o->y = o->z = o->size[0] = outer;
    o->size[1] = inner;
    o->ky = o->kz = 6 * (1 + nu) * ring / ((7 + 6 * nu) * ring + (20 + 12 * nu) * m2);
    measure(o);
}

void section_between(struct flex_section *o, const struct flex_section *a, const struct flex_section *b, double t)
{
    *o = *a;
    if (a->shape != b->shape) o->shape = SHAPE_NUMBERS;
#define MIX(x) o->x = (1 - t) * a->x + t * b->x
    MIX(station), MIX(A), MIX(Iy), MIX(Iz), MIX(J), MIX(ky), MIX(kz), MIX(twist), MIX(rotary), MIX(y), MIX(z);
    MIX(size[0]), MIX(size[1]);
#undef MIX
    measure(o);
}

/* ---- shear stresses ---- */

/* Slopes of Prandtl's function of a rectangle |y| <= a, |z| <= b for unit G theta', by a series that decays with b -
 * |z|: with k = n pi/(2 a), n odd,
 *
 *     xz = 2 y - 16 a/pi^2 sum +-1/n^2 cosh kz/cosh kb sin ky,   xy = -16 a/pi^2 sum +-1/n^2 sinh kz/cosh kb cos ky. */
static void membrane(double *xy, double *xz, double a, double b, double y, double z)
{
    enum { TERMS = 2000 };
    double sum[2] = {0, 0};
    for (int i = 0; i < TERMS; i++) {
        const double n = 2 * i + 1, k = n * pi / (2 * a), sign = (i % 2 ? -1 : 1) / (n * n);
        const double far = exp(k * (fabs(z) - b)) / (1 + exp(-2 * k * b)), near = exp(-2 * k * fabs(z));
        sum[0] += sign * far * (1 - near) * cos(k * y);
        sum[1] += sign * far * (1 + near) * sin(k * y);
        if (far < 1e-17) break;
    }
    *xy = -copysign(16 * a / (pi * pi) * sum[0], z);
    *xz = 2 * y - 16 * a / (pi * pi) * sum[1];
}

/* By unit torque. */
static void torsion(double *o, const struct flex_section *c, double y, double z)
{
    const double a = c->size[0], b = c->size[1];
    if (c->shape == SHAPE_ROUND) {
        o[0] = -z / c->J;
        o[1] = y / c->J;
        return;
    }
    const double wall_y = fmax(a - fabs(y), 0), wall_z = fmax(b - fabs(z), 0);
    if (wall_y <= 1e-9 * a && wall_z <= 1e-9 * b) return; /* a corner */
    if (wall_z / a >= wall_y / b)
        membrane(o, o + 1, a, b, y, z);
    else {
        membrane(o + 1, o, b, a, z, y); /* mirrored: both change sign */
        o[0] = -o[0];
        o[1] = -o[1];
    }
    o[0] /= c->J;
    o[1] /= c->J;
}

/* Along and across unit force P of a round section, at x along it and y across: Saint-Venant's flexure,
 *
 *     div tau = -P x/I,   curl tau = -nu/(1 + nu) P y/I,   no stress on the edges r = R, r = R0,
 *
 * which polynomials of second degree and the slope of cos phi/r solve. */
static void flexure(double *along, double *across, const struct flex_section *c, double x, double y, double nu)
{
    const double R2 = c->size[0] * c->size[0], S2 = c->size[1] * c->size[1], r4 = pow(x * x + y * y, 2);
    const double a = (3 + 2 * nu) / (8 * (1 + nu)), k = 1 - 2 * a, hole = r4 > 0 ? a * R2 * S2 / r4 : 0;
    *along = (a * (R2 + S2 - x * x) - (a - k) * y * y + hole * (y * y - x * x)) / c->Iz;
    *across = (-k - 2 * hole) * x * y / c->Iz;
}

void section_shear(double *T, const struct flex_section *c, double y, double z, double nu)
{
    memset(T, 0, 6 * sizeof *T);
    if (c->shape == SHAPE_NUMBERS) return;
    torsion(T + 4, c, y, z);
    if (c->shape == SHAPE_ROUND) {
        flexure(T, T + 1, c, y, z, nu);
        flexure(T + 3, T + 2, c, z, y, nu);
    } else {
        T[0] = 1.5 / c->A * fmax(1 - pow(y / c->size[0], 2), 0);
        T[3] = 1.5 / c->A * fmax(1 - pow(z / c->size[1], 2), 0);
    }
}
