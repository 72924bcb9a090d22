/* relay.c -- see relay.h */
#include "engine/relay.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/embedded.h"

enum { FIFTH, EIGHTH, IMPLICIT };
enum { ALONE, ON_TRIAL, AGAIN };
extern const struct stepper_kind step_dopri5, step_dop853, step_radau9;

/* What is usual of them: the length of a step beside the others', steps of a trial, what it takes, and what the rest of the run has
 * to take for it to pay [evaluations]. */
static const struct usual {
    const struct stepper_kind *kind;
    double step;
    int tried;
    double trial, rest;
} usual[RUNNERS] = {{&step_dopri5, 1, 3, 20, 100}, {&step_dop853, 2.2, 2, 26, 100}, {&step_radau9, 2, 2, 50, 1200}};
static const double STIFF[] = {.5, 1}; /* [rad] from which the implicit one may be better */
static const double
    FADES = .8,
    OFTEN = .15,
    GROWS =
        1.5; /* what a step before counts; a share of steps that end where they have to; a step that has not settled */
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

/* The implicit one where the price of its matrices is known, order 5 where it looks back at records. */
static bool takes_part(const struct step_options *o, int i)
{
    if (i == IMPLICIT) return o->matrix > 0;
    return i == EIGHTH || o->tolerance >= scheme_of(i)->between_from;
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
    static const double BETTER = .05, LEAST = 1.5, CLEARER = 4, CLEAREST = 1, NEW = .6;
    struct relay *o = m->relay;
    struct runner *c = &o->of[k], *d = &o->of[other];
    const double now = larger(-CLEAREST, smaller(CLEAREST, seen));
    const double lead = c->known ? NEW * now + (1 - NEW) * o->lead[k][other] : now;
    o->lead[k][other] = lead;
    o->lead[other][k] = -lead;
    c->known = true;
    o->phase = ALONE;
    if (lead > BETTER) {
        if (o->now == other) let_run(m, k, m->h * c->beside, 0, 0);
        d->beside = 1 / c->beside;
        d->apart = SOON * usual[other].trial;
        d->due = o->work + d->apart;
        return;
    }
    c->due = o->work + c->apart;
    c->apart *= LEAST + CLEARER * fabs(lead);
    if (o->now == k) let_run(m, other, o->h_before, o->gained_before, o->spent_before);
}

/* What the rest of the run has to take for a trial of k to pay; INFINITY: it is none. */
static double worth(const struct relay *o, int k, double gain)
{
    enum { LEAST = 100, SURE = 4 };
    if (!o->of[k].there || k == o->now || o->work < o->of[k].due) return INFINITY;
    if (k == FIFTH && o->now == IMPLICIT) return INFINITY; /* order 8 comes first */
    if (k != IMPLICIT) return gain > 0 && o->of[o->now].reach > SURE * gain ? INFINITY : usual[k].rest;
    const double by = o->stiff / STIFF[o->now];
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
        let_run(m, k, m->h * beside, 0, 0);
        return;
    }
}

/* A first step that was too short by far does not count, as its length was a guess. */
static void go_on_trying(struct adaptive *m)
{
    static const double HOPELESS = .5, CLEAR = 1.5, FAR = 2;
    enum { MOST = 3 };
    struct relay *o = m->relay;
    const int k = o->now;
    struct runner *c = &o->of[k];
    const double next = o->cut ? o->last : sqrt(o->last * m->h);
    c->reach = (o->gained + next) / (o->spent + o->took);
    if (o->tried++ > 0 || o->cut || m->h < FAR * o->last) {
        o->gained += o->last;
        o->spent += o->took;
    }
    const double by = c->reach / o->of[o->other].reach;
    const bool clear = by < 1 / CLEAR || by > CLEAR;
    if (by > HOPELESS && o->tried < usual[k].tried) return;
    if (!clear && o->tried < MOST) return;
    if (by > HOPELESS && !o->cut && o->cuts > OFTEN && o->tried < 2 * MOST) return;
    c->beside = m->h / o->h_before;
    if (clear) {
        decide(m, k, o->other, log(by));
        return;
    }
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
    const double before = c->reach;
    c->reach = o->gained / o->spent;
    decide(m, o->other, o->now, log(o->of[o->other].reach / sqrt(before * c->reach)));
}

void relay_next(struct stepper *s, struct adaptive *m, double t)
{
    struct relay *o = m->relay;
    o->mark = spent(s);
    if (!(o->last > 0 && o->took > 0)) return;
    if (o->phase == ON_TRIAL)
        go_on_trying(m);
    else if (o->phase == AGAIN)
        compare(m);
    else
        run_on(m, s->options.until - t, s->options.gain);
    o->last = 0;
}

void relay_failed(struct stepper *s, struct adaptive *m)
{
    struct relay *o = m->relay;
    if (o->phase != ON_TRIAL || spent(s) - o->mark < usual[o->now].trial) return;
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
    const double now = quickest(s, m);
    o->stiff = smaller(now, o->quick); /* one alone may be by chance */
    o->quick = now;
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
    recall_one(r, "stiff", o->stiff);
    recall_one(r, "quick", o->quick);
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
