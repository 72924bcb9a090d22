/* measures.c -- distances, displacements and angles, named or made for one force */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "expr/expr.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "scene_read/parts.h"

/* The value of a measure in the position that is drawn. */
static double measure_drawn(const struct scene *scene, const struct scene_measure *m)
{
    double a[3], b[3], axis[3];
    if (m->type == MEASURE_COORDINATE || m->type == MEASURE_ANGLE) return 0;
    marker_drawn(a, scene, &m->a);
    marker_drawn(b, scene, &m->b);
    v3_diff(b, b, a);
    if (m->type == MEASURE_DISTANCE) return sqrt(v3_dot(b, b));
    m3_mul(axis, scene->body[m->a.body].R, m->axis);
    return v3_dot(axis, b);
}

int measure_add(struct builder *b, const struct scene_measure *m)
{
    struct scene *scene = b->scene;
    int n = scene->nmeasure;
    if ((n & (n - 1)) == 0) { /* full at 0 and at powers of two */
        struct scene_measure *more = TAKE(b->life, struct scene_measure, n ? 2 * n : 1);
        if (n) memcpy(more, scene->measure, (size_t)n * sizeof *more);
        scene->measure = more;
    }
    scene->measure[n] = *m;
    scene->measure[n].drawn = measure_drawn(scene, m);
    return scene->nmeasure++;
}

/* Two points: [point, point]. */
static int two_points(struct builder *b, struct scene_measure *m, const struct node *n, const char *what)
{
    if (n->type != NODE_LIST || n->count != 2) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "%s: expected two points, [first, second]", what);
        return 1;
    }
    return read_point(b, &m->a, n->item[0], what) + read_point(b, &m->b, n->item[1], what);
}

/* The measure's axis: drawn direction into the axes of a's body. */
static int measure_axis(struct builder *b, struct scene_measure *m, const struct node *axis, const char *what)
{
    double world[3] = {0, 0, 1};
    if (axis && read_direction(b, world, axis, what)) return 1;
    m3_tmul(m->axis, b->scene->body[m->a.body].R, world);
    return 0;
}

/* Two points of one rigid body, or one of a flexible one: others of it move as it bends. */
static bool keep_apart(const struct builder *b, const struct scene_measure *m)
{
    const int body = m->a.body;
    if (body != m->b.body) return false;
    const bool bends = b->draft[body] || b->scene->body[body].flex;
    return !bends || memcmp(m->a.p, m->b.p, sizeof m->a.p) == 0;
}

static int refuse_zero_distance(struct builder *b, const struct scene_measure *m, const struct node *n,
                                const char *what)
{
    if (keep_apart(b, m)) {
        diag_error(b->diags, n, AT_VALUE, "E-same-body", "%s: both points are fixed on '%s'", what,
                   b->scene->body[m->a.body].name);
        return 1;
    }
    if (m->type != MEASURE_DISTANCE || measure_drawn(b->scene, m) > 0) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-direction", "%s: the points coincide when drawn: no direction", what);
    diag_hint(b->diags, "use two displacements along axes, or a bushing");
    return 1;
}

static void read_measure(struct builder *b, const struct node *n)
{
    static const struct {
        const char *word;
        const struct key *keys;
        enum measure_type type;
    } kinds[] = {{"distance", keys_distance, MEASURE_DISTANCE},
                 {"displacement", keys_displacement, MEASURE_DISPLACEMENT},
                 {"angle", keys_angle, MEASURE_ANGLE}};
    static const char *const words[] = {"distance", "displacement", "angle"};
    char what[100];
    snprintf(what, sizeof what, "measure '%.60s'", n->key);
    if (read_map(n, what, &b->reader)) return;
    int kind = -1;
    for (int i = 0; i < 3; i++)
        if (node_find(n, kinds[i].word)) kind = i;
    if (kind < 0) {
        if (not_there(b, n, "measures", "measure")) return;
        unknown_name(b, n->count ? n->item[0] : n, AT_KEY, "E-unknown-measure", "kind of measure",
                     n->count ? n->item[0]->key : "", words, 3);
        return;
    }
    struct measure_keys k = {0};
    struct scene_measure m = {.name = n->key, .node = n, .type = kinds[kind].type};
    if (read_keys(&k, kinds[kind].keys, n, NULL, what, &b->reader)) return;
    m.angular = m.type == MEASURE_ANGLE;
    if (m.angular ? find_two_bodies(b, &m.a.body, &m.b.body, k.points, what) : two_points(b, &m, k.points, what))
        return;
    if (b->scene->space == 3 && m.angular && !k.axis) {
        diag_error(b->diags, n, AT_KEY, "E-missing-key", "%s: an angle in 3-D needs an 'axis'", what);
        return;
    }
    if (m.type != MEASURE_DISTANCE && measure_axis(b, &m, k.axis, what)) return;
    if (refuse_zero_distance(b, &m, k.points, what)) return;
    measure_add(b, &m);
}

static bool is_body(const struct scene *scene, const char *name)
{
    for (int i = 0; i < scene->nbody; i++)
        if (strcmp(scene->body[i].name, name) == 0) return true;
    return false;
}

/* Expressions would find the parameter and never the measure. */
static bool is_parameter(const struct builder *b, const char *name)
{
    double x;
    const struct deck *deck = b->reader.deck;
    return deck_parameter(&x, name, deck) == 0 || deck_parameter(&x, arena_print(b->life, "%s_rate", name), deck) == 0;
}

