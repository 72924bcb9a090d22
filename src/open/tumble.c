/* tumble.c -- see tumble.h */
#include "open/tumble.h"

#include <float.h>
#include <math.h>

#include "la/rot.h"
#include "la/vec3.h"

static const double SHRINKS = .5; /* a correction against the last, where the iteration leads anywhere */
enum { MOST = 30 };

bool tumbles(const struct model *m, int body)
{
    const struct model_body *b = &m->body[body];
    const struct model_joint *j = &m->joint[b->joint];
    double A[6];
    if (m->space == 2 || b->parent != 0 || b->flex || !joint_turns_freely(model_kind(m, j->type))) return false;
    /* on a ball away from its centre gravity and the joint turn it */
    if (j->nv == 3 && v3_norm(j->b) > 0) return false;
    for (int i = 0; i < 6; i++)
        if (b->held && b->held[i] != 0) return false;
    s3_invert(A, b->inertia);
    return isfinite(v3_norm(A) + v3_norm(A + 3)) && A[0] > 0 && A[1] > 0 && A[2] > 0;
}

void tumbler_make(struct tumbler *o, const struct model *m, int body)
{
    const struct model_body *b = &m->body[body];
    const struct model_joint *j = &m->joint[b->joint];
    for (int k = 0; k < 4; k++) o->iq[k] = j->iq[j->nq - 4 + k];
    for (int k = 0; k < 3; k++) o->iv[k] = j->iv[j->nv - 3 + k];
    for (int i = 0; i < 6; i++) o->J[i] = b->inertia[i];
    s3_invert(o->Jinv, o->J);
}

/* Turns w1 to where the equation is solved; returns false, and w1 as it was, where that does not come nearer. */
static bool solve(double *w1, const struct tumbler *o, const double *w0, double h)
{
    double x[3], last = INFINITY;
    v3_copy(x, w1);
    for (int i = 0; i < MOST; i++) {
        double w[3], Jw[3], N[3], d[3];
        v3_sum(w, w0, x);
        v3_scale(w, .5, w);
        s3_mul(Jw, o->J, w);
        v3_cross(N, Jw, w);
        s3_mul(d, o->Jinv, N);
        v3_scale(d, h, d);
        v3_add(d, w0);
        v3_take(d, x);
        const double size = v3_norm(d), least = 4 * DBL_EPSILON * v3_norm(w);
        if (!(size <= fmax(SHRINKS * last, least))) return false;
        v3_add(x, d);
        if (size <= least) {
            v3_copy(w1, x);
            return true;
        }
        last = size;
    }
    return false;
}

/* J w1 = R1' R0 J w0 */
static void keep_momentum(double *w1, const struct tumbler *o, const double *w0, const double *q0, const double *q1)
{
    double R0[9], R1[9], L[3], world[3], back[3];
    quat_matrix(R0, q0);
    quat_matrix(R1, q1);
    s3_mul(L, o->J, w0);
    m3_mul(world, R0, L);
    m3_tmul(back, R1, world);
    s3_mul(w1, o->Jinv, back);
}

void tumbler_settle(const struct tumbler *o, double *q1, double *v1, const struct instant *x)
{
    const double h = x->tb - x->ta;
    double a[4], b[4], w0[3], w1[3], phi[3];
    for (int k = 0; k < 4; k++) a[k] = x->qa[o->iq[k]];
    for (int k = 0; k < 4; k++) b[k] = q1[o->iq[k]];
    for (int k = 0; k < 3; k++) w0[k] = x->va[o->iv[k]];
    for (int k = 0; k < 3; k++) w1[k] = v1[o->iv[k]];
    if (x->t == x->tb) {
        keep_momentum(w1, o, w0, a, b);
    } else if (solve(w1, o, w0, h)) {
        v3_sum(phi, w0, w1);
        v3_scale(phi, h / 2, phi);
        quat_move(b, a, phi, 1);
    }
    for (int k = 0; k < 4; k++) q1[o->iq[k]] = b[k];
    for (int k = 0; k < 3; k++) v1[o->iv[k]] = w1[k];
}
