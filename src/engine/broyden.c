/* broyden.c -- see broyden.h */
#include "engine/broyden.h"

#include <math.h>

#include "engine/motion.h"
#include "la/dense.h"
#include "la/wide.h"

/* Coordinates: above MOST a factor costs a third of an inverse, and may have zeros that cost nothing; up to FEW calls cost
 * more than they do. */
enum { MOST = 64, FEW = 4 };

static const double POOR = .3; /* what a correction may leave of the energy of itself where it shows the slope of r */
/* A step, of what has been learnt: what is not seen again is out of date; none: suspension +7, bearing's rows 10 times as far
 * from converged ones, heavy-top -17; twice: flexible-crank 0, heavy-top +2. */
static const double FADES = .01;
static const double SERVES = .1;    /* square of what a line may leave of an error */
static const double FORETOLD = .25; /* square of what a line may miss the next inverse by, against standing still */

void broyden_open(struct broyden *o, const struct ode2 *ode, struct effort *effort, struct arena *life)
{
    const int n = ode->n;
    *o = (struct broyden){.h = 0};
    matrix_open(&o->J, ode, effort, life);
    if (n > MOST) return;
    double **all[] = {&o->B, &o->F, &o->S, &o->W};
    for (int i = 0; i < 4; i++) *all[i] = TAKE_MATRIX(life, double, n, n);
    o->x = TAKE(life, double, n);
}

void broyden_forget(struct broyden *o)
{
    o->formed = 0;
    o->moves = false;
}

/* Square of what an inverse leaves of an error, W = (inverse) J - I, as energy measures it: tr W W where J is symmetric. */
static double leaves(const double *W, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++) {
        sum += W[j * (n + 1)] * W[j * (n + 1)];
        for (int i = 0; i < j; i++) sum += 2 * fabs(W[i + j * n] * W[j + i * n]);
    }
    return sum;
}

/* Would the line F + s S have served for J, and much better than F? */
static bool foretells(const struct broyden *o, double s)
{
    const int n = o->J.ode->n;
    const double *J = o->J.spare;
    zero(o->W, n * n);
    for (int j = 0; j < n; j++) {
        o->W[j * (n + 1)] = -1;
        dense_gemv(o->W + j * n, 1, o->F, J + j * n, n, n, n);
    }
    const double still = leaves(o->W, n);
    for (int j = 0; j < n; j++) dense_gemv(o->W + j * n, s, o->S, J + j * n, n, n, n);
    const double line = leaves(o->W, n);
    return line < SERVES && line < FORETOLD * still;
}

/* B is new, formed at t: F, S and whether S would have foretold it. */
static void take(struct broyden *o, double h, double t)
{
    const int nn = o->J.ode->n * o->J.ode->n;
    const double s = t - o->t;
    const bool goes_on = o->formed > 0 && h == o->h && s * h > 0;
    o->moves = goes_on && o->formed > 1 && foretells(o, s);
    for (int k = 0; k < nn && goes_on; k++) o->S[k] = (o->B[k] - o->F[k]) / s;
    o->formed = goes_on ? 2 : 1;
    copy(o->F, o->B, nn);
    o->learnt = false;
    o->h = h;
    o->t = o->at = t;
}

enum status broyden_form(struct broyden *o, double h, double cc, double ck, const struct instant *x,
                         struct trouble *why)
{
    const int n = o->J.ode->n;
    TRY(matrix_factor(&o->J, cc, ck, x, why));
    o->serves = n <= MOST && o->J.form != MATRIX_DIRECT;
    if (!o->serves) return OK;
    zero(o->B, n * n);
    for (int j = 0; j < n; j++) {
        o->B[j * (n + 1)] = 1;
        matrix_solve(&o->J, o->B + j * n);
    }
    take(o, h, x->t);
    return OK;
}

INTO static inline void fade(double *restrict B, const double *restrict F, const double *restrict S, double along,
                             int nn)
{
    for (int k = 0; k < nn; k++) B[k] += FADES * (F[k] - B[k]) + along * S[k];
}

WIDE static void fade_wide(double *B, const double *F, const double *S, double along, int nn)
{
    fade(B, F, S, along, nn);
}

bool broyden_go(struct broyden *o, double t)
{
    const int nn = o->J.ode->n * o->J.ode->n;
    const double s = t - o->at, along = o->moves ? s + FADES * (o->at - o->t) : 0;
    if (!o->serves) return false;
    if (s != 0 && (o->learnt || o->moves)) (nn > FEW * FEW ? fade_wide : fade)(o->B, o->F, o->S, along, nn);
    o->at = t;
    return o->moves;
}

/* x := B x */
static void times(struct broyden *o, const double *B, double *x)
{
    const int n = o->J.ode->n;
    if (n > FEW) {
        copy(o->x, x, n);
        zero(x, n);
        dense_gemv(x, 1, B, o->x, n, n, n);
        return;
    }
    double y[FEW];
    for (int i = 0; i < n; i++) {
        y[i] = 0;
        for (int j = 0; j < n; j++) y[i] += B[i + j * n] * x[j];
    }
    for (int i = 0; i < n; i++) x[i] = y[i];
}

void broyden_solve(struct broyden *o, double *x)
{
    if (o->serves)
        times(o, o->B, x);
    else
        matrix_solve(&o->J, x);
}

/* B [n x n] += d s'/sy */
WIDE static void add_outer(double *restrict B, const double *restrict d, const double *restrict s, double sy, int n)
{
    for (int j = 0; j < n; j++) {
        const double f = s[j] / sy;
        for (int i = 0; i < n; i++) B[i + (long)n * j] += f * d[i];
    }
}

bool broyden_learn(struct broyden *o, double *d, const double *s, const double *r0, const double *r)
{
    const int n = o->J.ode->n;
    if (!o->serves) return false;
    const double before = dot(s, r0, n), after = dot(s, r, n), sy = before - after;
    if (!(fabs(after) < POOR * fabs(before))) return false;
    add_outer(o->B, d, s, sy, n);
    o->learnt = true;
    for (int i = 0; i < n; i++) d[i] *= 1 + after / sy;
    return true;
}

int broyden_drift(struct broyden *o, double *x, double h, const double *v, const double *a)
{
    const int n = o->J.ode->n, live = o->J.nlive;
    if (!live) return 0;
    matrix_push(&o->J, x, h, v, a);
    if (!o->serves) {
        matrix_solve(&o->J, x);
        return live;
    }
    copy(o->x, x, n);
    times(o, o->F, x);
    if (o->moves) dense_gemv(x, o->at - o->t, o->S, o->x, n, n, n);
    return live;
}

enum status broyden_recall(struct broyden *o, struct recall *r)
{
    const int nn = o->J.ode->n * o->J.ode->n;
    TRY(matrix_recall(&o->J, r));
    recall_within(r, "broyden");
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
        recall_one(r, "taught", o->learnt);
    }
    recall_without(r);
    return OK;
}
