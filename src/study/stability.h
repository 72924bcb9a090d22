/* stability.h -- which steps a scheme can take: the growth from major step to major step of the system linearised where the
 * run stands, over schemes, ratios and steps, each by the scheme's own step (probe/growth.h). */
#ifndef FMDSUB_STUDY_STABILITY_H
#define FMDSUB_STUDY_STABILITY_H

#include "probe/classes.h"

/* NULL and 0: as the deck and its frequencies say. */
struct stability_options {
    const struct stepper_kind *const *scheme;
    int nscheme;
    const int *ratio;
    int nratio;
    const double *step;
    int nstep;
};

struct stability_row {
    const struct stepper_kind *kind;
    double step;
    int ratio;
    bool known;       /* else a step did not converge */
    double radius;    /* spectral radius of the map over a major step */
    double own;       /* what the motion itself grows by in it */
    bool grows;       /* beyond that: unstable */
    bool coarse;      /* the motion itself grows too fast for such a step to tell */
    double frequency; /* of the motion of the largest eigenvalue, as the scheme shows it [rad/s] */
    const char *most; /* the coordinate that moves most in it */
};

struct stability {
    const struct sim *sim;
    struct classes classes;
    double fast_top, slow_top; /* local frequencies of the quickest coordinates [rad/s]; 0: none */
    double own;                /* exponent of the motion itself [1/s] */
    int nrow;
    struct stability_row *row; /* [nrow] by scheme, ratio, step */
};

enum { STABILITY_MOST = 100 }; /* freedoms */

/* E_LIMIT beyond that; E_MODEL where nothing moves. */
enum status stability_find(struct stability *o, const struct sim *sim, const struct stability_options *options,
                           struct arena *life, struct report *report);

/* From row i on: the end of the band of rows of one scheme and ratio that grow alike, or do not. */
int stability_band(const struct stability *o, int i);

/* "stable", "unstable", "coarse", "no step". */
const char *stability_verdict(const struct stability_row *r);

/* omega h of both classes in row r; 0: there are none. */
double stability_fast(const struct stability *o, const struct stability_row *r);
double stability_slow(const struct stability *o, const struct stability_row *r);

/* A line a scheme and ratio, the bands in it; what follows, in words. */
enum status stability_print(const struct stability *o, FILE *to, struct arena *life, struct report *report);
void stability_answer(const struct stability *o, FILE *to);

enum { STABILITY_WIDTH = 1100, STABILITY_HEIGHT = 620 };
/* As a script for gnuplot, without `set terminal` and `set output`. */
void stability_script(const struct stability *o, const char *title, FILE *to);

#endif
