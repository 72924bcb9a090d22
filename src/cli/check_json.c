/* check_json.c -- fmdsub check --format json: the same as one object; csv: as rows of that */
#include <math.h>
#include <string.h>

#include "cli/chosen.h"
#include "cli/cli.h"
#include "out/facts.h"
#include "probe/modes.h"
#include "sim/sim.h"
#include "study/advice.h"

static cJSON *rate_class(bool fast)
{
    return cJSON_CreateString(fast ? "fast" : "slow");
}

static void add_elastic(cJSON *to, const struct model_body *b)
{
    facts_add(to, "modes", facts_number(b->nmode));
    if (!b->flex->hertz) return;
    cJSON *hertz = cJSON_AddArrayToObject(to, "hertz");
    for (int k = 0; k < b->nmode; k++) cJSON_AddItemToArray(hertz, facts_number(b->flex->hertz[k]));
}

/* What the modes of a beam are, and have of its bending by what the deck does. */
static void add_kept(cJSON *to, const struct model *m, int body)
{
    const struct flex_body *f = m->body[body].flex;
    if (!f->statics) return;
    cJSON *kinds = cJSON_AddArrayToObject(to, "kinds"), *kept = cJSON_AddArrayToObject(to, "kept");
    for (int k = 0; k < f->n; k++) cJSON_AddItemToArray(kinds, cJSON_CreateString(flex_kind_name(f->statics->kind[k])));
    for (int i = 0; i < m->nkept; i++) {
        const struct model_kept *k = &m->kept[i];
        if (k->body != body) continue;
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "by", k->name);
        facts_add(o, "compliance", facts_number(k->kept.share));
        if (k->kept.mass >= 0) facts_add(o, "mass", facts_number(k->kept.mass));
        cJSON_AddItemToArray(kept, o);
    }
}

static cJSON *bodies(const struct model *m)
{
    cJSON *list = cJSON_CreateArray();
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &m->body[i];
        const struct model_joint *j = &m->joint[b->joint];
        if (b->at_node) continue;
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "name", b->name);
        facts_add(o, "mass", facts_number(b->mass));
        facts_add(o, "class", rate_class(b->fast));
        cJSON_AddStringToObject(o, "on", check_parent(m, i));
        cJSON_AddStringToObject(o, "joint", j->name);
        cJSON_AddStringToObject(o, "kind", model_kind(m, j->type)->name);
        facts_add(o, "freedoms", facts_number(j->nv));
        if (b->flex) add_elastic(o, b);
        if (b->flex) add_kept(o, m, i);
        if (b->flex && b->flex->chosen) cJSON_AddItemToObject(o, "chosen", chosen_json(b->flex->chosen));
        cJSON_AddItemToArray(list, o);
    }
    return list;
}

/* Of a column of that name. */
static const char *unit_of(const struct sim *sim, const char *name)
{
    for (int i = 0; i < sim->catalogue.n; i++)
        if (strcmp(sim->catalogue.column[i].name, name) == 0) return sim->catalogue.column[i].unit;
    return "1";
}

static cJSON *coordinates(const struct sim *sim)
{
    const struct model *m = sim->model;
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < m->ncoordinate; i++) {
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "name", m->coordinate[i].name);
        facts_add(o, "class", rate_class(m->coordinate[i].fast));
        facts_add(o, "start", facts_number(sim->x.q[m->coordinate[i].iq]));
        cJSON_AddStringToObject(o, "unit", unit_of(sim, m->coordinate[i].name));
        cJSON_AddItemToArray(list, o);
    }
    return list;
}

static cJSON *forces(const struct model *m)
{
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < m->nforce; i++) {
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "name", m->force[i].name);
        facts_add(o, "class", rate_class(m->force[i].cls == FAST));
        cJSON_AddItemToArray(list, o);
    }
    return list;
}

static void add_mass(cJSON *to, double mass, const double *centre, int space)
{
    facts_add(to, "mass", facts_number(mass));
    cJSON *list = cJSON_AddArrayToObject(to, "centre");
    for (int i = 0; i < space; i++) cJSON_AddItemToArray(list, facts_number(centre[i]));
}

static cJSON *closure(const struct closure *c)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "name", c->name);
    cJSON_AddStringToObject(o, "kind", c->kind);
    cJSON_AddStringToObject(o, "first", c->first);
    cJSON_AddStringToObject(o, "second", c->second);
    facts_add(o, "equations", facts_number(c->equations));
    facts_add(o, "redundant", facts_number(c->redundant));
    facts_add(o, "reactions_unique", cJSON_CreateBool(c->unique));
    return o;
}

static void add_loops(cJSON *to, const struct sim *sim, struct arena *life)
{
    struct closures c;
    sim_closures(&c, sim, life);
    if (c.n == 0) return;
    cJSON *o = cJSON_AddObjectToObject(to, "loops"), *list = cJSON_AddArrayToObject(o, "constraints");
    for (int i = 0; i < c.n; i++) cJSON_AddItemToArray(list, closure(&c.closure[i]));
    facts_add(o, "components", facts_number(c.components));
    facts_add(o, "equations", facts_number(c.equations));
    facts_add(o, "rank", facts_number(c.rank));
    list = cJSON_AddArrayToObject(o, "independent");
    for (int i = 0; i < sim->stepper.ode->n; i++)
        cJSON_AddItemToArray(list, cJSON_CreateString(sim_coordinate_name(sim, i)));
    list = cJSON_AddArrayToObject(o, "joints_not_unique");
    for (int i = 0; i < c.nloose; i++) cJSON_AddItemToArray(list, cJSON_CreateString(c.loose[i]));
    facts_add(o, "pivot_ratio", facts_number(c.pivots));
    facts_add(o, "misfit_drawn", facts_number(c.drawn));
    facts_add(o, "misfit", facts_number(c.closed));
}

