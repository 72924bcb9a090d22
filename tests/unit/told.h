/* told.h -- what a user would be shown. */
#ifndef FMDSUB_TESTS_TOLD_H
#define FMDSUB_TESTS_TOLD_H

#include <stdio.h>
#include <stdlib.h>

#include "deck/diag.h"

static inline const char *told(const struct diags *d, struct arena *arena)
{
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    diags_print(to, d, false);
    fclose(to);
    const char *copy = arena_copy(arena, text, size);
    free(text);
    return copy;
}

#endif
