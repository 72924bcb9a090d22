/* spatial_factor.c -- (cm M^ + diag(d)) x = b in space by articulated bodies, O(N).
 *
 * A = [J H; H' M] is the inertia with which a body resists a twist (w, v) of its centre when the joints beyond it
 * are free.  Each unit velocity s of a joint is eliminated in turn, which for a joint of several is the
 * Cholesky factorization S'A S + diag(d) = L D L' taken row by row,
 *
 *     U = A s,   D = s.U + d,   A := A - U U'/D,
 *
 * and the rest is carried to the parent's centre.  The same steps on the right side, with the bias p, and back:
 *
 *     e = b - s.p,   p := p + U e/D;      x = (e - U.V)/D,   V := V + s x.
 *
 * A coordinate with d = INFINITY is held: 1/D = 0, and A, p and V pass it as they are.
 *
 * Featherstone, Int. J. Robotics Res. 2 (1983) 13. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "tree/spatial.h"

struct pivot {
    struct twist s, U;
    double inverse;
};

/* F: the arms of all bodies, then the pivots by body and place in its joint. */
static double (*arms(const void *F))[3]
{
    return (double(*)[3])F;
}

static struct pivot *pivots(const struct sweep *s, const void *F)
{
    return (struct pivot *)(arms(F) + s->nbody);
}

size_t spatial_factor_size(const struct sweep *s)
{
    return sizeof(double[3]) * (size_t)s->nbody + sizeof(struct pivot) * (size_t)s->n;
}

static inline double along(const struct twist *a, const struct twist *b)
{
    return v3_dot(a->w, b->w) + v3_dot(a->v, b->v);
}

static inline void add(struct twist *o, double s, const struct twist *a)
{
    v3_axpy(o->w, s, a->w);
    v3_axpy(o->v, s, a->v);
}

/* U = A u. */
static inline void resist(struct twist *restrict U, const struct articulated *restrict A,
                          const struct twist *restrict u)
{
    s3_mul(U->w, A->J, u->w);
    m3_mul_add(U->w, A->H, u->v);
    m3_tmul(U->v, A->H, u->w);
    U->v[0] += A->M[0] * u->v[0] + A->M[3] * u->v[1] + A->M[4] * u->v[2];
    U->v[1] += A->M[3] * u->v[0] + A->M[1] * u->v[1] + A->M[5] * u->v[2];
    U->v[2] += A->M[4] * u->v[0] + A->M[5] * u->v[1] + A->M[2] * u->v[2];
}

/* S -= a a'/D, with b = a/D. */
static inline void take_square(double *S, const double *b, const double *a)
{
    S[0] -= b[0] * a[0];
    S[1] -= b[1] * a[1];
    S[2] -= b[2] * a[2];
    S[3] -= b[0] * a[1];
    S[4] -= b[0] * a[2];
    S[5] -= b[1] * a[2];
}

/* 1 when the coordinate is held or the pivot stands out of the round-off of the terms it is a sum of. */
static inline int eliminate(struct pivot *restrict o, struct articulated *restrict A, double d)
{
    resist(&o->U, A, &o->s);
    o->inverse = 0;
    if (d == INFINITY) return 1;
    double D = d, size = fabs(d);
    for (int i = 0; i < 3; i++) {
        double w = o->s.w[i] * o->U.w[i], v = o->s.v[i] * o->U.v[i];
        D += w + v;
        size += fabs(w) + fabs(v);
    }
    if (!(D > 8 * DBL_EPSILON * size)) return 0;
    o->inverse = 1 / D;
    struct twist U;
    v3_scale(U.w, o->inverse, o->U.w);
    v3_scale(U.v, o->inverse, o->U.v);
    take_square(A->J, U.w, o->U.w);
    take_square(A->M, U.v, o->U.v);
    for (int j = 0; j < 3; j++) v3_axpy(A->H + 3 * j, -U.v[j], o->U.w);
    return 1;
}

/* A about the parent's centre, where the twist is (w, v - w x d) with d the arm: H := H + [d]x M,
 * J := J - H [d]x + [d]x H_new', of which row i is d x (row i of H) and column i is d x (row i of H_new). */
