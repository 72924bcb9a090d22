/* forces.c -- kinds of force, signals, loads; signals are expressions over slots or tables of time */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "expr/expr.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "scene_read/parts.h"

enum { MOST_SLOTS = EXPR_SLOTS };

/* Slots of one force while its expressions are compiled. */
struct slots {
    struct builder *b;
    int n;
    struct scene_slot slot[MOST_SLOTS];
};

static int same_slot(const struct scene_slot *a, const struct scene_slot *b)
{
    return a->type == b->type && a->index == b->index && a->k == b->k;
}

/* "slider.x": a column, but no quantity that expressions read. */
static bool of_a_body(const struct scene *scene, const char *name)
{
    const size_t len = strcspn(name, ".");
    for (int i = 0; i < scene->nbody && name[len]; i++)
        if (strlen(scene->body[i].name) == len && memcmp(scene->body[i].name, name, len) == 0) return true;
    return false;
}

/* pin.omega: what a joint has in its place. */
static void hint_coordinates(struct builder *b, const char *name, struct expr_error *error)
{
    const char *list[JOINT_MAX_Q + JOINT_MAX_V];
    const size_t len = strcspn(name, ".");
    for (int i = 0; i < b->scene->njoint && name[len]; i++) {
        const struct scene_joint *j = &b->scene->joint[i];
        if (strlen(j->name) != len || memcmp(j->name, name, len) != 0) continue;
        const int n = coordinate_names(list, b, j);
        size_t used = (size_t)snprintf(error->hint, sizeof error->hint, "known here:");
        for (int k = 0; k < n && used < sizeof error->hint; k++)
            used += (size_t)snprintf(error->hint + used, sizeof error->hint - used, "%s %s", k ? "," : "", list[k]);
    }
    if (strcmp(name, "time") == 0) snprintf(error->hint, sizeof error->hint, "time is t");
}

static int find_name(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    struct slots *s = self;
    struct scene_slot found;
    *slot = -1;
    *value = 0;
    if (!find_quantity(s->b->scene, &found, name)) {
        if (known_but_wrong(s->b, name)) return 2;
        const char *const *list;
        int n = quantity_names(s->b, &list);
        const char *nearest = text_nearest(name, list, n);
        if (nearest)
            snprintf(error->text, sizeof error->text, "unknown name '%.50s' (did you mean '%.40s'?)", name, nearest);
        else
            snprintf(error->text, sizeof error->text, "unknown name '%.50s': no parameter, coordinate, rate or measure",
                     name);
        if (deck_signal(s->b->reader.deck, name))
            snprintf(error->text, sizeof error->text,
                     "signal '%.40s' is a table of many points, which stands by itself", name);
        if (is_output_formula(s->b->reader.deck, name))
            snprintf(error->hint, sizeof error->hint,
                     "it is an expression of columns, which is written and moves nothing: use a measure");
        if (!nearest) hint_coordinates(s->b, name, error);
        if (!nearest && of_a_body(s->b->scene, name))
            snprintf(error->hint, sizeof error->hint,
                     "of bodies and points measures are read: {displacement: [ground, %.40s], axis: ...}",
                     arena_copy(s->b->life, name, (size_t)(strrchr(name, '.') - name)));
        return 1;
    }
    for (int i = 0; i < s->n; i++)
        if (same_slot(&s->slot[i], &found)) return *slot = i, 0;
    if (s->n == MOST_SLOTS) {
        snprintf(error->text, sizeof error->text, "more than %d different quantities in one force", MOST_SLOTS - 1);
        return 1;
    }
    s->slot[s->n] = found;
    *slot = s->n++;
    return 0;
}

static int read_expression(struct slots *s, struct signal *o, const struct node *n)
{
    const struct expr_names names = {.find = find_name, .self = s};
    struct expr *expr;
    if (deck_expr(&expr, n, &names, s->b->reader.deck) != OK) return 1;
    *o = signal_of(expr, s->b->life);
    return 0;
}

int check_expression(struct builder *b, const struct node *n)
{
    struct slots s = {.b = b, .n = 1};
    struct signal any;
    return read_expression(&s, &any, n);
}

