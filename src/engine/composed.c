/* composed.c -- see composed.h */
#include "engine/composed.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/scalar.h"
#include "engine/missed.h"
#include "engine/single.h"

enum { STAGES = 5, BACK = 2 };

struct composed {
    struct stepper on, back; /* each has its own predictors and matrices */
    struct single before;
    double most; /* that dampers have taken in a step [J] */
};

static const struct stepper_kind *base_of(const struct stepper *s)
{
    return s->kind->formulas;
}

void composed_open(struct stepper *s, struct arena *life)
{
    struct composed *o = s->self = TAKE(life, struct composed, 1);
    struct step_options options = s->options;
    options.order = 2;
    options.stage = 1;
    options.symmetric = 1;
    stepper_open(&o->on, base_of(s), s->ode, &options, life);
    stepper_open(&o->back, base_of(s), s->ode, &options, life);
    single_open(&o->before, s->ode, life);
}

/* What a stage has done is the step's. */
static void book(struct stepper *s, struct stepper *stage)
{
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += stage->work[c];
    s->lost += stage->lost;
    s->left += stage->left;
    s->last_sweeps += stage->last_sweeps;
    const double motion = larger(s->unresolved.motion, stage->unresolved.motion);
    if (stage->unresolved.energy > s->unresolved.energy) s->unresolved = stage->unresolved;
    s->unresolved.motion = motion;
    effort_hand_on(&s->effort, &stage->effort);
}

/* Have dampers brought more on the way back than they have taken on the way? */
static bool feeds(struct composed *o, double onward, double backward)
{
    static const double NOTHING = 1e-9; /* of the most that has been taken: round-off */
    o->most = larger(o->most, fabs(onward));
    return onward < 0 && onward + backward > NOTHING * o->most;
}

static enum status stages(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    static const double b = .41449077179437573714, back = -.65796308717750294856;
    static const double end[STAGES] = {.41449077179437573714, .82898154358875147428, .17101845641124852572,
                                       .58550922820562426286, 1};
    struct composed *o = s->self;
    const double t0 = x->t;
    double onward = 0, backward = 0;
    for (int k = 0; k < STAGES; k++) {
        struct stepper *stage = k == BACK ? &o->back : &o->on;
        memset(stage->work, 0, sizeof stage->work);
        stage->lost = stage->left = 0;
        stage->last_sweeps = 0;
        const enum status status = base_of(s)->step(stage, x, h * (k == BACK ? back : b), ratio,
                                                    k + 1 < STAGES ? t0 + end[k] * h * ratio : to, why);
        book(s, stage);
        TRY(status);
        *(k == BACK ? &backward : &onward) += stage->work[POWER_DAMPER];
    }
    return feeds(o, onward, backward) ? trouble_set(why, TROUBLE_DIVERGED, 0, backward / -onward, t0) : OK;
}

/* With what it misses, of one rate: a stage b z, z = omega h, turns a vibration by 2 atan(b z/2), all five by z + (4 b^5 +
 * (1 - 4 b)^5)/80 z^5, where the sum is -0.0744. */
static enum status looked_at(struct stepper *s, struct state *x, double h, double to, struct trouble *why)
{
    static const double late = .0744 / 80;
    missed_begin(s->missed, s->fresh || motion_sides(s->ode, x->t), h);
    missed_before(s->missed, x->v);
    const enum status status = stages(s, x, h, 1, to, why);
    if (status == OK)
        missed_after(s->missed, s->ode, x->v, 4, late, true);
    else
        missed_break(s->missed);
    return status;
}

enum status composed_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct composed *o = s->self;
    const double t0 = x->t;
    const int together = base_of(s)->two_rates ? ratio : 1;
    single_save(&o->before, s->ode, x);
    if (s->fresh) o->on.fresh = o->back.fresh = 1;
    for (int k = together; k <= ratio; k += together) {
        const double t1 = k < ratio ? t0 + k * h : to;
        const bool look = s->missed && !base_of(s)->two_rates && missed_looks(s->missed);
        const enum status status = look ? looked_at(s, x, h, t1, why) : stages(s, x, h, together, t1, why);
        if (status == OK) continue;
        single_restore(&o->before, s->ode, x, t0);
        o->on.fresh = o->back.fresh = 1;
        return status;
    }
    s->effort.minors += ratio;
    s->fresh = 0;
    return OK;
}

enum status composed_recall(struct stepper *s, struct recall *r)
{
    struct composed *o = s->self;
    recall_one(r, "most", o->most);
    recall_within(r, "on");
    TRY(stepper_recall(&o->on, r));
    recall_without(r);
    recall_within(r, "back");
    TRY(stepper_recall(&o->back, r));
    recall_without(r);
    return OK;
}

static bool unfit(struct misfit *why, const char *other, const char *text, const char *hint)
{
    *why = (struct misfit){.code = "E-order", .key = "order", .other = other, .hint = hint};
    snprintf(why->text, sizeof why->text, "%s", text);
    return false;
}

bool composed_fits(const struct step_options *o, struct misfit *why)
{
    if (o->order == 2 || o->order == 0) return true;
    if (o->order == 3) return unfit(why, "order", "order is 2 or 4", "order: 4");
    if (o->rho_infinity < 1)
        return unfit(why, "rho_infinity", "order 4 steps back in time, where what 'rho_infinity' damps would grow",
                     "rho_infinity: 1, or order: 2");
    if (o->tolerance > 0)
        return unfit(why, "tolerance", "with a tolerance the steps are those of order 2", "give a 'step', or order: 2");
    return true;
}
