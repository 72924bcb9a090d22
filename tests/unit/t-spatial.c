/* t-spatial.c -- the spatial recursion against homogeneous transforms.
 *
 * The other way: every body's place is a product of transforms along its path; partial velocities are read
 * off the transforms and checked by complex steps of them; accelerations are complex steps of J(q) u along the
 * motion; M = sum J' diag(m, I_w) J and r = sum J' (what each body needs by Newton and Euler).  A complex step
 * f(x + i e)/e has no difference in it and is exact to round-off (Squire & Trapp 1998). */
#include "tree/sweep.h"

#include "unit/gauss.h"
#include "unit/near.h"
#include "unit/transforms.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { BODIES = 8, MOST = 6 * BODIES, MOST_Q = 7 * BODIES, SEEDS = 60 };

/* ---- a model at a state ---- */

/* One unit velocity: a rotation about, or a displacement along e, of all that hangs on the joint at B; of a screw a
 * displacement by so much as it turns. */
struct unit_velocity {
    int owner;
    bool turns;
    double along;
    double complex e[3], B[3];
};

struct places {
    struct transform body[BODIES + 1];
    struct unit_velocity freedom[MOST];
};

static void column(double complex *e, struct transform X, int k)
{
    for (int i = 0; i < 3; i++) e[i] = X.T[i][k];
}

static void freedom(struct places *o, const struct model_joint *j, int k, bool turns, struct transform axes, int axis,
                    struct transform at)
{
    struct unit_velocity *f = &o->freedom[j->iv[k]];
    f->owner = j->child;
    f->turns = turns;
    f->along = turns ? 0 : 1;
    column(f->e, axes, axis);
    column(f->B, at, 3);
}

static void place_joint(struct places *o, const struct model_joint *j, const double complex *q)
{
    struct transform base, between, x;
    o->body[j->child] = hang(&base, &x, o->body[j->parent], j, q);
    switch (j->type) {
    case JOINT_REVOLUTE:
        freedom(o, j, 0, true, base, 2, x);
        break;
    case JOINT_PRISMATIC:
        freedom(o, j, 0, false, base, 2, x);
        break;
    case JOINT_CYLINDRICAL:
        freedom(o, j, 0, true, base, 2, x);
        freedom(o, j, 1, false, base, 2, x);
        break;
    case JOINT_SCREW:
        freedom(o, j, 0, true, base, 2, x);
        o->freedom[j->iv[0]].along = tree_pitch(j->number);
        break;
    case JOINT_UNIVERSAL:
        between = times(base, about_x(q[j->iq[0]]));
        freedom(o, j, 0, true, base, 0, x);
        freedom(o, j, 1, true, between, 1, x);
        break;
    case JOINT_PLANAR:
        for (int k = 0; k < 3; k++) freedom(o, j, k, k == 2, base, k, x);
        break;
    case JOINT_SPHERICAL:
        for (int k = 0; k < 3; k++) freedom(o, j, k, true, x, k, x);
        break;
    case JOINT_FREE:
        for (int k = 0; k < 6; k++) freedom(o, j, k, k > 2, k < 3 ? base : x, k % 3, x);
        break;
    case JOINT_FIXED:
    case JOINT_DISTANCE:
    case JOINT_POINT_ON_LINE:
    case JOINT_GEAR:
    case JOINT_RACK:
    case JOINT_TYPES:
        break;
    }
}

static void place(struct places *o, const struct model *m, const double complex *q)
{
    const double *at = m->body[0].at;
    o->body[0] = times(shift(at[0], at[1], at[2]), turned(m->body[0].R));
    for (int i = 1; i < m->nbody; i++) place_joint(o, &m->joint[m->body[i].joint], q);
}

static bool hangs_on(const struct model *m, int body, int owner)
{
    while (body > owner) body = m->body[body].parent;
    return body == owner;
}

