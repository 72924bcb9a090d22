/* trial.c -- see trial.h */
#include "study/trial.h"

#include <math.h>

#include "base/stop.h"
#include "multirate/schemes.h"
#include "study/stiff.h"

static const double LOOSE = 1e-3;
static const double PARTED = .3, UNKNOWN = .3; /* of the range: coordinates that have parted, columns nobody knows */
static const double SECONDS = .5;              /* that the counts of all runs may stand for */
static const double LEAST = 100;               /* evaluations that all may take */
static const double WHOLE = .35, PART = .15; /* of what all may take, for a loose run to its end, or for a part of it */
static const double OWN = .62, SECOND = .3;  /* of it for both runs by a tolerance, at least for the second */
enum { FEW = 2 };                            /* rows that tell of a run */
static const double QUICK = 3000;            /* evaluations up to which an explicit scheme is a matter of course */
static const double A_RADIAN = 2; /* evaluations that an explicit scheme takes at least, stable up to 6 rad a step */
enum { MOST_RECORDS = 200, MOST_EVALUATIONS = 200000 };

double trial_handy(double x)
{
    double best = INFINITY;
    for (double five = 1; five < 5 * x; five *= 5) best = fmin(best, five * exp2(fmax(0, ceil(log2(x / five) - 1e-9))));
    return x <= 1 ? 1 : best;
}

/* Records as the deck has them, or so many of its intervals to one that there are few; where an evaluation is dear, and
 * a run is not to go on for long before its work is looked at, a part of one. */
static void plan_records(struct trial *o)
{
    enum { A_RECORD = 13, LEAST_RECORDS = 20 }; /* evaluations to one that steps end at */
    static const double DEAR = 1e-5;            /* [s] */
    const double paid = WHOLE * o->most / (A_RECORD * o->subject.price.evaluation);
    const double most = fmax(LEAST_RECORDS, fmin(MOST_RECORDS, paid));
    const struct output *out = &o->scene.output;
    const double whole = o->until - o->start, base = out->every > 0 ? fmin(out->every, whole) : whole / LEAST_STEPS;
    o->multiple = fmax(1, fmin(1e9, ceil(whole / base / most - 1e-9)));
    if (o->subject.price.evaluation > DEAR && whole / base < LEAST_STEPS)
        o->multiple = 1 / trial_handy(LEAST_STEPS * base / whole);
    o->every = base * o->multiple;
    o->scene.output.every = o->subject.every = o->every;
    o->scene.output.every_steps = 0;
}

/* What it takes to open a run of bodies with so many modes, about [s]. */
static double opening_of(const struct scene *scene)
{
    static const double PAIR = 1e-5; /* of modes */
    double modes = 0;
    for (int i = 0; i < scene->nbody; i++) modes += scene->body[i].nmode;
    return PAIR * modes * modes;
}

enum status trial_attempt(struct outcome *o, struct trial *t, const struct setting *setting, double most,
                          const struct outcome_watch *watch, struct arena *life)
{
    *o = (struct outcome){0};
    const enum status status = outcome_watched(o, setting, most, watch, &t->subject, life, t->report);
    t->used += o->seconds + t->opening;
    t->work += o->work;
    if (stop) return status;
    if (status == OK && o->status == E_NUMERIC && !t->stop.text[0]) t->stop = o->report;
    if (status != OK || !(o->status == OK || o->status == E_VERDICT || o->over)) o->rows = 0;
    return OK;
}

static enum status attempt_own(struct outcome *o, struct trial *t, const char *scheme, double tolerance, double most,
                               const struct outcome_watch *watch)
{
    const struct setting setting = {stepper_find(scheme), tolerance, NAN, 1, 0};
    return trial_attempt(o, t, &setting, most, watch, t->life);
}

static bool complete(const struct outcome *o)
{
    return o->rows > 1 && !o->over;
}

/* The tolerance that the deck's steps are chosen by; 0: it gives them. */
static double tolerance_of(const struct trial *t)
{
    return ((const struct step_options *)t->scene.integrate.options)->tolerance;
}

static double records_of(const struct trial *t)
{
    return (t->until - t->start) / t->every;
}

/* [s] that counts stand for of a run which was cut, had it gone on to the end as it did; INFINITY: it has not begun. */
static double whole_of(const struct outcome *o, const struct trial *t)
{
    return o->rows > 1 ? o->seconds * records_of(t) / (o->rows - 1) : INFINITY;
}

static const double AMPLE = 1.2; /* later parts may take more */

