/* t-planar-modes.c -- the planar recursion with flexible bodies against itself: Lagrange's equations of its energies,
 * differences of its positions, rigid bodies, dense algebra. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "unit/grove.h"
#include "unit/near.h"

#include <cmocka.h>

/* --- Lagrange ------------------------------------------------------------------------------------- */

static double kinetic(struct fixture *f, const double *q, const double *v)
{
    double T, V;
    sweep_planar.move(f->s, q, v, ALL);
    sweep_planar.energy(f->s, &T, &V);
    return T;
}

static double gravity(struct fixture *f, const double *q)
{
    double T, V;
    sweep_planar.move(f->s, q, f->v, ALL);
    sweep_planar.energy(f->s, &T, &V);
    return V;
}

static void mass_is_the_polar_form_of_the_energy(void **state)
{
    (void)state;
    static double M[MOST * MOST], X[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        open_grove(&f, 6, seed, GROVE_STIFFENING);
        for (int a = 0; a < f.n; a++)
            for (int b = 0; b < f.n; b++) {
                double u[MOST] = {0}, w[MOST] = {0};
                u[a] += 1, u[b] += 1;
                w[a] += 1, w[b] -= 1;
                X[a + f.n * b] = .5 * (kinetic(&f, f.q, u) - kinetic(&f, f.q, w));
            }
        sweep_planar.mass(f.s, M, f.q, ALL);
        assert_true(all_near(M, X, f.n * f.n, 1e-13));
        arena_close(f.arena);
    }
}

/* d/dt (M v) + K q + D q' - dT/dq + dV/dq */
static void resid_is_lagrange(void **state)
{
    (void)state;
    static double M[MOST * MOST], Mup[MOST * MOST], Mdown[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST], x[MOST] = {0}, up[MOST], down[MOST], e = 1e-5;
        open_grove(&f, 5, seed, GROVE_STIFFENING);
        int n = f.n;
        sweep_resid(r, &f, f.a, ALL);
        for (int i = 0; i < n; i++) up[i] = f.q[i] + e * f.v[i], down[i] = f.q[i] - e * f.v[i];
        sweep_planar.mass(f.s, Mup, up, ALL);
        sweep_planar.mass(f.s, Mdown, down, ALL);
        sweep_planar.mass(f.s, M, f.q, ALL);
        elastic_rows(x, &f);
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < n; j++)
                x[i] += M[i + n * j] * f.a[j] + (Mup[i + n * j] - Mdown[i + n * j]) / (2 * e) * f.v[j];
            memcpy(up, f.q, sizeof up), up[i] += e;
            memcpy(down, f.q, sizeof down), down[i] -= e;
            x[i] -= (kinetic(&f, up, f.v) - kinetic(&f, down, f.v)) / (2 * e);
            x[i] += (gravity(&f, up) - gravity(&f, down)) / (2 * e);
        }
        assert_true(all_near(r, x, n, 1e-7));
        arena_close(f.arena);
    }
}

/* d/dt (T + V) + q' (K q + D q') = v . r along a motion. */
static void power_is_the_rate_of_energy(void **state)
{
    (void)state;
    static const double c[4] = {1, -8, 8, -1}, at[4] = {-2, -1, 1, 2};
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST], elastic[MOST] = {0}, power = 0, rate = 0, e = 1e-3;
        open_grove(&f, 5, seed, GROVE_STIFFENING);
        sweep_resid(r, &f, f.a, ALL);
        elastic_rows(elastic, &f);
        for (int i = 0; i < f.n; i++) power += f.v[i] * r[i], rate += f.v[i] * elastic[i];
        for (int s = 0; s < 4; s++) {
            double q[MOST], v[MOST], T, V, t = at[s] * e;
            for (int i = 0; i < f.n; i++) {
                v[i] = f.v[i] + t * f.a[i];
                q[i] = f.q[i] + t * f.v[i] + .5 * t * t * f.a[i];
            }
            sweep_planar.move(f.s, q, v, ALL);
            sweep_planar.energy(f.s, &T, &V);
            rate += c[s] * (T + V) / (12 * e);
        }
        assert_true(all_near(&power, &rate, 1, 1e-8));
        arena_close(f.arena);
    }
}

