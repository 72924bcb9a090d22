/* idle.c -- turns that move no mass (system/idle.h): held still for a run, told at its start, watched to its end.
 *
 * A force along one of them that the start does not show, because it comes later or elsewhere, sets it going; the share
 * of the run's energy that is in them then tells. */
#include <math.h>
#include <string.h>

#include "sim/parts.h"

static const struct node *node_of(const struct sim *sim, int body)
{
    int i = 1;
    while (sim->model->body_of[i] != body) i++;
    return sim->scene->body[i].node;
}

/* "'rod' about its axis [1, 0, 0]"; in the plane there is one axis only. */
static const char *turn_name(char *text, size_t size, const struct sim *sim, int i)
{
    const struct idle_turn *t = &sim->idle.turn[i];
    int used = snprintf(text, size, "'%.60s'", sim->model->body[t->body].name);
    if (sim->model->space == 3)
        snprintf(text + used, size - (size_t)used, " about its axis [%.4g, %.4g, %.4g]", t->axis[0] + 0, t->axis[1] + 0,
                 t->axis[2] + 0);
    return text;
}

void idle_open(struct sim *sim, struct arena *life)
{
    idle_find(&sim->idle, sim->system, sim->model, sim->plan.until, life);
    if (sim->idle.n > 0) sim->system = system_build(sim->model, life);
}

/* How much of a rate that the deck gives; what comes of the joints inboard is nobody's wish. */
static double dropped_of(const struct idle_turn *t)
{
    return t->given && fabs(t->dropped) > 1e-9 ? fabs(t->dropped) : 0;
}

static void warn(const struct sim *sim, struct diags *diags)
{
    const struct idle *o = &sim->idle;
    char name[160], more[60] = "", dropped[90] = "";
    int at = 0;
    for (int i = 1; i < o->n; i++)
        if (dropped_of(&o->turn[i]) > dropped_of(&o->turn[at])) at = i;
    const struct idle_turn *t = &o->turn[at];
    if (o->n > 1) snprintf(more, sizeof more, ", and so can %d more", o->n - 1);
    if (dropped_of(t) > 0)
        snprintf(dropped, sizeof dropped, "; its rate at the start, %.6g rad/s, is dropped", t->dropped);
    diag_warn(diags, node_of(sim, t->body), AT_KEY, "W-idle", "%s can turn without moving %s mass%s: held still%s",
              turn_name(name, sizeof name, sim, at), t->real > 0 ? "measurable" : "any", more, dropped);
}

enum status idle_begin(struct sim *sim, struct diags *diags, struct report *report)
{
    char name[160];
    struct idle *o = &sim->idle;
    if (o->n == 0) return OK;
    if (!sim->scene->from) idle_still(o, sim->system, sim->x.q, sim->x.v, sim->x.t);
    struct arena *scratch = arena_open();
    const int pushed = idle_pushed(TAKE(scratch, bool, o->n), o, sim->system, sim->x.q, sim->x.t, sim->plan.until);
    arena_close(scratch);
    if (pushed >= 0)
        return fail(report, E_MODEL,
                    "no start: %s can turn without moving any mass, and a force, spring or damper acts on that turn; "
                    "give it inertia there, or a joint that does not let it turn",
                    turn_name(name, sizeof name, sim, pushed));
    warn(sim, diags);
    return OK;
}

enum status idle_note(struct sim *sim)
{
    static const double SHARE = 1e-4; /* of the run's energy */
    int most = 0;
    const double energy = idle_energy(&most, &sim->idle, sim->system);
    if (energy <= SHARE * sim->ledger.norm) return OK;
    return trouble_set(&sim->trouble, TROUBLE_IDLE, most, energy, sim->x.t);
}

void idle_describe(char *what, size_t size, const struct sim *sim, int i)
{
    char name[160];
    snprintf(what, size, "%s, which can turn without moving any mass, has been set turning",
             turn_name(name, sizeof name, sim, i));
}

void sim_clear_idle(const struct sim *sim, double *K)
{
    idle_clear(&sim->idle, sim->system, K, 0, sim->x.q, sim->x.t);
}
