/* joints.c -- the deck's constraints: kinds of joints, bodies, where they stand, their axes */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "la/vec3.h"
#include "scene_flex/flexible.h"
#include "scene_read/parts.h"

/* Is it a key of any kind? */
static bool is_key(const char *word)
{
    for (int i = 0; joint_kind_at(i); i++)
        for (const struct key *k = joint_kind_at(i)->keys; k->name; k++)
            if (strcmp(k->name, word) == 0) return true;
    return false;
}

static void report_no_kind(struct builder *b, const struct node *map)
{
    const char *names[JOINT_WORDS], *all = "";
    int n = 0;
    for (; joint_kind_at(n); n++) {
        names[n] = joint_kind_at(n)->name;
        all = arena_print(b->life, "%s%s%s", all, n ? ", " : "", names[n]);
    }
    if (not_there(b, map, "constraints", "constraint")) return;
    for (int i = 0; i < map->count; i++) {
        const struct node *member = map->item[i];
        if (is_key(member->key)) continue;
        unknown_name(b, member, AT_KEY, "E-unknown-joint", "kind of joint", member->key, names, n);
        return;
    }
    diag_error(b->diags, map, AT_KEY, "E-missing-key", "constraint '%s' has no kind", map->key);
    diag_hint(b->diags, "expected one of: %s", all);
}

/* The member of map that names a kind of joint; NULL, and an error, if there is not exactly one. */
static const struct joint_kind *joint_word(struct builder *b, const struct node *map, const struct node **word)
{
    const struct joint_kind *kind = NULL;
    *word = NULL;
    for (int i = 0; i < map->count; i++) {
        const struct joint_kind *here = joint_find(map->item[i]->key);
        if (!here) continue;
        if (kind) {
            diag_error(b->diags, map->item[i], AT_KEY, "E-two-kinds", "constraint '%s' is '%s' already", map->key,
                       kind->name);
            return NULL;
        }
        kind = here;
        *word = map->item[i];
    }
    if (kind) return kind;
    report_no_kind(b, map);
    return NULL;
}

static void hint_revolute(struct builder *b, const struct scene_joint *j, int number, const char *first,
                          const char *second, const double *axis)
{
    diag_hint(b->diags, "  %s_%d: {revolute: [%s, %s], at: [%.10g, %.10g, %.10g], axis: [%.10g, %.10g, %.10g]}",
              j->name, number, first, second, j->at[0], j->at[1], j->at[2], axis[0], axis[1], axis[2]);
}

/* Two turns about oblique axes, as the deck may have them. */
static void hint_oblique(struct builder *b, const struct scene_joint *j, const double *E)
{
    const char *cross = arena_print(b->life, "%s_cross", j->name);
    diag_hint(b->diags, "for oblique axes put a body without mass between two revolute joints; under 'bodies':");
    diag_hint(b->diags, "  %s: {mass: 0, inertia: [0, 0, 0], at: [%.10g, %.10g, %.10g]}", cross, j->at[0], j->at[1],
              j->at[2]);
    diag_hint(b->diags, "and under 'constraints', in place of '%s':", j->name);
    hint_revolute(b, j, 1, b->scene->body[j->first].name, cross, E);
    hint_revolute(b, j, 2, cross, b->scene->body[j->second].name, E + 3);
}

/* Axes x and y of two crossing turns. */
static int crossed_axes(struct builder *b, struct scene_joint *j, const struct joint_keys *k, const char *what)
{
    static const double PARALLEL = .9999;
    double *E = j->E;
    if (read_direction(b, E, k->axis, what) | read_direction(b, E + 3, k->axis2, what)) return 1;
    double lean = v3_dot(E, E + 3);
    if (fabs(lean) > 1e-6) {
        diag_error(b->diags, k->axis2, AT_VALUE, "E-axes", "%s: 'axis' and 'axis2' are not at right angles", what);
        if (fabs(lean) < PARALLEL) hint_oblique(b, j, E);
        return 1;
    }
    v3_axpy(E + 3, -lean, E);
    v3_scale(E + 3, 1 / v3_norm(E + 3), E + 3);
    v3_cross(E + 6, E, E + 3);
    return 0;
}

