/* compliant.c -- contacts that give way: forces along the distance of two surfaces, and friction beside them.
 *
 * On a curve both are one force.  Else of contact NAME they are the measure NAME.gap, over a plane, or NAME.distance, of centres, the force NAME along it
 * (kind/unilateral.h) and NAME.friction (kind/sliding.h). */
#include "kind/sliding.h"
#include "la/vec3.h"
#include "scene_read/parts.h"

int refuse_beside(struct builder *b, const struct node *n, const char *key, const char *what, const char *why,
                  const char *hint)
{
    const struct node *given = node_find(n, key);
    if (!given || given->implied) return 0;
    diag_error(b->diags, given, AT_KEY, "E-exclusive", "%s: '%s' %s", what, key, why);
    diag_hint(b->diags, "%s", hint);
    return 1;
}

int check_loss(struct builder *b, const struct node *n, double e, double speed, const char *what)
{
    const struct node *given = node_find(n, "restitution");
    static const char loss[] = "says what it takes, as 'restitution' does";
    if (!given || given->implied)
        return refuse_beside(b, n, "impact_speed", what, "is that of a 'restitution'", "give one, or delete it");
    if (refuse_beside(b, n, "damping", what, loss, "delete one of them")) return 1;
    if (!(speed > 0)) {
        diag_error(b->diags, given, AT_KEY, "E-exclusive", "%s: 'restitution' of what is compliant is so at one speed",
                   what);
        diag_hint(b->diags, "add 'impact_speed', or delete 'stiffness', or give 'damping' in its place");
        return 1;
    }
    if (e > 0) return 0;
    diag_error(b->diags, given, AT_VALUE, "E-exclusive",
               "%s: a 'stiffness' throws back what it takes: 'restitution' is above 0", what);
    diag_hint(b->diags, "give 'damping' in its place, or delete 'stiffness'");
    return 1;
}

int check_compliant(struct builder *b, const struct contact_keys *k, const struct node *n, const char *what)
{
    static const char rigid[] = "is of rigid contacts, 'stiffness' makes them compliant",
                      soft[] = "is of compliant contacts: it needs a 'stiffness'";
    int errors = 0;
    if (k->push.k > 0) {
        errors += check_loss(b, n, k->restitution, k->impact, what);
        errors += refuse_beside(b, n, "speed", what, rigid, "delete 'stiffness'");
        if (k->friction && k->friction->type == NODE_MAP)
            errors += refuse_beside(b, k->friction, "static", what, rigid,
                                    "compliant ones have one coefficient, 'kinetic'; delete 'static', or 'stiffness'");
        return errors;
    }
    errors += refuse_beside(b, n, "damping", what, soft, "a rigid contact takes energy by its 'restitution'");
    errors += refuse_beside(b, n, "exponent", what, soft, "delete it, or give a 'stiffness'");
    errors += refuse_beside(b, n, "impact_speed", what, soft, "'restitution' of rigid contacts is of any speed");
    if (k->friction && k->friction->type == NODE_MAP)
        errors += refuse_beside(b, k->friction, "slip_speed", what, soft, "what is rigid sticks exactly: delete it");
    return errors;
}

/* From the second surface to the first; of a plane its gap. */
static int distance_of(struct builder *b, const struct scene_contact *c)
{
    const bool plane = c->pair == PAIR_PLANE;
    struct scene_measure m = {
        .node = c->node, .type = plane ? MEASURE_DISPLACEMENT : MEASURE_DISTANCE, .a = c->b, .b = c->a};
    m.name = arena_print(b->life, "%s.%s", c->name, plane ? "gap" : "distance");
    v3_copy(m.axis, c->normal);
    if (plane) v3_axpy(m.a.p, c->radius, c->normal);
    return measure_add(b, &m);
}

static struct scene_force *add_force(struct builder *b, const struct scene_contact *c, const char *name)
{
    struct scene_force *f = &b->scene->force[b->scene->nforce++];
    *f = (struct scene_force){.name = name, .node = c->node, .measure = -1};
    return f;
}

static void add_push(struct builder *b, const struct scene_contact *c, const struct unilateral *push)
{
    struct scene_force *f = add_force(b, c, c->name);
    f->type = FORCE_LAW;
    f->measure = distance_of(b, c);
    f->kind = &force_unilateral;
    f->par = push;
}

static void add_sliding(struct builder *b, const struct scene_contact *c, const struct unilateral *push, double slip)
{
    struct sliding *p = TAKE(b->life, struct sliding, 1);
    const bool all = c->pair == PAIR_OUTLINE;
    struct scene_force *f = add_force(b, c, all ? c->name : arena_print(b->life, "%s.friction", c->name));
    *p = (struct sliding){.pair = c->pair,
                          .radius = c->radius,
                          .other = c->other,
                          .outline = c->outline,
                          .push = *push,
                          .mu = c->law.sliding,
                          .slip = slip};
    v3_copy(p->normal, c->normal);
    if (c->pair == PAIR_PLANE) p->push.from = c->radius; /* its measure is that of the centre */
    m3_unit(p->on.drawn);
    m3_unit(p->on.Ea);
    m3_unit(p->on.Eb);
    f->type = FORCE_BETWEEN;
    f->a = c->b;
    f->b = c->a;
    f->kind = &force_sliding;
    f->par = p;
}

void add_compliant(struct builder *b, const struct scene_contact *c, const struct contact_keys *k, double slip)
{
    struct unilateral *push = TAKE(b->life, struct unilateral, 1);
    *push = k->push;
    if (k->impact > 0) push->loss = unilateral_loss(k->restitution, k->impact);
    push->side = c->pair == PAIR_HOLE ? UNILATERAL_ABOVE : UNILATERAL_BELOW;
    push->from = c->pair == PAIR_SPHERES ? c->radius + c->other : c->pair == PAIR_HOLE ? c->other - c->radius : 0;
    if (c->pair != PAIR_OUTLINE) add_push(b, c, push);
    if (c->law.sliding > 0 || c->pair == PAIR_OUTLINE) add_sliding(b, c, push, slip);
}
