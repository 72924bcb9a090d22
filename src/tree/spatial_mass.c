/* spatial_mass.c -- M^ in space by composite bodies.
 *
 * A body and all that hangs on it, held stiff: mass m, first moment h and inertia J about the body's centre.
 * The force and moment that start it with unit u_k' give column k, at its own joint and, carried inwards, at
 * every joint on the path:
 *
 *     F = m a + al x h,   N = J al + h x a.
 *
 * A unit rate of a flexible body's j-th coordinate starts the body itself with H_j and G_j in the frame and with
 * column j of Me in its rows, and what hangs on its nodes like unit velocities of a joint there; the rows of the
 * coordinates are dx_i . F + dw_i . N of each node's force and moment.
 *
 * Walker & Orin, J. Dyn. Syst. Meas. Control 104 (1982) 205. */
#include <string.h>

#include "tree/spatial.h"

/* J += the inertia of the child's composite about a centre that is d further in, less its own:
 * m (d.d 1 - d d') + 2 d.h 1 - d h' - h d'. */
static inline void shift(double *J, const struct composite *x, const double *d)
{
    double y[3] = {x->m * d[0] + x->h[0], x->m * d[1] + x->h[1], x->m * d[2] + x->h[2]};
    double dh = v3_dot(d, x->h), round = v3_dot(d, y) + dh;
    J[0] += round - d[0] * (y[0] + x->h[0]);
    J[1] += round - d[1] * (y[1] + x->h[1]);
    J[2] += round - d[2] * (y[2] + x->h[2]);
    J[3] -= d[0] * y[1] + x->h[0] * d[1];
    J[4] -= d[0] * y[2] + x->h[0] * d[2];
    J[5] -= d[1] * y[2] + x->h[1] * d[2];
}

static inline void add_child(struct composite *p, const struct composite *x, const double *arm)
{
    for (int i = 0; i < 6; i++) p->J[i] += x->J[i];
    shift(p->J, x, arm);
    p->m += x->m;
    v3_add(p->h, x->h);
    v3_axpy(p->h, x->m, arm);
}

/* Composite bodies, from the tips inwards. */
static void compose(struct sweep *s, const struct roster *o)
{
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct flexible *f = spatial_flexible(s, o->body[i]);
        struct composite *x = &s->composite[o->body[i]];
        memset(x, 0, sizeof *x);
        if (!o->bears[i]) continue;
        x->m = l->mass;
        if (f) {
            spatial_flex_shape(f);
            m3_mul(x->h, f->R, f->shape.h);
            s3_turn(x->J, f->R, f->shape.J);
        } else {
            s3_turn(x->J, s->part[o->body[i]].R, l->inertia);
        }
    }
    for (int i = o->n - 1; i >= 0; i--) {
        int body = o->body[i], parent = s->link[body].parent;
        if (parent) add_child(&s->composite[parent], &s->composite[body], s->part[body].arm);
    }
}

/* Force and moment about the centre that start the composite body with twist rate u. */
static inline void start(double *F, double *N, const struct composite *x, const struct twist *u)
{
    v3_scale(F, x->m, u->v);
    v3_cross_add(F, u->w, x->h);
    s3_mul(N, x->J, u->w);
    v3_cross_add(N, x->h, u->v);
}

static inline double row(const struct part *x, const struct link *l, int k, const double *F, const double *N)
{
    double n[3];
    if (!l->turns[k]) return v3_dot(spatial_axis(x, l, k), F);
    v3_copy(n, N);
    v3_cross_add(n, x->c, F);
    return spatial_power(x, l, k, F, n);
}

/* Rows of the first m coordinates of the body on which o stands, of F and N in its axes. */
static void flexible_rows(double *M, size_t n, size_t col, const struct node_body *o, int m, const double *F,
                          const double *N)
{
    for (int i = 0; i < m; i++) M[(size_t)o->on->iv[i] + n * col] += spatial_node_body_row(o, i, F, N);
}

static void mirror(double *M, size_t n, size_t col, const struct flexible *f, int m)
{
    for (int i = 0; i < m; i++) M[col + n * (size_t)f->iv[i]] = M[(size_t)f->iv[i] + n * col];
}

/* Column col, from the first `last` rows of the body's joint to the ground, of F0 and N0 about the body's centre. */
static inline void carry(double *M, const struct sweep *s, int body, int last, size_t col, const double *F0,
                         const double *N0)
{
    size_t n = (size_t)s->n;
    double F[3], N[3], f[3], moment[3];
    v3_copy(F, F0);
    v3_copy(N, N0);
    for (int i = body; i > 0; i = s->link[i].parent) {
        const struct part *x = &s->part[i];
        const struct link *l = &s->link[i];
        const struct node_body *node_body = spatial_node_body(s, i);
        int m = i == body ? last : l->nv;
        for (int o = 0; o < m; o++) {
            size_t at = (size_t)l->iv[o];
            M[at + n * col] = M[col + n * at] = row(x, l, o, F, N);
        }
        if (node_body) {
            m3_tmul(f, node_body->on->R, F);
            m3_tmul(moment, node_body->on->R, N);
            flexible_rows(M, n, col, node_body, node_body->on->n, f, moment);
            mirror(M, n, col, node_body->on, node_body->on->n);
        }
        v3_cross_add(N, x->arm, F);
    }
}

static void column(double *M, const struct sweep *s, int body, int k)
{
    double F[3], N[3];
    struct twist u;
    spatial_unit(&u, &s->part[body], &s->link[body], k);
    start(F, N, &s->composite[body], &u);
    carry(M, s, body, k + 1, (size_t)s->link[body].iv[k], F, N);
}

/* Column of the j-th coordinate of f, whose own inertia is in it where it bears. */
static void flexible_column(double *M, const struct sweep *s, struct flexible *f, int j, bool bears, unsigned cls)
{
    double F[3] = {0}, N[3] = {0};
    size_t n = (size_t)s->n, col = (size_t)f->iv[j];
    if (bears) {
        double H[3], G[3];
        flex_mass_column(f->Q, H, G, f->kernel, &f->shape, j);
        m3_mul(F, f->R, H);
        m3_mul(N, f->R, G);
        for (int i = 0; i <= j; i++) M[(size_t)f->iv[i] + n * col] = f->Q[i];
    }
    for (int i = 0; i < f->nnode[cls]; i++) {
        int node = f->node[cls][i];
        double Fi[3], Ni[3], force[3], moment[3];
        struct twist u;
        spatial_node_body_unit(&u, &s->node_body[node], j);
        start(Fi, Ni, &s->composite[node], &u);
        m3_tmul(force, f->R, Fi);
        m3_tmul(moment, f->R, Ni);
        flexible_rows(M, n, col, &s->node_body[node], j + 1, force, moment);
        v3_add(F, Fi);
        v3_add(N, Ni);
        v3_cross_add(N, s->part[node].arm, Fi);
    }
    mirror(M, n, col, f, j);
    carry(M, s, f->body, s->link[f->body].nv, col, F, N);
}

void spatial_mass(struct sweep *s, double *M, const double *q, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    roster_clear(o, M, s->n);
    if (q) spatial_place(s, q, cls);
    compose(s, o);
    for (int i = 0; i < o->n; i++) {
        struct flexible *f = spatial_flexible(s, o->body[i]);
        for (int k = 0; k < s->link[o->body[i]].nv; k++) column(M, s, o->body[i], k);
        for (int j = 0; f && j < f->n; j++) flexible_column(M, s, f, j, o->bears[i], cls);
    }
}
