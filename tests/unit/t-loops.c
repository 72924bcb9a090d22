/* t-loops.c -- loops from deck to motion: what becomes of joints, hard starts, partitions that change. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "loop/condense.h"
#include "sim/load.h"
#include "sim/sim.h"
#include "unit/decks.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* decks/bricard.yaml with pin i marked to close the loop. */
static void open_bricard(struct opened *o, int i)
{
    char text[4000], deck[4100], pin[20];
    FILE *file = fopen("decks/bricard.yaml", "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    snprintf(pin, sizeof pin, "pin%d:", i);
    char *at = strstr(text, pin);
    assert_non_null(at);
    at = strchr(at, '}');
    snprintf(deck, sizeof deck, "%.*s, loop: true%s", (int)(at - text), text, at);
    at = strstr(deck, "scheme: midpoint, step: 1.0e-3, until: 10");
    assert_non_null(at);
    memcpy(at, "scheme: dopri5,tolerance: 1e-12, until: 1", strlen("scheme: midpoint, step: 1.0e-3, until: 10"));
    open_text(o, deck);
}

static void run(struct opened *o)
{
    assert_int_equal(o->status, OK);
    o->status = sim_run(&o->sim, NULL, &o->report);
}

/* A joint coordinate, or its rate, at the present state. */
static double coordinate(struct opened *o, const char *name, bool rate)
{
    const struct model *m = o->sim.model;
    struct trouble why;
    assert_int_equal(system_evaluate(o->sim.system, o->sim.x.q, o->sim.x.v, o->sim.x.t, EVALUATE_MOTION, &why), OK);
    for (int i = 0; i < m->ncoordinate; i++)
        if (strcmp(m->coordinate[i].name, name) == 0)
            return rate ? system_rates(o->sim.system)[m->coordinate[i].iv] : o->sim.x.q[m->coordinate[i].iq];
    fail_msg("no coordinate %s", name);
    return 0;
}

static void near_to(double a, double b, double within)
{
    if (!(fabs(a - b) <= within)) fail_msg("%.15g should be %.15g within %g", a, b, within);
}

static bool independent(const struct opened *o, const char *name)
{
    for (int i = 0; i < o->sim.stepper.ode->n; i++)
        if (strcmp(sim_coordinate_name(&o->sim, i), name) == 0) return true;
    return false;
}

/* --- decks ---------------------------------------------------------------------------------------- */

#define PLAN "integrate: {scheme: dopri5, tolerance: 1.0e-11, until: "

/* Cranks of 1 m on a base of 2 m, at the angle a; a third one, in the middle, longer by `more`. */
static void parallelogram(char *text, size_t size, double a, const char *third, const char *also)
{
    snprintf(text, size,
             "fmdsub: 1\n"
             "parameters: {a: %.17g}\n"
             "bodies:\n"
             "  left: {mass: 1, inertia: 1/12, at: [0.5*cos(a), 0.5*sin(a)]}\n"
             "  right: {mass: 1, inertia: 1/12, at: [2 + 0.5*cos(a), 0.5*sin(a)]}\n"
             "  bar: {mass: 2, inertia: 2/3, at: [1 + cos(a), sin(a)]}\n"
             "%s"
             "constraints:\n"
             "  l: {revolute: [ground, left], at: [0, 0]}\n"
             "  r: {revolute: [ground, right], at: [2, 0]}\n"
             "  ul: {revolute: [left, bar], at: [cos(a), sin(a)]}\n"
             "  ur: {revolute: [bar, right], at: [2 + cos(a), sin(a)]}\n"
             "%s",
             a, third ? "  middle: {mass: 1, inertia: 1/12, at: [1 + 0.5*cos(a), 0.5*sin(a)]}\n" : "",
             third ? third : "");
    snprintf(text + strlen(text), size - strlen(text), "%s" PLAN "1}\n", also);
}

/* H01: r = 0.15 m, l = 0.35 m; the rod's angle is -asin(r/l sin a). */
static void slider_crank(char *text, size_t size, double a, const char *also)
{
    snprintf(text, size,
             "fmdsub: 1\n"
             "parameters: {r: 0.15, l: 0.35, a: %.17g, b: -asin(r/l*sin(a))}\n"
             "bodies:\n"
             "  crank: {mass: 1, inertia: 0.01, at: [0.5*r*cos(a), 0.5*r*sin(a)]}\n"
             "  rod: {mass: 1, inertia: 0.01, at: [r*cos(a) + 0.5*l*cos(b), 0.5*r*sin(a)]}\n"
             "  slider: {mass: 0.5, inertia: 1, at: [r*cos(a) + l*cos(b), 0]}\n"
             "constraints:\n"
             "  shaft: {revolute: [ground, crank], at: [0, 0]}\n"
             "  elbow: {revolute: [crank, rod], at: [r*cos(a), r*sin(a)]}\n"
             "  wrist: {revolute: [rod, slider], at: [r*cos(a) + l*cos(b), 0]}\n"
             "  rail: {prismatic: [ground, slider], at: [0, 0], axis: [1, 0]}\n"
             "%s",
             a, also);
}

/* --- tree and loops ------------------------------------------------------------------------------- */

static void what_joints_become(void **state)
{
    (void)state;
    struct opened o;
    char text[3000];
    parallelogram(text, sizeof text, .3, NULL, "initial: {l.angle_rate: 1}\n");
    open_text(&o, text);
    assert_int_equal(o.status, OK);
    assert_int_equal(o.sim.model->nloop, 1);
    assert_string_equal(o.sim.model->loop[0].name, "ur");
    assert_int_equal(o.sim.model->n, 3);
    assert_int_equal(o.sim.stepper.ode->n, 1);
    assert_int_equal(o.sim.stepper.ode->nq, 3);
    assert_true(independent(&o, "l.angle"));
    shut(&o);
    /* joints that are asked for come into the tree, wherever they stand */
    parallelogram(text, sizeof text, .3, NULL, "initial: {ur.angle_rate: 1}\n");
    open_text(&o, text);
    assert_int_equal(o.status, OK);
    assert_string_equal(o.sim.model->loop[0].name, "ul");
    assert_true(independent(&o, "ur.angle"));
    near_to(coordinate(&o, "l.angle", true), 1, 1e-12); /* the bar does not turn: the crank turns against it */
    shut(&o);
    /* a joint that is to close the loop does */
    parallelogram(text, sizeof text, .3, NULL, "");
    char *at = strstr(text, "l: {revolute: [ground, left], at: [0, 0]");
    char marked[3200];
    snprintf(marked, sizeof marked, "%.*sl: {revolute: [ground, left], at: [0, 0], loop: true%s", (int)(at - text),
             text, at + strlen("l: {revolute: [ground, left], at: [0, 0]"));
    open_text(&o, marked);
    assert_int_equal(o.status, OK);
    assert_string_equal(o.sim.model->loop[0].name, "l");
    shut(&o);
    /* not all coordinates of a loop can be asked for */
    parallelogram(text, sizeof text, .3, NULL,
                  "initial: {l.angle_rate: 0, r.angle_rate: 0, ul.angle_rate: 0, ur.angle_rate: 0}\n");
    open_text(&o, text);
    assert_int_equal(o.status, E_DECK);
    shut(&o);
}

/* `initial:` moves a closed mechanism: what follows, follows; a dependent coordinate must fit. */
static void starts(void **state)
{
    (void)state;
    struct opened o;
    char text[3000];
    parallelogram(text, sizeof text, .3, NULL, "initial: {l.angle: 0.9, l.angle_rate: 2}\n");
    open_text(&o, text);
    assert_int_equal(o.status, OK);
    near_to(coordinate(&o, "l.angle", false), .9, 0);
    near_to(coordinate(&o, "r.angle", false), .9, 1e-12);
    near_to(coordinate(&o, "ul.angle", false), -.9, 1e-12);
    near_to(coordinate(&o, "r.angle", true), 2, 1e-12);
    shut(&o);
    parallelogram(text, sizeof text, .3, NULL, "initial: {l.angle: 0.9, r.angle: 0.9, l.angle_rate: 2}\n");
    open_text(&o, text);
    assert_int_equal(o.status, OK);
    shut(&o);
    parallelogram(text, sizeof text, .3, NULL, "initial: {l.angle_rate: 2, r.angle_rate: 1.9}\n");
    open_text(&o, text);
    assert_int_equal(o.status, E_MODEL);
    assert_non_null(strstr(o.report.text, "does not fit"));
    shut(&o);
}

/* --- hard starts ---------------------------------------------------------------------------------- */

/* The deck's choice is singular: both coordinates are named. */
static void forced_choice(void **state)
{
    (void)state;
    struct opened o;
    char text[3000];
    slider_crank(text, sizeof text, 0, "partition: {independent: [rail]}\n" PLAN "1}\n");
    open_text(&o, text);
    assert_int_equal(o.status, E_MODEL);
    assert_non_null(strstr(o.report.text, "'rail.displacement' cannot be independent"));
    assert_non_null(strstr(o.report.text, "choose '"));
    assert_null(strstr(o.report.text, "choose 'rail"));
    shut(&o);
}

/* A plate on two rods: one of its three coordinates is independent, the one that the deck names; of two rods all but in
 * line both still hold, as drawn they miss by nothing. */
static void plate_on_rods(char *text, size_t size, double apart, const char *also)
{
    snprintf(text, size,
             "fmdsub: 1\n"
             "bodies:\n"
             "  plate: {mass: 1, inertia: 1, at: [1, 0.3], points: {p: [0, 0], q: [0.2, %.17g]}}\n"
             "constraints:\n"
             "  float: {free: [ground, plate], at: [1, 0.3]}\n"
             "  first: {distance: [ground, plate.p]}\n"
             "  second: {distance: [ground, plate.q]}\n"
             "%s" PLAN "1}\n",
             .06 + apart, also);
}

static void chosen_of_three(void **state)
{
    (void)state;
    static const char *const name[] = {"x", "y", "angle"};
    for (int i = 0; i < 3; i++) {
        struct opened o;
        char text[3000], also[100], coordinate_name[40];
        snprintf(also, sizeof also, "partition: {independent: [float.%s]}\n", name[i]);
        plate_on_rods(text, sizeof text, .8, also);
        open_text(&o, text);
        assert_int_equal(o.status, OK);
        assert_int_equal(o.sim.stepper.ode->n, 1);
        snprintf(coordinate_name, sizeof coordinate_name, "float.%s", name[i]);
        assert_true(independent(&o, coordinate_name));
        shut(&o);
    }
}

static void nearly_in_line(void **state)
{
    (void)state;
    struct opened o;
    char text[3000];
    plate_on_rods(text, sizeof text, 1e-3, "");
    open_text(&o, text);
    assert_int_equal(o.status, OK);
    assert_int_equal(condense_started(system_loops(o.sim.system))->redundant, 0);
    assert_int_equal(o.sim.stepper.ode->n, 1);
    shut(&o);
}

static void bifurcation(void **state)
{
    (void)state;
    struct opened o;
    char text[3000];
    parallelogram(text, sizeof text, 0, NULL, "");
    open_text(&o, text);
    assert_int_equal(o.status, E_MODEL);
    assert_non_null(strstr(o.report.text, "stands at a dead point, or is locked"));
    shut(&o);
}

/* Three cranks: exact, they move as two do; a little too long is closed with a word; longer is refused. */
static void third_crank(void **state)
{
    (void)state;
    struct opened o;
    char text[3000], third[300];
    static const double more[] = {0, 1e-6, 1e-2};
    for (int i = 0; i < 3; i++) {
        snprintf(third, sizeof third,
                 "  m: {revolute: [ground, middle], at: [1, 0]}\n"
                 "  um: {revolute: [bar, middle], at: [1 + cos(a), sin(a)]}\n");
        parallelogram(text, sizeof text, .3, third, "initial: {l.angle_rate: 2}\n");
        open_text(&o, text);
        assert_int_equal(o.status, OK);
        struct model *m = (struct model *)o.sim.model;
        struct model_loop *loop = (struct model_loop *)m->loop;
        for (int l = 0; l < m->nloop; l++)
            if (strcmp(loop[l].name, "um") == 0) loop[l].b[0] += more[i], loop[l].b[1] += 0;
        struct system *s = system_build(m, o.life);
        const struct condense_start *start = condense_started(system_loops(s));
        if (i < 2) {
            assert_int_equal(start->status, OK);
            assert_int_equal(system_ode2(s)->n, 1);
            assert_int_equal(start->redundant, 1);
        } else {
            assert_int_equal(start->status, E_MODEL);
            assert_non_null(strstr(start->report.text, "'um'"));
        }
        shut(&o);
    }
}

/* A coupler without mass is nothing special: M^ is regular. */
static void massless_coupler(void **state)
{
    (void)state;
    double angle[2];
    for (int i = 0; i < 2; i++) {
        const char *const set[] = {i ? "bodies.coupler.mass=1e-12" : "bodies.coupler.mass=0",
                                   i ? "bodies.coupler.inertia=1e-12" : "bodies.coupler.inertia=0"};
        struct opened o;
        open_path(&o, "decks/four-bar.yaml", 2, set);
        run(&o);
        angle[i] = coordinate(&o, "shaft.angle", false);
        shut(&o);
    }
    near_to(angle[0], angle[1], 1e-6);
}

/* --- motion ---------------------------------------------------------------------------------------- */

/* Independent as the slider is, it stops at the dead centres: another coordinate takes over, and the motion is that of
 * the crank's own choice. */
static void partition_changes(void **state)
{
    (void)state;
    double angle[2], rate[2], worst[2];
    static const char *const choice[] = {"independent: [shaft]", "independent: [rail]"};
    for (int i = 0; i < 2; i++) {
        struct opened o;
        char text[3000], also[300];
        snprintf(also, sizeof also,
                 "partition: {%s}\ninitial: {%s}\nintegrate: {scheme: dopri5, tolerance: 1.0e-12, until: 1}\n"
                 "output: {every: 0.01}\n",
                 choice[i], i ? "rail.displacement_rate: RATE" : "shaft.angle_rate: 10");
        slider_crank(text, sizeof text, .7, also);
        if (i) { /* x' = -r w sin a - l b' sin b, b' = -r w cos a/(l cos b) */
            double r = .15, l = .35, a = .7, w = 10, b = -asin(r / l * sin(a)), bb = -r * w * cos(a) / (l * cos(b));
            char number[40], *at = strstr(text, "RATE"), rest[400];
            snprintf(number, sizeof number, "%.17g", -r * w * sin(a) - l * bb * sin(b));
            snprintf(rest, sizeof rest, "%s", at + 4);
            snprintf(at, sizeof text - (size_t)(at - text), "%s%s", number, rest);
        }
        open_text(&o, text);
        assert_int_equal(o.status, OK);
        assert_true(independent(&o, i ? "rail.displacement" : "shaft.angle"));
        run(&o);
        assert_int_equal(o.status, OK);
        if (i)
            assert_true(system_charts(o.sim.system) >= 1);
        else
            assert_int_equal(system_charts(o.sim.system), 0);
        angle[i] = coordinate(&o, "shaft.angle", false);
        rate[i] = coordinate(&o, "shaft.angle", true);
        worst[i] = o.sim.ledger.worst / o.sim.ledger.norm;
        shut(&o);
    }
    near_to(angle[1], angle[0], 1e-8);
    near_to(rate[1], rate[0], 1e-7);
    assert_true(worst[0] < 1e-9 && worst[1] < 1e-8);
}

/* Velocities go over exactly: towards the dead centre, half of the way left at a time, until another coordinate takes
 * over; the energy before and after is the same number but for round-off. */
static void nothing_is_lost(void **state)
{
    (void)state;
    struct opened o;
    char text[3000];
    slider_crank(text, sizeof text, .7,
                 "partition: {independent: [rail]}\ninitial: {rail.displacement_rate: 1}\n" PLAN "1}\n");
    open_text(&o, text);
    assert_int_equal(o.status, OK);
    struct state *x = &o.sim.x;
    struct ode2 *ode = (struct ode2 *)o.sim.stepper.ode;
    struct energies before, after;
    const double r = .15, l = .35, a = .7, drawn = r * cos(a) + l * cos(asin(r / l * sin(a)));
    int steps = 0;
    do {
        double dx = (r + l - drawn - coordinate(&o, "rail.displacement", false)) / 2;
        ode->move->point(ode, x->q, x->q, &dx, 1, 0);
        assert_int_equal(system_energy_at(o.sim.system, &before, x->q, x->v, 0, &(struct trouble){0}), OK);
        assert_true(++steps < 20);
    } while (!ode->chart->rechart(ode, x->q, x->v, 0));
    assert_false(independent(&o, "rail.displacement"));
    assert_int_equal(system_energy_at(o.sim.system, &after, x->q, x->v, 0, &(struct trouble){0}), OK);
    near_to(after.kinetic, before.kinetic, 1e-12 * before.kinetic);
    near_to(coordinate(&o, "rail.displacement", true), 1, 1e-12);
    assert_int_equal(ode->chart->rechart(ode, x->q, x->v, 0), 0); /* once is enough */
    shut(&o);
}

/* H05: which joint closes the loop, and with it which row is dropped, does not change the motion. */
static void bricard_any_way(void **state)
{
    (void)state;
    double x[6];
    for (int i = 1; i < 6; i++) { /* the deck prints the angle of the first */
        struct opened o;
        struct trouble why;
        struct pose p;
        open_bricard(&o, i + 1);
        assert_int_equal(o.status, OK);
        assert_int_equal(o.sim.model->nloop, 1);
        assert_int_equal(o.sim.model->loop[0].name[3], '1' + i);
        const struct condense_start *s = condense_started(system_loops(o.sim.system));
        assert_int_equal(s->redundant, 1);
        assert_int_equal(condense_loops(system_loops(o.sim.system))->nrow, 5);
        run(&o);
        assert_int_equal(o.status, OK);
        assert_int_equal(system_evaluate(o.sim.system, o.sim.x.q, o.sim.x.v, 1, EVALUATE_MOTION, &why), OK);
        for (int b = 1; b < o.sim.model->nbody; b++)
            if (strcmp(o.sim.model->body[b].name, "bar3") == 0) system_pose(o.sim.system, &p, b);
        x[i] = p.r[0] + 2 * p.r[1] + 3 * p.r[2];
        assert_true(system_constraint_worst(o.sim.system) < 1e-12);
        shut(&o);
    }
    for (int i = 2; i < 6; i++) near_to(x[i], x[1], 1e-9);
}

/* H03: the beams stay level through every flat posture; |C| stays closed. */
static void through_singular_postures(void **state)
{
    (void)state;
    for (int n = 1; n <= 5; n += 4) {
        char number[40];
        snprintf(number, sizeof number, "parameters.N=%d", n);
        const char *const set[] = {number, "integrate.step=2e-3"};
        struct opened o;
        open_path(&o, "decks/windows.yaml", 2, set);
        run(&o);
        assert_int_equal(o.status, OK);
        for (int i = 1; i <= n; i++) {
            char left[40], foot[40];
            snprintf(left, sizeof left, "left%d.angle", i);
            snprintf(foot, sizeof foot, "foot%d.angle", i);
            near_to(coordinate(&o, left, false), -coordinate(&o, foot, false), 1e-9);
        }
        assert_true(system_constraint_worst(o.sim.system) < 1e-12);
        shut(&o);
    }
}

/* Small steps come close to the flat postures, some very close: N = 2 after ten passes, by elliptic functions. */
static void close_to_singular_postures(void **state)
{
    (void)state;
    static const char *const step[] = {"integrate.step=2.5e-4", "integrate.step=1.25e-4"};
    for (int i = 0; i < 2; i++) {
        struct opened o;
        struct trouble why;
        struct pose p;
        open_path(&o, "decks/windows.yaml", 1, &step[i]);
        run(&o);
        assert_int_equal(o.status, OK);
        assert_int_equal(system_evaluate(o.sim.system, o.sim.x.q, o.sim.x.v, 10, EVALUATE_MOTION, &why), OK);
        system_pose(o.sim.system, &p, 1);
        near_to(2 * p.r[0], .3284581115, 1e-6);
        near_to(2 * p.r[1], .9445185382, 1e-6);
        assert_true(o.sim.ledger.worst < 1e-4);
        shut(&o);
    }
}

/* H06: what is redundant, and whose reactions are not unique. */
static void marks(void **state)
{
    (void)state;
    struct opened o;
    bool unique[4], unique_joint[8];
    open_path(&o, "tests/decks/spatial-four-bar.yaml", 0, NULL);
    assert_int_equal(o.status, OK);
    assert_int_equal(condense_started(system_loops(o.sim.system))->redundant, 3);
    condense_mark(system_loops(o.sim.system), unique, unique_joint);
    assert_false(unique[0]);
    for (int i = 0; i < o.sim.model->njoint; i++) assert_false(unique_joint[i]);
    shut(&o);
    open_path(&o, "decks/four-bar.yaml", 0, NULL);
    condense_mark(system_loops(o.sim.system), unique, unique_joint);
    assert_true(unique[0]);
    for (int i = 0; i < o.sim.model->njoint; i++) assert_true(unique_joint[i]);
    shut(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_joints_become),
        cmocka_unit_test(starts),
        cmocka_unit_test(forced_choice),
        cmocka_unit_test(chosen_of_three),
        cmocka_unit_test(nearly_in_line),
        cmocka_unit_test(bifurcation),
        cmocka_unit_test(third_crank),
        cmocka_unit_test(massless_coupler),
        cmocka_unit_test(partition_changes),
        cmocka_unit_test(nothing_is_lost),
        cmocka_unit_test(bricard_any_way),
        cmocka_unit_test(through_singular_postures),
        cmocka_unit_test(close_to_singular_postures),
        cmocka_unit_test(marks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
