/* t-system.c -- a model behind ode2.h: the laws every system keeps, on random trees with every element, in the
 * plane and in space; energies, momenta and reactions against differences. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "system/system.h"
#include "unit/near.h"
#include "unit/trees.h"

#include <cmocka.h>

enum { MOST = 80, SEEDS = 30 };

struct fixture {
    struct arena *arena;
    struct model *m;
    struct system *s;
    const struct ode2 *o;
    double q[MOST], v[MOST], a[MOST], t;
};

static double largest(const double *x, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(x[i]));
    return most;
}

static void start(struct fixture *f)
{
    struct tree_dice d = {99};
    f->s = system_build(f->m, f->arena);
    f->o = system_ode2(f->s);
    f->t = .3;
    assert_true(f->m->nq <= MOST);
    memcpy(f->q, f->m->q0, sizeof *f->q * (size_t)f->m->nq);
    memcpy(f->v, f->m->v0, sizeof *f->v * (size_t)f->m->n);
    for (int i = 0; i < f->m->n; i++) f->a[i] = tree_roll(&d, -3, 3);
}

static void open_tree(struct fixture *f, int space, int nbody, unsigned seed, unsigned flags)
{
    f->arena = arena_open();
    f->m = random_tree(space, nbody, seed, flags, f->arena);
    start(f);
}

/* Only the forces that `keep` likes. */
static void open_some(struct fixture *f, int space, int nbody, unsigned seed, unsigned flags,
                      bool (*keep)(const struct model *, const struct model_force *))
{
    f->arena = arena_open();
    f->m = random_tree(space, nbody, seed, flags, f->arena);
    struct model_force *kept = TAKE(f->arena, struct model_force, f->m->nforce);
    int n = 0;
    for (int i = 0; i < f->m->nforce; i++)
        if (keep(f->m, &f->m->force[i])) kept[n++] = f->m->force[i];
    f->m->force = kept;
    f->m->nforce = n;
    start(f);
}

static void close_tree(struct fixture *f)
{
    arena_close(f->arena);
}

static void resid(double *r, double *w, struct fixture *f, const double *a, unsigned cls)
{
    const struct instant x = {.t = f->t, .q = f->q, .v = f->v, .a = a};
    double dk;
    assert_int_equal(f->o->ops->resid(f->o, r, w, &dk, &x, cls, NULL), OK);
}

/* q1 = q (+) s dx */
static void along(double *q1, const struct fixture *f, const double *dx, double s)
{
    if (f->o->move) {
        f->o->move->point(f->o, q1, f->q, dx, s, 0);
        return;
    }
    for (int i = 0; i < f->m->n; i++) q1[i] = f->q[i] + s * dx[i];
}

#define EVERY_TREE(space, seed)                                                                                        \
    for (int space = 2; space <= 3; space++)                                                                           \
        for (unsigned seed = 0; seed < SEEDS; seed++)

static void classes_add_up(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double fast[MOST], slow[MOST], all[MOST], wf[POWER_CHANNELS], ws[POWER_CHANNELS], wa[POWER_CHANNELS];
        static double M[3][MOST * MOST];
        open_tree(&f, space, 7, seed, TREE_FORCES | TREE_FAST_LEAVES);
        int n = f.m->n;
        resid(fast, wf, &f, f.a, FAST);
        resid(slow, ws, &f, f.a, SLOW);
        resid(all, wa, &f, f.a, ALL);
        for (int i = 0; i < f.m->ns; i++) assert_true(slow[i] == 0);
        for (int i = 0; i < n; i++) fast[i] += slow[i];
        for (int i = 0; i < POWER_CHANNELS; i++) wf[i] += ws[i];
        assert_true(all_near(fast, all, n, 1e-13));
        assert_true(all_near(wf, wa, POWER_CHANNELS, 1e-13));
        for (int c = 0; c < 3; c++) assert_int_equal(f.o->ops->mass(f.o, M[c], f.q, 0, (unsigned)c + 1, NULL), OK);
        for (int i = 0; i < n * n; i++) M[0][i] += M[1][i];
        assert_true(all_near(M[0], M[2], n * n, 1e-13));
        close_tree(&f);
    }
}

