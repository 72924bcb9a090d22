/* planar_factor.c -- (cm M^ + diag(d)) x = b in the plane by articulated bodies, O(N).
 *
 * I is the inertia (ww wx wy xx xy yy) with which a body resists its parent's twist (w, vx, vy of its centre)
 * when the joints beyond it are free.  Each unit velocity s of a joint is eliminated in turn, displacements first,
 *
 *     U = I s,   D = s.U + d,   I := I - U U'/D,
 *
 * and the rest is carried to the parent's centre.  The same steps on the right side, with the bias p, and back:
 *
 *     e = b - s.p,   p := p + U e/D;      x = (e - U.V)/D,   V := V + s x.
 *
 * A coordinate with d = INFINITY is held: 1/D = 0, and I, p and V pass it as they are.  A flexible body's modes are
 * eliminated all together before its joint.
 *
 * Featherstone, Int. J. Robotics Res. 2 (1983) 13. */
#include <float.h>
#include <math.h>

#include "la/vec3.h"
#include "tree/planar_flex.h"

struct pivot {
    double s[3], U[3], inverse;
};

/* F: the arms of all bodies, then the pivots by body and place in its joint (as many again as there are modes are
 * not used), then what the modes need. */
static double (*arms(const void *F))[2]
{
    return (double(*)[2])F;
}

static struct pivot *pivots(const struct sweep *s, const void *F)
{
    return (struct pivot *)(arms(F) + s->nbody);
}

static double *modes(const struct sweep *s, const void *F)
{
    return (double *)(pivots(s, F) + s->n);
}

size_t planar_factor_size(const struct sweep *s)
{
    return sizeof(double[2]) * (size_t)s->nbody + sizeof(struct pivot) * (size_t)s->n + sizeof(double) * s->for_modes;
}

/* 1 when the coordinate is held or the pivot stands out of the round-off of the terms it is a sum of. */
static inline int eliminate(struct pivot *o, double *I, double d)
{
    const double *u = o->s;
    double *U = o->U;
    U[0] = I[0] * u[0] + I[1] * u[1] + I[2] * u[2];
    U[1] = I[1] * u[0] + I[3] * u[1] + I[4] * u[2];
    U[2] = I[2] * u[0] + I[4] * u[1] + I[5] * u[2];
    o->inverse = 0;
    if (d == INFINITY) return 1;
    double x[3] = {u[0] * U[0], u[1] * U[1], u[2] * U[2]};
    double D = x[0] + x[1] + x[2] + d;
    if (!(D > 8 * DBL_EPSILON * (fabs(x[0]) + fabs(x[1]) + fabs(x[2]) + fabs(d)))) return 0;
    double i = o->inverse = 1 / D, U0 = i * U[0], U1 = i * U[1];
    I[0] -= U0 * U[0];
    I[1] -= U0 * U[1];
    I[2] -= U0 * U[2];
    I[3] -= U1 * U[1];
    I[4] -= U1 * U[2];
    I[5] -= i * U[2] * U[2];
    return 1;
}

/* The nv velocities of a joint. */
INTO static inline int joint(struct pivot *pivot, struct part *x, const struct link *l, const double *d, int nv)
{
    for (int k = 0; k < nv; k++) {
        planar_unit(pivot[k].s, x, l, k);
        if (!eliminate(&pivot[k], x->I, d[l->iv[k]])) return 0;
    }
    return 1;
}

/* I about the parent's centre: the twist there is (w, v - w J arm). */
static inline void carry(double *to, const double *I, const double *arm)
{
    double tx = -arm[1], ty = arm[0];
    double w = I[0] + I[1] * tx + I[2] * ty, x = I[1] + I[3] * tx + I[4] * ty, y = I[2] + I[4] * tx + I[5] * ty;
    to[0] += w + tx * x + ty * y;
    to[1] += x;
    to[2] += y;
    to[3] += I[3];
    to[4] += I[4];
    to[5] += I[5];
}

/* only [nbody]: those bodies; NULL: all. */
TWICE int factor(struct sweep *s, void *F, double cm, const double *d, const bool *only, bool flexible)
{
    double(*arm)[2] = arms(F);
    struct pivot *base = pivots(s, F);
    for (int i = 1; i < s->nbody; i++) {
        double *I = s->part[i].I;
        if (only && !only[i]) continue;
        I[0] = cm * s->link[i].inertia;
        I[3] = I[5] = cm * s->link[i].mass;
        I[1] = I[2] = I[4] = 0;
    }
    if (flexible) planar_flex_start(s, cm, d, only);
    for (int i = s->nbody - 1; i > 0; i--) {
        const struct link *l = &s->link[i];
        struct part *x = &s->part[i];
        struct pivot *pivot = base + l->pivot;
        if (only && !only[i]) continue;
        if (flexible && !planar_flex_eliminate(s, modes(s, F), i, d)) return 0;
        if (!(l->type == TURN ? joint(pivot, x, l, d, 1) : joint(pivot, x, l, d, l->nv))) return 0;
        arm[i][0] = x->arm[0];
        arm[i][1] = x->arm[1];
        if (l->parent) carry(s->part[l->parent].I, x->I, x->arm);
    }
    return 1;
}

