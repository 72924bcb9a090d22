/* equations.c -- the kinds of equations: values, second derivatives, forces; and which ones a joint, tie or drive has.
 *
 * With d the vector from the first body's point to the second's, e axes of the first (A), g of the second (B),
 * wr = w_B - w_A, and u = d' - w_A x d the velocity of B's point as A sees it:
 *
 *     along  C = e.d        C' = e.u            C'' = e.(d'' - al_A x d - w_A x (w_A x d) - 2 w_A x u)
 *     helix  C = e.d - p theta                  C'' as along - p theta'',   theta about e, of an axis of B seen
 *            along two of A; where the rows beside it hold theta'' = (al_B - al_A).e
 *     lean   C = e.g        C' = wr.(g x e)     C'' = e''.g + 2 e'.g' + e.g'',   e'' = al x e + w x (w x e)
 *     turn   C = phi_B - phi_A                  C'' = al_B - al_A
 *     span   C = |d| - L      C' = n.d'         C'' = n.d'' + (d'.d' - (n.d')^2)/|d|,   n = d/|d|
 *     sum    C = sum f_i q_i                    C'' = sum f_i a_i
 *     drive  C = s(q) - c(t), s a coordinate, a distance or displacement, in the plane an angle:
 *            C'' as above, less c''
 *
 * A row of C_q is C' per unit velocity of each coordinate.  Its multiplier lambda does the work -lambda C':
 * for along a force -lambda e on B at its point and the opposite on A, for span along n, for lean a pair of torques.
 * A sum's is the generalized force -lambda f_i on each of its coordinates, which is a matter of their joints: these
 * bear nothing of it. */
#include "loop/equations.h"

#include <math.h>

#include "la/rot.h"

/* ---- motion of points and axes ---- */

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

/* The second's point as the first body sees it: C'' of a row along e is e.a. */
void equations_seen(double *ab, const struct loop_place *p)
{
    double b[3], vb[3], va[3], aa[3], u[3], coriolis[3];
    v3_diff(b, p->x, p->B.r);
    point_rates(vb, ab, &p->B, b);
    v3_diff(b, p->x, p->A.r); /* A's motion where B's point is: w_A x d and its kin are in it */
    point_rates(va, aa, &p->A, b);
    v3_diff(u, vb, va);
    v3_cross(coriolis, p->A.w, u);
    v3_take(ab, aa);
    v3_axpy(ab, -2, coriolis);
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
    loops_normal(n, d);
    const double rate = v3_dot(n, vb);
    return v3_dot(n, ab) + (v3_dot(vb, vb) - rate * rate) / v3_norm(d);
}

static const struct loop_place *place_of(const struct loops *o, int i)
{
    return &o->place[o->row[i].loop];
}

static const struct model_loop *loop_of(const struct loops *o, int i)
{
    return &o->model->loop[o->row[i].loop];
}

/* ---- along: the second's point has not moved along axis i of the first ---- */

static double along_value(const struct loops *o, int i)
{
    return v3_dot(o->axes[i].e, place_of(o, i)->d) / o->length;
}

static double along_rate2(const struct loops *o, int i, const double *a)
{
    (void)a;
    return v3_dot(o->axes[i].e, place_of(o, i)->seen) / o->length;
}

static void along_wrench(double *f, double *n, const struct loops *o, int i)
{
    (void)n;
    v3_scale(f, 1 / o->length, o->axes[i].e);
}

static const struct equation along = {FIRST | SEEN_POINT, FORCE, along_value, along_rate2, along_wrench, NULL};

/* ---- helix: it has moved along axis i as the second has turned about it; by whole pitches more, as a thread lets it,
 * unless turns are counted.  Axis j is another one. ---- */

static double pitch(const struct loops *o, int i) /* p [m/rad] */
{
    const struct model_loop *l = loop_of(o, i);
    return joint_along(joint_slide(model_kind(o->model, l->type), o->row[i].i), l->number);
}

/* Axes j and e x j of the first, x and y, and axis j of the second along them. */
static void look_along(double *x, double *y, double *along_x, double *along_y, const struct loops *o, int i)
{
    m3_mul(x, place_of(o, i)->A.R, loop_of(o, i)->Ea + 3 * o->row[i].j);
    v3_cross(y, o->axes[i].e, x);
    *along_x = v3_dot(x, o->axes[i].g);
    *along_y = v3_dot(y, o->axes[i].g);
}

double equations_turn(const struct loops *o, int i)
{
    double x[3], y[3], along_x, along_y;
    look_along(x, y, &along_x, &along_y, o, i);
    return atan2(along_y, along_x);
}

