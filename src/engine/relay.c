/* relay.c -- see relay.h */
#include "engine/relay.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/embedded.h"

enum { FIFTH, EIGHTH, IMPLICIT };
enum { ALONE, ON_TRIAL, AGAIN };
extern const struct stepper_kind step_dopri5, step_dop853, step_radau9;

/* What is usual of them: the length of a step beside the others', steps of a trial, what it takes, the least that a step takes, and
 * what the rest of the run has to take for a trial to pay [evaluations]. */
static const struct usual {
    const struct stepper_kind *kind;
    double step;
    int tried;
    double trial, least, rest;
} usual[RUNNERS] = {
    {&step_dopri5, 1, 3, 20, 6, 100}, {&step_dop853, 2.2, 2, 26, 12, 100}, {&step_radau9, 2, 2, 50, 10, 1200}};
static const double STIFF[] = {.5, 1}; /* [rad] from which the implicit one may be better */
static const double
    FADES = .8,
    OFTEN = .15,
    GROWS =
        1.5; /* what a step before counts; a share of steps that end where they have to; a step that has not settled */
static const double HOPELESS = .5;         /* of the other's reach */
static const double BEGUN = 30, SOON = 25; /* evaluations before the first trial; trials that may go by between two */

static const struct adaptive_scheme *scheme_of(int i)
{
    return usual[i].kind->formulas;
}

static void hand_to(struct adaptive *m, int k)
{
    const struct runner *next = &m->relay->of[k];
    m->scheme = scheme_of(k);
    m->own = next->own;
    m->ahead = next->ahead;
    m->tolerance = next->tolerance;
    m->relay->now = k;
}

/* The implicit one where the price of its matrices is known, order 5 where it looks back at records; order 8 does not follow forces
 * that bend, if order 5 does. */
static bool takes_part(const struct step_options *o, int i)
{
    const bool fifth = o->tolerance >= scheme_of(FIFTH)->between_from;
    if (i == IMPLICIT) return o->matrix > 0;
    return i == FIFTH ? fifth : !(fifth && o->bends);
}

static void open(struct stepper *s, struct arena *life)
{
    adaptive_open_by(s, scheme_of(EIGHTH), life);
    struct adaptive *m = s->self;
    struct relay *o = m->relay = TAKE(life, struct relay, 1);
    for (int i = 0; i < RUNNERS; i++) {
        struct runner *c = &o->of[i];
        c->there = takes_part(&s->options, i);
        if (!c->there) continue;
        m->scheme = scheme_of(i);
        m->own = NULL;
        m->tolerance = s->options.tolerance;
        m->scheme->open(s, m, life);
        c->own = m->own;
        c->ahead = m->ahead;
        c->tolerance = m->tolerance;
        c->due = BEGUN;
        c->apart = SOON * usual[i].trial;
    }
    hand_to(m, s->options.gain > 0 && o->of[IMPLICIT].there ? IMPLICIT : o->of[FIFTH].there ? FIFTH : EIGHTH);
}

static double spent(const struct stepper *s)
{
    return (double)s->effort.slow + s->options.matrix * (double)s->effort.factors;
}

static double quickest(const struct stepper *s, const struct adaptive *m)
{
    const struct embedded_pair *p = (const struct embedded_pair *)m->scheme;
    const struct rk *k = &m->rk;
    const int last = p->table.stages - 1;
    double top = 0, bottom = 0;
    for (int i = 0; i < s->ode->n; i++) {
        double u = 0, v = 0;
        for (int j = 0; j < last; j++) {
            const double by = p->table.b[j] - p->table.a[last - 1][j];
            u += by * k->du[j][i];
            v += by * k->dv[j][i];
        }
        const double sq = adaptive_scale_q(s, i), sv = adaptive_scale_v(s, i);
        top += pow((k->du[last][i] - k->du[last - 1][i]) / sq, 2) + pow((k->dv[last][i] - k->dv[last - 1][i]) / sv, 2);
        bottom += pow(u / sq, 2) + pow(v / sv, 2);
    }
    return bottom > 0 ? sqrt(top / bottom) : 0;
}

