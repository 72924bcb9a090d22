/* pulses.c -- loads and drives that change suddenly: pulses that come and go within one fixed step are warned of
 * (W-pulse); schemes that choose their steps get the times at which to stop. */
#include <math.h>

#include "sim/parts.h"

/* A step from `begin` to `end`, and two corners of a signal in it or at its ends [s]. */
struct within {
    double first, last, begin, end;
};

/* Do two successive corners lie in one step h, steps counted from t0, and are they closer to each other than the
 * whole step? */
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

/* Does the signal come and go between the two corners?  Of an expression any two corners count, since it follows
 * another formula behind each; a table is continuous, and must depart from its values at the ends of the step by
 * half its range. */
static bool is_pulse(const struct signal *s, const struct within *o)
{
    static const double PART = .5; /* of the range of the table */
    double low = INFINITY, high = -INFINITY;
    if (s->expr) return true;
    for (int i = 0; i < s->n; i++) {
        low = fmin(low, s->x[i]);
        high = fmax(high, s->x[i]);
    }
    const double a = at(s, o->begin), b = at(s, o->end), x = at(s, o->first), y = at(s, o->last);
    return fmax(x, y) - fmax(a, b) > PART * (high - low) || fmin(a, b) - fmin(x, y) > PART * (high - low);
}

/* The first pulse of the run that is within one step. */
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

/* ---- smooth ones ---- */

/* The search for a smooth pulse of a function of t alone.  Interval arithmetic (expr_span()) bounds it over
 * stretches of time and so excludes those where it is nearly constant: a pulse of a second in an hour is found with
 * a few dozen bounds. */
struct look {
    const struct signal *s;
    double t0, h; /* start of the run, step [s] */
    double whole; /* range of the function over the run, in its units */
    long left;    /* bounds that may still be computed */
};

/* Bounds of the function from time a to b; false: there are none. */
static bool bounds(struct expr_span *o, struct look *l, double a, double b)
{
    l->left--;
    return expr_span(o, l->s->expr, &a, &b) && isfinite(o->lo) && isfinite(o->hi);
}

/* The range of the function over the run, as the union of bounds of its parts, since those over the whole run may be
 * far too wide; NAN: not known. */
static double whole_of(struct look *l, double until)
{
    enum { PARTS = 64 };
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < PARTS; i++) {
        struct expr_span o;
        const double part = (until - l->t0) / PARTS;
        if (!bounds(&o, l, l->t0 + i * part, l->t0 + (i + 1) * part)) continue;
        low = fmin(low, o.lo);
        high = fmax(high, o.hi);
    }
    return high >= low ? high - low : NAN;
}

/* *t := a time between a and b at which the function is outside low to high, if one is found by halving. */
static bool strays(double *t, struct look *l, double a, double b, double low, double high, int depth)
{
    struct expr_span o;
    const double middle = a + (b - a) / 2, x = at(l->s, middle);
    *t = middle;
    if (x < low || x > high) return true;
    if (depth == 0 || l->left <= 0 || (bounds(&o, l, a, b) && o.lo >= low && o.hi <= high)) return false;
    return strays(t, l, a, middle, low, high, depth - 1) || strays(t, l, middle, b, low, high, depth - 1);
}

/* Is there a step, of those numbered k to n - 1, in which the function goes outside the range of its values at the
 * ends of that step by a quarter of its whole range?  o: the step, and the time of that in `first`. */
static bool strays_in_a_step(struct within *o, struct look *l, long k, long n)
{
    enum { HALVINGS = 10 };
    static const double FLAT = .05, PART = .25; /* of the whole range */
    struct expr_span span;
    const double a = l->t0 + (double)k * l->h, b = l->t0 + (double)n * l->h;
    if (l->left <= 0 || (bounds(&span, l, a, b) && span.hi - span.lo <= FLAT * l->whole)) return false;
    if (n > k + 1) return strays_in_a_step(o, l, k, k + (n - k) / 2) || strays_in_a_step(o, l, k + (n - k) / 2, n);
    const double x = at(l->s, a), y = at(l->s, b), more = PART * l->whole;
    *o = (struct within){.begin = a, .end = b};
    return strays(&o->first, l, a, b, fmin(x, y) - more, fmax(x, y) + more, HALVINGS);
}

