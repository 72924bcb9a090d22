/* joint.c -- the table of joints: words, keys, names and units of their coordinates; see joint.h */
#include "kind/joint.h"

#include <math.h>
#include <string.h>

#define AT(flags, brief) PARAM_NODE(struct joint_keys, at, "at", "point", flags, brief)
#define AT_REQUIRED AT(KEY_REQUIRED, "the joint's point")
#define AT_CENTRE AT(0, "where the joint stands; default: the second body's centre of mass")
#define AXIS(flags, brief) PARAM_NODE(struct joint_keys, axis, "axis", "vector", flags, brief)
#define AXIS2(flags, brief) PARAM_NODE(struct joint_keys, axis2, "axis2", "vector", flags, brief)
#define RANGE(unit)                                                                                                    \
    PARAM_NODE(struct joint_keys, range, "range", "[lowest, highest] [" unit "]", 0,                                   \
               "where the coordinate should stay: leaving it is told, nothing holds it")
#define FRAME                                                                                                          \
    PARAM_WORD(struct joint_keys, frame, "frame", "world|joint", 0, "world",                                           \
               "axes of its reaction columns; joint: the joint's own, which go with the first body")
#define LOOP                                                                                                           \
    PARAM_BOOL(struct joint_keys, loop, "loop", 0, "false",                                                            \
               "keep it out of the tree: it closes a loop where the bodies are joined otherwise"),                     \
        FRAME

static const struct key keys_fixed[] = {AT_CENTRE, LOOP, KEYS_END};
static const struct key keys_revolute[] = {
    AT_REQUIRED, AXIS(KEY_REQUIRED | KEY_SPATIAL, "axis of rotation; in 2-D out of the plane"), RANGE("rad"), LOOP,
    KEYS_END};
static const struct key keys_prismatic[] = {AT_CENTRE, AXIS(KEY_REQUIRED, "direction of motion"), RANGE("m"), LOOP,
                                            KEYS_END};
static const struct key keys_cylindrical[] = {
    AT_REQUIRED, AXIS(KEY_REQUIRED | KEY_SPATIAL, "axis of rotation and displacement"), LOOP, KEYS_END};
static const struct key keys_universal[] = {
    AT_REQUIRED, AXIS(KEY_REQUIRED | KEY_SPATIAL, "first axis of rotation, fixed in the first body"),
    AXIS2(KEY_REQUIRED | KEY_SPATIAL, "second axis of rotation, fixed in the second body, at right angles"), LOOP,
    KEYS_END};
static const struct key keys_spherical[] = {AT_REQUIRED, LOOP, KEYS_END};
static const struct key keys_planar[] = {AT_CENTRE, AXIS(KEY_REQUIRED | KEY_SPATIAL, "normal of the plane of motion"),
                                         AXIS2(KEY_SPATIAL, "direction of the displacement x in the plane"), LOOP,
                                         KEYS_END};
static const struct key keys_free[] = {AT_CENTRE, LOOP, KEYS_END};
static const struct key keys_distance[] = {
    PARAM_REAL(struct joint_keys, length, "length", "m", 0, INFINITY, KEY_ABOVE, NULL,
               "distance of the two points; default: as drawn, from which it may differ a little only"),
    KEYS_END};
static const struct key keys_line[] = {
    AT(KEY_REQUIRED, "the point of the second body, which stands on the line when drawn"),
    AXIS(KEY_REQUIRED, "direction of the line, fixed in the first body"), FRAME, KEYS_END};
static const struct key keys_gear[] = {PARAM_REAL(struct joint_keys, ratio, "ratio", NULL, -INFINITY, INFINITY,
                                                  KEY_REQUIRED, NULL,
                                                  "second coordinate per first, both 0 when drawn; negative: they run "
                                                  "against each other; not 0"),
                                       KEYS_END};
static const struct key keys_rack[] = {
    PARAM_REAL(struct joint_keys, radius, "radius", "m", -INFINITY, INFINITY, KEY_REQUIRED, NULL,
               "displacement per radian, both 0 when drawn; negative: the other way; "
               "not 0"),
    KEYS_END};

/* Names of positions; rates and accelerations are named after them, of quaternions after omega. */
static const char *const q_angle[] = {"angle"};
static const char *const v_angle[] = {"angle_rate"};
static const char *const a_angle[] = {"angle_accel"};
static const char *const q_slide[] = {"displacement"};
static const char *const v_slide[] = {"displacement_rate"};
static const char *const a_slide[] = {"displacement_accel"};
static const char *const q_screw[] = {"angle", "displacement"};
static const char *const v_screw[] = {"angle_rate", "displacement_rate"};
static const char *const a_screw[] = {"angle_accel", "displacement_accel"};
static const char *const q_cross[] = {"angle1", "angle2"};
static const char *const v_cross[] = {"angle1_rate", "angle2_rate"};
static const char *const a_cross[] = {"angle1_accel", "angle2_accel"};
static const char *const q_plane[] = {"x", "y", "angle"};
static const char *const v_plane[] = {"x_rate", "y_rate", "angle_rate"};
static const char *const a_plane[] = {"x_accel", "y_accel", "angle_accel"};
static const char *const q_free[] = {"x", "y", "z", "qw", "qx", "qy", "qz"};
static const char *const v_free[] = {"x_rate", "y_rate", "z_rate", "omega_x", "omega_y", "omega_z"};
static const char *const a_free[] = {"x_accel", "y_accel", "z_accel", "omega_x_rate", "omega_y_rate", "omega_z_rate"};

