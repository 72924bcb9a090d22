/* t-bar.c -- a bar of solid elements reduced: against CalculiX, against what is known of a bar, against itself. */
#include "reduce/bar.h"
#include "reduce/loads.h"

static void test_frequencies(void **state)
{
    /* Legendre-Ritz series of 30 x 10 x 10 terms, 3-D elasticity: bending z, y, z, y, twist, bending z [Hz] */
    static const double exact[] = {48.71932, 80.70187, 300.3214, 484.0293, 637.9315, 820.2314};
    static const double coarse[] = {0.03, 0.01, 0.05, 0.03, 0.04, 0.13}; /* of three elements along */
    struct bench b;
    (void)state;
    bench_make(&b, BAR, false, true, CRAIG_BAMPTON, 10);
    for (int j = 0; j < 10; j++) close_to(b.basis.lambda[j], bar_clamped[j], 2e-7 * bar_clamped[j], "omega^2");
    for (int j = 0; j < 6; j++) close_to(sqrt(b.basis.lambda[j]) / two_pi, exact[j], coarse[j] * exact[j], "Hz");
    bench_end(&b);
}

/* Interfaces that the body does not feel leave its modes alone; a rigid face makes it stiffer. */
static void test_interfaces(void **state)
{
    struct bench rigid, average;
    (void)state;
    bench_make(&rigid, BAR, true, true, CRAIG_BAMPTON, 12);
    bench_make(&average, BAR, true, false, CRAIG_BAMPTON, 12);
    assert_int_equal(rigid.basis.n, 18);
    for (int j = 0; j < 5; j++) {
        close_to(average.basis.lambda[j], bar_clamped[j], 1e-3 * bar_clamped[j], "omega^2, average tip");
        assert_true(average.basis.lambda[j] > bar_clamped[j] * (1 - 1e-6));
        assert_true(rigid.basis.lambda[j] > average.basis.lambda[j]);
        close_to(rigid.basis.lambda[j], bar_clamped[j], 0.05 * bar_clamped[j], "omega^2, rigid tip");
    }
    bench_end(&rigid);
    bench_end(&average);
}

/* phi' K^-1 phi of a tip force F e_k. */
static double compliance(struct bench *b, int k)
{
    double sum = 0;
    for (int j = 0; j < b->basis.n; j++) {
        double m[6];
        tie_motion(m, b->tie + 1, b->basis.V + (size_t)j * (size_t)b->basis.size);
        sum += m[k] * m[k] / b->basis.lambda[j];
    }
    return sum;
}

/* Constraint modes alone hold the static answer. */
static void test_static(void **state)
{
    struct bench b;
    double I = bar_width * pow(bar_height, 3) / 12;
    (void)state;
    for (int modes = 0; modes <= 8; modes += 8) {
        bench_make(&b, BAR, true, false, CRAIG_BAMPTON, modes);
        close_to(100 * compliance(&b, 2), bar_deflection, 1e-6 * bar_deflection, "deflection");
        close_to(compliance(&b, 2), 1 / (3 * bar_E * I), 0.05 / (3 * bar_E * I), "F L^3 / 3 E I");
        close_to(compliance(&b, 0), 1 / (bar_E * 0.006), 0.02 / (bar_E * 0.006), "F L / E A");
        bench_end(&b);
    }
    bench_make(&b, BAR, true, true, CRAIG_BAMPTON, 0);
    close_to(compliance(&b, 2), 1 / (3 * bar_E * I), 0.06 / (3 * bar_E * I), "F L^3 / 3 E I, rigid tip");
    bench_end(&b);
}

/* Held by the average of the root's nodes the body hangs on no node: K^-1 with balance and supports gives the same
 * as holding by multipliers, seen through residuals: V'KV and the average's rest. */
