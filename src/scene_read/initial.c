/* initial.c -- how a scene starts: positions, rates, a final state, its clock */
#include <string.h>

#include "base/text.h"
#include "la/rot.h"
#include "scene_read/parts.h"

static int read_omega(struct builder *b, struct scene_initial *o, const struct node *n)
{
    const struct node *vector = n;
    if (n->type == NODE_MAP) {
        struct vector_keys k = {0};
        if (read_keys(&k, keys_omega, n, NULL, "an angular velocity", &b->reader)) return 1;
        vector = k.value;
        o->body_axes = k.frame == 1;
    }
    o->type = INITIAL_OMEGA;
    return read_vector(o->x, 3, vector, "an angular velocity", &b->reader);
}

static int read_rotation(struct builder *b, struct scene_initial *o, const struct node *n)
{
    double R[9];
    o->type = INITIAL_ROTATION;
    if (read_orientation(b, R, n, "a rotation")) return 1;
    quat_of_matrix(o->x, R);
    return 0;
}

/* All words that may follow a joint's name in `initial:`, for near misses. */
static int initial_names(struct builder *b, const char *const **out)
{
    const struct scene *scene = b->scene;
    int n = 0, modes = 0;
    for (int i = 1; i < scene->nbody; i++) modes += scene->body[i].nmode;
    const char **list = TAKE(b->life, const char *, scene->njoint *(JOINT_MAX_Q + JOINT_MAX_V + 2) + 2 * modes + 3);
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        n += coordinate_names(list + n, b, j);
        if (!joint_turns_freely(j->kind)) continue;
        list[n++] = arena_print(b->life, "%s.omega", j->name);
        list[n++] = arena_print(b->life, "%s.rotation", j->name);
    }
    for (int i = 1; i < scene->nbody; i++)
        for (int k = 1; k <= scene->body[i].nmode; k++) {
            list[n++] = arena_print(b->life, "%s.mode%d", scene->body[i].name, k);
            list[n++] = arena_print(b->life, "%s.mode%d_rate", scene->body[i].name, k);
        }
    list[n++] = "static";
    list[n++] = "assemble";
    list[n++] = "from";
    *out = list;
    return n;
}

static int read_start(struct builder *b, struct scene_initial *o, const struct node *n)
{
    const struct scene *scene = b->scene;
    const char *dot = strchr(n->key, '.');
    o->node = n;
    o->joint = dot ? scene_find_joint(scene, n->key, (size_t)(dot - n->key)) : -1;
    int mode = scene_mode(scene, n->key, &o->body, &o->k);
    if (mode) {
        o->joint = -1;
        o->type = mode == 1 ? INITIAL_POSITION : INITIAL_RATE;
        return read_number(o->x, n, NULL, &b->reader);
    }
    if (dot && o->joint >= 0) {
        const struct scene_joint *j = &scene->joint[o->joint];
        if (joint_turns_freely(j->kind) && strcmp(dot + 1, "omega") == 0) return read_omega(b, o, n);
        if (joint_turns_freely(j->kind) && strcmp(dot + 1, "rotation") == 0) return read_rotation(b, o, n);
        int found = scene_coordinate(j, dot + 1, &o->k);
        if (found == 1 && joint_turns_freely(j->kind) && dot[1] == 'q') {
            diag_error(b->diags, n, AT_KEY, "E-initial", "a quaternion is not set by its parts");
            diag_hint(b->diags, "use '%s.rotation: {axis: [...], angle: ...}'", j->name);
            return 1;
        }
        o->type = found == 1 ? INITIAL_POSITION : INITIAL_RATE;
        if (found == 1 || found == 2) {
            if (read_number(o->x, n, NULL, &b->reader)) return 1;
            if (found == 1 && strcmp(joint_unit(j->kind, 0, o->k), "rad") == 0) warn_of_angle(b, n, o->x[0]);
            return 0;
        }
    }
    const char *const *list;
    int count = initial_names(b, &list);
    unknown_name(b, n, AT_KEY, "E-unknown-coordinate", "coordinate", n->key, list, count);
    return 1;
}

static void read_options(struct builder *b, bool *wish, const struct node *n)
{
    int yes = 0;
    if (read_bool(&yes, n, &b->reader)) return;
    *wish = yes;
}

