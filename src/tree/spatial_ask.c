/* spatial_ask.c -- what elements ask of the spatial recursion and give to it; energies, reactions */
#include <string.h>

#include "tree/spatial.h"

/* From the centre to the point p of body axes, world axes. */
static inline void offset(double *d, const struct sweep *s, int body, const double *p)
{
    double inner[3];
    m3_tmul(inner, s->link[body].turned, p);
    m3_mul(d, s->part[body].R, inner);
}

void spatial_point(const struct sweep *s, double *x, double *xv, int body, const double *p)
{
    const struct part *b = &s->part[body];
    double d[3];
    offset(d, s, body, p);
    v3_sum(x, b->r, d);
    v3_copy(xv, b->v);
    v3_cross_add(xv, b->w, d);
}

void spatial_at(const struct sweep *s, struct pose *o, int body)
{
    v3_copy(o->r, s->part[body].r);
}

void spatial_stand(const struct sweep *s, struct pose *o, int body)
{
    const struct part *b = &s->part[body];
    m3_mulmt(o->R, b->R, s->link[body].turned);
    spatial_at(s, o, body);
}

void spatial_stir(const struct sweep *s, struct pose *o, int body)
{
    static const double none[3];
    const struct part *b = &s->part[body];
    v3_copy(o->v, b->v);
    v3_copy(o->w, b->w);
    v3_copy(o->al, s->accelerated ? b->al : none);
    if (s->accelerated)
        v3_sum(o->a, b->a, s->model->gravity);
    else
        v3_copy(o->a, none);
}

void spatial_pose(const struct sweep *s, struct pose *o, int body)
{
    spatial_stand(s, o, body);
    spatial_stir(s, o, body);
    o->angle = 0;
}

void spatial_push(struct sweep *s, int body, const double *x, const double *f)
{
    struct part *b = &s->part[body];
    double d[3];
    v3_diff(d, b->r, x);
    v3_take(b->F, f);
    v3_cross_add(b->N, d, f);
}

void spatial_twist(struct sweep *s, int body, const double *n)
{
    v3_take(s->part[body].N, n);
}

/* Of the j-th coordinate of a flexible body. */
static void partial_flexible(const struct sweep *s, double *xv, double *w, int body, const double *x,
                             const struct flexible *f, int j)
{
    struct twist u;
    double d[3];
    int node = spatial_node_body_below(s, f, body);
    if (!node) return;
    spatial_node_body_unit(&u, &s->node_body[node], j);
    v3_diff(d, x, s->part[node].r);
    v3_copy(w, u.w);
    v3_copy(xv, u.v);
    v3_cross_add(xv, w, d);
}

void spatial_partial(const struct sweep *s, double *xv, double *w, int body, const double *x, int k)
{
    int o = s->routes.owner[k];
    const struct part *p = &s->part[o];
    v3_set(xv, 0, 0, 0);
    v3_set(w, 0, 0, 0);
    if (!routes_above(&s->routes, o, body)) return;
    if (s->routes.local[k] >= s->link[o].nv) {
        partial_flexible(s, xv, w, body, x, s->flexible_of[o], s->routes.local[k] - s->link[o].nv);
        return;
    }
    const struct link *l = &s->link[o];
    const int i = s->routes.local[k];
    const double *e = spatial_axis(p, l, i);
    if (l->along[i] != 0) v3_scale(xv, l->along[i], e);
    if (!l->turns[i]) return;
    double d[3];
    v3_diff(d, x, p->r);
    v3_add(d, p->c);
    v3_copy(w, e);
    v3_cross_add(xv, e, d);
}

/* Rows of a joint, [nv]: f at the joint's point, its moment there. */
static void joint_row(double *g, const struct part *p, const struct link *l, const double *x, const double *f,
                      const double *n)
{
    double arm[3], moment[3];
    v3_diff(arm, x, p->r);
    v3_add(arm, p->c);
    v3_copy(moment, n);
    v3_cross_add(moment, arm, f);
    for (int k = 0; k < l->nv; k++) g[k] = spatial_power(p, l, k, f, moment);
}

static void node_body_row(double *g, const struct part *p, const struct node_body *o, const double *x, const double *f,
                          const double *n)
{
    double arm[3], moment[3], F[3], N[3];
    v3_diff(arm, x, p->r);
    v3_copy(moment, n);
    v3_cross_add(moment, arm, f);
    m3_tmul(F, o->on->R, f);
    m3_tmul(N, o->on->R, moment);
    for (int k = 0; k < o->on->n; k++) g[k] = spatial_node_body_row(o, k, F, N);
}

void spatial_row(const struct sweep *s, double *g, int body, int from, const double *x, const double *f,
                 const double *n)
{
    static const double none[3];
    if (!f) f = none;
    if (!n) n = none;
    for (int at = s->routes.npath[body] - from; at > 0; body = s->link[body].parent) {
        const struct node_body *node_body = spatial_node_body(s, body);
        at -= node_body ? node_body->on->n : s->link[body].nv;
        if (node_body)
            node_body_row(g + at, &s->part[body], node_body, x, f, n);
        else
            joint_row(g + at, &s->part[body], &s->link[body], x, f, n);
    }
}

void spatial_rows(const struct sweep *s, double *g, int stride, int body, int from, const double *x, double sign, int m,
                  const struct pull *on)
{
    for (int i = 0; i < m; i++, g += stride) {
        double force[3], moment[3];
        v3_scale(force, sign, on[i].f);
        v3_scale(moment, sign, on[i].n);
        spatial_row(s, g, body, from, x, force, moment);
    }
}

int spatial_path(const struct sweep *s, const int **k, int body)
{
    *k = s->routes.path[body];
    return s->routes.npath[body];
}

void spatial_energy(const struct sweep *s, double *kinetic, double *gravity)
{
    double T = 0, V = 0;
    for (int i = 1; i < s->nbody; i++) {
        const struct part *x = &s->part[i];
        const struct link *l = &s->link[i];
        struct flexible *flexible = spatial_flexible(s, i);
        double w[3], L[3];
        if (flexible) {
            spatial_flex_energy(&T, &V, x, flexible, s->model->gravity);
            continue;
        }
        m3_tmul(w, x->R, x->w);
        s3_mul(L, l->inertia, w);
        T += l->mass * v3_dot(x->v, x->v) + v3_dot(w, L);
        V -= l->mass * v3_dot(s->model->gravity, x->r);
    }
    *kinetic = .5 * T;
    *gravity = V;
}

/* The axes of every joint's rotations are at right angles to each other, those of its displacements too, so the
 * free directions come out one by one: of a rate that turns a moment, else a force. */
void spatial_reaction(const struct sweep *s, double *f, double *n, int joint)
{
    int body = s->model->joint[joint].child;
    const struct part *x = &s->part[body];
    const struct link *l = &s->link[body];
    v3_copy(f, x->F);
    spatial_moment(n, x);
    for (int k = 0; k < l->nv; k++) {
        v3_axpy(l->turns[k] ? n : f, -spatial_power(x, l, k, f, n), spatial_axis(x, l, k));
    }
}
