/* trees.h -- random mechanisms for tests, built by hand: every joint, any tree, plane or space.
 *
 *     struct model *m = random_tree(3, 6, seed, TREE_FORCES, arena);
 *
 * nbody bodies besides the ground.  The same arguments give the same model.  Nothing is drawn in a special
 * position: bodies, joint axes and initial states are all random; q0 holds unit quaternions. */
#ifndef FMDSUB_TESTS_TREES_H
#define FMDSUB_TESTS_TREES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/arena.h"
#include "kind/bushing.h"
#include "kind/spring.h"
#include "model/model.h"
#include "system/ode2.h"

enum tree_flag {
    TREE_CHAIN = 1,       /* every body hangs on the one before it */
    TREE_FAST_LEAVES = 2, /* the joints of the last bodies of all branches are fast (else all is slow) */
    TREE_FORCES = 4,      /* springs and dampers along all measures, loads, bushings, tables of time */
    TREE_REVOLUTE = 8,    /* revolute joints only */
    TREE_LIGHT = 16,      /* no fixed, spherical and free joints: q' = v throughout */
    TREE_FREE_FALL = 32,  /* no gravity */
    TREE_ADRIFT = 64      /* every body on a free joint from the ground */
};

struct tree_dice {
    uint64_t state;
};

static inline double tree_roll(struct tree_dice *d, double lo, double hi) /* splitmix64 */
{
    uint64_t z = (d->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return lo + (hi - lo) * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline int tree_pick(struct tree_dice *d, int n)
{
    return (int)tree_roll(d, 0, n - 1e-9);
}

static inline void tree_vector(double *x, struct tree_dice *d, int space)
{
    for (int i = 0; i < 3; i++) x[i] = i < space ? tree_roll(d, -1, 1) : 0;
}

/* R [9] by column of a unit quaternion. */
static inline void tree_matrix(double *R, const double *q)
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    double M[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z),     2 * (x * z - w * y),
                   2 * (x * y - w * z),     1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
                   2 * (x * z + w * y),     2 * (y * z - w * x),     1 - 2 * (x * x + y * y)};
    memcpy(R, M, sizeof M);
}

static inline void tree_quaternion(double *q, struct tree_dice *d, int space)
{
    double norm;
    do {
        for (int i = 0; i < 4; i++) q[i] = tree_roll(d, -1, 1);
        if (space == 2) q[1] = q[2] = 0;
        norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    } while (norm < .1);
    for (int i = 0; i < 4; i++) q[i] /= norm;
}

/* C = A' B, C = A B, y = A' x, y = A x, 3 x 3 by column. */
static inline void tree_mtm(double *C, const double *A, const double *B)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[i + 3 * j] = A[3 * i] * B[3 * j] + A[3 * i + 1] * B[3 * j + 1] + A[3 * i + 2] * B[3 * j + 2];
}

static inline void tree_mm(double *C, const double *A, const double *B)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) C[i + 3 * j] = A[i] * B[3 * j] + A[i + 3] * B[3 * j + 1] + A[i + 6] * B[3 * j + 2];
}

static inline void tree_mtv(double *y, const double *A, const double *x)
{
    for (int i = 0; i < 3; i++) y[i] = A[3 * i] * x[0] + A[3 * i + 1] * x[1] + A[3 * i + 2] * x[2];
}

static inline void tree_mv(double *y, const double *A, const double *x)
{
    for (int i = 0; i < 3; i++) y[i] = A[i] * x[0] + A[i + 3] * x[1] + A[i + 6] * x[2];
}

static inline int tree_nq(enum joint_type type, int space)
{
    static const int nq[JOINT_TYPES] = {0, 1, 1, 2, 1, 2, 4, 3, 7};
    return space == 2 && type == JOINT_FREE ? 3 : nq[type];
}

static inline int tree_nv(enum joint_type type, int space)
{
    static const int nv[JOINT_TYPES] = {0, 1, 1, 2, 1, 2, 3, 3, 6};
    return space == 2 && type == JOINT_FREE ? 3 : nv[type];
}

/* How far a screw goes [m/rad]. */
static inline double tree_pitch(double per_turn)
{
    return per_turn / (2 * acos(-1));
}

