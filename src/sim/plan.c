/* plan.c -- how many steps, when a record is due */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "engine/relay.h"
#include "multirate/schemes.h"
#include "sim/parts.h"

static const double MOST_STEPS = 1e12;

static bool near_whole(double x)
{
    return fabs(x - round(x)) <= 1e-9 * fmax(1, fabs(x));
}

/* Do the options that the scheme reads go together? */
static enum status check_options(const struct sim *sim, const struct stepper_kind *kind, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    struct misfit why;
    if (!kind->fits || kind->fits(p->options, &why)) return OK;
    const struct node *at = node_find(p->node, why.key), *other = node_find(p->node, why.other);
    if ((!at || at->implied) && other && !other->implied) at = other;
    diag_error(diags, at ? at : p->node, AT_VALUE, why.code, "%s", why.text);
    diag_hint(diags, "%s", why.hint);
    return E_DECK;
}

/* Damping that is asked for is had, or refused: without it what the step does not resolve rings on. */
static enum status check_damping(const struct sim *sim, const struct stepper_kind *kind, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const struct node *rho = node_find(p->node, "rho_infinity");
    const double value = ((const struct step_options *)p->options)->rho_infinity;
    if (!rho || rho->implied || sim->options.counting || scheme_is_compared(sim, rho)) return OK;
    if (value < 1 && !key_find(kind->keys, "rho_infinity")) {
        diag_error(diags, rho, AT_KEY, "E-damping", "scheme %s does not damp, it has no 'rho_infinity'", kind->name);
        diag_hint(diags, kind->adaptive
                             ? "its steps resolve what there is: leave it out"
                             : "midpoint, generalized-alpha, hht and newmark have; subcycle damps what is fast, at "
                               "ratio 1, too");
        return E_DECK;
    }
    const struct node *alpha = node_find(p->node, "alpha");
    if (value == 1 && key_find(kind->keys, "alpha") && (!alpha || alpha->implied)) {
        diag_error(diags, rho, AT_VALUE, "E-damping", "rho_infinity 1 leaves alpha as it is, -0.05");
        diag_hint(diags, "alpha: 0 keeps all energy");
        return E_DECK;
    }
    return OK;
}

/* What a deck leaves open: without a step, the motion to DEFAULT_TOLERANCE; without a scheme besides, by dopri5,
 * or by midpoint, which takes rigid contacts. */
static void fill_in(struct sim *sim, struct arena *life)
{
    static const double DEFAULT_TOLERANCE = 1e-4;
    struct integrate *p = &sim->plan;
    const struct step_options *o = p->options;
    const struct node *scheme = node_find(p->node, "scheme");
    const bool any = strcmp(p->scheme, step_relay.name) == 0 && !p->because; /* nobody has chosen */
    if (any && p->step > 0 && !(o->tolerance > 0)) p->scheme = "midpoint";
    if (any && o->tolerance > 0) p->scheme = sim->scene->ncontact ? "midpoint" : "dopri5";
    if (p->step > 0) return;
    if (any || (p->scheme == sim->scene->integrate.scheme && !p->because && (!scheme || scheme->implied)))
        p->scheme = sim->scene->ncontact ? "midpoint" : "dopri5";
    const struct stepper_kind *kind = stepper_find(p->scheme);
    if (o->tolerance > 0 || node_find(p->node, "tolerance") || !kind || !(kind->adaptive || kind->tolerant)) return;
    struct step_options *filled = TAKE(life, struct step_options, 1);
    *filled = *o;
    filled->tolerance = DEFAULT_TOLERANCE;
    p->options = filled;
    sim->filled_in = true;
}

static enum status find_scheme(struct sim *sim, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const char *names[32];
    int n = 0;
    for (; n < 32 && stepper_kinds[n]; n++) names[n] = stepper_kinds[n]->name;
    const struct stepper_kind *kind = stepper_find(p->scheme);
    if (kind) {
        sim->stepper.kind = kind;
        TRY(check_damping(sim, kind, diags));
        return check_options(sim, kind, diags);
    }
    const struct node *at = node_find(p->node, "scheme");
    kind = stepper_find_absent(p->scheme);
    if (kind) {
        diag_error(diags, at, AT_VALUE, "E-absent-scheme", "scheme %s is not in this build, which had not found %s",
                   kind->name, kind->needs);
        diag_hint(diags, "install that package (Debian) and build anew, or take radau9");
        return E_DECK;
    }
    diag_error(diags, at, AT_VALUE, "E-unknown-scheme", "unknown scheme '%.60s'", p->scheme);
    const char *nearest = text_nearest(p->scheme, names, n);
    if (nearest)
        diag_hint(diags, "did you mean '%s'?", nearest);
    else
        diag_hint(diags, "`fmdsub list schemes` shows them");
    return E_DECK;
}

