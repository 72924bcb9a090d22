/* flat.c -- see flat.h */
#include "model/flat.h"

#include <math.h>
#include <string.h>

#include "flex/parity.h"
#include "la/vec3.h"
#include "model/flat_parts.h"

static const double PARALLEL = 1e-12;

static bool spatial(struct flattening *o, const char *name, const char *why)
{
    *o->why = (struct model_spatial){name, why};
    return false;
}

/* ---- the normal ---- */

static bool along(const double *axis, const double *normal)
{
    double across[3];
    v3_cross(across, axis, normal);
    return v3_norm(across) <= PARALLEL;
}

static bool across(const double *axis, const double *normal)
{
    return fabs(v3_dot(axis, normal)) <= PARALLEL;
}

/* z of a joint's axes, world. */
static void joint_axis(double *axis, const struct model *m, const struct model_joint *j)
{
    m3_mul(axis, m->body[j->parent].R, j->Ea + 6);
}

static bool keeps(const struct model *m, const struct model_joint *j, const double *normal)
{
    double axis[3];
    joint_axis(axis, m, j);
    if (j->type == JOINT_REVOLUTE || j->type == JOINT_PLANAR) return along(axis, normal);
    return j->type == JOINT_FIXED || (j->type == JOINT_PRISMATIC && across(axis, normal));
}

static bool all_keep(struct flattening *o, const double *normal)
{
    const struct model *m = o->full;
    for (int i = 0; i < m->njoint; i++)
        if (!keeps(m, &m->joint[i], normal)) return spatial(o, m->joint[i].name, "lets its bodies out of the plane");
    return true;
}

/* That of the first joint that has one; of slides alone one of the world's axes. */
static bool find_normal(double *normal, struct flattening *o)
{
    const struct model *m = o->full;
    for (int i = 0; i < m->njoint; i++) {
        const enum joint_type type = m->joint[i].type;
        if (type == JOINT_FIXED || type == JOINT_PRISMATIC) continue;
        joint_axis(normal, m, &m->joint[i]);
        return all_keep(o, normal);
    }
    for (int k = 2; k >= 0; k--) {
        v3_set(normal, k == 0, k == 1, k == 2);
        if (all_keep(o, normal)) return true;
    }
    return false;
}

/* Of a normal along an axis of the world the plane's axes are the others, so that components of loads are theirs. */
static void lay(double *P, const double *normal)
{
    double *x = P, *y = P + 3, *z = P + 6;
    for (int k = 0; k < 3; k++) {
        double e[3] = {k == 0, k == 1, k == 2};
        if (!along(normal, e)) continue;
        v3_copy(z, e);
        v3_set(x, k == 2, k == 0, k == 1);
        v3_set(y, k == 1, k == 2, k == 0);
        return;
    }
    const double *up = fabs(normal[2]) < .9 ? (const double[]){0, 0, 1} : (const double[]){1, 0, 0};
    v3_copy(z, normal);
    v3_cross(x, up, z);
    v3_scale(x, 1 / v3_norm(x), x);
    v3_cross(y, z, x);
}

/* ---- places ---- */

/* Without its part along the normal, which stands still. */
static void press(double *x)
{
    x[2] = 0;
}

static void place(double *x, const struct flattening *o, int body, const double *p)
{
    double turned[3];
    m3_mul(turned, o->T[body], p);
    v3_copy(x, turned);
    press(x);
}

static void turn_axes(double *E, const struct flattening *o, int body)
{
    double turned[9];
    m3_mulm(turned, o->T[body], E);
    memcpy(E, turned, sizeof turned);
}

double flat_height(const struct flattening *o, int body, const double *p)
{
    double x[3];
    m3_mul(x, o->full->body[body].R, p);
    v3_add(x, o->full->body[body].at);
    return v3_dot(x, o->P + 6);
}

bool flat_level(const struct flattening *o, double a, double b)
{
    return fabs(a - b) <= PARALLEL * o->size;
}

static bool level(const struct flattening *o, const struct model_point *a, const struct model_point *b)
{
    return flat_level(o, flat_height(o, a->body, a->p), flat_height(o, b->body, b->p));
}

static void move_point(struct model_point *x, const struct flattening *o)
{
    place(x->p, o, x->body, x->p);
}

/* ---- bodies and joints ---- */

/* The flexible body's data in the plane's axes; its modes out of the plane are gone, see model/mirror.h. */
static bool flatten_bent(struct model_body *b, struct flattening *o, int i)
{
    bool *odd = TAKE(o->life, bool, b->nmode);
    if (o->bent || !b->flex) return true;
    struct flex_body *flex = flex_in_axes(b->flex, o->T[i], o->life);
    bool plane = flex_parity(odd, flex) && flex_is_plane(flex);
    for (int k = 0; k < b->nmode; k++) plane = plane && !odd[k];
    if (!plane) return spatial(o, b->name, "bends out of the plane");
    flex->affine = true;
    b->flex = flex;
    return true;
}