/* k takes the next step, of h, and has come so far by now for so much. */
static void let_run(struct adaptive *m, int k, double h, double gained, double spent)
{
    hand_to(m, k);
    m->h = h;
    m->old = 1e-4; /* as of a first step */
    m->relay->gained = gained;
    m->relay->spent = spent;
    if (m->scheme->forget) m->scheme->forget(m);
}

/* k was looked at beside `other`, and got further by the factor whose logarithm is seen. */
static void decide(struct adaptive *m, int k, int other, double seen)
{
    static const double BETTER = .05, LEAST = 1.5, CLEARER = 4, CLEAREST = 1, NEW = .6, AT_ODDS = 3;
    struct relay *o = m->relay;
    struct runner *c = &o->of[k], *d = &o->of[other];
    const double now = larger(-CLEAREST, smaller(CLEAREST, seen));
    const double lead = c->known ? NEW * now + (1 - NEW) * o->lead[k][other] : now;
    o->lead[k][other] = lead;
    o->lead[other][k] = -lead;
    c->known = true;
    if (k == IMPLICIT || other == IMPLICIT) o->of[IMPLICIT].stiff = o->stiff;
    o->phase = ALONE;
    if (lead > BETTER) {
        if (o->now == other) let_run(m, k, m->h * c->beside, 0, 0);
        d->beside = 1 / c->beside;
        d->apart = SOON * usual[other].trial;
        o->won = c->reach;
        d->due = o->work + d->apart;
        return;
    }
    if (k != IMPLICIT) o->won = 0;
    if (seen > BETTER) c->apart = AT_ODDS * usual[k].trial; /* with what was seen before */
    c->due = o->work + c->apart;
    c->apart *= LEAST + CLEARER * fabs(lead);
    if (o->now == k) let_run(m, other, o->h_before, o->gained_before, o->spent_before);
}

/* Radians of the quickest that were passed in each of the latest steps. */
static double steady(const struct relay *o)
{
    double least = o->quick[0];
    for (int i = 1; i < LATEST; i++) least = smaller(least, o->quick[i]);
    return least;
}

/* Is k to be looked at again?  Before its time where something stiffer has come up, and of explicit schemes the one that was taken
 * over from where the other has become slower since. */
static bool is_due(const struct relay *o, int k)
{
    static const double SLOWER = .7, SOONER = 7, STIFFER = 2;
    const struct runner *c = &o->of[k];
    if (!c->there || k == o->now) return false;
    if (k == IMPLICIT) return o->work >= c->due || steady(o) > STIFFER * larger(1, c->stiff);
    const bool slower =
        o->now != IMPLICIT && o->of[o->now].reach < SLOWER * o->won && c->apart <= SOON * usual[k].trial;
    return o->work >= c->due - (slower ? (SOON - SOONER) * usual[k].trial : 0);
}

/* What the rest of the run has to take for a trial of k to pay; INFINITY: it is none. */
static double worth(const struct relay *o, int k, double gain)
{
    enum { LEAST = 100, SURE = 4 };
    static const double CLOSE = .3, MOSTLY = .6;
    if (!is_due(o, k)) return INFINITY;
    if (k == FIFTH && o->now == IMPLICIT && o->of[EIGHTH].there) return INFINITY; /* order 8 comes first */
    if (k != IMPLICIT) return gain > 0 && o->of[o->now].reach > SURE * gain ? INFINITY : usual[k].rest;
    if (o->cuts > MOSTLY) return LEAST; /* steps are as long by any scheme: there is little to lose */
    const bool close = o->of[k].known && o->lead[k][o->now] > -CLOSE;
    const double by = larger(close, o->stiff / STIFF[o->now]);
    return by < 1 ? INFINITY : larger(LEAST, usual[k].rest / by / by);
}

