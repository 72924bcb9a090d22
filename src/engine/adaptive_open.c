/* adaptive_open.c -- what a scheme that chooses its steps remembers; see adaptive.h */
#include "engine/adaptive.h"
#include "engine/passing.h"
#include "engine/relay.h"
#include "engine/sides.h"
#include "engine/works.h"

void adaptive_open_by(struct stepper *s, const struct adaptive_scheme *scheme, struct arena *life)
{
    const struct ode2 *o = s->ode;
    struct adaptive *m = TAKE(life, struct adaptive, 1);
    m->scheme = scheme;
    m->tolerance = s->options.tolerance;
    rk_open(&m->rk, scheme->stages, o, s->accel, life);
    m->q = TAKE(life, double, o->nq);
    m->q0 = TAKE(life, double, o->nq);
    m->q1 = TAKE(life, double, o->nq);
    m->v = TAKE(life, double, o->n);
    m->v0 = TAKE(life, double, o->n);
    m->v1 = TAKE(life, double, o->n);
    m->a = TAKE(life, double, o->n);
    m->a0 = TAKE(life, double, o->n);
    m->u = TAKE(life, double, o->n);
    m->dx = TAKE(life, double, o->n);
    m->top = TAKE(life, double, o->n);
    m->span = TAKE(life, double, o->n);
    works_open(&m->works, o->n, life);
    m->sides = sides_open(o, life);
    m->passing = passing_open(o, life);
    s->self = m;
}

void adaptive_open(struct stepper *s, struct arena *life)
{
    const struct adaptive_scheme *scheme = s->kind->formulas;
    adaptive_open_by(s, scheme, life);
    scheme->open(s, s->self, life);
}

struct adaptive *adaptive_of(const struct stepper *s)
{
    return s->self;
}

enum status adaptive_recall(struct stepper *s, struct recall *r)
{
    struct adaptive *m = s->self;
    recall_one(r, "pace", m->pace);
    recall_list(r, "top", m->top, s->ode->n);
    recall_list(r, "span", m->span, s->ode->n);
    recall_one(r, "h", m->h);
    recall_one(r, "held", m->held);
    recall_one(r, "short", m->nshort);
    recall_one(r, "error", m->old);
    recall_one(r, "turned", m->works.turned);
    recall_one(r, "energy", m->works.energy);
    recall_one(r, "asked", m->works.asked);
    recall_one(r, "asked_until", m->works.until);
    recall_one(r, "elapsed", m->elapsed);
    recall_one(r, "known", m->known);
    if (m->relay) TRY(relay_recall(s, m, r));
    if (m->known) {
        recall_list(r, "a", m->a, s->ode->n);
        recall_list(r, "power", m->rk.w[0], POWER_CHANNELS);
    }
    return m->scheme->recall ? m->scheme->recall(s, m, r) : OK;
}

const struct key adaptive_keys[] = {KEY_TOLERANCE, KEYS_END};
