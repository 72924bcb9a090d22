/* auto.c -- see auto.h */
#include "study/auto.h"

#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "model/model.h"
#include "multirate/schemes.h"
#include "study/quick.h"
#include "study/race.h"
#include "study/reference.h"
#include "study/stiff.h"

static const char OF_TWO_RATES[] = "subcycle";
enum { LOOK = 40, HALF = LOOK / 2, MOST_LOOK = 300, LEAST = 100 }; /* evaluations */
static const double SHARE = .02;                                   /* of the run's evaluations */
static const double USUAL = 1e-4;
static const double SAFE = .1;  /* of a tolerance that stands for a step: errors of high order are less foreseeable */
static const double WORTH = .9; /* of the work of what is taken without trials: less than that, or it is that */
enum {
    MOST_RACERS = 16,
    ROUNDS = 8,
    QUOTA = 30,     /* evaluations of a first round */
    FULL_ROUND = 1, /* where full matrices come in */
};
static const int ratios[] = {200, 100, 50, 20, 10, 5, 2};
static const char *const explicit_ones[] = {"dopri5", "dop853"}, *const full_ones[] = {"radau9", "radau5"};

struct choice {
    struct scene *scene;
    bool any_scheme, any_fast;
    double tolerance; /* that all aim at */
    double step;      /* the deck's, where it rules; NAN: it does not */
    double budget, foretold;
    struct racer *eye; /* that looks at the motion */
    double looked;     /* its work, where it does not race */
    double stiff;      /* what the quickest small motion turns by in the run [rad] */
    bool quiet;        /* and nothing has been seen of it */
    struct quick quick;
    int ncut;
    struct quick_cut cut[QUICK_CUTS];
    int n;
    struct racer *racer[MOST_RACERS]; /* [n] the first is what is taken without trials */
    struct diags *diags;
    struct arena *life, *own;
};

static const struct node *named(const struct scene *scene, const char *key)
{
    const struct node *n = node_find(scene->integrate.node, key);
    return n && !n->implied ? n : NULL;
}

/* What does the deck leave open? */
static void read_wishes(struct choice *o)
{
    const struct scene *scene = o->scene;
    const struct step_options *how = scene->integrate.options;
    const bool scheme = named(scene, "scheme"), step = named(scene, "step");
    const bool by_name = scheme && strcmp(scene->integrate.scheme, "auto") == 0;
    const bool parted = node_find(scene->deck->root, "partition") && !scene->fast_auto;
    o->any_scheme = by_name || (!scheme && !step);
    o->any_fast = scene->fast_auto || (o->any_scheme && !parted && !named(scene, "ratio"));
    o->tolerance = how->tolerance > 0 ? how->tolerance : USUAL;
    o->step = step && !(how->tolerance > 0) ? scene->integrate.step : NAN;
}

/* An explicit scheme takes steps of at most so many radians of the quickest small motion, excited or not: as
 * measured on flexible decks, where the error estimate ends what stability would (on the imaginary axis). */
static double least_of(const struct stepper_kind *kind, double stiff)
{
    static const struct {
        const char *name;
        double radians, evaluations; /* a step */
    } limit[] = {{"dopri5", 1.1, 6}, {"dop853", 4, 11}};
    for (size_t i = 0; i < sizeof limit / sizeof *limit; i++)
        if (strcmp(kind->name, limit[i].name) == 0) return stiff / limit[i].radians * limit[i].evaluations;
    return 0;
}

/* A first step, so that little goes into finding it. */
static struct guess guess_for(const struct choice *o, const struct racer *r, const struct quick_cut *cut)
{
    if (!o->eye || !isfinite(r->setting.tolerance)) return r->sim.stepper.guess;
    const double span = o->eye->sim.plan.until - o->scene->start;
    const double h = quick_step(&o->quick, r->setting.tolerance, span);
    if (r->setting.kind->order > 2) return (struct guess){.5 * r->setting.kind->order * o->quick.h / 2.5, 1};
    return (struct guess){h, cut ? (int)fmin(100, cut->apart) : 1};
}

static struct racer *add(struct choice *o, const char *name, double tolerance, double step, int ratio,
                         const struct quick_cut *cut)
{
    const struct setting setting = {stepper_find(name), tolerance, step, ratio};
    struct racer *r = TAKE(o->own, struct racer, 1);
    if (o->n >= MOST_RACERS) return NULL;
    r->nfast = cut ? cut->n : o->scene->nfast;
    r->fast = cut ? cut->fast : o->scene->fast;
    r->unit = o->n ? o->racer[0]->unit : 0;
    racer_open(r, &setting, o->scene, o->diags, o->own);
    if (o->n && setting.kind->full && o->racer[0]->sim.stepper.ode->n > MOST_DENSE) r->out = true;
    if (r->out && o->n) return NULL;
    r->sim.stepper.guess = guess_for(o, r, cut);
    r->least = least_of(setting.kind, o->stiff);
    return o->racer[o->n++] = r;
}

