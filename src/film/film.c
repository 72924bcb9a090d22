/* film.c -- see film.h */
#include "film/film.h"

#include <math.h>
#include <string.h>

#include "la/rot.h"
#include "la/vec3.h"

enum { CUTS = 8, PALETTE = 8 };
static const double CROWD = 16; /* bodies beyond which marks are smaller */
static const unsigned palette[PALETTE] = {0x3b73b9, 0xd1793a, 0x4f9a5b, 0xb0504f,
                                          0x7d66a8, 0x8a6a55, 0xc471a5, 0x5f9ea8};
static const unsigned GREY = 0x8c8c8c, DARK = 0x4a4a4a;

struct actor *film_actor(struct film *o, enum actor_type type, const char *name, unsigned color)
{
    o->actor = arena_more(o->life, o->actor, o->nactor, &o->actors, sizeof *o->actor);
    struct actor *a = &o->actor[o->nactor++];
    *a = (struct actor){.type = type, .name = name, .color = color, .mesh = {.life = o->life}, .stride = 7};
    return a;
}

/* ---- rigid bodies ---- */

static double number_of(const struct node *list, int i)
{
    if (list->type != NODE_LIST) return list->value;
    return i < list->count ? list->item[i]->value : 0;
}

/* The shape that the deck gives; false: none. */
static bool add_shape(struct mesh *mesh, const struct scene_body *body)
{
    static const double none[3] = {0, 0, 0}, axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const struct node *shape = body->node ? node_find(body->node, "shape") : NULL, *n;
    if ((n = node_find(shape, "box"))) {
        const double half[] = {number_of(n, 0) / 2, number_of(n, 1) / 2, number_of(n, 2) / 2};
        mesh_box(mesh, none, axes, half);
    } else if ((n = node_find(shape, "sphere"))) {
        mesh_ball(mesh, none, number_of(n, 0));
    } else if ((n = node_find(shape, "cylinder")) || (n = node_find(shape, "tube"))) {
        const double half = number_of(n, node_find(shape, "cylinder") ? 1 : 2) / 2;
        mesh_cylinder(mesh, (double[]){0, 0, -half}, (double[]){0, 0, half}, number_of(n, 0));
    } else {
        return false;
    }
    return true;
}

/* Is there nothing to see of a body?  It has no mass, no shape and no point, and hangs on one joint: a state's wheel. */
static bool unseen(const struct scene *s, int b)
{
    const struct scene_body *body = &s->body[b];
    int joints = 0;
    if (body->mass > 0 || !body->node || node_find(body->node, "shape")) return false;
    for (int i = 0; i < s->njoint; i++) joints += s->joint[i].first == b || s->joint[i].second == b;
    for (int i = 0; i < s->npoint; i++)
        if (s->point[i].at.body == b) return false;
    return joints == 1;
}

/* A bar to a place in body axes. */
static void add_bar(struct film *o, struct actor *a, const double *to)
{
    static const double none[3] = {0, 0, 0};
    mesh_cylinder(&a->mesh, none, to, .01 * o->mark);
}

static void add_bars(struct film *o, struct actor *a, const struct scene *s, int b)
{
    const struct scene_body *body = &s->body[b];
    for (int i = 0; i < s->njoint; i++) {
        const struct scene_joint *j = &s->joint[i];
        const enum joint_type type = j->kind->type;
        if ((j->first != b && j->second != b) || type == JOINT_FREE || type == JOINT_GEAR || type == JOINT_RACK)
            continue;
        double d[3], to[3];
        v3_diff(d, type == JOINT_DISTANCE && j->first == b ? j->from : j->at, body->at);
        m3_tmul(to, body->R, d);
        add_bar(o, a, to);
    }
    for (int i = 0; i < s->npoint; i++)
        if (s->point[i].at.body == b) add_bar(o, a, s->point[i].at.p);
    for (int i = 0; i < s->nmeasure; i++) {
        const struct scene_measure *m = &s->measure[i];
        if (m->type != MEASURE_DISTANCE && m->type != MEASURE_DISPLACEMENT) continue;
        if (m->a.body == b) add_bar(o, a, m->a.p);
        if (m->b.body == b) add_bar(o, a, m->b.p);
    }
}

/* Of a rod from end to end: its inertia says how long it is. */
static bool add_rod(struct film *o, struct actor *a, const struct scene_body *body)
{
    if (!body->node || !node_find(node_find(body->node, "shape"), "rod") || !(body->mass > 0)) return false;
    const double half = sqrt(3 * body->inertia[2] / body->mass);
    mesh_cylinder(&a->mesh, (double[]){-half, 0, 0}, (double[]){half, 0, 0}, .01 * o->mark);
    return true;
}

