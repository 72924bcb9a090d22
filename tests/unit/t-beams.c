/* t-beams.c -- beams from the deck to the model: sections, centres of mass, nodes at every place in use, the numbers
 * of elastic coordinates, loops through flexible bodies */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "la/vec3.h"
#include "model/build.h"
#include "scene_flex/flexible.h"
#include "sim/load.h"

#include <cmocka.h>

struct opened {
    struct arena *life;
    struct scene *scene;
    struct model *model;
};

static void open_deck(struct opened *o, const char *text, const char *partition)
{
    char path[] = "/tmp/t-beams-XXXXXX";
    int fd = mkstemp(path);
    FILE *f = fdopen(fd, "w");
    assert_non_null(f);
    fprintf(f, "fmdsub: 1\n%s\npartition: {%s}\nintegrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n", text,
            partition);
    fclose(f);
    o->life = arena_open();
    struct report report = {0};
    struct diags *diags = diags_open(o->life);
    enum status status = sim_load(&o->scene, path, NULL, diags, o->life, &report);
    if (status == OK) status = model_build(&o->model, o->scene, NULL, diags, o->life);
    if (status != OK) diags_print(stderr, diags, false);
    assert_int_equal(status, OK);
    unlink(path);
}

/* Timoshenko & Goodier's table of k1 in J = k1 a b^3. */
static void test_torsion(void **state)
{
    static const double table[][2] = {{1, .1406}, {1.2, .166}, {1.5, .196}, {2, .229}, {2.5, .249},
                                      {3, .263},  {4, .281},   {5, .291},   {10, .312}};
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        double r = table[i][0];
        assert_true(fabs(rectangle_torsion(r * 0.3, 0.3) / (r * pow(0.3, 4)) - table[i][1]) < 6e-4);
        assert_true(fabs(rectangle_torsion(0.3, r * 0.3) - rectangle_torsion(r * 0.3, 0.3)) < 1e-15);
    }
}

/* Moments of sections by sums over small squares, in their axes y, z. */
static void sum_section(double *o, double half_y, double half_z, double outer, double inner)
{
    enum { N = 800 };
    double dy = 2 * half_y / N, dz = 2 * half_z / N;
    memset(o, 0, 3 * sizeof *o);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double y = (i + .5) * dy - half_y, z = (j + .5) * dz - half_z, r = hypot(y, z);
            if (outer > 0 && (r > outer || r < inner)) continue;
            o[0] += dy * dz;
            o[1] += z * z * dy * dz;
            o[2] += y * y * dy * dz;
        }
}

static void test_sections(void **state)
{
    static const struct {
        const char *section;
        double y, z, outer, inner;
    } cases[] = {{"{rectangle: [0.04, 0.1]}", .02, .05, 0, 0},
                 {"{circle: 0.03}", .03, .03, .03, 0},
                 {"{tube: [0.03, 0.02]}", .03, .03, .03, .02}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct flex_section s;
        double sum[3];
        char text[400];
        struct opened o;
        snprintf(text, sizeof text,
                 "bodies: {arm: {beam: {from: [0, 0, 0], to: [2, 0, 0], shear: true, elements: 4}, section: %s, "
                 "material: steel, modes: 1}}\nconstraints: {clamp: {fixed: [ground, arm], at: [0, 0, 0]}}",
                 cases[i].section);
        open_deck(&o, text, "");
        sum_section(sum, cases[i].y, cases[i].z, cases[i].outer, cases[i].inner);
        /* as particles of the whole: int y2 dm = rho L Iz, int z2 dm = rho L Iy */
        const struct flex_body *f = o.scene->body[1].flex;
        double rho_L = 7850 * 2;
        s = (struct flex_section){.A = f->mass / rho_L, .Iy = f->xx[8] / rho_L, .Iz = f->xx[4] / rho_L};
        assert_true(fabs(s.A / sum[0] - 1) < 2e-3);
        assert_true(fabs(s.Iy / sum[1] - 1) < 2e-3);
        assert_true(fabs(s.Iz / sum[2] - 1) < 2e-3);
        arena_close(o.life);
    }
}

