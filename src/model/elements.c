/* elements.c -- measures and forces with their places in q and v and their rate class.
 *
 * A force is fast if it reads, or acts on the relative motion of, anything fast; a load that depends on t
 * alone is always fast: it is cheap. */
#include <string.h>

#include "kind/potential.h"
#include "la/vec3.h"
#include "model/parts.h"
#include "model/touch.h"

static struct model_point point_of(struct making *o, const struct marker *at)
{
    struct model_point p = {.name = NULL};
    p.body = marker_on(p.p, o, at);
    return p;
}

/* The scene's body in whose frame the bending of one is seen: itself; of a beam in segments that which carries the
 * others, as what holds the beam in one piece would hold its frame. */
static int seen_from(const struct making *o, int body)
{
    const struct scene_body *all = o->scene->body;
    int first = body;
    for (int i = 1; all[body].whole && i < o->scene->nbody; i++)
        if (all[i].whole && strcmp(all[i].whole, all[body].whole) == 0 && o->body_of[i] < o->body_of[first]) first = i;
    return first;
}

/* A named point; of a flexible body with its place in the frame. */
static struct model_point named_point(struct making *o, const struct scene_point *from)
{
    const struct scene_body *sb = &o->scene->body[from->at.body];
    const int frame = seen_from(o, from->at.body);
    struct model_point p = point_of(o, &from->at);
    double away[3];
    p.name = from->name;
    if (!sb->flex) return p;
    p.frame = o->body_of[frame];
    v3_diff(away, sb->at, o->scene->body[frame].origin);
    m3_tmul(p.drawn, sb->R, away);
    v3_add(p.drawn, from->at.p);
    return p;
}

static void make_measure(struct making *o, struct model_measure *to, const struct scene_measure *from)
{
    *to = (struct model_measure){.name = from->name, .type = from->type, .angular = from->angular, .iq = -1, .iv = -1};
    if (from->type == MEASURE_COORDINATE) {
        const struct model_joint *j = &o->joint[o->joint_of[from->joint]];
        to->iv = rate_place(o, from->joint, from->k);
        to->iq = position_place(o, from->joint, from->k); /* plain coordinates pair up */
        to->fast = place_is_fast(o, to->iv);
        to->a.body = j->parent;
        to->b.body = j->child;
        return;
    }
    to->a = point_of(o, &from->a);
    to->b = point_of(o, &from->b);
    v3_copy(to->axis, from->axis);
    to->in_world = from->in_world;
    to->fast = o->body[to->a.body].fast || o->body[to->b.body].fast;
}

/* Forces that read a mode keep it (mirror.h). */
static struct model_slot mode_slot(const struct making *o, const struct scene_slot *s, enum slot_type type)
{
    const struct model_body *b = &o->body[o->body_of[s->index]];
    const int k = model_mode(b, s->k);
    return (struct model_slot){type, type == SLOT_Q ? b->mode_q[k] : b->mode_v[k]};
}

static struct model_slot make_slot(const struct making *o, const struct scene_slot *s)
{
    switch (s->type) {
    case SCENE_MEASURE:
        return (struct model_slot){SLOT_MEASURE, s->index};
    case SCENE_MEASURE_RATE:
        return (struct model_slot){SLOT_MEASURE_RATE, s->index};
    case SCENE_COORDINATE:
        return (struct model_slot){SLOT_Q, position_place(o, s->index, s->k)};
    case SCENE_RATE:
        return (struct model_slot){SLOT_V, rate_place(o, s->index, s->k)};
    case SCENE_MODE:
        return mode_slot(o, s, SLOT_Q);
    case SCENE_MODE_RATE:
        return mode_slot(o, s, SLOT_V);
    case SCENE_TIME:
        break;
    }
    return (struct model_slot){SLOT_TIME, 0};
}

static bool touched_is_fast(const struct making *o, const struct touched *t)
{
    if (t->a >= 0) return o->body[t->a].fast || o->body[t->b].fast;
    if (t->iv >= 0) return place_is_fast(o, t->iv);
    return t->iq >= 0 && o->m->coordinate[t->iq].fast;
}

static bool reads_time(const struct model_force *f)
{
    return signal_reads_time(&f->value[0]) || signal_reads_time(&f->value[1]) || signal_reads_time(&f->value[2]);
}

static bool has_corners(const struct model_force *f)
{
    return f->value[0].ncorner + f->value[1].ncorner + f->value[2].ncorner > 0;
}

static enum rate class_of(const struct making *o, const struct model_force *f)
{
    struct touched t;
    for (int i = 0; model_touched(&t, o->m, f, i); i++)
        if (touched_is_fast(o, &t)) return FAST;
    return f->nslot == 1 && reads_time(f) ? FAST : SLOW;
}

