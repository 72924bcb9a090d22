/* price_table.h -- what the kernels of a step take, in instructions.  Written by `make prices WRITE=1` from counts by
 * callgrind (tests/bench/prices.sh); do not edit. */
#ifndef FMDSUB_STUDY_PRICE_TABLE_H
#define FMDSUB_STUDY_PRICE_TABLE_H

/* any, body, row, mode, pair, bent; structured in evaluations */
#define PRICE_PLANAR 1061, 520.8, 4409, 360.8, 15.24, 968.3, 1.449
#define PRICE_SPATIAL 1329, 1200, 3780, 998.3, 10.9, 1318, 1.354
/* balance, look in evaluations; full of n^3 */
#define PRICE_SHARED 1.622, 0.3535, 6.318

#endif
