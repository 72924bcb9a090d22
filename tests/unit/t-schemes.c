/* t-schemes.c -- what holds for every scheme: its options */
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
        assert_true(readers > 0 && (k == block.keys || k->offset > k[-1].offset));
        assert_true(key_find(all, k->name) && key_find(all, k->name) - all >= 4);
    }
    assert_string_equal(key_find(all, "gamma")->brief, "newmark, miao: gamma of (2-6)");
    assert_string_equal(key_find(all, "newton_tolerance")->brief, "relative; 0: a thousandth of the step's own error");
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
    struct arena *life = arena_open();
    struct misfit why;
    struct step_options o = step_defaults;
    (void)state;
    assert_true(stepper_options(life).fits(&o, &why));
    o.beta = .2;
    assert_false(stepper_options(life).fits(&o, &why));
    assert_string_equal(why.key, "beta");
    o.gamma = .4;
    assert_true(stepper_options(life).fits(&o, &why));
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_keys),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_fits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
