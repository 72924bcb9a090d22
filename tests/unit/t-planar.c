/* t-planar.c -- the planar recursion against sums over bodies written out with explicit Jacobians, against
 * Lagrange's equations by differences, and against dense algebra. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "tree/sweep.h"
#include "unit/near.h"
#include "unit/trees.h"

#include <cmocka.h>

enum { MOST = 64, SEEDS = 40 };

/* --- an independent formulation: matrices, paths and sums --------------------------------------- */

struct motion {
    double R[MOST][9], r[MOST][3], B[MOST][3]; /* B: the joint's point on body i */
    double slide[MOST][2][3], turn[MOST];      /* joint axes in the world */
    double phi[MOST];
};

static int slides_of(const struct model_joint *j)
{
    return j->type == JOINT_PRISMATIC ? 1 : j->type == JOINT_PLANAR || j->type == JOINT_FREE ? 2 : 0;
}

static void place(struct motion *o, const struct model *m, const double *q)
{
    memset(o, 0, sizeof *o);
    memcpy(o->R[0], m->body[0].R, sizeof o->R[0]);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &m->joint[i - 1];
        int p = j->parent, slides = slides_of(j);
        double E[9], J[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, Ebt[9], RE[9], x[3], y[3], angle = 0;
        tree_mm(E, o->R[p], j->Ea);
        memcpy(o->slide[i][0], j->type == JOINT_PRISMATIC ? E + 6 : E, sizeof x);
        memcpy(o->slide[i][1], E + 3, sizeof x);
        o->turn[i] = E[8];
        if (j->nv > slides) angle = q[j->iq[slides]];
        J[0] = J[4] = cos(angle), J[1] = sin(angle), J[3] = -sin(angle);
        tree_mm(RE, E, J);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) Ebt[a + 3 * b] = j->Eb[b + 3 * a];
        tree_mm(o->R[i], RE, Ebt);
        tree_mv(x, o->R[p], j->a);
        tree_mv(y, o->R[i], j->b);
        for (int a = 0; a < 3; a++) {
            o->B[i][a] = o->r[p][a] + x[a];
            for (int k = 0; k < slides; k++) o->B[i][a] += o->slide[i][k][a] * q[j->iq[k]];
            o->r[i][a] = o->B[i][a] - y[a];
        }
        o->phi[i] = o->phi[p] + (j->nv > slides ? o->turn[i] * angle : 0);
    }
}

static bool above(const struct model *m, int i, int j)
{
    while (j > i) j = m->body[j].parent;
    return i == j;
}

/* Jacobian of body i's centre (x, y) and angle: J [3 x n] by column. */
static void jacobian(double *J, const struct motion *o, const struct model *m, int i)
{
    memset(J, 0, sizeof *J * 3 * (size_t)m->n);
    for (int b = 1; b < m->nbody; b++) {
        const struct model_joint *j = &m->joint[b - 1];
        if (!above(m, b, i)) continue;
        for (int k = 0; k < j->nv; k++) {
            double *c = J + 3 * j->iv[k];
            if (k < slides_of(j)) {
                c[0] = o->slide[b][k][0], c[1] = o->slide[b][k][1];
            } else {
                c[0] = -o->turn[b] * (o->r[i][1] - o->B[b][1]);
                c[1] = o->turn[b] * (o->r[i][0] - o->B[b][0]);
                c[2] = o->turn[b];
            }
        }
    }
}

static void times(double *y, const double *J, const double *v, int n)
{
    y[0] = y[1] = y[2] = 0;
    for (int k = 0; k < n; k++)
        for (int c = 0; c < 3; c++) y[c] += J[c + 3 * k] * v[k];
}

/* The part of body i's acceleration that needs no v': the derivative of jacobian() times v. */
static void bias(double *y, const struct motion *o, const struct model *m, const double *v, int i)
{
    double J[3 * MOST], vi[3], vb[3], vp[3];
    jacobian(J, o, m, i);
    times(vi, J, v, m->n);
    y[0] = y[1] = y[2] = 0;
    for (int b = 1; b < m->nbody; b++) {
        const struct model_joint *j = &m->joint[b - 1];
        if (!above(m, b, i)) continue;
        jacobian(J, o, m, b);
        times(vb, J, v, m->n);
        jacobian(J, o, m, j->parent);
        times(vp, J, v, m->n);
        /* velocity of the joint's point on the child */
        double c[2] = {o->B[b][0] - o->r[b][0], o->B[b][1] - o->r[b][1]};
        double vB[2] = {vb[0] - vb[2] * c[1], vb[1] + vb[2] * c[0]};
        for (int k = 0; k < j->nv; k++) {
            double u = v[j->iv[k]];
            if (k < slides_of(j)) {
                y[0] -= vp[2] * o->slide[b][k][1] * u;
                y[1] += vp[2] * o->slide[b][k][0] * u;
            } else {
                y[0] -= o->turn[b] * (vi[1] - vB[1]) * u;
                y[1] += o->turn[b] * (vi[0] - vB[0]) * u;
            }
        }
    }
}

