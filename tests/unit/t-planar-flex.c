/* t-planar-flex.c -- the planar recursion with flexible bodies, against sums over all rigid bodies and particles with
 * Jacobians by differences, and against Lagrange's equations of its own energies. */
#include <complex.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "la/dense.h"
#include "system/sweep.h"
#include "unit/particles.h"

#include <cmocka.h>

enum { MOST = 64, SEEDS = 40, ROWS = 3 * 16 * PARTICLES };

static void near_all(const double *x, const double *y, int n, double tolerance)
{
    double scale = 1;
    for (int i = 0; i < n; i++) scale = fmax(scale, fabs(y[i]));
    for (int i = 0; i < n; i++)
        if (!(fabs(x[i] - y[i]) <= tolerance * scale))
            fail_msg("entry %d: %.17g is not %.17g (scale %g)", i, x[i], y[i], scale);
}

struct fixture {
    struct arena *arena;
    struct grove *grove;
    struct model *m;
    struct sweep *s;
    int n;
    double q[MOST], v[MOST], a[MOST];
};

static void open_grove(struct fixture *f, int nbody, unsigned seed, unsigned flags)
{
    struct tree_dice d = {seed + 99};
    f->arena = arena_open();
    f->grove = random_grove(nbody, seed, flags, f->arena);
    f->m = &f->grove->m;
    f->s = sweep_planar.build(f->m, f->arena);
    f->n = f->m->n;
    assert_true(f->n <= MOST && nbody <= 16);
    memcpy(f->q, f->m->q0, sizeof *f->q * (size_t)f->n);
    memcpy(f->v, f->m->v0, sizeof *f->v * (size_t)f->n);
    for (int i = 0; i < f->n; i++) f->a[i] = tree_roll(&d, -3, 3);
}

static void sweep_resid(double *r, struct fixture *f, const double *a, enum rate cls)
{
    memset(r, 0, sizeof *r * (size_t)f->n);
    sweep_planar.forward(f->s, f->q, f->v, a, cls);
    sweep_planar.backward(f->s, r, cls);
}

/* --- an independent formulation: places as complex numbers, one after the other ------------------ */

/* Where the frames of all bodies stand and how they are turned. */
static void place(complex double *r, double *turn, const struct model *m, const double *q)
{
    r[0] = turn[0] = 0;
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &m->body[i];
        const struct model_joint *j = &m->joint[i - 1];
        const int p = b->parent, slides = j->type == JOINT_PRISMATIC ? 1 : j->type == JOINT_REVOLUTE ? 0 : 2;
        const double *E = j->Ea, *slide = j->type == JOINT_PRISMATIC ? E + 6 : E;
        complex double R = cexp(I * turn[p]), at = j->a[0] + I * j->a[1];
        if (b->at_node) {
            const struct model_body *o = &m->body[p];
            const struct flex_node *node = &o->flex->node[b->node];
            turn[i] = turn[p];
            at = node->x[0] + I * node->x[1];
            for (int k = 0; k < o->nmode; k++) {
                double qk = q[o->mode_q[k]];
                turn[i] += node->psi[2 + 3 * k] * qk;
                at += (node->phi[3 * k] + I * node->phi[1 + 3 * k]) * qk;
                for (int l = 0; node->S && l < o->nmode; l++) {
                    const double *S = node->S + 3 * (k + o->nmode * l);
                    at += .5 * (S[0] + I * S[1]) * qk * q[o->mode_q[l]];
                }
            }
            r[i] = r[p] + R * at;
            continue;
        }
        for (int k = 0; k < slides && j->nv; k++) at += (slide[3 * k] + I * slide[1 + 3 * k]) * q[j->iq[k]];
        turn[i] = turn[p] + atan2(E[1], E[0]) - atan2(j->Eb[1], j->Eb[0]);
        if (j->nv > slides) turn[i] += E[8] * q[j->iq[slides]];
        r[i] = r[p] + R * at - cexp(I * turn[i]) * (j->b[0] + I * j->b[1]);
    }
}

