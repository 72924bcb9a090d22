/* crossed.c -- see crossed.h */
#include "engine/crossed.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/missed.h"
#include "engine/motion.h"
#include "engine/sides.h"
#include "engine/strikes.h"

struct crossed {
    const struct ode2 *ode;
    struct sides *sides;
    double *mean;   /* [n] accelerations of the last step, in the mean, */
    double *trend;  /* [n] by how much they were others than those of the one before it */
    double *before; /* [n] accelerations of the step before one with an edge, */
    double *going;  /* [n] and their trend */
    double *kicked; /* [n] what edges have left in velocities so far */
    bool kicks;     /* anything at all */
    double *now;    /* [n] of the step that has been taken */
    int known;      /* steps in a row, at most 2: the first tells no trend */
    int kind;       /* of the edge in the last step, enum edge_kind; EDGE_NONE: there was none */
    double h, H;    /* of that step: minor, major [s] */
};

struct crossed *crossed_open(const struct stepper *s, struct arena *life)
{
    const struct ode2 *ode = s->ode;
    if (s->kind->adaptive || !s->kind->late || !s->missed || ode->n == 0 || !(ode->nside || ode->passed)) return NULL;
    struct crossed *o = TAKE(life, struct crossed, 1);
    double **vector[] = {&o->mean, &o->trend, &o->before, &o->going, &o->kicked, &o->now};
    for (size_t i = 0; i < sizeof vector / sizeof *vector; i++) *vector[i] = TAKE(life, double, ode->n);
    o->ode = ode;
    o->sides = sides_open(ode, life);
    return o;
}

/* The parts of an edge that is that close to an end are those of no edge: the step ends at it. */
static bool is_inside(double x)
{
    static const double LEAST = 1e-6;
    return x > LEAST && x < 1 - LEAST;
}

/* pushes: does a push begin or end there? */
static enum edge_kind edge_in(struct crossed *o, bool *pushes, const struct state *from, const struct state *to,
                              const struct passing_look *passing)
{
    double x = NAN;
    enum edge_kind kind = passing ? passing_edge(passing, &x) : EDGE_NONE;
    *pushes = kind != EDGE_NONE;
    if (!is_inside(x)) kind = EDGE_NONE;
    if (!o->sides || !sides_parted(o->sides, from, to)) return kind;
    const struct edge edge = sides_edge(o->sides, from, to);
    return is_inside(edge.at) && edge.kind > kind ? edge.kind : kind;
}

/* By how much accelerations have changed over an edge from what they were before to x, `steps` later: what goes on as it went is no
 * change, unless it did so by chance. */
static double change(const struct crossed *o, int i, double x, int steps)
{
    const double all = x - o->before[i];
    return smaller(fabs(all), fabs(all - steps * o->going[i]));
}

/* What the step with the edge has left, where the one behind it has the mean accelerations `now`. */
static void add(struct crossed *o, struct stepper *s)
{
    const bool fourth = s->kind->order > 2, bend = o->kind == EDGE_BEND;
    const double part = bend ? (fourth ? 1. / 48 : 1. / 12) : fourth ? 1. / 3 : 1. / 2;
    for (int i = 0; i < o->ode->n; i++) {
        const double most = larger(change(o, i, o->mean[i], 1), change(o, i, o->now[i], 2));
        o->before[i] = part * (i < o->ode->ns ? o->h : o->H) * most;
    }
    missed_once(s->missed, o->before, o->H);
    if (bend && !fourth) return;
    for (int i = 0; i < o->ode->n; i++) o->kicked[i] += o->before[i];
    o->kicks = true;
}

/* The step with the edge has been taken. */
static void note(struct crossed *o, struct stepper *s)
{
    missed_crossed(s->missed);
    copy(o->before, o->known ? o->mean : o->now, o->ode->n);
    if (o->known > 1)
        copy(o->going, o->trend, o->ode->n);
    else
        zero(o->going, o->ode->n);
}

void crossed_step(struct crossed *o, struct stepper *s, const struct state *from, const struct state *to, double h,
                  const struct passing_look *passing)
{
    bool pushes;
    const enum edge_kind kind = edge_in(o, &pushes, from, to, passing);
    const double H = to->t - from->t;
    for (int i = 0; i < o->ode->n; i++) o->now[i] = (to->v[i] - from->v[i]) / H;
    if (o->kicks) missed_moved(s->missed, s->ode, to->v, H, o->kicked);
    if (o->kind != EDGE_NONE) add(o, s);
    if (kind != EDGE_NONE) note(o, s);
    if ((pushes || kind != EDGE_NONE) && s->strikes) strikes_note(s->strikes, from->v, from->t);
    for (int i = 0; i < o->ode->n; i++) o->trend[i] = o->now[i] - o->mean[i];
    copy(o->mean, o->now, o->ode->n);
    if (o->known < 2) o->known++;
    o->kind = kind;
    o->h = h;
    o->H = H;
}

void crossed_break(struct crossed *o)
{
    double most = 0;
    for (int i = 0; i < o->ode->n; i++) most = larger(most, o->kicked[i]);
    for (int i = 0; i < o->ode->n; i++) o->kicked[i] = most;
    o->known = 0;
    o->kind = EDGE_NONE;
}

void crossed_recall(struct crossed *o, struct recall *r)
{
    recall_within(r, "crossed");
    recall_list(r, "mean", o->mean, o->ode->n);
    recall_list(r, "trend", o->trend, o->ode->n);
    recall_list(r, "before", o->before, o->ode->n);
    recall_list(r, "going", o->going, o->ode->n);
    recall_list(r, "kicked", o->kicked, o->ode->n);
    recall_one(r, "kicks", o->kicks);
    recall_one(r, "known", o->known);
    recall_one(r, "kind", o->kind);
    recall_one(r, "h", o->h);
    recall_one(r, "H", o->H);
    recall_without(r);
}
