/* contacts.c -- rigid contacts of a run: schemes that take them, the start, events */
#include <math.h>

#include "engine/touch.h"
#include "loop/condense.h"
#include "multirate/schemes.h"
#include "sim/parts.h"

/* Behind a hint: only stops may be compliant. */
static const char *give_way(const struct sim *sim)
{
    return sim->scene->contact[0].pair == PAIR_STOP ? "; or make the stop compliant, range: {hold: {stiffness: 1.0e+6}}"
                                                    : "";
}

static const char *what_it_does(const struct sim *sim)
{
    return sim->scene->contact[0].pair == PAIR_FRICTION ? "has friction" : "is a rigid contact";
}

/* What of the deck's scheme does not take them; *at: where it says so. */
static const char *refused(const struct sim *sim, const struct node **at)
{
    const struct integrate *p = &sim->plan;
    const struct step_options *o = p->options;
    const struct stepper_kind *kind = sim->stepper.kind, *single = stepper_find(p->scheme)->single;
    const struct node *scheme = node_find(p->node, "scheme");
    *at = scheme ? scheme : p->node;
    if (!kind->cut && (!single || !single->cut)) return "";
    const bool chosen = !kind->cut && o->tolerance > 0;
    if (!chosen && o->rho_infinity == 1) return NULL;
    const char *key = chosen ? "tolerance" : "rho_infinity";
    if (node_find(p->node, key)) *at = node_find(p->node, key);
    return chosen ? " by 'step' only" : " without 'rho_infinity' only";
}

/* Rigid contacts cut steps at impacts: that is written for the midpoint rule. */
enum status contacts_plan(const struct sim *sim, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const struct step_options *o = p->options;
    const char *name = sim->scene->contact[0].name, *does = what_it_does(sim);
    const struct node *at;
    const char *what = refused(sim, &at);
    if (!what && o->order == 4) {
        diag_error(diags, node_find(p->node, "order"), AT_VALUE, "E-scheme-contact",
                   "'%.60s' %s: steps of order 4 go back in time, which impacts and friction do not", name, does);
        diag_hint(diags, "order: 2%s", give_way(sim));
        return E_DECK;
    }
    if (!what) return OK;
    diag_error(diags, at, AT_VALUE, "E-scheme-contact",
               *what ? "'%.60s' %s: %s takes those%s" : "'%.60s' %s: only schemes midpoint and subcycle take those",
               name, does, p->scheme, what);
    if (sim->stepper.kind->cut)
        diag_hint(diags, "leave 'rho_infinity' out%s", give_way(sim));
    else
        diag_hint(diags, "write 'scheme: midpoint', or leave it out%s", give_way(sim));
    return E_DECK;
}

enum status sim_without_contacts(const struct sim *sim, const char *what, struct report *report)
{
    if (sim->model->ncontact == 0) return OK;
    return fail(report, E_MODEL,
                "%s: '%.60s' %s, which small motions and equilibria do not know: delete it for them%s "
                "[E-contact-linear]",
                what, sim->model->contact[0].name, what_it_does(sim), give_way(sim));
}

/* Friction in a joint needs its force, which dynamics tell only where there is one. */
static enum status check_reactions(const struct sim *sim, struct report *report)
{
    const struct model *m = sim->model;
    const struct model_contact *loose = NULL;
    if (!system_loops(sim->system)) return OK;
    struct arena *scratch = arena_open();
    bool *unique = TAKE(scratch, bool, m->nloop), *unique_joint = TAKE(scratch, bool, m->njoint);
    condense_mark(system_loops(sim->system), unique, unique_joint);
    for (int i = 0; i < m->ncontact && !loose; i++) {
        const struct model_contact *c = &m->contact[i];
        if (c->pair != PAIR_FRICTION || !(c->law.holding > 0)) continue;
        if (!(c->joint >= 0 ? unique_joint[c->joint] : unique[c->loop])) loose = c;
    }
    arena_close(scratch);
    if (!loose) return OK;
    return fail(
        report, E_MODEL,
        "no start: the force in '%.60s' is not unique, for its loop is held more often than it needs, and so its "
        "friction is not; free what holds it twice, or give the friction itself: friction: {%s} "
        "[E-friction-reaction]",
        loose->name, loose->angular ? "torque: 0.1" : "force: 1");
}

enum status contacts_begin(struct sim *sim, struct report *report)
{
    int i;
    double overlap;
    struct trouble why = {0};
    TRY(check_reactions(sim, report));
    const enum status status = touch_begin(sim->stepper.touch, &i, &overlap, &sim->x, sim->plan.step, &why);
    if (status != OK) return describe_trouble(sim, &why, E_MODEL, report);
    if (i < 0) return OK;
    const struct model_contact *c = &sim->model->contact[i];
    return fail(
        report, E_MODEL,
        "no start: contact '%.60s' overlaps by %.6g %s where the run starts; move the bodies apart by 'initial' or "
        "in the drawing [E-overlap]",
        c->name, -overlap, c->angular ? "rad" : "m");
}

enum status contacts_press(struct sim *sim)
{
    TRY(touch_forces(sim->stepper.touch, sim->press, &sim->x, &sim->trouble));
    system_push_contacts(sim->system, sim->press);
    return OK;
}

static enum status tell(struct sim *sim, const struct touch_event *e, struct sink *sink, struct report *report)
{
    static const char *const kind[] = {[TOUCH_IMPACT] = "impact",
                                       [TOUCH_CLOSES] = "closes",
                                       [TOUCH_OPENS] = "opens",
                                       [TOUCH_STARTS_STICKING] = "sticks",
                                       [TOUCH_STARTS_SLIDING] = "slips"};
    const struct model_contact *c = &sim->model->contact[e->contact];
    char text[240];
    if (e->what == TOUCH_IMPACT)
        snprintf(text, sizeof text, "%.60s: %.9g to %.9g %s, impulse %.9g %s, loss %.9g J", c->name, e->before,
                 e->after, c->angular ? "rad/s" : "m/s", e->impulse, c->angular ? "N m s" : "N s", e->loss);
    else
        snprintf(text, sizeof text, "%.60s", c->name);
    return sink_event(sink, e->t, kind[e->what], text, report);
}

enum status contacts_events(struct sim *sim, struct sink *sink, struct report *report)
{
    const struct touch_event *list;
    const int n = touch_events(sim->stepper.touch, &list);
    for (int i = 0; i < n; i++) TRY(tell(sim, &list[i], sink, report));
    touch_clear(sim->stepper.touch);
    return OK;
}
