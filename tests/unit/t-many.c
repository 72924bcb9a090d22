/* t-many.c -- many loops: few independents without the tree's matrices, ranks by rows, order, short loops, new splits.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "la/dense.h"
#include "loop/condense_parts.h"
#include "sim/load.h"
#include "sim/sim.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

struct opened {
    struct arena *life;
    struct sim sim;
    const struct ode2 *ode;
    struct condense *loops;
    struct report report;
};

/* --- decks ---------------------------------------------------------------------------------------- */

struct text {
    char *at;
    size_t n, room;
};

__attribute__((format(printf, 2, 3))) static void say(struct text *o, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    o->n += (size_t)vsnprintf(o->at + o->n, o->room - o->n, format, args);
    va_end(args);
    assert_true(o->n < o->room);
}

static struct text begin(void)
{
    struct text o = {.room = 200000};
    o.at = malloc(o.room);
    assert_non_null(o.at);
    say(&o, "fmdsub: 1\ngravity: [0, -9.81]\nbodies:\n");
    return o;
}

static void open_text(struct opened *o, struct text *text)
{
    char path[] = "/tmp/t-many-XXXXXX";
    const struct deck_options options = {0};
    const struct sim_options quiet = {.version = "test"};
    struct scene *scene;
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text->at, text->n), (ssize_t)text->n);
    close(fd);
    free(text->at);
    memset(o, 0, sizeof *o);
    o->life = arena_open();
    struct diags *diags = diags_open(o->life);
    enum status status = sim_load(&scene, path, &options, diags, o->life, &o->report);
    if (status == OK) status = sim_open(&o->sim, scene, &scene->integrate, &quiet, diags, o->life, &o->report);
    unlink(path);
    if (status != OK) diags_print(stderr, diags, 0);
    assert_int_equal(status, OK);
    o->ode = o->sim.stepper.ode;
    o->loops = system_loops(o->sim.system);
}

/* N windows side by side as in decks/windows.yaml, in the order i -> i stride mod N; in the plane or in space. */
static struct text windows(int N, int stride, bool room, const char *also)
{
    struct text o = begin();
    const char *z = room ? ", 0" : "", *axis = room ? ", axis: [0, 0, 1]" : "";
    const char *inertia = room ? "[0.05, 0.06, 1/12]" : "1/12";
    if (room) o.n = 0, say(&o, "fmdsub: 1\ngravity: [0, -9.81, 0]\nbodies:\n");
    for (int i = 0; i <= N; i++) say(&o, "  p%d: {mass: 1, inertia: %s, at: [%d, 0.5%s]}\n", i, inertia, i, z);
    for (int i = 0; i < N; i++) say(&o, "  b%d: {mass: 1, inertia: %s, at: [%d.5, 1%s]}\n", i, inertia, i, z);
    say(&o, "constraints:\n");
    for (int i = 0; i <= N; i++) say(&o, "  foot%d: {revolute: [ground, p%d], at: [%d, 0%s]%s}\n", i, i, i, z, axis);
    for (int i = 0; i < N; i++) say(&o, "  left%d: {revolute: [p%d, b%d], at: [%d, 1%s]%s}\n", i, i, i, i, z, axis);
    for (int k = 0; k < N; k++) {
        const int i = k * stride % N;
        say(&o, "  right%d: {revolute: [b%d, p%d], at: [%d, 1%s]%s}\n", i, i, i + 1, i + 1, z, axis);
    }
    say(&o, "%sinitial: {foot0.angle_rate: -1}\nintegrate: {scheme: newmark, step: 2.0e-3, until: 0.6}\n", also);
    return o;
}

/* Windows with a joint in every beam: N + 1 freedoms. */
static struct text pentagons(int N)
{
    struct text o = begin();
    for (int i = 0; i <= N; i++) say(&o, "  p%d: {mass: 1, inertia: 1/12, at: [%d, 0.5]}\n", i, i);
    for (int i = 0; i < N; i++)
        say(&o,
            "  u%d: {mass: 1, inertia: 1/12, at: [%d.25, 1.1]}\n  w%d: {mass: 1, inertia: 1/12, at: [%d.75, 1.1]}\n", i,
            i, i, i);
    say(&o, "constraints:\n");
    for (int i = 0; i <= N; i++) say(&o, "  foot%d: {revolute: [ground, p%d], at: [%d, 0]}\n", i, i, i);
    for (int i = 0; i < N; i++)
        say(&o,
            "  left%d: {revolute: [p%d, u%d], at: [%d, 1]}\n  knee%d: {revolute: [u%d, w%d], at: [%d.5, 1.2]}\n"
            "  right%d: {revolute: [w%d, p%d], at: [%d, 1]}\n",
            i, i, i, i, i, i, i, i, i, i, i + 1, i + 1);
    say(&o, "initial: {foot0.angle_rate: -1}\nintegrate: {scheme: newmark, step: 1.0e-3, until: 0.5}\n");
    return o;
}

