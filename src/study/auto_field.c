/* auto_field.c -- who takes part in the race of auto.h */
#include <math.h>
#include <string.h>

#include "model/model.h"
#include "multirate/schemes.h"
#include "study/auto_parts.h"
#include "study/fourth.h"
#include "study/reference.h"
#include "system/system.h"

static const char OF_TWO_RATES[] = "subcycle";
static const double LOOSE = 3e-3; /* a tolerance to which the midpoint rule may be the least */
static const int ratios[] = {200, 100, 50, 20, 10, 5, 2};
static const char *const explicit_ones[] = {"dopri5", "dop853"}, *const full_ones[] = {"radau9", "radau5"};

const struct node *auto_named(const struct scene *scene, const char *key)
{
    const struct node *n = node_find(scene->integrate.node, key);
    return n && !n->implied ? n : NULL;
}

/* An explicit scheme takes steps of at most so many radians of the quickest small motion, excited or not: as
 * measured on flexible decks, where the error estimate ends what stability would (on the imaginary axis). */
static const struct bound {
    const char *name;
    double radians, evaluations; /* a step */
} bounds[] = {{"dopri5", 1.1, 6}, {"dop853", 4, 11}};

static const struct bound *bound_of(const struct stepper_kind *kind)
{
    for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++)
        if (strcmp(kind->name, bounds[i].name) == 0) return &bounds[i];
    return NULL;
}

double auto_least(const struct stepper_kind *kind, double stiff)
{
    const struct bound *o = bound_of(kind);
    return o ? stiff / o->radians * o->evaluations : 0;
}

bool auto_bounded(const struct racer *r, double stiff)
{
    const struct bound *o = bound_of(r->setting.kind);
    const double share = (r->sim.x.t - r->t_last) / (r->sim.plan.until - r->scene.start);
    return o && share * stiff > o->radians;
}

/* The shorter the steps of order 5 are beside the motion, the more order 8 gains: as the fifth root of how many there are, beyond
 * where both are even.  A motion that changes its pace, as a mechanism of one freedom does near its dead centres, has steps
 * that change with it, which order 8 follows less well, but at a tight tolerance; what has corners it does not follow at all.
 * Measured on 180 scenes (shipped, of other programs, drawn at random) at 1e-3, 1e-4 and 1e-6: of those above 100 evaluations 17
 * in 20 go by this within 1.05 of the better one. */
static double even_work(const struct choice *o)
{
    enum { EVEN = 150, UNEVEN = 2000 }; /* evaluations of dopri5 */
    static const double AT = 1e-4;
    const struct sim *sim = &o->eye->sim;
    if (system_may_bend(sim->system)) return INFINITY;
    if (o->eye->price.rows == 0 || sim->stepper.ode->n > 1) return EVEN;
    return fmax(EVEN, UNEVEN * fmin(1, cbrt(o->tolerance / AT)));
}

double auto_higher_order(const struct choice *o, double work)
{
    return work * pow(even_work(o) / work, .2);
}

/* A first step, so that little goes into finding it. */
static struct guess guess_for(const struct choice *o, const struct racer *r, const struct quick_cut *cut)
{
    if (!o->eye || !isfinite(r->setting.tolerance)) return r->sim.stepper.guess;
    const double span = o->eye->sim.plan.until - o->scene->start;
    const double h = quick_step(&o->quick, &o->eye->sim, r->setting.tolerance, span);
    if (r->setting.kind->order > 2) return (struct guess){.5 * r->setting.kind->order * o->quick.h / 2.5, 1};
    const double apart = cut ? cut->apart : r->setting.kind->two_rates ? quick_apart(&o->quick, &o->eye->sim, NULL) : 1;
    return (struct guess){h, (int)fmax(1, fmin(100, apart))};
}

static struct racer *put_in(struct choice *o, const struct setting *setting, const struct quick_cut *cut)
{
    struct racer *r = TAKE(o->own, struct racer, 1);
    if (o->n >= MOST_RACERS) return NULL;
    r->nfast = cut ? cut->n : o->scene->nfast;
    r->fast = cut ? cut->fast : o->scene->fast;
    r->unit = o->n ? o->racer[0]->unit : 0;
    racer_open(r, setting, o->scene, o->diags, o->own);
    if (r->out || (o->n && setting->kind->full && o->racer[0]->sim.stepper.ode->n > MOST_DENSE)) return NULL;
    r->sim.stepper.guess = guess_for(o, r, cut);
    r->least = auto_least(setting->kind, o->stiff);
    return o->racer[o->n++] = r;
}

