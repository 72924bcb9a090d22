/* flatten.c -- a spatial scene whose motion stays in a plane is stepped there, with the same columns; see model/flat.h */
#include <stdlib.h>

#include "model/build.h"
#include "model/mirror.h"
#include "sim/parts.h"

const char *sim_space(const struct sim *sim)
{
    if (sim->model->space == 2) return "planar";
    return sim->flat ? "spatial, in a plane" : "spatial";
}

/* Watches that look at bodies in space, step by step. */
static bool watched_in_space(const struct sim *sim)
{
    return sim->idle.n || sim->negative || sim->nspin || sim->ntilt;
}

/* Does the state that the run goes on from bend a mode that would be left out? */
static bool begins_bent(const struct sim *sim, const struct model *m, const bool *const *still, struct arena *life)
{
    for (int i = 1; sim->scene->from && i < m->nbody; i++)
        for (int k = 0; still[i] && k < m->body[i].nmode; k++)
            for (int p = 0; still[i][k] && p < 2; p++) {
                const char *name = arena_print(life, "%s.mode%d%s", m->body[i].name, k + 1, p ? "_rate" : "");
                const struct node *n = node_find(sim->scene->from, name);
                if (n && n->text && strtod(n->text, NULL) != 0) return true;
            }
    return false;
}

/* Which of the model's coordinates those of the whole one are; -1: left out. */
static const int *matched(const struct model *m, const struct model *whole, struct arena *life)
{
    int *from = TAKE(life, int, whole->n);
    for (int i = 0; i < whole->n; i++) from[i] = -1;
    for (int i = 0; i < m->njoint; i++)
        for (int k = 0; k < m->joint[i].nv; k++) from[whole->joint[i].iv[k]] = m->joint[i].iv[k];
    for (int i = 1; i < m->nbody; i++)
        for (int k = 0; k < m->body[i].nmode; k++)
            from[whole->body[i].mode_v[m->body[i].made[k]]] = m->body[i].mode_v[k];
    return from;
}

enum status leave_still(struct model **m, struct sim *sim, struct arena *life)
{
    if (sim->options.drawn || effect_wish(&sim->scene->effects, EFFECT_OUT_OF_PLANE) == WISH_ON) return OK;
    const bool *const *still = model_still(*m, life);
    if (!still || begins_bent(sim, *m, still, life)) return OK;
    struct model *less;
    TRY(model_build(&less, sim->scene, still, diags_open(life), life));
    if (!model_flatten(less, &sim->spatial, life)) return OK;
    sim->whole = *m;
    sim->from_whole = matched(less, *m, life);
    *m = less;
    return OK;
}

static enum status refuse(const struct sim *sim, struct diags *diags)
{
    const struct node *at = node_find(sim->scene->effects_node, effect_kinds[EFFECT_OUT_OF_PLANE].name);
    diag_error(diags, at, AT_VALUE, "E-effects", "the scene cannot stay in a plane: '%.60s' %s", sim->spatial.name,
               sim->spatial.why);
    diag_hint(diags, "'auto' steps in the plane where it can");
    return E_DECK;
}

enum status flatten_open(struct sim *sim, struct diags *diags, struct arena *life)
{
    const enum effect_wish wish = effect_wish(&sim->scene->effects, EFFECT_OUT_OF_PLANE);
    const struct model_flat *flat;
    if (sim->model->space == 2 || wish == WISH_ON) return OK;
    if (watched_in_space(sim)) {
        sim->spatial = (struct model_spatial){"the deck", "has bodies that are watched in space"};
        flat = NULL;
    } else {
        flat = model_flatten(sim->model, &sim->spatial, life);
    }
    if (!flat) return wish == WISH_OFF ? refuse(sim, diags) : OK;
    sim->flat = true;
    if (!sim->options.drawn) sim->system = system_flatten(sim->system, flat, life);
    return OK;
}
