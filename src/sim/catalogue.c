/* catalogue.c -- see catalogue.h; the order here is the order in which wild cards find columns */
#include "sim/catalogue.h"

#include <stdio.h>
#include <string.h>

#include "system/system.h"

struct listing {
    struct catalogue *o;
    struct arena *life;
    int plane;
};

static void add(struct listing *l, const char *name, const char *unit, const char *brief, struct origin origin)
{
    struct catalogue *o = l->o;
    int room = o->room;
    o->column = arena_more(l->life, o->column, o->n, &room, sizeof *o->column);
    o->origin = arena_more(l->life, o->origin, o->n, &o->room, sizeof *o->origin);
    o->column[o->n] = (struct column){name, unit, brief};
    o->origin[o->n++] = origin;
}

static const char *join(struct listing *l, const char *owner, const char *quantity)
{
    return arena_print(l->life, "%s.%s", owner, quantity);
}

/* One column for each of the words, components k of one source. */
static void add_parts(struct listing *l, const char *owner, const char *const *words, const int *k, int n,
                      const char *unit, const char *brief, enum origin_type type, int index)
{
    for (int i = 0; i < n; i++) add(l, join(l, owner, words[i]), unit, brief, (struct origin){type, index, k[i], -1});
}

static const int first_parts[] = {0, 1, 2, 3};

static void add_reactions(struct listing *l, const char *name, enum origin_type type, int i)
{
    static const char *const force[] = {"fx", "fy", "fz"}, *const moment[] = {"mx", "my", "mz"};
    static const int moments[] = {3, 4, 5};
    add_parts(l, name, force, first_parts, l->plane ? 2 : 3, "N", "reaction on the second body, world axes", type, i);
    if (l->plane)
        add(l, join(l, name, "mz"), "N m", "reaction on the second body, at the joint, world axes",
            (struct origin){type, i, 5, -1});
    else
        add_parts(l, name, moment, moments, 3, "N m", "reaction on the second body, at the joint, world axes", type, i);
}

/* Ties: a rod's and a line's force on the second body, at its point; what a rod or a gear bears. */
static void add_tie(struct listing *l, const struct model_loop *loop, int i)
{
    static const char *const force[] = {"fx", "fy", "fz"};
    const int last = loop->nterm - 1;
    if (last < 0)
        add_parts(l, loop->name, force, first_parts, l->plane ? 2 : 3, "N", "force on the second body, world axes",
                  FROM_LOOP, i);
    if (loop->type == JOINT_POINT_ON_LINE) return;
    add(l, join(l, loop->name, "force"), last >= 0 && loop->term[last].angular ? "N m" : "N",
        last >= 0 ? "what drives the second coordinate upwards" : "what drives the points apart",
        (struct origin){FROM_TIE, i, 0, -1});
}

static void add_loop(struct listing *l, const struct model_loop *loop, int i)
{
    if (joint_is_tie(loop->type))
        add_tie(l, loop, i);
    else
        add_reactions(l, loop->name, FROM_LOOP, i);
}

static void add_joint(struct listing *l, const struct model *m, int i, int unnamed)
{
    const struct model_joint *j = &m->joint[i];
    const struct joint_kind *kind = joint_kind(j->type, !l->plane);
    int turned = j->type == JOINT_UNIVERSAL && j->reversed;
    for (int k = 0; k < j->nq; k++)
        add(l, join(l, j->name, kind->q[k]), kind->qunit[k], "joint coordinate",
            (struct origin){FROM_Q, j->iq[turned ? 1 - k : k], 0, m->coordinate[j->iq[turned ? 1 - k : k]].fast});
    for (int k = 0; k < j->nv; k++) {
        int iv = j->iv[turned ? 1 - k : k];
        add(l, join(l, j->name, kind->v[k]), kind->vunit[k], "rate of a joint coordinate",
            (struct origin){FROM_V, iv, 0, iv < m->ns});
    }
    for (int k = 0; k < j->nv; k++) {
        int iv = j->iv[turned ? 1 - k : k];
        add(l, join(l, j->name, kind->a[k]), kind->aunit[k], "acceleration of a joint coordinate",
            (struct origin){FROM_A, iv, 0, iv < m->ns});
    }
    if (!unnamed) add_reactions(l, j->name, FROM_REACTION, i);
}

