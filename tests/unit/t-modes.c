/* t-modes.c -- frequencies of small motions against closed forms. */
#include "probe/modes.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "probe/damped_mode.h"
#include "sim/load.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

struct opened {
    struct arena *life;
    struct scene *scene;
    struct sim sim;
    struct modes modes;
};

static void find(struct opened *o, const char *path, int nset, const char *const *set)
{
    struct report report = {0};
    const struct deck_options options = {.nset = nset, .set = set};
    const struct sim_options quiet = {.version = "test"};
    o->life = arena_open();
    struct diags *diags = diags_open(o->life);
    assert_int_equal(sim_load(&o->scene, path, &options, diags, o->life, &report), OK);
    assert_int_equal(sim_open(&o->sim, o->scene, &o->scene->integrate, &quiet, diags, o->life, &report), OK);
    assert_int_equal(modes_find(&o->modes, &o->sim, o->life, &report), OK);
}

static void near(double x, double wanted, double relative)
{
    if (!(fabs(x - wanted) <= relative * fabs(wanted))) print_error("%.12g, wanted %.12g\n", x, wanted);
    assert_true(fabs(x - wanted) <= relative * fabs(wanted));
}

/* sqrt(k / m) along the rod; the rod turns freely. */
static void test_slider(void **state)
{
    struct opened o;
    (void)state;
    find(&o, "decks/bar-slider.yaml", 0, NULL);
    assert_int_equal(o.modes.n, 2);
    near(o.modes.mode[1].omega, sqrt(1000. / 5), 1e-6);
    assert_true(o.modes.mode[0].omega < 1e-3);
    near(o.modes.mode[1].fast, 1, 1e-6);
    near(o.modes.fast_top, sqrt(1000. / 5), 1e-6);
    arena_close(o.life);
}

/* Two equal uniform rods hanging: with lambda = w^2 L / g, 7 lambda^2 - 42 lambda + 27 = 0, that is
 * lambda = 3 +- 6 / sqrt(7) (m, L of the rods cancel). */
static void test_double_pendulum(void **state)
{
    static const char *const hanging[] = {"initial={pin1.angle: -1.5707963267948966}"};
    struct opened o;
    (void)state;
    find(&o, "decks/double-pendulum.yaml", 1, hanging);
    near(o.modes.mode[0].omega, sqrt(9.81 * (3 - 6 / sqrt(7))), 1e-6);
    near(o.modes.mode[1].omega, sqrt(9.81 * (3 + 6 / sqrt(7))), 1e-6);
    arena_close(o.life);
}

/* Upright it is unstable both ways: growth rates. */
static void test_upright(void **state)
{
    static const char *const upright[] = {"initial={pin1.angle: 1.5707963267948966}"};
    struct opened o;
    (void)state;
    find(&o, "decks/double-pendulum.yaml", 1, upright);
    near(o.modes.mode[0].omega, -sqrt(9.81 * (3 + 6 / sqrt(7))), 1e-6);
    near(o.modes.mode[1].omega, -sqrt(9.81 * (3 - 6 / sqrt(7))), 1e-6);
    arena_close(o.life);
}

/* The suggestion resolves what it names. */
static void test_suggestion(void **state)
{
    struct opened o;
    double h;
    int ratio;
    (void)state;
    find(&o, "decks/stiff-leaf-chain.yaml", 0, NULL);
    modes_suggest(&h, &ratio, &o.modes, &o.sim);
    assert_true(h * o.modes.fast_top <= 0.1 && h * o.modes.fast_top >= 0.04);
    assert_true(ratio > 1 && h * ratio * o.modes.slow_top <= 0.1 + 1e-12);
    arena_close(o.life);
}

/* A carriage of mass m1 on a spring along x of a disk that turns at W, on it a bob of mass m2 on a spring and a damper
 * along y.  With a = m1 + m2, k1 and k2 less a W^2 and m2 W^2:
 *
 *     (k1 - a w^2)(k2 - m2 w^2) = 4 W^2 m2^2 w^2,
 *
 * and by the derivative of the characteristic polynomial, to first order in the damper c, the rate of decay
 *
 *     s = c (k1 - a w^2) / (2 a (k2 - m2 w^2) + 2 m2 (k1 - a w^2) + 8 W^2 m2^2). */
