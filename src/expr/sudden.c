/* sudden.c -- where a function of time alone becomes quick all at once, as a bell of a millisecond in an hour does.
 *
 * The run is halved until the ends of a piece show what it does there, by its bounds, or it does next to nothing.  Pieces of
 * the second kind that follow each other are one.  A piece much shorter than those before it is one that steps which suited
 * these would leave out: both of its ends are times to stop at.  Known corners are ends of pieces: what is between them is
 * smooth. */
#include <float.h>
#include <math.h>

#include "expr/expr.h"

static const double CALM = .05, SEEN = .05, PART = .5; /* of all that it does */
static const double SUDDEN = 1. / 8;                   /* of the pieces before */
static const double FORGETS = .8;                      /* of their length, with each piece */
enum { DEEPEST = 48, PARTS = 64, MOST_PASSES = 4 };

struct piece {
    double from, to, lo, hi; /* bounds of the value */
    double change;           /* from one end to the other */
};

struct look {
    const struct expr *e;
    long left;          /* pieces that may still be looked at */
    double whole;       /* all that it does */
    double least, most; /* values seen */
    struct piece calm;  /* of pieces that do next to nothing, which follow each
                         other; from = to: none */
    double before;      /* length of the pieces before, the latest for most */
    double *at;         /* [room] */
    int n, room;
};

static double value(struct look *o, double t)
{
    const double x = expr_value(o->e, &t);
    if (isfinite(x)) {
        o->least = fmin(o->least, x);
        o->most = fmax(o->most, x);
    }
    return x;
}

static bool bounds(struct piece *p, struct look *o)
{
    struct expr_span b;
    o->left--;
    if (!expr_span(&b, o->e, &p->from, &p->to) || !isfinite(b.lo) || !isfinite(b.hi)) return false;
    p->lo = b.lo;
    p->hi = b.hi;
    return true;
}

static bool is_calm(const struct look *o, double lo, double hi)
{
    return hi - lo <= CALM * o->whole;
}

/* Do its ends show what it does, and is that no more than a part of all? */
static bool is_seen(struct look *o, struct piece *p)
{
    const double a = value(o, p->from), b = value(o, p->to);
    p->change = fabs(b - a);
    return p->hi - p->lo <= PART * o->whole && p->hi - fmax(a, b) <= SEEN * o->whole &&
           fmin(a, b) - p->lo <= SEEN * o->whole;
}

static void stop_at(struct look *o, double t)
{
    if (!o->at || o->n == o->room || (o->n > 0 && o->at[o->n - 1] >= t)) return;
    o->at[o->n++] = t;
}

static void close_calm(struct look *o)
{
    if (!(o->calm.to > o->calm.from)) return;
    o->before = fmax(FORGETS * o->before, o->calm.to - o->calm.from);
    o->calm.from = o->calm.to;
}

/* What a corner or a part of the run has cut short, halved not at all, is not short for what it does. */
static void take(struct look *o, const struct piece *p, bool halved)
{
    const double length = p->to - p->from;
    if (is_calm(o, p->lo, p->hi)) {
        struct piece both = {o->calm.from, p->to, fmin(o->calm.lo, p->lo), fmax(o->calm.hi, p->hi), 0};
        const bool on = o->calm.to > o->calm.from && is_calm(o, both.lo, both.hi);
        if (!on) close_calm(o);
        o->calm = on ? both : *p;
        return;
    }
    if (p->change <= CALM / 5 * o->whole) return; /* its bounds are wide, that is all */
    close_calm(o);
    if (halved && length < SUDDEN * o->before) {
        stop_at(o, p->from);
        stop_at(o, p->to);
    }
    o->before = fmax(FORGETS * o->before, length);
}

static void look_into(struct look *o, double from, double to, int depth)
{
    struct piece p = {.from = from, .to = to};
    const double middle = from + (to - from) / 2;
    if (o->left <= 0 || !(middle > from && middle < to)) return;
    if (bounds(&p, o) && (is_calm(o, p.lo, p.hi) || is_seen(o, &p))) {
        take(o, &p, depth > 0);
        return;
    }
    (void)value(o, middle);
    if (depth == DEEPEST) return;
    look_into(o, from, middle, depth + 1);
    look_into(o, middle, to, depth + 1);
}

static double next_corner(const struct expr_corner *corner, int n, double t)
{
    double next = INFINITY;
    for (int i = 0; i < n; i++) next = fmin(next, expr_corner_next(&corner[i], t));
    return next;
}

/* What bounds of parts leave open; INFINITY: they know nothing. */
static double most_of(struct look *o, double from, double to)
{
    double lo = INFINITY, hi = -INFINITY;
    for (int i = 0; i < PARTS; i++) {
        struct piece p = {.from = from + i * (to - from) / PARTS, .to = from + (i + 1) * (to - from) / PARTS};
        (void)value(o, p.from);
        if (!bounds(&p, o)) continue;
        lo = fmin(lo, p.lo);
        hi = fmax(hi, p.hi);
    }
    return hi - lo;
}

/* Pieces between corners, as far as what is left goes. */
static void look_between(struct look *o, const struct expr_corner *corner, int n, double from, double to)
{
    for (double t = from, end; t < to && o->left > 0; t = end) {
        end = fmin(to, next_corner(corner, n, t));
        look_into(o, t, end, 0);
    }
}

/* Each part has its share of all looks, so that what is busy everywhere is
 * looked at everywhere. */
static void look_over(struct look *o, const struct expr_corner *corner, int n, double from, double to)
{
    enum { LOOKS = 5000, LEAST = 400 };
    long left = LOOKS;
    o->calm = (struct piece){from, from, 0, 0, 0};
    o->before = 0;
    o->n = 0;
    for (int i = 0; i < PARTS && left > 0; i++) {
        const long share = left / (PARTS - i) > LEAST ? left / (PARTS - i) : LEAST;
        left -= o->left = share < left ? share : left;
        look_between(o, corner, n, from + i * (to - from) / PARTS, from + (i + 1) * (to - from) / PARTS);
        left += o->left > 0 ? o->left : 0;
    }
}

/* Bounds of much may be far too wide: what is seen by them tells what it does.
 */
int expr_sudden(double *at, int room, const struct expr *e, const struct expr_corner *corner, int n, double from,
                double to)
{
    int slot[2] = {0, 0};
    if (expr_reads(e, slot, 2) != 1 || slot[0] != 0 || !(to > from)) return 0;
    struct look o = {.e = e, .least = INFINITY, .most = -INFINITY, .at = at, .room = room};
    o.whole = most_of(&o, from, to);
    for (int i = 0; i < MOST_PASSES && o.whole > 0 && isfinite(o.whole); i++) {
        look_over(&o, corner, n, from, to);
        const double seen = o.most - o.least;
        if (seen >= o.whole / 2) return o.n;
        o.whole = seen;
    }
    return o.whole > 0 && isfinite(o.whole) ? o.n : 0;
}