static void cross(double complex *o, const double complex *a, const double complex *b)
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        o[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* Velocity of the centre and angular velocity of a body per unit of the k-th velocity. */
static void partial(double complex *v, double complex *w, const struct places *o, const struct model *m, int body,
                    int k)
{
    const struct unit_velocity *f = &o->freedom[k];
    memset(v, 0, 3 * sizeof *v);
    memset(w, 0, 3 * sizeof *w);
    if (!hangs_on(m, body, f->owner)) return;
    if (!f->turns) {
        memcpy(v, f->e, sizeof f->e);
        return;
    }
    double complex d[3];
    for (int i = 0; i < 3; i++) d[i] = o->body[body].T[i][3] - f->B[i];
    memcpy(w, f->e, sizeof f->e);
    cross(v, f->e, d);
    for (int i = 0; i < 3; i++) v[i] += f->along * f->e[i];
}

static void velocities(double complex *v, double complex *w, const struct places *o, const struct model *m, int body,
                       const double complex *u)
{
    memset(v, 0, 3 * sizeof *v);
    memset(w, 0, 3 * sizeof *w);
    for (int k = 0; k < m->n; k++) {
        double complex xv[3], xw[3];
        partial(xv, xw, o, m, body, k);
        for (int i = 0; i < 3; i++) v[i] += u[k] * xv[i], w[i] += u[k] * xw[i];
    }
}

/* ---- bodies in motion, the other way ---- */

struct body {
    double r[3], R[9], v[3], w[3], a[3], al[3];
    double J[3][3]; /* inertia, world */
};

static void tensor(double J[3][3], const struct body *b, const double *I)
{
    double B[3][3] = {{I[0], I[3], I[4]}, {I[3], I[1], I[5]}, {I[4], I[5], I[2]}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            J[i][j] = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++) J[i][j] += b->R[i + 3 * k] * B[k][l] * b->R[j + 3 * l];
        }
}

/* Along q (+) t v with velocities v + t a: the rate of velocity at t = 0 is the complex step. */
static void see_bodies(struct body *o, struct places *at, const struct model *m, const double *q, const double *v,
                       const double *a)
{
    static struct places moved;
    double complex q1[MOST_Q], u[MOST];
    nudge(q1, m, q, v, tiny * _Complex_I);
    for (int k = 0; k < m->n; k++) u[k] = v[k] + tiny * _Complex_I * a[k];
    place(&moved, m, q1);
    for (int k = 0; k < m->nq; k++) q1[k] = q[k];
    place(at, m, q1);
    for (int b = 0; b < m->nbody; b++) {
        double complex xv[3], xw[3];
        velocities(xv, xw, &moved, m, b, u);
        for (int i = 0; i < 3; i++) {
            o[b].r[i] = creal(moved.body[b].T[i][3]);
            o[b].v[i] = creal(xv[i]), o[b].a[i] = cimag(xv[i]) / tiny;
            o[b].w[i] = creal(xw[i]), o[b].al[i] = cimag(xw[i]) / tiny;
            for (int j = 0; j < 3; j++) o[b].R[i + 3 * j] = creal(moved.body[b].T[i][j]);
        }
        tensor(o[b].J, &o[b], m->body[b].inertia);
    }
}

