/* nodes.c -- where things stand on a flexible body: its frame, or massless bodies at its nodes.
 *
 * The frame moves with the node of the inboard joint.  What stands at another node stands on a body of its own
 * there, held by a joint of no freedom, which the elastic coordinates move; one for each node in use. */
#include <string.h>

#include "flex/pick.h"
#include "la/vec3.h"
#include "model/parts.h"

static void hold(struct making *o, int parent, int node)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    struct model *m = o->m;
    const struct model_body *p = &o->body[parent];
    struct model_joint *j = &o->joint[m->njoint];
    struct model_body *body = &o->body[m->nbody];
    double arm[3];
    *body = (struct model_body){.parent = parent, .joint = m->njoint, .at_node = true, .node = node, .component = -1};
    body->name = arena_print(o->life, "%s.node%d", p->name, node + 1);
    m3_mul(arm, p->R, p->flex->node[node].x);
    v3_sum(body->at, p->at, arm);
    memcpy(body->R, p->R, sizeof body->R);
    *j = (struct model_joint){.name = body->name, .type = JOINT_FIXED, .parent = parent, .child = m->nbody};
    v3_copy(j->a, p->flex->node[node].x);
    memcpy(j->Ea, identity, sizeof identity);
    memcpy(j->Eb, identity, sizeof identity);
    o->scene_joint[m->njoint++] = -1;
    m->nbody++;
}

/* The model's body that a place in the world, as drawn, on the scene's body belongs to; made where there is none yet. */
static int body_at_node(struct making *o, int scene_body, const double *world)
{
    const struct scene_body *sb = &o->scene->body[scene_body];
    int parent = o->body_of[scene_body];
    double offset[3];
    if (!sb->flex) return parent;
    int node = scene_node(offset, sb, world);
    if (node == o->body[parent].flex->reference) return parent;
    for (int i = parent + 1; i < o->m->nbody; i++)
        if (o->body[i].at_node && o->body[i].parent == parent && o->body[i].node == node) return i;
    hold(o, parent, node);
    return o->m->nbody - 1;
}

int place_on(double *p, struct making *o, int scene_body, const double *world)
{
    int body = body_at_node(o, scene_body, world);
    double arm[3];
    v3_diff(arm, world, o->body[body].at);
    m3_tmul(p, o->body[body].R, arm);
    return body;
}

int marker_on(double *p, struct making *o, const struct marker *m)
{
    const struct scene_body *sb = &o->scene->body[m->body];
    double world[3];
    if (!sb->flex) {
        v3_copy(p, m->p);
        return o->body_of[m->body];
    }
    m3_mul(world, sb->R, m->p);
    v3_add(world, sb->at);
    return place_on(p, o, m->body, world);
}

/* Which of the deck's modes it has; its data without the others. */
static void number_modes(const struct making *o, int index)
{
    struct model_body *body = &o->body[index];
    const bool *still = o->still ? o->still[index] : NULL;
    bool *keep = TAKE(o->life, bool, body->flex->n);
    int *made = TAKE(o->life, int, body->flex->n);
    body->nmade = body->flex->n;
    body->nmode = 0;
    for (int k = 0; k < body->nmade; k++) {
        keep[k] = !still || !still[k];
        if (keep[k]) made[body->nmode++] = k;
    }
    body->made = made;
    if (body->nmode == body->nmade) return;
    body->flex = flex_pick(body->flex, keep, o->life);
    if (body->full) body->full = flex_pick(body->full, keep, o->life);
}

void make_flexible_body(struct making *o, int index, const struct scene_body *sb, const double *joint)
{
    struct model_body *body = &o->body[index];
    double offset[3];
    int node = scene_node(offset, sb, joint);
    body->flex = node == sb->flex->reference ? sb->flex : flex_refer(sb->flex, node, o->life);
    if (sb->full) body->full = node == sb->full->reference ? sb->full : flex_refer(sb->full, node, o->life);
    number_modes(o, index);
    body->mode_q = TAKE(o->life, int, body->nmode);
    body->mode_v = TAKE(o->life, int, body->nmode);
    v3_copy(body->at, sb->origin);
}

int most_nodes(const struct scene *scene)
{
    int n = 0;
    for (int i = 0; i < scene->nbody; i++) n += scene->body[i].flex ? scene->body[i].flex->nnode : 0;
    return n;
}

/* Those of markers: everything that elements.c will look up. */
void make_nodes(struct making *o)
{
    const struct scene *s = o->scene;
    double p[3];
    for (int i = 0; i < s->npoint; i++) marker_on(p, o, &s->point[i].at);
    for (int i = 0; i < s->nmeasure; i++) {
        marker_on(p, o, &s->measure[i].a);
        marker_on(p, o, &s->measure[i].b);
    }
    for (int i = 0; i < s->nforce; i++) {
        marker_on(p, o, &s->force[i].b);
        marker_on(p, o, &s->force[i].a);
    }
}
