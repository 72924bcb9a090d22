/* record.c -- the chosen columns at the present state, by one look at the system */
#include "sim/parts.h"

#include "la/rot.h"
#include "la/vec3.h"

static double energy(const struct sim *sim, int k)
{
    const struct ledger *l = &sim->ledger;
    switch ((enum energy_column)k) {
    case ENERGY_KINETIC:
        return l->kinetic;
    case ENERGY_ELASTIC:
        return l->elastic;
    case ENERGY_GRAVITY:
        return l->gravity;
    case ENERGY_EXTERNAL:
        return l->work[LEDGER_EXTERNAL];
    case ENERGY_DRIVE:
        return l->work[LEDGER_DRIVE];
    case ENERGY_DAMPER:
        return l->work[LEDGER_DAMPER];
    case ENERGY_FRICTION:
        return l->work[LEDGER_FRICTION];
    case ENERGY_NUMERICAL:
        return l->lost;
    case ENERGY_RESIDUAL:
        return l->residual;
    case ENERGY_COLUMNS:
        break;
    }
    return 0;
}

static double step_figure(const struct sim *sim, int k)
{
    switch ((enum step_column)k) {
    case STEP_MINOR:
        return sim->last_h;
    case STEP_MAJOR:
        return sim->plan.step * sim->plan.ratio;
    case STEP_RATIO:
        return sim->plan.ratio;
    case STEP_SWEEPS:
        return sim->stepper.last_sweeps;
    case STEP_COLUMNS:
        break;
    }
    return 0;
}

static double pose_part(const struct sim *sim, const struct origin *s)
{
    struct pose p;
    double q[4];
    system_centre(sim->system, &p, s->index);
    switch (s->type) {
    case FROM_PLACE:
        return p.r[s->k];
    case FROM_ANGLE:
        return p.angle;
    case FROM_VELOCITY:
        return p.v[s->k];
    case FROM_OMEGA:
        return p.w[s->k];
    case FROM_ACCELERATION:
        return p.a[s->k];
    default:
        break;
    }
    quat_of_matrix(q, p.R);
    return q[s->k];
}

static double point_part(const struct sim *sim, const struct origin *s)
{
    double x[3], v[3], a[3];
    system_point(sim->system, x, v, a, &sim->model->point[s->index]);
    return s->type == FROM_POINT ? x[s->k] : s->type == FROM_POINT_VELOCITY ? v[s->k] : a[s->k];
}

static double elastic_part(const struct sim *sim, const struct origin *s)
{
    double d[3];
    if (s->type == FROM_DISPLACEMENT) {
        system_displacement(sim->system, d, &sim->model->point[s->index]);
        return d[s->k];
    }
    if (s->type == FROM_TENSOR) return system_stress(sim->system, s->index, s->k / 6, STRESS_XX + (unsigned)(s->k % 6));
    return system_stress(sim->system, s->index, s->k,
                         s->type == FROM_AXIAL     ? STRESS_AXIAL
                         : s->type == FROM_BENDING ? STRESS_BENDING
                                                   : STRESS_VON_MISES);
}

static double force_part(const struct sim *sim, const struct origin *s)
{
    double force, elongation, power;
    system_force(sim->system, &force, &elongation, &power, s->index);
    return s->type == FROM_FORCE ? force : s->type == FROM_ELONGATION ? elongation : power;
}

static double reaction_part(const struct sim *sim, const struct origin *s)
{
    const struct model_joint *j = &sim->model->joint[s->index];
    const struct model_loop *l = &sim->model->loop[s->index];
    const bool tree = s->type == FROM_REACTION;
    const double *own = tree ? j->own : l->own;
    struct pose first;
    double f[6], A[9];
    if (tree)
        system_reaction(sim->system, f, f + 3, s->index);
    else
        system_loop_reaction(sim->system, f, f + 3, s->index);
    if (!own) return f[s->k];
    system_pose(sim->system, &first, !tree ? l->first : j->reversed ? j->child : j->parent);
    m3_mulm(A, first.R, own);
    return v3_dot(A + 3 * (s->k % 3), s->k < 3 ? f : f + 3);
}

double record_value(const struct sim *sim, const struct origin *s)
{
    double a, b, p[6];
    switch (s->type) {
    case FROM_TIME:
        return sim->x.t;
    case FROM_Q:
        return sim->x.q[s->index];
    case FROM_V:
        return sim->model->nloop ? system_rates(sim->system)[s->index] : sim->x.v[s->index];
    case FROM_A:
        return system_accelerations(sim->system)[s->index];
    case FROM_POINT:
    case FROM_POINT_VELOCITY:
    case FROM_POINT_ACCELERATION:
        return point_part(sim, s);
    case FROM_DISPLACEMENT:
    case FROM_TENSOR:
    case FROM_AXIAL:
    case FROM_BENDING:
    case FROM_VON_MISES:
        return elastic_part(sim, s);
    case FROM_REACTION:
    case FROM_LOOP:
        return reaction_part(sim, s);
    case FROM_DRIVE:
        system_drive(sim->system, &a, &b, s->index);
        return s->k == 0 ? a : b;
    case FROM_TIE:
        return system_loop_force(sim->system, s->index);
    case FROM_MEASURE:
    case FROM_MEASURE_RATE:
        system_measure(sim->system, &a, &b, s->index);
        return s->type == FROM_MEASURE ? a : b;
    case FROM_FORCE:
    case FROM_ELONGATION:
    case FROM_POWER:
        return force_part(sim, s);
    case FROM_ENERGY:
        return energy(sim, s->k);
    case FROM_MOMENTUM:
        system_momentum(sim->system, p, p + 3);
        return p[s->k];
    case FROM_STEP:
        return step_figure(sim, s->k);
    default:
        break;
    }
    return pose_part(sim, s);
}

double sim_mass(const struct sim *sim, double *centre)
{
    const struct model *m = sim->model;
    double mass = 0;
    struct trouble why;
    centre[0] = centre[1] = centre[2] = 0;
    system_see(sim->system, sim->x.q, sim->x.v, sim->x.t, SEE_MOTION, &why);
    for (int i = 1; i < m->nbody; i++) {
        struct pose p;
        system_pose(sim->system, &p, i);
        mass += m->body[i].mass;
        v3_axpy(centre, m->body[i].mass, p.r);
    }
    if (mass > 0) v3_scale(centre, 1 / mass, centre);
    return mass;
}

enum status record_fill(struct sim *sim)
{
    if (sim->needs || sim->model->nloop)
        TRY(system_see(sim->system, sim->x.q, sim->x.v, sim->x.t, sim->needs, &sim->trouble));
    for (int i = 0; i < sim->chosen.n; i++)
        sim->row[i] = record_value(sim, &sim->catalogue.origin[sim->chosen.index[i]]);
    return OK;
}
