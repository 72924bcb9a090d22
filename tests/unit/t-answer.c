/* t-answer.c -- what a study's rows say in sentences: rows made by hand, whose best, rivals and digits are known. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "multirate/schemes.h"
#include "study/study.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const struct stepper_kind *kind(const char *name)
{
    for (int i = 0; stepper_kinds[i]; i++)
        if (strcmp(stepper_kinds[i]->name, name) == 0) return stepper_kinds[i];
    fail();
    return NULL;
}

static struct study_row fixed(const char *scheme, double step, int ratio, double error, double work)
{
    return (struct study_row){.setting = {kind(scheme), NAN, step, ratio},
                              .errors = {.worst = error},
                              .worst = "pin.fx",
                              .cpu = NAN,
                              .work = work};
}

static struct study_row free_step(const char *scheme, double tolerance, double error, double work)
{
    struct study_row r = fixed(scheme, NAN, 1, error, work);
    r.setting.tolerance = tolerance;
    return r;
}

enum said { ANSWER, PICK };

static void says(const struct study *o, enum said what, const struct study_row *row, const char *expected)
{
    char *text;
    size_t n;
    FILE *to = open_memstream(&text, &n);
    if (what == ANSWER)
        study_answer(o, to);
    else
        study_print_pick(o, row, to);
    fclose(to);
    assert_string_equal(text, expected);
    free(text);
}

/* Ten times less error for ten times the work with rk4, for twice with dop853; doubtful and stopped rows tell nothing. */
static void test_digits(void **state)
{
    (void)state;
    struct study_row row[] = {
        fixed("rk4", .01, 1, 1e-2, 100),       fixed("rk4", .005, 1, 1e-3, 1000),
        fixed("rk4", .002, 1, 1e-4, 10000),    free_step("dop853", 1e-2, 5e-3, 200),
        free_step("dop853", 1e-6, 5e-7, 3200), fixed("midpoint", .1, 1, .1, 10),
        fixed("midpoint", .05, 1, .03, 20),    fixed("midpoint", .01, 1, .011, 30),
        fixed("newmark", .05, 1, .03, 40),     fixed("newmark", .02, 1, .0099, 40),
        fixed("newmark", .01, 1, 1e-9, 9e9),   fixed("newmark", .005, 1, 1e-9, 9e9),
    };
    row[10].doubtful = true;
    row[11].status = E_NUMERIC;
    struct study o = {.nrow = 12, .row = row};
    assert_true(fabs(study_digit(&o, &row[1]) - 10) < 1e-12);
    assert_true(fabs(study_digit(&o, &row[3]) - 2) < 1e-12);
    assert_true(isnan(study_digit(&o, &row[5]))); /* .03 and .011: less than a factor of three; .1 is too coarse */
    assert_true(isnan(study_digit(&o, &row[8]))); /* no more work for less error */
    row[9].work = 41;
    assert_true(fabs(study_digit(&o, &row[8]) - pow(41. / 40, 1 / log10(.03 / .0099))) < 1e-12);
    row[8].setting.ratio = 5; /* is of another chain */
    assert_true(isnan(study_digit(&o, &row[9])));
}

static void test_pick(void **state)
{
    (void)state;
    struct study_row row[] = {fixed("rk4", .01, 1, 1e-2, 100), fixed("midpoint", .01, 1, 1e-3, 90),
                              fixed("newmark", .01, 1, 1e-4, 80), fixed("newmark", .005, 1, 1e-4, 80)};
    struct study o = {.nrow = 4, .row = row};
    row[2].status = E_VERDICT;
    row[3].status = E_NUMERIC;
    assert_ptr_equal(study_pick(&o, 1e-2), &row[1]);
    assert_ptr_equal(study_pick(&o, 1e-3), &row[1]); /* at most */
    assert_null(study_pick(&o, 1e-4));
    row[3].status = OK;
    assert_ptr_equal(study_pick(&o, 1), &row[3]);
    row[2].status = OK;
    assert_ptr_equal(study_pick(&o, 1), &row[2]); /* of equals the first */
}

/* Levels with the cheapest of each and the next scheme; the deck's own row beside; times where they were taken. */
static void test_levels(void **state)
{
    (void)state;
    struct study_row row[] = {
        fixed("rk4", .01, 1, 1e-2, 100),
        fixed("rk4", .001, 1, 1e-4, 1000),
        free_step("dop853", 1e-4, 2e-5, 1030),
        free_step("dop853", 1e-2, 2e-3, 250),
    };
    struct study o = {.nrow = 4, .row = row, .own = &row[1], .subject = {.n = 2, .ns = 1}};
    row[0].cpu = .25;
    row[3].worst = "";
    says(
        &o, ANSWER, NULL,
        "error below 1e-02: rk4 at step 0.01 s (0.01 in pin.fx): work of 100 evaluations, 0.25 s; each further digit: "
        "x "
        "3.2 with rk4, x 2 with dop853, which takes 2.5 times the work\n"
        "error below 1e-04: rk4 at step 0.001 s (0.0001 in pin.fx): work of 1e+03 evaluations; each further digit: x "
        "3.2 "
        "with rk4, x 2 with dop853, which takes as much work\n"
        "error below 1e-06: none of these runs; the most accurate is dop853 at tolerance 0.0001 (2e-05 in pin.fx): "
        "work "
        "of 1.03e+03 evaluations\n"
        "the deck's own setting, rk4 at step 0.001 s: error 0.0001 in pin.fx, work of 1e+03 evaluations: the least for "
        "that error\n");
}

