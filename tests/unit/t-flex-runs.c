/* t-flex-runs.c -- whole runs of flexible bodies: the balance of energy, momenta of what flies freely, the rigid body
 * as a limit, the same body held and cut in different ways, reactions against momenta. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "unit/opened.h"

#include "probe/modes.h"

/* --- energy --------------------------------------------------------------------------------------- */

static const char arm2[] = "parameters: {W: 3}\n"
                           "bodies:\n"
                           "  hub: {mass: 1, inertia: 0.5, at: [0, 0]}\n"
                           "  arm:\n"
                           "    beam: {from: [0, 0], to: [2, 0], elements: 6}\n"
                           "    section: {rectangle: [0.02, 0.01]}\n"
                           "    material: aluminium\n"
                           "    modes: 3\n"
                           "    stiffening: %s\n"
                           "constraints:\n"
                           "  shaft: {revolute: [ground, hub], at: [0, 0]}\n"
                           "  clamp: {fixed: [hub, arm], at: [0, 0]}\n";

static const char arm3[] = "parameters: {W: 3}\n"
                           "bodies:\n"
                           "  hub: {mass: 1, inertia: [0.5, 0.5, 0.5], at: [0, 0, 0]}\n"
                           "  arm:\n"
                           "    beam: {from: [0, 0, 0], to: [2, 0, 0], elements: 6}\n"
                           "    section: {rectangle: [0.02, 0.01]}\n"
                           "    material: aluminium\n"
                           "    modes: 5\n"
                           "    stiffening: %s\n"
                           "constraints:\n"
                           "  shaft: {revolute: [ground, hub], at: [0, 0, 0], axis: [0.3, 0.2, 1]}\n"
                           "  clamp: {fixed: [hub, arm], at: [0, 0, 0]}\n";

static const char ball3[] = "parameters: {W: 3}\n"
                            "bodies:\n"
                            "  hub: {mass: 1, inertia: [0.5, 0.4, 0.3], at: [0, 0, 0]}\n"
                            "  arm:\n"
                            "    beam: {from: [0, 0, 0], to: [2, 0, 0], elements: 6}\n"
                            "    section: {rectangle: [0.02, 0.01]}\n"
                            "    material: aluminium\n"
                            "    modes: 5\n"
                            "    stiffening: %s\n"
                            "constraints:\n"
                            "  shaft: {spherical: [ground, hub], at: [0, 0, 0]}\n"
                            "  clamp: {fixed: [hub, arm], at: [0, 0, 0]}\n";

static const struct {
    const char *name, *arm, *rest;
} spinning[] = {
    {"planar, free hub", arm2, "initial: {shaft.angle_rate: W, arm.mode1: 0.05}\n"},
    {"planar, driven hub", arm2,
     "drives: {spin: {drive: shaft.angle, value: W*t + 0.3*sin(5*t)}}\ninitial: {arm.mode1: 0.05}\n"},
    {"planar, torque", arm2,
     "forces: {spin: {torque: shaft, value: 3*sin(5*t)}}\ninitial: {shaft.angle_rate: W, arm.mode1: 0.05}\n"},
    {"space, free hub", arm3, "initial: {shaft.angle_rate: W, arm.mode1: 0.05, arm.mode2: 0.03, arm.mode5: 0.001}\n"},
    {"space, driven hub", arm3,
     "drives: {spin: {drive: shaft.angle, value: W*t + 0.3*sin(5*t)}}\ninitial: {arm.mode1: 0.05, arm.mode2: 0.03}\n"},
    {"space, ball", ball3,
     "forces: {spin: {torque: hub, value: [0, sin(2*t), 3*sin(5*t)]}}\n"
     "initial: {shaft.omega: [1, 0.5, W], arm.mode1: 0.05, arm.mode2: 0.03}\n"},
};

static const char *const scheme[] = {"scheme: midpoint", "scheme: newmark", "scheme: subcycle, ratio: 4"};

/* The worst residual of the balance over the elastic energy at the start. */
static double unbalanced(const char *text, const char *how, double h, double until)
{
    struct opened o;
    char deck[3000];
    snprintf(deck, sizeof deck,
             "%senergy: {delta: 0.1}\n%sintegrate: {%s, step: %.17g, until: %.17g, newton_tolerance: 1.0e-13}\n", text,
             strstr(how, "ratio") ? "partition: {fast: [arm]}\n" : "", how, h, until);
    open_deck(&o, deck);
    double elastic = value(&o, "energy.elastic");
    run(&o);
    double worst = o.sim.ledger.worst / elastic;
    arena_close(o.life);
    return worst;
}

