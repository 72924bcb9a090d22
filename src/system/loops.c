/* loops.c -- values, derivatives and forces of loop joints.
 *
 * With d the vector from the first body's point to the second's, e axes of the first (A), g of the second (B),
 * wr = w_B - w_A, and u = d' - w_A x d the velocity of B's point as A sees it:
 *
 *     ALONG  C = e.d        C' = e.u            C'' = e.(d'' - al_A x d - w_A x (w_A x d) - 2 w_A x u)
 *     LEAN   C = e.g        C' = wr.(g x e)     C'' = e''.g + 2 e'.g' + e.g'',   e'' = al x e + w x (w x e)
 *     TURN   C = phi_B - phi_A                  C'' = al_B - al_A
 *     DRIVE  C = s(q) - c(t), s a coordinate, a distance or displacement, in the plane an angle:
 *            C'' of |d|: n.d'' + (d'.d' - s'^2)/s, n = d/s; of the others as above; less c''
 *
 * A row of C_q is C' per unit velocity of each coordinate.  Its multiplier lambda does the work -lambda C':
 * for ALONG a force -lambda e on B at its point and the opposite on A, for LEAN a pair of torques. */
#include "system/loops.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

/* --- building ----------------------------------------------------------------------------------- */

struct equation {
    enum loop_row_type type;
    int i, j;
};

enum { MOST_ROWS = 6 };

struct equations {
    int n;
    struct equation e[MOST_ROWS];
};

/* Along an axis of the first body; of an axis of the second leaning towards one of the first. */
#define X                                                                                                              \
    {                                                                                                                  \
        ROW_ALONG, 0, 0                                                                                                \
    }
#define Y                                                                                                              \
    {                                                                                                                  \
        ROW_ALONG, 1, 0                                                                                                \
    }
#define Z                                                                                                              \
    {                                                                                                                  \
        ROW_ALONG, 2, 0                                                                                                \
    }
#define XY                                                                                                             \
    {                                                                                                                  \
        ROW_LEAN, 0, 1                                                                                                 \
    }
#define YZ                                                                                                             \
    {                                                                                                                  \
        ROW_LEAN, 1, 2                                                                                                 \
    }
#define ZX                                                                                                             \
    {                                                                                                                  \
        ROW_LEAN, 2, 0                                                                                                 \
    }
#define XZ                                                                                                             \
    {                                                                                                                  \
        ROW_LEAN, 0, 2                                                                                                 \
    }
#define TURN                                                                                                           \
    {                                                                                                                  \
        ROW_TURN, 0, 0                                                                                                 \
    }

static const struct equations plane[JOINT_TYPES] = {
    [JOINT_FIXED] = {3, {X, Y, TURN}}, [JOINT_REVOLUTE] = {2, {X, Y}}, [JOINT_PRISMATIC] = {2, {X, TURN}}};

static const struct equations room[JOINT_TYPES] = {[JOINT_FIXED] = {6, {X, Y, Z, XY, YZ, ZX}},
                                                   [JOINT_REVOLUTE] = {5, {X, Y, Z, XZ, YZ}},
                                                   [JOINT_PRISMATIC] = {5, {X, Y, XY, YZ, ZX}},
                                                   [JOINT_CYLINDRICAL] = {4, {X, Y, XZ, YZ}},
                                                   [JOINT_UNIVERSAL] = {4, {X, Y, Z, XY}},
                                                   [JOINT_SPHERICAL] = {3, {X, Y, Z}},
                                                   [JOINT_PLANAR] = {3, {Z, XZ, YZ}}};

/* The equations of a joint: each freedom it takes away. */
static int equations_of(struct equation *o, enum joint_type type, int space)
{
    int n = space == 2 ? plane[type].n : room[type].n;
    memcpy(o, space == 2 ? plane[type].e : room[type].e, sizeof *o * (size_t)n);
    return n;
}

/* The largest arm of a joint on a body; the ground's place in the world does not count. */
static double length_of(const struct model *m)
{
    double most = 0;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        if (j->parent) most = fmax(most, v3_norm(j->a));
        most = fmax(most, v3_norm(j->b));
    }
    for (int i = 0; i < m->nloop; i++) {
        const struct model_loop *l = &m->loop[i];
        if (l->first) most = fmax(most, v3_norm(l->a));
        if (l->second) most = fmax(most, v3_norm(l->b));
    }
    return most > 0 ? most : 1;
}

static bool among(const int *k, int n, int what)
{
    for (int i = 0; i < n; i++)
        if (k[i] == what) return true;
    return false;
}

static void add_path(struct loops *o, int l, const int *k, int n, const int *other, int nother, int side)
{
    for (int i = 0; i < n; i++) {
        if (among(other, nother, k[i])) continue;
        o->side[l][o->nk[l]] = side;
        o->k[l][o->nk[l]++] = k[i];
    }
}

