/* floating_build.c -- which trees float, and which of them act on each other; see floating.h */
#include "la/vec3.h"
#include "model/touch.h"
#include "open/floating.h"

/* --- who acts on whom --------------------------------------------------------------------------- */

/* Does it let its body move anyhow?  Its displacements come first. */
static bool travels(const struct model *m, const struct model_joint *j)
{
    return j->nv == (m->space == 2 ? 3 : 6);
}

/* Of the bodies that hang on the ground: [nbody]. */
struct roots {
    int *of;         /* each body's root; the ground's is 0 */
    int *count;      /* bodies that have it */
    int *group;      /* a root that it acts on, or that acts on it, by a way of these: the last of them is its own */
    bool *tied;      /* by a loop */
    bool *from_out;  /* a force acts on it from the ground, or one whose moments have a sum */
    bool *turned;    /* one of another tree turns the root itself */
    bool *dependent; /* of the last of a group: a member of it is tied, does not travel or has forces from the ground */
};

static int group_of(const struct roots *r, int root)
{
    while (r->group[root] != root) root = r->group[root] = r->group[r->group[root]];
    return root;
}

static void mark_loop(struct roots *r, int a, int b)
{
    if (r->of[a] != r->of[b]) r->tied[r->of[a]] = r->tied[r->of[b]] = true;
}

static void mark_loops(struct roots *r, const struct model *m)
{
    for (int i = 0; i < m->nloop; i++) {
        const struct model_loop *l = &m->loop[i];
        for (int k = 0; k < l->nterm; k++) mark_loop(r, m->joint[l->term[k].joint].parent, l->term[k].joint + 1);
        if (l->nterm == 0) mark_loop(r, l->first, l->second);
    }
}

/* A force between bodies of two trees; does it act on them away from their centres? */
static void mark_pair(struct roots *r, const struct model *m, const struct model_force *f, int a, int b)
{
    const int root_a = r->of[a], root_b = r->of[b];
    const struct model_measure *s = f->measure >= 0 ? &m->measure[f->measure] : NULL;
    const bool at_centres = s && s->type == MEASURE_DISTANCE && v3_norm(s->a.p) == 0 && v3_norm(s->b.p) == 0;
    if (f->kind && f->kind->held && f->kind->held(f->par)) r->from_out[root_a] = r->from_out[root_b] = true;
    if (root_a == root_b) return;
    if (root_a == 0 || root_b == 0) {
        r->from_out[root_a + root_b] = true;
        return;
    }
    r->group[group_of(r, root_a)] = group_of(r, root_b);
    if (!at_centres) r->turned[root_a] = r->turned[root_b] = true;
}

/* By what they act on.  joint [n]: the one whose velocity it is; -1: of a mode. */
static void mark_forces(struct roots *r, const struct model *m, const int *joint)
{
    for (int i = 0; i < m->nforce; i++) {
        struct touched t;
        model_touched(&t, m, &m->force[i], 0);
        if (t.a >= 0)
            mark_pair(r, m, &m->force[i], t.a, t.b);
        else if (joint[t.iv] >= 0 && m->joint[joint[t.iv]].parent == 0)
            r->from_out[m->joint[joint[t.iv]].child] = true;
    }
}

static void mark_dependent(struct roots *r, const struct model *m)
{
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].parent == 0 && (r->tied[i] || r->from_out[i] || !travels(m, &m->joint[m->body[i].joint])))
            r->dependent[group_of(r, i)] = true;
}

static void find_roots(struct roots *r, const struct model *m, struct arena *life)
{
    int *joint = TAKE(life, int, m->n), **of_bodies[] = {&r->of, &r->count, &r->group};
    bool **marks[] = {&r->tied, &r->from_out, &r->turned, &r->dependent};
    for (int i = 0; i < 3; i++) *of_bodies[i] = TAKE(life, int, m->nbody);
    for (int i = 0; i < 4; i++) *marks[i] = TAKE(life, bool, m->nbody);
    for (int i = 1; i < m->nbody; i++) {
        r->group[i] = i;
        r->of[i] = m->body[i].parent == 0 ? i : r->of[m->body[i].parent];
        r->count[r->of[i]]++;
    }
    for (int i = 0; i < m->n; i++) joint[i] = -1;
    for (int i = 0; i < m->njoint; i++)
        for (int k = 0; k < m->joint[i].nv; k++) joint[m->joint[i].iv[k]] = i;
    mark_loops(r, m);
    mark_forces(r, m, joint);
    mark_dependent(r, m);
}

static bool is_free(const struct roots *r, int root)
{
    return !r->dependent[group_of(r, root)];
}

/* More than one body held in its centre, or one that others that fly turn. */
static bool floats(const struct model *m, const struct roots *r, int body)
{
    if (m->drift == DRIFT_ALL) return false;
    const struct model_body *b = &m->body[body];
    const struct model_joint *j = &m->joint[b->joint];
    if (b->parent != 0 || !travels(m, j) || r->tied[body]) return false;
    if (r->count[body] > 1 || b->flex) return m->drift == DRIFT_NONE;
    return v3_norm(j->b) > 0 || (r->turned[body] && is_free(r, body));
}