static double helix_value(const struct loops *o, int i)
{
    const double d = v3_dot(o->axes[i].e, place_of(o, i)->d), turn = equations_turn(o, i);
    const double lead = loop_of(o, i)->number, stood = o->turned[o->row[i].loop];
    if (!isnan(stood)) return (d - pitch(o, i) * angle_near(turn, stood)) / o->length;
    const double ahead = d - pitch(o, i) * turn;
    return (lead == 0 ? ahead : remainder(ahead, lead)) / o->length;
}

/* Of e.g, e on the first body, g on the second. */
static double first_lean(const struct loop_place *p, const double *e, const double *g)
{
    double w[3], across[3];
    v3_diff(w, p->B.w, p->A.w);
    v3_cross(across, g, e);
    return v3_dot(w, across);
}

/* With u, w the second's axis g along x, y, and s = u^2 + w^2: s theta' = u w' - w u',
 * s theta'' = u w'' - w u'' - 2 theta' (u u' + w w'). */
static double second_turn(const struct loops *o, int i)
{
    const struct loop_place *p = place_of(o, i);
    const double *g = o->axes[i].g;
    double x[3], y[3], u, w;
    look_along(x, y, &u, &w, o, i);
    const double s = u * u + w * w, u1 = first_lean(p, x, g), w1 = first_lean(p, y, g), rate = (u * w1 - w * u1) / s;
    return (u * second_lean(p, y, g) - w * second_lean(p, x, g) - 2 * rate * (u * u1 + w * w1)) / s;
}

static double helix_rate2(const struct loops *o, int i, const double *a)
{
    return along_rate2(o, i, a) - pitch(o, i) * second_turn(o, i) / o->length;
}

/* u w' - w u' = wr.(g x (u y - w x)). */
static void helix_wrench(double *f, double *n, const struct loops *o, int i)
{
    double x[3], y[3], u, w;
    look_along(x, y, &u, &w, o, i);
    v3_scale(f, 1 / o->length, o->axes[i].e);
    v3_scale(y, u, y);
    v3_axpy(y, -w, x);
    v3_cross(n, o->axes[i].g, y);
    v3_scale(n, -pitch(o, i) / (o->length * (u * u + w * w)), n);
}

const struct equation equation_helix = {
    FIRST | SECOND | SEEN_POINT, FORCE | MOMENT, helix_value, helix_rate2, helix_wrench, NULL};

/* ---- lean: axis i of the first and axis j of the second stay at right angles ---- */

static double lean_value(const struct loops *o, int i)
{
    return v3_dot(o->axes[i].e, o->axes[i].g);
}

static double lean_rate2(const struct loops *o, int i, const double *a)
{
    (void)a;
    return second_lean(place_of(o, i), o->axes[i].e, o->axes[i].g);
}

static void lean_wrench(double *f, double *n, const struct loops *o, int i)
{
    (void)f;
    v3_cross(n, o->axes[i].g, o->axes[i].e);
}

static const struct equation lean = {FIRST | SECOND, MOMENT, lean_value, lean_rate2, lean_wrench, NULL};

/* ---- turn: in the plane both bodies have turned alike ---- */

static double turn_value(const struct loops *o, int i)
{
    return place_of(o, i)->B.angle - place_of(o, i)->A.angle;
}

static double turn_rate2(const struct loops *o, int i, const double *a)
{
    (void)a;
    return place_of(o, i)->B.al[2] - place_of(o, i)->A.al[2];
}

static void turn_wrench(double *f, double *n, const struct loops *o, int i)
{
    (void)f, (void)o, (void)i;
    v3_set(n, 0, 0, 1);
}

static const struct equation turn = {0, MOMENT, turn_value, turn_rate2, turn_wrench, NULL};

/* ---- span: the second's point keeps its distance from the first's ---- */

static double span_value(const struct loops *o, int i)
{
    return (v3_norm(place_of(o, i)->d) - loop_of(o, i)->number) / o->length;
}

static double span_rate2(const struct loops *o, int i, const double *a)
{
    const struct loop_place *p = place_of(o, i);
    double from[3];
    (void)a;
    v3_diff(from, p->x, p->d);
    return second_distance(p, from, p->x) / o->length;
}

static void span_wrench(double *f, double *n, const struct loops *o, int i)
{
    (void)n;
    loops_normal(f, place_of(o, i)->d);
    v3_scale(f, 1 / o->length, f);
}

static double span_shown(const struct loops *o, int i, double x)
{
    (void)i;
    return x / o->length;
}

static const struct equation span = {0, FORCE, span_value, span_rate2, span_wrench, span_shown};

