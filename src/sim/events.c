/* events.c -- what is looked for at the end of every major step: the condition of `until: {when: ...}`, and joints that
 * leave their `range:`.
 *
 * Both are told at the end of the step in which they happen; the step is not cut there. */
#include <stdio.h>
#include <string.h>

#include "expr/expr.h"
#include "sim/parts.h"

static const struct origin *find(const struct sim *sim, const char *name)
{
    const struct catalogue *c = &sim->catalogue;
    for (int i = 0; i < c->n; i++)
        if (strcmp(c->column[i].name, name) == 0) return &c->origin[i];
    return NULL;
}

/* The column that a slot of the condition stands for: they have the same name. */
static const char *slot_name(const struct sim *sim, const struct scene_slot *s, struct arena *life)
{
    const struct scene *scene = sim->scene;
    const struct scene_joint *j = &scene->joint[s->index];
    switch (s->type) {
    case SCENE_TIME:
        return "t";
    case SCENE_MEASURE:
        return scene->measure[s->index].name;
    case SCENE_MEASURE_RATE:
        return arena_print(life, "%s_rate", scene->measure[s->index].name);
    case SCENE_MODE:
        return arena_print(life, "%s.mode%d", scene->body[s->index].name, s->k + 1);
    case SCENE_MODE_RATE:
        return arena_print(life, "%s.mode%d_rate", scene->body[s->index].name, s->k + 1);
    case SCENE_COORDINATE:
        return arena_print(life, "%s.%s", j->name, j->kind->q[s->k]);
    default:
        return arena_print(life, "%s.%s", j->name, j->kind->v[s->k]);
    }
}

static enum status no_coordinate(const char *name, const struct node *at, struct diags *diags)
{
    diag_error(diags, at, AT_VALUE, "E-which-coordinate", "'%.80s' belongs to a joint that closes a loop", name);
    diag_hint(diags, "such a joint has no coordinates of its own; use a measure");
    return E_DECK;
}

static enum status open_condition(struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct scene_condition *when = &sim->scene->when;
    struct watch *w = &sim->watch;
    w->slot = TAKE(life, struct origin, when->nslot);
    w->value = TAKE(life, double, when->nslot);
    for (int i = 0; i < when->nslot; i++) {
        const char *name = slot_name(sim, &when->slot[i], life);
        const struct origin *found = find(sim, name);
        if (!found) return no_coordinate(name, when->node, diags);
        w->slot[i] = *found;
        if (found->type == FROM_MEASURE || found->type == FROM_MEASURE_RATE) w->needs |= SEE_MOTION;
    }
    return OK;
}

static enum status open_ranges(struct sim *sim, struct diags *diags, struct arena *life)
{
    const struct scene *scene = sim->scene;
    struct watch *w = &sim->watch;
    w->range = TAKE(life, struct watched_range, scene->njoint);
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        if (!j->ranged) continue;
        const char *name = arena_print(life, "%s.%s", j->name, j->kind->q[0]);
        const struct origin *found = find(sim, name);
        if (!found) return no_coordinate(name, node_find(j->node, "range"), diags);
        w->range[w->nrange++] = (struct watched_range){.joint = j, .name = name, .place = *found};
    }
    return OK;
}

enum status events_open(struct sim *sim, struct diags *diags, struct arena *life)
{
    if (sim->options.counting) return OK;
    if (sim->scene->when.node) TRY(open_condition(sim, diags, life));
    return open_ranges(sim, diags, life);
}

static enum status tell(struct sim *sim, struct sink *sink, const char *kind, const char *text, struct report *report)
{
    return sink ? sink->ops->event(sink, sim->x.t, kind, text, report) : OK;
}

static enum status look_at_range(struct sim *sim, struct watched_range *r, struct sink *sink, struct report *report)
{
    char text[200];
    const double *range = r->joint->range, x = record_value(sim, &r->place);
    int side = (x > range[1]) - (x < range[0]);
    if (side == r->side) return OK;
    r->side = side;
    snprintf(text, sizeof text, "%.80s %s %.6g ... %.6g: %.6g", r->name, side ? "is outside its range" : "is back in",
             range[0], range[1], x);
    if (sim->options.say && !r->told) fprintf(sim->options.say, "t = %.6g s: %s\n", sim->x.t, text);
    r->told = true;
    return tell(sim, sink, "range", text, report);
}

/* Does the condition turn true?  What is true from the start has not turned. */
static enum status look_at_condition(struct sim *sim, struct sink *sink, struct report *report)
{
    const struct scene_condition *when = &sim->scene->when;
    struct watch *w = &sim->watch;
    for (int i = 0; i < when->nslot; i++) w->value[i] = record_value(sim, &w->slot[i]);
    bool is = expr_value(when->expr, w->value) != 0, turned = is && !w->was;
    w->was = is;
    bool start = sim->stepper.effort.majors == 0;
    if (start && is && sim->options.say) {
        say_condition(sim, sim->options.say);
        fputs("is true at the start: the run ends when it turns true again\n", sim->options.say);
    }
    w->met = turned && !start;
    return w->met ? tell(sim, sink, "until", when->node->text, report) : OK;
}

enum status events_look(struct sim *sim, struct sink *sink, struct report *report)
{
    struct watch *w = &sim->watch;
    if (!w->slot && w->nrange == 0) return OK;
    if (w->needs || sim->model->nloop)
        TRY(system_see(sim->system, sim->x.q, sim->x.v, sim->x.t, w->needs, &sim->trouble));
    for (int i = 0; i < w->nrange; i++) TRY(look_at_range(sim, &w->range[i], sink, report));
    return w->slot ? look_at_condition(sim, sink, report) : OK;
}
