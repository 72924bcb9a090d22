/* catalogue.c -- see catalogue.h; the order here is the order in which wild cards find columns */
#include "sim/catalogue.h"

#include <string.h>

#include "loop/coordinates.h"

struct listing {
    struct catalogue *o;
    const struct scene *scene;
    const struct model *m;
    struct arena *life;
    int plane;
};

void catalogue_add(struct catalogue *o, const char *name, const char *unit, const struct origin *origin,
                   struct arena *life)
{
    int capacity = o->capacity;
    o->column = arena_more(life, o->column, o->n, &capacity, sizeof *o->column);
    o->origin = arena_more(life, o->origin, o->n, &o->capacity, sizeof *o->origin);
    o->column[o->n] = (struct column){name, unit, origin->kind->brief};
    o->origin[o->n++] = *origin;
}

static void add(struct listing *l, const char *name, const char *unit, struct origin origin)
{
    origin.needs = origin.kind->needs;
    catalogue_add(l->o, name, unit, &origin, l->life);
}

static struct owner *own(struct listing *l, const char *name, const struct node *node)
{
    struct owner *o = TAKE(l->life, struct owner, 1);
    *o = (struct owner){.name = name, .node = node};
    return o;
}

static const struct scene_slot *slot(struct listing *l, enum scene_slot_type type, int index, int k)
{
    struct scene_slot *o = TAKE(l->life, struct scene_slot, 1);
    *o = (struct scene_slot){type, index, k};
    return o;
}

/* ---- rows ---- */

/* The number of the word [len] among the words of a list; 0: not there. */
static int number_of(const char *word, size_t len, const char *list)
{
    for (int k = 0; list; k++) {
        const size_t n = strcspn(list, " ");
        if (n == len && memcmp(list, word, n) == 0) return k;
        list = list[n] ? list + n + 1 : NULL;
    }
    return 0;
}

static const char *unit_of(const struct column_kind *row, bool angular)
{
    return angular && row->angular ? row->angular : row->unit;
}

/* The columns of one row. */
static void add_row(struct listing *l, const struct column_kind *row, struct origin origin, bool angular)
{
    const char *word = l->plane ? row->plane : row->space;
    origin.kind = row;
    while (word) {
        const size_t len = strcspn(word, " ");
        origin.k = number_of(word, len, row->space);
        add(l, arena_print(l->life, "%s%.*s", origin.of->name, (int)len, word), unit_of(row, angular), origin);
        word = word[len] ? word + len + 1 : NULL;
    }
}

static void add_angular(struct listing *l, const struct column_kind *table, struct origin origin, bool angular)
{
    for (; table->brief; table++) add_row(l, table, origin, angular);
}

static void add_rows(struct listing *l, const struct column_kind *table, struct origin origin)
{
    add_angular(l, table, origin, false);
}

/* ---- joints ---- */

static void add_tie(struct listing *l, const struct model_loop *loop, struct origin origin)
{
    const int last = loop->nterm - 1;
    if (last >= 0)
        add_angular(l, columns_gear, origin, loop->term[last].angular);
    else
        add_rows(l, columns_tie, origin);
    if (model_kind(l->m, loop->type)->tie == TIE_POINTS) add_rows(l, columns_rod, origin);
}

/* Of a joint outside of the tree likewise. */
static void add_loop_coordinates(struct listing *l, const struct owner *of, int i, int number)
{
    const struct joint_kind *kind = model_kind(l->m, l->m->loop[i].type);
    for (int p = 0; p < 3; p++)
        for (int k = 0; k < joint_size(kind, p); k++) {
            const char *name = arena_print(l->life, "%s.%s", of->name, joint_name(kind, p, k));
            const int row = p ? p + 1 : !loop_winds(l->m, i, k);
            struct origin o = {&columns_loop_coordinate[row], .of = of, .index = i, .k = k};
            if (p < 2) o.slot = slot(l, p ? SCENE_RATE : SCENE_COORDINATE, number, k);
            add(l, name, joint_unit(kind, p, k), o);
        }
}

static void add_loop(struct listing *l, const struct owner *of, int i, int number)
{
    const struct model_loop *loop = &l->m->loop[i];
    const struct origin origin = {.of = of, .index = i};
    add_loop_coordinates(l, of, i, number);
    if (joint_is_tie(model_kind(l->m, loop->type)))
        add_tie(l, loop, origin);
    else
        add_rows(l, columns_loop_reaction, origin);
}

