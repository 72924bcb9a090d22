/* read.c -- reads a deck's sections in order; see scene.h */
#include "scene/scene.h"

#include <string.h>

#include "scene_flex/flexible.h"
#include "scene_read/parts.h"

/* The first list of two or three numbers in a subtree, in the deck's order. */
static const struct node *first_vector(const struct node *n)
{
    if (!n) return NULL;
    if (n->type == NODE_LIST && (n->count == 2 || n->count == 3)) {
        bool scalars = true;
        for (int i = 0; i < n->count; i++) scalars = scalars && n->item[i]->type == NODE_SCALAR;
        if (scalars) return n;
    }
    for (int i = 0; n->type == NODE_MAP && i < n->count; i++) {
        const struct node *found = first_vector(n->item[i]);
        if (found) return found;
    }
    return NULL;
}

static const struct node *beam_end(const struct node *beam)
{
    return beam && beam->type == NODE_MAP ? node_find(beam, "from") : NULL;
}

/* Places of bodies decide: `at`, `from` of a beam, `origin` of a body from a file; they are always vectors. */
static const struct node *deciding_vector(const struct node *bodies)
{
    for (int i = 0; bodies && bodies->type == NODE_MAP && i < bodies->count; i++) {
        const struct node *body = bodies->item[i];
        const struct node *at = body->type == NODE_MAP ? node_find(body, "at") : NULL;
        if (!at && body->type == NODE_MAP) at = beam_end(node_find(body, "beam"));
        if (!at && body->type == NODE_MAP) at = node_find(body, "origin");
        if (first_vector(at)) return first_vector(at);
    }
    return NULL;
}

/* 2 or 3 axes: as key `space` says, else as many as the numbers of the first vector of the deck. */
static void read_space(struct builder *b, const struct deck_keys *k)
{
    const struct node *root = b->scene->deck->root;
    const struct node *vector = deciding_vector(k->bodies);
    if (!vector) vector = first_vector(k->gravity);
    b->space_from = vector;
    b->scene->space = vector ? vector->count : 2;
    if (k->space >= 0) {
        b->scene->space = 2 + k->space;
        b->space_from = node_find(root, "space");
    }
    b->reader.space = b->scene->space;
}

static void read_energy(struct builder *b, const struct node *n)
{
    struct energy_keys k = {0.01};
    if (n && read_keys(&k, keys_energy, n, NULL, "'energy'", &b->reader)) return;
    b->scene->delta = k.delta;
}

enum status scene_read(struct scene **out, struct deck *deck, const struct key_block *schemes, unsigned unheard,
                       struct diags *diags, struct arena *life)
{
    struct scene *scene = TAKE(life, struct scene, 1);
    struct builder b = {.scene = scene,
                        .diags = diags,
                        .reader = {.diags = diags, .deck = deck},
                        .sections = keys_deck,
                        .unheard = unheard,
                        .life = life};
    struct deck_keys k = {.space = -1};
    struct index **names[] = {&scene->bodies, &scene->joints, &scene->measures};
    for (int i = 0; i < 3; i++) *(*names[i] = TAKE(life, struct index, 1)) = (struct index){.life = life};
    scene->deck = deck;
    *out = scene;
    b.reader.sections = sections_fixed(&b.reader.nsection, schemes, life);
    read_keys(&k, keys_deck, deck->root, NULL, "the deck", &b.reader);
    scene->title = k.title ? k.title : "";
    read_effects(&b, k.effects);
    if (k.bodies) {
        read_space(&b, &k);
        make_states(&b, &k);
        if (k.gravity && read_place(&b, scene->gravity, k.gravity, "'gravity'") == 0) warn_of_gravity(&b, k.gravity);
        read_bodies(&b, k.bodies);
        read_joints(&b, k.constraints);
        read_measures(&b, k.measures);
        read_tables(&b, k.tables);
        read_signals(&b, k.signals);
        read_forces(&b, k.forces);
        read_contacts(&b, k.surfaces, k.contacts);
        read_drives(&b, k.drives);
        check_stops(&b);
        make_flexible(&b);
        read_initial(&b, k.initial);
        warn_of_drives(&b);
        read_partition(&b, k.partition);
    }
    if (k.integrate) read_integrate(&b, k.integrate, schemes);
    read_output(&b, k.output);
    read_checkpoint(&b, k.checkpoint);
    read_energy(&b, k.energy);
    if (diags_errors(diags) == 0) deck_warn_unused(deck);
    return diags_status(diags);
}
