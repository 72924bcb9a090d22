/* newton.c -- see newton.h */
#include "engine/newton.h"

#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"

/* What other values of these constants change: evaluations in the mean of the twelve decks of renewal.h, in percent.
 *
 *     AT_ONCE         a third +2.0, three times -2.9, where 2.8 times as much is left over
 *     POWERED         a third +1.2, three times -0.3, where the energy residual grows by 6 percent
 *     ONE_WAY         a half +0.1, five times -0.2, where the balance of decks/driven-telescope.yaml drifts three times as far
 *     BY_ENERGY       a third 0, three times +0.1, where 1e3 times as much is left over
 *     AT_REST         a tenth +0.1, ten times 0
 *     FAR             a tenth 0, ten times +0.1
 *     SLUGGISH        half -0.1, twice 0
 *     ENERGY_LIFE     half +0.9, twice -0.2
 *     ROUGH, MOST_REFRESHED, PRICE (all shipped owners know theirs): nothing
 *
 * and of pairs, in evaluations of eight decks of sub-cycling at ratios 5 to 20:
 *
 *     UNSEEN          a third +3, three times -3, where the drift of tests/unit/t-economy.c at h = 1e-3 is half as much again
 *     three times the energy that may be left: -6, where that at h = 1e-2 is a fifth more
 *
 * Round-off stop: no further decrease while tiny, relative, in SI units or in the norm of energy, as what flies fast rounds
 * what is slow in it (a satellite's hinge at 3.7 km/s: corrections do not fall below 1e-12 rad/s); with a matrix of this very
 * iterate (so that a bad matrix is excluded as the cause) somewhat larger corrections count as tiny. */
static const double TINY = 1e-12, TINY_SI = 1e-14, TINY_FRESH = 1e-7, TINY_FRESH_SI = 1e-10;
static const double TINY_NORM = 4 * DBL_EPSILON;
static const double ROUND_OFF = 1e-14; /* tolerance of a step that must be exact */
static const double ROUGH = 1e-9;      /* corrections above show what a matrix is worth */
static const double AT_ONCE = .03; /* of the tolerance, after one iteration: its contraction is assumed, not measured */
static const double POWERED = 1e2; /* tolerances the last correction may have where power is integrated, */
static const double ONE_WAY = 20;  /* and where what it leaves has the sign that it had in the steps before */
static const double AT_REST = 1e-7;   /* scale of a coordinate, at least, of the largest scale */
static const double BY_ENERGY = 1e-2; /* of the tolerance, where the energy norm decides */
static const double UNSEEN = .01;     /* of pairs: of what they may leave, after one iteration */
static const double LIGHT = 1e3;      /* tolerances that a coordinate may be left by where the norm of energy decides */
static const double FAR = 1e4;        /* times the energy that is known: too far to look at it anew */
static const double SLIGHT = 10;      /* and where energy decides beside its own tolerance */
static const double HEARSAY = 3e-4;   /* contraction that is believed at most before a step has shown it */
static const double SLUGGISH = .3;    /* contraction that asks for a new matrix */
static const double PRICE = 2;        /* of one, in evaluations, where its owner does not know */
enum { LIMIT = 30, ENERGY_LIFE = 32, MOST_REFRESHED = 4 };

void newton_open(struct newton *nt, const struct ode2 *ode, struct effort *effort, const struct step_options *options,
                 struct arena *life)
{
    int n = ode->n;
    *nt =
        (struct newton){.ode = ode, .effort = effort, .tolerance = options->newton_tolerance, .stage = options->stage};
    nt->limit = LIMIT;
    nt->price = ode->price > 0 ? ode->price : PRICE;
    nt->scale = TAKE(life, double, n);
    nt->per = TAKE(life, double, n);
    nt->dz = TAKE(life, double, n);
    nt->r = TAKE(life, double, n);
    nt->step = TAKE(life, double, n);
    nt->before = TAKE(life, double, n);
    nt->energies = TAKE(life, double, n);
    remainder_open(&nt->remainder, n, life);
    nt->steps = 1;
    newton_forget(nt);
}

void newton_forget(struct newton *nt)
{
    zero(nt->scale, nt->ode->n);
    nt->top = nt->energy = 0;
    nt->age = ENERGY_LIFE;
    nt->life = nt->pairs ? 1 : ENERGY_LIFE;
    for (int i = 0; i < NEWTON_WAYS; i++) {
        contraction_forget(&nt->contraction[i]);
        contraction_forget(&nt->norms[i]);
    }
    nt->way = nt->next = 0;
    remainder_forget(&nt->remainder);
    renewal_forget(&nt->renewal, nt->price);
    nt->count = nt->refreshed = 0;
    nt->stale = 1;
}