int wrong_value_name(struct builder *b, const struct node *n, const char *what)
{
    const char *name = n->key;
    if (!text_is_name(name) || strcmp(name, "t") == 0 || strcmp(name, "type") == 0 || expr_is_word(name))
        diag_error(b->diags, n, AT_KEY, "E-name", "'%.60s' cannot name a %s", name, what);
    else if (scene_find_joint(b->scene, name, strlen(name)) >= 0)
        diag_error(b->diags, n, AT_KEY, "E-duplicate-name", "'%s' is a constraint already", name);
    else if (is_parameter(b, name))
        diag_error(b->diags, n, AT_KEY, "E-duplicate-name", "'%s' or its rate is a parameter already", name);
    else if (is_body(b->scene, name))
        diag_error(b->diags, n, AT_KEY, "E-duplicate-name", "'%s' is a body already", name);
    else
        return 0;
    return 1;
}

void read_measures(struct builder *b, const struct node *n)
{
    if (!n || read_map(n, "'measures'", &b->reader)) return;
    for (int i = 0; i < n->count && !diags_full(b->diags); i++)
        if (!wrong_value_name(b, n->item[i], "measure")) read_measure(b, n->item[i]);
}

/* Is the k-th position part of a quaternion?  The others have the rate of their own number. */
static bool is_turn(const struct joint_kind *j, int k)
{
    return joint_turns_freely(j) && k >= joint_size(j, 0) - 4;
}

static int coordinate_measure(struct builder *b, struct scene_measure *m, const struct node *n)
{
    const struct scene *scene = b->scene;
    const char *dot = strchr(n->text, '.');
    int joint = scene_find_joint(scene, n->text, dot ? (size_t)(dot - n->text) : n->len), k, body;
    if (joint < 0 && scene_mode(scene, n->text, &body, &k)) {
        diag_error(b->diags, n, AT_VALUE, "E-which-coordinate",
                   "'%s' is an elastic coordinate: no force or drive acts along it", n->text);
        diag_hint(b->diags, "a force or a measure takes hold of a point of the body");
        return -1;
    }
    if (joint < 0) return 0;
    const struct scene_joint *j = &scene->joint[joint];
    if (joint_size(j->kind, 1) == 0) {
        diag_error(b->diags, n, AT_VALUE, "E-which-coordinate", "'%s' (%s) has no coordinates", j->name, j->kind->name);
        return -1;
    }
    if (!dot) {
        k = 0;
        if (joint_size(j->kind, 1) > 1) {
            diag_error(b->diags, n, AT_VALUE, "E-which-coordinate", "'%s' is a %s joint: name one of its coordinates",
                       j->name, j->kind->name);
            diag_hint(b->diags, "such as '%s.%s'", j->name, joint_name(j->kind, 0, 0));
            return -1;
        }
    } else {
        if (scene_coordinate(j, dot + 1, &k) != 1) return 0;
        if (is_turn(j->kind, k)) {
            diag_error(b->diags, n, AT_VALUE, "E-which-coordinate", "'%s' is no angle or displacement of its own",
                       n->text);
            diag_hint(b->diags, "a free rotation has none: use a measure, a torque on the body, or a bushing");
            return -1;
        }
    }
    *m = (struct scene_measure){.node = n, .type = MEASURE_COORDINATE, .joint = joint, .k = k};
    m->angular = j->kind->freedom[k].turns;
    return 1;
}

/* Neither a joint nor a coordinate of one, or a measure where `measures` may stand. */
static void refuse_name(struct builder *b, const struct node *n, bool measures)
{
    const struct scene *scene = b->scene;
    const char *const *all;
    struct scene_slot slot;
    int total = quantity_names(b, &all), count = 0;
    if (find_quantity(scene, &slot, n->text) && (slot.type == SCENE_RATE || slot.type == SCENE_MEASURE_RATE)) {
        diag_error(b->diags, n, AT_VALUE, "E-which-coordinate", "'%s' is a rate, not a coordinate",
                   diag_clip(b->diags, n->text));
        diag_hint(b->diags, "expected a joint or one of its coordinates%s", measures ? ", or a measure" : "");
        return;
    }
    const char **list = TAKE(b->life, const char *, total);
    for (int i = 0; i < total; i++) {
        const bool joint = scene_find_joint(scene, all[i], strlen(all[i])) >= 0;
        const bool found = find_quantity(scene, &slot, all[i]);
        if (joint || (found && slot.type == SCENE_COORDINATE) || (measures && found && slot.type == SCENE_MEASURE))
            list[count++] = all[i];
    }
    unknown_name(b, n, AT_VALUE, "E-unknown-name", measures ? "joint, coordinate or measure" : "joint or coordinate",
                 n->text, list, count);
}

int find_coordinate(struct builder *b, struct scene_measure *m, const struct node *n, const char *what)
{
    if (n->type != NODE_SCALAR) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "%s: expected a joint or one of its coordinates", what);
        return 1;
    }
    int made = coordinate_measure(b, m, n);
    if (made == 0) refuse_name(b, n, false);
    return made <= 0;
}

int measure_of(struct builder *b, const struct node *n, const char *what)
{
    struct scene_measure m = {0};
    if (n->type == NODE_LIST) {
        m = (struct scene_measure){.node = n, .type = MEASURE_DISTANCE};
        if (two_points(b, &m, n, what) || refuse_zero_distance(b, &m, n, what)) return -1;
        return measure_add(b, &m);
    }
    if (n->type != NODE_SCALAR) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "%s: expected a joint, a coordinate, a measure or [point, point]",
                   what);
        return -1;
    }
    int found = find_measure(b->scene, n->text, n->len);
    if (found >= 0) return found;
    int made = coordinate_measure(b, &m, n);
    if (made > 0) return measure_add(b, &m);
    if (made == 0) refuse_name(b, n, true);
    return -1;
}
