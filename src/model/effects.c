/* effects.c -- what of the effects (kind/effect.h) the model of a scene goes without.
 *
 * Off is done in data: no gravity, no damping matrices, a tensor of zeros for w x J w.  Nothing below looks at wishes, so
 * what is off costs nothing.  Stiffening, rotary inertia and shear of beams are in their reduced data (scene_flex). */
#include "la/vec3.h"
#include "model/parts.h"

static bool off(const struct making *o, enum effect_id id)
{
    return effect_wish(&o->scene->effects, id) == WISH_OFF;
}

static void leave_gravity(struct model *m)
{
    if (v3_norm(m->gravity) > 0) m->off |= effect_bit(EFFECT_GRAVITY);
    for (int i = 0; i < 3; i++) m->gravity[i] = 0;
}

static void leave_gyroscopic(struct making *o)
{
    static const double none[6] = {0, 0, 0, 0, 0, 0};
    if (o->m->space == 3) o->m->off |= effect_bit(EFFECT_GYROSCOPIC);
    for (int i = 1; i < o->m->nbody; i++) o->body[i].swung = none;
}

static void leave_damping(struct making *o)
{
    for (int i = 1; i < o->m->nbody; i++) {
        if (!o->body[i].flex) continue;
        struct flex_body *undamped = TAKE(o->life, struct flex_body, 1);
        *undamped = *o->body[i].flex;
        if (undamped->D) o->m->off |= effect_bit(EFFECT_DAMPING);
        undamped->D = NULL;
        if (!o->body[i].full && o->body[i].flex->D) o->body[i].full = o->body[i].flex;
        o->body[i].flex = undamped;
    }
}

void make_effects(struct making *o)
{
    o->m->off = o->scene->off;
    if (off(o, EFFECT_GRAVITY)) leave_gravity(o->m);
    if (off(o, EFFECT_GYROSCOPIC)) leave_gyroscopic(o);
    if (off(o, EFFECT_DAMPING)) leave_damping(o);
    if (off(o, EFFECT_MOMENTUM)) o->m->drift = DRIFT_ALL;
}
