/* contact.c -- see contact.h */
#include "contact/contact.h"

#include <math.h>
#include <string.h>

#include "kind/outline.h"
#include "la/rot.h"
#include "la/vec3.h"

struct contacts {
    const struct model *model;
    const struct sweep_ops *ops;
    double *g; /* [n] work */
};

struct contacts *contacts_build(const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    struct contacts *o = TAKE(life, struct contacts, 1);
    *o = (struct contacts){m, ops, TAKE(life, double, m->n)};
    return o;
}

double contact_size(const struct model_contact *c, double length)
{
    if (c->angular) return 1;
    if (c->pair == PAIR_STOP || c->pair == PAIR_FRICTION) return length;
    return fmax(length, fmax(fmax(c->radius, c->other), fmax(v3_norm(c->a.p), v3_norm(c->b.p))));
}

/* ---- where they touch ---- */

struct place {
    double gap, n[3], c[3];
    double t[2][3]; /* across */
};

/* t[0] as `near` as can be, at right angles to n. */
static void across(struct place *o, const double *near, int space)
{
    static const double axes[2][3] = {{1, 0, 0}, {0, 1, 0}};
    if (space == 2) {
        const double t[3] = {o->n[1], -o->n[0], 0};
        v3_copy(o->t[0], t);
        return;
    }
    if (v3_dot(near, near) < .25) near = axes[fabs(o->n[0]) > .7];
    v3_copy(o->t[0], near);
    v3_axpy(o->t[0], -v3_dot(near, o->n), o->n);
    v3_scale(o->t[0], 1 / v3_norm(o->t[0]), o->t[0]);
    v3_cross(o->t[1], o->n, o->t[0]);
}

static void over_plane(struct place *o, const struct model_contact *c, const double *d, const double *xa,
                       const double *R)
{
    m3_mul(o->n, R, c->normal);
    o->gap = v3_dot(o->n, d) - c->radius;
    v3_copy(o->c, xa);
    v3_axpy(o->c, -c->radius, o->n);
}

static void of_spheres(struct place *o, const struct model_contact *c, const double *d, const double *xb)
{
    const double apart = v3_norm(d), side = c->pair == PAIR_HOLE ? -1 : 1;
    o->gap = side * (apart - c->other) - c->radius;
    v3_set(o->n, 0, 0, 0);
    o->n[0] = apart > 0 ? 0 : side;
    if (apart > 0) v3_axpy(o->n, side / apart, d);
    v3_copy(o->c, xb);
    v3_axpy(o->c, side * c->other, o->n);
}

static void over_outline(struct place *o, const struct model_contact *c, const double *d, const double *xa,
                         const double *R)
{
    double ex[3];
    m3_mul(ex, R, c->normal);
    o->gap = outline_meet(c->outline, o->n, ex, d) - c->radius;
    v3_copy(o->c, xa);
    v3_axpy(o->c, -c->radius, o->n);
}

static void find(struct place *o, const struct contacts *all, const struct sweep *s, const struct model_contact *c)
{
    double xa[3], xb[3], v[3], d[3], near[3] = {0};
    struct pose b;
    all->ops->point(s, xa, v, c->a.body, c->a.p);
    all->ops->point(s, xb, v, c->b.body, c->b.p);
    all->ops->pose(s, &b, c->b.body);
    v3_diff(d, xa, xb);
    if (c->pair == PAIR_PLANE)
        over_plane(o, c, d, xa, b.R);
    else if (c->pair == PAIR_OUTLINE)
        over_outline(o, c, d, xa, b.R);
    else
        of_spheres(o, c, d, xb);
    if (c->pair == PAIR_PLANE) m3_mul(near, b.R, c->along);
    if (c->across) across(o, near, all->model->space);
}

/* ---- rows and forces ---- */

double contacts_gap(const struct contacts *o, const struct sweep *s, int i, const double *q)
{
    const struct model_contact *c = &o->model->contact[i];
    struct place at;
    if (c->pair == PAIR_FRICTION) return 0;
    if (c->pair == PAIR_STOP) return c->side * (q[c->iq] - c->limit);
    find(&at, o, s, c);
    return at.gap;
}

