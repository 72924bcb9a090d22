/* film_vtu.c -- a film for ParaView: FILE.pvd, which names a FILE.NNNN.vtu for each record, beside it.
 *
 * Cells are triangles of rigid bodies and lines of flexible ones, springs and rods.  Points carry the displacement of
 * flexible bodies against their frame, world axes, and the equivalent stress by the places of the deck's `stress`; cells the
 * number of the thing they are of, in the order of the film. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "film/film.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "out/number.h"

struct grid {
    FILE *points, *bent, *stress, *ends, *offsets, *types, *things;
    int npoint, ncell, nend;
};
enum { LISTS = 7, LINE = 3, TRIANGLE = 5 };

static void put_real(FILE *to, double x)
{
    char number[NUMBER_MOST + 1];
    number[number_round(number, isfinite(x) ? (x == 0 ? 0 : x) : 0, 7)] = 0;
    fputs(number, to);
    putc(' ', to);
}

static void put_point(struct grid *o, const double *x, const double *u, double stress)
{
    for (int k = 0; k < 3; k++) put_real(o->points, x[k]);
    for (int k = 0; k < 3; k++) put_real(o->bent, u ? u[k] : 0);
    put_real(o->stress, stress);
    o->npoint++;
}

static void put_cell(struct grid *o, const int *point, int n, int thing)
{
    for (int i = 0; i < n; i++) fprintf(o->ends, "%d ", point[i]);
    o->nend += n;
    fprintf(o->offsets, "%d ", o->nend);
    fprintf(o->types, "%d ", n == 3 ? TRIANGLE : LINE);
    fprintf(o->things, "%d ", thing);
    o->ncell++;
}

static void put_solid(struct grid *o, const struct actor *a, const double *frame, int thing)
{
    const int first = o->npoint;
    double R[9], x[3];
    quat_matrix(R, frame + 3);
    for (int i = 0; i < a->mesh.nv; i++) {
        m3_mul(x, R, a->mesh.x + 3 * i);
        v3_add(x, frame);
        put_point(o, x, NULL, 0);
    }
    for (int t = 0; t < a->mesh.nt; t++) {
        int corner[3];
        for (int k = 0; k < 3; k++) corner[k] = first + a->mesh.tri[3 * t + k];
        put_cell(o, corner, 3, thing);
    }
}

static void put_bent(struct grid *o, const struct actor *a, const double *frame, int at, int thing)
{
    const int first = o->npoint;
    double x[3], u[3];
    for (int i = 0; i < a->nv; i++) {
        film_vertex(x, u, a, frame, i);
        put_point(o, x, u, film_along(a, film_stress(a, at), i));
    }
    for (int p = 0; p < a->npart; p++)
        for (int k = a->part[p]; k + 1 < a->part[p + 1]; k++) put_cell(o, (int[]){first + k, first + k + 1}, 2, thing);
}

static void put_between(struct grid *o, const double *ends, int thing)
{
    put_point(o, ends, NULL, 0);
    put_point(o, ends + 3, NULL, 0);
    put_cell(o, (int[]){o->npoint - 2, o->npoint - 1}, 2, thing);
}

static void put_things(struct grid *o, const struct film *film, int at)
{
    for (int i = 0; i < film->nactor; i++) {
        const struct actor *a = &film->actor[i];
        const double *frame = a->frame + (size_t)at * (size_t)a->stride;
        if (a->type == ACTOR_SOLID)
            put_solid(o, a, frame, i);
        else if (a->type == ACTOR_LINE)
            put_bent(o, a, frame, at, i);
        else
            put_between(o, frame, i);
    }
}

static void put_array(FILE *to, const char *type, const char *name, int components, const char *text)
{
    fprintf(to, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n%s\n</DataArray>\n",
            type, name, components, text);
}

/* text: of the lists in the order of the struct. */
static void put_grid(FILE *to, const struct grid *o, char *const *text)
{
    fprintf(to,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            "<UnstructuredGrid><Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n<PointData Vectors=\"displacement\" "
            "Scalars=\"stress\">\n",
            o->npoint, o->ncell);
    put_array(to, "Float64", "displacement", 3, text[1]);
    put_array(to, "Float64", "stress", 1, text[2]);
    fputs("</PointData>\n<CellData>\n", to);
    put_array(to, "Int32", "thing", 1, text[6]);
    fputs("</CellData>\n<Points>\n", to);
    put_array(to, "Float64", "points", 3, text[0]);
    fputs("</Points>\n<Cells>\n", to);
    put_array(to, "Int32", "connectivity", 1, text[3]);
    put_array(to, "Int32", "offsets", 1, text[4]);
    put_array(to, "UInt8", "types", 1, text[5]);
    fputs("</Cells>\n</Piece></UnstructuredGrid></VTKFile>\n", to);
}

/* One record as text that is the caller's to free. */
static char *grid_text(size_t *size, const struct film *film, int at)
{
    struct grid o = {0};
    FILE **to[LISTS] = {&o.points, &o.bent, &o.stress, &o.ends, &o.offsets, &o.types, &o.things};
    char *text[LISTS] = {0}, *all = NULL;
    size_t n[LISTS];
    for (int i = 0; i < LISTS; i++) *to[i] = words_open(&text[i], &n[i]);
    put_things(&o, film, at);
    for (int i = 0; i < LISTS; i++) words_close(*to[i], &text[i]);
    FILE *file = words_open(&all, size);
    put_grid(file, &o, text);
    words_close(file, &all);
    for (int i = 0; i < LISTS; i++) free(text[i]);
    return all;
}

static enum status put_record(const struct film *film, const char *path, int at, struct arena *life,
                              struct report *report)
{
    struct stream stream;
    size_t size = 0;
    char *text = grid_text(&size, film, at);
    enum status status = stream_create(&stream, path, life, report);
    if (status == OK) status = stream_finish(&stream, stream_bytes(&stream, text, size, report), report);
    free(text);
    return status;
}

/* The name behind the last slash. */
static const char *bare(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static void put_entry(FILE *to, const char *path, double t)
{
    fputs("<DataSet timestep=\"", to);
    put_real(to, t);
    fputs("\" part=\"0\" file=\"", to);
    for (; *path; path++) fprintf(to, strchr("<>&\"", *path) ? "&#%d;" : "%c", *path);
    fputs("\"/>\n", to);
}

enum status film_vtu(const struct film *film, struct stream *stream, struct report *report)
{
    const char *target = stream->target;
    const int stem = (int)strlen(target) - (int)strlen(".pvd");
    char *text = NULL;
    size_t size = 0;
    FILE *list = words_open(&text, &size);
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n", list);
    struct arena *life = arena_open();
    enum status status = OK;
    for (int i = 0; i < film->frames && status == OK; i++) {
        const char *path = arena_print(life, "%.*s.%04d.vtu", stem, target, i);
        put_entry(list, bare(path), film->x[(size_t)i * (size_t)film->ncolumn]);
        status = put_record(film, path, i, life, report);
    }
    fputs("</Collection></VTKFile>\n", list);
    words_close(list, &text);
    if (status == OK) status = stream_bytes(stream, text, size, report);
    free(text);
    arena_close(life);
    return status;
}
