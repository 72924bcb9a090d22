/* loops_build.c -- the equations of each loop joint, tie and drive, and the coordinates they tie. */
#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "system/loops.h"
#include "system/sizes.h"

struct equation {
    enum loop_row_type type;
    int i, j;
};

struct equations {
    int n;
    struct equation e[LOOP_ROWS];
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

#define SPAN                                                                                                           \
    {                                                                                                                  \
        ROW_SPAN, 0, 0                                                                                                 \
    }
#define SUM                                                                                                            \
    {                                                                                                                  \
        ROW_SUM, 0, 0                                                                                                  \
    }

static const struct equations plane[JOINT_TYPES] = {
    [JOINT_FIXED] = {3, {X, Y, TURN}}, [JOINT_REVOLUTE] = {2, {X, Y}},   [JOINT_PRISMATIC] = {2, {X, TURN}},
    [JOINT_DISTANCE] = {1, {SPAN}},    [JOINT_POINT_ON_LINE] = {1, {X}}, [JOINT_GEAR] = {1, {SUM}},
    [JOINT_RACK] = {1, {SUM}}};

static const struct equations room[JOINT_TYPES] = {[JOINT_FIXED] = {6, {X, Y, Z, XY, YZ, ZX}},
                                                   [JOINT_REVOLUTE] = {5, {X, Y, Z, XZ, YZ}},
                                                   [JOINT_PRISMATIC] = {5, {X, Y, XY, YZ, ZX}},
                                                   [JOINT_CYLINDRICAL] = {4, {X, Y, XZ, YZ}},
                                                   [JOINT_UNIVERSAL] = {4, {X, Y, Z, XY}},
                                                   [JOINT_SPHERICAL] = {3, {X, Y, Z}},
                                                   [JOINT_PLANAR] = {3, {Z, XZ, YZ}},
                                                   [JOINT_DISTANCE] = {1, {SPAN}},
                                                   [JOINT_POINT_ON_LINE] = {2, {X, Y}},
                                                   [JOINT_GEAR] = {1, {SUM}},
                                                   [JOINT_RACK] = {1, {SUM}}};

/* The equations of a joint: each freedom it takes away. */
static int equations_of(struct equation *o, enum joint_type type, int space)
{
    int n = space == 2 ? plane[type].n : room[type].n;
    memcpy(o, space == 2 ? plane[type].e : room[type].e, sizeof *o * (size_t)n);
    return n;
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
    o->side[l] = TAKE(life, int, loop->nterm);
    o->Cq[l] = TAKE(life, double, loop->nterm);
    o->scale[l] = size_of(o, loop);
    for (int i = 0; i < loop->nterm; i++) {
        const struct model_term *t = &loop->term[i];
        o->k[l][i] = o->model->joint[t->joint].iv[t->k];
        o->side[l][i] = 1;
        o->Cq[l][i] = t->factor / o->scale[l];
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
    int both = 0; /* the way they have in common, which may be long */
    while (both < na && both < nb && a[both] == b[both]) both++;
    add_path(o, l, a + both, na - both, b + both, nb - both, -1);
    add_path(o, l, b + both, nb - both, a + both, na - both, 1);
    o->Cq[l] = TAKE(life, double, (o->first[l + 1] - o->first[l]) * o->nk[l]);
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
    o->side = TAKE(life, int *, m->nloop);
    o->Cq = TAKE(life, double *, m->nloop);
    o->scale = TAKE(life, double, m->nloop);
    struct sweep *paths = ops->build(m, life);
    for (int l = 0; l < m->nloop; l++) {
        struct equation e[LOOP_ROWS] = {{ROW_DRIVE, 0, 0}};
        int n = m->loop[l].drive ? 1 : equations_of(e, m->loop[l].type, m->space);
        for (int i = 0; i < n; i++) o->row[o->nrow++] = (struct loop_row){l, e[i].type, e[i].i, e[i].j};
        o->first[l + 1] = o->nrow;
        if (m->loop[l].nterm)
            tie_terms(o, l, life);
        else
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
    o->moved = TAKE(life, struct moved, MOVED * m->ndrive);
    for (int i = 0; i < MOVED * m->ndrive; i++) o->moved[i].t = NAN;
    o->share = 1;
    return o;
}
