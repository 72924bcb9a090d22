/* sections.c -- the deck's key tables, section by section; joints and laws bring their own. */
#include <math.h>
#include <string.h>

#include "kind/joint.h"
#include "scene_flex/flexible.h"
#include "scene_read/parts.h"

const struct key keys_deck[] = {
    PARAM_INT(struct deck_keys, version, "fmdsub", 1, 1, KEY_REQUIRED, NULL, "version of the deck's grammar: 1"),
    PARAM_TEXT(struct deck_keys, title, "title", 0, NULL, "one line for people"),
    PARAM_WORD(struct deck_keys, units, "units", "SI", 0, NULL, "all numbers are SI; says so"),
    PARAM_NODE(struct deck_keys, parameters, "parameters", "{name: number or expression}", 0,
               "named numbers for every expression below"),
    PARAM_NODE(struct deck_keys, include, "include", "file", 0, "merges a file of the deck's own folder"),
    PARAM_WORD(struct deck_keys, space, "space", "2d|3d", 0, NULL, "default: from the first vector met"),
    PARAM_NODE(struct deck_keys, gravity, "gravity", "vector [m/s2]", 0, "acceleration of free fall; absent: none"),
    PARAM_NODE(struct deck_keys, bodies, "bodies", "{name: body}", KEY_REQUIRED, "rigid and flexible bodies"),
    PARAM_NODE(struct deck_keys, constraints, "constraints", "{name: joint}", 0, "joints between bodies"),
    PARAM_NODE(struct deck_keys, measures, "measures", "{name: measure}", 0,
               "distances, displacements, angles to print, to read in expressions, to put forces on"),
    PARAM_NODE(struct deck_keys, tables, "tables", "{name: [[x, y], ...] or {file: name}}", 0,
               "tables that 'table' may name, as often as it likes"),
    PARAM_NODE(struct deck_keys, signals, "signals", "{name: expression, or table}", 0,
               "named expressions of t and the motion, or tables of t: for forces, drives, conditions, columns, each "
               "other; columns of their own"),
    PARAM_NODE(struct deck_keys, states, "states", "{name: rate, or {rate: expression, start: number}}", 0,
               "quantities of first order, such as integrals and filters: named like signals, with the rate that they "
               "grow at"),
    PARAM_NODE(struct deck_keys, forces, "forces", "{name: force}", 0, "springs, dampers, loads"),
    PARAM_NODE(struct deck_keys, surfaces, "surfaces", "{name: surface}", 0, "planes, points, spheres that may touch"),
    PARAM_NODE(struct deck_keys, contacts, "contacts", "{name: contact}", 0, "which of them touch, with what friction"),
    PARAM_NODE(struct deck_keys, drives, "drives", "{name: drive}", 0, "coordinates and measures that move as told"),
    PARAM_NODE(
        struct deck_keys, initial, "initial",
        "{coordinate: number, static: true, assemble: true}, static, assemble or {from: file, time: keep}", 0,
        "positions and rates at t = 0; every coordinate is 0 in the drawn position; static: from there to the "
        "nearest stable equilibrium, what nothing holds or pushes as drawn; assemble: to the nearest state that fits"),
    PARAM_NODE(struct deck_keys, partition, "partition", "{fast: [...]} or auto", 0,
               "coordinates that take the minor step"),
    PARAM_NODE(struct deck_keys, integrate, "integrate", "map", KEY_REQUIRED, "scheme, step, ratio, end"),
    PARAM_NODE(struct deck_keys, output, "output", "map", 0, "columns and how often"),
    PARAM_NODE(struct deck_keys, checkpoint, "checkpoint", "{every: 0.5, file: name}", 0,
               "all that the run needs to go on with --resume, kept in a file"),
    PARAM_NODE(struct deck_keys, energy, "energy", "map", 0, "the verdict on the energy balance"),
    PARAM_NODE(struct deck_keys, effects, "effects", "map", 0, "what of the physics is computed, see `fmdsub explain`"),
    KEYS_END,
};

