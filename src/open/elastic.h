/* elastic.h -- flexible bodies beside the sweep: their momentum, and what holds them together.  Stiffness and damping
 * of their coordinates q are matrices that do not depend on the state: V = q'K q/2, power -q1'D q1 with q1 = dq/dt,
 * slopes K and D.  Their forces are in the rows of the sweep's backward().  A body's belong to its class. */
#ifndef FMDSUB_OPEN_ELASTIC_H
#define FMDSUB_OPEN_ELASTIC_H

#include "base/arena.h"
#include "base/rate.h"
#include "flex/motion.h"
#include "model/model.h"
#include "tree/sweep.h"

struct elastic {
    int n;
    struct elastic_body *body; /* [n] the flexible bodies */
};

struct elastic_body {
    const struct model_body *model;
    int number; /* among the model's bodies */
    struct flex_kernel *kernel;
    struct flex_shape shape;
    double *q, *q1, *q2, *Q; /* [nmode] at hand */
    double *K, *C;           /* [nmode x nmode] */
    int band_K, band_D;      /* how far from the diagonal stiffness and damping have numbers */
};

void elastic_build(struct elastic *o, const struct model *m, struct arena *life);

/* Sum of q'K q/2 [J]. */
double elastic_stored(const struct elastic *o, const double *q);
/* Sum of v'D v of a class [W]: what damping takes. */
double elastic_lost(const struct elastic *o, const double *v, enum rate cls);
/* K and C [n x n] += those of a class; either may be NULL.  slot [of the model's velocities]: their places, NULL: as in the
 * model. */
void elastic_slopes(const struct elastic *o, double *K, double *C, int n, const int *slot, enum rate cls);
/* Has every coordinate of every flexible body a place? */
bool elastic_has_slots(const struct elastic *o, const int *slot);
bool elastic_in_class(const struct elastic_body *o, enum rate cls);
/* K and C [n x n] += what the inertia of one body takes more, by its coordinates and their rates, while its frame moves
 * as accelerate() has left it in the sweep: unsymmetric.  slot [of the model's velocities]: their places in K; x with a. */
void elastic_turning(struct elastic_body *o, double *K, double *C, int n, const int *slot, const struct sweep_ops *ops,
                     const struct sweep *s, const double *gravity, const struct instant *x);

/* p += momentum, L += angular momentum about the world's origin of a body whose frame moves so. */
void elastic_momentum(double *p, double *L, struct elastic_body *o, const struct pose *frame, const double *q,
                      const double *v);

/* Place, velocity, acceleration of the centre of mass of a flexible body, world axes; frame: the pose of its frame,
 * replaced.  q, v, a of the model, a NULL: no accelerations.  The body's momentum and the force it takes tell them. */
void elastic_centre(struct pose *frame, const struct elastic *o, int body, const double *q, const double *v,
                    const double *a);

#endif
