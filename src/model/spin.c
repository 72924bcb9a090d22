/* spin.c -- flexible bodies whose geometric stiffening the deck has turned off: what that means for them.
 *
 * A body that joints let turn has a speed from which its linear elasticity gives way (flex/spin.h); it is reported at the
 * start, whether or not the run will reach it. */
#include "flex/spin.h"

#include <math.h>

#include "model/parts.h"

/* Does a joint on its way from the ground turn the body? */
static bool may_turn(const struct making *o, int body)
{
    for (int i = body; i > 0; i = o->body[i].parent)
        if (joint_turning(model_kind(o->m, o->joint[o->body[i].joint].type), NULL) != TURNS_NEVER) return true;
    return false;
}

/* Where the deck has turned a body's stiffening off; NULL: it has not. */
static const struct node *turned_off_at(const struct scene *scene, const struct scene_body *sb)
{
    if (!sb->flex || sb->flex->s) return NULL;
    const struct node *own = node_find(sb->node, "stiffening");
    if (own && !own->implied) return own;
    return node_find(scene->effects_node, "stiffening");
}

static void warn(struct making *o, const struct scene_body *sb, const struct node *at, double limit)
{
    char what[100];
    snprintf(what, sizeof what, "body '%.60s'", sb->node->key);
    if (isfinite(limit))
        diag_warn(o->diags, at, AT_VALUE, "W-stiffening",
                  "%s: linear beam buckles from Omega = %.4g rad/s; turn on geometric stiffening", what, limit);
    else
        diag_warn(o->diags, at, AT_VALUE, "W-stiffening", "%s: loads along the beam will not stiffen or soften it",
                  what);
}

void warn_of_spin(struct making *o)
{
    struct arena *scratch = arena_open();
    for (int i = 1; i < o->scene->nbody; i++) {
        const struct scene_body *sb = &o->scene->body[i];
        const struct node *at = turned_off_at(o->scene, sb);
        double limit = INFINITY, e[3];
        if (!at) continue;
        for (; i < o->scene->nbody && o->scene->body[i].node == sb->node; i++) { /* segments: the weakest */
            const int k = o->body_of[i];
            if (may_turn(o, k)) limit = fmin(limit, flex_spin_worst(e, o->body[k].flex, o->m->space, scratch));
        }
        i--;
        warn(o, sb, at, limit);
    }
    arena_close(scratch);
}
