/* planar_aggregate.c -- bodies of the plane as one: momenta, what their inertia takes, changes of their motion; see sweep.h.
 *
 * About the root's frame o, with d = r - o and u = v - v_o, so that little is lost where the bodies are far from the
 * world's origin or fast:
 *
 *     S = sum m d + h,   P = sum m u,   L = sum (d x m u + I w),   J = sum (I + m d.d + 2 d.h)
 *     2 T = sum (m u.u + I w w)
 *     F = sum F,   N = sum (d x F + N),   W = sum (u.F + w N + q'.Q)
 *
 * the centre is c = o + S/m, the momentum m v_o + P, and about the centre
 *
 *     L - S x P/m,   J - S.S/m,   2 T - P.P/m,   N - S x F/m,   W - P.F/m.
 *
 * h is the first moment of a flexible body about its frame; it has its P, L, I and T from its own kinetic energy, and Q
 * without stiffness and damping.  Gravity, which is in the accelerations, has no moment about the centre. */
#include "tree/planar_flex.h"

/* The sums; S, P, F in the plane. */
struct sums {
    double m, S[2], P[2], L, J, T, F[2], N, W;
};

static inline void add_flexible(struct sums *o, struct flexible *b, double m, const double *d, const double *u,
                                double w)
{
    double ub[2], pb[2], p[2], h[2], L, T;
    planar_flex_shape(b);
    v2_turn_back(ub, b->cs, u);
    flex_planar_momentum(pb, &L, &T, b->kernel, &b->shape, ub, w, b->v);
    v2_turn(p, b->cs, pb);
    planar_flex_first_moment(h, b);
    o->m += m;
    for (int k = 0; k < 2; k++) {
        o->S[k] += m * d[k] + h[k];
        o->P[k] += p[k];
    }
    o->L += L + v2_cross(d, p);
    o->J += b->shape.J + m * v2_dot(d, d) + 2 * v2_dot(d, h);
    o->T += T;
}

static inline void add_rigid(struct sums *o, const struct link *l, const double *d, const double *u, double w)
{
    o->m += l->mass;
    for (int k = 0; k < 2; k++) {
        o->S[k] += l->mass * d[k];
        o->P[k] += l->mass * u[k];
    }
    o->L += l->inertia * w + l->mass * v2_cross(d, u);
    o->J += l->inertia + l->mass * v2_dot(d, d);
    o->T += .5 * (l->inertia * w * w + l->mass * v2_dot(u, u));
}

/* Power of the modes' rows, without that of stiffness and damping. */
static double power_of_modes(const struct flexible *b)
{
    double W = 0;
    for (int k = 0; k < b->n; k++) b->U[k] = 0;
    flex_planar_elastic(b->U, b->kernel, b->q, b->v);
    for (int k = 0; k < b->n; k++) W += b->v[k] * (b->Q[k] - b->U[k]);
    return W;
}

static inline void add_forces(struct sums *o, const struct part *x, const double *d, const double *u)
{
    o->F[0] += x->F[0];
    o->F[1] += x->F[1];
    o->N += x->N + v2_cross(d, x->F);
    o->W += v2_dot(u, x->F) + x->w * x->N;
}

void planar_aggregate(struct sweep *s, struct aggregate *o, const int *body, int n, int what)
{
    const struct part *root = &s->part[body[0]];
    const double *g = s->model->gravity;
    struct sums y = {.m = 0};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const double d[2] = {x->r[0] - root->r[0], x->r[1] - root->r[1]};
        const double u[2] = {x->v[0] - root->v[0], x->v[1] - root->v[1]};
        struct flexible *b = s->bend ? s->bend[body[i]] : NULL;
        if (b)
            add_flexible(&y, b, s->model->body[body[i]].mass, d, u, x->w);
        else
            add_rigid(&y, &s->link[body[i]], d, u, x->w);
        if (what < AGGREGATE_FORCES) continue;
        add_forces(&y, x, d, u);
        if (b) y.W += power_of_modes(b);
    }
    const double c[2] = {y.S[0] / y.m, y.S[1] / y.m}, v[2] = {y.P[0] / y.m, y.P[1] / y.m};
    *o = (struct aggregate){.m = y.m,
                            .c = {root->r[0] + c[0], root->r[1] + c[1]},
                            .p = {y.m * root->v[0] + y.P[0], y.m * root->v[1] + y.P[1]},
                            .L = {0, 0, y.L - v2_cross(c, y.P)},
                            .T = y.T - .5 * v2_dot(v, y.P),
                            .J = {1, 1, y.J - v2_dot(c, y.S)},
                            .F = {y.F[0] + y.m * g[0], y.F[1] + y.m * g[1]},
                            .N = {0, 0, y.N - v2_cross(c, y.F)},
                            .W = y.W - v2_dot(v, y.F)};
}

static void adjust_flexible(struct part *x, struct flexible *b, const double *zero, const double *a, double al,
                            double k)
{
    double ab[2], Fb[2], F[2], N;
    v2_turn_back(ab, b->cs, a);
    for (int i = 0; i < b->n; i++) b->a[i] = k * b->v[i];
    flex_planar_inertia(Fb, &N, b->U, b->kernel, &b->shape, ab, 0, al, zero, b->a);
    v2_turn(F, b->cs, Fb);
    x->F[0] += F[0];
    x->F[1] += F[1];
    x->N += N;
    for (int i = 0; i < b->n; i++) b->Q[i] += b->U[i];
}

void planar_adjust_motion(struct sweep *s, const struct motion_change *o, const struct aggregate *now, const int *body,
                          int n)
{
    const double per = 1 / now->m;
    for (int i = 0; i < n; i++) {
        struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        struct flexible *b = s->bend ? s->bend[body[i]] : NULL;
        const double d[2] = {x->r[0] - now->c[0], x->r[1] - now->c[1]}, al = o->al[2] + o->k * x->w;
        const double a[2] = {o->a[0] - o->al[2] * d[1] + o->k * (x->v[0] - per * now->p[0]),
                             o->a[1] + o->al[2] * d[0] + o->k * (x->v[1] - per * now->p[1])};
        for (int j = 0; j < 2; j++) {
            x->r[j] += o->dr[j];
            x->v[j] += o->dv[j];
        }
        if (b) {
            adjust_flexible(x, b, s->zero, a, al, o->k);
            continue;
        }
        x->F[0] += l->mass * a[0];
        x->F[1] += l->mass * a[1];
        x->N += l->inertia * al;
    }
}