/* --- the other functions ---------------------------------------------------------------------------- */

static void resid_is_affine(void **state)
{
    (void)state;
    static double M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        for (enum rate cls = FAST; cls <= ALL; cls++) {
            struct fixture f;
            double r[MOST], x[MOST], again[MOST];
            open_grove(&f, 8, seed, GROVE_STIFFENING | GROVE_FAST);
            sweep_resid(r, &f, f.a, cls);
            sweep_resid(x, &f, NULL, cls);
            sweep_planar.mass(f.s, M, f.q, ALL); /* leaves composites that another class must not find */
            sweep_planar.mass(f.s, M, f.q, cls);
            for (int i = 0; i < f.n; i++)
                for (int j = 0; j < f.n; j++) x[i] += M[i + f.n * j] * f.a[j];
            assert_true(all_near(r, x, f.n, 1e-12));
            sweep_resid(again, &f, f.a, cls);
            assert_memory_equal(r, again, sizeof *r * (size_t)f.n);
            arena_close(f.arena);
        }
    }
}

static void classes_add_up(void **state)
{
    (void)state;
    static double M[3][MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[3][MOST];
        open_grove(&f, 8, seed, GROVE_STIFFENING | GROVE_FAST);
        for (enum rate cls = FAST; cls <= ALL; cls++) {
            sweep_resid(r[cls - 1], &f, f.a, cls);
            sweep_planar.mass(f.s, M[cls - 1], f.q, cls);
        }
        for (int i = 0; i < f.n; i++) {
            if (i < f.m->ns) assert_true(r[1][i] == 0);
            r[0][i] += r[1][i];
        }
        for (int i = 0; i < f.n * f.n; i++) M[0][i] += M[1][i];
        assert_true(all_near(r[0], r[2], f.n, 1e-12));
        assert_true(all_near(M[0], M[2], f.n * f.n, 1e-12));
        arena_close(f.arena);
    }
}

/* By differences of point() and pose(); and the path holds those that move the body. */
static void partials_are_differences(void **state)
{
    (void)state;
    const double p[3] = {.3, -.7, 0}, e = 1e-5;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        open_grove(&f, 6, seed, GROVE_STIFFENING);
        for (int k = 0; k < f.n; k++)
            for (int i = 0; i < f.m->nbody; i++) {
                struct pose b[2];
                double q[MOST], x[3], xv[3], y[2][3], pv[3], pw[3], d[3];
                bool on_path = false;
                const int *path;
                for (int s = 0; s < 2; s++) {
                    memcpy(q, f.q, sizeof q);
                    q[k] += s ? e : -e;
                    sweep_planar.move(f.s, q, f.v, ALL);
                    sweep_planar.point(f.s, y[s], xv, i, p);
                    sweep_planar.pose(f.s, &b[s], i);
                }
                for (int c = 0; c < 3; c++) d[c] = (y[1][c] - y[0][c]) / (2 * e);
                sweep_planar.move(f.s, f.q, f.v, ALL);
                sweep_planar.point(f.s, x, xv, i, p);
                sweep_planar.partial(f.s, pv, pw, i, x, k);
                assert_true(all_near(pv, d, 3, 1e-8));
                assert_true(all_near(pw, (double[]){0, 0, (b[1].angle - b[0].angle) / (2 * e)}, 3, 1e-8));
                for (int j = sweep_planar.path(f.s, &path, i) - 1; j >= 0; j--) on_path = on_path || path[j] == k;
                if (!on_path) assert_true(pv[0] == 0 && pv[1] == 0 && pw[2] == 0);
            }
        arena_close(f.arena);
    }
}

