/* columns_contact.c -- columns of rigid contacts and stops */
#include <math.h>

#include "engine/touch.h"
#include "sim/sim.h"

static double gap(const struct sim *sim, const struct origin *o)
{
    return system_gap(sim->system, o->index);
}

static double speed(const struct sim *sim, const struct origin *o)
{
    double rate[3];
    system_slip(sim->system, rate, o->index);
    return rate[0];
}

static double normal(const struct sim *sim, const struct origin *o)
{
    return touch_state(sim->stepper.touch, o->index)->force[0];
}

static double state(const struct sim *sim, const struct origin *o)
{
    return touch_state(sim->stepper.touch, o->index)->state;
}

static double impulse(const struct sim *sim, const struct origin *o)
{
    return touch_state(sim->stepper.touch, o->index)->impulse;
}

static double impacts(const struct sim *sim, const struct origin *o)
{
    return (double)touch_state(sim->stepper.touch, o->index)->impacts;
}

const struct column_kind columns_contact[] = {
    {COLUMN(".gap", ".gap", "m", "distance still open", EVALUATE_MOTION, gap), .angular = "rad"},
    {COLUMN(".gap_rate", ".gap_rate", "m/s", "its rate", EVALUATE_MOTION, speed), .angular = "rad/s"},
    {COLUMN(".normal", ".normal", "N", "push of the contact, mean over the last step", EVALUATE_NOTHING, normal),
     .angular = "N m"},
    {COLUMN(".state", ".state", NULL, "0: open, 1: closed and slides, 2: closed and sticks", EVALUATE_NOTHING, state),
     .own = true},
    {COLUMN(".impulse", ".impulse", "N s", "impulse of its push since the start", EVALUATE_NOTHING, impulse),
     .angular = "N m s"},
    {COLUMN(".impacts", ".impacts", NULL, "impacts since the start", EVALUATE_NOTHING, impacts), .own = true},
    {0},
};

static double rubs(const struct sim *sim, const struct origin *o)
{
    return touch_state(sim->stepper.touch, o->index)->force[1];
}

const struct column_kind columns_joint_friction[] = {
    {COLUMN(".friction", ".friction", "N",
            "its friction on the second body, along the coordinate, mean over the last step", EVALUATE_NOTHING, rubs),
     .angular = "N m"},
    {COLUMN(".friction_state", ".friction_state", NULL, "1: it moves, 2: it sticks", EVALUATE_NOTHING, state),
     .own = true},
    {0},
};

static double tangential(const struct sim *sim, const struct origin *o)
{
    return touch_state(sim->stepper.touch, o->index)->force[1 + o->k];
}

static double slip(const struct sim *sim, const struct origin *o)
{
    double rate[3];
    system_slip(sim->system, rate, o->index);
    return rate[1 + o->k];
}

const struct column_kind columns_rubbing[] = {
    {COLUMN(".tangential", ".tangential_x .tangential_y", "N", "friction on the first surface, mean over the last step",
            EVALUATE_NOTHING, tangential)},
    {COLUMN(".slip", ".slip_x .slip_y", "m/s", "rate at which the first surface slides along the second",
            EVALUATE_MOTION, slip)},
    {0},
};
