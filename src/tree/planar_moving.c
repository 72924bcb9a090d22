/* planar_moving.c -- the whole matrix of a rigid tree in the plane, cm dr/da + cc dr/dv + ck dr/dq + diag(d), by articulated
 * bodies, O(N).
 *
 * Let coordinates change by x ck, their rates by x cc, the rates of these by x cm.  A body's angle, its rate and its angular
 * acceleration are sums over its path, so that they change by ck X, cc X and cm X, X = sum of turn x.  With complex numbers for
 * vectors of the plane (i turns by a right angle), a vector rho that turns with body p adds (i al - w^2) rho to accelerations,
 * and that changes by
 *
 *     X i mu rho,   mu = cm - ck w^2 + i (ck al + 2 cc w);
 *
 * a displacement of rate u along e, which p turns, adds e u' + 2 i w e u, and that changes by x mu e + X i nu e,
 * nu = ck u' + 2 cc u + 2 i ck w u.  So the change of a motion goes outwards as a twist does, by arms of its own.  That of the
 * forces goes inwards by the arms as they are; besides, arms that turn give the forces F at hand other moments: -ck X c . F
 * about a joint, -ck X_p rho . F on the parent, and with a displacement ck x e x F there and ck X_p e x F along it.
 *
 * The elimination is that of planar_factor.c with rows and columns told apart, the rotation of a joint first, whose
 * displacements then stand on the parent:
 *
 *     U = I s,  W = I' l,  D = l.U + d,  I := I - U W'/D;    e = b - l.p,  p := p + U e/D;    x = (e - W.V)/D,  V := V + s x.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "tree/planar_flex.h"

struct pivot {
    double s[3], l[3], U[3], W[3], inverse; /* W over D */
};

struct arms {
    double in[2], out[2]; /* of forces inwards, of changes of motion outwards */
};

static struct arms *arms(const void *F)
{
    return (struct arms *)F;
}

static struct pivot *pivots(const struct sweep *s, const void *F)
{
    return (struct pivot *)(arms(F) + s->nbody);
}

size_t planar_moving_size(const struct sweep *s)
{
    return sizeof(struct arms) * (size_t)s->nbody + sizeof(struct pivot) * (size_t)s->n;
}

/* z += i mu x. */
static inline void add_turned(double *z, const double *mu, const double *x)
{
    z[0] -= mu[0] * x[1] + mu[1] * x[0];
    z[1] += mu[0] * x[0] - mu[1] * x[1];
}

struct weights {
    double cm, cc, ck;
};

static inline void turning_of(double *mu, const struct part *x, const struct weights *c)
{
    mu[0] = c->cm - c->ck * x->w * x->w;
    mu[1] = c->ck * x->al + 2 * c->cc * x->w;
}

/* Unit changes of the k-th coordinate: as force takes them, and as they move the body. */
static inline void unit(struct pivot *o, const struct part *x, const struct link *l, int k, const double *mu,
                        const double *mu_p)
{
    planar_unit(o->l, x, l, k);
    double *s = o->s;
    s[0] = s[1] = s[2] = 0;
    if (planar_turns(l, k)) {
        add_turned(s + 1, mu, x->c_b);
        s[0] = l->turn;
        s[1] *= l->turn;
        s[2] *= l->turn;
        return;
    }
    s[1] = mu_p[0] * x->e[k][0] - mu_p[1] * x->e[k][1];
    s[2] = mu_p[0] * x->e[k][1] + mu_p[1] * x->e[k][0];
}

/* Arms; of the changes of motion from the parent's turning, mu_p rho + nu e, and from its own. */
static inline void reach(struct arms *o, const struct part *x, const struct part *p, const struct link *l,
                         const struct weights *c, const double *mu, const double *mu_p, const double *v,
                         const double *a)
{
    o->in[0] = x->arm[0], o->in[1] = x->arm[1];
    o->out[0] = o->out[1] = 0;
    add_turned(o->out, mu_p, x->rho);
    add_turned(o->out, mu, x->c_b);
    for (int k = 0; k < l->nv; k++) {
        if (planar_turns(l, k)) continue;
        const double u = v[l->iv[k]];
        add_turned(o->out, (double[]){c->ck * a[l->iv[k]] + 2 * c->cc * u, 2 * c->ck * p->w * u}, x->e[k]);
    }
}