static void test_own(void **state)
{
    (void)state;
    struct study_row row[] = {fixed("rk4", .01, 1, NAN, 100), fixed("midpoint", .001, 1, .5, 50),
                              fixed("newmark", .5, 1, .4, 20)};
    struct study o = {.nrow = 3, .row = row, .own = &row[1]};
    const char *none =
        "error below 1e-02: none of these runs; the most accurate is newmark at step 0.5 s (0.4 in pin.fx): "
        "work of 20 evaluations\n"
        "error below 1e-04: none of these runs; the most accurate is newmark at step 0.5 s (0.4 in pin.fx): "
        "work of 20 evaluations\n"
        "error below 1e-06: none of these runs; the most accurate is newmark at step 0.5 s (0.4 in pin.fx): "
        "work of 20 evaluations\n";
    char expected[2000];
    snprintf(
        expected, sizeof expected, "drives move everything: every scheme gives the same motion\n%s%s", none,
        "the deck's own setting, midpoint at step 0.001 s: error 0.5 in pin.fx, work of 50 evaluations, 2.5 times that "
        "of newmark at step 0.5 s (0.4)\n");
    says(&o, ANSWER, NULL, expected);
    o.subject.n = 1;
    row[1].status = E_VERDICT;
    row[1].work = 20.9;
    snprintf(
        expected, sizeof expected, "%s%s", none,
        "the deck's own setting, midpoint at step 0.001 s: error 0.5 in pin.fx, its balance of energy broken, work of "
        "20.9 evaluations, as much as newmark at step 0.5 s (0.4)\n");
    says(&o, ANSWER, NULL, expected);
    row[1].status = E_NUMERIC;
    snprintf(expected, sizeof expected, "%s%s", none,
             "the deck's own setting, midpoint at step 0.001 s, stops on the way\n");
    says(&o, ANSWER, NULL, expected);
    o.nrow = 1; /* nothing of which an error is known */
    o.own = NULL;
    says(
        &o, ANSWER, NULL,
        "none of the deck's columns can be compared, so that no error is known: neither steps and counts, nor what is\n"
        "round-off or what the reference does not know; let it write places, angles or rates (output: columns)\n");
    row[0].status = E_NUMERIC; /* nothing that ended */
    says(&o, ANSWER, NULL,
         "error below 1e-02: none of these runs\nerror below 1e-04: none of these runs\nerror below 1e-06: none of "
         "these "
         "runs\n");
}

/* "error below ..." of rows none of which is better than 1e-2, `best` the best. */
static const char *levels(const char *best)
{
    static char text[1200];
    int n = 0;
    for (int i = 2; i <= 6; i += 2)
        n += snprintf(text + n, sizeof text - (size_t)n,
                      "error below 1e-0%d: none of these runs; the most accurate is %s\n", i, best);
    return text;
}

static void two_rates_say(const struct study *o, const char *best, const char *line)
{
    char expected[2000];
    snprintf(expected, sizeof expected, "%s%s", levels(best), line);
    says(o, ANSWER, NULL, expected);
}

/* What two rates are judged by: the cheapest of one rate that is as accurate, and the same scheme at one rate. */
static void test_two_rates(void **state)
{
    (void)state;
    struct study_row row[] = {fixed("subcycle", .01, 5, .02, 100), fixed("midpoint", .01, 1, .021, 300),
                              fixed("newmark", .01, 1, .02, 50), fixed("newmark", .02, 1, .022, 40),
                              fixed("subcycle", .01, 2, .05, 90)};
    struct study o = {.nrow = 5, .row = row, .subject = {.n = 8, .ns = 2}};
    const char *best = "subcycle at step 0.01 s, ratio 5 (0.02 in pin.fx): work of 100 evaluations";
    row[0].effort.sweeps = 25;
    row[0].effort.majors = 10;
    two_rates_say(
        &o, best,
        "subcycle at step 0.01 s, ratio 5 (0.02) does not pay here: 2 times the work of newmark at step 0.01 s "
        "(0.02); against midpoint, the same at one rate, it takes 0.33 times the work (25 % of the coordinates "
        "are fast, 2.5 sweeps a major step)\n");
    row[2].work = 200;
    row[3].errors.worst = .0211; /* more than a twentieth worse */
    two_rates_say(
        &o, best,
        "subcycle at step 0.01 s, ratio 5 (0.02) pays: 0.5 times the work of newmark at step 0.01 s (0.02); "
        "against midpoint, the same at one rate, it takes 0.33 times the work (25 % of the coordinates are fast, "
        "2.5 sweeps a major step)\n");
    row[2].status = E_NUMERIC;
    row[1].errors.worst = .03;
    row[1].setting.step = .02; /* no twin */
    row[3].errors.worst = .04;
    row[3].work = 101;
    two_rates_say(&o, best,
                  "subcycle at step 0.01 s, ratio 5 (0.02): no run of one rate here is as accurate; the most accurate, "
                  "midpoint at step 0.02 s (0.03), takes 3 times the work\n");
    row[1].work = row[3].work = 99;
    two_rates_say(&o, best, "subcycle at step 0.01 s, ratio 5 (0.02): no run of one rate here is as accurate\n");
    row[0].errors.worst = row[4].errors.worst = 1.5; /* more than its columns' range */
    two_rates_say(&o, "midpoint at step 0.02 s (0.03 in pin.fx): work of 99 evaluations",
                  "subcycle: none of its runs is whole, balanced and within its columns' range\n");
}

