/* near.c -- what the fast class reads or moves besides its own: the near coordinates.
 *
 * They come right behind the fast ones: what happens in the minor steps then stays within the first `near`
 * coordinates, however large the rest of the system is.  Near are the joints of fast bodies, of bodies that
 * fast forces touch, all between them and the ground, and joints whose own coordinate a fast force reads or drives. */
#include "model/parts.h"
#include "model/touch.h"

static void touch_body(struct making *o, int body)
{
    for (; body > 0 && !o->body[body].near; body = o->body[body].parent) o->body[body].near = true;
}

static void touch_coordinate(struct making *o, const struct touched *t)
{
    for (int i = 1; i < o->m->nbody; i++) {
        struct model_body *b = &o->body[i];
        for (int k = 0; k < b->nmode; k++)
            if (b->mode_q[k] == t->iq || b->mode_v[k] == t->iv) b->near = true;
    }
    for (int i = 0; i < o->m->njoint; i++) {
        const struct model_joint *j = &o->joint[i];
        for (int k = 0; k < j->nq; k++)
            if (j->iq[k] == t->iq) o->body[j->child].near = true;
        for (int k = 0; k < j->nv; k++)
            if (j->iv[k] == t->iv) o->body[j->child].near = true;
    }
}

/* bodies: those whose motion is wanted; else single coordinates. */
static void touch_force(struct making *o, const struct model_force *f, bool bodies)
{
    struct touched t;
    for (int i = 0; model_touched(&t, o->m, f, i); i++) {
        if (bodies != (t.a >= 0)) continue;
        if (bodies)
            touch_body(o, t.a), touch_body(o, t.b);
        else
            touch_coordinate(o, &t);
    }
}

void make_near(struct making *o)
{
    const struct model *m = o->m;
    for (int i = 1; i < m->nbody; i++)
        if (o->body[i].fast) touch_body(o, i);
    for (int pass = 0; pass < 2; pass++) /* whole paths before single coordinates, which end a path's walk */
        for (int i = 0; i < m->nforce; i++)
            if (m->force[i].cls == FAST) touch_force(o, &m->force[i], pass == 0);
}
