/* t-condense.c -- the laws of a condensed system, on decks with loops of both rate classes and on random linkages. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "loop/condense_parts.h"
#include "sim/load.h"
#include "sim/sim.h"
#include "unit/trees.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST = 40 };

struct opened {
    struct arena *life;
    struct sim sim;
    const struct ode2 *ode;
    int n;
    double q[MOST], v[MOST], a[MOST];
};

/* Two four-bars side by side, the left one with a fast joint, a pendulum on the right one's rocker, springs across; in
 * space a crank and a rocker with balls between (the rod's spin is a freedom of its own). */
static const char plane[] = "fmdsub: 1\n"
                            "gravity: [0, -9.81]\n"
                            "bodies:\n"
                            "  c1: {mass: 1, inertia: 0.1, at: [0.2, 0.3]}\n"
                            "  b1: {mass: 2, inertia: 0.2, at: [1, 0.9]}\n"
                            "  r1: {mass: 1, inertia: 0.3, at: [1.8, 0.6]}\n"
                            "  c2: {mass: 1, inertia: 0.1, at: [4.2, 0.3]}\n"
                            "  b2: {mass: 2, inertia: 0.2, at: [5, 0.9]}\n"
                            "  r2: {mass: 1, inertia: 0.3, at: [5.8, 0.6]}\n"
                            "  p: {mass: 1, inertia: 0.1, at: [6, 0.3]}\n"
                            "constraints:\n"
                            "  s1: {revolute: [ground, c1], at: [0, 0]}\n"
                            "  e1: {revolute: [c1, b1], at: [0.3, 0.7]}\n"
                            "  w1: {revolute: [b1, r1], at: [1.7, 1.1]}\n"
                            "  g1: {revolute: [ground, r1], at: [2, 0]}\n"
                            "  s2: {revolute: [ground, c2], at: [4, 0]}\n"
                            "  e2: {revolute: [c2, b2], at: [4.3, 0.7]}\n"
                            "  w2: {revolute: [b2, r2], at: [5.7, 1.1]}\n"
                            "  g2: {revolute: [ground, r2], at: [6, 0]}\n"
                            "  hang: {revolute: [r2, p], at: [5.9, 0.5]}\n"
                            "forces:\n"
                            "  k1: {spring: e1, stiffness: 500}\n"
                            "  k2: {spring: hang, stiffness: 20}\n"
                            "  k3: {spring: [b1, ground], stiffness: 40, rest: 0.1}\n"
                            "  k4: {spring: [b2, ground], stiffness: 30, rest: 0.1}\n"
                            "  d: {damper: w2a, damping: 2}\n"
                            "  m: {torque: s2, value: sin(t)}\n"
                            "measures: {w2a: {angle: [b2, r2]}}\n"
                            "partition: {fast: [e1]}\n"
                            "integrate: {scheme: subcycle, step: 1.0e-3, ratio: 2, until: 1}\n";

static const char room[] = "fmdsub: 1\n"
                           "gravity: [0, 0, -9.81]\n"
                           "bodies:\n"
                           "  crank: {mass: 1, inertia: [0.1, 0.1, 0.1], at: [0, 0.2, 0.1]}\n"
                           "  rod: {mass: 2, inertia: [0.3, 0.2, 0.2], at: [0.6, 0.5, 0.4]}\n"
                           "  rocker: {mass: 1, inertia: [0.1, 0.2, 0.15], at: [1.2, 0.3, 0.4]}\n"
                           "constraints:\n"
                           "  shaft: {revolute: [ground, crank], at: [0, 0, 0], axis: [0, 0, 1]}\n"
                           "  ball1: {spherical: [crank, rod], at: [0, 0.4, 0.1]}\n"
                           "  ball2: {spherical: [rod, rocker], at: [1.2, 0.6, 0.7]}\n"
                           "  pivot: {revolute: [ground, rocker], at: [1.2, 0, 0], axis: [1, 0.2, 0]}\n"
                           "forces:\n"
                           "  k: {spring: [rod, ground], stiffness: 100, rest: 0.3}\n"
                           "initial: {shaft.angle_rate: 3}\n"
                           "integrate: {scheme: newmark, step: 1.0e-3, until: 1}\n";