/* The centre of mass known before the beam is made is that of its finite elements. */
static void test_centre(void **state)
{
    struct opened o;
    (void)state;
    open_deck(
        &o,
        "bodies:\n"
        "  arm:\n"
        "    beam: {from: [1, 2, 0], to: [1, 5, 4], elements: 8}\n"
        "    sections: [{station: 0, circle: 0.05}, {station: 0.25, circle: 0.02}, {station: 1, tube: [0.03, 0.02]}]\n"
        "    material: {E: 7.0e+10, G: 3.0e+10, density: 2700}\n"
        "    masses: {tip: {station: 1, mass: 2, inertia: [0.1, 0.2, 0.2]}, mid: {station: 0.4, mass: 0.5}}\n"
        "    points: {tip: {station: 1, offset: [0, 0, 0.01]}}\n"
        "constraints: {clamp: {fixed: [ground, arm], at: [1, 2, 0]}}",
        "");
    const struct scene_body *b = &o.scene->body[1];
    for (int i = 0; i < 3; i++) assert_true(fabs(b->at[i] - b->origin[i]) < 1e-12);
    double A[3] = {M_PI * .0025, M_PI * .0004, M_PI * .0005};
    double m = 2700 * 5 * (.25 * (A[0] + A[1]) / 2 + .75 * (A[1] + A[2]) / 2) + 2.5;
    assert_true(fabs(b->mass / m - 1) < 1e-12);
    /* x along the beam, z up: at right angles in the plane of both */
    assert_true(fabs(b->R[1] - .6) < 1e-15 && fabs(b->R[2] - .8) < 1e-15);
    assert_true(fabs(b->R[7] + .8) < 1e-15 && fabs(b->R[8] - .6) < 1e-15);
    double tip[3];
    marker_drawn(tip, o.scene, &o.scene->point[0].at);
    assert_true(fabs(tip[0] - 1) + fabs(tip[1] - 5 + .008) + fabs(tip[2] - 4 - .006) < 1e-12);
    arena_close(o.life);
}

static const char hanging[] =
    "bodies:\n"
    "  arm:\n"
    "    beam: {from: [0, 0], to: [3, 4], elements: 5}\n"
    "    section: {rectangle: [0.02, 0.01]}\n"
    "    material: aluminium\n"
    "    modes: 4\n"
    "    points: {tip: {station: 1}, side: {station: 0.3, offset: [0, 0.1]}, root: [-2.5, 0]}\n"
    "  load: {mass: 1, inertia: 0.1, at: [3, 5]}\n"
    "  bob: {mass: 1, inertia: 0.1, at: [1.5, 1]}\n"
    "constraints:\n"
    "  end: {revolute: [arm, load], at: arm.tip}\n"
    "  mid: {revolute: [arm, bob], at: [1.5, 2]}\n"
    "  hub: {revolute: [arm, ground], at: [0, 0]}\n"
    "measures: {gap: {distance: [arm.side, load]}, turn: {angle: [load, arm]}}\n"
    "forces: {push: {force: arm.tip, value: [0, 1]},\n"
    "         hold: {bushing: [ground, arm], at: [0.6, 0.8], stiffness: [1, 1]}}\n";

static void same_place(const struct opened *o, const struct marker *from, int body, const double *p)
{
    double want[3], arm[3], got[3];
    marker_drawn(want, o->scene, from);
    m3_mul(arm, o->model->body[body].R, p);
    v3_sum(got, o->model->body[body].at, arm);
    for (int i = 0; i < 3; i++) assert_true(fabs(got[i] - want[i]) < 1e-12);
}

/* Every place is where it was drawn, on a node that is no farther from it than the section; the frame does not move at
 * the inboard joint, although the deck's first joint is another. */
