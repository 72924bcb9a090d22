/* forecast.c -- see forecast.h */
#include "engine/forecast.h"

#include <math.h>

#include "engine/motion.h"
#include "la/dense.h"

void forecast_open(struct forecast *f, const struct decouple *dec, struct arena *life)
{
    *f = (struct forecast){.ns = dec->ns, .nl = dec->nl, .ml = dec->ml};
    double **fast[] = {&f->as, &f->dx, &f->vs, &f->trend, &f->c, &f->g, &f->x, &f->v, &f->s};
    double **known[] = {&f->y, &f->w, &f->dy, &f->dw};
    for (int i = 0; i < 9; i++) *fast[i] = TAKE(life, double, f->ns);
    for (int i = 0; i < 4; i++) *known[i] = TAKE(life, double, f->ml);
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

void forecast_make(struct forecast *f, const struct response *p, double *du, double *d, const double *u0,
                   const double *v0)
{
    int n = p->n, ns = p->ns;
    double h = p->h, s = (p->H + f->H) / (f->H + f->Hbefore);
    for (int i = 0; i < f->nl; i++) du[i] = p->H * (f->ay[i] + s * (f->ay[i] - f->aybefore[i]));
    zero(f->c, ns);
    zero(f->g, ns);
    dense_gemv(f->c, -h, p->Mss, f->as, ns, ns, ns);
    dense_gemv(f->c, -h, p->one.C, f->vs, ns, ns, n);
    dense_gemv(f->c, -h / 2, p->D, f->dx, ns, ns, ns);
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
    response_run(p, d, f->c, f->g, f->x, f->v, f->s, 0);
}

double forecast_error(const struct forecast *f, const struct found *x, const double *per)
{
    double worst = 0;
    for (int i = 0; i < f->ns; i++) {
        double sum = 0, before = x->h * f->as[i];
        for (int k = 0; k < x->ratio; k++) {
            double d = x->d[i + k * f->ns];
            sum += fabs(d - before);
            before = d;
        }
        worst = fmax(worst, sum / 12 * per[i]);
    }
    for (int i = 0; i < f->nl; i++) worst = fmax(worst, fabs(x->du[i] - x->H * f->ay[i]) / 12 * per[f->ns + i]);
    return worst;
}

/* M as + K_SS x + K_SL y + C v has changed over the major step, between its last minor step and the one
 * before it. */
static void find_trend(struct forecast *f, const struct response *p, const struct found *x, const double *d)
{
    int n = p->n, ns = p->ns, ml = p->ml;
    for (int i = 0; i < ns; i++) {
        f->c[i] = d[i] / x->h - f->as[i];
        f->x[i] = x->xn[i] - x->dx[i] / 2 + f->dx[i] / 2;
        f->v[i] = x->dx[i] / x->h - f->vs[i];
    }
    zero(f->g, ns);
    dense_gemv(f->g, 1, p->Mss, f->c, ns, ns, ns);
    dense_gemv(f->g, 1, p->one.K, f->x, ns, ns, n);
    dense_gemv(f->g, 1, p->one.C, f->v, ns, ns, n);
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
    const double *d = x->d + (x->ratio - 1) * f->ns;
    find_trend(f, p, x, d);
    for (int i = 0; i < f->ns; i++) {
        f->as[i] = d[i] / x->h;
        f->dx[i] = x->dx[i];
        f->vs[i] = x->dx[i] / x->h;
    }
    double *before = f->aybefore;
    f->aybefore = f->ay;
    f->ay = before;
    for (int i = 0; i < f->nl; i++) f->ay[i] = x->du[i] / x->H;
    for (int i = 0; i < f->ml; i++) {
        f->w[i] = x->w[i];
        f->y[i] = x->h / 2 * x->w[i];
    }
    f->Hbefore = f->H;
    f->H = x->H;
}
