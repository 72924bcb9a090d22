/* compare.c -- two CSV files compared as numbers.
 *
 *     compare [--tol FILE] [--all] GOLDEN RUN
 *     compare --reference [--map FILE] [--columns 'a b'] [--until T] [--within X] [--all] REFERENCE RUN
 *
 * The first form wants the same header, the same number of rows and the same t bit for bit.  Every
 * other number x of the run may differ from its golden g by
 *
 *     |x - g| <= atol + rtol max|column of the golden file|
 *
 * with atol, rtol from the first line `pattern atol rtol` of the tolerance file whose pattern ('*':
 * any run of characters) fits the column; without one, 1e-9 and 1e-9.
 *
 * The second form takes the rows of the run at the reference's own times (to 1e-12 max(1, t)) and
 * gives the error of each column, max|x - ref| / max|ref column|.  A map file says where a column of the
 * reference is a column of the run in other words, one line each: `r = guide.displacement * 1 + 1`; a
 * column without a line has its own name.
 *
 * Lines that start with '#' are comments.  Exit: 0 within the tolerance, 1 not, 2 the files or
 * arguments are wrong. */
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct table {
    const char *file;
    int ncol, nrow;
    char **name;  /* [ncol] */
    double **col; /* [ncol][nrow] */
};

static void die(const char *file, const char *what)
{
    fprintf(stderr, "compare: %s: %s\n", file, what);
    exit(2);
}

static void *grow(void *p, size_t bytes)
{
    p = realloc(p, bytes ? bytes : 1);
    if (!p) die("-", "out of memory");
    return p;
}

/* The next line without its end and its comment lines; NULL at the end of the file. */
static char *next_line(FILE *f)
{
    static char *line = NULL;
    static size_t room = 0;
    ssize_t len;

    while ((len = getline(&line, &room, f)) >= 0) {
        while (len > 0 && (line[len - 1] == '\n' || line[len - 1] == '\r')) line[--len] = 0;
        if (len > 0 && line[0] != '#') return line;
    }
    return NULL;
}

/* Splits at commas in place: the field at *at, which moves on; NULL when there is none left. */
static char *next_field(char **at)
{
    char *field = *at;

    if (!field) return NULL;
    char *comma = strchr(field, ',');
    if (comma) *comma++ = 0;
    *at = comma;
    return field;
}

static double number(const struct table *t, const char *text)
{
    char *end;
    double x = strtod(text, &end);

    if (end == text || *end) {
        fprintf(stderr, "compare: %s: row %d: '%s' is not a number\n", t->file, t->nrow + 1, text);
        exit(2);
    }
    return x;
}

static void read_header(struct table *t, char *line)
{
    char *field;

    if (!line) die(t->file, "empty");
    while ((field = next_field(&line))) {
        t->name = grow(t->name, (size_t)(t->ncol + 1) * sizeof *t->name);
        t->name[t->ncol++] = strdup(field);
    }
    t->col = grow(NULL, (size_t)t->ncol * sizeof *t->col);
    memset(t->col, 0, (size_t)t->ncol * sizeof *t->col);
}

static struct table read_table(const char *file)
{
    struct table t = {.file = file};
    FILE *f = fopen(file, "r");
    char *line, *field;

    if (!f) die(file, strerror(errno));
    read_header(&t, next_line(f));
    while ((line = next_line(f))) {
        int c = 0;
        while ((field = next_field(&line))) {
            if (c == t.ncol) die(file, "a row has more fields than the header");
            t.col[c] = grow(t.col[c], (size_t)(t.nrow + 1) * sizeof **t.col);
            t.col[c++][t.nrow] = number(&t, field);
        }
        if (c < t.ncol) die(file, "a row has fewer fields than the header");
        t.nrow++;
    }
    if (t.nrow == 0) die(file, "no rows");
    fclose(f);
    return t;
}

static void free_table(struct table *t)
{
    for (int c = 0; c < t->ncol; c++) {
        free(t->name[c]);
        free(t->col[c]);
    }
    free(t->name);
    free(t->col);
}

static int find_column(const struct table *t, const char *name)
{
    for (int c = 0; c < t->ncol; c++)
        if (strcmp(t->name[c], name) == 0) return c;
    return -1;
}