static void resid_is_affine_in_accelerations(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double r[MOST], r0[MOST];
        static double M[MOST * MOST];
        open_tree(&f, space, 7, seed, TREE_FORCES | TREE_FAST_LEAVES);
        for (unsigned cls = FAST; cls <= ALL; cls++) {
            resid(r, NULL, &f, f.a, cls);
            resid(r0, NULL, &f, NULL, cls);
            assert_int_equal(f.o->ops->mass(f.o, M, f.q, f.t, cls, NULL), OK);
            for (int i = 0; i < f.m->n; i++)
                for (int j = 0; j < f.m->n; j++) r0[i] += M[i + f.m->n * j] * f.a[j];
            assert_true(all_near(r, r0, f.m->n, 1e-12));
        }
        close_tree(&f);
    }
}

/* Whatever was asked in between. */
static void the_same_bits_twice(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double r[MOST], again[MOST], other[MOST], w[POWER_CHANNELS], w2[POWER_CHANNELS];
        struct energies e;
        open_tree(&f, space, 6, seed, TREE_FORCES | TREE_FAST_LEAVES);
        resid(r, w, &f, f.a, ALL);
        assert_int_equal(f.o->direct->accel(f.o, other, NULL, f.q, f.a, 2, NULL), OK);
        assert_int_equal(system_evaluate(f.s, f.q, f.a, 1, EVALUATE_ACCELERATION | EVALUATE_ENERGY, NULL), OK);
        assert_int_equal(system_energy_at(f.s, &e, f.q, f.a, 0, &(struct trouble){0}), OK);
        resid(other, NULL, &f, NULL, FAST);
        resid(again, w2, &f, f.a, ALL);
        assert_memory_equal(r, again, sizeof *r * (size_t)f.m->n);
        assert_memory_equal(w, w2, sizeof w);
        close_tree(&f);
    }
}

/* A system that is pointwise says the same whatever the ends; one with springs that are not plain does not. */
static void ends_are_looked_at_or_not(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    for (unsigned flags = 0; flags < 2; flags++) {
        struct fixture f;
        double r[MOST], without[MOST], zero[MOST] = {0}, change = 0;
        open_tree(&f, space, 6, seed, TREE_REVOLUTE | (flags ? TREE_FORCES : 0));
        struct instant x = {.t = .1, .q = f.q, .v = f.v, .ta = 0, .tb = .2};
        assert_int_equal(f.o->ops->resid(f.o, without, NULL, NULL, &x, ALL, NULL), OK);
        x.qa = zero, x.qb = f.q;
        assert_int_equal(f.o->ops->resid(f.o, r, NULL, NULL, &x, ALL, NULL), OK);
        for (int i = 0; i < f.o->n; i++) change = fmax(change, fabs(r[i] - without[i]));
        assert_int_equal(f.o->pointwise, !flags);
        assert_true(flags ? change > 1e-3 : change == 0);
        close_tree(&f);
    }
}

static void nothing_is_allocated(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double r[MOST];
        static double K[MOST * MOST], C[MOST * MOST];
        open_tree(&f, space, 6, seed, TREE_FORCES);
        const struct instant x = {.t = .1, .q = f.q, .v = f.v, .qa = f.q, .qb = f.q, .ta = 0, .tb = .2};
        size_t used = arena_used(f.arena);
        assert_int_equal(f.o->ops->resid(f.o, r, NULL, NULL, &x, ALL, NULL), OK);
        assert_int_equal(f.o->ops->slopes(f.o, K, C, &x, ALL, NULL), OK);
        assert_int_equal(f.o->ops->mass(f.o, K, f.q, 0, ALL, NULL), OK);
        assert_int_equal(f.o->direct->accel(f.o, r, NULL, f.q, f.v, 0, NULL), OK);
        assert_int_equal(system_evaluate(f.s, f.q, f.v, 0, EVALUATE_ACCELERATION | EVALUATE_ENERGY, NULL), OK);
        assert_int_equal(arena_used(f.arena), used);
        close_tree(&f);
    }
}

