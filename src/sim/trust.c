/* trust.c -- what a run gathers on its way for the estimate of its error; see trust.h */
#include "sim/trust.h"

#include <math.h>

#include "base/recall.h"
#include "base/scalar.h"
#include "engine/missed.h"
#include "engine/motion.h"
#include "engine/tangent.h"
#include "sim/parts.h"

static const double PEAKS = 1.2; /* factor on propagated errors: few places may miss where columns answer most */
enum { FEW_STEPS = 600 };        /* with fewer steps of fixed size, tangent_look() would cost too much of the run */

void trust_follow(struct sim *sim, struct arena *life)
{
    struct stepper *s = &sim->stepper;
    const double steps = sim->majors * (double)sim->plan.ratio;
    if (!s->kind->adaptive && steps < FEW_STEPS) return;
    if (s->ode->n != 1 || s->touch || sim->options.counting || sim->scene->ndrive > 0) return;
    if (s->kind->late || s->kind->adaptive) tangent_open(s, trust_of_time(sim), life);
    s->natural = s->natural || (s->tangent && s->kind->adaptive);
}

void trust_open(struct sim *sim, struct arena *life)
{
    const struct ode2 *ode = sim->stepper.ode;
    struct trust *o = &sim->trust;
    const int columns = sim->chosen.n;
    double **of_columns[] = {&o->low, &o->high, &o->mean, &o->spread, &o->base, &o->sum, &o->off};
    for (size_t i = 0; i < sizeof of_columns / sizeof *of_columns; i++) *of_columns[i] = TAKE(life, double, columns);
    o->dq = TAKE(life, double, ode->n);
    o->dv = TAKE(life, double, ode->n);
    o->top = TAKE(life, double, ode->n);
    o->every = 1;
    o->compared = TAKE(life, bool, columns);
    for (int i = 0; i < columns; i++) o->asked |= o->compared[i] = sim_column_compared(sim, i);
    for (int i = 0; i < TRUST_PLACES + TRUST_APART; i++) {
        struct trust_place *p = &o->place[i];
        double **vector[] = {&p->v, &p->position, &p->velocity, &p->a};
        p->q = TAKE(life, double, ode->nq);
        for (int k = 0; k < 4; k++) *vector[k] = TAKE(life, double, ode->n);
    }
}

/* Drops every other place, so that those left stay evenly spaced. */
static void thin(struct trust *o)
{
    for (int i = 0; 2 * i + 1 < o->n; i++) {
        const struct trust_place odd = o->place[2 * i + 1];
        o->place[2 * i + 1] = o->place[i];
        o->place[i] = odd;
    }
    o->n /= 2;
    o->every *= 2;
}

/* Sum of |work| over all channels [J]. */
static double works(const struct ledger *l)
{
    double sum = 0;
    for (int c = 0; c < LEDGER_CHANNELS; c++) sum += fabs(l->work[c]);
    return sum;
}

/* Are errors propagated, and have they been? */
bool trust_follows(const struct sim *sim)
{
    const struct tangent *tangent = sim->stepper.tangent;
    return tangent && tangent->known && tangent->looks > 1;
}

/* The propagated error replaces the sums; false: it does not.  Forces that bend or jump may act only between two looks, which
 * tangent.c misses: there the larger counts. */
static bool follow(const struct sim *sim, struct trust_place *p)
{
    const struct tangent *tangent = sim->stepper.tangent;
    if (!trust_follows(sim)) return false;
    const struct ode2 *ode = sim->stepper.ode;
    const bool unseen = ode->bends || ode->passed;
    p->position[0] = larger(PEAKS * tangent->position, unseen ? p->position[0] : 0);
    p->velocity[0] = larger(PEAKS * tangent->velocity, unseen ? p->velocity[0] : 0);
    return true;
}

/* The present state and its sums of local errors become the place p. */
void trust_keep(struct sim *sim, struct trust_place *p)
{
    const struct ode2 *ode = sim->stepper.ode;
    const struct missed *missed = sim->stepper.missed;
    p->t = sim->x.t;
    p->chart = system_charts(sim->system);
    copy(p->q, sim->x.q, ode->nq);
    copy(p->v, sim->x.v, ode->n);
    copy(p->position, missed->position, ode->n);
    copy(p->velocity, missed->velocity, ode->n);
    copy(p->a, sim->x.a, ode->n);
    const bool lost =
        missed->late * missed->late * missed->steepest > missed->fastest; /* by more than a radian: round-off moves */
    p->late = follow(sim, p) || lost || trust_of_time(sim) ? 0 : missed->late;
}

