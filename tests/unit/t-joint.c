/* t-joint.c -- the tables of kinds: joints, laws; signals. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"
#include "expr/expr.h"
#include "kind/bushing.h"
#include "kind/joint.h"
#include "kind/spring.h"

#include <cmocka.h>

static void every_kind_is_found_by_its_name(void **state)
{
    (void)state;
    int n = 0;
    for (const struct joint_kind *k; (k = joint_kind_at(n)); n++) {
        assert_int_equal(k->type, n < JOINT_TYPES ? n : JOINT_FIXED); /* weld is a second word */
        assert_ptr_equal(joint_find(k->name), k);
        assert_true(k->keys != NULL && k->brief[0]);
    }
    assert_int_equal(n, JOINT_WORDS);
    assert_null(joint_find("hinge"));
    assert_null(joint_kind_at(-1));
}

/* Sizes agree with the freedoms; a quaternion is one position more; names and units follow each other. */
static void names_cover_the_coordinates(void **state)
{
    (void)state;
    static const int freedoms[2][JOINT_TYPES] = {{0, 1, 1, -1, -1, -1, -1, 3, 3, 0, 0, 0, 0},
                                                 {0, 1, 1, 2, 1, 2, 3, 3, 6, 0, 0, 0, 0}};
    for (int space = 0; space < 2; space++) {
        for (int t = 0; t < JOINT_TYPES; t++) {
            const struct joint_kind *k = joint_kind((enum joint_type)t, space);
            if (freedoms[space][t] < 0) {
                assert_null(k);
                continue;
            }
            const int nq = joint_size(k, 0), nv = joint_size(k, 1);
            const bool turns = space == 1 && (t == JOINT_SPHERICAL || t == JOINT_FREE);
            assert_int_equal(nv, freedoms[space][t]);
            assert_int_equal(joint_size(k, 2), nv);
            assert_int_equal(nq, nv + turns);
            assert_int_equal(joint_turns_freely(k), turns);
            assert_true(nq <= JOINT_MAX_Q && nv <= JOINT_MAX_V);
            for (int i = 0; i < nv; i++) {
                char rate[40];
                if (!turns || i < nq - 4) {
                    /* q' = v: the rate is named after the position, its unit is the position's per second */
                    snprintf(rate, sizeof rate, "%s_rate", joint_name(k, 0, i));
                    assert_string_equal(joint_name(k, 1, i), rate);
                    snprintf(rate, sizeof rate, "%s_accel", joint_name(k, 0, i));
                    assert_string_equal(joint_name(k, 2, i), rate);
                    snprintf(rate, sizeof rate, "%s/s", joint_unit(k, 0, i));
                    assert_string_equal(joint_unit(k, 1, i), rate);
                    assert_string_equal(joint_unit(k, 0, i), strncmp(rate, "rad", 3) == 0 ? "rad" : "m");
                } else {
                    snprintf(rate, sizeof rate, "omega_%s", joint_name(k, 0, i + 1) + 1);
                    assert_string_equal(joint_name(k, 1, i), rate);
                    snprintf(rate, sizeof rate, "%s_rate", joint_name(k, 1, i));
                    assert_string_equal(joint_name(k, 2, i), rate);
                    assert_string_equal(joint_unit(k, 1, i), "rad/s");
                    assert_string_equal(joint_unit(k, 0, i + 1), "1");
                }
                snprintf(rate, sizeof rate, "%s2", joint_unit(k, 1, i));
                assert_string_equal(joint_unit(k, 2, i), rate);
            }
            if (turns) assert_string_equal(joint_name(k, 0, nq - 4), "qw");
        }
    }
}

/* What the lists promise (joint.h): nothing behind a ball, turns in one run, which the recursions have. */
static void lists_are_in_order(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * JOINT_TYPES; i++) {
        const struct joint_kind *k = joint_kind((enum joint_type)(i / 2), i % 2);
        int first, turns = 0, balls = 0, n = 0;
        if (!k) continue;
        const enum joint_turning turning = joint_turning(k, &first);
        for (; k->freedom[n].turns || k->freedom[n].slides; n++) {
            const struct freedom *f = &k->freedom[n];
            assert_true(n < JOINT_MAX_V && f->axis >= 0 && f->axis < 3);
            assert_true(!f->ball || f->axis == n - first);
            turns += f->turns, balls += f->ball;
            if (f->turns) assert_true(n >= first && n < first + 3);
        }
        const int expected[] = {[TURNS_NEVER] = 0, [TURNS_ABOUT_ONE] = 1, [TURNS_CROSSED] = 2, [TURNS_FREELY] = 3};
        assert_int_equal(turns, expected[turning]);
        assert_int_equal(balls, turning == TURNS_FREELY ? 3 : 0);
        if (balls) assert_int_equal(first, n - 3);
    }
}

static void force_kinds_have_laws(void **state)
{
    (void)state;
    int n = 0;
    for (const struct force_kind *k; (k = force_kind_at(n)); n++)
        assert_true(k->name && k->size > 0 && !k->law == !!k->strains);
    assert_true(n >= 2);
}

