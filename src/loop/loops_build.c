/* loops_build.c -- the rows of each loop joint, tie and drive, and the coordinates they tie. */
#include <math.h>

#include "loop/equations.h"
#include "tree/sizes.h"

/* The largest term for coordinates of usual size, 1 rad or a length of the mechanism. */
static double size_of(const struct loops *o, const struct model_loop *loop)
{
    double most = 0;
    for (int i = 0; i < loop->nterm; i++)
        most = fmax(most, fabs(loop->term[i].factor) * (loop->term[i].angular ? 1 : o->length));
    return most;
}

/* The row of a sum, for good. */
static void tie_terms(struct loops *o, int l, struct arena *life)
{
    const struct model_loop *loop = &o->model->loop[l];
    o->nk[l] = loop->nterm;
    o->k[l] = TAKE(life, int, loop->nterm);
    o->Cq[l] = TAKE(life, double, loop->nterm);
    o->scale[l] = size_of(o, loop);
    for (int i = 0; i < loop->nterm; i++) {
        const struct model_term *t = &loop->term[i];
        o->k[l][i] = o->model->joint[t->joint].iv[t->k];
        o->Cq[l][i] = t->factor / o->scale[l];
    }
}

/* The body where the ways from the ground to a and b part. */
static int parting(const struct model *m, int a, int b)
{
    while (a != b) {
        if (a > b)
            a = m->body[a].parent;
        else
            b = m->body[b].parent;
    }
    return a;
}

static void tie(struct loops *o, int l, const struct sweep *s, struct arena *life)
{
    const struct model_loop *loop = &o->model->loop[l];
    const int bodies[2] = {loop->first, loop->second};
    struct loop_ways *w = &o->ways[l];
    const int *k[2];
    int same = 0;
    w->from = o->ops->path(s, &k[0], parting(o->model, bodies[0], bodies[1]));
    for (int i = 0; i < 2; i++) {
        w->n[i] = o->ops->path(s, &k[i], bodies[i]) - w->from;
        k[i] += w->from;
    }
    while (same < w->n[0] && same < w->n[1] && k[0][same] == k[1][same]) same++;
    const int n = o->nk[l] = w->n[0] + w->n[1] - same;
    o->k[l] = TAKE(life, int, n);
    for (int i = 0; i < w->n[0]; i++) o->k[l][i] = k[0][i];
    for (int i = same; i < w->n[1]; i++) o->k[l][w->n[0] + i - same] = k[1][i];
    w->same = same;
    o->Cq[l] = TAKE(life, double, (o->first[l + 1] - o->first[l]) * n);
}

static void tie_coordinate(struct loops *o, int l, struct arena *life)
{
    o->k[l] = TAKE(life, int, 1);
    o->k[l][o->nk[l]++] = o->model->measure[o->model->loop[l].measure].iv;
    o->Cq[l] = TAKE(life, double, 1);
}

struct loops *loops_build(const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    struct loops *o = TAKE(life, struct loops, 1);
    o->model = m;
    o->ops = ops;
    o->length = sizes_length(m);
    o->row = TAKE(life, struct loop_row, LOOP_ROWS * m->nloop);
    o->first = TAKE(life, int, m->nloop + 1);
    o->place = TAKE(life, struct loop_place, m->nloop);
    o->nk = TAKE(life, int, m->nloop);
    o->k = TAKE(life, int *, m->nloop);
    o->ways = TAKE(life, struct loop_ways, m->nloop);
    o->Cq = TAKE(life, double *, m->nloop);
    o->scale = TAKE(life, double, m->nloop);
    o->turned = TAKE(life, double, m->nloop);
    for (int l = 0; l < m->nloop; l++) o->turned[l] = NAN;
    for (int l = 0; l < m->nloop; l++) o->place[l].A.R[8] = o->place[l].B.R[8] = 1;
    struct sweep *paths = ops->build(m, FOR_RECORDS, NULL, life);
    for (int l = 0; l < m->nloop; l++) {
        o->first[l + 1] = o->nrow += equations_of(o->row + o->nrow, m, l);
        if (m->loop[l].nterm)
            tie_terms(o, l, life);
        else if (m->loop[l].drive && loops_along_coordinate(o, l))
            tie_coordinate(o, l, life);
        else
            tie(o, l, paths, life);
    }
    measures_build(&o->measures, m, ops, life);
    o->axes = TAKE(life, struct loop_axes, o->nrow);
    o->grad = row_make(m->n, life);
    o->act = TAKE(life, struct action, m->nloop);
    o->c = TAKE(life, double, o->nrow);
    o->c1 = TAKE(life, double, o->nrow);
    o->c2 = TAKE(life, double, o->nrow);
    o->cw = TAKE(life, double, o->nrow);
    o->drawn = TAKE(life, double, o->nrow);
    o->moved = TAKE(life, struct moved, MOVED * m->ndrive);
    for (int i = 0; i < MOVED * m->ndrive; i++) o->moved[i].t = NAN;
    return o;
}
