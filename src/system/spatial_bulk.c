/* spatial_bulk.c -- bodies in space as one: momenta, what their inertia takes, changes of their motion; see sweep.h.
 *
 * About the root's frame o, with d = r - o and u = v - v_o, so that little is lost where the bodies are far from the
 * world's origin or fast:
 *
 *     S = sum m d + h,   P = sum m u,   L = sum (d x m u + I w),   2 T = sum (m u.u + w.I w)
 *     J = sum (I + m (d.d 1 - d d') + 2 d.h 1 - d h' - h d')
 *     centre c = o + S/m,   momentum m v_o + P;   about the centre L - S x P/m,   J - (S.S 1 - S S')/m,   2 T - P.P/m
 *
 * h is the first moment of a flexible body about its frame; it has its P, L, I and T from its own kinetic energy. */
#include "la/dense.h"
#include "system/spatial.h"

/* J += m (x.y 1 - (x y' + y x')/2) */
static inline void add_arms(double *J, double m, const double *x, const double *y)
{
    const double xy[3] = {m * x[0] * y[0], m * x[1] * y[1], m * x[2] * y[2]};
    J[0] += xy[1] + xy[2];
    J[1] += xy[0] + xy[2];
    J[2] += xy[0] + xy[1];
    J[3] -= m / 2 * (x[0] * y[1] + x[1] * y[0]);
    J[4] -= m / 2 * (x[0] * y[2] + x[2] * y[0]);
    J[5] -= m / 2 * (x[1] * y[2] + x[2] * y[1]);
}

/* One body about its own frame, world axes. */
struct share {
    double m, h[3], p[3], L[3], J[6], T;
};

static void share_of_flexible(struct share *o, struct flexible *f, const double *u, const double *world_w)
{
    double v[3], w[3], p[3], L[3];
    spatial_flex_shape(f);
    m3_tmul(v, f->R, u);
    m3_tmul(w, f->R, world_w);
    flex_momentum(p, L, f->kernel, &f->shape, v, w, f->q1);
    m3_mul(o->p, f->R, p);
    m3_mul(o->L, f->R, L);
    m3_mul(o->h, f->R, f->shape.h);
    s3_turn(o->J, f->R, f->shape.J);
    o->m = f->mass;
    o->T = flex_kinetic(f->kernel, &f->shape, v, w, f->q1);
}

static inline void share_of_rigid(struct share *o, const struct link *l, const double *R, const double *u,
                                  const double *w)
{
    s3_turn(o->J, R, l->inertia);
    s3_mul(o->L, o->J, w);
    v3_scale(o->p, l->mass, u);
    v3_set(o->h, 0, 0, 0);
    o->m = l->mass;
    o->T = .5 * (v3_dot(o->p, u) + v3_dot(o->L, w));
}

static inline void add_share(struct bulk *o, const struct share *x, const double *d)
{
    o->m += x->m;
    v3_axpy(o->c, x->m, d);
    v3_add(o->c, x->h);
    v3_add(o->p, x->p);
    v3_add(o->L, x->L);
    v3_cross_add(o->L, d, x->p);
    for (int i = 0; i < 6; i++) o->J[i] += x->J[i];
    add_arms(o->J, x->m, d, d);
    add_arms(o->J, 2, d, x->h);
    o->T += x->T;
}

/* From sums about the root's frame, with S in c. */
static void about_centre(struct bulk *o, const struct part *root)
{
    double S[3], P[3];
    v3_copy(S, o->c);
    v3_scale(P, -1 / o->m, o->p);
    v3_cross_add(o->L, S, P);
    add_arms(o->J, -1 / o->m, S, S);
    o->T += .5 * v3_dot(P, o->p);
    v3_copy(o->c, root->r);
    v3_axpy(o->c, 1 / o->m, S);
    v3_axpy(o->p, o->m, root->v);
}

void spatial_momentum(struct sweep *s, struct bulk *o, const int *body, int n)
{
    const struct part *root = &s->part[body[0]];
    *o = (struct bulk){.m = 0};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        struct flexible *f = spatial_flexible(s, body[i]);
        struct share y;
        double d[3], u[3];
        v3_diff(d, x->r, root->r);
        v3_diff(u, x->v, root->v);
        if (f)
            share_of_flexible(&y, f, u, x->w);
        else
            share_of_rigid(&y, &s->link[body[i]], x->R, u, x->w);
        add_share(o, &y, d);
    }
    about_centre(o, root);
}

/* Power of the modes' rows, without that of stiffness and damping. */
static double power_of_modes(const struct flexible *f, const struct flex_body *b)
{
    double W = 0;
    for (int j = 0; j < f->n; j++) f->dQ[j] = f->Q[j];
    dense_gemv(f->dQ, -1, b->K, f->q, f->n, f->n, f->n);
    if (b->D) dense_gemv(f->dQ, -1, b->D, f->q1, f->n, f->n, f->n);
    for (int j = 0; j < f->n; j++) W += f->q1[j] * f->dQ[j];
    return W;
}

void spatial_inertia(struct sweep *s, struct drag *o, const struct bulk *now, const int *body, int n)
{
    *o = (struct drag){.W = 0};
    v3_scale(o->F, now->m, s->model->gravity);
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const struct flexible *f = spatial_flexible(s, body[i]);
        double d[3], u[3];
        v3_diff(d, x->r, now->c);
        v3_copy(u, x->v);
        v3_axpy(u, -1 / now->m, now->p);
        v3_add(o->F, x->F);
        v3_add(o->N, x->N);
        v3_cross_add(o->N, d, x->F);
        o->W += v3_dot(u, x->F) + v3_dot(x->w, x->N);
        if (f) o->W += power_of_modes(f, s->model->body[body[i]].flex);
    }
}

static void hasten_flexible(struct part *x, struct flexible *f, const double *a, const double *al, double k)
{
    static const double still[3] = {0, 0, 0};
    double ab[3], alb[3], F[3], N[3];
    m3_tmul(ab, f->R, a);
    m3_tmul(alb, f->R, al);
    for (int j = 0; j < f->n; j++) f->q2[j] = k * f->q1[j];
    flex_inertia(F, N, f->dQ, f->kernel, &f->shape, ab, still, alb, f->q, NULL, f->q2, false);
    m3_mul_add(x->F, f->R, F);
    m3_mul_add(x->N, f->R, N);
    for (int j = 0; j < f->n; j++) f->Q[j] += f->dQ[j];
}

void spatial_hasten(struct sweep *s, const struct change *o, const struct bulk *now, const int *body, int n)
{
    for (int i = 0; i < n; i++) {
        struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        struct flexible *f = spatial_flexible(s, body[i]);
        double d[3], a[3], al[3], alb[3], N[3];
        v3_diff(d, x->r, now->c);
        v3_copy(a, o->a);
        v3_cross_add(a, o->al, d);
        v3_axpy(a, o->k, x->v);
        v3_axpy(a, -o->k / now->m, now->p);
        v3_copy(al, o->al);
        v3_axpy(al, o->k, x->w);
        v3_add(x->v, o->dv);
        if (f) {
            hasten_flexible(x, f, a, al, o->k);
            continue;
        }
        v3_axpy(x->F, l->mass, a);
        m3_tmul(alb, x->R, al);
        s3_mul(N, l->inertia, alb);
        m3_mul_add(x->N, x->R, N);
    }
}
