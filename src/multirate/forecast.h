/* forecast.h -- the predictor of `subcycle`: du and d_k with which a step begins its iteration, from the steps
 * before it.
 *
 * du/H: the difference of each coordinate from step to step is extrapolated by the linear recursion of fit.h, which
 * follows a fast vibration in du though that is sampled only once a major step.
 *
 * d_k: linear minor steps under a force,
 *
 *     M d_k/h + K_SS x_k+1/2 + K_SL y_k+1/2 + C v_k = phi_k.
 *
 * Before the first sweep phi is extrapolated from the last minor step with its trend over the last major step, which
 * is exact for a linear system under constant loads.  During the first sweep it is extrapolated by a parabola
 * through the minor steps just found.  At the start of a major step, where du/n, W and x jump, the parabola is
 * shifted by the jump of phi as subcycle_jump.c finds it; where that is not known, only the differences of phi are
 * carried over. */
#ifndef FMDSUB_MULTIRATE_FORECAST_H
#define FMDSUB_MULTIRATE_FORECAST_H

#include "base/arena.h"
#include "engine/fit.h"
#include "multirate/response.h"

/* The rest of the jump of phi between major steps, beyond subcycle_jump.c: predicted by a fit, and used where that
 * has proved to be better than nothing. */
struct leap {
    struct fit fit;
    double said, plain;   /* the prediction; phi without it */
    double with, without; /* squared errors of phi with and without it, exponentially averaged */
};

struct forecast {
    int ns, nl, ml;
    double *as, *dx, *vs;      /* [ns] last minor step: acceleration, displacement, mean velocity */
    double *y, *w;             /* [ml] half of its slow displacement, its slow velocity */
    double *trend;             /* [ns] rate of phi over the last major step */
    struct leap *leap;         /* [ns] */
    int leaps;                 /* predictions of `leap` are still to be compared with phi */
    struct fit_row fit;        /* of the differences of du/H */
    double *differs;           /* [room of fit] such differences */
    double *phi, *phi1, *phi2; /* [ns] of the last minor step, and its first and second difference */
    int kept;                  /* the step forecast last was accepted */
    int differences;           /* how many of phi have been seen */
    double *ay, *aybefore;     /* [nl] du/H of the last step and of the one before it */
    double H, Hbefore;         /* lengths of these [s] */
    double *c, *g;             /* [ns x 2], its second column; scratch as x, v and s [ns] */
    double *x, *v, *s;
    double *dy, *dw; /* [ml] */
};

/* A major step that has been found: its unknowns, dx of its last minor step, x_n at its end. */
struct found {
    double h, H;
    int ratio;
    const double *d, *du, *w, *dx, *xn;
};

void forecast_open(struct forecast *f, const struct decouple *dec, struct arena *life);
/* Begins anew, from consistent accelerations a0 [n] at v0 [n], u0 [nl] and a major step H. */
void forecast_forget(struct forecast *f, const struct decouple *dec, const double *a0, const double *v0,
                     const double *u0, double H);
/* A step begins: differences of phi from one that failed are not used. */
void forecast_begin(struct forecast *f);
/* Predicts du [nl] and d_k [ns x ratio] of the step of p from u0, v0. */
void forecast_make(struct forecast *f, const struct response *p, double *du, double *d, const double *u0,
                   const double *v0);
/* The local error of the step found, in units 1/per [n]: the largest of h/12 |a_k - a_k-1| summed over the minor
 * steps and H/12 |a_y - a_y,last|.  Before forecast_keep(). */
double forecast_error(const struct forecast *f, const struct found *x, const double *per);
/* Where a minor step starts. */
struct reached {
    const double *x, *v; /* [ns] displacements and velocities of the fast coordinates */
    const double *w;     /* [nl] velocities of the slow ones */
};

/* In the first sweep: d [ns] of minor step k, from there and phi extrapolated.  jump [ns x 3]: of phi and its differences at
 * k = 0; NULL: not known, and d of k = 0 stays as it is. */
void forecast_minor(struct forecast *f, const struct response *p, double *d, const struct reached *from,
                    const double *jump, int k);
/* After that minor step: its phi, from d as it was found.  rest [ns]: the residual of the fast rows, if d was
 * corrected once, by J; NULL: in any other way. */
void forecast_force(struct forecast *f, const struct response *p, const double *d, const struct reached *from,
                    const double *rest, int k);
void forecast_recall(struct forecast *f, struct recall *r);
/* The step found was accepted: the next one is predicted from it. */
void forecast_keep(struct forecast *f, const struct response *p, const struct found *x);

#endif
