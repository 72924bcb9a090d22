/* columns_force.c -- columns of measures, of forces and of drives */
#include "sim/sim.h"

static double measure_value(const struct sim *sim, const struct origin *o)
{
    double value, rate;
    system_measure(sim->system, &value, &rate, o->index);
    return value;
}

static double measure_rate(const struct sim *sim, const struct origin *o)
{
    double value, rate;
    system_measure(sim->system, &value, &rate, o->index);
    return rate;
}

const struct column_kind columns_measure[] = {
    {COLUMN("", "", "m", "measure", EVALUATE_MOTION, measure_value), .angular = "rad", .use = USE_COUNTED},
    {COLUMN("_rate", "_rate", "m/s", "rate of a measure", EVALUATE_MOTION, measure_rate), .angular = "rad/s"},
    {0},
};

static double force_size(const struct sim *sim, const struct origin *o)
{
    double size, elongation, power;
    system_force(sim->system, &size, &elongation, &power, o->index);
    return size;
}

static double force_elongation(const struct sim *sim, const struct origin *o)
{
    double size, elongation, power;
    system_force(sim->system, &size, &elongation, &power, o->index);
    return elongation;
}

static double force_power(const struct sim *sim, const struct origin *o)
{
    double size, elongation, power;
    system_force(sim->system, &size, &elongation, &power, o->index);
    return power;
}

/* Of a force along a measure. */
const struct column_kind columns_law[] = {
    {COLUMN(".force", ".force", "N", "along its measure", EVALUATE_FORCE, force_size), .angular = "N m"},
    {COLUMN(".elongation", ".elongation", "m", "its measure", EVALUATE_FORCE, force_elongation), .angular = "rad"},
    {COLUMN(".power", ".power", "W", "put into the system", EVALUATE_FORCE, force_power)},
    {0},
};

/* Of a force or torque on a body. */
const struct column_kind columns_load[] = {
    {COLUMN(".force", ".force", "N", "size of the load", EVALUATE_FORCE, force_size), .angular = "N m"},
    {COLUMN(".power", ".power", "W", "put into the system", EVALUATE_FORCE, force_power)},
    {0},
};

static double force_torque(const struct sim *sim, const struct origin *o)
{
    return system_force_torque(sim->system, o->index);
}

/* Of a bushing. */
const struct column_kind columns_bushing[] = {
    {COLUMN(".force", ".force", "N", "size of its force", EVALUATE_FORCE, force_size)},
    {COLUMN(".torque", ".torque", "N m", "size of its torque on the second body, where its force acts", EVALUATE_FORCE,
            force_torque)},
    {COLUMN(".power", ".power", "W", "put into the system", EVALUATE_FORCE, force_power)},
    {0},
};

static double drive_force(const struct sim *sim, const struct origin *o)
{
    double force, power;
    system_drive(sim->system, &force, &power, o->index);
    return force;
}

static double drive_power(const struct sim *sim, const struct origin *o)
{
    double force, power;
    system_drive(sim->system, &force, &power, o->index);
    return power;
}

const struct column_kind columns_drive[] = {
    {COLUMN(".force", ".force", "N", "of the drive, along its measure", EVALUATE_REACTION, drive_force),
     .angular = "N m"},
    {COLUMN(".power", ".power", "W", "put into the system", EVALUATE_REACTION, drive_power)},
    {0},
};
