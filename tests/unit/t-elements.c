/* t-elements.c -- forces on a tree: slopes against central differences, work against stored energy over finite
 * intervals, loads against partial velocities, the midpoint rule on a stiff spring. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "expr/expr.h"
#include "system/system.h"
#include "unit/gauss.h"
#include "unit/near.h"
#include "unit/trees.h"

#include <cmocka.h>

enum { MOST = 80, SEEDS = 30 };

#define EVERY_TREE(space, seed)                                                                                        \
    for (int space = 2; space <= 3; space++)                                                                           \
        for (unsigned seed = 0; seed < SEEDS; seed++)

/* The same mechanism with and without forces: the difference is the elements' own. */
struct fixture {
    struct arena *arena;
    struct model *m;
    struct model bare;
    struct system *s, *s_bare;
    const struct ode2 *o, *o_bare;
    int n;
    double q[MOST], v[MOST];
};

static void open_tree(struct fixture *f, int space, int nbody, unsigned seed, unsigned flags)
{
    f->arena = arena_open();
    f->m = random_tree(space, nbody, seed, flags | TREE_FORCES, f->arena);
    f->n = f->m->n;
    assert_true(f->m->nq <= MOST);
    memcpy(f->q, f->m->q0, sizeof *f->q * (size_t)f->m->nq);
    memcpy(f->v, f->m->v0, sizeof *f->v * (size_t)f->n);
}

static void keep_forces(struct fixture *f, bool (*keep)(const struct model *, const struct model_force *))
{
    struct model_force *kept = TAKE(f->arena, struct model_force, f->m->nforce);
    int n = 0;
    for (int i = 0; i < f->m->nforce; i++)
        if (keep(f->m, &f->m->force[i])) kept[n++] = f->m->force[i];
    f->m->force = kept;
    f->m->nforce = n;
}

static void start(struct fixture *f)
{
    f->bare = *f->m;
    f->bare.nforce = 0;
    f->s = system_build(f->m, f->arena);
    f->s_bare = system_build(&f->bare, f->arena);
    f->o = system_ode2(f->s);
    f->o_bare = system_ode2(f->s_bare);
}

/* Free joints that stand at the centres: displacements move them, rotations do not. */
static void at_the_centres(struct fixture *f)
{
    for (int i = 0; i < f->m->njoint; i++) {
        struct model_joint *j = (struct model_joint *)&f->m->joint[i];
        memset(j->b, 0, sizeof j->b);
    }
}

static void close_tree(struct fixture *f)
{
    arena_close(f->arena);
}

static void along(double *q1, const struct fixture *f, const double *q, const double *dx, double s)
{
    double d[MOST];
    for (int i = 0; i < f->n; i++) d[i] = s * dx[i];
    if (f->o->move) {
        f->o->move->point(f->o, q1, q, d, 1, 0);
        return;
    }
    for (int i = 0; i < f->n; i++) q1[i] = q[i] + d[i];
}

/* What the elements add to r. */
static void added(double *r, struct fixture *f, const struct instant *x)
{
    double bare[MOST];
    assert_int_equal(f->o->ops->resid(f->o, r, NULL, NULL, x, ALL, NULL), OK);
    assert_int_equal(f->o_bare->ops->resid(f->o_bare, bare, NULL, NULL, x, ALL, NULL), OK);
    for (int i = 0; i < f->n; i++) r[i] -= bare[i];
}

enum { OF_K = 1, OF_C = 2 };

