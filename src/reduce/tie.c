/* tie.c -- see tie.h */
#include "reduce/tie.h"

#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/eigen.h"
#include "la/vec3.h"

/* Numbers joined by '+'; false: that is no such list. */
static bool read_numbers(int *id, int *n, const char *where, struct arena *life)
{
    char *at = arena_copy(life, where, strlen(where));
    for (char *p = at; *p; p++)
        if (*p == '+') *p = ',';
    *n = 0;
    do {
        if (!word_int(&at, id + *n)) return false;
        ++*n;
    } while (word_mark(&at, ','));
    return word_end(at);
}

static enum status find_nodes(struct tie *o, const struct tie_options *w, const struct fe *fe, struct arena *life,
                              struct report *report)
{
    const struct mesh_set *set = mesh_set(&fe->mesh, w->where);
    int *id = TAKE(life, int, strlen(w->where) + 1), n = 0;
    if (!set && !read_numbers(id, &n, w->where, life))
        return fail(report, E_MODEL, "interface '%s': the mesh has no node set '%s'", w->name, w->where);
    if (set) n = set->n;
    int *node = TAKE(life, int, n);
    for (int i = 0; i < n; i++) {
        int number = set ? set->id[i] : id[i];
        node[i] = fe_node(fe, number);
        if (node[i] < 0)
            return fail(report, E_MODEL, "interface '%s': node %d is not part of the body", w->name, number);
        for (int k = 0; k < i; k++)
            if (node[k] == node[i])
                return fail(report, E_MODEL, "interface '%s': node %d is named twice", w->name, number);
    }
    o->n = n;
    o->node = node;
    return n ? OK : fail(report, E_MODEL, "interface '%s': set '%s' is empty", w->name, w->where);
}

static void mean_of(double *mean, const int *node, int n, const struct fe *fe)
{
    v3_set(mean, 0, 0, 0);
    for (int i = 0; i < n; i++) v3_axpy(mean, 1.0 / n, fe->x + 3 * node[i]);
}

/* J^-1 by column; false: the nodes lie on one line, to 1e-6 of their size. */
static bool inverse_spread(double *inverse, const int *node, int n, const double *mean, const struct fe *fe)
{
    double J[9] = {0}, copy[9], lambda[3], X[9];
    for (int i = 0; i < n; i++) {
        double d[3];
        v3_diff(d, fe->x + 3 * node[i], mean);
        for (int k = 0; k < 9; k++) J[k] += (k % 4 == 0 ? v3_dot(d, d) : 0) - d[k % 3] * d[k / 3];
    }
    memcpy(copy, J, sizeof J);
    eigen_symmetric(lambda, X, copy, 3);
    if (!(lambda[0] > 1e-12 * lambda[2])) return false;
    for (int k = 0; k < 9; k++) {
        inverse[k] = 0;
        for (int m = 0; m < 3; m++) inverse[k] += X[k % 3 + 3 * m] * X[k / 3 + 3 * m] / lambda[m];
    }
    return true;
}

/* Columns 3 i + k of A: the motion that displacement 1 of node i along k makes. */
static bool gauge(struct tie *o, const struct fe *fe, struct arena *life)
{
    double mean[3], inverse[9], arm[3];
    mean_of(mean, o->gauge, o->ngauge, fe);
    if (!inverse_spread(inverse, o->gauge, o->ngauge, mean, fe)) return false;
    o->A = TAKE(life, double, 18 * (size_t)o->ngauge);
    v3_diff(arm, o->x, mean);
    for (int i = 0; i < o->ngauge; i++)
        for (int k = 0; k < 3; k++) {
            double *p = o->A + 6 * (3 * i + k), *theta = p + 3, d[3], e[3] = {k == 0, k == 1, k == 2}, moment[3];
            v3_diff(d, fe->x + 3 * o->gauge[i], mean);
            v3_cross(moment, d, e);
            m3_mul(theta, inverse, moment);
            v3_cross(p, theta, arm);
            p[k] += 1.0 / o->ngauge;
        }
    return true;
}

/* A single node: its neighbours tell the rotation, itself the displacement. */
static bool gauge_node(struct tie *o, const struct fe *fe, struct arena *life)
{
    const struct sparse *K = &fe->K;
    int self = o->node[0], n = 0;
    int *list = TAKE(life, int, K->row[3 * self + 1] - K->row[3 * self] + 1);
    list[n++] = self;
    for (size_t k = K->row[3 * self]; k < K->row[3 * self + 1]; k++) {
        int other = K->col[k] / 3;
        if (other != self && other != list[n - 1]) list[n++] = other;
    }
    o->gauge = list;
    o->ngauge = n;
    if (!gauge(o, fe, life)) return false;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++) o->A[6 * (3 * i + k) + a] = i == 0 && a == k;
    return true;
}

enum status tie_make(struct tie *o, const struct tie_options *options, const struct fe *fe, struct arena *life,
                     struct report *report)
{
    *o = (struct tie){.name = options->name, .rigid = options->rigid};
    TRY(find_nodes(o, options, fe, life, report));
    o->motions = o->n == 1 ? 3 : 6;
    mean_of(o->x, o->node, o->n, fe);
    if (options->placed) v3_scale(o->x, fe->units.length, options->at);
    if (o->n == 1 && options->placed)
        return fail(report, E_MODEL, "interface '%s': a single node has its own place", o->name);
    o->gauge = o->node;
    o->ngauge = o->n;
    if (o->n == 1 ? gauge_node(o, fe, life) : gauge(o, fe, life)) return OK;
    return fail(
        report, E_MODEL,
        "interface '%s': its nodes lie on one line, so nothing tells the rotation about it: take nodes of a face",
        o->name);
}

enum status tie_check(const struct tie *tie, int n, const struct fe *fe, struct report *report)
{
    for (int a = 0; a < n; a++)
        for (int b = 0; b < a; b++)
            for (int i = 0; i < tie[a].n; i++)
                for (int k = 0; k < tie[b].n; k++)
                    if (tie[a].node[i] == tie[b].node[k])
                        return fail(report, E_MODEL, "node %d belongs to two interfaces, '%s' and '%s'",
                                    fe->id[tie[a].node[i]], tie[b].name, tie[a].name);
    return OK;
}

void tie_motion(double *m, const struct tie *o, const double *u)
{
    for (int k = 0; k < 6; k++) m[k] = 0;
    for (int i = 0; i < o->ngauge; i++) dense_gemv(m, 1, o->A + 18 * i, u + 3 * o->gauge[i], 6, 3, 6);
}
