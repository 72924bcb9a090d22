/* coordinates.c -- places of all coordinates in q and v: fast ones, near ones, the rest; the rate class of bodies.
 *
 * A body is fast if a fast coordinate moves it, or a component of loops that has one. */
#include "model/parts.h"

int scene_k(const struct model_joint *j, int k)
{
    return j->type == JOINT_UNIVERSAL && j->reversed ? 1 - k : k;
}

bool is_fast(const struct making *o, int joint, int k)
{
    int index = o->scene_joint[joint];
    for (int i = 0; index >= 0 && i < o->scene->nfast; i++) {
        const struct scene_choice *c = &o->scene->fast[i];
        if (c->joint == index && (c->k < 0 || c->k == scene_k(&o->joint[joint], k))) return true;
    }
    return false;
}

static bool has_quaternion(const struct model_joint *j)
{
    return j->nq > j->nv;
}

/* One pass numbers the coordinates of one class; near: of slow ones, those of near bodies or the others. */
static void number(struct making *o, bool fast, bool near)
{
    struct model *m = o->m;
    for (int i = 0; i < m->njoint; i++) {
        struct model_joint *j = &o->joint[i];
        if (!fast && o->body[j->child].near != near) continue;
        if (has_quaternion(j)) {
            if (is_fast(o, i, 0) != fast) continue;
            for (int k = 0; k < j->nq; k++) j->iq[k] = m->nq++;
            for (int k = 0; k < j->nv; k++) j->iv[k] = m->n++;
            continue;
        }
        for (int k = 0; k < j->nv; k++) {
            if (is_fast(o, i, k) != fast) continue;
            j->iq[k] = m->nq++;
            j->iv[k] = m->n++;
        }
    }
}

static void name_coordinates(struct making *o)
{
    struct model *m = o->m;
    int s = o->scene->space == 3;
    struct model_coordinate *list = TAKE(o->life, struct model_coordinate, m->nq);
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &o->joint[i];
        const struct joint_kind *kind = joint_kind(j->type, s);
        for (int k = 0; k < j->nq; k++) {
            int quaternion = has_quaternion(j) && k >= j->nq - 4;
            list[j->iq[k]] = (struct model_coordinate){
                .name = arena_print(o->life, "%s.%s", j->name, kind->q[scene_k(j, k)]),
                .joint = i,
                .k = k,
                .iq = j->iq[k],
                .iv = quaternion ? -1 : j->iv[k],
                .fast = is_fast(o, i, k) || o->quick[i],
            };
        }
    }
    m->ncoordinate = m->nq;
    m->coordinate = list;
}

void make_coordinates(struct making *o)
{
    struct model *m = o->m;
    m->n = m->nq = 0;
    number(o, true, true);
    m->ns = m->n;
    number(o, false, true);
    m->near = m->n;
    number(o, false, false);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &o->joint[o->body[i].joint];
        o->body[i].fast = o->body[j->parent].fast || o->quick[o->body[i].joint];
        for (int k = 0; k < j->nv; k++) o->body[i].fast |= j->iv[k] < m->ns;
    }
    name_coordinates(o);
}

bool place_is_fast(const struct making *o, int iv)
{
    if (iv < o->m->ns) return true;
    for (int i = 0; o->m->nloop && i < o->m->njoint; i++)
        for (int k = 0; k < o->joint[i].nv; k++)
            if (o->joint[i].iv[k] == iv) return o->quick[i];
    return false;
}

int rate_place(const struct making *o, int j, int k)
{
    const struct model_joint *joint = &o->joint[o->joint_of[j]];
    return joint->iv[scene_k(joint, k)];
}

int position_place(const struct making *o, int j, int k)
{
    const struct model_joint *joint = &o->joint[o->joint_of[j]];
    return joint->iq[scene_k(joint, k)];
}