static void explicit_mass(double *M, const struct model *m, const double *q, const char *bears)
{
    struct motion o;
    double J[3 * MOST];
    place(&o, m, q);
    memset(M, 0, sizeof *M * (size_t)(m->n * m->n));
    for (int i = 1; i < m->nbody; i++) {
        if (bears && !bears[i]) continue;
        const double w[3] = {m->body[i].mass, m->body[i].mass, m->body[i].inertia[2]};
        jacobian(J, &o, m, i);
        for (int a = 0; a < m->n; a++)
            for (int b = 0; b < m->n; b++)
                for (int c = 0; c < 3; c++) M[a + m->n * b] += w[c] * J[c + 3 * a] * J[c + 3 * b];
    }
}

/* sum J' (m (J a + bias - g)) */
static void explicit_resid(double *r, const struct model *m, const double *q, const double *v, const double *a)
{
    struct motion o;
    double J[3 * MOST], acc[3], more[3];
    place(&o, m, q);
    memset(r, 0, sizeof *r * (size_t)m->n);
    for (int i = 1; i < m->nbody; i++) {
        const double w[3] = {m->body[i].mass, m->body[i].mass, m->body[i].inertia[2]};
        bias(more, &o, m, v, i);
        jacobian(J, &o, m, i);
        times(acc, J, a, m->n);
        for (int c = 0; c < 3; c++) acc[c] += more[c] - (c < 2 ? m->gravity[c] : 0);
        for (int k = 0; k < m->n; k++)
            for (int c = 0; c < 3; c++) r[k] += w[c] * J[c + 3 * k] * acc[c];
    }
}

static double potential(const struct model *m, const double *q)
{
    struct motion o;
    double V = 0;
    place(&o, m, q);
    for (int i = 1; i < m->nbody; i++) V -= m->body[i].mass * (m->gravity[0] * o.r[i][0] + m->gravity[1] * o.r[i][1]);
    return V;
}

static double kinetic(const struct model *m, const double *q, const double *v)
{
    double M[MOST * MOST], T = 0;
    explicit_mass(M, m, q, NULL);
    for (int a = 0; a < m->n; a++)
        for (int b = 0; b < m->n; b++) T += .5 * v[a] * M[a + m->n * b] * v[b];
    return T;
}

/* --- helpers ------------------------------------------------------------------------------------ */

struct fixture {
    struct arena *arena;
    struct model *m;
    struct sweep *s;
    double q[MOST], v[MOST], a[MOST];
};

static void open_tree(struct fixture *f, int nbody, unsigned seed, unsigned flags)
{
    struct tree_dice d = {seed + 77};
    f->arena = arena_open();
    f->m = random_tree(2, nbody, seed, flags, f->arena);
    f->s = sweep_planar.build(f->m, FOR_RECORDS, NULL, f->arena);
    assert_true(f->m->n <= MOST && f->m->nbody <= MOST);
    memcpy(f->q, f->m->q0, sizeof *f->q * (size_t)f->m->nq);
    memcpy(f->v, f->m->v0, sizeof *f->v * (size_t)f->m->n);
    for (int i = 0; i < f->m->n; i++) f->a[i] = tree_roll(&d, -3, 3);
}

static void close_tree(struct fixture *f)
{
    arena_close(f->arena);
}

static void sweep_resid(double *r, struct fixture *f, const double *a, enum rate cls)
{
    memset(r, 0, sizeof *r * (size_t)f->m->n);
    sweep_planar.forward(f->s, f->q, f->v, a, cls);
    sweep_planar.backward(f->s, r, cls);
}

/* --- tests -------------------------------------------------------------------------------------- */