static void add_body(struct listing *l, const struct model_body *b, int i)
{
    static const char *const x[] = {"x", "y", "z"}, *const v[] = {"vx", "vy", "vz"}, *const a[] = {"ax", "ay", "az"},
                             *const w[] = {"wx", "wy", "wz"}, *const q[] = {"qw", "qx", "qy", "qz"};
    int n = l->plane ? 2 : 3;
    add_parts(l, b->name, x, first_parts, n, "m", "centre of mass, world axes", FROM_PLACE, i);
    if (l->plane)
        add(l, join(l, b->name, "angle"), "rad", "turned since drawn", (struct origin){FROM_ANGLE, i, 0, -1});
    else
        add_parts(l, b->name, q, first_parts, 4, NULL, "unit quaternion, body to world", FROM_QUATERNION, i);
    add_parts(l, b->name, v, first_parts, n, "m/s", "velocity of the centre of mass", FROM_VELOCITY, i);
    if (l->plane)
        add(l, join(l, b->name, "wz"), "rad/s", "angular velocity, world axes", (struct origin){FROM_OMEGA, i, 2, -1});
    else
        add_parts(l, b->name, w, first_parts, 3, "rad/s", "angular velocity, world axes", FROM_OMEGA, i);
    add_parts(l, b->name, a, first_parts, n, "m/s2", "acceleration of the centre of mass", FROM_ACCELERATION, i);
}