static double column_scale(const double *x, int n)
{
    double scale = 0;

    for (int i = 0; i < n; i++) scale = fmax(scale, fabs(x[i]));
    return scale;
}

static bool fits(const char *pattern, const char *name)
{
    if (*pattern == '*') return fits(pattern + 1, name) || (*name && fits(pattern, name + 1));
    return *pattern == *name && (*pattern == 0 || fits(pattern + 1, name + 1));
}

/* Is e worse than the worst so far?  Not a number is worst of all and stays. */
static bool worse(double e, double worst)
{
    return !isnan(worst) && !(e <= worst);
}

/* ---- golden ---------------------------------------------------------------------------------- */

struct tolerance {
    char pattern[128];
    double atol, rtol;
};

static int read_tolerances(struct tolerance *tol, int most, const char *file)
{
    int n = 0;
    char *line;
    FILE *f = fopen(file, "r");

    if (!f) die(file, strerror(errno));
    while ((line = next_line(f))) {
        if (n == most) die(file, "too many lines");
        if (sscanf(line, "%127s %lf %lf", tol[n].pattern, &tol[n].atol, &tol[n].rtol) != 3)
            die(file, "a line is not `pattern atol rtol`");
        n++;
    }
    fclose(f);
    return n;
}

static struct tolerance tolerance_of(const struct tolerance *tol, int n, const char *name)
{
    for (int i = 0; i < n; i++)
        if (fits(tol[i].pattern, name)) return tol[i];
    return (struct tolerance){.pattern = "*", .atol = 1e-9, .rtol = 1e-9};
}

static int same_shape(const struct table *g, const struct table *x)
{
    int bad = 0;

    for (int c = 0; c < g->ncol || c < x->ncol; c++) {
        const char *a = c < g->ncol ? g->name[c] : "(none)", *b = c < x->ncol ? x->name[c] : "(none)";
        if (strcmp(a, b) != 0) {
            printf("header: column %d is '%s', should be '%s'\n", c + 1, b, a);
            bad = 1;
        }
    }
    if (g->nrow != x->nrow) {
        printf("rows: %d, should be %d\n", x->nrow, g->nrow);
        bad = 1;
    }
    return !bad;
}

/* Row of the largest excess over the tolerance; *d: the difference there. */
static int worst_row(double *d, const double *g, const double *x, int n)
{
    int worst = 0;

    *d = -1;
    for (int i = 0; i < n; i++) {
        double e = fabs(x[i] - g[i]);
        if (isnan(x[i]) && isnan(g[i])) e = 0;
        if (worse(e, *d)) {
            *d = e;
            worst = i;
        }
    }
    return worst;
}

static int compare_golden(const struct table *g, const struct table *x, const char *tolfile, bool all)
{
    static struct tolerance tol[256];
    int ntol = tolfile ? read_tolerances(tol, 256, tolfile) : 0;
    int bad = 0;

    if (!same_shape(g, x)) return 1;
    for (int c = 0; c < g->ncol; c++) {
        double d, scale = column_scale(g->col[c], g->nrow);
        struct tolerance o = tolerance_of(tol, ntol, g->name[c]);
        double most = strcmp(g->name[c], "t") == 0 ? 0 : o.atol + o.rtol * scale;
        int i = worst_row(&d, g->col[c], x->col[c], g->nrow);
        bool over = !(d <= most);

        if (over || all)
            printf("%s %s: worst in row %d (t = %.17g): %.17g, should be %.17g, difference %.3g, allowed %.3g\n",
                   over ? "FAIL" : "ok  ", g->name[c], i + 1, g->col[0][i], x->col[c][i], g->col[c][i], d, most);
        bad |= over;
    }
    return bad;
}

/* ---- reference ------------------------------------------------------------------------------- */

/* A column of the reference as column * a + b of the run. */
struct link {
    double a, b;
    int col;
};

static int must_find(const struct table *run, const char *name)
{
    int c = find_column(run, name);

    if (c < 0) {
        fprintf(stderr, "compare: %s: no column '%s'\n", run->file, name);
        exit(2);
    }
    return c;
}

/* The map's line for name; without one the same name, as it is. */
static struct link find_link(const struct table *run, const char *name, const char *mapfile)
{
    struct link o = {1, 0, -1};
    FILE *f = mapfile ? fopen(mapfile, "r") : NULL;
    char *line;

