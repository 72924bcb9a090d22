/* t-flex-spatial.c -- flexible bodies in the spatial recursion against clouds of particles.
 *
 * The other way: places of bodies are products of transforms, a node's with the Cayley map of its rotation, particles
 * stand where their fields put them; partial velocities are complex steps along each velocity, accelerations
 * differences of J(q) u along the motion; M = sum J' m J and r = sum J' (m (a - g)) over all particles and rigid
 * bodies.  With displacements linear in q this is exact; with curved ones and rotary inertia M, r and the energy
 * are held against each other. */
#include "flex/motion.h"
#include "system/system.h"
#include "tree/sweep.h"

#include "unit/bent.h"
#include "unit/near.h"
#include "unit/transforms.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { BODIES = 7, ALL_BODIES = 2 * BODIES + 1, MODES = 4, MOST = 10 * BODIES, MOST_Q = 11 * BODIES, SEEDS = 40 };

static const struct sweep_ops *ops = &sweep_spatial;

struct places {
    struct transform body[ALL_BODIES];
};

struct scene {
    struct arena *arena;
    struct bent tree;
    const struct model *m;
    struct sweep *s;
    double q[MOST_Q], v[MOST], a[MOST];
    double x[ALL_BODIES][3], f[ALL_BODIES][3], n[ALL_BODIES][3];
};

static void random_state(struct scene *o, struct tree_dice *d, double bend)
{
    tree_state(o->q, o->v, o->m, d);
    for (int i = 0; i < o->m->n; i++) o->a[i] = tree_roll(d, -3, 3);
    for (int b = 1; b < o->m->nbody; b++)
        for (int k = 0; k < o->m->body[b].nmode; k++) o->q[o->m->body[b].mode_q[k]] *= bend;
    for (int i = 1; i < o->m->nbody; i++) {
        tree_vector(o->x[i], d, 3);
        tree_vector(o->f[i], d, 3);
        tree_vector(o->n[i], d, 3);
    }
}

static void open_tree(struct scene *o, unsigned seed, unsigned flags, unsigned cloud_flags)
{
    struct tree_dice d = {seed + 77};
    o->arena = arena_open();
    o->tree = bent_tree(1 + (int)(seed % BODIES), MODES, seed, flags, cloud_flags, o->arena);
    o->m = o->tree.m;
    o->s = ops->build(o->m, FOR_RECORDS, NULL, o->arena);
    random_state(o, &d, cloud_flags & CLOUD_S ? .15 : .5);
}

static void open_scene(struct scene *o, unsigned seed, unsigned cloud_flags)
{
    open_tree(o, seed, (seed % 3 == 0 ? TREE_CHAIN : 0) | (seed % 2 ? TREE_FAST_LEAVES : 0), cloud_flags);
}

static void resid(double *r, struct scene *o, const double *v, const double *a, unsigned cls)
{
    memset(r, 0, sizeof *r * MOST);
    ops->forward(o->s, o->q, v, a, cls);
    ops->backward(o->s, r, cls);
}

/* ---- places, the other way ---- */

/* x + phi q, turned by the Cayley map of psi q: I + c ([t]x + [t]x^2/2), c = 1/(1 + t.t/4). */
static struct transform at_node(const struct flex_node *node, const double complex *q, const int *iq, int n)
{
    double complex t[3] = {0}, x[3] = {node->x[0], node->x[1], node->x[2]};
    for (int k = 0; k < n; k++)
        for (int c = 0; c < 3; c++) {
            double complex Sq = 0;
            for (int j = 0; node->S && j < n; j++) Sq += node->S[c + 3 * (k + n * j)] * q[iq[j]];
            t[c] += node->psi[c + 3 * k] * q[iq[k]];
            x[c] += (node->phi[c + 3 * k] + Sq / 2) * q[iq[k]];
        }
    double complex tt = t[0] * t[0] + t[1] * t[1] + t[2] * t[2], c = 1 / (1 + tt / 4);
    double complex W[3][3] = {{0, -t[2], t[1]}, {t[2], 0, -t[0]}, {-t[1], t[0], 0}};
    struct transform o = shift(x[0], x[1], x[2]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) o.T[i][j] += c * (W[i][j] + (t[i] * t[j] - (i == j) * tt) / 2);
    return o;
}

static void place(struct places *o, const struct model *m, const double complex *q)
{
    struct transform base, x;
    o->body[0] = times(shift(m->body[0].at[0], m->body[0].at[1], m->body[0].at[2]), turned(m->body[0].R));
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &m->body[i], *p = &m->body[b->parent];
        const struct model_joint *j = &m->joint[b->joint];
        if (b->at_node) {
            struct transform here = at_node(&p->flex->node[b->node], q, p->mode_q, p->nmode);
            o->body[i] = times(times(o->body[b->parent], here), times(turned(j->Ea), turned_back(j->Eb)));
        } else {
            o->body[i] = hang(&base, &x, o->body[b->parent], j, q);
        }
    }
}

