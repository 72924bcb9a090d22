/* floating.c -- see floating.h */
#include "open/floating.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "model/touch.h"

static const double FADES = 1e-8; /* what is left of T there, which is good to 16 digits */
static const double MOST = .1; /* of the motion of the bodies against the whole may change in a step for the energy */

/* --- what floats -------------------------------------------------------------------------------- */

/* Does it let its body move anyhow?  Its displacements come first. */
static bool travels(const struct model *m, const struct model_joint *j)
{
    return j->nv == (m->space == 2 ? 3 : 6);
}

/* Of the bodies that hang on the ground: [nbody]. */
struct roots {
    int *of;               /* each body's root; the ground's is 0 */
    int *count;            /* bodies that have it */
    bool *tied, *from_out; /* by a loop; a force acts on it from outside */
};

/* a, b: bodies that something stands between. */
static void part(bool *mark, const struct roots *r, int a, int b)
{
    if (r->of[a] == r->of[b]) return;
    mark[r->of[a]] = mark[r->of[b]] = true;
}

static void mark_loops(struct roots *r, const struct model *m)
{
    for (int i = 0; i < m->nloop; i++) {
        const struct model_loop *l = &m->loop[i];
        for (int k = 0; k < l->nterm; k++) part(r->tied, r, m->joint[l->term[k].joint].parent, l->term[k].joint + 1);
        if (l->nterm == 0) part(r->tied, r, l->first, l->second);
    }
}

/* By what they act on.  joint [n]: the one whose velocity it is; -1: of a mode. */
static void mark_forces(struct roots *r, const struct model *m, const int *joint)
{
    for (int i = 0; i < m->nforce; i++) {
        struct touched t;
        model_touched(&t, m, &m->force[i], 0);
        if (t.a >= 0)
            part(r->from_out, r, t.a, t.b);
        else if (joint[t.iv] >= 0)
            part(r->from_out, r, m->joint[joint[t.iv]].parent, m->joint[joint[t.iv]].child);
    }
}

static void find_roots(struct roots *r, const struct model *m, struct arena *life)
{
    int *joint = TAKE(life, int, m->n);
    *r = (struct roots){TAKE(life, int, m->nbody), TAKE(life, int, m->nbody), TAKE(life, bool, m->nbody),
                        TAKE(life, bool, m->nbody)};
    for (int i = 1; i < m->nbody; i++) {
        r->of[i] = m->body[i].parent == 0 ? i : r->of[m->body[i].parent];
        r->count[r->of[i]]++;
    }
    for (int i = 0; i < m->n; i++) joint[i] = -1;
    for (int i = 0; i < m->njoint; i++)
        for (int k = 0; k < m->joint[i].nv; k++) joint[m->joint[i].iv[k]] = i;
    mark_loops(r, m);
    mark_forces(r, m, joint);
}

/* More than one body held in its centre. */
static bool floats(const struct model *m, const struct roots *r, int body)
{
    const struct model_body *b = &m->body[body];
    const struct model_joint *j = &m->joint[b->joint];
    if (b->parent != 0 || !travels(m, j) || r->tied[body]) return false;
    return r->count[body] > 1 || b->flex || v3_norm(j->b) > 0;
}

static bool is_by_itself(const struct model *m, const struct roots *r, int body)
{
    return r->of[body] == body && r->count[body] == 1 && !r->tied[body] && !r->from_out[body] && tumbles(m, body);
}

static void list_bodies(struct floating *o, const struct roots *r, struct arena *life)
{
    const struct model *m = o->model;
    struct floater **of = TAKE(life, struct floater *, m->nbody);
    o->part = TAKE(life, struct floater, m->nbody);
    o->tumbler = TAKE(life, struct tumbler, m->nbody);
    for (int i = 1; i < m->nbody; i++) {
        if (is_by_itself(m, r, i)) tumbler_make(&o->tumbler[o->ntumbler++], m, i);
        if (floats(m, r, i)) {
            of[i] = &o->part[o->n++];
            *of[i] = (struct floater){.body = TAKE(life, int, r->count[i]), .alone = !r->from_out[i]};
        }
        struct floater *f = of[r->of[i]];
        if (f) f->body[f->n++] = i;
    }
}

/* A sweep whose FAST bodies are those that float; what has no mass at their nodes adds nothing. */
static struct sweep *build_there(const struct floating *o, struct arena *life)
{
    const struct model *m = o->model;
    bool *bodies = TAKE(life, bool, m->nbody);
    for (int i = 0; i < o->n; i++)
        for (int k = 0; k < o->part[i].n; k++) bodies[o->part[i].body[k]] = !m->body[o->part[i].body[k]].at_node;
    return o->ops->build(m, FOR_STEPS, bodies, life);
}

