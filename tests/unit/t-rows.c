/* t-rows.c -- rods, points on lines, gears, racks: their rows against differences, their decks against reduced
 * formulations in independent coordinates, integrated here. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "la/vec3.h"
#include "loop/loops.h"
#include "sim/load.h"
#include "sim/sim.h"
#include "unit/decks.h"
#include "unit/trees.h"

#include <cmocka.h>

/* --- rows against differences ---------------------------------------------------------------------- */

enum { LOOPS = 6, MOST_ROWS = 6 * LOOPS, MOST_V = 40 };

struct bench {
    struct arena *arena;
    struct model model;
    struct model_loop loop[LOOPS];
    const struct sweep_ops *ops;
    struct sweep *sweep;
    struct loops *loops;
};

/* Ties and joints anywhere: they need not be closed, rows have values everywhere. */
static void add_loop(struct bench *o, struct tree_dice *d, enum joint_type type)
{
    const int space = o->model.space;
    struct model_loop *l = &o->loop[o->model.nloop++];
    int a, b;
    tree_pair(&a, &b, d, o->model.nbody);
    *l = (struct model_loop){.name = "loop", .type = type, .first = a, .second = b, .number = tree_roll(d, .1, 2)};
    tree_vector(l->a, d, space);
    tree_vector(l->b, d, space);
    tree_axes(l->Ea, d, type, space);
    tree_axes(l->Eb, d, type, space);
    if (type != JOINT_GEAR && type != JOINT_RACK) return;
    l->nterm = 2;
    for (int i = 0; i < 2; i++) {
        const struct model_joint *j = &o->model.joint[tree_pick(d, o->model.njoint)];
        int k = tree_pick(d, j->nv);
        bool angular = j->type == JOINT_PLANAR        ? k == 2
                       : j->type == JOINT_CYLINDRICAL ? k == 0
                                                      : j->type != JOINT_PRISMATIC;
        l->term[i] = (struct model_term){(int)(j - o->model.joint), k, angular, tree_roll(d, -2, 2)};
    }
    if (l->term[0].joint == l->term[1].joint && l->term[0].k == l->term[1].k) l->nterm = 1;
}

static void open_bench(struct bench *o, int space, unsigned seed)
{
    static const enum joint_type kinds[LOOPS] = {JOINT_DISTANCE, JOINT_POINT_ON_LINE, JOINT_GEAR,
                                                 JOINT_DISTANCE, JOINT_RACK,          JOINT_PRISMATIC};
    struct tree_dice dice = {seed * 77u + 5u};
    memset(o, 0, sizeof *o);
    o->arena = arena_open();
    o->model = *random_tree(space, 4, seed, TREE_LIGHT | (seed % 2 ? TREE_CHAIN : 0), o->arena);
    o->model.loop = o->loop;
    for (int i = 0; i < LOOPS; i++) add_loop(o, &dice, kinds[i]);
    o->ops = space == 2 ? &sweep_planar : &sweep_spatial;
    o->sweep = o->ops->build(&o->model, FOR_RECORDS, NULL, o->arena);
    o->loops = loops_build(&o->model, o->ops, o->arena);
}

static void values_at(struct bench *o, double *C, const double *q)
{
    o->ops->place(o->sweep, q, ALL);
    loops_place(o->loops, o->sweep, q);
    loops_values(C, o->loops);
}

/* C along q + t v + t^2 a/2: first and second rates at 0, by differences of fourth order. */
static void rates(struct bench *o, double *C1, double *C2, const double *q, const double *v, const double *a)
{
    static const double h = 2e-3, first[] = {1. / 12, -2. / 3, 0, 2. / 3, -1. / 12},
                        second[] = {-1. / 12, 4. / 3, -5. / 2, 4. / 3, -1. / 12};
    double C[MOST_ROWS], x[MOST_V];
    for (int i = 0; i < o->loops->nrow; i++) C1[i] = C2[i] = 0;
    for (int p = 0; p < 5; p++) {
        double t = (p - 2) * h;
        for (int i = 0; i < o->model.n; i++) x[i] = q[i] + t * v[i] + t * t / 2 * a[i];
        values_at(o, C, x);
        for (int i = 0; i < o->loops->nrow; i++) {
            C1[i] += first[p] * C[i] / h;
            C2[i] += second[p] * C[i] / (h * h);
        }
    }
}

