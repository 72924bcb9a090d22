/* stability.c -- see stability.h */
#include "study/stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/stop.h"
#include "multirate/schemes.h"
#include "probe/growth.h"
#include "probe/modes.h"

static const double LITTLE = 1e-6; /* growth below: round-off where eigenvalues are equal */
static const double COARSE = .5;   /* exponent of the motion itself over a step, from which on no scheme follows it */

/* ---- what is tried --------------------------------------------------------------------------------------------- */

struct grid {
    const struct stepper_kind *scheme[32];
    int nscheme;
    int ratio[64];
    int nratio;
    double step[128];
    int nstep;
};

/* The deck's own first; then those of fixed steps that serve the deck: of two rates where there are two. */
static void choose_schemes(struct grid *g, const struct sim *sim, const struct stability_options *options)
{
    const bool two = sim->stepper.ode->ns > 0;
    for (int i = 0; i < options->nscheme; i++) g->scheme[g->nscheme++] = options->scheme[i];
    for (int i = 0; stepper_kinds[i] && options->nscheme == 0; i++) {
        const struct stepper_kind *k = stepper_kinds[i];
        if (!k->adaptive && (two || !k->two_rates)) g->scheme[g->nscheme++] = k;
    }
}

static void choose_ratios(struct grid *g, const struct sim *sim, const struct stability_options *options)
{
    static const int usual[] = {2, 5, 10, 20};
    const int own = sim->plan.ratio;
    for (int i = 0; i < options->nratio; i++) g->ratio[g->nratio++] = options->ratio[i];
    for (size_t i = 0; i < sizeof usual / sizeof *usual && options->nratio == 0; i++) {
        if (own > 1 && own < usual[i] && (i == 0 || own > usual[i - 1])) g->ratio[g->nratio++] = own;
        g->ratio[g->nratio++] = usual[i];
    }
    if (options->nratio == 0 && own > 20) g->ratio[g->nratio++] = own;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* From omega h = 0.05 of the quickest coordinate to 20, and around the deck's own step. */
static void choose_steps(struct grid *g, const struct stability *o, const struct stability_options *options)
{
    const double own = o->sim->plan.step, top = fmax(o->fast_top, o->slow_top);
    const int n = o->classes.n <= 12 ? 61 : o->classes.n <= 40 ? 25 : 13;
    for (int i = 0; i < options->nstep; i++) g->step[g->nstep++] = options->step[i];
    if (options->nstep > 0) return;
    const double from = fmin(top > 0 ? .05 / top : own / 8, own > 0 ? own / 4 : INFINITY);
    const double to = fmax(top > 0 ? 20 / top : own * 8, own > 0 ? own * 4 : 0);
    for (int i = 0; i < n; i++) g->step[g->nstep++] = from * pow(to / from, i / (n - 1.));
    if (own > 0) g->step[g->nstep++] = own;
    qsort(g->step, (size_t)g->nstep, sizeof *g->step, ascending);
}

/* ---- what is found --------------------------------------------------------------------------------------------- */

static void fill(struct stability_row *r, struct stability *o, const struct step_options *options)
{
    struct growth growth;
    struct trouble why = {0};
    const double H = r->step * r->ratio;
    r->own = exp(o->own * H);
    r->known = growth_find(&growth, &o->classes.ode, r->kind, options, r->step, r->ratio, &why) == OK;
    if (!r->known) return;
    r->radius = growth.radius;
    r->coarse = o->own * H > COARSE;
    r->grows = !r->coarse && log(growth.radius) > LITTLE + 1.2 * o->own * H;
    r->frequency = growth.angle > 1e-9 ? growth.angle / H : 0;
    r->most = sim_coordinate_name(o->sim, growth.most);
}

/* The deck's options for a scheme that reads them; what others do not know is left out. */
static struct step_options options_for(const struct sim *sim, const struct stepper_kind *kind)
{
    struct step_options o = *(const struct step_options *)sim->plan.options;
    const struct key *rho = key_find(kind->keys, "rho_infinity");
    if (!rho) o.rho_infinity = 1;
    o.iteration = ITERATION_NEWTON;
    return o;
}

/* Once: a scheme of two rates may be another one at the ratio 1. */
static void add_rows(struct stability *o, const struct grid *g, const struct stepper_kind *kind, int ratio)
{
    const struct step_options options = options_for(o->sim, kind);
    for (const struct stability_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->kind == kind && r->ratio == ratio) return;
    for (int i = 0; i < g->nstep && !stop; i++) {
        struct stability_row *r = &o->row[o->nrow++];
        *r = (struct stability_row){.kind = kind, .step = g->step[i], .ratio = ratio, .most = ""};
        fill(r, o, &options);
    }
}

static void add_scheme(struct stability *o, const struct grid *g, const struct stepper_kind *kind)
{
    if (!kind->two_rates) add_rows(o, g, kind, 1);
    for (int i = 0; i < g->nratio && kind->two_rates; i++)
        add_rows(o, g, g->ratio[i] == 1 && kind->single ? kind->single : kind, g->ratio[i]);
}

/* Frequencies of the quickest coordinates; those of growth too. */
static enum status look(struct stability *o, const struct sim *sim, struct arena *life, struct report *report)
{
    struct modes modes;
    struct trouble why = {0};
    TRY(modes_find(&modes, sim, life, report));
    if (classes_find(&o->classes, sim, life, &why) != OK)
        return fail(report, E_NUMERIC, "no linearisation at t = %g s: the residual is not a number", sim->x.t);
    o->fast_top = modes.fast_worst >= 0 ? modes.fast_top : 0;
    o->slow_top = modes.slow_worst >= 0 ? modes.slow_top : 0;
    o->own = growth_own(&o->classes.ode);
    if (stop) return stop_status();
    if (isnan(o->own)) return fail(report, E_NUMERIC, "no eigenvalues at t = %g s: no convergence", sim->x.t);
    return OK;
}

enum status stability_find(struct stability *o, const struct sim *sim, const struct stability_options *options,
                           struct arena *life, struct report *report)
{
    struct grid *g = TAKE(life, struct grid, 1);
    const int n = sim->stepper.ode->n;
    if (n > STABILITY_MOST)
        return fail(report, E_LIMIT, "stability of more than %d freedoms: this deck has %d", STABILITY_MOST, n);
    if (n == 0) return fail(report, E_MODEL, "no coordinate of this deck moves freely: there is nothing to grow");
    *o = (struct stability){.sim = sim};
    TRY(look(o, sim, life, report));
    choose_schemes(g, sim, options);
    choose_ratios(g, sim, options);
    choose_steps(g, o, options);
    o->row = TAKE(life, struct stability_row, g->nscheme * g->nratio * g->nstep);
    for (int i = 0; i < g->nscheme; i++) add_scheme(o, g, g->scheme[i]);
    return stop_status();
}

/* ---- what is read off ------------------------------------------------------------------------------------------ */

static bool together(const struct stability_row *a, const struct stability_row *b)
{
    return a->kind == b->kind && a->ratio == b->ratio;
}

int stability_band(const struct stability *o, int i)
{
    int end = i + 1;
    const struct stability_row *r = &o->row[i];
    while (end < o->nrow && together(r, r + (end - i)) && o->row[end].grows == r->grows &&
           o->row[end].known == r->known && o->row[end].step >= o->row[end - 1].step)
        end++;
    return end;
}

const char *stability_verdict(const struct stability_row *r)
{
    return !r->known ? "no step" : r->coarse ? "coarse" : r->grows ? "unstable" : "stable";
}

double stability_fast(const struct stability *o, const struct stability_row *r)
{
    return o->fast_top * r->step;
}

double stability_slow(const struct stability *o, const struct stability_row *r)
{
    return o->slow_top * r->step * (r->kind->two_rates ? r->ratio : 1);
}
