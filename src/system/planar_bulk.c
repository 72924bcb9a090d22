/* planar_bulk.c -- bodies of the plane as one: momenta, their rates, and one rigid motion for all; see sweep.h.
 *
 * About the root's frame o, with d = r - o and u = v - v_o, so that little is lost where the bodies are far from the
 * world's origin or fast:
 *
 *     S = sum m d + h,   P = sum m u,   L = sum (d x m u + I w),   J = sum (I + m d.d + 2 d.h)
 *     centre c = o + S/m,   momentum m v_o + P,   about the centre L - S x P/m,   J - S.S/m
 *
 * h is the first moment of a flexible body about its frame; it has its P, L and I from its own T. */
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

static inline double cross2(const double *x, const double *y)
{
    return x[0] * y[1] - x[1] * y[0];
}

struct sums {
    double m, S[2], P[2], L, J;
};

/* Mass m with first moment h about the body's frame, momentum p and angular momentum L about it; d from the root. */
static inline void add(struct sums *o, double m, const double *d, const double *h, const double *p, double L, double J)
{
    o->m += m;
    for (int i = 0; i < 2; i++) {
        o->S[i] += m * d[i] + h[i];
        o->P[i] += p[i];
    }
    o->L += L + cross2(d, p);
    o->J += J + m * (d[0] * d[0] + d[1] * d[1]) + 2 * (d[0] * h[0] + d[1] * h[1]);
}

static inline struct bend *bend_of(const struct sweep *s, int body)
{
    return s->bend ? s->bend[body] : NULL;
}

/* About the centre of mass. */
static void centre(struct bulk *o, const struct sums *x, const struct part *root)
{
    *o = (struct bulk){.m = x->m, .J = {1, 1, x->J - (x->S[0] * x->S[0] + x->S[1] * x->S[1]) / x->m}};
    for (int i = 0; i < 2; i++) {
        o->c[i] = root->r[i] + x->S[i] / x->m;
        o->p[i] = x->P[i];
    }
    o->L[2] = x->L - cross2(x->S, x->P) / x->m;
}

void planar_momentum(struct sweep *s, struct bulk *o, const int *body, int n)
{
    static const double none[2] = {0, 0};
    const struct part *root = &s->part[body[0]];
    struct sums sum = {0};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        struct bend *b = bend_of(s, body[i]);
        const double d[2] = {x->r[0] - root->r[0], x->r[1] - root->r[1]};
        const double u[2] = {x->v[0] - root->v[0], x->v[1] - root->v[1]};
        if (b) {
            double ub[2], pb[2], p[2], h[2], L;
            planar_flex_shape(b);
            turn_back(ub, b->cs, u);
            flex_planar_momentum(pb, &L, b->kernel, &b->shape, ub, x->w, b->v);
            turn2(p, b->cs, pb);
            planar_flex_first_moment(h, b);
            add(&sum, s->model->body[body[i]].mass, d, h, p, L, 0);
        } else {
            add(&sum, l->mass, d, none, (double[]){l->mass * u[0], l->mass * u[1]}, l->inertia * x->w, 0);
        }
    }
    centre(o, &sum, root);
    for (int i = 0; i < 2; i++) o->p[i] += sum.m * root->v[i];
}

void planar_inertia(struct sweep *s, struct bulk *o, const int *body, int n)
{
    static const double none[2] = {0, 0};
    const struct part *root = &s->part[body[0]];
    struct sums sum = {0};
    for (int i = 0; i < n; i++) {
        const struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        const struct bend *b = bend_of(s, body[i]);
        const double d[2] = {x->r[0] - root->r[0], x->r[1] - root->r[1]};
        double h[2];
        if (b) planar_flex_first_moment(h, b);
        add(&sum, s->model->body[body[i]].mass, d, b ? h : none, x->F, x->N, b ? b->shape.J : l->inertia);
    }
    centre(o, &sum, root);
    for (int i = 0; i < 2; i++) o->p[i] += sum.m * s->model->gravity[i];
}

static void hasten_flexible(struct part *x, struct bend *b, const double *zero, const double *a, double al)
{
    double ab[2], Fb[2], F[2], N;
    turn_back(ab, b->cs, a);
    flex_planar_inertia(Fb, &N, b->U, b->kernel, &b->shape, ab, 0, al, zero, zero);
    turn2(F, b->cs, Fb);
    x->F[0] += F[0];
    x->F[1] += F[1];
    x->N += N;
    for (int k = 0; k < b->n; k++) b->Q[k] += b->U[k];
}

void planar_hasten(struct sweep *s, const int *body, int n, const double *c, const double *a, const double *al)
{
    for (int i = 0; i < n; i++) {
        struct part *x = &s->part[body[i]];
        const struct link *l = &s->link[body[i]];
        struct bend *b = bend_of(s, body[i]);
        const double here[2] = {a[0] - al[2] * (x->r[1] - c[1]), a[1] + al[2] * (x->r[0] - c[0])};
        if (b) {
            hasten_flexible(x, b, s->zero, here, al[2]);
            continue;
        }
        x->F[0] += l->mass * here[0];
        x->F[1] += l->mass * here[1];
        x->N += l->inertia * al[2];
    }
}