/* Does an expression read the measure that it acts along, and nothing else? */
static bool is_potential(const struct making *o, const struct model_force *f)
{
    const struct model_slot *own = &f->slot[1];
    if (f->type != FORCE_VALUE || !f->value[0].expr || f->nslot != 2 || signal_reads_time(&f->value[0])) return false;
    if (own->type == SLOT_MEASURE) return own->index == f->measure;
    return own->type == SLOT_Q && own->index == o->m->measure[f->measure].iq;
}

/* Then it has an energy. */
static void take_potential(struct making *o, struct model_force *f)
{
    struct potential *p = TAKE(o->life, struct potential, 1);
    p->expr = f->value[0].expr;
    f->type = FORCE_LAW;
    f->kind = &force_potential;
    f->par = p;
}

static void make_force(struct making *o, struct model_force *to, const struct scene_force *from)
{
    *to = (struct model_force){
        .name = from->name,
        .type = from->type,
        .measure = from->measure,
        .kind = from->kind,
        .par = from->par,
        .value = {from->value[0], from->value[1], from->value[2]},
        .nslot = from->nslot,
        .a = point_of(o, &from->a),
        .b = point_of(o, &from->b),
        .torque = from->torque,
        .body_axes = from->body_axes,
    };
    struct model_slot *slot = TAKE(o->life, struct model_slot, from->nslot);
    for (int i = 0; i < from->nslot; i++) slot[i] = make_slot(o, &from->slot[i]);
    to->slot = slot;
    to->corners = has_corners(to);
    if (is_potential(o, to)) take_potential(o, to);
    to->cls = class_of(o, to);
}

static bool has_friction(const struct contact_law *law)
{
    return law->holding > 0 || law->sliding > 0;
}

static void make_friction(const struct making *o, struct model_contact *to, int number)
{
    const struct scene_joint *from = &o->scene->joint[number];
    to->across = 1;
    to->angular = from->kind->freedom[0].turns;
    to->joint = o->joint_of[number];
    to->loop = o->loop_of[number];
    to->fast = o->body[o->body_of[from->first]].fast || o->body[o->body_of[from->second]].fast;
    if (to->joint < 0) return;
    to->iq = o->joint[to->joint].iq[0];
    to->iv = o->joint[to->joint].iv[0];
    to->fast = to->iv < o->m->ns;
}

static void make_contact(struct making *o, struct model_contact *to, const struct scene_contact *from)
{
    *to = (struct model_contact){.name = from->name,
                                 .pair = from->pair,
                                 .law = from->law,
                                 .iq = -1,
                                 .iv = -1,
                                 .side = from->side,
                                 .limit = from->limit,
                                 .radius = from->radius,
                                 .other = from->other,
                                 .outline = from->outline};
    to->joint = to->loop = -1;
    if (from->pair == PAIR_FRICTION) {
        make_friction(o, to, from->joint);
        return;
    }
    if (from->pair == PAIR_STOP) {
        const struct model_measure *m = &o->m->measure[from->measure];
        to->iq = m->iq;
        to->iv = m->iv;
        to->angular = m->angular;
        to->fast = m->fast;
        return;
    }
    to->a = point_of(o, &from->a);
    to->b = point_of(o, &from->b);
    to->fast = o->body[to->a.body].fast || o->body[to->b.body].fast;
    to->across = has_friction(&from->law) ? o->scene->space - 1 : 0;
    v3_copy(to->normal, from->normal);
    v3_copy(to->along, from->along);
}

void make_elements(struct making *o)
{
    const struct scene *scene = o->scene;
    struct model *m = o->m;
    struct model_measure *measure = TAKE(o->life, struct model_measure, scene->nmeasure);
    for (int i = 0; i < scene->nmeasure; i++) make_measure(o, &measure[i], &scene->measure[i]);
    m->measure = measure;
    m->nmeasure = scene->nmeasure;
    struct model_force *force = TAKE(o->life, struct model_force, scene->nforce);
    for (int i = 0; i < scene->nforce; i++) make_force(o, &force[i], &scene->force[i]);
    m->force = force;
    m->nforce = scene->nforce;
    struct model_contact *contact = TAKE(o->life, struct model_contact, scene->ncontact);
    for (int i = 0; i < scene->ncontact; i++) make_contact(o, &contact[i], &scene->contact[i]);
    m->contact = contact;
    m->ncontact = scene->ncontact;
    struct model_point *point = TAKE(o->life, struct model_point, scene->npoint);
    for (int i = 0; i < scene->npoint; i++) point[i] = named_point(o, &scene->point[i]);
    m->point = point;
    m->npoint = scene->npoint;
}
