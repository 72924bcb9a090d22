/* run.c -- how a scene starts and is run: initial state, fast coordinates, stepping, records */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "scene/build.h"

/* ---- initial ---- */

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

static bool turns_freely(const struct builder *b, const struct scene_joint *j)
{
    return j->kind->type == JOINT_SPHERICAL || (j->kind->type == JOINT_FREE && b->scene->space == 3);
}

/* All words that may follow a joint's name in `initial:`, for near misses. */
static int initial_names(struct builder *b, const char *const **out)
{
    const struct scene *scene = b->scene;
    int s = scene->space == 3, n = 0;
    int modes = 0;
    for (int i = 1; i < scene->nbody; i++) modes += scene->body[i].nmode;
    const char **list = TAKE(b->life, const char *, scene->njoint *(JOINT_MAX_Q + JOINT_MAX_V + 2) + 2 * modes + 3);
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        for (int k = 0; k < j->kind->nq[s]; k++) list[n++] = arena_print(b->life, "%s.%s", j->name, j->kind->q[k]);
        for (int k = 0; k < j->kind->nv[s]; k++) list[n++] = arena_print(b->life, "%s.%s", j->name, j->kind->v[k]);
        if (turns_freely(b, j)) list[n++] = arena_print(b->life, "%s.omega", j->name);
        if (turns_freely(b, j)) list[n++] = arena_print(b->life, "%s.rotation", j->name);
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
    o->joint = dot ? find_joint(scene, n->key, (size_t)(dot - n->key)) : -1;
    int mode = scene_mode(scene, n->key, &o->body, &o->k);
    if (mode) {
        o->joint = -1;
        o->type = mode == 1 ? INITIAL_POSITION : INITIAL_RATE;
        return read_number(o->x, n, NULL, &b->reader);
    }
    if (dot && o->joint >= 0) {
        const struct scene_joint *j = &scene->joint[o->joint];
        if (turns_freely(b, j) && strcmp(dot + 1, "omega") == 0) return read_omega(b, o, n);
        if (turns_freely(b, j) && strcmp(dot + 1, "rotation") == 0) return read_rotation(b, o, n);
        int found = scene_coordinate(j, scene->space, dot + 1, &o->k);
        if (found == 1 && turns_freely(b, j) && dot[1] == 'q') {
            diag_error(b->diags, n, AT_KEY, "E-initial", "a quaternion is not set by its parts");
            diag_hint(b->diags, "use '%s.rotation: {axis: [...], angle: ...}'", j->name);
            return 1;
        }
        o->type = found == 1 ? INITIAL_POSITION : INITIAL_RATE;
        if (found == 1 || found == 2) {
            if (read_number(o->x, n, NULL, &b->reader)) return 1;
            if (found == 1 && strncmp(j->kind->qunit[o->k], "rad", 3) == 0) warn_of_angle(b, n, o->x[0]);
            return 0;
        }
    }
    const char *const *list;
    int count = initial_names(b, &list);
    unknown_name(b, n, AT_KEY, "E-unknown-coordinate", "coordinate", n->key, list, count);
    return 1;
}

static int read_wish(struct builder *b, bool *wish, const struct node *n)
{
    int yes = 0;
    if (read_bool(&yes, n, &b->reader)) return 1;
    *wish = yes;
    return 0;
}

/* Nothing but how the clock goes on stands beside `from`. */
static int read_clock(struct builder *b, int *keeps, const struct node *initial)
{
    for (int i = 0; i < initial->count; i++) {
        const struct node *n = initial->item[i];
        if (strcmp(n->key, "from") == 0) continue;
        if (strcmp(n->key, "time") == 0) {
            if (read_word(keeps, n, "zero|keep", &b->reader)) return 1;
            continue;
        }
        diag_error(b->diags, n, AT_KEY, "E-state", "'from' gives all coordinates: '%.60s' cannot be set beside it",
                   n->key);
        return 1;
    }
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
    const struct node *told = first_of_time(b->scene);
    if (t == 0 || node_find(initial, "time") || !told) return;
    diag_warn(b->diags, n, AT_VALUE, "W-time",
              "the state is from t = %.9g s, and the run starts at t = 0: so does '%.60s'", t, told->key);
    diag_hint(b->diags, "'time: keep' goes on from there, 'time: zero' says that this is meant");
}

