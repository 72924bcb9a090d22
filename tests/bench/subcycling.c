/* subcycling.c -- what sub-cycling gains on a deck, against the ideal.
 *
 * Runs the deck's partition with `subcycle` at its ratio n and with the single-rate midpoint rule at the same small
 * step, interleaved, and prints CPU times as ratios.  The ideal is (c_L/n + c_S) / (c_L + c_S) with c_L and c_S the
 * measured cost of one evaluation of the slow and of the fast class; the same of the evaluations alone, which are counted:
 * (S c_L/n + F c_S) / e (c_L + c_S), S slow ones a major step, F fast ones and e of the single rate a minor step.
 * The single rate asks both classes at once, which in loops and chains costs about as much as one of them: what moves is the
 * same.  The last line has the CPU times beside the ideal (c_L/n + c_S) / c of such an evaluation.
 *
 * Then what the evaluations are for, kind by kind: the last column, what each kind costs of the ideal, adds up to what all do.
 *
 *     subcycling DECK [repeats [ratio]]
 *     subcycling DECK 1 RATIO spent C_L C_S
 *                                      that table alone, with prices from elsewhere
 *     subcycling DECK 1 RATIO PART     one part alone, for others to count: slow, fast, all: 2000 evaluations of that class;
 *                                      midpoint, subcycle: the run; open, open-subcycle: what each begins with */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "sim/load.h"
#include "sim/sim.h"

static double least(double a, double b)
{
    return a < b ? a : b;
}

/* Seconds of one evaluation of a class at the start. */
static double evaluation(const struct sim *sim, unsigned cls)
{
    enum { TIMES = 2000 };
    const struct ode2 *o = system_ode2(sim->system);
    double r[512], dk, w[POWER_CHANNELS], from = clock_cpu();
    struct instant x = {.t = 0, .q = sim->x.q, .v = sim->x.v, .a = cls == SLOW ? NULL : sim->x.a};
    for (int i = 0; i < TIMES; i++) (void)o->ops->resid(o, r, w, &dk, &x, cls, NULL);
    return (clock_cpu() - from) / TIMES;
}

struct result {
    double cpu, slow, fast, all; /* seconds: of the run, of one evaluation */
    struct effort effort;
};

/* Cost of the evaluations of a minor step of sub-cycling against one of the single rate. */
static double counted(const struct result *split, const struct result *single, double n, double cL, double cS)
{
    const struct effort *a = &split->effort, *b = &single->effort;
    const double S = (double)a->slow / (double)a->majors, F = (double)a->fast / (double)a->minors;
    return (S * cL / n + F * cS) / ((double)b->slow * (cL + cS) / (double)b->minors);
}

static int run(struct result *o, const struct scene *scene, const char *scheme, struct diags *diags)
{
    struct arena *life = arena_open();
    struct integrate plan = scene->integrate;
    const struct sim_options quiet = {.version = "bench", .general = true};
    struct report report = {0};
    struct sim sim;
    plan.scheme = scheme;
    int failed = sim_open(&sim, scene, &plan, &quiet, diags, life, &report);
    if (!failed) {
        o->slow = least(o->slow, evaluation(&sim, SLOW));
        o->fast = least(o->fast, evaluation(&sim, FAST));
        o->all = least(o->all, evaluation(&sim, ALL));
        failed = sim_run(&sim, NULL, &report);
        o->cpu = least(o->cpu, sim.cpu);
        o->effort = sim.stepper.effort;
    }
    if (failed) diags_print(stderr, diags, false), fprintf(stderr, "%s: %s\n", scheme, report.text);
    arena_close(life);
    return failed;
}

static int part(const struct scene *scene, const char *name, struct diags *diags, struct arena *life)
{
    struct integrate plan = scene->integrate;
    const struct sim_options quiet = {.version = "bench", .general = true};
    struct report report = {0};
    struct sim sim;
    plan.scheme = strstr(name, "subcycle") ? "subcycle" : "midpoint";
    int failed = sim_open(&sim, scene, &plan, &quiet, diags, life, &report);
    if (failed) return diags_print(stderr, diags, false), 1;
    if (strcmp(name, "slow") == 0) evaluation(&sim, SLOW);
    if (strcmp(name, "fast") == 0) evaluation(&sim, FAST);
    if (strcmp(name, "all") == 0) evaluation(&sim, ALL);
    if (strcmp(name, plan.scheme) == 0) failed = sim_run(&sim, NULL, &report);
    return failed != 0;
}

