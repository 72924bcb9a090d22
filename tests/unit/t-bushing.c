/* t-bushing.c -- bushings: rows of their strains against differences, which frame sees what, tilt at any twist, small
 * rotations, energy and momentum of runs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "la/rot.h"
#include "la/vec3.h"
#include "unit/trees.h"

#include <cmocka.h>

#include "unit/opened.h"

enum { SEEDS = 40, KINDS = 6 };

/* Which axis is that of twist: z, x, y, none (isotropic) with damping that has one,
 * none, none with rest and preload. */
static struct bushing bushing_of(int kind, int axes, struct tree_dice *d)
{
    static const double kr[KINDS][3] = {{3, 2, 0}, {0, 3, 3}, {3, 1, 2}, {2, 2, 2}, {2, 2, 2}, {2, 2, 2}};
    static const double cr[KINDS][3] = {{1, 1, 1}, {0, 0, 0}, {1, 2, 3}, {1, 1, 3}, {1, 1, 1}, {1, 2, 3}};
    struct bushing p = {.axes = axes};
    double q[4];
    tree_quaternion(q, d, 3);
    quat_matrix(p.on.drawn, q);
    for (int i = 0; i < 3; i++) {
        p.k[i] = 10 + 5 * i, p.c[i] = 1 + i;
        p.kr[i] = kr[kind][i], p.cr[i] = cr[kind][i];
        p.rest[i] = .1 * i, p.preload[i] = 2 - i;
        if (kind != 3 && kind != 4) p.rest_r[i] = .2 - .1 * i, p.preload_r[i] = i - .5;
    }
    return p;
}

/* Two markers that move; what turns them has an angle of up to `most`. */
static struct between two_markers(struct tree_dice *d, double most)
{
    struct between x = {.space = 3};
    struct frame *of[2] = {&x.a, &x.b};
    double q[2][4], phi[3];
    tree_quaternion(q[0], d, 3);
    for (int i = 0; i < 3; i++) phi[i] = tree_roll(d, -1, 1);
    v3_scale(phi, 2 * tan(most / 4) / v3_norm(phi), phi);
    quat_cay(q[1], phi);
    quat_mul(q[1], q[0], q[1]);
    for (int k = 0; k < 2; k++) {
        quat_matrix(of[k]->E, q[k]);
        for (int i = 0; i < 3; i++) {
            of[k]->x[i] = tree_roll(d, -1, 1), of[k]->v[i] = tree_roll(d, -2, 2), of[k]->w[i] = tree_roll(d, -3, 3);
        }
    }
    return x;
}

/* Where they are a time later: constant velocities, angular ones in the world. */
static struct between later(const struct between *x, double t)
{
    struct between y = *x;
    struct frame *of[2] = {&y.a, &y.b};
    for (int k = 0; k < 2; k++) {
        double size = v3_norm(of[k]->w), q[4], R[9], E[9];
        q[0] = cos(size * t / 2);
        v3_scale(q + 1, sin(size * t / 2) / size, of[k]->w);
        quat_matrix(R, q);
        m3_mulm(E, R, of[k]->E);
        memcpy(of[k]->E, E, sizeof E);
        v3_axpy(of[k]->x, t, of[k]->v);
    }
    return y;
}

/* s' of the row: dir.(v_b - v_a) + on_a.w_a + on_b.w_b at the points where the forces act. */
static double rate_by_row(const struct strains *o, const struct strain *s, const struct between *x)
{
    double arm[3], va[3], vb[3], d[3], rate = 0;
    if (s->slides) {
        v3_diff(arm, o->at_a, x->a.x), v3_cross(va, x->a.w, arm), v3_add(va, x->a.v);
        v3_diff(arm, o->at_b, x->b.x), v3_cross(vb, x->b.w, arm), v3_add(vb, x->b.v);
        v3_diff(d, vb, va);
        rate += v3_dot(s->dir, d);
    }
    if (s->turns) rate += v3_dot(s->on_a, x->a.w) + v3_dot(s->on_b, x->b.w);
    return rate;
}

