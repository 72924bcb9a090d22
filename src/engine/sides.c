/* sides.c -- see sides.h */
#include "engine/sides.h"

#include <assert.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "engine/passing.h"
#include "engine/path.h"

enum { MOST = 4 * PASSING_PARTS }; /* places of a step that are looked at */

struct place {
    double x;             /* the part of the step */
    double *side, *force; /* [nside] */
};

struct sides {
    const struct ode2 *ode;
    struct path way;
    struct state from, to;
    double *dv;    /* [n] change of velocities */
    double *q, *v; /* [nq], [n] of a place between */
    int n;
    struct place at[MOST];      /* [n] ascending */
    struct place look;          /* one more */
    struct place before, stood; /* of sides_parted(): the start, the end */
    double t_stood;             /* its time */
    int ahead, skipped;         /* steps that no value can come to 0 in; those that were not looked at */
};

static void take_place(struct place *o, int n, struct arena *life)
{
    o->side = TAKE(life, double, n);
    o->force = TAKE(life, double, n);
}

struct sides *sides_open(const struct ode2 *ode, struct arena *life)
{
    if (ode->nside == 0) return NULL;
    struct sides *o = TAKE(life, struct sides, 1);
    o->ode = ode;
    path_open(&o->way, ode, life);
    o->q = TAKE(life, double, ode->nq);
    o->v = TAKE(life, double, ode->n);
    o->dv = TAKE(life, double, ode->n);
    take_place(&o->look, ode->nside, life);
    take_place(&o->before, ode->nside, life);
    take_place(&o->stood, ode->nside, life);
    o->t_stood = NAN;
    for (int k = 0; k < MOST; k++) take_place(&o->at[k], ode->nside, life);
    return o;
}

/* Velocities by Hermite's cubic, too. */
static void place_at(struct sides *o, double x)
{
    path_place(&o->way, o->q, x);
    motion_cubic(o->v, o->dv, o->from.a, o->to.a, o->ode->n, o->to.t - o->from.t, x);
    for (int i = 0; i < o->ode->n; i++) o->v[i] += o->from.v[i];
}

static void look_at(struct sides *o, struct place *p, double x)
{
    const struct state *end = x <= 0 ? &o->from : &o->to;
    const bool inside = x > 0 && x < 1;
    if (inside) place_at(o, x);
    const struct instant i = {
        .t = inside ? path_time(&o->way, x) : end->t, .q = inside ? o->q : end->q, .v = inside ? o->v : end->v};
    p->x = x;
    o->ode->sides(o->ode, p->side, p->force, &i);
}

static void add(struct sides *o, double x)
{
    struct place p = o->at[o->n];
    int k = o->n++;
    look_at(o, &p, x);
    for (; k > 0 && o->at[k - 1].x > x; k--) o->at[k] = o->at[k - 1];
    o->at[k] = p;
}

static bool parted(double a, double b)
{
    return (a < 0 && b > 0) || (a > 0 && b < 0);
}

/* Is value i farther from 0 than it goes up and down? */
static bool is_clear(const struct sides *o, int i)
{
    double lo = INFINITY, hi = -INFINITY;
    int known = 0;
    for (int k = 0; k < o->n; k++) {
        const double g = o->at[k].side[i];
        if (g != g) continue;
        lo = smaller(lo, g);
        hi = larger(hi, g);
        known++;
    }
    return known == 0 || (known == o->n && larger(lo, -hi) > hi - lo);
}

static bool all_clear(const struct sides *o)
{
    for (int i = 0; i < o->ode->nside; i++)
        if (!is_clear(o, i)) return false;
    return true;
}

/* The least |value i| that a parabola through places k - 1, k, k + 1 foretells, all of one sign, where that is near 0
 * or beyond: its place; NAN: none. */
static double dip(const struct sides *o, int i, int k)
{
    static const double NEAR = .25;
    const struct place *a = &o->at[k - 1], *b = &o->at[k], *c = &o->at[k + 1];
    const double sign = copysign(1, b->side[i]), ga = sign * a->side[i], gb = sign * b->side[i], gc = sign * c->side[i];
    if (!(ga > 0 && gb > 0 && gc > 0)) return NAN;
    const double first = (gb - ga) / (b->x - a->x), second = (gc - gb) / (c->x - b->x);
    const double bend = (second - first) / (c->x - a->x);
    const double x = (a->x + b->x - first / bend) / 2;
    if (!(bend > 0 && x > a->x && x < c->x)) return NAN;
    const double least = ga + (x - a->x) * (first + bend * (x - b->x));
    return least < NEAR * smaller(ga, smaller(gb, gc)) ? x : NAN;
}

