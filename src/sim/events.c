/* events.c -- what is looked for at the end of every major step: the condition of `until: {when: ...}`, and joints that
 * leave their `range:`.
 *
 * Of a scheme of fixed steps both are reported at the end of the step in which they happen, which is not cut there; one that
 * chooses its steps steps onto them (onto.c). */
#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "expr/expr.h"
#include "sim/parts.h"

static void open_condition(struct sim *sim, struct arena *life)
{
    const struct scene_condition *when = &sim->scene->when;
    struct watch *w = &sim->watch;
    w->slot = TAKE(life, const struct origin *, when->nslot);
    w->value = TAKE(life, double, when->nslot);
    for (int i = 0; i < when->nslot; i++) {
        w->slot[i] = catalogue_find(&sim->catalogue, &when->slot[i]);
        assert(w->slot[i]);
        w->needs |= w->slot[i]->needs;
    }
}

static void open_ranges(struct sim *sim, struct arena *life)
{
    const struct scene *scene = sim->scene;
    struct watch *w = &sim->watch;
    w->range = TAKE(life, struct watched_range, scene->njoint);
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        if (!j->ranged) continue;
        const struct scene_slot slot = {SCENE_COORDINATE, i, 0};
        const struct origin *found = catalogue_find(&sim->catalogue, &slot);
        assert(found);
        w->needs |= found->needs;
        const char *name = sim->catalogue.column[found - sim->catalogue.origin].name;
        w->range[w->nrange++] = (struct watched_range){.joint = j, .name = name, .place = found};
    }
}

void events_open(struct sim *sim, struct arena *life)
{
    if (sim->options.counting) return;
    if (sim->scene->when.node) open_condition(sim, life);
    open_ranges(sim, life);
}

static enum status write_event(struct sim *sim, struct sink *sink, const char *kind, const char *text,
                               struct report *report)
{
    return sink_event(sink, sim->x.t, kind, text, report);
}

static int side_of(const struct sim *sim, const struct watched_range *r)
{
    const double *range = r->joint->range, x = record_value(sim, r->place);
    return (x > range[1]) - (x < range[0]);
}

static double truth_of(struct sim *sim)
{
    struct watch *w = &sim->watch;
    for (int i = 0; i < sim->scene->when.nslot; i++) w->value[i] = record_value(sim, w->slot[i]);
    return expr_value(sim->scene->when.expr, w->value);
}

enum status events_happen(bool *is, struct sim *sim)
{
    const struct watch *w = &sim->watch;
    TRY(record_evaluate(sim, w->needs));
    *is = false;
    for (int i = 0; i < w->nrange; i++) *is |= side_of(sim, &w->range[i]) != w->range[i].side;
    if (!w->slot || w->was) return OK;
    const double truth = truth_of(sim);
    *is |= truth != 0 && !isnan(truth);
    return OK;
}

static enum status check_range(struct sim *sim, struct watched_range *r, struct sink *sink, struct report *report)
{
    char text[200];
    const double *range = r->joint->range, x = record_value(sim, r->place);
    const int side = side_of(sim, r);
    if (side == r->side) return OK;
    r->side = side;
    snprintf(text, sizeof text, "%.80s %s %.6g ... %.6g: %.6g", r->name, side ? "is outside its range" : "is back in",
             range[0], range[1], x);
    if (!r->reported) sim_warn(sim, "t = %.6g s: %s", sim->x.t, text);
    r->reported = true;
    sim->went_back = 0;
    return write_event(sim, sink, "range", text, report);
}

/* Does the condition turn true?  What is true from the start has not turned. */
static enum status check_condition(struct sim *sim, struct sink *sink, struct report *report)
{
    const struct scene_condition *when = &sim->scene->when;
    struct watch *w = &sim->watch;
    const double truth = truth_of(sim);
    if (isnan(truth)) return trouble_set(&sim->trouble, TROUBLE_CONDITION, -1, truth, sim->x.t);
    const bool is = truth != 0, turned = is && !w->was;
    w->was = is;
    bool start = sim->stepper.effort.majors == 0;
    if (start && is && sim->options.log) {
        print_condition(sim, sim->options.log);
        fputs("is true at the start: the run ends when it turns true again\n", sim->options.log);
    }
    w->met = turned && !start;
    return w->met ? write_event(sim, sink, "until", when->node->text, report) : OK;
}

enum status events_check(struct sim *sim, struct sink *sink, struct report *report)
{
    struct watch *w = &sim->watch;
    TRY(record_evaluate(sim, w->needs));
    for (int i = 0; i < w->nrange; i++) TRY(check_range(sim, &w->range[i], sink, report));
    return w->slot ? check_condition(sim, sink, report) : OK;
}
