/* stops.c -- the range of a joint's coordinate: reported when it is left, or held by stops.
 *
 * A compliant stop is a force, kind/unilateral.h, a rigid one a contact; both are named after the joint and the end,
 * "knee.lower", "knee.upper". */
#include <math.h>
#include <string.h>

#include "kind/unilateral.h"
#include "scene_read/parts.h"

static int read_hold(struct builder *b, struct scene_joint *j, const struct node *n, const char *what)
{
    struct scene_hold *o = TAKE(b->life, struct scene_hold, 1);
    static const char *const rigid[] = {"rigid"};
    j->hold = o;
    if (n->type != NODE_MAP) {
        if (n->type == NODE_SCALAR && strcmp(n->text, "rigid") == 0) return 0;
        unknown_name(b, n, AT_VALUE, "E-hold", "kind of stop", n->type == NODE_SCALAR ? n->text : "(not a name)", rigid,
                     1);
        return 1;
    }
    if (read_keys(o, keys_hold, n, NULL, "'hold'", &b->reader)) return 1;
    if (o->k > 0) return check_loss(b, n, o->restitution, o->speed, what);
    static const char *const soft[] = {"exponent", "damping", "impact_speed"};
    for (int i = 0; i < 3; i++)
        if (refuse_beside(b, n, soft[i], what, "is of compliant stops: it needs a 'stiffness'",
                          "a rigid stop takes energy by its 'restitution'"))
            return 1;
    return 0;
}

static int check_order(struct builder *b, const struct scene_joint *j, const struct node *n, const char *what)
{
    if (j->range[0] < j->range[1]) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-range", "%s: 'range' goes from %g to %g; the lower end comes first", what,
               j->range[0], j->range[1]);
    return 1;
}

int read_range(struct builder *b, struct scene_joint *j, const struct node *n, const char *what)
{
    struct range_keys k = {NAN, NAN, NULL};
    if (n->type != NODE_MAP) {
        if (read_vector(j->range, 2, n, what, &b->reader)) return 1;
        j->ranged = true;
        return check_order(b, j, n, what);
    }
    if (read_keys(&k, keys_range, n, NULL, "'range'", &b->reader)) return 1;
    if (isnan(k.lower) && isnan(k.upper)) {
        diag_error(b->diags, n, AT_VALUE, "E-range", "%s: 'range' has neither a 'lower' nor an 'upper' end", what);
        return 1;
    }
    j->range[0] = isnan(k.lower) ? -INFINITY : k.lower;
    j->range[1] = isnan(k.upper) ? INFINITY : k.upper;
    j->ranged = !k.hold;
    return check_order(b, j, n, what) + (k.hold ? read_hold(b, j, k.hold, what) : 0);
}

/* ---- what holds it ---- */

static void make_compliant(struct builder *b, const struct scene_joint *j, const char *name, int measure, int end)
{
    struct unilateral *p = TAKE(b->life, struct unilateral, 1);
    *p = (struct unilateral){.k = j->hold->k,
                             .from = j->range[end],
                             .c = j->hold->c,
                             .side = end ? UNILATERAL_ABOVE : UNILATERAL_BELOW,
                             .root = j->hold->root};
    if (j->hold->speed > 0) p->loss = unilateral_loss(j->hold->restitution, j->hold->speed);
    b->scene->force[b->scene->nforce++] = (struct scene_force){
        .name = name, .node = j->node, .type = FORCE_LAW, .measure = measure, .kind = &force_unilateral, .par = p};
}

static void make_rigid(struct builder *b, const struct scene_joint *j, const char *name, int measure, int end)
{
    b->scene->contact[b->scene->ncontact++] = (struct scene_contact){.name = name,
                                                                     .node = j->node,
                                                                     .pair = PAIR_STOP,
                                                                     .law = {.restitution = j->hold->restitution},
                                                                     .measure = measure,
                                                                     .side = end ? -1 : 1,
                                                                     .limit = j->range[end]};
}

void make_stops(struct builder *b)
{
    struct scene *scene = b->scene;
    scene->contact = TAKE(b->life, struct scene_contact, 3 * scene->njoint);
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        const struct scene_measure s = {
            .node = j->node, .type = MEASURE_COORDINATE, .angular = j->kind->freedom[0].turns, .joint = i};
        if (!j->hold) continue;
        const int measure = measure_add(b, &s);
        for (int end = 0; end < 2; end++) {
            const char *name = arena_print(b->life, "%s.%s", j->name, end ? "upper" : "lower");
            if (isinf(j->range[end])) continue;
            (j->hold->k > 0 ? make_compliant : make_rigid)(b, j, name, measure, end);
        }
    }
    make_rubbing(b);
}

/* A drive moves its coordinate whatever stops it. */
void check_stops(struct builder *b)
{
    const struct scene *scene = b->scene;
    for (int i = 0; i < scene->ndrive; i++) {
        const struct scene_measure *m = &scene->measure[scene->drive[i].measure];
        const struct scene_joint *j = m->type == MEASURE_COORDINATE ? &scene->joint[m->joint] : NULL;
        if (!j || !j->hold) continue;
        diag_error(b->diags, scene->drive[i].node, AT_KEY, "E-stop-driven",
                   "drive '%.60s' moves '%.60s', whose range is held: one of them must give way", scene->drive[i].name,
                   j->name);
        diag_hint(b->diags, "a spring between the drive and the coordinate gives way: drive another joint, or delete "
                            "'hold'");
    }
}
