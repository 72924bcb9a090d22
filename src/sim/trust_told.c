/* trust_told.c -- the columns judged by the errors that trust_find.c has found, and the words for it; see trust.h */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "engine/options.h"
#include "engine/stepper.h"
#include "sim/parts.h"

static const double UNKNOWN = .5;  /* of a column's range: with a larger error nothing can be said */
static const double AMPLE = 1.5;   /* safety factor on the summed errors, so that few estimates are too small */
static const double FAR = 300;     /* times the tolerance: W-tolerance warns */
static const double LARGE = .05;   /* of what the tolerance refers to: it warns, too, whatever the tolerance */
static const double LITTLE = 1e-3; /* of its size: a column whose range is less is practically constant */

/* ---- columns --------------------------------------------------------------------------------------------------- */

/* Largest minus least value of column i. */
static double range(const struct sim *sim, int i)
{
    return sim->trust.high[i] - sim->trust.low[i];
}

/* Its largest |value|. */
static double size(const struct sim *sim, int i)
{
    return fmax(fabs(sim->trust.low[i]), fabs(sim->trust.high[i]));
}

static bool is_in(const struct sim *sim, int i, const char *unit)
{
    return text_same(sim->columns[i].unit, unit);
}

/* The largest size of all columns in this unit. */
static double largest_in(const struct sim *sim, const char *unit)
{
    double most = 0;
    for (int k = 0; k < sim->chosen.n; k++)
        if (is_in(sim, k, unit)) most = fmax(most, size(sim, k));
    return most;
}

static double largest_of_unit(const struct sim *sim, int i)
{
    return largest_in(sim, sim->columns[i].unit);
}

/* What speeds and accelerations are round-off beside, where all that is written rests: those that gravity gives over the
 * mechanism's length, or that take it through its length in the run; of turns those over the length.  0: of another unit. */
static double motion_of(const struct sim *sim, int i)
{
    static const char *const unit[] = {"m/s", "rad/s", "m/s2", "rad/s2"};
    const double *g = sim->scene->gravity, length = system_length(sim->system), time = sim->x.t - sim->scene->start;
    const double weight = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    if (!(length > 0) || !(time > 0)) return 0;
    const double speed = fmax(sqrt(weight * length), length / time),
                 size[] = {speed, speed / length, speed * speed / length, speed / length * speed / length};
    for (int k = 0; k < 4; k++)
        if (is_in(sim, i, unit[k])) return size[k];
    return 0;
}

/* The size that round-off of column i is relative to: the largest column of its unit or a usual change of the
 * quantity; of angles at least a radian; of energies also the norm of the balance; of moments and forces that too, and each other, by the length
 * of the mechanism. */
static double scale(const struct sim *sim, int i)
{
    const double length = system_length(sim->system), energy = sim->ledger.norm;
    const double most = fmax(largest_of_unit(sim, i), fmax(sim_column_usual(sim, i), motion_of(sim, i)));
    if (is_in(sim, i, "rad")) return fmax(most, 1);
    if (is_in(sim, i, "J")) return fmax(most, energy);
    if (is_in(sim, i, "N m")) return fmax(most, fmax(energy, length * largest_in(sim, "N")));
    if (is_in(sim, i, "N") && length > 0) return fmax(most, fmax(energy, largest_in(sim, "N m")) / length);
    return most;
}

/* The error relative to the column's range, or to its size if it is constant; neither is taken below the round-off
 * of its scale. */
static double share(const struct sim *sim, int i)
{
    static const double RESTS = 1e-8, LOST = 1e-9; /* as a study does: constant below it; lost in round-off below it */
    const double least = LOST * scale(sim, i), whole = size(sim, i), over = range(sim, i);
    if (sim->trust.off[i] <= least && over <= least) return 0; /* both are round-off */
    return AMPLE * sim->trust.off[i] / fmax(over > RESTS * whole ? over : whole, least);
}

/* Has the quantity a natural zero?  Positions and angles are counted from an arbitrary origin. */
static bool has_origin(const struct sim *sim, int i)
{
    const char *unit = sim->columns[i].unit;
    return unit && strcmp(unit, "m") != 0 && strcmp(unit, "rad") != 0;
}

/* The error relative to what a tolerance refers to: the size of a quantity with a natural zero, where that is larger
 * than its range, since a scheme's tolerance is not of the little by which a large quantity changes. */
static double share_of_size(const struct sim *sim, int i)
{
    return fmin(share(sim, i), has_origin(sim, i) ? AMPLE * sim->trust.off[i] / size(sim, i) : INFINITY);
}

static bool needs(const struct sim *sim, int i, unsigned what)
{
    return sim->catalogue.origin[sim->chosen.index[i]].needs & what;
}

/* Is it a momentum that is conserved?  Some schemes keep it to round-off, others within their accuracy: errors of
 * the single bodies cancel in it, so that neither their sum nor its range is a measure.  Taken as conserved: one of
 * a floating mechanism under a scheme that keeps momenta; one that changes by little of the largest of its unit; one
 * that changes by no more than twice its estimated error. */
