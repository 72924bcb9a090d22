/* force.c -- the table of kinds; see force.h */
#include "kind/force.h"

#define FORCE_KIND(name) &force_##name,
static const struct force_kind *const kinds[] = {FORCE_KINDS(FORCE_KIND)};
enum { KINDS = sizeof kinds / sizeof *kinds };

const struct force_kind *force_kind_at(int i)
{
    return i >= 0 && i < KINDS ? kinds[i] : NULL;
}