/* Where x of the body's axes stands; T's velocity and angular velocity are in the imaginary parts. */
static void at_point(double complex *o, const struct transform *T, const double complex *x)
{
    for (int i = 0; i < 3; i++) {
        o[i] = T->T[i][3];
        for (int j = 0; j < 3; j++) o[i] += T->T[i][j] * x[j];
    }
}

static void spin(double *w, const struct transform *T)
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        w[i] = 0;
        for (int c = 0; c < 3; c++) w[i] += cimag(T->T[k][c]) / tiny * creal(T->T[j][c]);
    }
}

/* Places with the velocities u in the imaginary parts. */
static void moving(struct places *o, double complex *q1, const struct model *m, const double *q, const double *u)
{
    nudge(q1, m, q, u, tiny * _Complex_I);
    place(o, m, q1);
}

/* ---- mass points ---- */

/* What has mass: particles of clouds, centres of rigid bodies; x in the frame at q. */
static void particle_at(double complex *x, const struct model_body *b, const struct particle *p,
                        const double complex *q)
{
    const int n = b->nmode;
    for (int c = 0; c < 3; c++) {
        x[c] = p->x[c];
        for (int k = 0; k < n; k++) {
            double complex Sq = 0;
            for (int j = 0; j < n; j++) Sq += p->S[c + 3 * (k + n * j)] * q[b->mode_q[j]];
            x[c] += (p->phi[c + 3 * k] + Sq / 2) * q[b->mode_q[k]];
        }
    }
}

enum { POINTS = ALL_BODIES * CLOUD_PARTICLES };

struct mass_point {
    int body;
    double m, x[3], v[3]; /* v: velocity, or partial velocity */
};

struct rotor { /* a rigid body's turning */
    double w[3], J[3][3];
};

/* Everything that has mass with velocities u; returns how many points. */
static int see(struct mass_point *p, struct rotor *rotor, const struct scene *o, const double *q, const double *u)
{
    static struct places at;
    double complex q1[MOST_Q], x[3], none[3] = {0};
    int n = 0;
    moving(&at, q1, o->m, q, u);
    for (int b = 1; b < o->m->nbody; b++) {
        const struct model_body *body = &o->m->body[b];
        const struct cloud *cloud = o->tree.cloud[b];
        memset(&rotor[b], 0, sizeof rotor[b]);
        if (body->at_node) continue;
        for (int k = 0; k < (cloud ? CLOUD_PARTICLES : 1); k++, n++) {
            if (cloud) particle_at(x, body, &cloud->p[k], q1);
            double complex world[3];
            at_point(world, &at.body[b], cloud ? x : none);
            p[n].body = b, p[n].m = cloud ? cloud->p[k].m : body->mass;
            for (int i = 0; i < 3; i++) p[n].x[i] = creal(world[i]), p[n].v[i] = cimag(world[i]) / tiny;
        }
        if (cloud) continue;
        const double *I = body->inertia, B[3][3] = {{I[0], I[3], I[4]}, {I[3], I[1], I[5]}, {I[4], I[5], I[2]}};
        spin(rotor[b].w, &at.body[b]);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                for (int k = 0; k < 3; k++)
                    for (int l = 0; l < 3; l++)
                        rotor[b].J[i][j] += creal(at.body[b].T[i][k]) * B[k][l] * creal(at.body[b].T[j][l]);
    }
    return n;
}

/* Momentum of each point, and spin of each rigid body. */
static void momenta(double (*p)[3], double (*L)[3], const struct scene *o, double t)
{
    static struct mass_point point[POINTS];
    struct rotor rotor[ALL_BODIES];
    double complex q1[MOST_Q];
    double q[MOST_Q], u[MOST];
    nudge(q1, o->m, o->q, o->v, t);
    for (int k = 0; k < o->m->nq; k++) q[k] = creal(q1[k]);
    for (int k = 0; k < o->m->n; k++) u[k] = o->v[k] + t * o->a[k];
    int n = see(point, rotor, o, q, u);
    for (int k = 0; k < n; k++)
        for (int i = 0; i < 3; i++) p[k][i] = point[k].m * point[k].v[i];
    for (int b = 1; b < o->m->nbody; b++)
        for (int i = 0; i < 3; i++) {
            L[b][i] = 0;
            for (int j = 0; j < 3; j++) L[b][i] += rotor[b].J[i][j] * rotor[b].w[j];
        }
}

