/* loads.h -- unit loads by frame motion, and their names. */
#ifndef FMDSUB_REDUCE_LOADS_H
#define FMDSUB_REDUCE_LOADS_H

#include "reduce/tie.h"

enum { LOAD_ACCEL = 0, LOAD_SPIN = 3, LOAD_TWIST = 9, LOAD_KINDS = 12 };
extern const char *const load_names[LOAD_KINDS]; /* "accel-x", ..., "spin-xx", yy, zz, xy, xz, yz, "twist-x", ... */
int load_kind(const char *name);                 /* -1: none */
const char *load_list(void);                     /* all names, for messages */

/* f [3 fe->n] = M b [N]. */
void load_forces(double *f, const struct fe *fe, int kind, struct arena *scratch);
/* f of 1 N along k at an interface. */
void load_interface(double *f, const struct fe *fe, const struct tie *tie, int k);

#endif
