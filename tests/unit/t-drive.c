/* t-drive.c -- drives of random trees and linkages against an independent formulation.
 *
 * The mechanism of absolute.h in absolute coordinates is solved as (2-3) with all joints and drives,
 *
 *     [M J'; J 0] [a; lambda] = [Q; -C''],   C'' = (J v)_x v + 2 J_t v + C_tt.
 *
 * Velocities must satisfy J v + C_t = 0; accelerations and drive forces must agree; reactions and drive forces must
 * add up to what the bodies need.  At a corner of the drives' tables the impulses are
 *
 *     [M J'; J 0] [dv; p] = [0; dc'],
 *
 * and the work is what the kinetic energy gains. */
#include "unit/absolute.h"

#include "engine/accel.h"

/* --- the comparison ---------------------------------------------------------------------------------- */

struct figures {
    int done, closed, still, refused, once, met[4];
    double worst, force, balance, rate, power;
    unsigned seed;
};

static void add_reaction(double *F, const struct place *p, int body, const double *x, const double *f, const double *n,
                         double sign)
{
    double arm[3], moment[3];
    for (int i = 0; i < 3; i++) arm[i] = x[i] - p[body].r[i];
    cross(moment, arm, f);
    for (int i = 0; body && i < 3; i++) {
        F[6 * (body - 1) + i] += sign * f[i];
        F[6 * (body - 1) + 3 + i] += sign * (n[i] + moment[i]);
    }
}

/* Reactions of all joints, and drive forces along their measures, against m (a - g) and I al + w x I w. */
static double unbalanced(const struct mechanism *o, const struct system *s, const struct place *p, const double *a,
                         int joint_rows)
{
    const struct model *m = &o->model;
    double F[6 * MOST_BODIES] = {0}, worst = 0, most = 1, f[3], n[3], x[3], power, force;
    for (int i = 0; i < o->njoint; i++) {
        const struct any_joint *j = &o->joint[i];
        bool loop = i >= m->njoint;
        double sign = !loop && m->joint[i].reversed ? -1 : 1;
        if (loop)
            system_loop_reaction(s, f, n, i - m->njoint);
        else
            system_reaction(s, f, n, i);
        const int on = sign < 0 ? j->A : j->B; /* the deck's second body */
        tree_mv(x, p[on].R, sign < 0 ? m->joint[i].a : j->b);
        for (int k = 0; k < 3; k++) x[k] += p[on].r[k], most = fmax(most, fmax(fabs(f[k]), fabs(n[k])));
        add_reaction(F, p, j->B, x, f, n, sign);
        add_reaction(F, p, j->A, x, f, n, -sign);
    }
    for (int k = 0; k < m->ndrive; k++) {
        system_drive(s, &force, &power, m->nloop - m->ndrive + k);
        for (int i = 0; i < 6 * (m->nbody - 1); i++) F[i] += force * J[joint_rows + k][i];
        most = fmax(most, fabs(force));
    }
    for (int b = 1; b < m->nbody; b++) {
        double I[9], gyro[3], N[3];
        const double *y = a + 6 * (b - 1), *g = F + 6 * (b - 1);
        tensor(I, &m->body[b], p[b].R);
        gyroscopic(gyro, I, p[b].w);
        tree_mv(N, I, y + 3);
        for (int k = 0; k < 3; k++) {
            bool in_plane = m->space == 3 || k < 2, turns = m->space == 3 || k == 2;
            if (in_plane) worst = fmax(worst, fabs(g[k] - m->body[b].mass * (y[k] - m->gravity[k])));
            if (turns) worst = fmax(worst, fabs(g[3 + k] - N[k] - gyro[k]));
        }
    }
    return worst / most;
}

/* What explicit schemes are told of the drives' power, which depends on the accelerations: as a rule by one evaluation. */
static void compare_power(struct figures *g, struct system *s, const double *q, const double *v, double t,
                          double expected)
{
    const struct ode2 *ode = system_ode2(s);
    struct arena *arena = arena_open();
    struct effort effort = {0};
    struct accel accel;
    struct trouble why;
    double w[POWER_CHANNELS], *a = TAKE(arena, double, ode->n);
    accel_open(&accel, ode, &effort, arena);
    assert_int_equal(accel_solve(&accel, a, w, q, v, t, &why), OK);
    g->power = fmax(g->power, fabs(w[POWER_DRIVE] - expected) / fmax(1, fabs(expected)));
    g->once += effort.slow == 1;
    arena_close(arena);
}