/* K and C against central differences of the elements' r, at t = .3. */
static void check_slopes(struct fixture *f, unsigned which)
{
    static double K[MOST * MOST], C[MOST * MOST], dK[MOST * MOST], dC[MOST * MOST];
    const double e = 1e-5;
    const struct instant x = {.t = .3, .q = f->q, .v = f->v};
    double up[MOST], down[MOST];
    assert_int_equal(f->o->ops->slopes(f->o, K, C, &x, ALL, NULL), OK);
    for (int k = 0; k < f->n; k++) {
        double q[MOST], v[MOST], unit[MOST] = {0};
        struct instant y = {.t = .3, .q = q, .v = v};
        unit[k] = 1;
        memcpy(v, f->v, sizeof v);
        along(q, f, f->q, unit, e), added(up, f, &y);
        along(q, f, f->q, unit, -e), added(down, f, &y);
        for (int i = 0; i < f->n; i++) dK[i + f->n * k] = (up[i] - down[i]) / (2 * e);
        memcpy(q, f->q, sizeof q);
        v[k] = f->v[k] + e, added(up, f, &y);
        v[k] = f->v[k] - e, added(down, f, &y);
        for (int i = 0; i < f->n; i++) dC[i + f->n * k] = (up[i] - down[i]) / (2 * e);
    }
    if (which & OF_K) assert_true(all_near(K, dK, f->n * f->n, 1e-6));
    if (which & OF_C) assert_true(all_near(C, dC, f->n * f->n, 1e-7));
}

/* --- slopes ------------------------------------------------------------------------------------- */

static bool coordinate_laws(const struct model *m, const struct model_force *f)
{
    return f->type == FORCE_LAW && m->measure[f->measure].type == MEASURE_COORDINATE;
}

static bool point_laws(const struct model *m, const struct model_force *f)
{
    return f->type == FORCE_LAW && m->measure[f->measure].type != MEASURE_COORDINATE;
}

static bool bushings(const struct model *m, const struct model_force *f)
{
    (void)m;
    return f->type == FORCE_BETWEEN;
}

static void slopes_of_laws_on_coordinates(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        open_tree(&f, space, 6, seed, 0);
        keep_forces(&f, coordinate_laws);
        start(&f);
        check_slopes(&f, OF_K | OF_C);
        close_tree(&f);
    }
}

/* Damping is exact for all elements at any state. */
static void damping_of_all_elements(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        open_tree(&f, space, 6, seed, 0);
        start(&f);
        check_slopes(&f, OF_C);
        close_tree(&f);
    }
}

/* Where a law along points, axes or angles pulls and pushes nothing, its K is exact. */
static void slopes_of_unloaded_measures(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        open_tree(&f, space, 6, seed, 0);
        keep_forces(&f, point_laws);
        start(&f);
        memset(f.v, 0, sizeof f.v);
        assert_int_equal(system_evaluate(f.s, f.q, f.v, 0, EVALUATE_MOTION, NULL), OK);
        for (int i = 0; i < f.m->nforce; i++) {
            struct spring *par = (struct spring *)f.m->force[i].par;
            double rate;
            system_measure(f.s, &par->rest, &rate, f.m->force[i].measure);
            par->preload = 0;
        }
        start(&f);
        check_slopes(&f, OF_K);
        close_tree(&f);
    }
}

/* Bushings carry nothing in the drawn position. */
static void slopes_of_unloaded_bushings(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        open_tree(&f, space, 6, seed, 0);
        keep_forces(&f, bushings);
        memset(f.q, 0, sizeof f.q);
        memset(f.v, 0, sizeof f.v);
        for (int i = 0; i < f.m->ncoordinate; i++) {
            const struct model_coordinate *c = &f.m->coordinate[i];
            if (c->iv < 0 && c->k == f.m->joint[c->joint].nq - 4) f.q[c->iq] = 1;
        }
        start(&f);
        check_slopes(&f, OF_K | OF_C);
        close_tree(&f);
    }
}

/* Two free bodies held at their centres by a pulled spring: the rows do not turn, so K with the string's
 * tautness is exact. */
