/* judge.c -- runs mechanisms drawn at random and says of each whether the program agrees with itself.
 *
 *     judge PROGRAM FOLDER MECHANISM FROM TO
 *
 * For every seed the motion by dopri5 is the reference (looked at with two tolerances).  Then
 *
 *   order     midpoint, newmark and subcycle, from the step on at which they are within 2 percent, lose three quarters of
 *             their error with each half of the step
 *   renamed   other names give the same numbers, bit for bit
 *   reversed  members in another order: the same motion
 *   turned    the scene turned and shifted: the motion turned and shifted
 *             (of loops whose other coordinates have larger errors of their own: these, too, fall as order 2)
 *   restart   half a run, its state, the other half: the uninterrupted run, bit for bit
 *
 * Errors are taken of places, velocities and reactions, each by what its column changes by and at least a hundredth of the
 * most in its group. */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mechanism.h"

enum { ROWS = 16, COLUMNS = 2 * 3 * 2 * BODIES + 3 * BODIES + 2, ARGS = 24, most_seconds = 10 };

static const double same_tree = 1e-7;       /* of a tree under its own fixed steps, reversed or turned */
static const double same_motion = 1e-5;     /* by dopri5, whatever coordinates are chosen */
static const double most_unbalanced = 3e-4; /* error below which a run keeps its balance */
static const double most_work = 60000;      /* minor steps times bodies, of a beam three */

struct table {
    int ncol, nrow, status, rejected;
    double x[ROWS][COLUMNS];
    char said[TEXT];
};

struct judge {
    const char *program, *folder, *maker;
    struct mechanism m;
    int ncol, lengths;
    double scale[COLUMNS];
    struct table ref;
    double floor; /* what the reference itself may be wrong by */
    bool shown;   /* the last order asked for was there */
    double work;  /* most_work, more where the first step that tells is small */
    bool failed;
    char note[400];
};

/* ---- one run --------------------------------------------------------------------------------- */

static void path_of(char *o, const struct judge *j, const char *name)
{
    snprintf(o, TEXT, "%s/%s", j->folder, name);
}

static void read_table(struct table *o, const char *path)
{
    static char line[1 << 16];
    FILE *f = fopen(path, "r");

    o->nrow = 0;
    if (!f || !fgets(line, sizeof line, f)) {
        if (f) fclose(f);
        return;
    }
    while (o->nrow < ROWS && fgets(line, sizeof line, f)) {
        char *at = line, *end = line;
        o->ncol = 0;
        do {
            o->x[o->nrow][o->ncol++] = strtod(at, &end);
            at = end + 1;
        } while (*end == ',' && o->ncol < COLUMNS);
        o->nrow++;
    }
    fclose(f);
}

static void read_said(struct table *o, const char *path)
{
    char line[TEXT];
    FILE *f = fopen(path, "r");

    o->said[0] = 0;
    o->rejected = 0;
    while (f && fgets(line, sizeof line, f)) {
        sscanf(line, "rejected %d", &o->rejected);
        if (!o->said[0] && (strstr(line, "error") || strncmp(line, "fmdsub: ", 8) == 0)) memcpy(o->said, line, TEXT);
    }
    o->said[strcspn(o->said, "\n")] = 0;
    if (f) fclose(f);
}

/* The program on a deck of the folder with more arguments, ended by NULL. */
static void run(struct table *o, const struct judge *j, const char *deck, ...)
{
    char in[TEXT], out[TEXT], err[TEXT];
    const char *argv[ARGS] = {j->program, "run", "-q", "--stats", in};
    int n = 5, code;
    va_list more;

    path_of(in, j, deck), path_of(out, j, "out"), path_of(err, j, "err");
    va_start(more, deck);
    while (n < ARGS - 1 && (argv[n] = va_arg(more, const char *))) n++;
    va_end(more);
    argv[n] = NULL;
    pid_t child = fork();
    if (child == 0) {
        int to = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600), told = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(to, 1), dup2(told, 2);
        setrlimit(RLIMIT_CPU, &(struct rlimit){most_seconds, most_seconds});
        execv(j->program, (char *const *)argv);
        _exit(127);
    }
    while (waitpid(child, &code, 0) < 0 && errno == EINTR) {
    }
    o->status = WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
    read_table(o, out);
    read_said(o, err);
}

