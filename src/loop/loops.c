/* loops.c -- loop joints, ties and drives at a posture: values, derivatives and forces of their rows; see
 * equations.c. */
#include <math.h>
#include <string.h>

#include "base/inline.h"
#include "la/rot.h"
#include "loop/equations.h"

/* --- motion ------------------------------------------------------------------------------------- */

/* y = R x, where R turns about z. */
static inline void turn_flat(double *y, const double *R, const double *x)
{
    v3_set(y, R[0] * x[0] + R[3] * x[1], R[1] * x[0] + R[4] * x[1], x[2]);
}

INTO static inline void place(struct loops *o, const struct sweep *s, int loop,
                              void (*turned)(double *y, const double *R, const double *x))
{
    const struct model_loop *l = &o->model->loop[loop];
    struct loop_place *p = &o->place[loop];
    double a[3], b[3];
    o->ops->stand(s, &p->A, l->first);
    o->ops->stand(s, &p->B, l->second);
    turned(a, p->A.R, l->a);
    turned(b, p->B.R, l->b);
    v3_sum(p->x, p->B.r, b);
    v3_diff(p->d, p->x, p->A.r);
    v3_take(p->d, a);
    for (int i = o->first[loop]; i < o->first[loop + 1]; i++) {
        const struct loop_row *r = &o->row[i];
        if (r->says->needs & FIRST) turned(o->axes[i].e, p->A.R, l->Ea + 3 * r->i);
        if (r->says->needs & SECOND) turned(o->axes[i].g, p->B.R, l->Eb + 3 * r->j);
    }
}

static void place_terms(struct loop_place *p, const struct model *m, const struct model_loop *l, const double *q)
{
    p->sum = 0;
    for (int i = 0; i < l->nterm; i++) {
        const struct model_term *t = &l->term[i];
        p->sum += t->factor * q[m->joint[t->joint].iq[t->k]];
    }
}

/* A driven measure; its rate is that of any motion. */
static void check_drive(struct loops *o, const struct sweep *s, int l, const double *q)
{
    static const double at_rest[1];
    const int i = o->model->loop[l].measure;
    if (loops_along_coordinate(o, l))
        o->act[l].s = q[o->model->measure[i].iq];
    else
        measure_at(&o->act[l], &o->measures, s, i, q, at_rest);
}

void loops_place(struct loops *o, const struct sweep *s, const double *q)
{
    const int joints = model_first_drive(o->model);
    for (int l = 0; l < joints; l++) {
        const struct model_loop *loop = &o->model->loop[l];
        if (loop->nterm)
            place_terms(&o->place[l], o->model, loop, q);
        else if (o->model->space == 2)
            place(o, s, l, turn_flat);
        else
            place(o, s, l, m3_mul);
    }
    for (int l = joints; l < o->model->nloop; l++) check_drive(o, s, l, q);
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

static void set_drives(struct loops *o, double t, double share, double beside)
{
    o->t = o->from = o->to = t;
    o->there = share == 1 && beside == 0;
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++) {
        const double *x = motion_of(o, l, t), unit = loops_scale(o, l);
        int row = o->first[l];
        o->c[row] = share == 1 ? unit * x[0] : o->drawn[row] + share * (unit * x[0] - o->drawn[row]);
        o->c[row] += beside;
        o->c1[row] = o->cw[row] = unit * x[1];
        o->c2[row] = unit * x[2];
    }
}

void loops_when(struct loops *o, double t, double beside)
{
    if (o->there && o->t == t && o->from == t && o->to == t && beside == 0) return;
    set_drives(o, t, 1, beside);
}

void loops_where(struct loops *o, double t, double beside)
{
    if (o->there && o->t == t && beside == 0) return;
    set_drives(o, t, 1, beside);
}

void loops_partly(struct loops *o, double t, double share)
{
    set_drives(o, t, share, 0);
}

