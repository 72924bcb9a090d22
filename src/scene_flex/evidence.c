/* evidence.c -- modes: auto: what moves a flexible body in this deck, and what is looked at.
 *
 * Cases: forces at its points; forces and moments at its further joints; accelerations of the joint that carries it along
 * the freedoms on its way from the ground, the turns' centrifugal loads, gravity in the directions in which it may come.
 * Where no drive moves the first joint with freedoms the body recoils along them, with what hangs between.  What a smooth
 * drive or force does from rest comes at its own pace; all else may come at once.  Views: displacements and turns of all
 * nodes, by themselves where a column shows them, and stresses that columns show.  See flex/choice.h. */
#include "scene_flex/evidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "la/vec3.h"

/* ---- the deck, before all of it is read ---- */

static const struct node *raw(const struct builder *b, const char *section, const char *key)
{
    const struct node *n = node_find(b->scene->deck->root, section);
    return n && n->type == NODE_MAP ? node_find(n, key) : NULL;
}

static double span(const struct builder *b)
{
    const struct node *n = raw(b, "integrate", "until");
    double x;
    if (!n || n->type != NODE_SCALAR || n->reported || deck_number(&x, n, b->reader.deck) != OK || !(x > 0)) return 1;
    return x;
}

static bool begins_at_rest(const struct builder *b)
{
    const struct node *n = raw(b, "initial", "static");
    return n && n->type == NODE_SCALAR && strcmp(n->text, "true") == 0;
}

/* The highest mode that a text of the deck names: "arm.mode3". */
static int highest(const struct node *n, const char *mode)
{
    int most = 0;
    const char *texts[2] = {n->key, n->type == NODE_SCALAR ? n->text : NULL};
    for (int i = 0; i < 2; i++)
        for (const char *at = texts[i]; at && (at = strstr(at, mode)); at += strlen(mode)) {
            const int k = atoi(at + strlen(mode));
            most = k > most ? k : most;
        }
    for (int i = 0; n->type != NODE_SCALAR && i < n->count; i++) {
        const int k = highest(n->item[i], mode);
        most = k > most ? k : most;
    }
    return most;
}

/* ---- lists ---- */

struct flex_case *add_case(struct evidence *e, const char *name, int family, bool sudden, double omega)
{
    e->cases = arena_more(e->b->life, e->cases, e->o.ncase, &e->casecap, sizeof *e->cases);
    struct flex_case *c = &e->cases[e->o.ncase++];
    *c = (struct flex_case){
        .name = name, .p = TAKE(e->b->life, double, e->all->n), .family = family, .sudden = sudden, .omega = omega};
    if (family >= e->o.nfamily) e->o.nfamily = family + 1;
    return c;
}

int new_group(struct evidence *e, int like)
{
    e->like = arena_more(e->b->life, e->like, e->o.ngroup, &e->likecap, sizeof *e->like);
    e->like[e->o.ngroup] = like < 0 ? e->o.ngroup : like;
    return e->o.ngroup++;
}

void add_view(struct evidence *e, const char *name, int group, const double *rows, int step, int a)
{
    const int n = e->all->n;
    double *c = TAKE(e->b->life, double, n);
    for (int k = 0; k < n; k++) c[k] = rows[a + step * k];
    e->view = arena_more(e->b->life, e->view, e->o.nview, &e->viewcap, sizeof *e->view);
    e->view[e->o.nview++] = (struct flex_view){.name = name, .c = c, .group = group};
}

/* ---- all ---- */

static double length_of(const struct flex_body *o)
{
    double most = 0;
    for (int i = 0; i < o->nnode; i++) {
        double x[3];
        v3_diff(x, o->node[i].x, o->node[o->reference].x);
        most = fmax(most, v3_norm(x));
    }
    return most > 0 ? most : 1;
}

const struct flex_chosen *choose_modes(bool *keep, struct builder *b, int body, const struct flex_body *all)
{
    struct evidence e = {.b = b, .body = &b->scene->body[body], .index = body, .all = all, .length = length_of(all)};
    const struct draft *draft = b->draft[body];
    const double tolerance = b->scene->effects.tolerance;
    e.o = (struct flex_choosing){.all = all, .movable = all->inner, .span = span(b), .nfamily = FAMILIES};
    e.o.tolerance = tolerance > 0 ? tolerance : EFFECTS_TOLERANCE;
    if (draft) e.o.tolerance *= draft->to - draft->from; /* what segments leave out adds up */
    if (draft) e.o.alpha = draft->beam.alpha, e.o.beta = draft->beam.beta, e.o.zeta = draft->beam.zeta;
    e.at_rest = begins_at_rest(b);
    e.o.least = highest(b->scene->deck->root, arena_print(b->life, "%s.mode", e.body->name));
    find_motions(&e);
    find_pace(&e);
    find_spin(&e);
    find_pull(&e);
    add_ties(&e);
    add_cases(&e);
    add_views(&e);
    e.o.cases = e.cases;
    e.o.view = e.view;
    e.o.tie = e.tie;
    e.o.like = e.like;
    e.o.rigid = (const double(*)[6])e.recoil;
    e.o.mass = e.mass;
    return flex_choose(keep, &e.o, b->life);
}