static void on_disk(struct opened *o, const char *speed)
{
    static const char deck[] = "fmdsub: 1\n"
                               "parameters: {W: 0}\n"
                               "bodies:\n"
                               "  disk: {mass: 1, inertia: 1, at: [0, 0]}\n"
                               "  carriage: {mass: 2, inertia: 1, at: [0, 0]}\n"
                               "  bob: {mass: 3, inertia: 1, at: [0, 0]}\n"
                               "constraints:\n"
                               "  shaft: {revolute: [ground, disk], at: [0, 0]}\n"
                               "  along: {prismatic: [disk, carriage], at: [0, 0], axis: [1, 0]}\n"
                               "  across: {prismatic: [carriage, bob], at: [0, 0], axis: [0, 1]}\n"
                               "forces:\n"
                               "  one: {spring: along, stiffness: 500}\n"
                               "  two: {spring: across, stiffness: 700, damping: 0.4}\n"
                               "drives: {spin: {drive: shaft.angle, value: W*t}}\n"
                               "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n";
    char path[] = "/tmp/t-modes-XXXXXX.yaml";
    int file = mkstemps(path, 5);
    assert_true(file >= 0);
    assert_int_equal(write(file, deck, sizeof deck - 1), sizeof deck - 1);
    close(file);
    find(o, path, 1, &speed);
    unlink(path);
}

static void test_gyroscopic(void **state)
{
    (void)state;
    const double W = 7, a = 5, m = 3, k1 = 500 - a * W * W, k2 = 700 - m * W * W, c = 0.4;
    struct opened o;
    double p = k1 / a, q = k2 / m, sum = p + q + 4 * W * W * m / a, root = sqrt(sum * sum - 4 * p * q);
    on_disk(&o, "parameters.W=7");
    assert_int_equal(o.modes.n, 2);
    for (int i = 0; i < 2; i++) {
        double w2 = (sum + (i ? root : -root)) / 2, x = k1 - a * w2, y = k2 - m * w2;
        double decay = c * x / (2 * a * y + 2 * m * x + 8 * W * W * m * m);
        near(o.modes.mode[i].omega, sqrt(w2), 1e-7);
        near(o.modes.mode[i].damping, decay / sqrt(w2), 1e-6);
        near(o.modes.mode[i].share[0] + o.modes.mode[i].share[1], 1, 1e-9);
    }
    arena_close(o.life);
}

/* Faster than the springs can hold: the roots of
 *
 *     (k1 + a s^2)(k2 + c s + m s^2) + 4 W^2 m^2 s^2 = 0,
 *
 * with one spring too weak a growth, with both gyroscopic forces hold the bob, and the damper drives it out. */
static void test_fast_disk(void **state)
{
    static const double speed[] = {12, 20}, a = 5, m = 3, c = 0.4;
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double W = speed[k], k1 = 500 - a * W * W, k2 = 700 - m * W * W;
        char set[40];
        struct opened o;
        snprintf(set, sizeof set, "parameters.W=%g", W);
        on_disk(&o, set);
        assert_int_equal(o.modes.n, 2);
        for (int i = 0; i < 2; i++) {
            const double w = o.modes.mode[i].omega, z = o.modes.mode[i].damping;
            const double complex s = w < 0 ? -w : w * (-z + I * sqrt(1 - z * z));
            const double complex p = k1 + a * s * s, q = k2 + c * s + m * s * s, turn = 4 * W * W * m * m * s * s;
            assert_true(cabs(p * q + turn) < 1e-6 * (cabs(p * q) + cabs(turn)));
        }
        if (k == 0)
            assert_true(o.modes.mode[0].omega < 0);
        else
            assert_true(o.modes.mode[0].omega > 0 && o.modes.mode[0].damping < 0);
        arena_close(o.life);
    }
}

/* Beck's column, clamped, with a force p EI/L^2 along its tip, Q. Appl. Math. 5 (1952): with frequencies w in units of
 * sqrt(EI/(rho A L^4)) and a, b = sqrt(sqrt(p^2/4 + w^2) +- p/2),
 *
 *     p^2 + 2 w^2 + p w sin a sinh b + 2 w^2 cos a cosh b = 0,
 *
 * two of which meet at p = 20.05. */
static double beck(double p, double w)
{
    const double root = sqrt(p * p / 4 + w * w), a = sqrt(root + p / 2), b = sqrt(root - p / 2);
    return p * p + 2 * w * w + p * w * sin(a) * sinh(b) + 2 * w * w * cos(a) * cosh(b);
}