static void tie(struct loops *o, int l, const struct sweep *s, struct arena *life)
{
    const struct model_loop *loop = &o->model->loop[l];
    const int *a, *b;
    int na = o->ops->path(s, &a, loop->first), nb = o->ops->path(s, &b, loop->second);
    if (loop->drive && o->model->measure[loop->measure].type == MEASURE_COORDINATE) {
        a = b = &o->model->measure[loop->measure].iv;
        na = 0;
        nb = 1;
    }
    o->k[l] = TAKE(life, int, na + nb);
    o->side[l] = TAKE(life, int, na + nb);
    add_path(o, l, a, na, b, nb, -1);
    add_path(o, l, b, nb, a, na, 1);
    o->Cq[l] = TAKE(life, double, (o->first[l + 1] - o->first[l]) * o->nk[l]);
}

struct loops *loops_build(const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    struct loops *o = TAKE(life, struct loops, 1);
    o->model = m;
    o->ops = ops;
    o->length = length_of(m);
    o->row = TAKE(life, struct loop_row, MOST_ROWS * m->nloop);
    o->first = TAKE(life, int, m->nloop + 1);
    o->place = TAKE(life, struct loop_place, m->nloop);
    o->nk = TAKE(life, int, m->nloop);
    o->k = TAKE(life, int *, m->nloop);
    o->side = TAKE(life, int *, m->nloop);
    o->Cq = TAKE(life, double *, m->nloop);
    struct sweep *paths = ops->build(m, life);
    for (int l = 0; l < m->nloop; l++) {
        struct equation e[MOST_ROWS] = {{ROW_DRIVE, 0, 0}};
        int n = m->loop[l].drive ? 1 : equations_of(e, m->loop[l].type, m->space);
        for (int i = 0; i < n; i++) o->row[o->nrow++] = (struct loop_row){l, e[i].type, e[i].i, e[i].j};
        o->first[l + 1] = o->nrow;
        tie(o, l, paths, life);
    }
    measures_build(&o->measures, m, ops, life);
    o->grad = row_make(m->n, life);
    o->act = TAKE(life, struct action, m->nloop);
    o->c = TAKE(life, double, o->nrow);
    o->c1 = TAKE(life, double, o->nrow);
    o->c2 = TAKE(life, double, o->nrow);
    o->cw = TAKE(life, double, o->nrow);
    o->drawn = TAKE(life, double, o->nrow);
    o->share = 1;
    return o;
}

/* --- motion ------------------------------------------------------------------------------------- */

static void look(struct loop_place *p, const struct loops *o, const struct sweep *s, const struct model_loop *l)
{
    double a[3], b[3];
    o->ops->pose(s, &p->A, l->first);
    o->ops->pose(s, &p->B, l->second);
    m3_mul(a, p->A.R, l->a);
    m3_mul(b, p->B.R, l->b);
    v3_sum(p->x, p->B.r, b);
    v3_diff(p->d, p->x, p->A.r);
    v3_take(p->d, a);
    m3_mulm(p->EA, p->A.R, l->Ea);
    m3_mulm(p->EB, p->B.R, l->Eb);
}

/* A driven measure and where its bodies stand. */
static void look_at_drive(struct loops *o, const struct sweep *s, int l, const double *q, const double *v)
{
    const struct model_loop *d = &o->model->loop[l];
    measure_at(&o->act[l], &o->measures, s, d->measure, q, v);
    if (o->model->measure[d->measure].type == MEASURE_COORDINATE) return;
    o->ops->pose(s, &o->place[l].A, d->first);
    o->ops->pose(s, &o->place[l].B, d->second);
}

void loops_look(struct loops *o, const struct sweep *s, const double *q, const double *v)
{
    const int joints = o->model->nloop - o->model->ndrive;
    for (int l = 0; l < joints; l++) look(&o->place[l], o, s, &o->model->loop[l]);
    for (int l = joints; l < o->model->nloop; l++) look_at_drive(o, s, l, q, v);
}

/* A row's unit: angles as they are, lengths over the mechanism's. */
static double scale(const struct loops *o, int l)
{
    return o->model->measure[o->model->loop[l].measure].angular ? 1 : 1 / o->length;
}

void loops_when(struct loops *o, double t)
{
    for (int l = o->model->nloop - o->model->ndrive; l < o->model->nloop; l++) {
        double x[3], unit = scale(o, l);
        int row = o->first[l];
        signal_motion(o->model->loop[l].drive, x, t);
        o->c[row] = o->share == 1 ? unit * x[0] : o->drawn[row] + o->share * (unit * x[0] - o->drawn[row]);
        o->c1[row] = o->cw[row] = unit * x[1];
        o->c2[row] = unit * x[2];
    }
}

