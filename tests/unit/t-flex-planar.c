/* t-flex-planar.c -- the planar kernel of a flexible body against sums over its particles, and against Lagrange's
 * equations of its own kinetic energy by differences. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "flex/planar.h"
#include "la/dense.h"
#include "unit/particles.h"

#include <cmocka.h>

enum { SEEDS = 30 };

static void near(double x, double y, double tolerance)
{
    if (!(fabs(x - y) <= tolerance * (1 + fabs(y)))) fail_msg("%.17g is not %.17g", x, y);
}

struct fixture {
    struct arena *arena;
    struct cloud *cloud;
    struct flex_planar *k;
    struct flex_planar_shape shape;
    int n;
    double v[2], a[2], w, al, q[MODES], q1[MODES], q2[MODES]; /* v, a: velocity of the origin, its true acceleration */
};

/* affine: as a body in space is, whose second extent stands apart. */
static void open_body_of(struct fixture *f, unsigned seed, bool stiffening, bool affine)
{
    struct tree_dice d = {seed + 5};
    memset(f, 0, sizeof *f);
    f->arena = arena_open();
    f->n = (int)seed % (MODES + 1);
    f->cloud = random_cloud(&d, f->n, stiffening, f->arena);
    f->cloud->body.affine = affine;
    f->k = flex_planar_build(&f->cloud->body, f->arena);
    flex_planar_shape_take(&f->shape, f->k, f->arena);
    for (int c = 0; c < 2; c++) f->v[c] = tree_roll(&d, -1, 1), f->a[c] = tree_roll(&d, -3, 3);
    f->w = tree_roll(&d, -2, 2), f->al = tree_roll(&d, -3, 3);
    for (int i = 0; i < f->n; i++)
        f->q[i] = tree_roll(&d, -1, 1), f->q1[i] = tree_roll(&d, -1, 1), f->q2[i] = tree_roll(&d, -3, 3);
    flex_planar_shape_at(&f->shape, f->k, f->q);
}

static void open_body(struct fixture *f, unsigned seed, bool stiffening)
{
    open_body_of(f, seed, stiffening, false);
}

/* Place, velocity and acceleration against the frame. */
static void relative(double *u, double *u1, double *u2, const struct particle *p, const struct fixture *f)
{
    for (int c = 0; c < 2; c++) {
        u[c] = p->x[c], u1[c] = u2[c] = 0;
        for (int i = 0; i < f->n; i++) {
            double phi = p->phi[c + 2 * i];
            u[c] += phi * f->q[i], u1[c] += phi * f->q1[i], u2[c] += phi * f->q2[i];
            for (int j = 0; j < f->n; j++) {
                double S = p->S[c + 2 * (i + f->n * j)];
                u[c] += .5 * S * f->q[i] * f->q[j];
                u1[c] += S * f->q[i] * f->q1[j];
                u2[c] += S * (f->q1[i] * f->q1[j] + f->q[i] * f->q2[j]);
            }
        }
    }
}

/* F, N, Q by d'Alembert: the forces that every particle takes. */
static void explicit_inertia(double *F, double *N, double *Q, const struct fixture *f)
{
    F[0] = F[1] = *N = 0;
    memset(Q, 0, sizeof *Q * MODES);
    for (int i = 0; i < PARTICLES; i++) {
        const struct particle *p = &f->cloud->p[i];
        double u[2], u1[2], u2[2], g[2], w = f->w, al = f->al;
        relative(u, u1, u2, p, f);
        g[0] = p->m * (f->a[0] - al * u[1] - w * w * u[0] - 2 * w * u1[1] + u2[0]);
        g[1] = p->m * (f->a[1] + al * u[0] - w * w * u[1] + 2 * w * u1[0] + u2[1]);
        for (int k = 0; k < f->n; k++) al += p->psi[k] * f->q2[k];
        F[0] += g[0], F[1] += g[1];
        *N += u[0] * g[1] - u[1] * g[0] + p->j * al;
        for (int k = 0; k < f->n; k++) Q[k] += p->phi[2 * k] * g[0] + p->phi[1 + 2 * k] * g[1] + p->j * al * p->psi[k];
    }
}

