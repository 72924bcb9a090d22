/* t-tie.c -- interfaces: they know rigid motions, hold what they should, and the order of nodes keeps the band small.
 */
#include "reduce/bar.h"
#include "reduce/rigid.h"

static void bar(struct bench *b)
{
    const struct fe_source source = {.job = BAR, .units = {1, 1, 1}};
    memset(b, 0, sizeof *b);
    b->life = arena_open();
    must(fe_read(&b->fe, &source, b->life, &b->report), b);
}

/* Every kind of interface reads a rigid motion of the body about its own point exactly. */
static void test_motion(void **state)
{
    static const struct tie_options wishes[] = {
        {.name = "a", .where = "root", .rigid = true},
        {.name = "b", .where = "tip"},
        {.name = "c", .where = "TIP", .placed = true, .at = {1.3, 0.2, -0.1}},
        {.name = "d", .where = "5+6+7"},
        {.name = "e", .where = "5"},
    };
    struct bench b;
    (void)state;
    bar(&b);
    double *r = TAKE(b.life, double, 3 * b.fe.n);
    for (size_t t = 0; t < sizeof wishes / sizeof *wishes; t++) {
        must(tie_make(b.tie, wishes + t, &b.fe, b.life, &b.report), &b);
        for (int k = 0; k < 6; k++) {
            double m[6];
            rigid_motion(r, &b.fe, b.tie->x, k);
            tie_motion(m, b.tie, r);
            for (int a = 0; a < 6; a++) close_to(m[a], a == k, 1e-12, wishes[t].name);
        }
        assert_int_equal(b.tie->motions, t == 4 ? 3 : 6);
    }
    close_to(b.tie->x[0], 1, 1e-12, "a node stands where it stands");
    bench_end(&b);
}

/* A single node has its own displacement, not its neighbours'. */
static void test_node(void **state)
{
    static const struct tie_options options = {.name = "e", .where = "5"};
    struct bench b;
    (void)state;
    bar(&b);
    must(tie_make(b.tie, &options, &b.fe, b.life, &b.report), &b);
    double *u = TAKE(b.life, double, 3 * b.fe.n), m[6];
    for (int i = 0; i < 3 * b.fe.n; i++) u[i] = cos(i);
    tie_motion(m, b.tie, u);
    for (int a = 0; a < 3; a++) close_to(m[a], u[3 * b.tie->node[0] + a], 1e-15, "displacement");
    bench_end(&b);
}

/* Constraint modes: every interface moves as it is told, the others rest, no load but at the interfaces; all mixes of
 * rigid and average ties. */
static void test_constraint_modes(void **state)
{
    (void)state;
    for (int mix = 0; mix < 8; mix++) {
        const struct tie_options wishes[] = {{.name = "root", .where = "root", .rigid = mix & 1},
                                             {.name = "tip", .where = "tip", .rigid = mix & 2},
                                             {.name = "middle", .where = "25+30+35+40", .rigid = mix & 4}};
        struct bench b;
        struct tie tie[3];
        const struct tie *held[] = {tie, tie + 1, tie + 2};
        struct hold hold;
        bar(&b);
        for (int t = 0; t < 3; t++) must(tie_make(tie + t, wishes + t, &b.fe, b.life, &b.report), &b);
        must(tie_check(tie, 3, &b.fe, &b.report), &b);
        must(hold_make(&hold, &b.fe, held, 3, b.life, &b.report), &b);
        double *u = TAKE(b.life, double, hold.size), *f = TAKE(b.life, double, hold.size);
        for (int t = 1; t < 3; t++)
            for (int k = 0; k < 6; k++) {
                double most = 0, rest = 0;
                hold_static(u, &hold, tie + t, k);
                for (int other = 0; other < 3; other++) {
                    double m[6];
                    tie_motion(m, tie + other, u);
                    for (int a = 0; a < 6; a++) close_to(m[a], other == t && a == k, 1e-8, wishes[other].name);
                }
                sparse_mul(f, &b.fe.K, u);
                for (int i = 0; i < hold.size; i++) {
                    bool taken = false;
                    for (int o = 0; o < 3; o++)
                        for (int n = 0; n < tie[o].n; n++) taken = taken || tie[o].node[n] == i / 3;
                    most = fmax(most, fabs(f[i]));
                    if (!taken) rest = fmax(rest, fabs(f[i]));
                }
                close_to(rest, 0, 1e-7 * most, "no load between");
            }
        bench_end(&b);
    }
}

/* The loads' answer is symmetric: f' K^-1 g = g' K^-1 f, whatever holds the body. */
static void test_symmetric(void **state)
{
    (void)state;
    for (int rigid = 0; rigid < 2; rigid++) {
        const struct tie_options options = {.name = "root", .where = "root", .rigid = rigid};
        struct bench b;
        const struct tie *held = b.tie;
        struct hold hold;
        bar(&b);
        must(tie_make(b.tie, &options, &b.fe, b.life, &b.report), &b);
        must(hold_make(&hold, &b.fe, &held, 1, b.life, &b.report), &b);
        double *f = TAKE(b.life, double, hold.size), *g = TAKE(b.life, double, hold.size);
        double *u = TAKE(b.life, double, hold.size), *v = TAKE(b.life, double, hold.size), fv = 0, gu = 0, fu = 0;
        for (int i = 0; i < hold.size; i++) {
            f[i] = sin(i);
            g[i] = cos(3 * i);
        }
        hold_solve(u, &hold, f);
        hold_solve(v, &hold, g);
        for (int i = 0; i < hold.size; i++) {
            fv += f[i] * v[i];
            gu += g[i] * u[i];
            fu += f[i] * u[i];
        }
        assert_true(fu > 0);
        close_to(fv, gu, 1e-9 * fu, "reciprocity");
        bench_end(&b);
    }
}

/* A chain of elements has the band of two cross-sections, however its nodes are numbered. */
static void test_band(void **state)
{
    struct bench b;
    struct factor factor;
    int bad;
    (void)state;
    bar(&b);
    bool *held = TAKE(b.life, bool, 3 * b.fe.n);
    must(factor_make(&factor, &bad, &b.fe.K, held, 1e6, b.life, &b.report), &b);
    assert_int_equal(bad, -1);
    assert_int_equal(factor.n, 3 * b.fe.n);
    int across = 13 + 6; /* nodes of a face and of the edges behind it */
    assert_true(factor.width < 3 * 2 * across);
    /* (K + s) u = f */
    double *f = TAKE(b.life, double, factor.n), *u = TAKE(b.life, double, factor.n),
           *Ku = TAKE(b.life, double, factor.n);
    for (int i = 0; i < factor.n; i++) f[i] = sin(i);
    factor_solve(u, &factor, f, factor.n);
    sparse_mul(Ku, &b.fe.K, u);
    for (int i = 0; i < factor.n; i++) close_to(Ku[i] + 1e6 * u[i], f[i], 1e-9, "residual");
    bench_end(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_motion),    cmocka_unit_test(test_node), cmocka_unit_test(test_constraint_modes),
        cmocka_unit_test(test_symmetric), cmocka_unit_test(test_band),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
