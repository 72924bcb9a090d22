/* floating.c -- see floating.h */
#include "open/floating.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

static const double FADES = 1e-8; /* what is left of T there, which is good to 16 digits */
static const double MOST = .1; /* of the motion of the bodies against the whole may change in a step for the energy */

/* --- the ends of the step ----------------------------------------------------------------------- */

static bool is_at(const struct floating *o, int end, const double *q, const double *v)
{
    if (!o->known[end]) return false;
    for (int i = 0; i < o->model->nq; i++)
        if (o->q[end][i] != o->still[i] * q[i]) return false;
    for (int i = 0; i < o->model->n; i++)
        if (o->v[end][i] != v[i]) return false;
    return true;
}

static void keep(struct floating *o, int end, const double *q, const double *v)
{
    for (int i = 0; i < o->model->nq; i++) o->q[end][i] = o->still[i] * q[i];
    for (int i = 0; i < o->model->n; i++) o->v[end][i] = v[i];
    o->known[end] = true;
}

static void sample(struct floating *o, int end, const double *q, const double *v)
{
    keep(o, end, q, v);
    o->ops->move(o->there, o->q[end], o->v[end], FAST);
    for (int i = 0; i < o->n; i++)
        o->ops->aggregate(o->there, &o->part[i].end[end], o->part[i].body, o->part[i].n, AGGREGATE_MOTION);
}

/* A step starts where the last one has ended. */
static void sample_start(struct floating *o, const double *q, const double *v)
{
    if (is_at(o, 0, q, v)) return;
    if (!is_at(o, 1, q, v)) {
        sample(o, 0, q, v);
        return;
    }
    keep(o, 0, q, v);
    for (int i = 0; i < o->n; i++) o->part[i].end[0] = o->part[i].end[1];
}

static void sample_ends(struct floating *o, const struct instant *x)
{
    sample_start(o, x->qa, x->va);
    sample(o, 1, x->qb, x->vb);
}

/* --- the centre of mass ------------------------------------------------------------------------- */

static void centre(double *c, const struct floater *f, int end, const double *q)
{
    v3_copy(c, f->end[end].c);
    for (int k = 0; k < f->nslide; k++) v3_axpy(c, q[f->slide[k]], f->e[k]);
}

/* How far c_a + h (p_a + p_b)/(2 m) is from the centre at q1, the end of the step. */
static void left_behind(double *d, const struct floater *f, const struct instant *x, const double *q1)
{
    const double half = .5 * (x->tb - x->ta) / f->end[0].m;
    double c[3];
    centre(c, f, 1, q1);
    centre(d, f, 0, x->qa);
    v3_axpy(d, half, f->end[0].p);
    v3_axpy(d, half, f->end[1].p);
    v3_take(d, c);
}

static void slide(double *q, const struct floater *f, const double *d)
{
    for (int k = 0; k < f->nslide; k++) q[f->slide[k]] += v3_dot(f->e[k], d);
}

void floating_place(struct floating *o, struct instant *settled, const struct instant *x)
{
    sample_ends(o, x);
    *settled = *x;
    settled->q = memcpy(o->at, x->q, sizeof *o->at * (size_t)o->model->nq);
    settled->v = memcpy(o->moving, x->v, sizeof *o->moving * (size_t)o->model->n);
    settled->qb = memcpy(o->to, x->qb, sizeof *o->to * (size_t)o->model->nq);
    for (int i = 0; i < o->n; i++) {
        double d[3];
        left_behind(d, &o->part[i], x, x->qb);
        slide(o->to, &o->part[i], d);
    }
}

/* --- the balances ------------------------------------------------------------------------------- */

/* The rate at which motion against the whole, of kinetic energy T_rel, must grow for the energy `missing` per unit
 * time. Both vanish with that motion; where it turns round within a step they say little of each other, and where it is
 * hardly there round-off of T says nothing. */
static double stretch(double missing, double T_rel, double T, double h)
{
    const double least = FADES * T, twice = 2 * T_rel, size = twice * twice + least * least;
    const double k = size > 0 ? missing * twice / size : 0, much = MOST / (h * k);
    return fabs(much) < 1 ? k * much * much : k;
}

