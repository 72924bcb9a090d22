/* mechanism.h -- a mechanism drawn at random, as numbers and names.
 *
 * The same seed gives the same mechanism everywhere.  What is drawn is drawn in the world's axes; a variant says the same
 * mechanism in other words: members in another order, other names, turned and shifted.  Nothing here is shared with the
 * program that is judged. */
#ifndef RANDOM_MECHANISM_H
#define RANDOM_MECHANISM_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { BODIES = 9, JOINTS = 14, FORCES = 12, TEXT = 200 };

enum joint_kind {
    FIXED,
    REVOLUTE,
    PRISMATIC,
    CYLINDRICAL,
    SCREW,
    UNIVERSAL,
    SPHERICAL,
    PLANAR,
    FREE,
    DISTANCE,
    ON_LINE,
    GEAR,
    RACK,
    JOINT_KINDS
};

struct vec {
    double x[3];
};

struct body {
    bool beam;
    double mass;       /* [kg], of a beam too */
    struct vec at;     /* [m] centre of mass as drawn */
    double inertia[6]; /* [kg m2] 2-D: the first */
    double quat[4];    /* body to world as drawn; 2-D: the angle in quat[0] */
    struct vec point;  /* [m] of the point p, body axes */
    struct vec from, to, up;
    double width, height, E, density, beta;
    int modes;
};

struct joint {
    enum joint_kind kind;
    int a, b; /* bodies, -1: the ground; of gear and rack the joints */
    struct vec at, axis, axis2;
    double pitch; /* of a screw; ratio of a gear, radius of a rack */
    bool swapped; /* written with the body farther from the ground first */
    bool closes;  /* a loop */
    bool in_loop; /* on the way between the bodies of one that closes */
    bool alone;   /* that loop leaves one freedom */
    bool driven;
};

/* A force or measure, with $n for names of joints (j0...) and bodies (b0...) in its text. */
struct force {
    enum { LINE, LOAD, BUSHING } kind;
    char text
        [TEXT]; /* LINE: all of it; LOAD: the factor of time of every component; BUSHING: its keys but at and axis */
    int body, other;
    struct vec at, axis; /* LOAD: the direction */
    bool torque, in_body;
};

struct mechanism {
    uint64_t seed;
    int dim; /* 2 or 3 */
    int nbody, njoint, nforce, nmeasure, nloop, nflex;
    struct body body[BODIES];
    struct joint joint[JOINTS];
    struct force force[FORCES];
    char measure[FORCES][TEXT];
    char drive[TEXT]; /* or empty */
    struct vec gravity;
    char initial[JOINTS][TEXT]; /* coordinates: numbers, scalars only */
    struct vec slide[JOINTS];   /* [m/s] initial velocity of free and planar joints, world */
    bool has_initial[JOINTS], has_slide[JOINTS];
    char fast[4 * TEXT];
    int ratio;
    double until; /* [s], ten records */
    bool rough;   /* a corner somewhere: no order is promised */
};

struct variant {
    bool reversed, renamed, turned;
};

void mechanism_draw(struct mechanism *o, uint64_t seed);

void mechanism_write(FILE *f, const struct mechanism *o, const struct variant *variant);

/* All columns that are compared, in the same order in every variant, separated by commas.  The first `lengths` are
 * places, the next as many velocities, and the rest forces. */
int mechanism_columns(FILE *f, const struct mechanism *o, const struct variant *variant, int *lengths);

/* The turn and shift of a turned variant: x1 = R x0 + d. */
void mechanism_turn(struct vec *o, const struct mechanism *m, const struct vec *x, bool shifted);

/* One line: what it consists of. */
void mechanism_tell(FILE *f, const struct mechanism *o);

#endif