static void slopes_of_a_taut_spring(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        open_tree(&f, space, 3, seed, TREE_ADRIFT);
        at_the_centres(&f);
        struct model_measure *s = TAKE(f.arena, struct model_measure, 1);
        struct spring *par = TAKE(f.arena, struct spring, 1);
        struct model_force *force = TAKE(f.arena, struct model_force, 1);
        *s = (struct model_measure){.type = MEASURE_DISTANCE, .a = {.body = 1}, .b = {.body = seed % 2 ? 2 : 0}};
        *par = (struct spring){.k = 30, .rest = .1, .cubic = seed % 3 ? 7 : 0};
        *force = (struct model_force){.type = FORCE_LAW, .cls = SLOW, .kind = &force_spring, .par = par};
        f.m->measure = s, f.m->nmeasure = 1, f.m->force = force, f.m->nforce = 1;
        memset(f.v, 0, sizeof f.v);
        start(&f);
        check_slopes(&f, OF_K);
        close_tree(&f);
    }
}

/* --- values and loads that read the state -------------------------------------------------------- */

static const char *const slot_names[] = {"t", "a", "b", "c", "d"};

static int find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)value, (void)error;
    for (int i = 0; i < 5; i++)
        if (strcmp(name, slot_names[i]) == 0) return *slot = i, 0;
    return 1;
}

static struct signal formula(struct arena *arena, const char *text)
{
    const struct expr_names names = {.find = find, .self = NULL};
    struct expr_error error;
    struct expr *e;
    assert_int_equal(expr_parse(&e, text, strlen(text), &names, arena, &error), 0);
    return (struct signal){.expr = e};
}

/* a: a position, b: a rate, c: a distance, d: its rate. */
static const struct model_slot *slots(struct fixture *f, int iq, int iv)
{
    struct model_slot *slot = TAKE(f->arena, struct model_slot, 5);
    int distance = 0;
    while (f->m->measure[distance].type != MEASURE_DISTANCE) distance++;
    slot[0] = (struct model_slot){SLOT_TIME, 0};
    slot[1] = (struct model_slot){SLOT_Q, iq};
    slot[2] = (struct model_slot){SLOT_V, iv};
    slot[3] = (struct model_slot){SLOT_MEASURE, distance};
    slot[4] = (struct model_slot){SLOT_MEASURE_RATE, distance};
    return slot;
}

/* A value along a coordinate that reads others: unsymmetric, exact; also parts of quaternions. */
static void slopes_of_values(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        open_tree(&f, space, 6, seed, 0);
        struct model_force *force = TAKE(f.arena, struct model_force, f.m->nq);
        int row = 0;
        while (f.m->measure[row].type == MEASURE_COORDINATE) row++;
        if (row == 0) {
            close_tree(&f);
            continue;
        }
        for (int i = 0; i < f.m->nq; i++)
            force[i] = (struct model_force){.type = FORCE_VALUE,
                                            .cls = SLOW,
                                            .measure = i % row,
                                            .nslot = 5,
                                            .slot = slots(&f, i, i % f.m->n),
                                            .value = {formula(f.arena, "t*a^2 - 3*sin(b) + a*c + 2*d + c^2")}};
        f.m->force = force, f.m->nforce = f.m->nq;
        memset(f.v, 0, sizeof f.v); /* how a distance's rate varies with position is left out */
        start(&f);
        check_slopes(&f, OF_K | OF_C);
        close_tree(&f);
    }
}

/* Loads that are 0 now and depend on the state: exact. */
static void slopes_of_loads(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        open_tree(&f, space, 6, seed, 0);
        struct model_force *force = TAKE(f.arena, struct model_force, 4);
        const int iq = (int)seed % f.m->nq;
        char text[80];
        snprintf(text, sizeof text, "a - %.17g + 2*b + d*t", f.q[iq]);
        memset(f.v, 0, sizeof f.v);
        for (int i = 0; i < 4; i++) {
            force[i] = (struct model_force){.type = FORCE_LOAD,
                                            .measure = -1,
                                            .cls = SLOW,
                                            .nslot = 5,
                                            .slot = slots(&f, iq, 0),
                                            .torque = i & 1,
                                            .body_axes = i & 2,
                                            .b = {.body = 6, .p = {.3, -.4, 0}}};
            for (int k = 0; k < 3; k++)
                if (space == 3 || (k == 2) == force[i].torque) force[i].value[k] = formula(f.arena, text);
        }
        f.m->force = force, f.m->nforce = 4;
        start(&f);
        check_slopes(&f, OF_K | OF_C);
        close_tree(&f);
    }
}

