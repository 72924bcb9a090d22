/* forecast.h -- where a step of subcycle begins its iteration, from the steps before it.
 *
 * du/H: each coordinate's differences from step to step go on by the recursion of fit.h: what the fast vibration puts
 * into du is sampled once a major step.
 *
 * d_k: linear minor steps under a force,
 *
 *     M d_k/h + K_SS x_k+1/2 + K_SL y_k+1/2 + C v_k = phi_k.
 *
 * Before the first sweep phi goes on from the last minor step with its trend over the last major step, which is exact
 * for a linear system under constant loads.  In the first sweep phi goes on from the minor steps that have just been
 * found, by a parabola; from step to step, where du/n, W and x jump, by what is known of the jump (subcycle_jump.c) or,
 * where nothing is, only its differences do. */
#ifndef FMDSUB_MULTIRATE_FORECAST_H
#define FMDSUB_MULTIRATE_FORECAST_H

#include "base/arena.h"
#include "engine/fit.h"
#include "multirate/response.h"

/* What phi jumps by from one major step to the next besides what is known of it: foreseen where that has proved. */
struct leap {
    struct fit fit;
    double said, plain;   /* what was expected; phi without it */
    double with, without; /* squares of what was left with it and without it, older ones fading */
};

struct forecast {
    int ns, nl, ml;
    double *as, *dx, *vs;      /* [ns] the last minor step: acceleration, displacement, mean velocity */
    double *y, *w;             /* [ml] half of its slow displacement, its slow velocity */
    double *trend;             /* [ns] rate of the force that the linear model does not know */
    struct leap *leap;         /* [ns] */
    int leaps;                 /* the leap of the step under way is still to be learned from */
    struct fit *fit;           /* [nl] */
    double *phi, *phi1, *phi2; /* [ns] of the last minor step, its first and second difference */
    int kept;                  /* the step foreseen last was accepted */
    int differences;           /* that have been seen */
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
/* In the first sweep: d [ns] of minor step k from x, v [ns] at its start; of k = 0 where the jumps [ns x 3] of phi and of
 * its differences are known, else (NULL) it stays as it is; then phi for d as it was found, after one correction by J of
 * the rest [ns] of the fast rows (NULL: however). */
void forecast_minor(struct forecast *f, const struct response *p, double *d, const double *x, const double *v,
                    const double *w, const double *jump, int k);
void forecast_force(struct forecast *f, const struct response *p, const double *d, const double *x, const double *v,
                    const double *w, const double *rest, int k);
void forecast_recall(struct forecast *f, struct recall *r);
void forecast_keep(struct forecast *f, const struct response *p, const struct found *x);

#endif