/* A beam's stress by its parts, a solid's by the tensor. */
static void add_stress(struct listing *l, const struct flex_stress *s, const char *name, int i, int k)
{
    static const char *const part[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    const bool beam = s->axial && s->bending;
    if (beam) {
        add(l, join(l, name, "axial"), "Pa", "normal stress from stretch", (struct origin){FROM_AXIAL, i, k, -1});
        add(l, join(l, name, "bending"), "Pa", "normal stress from bending", (struct origin){FROM_BENDING, i, k, -1});
    }
    for (int c = 0; c < 6; c++) {
        if (beam && (!s->shear || (c != 3 && (c != 4 || l->plane)))) continue;
        add(l, join(l, name, part[c]), "Pa", c < 3 ? "normal stress, body axes" : "shear stress, body axes",
            (struct origin){FROM_TENSOR, i, 6 * k + c, -1});
    }
    add(l, join(l, name, "von_mises"), "Pa", "equivalent stress", (struct origin){FROM_VON_MISES, i, k, -1});
}

/* Elastic coordinates, and stresses at named places. */
static void add_elastic(struct listing *l, const struct model *m, int i)
{
    const struct model_body *b = &m->body[i];
    static const char *const words[] = {"", "_rate", "_accel"};
    static const char *const briefs[] = {"elastic coordinate", "its rate", "its acceleration"};
    static const enum origin_type types[] = {FROM_Q, FROM_V, FROM_A};
    for (int part = 0; part < 3; part++)
        for (int k = 0; k < b->nmode; k++) {
            int place = part ? b->mode_v[k] : b->mode_q[k];
            int fast = part ? place < m->ns : m->coordinate[place].fast;
            add(l, arena_print(l->life, "%s.mode%d%s", b->name, k + 1, words[part]), NULL, briefs[part],
                (struct origin){types[part], place, 0, fast});
        }
    for (int k = 0; b->flex && k < b->flex->nstress; k++)
        add_stress(l, &b->flex->stress[k], join(l, b->name, b->flex->stress[k].name), i, k);
}

static void add_point(struct listing *l, const struct model_point *p, int i)
{
    static const char *const x[] = {"x", "y", "z"}, *const v[] = {"vx", "vy", "vz"}, *const a[] = {"ax", "ay", "az"};
    int n = l->plane ? 2 : 3;
    add_parts(l, p->name, x, first_parts, n, "m", "point, world axes", FROM_POINT, i);
    add_parts(l, p->name, v, first_parts, n, "m/s", "velocity of a point", FROM_POINT_VELOCITY, i);
    add_parts(l, p->name, a, first_parts, n, "m/s2", "acceleration of a point", FROM_POINT_ACCELERATION, i);
    static const char *const d[] = {"dx", "dy", "dz"};
    if (p->frame)
        add_parts(l, p->name, d, first_parts, n, "m", "displacement by bending, body axes", FROM_DISPLACEMENT, i);
}

static void add_measure(struct listing *l, const struct model_measure *s, int i)
{
    if (!s->name) return;
    add(l, s->name, s->angular ? "rad" : "m", "measure", (struct origin){FROM_MEASURE, i, 0, s->fast});
    add(l, arena_print(l->life, "%s_rate", s->name), s->angular ? "rad/s" : "m/s", "rate of a measure",
        (struct origin){FROM_MEASURE_RATE, i, 0, s->fast});
}

static void add_force(struct listing *l, const struct model *m, const struct model_force *f, int i)
{
    bool along = f->type == FORCE_LAW || f->type == FORCE_VALUE;
    bool angular = along ? m->measure[f->measure].angular : f->torque;
    add(l, join(l, f->name, "force"), angular ? "N m" : "N", along ? "along its measure" : "size of the load",
        (struct origin){FROM_FORCE, i, 0, -1});
    if (along)
        add(l, join(l, f->name, "elongation"), angular ? "rad" : "m", "its measure",
            (struct origin){FROM_ELONGATION, i, 0, -1});
    add(l, join(l, f->name, "power"), "W", "put into the system", (struct origin){FROM_POWER, i, 0, -1});
}

static void add_drive(struct listing *l, const struct model *m, int i)
{
    const struct model_loop *d = &m->loop[i];
    bool angular = m->measure[d->measure].angular;
    add(l, join(l, d->name, "force"), angular ? "N m" : "N", "of the drive, along its measure",
        (struct origin){FROM_DRIVE, i, 0, -1});
    add(l, join(l, d->name, "power"), "W", "put into the system", (struct origin){FROM_DRIVE, i, 1, -1});
}

static void add_energies(struct listing *l)
{
    static const char *const names[] = {"kinetic", "elastic",  "gravity",   "external", "drive",
                                        "damper",  "friction", "numerical", "residual"};
    static const char *const briefs[] = {"kinetic energy",
                                         "energy in springs and in flexible bodies",
                                         "energy in the field of gravity",
                                         "work of external forces since the start",
                                         "work of drives since the start",
                                         "work of dampers since the start (negative: taken)",
                                         "work of friction since the start",
                                         "taken by the scheme's own damping since the start",
                                         "W_kin + W_int - W_ext of (2-26)"};
    for (int k = 0; k < ENERGY_COLUMNS; k++)
        add(l, join(l, "energy", names[k]), "J", briefs[k], (struct origin){FROM_ENERGY, 0, k, -1});
}

static void add_momenta(struct listing *l)
{
    static const char *const p[] = {"x", "y", "z"}, *const L[] = {"lx", "ly", "lz"};
    add_parts(l, "momentum", p, first_parts, l->plane ? 2 : 3, "N s", "of all bodies", FROM_MOMENTUM, 0);
    for (int k = l->plane ? 2 : 0; k < 3; k++)
        add(l, join(l, "momentum", L[k]), "N m s", "angular momentum of all bodies about the world's origin",
            (struct origin){FROM_MOMENTUM, 0, 3 + k, -1});
}

static void add_steps(struct listing *l)
{
    add(l, "step.h", "s", "minor step of the last step", (struct origin){FROM_STEP, 0, STEP_MINOR, -1});
    add(l, "step.H", "s", "major step of the last step", (struct origin){FROM_STEP, 0, STEP_MAJOR, -1});
    add(l, "step.ratio", NULL, "minor steps in it", (struct origin){FROM_STEP, 0, STEP_RATIO, -1});
    add(l, "step.sweeps", NULL, "Newton sweeps of the last step", (struct origin){FROM_STEP, 0, STEP_SWEEPS, -1});
}

/* Joints of the tree that are not the deck's: free by default. */
static void add_unnamed(struct listing *l, const struct scene *scene, const struct model *m)
{
    bool *named = TAKE(l->life, bool, m->njoint);
    for (int i = 0; i < scene->njoint; i++)
        if (m->joint_of[i] >= 0) named[m->joint_of[i]] = true;
    for (int i = 0; i < m->njoint; i++)
        if (!named[i] && !m->body[i + 1].at_node) add_joint(l, m, i, 1);
}

void catalogue_build(struct catalogue *o, const struct scene *scene, const struct model *m, struct arena *life)
{
    struct listing l = {o, life, m->space == 2};
    *o = (struct catalogue){0};
    add(&l, "t", "s", "time", (struct origin){FROM_TIME, 0, 0, -1});
    for (int i = 0; i < scene->njoint; i++)
        if (m->joint_of[i] >= 0)
            add_joint(&l, m, m->joint_of[i], 0);
        else
            add_loop(&l, &m->loop[m->loop_of[i]], m->loop_of[i]);
    add_unnamed(&l, scene, m);
    for (int i = 1; i < scene->nbody; i++) add_elastic(&l, m, m->body_of[i]);
    for (int i = 1; i < scene->nbody; i++) add_body(&l, &m->body[m->body_of[i]], m->body_of[i]);
    for (int i = 0; i < m->npoint; i++) add_point(&l, &m->point[i], i);
    for (int i = 0; i < m->nmeasure; i++) add_measure(&l, &m->measure[i], i);
    for (int i = 0; i < m->nforce; i++) add_force(&l, m, &m->force[i], i);
    for (int i = model_first_drive(m); i < m->nloop; i++) add_drive(&l, m, i);
    add_energies(&l);
    add_momenta(&l);
    add_steps(&l);
}

unsigned catalogue_needs(const struct catalogue *o, const struct selection *chosen)
{
    unsigned needs = 0;
    for (int i = 0; i < chosen->n; i++) {
        switch (o->origin[chosen->index[i]].type) {
        case FROM_TIME:
        case FROM_Q:
        case FROM_V:
        case FROM_ENERGY:
        case FROM_STEP:
            break;
        case FROM_A:
        case FROM_ACCELERATION:
        case FROM_POINT_ACCELERATION:
        case FROM_REACTION:
        case FROM_LOOP:
        case FROM_DRIVE:
        case FROM_TIE:
        case FROM_FORCE:
        case FROM_ELONGATION:
        case FROM_POWER:
            needs |= SEE_MOTION | SEE_ACCELERATION;
            break;
        default:
            needs |= SEE_MOTION;
        }
    }
    return needs;
}
