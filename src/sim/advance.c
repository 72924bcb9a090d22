/* advance.c -- a major step, and what is done when it will not converge.
 *
 * First the major step is halved with the minor step kept (ratio n into n/2 and the rest), then, at
 * ratio 1, the minor step itself.  Nothing unconverged is accepted; at 2^-10 of the deck's step the run stops. */
#include <math.h>
#include <string.h>

#include "sim/parts.h"

enum { MOST_HALVINGS = 10 };

/* Books the step that was just accepted.  A state whose energy is unknown ends the run: it is no step to halve. */
static enum status push(struct sim *sim, double h, int ratio)
{
    struct energies e;
    const struct stepper *s = &sim->stepper;
    TRY(system_energy_at(sim->system, &e, sim->x.q, sim->x.v, sim->x.t, &sim->trouble));
    ledger_push(&sim->ledger, sim->x.t, e.kinetic, e.elastic, e.gravity, s->work, s->lost, s->left);
    sim->last_h = h;
    if (h < sim->min_h) sim->min_h = h;
    rotations_note(sim, h, ratio);
    spins_note(sim);
    tilts_note(sim);
    return deflections_note(sim);
}

static enum status halve(struct sim *sim, double h, int ratio, double to, int depth);

static enum status step(struct sim *sim, double h, int ratio, double to, int depth)
{
    enum status status = stepper_step(&sim->stepper, &sim->x, h, ratio, to, &sim->trouble);
    if (status == OK) return push(sim, h, ratio);
    if (status == E_NUMERIC && depth < MOST_HALVINGS) return halve(sim, h, ratio, to, depth);
    return status;
}

static enum status halve(struct sim *sim, double h, int ratio, double to, int depth)
{
    double from = sim->x.t;
    if (ratio > 1) {
        int first = ratio / 2;
        TRY(step(sim, h, first, from + first * h, depth + 1));
        return step(sim, h, ratio - first, to, depth + 1);
    }
    double middle = from + (to - from) / 2;
    if (!(middle > from && middle < to)) return E_NUMERIC;
    TRY(step(sim, h / 2, 1, middle, depth + 1));
    return step(sim, h / 2, 1, to, depth + 1);
}

enum status advance(struct sim *sim, double h, int ratio, double to)
{
    return step(sim, h, ratio, to, 0);
}