static void print(const char *name, const struct result *o)
{
    const struct effort *e = &o->effort;
    printf("%-9s cpu %.4g s, %ld minor steps, %.3g us a minor step; slow %ld, fast %ld evaluations, %ld "
           "factorizations, %ld sweeps\n",
           name, o->cpu, e->minors, 1e6 * o->cpu / (double)e->minors, e->slow, e->fast, e->factors, e->sweeps);
}

/* A row; returns its last number. */
static double row(const char *name, const struct spent *o, double cL, double cS, double ideal)
{
    const double part = ((double)o->slow * cL + (double)o->fast * cS) / ideal;
    printf("  %-38s %6ld %8ld %8ld %8.3f\n", name, o->times, o->slow, o->fast, part);
    return part;
}

/* What the evaluations of sub-cycling are for, beside the ideal for as many minor steps. */
static void print_spent(const struct result *split, const struct result *single, double n, double cL, double cS)
{
    static const char *const names[SPENT_KINDS] = {"matrices at the start (W, M_s W)",
                                                   "first sweeps",
                                                   "second sweeps, whole",
                                                   "second sweeps, coarse",
                                                   "third and later sweeps, whole",
                                                   "third and later sweeps, coarse",
                                                   "minor steps once more in a sweep"};
    const struct effort *a = &split->effort, *b = &single->effort;
    const double minors = (double)a->minors / (double)b->minors, ideal = (double)b->slow * minors * (cL / n + cS);
    struct spent rest = {1, a->slow, a->fast};
    double sum = 0;
    printf("evaluations of %ld major steps of %g  %12s %8s %8s %8s\n", a->majors, n, "times", "slow", "fast",
           "of ideal");
    for (int i = 0; i < SPENT_KINDS; i++) {
        sum += row(names[i], &a->spent[i], cL, cS, ideal);
        rest.slow -= a->spent[i].slow;
        rest.fast -= a->spent[i].fast;
    }
    sum += row("start of the run, looks at its energy", &rest, cL, cS, ideal);
    printf("  %-38s %6s %8ld %8ld %8.3f\n", "all", "", a->slow, a->fast, sum);
    const double each = (double)b->slow * minors;
    printf("  %-38s %6s %8.0f %8.0f %8.3f\n", "ideal: of the single rate, slow ones / n", "", each / n, each, 1.);
}

int main(int argc, char **argv)
{
    struct arena *life = arena_open();
    struct diags *diags = diags_open(life);
    struct report report = {0};
    struct scene *scene;
    struct result single = {INFINITY, INFINITY, INFINITY, INFINITY, {0}}, split = single;
    int repeats = argc > 2 ? atoi(argv[2]) : 7;
    if (argc < 2 || sim_load(&scene, argv[1], NULL, diags, life, &report) != OK) {
        diags_print(stderr, diags, false);
        fprintf(stderr, "usage: subcycling DECK [repeats]\n%s\n", report.text);
        return 2;
    }
    if (argc > 3) scene->integrate.ratio = atoi(argv[3]);
    const bool counts = argc == 7 && strcmp(argv[4], "spent") == 0;
    if (argc > 4 && !counts) return part(scene, argv[4], diags, life);
    for (int i = 0; i < repeats; i++)
        if (run(&single, scene, "midpoint", diags) || run(&split, scene, "subcycle", diags)) return 1;
    if (counts) {
        print_spent(&split, &single, scene->integrate.ratio, atof(argv[5]), atof(argv[6]));
        return 0;
    }
    double n = scene->integrate.ratio, cL = single.slow, cS = single.fast;
    double ideal = (cL / n + cS) / (cL + cS), ratio = split.cpu / single.cpu;
    print("midpoint", &single);
    print("subcycle", &split);
    const double work = counted(&split, &single, n, cL, cS);
    printf("evaluations: %.3f of single rate, %.2f times the ideal\n", work, work / ideal);
    printf("c_L %.4g us, c_S %.4g us; cost %.3f of single rate (gain %.2f), ideal %.3f, %.2f times the ideal\n",
           1e6 * cL, 1e6 * cS, ratio, 1 / ratio, ideal, ratio / ideal);
    printf("c_L + c_S is %.2f times what the single rate pays, both at once: %.2f times the ideal beside that\n",
           (cL + cS) / single.all, ratio * single.all / (cL / n + cS));
    print_spent(&split, &single, n, cL, cS);
    arena_close(life);
    return 0;
}