static void test_average_reference(void **state)
{
    const struct fe_source source = {.job = BAR, .units = {1, 1, 1}};
    const struct tie_options options = {.name = "root", .where = "root", .rigid = false};
    struct bench b = {.life = arena_open()};
    (void)state;
    must(fe_read(&b.fe, &source, b.life, &b.report), &b);
    must(tie_make(b.tie, &options, &b.fe, b.life, &b.report), &b);
    must(basis_make(&b.basis, &b.fe, b.tie, 1, &(struct basis_options){.method = EIGENMODES, .modes = 6}, b.life,
                    &b.report),
         &b);
    double *Kv = TAKE(b.life, double, b.basis.size);
    for (int j = 0; j < 6; j++) {
        const double *v = b.basis.V + (size_t)j * (size_t)b.basis.size;
        double m[6], rest = 0, most = 0;
        tie_motion(m, b.tie, v);
        for (int k = 0; k < 6; k++) close_to(m[k], 0, 1e-9, "the average rests");
        sparse_mul(Kv, &b.fe.K, v);
        /* K v - omega^2 M v is a load of the interface, A' times six numbers: none outside the root's nodes. */
        for (int i = 0; i < b.basis.size; i++) {
            bool root = false;
            for (int r = 0; r < b.tie[0].n; r++) root = root || b.tie[0].node[r] == i / 3;
            double off = Kv[i] - b.basis.lambda[j] * b.basis.MV[i + j * b.basis.size];
            if (!root) rest = fmax(rest, fabs(off));
            most = fmax(most, fabs(Kv[i]));
        }
        close_to(rest, 0, 1e-7 * most, "balance");
        assert_true(b.basis.lambda[j] < bar_clamped[j]);
        close_to(b.basis.lambda[j], bar_clamped[j], 0.1 * bar_clamped[j], "omega^2");
    }
    bench_end(&b);
}

/* With its own answers among the modes the body takes a load as the whole mesh does. */
static void test_load_modes(void **state)
{
    static const int kinds[] = {LOAD_ACCEL, LOAD_SPIN + 2};
    const struct tie *root;
    struct bench b;
    struct hold hold;
    (void)state;
    for (int with = 0; with <= 2; with += 2) {
        bench_make(&b, BAR, false, true, CRAIG_BAMPTON, 3);
        const struct basis_options want = {.modes = 3, .nload = with, .load = kinds};
        root = b.tie;
        must(basis_make(&b.basis, &b.fe, b.tie, 1, &want, b.life, &b.report), &b);
        must(hold_make(&hold, &b.fe, &root, 1, b.life, &b.report), &b);
        double *f = TAKE(b.life, double, b.basis.size), *g = TAKE(b.life, double, b.basis.size), off = 0, most = 0;
        load_forces(f, &b.fe, LOAD_SPIN + 2, b.life);
        load_forces(g, &b.fe, LOAD_ACCEL, b.life);
        for (int i = 0; i < b.basis.size; i++) f[i] -= 0.5 * g[i]; /* about the root */
        hold_solve(g, &hold, f);
        for (int i = 0; i < b.basis.size; i++) most = fmax(most, fabs(g[i]));
        for (int j = 0; j < b.basis.n; j++) {
            const double *v = b.basis.V + (size_t)j * (size_t)b.basis.size;
            double q = 0;
            for (int i = 0; i < b.basis.size; i++) q += v[i] * f[i] / b.basis.lambda[j];
            for (int i = 0; i < b.basis.size; i++) g[i] -= q * v[i];
        }
        for (int i = 0; i < b.basis.size; i++) off = fmax(off, fabs(g[i]));
        if (with)
            assert_true(off < 1e-9 * most);
        else
            assert_true(off > 0.5 * most);
        bench_end(&b);
    }
}

