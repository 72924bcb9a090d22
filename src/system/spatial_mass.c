/* spatial_mass.c -- M^ in space by composite bodies.
 *
 * A body and all that hangs on it, held stiff: mass m, first moment h and inertia J about the body's centre.
 * The force and moment that start it with unit u_k' give column k, at its own joint and, carried inwards, at
 * every joint on the path:
 *
 *     F = m a + al x h,   N = J al + h x a.
 *
 * Walker & Orin, J. Dyn. Syst. Meas. Control 104 (1982) 205. */
#include <string.h>

#include "system/spatial.h"

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
        struct composite *x = &s->composite[o->body[i]];
        memset(x, 0, sizeof *x);
        if (!o->bears[i]) continue;
        x->m = l->mass;
        s3_turn(x->J, s->part[o->body[i]].R, l->inertia);
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
    const double *e = spatial_axis(x, l, k);
    if (!spatial_turns(l, k)) return v3_dot(e, F);
    double n[3];
    v3_copy(n, N);
    v3_cross_add(n, x->c, F);
    return v3_dot(e, n);
}

static void column(double *M, const struct sweep *s, int body, int k)
{
    double F[3], N[3];
    struct twist u;
    size_t n = (size_t)s->n, col = (size_t)s->link[body].iv[k];
    spatial_unit(&u, &s->part[body], &s->link[body], k);
    start(F, N, &s->composite[body], &u);
    for (int i = body; i > 0; i = s->link[i].parent) {
        const struct part *x = &s->part[i];
        const struct link *l = &s->link[i];
        int last = i == body ? k + 1 : l->nv;
        for (int o = 0; o < last; o++) {
            size_t at = (size_t)l->iv[o];
            M[at + n * col] = M[col + n * at] = row(x, l, o, F, N);
        }
        v3_cross_add(N, x->arm, F);
    }
}

void spatial_mass(struct sweep *s, double *M, const double *q, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    memset(M, 0, sizeof *M * (size_t)s->n * (size_t)s->n);
    spatial_place(s, q, cls);
    compose(s, o);
    for (int i = 0; i < o->n; i++)
        for (int k = 0; k < s->link[o->body[i]].nv; k++) column(M, s, o->body[i], k);
}
