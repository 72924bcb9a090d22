/* auto.c -- see auto.h */
#include "study/auto.h"

#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "engine/adaptive.h"
#include "engine/relay.h"
#include "multirate/schemes.h"
#include "study/auto_parts.h"
#include "study/reference.h"
#include "study/stiff.h"

enum { LOOK = 40, HALF = LOOK / 2, MOST_HALVES = 5, MOST_LOOK = 100 }; /* evaluations */
static const double SHARE = .02;                                       /* of the run's evaluations */
static const double USUAL = 1e-4;
static const double SAFE = .03; /* of a tolerance that stands for a step: errors of high order are less foreseeable */
static const double FINER = .8; /* of its work: what a scheme of full matrices is worth, whose errors are a tenth */
static const double BESIDES = 1.2; /* of counts: what minor steps of order 4 take in time, measured on two decks */
static const double WORTH = .9;    /* of the work of what is taken without trials: less than that, or it is that */
enum { ROUNDS = 8 };

/* What does the deck leave open? */
static void read_wishes(struct choice *o)
{
    const struct scene *scene = o->scene;
    const struct step_options *how = scene->integrate.options;
    const bool scheme = auto_named(scene, "scheme"), step = auto_named(scene, "step");
    const bool by_name = scheme && strcmp(scene->integrate.scheme, "auto") == 0;
    const bool parted = node_find(scene->deck->root, "partition") && !scene->fast_auto;
    o->any_scheme = by_name || (!scheme && !step);
    o->any_fast = scene->fast_auto || (o->any_scheme && !parted && !auto_named(scene, "ratio"));
    o->tolerance = how->tolerance > 0 ? how->tolerance : USUAL;
    o->step = step && !(how->tolerance > 0) ? scene->integrate.step : NAN;
}

/* At the end of a step.  The first one that the next does not outgrow by far is what the run may begin with. */
static void look(void *self, const struct sim *sim)
{
    static const double SETTLED = 2;
    struct choice *o = self;
    const double h = sim->x.t - o->quick.t;
    if (!(o->first > 0) && adaptive_of(&sim->stepper)->h < SETTLED * h) o->first = h;
    quick_note(&o->quick, sim);
}

/* ---- the race ---- */

/* What it is foretold to take, as that is weighed against the others; INFINITY: it is not taken. */
static double weighed(const struct choice *o, const struct racer *r)
{
    const struct stepper_kind *kind = r->setting.kind;
    const double work = racer_foretold(r);
    if (r == o->racer[0]) return r->out ? INFINITY : WORTH * work;
    if (kind->full) return FINER * work;
    if (r->setting.order) return BESIDES * work;
    /* the most to lose by what comes later */
    return kind->order == 2 && !kind->two_rates && work < AUTO_LEAST / SHARE ? INFINITY : work;
}

static const struct racer *leader(const struct choice *o)
{
    const struct racer *best = o->racer[0];
    for (int i = 1; i < o->n; i++)
        if (weighed(o, o->racer[i]) < weighed(o, best)) best = o->racer[i];
    return best;
}

static double spent(const struct choice *o)
{
    double sum = o->looked;
    for (int i = 0; i < o->n; i++) sum += o->racer[i]->work;
    return sum;
}

/* Every one that is left goes on for so much work; true: there is still somebody to beat. */
static bool run_round(struct choice *o, double each, double far)
{
    int left = 0;
    for (int i = 0; i < o->n; i++) racer_go(o->racer[i], o->racer[i]->work + each, NULL, NULL);
    const double best = racer_foretold(leader(o));
    for (int i = 0; i < o->n; i++) {
        o->racer[i]->out |= racer_hope(o->racer[i]) > far * best && !racer_grows(o->racer[i]);
        left += !o->racer[i]->out;
    }
    return left > 1;
}

static int running(const struct choice *o)
{
    int n = 0;
    for (int i = 0; i < o->n; i++) n += !o->racer[i]->out;
    return n;
}

/* Rounds of twice the work, one at least, until all of them have taken what may be spent: of what the best is going to
 * take. */
static void run_race(struct choice *o)
{
    static const double FAR[] = {5, 3, 2, 1.5};
    double each = AUTO_QUOTA;
    auto_add_full(o, .5 * o->budget);
    for (int i = 0; i < ROUNDS && !stop; i++, each *= 2) {
        if (i > 0 && spent(o) + running(o) * each > o->budget) return;
        const bool on = run_round(o, each, FAR[i < 3 ? i : 3]);
        o->budget = fmin(o->budget, SHARE * racer_foretold(leader(o)));
        if (!on) return;
    }
}

