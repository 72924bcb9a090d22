/* t-audit.c -- sub-cycling is of second order wherever the cut between fast and slow goes: through ball, free, planar
 * and cylindrical joints, at the root with slow leaves, in several branches, with springs and bushings across.
 *
 * The decks are those of tests/decks whose motion by dopri5 is checked against an independent reference; dopri5 at
 * tolerance 1e-12 is the reference here.  Position, velocity and the works of the ledger count. */
#include <math.h>
#include <string.h>

#include "sim/load.h"
#include "sim/sim.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { MOST = 64 };

static const struct cut {
    const char *deck, *fast;
} cuts[] = {
    {"ball-chain", "p"},               /* a slider on a slow ball joint */
    {"ball-chain", "s"},               /* a ball joint with a slow slider behind it */
    {"ball-chain", "u"},               /* the root, slow leaves */
    {"ball-chain", "u.angle1"},        /* through a universal joint */
    {"ball-chain", "r, p"},            /* slow ball joint between fast ones */
    {"ball-chain", "u, r, s, p"},      /* everything */
    {"ball-chain", ""},                /* nothing */
    {"branches", "c1.displacement"},   /* through a cylindrical joint at the root */
    {"branches", "u.angle1, pl.y, s"}, /* in both branches */
    {"free-bushings", "cy"},           /* on a free body */
    {"free-bushings", "fr"},           /* the free body, bushings across */
    {"free-on-ball", "fr"},            /* a free joint on a slow ball joint */
    {"free-on-ball", "rr"},            /* a free leaf */
    {"two-free", "j"},                 /* a spring across, nothing else */
    {"plane-and-balls", "s1, cy"},     /* on a slow planar joint */
    {"plane-and-balls", "pl"},         /* a planar root */
    {"planar-mix", "pl.y, p2"},        /* through a planar joint */
    {"planar-mix", "h"},               /* a hinge at the root */
    {"planar-bushings", "pl"},         /* planar joint written child first */
    {"planar-bushings", "fr, pp"},     /* free body and a leaf elsewhere */
    {"reversed-chain", "p, u.angle2"}, /* joints written child first */
    {"reversed-chain", "cy.displacement"},
    {"loop-leaf", "P"},    /* a leaf on a slow loop */
    {"loop-leaf", "A"},    /* a fast loop with slow leaves */
    {"loop-spatial", "L"}, /* a ball joint on a slow loop */
    {"loop-spatial", "A"},
};

static struct arena *open_run(struct sim *sim, const char *path, int nset, const char *const *set, FILE *say)
{
    struct report report = {0};
    struct scene *scene;
    const struct deck_options options = {.nset = nset, .set = set};
    const struct sim_options how = {.version = "test", .log = say};
    struct arena *life = arena_open();
    struct diags *diags = diags_open(life);
    enum status status = sim_load(&scene, path, &options, diags, life, &report);
    if (status == OK) status = sim_open(sim, scene, &scene->integrate, &how, diags, life, &report);
    if (status != OK) {
        diags_print(stderr, diags, false);
        fprintf(stderr, "%s: %s\n", path, report.text);
    }
    assert_int_equal(status, OK);
    return life;
}

/* End of a run: positions, velocities, works; returns their number. */
static int end_of_run(double *end, const struct cut *cut, const char *how)
{
    char path[80], fast[60];
    struct report report = {0};
    struct sim sim;
    snprintf(path, sizeof path, "tests/decks/audit-%s.yaml", cut->deck);
    snprintf(fast, sizeof fast, "partition={fast: [%s]}", cut->fast);
    const char *const set[] = {fast, how, "integrate.until=0.4", "output.every=0.4"};
    struct arena *life = open_run(&sim, path, 4, set, NULL);
    enum status status = sim_run(&sim, NULL, &report);
    if (status != OK) fprintf(stderr, "%s, %s: %s\n", path, how, report.text);
    assert_int_equal(status, OK);
    int nq = sim.model->nq, n = nq + sim.model->n;
    assert_true(n + 2 <= MOST);
    memcpy(end, sim.x.q, (size_t)nq * sizeof *end);
    memcpy(end + nq, sim.x.v, (size_t)sim.model->n * sizeof *end);
    end[n] = sim.ledger.work[LEDGER_EXTERNAL];
    end[n + 1] = sim.ledger.work[LEDGER_DAMPER];
    arena_close(life);
    return n + 2;
}

static double error_of(const struct cut *cut, const double *ref, double h, int ratio)
{
    char how[120];
    double end[MOST], e = 0;
    snprintf(how, sizeof how, "integrate={scheme: subcycle, step: %g, ratio: %d, newton_tolerance: 1.0e-12}", h, ratio);
    int n = end_of_run(end, cut, how);
    for (int i = 0; i < n; i++) e = fmax(e, fabs(end[i] - ref[i]));
    return e;
}

static void test_order_of_every_cut(void **state)
{
    static const int ratios[] = {2, 5, 10};
    double ref[MOST];
    (void)state;
    for (size_t c = 0; c < sizeof cuts / sizeof *cuts; c++) {
        end_of_run(ref, &cuts[c], "integrate={scheme: dopri5, tolerance: 1.0e-12}");
        for (size_t k = 0; k < sizeof ratios / sizeof *ratios; k++) {
            double coarse = error_of(&cuts[c], ref, 5e-4, ratios[k]), fine = error_of(&cuts[c], ref, 2.5e-4, ratios[k]);
            double order = log2(coarse / fine);
            if (!(fabs(order - 2) < 0.15))
                fail_msg("%s, fast: [%s], ratio %d: errors %.2e, %.2e, order %.2f", cuts[c].deck, cuts[c].fast,
                         ratios[k], coarse, fine, order);
        }
    }
}

/* A load that depends on t alone acts on a slow body at every minor step: with a period of one or half a major step
 * its mean still arrives whole. */
static void test_load_on_slow_body(void **state)
{
    const struct cut cut = {"slow-load", "q"};
    double end[MOST];
    (void)state;
    for (int ratio = 5; ratio <= 20; ratio *= 2) {
        char how[100];
        snprintf(how, sizeof how, "integrate={scheme: subcycle, step: 1.0e-3, ratio: %d}", ratio);
        int n = end_of_run(end, &cut, how);
        /* 5 N in the mean on 3 kg for 0.4 s, q moves across; v is (q, p) and two works follow */
        assert_true(fabs(end[n - 3] - 5 * 0.4 / 3) < 1e-12);
    }
}

/* A body that turns farther in a step than the step can tell is told of, though its energy is kept. */
static void test_far_turns_are_told(void **state)
{
    (void)state;
    for (int far = 0; far < 2; far++) {
        const char *const set[] = {far ? "integrate={scheme: midpoint, step: 0.4, until: 4}"
                                       : "integrate={scheme: midpoint, step: 0.2, until: 4}",
                                   "output.every=4", "initial={float.omega: [0, 0, 5]}"};
        char words[2000];
        struct report report = {0};
        struct sim sim;
        FILE *say = tmpfile();
        assert_non_null(say);
        struct arena *life = open_run(&sim, "decks/free-top.yaml", 3, set, say);
        assert_int_equal(sim_run(&sim, NULL, &report), OK);
        arena_close(life);
        rewind(say);
        words[fread(words, 1, sizeof words - 1, say)] = 0;
        fclose(say);
        assert_int_equal(strstr(words, "warning: 'float' turns by") != NULL, far); /* 2 rad or 1 */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_of_every_cut),
        cmocka_unit_test(test_load_on_slow_body),
        cmocka_unit_test(test_far_turns_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
