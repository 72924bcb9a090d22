/* t-linkage.c -- random closed linkages against an independent formulation.
 *
 * Bodies hang on a random tree of joints; further joints, drawn where the bodies stand, close loops, some of them
 * twice over; rods, points on lines and gears between any two coordinates are among them.  The same mechanism in
 * absolute coordinates, every joint as constraint equations, is solved here as (2-3)
 *
 *     [M J'; J 0] [a; lambda] = [Q; -J' v],
 *
 * J' v by differences along the motion, rank by full pivoting.  Accelerations of all bodies must agree, and the
 * reactions of all joints must add up to what the bodies need. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "loop/condense.h"
#include "system/system.h"
#include "unit/trees.h"

#include <cmocka.h>

enum {
    MOST_BODIES = 8,
    MOST_LOOPS = 4,
    MOST_JOINTS = MOST_BODIES + MOST_LOOPS,
    MOST = 6 * (MOST_BODIES + MOST_JOINTS)
};

#include "unit/augmented.h"

/* A joint of either sort, as the independent formulation sees it. */
struct any_joint {
    enum joint_type type;
    int A, B;
    const double *b, *Ea, *Eb;
    const struct model_loop *loop; /* NULL: of the tree */
    double number;
};

struct linkage {
    struct model model;
    struct model_loop loop[MOST_LOOPS];
    int component[MOST_BODIES];
    bool urgent[6 * MOST_BODIES];
    double follow[6 * MOST_BODIES];
    struct any_joint joint[MOST_JOINTS];
    int njoint;
};

/* --- making ------------------------------------------------------------------------------------- */

static void close_between(struct linkage *o, struct tree_dice *d, int A, int B)
{
    static const enum joint_type plane[] = {JOINT_REVOLUTE, JOINT_PRISMATIC, JOINT_REVOLUTE,     JOINT_FIXED,
                                            JOINT_PLANAR,   JOINT_DISTANCE,  JOINT_POINT_ON_LINE};
    static const enum joint_type room[] = {JOINT_REVOLUTE, JOINT_SPHERICAL, JOINT_CYLINDRICAL,   JOINT_UNIVERSAL,
                                           JOINT_PLANAR,   JOINT_PRISMATIC, JOINT_SPHERICAL,     JOINT_FIXED,
                                           JOINT_DISTANCE, JOINT_DISTANCE,  JOINT_POINT_ON_LINE, JOINT_SCREW};
    const int space = o->model.space;
    struct model_loop *l = &o->loop[o->model.nloop++];
    double at[3], from[3], arm[3], E[9];
    const struct model_body *a = &o->model.body[A], *b = &o->model.body[B];
    *l = (struct model_loop){.name = "loop", .first = A, .second = B};
    l->type = space == 2 ? plane[tree_pick(d, 7)] : room[tree_pick(d, 12)];
    tree_vector(at, d, space);
    tree_axes(E, d, l->type, space);
    memcpy(from, at, sizeof from);
    if (l->type == JOINT_DISTANCE) tree_vector(from, d, space);
    for (int i = 0; i < 3; i++) l->number += (at[i] - from[i]) * (at[i] - from[i]);
    l->number = l->type == JOINT_SCREW ? tree_roll(d, -2, 2) : sqrt(l->number);
    for (int i = 0; i < 3; i++) arm[i] = from[i] - a->at[i];
    tree_mtv(l->a, a->R, arm);
    for (int i = 0; i < 3; i++) arm[i] = at[i] - b->at[i];
    tree_mtv(l->b, b->R, arm);
    tree_mtm(l->Ea, a->R, E);
    tree_mtm(l->Eb, b->R, E);
}

/* The coordinates that may be geared, with their unit velocities, are those that are no free rotations'. */
static int plain_coordinates(struct model_term *o, const struct model *m)
{
    int n = 0;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        const bool slides = j->type == JOINT_PRISMATIC || j->type == JOINT_PLANAR || j->type == JOINT_FREE;
        for (int k = 0; k < j->nv && !(j->nq > j->nv && k + 3 >= j->nv); k++) {
            bool angular = !slides && !(j->type == JOINT_CYLINDRICAL && k == 1);
            if (j->nq == j->nv && (j->type == JOINT_PLANAR || j->type == JOINT_FREE) && k == 2) angular = true;
            o[n++] = (struct model_term){i, k, angular, 1};
        }
    }
    return n;
}