/* The ball is independent. */
static const char hung[] =
    "fmdsub: 1\n"
    "gravity: [0, 0, -9.81]\n"
    "bodies:\n"
    "  arm: {mass: 1, inertia: [0.1, 0.1, 0.1], at: [0.5, 0, 0]}\n"
    "  bob: {mass: 2, inertia: [0.3, 0.2, 0.2], at: [1.2, 0, 0], points: {p: [0.1, 0.05, 0.02]}}\n"
    "  link: {mass: 1, inertia: [0.1, 0.2, 0.15], at: [1.4, 0.1, 1]}\n"
    "constraints:\n"
    "  shaft: {revolute: [ground, arm], at: [0, 0, 0], axis: [0, 1, 0]}\n"
    "  ball: {spherical: [arm, bob], at: [1, 0, 0]}\n"
    "  guide: {prismatic: [ground, link], at: [1.4, 0.1, 1], axis: [0, 0, 1]}\n"
    "  rod: {distance: [bob.p, link]}\n"
    "initial: {shaft.angle_rate: 3}\n"
    "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n";

static const char bending[] = "fmdsub: 1\n"
                              "gravity: [0, -9.81]\n"
                              "bodies:\n"
                              "  crank: {mass: 1, inertia: 0.1, at: [0, 0.2]}\n"
                              "  rod:\n"
                              "    beam: {from: [0, 0.4], to: [1.2, 0.6], elements: 4}\n"
                              "    section: {rectangle: [0.02, 0.01]}\n"
                              "    material: aluminium\n"
                              "    modes: 2\n"
                              "  rocker: {mass: 1, inertia: 0.1, at: [1.2, 0.3]}\n"
                              "constraints:\n"
                              "  shaft: {revolute: [ground, crank], at: [0, 0]}\n"
                              "  elbow: {revolute: [crank, rod], at: [0, 0.4]}\n"
                              "  wrist: {revolute: [rod, rocker], at: [1.2, 0.6]}\n"
                              "  pivot: {revolute: [ground, rocker], at: [1.2, 0]}\n"
                              "integrate: {scheme: newmark, step: 1.0e-4, until: 1}\n";

/* A four-bar that flies, a motor in its crank that has a corner at 0.1 s. */
static const char flying[] = "fmdsub: 1\neffects: {momentum: true}\n"
                             "bodies:\n"
                             "  frame: {mass: 2, inertia: 0.5, at: [0.5, 0]}\n"
                             "  crank: {mass: 1, inertia: 0.1, at: [0, 0.3]}\n"
                             "  rod: {mass: 1, inertia: 0.2, at: [0.5, 0.7]}\n"
                             "  rocker: {mass: 1, inertia: 0.1, at: [1, 0.4]}\n"
                             "constraints:\n"
                             "  fly: {free: [ground, frame], at: [0.5, 0]}\n"
                             "  motor: {revolute: [frame, crank], at: [0, 0]}\n"
                             "  elbow: {revolute: [crank, rod], at: [0, 0.6]}\n"
                             "  wrist: {revolute: [rod, rocker], at: [1, 0.8]}\n"
                             "  pivot: {revolute: [frame, rocker], at: [1, 0]}\n"
                             "drives: {turn: {drive: motor.angle, value: \"if(t < 0.1, 0, t - 0.1)\"}}\n"
                             "initial: {fly.angle_rate: 3}\n"
                             "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n";

static void open_text(struct opened *o, const char *text)
{
    char path[] = "/tmp/t-condense-XXXXXX";
    const struct deck_options options = {0};
    const struct sim_options quiet = {.version = "test"};
    struct report report = {0};
    struct scene *scene;
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, strlen(text)), (ssize_t)strlen(text));
    close(fd);
    memset(o, 0, sizeof *o);
    o->life = arena_open();
    struct diags *diags = diags_open(o->life);
    enum status status = sim_load(&scene, path, &options, diags, o->life, &report);
    if (status == OK) status = sim_open(&o->sim, scene, &scene->integrate, &quiet, diags, o->life, &report);
    unlink(path);
    if (status != OK) diags_print(stderr, diags, 0);
    assert_int_equal(status, OK);
    o->ode = o->sim.stepper.ode;
    o->n = o->ode->n;
}

