/* rods.h -- beams for tests. */
#ifndef FMDSUB_TESTS_RODS_H
#define FMDSUB_TESTS_RODS_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "flex/beam.h"
#include "la/vec3.h"

enum { MOST = 60 }; /* coordinates */

static const double ROOT_ONLY[] = {0}, BOTH[] = {0, 1};

/* Width across (along z), height in the bending plane (along y). */
static inline struct flex_section rectangle(double station, double width, double height)
{
    double a = width > height ? width : height, b = width > height ? height : width, r = b / a;
    return (struct flex_section){.station = station,
                                 .A = width * height,
                                 .Iy = height * width * width * width / 12,
                                 .Iz = width * height * height * height / 12,
                                 .J = a * b * b * b * (1.0 / 3 - 0.21 * r * (1 - r * r * r * r / 12)),
                                 .y = height / 2,
                                 .z = width / 2};
}

/* Along world x, body axes the world's; interface stations as given. */
static inline struct flex_beam bar(int space, double length, int elements, int modes,
                                   const struct flex_section *section, int ninterface, const double *interface)
{
    return (struct flex_beam){.space = space,
                              .b = {length, 0, 0},
                              .R = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                              .elements = elements,
                              .modes = modes,
                              .nsection = 1,
                              .section = section,
                              .E = 2.1e11,
                              .G = 2.1e11 / 2.6,
                              .density = 7850,
                              .ninterface = ninterface,
                              .interface = interface};
}

static inline struct flex_body *made(const struct flex_beam *o, double *at, struct arena *life)
{
    struct report report = {0};
    struct flex_body *body = NULL;
    if (flex_beam_make(&body, at, o, life, &report) != OK) {
        fprintf(stderr, "beam not made: %s\n", report.text);
        abort();
    }
    return body;
}

/* Half as wide and high at the end, twisted. */
static inline const struct flex_section *tapered(struct flex_section *c, double twist)
{
    c[0] = rectangle(0, 0.04, 0.02);
    c[1] = rectangle(1, 0.02, 0.01);
    c[1].twist = twist;
    return c;
}

static inline double error(const double *hertz, const double *exact, int n)
{
    double worst = 0;
    for (int i = 0; i < n; i++) worst = fmax(worst, fabs(hertz[i] / exact[i] - 1));
    return worst;
}

/* q = K^-1 phi' F at the node; its displacement and turn. */
static inline void deflect(double *u, double *turn, const struct flex_body *o, const struct flex_node *node,
                           const double *F, double *q)
{
    v3_set(u, 0, 0, 0);
    v3_set(turn, 0, 0, 0);
    for (int j = 0; j < o->n; j++) {
        q[j] = v3_dot(node->phi + 3 * j, F) / o->K[j * (o->n + 1)];
        v3_axpy(u, q[j], node->phi + 3 * j);
        v3_axpy(turn, q[j], node->psi + 3 * j);
    }
}

#endif