int read_condition(struct builder *b, struct scene_condition *o, const struct node *n)
{
    struct slots s = {.b = b, .n = 1};
    const struct expr_names names = {.find = find_name, .self = &s};
    struct expr *expr;
    if (deck_truth(&expr, n, &names, b->reader.deck) != OK) return 1;
    struct scene_slot *slot = TAKE(b->life, struct scene_slot, s.n);
    memcpy(slot, s.slot, (size_t)s.n * sizeof *slot);
    *o = (struct scene_condition){n, expr, s.n, slot};
    return 0;
}

int one_table(struct builder *b, const struct node *n)
{
    const bool table = node_find(n, "table"), file = node_find(n, "file");
    if (table != file) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-table",
               table ? "expected 'table' or 'file', not both" : "expected 'table' or 'file'");
    return 1;
}

int read_time_table(struct builder *b, struct signal *o, const struct node *n)
{
    struct table_keys k = {0};
    if (read_keys(&k, keys_table, n, NULL, "'value'", &b->reader)) return 1;
    if (one_table(b, n)) return 1;
    *o = (struct signal){.n = k.points.n, .t = k.points.x, .x = k.points.y};
    return 0;
}

static int read_signal(struct slots *s, struct signal *o, const struct node *n)
{
    const struct signal *table = n->type == NODE_SCALAR ? find_table_signal(s->b, n->text) : NULL;
    if (table) return *o = *table, 0;
    if (n->type == NODE_MAP) return read_time_table(s->b, o, n);
    if (n->type == NODE_SCALAR) return read_expression(s, o, n);
    diag_error(s->b->diags, n, AT_VALUE, "E-type", "expected one expression or a table");
    return 1;
}

int read_time_signal(struct builder *b, struct signal *o, const struct node *n, const char *what)
{
    struct slots s = {.b = b, .n = 1};
    if (read_signal(&s, o, n)) return 1;
    if (s.n == 1) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-drive", "%s: a drive's value may depend on t only", what);
    return 1;
}

static void keep_slots(struct builder *b, struct scene_force *f, const struct slots *s)
{
    f->nslot = s->n;
    struct scene_slot *slot = TAKE(b->life, struct scene_slot, s->n);
    memcpy(slot, s->slot, (size_t)s->n * sizeof *slot);
    f->slot = slot;
}

/* Components of a load in the deck's space; a torque in the plane has one, about z. */
static int read_components(struct slots *s, struct scene_force *f, const struct node *n)
{
    struct builder *b = s->b;
    int plane = b->scene->space == 2, want = f->torque && plane ? 1 : b->scene->space;
    if (want == 1) return read_signal(s, &f->value[2], n);
    if (n->type != NODE_LIST || n->count != want) {
        const char *found = n->type == NODE_LIST     ? arena_print(b->life, "%d", n->count)
                            : n->type == NODE_SCALAR ? "one"
                                                     : node_type_name(n);
        diag_error(b->diags, n, AT_VALUE, "E-count", "expected %d expressions, [%s], found %s", want,
                   plane ? "x, y" : "x, y, z", found);
        return 1;
    }
    int errors = 0;
    for (int i = 0; i < want; i++) errors += read_signal(s, &f->value[i], n->item[i]);
    return errors;
}

static bool names_a_body(const struct builder *b, const struct node *n)
{
    if (n->type != NODE_SCALAR) return false;
    const char *dot = strchr(n->text, '.');
    size_t len = dot ? (size_t)(dot - n->text) : n->len;
    for (int i = 0; dot && i < b->scene->npoint; i++) /* of a beam in segments, whose own name is no body's */
        if (strcmp(b->scene->point[i].name, n->text) == 0 && scene_find_joint(b->scene, n->text, len) < 0) return true;
    for (int i = 0; i < b->scene->nbody; i++)
        if (strlen(b->scene->body[i].name) == len && memcmp(b->scene->body[i].name, n->text, len) == 0)
            return scene_find_joint(b->scene, n->text, len) < 0;
    return false;
}