static void test_nodes(void **state)
{
    struct opened o;
    (void)state;
    open_deck(&o, hanging, "");
    const struct model *m = o.model;
    const struct scene *s = o.scene;
    const int arm = m->body_of[1];
    const struct model_body *b = &m->body[arm];
    const struct flex_node *frame = &b->flex->node[b->flex->reference];
    assert_int_equal(b->parent, 0);
    assert_int_equal(s->body[1].flex->reference, b->flex->reference); /* the beam is made with it */
    assert_int_equal(b->nmode, 4 + 2 * 3);
    assert_true(fabs(frame->x[0] + 2.5) < 1e-9 && fabs(frame->x[1]) < 1e-9);
    for (int k = 0; k < 3 * b->nmode; k++) assert_true(frame->phi[k] == 0 && frame->psi[k] == 0);
    for (int i = 0; i < m->npoint; i++) {
        same_place(&o, &s->point[i].at, m->point[i].body, m->point[i].p);
        assert_int_equal(m->point[i].frame, arm);
        double drawn[3];
        v3_copy(drawn, s->point[i].at.p);
        for (int k = 0; k < 3; k++) assert_true(fabs(m->point[i].drawn[k] - drawn[k]) < 1e-12);
    }
    assert_int_equal(m->point[2].body, arm); /* root: stands on the frame itself */
    assert_true(fabs(m->point[1].p[1] - .1) < 1e-12 && fabs(m->point[1].p[0]) < 1e-9);
    same_place(&o, &s->measure[0].a, m->measure[0].a.body, m->measure[0].a.p);
    same_place(&o, &s->measure[0].b, m->measure[0].b.body, m->measure[0].b.p);
    assert_true(m->body[m->measure[1].b.body].at_node);
    for (int i = 0; i < 2; i++) same_place(&o, &s->force[i].b, m->force[i].b.body, m->force[i].b.p);
    assert_int_equal(m->force[0].b.body, m->point[0].body);
    assert_int_equal(m->body[m->body_of[2]].parent, m->point[0].body);
    int held = 0;
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &m->joint[m->body[i].joint];
        assert_true(m->body[i].joint == i - 1 && j->child == i && j->parent == m->body[i].parent && j->parent < i);
        double d[3];
        v3_diff(d, m->body[i].at, b->at);
        held += m->body[i].at_node;
        if (m->body[i].at_node) assert_true(fabs(d[0] * b->R[3] + d[1] * b->R[4]) < 1e-9);
    }
    assert_int_equal(held, 4); /* tip, side, mid, which is the centre of mass, too, and where the bushing holds */
    arena_close(o.life);
}

/* Numbers are a permutation, fast ones first; {modes: arm, above: f} takes those above f. */
static void test_numbers(void **state)
{
    static const char *const partitions[] = {"", "fast: [arm]", "fast: [arm.mode3, end]",
                                             "fast: [{modes: arm, above: 5}]", "fast: [mid, {modes: arm, above: 0.1}]"};
    (void)state;
    for (int c = 0; c < 5; c++) {
        struct opened o;
        open_deck(&o, hanging, partitions[c]);
        const struct model *m = o.model;
        const struct model_body *b = &m->body[m->body_of[1]];
        const double *hertz = o.scene->body[1].flex->hertz;
        bool seen[32] = {false};
        int fast = c == 2 || c == 4;
        assert_true(m->n == 13 && m->nq == 13);
        for (int i = 0; i < m->njoint; i++)
            for (int k = 0; k < m->joint[i].nv; k++) seen[m->joint[i].iv[k]] = true;
        for (int k = 0; k < b->nmode; k++) {
            char name[20];
            snprintf(name, sizeof name, "arm.mode%d", k + 1);
            bool is_fast = c == 1 || (c == 2 && k == 2) || (c == 3 && hertz[k] > 5) || (c == 4 && hertz[k] > .1);
            fast += is_fast;
            assert_false(seen[b->mode_v[k]]);
            seen[b->mode_v[k]] = true;
            assert_int_equal(b->mode_v[k], b->mode_q[k]);
            assert_int_equal(b->mode_v[k] < m->ns, is_fast);
            assert_string_equal(m->coordinate[b->mode_q[k]].name, name);
            assert_int_equal(m->coordinate[b->mode_q[k]].fast, is_fast);
        }
        for (int k = 0; k < 13; k++) assert_true(seen[k]);
        assert_int_equal(m->ns, fast);
        assert_int_equal(b->fast, c != 0);
        for (int i = 1; c && i < m->nbody; i++)
            if (m->body[i].at_node) assert_true(m->body[i].fast);
        assert_true(m->near >= m->ns && (c == 0 || m->near == m->n));
        arena_close(o.life);
    }
}

