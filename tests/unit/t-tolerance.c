/* What Newton may leave over in a step: each one of a run, with all that the steps before have taught, against the same
 * step from the same state with a new matrix and the tightest tolerance.  In units of the scales the difference is not
 * above a hundred tolerances. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "opened.h"

/* Torque and spring, at rest: the first steps say nothing of the later ones. */
static const char bar_slider[] = "bodies:\n"
                                 "  rod: {mass: 2, inertia: 2/3, at: [1, 0]}\n"
                                 "  slider: {mass: 5, at: [1, 0]}\n"
                                 "constraints:\n"
                                 "  hub: {revolute: [ground, rod], at: [0, 0]}\n"
                                 "  guide: {prismatic: [rod, slider], at: [1, 0], axis: [1, 0]}\n"
                                 "forces:\n"
                                 "  spring: {spring: guide, stiffness: 1000}\n"
                                 "  motor: {torque: hub, value: 100}\n";

/* Spins fast, and begins to fall: its first correction is nearly all of the error, and the rest comes slowly. */
static const char spinning_top[] =
    "gravity: [0, 0, -9.81]\n"
    "bodies:\n"
    "  top: {mass: 1, at: [0.25, 0, 0.4330127018922193], orient: {axis: [0, 1, 0], angle: pi/6},\n"
    "    inertia: [0.05, 0.05, 0.05], points: {foot: [0, 0, -0.5]}}\n"
    "constraints:\n"
    "  ball: {spherical: [ground, top], at: top.foot}\n"
    "initial: {ball.omega: [20, 0, 34.64101615137755]}\n";

/* A ball that falls on a hard floor and carries a pendulum with a stop. */
static const char floor_and_stop[] =
    "gravity: [0, -9.81]\n"
    "bodies:\n"
    "  a: {mass: 1, inertia: 0.1, at: [0, 0]}\n"
    "  b: {mass: 0.5, inertia: 0.02, at: [0.5, 0]}\n"
    "constraints:\n"
    "  sl: {prismatic: [ground, a], at: [0, 0], axis: [0, 1]}\n"
    "  r: {revolute: [a, b], at: [0.2, 0]}\n"
    "forces:\n"
    "  c: {force: sl, value: \"if(sl.displacement < -0.1, -1.0e+5*(sl.displacement + 0.1), 0)\"}\n"
    "  d: {torque: r, value: \"-0.2*tanh(r.angle_rate/0.01) - if(r.angle < -1, 3000*(r.angle + 1), 0)\"}\n";

struct twins {
    struct opened run, exact;
    double *scale; /* [n] as the iteration has them */
    double H;
};

static void open_twins(struct twins *o, const char *mechanism, const char *integrate, double tolerance)
{
    struct opened *both[] = {&o->run, &o->exact};
    for (int i = 0; i < 2; i++) {
        char deck[3000];
        snprintf(deck, sizeof deck, "%senergy: {delta: 1}\nintegrate: {%s, newton_tolerance: %.1e}\n", mechanism,
                 integrate, i ? 1e-13 : tolerance);
        open_deck(both[i], deck);
    }
    o->scale = TAKE(o->run.life, double, o->run.sim.stepper.ode->n);
}

static void grow(struct twins *o)
{
    const struct state *x = &o->run.sim.x;
    for (int i = 0; i < o->run.sim.stepper.ode->n; i++)
        o->scale[i] = fmax(o->scale[i], fmax(fabs(x->v[i]), fabs(o->H * x->a[i])));
}

static double difference(const struct twins *o)
{
    const int n = o->run.sim.stepper.ode->n;
    double top = 0, worst = 0;
    for (int i = 0; i < n; i++) top = fmax(top, o->scale[i]);
    for (int i = 0; i < n; i++)
        worst = fmax(worst, fabs(o->run.sim.x.v[i] - o->exact.sim.x.v[i]) / fmax(o->scale[i], 1e-7 * top));
    return worst;
}

static double left_over(const char *mechanism, const char *integrate, double tolerance, double h, int steps)
{
    struct twins o = {.H = h};
    struct trouble why;
    double worst = 0;
    open_twins(&o, mechanism, integrate, tolerance);
    struct sim *a = &o.run.sim, *b = &o.exact.sim;
    const struct ode2 *ode = a->stepper.ode;
    for (int k = 1; k <= steps; k++) {
        grow(&o);
        b->x.t = a->x.t;
        memcpy(b->x.q, a->x.q, sizeof *b->x.q * (size_t)ode->nq);
        memcpy(b->x.v, a->x.v, sizeof *b->x.v * (size_t)ode->n);
        memcpy(b->x.a, a->x.a, sizeof *b->x.a * (size_t)ode->n);
        b->stepper.fresh = 1;
        assert_int_equal(stepper_step(&b->stepper, &b->x, h, 1, k * h, &why), OK);
        assert_int_equal(stepper_step(&a->stepper, &a->x, h, 1, k * h, &why), OK);
        grow(&o);
        worst = fmax(worst, difference(&o));
    }
    arena_close(o.run.life);
    arena_close(o.exact.life);
    return worst;
}

static void test_left_over(void **state)
{
    (void)state;
    static const struct {
        const char *mechanism, *scheme;
        double h;
        int steps;
    } rides[] = {{bar_slider, "newmark", 1e-2, 100},     {bar_slider, "midpoint", 1e-2, 100},
                 {spinning_top, "newmark", 5e-4, 200},   {spinning_top, "midpoint", 5e-4, 200},
                 {floor_and_stop, "newmark", 1e-3, 900}, {floor_and_stop, "midpoint", 1e-3, 900}};
    static const double tolerances[] = {1e-6, 1e-8, 1e-10};
    for (size_t i = 0; i < sizeof rides / sizeof *rides; i++)
        for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; k++) {
            char integrate[80];
            snprintf(integrate, sizeof integrate, "scheme: %s, step: %.1e, until: 1", rides[i].scheme, rides[i].h);
            const double tol = tolerances[k],
                         x = left_over(rides[i].mechanism, integrate, tol, rides[i].h, rides[i].steps);
            if (!(x < 100 * tol)) fail_msg("ride %zu, %s, %g: %g tolerances left over", i, integrate, tol, x / tol);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_left_over)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
