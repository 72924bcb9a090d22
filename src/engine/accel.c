/* accel.c -- (2-4) solved for the accelerations: M^ a = -r(q, v, a = 0, t), by the owner's own solver when there is
 * one (articulated bodies on trees: O(n), and no slower for two links), else by Cholesky. */
#include "engine/accel.h"

#include <math.h>

#include "engine/matrix.h"
#include "engine/motion.h"
#include "la/dense.h"

void accel_open(struct accel *c, const struct ode2 *ode, struct effort *effort, struct arena *life)
{
    c->ode = ode;
    c->effort = effort;
    c->life = life;
    if (!ode->direct || !ode->direct->accel) c->M = TAKE_MATRIX(life, double, ode->n, ode->n);
    c->r = TAKE(life, double, ode->n);
}

static enum status dense(struct accel *c, double *a, double *w, const struct instant *x, struct trouble *why)
{
    const struct ode2 *o = c->ode;
    TRY(matrix_need(&c->M, o->n, o->n, c->life, x->t, why));
    TRY(o->ops->resid(o, a, w, NULL, x, ALL, why));
    TRY(o->ops->mass(o, c->M, x->q, x->t, ALL, why));
    c->effort->slow++;
    c->effort->fast++;
    int pivot = dense_cholesky(c->M, o->n, o->n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, x->t);
    for (int i = 0; i < o->n; i++) a[i] = -a[i];
    dense_cholesky_solve(c->M, a, o->n, o->n);
    if (!w || !o->breaks || !o->breaks->jump) return OK;
    if (o->breaks->power && o->breaks->power(o, w, a)) return OK;
    struct instant there = *x; /* drives: their forces, and so their power, depend on a */
    there.a = a;
    c->effort->slow++;
    c->effort->fast++;
    return o->ops->resid(o, c->r, w, NULL, &there, ALL, why);
}

enum status accel_solve(struct accel *c, double *a, double *w, const double *q, const double *v, double t,
                        struct trouble *why)
{
    const struct ode2 *o = c->ode;
    struct instant x = {.t = t, .q = q, .v = v, .ta = t, .tb = t};
    if (o->direct && o->direct->accel && o->direct->accel(o, a, w, q, v, t, NULL) == OK) {
        c->effort->slow++;
        c->effort->fast++;
    } else {
        TRY(dense(c, a, w, &x, why)); /* which knows the coordinate to blame, too */
    }
    for (int i = 0; i < o->n; i++)
        if (!isfinite(a[i])) return trouble_set(why, TROUBLE_NOT_FINITE, i, a[i], t);
    return OK;
}
