/* cone.c -- see cone.h */
#include "engine/cone_parts.h"
#include "engine/motion.h"

#include <math.h>

#include "base/scalar.h"

enum { SWEEPS = 4000, STALLED = 40, PATIENT = 100, LONG = 400 };
static const double EXACT = 1e-16, ENOUGH = 1e-12; /* of the rates, in a sweep that changes nothing */

static double rate(const double *p, const double *W, const double *u0, int i, int rows)
{
    double u = u0[i];
    for (int j = 0; j < rows; j++) u += W[i + j * rows] * p[j];
    return u;
}

/* p to x; by how much that moves its own rate. */
static double set(double *p, double x, double w)
{
    const double moved = fabs(x - *p) * w;
    *p = x;
    return moved;
}

static double normal(double *p, const double *W, const double *u0, const struct cone *c, int rows)
{
    const int i = c->row;
    const double w = W[i + i * rows], x = p[i] - rate(p, W, u0, i, rows) / w;
    return w > 0 ? set(&p[i], c->held ? x : larger(0, x), w) : 0;
}

/* Nothing moves it but a drive: friction follows. */
static double driven(double *p, const double *u, const struct cone *c, double most)
{
    const double size = hypot(u[0], u[1]);
    for (int k = 0; k < c->across; k++)
        p[k] = c->slides ? -most * c->slide[k] : size > 0 && !c->held && !c->sticks ? -most * (u[k] / size) : 0;
    return 0;
}

static double across(double *p, const double *W, const double *u0, const struct cone *c, int rows)
{
    double x[2] = {0}, w = 0, moved = 0;
    for (int k = 0; k < c->across; k++) {
        const int i = c->row + 1 + k;
        w = larger(w, W[i + i * rows]);
        x[k] = rate(p, W, u0, i, rows);
    }
    const double most = (c->held && !c->slides) || c->sticks ? INFINITY : c->mu * p[c->row] + c->preload;
    if (!(w > 0)) return driven(p + c->row + 1, x, c, most);
    for (int k = 0; k < c->across; k++) x[k] = c->slides ? -most * c->slide[k] : p[c->row + 1 + k] - x[k] / w;
    const double size = hypot(x[0], x[1]);
    for (int k = 0; k < c->across; k++)
        moved = larger(moved, set(&p[c->row + 1 + k], size > most && !c->slides ? x[k] * (most / size) : x[k], w));
    return moved;
}

void cone_open(struct cone_work *o, int rows, struct arena *life)
{
    double **of_rows[] = {&o->u, &o->r, &o->dp, &o->from, &o->centre, &o->kept};
    for (size_t i = 0; i < sizeof of_rows / sizeof *of_rows; i++) *of_rows[i] = TAKE(life, double, rows);
    o->A = TAKE_MATRIX(life, double, rows, rows);
    o->swap = TAKE(life, int, rows);
}

/* By Newton's method from here; p stays where that fails. */
static bool by_newton(double *p, const double *W, const double *u0, const struct cone *cone, int n, int rows,
                      double size, double rough, struct cone_work *work)
{
    copy(work->kept, p, rows);
    if (cone_newton(p, W, u0, cone, n, rows, size, rough, work)) return true;
    copy(p, work->kept, rows);
    return false;
}

bool cone_solve(double *p, const double *W, const double *u0, const struct cone *cone, int n, int rows, double size,
                double rough, struct cone_work *work)
{
    double moved = INFINITY, least = INFINITY;
    for (int k = 0, since = 0, next = PATIENT; k < SWEEPS && !(moved <= EXACT * size); k++) {
        if (k == next && moved > ENOUGH * size) {
            if (by_newton(p, W, u0, cone, n, rows, size, rough, work)) return true;
            next *= 2;
        }
        moved = 0;
        for (int i = 0; i < n; i++) {
            moved = larger(moved, normal(p, W, u0, &cone[i], rows));
            if (cone[i].across) moved = larger(moved, across(p, W, u0, &cone[i], rows));
        }
        if (!isfinite(moved)) return false;
        since = moved < .9 * least ? 0 : since + 1;
        least = smaller(least, moved);
        if (moved <= ENOUGH * size + (k > LONG ? rough : 0) && since > STALLED) break; /* round-off */
    }
    return moved <= ENOUGH * size + rough;
}