const struct key keys_body[] = {
    PARAM_REAL(struct body_keys, mass, "mass", "kg", 0, INFINITY, 0, NULL, "mass; or from shape and density"),
    PARAM_NODE(struct body_keys, inertia, "inertia", "2-D: number; 3-D: [xx, yy, zz] or [xx, yy, zz, xy, xz, yz]", 0,
               "tensor about the centre of mass, body axes [kg m2]; default: from shape, else 0"),
    PARAM_BOOL(struct body_keys, inertia_check, "inertia_check", 0, "true",
               "false: an inertia that no body can have is taken, with a warning"),
    PARAM_NODE(struct body_keys, at, "at", "vector [m]", 0,
               "centre of mass when drawn, world; required but with a rod from ... to"),
    PARAM_NODE(struct body_keys, orient, "orient",
               "2-D: angle [rad]; 3-D: {x: [...], z: [...]} or one of them, {axis: [...], angle: a}, {quaternion: [w, "
               "x, y, z]}",
               0, "body axes when drawn; default: the world's"),
    PARAM_NODE(struct body_keys, points, "points", "{name: vector [m]}", 0,
               "named points, body axes, from the centre of mass"),
    PARAM_NODE(struct body_keys, shape, "shape", "map", 0, "solid that gives inertia, and mass if a density is given"),
    KEYS_END,
};

const struct key keys_ground[] = {
    PARAM_NODE(struct ground_keys, points, "points", "{name: vector [m]}", 0, "named points of the world"),
    KEYS_END,
};

const struct key keys_shape[] = {
    PARAM_NODE(struct shape_keys, box, "box", "[x, y, z] [m]", 0, "edges along the body axes"),
    PARAM_NODE(struct shape_keys, cylinder, "cylinder", "[radius, length] [m]", 0, "solid, along the body's z axis"),
    PARAM_NODE(struct shape_keys, rod, "rod", "length [m], or {from: vector, to: vector} [m]", 0,
               "slender, along the body's x axis; needs a mass; its two ends, world, in place of 'at' and 'orient'"),
    PARAM_NODE(struct shape_keys, sphere, "sphere", "radius [m]", 0, "solid"),
    PARAM_NODE(struct shape_keys, tube, "tube", "[outer radius, inner radius, length] [m]", 0,
               "along the body's z axis"),
    PARAM_REAL(struct shape_keys, density, "density", "kg/m3", 0, INFINITY, KEY_ABOVE, NULL, "gives the mass"),
    KEYS_END,
};

const struct key keys_rod[] = {
    PARAM_NODE(struct rod_keys, from, "from", "vector [m]", KEY_REQUIRED, "one end when drawn, world"),
    PARAM_NODE(struct rod_keys, to, "to", "vector [m]", KEY_REQUIRED, "the other; the body's x axis points there"),
    KEYS_END,
};

const struct key keys_distance[] = {
    PARAM_NODE(struct measure_keys, points, "distance", "[point, point]", KEY_REQUIRED, "distance of two points"),
    KEYS_END,
};

const struct key keys_displacement[] = {
    PARAM_NODE(struct measure_keys, points, "displacement", "[point, point]", KEY_REQUIRED,
               "of the second point against the first along an axis"),
    PARAM_NODE(struct measure_keys, axis, "axis", "vector", KEY_REQUIRED,
               "drawn direction, fixed in the first point's body"),
    KEYS_END,
};

const struct key keys_angle[] = {
    PARAM_NODE(struct measure_keys, points, "angle", "[body, body]", KEY_REQUIRED,
               "turn of the second body against the first since drawn"),
    PARAM_NODE(struct measure_keys, axis, "axis", "vector", KEY_SPATIAL, "drawn axis, fixed in the first body"),
    KEYS_END,
};

const struct key keys_force[] = {
    PARAM_NODE(struct value_keys, on, "force", "joint, coordinate, measure, [point, point] or body.point", KEY_REQUIRED,
               "what the force acts along, or the point it acts on"),
    PARAM_NODE(struct value_keys, value, "value", "expression, or [expression, ...] at a point, or a table",
               KEY_REQUIRED, "[N]; positive when it drives the measure upwards"),
    PARAM_WORD(struct value_keys, frame, "frame", "world|body", 0, "world", "axes of a force at a point"),
    KEYS_END,
};

