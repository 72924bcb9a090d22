/* columns_body.c -- columns of bodies, of their points and of places of stress */
#include "la/rot.h"
#include "sim/sim.h"

/* ---- bodies ---- */

static const struct pose *standing(struct pose *p, const struct sim *sim, const struct origin *o)
{
    system_centre_stands(sim->system, p, o->index);
    return p;
}

static const struct pose *moving(struct pose *p, const struct sim *sim, const struct origin *o)
{
    system_centre_moves(sim->system, p, o->index);
    return p;
}

static double place(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    return standing(&p, sim, o)->r[o->k];
}

static double angle(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    return standing(&p, sim, o)->angle;
}

static double quaternion(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    double q[4];
    system_pose(sim->system, &p, o->index);
    quat_of_matrix(q, p.R);
    return q[o->k];
}

static double tait_bryan(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    double angles[3];
    system_pose(sim->system, &p, o->index);
    tait_bryan_of_matrix(angles, p.R);
    return angles[o->k];
}

static double euler(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    double angles[3];
    system_pose(sim->system, &p, o->index);
    euler_of_matrix(angles, p.R);
    return angles[o->k];
}

static double velocity(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    return moving(&p, sim, o)->v[o->k];
}

static double angular_velocity(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    return moving(&p, sim, o)->w[o->k];
}

static double acceleration(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    return moving(&p, sim, o)->a[o->k];
}

static double angular_acceleration(const struct sim *sim, const struct origin *o)
{
    struct pose p;
    return moving(&p, sim, o)->al[o->k];
}

const struct column_kind columns_body[] = {
    {COLUMN(".x .y", ".x .y .z", "m", "centre of mass, world axes", EVALUATE_MOTION, place)},
    {COLUMN(".angle", NULL, "rad", "turned since drawn", EVALUATE_MOTION, angle)},
    {COLUMN(NULL, ".qw .qx .qy .qz", NULL,
            "unit quaternion, body to world, with qw >= 0: the others change sign where it meets 0", EVALUATE_MOTION,
            quaternion)},
    {COLUMN(".vx .vy", ".vx .vy .vz", "m/s", "velocity of the centre of mass", EVALUATE_MOTION, velocity)},
    {COLUMN(".wz", ".wx .wy .wz", "rad/s", "angular velocity, world axes", EVALUATE_MOTION, angular_velocity)},
    {COLUMN(".ax .ay", ".ax .ay .az", "m/s2", "acceleration of the centre of mass", EVALUATE_ACCELERATION,
            acceleration)},
    {COLUMN(".alz", ".alx .aly .alz", "rad/s2", "angular acceleration, world axes", EVALUATE_ACCELERATION,
            angular_acceleration)},
    {COLUMN(NULL, ".yaw .pitch .roll", "rad", "Tait-Bryan angles z-y'-x'', world to body", EVALUATE_MOTION,
            tait_bryan)},
    {COLUMN(NULL, ".euler1 .euler2 .euler3", "rad", "Euler angles z-x'-z'', world to body", EVALUATE_MOTION, euler)},
    {0},
};

/* ---- points ---- */

static double point_place(const struct sim *sim, const struct origin *o)
{
    double x[3], v[3], a[3];
    system_point(sim->system, x, v, a, &sim->model->point[o->index]);
    return x[o->k];
}

static double point_velocity(const struct sim *sim, const struct origin *o)
{
    double x[3], v[3], a[3];
    system_point(sim->system, x, v, a, &sim->model->point[o->index]);
    return v[o->k];
}

static double point_acceleration(const struct sim *sim, const struct origin *o)
{
    double x[3], v[3], a[3];
    system_point(sim->system, x, v, a, &sim->model->point[o->index]);
    return a[o->k];
}

const struct column_kind columns_point[] = {
    {COLUMN(".x .y", ".x .y .z", "m", "point, world axes", EVALUATE_MOTION, point_place)},
    {COLUMN(".vx .vy", ".vx .vy .vz", "m/s", "velocity of a point", EVALUATE_MOTION, point_velocity)},
    {COLUMN(".ax .ay", ".ax .ay .az", "m/s2", "acceleration of a point", EVALUATE_ACCELERATION, point_acceleration)},
    {0},
};

static double displacement(const struct sim *sim, const struct origin *o)
{
    double d[3];
    system_displacement(sim->system, d, &sim->model->point[o->index]);
    return d[o->k];
}

static double rotation(const struct sim *sim, const struct origin *o)
{
    double turn[3];
    system_rotation(sim->system, turn, &sim->model->point[o->index]);
    return turn[o->k];
}

/* More of a point of a flexible body. */
const struct column_kind columns_bent_point[] = {
    {COLUMN(".dx .dy", ".dx .dy .dz", "m", "displacement by bending, body axes", EVALUATE_MOTION, displacement)},
    {COLUMN(".rz", ".rx .ry .rz", "rad",
            "rotation by bending, a rotation vector, up to half a turn in space, body axes", EVALUATE_MOTION,
            rotation)},
    {0},
};

/* ---- stress: of the place `place` of the flexible body `index` ---- */

static double axial(const struct sim *sim, const struct origin *o)
{
    return system_stress(sim->system, o->index, o->place, STRESS_AXIAL);
}

static double bending(const struct sim *sim, const struct origin *o)
{
    return system_stress(sim->system, o->index, o->place, STRESS_BENDING);
}

static double normal(const struct sim *sim, const struct origin *o)
{
    return system_stress(sim->system, o->index, o->place, STRESS_XX + (unsigned)o->k);
}

static double shear(const struct sim *sim, const struct origin *o)
{
    return system_stress(sim->system, o->index, o->place, STRESS_XY + (unsigned)o->k);
}

static double von_mises(const struct sim *sim, const struct origin *o)
{
    return system_stress(sim->system, o->index, o->place, STRESS_VON_MISES);
}

const struct column_kind columns_beam_stress[] = {
    {COLUMN(".axial", ".axial", "Pa", "normal stress from stretch", EVALUATE_MOTION, axial)},
    {COLUMN(".bending", ".bending", "Pa", "normal stress from bending", EVALUATE_MOTION, bending)},
    {0},
};

const struct column_kind columns_beam_shear[] = {
    {COLUMN(".xy", ".xy .xz", "Pa", "shear stress, body axes", EVALUATE_MOTION, shear)},
    {0},
};

const struct column_kind columns_solid_stress[] = {
    {COLUMN(".xx .yy .zz", ".xx .yy .zz", "Pa", "normal stress, body axes", EVALUATE_MOTION, normal)},
    {COLUMN(".xy .xz .yz", ".xy .xz .yz", "Pa", "shear stress, body axes", EVALUATE_MOTION, shear)},
    {0},
};

const struct column_kind columns_von_mises[] = {
    {COLUMN(".von_mises", ".von_mises", "Pa", "equivalent stress", EVALUATE_MOTION, von_mises)},
    {0},
};