/* The root's velocities, and how its displacements move it. */
static void find_root(struct floating *o, struct floater *f)
{
    const struct model *m = o->model;
    const struct model_joint *j = &m->joint[m->body[f->body[0]].joint];
    f->nv = j->nv;
    f->nslide = m->space;
    f->slide = j->iq;
    f->iv = j->iv;
    v3_copy(f->hung, m->body[0].at);
    m3_mul_add(f->hung, m->body[0].R, j->a);
    for (int k = 0; k < f->nslide; k++) {
        double w[3];
        o->ops->partial(o->there, f->e[k], w, f->body[0], f->hung, j->iv[k]);
        o->still[f->slide[k]] = 0;
    }
}

static void take_memory(struct floating *o, struct arena *life)
{
    for (int i = 0; i < 2; i++) {
        o->q[i] = TAKE(life, double, o->model->nq);
        o->v[i] = TAKE(life, double, o->model->n);
    }
    o->still = TAKE(life, double, o->model->nq);
    o->at = TAKE(life, double, o->model->nq);
    o->to = TAKE(life, double, o->model->nq);
    o->moving = TAKE(life, double, o->model->n);
}

void floating_build(struct floating *o, const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    struct roots roots;
    find_roots(&roots, m, life);
    *o = (struct floating){.model = m, .ops = ops};
    list_bodies(o, &roots, life);
    if (o->n == 0) return;
    take_memory(o, life);
    o->there = build_there(o, life);
    ops->move(o->there, m->q0, m->v0, FAST);
    for (int i = 0; i < m->nq; i++) o->still[i] = 1;
    for (int i = 0; i < o->n; i++) find_root(o, &o->part[i]);
}

/* --- the ends of the step ----------------------------------------------------------------------- */

static bool is_at(const struct floating *o, int end, const double *q, const double *v)
{
    if (!o->known[end]) return false;
    for (int i = 0; i < o->model->nq; i++)
        if (o->q[end][i] != o->still[i] * q[i]) return false;
    for (int i = 0; i < o->model->n; i++)
        if (o->v[end][i] != v[i]) return false;
    return true;
}

static void keep(struct floating *o, int end, const double *q, const double *v)
{
    for (int i = 0; i < o->model->nq; i++) o->q[end][i] = o->still[i] * q[i];
    for (int i = 0; i < o->model->n; i++) o->v[end][i] = v[i];
    o->known[end] = true;
}

static void sample(struct floating *o, int end, const double *q, const double *v)
{
    keep(o, end, q, v);
    o->ops->move(o->there, o->q[end], o->v[end], FAST);
    for (int i = 0; i < o->n; i++)
        o->ops->aggregate(o->there, &o->part[i].end[end], o->part[i].body, o->part[i].n, AGGREGATE_MOTION);
}

/* A step starts where the last one has ended. */
static void sample_start(struct floating *o, const double *q, const double *v)
{
    if (is_at(o, 0, q, v)) return;
    if (!is_at(o, 1, q, v)) {
        sample(o, 0, q, v);
        return;
    }
    keep(o, 0, q, v);
    for (int i = 0; i < o->n; i++) o->part[i].end[0] = o->part[i].end[1];
}

static void sample_ends(struct floating *o, const struct instant *x)
{
    sample_start(o, x->qa, x->va);
    sample(o, 1, x->qb, x->vb);
}

/* --- the centre of mass ------------------------------------------------------------------------- */

static void centre(double *c, const struct floater *f, int end, const double *q)
{
    v3_copy(c, f->end[end].c);
    for (int k = 0; k < f->nslide; k++) v3_axpy(c, q[f->slide[k]], f->e[k]);
}

/* How far c_a + h (p_a + p_b)/(2 m) is from the centre at qb. */
static void left_behind(double *d, const struct floater *f, const struct instant *x)
{
    const double half = .5 * (x->tb - x->ta) / f->end[0].m;
    double c[3];
    centre(c, f, 1, x->qb);
    centre(d, f, 0, x->qa);
    v3_axpy(d, half, f->end[0].p);
    v3_axpy(d, half, f->end[1].p);
    v3_take(d, c);
}

static void slide(double *q, const struct floater *f, const double *d)
{
    for (int k = 0; k < f->nslide; k++) q[f->slide[k]] += v3_dot(f->e[k], d);
}

void floating_place(struct floating *o, struct instant *settled, const struct instant *x)
{
    sample_ends(o, x);
    *settled = *x;
    settled->q = memcpy(o->at, x->q, sizeof *o->at * (size_t)o->model->nq);
    settled->v = memcpy(o->moving, x->v, sizeof *o->moving * (size_t)o->model->n);
    settled->qb = memcpy(o->to, x->qb, sizeof *o->to * (size_t)o->model->nq);
    for (int i = 0; i < o->n; i++) {
        double d[3];
        left_behind(d, &o->part[i], x);
        slide(o->to, &o->part[i], d);
    }
}

