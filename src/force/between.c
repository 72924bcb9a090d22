/* between.c -- kinds that work between two markers: along the strains that they name.
 *
 * With rows g_i of the strains' rates, s_i' = g_i u, of f_i with what is lost,
 *
 *     Q = g_i' f_i,   V = sum V_i,   K += g_i' ks_i g_i,   C += g_i' kv_i g_i
 *
 * where K leaves out how the rows turn: that counts with the force.  Over an interval f_i is that of the mean of the strains
 * at its ends, not of the strain in its middle, from which this differs by the bend of the way: stiff markers would else be
 * together in the middle of steps and apart at their ends, with an energy there that grows as the stiffness (Gonzalez,
 * J. Nonlinear Sci. 6 (1996) 449).  The work is -(V_b - V_a) to round-off: the remainder, of third order, is given back as
 * remainder.c has it. */
#include <math.h>

#include "force/parts.h"
#include "la/vec3.h"

static void frame_of(struct frame *o, double *angle, const struct elements *e, const struct sweep *s,
                     const struct model_point *p, const double *axes)
{
    struct pose b;
    e->ops->pose(s, &b, p->body);
    e->ops->point(s, o->x, o->v, p->body, p->p);
    m3_mulm(o->E, b.R, axes);
    v3_copy(o->w, b.w);
    *angle = b.angle;
}

static void strains_at(struct strains *o, const struct elements *e, const struct sweep *s, const struct model_force *f)
{
    const struct markers *on = f->par;
    struct between x = {.space = e->model->space};
    double angle;
    frame_of(&x.a, &angle, e, s, &f->a, on->Ea);
    frame_of(&x.b, &x.angle, e, s, &f->b, on->Eb);
    x.angle -= angle;
    if (f->nslot > 1) {
        struct action turn;
        measure_at(&turn, &e->measures, s, f->slot[1].index, NULL, NULL);
        x.twist = turn.s;
    }
    o->n = 0;
    o->tilt = 0;
    f->kind->strains(o, f->par, &x);
}

/* Resultant on b: force at at_b, torque; torque on a, whose force is the opposite. */
struct wrench {
    double F[3], n_a[3], n_b[3];
    double kept, lost;          /* powers [W] */
    double force, displacement; /* sizes, squared */
};

static void add(struct wrench *o, const struct strain *s)
{
    const double f = s->f + s->lost;
    o->kept += s->f * s->rate;
    o->lost += s->lost * s->rate;
    if (s->slides) {
        v3_axpy(o->F, f, s->dir);
        o->force += f * f;
        o->displacement += s->s * s->s;
    }
    if (s->turns) {
        v3_axpy(o->n_a, f, s->on_a);
        v3_axpy(o->n_b, f, s->on_b);
    }
}

/* How far the mean of strain i at the ends is from that in the middle. */
static double bend_of(const struct strains *o, const struct part_of *p, int i)
{
    return (p->strain[0][i] + p->strain[1][i]) / 2 - o->of[i].s;
}

/* A turn in space that came round between the ends did so in all its components, however small one is along these axes. */
static bool came_round(const struct strains *o, const struct part_of *p)
{
    static const double ROUND = 1;
    double square = 0;
    for (int i = 0; i < o->n; i++)
        if (!o->of[i].slides) square += bend_of(o, p, i) * bend_of(o, p, i);
    return square >= ROUND * ROUND;
}

/* The forces of the mean strains at the ends; a turn that came round between them stays with its middle. */
static void mean_strains(struct strains *o, const struct part_of *p, const struct model_force *f)
{
    if (f->kind->means) {
        f->kind->means(o, f->par, p->strain[0], p->strain[1]);
        return;
    }
    const bool round = came_round(o, p);
    for (int i = 0; i < o->n; i++)
        if (o->of[i].slides || !round) o->of[i].f -= o->of[i].ks * bend_of(o, p, i);
}

