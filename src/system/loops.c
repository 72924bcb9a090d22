/* loops.c -- values, derivatives and forces of loop joints, ties and drives.
 *
 * With d the vector from the first body's point to the second's, e axes of the first (A), g of the second (B),
 * wr = w_B - w_A, and u = d' - w_A x d the velocity of B's point as A sees it:
 *
 *     ALONG  C = e.d        C' = e.u            C'' = e.(d'' - al_A x d - w_A x (w_A x d) - 2 w_A x u)
 *     LEAN   C = e.g        C' = wr.(g x e)     C'' = e''.g + 2 e'.g' + e.g'',   e'' = al x e + w x (w x e)
 *     TURN   C = phi_B - phi_A                  C'' = al_B - al_A
 *     SPAN   C = |d| - L      C' = n.d'         C'' = n.d'' + (d'.d' - (n.d')^2)/|d|,   n = d/|d|
 *     SUM    C = sum f_i q_i                    C'' = sum f_i a_i
 *     DRIVE  C = s(q) - c(t), s a coordinate, a distance or displacement, in the plane an angle:
 *            C'' as above, less c''
 *
 * A row of C_q is C' per unit velocity of each coordinate.  Its multiplier lambda does the work -lambda C':
 * for ALONG a force -lambda e on B at its point and the opposite on A, for SPAN along n, for LEAN a pair of torques.
 * A sum's is the generalized force -lambda f_i on each of its coordinates, which is a matter of their joints: these
 * bear nothing of it. */
#include "system/loops.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

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

static void look_at_terms(struct loop_place *p, const struct model *m, const struct model_loop *l, const double *q)
{
    p->sum = 0;
    for (int i = 0; i < l->nterm; i++) {
        const struct model_term *t = &l->term[i];
        p->sum += t->factor * q[m->joint[t->joint].iq[t->k]];
    }
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
    const int joints = model_first_drive(o->model);
    for (int l = 0; l < joints; l++) {
        const struct model_loop *loop = &o->model->loop[l];
        if (loop->nterm)
            look_at_terms(&o->place[l], o->model, loop, q);
        else
            look(&o->place[l], o, s, loop);
    }
    for (int l = joints; l < o->model->nloop; l++) look_at_drive(o, s, l, q, v);
}

/* A row's unit: angles as they are, lengths over the mechanism's. */
static double scale(const struct loops *o, int l)
{
    return o->model->measure[o->model->loop[l].measure].angular ? 1 : 1 / o->length;
}

/* Where drive l is at t: the iterations of a step ask for the same few times again and again. */
static const double *motion_of(struct loops *o, int l, double t)
{
    struct moved *m = o->moved + MOVED * (l - model_first_drive(o->model));
    for (int i = 0; i < MOVED; i++)
        if (m[i].t == t) return m[i].x;
    for (int i = MOVED - 1; i > 0; i--) m[i] = m[i - 1];
    m[0].t = t;
    signal_motion(o->model->loop[l].drive, m[0].x, t);
    return m[0].x;
}

void loops_when(struct loops *o, double t)
{
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++) {
        const double *x = motion_of(o, l, t), unit = scale(o, l);
        int row = o->first[l];
        o->c[row] = o->share == 1 ? unit * x[0] : o->drawn[row] + o->share * (unit * x[0] - o->drawn[row]);
        o->c[row] += o->aside;
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
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++) {
        double a[3], unit = scale(o, l) / (tb - ta);
        int row = o->first[l];
        memcpy(a, motion_of(o, l, ta), sizeof a);
        const double *b = motion_of(o, l, tb);
        o->c1[row] = o->cw[row] = unit * (b[0] - a[0]);
        o->c2[row] = unit * (b[1] - a[1]);
        if (has_corner(o->model->loop[l].drive, a, b, ta, tb)) o->cw[row] = scale(o, l) * (a[1] + b[1]) / 2;
    }
}

int loops_corners(struct loops *o, double ta, double tb)
{
    int any = 0;
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++) {
        double *jump = &o->c1[o->first[l]];
        *jump = scale(o, l) * signal_corner(o->model->loop[l].drive, ta, tb);
        any |= *jump != 0;
    }
    return any;
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
        case ROW_SPAN:
            C[i] = (v3_norm(p->d) - o->model->loop[r->loop].length) / o->length;
            break;
        case ROW_SUM:
            C[i] = p->sum / o->scale[r->loop];
            break;
        case ROW_DRIVE:
            C[i] = scale(o, r->loop) * o->act[r->loop].s - o->c[i];
            break;
        }
    }
}