/* A load's rows are force times partial velocity, its power force times velocity. */
static void loads_act_where_they_stand(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        for (int kind = 0; kind < 4; kind++) {
            struct fixture f;
            struct model_force load = {.type = FORCE_LOAD,
                                       .measure = -1,
                                       .cls = FAST,
                                       .torque = kind & 1,
                                       .body_axes = kind & 2,
                                       .nslot = 1,
                                       .b = {.body = 5, .p = {.3, -.7, 0}}};
            const struct model_slot clock = {SLOT_TIME, 0};
            double r[MOST], want[MOST] = {0}, w[POWER_CHANNELS], F[3] = {0}, x[3], xv[3], power = 0;
            open_tree(&f, space, 5, seed, 0);
            load.slot = &clock;
            if (space == 3) load.b.p[2] = .5;
            const char *const text[3] = {"1 + t", "2*t - 3", "5*t"};
            for (int k = 0; k < 3; k++)
                if (space == 3 || (k == 2) == load.torque)
                    load.value[k] = formula(f.arena, text[k]), F[k] = expr_value(load.value[k].expr, (double[]){.3});
            f.m->force = &load, f.m->nforce = 1;
            start(&f);
            const struct sweep_ops *ops = space == 2 ? &sweep_planar : &sweep_spatial;
            struct sweep *s = ops->build(f.m, FOR_STEPS, NULL, f.arena);
            struct pose b;
            ops->move(s, f.q, f.v, ALL);
            ops->point(s, x, xv, 5, load.b.p);
            ops->pose(s, &b, 5);
            if (load.body_axes) {
                double turned[3];
                tree_mv(turned, b.R, F);
                memcpy(F, turned, sizeof F);
            }
            for (int k = 0; k < f.n; k++) {
                double pv[3], pw[3];
                ops->partial(s, pv, pw, 5, x, k);
                for (int c = 0; c < 3; c++) want[k] -= F[c] * (load.torque ? pw[c] : pv[c]);
                power -= want[k] * f.v[k];
            }
            const struct instant at = {.t = .3, .q = f.q, .v = f.v};
            added(r, &f, &at);
            assert_true(all_near(r, want, f.n, 1e-12));
            assert_int_equal(f.o->ops->resid(f.o, r, w, NULL, &at, ALL, NULL), OK);
            assert_true(all_near(&w[POWER_EXTERNAL], &power, 1, 1e-12));
            assert_true(w[POWER_DAMPER] == 0);
            close_tree(&f);
        }
    }
}

/* --- intervals ----------------------------------------------------------------------------------- */

static bool stores(const struct model *m, const struct model_force *f)
{
    (void)m;
    return f->type == FORCE_BETWEEN || (f->type == FORCE_LAW && f->kind->stored);
}

static void without_damping(struct fixture *f)
{
    for (int i = 0; i < f->m->nforce; i++) {
        if (f->m->force[i].type == FORCE_BETWEEN) {
            struct bushing *b = (struct bushing *)f->m->force[i].par;
            memset(b->c, 0, sizeof b->c), memset(b->cr, 0, sizeof b->cr);
        } else {
            ((struct spring *)f->m->force[i].par)->c = 0;
        }
    }
}

static double elastic(struct fixture *f, const double *q)
{
    struct energies e;
    assert_int_equal(system_energy_at(f->s, &e, q, f->v, 0, &(struct trouble){0}), OK);
    return e.elastic;
}

/* Over a finite interval passed at its middle with v: r.v h is the change of the stored energy, to round-off, for all
 * springs and bushings at once; the correction is of second order in h. */