static void accelerations_solve_the_equations(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double a[MOST], r[MOST], r0[MOST];
        open_tree(&f, space, 8, seed, TREE_FORCES);
        assert_int_equal(f.o->direct->accel(f.o, a, NULL, f.q, f.v, f.t, NULL), OK);
        resid(r, NULL, &f, a, ALL);
        resid(r0, NULL, &f, NULL, ALL);
        assert_true(largest(r, f.m->n) <= 1e-10 * (1 + largest(r0, f.m->n)));
        close_tree(&f);
    }
}

static bool along_coordinates(const struct model *m, const struct model_force *f)
{
    return f->type == FORCE_LOAD || (f->type != FORCE_BETWEEN && m->measure[f->measure].type == MEASURE_COORDINATE);
}

static void the_structured_factor_is_the_dense_matrix(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double x[MOST], b[MOST], y[MOST] = {0}, cm = 1.3, cc = .2, ck = .05;
        static double M[MOST * MOST], K[MOST * MOST], C[MOST * MOST];
        open_some(&f, space, 7, seed, TREE_FORCES, along_coordinates);
        int n = f.m->n;
        double qa[MOST], qb[MOST], dx[MOST];
        for (int i = 0; i < n; i++) dx[i] = .1 * f.v[i];
        along(qa, &f, dx, -.5);
        along(qb, &f, dx, .5);
        const struct instant at = {.t = f.t, .q = f.q, .v = f.v, .qa = qa, .qb = qb, .ta = f.t - .05, .tb = f.t + .05};
        void *F = arena_take(f.arena, 1, f.o->direct->factor_size);
        assert_int_equal(f.o->direct->factor(f.o, F, cm, cc, ck, &at, NULL), OK);
        assert_int_equal(f.o->ops->mass(f.o, M, f.q, f.t, ALL, NULL), OK);
        assert_int_equal(f.o->ops->slopes(f.o, K, C, &at, ALL, NULL), OK);
        for (int i = 0; i < n; i++) b[i] = x[i] = f.a[i];
        f.o->direct->solve(f.o, F, x);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) y[i] += (cm * M[i + n * j] + cc * C[i + n * j] + ck * K[i + n * j]) * x[j];
        assert_true(all_near(y, b, n, 1e-10));
        close_tree(&f);
        /* a spring between points: not this way */
        open_tree(&f, space, 4, seed, TREE_FORCES);
        assert_null(f.o->direct->factor);
        close_tree(&f);
    }
}

/* d/dt of all energies along the true motion is the power of what is not stored; every element's force, every
 * stored energy and the inertia are in it. */
static void power_is_the_rate_of_energy(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double a[MOST], r[MOST], w[POWER_CHANNELS], q[MOST], v[MOST], dx[MOST], e = 1e-4, E[2];
        open_tree(&f, space, 5, seed, TREE_FORCES);
        f.m->t0 = f.t; /* turns are counted from here */
        assert_int_equal(system_start(f.s, f.q, f.v, &(struct report){0}), OK);
        assert_int_equal(f.o->direct->accel(f.o, a, NULL, f.q, f.v, f.t, NULL), OK);
        resid(r, w, &f, a, ALL);
        for (int side = 0; side < 2; side++) {
            double h = side ? e : -e;
            struct energies here;
            /* q along v + h a/2, exact to h^2: the rest is odd in h and of third order */
            for (int i = 0; i < f.m->n; i++) dx[i] = h * (f.v[i] + .5 * h * a[i]), v[i] = f.v[i] + h * a[i];
            along(q, &f, dx, 1);
            assert_int_equal(system_energy_at(f.s, &here, q, v, f.t + h, &(struct trouble){0}), OK);
            E[side] = here.kinetic + here.elastic + here.gravity;
        }
        double rate = (E[1] - E[0]) / (2 * e), power = w[POWER_EXTERNAL] + w[POWER_DAMPER], scale = 1 + fabs(power);
        for (int i = 0; i < f.m->n; i++) scale += fabs(a[i] * f.v[i]);
        if (!(fabs(rate - power) < 2e-5 * scale))
            fail_msg("space %d seed %u: dE/dt %.12g, power %.12g", space, seed, rate, power);
        assert_true(w[POWER_DAMPER] <= 0 && w[POWER_DRIVE] == 0 && w[POWER_FRICTION] == 0);
        double sum = 0;
        assert_int_equal(system_evaluate(f.s, f.q, f.v, f.t, EVALUATE_ALL, NULL), OK);
        assert_true(all_near(system_accelerations(f.s), a, f.m->n, 0));
        for (int i = 0; i < f.m->nforce; i++) {
            double force, s, p;
            system_force(f.s, &force, &s, &p, i);
            sum += p;
        }
        /* the elements' powers and gravity's make the kinetic energy */
        struct energies x[2];
        for (int side = 0; side < 2; side++) {
            double h = side ? e : -e;
            for (int i = 0; i < f.m->n; i++) dx[i] = h * (f.v[i] + .5 * h * a[i]), v[i] = f.v[i] + h * a[i];
            along(q, &f, dx, 1);
            assert_int_equal(system_energy_at(f.s, &x[side], q, v, 0, &(struct trouble){0}), OK);
        }
        rate = (x[1].kinetic + x[1].gravity - x[0].kinetic - x[0].gravity) / (2 * e);
        assert_true(fabs(rate - sum) < 2e-5 * (scale + fabs(sum)));
        close_tree(&f);
    }
}

