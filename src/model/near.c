/* near.c -- what the fast class reads or moves besides its own: the near coordinates.
 *
 * They come right behind the fast ones: what happens in the minor steps then stays within the first `near`
 * coordinates, however large the rest of the system is.  Near are the joints of fast bodies, of bodies that
 * fast forces touch, all between them and the ground, and joints whose own coordinate a fast force reads or drives. */
#include "model/parts.h"

static void touch_body(struct making *o, int body)
{
    for (; body > 0 && !o->body[body].near; body = o->body[body].parent) o->body[body].near = true;
}

static void touch_measure(struct making *o, int measure)
{
    const struct model_measure *s = &o->m->measure[measure];
    if (s->type == MEASURE_COORDINATE) {
        o->body[s->b.body].near = true;
        return;
    }
    touch_body(o, s->a.body);
    touch_body(o, s->b.body);
}

static void touch_coordinate(struct making *o, const struct model_slot *s)
{
    for (int i = 1; i < o->m->nbody; i++) {
        struct model_body *b = &o->body[i];
        const int *place = s->type == SLOT_Q ? b->mode_q : b->mode_v;
        for (int k = 0; k < b->nmode; k++)
            if (place[k] == s->index) b->near = true;
    }
    for (int i = 0; i < o->m->njoint; i++) {
        const struct model_joint *j = &o->joint[i];
        const int *place = s->type == SLOT_Q ? j->iq : j->iv;
        for (int k = 0; k < (s->type == SLOT_Q ? j->nq : j->nv); k++)
            if (place[k] == s->index) o->body[j->child].near = true;
    }
}

/* bodies: those whose motion is wanted; else single coordinates. */
static void touch_force(struct making *o, const struct model_force *f, bool bodies)
{
    if (bodies && (f->type == FORCE_LOAD || f->type == FORCE_BUSHING)) touch_body(o, f->b.body);
    if (bodies && f->type == FORCE_BUSHING) touch_body(o, f->a.body);
    if (f->type == FORCE_LAW || f->type == FORCE_VALUE) {
        bool plain = o->m->measure[f->measure].type == MEASURE_COORDINATE;
        if (plain != bodies) touch_measure(o, f->measure);
    }
    for (int i = 0; i < f->nslot; i++) {
        const struct model_slot *s = &f->slot[i];
        if (s->type == SLOT_MEASURE || s->type == SLOT_MEASURE_RATE) {
            bool plain = o->m->measure[s->index].type == MEASURE_COORDINATE;
            if (plain != bodies) touch_measure(o, s->index);
        } else if (!bodies && s->type != SLOT_TIME) {
            touch_coordinate(o, s);
        }
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