static inline enum joint_type tree_joint_type(struct tree_dice *d, int space, unsigned flags)
{
    static const enum joint_type plane[] = {JOINT_REVOLUTE, JOINT_PRISMATIC, JOINT_PLANAR,
                                            JOINT_REVOLUTE, JOINT_FREE,      JOINT_FIXED};
    static const enum joint_type room[] = {JOINT_REVOLUTE,  JOINT_PRISMATIC, JOINT_CYLINDRICAL,
                                           JOINT_UNIVERSAL, JOINT_PLANAR,    JOINT_SCREW,
                                           JOINT_SPHERICAL, JOINT_FREE,      JOINT_FIXED};
    bool light = flags & TREE_LIGHT;
    if (flags & TREE_REVOLUTE) return JOINT_REVOLUTE;
    if (flags & TREE_ADRIFT) return JOINT_FREE;
    if (space == 2) return plane[tree_pick(d, light ? 4 : 6)];
    return room[tree_pick(d, light ? 6 : 9)];
}

/* A body anywhere, turned anyhow, with a tensor that some solid has: xx < yy + zz and so on. */
static inline void tree_body(struct model_body *b, struct tree_dice *d, int space)
{
    double q[4], R[9], J[3], x[3];
    b->mass = tree_roll(d, .5, 2);
    tree_vector(b->at, d, space);
    tree_quaternion(q, d, space);
    tree_matrix(b->R, q);
    for (int i = 0; i < 3; i++) x[i] = tree_roll(d, .05, .3);
    for (int i = 0; i < 3; i++) J[i] = x[(i + 1) % 3] + x[(i + 2) % 3];
    tree_quaternion(q, d, space);
    tree_matrix(R, q);
    static const int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
    for (int e = 0; e < 6; e++)
        for (int k = 0; k < 3; k++) b->inertia[e] += R[row[e] + 3 * k] * J[k] * R[col[e] + 3 * k];
}

/* The joint's axes in the world when drawn; in the plane z stands out of it, or lies in it for a prismatic joint. */
static inline void tree_axes(double *E, struct tree_dice *d, enum joint_type type, int space)
{
    double q[4];
    tree_quaternion(q, d, space);
    tree_matrix(E, q);
    if (space == 3) return;
    if (type == JOINT_PRISMATIC) { /* x, y, z := y, out, x */
        double x[3] = {E[0], E[1], 0}, y[3] = {E[3], E[4], 0}, out[3] = {0, 0, 1};
        memcpy(E, y, sizeof y), memcpy(E + 3, out, sizeof out), memcpy(E + 6, x, sizeof x);
    } else if (tree_pick(d, 3) == 0) { /* as a joint drawn the other way round: z into the plane */
        for (int i = 0; i < 3; i++) E[3 + i] = -E[3 + i], E[6 + i] = -E[6 + i];
    }
}

static inline void tree_joint(struct model_joint *j, struct tree_dice *d, const struct model_body *body, int parent,
                              int child, int space, unsigned flags)
{
    double at[3], E[9], x[3];
    j->parent = parent, j->child = child;
    j->type = tree_joint_type(d, space, flags);
    j->nq = tree_nq(j->type, space), j->nv = tree_nv(j->type, space);
    j->reversed = tree_pick(d, 4) == 0;
    if (j->type == JOINT_SCREW) j->number = tree_roll(d, -3, 3);
    tree_vector(at, d, space);
    tree_axes(E, d, j->type, space);
    const struct model_body *p = &body[parent], *c = &body[child];
    for (int i = 0; i < 3; i++) x[i] = at[i] - p->at[i];
    tree_mtv(j->a, p->R, x);
    for (int i = 0; i < 3; i++) x[i] = at[i] - c->at[i];
    tree_mtv(j->b, c->R, x);
    tree_mtm(j->Ea, p->R, E);
    tree_mtm(j->Eb, c->R, E);
}

/* Numbers the coordinates of the joints that are fast (slow). */
static inline void tree_number(struct model *m, struct model_joint *joint, const bool *fast, bool which)
{
    for (int i = 0; i < m->njoint; i++) {
        if (fast[i] != which) continue;
        for (int k = 0; k < joint[i].nq; k++) joint[i].iq[k] = m->nq++;
        for (int k = 0; k < joint[i].nv; k++) joint[i].iv[k] = m->n++;
    }
}

static inline bool tree_turns(const struct model_joint *j, int space)
{
    return j->type == JOINT_SPHERICAL || (j->type == JOINT_FREE && space == 3);
}

static inline void tree_state(double *q, double *v, const struct model *m, struct tree_dice *d)
{
    for (int i = 0; i < m->nq; i++) q[i] = tree_roll(d, -1, 1);
    for (int i = 0; i < m->n; i++) v[i] = tree_roll(d, -1, 1);
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        if (tree_turns(j, m->space)) tree_quaternion(q + j->iq[j->nq - 4], d, 3);
    }
}

