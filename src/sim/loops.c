/* loops.c -- what a run says of its loops: what was closed at the start, what is redundant, new partitions */
#include <stdio.h>
#include <string.h>

#include "sim/parts.h"
#include "system/condense.h"

/* Where the deck has the joint that closes loop l, or the drive. */
static const struct node *node_of(const struct sim *sim, int l)
{
    const struct model *m = sim->model;
    int i = 0;
    if (m->loop[l].drive) return sim->scene->drive[l - (m->nloop - m->ndrive)].node;
    while (m->loop_of[i] != l) i++;
    return sim->scene->joint[i].node;
}

const char *sim_loop_kind(const struct sim *sim, int l)
{
    return sim->model->loop[l].drive ? "drive" : "constraint";
}

void warn_of_loops(const struct sim *sim, struct diags *diags)
{
    static const double SILENT = 1e-6; /* of the mechanism's size */
    const struct condense *c = system_loops(sim->system);
    if (!c || condense_started(c)->status != OK) return;
    const struct condense_start *s = condense_started(c);
    if (s->redundant) {
        int row = 0;
        while (!condense_dropped(c, row)) row++;
        const int first = condense_loops(c)->row[row].loop;
        diag_warn(diags, node_of(sim, first), AT_KEY, "W-redundant",
                  "%d equation(s) of the loops say nothing new, the first of %s '%s': the motion is whole, "
                  "some reactions are not unique (`fmdsub check` shows which)",
                  s->redundant, sim_loop_kind(sim, first), sim->model->loop[first].name);
    }
    if (s->misfit < SILENT) return;
    const int l = condense_loops(c)->row[s->misfit_row].loop;
    diag_warn(diags, node_of(sim, l), AT_KEY, "W-assembly",
              "%s '%s' misses by %.3g of the mechanism's size as drawn; closed by moving '%s' %.3g",
              sim_loop_kind(sim, l), sim->model->loop[l].name, s->misfit, sim_place_name(sim, s->moved_at), s->moved);
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

static void print_loop(const struct sim *sim, FILE *to, int l, bool unique)
{
    const struct condense *c = system_loops(sim->system);
    const struct loops *loops = condense_loops(c);
    const struct model_loop *loop = &sim->model->loop[l];
    int dropped = 0;
    for (int r = loops->first[l]; r < loops->first[l + 1]; r++) dropped += condense_dropped(c, r);
    const char *kind = loop->drive ? "drive" : joint_kind(loop->type, sim->model->space == 3)->name;
    fprintf(to, "  %-16s %s, %s to %s, %d equation%s", loop->name, kind, sim->model->body[loop->first].name,
            sim->model->body[loop->second].name, loops->first[l + 1] - loops->first[l],
            loops->first[l + 1] - loops->first[l] == 1 ? "" : "s");
    if (dropped) fprintf(to, ", %d of them redundant", dropped);
    fprintf(to, "%s\n", unique ? "" : "; reactions not unique");
}

void sim_print_loops(const struct sim *sim, FILE *to)
{
    const struct model *m = sim->model;
    struct condense *c = system_loops(sim->system);
    if (!c) return;
    struct arena *scratch = arena_open();
    bool *unique = TAKE(scratch, bool, m->nloop), *unique_joint = TAKE(scratch, bool, m->njoint);
    condense_mark(c, unique, unique_joint);
    fprintf(to, "loops: %d, in %d component(s); %d equations, rank %d\n", m->nloop, m->ncomponent,
            condense_loops(c)->nrow, condense_loops(c)->nrow - condense_started(c)->redundant);
    for (int l = 0; l < m->nloop; l++) print_loop(sim, to, l, unique[l]);
    for (int i = 0; i < m->njoint; i++)
        if (!unique_joint[i]) fprintf(to, "  %-16s of the tree; reactions not unique\n", m->joint[i].name);
    fprintf(to, "  independent:");
    for (int i = 0; i < sim->stepper.ode->n; i++) fprintf(to, " %s", sim_coordinate_name(sim, i));
    fprintf(to, "\n  pivot ratio of C_qd: %.2g; misfit as drawn: %.2g, after closing: %.2g\n", condense_ratio(c),
            condense_started(c)->misfit, condense_worst(c, sim->x.q, sim->x.t));
    arena_close(scratch);
}
