/* coordinates.c -- places of all coordinates in q and v: fast ones, near ones, the rest; the rate class of bodies.
 *
 * A body's elastic coordinates come behind those of its joint.  A body is fast if a fast coordinate moves or bends it,
 * or a component of loops that has one. */
#include "model/parts.h"

bool is_fast(const struct making *o, int joint, int k)
{
    int index = o->scene_joint[joint];
    for (int i = 0; index >= 0 && i < o->scene->nfast; i++) {
        const struct scene_choice *c = &o->scene->fast[i];
        if (c->joint == index && (c->k < 0 || c->k == model_rate(&o->joint[joint], k))) return true;
    }
    return false;
}

bool mode_is_fast(const struct making *o, int body, int k)
{
    const int made = o->body[body].made[k];
    for (int i = 0; i < o->scene->nfast; i++) {
        const struct scene_choice *c = &o->scene->fast[i];
        if (c->joint < 0 && o->body_of[c->body] == body && (c->k < 0 || c->k == made)) return true;
    }
    return false;
}

static bool has_quaternion(const struct model_joint *j)
{
    return j->nq > j->nv;
}

static void number_joint(struct making *o, int joint, bool fast)
{
    struct model *m = o->m;
    struct model_joint *j = &o->joint[joint];
    if (has_quaternion(j)) {
        if (is_fast(o, joint, 0) != fast) return;
        for (int k = 0; k < j->nq; k++) j->iq[k] = m->nq++;
        for (int k = 0; k < j->nv; k++) j->iv[k] = m->n++;
        return;
    }
    for (int k = 0; k < j->nv; k++) {
        if (is_fast(o, joint, k) != fast) continue;
        j->iq[k] = m->nq++;
        j->iv[k] = m->n++;
    }
}

/* One pass numbers the coordinates of one class; near: of slow ones, those of near bodies or the others. */
static void number(struct making *o, bool fast, bool near)
{
    struct model *m = o->m;
    for (int i = 0; i < m->njoint; i++) {
        struct model_body *b = &o->body[o->joint[i].child];
        if (!fast && b->near != near) continue;
        number_joint(o, i, fast);
        for (int k = 0; k < b->nmode; k++) {
            if (mode_is_fast(o, i + 1, k) != fast) continue;
            b->mode_q[k] = m->nq++;
            b->mode_v[k] = m->n++;
        }
    }
}

static void name_coordinates(struct making *o)
{
    struct model *m = o->m;
    struct model_coordinate *list = TAKE(o->life, struct model_coordinate, m->nq);
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &o->joint[i];
        const struct joint_kind *kind = model_kind(m, j->type);
        for (int k = 0; k < j->nq; k++) {
            int quaternion = has_quaternion(j) && k >= j->nq - 4;
            list[j->iq[k]] = (struct model_coordinate){
                .name = arena_print(o->life, "%s.%s", j->name, joint_name(kind, 0, model_rate(j, k))),
                .joint = i,
                .k = k,
                .iq = j->iq[k],
                .iv = quaternion ? -1 : j->iv[k],
                .fast = is_fast(o, i, k) || o->quick[i],
            };
        }
    }
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &o->body[i];
        for (int k = 0; k < b->nmode; k++)
            list[b->mode_q[k]] = (struct model_coordinate){
                .name = arena_print(o->life, "%s.mode%d", b->name, b->made[k] + 1),
                .joint = b->joint,
                .k = o->joint[b->joint].nq + k,
                .iq = b->mode_q[k],
                .iv = b->mode_v[k],
                .fast = mode_is_fast(o, i, k) || o->supple[i],
            };
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
        struct model_body *b = &o->body[i];
        const struct model_joint *j = &o->joint[b->joint];
        b->fast = o->body[j->parent].fast || o->quick[b->joint] || o->supple[i];
        for (int k = 0; k < j->nv; k++) b->fast |= j->iv[k] < m->ns;
        for (int k = 0; k < b->nmode; k++) b->fast |= b->mode_v[k] < m->ns;
    }
    name_coordinates(o);
}

bool place_is_fast(const struct making *o, int iv)
{
    if (iv < o->m->ns) return true;
    for (int i = 0; o->m->nloop && i < o->m->njoint; i++)
        for (int k = 0; k < o->joint[i].nv; k++)
            if (o->joint[i].iv[k] == iv) return o->quick[i];
    for (int i = 1; o->m->nloop && i < o->m->nbody; i++)
        for (int k = 0; k < o->body[i].nmode; k++)
            if (o->body[i].mode_v[k] == iv) return o->supple[i];
    return false;
}

int rate_place(const struct making *o, int j, int k)
{
    const struct model_joint *joint = &o->joint[o->joint_of[j]];
    return joint->iv[model_rate(joint, k)];
}

int position_place(const struct making *o, int j, int k)
{
    const struct model_joint *joint = &o->joint[o->joint_of[j]];
    return joint->iq[model_rate(joint, k)];
}