/* Velocities and accelerations by differences along a motion. */
static void motion_is_the_derivative(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double e = 1e-4;
        open_grove(&f, 6, seed, GROVE_STIFFENING);
        for (int i = 1; i < f.m->nbody; i++) {
            struct pose b[3];
            for (int s = 0; s < 3; s++) {
                double q[MOST], v[MOST], t = (s - 1) * e;
                for (int k = 0; k < f.n; k++) {
                    v[k] = f.v[k] + t * f.a[k];
                    q[k] = f.q[k] + t * f.v[k] + .5 * t * t * f.a[k];
                }
                sweep_planar.forward(f.s, q, v, f.a, ALL);
                sweep_planar.pose(f.s, &b[s], i);
            }
            for (int c = 0; c < 2; c++) {
                assert_true(all_near(&b[1].v[c], (double[]){(b[2].r[c] - b[0].r[c]) / (2 * e)}, 1, 1e-5));
                assert_true(all_near(&b[1].a[c], (double[]){(b[2].v[c] - b[0].v[c]) / (2 * e)}, 1, 1e-5));
            }
            assert_true(all_near(&b[1].w[2], (double[]){(b[2].angle - b[0].angle) / (2 * e)}, 1, 1e-7));
            assert_true(all_near(&b[1].al[2], (double[]){(b[2].w[2] - b[0].w[2]) / (2 * e)}, 1, 1e-7));
        }
        arena_close(f.arena);
    }
}

/* A push of f at x and a twist of n give the rows -(x' f + w n) per unit velocity. */
static void pushes_do_work(void **state)
{
    (void)state;
    const double x[3] = {.4, .2, 0}, force[3] = {3, -2, 0}, n[3] = {0, 0, 1.5};
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        open_grove(&f, 6, seed, GROVE_STIFFENING);
        for (int body = 1; body < f.m->nbody; body++) {
            double r0[MOST], r[MOST] = {0}, pv[3], pw[3];
            sweep_resid(r0, &f, f.a, ALL);
            sweep_planar.forward(f.s, f.q, f.v, f.a, ALL);
            sweep_planar.push(f.s, body, x, force);
            sweep_planar.twist(f.s, body, n);
            sweep_planar.backward(f.s, r, ALL);
            for (int k = 0; k < f.n; k++) {
                sweep_planar.partial(f.s, pv, pw, body, x, k);
                r[k] += pv[0] * force[0] + pv[1] * force[1] + pw[2] * n[2];
            }
            assert_true(all_near(r, r0, f.n, 1e-12));
        }
        arena_close(f.arena);
    }
}

/* The same tree with every flexible body rigid moves and weighs the same while the modes rest. */
static void modes_at_rest_are_a_rigid_body(void **state)
{
    (void)state;
    static double M[MOST * MOST], X[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST], x[MOST];
        bool mode[MOST] = {0};
        open_grove(&f, 6, seed, GROVE_STIFFENING);
        struct model rigid = *f.m;
        struct model_body *body = TAKE(f.arena, struct model_body, f.m->nbody);
        for (int i = 0; i < f.m->nbody; i++) {
            body[i] = f.m->body[i];
            body[i].flex = NULL, body[i].nmode = 0, body[i].at_node = false;
            for (int k = 0; k < f.m->body[i].nmode; k++) mode[f.m->body[i].mode_v[k]] = true;
        }
        rigid.body = body;
        struct sweep *s = sweep_planar.build(&rigid, FOR_RECORDS, NULL, f.arena);
        for (int k = 0; k < f.n; k++)
            if (mode[k]) f.q[k] = f.v[k] = f.a[k] = 0;
        sweep_resid(r, &f, f.a, ALL);
        memset(x, 0, sizeof x);
        sweep_planar.forward(s, f.q, f.v, f.a, ALL);
        sweep_planar.backward(s, x, ALL);
        sweep_planar.mass(f.s, M, f.q, ALL);
        sweep_planar.mass(s, X, f.q, ALL);
        for (int a = 0; a < f.n; a++) {
            if (mode[a]) r[a] = x[a] = 0;
            for (int b = 0; b < f.n; b++)
                if (mode[a] || mode[b]) M[a + f.n * b] = X[a + f.n * b] = 0;
        }
        assert_true(all_near(r, x, f.n, 1e-13));
        assert_true(all_near(M, X, f.n * f.n, 1e-13));
        arena_close(f.arena);
    }
}

