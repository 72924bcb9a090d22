/* t-crank-rod.c -- the connecting rod of Simeon's slider-crank: its files against quadrature of its shapes, and the
 * same rod with its frame clamped to the section at the pin instead of the chord. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "flex/file.h"
#include "unit/opened.h"

enum { N = 4, POINTS = 4000 };
static const double l = .3, m = .151104, b = .008, E = 2e11, PI = 3.14159265358979323846;

/* Displacement, first and second slopes by s = x/l: lateral of coordinates 0 and 1, axial of 2 and 3. */
static void shapes(double *u, double *u1, double *u2, double s)
{
    for (int k = 0; k < 2; k++) {
        const double p = (k + 1) * PI;
        u[k] = sin(p * s), u1[k] = p * cos(p * s), u2[k] = -p * p * sin(p * s);
    }
    u[2] = 4 * s * (1 - s), u1[2] = 4 - 8 * s, u2[2] = -8;
    u[3] = s * (2 * s - 1), u1[3] = 4 * s - 1, u2[3] = 4;
}

/* By the midpoint rule, as exact as 1/POINTS^2. */
static void check_file(const char *path, double axial, bool stiff)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *o;
    double f[3 * N] = {0}, xf[9 * N] = {0}, ff[9 * N * N] = {0}, K[N * N] = {0}, S[N * N] = {0}, s1[N * N] = {0},
                 xs[N * N] = {0};
    if (flex_file_read(&o, NULL, path, life, &report) != OK) fail_msg("%s", report.text);
    for (int p = 0; p < POINTS; p++) {
        double u[N], u1[N], u2[N], s = (p + .5) / POINTS, x = l * (s - .5), w = m / POINTS;
        shapes(u, u1, u2, s);
        for (int i = 0; i < N; i++) {
            const int a = i < 2;
            f[a + 3 * i] += w * u[i];
            xf[3 * a + 9 * i] += w * x * u[i];
            for (int j = 0; j < N; j++) {
                const int c = j < 2, ij = i + N * j;
                const double scale = a || c ? 1 : axial, EI = E * b * b * b * b / 12;
                ff[a + 3 * c + 9 * ij] += w * u[i] * u[j] * scale;
                if (a == c) K[ij] += (a ? EI * u2[i] * u2[j] / (l * l * l) : E * b * b * u1[i] * u1[j] / l) / POINTS;
                if (!a || !c) continue;
                S[ij] -= .5 * u1[i] * u1[j] / l / POINTS;
                s1[ij] += w * S[ij];
                xs[ij] += w * x * S[ij];
                S[ij] -= .5 * u1[i] * u1[j] / l / POINTS;
            }
        }
    }
    for (int k = 0; k < 3 * N; k++) near(o->f[k], f[k], 2e-6 * (m));
    for (int k = 0; k < 9 * N; k++) near(o->xf[k], xf[k], 2e-6 * (m * l));
    for (int k = 0; k < 9 * N * N; k++) near(o->ff[k], ff[k], 2e-6 * (m));
    for (int k = 0; k < N * N; k++) near(o->K[k], K[k], 2e-6 * (1e5 + fabs(K[k])));
    assert_int_equal(o->s != NULL, stiff);
    for (int k = 0; stiff && k < N * N; k++) {
        near(o->s[3 * k], s1[k], 2e-6 * (m / l));
        near(o->xs[9 * k], xs[k], 2e-6 * (m));
        near(o->node[2].S[3 * k], S[k], 2e-6 * (1 / l));
    }
    near(o->xx[0] + m * l * l / 4, .0045339259, 2e-6 * (.0045));
    arena_close(life);
}

static void test_files(void **state)
{
    (void)state;
    check_file("tests/decks/crank-rod.json", 1, false);
    check_file("tests/decks/crank-rod-stiff.json", 1, true);
    check_file("tests/decks/crank-rod-testset.json", 15, false);
}

/* The rod as a file; with a node of the section before that of the chord, joints take hold of this one. */
static const char *rod(bool section, struct arena *life)
{
    struct report report = {0};
    struct flex_body *o;
    double at[3];
    assert_int_equal(flex_file_read(&o, at, "tests/decks/crank-rod-stiff.json", life, &report), OK);
    if (section) {
        struct flex_node *node = TAKE(life, struct flex_node, 4);
        memcpy(node + 1, o->node, 3 * sizeof *node);
        node[0] = node[1];
        node[0].name = "section";
        node[0].psi = TAKE(life, double, 3 * N);
        node[0].psi[2] = PI / l;
        node[0].psi[5] = 2 * PI / l;
        o->node = node;
        o->nnode = 4;
        o->reference = 1;
    }
    return flex_file_text(o, at, life);
}

#define DECK(speed)                                                                                                    \
    "bodies:\n"                                                                                                        \
    "  crank: {mass: 0.36, inertia: 0.002727, at: [0, 0]}\n"                                                           \
    "  rod: {flexible: body.json, origin: [0.15, 0]}\n"                                                                \
    "  slider: {mass: 0.075552, at: [0.45, 0]}\n"                                                                      \
    "constraints:\n"                                                                                                   \
    "  shaft: {revolute: [ground, crank], at: [0, 0]}\n"                                                               \
    "  elbow: {revolute: [crank, rod], at: [0.15, 0]}\n"                                                               \
    "  wrist: {revolute: [rod, slider], at: [0.45, 0]}\n"                                                              \
    "  rail:  {prismatic: [ground, slider], at: [0.45, 0], axis: [1, 0]}\n"                                            \
    "drives: {motor: {drive: shaft.angle, value: " speed "*t}}\n"                                                      \
    "integrate: {scheme: dopri5, tolerance: 1.0e-10, until: 0.01}\n"

/* Difference of the bending, relative. */
static double differ(const char *deck)
{
    struct opened chord, section;
    struct arena *life = arena_open();
    open_beside(&chord, deck, rod(false, life));
    open_beside(&section, deck, rod(true, life));
    run(&chord);
    run(&section);
    const double q = value(&chord, "rod.mode1"), other = value(&section, "rod.mode1");
    const double turn = PI / l * (q + 2 * value(&chord, "rod.mode2"));
    const double more = value(&section, "elbow.angle") - value(&chord, "elbow.angle");
    print_message("mode 1: %.9g in the chord's frame, %.9g in the section's; angle %.6g more, psi q = %.6g\n", q, other,
                  more, turn);
    near(value(&section, "slider.x"), value(&chord, "slider.x"), 1e-8);
    near(more, turn, 3e-4 * fabs(turn));
    arena_close(chord.life);
    arena_close(section.life);
    arena_close(life);
    return fabs(other / q - 1);
}

/* The same q in another frame, but for what is of third order; the joint's angle is that of the section, psi q more
 * than that of the chord. */
static void test_frames(void **state)
{
    (void)state;
    double fast = differ(DECK("75")), slow = differ(DECK("37.5"));
    assert_true(fast < 3e-4 && slow < fast / 16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