static void falls(const char *name, const char *text, const char *how, double h, double until, double low, double high)
{
    double one = unbalanced(text, how, h, until), two = unbalanced(text, how, h / 2, until);
    if (!(one / two > low && one / two < high))
        fail_msg("%s, %s: the balance is broken by %g and %g of the elastic energy, ratio %g", name, how, one, two,
                 one / two);
    if (!(two < 1e-4)) fail_msg("%s, %s: the balance is broken by %g of the elastic energy", name, how, two);
}

static void test_energy(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof spinning / sizeof *spinning; i++)
        for (int stiff = 0; stiff < 2; stiff++)
            for (int k = 0; k < 3; k++) {
                char text[2000];
                snprintf(text, sizeof text, spinning[i].arm, stiff ? "true" : "false");
                snprintf(text + strlen(text), sizeof text - strlen(text), "%s", spinning[i].rest);
                falls(spinning[i].name, text, scheme[k], 2.5e-4, .5, 3.5, 4.5);
            }
}

/* To 1e-8 of the elastic energy, and no further with time. */
static void test_long(void **state)
{
    (void)state;
    for (int space = 2; space <= 3; space++) {
        char text[2000];
        snprintf(text, sizeof text, space == 2 ? arm2 : arm3, "true");
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s", spinning[space == 2 ? 0 : 3].rest);
        double worst = unbalanced(text, scheme[0], space == 2 ? 1e-4 : 2.0e-5, .5);
        if (!(worst < 1e-8)) fail_msg("%g of the elastic energy", worst);
        for (int k = 0; space == 2 && k < 3; k++) {
            double some = unbalanced(text, scheme[k], 4e-4, 10), all = unbalanced(text, scheme[k], 4e-4, 30);
            if (!(all < 1.5 * some)) fail_msg("%s: %g of the elastic energy, then %g", scheme[k], some, all);
        }
    }
}

/* --- what turning does ---------------------------------------------------------------------------- */

enum { MODES = 16 };

/* dr/dq and dr/dv by central differences at x, whose q and v are the caller's. */
static void differences(double *K, double *C, const struct ode2 *o, const struct instant *x, double *q, double *v)
{
    static const double step = 1e-6;
    double r[2][MODES];
    for (int j = 0; j < o->n; j++)
        for (int which = 0; which < 2; which++) {
            double e[MODES] = {0}, there[MODES + 8], fast[MODES];
            e[j] = 1;
            for (int way = 0; way < 2; way++) {
                struct instant y = *x;
                const double by = way ? -step : step;
                o->move->point(o, there, q, e, which ? 0 : by, x->t);
                for (int i = 0; i < o->n; i++) fast[i] = v[i] + (which ? by * e[i] : 0);
                y.q = there;
                y.v = fast;
                assert_int_equal(o->ops->resid(o, r[way], NULL, NULL, &y, ALL, NULL), OK);
            }
            for (int i = 0; i < o->n; i++) (which ? C : K)[i + o->n * j] = (r[0][i] - r[1][i]) / (2 * step);
        }
}

static double off(const double *A, const double *B, int n)
{
    double worst = 0;
    for (int i = 0; i < n * n; i++) worst = fmax(worst, fabs(A[i] - B[i]));
    return worst;
}

/* slopes() and turning() are all there is, where a drive turns the frame; in the plane the kernel of the step loop and
 * that of turning() take second-order displacements a little differently. */
