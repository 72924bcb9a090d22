/* moves.c -- positions moved by quasi-displacements; see moves.h */
#include "tree/moves.h"

#include "la/rot.h"
#include "la/vec3.h"

/* The place of a joint's quaternion among its positions; -1: it has none. */
static int quaternion_at(const struct model_joint *joint)
{
    return joint->nq == joint->nv ? -1 : joint->nq - 4;
}

/* Sorted in, by the place of the velocity; returns the new number. */
static int by_place(int *iq, int *iv, int n, int q, int v)
{
    int i = n;
    for (; i > 0 && iv[i - 1] > v; i--) {
        iq[i] = iq[i - 1];
        iv[i] = iv[i - 1];
    }
    iq[i] = q;
    iv[i] = v;
    return n + 1;
}

void moves_build(struct moves *o, const struct model *m, struct arena *life)
{
    int *iq = TAKE(life, int, m->n), *iv = TAKE(life, int, m->n);
    struct turn *turn = TAKE(life, struct turn, m->njoint);
    *o = (struct moves){.iq = iq, .iv = iv, .turn = turn};
    for (int j = 0; j < m->njoint; j++) {
        const struct model_joint *joint = &m->joint[j];
        int at = quaternion_at(joint), plain = at < 0 ? joint->nv : at;
        for (int k = 0; k < plain; k++) o->nplain = by_place(iq, iv, o->nplain, joint->iq[k], joint->iv[k]);
        if (at < 0) continue;
        struct turn *t = &turn[o->nturn++];
        for (int k = 0; k < 4; k++) t->iq[k] = joint->iq[at + k];
        for (int k = 0; k < 3; k++) t->iv[k] = joint->iv[at + k];
    }
    for (int b = 1; b < m->nbody; b++) {
        const struct model_body *body = &m->body[b];
        for (int k = 0; k < body->nmode; k++) o->nplain = by_place(iq, iv, o->nplain, body->mode_q[k], body->mode_v[k]);
    }
    while (o->nfirst < o->nplain && iq[o->nfirst] == o->nfirst && iv[o->nfirst] == o->nfirst) o->nfirst++;
}

static void quat_in(double *x, const double *q, const struct turn *t)
{
    for (int k = 0; k < 4; k++) x[k] = q[t->iq[k]];
}

static void rates_in(double *x, const double *v, const struct turn *t)
{
    for (int k = 0; k < 3; k++) x[k] = v[t->iv[k]];
}

static void rates_out(double *v, const double *x, const struct turn *t)
{
    for (int k = 0; k < 3; k++) v[t->iv[k]] = x[k];
}

void moves_point(const struct moves *m, double *q1, const double *q0, const double *dx, double s)
{
    for (int i = 0; i < m->nfirst; i++) q1[i] = q0[i] + s * dx[i];
    for (int i = m->nfirst; i < m->nplain; i++) q1[m->iq[i]] = q0[m->iq[i]] + s * dx[m->iv[i]];
    for (int i = 0; i < m->nturn; i++) {
        const struct turn *t = &m->turn[i];
        double q[4], phi[3];
        quat_in(q, q0, t);
        rates_in(phi, dx, t);
        quat_move(q, q, phi, s);
        for (int k = 0; k < 4; k++) q1[t->iq[k]] = q[k];
    }
}

void moves_diff(const struct moves *m, double *dx, const double *q1, const double *q0)
{
    for (int i = 0; i < m->nfirst; i++) dx[i] = q1[i] - q0[i];
    for (int i = m->nfirst; i < m->nplain; i++) dx[m->iv[i]] = q1[m->iq[i]] - q0[m->iq[i]];
    for (int i = 0; i < m->nturn; i++) {
        const struct turn *t = &m->turn[i];
        double a[4], b[4], phi[3];
        quat_in(a, q0, t);
        quat_in(b, q1, t);
        quat_diff(phi, b, a);
        rates_out(dx, phi, t);
    }
}

void moves_left(const struct moves *m, double *dx, const double *q1, const double *q0, const double *dx0, double s)
{
    for (int i = 0; i < m->nturn; i++) {
        const struct turn *t = &m->turn[i];
        double a[4], b[4], phi[3];
        quat_in(a, q1, t);
        quat_in(b, q0, t);
        rates_in(phi, dx0, t);
        quat_move(b, b, phi, s);
        quat_diff(phi, b, a);
        rates_out(dx, phi, t);
    }
}

void moves_rate(const struct moves *m, double *dxrate, const double *dx, const double *v)
{
    for (int i = 0; i < m->nplain; i++) dxrate[m->iv[i]] = v[m->iv[i]];
    for (int i = 0; i < m->nturn; i++) {
        const struct turn *t = &m->turn[i];
        double phi[3], w[3], rate[3];
        rates_in(phi, dx, t);
        rates_in(w, v, t);
        cay_rate(rate, phi, w);
        rates_out(dxrate, rate, t);
    }
}

void moves_bend(const struct moves *m, double *off, const double *v, const double *a, int order)
{
    for (int i = 0; i < m->nplain; i++) off[m->iv[i]] = 0;
    for (int i = 0; i < m->nturn; i++) {
        const struct turn *t = &m->turn[i];
        double w[3], rate[3], x[3];
        rates_in(w, v, t);
        rates_in(rate, a, t);
        v3_cross(x, w, rate);
        const double square = v3_dot(w, w), by = order > 2 ? square * square : square;
        for (int k = 0; k < 3; k++) x[k] = by * w[k] + (order > 2 ? 0 : x[k]);
        rates_out(off, x, t);
    }
}
