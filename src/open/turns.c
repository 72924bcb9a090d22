/* turns.c -- see turns.h */
#include "open/turns.h"

#include <math.h>
#include <string.h>

#include "tree/sizes.h"

static const double SHORT = 1, PIECE = .5, FAR = 2.5; /* [rad] */
enum { MOST_PIECES = 100000 };

static void find_turning(struct turns *o, const struct model *m, struct arena *life)
{
    int n = 0;
    o->first = TAKE(life, int, m->nbody + 1);
    o->turning = TAKE(life, int, m->n);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &m->joint[m->body[i].joint];
        for (int k = 0; k < j->nv; k++)
            if (!sizes_is_length(m, j, k)) o->turning[n++] = j->iv[k];
        o->first[i + 1] = n;
    }
}

void turns_build(struct turns *o, const struct model *m, const struct moves *moves, struct arena *life)
{
    *o = (struct turns){.model = m, .moves = moves, .t = m->t0};
    if (m->space == 2) return; /* there postures know them */
    o->q = TAKE(life, double, m->nq);
    o->at = TAKE(life, double, m->nq);
    o->dx = TAKE(life, double, m->n);
    o->body = TAKE(life, double, m->nbody);
    find_turning(o, m, life);
}

void turns_begin(struct turns *o, const double *q, double t)
{
    if (!o->q) return;
    memcpy(o->q, q, sizeof *q * (size_t)o->model->nq);
    o->t = t;
    o->begun = true;
}

/* Has a ball turned so far that it may have been the other way round? */
static bool ambiguous(const struct turns *o, const double *v, double t)
{
    for (int i = 0; i < o->moves->nturn; i++) {
        const int *iv = o->moves->turn[i].iv;
        if ((t - o->t) * sqrt(v[iv[0]] * v[iv[0]] + v[iv[1]] * v[iv[1]] + v[iv[2]] * v[iv[2]]) > FAR) return true;
    }
    return false;
}

/* Can no angle have turned far, as twice all joints together have not: what the world sees counts some for both bodies? */
static bool all_short(const struct turns *o)
{
    double sum = 0;
    for (int k = 0; k < o->first[o->model->nbody]; k++) sum += fabs(o->dx[o->turning[k]]);
    return 2 * sum < .99 * SHORT;
}

static void turn_bodies(struct turns *o)
{
    for (int i = 1; i < o->model->nbody; i++) {
        o->body[i] = 0;
        for (int k = o->first[i]; k < o->first[i + 1]; k++) o->body[i] += fabs(o->dx[o->turning[k]]);
    }
}

/* The most that body b turns against a: by all joints between. */
static double turned_between(const struct turns *o, int a, int b)
{
    double sum = 0;
    while (a != b) {
        int *farther = a > b ? &a : &b;
        sum += o->body[*farther];
        *farther = o->model->body[*farther].parent;
    }
    return sum;
}

/* The most that an angle changes; what the world sees of two bodies is turned by either. */
static double turned(const struct turns *o, const struct model_measure *m)
{
    if (!m->in_world) return turned_between(o, m->a.body, m->b.body);
    return turned_between(o, 0, m->a.body) + turned_between(o, 0, m->b.body);
}

int turns_pieces(struct turns *o, const double *q, const double *v, double t, bool loops)
{
    const struct model *m = o->model;
    double most = 0;
    if (!o->q || !o->begun || ambiguous(o, v, t)) return 1;
    moves_diff(o->moves, o->dx, q, o->q);
    if (all_short(o)) return 1;
    turn_bodies(o);
    for (int i = 0; i < m->nmeasure; i++)
        if (m->measure[i].type == MEASURE_ANGLE) most = fmax(most, turned(o, &m->measure[i]));
    for (int i = 0; loops && i < m->nloop; i++)
        most = fmax(most, turned_between(o, m->loop[i].first, m->loop[i].second));
    return !(most > SHORT) ? 1 : (int)fmin(MOST_PIECES, 1 + ceil(most / PIECE));
}

void turns_go(struct turns *o, const struct sweep_ops *ops, struct sweep *s, int pieces, turns_told *told, void *self)
{
    if (pieces <= 1) return;
    for (int k = 0; k <= pieces; k++) {
        moves_point(o->moves, o->at, o->q, o->dx, (double)k / pieces);
        ops->move(s, o->at, o->dx, ALL); /* all of it in one second */
        told(self, s, k ? 1. / pieces : 0);
    }
}

void turns_recall(struct turns *o, struct recall *r)
{
    if (!o->q) return;
    recall_within(r, "counted");
    recall_one(r, "begun", o->begun);
    recall_list(r, "q", o->q, o->model->nq);
    recall_one(r, "t", o->t);
    recall_without(r);
}