/* Some way from the start, with any velocities and accelerations. */
static void scatter(struct opened *o, unsigned seed)
{
    struct tree_dice d = {seed};
    double dx[MOST];
    for (int i = 0; i < o->n; i++) {
        dx[i] = tree_roll(&d, -.2, .2);
        o->v[i] = tree_roll(&d, -2, 2);
        o->a[i] = tree_roll(&d, -5, 5);
    }
    o->ode->move->point(o->ode, o->q, o->sim.x.q, dx, 1, 0);
    assert_true(isfinite(o->q[0]));
}

static void resid(const struct opened *o, double *r, const double *a, unsigned cls)
{
    struct trouble why;
    const struct instant x = {.t = .3, .q = o->q, .v = o->v, .a = a};
    assert_int_equal(o->ode->ops->resid(o->ode, r, NULL, NULL, &x, cls, &why), OK);
}

static void near_all(const double *a, const double *b, int n, double within)
{
    for (int i = 0; i < n; i++)
        if (!(fabs(a[i] - b[i]) <= within)) fail_msg("[%d]: %.15g, %.15g", i, a[i], b[i]);
}

/* r = M a + r(a = 0), by classes; the classes add up; fast rows know nothing of slow bodies; the same bits twice. */
static void laws_of(const char *text)
{
    struct opened o;
    open_text(&o, text);
    for (unsigned seed = 1; seed <= 20; seed++) {
        double r[4][MOST], r0[MOST], M[MOST * MOST], again[MOST];
        struct trouble why;
        scatter(&o, seed);
        for (unsigned cls = FAST; cls <= ALL; cls++) {
            resid(&o, r[cls], o.a, cls);
            resid(&o, r0, NULL, cls);
            resid(&o, again, o.a, cls);
            assert_memory_equal(again, r[cls], sizeof *again * (size_t)o.n);
            assert_int_equal(o.ode->ops->mass(o.ode, M, o.q, .3, cls, &why), OK);
            for (int i = 0; i < o.n; i++)
                for (int j = 0; j < o.n; j++) r0[i] += M[i + j * o.n] * o.a[j];
            near_all(r[cls], r0, o.n, 1e-10);
        }
        for (int i = 0; i < o.n; i++) assert_true(fabs(r[FAST][i] + r[SLOW][i] - r[ALL][i]) < 1e-10);
        for (int i = 0; i < o.ode->ns; i++) assert_true(r[SLOW][i] == 0);
    }
    arena_close(o.life);
}

static void laws(void **state)
{
    (void)state;
    laws_of(plane);
    laws_of(room);
}

static void classes(void **state)
{
    (void)state;
    struct opened o;
    open_text(&o, plane);
    const struct model *m = o.sim.model;
    assert_int_equal(m->ncomponent, 2);
    assert_int_equal(o.n, 3);
    assert_int_equal(o.ode->ns, 1);
    assert_string_equal(sim_coordinate_name(&o.sim, 0), "e1.angle");
    for (int i = 1; i < m->nbody; i++) assert_int_equal(m->body[i].fast, m->body[i].name[1] == '1');
    static const struct {
        const char *name;
        unsigned cls;
    } force[] = {{"k1", FAST}, {"k2", SLOW}, {"k3", FAST}, {"k4", SLOW}, {"d", SLOW}, {"m", FAST}};
    for (int i = 0; i < m->nforce; i++) {
        assert_string_equal(m->force[i].name, force[i].name);
        assert_int_equal(m->force[i].cls, force[i].cls);
    }
    arena_close(o.life);
}

/* Along a path of constant v the whole tree moves with the velocities and, as these change, the accelerations that
 * condense_rates() tells: against differences of point(). */
