/* t-prestress.c -- geometric stiffness: signs and sums of all loads on made-up fields, and a bar that spins. */
#include <unistd.h>

#include "la/eigen.h"
#include "la/vec3.h"
#include "reduce/bar.h"

enum { MODES = 12 };

static void bar_body(struct bench *b, struct flex_body **o, bool tip, int modes)
{
    static const struct body_damping none = {0};
    bench_make(b, BAR, tip, false, CRAIG_BAMPTON, modes);
    *o = body_make(&b->fe, &b->basis, b->tie, 1 + tip, 0, true, &none, b->life);
}

static struct options *bar_loads(struct bench *b)
{
    static const struct load_options loads[] = {{"accel-x", 10, BAR "-accel-x.sti"},
                                                {"spin-xx", 1e4, BAR "-spin-xx.sti"},
                                                {"spin-yy", 100, BAR "-spin-yy.sti"},
                                                {"spin-zz", 100, BAR "-spin-zz.sti"}};
    struct options *options = TAKE(b->life, struct options, 1);
    options->ntie = 1;
    options->nload = 4;
    memcpy(options->load, loads, sizeof loads);
    options->quiet = true;
    return options;
}

/* The body turning about the axis k through x = 0 at W: K + W2 (Kgeo - softening), with
 *     Kgeo = sum (e e' - 1)_lm X_lm - c . s    (every particle stands c + r from the axis: spin and push outwards)
 *     softening = int phi_i' (1 - e e') phi_j dm */
static void spun(double *lambda, const struct flex_body *o, double c, int k, double W2)
{
    double K[MODES * MODES], M[MODES * MODES], Y[MODES * MODES];
    int n = o->n;
    for (int at = 0; at < n * n; at++) {
        K[at] = o->K[at];
        M[at] = at % (n + 1) == 0;
        for (int a = 0; a < 3; a++)
            if (a != k) K[at] -= W2 * (o->xs[4 * a + 9 * at] + o->ff[4 * a + 9 * at]);
        K[at] -= W2 * c * o->s[3 * at];
    }
    eigen_general(lambda, Y, K, M, n);
}

static void stress_loads(struct bench *b, struct flex_body *o, int ntie)
{
    struct options *options = TAKE(b->life, struct options, 1);
    options->ntie = ntie;
    options->stiffening = true;
    options->material = true;
    options->E = bar_E;
    options->nu = bar_nu;
    options->quiet = true;
    must(prestress_read(o, options, &b->fe, &b->basis, b->tie, b->life, &b->report), b);
}

/* From stress: the same for bending; torsion and stretch also feel that the bar is longer, by strains of 2e-4. */
static void test_stress(void **state)
{
    struct bench b;
    struct flex_body *o;
    double lambda[MODES];
    (void)state;
    bar_body(&b, &o, false, MODES);
    double strain = bar_density * 1e4 * bar_length * bar_length / (2 * bar_E);
    stress_loads(&b, o, 1);
    spun(lambda, o, b.fe.centre[0], 2, 1e4);
    for (int j = 0; j < 7; j++) {
        double shift = fabs(bar_spun[j] - bar_clamped[j]);
        double tolerance = 0.003 * shift + (j < 4 ? 1e-6 : 2 * strain) * bar_spun[j];
        close_to(lambda[j], bar_spun[j], tolerance, "omega^2 of the spinning bar");
    }
    bench_end(&b);
}

/* A pull of 1 N at the tip of a slender bar in its first bending mode v(x): - S_x of the tip is int v'^2 dx, by the
 * trapezoidal rule over the mesh's cross-sections; and nothing bends in itself: S_y, S_z vanish there. */
static void test_shortening(void **state)
{
    struct bench b;
    struct flex_body *o;
    double along = 0, kL = 1.8751040687119611, sigma = 0.7340955137589128, lift, sum = 0;
    (void)state;
    bar_body(&b, &o, true, 4);
    stress_loads(&b, o, 2);
    lift = o->node[1].phi[2]; /* of the first mode, along z */
    for (int i = 0; i < 2000; i++) {
        double x = kL * (i + 0.5) / 2000;
        double slope = kL * (sinh(x) + sin(x) - sigma * (cosh(x) - cos(x))); /* of cosh - cos - sigma (sinh - sin) */
        sum += slope * slope / 2000;
    }
    along = sum * lift * lift / 4; /* the mode is 2 at the tip */
    close_to(-o->node[1].S[0], along, 0.05 * along, "shortening");
    close_to(o->node[1].S[1], 0, 1e-6 * along, "S_y");
    close_to(o->node[1].S[2], 0, 1e-6 * along, "S_z");
    bench_end(&b);
}

/* CalculiX's own CENTRIF, to the digits it prints. */
static void test_centrifugal(void **state)
{
    struct bench b;
    struct flex_body *o;
    double lambda[MODES];
    (void)state;
    bar_body(&b, &o, false, MODES);
    must(prestress_read(o, bar_loads(&b), &b.fe, &b.basis, b.tie, b.life, &b.report), &b);
    spun(lambda, o, b.fe.centre[0], 2, 1e4);
    for (int j = 0; j < 7; j++) {
        double shift = fabs(bar_spun[j] - bar_clamped[j]);
        close_to(lambda[j], bar_spun[j], 0.01 * shift + 2e-7 * bar_spun[j], "omega^2 of the spinning bar");
    }
    bench_end(&b);
}

