/* t-crew.c -- jobs in processes of their own: heard in order whichever ends first, failures with their words, signals. */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/crew.h"
#include "base/stop.h"

#include <cmocka.h>

enum { JOBS = 5, LARGE = 300000 };

struct heard {
    int n, job[4 * JOBS];
    double sum;
};

/* The first job is the slowest and tells the most, through a pipe that is full long before. */
static enum status work(void *self, int i, int to, struct report *report)
{
    double *large = calloc(LARGE, sizeof *large);
    (void)self, (void)report;
    if (i == 0) usleep(200000);
    large[LARGE - 1] = i;
    enum status status = crew_tell(to, &i, sizeof i);
    if (status == OK) status = crew_tell(to, large, i == 0 ? LARGE * sizeof *large : sizeof *large);
    free(large);
    return status;
}

static enum status hear(void *self, int i, const void *bytes, size_t n, struct report *report)
{
    struct heard *o = self;
    (void)report;
    assert_int_equal((uintptr_t)bytes % _Alignof(max_align_t), 0);
    if (n == sizeof(int)) assert_int_equal(*(const int *)bytes, i);
    if (n == LARGE * sizeof(double)) o->sum += 1 + ((const double *)bytes)[LARGE - 1];
    o->job[o->n++] = i;
    return OK;
}

static void in_order(void **state)
{
    struct heard heard = {0};
    struct report report = {0};
    struct arena *life = arena_open();
    const struct crew crew = {.n = JOBS, .self = &heard, .work = work, .hear = hear};
    (void)state;
    assert_int_equal(crew_run(&crew, life, &report), OK);
    assert_int_equal(heard.n, 2 * JOBS);
    for (int i = 0; i < heard.n; i++) assert_int_equal(heard.job[i], i / 2);
    assert_true(heard.sum == 1);
    arena_close(life);
}

/* What failed long before, by errno, is no reason to pass over what a pipe has, nor over its end. */
static void after_interruption(void **state)
{
    const int before[] = {EINTR, EAGAIN};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct heard heard = {0};
        struct report report = {0};
        struct arena *life = arena_open();
        const struct crew crew = {.n = JOBS, .self = &heard, .work = work, .hear = hear};
        alarm(20);
        errno = before[i];
        assert_int_equal(crew_run(&crew, life, &report), OK);
        alarm(0);
        assert_int_equal(heard.n, 2 * JOBS);
        assert_true(heard.sum == 1);
        arena_close(life);
    }
}

static enum status work_badly(void *self, int i, int to, struct report *report)
{
    TRY(work(self, i, to, report));
    return i == 2 ? (fail)(report, E_NUMERIC, "job %d cannot", i) : OK;
}

/* What it has told before is heard; those after it are not. */
static void failing(void **state)
{
    struct heard heard = {0};
    struct report report = {0};
    struct arena *life = arena_open();
    const struct crew crew = {.n = JOBS, .self = &heard, .work = work_badly, .hear = hear};
    (void)state;
    assert_int_equal(crew_run(&crew, life, &report), E_NUMERIC);
    assert_string_equal(report.text, "job 2 cannot");
    assert_int_equal(heard.n, 6);
    arena_close(life);
}

static enum status be_killed(void *self, int i, int to, struct report *report)
{
    (void)self, (void)i, (void)to, (void)report;
    raise(SIGKILL);
    return OK;
}

static void killed(void **state)
{
    struct heard heard = {0};
    struct report report = {0};
    struct arena *life = arena_open();
    const struct crew crew = {.n = 1, .self = &heard, .work = be_killed, .hear = hear};
    (void)state;
    assert_int_equal(crew_run(&crew, life, &report), E_LIMIT);
    assert_non_null(strstr(report.text, "signal 9"));
    arena_close(life);
}

/* A signal that is there before it begins: nothing is begun. */
static void stopped(void **state)
{
    struct heard heard = {0};
    struct report report = {0};
    struct arena *life = arena_open();
    const struct crew crew = {.n = JOBS, .self = &heard, .work = work, .hear = hear};
    (void)state;
    stop = SIGINT;
    assert_int_equal(crew_run(&crew, life, &report), E_SIGINT);
    assert_int_equal(heard.n, 0);
    stop = 0;
    arena_close(life);
}

static void none(void **state)
{
    struct report report = {0};
    struct arena *life = arena_open();
    const struct crew crew = {.n = 0, .self = NULL, .work = work, .hear = hear};
    (void)state;
    assert_int_equal(crew_run(&crew, life, &report), OK);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(in_order), cmocka_unit_test(after_interruption),
                                       cmocka_unit_test(failing),  cmocka_unit_test(killed),
                                       cmocka_unit_test(stopped),  cmocka_unit_test(none)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
