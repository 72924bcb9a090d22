/* planar_ask.c -- what elements ask of the planar recursion and give to it; energies, reactions */
#include <math.h>
#include <string.h>

#include "tree/planar_flex.h"

/* From the centre to the point p of body axes, world axes. */
static inline void offset(double *d, const struct sweep *s, int body, const double *p)
{
    double drawn[2];
    planar_turn(drawn, s->link[body].drawn[0], s->link[body].drawn[1], p);
    planar_turn(d, s->part[body].c, s->part[body].s, drawn);
}

void planar_point(const struct sweep *s, double *x, double *xv, int body, const double *p)
{
    const struct part *b = &s->part[body];
    double d[2];
    offset(d, s, body, p);
    x[0] = b->r[0] + d[0];
    x[1] = b->r[1] + d[1];
    xv[0] = b->v[0] - b->w * d[1];
    xv[1] = b->v[1] + b->w * d[0];
    x[2] = xv[2] = 0;
}

void planar_at(const struct sweep *s, struct pose *o, int body)
{
    const struct part *b = &s->part[body];
    o->angle = b->phi;
    for (int i = 0; i < 2; i++) o->r[i] = b->r[i];
}

void planar_stand(const struct sweep *s, struct pose *o, int body)
{
    const struct part *b = &s->part[body];
    double z[2];
    planar_turn(z, b->c, b->s, s->link[body].drawn);
    o->R[0] = o->R[4] = z[0];
    o->R[1] = z[1];
    o->R[3] = -z[1];
    planar_at(s, o, body);
}

void planar_stir(const struct sweep *s, struct pose *o, int body)
{
    const struct part *b = &s->part[body];
    o->w[2] = b->w;
    o->al[2] = s->accelerated ? b->al : 0;
    for (int i = 0; i < 2; i++) {
        o->v[i] = b->v[i];
        o->a[i] = s->accelerated ? b->a[i] + s->model->gravity[i] : 0;
    }
}

void planar_pose(const struct sweep *s, struct pose *o, int body)
{
    memset(o, 0, sizeof *o);
    o->R[8] = 1;
    planar_stand(s, o, body);
    planar_stir(s, o, body);
}

void planar_push(struct sweep *s, int body, const double *x, const double *f)
{
    struct part *b = &s->part[body];
    b->F[0] -= f[0];
    b->F[1] -= f[1];
    b->N -= (x[0] - b->r[0]) * f[1] - (x[1] - b->r[1]) * f[0];
}

void planar_twist(struct sweep *s, int body, const double *n)
{
    s->part[body].N -= n[2];
}

void planar_partial(const struct sweep *s, double *xv, double *w, int body, const double *x, int k)
{
    int o = s->routes.owner[k];
    const struct part *p = &s->part[o];
    memset(xv, 0, 3 * sizeof *xv);
    memset(w, 0, 3 * sizeof *w);
    if (!routes_above(&s->routes, o, body)) return;
    if (s->routes.local[k] >= s->link[o].nv) {
        planar_flex_partial(s, xv, w, body, x, k);
        return;
    }
    if (!planar_turns(&s->link[o], s->routes.local[k])) {
        memcpy(xv, p->e[s->routes.local[k]], 2 * sizeof *xv);
        return;
    }
    double turn = s->link[o].turn, at[2] = {p->r[0] - p->c_b[0], p->r[1] - p->c_b[1]};
    w[2] = turn;
    xv[0] = -turn * (x[1] - at[1]);
    xv[1] = turn * (x[0] - at[0]);
}

static inline double along(const double *e, const double *f)
{
    return e[0] * f[0] + e[1] * f[1];
}

/* Rows of a joint, [nv], for f at x and the moment n. */
static inline void joint_row(double *g, const struct part *p, const struct link *l, const double *x, const double *f,
                             double n)
{
    const double at[2] = {x[0] - (p->r[0] - p->c_b[0]), x[1] - (p->r[1] - p->c_b[1])};
    switch (l->type) {
    case TURN:
        g[0] = l->turn * (v2_cross(at, f) + n);
        break;
    case SLIDE:
        g[0] = along(p->e[0], f);
        break;
    case GLIDE:
        g[0] = along(p->e[0], f);
        g[1] = along(p->e[1], f);
        g[2] = l->turn * (v2_cross(at, f) + n);
        break;
    case HELD:
        break;
    }
}

