/* fourth.c -- see fourth.h */
#include "study/fourth.h"

#include <math.h>

#include "multirate/schemes.h"
#include "study/quick.h"
#include "study/race.h"

enum { LOOK = 100 }; /* evaluations */
static const double USUAL = 1e-4;

static void note(void *self, const struct sim *sim)
{
    quick_note(self, sim);
}

bool fourth_look(struct fourth *o, const struct scene *scene, struct diags *diags)
{
    struct arena *scratch = arena_open();
    struct racer eye = {.nfast = scene->nfast, .fast = scene->fast};
    struct quick quick;
    const struct setting setting = {stepper_find("dopri5"), USUAL, NAN, 1, 0};
    *o = (struct fourth){.every = scene->output.every};
    racer_open(&eye, &setting, scene, diags, scratch);
    if (!eye.out) {
        quick_open(&quick, &eye.sim, scratch);
        quick_note(&quick, &eye.sim);
        racer_go(&eye, LOOK, note, &quick);
        o->span = eye.sim.plan.until - scene->start;
    }
    const bool seen = !eye.out && quick.seen > 0;
    if (seen) quick_apart(&quick, &eye.sim, o->off);
    arena_close(scratch);
    return seen && o->off[0] > 0;
}

bool fourth_setting(struct setting *setting, const struct fourth *o, double tolerance)
{
    enum { MOST_RATIO = 200, LEAST_RATIO = 3, LEAST_MAJORS = 10 };
    static const double EXACT = .5; /* of the tolerance: the motion seen is not all of it */
    const double most = o->every > 0 ? o->every : o->span / LEAST_MAJORS;
    const double h = pow(EXACT * tolerance / (o->off[0] * o->span), .25),
                 H = fmin(most, fmin(MOST_RATIO * h, pow(EXACT * tolerance / (o->off[1] * o->span), .25)));
    const double major = most / ceil(most / H * (1 - 1e-9));
    const int ratio = (int)ceil(major / h);
    *setting = (struct setting){stepper_find("subcycle"), NAN, major / ratio, ratio, 4};
    return o->off[0] > 0 && ratio >= LEAST_RATIO && ratio <= MOST_RATIO;
}
