/* jumps.c -- drives whose value itself jumps, such as if(t < 1, 0, 0.1).
 *
 * A step in position is an infinite speed: over a step h it would run at jump/h, so that what follows depends on h
 * alone.  The run stops before the step in which that happens.  Where two pieces of an expression all but meet, as with
 * constants of a few digits, it goes on, and the jump is reported. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sim/parts.h"

static const double PATCHED = 1e-3; /* of the largest value so far: a jump that may be meant as none */
static const double ROUNDED = 1e-9; /* of that, or less than the next in m or rad: round-off of the expression */
static const double NOTHING = 1e-12;

void jumps_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    sim->jump = TAKE(life, struct jumping, m->ndrive);
    for (int i = 0; i < m->ndrive; i++) {
        const struct signal *s = m->loop[model_first_drive(m) + i].drive;
        struct jumping o = {.loop = model_first_drive(m) + i, .t = m->t0, .clear = m->t0};
        if (!s->expr || expr_is_smooth(s->expr)) continue;
        signal_motion(s, o.x, m->t0);
        o.most = fabs(o.x[0]);
        sim->jump[sim->njump++] = o;
    }
}

static double unseen(const struct jumping *o)
{
    return fmax(NOTHING, ROUNDED * o->most);
}

/* To a, over what was passed because it was known not to jump there. */
static void go_to(struct jumping *o, const struct signal *s, double a)
{
    enum { SAMPLES = 16 };
    const double t = o->t;
    if (t == a) return;
    for (int i = 1; i <= SAMPLES; i++) {
        signal_motion(s, o->x, i < SAMPLES ? t + i * ((a - t) / SAMPLES) : a);
        o->most = fmax(o->most, fabs(o->x[0]));
    }
    o->t = a;
}

/* Does the value at b stand where its rates since a lead, but for what is not seen (Simpson)?  Then nothing jumps
 * between.  Goes on to b. */
static bool follows(struct jumping *o, const struct signal *s, double a, double b)
{
    double m[3], x[3];
    go_to(o, s, a);
    signal_motion(s, m, a + (b - a) / 2);
    signal_motion(s, x, b);
    const double gap = x[0] - o->x[0] - (b - a) / 6 * (o->x[1] + 4 * m[1] + x[1]);
    o->most = fmax(o->most, fabs(x[0]));
    memcpy(o->x, x, sizeof x);
    o->t = b;
    return fabs(gap) <= unseen(o);
}

/* Where the deck has the drive's value. */
static const struct node *value_of(const struct sim *sim, const struct jumping *o)
{
    return node_find(sim->scene->drive[o->loop - model_first_drive(sim->model)].node, "value");
}

static enum status judge(struct sim *sim, struct jumping *o, double at, double before, double behind, struct sink *sink,
                         struct report *report)
{
    const char *name = sim->model->loop[o->loop].name;
    const double by = fabs(behind - before);
    char text[200], place[240];
    o->most = fmax(o->most, fmax(fabs(before), fabs(behind)));
    if (by <= unseen(o)) return OK;
    snprintf(text, sizeof text, "drive '%.60s' jumps by %.3g, from %.9g to %.9g, at t = %.9g s", name, by, before,
             behind, at);
    if (by > PATCHED * o->most)
        return fail(report, E_NUMERIC,
                    "stopped at t = %.12g s: %s (%s); nothing follows a step in position: let it move there in some "
                    "time [drive-jump]",
                    sim->x.t, text, place_of(place, sizeof place, sim, value_of(sim, o)));
    if (!o->reported)
        sim_warn(sim, "%s (%s): its pieces do not quite meet", text,
                 place_of(place, sizeof place, sim, value_of(sim, o)));
    o->reported = true;
    return sink_event(sink, sim->x.t, "drive", text, report);
}

double jumps_clear(const struct sim *sim)
{
    double clear = INFINITY;
    for (int i = 0; i < sim->njump; i++)
        clear = fmin(clear, signal_clear(sim->model->loop[sim->jump[i].loop].drive, sim->x.t));
    return clear;
}

enum status jumps_check(struct sim *sim, double to, struct sink *sink, struct report *report)
{
    enum { OWN_STEPS = 16 };
    const double from = sim->x.t;
    const int pieces = sim->stepper.kind->adaptive ? OWN_STEPS : sim->plan.ratio;
    for (int i = 0; i < sim->njump; i++) {
        struct jumping *o = &sim->jump[i];
        const struct signal *s = sim->model->loop[o->loop].drive;
        double at, before, behind;
        if (to < o->clear || to < (o->clear = signal_clear(s, from))) continue;
        for (int k = 0; k < pieces; k++) {
            const double a = from + k * ((to - from) / pieces),
                         b = k + 1 < pieces ? from + (k + 1) * ((to - from) / pieces) : to;
            if (!follows(o, s, a, b) && signal_jump(s, &at, &before, &behind, a, b))
                TRY(judge(sim, o, at, before, behind, sink, report));
        }
    }
    return OK;
}