/* A body that is held at one end and has the inertia of a rod from there through its centre goes on behind it. */
static bool add_other_half(struct film *o, struct actor *a, const struct scene *s, int b)
{
    const struct scene_body *body = &s->body[b];
    int n = 0;
    double d[3] = {0, 0, 0}, end[3];
    for (int i = 0; i < s->njoint; i++) {
        if (s->joint[i].first != b && s->joint[i].second != b) continue;
        v3_diff(d, body->at, s->joint[i].at);
        n++;
    }
    const double inertia = body->mass * v3_dot(d, d) / 3;
    if (n != 1 || !(inertia > 0) || fabs(body->inertia[2] - inertia) > .01 * inertia) return false;
    m3_tmul(end, body->R, d);
    add_bar(o, a, end);
    return true;
}

static void add_rigid(struct film *o, const struct sim *sim, int b)
{
    static const double none[3] = {0, 0, 0};
    const struct scene_body *body = &sim->scene->body[b];
    struct actor *a = film_actor(o, ACTOR_SOLID, body->name, palette[b % PALETTE]);
    a->body = sim->model->body_of[b];
    if (add_shape(&a->mesh, body)) return;
    add_bars(o, a, sim->scene, b);
    if (!add_rod(o, a, body) && !add_other_half(o, a, sim->scene, b)) mesh_ball(&a->mesh, none, .02 * o->mark);
}

/* ---- flexible bodies ---- */

/* Do all nodes stand in one line?  d: along it. */
static bool in_line(double *d, const struct flex_body *f)
{
    double far = 0, x[3], off[3];
    for (int i = 1; i < f->nnode; i++) {
        v3_diff(x, f->node[i].x, f->node[0].x);
        if (v3_norm(x) <= far) continue;
        far = v3_norm(x);
        v3_copy(d, x);
    }
    if (!(far > 0)) return false;
    v3_scale(d, 1 / far, d);
    for (int i = 1; i < f->nnode; i++) {
        v3_diff(x, f->node[i].x, f->node[0].x);
        v3_cross(off, x, d);
        if (v3_norm(off) > 1e-6 * far) return false;
    }
    return true;
}

/* Numbers of the nodes along d, each place once. */
static int sort_nodes(int *order, const struct flex_body *f, const double *d)
{
    int n = 0;
    for (int i = 0; i < f->nnode; i++) {
        const double s = v3_dot(f->node[i].x, d);
        int k = n;
        while (k > 0 && v3_dot(f->node[order[k - 1]].x, d) > s + 1e-12) k--;
        if (k > 0 && fabs(v3_dot(f->node[order[k - 1]].x, d) - s) <= 1e-12) continue;
        memmove(order + k + 1, order + k, (size_t)(n - k) * sizeof *order);
        order[k] = i;
        n++;
    }
    return n;
}

/* Weights of a cubic at s in 0 ... 1: places of its ends, and slopes there. */
static void cubic(double w[4], double s)
{
    w[0] = 1 - s * s * (3 - 2 * s);
    w[1] = s * (1 - s) * (1 - s);
    w[2] = s * s * (3 - 2 * s);
    w[3] = -s * s * (1 - s);
}

/* A field by a coordinate between nodes a and b: u + the slope psi x (b - a). */
static void between(double *u, const struct flex_node *a, const struct flex_node *b, int j, const double w[4])
{
    double along[3], slope[3];
    v3_diff(along, b->x, a->x);
    v3_scale(u, w[0], a->phi + 3 * j);
    v3_axpy(u, w[2], b->phi + 3 * j);
    v3_cross(slope, a->psi + 3 * j, along);
    v3_axpy(u, w[1], slope);
    v3_cross(slope, b->psi + 3 * j, along);
    v3_axpy(u, w[3], slope);
}

static void fill_part(struct actor *o, const struct flex_node *a, const struct flex_node *b, int first)
{
    for (int i = 0; i <= CUTS; i++) {
        const double s = (double)i / CUTS;
        double w[4], *x = o->base + 3 * (first + i);
        cubic(w, s);
        v3_scale(x, 1 - s, a->x);
        v3_axpy(x, s, b->x);
        for (int j = 0; j < o->n; j++) between(o->mode + 3 * (j * o->nv + first + i), a, b, j, w);
    }
}

