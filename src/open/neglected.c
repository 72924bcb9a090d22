/* neglected.c -- see neglected.h */
#include "open/neglected.h"

#include "flex/motion.h"
#include "la/vec3.h"

struct neglected {
    const struct flex_body *less, *full;
    int n;
    bool stiffens;
    struct flex_kernel *kernel[2]; /* without it, with it */
    struct flex_shape shape[2];
    double *Q[2], *d, *Me; /* [n], [n x n] */
};

struct neglected *neglected_open(const struct model_body *b, struct arena *life)
{
    if (!b->full || b->full->n == 0) return NULL;
    struct neglected *o = TAKE(life, struct neglected, 1);
    *o = (struct neglected){.less = b->flex, .full = b->full, .n = b->full->n};
    o->stiffens = b->full->s && !b->flex->s;
    o->d = TAKE(life, double, o->n);
    o->Me = TAKE_MATRIX(life, double, o->n, o->n);
    flex_mass(o->Me, o->full);
    for (int k = 0; k < 2 && o->stiffens; k++) {
        o->kernel[k] = flex_kernel_build(k ? o->full : o->less, life);
        flex_shape_take(&o->shape[k], o->kernel[k], life);
        o->Q[k] = TAKE(life, double, o->n);
    }
    return o;
}

bool neglected_stiffens(const struct neglected *o)
{
    return o->stiffens;
}

bool neglected_damps(const struct neglected *o)
{
    return o->full->D && !o->less->D;
}

void neglected_inertia(struct neglected *o, const struct neglected_motion *x)
{
    double F[3], N[3];
    for (int k = 0; k < 2 && o->stiffens; k++) {
        flex_shape_at(&o->shape[k], o->kernel[k], x->q);
        flex_inertia(F, N, o->Q[k], o->kernel[k], &o->shape[k], x->a, x->w, x->al, x->q, x->q1, x->q2, false);
    }
    for (int i = 0; i < o->n && o->stiffens; i++) o->d[i] = o->Q[1][i] - o->Q[0][i];
}

/* d(1/2 q'Sq)/dq = S q, and so of the turn. */
void neglected_load(struct neglected *o, int node, const double *f, const double *n, const double *q)
{
    const struct flex_node *p = &o->full->node[node];
    for (int j = 0; j < o->n && o->stiffens; j++)
        for (int i = 0; i < o->n; i++) {
            if (p->S) o->d[i] -= q[j] * v3_dot(p->S + 3 * (i + o->n * j), f);
            if (p->T) o->d[i] -= q[j] * v3_dot(p->T + 3 * (i + o->n * j), n);
        }
}

void neglected_sum(struct neglected_sums *to, const struct neglected *o, const double *q, const double *q1)
{
    const int n = o->n;
    for (int j = 0; j < n; j++) {
        if (o->stiffens) to->work += q[j] * o->d[j];
        for (int i = 0; i < n; i++) {
            to->stiff += q[i] * o->full->K[i + n * j] * q[j];
            to->inertia += q1[i] * o->Me[i + n * j] * q1[j];
            if (o->full->D && !o->less->D) to->power += q1[i] * o->full->D[i + n * j] * q1[j];
        }
    }
}
