/* spatial_bulk.c -- bodies in space as one: momenta, their rates, and one rigid motion for all; see sweep.h.
 *
 * About the root's frame o, with d = r - o and u = v - v_o, so that little is lost where the bodies are far from the
 * world's origin or fast:
 *
 *     S = sum m d + h,   P = sum m u,   L = sum (d x m u + I w),   J = sum (I + m (d.d 1 - d d') + 2 d.h 1 - d h' - h
 * d') centre c = o + S/m,   momentum m v_o + P,   about the centre L - S x P/m,   J - (S.S 1 - S S')/m
 *
 * h is the first moment of a flexible body about its frame; it has its P, L and I from its own T. */
#include "system/spatial.h"

struct sums {
    double m, S[3], P[3], L[3], J[6];
};

/* J += x.y 1 - (x y' + y x')/2 */
static inline void add_arms(double *J, double m, const double *x, const double *y)
{
    J[0] += m * (x[1] * y[1] + x[2] * y[2]);
    J[1] += m * (x[0] * y[0] + x[2] * y[2]);
    J[2] += m * (x[0] * y[0] + x[1] * y[1]);
    J[3] -= m / 2 * (x[0] * y[1] + x[1] * y[0]);
    J[4] -= m / 2 * (x[0] * y[2] + x[2] * y[0]);
    J[5] -= m / 2 * (x[1] * y[2] + x[2] * y[1]);
}

/* Mass m with first moment h about the body's frame (NULL: 0), momentum p and angular momentum L about it; d from the
 * root. */
static inline void add(struct sums *o, double m, const double *d, const double *h, const double *p, const double *L)
{
    o->m += m;
    v3_axpy(o->S, m, d);
    if (h) v3_add(o->S, h);
    v3_add(o->P, p);
    v3_add(o->L, L);
    v3_cross_add(o->L, d, p);
}

/* Inertia I [6] about the body's frame, whose axes are R. */
static inline void add_inertia(double *J, const double *R, const double *I, double m, const double *d, const double *h)
{
    double world[6];
    s3_turn(world, R, I);
    for (int i = 0; i < 6; i++) J[i] += world[i];
    add_arms(J, m, d, d);
    if (h) add_arms(J, 2, d, h);
}

/* About the centre of mass. */
static void centre(struct bulk *o, const struct sums *x, const struct part *root)
{
    double P[3];
    o->m = x->m;
    v3_copy(o->c, root->r);
    v3_axpy(o->c, 1 / x->m, x->S);
    v3_copy(o->p, x->P);
    v3_copy(o->L, x->L);
    v3_scale(P, -1 / x->m, x->P);
    v3_cross_add(o->L, x->S, P);
    for (int i = 0; i < 6; i++) o->J[i] = x->J[i];
    add_arms(o->J, -1 / x->m, x->S, x->S);
}

static void momentum_of_flexible(struct sums *o, struct flexible *f, const struct part *x, const double *d,
                                 const double *u)
{
    double v[3], w[3], p[3], L[3], P[3], N[3], h[3];
    spatial_flex_shape(f);
    m3_tmul(v, f->R, u);
    m3_tmul(w, f->R, x->w);
    flex_momentum(p, L, f->kernel, &f->shape, v, w, f->q1);
    m3_mul(P, f->R, p);
    m3_mul(N, f->R, L);
    m3_mul(h, f->R, f->shape.h);
    add(o, f->mass, d, h, P, N);
}

void spatial_momentum(struct sweep *s, struct bulk *o, const int *body, int n)
{
    const struct part *root = &s->part[body[0]];
    struct sums sum = {0};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        struct flexible *f = spatial_flexible(s, body[i]);
        double d[3], u[3], p[3], w[3], spin[3], L[3];
        v3_diff(d, x->r, root->r);
        v3_diff(u, x->v, root->v);
        if (f) {
            momentum_of_flexible(&sum, f, x, d, u);
            continue;
        }
        v3_scale(p, l->mass, u);
        m3_tmul(w, x->R, x->w);
        s3_mul(spin, l->inertia, w);
        m3_mul(L, x->R, spin);
        add(&sum, l->mass, d, NULL, p, L);
    }
    centre(o, &sum, root);
    v3_axpy(o->p, sum.m, root->v);
}

void spatial_inertia(struct sweep *s, struct bulk *o, const int *body, int n)
{
    const struct part *root = &s->part[body[0]];
    struct sums sum = {0};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        const struct flexible *f = spatial_flexible(s, body[i]);
        const double m = s->model->body[body[i]].mass;
        double d[3], h[3];
        v3_diff(d, x->r, root->r);
        if (f) m3_mul(h, f->R, f->shape.h);
        add(&sum, m, d, f ? h : NULL, x->F, x->N);
        add_inertia(sum.J, f ? f->R : x->R, f ? f->shape.J : l->inertia, m, d, f ? h : NULL);
    }
    centre(o, &sum, root);
    v3_axpy(o->p, sum.m, s->model->gravity);
}

static void hasten_flexible(struct part *x, struct flexible *f, const double *a, const double *al)
{
    static const double still[3] = {0, 0, 0};
    double ab[3], alb[3], F[3], N[3];
    m3_tmul(ab, f->R, a);
    m3_tmul(alb, f->R, al);
    flex_inertia(F, N, f->dQ, f->kernel, &f->shape, ab, still, alb, f->q, NULL, NULL, false);
    m3_mul_add(x->F, f->R, F);
    m3_mul_add(x->N, f->R, N);
    for (int j = 0; j < f->n; j++) f->Q[j] += f->dQ[j];
}

void spatial_hasten(struct sweep *s, const int *body, int n, const double *c, const double *a, const double *al)
{
    for (int i = 0; i < n; i++) {
        struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        struct flexible *f = spatial_flexible(s, body[i]);
        double d[3], here[3], alb[3], N[3];
        v3_diff(d, x->r, c);
        v3_copy(here, a);
        v3_cross_add(here, al, d);
        if (f) {
            hasten_flexible(x, f, here, al);
            continue;
        }
        v3_axpy(x->F, l->mass, here);
        m3_tmul(alb, x->R, al);
        s3_mul(N, l->inertia, alb);
        m3_mul_add(x->N, x->R, N);
    }
}
