/* stops.c -- why a run stopped, in words: what went wrong, what to do about it, and the code for `fmdsub explain`. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sim/parts.h"

struct why {
    const struct sim *sim;
    const struct trouble *trouble;
    char *text;
    size_t size;
};

#define SAY(o, ...) ((void)snprintf((o)->text, (o)->size, __VA_ARGS__))

static const char *force_name(const struct why *o)
{
    const struct model *m = o->sim->model;
    return o->trouble->index >= 0 && o->trouble->index < m->nforce ? m->force[o->trouble->index].name : "?";
}

static const char *body_name(const struct why *o)
{
    return o->sim->model->body[o->trouble->index].name;
}

static const char *loop_name(const struct why *o)
{
    return o->sim->model->loop[o->trouble->index].name;
}

static const char *coordinate(const struct why *o)
{
    const int i = o->trouble->index;
    return i >= 0 && i < o->sim->stepper.ode->n ? sim_coordinate_name(o->sim, i) : "?";
}

static bool is_flexible(const struct sim *sim)
{
    for (int i = 1; i < sim->scene->nbody; i++)
        if (sim->scene->body[i].flex) return true;
    return false;
}

/* A flexible body whose own mass is round-off beside what it carries; NULL: none. */
static const struct model_body *lightest(const struct sim *sim)
{
    static const double lost = 1e-10; /* of the mass of all */
    const struct model *m = sim->model;
    const struct model_body *light = NULL;
    double all = 0;
    for (int i = 1; i < m->nbody; i++) {
        all += m->body[i].mass;
        if (m->body[i].flex && (!light || m->body[i].mass < light->mass)) light = &m->body[i];
    }
    return light && light->mass < lost * all ? light : NULL;
}

/* --- what went wrong --------------------------------------------------------------------------- */

static void memory(const struct why *o)
{
    SAY(o, "a matrix of all freedoms would take %.3g MB, more than is left", o->trouble->value / 1e6);
}

static void not_finite(const struct why *o)
{
    const char *name = coordinate(o);
    if (*name == '?')
        SAY(o, "the state has a part that is not a number");
    else
        SAY(o, "the residual of '%s' is not a number", name);
}

static void law(const struct why *o)
{
    if (o->trouble->kind == FORCE_BETWEEN)
        SAY(o, "bushing '%s' has tilted by half a turn, where its law ends", force_name(o));
    else if (isinf(o->trouble->value))
        SAY(o, "force '%s' grows without bound", force_name(o));
    else
        SAY(o, "force '%s' is not a number", force_name(o));
}

static void condition(const struct why *o)
{
    char at[220];
    SAY(o, "the condition at %s that ends the run is not a number",
        place_of(at, sizeof at, o->sim, o->sim->scene->when.node));
}

static void no_mass(const struct why *o)
{
    SAY(o, "coordinate '%s' moves no mass: the mass matrix is singular", coordinate(o));
}

static void singular(const struct why *o)
{
    SAY(o, "the iteration matrix is singular at '%s' (pivot ratio %.2g)", coordinate(o), o->trouble->value);
}

static void drive(const struct why *o)
{
    SAY(o, "drive '%s' or a rate of it is not a number", loop_name(o));
}

static void closure(const struct why *o)
{
    char by[80] = "";
    if (isfinite(o->trouble->value))
        snprintf(by, sizeof by, ": it misses by %.3g of the mechanism's size", o->trouble->value);
    SAY(o, "%s '%s' cannot be kept%s", sim_loop_kind(o->sim, o->trouble->index), loop_name(o), by);
}

static void deflection(const struct why *o)
{
    SAY(o, "the end of '%s' is displaced by more than its length", body_name(o));
}

static void inertia(const struct why *o)
{
    SAY(o, "the mass matrix is not positive: the inertia of body '%.60s' is negative about an axis", body_name(o));
}

static void idle(const struct why *o)
{
    idle_describe(o->text, o->size, o->sim, o->trouble->index);
}

static void too_small(const struct why *o)
{
    SAY(o, "the step fell to %.3g s", o->trouble->value);
}

static void rejected(const struct why *o)
{
    SAY(o, "%.0f steps were rejected, which is the limit", o->trouble->value);
}

static void creep(const struct why *o)
{
    SAY(o, "steps stay as short as %.3g s and lead nowhere", o->trouble->value);
}

