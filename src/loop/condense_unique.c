/* condense_unique.c -- which reactions no dynamics can tell.
 *
 * Each redundant row is a combination of the kept ones, hence a vector lambda with C_q' lambda = 0: forces of the
 * loops that move nothing and can be added to any solution.  What they load, in loops and in the joints of the tree, is
 * not unique. */
#include <math.h>
#include <string.h>

#include "loop/condense_parts.h"

/* lambda with C_q' lambda = 0: what the redundant row r of component i is made of, less the row itself; x [nr] work. */
static void null_vector(double *lambda, double *x, const struct condense *o, int i, int r)
{
    const struct part *p = &o->split.part[i];
    const struct component *c = p->of;
    memset(lambda, 0, sizeof *lambda * (size_t)o->rows.loops->nrow);
    memset(x, 0, sizeof *x * (size_t)p->nr);
    for (int e = c->start[p->kept[r]]; e < c->start[p->kept[r] + 1]; e++)
        if (p->place[c->at[e]] >= 0) x[p->place[c->at[e]]] = c->F[e];
    factor_tsolve(&o->solve.block[i].C_qd, x);
    for (int k = 0; k < p->nr; k++) lambda[p->row[k]] = x[k];
    lambda[p->row[r]] = -1;
}

static void joint_forces(struct condense *o, double (*f)[6], const double *lambda)
{
    const struct open_tree *tree = o->tree;
    memset(o->rt, 0, sizeof *o->rt * (size_t)o->rows.n);
    open_move(o->tree, o->q, o->zero);
    tree->ops->forward(tree->sweep, NULL, o->zero, NULL, ALL);
    rows_place(&o->rows, o->q);
    if (lambda) loops_push(o->rows.loops, tree->sweep, lambda);
    tree->ops->backward(tree->sweep, o->rt, ALL);
    for (int i = 0; i < o->model->njoint; i++) tree->ops->reaction(tree->sweep, f[i], f[i] + 3, i);
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
    for (int i = 0; i < o->rows.loops->nrow; i++)
        if (fabs(lambda[i]) > FELT) unique[o->rows.loops->row[i].loop] = false;
    for (int i = 0; i < o->model->njoint; i++)
        for (int k = 0; k < 6; k++)
            if (fabs(with[i][k] - without[i][k]) > FELT * (1 + fabs(without[i][k])) / o->rows.loops->length)
                unique_joint[i] = false;
    arena_close(scratch);
}

void condense_mark(struct condense *o, bool *unique, bool *unique_joint)
{
    for (int i = 0; i < o->model->nloop; i++) unique[i] = true;
    for (int i = 0; i < o->model->njoint; i++) unique_joint[i] = true;
    if (solve_factor(&o->solve, o->q, 0, NULL) != OK) return;
    for (int i = 0; i < o->split.npart; i++)
        for (int r = o->split.part[i].nr; r < o->split.part[i].of->nrow; r++) {
            null_vector(o->lambda, o->C, o, i, r);
            mark(o, unique, unique_joint, o->lambda);
        }
}