#define EVERY(kind, axes, seed)                                                                                        \
    for (int kind = 0; kind < KINDS; kind++)                                                                           \
        for (int axes = 0; axes < 4; axes++)                                                                           \
            for (unsigned seed = 0; seed < SEEDS; seed++)

/* All that has stiffness: rate, row and the difference of the strain agree, at angles small and large. */
static void rows_are_what_strains_change_by(void **state)
{
    static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1. / 12, -2. / 3, 2. / 3, -1. / 12}, e = 3e-4;
    (void)state;
    EVERY(kind, axes, seed)
    {
        struct tree_dice d = {seed + 1};
        const struct bushing p = bushing_of(kind, axes, &d);
        const struct between x = two_markers(&d, seed % 4 ? tree_roll(&d, .1, 2.5) : tree_roll(&d, .04, .06));
        struct strains now = {0}, then;
        double change[MOST_STRAINS] = {0};
        force_bushing.strains(&now, &p, &x);
        for (int k = 0; k < 4; k++) {
            const struct between y = later(&x, at[k] * e);
            then.n = 0;
            force_bushing.strains(&then, &p, &y);
            for (int i = 0; i < now.n; i++) change[i] += weight[k] / e * then.of[i].s;
        }
        for (int i = 0; i < now.n; i++) {
            const struct strain *s = &now.of[i];
            near(rate_by_row(&now, s, &x), s->rate, 1e-13 * 20);
            if (s->ks > 0) near(s->rate, change[i], seed % 4 ? 1e-8 : 1e-10);
        }
    }
}

/* What the strains' forces do on both bodies together. */
static void resultant(double *F, double *N, const struct strains *o)
{
    double f[3] = {0}, n[3] = {0}, arm[3];
    for (int i = 0; i < o->n; i++) {
        const struct strain *s = &o->of[i];
        const double size = s->f + s->lost;
        if (s->slides) v3_axpy(f, size, s->dir);
        if (s->turns) v3_axpy(n, size, s->on_a), v3_axpy(n, size, s->on_b);
    }
    v3_diff(arm, o->at_b, o->at_a);
    v3_cross_add(n, arm, f);
    v3_copy(F, f), v3_copy(N, n);
}

/* No net moment, but with axes of the world; damping takes; and forces are slopes of the stored energy. */
static void momentum_is_kept(void **state)
{
    (void)state;
    EVERY(kind, axes, seed)
    {
        struct tree_dice d = {seed + 1};
        const struct bushing p = bushing_of(kind, axes, &d);
        const struct between x = two_markers(&d, tree_roll(&d, .1, 3));
        struct strains o = {0};
        double F[3], N[3];
        force_bushing.strains(&o, &p, &x);
        resultant(F, N, &o);
        if (axes == AXES_WORLD)
            assert_true(v3_norm(N) > 1e-3);
        else
            assert_true(v3_norm(N) < 1e-12 * (1 + v3_norm(F)) * 100);
        for (int i = 0; i < o.n; i++) assert_true(o.of[i].lost * o.of[i].rate <= 0);
    }
}

static struct between swapped(const struct between *x)
{
    return (struct between){.space = x->space, .a = x->b, .b = x->a, .angle = -x->angle};
}

/* The second body's axes are the first's of the bushing with its bodies swapped; half-way it does not matter. */
static void the_order_of_the_bodies(void **state)
{
    (void)state;
    EVERY(kind, axes, seed)
    {
        struct tree_dice d = {seed + 1};
        struct bushing p = bushing_of(kind, axes, &d);
        const struct between x = two_markers(&d, tree_roll(&d, .1, 2.5)), y = swapped(&x);
        struct strains o = {0}, other = {0};
        force_bushing.strains(&o, &p, &x);
        p.axes = axes == AXES_FIRST ? AXES_SECOND : axes == AXES_SECOND ? AXES_FIRST : axes;
        if (kind == 5) continue; /* its rest is no strain of its own, see below */
        force_bushing.strains(&other, &p, &y);
        if (axes == AXES_WORLD) continue;
        for (int i = 0; i < o.n; i++) {
            near(o.of[i].s, -other.of[i].s, 1e-13);
            if (o.of[i].ks > 0) near(o.of[i].rate, -other.of[i].rate, 1e-12);
        }
    }
}

