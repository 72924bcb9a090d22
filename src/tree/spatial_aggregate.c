/* spatial_aggregate.c -- bodies in space as one: momenta, what their inertia takes, changes of their motion; see sweep.h.
 *
 * About the root's frame o, with d = r - o and u = v - v_o, so that little is lost where the bodies are far from the
 * world's origin or fast:
 *
 *     S = sum m d + h,   P = sum m u,   L = sum (d x m u + I w),   2 T = sum (m u.u + w.I w)
 *     J = sum (I + m (d.d 1 - d d') + 2 d.h 1 - d h' - h d')
 *     F = sum F,   N = sum (d x F + N),   W = sum (u.F + w.N + q'.Q)
 *     centre c = o + S/m,   momentum m v_o + P;   about the centre L - S x P/m,   J - (S.S 1 - S S')/m,   2 T - P.P/m,
 *     N - S x F/m,   W - P.F/m
 *
 * h is the first moment of a flexible body about its frame; it has its P, L, I and T from its own kinetic energy, and Q
 * without stiffness and damping.  Gravity, which is in the accelerations, has no moment about the centre. */
#include "la/dense.h"
#include "tree/spatial.h"

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

static inline void add_momenta(struct aggregate *o, const double *p, const double *L, const double *d)
{
    v3_add(o->p, p);
    v3_add(o->L, L);
    v3_cross_add(o->L, d, p);
}

/* Inertia I in the body's axes R about its frame. */
static inline void add_inertia(double *J, const double *I, const double *R, double m, const double *d)
{
    double world[6];
    s3_turn(world, R, I);
    for (int i = 0; i < 6; i++) J[i] += world[i];
    add_arms(J, m, d, d);
}

static void add_flexible(struct aggregate *o, struct flexible *f, const double *d, const double *u,
                         const double *world_w, int what)
{
    double v[3], w[3], p[3], L[3], P[3], N[3], h[3], T;
    spatial_flex_shape(f);
    m3_tmul(v, f->R, u);
    m3_tmul(w, f->R, world_w);
    flex_momentum(p, L, &T, f->kernel, &f->shape, v, w, f->q1);
    m3_mul(P, f->R, p);
    m3_mul(N, f->R, L);
    m3_mul(h, f->R, f->shape.h);
    add_momenta(o, P, N, d);
    o->m += f->mass;
    v3_axpy(o->c, f->mass, d);
    v3_add(o->c, h);
    o->T += T;
    if (what < AGGREGATE_INERTIA) return;
    add_inertia(o->J, f->shape.J, f->R, f->mass, d);
    add_arms(o->J, 2, d, h);
}

static inline void add_rigid(struct aggregate *o, const struct link *l, const struct part *x, const double *d,
                             const double *u, int what)
{
    double p[3], w[3], spin[3], L[3];
    v3_scale(p, l->mass, u);
    m3_tmul(w, x->R, x->w);
    s3_mul(spin, l->inertia, w);
    m3_mul(L, x->R, spin);
    add_momenta(o, p, L, d);
    o->m += l->mass;
    v3_axpy(o->c, l->mass, d);
    o->T += .5 * (v3_dot(p, u) + v3_dot(spin, w));
    if (what >= AGGREGATE_INERTIA) add_inertia(o->J, l->inertia, x->R, l->mass, d);
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

static inline void add_forces(struct aggregate *o, const struct part *x, const double *d, const double *u)
{
    v3_add(o->F, x->F);
    v3_add(o->N, x->N);
    v3_cross_add(o->N, d, x->F);
    o->W += v3_dot(u, x->F) + v3_dot(x->w, x->N);
}

/* From sums about the root's frame, with S in c. */
static void about_centre(struct aggregate *o, const struct part *root, const double *gravity)
{
    double c[3], v[3];
    v3_scale(c, 1 / o->m, o->c);
    v3_scale(v, -1 / o->m, o->p);
    v3_cross_add(o->L, o->c, v);
    o->T += .5 * v3_dot(v, o->p);
    add_arms(o->J, -o->m, c, c);
    o->W += v3_dot(v, o->F);
    v3_cross_add(o->N, o->F, c);
    v3_axpy(o->F, o->m, gravity);
    v3_sum(o->c, root->r, c);
    v3_axpy(o->p, o->m, root->v);
}

void spatial_aggregate(struct sweep *s, struct aggregate *o, const int *body, int n, int what)
{
    const struct part *root = &s->part[body[0]];
    *o = (struct aggregate){.m = 0};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        struct flexible *f = spatial_flexible(s, body[i]);
        double d[3], u[3];
        v3_diff(d, x->r, root->r);
        v3_diff(u, x->v, root->v);
        if (f)
            add_flexible(o, f, d, u, x->w, what);
        else
            add_rigid(o, &s->link[body[i]], x, d, u, what);
        if (what < AGGREGATE_FORCES) continue;
        add_forces(o, x, d, u);
        if (f) o->W += power_of_modes(f, s->model->body[body[i]].flex);
    }
    about_centre(o, root, s->model->gravity);
}

static void adjust_flexible(struct part *x, struct flexible *f, const double *a, const double *al, double k)
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

void spatial_adjust_motion(struct sweep *s, const struct motion_change *o, const struct aggregate *now, const int *body,
                           int n)
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
        v3_add(x->r, o->dr);
        v3_add(x->v, o->dv);
        if (f) {
            adjust_flexible(x, f, a, al, o->k);
            continue;
        }
        v3_axpy(x->F, l->mass, a);
        m3_tmul(alb, x->R, al);
        s3_mul(N, l->inertia, alb);
        m3_mul_add(x->N, x->R, N);
    }
}
