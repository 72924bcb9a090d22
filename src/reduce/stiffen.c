/* stiffen.c -- see stiffen.h */
#include "reduce/stiffen.h"

#include "la/vec3.h"
#include "reduce/loads.h"
#include "reduce/solid.h"
#include "reduce/stress.h"

struct stiffen {
    const struct fe *fe;
    const struct basis *basis;
    int nload;
    double **u; /* [nload] answers, [3 fe->n] each */
    double **G; /* [nload] */
    double E, nu;
    double *g;    /* [9 x n] gradients of the modes at a point */
    double *pull; /* [9 x n] the same times sigma */
};

/* Gradient at point p of the field u over all nodes; returns the volume of the point. */
static double gradient(double *g, const struct mesh_element *e, const int *node, const double *x, int p,
                       const double *u)
{
    double v[3 * SOLID_MOST];
    for (int i = 0; i < e->nodes; i++) v3_copy(v + 3 * i, u + 3 * node[i]);
    return solid_gradient(g, e->nodes, p, x, v) * solid_weight(e->nodes);
}

static double product(const double *a, const double *b)
{
    double sum = 0;
    for (int k = 0; k < 9; k++) sum += a[k] * b[k];
    return sum;
}

/* G += g_i : (g_j sigma) dV, symmetric. */
static void add_load(double *G, struct stiffen *o, const double *s, double dV)
{
    const double sigma[9] = {s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2]};
    int n = o->basis->n;
    for (int j = 0; j < n; j++) m3_mulm(o->pull + 9 * j, o->g + 9 * j, sigma);
    for (int j = 0; j < n; j++)
        for (int i = 0; i <= j; i++) {
            G[i + n * j] += dV * product(o->g + 9 * i, o->pull + 9 * j);
            G[j + n * i] = G[i + n * j];
        }
}

static enum status add_element(struct stiffen *o, const struct mesh_element *e, struct report *report)
{
    int node[SOLID_MOST];
    double x[3 * SOLID_MOST], g[9], s[6];
    TRY(stress_element(node, x, o->fe, e, report));
    for (int p = 0; p < solid_points(e->nodes); p++) {
        for (int j = 0; j < o->basis->n; j++)
            gradient(o->g + 9 * j, e, node, x, p, o->basis->V + (size_t)j * (size_t)o->basis->size);
        for (int k = 0; k < o->nload; k++) {
            double dV = gradient(g, e, node, x, p, o->u[k]);
            if (!(dV > 0)) return fail(report, E_MODEL, "element %d is turned inside out", e->id);
            stress_hooke(s, g, o->E, o->nu);
            add_load(o->G[k], o, s, dV);
        }
    }
    return OK;
}

/* The answers to all loads. */
static enum status answers(struct stiffen *o, const struct tie *tie, struct arena *scratch, struct report *report)
{
    struct hold hold;
    TRY(hold_make(&hold, o->fe, &tie, 1, scratch, report));
    o->u = TAKE(scratch, double *, o->nload);
    for (int k = 0; k < o->nload; k++) {
        o->u[k] = TAKE(scratch, double, 3 * (size_t)o->fe->n);
        if (k < LOAD_KINDS)
            load_forces(o->u[k], o->fe, k, scratch);
        else
            load_interface(o->u[k], o->fe, tie + 1 + (k - LOAD_KINDS) / 3, (k - LOAD_KINDS) % 3);
        hold_solve(o->u[k], &hold, o->u[k]);
    }
    return OK;
}

enum status stiffen_make(double **G, const struct fe *fe, const struct basis *basis, const struct tie *tie, int ntie,
                         double E, double nu, struct arena *life, struct report *report)
{
    struct arena *scratch = arena_open();
    struct stiffen o = {.fe = fe, .basis = basis, .nload = LOAD_KINDS + 3 * (ntie - 1), .G = G, .E = E, .nu = nu};
    o.g = TAKE(scratch, double, 9 * basis->n);
    o.pull = TAKE(scratch, double, 9 * basis->n);
    for (int k = 0; k < o.nload; k++) G[k] = TAKE(life, double, basis->n * basis->n);
    enum status status = answers(&o, tie, scratch, report);
    if (status == OK && !fe->mesh.nelement) status = fail(report, E_MODEL, "--stiffening: the mesh has no elements");
    for (int i = 0; status == OK && i < fe->mesh.nelement; i++) status = add_element(&o, fe->mesh.element + i, report);
    arena_close(scratch);
    return status;
}
