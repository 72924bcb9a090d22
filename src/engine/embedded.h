/* embedded.h -- explicit Runge-Kutta methods whose last stage is the first of the next step, with steps of their own by
 * the error of embedded methods; see adaptive.h and rk.h */
#ifndef FMDSUB_ENGINE_EMBEDDED_H
#define FMDSUB_ENGINE_EMBEDDED_H

#include "engine/adaptive.h"

struct embedded_pair {
    struct adaptive_scheme scheme; /* first */
    struct rk_table table;
    /* e: weights less those of the embedded method.  e2, where it is not NULL, of a second one of lower order: the error
     * then is the first one's times |e| / sqrt(|e|^2 + |e2|^2 / 100), of an order higher than e alone would be. */
    const double *e, *e2;
    /* What that is for a harmonic motion in short steps, over e2 squared, both as parts of its size.  Where steps are long
     * for the motion, orders say nothing of one of them: e may be small by chance, or as large as what is left of the order
     * above it.  There e2 is large, and the error is taken to be at least what a harmonic motion with that e2 has. */
    double harmonic;
    /* In the part x of the step, with E_i = h sum d_ij k_j of `bends` rows d_i, by turns behind y and behind x,
     *
     *     y0 + x (D + y (B + x (D - h k_last - B + y (E_0 + x (E_1 + y (E_2 + ...)))))),   D = y1 - y0,  B = h k_0 - D,  y = 1 - x
     *
     * (Shampine 1986; Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.6).  The slopes k_j are those of
     * all stages of the scheme: the ones behind the step's own have rows in its table, too, and are found where there are
     * records in the step. */
    int bends;
    const double (*d)[RK_STAGES];
    /* h := h clip(0.9 err^-here err_old^before, least, most); err^-fail after a step that failed. */
    double here, before, fail, least, most;
    /* Errors of steps are held against part tol^power, where that is less than the tolerance and part is not 0: what steps
     * leave goes with a higher power of the tolerance than the first, and a motion whose phase drifts makes more of it. */
    double part, power;
    /* What is found over the estimate, made sharper; measured (`make trust`). */
    double less;
};

/* All slots of the scheme but stages and order. */
#define EMBEDDED                                                                                                       \
    .open = embedded_open, .attempt = embedded_attempt, .take = embedded_take, .shrink = embedded_shrink,              \
    .grow = embedded_grow, .off = embedded_off, .sizes_only = true, .drifts = 1
void embedded_open(struct stepper *s, struct adaptive *m, struct arena *life);
enum status embedded_attempt(struct stepper *s, struct adaptive *m, double *err, double t, double h,
                             struct trouble *why);
void embedded_take(struct stepper *s, struct adaptive *m, double h);
enum status embedded_ready(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why);
void embedded_between(const struct stepper *s, const struct adaptive *m, double *u, double *v, double x);
void embedded_off(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h);
double embedded_shrink(const struct adaptive *m, double err);
double embedded_grow(const struct adaptive *m, double err);

#endif