static void run_on(struct adaptive *m, double left, double gain)
{
    enum { FEW = 3 };
    struct relay *o = m->relay;
    struct runner *c = &o->of[o->now];
    o->gained = FADES * o->gained + o->last;
    o->spent = FADES * o->spent + o->took;
    c->reach = o->gained / o->spent;
    if (c->steps < FEW || (o->cut ? false : o->cuts > OFTEN || m->h > GROWS * o->last)) return;
    const double rest = left / larger(c->reach, o->cut ? 0 : m->h / o->took);
    for (int k = RUNNERS - 1; k >= 0; k--) {
        if (rest < worth(o, k, gain)) continue;
        const double beside = o->of[k].beside > 0 ? o->of[k].beside : usual[k].step / usual[o->now].step;
        o->phase = ON_TRIAL;
        o->other = o->now;
        o->tried = 0;
        o->h_before = m->h;
        o->gained_before = o->gained;
        o->spent_before = o->spent;
        o->rest = rest;
        let_run(m, k, m->h * beside, 0, 0);
        return;
    }
}

/* May the phase go on, by what it loses against the other scheme, or gains, if that is so far as seen?  As the logarithm. */
static bool may_last(const struct relay *o, double seen)
{
    enum { LONGEST = 10 };
    static const double PART = .005; /* of the rest of the run */
    return o->tried < LONGEST && fabs(seen) * o->spent < PART * o->rest;
}

/* Of the trial, how far it gets for its work: of a first step, whose length was a guess, as far as the next one if that is more. */
static double reach_on_trial(const struct relay *o, double h)
{
    const double next = o->cut ? o->last : sqrt(o->last * h);
    const double reach = (o->gained + next) / (o->spent + o->took);
    return o->tried || o->cut ? reach : larger(reach, h / usual[o->now].least);
}

/* A first step that was too short by far does not count, nor one of the implicit one, which knows of no steps before; nor one that
 * ended where it had to, where that is rare. */
static bool counts_on_trial(const struct relay *o, double h)
{
    static const double FAR = 2;
    if (o->cut) return (o->cuts - (1 - FADES)) / FADES > OFTEN;
    return o->tried || (o->now != IMPLICIT && h < FAR * o->last);
}

static void go_on_trying(struct adaptive *m)
{
    static const double CLEAR = 1.5;
    enum { MOST = 3 };
    struct relay *o = m->relay;
    const int k = o->now;
    struct runner *c = &o->of[k];
    const bool counts = counts_on_trial(o, m->h);
    c->reach = reach_on_trial(o, m->h);
    o->tried++;
    if (o->cut && !counts && o->tried < 2 * MOST) return;
    if (counts) {
        o->gained += o->last;
        o->spent += o->took;
    }
    const double by = c->reach / o->of[o->other].reach;
    const bool clear = by < 1 / CLEAR || by > CLEAR;
    if (by > HOPELESS && o->tried < usual[k].tried) return;
    if (!clear && o->tried < MOST) return;
    if (by > HOPELESS && !o->cut && o->cuts > OFTEN && o->tried < 2 * MOST) return;
    if (by > HOPELESS && by < CLEAR && may_last(o, log(by))) return;
    c->beside = m->h / o->h_before;
    if (clear) {
        decide(m, k, o->other, log(by));
        return;
    }
    o->lasted = o->tried;
    let_run(m, o->other, o->h_before, 0, 0);
    o->phase = AGAIN;
    o->other = k;
    o->tried = 0;
}

static void compare(struct adaptive *m)
{
    enum { STEPS = 3 };
    struct relay *o = m->relay;
    struct runner *c = &o->of[o->now];
    o->gained += o->last;
    o->spent += o->took;
    if (++o->tried < STEPS || (!o->cut && o->cuts > OFTEN && o->tried < 2 * STEPS)) return;
    const double before = c->reach, reach = o->gained / o->spent;
    const double seen = log(o->of[o->other].reach / sqrt(before * reach));
    if (o->tried < o->lasted && may_last(o, seen)) return;
    c->reach = reach;
    decide(m, o->other, o->now, seen);
}

bool relay_next(struct stepper *s, struct adaptive *m, double t)
{
    struct relay *o = m->relay;
    const int before = o->now;
    o->mark = spent(s);
    if (!(o->work > 0) && o->now != IMPLICIT && s->options.first > 0) m->h = s->options.first * usual[o->now].step;
    if (!(o->last > 0 && o->took > 0)) return false;
    if (o->phase == ON_TRIAL)
        go_on_trying(m);
    else if (o->phase == AGAIN)
        compare(m);
    else
        run_on(m, s->options.until - t, s->options.gain);
    o->last = 0;
    return before == IMPLICIT && o->now != IMPLICIT;
}

