/* floating.c -- see floating.h */
#include "system/floating.h"

#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/vec3.h"

/* --- what floats -------------------------------------------------------------------------------- */

static bool travels(const struct model *m, const struct model_joint *j)
{
    return j->parent == 0 && (j->type == JOINT_FREE || (m->space == 2 && j->type == JOINT_PLANAR));
}

/* Loop l ties what its root's joint moves. */
static bool ties(const struct model *m, const struct model_loop *l, const int *root, int body)
{
    for (int i = 0; i < l->nterm; i++)
        if (m->joint[l->term[i].joint].child == body) return true;
    return l->nterm == 0 && (root[l->first] == body) != (root[l->second] == body);
}

static bool is_tied(const struct model *m, const int *root, int body)
{
    for (int i = 0; i < m->nloop; i++)
        if (ties(m, &m->loop[i], root, body)) return true;
    return false;
}

static bool has_mass(const struct model_body *b)
{
    return !b->at_node && (b->flex || b->mass > 0 || b->inertia[2] > 0);
}

/* One body held in its centre. */
static bool is_plain(const struct model *m, const struct floater *f)
{
    const struct model_body *b = &m->body[f->body[0]];
    return f->n == 1 && !b->flex && v3_norm(m->joint[b->joint].b) == 0;
}

static void list(struct floater *f, const struct model *m, const int *root, int body, struct arena *life)
{
    f->n = 0;
    f->body = TAKE(life, int, m->nbody);
    for (int i = body; i < m->nbody; i++)
        if (root[i] == body && (i == body || has_mass(&m->body[i]))) f->body[f->n++] = i;
}

/* A sweep whose FAST bodies are those that float. */
static struct sweep *build_there(const struct floating *o, const struct model *m, const int *root, struct arena *life)
{
    struct model *copy = TAKE(life, struct model, 1);
    struct model_body *body = TAKE(life, struct model_body, m->nbody);
    *copy = *m;
    copy->body = body;
    copy->nforce = 0;
    memcpy(body, m->body, sizeof *body * (size_t)m->nbody);
    for (int i = 0; i < m->nbody; i++) body[i].fast = false;
    for (int k = 0; k < o->n; k++)
        for (int i = 0; i < m->nbody; i++) body[i].fast |= root[i] == o->part[k].body[0];
    return o->ops->build(copy, life);
}

/* Directions in which the displacements of its root move it. */
static void find_travel(struct floating *o, struct floater *f, const struct model *m)
{
    const struct model_joint *j = &m->joint[m->body[f->body[0]].joint];
    f->ntravel = m->space;
    f->travel = j->iq;
    for (int k = 0; k < f->ntravel; k++) {
        double w[3];
        o->ops->partial(o->there, f->e[k], w, f->body[0], m->body[f->body[0]].at, j->iv[k]);
    }
}

static void take_memory(struct floating *o, struct arena *life)
{
    for (int i = 0; i < 2; i++) {
        o->q[i] = TAKE(life, double, o->nq);
        o->v[i] = TAKE(life, double, o->nv);
    }
    o->try = TAKE(life, double, o->nq);
    o->at = TAKE(life, double, o->nq);
    o->to = TAKE(life, double, o->nq);
}

void floating_build(struct floating *o, const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    int *root = TAKE(life, int, m->nbody);
    *o = (struct floating){.ops = ops, .nq = m->nq, .nv = m->n, .part = TAKE(life, struct floater, m->nbody)};
    for (int i = 1; i < m->nbody; i++) root[i] = m->body[i].parent == 0 ? i : root[m->body[i].parent];
    for (int i = 1; i < m->nbody; i++) {
        if (!travels(m, &m->joint[m->body[i].joint]) || is_tied(m, root, i)) continue;
        list(&o->part[o->n], m, root, i, life);
        o->n += !is_plain(m, &o->part[o->n]);
    }
    if (o->n == 0) return;
    o->there = build_there(o, m, root, life);
    ops->move(o->there, m->q0, m->v0, FAST);
    for (int i = 0; i < o->n; i++) find_travel(o, &o->part[i], m);
    take_memory(o, life);
}