static void work_is_the_change_of_stored_energy(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double size[2] = {0, 0};
        open_tree(&f, space, 5, seed, 0);
        keep_forces(&f, stores);
        without_damping(&f);
        start(&f);
        for (int half = 0; half < 2; half++) {
            double h = half ? .01 : .02, qa[MOST], qb[MOST], r[MOST], point[MOST], work = 0;
            along(qa, &f, f.q, f.v, -.5 * h);
            along(qb, &f, f.q, f.v, .5 * h);
            const struct instant x = {
                .t = .3, .q = f.q, .v = f.v, .qa = qa, .qb = qb, .ta = .3 - h / 2, .tb = .3 + h / 2};
            const struct instant y = {.t = .3, .q = f.q, .v = f.v};
            added(r, &f, &x);
            added(point, &f, &y);
            for (int i = 0; i < f.n; i++) {
                work += h * r[i] * f.v[i];
                size[half] = fmax(size[half], fabs(r[i] - point[i]));
            }
            double a = elastic(&f, qa), b = elastic(&f, qb);
            if (!(fabs(work - (b - a)) < 1e-12 * (fabs(a) + fabs(b) + 1)))
                fail_msg("space %d seed %u h %g: work %.15g, stored %.15g", space, seed, h, work, b - a);
        }
        /* a joint coordinate's cubic springs and the rest alike: second order */
        if (size[0] > 1e-6) assert_true(size[0] / size[1] > 3 && size[0] / size[1] < 5.5);
        close_tree(&f);
    }
}

/* The interval with no length, and no motion, is the point. */
static void a_short_interval_is_the_point(void **state)
{
    (void)state;
    EVERY_TREE(space, seed)
    {
        struct fixture f;
        double r[MOST], point[MOST];
        open_tree(&f, space, 5, seed, 0);
        start(&f);
        const struct instant x = {.t = .3, .q = f.q, .v = f.v, .qa = f.q, .qb = f.q, .ta = .3, .tb = .3};
        const struct instant y = {.t = .3, .q = f.q, .v = f.v};
        added(r, &f, &x);
        added(point, &f, &y);
        assert_true(all_near(r, point, f.n, 1e-12));
        close_tree(&f);
    }
}

/* K of a law that is not linear, over an interval that starts at qa: qb = 2 q - qa moves along. */
static void slope_of_the_difference_quotient(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        static double K[MOST * MOST], dK[MOST * MOST];
        double qa[MOST], qb[MOST], r[2][MOST], q[MOST], e = 1e-5;
        open_tree(&f, 2, 5, seed, 0);
        keep_forces(&f, coordinate_laws);
        start(&f);
        memset(f.v, 0, sizeof f.v);
        struct instant x = {.t = .3, .q = q, .v = f.v, .qa = qa, .qb = qb, .ta = 0, .tb = .6};
        memcpy(q, f.q, sizeof q);
        for (int i = 0; i < f.n; i++) qa[i] = f.q[i] - .1 - .01 * i, qb[i] = 2 * f.q[i] - qa[i];
        assert_int_equal(f.o->ops->slopes(f.o, K, NULL, &x, ALL, NULL), OK);
        for (int k = 0; k < f.n; k++) {
            for (int side = 0; side < 2; side++) {
                q[k] = f.q[k] + (side ? e : -e), qb[k] = 2 * q[k] - qa[k];
                added(r[side], &f, &x);
            }
            q[k] = f.q[k], qb[k] = 2 * q[k] - qa[k];
            for (int i = 0; i < f.n; i++) dK[i + f.n * k] = (r[1][i] - r[0][i]) / (2 * e);
        }
        assert_true(all_near(K, dK, f.n * f.n, 1e-7));
        close_tree(&f);
    }
}

