/* stiffen.h -- geometric stiffness of all loads from the stress they make.
 *
 *     Kgeo_ij = int grad phi_i : (grad phi_j sigma) dV
 *
 * with sigma the linear answer to the unit load, the reference held (Bathe, Finite Element Procedures, 6.2; Wallrapp &
 * Schwertassek, Int. J. Numer. Meth. Eng. 32 (1991) 1833).  This is the stress alone.  The tangent stiffness of an FE
 * code has besides it what the turning of the elements does to K, large where a load bends the body, of first order
 * between bending and stretch; second-order kinematics has that already, since its particles move on curves. */
#ifndef FMDSUB_REDUCE_STIFFEN_H
#define FMDSUB_REDUCE_STIFFEN_H

#include "reduce/basis.h"

/* G [nload] of [n x n] by load: those of loads.h, then forces x, y, z at tie 1, at tie 2, ...; E [Pa]. */
enum status stiffen_make(double **G, const struct fe *fe, const struct basis *basis, const struct tie *tie, int ntie,
                         double E, double nu, struct arena *life, struct report *report);

#endif