/* x, y and angle of every rigid body and particle, and what weighs them; returns how many numbers. */
static int configuration(double *X, double *weight, const struct fixture *f, const double *q)
{
    complex double r[MOST];
    double turn[MOST];
    int n = 0;
    place(r, turn, f->m, q);
    for (int i = 1; i < f->m->nbody; i++) {
        const struct model_body *b = &f->m->body[i];
        for (int k = 0; k < (b->flex ? PARTICLES : 1); k++) {
            const struct particle *p = b->flex ? &f->grove->cloud[i]->p[k] : NULL;
            complex double at = p ? p->x[0] + I * p->x[1] : 0;
            double angle = turn[i];
            for (int c = 0; p && c < b->nmode; c++) {
                at += (p->phi[2 * c] + I * p->phi[1 + 2 * c]) * q[b->mode_q[c]];
                angle += p->psi[c] * q[b->mode_q[c]];
            }
            at = r[i] + cexp(I * turn[i]) * at;
            weight[n] = weight[n + 1] = p ? p->m : b->mass;
            weight[n + 2] = p ? p->j : b->inertia[2];
            X[n++] = creal(at), X[n++] = cimag(at), X[n++] = angle;
        }
    }
    assert_true(n <= ROWS);
    return n;
}

/* First and second derivative of the configuration along u at q, by differences of fourth order. */
static int differences(double *d1, double *d2, double *weight, const struct fixture *f, const double *u)
{
    static const double c1[5] = {1, -8, 0, 8, -1}, c2[5] = {-1, 16, -30, 16, -1};
    const double e = 1e-3;
    double X[ROWS], q[MOST];
    int n = 0;
    memset(d1, 0, sizeof *d1 * ROWS);
    memset(d2, 0, sizeof *d2 * ROWS);
    for (int s = 0; s < 5; s++) {
        for (int k = 0; k < f->n; k++) q[k] = f->q[k] + (s - 2) * e * u[k];
        n = configuration(X, weight, f, q);
        for (int i = 0; i < n; i++) d1[i] += c1[s] * X[i] / (12 * e), d2[i] += c2[s] * X[i] / (12 * e * e);
    }
    return n;
}

struct jacobian {
    int n; /* rows */
    double J[MOST][ROWS], weight[ROWS];
};

static void jacobian(struct jacobian *o, const struct fixture *f)
{
    double unused[ROWS];
    for (int k = 0; k < f->n; k++) {
        double u[MOST] = {0};
        u[k] = 1;
        o->n = differences(o->J[k], unused, o->weight, f, u);
    }
}

static void elastic_rows(double *r, const struct fixture *f)
{
    for (int i = 1; i < f->m->nbody; i++) {
        const struct model_body *b = &f->m->body[i];
        for (int k = 0; k < b->nmode; k++)
            for (int j = 0; j < b->nmode; j++) {
                r[b->mode_v[k]] += b->flex->K[k + b->nmode * j] * f->q[b->mode_q[j]];
                if (b->flex->D) r[b->mode_v[k]] += b->flex->D[k + b->nmode * j] * f->v[b->mode_v[j]];
            }
    }
}

/* --- against it ----------------------------------------------------------------------------------- */

static void poses_are_the_places(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        complex double r[MOST];
        double turn[MOST];
        open_grove(&f, 6, seed, seed % 2 ? GROVE_STIFFENING : 0);
        place(r, turn, f.m, f.q);
        sweep_planar.move(f.s, f.q, f.v, ALL);
        for (int i = 1; i < f.m->nbody; i++) {
            struct pose b;
            sweep_planar.pose(f.s, &b, i);
            near_all(b.r, (double[]){creal(r[i]), cimag(r[i]), 0}, 3, 1e-13);
            near_all(b.R, (double[]){cos(turn[i]), sin(turn[i])}, 2, 1e-13);
        }
        arena_close(f.arena);
    }
}

static void mass_is_the_sum_over_particles(void **state)
{
    (void)state;
    static struct jacobian o;
    static double M[MOST * MOST], X[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        open_grove(&f, 6, seed, seed % 3 ? 0 : GROVE_CHAIN);
        jacobian(&o, &f);
        for (int a = 0; a < f.n; a++)
            for (int b = 0; b < f.n; b++) {
                X[a + f.n * b] = 0;
                for (int i = 0; i < o.n; i++) X[a + f.n * b] += o.J[a][i] * o.weight[i] * o.J[b][i];
            }
        sweep_planar.mass(f.s, M, f.q, ALL);
        near_all(M, X, f.n * f.n, 1e-9);
        for (int a = 0; a < f.n; a++)
            for (int b = 0; b < a; b++) assert_true(M[a + f.n * b] == M[b + f.n * a]);
        assert_int_equal(dense_cholesky(M, f.n, f.n), -1);
        arena_close(f.arena);
    }
}

