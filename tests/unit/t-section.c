/* t-section.c -- cross-sections: shear stresses against what defines them (equilibrium inside and on the edges, the
 * twist, their resultants) and tables; tapered shapes; what stands in a beam's records */
#include <math.h>
#include <stdio.h>

#include "flex/section.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "opened.h"

static const double PI = 3.14159265358979323846, NU = 0.3;

enum { FORCE_Y, FORCE_Z, TORQUE };

struct edge {
    double y, z, n[2];
};

static void shear(double *o, const struct flex_section *c, int by, double y, double z)
{
    double T[6];
    section_shear(T, c, y, z, NU);
    o[0] = T[2 * by];
    o[1] = T[2 * by + 1];
}

/* div tau = -V x/I, 0 by torque; curl tau = 2/J by torque, of a round section by force -nu/(1 + nu) V/I times across.
 */
static void check_inside(const struct flex_section *c, int by, double y, double z)
{
    const double h = 1e-5 * c->y;
    double a[2], b[2], d[2], e[2];
    shear(a, c, by, y - h, z);
    shear(b, c, by, y + h, z);
    shear(d, c, by, y, z - h);
    shear(e, c, by, y, z + h);
    const double div = (b[0] - a[0] + e[1] - d[1]) / (2 * h), curl = (b[1] - a[1] - e[0] + d[0]) / (2 * h);
    const double unit = by == TORQUE ? 2 / c->J : c->y / c->Iz + c->z / c->Iy;
    near(div, by == FORCE_Y ? -y / c->Iz : by == FORCE_Z ? -z / c->Iy : 0, 1e-5 * unit);
    if (by == TORQUE)
        near(curl, 2 / c->J, 1e-5 * unit);
    else if (c->shape == SHAPE_ROUND)
        near(curl, NU / (1 + NU) * (by == FORCE_Y ? -z : y) / c->Iz, 1e-5 * unit);
}

static void check_edge(const struct flex_section *c, int by, const struct edge *e)
{
    double t[2];
    const double unit = by == TORQUE ? c->y / c->J : 1 / c->A;
    shear(t, c, by, e->y, e->z);
    near(t[0] * e->n[0] + t[1] * e->n[1], 0, 3e-3 * unit);
}

/* Sums over small squares. */
static void check_resultants(const struct flex_section *c, int by)
{
    enum { N = 200 };
    const double dy = 2 * c->y / N, dz = 2 * c->z / N;
    double sum[3] = {0, 0, 0};
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double y = (i + .5) * dy - c->y, z = (j + .5) * dz - c->z, r = hypot(y, z);
            double t[2];
            if (c->shape == SHAPE_ROUND && (r > c->size[0] || r < c->size[1])) continue;
            shear(t, c, by, y, z);
            sum[0] += t[0] * dy * dz;
            sum[1] += t[1] * dy * dz;
            sum[2] += (y * t[1] - z * t[0]) * dy * dz;
        }
    for (int k = 0; k < 3; k++) {
        const double unit = (by == TORQUE) == (k == 2) ? 1 : by == TORQUE ? 1 / c->y : c->y;
        near(sum[k], k == by, 5e-3 * unit);
    }
}

static void test_rectangle(void **state)
{
    static const double sides[][2] = {{0.02, 0.05}, {0.05, 0.02}, {0.03, 0.03}, {0.1, 0.004}};
    (void)state;
    for (int k = 0; k < 4; k++) {
        struct flex_section c = {0};
        section_rectangle(&c, sides[k][0], sides[k][1], NU);
        for (int by = 0; by < 3; by++) {
            for (double y = -.9; y < 1; y += .3)
                for (double z = -.8; z < 1; z += .2) check_inside(&c, by, y * c.y, z * c.z);
            for (double s = -1; s < 1.01; s += .25) {
                check_edge(&c, by, &(struct edge){c.y, s * c.z, {1, 0}});
                check_edge(&c, by, &(struct edge){s * c.y, -c.z, {0, 1}});
            }
            check_resultants(&c, by);
        }
    }
}

static void test_round(void **state)
{
    static const double radii[][2] = {{0.02, 0}, {0.03, 0.01}, {0.05, 0.047}};
    (void)state;
    for (int k = 0; k < 3; k++) {
        struct flex_section c = {0};
        const double R = radii[k][0], S = radii[k][1];
        section_round(&c, R, S, NU);
        for (int by = 0; by < 3; by++) {
            for (double phi = 0; phi < 2 * PI; phi += .3) {
                const double n[2] = {cos(phi), sin(phi)};
                for (double r = S + .1 * (R - S); r < R; r += .2 * (R - S)) check_inside(&c, by, r * n[0], r * n[1]);
                check_edge(&c, by, &(struct edge){R * n[0], R * n[1], {n[0], n[1]}});
                if (S > 0) check_edge(&c, by, &(struct edge){S * n[0], S * n[1], {n[0], n[1]}});
            }
            check_resultants(&c, by);
        }
    }
}

