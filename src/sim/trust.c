/* trust.c -- see trust.h */
#include "sim/trust.h"

#include <math.h>
#include <string.h>

#include "base/recall.h"
#include "base/scalar.h"
#include "engine/accel.h"
#include "engine/missed.h"
#include "engine/motion.h"
#include "engine/single.h"
#include "engine/tangent.h"
#include "sim/parts.h"

static const double SMALL = 1e-6; /* largest displacement of the state, in usual sizes of its coordinates */
static const double PEAKS = 1.2;  /* factor on propagated errors: few places may miss where columns answer most */
enum { DRAWS = 2 };               /* sets of random signs at a place */
enum { FEW_STEPS = 600 };         /* with fewer steps of fixed size, tangent_look() would cost too much of the run */

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

/* ---- on the way ------------------------------------------------------------------------------------------------ */

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
static bool follows(const struct sim *sim)
{
    const struct tangent *tangent = sim->stepper.tangent;
    return tangent && tangent->known && tangent->looks > 1;
}

/* The propagated error replaces the sums; false: it does not.  Forces that bend or jump may act only between two looks, which
 * tangent.c misses: there the larger counts. */
static bool follow(const struct sim *sim, struct trust_place *p)
{
    const struct tangent *tangent = sim->stepper.tangent;
    if (!follows(sim)) return false;
    const struct ode2 *ode = sim->stepper.ode;
    const bool unseen = ode->bends || ode->passed;
    p->position[0] = larger(PEAKS * tangent->position, unseen ? p->position[0] : 0);
    p->velocity[0] = larger(PEAKS * tangent->velocity, unseen ? p->velocity[0] : 0);
    return true;
}

/* The present state and its sums of local errors become the place p. */
static void keep(struct sim *sim, struct trust_place *p)
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
        keep(sim, &o->place[TRUST_PLACES + k]);
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
    keep(sim, &o->place[o->n++]);
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

/* ---- at the end ------------------------------------------------------------------------------------------------ */

/* Fastest velocity over the usual size of its coordinate [1/s]. */
static double pace_of(const struct trust_place *p, const struct ode2 *ode)
{
    double pace = 0;
    for (int i = 0; i < ode->n; i++) pace = fmax(pace, fabs(p->v[i]) / ode2_usual(ode, i));
    return pace;
}

/* Factor that reduces the errors of a place until columns change in proportion to them; 0: there are no errors. */
static double reduction(const struct trust_place *p, const struct ode2 *ode)
{
    double pace = pace_of(p, ode), most = 0;
    for (int i = 0; i < ode->n; i++) {
        most = fmax(most, p->position[i] / ode2_usual(ode, i));
        most = fmax(most, p->velocity[i] / ode2_usual(ode, i) / fmax(pace, 1e-3));
    }
    return most > 0 ? SMALL / most : 0;
}

/* The same for the delay there. */
static double reduction_later(const struct trust_place *p, const struct ode2 *ode)
{
    double pace = pace_of(p, ode), most = pace;
    for (int i = 0; i < ode->n; i++) most = fmax(most, fabs(p->a[i]) / ode2_usual(ode, i) / fmax(pace, 1e-3));
    return p->late * most > 0 ? SMALL / (p->late * most) : 0;
}

/* -1 or 1, pseudo-random (multiplicative hashing) but the same in every run. */
static double sign(int draw, int i)
{
    return ((unsigned)(i + 1) * 2654435761u + (unsigned)draw * 2246822519u) >> (draw + 13) & 1 ? -1 : 1;
}

/* Error of the sum of all energies [J]: the worst residual of the balance, what damping of the scheme has taken or
 * given, and the works, about whose errors nothing else is known. */
static double energy_off(const struct sim *sim)
{
    const struct ledger *l = &sim->ledger;
    return l->worst + l->gained + fabs(l->lost) + sim->trust.worked;
}

/* The change of one energy, limited to those of the others plus the error of the sum: random signs do not know that the
 * motion keeps the sum. */
static double held(double change, double others, double sum)
{
    const double most = fabs(others) + sum;
    return fmin(most, fmax(-most, change));
}

/* Energies of the displaced state, for columns that read them; by: part of the summed errors that it is displaced
 * by, 0 at the place itself.  Works stay those at the end of the run. */
static bool energies_at(struct sim *sim, double t, double by)
{
    struct energies e, *o = &sim->trust.there;
    struct ledger *l = &sim->ledger;
    if (!(sim->needs & NEED_ENERGY)) return true;
    if (system_energy_at(sim->system, &e, sim->x.q, sim->x.v, t, &sim->trouble) != OK) return false;
    if (by == 0) *o = e;
    const double kinetic = e.kinetic - o->kinetic, elastic = e.elastic - o->elastic, gravity = e.gravity - o->gravity;
    const double sum = by * energy_off(sim);
    l->kinetic = o->kinetic + held(kinetic, fabs(elastic) + fabs(gravity), sum);
    l->elastic = o->elastic + held(elastic, fabs(kinetic) + fabs(gravity), sum);
    l->gravity = o->gravity + held(gravity, fabs(kinetic) + fabs(elastic), sum);
    return true;
}

enum { LATER = -1 }; /* for a draw: along the motion */

/* Columns at the place displaced by the part `by` of its summed errors, with the signs of this draw, or as it is late.  false: they
 * cannot be evaluated there. */
