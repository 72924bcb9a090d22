/* absolute.h -- random trees and linkages with drives, and the same in absolute coordinates.
 *
 * Bodies hang on a random tree of joints, or close loops by further joints; one to three drives move coordinates of
 * joints, distances, displacements and, in the plane, angles.  Here every joint and every drive is an equation
 * C(x, t) = 0 of the bodies' poses, no more than its value: derivatives come from differences of sixth order, and
 * systems [M J'; J 0] are solved with full pivoting. */
#ifndef FMDSUB_TESTS_ABSOLUTE_H
#define FMDSUB_TESTS_ABSOLUTE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "expr/expr.h"
#include "loop/condense.h"
#include "system/system.h"
#include "unit/trees.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum {
    MOST_BODIES = 7,
    MOST_LOOPS = 5,
    MOST_ROWS = 6 * (MOST_BODIES + MOST_LOOPS),
    MOST = 6 * MOST_BODIES + MOST_ROWS
};

#include "unit/augmented.h"

static const double CORNER = .1; /* [s] */

/* A joint of the tree or one that closes a loop. */
struct any_joint {
    enum joint_type type;
    int A, B;
    const double *a, *b, *Ea, *Eb;
    double number;
};

struct mechanism {
    struct model model;
    struct model_loop loop[MOST_LOOPS];
    struct signal signal[MOST_LOOPS];
    double c[MOST_LOOPS][3]; /* of loop l, if it is a drive: see smooth(), bent() */
    int component[MOST_BODIES];
    bool urgent[6 * MOST_BODIES];
    double follow[6 * MOST_BODIES];
    struct any_joint joint[MOST_BODIES + MOST_LOOPS];
    int njoint;
};