/* f = -dV/ds + the dissipative part; ks and kv are its slopes. */
static void laws_are_the_slopes_of_what_they_store(void **state)
{
    (void)state;
    const struct spring pars[] = {{.k = 20, .rest = .3},
                                  {.k = 20, .c = 3, .rest = .3, .preload = -2},
                                  {.k = 5, .c = 1, .rest = -.1, .preload = 1, .cubic = 40}};
    for (int i = 0; i < 3; i++) {
        const struct spring *p = &pars[i];
        for (int j = 0; j < 2; j++) {
            const struct force_kind *k = j ? &force_damper : &force_spring;
            const double s = .7, v = -1.3, e = 1e-5;
            struct law o, up, down;
            k->law(&o, p, s, v, 0);
            k->law(&up, p, s + e, v, 0), k->law(&down, p, s - e, v, 0);
            assert_true(fabs((down.f - up.f) / (2 * e) - o.ks) < 1e-6);
            k->law(&up, p, s, v + e, 0), k->law(&down, p, s, v - e, 0);
            assert_true(fabs((down.f - up.f) / (2 * e) - o.kv) < 1e-6);
            double lost = k->dissipative(p, s, v, 0), dV = 0;
            assert_true(lost * v <= 0);
            if (k->stored) dV = (k->stored(p, s + e) - k->stored(p, s - e)) / (2 * e);
            assert_true(fabs(o.f - lost + dV) < 1e-6);
            struct affine affine;
            assert_int_equal(k->affine(&affine, p), k == &force_damper || p->cubic == 0);
        }
    }
    assert_true(force_spring.stored(&pars[2], pars[2].rest) == 0);
}

/* The mean force does the work of the stored energy, far from rest, too; next to each other its ends are a point. */
static void mean_forces(void **state)
{
    (void)state;
    const double s = .7, s1 = -.2, e = 1e-5, far = 1000;
    for (int i = 0; i < 2; i++) {
        const struct spring p = {.k = 5, .c = 1, .rest = -.1, .preload = 1, .cubic = 40 * i},
                            moved = {.k = 5, .c = 1, .rest = far - .1, .preload = 1, .cubic = 40 * i};
        const struct force_kind *k = &force_spring;
        struct law mean, up, down, point;
        k->mean(&mean, &p, s, s1);
        assert_true(fabs(mean.f * (s1 - s) + k->stored(&p, s1) - k->stored(&p, s)) < 1e-14);
        k->mean(&up, &p, s, s1 + e), k->mean(&down, &p, s, s1 - e);
        assert_true(fabs((down.f - up.f) / e - mean.ks) < 1e-8);
        k->mean(&mean, &p, s, s), k->law(&point, &p, s, 0, 0);
        assert_true(fabs(mean.f - point.f) < 1e-14 && fabs(mean.ks - point.ks) < 1e-13);
        k->mean(&mean, &p, s, s + 1e-6), k->mean(&up, &moved, far + s, far + (s + 1e-6));
        assert_true(fabs(up.f - mean.f) < 1e-10);
    }
}

static void tables_are_linear_between_their_points(void **state)
{
    (void)state;
    const double t[] = {0, 1, 1, 3}, x[] = {2, 4, 10, 6};
    const struct signal s = {.n = 4, .t = t, .x = x};
    const double at[] = {-1, 0, .5, 1, 2, 3, 9}, value[] = {2, 2, 3, 10, 8, 6, 6}, slope[] = {0, 0, 2, -2, -2, 0, 0};
    for (int i = 0; i < 7; i++) {
        double d[2];
        const int which[2] = {0, 1};
        assert_true(signal_value(&s, &at[i]) == value[i]);
        assert_true(signal_slopes(&s, d, &at[i], which, 2) == value[i]);
        assert_true(d[0] == slope[i] && d[1] == 0);
    }
    assert_true(signal_next(&s, -1) == 0 && signal_next(&s, 0) == 1 && signal_next(&s, 1) == 3 &&
                signal_next(&s, 1.5) == 3);
    assert_true(isinf(signal_next(&s, 3)));
    const struct signal none = {0};
    assert_true(isinf(signal_next(&none, 0)));
    assert_true(signal_value(&none, at) == 0);
    const struct signal constant = {.n = 1, .t = t, .x = x};
    assert_true(signal_value(&constant, &at[4]) == 2);
}

static int find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)value, (void)error;
    *slot = strcmp(name, "t") == 0 ? 0 : 1;
    return 0;
}

static void expressions_are_signals_too(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    struct expr *e;
    struct expr_error error;
    const struct expr_names names = {.find = find, .self = NULL};
    const char text[] = "3*t - x^2";
    assert_int_equal(expr_parse(&e, text, strlen(text), &names, arena, &error), 0);
    const struct signal s = {.expr = e};
    const double slot[2] = {2, 3};
    const int which[1] = {1};
    double d[1];
    assert_true(fabs(signal_value(&s, slot) + 3) < 1e-15);
    assert_true(fabs(signal_slopes(&s, d, slot, which, 1) + 3) < 1e-15 && fabs(d[0] + 6) < 1e-15);
    arena_close(arena);
}