static void positions_are_homogeneous_transforms(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        struct motion o;
        struct pose b;
        open_tree(&f, 7, seed, 0);
        place(&o, f.m, f.q);
        sweep_planar.forward(f.s, f.q, f.v, f.a, ALL);
        for (int i = 0; i < f.m->nbody; i++) {
            double J[3 * MOST], vel[3], acc[3], more[3] = {0, 0, 0};
            sweep_planar.pose(f.s, &b, i);
            assert_true(all_near(b.r, o.r[i], 3, 1e-13));
            assert_true(all_near(b.R, o.R[i], 9, 1e-13));
            assert_true(fabs(b.angle - o.phi[i]) < 1e-13 * 20);
            jacobian(J, &o, f.m, i);
            times(vel, J, f.v, f.m->n);
            times(acc, J, f.a, f.m->n);
            if (i) bias(more, &o, f.m, f.v, i);
            for (int c = 0; c < 3; c++) acc[c] += more[c];
            assert_true(all_near((double[]){b.v[0], b.v[1], b.w[2]}, vel, 3, 1e-12));
            assert_true(all_near((double[]){b.a[0], b.a[1], b.al[2]}, acc, 3, 1e-12));
        }
        close_tree(&f);
    }
}

/* The drawn posture: every coordinate 0 puts each body where the model says it stands. */
static void zero_is_the_drawn_position(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        struct pose b;
        open_tree(&f, 7, seed, 0);
        memset(f.q, 0, sizeof f.q);
        sweep_planar.move(f.s, f.q, f.v, ALL);
        for (int i = 0; i < f.m->nbody; i++) {
            sweep_planar.pose(f.s, &b, i);
            assert_true(all_near(b.r, f.m->body[i].at, 3, 1e-13));
            assert_true(all_near(b.R, f.m->body[i].R, 9, 1e-13));
        }
        close_tree(&f);
    }
}

static void mass_is_the_sum_of_jacobians(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double M[MOST * MOST], X[MOST * MOST];
        open_tree(&f, 8, seed, TREE_FAST_LEAVES);
        for (int cls = FAST; cls <= ALL; cls++) {
            char bears[MOST] = {0};
            for (int i = 1; i < f.m->nbody; i++) bears[i] = cls == ALL || (cls == FAST) == f.m->body[i].fast;
            memset(M, 0xff, sizeof M);
            sweep_planar.mass(f.s, M, f.q, (unsigned)cls);
            explicit_mass(X, f.m, f.q, bears);
            assert_true(all_near(M, X, f.m->n * f.m->n, 1e-13));
            for (int a = 0; a < f.m->n; a++)
                for (int b = 0; b < a; b++) assert_true(M[a + f.m->n * b] == M[b + f.m->n * a]);
        }
        close_tree(&f);
    }
}

/* Columns by central differences of positions alone. */
static void mass_is_the_sum_of_differences(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        struct motion up, down;
        double M[MOST * MOST], X[MOST * MOST] = {0}, e = 1e-5;
        open_tree(&f, 6, seed, 0);
        int n = f.m->n;
        static double J[MOST][3 * MOST];
        for (int k = 0; k < n; k++) {
            double q[MOST];
            memcpy(q, f.q, sizeof q);
            q[k] = f.q[k] + e, place(&up, f.m, q);
            q[k] = f.q[k] - e, place(&down, f.m, q);
            for (int i = 1; i < f.m->nbody; i++) {
                for (int c = 0; c < 2; c++) J[i][c + 3 * k] = (up.r[i][c] - down.r[i][c]) / (2 * e);
                J[i][2 + 3 * k] = (up.phi[i] - down.phi[i]) / (2 * e);
            }
        }
        for (int i = 1; i < f.m->nbody; i++)
            for (int a = 0; a < n; a++)
                for (int b = 0; b < n; b++)
                    for (int c = 0; c < 3; c++)
                        X[a + n * b] +=
                            (c < 2 ? f.m->body[i].mass : f.m->body[i].inertia[2]) * J[i][c + 3 * a] * J[i][c + 3 * b];
        sweep_planar.mass(f.s, M, f.q, ALL);
        assert_true(all_near(M, X, n * n, 1e-8));
        close_tree(&f);
    }
}

static void resid_is_the_sum_over_bodies(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST], x[MOST];
        open_tree(&f, 8, seed, seed % 2 ? TREE_CHAIN : 0);
        sweep_resid(r, &f, f.a, ALL);
        explicit_resid(x, f.m, f.q, f.v, f.a);
        assert_true(all_near(r, x, f.m->n, 1e-12));
        close_tree(&f);
    }
}

