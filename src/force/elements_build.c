/* elements_build.c -- the elements sorted for the loop: by class, plain ones apart, and which rotations change what. */
#include "force/parts.h"
#include "model/touch.h"

static const struct element_kind *const kinds[] = {[FORCE_LAW] = &element_law,
                                                   [FORCE_VALUE] = &element_value,
                                                   [FORCE_LOAD] = &element_load,
                                                   [FORCE_BETWEEN] = &element_between};

static bool is_plain(struct affine *law, const struct model *m, const struct model_force *f)
{
    return f->type == FORCE_LAW && m->measure[f->measure].type == MEASURE_COORDINATE && f->kind->affine &&
           f->kind->affine(law, f->par);
}

/* Is v[k] a rotation? */
static bool *rotations(const struct model *m, struct arena *life)
{
    bool *turns = TAKE(life, bool, m->n);
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        for (int k = 0; k < j->nv; k++) turns[j->iv[k]] = model_kind(m, j->type)->freedom[k].turns;
    }
    return turns;
}

/* Counts in the row how often the velocities on the ways to the two bodies are met; modes is set for those of
 * flexible bodies. */
static void meet(struct elements *e, bool *modes, int a, int b)
{
    const struct model *m = e->model;
    const int ends[2] = {a, b};
    for (int end = 0; end < 2; end++)
        for (int i = ends[end]; i > 0; i = m->body[i].parent) {
            const struct model_joint *j = &m->joint[m->body[i].joint];
            const struct model_body *p = &m->body[m->body[i].parent];
            for (int k = 0; k < j->nv; k++) row_add(&e->row, j->iv[k], 1);
            for (int k = 0; m->body[i].at_node && k < p->nmode; k++) {
                row_add(&e->row, p->mode_v[k], 1);
                modes[p->mode_v[k]] = true;
            }
        }
}

/* The root of the body's tree, if nothing but its joint holds that to the ground and it lets it go anyhow; else 0. */
static int flying_root(const struct model *m, int body)
{
    while (body > 0 && m->body[body].parent > 0) body = m->body[body].parent;
    return body > 0 && m->joint[m->body[body].joint].nv == (m->space == 2 ? 3 : 6) ? body : 0;
}

/* May what else there is of its tree displace a root that flies, beside its own motion: open/floating.h? */
static bool is_displaced(const struct model *m, int root)
{
    if (root == 0) return false;
    for (int i = 1; i < m->nbody; i++)
        if (i != root && flying_root(m, i) == root) return true;
    return m->body[root].nmode > 0;
}

/* Without rotations the elastic coordinates, which bend the points' ways too. */
static void find_rotations(struct part_of *p, struct elements *e, int a, int b, const bool *turns, struct arena *life)
{
    int *turn = TAKE(life, int, e->model->n);
    bool *modes = TAKE(life, bool, e->model->n);
    meet(e, modes, a, b);
    for (int pass = 0; pass < 2 && !p->nturn; pass++)
        for (int i = 0; i < e->row.n; i++) {
            int k = e->row.k[i];
            if (pass ? modes[k] : turns[k] && e->row.x[k] == 1) turn[p->nturn++] = k;
        }
    p->turn = turn;
    row_clear(&e->row);
}

static void add_plain(struct elements *e, int force, const struct affine *law)
{
    const struct model_measure *def = &e->model->measure[e->model->force[force].measure];
    e->plain[e->nplain[ALL]++] = (struct plain){def->iq, def->iv, force, law->k, law->c, law->rest, law->preload};
}

static void add_other(struct elements *e, int force, const bool *turns, struct arena *life)
{
    const struct model *m = e->model;
    const struct model_force *f = &m->force[force];
    struct part_of *p = &e->other[e->nother[ALL]++];
    struct touched on;
    *p = (struct part_of){.kind = kinds[f->type], .force = force};
    if (p->kind->sort) p->kind->sort(p, m, f);
    if (p->reads) p->last = TAKE(life, double, f->nslot);
    if (p->reads) p->now = TAKE(life, double, f->nslot);
    for (int end = 0; p->nstrain > 0 && end < 2; end++) p->strain[end] = TAKE(life, double, p->nstrain);
    if (!p->ends) return;
    model_touched(&on, m, f, 0);
    const int a = flying_root(m, on.a), b = flying_root(m, on.b);
    if (a != b && ((a > 0 && b > 0) || is_displaced(m, a) || is_displaced(m, b))) {
        p->a = on.a;
        p->b = on.b;
    } else {
        find_rotations(p, e, on.a, on.b, turns, life);
    }
    e->ends[f->cls] = e->ends[ALL] = true;
}

static void add_class(struct elements *e, enum rate cls, const bool *turns, struct arena *life)
{
    for (int i = 0; i < e->model->nforce; i++) {
        const struct model_force *f = &e->model->force[i];
        struct affine law;
        if (f->cls != cls) continue;
        if (is_plain(&law, e->model, f))
            add_plain(e, i, &law);
        else
            add_other(e, i, turns, life);
        if (f->nslot > e->most_slots) e->most_slots = f->nslot;
    }
    e->nplain[cls] = e->nplain[ALL];
    e->nother[cls] = e->nother[ALL];
}

/* A sweep whose FAST bodies are only those that the elements with ends touch. */
static struct sweep *build_ends(const struct elements *e, struct arena *life)
{
    bool *bodies = TAKE(life, bool, e->model->nbody);
    for (int i = 0; i < e->nother[ALL]; i++) {
        struct touched t;
        const struct part_of *p = &e->other[i];
        for (int k = 0; p->ends && model_touched(&t, e->model, &e->model->force[p->force], k); k++)
            if (t.a >= 0) bodies[t.a] = bodies[t.b] = true;
    }
    return e->ops->build(e->model, FOR_STEPS, bodies, life);
}

struct elements *elements_build(const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    struct elements *e = TAKE(life, struct elements, 1);
    e->model = m;
    e->ops = ops;
    e->loads = m->nforce > 0;
    measures_build(&e->measures, m, ops, life);
    e->plain = TAKE(life, struct plain, m->nforce);
    e->other = TAKE(life, struct part_of, m->nforce);
    e->row = row_make(m->n, life);
    e->column = row_make(m->n, life);
    const bool *turns = rotations(m, life);
    e->most_slots = 1;
    add_class(e, FAST, turns, life);
    add_class(e, SLOW, turns, life);
    if (e->ends[ALL]) e->there = build_ends(e, life);
    e->slot = TAKE(life, double, e->most_slots);
    e->slope = TAKE(life, double, e->most_slots);
    e->which = TAKE(life, int, e->most_slots);
    for (int i = 0; i < e->most_slots; i++) e->which[i] = i + 1;
    if (!elements_may_be_passed(e) || elements_turn(e)) return e;
    e->clear_q = TAKE(life, double, m->nq);
    e->clear_v = TAKE(life, double, m->n);
    return e;
}

bool elements_are_pointwise(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].stores) return false;
    return true;
}