void newton_scale(struct newton *nt, const double *v, const double *a, double H)
{
    int grown = 0;
    for (int i = 0; i < nt->ode->n; i++) {
        double s = larger(fabs(v[i]), fabs(H * a[i]));
        if (s > nt->scale[i]) {
            nt->scale[i] = s;
            nt->top = larger(nt->top, s);
            grown = 1;
        }
    }
    if (!grown && nt->top > 0) return;
    for (int i = 0; i < nt->ode->n; i++) nt->per[i] = 1 / larger(nt->scale[i], larger(AT_REST * nt->top, DBL_MIN));
}

static void ways_recall(struct newton *nt, struct recall *r)
{
    static const char *const names[NEWTON_WAYS] = {"way0", "way1"};
    for (int i = 0; i < (nt->pairs ? NEWTON_WAYS : 1); i++) {
        recall_within(r, names[i]);
        contraction_recall(&nt->contraction[i], r);
        recall_within(r, "norm");
        contraction_recall(&nt->norms[i], r);
        recall_without(r);
        recall_without(r);
    }
    recall_one(r, "way", nt->way);
    recall_one(r, "life", nt->life);
}

/* What the next newton_begin() looks back at, and what grows. */
void newton_recall(struct newton *nt, struct recall *r)
{
    recall_within(r, "newton");
    recall_list(r, "scale", nt->scale, nt->ode->n);
    recall_list(r, "per", nt->per, nt->ode->n);
    recall_one(r, "top", nt->top);
    recall_one(r, "energy", nt->energy);
    recall_one(r, "age", nt->age);
    recall_one(r, "stale", nt->stale);
    recall_one(r, "tol", nt->tol);
    recall_one(r, "first", nt->first);
    recall_one(r, "last", nt->last);
    recall_one(r, "first_square", nt->first_square);
    recall_one(r, "square", nt->square);
    recall_one(r, "count", nt->count);
    recall_one(r, "refreshed", nt->refreshed);
    recall_one(r, "rounding", nt->rounding);
    if (nt->pairs)
        ways_recall(nt, r);
    else
        contraction_recall(nt->contraction, r);
    renewal_recall(&nt->renewal, r);
    remainder_recall(&nt->remainder, r);
    recall_without(r);
}

/* What the last step has shown; nothing bad where it has come down to round-off. */
static void judge_last_step(struct newton *nt)
{
    if (nt->count == 0 || nt->pairs || nt->matrix_free) return;
    const int norm = nt->first_square > 0 && nt->square > 0;
    const double fall = norm ? sqrt(nt->first_square / nt->square) : nt->first / larger(nt->last, DBL_MIN);
    double need = renewal_need(nt->first, nt->tol, smaller(fall, 1 / DBL_EPSILON), nt->count);
    if (nt->rounding && nt->renewal.need > 0) need = smaller(need, nt->renewal.need);
    if (renewal_due(&nt->renewal, need, nt->refreshed > 0)) nt->stale = 1;
}

static void begin_way(struct newton *nt)
{
    contraction_begin(&nt->contraction[nt->way]);
    if (nt->pairs) contraction_begin(&nt->norms[nt->way]);
}

/* What five steps, each of which would leave z^3/12, z = omega h, leave together: .00093 z^5. */
static double of_five(double local)
{
    return local < 0 ? 0 : .0585 * local * cbrt(local * local);
}

static double enough(double local)
{
    return local < 0 ? 1e-10 : smaller(1e-8, larger(1e-13, 1e-3 * local));
}

void newton_begin(struct newton *nt, double local)
{
    judge_last_step(nt);
    begin_way(nt);
    nt->way = nt->next;
    begin_way(nt);
    remainder_begin(&nt->remainder);
    nt->tol = nt->tolerance;
    if (nt->tol <= 0) nt->tol = enough(nt->stage ? of_five(local) : local);
    nt->count = nt->bad = nt->refreshed = nt->fresh = nt->powered = 0;
    nt->newest = nt->due = false;
    nt->age++;
}

void newton_refreshed(struct newton *nt)
{
    nt->fresh = 2;
    nt->refreshed++;
    nt->bad = 0;
    nt->stale = 0;
    nt->due = false;
    contraction_renewed(&nt->contraction[nt->way]);
    contraction_renewed(&nt->norms[nt->way]);
}

