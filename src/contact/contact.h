/* contact.h -- gaps of rigid contacts on a tree, their gradients (rows of the contact Jacobian), and forces along
 * these.
 *
 *     stop              g = side (s - limit)              of a joint's coordinate s
 *     sphere, plane     g = n . (x_a - x_b) - r           n fixed in body b; a point is a sphere with r = 0
 *     spheres           g = |x_a - x_b| - r_a - r_b
 *     sphere in a hole  g = r_b - r_a - |x_a - x_b|
 *     disc, outline     g = n . (x_a - c) - r           c the nearest point of the curve, n its normal there
 *     joint             none: g = 0, and friction along its coordinate
 *
 * With n the direction in which the gap opens for body a and c the place where they touch,
 *
 *     g' = n . (v_a - v_b),   v the velocity of each body at c,
 *
 * and friction acts along the relative velocity there across n: in the plane along (n_y, -n_x), in space along two
 * directions at right angles. */
#ifndef FMDSUB_CONTACT_CONTACT_H
#define FMDSUB_CONTACT_CONTACT_H

#include "base/arena.h"
#include "model/model.h"
#include "tree/sweep.h"

struct contacts;

/* The contacts of the model; ops: of the sweeps that they are asked with. */
struct contacts *contacts_build(const struct model *m, const struct sweep_ops *ops, struct arena *life);

/* Rows of one contact: the normal one, and with friction 1 or 2 tangential ones. */
static inline int contact_rows(const struct model_contact *c)
{
    return 1 + c->across;
}

/* A usual size of the gap of contact c: 1 rad, or `length` [m]; of surfaces at least their own sizes, which set the
 * round-off. */
double contact_size(const struct model_contact *c, double length);

/* The gap of contact i [m] or [rad], with the bodies of the sweep placed at q. */
double contacts_gap(const struct contacts *o, const struct sweep *s, int i, const double *q);
/* y [1 + across][n of the model] := its rows. */
void contacts_rows(const struct contacts *o, const struct sweep *s, double *y, int i);
/* Applies forces f [1 + across] along its rows to the bodies of the sweep; those along coordinates are subtracted
 * from r [n]. */
void contacts_push(const struct contacts *o, struct sweep *s, double *r, int i, const double *f);

#endif