/* A beam in segments weighs what it weighs whole, and so does every part of it that sections bound. */
static void test_segments(void **state)
{
    static const char deck[] = "bodies:\n"
                               "  arm:\n"
                               "    beam: {from: [1, 0, 0], to: [1, 4, 3], elements: 12}\n"
                               "    sections: [{station: 0, circle: 0.05}, {station: 0.3, circle: 0.03}, "
                               "{station: 1, tube: [0.03, 0.02], twist: 0.3}]\n"
                               "    material: steel\n"
                               "    modes: 2\n"
                               "    segments: %d\n"
                               "    masses: {a: {station: 0.5, mass: 3}, b: {station: 0, mass: 1}}\n"
                               "    stress: {s: {station: 0.5}}\n"
                               "    points: {root: {station: 0}, half: {station: 0.5}, tip: {station: 1}}\n"
                               "constraints: {clamp: {fixed: [ground, arm%s], at: [1, 0, 0]}}";
    struct opened whole, cut;
    char text[1000];
    (void)state;
    snprintf(text, sizeof text, deck, 1, "");
    open_deck(&whole, text, "");
    snprintf(text, sizeof text, deck, 4, "1");
    open_deck(&cut, text, "");
    const struct scene *s = cut.scene;
    double mass = 0, moment[3] = {0, 0, 0};
    assert_true(s->nbody == 5 && s->njoint == 4 && s->npoint == 3);
    for (int i = 1; i < s->nbody; i++) {
        char name[20];
        snprintf(name, sizeof name, "arm%d", i);
        assert_string_equal(s->body[i].name, name);
        mass += s->body[i].mass;
        v3_axpy(moment, s->body[i].mass, s->body[i].at);
        for (int k = 0; k < 3; k++) assert_true(fabs(s->body[i].at[k] - s->body[i].origin[k]) < 1e-9);
        assert_int_equal(s->body[i].flex->nstress, i == 2);
    }
    assert_true(fabs(mass - whole.scene->body[1].mass) < 1e-9 * mass);
    for (int k = 0; k < 3; k++) assert_true(fabs(moment[k] / mass - whole.scene->body[1].at[k]) < 1e-9);
    static const int on[] = {1, 2, 4};
    for (int i = 0; i < 3; i++) {
        double x[3], y[3];
        marker_drawn(x, s, &s->point[i].at);
        marker_drawn(y, whole.scene, &whole.scene->point[i].at);
        assert_int_equal(s->point[i].at.body, on[i]);
        assert_string_equal(s->point[i].name, whole.scene->point[i].name);
        for (int k = 0; k < 3; k++) assert_true(fabs(x[k] - y[k]) < 1e-12);
    }
    for (int i = 1; i < s->njoint; i++) {
        char name[20];
        snprintf(name, sizeof name, "arm_%d", i);
        assert_string_equal(s->joint[i].name, name);
        assert_true(s->joint[i].first == i && s->joint[i].second == i + 1);
        assert_true(fabs(s->joint[i].at[1] - i) < 1e-12 && fabs(s->joint[i].at[2] - .75 * i) < 1e-12);
    }
    arena_close(whole.life);
    arena_close(cut.life);
}