/* The file that a run left by --final-state; its names are looked up when there are columns. */
static int read_from(struct builder *b, const struct node *initial, const struct node *n)
{
    struct state_keys k = {0};
    int keeps = 0;
    if (read_clock(b, &keeps, initial)) return 1;
    const struct node *root = deck_yaml(n, b->reader.deck);
    if (root && !node_find(root, "fmdsub_state")) {
        diag_error(b->diags, n, AT_VALUE, "E-state", "this file is no final state: it has no 'fmdsub_state'");
        return 1;
    }
    if (!root || read_keys(&k, keys_state, root, NULL, "the state", &b->reader)) return 1;
    if (read_map(k.state, "'state'", &b->reader)) return 1;
    if (keeps && !node_find(root, "t")) {
        diag_error(b->diags, node_find(initial, "time"), AT_VALUE, "E-state", "the state has no 't' to go on from");
        return 1;
    }
    if (keeps) b->scene->start = k.t;
    warn_of_clock(b, initial, n, k.t);
    b->scene->from = k.state;
    return 0;
}

/* `initial: static`, `initial: assemble`: the wish alone. */
static bool is_wish(struct scene *scene, const struct node *n)
{
    if (n->type != NODE_SCALAR) return false;
    if (strcmp(n->text, "static") == 0) return scene->at_rest = true;
    if (strcmp(n->text, "assemble") == 0) return scene->assemble = true;
    return false;
}

int read_initial(struct builder *b, const struct node *n)
{
    int errors = 0;
    if (!n || is_wish(b->scene, n)) return 0;
    if (read_map(n, "'initial'", &b->reader)) return 1;
    if (node_find(n, "from")) return read_from(b, n, node_find(n, "from"));
    struct scene *scene = b->scene;
    scene->initial = TAKE(b->life, struct scene_initial, n->count);
    for (int i = 0; i < n->count; i++) {
        struct scene_initial start = {0};
        if (strcmp(n->item[i]->key, "static") == 0)
            errors += read_wish(b, &scene->at_rest, n->item[i]);
        else if (strcmp(n->item[i]->key, "assemble") == 0)
            errors += read_wish(b, &scene->assemble, n->item[i]);
        else if (read_start(b, &start, n->item[i]))
            errors++;
        else
            scene->initial[scene->ninitial++] = start;
    }
    return errors;
}

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

/* A rigid body is moved by joints, and has no coordinates of its own. */
static bool tell_rigid(struct builder *b, const struct node *n)
{
    const struct scene *scene = b->scene;
    int body = 0;
    for (int i = 1; i < scene->nbody && !body; i++)
        if (strcmp(scene->body[i].name, n->text) == 0) body = i;
    if (!body || scene->body[body].nmode || known_but_wrong(b, n->text)) return false;
    diag_error(b->diags, n, AT_VALUE, "E-unknown-coordinate", "body '%.60s' is rigid: coordinates are those of joints",
               n->text);
    for (int i = 0; i < scene->njoint; i++)
        if (scene->joint[i].first == body || scene->joint[i].second == body) {
            diag_hint(b->diags, "did you mean joint '%.60s'?", scene->joint[i].name);
            break;
        }
    return true;
}

