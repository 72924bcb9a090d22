/* plausible.c -- warnings about numbers that are right but unlikely in SI units: decks from programs that count in mm
 * or degrees.  The bounds are wide: free fall on the sun, aerogel to osmium, one turn; for beams, a bar's speed of
 * sound from soft rubber to diamond, a mast of a kilometre, a section no larger than the beam is long. */
#include <math.h>

#include "la/vec3.h"
#include "scene/build.h"
#include "scene_flex/flexible.h"

static const double MOST_GRAVITY = 300, LEAST_DENSITY = 1, MOST_DENSITY = 25000, TURN = 6.283185307179586;
static const double LEAST_SPEED = 20, MOST_SPEED = 20000, MOST_LENGTH = 1000;

void warn_of_gravity(struct builder *b, const struct node *n)
{
    double g = v3_norm(b->scene->gravity);
    if (!(g > MOST_GRAVITY)) return;
    diag_warn(b->diags, n, AT_VALUE, "W-units", "gravity of %.6g m/s2 is %.3g times that of the earth", g, g / 9.81);
    diag_hint(b->diags, "numbers are SI: m/s2, not mm/s2");
}

static bool is_usual(double density)
{
    return density >= LEAST_DENSITY && density <= MOST_DENSITY;
}

void warn_of_density(struct builder *b, const struct node *shape, double mass, double volume, const char *what)
{
    double density = mass / volume;
    if (!(volume > 0 && mass > 0) || is_usual(density)) return;
    diag_warn(b->diags, shape, AT_VALUE, "W-units", "%s has a density of %.4g kg/m3", what, density);
    diag_hint(b->diags, "numbers are SI: kg and m; steel has 7850 kg/m3, wood some 600");
}

void warn_of_angle(struct builder *b, const struct node *n, double angle)
{
    if (!(fabs(angle) > TURN * (1 + 1e-9))) return;
    diag_warn(b->diags, n, AT_VALUE, "W-units", "an angle of %.6g rad is %.3g turns", angle, fabs(angle) / TURN);
    diag_hint(b->diags, "angles are in rad, not in degrees: %.6g*pi/180", angle);
}

/* The side of a square section of like radius of gyration, the larger one. */
static double side(const struct flex_section *s)
{
    return sqrt(12 * fmax(s->Iz, s->Iy) / s->A);
}

void warn_of_beam(struct builder *b, const struct draft *o, const struct node *material, const struct node *beam,
                  const struct node *section, const char *what)
{
    const double speed = sqrt(o->beam.E / o->beam.density);
    double most = 0;
    for (int i = 0; i < o->beam.nsection; i++) most = fmax(most, side(&o->beam.section[i]));
    if (is_usual(o->beam.density) && (speed < LEAST_SPEED || speed > MOST_SPEED)) { /* else it was told */
        diag_warn(b->diags, material, AT_VALUE, "W-units", "%s: sound runs at %.3g m/s through this material", what,
                  speed);
        diag_hint(b->diags, "numbers are SI: Pa and kg/m3; steel has E 210.0e+9, density 7850, and 5170 m/s");
    }
    if (o->length > MOST_LENGTH) {
        diag_warn(b->diags, beam, AT_VALUE, "W-units", "%s is a beam of %.6g m", what, o->length);
        diag_hint(b->diags, "lengths are in m, not in mm");
    } else if (most > o->length) {
        diag_warn(b->diags, section, AT_VALUE, "W-units", "%s: a section of about %.3g m, the beam is %.3g m long",
                  what, most, o->length);
        diag_hint(b->diags, "sizes are in m, not in mm");
    }
}