static const char linkage[] = "bodies:\n"
                              "  crank: {mass: 1, inertia: 0.1, at: [0, 0.5]}\n"
                              "  rod:\n"
                              "    beam: {from: [0, 1], to: [3, 1]}\n"
                              "    section: {circle: 0.01}\n"
                              "    material: steel\n"
                              "    modes: 2\n"
                              "  rocker: {mass: 1, inertia: 0.1, at: [3, 0.5]}\n"
                              "  tail:\n"
                              "    beam: {from: [3, 1], to: [5, 1]}\n"
                              "    section: {circle: 0.01}\n"
                              "    material: steel\n"
                              "    modes: 2\n"
                              "constraints:\n"
                              "  a: {revolute: [ground, crank], at: [0, 0]}\n"
                              "  b: {revolute: [crank, rod], at: [0, 1]}\n"
                              "  c: {revolute: [rod, rocker], at: [3, 1]}\n"
                              "  d: {revolute: [rocker, ground], at: [3, 0], loop: true}\n"
                              "  e: {fixed: [rocker, tail], at: [3, 1]}\n";

/* A loop ties the elastic coordinates of what it passes through, not those of what hangs on it. */
static void test_loops(void **state)
{
    (void)state;
    for (int c = 0; c < 3; c++) {
        struct opened o;
        open_deck(&o, linkage, c == 0 ? "" : c == 1 ? "fast: [rod.mode1]" : "fast: [tail]");
        const struct model *m = o.model;
        const struct model_body *rod = &m->body[m->body_of[2]], *tail = &m->body[m->body_of[4]];
        assert_true(m->nloop == 1 && m->ncomponent == 1);
        assert_int_equal(rod->component, 0);
        assert_int_equal(tail->component, -1);
        assert_int_equal(m->body[m->body_of[1]].fast, c == 1); /* the whole loop is fast with one of its modes */
        assert_int_equal(rod->fast, c == 1);
        assert_int_equal(tail->fast, c != 0);
        assert_int_equal(m->coordinate[rod->mode_q[4]].fast, c == 1);
        assert_int_equal(m->urgent[rod->mode_v[0]], c == 1);
        for (int k = 0; k < rod->nmode; k++)
            for (int i = 0; i < m->njoint; i++)
                for (int r = 0; r < m->joint[i].nv; r++)
                    assert_true(m->follow[rod->mode_v[k]] < m->follow[m->joint[i].iv[r]]);
        arena_close(o.life);
    }
}

/* Initial values of modes and the orientation of what stands on a bent beam: omega in world axes. */
static void test_start(void **state)
{
    struct opened o;
    (void)state;
    open_deck(&o,
              "bodies:\n"
              "  arm: {beam: {from: [0, 0, 0], to: [2, 0, 0]}, section: {circle: 0.02}, material: steel, modes: 3}\n"
              "  top: {mass: 1, inertia: [0.1, 0.1, 0.1], at: [2, 0, 0]}\n"
              "constraints:\n"
              "  clamp: {fixed: [ground, arm], at: [0, 0, 0]}\n"
              "  ball: {spherical: [arm, top], at: [2, 0, 0]}\n"
              "initial: {arm.mode1: 0.2, arm.mode2_rate: -3, ball.omega: [1, 2, 3]}\n",
              "");
    const struct model *m = o.model;
    const struct model_body *b = &m->body[m->body_of[1]];
    const struct model_joint *j = &m->joint[m->joint_of[1]];
    assert_true(m->q0[b->mode_q[0]] == .2 && m->v0[b->mode_v[1]] == -3);
    /* first order in the small turn theta of the node: omega_body = omega - theta x omega */
    double theta[3], across[3], omega[3] = {1, 2, 3};
    v3_scale(theta, .2, b->flex->node[m->body[j->parent].node].psi);
    v3_cross(across, theta, omega);
    double size = v3_norm(theta);
    assert_true(size > 1e-3);
    for (int k = 0; k < 3; k++) assert_true(fabs(m->v0[j->iv[k]] - omega[k] + across[k]) < 5 * size * size);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_torsion), cmocka_unit_test(test_sections), cmocka_unit_test(test_centre),
        cmocka_unit_test(test_nodes),   cmocka_unit_test(test_numbers),  cmocka_unit_test(test_loops),
        cmocka_unit_test(test_start),   cmocka_unit_test(test_segments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