static void look(void *self, const struct sim *sim)
{
    quick_note(self, sim);
}

/* ---- who takes part ---- */

/* The largest ratio up to `most` whose major steps meet the records. */
static int ratio_for(const struct choice *o, double most)
{
    const double every = o->scene->output.every;
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; i++) {
        const double steps = every / (o->step * ratios[i]);
        if (ratios[i] > most) continue;
        if (!(every > 0) || (steps > .5 && fabs(steps - round(steps)) < 1e-9 * steps)) return ratios[i];
    }
    return 1;
}

/* Two rates, with these coordinates fast; NULL: the deck's. */
static void add_two_rates(struct choice *o, const struct quick_cut *cut)
{
    if (!isfinite(o->step)) {
        add(o, OF_TWO_RATES, o->tolerance, NAN, 1, cut);
        return;
    }
    const bool capped = named(o->scene, "ratio");
    const double cap = capped ? o->scene->integrate.ratio : INFINITY;
    const int most = cap < 8 ? (int)cap : ratio_for(o, cap);
    const int fit = ratio_for(o, fmin(cap, cut ? cut->apart : quick_apart(&o->quick, &o->eye->sim)));
    if (most > 1 && most != fit && capped) add(o, OF_TWO_RATES, NAN, o->step, most, cut);
    if (fit > 1) add(o, OF_TWO_RATES, NAN, o->step, fit, cut);
}

/* All but those whose first step is dear. */
static void add_all(struct choice *o)
{
    const struct stepper_kind *given = stepper_find(o->scene->integrate.scheme);
    const bool steps = isfinite(o->step), rates = given && given == stepper_find(OF_TWO_RATES);
    for (int i = steps ? 0 : 1; o->any_scheme && i < 2; i++) add(o, explicit_ones[i], o->tolerance, NAN, 1, NULL);
    if (o->any_scheme && !steps) add(o, "midpoint", o->tolerance, NAN, 1, NULL);
    if (!o->any_scheme && !rates) return;
    for (int i = 0; i < o->ncut; i++) add_two_rates(o, &o->cut[i]);
    if (!o->any_fast && o->scene->nfast) add_two_rates(o, NULL);
}

/* Schemes of full matrices, where a few factorizations are little beside what may be spent. */
static void add_full(struct choice *o, double most)
{
    enum { FACTORS = 3, EVALUATIONS = 30 };
    const struct price *p = &o->eye->price;
    const double first = FACTORS * p->full / o->eye->unit + EVALUATIONS;
    bool any = false;
    for (int i = 0; o->any_scheme && i < 2 && (i + 1) * first < most; i++)
        any |= add(o, full_ones[i], o->tolerance, NAN, 1, NULL) != NULL;
    for (int i = 0; any && o->quiet && i < o->n; i++) /* what is stiff may still begin to move */
        o->racer[i]->out |= o->racer[i]->setting.kind->order == 2 && !o->racer[i]->setting.kind->two_rates;
}

/* ---- the race ---- */

