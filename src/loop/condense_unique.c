/* condense_unique.c -- which reactions no dynamics can tell.
 *
 * Each redundant row is a combination of the kept ones, hence a vector lambda with C_q' lambda = 0: forces of the
 * loops that move nothing and can be added to any solution.  What they load, in loops and in the joints of the tree, is
 * not unique. */
#include <math.h>
#include <string.h>

#include "la/pivot.h"
#include "loop/condense_parts.h"

/* lambda with C_q' lambda = 0: what the dropped row r of c is made of, less the row itself. */
static void null_vector(struct condense *o, struct part *c, int r, double *lambda)
{
    memset(lambda, 0, sizeof *lambda * (size_t)o->loops->nrow);
    memset(c->x, 0, sizeof *c->x * (size_t)c->nr);
    for (int e = c->of->start[c->kept[r]]; e < c->of->start[c->kept[r] + 1]; e++)
        if (c->place[c->of->at[e]] >= 0) c->x[c->place[c->of->at[e]]] = c->of->F[e];
    pivot_rows_tsolve(c->A, c->prow, c->band, c->x, c->nr, c->ld);
    for (int k = 0; k < c->nr; k++) lambda[c->of->row[c->kept[k]]] = c->x[k];
    lambda[c->of->row[c->kept[r]]] = -1;
}

static void joint_forces(struct condense *o, double (*f)[6], const double *lambda)
{
    memset(o->rt, 0, sizeof *o->rt * (size_t)o->nt);
    open_move(o->tree, o->q, o->zero);
    o->ops->forward(o->sweep, NULL, o->zero, NULL, ALL);
    rows_place(&o->rows, o->q);
    if (lambda) loops_push(o->loops, o->sweep, lambda);
    o->ops->backward(o->sweep, o->rt, ALL);
    for (int i = 0; i < o->model->njoint; i++) o->ops->reaction(o->sweep, f[i], f[i] + 3, i);
}

/* A null vector loads joints and moves nothing: joints that feel it are not unique. */
static void mark(struct condense *o, bool *unique, bool *unique_joint, const double *lambda)
{
    static const double FELT = 1e-8;
    struct arena *scratch = arena_open();
    double(*without)[6] = arena_take(scratch, (size_t)o->model->njoint, sizeof *without);
    double(*with)[6] = arena_take(scratch, (size_t)o->model->njoint, sizeof *with);
    joint_forces(o, without, NULL);
    joint_forces(o, with, lambda);
    for (int i = 0; i < o->loops->nrow; i++)
        if (fabs(lambda[i]) > FELT) unique[o->loops->row[i].loop] = false;
    for (int i = 0; i < o->model->njoint; i++)
        for (int k = 0; k < 6; k++)
            if (fabs(with[i][k] - without[i][k]) > FELT * (1 + fabs(without[i][k])) / o->loops->length)
                unique_joint[i] = false;
    arena_close(scratch);
}

void condense_mark(struct condense *o, bool *unique, bool *unique_joint)
{
    struct trouble why;
    for (int i = 0; i < o->model->nloop; i++) unique[i] = true;
    for (int i = 0; i < o->model->njoint; i++) unique_joint[i] = true;
    if (condense_factor(o, o->q, 0, &why) != OK) return;
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        for (int r = c->nr; r < c->of->nrow; r++) {
            null_vector(o, c, r, o->C2);
            mark(o, unique, unique_joint, o->C2);
        }
    }
}
