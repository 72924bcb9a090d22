/* flexible.c -- flexible bodies made, once every place is known where something takes hold of them.
 *
 * A place on a beam belongs to the section at its foot point on the axis, which carries it rigidly.  Sections with
 * joints are interfaces, and so are points where the deck wants it; those with other points, measures and forces are
 * further nodes.
 *
 * The first interface holds the beam while its modes are found, which are its coordinates and have its damping: that with
 * the joint from which the ground is reached over the fewest joints, of these the one nearest to the beam's start.  The
 * order in which a deck tells its joints has no say in it. */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "flex/pick.h"
#include "la/vec3.h"
#include "scene_flex/flexible.h"

enum { MANY = INT_MAX / 2 };
static const double SAME = 1e-9;  /* stations that are one */
static const double FAR = 0.1;    /* from the axis, in lengths: more is reported */
static const double CLOSE = 1e-3; /* from a node, in sizes of the body: more is reported */
static const double ALONG = 0.5;  /* cosine of what slides along a beam rather than across */

struct stations {
    int n, capacity;
    double *at;
};

static bool holds(const struct stations *o, double s)
{
    for (int i = 0; i < o->n; i++)
        if (fabs(o->at[i] - s) <= SAME) return true;
    return false;
}

static void take_station(struct stations *o, double s, struct arena *life)
{
    if (holds(o, s)) return;
    if (o->n == o->capacity) {
        double *more = TAKE(life, double, o->capacity ? 2 * o->capacity : 8);
        if (o->n) memcpy(more, o->at, (size_t)o->n * sizeof *more);
        o->capacity = o->capacity ? 2 * o->capacity : 8;
        o->at = more;
    }
    o->at[o->n++] = s;
}

/* One body while its nodes are collected. */
struct collecting {
    struct builder *b;
    int body;
    struct stations interfaces, points;
    struct stations far; /* of a place far from the axis, or its node's number: it has been told */
    const int *away;     /* [nbody] joints to the ground: joints_away() */
    int nearest;         /* of the bodies that its joints lead to; INT_MAX: none has been met */
    double held;         /* station of the joint that leads there */
};

/* How large a body from a file is: its nodes, and its mass, may stand in one place, but not both. */
static double size_of(const struct scene_body *body)
{
    const double *xx = body->flex->xx;
    double size = body->flex->mass > 0 ? sqrt((xx[0] + xx[4] + xx[8]) / body->flex->mass) : 0;
    for (int i = 0; i < body->flex->nnode; i++) size = fmax(size, v3_norm(body->flex->node[i].x));
    return size;
}

/* The same of a body from a file: its nodes are what they are. */
static void consider_node(struct collecting *c, const double *world, const struct node *at)
{
    const struct scene_body *body = &c->b->scene->body[c->body];
    double offset[3];
    int node = scene_node(offset, body, world);
    if (v3_norm(offset) <= CLOSE * size_of(body) || holds(&c->far, node)) return;
    take_station(&c->far, node, c->b->life);
    const char *name = body->flex->node[node].name;
    diag_warn(c->b->diags, at, AT_KEY, "W-offset",
              "a place %.3g m from the nearest node of '%s', %s: it carries it rigidly", v3_norm(offset), body->name,
              name ? name : "which has no name");
}

/* The station whose section carries a world place; the ends are snapped to. */
static double foot_station(const struct collecting *c, const double *world)
{
    const struct draft *o = c->b->draft[c->body];
    double d[3];
    v3_diff(d, world, o->beam.a);
    const double s = fmin(1, fmax(0, v3_dot(d, o->beam.R) / o->length));
    return s < SAME ? 0 : s > 1 - SAME ? 1 : s;
}

static double foot(struct collecting *c, const double *world, const struct node *at)
{
    const struct draft *o = c->b->draft[c->body];
    const double s = foot_station(c, world);
    double d[3];
    v3_diff(d, world, o->beam.a);
    v3_axpy(d, -s * o->length, o->beam.R);
    if (v3_norm(d) > FAR * o->length && !holds(&c->far, s)) {
        take_station(&c->far, s, c->b->life);
        diag_warn(c->b->diags, at, AT_KEY, "W-offset",
                  "a place %.3g m from the axis of beam '%s': the section at station %.3g carries it rigidly",
                  v3_norm(d), c->b->scene->body[c->body].name, s);
    }
    return s;
}

static void take_place(struct collecting *c, struct stations *to, const double *world, const struct node *at)
{
    if (c->b->draft[c->body])
        take_station(to, foot(c, world, at), c->b->life);
    else
        consider_node(c, world, at);
}

static void take_marker(struct collecting *c, struct stations *to, const struct marker *m, const struct node *at)
{
    double world[3];
    if (m->body != c->body) return;
    marker_drawn(world, c->b->scene, m);
    take_place(c, to, world, at);
}