static void add_dips(struct sides *o)
{
    double at[MOST];
    int n = 0;
    for (int i = 0; i < o->ode->nside; i++)
        for (int k = 1; k + 1 < o->n && o->n + n < MOST; k++) {
            const double x = dip(o, i, k);
            if (x == x) at[n++] = x;
        }
    for (int k = 0; k < n; k++) add(o, at[k]);
}

/* What turns far within the step is looked at in parts of it, at the middle of each, too. */
static void look(struct sides *o)
{
    const int parts = passing_parts(o->ode, &o->from, &o->to), n = 2 * smaller(parts, PASSING_PARTS);
    assert(n > 0);
    o->n = 0;
    for (int k = 0; k <= n; k++) add(o, (double)k / n);
    if (parts == 1) {
        if (all_clear(o)) return;
        add(o, .25);
        add(o, .75);
    }
    add_dips(o);
}

/* By how much the force of value i goes up and down at most. */
static double swing(const struct sides *o, int i)
{
    double most = 0;
    for (int k = 1; k < o->n; k++) most = larger(most, fabs(o->at[k].force[i] - o->at[0].force[i]));
    return most;
}

/* Of an edge of value i at x, where its force is f: by how much that goes on otherwise than straight, of what it
 * changes in all. */
static double beyond(const struct sides *o, int i, double x, double f)
{
    const double f0 = o->at[0].force[i], f1 = o->at[o->n - 1].force[i], off = f1 - f - (f - f0) * (1 - x) / x;
    return x < .5 || !(fabs(off) < fabs(f1 - f0)) ? 1 : fabs(off) / fabs(f1 - f0);
}

/* Between two places at which value i has another sign. */
struct bracket {
    double a, b, ga, gb, fa, fb; /* the places, the value and its force there */
    int last;                    /* which one has moved last, -1 or 1 */
};

static void narrow(struct sides *o, struct bracket *x, int i, double width)
{
    enum { MOST_LOOKS = 60 };
    const double least = .4 * width;
    for (int n = 0; n < MOST_LOOKS && x->b - x->a > width; n++) {
        const double even = x->a + (x->b - x->a) * (x->ga / (x->ga - x->gb));
        double at = larger(x->a + least, smaller(x->b - least, even));
        look_at(o, &o->look, at);
        if (o->look.side[i] == 0) look_at(o, &o->look, at += least); /* what the force is there is not told */
        const double g = o->look.side[i], f = o->look.force[i];
        const bool before = parted(g, x->gb);
        if (before) {
            x->a = at, x->ga = g, x->fa = f;
            if (x->last == -1) x->gb /= 2;
        } else {
            x->b = at, x->gb = g == g && g != 0 ? g : x->gb, x->fb = f;
            if (x->last == 1) x->ga /= 2;
        }
        x->last = before ? -1 : 1;
    }
}

/* The edge of value i between places k and k + 1: none, where the force is the same there and at all places.  A jump is as large
 * where the bracket is narrower. */
static void find(struct sides *o, struct edge *edge, int i, int k)
{
    static const double WIDTH = 1e-7, FINE = 1e-9, MUCH = 1e-4, SAME = .5;
    const struct place *p = &o->at[k], *q = p + 1;
    struct bracket x = {p->x, q->x, p->side[i], q->side[i], p->force[i], q->force[i], 0};
    narrow(o, &x, i, WIDTH);
    const double wide = fabs(x.fb - x.fa);
    const bool may = wide > MUCH * swing(o, i);
    if (may) narrow(o, &x, i, FINE);
    edge->at = x.b;
    const bool same = x.fa == p->force[i] && x.fb == x.fa && swing(o, i) == 0;
    edge->kind = same ? EDGE_NONE : may && fabs(x.fb - x.fa) > SAME * wide ? EDGE_JUMP : EDGE_BEND;
    edge->located = true;
    edge->beyond = beyond(o, i, x.b, x.fb);
}

/* Does what value i tells of come and go within the step: is its sign the same at both ends, another one between, and its force there
 * farther from what goes evenly from end to end than that is from 0?  The place before it; -1: no. */
static int comes_and_goes(const struct sides *o, int i)
{
    const struct place *a = &o->at[0], *b = &o->at[o->n - 1];
    const double even = larger(fabs(a->force[i]), fabs(b->force[i]));
    int before = -1;
    if (parted(a->side[i], b->side[i])) return -1;
    for (int k = 1; k < o->n - 1; k++) {
        const struct place *p = &o->at[k];
        if (!parted(a->side[i], p->side[i])) continue;
        if (before < 0) before = k - 1;
        const double straight = a->force[i] + p->x * (b->force[i] - a->force[i]);
        if (fabs(p->force[i] - straight) > even) return before;
    }
    return -1;
}