/* dk: 0 where slopes() stood, then the relative change of the stiffest law's slope. */
static void changing_slopes_are_announced(void **state)
{
    (void)state;
    struct fixture f;
    static double K[MOST * MOST];
    double r[MOST], dk, k0, k1;
    open_tree(&f, 2, 3, 2, TREE_REVOLUTE);
    struct spring par = {.k = 10, .cubic = 100};
    struct model_force force = {.type = FORCE_LAW, .cls = SLOW, .measure = 1, .kind = &force_spring, .par = &par};
    f.m->force = &force, f.m->nforce = 1;
    start(&f);
    struct instant x = {.q = f.q, .v = f.v};
    assert_int_equal(f.o->ops->slopes(f.o, K, NULL, &x, ALL, NULL), OK);
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, &dk, &x, ALL, NULL), OK);
    assert_true(dk == 0);
    k0 = 10 + 300 * f.q[1] * f.q[1];
    f.q[1] += .5;
    k1 = 10 + 300 * f.q[1] * f.q[1];
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, &dk, &x, ALL, NULL), OK);
    assert_true(fabs(dk - fabs(k1 - k0) / fmax(k0, k1)) < 1e-12);
    const double before = dk;
    x.looks = true; /* whoever watches does not move what dk is relative to */
    assert_int_equal(f.o->ops->slopes(f.o, K, NULL, &x, ALL, NULL), OK);
    x.looks = false;
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, &dk, &x, ALL, NULL), OK);
    assert_true(dk == before);
    assert_int_equal(f.o->ops->slopes(f.o, K, NULL, &x, ALL, NULL), OK);
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, &dk, &x, ALL, NULL), OK);
    assert_true(dk == 0);
    par.cubic = 0;
    start(&f);
    assert_int_equal(f.o->ops->resid(f.o, r, NULL, &dk, &x, ALL, NULL), OK);
    assert_true(dk == 0);
    close_tree(&f);
}

/* Points in one place have no direction; the force is none rather than not a number. */
static void points_in_one_place(void **state)
{
    (void)state;
    struct fixture f;
    double r[MOST];
    open_tree(&f, 2, 1, 1, TREE_ADRIFT);
    struct model_measure s = {
        .type = MEASURE_DISTANCE, .a = {.body = 1, .p = {.1, 0, 0}}, .b = {.body = 1, .p = {.1, 0, 0}}};
    struct spring par = {.k = 10, .rest = 1};
    struct model_force force = {.type = FORCE_LAW, .cls = SLOW, .kind = &force_spring, .par = &par};
    f.m->measure = &s, f.m->nmeasure = 1, f.m->force = &force, f.m->nforce = 1;
    start(&f);
    const struct instant x = {.q = f.q, .v = f.v};
    added(r, &f, &x);
    for (int i = 0; i < f.n; i++) assert_true(r[i] == 0);
    close_tree(&f);
}

/* --- the midpoint rule ---------------------------------------------------------------------------- */

/* One step: M dv/h + ... = 0 at the middle, q1 = q0 (+) h (v0 + dv/2); Newton until it stands still. */
static void midpoint(struct fixture *f, double h)
{
    static double M[MOST * MOST], K[MOST * MOST], C[MOST * MOST], J[MOST * MOST];
    const int n = f->n;
    double dv[MOST] = {0}, a[MOST], v[MOST], qm[MOST], qb[MOST], r[MOST];
    for (int it = 0; it < 30; it++) {
        struct instant x = {.q = qm, .v = v, .a = a, .qa = f->q, .qb = qb, .ta = 0, .tb = h};
        for (int i = 0; i < n; i++) v[i] = f->v[i] + .5 * dv[i], a[i] = dv[i] / h;
        along(qm, f, f->q, v, .5 * h);
        along(qb, f, f->q, v, h);
        assert_int_equal(f->o->ops->resid(f->o, r, NULL, NULL, &x, ALL, NULL), OK);
        assert_int_equal(f->o->ops->mass(f->o, M, qm, 0, ALL, NULL), OK);
        assert_int_equal(f->o->ops->slopes(f->o, K, C, &x, ALL, NULL), OK);
        for (int i = 0; i < n * n; i++) J[i] = M[i] / h + .5 * C[i] + .25 * h * K[i];
        gauss(J, r, n);
        double most = 0;
        for (int i = 0; i < n; i++) dv[i] -= r[i], most = fmax(most, fabs(r[i]));
        if (most < 1e-14) break;
    }
    for (int i = 0; i < n; i++) v[i] = f->v[i] + .5 * dv[i];
    along(f->q, f, f->q, v, h);
    for (int i = 0; i < n; i++) f->v[i] += dv[i];
}