/* d/dt (M v) - dT/dq + dV/dq, T and V from the explicit sums, derivatives by central differences. */
static void resid_is_lagrange(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r[MOST], x[MOST], up[MOST], down[MOST], Mup[MOST * MOST], Mdown[MOST * MOST], M[MOST * MOST], e = 1e-5;
        open_tree(&f, 5, seed, 0);
        int n = f.m->n;
        sweep_resid(r, &f, f.a, ALL);
        for (int i = 0; i < n; i++) up[i] = f.q[i] + e * f.v[i], down[i] = f.q[i] - e * f.v[i];
        explicit_mass(Mup, f.m, up, NULL);
        explicit_mass(Mdown, f.m, down, NULL);
        explicit_mass(M, f.m, f.q, NULL);
        for (int i = 0; i < n; i++) {
            x[i] = 0;
            for (int j = 0; j < n; j++)
                x[i] += M[i + n * j] * f.a[j] + (Mup[i + n * j] - Mdown[i + n * j]) / (2 * e) * f.v[j];
            memcpy(up, f.q, sizeof up), up[i] += e;
            memcpy(down, f.q, sizeof down), down[i] -= e;
            x[i] -= (kinetic(f.m, up, f.v) - kinetic(f.m, down, f.v)) / (2 * e);
            x[i] += (potential(f.m, up) - potential(f.m, down)) / (2 * e);
        }
        assert_true(all_near(r, x, n, 1e-7));
        close_tree(&f);
    }
}

static void classes_add_up(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double fast[MOST], slow[MOST], all[MOST];
        open_tree(&f, 9, seed, TREE_FAST_LEAVES);
        sweep_resid(fast, &f, f.a, FAST);
        sweep_resid(slow, &f, f.a, SLOW);
        sweep_resid(all, &f, f.a, ALL);
        for (int i = 0; i < f.m->n; i++) {
            if (i < f.m->ns) assert_true(slow[i] == 0);
            fast[i] += slow[i];
        }
        assert_true(all_near(fast, all, f.m->n, 1e-13));
        close_tree(&f);
    }
}

static void articulated_bodies_solve_the_dense_system(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        struct tree_dice dice = {seed};
        double M[MOST * MOST], d[MOST], x[MOST], b[MOST], y[MOST], cm = .7;
        open_tree(&f, 9, seed, seed % 3 ? 0 : TREE_CHAIN);
        int n = f.m->n;
        void *F = arena_take(f.arena, 1, sweep_planar.factor_size(f.s));
        for (int i = 0; i < n; i++) d[i] = tree_roll(&dice, 0, 5), b[i] = x[i] = tree_roll(&dice, -1, 1);
        assert_true(sweep_planar.factor(f.s, F, cm, d, f.q, ALL));
        sweep_planar.solve(f.s, F, x);
        sweep_planar.mass(f.s, M, f.q, ALL);
        for (int i = 0; i < n; i++) {
            y[i] = d[i] * x[i];
            for (int j = 0; j < n; j++) y[i] += cm * M[i + n * j] * x[j];
        }
        assert_true(all_near(y, b, n, 1e-11));
        close_tree(&f);
    }
}

/* A body without mass at the end of a chain cannot be moved by a finite force. */
static void a_massless_freedom_has_no_pivot(void **state)
{
    (void)state;
    struct fixture f;
    open_tree(&f, 4, 3, TREE_CHAIN | TREE_REVOLUTE);
    struct model_body *last = (struct model_body *)&f.m->body[4];
    last->mass = last->inertia[2] = 0;
    struct sweep *s = sweep_planar.build(f.m, FOR_RECORDS, NULL, f.arena);
    void *F = arena_take(f.arena, 1, sweep_planar.factor_size(s));
    double d[MOST] = {0};
    assert_false(sweep_planar.factor(s, F, 1, d, f.q, ALL));
    d[3] = 1; /* a stiff joint holds it */
    assert_true(sweep_planar.factor(s, F, 1, d, f.q, ALL));
    close_tree(&f);
}

static void partials_are_the_velocity(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        struct pose b;
        const double p[3] = {.3, -.7, 0};
        open_tree(&f, 8, seed, 0);
        sweep_planar.move(f.s, f.q, f.v, ALL);
        for (int i = 0; i < f.m->nbody; i++) {
            double x[3], xv[3], sum[3] = {0}, turned[3] = {0}, pv[3], pw[3];
            int on_path = 0;
            const int *path;
            sweep_planar.point(f.s, x, xv, i, p);
            sweep_planar.pose(f.s, &b, i);
            for (int k = 0; k < f.m->n; k++) {
                sweep_planar.partial(f.s, pv, pw, i, x, k);
                on_path += pv[0] != 0 || pv[1] != 0 || pw[2] != 0;
                for (int c = 0; c < 3; c++) sum[c] += pv[c] * f.v[k], turned[c] += pw[c] * f.v[k];
            }
            assert_true(all_near(sum, xv, 3, 1e-13));
            assert_true(all_near(turned, b.w, 3, 1e-13));
            int n = sweep_planar.path(f.s, &path, i);
            assert_int_equal(n, on_path);
            for (int k = 0; k < n; k++) {
                sweep_planar.partial(f.s, pv, pw, i, x, path[k]);
                assert_true(pv[0] != 0 || pv[1] != 0 || pw[2] != 0);
            }
        }
        close_tree(&f);
    }
}