/* [s] that all trials may take: an evaluation to a step of the deck's own run; of a run by a tolerance a fifth, going by how many
 * one to the loose tolerance takes; with rigid contacts, where nothing is known from a part of the run, some runs of it.  At
 * least so many evaluations, and matrices until three runs are under way. */
static double allowed(const struct trial *t, double loose)
{
    enum { A_STEP = 1, WITH_CONTACTS = 10, MATRICES = 30 };
    static const double OF_A_RUN = .2, DEAR = 1. / 9;
    const struct integrate *p = &t->scene.integrate;
    const struct price *price = &t->subject.price;
    const double least = LEAST * price->evaluation + MATRICES * price->full;
    const double steps = (t->until - t->start) / (p->step * p->ratio) * (1 - price->fast + price->fast * p->ratio);
    double may = (t->scene.ncontact ? WITH_CONTACTS : A_STEP) * steps * price->evaluation;
    if (tolerance_of(t) > 0) may = OF_A_RUN * loose * pow(LOOSE / tolerance_of(t), DEAR);
    if (tolerance_of(t) > 0 && t->scene.ncontact) may = t->most;
    return fmin(t->most, fmax(least, may));
}

/* A first run, which is left early where it is not going to come to its end. */
struct hope {
    const struct trial *trial;
    double most; /* [s] of the whole run, beyond which another scheme is looked at */
    bool held;   /* if it is small motions that keep its steps short, and not what moves */
};

/* Are its steps about as long as stability lets them be? */
static bool is_held(const struct outcome *o, const struct trial *t)
{
    static const double ABOUT = 2;
    const double radians = t->stiff * (o->rows - 1) / records_of(t);
    return o->seconds < ABOUT * A_RADIAN * radians * t->subject.price.evaluation;
}

/* The share of the run up to where it has to come: the last corner ahead, for fixed steps; else the end. */
static double wanted(const struct outcome *o, const struct trial *t)
{
    const double last = t->corners.n && !(tolerance_of(t) > 0) ? t->corners.t[t->corners.n - 1] : INFINITY;
    return outcome_row(o, o->rows - 1)[0] < last ? fmin(1, (last - t->start) / (t->until - t->start)) : 1;
}

static bool is_hopeless(const void *self, const struct outcome *o)
{
    const struct hope *hope = self;
    const struct trial *t = hope->trial;
    const double whole = whole_of(o, t), all = allowed(t, whole);
    if (o->rows > FEW && o->seconds > PART * all && wanted(o, t) * whole > WHOLE * all) return true;
    return o->rows - 1 >= .1 * records_of(t) && whole > hope->most && (!hope->held || is_held(o, t));
}

/* An explicit scheme, or an implicit one where small motions keep the steps of that short; with rigid contacts the one that
 * takes them. */
static enum status find_own(struct outcome *o, struct trial *t)
{
    static const double ABOUT = 3;
    const bool small = !too_full(stepper_find("radau9"), &t->subject);
    const char *explicit = small ? "dop853" : "dopri5";
    const double most = WHOLE * t->most, quick = fmin(QUICK * t->subject.price.evaluation, most);
    const double least = A_RADIAN * t->stiff * t->subject.price.evaluation;
    struct hope hope = {t, small ? AMPLE * quick : INFINITY, true};
    const struct outcome_watch watch = {.enough = is_hopeless, .self = &hope};
    struct outcome other;
    t->own = (struct tried){.scheme = t->scene.ncontact ? "midpoint" : explicit, .ratio = 1};
    if (t->scene.ncontact) return attempt_own(o, t, t->own.scheme, LOOSE, most, NULL);
    *o = (struct outcome){0};
    if (!small || least <= quick) TRY(attempt_own(o, t, explicit, LOOSE, most, &watch));
    if (!small || complete(o) || (o->rows > 1 && !is_held(o, t))) return OK;
    hope = (struct hope){t, ABOUT * whole_of(o, t), false};
    TRY(attempt_own(&other, t, "radau9", LOOSE, most, &watch));
    if (other.rows <= o->rows) return OK;
    t->own.scheme = "radau9";
    *o = other;
    return OK;
}