/* Along a line of nodes from one to the next; else from the reference node to each. */
static void add_line(struct film *o, const struct sim *sim, int b)
{
    const int body = sim->model->body_of[b];
    const struct flex_body *f = sim->model->body[body].flex;
    struct actor *a = film_actor(o, ACTOR_LINE, sim->scene->body[b].name, palette[b % PALETTE]);
    int *order = TAKE(o->life, int, f->nnode + 1), *part = TAKE(o->life, int, f->nnode + 1), n = f->nnode;
    double d[3];
    const bool line = in_line(d, f);
    if (line) n = sort_nodes(order, f, d);
    a->body = body;
    a->n = f->n;
    a->stride = 7 + f->n;
    a->npart = n - 1;
    a->nv = (CUTS + 1) * a->npart;
    a->base = TAKE(o->life, double, 3 * a->nv);
    a->mode = TAKE_MATRIX(o->life, double, 3 * a->nv, f->n);
    a->part = part;
    for (int i = 0, other = 0; i < a->npart; i++, other++) {
        if (!line && other == f->reference) other++;
        const struct flex_node *from = &f->node[line ? order[i] : f->reference],
                               *to = &f->node[line ? order[i + 1] : other];
        part[i] = (CUTS + 1) * i;
        fill_part(a, from, to, part[i]);
    }
    part[a->npart] = a->nv;
    if (line) film_stress_open(o, a, f, sim->scene->body[b].node);
}

/* ---- joints and springs ---- */

/* A mark by its first freedom: a cylinder about an axis of rotation, a box that slides, a ball. */
static void add_joint(struct film *o, const struct sim *sim, int i)
{
    static const double square[3] = {1.4, 1.4, 1.4};
    const struct scene_joint *j = &sim->scene->joint[i];
    const struct model *m = sim->model;
    const int tree = m->joint_of[i], loop = m->loop_of[i];
    const double r = .016 * o->mark, *p, *E;
    double half[3], ends[2][3];
    if (j->kind->tie != NO_TIE || j->kind->type == JOINT_FREE || (tree < 0 && loop < 0)) return;
    struct actor *a = film_actor(o, ACTOR_SOLID, j->name, j->first == 0 || j->second == 0 ? DARK : GREY);
    a->body = tree >= 0 ? m->joint[tree].child : m->loop[loop].second;
    p = tree >= 0 ? m->joint[tree].b : m->loop[loop].b;
    E = tree >= 0 ? m->joint[tree].Eb : m->loop[loop].Eb;
    const struct freedom *f = &j->kind->freedom[0];
    for (int k = 0; k < 2; k++) {
        v3_copy(ends[k], p);
        v3_axpy(ends[k], k ? 1.6 * r : -1.6 * r, E + 3 * f->axis);
    }
    v3_scale(half, r, square);
    if (f->ball || j->kind->type == JOINT_UNIVERSAL)
        mesh_ball(&a->mesh, p, 1.5 * r);
    else if (f->turns)
        mesh_cylinder(&a->mesh, ends[0], ends[1], 1.3 * r);
    else
        mesh_box(&a->mesh, p, E, half);
}

static void add_between(struct film *o, const char *name, const struct model_point *a, const struct model_point *b,
                        bool coils)
{
    struct actor *actor = film_actor(o, ACTOR_SPRING, name, coils ? 0x2f8f6f : GREY);
    actor->a = *a;
    actor->b = *b;
    actor->coils = coils;
    actor->stride = 6;
}

static void add_springs(struct film *o, const struct sim *sim)
{
    const struct model *m = sim->model;
    for (int i = 0; i < m->nforce; i++) {
        const struct model_force *f = &m->force[i];
        if (f->measure < 0 || (f->type != FORCE_LAW && f->type != FORCE_VALUE)) continue;
        if (f->kind == &force_unilateral) continue; /* nothing is there while it is open */
        const struct model_measure *s = &m->measure[f->measure];
        if (s->type == MEASURE_DISTANCE || s->type == MEASURE_DISPLACEMENT)
            add_between(o, f->name, &s->a, &s->b, f->type == FORCE_LAW);
    }
    for (int i = 0; i < m->nloop; i++) {
        const struct model_loop *l = &m->loop[i];
        if (l->drive || l->type != JOINT_DISTANCE) continue;
        struct model_point a = {.body = l->first}, b = {.body = l->second};
        v3_copy(a.p, l->a);
        v3_copy(b.p, l->b);
        add_between(o, l->name, &a, &b, false);
    }
}

/* ---- the whole ---- */

