/* catalogue.h -- every column that a scene can write, and where its value comes from.
 *
 * Columns are rows of tables, one table for each sort of thing that has columns: a joint, a body, a point, a force ...
 * A new column is a row of such a table and its value function beside it, in columns_*.c; nothing else knows of it. */
#ifndef FMDSUB_SIM_CATALOGUE_H
#define FMDSUB_SIM_CATALOGUE_H

#include "model/model.h"
#include "out/columns.h"
#include "scene/scene.h"

struct sim;
struct origin;

/* Who takes a column without asking for it by name. */
enum column_use {
    USE_ON_REQUEST,
    USE_WRITTEN,  /* records of a deck that names no columns */
    USE_POSITION, /* likewise, and the state: its place in q is the origin's index */
    USE_RATE,     /* likewise, in v */
    USE_COUNTED,  /* runs that are compared with each other */
    USE_TURNS     /* final states: an angle that a posture gives up to whole turns */
};

/* What a column needs besides EVALUATE_... of system.h. */
enum {
    NEED_TURNS = 1 << 8,     /* the whole turns of joints that close loops */
    NEED_RATES = 1 << 9,     /* of a mechanism with loops the rates of all joints */
    NEED_ENERGY = 1 << 10,   /* the ledger as it stands at the instant */
    NEED_MOMENTUM = 1 << 11, /* momenta that are kept to round-off */
    NEED_WORKS = 1 << 12     /* works there: the instant is the end of a step */
};

/* A row: one quantity of one sort of thing. */
struct column_kind {
    /* How the names of its columns go on behind the thing's, one for each component, separated by blanks; those of
     * `plane` in 2-D.  NULL: there is none. */
    const char *plane, *space;
    const char *unit; /* NULL: none */
    const char *brief;
    unsigned needs; /* EVALUATE_... of system.h, NEED_...: what is to be known of the instant */

    /* Its value, after what it needs was seen.  Runs in every record: allocates nothing, cannot fail. */
    double (*value)(const struct sim *sim, const struct origin *o);

    const char *angular; /* unit where the thing is an angle, or what drives one; NULL: the same */
    enum column_use use;
    bool own; /* of how the run was stepped: runs are not compared by it */
};

/* {COLUMN(".vx .vy", ".vx .vy .vz", "m/s", "velocity of the centre of mass", EVALUATE_MOTION, velocity)}, */
#define COLUMN(plane_, space_, unit_, brief_, needs_, value_)                                                          \
    .plane = plane_, .space = space_, .unit = unit_, .brief = brief_, .needs = needs_, .value = value_

/* The tables; a row without a brief ends one. */
extern const struct column_kind columns_time[], columns_coordinate[], columns_loop_coordinate[], columns_reaction[],
    columns_loop_reaction[], columns_tie[], columns_rod[], columns_gear[], columns_mode[], columns_beam_stress[],
    columns_beam_shear[], columns_solid_stress[], columns_von_mises[], columns_body[], columns_point[],
    columns_bent_point[], columns_measure[], columns_law[], columns_load[], columns_bushing[], columns_drive[],
    columns_energy[], columns_impact[], columns_contact[], columns_rubbing[], columns_joint_friction[],
    columns_momentum[], columns_step[], columns_formula[];

/* The tables by sorts of things, for the manual; a last one without rows. */
struct column_table {
    const char *thing; /* what stands for its name: "J"; or the name itself, "energy" */
    const char *of;    /* which of these things; NULL: all, or there is only one */
    const struct column_kind *rows;
};
extern const struct column_table column_tables[];

/* The thing that a column is of. */
struct owner {
    const char *name;        /* as its columns begin: "hub", "arm.tip" */
    const struct node *node; /* where the deck has it; NULL: nowhere */
};

/* Where one column's value comes from. */
struct origin {
    const struct column_kind *kind;
    const struct owner *of;
    int index;                     /* number of the thing in the model; of a coordinate its place in q or v */
    int place;                     /* number of the place of stress on the body */
    int k;                         /* component, counted in the names in space */
    unsigned needs;                /* its row's; of an expression those of all that it reads */
    const struct scene_slot *slot; /* what expressions of the deck call it; NULL: nothing */
};

struct catalogue {
    int n, capacity;
    struct column *column; /* [n], t first */
    struct origin *origin; /* [n] */
};

void catalogue_build(struct catalogue *o, const struct scene *scene, const struct model *m, struct arena *life);

void catalogue_add(struct catalogue *o, const char *name, const char *unit, const struct origin *origin,
                   struct arena *life);

/* The column that expressions of the deck call so; NULL: none. */
const struct origin *catalogue_find(const struct catalogue *o, const struct scene_slot *slot);

#endif