static cJSON *number_or_null(double x)
{
    return isfinite(x) ? facts_number(x) : cJSON_CreateNull();
}

static cJSON *advised(const struct advised *a)
{
    cJSON *o = cJSON_CreateObject();
    facts_add(o, "error", facts_number(a->error));
    cJSON_AddStringToObject(o, "scheme", a->scheme);
    facts_add(o, "suggested_step", number_or_null(a->step));
    facts_add(o, "suggested_ratio", facts_number(a->ratio));
    facts_add(o, "tolerance", number_or_null(a->tolerance));
    facts_add(o, "evaluations", facts_number(round(a->work)));
    return o;
}

static void add_advice(cJSON *steps, const struct advice *o)
{
    const struct advised *usual = advice_step(o, 1e-2);
    if (usual) {
        facts_add(steps, "suggested_step", facts_number(usual->step));
        facts_add(steps, "suggested_ratio", facts_number(usual->ratio));
    }
    cJSON *list = cJSON_AddArrayToObject(steps, "advice");
    for (int i = 0; i < o->n; i++)
        if (!o->entry[i].dear) cJSON_AddItemToArray(list, advised(&o->entry[i]));
    facts_add(steps, "trial_evaluations", facts_number(round(o->work)));
    facts_add(steps, "trial_until", number_or_null(o->until));
    facts_add(steps, "trial_parts", cJSON_CreateBool(o->parted));
    if (o->without) {
        cJSON_AddStringToObject(steps, "promised_without", o->without);
        facts_add(steps, "promised_without_columns", facts_number(o->nwithout));
    }
    if (o->only) {
        facts_add(steps, "promised_until", number_or_null(o->until));
        cJSON_AddStringToObject(steps, "promised_only", o->only);
    }
    if (isfinite(o->steps_until)) facts_add(steps, "trial_of_steps_until", facts_number(o->steps_until));
    if (o->no_steps) cJSON_AddStringToObject(steps, "no_step", o->no_steps);
    if (o->why) cJSON_AddStringToObject(steps, "no_advice", o->why);
    if (o->stop.text[0]) cJSON_AddStringToObject(steps, "trial_stop", o->stop.text);
}

static void add_suggestion(cJSON *steps, const struct modes *modes, const struct sim *sim)
{
    double h;
    int ratio;
    if (!(modes->fast_top > 0) && !(modes->slow_top > 0)) return;
    modes_suggest(&h, &ratio, modes, sim);
    facts_add(steps, "suggested_step", facts_number(h));
    facts_add(steps, "suggested_ratio", facts_number(ratio));
}

static void add_steps(cJSON *to, const struct sim *sim, const struct advice *advice, struct arena *life)
{
    struct modes modes;
    struct report quiet = {0};
    cJSON *steps = cJSON_AddObjectToObject(to, "steps");
    facts_add(steps, "step", facts_number(sim->plan.step));
    facts_add(steps, "ratio", facts_number(sim->plan.ratio));
    facts_add(steps, "major_steps", facts_number((double)sim->majors));
    if (advice) add_advice(steps, advice);
    if (modes_find(&modes, sim, life, &quiet) != OK) return;
    cJSON *omega = cJSON_AddArrayToObject(to, "omega");
    for (int i = 0; i < modes.n; i++) cJSON_AddItemToArray(omega, facts_number(check_omega(sim, modes.mode[i].omega)));
    if (!advice || !(advice->no_steps || advice_step(advice, 1e-2))) add_suggestion(steps, &modes, sim);
}

enum status check_json(struct sim *sim, const struct advice *advice, bool rows, struct arena *life,
                       struct report *report)
{
    double mass, centre[3];
    TRY(sim_mass(&mass, centre, sim, report));
    cJSON *o = cJSON_CreateObject();
    facts_add(o, "deck", facts_text(sim->scene->deck->name, life));
    facts_add(o, "title", facts_text(sim->scene->title, life));
    facts_add(o, "space", facts_number(sim->model->space));
    facts_add(o, "freedoms", facts_number(sim->stepper.ode->n));
    facts_add(o, "fast", facts_number(sim->stepper.ode->ns));
    facts_add(o, "bodies", bodies(sim->model));
    facts_add(o, "coordinates", coordinates(sim));
    facts_add(o, "forces", forces(sim->model));
    add_mass(o, mass, centre, sim->model->space);
    add_loops(o, sim, life);
    add_steps(o, sim, advice, life);
    if (sim->plan.because) facts_add(o, "auto", facts_text(sim->plan.because, life));
    if (!rows) return facts_print(o, true, report);
    const enum status status = check_rows(o, life, report);
    cJSON_Delete(o);
    return status;
}
