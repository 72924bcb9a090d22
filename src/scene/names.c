/* names.c -- names to indices, and the nearest name where one is unknown */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "scene/build.h"

enum { WORDS = 1000 };

static bool same(const char *name, const char *text, size_t len)
{
    return name && strlen(name) == len && memcmp(name, text, len) == 0;
}

bool is_from_file(const struct node *n)
{
    return n->type == NODE_MAP && (node_find(n, "flexible") || node_find(n, "origin"));
}

/* Can the section hold joints or measures?  One of a name that is not known may be meant to. */
static bool may_hold_names(const struct key *sections, const struct node *section)
{
    if (section->type != NODE_MAP) return false;
    for (const struct key *k = sections; k->name; k++)
        if (strcmp(section->key, k->name) == 0)
            return strcmp(k->name, "constraints") == 0 || strcmp(k->name, "measures") == 0;
    return true;
}

/* Has a body lost what follows its name, for errors of its own?  A flexible body that is not made its modes, and one
 * from a file its nodes; any body the points that are in the deck and were wrong. */
static bool lost_with(const struct builder *b, int body, const char *rest)
{
    const struct scene_body *o = &b->scene->body[body];
    const struct node *points = o->node->type == NODE_MAP ? node_find(o->node, "points") : NULL;
    if (*rest == '.' && points && (points->type != NODE_MAP || node_find(points, rest + 1))) return true;
    if (o->flex) return false;
    if (b->draft[body]) return *rest == 0 || strncmp(rest, ".mode", 5) == 0;
    return is_from_file(o->node);
}

/* Is the thing whose name leads `name` in the deck, but left out of the scene for errors of its own?  Then enough
 * has been said. */
bool known_but_wrong(const struct builder *b, const char *name)
{
    const struct node *root = b->reader.deck->root;
    char lead[64];
    size_t len = strcspn(name, ".");
    if (len >= sizeof lead || diags_errors(b->diags) == 0) return false;
    memcpy(lead, name, len);
    lead[len] = 0;
    for (int i = 1; i < b->scene->nbody; i++)
        if (same(b->scene->body[i].name, name, len) && lost_with(b, i, name + len)) return true;
    if (scene_find_joint(b->scene, lead, len) >= 0 || find_measure(b->scene, lead, len) >= 0) return false;
    if (len > 5 && strcmp(lead + len - 5, "_rate") == 0 && !strchr(name, '.')) lead[len - 5] = 0; /* of a measure */
    for (int i = 0; i < root->count; i++)
        if (root->item[i]->type == NODE_MAP && root->item[i]->reported) return true;
    for (int i = 0; i < root->count; i++)
        if (may_hold_names(b->sections, root->item[i]) && node_find(root->item[i], lead)) return true;
    return false;
}

/* The beam of this name is there in parts only. */
static bool report_segments(struct builder *b, const struct node *n, enum diag_at which, const char *code,
                            const char *name)
{
    int first = 0, last = 0;
    for (int i = 1; i < b->scene->nbody; i++) {
        const char *whole = b->scene->body[i].whole;
        if (!whole || strcmp(whole, name) != 0) continue;
        if (!first) first = i;
        last = i;
    }
    if (!first) return false;
    diag_error(b->diags, n, which, code, "beam '%.60s' is cut into segments: expected one of '%.60s' ... '%.60s'", name,
               b->scene->body[first].name, b->scene->body[last].name);
    return true;
}

/* A mode beyond those of its body. */
static bool report_modes(struct builder *b, const struct node *n, enum diag_at which, const char *code,
                         const char *name)
{
    const size_t len = strcspn(name, ".");
    const char *number = name + len + 5;
    for (int i = 1; i < b->scene->nbody; i++) {
        const struct scene_body *o = &b->scene->body[i];
        if (!o->nmode || !same(o->name, name, len) || strncmp(name + len, ".mode", 5) != 0) continue;
        const size_t digits = strspn(number, "0123456789");
        if (!digits || (number[digits] && strcmp(number + digits, "_rate") != 0)) continue;
        diag_error(b->diags, n, which, code, "'%.60s': body '%.60s' has modes 1 to %d", name, o->name, o->nmode);
        return true;
    }
    return false;
}

/* A coordinate of what a body without a joint moves on, which is not the deck's. */
static bool report_free(struct builder *b, const struct node *n, enum diag_at which, const char *code, const char *name)
{
    static const char FREE[] = "_free";
    const size_t len = strcspn(name, "."), end = sizeof FREE - 1;
    if (len <= end || strncmp(name + len - end, FREE, end) != 0) return false;
    const int body = scene_find_body(b->scene, name, len - end);
    if (body <= 0) return false;
    const char *lead = b->scene->body[body].name;
    diag_error(b->diags, n, which, code, "'%.60s': body '%.60s' has no joint of that name to name coordinates by", name,
               lead);
    diag_hint(b->diags, "give it one: constraints: {%.60s_free: {free: [ground, %.60s]}}", lead, lead);
    return true;
}