static void column(struct opened *o, double p)
{
    static const char deck[] = "fmdsub: 1\n"
                               "parameters: {p: 0, EI: 350}\n"
                               "bodies:\n"
                               "  column:\n"
                               "    beam: {from: [0, 0], to: [0, 1], elements: 16, rotary: false}\n"
                               "    section: {rectangle: [0.02, 0.01]}\n"
                               "    material: {E: 2.1e+11, nu: 0.3, density: 7850}\n"
                               "    modes: 10\n"
                               "    points: {tip: {station: 1, static: true}}\n"
                               "constraints: {clamp: {fixed: [ground, column], at: [0, 0]}}\n"
                               "forces: {push: {force: column.tip, value: [-p*EI, 0], frame: body}}\n"
                               "integrate: {scheme: midpoint, step: 1.0e-4, until: 1}\n";
    char path[] = "/tmp/t-modes-XXXXXX.yaml", set[40];
    const char *const sets[] = {set};
    int file = mkstemps(path, 5);
    assert_true(file >= 0);
    assert_int_equal(write(file, deck, sizeof deck - 1), sizeof deck - 1);
    close(file);
    snprintf(set, sizeof set, "parameters.p=%g", p);
    find(o, path, 1, sets);
    unlink(path);
}

static void test_follower(void **state)
{
    static const double load[] = {1, 5, 10, 15, 19};
    const double unit = sqrt(350 / (7850 * 2e-4));
    struct opened o;
    (void)state;
    for (int k = 0; k < 5; k++) {
        column(&o, load[k]);
        for (int i = 0; i < 2; i++) {
            const double w = o.modes.mode[i].omega / unit;
            assert_true(beck(load[k], w * (1 - 2e-4)) * beck(load[k], w * (1 + 2e-4)) < 0);
            assert_true(o.modes.mode[i].damping == 0);
        }
        arena_close(o.life);
    }
    column(&o, 20.5);
    near(o.modes.mode[0].omega, o.modes.mode[1].omega, 1e-9);
    near(o.modes.mode[0].damping, -o.modes.mode[1].damping, 1e-9);
    assert_true(o.modes.mode[0].damping < -0.05);
    arena_close(o.life);
}

/* A disc on the end of a shaft of next to no mass that a drive turns at W; seen from the shaft w appears as W - w:
 *
 *     (k11 - m w^2)(k22 - It w^2 + Ip W w) = k12^2,   k = EI/L^3 [12, -6 L; -6 L, 4 L^2],   torsion GJ/(L Ip).
 *
 * The frequencies of the shaft itself lie five to eight decades higher. */
static double whirl(double w)
{
    const double EI = 210e9 * 3.14159265358979323846 * 1e-8 / 4, W = 600;
    return ((12 * EI - w * w) * (4 * EI - 0.01 * w * w + 0.02 * W * w) - 36 * EI * EI) / (EI * EI);
}

/* A file of that text; its name stays in `path`. */
static void written(char *path, const char *text)
{
    strcpy(path, "/tmp/t-modes-XXXXXX.yaml");
    const int file = mkstemps(path, 5);
    assert_true(file >= 0);
    assert_int_equal(write(file, text, strlen(text)), (int)strlen(text));
    close(file);
}

static void whirls(const struct modes *o)
{
    near(o->mode[0].omega, sqrt(210e9 / 2.6 * 3.14159265358979323846 * 1e-8 / 2 / 0.02), 1e-5);
    for (int i = 1; i < 5; i++) {
        const double w = o->mode[i].omega, off = 1e-5;
        const bool slow = whirl(600 - w * (1 - off)) * whirl(600 - w * (1 + off)) < 0;
        assert_true(slow || whirl(600 + w * (1 - off)) * whirl(600 + w * (1 + off)) < 0);
        assert_true(fabs(o->mode[i].damping) < 1e-9);
        if (i > 1) assert_true(w > 1.02 * o->mode[i - 1].omega);
    }
    assert_true(o->mode[6].omega > 1e6);
}