static bool columns_at(struct sim *sim, const struct trust_place *p, double by, int draw)
{
    const struct ode2 *ode = sim->stepper.ode;
    struct trust *o = &sim->trust;
    for (int i = 0; i < ode->n; i++) {
        o->dq[i] = by * (draw == LATER ? p->late * p->v[i] : sign(draw, i) * p->position[i]);
        o->dv[i] = p->v[i] + by * (draw == LATER ? p->late * p->a[i] : sign(draw, i + ode->n) * p->velocity[i]);
    }
    sim->x = (struct state){p->t, sim->look->q, o->dv, sim->look->a};
    motion_point(ode, sim->x.q, p->q, o->dq, 1, p->t);
    return energies_at(sim, p->t, by) && record_fill(sim) == OK;
}

/* At a place apart forces are larger than on the way there.  What errors of positions have added up there is delay, which counts by
 * itself; across the motion they are at most those of the velocities by the pace at which forces change those: a/max v. */
static bool refine(struct sim *sim, struct trust_place *p)
{
    const struct effort effort = sim->stepper.effort;
    const bool known = accel_solve(sim->stepper.accel, p->a, NULL, p->q, p->v, p->t, &sim->trouble) == OK;
    sim->stepper.effort = effort;
    for (int i = 0; i < sim->stepper.ode->n && known && p->late > 0; i++)
        p->position[i] = fmin(p->position[i], p->velocity[i] * sim->trust.top[i] / fabs(p->a[i]));
    return known;
}

/* off[] := at least the root mean square of the columns' changes at this place. */
static void look_at(struct sim *sim, const struct trust_place *p)
{
    struct trust *o = &sim->trust;
    const double by = reduction(p, sim->stepper.ode);
    const size_t bytes = (size_t)sim->chosen.n * sizeof *o->sum;
    if (by == 0 || !columns_at(sim, p, 0, 0)) return;
    memcpy(o->base, sim->row, bytes);
    memset(o->sum, 0, bytes);
    for (int k = 0; k < DRAWS; k++) {
        if (!columns_at(sim, p, by, k)) return;
        for (int i = 0; i < sim->chosen.n; i++) o->sum[i] += pow((sim->row[i] - o->base[i]) / by, 2);
    }
    for (int i = 0; i < sim->chosen.n; i++) o->off[i] = fmax(o->off[i], sqrt(o->sum[i] / DRAWS));
    const double later = reduction_later(p, sim->stepper.ode);
    if (later == 0 || !columns_at(sim, p, later, LATER)) return;
    for (int i = 0; i < sim->chosen.n; i++) o->off[i] = fmax(o->off[i], fabs(sim->row[i] - o->base[i]) / later);
}

/* Least growth rate of small differences over the places [1/s]; 0: they do not grow everywhere; NAN: not looked at,
 * not to be told from round-off, or they may grow where forces act too briefly for any place to see: contacts, stops, backlash. */
static double growth_on_the_way(struct sim *sim, long chart, double run)
{
    enum { FEW = 3 };
    const struct trust *o = &sim->trust;
    const int places = growth_places(sim);
    double least = INFINITY;
    int seen = 0;
    const struct ode2 *ode = sim->stepper.ode;
    const bool brief = ode->passed || ode->bends || ode->nside > 0;
    if (ode->n < 2 && (!trust_of_time(sim) || follows(sim))) return 0; /* differences drift, at most, or are followed */
    for (int i = 0; i < o->n && places >= FEW && seen < places; i++) {
        const struct trust_place *p = &o->place[i];
        double blur;
        if (p->chart != chart) continue;
        const struct growth_place there = {p->t, pace_of(p, ode), p->q, p->v};
        const double grows = growth_at(sim, &there, &blur);
        if (!(grows > blur) && !(blur * run < TRUST_GROWN)) return NAN;
        least = fmin(least, grows > blur ? grows : 0);
        seen++;
    }
    return seen >= FEW && (!brief || least * run > TRUST_GROWN) ? least : NAN;
}

/* What a step leaves at s is at least 1 + growth (T - s) times larger at the end of the run T, in the mean of all steps
 * 1 + growth T/2 times: of an orbit an energy that drifts makes it late in proportion to time.  Where differences grow as
 * exp(growth t) it is more, but places that all grow do not show that they do. */
static void grow(struct sim *sim, long chart, double run)
{
    struct trust *o = &sim->trust;
    o->growth = growth_on_the_way(sim, chart, run);
    if (!(o->growth * run > TRUST_GROWN)) return;
    for (int i = 0; i < sim->chosen.n; i++) o->off[i] *= 1 + o->growth * run / 2;
}

void trust_find(struct sim *sim)
{
    struct trust *o = &sim->trust;
    const struct state end = sim->x;
    const struct ledger ledger = sim->ledger;
    const struct trouble trouble = sim->trouble;
    const long chart = system_charts(sim->system);
    o->column = o->still = o->farthest = -1;
    o->why = trust_why(sim);
    if (o->why || !o->asked) return;
    keep(sim, &o->place[o->n++]);
    for (int i = 0; i < o->n; i++)
        if (o->place[i].chart == chart) look_at(sim, &o->place[i]);
    for (int k = 0; k < TRUST_APART; k++) {
        struct trust_place *p = &o->place[TRUST_PLACES + k];
        if (o->most[k] > 0 && p->chart == chart && refine(sim, p)) look_at(sim, p);
    }
    grow(sim, chart, end.t - sim->scene->start);
    sim->x = end;
    sim->ledger = ledger;
    sim->trouble = trouble;
    trust_judge(sim);
}
