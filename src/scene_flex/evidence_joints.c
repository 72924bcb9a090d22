/* evidence_joints.c -- further joints of a flexible body: mass hangs there, or what closes a loop holds it. */
#include "scene_flex/evidence.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

/* Is a body on the way of others alone, without this one?  Then it holds what hangs on it. */
static bool holds(const struct scene *s, int other, int without, bool *seen)
{
    if (other == 0) return true;
    seen[other] = true;
    for (int i = 0; i < s->njoint; i++) {
        const struct scene_joint *j = &s->joint[i];
        if (joint_is_tie(j->kind) || (j->first != other && j->second != other)) continue;
        const int next = j->first == other ? j->second : j->first;
        if (next == without || seen[next]) continue;
        if (holds(s, next, without, seen)) return true;
    }
    return false;
}

/* Along axis a (body axes) of a node. */
static void add_tie(struct evidence *e, int node, int a, const double *centre, double mass, bool turns)
{
    const struct flex_node *n = &e->all->node[node];
    double lever[3], *b = TAKE(e->b->life, double, e->all->n);
    e->hanging = arena_more(e->b->life, e->hanging, e->o.ntie, &e->hangcap, sizeof *e->hanging);
    e->tie = arena_more(e->b->life, e->tie, e->o.ntie, &e->tiecap, sizeof *e->tie);
    struct hanging *h = &e->hanging[e->o.ntie];
    double *along = h->along;
    struct flex_tie *tie = &e->tie[e->o.ntie++];
    *tie = (struct flex_tie){.b = b, .mass = mass, .held = mass == 0};
    for (int k = 0; k < e->all->n; k++) b[k] = (turns ? n->psi : n->phi)[a + 3 * k];
    h->axis = a;
    v3_copy(h->centre, centre);
    v3_diff(lever, centre, e->all->node[e->all->reference].x);
    for (int i = 0; i < 6; i++) along[i] = i == a + (turns ? 3 : 0);
    const double axis[3] = {a == 0, a == 1, a == 2};
    if (!turns) v3_cross(along + 3, lever, axis);
    for (int r = 0; r < e->o.nrigid; r++)
        for (int i = 0; i < 6; i++) tie->rigid[r] += along[i] * e->recoil[r][i];
}

/* Joints whose other body stands without this one: from the second on they close loops. */
static int holding(const struct evidence *e, bool *seen)
{
    const struct scene *s = e->b->scene;
    int n = 0;
    for (int i = 0; i < s->njoint; i++) {
        const struct scene_joint *j = &s->joint[i];
        if (j->nterm || (j->first != e->index && j->second != e->index)) continue;
        memset(seen, 0, (size_t)s->nbody * sizeof *seen);
        n += holds(s, other_end(s, i, e->index), e->index, seen);
    }
    return n;
}

/* Places at a joint are held; turns, too, where it lets nothing turn. */
void add_ties(struct evidence *e)
{
    const struct scene *s = e->b->scene;
    bool *seen = TAKE(e->b->life, bool, s->nbody);
    const bool loops = holding(e, seen) > 1;
    for (int i = 0; i < s->njoint; i++) {
        const struct scene_joint *j = &s->joint[i];
        double offset[3];
        if (j->nterm || (j->first != e->index && j->second != e->index)) continue;
        const int node = scene_node(offset, e->body, j->first == e->index ? j->from : j->at);
        const int other = other_end(s, i, e->index);
        if (node == e->all->reference) continue;
        memset(seen, 0, (size_t)s->nbody * sizeof *seen);
        const bool held = loops && holds(s, other, e->index, seen);
        double centre[3], lever[3];
        v3_diff(lever, s->body[other].at, e->body->origin);
        m3_tmul(centre, e->body->R, lever);
        if (held || !joint_is_fixed(j->kind)) v3_copy(centre, e->all->node[node].x);
        for (int a = 0; a < s->space; a++) add_tie(e, node, a, centre, held ? 0 : s->body[other].mass, false);
        if (!held || !joint_is_fixed(j->kind)) continue;
        for (int a = s->space == 2 ? 2 : 0; a < 3; a++) add_tie(e, node, a, centre, 0, true);
    }
}

void add_hanging(const struct evidence *e, double *p, double *rigid, const double *d)
{
    for (int k = 0; k < e->o.ntie; k++) {
        const struct flex_tie *tie = &e->tie[k];
        if (tie->held) continue;
        double a = 0;
        for (int i = 0; i < 6; i++) a += d[i] * e->hanging[k].along[i];
        for (int i = 0; i < e->all->n; i++) p[i] -= tie->mass * tie->b[i] * a;
        for (int r = 0; r < e->o.nrigid; r++) rigid[r] -= tie->mass * tie->rigid[r] * a;
    }
}

void add_hanging_turn(const struct evidence *e, double *p, const double *w, const double *x0)
{
    for (int k = 0; k < e->o.ntie; k++) {
        const struct flex_tie *tie = &e->tie[k];
        double x[3], f[3];
        v3_diff(x, e->hanging[k].centre, x0);
        v3_scale(f, v3_dot(w, w), x);
        v3_axpy(f, -v3_dot(w, x), w);
        for (int i = 0; !tie->held && i < e->all->n; i++) p[i] += tie->mass * tie->b[i] * f[e->hanging[k].axis];
    }
}
