/* sections_contact.c -- key tables of what touches and rubs: surfaces, contacts, friction, ranges and their stops */
#include <math.h>

#include "scene_read/parts.h"

#define SURFACE(word, shape, brief) PARAM_NODE(struct surface_keys, on, word, shape, KEY_REQUIRED, brief)
#define RADIUS                                                                                                         \
    PARAM_REAL(struct surface_keys, radius, "radius", "m", 0, INFINITY, KEY_REQUIRED | KEY_ABOVE | KEY_BELOW, NULL,    \
               "its radius")
#define CENTRE                                                                                                         \
    PARAM_NODE(struct surface_keys, at, "at", "vector [m]", 0,                                                         \
               "its centre when drawn, world; default: the body's centre of mass")
const struct key keys_plane[] = {
    SURFACE("plane", "body", "the body that it is fixed in"),
    PARAM_NODE(struct surface_keys, at, "at", "vector [m]", KEY_REQUIRED, "a point of it when drawn, world"),
    PARAM_NODE(struct surface_keys, normal, "normal", "vector", KEY_REQUIRED, "away from it, to the side that is free"),
    PARAM_NODE(struct surface_keys, along, "along", "vector", KEY_SPATIAL,
               "a direction in it, of 'speed' and the first component of friction"),
    KEYS_END,
};
const struct key keys_spot[] = {SURFACE("point", "body or body.point", "the point"), KEYS_END};
const struct key keys_spots[] = {
    SURFACE("points", "[body.point, ...]", "the points; contact NAME has NAME.1, NAME.2, ..."), KEYS_END};
const struct key keys_sphere[] = {SURFACE("sphere", "body", "the body that it is fixed in"), CENTRE, RADIUS, KEYS_END};
const struct key keys_hole[] = {SURFACE("hole", "body", "the body that it is in"), CENTRE, RADIUS, KEYS_END};
const struct key keys_profile[] = {
    PARAM_NODE(struct surface_keys, on, "profile", "body", KEY_REQUIRED | KEY_PLANAR, "the body that it is fixed in"),
    PARAM_NODE(struct surface_keys, at, "at", "vector [m]", 0,
               "where x = y = 0 is when drawn, world, its axes those of the world; default: the body's centre of mass"),
    PARAM_TABLE(struct surface_keys, points, "table", "[[x, y], ...], or a name in tables", 0,
                "points [m]; smooth between, straight beyond the ends; free is what lies above"),
    PARAM_CSV(struct surface_keys, points, "file", 0, "CSV file of x, y beside the deck"),
    KEYS_END,
};
const struct key keys_cam[] = {
    PARAM_NODE(struct surface_keys, on, "cam", "body", KEY_REQUIRED | KEY_PLANAR, "the body that it is fixed in"),
    CENTRE,
    PARAM_TABLE(
        struct surface_keys, points, "table", "[[angle, radius], ...], or a name in tables", 0,
        "points [rad], [m] of one turn when drawn, the first not repeated at its end, counted from the world's x "
        "axis; smooth between; free is what lies outside"),
    PARAM_CSV(struct surface_keys, points, "file", 0, "CSV file of angle, radius beside the deck"),
    KEYS_END,
};

