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
    const char *path; /* in the deck: sweep_resolve() */
    int n;            /* values; 0: they are drawn */
    const char **value;
    double (*draw)(double u, double a, double b); /* the value at quantile u, by the inverse of the distribution */
    double a, b;                                  /* its parameters */
    int *part; /* [draws] Latin hypercube: the part of the range that each draw is from */
};

struct pointset {
    int nfactor, capacity;
    struct factor *factor;
    bool latin;
    uint64_t seed;
    long draws; /* for each combination; 1: nothing is drawn */
    long n;     /* in all */
};

/* Adds a factor from its text, "k=1e3:1e6:log:20".  E_USAGE: the text is wrong. */
enum status points_add(struct pointset *o, const char *text, struct arena *life, struct report *report);

/* After the last factor: numbers of draws and of points.  draws: --sample, 0: not given. */
enum status points_close(struct pointset *o, long draws, struct arena *life, struct report *report);

/* The text of factor f at point i; numbers that are drawn go to buffer [POINT_TEXT]. */
const char *points_value(const struct pointset *o, long i, int f, char *buffer);

/* A pseudo-random number, uniform between 0 and 1 (ends excluded), a function of the three arguments alone. */
double points_uniform(uint64_t seed, uint64_t stream, uint64_t i);
/* The quantile of the normal distribution of mean 0 and deviation 1. */
double points_normal(double u);

#endif
