/* midpoint.h -- the implicit midpoint rule, also what sub-cycling is without fast coordinates. */
#ifndef FMDSUB_ENGINE_MIDPOINT_H
#define FMDSUB_ENGINE_MIDPOINT_H

#include "engine/implicit.h"

extern const struct implicit_scheme midpoint_rule;
extern const struct implicit_scheme midpoint_damped; /* with rho_infinity below 1: damped.c */
extern const struct stepper_kind step_midpoint;

#endif
