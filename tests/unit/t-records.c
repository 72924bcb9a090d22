/* t-records.c -- dop853, radau5, radau9: records between the ends of their steps.  The weights of order 8's by the conditions of
 * all trees; measured orders, with rotations, too; what they are said to be off by; where they cannot be had the step ends. */
#include <complex.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/collocation.h"
#include "engine/embedded.h"
#include "unit/oscillators.h"

#include <cmocka.h>

/* ---- the conditions of order ----------------------------------------------------------------------------------- */

enum { S = RK_STAGES, ORDER = 8, MOST_TREES = 256 };

/* A rooted tree t of so many nodes: gamma(t) and, of each stage, phi_i(t) = product of sum a_ij phi_j over its branches. */
struct rooted {
    int nodes;
    double gamma, phi[S];
};

struct forest {
    const struct rk_table *table;
    struct rooted tree[MOST_TREES];
    int n;
};

/* All trees of `nodes` whose branches come from the first `from` of the forest, each no later than the one before it, on top of
 * those that t has already. */
static void grow(struct forest *o, struct rooted t, int nodes, int from)
{
    if (t.nodes == nodes) {
        t.gamma *= nodes;
        assert_true(o->n < MOST_TREES);
        o->tree[o->n++] = t;
        return;
    }
    for (int b = from - 1; b >= 0; b--) {
        const struct rooted branch = o->tree[b];
        struct rooted next = t;
        if (t.nodes + branch.nodes > nodes) continue;
        next.nodes += branch.nodes;
        next.gamma *= branch.gamma;
        for (int i = 0; i < S; i++) {
            double sum = 0;
            for (int j = 0; j < i; j++) sum += o->table->a[i][j] * branch.phi[j];
            next.phi[i] *= sum;
        }
        grow(o, next, nodes, b + 1);
    }
}

/* What embedded.h has in the part x of the step as weights of the slopes. */
static void weights(double *w, const struct embedded_pair *p, double x)
{
    const int last = p->table.stages - 1;
    const double y = 1 - x, part[] = {y, x * y, x * y * y, x * x * y * y};
    assert_int_equal(p->bends, 4);
    for (int j = 0; j < S; j++) {
        const double b = p->table.b[j], lead = (j == 0) - b;
        double bent = 0;
        for (int r = 0; r < 4; r++) bent += part[r] * p->d[r][j];
        w[j] = x * (b + y * (lead + x * (b - (j == last) - lead + bent)));
    }
}

/* sum w_j(x) phi_j(t) = x^nodes / gamma(t) up to order 7 anywhere, up to 8 at the end; of order 8 on the way it is not. */
static void test_conditions(void **state)
{
    static const int count[ORDER + 1] = {0, 1, 1, 2, 4, 9, 20, 48, 115};
    const struct embedded_pair *p = stepper_find("dop853")->formulas;
    struct forest o = {.table = &p->table};
    struct rooted root = {.nodes = 1, .gamma = 1};
    double beyond = 0, worst = 0;
    (void)state;
    for (int i = 0; i < S; i++) {
        double c = 0;
        for (int j = 0; j < i; j++) c += p->table.a[i][j];
        if (!(fabs(c - p->table.c[i]) < 1e-14)) print_error("row %d: %g\n", i, c - p->table.c[i]);
        assert_true(fabs(c - p->table.c[i]) < 1e-14);
        root.phi[i] = 1;
    }
    for (int nodes = 1; nodes <= ORDER; nodes++) {
        const int before = o.n;
        grow(&o, root, nodes, before);
        assert_int_equal(o.n - before, count[nodes]);
    }
    for (int i = 0; i < o.n; i++)
        for (int k = 1; k <= 20; k++) {
            const double x = k / 20.;
            double w[S], sum = -pow(x, o.tree[i].nodes) / o.tree[i].gamma;
            weights(w, p, x);
            for (int j = 0; j < S; j++) sum += w[j] * o.tree[i].phi[j];
            if (o.tree[i].nodes == ORDER && k < 20)
                beyond = fmax(beyond, fabs(sum));
            else
                worst = fmax(worst, fabs(sum));
        }
    if (!(worst < 4e-15)) print_error("order 7: off by %g\n", worst);
    assert_true(worst < 4e-15); /* the round-off of weights of hundreds */
    assert_true(beyond > 1e-7);
}