/* n of a span; 0 while its points are in one place. */
static void along(double *n, const double *d)
{
    const double size = v3_norm(d);
    v3_scale(n, size > 0 ? 1 / size : 0, d);
}

static bool is_force(const struct loop_row *r)
{
    return r->type == ROW_ALONG || r->type == ROW_SPAN;
}

/* The row of a joint or rod as a pair of opposite unit wrenches: C' = dir.(relative velocity at the second's point), or
 * of (relative angular velocity). */
static void direction(double *dir, const struct loops *o, const struct loop_row *r)
{
    const struct loop_place *p = &o->place[r->loop];
    if (r->type == ROW_ALONG) v3_scale(dir, 1 / o->length, p->EA + 3 * r->i);
    if (r->type == ROW_LEAN) v3_cross(dir, p->EB + 3 * r->j, p->EA + 3 * r->i);
    if (r->type == ROW_TURN) v3_set(dir, 0, 0, 1);
    if (r->type != ROW_SPAN) return;
    along(dir, p->d);
    v3_scale(dir, 1 / o->length, dir);
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
    double dir[LOOP_ROWS][3];
    for (int i = 0; i < n; i++) direction(dir[i], o, &o->row[first + i]);
    for (int k = 0; k < nk; k++) {
        double v[3], w[3];
        int side = o->side[l][k];
        o->ops->partial(s, v, w, side > 0 ? loop->second : loop->first, o->place[l].x, o->k[l][k]);
        for (int i = 0; i < n; i++) o->Cq[l][i * nk + k] = side * v3_dot(dir[i], is_force(&o->row[first + i]) ? v : w);
    }
}

void loops_jacobian(struct loops *o, const struct sweep *s)
{
    const int joints = model_first_drive(o->model);
    for (int l = 0; l < joints; l++)
        if (o->model->loop[l].nterm == 0) jacobian(o, s, l);
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

/* Of the distance between the world points a on A and b on B. */
static double second_distance(const struct loop_place *p, const double *a, const double *b)
{
    double arm[3], vb[3], ab[3], va[3], aa[3], d[3], n[3];
    v3_diff(arm, b, p->B.r);
    point_rates(vb, ab, &p->B, arm);
    v3_diff(arm, a, p->A.r);
    point_rates(va, aa, &p->A, arm);
    v3_take(vb, va);
    v3_take(ab, aa);
    v3_diff(d, b, a);
    along(n, d);
    const double rate = v3_dot(n, vb);
    return v3_dot(n, ab) + (v3_dot(vb, vb) - rate * rate) / v3_norm(d);
}

static double second_span(const struct loop_place *p)
{
    double a[3];
    v3_diff(a, p->x, p->d);
    return second_distance(p, a, p->x);
}

static double second_sum(const struct model *m, const struct model_loop *l, const double *a)
{
    double sum = 0;
    for (int i = 0; i < l->nterm; i++) sum += l->term[i].factor * a[m->joint[l->term[i].joint].iv[l->term[i].k]];
    return sum;
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
        return second_distance(p, act->at_a, act->at_b);
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
        case ROW_SPAN:
            C2[i] = second_span(p) / o->length;
            break;
        case ROW_SUM:
            C2[i] = second_sum(o->model, &o->model->loop[r->loop], a) / o->scale[r->loop];
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
    for (int i = o->first[l]; i < o->first[l + 1] && o->model->loop[l].nterm == 0; i++) {
        double dir[3];
        direction(dir, o, &o->row[i]);
        v3_axpy(is_force(&o->row[i]) ? f : n, -lambda[i], dir);
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
        if (loop->nterm) continue;
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

double loops_force(const struct loops *o, int l, const double *lambda)
{
    const struct model_loop *loop = &o->model->loop[l];
    const double x = -lambda[o->first[l]];
    if (loop->nterm) return x * loop->term[loop->nterm - 1].factor / o->scale[l];
    return loop->type == JOINT_DISTANCE && !loop->drive ? x / o->length : 0;
}