/* v . M v at x as v . (r(a = v) - r(a = 0)); the last residual stays. */
static double kinetic(struct newton *nt, const struct instant *x)
{
    const struct ode2 *o = nt->ode;
    struct instant with = *x, without = *x;
    with.a = x->v;
    without.a = NULL;
    with.va = with.vb = without.va = without.vb = NULL; /* a is no longer theirs */
    double sum = 0;
    if (o->ops->resid(o, nt->energies, NULL, NULL, &with, ALL, NULL) != OK) return 0;
    sum += dot(nt->energies, x->v, o->n);
    if (o->ops->resid(o, nt->energies, NULL, NULL, &without, ALL, NULL) != OK) return 0;
    return sum - dot(nt->energies, x->v, o->n);
}

void newton_energy(struct newton *nt, const struct instant *x)
{
    if (nt->age < nt->life) return;
    nt->energy = larger(nt->energy, kinetic(nt, x));
    nt->age = 0;
    nt->life = nt->life < ENERGY_LIFE ? 2 * nt->life : ENERGY_LIFE;
}

/* stuck: the correction is not much smaller than the one before, so that round-off is enough. */
static int small_energy(struct newton *nt, double square, bool stuck, const struct instant *x)
{
    const double part = larger(BY_ENERGY * nt->tol, stuck ? TINY_NORM : 0), least = fabs(square) / (part * part);
    const bool near = nt->energy > 0 ? least <= FAR * nt->energy : stuck;
    if (nt->age >= (near ? 1 : 4) * nt->life) {
        nt->effort->slow += 2;
        nt->effort->fast += 2;
        newton_energy(nt, x);
    }
    return least <= nt->energy;
}

static enum verdict later_iterate(struct newton *nt, double err, double small, double square, double theta,
                                  const struct instant *x)
{
    const bool fresh = nt->fresh > 0 || nt->newest, renewable = nt->refreshed < MOST_REFRESHED && !nt->matrix_free;
    int tiny = nt->rounding || (fresh && (err <= TINY_FRESH || small <= TINY_FRESH_SI));
    const bool stuck = theta > .5;
    if ((stuck && tiny) || small_energy(nt, square, stuck, x)) {
        nt->remain = 1;
        return CONVERGED;
    }
    if (theta > SLUGGISH && !fresh && renewable) return REFRESH;
    nt->bad += theta > .9;
    return nt->bad >= 2 ? FAILED : CONTINUE;
}

/* theta of the iteration, but no larger than in the norm of energy: corrections of coordinates that others move while
 * they rest themselves come late, however good the matrix is. */
static double rate_of(const struct newton *nt, double err, double square)
{
    const double theta = err / nt->last;
    if (nt->pairs) return nt->count > 2 ? sqrt(err / nt->last2) : theta;
    return square > 0 && nt->square > 0 ? smaller(theta, sqrt(square / nt->square)) : theta;
}

double newton_contraction(const struct newton *nt)
{
    return nt->count > 2 && nt->first > 0 ? pow(nt->last / nt->first, 1. / (nt->count - 1)) : 0;
}

/* What is left in the norm of energy, against that of the motion: the step gains or loses twice that share of its energy
 * at most, dE = v . M dv <= |v| |dv|, so that the drift of a run is bounded.  A step that is worth several may leave what
 * they would; no coordinate is left far more than its own tolerance.  Works are those before the correction, off by as large a
 * share of them. */
static int little_energy(struct newton *nt, double square)
{
    if (nt->energy <= 0) return 0;
    const int first = nt->count == 1;
    const double norm = sqrt(fabs(square) / nt->energy), tol = nt->tol * (nt->tolerance > 0 ? 1 : nt->steps);
    const double theta = larger(nt->leaves, contraction_after(&nt->norms[nt->way], first ? 1 : norm / nt->norm, 0));
    nt->norm = norm;
    if (!(theta < 1) || !(theta / (1 - theta) * norm <= (first ? UNSEEN : 1) * tol)) return 0;
    const int booked = nt->light <= POWERED * nt->tol || nt->light * nt->flow <= tol * nt->energy;
    return nt->remain * nt->light <= LIGHT * nt->tol && booked;
}

/* Is a correction small enough for the works, which are those before it? */
static bool booked(const struct newton *nt, double err)
{
    return !nt->powered || err <= (nt->one_way ? ONE_WAY : POWERED) * nt->tol;
}

/* The same of one step by the tolerance that follows from its error: a coordinate that has little of the energy may be left
 * by some tolerances, a hundredth of what the step misses it by. */
static int slight(const struct newton *nt, double err, double square)
{
    const double left = nt->remain * err;
    if (nt->tolerance > 0 || nt->energy <= 0 || nt->count < 2) return 0;
    return booked(nt, err) && left <= SLIGHT * nt->tol &&
           nt->remain * nt->remain * fabs(square) <= nt->tol * nt->tol * nt->energy;
}

