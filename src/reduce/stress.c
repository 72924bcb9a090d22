/* stress.c -- see stress.h */
#include "reduce/stress.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "reduce/solid.h"

/* s [6] of the displacement gradient g: lambda tr e 1 + 2 mu e. */
void stress_hooke(double *s, const double *g, double E, double nu)
{
    double mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), trace = g[0] + g[4] + g[8];
    for (int a = 0; a < 3; a++) s[a] = lambda * trace + 2 * mu * g[4 * a];
    s[3] = mu * (g[3] + g[1]);
    s[4] = mu * (g[6] + g[2]);
    s[5] = mu * (g[7] + g[5]);
}

static bool usable(const struct mesh_element *e)
{
    return solid_known(e->nodes) && e->type[0] == 'C';
}

enum status stress_element(int *node, double *x, const struct fe *fe, const struct mesh_element *e,
                           struct report *report)
{
    if (!usable(e))
        return fail(report, E_MODEL,
                    "element %d: stresses in elements %s are not known, in C3D4, C3D10 and C3D20R they are", e->id,
                    e->type);
    for (int i = 0; i < e->nodes; i++) {
        node[i] = fe_node(fe, e->node[i]);
        if (node[i] < 0) return fail(report, E_MODEL, "element %d: its node %d has no freedoms", e->id, e->node[i]);
        v3_copy(x + 3 * i, fe->x + 3 * node[i]);
    }
    return OK;
}

/* Adds the element's stress at its local node. */
static enum status add_element(double *s, const struct fe *fe, const struct mesh_element *e, int at, const double *u,
                               double E, double nu, struct report *report)
{
    double x[3 * SOLID_MOST], v[3 * SOLID_MOST], w[SOLID_POINTS];
    int node[SOLID_MOST];
    TRY(stress_element(node, x, fe, e, report));
    for (int i = 0; i < e->nodes; i++) v3_copy(v + 3 * i, u + 3 * node[i]);
    solid_weights(w, e->nodes, at);
    for (int p = 0; p < solid_points(e->nodes); p++) {
        double g[9], here[6];
        if (!(solid_gradient(g, e->nodes, p, x, v) > 0))
            return fail(report, E_MODEL, "element %d is turned inside out", e->id);
        stress_hooke(here, g, E, nu);
        for (int k = 0; k < 6; k++) s[k] += w[p] * here[k];
    }
    return OK;
}

enum status stress_at(double *s, const struct fe *fe, int node, const double *u, double E, double nu,
                      struct report *report)
{
    int count = 0;
    for (int k = 0; k < 6; k++) s[k] = 0;
    for (const struct mesh_element *e = fe->mesh.element; e < fe->mesh.element + fe->mesh.nelement; e++)
        for (int i = 0; i < e->nodes; i++) {
            if (e->node[i] != fe->id[node]) continue;
            TRY(add_element(s, fe, e, i, u, E, nu, report));
            count++;
        }
    if (!count) return fail(report, E_MODEL, "stress at node %d: no element is there", fe->id[node]);
    for (int k = 0; k < 6; k++) s[k] /= count;
    return OK;
}

enum status stress_make(struct flex_body *body, const struct options *options, const struct fe *fe,
                        const struct basis *basis, struct report *report)
{
    const struct fe_units *u = &fe->units;
    double E = options->E * u->mass / (u->length * u->time * u->time);
    for (int p = 0; p < options->nprobe; p++) {
        int node = fe_node(fe, options->probe[p].node);
        body->stress[p].name = options->probe[p].name;
        if (node < 0)
            return fail(report, E_MODEL, "stress point '%s': node %d is not part of the body", options->probe[p].name,
                        options->probe[p].node);
        for (int j = 0; j < basis->n; j++)
            TRY(stress_at(body->stress[p].tensor + 6 * j, fe, node, basis->V + (size_t)j * (size_t)basis->size, E,
                          options->nu, report));
    }
    return OK;
}