/* y += C_q x */
static void apply(const struct loops *o, double *y, const double *x)
{
    for (int i = 0; i < o->nrow; i++) {
        int l = o->row[i].loop;
        for (int k = 0; k < o->nk[l]; k++) y[i] += o->Cq[l][(i - o->first[l]) * o->nk[l] + k] * x[o->k[l][k]];
    }
}

/* C' = C_q v, C'' as loops_second() has it; a rod's rows grow as its points come together, so they are scaled. */
static void try_rows(int space, unsigned seed, double *worst)
{
    struct bench o;
    struct tree_dice dice = {seed * 3u + 1u};
    double q[MOST_V], v[MOST_V], a[MOST_V], C1[MOST_ROWS], C2[MOST_ROWS], second[MOST_ROWS], first[MOST_ROWS] = {0};
    open_bench(&o, space, seed);
    const int n = o.model.n;
    assert_true(n <= MOST_V && n == o.model.nq);
    for (int i = 0; i < n; i++)
        q[i] = tree_roll(&dice, -1, 1), v[i] = tree_roll(&dice, -1, 1), a[i] = tree_roll(&dice, -1, 1);
    rates(&o, C1, C2, q, v, a);
    o.ops->forward(o.sweep, q, v, a, ALL);
    loops_place(o.loops, o.sweep, q);
    loops_jacobian(o.loops, o.sweep);
    loops_second(second, o.loops, o.sweep, a);
    apply(o.loops, first, v);
    for (int i = 0; i < o.loops->nrow; i++) {
        const struct loop_row *r = &o.loops->row[i];
        if (o.loop[r->loop].type == JOINT_DISTANCE && v3_norm(o.loops->place[r->loop].d) < .3)
            continue; /* differences are too coarse */
        worst[0] = fmax(worst[0], fabs(first[i] - C1[i]) / (1 + fabs(C1[i])));
        worst[1] = fmax(worst[1], fabs(second[i] - C2[i]) / (1 + fabs(C2[i])));
    }
    arena_close(o.arena);
}

static void rows_are_derivatives(void **state)
{
    (void)state;
    for (int space = 2; space <= 3; space++) {
        double worst[2] = {0, 0};
        for (unsigned seed = 1; seed <= 200; seed++) try_rows(space, seed, worst);
        print_message("space %d: C' misses %.2g, C'' %.2g\n", space, worst[0], worst[1]);
        assert_true(worst[0] < 1e-7);
        assert_true(worst[1] < 1e-5);
    }
}

/* What is pushed comes out as C_q' lambda: r with it less r without; sums are a matter of their joints. */
static void try_push(int space, unsigned seed, double *worst)
{
    struct bench o;
    struct tree_dice dice = {seed * 5u + 2u};
    double q[MOST_V], v[MOST_V], lambda[MOST_ROWS], r[2][MOST_V], want[MOST_V] = {0};
    open_bench(&o, space, seed);
    for (int i = 0; i < o.model.n; i++) q[i] = tree_roll(&dice, -1, 1), v[i] = tree_roll(&dice, -1, 1);
    for (int i = 0; i < o.loops->nrow; i++) lambda[i] = tree_roll(&dice, -1, 1);
    for (int with = 0; with < 2; with++) {
        memset(r[with], 0, sizeof r[with]);
        o.ops->forward(o.sweep, q, v, NULL, ALL);
        loops_place(o.loops, o.sweep, q);
        loops_jacobian(o.loops, o.sweep);
        if (with) loops_push(o.loops, o.sweep, lambda);
        o.ops->backward(o.sweep, r[with], ALL);
    }
    for (int i = 0; i < o.loops->nrow; i++) {
        int l = o.loops->row[i].loop, nk = o.loops->nk[l];
        for (int k = 0; k < nk && o.loop[l].nterm == 0; k++)
            want[o.loops->k[l][k]] += o.loops->Cq[l][(i - o.loops->first[l]) * nk + k] * lambda[i];
    }
    for (int i = 0; i < o.model.n; i++) *worst = fmax(*worst, fabs(r[1][i] - r[0][i] - want[i]));
    arena_close(o.arena);
}

