/* measure.h -- what forces act along: scalar measures of the motion, their rates and gradients.
 *
 * A measure's gradient is a pair of opposite unit wrenches on its two bodies: with s' = dir . (relative
 * velocity), a force f along s does the work f s' and acts as f dir on b and as -f dir on a, both
 * at the world point `at` of b (or as torques).  So no measure creates momentum.  For
 *
 *     distance      s = |x_b - x_a|,         dir = (x_b - x_a)/s
 *     displacement  s = e . (x_b - x_a),     dir = e, fixed in body a; a is met at x_b, so that e's turning counts
 *     angle, plane  s = angle_b - angle_a    (continuous)
 *     angle, space  the twist about e of the turn of b against a since drawn, with unit quaternion (w, x):
 *                   s = 2 atan2(e.x, w),     dir = (w^2 e + w x cross e + (e.x) x) / (w^2 + (e.x)^2)  in axes of a
 *    in the world  the same of the turn Q that takes a to b, both as drawn, with e and dir in axes of the world: torques
 *                  f dir on b, -f Q'dir on a, s' = dir . (w_b - Q w_a); it alone keeps no angular momentum
 *
 * The last but one is from (w, x)' = (-W.x, w W + W cross x)/2 with W the relative angular velocity in axes of a.  Two
 * points in one place have no direction: dir is 0 then.  It is known up to whole turns, and is the one nearest to where
 * the angle stood at the end of the last step, so that it goes on through half a turn, and a spring winds up. */
#ifndef FMDSUB_FORCE_MEASURE_H
#define FMDSUB_FORCE_MEASURE_H

#include "base/arena.h"
#include "base/recall.h"
#include "model/model.h"
#include "tree/sweep.h"

/* A measure at one state. */
struct action {
    double s, rate;
    bool turning; /* dir is a torque's */
    int body_a, body_b;
    double dir[3];           /* world axes */
    double dir_a[3];         /* of a torque on a; else it is dir, too */
    double at_a[3], at_b[3]; /* world points of the two bodies where a force acts */
};

/* A sparse row vector over velocities: x is 0 and `on` false except at k[0..n). */
struct row {
    int n;
    int *k;    /* [n of the system] */
    bool *on;  /* likewise */
    double *x; /* likewise */
    double *g; /* likewise: work */
};

struct measures {
    const struct model *model;
    const struct sweep_ops *ops;
    double (*drawn)[9]; /* [nmeasure] space, angles: orientation of b in axes of a when drawn */
    double *stood;      /* [nmeasure] space, angles: at the end of the last step; in a plane of space: near which
                                 they begin [rad] */
    double *ahead;      /* [nmeasure] in a plane of space: whole turns that angles begin ahead of postures [rad] */
    double *went;       /* [nmeasure] their rates there [rad/s]; NAN: not known yet */
    double *seen;       /* [nmeasure] where they stand for the sweep `view`, which looks at other instants */
    double *passed;     /* [nmeasure] their rates there */
    bool turns;         /* there are angles in space */
    const struct sweep *view; /* NULL: there is none */
};

void measures_build(struct measures *o, const struct model *m, const struct sweep_ops *ops, struct arena *life);

/* The measure i at the sweep's last motion; a coordinate's s and rate only. */
void measure_at(struct action *o, const struct measures *m, const struct sweep *s, int i, const double *q,
                const double *v);

/* At the start: in a plane of a scene in space, angles begin within half a turn of where they are set. */
void measures_begin(struct measures *o, const struct sweep *s);

/* Between steps: angles in space stand where they are at the sweep's last motion, dt after the one before; their rates at
 * both tell how many whole turns have been taken between.  Of the view these stand for themselves. */
void measures_turned(struct measures *o, const struct sweep *s, double dt);
/* The view's angles are those at the end of the last step. */
void measures_look(struct measures *o, const struct sweep *view);

void measures_recall(struct measures *o, struct recall *r);

/* Angle i in space stands at x [rad], or nearby. */
void measures_set(struct measures *o, int i, double x);

/* Pushes the sweep's bodies with f along the measure (not for coordinates). */
void action_push(const struct measures *m, struct sweep *s, const struct action *o, double f);

struct row row_make(int n, struct arena *life);
void row_clear(struct row *o);
static inline void row_add(struct row *o, int k, double x)
{
    if (!o->on[k]) {
        o->on[k] = true;
        o->k[o->n++] = k;
    }
    o->x[k] += x;
}

/* o += scale times the row of a force in direction dir at world point `at` (NULL: a torque) of the body. */
void row_add_body(struct row *o, const struct measures *m, const struct sweep *s, int body, const double *at,
                  const double *dir, double scale);
/* o += ds/d(quasi-displacements) of measure i; act: it at the sweep's last motion. */
void row_add_measure(struct row *o, const struct measures *m, const struct sweep *s, const struct action *act, int i);

#endif
