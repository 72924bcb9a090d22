/* elements.c -- all elements of a class; loads Q_F of (2-1), by the table of element kinds. */
#include <stdio.h>

#include "force/elements.h"

#include <math.h>
#include <string.h>

#include "base/inline.h"
#include "force/parts.h"

static void load_plain(const struct plain *p, double *r, double *w, struct effect *effect, const struct instant *x)
{
    double s = x->q[p->iq], v = x->v[p->iv], f = p->preload - p->k * (s - p->rest) - p->c * v;
    r[p->iv] -= f;
    if (w) w[POWER_DAMPER] -= p->c * v * v;
    if (effect) effect[p->force] = (struct effect){.force = f, .elongation = s, .power = f * v};
}

void measure_end(struct elements *e, const struct instant *x, int end, enum rate cls)
{
    const double *q = end ? x->qb : x->qa;
    e->ops->move(e->there, q, x->v, FAST);
    for (int i = first_of(e->nother, cls); i < last_of(e->nother, cls); i++) {
        struct part_of *p = &e->other[i];
        const struct model_force *f = &e->model->force[p->force];
        if (p->ends) p->end[end] = p->kind->end(e, e->there, f, q, x->v, p->strain[end]);
    }
}

void elements_press(struct elements *e, const struct contacts *contacts, const double *f)
{
    e->contacts = contacts;
    e->press = f;
    e->loads = e->model->nforce > 0 || f;
}

static void press(struct elements *e, struct sweep *s, double *r)
{
    const double *f = e->press;
    for (int i = 0; i < e->model->ncontact; f += contact_rows(&e->model->contact[i]), i++)
        contacts_push(e->contacts, s, r, i, f);
}

/* A call, so that scenes without forces save no registers. */
APART void load_all(struct elements *e, struct sweep *s, double *r, double *w, double *dk, struct effect *effect,
                    const struct instant *x, enum rate cls)
{
    if (e->press) press(e, s, r);
    for (int i = first_of(e->nplain, cls); i < last_of(e->nplain, cls); i++) load_plain(&e->plain[i], r, w, effect, x);
    if (x->qa && x->qb && e->ends[cls]) {
        measure_end(e, x, 0, cls);
        measure_end(e, x, 1, cls);
    }
    for (int i = first_of(e->nother, cls); i < last_of(e->nother, cls); i++) {
        struct part_of *p = &e->other[i];
        const struct loading to = {r, w, dk, effect ? &effect[p->force] : NULL};
        p->kind->load(e, s, p, &to, x);
    }
}

void elements_load(struct elements *e, struct sweep *s, double *r, double *w, double *dk, struct effect *effect,
                   const struct instant *x, enum rate cls)
{
    if (e->loads) load_all(e, s, r, w, dk, effect, x, cls);
}

double elements_stored(const struct elements *e, const struct sweep *s, const double *q, const double *v)
{
    double V = 0;
    for (int i = 0; i < e->nplain[ALL]; i++) {
        const struct plain *p = &e->plain[i];
        double d = q[p->iq] - p->rest;
        V += d * (.5 * p->k * d - p->preload);
    }
    for (int i = 0; i < e->nother[ALL]; i++) {
        const struct part_of *p = &e->other[i];
        if (p->stores) V += p->kind->stored(e, s, p, q, v);
    }
    return V;
}

void elements_measure(const struct elements *e, const struct sweep *s, double *value, double *rate, int measure,
                      const double *q, const double *v)
{
    struct action act;
    measure_at(&act, &e->measures, s, measure, q, v);
    *value = act.s;
    *rate = act.rate;
}

bool elements_follow(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].follows) return true;
    return e->measures.turns;
}

static void slots_recall(struct elements *e, struct recall *r)
{
    for (int i = 0; i < e->nother[ALL]; i++) {
        char name[24];
        snprintf(name, sizeof name, "slots%d", i);
        if (e->other[i].reads) recall_list(r, name, e->other[i].now, e->model->force[e->other[i].force].nslot);
    }
}

void elements_recall(struct elements *e, struct recall *r)
{
    recall_within(r, "elements");
    recall_each(r, "slope", e->other, kref, e->nother[ALL]);
    recall_each(r, "came", e->other, came, e->nother[ALL]);
    recall_each(r, "stood", e->other, stood, e->nother[ALL]);
    recall_each(r, "energy", e->other, V, e->nother[ALL]);
    slots_recall(e, r);
    recall_within(r, "measures");
    measures_recall(&e->measures, r);
    recall_without(r);
    recall_without(r);
}

void elements_set_measure(struct elements *e, int measure, double x)
{
    measures_set(&e->measures, measure, x);
}

