/* missed.c -- see missed.h */
#include "engine/missed.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/scalar.h"
#include "engine/motion.h"

void missed_open(struct missed *o, int n, struct arena *life)
{
    double **vector[] = {&o->position, &o->velocity, &o->way,       &o->extent,
                         &o->a,        &o->bend,     &o->before[0], &o->before[1]};
    *o = (struct missed){.n = n};
    for (size_t i = 0; i < sizeof vector / sizeof *vector; i++) *vector[i] = TAKE(life, double, n);
    for (int k = 0; k < MISSED_ORDER + 2; k++) o->v[k] = TAKE(life, double, n);
}

/* Steps to the next burst, in the mean a twelfth of those so far.  Uneven (golden section), so that bursts do not
 * fall into step with a vibration. */
static long pause(const struct missed *o)
{
    static const double EVER = 12, LONGEST = 20, LEAST = .5, GOLDEN = .61803398874989485;
    enum { DENSE = 32 };
    const double mean = smaller((double)(o->steps - DENSE) / EVER, LONGEST), at = GOLDEN * (double)o->steps;
    return mean < 1 ? 0 : (long)(mean * (LEAST + 2 * (1 - LEAST) * (at - floor(at))));
}

/* (v, a) is where the motion goes: the part of errors (x, y) along it, w^2 v x + a y over w^2 v^2 + a^2, with w from the largest of
 * both, so that it is none where the motion all but rests.  Their signs are random. */
static double delay(struct missed *o, const struct ode2 *ode, const double *position, const double *velocity,
                    const double *v, const double *a)
{
    double vv = 0, aa = 0, by_v = 0, by_a = 0;
    for (int i = 0; i < o->n; i++) {
        const double usual = ode2_usual(ode, i), per = 1 / (usual * usual);
        const double in_v = per * v[i] * position[i], in_a = per * a[i] * velocity[i];
        vv += per * v[i] * v[i];
        aa += per * a[i] * a[i];
        by_v += in_v * in_v;
        by_a += in_a * in_a;
    }
    o->fastest = larger(o->fastest, vv);
    o->steepest = larger(o->steepest, aa);
    const double square = o->fastest > 0 ? o->steepest / o->fastest : 0;
    const double late = sqrt(square * square * by_v + by_a) / (aa + square * vv);
    return isfinite(late) ? late : 0;
}

void missed_add(struct missed *o, const struct ode2 *ode, const double *position, const double *velocity,
                const double *v, const double *a)
{
    const double times = (double)(o->steps - o->told);
    copy(o->before[0], o->position, o->n);
    copy(o->before[1], o->velocity, o->n);
    o->signed_before[0] = o->signed_position;
    o->signed_before[1] = o->signed_velocity;
    o->told_before = o->told;
    o->next_before = o->next;
    o->late_before = o->late;
    o->late += times * delay(o, ode, position, velocity, v, a);
    for (int i = 0; i < o->n; i++) {
        o->position[i] += times * fabs(position[i]);
        o->velocity[i] += times * fabs(velocity[i]);
    }
    if (o->n == 1) o->signed_position += times * position[0], o->signed_velocity += times * velocity[0];
    o->told = o->steps;
    o->next = o->steps + pause(o);
    o->seen = 0;
}

void missed_begin(struct missed *o, bool afresh, double h)
{
    if (afresh || h != o->h) missed_break(o);
    o->h = h;
}

void missed_before(struct missed *o, const double *v)
{
    if (o->seen == 0) memcpy(o->v[o->seen++], v, (size_t)o->n * sizeof *v);
}

/* v[k] := backward difference of order k of the velocities v[0..most], which are one step apart. */
static void take_differences(struct missed *o, int most)
{
    for (int k = 1; k <= most; k++)
        for (int j = most; j >= k; j--)
            for (int i = 0; i < o->n; i++) o->v[j][i] -= o->v[j - 1][i];
}

/* Takes what straight ways miss of rotations, at velocities v and their differences dv a step on, from what is off in positions. */
static void bend(struct missed *o, const struct ode2 *ode, double *position, const double *v, const double *dv,
                 int order, double late)
{
    const double by = order > 2 ? late * pow(o->h, order + 1) : o->h * o->h * o->h / 12;
    for (int i = 0; i < o->n; i++) o->a[i] = dv[i] / o->h;
    if (!motion_bend(ode, o->bend, v, o->a, order)) return;
    for (int i = 0; i < o->n; i++) position[i] -= by * o->bend[i];
}

