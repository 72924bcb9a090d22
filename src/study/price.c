/* price.c -- see price.h
 *
 * Measured on one core of an AMD EPYC of the third generation (Milan, 2.4 GHz), gcc -O2, as the least squares in the
 * logarithm of the CPU seconds of 230 runs: the shipped decks by midpoint, dopri5, dop853, radau5 and radau9.  A third
 * off, rms; nine in ten within a factor of 1.8. */
#include "study/price.h"

#include "study/price_table.h"

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

/* Of instructions, by callgrind: what explain DECK tells.  Choices go by the seconds above, which no change of a kernel
 * moves. */
static const struct counted {
    double any, body, row, mode, pair, bent, structured; /* bent: of an equation and a mode; structured: evaluations */
} COUNTED_PLANAR = {PRICE_PLANAR}, COUNTED_SPATIAL = {PRICE_SPATIAL};
static const struct {
    double balance, look, full;
} COUNTED = {PRICE_SHARED};

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

/* What one evaluation sweeps. */
struct swept {
    bool spatial;
    double n, rows, bodies, modes;
};

static struct swept sweep_of(const struct sim *sim)
{
    struct swept o = {.spatial = sim->model->space == 3 && !(sim->flat && !sim->options.drawn),
                      .n = sim->stepper.ode->n,
                      .rows = count_rows(sim)};
    count_bodies(&o.bodies, &o.modes, sim->model);
    return o;
}

/* What follows from the price of an evaluation. */
static void find_shares(struct price *o, const struct sim *sim, double structured, double balance, double look)
{
    const struct ode2 *ode = sim->stepper.ode;
    o->structured = structured * o->evaluation;
    o->fast = ode->n > 0 ? ode->ns / (double)ode->n : 0;
    o->balance = sim_floating(sim) ? balance : 0;
    o->look = look * o->evaluation / (sim->looks_always ? 1 : LOOK_EVERY);
}

void price_find(struct price *o, const struct sim *sim)
{
    const struct swept x = sweep_of(sim);
    const struct prices *p = x.spatial ? &SPATIAL : &PLANAR;
    const double r = o->rows = x.rows;
    o->evaluation =
        ANY + p->body * x.bodies + p->row * r + ROWS * r * r + p->mode * x.modes + p->pair * x.modes * x.modes;
    o->full = FULL * x.n * x.n * x.n;
    find_shares(o, sim, STRUCTURED, BALANCE, LOOK);
}

void price_count(struct price *o, const struct sim *sim)
{
    const struct swept x = sweep_of(sim);
    const struct counted *c = x.spatial ? &COUNTED_SPATIAL : &COUNTED_PLANAR;
    o->rows = x.rows;
    o->evaluation = c->any + c->body * x.bodies + c->row * x.rows + c->mode * x.modes + c->pair * x.modes * x.modes +
                    c->bent * x.rows * x.modes;
    o->full = COUNTED.full * x.n * x.n * x.n;
    find_shares(o, sim, c->structured, COUNTED.balance, COUNTED.look);
}

double price_seconds(const struct price *o, const struct stepper_kind *kind, const struct effort *e)
{
    return o->evaluation * ((double)e->slow * (1 - o->fast) + (double)e->fast * o->fast) +
           (kind->full ? o->full : o->structured) * (double)e->factors;
}

static double books(const struct price *o, const struct effort *e)
{
    return o->evaluation * o->balance * ((double)e->slow * (1 - o->fast) + (double)e->fast * o->fast) +
           o->look * (double)e->majors;
}

double price_whole(const struct price *o, const struct stepper_kind *kind, const struct effort *e)
{
    return price_seconds(o, kind, e) + books(o, e);
}
