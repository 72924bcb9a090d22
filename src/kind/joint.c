/* joint.c -- the table of joints: words, keys, freedoms; and what follows from these; see joint.h */
#include "kind/joint.h"

#include <math.h>
#include <string.h>

#define AT(flags, brief) PARAM_NODE(struct joint_keys, at, "at", "point", flags, brief)
#define AT_REQUIRED AT(KEY_REQUIRED, "the joint's point")
#define AT_CENTRE AT(0, "where the joint stands; default: the second body's centre of mass")
#define AXIS(flags, brief) PARAM_NODE(struct joint_keys, axis, "axis", "vector", flags, brief)
#define AXIS2(flags, brief) PARAM_NODE(struct joint_keys, axis2, "axis2", "vector", flags, brief)
#define RANGE(unit)                                                                                                    \
    PARAM_NODE(struct joint_keys, range, "range", "[lowest, highest] [" unit "], or a map", 0,                         \
               "where the coordinate should stay: leaving it is reported; what holds it there is a map's 'hold'")
#define FRICTION(words)                                                                                                \
    PARAM_NODE(struct joint_keys, friction, "friction", words, 0, "Coulomb's friction in the joint; default: none")
#define FRAME                                                                                                          \
    PARAM_WORD(struct joint_keys, frame, "frame", "world|joint", 0, "world",                                           \
               "axes of its reaction columns; joint: the joint's own, which go with the first body")
#define LOOP                                                                                                           \
    PARAM_BOOL(struct joint_keys, loop, "loop", 0, "false",                                                            \
               "keep it out of the tree: it closes a loop where the bodies are joined otherwise"),                     \
        FRAME

static const struct key keys_fixed[] = {AT_CENTRE, LOOP, KEYS_END};
static const struct key keys_revolute[] = {
    AT_REQUIRED,  AXIS(KEY_REQUIRED | KEY_SPATIAL, "axis of rotation; in 2-D out of the plane"),
    RANGE("rad"), FRICTION("a map"),
    LOOP,         KEYS_END};
static const struct key keys_prismatic[] = {
    AT_CENTRE, AXIS(KEY_REQUIRED, "direction of motion"), RANGE("m"), FRICTION("number, or a map"), LOOP, KEYS_END};
static const struct key keys_cylindrical[] = {
    AT_REQUIRED, AXIS(KEY_REQUIRED | KEY_SPATIAL, "axis of rotation and displacement"), LOOP, KEYS_END};
static const struct key keys_screw[] = {
    PARAM_REAL(struct joint_keys, number, "pitch", "m", -INFINITY, INFINITY, KEY_REQUIRED, NULL,
               "displacement along the axis for each whole turn; negative: a left-handed thread"),
    AT_REQUIRED,
    AXIS(KEY_REQUIRED | KEY_SPATIAL, "axis of rotation and displacement"),
    RANGE("rad"),
    LOOP,
    KEYS_END};
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
    PARAM_REAL(struct joint_keys, number, "length", "m", 0, INFINITY, KEY_ABOVE, NULL,
               "distance of the two points; default: as drawn, from which it may differ a little only"),
    KEYS_END};
static const struct key keys_line[] = {
    AT(KEY_REQUIRED, "the point of the second body, which stands on the line when drawn"),
    AXIS(KEY_REQUIRED, "direction of the line, fixed in the first body"), FRAME, KEYS_END};
static const struct key keys_gear[] = {PARAM_REAL(struct joint_keys, number, "ratio", NULL, -INFINITY, INFINITY,
                                                  KEY_REQUIRED, NULL,
                                                  "second coordinate per first, both 0 when drawn; negative: they run "
                                                  "against each other; not 0"),
                                       KEYS_END};
static const struct key keys_rack[] = {
    PARAM_REAL(struct joint_keys, number, "radius", "m", -INFINITY, INFINITY, KEY_REQUIRED, NULL,
               "displacement per radian, both 0 when drawn; negative: the other way; "
               "not 0"),
    KEYS_END};

