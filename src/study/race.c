/* race.c -- see race.h */
#include "study/race.h"

#include <math.h>

#include "base/stop.h"
#include "engine/adaptive.h"
#include "multirate/schemes.h"

static void plan(struct racer *o)
{
    const struct integrate *deck = &o->scene.integrate;
    const bool own = isfinite(o->setting.tolerance);
    o->how = *(const struct step_options *)deck->options;
    o->how.tolerance = own ? o->setting.tolerance : 0;
    if (o->setting.order) o->how.order = o->setting.order;
    if (own) o->how.order = 2; /* what a tolerance is for */
    o->plan = *deck;
    o->plan.scheme = o->setting.kind->name;
    o->plan.options = &o->how;
    o->plan.step = own ? deck->step : o->setting.step;
    o->plan.ratio = own ? 1 : o->setting.ratio;
    o->plan.because = "a trial";
}

/* o->work from what the run has counted. */
static void note(struct racer *o)
{
    o->work = price_seconds(&o->price, o->setting.kind, &o->sim.stepper.effort) / o->unit;
}

void racer_open(struct racer *o, const struct setting *setting, const struct scene *scene, struct diags *diags,
                struct arena *life)
{
    struct report none = {0};
    const struct sim_options options = {.version = "", .counting = true};
    o->setting = *setting;
    o->scene = *scene;
    o->scene.nfast = o->nfast;
    o->scene.fast = o->fast;
    plan(o);
    o->out = sim_open(&o->sim, &o->scene, &o->plan, &options, diags, life, &none) != OK;
    if (o->out) return;
    price_find(&o->price, &o->sim);
    if (!(o->unit > 0)) o->unit = o->price.evaluation;
    o->t_mark = o->t_last = o->sim.x.t;
    note(o);
    o->work_mark = o->work;
}

static double next_record(const struct sim *sim)
{
    const double H = sim->plan.step * (double)sim->every, gone = sim->x.t - sim->scene->start;
    return fmin(sim->plan.until, sim->scene->start + H * (floor(gone / H * (1 + 1e-12) + 1e-9) + 1));
}

/* The time at which its next step must end at the latest [s]. */
static double end_of_step(const struct sim *sim)
{
    if (!sim->stepper.kind->adaptive) return sim->x.t + sim->plan.step * sim->plan.ratio;
    return sim->onto_records ? next_record(sim) : sim->plan.until;
}

static double last_step(const struct racer *o)
{
    return o->sim.x.t - o->t_last;
}

void racer_go(struct racer *o, double most, void (*seen)(void *self, const struct sim *sim), void *self)
{
    struct sim *sim = &o->sim;
    const double until = sim->plan.until * (1 - 1e-12);
    if (o->out) return;
    o->t_mark = sim->x.t;
    o->work_mark = o->work;
    o->steps = 0;
    sim->stepper.natural = sim->stepper.kind->adaptive;
    while (o->work < most && sim->x.t < until && !stop) {
        const struct integrate *p = &sim->plan;
        o->h_before = last_step(o);
        o->t_last = sim->x.t;
        o->work_last = o->work;
        sim->stepper.due = next_record(sim);
        o->out = stepper_step(&sim->stepper, &sim->x, p->step, p->ratio, end_of_step(sim), &sim->trouble) != OK;
        if (o->out) return;
        note(o);
        o->a_step = o->a_step > 0 ? fmin(o->a_step, o->work - o->work_last) : o->work - o->work_last;
        o->steps++;
        if (seen) seen(self, sim);
    }
}

/* Where the tolerance is for the whole run, steps become shorter as a power of the time since the start, after the
 * first EVEN of them (engine/adaptive.h); this is the power. */
static const double EVEN = 10;

static double power_of(const struct stepper_kind *kind)
{
    const struct adaptive_scheme *scheme = kind->adaptive ? kind->formulas : NULL;
    if (!scheme) return 0;
    return scheme->plain ? 1. / scheme->order : .5 / (scheme->order - .5);
}

/* Work of the whole run, if it goes on at the rate since time t, when its work was `work`, with steps of h. */
static double going_on(const struct racer *o, double t, double work, double h)
{
    const double start = o->scene.start, span = o->sim.plan.until - start, gone = o->sim.x.t - t;
    const double power = power_of(o->sim.stepper.kind), middle = t + gone / 2 - start + EVEN * h;
    if (o->out || !(gone > 0)) return INFINITY;
    const double rate = (o->work - work) / gone;
    return middle < span ? rate * span * pow(span / middle, power) / (1 + power) : rate * span;
}

/* Has it come to its end? */
static bool is_there(const struct racer *o)
{
    return !o->out && o->sim.x.t >= o->sim.plan.until * (1 - 1e-12);
}

double racer_foretold(const struct racer *o)
{
    if (is_there(o)) return o->work;
    return fmax(o->least, going_on(o, o->t_mark, o->work_mark, last_step(o)));
}

/* Work of the whole run, if all steps are as long as the one that it will try next: a third more for steps that
 * fail, and for what makes them shorter later. */
static double by_next_step(const struct racer *o)
{
    static const double MORE = 1.35;
    const double next = o->sim.stepper.kind->adaptive ? adaptive_of(&o->sim.stepper)->h : 0;
    if (o->out || !(next > 0) || !(o->a_step > 0)) return INFINITY;
    return o->work + MORE * o->a_step * (o->sim.plan.until - o->sim.x.t) / next;
}

double racer_hope(const struct racer *o)
{
    if (is_there(o)) return o->work;
    const double last = going_on(o, o->t_last, o->work_last, last_step(o));
    return fmax(o->least, fmin(racer_foretold(o), fmin(last, by_next_step(o))));
}

bool racer_grows(const struct racer *o)
{
    static const double FASTER = 1.3;
    return !o->out && !is_there(o) && last_step(o) > FASTER * o->h_before;
}

bool racer_quiet(const struct racer *o)
{
    return going_on(o, o->t_mark, o->work_mark, last_step(o)) < .5 * o->least;
}
