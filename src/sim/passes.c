/* passes.c -- forces along a distance whose ends come together.
 *
 * There a distance has no direction: at the start that is refused, as in the drawn position.  Ends that pass through each
 * other on the way turn the force round from one step to the next, with its size kept: as its energy is of the distance,
 * no energy is made.  It is reported as an event, for few springs are meant so. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "la/vec3.h"
#include "sim/parts.h"

static bool is_along_distance(const struct model *m, int force)
{
    const struct model_force *f = &m->force[force];
    return f->type != FORCE_BETWEEN && f->measure >= 0 && m->measure[f->measure].type == MEASURE_DISTANCE;
}

void passes_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    sim->pass = TAKE(life, struct passing, m->nforce);
    for (int i = 0; i < m->nforce; i++)
        if (is_along_distance(m, i)) sim->pass[sim->npass++].force = i;
}

static const struct model_measure *measure_of(const struct sim *sim, const struct passing *o)
{
    return &sim->model->measure[sim->model->force[o->force].measure];
}

enum status passes_begin(struct sim *sim, struct diags *diags)
{
    static const double TOGETHER = 1e-12; /* of the mechanism's length */
    enum status status = OK;
    for (int i = 0; i < sim->npass; i++) {
        struct passing *o = &sim->pass[i];
        const struct node *n = sim->scene->force[o->force].node;
        system_apart(sim->system, o->d, measure_of(sim, o));
        if (v3_norm(o->d) > TOGETHER * system_length(sim->system)) continue;
        diag_error(diags, n, AT_KEY, "E-direction",
                   "force '%.60s': its ends stand in one place at the start: no direction", n->key);
        diag_hint(diags, "use two displacements along axes, or a bushing; or let 'initial' put them apart");
        status = E_DECK;
    }
    return status;
}

/* From d0 to d, did the one end pass the other by less than `near` of how far they were apart?  A scheme that chooses its
 * steps may have turned them half round each other in a major one: there only what goes straight tells. */
static bool passed(const double *d, const double *d0, double near)
{
    double across[3], along[3];
    v3_cross(across, d0, d);
    v3_diff(along, d, d0);
    return v3_dot(d, d0) < 0 && v3_norm(across) <= near * v3_norm(along) * fmax(v3_norm(d), v3_norm(d0));
}

bool passes_through(const struct sim *sim)
{
    static const double NEAR = .5;
    for (int i = 0; i < sim->npass; i++) {
        const struct passing *o = &sim->pass[i];
        const struct force_kind *kind = sim->model->force[o->force].kind;
        double d[3];
        if (!kind || !kind->clear) continue;
        system_apart(sim->system, d, measure_of(sim, o));
        if (passed(d, o->d, NEAR)) return true;
    }
    return false;
}

enum status passes_check(struct sim *sim, struct sink *sink, struct report *report)
{
    char text[200];
    for (int i = 0; i < sim->npass; i++) {
        struct passing *o = &sim->pass[i];
        double d[3];
        system_apart(sim->system, d, measure_of(sim, o));
        const bool turned = passed(d, o->d, sim->stepper.kind->adaptive ? 1e-9 : 0.1);
        v3_copy(o->d, d);
        if (!turned) continue;
        snprintf(text, sizeof text,
                 "the ends of force '%.60s' have passed through each other, or close by: it acts the "
                 "other way round from here",
                 sim->model->force[o->force].name);
        if (sim->options.log && !o->reported) fprintf(sim->options.log, "t = %.6g s: %s\n", sim->x.t, text);
        o->reported = true;
        TRY(sink_event(sink, sim->x.t, "pass", text, report));
    }
    return OK;
}