/* Their rates: the path need not be the motion's but to the first order. */
static void needed(double (*F)[3], double (*N)[3], const struct scene *o)
{
    static double p[4][POINTS][3], L[4][ALL_BODIES][3];
    const double h = 1e-3;
    for (int i = 0; i < 4; i++) momenta(p[i], L[i], o, (i < 2 ? i - 2 : i - 1) * h);
    for (int k = 0; k < POINTS; k++)
        for (int i = 0; i < 3; i++) F[k][i] = (8 * (p[2][k][i] - p[1][k][i]) - (p[3][k][i] - p[0][k][i])) / (12 * h);
    for (int k = 0; k < ALL_BODIES; k++)
        for (int i = 0; i < 3; i++) N[k][i] = (8 * (L[2][k][i] - L[1][k][i]) - (L[3][k][i] - L[0][k][i])) / (12 * h);
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* K q + D v of the coordinates. */
static void add_elastic(double *r, const struct scene *o)
{
    for (int b = 1; b < o->m->nbody; b++) {
        const struct model_body *body = &o->m->body[b];
        const int n = body->nmode;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                r[body->mode_v[i]] += body->flex->K[i + n * j] * o->q[body->mode_q[j]];
                if (body->flex->D) r[body->mode_v[i]] += body->flex->D[i + n * j] * o->v[body->mode_v[j]];
            }
    }
}

/* ---- tests ---- */

static void test_mass(void **state)
{
    (void)state;
    static struct mass_point J[MOST][POINTS];
    static struct rotor turn[MOST][ALL_BODIES];
    static double M[MOST * MOST], of_M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed, 0);
        const int n = o.m->n;
        int points = 0;
        for (int k = 0; k < n; k++) {
            double unit[MOST] = {0};
            unit[k] = 1;
            points = see(J[k], turn[k], &o, o.q, unit);
        }
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                double sum = 0;
                for (int p = 0; p < points; p++) sum += J[i][p].m * dot(J[i][p].v, J[j][p].v);
                for (int b = 1; b < o.m->nbody; b++)
                    for (int c = 0; c < 3; c++) sum += turn[i][b].w[c] * dot(turn[i][b].J[c], turn[j][b].w);
                of_M[i + n * j] = sum;
            }
        ops->mass(o.s, M, o.q, ALL);
        NEAR(M, of_M, n * n, 1e-12);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < i; j++) assert_true(M[i + n * j] == M[j + n * i]);
        arena_close(o.arena);
    }
}

static void push_all(struct scene *o)
{
    for (int i = 1; i < o->m->nbody; i++) {
        ops->push(o->s, i, o->x[i], o->f[i]);
        ops->twist(o->s, i, o->n[i]);
    }
}

/* With forces on all bodies, those at nodes too. */
static void test_residual(void **state)
{
    (void)state;
    static double F[POINTS][3], N[ALL_BODIES][3];
    static struct mass_point J[POINTS];
    static struct places at;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        struct rotor turn[ALL_BODIES];
        double r[MOST] = {0}, of_r[MOST] = {0};
        double complex q1[MOST_Q];
        open_scene(&o, seed, CLOUD_DAMPED);
        needed(F, N, &o);
        for (int k = 0; k < o.m->n; k++) {
            double unit[MOST] = {0};
            unit[k] = 1;
            int points = see(J, turn, &o, o.q, unit);
            for (int p = 0; p < points; p++) of_r[k] += dot(J[p].v, F[p]) - J[p].m * dot(J[p].v, o.m->gravity);
            moving(&at, q1, o.m, o.q, unit);
            for (int b = 1; b < o.m->nbody; b++) {
                double w[3], d[3], v[3];
                of_r[k] += dot(turn[b].w, N[b]);
                spin(w, &at.body[b]);
                for (int i = 0; i < 3; i++) d[i] = o.x[b][i] - creal(at.body[b].T[i][3]);
                for (int i = 0; i < 3; i++)
                    v[i] = cimag(at.body[b].T[i][3]) / tiny + w[(i + 1) % 3] * d[(i + 2) % 3] -
                           w[(i + 2) % 3] * d[(i + 1) % 3];
                of_r[k] -= dot(v, o.f[b]) + dot(w, o.n[b]);
            }
        }
        add_elastic(of_r, &o);
        ops->forward(o.s, o.q, o.v, o.a, ALL);
        push_all(&o);
        ops->backward(o.s, r, ALL);
        NEAR(r, of_r, o.m->n, 1e-9);
        arena_close(o.arena);
    }
}