static void diverged(const struct why *o)
{
    char worst[128] = "";
    if (o->trouble->index >= 0) /* else nobody has looked which */
        snprintf(worst, sizeof worst, ", worst at '%.60s' (%.3g of the tolerance)", coordinate(o), o->trouble->value);
    SAY(o, "no convergence%s, with steps from %.3g s down to a %s", worst, o->sim->plan.step,
        o->sim->plan.guard == GUARD_ACT ? "millionth" : "1024th");
}

static void jammed(const struct why *o)
{
    SAY(o, "the iteration of the forces of rigid contacts did not converge, '%.60s' is one of them",
        o->sim->model->contact[o->trouble->index].name);
}

/* --- what to do -------------------------------------------------------------------------------- */

/* By what is already in use. */
static void smaller_step(const struct why *o)
{
    const struct step_options *options = o->sim->plan.options;
    SAY(o, "%s",
        options->iteration == ITERATION_FIXED_POINT ? "try 'iteration: newton'"
        : o->sim->stepper.kind->adaptive            ? "try a smaller tolerance"
        : o->sim->plan.ratio > 1                    ? "try a smaller ratio or step"
                                                    : "try a smaller step");
}

static void fewer_points(const struct why *o)
{
    if (o->sim->scene->contact[o->trouble->index].pair == PAIR_FRICTION) {
        SAY(o, "friction that presses a joint harder than it slows it wedges it, as a short guide far from its load: a "
               "longer guide, a smaller coefficient, or another step");
        return;
    }
    SAY(o,
        "many points that touch at once, large ratios of masses or more points than hold the body are the usual "
        "cause: fewer points may help, or another step%s",
        o->sim->scene->ndrive ? "; or a drive presses bodies together: let a spring between give way" : "");
}

static void mend_numbers(const struct why *o)
{
    const struct effort *e = &o->sim->stepper.effort;
    SAY(o, "%s",
        !(e->majors || e->rejected)      ? "look for numbers of the deck that are too large, and at its forces"
        : o->sim->stepper.kind->adaptive ? "try a smaller tolerance, or look at the forces"
                                         : "try a smaller step, or look at the forces");
}

static const char AWAY[] = "keep away from 0 what its expression divides by, as by max(gap, 1e-6)";

static void mend_law(const struct why *o)
{
    SAY(o, "%s",
        o->trouble->kind == FORCE_BETWEEN
            ? "let it stand, unloaded, nearer to where it works, or turn about the axis of its own stiffness"
        : isinf(o->trouble->value) ? AWAY
                                   : "look at the expressions and tables of its forces");
}

static void mend_drive(const struct why *o)
{
    SAY(o, "look at its expression");
}

static void mend_condition(const struct why *o)
{
    SAY(o, "look for roots of negative numbers and for divisions by 0 in it, and guard them: x > 0 and sqrt(x) > 2");
}

static void give_mass(const struct why *o)
{
    const struct model_body *light = lightest(o->sim);
    if (light)
        SAY(o,
            "beside the masses that it carries the %.3g kg of flexible body '%s' are lost in round-off: take fewer "
            "modes than its %d, or a density nearer to a real one",
            light->mass, light->name, light->nmode);
    else
        SAY(o, "give the bodies it moves mass and inertia%s",
            is_flexible(o->sim) ? "; or a flexible body bends too far for its frame: cut it into 'segments', take "
                                  "fewer modes, or 'stiffening: false'"
                                : "");
}

static void give_inertia(const struct why *o)
{
    SAY(o, "give it inertia there if a force acts along that turn, else try a smaller %s",
        o->sim->stepper.kind->adaptive ? "tolerance" : "step");
}

static void bend_less(const struct why *o)
{
    SAY(o, "%s", bending_advice(o->sim->model->body[o->trouble->index].flex));
}

static void mend_loop(const struct why *o)
{
    SAY(o, "%s",
        o->trouble->kind == CLOSURE_REDUNDANT
            ? "others hold the same freedom, and sizes that differ from theirs by e miss by the root of e near a dead "
              "point: make the sizes agree exactly, or weaken or leave out one of these constraints"
            : "the mechanism comes to a dead point or locks here, see its posture in the last record; or the step is "
              "too large");
}

static void find_massless(const struct why *o)
{
    SAY(o, "look for a body without mass or inertia");
}

static void raise_memory(const struct why *o)
{
    SAY(o, "raise '--max-memory'; forces across joints and freedoms without mass are what asks for it");
}

/* The first force of the deck that jumps or bends anywhere; NULL: there is none. */
static const char *sudden_force(const struct model *m)
{
    for (int i = 0; i < m->nforce; i++)
        for (int k = 0; k < 3; k++)
            if (signal_may_leap(&m->force[i].value[k])) return m->force[i].name;
    return NULL;
}