/* A rigid body is moved by joints, and has no coordinates of its own: those of its first joint are told. */
static bool report_rigid(struct builder *b, const struct node *n, enum diag_at which, const char *code,
                         const char *name, const char *const *list, int count)
{
    const struct scene *scene = b->scene;
    const char *of_joint[WORDS];
    const size_t len = strcspn(name, ".");
    const int body = strcmp(code, "E-unknown-coordinate") == 0 ? scene_find_body(scene, name, len) : 0;
    int known = 0, i = 0;
    if (body <= 0 || scene->body[body].nmode) return false;
    diag_error(b->diags, n, which, code, "body '%.60s' is rigid: coordinates are those of joints",
               scene->body[body].name);
    while (i < scene->njoint && scene->joint[i].first != body && scene->joint[i].second != body) i++;
    if (i == scene->njoint) return true;
    const char *joint = scene->joint[i].name;
    for (int k = 0; k < count && known < WORDS; k++)
        if (strncmp(list[k], joint, strlen(joint)) == 0 && list[k][strlen(joint)] == '.') of_joint[known++] = list[k];
    const char *meant = diag_nearest(arena_print(b->life, "%s%s", joint, name + len), of_joint, known);
    if (!name[len] || !known)
        diag_hint(b->diags, "did you mean joint '%.60s'?", joint);
    else if (meant && strcmp(meant + strlen(joint), name + len) == 0)
        diag_hint(b->diags, "did you mean '%s'?", meant);
    else
        diag_words(b->diags, of_joint, known);
    return true;
}

void unknown_name(struct builder *b, const struct node *n, enum diag_at which, const char *code, const char *kind,
                  const char *name, const char *const *list, int count)
{
    if (known_but_wrong(b, name) || report_segments(b, n, which, code, name)) return;
    if (report_modes(b, n, which, code, name) || report_free(b, n, which, code, name)) return;
    if (report_rigid(b, n, which, code, name, list, count)) return;
    diag_error(b->diags, n, which, code, "unknown %s '%s'", kind, diag_clip(b->diags, name));
    diag_suggest(b->diags, name, list, count);
}

bool not_there(struct builder *b, const struct node *n, const char *section, const char *kind)
{
    const struct node *all = node_find(b->reader.deck->root, section);
    const char *names[WORDS];
    int count = 0;
    if (!deck_was_made(b->reader.deck, n) || !all) return false;
    for (int i = 0; i < all->count && count < WORDS; i++)
        if (all->item[i] != n) names[count++] = all->item[i]->key;
    diag_error(b->diags, n, AT_KEY, "E-set", "the deck has no %s '%s'", kind, diag_clip(b->diags, n->key));
    diag_suggest(b->diags, n->key, names, count);
    return true;
}

int scene_find_body(const struct scene *scene, const char *name, size_t len)
{
    if (scene->nbody == 0) return -1;
    return index_find(scene->bodies, name, len, &scene->body->name, sizeof *scene->body, scene->nbody);
}

/* BODY.POINT where a body is wanted. */
static bool report_point(struct builder *b, const struct node *n)
{
    const int body = scene_find_body(b->scene, n->text, strcspn(n->text, "."));
    if (body < 0) return false;
    const char *owner = b->scene->body[body].name;
    diag_error(b->diags, n, AT_VALUE, "E-unknown-body", "'%s': expected a body, not a point of one",
               diag_clip(b->diags, n->text));
    diag_hint(b->diags, "name '%.60s' alone: where on it is said by a place, such as a joint's 'at'", owner);
    return true;
}

int find_body(struct builder *b, const struct node *n)
{
    const struct scene *scene = b->scene;
    if (n->type != NODE_SCALAR) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "expected the name of a body");
        return -1;
    }
    int body = scene_find_body(scene, n->text, n->len);
    if (body >= 0) return body;
    if (report_point(b, n)) return -1;
    struct arena *scratch = arena_open();
    const char **list = TAKE(scratch, const char *, scene->nbody);
    for (int i = 0; i < scene->nbody; i++) list[i] = scene->body[i].name;
    unknown_name(b, n, AT_VALUE, "E-unknown-body", "body", n->text, list, scene->nbody);
    arena_close(scratch);
    return -1;
}

int find_two_bodies(struct builder *b, int *first, int *second, const struct node *n, const char *what)
{
    if (n->type != NODE_LIST || n->count != 2) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "%s: expected two bodies, [first, second]", what);
        return -1;
    }
    *first = find_body(b, n->item[0]);
    *second = find_body(b, n->item[1]);
    if (*first < 0 || *second < 0) return -1;
    if (*first == *second) {
        diag_error(b->diags, n, AT_VALUE, "E-same-body", "%s: both bodies are '%s'", what, b->scene->body[*first].name);
        diag_hint(b->diags, "it needs two different bodies; the world is 'ground'");
        return -1;
    }
    return 0;
}

static bool may_own_columns(const char *name)
{
    static const char *const taken[] = {"ground", "energy", "momentum", "step"};
    for (int i = 0; i < 4; i++)
        if (strcmp(name, taken[i]) == 0) return false;
    return text_is_name(name);
}