/* Sizes of e and e2 in a step of y' = i x y, y = 1. */
static void harmonic(double *first, double *second, const struct embedded_pair *p, double x)
{
    double complex k[S], sum = 0, sum2 = 0;
    for (int i = 0; i < p->table.stages; i++) {
        double complex y = 1;
        for (int j = 0; j < i; j++) y += p->table.a[i][j] * k[j];
        k[i] = I * x * y;
        sum += p->e[i] * k[i];
        sum2 += p->e2[i] * k[i];
    }
    *first = cabs(sum);
    *second = cabs(sum2);
}

/* The error by both, 10 e^2/e2 in short steps, over e2^2. */
static void test_harmonic(void **state)
{
    (void)state;
    const struct embedded_pair *p = stepper_find("dop853")->formulas;
    double e, e2, longer, longer2;
    harmonic(&e, &e2, p, .1);
    harmonic(&longer, &longer2, p, .2);
    assert_true(fabs(log2(longer / e) - 6) < .01 && fabs(log2(longer2 / e2) - 4) < .01);
    const double found = 10 * e * e / (e2 * e2 * e2);
    if (!(fabs(found / p->harmonic - 1) < .005)) print_error("%g for %g\n", p->harmonic, found);
    assert_true(fabs(found / p->harmonic - 1) < .005);
}

/* Of the collocation: integrals of powers up to s, and to 1 the weights of the method. */
static void test_along(void **state)
{
    (void)state;
    for (int s = 3; s <= 5; s += 2) {
        struct collocation o;
        double w[COLLOCATION_STAGES + 1];
        collocation_radau(&o, s);
        for (int k = 0; k <= s; k++)
            for (double x = .1; x < 1; x += .2) {
                double sum = 0;
                collocation_along(&o, w, x);
                if (k == 0) sum += w[0];
                for (int i = 0; i < s; i++) sum += w[i + 1] * pow(o.c[i], k);
                assert_true(fabs(sum - pow(x, k + 1) / (k + 1)) < 2e-15);
            }
        double most = 0,
               there =
                   -pow(o.widest, s + 1); /* of the first power that is not met: what integral and slope are off by */
        for (double x = .01; x < 1; x += .01) {
            double sum = -pow(x, s + 2) / (s + 2), slope = -pow(x, s);
            collocation_along(&o, w, x);
            for (int i = 0; i < s; i++) sum += w[i + 1] * pow(o.c[i], s + 1);
            most = fmax(most, fabs(sum));
            collocation_slope(&o, w, x);
            for (int i = 0; i < s; i++) slope += w[i + 1] * pow(o.c[i], s);
            assert_true(fabs(slope) < 1e-14);
        }
        collocation_slope(&o, w, o.widest);
        for (int i = 0; i < s; i++) there += w[i + 1] * pow(o.c[i], s + 1);
        assert_true(fabs(o.share * fabs(there) / most - 1) < .01);
        collocation_along(&o, w, 1);
        assert_true(fabs(w[0]) < 2e-15);
        for (int i = 0; i < s; i++) assert_true(fabs(w[i + 1] - o.b[i]) < 3e-15);
    }
}

/* ---- between the ends of steps ---------------------------------------------------------------------------------- */

enum { PARTS_OF_STEP = 8 };

/* One step h of a body on a ball joint, from 0: what its parts are off by, against rk4 with far smaller steps. */
static double inside(const char *scheme, double tolerance, double h)
{
    struct carrier body;
    struct run r, fine;
    struct step_options o = step_defaults;
    double worst = 0;
    o.tolerance = tolerance;
    carrier_open(&body, 0);
    assert_int_equal(run_open(&r, scheme, &body.ode, &o, carrier_q + 1, carrier_v + 1), OK);
    assert_int_equal(run_open(&fine, "rk4", &body.ode, &step_defaults, carrier_q + 1, carrier_v + 1), OK);
    assert_true(adaptive_interpolates(&r.stepper));
    r.stepper.natural = true;
    r.stepper.guess = (struct guess){h, 1};
    r.stepper.due = h / 2;
    assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, 10, &r.why), OK);
    if (r.x.t != h) return NAN;
    for (int k = 1; k < PARTS_OF_STEP; k++) {
        double q[8], v[8];
        assert_int_equal(run_steps(&fine, h / PARTS_OF_STEP / 400, 400, 1), OK);
        assert_true(adaptive_between(&r.stepper, q, v, fine.x.t));
        for (int i = 0; i < body.ode.nq; i++) worst = fmax(worst, fabs(q[i] - fine.q[i]));
        for (int i = 0; i < body.ode.n; i++) worst = fmax(worst, fabs(v[i] - fine.v[i]));
    }
    run_close(&fine);
    run_close(&r);
    return worst;
}