/* A push of f at x and a twist of n give the rows -(x' f + w n) per unit velocity. */
static void pushes_do_work(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double r0[MOST], r[MOST] = {0}, x[3] = {.4, .2, 0}, force[3] = {3, -2, 0}, n[3] = {0, 0, 1.5}, pv[3], pw[3];
        open_tree(&f, 8, seed, 0);
        int body = 1 + (int)seed % 8;
        sweep_resid(r0, &f, f.a, ALL);
        sweep_planar.forward(f.s, f.q, f.v, f.a, ALL);
        sweep_planar.push(f.s, body, x, force);
        sweep_planar.twist(f.s, body, n);
        sweep_planar.backward(f.s, r, ALL);
        for (int k = 0; k < f.m->n; k++) {
            sweep_planar.partial(f.s, pv, pw, body, x, k);
            r[k] += pv[0] * force[0] + pv[1] * force[1] + pw[2] * n[2];
        }
        assert_true(all_near(r, r0, f.m->n, 1e-13));
        close_tree(&f);
    }
}

static void energies_are_the_sums(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        double T, V;
        open_tree(&f, 8, seed, 0);
        sweep_planar.move(f.s, f.q, f.v, ALL);
        sweep_planar.energy(f.s, &T, &V);
        assert_true(all_near((double[]){T, V}, (double[]){kinetic(f.m, f.q, f.v), potential(f.m, f.q)}, 2, 1e-13));
        close_tree(&f);
    }
}

/* Newton and Euler for all that hangs on a joint; free directions carry nothing that is reported. */
static void reactions_hold_the_subtree(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct fixture f;
        struct motion o;
        double r[MOST];
        open_tree(&f, 8, seed, 0);
        place(&o, f.m, f.q);
        sweep_resid(r, &f, f.a, ALL);
        for (int j = 0; j < f.m->njoint; j++) {
            double force[3] = {0}, moment = 0, got[3], n[3];
            for (int i = j + 1; i < f.m->nbody; i++) {
                struct pose b;
                if (!above(f.m, j + 1, i)) continue;
                sweep_planar.pose(f.s, &b, i);
                double F[2], d[2];
                for (int c = 0; c < 2; c++) {
                    F[c] = f.m->body[i].mass * (b.a[c] - f.m->gravity[c]);
                    d[c] = o.r[i][c] - o.B[j + 1][c];
                    force[c] += F[c];
                }
                moment += f.m->body[i].inertia[2] * b.al[2] + d[0] * F[1] - d[1] * F[0];
            }
            const struct model_joint *joint = &f.m->joint[j];
            int slides = slides_of(joint);
            for (int k = 0; k < slides; k++) {
                const double *e = o.slide[j + 1][k];
                double along = e[0] * force[0] + e[1] * force[1];
                force[0] -= along * e[0], force[1] -= along * e[1];
            }
            if (joint->nv > slides) moment = 0;
            sweep_planar.reaction(f.s, got, n, j);
            assert_true(all_near((double[]){got[0], got[1], got[2], n[0], n[1], n[2]},
                                 (double[]){force[0], force[1], 0, 0, 0, moment}, 6, 1e-12));
        }
        close_tree(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_are_homogeneous_transforms),
        cmocka_unit_test(zero_is_the_drawn_position),
        cmocka_unit_test(mass_is_the_sum_of_jacobians),
        cmocka_unit_test(mass_is_the_sum_of_differences),
        cmocka_unit_test(resid_is_the_sum_over_bodies),
        cmocka_unit_test(resid_is_lagrange),
        cmocka_unit_test(classes_add_up),
        cmocka_unit_test(articulated_bodies_solve_the_dense_system),
        cmocka_unit_test(a_massless_freedom_has_no_pivot),
        cmocka_unit_test(partials_are_the_velocity),
        cmocka_unit_test(pushes_do_work),
        cmocka_unit_test(energies_are_the_sums),
        cmocka_unit_test(reactions_hold_the_subtree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