/* How many joints each body is away from the ground, over the fewest of them; MANY: none lead there.  For beams. */
static int *joints_away(const struct builder *b)
{
    const struct scene *s = b->scene;
    int *away = TAKE(b->life, int, s->nbody);
    bool more = false;
    for (int i = 1; i < s->nbody; i++) {
        away[i] = MANY;
        more = more || b->draft[i];
    }
    while (more) {
        more = false;
        for (int i = 0; i < s->njoint; i++) {
            const struct scene_joint *j = &s->joint[i];
            if (joint_is_tie(j->kind)) continue;
            int *near = &away[j->first], *far = &away[j->second];
            if (*near > *far) near = &away[j->second], far = &away[j->first];
            if (*near == MANY || *far <= *near + 1) continue;
            *far = *near + 1;
            more = true;
        }
    }
    return away;
}

/* A joint to another body, at a place of this one. */
static void take_joint(struct collecting *c, const double *world, int other, const struct scene_joint *j)
{
    take_place(c, &c->interfaces, world, j->node);
    if (!c->b->draft[c->body]) return;
    const int away = joint_is_tie(j->kind) ? MANY : c->away[other];
    const double s = foot_station(c, world);
    if (away > c->nearest || (away == c->nearest && !(s < c->held))) return;
    c->nearest = away;
    c->held = s;
}

/* The line of a slide is fixed to one section and straight: it does not follow how the beam bends elsewhere. */
static void warn_of_slide(const struct collecting *c, const struct scene_joint *j)
{
    const struct draft *o = c->b->draft[c->body];
    bool along = false;
    int slides = 0;
    for (int a = 0; o && a < 3; a++) {
        if (!joint_slide(j->kind, a)) continue;
        slides++;
        along = along || fabs(v3_dot(j->E + 3 * a, o->beam.R)) >= ALONG;
    }
    if (!along || slides == c->b->scene->space) return;
    diag_warn(c->b->diags, j->node, AT_KEY, "W-slide",
              "joint '%s' slides along beam '%s', but on a straight line of its section at station %.3g", j->name,
              c->b->scene->body[c->body].name, foot_station(c, j->from));
}

/* The station that holds the beam comes first. */
static void lead(struct stations *o, double s)
{
    int k = 0;
    while (k < o->n && fabs(o->at[k] - s) > SAME) k++;
    if (k == o->n) return;
    memmove(o->at + 1, o->at, (size_t)k * sizeof *o->at);
    o->at[0] = s;
}

static void collect(struct collecting *c)
{
    const struct scene *s = c->b->scene;
    c->nearest = INT_MAX;
    for (int i = 0; i < s->njoint; i++) {
        const struct scene_joint *j = &s->joint[i];
        if (j->nterm) continue;
        if (j->first == c->body) warn_of_slide(c, j);
        if (j->first == c->body) take_joint(c, j->from, j->second, j);
        if (j->second == c->body) take_joint(c, j->at, j->first, j);
    }
    lead(&c->interfaces, c->held);
    for (int i = 0; i < s->npoint; i++)
        if (!s->point[i].statics) take_marker(c, &c->points, &s->point[i].at, s->body[c->body].node);
    for (int i = 0; i < s->nmeasure; i++) {
        take_marker(c, &c->points, &s->measure[i].a, s->measure[i].node);
        take_marker(c, &c->points, &s->measure[i].b, s->measure[i].node);
    }
    for (int i = 0; i < s->nforce; i++) {
        take_marker(c, &c->points, &s->force[i].b, s->force[i].node);
        take_marker(c, &c->points, &s->force[i].a, s->force[i].node);
    }
    if (c->interfaces.n == 0 && c->b->draft[c->body])
        take_station(&c->interfaces, c->b->draft[c->body]->centre, c->b->life);
    for (int i = 0; i < s->npoint; i++) /* behind the reference */
        if (s->point[i].statics) take_marker(c, &c->interfaces, &s->point[i].at, s->body[c->body].node);
}

/* Further nodes are not interfaces at the same time. */
static void only_points(struct collecting *c)
{
    int n = 0;
    for (int i = 0; i < c->points.n; i++)
        if (!holds(&c->interfaces, c->points.at[i])) c->points.at[n++] = c->points.at[i];
    c->points.n = n;
}

/* Mass and inertia of the undeformed body about its centre, body axes. */
static void weigh(struct scene_body *body)
{
    const double *A = body->flex->xx, *r = body->flex->rot, trace = A[0] + A[4] + A[8];
    const int at[6] = {0, 4, 8, 3, 6, 7};
    body->mass = body->flex->mass;
    for (int i = 0; i < 6; i++) body->inertia[i] = (i < 3 ? trace : 0) - A[at[i]] + r[at[i]];
}

