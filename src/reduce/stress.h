/* stress.h -- modal stresses at nodes.
 *
 * In every element at the node the stress of an isotropic material is taken at the reduced integration points, where
 * it is most accurate (Barlow, Int. J. Numer. Meth. Eng. 10 (1976) 243), extended linearly to the corners, at a node
 * between corners as their mean; the mean of all elements at the node counts.  So does CalculiX with C3D4, C3D10 and
 * C3D20R. */
#ifndef FMDSUB_REDUCE_STRESS_H
#define FMDSUB_REDUCE_STRESS_H

#include "flex/body.h"
#include "reduce/options.h"

/* s [6] xx yy zz xy xz yz at node `node` of the body under displacements u [3 fe->n] [m]; E [Pa].  E_MODEL where no
 * element there is known. */
enum status stress_at(double *s, const struct fe *fe, int node, const double *u, double E, double nu,
                      struct report *report);

/* The element's nodes x, and their numbers in the body; E_MODEL where it is of no known kind. */
enum status stress_element(int *node, double *x, const struct fe *fe, const struct mesh_element *e,
                           struct report *report);
/* s [6] of the displacement gradient g [9]. */
void stress_hooke(double *s, const double *g, double E, double nu);

/* Fills body->stress, one for every point wished for. */
enum status stress_make(struct flex_body *body, const struct options *options, const struct fe *fe,
                        const struct basis *basis, struct report *report);

#endif
