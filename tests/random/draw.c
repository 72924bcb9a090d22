/* draw.c -- a mechanism from a seed.
 *
 * Bodies are put one after another on an earlier one or the ground, by a joint at a random place; loops are closed where
 * the joints on the way leave a freedom.  Masses go over four decades, so their ratios from 1e-4 to 1e4.  Stiffnesses are
 * such that the smaller of the masses they join vibrates at 3 to 100 rad/s. */
#include <math.h>
#include <string.h>

#include "mechanism.h"

/* ---- numbers --------------------------------------------------------------------------------- */

struct dice {
    uint64_t s;
};

static uint64_t throw(struct dice * o)
{
    uint64_t z = (o->s += 0x9e3779b97f4a7c15ULL); /* splitmix64 */

    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

static int choose(struct dice *o, int n)
{
    return (int)(throw(o) % (uint64_t)n);
}

static bool chance(struct dice *o, int percent)
{
    return choose(o, 100) < percent;
}

/* Three digits, so that decks can be read. */
static double between(struct dice *o, double a, double b)
{
    return round((a + (b - a) * (choose(o, 10001) / 10000.)) * 1000) / 1000;
}

static double decades(struct dice *o, double a, double b)
{
    double x = pow(10, a + (b - a) * (choose(o, 10001) / 10000.)), unit = pow(10, floor(log10(x)) - 2);
    return round(x / unit) * unit;
}

static struct vec add(struct vec a, double k, struct vec b)
{
    for (int i = 0; i < 3; i++) a.x[i] += k * b.x[i];
    return a;
}

static double dot(struct vec a, struct vec b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static struct vec cross(struct vec a, struct vec b)
{
    return (struct vec){
        {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

/* Between 0.3 and 1 long, in the plane where there is one. */
static struct vec some_way(struct dice *o, int dim)
{
    for (;;) {
        struct vec v = {{between(o, -1, 1), between(o, -1, 1), dim == 3 ? between(o, -1, 1) : 0}};
        double d = sqrt(dot(v, v));
        if (d > 0.3 && d < 1) return v;
    }
}

static struct vec square_to(struct dice *o, struct vec axis)
{
    for (;;) {
        struct vec v = cross(axis, some_way(o, 3));
        if (dot(v, v) > 0.05 * dot(axis, axis)) return v;
    }
}

/* ---- bodies ---------------------------------------------------------------------------------- */

static void draw_rigid(struct body *o, struct dice *dice, int dim)
{
    double m = o->mass, l = between(dice, 0.1, 0.4), r[3];

    o->quat[0] = dim == 2 ? between(dice, -3, 3) : 1;
    if (dim == 3 && chance(dice, 60)) {
        double n = 0;
        for (int i = 0; i < 4; i++) {
            o->quat[i] = between(dice, 0.1, 1);
            n += o->quat[i] * o->quat[i];
        }
        for (int i = 0; i < 4; i++) o->quat[i] /= sqrt(n);
    }
    for (int i = 0; i < 3; i++) r[i] = m * l * l * between(dice, 0.2, 1); /* of the second moments */
    for (int i = 0; i < 3; i++) o->inertia[i] = r[(i + 1) % 3] + r[(i + 2) % 3];
    o->point = some_way(dice, dim);
}

/* As soft as bodies of fmdsub may be bent: its first frequency is some 10 rad/s, its stretch 100. */
static void draw_beam(struct body *o, struct dice *dice, int dim, struct vec from)
{
    struct vec way = some_way(dice, dim);
    double length = sqrt(dot(way, way)), speed = length * decades(dice, 2, 2.4);

    o->beam = true;
    o->from = from;
    o->to = add(from, 1, way);
    o->at = add(from, 0.5, way);
    o->up = dim == 3 ? square_to(dice, way) : (struct vec){{0, 0, 0}};
    o->height = 0.1 * length;
    o->width = 0.12 * length;
    o->density = o->mass / (o->width * o->height * length);
    o->E = o->density * speed * speed;
    o->beta = chance(dice, 50) ? 0 : between(dice, 0.1, 2) * 1e-3;
    o->modes = 1 + choose(dice, 3);
}

/* ---- joints ---------------------------------------------------------------------------------- */

static const int freedoms_2[JOINT_KINDS] = {[REVOLUTE] = 1, [PRISMATIC] = 1, [PLANAR] = 3, [FREE] = 3};
static const int freedoms_3[JOINT_KINDS] = {[REVOLUTE] = 1,  [PRISMATIC] = 1, [CYLINDRICAL] = 2, [SCREW] = 1,
                                            [UNIVERSAL] = 2, [SPHERICAL] = 3, [PLANAR] = 3,      [FREE] = 6};

static int freedoms(const struct mechanism *o, int j)
{
    return (o->dim == 2 ? freedoms_2 : freedoms_3)[o->joint[j].kind];
}

static enum joint_kind some_kind(struct dice *dice, int dim)
{
    static const enum joint_kind plane[] = {REVOLUTE,  REVOLUTE,  REVOLUTE, REVOLUTE, REVOLUTE,
                                            PRISMATIC, PRISMATIC, PLANAR,   FREE,     FIXED};
    static const enum joint_kind space[] = {REVOLUTE,    REVOLUTE, REVOLUTE, PRISMATIC, PRISMATIC, CYLINDRICAL,
                                            CYLINDRICAL, SCREW,    SCREW,    UNIVERSAL, UNIVERSAL, SPHERICAL,
                                            SPHERICAL,   PLANAR,   FREE,     FIXED};
    return dim == 2 ? plane[choose(dice, 10)] : space[choose(dice, 16)];
}

static void draw_directions(struct joint *o, struct dice *dice, int dim)
{
    o->axis = some_way(dice, dim);
    o->axis2 = dim == 3 ? square_to(dice, o->axis) : o->axis;
    o->pitch = between(dice, 0.1, 0.6) * (chance(dice, 50) ? 1 : -1);
}

/* Body i on an earlier one or the ground. */
static void hang(struct mechanism *o, struct dice *dice, int i)
{
    struct body *b = &o->body[i];
    struct joint *j = &o->joint[o->njoint++];
    int on = i == 0 || chance(dice, 20) ? -1 : i - 1 - (chance(dice, 70) ? 0 : choose(dice, i));
    struct vec root = on < 0 ? some_way(dice, o->dim) : o->body[on].at;

    /* a beam carries no more than itself: it is to bend by little */
    b->mass = on >= 0 && o->body[on].beam ? o->body[on].mass * decades(dice, -1, 0) : decades(dice, -2, 2);
    j->kind = some_kind(dice, o->dim);
    if (on >= 0 && j->kind == FREE && chance(dice, 50)) on = -1;
    j->a = on, j->b = i;
    j->swapped = chance(dice, 20);
    j->at = on >= 0 && o->body[on].beam ? o->body[on].to : add(root, 0.5, some_way(dice, o->dim));
    draw_directions(j, dice, o->dim);
    if (chance(dice, 12) && o->nflex < 2 && j->kind != FREE) {
        draw_beam(b, dice, o->dim, j->at);
        o->nflex++;
        return;
    }
    b->at = add(j->at, 0.7, some_way(dice, o->dim));
    draw_rigid(b, dice, o->dim);
}

/* ---- loops ----------------------------------------------------------------------------------- */

static int equations_of(enum joint_kind kind, int dim)
{
    if (kind == DISTANCE || kind == GEAR || kind == RACK) return 1;
    if (kind == ON_LINE) return dim - 1;
    return (dim == 2 ? 3 : 6) - (dim == 2 ? freedoms_2 : freedoms_3)[kind];
}

static int depth_of(const struct mechanism *o, int body)
{
    int n = 0;
    for (; body >= 0; body = o->joint[body].a) n++; /* joint i carries body i */
    return n;
}

/* The joints on the way from a to b; returns their freedoms. */
static int way(bool *on, const struct mechanism *o, int a, int b)
{
    int n = 0;

    memset(on, 0, JOINTS * sizeof *on);
    while (a != b) {
        int *deeper = depth_of(o, a) >= depth_of(o, b) ? &a : &b;
        n += freedoms(o, *deeper);
        on[*deeper] = true;
        *deeper = o->joint[*deeper].a;
    }
    return n;
}

/* Each loop has joints of its own, so that no two hold each other fast. */
static void close_loop(struct mechanism *o, struct dice *dice)
{
    static const enum joint_kind plane[] = {REVOLUTE, REVOLUTE, PRISMATIC, DISTANCE, DISTANCE, ON_LINE};
    static const enum joint_kind space[] = {SPHERICAL, SPHERICAL, UNIVERSAL,   REVOLUTE, DISTANCE,
                                            DISTANCE,  ON_LINE,   CYLINDRICAL, PLANAR,   SCREW};
    bool on[JOINTS];
    int b = choose(dice, o->nbody), a = choose(dice, o->nbody + 1) - 1;
    struct joint j = {
        .kind = o->dim == 2 ? plane[choose(dice, 6)] : space[choose(dice, 10)], .a = a, .b = b, .closes = true};

    draw_directions(&j, dice, o->dim);
    j.at = add(o->body[b].at, 0.6, some_way(dice, o->dim));
    if (a == b || o->njoint == JOINTS || o->body[b].beam || (a >= 0 && o->body[a].beam)) return;
    if (way(on, o, a, b) < equations_of(j.kind, o->dim) + 1) return;
    for (int i = 0; i < o->nbody; i++)
        if (on[i] && (o->joint[i].in_loop || o->body[i].beam)) return;
    j.alone = way(on, o, a, b) == equations_of(j.kind, o->dim) + 1;
    for (int i = 0; i < o->nbody; i++) {
        o->joint[i].in_loop |= on[i];
        o->joint[i].alone |= on[i] && j.alone;
    }
    o->joint[o->njoint++] = j;
    o->nloop++;
}

static bool is_angle(const struct joint *o)
{
    return o->kind == REVOLUTE || o->kind == SCREW;
}

static bool is_scalar(const struct joint *o)
{
    return !o->closes && (is_angle(o) || o->kind == PRISMATIC);
}

/* A gear or a rack between two joints that are in no loop yet. */
static void gear(struct mechanism *o, struct dice *dice)
{
    int a = choose(dice, o->nbody), b = choose(dice, o->nbody);
    struct joint *first = &o->joint[a], *second = &o->joint[b];

    if (a == b || o->njoint == JOINTS || !is_scalar(first) || !is_scalar(second) || first->in_loop || second->in_loop)
        return;
    if (!is_angle(first) && is_angle(second)) return;
    o->joint[o->njoint++] = (struct joint){.kind = is_angle(first) == is_angle(second) ? GEAR : RACK,
                                           .a = a,
                                           .b = b,
                                           .closes = true,
                                           .pitch = between(dice, 0.5, 1.5) * (chance(dice, 50) ? 1 : -1)};
    first->in_loop = second->in_loop = true;
    o->nloop++;
}

/* ---- forces ---------------------------------------------------------------------------------- */

static double mass_of(const struct mechanism *o, int body)
{
    return body < 0 ? 1e9 : o->body[body].mass;
}

static double smaller(const struct mechanism *o, int a, int b)
{
    return fmin(mass_of(o, a), mass_of(o, b));
}

static const char *scalar_of(const struct joint *o)
{
    return is_angle(o) ? "angle" : "displacement";
}

/* Along the coordinate of joint i: spring, damper, or an expression of it. */
static void along(struct mechanism *o, struct dice *dice, int i)
{
    const struct joint *j = &o->joint[i];
    double m = smaller(o, j->a, j->b) * (is_angle(j) ? 0.1 : 1), w = decades(dice, 0.5, 2), k = m * w * w;
    char *s = o->force[o->nforce++].text;
    const char *c = scalar_of(j), *verb = j->kind == PRISMATIC ? "force" : "torque";

    switch (choose(dice, 6)) {
    case 0:
    case 1:
        snprintf(s, TEXT, "{spring: $j%d, stiffness: %g, damping: %g, cubic: %g}", i, k, m * w * between(dice, 0, 0.3),
                 chance(dice, 50) ? 0 : k * between(dice, 0, 5));
        break;
    case 2:
        snprintf(s, TEXT, "{damper: $j%d, damping: %g}", i, m * between(dice, 0.1, 10));
        break;
    case 3:
        snprintf(s, TEXT, "{%s: $j%d, value: \"-%g*sin($j%d.%s) - %g*$j%d.%s_rate\"}", verb, i, k, i, c,
                 m * between(dice, 0, 5), i, c);
        break;
    case 4:
        snprintf(s, TEXT, "{%s: $j%d, value: \"%g*cos(%g*t) - %g*tanh($j%d.%s)\"}", verb, i, m * between(dice, 1, 20),
                 between(dice, 1, 20), k, i, c);
        break;
    default:
        snprintf(s, TEXT, "{curve: $j%d, table: [[-1, %g], [-0.2, %g], [0, 0], [0.3, %g]]}", i, -k, -0.1 * k, 0.5 * k);
        o->rough = true;
    }
}

/* Between the points of two bodies: a spring on their distance, or on a measure of it. */
static void across(struct mechanism *o, struct dice *dice)
{
    int a = choose(dice, o->nbody), b = choose(dice, o->nbody);
    double m = smaller(o, a, b), w = decades(dice, 0.5, 1.7), k = m * w * w;
    char *s;

    if (a == b || o->body[a].beam || o->body[b].beam) return;
    s = o->force[o->nforce++].text;
    if (chance(dice, 50)) {
        snprintf(s, TEXT, "{spring: [$b%d.p, $b%d], stiffness: %g, damping: %g, preload: %g}", a, b, k,
                 m * w * between(dice, 0, 0.3), m * between(dice, -2, 2));
        return;
    }
    snprintf(o->measure[o->nmeasure], TEXT, "{distance: [$b%d.p, $b%d.p]}", a, b);
    snprintf(s, TEXT, "{force: $m%d, value: \"-%g*log(0.1 + $m%d) - %g*$m%d_rate\"}", o->nmeasure, 0.3 * k, o->nmeasure,
             m * between(dice, 0, 3), o->nmeasure);
    o->nmeasure++;
}

static void load(struct mechanism *o, struct dice *dice)
{
    struct force *f = &o->force[o->nforce++];

    *f = (struct force){
        .kind = LOAD, .body = choose(dice, o->nbody), .torque = chance(dice, 40), .in_body = chance(dice, 50)};
    double m = o->body[f->body].mass * (f->torque ? 0.1 : 1);
    f->axis = f->torque && o->dim == 2 ? (struct vec){{0, 0, 1}} : some_way(dice, o->dim);
    snprintf(f->text, TEXT, "%g*sin(%g*t + %g)", m * between(dice, 1, 20), between(dice, 1, 20), between(dice, 0, 3));
}

static void bushing(struct mechanism *o, struct dice *dice)
{
    int b = choose(dice, o->nbody), a = choose(dice, o->nbody + 1) - 1;

    if (a == b) return;
    struct force *f = &o->force[o->nforce++];
    double m = smaller(o, a, b), w = decades(dice, 0.5, 1.7), k = m * w * w, kz = k * between(dice, 0.5, 2);
    double kr = 0.1 * k, krz = chance(dice, 50) ? 0 : kr, c = m * w * between(dice, 0, 0.2);
    static const char *const axes[] = {"first", "second", "middle"};

    *f = (struct force){.kind = BUSHING, .body = a, .other = b, .axis = some_way(dice, o->dim)};
    f->at = add(o->body[b].at, 0.3, some_way(dice, o->dim));
    if (o->dim == 2)
        snprintf(f->text, TEXT, "stiffness: [%g, %g], rotation: %g, damping: [%g, %g], axes: %s", k, kz, kr, c, c,
                 axes[choose(dice, 3)]);
    else
        snprintf(f->text, TEXT, "stiffness: [%g, %g, %g], rotation: [%g, %g, %g], damping: [%g, %g, %g], axes: %s", k,
                 k, kz, kr, kr, krz, c, c, c, axes[choose(dice, 3)]);
}

static void draw_forces(struct mechanism *o, struct dice *dice)
{
    for (int i = 0; i < o->nbody; i++)
        if (is_scalar(&o->joint[i]) && o->nforce < FORCES && chance(dice, 60)) along(o, dice, i);
    for (int i = choose(dice, 4); i > 0 && o->nforce < FORCES; i--) {
        int what = choose(dice, 10);
        if (what < 4)
            across(o, dice);
        else if (what < 7)
            load(o, dice);
        else
            bushing(o, dice);
    }
}

/* ---- start, drive, partition ----------------------------------------------------------------- */

/* A loop is given a rate only where it has one freedom: else its motion would hang on the choice of coordinates. */
static void draw_start(struct mechanism *o, struct dice *dice)
{
    bool told = false;

    for (int i = 0; i < o->nbody; i++) {
        const struct joint *j = &o->joint[i];
        double rate = between(dice, -3, 3), place = between(dice, -0.6, 0.6);
        if (j->driven || chance(dice, 30)) continue;
        if (is_scalar(j) && (!j->in_loop || (j->alone && !told))) {
            o->has_initial[i] = true;
            if (j->in_loop)
                snprintf(o->initial[i], TEXT, "$j%d.%s_rate: %g", i, scalar_of(j), rate);
            else
                snprintf(o->initial[i], TEXT, "$j%d.%s: %g, $j%d.%s_rate: %g", i, scalar_of(j), place, i, scalar_of(j),
                         rate);
            told |= j->in_loop;
        } else if ((j->kind == SPHERICAL || (j->kind == FREE && o->dim == 3)) && !j->in_loop) {
            o->has_initial[i] = true;
            snprintf(o->initial[i], TEXT, "$j%d.omega: {value: [%g, %g, %g], frame: body}", i, rate, place * 4,
                     between(dice, -3, 3));
        }
        if (j->kind == FREE && !j->in_loop) {
            o->has_slide[i] = true;
            o->slide[i] = some_way(dice, o->dim);
        }
    }
}

static void draw_drive(struct mechanism *o, struct dice *dice)
{
    int i = choose(dice, o->nbody);
    struct joint *j = &o->joint[i];

    if (!chance(dice, 25) || !is_scalar(j) || j->in_loop) return;
    j->driven = true;
    snprintf(o->drive, TEXT,
             chance(dice, 50) ? "{drive: $j%d, value: \"%g*sin(%g*t)\"}"
                              : "{drive: $j%d, value: \"%g*(1 - cos(%g*t))\"}",
             i, between(dice, 0.05, 0.6), between(dice, 1, 12));
}

static void draw_partition(struct mechanism *o, struct dice *dice)
{
    static const int ratios[] = {1, 2, 3, 4, 5, 8, 10};
    size_t n = 0;

    for (int i = 0; i < o->nbody; i++) {
        const struct joint *j = &o->joint[i];
        if (freedoms(o, i) > 0 && !j->driven && chance(dice, 35))
            n += (size_t)snprintf(o->fast + n, sizeof o->fast - n, "%s$j%d", n ? ", " : "", i);
        if (o->body[i].beam && chance(dice, 60))
            n += (size_t)snprintf(o->fast + n, sizeof o->fast - n, "%s$b%d", n ? ", " : "", i);
    }
    o->ratio = ratios[choose(dice, 7)];
}

void mechanism_draw(struct mechanism *o, uint64_t seed)
{
    struct dice dice = {seed * 0x2545f4914f6cdd1dULL};

    *o = (struct mechanism){.seed = seed, .dim = chance(&dice, 50) ? 2 : 3, .until = 0.5};
    o->nbody = 1 + choose(&dice, 6);
    for (int i = 0; i < o->nbody; i++) hang(o, &dice, i);
    int loops = chance(&dice, 50) ? 1 + choose(&dice, 2) : 0;
    for (int i = 0; i < 12 && o->nloop < loops; i++) close_loop(o, &dice);
    if (chance(&dice, 15)) gear(o, &dice);
    if (chance(&dice, 70)) o->gravity = o->dim == 2 ? (struct vec){{0, -9.81, 0}} : (struct vec){{0, 0, -9.81}};
    draw_drive(o, &dice);
    draw_forces(o, &dice);
    draw_start(o, &dice);
    draw_partition(o, &dice);
}
