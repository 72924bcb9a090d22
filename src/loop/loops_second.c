/* loops_second.c -- second derivatives of the rows of loops.c in time */
#include "loop/loops_parts.h"

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
static void seen_acceleration(double *ab, const struct loop_place *p)
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
    double seen[3];
    switch (m->type) {
    case MEASURE_COORDINATE:
        return a[m->iv];
    case MEASURE_DISTANCE:
        return second_distance(p, act->at_a, act->at_b);
    case MEASURE_DISPLACEMENT:
        v3_copy(p->x, act->at_b);
        seen_acceleration(seen, p);
        return v3_dot(act->dir, seen);
    case MEASURE_ANGLE:
        break;
    }
    return act->dir[2] * (p->B.al[2] - p->A.al[2]);
}

/* Motion of the bodies of a loop, if its rows ask for it. */
static void look_at_motion(struct loops *o, const struct sweep *s, int l)
{
    const struct model_loop *loop = &o->model->loop[l];
    if (loop->nterm || (loop->drive && loops_along_coordinate(o, l))) return;
    o->ops->pose(s, &o->place[l].A, loop->first);
    o->ops->pose(s, &o->place[l].B, loop->second);
    if (o->row[o->first[l]].type == ROW_ALONG) seen_acceleration(o->place[l].seen, &o->place[l]);
}

void loops_second(double *C2, struct loops *o, const struct sweep *s, const double *a)
{
    for (int l = 0; l < o->model->nloop; l++) look_at_motion(o, s, l);
    for (int i = 0; i < o->nrow; i++) {
        const struct loop_row *r = &o->row[i];
        const struct loop_place *p = &o->place[r->loop];
        switch (r->type) {
        case ROW_ALONG:
            C2[i] = v3_dot(o->axes[i].e, p->seen) / o->length;
            break;
        case ROW_LEAN:
            C2[i] = second_lean(p, o->axes[i].e, o->axes[i].g);
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
            C2[i] = loops_scale(o, r->loop) * second_measure(o, r->loop, a) - o->c2[i];
            break;
        }
    }
}