/* The place before the first of them; 1: there is none. */
static double before_first(const struct sides *o)
{
    double first = 1;
    for (int i = 0; i < o->ode->nside; i++) {
        const int k = comes_and_goes(o, i);
        if (k >= 0) first = smaller(first, o->at[k].x);
    }
    return first;
}

/* The first jump goes first, then the bend that is farthest from both ends. */
static bool is_first(const struct edge *a, const struct edge *b)
{
    if (a->kind != b->kind) return a->kind > b->kind;
    return a->kind == EDGE_JUMP ? a->at < b->at : fabs(a->at - .5) < fabs(b->at - .5);
}

static void between(struct sides *o, const struct state *from, const struct state *to)
{
    o->from = *from;
    o->to = *to;
}

/* Has a value another sign at the last two places? */
static bool any_parted(const struct sides *o)
{
    for (int i = 0; i < o->ode->nside; i++)
        if (parted(o->before.side[i], o->stood.side[i])) return true;
    return false;
}

/* In how many steps no value comes to 0, which have changed by what they have in the last `steps`: a quarter of those that they
 * would take at that pace, at most twice as many as were seen. */
static int clear_ahead(const struct sides *o, int steps)
{
    static const double PART = .25, MOST_AHEAD = 8;
    double least = smaller(2 * steps, MOST_AHEAD);
    for (int i = 0; i < o->ode->nside; i++) {
        const double g = o->stood.side[i], way = fabs(g - o->before.side[i]);
        if (g != g || way != way) return 0;
        least = smaller(least, way > 0 ? PART * fabs(g) / way * steps : least);
    }
    return (int)least;
}

bool sides_parted(struct sides *o, const struct state *from, const struct state *to)
{
    const struct place known = o->stood;
    if (o->skipped < o->ahead && o->t_stood == from->t) {
        o->skipped++;
        o->t_stood = to->t;
        return false;
    }
    between(o, from, to);
    o->stood = o->before;
    o->before = known;
    if (o->t_stood != from->t) look_at(o, &o->before, 0);
    look_at(o, &o->stood, 1);
    const bool apart = any_parted(o);
    if (apart && o->skipped > 0) look_at(o, &o->before, 0);
    o->ahead = apart || o->t_stood != from->t ? 0 : clear_ahead(o, o->skipped + 1);
    o->skipped = 0;
    o->t_stood = to->t;
    return apart && any_parted(o);
}

struct edge sides_edge(struct sides *o, const struct state *from, const struct state *to)
{
    struct edge first = {.at = NAN}, edge;
    double last = 0;
    between(o, from, to);
    for (int i = 0; i < o->ode->n; i++) o->dv[i] = to->v[i] - from->v[i];
    path_between(&o->way, &o->from, &o->to);
    look(o);
    for (int k = 0; k + 1 < o->n; k++)
        for (int i = 0; i < o->ode->nside; i++) {
            if (!parted(o->at[k].side[i], o->at[k + 1].side[i])) continue;
            find(o, &edge, i, k);
            if (edge.kind == EDGE_NONE) continue;
            if (edge.kind == EDGE_JUMP) last = larger(last, edge.at);
            if (is_first(&edge, &first)) first = edge;
        }
    first.comes = before_first(o);
    first.last = last;
    return first;
}

/* Straight on by h. */
static void look_beside(struct sides *o, struct place *p, const struct adaptive *m, double t, double h)
{
    motion_point(o->ode, o->q, m->q, m->v, h, t + h);
    for (int i = 0; i < o->ode->n; i++) o->v[i] = m->v[i] + h * m->a[i];
    o->ode->sides(o->ode, p->side, p->force, &(struct instant){.t = t + h, .q = o->q, .v = o->v});
}

/* It jumps if what it changes by is as much in a way that is a hundred times shorter. */
bool sides_jump(struct sides *o, const struct adaptive *m, double t, double h)
{
    static const double NEARER = .01, SAME = .5;
    if (!o) return false;
    for (int k = 0; k < 4; k++) look_beside(o, &o->at[k], m, t, (k % 2 ? h : -h) * (k < 2 ? 1 : NEARER));
    for (int i = 0; i < o->ode->nside; i++) {
        const double wide = fabs(o->at[1].force[i] - o->at[0].force[i]);
        const double near = fabs(o->at[3].force[i] - o->at[2].force[i]);
        if (parted(o->at[2].side[i], o->at[3].side[i]) && near > SAME * wide) return true;
    }
    return false;
}
