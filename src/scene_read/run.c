/* run.c -- how a scene is run: fast coordinates, stepping */
#include <math.h>
#include <string.h>

#include "scene_read/parts.h"

/* ---- partition ---- */

/* A flexible body, all its elastic coordinates; or one of them. */
static bool choose_modes(const struct scene *scene, struct scene_choice *o, const struct node *n)
{
    int k;
    for (int i = 1; i < scene->nbody; i++)
        if (scene->body[i].nmode && strcmp(scene->body[i].name, n->text) == 0) return o->body = i, true;
    if (scene_mode(scene, n->text, &o->body, &k) != 1) return false;
    o->k = k;
    return true;
}

static int read_choice(struct builder *b, struct scene_choice *o, const struct node *n)
{
    const struct scene *scene = b->scene;
    int modes = 0;
    *o = (struct scene_choice){n, -1, -1, 0};
    if (n->type == NODE_SCALAR) {
        const char *dot = strchr(n->text, '.');
        o->joint = scene_find_joint(scene, n->text, dot ? (size_t)(dot - n->text) : n->len);
        if (o->joint >= 0 && !dot) return 0;
        if (o->joint < 0 && choose_modes(scene, o, n)) return 0;
        if (o->joint >= 0 && scene_coordinate(&scene->joint[o->joint], dot + 1, &o->k) == 1) {
            if (!joint_turns_freely(scene->joint[o->joint].kind)) return 0;
            diag_error(b->diags, n, AT_VALUE, "E-partition", "a %s joint is fast or slow as a whole",
                       scene->joint[o->joint].kind->name);
            diag_hint(b->diags, "write '%s'", scene->joint[o->joint].name);
            return 1;
        }
    }
    int count = 0;
    for (int i = 1; i < scene->nbody; i++) modes += scene->body[i].nmode;
    const char **list = TAKE(b->life, const char *, scene->njoint *(1 + JOINT_MAX_Q) + scene->nbody + modes);
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        list[count++] = j->name;
        for (int k = 0; k < joint_size(j->kind, 0) && !joint_turns_freely(j->kind); k++)
            list[count++] = arena_print(b->life, "%s.%s", j->name, joint_name(j->kind, 0, k));
    }
    for (int i = 1; i < scene->nbody; i++) {
        if (scene->body[i].nmode || b->draft[i]) list[count++] = scene->body[i].name;
        for (int k = 1; k <= scene->body[i].nmode; k++)
            list[count++] = arena_print(b->life, "%s.mode%d", scene->body[i].name, k);
    }
    unknown_name(b, n, AT_VALUE, "E-unknown-coordinate", "joint or coordinate",
                 n->type == NODE_SCALAR ? n->text : "(not a name)", list, count);
    return 1;
}

/* {modes: body, above: Hz}: its modes of higher frequency, clamped as for its coordinates. */
static int read_band(struct builder *b, struct scene_choice *list, int *count, const struct node *n)
{
    struct band_keys k = {0};
    if (read_keys(&k, keys_band, n, NULL, "modes", &b->reader)) return 1;
    int index = find_body(b, k.modes), found = 0;
    if (index < 0) return 1;
    const struct scene_body *body = &b->scene->body[index];
    if (body->nmode && !body->flex) return 0; /* it could not be made, and that was reported */
    if (!body->flex || !body->flex->hertz) {
        diag_error(b->diags, k.modes, AT_VALUE, "E-partition", "'%s' has no modes with frequencies", body->name);
        return 1;
    }
    for (int i = 0; i < body->nmode; i++)
        if (body->flex->hertz[i] > k.above) {
            list[(*count)++] = (struct scene_choice){n, -1, i, index};
            found++;
        }
    if (found) return 0;
    diag_error(b->diags, node_find(n, "above"), AT_VALUE, "E-partition",
               "no mode of '%s' is above %g Hz; the highest is at %.4g Hz", body->name, k.above,
               body->flex->hertz[body->nmode - 1]);
    return 1;
}