/* Uniform slender beam, hub of no radius (Wright et al., J. Appl. Mech. 49 (1982) 197): dimensionless flap frequency
 * at speeds 1, 2, 3.  The bar is short and coarse, so the rise of omega^2 is compared. */
static void test_flap(void **state)
{
    static const double flap[][2] = {{1, 3.6816}, {2, 4.1373}, {3, 4.7973}};
    struct bench b;
    struct flex_body *o;
    double lambda[MODES], first = 3.516015;
    (void)state;
    bar_body(&b, &o, false, MODES);
    must(prestress_read(o, bar_loads(&b), &b.fe, &b.basis, b.tie, b.life, &b.report), &b);
    double unit = bar_clamped[0] / (first * first); /* [1/s2] of the dimensionless time */
    for (int k = 0; k < 3; k++) {
        double speed = flap[k][0], want = flap[k][1] * flap[k][1] - first * first;
        spun(lambda, o, b.fe.centre[0], 2, speed * speed * unit);
        close_to(lambda[0] / unit - first * first, want, 0.02 * want, "rise of flap");
    }
    bench_end(&b);
}

/* ---- made-up second-order fields S_I at the nodes: any load f gives Kgeo = - sum f_I . S_I ---- */

static double field(int node, int axis, int i, int j)
{
    return sin(1.0 + 3 * node + axis + 7 * (i + j) + 11 * i * j);
}

/* K + M V G V' M, all rows, as a Matrix Market file: V' of it V = V'KV + G. */
static void write_market(const char *path, const struct bench *b, const double *G)
{
    const struct basis *s = &b->basis;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%%%%MatrixMarket matrix coordinate real symmetric\n%d %d %d\n", s->size, s->size,
            s->size * (s->size + 1) / 2);
    for (int r = 0; r < s->size; r++)
        for (int c = 0; c <= r; c++) {
            const double *k = sparse_at(&b->fe.K, r, c);
            double v = k ? *k : 0;
            for (int j = 0; G && j < s->n; j++)
                for (int i = 0; i < s->n; i++) v += s->MV[r + i * s->size] * G[i + s->n * j] * s->MV[c + j * s->size];
            fprintf(file, "%d %d %.17g\n", r + 1, c + 1, v);
        }
    fclose(file);
}

/* The load of each kind, written out anew: - (acceleration of a particle at r). */
static void push(double *p, int kind, const double *r)
{
    static const double h = 0.70710678118654752440;
    static const double axes[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {h, h, 0}, {h, 0, h}, {0, h, h}};
    double unit[3] = {kind % 3 == 0, kind % 3 == 1, kind % 3 == 2};
    if (kind < 3)
        for (int a = 0; a < 3; a++) p[a] = -unit[a];
    else if (kind < 9) { /* outwards, by the distance from the axis */
        const double *e = axes[kind - 3];
        double along = v3_dot(e, r);
        for (int a = 0; a < 3; a++) p[a] = r[a] - along * e[a];
    } else
        v3_cross(p, r, unit);
}

/* 1 N along k shared by the tip's nodes. */
static void pull(double *f, const struct bench *b, int k)
{
    for (int i = 0; i < b->tie[1].n; i++) f[3 * b->tie[1].node[i] + k] = 1.0 / b->tie[1].n;
}

static void geometric(double *G, const struct bench *b, int kind, double scale)
{
    int n = b->basis.n;
    double *p = TAKE(b->life, double, b->basis.size), *f = TAKE(b->life, double, b->basis.size);
    for (int i = 0; kind < 12 && i < b->fe.n; i++) {
        double r[3];
        v3_diff(r, b->fe.x + 3 * i, b->fe.centre);
        push(p + 3 * i, kind, r);
    }
    sparse_mul(f, &b->fe.M, p);
    if (kind >= 12) pull(f, b, kind - 12);
    for (int at = 0; at < n * n; at++) {
        G[at] = 0;
        for (int i = 0; i < b->basis.size; i++) G[at] -= scale * f[i] * field(i / 3, i % 3, at % n, at / n);
    }
}

static void table_of_nodes(const char *path, const struct fe *fe)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "node,x,y,z,set\n");
    for (int i = 0; i < fe->n; i++)
        fprintf(file, "%d,%.17g,%.17g,%.17g,%s\n", fe->id[i], fe->x[3 * i], fe->x[3 * i + 1], fe->x[3 * i + 2],
                fe->x[3 * i] == 0   ? "root"
                : fe->x[3 * i] == 1 ? "tip"
                                    : "");
    fclose(file);
}