static inline double inner(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* --- equations as values of poses ------------------------------------------------------------------ */

/* Axes of both sides in the world, and the way from the first's point to the second's. */
static inline void sides(double *E, double *G, double *d, const struct any_joint *j, const struct place *p)
{
    double a[3], b[3];
    tree_mm(E, p[j->A].R, j->Ea);
    tree_mm(G, p[j->B].R, j->Eb);
    tree_mv(a, p[j->A].R, j->a);
    tree_mv(b, p[j->B].R, j->b);
    for (int i = 0; i < 3; i++) d[i] = p[j->B].r[i] + b[i] - p[j->A].r[i] - a[i];
}

static inline int joint_values(double *C, const struct any_joint *j, const struct place *p, int space)
{
    static const struct {
        int slide[3];  /* along e_i nothing moves */
        int lean[3];   /* e_x.g_y, e_y.g_z, e_z.g_x stay 0 */
        int normal[2]; /* e_x.g_z, e_y.g_z stay 0 */
    } plane[JOINT_TYPES] = {[JOINT_FIXED] = {{1, 1, 0}, {1, 0, 0}, {0}},
                            [JOINT_REVOLUTE] = {{1, 1, 0}, {0}, {0}},
                            [JOINT_PRISMATIC] = {{1, 0, 0}, {0, 0, 1}, {0}}},
      room[JOINT_TYPES] = {
          [JOINT_FIXED] = {{1, 1, 1}, {1, 1, 1}, {0}},     [JOINT_REVOLUTE] = {{1, 1, 1}, {0}, {1, 1}},
          [JOINT_PRISMATIC] = {{1, 1, 0}, {1, 1, 1}, {0}}, [JOINT_CYLINDRICAL] = {{1, 1, 0}, {0}, {1, 1}},
          [JOINT_UNIVERSAL] = {{1, 1, 1}, {1, 0, 0}, {0}}, [JOINT_SPHERICAL] = {{1, 1, 1}, {0}, {0}},
          [JOINT_PLANAR] = {{0, 0, 1}, {0}, {1, 1}},       [JOINT_SCREW] = {{1, 1, 0}, {0}, {1, 1}}};
    const int *slide = space == 2 ? plane[j->type].slide : room[j->type].slide;
    const int *lean = space == 2 ? plane[j->type].lean : room[j->type].lean;
    const int *normal = space == 2 ? plane[j->type].normal : room[j->type].normal;
    double E[9], G[9], d[3];
    int n = 0;
    sides(E, G, d, j, p);
    for (int i = 0; i < 3; i++) {
        if (slide[i]) C[n++] = inner(E + 3 * i, d);
        if (lean[i]) C[n++] = inner(E + 3 * i, G + 3 * ((i + 1) % 3));
        if (i < 2 && normal[i]) C[n++] = inner(E + 3 * i, G + 6);
    }
    if (j->type == JOINT_SCREW) { /* no more than its derivatives matter: which turn it stands in does not */
        const double pitch = tree_pitch(j->number), turn = atan2(inner(E + 3, G), inner(E, G));
        C[n] = inner(E + 6, d) - pitch * turn;
        C[n] -= j->number * round(C[n] / j->number);
        n++;
    }
    return n;
}

/* Coordinate k of a joint, from how its two sides stand. */
static inline double coordinate_value(const struct any_joint *j, int k, const struct place *p)
{
    double E[9], G[9], d[3];
    sides(E, G, d, j, p);
    const double turn = atan2(inner(E + 3, G), inner(E, G));
    switch (j->type) {
    case JOINT_PRISMATIC:
        return inner(E + 6, d);
    case JOINT_CYLINDRICAL:
        return k ? inner(E + 6, d) : turn;
    case JOINT_UNIVERSAL:
        return k ? atan2(inner(E, G + 6), inner(E, G)) : atan2(inner(E + 6, G + 3), inner(E + 3, G + 3));
    case JOINT_PLANAR:
        return k < 2 ? inner(E + 3 * k, d) : turn;
    case JOINT_REVOLUTE:
    case JOINT_SCREW:
        break;
    case JOINT_FREE: /* of these and of those below none is asked for */
    case JOINT_SPHERICAL:
    case JOINT_FIXED:
    case JOINT_DISTANCE:
    case JOINT_POINT_ON_LINE:
    case JOINT_GEAR:
    case JOINT_RACK:
    case JOINT_TYPES:
        break;
    }
    return turn;
}

static inline double measure_value(const struct mechanism *o, int measure, const struct place *p)
{
    const struct model_measure *m = &o->model.measure[measure];
    if (m->type == MEASURE_COORDINATE) {
        const struct model_coordinate *c = &o->model.coordinate[m->iq];
        return coordinate_value(&o->joint[c->joint], c->k, p);
    }
    const struct place *A = &p[m->a.body], *B = &p[m->b.body];
    double a[3], b[3], d[3], e[3];
    tree_mv(a, A->R, m->a.p);
    tree_mv(b, B->R, m->b.p);
    tree_mv(e, A->R, m->axis);
    for (int i = 0; i < 3; i++) d[i] = B->r[i] + b[i] - A->r[i] - a[i];
    if (m->type == MEASURE_DISTANCE) return sqrt(inner(d, d));
    if (m->type == MEASURE_DISPLACEMENT) return inner(e, d);
    const double *Da = o->model.body[m->a.body].R, *Db = o->model.body[m->b.body].R; /* plane: turned since drawn */
    double Ta[9], Tb[9], Dt[9];
    for (int i = 0; i < 9; i++) Dt[i] = Da[i % 3 * 3 + i / 3];
    tree_mm(Ta, A->R, Dt);
    for (int i = 0; i < 9; i++) Dt[i] = Db[i % 3 * 3 + i / 3];
    tree_mm(Tb, B->R, Dt);
    return (e[2] > 0 ? 1 : -1) * atan2(Ta[0] * Tb[1] - Ta[1] * Tb[0], Ta[0] * Tb[0] + Ta[1] * Tb[1]);
}

static inline double told(const double *c, double t)
{
    return c[0] + t * (c[1] + t * c[2]);
}

/* Joints first, then drives. */
static inline int values(double *C, const struct mechanism *o, const struct place *p, double t)
{
    const struct model *m = &o->model;
    int n = 0;
    for (int i = 0; i < o->njoint; i++) n += joint_values(C + n, &o->joint[i], p, m->space);
    for (int l = m->nloop - m->ndrive; l < m->nloop; l++)
        C[n++] = measure_value(o, o->loop[l].measure, p) - told(o->c[l], t);
    return n;
}

/* Turned by the vector w. */
static inline void turned(double *R, const double *from, const double *w)
{
    double size = sqrt(inner(w, w)), q[4] = {cos(size / 2), 0, 0, 0}, T[9];
    for (int k = 0; k < 3; k++) q[1 + k] = size > 0 ? sin(size / 2) * w[k] / size : 0;
    tree_matrix(T, q);
    tree_mm(R, T, from);
}

static const double STEP = 4e-3;
static const double first[7] = {-1. / 60, 3. / 20, -3. / 4, 0, 3. / 4, -3. / 20, 1. / 60};
static const double second[7] = {1. / 90, -3. / 20, 3. / 2, -49. / 18, 3. / 2, -3. / 20, 1. / 90};

/* J [rows][6 (nbody - 1)] */
static inline void slopes(double (*J)[MOST], const struct mechanism *o, const struct place *p, double t)
{
    struct place q[MOST_BODIES];
    double C[MOST_ROWS];
    const int nb = o->model.nbody;
    memset(J, 0, MOST_ROWS * sizeof *J);
    for (int k = 0; k < 6 * (nb - 1); k++)
        for (int s = -3; s <= 3; s++) {
            struct place *x = &q[1 + k / 6];
            memcpy(q, p, sizeof *q * (size_t)nb);
            double w[3] = {0};
            if (k % 6 < 3)
                x->r[k % 6] += s * STEP;
            else
                w[k % 6 - 3] = s * STEP, turned(x->R, p[1 + k / 6].R, w);
            int n = values(C, o, q, t);
            for (int i = 0; i < n; i++) J[i][k] += first[3 + s] / STEP * C[i];
        }
}

/* First and second derivative of C along the motion without accelerations. */
static inline int rates(double *C1, double *C2, const struct mechanism *o, const struct place *p, double t)
{
    static const double h = 3e-3;
    struct place q[MOST_BODIES];
    double C[MOST_ROWS], w[3];
    int n = 0;
    memset(C1, 0, MOST_ROWS * sizeof *C1);
    memset(C2, 0, MOST_ROWS * sizeof *C2);
    for (int s = -3; s <= 3; s++) {
        memcpy(q, p, sizeof q);
        for (int b = 0; b < o->model.nbody; b++) {
            for (int k = 0; k < 3; k++) q[b].r[k] += s * h * p[b].v[k], w[k] = s * h * p[b].w[k];
            turned(q[b].R, p[b].R, w);
        }
        n = values(C, o, q, t + s * h);
        for (int i = 0; i < n; i++) C1[i] += first[3 + s] / h * C[i], C2[i] += second[3 + s] / (h * h) * C[i];
    }
    return n;
}

/* --- the independent solution ----------------------------------------------------------------------- */

static double J[MOST_ROWS][MOST];

static inline double augmented(double *x, const struct mechanism *o, const struct place *p, const double *C2, int rows,
                               double t)
{
    slopes(J, o, p, t);
    return augmented_solve(x, &o->model, p, J, C2, rows);
}

/* Do the equations say something twice at p? */
static inline bool repeats(const struct mechanism *o, const struct place *p)
{
    double C[MOST_ROWS], x[MOST];
    const int rows = values(C, o, p, 0), nb = 6 * (o->model.nbody - 1), n = rows > nb ? rows : nb;
    int rank;
    slopes(J, o, p, 0);
    memset(S, 0, sizeof S);
    for (int i = 0; i < rows; i++) memcpy(S[i], J[i], (size_t)nb * sizeof(double));
    solve(x, &rank, n);
    return rank < rows;
}

/* --- making ------------------------------------------------------------------------------------------ */

static inline void list_joints(struct mechanism *o)
{
    const struct model *m = &o->model;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        o->joint[o->njoint++] = (struct any_joint){j->type, j->parent, j->child, j->a, j->b, j->Ea, j->Eb, j->number};
    }
    for (int i = 0; i < m->nloop - m->ndrive; i++) {
        const struct model_loop *l = &m->loop[i];
        o->joint[o->njoint++] = (struct any_joint){l->type, l->first, l->second, l->a, l->b, l->Ea, l->Eb, l->number};
    }
}

