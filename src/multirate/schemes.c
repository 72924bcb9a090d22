/* schemes.c -- all schemes by name */
#include "multirate/schemes.h"

#include <string.h>

extern const struct stepper_kind step_subcycle, step_newmark, step_midpoint, step_miao, step_rk4, step_dopri5;

const struct stepper_kind *const stepper_kinds[] = {
    &step_subcycle, &step_newmark, &step_midpoint, &step_miao, &step_rk4, &step_dopri5, NULL,
};

const struct stepper_kind *stepper_find(const char *name)
{
    for (int i = 0; stepper_kinds[i]; i++)
        if (strcmp(stepper_kinds[i]->name, name) == 0) return stepper_kinds[i];
    return NULL;
}