void film_widen(struct film *o, const double *x)
{
    for (int k = 0; k < 3; k++) {
        o->low[k] = fmin(o->low[k], x[k]);
        o->high[k] = fmax(o->high[k], x[k]);
    }
}

static void measure(struct film *o, const struct scene *s)
{
    double x[3];
    for (int b = 1; b < s->nbody; b++) {
        film_widen(o, s->body[b].at);
        const struct flex_body *f = s->body[b].flex;
        for (int i = 0; f && i < f->nnode; i++) {
            m3_mul(x, s->body[b].R, f->node[i].x);
            v3_add(x, s->body[b].at);
            film_widen(o, x);
        }
    }
    for (int i = 0; i < s->njoint; i++)
        if (!unseen(s, s->joint[i].second)) film_widen(o, s->joint[i].at);
    film_widen_surfaces(o, s);
    v3_diff(x, o->high, o->low);
    o->size = isfinite(v3_norm(x)) && v3_norm(x) > 0 ? v3_norm(x) : 1;
    o->mark = o->size * fmin(1, CROWD / s->nbody);
}

void film_open(struct film *o, struct sim *sim, struct arena *life)
{
    const struct scene *s = sim->scene;
    *o = (struct film){.title = scene_title(s),
                       .space = s->space,
                       .low = {INFINITY, INFINITY, INFINITY},
                       .high = {-INFINITY, -INFINITY, -INFINITY},
                       .ncolumn = sim->chosen.n,
                       .column = sim->columns,
                       .life = life};
    measure(o, s);
    sim->needs |= EVALUATE_MOTION;
    for (int b = 1; b < s->nbody; b++) {
        if (sim->model->body[sim->model->body_of[b]].flex)
            add_line(o, sim, b);
        else if (!unseen(s, b))
            add_rigid(o, sim, b);
    }
    for (int i = 0; i < s->njoint; i++)
        if (!unseen(s, s->joint[i].second)) add_joint(o, sim, i);
    add_springs(o, sim);
    film_surfaces(o, sim);
}

static void put_frame(struct film *o, const struct sim *sim, struct actor *a, double *to)
{
    struct pose p;
    system_pose(sim->system, &p, a->body);
    v3_copy(to, p.r);
    quat_of_matrix(to + 3, p.R);
    const double *last = o->frames ? to - a->stride + 3 : NULL;
    if (last && to[3] * last[0] + to[4] * last[1] + to[5] * last[2] + to[6] * last[3] < 0)
        for (int k = 3; k < 7; k++) to[k] = -to[k];
    const struct model_body *body = &sim->model->body[a->body];
    for (int j = 0; j < a->n; j++) to[7 + j] = sim->x.q[body->mode_q[j]];
    if (a->type == ACTOR_SOLID && a->body) film_widen(o, p.r);
}

void film_add(struct film *o, const struct sim *sim, const double *x)
{
    double v[3], acceleration[3], at[3], u[3];
    for (int i = 0; i < o->nactor; i++) {
        struct actor *a = &o->actor[i];
        a->frame = arena_more(o->life, a->frame, o->frames, &a->capacity, (size_t)a->stride * sizeof *a->frame);
        double *to = a->frame + (size_t)o->frames * (size_t)a->stride;
        if (a->type == ACTOR_SPRING) {
            system_point(sim->system, to, v, acceleration, &a->a);
            system_point(sim->system, to + 3, v, acceleration, &a->b);
        } else {
            put_frame(o, sim, a, to);
            film_stress_add(o, sim, a);
        }
        for (int k = 0; a->type == ACTOR_LINE && k < a->nv; k += CUTS) {
            film_vertex(at, u, a, to, k);
            film_widen(o, at);
        }
    }
    o->x = arena_more(o->life, o->x, o->frames, &o->capacity, (size_t)o->ncolumn * sizeof *o->x);
    memcpy(o->x + (size_t)o->frames * (size_t)o->ncolumn, x, (size_t)o->ncolumn * sizeof *x);
    o->frames++;
}

void film_vertex(double *x, double *u, const struct actor *a, const double *frame, int i)
{
    double R[9], local[3], d[3] = {0, 0, 0};
    quat_matrix(R, frame + 3);
    for (int j = 0; j < a->n; j++) v3_axpy(d, frame[7 + j], a->mode + 3 * (j * a->nv + i));
    v3_sum(local, a->base + 3 * i, d);
    m3_mul(x, R, local);
    v3_add(x, frame);
    m3_mul(u, R, d);
}