static void compare(struct figures *g, const struct mechanism *o, struct system *s, const double *q, const double *v,
                    double t, bool unique, unsigned seed)
{
    const struct model *m = &o->model;
    struct place p[MOST_BODIES];
    struct trouble why;
    struct pose pose;
    double x[MOST], C1[MOST_ROWS], C2[MOST_ROWS], worst = 0, most = 10, speed = 1, force, power, all = 0;
    assert_int_equal(system_evaluate(s, q, v, t, EVALUATE_ALL, &why), OK);
    stand(p, s, m->nbody);
    int rows = rates(C1, C2, o, p, t), lambda = 6 * (m->nbody - 1) + rows - m->ndrive;
    for (int b = 1; b < m->nbody; b++)
        for (int k = 0; k < 3; k++) speed = fmax(speed, fmax(fabs(p[b].v[k]), fabs(p[b].w[k])));
    for (int i = 0; i < rows; i++) g->rate = fmax(g->rate, fabs(C1[i]) / speed);
    assert_true(augmented(x, o, p, C2, rows, t) < 1e-6 * speed * speed);
    for (int b = 1; b < m->nbody; b++) {
        system_pose(s, &pose, b);
        for (int k = 0; k < 3; k++) {
            const double *y = x + 6 * (b - 1);
            most = fmax(most, fmax(fabs(y[k]), fabs(y[3 + k])));
            worst = fmax(worst, fmax(fabs(pose.a[k] - y[k]), fabs(pose.al[k] - y[3 + k])));
        }
    }
    if (!(worst / most <= g->worst)) g->worst = worst / most, g->seed = seed;
    for (int k = 0; unique && k < m->ndrive; k++) {
        system_drive(s, &force, &power, m->nloop - m->ndrive + k);
        g->force = fmax(g->force, fabs(force + x[lambda + k]) / fmax(most, fabs(force)));
        double rate = o->c[m->nloop - m->ndrive + k][1] + 2 * t * o->c[m->nloop - m->ndrive + k][2];
        assert_true(fabs(power - force * rate) <= 1e-12 * fmax(1, fabs(force)));
        all += power;
    }
    if (unique && system_ode2(s)->n > 0) compare_power(g, s, q, v, t, all);
    g->balance = fmax(g->balance, unbalanced(o, s, p, x, rows - m->ndrive));
}

static void try_one(struct figures *g, int space, unsigned seed)
{
    static const double T = .1;
    struct arena *arena = arena_open();
    struct mechanism o;
    struct tree_dice dice = {seed ^ 0x5eedu}, *d = &dice;
    struct report report = {0};
    struct place drawn[MOST_BODIES] = {{.r = {0}}};
    make(&o, drawn, space, seed, false, arena);
    struct system *s = system_build(&o.model, arena);
    const struct ode2 *ode = system_ode2(s);
    const struct condense_start *start = condense_started(system_loops(s));
    double *q = TAKE(arena, double, ode->nq), *v = TAKE(arena, double, ode->n + 1),
           *dx = TAKE(arena, double, ode->n + 1);
    bool found = start->status == OK && system_start(s, q, v, &report) == OK;
    for (int i = 0; i < ode->n; i++) dx[i] = tree_roll(d, -.05, .05), v[i] = tree_roll(d, -1, 1);
    if (found) ode->move->point(ode, q, q, dx, 1, T);
    if (!found || !isfinite(q[0]) || condense_ratio(system_loops(s)) < 1e-2) { /* locks, contradicts, nearly singular */
        if (strstr(start->report.text, "contradicts")) assert_true(repeats(&o, drawn));
        g->refused++;
    } else {
        compare(g, &o, s, q, v, T, start->redundant == 0, seed);
        g->done++;
        g->closed += o.model.nloop > o.model.ndrive;
        g->still += ode->n == 0;
        for (int l = o.model.nloop - o.model.ndrive; l < o.model.nloop; l++)
            g->met[o.model.measure[o.loop[l].measure].type]++;
    }
    arena_close(arena);
}

static void mechanisms(int space)
{
    struct figures g = {0};
    for (unsigned seed = 1; g.done < 300 && seed < 2000; seed++) try_one(&g, space, seed);
    print_message("space %d: %d mechanisms, %d closed, %d without a freedom, %d refused; drives of coordinates %d, "
                  "distances %d, displacements %d, angles %d; accelerations differ %.2g (seed %u), drive forces %.2g, "
                  "balance %.2g, rates %.2g, powers %.2g, at once in %d\n",
                  space, g.done, g.closed, g.still, g.refused, g.met[MEASURE_COORDINATE], g.met[MEASURE_DISTANCE],
                  g.met[MEASURE_DISPLACEMENT], g.met[MEASURE_ANGLE], g.worst, g.seed, g.force, g.balance, g.rate,
                  g.power, g.once);
    assert_int_equal(g.done, 300);
    assert_true(g.closed > 50);
    assert_true(g.worst < 1e-8);
    assert_true(g.force < 1e-8);
    assert_true(g.balance < 1e-8);
    assert_true(g.rate < 1e-9);
    assert_true(g.power < 1e-8);
    assert_true(g.once > 100);
}

/* --- corners ------------------------------------------------------------------------------------------ */