/* The disc as a body of its own, and as a mass on the beam, whose upper modes then move no node of the deck. */
static void test_massless_shaft(void **state)
{
    static const char *const density[] = {"parameters.rho=1.0e-3", "parameters.rho=1.0e-6", "parameters.rho=1.0e-9"};
    static const char *const count[] = {"bodies.shaft.modes=4", "bodies.shaft.modes=9", "bodies.shaft.modes=12",
                                        "bodies.shaft.modes=20"};
    static const char head[] = "fmdsub: 1\n"
                               "parameters: {rho: 1}\n"
                               "drives: {spin: {drive: root.angle, value: \"600*t\"}}\n"
                               "integrate: {scheme: newmark, step: 1.0e-4, until: 0.1}\n"
                               "bodies:\n"
                               "  shaft:\n"
                               "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 20, shear: false}\n"
                               "    section: {circle: 0.01}\n"
                               "    material: {E: 210.0e+9, nu: 0.3, density: rho}\n"
                               "    modes: 4\n"
                               "    points: {tip: {station: 1, static: true}}\n";
    static const char *const disc[] = {
        "  disc: {mass: 1, inertia: [0.02, 0.01, 0.01], at: [1, 0, 0]}\n"
        "constraints:\n"
        "  root: {revolute: [ground, shaft], at: [0, 0, 0], axis: [1, 0, 0]}\n"
        "  hold: {fixed: [shaft, disc], at: [1, 0, 0]}\n",
        "    masses: {disc: {station: 1, mass: 1, inertia: [0.02, 0.01, 0.01]}}\n"
        "constraints:\n"
        "  root: {revolute: [ground, shaft], at: [0, 0, 0], axis: [1, 0, 0]}\n",
    };
    char path[40], deck[2000];
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        snprintf(deck, sizeof deck, "%s%s", head, disc[kind]);
        written(path, deck);
        for (int k = 0; k < 12; k++) {
            const char *const set[] = {density[k / 4], count[k % 4]};
            struct opened o;
            if (kind == 0 && k > 9) continue; /* refused: the shaft's mass is round-off beside the disc's */
            find(&o, path, 2, set);
            whirls(&o.modes);
            if (kind == 0 ? !(o.modes.doubt > 1e-11 * pow(10, 3 * (k / 4))) : !(o.modes.doubt < 1e-12))
                fail_msg("%d %d %g", kind, k, o.modes.doubt);
            arena_close(o.life);
        }
        unlink(path);
    }
}

static bool holds(const struct modes *o, double omega)
{
    bool found = false;
    for (int i = 0; i < o->n; i++) found = found || fabs(o->mode[i].omega - omega) <= 1e-5 * omega;
    return found;
}

/* A disc in the middle of a shaft of next to no mass between two bearings that hold its ends straight: w^2 = 192 EI/L^3
 * across, seen from the shaft, which turns at W, |W - w| and W + w; in torsion 2 GJ/(L Ip). */
static void test_two_bearings(void **state)
{
    static const char *const density[] = {"parameters.rho=1.0e-3", "parameters.rho=1.0e-6"};
    static const char *const count[] = {"bodies.shaft.modes=4", "bodies.shaft.modes=9", "bodies.shaft.modes=13",
                                        "bodies.shaft.modes=18"};
    const double EI = 210e9 * 3.14159265358979323846 * 1e-8 / 4;
    char path[40];
    (void)state;
    written(path, "fmdsub: 1\n"
                  "parameters: {rho: 1}\n"
                  "bodies:\n"
                  "  shaft:\n"
                  "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 20, shear: false}\n"
                  "    section: {circle: 0.01}\n"
                  "    material: {E: 210.0e+9, nu: 0.3, density: rho}\n"
                  "    modes: 4\n"
                  "    masses: {disc: {station: 0.5, mass: 1, inertia: [0.02, 0.01, 0.01]}}\n"
                  "    points: {middle: {station: 0.5, static: true}}\n"
                  "constraints:\n"
                  "  root: {revolute: [ground, shaft], at: [0, 0, 0], axis: [1, 0, 0]}\n"
                  "  far: {cylindrical: [ground, shaft], at: [1, 0, 0], axis: [1, 0, 0]}\n"
                  "drives: {spin: {drive: root.angle, value: \"600*t\"}}\n"
                  "integrate: {scheme: newmark, step: 1.0e-4, until: 0.1}\n");
    for (int k = 0; k < 8; k++) {
        const char *const set[] = {density[k / 4], count[k % 4]};
        struct opened o;
        find(&o, path, 2, set);
        assert_true(holds(&o.modes, fabs(600 - sqrt(192 * EI))));
        assert_true(holds(&o.modes, 600 + sqrt(192 * EI)));
        assert_true(holds(&o.modes, sqrt(2 * 210e9 / 2.6 * 3.14159265358979323846 * 1e-8 / 2 / 0.02)));
        for (int i = 0; i < o.modes.n; i++) assert_true(o.modes.mode[i].omega >= 0 && o.modes.mode[i].damping > -1e-9);
        arena_close(o.life);
    }
    unlink(path);
}