/* Poses, points, partial velocities of all bodies. */
static void test_motion(void **state)
{
    (void)state;
    static struct places at;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        double complex q1[MOST_Q];
        open_scene(&o, seed, CLOUD_S);
        for (int motion = 0; motion < 2; motion++) {
            if (motion)
                ops->forward(o.s, o.q, o.v, o.a, ALL);
            else
                ops->move(o.s, o.q, o.v, ALL);
            moving(&at, q1, o.m, o.q, o.v);
            for (int b = 1; b < o.m->nbody; b++) {
                struct pose pose;
                double x[3], xv[3], of_x[3], of_v[3], w[3], R[9];
                double complex local[3] = {o.x[b][0], o.x[b][1], o.x[b][2]}, world[3];
                at_point(world, &at.body[b], local);
                spin(w, &at.body[b]);
                for (int i = 0; i < 3; i++) {
                    of_x[i] = creal(world[i]), of_v[i] = cimag(world[i]) / tiny;
                    for (int j = 0; j < 3; j++) R[i + 3 * j] = creal(at.body[b].T[i][j]);
                }
                ops->point(o.s, x, xv, b, o.x[b]);
                ops->pose(o.s, &pose, b);
                NEAR(x, of_x, 3, 1e-13);
                NEAR(xv, of_v, 3, 1e-12);
                NEAR(pose.R, R, 9, 1e-13);
                NEAR(pose.w, w, 3, 1e-12);
            }
        }
        arena_close(o.arena);
    }
}

/* The velocity of pose, differentiated along the motion. */
static void test_accelerations(void **state)
{
    (void)state;
    const double h = 1e-3;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        struct pose at[4][ALL_BODIES], pose;
        open_scene(&o, seed, CLOUD_S);
        for (int i = 0; i < 4; i++) {
            double complex q1[MOST_Q];
            double q[MOST_Q], u[MOST], t = (i < 2 ? i - 2 : i - 1) * h;
            nudge(q1, o.m, o.q, o.v, t);
            for (int k = 0; k < o.m->nq; k++) q[k] = creal(q1[k]);
            for (int k = 0; k < o.m->n; k++) u[k] = o.v[k] + t * o.a[k];
            for (int j = 0; j < o.m->njoint; j++) {
                const struct model_joint *joint = &o.m->joint[j];
                if (!tree_turns(joint, 3)) continue;
                double *x = q + joint->iq[joint->nq - 4], norm = 0;
                for (int k = 0; k < 4; k++) norm += x[k] * x[k];
                for (int k = 0; k < 4; k++) x[k] /= sqrt(norm);
            }
            ops->move(o.s, q, u, ALL);
            for (int b = 1; b < o.m->nbody; b++) ops->pose(o.s, &at[i][b], b);
        }
        ops->forward(o.s, o.q, o.v, o.a, ALL);
        for (int b = 1; b < o.m->nbody; b++) {
            double a[3], al[3];
            ops->pose(o.s, &pose, b);
            for (int c = 0; c < 3; c++) {
                a[c] = (8 * (at[2][b].v[c] - at[1][b].v[c]) - (at[3][b].v[c] - at[0][b].v[c])) / (12 * h);
                al[c] = (8 * (at[2][b].w[c] - at[1][b].w[c]) - (at[3][b].w[c] - at[0][b].w[c])) / (12 * h);
            }
            NEAR(pose.a, a, 3, 1e-8);
            NEAR(pose.al, al, 3, 1e-8);
        }
        arena_close(o.arena);
    }
}

static void test_partials(void **state)
{
    (void)state;
    static struct places at;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed, CLOUD_S);
        ops->move(o.s, o.q, o.v, ALL);
        for (int k = 0; k < o.m->n; k++) {
            double unit[MOST] = {0};
            double complex q1[MOST_Q];
            unit[k] = 1;
            moving(&at, q1, o.m, o.q, unit);
            for (int b = 0; b < o.m->nbody; b++) {
                double x[3], none[3], xv[3], w[3], of_v[3], of_w[3];
                double complex local[3] = {o.x[b][0], o.x[b][1], o.x[b][2]}, world[3];
                if (!b) memset(local, 0, sizeof local), memset(o.x[b], 0, sizeof o.x[b]);
                at_point(world, &at.body[b], local);
                spin(of_w, &at.body[b]);
                for (int i = 0; i < 3; i++) of_v[i] = cimag(world[i]) / tiny;
                ops->point(o.s, x, none, b, o.x[b]);
                ops->partial(o.s, xv, w, b, x, k);
                NEAR(xv, of_v, 3, 1e-13);
                NEAR(w, of_w, 3, 1e-13);
                const int *path;
                int n = ops->path(o.s, &path, b), on = 0;
                for (int i = 0; i < n; i++) on += path[i] == k;
                assert_true(on == 1 || (size(of_v, 3) <= 1 && dot(of_v, of_v) + dot(of_w, of_w) == 0));
            }
        }
        arena_close(o.arena);
    }
}

