/* columns_joint.c -- columns of joints and of ties: coordinates of the state, reactions */
#include "la/rot.h"
#include "la/vec3.h"
#include "sim/sim.h"

/* ---- coordinates of the state, of joints and of modes, by their places in q and v ---- */

/* A mode that is not there stays 0: index -1. */
static double position(const struct sim *sim, const struct origin *o)
{
    return o->index < 0 ? 0 : sim->x.q[o->index];
}

static double rate(const struct sim *sim, const struct origin *o)
{
    if (o->index < 0) return 0;
    return sim->model->nloop ? system_rates(sim->system)[o->index] : sim->x.v[o->index];
}

static double acceleration(const struct sim *sim, const struct origin *o)
{
    return o->index < 0 ? 0 : system_accelerations(sim->system)[o->index];
}

/* Names and units are those of the kind of joint. */
const struct column_kind columns_coordinate[] = {
    {COLUMN(NULL, NULL, NULL, "joint coordinate", EVALUATE_NOTHING, position), .use = USE_POSITION},
    {COLUMN(NULL, NULL, NULL, "rate of a joint coordinate", NEED_RATES, rate), .use = USE_RATE},
    {COLUMN(NULL, NULL, NULL, "acceleration of a joint coordinate", EVALUATE_ACCELERATION, acceleration)},
    {0},
};

/* ---- coordinates of joints that close loops: `index` is the loop, k counts ---- */

static double loop_position(const struct sim *sim, const struct origin *o)
{
    return system_loop_coordinate(sim->system, o->index, 0, o->k);
}

static double loop_rate(const struct sim *sim, const struct origin *o)
{
    return system_loop_coordinate(sim->system, o->index, 1, o->k);
}

static double loop_acceleration(const struct sim *sim, const struct origin *o)
{
    return system_loop_coordinate(sim->system, o->index, 2, o->k);
}

/* Angles, other positions, rates, accelerations. */
const struct column_kind columns_loop_coordinate[] = {
    {COLUMN(NULL, NULL, NULL, "joint coordinate", EVALUATE_MOTION | NEED_TURNS, loop_position), .use = USE_TURNS},
    {COLUMN(NULL, NULL, NULL, "joint coordinate", EVALUATE_MOTION, loop_position)},
    {COLUMN(NULL, NULL, NULL, "rate of a joint coordinate", EVALUATE_MOTION, loop_rate)},
    {COLUMN(NULL, NULL, NULL, "acceleration of a joint coordinate", EVALUATE_ACCELERATION, loop_acceleration)},
    {0},
};

/* ---- coordinates of flexible bodies ---- */

const struct column_kind columns_mode[] = {
    {COLUMN("", "", NULL, "elastic coordinate", EVALUATE_NOTHING, position), .use = USE_POSITION},
    {COLUMN("_rate", "_rate", NULL, "its rate", EVALUATE_NOTHING, rate), .use = USE_RATE},
    {COLUMN("_accel", "_accel", NULL, "its acceleration", EVALUATE_ACCELERATION, acceleration)},
    {0},
};

/* ---- reactions ---- */

/* Component k of x [3], world axes: there, or in a joint's own axes, which go with its first body. */
static double in_axes(const struct sim *sim, const double *own, int first, const double *x, int k)
{
    struct pose pose;
    double A[9];
    if (!own) return x[k];
    system_pose(sim->system, &pose, first);
    m3_mulm(A, pose.R, own);
    return v3_dot(A + 3 * k, x);
}

/* Of the force (part 0) or the moment (part 1) of a joint of the tree. */
static double reaction(const struct sim *sim, const struct origin *o, int part)
{
    const struct model_joint *j = &sim->model->joint[o->index];
    double x[2][3];
    system_reaction(sim->system, x[0], x[1], o->index);
    return in_axes(sim, j->own, j->reversed ? j->child : j->parent, x[part], o->k);
}

static double force(const struct sim *sim, const struct origin *o)
{
    return reaction(sim, o, 0);
}

static double moment(const struct sim *sim, const struct origin *o)
{
    return reaction(sim, o, 1);
}

const struct column_kind columns_reaction[] = {
    {COLUMN(".fx .fy", ".fx .fy .fz", "N", "reaction on the second body, world axes", EVALUATE_REACTION, force)},
    {COLUMN(".mz", ".mx .my .mz", "N m", "moment of it about the joint's point on the second body, world axes",
            EVALUATE_REACTION, moment)},
    {0},
};

static double loop_reaction(const struct sim *sim, const struct origin *o, int part)
{
    const struct model_loop *l = &sim->model->loop[o->index];
    double x[2][3];
    system_loop_reaction(sim->system, x[0], x[1], o->index);
    return in_axes(sim, l->own, l->first, x[part], o->k);
}

static double loop_force(const struct sim *sim, const struct origin *o)
{
    return loop_reaction(sim, o, 0);
}

static double loop_moment(const struct sim *sim, const struct origin *o)
{
    return loop_reaction(sim, o, 1);
}

const struct column_kind columns_loop_reaction[] = {
    {COLUMN(".fx .fy", ".fx .fy .fz", "N", "reaction on the second body, world axes", EVALUATE_REACTION, loop_force)},
    {COLUMN(".mz", ".mx .my .mz", "N m", "moment of it about the joint's point on the second body, world axes",
            EVALUATE_REACTION, loop_moment)},
    {0},
};

/* ---- ties ---- */

/* Of rods and lines: on the second body, at its point. */
const struct column_kind columns_tie[] = {
    {COLUMN(".fx .fy", ".fx .fy .fz", "N", "force on the second body, world axes", EVALUATE_REACTION, loop_force)},
    {0},
};

static double tie_force(const struct sim *sim, const struct origin *o)
{
    return system_loop_force(sim->system, o->index);
}

const struct column_kind columns_rod[] = {
    {COLUMN(".force", ".force", "N", "what drives the points apart", EVALUATE_ACCELERATION, tie_force)},
    {0},
};

/* Of gears and racks. */
const struct column_kind columns_gear[] = {
    {COLUMN(".force", ".force", "N", "what drives the second coordinate upwards", EVALUATE_ACCELERATION, tie_force),
     .angular = "N m"},
    {0},
};