/* J' W (J a + J' v - g) + K q + D q' */
static void resid_is_the_sum_over_particles(void **state)
{
    (void)state;
    static struct jacobian o;
    static double d1[ROWS], d2[ROWS];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST], x[MOST] = {0};
        open_grove(&f, 6, seed, seed % 3 ? 0 : GROVE_CHAIN);
        jacobian(&o, &f);
        differences(d1, d2, o.weight, &f, f.v);
        for (int i = 0; i < o.n; i++) {
            double acc = d2[i] - (i % 3 < 2 ? f.m->gravity[i % 3] : 0);
            for (int k = 0; k < f.n; k++) acc += o.J[k][i] * f.a[k];
            for (int k = 0; k < f.n; k++) x[k] += o.J[k][i] * o.weight[i] * acc;
        }
        elastic_rows(x, &f);
        sweep_resid(r, &f, f.a, ALL);
        near_all(r, x, f.n, 1e-8);
        arena_close(f.arena);
    }
}

static void energies_are_the_sums(void **state)
{
    (void)state;
    static double d1[ROWS], d2[ROWS], weight[ROWS], X[ROWS];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double T, V, T0 = 0, V0 = 0;
        open_grove(&f, 6, seed, 0);
        int n = differences(d1, d2, weight, &f, f.v);
        configuration(X, weight, &f, f.q);
        for (int i = 0; i < n; i++) {
            T0 += .5 * weight[i] * d1[i] * d1[i];
            if (i % 3 < 2) V0 -= weight[i] * f.m->gravity[i % 3] * X[i];
        }
        sweep_planar.move(f.s, f.q, f.v, ALL);
        sweep_planar.energy(f.s, &T, &V);
        near_all((double[]){T, V}, (double[]){T0, V0}, 2, 1e-9);
        arena_close(f.arena);
    }
}

/* Momentum and angular momentum of a tree adrift do not change whatever its modes and joints do. */
static void a_tree_adrift_keeps_its_momenta(void **state)
{
    (void)state;
    static double d1[ROWS], d2[ROWS], x1[ROWS], x2[ROWS], weight[ROWS], X[ROWS], M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST], rate[3] = {0, 0, 0}, zero[3] = {0, 0, 0}, size = 0;
        open_grove(&f, 5, seed, GROVE_ADRIFT);
        sweep_resid(r, &f, NULL, ALL);
        sweep_planar.mass(f.s, M, f.q, ALL);
        assert_int_equal(dense_cholesky(M, f.n, f.n), -1);
        dense_cholesky_solve(M, r, f.n, f.n);
        double most = 1;
        for (int i = 0; i < f.n; i++) most = fmax(most, fabs(r[i]));
        for (int i = 0; i < f.n; i++) r[i] /= -most; /* the size that steps of differences are made for */
        configuration(X, weight, &f, f.q);
        int n = differences(d1, d2, weight, &f, f.v); /* d2: accelerations by v */
        differences(x1, x2, weight, &f, r);           /* x1: by a */
        for (int i = 0; i < n; i++) d2[i] += most * x1[i];
        for (int i = 0; i < n; i += 3) {
            double Fx = weight[i] * d2[i], Fy = weight[i] * d2[i + 1];
            rate[0] += Fx, rate[1] += Fy;
            rate[2] += X[i] * Fy - X[i + 1] * Fx + weight[i + 2] * d2[i + 2];
            size += fabs(Fx) + fabs(Fy);
        }
        for (int c = 0; c < 3; c++) rate[c] /= 1 + size;
        near_all(rate, zero, 3, 1e-8);
        arena_close(f.arena);
    }
}

/* --- with shortening ------------------------------------------------------------------------------- */

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
        near_all(M, X, f.n * f.n, 1e-13);
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
        near_all(r, x, n, 1e-7);
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
        near_all(&power, &rate, 1, 1e-8);
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
            near_all(r, x, f.n, 1e-12);
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
        near_all(r[0], r[2], f.n, 1e-12);
        near_all(M[0], M[2], f.n * f.n, 1e-12);
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
                near_all(pv, d, 3, 1e-8);
                near_all(pw, (double[]){0, 0, (b[1].angle - b[0].angle) / (2 * e)}, 3, 1e-8);
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
                near_all(&b[1].v[c], (double[]){(b[2].r[c] - b[0].r[c]) / (2 * e)}, 1, 1e-5);
                near_all(&b[1].a[c], (double[]){(b[2].v[c] - b[0].v[c]) / (2 * e)}, 1, 1e-5);
            }
            near_all(&b[1].w[2], (double[]){(b[2].angle - b[0].angle) / (2 * e)}, 1, 1e-7);
            near_all(&b[1].al[2], (double[]){(b[2].w[2] - b[0].w[2]) / (2 * e)}, 1, 1e-7);
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
            near_all(r, r0, f.n, 1e-12);
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
        struct sweep *s = sweep_planar.build(&rigid, f.arena);
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
        near_all(r, x, f.n, 1e-13);
        near_all(M, X, f.n * f.n, 1e-13);
        arena_close(f.arena);
    }
}