static void test_turning(void **state)
{
    (void)state;
    for (int space = 2; space <= 3; space++) {
        struct opened o;
        char text[3000];
        double K[MODES * MODES], C[MODES * MODES], dK[MODES * MODES], dC[MODES * MODES], bare[2], a[MODES];
        snprintf(text, sizeof text, space == 2 ? arm2 : arm3, "true");
        snprintf(text + strlen(text), sizeof text - strlen(text), "%sintegrate: {step: 1.0e-3, until: 0.4}\n",
                 spinning[space == 2 ? 1 : 4].rest);
        open_deck(&o, text);
        run(&o);
        const struct ode2 *ode = system_ode2(o.sim.system);
        const struct instant x = {.t = .4, .q = o.sim.x.q, .v = o.sim.x.v, .a = a, .ta = .4, .tb = .4};
        assert_true(ode->n > 2 && ode->n <= MODES);
        for (int i = 0; i < ode->n; i++) a[i] = 3 * sin(7 * i + 1);
        differences(dK, dC, ode, &x, o.sim.x.q, o.sim.x.v);
        assert_int_equal(ode->ops->slopes(ode, K, C, &x, ALL, NULL), OK);
        bare[0] = off(K, dK, ode->n), bare[1] = off(C, dC, ode->n);
        assert_int_equal(ode->ops->turning(ode, K, C, &x, ALL, NULL), OK);
        const double share = space == 2 ? .02 : 1e-4;
        if (!(off(K, dK, ode->n) < share * bare[0]) || !(off(C, dC, ode->n) < share * bare[1]))
            fail_msg("%d dimensions: K off by %g, without turning %g; C by %g, %g", space, off(K, dK, ode->n), bare[0],
                     off(C, dC, ode->n), bare[1]);
        arena_close(o.life);
    }
}

/* --- orders --------------------------------------------------------------------------------------- */

static const char bars[] = "gravity: [0, -9.81]\n"
                           "bodies:\n"
                           "  crank: {mass: 1, inertia: 0.1, at: [0, 0.25]}\n"
                           "  arm:\n"
                           "    beam: {from: [0, 0.5], to: [2, 1], elements: 6}\n"
                           "    section: {circle: 0.01}\n"
                           "    material: steel\n"
                           "    modes: 3\n"
                           "  rocker: {mass: 1, inertia: 0.1, at: [2, 0.5]}\n"
                           "constraints:\n"
                           "  shaft: {revolute: [ground, crank], at: [0, 0]}\n"
                           "  b: {revolute: [crank, arm], at: [0, 0.5]}\n"
                           "  c: {revolute: [arm, rocker], at: [2, 1]}\n"
                           "  d: {revolute: [rocker, ground], at: [2, 0]}\n"
                           "forces: {push: {torque: crank, value: -3}}\n"
                           "initial: {shaft.angle_rate: 2, arm.mode1: 0.003}\n";

/* shaft.angle and the first two modes at the end. */
static void reached(double *x, const char *text, const char *fast, const char *how)
{
    static const char *const columns[] = {"shaft.angle", "arm.mode1", "arm.mode2"};
    struct opened o;
    char deck[3000];
    snprintf(deck, sizeof deck, "%s%senergy: {delta: 0.1}\nintegrate: {%s, until: 0.02}\n", text, fast, how);
    open_deck(&o, deck);
    run(&o);
    for (int i = 0; i < 3; i++) x[i] = value(&o, columns[i]);
    arena_close(o.life);
}

/* The order between h and h/2: 2 within 0.15. */
static void second_order(const char *text, const char *fast, const char *how, const double *want, double h)
{
    double error[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        char scheme_at[200];
        double x[3];
        snprintf(scheme_at, sizeof scheme_at, "%s, step: %.17g, newton_tolerance: 1.0e-13", how, k ? h / 2 : h);
        reached(x, text, fast, scheme_at);
        for (int i = 0; i < 3; i++) error[k] = fmax(error[k], fabs(x[i] - want[i]) / fabs(want[i]));
    }
    double order = log2(error[0] / error[1]);
    if (!(fabs(order - 2) < .15 && error[1] < .02))
        fail_msg("%s, %s: errors %g, %g, order %g", fast, how, error[0], error[1], order);
}

/* Single rates; all modes fast, one, those above a frequency; ratios 1, 2, 5, 10; hub free and driven; a loop. */
static void test_orders(void **state)
{
    static const char *const fast[] = {"partition: {fast: [arm]}\n", "partition: {fast: [arm.mode3]}\n",
                                       "partition: {fast: [{modes: arm, above: 5}]}\n"};
    static const int ratio[] = {1, 2, 5, 10};
    (void)state;
    for (int k = 0; k < 3; k++) {
        char text[2000], how[100];
        double want[3];
        snprintf(text, sizeof text, k < 2 ? arm2 : bars, "true");
        if (k < 2) snprintf(text + strlen(text), sizeof text - strlen(text), "%s", spinning[k].rest);
        const double h = k < 2 ? 1e-4 : 4e-6;
        reached(want, text, "", "scheme: dopri5, tolerance: 1.0e-12");
        second_order(text, "", "scheme: midpoint", want, h);
        second_order(text, "", "scheme: newmark", want, h);
        for (int f = 0; f < (k < 2 ? 3 : 1); f++)
            for (int n = 0; n < 4; n++) {
                snprintf(how, sizeof how, "scheme: subcycle, ratio: %d", ratio[n]);
                second_order(text, fast[f], how, want, h);
            }
    }
}