/* At ratio 1, with nothing that only it can do, a sub-cycling scheme is its single-rate twin: that one runs. */
static void prefer_single_rate(struct sim *sim)
{
    const struct stepper_kind *kind = sim->stepper.kind;
    if (sim->options.general || sim->plan.ratio != 1 || !kind->single) return;
    for (const struct key *k = kind->keys; k->name; k++)
        if (k->flags & KEY_NEUTRAL && !key_is_default(k, sim->plan.options)) return;
    sim->stepper.kind = kind->single;
}

/* Schemes that take turns look ahead. */
static void tell_end(struct sim *sim, struct arena *life)
{
    struct step_options *told = TAKE(life, struct step_options, 1);
    *told = *(const struct step_options *)sim->plan.options;
    told->until = sim->plan.until;
    sim->plan.options = told;
}

/* With a tolerance, a scheme of fixed steps has steps of its own. */
static void prefer_own_steps(struct sim *sim)
{
    if (!sim->stepper.kind->tolerant) return;
    sim->stepper.kind = sim->stepper.kind->tolerant;
    sim->guess = (struct guess){sim->plan.step, sim->plan.ratio};
}

static enum status missing_step(struct sim *sim, struct diags *diags)
{
    const struct step_options *o = sim->plan.options;
    diag_error(diags, sim->plan.node, AT_KEY, "E-missing-key", "scheme %s needs a 'step'", sim->plan.scheme);
    if (o->tolerance > 0) diag_hint(diags, "'tolerance' is for schemes that choose their steps, such as dopri5");
    return E_DECK;
}

static enum status check_tolerance(struct sim *sim, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const struct step_options *o = p->options;
    const struct node *at = node_find(p->node, "tolerance");
    bool adaptive = sim->stepper.kind->adaptive;
    if (adaptive && !(o->tolerance > 0)) {
        if (at) return E_DECK; /* it is there and was refused */
        diag_error(diags, p->node, AT_KEY, "E-missing-key", "scheme %s needs a 'tolerance'", sim->stepper.kind->name);
        return E_DECK;
    }
    return OK;
}

static enum status plan_every(struct sim *sim, double H, struct diags *diags)
{
    const struct output *out = &sim->scene->output;
    if (out->every_steps) {
        sim->every = out->every_steps;
        return OK;
    }
    if (!(out->every > 0)) {
        sim->every = 1;
        return OK;
    }
    double steps = out->every / H;
    sim->every = (long)fmin(fmax(1, round(steps)), (double)(sim->before + sim->majors));
    if (near_whole(steps) && steps > 0.5) return OK;
    double below = floor(steps) * H, above = ceil(steps) * H;
    if (below > 0)
        diag_error(diags, out->every_node, AT_VALUE, "E-every",
                   "every %.12g s is not a multiple of the major step %.12g s; the nearest are %.12g and %.12g",
                   out->every, H, below, above);
    else
        diag_error(diags, out->every_node, AT_VALUE, "E-every", "every %.12g s is shorter than the major step, %.12g s",
                   out->every, H);
    return E_DECK;
}

/* On the steps of a run from t = 0, where the start is the end of one of them: then two runs are the same as one. */
static enum status count_steps(struct sim *sim, double H, struct report *report)
{
    const double start = sim->scene->start, until = sim->plan.until, past = start / H;
    if (!(until / H <= MOST_STEPS && past <= MOST_STEPS))
        return fail(report, E_LIMIT, "%.3g major steps to t = %g s: the limit is %g", until / H, until, MOST_STEPS);
    const bool along = near_whole(past);
    sim->before = along ? lround(past) : 0;
    const double origin = along ? 0 : start, steps = (until - origin) / H;
    sim->origin = meant_by(origin);
    sim->step = meant_by(sim->plan.step);
    sim->majors = (near_whole(steps) ? lround(steps) : (long)ceil(steps)) - sim->before;
    if (sim->majors < 1) sim->majors = 1;
    return OK;
}

enum status plan_steps(struct sim *sim, struct diags *diags, struct arena *life, struct report *report)
{
    struct integrate *p = &sim->plan;
    fill_in(sim, life);
    TRY(find_scheme(sim, diags));
    TRY(check_tolerance(sim, diags));
    if (sim->stepper.kind == &step_relay) tell_end(sim, life);
    if (((const struct step_options *)p->options)->tolerance > 0)
        prefer_own_steps(sim);
    else
        prefer_single_rate(sim);
    if (sim->scene->ncontact) TRY(contacts_plan(sim, diags));
    if (!(p->until > 0)) return E_DECK;
    double H = p->step * p->ratio;
    if (sim->stepper.kind->adaptive) { /* its steps are its own: counted are those from record to record */
        const struct output *out = &sim->scene->output;
        H = out->every > 0 ? out->every : p->step > 0 ? H : (p->until - sim->scene->start) / 100;
        p->step = H;
        p->ratio = 1;
    } else if (!(p->step > 0)) {
        return missing_step(sim, diags);
    }
    TRY(count_steps(sim, H, report));
    return plan_every(sim, H, diags);
}
