/* prestress.c -- see prestress.h */
#include "reduce/prestress.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "la/vec3.h"
#include "reduce/loads.h"
#include "reduce/stiffen.h"

/* What came in. */
struct parts {
    int n;
    double *kind[LOAD_KINDS]; /* [n x n] Kgeo of the unit load; NULL: not given */
    bool *force;              /* [3 x interfaces] given */
};

/* The fields must rest where the prestressed matrix has no freedoms. */
static enum status check_held(const bool *has, const struct fe *fe, const struct basis *b, const char *path,
                              struct arena *life, struct report *report)
{
    for (int i = 0; i < b->size; i++)
        for (int j = 0; j < b->n && !has[i]; j++)
            if (b->V[i + (size_t)j * (size_t)b->size] != 0)
                return fail(
                    report, E_MODEL,
                    "%s: error: it lacks %s, which moves: hold the nodes of the reference interface and no others",
                    path, fe_freedom(fe, i, life));
    return OK;
}

/* G = V' (Kp - K) V / scale. */
static enum status project(double *G, const struct load_options *w, const struct fe *fe, const struct basis *b,
                           struct arena *scratch, struct report *report)
{
    struct sparse Kp;
    bool *has = TAKE(scratch, bool, b->size);
    double *y = TAKE(scratch, double, b->size), *y0 = TAKE(scratch, double, b->size);
    TRY(fe_read_stiffness(&Kp, has, fe, w->path, scratch, report));
    TRY(check_held(has, fe, b, w->path, scratch, report));
    for (int j = 0; j < b->n; j++) {
        sparse_mul(y, &Kp, b->V + (size_t)j * (size_t)b->size);
        sparse_mul(y0, &fe->K, b->V + (size_t)j * (size_t)b->size);
        for (int i = 0; i <= j; i++) {
            const double *v = b->V + (size_t)i * (size_t)b->size;
            double sum = 0;
            for (int k = 0; k < b->size; k++) sum += v[k] * (y[k] - y0[k]);
            G[i + b->n * j] = G[j + b->n * i] = sum / w->scale;
        }
    }
    return OK;
}

static enum status unknown_kind(const struct load_options *w, struct report *report)
{
    return fail(report, E_USAGE, "--prestress: '%.60s' is none of %s, force-x:NAME, -y, -z", w->kind, load_list());
}

/* "force-y:tip": the interface and the axis; -1: it is no force. */
static int force_of(int *axis, const char *kind, const struct tie *tie, int ntie)
{
    if (strncmp(kind, "force-", 6) != 0 || kind[6] < 'x' || kind[6] > 'z' || kind[7] != ':') return -1;
    *axis = kind[6] - 'x';
    for (int t = 1; t < ntie; t++)
        if (strcmp(tie[t].name, kind + 8) == 0) return t;
    return -1;
}

static enum status read_one(struct parts *o, struct flex_body *body, const struct load_options *w,
                            const struct options *options, const struct fe *fe, const struct basis *b,
                            const struct tie *tie, struct arena *life, struct report *report)
{
    int kind = load_kind(w->kind), axis = 0, at = kind < 0 ? force_of(&axis, w->kind, tie, options->ntie) : -1;
    int nn = b->n * b->n;
    double *G = TAKE(life, double, nn);
    if (kind < 0 && at < 0) return unknown_kind(w, report);
    if (kind >= 0 ? o->kind[kind] != NULL : o->force[3 * at + axis])
        return fail(report, E_USAGE, "--prestress %s is given twice", w->kind);
    struct arena *scratch = arena_open();
    enum status status = project(G, w, fe, b, scratch, report);
    arena_close(scratch);
    TRY(status);
    if (kind >= 0) {
        o->kind[kind] = G;
        return OK;
    }
    o->force[3 * at + axis] = true;
    for (int k = 0; k < nn; k++) body->node[at].S[axis + 3 * k] = -G[k];
    return OK;
}