static bool is_kept(const struct sim *sim, int i)
{
    if (!needs(sim, i, NEED_MOMENTUM)) return false;
    if (sim->stepper.kind->keeps && sim_floating(sim) > 0) return true;
    return range(sim, i) <= LITTLE * largest_of_unit(sim, i) || !(share(sim, i) < UNKNOWN);
}

/* Is it not known whether the column changes at all: by little of its size, and by no more than twice its error? */
static bool is_still(const struct sim *sim, int i)
{
    return has_origin(sim, i) && range(sim, i) <= LITTLE * size(sim, i) && !(share(sim, i) < UNKNOWN);
}

void trust_judge(struct sim *sim)
{
    struct trust *o = &sim->trust;
    o->worst = o->beyond = 0;
    o->column = o->still = o->farthest = -1;
    for (int i = 0; i < sim->chosen.n; i++) {
        if (!sim_column_compared(sim, i) || needs(sim, i, NEED_WORKS) || is_kept(sim, i)) continue;
        if (share_of_size(sim, i) >= o->beyond) {
            o->beyond = share_of_size(sim, i);
            o->farthest = i;
        }
        if (is_still(sim, i)) {
            if (o->still < 0) o->still = i;
        } else if (share(sim, i) >= o->worst) {
            o->worst = share(sim, i);
            o->column = i;
        }
    }
    o->known = o->column >= 0 && o->worst < UNKNOWN;
}

/* ---- told ------------------------------------------------------------------------------------------------------ */

/* The tolerance of a scheme that chooses its steps; 0: fixed steps. */
static double tolerance(const struct sim *sim)
{
    return sim->stepper.kind->adaptive ? ((const struct step_options *)sim->plan.options)->tolerance : 0;
}

int trust_facts(const struct sim *sim, struct pair *facts)
{
    const struct trust *o = &sim->trust;
    const bool any = o->column >= 0;
    facts[0] = pair_number("estimated_error", o->known ? o->worst : NAN);
    facts[1] = pair_text("estimated_error_column", any ? sim->columns[o->column].name : NULL);
    facts[2] = pair_bool("resolved", o->known || !any);
    return 3;
}

void warn_of_trust(struct sim *sim)
{
    const struct trust *o = &sim->trust;
    if (!(tolerance(sim) > 0) || o->why || o->farthest < 0 || !(o->beyond > fmin(LARGE, FAR * tolerance(sim)))) return;
    char error[24] = "more than half";
    if (o->beyond < UNKNOWN) snprintf(error, sizeof error, "%.2g", o->beyond);
    sim_warn(sim,
             "the estimated error, %s of the %s of '%.60s', is %s %g: what the steps miss adds up "
             "or grows; take a smaller tolerance, and measure with --verify [W-tolerance]",
             error, share_of_size(sim, o->farthest) < share(sim, o->farthest) ? "size" : "range",
             sim->columns[o->farthest].name,
             o->beyond > FAR * tolerance(sim) ? "far above the tolerance of" : "large, at a tolerance of",
             tolerance(sim));
}

/* Does trust_find.c take it that errors have grown along the run? */
static bool grows(const struct sim *sim)
{
    return sim->trust.growth * (sim->x.t - sim->scene->start) > TRUST_GROWN;
}

static void print_unknown(const struct sim *sim, FILE *to)
{
    fprintf(to, "estimated error: not known, above half the range of '%s': ", sim->columns[sim->trust.column].name);
    if (grows(sim))
        fprintf(to, "small differences grow all the way, at %.2g /s and more", sim->trust.growth);
    else
        fputs("the steps do not resolve what moves there", to);
    fprintf(to, "; take %s\n", tolerance(sim) > 0 ? "a smaller tolerance" : "smaller steps");
}

static void print_known(const struct sim *sim, FILE *to)
{
    const struct trust *o = &sim->trust;
    fprintf(to, "estimated error: %.1g of the range of '%s', summed over the steps", o->worst,
            sim->columns[o->column].name);
    if (o->still >= 0)
        fprintf(to, ", without '%s', which changes by no more than its error", sim->columns[o->still].name);
    if (grows(sim))
        fprintf(
            to,
            ", which grow in proportion to time at least: small differences grow all the way, at %.2g /s and more: ",
            o->growth);
    else
        fputs(isnan(o->growth) ? "; whether small differences grow was not looked at: " : "; ", to);
    fputs("`fmdsub run --verify` measures it\n", to);
}

void print_trust(const struct sim *sim, FILE *to)
{
    const struct trust *o = &sim->trust;
    if (sim->status != OK && sim->status != E_VERDICT) return;
    if (o->why)
        fprintf(to, "estimated error: not known: %s; `fmdsub run --verify` measures it\n", o->why);
    else if (o->column < 0 && o->still >= 0)
        fprintf(to, "estimated error: not known: '%s' changes by no more than that\n", sim->columns[o->still].name);
    else if (o->column < 0)
        fputs("estimated error: not known: no column of the motion is written\n", to);
    else if (!o->known)
        print_unknown(sim, to);
    else
        print_known(sim, to);
}
