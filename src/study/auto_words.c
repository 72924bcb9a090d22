/* auto_words.c -- what is taken, in words */
#include <math.h>

#include "engine/relay.h"
#include "multirate/schemes.h"
#include "study/auto_parts.h"
#include "study/reference.h"
#include "system/system.h"

/* The least that an explicit scheme is to take, if it is far more than r is; 0: it is not. */
static double far_behind(const struct choice *o, const struct racer *r)
{
    static const double FAR = 5;
    const double work = racer_foretold(r);
    double least = INFINITY;
    if (o->quiet) return auto_least(stepper_find("dop853"), o->stiff);
    if (!r->setting.kind->full || o->n < 2) return 0;
    for (int i = 0; i < o->n; i++) {
        const struct stepper_kind *kind = o->racer[i]->setting.kind;
        if (!kind->full && relay_has(kind)) least = fmin(least, racer_foretold(o->racer[i]));
    }
    return least < FAR * work ? 0 : fmin(least, 2 * FAR * work);
}

void auto_plan_relay(struct step_options *how, const struct choice *o, const struct racer *r)
{
    const double span = r->sim.plan.until - o->scene->start, least = far_behind(o, r);
    how->first = o->first;
    how->bends = system_may_bend(r->sim.system);
    how->gain = least > 0 ? span / least : 0;
    how->matrix = r->sim.stepper.ode->n <= MOST_DENSE ? r->price.full / r->price.evaluation : 0;
}

static int runners(const struct step_options *how)
{
    int n = 0;
    for (int i = 0; i < RUNNERS; i++) n += relay_name(how, i) != NULL;
    return n;
}

bool auto_takes_turns(const struct choice *o, const struct racer *r)
{
    struct step_options how = r->how;
    if (!o->any_scheme || !isfinite(r->setting.tolerance) || !relay_has(r->setting.kind) || o->usual < AUTO_LEAST)
        return false;
    auto_plan_relay(&how, o, r);
    return runners(&how) > 1;
}

static const char *words_of_relay(const struct choice *o, const struct racer *r, struct arena *life)
{
    struct step_options how = r->how;
    const char *text = "a relay of", *before = " ";
    auto_plan_relay(&how, o, r);
    int left = runners(&how);
    for (int i = 0; i < RUNNERS; i++) {
        if (!relay_name(&how, i)) continue;
        text = arena_print(life, "%s%s%s", text, before, relay_name(&how, i));
        before = --left == 1 ? " and " : ", ";
    }
    return arena_print(life, "%s to tolerance %.2g", text, r->setting.tolerance);
}

const char *auto_words(const struct choice *o, const struct racer *r, struct arena *life)
{
    if (auto_takes_turns(o, r)) return words_of_relay(o, r, life);
    const char *fast =
        r->nfast && r->setting.kind->two_rates
            ? arena_print(life, ", %d of %d freedoms fast", r->sim.stepper.ode->ns, r->sim.stepper.ode->n)
            : "";
    if (isfinite(r->setting.tolerance))
        return arena_print(life, "%s to tolerance %.2g%s", r->setting.kind->name, r->setting.tolerance, fast);
    const char *order = r->how.order > 2 ? arena_print(life, " of order %d", r->how.order) : "";
    if (r->setting.ratio > 1)
        return arena_print(life, "%s%s h = %g s, H = %d h%s", r->setting.kind->name, order, r->setting.step,
                           r->setting.ratio, fast);
    return arena_print(life, "%s%s h = %g s", r->setting.kind->name, order, r->setting.step);
}

const char *auto_names(const struct racer *r, struct arena *life)
{
    enum { SHOWN = 6 };
    const char *text = "";
    for (int i = 0; i < r->nfast && i < SHOWN; i++) {
        const struct scene_choice *c = &r->fast[i];
        const char *name = c->joint >= 0 ? r->scene.joint[c->joint].name : r->scene.body[c->body].name;
        const char *mode = c->joint < 0 && c->k >= 0 ? arena_print(life, ".mode%d", c->k + 1) : "";
        text = arena_print(life, "%s%s%.40s%s", text, i ? " " : "", name, mode);
    }
    return r->nfast > SHOWN ? arena_print(life, "%s ...", text) : text;
}
