/* t-blade.c -- blades on a hub that turns: frequencies at speed against the rotating Euler-Bernoulli beam, the time at
 * which they are asked, free vibration in a run, the pull at the root.
 *
 * The rotating beam: Wright, Smith, Thresher & Wang, J. Appl. Mech. 49 (1982) 197, by power series in 60 digits; speeds
 * and frequencies in units of sqrt(EI/(rho A L^4)), hub radii in lengths. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "probe/modes.h"
#include "sim/load.h"
#include "sim/parts.h"

#include <cmocka.h>

struct rotating {
    double hub, speed, flap[3], chord[3];
};
static const struct rotating ROTATING[] = {
    {0,
     0,
     {3.5160152685001513, 22.03449156466677, 61.697214413549105},
     {3.5160152685001513, 22.03449156466677, 61.697214413549105}},
    {0,
     2,
     {4.137319573025358, 22.61492195650405, 62.27318410567162},
     {3.621796964124125, 22.52631117379783, 62.24105926684468}},
    {0,
     3,
     {4.7972785323630776, 23.320263674295944, 62.984967480682776},
     {3.743511896210782, 23.12649341855974, 62.91348129409679}},
    {0,
     6,
     {7.360373019310019, 26.809081678497932, 66.68391438150489},
     {4.263225420193833, 26.129042470867038, 66.4134356680926}},
    {0.1,
     2,
     {4.212247448460872, 22.691219875600922, 62.35315967530267},
     {3.7071590965407895, 22.60290820763705, 62.32107606174488}},
    {0.1,
     3,
     {4.941149876710927, 23.486290355950526, 63.16243967835893},
     {3.926189259844769, 23.2939012336709, 63.09115457908763}},
    {0.1,
     6,
     {7.726027257077404, 27.3796529924755, 67.34618506886655},
     {4.867391208553407, 26.714142284347677, 67.0783768686305}},
    {1,
     2,
     {4.833688871530717, 23.36604204568533, 63.06754812332674},
     {4.400516799963374, 23.2802903951118, 63.03582811614466}},
    {1,
     3,
     {6.081749684998119, 24.927745231135223, 64.73380200988639},
     {5.290338290787719, 24.746565060799547, 64.66424918496442}},
    {1,
     6,
     {10.443865869459815, 32.02724398264489, 72.98633548539627},
     {8.548352724312892, 31.460202750838455, 72.73929589696903}},
};
enum { CASES = sizeof ROTATING / sizeof *ROTATING };

struct opened {
    struct arena *life;
    struct scene *scene;
    struct sim sim;
    struct modes modes;
    struct report report;
};

static void open_deck(struct opened *o, const char *path, int nset, const char *const *set)
{
    const struct deck_options options = {.nset = nset, .set = set};
    const struct sim_options quiet = {.version = "test"};
    *o = (struct opened){.life = arena_open()};
    struct diags *diags = diags_open(o->life);
    enum status status = sim_load(&o->scene, path, &options, diags, o->life, &o->report);
    if (status == OK) status = sim_open(&o->sim, o->scene, &o->scene->integrate, &quiet, diags, o->life, &o->report);
    if (status == OK) return;
    diags_print(stderr, diags, false);
    fail_msg("%s: %s", path, o->report.text);
}

static void find_modes(struct opened *o)
{
    assert_int_equal(modes_find(&o->modes, &o->sim, o->life, &o->report), OK);
}

static void near(double x, double wanted, double within)
{
    if (!(fabs(x - wanted) <= within * fabs(wanted)))
        fail_msg("%.9g, should be %.9g to %g, is %g", x, wanted, within, fabs(x / wanted - 1));
}

/* ---- frequencies at speed ---- */

/* A square rod of 1 m in two planes: flap and chord in pairs.  8 elastic coordinates, as drawn. */
static void test_spatial(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) {
        const struct rotating *c = &ROTATING[k];
        const double h = 0.002, unit = h * sqrt(2.1e11 / 12 / 7850);
        char hub[60], speed[60];
        const char *const set[] = {"bodies.blade.section={rectangle: [0.002, 0.002]}",
                                   "bodies.blade.material={E: 2.1e+11, nu: 0.3, density: 7850}",
                                   "bodies.blade.points={tip: {station: 1}}",
                                   "parameters.F=0",
                                   hub,
                                   speed};
        struct opened o;
        snprintf(hub, sizeof hub, "parameters.r=%.17g", c->hub);
        snprintf(speed, sizeof speed, "parameters.W=%.17g", c->speed * unit);
        open_deck(&o, "decks/rotating-blade.yaml", 6, set);
        find_modes(&o);
        assert_int_equal(o.modes.n, 8);
        for (int i = 0; i < 3; i++) {
            near(o.modes.mode[2 * i].omega / unit, c->chord[i], 2e-3);
            near(o.modes.mode[2 * i + 1].omega / unit, c->flap[i], 2e-3);
        }
        arena_close(o.life);
    }
}

