/* stepper.c -- the schemes by name, and what all of them share; see stepper.h */
#include "engine/stepper.h"

#include <string.h>

#include "engine/accel.h"
#include "engine/motion.h"

extern const struct stepper_kind step_subcycle, step_newmark, step_midpoint, step_miao, step_rk4, step_dopri5;

const struct stepper_kind *const stepper_kinds[] = {
    &step_subcycle, &step_newmark, &step_midpoint, &step_miao, &step_rk4, &step_dopri5, NULL,
};

const struct step_options step_defaults = {
    .beta = .25, .gamma = .5, .iteration = ITERATION_NEWTON, .rho_infinity = 1, .rtol = 1e-6, .atol = 1e-9};

const struct stepper_kind *stepper_find(const char *name)
{
    for (int i = 0; stepper_kinds[i]; i++)
        if (strcmp(stepper_kinds[i]->name, name) == 0) return stepper_kinds[i];
    return NULL;
}

void stepper_open(struct stepper *s, const struct stepper_kind *kind, const struct ode2 *ode,
                  const struct step_options *options, struct arena *life)
{
    *s = (struct stepper){.kind = kind, .ode = ode, .options = *options, .fresh = 1, .life = life};
    s->accel = TAKE(life, struct accel, 1);
    accel_open(s->accel, ode, &s->effort, life);
    kind->open(s, life);
}

/* A new chart, if there is a better one: what was known in the old one is forgotten. */
static void begin_anew(struct stepper *s, struct state *x)
{
    struct trouble why;
    struct ode2 *ode = (struct ode2 *)s->ode; /* the owner's, who lets it change here */
    if (ode->chart->rechart(ode, x->q, x->v, x->t)) stepper_start(s, x, &why);
}

enum status stepper_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    memset(s->work, 0, sizeof s->work);
    s->lost = s->left = 0;
    s->last_sweeps = 0;
    enum status status = s->kind->step(s, x, h, ratio, to, why);
    if (status == OK)
        s->effort.majors++;
    else
        s->effort.rejected++;
    if (status == OK && s->ode->chart && s->ode->chart->rechart) begin_anew(s, x);
    return status;
}

enum status stepper_start(struct stepper *s, struct state *x, struct trouble *why)
{
    s->fresh = 1;
    return accel_solve(s->accel, x->a, NULL, x->q, x->v, x->t, why);
}