/* Nothing but how it goes on stands beside `from`. */
static int read_going_on(struct builder *b, const struct node *initial)
{
    struct from_keys k = {0};
    for (int i = 0; i < initial->count; i++) {
        const struct node *n = initial->item[i];
        if (key_find(keys_from, n->key)) continue;
        diag_error(b->diags, n, AT_KEY, "E-state", "'from' gives all coordinates: '%.60s' cannot be set beside it",
                   n->key);
        return 1;
    }
    if (read_keys(&k, keys_from, initial, NULL, "'initial'", &b->reader)) return 1;
    b->scene->keeps = k.time;
    b->scene->any_deck = k.deck;
    return 0;
}

/* The first of the drives and forces that is a function of time; NULL: none is. */
static const struct node *first_of_time(const struct scene *scene)
{
    for (int i = 0; i < scene->ndrive; i++)
        if (signal_reads_time(&scene->drive[i].value)) return scene->drive[i].node;
    for (int i = 0; i < scene->nforce; i++)
        for (int k = 0; k < 3; k++)
            if (signal_reads_time(&scene->force[i].value[k])) return scene->force[i].node;
    return NULL;
}

/* The deck does not say how the clock goes on, where it matters. */
static void warn_of_clock(struct builder *b, const struct node *initial, const struct node *n, double t)
{
    const struct node *first = first_of_time(b->scene);
    if (t == 0 || !node_find(initial, "time")->implied || !first) return;
    diag_warn(b->diags, n, AT_VALUE, "W-time",
              "the state is from t = %.9g s, and the run starts at t = 0: so does '%.60s'", t, first->key);
    diag_hint(b->diags, "'time: keep' goes on from there, 'time: zero' says that this is meant");
}

/* The file that a run left by --final-state; its names are looked up when there are columns. */
static void read_from(struct builder *b, const struct node *initial, const struct node *n)
{
    struct state_keys k = {0};
    if (read_going_on(b, initial)) return;
    const struct node *root = deck_yaml(n, b->reader.deck);
    if (root && !node_find(root, "fmdsub_state")) {
        diag_error(b->diags, n, AT_VALUE, "E-state", "this file is no final state: it has no 'fmdsub_state'");
        return;
    }
    if (!root || read_keys(&k, keys_state, root, NULL, "the state", &b->reader)) return;
    if (read_map(k.state, "'state'", &b->reader)) return;
    if (k.angles && read_map(k.angles, "'angles'", &b->reader)) return;
    if (k.memory && read_map(k.memory, "'memory'", &b->reader)) return;
    if (b->scene->keeps && !node_find(root, "t")) {
        diag_error(b->diags, node_find(initial, "time"), AT_VALUE, "E-state", "the state has no 't' to go on from");
        return;
    }
    if (b->scene->keeps) b->scene->start = k.t;
    warn_of_clock(b, initial, n, k.t);
    b->scene->left = root;
    b->scene->tree = k.tree;
    b->scene->length = k.length;
    b->scene->from = k.state;
    b->scene->angles = k.angles;
}

/* `initial: static`, `initial: assemble`: the wish alone. */
static bool is_option(struct scene *scene, const struct node *n)
{
    if (n->type != NODE_SCALAR) return false;
    if (strcmp(n->text, "static") == 0) return scene->at_rest = true;
    if (strcmp(n->text, "assemble") == 0) return scene->assemble = true;
    return false;
}

void read_initial(struct builder *b, const struct node *n)
{
    if (!n || is_option(b->scene, n) || read_map(n, "'initial'", &b->reader)) return;
    if (node_find(n, "from")) {
        read_from(b, n, node_find(n, "from"));
        return;
    }
    struct scene *scene = b->scene;
    scene->initial = TAKE(b->life, struct scene_initial, n->count);
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
        struct scene_initial start = {0};
        if (strcmp(n->item[i]->key, "static") == 0)
            read_options(b, &scene->at_rest, n->item[i]);
        else if (strcmp(n->item[i]->key, "assemble") == 0)
            read_options(b, &scene->assemble, n->item[i]);
        else if (!read_start(b, &start, n->item[i]))
            scene->initial[scene->ninitial++] = start;
    }
}