static inline void close_loop(struct mechanism *o, struct tree_dice *d)
{
    static const enum joint_type plane[] = {JOINT_REVOLUTE, JOINT_PRISMATIC, JOINT_REVOLUTE};
    static const enum joint_type room[] = {JOINT_SPHERICAL, JOINT_CYLINDRICAL, JOINT_UNIVERSAL, JOINT_PLANAR,
                                           JOINT_SCREW};
    const int space = o->model.space;
    struct model_loop *l = &o->loop[o->model.nloop++];
    double at[3], arm[3], E[9];
    int A, B;
    tree_pair(&A, &B, d, o->model.nbody);
    const struct model_body *a = &o->model.body[A], *b = &o->model.body[B];
    *l = (struct model_loop){.name = "loop", .first = A, .second = B};
    l->type = space == 2 ? plane[tree_pick(d, 3)] : room[tree_pick(d, 5)];
    if (l->type == JOINT_SCREW) l->number = tree_roll(d, .5, 2);
    tree_vector(at, d, space);
    tree_axes(E, d, l->type, space);
    for (int i = 0; i < 3; i++) arm[i] = at[i] - a->at[i];
    tree_mtv(l->a, a->R, arm);
    for (int i = 0; i < 3; i++) arm[i] = at[i] - b->at[i];
    tree_mtv(l->b, b->R, arm);
    tree_mtm(l->Ea, a->R, E);
    tree_mtm(l->Eb, b->R, E);
}

/* A drive's measure: one that can be driven, and whose coordinate has a meaning here by itself. */
static inline bool fits(const struct model *m, int i)
{
    const struct model_measure *s = &m->measure[i];
    if (s->type == MEASURE_ANGLE) return m->space == 2;
    if (s->type != MEASURE_COORDINATE) return true;
    return m->joint[m->coordinate[s->iq].joint].type != JOINT_FREE;
}