static void rates_of(const char *text)
{
    struct opened o;
    open_text(&o, text);
    struct condense *c = system_loops(o.sim.system);
    const struct model *m = o.sim.model;
    struct moves moves;
    moves_build(&moves, m, o.life);
    for (unsigned seed = 1; seed <= 10; seed++) {
        static const double h = 1e-4;
        double vt[MOST], at[MOST], q[2][MOST], dx[MOST], w[2][MOST], zero[MOST] = {0};
        struct trouble why;
        scatter(&o, seed);
        assert_int_equal(condense_rates(c, vt, at, o.q, o.v, zero, 0, &why), OK);
        for (int side = 0; side < 2; side++) {
            double s = side ? h : -h, rate[MOST];
            for (int i = 0; i < o.n; i++) dx[i] = s * o.v[i];
            o.ode->move->point(o.ode, q[side], o.q, dx, 1, 0);
            o.ode->move->rate(o.ode, rate, q[side], o.q, dx, o.v, 0);
            assert_true(condense_worst(c, q[side], 0) < 1e-13);
            /* rate() is 1 plus terms of second order along the path itself */
            for (int i = 0; i < o.n; i++) assert_true(fabs(rate[i] - o.v[i]) < 1e-2);
            assert_int_equal(condense_rates(c, w[side], NULL, q[side], o.v, NULL, 0, &why), OK);
        }
        moves_diff(&moves, dx, q[1], q[0]);
        for (int i = 0; i < m->n; i++) assert_true(fabs(dx[i] / (2 * h) - vt[i]) < 1e-5 * (1 + fabs(vt[i])));
        for (int i = 0; i < m->n; i++)
            assert_true(fabs((w[1][i] - w[0][i]) / (2 * h) - at[i]) < 1e-4 * (1 + fabs(at[i])));
    }
    arena_close(o.life);
}

static void rates(void **state)
{
    (void)state;
    rates_of(plane);
    rates_of(room);
}

/* q0 (+) dx and back; halves of a way lie on the closed manifold. */
static void ways(void **state)
{
    (void)state;
    static const char *const decks[] = {plane, room};
    for (int deck = 0; deck < 2; deck++) {
        struct opened o;
        open_text(&o, decks[deck]);
        struct condense *c = system_loops(o.sim.system);
        for (unsigned seed = 1; seed <= 10; seed++) {
            struct tree_dice d = {seed};
            double dx[MOST], back[MOST], q1[MOST], q2[MOST];
            scatter(&o, seed);
            for (int i = 0; i < o.n; i++) dx[i] = tree_roll(&d, -.1, .1);
            o.ode->move->point(o.ode, q1, o.q, dx, 1, 0);
            o.ode->move->diff(o.ode, back, q1, o.q);
            near_all(back, dx, o.n, 1e-12);
            o.ode->move->point(o.ode, q2, o.q, dx, .5, 0);
            assert_true(condense_worst(c, q1, 0) < 1e-13 && condense_worst(c, q2, 0) < 1e-13);
            for (int i = 0; i < o.n; i++) dx[i] = -dx[i];
            o.ode->move->point(o.ode, q2, q1, dx, 1, 0);
            near_all(q2, o.q, o.ode->nq, 1e-11);
            memcpy(q2, q1, sizeof q1); /* in place */
            o.ode->move->point(o.ode, q2, q2, dx, 1, 0);
            near_all(q2, o.q, o.ode->nq, 1e-11);
        }
        arena_close(o.life);
    }
}

/* From the posture of another displacement, near or far: where point() goes, from wherever it has been called between.
 */