/* The first smooth pulse within one step of an expression that reads the time alone. */
static bool find_stray(struct within *o, const struct signal *s, const struct sim *sim, double h)
{
    enum { LEAST = 4000, MOST = 40000 };
    int slot[2] = {0, 0};
    const double steps = ceil((sim->plan.until - sim->scene->start) / h - 1e-9);
    if (!s->expr || expr_reads(s->expr, slot, 2) != 1 || slot[0] != 0 || !(steps < 1e12)) return false;
    struct look l = {.s = s, .t0 = sim->scene->start, .h = h, .left = (long)fmax(LEAST, fmin(MOST, steps / 4))};
    l.whole = whole_of(&l, sim->plan.until);
    return l.whole > 0 && strays_in_a_step(o, &l, 0, (long)steps);
}

static bool warn_of_stray(const struct sim *sim, const struct signal *s, const char *name, const struct node *n,
                          double h, struct diags *diags)
{
    struct within o;
    if (!find_stray(&o, s, sim, h)) return false;
    diag_warn(
        diags, n, AT_VALUE, "W-pulse",
        "'%.60s' is %.4g at t = %.9g s, but %.4g and %.4g at the ends of its step, %.9g and %.9g s: what is between "
        "may be missed",
        name, at(s, o.first), o.first, at(s, o.begin), at(s, o.end), o.begin, o.end);
    diag_hint(diags, "a step must be a part of the time in which it comes and goes");
    return true;
}

void warn_of_pulses(struct sim *sim, struct diags *diags)
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
        for (int k = 0; k < 3 && !found; k++)
            sim->pulses |= warn_of_stray(sim, &m->force[i].value[k], m->force[i].name, value ? value : n, h, diags);
        if (!found) continue;
        sim->pulses = true;
        diag_warn(diags, value ? value : n, AT_VALUE, "W-pulse",
                  "'%.60s' changes at t = %.9g s and at %.9g s, within one step of %.6g s, which may miss what is "
                  "between",
                  m->force[i].name, o.first, o.last, h);
        diag_hint(diags, "take a step that ends at both times, or a tolerance: such schemes step onto them");
    }
}

/* For schemes that choose their steps.  Called before the system is built, which asks whether there is anything to
 * stop at. */
void pulses_stop_at(const struct sim *sim, struct model *m, struct arena *life)
{
    const double from = fmin(0, sim->scene->start), to = sim->plan.until; /* the same for a run that goes on */
    if (!sim->stepper.kind->adaptive) return;
    struct model_force *force = TAKE(life, struct model_force, m->nforce);
    struct model_loop *loop = TAKE(life, struct model_loop, m->nloop);
    for (int i = 0; i < m->nforce; i++) {
        force[i] = m->force[i];
        for (int k = 0; k < 3; k++) signal_stop_at_sudden(&force[i].value[k], from, to, life);
    }
    for (int l = 0; l < m->nloop; l++) {
        loop[l] = m->loop[l];
        if (l < model_first_drive(m)) continue;
        struct signal *drive = TAKE(life, struct signal, 1);
        *drive = *loop[l].drive;
        signal_stop_at_sudden(drive, from, to, life);
        if (sim->stepper.kind->order <= 2) signal_stop_within(drive, from, to, life);
        loop[l].drive = drive;
    }
    m->force = force;
    m->loop = loop;
}

/* May the signal have corners at times that are not known beforehand: it depends on the state, or its function of
 * time has no list of corners? */
static bool bends_unseen(const struct signal *s)
{
    int slot[2] = {0, 0};
    if (!signal_may_leap(s)) return false;
    return s->ncorner == 0 || expr_reads(s->expr, slot, 2) > 1 || slot[0] != 0;
}

/* Is its push there at once where bodies meet? */
static bool pushes_at_once(const struct model_force *f)
{
    double at_once = 0;
    if (!f->kind || !f->kind->whole) return false;
    (void)f->kind->whole(&at_once, f->par, 0, 1);
    return at_once != 0;
}

bool sim_bends_unseen(const struct sim *sim)
{
    const struct model *m = sim->model;
    for (int i = 0; i < m->nforce; i++) {
        if (pushes_at_once(&m->force[i])) return true;
        for (int k = 0; k < 3; k++)
            if (bends_unseen(&m->force[i].value[k])) return true;
    }
    for (int l = model_first_drive(m); l < m->nloop; l++)
        if (bends_unseen(m->loop[l].drive)) return true;
    return false;
}