int planar_factor(struct sweep *s, void *F, double cm, const double *d, const double *q, unsigned cls)
{
    const bool *only = cls == LIMBS ? s->rosters.limbs : NULL;
    if (q) planar_place(s, q, cls);
    if (s->bend) return factor(s, F, cm, d, only, true);
    return only ? factor(s, F, cm, d, only, false) : factor(s, F, cm, d, NULL, false);
}

/* From a body to its parent: right sides, and the bias that it has itself and brings up. */
INTO static inline void inwards(double *restrict up, double *restrict here, const struct link *l,
                                const struct pivot *pivot, double *restrict x, const double *arm, int nv)
{
    double h0 = here[0], h1 = here[1], h2 = here[2];
    for (int k = 0; k < nv; k++) {
        const struct pivot *o = &pivot[k];
        const double e = (x[l->iv[k]] - (o->s[0] * h0 + o->s[1] * h1 + o->s[2] * h2)) * o->inverse;
        x[l->iv[k]] = e;
        h0 += o->U[0] * e;
        h1 += o->U[1] * e;
        h2 += o->U[2] * e;
    }
    up[0] += h0 - arm[1] * h1 + arm[0] * h2;
    up[1] += h1;
    up[2] += h2;
}

/* And back: its twist V from that of its parent, and x. */
INTO static inline void outwards(double *restrict V, const double *restrict up, const struct link *l,
                                 const struct pivot *pivot, double *restrict x, const double *arm, int nv)
{
    double V0 = up[0], V1 = up[1] - arm[1] * up[0], V2 = up[2] + arm[0] * up[0];
    for (int k = nv - 1; k >= 0; k--) {
        const struct pivot *o = &pivot[k];
        const double here = x[l->iv[k]] - o->inverse * (o->U[0] * V0 + o->U[1] * V1 + o->U[2] * V2);
        x[l->iv[k]] = here;
        V0 += o->s[0] * here;
        V1 += o->s[1] * here;
        V2 += o->s[2] * here;
    }
    V[0] = V0, V[1] = V1, V[2] = V2;
}

/* limb: the only one with right sides that are not zero; 0: not known. */
TWICE void solve(const struct sweep *s, const void *F, double *x, bool flexible, int limb)
{
    double(*arm)[2] = arms(F);
    const struct pivot *pivot = pivots(s, F);
    const int first = limb ? limb : 1, last = limb ? s->link[limb].last : s->nbody - 1;
    double(*p)[3] = s->bias;
    p[0][0] = p[0][1] = p[0][2] = 0;
    for (int i = first; i <= last; i++) p[i][0] = p[i][1] = p[i][2] = 0;
    for (int i = last; i >= first; i--) {
        const struct link *l = &s->link[i];
        if (limb && l->limb != limb) continue;
        if (flexible) planar_flex_forces(s, modes(s, F), p[i], x, i);
        if (l->nv == 1)
            inwards(p[l->parent], p[i], l, pivot + l->pivot, x, arm[i], 1);
        else
            inwards(p[l->parent], p[i], l, pivot + l->pivot, x, arm[i], l->nv);
    }
    p[0][0] = p[0][1] = p[0][2] = 0; /* from here on twists */
    for (int i = first; i <= last; i++) {
        const struct link *l = &s->link[i];
        if (limb && l->limb != limb) continue;
        if (l->nv == 1)
            outwards(p[i], p[l->parent], l, pivot + l->pivot, x, arm[i], 1);
        else
            outwards(p[i], p[l->parent], l, pivot + l->pivot, x, arm[i], l->nv);
        if (flexible) planar_flex_twist(s, modes(s, F), p[i], x, i);
    }
}

/* The limb where all that is not zero in x stands; 0: there are several, or but one at all. */
static int only_limb(const struct sweep *s, const double *x)
{
    int limb = 0;
    if (s->limbs == 1) return 0;
    for (int i = 0; i < s->n; i++) {
        if (x[i] == 0 || s->limb[i] == limb) continue;
        if (limb) return 0;
        limb = s->limb[i];
    }
    return limb;
}

void planar_solve(const struct sweep *s, const void *F, double *x)
{
    const int limb = s->bend ? 0 : only_limb(s, x);
    if (s->bend)
        solve(s, F, x, true, 0);
    else if (limb)
        solve(s, F, x, false, limb);
    else
        solve(s, F, x, false, 0);
}
