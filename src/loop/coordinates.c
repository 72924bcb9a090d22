/* coordinates.c -- see coordinates.h */
#include "loop/coordinates.h"

#include <math.h>

#include "la/rot.h"
#include "la/vec3.h"

/* ---- one joint ---- */

struct meeting {
    const struct pose *first, *second;
    double A[9], B[9];       /* joint axes that the first and the second body carry, world, by column */
    double d[3], u[3], s[3]; /* of the second's point as the first sees it, world axes */
    double W[3], W1[3];      /* w and al of the second less those of the first */
};

/* The place x of the point p on a body, its velocity and acceleration. */
static void point_of(double *x, double *v, double *a, const struct pose *b, const double *arm)
{
    double turned[3];
    v3_cross(turned, b->w, arm);
    v3_sum(x, b->r, arm);
    v3_sum(v, b->v, turned);
    v3_copy(a, b->a);
    v3_cross_add(a, b->al, arm);
    v3_cross_add(a, b->w, turned);
}

static void meet(struct meeting *o, const struct model_loop *l, const struct pose *first, const struct pose *second)
{
    double arm[3], x[3], v[3], a[3], xa[3], va[3], aa[3];
    o->first = first;
    o->second = second;
    m3_mulm(o->A, first->R, l->Ea);
    m3_mulm(o->B, second->R, l->Eb);
    m3_mul(arm, second->R, l->b);
    point_of(x, v, a, second, arm);
    v3_diff(arm, x, first->r); /* the first body as far as there */
    point_of(xa, va, aa, first, arm);
    v3_diff(o->u, v, va);
    v3_diff(o->s, a, aa);
    v3_cross(arm, first->w, o->u);
    v3_axpy(o->s, -2, arm);
    m3_mul(arm, first->R, l->a);
    v3_sum(xa, first->r, arm);
    v3_diff(o->d, x, xa);
    v3_diff(o->W, second->w, first->w);
    v3_diff(o->W1, second->al, first->al);
}

/* From e turned about n by an angle to g, all at right angles to n. */
static double turned_by(const double *n, const double *e, const double *g)
{
    double across[3];
    v3_cross(across, n, e);
    return atan2(v3_dot(g, across), v3_dot(g, e));
}

/* The angle of the freedom f in space, of the kind's turns from number `first` on. */
static double angle(const struct meeting *o, const struct joint_kind *kind, const struct freedom *f, int first)
{
    const int i = kind->freedom[first].axis, j = kind->freedom[first + 1].axis, beside = (f->axis + 1) % 3;
    if (!kind->freedom[first + 1].turns) return turned_by(o->A + 3 * i, o->A + 3 * beside, o->B + 3 * beside);
    if (!f->second) return turned_by(o->A + 3 * i, o->A + 3 * j, o->B + 3 * j);
    return -turned_by(o->B + 3 * j, o->B + 3 * i, o->A + 3 * i);
}

static double position(const struct meeting *o, const struct joint_kind *kind, int k, bool plane)
{
    const struct freedom *f = &kind->freedom[k];
    int first;
    if (joint_turning(kind, &first) == TURNS_FREELY && k >= first) {
        double turn[9], q[4];
        m3_tmulm(turn, o->A, o->B);
        quat_of_matrix(q, turn);
        return q[k - first];
    }
    if (!f->turns) return v3_dot(o->A + 3 * f->axis, o->d);
    if (plane) return o->A[3 * f->axis + 2] * (o->second->angle - o->first->angle);
    return angle(o, kind, f, first);
}

static double rate(const struct meeting *o, const struct freedom *f)
{
    const double *e = (f->second ? o->B : o->A) + 3 * f->axis;
    return v3_dot(e, f->turns ? o->W : o->u);
}

static double acceleration(const struct meeting *o, const struct freedom *f)
{
    const double *e = (f->second ? o->B : o->A) + 3 * f->axis;
    double e1[3];
    if (!f->turns) return v3_dot(e, o->s);
    v3_cross(e1, f->second ? o->second->w : o->first->w, e);
    return v3_dot(e, o->W1) + v3_dot(e1, o->W);
}