static bool between_bodies(const struct model *m, const struct model_force *f)
{
    if (f->type == FORCE_LOAD) return false;
    if (f->type == FORCE_BETWEEN) return f->a.body && f->b.body;
    const struct model_measure *s = &m->measure[f->measure];
    return s->type != MEASURE_COORDINATE && s->a.body && s->b.body;
}

/* Bodies adrift with forces between them keep their momentum and their angular momentum. */
static void momenta_are_kept(void **state)
{
    (void)state;
    int tried = 0;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double a[MOST], q[MOST], v[MOST], dx[MOST], e = 1e-5, P[2][6], scale = 1;
        open_some(&f, space, 3, seed, TREE_FORCES | TREE_ADRIFT | TREE_FREE_FALL, between_bodies);
        tried += f.m->nforce;
        assert_int_equal(f.o->direct->accel(f.o, a, NULL, f.q, f.v, f.t, NULL), OK);
        for (int side = 0; side < 2; side++) {
            double h = side ? e : -e;
            for (int i = 0; i < f.m->n; i++) dx[i] = h * (f.v[i] + .5 * h * a[i]), v[i] = f.v[i] + h * a[i];
            along(q, &f, dx, 1);
            assert_int_equal(system_evaluate(f.s, q, v, f.t, EVALUATE_MOTION, NULL), OK);
            system_momentum(f.s, P[side], P[side] + 3);
        }
        for (int i = 0; i < f.m->n; i++) scale = fmax(scale, fabs(a[i]));
        for (int i = 0; i < 6; i++)
            if (!(fabs(P[1][i] - P[0][i]) / (2 * e) < 1e-6 * scale))
                fail_msg("space %d seed %u: momentum %d grows at %g of %g", space, seed, i,
                         (P[1][i] - P[0][i]) / (2 * e), scale);
        close_tree(&f);
    }
    assert_true(tried > 2 * SEEDS);
}

/* Points: positions, velocities, accelerations are derivatives of each other; measures and their rates too. */
static void what_is_seen_is_consistent(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double a[MOST], q[MOST], v[MOST], dx[MOST], e = 1e-4, x[3][3], xv[3][3], xa[3], s[2], rate[3];
        struct model_point p = {.body = 5, .p = {.2, -.4, 0}};
        open_tree(&f, space, 5, seed, TREE_FORCES);
        if (space == 3) p.p[2] = .7;
        assert_int_equal(system_evaluate(f.s, f.q, f.v, f.t, EVALUATE_ACCELERATION, NULL), OK);
        memcpy(a, system_accelerations(f.s), sizeof *a * (size_t)f.m->n);
        system_point(f.s, x[2], xv[2], xa, &p);
        for (int side = 0; side < 2; side++) {
            double h = side ? e : -e;
            for (int i = 0; i < f.m->n; i++) dx[i] = h * (f.v[i] + .5 * h * a[i]), v[i] = f.v[i] + h * a[i];
            along(q, &f, dx, 1);
            double none[3];
            assert_int_equal(system_evaluate(f.s, q, v, f.t, EVALUATE_MOTION, NULL), OK);
            system_point(f.s, x[side], xv[side], none, &p);
        }
        for (int i = 0; i < 3; i++) {
            double scale = 1 + largest(a, f.m->n) * 10;
            assert_true(fabs((x[1][i] - x[0][i]) / (2 * e) - xv[2][i]) < 1e-6 * scale);
            assert_true(fabs((xv[1][i] - xv[0][i]) / (2 * e) - xa[i]) < 1e-5 * scale);
        }
        for (int m = 0; m < f.m->nmeasure; m++) {
            double value, here;
            assert_int_equal(system_evaluate(f.s, f.q, f.v, f.t, EVALUATE_MOTION, NULL), OK);
            system_measure(f.s, &value, &here, m);
            for (int side = 0; side < 2; side++) {
                for (int i = 0; i < f.m->n; i++) dx[i] = (side ? 1e-6 : -1e-6) * f.v[i];
                along(q, &f, dx, 1);
                assert_int_equal(system_evaluate(f.s, q, f.v, f.t, EVALUATE_MOTION, NULL), OK);
                system_measure(f.s, &s[side], &rate[side], m);
            }
            if (!(fabs((s[1] - s[0]) / 2e-6 - here) < 1e-6 * (1 + fabs(here))))
                fail_msg("space %d seed %u measure %d: rate %.10g, by differences %.10g", space, seed, m, here,
                         (s[1] - s[0]) / 2e-6);
        }
        close_tree(&f);
    }
}