/* Some coordinates are held: their d is infinite, and the dense system is without their rows and columns. */
static void articulated_bodies_solve_the_dense_system(void **state)
{
    (void)state;
    static double M[MOST * MOST];
    for (unsigned seed = 0; seed < 2 * SEEDS; seed++) {
        struct fixture f;
        struct tree_dice dice = {seed};
        double d[MOST], x[MOST], b[MOST], y[MOST], cm = .7;
        open_grove(&f, 8, seed, GROVE_STIFFENING | (seed % 3 ? 0 : GROVE_CHAIN));
        int n = f.n;
        void *F = arena_take(f.arena, 1, sweep_planar.factor_size(f.s));
        for (int i = 0; i < n; i++) {
            bool held = seed % 2 && tree_pick(&dice, 5) == 0;
            d[i] = held ? INFINITY : tree_roll(&dice, 0, 5);
            b[i] = x[i] = tree_roll(&dice, -1, 1);
        }
        sweep_planar.forward(f.s, f.q, f.v, NULL, ALL);
        assert_true(sweep_planar.factor(f.s, F, cm, d, seed % 4 < 2 ? f.q : NULL, ALL));
        sweep_planar.move(f.s, f.v, f.q, ALL); /* elsewhere: the factor stands by itself */
        sweep_planar.solve(f.s, F, x);
        sweep_planar.mass(f.s, M, f.q, ALL);
        for (int i = 0; i < n; i++) {
            if (isinf(d[i])) assert_true(x[i] == 0);
            y[i] = isinf(d[i]) ? b[i] : d[i] * x[i];
            for (int j = 0; j < n; j++)
                if (!isinf(d[i])) y[i] += cm * M[i + n * j] * x[j];
        }
        assert_true(all_near(y, b, n, 1e-10));
        arena_close(f.arena);
    }
}

/* Modes that move nothing need something stiff that holds them. */
static void massless_modes_have_no_pivot(void **state)
{
    (void)state;
    int bodies = 0;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double d[MOST] = {0};
        open_grove(&f, 1, seed, 0);
        const struct model_body *body = &f.m->body[1];
        if (body->nmode && f.m->joint[0].nv == 1) {
            const int n = body->nmode;
            struct flex_body *o = &f.grove->cloud[1]->body;
            memset(o->f, 0, sizeof *o->f * 3 * (size_t)n);
            memset(o->xf, 0, sizeof *o->xf * 9 * (size_t)n);
            memset(o->ff, 0, sizeof *o->ff * 9 * (size_t)(n * n));
            memset(o->rpsi, 0, sizeof *o->rpsi * 3 * (size_t)n);
            memset(o->ppsi, 0, sizeof *o->ppsi * (size_t)(n * n));
            struct sweep *s = sweep_planar.build(f.m, FOR_RECORDS, NULL, f.arena);
            void *F = arena_take(f.arena, 1, sweep_planar.factor_size(s));
            assert_false(sweep_planar.factor(s, F, 1, d, f.q, ALL));
            for (int k = 0; k < n; k++) d[body->mode_v[k]] = 1;
            assert_true(sweep_planar.factor(s, F, 1, d, f.q, ALL));
            bodies++;
        }
        arena_close(f.arena);
    }
    assert_true(bodies > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mass_is_the_polar_form_of_the_energy),
        cmocka_unit_test(resid_is_lagrange),
        cmocka_unit_test(power_is_the_rate_of_energy),
        cmocka_unit_test(resid_is_affine),
        cmocka_unit_test(classes_add_up),
        cmocka_unit_test(partials_are_differences),
        cmocka_unit_test(motion_is_the_derivative),
        cmocka_unit_test(pushes_do_work),
        cmocka_unit_test(modes_at_rest_are_a_rigid_body),
        cmocka_unit_test(articulated_bodies_solve_the_dense_system),
        cmocka_unit_test(massless_modes_have_no_pivot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