static bool is_by_itself(const struct model *m, const struct roots *r, int body)
{
    return m->body[body].parent == 0 && r->count[body] == 1 && !r->turned[body] && !r->tied[body] &&
           !r->from_out[body] && tumbles(m, body);
}

/* --- lists -------------------------------------------------------------------------------------- */

/* Those with a tree that floats, and where its trees begin; of [nbody]: by the last of a group, its number and 1. */
static void list_groups(struct floating *o, int *of, const struct roots *r)
{
    const struct model *m = o->model;
    for (int i = 1; i < m->nbody; i++) {
        if (!floats(m, r, i)) continue;
        int *number = &of[group_of(r, i)];
        if (*number == 0) {
            o->group[o->ngroup++] = (struct group){.alone = is_free(r, i)};
            *number = o->ngroup;
        }
        o->group[*number - 1].n++;
    }
    for (int g = 1; g < o->ngroup; g++) o->group[g].first = o->group[g - 1].first + o->group[g - 1].n;
    for (int i = 1; i < m->nbody; i++) { /* one whose momenta are not looked at leaves the group's unknown */
        if (m->body[i].parent != 0 || floats(m, r, i) || of[group_of(r, i)] == 0) continue;
        o->group[of[group_of(r, i)] - 1].alone = false;
    }
}

static void list_bodies(struct floating *o, const struct roots *r, struct arena *life)
{
    const struct model *m = o->model;
    struct floater **of = TAKE(life, struct floater *, m->nbody);
    int *group = TAKE(life, int, m->nbody), *place = TAKE(life, int, m->nbody);
    o->part = TAKE(life, struct floater, m->nbody);
    o->group = TAKE(life, struct group, m->nbody);
    o->tumbler = TAKE(life, struct tumbler, m->nbody);
    list_groups(o, group, r);
    for (int i = 1; i < m->nbody; i++) {
        if (is_by_itself(m, r, i)) tumbler_make(&o->tumbler[o->ntumbler++], m, i);
        if (floats(m, r, i)) {
            const int g = group[group_of(r, i)] - 1;
            of[i] = &o->part[o->group[g].first + place[g]++];
            of[i]->body = TAKE(life, int, r->count[i]);
            o->n++;
        }
        struct floater *f = of[r->of[i]];
        if (f) f->body[f->n++] = i;
    }
}

/* A sweep whose FAST bodies are those that float; what has no mass at their nodes adds nothing. */
static struct sweep *build_there(const struct floating *o, struct arena *life)
{
    const struct model *m = o->model;
    bool *bodies = TAKE(life, bool, m->nbody);
    for (int i = 0; i < o->n; i++)
        for (int k = 0; k < o->part[i].n; k++) bodies[o->part[i].body[k]] = !m->body[o->part[i].body[k]].at_node;
    return o->ops->build(m, FOR_STEPS, bodies, life);
}

/* The root's velocities, and how its displacements move it. */
static void find_root(struct floating *o, struct floater *f)
{
    const struct model *m = o->model;
    const struct model_joint *j = &m->joint[m->body[f->body[0]].joint];
    f->nv = j->nv;
    f->nslide = m->space;
    f->slide = j->iq;
    f->iv = j->iv;
    v3_copy(f->hung, m->body[0].at);
    m3_mul_add(f->hung, m->body[0].R, j->a);
    for (int k = 0; k < f->nslide; k++) {
        double w[3];
        o->ops->partial(o->there, f->e[k], w, f->body[0], f->hung, j->iv[k]);
        o->still[f->slide[k]] = 0;
    }
}

static void take_memory(struct floating *o, struct arena *life)
{
    for (int i = 0; i < 2; i++) {
        o->q[i] = TAKE(life, double, o->model->nq);
        o->v[i] = TAKE(life, double, o->model->n);
        o->centre[i] = arena_take(life, (size_t)o->n, sizeof *o->centre[i]);
    }
    o->behind = arena_take(life, (size_t)o->n, sizeof *o->behind);
    o->still = TAKE(life, double, o->model->nq);
    o->at = TAKE(life, double, o->model->nq);
    o->to = TAKE(life, double, o->model->nq);
    o->moving = TAKE(life, double, o->model->n);
}

void floating_build(struct floating *o, const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    struct roots roots;
    find_roots(&roots, m, life);
    *o = (struct floating){.model = m, .ops = ops};
    list_bodies(o, &roots, life);
    if (o->n == 0) return;
    take_memory(o, life);
    o->there = build_there(o, life);
    ops->move(o->there, m->q0, m->v0, FAST);
    for (int i = 0; i < m->nq; i++) o->still[i] = 1;
    for (int i = 0; i < o->n; i++) find_root(o, &o->part[i]);
}
