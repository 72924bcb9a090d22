/* quick.c -- see quick.h */
#include "study/quick.h"

#include <math.h>
#include <string.h>

#include "engine/adaptive.h"
#include "engine/motion.h"

static const double LATE = 1. / 12;

void quick_open(struct quick *o, const struct sim *sim, struct arena *life)
{
    const int n = sim->stepper.ode->n;
    *o = (struct quick){.n = n};
    o->a = TAKE(life, double, n);
    o->j = TAKE(life, double, n);
    o->top = TAKE(life, double, n);
    o->bend = TAKE(life, double, n);
    o->third = TAKE(life, double, n);
    o->fourth = TAKE(life, double, n);
    for (int i = 0; i < QUICK_SAMPLES; i++) {
        o->sample[i].j = TAKE(life, double, n);
        o->sample[i].k = TAKE(life, double, n);
    }
}

/* A vibration is off by no more than twice its size, as engine/stepped.c has it. */
double quick_off(const struct quick *o, const struct sim *sim, int i, double j, double k)
{
    const struct stepper *s = &sim->stepper;
    const double v = adaptive_scale_plain(s, i, o->top[i]), seen = 2 * o->top[i] > v ? fabs(k) / v : 0;
    return LATE * s->options.tolerance * (fabs(j) / adaptive_scale_q(s, i) + seen);
}

double quick_mean_off(const struct quick *o, const struct sim *sim, int i)
{
    return quick_off(o, sim, i, o->third[i] / o->seen, o->fourth[i] / o->seen);
}

/* Of the quickest. */
static double most_off(const struct quick *o, const struct sim *sim)
{
    double most = 0;
    for (int i = 0; i < o->n && o->seen > 0; i++) most = fmax(most, quick_mean_off(o, sim, i));
    return most;
}

/* The step of length h that has just ended. */
static void note_step(struct quick *o, const struct sim *sim, double h)
{
    struct quick_sample *to = &o->sample[o->samples++ % QUICK_SAMPLES];
    const bool bends = motion_bend(sim->stepper.ode, o->bend, sim->x.v, sim->x.a, 2);
    to->h = h;
    for (int i = 0; i < o->n; i++) {
        const double j = (sim->x.a[i] - o->a[i]) / h;
        to->j[i] = bends ? j - o->bend[i] : j;
        to->k[i] = o->known > 1 ? (j - o->j[i]) / (.5 * (h + o->h)) : 0;
        o->third[i] += h * fabs(to->j[i]);
        o->fourth[i] += h * fabs(to->k[i]);
        o->j[i] = j;
    }
    o->seen += h;
    o->h = h;
}

void quick_note(struct quick *o, const struct sim *sim)
{
    const double h = sim->x.t - o->t;
    const long charts = system_charts(sim->system);
    if (charts != o->charts || !(h > 0)) o->known = 0;
    if (charts != o->charts) o->samples = 0;
    if (o->known > 0) note_step(o, sim, h);
    for (int i = 0; i < o->n; i++) {
        o->a[i] = sim->x.a[i];
        o->top[i] = fmax(o->top[i], fabs(sim->x.v[i]));
    }
    o->t = sim->x.t;
    o->charts = charts;
    if (o->known < 2) o->known++;
}

double quick_tolerance(const struct quick *o, const struct sim *sim, double h, double span)
{
    static const double LEAST = 1e-10, MOST = 1e-2;
    return o->seen > 0 ? fmin(MOST, fmax(LEAST, most_off(o, sim) * h * h * span)) : MOST;
}

double quick_step(const struct quick *o, const struct sim *sim, double tolerance, double span)
{
    const double most = most_off(o, sim);
    return most > 0 ? sqrt(tolerance / (most * span)) : span;
}