static int read_choice(struct builder *b, struct scene_choice *o, const struct node *n)
{
    const struct scene *scene = b->scene;
    int s = scene->space == 3, modes = 0;
    *o = (struct scene_choice){n, -1, -1, 0};
    if (n->type == NODE_SCALAR) {
        const char *dot = strchr(n->text, '.');
        o->joint = find_joint(scene, n->text, dot ? (size_t)(dot - n->text) : n->len);
        if (o->joint >= 0 && !dot) return 0;
        if (o->joint < 0 && choose_modes(scene, o, n)) return 0;
        if (o->joint >= 0 && scene_coordinate(&scene->joint[o->joint], scene->space, dot + 1, &o->k) == 1) {
            if (!turns_freely(b, &scene->joint[o->joint])) return 0;
            diag_error(b->diags, n, AT_VALUE, "E-partition", "a %s joint is fast or slow as a whole",
                       scene->joint[o->joint].kind->name);
            diag_hint(b->diags, "write '%s'", scene->joint[o->joint].name);
            return 1;
        }
    }
    if (n->type == NODE_SCALAR && tell_rigid(b, n)) return 1;
    int count = 0;
    for (int i = 1; i < scene->nbody; i++) modes += scene->body[i].nmode;
    const char **list = TAKE(b->life, const char *, scene->njoint *(1 + JOINT_MAX_Q) + scene->nbody + modes);
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        list[count++] = j->name;
        for (int k = 0; k < j->kind->nq[s] && !turns_freely(b, j); k++)
            list[count++] = arena_print(b->life, "%s.%s", j->name, j->kind->q[k]);
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

/* {modes: body, above: Hz}: its modes of higher frequency, clamped at its first joint. */
static int read_band(struct builder *b, struct scene_choice *list, int *count, const struct node *n)
{
    struct band_keys k = {0};
    if (read_keys(&k, keys_band, n, NULL, "modes", &b->reader)) return 1;
    int index = find_body(b, k.modes), found = 0;
    if (index < 0) return 1;
    const struct scene_body *body = &b->scene->body[index];
    if (body->nmode && !body->flex) return 0; /* it could not be made, and that was told */
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

static int read_choices(struct builder *b, struct scene_choice **list, int *count, const struct node *n,
                        const char *what)
{
    int errors = 0, most = n->count;
    if (read_list(n, what, &b->reader)) return 1;
    for (int i = 0; i < n->count; i++) /* a map names a body's modes */
        for (int k = 1; n->item[i]->type == NODE_MAP && k < b->scene->nbody; k++) most += b->scene->body[k].nmode;
    *list = TAKE(b->life, struct scene_choice, most);
    for (int i = 0; i < n->count; i++) {
        if (n->item[i]->type == NODE_MAP)
            errors += read_band(b, *list, count, n->item[i]);
        else if (read_choice(b, &(*list)[*count], n->item[i]))
            errors++;
        else
            ++*count;
    }
    return errors;
}

int read_partition(struct builder *b, const struct node *n)
{
    struct partition_keys k = {0};
    int errors = 0;
    if (!n) return 0;
    if (read_keys(&k, keys_partition, n, NULL, "'partition'", &b->reader)) return 1;
    struct scene *scene = b->scene;
    if (k.fast) errors += read_choices(b, &scene->fast, &scene->nfast, k.fast, "'fast'");
    if (k.independent)
        errors += read_choices(b, &scene->independent, &scene->nindependent, k.independent, "'independent'");
    return errors;
}

/* ---- integrate ---- */

static int check_newmark(struct builder *b, const struct integrate *o, const struct node *n)
{
    if (2 * o->beta >= o->gamma) return 0;
    const struct node *at = node_find(n, "beta") ? node_find(n, "beta") : n;
    diag_error(b->diags, at, AT_VALUE, "E-newmark", "beta %g and gamma %g: not stable for every step", o->beta,
               o->gamma);
    diag_hint(b->diags, "the rule is 2 beta >= gamma >= 1/2; beta 1/4, gamma 1/2 keep energy");
    return 1;
}

static int check_steps(struct builder *b, const struct integrate *o, const struct node *n)
{
    const struct node *step = node_find(n, "step");
    if (!step) return 0;
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

int read_integrate(struct builder *b, const struct node *n)
{
    struct integrate *o = &b->scene->integrate;
    *o = (struct integrate){.node = n, .step = 0, .tolerance = 0};
    if (read_keys(o, keys_integrate, n, NULL, "'integrate'", &b->reader)) {
        o->until = 0;
        return 1;
    }
    int errors = check_newmark(b, o, n);
    errors += read_until(b, o) || check_span(b, o) || check_steps(b, o, n);
    if (errors) o->until = 0;
    return errors;
}

/* ---- output ---- */

static int read_every(struct builder *b, struct output *o, const struct node *n)
{
    o->every_node = n;
    if (n->type == NODE_MAP) {
        struct every_keys k = {0};
        if (read_keys(&k, keys_every, n, NULL, "'every'", &b->reader)) return 1;
        o->every_steps = k.steps;
        return 0;
    }
    if (read_number(&o->every, n, NULL, &b->reader)) return 1;
    if (o->every > 0) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-range", "'every' must be positive");
    return 1;
}

int read_output(struct builder *b, const struct node *n)
{
    struct output *o = &b->scene->output;
    *o = (struct output){.node = n};
    if (!n) return 0;
    struct output_keys k = {0};
    if (read_keys(&k, keys_output, n, NULL, "'output'", &b->reader)) return 1;
    int errors = k.every ? read_every(b, o, k.every) : 0;
    if (!k.columns) return errors;
    if (read_list(k.columns, "'columns'", &b->reader)) return errors + 1;
    if (k.columns->count == 0) {
        diag_error(b->diags, k.columns, AT_VALUE, "E-count", "'columns' is empty");
        diag_hint(b->diags, "without it all coordinates and rates are written; t is in every record");
        return errors + 1;
    }
    const struct node **pattern = TAKE(b->life, const struct node *, k.columns->count);
    for (int i = 0; i < k.columns->count; i++) {
        pattern[i] = k.columns->item[i];
        if (pattern[i]->type == NODE_SCALAR) continue;
        diag_error(b->diags, pattern[i], AT_VALUE, "E-type", "expected the name of a column, or a pattern");
        errors++;
    }
    o->npattern = k.columns->count;
    o->pattern = pattern;
    return errors;
}