/* Is the mean rate so far from that of the ends because there is a corner between? */
static bool has_corner(const struct signal *c, const double *a, const double *b, double ta, double tb)
{
    const double mean = (b[0] - a[0]) / (tb - ta), ends = (a[1] + b[1]) / 2;
    return fabs(mean - ends) > 1e-3 * (fabs(mean) + fabs(ends)) && signal_corner(c, ta, tb) != 0;
}

void loops_over(struct loops *o, double ta, double tb)
{
    if (ta == tb || (o->from == ta && o->to == tb)) return;
    o->from = ta, o->to = tb;
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

double loops_fastest(struct loops *o, double t)
{
    double most = 0;
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++)
        most = fmax(most, loops_scale(o, l) * fabs(motion_of(o, l, t)[1]));
    return most;
}

int loops_corners(double *jump, const struct loops *o, double ta, double tb)
{
    int any = 0;
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++) {
        const int row = o->first[l];
        jump[row] = loops_scale(o, l) * signal_corner(o->model->loop[l].drive, ta, tb);
        any |= jump[row] != 0;
    }
    return any;
}

bool loops_are_constant(const struct loops *o)
{
    for (int l = 0; l < o->model->nloop; l++) {
        const struct model_loop *loop = &o->model->loop[l];
        const bool empty = o->first[l] == o->first[l + 1];
        if (!(loop->drive ? loops_along_coordinate(o, l) : loop->nterm || empty)) return false;
    }
    return true;
}

/* The row of loop l that is a screw's; -1: none, or it has no pitch. */
static int screw_row(const struct loops *o, int l)
{
    for (int i = o->first[l]; i < o->first[l + 1]; i++)
        if (o->row[i].says == &equation_helix && o->model->loop[l].number != 0) return i;
    return -1;
}

bool loops_have_screws(const struct loops *o)
{
    for (int l = 0; l < o->model->nloop; l++)
        if (screw_row(o, l) >= 0) return true;
    return false;
}

void loops_count_turns(struct loops *o, enum counting how)
{
    for (int l = 0; l < o->model->nloop; l++) {
        const int i = screw_row(o, l);
        if (i < 0) continue;
        const double stood = how == COUNT_ANEW ? 0 : o->turned[l];
        o->turned[l] = how == COUNT_NEVER ? NAN : angle_near(equations_turn(o, i), stood);
    }
}

double loops_measure(const struct loops *o, int l)
{
    return loops_scale(o, l) * o->act[l].s;
}

double loops_measure_at(const struct loops *o, int l, const double *q)
{
    const struct model_measure *m = &o->model->measure[o->model->loop[l].measure];
    return loops_scale(o, l) * (loops_along_coordinate(o, l) ? q[m->iq] : o->act[l].s);
}

bool loops_drive_coordinates(const struct loops *o)
{
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++)
        if (!loops_along_coordinate(o, l)) return false;
    return true;
}

