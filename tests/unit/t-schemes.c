/* t-schemes.c -- what holds for every scheme: its options, and a chart that changes after a step */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "sim/load.h"
#include "unit/oscillators.h"

#include <cmocka.h>

static const struct key *integrate_keys(struct arena *life)
{
    struct section s;
    for (int i = 0; sim_section(&s, i, life); i++)
        if (strcmp(s.path, "integrate") == 0) return s.keys;
    return NULL;
}

/* Every key of a scheme is a key of the deck, once, in the order of the block, with the names of those that read it. */
static void test_keys(void **state)
{
    struct arena *life = arena_open();
    const struct key *all = integrate_keys(life);
    const struct key_block block = stepper_options(life);
    (void)state;
    assert_int_equal(block.size, sizeof(struct step_options));
    for (int i = 0; stepper_kinds[i]; i++)
        for (const struct key *k = stepper_kinds[i]->keys; k && k->name; k++) assert_non_null(key_find(all, k->name));
    for (const struct key *k = block.keys; k->name; k++) {
        int readers = 0;
        for (int i = 0; stepper_kinds[i]; i++) readers += key_find(stepper_kinds[i]->keys, k->name) != NULL;
        for (int i = 0; stepper_absent[i]; i++) readers += key_find(stepper_absent[i]->keys, k->name) != NULL;
        assert_true(readers > 0 && (k == block.keys || k->offset > k[-1].offset));
        assert_true(key_find(all, k->name) && key_find(all, k->name) - all >= 4);
    }
    assert_string_equal(key_find(all, "gamma")->brief, "newmark, miao: gamma of (2-6)");
    assert_string_equal(
        key_find(all, "newton_tolerance")->brief,
        "subcycle, newmark, generalized-alpha, hht, midpoint, miao: relative; 0: a thousandth of the step's own "
        "error");
    arena_close(life);
}

/* The defaults of these tests are those of decks. */
static void test_defaults(void **state)
{
    struct arena *life = arena_open();
    (void)state;
    for (const struct key *k = stepper_options(life).keys; k->name; k++)
        if (k->fallback && k->type != KEY_WORD && !key_is_default(k, &step_defaults)) fail_msg("%s", k->name);
    arena_close(life);
}

static void test_fits(void **state)
{
    bool (*fits)(const struct step_options *, struct misfit *) = stepper_find("newmark")->fits;
    struct misfit why;
    struct step_options o = step_defaults;
    (void)state;
    assert_true(fits(&o, &why));
    o.beta = .2;
    assert_false(fits(&o, &why));
    assert_string_equal(why.key, "beta");
    o.gamma = .4;
    assert_false(fits(&o, &why)); /* of order 1, no tolerance can be kept */
    assert_string_equal(why.key, "gamma");
    o.tolerance = 0;
    assert_true(fits(&o, &why));
}

/* ---- a chart that is new after each step, where accelerations cannot be found for a while */

static struct {
    int refusals; /* still to come */
    int charts;
} owner;

static int other_chart(struct ode2 *o, double *q, double *v, double t)
{
    (void)o, (void)q, (void)v, (void)t;
    owner.charts++;
    return 1;
}

static enum status refuse(const struct ode2 *o, double *M, const double *q, double t, unsigned cls, struct trouble *why)
{
    if (owner.charts > 0 && owner.refusals-- > 0) return trouble_set(why, TROUBLE_MASS, 1, 0, t);
    return linear_mass(o, M, q, t, cls, why);
}

/* The step that changed the chart stands; the next one fails for want of accelerations, and once they are found it is
 * that of a run that has begun there. */
static void test_new_chart(void **state)
{
    static const struct ode2_ops ops = {.resid = linear_resid, .mass = refuse, .slopes = linear_slopes};
    static const struct ode2_chart chart = {.rechart = other_chart};
    (void)state;
    for (int k = 0; stepper_kinds[k]; k++) {
        struct linear s;
        struct run r, begun;
        if (stepper_kinds[k]->adaptive) continue; /* charts change inside its steps */
        linear_both(&s);
        s.ode.ops = &ops;
        s.ode.chart = &chart;
        owner.charts = 0;
        owner.refusals = 2;
        assert_int_equal(run_open(&r, stepper_kinds[k]->name, &s.ode, &step_defaults, both_q, both_v), OK);
        assert_int_equal(run_steps(&r, .01, 2, 1), OK);
        double q[2] = {r.q[0], r.q[1]}, v[2] = {r.v[0], r.v[1]};
        assert_int_equal(run_steps(&r, .01, 2, 1), E_NUMERIC);
        assert_int_equal(r.why.code, TROUBLE_MASS);
        assert_true(r.x.t == .02 && !memcmp(r.q, q, sizeof q) && !memcmp(r.v, v, sizeof v));
        assert_int_equal(r.stepper.effort.rejected, 1);
        assert_int_equal(run_open(&begun, stepper_kinds[k]->name, &s.ode, &step_defaults, q, v), OK);
        begun.x.t = .02;
        assert_int_equal(run_steps(&r, .01, 2, 1), OK);
        assert_int_equal(run_steps(&begun, .01, 2, 1), OK);
        for (int i = 0; i < 2; i++) assert_true(fabs(r.q[i] - begun.q[i]) < 1e-6 && fabs(r.v[i] - begun.v[i]) < 1e-5);
        run_close(&r);
        run_close(&begun);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_keys),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_fits),
        cmocka_unit_test(test_new_chart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