static double explicit_kinetic(const struct fixture *f)
{
    double T = 0;
    for (int i = 0; i < PARTICLES; i++) {
        const struct particle *p = &f->cloud->p[i];
        double u[2], u1[2], u2[2], w = f->w;
        relative(u, u1, u2, p, f);
        double x = f->v[0] - f->w * u[1] + u1[0], y = f->v[1] + f->w * u[0] + u1[1];
        for (int k = 0; k < f->n; k++) w += p->psi[k] * f->q1[k];
        T += .5 * p->m * (x * x + y * y) + .5 * p->j * w * w;
    }
    return T;
}

static void inertia_is_the_sum_over_particles(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double F[2], N, Q[MODES], F0[2], N0, Q0[MODES];
        open_body(&f, seed, false);
        flex_planar_inertia(F, &N, Q, f.k, &f.shape, f.a, f.w, f.al, f.q1, f.q2);
        explicit_inertia(F0, &N0, Q0, &f);
        for (int c = 0; c < 2; c++) near(F[c], F0[c], 1e-13);
        near(N, N0, 1e-13);
        for (int k = 0; k < f.n; k++) near(Q[k], Q0[k], 1e-13);
        near(flex_planar_kinetic(f.k, &f.shape, f.v, f.w, f.q1), explicit_kinetic(&f), 1e-13);
        arena_close(f.arena);
    }
}

/* With S the first moment and J miss terms of third order in q, G of second. */
static void shortening_is_right_to_its_order(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        const double small = 1e-4;
        double h[2] = {0, 0}, J = 0, G[MODES] = {0};
        open_body(&f, seed, true);
        for (int k = 0; k < f.n; k++) f.q[k] *= small;
        flex_planar_shape_at(&f.shape, f.k, f.q);
        for (int i = 0; i < PARTICLES; i++) {
            const struct particle *p = &f.cloud->p[i];
            double u[2], u1[2], u2[2];
            relative(u, u1, u2, p, &f);
            for (int c = 0; c < 2; c++) h[c] += p->m * u[c], J += p->m * u[c] * u[c];
            J += p->j;
            for (int k = 0; k < f.n; k++) {
                double d[2];
                for (int c = 0; c < 2; c++) {
                    d[c] = p->phi[c + 2 * k];
                    for (int j = 0; j < f.n; j++) d[c] += p->S[c + 2 * (k + f.n * j)] * f.q[j];
                }
                G[k] += p->m * (u[0] * d[1] - u[1] * d[0]) + p->j * p->psi[k];
            }
        }
        for (int c = 0; c < 2; c++) near(f.shape.h[c], h[c], 50 * small * small * small);
        near(f.shape.J, J, 50 * small * small * small);
        double Me[MODES * MODES], U[3 * MODES];
        flex_planar_mass(Me, U, f.k, &f.shape);
        for (int k = 0; k < f.n; k++) near(U[3 * k], G[k], 50 * small * small);
        arena_close(f.arena);
    }
}

/* --- Lagrange ------------------------------------------------------------------------------------ */

/* Momenta p = dT/dv, L = dT/dw, dT/dq', which are linear in v, w, q': T is a square. */
static void momenta(double *p, struct fixture *f, const double *q, const double *v, double w, const double *q1)
{
    double x[3 + MODES] = {v[0], v[1], w}, y[3 + MODES];
    memcpy(x + 3, q1, sizeof *q1 * (size_t)f->n);
    flex_planar_shape_at(&f->shape, f->k, q);
    for (int i = 0; i < 3 + f->n; i++) {
        double T[2];
        for (int s = 0; s < 2; s++) {
            memcpy(y, x, sizeof y);
            y[i] += s ? 1 : -1;
            T[s] = flex_planar_kinetic(f->k, &f->shape, y, y[2], y + 3);
        }
        p[i] = .5 * (T[1] - T[0]);
    }
}

/* The momenta a little later: v' = a - w J v in the turning axes. */
static void momenta_at(double *p, struct fixture *f, double t)
{
    double q[MODES], q1[MODES];
    double v[2] = {f->v[0] + t * (f->a[0] + f->w * f->v[1]), f->v[1] + t * (f->a[1] - f->w * f->v[0])};
    for (int k = 0; k < f->n; k++) {
        q[k] = f->q[k] + t * f->q1[k] + .5 * t * t * f->q2[k];
        q1[k] = f->q1[k] + t * f->q2[k];
    }
    momenta(p, f, q, v, f->w + t * f->al, q1);
}

