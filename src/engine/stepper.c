/* stepper.c -- what all schemes share; see stepper.h */
#include "engine/stepper.h"

#include <math.h>
#include <string.h>

#include "base/inline.h"
#include "engine/accel.h"
#include "engine/kinematic.h"
#include "engine/missed.h"
#include "engine/motion.h"
#include "engine/single.h"
#include "engine/strikes.h"
#include "engine/tangent.h"
#include "engine/touch.h"

void stepper_open(struct stepper *s, const struct stepper_kind *kind, struct ode2 *ode,
                  const struct step_options *options, struct arena *life)
{
    if (options->order == 4 && kind->fourth) kind = kind->fourth;
    *s = (struct stepper){.kind = kind, .ode = ode, .options = *options, .fresh = 1, .life = life};
    s->accel = TAKE(life, struct accel, 1);
    accel_open(s->accel, ode, &s->effort, life);
    s->keep = TAKE(life, struct single, 1);
    single_open(s->keep, ode, life);
    s->whole = TAKE(life, struct single, 1);
    single_open(s->whole, ode, life);
    s->missed = TAKE(life, struct missed, 1);
    missed_open(s->missed, ode->n, life);
    if (ode->passed || ode->nside) strikes_open(s->strikes = TAKE(life, struct strikes, 1), ode->n, life);
    kind->open(s, life);
    if (ode->contact && ode->contact->m > 0 && kind->two_rates && !kind->adaptive) {
        s->plain = TAKE(life, struct stepper, 1);
        stepper_open(s->plain, kind->single, ode, options, life);
        s->plain->missed = NULL;
        s->plain->strikes = NULL;
        s->touch = s->plain->touch;
    }
    if (ode->contact && ode->contact->m > 0 && !s->touch) s->touch = touch_open(s, life);
    ode->along[0] = s->missed->position; /* not those of a stepper inside */
    ode->along[1] = s->missed->velocity;
}

bool stepper_may_damp(struct stepper *s, double rho)
{
    const struct stepper_kind *kind = s->kind;
    struct step_options options = s->options;
    struct misfit why;
    options.rho_infinity = rho;
    if (kind->adaptive || s->touch || s->options.rho_infinity < 1) return false;
    if (!key_find(kind->keys, "rho_infinity") || (kind->fits && !kind->fits(&options, &why))) return false;
    s->damped = TAKE(s->life, struct stepper, 1);
    stepper_open(s->damped, kind, s->ode, &options, s->life);
    s->damped->missed = s->missed;
    s->damped->strikes = s->strikes;
    s->ode->along[0] = s->missed->position;
    s->ode->along[1] = s->missed->velocity;
    return true;
}

void effort_hand_on(struct effort *to, struct effort *from)
{
    to->slow += from->slow;
    to->fast += from->fast;
    to->factors += from->factors;
    to->sweeps += from->sweeps;
    for (int i = 0; i < SPENT_KINDS; i++) {
        to->spent[i].times += from->spent[i].times;
        to->spent[i].slow += from->spent[i].slow;
        to->spent[i].fast += from->spent[i].fast;
    }
    *from = (struct effort){0};
}

/* A new chart, if there is a better one: what was known in the old one is forgotten.  The step has been taken: if its
 * accelerations cannot be found, that is the next one's failure. */
static void begin_anew(struct stepper *s, struct state *x)
{
    struct trouble why;
    const double v = s->tangent ? x->v[0] : 0, a = s->tangent ? x->a[0] : 0;
    if (!s->ode->chart->rechart(s->ode, x->q, x->v, x->t)) return;
    if (s->tangent) tangent_rechart(s, x, v, a);
    if (s->missed) missed_rechart(s->missed);
    if (s->strikes) strikes_rechart(s->strikes);
    s->unstarted = stepper_start(s, x, &why) != OK;
}

/* One step after the impulses of drives' corners, and behind the corner at its start of anything that it asks for there. 
 * A scheme that looks at points of time would miss those anywhere in the step; one that takes means over it sees them all,
 * and is of first order there: a corner right at the start comes first in every scheme. */