/* ---- the answer ---- */

/* The next best, of another scheme if there is one. */
static const struct racer *second(const struct choice *o, const struct racer *best)
{
    const struct racer *next = NULL;
    for (int i = 0; i < o->n; i++) {
        const struct racer *r = o->racer[i];
        if (r == best || r->setting.kind == best->setting.kind || !isfinite(weighed(o, r))) continue;
        if (auto_takes_turns(o, best) && auto_takes_turns(o, r)) continue;
        if (!next || weighed(o, r) < weighed(o, next)) next = r;
    }
    return next;
}

static void take(struct choice *o, const struct racer *r, const char *because)
{
    struct integrate *p = &o->scene->integrate;
    struct step_options *how = TAKE(o->life, struct step_options, 1);
    *how = r->how;
    p->scheme = r->setting.kind->name;
    if (auto_takes_turns(o, r)) {
        p->scheme = step_relay.name;
        auto_plan_relay(how, o, r);
    }
    p->options = how;
    p->step = r->plan.step;
    p->ratio = r->plan.ratio;
    p->because = because;
    o->scene->nfast = r->nfast;
    o->scene->fast = r->fast;
}

/* A scheme by name under a tolerance may be dear. */
static const char *cheaper(const struct choice *o, double work)
{
    static const double DEAR = 3;
    const bool dear = !o->any_scheme && !isfinite(o->step) && DEAR * o->eye_hopes < work;
    return dear ? arena_print(o->life, "; dopri5 would take about %.2g: 'scheme: auto' chooses among all", o->eye_hopes)
                : "";
}

/* What has decided, where the least work has not. */
static const char *although(const struct choice *o, const struct racer *best)
{
    return best == o->racer[0] ? ": a tenth less or nothing, by forecasts like these"
                               : ": its errors are about a tenth of the others', worth a fifth of the work";
}

static void take_best(struct choice *o)
{
    const struct racer *best = leader(o), *next = second(o, best);
    const double work = racer_foretold(best);
    const char *fast =
        best->nfast && best->setting.kind->two_rates ? arena_print(o->life, " (%s)", auto_names(best, o->life)) : "";
    const char *over =
        next       ? arena_print(o->life, ", the next %s %.2g", auto_words(o, next, o->life), racer_foretold(next))
        : o->n > 1 ? ", the others are far behind"
                   : ", nothing else was worth a trial";
    const bool least = !next || work <= racer_foretold(next);
    o->scene->integrate.foretold = work;
    take(o, best,
         arena_print(o->life, "%s%s %s, foretold %.2g evaluations%s%s%s; trial runs of %.2g",
                     auto_words(o, best, o->life), fast, least ? "takes the least work" : "is taken", work, over,
                     least ? "" : although(o, best), cheaper(o, work), spent(o) + STIFF_EVALUATIONS));
}

static void take_usual(struct choice *o, const char *why)
{
    const struct racer *r = o->racer[0];
    o->scene->integrate.foretold = o->usual;
    take(o, r,
         arena_print(o->life, "%s, foretold %.2g evaluations: %s, after a look of %.2g%s", auto_words(o, r, o->life),
                     o->usual, why, o->eye->work + STIFF_EVALUATIONS, cheaper(o, o->usual)));
}

/* ---- all of it ---- */

/* dopri5 at the tolerance looks at the motion. */
static bool open_eye(struct choice *o)
{
    o->eye = auto_add(o, "dopri5", o->tolerance, NAN, 1, NULL);
    if (!o->eye || o->eye->out || o->eye->sim.stepper.ode->n == 0) return false;
    quick_open(&o->quick, &o->eye->sim, o->own);
    quick_note(&o->quick, &o->eye->sim);
    for (int i = 0; i < 2 || (i < MOST_HALVES && racer_grows(o->eye)); i++)
        racer_go(o->eye, o->eye->work + HALF, look, o);
    o->stiff = stiff_rate(&o->eye->sim) * (o->eye->sim.plan.until - o->scene->start);
    o->eye->least = auto_least(o->eye->setting.kind, o->stiff);
    o->quiet = racer_quiet(o->eye);
    o->bounded = auto_bounded(o->eye, o->stiff);
    o->eye_hopes = racer_hope(o->eye);
    return !o->eye->out;
}

/* What is taken where nothing is tried: by a step, the midpoint rule; by a scheme that has a name, that.  false: it does
 * not take what the deck asks for, as the run is going to tell. */