struct racer *auto_add(struct choice *o, const char *name, double tolerance, double step, int ratio,
                       const struct quick_cut *cut)
{
    const struct setting setting = {stepper_find(name), tolerance, step, ratio, 0};
    return put_in(o, &setting, cut);
}

struct racer *auto_add_sized(struct choice *o, const struct racer *r, double by)
{
    const struct quick_cut same = {.n = r->nfast, .fast = r->fast};
    const double every = o->scene->output.every, major = by * r->setting.step * r->setting.ratio;
    struct setting other = r->setting;
    other.step *= by;
    if (every > 0) other.step = every / ceil(every / major * (1 - 1e-9)) / other.ratio;
    return put_in(o, &other, &same);
}

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

/* Two rates of order 4, by fixed steps that records are ends of, so that the run is off by `tolerance`. */
static void add_fourth(struct choice *o, const struct quick_cut *cut, double most)
{
    enum { A_STEP = 10 }; /* evaluations */
    const double span = o->eye->sim.plan.until - o->scene->start;
    struct fourth known = {.span = span, .every = o->scene->output.every};
    struct setting setting;
    if (cut)
        memcpy(known.off, cut->fourth, sizeof known.off);
    else
        quick_apart(&o->quick, &o->eye->sim, known.off);
    if (!fourth_setting(&setting, &known, o->tolerance)) return;
    const double share = cut ? cut->share : (double)o->scene->nfast / o->eye->sim.stepper.ode->n;
    const double major = setting.step * setting.ratio;
    if (span / major * A_STEP * (setting.ratio * share + 1 - share) > most) return;
    put_in(o, &setting, cut);
}

/* Two rates, with these coordinates fast; NULL: the deck's. */
static void add_two_rates(struct choice *o, const struct quick_cut *cut)
{
    if (!isfinite(o->step)) {
        auto_add(o, OF_TWO_RATES, o->tolerance, NAN, 1, cut);
        return;
    }
    const bool capped = auto_named(o->scene, "ratio");
    const double cap = capped ? o->scene->integrate.ratio : INFINITY;
    const int most = cap < 8 ? (int)cap : ratio_for(o, cap);
    const int fit = ratio_for(o, fmin(cap, cut ? cut->apart : quick_apart(&o->quick, &o->eye->sim, NULL)));
    if (most > 1 && most != fit && capped) auto_add(o, OF_TWO_RATES, NAN, o->step, most, cut);
    if (fit > 1) auto_add(o, OF_TWO_RATES, NAN, o->step, fit, cut);
}

void auto_add_fourths(struct choice *o, double most)
{
    for (int i = 0; i < o->ncut; i++) add_fourth(o, &o->cut[i], most);
    if (!o->any_fast && o->scene->nfast) add_fourth(o, NULL, most);
}

/* All but those whose first step is dear. */
void auto_add_all(struct choice *o)
{
    const struct stepper_kind *given = stepper_find(o->scene->integrate.scheme);
    const bool steps = isfinite(o->step), rates = given && given == stepper_find(OF_TWO_RATES);
    const bool plain = o->tolerance > LOOSE || o->eye->sim.stepper.ode->n > MOST_DENSE;
    for (int i = 0; steps && o->any_scheme && i < 2; i++) auto_add(o, explicit_ones[i], o->tolerance, NAN, 1, NULL);
    if (o->any_scheme && !steps && plain) auto_add(o, "midpoint", o->tolerance, NAN, 1, NULL);
    if (!o->any_scheme && !rates) return;
    for (int i = 0; i < o->ncut; i++) add_two_rates(o, &o->cut[i]);
    if (!o->any_fast && o->scene->nfast) add_two_rates(o, NULL);
}

/* Schemes of full matrices, where a few factorizations are little beside what may be spent. */
void auto_add_full(struct choice *o, double most)
{
    enum { FACTORS = 3, EVALUATIONS = 30 };
    const struct price *p = &o->eye->price;
    const double first = FACTORS * p->full / o->eye->unit + EVALUATIONS;
    bool any = false;
    const int n = o->tolerance > LOOSE ? 2 : 1; /* the second where accuracy is not asked for */
    if (o->racer[0]->setting.kind->full) return;
    for (int i = 0; o->any_scheme && i < n && (i + 1) * first < most; i++)
        any |= auto_add(o, full_ones[i], o->tolerance, NAN, 1, NULL) != NULL;
    for (int i = 0; any && o->quiet && i < o->n; i++) /* what is stiff may still begin to move */
        o->racer[i]->out |= o->racer[i]->setting.kind->order == 2 && !o->racer[i]->setting.kind->two_rates;
}
