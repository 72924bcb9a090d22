/* broyden.c -- see broyden.h */
#include "engine/broyden.h"

#include <math.h>

#include "engine/motion.h"
#include "la/tiles.h"
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
    o->high = n > FEW ? 4 : n;
    o->ld = n > FEW ? tiles_rows(n) : n;
    double **all[] = {&o->B, &o->F, &o->S, &o->W};
    for (int i = 0; i < 4; i++) *all[i] = TAKE_MATRIX(life, double, o->ld, n);
    o->y = TAKE(life, double, o->ld);
    o->d = TAKE(life, double, o->ld);
    o->none = TAKE(life, double, o->ld);
}

void broyden_forget(struct broyden *o)
{
    o->formed = 0;
    o->moves = false;
}

/* Square of what an inverse leaves of an error, W = (inverse) J - I, as energy measures it: tr W W where J is symmetric. */
static double leaves(const double *W, int n, int ld)
{
    double sum = 0;
    for (int j = 0; j < n; j++) {
        sum += W[j * (ld + 1)] * W[j * (ld + 1)];
        for (int i = 0; i < j; i++) sum += 2 * fabs(W[i + j * ld] * W[j + i * ld]);
    }
    return sum;
}

/* A := what X [ld x n] has by column. */
static void by_tiles(const struct broyden *o, double *restrict A, const double *restrict X)
{
    const int n = o->J.ode->n, high = o->high;
    for (int t = 0; t < o->ld; t += high)
        for (int j = 0; j < n; j++, A += high)
            for (int i = 0; i < high; i++) A[i] = X[t + i + j * o->ld];
}

/* y [n] := A x */
static void times(const struct broyden *o, double *restrict y, const double *restrict A, const double *restrict x)
{
    const int n = o->J.ode->n;
    if (n > FEW) {
        tiles_times(o->y, o->none, A, x, o->ld, n);
        copy(y, o->y, n);
        return;
    }
    for (int i = 0; i < n; i++) {
        y[i] = A[i] * x[0];
        for (int j = 1; j < n; j++) y[i] += A[i + j * n] * x[j];
    }
}

/* Would the line F + s S have served for J, and much better than F? */
static bool foretells(const struct broyden *o, double s)
{
    const int n = o->J.ode->n, ld = o->ld;
    const double *J = o->J.spare;
    double *W = o->W;
    for (int j = 0; j < n; j++) {
        times(o, W + j * ld, o->F, J + j * n);
        W[j * (ld + 1)] -= 1;
    }
    const double still = leaves(W, n, ld);
    for (int j = 0; j < n; j++) {
        times(o, o->d, o->S, J + j * n);
        for (int i = 0; i < n; i++) W[i + j * ld] += s * o->d[i];
    }
    const double line = leaves(W, n, ld);
    return line < SERVES && line < FORETOLD * still;
}

/* B is new, formed at t: F, S and whether S would have foretold it. */
static void take(struct broyden *o, double h, double t)
{
    const int nn = o->ld * o->J.ode->n;
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
    TRY(matrix_factor(&o->J, cc, ck, x, why));
    o->serves = o->J.ode->n <= MOST && o->J.form != MATRIX_DIRECT;
    if (!o->serves) return OK;
    matrix_inverse(&o->J, o->W, o->ld);
    by_tiles(o, o->B, o->W);
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
    const double s = t - o->at;
    if (!o->serves) return false;
    if (s == 0 || !(o->learnt || o->moves)) {
        o->at = t;
        return o->moves;
    }
    const double along = o->moves ? s + FADES * (o->at - o->t) : 0;
    const int nn = o->ld * o->J.ode->n;
    o->at = t;
    if (nn > FEW * FEW)
        fade_wide(o->B, o->F, o->S, along, nn);
    else
        fade(o->B, o->F, o->S, along, nn);
    return o->moves;
}

void broyden_solve(struct broyden *o, double *d, const double *r)
{
    if (o->serves) {
        times(o, d, o->B, r);
        return;
    }
    copy(d, r, o->J.ode->n);
    matrix_solve(&o->J, d);
}

/* B += d f', d [ld], f [n]. */
WIDE static void add_outer(double *restrict B, const double *restrict d, const double *restrict f, int n, int ld)
{
    for (int t = 0; t < ld; t += 4)
        for (int j = 0; j < n; j++, B += 4)
            for (int i = 0; i < 4; i++) B[i] += f[j] * d[t + i];
}

/* B += d s'/sy */
static void teach(struct broyden *o, const double *restrict d, const double *restrict s, double sy)
{
    const int n = o->J.ode->n;
    double *restrict B = o->B, *restrict f = o->W;
    for (int j = 0; j < n; j++) f[j] = s[j] / sy;
    if (n > FEW) {
        copy(o->y, d, n);
        add_outer(B, o->y, f, n, o->ld);
        return;
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) B[i + j * n] += f[j] * d[i];
}

bool broyden_learn(struct broyden *o, double *d, const double *s, const double *r0, const double *r)
{
    const int n = o->J.ode->n;
    if (!o->serves) return false;
    const double before = dot(s, r0, n), after = dot(s, r, n), sy = before - after;
    if (!(fabs(after) < POOR * fabs(before))) return false;
    teach(o, d, s, sy);
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
    copy(o->W, x, n);
    times(o, x, o->F, o->W);
    if (!o->moves) return live;
    times(o, o->d, o->S, o->W);
    for (int i = 0; i < n; i++) x[i] += (o->at - o->t) * o->d[i];
    return live;
}

enum status broyden_recall(struct broyden *o, struct recall *r)
{
    const int nn = o->ld * o->J.ode->n;
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
