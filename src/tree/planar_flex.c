/* planar_flex.c -- flexible bodies in the planar recursion.
 *
 * The frame of a flexible body hangs on its joint as a rigid body does; flex/planar.h says what force F at its
 * origin, moment N and modes' forces Q its motion takes.  What hangs on it outboard stands at nodes: a body at a node
 * is R (x + u) away from the origin and turned by theta, and moves with
 *
 *     arm = R (x + u)       w  = w_p + theta'
 *     v = v_p + w_p J arm + R u'
 *     a = a_p + al_p J arm - w_p^2 arm + 2 w_p J R u' + R u''
 *
 * whose partial velocities by q' are R (phi + S q) and psi.  By virtual power the force F and moment N that the body
 * at the node needs go to the frame as from any child, and to the modes' rows as
 *
 *     Q_k += (phi + S q)_k . R'F + psi_k N. */
#include <math.h>
#include <string.h>

#include "tree/planar_flex.h"

/* x := what the modes of b have at their places `at` in `from`. */
static inline void gather(double *restrict x, const struct flexible *b, const int *at, const double *restrict from)
{
    if (b->abreast)
        memcpy(x, from + at[0], sizeof *x * (size_t)b->n);
    else
        for (int k = 0; k < b->n; k++) x[k] = from[at[k]];
}

/* Is x that already?  Never with NAN. */
static inline bool gathered(const double *x, const struct flexible *b, const int *at, const double *from)
{
    int k = 0;
    while (k < b->n && from[at[k]] == x[k]) k++;
    return k == b->n;
}

/* --- motion ------------------------------------------------------------------------------------- */

/* Body axes and modes. */
void planar_flexible_place(struct flexible *b, const struct part *x, const double *q)
{
    v2_turn(b->cs, (double[]){x->c, x->s}, b->drawn);
    if (b->change > 0 && gathered(b->q, b, b->iq, q)) return;
    gather(b->q, b, b->iq, q);
    b->change++;
}

void planar_flexible_move(struct flexible *b, const double *v)
{
    gather(b->v, b, b->iv, v);
}

void planar_flexible_accelerate(struct flexible *b, const double *a)
{
    if (gathered(b->a, b, b->iv, a)) return;
    gather(b->a, b, b->iv, a);
    b->push++;
}

void planar_node_body_place(struct part *x, struct node_body *o, const struct part *p)
{
    const struct flexible *b = o->of;
    const struct flex_planar_place *d = &o->place;
    if (o->change != b->change) {
        flex_planar_place_at(&o->place, b->kernel, o->node, b->q);
        o->change = b->change;
        o->biased = false;
    }
    v2_turn(x->arm, b->cs, d->x);
    x->c_b[0] = x->c_b[1] = 0;
    x->phi = p->phi + d->angle;
    x->c = p->c * d->cs[0] - p->s * d->cs[1];
    x->s = p->s * d->cs[0] + p->c * d->cs[1];
    for (int i = 0; i < 2; i++) x->r[i] = p->r[i] + x->arm[i];
}

void planar_node_body_move(struct part *x, struct node_body *o, const struct part *p)
{
    const struct flexible *b = o->of;
    double u[2];
    flex_planar_place_move(&o->place, b->kernel, b->v);
    o->biased = false;
    v2_turn(u, b->cs, o->place.v);
    x->w = p->w + o->place.w;
    x->v[0] = p->v[0] - p->w * x->arm[1] + u[0];
    x->v[1] = p->v[1] + p->w * x->arm[0] + u[1];
}

void planar_node_body_accelerate(struct part *x, struct node_body *o, const struct part *p)
{
    const struct flexible *b = o->of;
    const double ww = p->w * p->w, w2 = 2 * p->w;
    double u[2];
    if (!o->biased) flex_planar_place_bias(&o->place, b->kernel, o->node, b->v);
    if (!o->biased || o->push != b->push) flex_planar_place_accelerate(&o->place, b->kernel, b->a);
    o->biased = true;
    o->push = b->push;
    v2_turn(u, b->cs, o->place.v);
    v2_turn(x->a, b->cs, o->place.a);
    x->al = p->al + o->place.al;
    x->a[0] += p->a[0] - p->al * x->arm[1] - ww * x->arm[0] - w2 * u[1];
    x->a[1] += p->a[1] + p->al * x->arm[0] - ww * x->arm[1] + w2 * u[0];
}

/* --- what elements ask -------------------------------------------------------------------------- */

/* A mode of body o moves what hangs on the nodes of o, each node in its own way. */
void planar_flex_partial(const struct sweep *s, double *xv, double *w, int body, const double *x, int k)
{
    const int o = s->routes.owner[k], mode = s->routes.local[k] - s->link[o].nv;
    if (body == o) return;
    while (s->link[body].parent != o) body = s->link[body].parent;
    const struct node_body *node = s->node_body[body];
    const struct part *at = &s->part[body];
    if (!node) return;
    v2_turn(xv, node->of->cs, (double[]){node->place.dx[mode], node->place.dy[mode]});
    w[2] = node->place.dw[mode];
    xv[0] -= w[2] * (x[1] - at->r[1]);
    xv[1] += w[2] * (x[0] - at->r[0]);
}