static void write_planar(char *path, const struct rotating *c, double unit, const char *value)
{
    int file = mkstemps(path, 5);
    assert_true(file >= 0);
    FILE *f = fdopen(file, "w");
    fprintf(f,
            "fmdsub: 1\n"
            "parameters: {r: %.17g, W: %.17g}\n"
            "bodies:\n"
            "  hub: {mass: 1, inertia: 1, at: [0, 0]}\n"
            "  blade:\n"
            "    beam: {from: [r, 0], to: [r + 1, 0], elements: 16}\n"
            "    section: {rectangle: [0.002, 0.002]}\n"
            "    material: {E: 2.1e+11, nu: 0.3, density: 7850}\n"
            "    modes: 8\n"
            "constraints:\n"
            "  shaft: {revolute: [ground, hub], at: [0, 0]}\n"
            "  clamp: {fixed: [hub, blade], at: [r, 0]}\n"
            "drives: {spin: {drive: shaft.angle, value: \"%s\"}}\n"
            "integrate: {scheme: midpoint, step: 1.0e-3, until: 3}\n",
            c->hub, c->speed * unit, value);
    fclose(f);
}

/* after: the run goes on to t = 3 s before they are asked. */
static void check_planar(const struct rotating *c, const char *value, bool after)
{
    const double h = 0.002, unit = h * sqrt(2.1e11 / 12 / 7850);
    char path[] = "/tmp/t-blade-XXXXXX.yaml";
    struct opened o;
    write_planar(path, c, unit, value);
    open_deck(&o, path, 0, NULL);
    unlink(path);
    if (after) assert_int_equal(sim_run(&o.sim, NULL, &o.report), OK);
    find_modes(&o);
    for (int i = 0; i < 3; i++) near(o.modes.mode[i].omega / unit, c->chord[i], 2e-3);
    arena_close(o.life);
}

static void test_planar(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) check_planar(&ROTATING[k], "W*t", false);
}

/* The drive's rate is that of the time at which they are asked, and the vibration left from spinning up does not
 * matter: a smooth start over 2 s. */
static void test_time(void **state)
{
    static const char spin_up[] = "if(t < 2, W/2*(t^2/2 + (1/pi)^2*(cos(pi*t) - 1)), W*t - W)";
    (void)state;
    for (int k = 3; k < CASES; k += 3) check_planar(&ROTATING[k], spin_up, true);
    check_planar(&ROTATING[0], spin_up, false);
    check_planar(&(struct rotating){.speed = 6, .chord = {3.5160152685, 22.0344915647, 61.6972144135}}, spin_up, false);
}

/* A round rod about its own axis: seen from the turning frame it swings at w - W and w + W.  It is no case for
 * stiffening, and said to be none (an axis along the body). */
static void test_whirl(void **state)
{
    static const char *const still[] = {"bodies.blade.section={circle: 0.002}", "parameters.r=0",
                                        "constraints.shaft.axis=[1, 0, 0]", "parameters.W=0", "parameters.F=0"};
    static const char *const quick[] = {
        "bodies.blade.section={circle: 0.002}", "parameters.W=5", "parameters.r=0", "constraints.shaft.axis=[1, 0, 0]",
        "bodies.blade.stiffening=false",        "parameters.F=0"};
    struct opened a, b;
    (void)state;
    open_deck(&a, "decks/rotating-blade.yaml", 5, still);
    find_modes(&a);
    open_deck(&b, "decks/rotating-blade.yaml", 6, quick);
    find_modes(&b);
    for (int i = 0; i < 2; i++) {
        near(b.modes.mode[2 * i].omega, a.modes.mode[2 * i].omega - 5, 1e-4);
        near(b.modes.mode[2 * i + 1].omega, a.modes.mode[2 * i].omega + 5, 1e-4);
    }
    for (int i = 1; i < b.sim.model->nbody; i++) {
        const struct model_body *blade = &b.sim.model->body[i];
        if (!blade->flex) continue;
        assert_true(isinf(bent_spin_limit(blade, (const double[]){1, 0, 0})));
        near(bent_spin_limit(blade, (const double[]){0, 0, 1}), a.modes.mode[0].omega, 1e-4);
        near(bent_spin_limit(blade, (const double[]){0, 0.6, 0.8}), a.modes.mode[0].omega, 1e-4);
    }
    arena_close(a.life);
    arena_close(b.life);
}

/* A tapered and twisted blade against itself cut into segments, where the pull of the outer ones on turned inner ones
 * does what second-order displacements do in one frame. */
static void test_segments(void **state)
{
    static const char *const one[] = {"gravity=[0, 0, 0]", "bodies.blade.modes=12", "bodies.blade.beam.elements=24"};
    static const char *const cut[] = {"gravity=[0, 0, 0]",
                                      "bodies.blade.modes=2",
                                      "bodies.blade.beam.elements=24",
                                      "bodies.blade.segments=6",
                                      "constraints.clamp.fixed=[hub, blade1]",
                                      "partition={}"};
    struct opened a, b;
    (void)state;
    open_deck(&a, "decks/turbine-blade.yaml", 3, one);
    find_modes(&a);
    open_deck(&b, "decks/turbine-blade.yaml", 6, cut);
    find_modes(&b);
    for (int i = 0; i < 5; i++) near(a.modes.mode[i].omega, b.modes.mode[i].omega, 5e-4);
    arena_close(a.life);
    arena_close(b.life);
}