/* What is missing from now to the change from a to b, per unit time. */
static void find_change(struct motion_change *o, const struct aggregate *now, const struct floater *f,
                        const struct instant *x)
{
    const struct aggregate *a = &f->end[0], *b = &f->end[1];
    const double h = x->tb - x->ta, per = 1 / h;
    double Jinv[6], w[3], L[3], ca[3], cb[3];
    centre(ca, f, 0, x->qa);
    centre(cb, f, 1, x->qb);
    for (int k = 0; k < 3; k++) {
        o->dr[k] = .5 * (ca[k] + cb[k]) - now->c[k];
        o->dv[k] = (.5 * (a->p[k] + b->p[k]) - now->p[k]) / now->m;
        o->a[k] = (per * (b->p[k] - a->p[k]) - now->F[k]) / now->m;
        L[k] = per * (b->L[k] - a->L[k]) - now->N[k];
    }
    s3_invert(Jinv, now->J); /* not finite where nothing turns about an axis */
    s3_mul(w, Jinv, now->L);
    s3_mul(o->al, Jinv, L);
    const double missing = per * (b->T - a->T) - now->W - v3_dot(o->al, now->L);
    o->k = x->jump ? 0 : stretch(missing, now->T - .5 * v3_dot(w, now->L), now->T, h);
    v3_axpy(o->al, -o->k, w);
}

void floating_balance(struct floating *o, struct sweep *s, const struct instant *x)
{
    for (int i = 0; i < o->n; i++) {
        const struct floater *f = &o->part[i];
        struct aggregate now;
        struct motion_change change;
        o->ops->aggregate(s, &now, f->body, f->n, AGGREGATE_FORCES);
        find_change(&change, &now, f, x);
        o->ops->adjust_motion(s, &change, &now, f->body, f->n);
        slide(o->at, f, change.dr);
        for (int k = 0; k < f->nslide; k++) o->moving[f->iv[k]] += v3_dot(f->e[k], change.dv);
    }
}

/* Velocities of the root for the velocity dv of the centre, and for turning by w about it; stands at end 1. */
static void push_root(const struct floating *o, double *v, const struct floater *f, const double *dv, const double *w)
{
    double arm[3], d[3];
    v3_diff(arm, f->hung, f->end[1].c);
    v3_copy(d, dv);
    v3_cross_add(d, w, arm);
    for (int k = 0; k < f->nv; k++) {
        double x[3], axis[3];
        o->ops->partial(o->there, x, axis, f->body[0], f->hung, f->iv[k]);
        v[f->iv[k]] += k < f->nslide ? v3_dot(f->e[k], d) : v3_dot(axis, w);
    }
}

/* Trees as one: mass, centre, momentum, angular momentum about the centre. */
struct sum {
    double m, c[3], p[3], L[3], J[6];
};

/* c: where the centres are [3] each. */
static void add_up(struct sum *o, const struct floater *f, int n, int end, double (*c)[3])
{
    *o = (struct sum){.m = 0};
    for (int i = 0; i < n; i++) {
        double d[3];
        v3_diff(d, c[i], c[0]);
        o->m += f[i].end[end].m;
        v3_axpy(o->c, f[i].end[end].m, d);
        v3_add(o->p, f[i].end[end].p);
    }
    v3_scale(o->c, 1 / o->m, o->c);
    v3_add(o->c, c[0]);
    for (int i = 0; i < n; i++) {
        const struct aggregate *x = &f[i].end[end];
        double d[3];
        v3_diff(d, c[i], o->c);
        v3_add(o->L, x->L);
        v3_cross_add(o->L, d, x->p);
        for (int k = 0; k < 3; k++) {
            o->J[k] += x->J[k] + x->m * (v3_dot(d, d) - d[k] * d[k]);
            o->J[3 + k] += x->J[3 + k] - x->m * d[k == 2 ? 1 : 0] * d[k == 0 ? 1 : 2];
        }
    }
}

