/* t-passes.c -- the sweeps one pass after the other against all at once; rows against partial velocities. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "tree/sweep.h"
#include "unit/opened.h"
#include "unit/trees.h"

enum { SEEDS = 40, MOST = 200 };

static const struct sweep_ops *ops_of(const struct model *m)
{
    return m->space == 2 ? &sweep_planar : &sweep_spatial;
}

static void near_all(const double *x, const double *y, int n, double size)
{
    for (int i = 0; i < n; i++)
        if (!(fabs(x[i] - y[i]) <= 1e-12 * size)) fail_msg("%d: %.17g is not %.17g", i, x[i], y[i]);
}

static double largest(const double *x, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(x[i]));
    return most;
}

static void same_poses(const struct sweep_ops *ops, const struct sweep *a, const struct sweep *b, const struct model *m)
{
    for (int i = 0; i < m->nbody; i++) {
        struct pose p, q;
        double *x = p.r, *y = q.r;
        ops->pose(a, &p, i);
        ops->pose(b, &q, i);
        near_all(x, y, (int)(sizeof p / sizeof *x), 1 + largest(y, (int)(sizeof p / sizeof *x)));
    }
}

/* One sweep does all at once; the other place(), move(), accelerate(), forward(), each where the last has been. */
static void try_passes(const struct model *m, const double *q, const double *v, const double *a)
{
    const struct sweep_ops *ops = ops_of(m);
    struct arena *life = arena_open();
    struct sweep *once = ops->build(m, FOR_RECORDS, NULL, life), *by_pass = ops->build(m, FOR_RECORDS, NULL, life);
    for (unsigned cls = FAST; cls <= ALL; cls++) {
        double r[MOST] = {0}, s[MOST] = {0};
        ops->forward(once, q, v, a, ALL);
        ops->backward(once, r, ALL);
        ops->forward(once, q, v, a, cls);
        ops->place(by_pass, q, ALL);
        ops->move(by_pass, NULL, v, ALL);
        ops->accelerate(by_pass, v, a, ALL);
        same_poses(ops, by_pass, once, m);
        memset(r, 0, sizeof r);
        ops->backward(once, r, cls);
        ops->accelerate(by_pass, v, v, ALL); /* others that forward() does not keep */
        ops->forward(by_pass, NULL, v, a, cls);
        ops->backward(by_pass, s, cls);
        near_all(s, r, m->n, 1 + largest(r, m->n));
    }
    double *M = TAKE(life, double, m->n * m->n), *N = TAKE(life, double, m->n * m->n);
    ops->mass(once, M, q, ALL);
    ops->mass(by_pass, N, NULL, ALL);
    near_all(N, M, m->n * m->n, 1 + largest(M, m->n * m->n));
    arena_close(life);
}

/* f . v_k + n . w_k for each velocity on the way to a body. */
static void try_rows(const struct model *m, const double *q, const double *f, const double *n)
{
    const struct sweep_ops *ops = ops_of(m);
    struct arena *life = arena_open();
    struct sweep *s = ops->build(m, FOR_RECORDS, NULL, life);
    ops->place(s, q, ALL);
    for (int body = 0; body < m->nbody; body++) {
        const int *k, *up, count = ops->path(s, &k, body);
        for (int i = body;; i = m->body[i].parent) { /* from the ground, and from every body on the way */
            double g[MOST], x[3] = {.4, -.3, m->space == 3 ? .2 : 0};
            const int from = ops->path(s, &up, i);
            for (int kind = 0; kind < 3; kind++) {
                ops->row(s, g, body, from, x, kind < 2 ? f : NULL, kind ? n : NULL);
                for (int e = from; e < count; e++) {
                    double v[3], w[3], sum = 0;
                    ops->partial(s, v, w, body, x, k[e]);
                    for (int c = 0; c < 3; c++) sum += (kind < 2 ? f[c] * v[c] : 0) + (kind ? n[c] * w[c] : 0);
                    near_all(&g[e - from], &sum, 1, 10);
                }
            }
            if (i == 0) break;
        }
    }
    arena_close(life);
}

static void test_rigid(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++)
        for (int space = 2; space <= 3; space++) {
            struct arena *life = arena_open();
            struct model *m = random_tree(space, 7, seed, seed % 3 ? 0 : TREE_CHAIN, life);
            struct tree_dice dice = {seed + 17};
            double q[MOST], v[MOST], a[MOST], f[3], n[3];
            tree_state(q, v, m, &dice);
            for (int i = 0; i < m->n; i++) a[i] = tree_roll(&dice, -3, 3);
            tree_vector(f, &dice, space);
            tree_vector(n, &dice, 3);
            if (space == 2) n[0] = n[1] = 0;
            try_passes(m, q, v, a);
            try_rows(m, q, f, n);
            arena_close(life);
        }
}

/* Two bodies on one flexible body, at different nodes, one of them flexible itself, and one that hangs on both. */
static const char flexible[] =
    "  stem:\n"
    "    beam: {from: [0, 0%s], to: [1, 0%s], elements: 3}\n    section: {rectangle: [0.04, 0.03]}\n"
    "    material: aluminium\n    modes: 3\n    points: {tip: {station: 1}}\n"
    "  twig:\n"
    "    beam: {from: [1, 0%s], to: [1, 0.7%s], elements: 3}\n    section: {rectangle: [0.02, 0.03]}\n"
    "    material: steel\n    modes: 2\n"
    "  bob: {mass: 0.4, inertia: %s, at: [0.4, -0.2%s]}\n"
    "  leaf: {mass: 0.2, inertia: %s, at: [1.2, 0.8%s]}\n"
    "constraints:\n"
    "  foot: {revolute: [ground, stem], at: [0, 0%s]%s}\n"
    "  fork: {fixed: [stem, twig], at: [1, 0%s]}\n"
    "  hook: {revolute: [stem, bob], at: [0.333333333333333333, 0%s]%s}\n"
    "  stalk: {prismatic: [twig, leaf], at: [1, 0.7%s], axis: [1, 0.3%s]}\n"
    "integrate: {step: 1.0e-4, until: 1}\n";

static void test_flexible(void **state)
{
    (void)state;
    for (int space = 2; space <= 3; space++) {
        const char *z = space == 2 ? "" : ", 0", *axis = space == 2 ? "" : ", axis: [0.1, 0.2, 1]";
        const char *inertia = space == 2 ? "0.02" : "[0.02, 0.03, 0.025]";
        struct opened o;
        char text[2000], deck[2100];
        snprintf(text, sizeof text, flexible, z, z, z, z, inertia, z, inertia, z, z, axis, z, z, axis, z, z);
        snprintf(deck, sizeof deck, "gravity: [1, -9%s]\nbodies:\n%s", z, text);
        open_deck(&o, deck);
        const struct model *m = o.sim.model;
        struct tree_dice dice = {5};
        for (int i = 0; i < 10; i++) {
            double q[MOST], v[MOST], a[MOST], f[3], n[3];
            for (int k = 0; k < m->n; k++) {
                q[k] = tree_roll(&dice, -.02, .02), v[k] = tree_roll(&dice, -1, 1), a[k] = tree_roll(&dice, -3, 3);
            }
            tree_vector(f, &dice, space);
            tree_vector(n, &dice, 3);
            if (space == 2) n[0] = n[1] = 0;
            try_passes(m, q, v, a);
            try_rows(m, q, f, n);
        }
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rigid),
        cmocka_unit_test(test_flexible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