void planar_node_body_row(double *restrict g, const struct node_body *o, const struct part *at, const double *x,
                          const double *f, double n)
{
    const double arm[2] = {x[0] - at->r[0], x[1] - at->r[1]}, moment = n + v2_cross(arm, f);
    double F[2];
    v2_turn_back(F, o->of->cs, f);
    flex_planar_place_row(g, &o->place, o->of->kernel, F, moment);
}

void planar_flex_energy(const struct sweep *s, double *kinetic, double *gravity)
{
    const double *g = s->model->gravity;
    for (int i = 1; i < s->nbody; i++) {
        struct flexible *b = s->bend[i];
        if (!b) continue;
        const struct part *x = &s->part[i];
        double v[2], h[2], m = s->model->body[i].mass;
        v2_turn_back(v, b->cs, x->v);
        planar_flex_shape(b);
        planar_flex_first_moment(h, b);
        *kinetic += flex_planar_kinetic(b->kernel, &b->shape, v, x->w, b->v);
        *gravity -= g[0] * (m * x->r[0] + h[0]) + g[1] * (m * x->r[1] + h[1]);
    }
}

/* --- forces ------------------------------------------------------------------------------------- */

void planar_flexible_load(struct part *x, struct flexible *b, bool bears)
{
    double a[2], F[2] = {0, 0};
    x->N = 0;
    if (bears) {
        planar_flex_shape(b);
        v2_turn_back(a, b->cs, x->a);
        flex_planar_inertia(F, &x->N, b->Q, b->kernel, &b->shape, a, x->w, x->al, b->v, b->a);
        flex_planar_elastic(b->Q, b->kernel, b->q, b->v);
    } else {
        memset(b->Q, 0, sizeof *b->Q * (size_t)b->n);
    }
    v2_turn(x->F, b->cs, F);
}

/* The modes' rows of force F and moment N at the node, both in the world. */
void planar_node_body_collect_forces(struct node_body *o, const struct part *x)
{
    double f[2];
    v2_turn_back(f, o->of->cs, x->F);
    flex_planar_place_load(o->of->Q, &o->place, o->of->kernel, f, x->N);
}

void planar_bend_slopes(const struct sweep *s, double *K, double *C, int body)
{
    const struct part *x = &s->part[body];
    struct flexible *b = s->bend[body];
    double a[2], F[2], N;
    planar_flex_shape(b);
    v2_turn_back(a, b->cs, x->a);
    flex_planar_inertia(F, &N, b->Q, b->kernel, &b->shape, a, x->w, x->al, b->v, b->a);
    flex_planar_slopes(K, C, b->kernel, &b->shape, b->v, b->a);
}

void planar_flexible_collect_forces(double *r, const struct flexible *b)
{
    const double *restrict Q = b->Q;
    double *restrict at = b->abreast ? r + b->iv[0] : r;
    if (b->abreast)
        for (int k = 0; k < b->n; k++) at[k] += Q[k];
    else
        for (int k = 0; k < b->n; k++) at[b->iv[k]] += Q[k];
}

/* --- building ----------------------------------------------------------------------------------- */

/* A factor keeps L and Z of a flexible body, B of a body at a node. */
static struct flexible *build_flexible(struct sweep *s, const struct model_body *body, const struct link *l,
                                       struct arena *life)
{
    struct flexible *b = TAKE(life, struct flexible, 1);
    const int n = b->n = body->nmode;
    b->kernel = flex_planar_build(body->flex, life);
    flex_planar_shape_take(&b->shape, b->kernel, life);
    b->iq = body->mode_q;
    b->iv = body->mode_v;
    b->abreast = n > 0;
    for (int k = 1; k < n; k++) b->abreast &= b->iq[k] == b->iq[0] + k && b->iv[k] == b->iv[0] + k;
    b->q = TAKE(life, double, n);
    b->v = TAKE(life, double, n);
    b->a = TAKE(life, double, n);
    b->Q = TAKE(life, double, n);
    b->U = TAKE(life, double, 3 * n);
    b->M = TAKE(life, double, n *n);
    memcpy(b->drawn, l->drawn, sizeof b->drawn);
    b->at = s->for_modes;
    s->for_modes += (size_t)(n * n + 3 * n);
    return b;
}

static struct node_body *build_node_body(struct sweep *s, const struct model_body *body, struct flexible *of,
                                         struct arena *life)
{
    struct node_body *o = TAKE(life, struct node_body, 1);
    o->of = of;
    o->node = body->node;
    flex_planar_place_take(&o->place, of->kernel, o->node, life);
    o->at = s->for_modes;
    s->for_modes += 3 * (size_t)of->n;
    return o;
}

static bool any_flexible(const struct model *m)
{
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].flex) return true;
    return false;
}

void planar_flex_build(struct sweep *s, struct arena *life)
{
    const struct model *m = s->model;
    if (!any_flexible(m)) return;
    s->bend = TAKE(life, struct flexible *, m->nbody);
    s->node_body = TAKE(life, struct node_body *, m->nbody);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *body = &m->body[i];
        if (body->at_node) s->node_body[i] = build_node_body(s, body, s->bend[body->parent], life);
        if (!body->flex) continue;
        s->link[i].mass = s->link[i].inertia = 0;
        s->bend[i] = build_flexible(s, body, &s->link[i], life);
    }
}