/* Coordinates of a joint, their rates, their accelerations.  number: the scene's; -1: the scene has it not. */
static void add_coordinates(struct listing *l, const struct owner *of, int i, int number)
{
    const struct model_joint *j = &l->m->joint[i];
    const struct joint_kind *kind = model_kind(l->m, j->type);
    for (int p = 0; p < 3; p++)
        for (int k = 0; k < joint_size(kind, p); k++) {
            const int *place = p ? j->iv : j->iq;
            const char *name = arena_print(l->life, "%s.%s", of->name, joint_name(kind, p, k));
            struct origin o = {&columns_coordinate[p], .of = of, .index = place[model_rate(j, k)]};
            if (p < 2) o.slot = slot(l, p ? SCENE_RATE : SCENE_COORDINATE, number, k);
            add(l, name, joint_unit(kind, p, k), o);
        }
}

static void add_joint(struct listing *l, int number)
{
    const struct scene_joint *joint = &l->scene->joint[number];
    const int i = l->m->joint_of[number];
    const struct owner *of = own(l, joint->name, joint->node);
    if (i < 0) {
        add_loop(l, of, l->m->loop_of[number], number);
        return;
    }
    add_coordinates(l, of, i, number);
    add_rows(l, columns_reaction, (struct origin){.of = of, .index = i});
}

/* Joints of the tree that are not the deck's: free by default. */
static void add_unnamed(struct listing *l)
{
    const struct model *m = l->m;
    bool *named = TAKE(l->life, bool, m->njoint);
    for (int i = 0; i < l->scene->njoint; i++)
        if (m->joint_of[i] >= 0) named[m->joint_of[i]] = true;
    for (int i = 0; i < m->njoint; i++)
        if (!named[i] && !m->body[i + 1].at_node) add_coordinates(l, own(l, m->joint[i].name, NULL), i, -1);
}

/* ---- bodies ---- */

/* A beam's stress by its parts, a solid's by the tensor. */
static void add_stress(struct listing *l, const struct flex_stress *s, struct origin origin)
{
    const bool beam = s->axial && s->bending;
    if (beam) add_rows(l, columns_beam_stress, origin);
    if (beam && s->shear) add_rows(l, columns_beam_shear, origin);
    if (!beam) add_rows(l, columns_solid_stress, origin);
    add_rows(l, columns_von_mises, origin);
}

/* Elastic coordinates, then their rates, then their accelerations. */
static void add_modes(struct listing *l, const struct owner *of, int number)
{
    const struct model_body *b = &l->m->body[l->m->body_of[number]];
    for (int p = 0; p < 3; p++)
        for (int k = 0; k < b->nmade; k++) {
            const int i = model_mode(b, k);
            const char *name = arena_print(l->life, "%s.mode%d%s", of->name, k + 1, columns_mode[p].space);
            struct origin o = {&columns_mode[p], .of = of, .index = i < 0 ? -1 : p ? b->mode_v[i] : b->mode_q[i]};
            if (p < 2) o.slot = slot(l, p ? SCENE_MODE_RATE : SCENE_MODE, number, k);
            add(l, name, columns_mode[p].unit, o);
        }
}

static void add_elastic(struct listing *l, int number)
{
    const struct scene_body *from = &l->scene->body[number];
    const int body = l->m->body_of[number];
    const struct flex_body *flex = l->m->body[body].flex;
    add_modes(l, own(l, from->name, from->node), number);
    for (int k = 0; flex && k < flex->nstress; k++) {
        const char *name = arena_print(l->life, "%s.%s", from->name, flex->stress[k].name);
        add_stress(l, &flex->stress[k], (struct origin){.of = own(l, name, from->node), .index = body, .place = k});
    }
}

static void add_body(struct listing *l, int number)
{
    const struct scene_body *b = &l->scene->body[number];
    add_rows(l, columns_body, (struct origin){.of = own(l, b->name, b->node), .index = l->m->body_of[number]});
}

static void add_point(struct listing *l, int i)
{
    const struct scene_body *b = &l->scene->body[l->scene->point[i].at.body];
    const struct origin origin = {.of = own(l, l->m->point[i].name, b->node), .index = i};
    add_rows(l, columns_point, origin);
    if (l->m->point[i].frame) add_rows(l, columns_bent_point, origin);
}

/* ---- measures, forces, drives ---- */

static void add_measure(struct listing *l, int i)
{
    const struct scene_measure *s = &l->scene->measure[i];
    struct origin origin = {.index = i};
    if (!s->name) return;
    origin.of = own(l, s->name, s->node);
    origin.slot = slot(l, SCENE_MEASURE, i, 0);
    add_row(l, &columns_measure[0], origin, s->angular);
    origin.slot = slot(l, SCENE_MEASURE_RATE, i, 0);
    add_row(l, &columns_measure[1], origin, s->angular);
}