/* y += scale times the row of the velocity of a body at x along dir, or of its turning about axis. */
static void add_body(const struct contacts *o, const struct sweep *s, double *y, int body, const double *x,
                     const double *dir, const double *axis, double scale)
{
    const int *k, n = o->ops->path(s, &k, body);
    o->ops->row(s, o->g, body, 0, x, dir, axis);
    for (int i = 0; i < n; i++) y[k[i]] += scale * o->g[i];
}

/* Where the joint of a loop stands, and its axis. */
static void loop_axis(const struct contacts *o, const struct sweep *s, double *x, double *e, const struct model_loop *l)
{
    double v[3];
    struct pose first;
    o->ops->point(s, x, v, l->second, l->b);
    o->ops->pose(s, &first, l->first);
    m3_mul(e, first.R, l->Ea + 6);
}

/* The rate of a joint's coordinate. */
static void joint_row(const struct contacts *o, const struct sweep *s, double *y, const struct model_contact *c)
{
    if (c->iv >= 0) {
        y[c->iv] = 1;
        return;
    }
    const struct model_loop *l = &o->model->loop[c->loop];
    double x[3], e[3];
    loop_axis(o, s, x, e, l);
    add_body(o, s, y, l->second, x, c->angular ? NULL : e, c->angular ? e : NULL, 1);
    add_body(o, s, y, l->first, x, c->angular ? NULL : e, c->angular ? e : NULL, -1);
}

static void joint_push(const struct contacts *o, struct sweep *s, double *r, const struct model_contact *c, double f)
{
    if (c->iv >= 0) {
        r[c->iv] -= f;
        return;
    }
    const struct model_loop *l = &o->model->loop[c->loop];
    double x[3], e[3], back[3];
    loop_axis(o, s, x, e, l);
    v3_scale(e, f, e);
    v3_scale(back, -1, e);
    if (c->angular) {
        o->ops->twist(s, l->second, e);
        o->ops->twist(s, l->first, back);
    } else {
        o->ops->push(s, l->second, x, e);
        o->ops->push(s, l->first, x, back);
    }
}

void contacts_rows(const struct contacts *o, const struct sweep *s, double *y, int i)
{
    const struct model_contact *c = &o->model->contact[i];
    const size_t n = (size_t)o->model->n;
    struct place at;
    memset(y, 0, (size_t)contact_rows(c) * n * sizeof *y);
    if (c->pair == PAIR_STOP) {
        y[c->iv] = c->side;
        return;
    }
    if (c->pair == PAIR_FRICTION) {
        joint_row(o, s, y + n, c);
        return;
    }
    find(&at, o, s, c);
    for (int k = 0; k < contact_rows(c); k++) {
        const double *dir = k ? at.t[k - 1] : at.n;
        add_body(o, s, y + (size_t)k * n, c->a.body, at.c, dir, NULL, 1);
        add_body(o, s, y + (size_t)k * n, c->b.body, at.c, dir, NULL, -1);
    }
}

void contacts_push(const struct contacts *o, struct sweep *s, double *r, int i, const double *f)
{
    const struct model_contact *c = &o->model->contact[i];
    struct place at;
    double F[3], back[3];
    if (c->pair == PAIR_STOP) {
        r[c->iv] -= c->side * f[0];
        return;
    }
    if (c->pair == PAIR_FRICTION) {
        joint_push(o, s, r, c, f[1]);
        return;
    }
    find(&at, o, s, c);
    v3_copy(F, at.n);
    v3_scale(F, f[0], F);
    for (int k = 0; k < c->across; k++) v3_axpy(F, f[1 + k], at.t[k]);
    v3_copy(back, F);
    v3_scale(back, -1, back);
    o->ops->push(s, c->a.body, at.c, F);
    o->ops->push(s, c->b.body, at.c, back);
}