/* Everything that the kernel has: curved displacements, rotary inertia, damping. */
static void test_affine_in_accelerations(void **state)
{
    (void)state;
    static double M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed, CLOUD_S | CLOUD_ROTARY | CLOUD_DAMPED);
        const int n = o.m->n;
        double r[MOST], r0[MOST], same[MOST], zero[MOST] = {0}, T, V, of_T = 0;
        resid(r, &o, o.v, o.a, ALL);
        resid(r0, &o, o.v, NULL, ALL);
        resid(same, &o, o.v, zero, ALL);
        assert_memory_equal(r0, same, sizeof *r0 * (size_t)n);
        ops->mass(o.s, M, o.q, ALL);
        for (int k = 0; k < n; k++)
            for (int j = 0; j < n; j++) r0[k] += M[k + n * j] * o.a[j];
        NEAR(r0, r, n, 1e-12);
        resid(same, &o, o.v, o.a, ALL);
        assert_memory_equal(r, same, sizeof *r * (size_t)n);
        ops->move(o.s, o.q, o.v, ALL);
        ops->energy(o.s, &T, &V);
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++) of_T += .5 * o.v[j] * M[j + n * k] * o.v[k];
        NEAR(&T, &of_T, 1, 1e-12);
        arena_close(o.arena);
    }
}

/* Kinetic and gravity's energy, the elastic one, along the first-order path with the motion's velocities. */
static double energy_at(struct scene *o, double t)
{
    double q[MOST_Q], u[MOST], dx[MOST], T, V;
    double complex q1[MOST_Q];
    for (int k = 0; k < o->m->n; k++) u[k] = o->v[k] + t * o->a[k], dx[k] = o->v[k] + t / 2 * o->a[k];
    nudge(q1, o->m, o->q, dx, t);
    for (int k = 0; k < o->m->nq; k++) q[k] = creal(q1[k]);
    for (int j = 0; j < o->m->njoint; j++) {
        const struct model_joint *joint = &o->m->joint[j];
        if (!tree_turns(joint, 3)) continue;
        double *x = q + joint->iq[joint->nq - 4], norm = 0;
        for (int k = 0; k < 4; k++) norm += x[k] * x[k];
        for (int k = 0; k < 4; k++) x[k] /= sqrt(norm);
    }
    ops->move(o->s, q, u, ALL);
    ops->energy(o->s, &T, &V);
    for (int b = 1; b < o->m->nbody; b++) {
        const struct model_body *body = &o->m->body[b];
        for (int i = 0; i < body->nmode; i++)
            for (int j = 0; j < body->nmode; j++)
                V += .5 * q[body->mode_q[i]] * body->flex->K[i + body->nmode * j] * q[body->mode_q[j]];
    }
    return T + V;
}

static void test_power(void **state)
{
    (void)state;
    const double h = 1e-4;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed, CLOUD_S | CLOUD_ROTARY);
        double r[MOST], power = 0, rate, terms = 1;
        resid(r, &o, o.v, o.a, ALL);
        for (int k = 0; k < o.m->n; k++) power += o.v[k] * r[k], terms += fabs(o.v[k] * r[k]);
        rate = (8 * (energy_at(&o, h) - energy_at(&o, -h)) - (energy_at(&o, 2 * h) - energy_at(&o, -2 * h))) / (12 * h);
        assert_true(fabs(rate - power) < 1e-8 * terms);
        arena_close(o.arena);
    }
}

static void test_classes(void **state)
{
    (void)state;
    static double M[MOST * MOST], M_fast[MOST * MOST], M_slow[MOST * MOST];
    int both = 0;
    for (unsigned seed = 1; seed < 3 * SEEDS; seed += 2) {
        struct scene o;
        open_scene(&o, seed, CLOUD_S | CLOUD_ROTARY | CLOUD_DAMPED);
        const int n = o.m->n;
        double fast[MOST], slow[MOST], all[MOST];
        resid(all, &o, o.v, o.a, ALL);
        resid(fast, &o, o.v, o.a, FAST);
        resid(slow, &o, o.v, o.a, SLOW);
        for (int k = 0; k < o.m->ns; k++) assert_true(slow[k] == 0);
        for (int k = 0; k < n; k++) fast[k] += slow[k];
        NEAR(fast, all, n, 1e-13);
        ops->mass(o.s, M, o.q, ALL);
        ops->mass(o.s, M_fast, o.q, FAST);
        ops->mass(o.s, M_slow, o.q, SLOW);
        for (int k = 0; k < n * n; k++) M_fast[k] += M_slow[k];
        NEAR(M_fast, M, n * n, 1e-13);
        both += o.m->ns > 0 && o.m->ns < n;
        arena_close(o.arena);
    }
    assert_true(both > SEEDS / 2);
}