/* By a tolerance, too: the same scheme at one rate is that of the same tolerance, not another scheme of it. */
static void test_twin_by_tolerance(void **state)
{
    (void)state;
    struct study_row row[] = {free_step("subcycle", 1e-4, .02, 100), free_step("newmark", 1e-4, .5, 50),
                              free_step("midpoint", 1e-3, .4, 20), free_step("midpoint", 1e-4, .3, 25)};
    struct study o = {.nrow = 4, .row = row, .subject = {.n = 8, .ns = 2}};
    row[0].effort.sweeps = row[0].effort.majors = 10;
    two_rates_say(&o, "subcycle at tolerance 0.0001 (0.02 in pin.fx): work of 100 evaluations",
                  "subcycle at tolerance 0.0001 (0.02): no run of one rate here is as accurate; against midpoint, the "
                  "same at one rate, it takes 4 times the work (25 % of the coordinates are fast, 1 sweeps a major "
                  "step)\n");
}

/* What was not run, and why. */
static void test_gaps(void **state)
{
    (void)state;
    struct study_row row[] = {fixed("rk4", .01, 1, NAN, 1)};
    struct study_gap gap[] = {
        {.from = {kind("rk4"), NAN, 1e-3, 1}, .all = true, .work = 2e6},
        {.from = {kind("midpoint"), NAN, 1e-3, 1}, .all = true, .budget = true, .work = 1e5},
        {.from = {kind("newmark"), NAN, 1e-4, 1}},
        {.from = {kind("dop853"), 1e-6, NAN, 1}},
        {.from = {kind("subcycle"), NAN, 1e-4, 3}, .budget = true},
    };
    struct study o = {
        .nrow = 1, .row = row, .ngap = 5, .gap = gap, .fastest = 1234, .subject.n = 1, .reference.work = 5000};
    row[0].status = E_NUMERIC;
    says(&o, ANSWER, NULL,
         "left out: rk4 at step 0.001 s, which takes 2e+06 evaluations or more, more than the reference: an explicit "
         "scheme has to follow the fastest vibration, 1.23e+03 rad/s\n"
         "left out: midpoint at step 0.001 s, which takes 1e+05 evaluations or more, its share of the budget\n"
         "more work than the reference, 5e+03 evaluations, and left out: from newmark at step 0.0001 s, dop853 at "
         "tolerance 1e-06 on\n"
         "over the budget: from subcycle at step 0.0001 s, ratio 3 on\n"
         "error below 1e-02: none of these runs\nerror below 1e-04: none of these runs\nerror below 1e-06: none of "
         "these "
         "runs\n");
}

/* As lines of a deck; of a part of the run it says so. */
static void test_lines(void **state)
{
    (void)state;
    struct study_row row = fixed("subcycle", 1. / 1024, 4, 1e-3, 1), other = free_step("radau5", 2.5e-5, 1e-3, 1);
    struct scene scene = {.start = 1, .integrate.until = 5};
    struct study o = {.nrow = 1, .row = &row, .subject = {.scene = &scene, .until = 5}};
    assert_true(study_share(&o) == 1);
    says(&o, PICK, &row, "integrate:\n  scheme: subcycle\n  step: 0.0009765625\n  ratio: 4\n");
    o.subject.until = 2;
    assert_true(study_share(&o) == .25);
    says(&o, PICK, &other,
         "# its error was measured up to t = 2 s only, of 5 s\nintegrate:\n  scheme: radau5\n  tolerance: 2.500e-05\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_digits),    cmocka_unit_test(test_pick),
                                       cmocka_unit_test(test_levels),    cmocka_unit_test(test_own),
                                       cmocka_unit_test(test_two_rates), cmocka_unit_test(test_twin_by_tolerance),
                                       cmocka_unit_test(test_gaps),      cmocka_unit_test(test_lines)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
