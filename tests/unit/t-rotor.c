/* t-rotor.c -- shafts and blades whose sections and disks turn with them: gyroscopic moments, the propeller moment.
 *
 * A disk at the end of a shaft without mass, clamped to a hub that turns at W about the shaft: with r, phi complex
 * displacement and slope of the tip in fixed axes, both as exp(i w t),
 *
 *     (12 EI/L^3 - m w^2) (4 EI/L - Id w^2 + Ip W w) - (6 EI/L^2)^2 = 0
 *
 * (Stodola, Dampf- und Gasturbinen, 1924); seen from the shaft these are whirls of w - W. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "opened.h"
#include "probe/modes.h"

static const double PI = 3.14159265358979323846;

static void find_modes(struct modes *modes, struct opened *o, const char *text)
{
    open_deck(o, text);
    assert_int_equal(modes_find(modes, &o->sim, o->life, &o->report), OK);
}

/* The least relative distance of w from a frequency of the modes, as seen from the shaft. */
static double nearest(const struct modes *modes, double w)
{
    double least = INFINITY;
    for (int j = 0; j < modes->n; j++) least = fmin(least, fabs(modes->mode[j].omega / w - 1));
    return least;
}

/* ---- a disk on a shaft ---- */

static const double EI = 2.1e11 * 3.14159265358979323846 * 1e-8 / 4, LENGTH = 0.5, MASS = 5, ID = 0.02;

static double stodola(double w, double W, double Ip)
{
    const double k = EI / LENGTH, L = LENGTH;
    return (12 * k / (L * L) - MASS * w * w) * (4 * k - ID * w * w + Ip * W * w) - 36 * k * k / (L * L);
}

static double root(double a, double b, double W, double Ip)
{
    for (int i = 0; i < 200; i++) {
        const double c = (a + b) / 2;
        *(stodola(a, W, Ip) * stodola(c, W, Ip) > 0 ? &a : &b) = c;
    }
    return (a + b) / 2;
}

static void check_disk(double W, double Ip)
{
    char text[1000];
    struct opened o;
    struct modes modes;
    int found = 0;
    snprintf(text, sizeof text,
             "bodies:\n"
             "  hub: {mass: 1, inertia: [0.01, 0.01, 0.01], at: [0, 0, 0]}\n"
             "  shaft:\n"
             "    beam: {from: [0, 0, 0], to: [0.5, 0, 0], elements: 4}\n"
             "    section: {circle: 0.01}\n"
             "    material: {E: 2.1e+11, nu: 0.3, density: 1.0e-3}\n"
             "    modes: 6\n"
             "    masses: {disk: {station: 1, mass: 5, inertia: [%g, 0.02, 0.02]}}\n"
             "constraints:\n"
             "  bearing: {revolute: [ground, hub], at: [0, 0, 0], axis: [1, 0, 0]}\n"
             "  clamp: {fixed: [hub, shaft], at: [0, 0, 0]}\n"
             "drives: {spin: {drive: bearing.angle, value: %g*t}}\n"
             "effects: {out_of_plane: true}\n"
             "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.01}\n",
             Ip, W);
    find_modes(&modes, &o, text);
    for (double w = -2500; w < 2500; w += 1) {
        if (stodola(w, W, Ip) * stodola(w + 1, W, Ip) > 0) continue;
        near(nearest(&modes, fabs(root(w, w + 1, W, Ip) - W)), 0, 1e-5);
        found++;
    }
    assert_int_equal(found, 4);
    arena_close(o.life);
}

static void test_disk(void **state)
{
    static const double speed[] = {0, 25, 50, 80, 100, 300}, polar[] = {0.02, 0.03, 0.04};
    (void)state;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 3; j++) check_disk(speed[i], polar[j]);
}

/* ---- a disk amid a shaft ----
 *
 * Between a universal joint, which turns it, and a ball joint, translation and tilt go apart:
 *
 *     w^2 = 48 EI/(m L^3),   12 EI/L - Id w^2 + Ip W w = 0. */

