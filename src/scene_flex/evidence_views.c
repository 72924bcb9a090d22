/* evidence_views.c -- what of a flexible body is looked at: nodes, and what the deck's columns show. */
#include "scene_flex/evidence.h"

#include <string.h>

#include "base/text.h"
#include "la/vec3.h"

/* ---- columns, before they are read ---- */

static const struct node *columns_of(const struct builder *b)
{
    const struct node *n = node_find(b->scene->deck->root, "output");
    return n && n->type == NODE_MAP ? node_find(n, "columns") : NULL;
}

/* Does a column show it? */
static bool is_shown(const struct builder *b, const char *name)
{
    const struct node *list = columns_of(b);
    for (int i = 0; list && list->type == NODE_LIST && i < list->count; i++) {
        const struct node *n = list->item[i];
        if (n->type == NODE_SCALAR && text_match(n->text, name)) return true;
        for (int k = 0; n->type == NODE_MAP && k < n->count; k++)
            if (n->item[k]->type == NODE_SCALAR && strstr(n->item[k]->text, name)) return true;
    }
    return false;
}

static bool shows_one(const struct builder *b, const char *what, const char *const *words)
{
    char name[200];
    for (; *words; words++) {
        snprintf(name, sizeof name, "%s.%s", what, *words);
        if (is_shown(b, name)) return true;
    }
    return false;
}

/* ---- views ---- */

static void add_nodes(struct evidence *e)
{
    const int space = e->b->scene->space;
    for (int i = 0; i < e->all->nnode; i++) {
        const struct flex_node *n = &e->all->node[i];
        const char *name = arena_print(e->b->life, "station %.3g m from the centre", v3_norm(n->x));
        if (i == e->all->reference) continue;
        for (int a = 0; a < space; a++) add_view(e, name, GROUP_MOVES, n->phi, 3, a);
        for (int a = space == 2 ? 2 : 0; a < 3; a++) add_view(e, name, GROUP_TURNS, n->psi, 3, a);
    }
}

static void add_point(struct evidence *e, const struct scene_point *p)
{
    static const char *const moves[] = {"dx", "dy", "dz", NULL}, *const turns[] = {"rx", "ry", "rz", NULL},
                             *const places[] = {"x", "y", "z", NULL};
    double world[3], offset[3], *rows = TAKE(e->b->life, double, 3 * e->all->n);
    marker_drawn(world, e->b->scene, &p->at);
    const int node = scene_node(offset, e->body, world), space = e->b->scene->space;
    const struct flex_node *n = &e->all->node[node];
    for (int k = 0; k < e->all->n; k++) {
        v3_cross(rows + 3 * k, n->psi + 3 * k, offset);
        v3_add(rows + 3 * k, n->phi + 3 * k);
    }
    if (node == e->all->reference && v3_norm(offset) == 0) return;
    const bool moved = shows_one(e->b, p->name, moves), placed = shows_one(e->b, p->name, places);
    const int group = moved || placed ? new_group(e, GROUP_MOVES) : -1;
    for (int a = 0; a < space && group >= 0; a++) {
        const char *const one[] = {moves[a], NULL};
        const char *name = arena_print(e->b->life, "%s.%s", p->name, moves[a]);
        add_view(e, name, group, rows, 3, a);
        if (shows_one(e->b, p->name, one)) add_view(e, name, new_group(e, group), rows, 3, a);
    }
    if (!shows_one(e->b, p->name, turns)) return;
    const int turning = new_group(e, GROUP_TURNS);
    for (int a = space == 2 ? 2 : 0; a < 3; a++)
        add_view(e, arena_print(e->b->life, "%s.%s", p->name, turns[a]), turning, n->psi, 3, a);
}

/* Stretch of a beam's ends, for the tension that comes with it. */
static void add_tension(struct evidence *e)
{
    const struct flex_statics *s = e->all->statics;
    if (!s || !e->all->s) return;
    for (int i = 0; i < e->all->nnode; i++) {
        double *rows = TAKE(e->b->life, double, e->all->n);
        if (i == e->all->reference) continue;
        for (int k = 0; k < e->all->n; k++) rows[k] = v3_dot(e->all->node[i].phi + 3 * k, s->along);
        add_view(e, "tension", new_group(e, -1), rows, 1, 0);
        e->view[e->o.nview - 1].tension = true;
    }
}

static void add_stress(struct evidence *e, const struct flex_stress *s)
{
    static const char *const tensor[] = {"xx", "yy", "zz", "xy", "xz", "yz", "von_mises", NULL},
                             *const bending[] = {"bending", NULL}, *const axial[] = {"axial", NULL};
    char what[160];
    snprintf(what, sizeof what, "%s.%s", e->body->name, s->name);
    const int group = new_group(e, -1);
    if (shows_one(e->b, what, tensor))
        for (int a = 0; a < 6; a++)
            add_view(e, arena_print(e->b->life, "%s.%s", what, tensor[a]), group, s->tensor, 6, a);
    if (s->bending && shows_one(e->b, what, bending))
        add_view(e, arena_print(e->b->life, "%s.bending", what), new_group(e, -1), s->bending, 1, 0);
    if (s->axial && shows_one(e->b, what, axial))
        add_view(e, arena_print(e->b->life, "%s.axial", what), new_group(e, -1), s->axial, 1, 0);
}

void add_views(struct evidence *e)
{
    const struct scene *s = e->b->scene;
    for (int g = 0; g < GROUPS; g++) new_group(e, -1);
    add_nodes(e);
    add_tension(e);
    for (int i = 0; i < s->npoint; i++)
        if (s->point[i].at.body == e->index) add_point(e, &s->point[i]);
    for (int i = 0; i < e->all->nstress; i++) add_stress(e, &e->all->stress[i]);
}
