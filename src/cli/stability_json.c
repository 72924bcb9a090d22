/* stability_json.c -- see stability_json.h */
#include "cli/stability_json.h"

#include <math.h>
#include <string.h>

#include "out/facts.h"
#include "sim/sim.h"

static bool put_numbers(cJSON *to, const char *name, const double *x, int n, int stride)
{
    cJSON *list = cJSON_CreateArray();
    bool whole = list != NULL;
    for (int i = 0; i < n && whole; i++) whole = facts_add(list, NULL, facts_number(x[(long)i * stride]));
    if (whole) return facts_add(to, name, list);
    cJSON_Delete(list);
    return false;
}

/* A [n x n] by column, as rows: its part of `sign` 1 symmetric, -1 antisymmetric, 0 all. */
static bool put_matrix(cJSON *to, const char *name, const double *A, int n, int sign, struct arena *life)
{
    cJSON *rows = cJSON_CreateArray();
    bool whole = rows != NULL;
    double *B = TAKE_MATRIX(life, double, n, n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double a = A[i + (long)n * j], b = A[j + (long)n * i];
            B[i + (long)n * j] = sign ? (a + sign * b) / 2 : a;
        }
    for (int i = 0; i < n && whole; i++) whole = put_numbers(rows, NULL, B + i, n, n);
    if (whole) return facts_add(to, name, rows);
    cJSON_Delete(rows);
    return false;
}

static bool put_matrices(cJSON *to, const struct classes *c, struct arena *life)
{
    const int n = c->n;
    double *A = TAKE_MATRIX(life, double, n, n);
    classes_sum(A, c->M, n);
    bool whole = put_matrix(to, "M", A, n, 0, life);
    classes_sum(A, c->C, n);
    whole = whole && put_matrix(to, "C", A, n, 1, life) && put_matrix(to, "G", A, n, -1, life);
    classes_sum(A, c->K, n);
    return whole && put_matrix(to, "K", A, n, 1, life) && put_matrix(to, "N", A, n, -1, life);
}

static bool put_coordinates(cJSON *to, const struct stability *o, struct arena *life)
{
    cJSON *list = cJSON_CreateArray();
    bool whole = list != NULL;
    for (int i = 0; i < o->classes.n && whole; i++) {
        cJSON *item = cJSON_CreateObject();
        whole = item && facts_add(item, "name", facts_text(sim_coordinate_name(o->sim, i), life)) &&
                facts_add(item, "fast", cJSON_CreateBool(i < o->classes.ode.ns));
        whole = facts_add(list, NULL, item) && whole;
    }
    if (whole) return facts_add(to, "coordinates", list);
    cJSON_Delete(list);
    return false;
}

/* The chosen columns at a state near, and their change by central differences along coordinate or velocity j. */
static enum status slopes(double *to, struct sim *sim, int j, bool velocity, struct arena *life, struct report *report)
{
    const struct ode2 *ode = sim->stepper.ode;
    const int n = ode->n, m = sim->chosen.n;
    double *q = TAKE(life, double, ode->nq), *v = TAKE(life, double, n), *x = TAKE(life, double, n);
    double *up = TAKE(life, double, m), *down = TAKE(life, double, m);
    const double h = 1e-5 * ode2_usual(ode, j);
    for (int side = -1; side <= 1; side += 2) {
        memcpy(q, sim->x.q, sizeof *q * (size_t)ode->nq);
        memcpy(v, sim->x.v, sizeof *v * (size_t)n);
        x[j] = side * h;
        if (velocity)
            v[j] += x[j];
        else
            sim_move(sim, q, x);
        TRY(sim_row(side > 0 ? up : down, sim, q, v, report));
    }
    for (int i = 0; i < m; i++) to[i] = (up[i] - down[i]) / (2 * h);
    return OK;
}

static enum status put_columns(cJSON *to, struct sim *sim, struct arena *life, struct report *report, bool *whole)
{
    const int n = sim->stepper.ode->n, m = sim->chosen.n;
    double *by_q = TAKE_MATRIX(life, double, m, n), *by_v = TAKE_MATRIX(life, double, m, n);
    double *value = TAKE(life, double, m);
    cJSON *list = cJSON_CreateArray();
    *whole = facts_add(to, "columns", list);
    TRY(sim_row(value, sim, sim->x.q, sim->x.v, report));
    for (int j = 0; j < n; j++) {
        TRY(slopes(by_q + (long)m * j, sim, j, false, life, report));
        TRY(slopes(by_v + (long)m * j, sim, j, true, life, report));
    }
    for (int i = sim->ncounted; i < m && *whole; i++) {
        cJSON *item = cJSON_CreateObject();
        *whole = item && facts_add(item, "name", facts_text(sim->columns[i].name, life)) &&
                 facts_add(item, "unit", facts_text(sim->columns[i].unit, life)) &&
                 facts_add(item, "value", facts_number(value[i])) && put_numbers(item, "by_q", by_q + i, n, m) &&
                 put_numbers(item, "by_v", by_v + i, n, m);
        *whole = facts_add(list, NULL, item) && *whole;
    }
    return OK;
}

static bool put_rows(cJSON *to, const struct stability *o, struct arena *life)
{
    cJSON *list = cJSON_CreateArray();
    bool whole = facts_add(to, "rows", list);
    for (const struct stability_row *r = o->row; r < o->row + o->nrow && whole; r++) {
        cJSON *item = cJSON_CreateObject();
        whole = item && facts_add(item, "scheme", cJSON_CreateString(r->kind->name)) &&
                facts_add(item, "ratio", facts_number(r->ratio)) && facts_add(item, "step", facts_number(r->step)) &&
                facts_add(item, "radius", facts_number(r->known ? r->radius : NAN)) &&
                facts_add(item, "own", facts_number(r->own)) &&
                facts_add(item, "fast", facts_number(stability_fast(o, r))) &&
                facts_add(item, "slow", facts_number(stability_slow(o, r))) &&
                facts_add(item, "frequency", facts_number(r->known ? r->frequency : NAN)) &&
                facts_add(item, "most", facts_text(r->most, life)) &&
                facts_add(item, "verdict", cJSON_CreateString(stability_verdict(r)));
        whole = facts_add(list, NULL, item) && whole;
    }
    return whole;
}

enum status stability_json(const struct stability *o, struct sim *sim, struct arena *life, struct report *report)
{
    cJSON *root = cJSON_CreateObject();
    bool columns = false;
    bool whole = root && facts_add(root, "t", facts_number(sim->x.t)) && put_coordinates(root, o, life) &&
                 put_matrices(root, &o->classes, life);
    enum status status = whole ? put_columns(root, sim, life, report, &columns) : OK;
    whole = whole && columns && put_rows(root, o, life);
    if (whole && status == OK) return facts_print(root, false, report);
    cJSON_Delete(root);
    return status != OK ? status : fail(report, E_LIMIT, "out of memory");
}
