/* start.c -- the initial state: 0 everywhere but for what `initial:` says.
 *
 * Angular velocities may be given in world axes: the orientations at the start are needed for that,
 * body by body from the ground. */
#include <math.h>
#include <string.h>

#include "la/rot.h"
#include "la/vec3.h"
#include "model/parts.h"

static void turn(double *R, double angle, int axis)
{
    double q[4] = {cos(angle / 2), 0, 0, 0};
    q[1 + axis] = sin(angle / 2);
    quat_matrix(R, q);
}

/* J(q): how the joint axes of the child stand against those of the parent, by angles. */
static void joint_turn(double *J, const struct model_joint *j, const struct joint_kind *kind, const double *q)
{
    m3_unit(J);
    for (int k = 0; k < j->nv; k++) {
        double before[9], T[9];
        if (!kind->freedom[k].turns) continue;
        memcpy(before, J, sizeof before);
        turn(T, q[j->iq[k]], kind->freedom[k].axis);
        m3_mulm(J, before, T);
    }
}

/* How a node's small body stands in the frame. */
static void node_turn(double *T, const struct model_body *parent, int node, const double *q)
{
    const struct flex_node *at = &parent->flex->node[node];
    const int n = parent->nmode;
    double theta[3] = {0, 0, 0}, turn[4];
    for (int k = 0; k < n; k++) {
        v3_axpy(theta, q[parent->mode_q[k]], at->psi + 3 * k);
        for (int i = 0; at->T && i < n; i++)
            v3_axpy(theta, .5 * q[parent->mode_q[k]] * q[parent->mode_q[i]], at->T + 3 * (i + n * k));
    }
    quat_cay(turn, theta);
    quat_matrix(T, turn);
}

/* World orientations of all bodies at q. */
static void orientations(const struct making *o, double (*R)[9], const double *q)
{
    memcpy(R[0], o->body[0].R, sizeof *R);
    for (int i = 1; i < o->m->nbody; i++) {
        const struct model_joint *j = &o->joint[o->body[i].joint];
        double J[9], A[9], B[9];
        if (o->body[i].at_node) {
            node_turn(J, &o->body[j->parent], o->body[i].node, q);
            m3_mulm(R[i], R[j->parent], J);
            continue;
        }
        m3_mulm(A, R[j->parent], j->Ea);
        if (j->nq > j->nv) { /* the quaternion turns the child's own axes */
            double T[9];
            m3_mulmt(B, A, j->Eb);
            quat_matrix(T, &q[j->iq[j->nq - 4]]);
            m3_mulm(R[i], B, T);
            continue;
        }
        joint_turn(J, j, model_kind(o->m, j->type), q);
        m3_mulm(B, A, J);
        m3_mulmt(R[i], B, j->Eb);
    }
}

/* A turn given in drawn world axes as a quaternion in the child's axes. */
static void put_rotation(const struct making *o, double *q, const struct model_joint *j, const double *x)
{
    double *to = &q[j->iq[j->nq - 4]];
    to[0] = x[0];
    m3_tmul(to + 1, o->body[j->child].R, x + 1);
    if (j->reversed) v3_scale(to + 1, -1, to + 1);
}

static void put_omega(double *v, const struct model_joint *j, const double *R, const struct scene_initial *s)
{
    double omega[3];
    if (s->body_axes)
        v3_copy(omega, s->x);
    else
        m3_tmul(omega, R, s->x);
    for (int k = 0; k < 3; k++) v[j->iv[j->nv - 3 + k]] = j->reversed ? -omega[k] : omega[k];
}

static void give(double *x, bool *given, int i, double value)
{
    x[i] = value;
    given[i] = true;
}

void make_start(struct making *o)
{
    struct model *m = o->m;
    const struct scene *scene = o->scene;
    double *q = TAKE(o->life, double, m->nq), *v = TAKE(o->life, double, m->n);
    bool *given_q = TAKE(o->life, bool, m->nq), *given_v = TAKE(o->life, bool, m->n);
    for (int i = 0; i < m->njoint; i++)
        if (o->joint[i].nq > o->joint[i].nv) q[o->joint[i].iq[o->joint[i].nq - 4]] = 1;
    for (int i = 0; i < scene->ninitial; i++) {
        const struct scene_initial *s = &scene->initial[i];
        if (s->joint < 0) {
            const struct model_body *b = &o->body[o->body_of[s->body]];
            const int k = model_mode(b, s->k);
            if (k >= 0 && s->type == INITIAL_POSITION) give(q, given_q, b->mode_q[k], s->x[0]);
            if (k >= 0 && s->type == INITIAL_RATE) give(v, given_v, b->mode_v[k], s->x[0]);
            continue;
        }
        if (s->type == INITIAL_POSITION) give(q, given_q, position_place(o, s->joint, s->k), s->x[0]);
        if (s->type == INITIAL_RATE) give(v, given_v, rate_place(o, s->joint, s->k), s->x[0]);
        if (s->type == INITIAL_ROTATION) put_rotation(o, q, &o->joint[o->joint_of[s->joint]], s->x);
    }
    struct arena_mark mark = arena_mark(o->life);
    double(*R)[9] = arena_take(o->life, (size_t)m->nbody, sizeof *R);
    orientations(o, R, q);
    for (int i = 0; i < scene->ninitial; i++) {
        const struct scene_initial *s = &scene->initial[i];
        if (s->type != INITIAL_OMEGA) continue;
        const struct model_joint *j = &o->joint[o->joint_of[s->joint]];
        put_omega(v, j, R[j->child], s);
    }
    arena_rewind(o->life, mark);
    m->q0 = q;
    m->v0 = v;
    m->given_q = given_q;
    m->given_v = given_v;
    m->t0 = scene->start;
    m->length = scene->length;
    m->assemble = scene->assemble;
}
