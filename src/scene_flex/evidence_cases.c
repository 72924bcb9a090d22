/* evidence_cases.c -- what moves a flexible body: inertia, gravity, forces. */
#include "scene_flex/evidence.h"

#include <math.h>

#include "la/vec3.h"

static const double SAME = 1e-6; /* a static displacement's own place: 1 */

static void fill_inertia(struct evidence *e, struct flex_case *c, const double *d)
{
    flex_inertia_load((double *)c->p, e->all, d);
    for (int r = 0; r < e->o.nrigid; r++) c->rigid[r] = -flex_inertia_between(e->all, e->recoil[r], d);
    add_hanging(e, (double *)c->p, c->rigid, d);
}

static void add_inertia(struct evidence *e)
{
    const bool sudden = e->free ? !(e->at_rest && e->smooth) : !e->smooth;
    for (int i = 0; i < e->nmotion; i++) {
        const struct motion *m = &e->motion[i];
        double d[6], w[3];
        for (int k = 0; k < 6; k++) d[k] = m->d[k] / (m->turns ? e->length : 1);
        fill_inertia(e, add_case(e, m->name, FAMILY_INERTIA, sudden, e->pace), d);
        if (!m->turns) continue;
        v3_scale(w, 1 / sqrt(e->length), m->axis);
        struct flex_case *c = add_case(e, m->name, FAMILY_INERTIA, sudden, e->pace);
        flex_centrifugal_load((double *)c->p, e->all, w, m->p);
        add_hanging_turn(e, (double *)c->p, w, m->p);
    }
    for (int r = 0; r < e->o.nrigid; r++)
        if (e->forced[r]) add_case(e, e->recoils[r], FAMILY_RECOIL, sudden, e->pace)->rigid[r] = 1;
}

/* Of a further joint that goes along axis a, or turns about it, while the reference stands: inertia of the static
 * displacement that comes with it. */
static void add_give(struct evidence *e, const char *name, int node, int a, bool turns, const double *Me)
{
    const struct flex_node *o = &e->all->node[node];
    const double *rows = turns ? o->psi : o->phi, scale = turns ? 1 / e->length : 1;
    const int n = e->all->n;
    for (int c = e->all->inner; c < n; c++) {
        if (fabs(fabs(rows[a + 3 * c]) - 1) > SAME) continue;
        struct flex_case *to = add_case(e, name, FAMILY_INERTIA, true, 0);
        for (int k = 0; k < n; k++) ((double *)to->p)[k] = -scale * Me[k + n * c];
        for (int r = 0; r < e->o.nrigid; r++) {
            double *p = TAKE(e->b->life, double, n);
            flex_inertia_load(p, e->all, e->recoil[r]);
            to->rigid[r] = scale * p[c];
        }
        return;
    }
}

/* Where flexible bodies hang on it, or it hangs on them, and nothing closes a loop. */
static void add_gives(struct evidence *e)
{
    const struct scene *s = e->b->scene;
    double *Me = TAKE_MATRIX(e->b->life, double, e->all->n, e->all->n);
    flex_mass(Me, e->all);
    for (int i = 0; i < s->njoint; i++) {
        const struct scene_joint *j = &s->joint[i];
        double offset[3];
        if (j->nterm || (j->first != e->index && j->second != e->index)) continue;
        const int node = scene_node(offset, e->body, j->first == e->index ? j->from : j->at);
        if (node == e->all->reference) continue;
        for (int a = 0; a < s->space; a++) add_give(e, j->name, node, a, false, Me);
        for (int a = s->space == 2 ? 2 : 0; a < 3; a++) add_give(e, j->name, node, a, true, Me);
    }
}

static void add_gravity_along(struct evidence *e, const double *g)
{
    double d[6] = {0};
    bool sudden = !e->at_rest || (e->free && !e->smooth);
    for (int i = 0; i < e->nmotion; i++) sudden = sudden || (e->motion[i].turns && e->motion[i].rate[0] > 0);
    if (v3_norm(g) == 0) return;
    m3_tmul(d, e->body->R, g);
    v3_scale(d, 1 / v3_norm(g), d);
    fill_inertia(e, add_case(e, "gravity", FAMILY_INERTIA, sudden, e->pace), d);
}

static void add_gravity(struct evidence *e)
{
    const double *g = e->b->scene->gravity;
    add_gravity_along(e, g);
    for (int i = 0; i < e->nmotion; i++) {
        double axis[3], across[3];
        if (!e->motion[i].turns) continue;
        m3_mul(axis, e->body->R, e->motion[i].axis);
        v3_cross(across, axis, g);
        add_gravity_along(e, across);
    }
}

/* Of a force or moment along x (body axes) at a node, `offset` from it. */
static void add_load(struct evidence *e, const char *name, int family, int node, const double *offset, const double *x,
                     bool torque, bool sudden, double omega)
{
    const struct flex_node *o = &e->all->node[node];
    double moment[3] = {0, 0, 0}, lever[3], at[3], h[3];
    if (node == e->all->reference && e->o.nrigid == 0) return;
    if (!torque) v3_cross(moment, offset, x);
    struct flex_case *c = add_case(e, name, family, sudden, omega);
    double *p = (double *)c->p;
    for (int k = 0; k < e->all->n; k++)
        p[k] = torque ? v3_dot(o->psi + 3 * k, x) : v3_dot(o->phi + 3 * k, x) + v3_dot(o->psi + 3 * k, moment);
    v3_diff(lever, o->x, e->all->node[e->all->reference].x);
    v3_add(lever, offset);
    for (int r = 0; r < e->o.nrigid; r++) {
        const double *d = e->recoil[r];
        v3_cross(h, d + 3, lever);
        v3_copy(at, d);
        v3_add(at, h);
        c->rigid[r] = v3_dot(torque ? d + 3 : at, x);
    }
}

