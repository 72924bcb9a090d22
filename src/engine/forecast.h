/* forecast.h -- where a step of subcycle begins its iteration, from the steps before it.
 *
 * du goes on as its last two values.  d_k are linear minor steps under the force of the last one, whose
 * unknown part goes on with its trend over the last major step:
 *
 *     M d_k/h = M as - K_SS (x_k+1/2 - x_last) - K_SL (y_k+1/2 - y_last) - C (v_k - v_last) + trend (t - t_last)
 *
 * which is exact for a linear system under constant loads. */
#ifndef FMDSUB_ENGINE_FORECAST_H
#define FMDSUB_ENGINE_FORECAST_H

#include "base/arena.h"
#include "engine/response.h"

struct forecast {
    int ns, nl, ml;
    double *as, *dx, *vs;      /* [ns] the last minor step: acceleration, displacement, mean velocity */
    double *y, *w;             /* [ml] half of its slow displacement, its slow velocity */
    double *trend;             /* [ns] rate of the force that the linear model does not know */
    double *ay, *aybefore;     /* [nl] du/H of the last step and the one before it */
    double H, Hbefore;         /* their sizes */
    double *c, *g, *x, *v, *s; /* [ns] scratch */
    double *dy, *dw;           /* [ml] */
};

/* A major step that has been found: its unknowns, and at its last minor step dx, at its end xn. */
struct found {
    double h, H;
    int ratio;
    const double *d, *du, *w, *dx, *xn;
};

void forecast_open(struct forecast *f, const struct decouple *dec, struct arena *life);
/* From consistent accelerations a0 at v0, u0. */
void forecast_forget(struct forecast *f, const struct decouple *dec, const double *a0, const double *v0,
                     const double *u0, double H);
/* du and d_k of the step H = ratio h from u0, v0. */
void forecast_make(struct forecast *f, const struct response *p, double *du, double *d, const double *u0,
                   const double *v0);
/* Its local error, h/12 |a_k - a_k-1| summed and H/12 |a_y - a_y,last|, in units 1/per [n]; before keep(). */
double forecast_error(const struct forecast *f, const struct found *x, const double *per);
void forecast_keep(struct forecast *f, const struct response *p, const struct found *x);

#endif