/* --- the ends of the step ----------------------------------------------------------------------- */

static bool is_at(const struct floating *o, int end, const double *v)
{
    return o->known[end] && memcmp(o->q[end], o->try, sizeof *v * (size_t)o->nq) == 0 &&
           memcmp(o->v[end], v, sizeof *v * (size_t)o->nv) == 0;
}

/* Momenta at q, v; a step starts where the last one has ended. */
static void look(struct floating *o, int end, const double *q, const double *v)
{
    memcpy(o->try, q, sizeof *q * (size_t)o->nq);
    for (int i = 0; i < o->n; i++)
        for (int k = 0; k < o->part[i].ntravel; k++) o->try[o->part[i].travel[k]] = 0;
    if (is_at(o, end, v)) return;
    const bool same = is_at(o, 1 - end, v);
    memcpy(o->q[end], o->try, sizeof *q * (size_t)o->nq);
    memcpy(o->v[end], v, sizeof *v * (size_t)o->nv);
    if (!same) o->ops->move(o->there, o->try, v, FAST);
    for (int i = 0; i < o->n; i++) {
        struct floater *f = &o->part[i];
        if (same)
            f->end[end] = f->end[1 - end];
        else
            o->ops->momentum(o->there, &f->end[end], f->body, f->n);
    }
    o->known[end] = true;
}

static void look_at_ends(struct floating *o, const struct instant *x)
{
    look(o, 0, x->qa, x->va);
    look(o, 1, x->qb, x->vb);
}

/* --- the centre of mass ------------------------------------------------------------------------- */

static void centre(double *c, const struct floater *f, int end, const double *q)
{
    v3_copy(c, f->end[end].c);
    for (int k = 0; k < f->ntravel; k++) v3_axpy(c, q[f->travel[k]], f->e[k]);
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

static void travel(double *q, const struct floater *f, double s, const double *d)
{
    for (int k = 0; k < f->ntravel; k++) q[f->travel[k]] += s * v3_dot(f->e[k], d);
}

void floating_place(struct floating *o, struct instant *settled, const struct instant *x)
{
    look_at_ends(o, x);
    *settled = *x;
    settled->q = memcpy(o->at, x->q, sizeof *o->at * (size_t)o->nq);
    settled->qb = memcpy(o->to, x->qb, sizeof *o->to * (size_t)o->nq);
    for (int i = 0; i < o->n; i++) {
        double d[3];
        left_behind(d, &o->part[i], x);
        travel(o->at, &o->part[i], .5, d);
        travel(o->to, &o->part[i], 1, d);
    }
}

void floating_settle(struct floating *o, double *q1, const struct instant *x)
{
    look_at_ends(o, x);
    for (int i = 0; i < o->n; i++) {
        double d[3];
        left_behind(d, &o->part[i], x);
        travel(q1, &o->part[i], 1, d);
    }
}

/* --- the balances ------------------------------------------------------------------------------- */

/* x := J^-1 x; NAN where J is singular: nothing turns about an axis then. */
static void solve(double *x, const double *J)
{
    double A[9] = {J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2]};
    if (dense_cholesky(A, 3, 3) >= 0)
        v3_set(x, NAN, NAN, NAN);
    else
        dense_cholesky_solve(A, x, 3, 3);
}

void floating_balance(struct floating *o, struct sweep *s, const struct instant *x)
{
    const double per = 1 / (x->tb - x->ta);
    for (int i = 0; i < o->n; i++) {
        const struct floater *f = &o->part[i];
        const struct bulk *a = &f->end[0], *b = &f->end[1];
        struct bulk now;
        double da[3], al[3];
        o->ops->inertia(s, &now, f->body, f->n);
        for (int k = 0; k < 3; k++) {
            da[k] = (per * (b->p[k] - a->p[k]) - now.p[k]) / now.m;
            al[k] = per * (b->L[k] - a->L[k]) - now.L[k];
        }
        solve(al, now.J);
        o->ops->hasten(s, f->body, f->n, now.c, da, al);
    }
}