/* ---- the table ---- */

#define NAMES(word) .q = word, .v = word "_rate", .a = word "_accel"
#define TURN(axis_, word) .axis = axis_, .turns = true, NAMES(word)
#define SLIDE(axis_, word) .axis = axis_, .slides = true, NAMES(word)
#define BALL(axis_, x)                                                                                                 \
    .axis = axis_, .turns = true, .second = true, .ball = true, .q = "q" x, .v = "omega_" x, .a = "omega_" x "_rate"

enum { X, Y, Z };

/* Two have fewer freedoms in the plane. */
#define FREE .type = JOINT_FREE, .name = "free", .brief = "any motion", .keys = keys_free
#define LINE                                                                                                           \
    .type = JOINT_POINT_ON_LINE, .name = "point-on-line",                                                              \
    .brief = "a point of the second body stays on a line of the first: a pin in a straight slot", .keys = keys_line,   \
    .tie = TIE_BODIES
static const struct joint_kind joints[JOINT_WORDS] = {
    {.type = JOINT_FIXED, .name = "fixed", .brief = "holds two bodies together", .keys = keys_fixed},
    {.type = JOINT_REVOLUTE,
     .name = "revolute",
     .brief = "rotation about one axis",
     .keys = keys_revolute,
     .freedom = {{TURN(Z, "angle")}}},
    {.type = JOINT_PRISMATIC,
     .name = "prismatic",
     .brief = "displacement along one axis",
     .keys = keys_prismatic,
     .freedom = {{SLIDE(Z, "displacement")}}},
    {.type = JOINT_CYLINDRICAL,
     .name = "cylindrical",
     .brief = "rotation about and displacement along one axis",
     .keys = keys_cylindrical,
     .spatial = true,
     .freedom = {{TURN(Z, "angle")}, {SLIDE(Z, "displacement")}}},
    {.type = JOINT_SCREW,
     .name = "screw",
     .brief = "rotation about one axis with displacement along it: displacement = pitch * angle / (2 pi)",
     .keys = keys_screw,
     .spatial = true,
     .freedom = {{TURN(Z, "angle"), .slides = true}}},
    {.type = JOINT_UNIVERSAL,
     .name = "universal",
     .brief = "rotation about two crossing axes at right angles",
     .keys = keys_universal,
     .spatial = true,
     .freedom = {{TURN(X, "angle1")}, {TURN(Y, "angle2"), .second = true}}},
    {.type = JOINT_SPHERICAL,
     .name = "spherical",
     .brief = "rotation about a point",
     .keys = keys_spherical,
     .spatial = true,
     .freedom = {{BALL(X, "x")}, {BALL(Y, "y")}, {BALL(Z, "z")}}},
    {.type = JOINT_PLANAR,
     .name = "planar",
     .brief = "motion in a plane",
     .keys = keys_planar,
     .freedom = {{SLIDE(X, "x")}, {SLIDE(Y, "y")}, {TURN(Z, "angle")}}},
    {FREE,
     .freedom = {{SLIDE(X, "x")}, {SLIDE(Y, "y")}, {SLIDE(Z, "z")}, {BALL(X, "x")}, {BALL(Y, "y")}, {BALL(Z, "z")}}},
    {.type = JOINT_DISTANCE,
     .name = "distance",
     .brief = "a massless rod: two points, [point, point], keep their distance",
     .keys = keys_distance,
     .tie = TIE_POINTS},
    {LINE, .freedom = {{SLIDE(Z, "")}, {BALL(X, "")}, {BALL(Y, "")}, {BALL(Z, "")}}},
    {.type = JOINT_GEAR,
     .name = "gear",
     .brief = "ties two coordinates, [first, second], both angles or both displacements: second = ratio * first; a "
              "joint with one coordinate can stand for it",
     .keys = keys_gear,
     .tie = TIE_COORDINATES,
     .end = {END_LIKE_OTHER, END_LIKE_OTHER},
     .hint = "use 'rack: [angle, displacement]' with a 'radius'"},
    {.type = JOINT_RACK,
     .name = "rack",
     .brief = "ties a displacement to an angle, [angle, displacement]: displacement = radius * angle; with both "
              "coordinates of one cylindrical joint a screw",
     .keys = keys_rack,
     .tie = TIE_COORDINATES,
     .end = {END_ANGLE, END_DISPLACEMENT},
     .hint = "the angle comes first, then the displacement; two of one sort make a 'gear'"},
    {.type = JOINT_FIXED, .name = "weld", .brief = "another word for fixed", .keys = keys_fixed},
};

