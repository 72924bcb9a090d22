/* spatial_flex.c -- flexible bodies in the spatial recursion; see sweep.h and flex/motion.h.
 *
 * A flexible body's part is its frame, which hangs on its joint as a rigid body's centre does; R takes the axes of
 * its data to the world.  A body at a node stands, with x, R_n, v, w, a, al of the node against the frame, at
 *
 *     arm = R x,     r = r_p + arm,                      its axes R R_n E
 *     w  = w_p + R w_n                                   v = v_p + w_p x arm + R v_n
 *     al = al_p + R al_n + w_p x R w_n
 *     a  = a_p + al_p x arm + w_p x (w_p x arm) + 2 w_p x R v_n + R a_n
 *
 * and its force and moment go to the frame as over any arm and to the coordinates as dx' F + dw' N. */
#include <string.h>

#include "tree/spatial.h"

/* --- building ----------------------------------------------------------------------------------- */

static void build_flexible(struct flexible *f, const struct model_body *b, int body, struct arena *life)
{
    f->kernel = flex_kernel_build(b->flex, life);
    flex_shape_take(&f->shape, f->kernel, life);
    f->mass = b->mass;
    f->body = body;
    f->n = b->nmode;
    f->iq = b->mode_q;
    f->iv = b->mode_v;
    f->q = TAKE(life, double, f->n);
    f->q1 = TAKE(life, double, f->n);
    f->q2 = TAKE(life, double, f->n);
    f->Q = TAKE(life, double, f->n);
    f->dQ = TAKE(life, double, f->n);
}

static void build_node_body(struct node_body *o, const struct flexible *f, const struct link *l,
                            const struct model_joint *j, const struct model_body *b, struct arena *life)
{
    double drawn[9];
    o->on = f;
    o->node = b->node;
    flex_place_take(&o->place, f->kernel, life);
    m3_mulmt(drawn, j->Ea, j->Eb);
    m3_mulm(o->E, drawn, l->turned);
}

/* The bodies at nodes that a class moves. */
static void list_nodes(struct sweep *s, const struct model *m, unsigned cls, struct arena *life)
{
    const struct roster *o = &s->rosters.of[cls];
    for (int i = 0; i < s->nflexible; i++) s->flexible[i].node[cls] = TAKE(life, int, o->n);
    for (int i = 0; i < o->n; i++) {
        int body = o->body[i];
        if (!s->node_body[body].on) continue;
        struct flexible *f = s->flexible_of[m->body[body].parent];
        f->node[cls][f->nnode[cls]++] = body;
    }
}

void spatial_flex_build(struct sweep *s, const struct model *m, struct arena *life)
{
    for (int i = 1; i < m->nbody; i++) s->nflexible += m->body[i].flex != NULL;
    if (!s->nflexible) return;
    s->flexible = TAKE(life, struct flexible, s->nflexible);
    s->flexible_of = TAKE(life, struct flexible *, m->nbody);
    s->node_body = TAKE(life, struct node_body, m->nbody);
    struct flexible *f = s->flexible;
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &m->body[i];
        if (b->flex) build_flexible(s->flexible_of[i] = f++, b, i, life);
        if (b->at_node)
            build_node_body(&s->node_body[i], s->flexible_of[b->parent], &s->link[i], &m->joint[b->joint], b, life);
    }
    for (unsigned cls = FAST; cls <= ALL; cls++) list_nodes(s, m, cls, life);
}

void spatial_flex_shape(struct flexible *f)
{
    if (f->shaped == f->change) return;
    flex_shape_at(&f->shape, f->kernel, f->q);
    f->shaped = f->change;
}

/* --- motion outwards ---------------------------------------------------------------------------- */

static void pick(double *o, const double *x, const int *at, int n)
{
    for (int i = 0; i < n; i++) o[i] = x[at[i]];
}

void spatial_flex_place(struct flexible *f, const struct part *x, const struct link *l, const double *q)
{
    bool moved = f->change == 0;
    m3_mulmt(f->R, x->R, l->turned);
    for (int k = 0; k < f->n; k++) {
        moved |= !(q[f->iq[k]] == f->q[k]); /* always for NAN */
        f->q[k] = q[f->iq[k]];
    }
    f->change += moved;
}

void spatial_flex_move(struct flexible *f, const double *v)
{
    pick(f->q1, v, f->iv, f->n);
}

