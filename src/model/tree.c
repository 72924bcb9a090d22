/* tree.c -- the spanning tree: from the ground outwards, breadth first, joints in the deck's order.
 *
 * A joint met from its second body is turned round: with axes z -> -z, y -> -y its coordinate is still that
 * of the deck's second body against its first; a universal joint's two axes change places and sign.
 * Spherical, planar and free joints cannot be turned so: their coordinates are of the body farther from
 * the ground against the nearer one. */
#include <string.h>

#include "la/rot.h"
#include "la/vec3.h"
#include "model/parts.h"

static void turn_round(double *E, const double *E0, enum joint_type type)
{
    if (type == JOINT_UNIVERSAL) {
        v3_scale(E, -1, E0 + 3);
        v3_scale(E + 3, -1, E0);
        v3_scale(E + 6, -1, E0 + 6);
    } else if (type == JOINT_REVOLUTE || type == JOINT_PRISMATIC || type == JOINT_CYLINDRICAL) {
        v3_copy(E, E0);
        v3_scale(E + 3, -1, E0 + 3);
        v3_scale(E + 6, -1, E0 + 6);
    } else {
        memcpy(E, E0, 9 * sizeof *E);
    }
}

/* Hangs body `child` of the scene on `parent` by a joint with axes E (world, drawn) at the world point at. */
static struct model_joint *hang(struct making *o, int parent, int child, enum joint_type type, const double *at,
                                const double *E)
{
    struct model *m = o->m;
    const struct scene_body *pb = &o->scene->body[parent], *cb = &o->scene->body[child];
    int i = m->nbody++;
    struct model_joint *j = &o->joint[m->njoint];
    double arm[3];
    o->body_of[child] = i;
    o->body[i] =
        (struct model_body){.name = cb->name, .mass = cb->mass, .parent = o->body_of[parent], .joint = m->njoint++};
    memcpy(o->body[i].inertia, cb->inertia, sizeof cb->inertia);
    v3_copy(o->body[i].at, cb->at);
    memcpy(o->body[i].R, cb->R, sizeof cb->R);
    *j = (struct model_joint){.type = type, .parent = o->body_of[parent], .child = i};
    v3_diff(arm, at, pb->at);
    m3_tmul(j->a, pb->R, arm);
    v3_diff(arm, at, cb->at);
    m3_tmul(j->b, cb->R, arm);
    m3_tmulm(j->Ea, pb->R, E);
    m3_tmulm(j->Eb, cb->R, E);
    return j;
}

static void hang_by(struct making *o, int index, int parent, int child)
{
    const struct scene_joint *sj = &o->scene->joint[index];
    double E[9];
    bool reversed = child == sj->first;
    if (reversed)
        turn_round(E, sj->E, sj->kind->type);
    else
        memcpy(E, sj->E, sizeof E);
    struct model_joint *j = hang(o, parent, child, sj->kind->type, sj->at, E);
    int s = o->scene->space == 3;
    j->name = sj->name;
    j->reversed = reversed;
    j->nq = sj->kind->nq[s];
    j->nv = sj->kind->nv[s];
    o->joint_of[index] = j->child - 1;
    o->scene_joint[j->child - 1] = index;
}

static void hang_free(struct making *o, int body)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const struct scene_body *sb = &o->scene->body[body];
    int s = o->scene->space == 3;
    const struct joint_kind *kind = joint_kind(JOINT_FREE, s);
    diag_warn(o->diags, sb->node, AT_KEY, "W-unconnected", "body '%s' hangs on no joint: it moves freely", sb->name);
    struct model_joint *j = hang(o, 0, body, JOINT_FREE, sb->at, identity);
    j->name = arena_print(o->life, "%s_free", sb->name);
    j->nq = kind->nq[s];
    j->nv = kind->nv[s];
    o->scene_joint[j->child - 1] = -1;
}

/* Joints by body, as lists threaded through two arrays: first[b], next[2 j + side]. */
struct threads {
    int *first, *next;
};

static struct threads thread_joints(struct making *o)
{
    const struct scene *scene = o->scene;
    struct threads t = {TAKE(o->life, int, scene->nbody), TAKE(o->life, int, 2 * scene->njoint)};
    for (int i = 0; i < scene->nbody; i++) t.first[i] = -1;
    for (int j = scene->njoint - 1; j >= 0; j--) {
        const int ends[2] = {scene->joint[j].first, scene->joint[j].second};
        for (int side = 0; side < 2; side++) {
            t.next[2 * j + side] = t.first[ends[side]];
            t.first[ends[side]] = 2 * j + side;
        }
    }
    return t;
}

static void reach_from(struct making *o, const struct threads *t, int *queue, int tail)
{
    const struct scene *scene = o->scene;
    for (int head = tail - 1; head < tail; head++) {
        int body = queue[head];
        for (int e = t->first[body]; e >= 0; e = t->next[e]) {
            int other = e & 1 ? scene->joint[e / 2].first : scene->joint[e / 2].second;
            if (o->body_of[other] >= 0) continue;
            hang_by(o, e / 2, body, other);
            queue[tail++] = other;
        }
    }
}

enum status make_tree(struct making *o)
{
    const struct scene *scene = o->scene;
    int n = scene->nbody;
    o->body = TAKE(o->life, struct model_body, n);
    o->joint = TAKE(o->life, struct model_joint, n);
    o->body_of = TAKE(o->life, int, n);
    o->joint_of = TAKE(o->life, int, scene->njoint);
    o->scene_joint = TAKE(o->life, int, n);
    int *queue = TAKE(o->life, int, n);
    for (int i = 1; i < n; i++) o->body_of[i] = -1;
    for (int i = 0; i < scene->njoint; i++) o->joint_of[i] = -1;
    o->body[0] = (struct model_body){.name = "ground", .parent = -1, .joint = -1, .R = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    o->m->nbody = 1;
    struct threads t = thread_joints(o);
    queue[0] = 0;
    reach_from(o, &t, queue, 1);
    for (int i = 1; i < n; i++) { /* an island: free, with what hangs on it */
        if (o->body_of[i] >= 0) continue;
        hang_free(o, i);
        queue[0] = i;
        reach_from(o, &t, queue, 1);
    }
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        if (o->joint_of[i] >= 0) continue;
        diag_error(o->diags, j->node, AT_KEY, "E-loop", "constraint '%s' closes a loop", j->name);
        diag_hint(o->diags, "'%s' and '%s' are joined already by other constraints; only trees can be simulated",
                  scene->body[j->first].name, scene->body[j->second].name);
        return E_DECK;
    }
    return OK;
}