/* 1 when the pivot stands out of the round-off of the terms it is a sum of.  I [9] as in struct moving; more: ck e x F. */
INTO static inline int eliminate(struct pivot *restrict o, double *restrict I, double d, double more)
{
    const double s0 = o->s[0], s1 = o->s[1], s2 = o->s[2], l0 = o->l[0], l1 = o->l[1], l2 = o->l[2];
    const double U0 = I[0] * s0 + I[1] * s1 + I[2] * s2 + more;
    const double U1 = I[3] * s0 + I[4] * s1 + I[5] * s2, U2 = I[6] * s0 + I[7] * s1 + I[8] * s2;
    const double W0 = l0 * I[0] + l1 * I[3] + l2 * I[6] + more;
    const double W1 = l0 * I[1] + l1 * I[4] + l2 * I[7], W2 = l0 * I[2] + l1 * I[5] + l2 * I[8];
    const double x0 = l0 * U0, x1 = l1 * U1, x2 = l2 * U2, D = x0 + x1 + x2 + d;
    if (!(fabs(D) > 8 * DBL_EPSILON * (fabs(x0) + fabs(x1) + fabs(x2) + fabs(d)))) return 0;
    const double i = o->inverse = 1 / D, i0 = i * U0, i1 = i * U1, i2 = i * U2;
    o->U[0] = U0, o->U[1] = U1, o->U[2] = U2;
    o->W[0] = i * W0, o->W[1] = i * W1, o->W[2] = i * W2;
    I[0] -= i0 * W0, I[1] -= i0 * W1, I[2] -= i0 * W2;
    I[3] -= i1 * W0, I[4] -= i1 * W1, I[5] -= i1 * W2;
    I[6] -= i2 * W0, I[7] -= i2 * W1, I[8] -= i2 * W2;
    return 1;
}

/* Of the parent: moments by the arm as it is, motion by the other. */
INTO static inline void carry(double *restrict to, const double *restrict I, const struct arms *restrict arm)
{
    const double in0 = arm->in[0], in1 = arm->in[1], out0 = arm->out[0], out1 = arm->out[1];
    const double X = I[3] + I[4] * out0 + I[5] * out1, Y = I[6] + I[7] * out0 + I[8] * out1;
    to[0] += I[0] + I[1] * out0 + I[2] * out1 + in0 * Y - in1 * X;
    to[1] += I[1] + in0 * I[7] - in1 * I[4];
    to[2] += I[2] + in0 * I[8] - in1 * I[5];
    to[3] += X, to[4] += I[4], to[5] += I[5];
    to[6] += Y, to[7] += I[7], to[8] += I[8];
}

/* Its own inertia, and what its turning arm makes of the force on it. */
static inline void own(struct moving *o, const struct part *x, const struct link *l, const struct weights *c)
{
    double *I = o->I;
    turning_of(o->mu, x, c);
    I[0] = c->cm * l->inertia - c->ck * v2_dot(x->c_b, x->F);
    I[1] = I[2] = I[3] = I[5] = I[6] = I[7] = 0;
    I[4] = I[8] = l->mass;
}

/* A hinge, what most trees are made of, in one piece. */
INTO static inline int hinge(struct pivot *restrict o, struct moving *restrict here, const struct moving *restrict up,
                             struct arms *restrict arm, const struct part *restrict x, double turn, double d)
{
    const double *mu = here->mu, *mu_p = up->mu;
    double s1 = -mu[0] * x->c_b[1] - mu[1] * x->c_b[0], s2 = mu[0] * x->c_b[0] - mu[1] * x->c_b[1];
    o->s[0] = o->l[0] = turn;
    o->s[1] = turn * s1, o->s[2] = turn * s2;
    o->l[1] = -turn * x->c_b[1], o->l[2] = turn * x->c_b[0];
    arm->in[0] = x->arm[0], arm->in[1] = x->arm[1];
    arm->out[0] = s1 - mu_p[0] * x->rho[1] - mu_p[1] * x->rho[0];
    arm->out[1] = s2 + mu_p[0] * x->rho[0] - mu_p[1] * x->rho[1];
    return eliminate(o, here->I, d, 0);
}