/* --- what flies freely ---------------------------------------------------------------------------- */

static const char flying2[] =
    "effects: {momentum: true}\n"
    "bodies:\n"
    "  arm:\n"
    "    beam: {from: [0, 0], to: [1, 0], elements: 5}\n"
    "    section: {rectangle: [0.03, 0.02]}\n"
    "    material: aluminium\n"
    "    modes: 2\n    stiffening: false\n"
    "  bob: {mass: 0.3, inertia: 0.01, at: [1.1, 0.1]}\n"
    "  wing:\n"
    "    beam: {from: [0.5, 0], to: [0.5, 0.8], elements: 4}\n"
    "    section: {rectangle: [0.02, 0.02]}\n"
    "    material: aluminium\n"
    "    modes: 2\n    stiffening: false\n"
    "constraints:\n"
    "  go: {free: [ground, arm], at: [0, 0]}\n"
    "  pin: {revolute: [arm, bob], at: [1, 0]}\n"
    "  root: {revolute: [arm, wing], at: [0.5, 0]}\n"
    "initial: {arm.mode1: 0.01, root.angle_rate: 2, pin.angle_rate: -3, go.angle_rate: 2, go.x_rate: 0.5}\n";

static const char flying3[] =
    "effects: {momentum: true}\n"
    "bodies:\n"
    "  arm:\n"
    "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 4}\n"
    "    section: {rectangle: [0.03, 0.02]}\n"
    "    material: aluminium\n"
    "    modes: 3\n    stiffening: false\n"
    "  bob: {mass: 0.3, inertia: [0.01, 0.02, 0.015], at: [1.1, 0.1, 0]}\n"
    "constraints:\n"
    "  go: {free: [ground, arm], at: [0, 0, 0]}\n"
    "  ball: {spherical: [arm, bob], at: [1, 0, 0]}\n"
    "initial: {arm.mode1: 0.01, arm.mode2_rate: 0.3, ball.omega: [2, -1, 3], go.omega: [1, -2, 3], go.y_rate: 0.5}\n";

static void momenta(double *p, struct opened *o)
{
    value(o, "t");
    system_momentum(o->sim.system, p, p + 3);
}

/* Largest change of the momenta, over their sizes; of the energy, over what was the elastic one at the start. */
static double lost(double *energy, const char *text, const char *how)
{
    struct opened o;
    char deck[2000];
    double p[6], p0[6], worst = 0, size[2] = {0, 0};
    snprintf(deck, sizeof deck, "%senergy: {delta: 0.1}\nintegrate: {%s, until: 0.05}\n", text, how);
    open_deck(&o, deck);
    momenta(p0, &o);
    double elastic = value(&o, "energy.elastic");
    run(&o);
    momenta(p, &o);
    for (int i = 0; i < 6; i++) size[i / 3] = fmax(size[i / 3], fabs(p0[i]));
    for (int i = 0; i < 6; i++) worst = fmax(worst, fabs(p[i] - p0[i]) / size[i / 3]);
    *energy = o.sim.ledger.worst / elastic;
    arena_close(o.life);
    return worst;
}

/* Momenta and energy are kept by the equations, and by the midpoint rule at any step. */
static void test_flying(void **state)
{
    static const char *const decks[] = {flying2, flying3};
    (void)state;
    for (int i = 0; i < 2; i++) {
        double energy[2], exact = lost(&energy[0], decks[i], "scheme: dopri5, tolerance: 1.0e-13");
        double step = lost(&energy[1], decks[i], "scheme: midpoint, step: 1.0e-5, newton_tolerance: 1.0e-13");
        if (!(exact < 1e-12 && step < 2e-12)) fail_msg("%g and %g of the momenta are lost", exact, step);
        if (!(energy[0] < 1e-9 && energy[1] < 1e-9)) fail_msg("%g and %g of the energy are lost", energy[0], energy[1]);
    }
}

/* --- modes ---------------------------------------------------------------------------------------- */

static int frequencies(double *omega, int most, const char *text)
{
    struct opened o;
    struct modes modes;
    open_deck(&o, text);
    assert_int_equal(modes_find(&modes, &o.sim, o.life, &o.report), OK);
    int n = modes.n < most ? modes.n : most;
    for (int i = 0; i < n; i++) omega[i] = modes.mode[i].omega;
    arena_close(o.life);
    return n;
}