double loop_coordinate(const struct model *m, int loop, int order, int k, const struct pose *first,
                       const struct pose *second)
{
    const struct joint_kind *kind = model_kind(m, m->loop[loop].type);
    struct meeting o;
    meet(&o, &m->loop[loop], first, second);
    if (order == 0) return position(&o, kind, k, m->space == 2);
    return order == 1 ? rate(&o, &kind->freedom[k]) : acceleration(&o, &kind->freedom[k]);
}

/* ---- whole turns ---- */

struct winding {
    int loop, k;
    double stood, went;  /* at the end of the last step [rad], [rad/s]; went NAN: not known yet */
    double seen, passed; /* in the view likewise */
};

struct windings {
    const struct model *model;
    const struct sweep_ops *ops;
    int n;
    struct winding *winding;  /* [n] */
    int *number;              /* [nloop x JOINT_MAX_V] of these, by loop */
    const struct sweep *view; /* NULL: there is none */
};

bool loop_winds(const struct model *m, int loop, int k)
{
    const struct model_loop *l = &m->loop[loop];
    int first;
    if (m->space == 2 || l->drive) return false;
    const struct joint_kind *kind = model_kind(m, l->type);
    const enum joint_turning turning = joint_turning(kind, &first);
    return !joint_is_tie(kind) && k < joint_size(kind, 1) && turning != TURNS_FREELY && kind->freedom[k].turns;
}

struct windings *windings_build(const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    struct windings *o = TAKE(life, struct windings, 1);
    const int most = m->nloop * JOINT_MAX_V;
    *o = (struct windings){m, ops, 0, TAKE(life, struct winding, most), TAKE(life, int, most), NULL};
    for (int i = 0; i < most; i++) {
        if (!loop_winds(m, i / JOINT_MAX_V, i % JOINT_MAX_V)) continue;
        o->number[i] = o->n;
        o->winding[o->n++] = (struct winding){i / JOINT_MAX_V, i % JOINT_MAX_V, 0, NAN, 0, NAN};
    }
    return o;
}

static struct winding *find(const struct windings *o, int loop, int k)
{
    return &o->winding[o->number[loop * JOINT_MAX_V + k]];
}

void windings_start(struct windings *o, const struct sweep *s)
{
    for (struct winding *w = o->winding; w < o->winding + o->n; w++) {
        const struct model_loop *l = &o->model->loop[w->loop];
        const struct freedom *f = &model_kind(o->model, l->type)->freedom[w->k];
        const double along = joint_along(f, l->number);
        struct pose first, second;
        struct meeting at;
        if (along == 0) continue;
        o->ops->pose(s, &first, l->first);
        o->ops->pose(s, &second, l->second);
        meet(&at, l, &first, &second);
        w->stood = v3_dot(at.A + 3 * f->axis, at.d) / along;
    }
}

void windings_note(void *windings, const struct sweep *s, double dt)
{
    struct windings *o = windings;
    for (int i = 0; i < o->n; i++) {
        struct winding *w = &o->winding[i];
        double *stood = s == o->view ? &w->seen : &w->stood, *went = s == o->view ? &w->passed : &w->went;
        const struct model_loop *l = &o->model->loop[w->loop];
        struct pose first, second;
        o->ops->pose(s, &first, l->first);
        o->ops->pose(s, &second, l->second);
        const double now = loop_coordinate(o->model, w->loop, 1, w->k, &first, &second);
        const double before = isnan(*went) ? now : *went, x = *stood + dt * (before + now) / 2;
        const double angle = angle_near(loop_coordinate(o->model, w->loop, 0, w->k, &first, &second), x);
        if (!isfinite(angle)) continue;
        *stood = angle;
        *went = now;
    }
}

void windings_look(void *windings, const struct sweep *view)
{
    struct windings *o = windings;
    o->view = view;
    for (struct winding *w = o->winding; w < o->winding + o->n; w++) {
        w->seen = w->stood;
        w->passed = w->went;
    }
}

double windings_angle(const struct windings *o, int loop, int k, double x)
{
    return angle_near(x, find(o, loop, k)->seen);
}

void windings_set(struct windings *o, int loop, int k, double x)
{
    find(o, loop, k)->stood = x;
}

void windings_recall(struct windings *o, struct recall *r)
{
    recall_within(r, "windings");
    recall_each(r, "stood", o->winding, stood, o->n);
    recall_each(r, "went", o->winding, went, o->n);
    recall_without(r);
}
