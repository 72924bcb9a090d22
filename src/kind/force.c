/* force.c -- the table of kinds; see force.h */
#include "kind/force.h"

#include "kind/bushing.h"
#include "kind/spring.h"

static const struct force_kind *const kinds[] = {&force_bushing, &force_spring, &force_damper};
enum { KINDS = sizeof kinds / sizeof *kinds };

const struct force_kind *force_kind_at(int i)
{
    return i >= 0 && i < KINDS ? kinds[i] : NULL;
}
