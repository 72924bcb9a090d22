/* loops.c -- what a run says of its loops: what was closed at the start, what is redundant, new partitions */
#include <stdio.h>
#include <string.h>

#include "sim/parts.h"
#include "system/condense.h"

/* The scene's joint that closes loop l. */
static const struct scene_joint *joint_of(const struct sim *sim, int l)
{
    int i = 0;
    while (sim->model->loop_of[i] != l) i++;
    return &sim->scene->joint[i];
}

void warn_of_loops(const struct sim *sim, struct diags *diags)
{
    static const double SILENT = 1e-6; /* of the mechanism's size */
    const struct condense *c = system_loops(sim->system);
    if (!c || condense_started(c)->status != OK) return;
    const struct condense_start *s = condense_started(c);
    if (s->misfit < SILENT) return;
    const struct scene_joint *j = joint_of(sim, condense_loops(c)->row[s->misfit_row].loop);
    diag_warn(diags, j->node, AT_KEY, "W-assembly",
              "constraint '%s' closes a loop that misses by %.3g of the mechanism's size as drawn; closed by moving "
              "'%s' %.3g",
              j->name, s->misfit, sim_place_name(sim, s->moved_at), s->moved);
}

enum status tell_partition(struct sim *sim, struct sink *sink, struct report *report)
{
    char text[400] = "independent:";
    const struct ode2 *o = system_ode2(sim->system);
    size_t used = strlen(text);
    for (int i = 0; i < o->n && used + 80 < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, " %.70s", sim_coordinate_name(sim, i));
    return sink ? sink->ops->event(sink, sim->x.t, "partition", text, report) : OK;
}