static void follow(struct elements *e, const struct sweep *s, const struct instant *x, bool begins)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].follows) e->other[i].kind->follow(e, s, &e->other[i], x, begins);
}

void elements_begin(struct elements *e, const struct sweep *s, const struct instant *x)
{
    measures_begin(&e->measures, s);
    follow(e, s, x, true);
}

void elements_stepped(struct elements *e, const struct sweep *s, const struct instant *x)
{
    follow(e, s, x, false);
}

bool elements_turn(const struct elements *e)
{
    return e->measures.turns;
}

void elements_turned(struct elements *e, const struct sweep *s, double dt)
{
    if (e->measures.turns) measures_turned(&e->measures, s, dt);
}

void elements_look(struct elements *e, const struct sweep *view)
{
    measures_look(&e->measures, view);
}

bool elements_may_have_poles(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].poles) return true;
    return false;
}

int elements_pole(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].pole) return e->other[i].force;
    return -1;
}

int elements_pole_to(struct elements *e, const struct sweep *s, const struct instant *x)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].poles && e->other[i].kind->pole(e, s, &e->other[i], x)) return e->other[i].force;
    return -1;
}

void elements_no_pole(struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++) e->other[i].pole = false;
}

bool elements_may_bend(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].bends) return true;
    return false;
}

bool elements_may_be_steep(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (!e->other[i].linear) return true;
    return false;
}

bool elements_bent(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (law_bent(e, &e->other[i])) return true;
    return false;
}

/* Of an element that tells how far it is from where it pushes, its kind; else NULL. */
static const struct force_kind *clear_of(const struct elements *e, const struct part_of *p)
{
    const struct force_kind *kind = e->model->force[p->force].kind;
    return kind && kind->clear ? kind : NULL;
}

bool elements_may_be_passed(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++)
        if (clear_of(e, &e->other[i])) return true;
    return false;
}

static void find_clear(struct elements *e, struct sweep *s, const struct instant *x, int end)
{
    e->ops->move(s, x->q, x->v, ALL);
    for (int i = 0; i < e->nother[ALL]; i++) {
        struct part_of *p = &e->other[i];
        const struct model_force *f = &e->model->force[p->force];
        if (!clear_of(e, p)) continue;
        const double at = p->kind->place(&p->pace[end], e, s, f, x->q, x->v);
        p->open[end] = f->kind->clear(f->par, at);
        if (f->kind->whole) p->whole[end] = f->kind->whole(&p->at_once[end], f->par, at, p->pace[end]);
    }
}

/* At the start of a step, where the last one has ended. */
static void find_clear_start(struct elements *e, struct sweep *s, const struct instant *x)
{
    const size_t q = sizeof *x->q * (size_t)e->model->nq, v = sizeof *x->v * (size_t)e->model->n;
    if (!e->clear_known || memcmp(x->q, e->clear_q, q) != 0 || memcmp(x->v, e->clear_v, v) != 0) {
        find_clear(e, s, x, 0);
        return;
    }
    for (int i = 0; i < e->nother[ALL]; i++) {
        struct part_of *p = &e->other[i];
        p->open[0] = p->open[1];
        p->pace[0] = p->pace[1];
        p->whole[0] = p->whole[1];
        p->at_once[0] = p->at_once[1];
    }
}

static void find_clear_end(struct elements *e, struct sweep *s, const struct instant *x)
{
    find_clear(e, s, x, 1);
    if (!e->clear_q) return;
    memcpy(e->clear_q, x->q, sizeof *x->q * (size_t)e->model->nq);
    memcpy(e->clear_v, x->v, sizeof *x->v * (size_t)e->model->n);
    e->clear_known = true;
}

/* Of an element that is clear at both ends.  What comes near and goes again on an arc of half a radian, which is the most that is
 * looked at at once, is a little quicker between them. */
static enum met pass(const struct part_of *p, double h, double deep, bool looked)
{
    static const double QUICKER = 1.01;
    const bool turns = p->pace[0] * p->pace[1] < 0;
    const double way = (turns ? QUICKER : 1) * fmax(fabs(p->pace[0]), fabs(p->pace[1])) * fabs(h);
    if (looked && p->open[2] < -deep) return MET;
    return way > p->open[0] + p->open[1] + 2 * deep ? MET_MAYBE : MET_NOT;
}

enum met elements_passed(struct elements *e, struct sweep *s, const struct instant *a, const struct instant *between,
                         const struct instant *b, double deep)
{
    enum met most = MET_NOT;
    e->apart = b->t - a->t;
    find_clear_start(e, s, a);
    find_clear_end(e, s, b);
    if (between) find_clear(e, s, between, 2);
    for (int i = 0; i < e->nother[ALL]; i++) {
        const struct part_of *p = &e->other[i];
        if (!clear_of(e, p) || !(p->open[0] > 0 && p->open[1] > 0)) continue;
        const enum met one = pass(p, b->t - a->t, deep, between != NULL);
        if (one > most) most = one;
    }
    return most;
}

