/* corners.c -- see corners.h */
#include "study/corners.h"

#include <float.h>
#include <math.h>

#include "out/meant.h"

static const double MOST_PARTS = 1e6; /* of an interval */
enum { MOST_CORNERS = 20000 };

void corners_find(struct corners *o, const struct sim *sim, double until, struct arena *life)
{
    const struct ode2 *ode = sim->stepper.ode;
    int capacity = 0;
    *o = (struct corners){.start = sim->scene->start};
    if (!ode->breaks || !ode->breaks->next) return;
    for (double t = ode->breaks->next(ode, o->start); t < until; t = ode->breaks->next(ode, t)) {
        if (o->n == MOST_CORNERS) {
            o->more = true;
            return;
        }
        o->t = arena_more(life, o->t, o->n, &capacity, sizeof *o->t);
        o->t[o->n++] = t;
    }
}

double corners_both(double a, double b)
{
    double x = a, y = b;
    while (y > 0) {
        const double rest = fmod(x, y);
        x = y;
        y = rest;
    }
    const double both = a / x * b;
    return both <= MOST_PARTS ? both : 0;
}

/* The least q with q x whole, but for round-off; by the continued fraction of x > 0; 0: none up to the most. */
static double parts_of(double x)
{
    double rest = x, before = 0, q = 1;
    while (q <= MOST_PARTS && fabs(q * x - round(q * x)) > 16 * DBL_EPSILON * fmax(1, q * x)) {
        rest = 1 / (rest - floor(rest));
        const double next = floor(rest) * q + before;
        before = q;
        q = next;
    }
    return q <= MOST_PARTS ? q : 0;
}

double corners_grid(const struct corners *o, double every)
{
    double grid = o->more ? 0 : 1;
    for (int i = 0; i < o->n && grid > 0; i++) {
        const double parts = parts_of((o->t[i] - o->start) / every);
        grid = parts > 0 ? corners_both(grid, parts) : 0;
    }
    return grid;
}

/* Steps are counted from t = 0, where the start is the end of one. */
bool corners_met(const struct corners *o, double step, double *first)
{
    static const double SAME = 4 * DBL_EPSILON;
    const double past = o->start / step;
    const bool along = fabs(past - round(past)) <= 1e-9 * fmax(1, past);
    const struct meant origin = meant_by(along ? 0 : o->start), h = meant_by(step);
    for (int i = 0; i < o->n; i++) {
        const double t = o->t[i], n = round((t - origin.x) / step);
        *first = t;
        if (!(fabs(meant_sum(&origin, n, &h) - t) <= SAME * t)) return false;
    }
    return !o->more;
}