static bool open_usual(struct choice *o)
{
    const bool steps = isfinite(o->step);
    const char *name = o->any_scheme ? steps ? "midpoint" : "dopri5" : o->scene->integrate.scheme;
    if (o->any_scheme && !steps) return true;
    o->n = 0;
    o->eye->out = true;
    o->looked = o->eye->work;
    if (steps)
        o->tolerance =
            SAFE * quick_tolerance(&o->quick, &o->eye->sim, o->step, o->eye->sim.plan.until - o->scene->start);
    struct racer *r = auto_add(o, name, steps ? NAN : o->tolerance, steps ? o->step : NAN, 1, NULL);
    if (!r) return false;
    racer_go(r, r->work + HALF, NULL, NULL);
    return true;
}

/* In place of dopri5: order 8; what is stiff and does not move asks an explicit scheme for steps that the motion does not.
 * What moves and yet keeps steps at their bound is left to the race, if there is one. */
static void take_higher_order(struct choice *o)
{
    const bool idle = o->quiet || (o->bounded && SHARE * o->eye_hopes < AUTO_LEAST);
    const bool implicit = idle && o->eye->sim.stepper.ode->n <= MOST_DENSE;
    o->n = 0;
    o->looked = o->eye->work;
    o->eye->least = implicit ? 0 : o->eye->least;
    o->foretold = racer_hope(o->eye);
    const struct racer *other = auto_add(o, implicit ? "radau9" : "dop853", o->tolerance, NAN, 1, NULL);
    o->usual = implicit ? o->foretold : auto_higher_order(o, o->foretold);
    if (other && (implicit || o->usual < o->foretold)) return;
    o->racer[0] = o->eye;
    o->n = 1;
    o->usual = o->foretold;
    o->looked = 0;
}

/* In place of the midpoint rule by a step, where dopri5 at the tolerance that it stands for is foretold half the work. */
static void take_explicit(struct choice *o)
{
    static const double ORDER = 5, HALF_OF_IT = .5;
    const double work = o->eye_hopes * pow(USUAL / o->tolerance, 1 / ORDER);
    struct racer *r =
        !o->quiet && work < HALF_OF_IT * o->foretold ? auto_add(o, "dop853", o->tolerance, NAN, 1, NULL) : NULL;
    if (!r) return;
    o->racer[0] = r;
    o->foretold = o->usual = work;
}

/* What is fast is looked for a little longer. */
static void look_on(struct choice *o)
{
    const bool was_out = o->eye->out;
    o->eye->out = false;
    racer_go(o->eye, o->eye->work + fmin(MOST_LOOK, .2 * o->budget), look, o);
    o->eye->out |= was_out;
    o->looked = o->racer[0] == o->eye ? 0 : o->eye->work;
}

static void choose(struct choice *o)
{
    if (!open_usual(o)) return;
    o->foretold = o->usual = racer_hope(o->racer[0]);
    if (o->any_scheme && !isfinite(o->step)) take_higher_order(o);
    o->budget = SHARE * o->foretold;
    if (o->budget < AUTO_LEAST && o->any_scheme && isfinite(o->step)) take_explicit(o);
    if (o->budget < AUTO_LEAST) {
        take_usual(o, "too short a run for trials to pay");
        return;
    }
    if (o->eye->sim.stepper.ode->n > 1 && (o->any_fast || o->scene->nfast)) look_on(o);
    if (o->any_fast) o->ncut = quick_cuts(o->cut, &o->quick, &o->eye->sim, o->life);
    auto_add_all(o);
    run_race(o);
    if (o->any_scheme && !isfinite(o->step)) auto_size_fourths(o, racer_foretold(leader(o)));
    take_best(o);
}

enum status auto_choose(struct scene *scene, struct arena *life, struct report *report)
{
    struct choice o = {.scene = scene, .life = life};
    read_wishes(&o);
    (void)report;
    if (!(o.any_scheme || o.any_fast) || !(scene->integrate.until > 0)) return OK;
    if (scene->ncontact) {
        if (o.any_scheme) scene->integrate.because = "midpoint, which takes rigid contacts";
        if (o.any_scheme) scene->integrate.scheme = "midpoint";
        return OK;
    }
    o.own = arena_open();
    o.diags = diags_open(o.own);
    if (open_eye(&o)) choose(&o);
    arena_close(o.own);
    return stop_status();
}

void auto_same(struct scene *scene, const struct scene *from)
{
    struct integrate *to = &scene->integrate;
    const struct integrate *p = &from->integrate;
    if (!p->because) return;
    to->scheme = p->scheme;
    to->options = p->options;
    to->step = p->step;
    to->ratio = p->ratio;
    to->because = p->because;
    to->foretold = p->foretold;
    scene->nfast = from->nfast;
    scene->fast = from->fast;
}