/* The energy balance here goes to tangent.c; where energies are not looked at with every step, they are now. */
static void look_at_tangent(struct sim *sim)
{
    struct ledger there = sim->ledger;
    if (!sim->looks_at_once) {
        struct energies e;
        if (system_energy_at(sim->system, &e, sim->x.q, sim->x.v, sim->x.t, &sim->trouble) != OK) return;
        ledger_look(&there, sim->x.t, e.kinetic, e.elastic, e.gravity);
    }
    tangent_look(&sim->stepper, &sim->x, there.residual - there.lost, works(&there) > 0);
}

void trust_step(struct sim *sim)
{
    if (sim->stepper.tangent && tangent_due(&sim->stepper, &sim->x)) look_at_tangent(sim);
}

/* The largest acceleration, in usual sizes; where records are interpolated, at the end of the step.  Velocities are noted. */
static double steepness(struct sim *sim)
{
    const struct ode2 *ode = sim->stepper.ode;
    double most = 0;
    for (int i = 0; i < ode->n; i++) {
        most = larger(most, fabs(sim->x.a[i]) / ode2_usual(ode, i));
        sim->trust.top[i] = larger(sim->trust.top[i], fabs(sim->x.v[i]));
    }
    return most;
}

/* How many standard deviations of all its values so far a column is from their mean, of any column the most: of a force that pushes
 * for a k-th part of the time it is about the root of k. */
static double rareness(struct sim *sim)
{
    struct trust *o = &sim->trust;
    const double n = (double)o->seen + 1, part = 1 / n;
    double most = 0;
    for (int i = 0; i < sim->chosen.n; i++) {
        const double before = sim->row[i] - o->mean[i], off = (1 - part) * before;
        o->mean[i] += part * before;
        o->spread[i] += before * off;
        if (n * off * off > most * o->spread[i] && o->compared[i]) most = n * off * off / o->spread[i];
    }
    return sqrt(most);
}

/* Forces that push but briefly may do so at none of the evenly spaced places.  Where what is rare is written, and where
 * accelerations are large, they do; the more so the larger errors are by then. */
static void note_apart(struct sim *sim)
{
    static const double MORE = 1.1; /* for less another place is not worth its copies */
    struct trust *o = &sim->trust;
    const struct ode2 *ode = sim->stepper.ode;
    if (!ode->bends && !ode->passed) return;
    const double late = sim->stepper.missed->late;
    const double most[TRUST_APART] = {steepness(sim) * late, rareness(sim) * late};
    for (int k = 0; k < TRUST_APART; k++) {
        if (!(most[k] > MORE * o->most[k])) continue;
        o->most[k] = most[k];
        trust_keep(sim, &o->place[TRUST_PLACES + k]);
    }
}

/* The last of the places is kept free for the end of the run. */
void trust_note(struct sim *sim)
{
    struct trust *o = &sim->trust;
    if (!o->asked) return;
    o->worked = larger(o->worked, works(&sim->ledger));
    if (o->seen == 0) {
        copy(o->low, sim->row, sim->chosen.n);
        copy(o->high, sim->row, sim->chosen.n);
    }
    for (int i = 0; i < sim->chosen.n; i++) {
        const double x = sim->row[i];
        o->low[i] = x < o->low[i] ? x : o->low[i];
        o->high[i] = x > o->high[i] ? x : o->high[i];
    }
    note_apart(sim);
    if (++o->seen % o->every != 0) return;
    if (o->n == TRUST_PLACES - 1) thin(o);
    trust_keep(sim, &o->place[o->n++]);
}

void trust_recall(struct sim *sim, struct recall *r)
{
    static const char *const name[] = {"first", "second", "third", "fourth", "fifth", "sixth", "steepest", "rarest"};
    struct trust *o = &sim->trust;
    recall_within(r, "trust");
    recall_list(r, "low", o->low, sim->chosen.n);
    recall_list(r, "high", o->high, sim->chosen.n);
    recall_one(r, "worked", o->worked);
    recall_one(r, "n", o->n);
    recall_one(r, "every", o->every);
    recall_one(r, "seen", o->seen);
    recall_list(r, "mean", o->mean, sim->chosen.n);
    recall_list(r, "spread", o->spread, sim->chosen.n);
    recall_list(r, "most", o->most, TRUST_APART);
    recall_list(r, "top", o->top, sim->stepper.ode->n);
    for (int i = 0; i < TRUST_PLACES + TRUST_APART; i++) {
        struct trust_place *p = &o->place[i];
        recall_within(r, name[i]);
        recall_one(r, "t", p->t);
        recall_one(r, "chart", p->chart);
        recall_list(r, "q", p->q, sim->stepper.ode->nq);
        recall_list(r, "v", p->v, sim->stepper.ode->n);
        recall_list(r, "position", p->position, sim->stepper.ode->n);
        recall_list(r, "velocity", p->velocity, sim->stepper.ode->n);
        recall_list(r, "a", p->a, sim->stepper.ode->n);
        recall_one(r, "late", p->late);
        recall_without(r);
    }
    recall_without(r);
}
