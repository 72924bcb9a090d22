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
#include <math.h>
#include <string.h>

#include "loop/loops_parts.h"

/* --- motion ------------------------------------------------------------------------------------- */

static void look(struct loops *o, const struct sweep *s, int loop)
{
    const struct model_loop *l = &o->model->loop[loop];
    struct loop_place *p = &o->place[loop];
    double a[3], b[3];
    o->ops->pose(s, &p->A, l->first);
    o->ops->pose(s, &p->B, l->second);
    m3_mul(a, p->A.R, l->a);
    m3_mul(b, p->B.R, l->b);
    v3_sum(p->x, p->B.r, b);
    v3_diff(p->d, p->x, p->A.r);
    v3_take(p->d, a);
    for (int i = o->first[loop]; i < o->first[loop + 1]; i++) {
        const struct loop_row *r = &o->row[i];
        if (r->type == ROW_ALONG || r->type == ROW_LEAN) m3_mul(o->axes[i].e, p->A.R, l->Ea + 3 * r->i);
        if (r->type == ROW_LEAN) m3_mul(o->axes[i].g, p->B.R, l->Eb + 3 * r->j);
    }
}

static void look_at_terms(struct loop_place *p, const struct model *m, const struct model_loop *l, const double *q)
{
    p->sum = 0;
    for (int i = 0; i < l->nterm; i++) {
        const struct model_term *t = &l->term[i];
        p->sum += t->factor * q[m->joint[t->joint].iq[t->k]];
    }
}

/* A driven measure; its rate is that of any motion. */
static void look_at_drive(struct loops *o, const struct sweep *s, int l, const double *q)
{
    static const double at_rest[1];
    const int i = o->model->loop[l].measure;
    if (loops_along_coordinate(o, l))
        o->act[l].s = q[o->model->measure[i].iq];
    else
        measure_at(&o->act[l], &o->measures, s, i, q, at_rest);
}

void loops_look(struct loops *o, const struct sweep *s, const double *q)
{
    const int joints = model_first_drive(o->model);
    for (int l = 0; l < joints; l++) {
        const struct model_loop *loop = &o->model->loop[l];
        if (loop->nterm)
            look_at_terms(&o->place[l], o->model, loop, q);
        else
            look(o, s, l);
    }
    for (int l = joints; l < o->model->nloop; l++) look_at_drive(o, s, l, q);
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
        const double *x = motion_of(o, l, t), unit = loops_scale(o, l);
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
        double a[3], unit = loops_scale(o, l) / (tb - ta);
        int row = o->first[l];
        memcpy(a, motion_of(o, l, ta), sizeof a);
        const double *b = motion_of(o, l, tb);
        o->c1[row] = o->cw[row] = unit * (b[0] - a[0]);
        o->c2[row] = unit * (b[1] - a[1]);
        if (has_corner(o->model->loop[l].drive, a, b, ta, tb)) o->cw[row] = loops_scale(o, l) * (a[1] + b[1]) / 2;
    }
}

int loops_corners(struct loops *o, double ta, double tb)
{
    int any = 0;
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++) {
        double *jump = &o->c1[o->first[l]];
        *jump = loops_scale(o, l) * signal_corner(o->model->loop[l].drive, ta, tb);
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
            C[i] = v3_dot(o->axes[i].e, p->d) / o->length;
            break;
        case ROW_LEAN:
            C[i] = v3_dot(o->axes[i].e, o->axes[i].g);
            break;
        case ROW_TURN:
            C[i] = p->B.angle - p->A.angle;
            break;
        case ROW_SPAN:
            C[i] = (v3_norm(p->d) - o->model->loop[r->loop].number) / o->length;
            break;
        case ROW_SUM:
            C[i] = p->sum / o->scale[r->loop];
            break;
        case ROW_DRIVE:
            C[i] = loops_scale(o, r->loop) * o->act[r->loop].s - o->c[i];
            break;
        }
    }
}

static bool is_force(const struct loop_row *r)
{
    return r->type == ROW_ALONG || r->type == ROW_SPAN;
}

