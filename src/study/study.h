/* study.h -- what accuracy costs: one deck run by several schemes, ratios and steps.
 *
 * Errors are of the joint coordinates against a tight reference: at every record, relative to the largest
 * value of the coordinate, the worst of the fast ones and of the slow ones apart.  The reference is made twice,
 * by two different schemes; their difference tells what it is good for. */
#ifndef FMDSUB_STUDY_STUDY_H
#define FMDSUB_STUDY_STUDY_H

#include <stdio.h>

#include "out/table.h"
#include "sim/sim.h"

struct study_options {
    const char *version;
    FILE *log; /* progress of the study in words; NULL: silent */
    int nscheme, nratio, nstep;
    const char *const *scheme; /* [nscheme] */
    const int *ratio;          /* [nratio] for schemes of two rates; the others run at 1 */
    const double *step;        /* [nstep] minor steps [s] */
    int repeats;               /* each run is timed so often; the least counts */
};

/* Columns: scheme, ratio, step, error_fast, error_slow, cpu, cpu_ratio, slow, fast, factors, energy, status. */
enum status study_run(struct table **out, const struct scene *scene, const struct study_options *options,
                      struct diags *diags, struct arena *life, struct report *report);

#endif
