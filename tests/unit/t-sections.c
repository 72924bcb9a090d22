/* t-sections.c -- beams whose section tapers, twists or jumps, and their stresses, against quadrature of the statics.
 */
#include "flex/beam.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "unit/rods.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near(double a, double b, double relative)
{
    if (!(fabs(a - b) <= relative * fabs(b))) fail_msg("%.15g is not %.15g to %g", a, b, relative);
}

/* ---- sections that vary ---- */

/* Tip deflection by quadrature of the moment's curvature, force along y: int (L - x)^2 (EI^-1)_yy dx, and _zy. */
static void test_taper_static(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[2], p;
    struct flex_beam o = bar(3, 1, 6, 0, tapered(c, 1.2), 2, BOTH);
    const double F[3] = {0, 100, 0};
    double at[3], u[3], turn[3], q[MOST], y = 0, z = 0;
    enum { CUTS = 2000 };
    (void)state;
    o.nsection = 2;
    struct flex_body *body = made(&o, at, life);
    deflect(u, turn, body, &body->node[1], F, q);
    for (int k = 0; k < CUTS; k++) {
        double x = (k + 0.5) / CUTS, w = (1 - x) * (1 - x) / CUTS * F[1] / o.E, s = sin(1.2 * x), d = cos(1.2 * x);
        p.Iy = c[0].Iy + x * (c[1].Iy - c[0].Iy);
        p.Iz = c[0].Iz + x * (c[1].Iz - c[0].Iz);
        y += w * (d * d / p.Iz + s * s / p.Iy);
        z += w * s * d * (1 / p.Iz - 1 / p.Iy);
    }
    near(u[1], y, 1e-6);
    near(u[2], z, 1e-6);
    arena_close(life);
}

/* Two uniform pieces; the node at the jump is the mesh's own. */
static void test_jump(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[4] = {rectangle(0, 0.02, 0.02), rectangle(0.37, 0.02, 0.02), rectangle(0.37, 0.02, 0.01),
                                rectangle(1, 0.02, 0.01)};
    struct flex_beam o = bar(2, 1, 2, 0, c, 2, BOTH);
    const double F[3] = {50, 10, 0};
    double at[3], u[3], turn[3], q[MOST], rest = 0.63;
    (void)state;
    o.nsection = 4;
    struct flex_body *body = made(&o, at, life);
    deflect(u, turn, body, &body->node[1], F, q);
    near(u[0], F[0] / o.E * (0.37 / c[0].A + rest / c[3].A), 1e-9);
    near(u[1], F[1] / (3 * o.E) * ((1 - pow(rest, 3)) / c[0].Iz + pow(rest, 3) / c[3].Iz), 1e-9);
    near(body->mass, o.density * (0.37 * c[0].A + rest * c[3].A), 1e-13);
    arena_close(life);
}

static void test_taper(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[2];
    double at[3], worst[2];
    (void)state;
    for (int shear = 0; shear < 2; shear++) {
        struct flex_beam o = bar(3, 1, 96, 4, tapered(c, 0.8), 1, ROOT_ONLY);
        o.nsection = 2;
        for (int k = 0; k < 2; k++) c[k].ky = c[k].kz = shear * 5.0 / 6, c[k].rotary = shear;
        const double *fine = made(&o, at, life)->hertz;
        for (int k = 0; k < 2; k++) {
            o.elements = 6 << k;
            worst[k] = error(made(&o, at, life)->hertz, fine, 4);
        }
        assert_true(worst[1] < 1e-3 && worst[0] / worst[1] > (shear ? 7 : 12));
    }
    arena_close(life);
}

/* A twist the same everywhere turns the modes and nothing else. */
static void test_turned(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c = rectangle(0, 0.03, 0.01), t = c;
    struct flex_beam o = bar(3, 1, 8, 6, &c, 1, ROOT_ONLY);
    const double up[3] = {0.2, -sin(0.7), cos(0.7)};
    double at[3];
    struct flex_body *a = made(&o, at, life), *b, *d;
    (void)state;
    t.twist = 0.7;
    o.section = &t;
    b = made(&o, at, life);
    o.section = &c;
    memcpy(o.up, up, sizeof up);
    d = made(&o, at, life);
    for (int j = 0; j < 6; j++) {
        const double *x = a->node[2].phi + 3 * j, *y = b->node[2].phi + 3 * j, *z = d->node[2].phi + 3 * j;
        double turned[3] = {x[0], cos(0.7) * x[1] - sin(0.7) * x[2], sin(0.7) * x[1] + cos(0.7) * x[2]};
        double sign = v3_dot(turned, y) < 0 ? -1 : 1;
        near(b->hertz[j], a->hertz[j], 1e-9);
        for (int k = 0; k < 3; k++) assert_true(fabs(sign * y[k] - turned[k]) < 1e-7);
        for (int k = 0; k < 3; k++) assert_true(fabs(fabs(z[k]) - fabs(turned[k])) < 1e-7);
    }
    arena_close(life);
}