void planar_row(const struct sweep *s, double *g, int body, int from, const double *x, const double *f, const double *n)
{
    static const double none[3];
    const double moment = n ? n[2] : 0;
    if (!f) f = none;
    for (int at = s->routes.npath[body] - from; at > 0; body = s->link[body].parent) {
        const struct node_body *node = planar_node_body(s, body);
        const int k = node ? node->of->n : s->link[body].nv;
        at -= k;
        if (node)
            planar_node_body_row(g + at, node, &s->part[body], x, f, moment);
        else
            joint_row(g + at, &s->part[body], &s->link[body], x, f, moment);
    }
}

/* Of a joint's turning, for all wrenches; of its displacements. */
INTO static inline void turn_rows(double *restrict g, int stride, const struct part *p, const struct link *l,
                                  const double *x, double sign, int m, const struct pull *on)
{
    const double at[2] = {x[0] - (p->r[0] - p->c_b[0]), x[1] - (p->r[1] - p->c_b[1])}, turn = sign * l->turn;
    for (int i = 0; i < m; i++, g += stride) *g = turn * (v2_cross(at, on[i].f) + on[i].n[2]);
}

INTO static inline void slide_rows(double *restrict g, int stride, const double *e, double sign, int m,
                                   const struct pull *on)
{
    for (int i = 0; i < m; i++, g += stride) *g = sign * along(e, on[i].f);
}

APART void node_rows(double *g, int stride, const struct node_body *node, const struct part *p, const double *x,
                     double sign, int m, const struct pull *on)
{
    for (int i = 0; i < m; i++, g += stride) {
        const double force[2] = {sign * on[i].f[0], sign * on[i].f[1]};
        planar_node_body_row(g, node, p, x, force, sign * on[i].n[2]);
    }
}

TWICE void all_rows(const struct sweep *s, double *g, int stride, int body, int from, const double *x, double sign,
                    int m, const struct pull *on)
{
    for (int at = s->routes.npath[body] - from; at > 0; body = s->link[body].parent) {
        const struct node_body *node = planar_node_body(s, body);
        const struct link *l = &s->link[body];
        const struct part *p = &s->part[body];
        const int k = node ? node->of->n : l->nv, slides = l->type == GLIDE ? 2 : l->type == SLIDE;
        at -= k;
        if (node) {
            node_rows(g + at, stride, node, p, x, sign, m, on);
            continue;
        }
        if (l->type == TURN) { /* what most are */
            turn_rows(g + at, stride, p, l, x, sign, m, on);
            continue;
        }
        for (int i = 0; i < slides; i++) slide_rows(g + at + i, stride, p->e[i], sign, m, on);
        if (slides < k) turn_rows(g + at + slides, stride, p, l, x, sign, m, on);
    }
}

/* Two are those of a pin, what most loops are closed by. */
void planar_rows(const struct sweep *s, double *g, int stride, int body, int from, const double *x, double sign, int m,
                 const struct pull *on)
{
    if (m == 2)
        all_rows(s, g, stride, body, from, x, sign, 2, on);
    else
        all_rows(s, g, stride, body, from, x, sign, m, on);
}

int planar_path(const struct sweep *s, const int **k, int body)
{
    *k = s->routes.path[body];
    return s->routes.npath[body];
}

void planar_energy(const struct sweep *s, double *kinetic, double *gravity)
{
    const double *g = s->model->gravity;
    double T = 0, V = 0;
    for (int i = 1; i < s->nbody; i++) {
        const struct part *x = &s->part[i];
        const struct link *l = &s->link[i];
        T += l->mass * (x->v[0] * x->v[0] + x->v[1] * x->v[1]) + l->inertia * x->w * x->w;
        V -= l->mass * (g[0] * x->r[0] + g[1] * x->r[1]);
    }
    *kinetic = .5 * T;
    *gravity = V;
    if (s->bend) planar_flex_energy(s, kinetic, gravity);
}

/* What elements along the joint's own coordinates carry is taken out: the free directions. */
void planar_reaction(const struct sweep *s, double *f, double *n, int joint)
{
    int body = s->model->joint[joint].child;
    const struct part *x = &s->part[body];
    memset(f, 0, 3 * sizeof *f);
    memset(n, 0, 3 * sizeof *n);
    enum planar_type type = s->link[body].type;
    if (type == GLIDE) return;
    f[0] = x->F[0];
    f[1] = x->F[1];
    if (type != TURN) n[2] = x->N + v2_cross(x->c_b, x->F);
    if (type != SLIDE) return;
    double along = x->e[0][0] * f[0] + x->e[0][1] * f[1];
    f[0] -= along * x->e[0][0];
    f[1] -= along * x->e[0][1];
}