static bool behind(const struct model *m, int i, int j)
{
    while (j > i) j = m->body[j].parent;
    return i == j;
}

/* Newton and Euler for all rigid bodies and particles behind a joint; free directions carry nothing. */
static void reactions_hold_what_is_behind(void **state)
{
    (void)state;
    static double d1[ROWS], d2[ROWS], x1[ROWS], x2[ROWS], weight[ROWS], X[ROWS];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST];
        open_grove(&f, 6, seed, 0);
        configuration(X, weight, &f, f.q);
        differences(d1, d2, weight, &f, f.v);
        differences(x1, x2, weight, &f, f.a);
        sweep_resid(r, &f, f.a, ALL);
        for (int j = 0; j < f.m->njoint; j++) {
            const struct model_joint *joint = &f.m->joint[j];
            double B[3], xv[3], got[3], n[3], F[3] = {0, 0, 0};
            int row = 0;
            if (joint->nv > 1) continue; /* nothing is carried */
            sweep_planar.point(f.s, B, xv, j + 1, joint->b);
            for (int i = 1; i < f.m->nbody; i++)
                for (int k = 0; k < (f.m->body[i].flex ? PARTICLES : 1); k++, row += 3) {
                    if (!behind(f.m, j + 1, i)) continue;
                    double g[3];
                    for (int c = 0; c < 3; c++) {
                        g[c] = d2[row + c] + x1[row + c] - (c < 2 ? f.m->gravity[c] : 0);
                        g[c] *= weight[row + c];
                    }
                    F[0] += g[0], F[1] += g[1];
                    F[2] += (X[row] - B[0]) * g[1] - (X[row + 1] - B[1]) * g[0] + g[2];
                }
            if (joint->type == JOINT_REVOLUTE) F[2] = 0;
            if (joint->type == JOINT_PRISMATIC) {
                struct pose p;
                sweep_planar.pose(f.s, &p, joint->parent);
                double axis[3], along;
                tree_mv(axis, p.R, joint->Ea + 6);
                along = axis[0] * F[0] + axis[1] * F[1];
                F[0] -= along * axis[0], F[1] -= along * axis[1];
            }
            sweep_planar.reaction(f.s, got, n, j);
            near_all((double[]){got[0], got[1], n[2]}, F, 3, 1e-7);
        }
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
        assert_true(sweep_planar.factor(f.s, F, cm, d, seed % 4 < 2 ? f.q : NULL));
        sweep_planar.move(f.s, f.v, f.q, ALL); /* elsewhere: the factor stands by itself */
        sweep_planar.solve(f.s, F, x);
        sweep_planar.mass(f.s, M, f.q, ALL);
        for (int i = 0; i < n; i++) {
            if (isinf(d[i])) assert_true(x[i] == 0);
            y[i] = isinf(d[i]) ? b[i] : d[i] * x[i];
            for (int j = 0; j < n; j++)
                if (!isinf(d[i])) y[i] += cm * M[i + n * j] * x[j];
        }
        near_all(y, b, n, 1e-10);
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
            struct sweep *s = sweep_planar.build(f.m, f.arena);
            void *F = arena_take(f.arena, 1, sweep_planar.factor_size(s));
            assert_false(sweep_planar.factor(s, F, 1, d, f.q));
            for (int k = 0; k < n; k++) d[body->mode_v[k]] = 1;
            assert_true(sweep_planar.factor(s, F, 1, d, f.q));
            bodies++;
        }
        arena_close(f.arena);
    }
    assert_true(bodies > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poses_are_the_places),
        cmocka_unit_test(mass_is_the_sum_over_particles),
        cmocka_unit_test(resid_is_the_sum_over_particles),
        cmocka_unit_test(energies_are_the_sums),
        cmocka_unit_test(a_tree_adrift_keeps_its_momenta),
        cmocka_unit_test(mass_is_the_polar_form_of_the_energy),
        cmocka_unit_test(resid_is_lagrange),
        cmocka_unit_test(power_is_the_rate_of_energy),
        cmocka_unit_test(resid_is_affine),
        cmocka_unit_test(classes_add_up),
        cmocka_unit_test(partials_are_differences),
        cmocka_unit_test(motion_is_the_derivative),
        cmocka_unit_test(pushes_do_work),
        cmocka_unit_test(modes_at_rest_are_a_rigid_body),
        cmocka_unit_test(reactions_hold_what_is_behind),
        cmocka_unit_test(articulated_bodies_solve_the_dense_system),
        cmocka_unit_test(massless_modes_have_no_pivot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
