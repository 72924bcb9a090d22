/* selftest.c -- fmdsub selftest: the installed program against references that it has with it, in some seconds
 *
 * Each is a deck and a number known by a closed form; a run whose end is another number, or one of no number at all, is a
 * wrong program, a wrong library of mathematics or a wrong machine. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/clock.h"
#include "cli/cli.h"
#include "sim/sim.h"

#define PENDULUM                                                                                                       \
    "fmdsub: 1\ngravity: [0, -9.81]\nbodies: {bob: {mass: 2, at: [1, 0]}}\n"                                           \
    "constraints: {pin: {revolute: [ground, bob], at: [0, 0]}}\noutput: {columns: [pin.angle]}\n"
#define PARALLELOGRAM                                                                                                  \
    "fmdsub: 1\ngravity: [0, -9.81]\nparameters: {c: cos(pi/6), s: sin(pi/6)}\nbodies:\n"                              \
    "  left: {mass: 1, inertia: 1/12, at: [c/2, -s/2]}\n  right: {mass: 1, inertia: 1/12, at: [2 + c/2, -s/2]}\n"      \
    "  beam: {mass: 1, inertia: 1, at: [1 + c, -s]}\nconstraints:\n"                                                   \
    "  a: {revolute: [ground, left], at: [0, 0]}\n  b: {revolute: [ground, right], at: [2, 0]}\n"                      \
    "  d: {revolute: [left, beam], at: [c, -s]}\n  e: {revolute: [right, beam], at: [2 + c, -s]}\n"                    \
    "output: {columns: [a.angle]}\n"
#define PAIR                                                                                                           \
    "fmdsub: 1\nbodies: {cart: {mass: 1, inertia: 1, at: [0, 0]}, rider: {mass: 0.5, inertia: 1, at: [0, 0]}}\n"       \
    "constraints:\n  rail: {prismatic: [ground, cart], axis: [1, 0], at: [0, 0]}\n"                                    \
    "  slot: {prismatic: [cart, rider], axis: [1, 0], at: [0, 0]}\n"                                                   \
    "forces: {soft: {spring: rail, stiffness: 1}, stiff: {spring: slot, stiffness: 200}}\n"                            \
    "partition: {fast: [slot]}\ninitial: {rail.displacement: 0.1, slot.displacement: 0.01}\n"                          \
    "output: {columns: [rail.displacement]}\n"
#define CRANK                                                                                                          \
    "fmdsub: 1\nbodies:\n  crank: {mass: 1, inertia: 0.01, at: [0.075, 0]}\n"                                          \
    "  rod: {mass: 1, inertia: 0.01, at: [0.325, 0]}\n  slider: {mass: 1, at: [0.5, 0]}\nconstraints:\n"               \
    "  shaft: {revolute: [ground, crank], at: [0, 0]}\n  elbow: {revolute: [crank, rod], at: [0.15, 0]}\n"             \
    "  wrist: {revolute: [rod, slider], at: [0.5, 0]}\n"                                                               \
    "  rail: {prismatic: [ground, slider], at: [0.5, 0], axis: [1, 0]}\n"                                              \
    "drives: {motor: {drive: shaft, value: 2.5*t}}\noutput: {columns: [slider.x]}\n"
#define TOP                                                                                                            \
    "fmdsub: 1\nbodies: {top: {mass: 1, at: [0, 0, 0], inertia: [1, 1, 2]}}\n"                                         \
    "constraints: {float: {free: [ground, top], at: [0, 0, 0]}}\n"                                                     \
    "initial: {float.omega: {value: [0.5, 0, 3], frame: body}}\noutput: {columns: [float.omega_x]}\n"
#define CANTILEVER                                                                                                     \
    "fmdsub: 1\nbodies:\n  arm:\n    beam: {from: [0, 0], to: [1, 0], elements: 10}\n"                                 \
    "    section: {rectangle: [0.03, 0.01]}\n    material: {E: 2.0e+11, density: 7850}\n    modes: 12\n"               \
    "    points: {tip: {station: 1}}\nconstraints: {clamp: {fixed: [ground, arm], at: [0, 0]}}\n"                      \
    "forces: {pull: {force: arm.tip, value: [0, 20]}}\ninitial: {static: true}\noutput: {columns: [arm.tip.dy]}\n"
#define BRAKED                                                                                                         \
    "fmdsub: 1\nbodies: {car: {mass: 2, at: [0, 0]}}\n"                                                                \
    "constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}\nforces: {brake: {damper: rail, damping: 3}}\n"     \
    "initial: {rail.displacement_rate: 5}\noutput: {columns: [rail.displacement_rate]}\n"

/* Times of a quarter of a swing: 2 K(k)/w; of 90 degrees to both sides with w^2 = g, of 60 with w^2 = 1.2 g. */
static const struct reference {
    const char *what, *deck, *integrate;
    double is, within;
} references[] = {
    {"pendulum, a quarter of a swing of 90 degrees, dopri5", PENDULUM,
     "{scheme: dopri5, tolerance: 1.0e-10, until: 0.5919604868940592}", -1.57079632679489662, 1e-7},
    {"the same, newmark", PENDULUM, "{scheme: newmark, step: 1.0e-4, until: 0.5919604868940592}", -1.57079632679489662,
     1e-6},
    {"parallelogram, a quarter of a swing of 60 degrees, radau5", PARALLELOGRAM,
     "{scheme: radau5, tolerance: 1.0e-9, until: 0.4913241743882828}", -1.04719755119659775, 1e-7},
    {"the same, generalized-alpha", PARALLELOGRAM,
     "{scheme: generalized-alpha, step: 2.0e-4, until: 0.4913241743882828}", -1.04719755119659775, 1e-6},
    {"a rider on a cart, subcycle 10:1", PAIR, "{scheme: subcycle, step: 1.0e-4, ratio: 10, until: 2}",
     -0.007369211857475519, 1e-6},
    {"the same, miao 2:1, little time", PAIR, "{scheme: miao, step: 1.0e-5, ratio: 2, until: 0.02}",
     0.10037218346909627, 1e-7},
    {"slider-crank on a drive", CRANK, "{scheme: midpoint, step: 1.0e-2, until: 1}", 0.21812004725667747, 1e-10},
    {"free symmetric top, midpoint", TOP, "{scheme: midpoint, step: 1.0e-3, until: 1}", -0.4949962483002227, 1e-5},
    {"cantilever under a load at its tip", CANTILEVER, "{scheme: midpoint, step: 1.0e-3, until: 0.01}",
     0.013333333333333334, 2e-6},
    {"car with a brake, rk4", BRAKED, "{scheme: rk4, step: 1.0e-2, until: 1}", 1.115650800742149, 1e-8},
};