void loops_values(double *C, const struct loops *o)
{
    for (int i = 0; i < o->nrow; i++) C[i] = o->row[i].says->value(o, i);
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

/* Ways that begin with the same modes: what the second body's way says of them, to [n[1]], goes to the first's. */
APART void join(double *Cq, const struct loop_ways *w, const double *to)
{
    for (int k = 0; k < w->same; k++) Cq[k] += to[k];
    for (int k = w->same; k < w->n[1]; k++) Cq[w->n[0] + k - w->same] = to[k];
}

/* The rows' unit wrenches as what they do on the second body and, the other way, on the first, by the coordinates of
 * their ways. */
static void jacobian(struct loops *o, const struct sweep *s, int l)
{
    const struct loop_ways w = o->ways[l];
    const int first = o->model->loop[l].first, second = o->model->loop[l].second;
    const int from = o->first[l], m = o->first[l + 1] - from, nk = o->nk[l];
    const double *x = o->place[l].x;
    double *Cq = o->Cq[l];
    struct pull on[LOOP_ROWS];
    for (int i = 0; i < m; i++) {
        const struct equation *says = o->row[from + i].says;
        if (!(says->bears & FORCE)) v3_set(on[i].f, 0, 0, 0);
        if (!(says->bears & MOMENT)) v3_set(on[i].n, 0, 0, 0);
        says->wrench(on[i].f, on[i].n, o, from + i);
    }
    if (w.n[0] > 0) o->ops->rows(s, Cq, nk, first, w.from, x, -1, m, on);
    if (w.n[1] > 0 && !w.same) o->ops->rows(s, Cq + w.n[0], nk, second, w.from, x, 1, m, on);
    for (int i = 0; w.same && i < m; i++, Cq += nk) {
        o->ops->row(s, o->grad.g, second, w.from, x, on[i].f, on[i].n);
        join(Cq, &w, o->grad.g);
    }
}

void loops_jacobian(struct loops *o, const struct sweep *s)
{
    const int joints = model_first_drive(o->model);
    for (int l = 0; l < joints; l++)
        if (o->model->loop[l].nterm == 0) jacobian(o, s, l);
    for (int l = joints; l < o->model->nloop; l++) drive_jacobian(o, s, l);
}

/* equations_seen() in the plane. */
static inline void flat_rates(double *xv, double *xa, const struct pose *p, const double *x)
{
    const double b[2] = {x[0] - p->r[0], x[1] - p->r[1]}, w = p->w[2], turned[2] = {-w * b[1], w * b[0]};
    for (int i = 0; i < 2; i++) xv[i] = p->v[i] + turned[i];
    xa[0] = p->a[0] - p->al[2] * b[1] - w * turned[1];
    xa[1] = p->a[1] + p->al[2] * b[0] + w * turned[0];
}

static void seen_flat(double *ab, const struct loop_place *p)
{
    double vb[2], va[2], aa[2];
    flat_rates(vb, ab, &p->B, p->x);
    flat_rates(va, aa, &p->A, p->x);
    const double w = p->A.w[2], u[2] = {vb[0] - va[0], vb[1] - va[1]};
    ab[0] = ab[0] - aa[0] + 2 * w * u[1];
    ab[1] = ab[1] - aa[1] - 2 * w * u[0];
    ab[2] = 0;
}

/* Motion of the bodies of a loop, if its rows ask for it. */
static void place_motion(struct loops *o, const struct sweep *s, int l)
{
    const struct model_loop *loop = &o->model->loop[l];
    struct loop_place *p = &o->place[l];
    if (loop->nterm || (loop->drive && loops_along_coordinate(o, l))) return;
    if (o->first[l] == o->first[l + 1]) return; /* it holds nothing */
    if (loop->drive) {                          /* place() has not been there */
        o->ops->stand(s, &p->A, loop->first);
        o->ops->stand(s, &p->B, loop->second);
    }
    o->ops->stir(s, &p->A, loop->first);
    o->ops->stir(s, &p->B, loop->second);
    if (!(o->row[o->first[l]].says->needs & SEEN_POINT)) return;
    if (o->model->space == 2)
        seen_flat(p->seen, p);
    else
        equations_seen(p->seen, p);
}

void loops_second(double *C2, struct loops *o, const struct sweep *s, const double *a)
{
    for (int l = 0; l < o->model->nloop; l++) place_motion(o, s, l);
    for (int i = 0; i < o->nrow; i++) C2[i] = o->row[i].says->rate2(o, i, a);
}

/* --- forces ------------------------------------------------------------------------------------- */

static void wrench(double *f, double *n, const struct loops *o, int l, const double *lambda)
{
    v3_set(f, 0, 0, 0);
    v3_set(n, 0, 0, 0);
    for (int i = o->first[l]; i < o->first[l + 1] && o->model->loop[l].nterm == 0; i++) {
        const struct equation *says = o->row[i].says;
        double unit[2][3];
        says->wrench(unit[0], unit[1], o, i);
        if (says->bears & FORCE) v3_axpy(f, -lambda[i], unit[0]);
        if (says->bears & MOMENT) v3_axpy(n, -lambda[i], unit[1]);
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
    const int i = o->first[l];
    const struct equation *says = o->row[i].says;
    return says->shown ? says->shown(o, i, -lambda[i]) : 0;
}
