/* loops.c -- what a run says of its loops: what was closed at the start, what is redundant, new partitions */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "loop/condense.h"
#include "sim/parts.h"

/* Where the deck has the joint that closes loop l, or the drive. */
static const struct node *node_of(const struct sim *sim, int l)
{
    const struct model *m = sim->model;
    int i = 0;
    if (m->loop[l].drive) return sim->scene->drive[l - model_first_drive(m)].node;
    while (m->loop_of[i] != l) i++;
    return sim->scene->joint[i].node;
}

/* What the deck says wrongly, where the loops have no start; NULL: no place of it alone. */
static const struct node *blamed(const struct sim *sim)
{
    const struct condense *c = system_loops(sim->system);
    const int loop = c ? condense_started(c)->blamed : BLAME_NOTHING;
    if (loop == BLAME_PARTITION) return node_find(sim->scene->deck->root, "partition");
    if (loop == BLAME_INITIAL) return node_find(sim->scene->deck->root, "initial");
    return loop >= 0 ? node_of(sim, loop) : NULL;
}

enum status sim_no_start(const struct sim *sim, enum status status, const char *why, struct report *report)
{
    const struct node *node = blamed(sim);
    if (!node) return fail(report, status, "%.900s", why);
    const struct span at = diag_span(node, AT_KEY);
    return fail(report, status, "%.300s:%d:%d: error: %.600s", diags_source(sim->scene->deck->diags, at.file)->path,
                at.from.line, at.from.col, why);
}

const char *sim_loop_kind(const struct sim *sim, int l)
{
    return sim->model->loop[l].drive ? "drive" : "constraint";
}

void warn_of_loops(const struct sim *sim, struct diags *diags)
{
    static const double SILENT = 1e-6; /* of the mechanism's size */
    const struct condense *c = sim->whole ? system_loops_stepped(sim->system) : system_loops(sim->system);
    if (!c || condense_started(c)->status != OK) return;
    const struct condense_start *s = condense_started(c);
    if (s->redundant) {
        int row = 0;
        while (!condense_dropped(c, row)) row++;
        const int first = condense_loops(c)->row[row].loop;
        diag_warn(diags, node_of(sim, first), AT_KEY, "W-redundant",
                  "%d loop equation%s redundant, the first of %s '%s': the motion is right, but some reactions are not "
                  "unique (`fmdsub check` shows which)",
                  s->redundant, s->redundant == 1 ? " is" : "s are", sim_loop_kind(sim, first),
                  sim->model->loop[first].name);
    }
    if (s->beside > 0)
        diag_warn(diags, node_of(sim, condense_loops(c)->row[s->misfit_row].loop), AT_KEY, "W-branch",
                  "the mechanism is drawn at a dead point, where branches meet: it starts %.3g rad, or of its size, "
                  "beside it, along its rates",
                  s->beside);
    if (s->misfit < SILENT || sim->scene->assemble) return;
    const int l = condense_loops(c)->row[s->misfit_row].loop;
    diag_warn(diags, node_of(sim, l), AT_KEY, "W-assembly",
              "%s '%s' misses by %.3g of the mechanism's size as drawn; closed by moving '%s' %.3g",
              sim_loop_kind(sim, l), sim->model->loop[l].name, s->misfit, sim_place_name(sim, s->moved_at), s->moved);
}

void warn_of_misfits(struct sim *sim)
{
    static const double ROUND_OFF = 1e-11;
    const struct condense *c = system_loops(sim->system);
    int loop;
    const double miss = c ? condense_missed(c, &loop) : 0;
    if (!(miss > ROUND_OFF)) return;
    sim_warn(
        sim,
        "the redundant equations of %s '%s' miss by up to %.2g of the mechanism's size: beside what others hold it has "
        "sizes that are not quite the same, and near dead points the motion is off by the root of that, %.2g, or "
        "more; make the sizes agree exactly, or leave one out [W-redundant]",
        sim_loop_kind(sim, loop), sim->model->loop[loop].name, miss, sqrt(miss));
}

