/* t-sim.c -- whole runs from a deck: memory stands still, invariants of a free body, ratio 1 on the general path. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "unit/decks.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void open_deck(struct opened *o, const char *path, int nset, const char *const *set, bool general)
{
    open_as(o, path, nset, set, &(struct sim_options){.version = "test", .general = general});
    print_wrong(o);
    assert_int_equal(o->status, OK);
}

/* After the first step nothing more is taken, in any scheme. */
static void test_memory_stands_still(void **state)
{
    static const char *const schemes[] = {"newmark", "midpoint", "miao", "subcycle", "rk4", "dopri5", "hht"};
    (void)state;
    for (size_t i = 0; i < sizeof schemes / sizeof *schemes; i++) {
        char scheme[60];
        struct opened o;
        struct report report = {0};
        struct trouble why = {0};
        snprintf(scheme, sizeof scheme, "integrate.scheme=%s", schemes[i]);
        const char *const set[] = {scheme, "integrate.until=0.2",
                                   strcmp(schemes[i], "dopri5") ? "title=x" : "integrate.tolerance=1.0e-6"};
        open_deck(&o, "decks/stiff-leaf-chain.yaml", 3, set, true);
        double H = o.sim.plan.step * o.sim.plan.ratio;
        assert_int_equal(stepper_step(&o.sim.stepper, &o.sim.x, o.sim.plan.step, o.sim.plan.ratio, H, &why), OK);
        size_t used = arena_used(o.life);
        long grown = arena_grown(o.life);
        enum status status = sim_run(&o.sim, NULL, &report);
        assert_true(status == OK || status == E_VERDICT); /* miao may break its balance here */
        assert_int_equal(arena_used(o.life), used);
        assert_int_equal(arena_grown(o.life), grown);
        arena_close(o.life);
    }
}

static double size3(const double *a)
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* Energy and spatial angular momentum of a free body, by the midpoint rule: round-off. */
static void test_free_body(void **state)
{
    static const char *const set[] = {"integrate.newton_tolerance=1.0e-15",
                                      "integrate.scheme=midpoint",
                                      "integrate.step=0.01",
                                      "integrate.ratio=1",
                                      "integrate.until=50",
                                      "output.every={steps: 100}"};
    struct opened o;
    struct report report = {0};
    struct trouble why = {0};
    struct energies e0, e1;
    double p[3], L0[3], L1[3], d[3];
    (void)state;
    open_deck(&o, "decks/free-top.yaml", 6, set, false);
    struct sim *s = &o.sim;
    assert_int_equal(system_evaluate(s->system, s->x.q, s->x.v, 0, EVALUATE_MOTION, &why), OK);
    system_momentum(s->system, p, L0);
    assert_int_equal(system_energy_at(s->system, &e0, s->x.q, s->x.v, 0, &(struct trouble){0}), OK);
    assert_int_equal(sim_run(s, NULL, &report), OK);
    assert_int_equal(system_evaluate(s->system, s->x.q, s->x.v, s->x.t, EVALUATE_MOTION, &why), OK);
    system_momentum(s->system, p, L1);
    assert_int_equal(system_energy_at(s->system, &e1, s->x.q, s->x.v, s->x.t, &(struct trouble){0}), OK);
    for (int i = 0; i < 3; i++) d[i] = L1[i] - L0[i];
    assert_true(fabs(e1.kinetic - e0.kinetic) <= 1e-12 * e0.kinetic); /* 5000 steps of round-off */
    assert_true(size3(d) <= 1e-12 * size3(L0));
    arena_close(o.life);
}

/* Worst difference of the ends of two runs, against the largest value. */
static double apart(const struct opened *a, const struct opened *b)
{
    double worst = 0, top = 0;
    for (int i = 0; i < a->sim.model->nq; i++) {
        worst = fmax(worst, fabs(a->sim.x.q[i] - b->sim.x.q[i]));
        top = fmax(top, fabs(a->sim.x.q[i]));
    }
    return worst / top;
}

static void run_general(struct opened *o, const char *deck, const char *scheme, bool general)
{
    struct report report = {0};
    char word[60];
    snprintf(word, sizeof word, "integrate.scheme=%s", scheme);
    const char *const set[] = {word, "integrate.ratio=1", "integrate.newton_tolerance=1.0e-14", "integrate.until=0.02",
                               "output.every={steps: 10}"};
    open_deck(o, deck, 5, set, general);
    assert_string_equal(o->sim.stepper.kind->name, scheme);
    assert_int_equal(sim_run(&o->sim, NULL, &report), OK);
}

/* Ratio 1 with a recoiling base and slow bodies apart is the single-rate scheme. */
static void test_ratio_one(void **state)
{
    static const char *const decks[] = {"decks/bar-slider.yaml", "decks/double-pendulum.yaml",
                                        "decks/stiff-leaf-chain.yaml"};
    static const char *const pairs[][2] = {{"subcycle", "midpoint"}, {"miao", "newmark"}};
    (void)state;
    for (int d = 0; d < 3; d++)
        for (int k = 0; k < 2; k++) {
            struct opened a, b;
            run_general(&a, decks[d], pairs[k][0], true);
            run_general(&b, decks[d], pairs[k][1], false);
            double difference = apart(&a, &b);
            if (!(difference <= 1e-12)) fprintf(stderr, "%s %s: %g\n", decks[d], pairs[k][0], difference);
            assert_true(difference <= 1e-12);
            arena_close(a.life);
            arena_close(b.life);
        }
}