/* A slow slider of frequency w and, unless f is 0, a fast one of f: a tenth of the period over 2 pi, down to halves of the first
 * figure, at most a hundredth of the run; at most 50 small steps in a large one. */
static void suggested(double w, double f, double until, double h, int ratio)
{
    char deck[1500], path[40], fast[300] = "", spring[100] = "";
    struct opened o;
    double got;
    int times;
    if (f > 0) {
        snprintf(fast, sizeof fast, "  rail: {prismatic: [ground, light], axis: [1, 0]}\n");
        snprintf(spring, sizeof spring, "  stiff: {spring: rail, stiffness: %.17g}\npartition: {fast: [rail]}\n",
                 2 * f * f);
    }
    snprintf(deck, sizeof deck,
             "fmdsub: 1\nbodies:\n  heavy: {mass: 4, inertia: 1, at: [0, 0]}\n%s"
             "constraints:\n  way: {prismatic: [ground, heavy], axis: [1, 0]}\n%s"
             "forces:\n  soft: {spring: way, stiffness: %.17g}\n%s"
             "integrate: {scheme: %s, step: 1.0e-6, until: %g}\n",
             f > 0 ? "  light: {mass: 2, inertia: 1, at: [0, 0]}\n" : "", fast, 4 * w * w, spring,
             f > 0 ? "subcycle, ratio: 2" : "midpoint", until);
    written(path, deck);
    find(&o, path, 0, NULL);
    unlink(path);
    assert_int_equal(o.modes.n, f > 0 ? 2 : 1);
    near(o.modes.slow_top, w, 1e-6);
    modes_suggest(&got, &times, &o.modes, &o.sim);
    near(got, h, 1e-12);
    assert_int_equal(times, ratio);
    arena_close(o.life);
}

static void test_suggested(void **state)
{
    (void)state;
    suggested(10.001, 0, 100, 9.5e-3, 1);
    suggested(9.999, 0, 100, 1e-2, 1);
    suggested(2.71, 0, 100, 3.5e-2, 1); /* 3.69e-2 */
    suggested(2.51, 0, 100, 3.5e-2, 1); /* 3.98e-2 */
    suggested(1, 0, 1, 1e-2, 1);
    suggested(0.9, 99, 100, 1e-3, 50);
    suggested(5.1, 99, 100, 1e-3, 19);
    suggested(0.9, 99, 1.25, 1e-3, 12);
    suggested(9.9, 5, 100, 1e-2, 1);
}

/* Five pairs of sliders, m = 2 and 3, that know nothing of each other, frequencies S a decade apart and more; in each
 *
 *     (2 s^2 + c1 s + k1)(3 s^2 + c2 s + k2) + circular^2 + turning^2 s^2 = 0,
 *
 * where circular forces follow the other slider's place and turning ones its rate; what follows one way only (leaning) leaves
 * the roots as they are. */
struct two {
    const char *name;
    double S, c1, c2, k1, k2, circular, turning, leaning, within;
};

static const struct two pairs[] = {
    {"held", 1, 0, 0, -2, -3, 0, 8, 0, 1e-6},             /* turning forces alone hold it */
    {"plain", 1e1, 1e-4, 3e-4, 5, 11, 0, 0, 0, 1e-6},     /* damping of first order */
    {"turning", 1e3, 1e-4, 3e-4, 5, 11, 0, 1.5, 0, 1e-6}, /* likewise */
    {"circular", 1e5, .1, .3, 5, 11, .8, 0, 0, 1e-6},     /* damping of any size from here on */
    {"leaning", 1e7, .2, .4, 5, 11, 0, 0, 1.5, 1e-6},
};

enum { PAIRS = sizeof pairs / sizeof *pairs };

static void put_pair(char *bodies, char *joints, char *forces, const struct two *p)
{
    const double S = p->S, k[] = {p->k1, p->k2}, c[] = {p->c1, p->c2}, sign[] = {-1, 1};
    for (int i = 0; i < 2; i++) {
        sprintf(bodies + strlen(bodies), "  %s%d: {mass: %d, inertia: 1, at: [0, 0]}\n", p->name, i, 2 + i);
        sprintf(joints + strlen(joints), "  %s_%d: {prismatic: [ground, %s%d], axis: [1, 0]}\n", p->name, i, p->name,
                i);
        sprintf(forces + strlen(forces),
                "  f%s%d: {force: %s_%d, value: \"%.17g*%s_%d.displacement + %.17g*%s_%d.displacement_rate + "
                "%.17g*%s_%d.displacement + %.17g*%s_%d.displacement_rate\"}\n",
                p->name, i, p->name, i, -k[i] * S * S, p->name, i, -c[i] * S, p->name, i, sign[i] * p->circular * S * S,
                p->name, 1 - i, (sign[i] * p->turning + (i ? 0 : p->leaning)) * S, p->name, 1 - i);
    }
}

