/* catalogue.h -- every column that a scene can print, and where its value comes from. */
#ifndef FMDSUB_SIM_CATALOGUE_H
#define FMDSUB_SIM_CATALOGUE_H

#include "model/model.h"
#include "out/columns.h"
#include "scene/scene.h"

enum origin_type {
    FROM_TIME,
    FROM_Q,     /* index: place in q */
    FROM_V,     /* place in v */
    FROM_A,     /* place in v */
    FROM_PLACE, /* index: body; k: x, y, z */
    FROM_ANGLE, /* body, plane */
    FROM_QUATERNION,
    FROM_VELOCITY,
    FROM_OMEGA,
    FROM_ACCELERATION,
    FROM_POINT, /* index: point */
    FROM_POINT_VELOCITY,
    FROM_POINT_ACCELERATION,
    FROM_DISPLACEMENT, /* point; k: x, y, z of its flexible body */
    FROM_TENSOR,       /* index: flexible body; k: 6 times its stress + xx yy zz xy xz yz */
    FROM_AXIAL,        /* index: flexible body; k: its stress */
    FROM_BENDING,
    FROM_VON_MISES,
    FROM_REACTION, /* index: joint; k: fx fy fz mx my mz */
    FROM_LOOP,     /* index: loop; likewise */
    FROM_TIE,      /* index: loop; its force */
    FROM_MEASURE,  /* index: measure */
    FROM_MEASURE_RATE,
    FROM_FORCE, /* index: force */
    FROM_ELONGATION,
    FROM_POWER,
    FROM_DRIVE,    /* index: loop; k: 0 force, 1 power */
    FROM_ENERGY,   /* k: enum energy_column */
    FROM_MOMENTUM, /* k: x y z lx ly lz */
    FROM_STEP      /* k: enum step_column */
};

enum energy_column {
    ENERGY_KINETIC,
    ENERGY_ELASTIC,
    ENERGY_GRAVITY,
    ENERGY_EXTERNAL,
    ENERGY_DRIVE,
    ENERGY_DAMPER,
    ENERGY_FRICTION,
    ENERGY_NUMERICAL,
    ENERGY_RESIDUAL,
    ENERGY_COLUMNS
};
enum step_column { STEP_MINOR, STEP_MAJOR, STEP_RATIO, STEP_SWEEPS, STEP_COLUMNS };

struct origin {
    enum origin_type type;
    int index, k;
    int fast; /* of coordinates, rates, accelerations: 1 fast, 0 slow; -1: neither */
};

struct catalogue {
    int n, room;
    struct column *column; /* [n], t first */
    struct origin *origin; /* [n] */
};

void catalogue_build(struct catalogue *o, const struct scene *scene, const struct model *m, struct arena *life);

/* What must be seen (SEE_... of system.h) to know the chosen columns. */
unsigned catalogue_needs(const struct catalogue *o, const struct selection *chosen);

#endif
