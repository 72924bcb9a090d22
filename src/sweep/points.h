/* points.h -- the points of a sweep: what is changed in the deck, to which values.
 *
 *     k=1e3:1e6:log:20   k=0:1:5 (lin)   integrate.scheme=[midpoint, rk4]      all combinations, the last one fastest
 *     k~normal(1e4,1e3)  k~uniform(0,1)  k~loguniform(1e3,1e6)                 drawn, so many for each combination
 *
 * A value is the text that the deck is given, numbers of at most 15 digits: a point is the same by itself, in part of a
 * sweep or in all of it.  What is drawn depends on seed, factor and number alone: more draws begin with the same ones,
 * but under Latin hypercube sampling, where each of n equally likely parts of a factor's range is taken once. */
#ifndef FMDSUB_SWEEP_POINTS_H
#define FMDSUB_SWEEP_POINTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/status.h"

enum { POINT_TEXT = 32, MOST_POINTS = 10000000 };

struct factor {
    const char *name; /* as it was given */
    const char *path; /* of the deck; points_resolve() */
    int n;            /* values; 0: drawn */
    const char **value;
    double (*draw)(double u, double a, double b); /* by the quantile u */
    double a, b;
    int *part; /* [draws] Latin hypercube: which part of the range a draw is from */
};

struct pointset {
    int nfactor, capacity;
    struct factor *factor;
    bool latin;
    uint64_t seed;
    long draws; /* for each combination; 1: nothing is drawn */
    long n;     /* in all */
};

/* "k=1e3:1e6:log:20" */
enum status points_add(struct pointset *o, const char *text, struct arena *life, struct report *report);

/* draws: 0: not asked for. */
enum status points_close(struct pointset *o, long draws, struct arena *life, struct report *report);

/* The text of factor f at point i; numbers that are drawn go to buffer [POINT_TEXT]. */
const char *points_value(const struct pointset *o, long i, int f, char *buffer);

/* A number of a uniform distribution between 0 and 1, neither of them, by three others. */
double points_uniform(uint64_t seed, uint64_t stream, uint64_t i);
/* The quantile of the normal distribution of mean 0 and deviation 1. */
double points_normal(double u);

#endif