/* The columns of a force are those of its type: a new one is a row here and a table in columns_force.c. */
static void add_force(struct listing *l, int i)
{
    static const struct column_kind *const of[] = {[FORCE_LAW] = columns_law,
                                                   [FORCE_VALUE] = columns_law,
                                                   [FORCE_LOAD] = columns_load,
                                                   [FORCE_BETWEEN] = columns_bushing};
    const struct model_force *f = &l->m->force[i];
    const struct origin origin = {.of = own(l, f->name, l->scene->force[i].node), .index = i};
    add_angular(l, of[f->type], origin, f->measure >= 0 ? l->m->measure[f->measure].angular : f->torque);
}

static void add_drive(struct listing *l, int i)
{
    const int loop = model_first_drive(l->m) + i;
    const struct model_loop *d = &l->m->loop[loop];
    const struct origin origin = {.of = own(l, d->name, l->scene->drive[i].node), .index = loop};
    add_angular(l, columns_drive, origin, l->m->measure[d->measure].angular);
}

static void add_contact(struct listing *l, int i)
{
    const struct model_contact *c = &l->m->contact[i];
    const struct origin origin = {.of = own(l, c->name, l->scene->contact[i].node), .index = i};
    if (c->pair == PAIR_FRICTION) {
        add_angular(l, columns_joint_friction, origin, c->angular);
        return;
    }
    add_angular(l, columns_contact, origin, c->angular);
    if (c->across) add_rows(l, columns_rubbing, origin);
}

/* ---- all ---- */

static void add_of_run(struct listing *l, const char *name, const struct column_kind *table,
                       const struct scene_slot *as)
{
    add_rows(l, table, (struct origin){.of = own(l, name, NULL), .slot = as});
}

void catalogue_build(struct catalogue *o, const struct scene *scene, const struct model *m, struct arena *life)
{
    struct listing l = {o, scene, m, life, m->space == 2};
    *o = (struct catalogue){0};
    add_of_run(&l, "t", columns_time, slot(&l, SCENE_TIME, 0, 0));
    for (int i = 0; i < scene->njoint; i++) add_joint(&l, i);
    add_unnamed(&l);
    for (int i = 1; i < scene->nbody; i++) add_elastic(&l, i);
    for (int i = 1; i < scene->nbody; i++) add_body(&l, i);
    for (int i = 0; i < m->npoint; i++) add_point(&l, i);
    for (int i = 0; i < m->nmeasure; i++) add_measure(&l, i);
    for (int i = 0; i < m->nforce; i++) add_force(&l, i);
    for (int i = 0; i < m->ndrive; i++) add_drive(&l, i);
    for (int i = 0; i < m->ncontact; i++) add_contact(&l, i);
    add_of_run(&l, "energy", columns_energy, NULL);
    if (m->ncontact) add_of_run(&l, "energy", columns_impact, NULL);
    add_of_run(&l, "momentum", columns_momentum, NULL);
    add_of_run(&l, "step", columns_step, NULL);
}

const struct origin *catalogue_find(const struct catalogue *o, const struct scene_slot *slot)
{
    for (int i = 0; i < o->n; i++) {
        const struct scene_slot *s = o->origin[i].slot;
        if (s && s->type == slot->type && s->index == slot->index && s->k == slot->k) return &o->origin[i];
    }
    return NULL;
}

const struct column_table column_tables[] = {
    {"t", NULL, columns_time},
    {"J", NULL, columns_reaction},
    {"J", "distance, point-on-line", columns_tie},
    {"J", "distance", columns_rod},
    {"J", "gear, rack", columns_gear},
    {"B", NULL, columns_body},
    {"B.mode1", "flexible bodies; likewise .mode2 ...", columns_mode},
    {"B.p", NULL, columns_point},
    {"B.p", "flexible bodies", columns_bent_point},
    {"B.s", "beams", columns_beam_stress},
    {"B.s", "beams whose section has a shape", columns_beam_shear},
    {"B.s", "bodies from files", columns_solid_stress},
    {"B.s", NULL, columns_von_mises},
    {"s", NULL, columns_measure},
    {"F", "forces along a measure", columns_law},
    {"F", "forces at points", columns_load},
    {"F", "bushings", columns_bushing},
    {"D", NULL, columns_drive},
    {"J", "with friction", columns_joint_friction},
    {"C", "rigid stops and contacts", columns_contact},
    {"C", "with friction", columns_rubbing},
    {"energy", NULL, columns_energy},
    {"energy", "scenes with rigid contacts", columns_impact},
    {"momentum", NULL, columns_momentum},
    {"step", NULL, columns_step},
    {0},
};
