/* rubbing.c -- friction in joints: a contact without a gap, see kind/contact.h */
#include <math.h>

#include "scene_read/parts.h"

int check_coefficients(struct builder *b, struct contact_law *law, double kinetic, double holding, const struct node *n,
                       const char *what)
{
    law->sliding = kinetic;
    law->holding = isnan(holding) ? kinetic : holding;
    if (law->holding >= law->sliding) return 0;
    diag_error(b->diags, node_find(n, "static"), AT_VALUE, "E-static",
               "%s: its friction holds less, %g, than it resists sliding, %g", what, law->holding, law->sliding);
    return 1;
}

static int needs(struct builder *b, const struct node *n, const char *what, const char *text)
{
    diag_error(b->diags, n, AT_VALUE, "E-missing-key", "%s: %s", what, text);
    return 1;
}

/* One coefficient, or two, or none. */
static int read_coefficients(struct builder *b, struct contact_law *law, const struct rubbing_keys *k,
                             const struct node *n, const char *what)
{
    const bool pair = !isnan(k->kinetic) || !isnan(k->holding);
    if (pair && !isnan(k->coefficient)) {
        diag_error(b->diags, node_find(n, "coefficient"), AT_KEY, "E-exclusive",
                   "%s: 'coefficient' stands for both 'static' and 'kinetic'", what);
        return 1;
    }
    if (!pair) {
        law->holding = law->sliding = isnan(k->coefficient) ? 0 : k->coefficient;
        return 0;
    }
    if (isnan(k->kinetic)) return needs(b, n, what, "friction that is 'static' needs a 'kinetic' one, too");
    return check_coefficients(b, law, k->kinetic, k->holding, n, what);
}

int read_rubbing(struct builder *b, struct scene_joint *j, const struct node *n, const char *what)
{
    static const struct key number[] = {
        PARAM_REAL(struct contact_law, sliding, "friction", NULL, 0, INFINITY, KEY_BELOW, NULL, ""), KEYS_END};
    struct scene_friction *o = TAKE(b->life, struct scene_friction, 1);
    struct rubbing_keys k = {NAN, NAN, NAN, NAN, NAN, 0};
    const bool pin = j->kind->freedom[0].turns;
    *o = (struct scene_friction){.node = n, .arm = 1};
    if (n->type == NODE_SCALAR && !pin) {
        if (read_number(&o->law.sliding, n, number, &b->reader)) return 1;
        k.coefficient = o->law.sliding;
    } else if (read_keys(&k, pin ? keys_pin_friction : keys_slide_friction, n, NULL, "'friction'", &b->reader)) {
        return 1;
    }
    if (read_coefficients(b, &o->law, &k, n, what)) return 1;
    if (pin && o->law.holding > 0 && isnan(k.radius))
        return needs(b, n, what, "friction of a pin needs its 'radius', the arm at which it acts");
    if (isnan(k.coefficient) && isnan(k.kinetic) && !(k.preload > 0))
        return needs(b, n, what,
                     pin ? "expected a 'coefficient' and a 'radius', or a 'torque'"
                         : "expected a 'coefficient', or a 'force'");
    o->law.preload = k.preload;
    if (pin && !isnan(k.radius)) o->arm = k.radius;
    if (!isnan(k.length)) o->length = k.length;
    if (o->law.holding > 0 || o->law.preload > 0) j->friction = o; /* all zero: there is none */
    return 0;
}

void make_rubbing(struct builder *b)
{
    struct scene *scene = b->scene;
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_friction *f = scene->joint[i].friction;
        if (!f) continue;
        scene->contact[scene->ncontact++] = (struct scene_contact){.name = scene->joint[i].name,
                                                                   .node = scene->joint[i].node,
                                                                   .pair = PAIR_FRICTION,
                                                                   .law = f->law,
                                                                   .measure = -1,
                                                                   .joint = i,
                                                                   .radius = f->arm,
                                                                   .other = f->length};
    }
}