static struct signal formula(struct arena *arena, const char *text)
{
    struct expr *e;
    struct expr_error error;
    static const struct expr_names names = {.find = find};
    assert_int_equal(expr_parse(&e, text, strlen(text), &names, arena, &error), 0);
    return (struct signal){.expr = e};
}

/* What a rate jumps by in an interval: each corner once, a jump of the acceleration not at all. */
static void corners(void **state)
{
    static const double t[] = {0, 1, 3}, x[] = {0, 2, 0};
    const struct signal table = {.n = 3, .t = t, .x = x};
    struct arena *arena = arena_open();
    double m[3];
    (void)state;
    signal_motion(&table, m, 0);
    assert_true(m[0] == 0 && m[1] == 2 && m[2] == 0);
    signal_motion(&table, m, 1);
    assert_true(m[0] == 2 && m[1] == 2);
    assert_true(signal_corner(&table, 0, 1) == 0 && signal_corner(&table, 1, 1.5) == -3);
    assert_true(signal_corner(&table, .5, 1.5) == -3 && signal_corner(&table, 2.9, 3.1) == 1);
    const struct signal bent = formula(arena, "abs(t - 0.4)"), push = formula(arena, "if(t < 0.4, 0, (t - 0.4)^2)");
    const struct signal smooth = formula(arena, "sin(20*t) + t^3");
    double sum = 0;
    for (int i = 0; i < 10; i++) {
        sum += signal_corner(&bent, i * .1, i * .1 + .1);
        assert_true(signal_corner(&push, i * .1 + .03, i * .1 + .13) == 0);
        assert_true(signal_corner(&smooth, i * .1, i * .1 + .1) == 0);
    }
    assert_true(fabs(sum - 2) < 1e-12);
    arena_close(arena);
}

/* What a value jumps by in [ta, tb), and where; NAN: it does not. */
static double leap(double *at, const char *text, double ta, double tb)
{
    struct arena *arena = arena_open();
    const struct signal s = formula(arena, text);
    double before, behind;
    const bool any = signal_jump(&s, at, &before, &behind, ta, tb);
    arena_close(arena);
    return any ? behind - before : NAN;
}

/* Jumps of the value are found, also beside corners; corners, steep ramps and pieces that meet are none. */
static void leaps(void **state)
{
    static const struct {
        const char *text;
        double ta, tb, at, by;
    } jumps[] = {{"if(t < 0.35, 0, 1)", .3, .4, .35, 1},
                 {"if(t < 0.4, 0, 1)", .3, .4, .4, 1},
                 {"if(t <= 0.3, 2, -1)", .3, .4, .3, -3},
                 {"mod(t, 0.35)", .3, .4, .35, -.35},
                 {"if(t < 0.35, 10*t, 3.500001)", .3, .4, .35, 1e-6},
                 {"if(t < 1000.0005, t, t + 1.0e-4)", 1000, 1000.001, 1000.0005, 1e-4},
                 {"sign(t)", -1, 2, 0, 2}};
    static const char *const none[] = {"abs(t - 0.35)",
                                       "if(t < 0.35, 0, if(t < 0.350001, (t - 0.35)*1.0e+6, 1))",
                                       "max(0, tanh(1.0e+6*(t - 0.35)))",
                                       "if(t < 0.35, 3*t, 3.0*(0.35 + (t - 0.35)))",
                                       "sqrt(abs(t - 0.35))",
                                       "if(t < 0.35, 0, log(0.3 - t))",
                                       "sin(20*t)"};
    double at;
    (void)state;
    for (size_t i = 0; i < sizeof jumps / sizeof *jumps; i++) {
        const double by = leap(&at, jumps[i].text, jumps[i].ta, jumps[i].tb);
        assert_true(fabs(by - jumps[i].by) < 1e-9 && fabs(at - jumps[i].at) < 1e-9);
    }
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) assert_true(isnan(leap(&at, none[i], .3, .4)));
    assert_true(isnan(leap(&at, "if(t < 0.4, 0, 1)", .3, .39)) && isnan(leap(&at, "if(t < 0.3, 0, 1)", .3, .4)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_found_by_its_name),
        cmocka_unit_test(names_cover_the_coordinates),
        cmocka_unit_test(lists_are_in_order),
        cmocka_unit_test(force_kinds_have_laws),
        cmocka_unit_test(laws_are_the_slopes_of_what_they_store),
        cmocka_unit_test(mean_forces),
        cmocka_unit_test(tables_are_linear_between_their_points),
        cmocka_unit_test(expressions_are_signals_too),
        cmocka_unit_test(corners),
        cmocka_unit_test(leaps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