/* With all its coordinates at rest at zero a flexible body is the rigid one; r of the others' rows is the same. */
static void test_held(void **state)
{
    (void)state;
    static double M[MOST * MOST], of_M[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o, rigid;
        double r[MOST], of_r[MOST];
        open_scene(&o, seed, CLOUD_S | CLOUD_ROTARY | CLOUD_DAMPED);
        const int n = o.m->n;
        bool mode[MOST] = {false};
        struct model *m = TAKE(o.arena, struct model, 1);
        struct model_body *body = TAKE(o.arena, struct model_body, o.m->nbody);
        *m = *o.m;
        memcpy(body, o.m->body, sizeof *body * (size_t)m->nbody);
        m->body = body;
        for (int b = 1; b < m->nbody; b++) {
            for (int k = 0; k < body[b].nmode; k++) {
                mode[body[b].mode_v[k]] = true;
                o.q[body[b].mode_q[k]] = o.v[body[b].mode_v[k]] = o.a[body[b].mode_v[k]] = 0;
            }
            body[b].flex = NULL, body[b].nmode = 0, body[b].at_node = false;
        }
        rigid = o;
        rigid.m = m;
        rigid.s = ops->build(m, FOR_RECORDS, NULL, o.arena);
        resid(r, &o, o.v, o.a, ALL);
        resid(of_r, &rigid, o.v, o.a, ALL);
        ops->mass(o.s, M, o.q, ALL);
        ops->mass(rigid.s, of_M, o.q, ALL);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                if (mode[i] || mode[j]) M[i + n * j] = of_M[i + n * j] = 0;
        for (int i = 0; i < n; i++)
            if (mode[i]) r[i] = of_r[i] = 0;
        NEAR(r, of_r, n, 1e-12);
        NEAR(M, of_M, n * n, 1e-12);
        arena_close(o.arena);
    }
}

static bool hangs_on(const struct model *m, int body, int owner)
{
    while (body > owner) body = m->body[body].parent;
    return body == owner;
}

/* Every joint carries what is beyond it, but along and about its free axes. */
static void test_reactions(void **state)
{
    (void)state;
    static double F[POINTS][3], N[ALL_BODIES][3];
    static struct mass_point p[POINTS];
    static struct places at;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        struct rotor turn[ALL_BODIES];
        double complex q1[MOST_Q];
        double r[MOST];
        open_scene(&o, seed, 0);
        needed(F, N, &o);
        int points = see(p, turn, &o, o.q, o.v);
        moving(&at, q1, o.m, o.q, o.v);
        resid(r, &o, o.v, o.a, ALL);
        for (int i = 0; i < o.m->njoint; i++) {
            const struct model_joint *j = &o.m->joint[i];
            double complex B[3], b[3] = {j->b[0], j->b[1], j->b[2]};
            double f[3] = {0}, n[3] = {0}, of_f[3], of_n[3];
            at_point(B, &at.body[j->child], b);
            for (int k = 0; k < points; k++) {
                if (!hangs_on(o.m, p[k].body, j->child)) continue;
                double d[3], here[3];
                for (int c = 0; c < 3; c++)
                    d[c] = p[k].x[c] - creal(B[c]), here[c] = F[k][c] - p[k].m * o.m->gravity[c];
                for (int c = 0; c < 3; c++) {
                    f[c] += here[c];
                    n[c] += d[(c + 1) % 3] * here[(c + 2) % 3] - d[(c + 2) % 3] * here[(c + 1) % 3];
                }
            }
            for (int b2 = j->child; b2 < o.m->nbody; b2++)
                for (int c = 0; c < 3 && hangs_on(o.m, b2, j->child); c++) n[c] += N[b2][c];
            for (int k = 0; k < j->nv; k++) {
                double w[3], x[3] = {creal(B[0]), creal(B[1]), creal(B[2])}, v[3];
                ops->partial(o.s, v, w, j->child, x, j->iv[k]);
                double *from = dot(w, w) > 0 ? n : f, *e = dot(w, w) > 0 ? w : v, along = dot(w, n) + dot(v, f);
                for (int c = 0; c < 3; c++) from[c] -= along * e[c];
            }
            ops->reaction(o.s, of_f, of_n, i);
            NEAR(of_f, f, 3, 1e-8);
            NEAR(of_n, n, 3, 1e-8);
        }
        arena_close(o.arena);
    }
}

/* ---- the system around it ---- */