static void test_integrals(void **state)
{
    static const struct body_damping damping = {.zeta = 0.01};
    struct bench b;
    double Me[100], m = bar_density * bar_length * bar_width * bar_height;
    (void)state;
    bench_make(&b, BAR, false, true, CRAIG_BAMPTON, 10);
    struct flex_body *o = body_make(&b.fe, &b.basis, b.tie, 1, 0, false, &damping, b.life);
    close_to(o->mass, m, 1e-9 * m, "mass");
    close_to(b.fe.centre[0], 0.5, 1e-9, "centre");
    close_to(o->xx[0], m / 12, 1e-9 * m, "int x x dm");
    close_to(o->xx[4], m * 0.01 / 12, 1e-9 * m, "int y y dm");
    close_to(o->xx[8], m * 0.0036 / 12, 1e-9 * m, "int z z dm");
    for (int k = 1; k < 9; k++)
        if (k % 4) close_to(o->xx[k], 0, 1e-9 * m, "int x y dm");
    flex_mass(Me, o);
    for (int k = 0; k < 100; k++) close_to(Me[k], k % 11 == 0, 1e-9, "Me = 1");
    close_to(o->D[11], 2 * 0.01 * sqrt(bar_clamped[1]), 1e-6, "damping");
    close_to(o->hertz[0] * two_pi, sqrt(bar_clamped[0]), 1e-4, "hertz");
    bench_end(&b);
}

/* Linear and angular momentum of the modes from f and xf against r' M phi with rigid motions r about the root. */
static void test_momentum(void **state)
{
    static const struct body_damping none = {0};
    struct bench b;
    double e[60];
    (void)state;
    bench_make(&b, BAR, false, true, CRAIG_BAMPTON, 10);
    struct flex_body *o = body_make(&b.fe, &b.basis, b.tie, 1, 0, false, &none, b.life);
    words_effective(e, &b.fe, &b.basis, b.tie, b.life);
    double share = 0, first = 0;
    for (int j = 0; j < 10; j++) {
        const double *f = o->f + 3 * j, *xf = o->xf + 9 * j, *x0 = o->node[0].x;
        double turn = (xf[2 + 3 * 0] - xf[0 + 3 * 2]) - (x0[2] * f[0] - x0[0] * f[2]); /* about y */
        if (j == 0) first = turn * turn / e[4];
        if (j == 0) share = f[2] * f[2] / e[2];
        close_to(f[2] * f[2], e[2 + 6 * j] * share, 1e-9, "momentum");
        close_to(turn * turn, e[4 + 6 * j] * first, 1e-9, "angular momentum");
    }
    close_to(share, o->mass, 0.06 * o->mass, "mass that moves");
    assert_true(share < o->mass);
    bench_end(&b);
}

static void test_units(void **state)
{
    const struct fe_source source = {.job = BAR, .units = {.length = 1e-3, .mass = 1e3, .time = 1}};
    const struct tie_options options = {.name = "root", .where = "root", .rigid = true};
    struct bench b = {.life = arena_open()};
    (void)state;
    must(fe_read(&b.fe, &source, b.life, &b.report), &b);
    must(tie_make(b.tie, &options, &b.fe, b.life, &b.report), &b);
    must(basis_make(&b.basis, &b.fe, b.tie, 1, &(struct basis_options){.method = EIGENMODES, .modes = 3}, b.life,
                    &b.report),
         &b);
    close_to(b.fe.mass, 16680, 1e-6, "mass in kg");
    close_to(b.fe.centre[0], 0.5e-3, 1e-12, "centre in m");
    for (int j = 0; j < 3; j++) close_to(b.basis.lambda[j], bar_clamped[j], 2e-7 * bar_clamped[j], "omega^2");
    bench_end(&b);
}

/* One line of an .frd file: node and n values of 12 characters. */
static int frd_line(double *x, int n, const char *line)
{
    char word[16];
    snprintf(word, sizeof word, "%.10s", line + 3);
    for (int k = 0; k < n; k++) {
        char value[16];
        snprintf(value, sizeof value, "%.12s", line + 13 + 12 * k);
        x[k] = strtod(value, NULL);
    }
    return atoi(word);
}

/* The displacements under 100 N shared by the tip's nodes. */
static void bend(double *u, struct bench *b)
{
    const struct tie *root = b->tie;
    struct hold hold;
    must(hold_make(&hold, &b->fe, &root, 1, b->life, &b->report), b);
    for (int i = 0; i < b->tie[1].n; i++) u[3 * b->tie[1].node[i] + 2] = 100.0 / b->tie[1].n;
    hold_solve(u, &hold, u);
}