/* The row of a joint or rod as a pair of opposite unit wrenches: C' = dir.(relative velocity at the second's point), or
 * of (relative angular velocity). */
static void direction(double *dir, const struct loops *o, int i)
{
    const struct loop_row *r = &o->row[i];
    const struct loop_place *p = &o->place[r->loop];
    if (r->type == ROW_ALONG) v3_scale(dir, 1 / o->length, o->axes[i].e);
    if (r->type == ROW_LEAN) v3_cross(dir, o->axes[i].g, o->axes[i].e);
    if (r->type == ROW_TURN) v3_set(dir, 0, 0, 1);
    if (r->type != ROW_SPAN) return;
    loops_normal(dir, p->d);
    v3_scale(dir, 1 / o->length, dir);
}

static void drive_jacobian(struct loops *o, const struct sweep *s, int l)
{
    if (loops_along_coordinate(o, l)) {
        o->Cq[l][0] = loops_scale(o, l);
        return;
    }
    row_add_measure(&o->grad, &o->measures, s, &o->act[l], o->model->loop[l].measure);
    for (int k = 0; k < o->nk[l]; k++) o->Cq[l][k] = loops_scale(o, l) * o->grad.x[o->k[l][k]];
    row_clear(&o->grad);
}

/* A row's unit wrench as what it does on the second body and, the other way, on the first, by the coordinates of their
 * ways. */
static void wrench_row(struct loops *o, const struct sweep *s, double *Cq, int l, int row)
{
    const struct model_loop *loop = &o->model->loop[l];
    const struct loop_ways *w = &o->ways[l];
    const double *x = o->place[l].x;
    const bool force = is_force(&o->row[row]);
    double dir[3], back[3], *to = w->same ? o->grad.g : Cq + w->n[0];
    direction(dir, o, row);
    v3_scale(back, -1, dir);
    if (w->n[0] > 0) o->ops->row(s, Cq, loop->first, w->from, x, force ? back : NULL, force ? NULL : back);
    if (w->n[1] > 0) o->ops->row(s, to, loop->second, w->from, x, force ? dir : NULL, force ? NULL : dir);
    if (w->same == 0) return;
    for (int k = 0; k < w->same; k++) Cq[k] += to[k];
    for (int k = w->same; k < w->n[1]; k++) Cq[w->n[0] + k - w->same] = to[k];
}

static void jacobian(struct loops *o, const struct sweep *s, int l)
{
    double *Cq = o->Cq[l];
    for (int i = o->first[l]; i < o->first[l + 1]; i++, Cq += o->nk[l]) wrench_row(o, s, Cq, l, i);
}

void loops_jacobian(struct loops *o, const struct sweep *s)
{
    const int joints = model_first_drive(o->model);
    for (int l = 0; l < joints; l++)
        if (o->model->loop[l].nterm == 0) jacobian(o, s, l);
    for (int l = joints; l < o->model->nloop; l++) drive_jacobian(o, s, l);
}

/* --- forces ------------------------------------------------------------------------------------- */

static void wrench(double *f, double *n, const struct loops *o, int l, const double *lambda)
{
    v3_set(f, 0, 0, 0);
    v3_set(n, 0, 0, 0);
    for (int i = o->first[l]; i < o->first[l + 1] && o->model->loop[l].nterm == 0; i++) {
        double dir[3];
        direction(dir, o, i);
        v3_axpy(is_force(&o->row[i]) ? f : n, -lambda[i], dir);
    }
}

/* A drive along a coordinate is a matter of its joint: nothing to push. */
static void push_drive(const struct loops *o, struct sweep *s, int l, const double *lambda)
{
    if (loops_along_coordinate(o, l)) return;
    action_push(&o->measures, s, &o->act[l], -lambda[o->first[l]] * loops_scale(o, l));
}

void loops_drive(const struct loops *o, double *force, double *power, int l, const double *lambda)
{
    const int row = o->first[l];
    *force = -lambda[row] * loops_scale(o, l);
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