/* Joint axes: see kind/joint.h. */
static int joint_axes(struct builder *b, struct scene_joint *j, const struct joint_keys *k, const char *what)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double z[3], x[3];
    memcpy(j->E, identity, sizeof identity);
    if (joint_turning(j->kind, NULL) == TURNS_CROSSED) return crossed_axes(b, j, k, what);
    if (!k->axis) return 0;
    if (read_direction(b, z, k->axis, what)) return 1;
    if (k->axis2 && read_direction(b, x, k->axis2, what)) return 1;
    frame_about(j->E, z, k->axis2 ? x : NULL);
    if (b->scene->space == 2) { /* x in the plane, y out of it */
        const double across[3] = {-z[1], z[0], 0};
        frame_about(j->E, z, across);
    }
    return 0;
}

/* What coordinates are tied is read when all joints are known. */
static int check_number(struct builder *b, const struct scene_joint *j, const char *what)
{
    const char *word = j->kind->keys->name;
    if (j->number != 0) return 0;
    diag_error(b->diags, node_find(j->node, word), AT_VALUE, "E-range",
               "%s: '%s' is 0: the second coordinate could not move", what, word);
    return 1;
}

/* Two bodies, of which one may be a beam in segments: then that of them is meant at which the joint stands. */
static const struct node *by_segments(struct builder *b, const struct node *bodies, const double *place)
{
    if (bodies->type != NODE_LIST || bodies->count != 2) return bodies;
    struct node *list = TAKE(b->life, struct node, 1);
    *list = *bodies;
    list->item = TAKE(b->life, struct node *, 2);
    for (int i = 0; i < 2; i++) {
        const struct node *item = bodies->item[i];
        const char *part = item->type == NODE_SCALAR ? segment_at(b, item->text, place) : NULL;
        list->item[i] = bodies->item[i];
        if (!part) continue;
        list->item[i] = TAKE(b->life, struct node, 1);
        *list->item[i] = *item;
        list->item[i]->text = part;
        list->item[i]->len = strlen(part);
    }
    return list;
}

static int read_joint(struct builder *b, struct scene_joint *j, const struct node *n)
{
    struct joint_keys k = {.number = NAN};
    const struct node *word;
    j->name = n->key;
    j->node = n;
    char what[100];
    snprintf(what, sizeof what, "constraint '%.60s'", n->key);
    if (read_map(n, what, &b->reader)) return 1;
    const struct joint_kind *found = joint_word(b, n, &word);
    if (!found) return 1;
    j->kind = joint_kind(found->type, b->scene->space == 3);
    if (!j->kind) {
        diag_error(b->diags, word, AT_KEY, "E-dimension", "a %s joint needs a 3-D deck", found->name);
        return 1;
    }
    const char *also[] = {found->name, NULL};
    int errors = read_keys(&k, j->kind->keys, n, also, what, &b->reader);
    j->number = k.number;
    if (found->tie == TIE_POINTS) return read_rod(b, j, word, what) + errors;
    if (found->tie == TIE_COORDINATES) return errors ? errors : check_number(b, j, what);
    struct marker at = {0};
    const bool placed = k.at && !errors && read_point(b, &at, k.at, what) == 0;
    if (placed) {
        marker_drawn(j->at, b->scene, &at);
        word = by_segments(b, word, j->at);
    }
    if (find_two_bodies(b, &j->first, &j->second, word, what)) errors++;
    if (errors) return errors;
    j->loop = k.loop;
    j->own = k.frame == 1;
    if (k.range && read_range(b, j, k.range, what)) return 1;
    if (k.friction && read_rubbing(b, j, k.friction, what)) return 1;
    if (!k.at && (b->draft[j->second] || b->scene->body[j->second].flex) && found->type != JOINT_FREE) {
        diag_error(b->diags, n, AT_KEY, "E-missing-key", "%s on the flexible body '%s' has no 'at'", what,
                   b->scene->body[j->second].name);
        return 1;
    }
    if (k.at && !placed) return 1;
    if (!k.at) at.body = j->second;
    marker_drawn(j->at, b->scene, &at);
    v3_copy(j->from, j->at);
    return joint_axes(b, j, &k, what);
}

void read_joints(struct builder *b, const struct node *n)
{
    const int count = n ? n->count : 0;
    struct scene *scene = b->scene;
    if (n && read_map(n, "'constraints'", &b->reader)) return;
    scene->joint = TAKE(b->life, struct scene_joint, count + scene->nbody);
    for (int i = 0; i < count && !diags_full(b->diags); i++) {
        struct scene_joint joint = {0};
        if (wrong_name(b, n->item[i], "joint")) {
            diag_hint(b->diags, "names are letters, digits and '_', a letter first; ground, energy and step are taken");
        } else if (!read_joint(b, &joint, n->item[i])) {
            scene->joint[scene->njoint++] = joint;
        }
    }
    join_segments(b);
    read_ties(b);
}
