/* forecast.c -- see forecast.h */
#include "multirate/forecast.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "la/dense.h"

void forecast_open(struct forecast *f, const struct decouple *dec, struct arena *life)
{
    *f = (struct forecast){.ns = dec->ns, .nl = dec->nl, .ml = dec->ml};
    double **fast[] = {&f->as, &f->dx, &f->vs, &f->trend, &f->phi, &f->phi1, &f->phi2, &f->x, &f->v, &f->s};
    double **known[] = {&f->y, &f->w, &f->dy, &f->dw};
    for (int i = 0; i < 10; i++) *fast[i] = TAKE(life, double, f->ns);
    for (int i = 0; i < 4; i++) *known[i] = TAKE(life, double, f->ml);
    f->c = TAKE_MATRIX(life, double, f->ns, 2);
    f->g = f->c + f->ns;
    fit_row_open(&f->fit, f->nl, life);
    f->differs = TAKE(life, double, f->fit.room);
    f->leap = TAKE(life, struct leap, f->ns);
    f->ay = TAKE(life, double, f->nl);
    f->aybefore = TAKE(life, double, f->nl);
}

void forecast_forget(struct forecast *f, const struct decouple *dec, const double *a0, const double *v0,
                     const double *u0, double H)
{
    copy(f->as, a0, f->ns);
    copy(f->vs, v0, f->ns);
    zero(f->dx, f->ns);
    zero(f->trend, f->ns);
    copy(f->ay, a0 + f->ns, f->nl);
    decouple_recoil(dec, f->ay, 1, a0);
    copy(f->aybefore, f->ay, f->nl);
    zero(f->y, f->ml);
    copy(f->w, u0, f->ml);
    f->H = f->Hbefore = H;
    fit_row_forget(&f->fit);
    for (int i = 0; i < f->ns; i++) f->leap[i] = (struct leap){{0}, 0, 0, 0, 0};
    f->kept = f->leaps = 0;
}

/* The driving by the slow coordinates: y and w - w_last constant, w H f_k as a ramp. */
static void slow_driving(struct forecast *f, const struct response *p, const double *w)
{
    int n = p->n, ns = p->ns, ml = p->ml;
    const double *KSL = p->one.K + (long)ns * n, *CSL = p->one.C + (long)ns * n;
    dense_gemv(f->c, p->h, KSL, f->y, ns, ml, n);
    dense_gemv(f->c, p->h, CSL, f->dw, ns, ml, n);
    dense_gemv(f->g, p->h * p->H, KSL, w, ns, ml, n);
}

void forecast_begin(struct forecast *f)
{
    if (!f->kept) {
        zero(f->phi1, f->ns);
        zero(f->phi2, f->ns);
        f->differences = 0;
    }
    f->kept = 0;
}

void forecast_make(struct forecast *f, const struct response *p, double *du, double *d, const double *u0,
                   const double *v0)
{
    int n = p->n, ns = p->ns;
    double h = p->h, s = (p->H + f->H) / (f->H + f->Hbefore);
    fit_row_next(&f->fit, f->differs);
    for (int i = 0; i < f->nl; i++) du[i] = p->H * (f->ay[i] + s * f->differs[i]);
    zero(f->c, ns);
    zero(f->g, ns);
    gemv_few(f->c, -h, p->Mss, f->as, ns, ns, ns);
    gemv_few(f->c, -h, p->one.C, f->vs, ns, ns, n);
    gemv_few(f->c, -h / 2, p->D, f->dx, ns, ns, ns);
    if (p->drives) {
        for (int i = 0; i < f->ml; i++) {
            f->dy[i] = u0[i] + du[i] / 2;
            f->dw[i] = f->dy[i] - f->w[i];
        }
        slow_driving(f, p, f->dy);
    }
    for (int i = 0; i < ns; i++) {
        f->x[i] = f->dx[i] / 2;
        f->c[i] -= h * f->trend[i] * h / 2;
        f->g[i] -= h * f->trend[i] * p->H;
    }
    copy(f->v, v0, ns);
    response_run(p, d, &(struct powers){f->c, 2}, f->x, f->v, f->s, 0);
}

/* c [ns] := K_SL y_k+1/2 + C_SL w of minor step k. */
APART void driving_at(struct forecast *f, double *c, const struct response *p, const double *w, int k)
{
    const int n = p->n, ns = p->ns, ml = p->ml;
    zero(c, ns);
    for (int i = 0; i < ml; i++) f->dy[i] = (k + .5) * p->h * w[i];
    gemv_few(c, 1, p->one.K + (long)ns * n, f->dy, ns, ml, n);
    gemv_few(c, 1, p->one.C + (long)ns * n, w, ns, ml, n);
}