static double total(struct fixture *f)
{
    struct energies e;
    assert_int_equal(system_energy_at(f->s, &e, f->q, f->v, 0, &(struct trouble){0}), OK);
    return e.kinetic + e.elastic + e.gravity;
}

/* Two particles on a stiff spring, linear and not, whirling through many radians: energy and both momenta kept. */
static void a_stiff_spring_keeps_energy(void **state)
{
    (void)state;
    for (int space = 2; space <= 3; space++) {
        for (int cubic = 0; cubic < 2; cubic++) {
            struct fixture f;
            open_tree(&f, space, 2, 4, TREE_ADRIFT | TREE_FREE_FALL);
            at_the_centres(&f);
            struct model_measure s = {.type = MEASURE_DISTANCE, .a = {.body = 1}, .b = {.body = 2}};
            struct spring par = {.k = 1e4, .cubic = cubic ? 1e5 : 0};
            struct model_force force = {.type = FORCE_LAW, .cls = SLOW, .kind = &force_spring, .par = &par};
            double P[6], P0[6];
            f.m->measure = &s, f.m->nmeasure = 1, f.m->force = &force, f.m->nforce = 1;
            start(&f);
            double rate;
            assert_int_equal(system_evaluate(f.s, f.q, f.v, 0, EVALUATE_MOTION, NULL), OK);
            system_measure(f.s, &par.rest, &rate, 0);
            par.rest *= .98;
            start(&f);
            /* bodies that do not turn: their own rotation is not the spring's matter */
            for (int j = 0; j < 2; j++)
                for (int k = space; k < f.m->joint[j].nv; k++) f.v[f.m->joint[j].iv[k]] = 0;
            if (space == 2) f.v[f.m->joint[0].iv[2]] = f.v[f.m->joint[1].iv[2]] = 0;
            double E0 = total(&f), E = E0, wander = 0;
            assert_int_equal(system_evaluate(f.s, f.q, f.v, 0, EVALUATE_MOTION, NULL), OK);
            system_momentum(f.s, P0, P0 + 3);
            for (int step = 0; step < 300; step++) {
                midpoint(&f, .01);
                E = total(&f);
                wander = fmax(wander, fabs(E - E0));
            }
            assert_int_equal(system_evaluate(f.s, f.q, f.v, 0, EVALUATE_MOTION, NULL), OK);
            system_momentum(f.s, P, P + 3);
            assert_true(wander < 1e-12 * E0);
            for (int i = 0; i < 6; i++) assert_true(fabs(P[i] - P0[i]) < 1e-11);
            close_tree(&f);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_of_laws_on_coordinates),
        cmocka_unit_test(damping_of_all_elements),
        cmocka_unit_test(slopes_of_unloaded_measures),
        cmocka_unit_test(slopes_of_unloaded_bushings),
        cmocka_unit_test(slopes_of_a_taut_spring),
        cmocka_unit_test(slopes_of_values),
        cmocka_unit_test(slopes_of_loads),
        cmocka_unit_test(loads_act_where_they_stand),
        cmocka_unit_test(work_is_the_change_of_stored_energy),
        cmocka_unit_test(a_short_interval_is_the_point),
        cmocka_unit_test(slope_of_the_difference_quotient),
        cmocka_unit_test(changing_slopes_are_announced),
        cmocka_unit_test(points_in_one_place),
        cmocka_unit_test(a_stiff_spring_keeps_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
