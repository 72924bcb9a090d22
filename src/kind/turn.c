/* turn.c -- how one set of axes stands against another, by swing and twist. */
#include "kind/turn.h"

#include <math.h>

#include "la/vec3.h"

void turn_find(struct turn *o, int z, double counted)
{
    static const double TURN = 6.283185307179586;
    o->x = (z + 1) % 3, o->y = (z + 2) % 3, o->z = z;
    const double *xa = o->A + 3 * o->x, *ya = o->A + 3 * o->y, *xb = o->B + 3 * o->x, *yb = o->B + 3 * o->y;
    v3_cross(o->c, o->A + 3 * z, o->B + 3 * z);
    o->sine = v3_norm(o->c);
    o->cosine = v3_dot(o->A + 3 * z, o->B + 3 * z);
    o->theta = atan2(o->sine, o->cosine);
    o->g = o->sine > 0 ? o->theta / o->sine : 1;
    o->psi = atan2(v3_dot(ya, xb) - v3_dot(xa, yb), v3_dot(xa, xb) + v3_dot(ya, yb));
    o->psi += TURN * round((counted - o->psi) / TURN);
}

/* Below this angle g1 and G1 are by their series: their differences lose digits [rad]. */
static const double little = .05;

/* row = g (cos theta e - (other.e) own) + g1 (c.e) c, for an axis e of the marker with the z axis `own`. */
void turn_row_along(double *row, const struct turn *o, const double *e, const double *own, const double *other)
{
    const double t = o->theta * o->theta;
    const double g1 = o->theta < little ? 1. / 3 + t * (2. / 15 + t * (2. / 63 + t * 4 / 675))
                                        : (1 - o->g * o->cosine) / (o->sine * o->sine);
    v3_scale(row, o->g * o->cosine, e);
    v3_axpy(row, -o->g * v3_dot(other, e), own);
    v3_axpy(row, g1 * v3_dot(o->c, e), o->c);
}

/* row = G e - G1 (c.e) c, for an axis e in the middle. */
void turn_row_amid(double *row, const struct turn *o, const double *e)
{
    const double t = o->theta * o->theta, half = o->theta / 2, G = half > 0 ? half / sin(half) : 1;
    const double G1 = o->theta < little ? 1. / 24 + t * (29. / 1920 + t * (1037. / 322560 + t * 82591 / 154828800))
                                        : (G - 1) / (o->sine * o->sine);
    v3_scale(row, G, e);
    v3_axpy(row, -G1 * v3_dot(o->c, e), o->c);
}

/* row = (z_a + z_b)/(1 + cos theta). */
void turn_row_twist(double *row, const struct turn *o)
{
    v3_sum(row, o->A + 3 * o->z, o->B + 3 * o->z);
    v3_scale(row, 1 / (1 + o->cosine), row);
}

/* p, which is across `from`, with the shortest turn that takes `from` to `to`. */
static void swing(double *p, const double *from, const double *to)
{
    const double share = v3_dot(to, p) / (1 + v3_dot(from, to));
    for (int i = 0; i < 3; i++) p[i] -= share * (from[i] + to[i]);
}

void turn_swing_axes(double *D, const struct turn *o, const double *E, const double *to)
{
    v3_copy(D + 3 * o->x, E + 3 * o->x);
    v3_copy(D + 3 * o->y, E + 3 * o->y);
    v3_copy(D + 3 * o->z, to);
    swing(D + 3 * o->x, E + 3 * o->z, to);
    swing(D + 3 * o->y, E + 3 * o->z, to);
}

void turn_middle(double *M, const struct turn *o)
{
    const double cosine = cos(o->psi / 2), sine = sin(o->psi / 2), *xa = o->A + 3 * o->x, *ya = o->A + 3 * o->y;
    double E[9], h[3];
    for (int i = 0; i < 3; i++) {
        E[3 * o->x + i] = cosine * xa[i] + sine * ya[i];
        E[3 * o->y + i] = cosine * ya[i] - sine * xa[i];
    }
    v3_copy(E + 3 * o->z, o->A + 3 * o->z);
    v3_sum(h, o->A + 3 * o->z, o->B + 3 * o->z);
    v3_scale(h, 1 / v3_norm(h), h);
    turn_swing_axes(M, o, E, h);
}
