/* material.c -- see material.h */
#include "reduce/material.h"

#include <math.h>
#include <stdio.h>

#include "reduce/solid.h"
#include "reduce/stress.h"

static const double SAME = 0.02; /* of E, and of 1 + nu */

/* Of all elements; 0: one of them is of no known kind. */
static double volume(const struct fe *fe)
{
    const double still[3 * SOLID_MOST] = {0};
    double V = 0, x[3 * SOLID_MOST], g[9];
    int node[SOLID_MOST];
    struct report why = {0};
    for (const struct mesh_element *e = fe->mesh.element; e < fe->mesh.element + fe->mesh.nelement; e++) {
        if (stress_element(node, x, fe, e, &why) != OK) return 0;
        for (int p = 0; p < solid_points(e->nodes); p++)
            V += solid_weight(e->nodes) * solid_gradient(g, e->nodes, p, x, still);
    }
    return V;
}

/* u'Ku of the displacement along `to` that grows with the place along `by`. */
static double cost(const struct fe *fe, int to, int by, double *u, double *f)
{
    double sum = 0;
    for (int i = 0; i < 3 * fe->n; i++) u[i] = i % 3 == to ? fe->x[i - to + by] - fe->centre[by] : 0;
    sparse_mul(f, &fe->K, u);
    for (int i = 0; i < 3 * fe->n; i++) sum += u[i] * f[i];
    return sum;
}

void material_check(const struct fe *fe, const struct options *options, struct arena *life)
{
    const struct fe_units *unit = &fe->units;
    const double V = volume(fe), pascal = unit->mass / (unit->length * unit->time * unit->time);
    double *u = TAKE(life, double, 3 * (size_t)fe->n), *f = TAKE(life, double, 3 * (size_t)fe->n);
    double stretch = 0, shear = 0;
    if (!options->material || !(options->nprobe || options->stiffening) || !(V > 0)) return;
    for (int a = 0; a < 3; a++) {
        stretch += cost(fe, a, a, u, f) / (3 * V);
        shear += cost(fe, a, (a + 1) % 3, u, f) / (3 * V);
    }
    const double nu = (stretch / 2 - shear) / (stretch - shear), E = 2 * shear * (1 + nu) / pascal;
    if (fabs(options->E / E - 1) <= SAME && fabs(options->nu - nu) <= SAME * (1 + nu)) return;
    fprintf(stderr,
            "warning: the stiffness matrix is in the mean that of E %.4g, nu %.4g, not of the --material %.4g,%.4g: "
            "stresses and --stiffening are off by as much\n",
            E, nu, options->E, options->nu);
}
