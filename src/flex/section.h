/* section.h -- cross-sections of beams: their numbers, what lies between two of them, shear stresses in them.
 *
 * Torsion constant of a rectangle: Saint-Venant's series (Timoshenko & Goodier, Theory of Elasticity, art. 109); shear
 * coefficients: Cowper, J. Appl. Mech. 33 (1966) 335, with m the ratio of the radii:
 *
 *     rectangle   10 (1 + nu) / (12 + 11 nu)
 *     circle       6 (1 + nu) / (7 + 6 nu)
 *     tube         6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2) */
#ifndef FMDSUB_FLEX_SECTION_H
#define FMDSUB_FLEX_SECTION_H

enum section_shape {
    SHAPE_NUMBERS, /* known by its numbers alone: no shear stresses */
    SHAPE_RECTANGLE,
    SHAPE_ROUND
};

/* A cross-section at a station; y, z beam axes before twist. */
struct flex_section {
    double station; /* 0 ... 1 along the beam */
    double A;       /* area [m2] */
    double Iy, Iz;  /* int z2, int y2 dA [m4] */
    double J;       /* torsion constant [m4]; Iy, J, kz, z do not count in the plane */
    double ky, kz;  /* shear area over area, for forces along y, z; 0: no shear deformation */
    double twist;   /* of the section's axes about x [rad] */
    double rotary;  /* 1: rotary inertia rho I of bending counts, 0: it does not; that of torsion always does */
    double y, z;    /* half sizes: where the corners are, for stresses [m]; 0: not known */
    enum section_shape shape;
    double size[2]; /* of a shape: half sides along y, z; outer and inner radius [m] */
};

/* Numbers of a shape: sides y, z; radii, the inner may be 0.  Station, twist, rotary stay. */
void section_rectangle(struct flex_section *o, double y, double z, double nu);
void section_round(struct flex_section *o, double outer, double inner, double nu);
/* Torsion constant of a rectangle with sides a, b [m4]. */
double rectangle_torsion(double a, double b);

/* The part t = 0 ... 1 of the way from a to b: two rectangles, or two round sections, by their sizes, others by their
 * numbers. */
void section_between(struct flex_section *o, const struct flex_section *a, const struct flex_section *b, double t);

/* T [2 x 3]: shear stresses xy, xz at y, z [m] by unit force along y, along z and unit torque, section axes.
 *
 * Torsion: Saint-Venant's.  Forces: of a round section Saint-Venant's flexure; of a rectangle 3/2 V/A (1 - (y/a)^2),
 * that of a narrow one (Jourawski).  Zero for a section known by its numbers alone. */
void section_shear(double *T, const struct flex_section *o, double y, double z, double nu);

#endif
