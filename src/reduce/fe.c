/* fe.c -- the parts of a body read and fitted together; see fe.h */
#include "reduce/fe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "la/vec3.h"
#include "reduce/fe_check.h"
#include "reduce/matrix.h"

/* Rows of a CalculiX matrix: `node.direction`. */
struct freedoms {
    int n;
    int *id, *axis, *line; /* [n] axis 0 ... 2 */
};

static enum status read_dof(struct freedoms *o, const char *path, struct arena *life, struct report *report)
{
    struct text text;
    TRY(text_open(&text, path, life, report));
    *o = (struct freedoms){
        .id = TAKE(life, int, text.lines), .axis = TAKE(life, int, text.lines), .line = TAKE(life, int, text.lines)};
    for (char *line; (line = text_line(&text));) {
        int id, axis;
        if (word_end(line)) continue;
        if (!word_int(&line, &id) || !word_mark(&line, '.') || !word_int(&line, &axis) || !word_end(line) || id < 1)
            return text_bad(&text, "expected 'node.direction'");
        if (axis < 1 || axis > 3)
            return text_bad(&text, "node %d has freedom %d: only displacements 1, 2, 3 of solids are read", id, axis);
        o->id[o->n] = id;
        o->axis[o->n] = axis - 1;
        o->line[o->n++] = text.line;
    }
    return o->n ? OK : fail(report, E_DECK, "%s: error: no freedoms", path);
}

