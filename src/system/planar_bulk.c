/* planar_bulk.c -- bodies of the plane as one: momenta, what their inertia takes, changes of their motion; see sweep.h.
 *
 * About the root's frame o, with d = r - o and u = v - v_o, so that little is lost where the bodies are far from the
 * world's origin or fast:
 *
 *     S = sum m d + h,   P = sum m u,   L = sum (d x m u + I w),   J = sum (I + m d.d + 2 d.h),   2 T = sum (m u.u + I
 * w w) centre c = o + S/m,   momentum m v_o + P;   about the centre L - S x P/m,   J - S.S/m,   2 T - P.P/m
 *
 * h is the first moment of a flexible body about its frame; it has its P, L, I and T from its own kinetic energy. */
#include "system/planar_flex.h"

static inline void turn2(double *y, const double *cs, const double *x)
{
    y[0] = cs[0] * x[0] - cs[1] * x[1];
    y[1] = cs[1] * x[0] + cs[0] * x[1];
}

static inline void turn_back(double *y, const double *cs, const double *x)
{
    y[0] = cs[0] * x[0] + cs[1] * x[1];
    y[1] = cs[0] * x[1] - cs[1] * x[0];
}

static inline double dot2(const double *x, const double *y)
{
    return x[0] * y[0] + x[1] * y[1];
}

static inline double cross2(const double *x, const double *y)
{
    return x[0] * y[1] - x[1] * y[0];
}

static inline struct bend *bend_of(const struct sweep *s, int body)
{
    return s->bend ? s->bend[body] : NULL;
}

/* One body about its own frame. */
struct share {
    double m, h[2], p[2], L, J, T;
};

static void share_of_flexible(struct share *o, struct bend *b, double m, const double *u, double w)
{
    double ub[2], pb[2];
    planar_flex_shape(b);
    turn_back(ub, b->cs, u);
    flex_planar_momentum(pb, &o->L, b->kernel, &b->shape, ub, w, b->v);
    turn2(o->p, b->cs, pb);
    planar_flex_first_moment(o->h, b);
    o->m = m;
    o->J = b->shape.J;
    o->T = flex_planar_kinetic(b->kernel, &b->shape, ub, w, b->v);
}

static inline void share_of_rigid(struct share *o, const struct link *l, const double *u, double w)
{
    *o = (struct share){.m = l->mass,
                        .p = {l->mass * u[0], l->mass * u[1]},
                        .L = l->inertia * w,
                        .J = l->inertia,
                        .T = .5 * (l->mass * dot2(u, u) + l->inertia * w * w)};
}

void planar_momentum(struct sweep *s, struct bulk *o, const int *body, int n)
{
    const struct part *root = &s->part[body[0]];
    double m = 0, S[2] = {0, 0}, P[2] = {0, 0}, L = 0, J = 0, T = 0;
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const double d[2] = {x->r[0] - root->r[0], x->r[1] - root->r[1]};
        const double u[2] = {x->v[0] - root->v[0], x->v[1] - root->v[1]};
        struct bend *b = bend_of(s, body[i]);
        struct share y;
        if (b)
            share_of_flexible(&y, b, s->model->body[body[i]].mass, u, x->w);
        else
            share_of_rigid(&y, &s->link[body[i]], u, x->w);
        m += y.m;
        for (int k = 0; k < 2; k++) {
            S[k] += y.m * d[k] + y.h[k];
            P[k] += y.p[k];
        }
        L += y.L + cross2(d, y.p);
        J += y.J + y.m * dot2(d, d) + 2 * dot2(d, y.h);
        T += y.T;
    }
    *o = (struct bulk){.m = m,
                       .c = {root->r[0] + S[0] / m, root->r[1] + S[1] / m},
                       .p = {m * root->v[0] + P[0], m * root->v[1] + P[1]},
                       .L = {0, 0, L - cross2(S, P) / m},
                       .J = {1, 1, J - dot2(S, S) / m},
                       .T = T - .5 * dot2(P, P) / m};
}

/* Power of the modes' rows, without that of stiffness and damping. */
static double power_of_modes(const struct bend *b)
{
    double W = 0;
    for (int k = 0; k < b->n; k++) b->U[k] = 0;
    flex_planar_elastic(b->U, b->kernel, b->q, b->v);
    for (int k = 0; k < b->n; k++) W += b->v[k] * (b->Q[k] - b->U[k]);
    return W;
}

void planar_inertia(struct sweep *s, struct drag *o, const struct bulk *now, const int *body, int n)
{
    const double per = 1 / now->m, *g = s->model->gravity;
    *o = (struct drag){.F = {now->m * g[0], now->m * g[1]}};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const struct bend *b = bend_of(s, body[i]);
        const double d[2] = {x->r[0] - now->c[0], x->r[1] - now->c[1]};
        const double u[2] = {x->v[0] - per * now->p[0], x->v[1] - per * now->p[1]};
        o->F[0] += x->F[0];
        o->F[1] += x->F[1];
        o->N[2] += x->N + cross2(d, x->F);
        o->W += dot2(u, x->F) + x->w * x->N;
        if (b) o->W += power_of_modes(b);
    }
}

static void hasten_flexible(struct part *x, struct bend *b, const double *zero, const double *a, double al, double k)
{
    double ab[2], Fb[2], F[2], N;
    turn_back(ab, b->cs, a);
    for (int i = 0; i < b->n; i++) b->a[i] = k * b->v[i];
    flex_planar_inertia(Fb, &N, b->U, b->kernel, &b->shape, ab, 0, al, zero, b->a);
    turn2(F, b->cs, Fb);
    x->F[0] += F[0];
    x->F[1] += F[1];
    x->N += N;
    for (int i = 0; i < b->n; i++) b->Q[i] += b->U[i];
}

void planar_hasten(struct sweep *s, const struct change *o, const struct bulk *now, const int *body, int n)
{
    const double per = 1 / now->m;
    for (int i = 0; i < n; i++) {
        struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        struct bend *b = bend_of(s, body[i]);
        const double d[2] = {x->r[0] - now->c[0], x->r[1] - now->c[1]}, al = o->al[2] + o->k * x->w;
        const double a[2] = {o->a[0] - o->al[2] * d[1] + o->k * (x->v[0] - per * now->p[0]),
                             o->a[1] + o->al[2] * d[0] + o->k * (x->v[1] - per * now->p[1])};
        x->v[0] += o->dv[0];
        x->v[1] += o->dv[1];
        if (b) {
            hasten_flexible(x, b, s->zero, a, al, o->k);
            continue;
        }
        x->F[0] += l->mass * a[0];
        x->F[1] += l->mass * a[1];
        x->N += l->inertia * al;
    }
}