static void gear(struct linkage *o, struct tree_dice *d)
{
    struct model_term all[6 * MOST_BODIES];
    struct model_loop *l = &o->loop[o->model.nloop];
    const int n = plain_coordinates(all, &o->model);
    if (n < 2) return;
    int a = tree_pick(d, n), b = (a + 1 + tree_pick(d, n - 1)) % n;
    *l = (struct model_loop){.name = "gear", .type = JOINT_GEAR, .nterm = 2, .term = {all[a], all[b]}};
    l->term[0].factor = tree_roll(d, .2, 3) * (tree_pick(d, 2) ? 1 : -1);
    l->first = o->model.joint[all[a].joint].child;
    l->second = o->model.joint[all[b].joint].child;
    o->model.nloop++;
}

/* A loop that says again what another joint says: all of it, or of a revolute joint its point only. */
static void repeat_joint(struct linkage *o, struct tree_dice *d)
{
    struct model_loop *l = &o->loop[o->model.nloop];
    if (o->model.nloop && tree_pick(d, 2)) {
        *l = o->loop[tree_pick(d, o->model.nloop)];
    } else {
        const struct model_joint *j = &o->model.joint[tree_pick(d, o->model.njoint)];
        *l = (struct model_loop){.name = "again", .type = j->type, .first = j->parent, .second = j->child};
        l->number = j->number;
        memcpy(l->a, j->a, sizeof l->a), memcpy(l->b, j->b, sizeof l->b);
        memcpy(l->Ea, j->Ea, sizeof l->Ea), memcpy(l->Eb, j->Eb, sizeof l->Eb);
    }
    if (o->model.space == 3 && l->type == JOINT_REVOLUTE && tree_pick(d, 2)) l->type = JOINT_SPHERICAL;
    o->model.nloop++;
}

static void list_joints(struct linkage *o)
{
    o->njoint = 0;
    for (int i = 0; i < o->model.njoint; i++) {
        const struct model_joint *j = &o->model.joint[i];
        o->joint[o->njoint++] = (struct any_joint){j->type, j->parent, j->child, j->b, j->Ea, j->Eb, NULL, j->number};
    }
    for (int i = 0; i < o->model.nloop; i++) {
        const struct model_loop *l = &o->loop[i];
        o->joint[o->njoint++] = (struct any_joint){l->type, l->first, l->second, l->b, l->Ea, l->Eb, l, l->number};
    }
}

static void make_linkage(struct linkage *o, int space, unsigned seed, bool redundant, struct arena *arena)
{
    struct tree_dice dice = {seed * 31u + 7u}, *d = &dice;
    int nbody = 3 + tree_pick(d, 4), a, b;
    struct model *tree = random_tree(space, nbody, seed, seed % 3 ? 0 : TREE_CHAIN, arena);
    o->model = *tree;
    double *q = TAKE(arena, double, tree->nq), *v = TAKE(arena, double, tree->n);
    for (int i = 0; i < tree->njoint; i++) /* as drawn: 0, unit quaternions */
        if (tree_turns(&tree->joint[i], space)) q[tree->joint[i].iq[tree->joint[i].nq - 4]] = 1;
    for (int i = 0; i < tree->n; i++) o->follow[i] = 1, o->urgent[i] = false;
    o->model.q0 = q, o->model.v0 = v;
    o->model.loop = o->loop, o->model.component = o->component;
    o->model.urgent = o->urgent;
    o->model.follow = o->model.follow_q = o->model.follow_v = o->follow;
    o->model.ncomponent = 1;
    memset(o->component, 0, sizeof o->component);
    int loops = 1 + tree_pick(d, 2);
    for (int i = 0; i < loops; i++) {
        tree_pair(&a, &b, d, o->model.nbody);
        close_between(o, d, a, b);
    }
    if (tree_pick(d, 2)) gear(o, d);
    if (redundant) repeat_joint(o, d);
    list_joints(o);
}

/* --- the independent formulation ---------------------------------------------------------------- */

static void add_unit(double *J, int body, const double *dir, const double *arm, double factor)
{
    double moment[3];
    if (arm) cross(moment, arm, dir);
    for (int k = 0; body && k < 3; k++) {
        if (arm) J[6 * (body - 1) + k] += factor * dir[k];
        J[6 * (body - 1) + 3 + k] += factor * (arm ? moment[k] : dir[k]);
    }
}