/* Twisted by any angle about its axis the second marker has the same swing; the twist takes all of that angle. */
static void tilt_does_not_know_the_twist(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned seed = 0; seed < SEEDS; seed++) {
            struct tree_dice d = {seed + 1};
            struct bushing p = {.axes = AXES_FIRST, .kr = {2, 3, seed % 2 ? 2 : 4}};
            struct between x = two_markers(&d, tree_roll(&d, .1, 2.5));
            struct strains o = {0}, turned = {0};
            double q[4] = {0}, R[9], E[9], swing = 0, with = 0;
            p.kr[axis] = 0;
            force_bushing.strains(&o, &p, &x);
            const double angle = tree_roll(&d, -3, 3);
            q[0] = cos(angle / 2), q[1 + axis] = sin(angle / 2);
            quat_matrix(R, q);
            m3_mulm(E, x.b.E, R);
            memcpy(x.b.E, E, sizeof E);
            force_bushing.strains(&turned, &p, &x);
            for (int i = 3; i < 5; i++) {
                near(turned.of[i].s, o.of[i].s, 1e-13);
                swing += o.of[i].s * o.of[i].s, with += turned.of[i].s * turned.of[i].s;
            }
            near(with, swing, 1e-13);
            near(remainder(turned.of[5].s - o.of[5].s - angle, 2 * acos(-1)), 0, 1e-12);
        }
}

/* Of small rotations: those of the rotation vector, to second order; half-way to third. */
static void small_rotations(void **state)
{
    (void)state;
    for (int axes = 0; axes < 4; axes++)
        for (unsigned seed = 0; seed < SEEDS; seed++) {
            for (double size = 1e-1; size > 1e-4; size /= 10) {
                struct tree_dice d = {seed + 1};
                const struct bushing p = {.axes = axes, .kr = {3, 2, 1}};
                struct between x = two_markers(&d, size);
                double R[9], phi[3];
                struct strains o = {0};
                if (axes == AXES_WORLD) memcpy((double *)p.on.drawn, x.a.E, sizeof x.a.E);
                force_bushing.strains(&o, &p, &x);
                m3_tmulm(R, x.a.E, x.b.E);
                vector_of_matrix(phi, R);
                for (int i = 0; i < 3; i++)
                    near(o.of[3 + i].s, phi[i], axes == AXES_MIDDLE ? size * size * size / 8 : size * size / 2);
            }
        }
}

/* --- the same about all axes --- */

/* What stiffness and preload do to the second body; damping left out. */
static double kept(double *on_b, const struct bushing *p, const struct between *x)
{
    struct strains o = {0};
    double V = 0;
    force_bushing.strains(&o, p, x);
    v3_set(on_b, 0, 0, 0);
    for (int i = 0; i < o.n; i++) {
        if (o.of[i].turns) v3_axpy(on_b, o.of[i].f, o.of[i].on_b);
        V += o.of[i].V;
    }
    assert_true(o.tilt == 0);
    return V;
}

/* k times the angle of the rotation from rest, about its axis; and a preload p along the mean of its directions in both
 * bodies, |p| tan(half their angle) larger. */
static void isotropic_by_hand(double *on_b, const struct bushing *p, const struct between *x)
{
    double q[3][4], phi[3], half = v3_norm(p->rest_r) / 2, pa[3], pb[3], mean[3];
    quat_of_matrix(q[0], x->a.E), quat_of_matrix(q[1], x->b.E);
    q[2][0] = cos(half);
    v3_scale(q[2] + 1, half > 0 ? -sin(half) / (2 * half) : 0, p->rest_r);
    quat_mul(q[1], q[1], q[2]);
    v3_scale(q[0] + 1, -1, q[0] + 1);
    quat_mul(q[1], q[1], q[0]); /* in the world */
    vector_of_quat(phi, q[1]);
    v3_scale(on_b, -p->kr[0], phi);
    m3_mul(pa, x->a.E, p->preload_r), m3_mul(pb, x->b.E, p->preload_r);
    v3_sum(mean, pa, pb);
    const double size = v3_norm(p->preload_r), c = v3_norm(mean) / 2 / size;
    if (size > 0) v3_axpy(on_b, 1 / (2 * c * c), mean);
}