const struct key keys_torque[] = {
    PARAM_NODE(struct value_keys, on, "torque", "joint, coordinate, measure, body or body.point", KEY_REQUIRED,
               "what the torque acts along, or the body it acts on; of a flexible one, the section or node"),
    PARAM_NODE(struct value_keys, value, "value", "expression, or three of them on a body in 3-D, or a table",
               KEY_REQUIRED, "[N m]; positive when it drives the measure upwards"),
    PARAM_WORD(struct value_keys, frame, "frame", "world|body", 0, "world", "axes of a torque on a body"),
    KEYS_END,
};

const struct key keys_table[] = {
    PARAM_TABLE(struct table_keys, points, "table", "[[t, x], ...], or a name in tables", 0,
                "points of time; linear between, constant beyond the ends"),
    PARAM_CSV(struct table_keys, points, "file", 0, "CSV file of t, x beside the deck"),
    KEYS_END,
};

const struct key keys_drive[] = {
    PARAM_NODE(struct drive_keys, drive, "drive", "coordinate, joint or measure", KEY_REQUIRED,
               "what moves: a joint coordinate, a distance, a displacement, in the plane an angle"),
    PARAM_NODE(struct drive_keys, value, "value", "expression of t, or table", KEY_REQUIRED,
               "where it is at time t [m] or [rad]; a joint coordinate is 0 in the drawn position"),
    PARAM_WORD(struct drive_keys, drawn, "from", "zero|drawn", 0, "zero",
               "drawn: 'value' is counted from where the measure is drawn, such as the stroke of a ram"),
    KEYS_END,
};

const struct key keys_partition[] = {
    PARAM_NODE(struct partition_keys, fast, "fast", "[joint, coordinate or flexible body, ...]", 0,
               "coordinates that take the minor step; all others take the major one"),
    PARAM_NODE(struct partition_keys, independent, "independent", "[joint or coordinate, ...]", 0,
               "with loops: coordinates that the others follow; default: the program's choice"),
    KEYS_END,
};

const struct key keys_band[] = {
    PARAM_NODE(struct band_keys, modes, "modes", "body", KEY_REQUIRED, "a flexible body"),
    PARAM_REAL(struct band_keys, above, "above", "Hz", 0, INFINITY, KEY_REQUIRED, NULL,
               "its modes of higher frequency, clamped as for its elastic coordinates"),
    KEYS_END,
};

const struct key keys_integrate[] = {
    PARAM_TEXT(struct integrate, scheme, "scheme", 0, "subcycle",
               "integration scheme, see `fmdsub list schemes`; auto: by trial runs, as without this and 'step'"),
    PARAM_REAL(struct integrate, step, "step", "s", 0, INFINITY, KEY_ABOVE, NULL,
               "minor step h; of a run by 'tolerance' the first guess; without both the tolerance is 1.0e-4"),
    PARAM_INT(struct integrate, ratio, "ratio", 1, 1000000, 0, "1", "n: the major step is n h"),
    PARAM_NODE(struct integrate, end, "until", "seconds, or {when: condition, latest: seconds}", KEY_REQUIRED,
               "end of the run"),
    PARAM_WORD(struct integrate, guard, "guard", "tell|act", 0, "tell",
               "where a step loses the balance of energy: say so, or take it in smaller parts, too"),
    KEYS_END,
};

const struct key keys_output[] = {
    PARAM_NODE(struct output_keys, every, "every", "seconds or {steps: N}", 0,
               "time between records, or N major steps; default: every major step"),
    PARAM_NODE(struct output_keys, columns, "columns", "[name, pattern or {name: expression}, ...]", 0,
               "'*' and '?' as in file names; default: all coordinates and rates and energy.residual"),
    KEYS_END,
};

const struct key keys_every[] = {
    PARAM_INT(struct every_keys, steps, "steps", 1, 1000000000, KEY_REQUIRED, NULL, "major steps between records"),
    KEYS_END,
};

const struct key keys_checkpoint[] = {
    PARAM_NODE(struct checkpoint_keys, every, "every", "seconds or {steps: N}", KEY_REQUIRED,
               "simulated time between two of them, at the end of the next major step; or N major steps"),
    PARAM_TEXT(struct checkpoint_keys, file, "file", KEY_REQUIRED, NULL,
               "plain name, in the folder where the run is started; each takes the place of the one before"),
    KEYS_END,
};