static void real_cross(double *o, const double *a, const double *b)
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        o[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* What a body needs by Newton and Euler. */
static void need(double *F, double *N, const struct body *b, double mass, const double *g)
{
    double L[3] = {0}, x[3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) L[i] += b->J[i][j] * b->w[j];
    real_cross(x, b->w, L);
    for (int i = 0; i < 3; i++) {
        F[i] = mass * (b->a[i] - g[i]);
        N[i] = x[i];
        for (int j = 0; j < 3; j++) N[i] += b->J[i][j] * b->al[j];
    }
}

/* ---- a scene: model, sweep, random state, random pushes ---- */

struct scene {
    struct arena *arena;
    const struct model *m;
    struct sweep *s;
    double q[MOST_Q], v[MOST], a[MOST];
    double x[BODIES + 1][3], f[BODIES + 1][3], n[BODIES + 1][3];
    struct body body[BODIES + 1];
    struct places at;
};

static const struct sweep_ops *ops = &sweep_spatial;

static void open_model(struct scene *o, const struct model *m, unsigned seed)
{
    struct tree_dice d = {seed + 77};
    o->m = m;
    o->s = ops->build(m, FOR_RECORDS, NULL, o->arena);
    tree_state(o->q, o->v, m, &d);
    for (int i = 0; i < m->n; i++) o->a[i] = tree_roll(&d, -3, 3);
    for (int i = 1; i < m->nbody; i++) {
        tree_vector(o->x[i], &d, 3);
        tree_vector(o->f[i], &d, 3);
        tree_vector(o->n[i], &d, 3);
    }
    see_bodies(o->body, &o->at, m, o->q, o->v, o->a);
}

/* A ground that does not stand at the origin. */
static void move_ground(const struct model *m, unsigned seed)
{
    struct model_body *ground = (struct model_body *)m->body;
    struct tree_dice d = {seed};
    double q[4];
    tree_quaternion(q, &d, 3);
    tree_matrix(ground->R, q);
    tree_vector(ground->at, &d, 3);
}

/* All joint axes along the body axes: as decks are mostly drawn. */
static void straighten(const struct model *m)
{
    static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int i = 0; i < m->njoint; i++) {
        struct model_joint *j = (struct model_joint *)&m->joint[i];
        memcpy(j->Ea, unit, sizeof unit);
        memcpy(j->Eb, unit, sizeof unit);
    }
}

/* Trees of all shapes and joints; the seed decides. */
static void open_scene(struct scene *o, unsigned seed)
{
    o->arena = arena_open();
    unsigned flags = (seed % 3 == 0 ? TREE_CHAIN : 0) | (seed % 2 ? TREE_FAST_LEAVES : 0);
    struct model *m = random_tree(3, 1 + (int)(seed % BODIES), seed, flags, o->arena);
    if (seed % 5 == 4) move_ground(m, seed);
    if (seed % 7 == 6) straighten(m);
    open_model(o, m, seed);
}

static void push_all(struct scene *o)
{
    for (int i = 1; i < o->m->nbody; i++) {
        ops->push(o->s, i, o->x[i], o->f[i]);
        ops->twist(o->s, i, o->n[i]);
    }
}

static bool in_class(const struct scene *o, int body, unsigned cls)
{
    return cls & (o->m->body[body].fast ? FAST : SLOW);
}

/* r of a class the other way: sum J' (F, N) of its bodies. */
static void slow_way(double *r, const struct scene *o, unsigned cls, bool pushed)
{
    const struct model *m = o->m;
    memset(r, 0, sizeof *r * MOST);
    for (int b = 1; b < m->nbody; b++) {
        double F[3], N[3], d[3], moment[3];
        if (!in_class(o, b, cls)) continue;
        need(F, N, &o->body[b], m->body[b].mass, m->gravity);
        if (pushed) {
            for (int i = 0; i < 3; i++) d[i] = o->x[b][i] - o->body[b].r[i];
            real_cross(moment, d, o->f[b]);
            for (int i = 0; i < 3; i++) F[i] -= o->f[b][i], N[i] -= o->n[b][i] + moment[i];
        }
        for (int k = 0; k < m->n; k++) {
            double complex xv[3], xw[3];
            partial(xv, xw, &o->at, m, b, k);
            for (int i = 0; i < 3; i++) r[k] += creal(xv[i]) * F[i] + creal(xw[i]) * N[i];
        }
    }
}

static void resid(double *r, struct scene *o, const double *v, const double *a, unsigned cls)
{
    memset(r, 0, sizeof *r * MOST);
    ops->forward(o->s, o->q, v, a, cls);
    ops->backward(o->s, r, cls);
}

/* ---- tests ---- */

