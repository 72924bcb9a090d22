/* record.c -- the chosen columns at the present state, by one look at the system */
#include <string.h>

#include "engine/motion.h"
#include "la/vec3.h"
#include "sim/parts.h"

double record_value(const struct sim *sim, const struct origin *o)
{
    return o->kind->value(sim, o);
}

enum status record_evaluate(struct sim *sim, unsigned needs)
{
    const unsigned what = needs & EVALUATE_ALL;
    if (!what && !(sim->model->nloop && needs & NEED_RATES)) return OK;
    if (sim->stepper.touch) TRY(contacts_press(sim));
    return system_evaluate(sim->system, sim->x.q, sim->x.v, sim->x.t, what, &sim->trouble);
}

bool record_looks(const struct sim *sim)
{
    return sim->needs & EVALUATE_ALL && !system_is_flat(sim->system);
}

void record_read(struct sim *sim)
{
    const struct origin *all = sim->catalogue.origin;
    const int n = sim->chosen.n, *index = sim->chosen.index;
    double *row = sim->row;
    for (int i = 0; i < n; i++) row[i] = record_value(sim, &all[index[i]]);
}

enum status record_fill(struct sim *sim)
{
    TRY(record_evaluate(sim, sim->needs));
    record_read(sim);
    return OK;
}

enum status sim_mass(double *mass, double *centre, struct sim *sim, struct report *report)
{
    const struct model *m = sim->model;
    *mass = centre[0] = centre[1] = centre[2] = 0;
    enum status status = record_evaluate(sim, EVALUATE_MOTION);
    if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
    for (int i = 1; i < m->nbody; i++) {
        struct pose p;
        system_pose(sim->system, &p, i);
        *mass += m->body[i].mass;
        v3_axpy(centre, m->body[i].mass, p.r);
    }
    if (*mass > 0) v3_scale(centre, 1 / *mass, centre);
    return OK;
}

/* The columns at the present state; energies of bodies and springs are those of it, not those of the step before. */
static enum status fill_anywhere(struct sim *sim)
{
    struct energies e;
    if (!(sim->needs & NEED_ENERGY)) return record_fill(sim);
    TRY(record_evaluate(sim, sim->needs | EVALUATE_ENERGY));
    system_energies(sim->system, &e);
    sim->ledger.kinetic = e.kinetic;
    sim->ledger.elastic = e.elastic;
    sim->ledger.gravity = e.gravity;
    record_read(sim);
    return OK;
}

enum status sim_row(double *row, struct sim *sim, const double *q, const double *v, struct report *report)
{
    const struct state x = sim->x;
    const struct ledger ledger = sim->ledger;
    struct arena *scratch = arena_open();
    const struct ode2 *ode = sim->stepper.ode;
    double *at = TAKE(scratch, double, ode->nq), *vt = TAKE(scratch, double, ode->n);
    memcpy(at, q, sizeof *at * (size_t)ode->nq);
    memcpy(vt, v, sizeof *vt * (size_t)ode->n);
    sim->x = (struct state){x.t, at, vt, x.a};
    const enum status status = fill_anywhere(sim);
    sim->x = x;
    sim->ledger = ledger;
    if (status == OK) memcpy(row, sim->row, sizeof *row * (size_t)sim->chosen.n);
    arena_close(scratch);
    return status == OK ? OK : describe_trouble(sim, &sim->trouble, status, report);
}

void sim_move(const struct sim *sim, double *q, const double *dx)
{
    motion_point(sim->stepper.ode, q, q, dx, 1, sim->x.t);
}