static inline void tree_coordinates(struct model *m, struct arena *arena, const bool *fast)
{
    struct model_coordinate *c = TAKE(arena, struct model_coordinate, m->nq);
    m->ncoordinate = m->nq;
    m->coordinate = c;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        for (int k = 0; k < j->nq; k++) {
            bool plain = !tree_turns(j, m->space) || k < j->nq - 4;
            c[j->iq[k]] = (struct model_coordinate){.name = arena_print(arena, "%s.q%d", j->name, k),
                                                    .joint = i,
                                                    .k = k,
                                                    .iq = j->iq[k],
                                                    .iv = plain ? j->iv[k] : -1,
                                                    .fast = fast[i]};
        }
    }
}

static inline struct model_point tree_point(struct tree_dice *d, int body, int space)
{
    struct model_point p = {.name = "p", .body = body};
    tree_vector(p.p, d, space);
    return p;
}

/* Two different bodies. */
static inline void tree_pair(int *a, int *b, struct tree_dice *d, int nbody)
{
    *a = tree_pick(d, nbody);
    *b = (*a + 1 + tree_pick(d, nbody - 1)) % nbody;
}

static inline void tree_measures(struct model *m, struct tree_dice *d, struct arena *arena)
{
    struct model_measure *s = TAKE(arena, struct model_measure, m->nq + 3);
    for (int i = 0; i < m->nq; i++) {
        const struct model_coordinate *c = &m->coordinate[i];
        if (c->iv < 0) continue;
        s[m->nmeasure++] = (struct model_measure){
            .name = c->name, .type = MEASURE_COORDINATE, .iq = c->iq, .iv = c->iv, .fast = c->fast};
    }
    for (int type = MEASURE_DISTANCE; type <= MEASURE_ANGLE; type++) {
        struct model_measure *o = &s[m->nmeasure++];
        int a, b;
        tree_pair(&a, &b, d, m->nbody);
        *o = (struct model_measure){.name = "m", .type = (enum measure_type)type, .angular = type == MEASURE_ANGLE};
        o->a = tree_point(d, a, m->space), o->b = tree_point(d, b, m->space);
        double q[4], R[9];
        tree_quaternion(q, d, m->space);
        tree_matrix(R, q);
        memcpy(o->axis, m->space == 2 && type == MEASURE_ANGLE ? R + 6 : R, sizeof o->axis);
        o->fast = m->body[a].fast || m->body[b].fast;
    }
    m->measure = s;
}

static inline struct signal tree_table(struct tree_dice *d, struct arena *arena)
{
    double *t = TAKE(arena, double, 3), *x = TAKE(arena, double, 3);
    for (int i = 0; i < 3; i++) t[i] = i - 1, x[i] = tree_roll(d, -2, 2);
    return (struct signal){.n = 3, .t = t, .x = x};
}

static inline unsigned tree_class(bool fast)
{
    return fast ? FAST : SLOW;
}

static inline struct bushing *tree_bushing(struct tree_dice *d, struct arena *arena, const struct model *m, int a,
                                           int b)
{
    struct bushing *o = TAKE(arena, struct bushing, 1);
    double q[4], E[9];
    for (int i = 0; i < 3; i++) {
        o->k[i] = tree_roll(d, 5, 20), o->kr[i] = tree_roll(d, 1, 4);
        o->c[i] = tree_roll(d, .1, 1), o->cr[i] = tree_roll(d, .1, .5);
    }
    tree_quaternion(q, d, m->space);
    tree_matrix(E, q);
    tree_mtm(o->on.Ea, m->body[a].R, E);
    tree_mtm(o->on.Eb, m->body[b].R, E);
    return o;
}