/* H32: the rigid modes are zero, of whatever section the body is held; the others are those of the free beam. */
static void test_free_modes(void **state)
{
    static const char *const at[] = {"[0, 0, 0]", "arm", "[1.5, 0, 0]"};
    static const double root[] = {4.73004074486, 4.73004074486, 7.85320462410};
    const double L = 2, EIz = 2.1e11 * .02 * pow(.03, 3) / 12, EIy = 2.1e11 * .03 * pow(.02, 3) / 12,
                 rA = 7850 * .03 * .02, EI[] = {EIy, EIz, EIy};
    (void)state;
    for (int k = 0; k < 3; k++) {
        char text[1000];
        double omega[9];
        snprintf(text, sizeof text,
                 "bodies:\n"
                 "  arm:\n"
                 "    beam: {from: [0, 0, 0], to: [2, 0, 0], elements: 10, rotary: false}\n"
                 "    section: {rectangle: [0.03, 0.02]}\n"
                 "    material: {E: 2.1e+11, nu: 0.3, density: 7850}\n"
                 "    modes: 24\n"
                 "constraints: {go: {free: [ground, arm], at: %s}}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.1}\n",
                 at[k]);
        assert_int_equal(frequencies(omega, 9, text), 9);
        for (int i = 0; i < 6; i++) assert_true(fabs(omega[i]) <= 1e-6 * omega[6]);
        for (int i = 0; i < 3; i++) {
            double want = pow(root[i] / L, 2) * sqrt(EI[i] / rA);
            near(omega[6 + i], want, 5e-4 * want);
        }
    }
}

/* A blade 20 to 2.5 times as long as wide, clamped to a hub that turns at 12 of its units: flap 13.170 (Wright et al., J.
 * Appl. Mech. 49 (1982) 197), whether the rotary inertia of its sections counts or not; with 10 modes the widest is off
 * by .012. */
static void test_flap_of_wide_blades(void **state)
{
    static const double width[] = {.05, .1, .2, .4};
    (void)state;
    for (int k = 0; k < 8; k++) {
        char text[1000];
        double omega[3], unit = sqrt(7e10 * .01 * .01 / 12 / 2700), nearest = INFINITY;
        snprintf(text, sizeof text,
                 "space: 3d\n"
                 "bodies:\n"
                 "  hub: {mass: 1, inertia: [0.1, 0.1, 0.1], at: [0, 0, 0]}\n"
                 "  arm:\n"
                 "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 20, rotary: %s}\n"
                 "    section: {rectangle: [%g, 0.01]}\n"
                 "    material: {E: 7.0e+10, nu: 0.3, density: 2700}\n"
                 "    modes: 18\n"
                 "constraints:\n"
                 "  sh: {revolute: [ground, hub], at: [0, 0, 0], axis: [0, 0, 1]}\n"
                 "  cl: {fixed: [hub, arm], at: [0, 0, 0]}\n"
                 "drives: {s: {drive: sh.angle, value: \"%.17g*t\"}}\n"
                 "effects: {out_of_plane: true}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.1}\n",
                 k % 2 ? "true" : "false", width[k / 2], 12 * unit);
        assert_int_equal(frequencies(omega, 3, text), 3);
        for (int i = 0; i < 3; i++)
            if (fabs(omega[i] / unit - 13.1702) < fabs(nearest)) nearest = omega[i] / unit - 13.1702;
        near(nearest, 0, .006);
    }
}

/* --- the rigid body as a limit -------------------------------------------------------------------- */