/* Of modes of one frequency, as a round shaft has them in its two planes, some alone bend in one plane only. */
static void warn_of_halved_pair(struct builder *b, const struct scene_body *body, const struct node *modes)
{
    const struct flex_edge *edge = &body->flex->edge;
    if (!modes || !edge->parted) return;
    const int kept = b->draft[body - b->scene->body]->beam.modes - edge->whole[0];
    if (!edge->whole[1]) {
        diag_warn(b->diags, modes, AT_VALUE, "W-modes", "body '%s': of the modes of %.4g Hz %d %s left out", body->name,
                  edge->hertz[0], kept, kept == 1 ? "is kept, others are" : "are kept, others are");
        diag_hint(b->diags, "they belong together: take none of them, %d modes, or more elements", edge->whole[0]);
        return;
    }
    const int all = edge->whole[1] - edge->whole[0];
    diag_warn(b->diags, modes, AT_VALUE, "W-modes", "body '%s': of %d modes of %.4g Hz %d %s left out", body->name, all,
              edge->hertz[0], all - kept, all - kept == 1 ? "is" : "are");
    diag_hint(b->diags, "they belong together: take all, %d modes, or none, %d", edge->whole[1], edge->whole[0]);
}

/* Of as many modes as the mesh has, at most MOST_CANDIDATES. */
static enum status pick_modes(const struct flex_chosen **chosen, struct builder *b, int index, struct report *report)
{
    struct scene_body *body = &b->scene->body[index];
    struct draft *o = b->draft[index];
    struct flex_beam raw = o->beam;
    struct flex_body *all;
    raw.raw = true;
    TRY(flex_beam_make(&all, body->origin, &raw, b->life, report));
    bool *keep = TAKE(b->life, bool, all->inner);
    body->flex = all;
    *chosen = choose_modes(keep, b, index, all);
    body->flex = NULL;
    o->beam.modes = all->inner;
    o->beam.pick = keep;
    return OK;
}

/* Of a body from a file, where the deck wants it and they are modes. */
static void pick_coordinates(struct builder *b, int index)
{
    struct scene_body *body = &b->scene->body[index];
    const struct node *modes = node_find(body->node, "modes");
    if (!modes || modes->type != NODE_SCALAR || strcmp(modes->text, "auto") != 0) return;
    if (!body->flex->hertz) {
        diag_warn(b->diags, modes, AT_VALUE, "W-modes",
                  "body '%s': its file does not say that its coordinates are modes: all are kept", body->name);
        return;
    }
    struct flex_body *all = TAKE(b->life, struct flex_body, 1);
    bool *keep = TAKE(b->life, bool, body->flex->n);
    *all = *body->flex;
    all->inner = all->n;
    const struct flex_chosen *chosen = choose_modes(keep, b, index, all);
    all = flex_pick(all, keep, b->life);
    all->chosen = chosen;
    all->inner = 0;
    if (body->full) body->full = flex_pick(body->full, keep, b->life);
    body->flex = all;
    body->nmode = all->n;
}

/* What turning it off neglects is watched: the same modes with it. */
static enum status stiffened(const struct flex_body **full, const struct flex_beam *beam, struct arena *life,
                             struct report *report)
{
    struct flex_beam with = *beam;
    struct flex_body *o;
    double at[3];
    with.stiffening = true;
    TRY(flex_beam_make(&o, at, &with, life, report));
    *full = o;
    return OK;
}

static int make(struct collecting *c)
{
    struct builder *b = c->b;
    const int index = c->body;
    struct scene_body *body = &b->scene->body[index];
    struct draft *o = b->draft[index];
    struct flex_body *flex;
    struct report report = {0};
    collect(c);
    only_points(c);
    o->beam.ninterface = c->interfaces.n;
    o->beam.interface = c->interfaces.at;
    o->beam.npoint = c->points.n;
    o->beam.point = c->points.at;
    const struct flex_chosen *chosen = NULL;
    if ((o->choose && pick_modes(&chosen, b, index, &report) != OK) ||
        flex_beam_make(&flex, body->origin, &o->beam, b->life, &report) != OK) {
        diag_error(b->diags, o->modes, AT_VALUE, "E-beam", "body '%s': %s", body->name, report.text);
        return 1;
    }
    if (!o->beam.stiffening && stiffened(&body->full, &o->beam, b->life, &report) != OK) body->full = NULL;
    flex->chosen = chosen;
    body->flex = flex;
    body->nmode = flex->n;
    weigh(body);
    if (!o->choose) warn_of_halved_pair(b, body, o->modes);
    return 0;
}

void make_flexible(struct builder *b)
{
    const struct node *failed = NULL;   /* one segment is enough */
    if (diags_errors(b->diags)) return; /* half a deck would make other bodies */
    const int *away = joints_away(b);
    for (int i = 1; i < b->scene->nbody; i++) {
        struct collecting c = {.b = b, .body = i, .away = away};
        if (b->draft[i] && b->scene->body[i].node != failed) {
            if (make(&c)) failed = b->scene->body[i].node;
        } else if (b->scene->body[i].flex) {
            collect(&c);
            pick_coordinates(b, i);
            weigh(&b->scene->body[i]);
        }
    }
}
