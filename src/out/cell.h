/* cell.h -- one value of a row as text, the same for all writers. */
#ifndef FMDSUB_OUT_CELL_H
#define FMDSUB_OUT_CELL_H

#include <string.h>

#include "out/number.h"

/* x, or `none` when it is not finite; returns the end.  At most NUMBER_MOST bytes. */
static inline char *cell_put(char *to, double x, const char *none)
{
    const int n = number_write(to, x);
    if (n) return to + n;
    const size_t length = strlen(none);
    memcpy(to, none, length);
    return to + length;
}

#endif