static enum status after_corners(struct stepper *s, struct state *x, double h, int ratio, double to,
                                 struct trouble *why)
{
    const struct ode2 *o = s->ode;
    const int fresh = s->fresh;
    const double t0 = x->t, behind = motion_behind(t0, to);
    double work = 0;
    int met = 0;
    single_save(s->keep, o, x);
    if (o->breaks->jump) TRY(o->breaks->jump(o, &met, x->v, &work, x->q, t0, s->kind->points ? to : behind, why));
    if (!met && !(s->kind->points && motion_sides(o, t0))) return s->kind->step(s, x, h, ratio, to, why);
    x->t = behind;
    enum status status = stepper_start(s, x, why);
    if (status == OK) status = s->kind->step(s, x, h, ratio, to, why);
    s->work[POWER_DRIVE] += work;
    if (status == OK) return OK;
    single_restore(s->keep, o, x, t0);
    s->fresh |= fresh;
    return status;
}

/* Minor steps of about h in a part of a major step. */
static int minors(double part, double h)
{
    return part > h ? (int)ceil(part / h * (1 - 1e-9)) : 1;
}

/* What the parts of a step have done, in sum. */
static void add_work(double *work, double *lost, double *left, const struct stepper *s)
{
    for (int c = 0; c < POWER_CHANNELS; c++) work[c] += s->work[c];
    *lost += s->lost;
    *left += s->left;
}

/* Where the first part of a step ends that goes on from t: at a corner behind t, not where the step ends anyway. */
static double part_end(const struct ode2 *o, double t, double to)
{
    const double corner = o->breaks->corner(o, motion_behind(t, to), to);
    return corner < to && motion_behind(corner, to) < to ? corner : to;
}

/* The parts of a major step between corners of drives: in one of two rates slow coordinates are carried by the mean of the
 * drives over all of it, and would not see the impulse where the fast ones see it. */
static enum status between_corners(struct stepper *s, struct state *x, double h, int ratio, double to,
                                   struct trouble *why)
{
    const struct ode2 *o = s->ode;
    const double t0 = x->t;
    double work[POWER_CHANNELS] = {0}, lost = 0, left = 0, end = part_end(o, t0, to);
    if (end == to) return after_corners(s, x, h, ratio, to, why);
    single_save(s->whole, o, x);
    for (; x->t != to; end = part_end(o, x->t, to)) {
        const int n = minors(end - x->t, h);
        memset(s->work, 0, sizeof s->work);
        s->lost = s->left = 0;
        enum status status = after_corners(s, x, (end - x->t) / n, n, end, why);
        if (status != OK) {
            single_restore(s->whole, o, x, t0);
            s->unstarted = 1;
            return status;
        }
        add_work(work, &lost, &left, s);
    }
    memcpy(s->work, work, sizeof work);
    s->lost = lost;
    s->left = left;
    return OK;
}

/* Where nothing touches. */
INTO static inline enum status smooth_step(struct stepper *s, struct state *x, double h, int ratio, double to,
                                           struct trouble *why)
{
    const struct ode2 *o = s->ode;
    if (s->kind->two_rates && !s->kind->points && ratio > 1 && o->breaks && o->breaks->jump)
        return between_corners(s, x, h, ratio, to, why);
    if (!s->kind->adaptive && o->breaks && (o->breaks->jump || s->kind->points))
        return after_corners(s, x, h, ratio, to, why);
    return s->kind->step(s, x, h, ratio, to, why);
}

/* A step by the stepper p inside. */
static enum status inner_step(struct stepper *s, struct stepper *p, struct state *x, double h, int ratio, double to,
                              struct trouble *why)
{
    memset(p->work, 0, sizeof p->work);
    p->lost = p->left = p->struck = 0;
    const enum status status = p->touch ? touch_step(p, x, h, ratio, to, why) : smooth_step(p, x, h, ratio, to, why);
    memcpy(s->work, p->work, sizeof s->work);
    s->lost = p->lost;
    s->left = p->left;
    s->struck = p->struck;
    s->effort.minors += p->effort.minors;
    effort_hand_on(&s->effort, &p->effort);
    return status;
}