/* The bar again, from Matrix Market files: to the same body. */
static void market_bench(struct bench *m, const char *folder, int modes)
{
    struct bench b;
    char K[99], M[99], table[99];
    bench_make(&b, BAR, true, false, EIGENMODES, modes);
    snprintf(K, sizeof K, "%s/K.mtx", folder);
    snprintf(M, sizeof M, "%s/M.mtx", folder);
    snprintf(table, sizeof table, "%s/nodes.csv", folder);
    table_of_nodes(table, &b.fe);
    write_market(K, &b, NULL);
    struct bench mass = b;
    mass.fe.K = b.fe.M;
    write_market(M, &mass, NULL);
    const struct fe_source source = {.K = K, .M = M, .table = table, .units = {1, 1, 1}};
    const struct tie_options options[] = {{.name = "root", .where = "root", .rigid = true},
                                          {.name = "tip", .where = "tip"}};
    *m = (struct bench){.life = arena_open()};
    must(fe_read(&m->fe, &source, m->life, &m->report), m);
    for (int t = 0; t < 2; t++) must(tie_make(m->tie + t, options + t, &m->fe, m->life, &m->report), m);
    must(basis_make(&m->basis, &m->fe, m->tie, 2, &(struct basis_options){.method = EIGENMODES, .modes = modes},
                    m->life, &m->report),
         m);
    for (int j = 0; j < modes; j++)
        close_to(m->basis.lambda[j], b.basis.lambda[j], 1e-7 * b.basis.lambda[j], "omega^2");
    for (int i = 0; i < m->basis.size; i++) close_to(m->basis.V[i], b.basis.V[i], 1e-6, "mode");
    bench_end(&b);
}

/* All kinds at once must give int S dm, int x S' dm and S at the tip of the fields. */
static void test_all_loads(void **state)
{
    static const char *const kinds[] = {"accel-x", "accel-y", "accel-z",     "spin-xx",     "spin-yy",
                                        "spin-zz", "spin-xy", "spin-xz",     "spin-yz",     "twist-x",
                                        "twist-y", "twist-z", "force-x:tip", "force-y:tip", "force-z:tip"};
    static const struct body_damping none = {0};
    enum { N = 2 };
    char folder[] = "tests-reduce-XXXXXX";
    struct bench b;
    double G[N * N];
    (void)state;
    assert_non_null(mkdtemp(folder));
    market_bench(&b, folder, N);
    struct options *options = TAKE(b.life, struct options, 1);
    options->quiet = true;
    options->ntie = 2;
    options->nload = 15;
    for (int k = 0; k < 15; k++) {
        options->load[k] = (struct load_options){kinds[k], 1e5, arena_print(b.life, "%s/%d.mtx", folder, k)};
        geometric(G, &b, k, 1e5);
        write_market(options->load[k].path, &b, G);
    }
    struct flex_body *o = body_make(&b.fe, &b.basis, b.tie, 2, 0, true, &none, b.life);
    must(prestress_read(o, options, &b.fe, &b.basis, b.tie, b.life, &b.report), &b);
    double *S = TAKE(b.life, double, b.basis.size), *MS = TAKE(b.life, double, b.basis.size);
    for (int at = 0; at < N * N; at++) {
        double s[3] = {0}, xs[9] = {0};
        for (int i = 0; i < b.basis.size; i++) S[i] = field(i / 3, i % 3, at % N, at / N);
        sparse_mul(MS, &b.fe.M, S);
        for (int i = 0; i < b.fe.n; i++) {
            v3_add(s, MS + 3 * i);
            for (int c = 0; c < 9; c++) xs[c] += (b.fe.x[3 * i + c % 3] - b.fe.centre[c % 3]) * MS[3 * i + c / 3];
        }
        double tip[6];
        tie_motion(tip, b.tie + 1, S);
        for (int k = 0; k < 3; k++) close_to(o->node[1].S[k + 3 * at], tip[k], 1e-4, "S of the tip");
        for (int k = 0; k < 3; k++) close_to(o->node[0].S[k + 3 * at], 0, 0, "S of the reference");
        for (int k = 0; k < 3; k++) close_to(o->s[k + 3 * at], s[k], 2e-4, "int S dm");
        for (int k = 0; k < 9; k++) close_to(o->xs[k + 9 * at], xs[k], 5e-4, "int x S' dm");
    }
    char command[120];
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
    bench_end(&b);
}

static void test_refused(void **state)
{
    struct bench b;
    struct flex_body *o;
    (void)state;
    bar_body(&b, &o, false, 4);
    struct options *options = bar_loads(&b);
    options->nload = 3; /* without spin-zz */
    assert_int_equal(prestress_read(o, options, &b.fe, &b.basis, b.tie, b.life, &b.report), E_USAGE);
    assert_non_null(strstr(b.report.text, "go together"));
    memset(&b.report, 0, sizeof b.report);
    options->nload = 2;
    options->load[1] = options->load[0];
    assert_int_equal(prestress_read(o, options, &b.fe, &b.basis, b.tie, b.life, &b.report), E_USAGE);
    assert_non_null(strstr(b.report.text, "twice"));
    bench_end(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_centrifugal), cmocka_unit_test(test_stress),    cmocka_unit_test(test_shortening),
        cmocka_unit_test(test_flap),        cmocka_unit_test(test_all_loads), cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
