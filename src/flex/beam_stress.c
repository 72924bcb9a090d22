/* beam_stress.c -- stresses at a place of a beam's section, by its modes. */
#include "flex/beam_stress.h"

#include <math.h>

/* xx = N/A + My z/Iy - Mz y/Iz, xy and xz of section_shear(), all in the section's axes and the shear turned back. */
static void stress_by(struct flex_stress *o, int j, const struct flex_section *c, const double *T, const double *Q,
                      double y, double z)
{
    const double co = cos(c->twist), si = sin(c->twist);
    const double V[2] = {co * Q[1] + si * Q[2], co * Q[2] - si * Q[1]};
    const double M[2] = {co * Q[4] + si * Q[5], co * Q[5] - si * Q[4]};
    const double xy = T[0] * V[0] + T[2] * V[1] + T[4] * Q[3], xz = T[1] * V[0] + T[3] * V[1] + T[5] * Q[3];
    double *tensor = o->tensor + 6 * j;
    o->axial[j] = Q[0] / c->A;
    o->bending[j] = (z != 0 ? M[0] * z / c->Iy : 0) - M[1] * y / c->Iz;
    tensor[0] = o->axial[j] + o->bending[j];
    tensor[3] = co * xy - si * xz;
    tensor[4] = si * xy + co * xz;
}

enum status beam_stress(struct flex_stress *o, const struct flex_beam *beam, const struct rod *rod, const double *Phi,
                        int n, const struct flex_probe *probe, double *Q, struct report *report)
{
    struct flex_section c;
    const double nu = beam->E / (2 * beam->G) - 1;
    double T[6];
    rod_section(&c, beam, probe->station);
    if ((probe->y != 0 && !(c.y > 0)) || (probe->z != 0 && beam->space == 3 && !(c.z > 0)))
        return fail(report, E_MODEL, "the stress point '%s' needs a section whose outline is known",
                    probe->name ? probe->name : "");
    const double y = probe->y * c.y, z = beam->space == 3 ? probe->z * c.z : 0;
    section_shear(T, &c, y, z, isfinite(nu) ? nu : 0);
    rod_forces(Q, rod, probe->station, Phi, n);
    o->name = probe->name;
    o->shear = c.shape != SHAPE_NUMBERS;
    for (int j = 0; j < n; j++) stress_by(o, j, &c, T, Q + 6 * j, y, z);
    return OK;
}