/* ---- runs ---- */

static double column(struct opened *o, const char *name)
{
    const struct catalogue *c = &o->sim.catalogue;
    struct sim *s = &o->sim;
    assert_int_equal(record_evaluate(s, ~0u), OK);
    for (int i = 0; i < c->n; i++)
        if (strcmp(c->column[i].name, name) == 0) return record_value(s, &c->origin[i]);
    fail_msg("no column %s", name);
    return 0;
}

/* Started in the first flapping mode, lifted by so little that others hardly move, the run swings at its frequency:
 * the first coordinate's zeros, from its first to its last. */
static void test_vibration(void **state)
{
    static const char *const set[] = {"parameters.W=30", "integrate.step=5.0e-4"};
    struct opened o;
    double from = 0, to = 0, last = 0;
    int zeros = 0;
    (void)state;
    open_deck(&o, "decks/rotating-blade.yaml", 2, set);
    find_modes(&o);
    for (int k = 1; k <= 2000; k++) {
        assert_int_equal(advance(&o.sim, 5e-4, 1, k * 5e-4), OK);
        double x = column(&o, "blade.mode1");
        if (k > 40 && x * last < 0) {
            to = (k - 1 + last / (last - x)) * 5e-4;
            if (zeros++ == 0) from = to;
        }
        last = x;
    }
    assert_true(zeros > 10);
    near(acos(-1) * (zeros - 1) / (to - from), o.modes.mode[0].omega, 2e-3);
    arena_close(o.life);
}

/* A force at a point whose static answers are kept bends the blade at rest exactly, whatever the modes: F L^3/(3 E I) +
 * F L/(k A G) by bending and shear; without them one mode gives less. */
static void test_statics(void **state)
{
    static const char *const kept[] = {"parameters={L: 1, r: 0.1, b: 0.05, h: 0.005, W: 0, F: 0.01}",
                                       "bodies.blade.modes=1",
                                       "bodies.blade.material={E: 2.1e+11, G: 8.0e+10, density: 7850}",
                                       "bodies.blade.section={rectangle: [0.05, 0.005], ky: 0.8, kz: 0.8}"};
    const char *const lost[] = {kept[0], kept[1], kept[2], kept[3], "bodies.blade.points.tip={station: 1}"};
    const double F = 0.01, A = 0.05 * 0.005, I = A * 0.005 * 0.005 / 12;
    const double exact = F / (3 * 2.1e11 * I) + F / (0.8 * A * 8e10);
    struct opened o;
    (void)state;
    open_deck(&o, "decks/rotating-blade.yaml", 4, kept);
    near(column(&o, "blade.tip.dz"), exact, 1e-7);
    arena_close(o.life);
    open_deck(&o, "decks/rotating-blade.yaml", 5, lost);
    near(column(&o, "blade.tip.dz"), exact * 0.9707, 1e-3); /* 12/1.8751^4 of the first mode */
    arena_close(o.life);
}

/* In the equilibrium that turns with the hub the root pulls with W^2 int r dm; the drive has nothing to do. */
static void test_pull(void **state)
{
    static const char *const set[] = {"parameters.F=0", "parameters.W=40"};
    const double m = 7850 * 0.05 * 0.005, pull = 40 * 40 * m * 0.6;
    struct opened o;
    (void)state;
    open_deck(&o, "decks/rotating-blade.yaml", 2, set);
    near(-column(&o, "clamp.fx"), pull, 1e-4);
    assert_true(fabs(column(&o, "clamp.fy")) < 1e-6 * pull && fabs(column(&o, "spin.force")) < 1e-6 * pull);
    arena_close(o.life);
}

/* The turbine blade stands upright: the root carries its weight and pulls it round.  Areas are linear between the
 * stations, int A ds and int A s ds by Simpson's rule, which is exact. */
static void test_weight(void **state)
{
    static const double at[] = {0, 0.3, 0.7, 1}, A[] = {0.20, 0.10, 0.05, 0.015}, L = 30, r = 1.5, W = 2;
    double mass = 0, moment = 0;
    struct opened o;
    (void)state;
    for (int k = 0; k < 3; k++) {
        const double d = L * (at[k + 1] - at[k]), mid = L * (at[k] + at[k + 1]) / 2, mean = (A[k] + A[k + 1]) / 2;
        mass += 1900 * d * mean;
        moment += 1900 * d / 6 * (A[k] * L * at[k] + 4 * mean * mid + A[k + 1] * L * at[k + 1]);
    }
    open_deck(&o, "decks/turbine-blade.yaml", 0, NULL);
    near(column(&o, "clamp.fz"), mass * 9.81 - W * W * (moment + r * mass), 1e-4);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_spatial), cmocka_unit_test(test_planar),    cmocka_unit_test(test_time),
        cmocka_unit_test(test_whirl),   cmocka_unit_test(test_vibration), cmocka_unit_test(test_statics),
        cmocka_unit_test(test_pull),    cmocka_unit_test(test_segments),  cmocka_unit_test(test_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
