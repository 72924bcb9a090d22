/* deflections.c -- how far flexible bodies bend in their frames.
 *
 * One frame with second-order displacements follows a body as long as it bends little: what is left out is of third
 * order, so that the deflection v of a body of length L is wrong by a share of about (v/L)^2/5 (a beam spun up, peak
 * against the geometrically exact one: 1.8e-3 at v/L = 0.094, 0.67e-3 at 0.057).  Measured at the node farthest from
 * the reference.  Beyond the body's own length nothing is right any more, and the run stops. */
#include <math.h>

#include "la/vec3.h"
#include "sim/parts.h"

void deflections_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    sim->deflection = TAKE(life, struct deflection, m->nbody);
    for (int i = 1; i < m->nbody; i++) {
        const struct flex_body *flex = m->body[i].flex;
        struct deflection o = {.body = i};
        for (int k = 0; flex && k < flex->nnode; k++) {
            double arm[3];
            v3_diff(arm, flex->node[k].x, flex->node[flex->reference].x);
            if (v3_norm(arm) <= o.size) continue;
            o.node = k;
            o.size = v3_norm(arm);
        }
        if (o.size > 0) sim->deflection[sim->ndeflection++] = o;
    }
}

static double deflection_at(const struct sim *sim, const struct deflection *o, const double *q)
{
    const struct model_body *body = &sim->model->body[o->body];
    const double *phi = body->flex->node[o->node].phi;
    double u[3] = {0, 0, 0};
    for (int j = 0; j < body->nmode; j++) v3_axpy(u, q[body->mode_q[j]], phi + 3 * j);
    return v3_norm(u);
}

int deflections_beyond(const struct sim *sim, const double *q, double lengths)
{
    for (int i = 0; i < sim->ndeflection; i++)
        if (deflection_at(sim, &sim->deflection[i], q) > lengths * sim->deflection[i].size)
            return sim->deflection[i].body;
    return 0;
}

enum status deflections_note(struct sim *sim)
{
    for (int i = 0; i < sim->ndeflection; i++) {
        struct deflection *o = &sim->deflection[i];
        double far = deflection_at(sim, o, sim->x.q);
        if (!(far > o->most)) continue;
        o->most = far;
        o->t = sim->x.t;
        if (far > o->size) return trouble_set(&sim->trouble, TROUBLE_DEFLECTION, o->body, far / o->size, o->t);
    }
    return OK;
}

const char *bending_advice(const struct flex_body *flex)
{
    return flex->s ? "cut it into 'segments', or into more, or look at its loads"
                   : "turn on geometric stiffening: 'stiffening: true'; if it bends as far with it, cut it into "
                     "'segments'";
}

/* The one that bends farthest; what bends beyond its own length has stopped the run, which said so. */
void warn_of_deflections(struct sim *sim)
{
    static const double followed = 0.2; /* of its length: beyond it more than a per cent is wrong */
    const struct deflection *worst = NULL;
    char others[40] = "";
    int n = 0;
    for (int i = 0; i < sim->ndeflection; i++) {
        const struct deflection *o = &sim->deflection[i];
        if (!(o->most > followed * o->size) || o->most > o->size) continue;
        n++;
        if (!worst || o->most * worst->size > worst->most * o->size) worst = o;
    }
    if (!worst) return;
    if (n > 1) snprintf(others, sizeof others, n == 2 ? ", as does %d more body" : ", as do %d more bodies", n - 1);
    const struct model_body *body = &sim->model->body[worst->body];
    sim_warn(sim,
             "'%s' bends by %.3g of its length (at t = %.6g s), farther than one frame follows to a per cent%s; %s "
             "[W-bending]",
             body->name, worst->most / worst->size, worst->t, others, bending_advice(body->flex));
}