int nearest_facts(const struct sim *sim, struct pair *facts)
{
    const struct nearest near = condense_nearest(system_loops(sim->system));
    facts[0] = pair_number("dead_point_ratio", near.ratio);
    facts[1] = pair_number("dead_point_t", near.t);
    facts[2] = pair_text("dead_point_at", near.place < 0 ? "" : sim_place_name(sim, near.place));
    return 3;
}

void print_nearest(const struct sim *sim, FILE *to)
{
    static const double NEAR = 1e-2;
    const struct condense *c = system_loops(sim->system);
    if (!c || !(condense_nearest(c).ratio < NEAR)) return;
    const struct nearest near = condense_nearest(c);
    fprintf(to, "nearest to a dead point at t = %.6g s: the loops hold '%s' by %.2g of what they do at best\n", near.t,
            sim_place_name(sim, near.place), near.ratio);
}

void sim_print_assembly(const struct sim *sim, FILE *to)
{
    const struct condense *c = system_loops(sim->system);
    if (!to || !c || !sim->scene->assemble || condense_started(c)->status != OK) return;
    const struct condense_start *s = condense_started(c);
    fprintf(to, "assembled: misfit %.3g of the mechanism's size", s->misfit);
    if (s->moved != 0) fprintf(to, "; '%s' has moved most, by %.6g", sim_place_name(sim, s->moved_at), s->moved);
    if (s->changed != 0)
        fprintf(to, "; the rate of '%s' has changed most, by %.6g", sim_place_name(sim, s->changed_at), s->changed);
    fputc('\n', to);
}

enum status write_partition(struct sim *sim, struct sink *sink, struct report *report)
{
    char text[400] = "independent:";
    const struct ode2 *o = system_ode2(sim->system);
    size_t used = strlen(text);
    for (int i = 0; i < o->n && used + 80 < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, " %.70s", sim_coordinate_name(sim, i));
    return sink_event(sink, sim->x.t, "partition", text, report);
}

/* The name of a body as the deck knows it. */
static const char *shown(const struct sim *sim, int body)
{
    const struct model_body *b = &sim->model->body[body];
    return b->at_node ? sim->model->body[b->parent].name : b->name;
}

/* What the loop joint holds: a body, or the coordinate of a gear or rack. */
static const char *end_name(const struct sim *sim, const struct model_loop *l, int side)
{
    const struct model *m = sim->model;
    if (l->nterm == 0) return shown(sim, side ? l->second : l->first);
    const struct model_term *t = &l->term[side];
    return m->coordinate[m->joint[t->joint].iq[t->k]].name;
}

static struct closure closure_of(const struct sim *sim, int l, bool unique)
{
    const struct model *m = sim->model;
    const struct loops *loops = condense_loops(system_loops(sim->system));
    const struct model_loop *loop = &m->loop[l];
    struct closure o = {.name = loop->name,
                        .kind = loop->drive ? "drive" : model_kind(m, loop->type)->name,
                        .first = end_name(sim, loop, 0),
                        .second = end_name(sim, loop, 1),
                        .equations = loops->first[l + 1] - loops->first[l],
                        .unique = unique};
    for (int r = loops->first[l]; r < loops->first[l + 1]; r++)
        o.redundant += condense_dropped(system_loops(sim->system), r);
    return o;
}

void sim_closures(struct closures *o, const struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    struct condense *c = system_loops(sim->system);
    *o = (struct closures){0};
    if (!c) return;
    bool *unique = TAKE(life, bool, m->nloop), *unique_joint = TAKE(life, bool, m->njoint);
    condense_mark(c, unique, unique_joint);
    o->n = m->nloop;
    o->closure = TAKE(life, struct closure, m->nloop);
    for (int l = 0; l < m->nloop; l++) o->closure[l] = closure_of(sim, l, unique[l]);
    o->loose = TAKE(life, const char *, m->njoint);
    for (int i = 0; i < m->njoint; i++)
        if (!unique_joint[i] && !m->body[i + 1].at_node) o->loose[o->nloose++] = m->joint[i].name;
    o->components = m->ncomponent;
    o->equations = condense_loops(c)->nrow;
    o->rank = o->equations - condense_started(c)->redundant;
    o->pivots = condense_ratio(c);
    o->length = system_length(sim->system);
    o->drawn = condense_started(c)->misfit;
    o->closed = condense_worst(c, sim->x.q, sim->x.t);
}