/* Units: m of displacements, rad of angles; a spherical joint's tables are the tails of the free joint's. */
static const char *const u_rad[] = {"rad", "rad"};
static const char *const u_rad_s[] = {"rad/s", "rad/s"};
static const char *const u_rad_s2[] = {"rad/s2", "rad/s2"};
static const char *const u_screw[] = {"rad", "m"};
static const char *const u_screw_s[] = {"rad/s", "m/s"};
static const char *const u_screw_s2[] = {"rad/s2", "m/s2"};
static const char *const u_plane[] = {"m", "m", "rad"};
static const char *const u_plane_s[] = {"m/s", "m/s", "rad/s"};
static const char *const u_plane_s2[] = {"m/s2", "m/s2", "rad/s2"};
static const char *const u_free[] = {"m", "m", "m", "1", "1", "1", "1"};
static const char *const u_free_s[] = {"m/s", "m/s", "m/s", "rad/s", "rad/s", "rad/s"};
static const char *const u_free_s2[] = {"m/s2", "m/s2", "m/s2", "rad/s2", "rad/s2", "rad/s2"};

static const struct joint_kind joints[JOINT_WORDS] = {
    {JOINT_FIXED,
     "fixed",
     "holds two bodies together",
     keys_fixed,
     {0, 0},
     {0, 0},
     q_angle,
     u_rad,
     v_angle,
     u_rad_s,
     a_angle,
     u_rad_s2},
    {JOINT_REVOLUTE,
     "revolute",
     "rotation about one axis",
     keys_revolute,
     {1, 1},
     {1, 1},
     q_angle,
     u_rad,
     v_angle,
     u_rad_s,
     a_angle,
     u_rad_s2},
    {JOINT_PRISMATIC,
     "prismatic",
     "displacement along one axis",
     keys_prismatic,
     {1, 1},
     {1, 1},
     q_slide,
     u_plane,
     v_slide,
     u_plane_s,
     a_slide,
     u_plane_s2},
    {JOINT_CYLINDRICAL,
     "cylindrical",
     "rotation about and displacement along one axis",
     keys_cylindrical,
     {-1, 2},
     {-1, 2},
     q_screw,
     u_screw,
     v_screw,
     u_screw_s,
     a_screw,
     u_screw_s2},
    {JOINT_UNIVERSAL,
     "universal",
     "rotation about two crossing axes at right angles",
     keys_universal,
     {-1, 2},
     {-1, 2},
     q_cross,
     u_rad,
     v_cross,
     u_rad_s,
     a_cross,
     u_rad_s2},
    {JOINT_SPHERICAL,
     "spherical",
     "rotation about a point",
     keys_spherical,
     {-1, 4},
     {-1, 3},
     q_free + 3,
     u_free + 3,
     v_free + 3,
     u_free_s + 3,
     a_free + 3,
     u_free_s2 + 3},
    {JOINT_PLANAR,
     "planar",
     "motion in a plane",
     keys_planar,
     {3, 3},
     {3, 3},
     q_plane,
     u_plane,
     v_plane,
     u_plane_s,
     a_plane,
     u_plane_s2},
    {JOINT_FREE, "free", "any motion", keys_free, {3, 7}, {3, 6}, q_free, u_free, v_free, u_free_s, a_free, u_free_s2},
    {.type = JOINT_DISTANCE,
     .name = "distance",
     .brief = "a massless rod: two points, [point, point], keep their distance",
     .keys = keys_distance},
    {.type = JOINT_POINT_ON_LINE,
     .name = "point-on-line",
     .brief = "a point of the second body stays on a line of the first: a pin in a straight slot",
     .keys = keys_line},
    {.type = JOINT_GEAR,
     .name = "gear",
     .brief = "ties two coordinates, [first, second], both angles or both displacements: second = ratio * first; a "
              "joint with one coordinate can stand for it",
     .keys = keys_gear},
    {.type = JOINT_RACK,
     .name = "rack",
     .brief = "ties a displacement to an angle, [angle, displacement]: displacement = radius * angle; with both "
              "coordinates of one cylindrical joint a screw",
     .keys = keys_rack},
    {.type = JOINT_FIXED, .name = "weld", .brief = "another word for fixed", .keys = keys_fixed},
};

static const struct joint_kind free_in_plane = {JOINT_FREE, "free",  "any motion", keys_free, {3, 7},  {3, 6},
                                                q_plane,    u_plane, v_plane,      u_plane_s, a_plane, u_plane_s2};

const struct joint_kind *joint_kind(enum joint_type type, int space)
{
    if (type == JOINT_FREE && space == 0) return &free_in_plane;
    return joints[type].nq[space] < 0 ? NULL : &joints[type];
}

const struct joint_kind *joint_find(const char *name)
{
    for (int i = 0; i < JOINT_WORDS; i++)
        if (strcmp(joints[i].name, name) == 0) return &joints[i];
    return NULL;
}

const struct joint_kind *joint_kind_at(int i)
{
    return i >= 0 && i < JOINT_WORDS ? &joints[i] : NULL;
}
