/* flat.c -- a spatial mechanism that stays in a plane: steps there, answers in space.
 *
 * The spatial system stands still beside the steps.  Where the output asks, it is put where the plane's coordinates say,
 * whole turns included, and answers as it always does: reactions across the plane, too. */
#include "system/parts.h"

struct system *system_flatten(struct system *full, const struct model_flat *flat, struct arena *life)
{
    struct system *s = system_build(flat->plane, life);
    s->flat = flat;
    s->seen = full;
    return s;
}

bool system_is_flat(const struct system *s)
{
    return s->seen != NULL;
}

/* The rates of all joints as those that the spatial system takes. */
static void gather_rates(double *v, const struct system *s)
{
    const struct system *full = s->seen;
    const int n = system_ode2((struct system *)full)->n;
    for (int i = 0; i < n; i++) v[i] = s->v[system_place(full, i)];
}

/* Angles that a posture gives up to whole turns stand as in the plane. */
static void set_turns(struct system *s)
{
    const struct model *m = s->seen->model;
    for (int i = 0; i < m->nmeasure; i++) {
        double x, rate;
        if (m->measure[i].type != MEASURE_ANGLE) continue;
        elements_measure(s->tree.elements, s->view, &x, &rate, i, s->q, s->v);
        system_set_measure(s->seen, i, x);
    }
}

enum status flat_evaluate(struct system *s, const double *q, const double *v, double t, unsigned what,
                          struct trouble *why)
{
    struct system *full = s->seen;
    struct ode2 *door = system_ode2(full);
    TRY(system_evaluate_itself(s, q, v, t, what & EVALUATE_ACCELERATION ? EVALUATE_ACCELERATION : EVALUATE_MOTION,
                               why));
    double *rates = full->near_v[0]; /* as many as there are coordinates */
    gather_rates(rates, s);
    if (door->chart && door->chart->rechart(door, s->q, rates, t)) gather_rates(rates, s);
    set_turns(s);
    return system_evaluate_itself(full, s->q, rates, t, what, why);
}