void missed_after(struct missed *o, const struct ode2 *ode, const double *v, int order, double late, bool straight)
{
    const int most = order + 1;
    memcpy(o->v[o->seen++], v, (size_t)o->n * sizeof *v);
    if (o->seen <= most) return;
    take_differences(o, most);
    for (int i = 0; i < o->n; i++) {
        o->v[order][i] *= late * o->h;
        o->v[most][i] *= late;
    }
    if (straight) bend(o, ode, o->v[order], o->v[0], o->v[1], order, late);
    for (int i = 0; i < o->n; i++) o->a[i] = o->v[1][i] / o->h;
    missed_add(o, ode, o->v[order], o->v[most], o->v[0], o->a);
}

/* The part of an error of velocity that becomes an error of position in a unit of time, in a vibration of amplitude
 * x (in usual sizes): that of a pendulum, whose frequency changes with its amplitude by x dx/8; all of it for a
 * rotation. */
static double shear(double x)
{
    return x * x < 8 ? x * x / 8 : 1;
}

void missed_moved(struct missed *o, const struct ode2 *ode, const double *v, double h, const double *off)
{
    for (int i = 0; i < o->n; i++) {
        o->way[i] += h * v[i] / ode2_usual(ode, i);
        if (fabs(o->way[i]) > o->extent[i]) o->extent[i] = fabs(o->way[i]);
        o->position[i] += shear(o->extent[i]) * fabs(h) * off[i];
    }
}

void missed_drift(struct missed *o, const struct ode2 *ode, const double *v, double h, double part)
{
    for (int i = 0; i < o->n; i++) o->a[i] = part * o->velocity[i];
    missed_moved(o, ode, v, h, o->a);
}

void missed_break(struct missed *o)
{
    o->seen = 0;
}

void missed_crossed(struct missed *o)
{
    enum { PATIENCE = 32 };
    const bool ended = o->told == o->steps && o->told > 0;
    if (o->steps - (ended ? o->next_before : o->next) > PATIENCE) return;
    missed_break(o);
    if (!ended) return;
    copy(o->position, o->before[0], o->n);
    copy(o->velocity, o->before[1], o->n);
    o->signed_position = o->signed_before[0];
    o->signed_velocity = o->signed_before[1];
    o->late = o->late_before;
    o->told = o->told_before;
    o->next = o->next_before;
}

void missed_once(struct missed *o, const double *velocity, double H)
{
    for (int i = 0; i < o->n; i++) {
        o->velocity[i] += velocity[i];
        o->position[i] += H / 2 * velocity[i];
    }
}

void missed_rechart(struct missed *o)
{
    double most = 0;
    o->seen = 0;
    for (int i = 0; i < o->n; i++) most = o->extent[i] > most ? o->extent[i] : most;
    for (int i = 0; i < o->n; i++) {
        o->way[i] = 0;
        o->extent[i] = most;
        o->position[i] = fabs(o->position[i]);
        o->velocity[i] = fabs(o->velocity[i]);
    }
}

void missed_recall(struct missed *o, struct recall *r)
{
    recall_within(r, "missed");
    recall_list(r, "position", o->position, o->n);
    recall_list(r, "velocity", o->velocity, o->n);
    recall_list(r, "way", o->way, o->n);
    recall_list(r, "extent", o->extent, o->n);
    recall_one(r, "late", o->late);
    recall_one(r, "fastest", o->fastest);
    recall_one(r, "steepest", o->steepest);
    recall_one(r, "signed_position", o->signed_position);
    recall_one(r, "signed_velocity", o->signed_velocity);
    recall_one(r, "steps", o->steps);
    recall_one(r, "told", o->told);
    recall_one(r, "next", o->next);
    recall_one(r, "seen", o->seen);
    recall_one(r, "h", o->h);
    for (int k = 0; k < o->seen; k++) {
        char name[24];
        snprintf(name, sizeof name, "v%d", k);
        recall_list(r, name, o->v[k], o->n);
    }
    recall_without(r);
}
