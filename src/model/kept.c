/* kept.c -- what the modes that a beam keeps have of its bending by the motions and loads of the deck.
 *
 * Along the freedoms of the joints that carry it, gravity and the loads on it, in the drawn position; what is missing of a
 * direction that a drive, a force or a load asks for is reported (flex/statics.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "la/vec3.h"
#include "model/parts.h"

enum { MOST_UP = 4 };               /* joints with freedoms on the way to the ground that are looked at */
static const double ENOUGH = 0.5;   /* a smaller share is reported */
static const double MATTERS = 1e-4; /* of the softest direction: stiffer ones are not */

struct keeping {
    struct making *o;
    int capacity;
};

static void add(struct keeping *k, struct model_kept one)
{
    struct model *m = k->o->m;
    m->kept = arena_more(k->o->life, m->kept, m->nkept, &k->capacity, sizeof *m->kept);
    m->kept[m->nkept++] = one;
}

/* ---- motions ---- */

/* Does a drive or a force say how this rate moves, or a load move the body behind it? */
static bool is_asked(const struct making *o, int joint, int k)
{
    const struct model *m = o->m;
    const struct model_joint *j = &o->joint[joint];
    for (int i = model_first_drive(m); i < m->nloop; i++)
        if (m->measure[m->loop[i].measure].iv == j->iv[k]) return true;
    for (int i = 0; i < m->nforce; i++) {
        const struct model_force *f = &m->force[i];
        if (f->measure >= 0 && m->measure[f->measure].iv == j->iv[k]) return true;
        if (f->type == FORCE_LOAD && f->b.body == j->child) return true;
    }
    return false;
}

/* A motion v, w (world) at p of a rigid body in the directions of the flexible body's reference node. */
static void at_reference(double *d, const struct model_body *body, const double *v, const double *w, const double *p)
{
    double at[3], arm[3], x[3];
    m3_mul(at, body->R, body->flex->node[body->flex->reference].x);
    v3_add(at, body->at);
    v3_diff(arm, at, p);
    v3_cross(x, w, arm);
    v3_add(x, v);
    m3_tmul(d, body->R, x);
    m3_tmul(d + 3, body->R, w);
}

static void add_motion(struct keeping *k, int body, const char *name, bool asked, const double *d)
{
    struct model_kept one = {.body = body, .name = name, .asked = asked};
    if (flex_kept_of_motion(&one.kept, k->o->body[body].flex, d)) add(k, one);
}

static void add_joint(struct keeping *k, int body, int joint)
{
    static const double none[3] = {0, 0, 0};
    const struct making *o = k->o;
    const struct model_joint *j = &o->joint[joint];
    const struct model_body *parent = &o->body[j->parent];
    const struct joint_kind *kind = model_kind(o->m, j->type);
    double p[3], d[6];
    m3_mul(p, parent->R, j->a);
    v3_add(p, parent->at);
    for (int i = 0; i < j->nv; i++) {
        const struct freedom *f = &kind->freedom[i];
        double axis[3];
        m3_mul(axis, parent->R, j->Ea + 3 * f->axis);
        at_reference(d, &o->body[body], f->slides ? axis : none, f->turns ? axis : none, p);
        add_motion(k, body, arena_print(o->life, "%s.%s", j->name, f->ball ? f->v : f->q), is_asked(o, joint, i), d);
    }
}

static void add_joints(struct keeping *k, int body)
{
    const struct making *o = k->o;
    for (int i = body, up = 0; i > 0 && up < MOST_UP; i = o->body[i].parent)
        if (o->joint[o->body[i].joint].nv > 0) {
            add_joint(k, body, o->body[i].joint);
            up++;
        }
}

static void add_gravity(struct keeping *k, int body)
{
    static const double none[3] = {0, 0, 0};
    const struct model *m = k->o->m;
    double d[6];
    if (v3_norm(m->gravity) == 0) return;
    at_reference(d, &k->o->body[body], m->gravity, none, none);
    add_motion(k, body, "gravity", true, d);
}

/* ---- loads ---- */

/* The node of the body that a point is on; -1: of another body. */
static int node_of(const struct making *o, int body, const struct model_point *p)
{
    if (p->body == body) return o->body[body].flex->reference;
    return o->body[p->body].at_node && o->body[p->body].parent == body ? o->body[p->body].node : -1;
}