/* Where what goes evenly from a to b is 0. */
static double nought(double a, double b)
{
    return a / (a - b);
}

/* The part of the way h at which one that opens at 0 and is closed at 1 touches: by the pace at the end that is nearer. */
static double touch_of(const struct part_of *p, double h)
{
    const double *open = p->open, even = nought(open[0], open[1]);
    const double x = open[0] < -open[1] ? -open[0] / (p->pace[0] * h) : 1 - open[1] / (p->pace[1] * h);
    return x >= 0 && x <= 1 ? x : even;
}

/* One whose push is there at once; as edge_of().  Of one that is open at both ends the pace at the start tells whether it has
 * touched. */
static double jump_of(enum edge_kind *edge, const struct part_of *p, double h)
{
    if (p->open[1] > 0) {
        const double x = -p->open[0] / (p->pace[0] * h);
        *edge = x > 0 && x < .5 ? EDGE_PULSE : EDGE_NONE;
        return *edge ? x : NAN;
    }
    *edge = p->whole[1] > 0 && p->open[1] < 0 ? EDGE_JUMP : EDGE_PULSE;
    return touch_of(p, h);
}

/* Where the push has begun or ended on the way h between ends 0 and 1, *edge of what kind; NAN: neither.  What its damper has
 * let go before it opens pushes no more: it has ended there. */
static double edge_of(enum edge_kind *edge, const struct part_of *p, bool lets_go, double h)
{
    const double *open = p->open, *whole = p->whole;
    const bool touches[2] = {open[0] < 0, open[1] <= 0};
    const bool holds[2] = {!lets_go || whole[0] > 0, !lets_go || whole[1] > 0};
    const bool pushes[2] = {touches[0] && holds[0], touches[1] && holds[1]};
    if (lets_go && !touches[0] && p->at_once[0] > 0) return jump_of(edge, p, h);
    *edge = pushes[0] != pushes[1] ? EDGE_BEND : EDGE_NONE;
    if (!*edge) return NAN;
    const double touch = touches[0] != touches[1] ? nought(open[0], open[1]) : NAN;
    const double hold = holds[0] != holds[1] ? nought(whole[0], whole[1]) : NAN;
    return pushes[1] ? fmax(touch, hold) : fmin(touch, hold);
}

double elements_edge(const struct elements *e, enum edge_kind *edge)
{
    double most = NAN;
    *edge = EDGE_NONE;
    for (int i = 0; i < e->nother[ALL]; i++) {
        const struct part_of *p = &e->other[i];
        const struct force_kind *kind = clear_of(e, p);
        enum edge_kind one = EDGE_NONE;
        const double x = kind && p->nside == 0 ? edge_of(&one, p, kind->whole, e->apart) : NAN;
        if (!isfinite(x) || one < *edge) continue;
        const bool first = one > *edge || (one == EDGE_BEND ? fabs(x - .5) < fabs(most - .5) : x < most);
        if (first) most = x;
        *edge = one;
    }
    return most;
}

int elements_sides(double *side, double *force, struct elements *e, struct sweep *s, const struct instant *x)
{
    int n = 0;
    if (side) e->ops->move(s, x->q, x->v, ALL);
    for (int i = 0; i < e->nother[ALL]; i++) {
        const struct part_of *p = &e->other[i];
        if (side && p->nside > 0) p->kind->sides(side + n, force + n, e, s, p, x);
        n += p->nside;
    }
    return n;
}

static void read_all(struct elements *e, struct sweep *s, const struct instant *x)
{
    e->ops->move(s, x->q, x->v, ALL);
    for (int i = 0; i < e->nother[ALL]; i++)
        if (e->other[i].reads) value_read(e, s, &e->other[i], x);
}

void elements_leap(struct leap *o, struct elements *e, struct sweep *s, const struct instant *a,
                   const struct instant *b)
{
    *o = (struct leap){.force = -1};
    read_all(e, s, a);
    read_all(e, s, b);
    for (int i = 0; i < e->nother[ALL]; i++) {
        const struct part_of *p = &e->other[i];
        const struct model_force *f = &e->model->force[p->force];
        struct leap x = {.force = p->force};
        for (int k = 0; k < 3 && p->reads; k++)
            if (signal_pole(&f->value[k], p->last, p->now, f->nslot))
                *o = (struct leap){.force = p->force, .behind = INFINITY};
            else if (signal_leap(&f->value[k], &x.before, &x.behind, p->last, p->now, f->nslot) &&
                     fabs(x.behind - x.before) > fabs(o->behind - o->before))
                *o = x;
    }
}
