/* trust_why.c -- why the steps of a run cannot tell its error; see trust.h */
#include <math.h>

#include "engine/missed.h"
#include "engine/strikes.h"
#include "engine/touch.h"
#include "sim/parts.h"

static const double EXCITED = 3e-3; /* unresolved vibration over kinetic energy: it moves the rest by about 1 % */

bool trust_of_time(const struct sim *sim)
{
    const struct scene *scene = sim->scene;
    bool reads = scene->ndrive > 0;
    for (int i = 0; i < scene->nforce; i++)
        for (int k = 0; k < 3; k++) reads |= signal_reads_time(&scene->force[i].value[k]);
    return reads;
}

static bool has_jumped(const struct sim *sim)
{
    for (int i = 0; i < sim->njump; i++)
        if (sim->jump[i].reported) return true;
    return false;
}

/* missed.h takes differences over successive steps of equal length: why there have been too few of them. */
static const char *too_few(const struct sim *sim)
{
    enum { FEW = 8, OFTEN = 8 };
    const struct effort *e = &sim->stepper.effort;
    if (!sim->stepper.kind->adaptive && OFTEN * e->rejected > e->majors)
        return sim->plan.ratio > 1
                   ? "too many major steps did not converge at their length and were cut: a lower ratio takes less"
                   : "too many steps did not converge at their length, and were cut";
    if (sim->stepper.missed->steps < FEW) return "the run has too few steps";
    return "too few steps lie between corners of forces or drives";
}

/* Has something struck so often, and otherwise each time, that differences may have grown from one strike to the next past all that
 * steps tell?  A mass between stops that a drive moves may make ten of one within these few.  With one
 * freedom alone differences only drift. */
static bool may_have_strayed(const struct sim *sim)
{
    enum { FEW = 6 };
    const struct stepper *s = &sim->stepper;
    return s->strikes && s->strikes->unlike > FEW && (s->ode->n > 1 || trust_of_time(sim));
}

const char *trust_why(const struct sim *sim)
{
    const struct touch *touch = sim->stepper.touch;
    const struct missed *missed = sim->stepper.missed;
    const bool tells = sim->stepper.kind->adaptive || sim->stepper.kind->late;
    const bool asked = sim->stepper.kind->adaptive || missed->steps > 0; /* two rates composed to order 4 are not */
    if (sim->stepper.ode->n == 0)
        return sim->needs & NEED_WORKS ? "drives move all, and works are sums whose errors are not known" : NULL;
    if (ledger_broken(&sim->ledger)) return "the energy balance is broken";
    if (!tells) return "its scheme does not tell what its steps leave";
    if (has_jumped(sim)) return "a drive jumps";
    if (sim->corner.met) return "the rate of a drive jumps";
    if (sim->pulses) return "a load comes and goes within a step";
    if (sim->stepper.unresolved.energy > EXCITED * sim->stepper.unresolved.motion)
        return "the minor steps do not resolve what vibrates in them";
    if (sim->guard.taken) return "the scheme has damped away what the steps do not resolve";
    if (touch && touch_impacts(touch)) return "bodies strike each other";
    if (touch && touch_pushed(touch))
        return touch_rubs(touch) ? "friction acts in joints" : "bodies push or rub each other";
    if (sim->stepper.plainly > 0) return "near contacts all coordinates took the minor step";
    if (!asked && touch) return "no step was free of friction or of what may touch";
    if (!asked) return "its scheme does not tell what its steps leave";
    if (2 * missed->told < missed->steps || missed->told == 0) return too_few(sim);
    if (may_have_strayed(sim))
        return "brief pushes (stops, contacts, backlash) come again and again, each time otherwise, and small "
               "differences may grow from one to the next";
    return NULL;
}