static const struct joint_kind in_plane[] = {
    {FREE, .freedom = {{SLIDE(X, "x")}, {SLIDE(Y, "y")}, {TURN(Z, "angle")}}},
    {LINE, .freedom = {{SLIDE(Z, "")}, {TURN(Y, "")}}},
};

const struct joint_kind *joint_kind(enum joint_type type, int space)
{
    for (size_t i = 0; space == 0 && i < sizeof in_plane / sizeof *in_plane; i++)
        if (in_plane[i].type == type) return &in_plane[i];
    return space == 0 && joints[type].spatial ? NULL : &joints[type];
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

/* ---- what follows from them ---- */

static bool is_freedom(const struct freedom *f)
{
    return f->turns || f->slides;
}

enum joint_turning joint_turning(const struct joint_kind *j, int *first)
{
    const struct freedom *f = j->freedom;
    while (is_freedom(f) && !f->turns) f++;
    if (first) *first = (int)(f - j->freedom);
    if (!f->turns) return TURNS_NEVER;
    return f->ball ? TURNS_FREELY : f[1].turns ? TURNS_CROSSED : TURNS_ABOUT_ONE;
}

const struct freedom *joint_slide(const struct joint_kind *j, int axis)
{
    for (const struct freedom *f = j->freedom; is_freedom(f); f++)
        if (f->slides && f->axis == axis) return f;
    return NULL;
}

double joint_along(const struct freedom *f, double number)
{
    static const double WHOLE_TURN = 6.283185307179586;
    return !f->slides ? 0 : f->turns ? number / WHOLE_TURN : 1;
}

bool joint_is_fixed(const struct joint_kind *j)
{
    return !joint_is_tie(j) && !is_freedom(j->freedom);
}

bool joint_has_one_axis(const struct joint_kind *j)
{
    const struct freedom *f = j->freedom;
    while (is_freedom(f) && !f->ball && f->axis == j->freedom->axis) f++;
    return is_freedom(j->freedom) && !is_freedom(f);
}

/* The number of a ball's first position and first rate; behind all if there is none. */
static int ball_at(const struct joint_kind *j)
{
    const struct freedom *f = j->freedom;
    while (is_freedom(f) && !f->ball) f++;
    return (int)(f - j->freedom);
}

int joint_size(const struct joint_kind *j, int order)
{
    int n = 0;
    if (joint_is_tie(j)) return 0;
    while (is_freedom(&j->freedom[n])) n++;
    return order == 0 && ball_at(j) < n ? n + 1 : n;
}

const char *joint_name(const struct joint_kind *j, int order, int k)
{
    const int ball = ball_at(j);
    if (order == 0 && k == ball) return "qw";
    const struct freedom *f = &j->freedom[order == 0 && k > ball ? k - 1 : k];
    return order == 0 ? f->q : order == 1 ? f->v : f->a;
}

const char *joint_unit(const struct joint_kind *j, int order, int k)
{
    static const char *const angle[] = {"rad", "rad/s", "rad/s2"}, *const length[] = {"m", "m/s", "m/s2"};
    if (order == 0 && k >= ball_at(j)) return "1";
    return j->freedom[k].turns ? angle[order] : length[order];
}