void spatial_flex_accelerate(struct flexible *f, const double *a)
{
    pick(f->q2, a, f->iv, f->n);
}

void spatial_node_body_place(struct part *x, struct node_body *o, const struct part *p)
{
    const struct flexible *f = o->on;
    double R[9];
    if (o->change != f->change) flex_place_at(&o->place, f->kernel, o->node, f->q);
    o->change = f->change;
    m3_mul(x->arm, f->R, o->place.x);
    v3_copy(x->rho, x->arm);
    v3_set(x->c, 0, 0, 0);
    v3_sum(x->r, p->r, x->arm);
    m3_mulm(R, f->R, o->place.R);
    m3_mulm(x->R, R, o->E);
}

void spatial_node_body_move(struct part *x, struct node_body *o, const struct part *p)
{
    const struct flexible *f = o->on;
    double w[3], v[3];
    flex_place_move(&o->place, f->kernel, o->node, f->q1);
    m3_mul(w, f->R, o->place.w);
    m3_mul(v, f->R, o->place.v);
    v3_sum(x->w, p->w, w);
    v3_sum(x->v, p->v, v);
    v3_cross_add(x->v, p->w, x->arm);
}

void spatial_node_body_accelerate(struct part *x, struct node_body *o, const struct part *p)
{
    const struct flexible *f = o->on;
    double w[3], v[3], turned[3];
    flex_place_accelerate(&o->place, f->kernel, f->q2);
    m3_mul(w, f->R, o->place.w);
    m3_mul(v, f->R, o->place.v);
    v3_copy(x->al, p->al);
    m3_mul_add(x->al, f->R, o->place.al);
    v3_cross_add(x->al, p->w, w);
    v3_cross(turned, p->w, x->arm);
    v3_axpy(turned, 2, v);
    v3_copy(x->a, p->a);
    m3_mul_add(x->a, f->R, o->place.a);
    v3_cross_add(x->a, p->al, x->arm);
    v3_cross_add(x->a, p->w, turned);
}

void spatial_flex_collect_forces(struct part *x, struct flexible *f)
{
    double a[3], w[3], al[3], F[3], N[3];
    m3_tmul(a, f->R, x->a);
    m3_tmul(w, f->R, x->w);
    m3_tmul(al, f->R, x->al);
    spatial_flex_shape(f);
    flex_inertia(F, N, f->Q, f->kernel, &f->shape, a, w, al, f->q, f->q1, f->q2, true);
    m3_mul(x->F, f->R, F);
    m3_mul(x->N, f->R, N);
}

/* --- forces inwards ----------------------------------------------------------------------------- */

void spatial_node_body_load(struct node_body *o, const struct part *x)
{
    const struct flexible *f = o->on;
    double F[3], N[3];
    m3_tmul(F, f->R, x->F);
    m3_tmul(N, f->R, x->N);
    for (int j = 0; j < f->n; j++) f->Q[j] += spatial_node_body_row(o, j, F, N);
}

void spatial_flex_rows(double *r, const struct flexible *f)
{
    for (int j = 0; j < f->n; j++) r[f->iv[j]] += f->Q[j];
}

/* --- what is asked ------------------------------------------------------------------------------ */

void spatial_node_body_unit(struct twist *u, const struct node_body *o, int j)
{
    m3_mul(u->w, o->on->R, o->place.dw + 3 * j);
    m3_mul(u->v, o->on->R, o->place.dx + 3 * j);
}

int spatial_node_body_below(const struct sweep *s, const struct flexible *f, int i)
{
    for (int k = 0; k < f->nnode[ALL]; k++)
        if (routes_above(&s->routes, f->node[ALL][k], i)) return f->node[ALL][k];
    return 0;
}

/* T += twice the kinetic energy, V += -g . (m r + h). */
void spatial_flex_energy(double *T, double *V, const struct part *x, struct flexible *f, const double *gravity)
{
    double v[3], w[3], h[3];
    spatial_flex_shape(f);
    m3_tmul(v, f->R, x->v);
    m3_tmul(w, f->R, x->w);
    m3_mul(h, f->R, f->shape.h);
    v3_axpy(h, f->mass, x->r);
    *T += 2 * flex_kinetic(f->kernel, &f->shape, v, w, f->q1);
    *V -= v3_dot(gravity, h);
}