/* a solves r = 0, and what hangs together freely keeps its momenta: those of its particles. */
static void test_momentum(void **state)
{
    (void)state;
    static struct mass_point p[POINTS];
    int seen = 0;
    for (unsigned seed = 0; seed < 4 * SEEDS; seed++) {
        struct scene o;
        open_tree(&o, seed, TREE_CHAIN | TREE_FREE_FALL, 0);
        if (o.m->joint[0].type != JOINT_FREE) {
            arena_close(o.arena);
            continue;
        }
        seen++;
        struct system *s = system_build(o.m, o.arena);
        const struct ode2 *ode = system_ode2(s);
        struct rotor turn[ALL_BODIES];
        double r[MOST], P[3], L[3], of_P[3] = {0}, of_L[3] = {0}, F[3] = {0}, N[3] = {0};
        static double force[POINTS][3], torque[ALL_BODIES][3];
        assert_int_equal(ode->direct->accel(ode, o.a, NULL, o.q, o.v, 0, NULL), OK);
        assert_int_equal(
            ode->ops->resid(ode, r, NULL, NULL, &(struct instant){.q = o.q, .v = o.v, .a = o.a}, ALL, NULL), OK);
        for (int k = 0; k < o.m->n; k++) assert_true(fabs(r[k]) < 1e-10 * size(o.a, o.m->n));
        assert_int_equal(system_evaluate(s, o.q, o.v, 0, EVALUATE_MOTION, NULL), OK);
        system_momentum(s, P, L);
        int points = see(p, turn, &o, o.q, o.v);
        needed(force, torque, &o);
        for (int k = 0; k < points; k++)
            for (int c = 0; c < 3; c++) {
                int d = (c + 1) % 3, e = (c + 2) % 3;
                of_P[c] += p[k].m * p[k].v[c];
                of_L[c] += p[k].m * (p[k].x[d] * p[k].v[e] - p[k].x[e] * p[k].v[d]);
                F[c] += force[k][c];
                N[c] += p[k].x[d] * force[k][e] - p[k].x[e] * force[k][d];
            }
        for (int b = 1; b < o.m->nbody; b++)
            for (int c = 0; c < 3; c++) of_L[c] += dot(turn[b].J[c], turn[b].w), N[c] += torque[b][c];
        NEAR(P, of_P, 3, 1e-12);
        NEAR(L, of_L, 3, 1e-12);
        for (int c = 0; c < 3; c++) assert_true(fabs(F[c]) < 1e-8 * size(o.a, o.m->n));
        for (int c = 0; c < 3; c++) assert_true(fabs(N[c]) < 1e-8 * size(o.a, o.m->n));
        arena_close(o.arena);
    }
    assert_true(seen > 8);
}

/* K, C and the power lost are those of the coordinates' forces; the stored energy is their potential. */
static void test_elastic(void **state)
{
    (void)state;
    static double K[MOST * MOST], C[MOST * MOST], K_fast[MOST * MOST], C_fast[MOST * MOST];
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed, CLOUD_S | CLOUD_DAMPED);
        const int n = o.m->n;
        struct system *s = system_build(o.m, o.arena);
        const struct ode2 *ode = system_ode2(s);
        const struct instant x = {.q = o.q, .v = o.v, .a = o.a};
        double r[MOST], w[POWER_CHANNELS], force[MOST] = {0}, lost = 0, stored, T, V;
        struct energies e;
        assert_int_equal(ode->ops->slopes(ode, K, C, &x, ALL, NULL), OK);
        assert_int_equal(ode->ops->slopes(ode, K_fast, C_fast, &x, FAST, NULL), OK);
        assert_int_equal(ode->ops->resid(ode, r, w, NULL, &x, ALL, NULL), OK);
        add_elastic(force, &o);
        for (int b = 1; b < o.m->nbody; b++) {
            const struct model_body *body = &o.m->body[b];
            for (int i = 0; i < body->nmode; i++)
                for (int j = 0; j < body->nmode; j++) {
                    int at = body->mode_v[i] + n * body->mode_v[j];
                    force[body->mode_v[i]] -= K[at] * o.q[body->mode_q[j]] + C[at] * o.v[body->mode_v[j]];
                    lost += o.v[body->mode_v[i]] * C[at] * o.v[body->mode_v[j]];
                    assert_true(K_fast[at] == (body->fast ? K[at] : 0) && C_fast[at] == (body->fast ? C[at] : 0));
                }
        }
        for (int k = 0; k < n; k++) assert_true(fabs(force[k]) < 1e-12);
        assert_true(fabs(w[POWER_DAMPER] + lost) < 1e-12 * (1 + lost));
        assert_int_equal(system_energy_at(s, &e, o.q, o.v, 0, &(struct trouble){0}), OK);
        stored = energy_at(&o, 0);
        ops->energy(o.s, &T, &V);
        stored -= T + V;
        assert_true(fabs(e.elastic - stored) < 1e-11 * (1 + fabs(T) + fabs(V)));
        NEAR(&e.kinetic, &T, 1, 1e-13);
        NEAR(&e.gravity, &V, 1, 1e-13);
        arena_close(o.arena);
    }
}

