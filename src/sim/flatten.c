/* flatten.c -- a spatial scene whose motion stays in a plane is stepped there, with the same columns; see model/flat.h */
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