enum verdict newton_judge(struct newton *nt, double err, double small, double square, const struct instant *x)
{
    int first = nt->count++ == 0;
    nt->rounding = err <= TINY || small <= TINY_SI;
    nt->effort->sweeps++;
    nt->fresh--;
    if (!(err <= DBL_MAX)) return FAILED;
    const double theta = contraction_after(&nt->contraction[nt->way], first ? 1 : err / nt->last, HEARSAY);
    const double rate = first ? 1 : rate_of(nt, err, square), tol = first ? AT_ONCE * nt->tol : nt->tol;
    nt->remain = theta < 1 ? theta / (1 - theta) : DBL_MAX;
    const int balanced = nt->pairs ? little_energy(nt, square) : slight(nt, err, square);
    int done = err == 0 || balanced || (nt->remain * err <= tol && booked(nt, err));
    if (err == 0) nt->remain = 0;
    if (first) {
        nt->first = err;
        nt->first_square = larger(0, square);
    }
    if (!first && rate > SLUGGISH && nt->last > ROUGH && !nt->rounding) nt->stale = 1;
    nt->last2 = nt->last;
    nt->last = err;
    nt->square = square;
    if (done) return CONVERGED;
    enum verdict v = first ? CONTINUE : later_iterate(nt, err, small, square, rate, x);
    return v == CONTINUE && nt->count >= nt->limit ? FAILED : v;
}

/* z -= dz, and the correction measured. */
static enum verdict correct(struct newton *nt, double *z, const double *h, int m, const struct instant *x)
{
    double err = 0, small = 0, square = 0, sum = 0;
    for (int i = 0; i < m; i++) {
        double dv = fabs(h[i] * nt->dz[i]), e = dv * nt->per[i];
        sum += dv;
        square += h[i] * nt->r[i] * h[i] * nt->dz[i];
        z[i] -= nt->dz[i];
        if (dv > small) small = dv;
        if (e > err) {
            err = e;
            nt->worst = i;
        }
    }
    return newton_judge(nt, isfinite(sum) ? err : NAN, small, square, x);
}

static enum status give_up(const struct newton *nt, const struct equations *eq, int m, struct trouble *why)
{
    for (int i = 0; i < m; i++)
        if (!isfinite(nt->r[i])) return trouble_set(why, TROUBLE_NOT_FINITE, i, nt->r[i], eq->x->t);
    return trouble_set(why, TROUBLE_DIVERGED, nt->worst, nt->last / nt->tol, eq->x->t);
}

/* The first two corrections show what the last one leaves; a matrix between them shows nothing. */
static void watch(struct newton *nt)
{
    if (nt->count == 0) remainder_first(&nt->remainder, nt->dz);
    if (nt->count == 1 && nt->fresh < 2) remainder_second(&nt->remainder, nt->dz, nt->per);
}

/* The last correction and what has come of it show the matrix, if it is the same. */
static void learn(struct newton *nt, const struct equations *eq)
{
    if (nt->count == 0 || nt->fresh >= 2 || nt->last <= ROUGH) return;
    if (eq->learn(eq->self, nt->dz, nt->step, nt->before, nt->r)) remainder_learnt(&nt->remainder);
}

static void keep_for_learning(struct newton *nt, int m)
{
    copy(nt->step, nt->dz, m);
    copy(nt->before, nt->r, m);
}

enum status newton_solve(struct newton *nt, double *z, const struct equations *eq, const double *h, int m,
                         struct trouble *why)
{
    const bool whole = m == nt->ode->n && !nt->matrix_free, learns = whole && eq->learn;
    for (;;) {
        double dk = 0;
        TRY(eq->resid(eq->self, nt->r, &dk, z, why));
        if (sharpened(&dk)) nt->tol = smaller(nt->tol, ROUND_OFF);
        if (nt->due || (dk > .2 && nt->fresh < 2 && nt->refreshed < MOST_REFRESHED)) {
            TRY(eq->refresh(eq->self, z, why));
            newton_refreshed(nt);
        }
        eq->solve(eq->self, nt->dz, nt->r);
        if (whole) watch(nt);
        if (learns) learn(nt, eq);
        switch (correct(nt, z, h, m, eq->x)) {
        case CONVERGED:
            if (whole) remainder_take(&nt->remainder, z, nt->dz);
            return OK;
        case CONTINUE:
            break;
        case REFRESH:
            nt->due = true;
            break;
        case FAILED:
            return give_up(nt, eq, m, why);
        }
        if (learns) keep_for_learning(nt, m);
    }
}