/* The rate of one coordinate of joint j, from its two bodies' velocities: of the child's point along an axis of the
 * parent's, or of turning about the joint's axis. */
static void coordinate_row(double *J, const struct model_joint *j, const struct model_term *t, const struct place *p)
{
    const struct place *A = &p[j->parent], *B = &p[j->child];
    double E[9], F[9], a[3], b[3];
    tree_mm(E, A->R, j->Ea);
    tree_mm(F, B->R, j->Eb);
    tree_mv(b, B->R, j->b);
    for (int i = 0; i < 3; i++) a[i] = B->r[i] + b[i] - A->r[i];
    const bool many = j->type == JOINT_PLANAR || j->type == JOINT_FREE;
    const double *axis = j->type == JOINT_UNIVERSAL ? (t->k ? F + 3 : E) : many && !t->angular ? E + 3 * t->k : E + 6;
    add_unit(J, j->child, axis, t->angular ? NULL : b, t->factor);
    add_unit(J, j->parent, axis, t->angular ? NULL : a, -t->factor);
}

static int gear_row(double *J, const struct model *m, const struct model_loop *l, const struct place *p)
{
    memset(J, 0, MOST * sizeof *J);
    for (int i = 0; i < l->nterm; i++) coordinate_row(J, &m->joint[l->term[i].joint], &l->term[i], p);
    return 1;
}

/* The row of a rod: the rate of the distance times the distance. */
static int rod_row(double *J, const struct any_joint *j, const struct place *p)
{
    const struct place *A = &p[j->A], *B = &p[j->B];
    double a[3], b[3], d[3];
    memset(J, 0, MOST * sizeof *J);
    tree_mv(a, A->R, j->loop->a);
    tree_mv(b, B->R, j->b);
    for (int i = 0; i < 3; i++) d[i] = B->r[i] + b[i] - A->r[i] - a[i];
    add_unit(J, j->B, d, b, 1);
    add_unit(J, j->A, d, a, -1);
    return 1;
}

/* Rows of J of one joint: blocked velocities of B against A at B's point, along axes of A; blocked turns. */
static int rows_of(double (*J)[MOST], const struct any_joint *j, const struct place *p, int space)
{
    static const struct {
        int slide[3], turn[3];
    } plane[JOINT_TYPES] = {[JOINT_FIXED] = {{1, 1, 0}, {0, 0, 1}},
                            [JOINT_REVOLUTE] = {{1, 1, 0}, {0, 0, 0}},
                            [JOINT_PRISMATIC] = {{1, 0, 0}, {0, 0, 1}},
                            [JOINT_POINT_ON_LINE] = {{1, 0, 0}, {0, 0, 0}}},
      room[JOINT_TYPES] = {[JOINT_FIXED] = {{1, 1, 1}, {1, 1, 1}},        [JOINT_REVOLUTE] = {{1, 1, 1}, {1, 1, 0}},
                           [JOINT_PRISMATIC] = {{1, 1, 0}, {1, 1, 1}},    [JOINT_CYLINDRICAL] = {{1, 1, 0}, {1, 1, 0}},
                           [JOINT_SCREW] = {{1, 1, 0}, {1, 1, 0}},        [JOINT_UNIVERSAL] = {{1, 1, 1}, {0, 0, 0}},
                           [JOINT_SPHERICAL] = {{1, 1, 1}, {0, 0, 0}},    [JOINT_PLANAR] = {{0, 0, 1}, {1, 1, 0}},
                           [JOINT_POINT_ON_LINE] = {{1, 1, 0}, {0, 0, 0}}};
    const struct place *A = &p[j->A], *B = &p[j->B];
    const int *slide = space == 2 ? plane[j->type].slide : room[j->type].slide;
    const int *turn = space == 2 ? plane[j->type].turn : room[j->type].turn;
    double E[9], F[9], b[3], a[3], dir[6][3];
    int kind[6], rows = 0;
    tree_mm(E, A->R, j->Ea);
    tree_mm(F, B->R, j->Eb);
    tree_mv(b, B->R, j->b);
    for (int i = 0; i < 3; i++) a[i] = B->r[i] + b[i] - A->r[i];
    for (int i = 0; i < 3; i++)
        if (slide[i]) memcpy(dir[rows], E + 3 * i, sizeof dir[0]), kind[rows++] = 0;
    for (int i = 0; i < 3; i++) {
        const double out[3] = {0, 0, 1};
        if (turn[i]) memcpy(dir[rows], space == 2 ? out : E + 3 * i, sizeof dir[0]), kind[rows++] = 1;
    }
    if (space == 3 && j->type == JOINT_UNIVERSAL) cross(dir[rows], E, F + 3), kind[rows++] = 1;
    for (int i = 0; i < rows; i++) {
        double nA[3], nB[3];
        memset(J[i], 0, sizeof J[i]);
        cross(nA, a, dir[i]);
        cross(nB, b, dir[i]);
        for (int k = 0; k < 3; k++) {
            if (j->A && kind[i] == 0) J[i][6 * (j->A - 1) + k] = -dir[i][k], J[i][6 * (j->A - 1) + 3 + k] = -nA[k];
            if (j->B && kind[i] == 0) J[i][6 * (j->B - 1) + k] = dir[i][k], J[i][6 * (j->B - 1) + 3 + k] = nB[k];
            if (j->A && kind[i] == 1) J[i][6 * (j->A - 1) + 3 + k] = -dir[i][k];
            if (j->B && kind[i] == 1) J[i][6 * (j->B - 1) + 3 + k] = dir[i][k];
        }
    }
    if (j->type != JOINT_SCREW) return rows;
    const double pitch = tree_pitch(j->number); /* the second's point goes along z as it turns about it */
    memset(J[rows], 0, sizeof J[rows]);
    add_unit(J[rows], j->B, E + 6, b, 1);
    add_unit(J[rows], j->A, E + 6, a, -1);
    add_unit(J[rows], j->B, E + 6, NULL, -pitch);
    add_unit(J[rows], j->A, E + 6, NULL, pitch);
    return rows + 1;
}

