/* ties.c -- constraints that are equations only: rods between points, gears and racks between coordinates */
#include <math.h>

#include "la/vec3.h"
#include "scene_read/parts.h"

int read_rod(struct builder *b, struct scene_joint *j, const struct node *points, const char *what)
{
    struct marker from, to;
    double d[3];
    if (points->type != NODE_LIST || points->count != 2) {
        diag_error(b->diags, points, AT_VALUE, "E-type", "%s: expected two points, [first, second]", what);
        return 1;
    }
    if (read_point(b, &from, points->item[0], what) + read_point(b, &to, points->item[1], what)) return 1;
    if (from.body == to.body) {
        diag_error(b->diags, points, AT_VALUE, "E-same-body", "%s: both points are fixed on '%s'", what,
                   b->scene->body[to.body].name);
        return 1;
    }
    j->first = from.body;
    j->second = to.body;
    marker_drawn(j->from, b->scene, &from);
    marker_drawn(j->at, b->scene, &to);
    v3_diff(d, j->at, j->from);
    if (isnan(j->number)) j->number = v3_norm(d);
    if (v3_norm(d) > 0) return 0;
    diag_error(b->diags, points, AT_VALUE, "E-direction", "%s: the points coincide when drawn: no direction", what);
    diag_hint(b->diags, "a spherical joint, in 2-D a revolute one, holds two points together");
    return 1;
}

/* Is this side of the tie to be an angle? */
static bool wants_angle(const struct scene_joint *j, const struct scene_measure *c, int side)
{
    const enum joint_end end = j->kind->end[side];
    return end == END_LIKE_OTHER ? c[0].angular : end == END_ANGLE;
}

static int check_kinds(struct builder *b, const struct scene_joint *j, const struct scene_measure *c, const char *what)
{
    for (int side = 0; side < 2; side++) {
        if (c[side].angular == wants_angle(j, c, side)) continue;
        diag_error(b->diags, c[side].node, AT_VALUE, "E-kind", "%s: '%.60s' is %s", what, c[side].node->text,
                   c[side].angular ? "an angle" : "a displacement");
        diag_hint(b->diags, "%s", j->kind->hint);
        return 1;
    }
    if (c[0].joint != c[1].joint || c[0].k != c[1].k) return 0;
    diag_error(b->diags, c[1].node, AT_VALUE, "E-which-coordinate", "%s: both coordinates are the same", what);
    return 1;
}

/* second - number first = 0 */
static int tie_coordinates(struct builder *b, struct scene_joint *j)
{
    struct scene_measure c[2];
    char what[100];
    snprintf(what, sizeof what, "constraint '%.60s'", j->name);
    const struct node *pair = node_find(j->node, j->kind->name);
    if (pair->type != NODE_LIST || pair->count != 2) {
        diag_error(b->diags, pair, AT_VALUE, "E-type", "%s: expected two coordinates, [first, second]", what);
        return 1;
    }
    if (find_coordinate(b, &c[0], pair->item[0], what) | find_coordinate(b, &c[1], pair->item[1], what)) return 1;
    if (check_kinds(b, j, c, what)) return 1;
    j->nterm = 2;
    j->term[0] = (struct scene_term){c[0].joint, c[0].k, c[0].angular, -j->number};
    j->term[1] = (struct scene_term){c[1].joint, c[1].k, c[1].angular, 1};
    return 0;
}

void read_ties(struct builder *b)
{
    for (int i = 0; i < b->scene->njoint; i++) {
        struct scene_joint *j = &b->scene->joint[i];
        if (j->kind->tie == TIE_COORDINATES) tie_coordinates(b, j);
    }
}