static void ways_from_another(void **state)
{
    (void)state;
    static const char *const decks[] = {plane, room, hung, bending};
    for (int deck = 0; deck < 4; deck++) {
        struct opened o;
        open_text(&o, decks[deck]);
        struct condense *c = system_loops(o.sim.system);
        int reached = 0;
        for (unsigned seed = 1; seed <= 60; seed++) {
            static const double size[] = {0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 1};
            struct tree_dice d = {seed};
            const double s = seed % 3 ? 1 : .5, change = size[seed % 8];
            double dx[MOST], q[MOST], want[MOST];
            const double reach = deck < 3 ? .1 : .02;
            memcpy(o.q, o.sim.x.q, sizeof *o.q * (size_t)o.ode->nq);
            if (deck < 3) scatter(&o, seed);
            for (int i = 0; i < o.n; i++) dx[i] = tree_roll(&d, -reach, reach);
            o.ode->move->point(o.ode, q, o.q, dx, s, 0);
            for (int pass = 0; pass < 2; pass++) { /* again() from point(), then from again() */
                for (int i = 0; i < o.n; i++) dx[i] += change * tree_roll(&d, -reach, reach);
                o.ode->move->point(o.ode, want, o.q, dx, s, 0);
                o.ode->move->again(o.ode, q, o.q, dx, s, 0, 0);
                assert_true(isnan(want[0]) == isnan(q[0]));
                if (isnan(q[0])) break; /* out of reach */
                reached++;
                assert_true(condense_worst(c, q, 0) < 1e-14);
                near_all(q, want, o.ode->nq, 2e-13);
            }
        }
        assert_true(reached > 100);
        arena_close(o.life);
    }
}

/* Iterates that come nearer and nearer: one on the way is left open by the square of a small way, the last one is closed. */
static void ways_left_open(void **state)
{
    (void)state;
    static const char *const decks[] = {plane, bending};
    for (int deck = 0; deck < 2; deck++) {
        struct opened o;
        open_text(&o, decks[deck]);
        struct condense *c = system_loops(o.sim.system);
        int left_open = 0;
        for (unsigned seed = 1; seed <= 60; seed++) {
            static const double size[] = {3e-6, 3e-7, 3e-8, 1e-10};
            struct tree_dice d = {seed};
            const double s = seed % 3 ? 1 : .5, reach = deck == 0 ? .1 : .02;
            double dx[MOST], q[MOST], want[MOST];
            bool open = false;
            memcpy(o.q, o.sim.x.q, sizeof *o.q * (size_t)o.ode->nq);
            if (deck == 0) scatter(&o, seed);
            for (int i = 0; i < o.n; i++) dx[i] = tree_roll(&d, -reach, reach);
            o.ode->move->point(o.ode, q, o.q, dx, s, 0);
            for (int k = 0; k < 4 && !isnan(q[0]); k++) {
                const int before = open ? OPEN_BEFORE : 0;
                for (int i = 0; i < o.n; i++) dx[i] += size[k] * tree_roll(&d, -1, 1);
                open = o.ode->move->again(o.ode, q, o.q, dx, s, 0, before | (k < 3 ? OPEN_AFTER : 0));
                assert_true(condense_worst(c, q, 0) < (open ? 4e-12 : 1e-14));
                left_open += open;
            }
            o.ode->move->point(o.ode, want, o.q, dx, s, 0);
            assert_false(open);
            if (!isnan(q[0])) near_all(q, want, o.ode->nq, 2e-13);
        }
        assert_true(left_open > 10);
        arena_close(o.life);
    }
}

/* A look for a better split that finds none, because only the present one is good enough, leaves everything as it
 * was. */
static void a_look_in_vain(void **state)
{
    (void)state;
    struct opened o;
    open_text(&o, room);
    struct condense *c = system_loops(o.sim.system);
    struct ode2 *ode = condense_ode2(c);
    struct part *p = &c->split.part[0];
    struct tree_dice d = {5};
    int looks = 0;
    scatter(&o, 1);
    for (int k = 0; k < p->of->nk; k++) p->weight[k] = p->place[k] < 0 ? 1e-9 : 1;
    for (int step = 0; step < 1000; step++) { /* a walk at random */
        double before[MOST], after[MOST], q[MOST], v[MOST], dx[MOST];
        for (int i = 0; i < o.n; i++) dx[i] = tree_roll(&d, -.1, .1);
        ode->move->point(ode, q, o.q, dx, 1, .3);
        if (isnan(q[0])) continue;
        memcpy(o.q, q, sizeof q);
        memcpy(v, o.v, sizeof v);
        resid(&o, before, o.a, ALL);
        p->least_gain = p->resplit_due = 0;
        assert_int_equal(ode->chart->rechart(ode, o.q, o.v, .3), 0);
        looks += p->resplit_due;
        assert_memory_equal(o.q, q, sizeof *q * (size_t)ode->nq);
        assert_memory_equal(o.v, v, sizeof *v * (size_t)o.n);
        resid(&o, after, o.a, ALL);
        assert_memory_equal(after, before, sizeof *after * (size_t)o.n);
    }
    assert_true(looks >= 10);
    arena_close(o.life);
}