/* Timoshenko & Goodier's k2 in max tau = T/(k2 a b^2), amid the long sides. */
static void test_table(void **state)
{
    static const double table[][2] = {{1, .208}, {1.5, .231}, {2, .246}, {3, .267}, {5, .291}, {10, .312}};
    (void)state;
    for (int k = 0; k < 6; k++) {
        struct flex_section c = {0};
        double t[2], b = 0.01, a = table[k][0] * b;
        section_rectangle(&c, a, b, NU);
        shear(t, &c, TORQUE, 0, b / 2);
        near(-1 / (t[0] * a * b * b), table[k][1], 6e-4);
    }
}

/* Shapes shrink by their sizes, numbers by themselves, a rectangle into a circle by numbers. */
static void test_between(void **state)
{
    struct flex_section a = {.station = 0}, b = {.station = 1, .twist = .4}, c, want = {0};
    (void)state;
    section_rectangle(&a, 0.1, 0.04, NU);
    section_rectangle(&b, 0.05, 0.01, NU);
    section_between(&c, &a, &b, .5);
    section_rectangle(&want, 0.075, 0.025, NU);
    near(c.station, .5, 1e-15);
    near(c.twist, .2, 1e-15);
    near(c.A, want.A, 1e-15 * want.A);
    near(c.Iy, want.Iy, 1e-14 * want.Iy);
    near(c.Iz, want.Iz, 1e-14 * want.Iz);
    near(c.J, want.J, 1e-14 * want.J);
    section_round(&a, 0.04, 0.03, NU);
    section_round(&b, 0.02, 0.01, NU);
    section_between(&c, &a, &b, .25);
    section_round(&want, 0.035, 0.025, NU);
    near(c.A, want.A, 1e-14 * want.A);
    near(c.Iy, want.Iy, 1e-14 * want.Iy);
    section_rectangle(&b, 0.05, 0.01, NU);
    section_between(&c, &a, &b, .25);
    assert_int_equal(c.shape, SHAPE_NUMBERS);
    near(c.A, .75 * a.A + .25 * b.A, 1e-14 * a.A);
    near(c.J, .75 * a.J + .25 * b.J, 1e-14 * a.J);
}

/* ---- in decks ---- */

/* A blade whose rectangles shrink, against finite elements of another kind (two nodes, strains at one point, lumped
 * mass, 40 and 80 of them extrapolated) [Hz]. */
static void test_taper(void **state)
{
    static const double want[] = {23.227298, 74.739255, 84.312787, 198.586495};
    static const char text[] =
        "bodies:\n"
        "  blade:\n"
        "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 20}\n"
        "    sections: [{station: 0, rectangle: [0.06, 0.02]}, {station: 1, rectangle: [0.03, 0.006]}]\n"
        "    material: steel\n"
        "constraints: {clamp: {fixed: [ground, blade], at: [0, 0, 0]}}\n"
        "integrate: {scheme: midpoint, step: 1.0e-6, until: 1.0e-6}\n";
    struct opened o;
    (void)state;
    open_deck(&o, text);
    const struct flex_body *blade = o.scene->body[1].flex;
    for (int k = 0; k < 4; k++) near(blade->hertz[k], want[k], 5e-5 * want[k]);
    arena_close(o.life);
}

/* A tube under a pull, a transverse force and a torque at its end: the textbook's equivalent stress. */
static void test_shaft(void **state)
{
    static const char text[] = "bodies:\n"
                               "  a:\n"
                               "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 4}\n"
                               "    section: {tube: [0.02, 0.016]}\n"
                               "    material: steel\n"
                               "    points: {tip: {station: 1, static: true}}\n"
                               "    stress: {top: {station: 0.25, corner: top}, side: {station: 0.25, corner: left}}\n"
                               "constraints: {clamp: {fixed: [ground, a], at: [0, 0, 0]}}\n"
                               "forces:\n"
                               "  f: {force: a.tip, value: [3, 0, 0.2]}\n"
                               "  m: {torque: a.tip, value: [0.5, 0, 0]}\n"
                               "initial: {static: true}\n"
                               "integrate: {scheme: midpoint, step: 1.0e-6, until: 1.0e-6}\n";
    const double I = PI * (pow(.02, 4) - pow(.016, 4)) / 4, A = PI * (4e-4 - 2.56e-4);
    const double tau = .5 * .02 / (2 * I), normal = 3 / A - .2 * .75 * .02 / I;
    struct opened o;
    (void)state;
    open_deck(&o, text);
    near(value(&o, "a.top.xy"), -tau, 1e-4 * tau);
    near(value(&o, "a.top.xz"), 0, 1e-6 * tau);
    near(value(&o, "a.top.von_mises"), sqrt(normal * normal + 3 * tau * tau), 1e-4 * fabs(normal));
    near(value(&o, "a.side.bending"), 0, 1e-4 * fabs(normal));
    /* by the force 1.831 V/A outside, 2.169 V/A inside; mean of the wall V Q/(I b) = 1.984 V/A */
    near(value(&o, "a.side.xz"), tau + 1.831 * .2 / A, 1e-3 * .2 / A + 1e-4 * tau);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rectangle), cmocka_unit_test(test_round), cmocka_unit_test(test_table),
        cmocka_unit_test(test_between),   cmocka_unit_test(test_taper), cmocka_unit_test(test_shaft),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