static void test_drawn_position(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct arena *arena = arena_open();
        const struct model *m = random_tree(3, BODIES, seed, 0, arena);
        struct sweep *s = ops->build(m, FOR_RECORDS, NULL, arena);
        double zero[MOST_Q] = {0};
        for (int i = 0; i < m->njoint; i++) {
            const struct model_joint *j = &m->joint[i];
            if (tree_turns(j, 3)) zero[j->iq[j->nq - 4]] = 1;
        }
        ops->move(s, zero, m->v0, ALL);
        for (int b = 0; b < m->nbody; b++) {
            struct pose pose;
            ops->pose(s, &pose, b);
            NEAR(pose.r, m->body[b].at, 3, 1e-14);
            NEAR(pose.R, m->body[b].R, 9, 1e-14);
        }
        arena_close(arena);
    }
}

static void test_motion(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        ops->forward(o.s, o.q, o.v, o.a, ALL);
        for (int b = 0; b < o.m->nbody; b++) {
            const struct body *x = &o.body[b];
            struct pose pose;
            ops->pose(o.s, &pose, b);
            NEAR(pose.r, x->r, 3, 1e-13);
            NEAR(pose.R, x->R, 9, 1e-13);
            NEAR(pose.v, x->v, 3, 1e-13);
            NEAR(pose.w, x->w, 3, 1e-13);
            NEAR(pose.a, x->a, 3, 1e-12);
            NEAR(pose.al, x->al, 3, 1e-12);
            double p[3] = {.3, -.4, .5}, at[3], at_v[3], d[3], v[3];
            ops->point(o.s, at, at_v, b, p);
            tree_mv(d, x->R, p);
            real_cross(v, x->w, d);
            for (int i = 0; i < 3; i++) d[i] += x->r[i], v[i] += x->v[i];
            NEAR(at, d, 3, 1e-13);
            NEAR(at_v, v, 3, 1e-13);
        }
        ops->move(o.s, o.q, o.v, ALL); /* no accelerations are known now */
        struct pose pose;
        double none[3] = {0};
        ops->pose(o.s, &pose, o.m->nbody - 1);
        NEAR(pose.v, o.body[o.m->nbody - 1].v, 3, 1e-13);
        NEAR(pose.a, none, 3, 0);
        NEAR(pose.al, none, 3, 0);
        arena_close(o.arena);
    }
}

/* Partial velocities three ways: the sweep's, those read off the transforms, complex steps of the transforms. */
static void test_partials(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        static struct places moved;
        ops->move(o.s, o.q, o.v, ALL);
        for (int k = 0; k < o.m->n; k++) {
            double unit[MOST] = {0};
            double complex q1[MOST_Q];
            unit[k] = 1;
            nudge(q1, o.m, o.q, unit, tiny * _Complex_I);
            place(&moved, o.m, q1);
            for (int b = 0; b < o.m->nbody; b++) {
                double complex v[3], w[3];
                double xv[3], xw[3], step_v[3], step_w[3], W[3][3] = {{0}}, read_v[3], read_w[3];
                partial(v, w, &o.at, o.m, b, k);
                ops->partial(o.s, xv, xw, b, o.body[b].r, k);
                for (int i = 0; i < 3; i++) { /* [w]x = R' R^T */
                    step_v[i] = cimag(moved.body[b].T[i][3]) / tiny;
                    read_v[i] = creal(v[i]), read_w[i] = creal(w[i]);
                    for (int j = 0; j < 3; j++)
                        for (int l = 0; l < 3; l++)
                            W[i][j] += cimag(moved.body[b].T[i][l]) / tiny * creal(moved.body[b].T[j][l]);
                }
                for (int i = 0; i < 3; i++) step_w[i] = W[(i + 2) % 3][(i + 1) % 3];
                NEAR(step_v, read_v, 3, 1e-13);
                NEAR(step_w, read_w, 3, 1e-13);
                NEAR(xv, read_v, 3, 1e-13);
                NEAR(xw, read_w, 3, 1e-13);
            }
        }
        arena_close(o.arena);
    }
}