/* `force:` and `torque:`: along a measure, or on a body. */
static int read_value(struct builder *b, struct scene_force *f, const struct node *n, const struct key *keys,
                      const char *what)
{
    struct value_keys k = {0};
    struct slots s = {.b = b, .n = 1};
    if (read_keys(&k, keys, n, NULL, what, &b->reader)) return 1;
    f->body_axes = k.frame == 1;
    int errors;
    if (names_a_body(b, k.on)) {
        f->type = FORCE_LOAD;
        f->measure = -1;
        if (read_point(b, &f->b, k.on, what)) return 1;
        if (f->b.body == 0) {
            diag_error(b->diags, k.on, AT_VALUE, "E-ground", "%s: a load on the ground moves nothing", what);
            return 1;
        }
        errors = read_components(&s, f, k.value);
    } else {
        const struct node *frame = node_find(n, "frame");
        if (f->body_axes) {
            diag_error(b->diags, frame, AT_KEY, "E-kind", "%s: 'frame' is for loads on bodies", what);
            return 1;
        }
        f->type = FORCE_VALUE;
        f->measure = measure_of(b, k.on, what);
        if (f->measure < 0) return 1;
        bool angular = b->scene->measure[f->measure].angular;
        if (angular != f->torque) {
            diag_error(b->diags, k.on, AT_VALUE, "E-kind", "%s: '%.60s' is %s", what,
                       k.on->type == NODE_SCALAR ? k.on->text : "the distance", angular ? "an angle" : "a length");
            diag_hint(b->diags, "use '%s:'", angular ? "torque" : "force");
            return 1;
        }
        errors = read_signal(&s, &f->value[0], k.value);
    }
    keep_slots(b, f, &s);
    return errors;
}

/* What the deck does not give of keys whose default is where the measure stands when drawn. */
static void take_drawn(void *par, const struct key *keys, const struct node *n, const struct scene_measure *m)
{
    for (const struct key *k = keys; k->name; k++)
        if (k->flags & KEY_DRAWN && !node_find(n, k->name))
            *(double *)(void *)((char *)par + k->offset) = m->type == MEASURE_DISTANCE ? m->drawn : 0;
}

/* `gap_rate`: the node `gap`, in the same place; NULL: no rate. */
static struct node *measure_of_rate(struct builder *b, const struct node *on)
{
    static const char end[] = "_rate";
    const size_t tail = sizeof end - 1;
    if (on->type != NODE_SCALAR || on->len <= tail || strcmp(on->text + on->len - tail, end) != 0) return NULL;
    if (find_measure(b->scene, on->text, on->len) >= 0) return NULL;
    struct node *o = TAKE(b->life, struct node, 1);
    *o = *on;
    o->len -= tail;
    o->text = arena_copy(b->life, on->text, o->len);
    return o;
}

/* The kind of the same word for a rate; NULL: none. */
static const struct force_kind *kind_of_rate(const struct force_kind *kind)
{
    const struct force_kind *o = NULL;
    for (int i = 0; force_kind_at(i); i++)
        if (force_kind_at(i)->rate && strcmp(force_kind_at(i)->name, kind->name) == 0) o = force_kind_at(i);
    return o;
}

/* The law's own keys, along a measure. */
static int read_law(struct builder *b, struct scene_force *f, const struct node *n, const struct force_kind *kind,
                    const char *what)
{
    const char *also[] = {kind->name, NULL};
    const struct node *on = node_find(n, kind->name), *of = kind_of_rate(kind) ? measure_of_rate(b, on) : NULL;
    if (of) kind = kind_of_rate(kind);
    void *par = arena_take(b->life, 1, kind->size);
    int errors = read_keys(par, kind->keys, n, also, what, &b->reader);
    f->type = FORCE_LAW;
    f->kind = kind;
    f->par = par;
    f->measure = measure_of(b, of ? of : on, what);
    for (const struct key *k = kind->keys; k->name; k++) errors += k->type == KEY_TABLE && one_table(b, n);
    if (errors || f->measure < 0) return 1;
    take_drawn(par, kind->keys, n, &b->scene->measure[f->measure]);
    return 0;
}