    if (mapfile && !f) die(mapfile, strerror(errno));
    while (f && (line = next_line(f))) {
        char left[128], right[128];
        if (sscanf(line, " %127s = %127s * %lf + %lf", left, right, &o.a, &o.b) != 4)
            die(mapfile, "a line is not `reference-column = column * a + b`");
        if (strcmp(left, name) == 0) {
            o.col = must_find(run, right);
            break;
        }
        o = (struct link){1, 0, -1};
    }
    if (f) fclose(f);
    if (o.col < 0) o.col = must_find(run, name);
    return o;
}

static int row_at(const struct table *run, int tcol, double t)
{
    for (int i = 0; i < run->nrow; i++)
        if (fabs(run->col[tcol][i] - t) <= 1e-12 * fmax(1, fabs(t))) return i;
    fprintf(stderr, "compare: %s: no row at t = %.17g\n", run->file, t);
    exit(2);
}

/* Is name in the list of words? */
static bool wanted(const char *list, const char *name)
{
    size_t len = strlen(name);

    if (!list) return true;
    for (const char *at = list; (at = strstr(at, name)); at += len)
        if ((at == list || at[-1] == ' ') && (at[len] == ' ' || at[len] == 0)) return true;
    return false;
}

struct judge {
    const char *map, *columns;
    double until, within;
    bool all;
};

static int compare_reference(const struct table *ref, const struct table *run, const struct judge *o)
{
    int tref = find_column(ref, "t"), trun = find_column(run, "t");
    double worst = 0;

    if (tref < 0 || trun < 0) die(tref < 0 ? ref->file : run->file, "no column 't'");
    for (int c = 0; c < ref->ncol; c++) {
        if (c == tref || !wanted(o->columns, ref->name[c])) continue;
        struct link m = find_link(run, ref->name[c], o->map);
        double scale = column_scale(ref->col[c], ref->nrow), error = 0, at = 0;

        for (int i = 0; i < ref->nrow && ref->col[tref][i] <= o->until; i++) {
            double e = fabs((m.a * run->col[m.col][row_at(run, trun, ref->col[tref][i])] + m.b) - ref->col[c][i]);
            e = scale > 0 ? e / scale : e;
            if (worse(e, error)) {
                error = e;
                at = ref->col[tref][i];
            }
        }
        if (o->all) printf("%s: error %.3g of scale %.3g at t = %.6g\n", ref->name[c], error, scale, at);
        if (worse(error, worst)) worst = error;
    }
    if (!o->all) printf("%.4e\n", worst);
    if (!(worst <= o->within)) {
        fprintf(stderr, "compare: error %.3g, allowed %.3g\n", worst, o->within);
        return 1;
    }
    return 0;
}

static int usage(void)
{
    fputs("usage: compare [--tol FILE] [--all] GOLDEN RUN\n"
          "       compare --reference [--map FILE] [--columns 'a b'] [--until T] [--within X] [--all] REFERENCE RUN\n",
          stderr);
    return 2;
}

int main(int argc, char **argv)
{
    const char *tol = NULL, *file[2];
    struct judge o = {.until = INFINITY, .within = INFINITY};
    bool reference = false;
    int nfile = 0;

    for (int i = 1; i < argc; i++) {
        bool more = i + 1 < argc;
        if (strcmp(argv[i], "--reference") == 0)
            reference = true;
        else if (strcmp(argv[i], "--all") == 0)
            o.all = true;
        else if (more && strcmp(argv[i], "--tol") == 0)
            tol = argv[++i];
        else if (more && strcmp(argv[i], "--map") == 0)
            o.map = argv[++i];
        else if (more && strcmp(argv[i], "--columns") == 0)
            o.columns = argv[++i];
        else if (more && strcmp(argv[i], "--until") == 0)
            o.until = atof(argv[++i]);
        else if (more && strcmp(argv[i], "--within") == 0)
            o.within = atof(argv[++i]);
        else if (nfile < 2 && argv[i][0] != '-')
            file[nfile++] = argv[i];
        else
            return usage();
    }
    if (nfile != 2) return usage();

    struct table a = read_table(file[0]), b = read_table(file[1]);
    int result = reference ? compare_reference(&a, &b, &o) : compare_golden(&a, &b, tol, o.all);
    free_table(&a);
    free_table(&b);
    return result;
}