static void test_paths(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        for (int b = 0; b < o.m->nbody; b++) {
            const int *k;
            int count = ops->path(o.s, &k, b), moving = 0;
            for (int i = 0; i < o.m->n; i++) moving += hangs_on(o.m, b, o.at.freedom[i].owner);
            assert_int_equal(count, moving);
            for (int i = 0; i < count; i++) {
                int owner = o.at.freedom[k[i]].owner;
                assert_true(hangs_on(o.m, b, owner));
                if (i) assert_true(owner >= o.at.freedom[k[i - 1]].owner && k[i] != k[i - 1]);
            }
        }
        arena_close(o.arena);
    }
}

static void slow_mass(double *M, const struct scene *o, unsigned cls)
{
    const struct model *m = o->m;
    int n = m->n;
    memset(M, 0, sizeof *M * MOST * MOST);
    for (int b = 1; b < m->nbody; b++) {
        if (!in_class(o, b, cls)) continue;
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++) {
                double complex v[2][3], w[2][3];
                partial(v[0], w[0], &o->at, m, b, j);
                partial(v[1], w[1], &o->at, m, b, k);
                for (int i = 0; i < 3; i++) {
                    M[j + n * k] += m->body[b].mass * creal(v[0][i]) * creal(v[1][i]);
                    for (int l = 0; l < 3; l++) M[j + n * k] += creal(w[0][i]) * o->body[b].J[i][l] * creal(w[1][l]);
                }
            }
    }
}

static void test_mass(void **state)
{
    (void)state;
    static double M[MOST * MOST], other[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        int n = o.m->n;
        for (unsigned cls = FAST; cls <= ALL; cls++) {
            for (int i = 0; i < n * n; i++) M[i] = NAN;
            ops->mass(o.s, M, o.q, cls);
            slow_mass(other, &o, cls);
            NEAR(M, other, n * n, 1e-12);
            for (int j = 0; j < n; j++)
                for (int k = 0; k < j; k++) assert_true(M[j + n * k] == M[k + n * j]);
        }
        arena_close(o.arena);
    }
}

static void test_residual(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        double r[MOST] = {0}, other[MOST];
        resid(r, &o, o.v, o.a, ALL);
        slow_way(other, &o, ALL, false);
        NEAR(r, other, o.m->n, 1e-12);
        for (int k = 0; k < o.m->n; k++) r[k] = 5; /* added, not written */
        ops->forward(o.s, o.q, o.v, o.a, ALL);
        push_all(&o);
        ops->backward(o.s, r, ALL);
        slow_way(other, &o, ALL, true);
        for (int k = 0; k < o.m->n; k++) other[k] += 5;
        NEAR(r, other, o.m->n, 1e-12);
        arena_close(o.arena);
    }
}

static void test_classes(void **state)
{
    (void)state;
    for (unsigned seed = 1; seed < SEEDS; seed += 2) {
        struct scene o;
        open_scene(&o, seed);
        double fast[MOST], slow[MOST], all[MOST], other[MOST];
        resid(fast, &o, o.v, o.a, FAST);
        slow_way(other, &o, FAST, false);
        NEAR(fast, other, o.m->n, 1e-12);
        resid(slow, &o, o.v, o.a, SLOW);
        slow_way(other, &o, SLOW, false);
        NEAR(slow, other, o.m->n, 1e-12);
        for (int k = 0; k < o.m->ns; k++) assert_true(slow[k] == 0);
        resid(all, &o, o.v, o.a, ALL);
        for (int k = 0; k < o.m->n; k++) fast[k] += slow[k];
        NEAR(fast, all, o.m->n, 1e-13);
        arena_close(o.arena);
    }
}