static void run_scheme(struct table *o, const struct judge *j, const char *deck, const char *scheme, int k, bool tight)
{
    char step[TEXT], how[TEXT];

    snprintf(how, TEXT, "integrate.scheme=%s", scheme);
    snprintf(step, TEXT, "integrate.step=%.17g", j->m.until / 10 / (1 << k) / j->m.ratio);
    run(o, j, deck, "-s", how, "-s", step, tight ? "-s" : NULL, "integrate.newton_tolerance=1.0e-12", NULL);
}

static void write_variant(const struct judge *j, const char *deck, struct variant v)
{
    char path[TEXT];

    path_of(path, j, deck);
    FILE *f = fopen(path, "w");
    if (!f) {
        fprintf(stderr, "judge: %s: %s\n", path, strerror(errno));
        exit(2);
    }
    mechanism_write(f, &j->m, &v);
    fclose(f);
}

/* ---- how far apart --------------------------------------------------------------------------- */

static int group_of(const struct judge *j, int c)
{
    if (c == j->ncol) return 3; /* energy; column 0 is t */
    return c <= j->lengths ? 0 : c <= 2 * j->lengths ? 1 : 2;
}

static void set_scales(struct judge *j)
{
    double most[4] = {1e-3, 1e-2, 1e-2, 1e-3};

    for (int c = 1; c <= j->ncol; c++) {
        double least = INFINITY, largest = -INFINITY;
        int group = group_of(j, c);
        for (int i = 0; i < j->ref.nrow; i++) {
            least = fmin(least, j->ref.x[i][c]);
            largest = fmax(largest, j->ref.x[i][c]);
        }
        j->scale[c] = group == 0 ? largest - least : fmax(fabs(largest), fabs(least));
        most[group] = fmax(most[group], j->scale[c]);
    }
    for (int c = 1; c <= j->ncol; c++) j->scale[c] = fmax(j->scale[c], 1e-2 * most[group_of(j, c)]);
}

/* The largest difference, as a share of its scale; without rows infinite. */
static double apart(const struct judge *j, const struct table *a, const struct table *b)
{
    double worst = 0;

    if (a->nrow == 0 || a->nrow != b->nrow || a->ncol != b->ncol || a->ncol != j->ncol + 1) return INFINITY;
    for (int i = 0; i < a->nrow; i++)
        for (int c = 1; c <= j->ncol; c++) {
            double d = fabs(a->x[i][c] - b->x[i][c]) / j->scale[c];
            if (!(d <= worst)) worst = isnan(d) ? INFINITY : d;
        }
    return worst;
}

/* The last row only: a restarted run begins in the middle. */
static double ends_apart(const struct judge *j, const struct table *a, const struct table *b)
{
    struct table x = *a, y = *b;

    if (a->nrow == 0 || b->nrow == 0) return INFINITY;
    memcpy(x.x[0], a->x[a->nrow - 1], sizeof x.x[0]);
    memcpy(y.x[0], b->x[b->nrow - 1], sizeof y.x[0]);
    x.nrow = y.nrow = 1;
    return apart(j, &x, &y);
}

/* The reference of the turned scene. */
static void turn_table(struct table *o, const struct judge *j, const struct table *a)
{
    *o = *a;
    for (int i = 0; i < a->nrow; i++)
        for (int c = 1; c + j->m.dim <= j->ncol; c += j->m.dim) {
            struct vec v = {{0, 0, 0}};
            memcpy(v.x, &a->x[i][c], (size_t)j->m.dim * sizeof(double));
            mechanism_turn(&v, &j->m, &v, c <= j->lengths);
            memcpy(&o->x[i][c], v.x, (size_t)j->m.dim * sizeof(double));
        }
}

/* ---- the judgements -------------------------------------------------------------------------- */

static void say(struct judge *j, const char *format, ...)
{
    size_t n = strlen(j->note);
    va_list more;

    va_start(more, format);
    vsnprintf(j->note + n, sizeof j->note - n, format, more);
    va_end(more);
}

static void blame(struct judge *j, const struct table *t, const char *what, const char *deck, const char *format, ...)
{
    va_list more;

    if (!j->failed) printf("not ok random %d: %s", (int)j->m.seed, what), putchar('\n');
    j->failed = true;
    printf("    %s: ", what);
    va_start(more, format);
    vprintf(format, more);
    va_end(more);
    printf("\n    see: %s %d %s >m.yaml; %s run -s ... m.yaml\n", j->maker, (int)j->m.seed, deck, j->program);
    if (t && t->said[0]) printf("    | %s\n", t->said);
}

static bool affordable(const struct judge *j, int k)
{
    return 10. * j->m.ratio * (1 << k) * (j->m.nbody + 3 * j->m.nflex) <= j->work;
}

