/* choices.c -- see choices.h */
#include "cli/choices.h"

#include <math.h>
#include <stdlib.h>

#include "multirate/schemes.h"
#include "out/columns.h"

enum status choices_numbers(double *x, int *n, const char *option, const char *list, bool whole, struct arena *life,
                            struct report *report)
{
    const char **words = columns_split(n, list, life);
    if (*n == 0) return fail(report, E_USAGE, "--%s names no number", option);
    if (*n > MOST_CHOICES) return fail(report, E_USAGE, "--%s: more than %d", option, MOST_CHOICES);
    for (int i = 0; i < *n; i++) {
        char *end;
        x[i] = strtod(words[i], &end);
        if (*end || !(x[i] > 0) || !isfinite(x[i]) || (whole && x[i] != floor(x[i])) || (whole && x[i] > 1e6))
            return fail(report, E_USAGE, "--%s: expected %s, found '%.40s'", option,
                        whole ? "whole numbers from 1" : "positive numbers", words[i]);
    }
    return OK;
}

static enum status read_schemes(struct choices *o, const struct request *request, struct arena *life,
                                struct report *report)
{
    if (!request->schemes) return OK;
    const char **words = columns_split(&o->nscheme, request->schemes, life);
    if (o->nscheme == 0) return fail(report, E_USAGE, "--schemes names no scheme");
    if (o->nscheme > MOST_CHOICES) return fail(report, E_USAGE, "--schemes: more than %d", MOST_CHOICES);
    for (int i = 0; i < o->nscheme; i++) {
        o->scheme[i] = stepper_find(words[i]);
        const struct stepper_kind *absent = stepper_find_absent(words[i]);
        if (absent)
            return fail(report, E_USAGE, "--schemes: %s is not in this build, which had not found %s", absent->name,
                        absent->needs);
        if (!o->scheme[i]) return fail(report, E_USAGE, "--schemes: no scheme '%.40s'", words[i]);
    }
    return OK;
}

enum status choices_read(struct choices *o, const struct request *request, struct arena *life, struct report *report)
{
    double x[MOST_CHOICES];
    TRY(read_schemes(o, request, life, report));
    if (request->ratios) TRY(choices_numbers(x, &o->nratio, "ratios", request->ratios, true, life, report));
    for (int i = 0; i < o->nratio; i++) o->ratio[i] = (int)x[i];
    if (request->steps) TRY(choices_numbers(o->step, &o->nstep, "steps", request->steps, false, life, report));
    if (request->tolerances)
        TRY(choices_numbers(o->tolerance, &o->ntolerance, "tolerances", request->tolerances, false, life, report));
    for (int i = 0; i < o->ntolerance; i++) {
        if (o->tolerance[i] > MOST_TOLERANCE) return fail(report, E_USAGE, "--tolerances: at most %g", MOST_TOLERANCE);
        if (o->tolerance[i] < LEAST_TOLERANCE)
            return fail(report, E_USAGE, "--tolerances: at least %g", LEAST_TOLERANCE);
    }
    return OK;
}
