/* t-curve.c -- forces by a table: values, slopes and stored energy of the pieces, straight tables against springs and
 * dampers, energy across corners, names and refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "la/vec3.h"
#include "unit/trees.h"

#include <cmocka.h>

#include "unit/opened.h"

#define SLIDE                                                                                                          \
    "bodies: {b: {mass: 2, inertia: 0.1, at: [0, 0]}}\n"                                                               \
    "constraints: {p: {prismatic: [ground, b], axis: [0, 1]}}\n"

/* Slopes 30, 10, 40, 0. */
static const double px[] = {-2, -1, .5, 1, 3}, pF[] = {-40, -10, 5, 25, 25};
#define TABLE "[[-2, -40], [-1, -10], [0.5, 5], [1, 25], [3, 25]]"

static double value_at(double x)
{
    int i = 0;
    while (i < 3 && x >= px[i + 1]) i++;
    return pF[i] + (pF[i + 1] - pF[i]) / (px[i + 1] - px[i]) * (x - px[i]);
}

static void open_curve(struct opened *o, const struct scene_force **f)
{
    open_deck(o, SLIDE "forces: {c: {curve: p, rest: 0.25, table: " TABLE "}, d: {curve: p_rate, table: " TABLE "}}\n"
                       "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n");
    *f = o->scene->force;
}

/* The force resists; beyond the ends the outermost pieces go on. */
static void values_and_slopes(void **state)
{
    (void)state;
    struct opened o;
    const struct scene_force *f;
    struct law law;
    open_curve(&o, &f);
    for (double x = -3.05; x < 4; x += .1) {
        f[0].kind->law(&law, f[0].par, x + .25, 7, 0);
        near(law.f, -value_at(x), 1e-13);
        near(law.ks, (value_at(x + 1e-4) - value_at(x - 1e-4)) / 2e-4, 1e-8);
        assert_true(law.kv == 0);
        f[1].kind->law(&law, f[1].par, 7, x, 0);
        near(law.f, -value_at(x), 1e-13);
        near(law.kv, (value_at(x + 1e-4) - value_at(x - 1e-4)) / 2e-4, 1e-8);
        assert_true(law.ks == 0 && f[1].kind->dissipative(f[1].par, 7, x, 0) == law.f && !f[1].kind->stored);
    }
    arena_close(o.life);
}

/* V by the trapezoidal rule in steps that meet all corners; the mean force does its work both ways. */
static void stored_and_mean(void **state)
{
    (void)state;
    struct opened o;
    const struct scene_force *f;
    struct tree_dice d = {5};
    open_curve(&o, &f);
    assert_true(f->kind->stored(f->par, .25) == 0);
    for (int i = 0; i < 200; i++) {
        const double s0 = .25 + tree_roll(&d, -4, 5), s1 = .25 + tree_roll(&d, -4, 5), e = 1e-6;
        struct law mean, back, up, down;
        double V = 0;
        for (double x = 0; x < 4.99; x += .5) V += .25 * (value_at(x) + value_at(x + .5));
        near(f->kind->stored(f->par, 5.25), V, 1e-12);
        f->kind->mean(&mean, f->par, s0, s1);
        f->kind->mean(&back, f->par, s1, s0);
        near(mean.f, back.f, 1e-13);
        near(mean.f * (s1 - s0), f->kind->stored(f->par, s0) - f->kind->stored(f->par, s1), 1e-12);
        f->kind->mean(&up, f->par, s0, s1 + e), f->kind->mean(&down, f->par, s0, s1 - e);
        near(mean.ks, (down.f - up.f) / e, 1e-4);
        f->kind->mean(&mean, f->par, s0, s0), f->kind->law(&up, f->par, s0, 0, 0);
        near(mean.f, up.f, 1e-13);
        assert_true(mean.ks == up.ks);
    }
    arena_close(o.life);
}

/* Where it is at the end, and the worst of the balance. */
static double run_to(double *residual, const char *forces, const char *integrate, const char *column)
{
    struct opened o;
    char text[2000];
    snprintf(text, sizeof text, "%s\nintegrate: {%s}\noutput: {every: 0.5, columns: [%s]}\n", forces, integrate,
             column);
    open_deck(&o, text);
    run(&o);
    const double x = value(&o, column);
    *residual = o.sim.ledger.worst / o.sim.ledger.norm;
    arena_close(o.life);
    return x;
}

#define TWO                                                                                                            \
    "bodies: {a: {mass: 1, inertia: 0.1, at: [0.3, 0]}, b: {mass: 0.5, inertia: 0.05, at: [1, 0.4]}}\n"                \
    "constraints: {p: {revolute: [ground, a], at: [0, 0]}, q: {revolute: [ground, b], at: [1, 0]}}\n"                  \
    "measures: {turn: {angle: [a, b]}, rise: {displacement: [a, b], axis: [1, 1]}}\n"                                  \
    "partition: {fast: [q]}\n"                                                                                         \
    "initial: {p.angle_rate: 1.5, q.angle_rate: -2}\n"

