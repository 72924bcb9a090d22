/* bar.h -- the bar of this folder, for tests; figures that CalculiX printed. */
#ifndef FMDSUB_TESTS_REDUCE_BAR_H
#define FMDSUB_TESTS_REDUCE_BAR_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "flex/file.h"
#include "reduce/body.h"
#include "reduce/prestress.h"
#include "reduce/stress.h"
#include "reduce/summary.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define BAR "tests/reduce/bar"
static const double two_pi = 6.28318530717958647693;
static const double bar_length = 1, bar_width = 0.1, bar_height = 0.06, bar_density = 2780, bar_E = 7e10, bar_nu = 0.3;

/* clamped.dat, spun.dat: omega^2 with the root held; the same under CENTRIF about z through the root, 100 rad/s,
 * softening in it. */
static const double bar_clamped[] = {0.9847176E+05, 0.2610081E+06, 0.3870457E+07, 0.9669867E+07, 0.1720863E+08,
                                     0.3339644E+08, 0.6240990E+08, 0.7819108E+08, 0.1591499E+09, 0.1975690E+09};
static const double bar_spun[] = {0.1105306E+06, 0.2629779E+06, 0.3934701E+07, 0.9723747E+07,
                                  0.1722138E+08, 0.3358280E+08, 0.6243229E+08};
/* static.dat: mean displacement along z of the tip's nodes under 100 N shared by them. */
static const double bar_deflection = 0.000254052915;

struct bench {
    struct arena *life;
    struct report report;
    struct fe fe;
    struct tie tie[2];
    struct basis basis;
};

static inline void must(enum status status, const struct bench *b)
{
    if (status != OK) fail_msg("%d: %s", status, b->report.text);
}

/* The bar reduced; tip: is there a second interface? */
static inline void bench_make(struct bench *b, const char *job, bool tip, bool rigid, enum basis_method method,
                              int modes)
{
    const struct fe_source source = {.job = job, .units = {1, 1, 1}};
    const struct tie_options options[] = {{.name = "root", .where = "root", .rigid = true},
                                          {.name = "tip", .where = "tip", .rigid = rigid}};
    memset(b, 0, sizeof *b);
    b->life = arena_open();
    must(fe_read(&b->fe, &source, b->life, &b->report), b);
    for (int t = 0; t < 1 + tip; t++) must(tie_make(b->tie + t, options + t, &b->fe, b->life, &b->report), b);
    const struct basis_options want = {.method = method, .modes = modes};
    must(basis_make(&b->basis, &b->fe, b->tie, 1 + tip, &want, b->life, &b->report), b);
}

static inline void bench_end(struct bench *b)
{
    arena_close(b->life);
}

static inline void close_to(double got, double want, double tolerance, const char *what)
{
    if (!(fabs(got - want) <= tolerance)) fail_msg("%s: %.12g, expected %.12g to %.3g", what, got, want, tolerance);
}

#endif