static void find_jump(const struct why *o)
{
    const char *name = sudden_force(o->sim->model);
    if (name)
        SAY(o, "look for a force that jumps, as '%.60s' may: let it go over, as tanh(x/0.01) in place of sign(x)",
            name);
    else
        SAY(o, "look for a force that jumps");
}

static void mend_inertia(const struct why *o)
{
    SAY(o, "mend its inertia: 'inertia_check: false' takes it as it is");
}

/* Not a smaller tolerance: it would fall sooner. */
static void look_there(const struct why *o)
{
    SAY(o, "%s",
        o->sim->scene->ncontact ? "give a 'step' in place of the tolerance: it passes what happens there"
                                : "look for a force that jumps or grows without bound there");
}

/* --- all of it --------------------------------------------------------------------------------- */

static const struct stop_words {
    void (*what)(const struct why *), (*cure)(const struct why *);
    const char *code; /* for `fmdsub explain` */
    bool jumps;       /* may be from a force that jumps: that is told instead of the cure */
} words[] = {
    [TROUBLE_NONE] = {diverged, smaller_step, "no-convergence", true},
    [TROUBLE_NOT_FINITE] = {not_finite, mend_numbers, "not-finite", false},
    [TROUBLE_SINGULAR] = {singular, find_massless, "singular", false},
    [TROUBLE_IDLE] = {idle, give_inertia, "W-idle", false},
    [TROUBLE_INERTIA] = {inertia, mend_inertia, "W-inertia", false},
    [TROUBLE_DIVERGED] = {diverged, smaller_step, "no-convergence", true},
    [TROUBLE_CONTACT] = {jammed, fewer_points, "E-jam", true},
    [TROUBLE_REJECTED] = {rejected, find_jump, "no-convergence", true},
    [TROUBLE_CREEP] = {creep, find_jump, "no-convergence", true},
    [TROUBLE_TOO_SMALL] = {too_small, look_there, "no-convergence", true},
    [TROUBLE_MASS] = {no_mass, give_mass, "no-mass", false},
    [TROUBLE_LAW] = {law, mend_law, "not-finite", false},
    [TROUBLE_CONDITION] = {condition, mend_condition, "not-finite", false},
    [TROUBLE_CLOSURE] = {closure, mend_loop, "dead-point", false},
    [TROUBLE_DRIVE] = {drive, mend_drive, "not-finite", false},
    [TROUBLE_MEMORY] = {memory, raise_memory, "memory", false},
    [TROUBLE_DEFLECTION] = {deflection, bend_less, "bending", false},
};

int find_leap(const struct sim *sim, double *before, double *behind)
{
    const double H = sim->plan.step * sim->plan.ratio;
    int force = -1;
    for (double h = H; force < 0 && h < 20 * H; h *= 4)
        force = system_leap(sim->system, before, behind, sim->x.q, sim->x.v, sim->x.t, h);
    return force;
}

/* false: no force of the deck jumps near here. */
static bool jumps_here(const struct why *o)
{
    const struct sim *sim = o->sim;
    double before, behind;
    const int force = find_leap(sim, &before, &behind);
    if (force < 0) return false;
    if (isinf(behind))
        SAY(o, "force '%.60s' grows without bound near here: %s", sim->model->force[force].name, AWAY);
    else
        SAY(o,
            "force '%.60s' jumps near here, between %.4g and %.4g: let it go from one to the other, as tanh(x/0.01) in "
            "place of sign(x)",
            sim->model->force[force].name, before, behind);
    return true;
}

enum status describe_trouble(const struct sim *sim, const struct trouble *trouble, enum status status,
                             struct report *report)
{
    char what[400], cure[300];
    const struct stop_words *w = &words[trouble->code];
    const struct why on_what = {sim, trouble, what, sizeof what}, on_cure = {sim, trouble, cure, sizeof cure};
    if (trouble->code == TROUBLE_MEMORY) status = E_LIMIT;
    if (status != E_NUMERIC && status != E_MODEL && trouble->code != TROUBLE_MEMORY &&
        trouble->code != TROUBLE_REJECTED && trouble->code != TROUBLE_CREEP)
        return status;
    w->what(&on_what);
    if (!w->jumps || !jumps_here(&on_cure)) w->cure(&on_cure);
    return fail(report, status, "%s at t = %.12g s: %s; %s [%s]", status == E_MODEL ? "no start" : "stopped", sim->x.t,
                what, cure, w->code);
}
