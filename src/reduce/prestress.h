/* prestress.h -- geometric stiffness from stiffness matrices made under loads.
 *
 * A particle moves by phi q + 1/2 q' S q, so a dead load of density b (per mass) adds to the stiffness
 *
 *     Kgeo = - int b . S dm
 *
 * and V' (K_prestressed - K) V gives it.  Loads of a frame in motion are b = - (its acceleration):
 *
 *     accel-x, -y, -z      b = - e_k                 Kgeo = int S_k dm = s_k
 *     spin-xx, -yy, -zz    b = - e x (e x r)         Kgeo = sum_lm (e e' - 1)_lm X_lm,   X_lm = int r_l S_m dm
 *     spin-xy, -xz, -yz    the same about e = (e_k + e_l) / sqrt 2
 *     twist-x, -y, -z      b = - e_k x r             Kgeo = X_lm - X_ml,   klm cyclic
 *     force-k:NAME         1 N along k at an interface   Kgeo = - S_k of that node
 *
 * r is counted from the centre of mass.  Units of the loads: m/s2, rad2/s2, rad/s2, N.  The loads are put out as nodal
 * forces M b, so that signs and places cannot differ, and spin loads do not bring the softening - omega^2 M that
 * CENTRIF of CalculiX has.  The tangent of a bent body couples bending with stretch besides (stiffen.h): such matrices
 * are for loads that pull. */
#ifndef FMDSUB_REDUCE_PRESTRESS_H
#define FMDSUB_REDUCE_PRESTRESS_H

#include "flex/body.h"
#include "reduce/options.h"

/* Writes PREFIX-KIND.inp with *CLOAD lines for all kinds (force for every interface but the first); each scaled by a
 * power of ten that makes it move the body by about 1e-6 of its size, said on stderr and in the file: the strains of
 * second order that a turn of the elements brings would otherwise count as geometric stiffness (a thin blade's torsion
 * was off by a tenth at 1e-3, by 1e-4 at 1e-6). */
enum status loads_write(const char *prefix, const struct fe *fe, const struct tie *tie, int ntie, struct arena *life,
                        struct report *report);

/* Fills s, xs and S of body from the matrices asked for; says on stderr what is missing. */
enum status prestress_read(struct flex_body *body, const struct options *options, const struct fe *fe,
                           const struct basis *basis, const struct tie *tie, struct arena *life, struct report *report);

#endif