/* The joint is turned round in the deck: its second body feels the opposite, about its own point of the joint. */
static void reversed_joints_report_the_other_side(void **state)
{
    (void)state;
    struct fixture f;
    open_tree(&f, 2, 4, 5, TREE_CHAIN | TREE_REVOLUTE);
    struct model_joint *j = (struct model_joint *)&f.m->joint[1];
    double one[6], other[6];
    j->reversed = false;
    assert_int_equal(system_evaluate(f.s, f.q, f.v, 0, EVALUATE_ALL, NULL), OK);
    system_reaction(f.s, one, one + 3, 1);
    j->reversed = true;
    system_reaction(f.s, other, other + 3, 1);
    assert_true(largest(one, 6) > .1);
    for (int i = 0; i < 3; i++) assert_true(one[i] == -other[i]);
    for (int i = 3; i < 6; i++) assert_true(fabs(one[i] + other[i]) < 1e-13 * largest(one, 6));
    close_tree(&f);
}

/* A weight at rest on a spring: the ground's joint carries nothing along the spring, and all across. */
static void a_hanging_weight(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    static const double I[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, zero[1];
    struct model_body body[2] = {{.parent = -1, .joint = -1},
                                 {.mass = 2, .inertia = {0, 0, 1}, .parent = 0, .joint = 0}};
    /* axis z along (3, 4)/5 */
    struct model_joint joint = {.type = JOINT_PRISMATIC,
                                .child = 1,
                                .nq = 1,
                                .nv = 1,
                                .Ea = {.8, -.6, 0, 0, 0, -1, .6, .8, 0},
                                .Eb = {.8, -.6, 0, 0, 0, -1, .6, .8, 0}};
    struct model_coordinate c = {.name = "q"};
    struct model_measure s = {.type = MEASURE_COORDINATE};
    struct spring par = {.k = 100, .rest = 0};
    struct model_force force = {.type = FORCE_LAW, .cls = SLOW, .kind = &force_spring, .par = &par};
    for (int i = 0; i < 2; i++) memcpy(body[i].R, I, sizeof I);
    struct model m = {.space = 2,
                      .gravity = {0, -10, 0},
                      .n = 1,
                      .nq = 1,
                      .nbody = 2,
                      .body = body,
                      .njoint = 1,
                      .joint = &joint,
                      .nmeasure = 1,
                      .measure = &s,
                      .nforce = 1,
                      .force = &force,
                      .ncoordinate = 1,
                      .coordinate = &c,
                      .q0 = zero,
                      .v0 = zero};
    struct system *sys = system_build(&m, arena);
    double q = -2 * 10 * .8 / 100, v = 0, f[3], n[3], pull, stretch, power;
    assert_int_equal(system_evaluate(sys, &q, &v, 0, EVALUATE_ALL, NULL), OK);
    assert_true(fabs(system_accelerations(sys)[0]) < 1e-14);
    system_force(sys, &pull, &stretch, &power, 0);
    system_reaction(sys, f, n, 0);
    assert_true(fabs(pull - 16) < 1e-13 && stretch == q && power == 0);
    assert_true(fabs(f[0] + 20 * .8 * .6) < 1e-13 && fabs(f[1] - 20 * .6 * .6) < 1e-13);
    arena_close(arena);
}

static void trouble_is_named(void **state)
{
    (void)state;
    struct fixture f;
    struct trouble why;
    double r[MOST];
    open_tree(&f, 2, 4, 1, TREE_FORCES);
    const struct instant x = {.t = 2, .q = f.q, .v = f.v};
    f.v[0] = NAN;
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, NULL, &x, ALL, &why), E_NUMERIC);
    f.v[0] = 0;
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, NULL, &x, ALL, &why), OK);
    struct spring *par = (struct spring *)f.m->force[3].par;
    par->preload = INFINITY;
    struct system *s = system_build(f.m, f.arena);
    const struct ode2 *o = system_ode2(s);
    assert_int_equal(o->ops->resid(o, r, NULL, NULL, &x, ALL, &why), E_NUMERIC);
    assert_int_equal(why.code, TROUBLE_LAW);
    assert_int_equal(why.index, 3);
    assert_true(why.t == 2);
    close_tree(&f);
    /* no element to blame: the row */
    open_tree(&f, 3, 3, 1, 0);
    const struct instant y = {.t = 2, .q = f.q, .v = f.v, .a = f.a};
    f.a[f.m->n - 1] = INFINITY;
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, NULL, &y, ALL, &why), E_NUMERIC);
    assert_int_equal(why.code, TROUBLE_NOT_FINITE);
    assert_false(isfinite(r[why.index]));
    static double M[MOST * MOST];
    assert_int_equal(f.o->ops->mass(f.o, M, f.q, 0, ALL, &why), OK);
    f.q[f.m->nq - 1] = NAN;
    assert_int_equal(f.o->ops->mass(f.o, M, f.q, 0, ALL, &why), E_NUMERIC);
    assert_int_equal(why.code, TROUBLE_NOT_FINITE);
    close_tree(&f);
}