static void read_choices(struct builder *b, struct scene_choice **list, int *count, const struct node *n,
                         const char *what)
{
    int most = n->count;
    if (read_list(n, what, &b->reader)) return;
    for (int i = 0; i < n->count; i++) /* a map names a body's modes */
        for (int k = 1; n->item[i]->type == NODE_MAP && k < b->scene->nbody; k++) most += b->scene->body[k].nmode;
    *list = TAKE(b->life, struct scene_choice, most);
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
        if (n->item[i]->type == NODE_MAP)
            read_band(b, *list, count, n->item[i]);
        else if (!read_choice(b, &(*list)[*count], n->item[i]))
            ++*count;
    }
}

void read_partition(struct builder *b, const struct node *n)
{
    struct partition_keys k = {0};
    if (!n) return;
    b->scene->fast_auto = n->type == NODE_SCALAR && strcmp(n->text, "auto") == 0;
    if (b->scene->fast_auto || read_keys(&k, keys_partition, n, NULL, "'partition'", &b->reader)) return;
    struct scene *scene = b->scene;
    if (k.fast) read_choices(b, &scene->fast, &scene->nfast, k.fast, "'fast'");
    if (k.independent) read_choices(b, &scene->independent, &scene->nindependent, k.independent, "'independent'");
}

/* ---- integrate ---- */

static int check_steps(struct builder *b, const struct integrate *o, const struct node *n)
{
    const struct node *step = node_find(n, "step");
    const struct node *tolerance = node_find(n, "tolerance");
    if (!step || (tolerance && !tolerance->implied)) return 0; /* then they are first guesses */
    const double span = o->until - b->scene->start, count = span / o->step;
    if (o->until + o->step == o->until) {
        diag_error(b->diags, step, AT_VALUE, "E-step", "step %g s vanishes beside until %g s", o->step, o->until);
        return 1;
    }
    if (o->step > span * (1 + 1e-9)) {
        diag_error(b->diags, step, AT_VALUE, "E-step", "step %g s is longer than the run, %g s", o->step, span);
        return 1;
    }
    if (o->ratio > 1 && (double)o->ratio > count * (1 + 1e-9)) {
        diag_error(b->diags, node_find(n, "ratio"), AT_VALUE, "E-ratio",
                   "one major step of %d minor ones is longer than the run", o->ratio);
        return 1;
    }
    return 0;
}

/* A run that goes on from a state's time has an end beyond it. */
static int check_span(struct builder *b, const struct integrate *o)
{
    if (o->until > b->scene->start) return 0;
    diag_error(b->diags, o->end, AT_VALUE, "E-state",
               "the run starts at t = %.9g s, where its state was: it cannot end at %.9g s", b->scene->start, o->until);
    return 1;
}

static int read_until(struct builder *b, struct integrate *o)
{
    static const struct key seconds[] = {
        PARAM_REAL(struct integrate, until, "until", "s", 0, INFINITY, KEY_ABOVE, NULL, ""), KEYS_END};
    struct until_keys k = {0};
    if (o->end->type != NODE_MAP) return read_number(&o->until, o->end, seconds, &b->reader);
    if (read_keys(&k, keys_until, o->end, NULL, "'until'", &b->reader)) return 1;
    o->until = k.latest;
    return read_condition(b, &b->scene->when, k.when);
}

/* All keys first: what goes together is looked at when each is right by itself. */
static int read_stepping(struct builder *b, struct integrate *o, const struct key_block *schemes)
{
    const int n = keys_count(schemes->keys);
    const char **names = TAKE(b->life, const char *, n + 1);
    void *options = arena_take(b->life, 1, schemes->size);
    for (int i = 0; i < n; i++) names[i] = schemes->keys[i].name;
    o->options = options;
    int errors = read_keys(o, keys_integrate, o->node, names, "'integrate'", &b->reader);
    if (o->node->type == NODE_MAP) errors += read_also(options, schemes->keys, o->node, "'integrate'", &b->reader);
    return errors;
}

void read_integrate(struct builder *b, const struct node *n, const struct key_block *schemes)
{
    struct integrate *o = &b->scene->integrate;
    *o = (struct integrate){.node = n, .foretold = NAN};
    if (read_stepping(b, o, schemes) || read_until(b, o) || check_span(b, o) || check_steps(b, o, n)) o->until = 0;
}