/* Over an interval a spring between any two points does the work that its energy loses, whatever moves them. */
static void test_work(void **state)
{
    (void)state;
    const double h = .05;
    int bent = 0;
    for (unsigned seed = 0; seed < 3 * SEEDS; seed++) {
        struct scene o;
        struct tree_dice d = {seed + 3};
        open_tree(&o, seed, TREE_FREE_FALL, CLOUD_S);
        struct spring par = {.k = 20, .rest = .3, .cubic = 15};
        struct model_measure gap = {.name = "gap", .type = MEASURE_DISTANCE};
        struct model_force spring = {
            .name = "spring", .type = FORCE_LAW, .cls = SLOW, .kind = &force_spring, .par = &par};
        struct model with = *o.m;
        tree_pair(&gap.a.body, &gap.b.body, &d, o.m->nbody);
        tree_vector(gap.a.p, &d, 3);
        tree_vector(gap.b.p, &d, 3);
        with.nmeasure = with.nforce = 1, with.measure = &gap, with.force = &spring;
        const struct ode2 *ode = system_ode2(system_build(&with, o.arena));
        const struct ode2 *bare = system_ode2(system_build(o.m, o.arena));
        double mid[MOST_Q], end[MOST_Q], dx[MOST], r[MOST], none[MOST], work = 0, x[2][2][3], v[3], V[2];
        for (int k = 0; k < o.m->n; k++) dx[k] = h * o.v[k];
        for (int k = 0; k < o.m->nq && !ode->move; k++) mid[k] = o.q[k] + dx[k] / 2, end[k] = o.q[k] + dx[k];
        if (ode->move) {
            ode->move->point(ode, mid, o.q, dx, .5, 0);
            ode->move->point(ode, end, o.q, dx, 1, 0);
        }
        const struct instant at = {.q = mid, .v = o.v, .qa = o.q, .qb = end, .tb = h};
        assert_int_equal(ode->ops->resid(ode, r, NULL, NULL, &at, ALL, NULL), OK);
        assert_int_equal(bare->ops->resid(bare, none, NULL, NULL, &at, ALL, NULL), OK);
        for (int k = 0; k < o.m->n; k++) work += dx[k] * (r[k] - none[k]);
        for (int i = 0; i < 2; i++) {
            ops->move(o.s, i ? end : o.q, o.v, ALL);
            ops->point(o.s, x[i][0], v, gap.a.body, gap.a.p);
            ops->point(o.s, x[i][1], v, gap.b.body, gap.b.p);
            double l = 0;
            for (int c = 0; c < 3; c++) l += (x[i][1][c] - x[i][0][c]) * (x[i][1][c] - x[i][0][c]);
            V[i] = force_spring.stored(&par, sqrt(l));
        }
        assert_true(fabs(work - (V[1] - V[0])) < 1e-12 * size(V, 2));
        bent += V[0] != V[1] && (o.m->body[gap.a.body].at_node || o.m->body[gap.b.body].at_node);
        arena_close(o.arena);
    }
    assert_true(bent > SEEDS / 2);
}

/* Elastic coordinates move by what they are told, however they lie among the others. */
static void test_moves(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed, 0);
        const struct ode2 *ode = system_ode2(system_build(o.m, o.arena));
        double q[MOST_Q], back[MOST], rate[MOST];
        if (ode->move) {
            memcpy(q, o.q, sizeof q);
            ode->move->point(ode, q, o.q, o.v, .5, 0);
            ode->move->diff(ode, back, q, o.q);
            ode->move->rate(ode, rate, q, o.q, back, o.a, 0);
        }
        for (int b = 1; ode->move && b < o.m->nbody; b++)
            for (int k = 0; k < o.m->body[b].nmode; k++) {
                int iq = o.m->body[b].mode_q[k], iv = o.m->body[b].mode_v[k];
                assert_true(fabs(q[iq] - o.q[iq] - .5 * o.v[iv]) < 1e-15);
                assert_true(fabs(back[iv] - .5 * o.v[iv]) < 1e-15 && rate[iv] == o.a[iv]);
            }
        arena_close(o.arena);
    }
}

/* The trees had every kind of joint on both sides of flexible bodies. */
static void test_what_was_met(void **state)
{
    (void)state;
    int inboard[JOINT_TYPES] = {0}, outboard[JOINT_TYPES] = {0}, twice = 0;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene o;
        open_scene(&o, seed, 0);
        for (int b = 1; b < o.m->nbody; b++) {
            const struct model_body *body = &o.m->body[b], *p = &o.m->body[body->parent];
            if (body->flex) inboard[o.m->joint[body->joint].type]++;
            if (p->at_node) outboard[o.m->joint[body->joint].type]++;
            twice += body->flex && p->at_node;
        }
        arena_close(o.arena);
    }
    for (int t = 0; t <= JOINT_FREE; t++) assert_true(inboard[t] && outboard[t]);
    assert_true(twice > SEEDS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mass),         cmocka_unit_test(test_residual),
        cmocka_unit_test(test_motion),       cmocka_unit_test(test_accelerations),
        cmocka_unit_test(test_partials),     cmocka_unit_test(test_affine_in_accelerations),
        cmocka_unit_test(test_power),        cmocka_unit_test(test_classes),
        cmocka_unit_test(test_held),         cmocka_unit_test(test_reactions),
        cmocka_unit_test(test_momentum),     cmocka_unit_test(test_elastic),
        cmocka_unit_test(test_moves),        cmocka_unit_test(test_work),
        cmocka_unit_test(test_what_was_met),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
