/* trust_find.c -- at the end of a run, what its errors make of the columns; see trust.h */
#include <math.h>
#include <string.h>

#include "engine/accel.h"
#include "engine/motion.h"
#include "engine/single.h"
#include "sim/parts.h"

static const double SMALL = 1e-6; /* largest displacement of the state, in usual sizes of its coordinates */
enum { DRAWS = 2 };               /* sets of random signs at a place */

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
    if (ode->n < 2 && (!trust_of_time(sim) || trust_follows(sim)))
        return 0; /* differences drift, at most, or are followed */
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
    trust_keep(sim, &o->place[o->n++]);
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