/* Stages of two crossed bars of length sqrt(2); the foot of the second one slides. */
static struct text scissor(int N)
{
    struct text o = begin();
    say(&o, "  shoe: {mass: 0.1, inertia: 0.01, at: [1, 0]}\n");
    for (int i = 0; i < N; i++)
        say(&o, "  A%d: {mass: 1, inertia: 1/6, at: [0.5, %d.5]}\n  B%d: {mass: 1, inertia: 1/6, at: [0.5, %d.5]}\n", i,
            i, i, i);
    say(&o, "constraints:\n  base: {prismatic: [ground, shoe], at: [1, 0], axis: [1, 0]}\n"
            "  heel: {revolute: [shoe, B0], at: [1, 0]}\n  foot: {revolute: [ground, A0], at: [0, 0]}\n");
    for (int i = 0; i < N; i++) say(&o, "  mid%d: {revolute: [A%d, B%d], at: [0.5, %d.5]}\n", i, i, i, i);
    for (int i = 0; i + 1 < N; i++)
        say(&o, "  r%d: {revolute: [A%d, B%d], at: [1, %d]}\n  l%d: {revolute: [B%d, A%d], at: [0, %d]}\n", i, i, i + 1,
            i + 1, i, i, i + 1, i + 1);
    say(&o, "initial: {base.displacement_rate: 0.1}\nintegrate: {scheme: newmark, step: 1.0e-3, until: 0.3}\n");
    return o;
}

static const char springs[] = "forces:\n"
                              "  k1: {spring: left3, stiffness: 500}\n"
                              "  k2: {spring: [b7, ground], stiffness: 40, rest: 0.1}\n"
                              "  k3: {spring: [b20, b30], stiffness: 4, rest: 2}\n"
                              "  c: {damper: tilt, damping: 2}\n"
                              "  m: {torque: foot9, value: sin(t) - 3*foot12.angle - 0.1*tilt_rate}\n"
                              "measures: {tilt: {angle: [b5, p6]}}\n";

/* --- what they have in common --------------------------------------------------------------------- */

static void near_to(double a, double b, double within)
{
    if (!(fabs(a - b) <= within)) fail_msg("%.15g should be %.15g within %g", a, b, within);
}

static double scatter(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608 - 1;
}

/* A posture and velocities beside the start. */
static void beside(const struct opened *o, double *q, double *v, unsigned seed)
{
    double *dx = TAKE(o->life, double, o->ode->n);
    for (int i = 0; i < o->ode->n; i++) {
        dx[i] = .2 * scatter(&seed);
        v[i] = 2 * scatter(&seed);
    }
    o->ode->move->point(o->ode, q, o->sim.x.q, dx, 1, 0);
    assert_true(isfinite(q[0]));
}

/* T [nt x n] by the velocities that belong to unit ones. */
static double *columns_of_T(const struct opened *o, const double *q)
{
    const int nt = o->loops->rows.n, n = o->ode->n;
    double *T = TAKE(o->life, double, nt *n), *unit = TAKE(o->life, double, n);
    struct trouble why;
    for (int j = 0; j < n; j++) {
        unit[j] = 1;
        assert_int_equal(condense_rates(o->loops, T + (size_t)nt * (size_t)j, NULL, q, unit, NULL, 0, &why), OK);
        unit[j] = 0;
    }
    return T;
}

/* got [n x n] is T' X T. */
static void is_congruent(const struct opened *o, const double *got, const double *X, const double *T)
{
    const int nt = o->loops->rows.n, n = o->ode->n;
    double *XT = TAKE(o->life, double, nt *n), *want = TAKE(o->life, double, n *n), most = 0;
    dense_gemm(XT, 1, X, T, nt, nt, n, nt, nt, nt);
    dense_gemtm(want, 1, T, XT, n, nt, n, n, nt, nt);
    for (int i = 0; i < n * n; i++) most = fmax(most, fabs(want[i]));
    for (int i = 0; i < n * n; i++) near_to(got[i], want[i], 1e-12 * most);
    assert_true(most > 0);
}