/* A straight table is a spring, or a damper, along every sort of measure. */
static void straight_tables(void **state)
{
    static const char *const on[] = {"p", "[a, b]", "turn", "rise"};
    static const char *const rate[] = {"p.angle_rate", "p_rate", "turn_rate", "rise_rate"};
    static const char *const schemes[] = {
        "scheme: midpoint, step: 2.0e-3, until: 1, newton_tolerance: 1.0e-13",
        "scheme: subcycle, step: 1.0e-3, ratio: 4, until: 1, newton_tolerance: 1.0e-13",
        "scheme: dopri5, tolerance: 1.0e-9, until: 1"};
    (void)state;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            char table[800], law[800];
            double worst[2];
            snprintf(table, sizeof table,
                     TWO "forces: {s: {curve: %s, table: [[-1, -30], [1, 30]]},\n"
                         "         d: {curve: %s, table: [[0, 0], [0.1, 0.04], [2, 0.8]]}}",
                     on[i], rate[i]);
            snprintf(law, sizeof law, TWO "forces: {s: {spring: %s, stiffness: 30}, d: {damper: %s, damping: 0.4}}",
                     on[i], i == 1 ? "p" : on[i]);
            const double x = run_to(&worst[0], table, schemes[k], "p.angle"),
                         y = run_to(&worst[1], law, schemes[k], "p.angle");
            near(x, y, k == 2 ? 1e-7 : 1e-11);
        }
}

/* Corners in most steps, along every sort of measure: the balance is kept. */
static void energy_across_corners(void **state)
{
    static const char *const on[] = {"p", "[a, b]", "turn", "rise"};
    static const char *const schemes[] = {
        "scheme: midpoint, step: 5.0e-3, until: 2, newton_tolerance: 1.0e-13",
        "scheme: subcycle, step: 2.0e-3, ratio: 5, until: 2, newton_tolerance: 1.0e-13"};
    (void)state;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++) {
            char text[600];
            double worst;
            snprintf(text, sizeof text,
                     TWO "forces: {s: {curve: %s, table: [[-0.2, -90], [-0.05, -20], [-0.02, 0], [0.02, 0], [0.05, 9], "
                         "[0.3, 12]]}}",
                     on[i]);
            run_to(&worst, text, schemes[k], "p.angle");
            near(worst, 0, 1e-10);
        }
}

/* A stop of 1e8 N/m a thousand metres from the coordinate's zero: the ball of 2 kg falls 1 m and comes up again. */
static void a_stop_far_away(void **state)
{
    static const char *const step[] = {"1.0e-2", "1.0e-3"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        char integrate[120];
        double worst;
        snprintf(integrate, sizeof integrate, "scheme: midpoint, step: %s, until: 5, newton_tolerance: 1.0e-13",
                 step[k]);
        run_to(&worst,
               "gravity: [0, -9.81]\n" SLIDE
               "forces: {stop: {curve: p, rest: 1000, table: [[-1, -1.0e+8], [0, 0], [1, 0]]}}\n"
               "initial: {p.displacement: 1001}",
               integrate, "p.displacement");
        near(worst, 0, 1e-9);
    }
}

static void wrong(const char *text, const char *message)
{
    char path[] = "/tmp/t-curve-XXXXXX", *words;
    size_t size;
    struct arena *life = arena_open();
    struct diags *diags = diags_open(life);
    struct scene *scene;
    struct report report = {0};
    close(mkstemp(path));
    write_file(path, "fmdsub: 1\n" SLIDE "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n", text);
    assert_int_not_equal(sim_load(&scene, path, NULL, diags, life, &report), OK);
    unlink(path);
    FILE *to = open_memstream(&words, &size);
    diags_print(to, diags, false);
    fclose(to);
    if (!strstr(words, message)) fail_msg("%s: %s", text, words);
    free(words);
    arena_close(life);
}

static void refusals(void **state)
{
    (void)state;
    wrong("forces: {c: {curve: p}}", "expected 'table' or 'file' [E-table]");
    wrong("forces: {c: {curve: p, table: [[0, 1], [0, 2]]}}", "the first numbers of a table must increase: 0 after 0");
    wrong("forces: {c: {curve: p_rate, rest: 1, table: [[0, 1], [1, 2]]}}", "unknown key 'rest'");
    wrong("forces: {c: {curve: pp_rate, table: [[0, 1], [1, 2]]}}", "unknown joint, coordinate or measure 'pp'");
    wrong("forces: {c: {spring: p.displacement_rate, stiffness: 1}}", "is a rate, not a coordinate");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_and_slopes),     cmocka_unit_test(stored_and_mean), cmocka_unit_test(straight_tables),
        cmocka_unit_test(energy_across_corners), cmocka_unit_test(a_stop_far_away), cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
