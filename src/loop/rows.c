/* rows.c -- see rows.h */
#include "loop/rows.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "tree/sizes.h"

/* --- which there are ---------------------------------------------------------------------------- */

/* Rows and coordinates of each component, in order. */
static void list_parts(struct rows *o, struct arena *life)
{
    const struct model *m = o->tree->model;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < o->ncomponent; i++) {
            struct component *c = &o->component[i];
            if (pass) c->row = TAKE(life, int, c->nrow), c->k = TAKE(life, int, c->nk);
            c->nrow = c->nk = 0;
        }
        for (int r = 0; r < o->loops->nrow; r++) {
            struct component *c = &o->component[m->loop[o->loops->row[r].loop].component];
            if (pass) c->row[c->nrow] = r;
            c->nrow++;
        }
        for (int k = 0; k < o->n; k++) {
            if (o->owner[k] < 0) continue;
            struct component *c = &o->component[o->owner[k]];
            if (pass) c->k[o->column[k] = c->nk] = k;
            c->nk++;
        }
    }
}

/* The coordinates of each row; the loops' own C_q stands in F. */
static void build_matrix(struct rows *o, struct component *c, struct arena *life)
{
    struct loops *l = o->loops;
    c->start = TAKE(life, int, c->nrow + 1);
    for (int r = 0; r < c->nrow; r++) c->start[r + 1] = c->start[r] + l->nk[l->row[c->row[r]].loop];
    c->at = TAKE(life, int, c->start[c->nrow]);
    c->F = TAKE(life, double, c->start[c->nrow]);
    for (int r = 0; r < c->nrow; r++) {
        const int loop = l->row[c->row[r]].loop;
        for (int k = 0; k < l->nk[loop]; k++) c->at[c->start[r] + k] = o->column[l->k[loop][k]];
        if (c->row[r] > l->first[loop]) continue;
        const size_t n = (size_t)l->nk[loop] * (size_t)(l->first[loop + 1] - l->first[loop]);
        memcpy(c->F + c->start[r], l->Cq[loop], sizeof *c->F * n); /* sums have theirs for good */
        l->Cq[loop] = c->F + c->start[r];
    }
}

/* turn [n]: which rotation begins with a coordinate; -1: none.  A path has its three one behind the other. */
static void build_turns(struct rows *o, struct component *c, const int *turn, struct arena *life)
{
    for (int pass = 0; pass < 2; pass++) {
        if (pass) c->turn = TAKE(life, struct row_turn, c->nturn);
        c->nturn = 0;
        for (int e = 0; e < c->start[c->nrow]; e++) {
            const int i = turn[c->k[c->at[e]]], *iv = i < 0 ? NULL : o->tree->moves.turn[i].iv;
            if (!iv || e + 2 >= c->start[c->nrow] || c->k[c->at[e + 1]] != iv[1] || c->k[c->at[e + 2]] != iv[2])
                continue;
            if (pass) c->turn[c->nturn] = (struct row_turn){i, {e, e + 1, e + 2}};
            c->nturn++;
        }
    }
}

void rows_build(struct rows *o, struct open_tree *tree, struct arena *life)
{
    const struct model *m = tree->model;
    const struct moves *moves = &tree->moves;
    *o = (struct rows){.tree = tree, .n = m->n, .ncomponent = m->ncomponent};
    o->loops = loops_build(m, tree->ops, life);
    o->constant = loops_are_constant(o->loops);
    o->component = TAKE(life, struct component, o->ncomponent);
    o->owner = TAKE(life, int, o->n);
    o->column = TAKE(life, int, o->n);
    o->size = TAKE(life, double, o->n);
    o->per = TAKE(life, double, o->n);
    int *turn = TAKE(life, int, o->n);
    for (int i = 0; i < o->n; i++) o->owner[i] = turn[i] = -1;
    for (int l = 0; l < m->nloop; l++)
        for (int k = 0; k < o->loops->nk[l]; k++) o->owner[o->loops->k[l][k]] = m->loop[l].component;
    for (int i = 0; i < moves->nturn; i++) turn[moves->turn[i].iv[0]] = i;
    sizes_fill(o->size, m);
    for (int i = 0; i < o->n; i++) o->per[i] = 1 / o->size[i];
    list_parts(o, life);
    for (int i = 0; i < o->ncomponent; i++) {
        build_matrix(o, &o->component[i], life);
        build_turns(o, &o->component[i], turn, life);
    }
}

/* --- C and C_q at a posture --------------------------------------------------------------------- */

long rows_place(struct rows *o, const double *q)
{
    const long posture = o->constant ? open_take(o->tree, q) : open_place(o->tree, q);
    if (posture != o->placed) loops_place(o->loops, o->tree->sweep, q);
    return o->placed = posture;
}

long rows_linearize(struct rows *o, const double *q)
{
    if (o->constant && o->linear) return o->linear;
    const long posture = rows_place(o, q);
    if (posture != o->linear) loops_jacobian(o->loops, o->tree->sweep);
    return o->linear = posture;
}

/* Columns of a rotation, along the Cayley vector phi from the base in place of the angular velocity:
 * F := F T^-1,  T^-1 = (1 - [phi]x/2)/(1 + |phi|^2/4). */
static void along_phi(double *F, const int *at, const double *phi)
{
    const double s = 1 / (1 + v3_dot(phi, phi) / 4), f[3] = {F[at[0]], F[at[1]], F[at[2]]};
    double x[3]; /* f' [phi]x = (f x phi)' */
    v3_cross(x, f, phi);
    for (int k = 0; k < 3; k++) F[at[k]] = s * (f[k] - x[k] / 2);
}

static void turn_rows(struct rows *o, const struct component *c, const double *dx, const bool *marked)
{
    for (const struct row_turn *turn = c->turn; turn < c->turn + c->nturn; turn++) {
        const int *iv = o->tree->moves.turn[turn->turn].iv;
        if (!marked[turn->turn]) continue;
        along_phi(c->F, turn->at, (const double[]){dx[iv[0]], dx[iv[1]], dx[iv[2]]});
        o->linear = 0;
    }
}

void rows_turn(struct rows *o, const double *dx, const bool *marked)
{
    if (o->tree->moves.nturn == 0 || o->constant) return;
    assert(o->linear == o->placed);
    for (int i = 0; i < o->ncomponent; i++) turn_rows(o, &o->component[i], dx, marked);
}

void rows_values(double *C, const struct rows *o)
{
    assert(o->placed == o->tree->posture.number);
    loops_values(C, o->loops);
}

void rows_values_at(double *C, struct rows *o, const double *q)
{
    if (o->constant) {
        loops_place(o->loops, o->tree->sweep, q);
        o->placed = 0;
    } else {
        rows_place(o, q);
    }
    loops_values(C, o->loops);
}

double rows_worst(int *row, const struct rows *o, const double *C)
{
    double most = 0;
    for (int i = 0; i < o->loops->nrow; i++)
        if (!(fabs(C[i]) <= most)) most = fabs(C[i]), *row = i;
    return most;
}

double rows_misfit(double *C, int *row, struct rows *o, const double *q)
{
    rows_place(o, q);
    rows_values(C, o);
    return rows_worst(row, o, C);
}