/* ---- sum: coordinates times factors sum to 0 ---- */

static double sum_value(const struct loops *o, int i)
{
    return place_of(o, i)->sum / o->scale[o->row[i].loop];
}

static double sum_rate2(const struct loops *o, int i, const double *a)
{
    const struct model_loop *l = loop_of(o, i);
    double sum = 0;
    for (int k = 0; k < l->nterm; k++) sum += l->term[k].factor * a[o->model->joint[l->term[k].joint].iv[l->term[k].k]];
    return sum / o->scale[o->row[i].loop];
}

static double sum_shown(const struct loops *o, int i, double x)
{
    const struct model_loop *l = loop_of(o, i);
    return x * l->term[l->nterm - 1].factor / o->scale[o->row[i].loop];
}

static const struct equation sum = {0, 0, sum_value, sum_rate2, NULL, sum_shown};

/* ---- drive: a measure stands where its drive has it, s(q) = c(t) ---- */

static double drive_value(const struct loops *o, int i)
{
    const int l = o->row[i].loop;
    return loops_measure(o, l) - o->c[i];
}

static double second_measure(const struct loops *o, int l, const double *a)
{
    const struct model_measure *m = &o->model->measure[o->model->loop[l].measure];
    const struct action *act = &o->act[l];
    struct loop_place *p = &o->place[l];
    double seen[3];
    switch (m->type) {
    case MEASURE_COORDINATE:
        return a[m->iv];
    case MEASURE_DISTANCE:
        return second_distance(p, act->at_a, act->at_b);
    case MEASURE_DISPLACEMENT:
        v3_copy(p->x, act->at_b);
        equations_seen(seen, p);
        return v3_dot(act->dir, seen);
    case MEASURE_ANGLE:
        break;
    }
    return act->dir[2] * (p->B.al[2] - p->A.al[2]);
}

static double drive_rate2(const struct loops *o, int i, const double *a)
{
    const int l = o->row[i].loop;
    return loops_scale(o, l) * second_measure(o, l, a) - o->c2[i];
}

static const struct equation drive = {0, 0, drive_value, drive_rate2, NULL, NULL};

/* ---- which there are ---- */

struct list {
    struct loop_row *row;
    int loop, n;
};

static void add(struct list *o, const struct equation *says, int i, int j)
{
    o->row[o->n++] = (struct loop_row){o->loop, says, i, j};
}

/* In the plane y stands out of it where a joint slides along z, else z. */
static bool is_in_plane(const struct joint_kind *kind, int axis)
{
    return axis != (joint_slide(kind, 2) ? 1 : 2);
}

/* Turns in space: right angles between axes of both bodies that stay so. */
static void hold_axes(struct list *o, const struct joint_kind *kind)
{
    int first;
    const enum joint_turning turning = joint_turning(kind, &first);
    const int axis = kind->freedom[first].axis;
    switch (turning) {
    case TURNS_NEVER:
        for (int i = 0; i < 3; i++) add(o, &lean, i, (i + 1) % 3);
        break;
    case TURNS_ABOUT_ONE:
        for (int i = 0; i < 3; i++)
            if (i != axis) add(o, &lean, i, axis);
        break;
    case TURNS_CROSSED:
        add(o, &lean, axis, kind->freedom[first + 1].axis);
        break;
    case TURNS_FREELY:
        break;
    }
}

/* What the freedoms leave. */
static void hold_bodies(struct list *o, const struct joint_kind *kind, int space)
{
    for (int i = 0; i < 3; i++) {
        const struct freedom *f = joint_slide(kind, i);
        if (space == 2 && !is_in_plane(kind, i)) continue;
        if (!f) add(o, &along, i, 0);
        if (f && f->turns) add(o, &equation_helix, i, (i + 1) % 3);
    }
    if (space == 3)
        hold_axes(o, kind);
    else if (joint_turning(kind, NULL) == TURNS_NEVER)
        add(o, &turn, 0, 0);
}

int equations_of(struct loop_row *row, const struct model *m, int loop)
{
    struct list o = {row, loop, 0};
    const struct joint_kind *kind = model_kind(m, m->loop[loop].type);
    if (m->loop[loop].drive) {
        add(&o, &drive, 0, 0);
        return o.n;
    }
    switch (kind->tie) {
    case NO_TIE:
    case TIE_BODIES:
        hold_bodies(&o, kind, m->space);
        break;
    case TIE_POINTS:
        add(&o, &span, 0, 0);
        break;
    case TIE_COORDINATES:
        add(&o, &sum, 0, 0);
        break;
    }
    return o.n;
}