/* --- the balances ------------------------------------------------------------------------------- */

/* The rate at which motion against the whole, of kinetic energy T_rel, must grow for the energy `missing` per unit
 * time. Both vanish with that motion; where it turns round within a step they say little of each other, and where it is
 * hardly there round-off of T says nothing. */
static double stretch(double missing, double T_rel, double T, double h)
{
    const double least = FADES * T, twice = 2 * T_rel, size = twice * twice + least * least;
    const double k = size > 0 ? missing * twice / size : 0, much = MOST / (h * k);
    return fabs(much) < 1 ? k * much * much : k;
}

/* What is missing from now to the change from a to b, per unit time. */
static void find_change(struct motion_change *o, const struct aggregate *now, const struct floater *f,
                        const struct instant *x)
{
    const struct aggregate *a = &f->end[0], *b = &f->end[1];
    const double h = x->tb - x->ta, per = 1 / h;
    double Jinv[6], w[3], L[3], ca[3], cb[3];
    centre(ca, f, 0, x->qa);
    centre(cb, f, 1, x->qb);
    for (int k = 0; k < 3; k++) {
        o->dr[k] = .5 * (ca[k] + cb[k]) - now->c[k];
        o->dv[k] = (.5 * (a->p[k] + b->p[k]) - now->p[k]) / now->m;
        o->a[k] = (per * (b->p[k] - a->p[k]) - now->F[k]) / now->m;
        L[k] = per * (b->L[k] - a->L[k]) - now->N[k];
    }
    s3_invert(Jinv, now->J); /* not finite where nothing turns about an axis */
    s3_mul(w, Jinv, now->L);
    s3_mul(o->al, Jinv, L);
    const double missing = per * (b->T - a->T) - now->W - v3_dot(o->al, now->L);
    o->k = x->jump ? 0 : stretch(missing, now->T - .5 * v3_dot(w, now->L), now->T, h);
    v3_axpy(o->al, -o->k, w);
}

void floating_balance(struct floating *o, struct sweep *s, const struct instant *x)
{
    for (int i = 0; i < o->n; i++) {
        const struct floater *f = &o->part[i];
        struct aggregate now;
        struct motion_change change;
        o->ops->aggregate(s, &now, f->body, f->n, AGGREGATE_FORCES);
        find_change(&change, &now, f, x);
        o->ops->adjust_motion(s, &change, &now, f->body, f->n);
        slide(o->at, f, change.dr);
        for (int k = 0; k < f->nslide; k++) o->moving[f->iv[k]] += v3_dot(f->e[k], change.dv);
    }
}

/* Velocities of the root for the velocity dv of the centre, and for turning by w about it; stands at end 1. */
static void push_root(const struct floating *o, double *v, const struct floater *f, const double *dv, const double *w)
{
    double arm[3], d[3];
    v3_diff(arm, f->hung, f->end[1].c);
    v3_copy(d, dv);
    v3_cross_add(d, w, arm);
    for (int k = 0; k < f->nv; k++) {
        double x[3], axis[3];
        o->ops->partial(o->there, x, axis, f->body[0], f->hung, f->iv[k]);
        v[f->iv[k]] += k < f->nslide ? v3_dot(f->e[k], d) : v3_dot(axis, w);
    }
}

/* p_b = p_a + h m g, L_b = L_a: what the iteration has left of that is far below what the step is good for. */
static void finish(struct floating *o, double *v1, struct floater *f, double h)
{
    const struct aggregate *a = &f->end[0];
    struct aggregate *b = &f->end[1];
    double dv[3], dL[3], w[3], Jinv[6];
    o->ops->aggregate(o->there, b, f->body, f->n, AGGREGATE_INERTIA);
    for (int k = 0; k < 3; k++) dv[k] = (a->p[k] - b->p[k]) / b->m + h * o->model->gravity[k];
    v3_diff(dL, a->L, b->L);
    s3_invert(Jinv, b->J);
    s3_mul(w, Jinv, dL);
    if (!isfinite(v3_dot(dv, dv) + v3_dot(w, w))) return;
    push_root(o, v1, f, dv, w);
    v3_axpy(b->p, b->m, dv);
}

void floating_settle(struct floating *o, double *q1, double *v1, const struct instant *x)
{
    for (int i = 0; i < o->ntumbler; i++) tumbler_settle(&o->tumbler[i], q1, v1, x);
    if (o->n) sample_ends(o, x);
    for (int i = 0; i < o->n; i++) {
        struct floater *f = &o->part[i];
        double d[3];
        if (f->alone) {
            finish(o, v1, f, x->tb - x->ta);
            o->known[1] = false;
        }
        left_behind(d, f, x);
        slide(q1, f, d);
    }
}