static struct bushing isotropic_of(struct tree_dice *d, int with, double size)
{
    struct bushing p = {.axes = with % 3, .kr = {6, 6, 6}, .cr = {.1, .1, .1}};
    double *const of[] = {p.rest_r, p.preload_r, p.cr};
    for (int i = 0; i < 3; i++) of[with / 3 % 3][i] += size * tree_roll(d, .2, 1);
    if (with >= 9)
        for (int i = 0; i < 3; i++) p.rest_r[i] = tree_roll(d, -1, 1), p.preload_r[i] = tree_roll(d, -3, 3);
    return p;
}

/* Whatever rest, preload and damping are: along axes of the first, of the second and in the middle. */
static void isotropic_stays_isotropic(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++)
        for (int with = 0; with < 12; with++) {
            struct tree_dice d = {seed + 1};
            const struct between x = two_markers(&d, tree_roll(&d, .1, 2.2));
            const struct bushing p = isotropic_of(&d, with, 1), little = isotropic_of(&d, with % 9, 1e-9),
                                 plain = {.kr = {6, 6, 6}};
            double got[3], want[3];
            kept(got, &p, &x), isotropic_by_hand(want, &p, &x);
            for (int i = 0; i < 3; i++) near(got[i], want[i], 1e-11);
            kept(got, &little, &x), kept(want, &plain, &x);
            for (int i = 0; i < 3; i++) near(got[i], want[i], 1e-7);
        }
}

/* Its torque is the slope of its energy. */
static void isotropic_has_a_potential(void **state)
{
    static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1. / 12, -2. / 3, 2. / 3, -1. / 12}, e = 1e-3;
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++)
        for (int with = 0; with < 12; with++) {
            struct tree_dice d = {seed + 1};
            struct between x = two_markers(&d, tree_roll(&d, .1, 1.8));
            const struct bushing p = isotropic_of(&d, with, .3);
            double got[3], spare[3], slope = 0;
            kept(got, &p, &x);
            v3_set(x.a.w, 1e-20, 0, 0);
            for (int k = 0; k < 4; k++) {
                const struct between y = later(&x, at[k] * e);
                slope += weight[k] / e * kept(spare, &p, &y);
            }
            near(v3_dot(got, x.b.w), -slope, 1e-8);
        }
}

/* --- runs ---------------------------------------------------------------------------------------- */

#define DISC                                                                                                           \
    "space: 3d\n"                                                                                                      \
    "bodies: {d: {mass: 1, inertia: [0.01, 0.01, 0.02], at: [0, 0, 0]}}\n"                                             \
    "constraints: {f: {free: [ground, d], at: [0, 0, 0]}}\n"

/* Tilt of a disc that is free about its axis: 15.9155 Hz at any angle. */
static void tilt_frequency(void **state)
{
    static const double angle[] = {.01, 1, 2, 3, 3.13, 3.1415926};
    (void)state;
    for (size_t k = 0; k < sizeof angle / sizeof *angle; k++)
        for (int axes = 0; axes < 4; axes++) {
            static const char *const words[] = {"first", "second", "middle", "world"};
            struct opened o;
            char text[600];
            snprintf(text, sizeof text,
                     DISC "forces: {b: {bushing: [ground, d], at: [0, 0, 0], rotation: [100, 100, 0], axes: %s}}\n"
                          "initial: {f.rotation: {axis: [0, 0, 1], angle: %.17g}}\n"
                          "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n",
                     words[axes], angle[k]);
            open_deck(&o, text);
            const struct ode2 *ode = system_ode2(o.sim.system);
            const struct instant x = {.q = o.sim.x.q, .v = o.sim.x.v};
            double K[36], dx[6] = {0}, q[7], r[6];
            assert_int_equal(ode->ops->slopes(ode, K, NULL, &x, ALL, NULL), OK);
            for (int i = 3; i < 6; i++) near(sqrt(fabs(K[7 * i]) / (i < 5 ? .01 : .02)), i < 5 ? 100 : 0, 1e-5);
            dx[3] = 1e-4; /* and by the force of a tilt */
            ode->move->point(ode, q, o.sim.x.q, dx, 1, 0);
            const struct instant tilted = {.q = q, .v = o.sim.x.v};
            assert_int_equal(ode->ops->resid(ode, r, NULL, NULL, &tilted, ALL, NULL), OK);
            near(r[3], 100 * 1e-4, 1e-10);
            arena_close(o.life);
        }
}