/* A text as a file that sim_load() can read. */
static enum status hold_text(char *path, size_t size, int *fd, const char *text, const char *integrate,
                             struct report *report)
{
    *fd = memfd_create("fmdsub", MFD_CLOEXEC);
    if (*fd < 0 || dprintf(*fd, "%sintegrate: %s\n", text, integrate) < 0)
        return fail(report, E_FILE, "no place for a deck in memory");
    snprintf(path, size, "/proc/self/fd/%d", *fd);
    return OK;
}

/* Where the deck's own column stands at the end. */
static enum status run_deck(double *x, const char *path, struct arena *life, struct report *report)
{
    struct sim sim;
    struct scene *scene;
    struct diags *diags = diags_open(life);
    const struct sim_options options = {.version = FMDSUB_VERSION};
    TRY(sim_load(&scene, path, NULL, diags, life, report));
    TRY(sim_open(&sim, scene, &scene->integrate, &options, diags, life, report));
    TRY(sim_run(&sim, NULL, report));
    double *row = TAKE(life, double, sim.chosen.n);
    TRY(sim_row(row, &sim, sim.x.q, sim.x.v, report));
    *x = row[sim.chosen.n - 1];
    return OK;
}

static enum status run_text(double *x, const char *deck, const char *integrate, struct report *report)
{
    char path[40];
    int fd;
    struct arena *life = arena_open();
    enum status status = hold_text(path, sizeof path, &fd, deck, integrate, report);
    if (status == OK) status = run_deck(x, path, life, report);
    if (fd >= 0) close(fd);
    arena_close(life);
    return status;
}

/* A deck that is wrong is refused. */
static bool refuses(void)
{
    double x;
    struct report report = {0};
    return run_text(&x, "fmdsub: 1\nbodies: {bob: {mass: -2}}\n", "{step: 1.0e-3, until: 1}", &report) == E_DECK;
}

static bool passes(const struct reference *r, bool quiet)
{
    struct report report = {0};
    double x = NAN, begun = clock_cpu();
    const enum status status = run_text(&x, r->deck, r->integrate, &report);
    const bool good = status == OK && fabs(x - r->is) <= r->within;
    if (!quiet || !good)
        printf("%-8s %-58s %.12g, off by %.1e of %.0e, %.2f s%s%s\n", good ? "ok" : "not ok", r->what, x,
               fabs(x - r->is), r->within, clock_cpu() - begun, *report.text ? ": " : "", report.text);
    return good;
}

enum status verb_selftest(const struct request *request, struct arena *life, struct report *report)
{
    int wrong = 0;
    const int n = (int)(sizeof references / sizeof *references) + 1;
    (void)life;
    if (request->nword) return fail(report, E_USAGE, "'fmdsub selftest' takes no argument");
    for (int i = 0; i < n - 1; i++) wrong += !passes(&references[i], request->quiet);
    const bool refused = refuses();
    if (!refused || !request->quiet) printf("%-8s a wrong deck is refused\n", refused ? "ok" : "not ok");
    wrong += !refused;
    if (wrong)
        return fail(report, E_BUG,
                    "%d of %d references are not met: this program, its libraries or the machine is wrong", wrong, n);
    return OK;
}
