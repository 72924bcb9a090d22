/* price.c -- see price.h
 *
 * Measured on one core of an AMD EPYC of the third generation (Milan, 2.4 GHz), gcc -O2, as the least squares in the
 * logarithm of the CPU seconds of 230 runs: the shipped decks by midpoint, dopri5, dop853, radau5 and radau9.  A third
 * off, rms; nine in ten within a factor of 1.8. */
#include "study/price.h"

static const double ANY = .38e-6; /* [s] */
static const struct prices {
    double body, row, mode, pair; /* of a body, an equation of a loop, a mode, two modes of a mechanism [s] */
} PLANAR = {.10e-6, .62e-6, .20e-6, .00055e-6}, SPATIAL = {.70e-6, .42e-6, .30e-6, .0035e-6};
static const double ROWS = .030e-6; /* two equations of loops */
static const double BALANCE = 1.28; /* momenta of what floats, by instructions of a satellite */
static const double LOOK = .4;      /* at the energies, likewise of a pendulum and chains */
enum { LOOK_EVERY = 8 };            /* steps, but where each is looked at */
static const double FULL = .58e-9;  /* factors of a matrix for all stages, for n^3 */
static const double STRUCTURED = 4; /* one that knows the structure, in evaluations */

static int count_rows(const struct sim *sim)
{
    struct closures closures;
    struct arena *scratch = arena_open();
    sim_closures(&closures, sim, scratch);
    const int rows = closures.equations;
    arena_close(scratch);
    return rows;
}

/* Bodies, without places on flexible ones, and modes. */
static void count_bodies(double *bodies, double *modes, const struct model *m)
{
    *bodies = *modes = 0;
    for (int i = 1; i < m->nbody; i++) {
        *bodies += !m->body[i].at_node;
        *modes += m->body[i].nmode;
    }
}

void price_find(struct price *o, const struct sim *sim)
{
    const struct ode2 *ode = sim->stepper.ode;
    const struct prices *p = sim->model->space == 3 && !(sim->flat && !sim->options.drawn) ? &SPATIAL : &PLANAR;
    const double n = ode->n, r = count_rows(sim);
    double bodies, modes;
    count_bodies(&bodies, &modes, sim->model);
    o->evaluation = ANY + p->body * bodies + p->row * r + ROWS * r * r + p->mode * modes + p->pair * modes * modes;
    o->full = FULL * n * n * n;
    o->structured = STRUCTURED * o->evaluation;
    o->fast = n > 0 ? ode->ns / n : 0;
    o->balance = sim_floating(sim) ? BALANCE : 0;
    o->look = LOOK * o->evaluation / (sim->looks_always ? 1 : LOOK_EVERY);
}

double price_seconds(const struct price *o, const struct stepper_kind *kind, const struct effort *e)
{
    return o->evaluation * ((double)e->slow * (1 - o->fast) + (double)e->fast * o->fast) +
           (kind->full ? o->full : o->structured) * (double)e->factors;
}

double price_books(const struct price *o, const struct effort *e)
{
    return o->evaluation * o->balance * ((double)e->slow * (1 - o->fast) + (double)e->fast * o->fast) +
           o->look * (double)e->majors;
}
