/* plausible.c -- warnings about beams that are right but unlikely in SI units.  The bounds are wide: a bar's speed of
 * sound from soft rubber to diamond, a mast of a kilometre, a section no larger than the beam is long. */
#include <math.h>

#include "scene_flex/flexible.h"

static const double STOUT = .02; /* of how a force at the end bends a beam: more shear is told of */
static const double LEAST_SPEED = 20, MOST_SPEED = 20000, MOST_LENGTH = 1000;

/* The side of a square section of like radius of gyration, the larger one. */
static double side(const struct flex_section *s)
{
    return sqrt(12 * fmax(s->Iz, s->Iy) / s->A);
}

/* 3 E I/(kappa G A l^2) (Timoshenko, Philos. Mag. 41 (1921) 744). */
static void warn_of_shear(struct builder *b, const struct draft *o, const struct node *section, const char *what)
{
    const double share = 3 * o->sheared;
    if (!o->unasked || !(share >= STOUT)) return;
    diag_warn(b->diags, section, AT_KEY, "W-shear",
              "%s: shear, which is off, would add %.1f %% to how a force at its end bends it", what, 100 * share);
    diag_hint(b->diags, "'shear: true' beside 'from' and 'to' takes it in, 'shear: false' says that it is not wanted");
}

void warn_of_beam(struct builder *b, const struct draft *o, const struct node *material, const struct node *beam,
                  const struct node *section, const char *what)
{
    const double speed = sqrt(o->beam.E / o->beam.density);
    double most = 0;
    for (int i = 0; i < o->beam.nsection; i++) most = fmax(most, side(&o->beam.section[i]));
    if (density_is_usual(o->beam.density) && (speed < LEAST_SPEED || speed > MOST_SPEED)) { /* else it was reported */
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
    } else {
        warn_of_shear(b, o, section, what);
    }
}
