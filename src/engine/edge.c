/* edge.c -- see edge.h */
#include "engine/edge.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/passing.h"
#include "engine/sides.h"

/* What a step with y of it beyond an edge is off by in velocity i. */
static double edge_off(const struct adaptive *m, double y, int i)
{
    return m->came * y * (m->ahead[i] - m->a[i]) / 2;
}

/* The same of all, in scales of the deck's tolerance: those of a scheme that goes on from a value of higher order are
 * wider, which over an edge it is not. */
static double edge_error(const struct stepper *s, const struct adaptive *m, double y)
{
    const double h = fabs(m->came), wider = larger(1, m->tolerance / s->options.tolerance);
    const int n = s->ode->n;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        const double ev = edge_off(m, y, i);
        const double in_v = ev / adaptive_scale_v(s, i), in_q = h * ev / adaptive_scale_q(s, i);
        sum += in_v * in_v + in_q * in_q;
    }
    return wider * sqrt(sum / (2 * n));
}

/* Of a way to x: close before it. */
static double close_before(double x)
{
    static const double NEARER = 1e-3, LEAST = 1e-9;
    return x * (1 - larger(NEARER * (1 - x), LEAST));
}

/* Of a way on which something comes and goes behind x, of which its end does not tell. */
static double shorter(double x)
{
    return x > 0 ? smaller(.5, close_before(x)) : .5;
}

/* A jump, or several, in a trial of that error: over it, where that may be, or close before it.  By
 * what accelerations change is known what one jump does, not several.  Where two trials have ended close before it
 * and the next one, of a large error, finds it at its end again, it is too long to tell where a jump is. */
static double leap(const struct stepper *s, struct adaptive *m, const struct edge *edge, double err)
{
    static const double PART = .01 /* of the tolerance, for each */, SURE = .9, ROOM = 2, APART = 1e-6, NEAR = .01,
                        MOST = 10, END = .9;
    const double own = edge_error(s, m, 1) / PART, x = edge->at, last = edge->last;
    const bool again = m->jumps > 1 && x > END && err > MOST;
    m->jumps++;
    if (m->held == 0) m->held = m->h;
    if (last > x + APART) return x > NEAR ? close_before(x) : x + (last - x) / 2;
    m->leaps = own <= 1 && err <= MOST;
    m->beyond = m->leaps;
    if (m->leaps) return 1;
    if (own <= 1 || again) return .5;
    return SURE / own > ROOM * x ? SURE / own : close_before(x);
}

/* The edge of the trial: of values that tell sides, or where a push begins or ends, as ode2's edge() has it. */
static struct edge edge_in(const struct adaptive *m, const struct ode2 *o, const struct state *from,
                           const struct state *to)
{
    struct edge side = {.at = NAN, .comes = 1}, push = {.at = NAN};
    if (!m->ahead) return side;
    if (m->sides) side = sides_edge(m->sides, from, to);
    if (!o->passed) return side;
    push.at = push.last = o->edge(o, &push.kind);
    if (!isfinite(push.at)) return side;
    push.beyond = 2 * (1 - push.at);
    push.comes = side.comes;
    if (push.kind != side.kind) return push.kind > side.kind ? push : side;
    const bool other = push.kind == EDGE_BEND ? fabs(side.at - .5) < fabs(push.at - .5) : side.at < push.at;
    return other ? side : push;
}

/* Does it turn farther than is looked at, or pass over a touch of which its ends do not tell? */
static bool goes_far(const struct adaptive *m, const struct ode2 *o, const struct state *from, const struct state *to)
{
    const int parts = m->sides || m->passing ? passing_parts(o, from, to) : 1;
    return parts > PASSING_PARTS || (parts > 1 && m->passing && passing_may(m->passing, from, to));
}

double edge_cut(const struct stepper *s, struct adaptive *m, double t, double err, double share)
{
    static const double BEHIND = .1; /* of what the error may be: how far to go beyond */
    static const double
        FIRST = .001,
        END = .9; /* between them, or where its own is large, the edge is taken for what makes the error */
    const struct ode2 *o = s->ode;
    const struct state from = {t, m->q, m->v, m->a}, to = {t + m->came, m->q1, m->v1, m->ahead};
    const struct instant a = {.t = t, .q = m->q, .v = m->v}, b = {.t = t + m->came, .q = m->q1, .v = m->v1};
    const enum met met = o->passed ? o->passed(o, &a, NULL, &b) : MET_NOT;
    const struct edge edge = edge_in(m, o, &from, &to);
    const double x = edge.at;
    if (edge.kind == EDGE_JUMP) return leap(s, m, &edge, err);
    if (edge.kind == EDGE_PULSE && x > 0) return shorter(x);
    const bool bends = edge.kind == EDGE_BEND;
    const double y = bends ? smaller(x, .5 * edge.beyond) : 0, own = bends ? edge_error(s, m, y) / share : 0;
    const bool blamed = bends && edge.located && x < END && (x > FIRST || own > 1);
    if (err > 1 && !blamed) return 1;
    if (met != MET_NOT || edge.kind == EDGE_PULSE || goes_far(m, o, &from, &to)) return .5;
    if (!bends) return 1;
    m->beyond = y;
    if (own > 1 || err > 1) return x + BEHIND * (1 - x) / larger(1, own);
    return edge.comes < 1 ? shorter(edge.comes) : 1;
}

void edge_add(const struct adaptive *m, double *position, double *velocity, int n)
{
    if (!(m->beyond > 0)) return;
    for (int i = 0; i < n; i++) {
        const double ev = fabs(edge_off(m, m->beyond, i));
        velocity[i] = fabs(velocity[i]) + ev;
        position[i] = fabs(position[i]) + fabs(m->came) * ev;
    }
}