static void pushing_is_the_transpose(void **state)
{
    (void)state;
    for (int space = 2; space <= 3; space++) {
        double worst = 0;
        for (unsigned seed = 1; seed <= 200; seed++) try_push(space, seed, &worst);
        print_message("space %d: C_q' lambda misses %.2g\n", space, worst);
        assert_true(worst < 1e-12);
    }
}

/* --- decks ------------------------------------------------------------------------------------------ */

/* A deck up to its integrate:, then `also`, to be integrated closely to `until`. */
static void open_closely(struct opened *o, const char *path, const char *also, double until)
{
    char text[6000], deck[6200];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    char *end = strstr(text, "integrate:");
    assert_non_null(end);
    snprintf(deck, sizeof deck, "%.*s%sintegrate: {scheme: dopri5, tolerance: 1.0e-11, until: %g}\n", (int)(end - text),
             text, also, until);
    open_text(o, deck);
    assert_int_equal(o->status, OK);
}

static void see(struct opened *o)
{
    struct trouble why;
    const unsigned all = EVALUATE_ALL;
    assert_int_equal(system_evaluate(o->sim.system, o->sim.x.q, o->sim.x.v, o->sim.x.t, all, &why), OK);
}

static void run(struct opened *o)
{
    assert_int_equal(sim_run(&o->sim, NULL, &o->report), OK);
    see(o);
}

/* A column by its name, at what was last seen. */
static double column(const struct opened *o, const char *name)
{
    const struct model *m = o->sim.model;
    for (int i = 0; i < m->ncoordinate; i++) {
        const struct model_coordinate *c = &m->coordinate[i];
        size_t len = strlen(c->name);
        if (strncmp(c->name, name, len) != 0) continue;
        if (name[len] == 0) return o->sim.x.q[c->iq];
        if (strcmp(name + len, "_rate") == 0) return system_rates(o->sim.system)[c->iv];
        if (strcmp(name + len, "_accel") == 0) return system_accelerations(o->sim.system)[c->iv];
    }
    for (int i = 0; i < m->nloop; i++) {
        size_t len = strlen(m->loop[i].name);
        if (strncmp(m->loop[i].name, name, len) == 0 && strcmp(name + len, ".force") == 0)
            return system_loop_force(o->sim.system, i);
    }
    fail_msg("no column %s", name);
    return 0;
}

static void near_to(double a, double b, double within)
{
    if (!(fabs(a - b) <= within)) fail_msg("%.15g should be %.15g within %g", a, b, within);
}

/* One step of the classical Runge-Kutta method for y' = f(y). */
static void rk4(double *y, int n, double h, void (*f)(double *dy, const double *y))
{
    static const double at[] = {0, .5, .5, 1}, weight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
    double k[8] = {0}, x[8], sum[8] = {0};
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < n; i++) x[i] = y[i] + at[s] * h * k[i];
        f(k, x);
        for (int i = 0; i < n; i++) sum[i] += weight[s] * k[i];
    }
    for (int i = 0; i < n; i++) y[i] += h * sum[i];
}