const struct key keys_checkpoint_every[] = {
    PARAM_INT(struct every_keys, steps, "steps", 1, 1000000000, KEY_REQUIRED, NULL, "major steps between them"),
    KEYS_END,
};

const struct key keys_energy[] = {
    PARAM_REAL(struct energy_keys, delta, "delta", NULL, 0, INFINITY, KEY_ABOVE, "0.01",
               "largest share of ||W|| that (2-26) may miss"),
    KEYS_END,
};

const struct key keys_omega[] = {
    PARAM_NODE(struct vector_keys, value, "value", "vector [rad/s]", KEY_REQUIRED, "angular velocity"),
    PARAM_WORD(struct vector_keys, frame, "frame", "world|body", 0, "world",
               "axes it is given in; the columns JOINT.omega_x ... are in the body's, BODY.wx ... in the world's"),
    KEYS_END,
};

const struct key keys_until[] = {
    PARAM_NODE(struct until_keys, when, "when", "condition", KEY_REQUIRED,
               "ends the run with the major step in which it turns true"),
    PARAM_REAL(struct until_keys, latest, "latest", "s", 0, INFINITY, KEY_REQUIRED | KEY_ABOVE, NULL,
               "end of the run if it does not"),
    KEYS_END,
};

const struct key keys_from[] = {
    PARAM_NODE(struct from_keys, from, "from", "file", KEY_REQUIRED, "what --final-state wrote, in the deck's folder"),
    PARAM_WORD(struct from_keys, time, "time", "zero|keep", 0, "zero",
               "when the run starts: at 0, or when that one ended"),
    PARAM_WORD(struct from_keys, deck, "deck", "same|any", 0, "same",
               "whose state it may be: this deck's, or also another's or an edited one, for its coordinates and rates"),
    KEYS_END,
};

const struct key keys_state[] = {
    PARAM_INT(struct state_keys, version, "fmdsub_state", 1, 2, KEY_REQUIRED, NULL, "version of this form: 2"),
    PARAM_REAL(struct state_keys, t, "t", "s", -INFINITY, INFINITY, 0, NULL,
               "when it was; 'time: keep' goes on from there"),
    PARAM_WORD(struct state_keys, last_step, "last_step", "whole|cut", 0, "whole",
               "whether the last major step was cut to end at 'until'"),
    PARAM_TEXT(struct state_keys, deck, "deck", 0, NULL, "fingerprint of the deck, but for its start, end and output"),
    PARAM_TEXT(struct state_keys, tree, "tree", 0, NULL, "joints that have the coordinates, in the order of the tree"),
    PARAM_REAL(struct state_keys, length, "length", "m", 0, INFINITY, 0, NULL,
               "what is usual of displacements, where the start of that run told it and bodies do not"),
    PARAM_NODE(struct state_keys, state, "state", "{coordinate or rate: number}", KEY_REQUIRED,
               "all coordinates and all rates, by their column names"),
    PARAM_NODE(struct state_keys, angles, "angles", "{measure: number}", 0,
               "where measured angles in space stand [rad], which a posture gives up to whole turns"),
    PARAM_NODE(struct state_keys, memory, "memory", "{name: numbers}", 0,
               "what the integrator carries from step to step, for the deck that it is of"),
    PARAM_TEXT(struct state_keys, check, "check", 0, NULL, "checksum of all of it"),
    KEYS_END,
};