static const double PROVED = .25; /* of squared errors: a prediction is used if it halves the error */
static const double FADE = .8;    /* of exponential averages */

/* Shifts phi and its differences by their jumps at the start of a major step. */
static void leap_ahead(struct forecast *f, const double *jump)
{
    for (int i = 0; i < f->ns; i++) {
        struct leap *o = &f->leap[i];
        o->said = fit_next(&o->fit);
        f->phi[i] += jump[i];
        f->phi1[i] += jump[i + f->ns];
        f->phi2[i] += jump[i + 2 * f->ns];
        o->plain = f->phi[i] + f->phi1[i] + f->phi2[i];
        if (o->with <= PROVED * o->without) f->phi[i] += o->said;
    }
    f->leaps = 1;
}

/* The prediction of the jump is compared with phi as it was found, f->g. */
static void leap_learn(struct forecast *f)
{
    for (int i = 0; i < f->ns && f->leaps; i++) {
        struct leap *o = &f->leap[i];
        const double miss = f->g[i] - o->plain, left = miss - o->said;
        o->with = FADE * o->with + left * left;
        o->without = FADE * o->without + miss * miss;
        fit_learn(&o->fit, miss);
    }
    f->leaps = 0;
}

INTO static inline void guess(int ns, double *restrict d, const double *restrict p, const double *restrict p1,
                              const double *restrict p2, double h)
{
    for (int i = 0; i < ns; i++) d[i] = h * (p[i] + p1[i] + p2[i]);
}

INTO static inline void minor(int ns, struct forecast *f, const struct response *p, double *restrict d,
                              const struct reached *o, int k)
{
    const struct minor *m = &p->one;
    guess(ns, d, f->phi, f->phi1, f->phi2, p->h);
    if (p->drives) {
        driving_at(f, f->c, p, o->w, k);
        for (int i = 0; i < ns; i++) d[i] -= p->h * f->c[i];
    }
    gemv_few(d, -p->h, m->K, o->x, ns, ns, p->n);
    gemv_few(d, -1, m->V, o->v, ns, ns, ns);
    minor_solve(m, d, ns);
}

/* J d_k = h { phi - K_SL y_k+1/2 - C_SL w - K_SS x_k } - V v_k. */
void forecast_minor(struct forecast *f, const struct response *p, double *d, const struct reached *from,
                    const double *jump, int k)
{
    if (k == 0 && !jump) return;
    if (k == 0) leap_ahead(f, jump);
    BY_FEW(minor, p->ns, f, p, d, from, k);
}

/* f->g := phi of d_k by the same equation. */
APART void force_of(struct forecast *f, const struct response *p, const double *d, const struct reached *o, int k)
{
    const struct minor *m = &p->one;
    int ns = p->ns;
    double per = 1 / p->h;
    zero(f->g, ns);
    if (p->drives) driving_at(f, f->g, p, o->w, k);
    gemv_few(f->g, 1, m->K, o->x, ns, ns, p->n);
    gemv_few(f->g, per, m->V, o->v, ns, ns, ns);
    gemv_few(f->g, per, m->S, d, ns, ns, ns);
    gemv_few(f->g, per, p->Mss, d, ns, ns, ns);
}

/* phi and its differences go on to what is found, rest [ns] beside what was guessed. */
INTO static inline void go_on(int ns, double *restrict p, double *restrict p1, double *restrict p2,
                              const double *restrict rest, double per)
{
    for (int i = 0; i < ns; i++) {
        const double phi = p[i] + (p1[i] + p2[i]) - per * rest[i], step = phi - p[i];
        p2[i] = step - p1[i];
        p1[i] = step;
        p[i] = phi;
    }
}

/* The same to phi as it stands in f->g.  At the first minor step it has jumped, and its differences are carried over. */
APART void go_on_anew(struct forecast *f, int k)
{
    if (k == 0) leap_learn(f);
    for (int i = 0; i < f->ns; i++) {
        const double step = k > 0 ? f->g[i] - f->phi[i] : f->phi1[i] + f->phi2[i];
        if (k > 0) f->phi2[i] = step - f->phi1[i];
        f->phi1[i] = step;
        f->phi[i] = f->g[i];
    }
}