/* Fourth-order central difference. */
static double slope(double (*f)(double), double x)
{
    static const double h = 1e-3;
    return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

static void a_gear_train_is_one_mass(void **state)
{
    (void)state;
    struct opened o;
    const double J = .02, i = 1 / 7.5, g = 9.81, al = (5 - i * 30 * g * .1) / J, t = .7;
    open_closely(&o, "decks/gear-train.yaml", "", t);
    assert_int_equal(o.sim.stepper.ode->n, 1);
    run(&o);
    near_to(column(&o, "shaft1.angle"), al * t * t / 2, 1e-9);
    near_to(column(&o, "shaft2.angle"), -al * t * t / 6, 1e-9);
    near_to(column(&o, "shaft3.angle"), i * al * t * t / 2, 1e-9);
    near_to(column(&o, "guide.displacement"), .1 * i * al * t * t / 2, 1e-9);
    near_to(column(&o, "shaft1.angle_accel"), al, 1e-8);
    /* each wheel: its inertia's need is what acts on it */
    near_to(column(&o, "first.force"), (2e-3 * al - 5) * 3, 1e-8);
    near_to(column(&o, "rope.force"), 30 * (g + .1 * i * al), 1e-8);
    near_to(column(&o, "second.force"), .43125 * i * al + .1 * column(&o, "rope.force"), 1e-8);
    shut(&o);
}

/* The motor's angle told: no freedom is left, and its drive must bring up what the whole train needs. */
static void a_driven_train_needs_its_torque(void **state)
{
    (void)state;
    struct opened o;
    double force = 0, power = 0;
    open_closely(&o, "decks/gear-train.yaml", "drives: {turn: {drive: shaft1, value: \"5*t^2\"}}\n", .7);
    assert_int_equal(o.sim.stepper.ode->n, 0);
    run(&o);
    near_to(column(&o, "guide.displacement"), .1 / 7.5 * 5 * .49, 1e-9);
    for (int i = 0; i < o.sim.model->nloop; i++)
        if (o.sim.model->loop[i].drive) system_drive(o.sim.system, &force, &power, i);
    near_to(force + 5, .02 * 10 + 30 * 9.81 * .1 / 7.5, 1e-8); /* the motor's own 5 N m are still there */
    near_to(power, force * 10 * .7, 1e-7);
    shut(&o);
}

/* --- the quick-return in its crank's angle ---------------------------------------------------------- */

struct ram {
    double x, slope; /* ram, and its rate per crank's */
    double lever;    /* the lever's rate per crank's */
};

static struct ram ram_at(double angle)
{
    const double a = .1, c = .25, l = .55, b = atan2(c, a), y = .3;
    const double rod2 = .09 + pow(y - (l * sin(b) - c), 2);
    struct ram o;
    double phi = atan2(c + a * sin(angle), a * cos(angle)), up = y - (l * sin(phi) - c), along = sqrt(rod2 - up * up);
    o.x = l * cos(phi) + along;
    o.lever = (a * a + a * c * sin(angle)) / (a * a + c * c + 2 * a * c * sin(angle));
    o.slope = (-l * sin(phi) + up * l * cos(phi) / along) * o.lever;
    return o;
}

static double crank_inertia(double angle)
{
    struct ram r = ram_at(angle);
    return .06 + 2 * .55 * .55 / 3 * r.lever * r.lever + 5 * r.slope * r.slope;
}

/* J a + J' w^2/2 = 12 - 60 x'^2 w */
static void crank_rates(double *dy, const double *y)
{
    struct ram r = ram_at(y[0]);
    dy[0] = y[1];
    dy[1] = (12 - 60 * r.slope * r.slope * y[1] - slope(crank_inertia, y[0]) * y[1] * y[1] / 2) / crank_inertia(y[0]);
}

static void the_quick_return_is_its_crank(void **state)
{
    (void)state;
    struct opened o;
    double y[2] = {0, 6}, dy[2];
    open_closely(&o, "decks/quick-return.yaml", "", 1.3);
    run(&o);
    for (int i = 0; i < 13000; i++) rk4(y, 2, 1e-4, crank_rates);
    crank_rates(dy, y);
    struct ram r = ram_at(y[0]);
    near_to(column(&o, "shaft.angle"), y[0], 1e-8);
    near_to(column(&o, "shaft.angle_rate"), y[1], 1e-7);
    near_to(column(&o, "shaft.angle_accel"), dy[1], 1e-5);
    near_to(column(&o, "slide.displacement"), r.x - ram_at(0).x, 1e-9);
    /* the rod accelerates the ram against its damper: its force has that part along the slide */
    const double a = column(&o, "slide.displacement_accel"), v = column(&o, "slide.displacement_rate");
    double f[3], n[3];
    for (int i = 0; i < o.sim.model->nloop; i++)
        if (strcmp(o.sim.model->loop[i].name, "rod") == 0) system_loop_reaction(o.sim.system, f, n, i);
    near_to(f[0], 5 * a + 60 * v, 1e-7);
    near_to(hypot(f[0], f[1]), fabs(column(&o, "rod.force")), 1e-10);
    shut(&o);
}

/* --- the governor in its arms' and its shaft's angle ------------------------------------------------ */

enum { ANGLE, RATE, SPIN, SPIN_RATE };

static double sleeve_at(double a)
{
    return -.18 * cos(a) - sqrt(.18 * .18 - pow(.18 * sin(a), 2));
}

/* About the shaft: shaft, sleeve, two balls on their arms with the tensors (.004, .004, .0008). */
static double about_shaft(double a)
{
    double rho = .03 + .3 * sin(a);
    return .01 + .003 + 2 * (1.5 * rho * rho + .004 * sin(a) * sin(a) + .0008 * cos(a) * cos(a));
}

static double of_arms(double a)
{
    double z = slope(sleeve_at, a);
    return 2 * (1.5 * .09 + .004) + 2 * z * z;
}

static double potential(double a)
{
    double z = sleeve_at(a), s = z - sleeve_at(.5);
    return 9.81 * (2 * 1.5 * -.3 * cos(a) + 2 * z) + 300 * s * s + 20 * s;
}

static void governor_rates(double *dy, const double *y)
{
    const double a = y[ANGLE], J = about_shaft(a), J1 = slope(about_shaft, a);
    dy[ANGLE] = y[RATE];
    dy[SPIN] = y[SPIN_RATE];
    dy[SPIN_RATE] = -J1 * y[RATE] * y[SPIN_RATE] / J;
    dy[RATE] =
        (J1 * y[SPIN_RATE] * y[SPIN_RATE] / 2 - slope(of_arms, a) * y[RATE] * y[RATE] / 2 - slope(potential, a)) /
        of_arms(a);
}

static void the_governor_has_two_freedoms(void **state)
{
    (void)state;
    struct opened o;
    struct energies e[2];
    double y[4] = {.5, 0, 0, 14}, p[3], L[2][3];
    open_closely(&o, "decks/governor.yaml", "", 1.2);
    assert_int_equal(o.sim.stepper.ode->n, 2);
    see(&o);
    system_energies(o.sim.system, &e[0]);
    system_momentum(o.sim.system, p, L[0]);
    run(&o);
    system_energies(o.sim.system, &e[1]);
    system_momentum(o.sim.system, p, L[1]);
    for (int i = 0; i < 12000; i++) rk4(y, 4, 1e-4, governor_rates);
    near_to(column(&o, "hinge_l.angle"), y[ANGLE] - .5, 1e-8);
    near_to(column(&o, "hinge_r.angle"), y[ANGLE] - .5, 1e-8);
    near_to(column(&o, "hinge_l.angle_rate"), y[RATE], 1e-7);
    near_to(column(&o, "spin.angle"), y[SPIN], 1e-7);
    near_to(column(&o, "spin.angle_rate"), y[SPIN_RATE], 1e-7);
    near_to(column(&o, "slide.displacement"), sleeve_at(y[ANGLE]) - sleeve_at(.5), 1e-8);
    near_to(L[1][2], L[0][2], 1e-9);
    near_to(L[0][2], about_shaft(.5) * 14, 1e-12);
    near_to(e[1].kinetic + e[1].elastic + e[1].gravity, e[0].kinetic + e[0].elastic + e[0].gravity, 1e-8);
    shut(&o);
}

/* --- small ones ------------------------------------------------------------------------------------- */

/* A nut on a steep screw under gravity: (m + J/r^2) s'' = -m g. */
static void a_rack_on_one_joint_is_a_screw(void **state)
{
    (void)state;
    struct opened o;
    open_text(&o, "fmdsub: 1\n"
                  "gravity: [0, 0, -9.81]\n"
                  "bodies: {nut: {mass: 2, inertia: [0.1, 0.1, 0.03], at: [0, 0, 0]}}\n"
                  "constraints:\n"
                  "  stem: {cylindrical: [ground, nut], at: [0, 0, 0], axis: [0, 0, 1]}\n"
                  "  thread: {rack: [stem.angle, stem.displacement], radius: 0.2}\n"
                  "integrate: {scheme: dopri5, tolerance: 1.0e-11, until: 1}\n");
    run(&o);
    const double a = -2 * 9.81 / (2 + .03 / .04);
    near_to(column(&o, "stem.displacement"), a / 2, 1e-9);
    near_to(column(&o, "stem.angle"), a / 2 / .2, 1e-9);
    near_to(column(&o, "thread.force"), 2 * (a + 9.81), 1e-9);
    shut(&o);
}

#define PENDULUM                                                                                                       \
    "fmdsub: 1\n"                                                                                                      \
    "gravity: [0, -9.81]\n"                                                                                            \
    "bodies:\n"                                                                                                        \
    "  bob: {mass: 1, inertia: 0.1, at: [0, -2]}\n"                                                                    \
    "constraints:\n"

/* A body that a rod alone holds moves freely but for it: no warning; length may differ from the drawing a little. */
static void a_rod_alone_holds_a_pendulum(void **state)
{
    (void)state;
    struct opened o;
    open_text(&o, PENDULUM "  rod: {distance: [[0, 0], bob], length: 2.0001}\n"
                           "integrate: {scheme: dopri5, tolerance: 1.0e-11, until: 1}\n");
    assert_int_equal(o.status, OK);
    see(&o);
    const double q[3] = {o.sim.x.q[0], o.sim.x.q[1], o.sim.x.q[2]};
    near_to(hypot(q[0], q[1] - 2), 2.0001, 1e-12);
    near_to(column(&o, "rod.force"), -9.81, 1e-9); /* it pulls */
    near_to(diags_warnings(o.diags), 1, 0);        /* W-assembly: closed by moving it */
    shut(&o);
    open_text(&o, PENDULUM "  rod: {distance: [[0, 0], bob], length: 2.1}\n"
                           "integrate: {scheme: dopri5, tolerance: 1.0e-11, until: 1}\n");
    assert_int_equal(o.status, E_MODEL);
    assert_non_null(strstr(o.report.text, "constraint 'rod'"));
    shut(&o);
}

static void weld_is_fixed(void **state)
{
    (void)state;
    struct opened o;
    open_text(&o, PENDULUM "  hold: {weld: [ground, bob]}\n"
                           "integrate: {scheme: midpoint, step: 1.0e-2, until: 1}\n");
    assert_non_null(o.sim.model);
    assert_int_equal(o.sim.model->joint[0].type, JOINT_FIXED);
    shut(&o);
}

/* What a fast coordinate is geared to follows in the minor steps. */
static void gears_make_fast(void **state)
{
    (void)state;
    struct opened o;
    open_text(&o, "fmdsub: 1\n"
                  "bodies:\n"
                  "  one: {mass: 1, inertia: 1, at: [0, 0]}\n"
                  "  two: {mass: 1, inertia: 1, at: [1, 0]}\n"
                  "  three: {mass: 1, inertia: 1, at: [2, 0]}\n"
                  "constraints:\n"
                  "  a: {revolute: [ground, one], at: [0, 0]}\n"
                  "  b: {revolute: [ground, two], at: [1, 0]}\n"
                  "  c: {revolute: [ground, three], at: [2, 0]}\n"
                  "  pair: {gear: [a, b], ratio: -2}\n"
                  "partition: {fast: [b]}\n"
                  "integrate: {scheme: subcycle, step: 1.0e-2, ratio: 5, until: 1}\n");
    assert_int_equal(o.status, OK);
    const struct model *m = o.sim.model;
    assert_true(m->body[m->body_of[1]].fast && m->body[m->body_of[2]].fast);
    assert_false(m->body[m->body_of[3]].fast);
    assert_int_equal(o.sim.stepper.ode->ns, 1);
    assert_int_equal(o.sim.stepper.ode->n, 2);
    shut(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_derivatives),
        cmocka_unit_test(pushing_is_the_transpose),
        cmocka_unit_test(a_gear_train_is_one_mass),
        cmocka_unit_test(a_driven_train_needs_its_torque),
        cmocka_unit_test(the_quick_return_is_its_crank),
        cmocka_unit_test(the_governor_has_two_freedoms),
        cmocka_unit_test(a_rack_on_one_joint_is_a_screw),
        cmocka_unit_test(a_rod_alone_holds_a_pendulum),
        cmocka_unit_test(weld_is_fixed),
        cmocka_unit_test(gears_make_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
