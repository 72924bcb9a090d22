/* rk.h -- one explicit Runge-Kutta step of (2-4) in a chart of the positions.
 *
 * With q = q0 (+) u the state of the step is (u, v) from (0, v0):
 *
 *     u' = rate(u, v),   v' = M^-1 Q^(q0 (+) u, v, t)
 *
 * For rotations rate() is the inverse tangent of the chart, exact, so that a method of order p stays of
 * order p (Munthe-Kaas 1999; Hairer, Lubich & Wanner, Geometric Numerical Integration, IV.8). */
#ifndef FMDSUB_ENGINE_RK_H
#define FMDSUB_ENGINE_RK_H

#include "base/arena.h"
#include "engine/accel.h"

enum { RK_STAGES = 16 };

struct rk_table {
    int stages;
    double c[RK_STAGES];
    double a[RK_STAGES][RK_STAGES];
    double b[RK_STAGES];
};

struct rk {
    int stages;
    const struct ode2 *ode;
    struct accel *accel;
    double *du[RK_STAGES], *dv[RK_STAGES]; /* [n] stage slopes */
    double w[RK_STAGES][POWER_CHANNELS];
    double *u, *v, *q; /* the stage under way */
};

/* For tables of so many stages. */
void rk_open(struct rk *k, int stages, const struct ode2 *ode, struct accel *accel, struct arena *life);

/* Stage i from q0, v0 and the slopes before it; step h from t. */
enum status rk_stage(struct rk *k, const struct rk_table *table, int i, const double *q0, const double *v0, double t,
                     double h, struct trouble *why);

/* x := the end of the step with the weights b, work (NULL: not wanted) added. */
void rk_end(struct rk *k, const struct rk_table *table, double *q, double *v, double *work, double t, double h);

#endif
