/* direct.c -- matrices of the tree that are solved body by body, without being written down: M^ with a diagonal, and where
 * the tree knows it the whole iteration matrix of a motion. */
#include <string.h>

#include "la/dense.h"
#include "open/open.h"

/* x := M^-1 x where the last sweep has stood. */
static enum status solve_mass(struct open_tree *s, double *x, const double *q, double t, struct trouble *why)
{
    const int n = s->model->n;
    if (s->ops->factor(s->sweep, s->factor, 1, s->zero, NULL, ALL)) {
        s->ops->solve(s->sweep, s->factor, x);
        return OK;
    }
    if (!s->elastic.n) return trouble_set(why, TROUBLE_MASS, -1, 0, t);
    TRY(s->ode.ops->mass(&s->ode, s->M, q, t, ALL, why));
    int pivot = dense_cholesky(s->M, n, n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, t);
    dense_cholesky_solve(s->M, x, n, n);
    return OK;
}

static enum status accel(const struct ode2 *o, double *a, double *w, const double *q, const double *v, double t,
                         struct trouble *why)
{
    struct open_tree *s = o->self;
    const struct instant x = {.t = t, .q = q, .v = v};
    TRY(o->ops->resid(o, a, w, NULL, &x, ALL, why));
    TRY(solve_mass(s, a, q, t, why));
    for (int i = 0; i < o->n; i++) a[i] = -a[i];
    return OK;
}

/* What the engine keeps: that of the whole matrix, or one of M^ and a diagonal where the whole is not known. */
struct factor {
    double moving;
    double of[];
};

static enum status factor(const struct ode2 *o, void *F, double cm, double cc, double ck, const struct instant *x,
                          struct trouble *why)
{
    struct open_tree *s = o->self;
    struct factor *f = F;
    f->moving = s->ops->moving_factor && x->a && (cc != 0 || ck != 0);
    memset(s->d, 0, sizeof *s->d * (size_t)o->n);
    elements_diagonal(s->elements, s->d, cc, ck, x);
    if (f->moving && s->ops->moving_factor(s->sweep, f->of, cm, cc, ck, s->d, x->v, x->a)) return OK;
    f->moving = 0;
    s->placed = false;
    return s->ops->factor(s->sweep, f->of, cm, s->d, x->q, ALL) ? OK : trouble_set(why, TROUBLE_SINGULAR, -1, 0, x->t);
}

static enum status stiffen(const struct ode2 *o, void *F, const double *d, const double *q, double t, unsigned cls,
                           struct trouble *why)
{
    struct open_tree *s = o->self;
    struct factor *f = F;
    if (cls == ALL) open_place(s, q);
    s->placed = s->placed && posture_is(&s->posture, q, s->model->nq);
    f->moving = 0;
    return s->ops->factor(s->sweep, f->of, 1, d, s->placed ? NULL : q, cls)
               ? OK
               : trouble_set(why, TROUBLE_SINGULAR, -1, 0, t);
}

static void solve(const struct ode2 *o, const void *F, double *x)
{
    const struct open_tree *s = o->self;
    const struct factor *f = F;
    if (f->moving)
        s->ops->moving_solve(s->sweep, f->of, x);
    else
        s->ops->solve(s->sweep, f->of, x);
}

void open_direct(struct open_tree *o, struct arena *life)
{
    const size_t bytes = o->ops->factor_size(o->sweep);
    const size_t whole = o->ops->moving_size ? o->ops->moving_size(o->sweep) : 0;
    const bool structured = o->diagonal && !o->elastic.n;
    o->factor = arena_take(life, 1, bytes);
    o->direct = (struct ode2_direct){.accel = accel,
                                     .factor_size = sizeof(struct factor) + (whole > bytes ? whole : bytes),
                                     .price = whole ? 1 : 2,
                                     .least = whole ? 7 : 13,
                                     .factor = structured ? factor : NULL,
                                     .stiffen = stiffen,
                                     .limbs = rosters_limbs(o->model, life),
                                     .solve = solve};
}