/* Ten turns and more, tilted, off its centre: the balance is kept to round-off. */
static void energy_of_a_spinning_disc(void **state)
{
    static const char *const scheme[] = {"midpoint, step: 1.0e-3", "subcycle, step: 1.0e-3, ratio: 5"};
    static const char *const words[] = {"first", "second", "middle", "world"};
    (void)state;
    for (int k = 0; k < 2; k++)
        for (int axes = 0; axes < 4; axes++) {
            struct opened o;
            char text[800];
            snprintf(text, sizeof text,
                     DISC "forces: {b: {bushing: [ground, d], at: [0, 0, 0.1], stiffness: [1000, 2000, 1500],\n"
                          "  rotation: [100, 60, 0], preload: [1, 2, 3], rest: [0, 0.01, 0], axes: %s}}\n"
                          "initial: {f.rotation: {axis: [1, 0.3, 0], angle: 0.2}, f.omega: [0.5, 0, 62.8]}\n"
                          "partition: {fast: [f]}\n"
                          "integrate: {scheme: %s, until: 1.2, newton_tolerance: 1.0e-13}\n"
                          "output: {every: 0.1, columns: [energy.residual]}\n",
                     words[axes], scheme[k]);
            open_deck(&o, text);
            run(&o);
            near(o.sim.ledger.worst / o.sim.ledger.norm, 0, 1e-10);
            arena_close(o.life);
        }
}

/* A soft twist goes on through four turns and winds back: psi = w0/w sin(w t), w^2 = k/J. */
static void a_twist_winds_up(void **state)
{
    static const char *const words[] = {"first", "second", "middle", "world"};
    (void)state;
    for (int axes = 0; axes < 4; axes++) {
        struct opened o;
        char text[600];
        snprintf(text, sizeof text,
                 DISC "forces: {b: {bushing: [ground, d], at: [0, 0, 0], rotation: [100, 100, 0.1], axes: %s}}\n"
                      "initial: {f.omega: [0, 0, 60]}\n"
                      "integrate: {scheme: midpoint, step: 2.0e-4, until: 0.9}\n"
                      "output: {every: 0.1, columns: [b.twist]}\n",
                 words[axes]);
        open_deck(&o, text);
        run(&o);
        const double w = sqrt(5), psi = 60 / w * sin(.9 * w);
        near(value(&o, "b.twist"), psi, 2e-4);
        near(value(&o, "b.twist_rate"), 60 * cos(.9 * w), 2e-3);
        near(value(&o, "energy.elastic"), .05 * psi * psi, 1e-3);
        arena_close(o.life);
    }
}

/* A body that a pin (z) holds on one that has been turned over by x is seen by the world as turned by Q = Rx(x) Rz(z)
 * Rx(-x), by z about (0, -sin x, cos x).  Its twist about the world's z goes on through half turns, backwards where x is
 * more than a quarter turn. */