/* Along the axis (body axes) of those given of which least is kept. */
static void add_load(struct keeping *k, int body, const char *name, int node, double (*axis)[3], int naxis, bool torque)
{
    struct model_kept worst = {.body = body, .name = name, .asked = true};
    bool any = false;
    for (int i = 0; i < naxis; i++) {
        struct flex_kept kept;
        double d[6] = {0};
        v3_copy(d + (torque ? 3 : 0), axis[i]);
        if (!flex_kept_of_load(&kept, k->o->body[body].flex, node, d)) continue;
        if (any && kept.across >= worst.kept.across) continue;
        worst.kept = kept;
        any = true;
    }
    if (any) add(k, worst);
}

static void add_components(struct keeping *k, int body, const struct model_force *f)
{
    const struct model_body *b = &k->o->body[body];
    const int node = node_of(k->o, body, &f->b);
    double axis[3][3];
    int n = 0;
    for (int i = 0; i < 3 && node >= 0; i++) {
        double e[3] = {0, 0, 0};
        if (signal_is_zero(&f->value[i])) continue;
        e[i] = 1;
        if (f->body_axes)
            v3_copy(axis[n++], e);
        else
            m3_tmul(axis[n++], b->R, e);
    }
    if (node >= 0) add_load(k, body, f->name, node, axis, n, f->torque);
}

static void world_of(double *x, const struct making *o, const struct model_point *p)
{
    m3_mul(x, o->body[p->body].R, p->p);
    v3_add(x, o->body[p->body].at);
}

/* Along the line between two points. */
static void add_line(struct keeping *k, int body, const char *name, const struct model_point *a,
                     const struct model_point *b)
{
    double xa[3], xb[3], d[3], axis[1][3];
    world_of(xa, k->o, a);
    world_of(xb, k->o, b);
    v3_diff(d, xb, xa);
    if (v3_norm(d) == 0) return;
    v3_scale(d, 1 / v3_norm(d), d);
    m3_tmul(axis[0], k->o->body[body].R, d);
    for (int side = 0; side < 2; side++) {
        const int node = node_of(k->o, body, side ? b : a);
        if (node >= 0) add_load(k, body, name, node, axis, 1, false);
    }
}

static void add_loads(struct keeping *k, int body)
{
    const struct model *m = k->o->m;
    for (int i = 0; i < m->nforce; i++) {
        const struct model_force *f = &m->force[i];
        if (f->type == FORCE_LOAD)
            add_components(k, body, f);
        else if (f->measure >= 0 && m->measure[f->measure].type == MEASURE_DISTANCE)
            add_line(k, body, f->name, &m->measure[f->measure].a, &m->measure[f->measure].b);
    }
}

/* ---- what is missing ---- */

static bool is_missing(const struct model_kept *o)
{
    return o->asked && o->kept.across < ENOUGH && o->kept.weight >= MATTERS;
}

/* "4 bending z, 2 torsion" */
static void kinds(char *text, size_t size, const struct flex_body *o)
{
    int count[FLEX_MIXED + 1] = {0};
    size_t n = 0;
    *text = 0;
    for (int k = 0; k < o->n; k++) count[o->statics->kind[k]]++;
    for (int k = 0; k <= FLEX_MIXED && n < size; k++)
        if (count[k]) n += (size_t)snprintf(text + n, size - n, "%s%d %s", n ? ", " : "", count[k], flex_kind_name(k));
}

static void warn(const struct making *o, const struct scene_body *sb, int body)
{
    const struct node *at = node_find(sb->node, "modes");
    char names[200] = "", have[100];
    size_t n = 0;
    for (int i = 0; i < o->m->nkept && n < sizeof names; i++) {
        const struct model_kept *k = &o->m->kept[i];
        if (k->body == body && is_missing(k))
            n += (size_t)snprintf(names + n, sizeof names - n, "%s%.40s (%.0f %%)", n ? ", " : "", k->name,
                                  floor(100 * k->kept.across));
    }
    if (n == 0) return;
    diag_warn(o->diags, at ? at : sb->node, at ? AT_VALUE : AT_KEY, "W-kept",
              "body '%.60s': its modes keep less than half of how it bends by %s", sb->node->key, names);
    kinds(have, sizeof have, sb->flex);
    diag_hint(o->diags, "they are %s; take more, or at a load a point with 'static: true'", have);
}

void make_kept(struct making *o)
{
    struct keeping k = {.o = o};
    for (int i = 1; i < o->scene->nbody; i++) {
        const int body = o->body_of[i];
        const struct flex_body *flex = o->body[body].flex;
        if (!flex || !flex->statics || !flex->statics->node) continue;
        add_joints(&k, body);
        add_gravity(&k, body);
        add_loads(&k, body);
    }
    for (int i = 1; i < o->scene->nbody; i++) {
        const struct scene_body *sb = &o->scene->body[i];
        if (sb->flex && sb->node && o->scene->body[i - 1].node != sb->node) warn(o, sb, o->body_of[i]);
    }
}