static const struct section fixed[] = {
    {"", NULL, "the deck", keys_deck},
    {"bodies.NAME", NULL, "a rigid body", keys_body},
    {"bodies.NAME", "beam", "a flexible body: a straight beam", keys_beam_body},
    {"bodies.NAME", "flexible", "a flexible body from a file", keys_reduced},
    {"bodies.ground", NULL, "the world", keys_ground},
    {"bodies.NAME.shape", NULL, "one solid, which gives the inertia", keys_shape},
    {"bodies.NAME.shape.rod", NULL, "its two ends, in place of 'at' and 'orient'", keys_rod},
    {"bodies.NAME.orient", NULL, "body axes when drawn", keys_orient},
    {"bodies.NAME.beam", NULL, "the axis of a beam", keys_beam},
    {"bodies.NAME.section", NULL, "its cross-section", keys_section},
    {"bodies.NAME.sections", NULL, "one of several cross-sections", keys_sections},
    {"bodies.NAME.material", NULL, "its material", keys_material},
    {"bodies.NAME.damping", NULL, "its damping", keys_damping},
    {"bodies.NAME.masses.NAME", NULL, "a mass it carries", keys_lump},
    {"bodies.NAME.points.NAME", NULL, "a point of a beam", keys_station},
    {"bodies.NAME.stress.NAME", NULL, "a place where stresses are wanted", keys_probe},
    {"constraints.NAME.range", NULL, "ends of a coordinate, and what stops it there", keys_range},
    {"constraints.NAME.range.hold", NULL, "stops, rigid or compliant", keys_hold},
    {"constraints.NAME.friction", "revolute", "friction of a revolute joint", keys_pin_friction},
    {"constraints.NAME.friction", "prismatic", "friction of a prismatic joint", keys_slide_friction},
    {"measures.NAME", "distance", "distance of two points", keys_distance},
    {"measures.NAME", "displacement", "displacement along an axis", keys_displacement},
    {"measures.NAME", "angle", "turn of a body against another", keys_angle},
    {"signals.NAME", NULL, "a table in place of an expression", keys_table},
    {"states.NAME", NULL, "a quantity of first order", keys_first_order},
    {"forces.NAME", "force", "a force along a measure or at a point", keys_force},
    {"forces.NAME", "torque", "a torque along a measure or on a body", keys_torque},
    {"forces.NAME.value", NULL, "a table in place of an expression", keys_table},
    {"surfaces.NAME", "plane", "a plane, fixed in a body", keys_plane},
    {"surfaces.NAME", "point", "a point of a body", keys_spot},
    {"surfaces.NAME", "points", "several points of bodies", keys_spots},
    {"surfaces.NAME", "sphere", "a ball; in 2-D a disc", keys_sphere},
    {"surfaces.NAME", "hole", "the inside of a ball; in 2-D of a bore", keys_hole},
    {"surfaces.NAME", "profile", "a curve of y over x, 2-D", keys_profile},
    {"surfaces.NAME", "cam", "a closed curve of radius over angle, 2-D", keys_cam},
    {"contacts.NAME", NULL, "two surfaces that touch, rigid or compliant", keys_contact},
    {"contacts.NAME.friction", NULL, "Coulomb's friction", keys_friction},
    {"drives.NAME", NULL, "a motion that is prescribed", keys_drive},
    {"drives.NAME.value", NULL, "a table in place of an expression", keys_table},
    {"initial", NULL, "going on from a state", keys_from},
    {"initial.from", NULL, "what the file holds", keys_state},
    {"initial.JOINT.omega", NULL, "angular velocity with its axes", keys_omega},
    {"partition", NULL, "slow and fast coordinates", keys_partition},
    {"partition.fast", NULL, "some of a body's modes", keys_band},
    {"integrate", NULL, "time stepping", keys_integrate},
    {"integrate.until", NULL, "an end that the motion decides", keys_until},
    {"output", NULL, "records", keys_output},
    {"output.every", NULL, "records by major steps", keys_every},
    {"checkpoint", NULL, "to go on from after a fall", keys_checkpoint},
    {"checkpoint.every", NULL, "by major steps", keys_checkpoint_every},
    {"energy", NULL, "the balance (2-26)", keys_energy},
    {"effects", NULL, "what of the physics is computed", keys_effects},
};
enum { FIXED = sizeof fixed / sizeof *fixed };

const struct section *sections_fixed(int *n, const struct key_block *schemes, struct arena *life)
{
    struct section *all = TAKE(life, struct section, FIXED + 1);
    memcpy(all, fixed, sizeof fixed);
    all[FIXED] = (struct section){"integrate", NULL, "options of the schemes", schemes->keys};
    *n = FIXED + 1;
    return all;
}

bool scene_section(struct section *o, int i)
{
    if (i < FIXED) {
        *o = fixed[i];
        return true;
    }
    const struct joint_kind *joint = joint_kind_at(i - FIXED);
    if (joint) {
        *o = (struct section){"constraints.NAME", joint->name, joint->brief, joint->keys};
        return true;
    }
    const struct force_kind *force = force_kind_at(i - FIXED - JOINT_WORDS);
    if (!force) return false;
    *o = (struct section){"forces.NAME", force->name, force->brief, force->keys};
    return true;
}