/* M^, K^, C^ of a system of few independents against those of the tree. */
static void few_independents(void **state)
{
    (void)state;
    struct text text = windows(80, 1, false, springs);
    struct opened o;
    open_text(&o, &text);
    const int nt = o.loops->rows.n, n = o.ode->n;
    assert_true(o.loops->few);
    assert_null(o.loops->M);
    double *q = TAKE(o.life, double, o.ode->nq), *v = TAKE(o.life, double, n), *vt = TAKE(o.life, double, nt);
    double *M = TAKE(o.life, double, n *n), *K = TAKE(o.life, double, n *n), *C = TAKE(o.life, double, n *n);
    double *X = TAKE(o.life, double, nt *nt), *Y = TAKE(o.life, double, nt *nt);
    for (unsigned seed = 1; seed <= 5; seed++) {
        struct trouble why;
        beside(&o, q, v, seed);
        const double *T = columns_of_T(&o, q);
        struct instant x = {.t = .3, .q = q, .v = v}, whole = x;
        assert_int_equal(o.ode->ops->mass(o.ode, M, q, .3, ALL, &why), OK);
        assert_int_equal(o.loops->tree->ode.ops->mass(&o.loops->tree->ode, X, q, .3, ALL, &why), OK);
        is_congruent(&o, M, X, T);
        assert_int_equal(o.ode->ops->slopes(o.ode, K, C, &x, ALL, &why), OK);
        assert_int_equal(condense_rates(o.loops, vt, NULL, q, v, NULL, .3, &why), OK);
        whole.v = vt;
        assert_int_equal(o.loops->tree->ode.ops->slopes(&o.loops->tree->ode, X, Y, &whole, ALL, &why), OK);
        is_congruent(&o, K, X, T);
        is_congruent(&o, C, Y, T);
    }
    arena_close(o.life);
}

static void run(struct opened *o)
{
    assert_int_equal(sim_run(&o->sim, NULL, &o->report), OK);
    assert_true(system_constraint_worst(o->sim.system) < 1e-12);
}

static double angle_of(const struct opened *o, const char *name)
{
    const struct model *m = o->sim.model;
    for (int i = 0; i < m->ncoordinate; i++)
        if (strcmp(m->coordinate[i].name, name) == 0) return o->sim.x.q[m->coordinate[i].iq];
    fail_msg("no coordinate %s", name);
    return 0;
}

/* In space three equations of each window are redundant and are dropped; mixed up, the band is as narrow; the motion is
 * the same. */
static void redundant_and_mixed(void **state)
{
    enum { N = 40 };
    (void)state;
    struct text text[3] = {windows(N, 1, false, ""), windows(N, 1, true, ""), windows(N, 17, false, "")};
    double angle[3];
    for (int k = 0; k < 3; k++) {
        struct opened o;
        open_text(&o, &text[k]);
        const struct part *p = &o.loops->split.part[0];
        assert_null(p->whole);
        assert_int_equal(p->nr, 2 * N);
        assert_int_equal(condense_started(o.loops)->redundant, k == 1 ? 3 * N : 0);
        assert_true(p->ld <= 16);
        run(&o);
        angle[k] = angle_of(&o, "foot0.angle");
        near_to(angle_of(&o, "foot40.angle"), angle[k], 1e-11);
        arena_close(o.life);
    }
    near_to(angle[1], angle[0], 1e-10);
    near_to(angle[2], angle[0], 1e-10);
    assert_true(angle[0] < -.5);
}

/* Loops of four joints, not of all below; bars where elementary geometry has them. */
static void short_loops(void **state)
{
    enum { N = 30 };
    (void)state;
    struct text text = scissor(N);
    struct opened o;
    struct trouble why;
    open_text(&o, &text);
    const struct loops *l = condense_loops(o.loops);
    for (int i = 0; i < o.sim.model->nloop; i++) assert_true(l->nk[i] <= 5);
    run(&o);
    const double wide = 1 + angle_of(&o, "base.displacement"), high = sqrt(2 - wide * wide);
    assert_true(wide > 1.01);
    assert_int_equal(system_evaluate(o.sim.system, o.sim.x.q, o.sim.x.v, o.sim.x.t, EVALUATE_MOTION, &why), OK);
    for (int i = 1; i < o.sim.model->nbody; i++) {
        struct pose p;
        int stage;
        char bar;
        if (sscanf(o.sim.model->body[i].name, "%c%d", &bar, &stage) != 2) continue;
        system_pose(o.sim.system, &p, i);
        near_to(p.r[0], wide / 2, 1e-10);
        near_to(p.r[1], (stage + .5) * high, 1e-10);
    }
    arena_close(o.life);
}

/* Splits change on the way, in a large component; the loops stay closed and the balance holds. */
static void new_splits(void **state)
{
    (void)state;
    struct text text = pentagons(40);
    struct opened o;
    open_text(&o, &text);
    assert_null(o.loops->split.part[0].whole);
    assert_int_equal(o.ode->n, 41);
    run(&o);
    assert_true(system_charts(o.sim.system) > 0);
    assert_true(o.sim.ledger.worst < 1e-2 * o.sim.ledger.norm);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(few_independents), cmocka_unit_test(redundant_and_mixed),
                                       cmocka_unit_test(short_loops), cmocka_unit_test(new_splits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