/* Stresses as CalculiX makes them, at all corners and between. */
static void test_stress(void **state)
{
    static const int order[6] = {0, 1, 2, 3, 5, 4}; /* xx yy zz xy yz zx */
    struct bench b;
    char line[200];
    int part = 0, compared = 0;
    double most = 0, root = 0;
    (void)state;
    bench_make(&b, BAR, true, false, CRAIG_BAMPTON, 0);
    double *u = TAKE(b.life, double, 3 * b.fe.n);
    bend(u, &b);
    FILE *file = fopen("tests/reduce/bar-static.frd", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        double x[6], s[6];
        if (strncmp(line, " -4", 3) == 0) part++; /* 1 displacements, 2 stresses */
        if (strncmp(line, " -1", 3) != 0 || part < 1 || part > 2) continue;
        int node = fe_node(&b.fe, frd_line(x, part == 1 ? 3 : 6, line));
        if (part == 1) {
            for (int k = 0; k < 3; k++) close_to(u[3 * node + k], x[k], 1e-9, "displacement");
            continue;
        }
        must(stress_at(s, &b.fe, node, u, bar_E, bar_nu, &b.report), &b);
        for (int k = 0; k < 6; k++) close_to(s[order[k]], x[k], 20, "stress [Pa]"); /* six digits of 2e6 */
        most = fmax(most, fabs(s[0]));
        if (b.fe.x[3 * node] == 0) root = fmax(root, fabs(s[0]));
        compared++;
    }
    fclose(file);
    assert_int_equal(compared, b.fe.n);
    close_to(most, 100 * 1 * 0.03 / (0.1 * pow(0.06, 3) / 12), 0.25 * most, "M z / I");
    close_to(root, most, 1e-9 * most, "the root has the largest");
    bench_end(&b);
}

static void test_file(void **state)
{
    static const struct body_damping damping = {.alpha = 0.1, .beta = 1e-6};
    static const char path[] = "tests-reduce-body.json";
    struct bench b;
    struct flex_body *back;
    double at[3];
    (void)state;
    bench_make(&b, BAR, true, true, CRAIG_BAMPTON, 3);
    struct flex_body *o = body_make(&b.fe, &b.basis, b.tie, 2, 1, true, &damping, b.life);
    o->stress[0].name = "a \"root\" \\ point";
    for (int k = 0; k < 6 * o->n; k++) o->stress[0].tensor[k] = sin(k) * 1e7;
    for (int k = 0; k < 3 * o->n * o->n; k++) o->s[k] = 1 / (1.0 + k % 3 + k / 3 % o->n + k / 3 / o->n);
    const char *text = flex_file_text(o, b.fe.centre, b.life);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    must(flex_file_read(&back, at, path, b.life, &b.report), &b);
    remove(path);
    assert_string_equal(flex_file_text(back, at, b.life), text);
    size_t n = (size_t)o->n, word = sizeof(double);
    assert_memory_equal(back->ff, o->ff, 9 * n * n * word);
    assert_memory_equal(back->s, o->s, 3 * n * n * word);
    assert_memory_equal(back->xs, o->xs, 9 * n * n * word);
    assert_memory_equal(back->K, o->K, n * n * word);
    assert_memory_equal(back->D, o->D, n * n * word);
    assert_memory_equal(back->node[1].phi, o->node[1].phi, 3 * n * word);
    assert_memory_equal(back->node[1].psi, o->node[1].psi, 3 * n * word);
    assert_memory_equal(back->stress[0].tensor, o->stress[0].tensor, 6 * n * word);
    assert_string_equal(back->node[1].name, "tip");
    bench_end(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frequencies), cmocka_unit_test(test_interfaces),
        cmocka_unit_test(test_static),      cmocka_unit_test(test_average_reference),
        cmocka_unit_test(test_load_modes),  cmocka_unit_test(test_integrals),
        cmocka_unit_test(test_momentum),    cmocka_unit_test(test_units),
        cmocka_unit_test(test_stress),      cmocka_unit_test(test_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