/* In a step of length h they are off by its power 8, of Radau IIA of s stages s + 2: both where its iterations leave less. */
static void test_order(void **state)
{
    static const struct {
        const char *scheme;
        double tolerance, h, order;
    } of[] = {{"dop853", 1e-1, .3, 8}, {"radau5", 1e-3, .15, 5}, {"radau9", 1e-8, .15, 7}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        const double coarse = inside(of[i].scheme, of[i].tolerance, of[i].h),
                     fine = inside(of[i].scheme, of[i].tolerance, of[i].h / 2), order = log2(coarse / fine);
        if (!(order > of[i].order - .3 && order < of[i].order + .7))
            print_error("%s: %g %g, order %g\n", of[i].scheme, coarse, fine, order);
        assert_true(order > of[i].order - .3 && order < of[i].order + .7);
    }
}

/* Two vibrations, a record in each step: what is off inside is no more than at the ends and a tolerance, and the steps are hardly
 * more than those without records. */
static void test_held(void **state)
{
    static const char *const scheme[] = {"dop853", "radau5", "radau9"};
    (void)state;
    for (int i = 0; i < 3; i++)
        for (int k = 3; k <= 10; k++) {
            long steps[2];
            double within = 0, ends = 0;
            const double tolerance = pow(10, -k);
            for (int records = 0; records < 2; records++) {
                struct linear s;
                struct run r;
                struct step_options o = step_defaults;
                o.tolerance = tolerance;
                linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){9, 0, 0, 400}, NULL);
                assert_int_equal(run_open(&r, scheme[i], &s.ode, &o, (double[]){1, .1}, (double[]){0, 0}), OK);
                r.stepper.natural = true;
                for (double t = 0; r.x.t < 5; t = r.x.t) {
                    r.stepper.due = records ? t + .4 * adaptive_of(&r.stepper)->h : INFINITY;
                    assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, 5, &r.why), OK);
                    ends = fmax(ends, fabs(r.v[0] / 3 + sin(3 * r.x.t)) + fabs(r.v[1] / 3 + 2. / 3 * sin(20 * r.x.t)));
                    for (int part = 1; adaptive_of(&r.stepper)->ready && part < 10; part++) {
                        const double at = t + part * (r.x.t - t) / 10;
                        double q[2], v[2];
                        assert_true(adaptive_between(&r.stepper, q, v, at));
                        within = fmax(within, fabs(v[0] / 3 + sin(3 * at)) + fabs(v[1] / 3 + 2. / 3 * sin(20 * at)));
                    }
                }
                steps[records] = r.stepper.effort.minors;
                run_close(&r);
            }
            const bool held =
                within > 0 && within < 1.5 * ends + 2 * tolerance && (double)steps[1] < 1.2 * (double)steps[0];
            if (!held)
                print_error("%s at 1e-%d: %g, %g; steps %ld, %ld\n", scheme[i], k, within, ends, steps[0], steps[1]);
            assert_true(held);
        }
}

/* What cannot be evaluated about t = 0.01, which no stage of a step of 0.1 meets but one of those for records in it. */
static enum status fails_there(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                               unsigned cls, struct trouble *why)
{
    if (fabs(x->t - .01) < 1e-3) return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, x->t);
    return linear_resid(o, r, w, dk, x, cls, why);
}

/* Then the step ends on the record; one without a record in it goes on. */
static void test_ends_there(void **state)
{
    (void)state;
    for (int records = 0; records < 2; records++) {
        struct linear s;
        struct run r;
        struct step_options o = step_defaults;
        o.tolerance = 1e-3;
        linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){9, 0, 0, 4}, NULL);
        struct ode2_ops ops = *s.ode.ops;
        ops.resid = fails_there;
        s.ode.ops = &ops;
        assert_int_equal(run_open(&r, "dop853", &s.ode, &o, (double[]){1, .1}, (double[]){0, 0}), OK);
        r.stepper.natural = true;
        r.stepper.guess = (struct guess){.1, 1};
        r.stepper.due = records ? .07 : INFINITY;
        assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, 5, &r.why), OK);
        assert_true(r.x.t == (records ? .07 : .1));
        run_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_conditions), cmocka_unit_test(test_harmonic), cmocka_unit_test(test_along),
        cmocka_unit_test(test_order),      cmocka_unit_test(test_held),     cmocka_unit_test(test_ends_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