static void the_world_sees_a_twist_turned_over(void **state)
{
    static const struct {
        double x, z, tilt, soft, preload;
    } runs[] = {{0.4, 9, 100, .1, 0},  {2.9, 9, 100, .1, 0}, {2.9, -7, 100, .1, 2},
                {0.3, -60, 3, 3, 1.5}, {2.9, 60, 3, 3, 1.5}, {-3, 60, 3, 3, 1.5}};
    (void)state;
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        const double x = runs[i].x, z = runs[i].z, k = runs[i].tilt, p = runs[i].preload;
        struct opened o;
        char text[1000];
        snprintf(
            text, sizeof text,
            "bodies:\n"
            "  c: {mass: 1, inertia: [0.01, 0.01, 0.02], at: [0, 0, 0]}\n"
            "  d: {mass: 1, inertia: [0.01, 0.01, 0.02], at: [0, 0, 0]}\n"
            "constraints:\n"
            "  over: {revolute: [ground, c], at: [0, 0, 0], axis: [1, 0, 0]}\n"
            "  pin: {revolute: [c, d], at: [0, 0, 0], axis: [0, 0, 1]}\n"
            "forces:\n"
            "  b: {bushing: [c, d], at: [0, 0, 0], axes: world, rotation: [%g, %g, %g], rotation_preload: [0, 0, %g]}\n"
            "drives: {o: {drive: over, value: \"%g*min(t, 1)\"}, p: {drive: pin, value: \"%g*max(t - 1, 0)\"}}\n"
            "integrate: {scheme: midpoint, step: 1.0e-3, until: 2}\n"
            "output: {every: 0.1, columns: [b.twist]}\n",
            k, k, runs[i].soft, p, x, z);
        open_deck(&o, text);
        run(&o);
        const double twist = angle_near(2 * atan2(cos(x) * sin(z / 2), cos(z / 2)), cos(x) > 0 ? z : -z);
        const double tilt = acos(cos(x) * cos(x) + sin(x) * sin(x) * cos(z)), all = angle_near(z, 0);
        const double V = runs[i].soft < k ? (k * tilt * tilt + runs[i].soft * twist * twist) / 2 : k * all * all / 2;
        near(value(&o, "b.twist"), twist, 1e-9);
        near(value(&o, "energy.elastic"), V - p * twist, 1e-7);
        arena_close(o.life);
    }
}

/* A twist with preload and rest beyond half a turn against a spring with preload and rest along the joint that leaves only
 * this twist free: motion, energy, power, and the torque, which is the spring's. */
static void rest_and_preload_beyond_half_a_turn(void **state)
{
    static const char *const words[] = {"first", "second", "middle", "world"};
    static const char *const other = "spring: p, stiffness: 10, damping: 0.02, rest: 4.5, preload: 3";
    (void)state;
    for (int axes = 0; axes < 4; axes++) {
        struct opened o[2];
        for (int k = 0; k < 2; k++) {
            char text[1000], bushing[300];
            snprintf(bushing, sizeof bushing,
                     "bushing: [ground, d], at: [0, 0, 0], axis: [1, 2, 2], axes: %s, rotation: [0, 0, 10], "
                     "rotation_damping: [0, 0, 0.02], rotation_rest: [0, 0, 4.5], rotation_preload: [0, 0, 3]",
                     words[axes]);
            snprintf(text, sizeof text,
                     "bodies: {d: {mass: 1, inertia: [0.01, 0.01, 0.02], at: [0.3, 0.1, 0]}}\n"
                     "constraints: {p: {revolute: [ground, d], at: [0, 0, 0], axis: [1, 2, 2]}}\n"
                     "forces: {b: {%s}}\ninitial: {p.angle: 2, p.angle_rate: 30}\n"
                     "integrate: {scheme: dopri5, tolerance: 1.0e-10, until: 2}\noutput: {every: 0.1}\n",
                     k ? other : bushing);
            open_deck(&o[k], text);
            run(&o[k]);
        }
        near(value(&o[0], "p.angle"), value(&o[1], "p.angle"), 1e-9);
        near(value(&o[0], "b.twist"), value(&o[1], "p.angle"), 1e-9);
        near(value(&o[0], "b.torque"), fabs(value(&o[1], "b.force")), 1e-8);
        near(value(&o[0], "b.power"), value(&o[1], "b.power"), 1e-7);
        near(value(&o[0], "energy.elastic"), value(&o[1], "energy.elastic"), 1e-8);
        assert_true(value(&o[0], "b.force") == 0 && value(&o[0], "p.angle") > 7);
        for (int k = 0; k < 2; k++) arena_close(o[k].life);
    }
}