/* Axes of markers when drawn, by column. */
static int marker_axes(struct builder *b, double *E, const struct node *axis, const char *what)
{
    static const double out[3] = {0, 0, 1};
    double dir[3];
    m3_unit(E);
    if (!axis) return 0;
    if (read_direction(b, dir, axis, what)) return 1;
    frame_about(E, b->scene->space == 2 ? out : dir, b->scene->space == 2 ? dir : NULL);
    return 0;
}

/* What counts its turns, a measure that it reads. */
static void count_turns(struct builder *b, struct scene_force *f, const struct markers *on, const double *axis,
                        bool in_world)
{
    struct scene_slot *slot = TAKE(b->life, struct scene_slot, 2);
    struct scene_measure m = {
        .node = f->node, .type = MEASURE_ANGLE, .angular = true, .a = f->a, .b = f->b, .in_world = in_world};
    m.name = arena_print(b->life, "%s.twist", f->name);
    m3_mul(m.axis, in_world ? on->drawn : on->Ea, axis);
    slot[1] = (struct scene_slot){.type = SCENE_MEASURE, .index = measure_add(b, &m)};
    f->slot = slot;
    f->nslot = 2;
}

/* Between markers on two bodies. */
static int read_between(struct builder *b, struct scene_force *f, const struct node *n, const struct force_kind *kind,
                        const char *what)
{
    struct markers *on = arena_take(b->life, 1, kind->size);
    struct marker at;
    int first, second;
    double world[3], axis[3], *E = on->drawn;
    bool in_world;
    if (read_keys(on, kind->keys, n, NULL, what, &b->reader)) return 1;
    if (find_two_bodies(b, &first, &second, on->bodies, what)) return 1;
    if (read_point(b, &at, on->at, what) || marker_axes(b, E, on->axis, what)) return 1;
    marker_drawn(world, b->scene, &at);
    marker_at(&f->a, b->scene, first, world);
    marker_at(&f->b, b->scene, second, world);
    m3_tmulm(on->Ea, b->scene->body[first].R, E);
    m3_tmulm(on->Eb, b->scene->body[second].R, E);
    if (kind->twist && b->scene->space == 3 && kind->twist(axis, &in_world, on)) count_turns(b, f, on, axis, in_world);
    f->type = FORCE_BETWEEN;
    f->measure = -1;
    f->kind = kind;
    f->par = on;
    return 0;
}

static int read_force(struct builder *b, struct scene_force *f, const struct node *n)
{
    char what[100];
    snprintf(what, sizeof what, "force '%.60s'", n->key);
    f->name = n->key;
    f->node = n;
    if (read_map(n, what, &b->reader)) return 1;
    if (node_find(n, "force")) return read_value(b, f, n, keys_force, what);
    f->torque = node_find(n, "torque") != NULL;
    if (f->torque) return read_value(b, f, n, keys_torque, what);
    const char *words[16] = {"force", "torque"};
    int count = 2;
    for (int i = 0; force_kind_at(i) && count < 16; i++) {
        const struct force_kind *kind = force_kind_at(i);
        if (!kind->rate) words[count++] = kind->name;
        if (node_find(n, kind->name)) return (kind->strains ? read_between : read_law)(b, f, n, kind, what);
    }
    if (not_there(b, n, "forces", "force")) return 1;
    unknown_name(b, n->count ? n->item[0] : n, AT_KEY, "E-unknown-force", "kind of force",
                 n->count ? n->item[0]->key : "", words, count);
    return 1;
}

static const struct scene_force *add(struct scene *scene, struct scene_force f)
{
    scene->force[scene->nforce] = f;
    return &scene->force[scene->nforce++];
}

void read_forces(struct builder *b, const struct node *n)
{
    struct scene *scene = b->scene;
    scene->force = TAKE(b->life, struct scene_force, (n ? n->count : 0) + 2 * scene->njoint);
    make_stops(b);
    if (!n || read_map(n, "'forces'", &b->reader)) return;
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
        struct scene_force f = {0};
        if (!wrong_name(b, n->item[i], "force") && !read_force(b, &f, n->item[i])) tip_on_force(b, add(scene, f));
    }
}