/* A body that only passes motion on: pushed, it hands the force inwards and weighs nothing. */
static void test_motion_only_bodies(void **state)
{
    (void)state;
    int seen = 0;
    for (unsigned seed = 1; seed < SEEDS; seed += 2) {
        struct scene o;
        open_scene(&o, seed);
        double none[MOST] = {0}, r[MOST] = {0}, other[MOST];
        int passes = 0; /* a slow body with a fast one beyond it */
        for (int b = 1; b < o.m->nbody; b++)
            if (o.m->body[b].fast && !o.m->body[o.m->body[b].parent].fast) passes = o.m->body[b].parent;
        if (passes) {
            seen++;
            resid(other, &o, none, NULL, FAST);
            ops->forward(o.s, o.q, none, NULL, FAST);
            ops->push(o.s, passes, o.x[passes], o.f[passes]);
            ops->twist(o.s, passes, o.n[passes]);
            ops->backward(o.s, r, FAST);
            for (int k = 0; k < o.m->n; k++) {
                double xv[3], xw[3];
                ops->partial(o.s, xv, xw, passes, o.x[passes], k);
                for (int i = 0; i < 3; i++) other[k] -= xv[i] * o.f[passes][i] + xw[i] * o.n[passes][i];
            }
            NEAR(r, other, o.m->n, 1e-13);
        }
        arena_close(o.arena);
    }
    assert_true(seen > 5);
}

static void test_affine_in_accelerations(void **state)
{
    (void)state;
    static double M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        int n = o.m->n;
        double r[MOST], again[MOST], r0[MOST], same[MOST], zero[MOST] = {0};
        resid(r, &o, o.v, o.a, ALL);
        resid(r0, &o, o.v, NULL, ALL);
        resid(same, &o, o.v, zero, ALL);
        assert_memory_equal(r0, same, sizeof *r0 * (size_t)n);
        ops->mass(o.s, M, o.q, ALL);
        for (int k = 0; k < n; k++)
            for (int j = 0; j < n; j++) r0[k] += M[k + n * j] * o.a[j];
        NEAR(r0, r, n, 1e-12);
        resid(again, &o, o.v, o.a, ALL); /* whatever was done between */
        assert_memory_equal(r, again, sizeof *r * (size_t)n);
        arena_close(o.arena);
    }
}

static void test_energy(void **state)
{
    (void)state;
    static double M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        int n = o.m->n;
        double T, V, T_mass = 0, V_bodies = 0;
        ops->move(o.s, o.q, o.v, ALL);
        ops->energy(o.s, &T, &V);
        ops->mass(o.s, M, o.q, ALL);
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++) T_mass += .5 * o.v[j] * M[j + n * k] * o.v[k];
        for (int b = 1; b < o.m->nbody; b++)
            for (int i = 0; i < 3; i++) V_bodies -= o.m->body[b].mass * o.m->gravity[i] * o.body[b].r[i];
        NEAR(&T, &T_mass, 1, 1e-12);
        NEAR(&V, &V_bodies, 1, 1e-12);
        arena_close(o.arena);
    }
}

/* Kinetic energy and energy in the field of gravity change by v.r: differences along q (+) (v h + a h^2/2). */
static double energy_at(struct scene *o, double h)
{
    double dx[MOST], u[MOST], q[MOST_Q], T, V;
    double complex q1[MOST_Q];
    for (int k = 0; k < o->m->n; k++) dx[k] = o->v[k] + h / 2 * o->a[k], u[k] = o->v[k] + h * o->a[k];
    nudge(q1, o->m, o->q, dx, h);
    for (int k = 0; k < o->m->nq; k++) q[k] = creal(q1[k]);
    for (int i = 0; i < o->m->njoint; i++) { /* back to unit length: the first-order move ends at order h^2 there */
        const struct model_joint *j = &o->m->joint[i];
        if (!tree_turns(j, 3)) continue;
        double *x = q + j->iq[j->nq - 4], norm = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]);
        for (int k = 0; k < 4; k++) x[k] /= norm;
    }
    ops->move(o->s, q, u, ALL);
    ops->energy(o->s, &T, &V);
    return T + V;
}