static const struct racer *leader(const struct choice *o)
{
    const struct racer *best = o->racer[0];
    double least = WORTH * racer_foretold(best);
    if (best->out) least = INFINITY;
    for (int i = 1; i < o->n; i++) {
        const double work = racer_foretold(o->racer[i]);
        const struct stepper_kind *kind = o->racer[i]->setting.kind;
        const bool low =
            kind->order == 2 && !kind->two_rates && work < LEAST / SHARE; /* the most to lose by what comes later */
        if (low || !(work < least)) continue;
        least = work;
        best = o->racer[i];
    }
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
        o->racer[i]->out |= racer_hope(o->racer[i]) > far * best;
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

/* Rounds of twice the work, two at least, until all of them have taken what may be spent. */
static void run_race(struct choice *o)
{
    static const double FAR[] = {5, 3, 2, 1.5};
    double each = QUOTA;
    for (int i = 0; i < ROUNDS && !stop; i++, each *= 2) {
        if (i > FULL_ROUND && spent(o) + running(o) * each > o->budget) return;
        const bool on = run_round(o, each, FAR[i < 3 ? i : 3]);
        if (i == 0) add_full(o, .5 * o->budget);
        if (!on && running(o) < 2) return;
    }
}

/* ---- the answer ---- */

static const char *words_of(const struct racer *r, struct arena *life)
{
    const char *fast =
        r->nfast && r->setting.kind->two_rates
            ? arena_print(life, ", %d of %d freedoms fast", r->sim.stepper.ode->ns, r->sim.stepper.ode->n)
            : "";
    if (isfinite(r->setting.tolerance))
        return arena_print(life, "%s to tolerance %.2g%s", r->setting.kind->name, r->setting.tolerance, fast);
    if (r->setting.ratio > 1)
        return arena_print(life, "%s h = %g s, H = %d h%s", r->setting.kind->name, r->setting.step, r->setting.ratio,
                           fast);
    return arena_print(life, "%s h = %g s", r->setting.kind->name, r->setting.step);
}

/* The next best, of another scheme if there is one. */
static const struct racer *second(const struct choice *o, const struct racer *best)
{
    const struct racer *next = NULL;
    for (int i = 0; i < o->n; i++) {
        const struct racer *r = o->racer[i];
        if (r == best || r->setting.kind == best->setting.kind || !isfinite(racer_foretold(r))) continue;
        if (!next || racer_foretold(r) < racer_foretold(next)) next = r;
    }
    return next;
}

/* What is fast, by name: the first few. */
static const char *names_of(const struct racer *r, struct arena *life)
{
    enum { SHOWN = 6 };
    const char *text = "";
    for (int i = 0; i < r->nfast && i < SHOWN; i++) {
        const struct scene_choice *c = &r->fast[i];
        const char *name = c->joint >= 0 ? r->scene.joint[c->joint].name : r->scene.body[c->body].name;
        const char *mode = c->joint < 0 && c->k >= 0 ? arena_print(life, ".mode%d", c->k + 1) : "";
        text = arena_print(life, "%s%s%.40s%s", text, i ? " " : "", name, mode);
    }
    return r->nfast > SHOWN ? arena_print(life, "%s ...", text) : text;
}

static void take(struct choice *o, const struct racer *r, const char *because)
{
    struct integrate *p = &o->scene->integrate;
    struct step_options *how = TAKE(o->life, struct step_options, 1);
    *how = r->how;
    p->scheme = r->setting.kind->name;
    p->options = how;
    p->step = r->plan.step;
    p->ratio = r->plan.ratio;
    p->because = because;
    o->scene->nfast = r->nfast;
    o->scene->fast = r->fast;
}

static void take_best(struct choice *o)
{
    const struct racer *best = leader(o), *next = second(o, best);
    const double work = racer_foretold(best);
    const char *fast =
        best->nfast && best->setting.kind->two_rates ? arena_print(o->life, " (%s)", names_of(best, o->life)) : "";
    const char *over = next ? arena_print(o->life, ", the next %s %.2g", words_of(next, o->life), racer_foretold(next))
                       : o->n > 1 ? ", the others are far behind"
                                  : ", nothing else was worth a trial";
    o->scene->integrate.foretold = work;
    take(o, best,
         arena_print(o->life,
                     "%s%s takes the least work, foretold %.2g evaluations%s; "
                     "trial runs of %.2g",
                     words_of(best, o->life), fast, work, over, spent(o)));
}

static void take_usual(struct choice *o, const char *why)
{
    const struct racer *r = o->racer[0];
    o->scene->integrate.foretold = o->foretold;
    take(o, r, arena_print(o->life, "%s, foretold %.2g evaluations: %s", words_of(r, o->life), o->foretold, why));
}

/* ---- all of it ---- */

/* dopri5 at the tolerance looks at the motion. */
static bool open_eye(struct choice *o)
{
    o->eye = add(o, "dopri5", o->tolerance, NAN, 1, NULL);
    if (!o->eye || o->eye->out || o->eye->sim.stepper.ode->n == 0) return false;
    quick_open(&o->quick, &o->eye->sim, o->own);
    quick_note(&o->quick, &o->eye->sim);
    for (int i = 0; i < 2; i++) racer_go(o->eye, o->eye->work + HALF, look, &o->quick);
    o->stiff = stiff_rate(&o->eye->sim) * (o->eye->sim.plan.until - o->scene->start);
    o->eye->least = least_of(o->eye->setting.kind, o->stiff);
    o->quiet = racer_quiet(o->eye);
    return !o->eye->out;
}

/* What is taken where nothing is tried: by a step, the midpoint rule; by a scheme that has a name, that. */
static void open_usual(struct choice *o)
{
    const bool steps = isfinite(o->step);
    const char *name = o->any_scheme ? steps ? "midpoint" : "dopri5" : o->scene->integrate.scheme;
    if (o->any_scheme && !steps) return;
    o->n = 0;
    o->eye->out = true;
    o->looked = o->eye->work;
    if (steps) o->tolerance = SAFE * quick_tolerance(&o->quick, o->step, o->eye->sim.plan.until - o->scene->start);
    struct racer *r = add(o, name, steps ? NAN : o->tolerance, steps ? o->step : NAN, 1, NULL);
    racer_go(r, r->work + HALF, NULL, NULL);
}

static void choose(struct choice *o)
{
    open_usual(o);
    o->foretold = racer_hope(o->racer[0]);
    o->budget = SHARE * o->foretold;
    if (o->budget < LEAST) {
        take_usual(o, "too short a run for trials to pay");
        return;
    }
    const bool was_out = o->eye->out;
    o->eye->out = false;
    racer_go(o->eye, o->eye->work + fmin(MOST_LOOK, .2 * o->budget), look, &o->quick);
    o->eye->out |= was_out;
    if (was_out) o->looked = o->eye->work;
    if (o->any_fast) o->ncut = quick_cuts(o->cut, &o->quick, &o->eye->sim, o->life);
    add_all(o);
    run_race(o);
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