/* The tightest tolerance that may be paid for; the loose one where none may, and where drives alone move all. */
static double tight_for(const struct trial *t, const struct outcome *loose)
{
    enum { CHOICES = 2 };
    static const struct {
        double tolerance, price; /* of the loose run's */
    } choices[2][CHOICES] = {{{1e-5, 1.9}, {1e-4, 1.4}}, {{1e-5, 10}, {1e-4, 3.2}}};
    const bool second_order = t->scene.ncontact > 0;
    for (int i = 0; i < CHOICES && t->n > 0; i++) {
        if (choices[second_order][i].price * loose->seconds < OWN * t->most - loose->seconds)
            return choices[second_order][i].tolerance;
    }
    return LOOSE;
}

/* [s] from the start to the last row. */
static double came(const struct outcome *o, const struct trial *t)
{
    return outcome_row(o, o->rows - 1)[0] - t->start;
}

/* What the loose run has missed.  Where records or corners, and not its tolerance, have kept its steps short, it is as good
 * as one of a tighter tolerance, by the number of steps that the tight run took. */
static void note_own(struct trial *t, double coarse, double fine, const struct outcome *loose)
{
    static const double BOUND = 1.2, MANY = 2.5;
    struct errors e;
    struct tried *own = &t->own;
    const int order = stepper_find(own->scheme)->order;
    const struct outcome *tight = &t->reference.run;
    const double rates[2] = {(double)loose->effort.minors / came(loose, t),
                             (double)tight->effort.minors / came(tight, t)};
    const double looked = t->reference.horizon - t->start, more = rates[1] / rates[0];
    reference_compare(&e, &t->reference, &t->subject, loose);
    own->at[0] = coarse;
    own->at[1] = fmax(fine, fmin(coarse, fine * pow(more, order)));
    own->fine = fine;
    own->error[0] = isnan(e.worst) ? 0 : e.worst;
    own->error[1] = fmax(own->error[0], fine);
    own->work[0] = loose->work * looked / came(loose, t);
    own->work[1] = tight->work * looked / came(tight, t);
    own->energy[0] = loose->energy_share;
    own->energy[1] = tight->energy_share;
    own->n = 1;
    own->share = looked / (t->until - t->start);
    t->steps = rates[0] * (t->until - t->start);
    if (order > 2 && (more > BOUND || t->steps > MANY * records_of(t)))
        t->freely = fmin(t->steps, rates[1] * pow(fine / coarse, 1. / order) * (t->until - t->start));
}

/* Has the second run left the first, so that nothing that it does from now on is of use? */
static bool has_parted(const void *self, const struct outcome *o)
{
    const struct trial *t = self;
    return reference_left(&t->reference, o, PARTED, &t->subject);
}

/* The second run, as far as the first has come and they do not part. */
static enum status attempt_second(struct outcome *o, struct trial *t, const struct outcome *first, double tolerance)
{
    const struct outcome_watch watch = {.enough = has_parted, .self = t};
    reference_alone(&t->reference, first, &t->subject, t->life);
    t->subject.until = t->reference.horizon;
    const enum status status =
        attempt_own(o, t, t->own.scheme, tolerance, fmax(SECOND * t->most, OWN * t->most - first->seconds), &watch);
    t->subject.until = t->until;
    return status;
}

static const char *not_on(const struct trial *t)
{
    return t->stop.text[0] ? "trial runs of it stop" : "no trial run of it gets on";
}

/* Where drives alone move all any steps are as good, and no tolerance asks for any: one run is its own reference. */
static enum status find_driven(struct trial *t)
{
    const double least = trial_handy(LEAST_STEPS * t->every / (t->until - t->start));
    const struct setting setting = {stepper_find("midpoint"), NAN, t->every / least, 1, 0};
    struct outcome *run = &t->reference.run;
    TRY(trial_attempt(run, t, &setting, t->most, NULL, t->life));
    if (run->rows < 2) t->why = not_on(t);
    if (t->why) return OK;
    t->loose = *run;
    reference_between(&t->reference, &t->loose, PARTED, UNKNOWN, &t->subject, t->life);
    t->own = (struct tried){.scheme = "midpoint", .ratio = 1, .at = {least}, .share = 1};
    return OK;
}