/* ---- stresses ---- */

static void test_stress(void **state)
{
    struct arena *life = arena_open();
    struct flex_section c[2];
    const struct flex_probe probe[] = {{"top", 0, 1, 0}, {"corner", 0.5, -1, 1}, {"core", 0.3, 0, 0}};
    struct flex_beam o = bar(3, 1, 5, 3, tapered(c, 0), 2, BOTH);
    const double F[3] = {1000, 20, 30};
    double at[3], u[3], turn[3], q[MOST];
    (void)state;
    o.nsection = 2;
    o.nprobe = 3;
    o.probe = probe;
    struct flex_body *body = made(&o, at, life);
    deflect(u, turn, body, &body->node[1], F, q);
    for (int k = 0; k < 3; k++) {
        double x = probe[k].station, sum[8] = {0};
        for (int j = 0; j < body->n; j++) {
            sum[0] += q[j] * body->stress[k].axial[j];
            sum[1] += q[j] * body->stress[k].bending[j];
            for (int a = 0; a < 6; a++) sum[2 + a] += q[j] * body->stress[k].tensor[a + 6 * j];
        }
#define AT(x_) (c[0].x_ + x * (c[1].x_ - c[0].x_))
        double bend = -F[1] * (1 - x) * probe[k].y * AT(y) / AT(Iz) - F[2] * (1 - x) * probe[k].z * AT(z) / AT(Iy);
        near(sum[0], F[0] / AT(A), 1e-9);
        if (k < 2)
            near(sum[1], bend, 2e-3);
        else
            assert_true(sum[1] == 0);
        near(sum[2], sum[0] + sum[1], 1e-12);
        for (int a = 1; a < 6; a++) assert_true(sum[2 + a] == 0);
        assert_string_equal(body->stress[k].name, probe[k].name);
    }
    arena_close(life);
}

/* A pull that grows along the beam, as by its weight: exact for a uniform one, with a mass on it too; in an element
 * between two masses it is that of the middle. */
static void test_pull(void **state)
{
    const struct flex_probe probe[] = {{"root", 0, 0, 0}, {"below", 0.3, 0, 0}, {"above", 0.5, 0, 0}, {"end", 1, 0, 0}};
    const struct flex_lump lump[] = {{0.5, 3, {0}}, {0.25, 3, {0}}};
    struct flex_section c = rectangle(0, 0.02, 0.01);
    (void)state;
    for (int space = 2; space <= 3; space++)
        for (int nlump = 0; nlump <= 2; nlump++) {
            struct arena *life = arena_open();
            struct flex_beam o = bar(space, 1, 4, space == 2 ? 12 : 24, &c, 1, ROOT_ONLY);
            double at[3], weight = o.density * c.A;
            o.nlump = nlump;
            o.lump = lump;
            o.nprobe = 4;
            o.probe = probe;
            struct flex_body *body = made(&o, at, life);
            for (int k = 0; k < 4; k++) {
                double x = probe[k].station, sum = 0;
                for (int j = 0; j < body->n; j++)
                    sum += body->f[3 * j] / body->K[j + body->n * j] * body->stress[k].axial[j];
                double from = nlump < 2 ? x : x < 0.25 ? 0.125 : x < 0.5 ? 0.375 : x;
                double pull = weight * (1 - from);
                for (int m = 0; m < nlump; m++) pull += x < lump[m].station ? lump[m].mass : 0;
                if (!(fabs(sum - pull / c.A) < 1e-7 * weight / c.A))
                    fail_msg("space %d, %d masses, %s: %.12g, not %.12g", space, nlump, probe[k].name, sum, pull / c.A);
            }
            arena_close(life);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_taper_static), cmocka_unit_test(test_jump),   cmocka_unit_test(test_taper),
        cmocka_unit_test(test_turned),       cmocka_unit_test(test_stress), cmocka_unit_test(test_pull),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