/* F = p' + w J p, N = L' + v x p, Q = d/dt dT/dq' - dT/dq. */
static void inertia_is_lagrange(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        const double e = 1e-4;
        double F[2], N, Q[MODES], p[3 + MODES], up[3 + MODES], down[3 + MODES], rate[3 + MODES];
        open_body(&f, seed, true);
        flex_planar_inertia(F, &N, Q, f.k, &f.shape, f.a, f.w, f.al, f.q1, f.q2);
        momenta_at(p, &f, 0);
        momenta_at(up, &f, e);
        momenta_at(down, &f, -e);
        for (int i = 0; i < 3 + f.n; i++) rate[i] = (up[i] - down[i]) / (2 * e);
        near(F[0], rate[0] - f.w * p[1], 1e-6);
        near(F[1], rate[1] + f.w * p[0], 1e-6);
        near(N, rate[2] + f.v[0] * p[1] - f.v[1] * p[0], 1e-6);
        for (int k = 0; k < f.n; k++) {
            double T[2];
            for (int s = 0; s < 2; s++) {
                double q[MODES];
                memcpy(q, f.q, sizeof q);
                q[k] += s ? e : -e;
                flex_planar_shape_at(&f.shape, f.k, q);
                T[s] = flex_planar_kinetic(f.k, &f.shape, f.v, f.w, f.q1);
            }
            near(Q[k], rate[3 + k] - (T[1] - T[0]) / (2 * e), 1e-6);
        }
        arena_close(f.arena);
    }
}

static void mass_matrix_is_the_energy(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        const double rest[2] = {0, 0};
        double T = 0;
        open_body(&f, seed, true);
        double Me[MODES * MODES], U[3 * MODES], w = f.w;
        flex_planar_mass(Me, U, f.k, &f.shape);
        for (int i = 0; i < f.n; i++)
            for (int j = 0; j <= i; j++) T += (i == j ? .5 : 1) * f.q1[i] * f.q1[j] * Me[i + f.n * j];
        near(T, flex_planar_kinetic(f.k, &f.shape, rest, 0, f.q1), 1e-13);
        T += .5 * f.shape.J * w * w;
        for (int i = 0; i < f.n; i++) T += w * U[3 * i] * f.q1[i];
        near(T, flex_planar_kinetic(f.k, &f.shape, rest, w, f.q1), 1e-13);
        arena_close(f.arena);
    }
}

/* The energy is a square: positive however large q is, with second-order displacements, too. */
static void mass_matrix_is_positive(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        enum { MOST = 3 + MODES };
        double M[MOST * MOST], U[3 * MODES], Me[MODES * MODES];
        open_body(&f, seed, true);
        const int n = 3 + f.n;
        for (int k = 0; k < f.n; k++) f.q[k] *= 10;
        flex_planar_shape_at(&f.shape, f.k, f.q);
        flex_planar_mass(Me, U, f.k, &f.shape);
        memset(M, 0, sizeof M);
        M[0] = M[1 + n] = f.cloud->body.mass;
        M[2] = -f.shape.h[1], M[2 + n] = f.shape.h[0], M[2 + 2 * n] = f.shape.J;
        for (int k = 0; k < f.n; k++) {
            M[3 + k] = U[3 * k + 1], M[3 + k + n] = U[3 * k + 2], M[3 + k + 2 * n] = U[3 * k];
            for (int i = k; i < f.n; i++) M[3 + i + n * (3 + k)] = Me[i + f.n * k];
        }
        assert_true(dense_cholesky(M, n, n) < 0);
        arena_close(f.arena);
    }
}

/* Q at q + dq, q1 + dq1 along coordinate j. */
static void rows_at(double *Q, struct fixture *f, int j, double dq, double dq1)
{
    double F[2], N, q[MODES], q1[MODES];
    memcpy(q, f->q, sizeof q), memcpy(q1, f->q1, sizeof q1);
    q[j] += dq, q1[j] += dq1;
    flex_planar_shape_at(&f->shape, f->k, q);
    flex_planar_inertia(F, &N, Q, f->k, &f->shape, f->a, f->w, f->al, q1, f->q2);
}

