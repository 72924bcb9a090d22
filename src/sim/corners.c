/* corners.c -- corners of drives beside friction and rigid contacts.
 *
 * Where a drive's rate jumps all that it moves is struck.  Of that impulse joints that rub and contacts that are closed
 * bear a part, which friction would take up to its coefficient; schemes take the impulse without it, or for a force of
 * their step, and what contacts count of it is not what they bear.  Nothing else tells: the balance holds.  Friction of
 * a given force has no part in an impulse.  What no joint and no closed contact hangs on the drive's bodies bears none. */
#include <math.h>

#include "engine/touch.h"
#include "sim/parts.h"

/* Does it rub by what it bears, or push? */
static bool bears(const struct sim *sim, int i)
{
    const struct model_contact *c = &sim->model->contact[i];
    return c->pair == PAIR_FRICTION ? c->law.holding > 0 || c->law.sliding > 0
                                    : touch_state(sim->stepper.touch, i)->state != TOUCH_OPEN;
}

void corners_open(struct sim *sim, struct arena *life)
{
    sim->corner.borne = TAKE(life, bool, sim->model->ncontact);
    sim->corner.above = TAKE(life, int, sim->model->nbody);
}

void corners_begin(struct sim *sim)
{
    for (int i = 0; sim->stepper.touch && i < sim->model->ncontact; i++) sim->corner.borne[i] = bears(sim, i);
}

/* ---- what a blow reaches ---- */

static int root(int *above, int i)
{
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
}

/* The ground hands nothing on. */
static void tie(int *above, int a, int b)
{
    if (a > 0 && b > 0) above[root(above, a)] = root(above, b);
}

/* The two bodies of a contact, of one that stands along a coordinate that coordinate's. */
static void bodies_of(int *a, int *b, const struct model *m, const struct model_contact *c)
{
    const int joint = c->iq >= 0 ? m->coordinate[c->iq].joint : c->joint;
    *a = joint >= 0 ? m->joint[joint].parent : c->loop >= 0 ? m->loop[c->loop].first : c->a.body;
    *b = joint >= 0 ? m->joint[joint].child : c->loop >= 0 ? m->loop[c->loop].second : c->b.body;
}

/* Bodies that joints, drives and contacts, closed before the step or behind it, hang on each other share a root; springs
 * hand on no impulse. */
static void tie_bodies(struct sim *sim)
{
    const struct model *m = sim->model;
    int *above = sim->corner.above, a, b;
    for (int i = 0; i < m->nbody; i++) above[i] = i;
    for (int i = 0; i < m->njoint; i++) tie(above, m->joint[i].parent, m->joint[i].child);
    for (int l = 0; l < m->nloop; l++) tie(above, m->loop[l].first, m->loop[l].second);
    for (int i = 0; i < m->ncontact; i++) {
        bodies_of(&a, &b, m, &m->contact[i]);
        if (sim->corner.borne[i] || bears(sim, i)) tie(above, a, b);
    }
}

static bool is_reached(struct sim *sim, const struct model_loop *drive)
{
    const struct model *m = sim->model;
    int *above = sim->corner.above, a, b;
    tie_bodies(sim);
    for (int i = 0; i < m->ncontact; i++) {
        bodies_of(&a, &b, m, &m->contact[i]);
        if (!sim->corner.borne[i] && !bears(sim, i)) continue;
        for (int k = 0; k < 4; k++) {
            const int struck = k & 1 ? drive->first : drive->second, one = k & 2 ? a : b;
            if (struck > 0 && one > 0 && root(above, struck) == root(above, one)) return true;
        }
    }
    return false;
}

/* ---- corners ---- */

/* The first in [from, to), looked for in each minor step, between the points and corners that are known: two of them may
 * cancel.  Infinity: none. */
static double corner_of(const struct sim *sim, const struct signal *s, double from, double to)
{
    const int pieces = sim->stepper.kind->adaptive ? 1 : sim->plan.ratio;
    if (s->expr && expr_is_smooth(s->expr)) return INFINITY;
    for (int k = 0; k < pieces; k++) {
        const double b = k + 1 < pieces ? from + (k + 1) * ((to - from) / pieces) : to;
        for (double a = from + k * ((to - from) / pieces), next; a < b; a = next) {
            next = fmin(b, signal_next(s, a));
            if (signal_corner(s, a, next) != 0) return fmin(next, fmax(a, signal_corner_time(s, a, next)));
        }
    }
    return INFINITY;
}

void corners_note(struct sim *sim, double from)
{
    const struct model *m = sim->model;
    if (sim->corner.told || !sim->stepper.touch || m->ndrive == 0) return;
    bool any = false;
    for (int i = 0; i < m->ncontact && !any; i++) any = sim->corner.borne[i] || bears(sim, i);
    for (int l = model_first_drive(m); any && l < m->nloop && !sim->corner.told; l++) {
        const double t = corner_of(sim, m->loop[l].drive, from, sim->x.t);
        if (!(t < INFINITY) || !is_reached(sim, &m->loop[l])) continue;
        sim->corner.met = sim->corner.told = true;
        sim_warn(sim,
                 "t = %.6g s: the rate of drive '%.60s' jumps while joints rub or rigid contacts are closed: friction "
                 "does not take its part of that impulse, and what contacts count of it is not right; round the "
                 "corner, as by smooth() over a short time [W-corner]",
                 t, m->loop[l].name);
    }
    corners_begin(sim);
}