static void load(struct elements *e, struct sweep *s, struct part_of *p, const struct loading *to,
                 const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    struct strains strains;
    struct wrench o = {.kept = 0};
    double back[3];
    strains_at(&strains, e, s, f);
    if (x->qa && x->qb) mean_strains(&strains, p, f);
    for (int i = 0; i < strains.n; i++) add(&o, &strains.of[i]);
    v3_scale(back, -1, o.F);
    e->ops->push(s, f->b.body, strains.at_b, o.F);
    e->ops->push(s, f->a.body, strains.at_a, back);
    e->ops->twist(s, f->b.body, o.n_b);
    e->ops->twist(s, f->a.body, o.n_a);
    if (x->qa && x->qb)
        give_remainder(e, s, to->r, p, p->end[0] - p->end[1] - o.kept * (x->tb - x->ta),
                       fabs(p->end[0]) + fabs(p->end[1]), strains.at_a, strains.at_b, x);
    if (to->dk && f->kind->means)
        tell_change(to->dk, p, strains.of[0].ks, x->qa && x->qb && f->kind->sharp && strains.of[0].f != 0);
    if (to->w) to->w[POWER_DAMPER] += o.lost;
    if (to->effect) *to->effect = (struct effect){sqrt(o.force), v3_norm(o.n_b), sqrt(o.displacement), o.kept + o.lost};
}

static void slopes(struct elements *e, struct sweep *s, struct part_of *p, double *K, double *C,
                   const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct measures *m = &e->measures;
    struct strains strains;
    strains_at(&strains, e, s, f);
    if (f->kind->means && x->qa && x->qb) f->kind->means(&strains, f->par, p->strain[0], p->strain[1]);
    if (f->kind->means && !x->looks) p->kref = strains.of[0].ks;
    for (int i = 0; i < strains.n; i++) {
        const struct strain *g = &strains.of[i];
        row_clear(&e->row);
        if (g->slides) row_add_body(&e->row, m, s, f->b.body, strains.at_b, g->dir, 1);
        if (g->slides) row_add_body(&e->row, m, s, f->a.body, strains.at_a, g->dir, -1);
        if (g->turns) row_add_body(&e->row, m, s, f->b.body, NULL, g->on_b, 1);
        if (g->turns) row_add_body(&e->row, m, s, f->a.body, NULL, g->on_a, 1);
        outer(e, K, &e->row, &e->row, g->ks);
        outer(e, C, &e->row, &e->row, g->kv);
    }
}

static double energy(const struct elements *e, const struct sweep *s, const struct model_force *f, const double *q,
                     const double *v, double *strain)
{
    struct strains strains;
    double V = 0;
    (void)q, (void)v;
    strains_at(&strains, e, s, f);
    for (int i = 0; i < strains.n; i++) V += strains.of[i].V;
    for (int i = 0; strain && i < strains.n; i++) strain[i] = strains.of[i].s;
    return V;
}

static double stored(const struct elements *e, const struct sweep *s, const struct part_of *p, const double *q,
                     const double *v)
{
    return energy(e, s, &e->model->force[p->force], q, v, NULL);
}

static void sort(struct part_of *p, const struct model *m, const struct model_force *f)
{
    (void)m, (void)f;
    p->stores = p->ends = true;
    p->nstrain = MOST_STRAINS;
}

double elements_tilt(const struct elements *e, const struct sweep *s, int force)
{
    const struct model_force *f = &e->model->force[force];
    struct strains strains;
    if (f->type != FORCE_BETWEEN) return 0;
    strains_at(&strains, e, s, f);
    return strains.tilt;
}

static double place(double *rate, const struct elements *e, const struct sweep *s, const struct model_force *f,
                    const double *q, const double *v)
{
    struct strains strains;
    (void)q, (void)v;
    strains_at(&strains, e, s, f);
    *rate = strains.of[0].rate;
    return strains.of[0].s;
}

const struct element_kind element_between = {
    .sort = sort, .load = load, .slopes = slopes, .stored = stored, .end = energy, .place = place};
