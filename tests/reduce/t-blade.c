/* t-blade.c -- the blade of decks/airscrew as it is shipped, at 8000 rpm about the screw's axis, against CalculiX on
 * the whole mesh. */
#include <math.h>
#include <string.h>

#include "flex/file.h"
#include "la/dense.h"
#include "la/eigen.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { MOST = 24 };

static const double W2 = 701838.5; /* (8000 rpm)^2 [1/s2] */

/* CalculiX 2.20, root held: omega^2 at rest; at 8000 rpm, CENTRIF about z [1/s2] */
static const double rest[] = {0.3227560E+06, 0.4011610E+07, 0.1373809E+08, 0.2842496E+08, 0.4044894E+08, 0.9968670E+08};
static const double spun[] = {0.1025362E+07, 0.6754585E+07, 0.1585593E+08, 0.3748770E+08, 0.4206461E+08, 0.1172195E+09};

static struct flex_body *blade(double *at, struct arena *life)
{
    struct flex_body *o;
    struct report report = {0};
    if (flex_file_read(&o, at, "decks/airscrew/blade.json", life, &report) != OK) fail_msg("%s", report.text);
    assert_true(o->n <= MOST);
    return o;
}

static void near(double got, double want, double share)
{
    if (!(fabs(got - want) <= share * fabs(want))) fail_msg("%.9g, expected %.9g to %.3g", got, want, share);
}

/* K of the spinning blade: stiffened by the pull outwards, softened by the spin in the plane x, y (CENTRIF's too). */
static void spinning(double *K, const struct flex_body *o, const double *at)
{
    for (int k = 0; k < o->n * o->n; k++) {
        K[k] = o->K[k];
        for (int a = 0; a < 2; a++)
            K[k] -= W2 * (o->xs[4 * a + 9 * k] + o->ff[4 * a + 9 * k] + at[a] * o->s[a + 3 * k]);
    }
}

static void test_frequencies(void **state)
{
    struct arena *life = arena_open();
    double at[3], K[MOST * MOST], M[MOST * MOST], X[MOST * MOST], lambda[MOST];
    struct flex_body *o = blade(at, life);
    (void)state;
    for (int j = 0; j < 6; j++) near(o->K[j + o->n * j], rest[j], 0.02);
    spinning(K, o, at);
    flex_mass(M, o);
    assert_int_equal(eigen_general(lambda, X, K, M, o->n), -1);
    for (int j = 0; j < 6; j++) near(lambda[j], spun[j], 0.01);
    arena_close(life);
}

/* Pull at constant speed, K q = omega^2 int (outwards) phi dm: stress and stretch of the whole mesh (linear). */
static void test_stress(void **state)
{
    struct arena *life = arena_open();
    double at[3], L[MOST * MOST], q[MOST] = {0};
    /* SXX, SYY, SZZ, SXY, SYZ, SZX of nodes 17 and 10 in spin.frd */
    static const double want[2][6] = {{90593000, 22896400, 24852500, 12266900, 6174240, -9452000},
                                      {90593000, 22896400, 24852500, -12266900, 6174240, 9452000}};
    static const int order[6] = {0, 1, 2, 3, 5, 4};
    struct flex_body *o = blade(at, life);
    (void)state;
    for (int j = 0; j < o->n; j++)
        for (int a = 0; a < 2; a++) q[j] += W2 * (at[a] * o->f[a + 3 * j] + o->xf[4 * a + 9 * j]);
    memcpy(L, o->K, (size_t)(o->n * o->n) * sizeof *L);
    assert_int_equal(dense_cholesky(L, o->n, o->n), -1);
    dense_cholesky_solve(L, q, o->n, o->n);
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 6; k++) {
            double s = 0;
            for (int j = 0; j < o->n; j++) s += o->stress[p].tensor[order[k] + 6 * j] * q[j];
            if (!(fabs(s - want[p][k]) < 1e4))
                fail_msg("stress %d of point %d: %.7g, expected %.7g", k, p, s, want[p][k]);
        }
    assert_string_equal(o->stress[0].name, "front");
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_frequencies), cmocka_unit_test(test_stress)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