static int all_rows(double (*J)[MOST], const struct linkage *o, const struct place *p)
{
    int n = 0;
    for (int i = 0; i < o->njoint; i++) {
        const struct any_joint *j = &o->joint[i];
        if (j->type == JOINT_GEAR)
            n += gear_row(J[n], &o->model, j->loop, p);
        else if (j->type == JOINT_DISTANCE)
            n += rod_row(J[n], j, p);
        else
            n += rows_of(J + n, j, p, o->model.space);
    }
    return n;
}

/* Bodies a little later: r + h v, turned by h w. */
static void later(struct place *to, const struct place *from, int n, double h)
{
    for (int i = 0; i < n; i++) {
        double w = sqrt(from[i].w[0] * from[i].w[0] + from[i].w[1] * from[i].w[1] + from[i].w[2] * from[i].w[2]);
        double q[4] = {cos(h * w / 2), 0, 0, 0}, T[9];
        for (int k = 0; k < 3; k++) q[1 + k] = w > 0 ? sin(h * w / 2) * from[i].w[k] / w : 0;
        tree_matrix(T, q);
        to[i] = from[i];
        tree_mm(to[i].R, T, from[i].R);
        for (int k = 0; k < 3; k++) to[i].r[k] += h * from[i].v[k];
    }
}

static double J0[MOST][MOST], J1[MOST][MOST];

/* y += s J v */
static void add_product(double *y, double s, double (*J)[MOST], const struct place *p, int rows, int nbody)
{
    for (int i = 0; i < rows; i++)
        for (int b = 1; b < nbody; b++)
            for (int k = 0; k < 3; k++)
                y[i] += s * (J[i][6 * (b - 1) + k] * p[b].v[k] + J[i][6 * (b - 1) + 3 + k] * p[b].w[k]);
}

/* x: accelerations of body b (from 1) at 6 (b - 1): of the centre, angular. */
static double accelerations(double *x, const struct linkage *o, const struct place *p)
{
    static const double h = 1e-3;
    const struct model *m = &o->model;
    struct place q[MOST_BODIES];
    double gacc[MOST] = {0};
    const int rows = all_rows(J0, o, p);
    for (int i = 0; i < 4; i++) { /* central differences of fourth order */
        static const double at[] = {-2, -1, 1, 2}, weight[] = {1. / 12, -2. / 3, 2. / 3, -1. / 12};
        later(q, p, m->nbody, at[i] * h);
        all_rows(J1, o, q);
        add_product(gacc, weight[i] / h, J1, p, rows, m->nbody);
    }
    return augmented_solve(x, m, p, J0, gacc, rows);
}