int wrong_name(struct builder *b, const struct node *n, const char *what)
{
    if (may_own_columns(n->key)) return 0;
    diag_error(b->diags, n, AT_KEY, "E-name", "'%.60s' cannot name a %s", n->key, what);
    return 1;
}

int scene_find_joint(const struct scene *scene, const char *name, size_t len)
{
    if (scene->njoint == 0) return -1;
    return index_find(scene->joints, name, len, &scene->joint->name, sizeof *scene->joint, scene->njoint);
}

int find_measure(const struct scene *scene, const char *name, size_t len)
{
    if (scene->nmeasure == 0) return -1;
    return index_find(scene->measures, name, len, &scene->measure->name, sizeof *scene->measure, scene->nmeasure);
}

int scene_coordinate(const struct scene_joint *joint, const char *word, int *k)
{
    for (int order = 0; order < 3; order++)
        for (*k = 0; *k < joint_size(joint->kind, order); ++*k)
            if (strcmp(joint_name(joint->kind, order, *k), word) == 0) return order + 1;
    return 0;
}

int find_owner(const struct scene *scene, const char *name)
{
    const char *dot = strchr(name, '.');
    int k, joint = dot ? scene_find_joint(scene, name, (size_t)(dot - name)) : -1;
    return joint >= 0 && scene_coordinate(&scene->joint[joint], dot + 1, &k) ? joint : -1;
}

int scene_mode(const struct scene *scene, const char *name, int *body, int *k)
{
    const char *dot = strchr(name, '.');
    if (!dot || strncmp(dot, ".mode", 5) != 0) return 0;
    *body = scene_find_body(scene, name, (size_t)(dot - name));
    size_t digits = strspn(dot + 5, "0123456789");
    const char *rest = dot + 5 + digits;
    if (*body <= 0 || digits == 0 || digits > 6 || dot[5] == '0') return 0;
    *k = atoi(dot + 5) - 1;
    if (*k >= scene->body[*body].nmode) return 0;
    return *rest == 0 ? 1 : strcmp(rest, "_rate") == 0 ? 2 : 0;
}

int find_quantity(const struct scene *scene, struct scene_slot *o, const char *name)
{
    const char *dot = strchr(name, '.');
    if (dot) {
        int k, joint = scene_find_joint(scene, name, (size_t)(dot - name)), body;
        int mode = scene_mode(scene, name, &body, &k);
        if (mode) {
            *o = (struct scene_slot){mode == 1 ? SCENE_MODE : SCENE_MODE_RATE, body, k};
            return 1;
        }
        if (joint < 0) return 0;
        int found = scene_coordinate(&scene->joint[joint], dot + 1, &k);
        if (found != 1 && found != 2) return 0;
        *o = (struct scene_slot){found == 1 ? SCENE_COORDINATE : SCENE_RATE, joint, k};
        return 1;
    }
    if (strcmp(name, "t") == 0) {
        *o = (struct scene_slot){SCENE_TIME, 0, 0};
        return 1;
    }
    size_t len = strlen(name);
    int measure = find_measure(scene, name, len);
    if (measure >= 0) {
        *o = (struct scene_slot){SCENE_MEASURE, measure, 0};
        return 1;
    }
    if (len > 5 && strcmp(name + len - 5, "_rate") == 0 && (measure = find_measure(scene, name, len - 5)) >= 0) {
        *o = (struct scene_slot){SCENE_MEASURE_RATE, measure, 0};
        return 1;
    }
    return 0;
}

int coordinate_names(const char **list, struct builder *b, const struct scene_joint *j)
{
    int n = 0;
    for (int order = 0; order < 2; order++)
        for (int k = 0; k < joint_size(j->kind, order); k++)
            list[n++] = arena_print(b->life, "%s.%s", j->name, joint_name(j->kind, order, k));
    return n;
}

int quantity_names(struct builder *b, const char *const **list)
{
    const struct scene *scene = b->scene;
    int n = 1;
    for (int i = 0; i < scene->njoint; i++) n += 1 + JOINT_MAX_Q + JOINT_MAX_V;
    n += 2 * scene->nmeasure + scene->nsignal;
    for (int i = 1; i < scene->nbody; i++) n += 2 * scene->body[i].nmode;
    const char **names = TAKE(b->life, const char *, n);
    int count = 0;
    names[count++] = "t";
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        names[count++] = j->name;
        count += coordinate_names(names + count, b, j);
    }
    for (int i = 1; i < scene->nbody; i++)
        for (int k = 1; k <= scene->body[i].nmode; k++) {
            names[count++] = arena_print(b->life, "%s.mode%d", scene->body[i].name, k);
            names[count++] = arena_print(b->life, "%s.mode%d_rate", scene->body[i].name, k);
        }
    for (int i = 0; i < scene->nmeasure; i++) {
        if (!scene->measure[i].name) continue;
        names[count++] = scene->measure[i].name;
        names[count++] = arena_print(b->life, "%s_rate", scene->measure[i].name);
    }
    for (int i = 0; i < scene->nsignal; i++) names[count++] = scene->signal[i].name;
    *list = names;
    return count;
}