/* By central differences: exact with q', of which the rows are of second degree, but for round-off. */
static void slopes_are_differences(void **state)
{
    static const double STEP = 1e-4;
    (void)state;
    for (unsigned seed = 0; seed < 3 * SEEDS; seed++) {
        struct fixture f;
        double F[2], N, Q[MODES], K[MODES * MODES] = {0}, C[MODES * MODES] = {0}, a[MODES], b[MODES];
        open_body_of(&f, seed, seed % 3 > 0, seed % 3 == 2);
        flex_planar_inertia(F, &N, Q, f.k, &f.shape, f.a, f.w, f.al, f.q1, f.q2);
        flex_planar_slopes(K, C, f.k, &f.shape, f.q1, f.q2);
        for (int j = 0; j < f.n; j++)
            for (int rate = 0; rate < 2; rate++) {
                const double h = rate ? 1 : STEP, *slope = (rate ? C : K) + f.n * j;
                rows_at(a, &f, j, rate ? 0 : -h, rate ? -h : 0);
                rows_at(b, &f, j, rate ? 0 : h, rate ? h : 0);
                for (int i = 0; i < f.n; i++) near(slope[i], (b[i] - a[i]) / (2 * h), rate ? 1e-12 : 1e-6);
            }
        arena_close(f.arena);
    }
}

static void elastic_forces_are_the_products(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        open_body(&f, seed, false);
        struct flex_body diagonal = f.cloud->body, *bodies[2] = {&f.cloud->body, &diagonal};
        diagonal.K = TAKE(f.arena, double, f.n *f.n);
        for (int i = 0; i < f.n; i++) diagonal.K[i + f.n * i] = f.cloud->body.K[i + f.n * i];
        for (int b = 0; b < 2; b++) {
            const struct flex_body *o = bodies[b];
            double Q[MODES];
            for (int i = 0; i < f.n; i++) Q[i] = f.q2[i];
            flex_planar_elastic(Q, flex_planar_build(o, f.arena), f.q, f.q1);
            for (int i = 0; i < f.n; i++) {
                double sum = f.q2[i];
                for (int j = 0; j < f.n; j++)
                    sum += o->K[i + f.n * j] * f.q[j] + (o->D ? o->D[i + f.n * j] * f.q1[j] : 0);
                near(Q[i], sum, 1e-13);
            }
        }
        arena_close(f.arena);
    }
}

/* A node moves as a particle with its fields does. */
static void nodes_move_like_particles(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        open_body(&f, seed, seed % 2);
        for (int i = 0; i < NODES; i++) {
            const struct flex_node *node = &f.cloud->body.node[i];
            struct flex_planar_place o;
            struct particle p = {.x = {node->x[0], node->x[1]}};
            double u[2], u1[2], u2[2], turn[3] = {0, 0, 0};
            for (int k = 0; k < f.n; k++) {
                for (int c = 0; c < 2; c++) p.phi[c + 2 * k] = node->phi[c + 3 * k];
                turn[0] += node->psi[2 + 3 * k] * f.q[k];
                turn[1] += node->psi[2 + 3 * k] * f.q1[k];
                turn[2] += node->psi[2 + 3 * k] * f.q2[k];
            }
            for (int k = 0; node->S && k < f.n * f.n; k++)
                for (int c = 0; c < 2; c++) p.S[c + 2 * k] = node->S[c + 3 * k];
            flex_planar_place_take(&o, f.k, i, f.arena);
            flex_planar_place_at(&o, f.k, i, f.q);
            flex_planar_place_move(&o, f.k, f.q1);
            flex_planar_place_bias(&o, f.k, i, f.q1);
            flex_planar_place_accelerate(&o, f.k, f.q2);
            relative(u, u1, u2, &p, &f);
            for (int c = 0; c < 2; c++) {
                near(o.x[c], u[c], 1e-14);
                near(o.v[c], u1[c], 1e-14);
                near(o.a[c], u2[c], 1e-14);
            }
            near(o.angle, turn[0], 1e-14);
            near(o.w, turn[1], 1e-14);
            near(o.al, turn[2], 1e-14);
            if (i == 0) assert_true(o.x[0] == node->x[0] && o.x[1] == node->x[1] && o.angle == 0);
        }
        arena_close(f.arena);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inertia_is_the_sum_over_particles),
        cmocka_unit_test(shortening_is_right_to_its_order),
        cmocka_unit_test(inertia_is_lagrange),
        cmocka_unit_test(mass_matrix_is_the_energy),
        cmocka_unit_test(mass_matrix_is_positive),
        cmocka_unit_test(slopes_are_differences),
        cmocka_unit_test(elastic_forces_are_the_products),
        cmocka_unit_test(nodes_move_like_particles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
