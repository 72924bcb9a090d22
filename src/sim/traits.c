/* traits.c -- what those who run a scene more than once ask of its system. */
#include <math.h>

#include "la/vec3.h"
#include "sim/parts.h"

bool sim_in_plane(const struct sim *sim)
{
    return system_is_flat(sim->system);
}

int sim_floating(const struct sim *sim)
{
    return system_floating(sim->system);
}

double sim_spin(struct sim *sim)
{
    const struct model *m = sim->model;
    struct trouble why;
    double most = 0;
    if (system_evaluate(sim->system, sim->x.q, sim->x.v, sim->x.t, EVALUATE_MOTION, &why) != OK) return 0;
    for (int i = 1; i < m->nbody; i++) {
        struct pose pose;
        if (!m->body[i].flex) continue;
        system_pose(sim->system, &pose, i);
        most = fmax(most, v3_norm(pose.w));
    }
    return most;
}