/* A run takes its single-rate twin at ratio 1. */
static void test_twin(void **state)
{
    static const char *const set[] = {"integrate.ratio=1", "output.every={steps: 10}"};
    struct opened o;
    (void)state;
    open_deck(&o, "decks/bar-slider.yaml", 2, set, false);
    assert_string_equal(o.sim.stepper.kind->name, "midpoint");
    arena_close(o.life);
}

/* The last record stands at `until` to the bit, whatever the step. */
static void test_end(void **state)
{
    static const char *const ends[][3] = {{"0.1", "0.3", "1"}, {"0.1", "0.7", "1"}, {"0.1", "1", "1"},
                                          {"0.03", "1", "1"},  {"0.03", "1", "5"},  {"1.0e-3", "0.017", "5"}};
    (void)state;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        char step[60], until[60], ratio[60];
        struct opened o;
        struct report report = {0};
        snprintf(step, sizeof step, "integrate.step=%s", ends[i][0]);
        snprintf(until, sizeof until, "integrate.until=%s", ends[i][1]);
        snprintf(ratio, sizeof ratio, "integrate.ratio=%s", ends[i][2]);
        const char *const set[] = {
            step, until, ratio, "output.every={steps: 1}", "integrate.scheme=subcycle", "partition={fast: [guide]}"};
        open_deck(&o, "decks/bar-slider.yaml", 6, set, false);
        assert_int_equal(sim_run(&o.sim, NULL, &report), OK);
        assert_true(o.sim.x.t == strtod(ends[i][1], NULL));
        arena_close(o.life);
    }
}

enum { LAST = 400 };

/* A sink that counts. */
struct counter {
    struct sink sink;
    int rows, events, width;
    double last[LAST]; /* the last row's first values */
};

static enum status no_meta(struct sink *s, const struct run_meta *m, struct report *r)
{
    return (void)s, (void)m, (void)r, OK;
}

static enum status count_row(struct sink *s, const double *x, struct report *r)
{
    struct counter *c = s->self;
    (void)r;
    c->rows++;
    for (int i = 0; i < c->width; i++) c->last[i] = x[i];
    return OK;
}

static enum status count_event(struct sink *s, double t, const char *kind, const char *text, struct report *r)
{
    (void)t, (void)kind, (void)text, (void)r;
    ((struct counter *)s->self)->events++;
    return OK;
}

static enum status no_end(struct sink *s, const struct run_summary *m, struct report *r)
{
    return (void)s, (void)m, (void)r, OK;
}

static enum status no_tick(struct sink *s, double now, struct report *r)
{
    return (void)s, (void)now, (void)r, OK;
}

static void counter_open(struct counter *c)
{
    static const struct sink_ops ops = {no_meta, count_row, count_event, no_end, no_tick, NULL};
    *c = (struct counter){.sink = {&ops, c}};
}

/* Records farther apart than the run is long: the first and the last. */
static void test_far_records(void **state)
{
    static const char *const every[] = {"output.every=1.0e+300", "output.every=100", "output.every={steps: 1000000}"};
    (void)state;
    for (size_t i = 0; i < sizeof every / sizeof *every; i++) {
        const char *const set[] = {every[i], "integrate.until=0.1"};
        struct counter counter;
        struct opened o;
        struct report report = {0};
        counter_open(&counter);
        open_deck(&o, "decks/pendulum.yaml", 2, set, false);
        assert_int_equal(sim_run(&o.sim, &counter.sink, &report), OK);
        assert_int_equal(counter.rows, 2);
        assert_true(o.sim.every >= 1 && o.sim.every <= 1000000);
        arena_close(o.life);
    }
}

/* A few steps of a deck with the columns that are asked for. */
static void open_columns(struct opened *o, struct counter *c, const char *deck, const char *columns)
{
    const char *const set[] = {columns, "integrate.until=2.0e-3", "integrate.step=1.0e-3", "integrate.ratio=1",
                               "output.every={steps: 1}"};
    struct report report = {0};
    counter_open(c);
    open_deck(o, deck, 5, set, false);
    assert_true(o->sim.chosen.n <= LAST);
    c->width = o->sim.chosen.n;
    assert_int_equal(sim_run(&o->sim, &c->sink, &report), OK);
}

/* What a column says does not depend on the columns beside it. */
static void test_columns_alone(void **state)
{
    static const char *const decks[] = {"decks/bar-slider.yaml", "decks/cantilever.yaml", "decks/quick-return.yaml",
                                        "tests/decks/audit-free-bushings.yaml"};
    (void)state;
    for (size_t k = 0; k < sizeof decks / sizeof *decks; k++) {
        struct counter all, one;
        struct opened together, alone;
        open_columns(&together, &all, decks[k], "output.columns=['*']");
        for (int i = 0; i < all.width; i++) {
            char set[200];
            const char *name = together.sim.catalogue.column[together.sim.chosen.index[i]].name;
            if (strcmp(name, "t") == 0) continue;
            snprintf(set, sizeof set, "output.columns=[%s]", name);
            open_columns(&alone, &one, decks[k], set);
            assert_int_equal(one.width, 2);
            if (memcmp(&one.last[1], &all.last[i], sizeof(double)) != 0)
                fail_msg("%s: %s is %g alone, %g with others", decks[k], name, one.last[1], all.last[i]);
            arena_close(alone.life);
        }
        arena_close(together.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_memory_stands_still),
        cmocka_unit_test(test_free_body),
        cmocka_unit_test(test_ratio_one),
        cmocka_unit_test(test_twin),
        cmocka_unit_test(test_end),
        cmocka_unit_test(test_far_records),
        cmocka_unit_test(test_columns_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
