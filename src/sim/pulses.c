/* pulses.c -- loads as a fixed step sees them: pulses within one step, and jumps at times that nobody knows beforehand. */
#include <math.h>

#include "sim/parts.h"

/* A step that something happens in: it ends at `end`, and the two corners are inside it or at its ends. */
struct within {
    double first, last, begin, end;
};

/* Do two corners that follow each other lie in one step of h, counted from t0, and leave some of it? */
static bool in_one_step(struct within *o, double first, double last, double t0, double h)
{
    static const double END = 1e-9; /* of a step: at its end */
    const double k = floor((first - t0) / h + END);
    *o = (struct within){first, last, t0 + k * h, t0 + (k + 1) * h};
    return last <= o->end + END * h && last - first < (1 - END) * h;
}

static double at(const struct signal *s, double t)
{
    return signal_value(s, &t);
}

/* An expression is other behind each of its corners.  A table goes on, and what counts is whether it goes away and comes
 * back. */
static bool is_pulse(const struct signal *s, const struct within *o)
{
    static const double PART = .5; /* of all that the table does */
    double low = INFINITY, high = -INFINITY;
    if (s->expr) return true;
    for (int i = 0; i < s->n; i++) {
        low = fmin(low, s->x[i]);
        high = fmax(high, s->x[i]);
    }
    const double a = at(s, o->begin), b = at(s, o->end), x = at(s, o->first), y = at(s, o->last);
    return fmax(x, y) - fmax(a, b) > PART * (high - low) || fmin(a, b) - fmin(x, y) > PART * (high - low);
}

/* The first pulse within one step. */
static bool find_pulse(struct within *o, const struct signal *s, const struct sim *sim, double h)
{
    enum { MOST = 100000 };
    double first = signal_next(s, sim->scene->start);
    for (int i = 0; i < MOST && first < sim->plan.until; i++) {
        const double last = signal_next(s, first);
        if (last < sim->plan.until && in_one_step(o, first, last, sim->origin.x, h) && is_pulse(s, o)) return true;
        first = last;
    }
    return false;
}

void warn_of_pulses(const struct sim *sim, struct diags *diags)
{
    const struct model *m = sim->model;
    bool fast = false; /* else all takes major steps */
    if (sim->stepper.kind->adaptive || sim->options.counting) return;
    for (int i = 0; i < m->ncoordinate; i++) fast |= m->coordinate[i].fast;
    for (int i = 0; i < m->nforce; i++) {
        struct within o;
        const struct node *n = sim->scene->force[i].node, *value = node_find(n, "value");
        bool found = false;
        const double h = sim->plan.step * (fast && m->force[i].cls == FAST ? 1 : sim->plan.ratio);
        for (int k = 0; k < 3 && !found; k++) found = find_pulse(&o, &m->force[i].value[k], sim, h);
        if (!found) continue;
        diag_warn(diags, value ? value : n, AT_VALUE, "W-pulse",
                  "'%.60s' changes at t = %.9g s and at %.9g s, within one step of %.6g s, which may miss what is "
                  "between",
                  m->force[i].name, o.first, o.last, h);
        diag_hint(diags, "take a step that ends at both times, or a tolerance: such schemes step onto them");
    }
}

/* Has it corners that are not among the known ones: of the state, or of a function of time that is not looked into? */
static bool bends_unseen(const struct signal *s)
{
    int slot[2] = {0, 0};
    if (!signal_may_leap(s)) return false;
    return s->ncorner == 0 || expr_reads(s->expr, slot, 2) > 1 || slot[0] != 0;
}

bool sim_bends_unseen(const struct sim *sim)
{
    const struct model *m = sim->model;
    for (int i = 0; i < m->nforce; i++)
        for (int k = 0; k < 3; k++)
            if (bends_unseen(&m->force[i].value[k])) return true;
    for (int l = model_first_drive(m); l < m->nloop; l++)
        if (bends_unseen(m->loop[l].drive)) return true;
    return false;
}