static void test_power(void **state)
{
    (void)state;
    const double h = 1e-4;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        double r[MOST], power = 0, rate;
        resid(r, &o, o.v, o.a, ALL);
        for (int k = 0; k < o.m->n; k++) power += o.v[k] * r[k];
        rate = (8 * (energy_at(&o, h) - energy_at(&o, -h)) - (energy_at(&o, 2 * h) - energy_at(&o, -2 * h))) / (12 * h);
        NEAR(&rate, &power, 1, 1e-9);
        arena_close(o.arena);
    }
}

static void test_factor(void **state)
{
    (void)state;
    static double M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        int n = o.m->n;
        struct tree_dice dice = {seed};
        void *F = arena_take(o.arena, 1, ops->factor_size(o.s));
        for (int run = 0; run < 4; run++) {
            double cm = run == 3 ? 0 : tree_roll(&dice, .5, 2), d[MOST], x[MOST], y[MOST];
            for (int k = 0; k < n; k++) {
                d[k] = run == 0 ? 0 : run == 1 ? tree_roll(&dice, 0, 1) : pow(10, tree_roll(&dice, -3, 6));
                x[k] = y[k] = tree_roll(&dice, -1, 1);
            }
            assert_int_equal(ops->factor(o.s, F, cm, d, o.q, ALL), 1);
            ops->solve(o.s, F, x);
            ops->mass(o.s, M, o.q, ALL);
            for (int k = 0; k < n * n; k++) M[k] *= cm;
            for (int k = 0; k < n; k++) M[k + n * k] += d[k];
            gauss(M, y, n);
            NEAR(x, y, n, 1e-11);
        }
        double d[MOST] = {0}, b[MOST], again[MOST]; /* at another state the factor stays what it was */
        assert_int_equal(ops->factor(o.s, F, 1, d, o.q, ALL), 1);
        memcpy(b, o.v, sizeof b), memcpy(again, o.v, sizeof b);
        ops->solve(o.s, F, b);
        ops->forward(o.s, o.m->q0, o.m->v0, NULL, ALL);
        ops->solve(o.s, F, again);
        assert_memory_equal(b, again, sizeof *b * (size_t)n);
        if (n) {
            d[n - 1] = -1e3;
            assert_int_equal(ops->factor(o.s, F, 1, d, o.q, ALL), 0);
            d[n - 1] = NAN;
            assert_int_equal(ops->factor(o.s, F, 1, d, o.q, ALL), 0);
        }
        arena_close(o.arena);
    }
}

/* Nothing to accelerate: a joint whose bodies have no inertia about it is refused, held by d it is not. */
static void test_factor_without_mass(void **state)
{
    (void)state;
    int seen = 0;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct arena *arena = arena_open();
        struct model *m = random_tree(3, 5, seed, 0, arena);
        struct model_body *last = (struct model_body *)&m->body[m->nbody - 1];
        const struct model_joint *joint = &m->joint[last->joint];
        last->mass = 0;
        memset(last->inertia, 0, sizeof last->inertia);
        struct sweep *s = ops->build(m, FOR_RECORDS, NULL, arena);
        void *F = arena_take(arena, 1, ops->factor_size(s));
        double d[MOST] = {0};
        if (joint->nv) {
            seen++;
            assert_int_equal(ops->factor(s, F, 1, d, m->q0, ALL), 0);
            for (int k = 0; k < joint->nv; k++) d[joint->iv[k]] = 1;
        }
        assert_int_equal(ops->factor(s, F, 1, d, m->q0, ALL), 1);
        arena_close(arena);
    }
    assert_true(seen > SEEDS / 2);
}