/* May the body turn so that a direction that the world keeps, x in its axes, comes along y? */
static bool may_come_along(const struct evidence *e, const double *x, const double *y)
{
    static const double PARALLEL = 1e-9;
    const double *axis = NULL;
    double across[3];
    if (e->any) return true;
    for (int i = 0; i < e->nmotion; i++) {
        if (!e->motion[i].turns) continue;
        if (!axis) axis = e->motion[i].axis;
        v3_cross(across, axis, e->motion[i].axis);
        if (v3_norm(across) > PARALLEL) return true;
    }
    if (!axis) return fabs(v3_dot(x, y)) > PARALLEL;
    v3_cross(across, axis, x);
    const bool turned = v3_norm(across) > PARALLEL, along = fabs(v3_dot(axis, x)) > PARALLEL;
    v3_cross(across, axis, y);
    return (turned && v3_norm(across) > PARALLEL) || (along && fabs(v3_dot(axis, y)) > PARALLEL);
}

/* Along the axes of the space at a place of the world that `along` (body axes; NULL: any) may come along. */
static void add_loads_at(struct evidence *e, const char *name, int family, const double *world, const double *along,
                         bool torque, bool sudden, double omega)
{
    double offset[3];
    const int node = scene_node(offset, e->body, world), space = e->b->scene->space;
    for (int i = 0; i < 3; i++) {
        const double x[3] = {i == 0, i == 1, i == 2};
        if (space == 2 && torque != (i == 2)) continue;
        if (along && !may_come_along(e, along, x)) continue;
        add_load(e, name, family, node, offset, x, torque, sudden, omega);
    }
}

/* Of a load its components; where the body turns against their axes, all. */
static void add_components(struct evidence *e, const struct scene_force *f, int family, const double *world)
{
    double offset[3], pace = 0;
    const int node = scene_node(offset, e->body, world);
    bool jumps = f->nslot > 1;
    for (int i = 0; i < 3; i++)
        if (!jumps && !signal_is_zero(&f->value[i])) pace = fmax(pace, pace_of(&f->value[i], 0, e->o.span, &jumps));
    const bool sudden = jumps || !e->at_rest;
    for (int i = 0; i < 3; i++) {
        double x[3] = {i == 0, i == 1, i == 2}, axis[3];
        if (signal_is_zero(&f->value[i])) continue;
        m3_tmul(axis, e->body->R, x);
        if (!f->body_axes && !e->still)
            add_loads_at(e, f->name, family, world, axis, f->torque, sudden, pace);
        else
            add_load(e, f->name, family, node, offset, f->body_axes ? x : axis, f->torque, sudden, pace);
    }
}

static void add_forces(struct evidence *e)
{
    const struct scene *s = e->b->scene;
    for (int i = 0; i < s->nforce; i++) {
        const struct scene_force *f = &s->force[i];
        const struct scene_measure *m = f->measure >= 0 ? &s->measure[f->measure] : NULL;
        const struct marker *ends[2] = {m ? &m->a : &f->a, m ? &m->b : &f->b};
        if (m && m->type == MEASURE_COORDINATE) continue;
        for (int side = 0; side < 2; side++) {
            double world[3];
            if (ends[side]->body != e->index) continue;
            marker_drawn(world, s, ends[side]);
            if (f->type == FORCE_LOAD) {
                if (side == 1) add_components(e, f, FAMILIES + i, world);
                continue;
            }
            const bool angle = m && m->type == MEASURE_ANGLE;
            add_loads_at(e, f->name, FAMILIES + i, world, NULL, angle, true, 0);
            if (!m) add_loads_at(e, f->name, FAMILIES + i, world, NULL, true, true, 0);
        }
    }
}

/* Of a body that has no static displacements by themselves what its further joints do to it are loads. */
static void add_joint_loads(struct evidence *e)
{
    const struct scene *s = e->b->scene;
    for (int i = 0; i < s->njoint && e->all->n == e->all->inner; i++) {
        const struct scene_joint *j = &s->joint[i];
        double offset[3];
        if (j->nterm || (j->first != e->index && j->second != e->index)) continue;
        const double *world = j->first == e->index ? j->from : j->at;
        if (scene_node(offset, e->body, world) == e->all->reference) continue;
        add_loads_at(e, j->name, FAMILY_JOINTS, world, NULL, false, false, e->pace);
        if (joint_is_fixed(j->kind)) add_loads_at(e, j->name, FAMILY_MOMENTS, world, NULL, true, false, e->pace);
    }
}

void add_cases(struct evidence *e)
{
    add_joint_loads(e);
    add_inertia(e);
    add_gives(e);
    add_gravity(e);
    add_forces(e);
}