static inline int find_time(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)value, (void)error;
    *slot = 0;
    return strcmp(name, "t") != 0;
}

/* c0 + c1 t + c2 t^2. */
static inline struct signal smooth(const double *c, struct arena *arena)
{
    static const struct expr_names names = {.find = find_time, .self = NULL};
    struct expr_error error;
    struct expr *e;
    char text[200];
    snprintf(text, sizeof text, "%.17g + t*(%.17g + t*(%.17g))", c[0], c[1], c[2]);
    assert_int_equal(expr_parse(&e, text, strlen(text), &names, arena, &error), 0);
    return (struct signal){.expr = e};
}

/* c0 + c1 t, from t = CORNER on with the rate c1 + c2. */
static inline struct signal bent(const double *c, struct arena *arena)
{
    double *t = TAKE(arena, double, 3), *x = TAKE(arena, double, 3);
    t[1] = CORNER, t[2] = 2 * CORNER;
    x[0] = c[0], x[1] = x[0] + c[1] * CORNER, x[2] = x[1] + (c[1] + c[2]) * CORNER;
    return (struct signal){.n = 3, .t = t, .x = x};
}

static inline void add_drive(struct mechanism *o, struct tree_dice *d, const struct place *drawn, bool corners,
                             struct arena *arena)
{
    struct model *m = &o->model;
    int s = 0, l = m->nloop;
    for (int i = 0; i < m->ndrive + 1; i++) /* none twice */
        do s = tree_pick(d, m->nmeasure);
        while (!fits(m, s));
    for (int i = l - m->ndrive; i < l; i++)
        if (o->loop[i].measure == s) return;
    const struct model_measure *def = &m->measure[s];
    double *c = o->c[l];
    c[0] = measure_value(o, s, drawn) + tree_roll(d, -.02, .02);
    for (int k = 1; k < 3; k++) c[k] = tree_roll(d, -1, 1);
    o->signal[l] = corners ? bent(c, arena) : smooth(c, arena);
    o->loop[l] = (struct model_loop){.name = "drive", .drive = &o->signal[l], .measure = s};
    if (def->type == MEASURE_COORDINATE) {
        const struct model_joint *j = &m->joint[m->coordinate[def->iq].joint];
        o->loop[l].first = j->parent, o->loop[l].second = j->child;
    } else {
        o->loop[l].first = def->a.body, o->loop[l].second = def->b.body;
    }
    m->nloop++;
    m->ndrive++;
}

static inline void make(struct mechanism *o, struct place *drawn, int space, unsigned seed, bool corners,
                        struct arena *arena)
{
    struct tree_dice dice = {seed * 131u + 17u}, *d = &dice;
    struct model *tree =
        random_tree(space, 2 + tree_pick(d, 4), seed, TREE_FORCES | (seed % 3 ? 0 : TREE_CHAIN), arena);
    double *q = TAKE(arena, double, tree->nq), *v = TAKE(arena, double, tree->n);
    memset(o, 0, sizeof *o);
    o->model = *tree;
    o->model.nforce = 0;
    for (int i = 0; i < tree->njoint; i++) /* as drawn: 0, unit quaternions */
        if (tree_turns(&tree->joint[i], space)) q[tree->joint[i].iq[tree->joint[i].nq - 4]] = 1;
    for (int i = 0; i < tree->n; i++) o->follow[i] = 1;
    o->model.q0 = q, o->model.v0 = v;
    o->model.loop = o->loop, o->model.component = o->component, o->model.ncomponent = 1;
    o->model.urgent = o->urgent;
    o->model.follow = o->model.follow_q = o->model.follow_v = o->follow;
    for (int b = 0; b < tree->nbody; b++) {
        memcpy(drawn[b].r, tree->body[b].at, sizeof drawn[b].r);
        memcpy(drawn[b].R, tree->body[b].R, sizeof drawn[b].R);
    }
    if (seed % 2) close_loop(o, d);
    list_joints(o);
    for (int n = 1 + tree_pick(d, 3); n > 0 && o->model.nloop < MOST_LOOPS; n--) add_drive(o, d, drawn, corners, arena);
}

/* Bodies as the system saw them last. */
static inline void stand(struct place *p, const struct system *s, int n)
{
    for (int b = 0; b < n; b++) {
        struct pose pose;
        system_pose(s, &pose, b);
        memcpy(p[b].r, pose.r, sizeof pose.r), memcpy(p[b].R, pose.R, sizeof pose.R);
        memcpy(p[b].v, pose.v, sizeof pose.v), memcpy(p[b].w, pose.w, sizeof pose.w);
    }
}

#endif