/* Did the error fall as order 2 with each of the last three halves, whatever steps were rejected on the way? */
static bool steady(const double *e, int from, int k)
{
    for (int i = k - 2; i <= k; i++)
        if (i <= from || log2(e[i - 1] / e[i]) < 1.5) return false;
    return true;
}

/* Returns the first k at which the scheme was within 2 percent of ref on a deck, -1 if that is too small a step for a
 * test. */
static int judge_order(struct judge *j, const char *scheme, const char *deck, const struct table *ref, double *first)
{
    double e[20];
    j->shown = false;
    int k0 = -1, low = 3, regular = 0, rejected = 0;

    for (int k = low; k < 20; k++) {
        static struct table t;
        if (!affordable(j, k)) break;
        run_scheme(&t, j, deck, scheme, k, false);
        e[k] = apart(j, &t, ref);
        if (t.status > 5 || t.status == 2 || t.status == 3) {
            blame(j, &t, scheme, "", "exit status %d at step 0.05/%d/%d", t.status, 1 << k, j->m.ratio);
            return -1;
        }
        if (!(e[k] < 0.02)) k0 = -1; /* within it by chance before */
        if (k0 < 0 && e[k] < 0.02) {
            k0 = k;
            *first = e[k];
            regular = 0;
        }
        if (k0 < 0) continue;
        if (t.status > 1 || (t.status == 1 && e[k] < most_unbalanced)) {
            blame(j, &t, scheme, "", "exit status %d at step 0.05/%d/%d, error %.3g", t.status, 1 << k, j->m.ratio,
                  e[k]);
            return k0;
        }
        if (e[k] < 20 * j->floor) {
            say(j, " %s ok", scheme);
            j->shown = true;
            return k0;
        }
        regular = t.rejected == 0 ? regular + 1 : 0;
        rejected = t.rejected;
        double slope = regular > 2 || steady(e, k0, k) ? fmax(log2(e[k - 2] / e[k]) / 2, log2(e[k - 1] / e[k])) : 0;
        if (slope > (j->m.rough ? 0.7 : 1.75)) {
            say(j, t.rejected ? " %s %.2f (%d rejected)" : " %s %.2f", scheme, slope, t.rejected);
            j->shown = true;
            return k0;
        }
        if (k == k0 + 5) break;
    }
    if (rejected)
        say(j, " %s rejects %d", scheme, rejected);
    else if (k0 < 0 || regular < 4) /* too few steps without a rejection to tell */
        say(j, " %s unresolved", scheme);
    else {
        blame(j, NULL, scheme, "", "errors with h halved do not fall as order 2; the reference is good to %.1g",
              j->floor);
        printf("    ");
        for (int k = k0; k < 20 && k <= k0 + 5 && affordable(j, k); k++) printf(" %.3g", e[k]);
        printf(" from h = 0.05/%d/%d\n", 1 << k0, j->m.ratio);
    }
    return k0;
}

/* A loop in other places may have other independent coordinates, whose errors are other ones: do they fall as they must?
 * All errors are of the scene in its place. */
static bool falls(struct judge *j, const char *word, const char *deck, const struct table *wanted)
{
    double first;
    say(j, "; %s", word);
    j->work = 4 * most_work;
    const bool order = judge_order(j, "subcycle", deck, wanted, &first) >= 0 && j->shown;
    j->work = most_work;
    return order;
}

static void in_place(struct table *o, const struct judge *j, const struct table *a, struct variant v)
{
    if (v.turned)
        turn_table(o, j, a);
    else
        *o = *a;
}

static void judge_variant(struct judge *j, const char *word, struct variant v, const struct table *base, int k,
                          double error)
{
    static struct table t, wanted, smooth;
    char deck[TEXT];

    snprintf(deck, sizeof deck, "%s.yaml", word);
    write_variant(j, deck, v);
    run_scheme(&t, j, deck, "subcycle", k, true);
    in_place(&wanted, j, base, v);
    double d = apart(j, &t, &wanted),
           limit = v.renamed ? 0 : fmax(same_tree, (j->m.nloop || base->rejected || t.rejected ? 10 : 1e-3) * error);
    in_place(&wanted, j, &j->ref, v);
    if (t.status != base->status || (!(d <= limit) && (!j->m.nloop || v.renamed || !falls(j, word, deck, &wanted))))
        blame(j, &t, word, word, "subcycle, step 0.05/%d/%d: exit status %d (was %d), differs by %.3g, allowed %.1g",
              1 << k, j->m.ratio, t.status, base->status, d, limit);
    if (v.renamed) return;
    run(&smooth, j, deck, "-s", "integrate.scheme=dopri5", "-s", "integrate.tolerance=1.0e-10", NULL);
    d = apart(j, &smooth, &wanted);
    if (smooth.status != j->ref.status || !(d <= fmax(same_motion, 20 * j->floor)))
        blame(j, &smooth, word, word, "dopri5: exit status %d, differs by %.3g", smooth.status, d);
}