/* left_behind() of the trees of a group: d [n].  Over several steps of the
 * midpoint rule momenta at both ends do not tell where forces of that time have
 * led a tree, only where the whole group is if nothing but gravity acts on it.
 */
static void all_behind(double (*d)[3], const struct floating *o, const struct group *g, const struct instant *x,
                       const double *q1)
{
    const struct floater *f = &o->part[g->first];
    double m = 0, sum[3] = {0};
    for (int i = 0; i < g->n; i++) {
        left_behind(d[i], &f[i], x, q1);
        v3_axpy(sum, f[i].end[0].m, d[i]);
        m += f[i].end[0].m;
    }
    if (x->t < x->tb || (g->n == 1 && g->alone)) return;
    v3_scale(sum, g->alone ? 1 / m : 0, sum);
    for (int i = 0; i < g->n; i++) v3_copy(d[i], sum);
}

/* Centres at both ends, the second where the momenta lead. */
static void find_centres(struct floating *o, const struct group *g, const struct instant *x, const double *q1)
{
    const struct floater *f = &o->part[g->first];
    all_behind(o->behind, o, g, x, q1);
    for (int i = 0; i < g->n; i++) {
        centre(o->centre[0][i], &f[i], 0, x->qa);
        centre(o->centre[1][i], &f[i], 1, q1);
        v3_add(o->centre[1][i], o->behind[i]);
    }
}

/* Velocity of the centre and turn of the whole group for p_b = p_a + h m g, L_b = L_a; false: there is none. */
static bool find_rest(double *dv, double *w, double *c, struct floating *o, const double *q1, const struct group *g,
                      const struct instant *x)
{
    const struct floater *f = &o->part[g->first];
    struct sum a, b;
    double dL[3], Jinv[6];
    find_centres(o, g, x, q1);
    add_up(&a, f, g->n, 0, o->centre[0]);
    add_up(&b, f, g->n, 1, o->centre[1]);
    for (int k = 0; k < 3; k++) dv[k] = (a.p[k] - b.p[k]) / b.m + (x->tb - x->ta) * o->model->gravity[k];
    v3_diff(dL, a.L, b.L);
    s3_invert(Jinv, b.J);
    s3_mul(w, Jinv, dL);
    v3_copy(c, b.c);
    return isfinite(v3_dot(dv, dv) + v3_dot(w, w));
}

/* What the iteration has left in the momenta of a group is far below what the step is good for.  Turning changes where
 * the momenta lead its trees, so that for more than one it takes some passes. */
static void finish(struct floating *o, double *q1, double *v1, const struct group *g, const struct instant *x)
{
    enum { PASSES = 6 };
    struct floater *f = &o->part[g->first];
    double dv[3], w[3], c[3];
    for (int i = 0; i < g->n; i++) o->ops->aggregate(o->there, &f[i].end[1], f[i].body, f[i].n, AGGREGATE_INERTIA);
    for (int pass = 0; pass < (g->n > 1 ? PASSES : 1) && find_rest(dv, w, c, o, q1, g, x); pass++)
        for (int i = 0; i < g->n; i++) {
            struct aggregate *b = &f[i].end[1];
            double d[3], u[3], L[3];
            v3_diff(d, o->centre[1][i], c);
            v3_copy(u, dv);
            v3_cross_add(u, w, d);
            push_root(o, v1, &f[i], u, w);
            v3_axpy(b->p, b->m, u);
            s3_mul(L, b->J, w);
            v3_add(b->L, L);
        }
    o->known[1] = false;
}

void floating_settle(struct floating *o, double *q1, double *v1, const struct instant *x)
{
    for (int i = 0; i < o->ntumbler; i++) tumbler_settle(&o->tumbler[i], q1, v1, x);
    if (o->n) sample_ends(o, x);
    for (int i = 0; i < o->ngroup; i++)
        if (o->group[i].alone) finish(o, q1, v1, &o->group[i], x);
    for (int i = 0; i < o->ngroup; i++) {
        const struct group *g = &o->group[i];
        all_behind(o->behind, o, g, x, q1);
        for (int k = 0; k < g->n; k++) slide(q1, &o->part[g->first + k], o->behind[k]);
    }
}