/* Is the mean rate so far from that of the ends because there is a corner between? */
static bool has_corner(const struct signal *c, const double *a, const double *b, double ta, double tb)
{
    const double mean = (b[0] - a[0]) / (tb - ta), ends = (a[1] + b[1]) / 2;
    return fabs(mean - ends) > 1e-3 * (fabs(mean) + fabs(ends)) && signal_corner(c, ta, tb) != 0;
}

void loops_over(struct loops *o, double ta, double tb)
{
    if (ta == tb) return;
    for (int l = o->model->nloop - o->model->ndrive; l < o->model->nloop; l++) {
        double a[3], b[3], unit = scale(o, l) / (tb - ta);
        int row = o->first[l];
        signal_motion(o->model->loop[l].drive, a, ta);
        signal_motion(o->model->loop[l].drive, b, tb);
        o->c1[row] = o->cw[row] = unit * (b[0] - a[0]);
        o->c2[row] = unit * (b[1] - a[1]);
        if (has_corner(o->model->loop[l].drive, a, b, ta, tb)) o->cw[row] = scale(o, l) * (a[1] + b[1]) / 2;
    }
}

void loops_values(double *C, const struct loops *o)
{
    for (int i = 0; i < o->nrow; i++) {
        const struct loop_row *r = &o->row[i];
        const struct loop_place *p = &o->place[r->loop];
        switch (r->type) {
        case ROW_ALONG:
            C[i] = v3_dot(p->EA + 3 * r->i, p->d) / o->length;
            break;
        case ROW_LEAN:
            C[i] = v3_dot(p->EA + 3 * r->i, p->EB + 3 * r->j);
            break;
        case ROW_TURN:
            C[i] = p->B.angle - p->A.angle;
            break;
        case ROW_DRIVE:
            C[i] = scale(o, r->loop) * o->act[r->loop].s - o->c[i];
            break;
        }
    }
}

/* The row as a pair of opposite unit wrenches: C' = dir.(relative velocity at the second's point), or of (relative
 * angular velocity). */
static void direction(double *dir, const struct loops *o, const struct loop_row *r)
{
    const struct loop_place *p = &o->place[r->loop];
    if (r->type == ROW_ALONG) v3_scale(dir, 1 / o->length, p->EA + 3 * r->i);
    if (r->type == ROW_LEAN) v3_cross(dir, p->EB + 3 * r->j, p->EA + 3 * r->i);
    if (r->type == ROW_TURN) v3_set(dir, 0, 0, 1);
}

static void drive_jacobian(struct loops *o, const struct sweep *s, int l)
{
    row_add_measure(&o->grad, &o->measures, s, &o->act[l], o->model->loop[l].measure);
    for (int k = 0; k < o->nk[l]; k++) o->Cq[l][k] = scale(o, l) * o->grad.x[o->k[l][k]];
    row_clear(&o->grad);
}

static void jacobian(struct loops *o, const struct sweep *s, int l)
{
    const struct model_loop *loop = &o->model->loop[l];
    const int nk = o->nk[l], first = o->first[l], n = o->first[l + 1] - first;
    double dir[MOST_ROWS][3];
    for (int i = 0; i < n; i++) direction(dir[i], o, &o->row[first + i]);
    for (int k = 0; k < nk; k++) {
        double v[3], w[3];
        int side = o->side[l][k];
        o->ops->partial(s, v, w, side > 0 ? loop->second : loop->first, o->place[l].x, o->k[l][k]);
        for (int i = 0; i < n; i++)
            o->Cq[l][i * nk + k] = side * v3_dot(dir[i], o->row[first + i].type == ROW_ALONG ? v : w);
    }
}

void loops_jacobian(struct loops *o, const struct sweep *s)
{
    const int joints = o->model->nloop - o->model->ndrive;
    for (int l = 0; l < joints; l++) jacobian(o, s, l);
    for (int l = joints; l < o->model->nloop; l++) drive_jacobian(o, s, l);
}

/* Of the second body's point b (from the centre, world) or the first's: v + w x b, a + al x b + w x (w x b). */
static void point_rates(double *xv, double *xa, const struct pose *p, const double *b)
{
    double turned[3];
    v3_cross(turned, p->w, b);
    v3_sum(xv, p->v, turned);
    v3_copy(xa, p->a);
    v3_cross_add(xa, p->al, b);
    v3_cross_add(xa, p->w, turned);
}