/* Tilted farther than half a radian: told where stiffnesses differ, not where they are the same all round the axis. */
/* A pin of 1e12 N/m holds a rod as a revolute joint does, with no energy of its own, whatever the axes: markers meet at the
 * ends of steps, not in their middle. */
static void a_stiff_pin(void **state)
{
    static const char *const axes[] = {"first", "second", "middle", "world"};
    (void)state;
    for (int space = 2; space <= 3; space++)
        for (int k = 0; k < 4; k++) {
            struct opened pin, joint;
            const char *z = space == 3 ? ", 0" : "", *inertia = space == 3 ? "[0.1, 0.1, 0.1]" : "0.1";
            char text[900];
            const int n = snprintf(text, sizeof text,
                                   "gravity: [0, -9.81%s]\nbodies: {b: {mass: 1, inertia: %s, at: [1, 0%s]}}\n"
                                   "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n",
                                   z, inertia, z);
            snprintf(text + n, sizeof text - (size_t)n,
                     "constraints: {f: {free: [ground, b]}}\n"
                     "forces: {p: {bushing: [ground, b], at: [0, 0%s], stiffness: [1.0e+12, 1.0e+12%s], axes: %s}}\n",
                     z, space == 3 ? ", 1.0e+12" : "", axes[k]);
            open_deck(&pin, text);
            snprintf(text + n, sizeof text - (size_t)n, "constraints: {r: {revolute: [ground, b], at: [0, 0%s]%s}}\n",
                     z, space == 3 ? ", axis: [0, 0, 1]" : "");
            open_deck(&joint, text);
            run(&pin);
            run(&joint);
            near(value(&pin, "b.x"), value(&joint, "b.x"), 1e-5);
            near(value(&pin, "b.y"), value(&joint, "b.y"), 1e-5);
            near(value(&pin, "energy.elastic"), 0, 1e-9);
            arena_close(pin.life);
            arena_close(joint.life);
        }
}

static void large_tilts_are_told(void **state)
{
    static const struct {
        const char *rotation, *omega, *words;
    } runs[] = {{"[1, 2, 0]", "[9, 0, 6]", "'b' tilts by 0.76 rad"},
                {"[2, 2, 0.1]", "[9, 0, 6]", "[W-bushing]"},
                {"[2, 2, 0]", "[9, 0, 6]", NULL},
                {"[1, 1, 1]", "[9, 0, 6]", NULL},
                {"[1, 2, 0]", "[4, 0, 6]", NULL}};
    (void)state;
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        struct opened o;
        char text[600], *words;
        size_t size;
        snprintf(text, sizeof text,
                 DISC "forces: {b: {bushing: [ground, d], at: [0, 0, 0], rotation: %s}}\n"
                      "initial: {f.omega: %s}\n"
                      "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n"
                      "output: {every: 0.1, columns: [t]}\n",
                 runs[i].rotation, runs[i].omega);
        open_deck(&o, text);
        run(&o);
        FILE *to = open_memstream(&words, &size);
        o.sim.options.warnings = to;
        warn_of_tilts(&o.sim);
        fclose(to);
        if (runs[i].words ? !strstr(words, runs[i].words) : size > 0) fail_msg("%s: %s", runs[i].rotation, words);
        free(words);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_what_strains_change_by),
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(the_order_of_the_bodies),
        cmocka_unit_test(tilt_does_not_know_the_twist),
        cmocka_unit_test(small_rotations),
        cmocka_unit_test(isotropic_stays_isotropic),
        cmocka_unit_test(isotropic_has_a_potential),
        cmocka_unit_test(tilt_frequency),
        cmocka_unit_test(energy_of_a_spinning_disc),
        cmocka_unit_test(a_twist_winds_up),
        cmocka_unit_test(the_world_sees_a_twist_turned_over),
        cmocka_unit_test(rest_and_preload_beyond_half_a_turn),
        cmocka_unit_test(a_stiff_pin),
        cmocka_unit_test(large_tilts_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