static bool flatten_bodies(struct flattening *o)
{
    const struct model *m = o->full;
    struct model_body *body = TAKE(o->life, struct model_body, m->nbody);
    memcpy(body, m->body, sizeof *body * (size_t)m->nbody);
    for (int i = 0; i < m->nbody; i++) {
        double at[3], inertia[6];
        m3_tmulm(o->T[i], o->P, body[i].R);
        if (!flatten_bent(&body[i], o, i)) return false;
        m3_tmul(at, o->P, body[i].at);
        v3_copy(body[i].at, at);
        press(body[i].at);
        m3_unit(body[i].R);
        s3_turn(inertia, o->T[i], body[i].inertia);
        memcpy(body[i].inertia, inertia, sizeof inertia);
        body[i].held = NULL; /* turns about the normal are no idle ones, see sim */
    }
    o->plane->body = body;
    return true;
}

static void flatten_joints(struct flattening *o)
{
    const struct model *m = o->full;
    struct model_joint *joint = TAKE(o->life, struct model_joint, m->njoint);
    memcpy(joint, m->joint, sizeof *joint * (size_t)m->njoint);
    for (int i = 0; i < m->njoint; i++) {
        struct model_joint *j = &joint[i];
        place(j->a, o, j->parent, j->a);
        place(j->b, o, j->child, j->b);
        turn_axes(j->Ea, o, j->parent);
        turn_axes(j->Eb, o, j->child);
        j->own = NULL;
    }
    o->plane->joint = joint;
}

/* What it holds in the plane; false: nothing, or more than motion in it. */
static bool flatten_type(struct model_loop *l, const struct flattening *o)
{
    double axis[3];
    m3_mul(axis, o->full->body[l->first].R, l->Ea + 6);
    const enum joint_type type = l->type;
    if (type == JOINT_FIXED || type == JOINT_DISTANCE || type == JOINT_GEAR || type == JOINT_RACK) return true;
    if (type == JOINT_PRISMATIC || type == JOINT_POINT_ON_LINE) return across(axis, o->P + 6);
    if (type == JOINT_SPHERICAL || type == JOINT_CYLINDRICAL) l->type = JOINT_REVOLUTE;
    return type == JOINT_SPHERICAL || (l->type == JOINT_REVOLUTE && along(axis, o->P + 6));
}

/* As planar decks have them, of whose rows only some count in the plane: y of a slide is the normal, x to the left of
 * its axis; what holds together has the plane's axes, what turns keeps its own, z along the normal. */
static void lay_axes(struct model_loop *l, const struct flattening *o, bool turns)
{
    if (turns) {
        turn_axes(l->Ea, o, l->first);
        turn_axes(l->Eb, o, l->second);
        return;
    }
    double z[3];
    m3_mul(z, o->T[l->first], l->Ea + 6);
    m3_unit(l->Ea);
    if (l->type == JOINT_PRISMATIC || l->type == JOINT_POINT_ON_LINE) {
        v3_set(l->Ea, -z[1], z[0], 0);
        v3_set(l->Ea + 3, 0, 0, 1);
        v3_set(l->Ea + 6, z[0], z[1], 0);
    }
    memcpy(l->Eb, l->Ea, sizeof l->Eb);
}

static bool flatten_loops(struct flattening *o)
{
    const struct model *m = o->full;
    struct model_loop *loop = TAKE(o->life, struct model_loop, m->nloop);
    if (m->nloop) memcpy(loop, m->loop, sizeof *loop * (size_t)m->nloop);
    for (int i = 0; i < m->nloop; i++) {
        struct model_loop *l = &loop[i];
        const struct model_point a = {.body = l->first, .p = {l->a[0], l->a[1], l->a[2]}};
        const struct model_point b = {.body = l->second, .p = {l->b[0], l->b[1], l->b[2]}};
        const bool ball = l->type == JOINT_SPHERICAL;
        l->own = NULL;
        if (l->drive) continue;
        if (!flatten_type(l, o)) return spatial(o, l->name, "does not hold its bodies in the plane alone");
        if (l->nterm) continue;
        if (!level(o, &a, &b)) return spatial(o, l->name, "joins points of different heights");
        place(l->a, o, l->first, l->a);
        place(l->b, o, l->second, l->b);
        lay_axes(l, o, l->type == JOINT_REVOLUTE && !ball);
    }
    o->plane->loop = loop;
    return true;
}

/* ---- measures and forces ---- */