void forecast_force(struct forecast *f, const struct response *p, const double *d, const struct reached *from,
                    const double *rest, int k)
{
    if (k > 0 && rest) {
        BY_FEW(go_on, p->ns, f->phi, f->phi1, f->phi2, rest, 1 / p->h);
    } else {
        force_of(f, p, d, from, k);
        go_on_anew(f, k);
    }
    if (k > 0 && f->differences == 0) zero(f->phi2, f->ns);
    f->differences += k > 0;
}

double forecast_error(const struct forecast *f, const struct found *x, const double *per)
{
    double worst = 0;
    for (int i = 0; i < f->ns; i++) {
        double sum = 0, before = x->h * f->as[i];
        for (int k = 0; k < x->ratio; k++) {
            double d = x->d[i + (long)k * f->ns];
            sum += fabs(d - before);
            before = d;
        }
        worst = larger(worst, sum / 12 * per[i]);
    }
    for (int i = 0; i < f->nl; i++) worst = larger(worst, fabs(x->du[i] - x->H * f->ay[i]) / 12 * per[f->ns + i]);
    return worst;
}

/* The rate of M as + K_SS x + K_SL y + C v from the last minor step of the major step before to that of this one. */
static void find_trend(struct forecast *f, const struct response *p, const struct found *x, const double *d)
{
    int n = p->n, ns = p->ns, ml = p->ml;
    for (int i = 0; i < ns; i++) {
        f->c[i] = d[i] / x->h - f->as[i];
        f->x[i] = x->xn[i] - x->dx[i] / 2 + f->dx[i] / 2;
        f->v[i] = x->dx[i] / x->h - f->vs[i];
    }
    zero(f->g, ns);
    gemv_few(f->g, 1, p->Mss, f->c, ns, ns, ns);
    gemv_few(f->g, 1, p->one.K, f->x, ns, ns, n);
    gemv_few(f->g, 1, p->one.C, f->v, ns, ns, n);
    if (p->drives) {
        for (int i = 0; i < ml; i++) {
            f->dy[i] = (x->H - x->h / 2) * x->w[i] + f->y[i];
            f->dw[i] = x->w[i] - f->w[i];
        }
        dense_gemv(f->g, 1, p->one.K + (long)ns * n, f->dy, ns, ml, n);
        dense_gemv(f->g, 1, p->one.C + (long)ns * n, f->dw, ns, ml, n);
    }
    for (int i = 0; i < ns; i++) f->trend[i] = f->g[i] / x->H;
}

void forecast_keep(struct forecast *f, const struct response *p, const struct found *x)
{
    const double *d = x->d + (long)(x->ratio - 1) * f->ns;
    find_trend(f, p, x, d);
    for (int i = 0; i < f->ns; i++) {
        f->as[i] = d[i] / x->h;
        f->dx[i] = x->dx[i];
        f->vs[i] = x->dx[i] / x->h;
    }
    double *before = f->aybefore, per = 1 / x->H;
    f->aybefore = f->ay;
    f->ay = before;
    for (int i = 0; i < f->nl; i++) {
        f->ay[i] = per * x->du[i];
        f->differs[i] = f->ay[i] - f->aybefore[i];
    }
    fit_row_learn(&f->fit, f->differs);
    for (int i = 0; i < f->ml; i++) {
        f->w[i] = x->w[i];
        f->y[i] = x->h / 2 * x->w[i];
    }
    f->Hbefore = f->H;
    f->H = x->H;
    f->kept = 1;
}

void forecast_recall(struct forecast *f, struct recall *r)
{
    recall_within(r, "forecast");
    recall_list(r, "as", f->as, f->ns);
    recall_list(r, "dx", f->dx, f->ns);
    recall_list(r, "vs", f->vs, f->ns);
    recall_list(r, "y", f->y, f->ml);
    recall_list(r, "w", f->w, f->ml);
    recall_list(r, "trend", f->trend, f->ns);
    fit_row_recall(&f->fit, r, "fit", f->nl);
    fits_recall(&f->leap->fit, r, "leap", f->ns, sizeof *f->leap);
    recall_each(r, "with", f->leap, with, f->ns);
    recall_each(r, "without", f->leap, without, f->ns);
    recall_list(r, "phi", f->phi, f->ns);
    recall_list(r, "phi1", f->phi1, f->ns);
    recall_list(r, "phi2", f->phi2, f->ns);
    recall_one(r, "kept", f->kept);
    recall_one(r, "differences", f->differences);
    recall_list(r, "ay", f->ay, f->nl);
    recall_list(r, "aybefore", f->aybefore, f->nl);
    recall_one(r, "H", f->H);
    recall_one(r, "Hbefore", f->Hbefore);
    recall_without(r);
}
