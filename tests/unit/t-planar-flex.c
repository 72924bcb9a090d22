/* t-planar-flex.c -- the planar recursion with flexible bodies against sums over all rigid bodies and particles, with
 * Jacobians by differences. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "la/dense.h"
#include "unit/grove.h"
#include "unit/near.h"

#include <complex.h>

#include <cmocka.h>

enum { ROWS = 3 * 16 * PARTICLES };

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
            assert_true(all_near(b.r, (double[]){creal(r[i]), cimag(r[i]), 0}, 3, 1e-13));
            assert_true(all_near(b.R, (double[]){cos(turn[i]), sin(turn[i])}, 2, 1e-13));
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
        assert_true(all_near(M, X, f.n * f.n, 1e-9));
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
        assert_true(all_near(r, x, f.n, 1e-8));
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
        assert_true(all_near((double[]){T, V}, (double[]){T0, V0}, 2, 1e-9));
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
        assert_true(all_near(rate, zero, 3, 1e-8));
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
            assert_true(all_near((double[]){got[0], got[1], n[2]}, F, 3, 1e-7));
        }
        arena_close(f.arena);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poses_are_the_places),
        cmocka_unit_test(mass_is_the_sum_over_particles),
        cmocka_unit_test(resid_is_the_sum_over_particles),
        cmocka_unit_test(energies_are_the_sums),
        cmocka_unit_test(a_tree_adrift_keeps_its_momenta),
        cmocka_unit_test(reactions_hold_what_is_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