/* Force and moment about B of all that hangs on the joint, by Newton and Euler, less what is pushed. */
static void beyond(double *f, double *n, const struct scene *o, int child, const double *B)
{
    const struct model *m = o->m;
    memset(f, 0, 3 * sizeof *f);
    memset(n, 0, 3 * sizeof *n);
    for (int b = child; b < m->nbody; b++) {
        double F[3], N[3], d[3], x[3];
        if (!hangs_on(m, b, child)) continue;
        need(F, N, &o->body[b], m->body[b].mass, m->gravity);
        for (int i = 0; i < 3; i++) d[i] = o->body[b].r[i] - B[i];
        real_cross(x, d, F);
        for (int i = 0; i < 3; i++) f[i] += F[i], n[i] += N[i] + x[i];
        for (int i = 0; i < 3; i++) d[i] = o->x[b][i] - B[i];
        real_cross(x, d, o->f[b]);
        for (int i = 0; i < 3; i++) f[i] -= o->f[b][i], n[i] -= o->n[b][i] + x[i];
    }
}

/* Elements along the joints' coordinates bring up tau; the bodies accelerate as they must; the joint carries
 * what its sub-tree needs less tau about and along its free axes. */
static void test_reactions(void **state)
{
    (void)state;
    static double M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        const struct model *m = o.m;
        struct tree_dice dice = {seed};
        double tau[MOST], a[MOST], r[MOST] = {0};
        ops->forward(o.s, o.q, o.v, NULL, ALL);
        push_all(&o);
        ops->backward(o.s, r, ALL);
        for (int k = 0; k < m->n; k++) tau[k] = tree_roll(&dice, -2, 2), a[k] = tau[k] - r[k];
        ops->mass(o.s, M, o.q, ALL);
        gauss(M, a, m->n);
        see_bodies(o.body, &o.at, m, o.q, o.v, a);
        ops->forward(o.s, o.q, o.v, a, ALL);
        push_all(&o);
        memset(r, 0, sizeof r);
        ops->backward(o.s, r, ALL);
        NEAR(r, tau, m->n, 1e-10);
        for (int i = 0; i < m->njoint; i++) {
            const struct model_joint *j = &m->joint[i];
            double B[3], f[3], n[3], of_f[3], of_n[3];
            tree_mv(B, o.body[j->child].R, j->b);
            for (int c = 0; c < 3; c++) B[c] += o.body[j->child].r[c];
            beyond(of_f, of_n, &o, j->child, B);
            for (int k = 0; k < j->nv; k++) {
                const struct unit_velocity *x = &o.at.freedom[j->iv[k]];
                double *from = x->turns ? of_n : of_f;
                for (int c = 0; c < 3; c++) from[c] -= tau[j->iv[k]] * creal(x->e[c]);
            }
            ops->reaction(o.s, f, n, i);
            NEAR(f, of_f, 3, 1e-10);
            NEAR(n, of_n, 3, 1e-10);
        }
        arena_close(o.arena);
    }
}

/* The trees had every kind of joint in them. */
static void test_what_was_met(void **state)
{
    (void)state;
    int met[JOINT_TYPES] = {0}, bodies = 0;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed);
        for (int i = 0; i < o.m->njoint; i++) met[o.m->joint[i].type]++;
        bodies += o.m->njoint;
        arena_close(o.arena);
    }
    for (int t = 0; t <= JOINT_FREE; t++) assert_true(met[t] > bodies / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drawn_position),
        cmocka_unit_test(test_motion),
        cmocka_unit_test(test_partials),
        cmocka_unit_test(test_paths),
        cmocka_unit_test(test_mass),
        cmocka_unit_test(test_residual),
        cmocka_unit_test(test_classes),
        cmocka_unit_test(test_motion_only_bodies),
        cmocka_unit_test(test_affine_in_accelerations),
        cmocka_unit_test(test_energy),
        cmocka_unit_test(test_power),
        cmocka_unit_test(test_factor),
        cmocka_unit_test(test_factor_without_mass),
        cmocka_unit_test(test_reactions),
        cmocka_unit_test(test_what_was_met),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