void relay_failed(struct stepper *s, struct adaptive *m)
{
    struct relay *o = m->relay;
    if (o->phase != ON_TRIAL) return;
    const double took = spent(s) - o->mark, at_best = m->h / usual[o->now].least;
    if (took < usual[o->now].trial && (o->tried || at_best > HOPELESS * o->of[o->other].reach)) return;
    o->of[o->now].beside = m->h / o->h_before;
    o->work += spent(s) - o->mark;
    o->mark = spent(s);
    decide(m, o->now, o->other, log(.5));
}

void relay_took(struct stepper *s, struct adaptive *m, bool cut)
{
    struct relay *o = m->relay;
    o->last = fabs(m->came);
    o->cut = cut;
    o->took = spent(s) - o->mark;
    o->work += o->took;
    o->of[o->now].steps++;
    o->cuts = FADES * o->cuts + (1 - FADES) * o->cut;
    if (o->now == IMPLICIT) return;
    for (int i = LATEST - 1; i > 0; i--) o->quick[i] = o->quick[i - 1];
    o->quick[0] = quickest(s, m);
    o->stiff = smaller(o->quick[0], o->quick[1]); /* one alone may be by chance */
}

enum status relay_recall(struct stepper *s, struct adaptive *m, struct recall *r)
{
    struct relay *o = m->relay;
    recall_within(r, "relay");
    recall_one(r, "now", o->now);
    recall_one(r, "phase", o->phase);
    recall_one(r, "other", o->other);
    recall_one(r, "tried", o->tried);
    recall_one(r, "h_before", o->h_before);
    recall_one(r, "gained", o->gained);
    recall_one(r, "spent", o->spent);
    recall_one(r, "work", o->work);
    recall_one(r, "gained_before", o->gained_before);
    recall_one(r, "spent_before", o->spent_before);
    recall_one(r, "rest", o->rest);
    recall_one(r, "won", o->won);
    recall_one(r, "lasted", o->lasted);
    recall_one(r, "stiff", o->stiff);
    recall_list(r, "quick", o->quick, LATEST);
    recall_one(r, "cuts", o->cuts);
    recall_one(r, "last", o->last);
    recall_one(r, "took", o->took);
    recall_one(r, "cut", o->cut);
    recall_list(r, "lead", o->lead[0], RUNNERS * RUNNERS);
    recall_each(r, "reach", o->of, reach, RUNNERS);
    recall_each(r, "beside", o->of, beside, RUNNERS);
    recall_each(r, "due", o->of, due, RUNNERS);
    recall_each(r, "apart", o->of, apart, RUNNERS);
    recall_each(r, "known", o->of, known, RUNNERS);
    recall_each(r, "steps", o->of, steps, RUNNERS);
    const int now = o->now >= 0 && o->now < RUNNERS && o->of[o->now].there ? o->now : EIGHTH;
    enum status status = OK;
    for (int i = 0; i < RUNNERS && status == OK; i++) { /* adaptive_recall() asks who runs */
        if (i == now || !o->of[i].there || !scheme_of(i)->recall) continue;
        hand_to(m, i);
        recall_within(r, usual[i].kind->name);
        status = m->scheme->recall(s, m, r);
        recall_without(r);
    }
    recall_without(r);
    hand_to(m, now);
    return status;
}

bool relay_has(const struct stepper_kind *kind)
{
    for (int i = 0; i < RUNNERS; i++)
        if (kind == usual[i].kind) return true;
    return false;
}

const char *relay_name(const struct step_options *options, int i)
{
    return takes_part(options, i) ? usual[i].kind->name : NULL;
}

long relay_steps(const struct stepper *s, int i)
{
    return adaptive_of(s)->relay->of[i].steps;
}

const struct stepper_kind step_relay = {
    .name = "auto",
    .brief = "dopri5, dop853 and radau9, by turns",
    .order = 5,
    .full = true,
    .keys = adaptive_keys,
    .adaptive = 1,
    .open = open,
    .step = adaptive_step,
    .recall = adaptive_recall,
};
