/* columns_run.c -- columns of the run as a whole: time, energies (2-26), momenta, steps */
#include "sim/sim.h"

/* A figure of the run itself. */
#define FIGURE(name, figure)                                                                                           \
    static double name(const struct sim *sim, const struct origin *o)                                                  \
    {                                                                                                                  \
        (void)o;                                                                                                       \
        return figure;                                                                                                 \
    }

FIGURE(time_now, sim->x.t)

const struct column_kind columns_time[] = {
    {COLUMN("", "", "s", "time", EVALUATE_NOTHING, time_now), .use = USE_WRITTEN},
    {0},
};

FIGURE(kinetic, sim->ledger.kinetic)
FIGURE(elastic, sim->ledger.elastic)
FIGURE(gravity, sim->ledger.gravity)
FIGURE(external, sim->ledger.work[LEDGER_EXTERNAL])
FIGURE(drive, sim->ledger.work[LEDGER_DRIVE])
FIGURE(damper, sim->ledger.work[LEDGER_DAMPER])
FIGURE(friction, sim->ledger.work[LEDGER_FRICTION])
FIGURE(impact, sim->ledger.struck)
FIGURE(numerical, sim->ledger.lost)
FIGURE(residual, sim->ledger.residual)

const struct column_kind columns_energy[] = {
    {COLUMN(".kinetic", ".kinetic", "J", "kinetic energy", NEED_ENERGY, kinetic)},
    {COLUMN(".elastic", ".elastic", "J", "energy in springs and in flexible bodies", NEED_ENERGY, elastic)},
    {COLUMN(".gravity", ".gravity", "J", "energy in the field of gravity", NEED_ENERGY, gravity)},
    {COLUMN(".external", ".external", "J", "work of external forces since the start", NEED_ENERGY | NEED_WORKS,
            external)},
    {COLUMN(".drive", ".drive", "J", "work of drives since the start", NEED_ENERGY | NEED_WORKS, drive)},
    {COLUMN(".damper", ".damper", "J", "work of dampers since the start (negative: taken)", NEED_ENERGY | NEED_WORKS,
            damper)},
    {COLUMN(".friction", ".friction", "J", "work of friction since the start", NEED_ENERGY | NEED_WORKS, friction)},
    {COLUMN(".numerical", ".numerical", "J", "taken by the scheme's own damping since the start", NEED_ENERGY,
            numerical),
     .own = true},
    {COLUMN(".residual", ".residual", "J", "W_kin + W_int - W_ext of (2-26)", NEED_ENERGY, residual),
     .use = USE_WRITTEN, .own = true},
    {0},
};

/* Where there are rigid contacts. */
const struct column_kind columns_impact[] = {
    {COLUMN(".impact", ".impact", "J", "taken by impacts of rigid contacts since the start", NEED_ENERGY, impact)},
    {0},
};

static double momentum(const struct sim *sim, const struct origin *o)
{
    double p[3], L[3];
    system_momentum(sim->system, p, L);
    return p[o->k];
}

static double angular_momentum(const struct sim *sim, const struct origin *o)
{
    double p[3], L[3];
    system_momentum(sim->system, p, L);
    return L[o->k];
}

const struct column_kind columns_momentum[] = {
    {COLUMN(".x .y", ".x .y .z", "N s", "momentum of all bodies", EVALUATE_MOTION | NEED_MOMENTUM, momentum)},
    {COLUMN(".lz", ".lx .ly .lz", "N m s", "angular momentum of all bodies about the world's origin",
            EVALUATE_MOTION | NEED_MOMENTUM, angular_momentum)},
    {0},
};

FIGURE(minor_step, sim->last_h)
FIGURE(major_step, sim->plan.step * sim->plan.ratio)
FIGURE(ratio, sim->plan.ratio)
FIGURE(sweeps, sim->stepper.last_sweeps)

const struct column_kind columns_step[] = {
    {COLUMN(".h", ".h", "s", "minor step of the last step", EVALUATE_NOTHING, minor_step), .own = true},
    {COLUMN(".H", ".H", "s", "major step of the last step", EVALUATE_NOTHING, major_step), .own = true},
    {COLUMN(".ratio", ".ratio", NULL, "minor steps in it", EVALUATE_NOTHING, ratio), .own = true},
    {COLUMN(".sweeps", ".sweeps", NULL, "Newton sweeps of the last step", EVALUATE_NOTHING, sweeps), .own = true},
    {0},
};