static double second_along(const struct loop_place *p, const double *e)
{
    double b[3], vb[3], ab[3], va[3], aa[3], u[3], coriolis[3];
    v3_diff(b, p->x, p->B.r);
    point_rates(vb, ab, &p->B, b);
    v3_diff(b, p->x, p->A.r); /* A's motion where B's point is: w_A x d and its kin are in it */
    point_rates(va, aa, &p->A, b);
    v3_diff(u, vb, va);
    v3_cross(coriolis, p->A.w, u);
    v3_take(ab, aa);
    v3_axpy(ab, -2, coriolis);
    return v3_dot(e, ab);
}

static double second_lean(const struct loop_place *p, const double *e, const double *g)
{
    double e1[3], g1[3], e2[3], g2[3];
    v3_cross(e1, p->A.w, e);
    v3_cross(g1, p->B.w, g);
    v3_cross(e2, p->A.al, e);
    v3_cross_add(e2, p->A.w, e1);
    v3_cross(g2, p->B.al, g);
    v3_cross_add(g2, p->B.w, g1);
    return v3_dot(e2, g) + 2 * v3_dot(e1, g1) + v3_dot(e, g2);
}

static double second_distance(const struct loop_place *p, const struct action *act)
{
    double b[3], vb[3], ab[3], va[3], aa[3];
    v3_diff(b, act->at_b, p->B.r);
    point_rates(vb, ab, &p->B, b);
    v3_diff(b, act->at_a, p->A.r);
    point_rates(va, aa, &p->A, b);
    v3_take(vb, va);
    v3_take(ab, aa);
    return v3_dot(act->dir, ab) + (v3_dot(vb, vb) - act->rate * act->rate) / act->s;
}

static double second_measure(const struct loops *o, int l, const double *a)
{
    const struct model_measure *m = &o->model->measure[o->model->loop[l].measure];
    const struct action *act = &o->act[l];
    struct loop_place *p = &o->place[l];
    switch (m->type) {
    case MEASURE_COORDINATE:
        return a[m->iv];
    case MEASURE_DISTANCE:
        return second_distance(p, act);
    case MEASURE_DISPLACEMENT:
        v3_copy(p->x, act->at_b);
        return second_along(p, act->dir);
    case MEASURE_ANGLE:
        break;
    }
    return act->dir[2] * (p->B.al[2] - p->A.al[2]);
}

void loops_second(double *C2, const struct loops *o, const double *a)
{
    for (int i = 0; i < o->nrow; i++) {
        const struct loop_row *r = &o->row[i];
        const struct loop_place *p = &o->place[r->loop];
        switch (r->type) {
        case ROW_ALONG:
            C2[i] = second_along(p, p->EA + 3 * r->i) / o->length;
            break;
        case ROW_LEAN:
            C2[i] = second_lean(p, p->EA + 3 * r->i, p->EB + 3 * r->j);
            break;
        case ROW_TURN:
            C2[i] = p->B.al[2] - p->A.al[2];
            break;
        case ROW_DRIVE:
            C2[i] = scale(o, r->loop) * second_measure(o, r->loop, a) - o->c2[i];
            break;
        }
    }
}

/* --- forces ------------------------------------------------------------------------------------- */

static void wrench(double *f, double *n, const struct loops *o, int l, const double *lambda)
{
    v3_set(f, 0, 0, 0);
    v3_set(n, 0, 0, 0);
    for (int i = o->first[l]; i < o->first[l + 1]; i++) {
        double dir[3];
        direction(dir, o, &o->row[i]);
        v3_axpy(o->row[i].type == ROW_ALONG ? f : n, -lambda[i], dir);
    }
}

/* A drive along a coordinate is a matter of its joint: nothing to push. */
static void push_drive(const struct loops *o, struct sweep *s, int l, const double *lambda)
{
    if (o->model->measure[o->model->loop[l].measure].type == MEASURE_COORDINATE) return;
    action_push(&o->measures, s, &o->act[l], -lambda[o->first[l]] * scale(o, l));
}

void loops_drive(const struct loops *o, double *force, double *power, int l, const double *lambda)
{
    const int row = o->first[l];
    *force = -lambda[row] * scale(o, l);
    *power = -lambda[row] * o->c1[row];
}

void loops_push(const struct loops *o, struct sweep *s, const double *lambda)
{
    for (int l = 0; l < o->model->nloop; l++) {
        if (o->model->loop[l].drive) {
            push_drive(o, s, l, lambda);
            continue;
        }
        const struct model_loop *loop = &o->model->loop[l];
        double f[3], n[3];
        wrench(f, n, o, l, lambda);
        o->ops->push(s, loop->second, o->place[l].x, f);
        o->ops->twist(s, loop->second, n);
        v3_scale(f, -1, f);
        v3_scale(n, -1, n);
        o->ops->push(s, loop->first, o->place[l].x, f);
        o->ops->twist(s, loop->first, n);
    }
}

void loops_reaction(const struct loops *o, double *f, double *n, int l, const double *lambda)
{
    wrench(f, n, o, l, lambda);
}