/* All kinds at once, from the stress of the mesh's elements. */
static enum status from_stress(struct parts *o, struct flex_body *body, const struct options *options,
                               const struct fe *fe, const struct basis *b, const struct tie *tie, struct arena *life,
                               struct report *report)
{
    const struct fe_units *u = &fe->units;
    double E = options->E * u->mass / (u->length * u->time * u->time);
    double **G = TAKE(life, double *, LOAD_KINDS + 3 * options->ntie);
    TRY(stiffen_make(G, fe, b, tie, options->ntie, E, options->nu, life, report));
    for (int k = 0; k < LOAD_KINDS; k++) o->kind[k] = G[k];
    for (int t = 1; t < options->ntie; t++)
        for (int k = 0; k < 3; k++) {
            const double *S = G[LOAD_KINDS + 3 * (t - 1) + k];
            o->force[3 * t + k] = true;
            for (int at = 0; at < b->n * b->n; at++) body->node[t].S[k + 3 * at] = -S[at];
        }
    return OK;
}

/* X_lm of one pair of fields from the six spins and three twists.  With P_k = spin-kk:
 *     P_1 = -(X_22 + X_33) ...              X_11 = (P_1 - P_2 - P_3) / 2
 *     P_12 = (P_1 + P_2 + X_12 + X_21) / 2  X_12 + X_21 = 2 P_12 - P_1 - P_2
 *     T_3 = X_12 - X_21 */
static void solve(double *X, const struct parts *p, int at)
{
    double P[6], T[3];
    for (int k = 0; k < 6; k++) P[k] = p->kind[LOAD_SPIN + k] ? p->kind[LOAD_SPIN + k][at] : 0;
    for (int k = 0; k < 3; k++) T[k] = p->kind[LOAD_TWIST + k] ? p->kind[LOAD_TWIST + k][at] : 0;
    for (int k = 0; k < 3; k++) X[4 * k] = P[k] - (P[0] + P[1] + P[2]) / 2;
    for (int pair = 0; pair < 3; pair++) {
        static const int first[3] = {0, 0, 1}, second[3] = {1, 2, 2}, third[3] = {2, 1, 0};
        int l = first[pair], m = second[pair];
        double sum = p->kind[LOAD_SPIN + 3 + pair] ? 2 * P[3 + pair] - P[l] - P[m] : 0;
        double difference = (third[pair] == 1 ? -1 : 1) * T[third[pair]]; /* X_lm - X_ml */
        X[l + 3 * m] = (sum + difference) / 2;
        X[m + 3 * l] = (sum - difference) / 2;
    }
}

static void print_missing(const struct parts *p, const struct options *options, const struct tie *tie)
{
    int missing = 0;
    for (int k = 0; k < LOAD_KINDS; k++)
        if (!p->kind[k])
            fprintf(stderr, "%s %s", missing++ ? "," : "geometric stiffness: taken as zero, not given:", load_names[k]);
    for (int t = 1; t < options->ntie; t++)
        for (int k = 0; k < 3; k++)
            if (!p->force[3 * t + k])
                fprintf(stderr, "%s force-%c:%s",
                        missing++ ? "," : "geometric stiffness: taken as zero, not given:", "xyz"[k], tie[t].name);
    if (missing) fprintf(stderr, "\n");
}

/* The diagonal of X needs all three spins about the axes. */
static enum status check_spins(const struct parts *p, struct report *report)
{
    bool any = false, all = true;
    for (int k = 0; k < 3; k++) {
        any = any || p->kind[LOAD_SPIN + k];
        all = all && p->kind[LOAD_SPIN + k];
    }
    for (int k = 3; k < 6; k++) any = any || p->kind[LOAD_SPIN + k];
    if (!any || all) return OK;
    return fail(report, E_USAGE,
                "--prestress: spin-xx, spin-yy and spin-zz go together, and spin-xy, -xz, -yz need them");
}

enum status prestress_read(struct flex_body *body, const struct options *options, const struct fe *fe,
                           const struct basis *basis, const struct tie *tie, struct arena *life, struct report *report)
{
    struct parts parts = {.n = basis->n, .force = TAKE(life, bool, 3 * options->ntie)};
    if (!options->nload && !options->stiffening) return OK;
    if (options->stiffening) TRY(from_stress(&parts, body, options, fe, basis, tie, life, report));
    for (int i = 0; i < options->nload; i++)
        TRY(read_one(&parts, body, options->load + i, options, fe, basis, tie, life, report));
    TRY(check_spins(&parts, report));
    for (int at = 0; at < basis->n * basis->n; at++) {
        for (int k = 0; k < 3; k++)
            body->s[k + 3 * at] = parts.kind[LOAD_ACCEL + k] ? parts.kind[LOAD_ACCEL + k][at] : 0;
        solve(body->xs + 9 * at, &parts, at);
    }
    if (!options->quiet) print_missing(&parts, options, tie);
    return OK;
}
