/* inertias.c -- bodies that the deck gives an inertia with a negative principal moment, `inertia_check: false`.
 *
 * With what hangs on them, or about their joint, the mass matrix may be positive all the same.  Where it is not, the
 * equations of motion have no meaning, though schemes that solve with M^ and stiffness together would go on: it is looked
 * at after every step. */
#include "la/dense.h"
#include "la/eigen.h"
#include "sim/parts.h"

static bool is_negative(const struct model_body *b, int space)
{
    const double *J = b->inertia;
    double A[9] = {J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2]}, moment[3], axes[9];
    if (space == 2) return J[2] < 0;
    eigen_symmetric(moment, axes, A, 3);
    return moment[0] < -1e-12 * moment[2];
}

void inertias_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    for (int i = m->nbody - 1; i > 0; i--)
        if (!m->body[i].flex && is_negative(&m->body[i], m->space)) sim->negative = i;
    if (sim->negative) sim->M = TAKE_MATRIX(life, double, m->n, m->n);
}

enum status inertias_note(struct sim *sim)
{
    const struct ode2 *o = system_ode2(sim->system);
    if (!sim->negative) return OK;
    TRY(o->ops->mass(o, sim->M, sim->x.q, sim->x.t, ALL, &sim->trouble));
    if (dense_cholesky(sim->M, o->n, o->n) < 0) return OK;
    return trouble_set(&sim->trouble, TROUBLE_INERTIA, sim->negative, 0, sim->x.t);
}
