/* options.h -- how to step: one block of options for all schemes, and the deck keys that fill it.
 *
 * What a scheme reads of the block stands in its table of keys (stepper_kind.keys).  The reader, the range check,
 * `fmdsub list`, the schema and the manual find the key there.  A key of several schemes is written here, once.  Where
 * the keys of all schemes are shown together they stand in the order of the block's members. */
#ifndef FMDSUB_ENGINE_OPTIONS_H
#define FMDSUB_ENGINE_OPTIONS_H

#include "base/keys.h"

enum iteration { ITERATION_NEWTON, ITERATION_FIXED_POINT };

struct step_options {
    double rho_infinity; /* spectral radius for what the step does not resolve: 1 keeps it, 0 takes it out at once */
    double alpha;        /* of Hilber, Hughes and Taylor */
    double beta, gamma;  /* (2-5), (2-6) */
    int iteration;       /* enum iteration; fixed-point is (2-9) as printed */
    int order;           /* of schemes that can be composed: 2 or 4 */
    int most_order;      /* of those of an order of its own: 1 to 5 */
    int symmetric;       /* W at the average of both ends, second pass */
    int stage;           /* it is one of those of a step of order 4: set by engine/composed.c alone */
    double newton_tolerance; /* relative; 0: 1e-3 of the local error, at most 1e-8 of scale */
    /* Of schemes that take turns: sim/plan.c tells the end of the run [s], study/auto.c the price of factors of all coordinates
     * [evaluations], 0: none are taken, what an explicit scheme gains at most for an evaluation, where something stiff is at
     * rest or as trials foretell [s], and the first step of one of order 5 [s], each 0: not known; do forces bend or jump by the
     * state? */
    double until, matrix, gain, first;
    int bends;
    double tolerance; /* error of the motion, relative and in usual sizes: adaptive.h; 0: steps are fixed */
};

#define KEY_RHO_INFINITY                                                                                               \
    PARAM_REAL(struct step_options, rho_infinity, "rho_infinity", NULL, 0, 1, KEY_NEUTRAL | KEY_META, "1",             \
               "1 keeps all energy, less damps what 'step' cannot resolve")
#define KEY_NEWTON_TOLERANCE                                                                                           \
    PARAM_REAL(struct step_options, newton_tolerance, "newton_tolerance", NULL, 0, 1, 0, "0",                          \
               "relative; 0: a thousandth of the step's own error")

#define LEAST_TOLERANCE 1e-14
#define MOST_TOLERANCE 0.1
#define KEY_TOLERANCE                                                                                                  \
    PARAM_REAL(struct step_options, tolerance, "tolerance", NULL, LEAST_TOLERANCE, MOST_TOLERANCE, KEY_META, NULL,     \
               "error of the motion, relative; the steps are the scheme's own")

#endif
