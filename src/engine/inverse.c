/* inverse.c -- see inverse.h */
#include "engine/inverse.h"

#include <math.h>

#include "engine/motion.h"
#include "la/dense.h"
#include "la/wide.h"

enum { MOST = 64 }; /* coordinates: above, a factor costs a third of an inverse, and may have zeros that cost nothing */

static const double POOR = .3; /* what a correction may leave of the energy of itself where it shows the slope of r */
/* A step, of what has been learnt: what is not seen again is out of date; none: suspension +7, bearing's rows 10 times as far
 * from converged ones, heavy-top -17; twice: flexible-crank 0, heavy-top +2. */
static const double FADES = .01;
static const double FORETOLD = .25; /* square of what a line may miss the next inverse by, against standing still */

void inverse_open(struct inverse *o, const struct ode2 *ode, struct effort *effort, struct arena *life)
{
    const int n = ode->n;
    *o = (struct inverse){.h = 0};
    matrix_open(&o->J, ode, effort, life);
    if (n > MOST) return;
    double **all[] = {&o->B, &o->F, &o->S};
    for (int i = 0; i < 3; i++) *all[i] = TAKE_MATRIX(life, double, n, n);
    o->x = TAKE(life, double, n);
}

void inverse_forget(struct inverse *o)
{
    o->formed = 0;
    o->moves = false;
}

/* Squares of how far F + s S and F are from N, as J measures them. */
static void compare(const struct inverse *o, const double *N, double s, double *line, double *still)
{
    const int n = o->J.ode->n;
    *line = *still = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int k = i + j * n;
            const double per = 1 / fabs(N[i * (n + 1)] * N[j * (n + 1)]), d = N[k] - o->F[k], e = d - s * o->S[k];
            *still += per * d * d;
            *line += per * e * e;
        }
}

/* N, formed at t: F, S and whether S would have foretold it. */
static void take(struct inverse *o, const double *N, double h, double t)
{
    const int nn = o->J.ode->n * o->J.ode->n;
    const double s = t - o->t;
    const bool goes_on = o->formed > 0 && h == o->h && s * h > 0;
    o->moves = false;
    if (goes_on && o->formed > 1) {
        double line, still;
        compare(o, N, s, &line, &still);
        o->moves = line < FORETOLD * still;
    }
    for (int k = 0; k < nn && goes_on; k++) o->S[k] = (N[k] - o->F[k]) / s;
    o->formed = goes_on ? 2 : 1;
    copy(o->F, N, nn);
    copy(o->B, N, nn);
    o->h = h;
    o->t = o->at = t;
}

enum status inverse_form(struct inverse *o, double h, double cc, double ck, const struct instant *x,
                         struct trouble *why)
{
    const int n = o->J.ode->n;
    TRY(matrix_factor(&o->J, cc, ck, x, why));
    o->serves = n <= MOST && o->J.form != MATRIX_DIRECT;
    if (!o->serves) return OK;
    double *N = o->J.spare;
    zero(N, n * n);
    for (int j = 0; j < n; j++) {
        N[j * (n + 1)] = 1;
        matrix_solve(&o->J, N + j * n);
    }
    take(o, N, h, x->t);
    return OK;
}

WIDE static void fade(double *restrict B, const double *restrict F, const double *restrict S, double along, int nn)
{
    for (int k = 0; k < nn; k++) B[k] += FADES * (F[k] - B[k]) + along * S[k];
}

void inverse_go(struct inverse *o, double t)
{
    const int nn = o->J.ode->n * o->J.ode->n;
    const double s = t - o->at, along = o->moves ? s + FADES * (o->at - o->t) : 0;
    if (!o->serves || s == 0) return;
    fade(o->B, o->F, o->S, along, nn);
    o->at = t;
}

void inverse_solve(struct inverse *o, double *x)
{
    const int n = o->J.ode->n;
    if (!o->serves) {
        matrix_solve(&o->J, x);
        return;
    }
    copy(o->x, x, n);
    zero(x, n);
    dense_gemv(x, 1, o->B, o->x, n, n, n);
}

/* B [n x n] += d s'/sy */
WIDE static void add_outer(double *restrict B, const double *restrict d, const double *restrict s, double sy, int n)
{
    for (int j = 0; j < n; j++) {
        const double f = s[j] / sy;
        for (int i = 0; i < n; i++) B[i + (long)n * j] += f * d[i];
    }
}

bool inverse_learn(struct inverse *o, double *d, const double *s, const double *r0, const double *r)
{
    const int n = o->J.ode->n;
    if (!o->serves) return false;
    const double before = dot(s, r0, n), after = dot(s, r, n), sy = before - after;
    if (!(fabs(after) < POOR * fabs(before))) return false;
    add_outer(o->B, d, s, sy, n);
    for (int i = 0; i < n; i++) d[i] *= 1 + after / sy;
    return true;
}

int inverse_drift(struct inverse *o, double *x, double h, const double *v, const double *a)
{
    const int n = o->J.ode->n, live = matrix_push(&o->J, x, h, v, a);
    if (!live) return 0;
    if (!o->serves) {
        matrix_solve(&o->J, x);
        return live;
    }
    copy(o->x, x, n);
    zero(x, n);
    dense_gemv(x, 1, o->F, o->x, n, n, n);
    if (o->moves) dense_gemv(x, o->at - o->t, o->S, o->x, n, n, n);
    return live;
}

enum status inverse_recall(struct inverse *o, struct recall *r)
{
    const int nn = o->J.ode->n * o->J.ode->n;
    TRY(matrix_recall(&o->J, r));
    recall_within(r, "inverse");
    recall_one(r, "serves", o->serves);
    if (o->serves) {
        recall_list(r, "learnt", o->B, nn);
        recall_list(r, "formed", o->F, nn);
        recall_list(r, "change", o->S, nn);
        recall_one(r, "h", o->h);
        recall_one(r, "t", o->t);
        recall_one(r, "at", o->at);
        recall_one(r, "known", o->formed);
        recall_one(r, "moves", o->moves);
    }
    recall_without(r);
    return OK;
}