/* --- the comparison ------------------------------------------------------------------------------ */

struct figures {
    int closed, redundant, refused;
    int met[JOINT_TYPES]; /* loops of each kind */
    double worst, balance, constraint;
    double aside; /* worst of those near a singular posture, where r is a mean over both sides of it */
    unsigned seed;
};

static void add_reaction(double *F, const struct place *p, int body, const double *x, const double *f, const double *n,
                         double sign)
{
    double arm[3], moment[3];
    for (int i = 0; i < 3; i++) arm[i] = x[i] - p[body].r[i];
    cross(moment, arm, f);
    for (int i = 0; i < 3; i++) {
        F[6 * body + i] += sign * f[i];
        F[6 * body + 3 + i] += sign * (n[i] + moment[i]);
    }
}

/* What a gear does to the bodies of its coordinates: the force on the last of these, along its row. */
static void add_gear(double *F, const struct linkage *o, const struct system *s, const struct place *p, int loop)
{
    const struct model_loop *l = &o->loop[loop];
    double J[MOST], Q = system_loop_force(s, loop) / l->term[l->nterm - 1].factor;
    gear_row(J, &o->model, l, p);
    for (int i = 6; i < 6 * o->model.nbody; i++) F[i] += Q * J[i - 6];
}

/* A rod pushes with loops_force() along its line. */
static double off_line(const struct linkage *o, const struct system *s, const struct place *p, int loop)
{
    const struct model_loop *l = &o->loop[loop];
    double f[3], n[3], a[3], b[3], d[3], size = 0, worst = 0, force = system_loop_force(s, loop);
    system_loop_reaction(s, f, n, loop);
    tree_mv(a, p[l->first].R, l->a);
    tree_mv(b, p[l->second].R, l->b);
    for (int i = 0; i < 3; i++) d[i] = p[l->second].r[i] + b[i] - p[l->first].r[i] - a[i], size += d[i] * d[i];
    for (int i = 0; i < 3; i++) worst = fmax(worst, fabs(f[i] - force * d[i] / sqrt(size)) + fabs(n[i]));
    return worst;
}

/* All reactions against m (a - g) and I al + w x I w of every body. */
static double unbalanced(const struct linkage *o, const struct system *s, const struct place *p, const double *a)
{
    const struct model *m = &o->model;
    double F[6 * MOST_BODIES] = {0}, worst = 0, most = 1;
    for (int i = 0; i < o->njoint; i++) {
        const struct any_joint *j = &o->joint[i];
        bool loop = i >= m->njoint;
        if (j->type == JOINT_GEAR) {
            add_gear(F, o, s, p, i - m->njoint);
            continue;
        }
        if (j->type == JOINT_DISTANCE) worst = fmax(worst, off_line(o, s, p, i - m->njoint));
        double f[3], n[3], x[3], sign = !loop && m->joint[i].reversed ? -1 : 1;
        if (loop)
            system_loop_reaction(s, f, n, i - m->njoint);
        else
            system_reaction(s, f, n, i);
        const int on = sign < 0 ? j->A : j->B; /* the deck's second body */
        tree_mv(x, p[on].R, sign < 0 ? m->joint[i].a : j->b);
        for (int k = 0; k < 3; k++) x[k] += p[on].r[k];
        add_reaction(F, p, j->B, x, f, n, sign);
        add_reaction(F, p, j->A, x, f, n, -sign);
        for (int k = 0; k < 3; k++) most = fmax(most, fmax(fabs(f[k]), fabs(n[k])));
    }
    for (int b = 1; b < m->nbody; b++) {
        double I[9], L[3], gyro[3], N[3];
        const double *x = a + 6 * (b - 1);
        tensor(I, &m->body[b], p[b].R);
        tree_mv(L, I, p[b].w);
        cross(gyro, p[b].w, L);
        tree_mv(N, I, x + 3);
        for (int k = 0; k < 3; k++) {
            bool in_plane = m->space == 3 || k < 2, turns = m->space == 3 || k == 2;
            if (in_plane) worst = fmax(worst, fabs(F[6 * b + k] - m->body[b].mass * (x[k] - m->gravity[k])));
            if (turns) worst = fmax(worst, fabs(F[6 * b + 3 + k] - N[k] - gyro[k]));
        }
    }
    return worst / most;
}