/* A spring along every measure, a damper along some, tables of time along two, loads on two bodies, one bushing. */
static inline void tree_forces(struct model *m, struct tree_dice *d, struct arena *arena)
{
    struct model_force *f = TAKE(arena, struct model_force, 2 * m->nmeasure + 8);
    static const struct model_slot clock[1] = {{SLOT_TIME, 0}};
    int n = 0;
    for (int i = 0; i < m->nmeasure; i++) {
        struct spring *par = TAKE(arena, struct spring, 1);
        *par = (struct spring){.k = tree_roll(d, 5, 20),
                               .c = tree_roll(d, 0, 1),
                               .rest = tree_roll(d, -.2, .2),
                               .preload = tree_roll(d, -1, 1),
                               .cubic = i % 2 ? tree_roll(d, 0, 5) : 0};
        bool damper = i % 5 == 4;
        f[n++] = (struct model_force){.name = "law",
                                      .type = FORCE_LAW,
                                      .cls = tree_class(m->measure[i].fast),
                                      .measure = i,
                                      .kind = damper ? &force_damper : &force_spring,
                                      .par = par};
    }
    for (int i = 0; i < 2; i++)
        f[n++] = (struct model_force){.name = "value",
                                      .type = FORCE_VALUE,
                                      .cls = FAST,
                                      .nslot = 1,
                                      .slot = clock,
                                      .measure = tree_pick(d, m->nmeasure),
                                      .value = {tree_table(d, arena)}};
    for (int i = 0; i < 4; i++) {
        struct model_force *o = &f[n++];
        *o = (struct model_force){.name = "load",
                                  .type = FORCE_LOAD,
                                  .measure = -1,
                                  .cls = FAST,
                                  .nslot = 1,
                                  .slot = clock,
                                  .torque = i & 1,
                                  .body_axes = i & 2};
        o->b = tree_point(d, 1 + tree_pick(d, m->nbody - 1), m->space);
        for (int k = 0; k < 3; k++)
            if (m->space == 3 || (k == 2) == o->torque) o->value[k] = tree_table(d, arena);
    }
    int a, b;
    tree_pair(&a, &b, d, m->nbody);
    f[n] = (struct model_force){.name = "bushing",
                                .type = FORCE_BETWEEN,
                                .measure = -1,
                                .cls = tree_class(m->body[a].fast || m->body[b].fast),
                                .kind = &force_bushing,
                                .par = tree_bushing(d, arena, m, a, b)};
    f[n].a = tree_point(d, a, m->space);
    double x[3], y[3]; /* markers coincide when drawn */
    tree_mv(x, m->body[a].R, f[n].a.p);
    for (int i = 0; i < 3; i++) x[i] += m->body[a].at[i] - m->body[b].at[i];
    tree_mtv(y, m->body[b].R, x);
    f[n].b = (struct model_point){.name = "p", .body = b};
    memcpy(f[n].b.p, y, sizeof y);
    m->nforce = n + 1;
    m->force = f;
}

static inline struct model *random_tree(int space, int nbody, unsigned seed, unsigned flags, struct arena *arena)
{
    struct tree_dice dice = {seed * 7919u + (unsigned)nbody * 104729u + (unsigned)space}, *d = &dice;
    struct model *m = TAKE(arena, struct model, 1);
    struct model_body *body = TAKE(arena, struct model_body, nbody + 1);
    struct model_joint *joint = TAKE(arena, struct model_joint, nbody);
    bool *fast = TAKE(arena, bool, nbody + 1), *has_child = TAKE(arena, bool, nbody + 1);
    m->space = space, m->nbody = nbody + 1, m->njoint = nbody;
    m->body = body, m->joint = joint;
    if (!(flags & TREE_FREE_FALL))
        for (int i = 0; i < space; i++) m->gravity[i] = tree_roll(d, -10, 10);

    body[0] = (struct model_body){.name = "ground", .R = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .parent = -1, .joint = -1};
    for (int i = 1; i <= nbody; i++) {
        int parent = flags & TREE_ADRIFT ? 0 : flags & TREE_CHAIN ? i - 1 : tree_pick(d, i);
        tree_body(&body[i], d, space);
        body[i].name = arena_print(arena, "body%d", i);
        body[i].parent = parent, body[i].joint = i - 1;
        has_child[parent] = true;
        joint[i - 1].name = arena_print(arena, "joint%d", i);
        tree_joint(&joint[i - 1], d, body, parent, i, space, flags);
    }
    for (int i = 1; i <= nbody; i++) {
        fast[i - 1] = (flags & TREE_FAST_LEAVES) && !has_child[i];
        body[i].fast = body[body[i].parent].fast || (fast[i - 1] && joint[i - 1].nv > 0);
    }
    tree_number(m, joint, fast, true);
    m->ns = m->n;
    tree_number(m, joint, fast, false);
    tree_coordinates(m, arena, fast);

    double *q = TAKE(arena, double, m->nq), *v = TAKE(arena, double, m->n);
    tree_state(q, v, m, d);
    m->q0 = q, m->v0 = v;
    if (flags & TREE_FORCES) {
        tree_measures(m, d, arena);
        tree_forces(m, d, arena);
    }
    return m;
}

#endif