static int compare_id(const void *a, const void *b)
{
    const int *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* The body's nodes: those that have freedoms. */
static enum status take_nodes(struct fe *o, const int *ids, int n, const char *path, struct arena *life,
                              struct report *report)
{
    int *id = TAKE(life, int, n), count = 0;
    memcpy(id, ids, (size_t)n * sizeof *id);
    qsort(id, (size_t)n, sizeof *id, compare_id);
    for (int i = 0; i < n; i++)
        if (!count || id[count - 1] != id[i]) id[count++] = id[i];
    double *x = TAKE(life, double, 3 * (size_t)count);
    for (int i = 0; i < count; i++) {
        int at = mesh_node(&o->mesh, id[i]);
        if (at < 0) return fail(report, E_DECK, "%s: error: node %d is not in the mesh, %s", path, id[i], o->mesh.path);
        for (int k = 0; k < 3; k++) x[3 * i + k] = o->mesh.x[3 * (size_t)at + k] * o->units.length;
    }
    o->n = count;
    o->id = id;
    o->x = x;
    return OK;
}

int fe_node(const struct fe *fe, int id)
{
    const int *at = bsearch(&id, fe->id, (size_t)fe->n, sizeof *fe->id, compare_id);
    return at ? (int)(at - fe->id) : -1;
}

/* Rows of the file to freedoms of the body, each at most once. */
static enum status map_rows(int *to, bool *has, const struct fe *o, const struct freedoms *f, const char *path,
                            struct report *report)
{
    struct text place = {.path = path, .report = report};
    for (int i = 0; i < f->n; i++) {
        int node = fe_node(o, f->id[i]);
        place.line = f->line[i];
        if (node < 0) return text_bad(&place, "node %d is not in the body", f->id[i]);
        to[i] = 3 * node + f->axis[i];
        if (has[to[i]]) return text_bad(&place, "freedom %d.%d was given before", f->id[i], f->axis[i] + 1);
        has[to[i]] = true;
    }
    return OK;
}

static enum status all_there(const struct fe *o, const bool *has, const char *path, struct report *report)
{
    for (int i = 0; i < 3 * o->n; i++)
        if (!has[i])
            return fail(report, E_DECK,
                        "%s: error: node %d has no freedom %d: store the matrices of the free body, without *BOUNDARY, "
                        "*MPC, *EQUATION or *RIGID BODY",
                        path, o->id[i / 3], i % 3 + 1);
    return OK;
}

static double stiffness_scale(const struct fe_units *u)
{
    return u->mass / (u->time * u->time);
}

static enum status read_calculix(struct fe *o, const struct fe_source *from, struct arena *life, struct report *report)
{
    const char *dof = arena_print(life, "%s.dof", from->job);
    struct freedoms f;
    TRY(mesh_read_inp(&o->mesh, from->mesh ? from->mesh : arena_print(life, "%s.inp", from->job), life, report));
    TRY(read_dof(&f, dof, life, report));
    TRY(take_nodes(o, f.id, f.n, dof, life, report));
    bool *has = TAKE(life, bool, 3 * (size_t)o->n);
    int *to = TAKE(life, int, f.n);
    TRY(map_rows(to, has, o, &f, dof, report));
    TRY(all_there(o, has, dof, report));
    struct matrix_rows rows = {.n = f.n, .to = to, .size = 3 * o->n, .scale = stiffness_scale(&o->units)};
    TRY(matrix_read_triples(&o->K, arena_print(life, "%s.sti", from->job), &rows, life, report));
    rows.scale = o->units.mass;
    return matrix_read_triples(&o->M, arena_print(life, "%s.mas", from->job), &rows, life, report);
}

/* Rows of a Matrix Market file: as the table says. */
static enum status market_rows(int *to, const struct fe *o, struct report *report)
{
    int n = 3 * o->n;
    for (int i = 0; i < n; i++) to[i] = -1;
    for (int i = 0; i < n; i++) {
        int row = o->mesh.rows[i];
        if (row >= n || to[row] >= 0)
            return fail(report, E_DECK, "%s: error: node %d: row %d %s", o->mesh.path, o->id[i / 3], row + 1,
                        row >= n ? "is beyond the freedoms of all nodes" : "belongs to two freedoms");
        to[row] = i;
    }
    return OK;
}

static enum status read_market(struct fe *o, const struct fe_source *from, struct arena *life, struct report *report)
{
    TRY(mesh_read_csv(&o->mesh, from->table, life, report));
    TRY(take_nodes(o, o->mesh.id, o->mesh.n, from->table, life, report));
    int *to = TAKE(life, int, 3 * (size_t)o->n);
    TRY(market_rows(to, o, report));
    struct matrix_rows rows = {.n = 3 * o->n, .to = to, .size = 3 * o->n, .scale = stiffness_scale(&o->units)};
    TRY(matrix_read_market(&o->K, from->K, &rows, life, report));
    rows.scale = o->units.mass;
    return matrix_read_market(&o->M, from->M, &rows, life, report);
}

enum status fe_read(struct fe *o, const struct fe_source *from, struct arena *life, struct report *report)
{
    *o = (struct fe){.units = from->units};
    TRY(from->job ? read_calculix(o, from, life, report) : read_market(o, from, life, report));
    const char *K = from->job ? arena_print(life, "%s.sti", from->job) : from->K;
    const char *M = from->job ? arena_print(life, "%s.mas", from->job) : from->M;
    o->read = o->mesh.read;
    files_add_path(&o->read, K);
    files_add_path(&o->read, M);
    if (from->job) files_add_path(&o->read, arena_print(life, "%s.dof", from->job));
    TRY(fe_check_mass(o, M, life, report));
    return fe_check_stiffness(o, K, life, report);
}

/* FILE.dof of FILE.sti. */
static const char *dof_beside(const char *path, struct arena *life)
{
    return arena_print(life, "%.*s.dof", (int)strlen(path) - 4, path);
}

static bool ends_in(const char *path, const char *end)
{
    size_t len = strlen(path), n = strlen(end);
    return len > n && strcmp(path + len - n, end) == 0;
}

void fe_stiffness_files(struct files *files, const char *path)
{
    files_add_path(files, path);
    if (ends_in(path, ".sti")) files_add_path(files, dof_beside(path, files->arena));
}

enum status fe_read_stiffness(struct sparse *K, bool *has, const struct fe *fe, const char *path, struct arena *life,
                              struct report *report)
{
    struct matrix_rows rows = {.n = 3 * fe->n, .size = 3 * fe->n, .scale = stiffness_scale(&fe->units)};
    memset(has, 0, 3 * (size_t)fe->n * sizeof *has);
    if (ends_in(path, ".mtx")) {
        if (!fe->mesh.rows) return fail(report, E_USAGE, "%s: Matrix Market rows need a CSV table of nodes", path);
        int *to = TAKE(life, int, rows.n);
        TRY(market_rows(to, fe, report));
        memset(has, 1, 3 * (size_t)fe->n * sizeof *has);
        rows.to = to;
        return matrix_read_market(K, path, &rows, life, report);
    }
    if (!ends_in(path, ".sti")) return fail(report, E_USAGE, "%s: a stiffness is a .sti or .mtx file", path);
    const char *dof = dof_beside(path, life);
    struct freedoms f;
    TRY(read_dof(&f, dof, life, report));
    int *to = TAKE(life, int, f.n);
    TRY(map_rows(to, has, fe, &f, dof, report));
    rows.n = f.n;
    rows.to = to;
    return matrix_read_triples(K, path, &rows, life, report);
}

void fe_mass_scalar(double *y, const struct fe *fe, const double *x)
{
    const struct sparse *M = &fe->M;
    for (int i = 0; i < fe->n; i++) {
        double sum = 0;
        for (size_t k = M->row[3 * i]; k < M->row[3 * i + 1]; k++)
            if (M->col[k] % 3 == 0) sum += M->v[k] * x[M->col[k] / 3];
        y[i] = sum;
    }
}

const char *fe_freedom(const struct fe *fe, int freedom, struct arena *life)
{
    return arena_print(life, "node %d, %c", fe->id[freedom / 3], "xyz"[freedom % 3]);
}