/* A posture that cannot be reached is not a number, and the residual says which loop. */
static void out_of_reach(void **state)
{
    (void)state;
    struct opened o;
    open_text(&o, room);
    double dx[MOST] = {0}, q[MOST], r[MOST];
    struct trouble why = {0};
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < o.n; k++) dx[k] = (i >> k & 1 ? 1 : -1) * 2.5;
        o.ode->move->point(o.ode, q, o.sim.x.q, dx, 1, 0);
        if (!isfinite(q[0])) break;
    }
    assert_false(isfinite(q[0]));
    const struct instant x = {.q = q, .v = o.v};
    assert_int_equal(o.ode->ops->resid(o.ode, r, NULL, NULL, &x, ALL, &why), E_NUMERIC);
    assert_int_equal(why.code, TROUBLE_CLOSURE);
    assert_int_equal(why.index, 0);
    arena_close(o.life);
}

/* What asks for velocities there is refused, or not a number; where they can be had, it is not. */
static void velocities_out_of_reach(void **state)
{
    (void)state;
    struct opened o;
    double nowhere[MOST], rate[MOST], zero[MOST] = {0};
    for (int i = 0; i < MOST; i++) nowhere[i] = NAN;
    open_text(&o, room);
    scatter(&o, 1);
    o.ode->move->rate(o.ode, rate, nowhere, o.q, zero, o.v, 0);
    for (int i = 0; i < o.n; i++) assert_true(isnan(rate[i]));
    o.ode->move->rate(o.ode, rate, o.q, o.q, zero, o.v, 0);
    for (int i = 0; i < o.n; i++) assert_true(isfinite(rate[i]));
    arena_close(o.life);
    open_text(&o, flying);
    for (int good = 0; good < 2; good++) {
        const enum status wanted = good ? OK : E_NUMERIC;
        const double *q = good ? o.sim.x.q : nowhere;
        const struct instant x = {.qa = q, .qb = q, .va = o.v, .vb = o.v, .ta = 0, .tb = .01, .q = q, .v = o.v};
        struct trouble why = {0};
        double q1[MOST], v[MOST] = {1, 2, 3}, work = 0;
        int met = 0;
        memcpy(q1, o.sim.x.q, sizeof *q1 * (size_t)o.ode->nq);
        assert_int_equal(o.ode->breaks->jump(o.ode, &met, v, &work, q, .05, .15, &why), wanted);
        assert_int_equal(met, 1);
        assert_true((v[0] == 1 && v[1] == 2 && v[2] == 3 && work == 0) != good);
        assert_int_equal(o.ode->settle(o.ode, q1, v, &x, &why), wanted);
        assert_int_equal(why.code, good ? TROUBLE_NONE : TROUBLE_CLOSURE);
    }
    arena_close(o.life);
}

/* Balls that are independent in part: a method of order 4 keeps the energy as such a method does. */
static void energy(void **state)
{
    (void)state;
    struct opened o;
    char text[sizeof plane + sizeof room];
    snprintf(text, sizeof text, "%s", room);
    char *at = strstr(text, "scheme: newmark, step: 1.0e-3");
    memcpy(at, "scheme: rk4    , step: 1.0e-3", strlen("scheme: newmark, step: 1.0e-3"));
    open_text(&o, text);
    struct report report = {0};
    assert_int_equal(sim_run(&o.sim, NULL, &report), OK);
    assert_true(o.sim.ledger.worst < 1e-5 * o.sim.ledger.norm);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws),
        cmocka_unit_test(classes),
        cmocka_unit_test(rates),
        cmocka_unit_test(ways),
        cmocka_unit_test(ways_from_another),
        cmocka_unit_test(ways_left_open),
        cmocka_unit_test(a_look_in_vain),
        cmocka_unit_test(out_of_reach),
        cmocka_unit_test(velocities_out_of_reach),
        cmocka_unit_test(energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