static bool flatten_measure(struct model_measure *s, const struct flattening *o)
{
    double axis[3] = {0, 0, 0};
    switch (s->type) {
    case MEASURE_COORDINATE:
        return true;
    case MEASURE_DISTANCE:
        if (!level(o, &s->a, &s->b)) return false;
        break;
    case MEASURE_DISPLACEMENT:
    case MEASURE_ANGLE:
        m3_mul(axis, o->T[s->in_world ? 0 : s->a.body], s->axis);
        v3_copy(s->axis, axis);
        if (s->type == MEASURE_ANGLE) v3_set(s->axis, 0, 0, axis[2] < 0 ? -1 : 1);
        if (s->type == MEASURE_DISPLACEMENT && fabs(axis[2]) > PARALLEL) return false;
        if (s->type == MEASURE_ANGLE && fabs(axis[2]) < 1 - PARALLEL) return false;
        break;
    }
    move_point(&s->a, o);
    move_point(&s->b, o);
    return true;
}

static bool flatten_measures(struct flattening *o)
{
    const struct model *m = o->full;
    struct model_measure *measure = TAKE(o->life, struct model_measure, m->nmeasure);
    if (m->nmeasure) memcpy(measure, m->measure, sizeof *measure * (size_t)m->nmeasure);
    for (int i = 0; i < m->nmeasure; i++)
        if (!flatten_measure(&measure[i], o))
            return spatial(o, measure[i].name ? measure[i].name : "a measure", "is not of motion in the plane");
    o->plane->measure = measure;
    return true;
}

/* The component of a load that is the k-th of the plane's; -1: a mixture. */
static int component(const double *T, int k)
{
    for (int c = 0; c < 3; c++)
        if (fabs(T[k + 3 * c] - 1) <= PARALLEL) return c;
    return -1;
}

static bool flatten_load(struct model_force *f, const struct flattening *o)
{
    struct signal value[3];
    const int from = f->torque ? 2 : 0, to = f->torque ? 3 : 2;
    memcpy(value, f->value, sizeof value);
    for (int k = from; k < to; k++) {
        const int c = component(o->T[f->body_axes ? f->b.body : 0], k);
        if (c < 0) return false;
        f->value[k] = value[c];
    }
    return true;
}

static bool flatten_forces(struct flattening *o)
{
    const struct model *m = o->full;
    struct model_force *force = TAKE(o->life, struct model_force, m->nforce);
    if (m->nforce) memcpy(force, m->force, sizeof *force * (size_t)m->nforce);
    for (int i = 0; i < m->nforce; i++) {
        struct model_force *f = &force[i];
        if (f->type == FORCE_BETWEEN) return spatial(o, f->name, "acts in all directions");
        if (f->type == FORCE_LOAD && !flatten_load(f, o)) return spatial(o, f->name, "has components across the axes");
        move_point(&f->a, o);
        move_point(&f->b, o);
    }
    o->plane->force = force;
    return true;
}

/* ---- all ---- */

static double size_of(const struct model *m)
{
    double size = 0;
    for (int i = 0; i < m->nbody; i++) size = fmax(size, v3_norm(m->body[i].at));
    for (int i = 0; i < m->njoint; i++) size = fmax(size, fmax(v3_norm(m->joint[i].a), v3_norm(m->joint[i].b)));
    return size;
}

static double still_energy(const struct flattening *o)
{
    const struct model *m = o->full;
    const double *n = o->P + 6;
    double sum = 0;
    for (int i = 1; i < m->nbody; i++) sum += m->body[i].mass * v3_dot(m->body[i].at, n);
    return -sum * v3_dot(m->gravity, n);
}

bool flatten(struct flattening *o)
{
    double normal[3];
    if (o->full->space == 2 || o->full->n == 0) return spatial(o, "the deck", "is planar as it is");
    if (o->full->ncontact) return spatial(o, o->full->contact[0].name, "is a rigid contact");
    if (!find_normal(normal, o)) return false;
    lay(o->P, normal);
    *o->plane = *o->full;
    o->plane->space = 2;
    o->plane->flattened = true;
    m3_tmul(o->plane->gravity, o->P, o->full->gravity);
    press(o->plane->gravity);
    if (o->full->nq != o->full->n) return spatial(o, "the deck", "has joints that turn freely");
    if (!flatten_bodies(o)) return false;
    flatten_joints(o);
    if (!flatten_measures(o) || !flatten_loops(o) || !flatten_forces(o)) return false;
    o->plane->npoint = o->plane->nkept = 0;
    return true;
}

struct flattening flattening_of(const struct model *full, struct model_spatial *why, struct arena *life)
{
    return (struct flattening){.full = full,
                               .plane = TAKE(life, struct model, 1),
                               .life = life,
                               .why = why,
                               .T = arena_take(life, (size_t)full->nbody, sizeof(double[9])),
                               .size = size_of(full)};
}

const struct model_flat *model_flatten(const struct model *full, struct model_spatial *why, struct arena *life)
{
    struct flattening o = flattening_of(full, why, life);
    if (!flatten(&o)) return NULL;
    struct model_flat *flat = TAKE(life, struct model_flat, 1);
    *flat = (struct model_flat){.full = full, .plane = o.plane, .level = still_energy(&o)};
    return flat;
}