/* Two runs, of which the tighter one is the reference. */
static enum status find_reference(struct trial *t)
{
    struct outcome loose, tight;
    if (t->n == 0 && !t->scene.ncontact && !(tolerance_of(t) > 0)) return find_driven(t);
    TRY(find_own(&loose, t));
    if (loose.rows < 2) {
        t->why = not_on(t);
        return OK;
    }
    t->most = allowed(t, whole_of(&loose, t));
    const double fine = tight_for(t, &loose), other = fine == LOOSE ? 10 * LOOSE : fine;
    TRY(attempt_second(&tight, t, &loose, other));
    if (tight.rows < 2) {
        t->why = "no two trial runs of it get on";
        return OK;
    }
    const bool swap = other > LOOSE;
    t->reference.run = swap ? loose : tight;
    t->loose = swap ? tight : loose;
    reference_between(&t->reference, swap ? &tight : &loose, PARTED, UNKNOWN, &t->subject, t->life);
    if (!(t->reference.horizon > t->start)) {
        t->why = "trial runs of it part at once";
        return OK;
    }
    if (t->scene.ncontact && !t->reference.whole) {
        t->why = "trial runs of it part before the end, and impacts behind that are not known";
        return OK;
    }
    note_own(t, fmax(other, LOOSE), fmin(other, LOOSE), swap ? &tight : &loose);
    return OK;
}

/* By what the loose run misses more in both halves of what is compared than in the first; 1: it misses nothing there. */
static double growth_of(struct trial *t)
{
    struct errors e;
    const double end = t->reference.horizon;
    int last = 0;
    while (last + 1 < t->reference.run.rows && outcome_row(&t->reference.run, last + 1)[0] <= end) last++;
    t->reference.horizon = outcome_row(&t->reference.run, last / 2)[0];
    reference_compare(&e, &t->reference, &t->subject, &t->loose);
    t->reference.horizon = end;
    return e.worst > 0 ? t->own.error[0] / e.worst : 1;
}

/* Of what nobody has looked at an error is promised only where the part tried is likely to be like it. */
static const char *only_up_to(struct trial *t)
{
    static const double QUICKLY = 16; /* a drift gives 2, one that speeds up 4 */
    const double end = t->reference.horizon;
    if (!t->reference.whole) return "trial runs part there";
    if (!(end < t->until * (1 - 1e-9))) return NULL;
    if (t->corners.n && t->corners.t[t->corners.n - 1] > end) return "a load or drive bends or jumps later";
    if (t->comes_on) return "forces may come on, bend or jump later";
    if (growth_of(t) > QUICKLY) return "what steps miss grows quickly there, and may go on to";
    return t->own.share < COVERED ? "that is too little to tell of the rest" : NULL;
}

enum status trial_run(struct trial *o, const struct sim *sim, struct diags *diags, struct arena *life,
                      struct report *report)
{
    const struct scene *scene = sim->scene;
    const int n = sim->stepper.ode->n;
    enum { MOST_FREEDOMS = 2000 };
    static const double FIRST = 500; /* evaluations, by which nothing is found */
    *o = (struct trial){.scene = *scene, .start = scene->start, .until = scene->integrate.until};
    o->n = n;
    o->life = life;
    o->report = report;
    const double *rest = scene->at_rest ? sim->x.q : NULL;
    enum status status = OK;
    if (n <= MOST_FREEDOMS) status = subject_open(&o->subject, &o->scene, NULL, rest, diags, life, report);
    if (stop) return status;
    if (status != OK) o->why = "no trial run of it starts";
    if (n > MOST_FREEDOMS || FIRST * o->subject.price.evaluation > SECONDS)
        o->why = "it is too large to be tried in half a second";
    if (o->why) return OK;
    o->most = fmin(SECONDS, MOST_EVALUATIONS * o->subject.price.evaluation);
    if (!(tolerance_of(o) > 0)) o->most = allowed(o, NAN);
    o->opening = opening_of(scene);
    o->tried_until = o->corner = NAN;
    o->comes_on = sim->stepper.ode->bends || sim->stepper.ode->passed;
    o->falls = sim_bends_unseen(sim) || scene->ncontact ? 1 : 2; /* impacts lie in steps anyhow */
    o->unseen = o->comes_on || o->falls == 1;
    o->delta = sim->ledger.delta;
    if (n > 0) o->stiff = stiff_rate(sim) * (o->until - o->start);
    if (n > 0) o->work += STIFF_EVALUATIONS;
    corners_find(&o->corners, sim, o->until, life);
    plan_records(o);
    TRY(find_reference(o));
    if (!o->why) o->only = only_up_to(o);
    if (!o->why && o->own.share < COVERED) o->no_steps = "trial runs have not come far enough";
    if (tolerance_of(o) > 0)
        o->no_steps = scene->integrate.because ? "steps are chosen by a tolerance, which is the cheaper way"
                                               : "the deck has a tolerance, which rules over a step";
    return o->why || o->no_steps ? OK : trial_fixed(o);
}
