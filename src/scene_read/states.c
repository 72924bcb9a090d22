/* states.c -- quantities of first order, x' = rate: what controllers, filters and motors remember.
 *
 * A state is the speed of a wheel on an axle of its own, of so little inertia that its energy is none: I w' = I rate.  So
 * schemes, estimates, restarts and columns know it as they know all that moves.  The wheel, its axle, its torque and the
 * signals NAME and NAME_rate join the deck before these sections are read. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "scene_read/parts.h"

static const char INERTIA[] = "1.0e-6"; /* [kg m2] */

const struct key keys_first_order[] = {
    PARAM_NODE(struct first_order_keys, rate, "rate", "expression", KEY_REQUIRED,
               "what it grows by in a second, of t, coordinates, rates, measures, signals and states"),
    PARAM_REAL(struct first_order_keys, start, "start", NULL, -INFINITY, INFINITY, 0, "0", "what it is at the start"),
    KEYS_END,
};

static struct node *add(struct builder *b, struct node *map, const char *key, const char *text, const struct node *at)
{
    struct pool *pool = &b->reader.deck->pool;
    struct node *n = pool_scalar(pool, text ? text : "", at);
    if (!text) n->type = NODE_MAP;
    n->key = key;
    n->key_mark = at->key_mark;
    n->key_end = at->key_end;
    tree_append(pool, map, n);
    return n;
}

/* A list of the deck's dimensions, all of them of one text. */
static void add_list(struct builder *b, struct node *map, const char *key, int count, const char *const *text,
                     const struct node *at)
{
    struct node *list = add(b, map, key, "", at), *item[3];
    for (int i = 0; i < count; i++) item[i] = pool_scalar(&b->reader.deck->pool, text[i], at);
    list->type = NODE_LIST;
    list->flow = true;
    list->item = pool_items(&b->reader.deck->pool, item, count);
    list->count = count;
}

/* A section of the deck, made where there is none; NULL: it is no map, which its reader tells. */
static struct node *section(struct builder *b, const struct node **of, const char *name, const struct node *at)
{
    struct node *root = b->reader.deck->root, *map = node_find(root, name);
    if (!map) *of = map = add(b, root, name, NULL, at);
    return map->type == NODE_MAP ? map : NULL;
}

static const char *called(struct builder *b, const struct node *n, const char *what)
{
    return arena_print(b->life, "%s_%s", n->key, what);
}

static int taken(struct builder *b, const struct node *map, const char *name, const struct node *n)
{
    if (!node_find(map, name)) return 0;
    diag_error(b->diags, n, AT_KEY, "E-duplicate-name", "state '%.60s' makes '%.60s', which '%.60s' has already",
               n->key, name, map->key);
    return 1;
}

/* The wheel, in the origin. */
static void add_wheel(struct builder *b, struct node *bodies, struct node *joints, const struct node *n)
{
    static const char *const zeros[] = {"0", "0", "0"}, *const up[] = {"0", "0", "1"},
                             *const inertia[] = {INERTIA, INERTIA, INERTIA};
    const char *wheel = called(b, n, "wheel"), *const ends[] = {"ground", wheel};
    const int space = b->scene->space;
    struct node *body = add(b, bodies, wheel, NULL, n), *joint = add(b, joints, called(b, n, "axle"), NULL, n);
    add(b, body, "mass", "0", n);
    if (space == 3)
        add_list(b, body, "inertia", 3, inertia, n);
    else
        add(b, body, "inertia", INERTIA, n);
    add_list(b, body, "at", space, zeros, n);
    add_list(b, joint, "revolute", 2, ends, n);
    add_list(b, joint, "at", space, zeros, n);
    if (space == 3) add_list(b, joint, "axis", 3, up, n);
}

/* The state stands for the speed, its rate for the expression. */
static void add_signals(struct builder *b, struct node *signals, const struct node *rate, const struct node *n)
{
    add(b, signals, n->key, arena_print(b->life, "%s.angle_rate", called(b, n, "axle")), n);
    struct node *value = add(b, signals, called(b, n, "rate"), "", n);
    const struct node name = *value;
    *value = *rate;
    value->key = name.key;
    value->key_mark = name.key_mark;
    value->key_end = name.key_end;
}

static void add_torque(struct builder *b, struct node *forces, const struct node *n)
{
    struct node *torque = add(b, forces, called(b, n, "torque"), NULL, n);
    add(b, torque, "torque", called(b, n, "axle"), n);
    add(b, torque, "value", arena_print(b->life, "%s*%s", INERTIA, called(b, n, "rate")), n);
}

static void add_start(struct builder *b, struct deck_keys *k, double start, const struct node *n)
{
    struct node *initial = start != 0 ? section(b, &k->initial, "initial", n) : NULL;
    if (!initial || node_find(initial, "from")) return;
    add(b, initial, arena_print(b->life, "%s.angle_rate", called(b, n, "axle")), arena_print(b->life, "%.17g", start),
        n);
}

static void make_state(struct builder *b, struct deck_keys *k, const struct node *n)
{
    struct first_order_keys keys = {.rate = n};
    struct node *bodies = section(b, &k->bodies, "bodies", n), *joints = section(b, &k->constraints, "constraints", n);
    struct node *signals = section(b, &k->signals, "signals", n), *forces = section(b, &k->forces, "forces", n);
    if (!bodies || !joints || !signals || !forces) return;
    if (!text_is_name(n->key)) {
        diag_error(b->diags, n, AT_KEY, "E-name", "'%.60s' cannot name a state", n->key);
        return;
    }
    const char *what = arena_print(b->life, "state '%s'", n->key);
    if (n->type == NODE_MAP && read_keys(&keys, keys_first_order, n, NULL, what, &b->reader)) return;
    if (taken(b, bodies, called(b, n, "wheel"), n) || taken(b, joints, called(b, n, "axle"), n) ||
        taken(b, signals, n->key, n) || taken(b, signals, called(b, n, "rate"), n) ||
        taken(b, forces, called(b, n, "torque"), n))
        return;
    add_wheel(b, bodies, joints, n);
    add_signals(b, signals, keys.rate, n);
    add_torque(b, forces, n);
    add_start(b, k, keys.start, n);
}

/* A posture at rest has no rates, and no way of its own to tell what a state is there. */
static void refuse_static(struct builder *b, const struct node *states, const struct node *initial)
{
    const struct node *wish = initial && initial->type == NODE_MAP ? node_find(initial, "static") : initial;
    const bool asked =
        wish && wish->type == NODE_SCALAR && strcmp(wish->text, wish == initial ? "static" : "true") == 0;
    if (!asked) return;
    diag_error(b->diags, wish, AT_VALUE, "E-states", "'static' and 'states' do not go together");
    diag_note(b->diags, states, AT_KEY, "states here");
}

void make_states(struct builder *b, struct deck_keys *k)
{
    struct node *root = b->reader.deck->root;
    const struct node *states = k->states;
    int kept = 0;
    if (!states || read_map(states, "'states'", &b->reader)) return;
    refuse_static(b, states, k->initial);
    for (int i = 0; i < states->count && !diags_full(b->diags); i++) make_state(b, k, states->item[i]);
    for (int i = 0; i < root->count; i++)
        if (root->item[i] != states) root->item[kept++] = root->item[i];
    root->count = kept;
}
