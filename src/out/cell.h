/* cell.h -- one value of a row as text, the same for all writers. */
#ifndef FMDSUB_OUT_CELL_H
#define FMDSUB_OUT_CELL_H

#include <math.h>
#include <string.h>

#include "out/number.h"

/* x, or `none` when it is not finite; returns the end.  At most NUMBER_MOST bytes. */
static inline char *cell_put(char *to, double x, const char *none)
{
    if (isfinite(x)) return to + number_write(to, x);
    size_t length = strlen(none);
    memcpy(to, none, length);
    return to + length;
}

#endif
