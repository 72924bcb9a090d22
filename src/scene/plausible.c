/* plausible.c -- warnings about numbers that are right but unlikely in SI units: decks from programs that count in mm
 * or degrees.  The bounds are wide: free fall on the sun, aerogel to osmium, one turn. */
#include <math.h>

#include "la/vec3.h"
#include "scene/build.h"

static const double MOST_GRAVITY = 300, LEAST_DENSITY = 1, MOST_DENSITY = 25000, TURN = 6.283185307179586;

void warn_of_gravity(struct builder *b, const struct node *n)
{
    double g = v3_norm(b->scene->gravity);
    if (!(g > MOST_GRAVITY)) return;
    diag_warn(b->diags, n, AT_VALUE, "W-units", "gravity of %.6g m/s2 is %.3g times that of the earth", g, g / 9.81);
    diag_hint(b->diags, "numbers are SI: m/s2, not mm/s2");
}

bool density_is_usual(double density)
{
    return density >= LEAST_DENSITY && density <= MOST_DENSITY;
}

void warn_of_density(struct builder *b, const struct node *shape, double mass, double volume, const char *what)
{
    double density = mass / volume;
    if (!(volume > 0 && mass > 0) || density_is_usual(density)) return;
    diag_warn(b->diags, shape, AT_VALUE, "W-units", "%s has a density of %.4g kg/m3", what, density);
    diag_hint(b->diags, "numbers are SI: kg and m; steel has 7850 kg/m3, wood some 600");
}

void warn_of_angle(struct builder *b, const struct node *n, double angle)
{
    if (!(fabs(angle) > TURN * (1 + 1e-9))) return;
    diag_warn(b->diags, n, AT_VALUE, "W-units", "an angle of %.6g rad is %.3g turns", angle, fabs(angle) / TURN);
    diag_hint(b->diags, "angles are in rad, not in degrees: %.6g*pi/180", angle);
}