static double stiff_end(double stiffer, bool rigid, const char *how, const char *column)
{
    struct opened o;
    char deck[2500], arm[500];
    if (rigid)
        snprintf(arm, sizeof arm,
                 "  arm: {mass: m, inertia: m*0.8^2/12 + rho*I*0.8, at: [1.4, 0], points: {mid: [0.16, 0]}}\n");
    else
        snprintf(arm, sizeof arm,
                 "  arm:\n"
                 "    beam: {from: [1, 0], to: [1.8, 0], elements: 6}\n"
                 "    section: {area: A, Iz: I}\n"
                 "    material: {E: %.17g, density: rho}\n"
                 "    modes: 3\n"
                 "    points: {mid: {station: 0.7}}\n",
                 2e11 * stiffer);
    snprintf(deck, sizeof deck,
             "parameters: {rho: 8000, A: 3.0e-4, I: 1.0e-8, m: 8000*3.0e-4*0.8}\n"
             "gravity: [0, -9.81]\n"
             "bodies:\n"
             "  top: {mass: 1, inertia: 0.1, at: [0.5, 0]}\n%s"
             "constraints:\n"
             "  a: {revolute: [ground, top], at: [0, 0]}\n"
             "  b: {revolute: [top, arm], at: [1, 0]}\n"
             "forces: {s: {spring: [[1.2, 0.4], arm.mid], stiffness: 300}}\n"
             "initial: {a.angle_rate: 1, b.angle_rate: 3}\n"
             "integrate: {%s}\n",
             arm, how);
    open_deck(&o, deck);
    run(&o);
    double x = value(&o, column);
    arena_close(o.life);
    return x;
}

/* The motion differs by what the body bends, which goes with 1/E; a beam that is stiff beyond measure is the rigid
 * body. */
static void test_rigid(void **state)
{
    static const char exact[] = "scheme: dopri5, tolerance: 1.0e-11, until: 0.1",
                      steps[] = "scheme: midpoint, step: 5.0e-4, until: 0.3";
    static const char *const columns[] = {"a.angle", "b.angle"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        double want = stiff_end(1, true, exact, columns[i]), difference[2];
        for (int k = 0; k < 2; k++) difference[k] = fabs(stiff_end(k ? 16 : 1, false, exact, columns[i]) - want);
        assert_true(difference[0] < 1e-3);
        if (!(difference[1] < difference[0] / 8)) fail_msg("%g, 16 times as stiff %g", difference[0], difference[1]);
        want = stiff_end(1, true, steps, columns[i]);
        near(stiff_end(1e12, false, steps, columns[i]), want, 1e-9);
    }
}

/* --- the same thing, held or cut otherwise -------------------------------------------------------- */

#define STEEL "    section: {rectangle: [0.03, 0.02]}\n    material: steel\n"

/* A hub that flies with a beam: the free joint on the hub, at the tip, in the middle. */
static void test_held(void **state)
{
    static const char *const joints[] = {
        "  go: {free: [ground, hub], at: [0, 0]}\n  grip: {fixed: [hub, arm], at: [0, 0]}\n",
        "  go: {free: [ground, arm], at: [2, 0]}\n  grip: {fixed: [arm, hub], at: [0, 0]}\n",
        "  go: {free: [ground, arm], at: [1, 0]}\n  grip: {fixed: [arm, hub], at: [0, 0]}\n"};
    double omega[3][6];
    (void)state;
    for (int k = 0; k < 3; k++) {
        char text[1000];
        snprintf(text, sizeof text,
                 "bodies:\n"
                 "  hub: {mass: 3, inertia: 0.4, at: [0, 0]}\n"
                 "  arm:\n"
                 "    beam: {from: [0, 0], to: [2, 0], elements: 8}\n" STEEL "    modes: 18\n"
                 "constraints:\n%s"
                 "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.1}\n",
                 joints[k]);
        assert_int_equal(frequencies(omega[k], 6, text), 6);
        for (int i = 0; i < 3; i++) assert_true(fabs(omega[k][i]) < 1e-6 * omega[k][3]);
        for (int i = 3; i < 6; i++) near(omega[k][i], omega[0][i], 1e-5 * omega[0][i]);
    }
}

