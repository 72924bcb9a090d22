/* beam_stress.h -- stresses at a place of a beam's section, by its modes. */
#ifndef FMDSUB_FLEX_BEAM_STRESS_H
#define FMDSUB_FLEX_BEAM_STRESS_H

#include "flex/beam.h"
#include "flex/rod.h"

/* Of modes Phi [freedoms x n]; Q [6 x n]: forces and moments in the section there, work. */
enum status beam_stress(struct flex_stress *o, const struct flex_beam *beam, const struct rod *rod, const double *Phi,
                        int n, const struct flex_probe *probe, double *Q, struct report *report);

#endif