static void judge_restart(struct judge *j, const struct table *base, int k)
{
    static struct table t;
    char step[TEXT], half[TEXT], state[TEXT];

    snprintf(step, TEXT, "integrate.step=%.17g", j->m.until / 10 / (1 << k) / j->m.ratio);
    snprintf(half, TEXT, "%.17g", j->m.until / 2);
    path_of(state, j, "state.json");
    run(&t, j, "base.yaml", "-s", step, "-s", "integrate.newton_tolerance=1.0e-12", "--until", half, "--final-state",
        state, NULL);
    if (t.status <= 1)
        run(&t, j, "base.yaml", "-s", step, "-s", "integrate.newton_tolerance=1.0e-12", "-s",
            "initial={from: state.json, time: keep}", NULL);
    double d = ends_apart(j, &t, base);
    if (t.status != base->status || d != 0)
        blame(j, &t, "restart", "", "subcycle, step 0.05/%d/%d: exit status %d (was %d), the end differs by %.3g",
              1 << k, j->m.ratio, t.status, base->status, d);
}

static bool judge_reference(struct judge *j)
{
    static struct table loose;

    run(&j->ref, j, "base.yaml", "-s", "integrate.scheme=dopri5", "-s", "integrate.tolerance=1.0e-10", NULL);
    if (j->ref.status == 4 || j->ref.status == 5) {
        say(j, " stops: %s", j->ref.said);
        return false;
    }
    if (j->ref.status != 0 || j->ref.ncol != j->ncol + 1) {
        blame(j, &j->ref, "dopri5", "", "exit status %d, %d columns, %d wanted", j->ref.status, j->ref.ncol,
              j->ncol + 1);
        return false;
    }
    set_scales(j);
    run(&loose, j, "base.yaml", "-s", "integrate.scheme=dopri5", "-s", "integrate.tolerance=1.0e-8", NULL);
    j->floor = apart(j, &loose, &j->ref);
    if (!(j->floor < 1e-4))
        blame(j, &loose, "dopri5", "", "exit status %d, tolerances 1e-8 and 1e-10 differ by %.3g", loose.status,
              j->floor);
    j->floor = fmax(0.1 * j->floor, 1e-9);
    return !j->failed;
}

static void judge_seed(struct judge *j, uint64_t seed)
{
    static struct table base;
    double error = 0, other;

    mechanism_draw(&j->m, seed);
    j->work = most_work;
    j->failed = false;
    j->note[0] = 0;
    write_variant(j, "base.yaml", (struct variant){false, false, false});
    FILE *sink = fopen("/dev/null", "w");
    j->ncol = mechanism_columns(sink, &j->m, &(struct variant){false, false, false}, &j->lengths);
    fclose(sink);
    if (judge_reference(j)) {
        judge_order(j, "midpoint", "base.yaml", &j->ref, &other);
        judge_order(j, "newmark", "base.yaml", &j->ref, &other);
        int k = judge_order(j, "subcycle", "base.yaml", &j->ref, &error);
        if (k >= 0) {
            run_scheme(&base, j, "base.yaml", "subcycle", k, true);
            judge_restart(j, &base, k);
            judge_variant(j, "renamed", (struct variant){.renamed = true}, &base, k, error);
            judge_variant(j, "reversed", (struct variant){.reversed = true}, &base, k, error);
            judge_variant(j, "turned", (struct variant){.turned = true}, &base, k, error);
        }
    }
    printf(j->failed ? "    | " : "ok random %d:", (int)seed);
    printf("%s; ", j->note);
    mechanism_tell(stdout, &j->m);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    static struct judge j;

    if (argc != 6) {
        fputs("usage: judge PROGRAM FOLDER MECHANISM FROM TO\n", stderr);
        return 2;
    }
    j.program = argv[1], j.folder = argv[2], j.maker = argv[3];
    for (long seed = atol(argv[4]); seed <= atol(argv[5]); seed++) judge_seed(&j, (uint64_t)seed);
    return 0;
}