static inline void carry(struct articulated *restrict to, const struct articulated *restrict A,
                         const double *restrict d)
{
    const double *M = A->M;
    double H[9], X[3][3], Y[3][3];
    memcpy(H, A->H, sizeof H);
    v3_cross_add(H, d, (double[]){M[0], M[3], M[4]});
    v3_cross_add(H + 3, d, (double[]){M[3], M[1], M[5]});
    v3_cross_add(H + 6, d, (double[]){M[4], M[5], M[2]});
    for (int i = 0; i < 3; i++) {
        v3_cross(X[i], d, (double[]){A->H[i], A->H[3 + i], A->H[6 + i]});
        v3_cross(Y[i], d, (double[]){H[i], H[3 + i], H[6 + i]});
    }
    for (int i = 0; i < 9; i++) to->H[i] += H[i];
    for (int i = 0; i < 6; i++) to->M[i] += M[i];
    for (int i = 0; i < 3; i++) to->J[i] += A->J[i] + X[i][i] + Y[i][i];
    to->J[3] += A->J[3] + X[0][1] + Y[1][0];
    to->J[4] += A->J[4] + X[0][2] + Y[2][0];
    to->J[5] += A->J[5] + X[1][2] + Y[2][1];
}

/* A rigid body's own. */
static inline void start(struct articulated *A, double cm, const struct link *l, const struct part *x)
{
    s3_turn(A->J, x->R, l->inertia);
    for (int i = 0; i < 6; i++) A->J[i] *= cm;
    memset(A->H, 0, sizeof A->H);
    A->M[0] = A->M[1] = A->M[2] = cm * l->mass;
    A->M[3] = A->M[4] = A->M[5] = 0;
}

int spatial_factor(struct sweep *s, void *F, double cm, const double *d, const double *q, unsigned cls)
{
    const bool *only = cls == LIMBS ? s->rosters.limbs : NULL;
    double(*arm)[3] = arms(F);
    struct pivot *pivot = pivots(s, F) + s->n;
    if (s->nflexible) return 0;
    if (q) spatial_place(s, q, cls);
    for (int i = 1; i < s->nbody; i++)
        if (!only || only[i]) start(&s->articulated[i], cm, &s->link[i], &s->part[i]);
    for (int i = s->nbody - 1; i > 0; i--) {
        const struct link *l = &s->link[i];
        pivot -= l->nv;
        if (only && !only[i]) continue;
        for (int k = 0; k < l->nv; k++) {
            spatial_unit(&pivot[k].s, &s->part[i], l, k);
            if (!eliminate(&pivot[k], &s->articulated[i], d[l->iv[k]])) return 0;
        }
        v3_copy(arm[i], s->part[i].arm);
        if (l->parent) carry(&s->articulated[l->parent], &s->articulated[i], arm[i]);
    }
    return 1;
}

/* Forces p inwards; x becomes e/D. */
static void inwards(const struct sweep *s, const void *F, double *x)
{
    double(*arm)[3] = arms(F);
    const struct pivot *pivot = pivots(s, F) + s->n;
    memset(s->bias, 0, sizeof *s->bias * (size_t)s->nbody);
    for (int i = s->nbody - 1; i > 0; i--) {
        const struct link *l = &s->link[i];
        struct twist *here = &s->bias[i], *up = &s->bias[l->parent];
        pivot -= l->nv;
        for (int k = 0; k < l->nv; k++) {
            const struct pivot *o = &pivot[k];
            double e = (x[l->iv[k]] - along(&o->s, here)) * o->inverse;
            x[l->iv[k]] = e;
            add(here, e, &o->U);
        }
        v3_add(up->v, here->v);
        v3_add(up->w, here->w);
        v3_cross_add(up->w, arm[i], here->v);
    }
}

/* Twists V outwards. */
static void outwards(const struct sweep *s, const void *F, double *x)
{
    double(*arm)[3] = arms(F);
    const struct pivot *pivot = pivots(s, F);
    memset(s->bias, 0, sizeof *s->bias);
    for (int i = 1; i < s->nbody; i++) {
        const struct link *l = &s->link[i];
        struct twist V = s->bias[l->parent];
        v3_cross_add(V.v, V.w, arm[i]);
        for (int k = l->nv - 1; k >= 0; k--) {
            const struct pivot *o = &pivot[k];
            double here = x[l->iv[k]] -= o->inverse * along(&o->U, &V);
            add(&V, here, &o->s);
        }
        s->bias[i] = V;
        pivot += l->nv;
    }
}

void spatial_solve(const struct sweep *s, const void *F, double *x)
{
    inwards(s, F, x);
    outwards(s, F, x);
}