const struct key keys_contact[] = {
    PARAM_NODE(struct contact_keys, between, "between", "[surface, surface]", KEY_REQUIRED, "what touches"),
    PARAM_REAL(struct contact_keys, restitution, "restitution", NULL, 0, 1, 0, NULL,
               "speed after an impact over that before; default 0, of compliant ones: they take nothing"),
    PARAM_NODE(struct contact_keys, friction, "friction", "number, or a map", 0,
               "coefficient of friction; default: none"),
    PARAM_REAL(
        struct contact_keys, speed, "speed", "m/s", -INFINITY, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
        "of a belt: of the plane's surface, along it; in 2-D to the right where its normal points up; default 0"),
    PARAM_REAL(struct contact_keys, push.k, "stiffness", "N/m^n", 0, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "makes it compliant, for every scheme: push per depth to the power of n; default: rigid"),
    PARAM_WORD(struct contact_keys, push.root, "exponent", "1|1.5", 0, NULL,
               "n, of compliant ones; 1.5 for balls (Hertz); default 1"),
    PARAM_REAL(struct contact_keys, push.c, "damping", "N s/m", 0, INFINITY, KEY_BELOW, NULL,
               "compliant: push per rate while it pushes; it never pulls; default 0"),
    PARAM_REAL(struct contact_keys, impact, "impact_speed", "m/s", 0, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "compliant, in place of damping: the speed at which 'restitution' is what it is"),
    KEYS_END,
};
const struct key keys_friction[] = {
    PARAM_REAL(struct friction_keys, kinetic, "kinetic", NULL, 0, INFINITY, KEY_REQUIRED | KEY_BELOW, NULL,
               "coefficient where it slides"),
    PARAM_REAL(struct friction_keys, holding, "static", NULL, 0, INFINITY, KEY_BELOW, NULL,
               "coefficient where it sticks; default: kinetic"),
    PARAM_REAL(struct friction_keys, slip, "slip_speed", "m/s", 0, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "compliant: speed at which friction has reached 0.7 of its bound; default 1.0e-3"),
    KEYS_END,
};

#define RUBS                                                                                                           \
    PARAM_REAL(struct rubbing_keys, coefficient, "coefficient", NULL, 0, INFINITY, KEY_BELOW, NULL,                    \
               "friction per force of the joint"),                                                                     \
        PARAM_REAL(struct rubbing_keys, kinetic, "kinetic", NULL, 0, INFINITY, KEY_BELOW, NULL,                        \
                   "in place of it: where it moves"),                                                                  \
        PARAM_REAL(struct rubbing_keys, holding, "static", NULL, 0, INFINITY, KEY_BELOW, NULL,                         \
                   "and where it sticks; default: kinetic")
const struct key keys_pin_friction[] = {
    RUBS,
    PARAM_REAL(struct rubbing_keys, radius, "radius", "m", 0, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "of the pin: friction's arm; needed with coefficients"),
    PARAM_REAL(struct rubbing_keys, preload, "torque", "N m", 0, INFINITY, KEY_BELOW, "0",
               "that is there without any force, as of a seal"),
    KEYS_END,
};
const struct key keys_slide_friction[] = {
    RUBS,
    PARAM_REAL(struct rubbing_keys, length, "length", "m", 0, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "of the guide, whose ends bear the joint's moment, too; default: only its force counts"),
    PARAM_REAL(struct rubbing_keys, preload, "force", "N", 0, INFINITY, KEY_BELOW, "0",
               "that is there without any other, as of a seal"),
    KEYS_END,
};

const struct key keys_range[] = {
    PARAM_REAL(struct range_keys, lower, "lower", "m or rad", -INFINITY, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "lower end; default: none"),
    PARAM_REAL(struct range_keys, upper, "upper", "m or rad", -INFINITY, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "upper end; default: none"),
    PARAM_NODE(struct range_keys, hold, "hold", "rigid, or a map", 0,
               "stops at the ends; default: none, leaving the range is reported"),
    KEYS_END,
};

const struct key keys_hold[] = {
    PARAM_REAL(struct scene_hold, restitution, "restitution", NULL, 0, 1, 0, NULL,
               "speed after an impact over that before; default 0, of compliant stops: they take nothing"),
    PARAM_REAL(struct scene_hold, k, "stiffness", "N/m^n or N m/rad^n", 0, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "makes the stops compliant: push per depth to the power of n; default: rigid"),
    PARAM_WORD(struct scene_hold, root, "exponent", "1|1.5", 0, NULL, "n, of compliant ones; default 1"),
    PARAM_REAL(struct scene_hold, c, "damping", "N s/m or N m s/rad", 0, INFINITY, KEY_BELOW, NULL,
               "compliant: push per rate while they push; they never pull; default 0"),
    PARAM_REAL(struct scene_hold, speed, "impact_speed", "m/s or rad/s", 0, INFINITY, KEY_ABOVE | KEY_BELOW, NULL,
               "compliant, in place of damping: the speed at which 'restitution' is what it is"),
    KEYS_END,
};