/* x: what the bodies' velocities gain where the drives' rates jump by c2, and the impulses. */
static void impulses(double *x, const struct mechanism *o, const struct place *p)
{
    const struct model *m = &o->model;
    double C[MOST_ROWS];
    struct place still[MOST_BODIES];
    memcpy(still, p, sizeof still);
    const int rows = values(C, o, p, CORNER);
    memset(C, 0, sizeof C);
    for (int k = 0; k < m->ndrive; k++) C[rows - m->ndrive + k] = -o->c[m->nloop - m->ndrive + k][2];
    for (int b = 0; b < m->nbody; b++) memset(still[b].w, 0, sizeof still[b].w); /* impulses alone: no gyroscopic */
    struct mechanism light = *o;                                                 /* moments, no weight */
    memset(light.model.gravity, 0, sizeof light.model.gravity);
    assert_true(augmented(x, &light, still, C, rows, CORNER) < 1e-9);
}

static double kinetic(struct system *s, const double *q, const double *v, double t)
{
    struct energies e;
    assert_int_equal(system_energy_at(s, &e, q, v, t, &(struct trouble){0}), OK);
    return e.kinetic;
}

static void try_corner(struct figures *g, int space, unsigned seed)
{
    struct arena *arena = arena_open();
    struct mechanism o;
    struct tree_dice dice = {seed ^ 0xc0ffeeu}, *d = &dice;
    struct report report = {0};
    struct trouble why;
    struct place drawn[MOST_BODIES] = {{.r = {0}}}, before[MOST_BODIES] = {{.r = {0}}}, after[MOST_BODIES];
    make(&o, drawn, space, seed, true, arena);
    struct system *s = system_build(&o.model, arena);
    const struct ode2 *ode = system_ode2(s);
    const struct condense_start *start = condense_started(system_loops(s));
    double *q = TAKE(arena, double, ode->nq), *v = TAKE(arena, double, ode->n + 1),
           *dx = TAKE(arena, double, ode->n + 1);
    double x[MOST], worst = 0, most = 1, work = 0;
    bool found = start->status == OK && start->redundant == 0 && system_start(s, q, v, &report) == OK && ode->n > 0;
    for (int i = 0; i < ode->n; i++) dx[i] = tree_roll(d, -.05, .05), v[i] = tree_roll(d, -1, 1);
    if (found) ode->move->point(ode, q, q, dx, 1, CORNER);
    if (found && isfinite(q[0]) && condense_ratio(system_loops(s)) > 1e-2) {
        int met;
        const double T = CORNER, behind = CORNER * (1 + 1e-12), energy = kinetic(s, q, v, T);
        assert_int_equal(system_evaluate(s, q, v, T, EVALUATE_MOTION, &why), OK);
        stand(before, s, o.model.nbody);
        impulses(x, &o, before);
        assert_int_equal(ode->breaks->jump(ode, &met, v, &work, q, T, 1.01 * T, &why), OK);
        assert_int_equal(met, 1);
        assert_int_equal(system_evaluate(s, q, v, behind, EVALUATE_MOTION, &why), OK);
        stand(after, s, o.model.nbody);
        for (int b = 1; b < o.model.nbody; b++)
            for (int k = 0; k < 3; k++) {
                const double *y = x + 6 * (b - 1);
                most = fmax(most, fmax(fabs(y[k]), fabs(y[3 + k])));
                worst = fmax(worst, fmax(fabs(after[b].v[k] - before[b].v[k] - y[k]),
                                         fabs(after[b].w[k] - before[b].w[k] - y[3 + k])));
            }
        if (!(worst / most <= g->worst)) g->worst = worst / most, g->seed = seed;
        g->balance = fmax(g->balance, fabs(work - (kinetic(s, q, v, behind) - energy)) / fmax(1, energy));
        assert_int_equal(ode->breaks->jump(ode, &met, v, &work, q, behind, 1.01 * T, &why), OK);
        assert_int_equal(met, 0); /* once */
        g->done++;
        g->closed += o.model.nloop > o.model.ndrive;
    }
    arena_close(arena);
}

static void corners(void **state)
{
    (void)state;
    for (int space = 2; space <= 3; space++) {
        struct figures g = {0};
        for (unsigned seed = 1; g.done < 200 && seed < 2000; seed++) try_corner(&g, space, seed);
        print_message("space %d: %d corners, %d in closed linkages; velocities differ %.2g (seed %u), work %.2g\n",
                      space, g.done, g.closed, g.worst, g.seed, g.balance);
        assert_int_equal(g.done, 200);
        assert_true(g.closed > 30);
        assert_true(g.worst < 1e-9);
        assert_true(g.balance < 1e-9);
    }
}

static void in_the_plane(void **state)
{
    (void)state;
    mechanisms(2);
}

static void in_space(void **state)
{
    (void)state;
    mechanisms(3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(in_the_plane), cmocka_unit_test(in_space),
                                       cmocka_unit_test(corners)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