static void compare(struct figures *g, const struct linkage *o, struct system *s, const double *q, const double *v,
                    unsigned seed)
{
    struct place p[MOST_BODIES];
    double x[MOST], worst = 0, most = 10;
    struct trouble why;
    assert_int_equal(system_evaluate(s, q, v, 0, EVALUATE_ALL, &why), OK);
    for (int b = 0; b < o->model.nbody; b++) {
        struct pose pose;
        system_pose(s, &pose, b);
        memcpy(p[b].r, pose.r, sizeof pose.r), memcpy(p[b].R, pose.R, sizeof pose.R);
        memcpy(p[b].v, pose.v, sizeof pose.v), memcpy(p[b].w, pose.w, sizeof pose.w);
    }
    double left = accelerations(x, o, p);
    assert_true(left < 1e-6);
    for (int b = 1; b < o->model.nbody; b++) {
        struct pose pose;
        system_pose(s, &pose, b);
        for (int k = 0; k < 3; k++) {
            most = fmax(most, fmax(fabs(x[6 * (b - 1) + k]), fabs(x[6 * (b - 1) + 3 + k])));
            worst = fmax(worst, fabs(pose.a[k] - x[6 * (b - 1) + k]));
            worst = fmax(worst, fabs(pose.al[k] - x[6 * (b - 1) + 3 + k]));
        }
    }
    if (condense_ratio(system_loops(s)) < 1e-3)
        g->aside = fmax(g->aside, worst / most);
    else if (!(worst / most <= g->worst))
        g->worst = worst / most, g->seed = seed;
    g->balance = fmax(g->balance, unbalanced(o, s, p, x));
    g->constraint = fmax(g->constraint, system_constraint_worst(s));
}

static void try_one(struct figures *g, int space, unsigned seed, bool redundant)
{
    struct arena *arena = arena_open();
    struct linkage o;
    struct tree_dice dice = {seed ^ 0xabcdefu}, *d = &dice;
    memset(&o, 0, sizeof o);
    make_linkage(&o, space, seed, redundant, arena);
    struct system *s = system_build(&o.model, arena);
    const struct ode2 *ode = system_ode2(s);
    const struct condense_start *start = condense_started(system_loops(s));
    if (start->status != OK || ode->n == 0) {
        if (getenv("LINKAGE")) printf("%u: %s\n", seed, start->report.text);
        g->refused++;
        arena_close(arena);
        return;
    }
    double *q = TAKE(arena, double, ode->nq), *v = TAKE(arena, double, ode->n), *dx = TAKE(arena, double, ode->n);
    struct report report = {0};
    assert_int_equal(system_start(s, q, v, &report), OK);
    for (int i = 0; i < ode->n; i++) dx[i] = tree_roll(d, -.05, .05), v[i] = tree_roll(d, -1, 1);
    ode->move->point(ode, q, q, dx, 1, 0);
    if (!isfinite(q[0])) { /* locks on the way */
        g->refused++;
    } else {
        compare(g, &o, s, q, v, seed);
        g->closed++;
        g->redundant += start->redundant > 0;
        for (int i = 0; i < o.model.nloop; i++) g->met[o.loop[i].type]++;
    }
    arena_close(arena);
}

static void linkages(int space)
{
    struct figures g = {0};
    for (unsigned seed = 1; g.closed < 500 && seed < 2000; seed++) try_one(&g, space, seed, seed % 2);
    print_message("space %d: %d linkages, %d with redundant rows, %d refused; accelerations differ %.2g (seed %u; %.2g "
                  "near singular postures), "
                  "reactions miss %.2g, |C| %.2g\n",
                  space, g.closed, g.redundant, g.refused, g.worst, g.seed, g.aside, g.balance, g.constraint);
    assert_true(g.met[JOINT_DISTANCE] > 50 && g.met[JOINT_POINT_ON_LINE] > 50 && g.met[JOINT_GEAR] > 100);
    if (space == 3) assert_true(g.met[JOINT_SCREW] > 40);
    assert_int_equal(g.closed, 500);
    assert_true(g.redundant > 100);
    assert_true(g.worst < 1e-8);
    assert_true(g.aside < 1e-5);
    assert_true(g.balance < 1e-8);
    assert_true(g.constraint < 1e-12);
}

static void in_the_plane(void **state)
{
    (void)state;
    linkages(2);
}

static void in_space(void **state)
{
    (void)state;
    linkages(3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(in_the_plane), cmocka_unit_test(in_space)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
