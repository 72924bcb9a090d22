/* choices.h -- lists of schemes, ratios and steps from the command line. */
#ifndef FMDSUB_CLI_CHOICES_H
#define FMDSUB_CLI_CHOICES_H

#include "cli/cli.h"

enum { MOST_CHOICES = 64 };

struct choices {
    const struct stepper_kind *scheme[MOST_CHOICES];
    int ratio[MOST_CHOICES];
    double step[MOST_CHOICES], tolerance[MOST_CHOICES];
    int nscheme, nratio, nstep, ntolerance; /* 0: not said */
};

/* --schemes, --ratios, --steps, --tolerances. */
enum status choices_read(struct choices *o, const struct request *request, struct arena *life, struct report *report);

/* x [at most MOST_CHOICES] := positive numbers of a list, whole ones from 1. */
enum status choices_numbers(double *x, int *n, const char *option, const char *list, bool whole, struct arena *life,
                            struct report *report);

#endif