/* Two beams end to end are one, which sags by its weight q as q L^4/(8 E I). */
static void test_halves(void **state)
{
    static const char *const bodies[] = {"  arm:\n    beam: {from: [0, 0], to: [2, 0], elements: 16}\n" STEEL
                                         "    modes: 8\n    points: {tip: {station: 1}}\n",
                                         "  first:\n    beam: {from: [0, 0], to: [1, 0], elements: 8}\n" STEEL
                                         "    modes: 8\n"
                                         "  arm:\n    beam: {from: [1, 0], to: [2, 0], elements: 8}\n" STEEL
                                         "    modes: 5\n    points: {tip: {station: 1}}\n"};
    static const char *const joints[] = {
        "  clamp: {fixed: [ground, arm], at: [0, 0]}\n",
        "  clamp: {fixed: [ground, first], at: [0, 0]}\n  weld: {fixed: [first, arm], at: [1, 0]}\n"};
    double omega[2][4];
    const double q = 7850 * .03 * .02 * 9.81, EI = 2.1e11 * .03 * pow(.02, 3) / 12, sag = q * 16 / (8 * EI);
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[1500];
        for (int hangs = 0; hangs < 2; hangs++) {
            snprintf(text, sizeof text,
                     "%sbodies:\n%sconstraints:\n%s%sintegrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}\n",
                     hangs ? "gravity: [0, -9.81]\n" : "", bodies[k], joints[k],
                     hangs ? "initial: {static: true}\n" : "");
            if (!hangs) assert_int_equal(frequencies(omega[k], 4, text), 4);
        }
        open_deck(&o, text);
        near(value(&o, "arm.tip.y"), -sag, 2e-4 * sag);
        near(value(&o, "clamp.fy"), 2 * q, 1e-9 * q);
        near(value(&o, "clamp.mz"), 2 * q, 1e-4 * q);
        run(&o);
        near(value(&o, "arm.tip.y"), -sag, 2e-4 * sag);
        near(value(&o, "energy.kinetic"), 0, 1e-12);
        arena_close(o.life);
    }
    for (int i = 0; i < 4; i++) near(omega[1][i], omega[0][i], 2e-4 * omega[0][i]);
}

/* --- mechanisms ----------------------------------------------------------------------------------- */

static const char linkage[] =
    "gravity: [0, -9.81]\n"
    "bodies:\n"
    "  cart: {mass: 2, at: [0, 0], inertia: 0.1}\n"
    "  arm:\n"
    "    beam: {from: [0, 0], to: [1, 0.2], elements: 6}\n"
    "    section: {rectangle: [0.02, 0.006]}\n"
    "    material: steel\n"
    "    modes: 2\n"
    "    damping: {ratio: 0.01}\n"
    "    points: {tip: {station: 1}, mid: {station: 0.5}, q: {station: 0.3, offset: [0, 0.05]}}\n"
    "  rod:\n"
    "    beam: {from: [1, 0.2], to: [1.6, 0], elements: 4}\n"
    "    section: {rectangle: [0.02, 0.006]}\n"
    "    material: steel\n"
    "    modes: 2\n"
    "    points: {tip: {station: 1}, mid: {station: 0.5}}\n"
    "  bob: {mass: 0.4, at: [0.5, 0.4], inertia: 0.01}\n"
    "constraints:\n"
    "  track: {prismatic: [ground, cart], at: [0, 0], axis: [1, 0]}\n"
    "  pin: {revolute: [cart, arm], at: [0, 0]}\n"
    "  elbow: {revolute: [arm, rod], at: [1, 0.2]}\n"
    "  hang: {revolute: [arm, bob], at: arm.mid}\n"
    "%s"
    "measures: {gap: {distance: [arm.q, bob]}, reach: {distance: [[1.3, 1.1], arm.tip]}}\n"
    "forces:\n"
    "  s1: {spring: [[0.3, 1], arm.q], stiffness: 300, damping: 1}\n"
    "  s2: {spring: [arm.tip, rod.mid], stiffness: 100, damping: 0.3}\n"
    "  turn: {torque: arm, value: 0.5*sin(8*t)}\n"
    "  push: {force: rod.tip, value: [2*sin(10*t), 1], frame: body}\n"
    "  bush: {bushing: [cart, arm], at: [0.2, 0.04], stiffness: [2000, 1000], rotation: 50,\n"
    "         damping: [3, 2], rotation_damping: 0.1}\n"
    "  hold: {force: gap, value: -5*gap_rate - 3*gap^3}\n"
    "initial: {arm.mode1: 0.002, hang.angle_rate: 2}\n";

/* Loads, springs and joints at nodes within the beams, loops, gears, drives: the balance holds to second order. */
static void test_linkages(void **state)
{
    static const char *const closed[] = {"",
                                         "  close: {revolute: [rod, ground], at: [1.6, 0]}\n",
                                         "  rope: {distance: [[1, 1], rod.mid]}\n",
                                         "  pair: {gear: [pin, elbow], ratio: -1}\n",
                                         "  rail: {point-on-line: [ground, rod], at: rod.tip, axis: [1, 0.2]}\n",
                                         "drives: {go: {drive: reach, value: 0.948683298050514 + 0.05*sin(5*t)}}\n",
                                         "drives: {go: {drive: pin, value: 0.3*sin(5*t)}}\n"};
    (void)state;
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++) {
        char text[3000];
        snprintf(text, sizeof text, linkage, closed[i]);
        falls(closed[i], text, scheme[0], 1e-4, .1, 3, 5.5);
        falls(closed[i], text, "scheme: subcycle, ratio: 2", 1e-4, .1, 2.5, 6);
    }
}