static void check_amid(double W)
{
    const double Id = 0.03, Ip = 0.055;
    const double side = sqrt(48 * EI / 8), half = Ip * W / (2 * Id), turn = sqrt(half * half + 12 * EI / Id);
    const double whirl[] = {side, -side, half + turn, half - turn};
    char text[1000];
    struct opened o;
    struct modes modes;
    snprintf(text, sizeof text,
             "bodies:\n"
             "  hub: {mass: 1, inertia: [0.01, 0.01, 0.01], at: [0, 0, 0]}\n"
             "  shaft:\n"
             "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 8}\n"
             "    section: {circle: 0.01}\n"
             "    material: {E: 2.1e+11, nu: 0.3, density: 0.5}\n"
             "    modes: 8\n"
             "    masses: {disk: {station: 0.5, mass: 8, inertia: [0.055, 0.03, 0.03]}}\n"
             "constraints:\n"
             "  turn: {revolute: [ground, hub], at: [0, 0, 0], axis: [1, 0, 0]}\n"
             "  left: {universal: [hub, shaft], at: [0, 0, 0], axis: [0, 1, 0], axis2: [0, 0, 1]}\n"
             "  right: {spherical: [ground, shaft], at: [1, 0, 0], loop: true}\n"
             "drives: {spin: {drive: turn.angle, value: %g*t}}\n"
             "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.01}\n",
             W);
    find_modes(&modes, &o, text);
    for (int i = 0; i < 4; i++) near(nearest(&modes, fabs(whirl[i] - W)), 0, 2e-4);
    arena_close(o.life);
}

static void test_amid(void **state)
{
    (void)state;
    for (double W = 0; W < 300; W += 70) check_amid(W);
}

/* ---- the propeller moment ----
 *
 * Uniform sections that twist by theta(x) on a blade turning about z: 2 T = rho int (Iy + Iz) theta'^2 + W^2 (Iz cos^2
 * theta + Iy sin^2 theta) dx, so that all torsional frequencies go as w^2 = w0^2 + W^2 (Iz - Iy)/(Iz + Iy). */
static void test_propeller(void **state)
{
    const double b = 0.2, h = 0.02, polar = (b * b - h * h) / (b * b + h * h), GJ = 8e10 * 5e-7;
    const double unit = sqrt(GJ / (7850 * (b * h * h * h + h * b * b * b) / 12));
    (void)state;
    for (double W = 0; W < 400; W += 130) {
        char text[1000];
        struct opened o;
        struct modes modes;
        snprintf(text, sizeof text,
                 "bodies:\n"
                 "  hub: {mass: 1, inertia: [1, 1, 1], at: [0, 0, 0]}\n"
                 "  blade:\n"
                 "    beam: {from: [0, 0, 0], to: [2, 0, 0], elements: 16}\n"
                 "    section: {area: %.17g, Iz: %.17g, Iy: %.17g, J: 5.0e-7}\n"
                 "    material: {E: 2.1e+11, G: 8.0e+10, density: 7850}\n"
                 "    modes: 24\n"
                 "constraints:\n"
                 "  bearing: {revolute: [ground, hub], at: [0, 0, 0], axis: [0, 0, 1]}\n"
                 "  clamp: {fixed: [hub, blade], at: [0, 0, 0]}\n"
                 "drives: {spin: {drive: bearing.angle, value: %g*t}}\n"
                 "effects: {out_of_plane: true}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.01}\n",
                 b * h, h * b * b * b / 12, b * h * h * h / 12, W);
        find_modes(&modes, &o, text);
        for (int k = 1; k < 6; k += 2) {
            const double w0 = k * PI / 4 * unit;
            near(nearest(&modes, sqrt(w0 * w0 + W * W * polar)), 0, 1.1e-3 * k * k);
        }
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disk),
        cmocka_unit_test(test_amid),
        cmocka_unit_test(test_propeller),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