static void kinks_of_tables_are_known(void **state)
{
    (void)state;
    struct fixture f;
    open_tree(&f, 2, 3, 1, TREE_FORCES); /* tables at -1, 0, 1 */
    assert_true(f.o->breaks->next(f.o, -2) == -1 && f.o->breaks->next(f.o, 0) == 1 && f.o->breaks->next(f.o, .5) == 1);
    assert_true(isinf(f.o->breaks->next(f.o, 1)));
    close_tree(&f);
    open_tree(&f, 2, 3, 1, 0);
    assert_null(f.o->breaks);
    close_tree(&f);
}

static void a_massless_body_has_no_acceleration(void **state)
{
    (void)state;
    struct fixture f;
    struct trouble why;
    double a[MOST];
    open_tree(&f, 2, 3, 1, TREE_CHAIN | TREE_REVOLUTE);
    struct model_body *last = (struct model_body *)&f.m->body[3];
    last->mass = last->inertia[2] = 0;
    start(&f);
    assert_int_equal(f.o->direct->accel(f.o, a, NULL, f.q, f.v, 0, &why), E_NUMERIC);
    assert_int_equal(why.code, TROUBLE_MASS);
    close_tree(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(classes_add_up),
        cmocka_unit_test(resid_is_affine_in_accelerations),
        cmocka_unit_test(the_same_bits_twice),
        cmocka_unit_test(ends_are_looked_at_or_not),
        cmocka_unit_test(nothing_is_allocated),
        cmocka_unit_test(accelerations_solve_the_equations),
        cmocka_unit_test(the_structured_factor_is_the_dense_matrix),
        cmocka_unit_test(power_is_the_rate_of_energy),
        cmocka_unit_test(momenta_are_kept),
        cmocka_unit_test(what_is_seen_is_consistent),
        cmocka_unit_test(reversed_joints_report_the_other_side),
        cmocka_unit_test(a_hanging_weight),
        cmocka_unit_test(trouble_is_named),
        cmocka_unit_test(kinks_of_tables_are_known),
        cmocka_unit_test(a_massless_body_has_no_acceleration),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