static enum status plain_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    const enum status status = inner_step(s, s->plain, x, h, ratio, to, why);
    s->was_plain = true;
    s->plainly += status == OK;
    return status;
}

static enum status damped_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    if (s->fresh) s->damped->fresh = 1;
    s->fresh = 0;
    s->damped->last_sweeps = 0;
    const enum status status = inner_step(s, s->damped, x, h, ratio, to, why);
    s->last_sweeps = s->damped->last_sweeps;
    return status;
}

/* A major step of two rates beside contacts: where all of them are far, for all of it, they are not there; else its minor
 * steps are taken of all coordinates, from impact to impact. */
APART enum status near_or_far(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    const double H = to - x->t;
    bool far;
    TRY(touch_far(s->touch, &far, x, H, why));
    if (far && ratio > 1) {
        if (s->was_plain) TRY(stepper_start(s, x, why));
        s->was_plain = false;
        s->plain->fresh = 1;
        TRY(smooth_step(s, x, h, ratio, to, why));
        TRY(touch_was_far(s->touch, &far, x, H, why));
        if (far) return OK;
        touch_back(s->touch, x);
        s->effort.minors -= ratio;
        s->effort.rejected++;
    }
    return plain_step(s, x, h, ratio, to, why);
}

static enum status any_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    if (s->unstarted) TRY(stepper_start(s, x, why));
    s->unstarted = 0;
    if (s->ode->n == 0) {
        TRY(kinematic_step(s, x, ratio, to, why));
        return s->touch ? touch_driven(s->touch, x, why) : OK;
    }
    if (s->damps) return damped_step(s, x, h, ratio, to, why);
    if (s->touch && !s->kind->adaptive) return (s->plain ? near_or_far : touch_step)(s, x, h, ratio, to, why);
    return smooth_step(s, x, h, ratio, to, why);
}

enum status stepper_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    memset(s->work, 0, sizeof s->work);
    s->lost = s->left = s->struck = s->swing = 0;
    s->last_sweeps = 0;
    enum status status = any_step(s, x, h, ratio, to, why);
    if (status == OK)
        s->effort.majors++;
    else
        s->effort.rejected++;
    if (status == OK && s->tangent) tangent_step(s, x);
    if (status == OK && !s->natural && s->ode->chart && s->ode->chart->rechart) begin_anew(s, x);
    return status;
}

enum status stepper_start(struct stepper *s, struct state *x, struct trouble *why)
{
    s->fresh = 1;
    if (s->ode->n == 0) return OK;
    return accel_solve(s->accel, x->a, NULL, x->q, x->v, x->t, why);
}

enum status stepper_recall(struct stepper *s, struct recall *r)
{
    enum status status = OK;
    recall_within(r, s->kind->name);
    recall_one(r, "fresh", s->fresh);
    recall_one(r, "unstarted", s->unstarted);
    recall_one(r, "last_sweeps", s->last_sweeps);
    if (s->missed) missed_recall(s->missed, r);
    if (s->strikes) strikes_recall(s->strikes, r);
    if (!recall_has(r, "tangent")) s->tangent = NULL; /* the run before was too short for it: sums go on as they are */
    if (s->tangent) tangent_recall(s->tangent, r);
    if (s->kind->recall && s->ode->n > 0) status = s->kind->recall(s, r);
    if (s->damped) {
        recall_one(r, "damps", s->damps);
        recall_within(r, "damped");
        if (status == OK) status = stepper_recall(s->damped, r);
        recall_without(r);
    }
    if (s->plain) {
        recall_one(r, "was_plain", s->was_plain);
        recall_one(r, "plainly", s->plainly);
        if (status == OK) status = stepper_recall(s->plain, r);
    } else if (s->touch && !s->kind->adaptive) { /* else that of the stepper inside */
        touch_recall(s->touch, r);
    }
    recall_without(r);
    return status;
}