/* The clamp carries the rates of the momenta less the loads; about the world's origin. */
static void test_reactions(void **state)
{
    struct opened o;
    char text[3000];
    const double e = 1e-6;
    (void)state;
    snprintf(text, sizeof text,
             "gravity: [0, -9.81]\n"
             "bodies:\n"
             "  arm:\n"
             "    beam: {from: [0, 0], to: [1, 0.2], elements: 6}\n"
             "    section: {rectangle: [0.02, 0.006]}\n"
             "    material: steel\n"
             "    modes: 3\n"
             "    points: {mid: {station: 0.5}}\n"
             "  rod:\n"
             "    beam: {from: [1, 0.2], to: [1.6, 0], elements: 4}\n"
             "    section: {rectangle: [0.02, 0.006]}\n"
             "    material: steel\n"
             "    modes: 2\n"
             "    points: {tip: {station: 1}}\n"
             "  bob: {mass: 0.4, at: [0.5, 0.4], inertia: 0.01}\n"
             "constraints:\n"
             "  clamp: {fixed: [ground, arm], at: [0, 0]}\n"
             "  elbow: {revolute: [arm, rod], at: [1, 0.2]}\n"
             "  hang: {revolute: [arm, bob], at: arm.mid}\n"
             "forces:\n"
             "  turn: {torque: arm, value: 0.5}\n"
             "  push: {force: rod.tip, value: [2, 1]}\n"
             "  inner: {spring: [arm.mid, rod.tip], stiffness: 100, damping: 1}\n"
             "initial: {arm.mode1: 0.01, arm.mode2_rate: 0.1, elbow.angle_rate: 3, hang.angle_rate: -2}\n"
             "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.05}\n");
    open_deck(&o, text);
    run(&o);
    double F[3] = {value(&o, "clamp.fx"), value(&o, "clamp.fy"), value(&o, "clamp.mz")}, W[3], p[2][6], q[40], v[40];
    static const char *const body[] = {"arm", "rod", "bob"};
    double mass[] = {0, 0, .4};
    W[0] = 2, W[1] = 1;
    W[2] = .5 + value(&o, "rod.tip.x") - 2 * value(&o, "rod.tip.y");
    mass[0] = 7850 * .02 * .006 * sqrt(1.04), mass[1] = 7850 * .02 * .006 * sqrt(.4);
    for (int i = 0; i < 3; i++) {
        char name[20];
        snprintf(name, sizeof name, "%s.x", body[i]);
        W[1] -= 9.81 * mass[i];
        W[2] -= 9.81 * mass[i] * value(&o, name);
    }
    const int n = o.sim.model->n;
    assert_true(n <= 40);
    const double *a = system_accelerations(o.sim.system), *rate = system_rates(o.sim.system);
    double a0[40], v0[40];
    memcpy(a0, a, sizeof *a * (size_t)n);
    memcpy(v0, rate, sizeof *rate * (size_t)n);
    for (int k = 0; k < 2; k++) {
        const double t = k ? e : -e;
        struct trouble why;
        for (int i = 0; i < n; i++) {
            q[i] = o.sim.x.q[i] + t * v0[i] + t * t / 2 * a0[i];
            v[i] = v0[i] + t * a0[i];
        }
        assert_int_equal(system_evaluate(o.sim.system, q, v, o.sim.x.t, EVALUATE_MOTION, &why), OK);
        system_momentum(o.sim.system, p[k], p[k] + 3);
    }
    static const int row[] = {0, 1, 5};
    for (int i = 0; i < 3; i++) near(F[i] + W[i], (p[1][row[i]] - p[0][row[i]]) / (2 * e), 1e-6);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_orders),
                                       cmocka_unit_test(test_energy),
                                       cmocka_unit_test(test_turning),
                                       cmocka_unit_test(test_long),
                                       cmocka_unit_test(test_flying),
                                       cmocka_unit_test(test_free_modes),
                                       cmocka_unit_test(test_flap_of_wide_blades),
                                       cmocka_unit_test(test_rigid),
                                       cmocka_unit_test(test_held),
                                       cmocka_unit_test(test_halves),
                                       cmocka_unit_test(test_linkages),
                                       cmocka_unit_test(test_reactions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