static void check_pair(const struct two *p, const struct mode *m)
{
    const double w = m->omega / p->S, z = m->damping;
    const double complex s = w * (-z + I * sqrt(1 - z * z));
    const double complex a = 2 * s * s + p->c1 * s + p->k1, b = 3 * s * s + p->c2 * s + p->k2;
    const double complex rest = p->circular * p->circular + p->turning * p->turning * s * s;
    const double scale = (2 * w * w + fabs(p->k1)) * (3 * w * w + fabs(p->k2));
    if (!(w > 0) || !(cabs(a * b + rest) < p->within * scale))
        fail_msg("%s: omega %g, damping %g: off by %g", p->name, w, z, cabs(a * b + rest) / scale);
}

static void test_pairs(void **state)
{
    char bodies[2000] = "", joints[2000] = "", forces[4000] = "", deck[9000], path[40];
    double seen[PAIRS] = {0};
    struct opened o;
    (void)state;
    for (int i = 0; i < PAIRS; i++) put_pair(bodies, joints, forces, &pairs[i]);
    snprintf(deck, sizeof deck,
             "fmdsub: 1\nbodies:\n%sconstraints:\n%sforces:\n%spartition: {fast: [leaning_0, leaning_1]}\n"
             "integrate: {scheme: subcycle, step: 1.0e-9, ratio: 10, until: 1.0e-6}\n",
             bodies, joints, forces);
    written(path, deck);
    find(&o, path, 0, NULL);
    unlink(path);
    assert_int_equal(o.modes.n, 2 * PAIRS);
    for (int j = 0; j < 2 * PAIRS; j++) {
        const struct mode *m = &o.modes.mode[j];
        const char *name = sim_coordinate_name(&o.sim, m->top[0]);
        int k = 0;
        while (k < PAIRS && strncmp(name, pairs[k].name, strlen(pairs[k].name)) != 0) k++;
        assert_true(k < PAIRS);
        check_pair(&pairs[k], m);
        near(m->fast, k == PAIRS - 1, k == PAIRS - 1 ? 1e-9 : 0);
        near(m->share[0] + m->share[1], 1, 1e-6);
        if (seen[k] != 0) assert_true(fabs(m->omega / seen[k] - 1) > 1e-2);
        seen[k] = m->omega;
    }
    near(o.modes.fast_top, sqrt(11. / 3) * 1e7, 1e-6);
    near(o.modes.slow_top, sqrt(11. / 3) * 1e5, 1e-6);
    assert_string_equal(sim_coordinate_name(&o.sim, o.modes.fast_worst), "leaning_1.displacement");
    assert_string_equal(sim_coordinate_name(&o.sim, o.modes.slow_worst), "circular_1.displacement");
    arena_close(o.life);
}

/* Four eigenvalues 0 of one vector, which round-off scatters: every motion has a shape, and it is that vector. */
static void test_torn_pairs(void **state)
{
    enum { N = 2 };
    const double a = 1.4373357358993809e-11, K[N * N] = {-a, a, -a, a}, D[N * N] = {0};
    struct damped_mode mode[N];
    struct arena *life = arena_open();
    (void)state;
    assert_true(damped_modes_find(mode, K, D, N, life));
    for (int j = 0; j < N; j++)
        for (int part = 0; part < N; part++) {
            const double *p = mode[j].p + N * part;
            assert_true(fabs(p[0] + p[1]) <= 1e-3 * fabs(p[0]));
        }
    for (int j = 0; j < N; j++) assert_true(hypot(mode[j].p[0], mode[j].p[N]) > 0);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_torn_pairs),   cmocka_unit_test(test_slider),     cmocka_unit_test(test_double_pendulum),
        cmocka_unit_test(test_upright),      cmocka_unit_test(test_suggestion), cmocka_unit_test(test_gyroscopic),
        cmocka_unit_test(test_fast_disk),    cmocka_unit_test(test_follower),   cmocka_unit_test(test_massless_shaft),
        cmocka_unit_test(test_two_bearings), cmocka_unit_test(test_pairs),      cmocka_unit_test(test_suggested),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