/* Any joint: its last velocity first. */
static int joint(struct pivot *pivot, struct moving *here, const struct moving *up, struct arms *arm,
                 const struct part *x, const struct part *p, const struct link *l, const struct weights *c,
                 const double *d, const double *v, const double *a)
{
    for (int k = l->nv - 1; k >= 0; k--) {
        const double more = planar_turns(l, k) ? 0 : c->ck * v2_cross(x->e[k], x->F);
        unit(&pivot[k], x, l, k, here->mu, up->mu);
        if (!eliminate(&pivot[k], here->I, d[l->iv[k]], more)) return 0;
    }
    reach(arm, x, p, l, c, here->mu, up->mu, v, a);
    return 1;
}

int planar_moving_factor(struct sweep *s, void *F, double cm, double cc, double ck, const double *d, const double *v,
                         const double *a)
{
    const struct weights c = {cm, cc, ck};
    struct pivot *pivot = pivots(s, F) + s->n;
    if (s->bend) return 0;
    for (int i = 0; i < s->nbody; i++) own(&s->moving[i], &s->part[i], &s->link[i], &c);
    for (int i = s->nbody - 1; i > 0; i--) {
        const struct link *l = &s->link[i];
        const struct part *x = &s->part[i], *p = &s->part[l->parent];
        struct arms *arm = &arms(F)[i];
        struct moving *here = &s->moving[i], *up = &s->moving[l->parent];
        pivot -= l->nv;
        if (!(l->type == TURN ? hinge(pivot, here, up, arm, x, l->turn, d[l->iv[0]])
                              : joint(pivot, here, up, arm, x, p, l, &c, d, v, a)))
            return 0;
        carry(up->I, here->I, arm);
        up->I[0] -= ck * v2_dot(x->rho, x->F);
    }
    return 1;
}

/* x becomes e/D, and the forces p pass on. */
INTO static inline void force_on(const struct pivot *restrict o, double *restrict x, double *restrict p)
{
    const double e = *x = (*x - o->l[0] * p[0] - o->l[1] * p[1] - o->l[2] * p[2]) * o->inverse;
    p[0] += o->U[0] * e;
    p[1] += o->U[1] * e;
    p[2] += o->U[2] * e;
}

INTO static inline void move_on(const struct pivot *restrict o, double *restrict x, double *restrict V)
{
    const double here = *x -= o->W[0] * V[0] + o->W[1] * V[1] + o->W[2] * V[2];
    V[0] += o->s[0] * here;
    V[1] += o->s[1] * here;
    V[2] += o->s[2] * here;
}

void planar_moving_solve(const struct sweep *s, const void *F, double *x)
{
    const struct arms *arm = arms(F);
    const struct pivot *pivot = pivots(s, F) + s->n;
    double(*bias)[3] = s->bias;
    for (int i = 0; i < s->nbody; i++) bias[i][0] = bias[i][1] = bias[i][2] = 0;
    for (int i = s->nbody - 1; i > 0; i--) {
        const struct link *l = &s->link[i];
        double p[3] = {bias[i][0], bias[i][1], bias[i][2]}, *up = bias[l->parent];
        if (l->nv == 1) /* in most trees all are */
            force_on(--pivot, &x[l->iv[0]], p);
        else
            for (int k = l->nv - 1; k >= 0; k--) force_on(--pivot, &x[l->iv[k]], p);
        up[0] += p[0] - arm[i].in[1] * p[1] + arm[i].in[0] * p[2];
        up[1] += p[1];
        up[2] += p[2];
    }
    bias[0][0] = bias[0][1] = bias[0][2] = 0; /* from here on changes of motion */
    for (int i = 1; i < s->nbody; i++) {
        const struct link *l = &s->link[i];
        const double *up = bias[l->parent];
        double V[3] = {up[0], up[1] + arm[i].out[0] * up[0], up[2] + arm[i].out[1] * up[0]};
        if (l->nv == 1)
            move_on(pivot++, &x[l->iv[0]], V);
        else
            for (int k = 0; k < l->nv; k++) move_on(pivot++, &x[l->iv[k]], V);
        for (int c = 0; c < 3; c++) bias[i][c] = V[c];
    }
}
