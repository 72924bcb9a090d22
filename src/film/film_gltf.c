/* film_gltf.c -- a film as binary glTF 2.0: a node a thing, one animation
 *
 * Bodies are meshes that are moved and turned; flexible ones lines whose morph targets are their modes, with the
 * coordinates as weights; springs lines that are stretched.  Where the deck asks for stresses the vertices have the colour
 * of the largest one of the run, and further targets, one for each place, take them to that of the instant: viewers that
 * know no targets of colours show the largest ones.  glTF has y upwards: a mechanism in space is turned so. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "film/film.h"
#include "la/vec3.h"

enum { FLOAT = 5126, UNSIGNED = 5125, LINES = 1, TRIANGLES = 4, COILS = 14 };

/* The parts of the file while they grow; a bufferView an accessor. */
struct gltf {
    const struct film *film;
    FILE *bin, *views, *accessors, *meshes, *nodes, *materials, *samplers, *channels;
    uint32_t bytes; /* of bin */
    int naccessor, nsampler;
    int frames, *frame; /* [frames] that follow on each other: times of glTF grow */
    int times;          /* accessor */
};

static void put_bytes(struct gltf *o, const void *bytes, size_t n)
{
    fwrite(bytes, 1, n, o->bin);
}

/* The accessor of what has been put since the last one. */
static int accessor(struct gltf *o, int type, const char *shape, int count, uint32_t bytes, const char *range)
{
    fprintf(o->views, "%s{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u}", o->naccessor ? "," : "", o->bytes, bytes);
    fprintf(o->accessors, "%s{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"%s\"%s}",
            o->naccessor ? "," : "", o->naccessor, type, count, shape, range);
    o->bytes += bytes;
    return o->naccessor++;
}

/* x [n x size], in floats; with the ranges that places and times must have. */
static int put_floats(struct gltf *o, const double *x, int n, int size, bool ranged)
{
    static const char *const shapes[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    float low[4] = {INFINITY, INFINITY, INFINITY, INFINITY}, high[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    char range[400] = "", *to = range;
    for (int i = 0; i < n * size; i++) {
        const float f = (float)x[i];
        low[i % size] = fminf(low[i % size], f);
        high[i % size] = fmaxf(high[i % size], f);
        put_bytes(o, &f, sizeof f);
    }
    for (int end = 0; end < 2 && ranged; end++) {
        to += sprintf(to, ",\"%s\":[", end ? "max" : "min");
        for (int k = 0; k < size; k++) to += sprintf(to, "%s%.9g", k ? "," : "", (double)(end ? high[k] : low[k]));
        to += sprintf(to, "]");
    }
    return accessor(o, FLOAT, shapes[size], n, (uint32_t)(n * size) * 4, range);
}

static int put_indices(struct gltf *o, const int *index, int n)
{
    for (int i = 0; i < n; i++) {
        const uint32_t k = (uint32_t)index[i];
        put_bytes(o, &k, sizeof k);
    }
    return accessor(o, UNSIGNED, "SCALAR", n, (uint32_t)n * 4, "");
}

static void put_text(FILE *to, const char *text)
{
    putc('"', to);
    for (; *text; text++) fprintf(to, (unsigned char)*text < 0x20 || strchr("\"\\", *text) ? "\\u%04x" : "%c", *text);
    putc('"', to);
}

/* ---- a thing ---- */

static double linear(unsigned c)
{
    return pow((c & 255) / 255., 2.2);
}

/* Accessors of what changes the vertices: places of all, n targets of modes; where there are stresses (colors), colours of
 * all, a target of colours for each place, and zeros, the part that a target leaves alone. */
struct morph {
    int place, modes, n;
    int color, colors, ncolor, zeros;
};

static void put_targets(FILE *to, const struct morph *m)
{
    for (int j = 0; j < m->n + m->ncolor; j++) {
        const bool mode = j < m->n;
        fprintf(to, "%s{\"POSITION\":%d", j ? "," : ",\"targets\":[", mode ? m->modes + j : m->zeros);
        if (m->ncolor) fprintf(to, ",\"COLOR_0\":%d", mode ? m->zeros : m->colors + j - m->n);
        putc('}', to);
    }
    fputs(m->n + m->ncolor ? "]}]" : "}]", to);
    for (int j = 0; j < m->n + m->ncolor; j++) fputs(j ? ",0" : ",\"weights\":[0", to);
    fputs(m->n + m->ncolor ? "]}" : "}", to);
}

static void put_mesh(struct gltf *o, int i, const struct actor *a, const struct morph *m, int index, int mode)
{
    fprintf(o->meshes, "%s{\"primitives\":[{\"attributes\":{\"POSITION\":%d", i ? "," : "", m->place);
    if (m->ncolor) fprintf(o->meshes, ",\"COLOR_0\":%d", m->color);
    fprintf(o->meshes, "},\"indices\":%d,\"mode\":%d,\"material\":%d", index, mode, i);
    put_targets(o->meshes, m);
    fprintf(o->nodes, ",{\"mesh\":%d,\"name\":", i);
    put_text(o->nodes, a->name ? a->name : "");
    putc('}', o->nodes);
    fprintf(o->materials,
            "%s{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.8,"
            "\"baseColorFactor\":[%.4f,%.4f,%.4f,1]}}",
            i ? "," : "", a->nstress ? 1. : linear(a->color >> 16), a->nstress ? 1. : linear(a->color >> 8),
            a->nstress ? 1. : linear(a->color));
}

static void put_channel(struct gltf *o, int node, const char *path, int values)
{
    fprintf(o->samplers, "%s{\"input\":%d,\"output\":%d}", o->nsampler ? "," : "", o->times, values);
    fprintf(o->channels, "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"%s\"}}", o->nsampler ? "," : "",
            o->nsampler, node, path);
    o->nsampler++;
}

static const double *frame_of(const struct gltf *o, const struct actor *a, int i)
{
    return a->frame + (size_t)o->frame[i] * (size_t)a->stride;
}

/* glTF has w last. */
static void move_frame(struct gltf *o, const struct actor *a, int node, double *x)
{
    for (int i = 0; i < o->frames; i++) v3_copy(x + 3 * i, frame_of(o, a, i));
    put_channel(o, node, "translation", put_floats(o, x, o->frames, 3, false));
    for (int i = 0; i < o->frames; i++) {
        const double *q = frame_of(o, a, i) + 3;
        v3_copy(x + 4 * i, q + 1);
        x[4 * i + 3] = q[0];
    }
    put_channel(o, node, "rotation", put_floats(o, x, o->frames, 4, false));
}

static void put_solid(struct gltf *o, int i, const struct actor *a, double *x)
{
    const struct morph m = {.place = put_floats(o, a->mesh.x, a->mesh.nv, 3, true)};
    put_mesh(o, i, a, &m, put_indices(o, a->mesh.tri, 3 * a->mesh.nt), TRIANGLES);
    move_frame(o, a, i + 1, x);
}

/* peak [nstress]: the largest stress of the run at each place.  Returns the largest of these, or 1. */
static double find_peaks(const struct gltf *o, const struct actor *a, double *peak)
{
    double most = 0;
    for (int j = 0; j < a->nstress; j++) {
        for (int f = 0; f < o->frames; f++) peak[j] = fmax(peak[j], film_stress(a, o->frame[f])[j]);
        most = fmax(most, peak[j]);
    }
    return most > 0 ? most : 1;
}

/* Colours of the vertices, base + share * change of what x [nstress] of the places is as a share of `most`. */
static int put_colors(struct gltf *o, const struct actor *a, const double *x, double most, const double *base,
                      double *color)
{
    static const double change[3] = {.95, -.15, -.8}; /* from blue to red */
    for (int i = 0; i < a->nv; i++) {
        v3_copy(color + 3 * i, base);
        v3_axpy(color + 3 * i, film_along(a, x, i) / most, change);
    }
    return put_floats(o, color, a->nv, 3, false);
}

/* Colours, from blue to red at the largest stress of the body in the run, linear in it, so that a target for each place and
 * the share that is missing there as its weight make those of an instant. */
static void put_stress(struct gltf *o, const struct actor *a, struct morph *m, double *share, struct arena *life)
{
    static const double blue[3] = {.05, .2, .8}, none[3];
    double *peak = TAKE(life, double, a->nstress), *hat = TAKE(life, double, a->nstress);
    double *color = TAKE(life, double, 3 * a->nv);
    const int all = m->n + a->nstress;
    const double most = find_peaks(o, a, peak);
    if (!a->nstress) return;
    m->ncolor = a->nstress;
    m->zeros = put_floats(o, color, a->nv, 3, true);
    m->color = put_colors(o, a, peak, most, blue, color);
    for (int j = 0; j < a->nstress; j++) {
        if (j > 0) hat[j - 1] = 0;
        hat[j] = 1;
        const int target = put_colors(o, a, hat, 1, none, color);
        if (j == 0) m->colors = target;
        for (int f = 0; f < o->frames; f++)
            share[f * all + m->n + j] = (film_stress(a, o->frame[f])[j] - peak[j]) / most;
    }
}

static int put_modes(struct gltf *o, const struct actor *a)
{
    int first = 0;
    for (int j = 0; j < a->n; j++) {
        const int target = put_floats(o, a->mode + 3 * j * a->nv, a->nv, 3, true);
        if (j == 0) first = target;
    }
    return first;
}

static void put_line(struct gltf *o, int i, const struct actor *a, double *x, struct arena *life)
{
    int *index = TAKE(life, int, 2 * a->nv), n = 0;
    const int all = a->n + a->nstress;
    double *weight = TAKE_MATRIX(life, double, o->frames, all);
    struct morph m = {.place = put_floats(o, a->base, a->nv, 3, true), .n = a->n};
    for (int p = 0; p < a->npart; p++)
        for (int k = a->part[p]; k + 1 < a->part[p + 1]; k++) index[n++] = k, index[n++] = k + 1;
    const int indices = put_indices(o, index, n);
    m.modes = put_modes(o, a);
    put_stress(o, a, &m, weight, life);
    put_mesh(o, i, a, &m, indices, LINES);
    move_frame(o, a, i + 1, x);
    for (int f = 0; f < o->frames; f++)
        for (int j = 0; j < a->n; j++) weight[f * all + j] = frame_of(o, a, f)[7 + j];
    if (all) put_channel(o, i + 1, "weights", put_floats(o, weight, o->frames * all, 1, false));
}

/* q [4], w last: turns x into d. */
static void turn_to(double *q, const double *d)
{
    const double l = v3_norm(d);
    double w[4] = {0, -d[2], d[1], l + d[0]};
    if (!(l > 0)) w[3] = 1;
    if (l > 0 && w[3] < 1e-9 * l) w[1] = 1, w[2] = 0, w[3] = 0;
    const double size = sqrt(w[1] * w[1] + w[2] * w[2] + w[3] * w[3]);
    for (int k = 0; k < 4; k++) q[k] = w[k] / size;
}

/* Along x from 0 to 1. */
static void put_spring(struct gltf *o, int i, const struct actor *a, double *x)
{
    const int n = a->coils ? COILS : 1;
    double place[3 * (COILS + 1)] = {0}, d[3];
    int index[2 * COILS];
    for (int k = 0; k <= n; k++) {
        place[3 * k] = (double)k / n;
        if (k > 0 && k < n) place[3 * k + 1] = (k % 2 ? .025 : -.025) * o->film->mark;
    }
    for (int k = 0; k < n; k++) index[2 * k] = k, index[2 * k + 1] = k + 1;
    const int at = put_floats(o, place, n + 1, 3, true);
    put_mesh(o, i, a, &(struct morph){.place = at}, put_indices(o, index, 2 * n), LINES);
    for (int f = 0; f < o->frames; f++) v3_copy(x + 3 * f, frame_of(o, a, f));
    put_channel(o, i + 1, "translation", put_floats(o, x, o->frames, 3, false));
    for (int f = 0; f < o->frames; f++) {
        v3_diff(d, frame_of(o, a, f) + 3, frame_of(o, a, f));
        turn_to(x + 4 * f, d);
    }
    put_channel(o, i + 1, "rotation", put_floats(o, x, o->frames, 4, false));
    for (int f = 0; f < o->frames; f++) {
        v3_diff(d, frame_of(o, a, f) + 3, frame_of(o, a, f));
        v3_set(x + 3 * f, v3_norm(d), 1, 1);
    }
    put_channel(o, i + 1, "scale", put_floats(o, x, o->frames, 3, false));
}

/* ---- the file ---- */

static void put_times(struct gltf *o, double *x, struct arena *life)
{
    const struct film *film = o->film;
    const double from = film->x[0];
    o->frame = TAKE(life, int, film->frames);
    for (int f = 0; f < film->frames; f++) {
        const double t = film->x[(size_t)f * (size_t)film->ncolumn] - from;
        if (o->frames && !((float)t > (float)x[o->frames - 1])) continue;
        x[o->frames] = t;
        o->frame[o->frames++] = f;
    }
    o->times = put_floats(o, x, o->frames, 1, true);
}

static void put_things(struct gltf *o, struct arena *life)
{
    const struct film *film = o->film;
    double *x = TAKE(life, double, 4 * film->frames);
    put_times(o, x, life);
    fprintf(o->nodes, "{\"name\":\"world\",\"rotation\":[%s],\"children\":[",
            film->space == 3 ? "-0.70710678,0,0,0.70710678" : "0,0,0,1");
    for (int i = 0; i < film->nactor; i++) fprintf(o->nodes, i ? ",%d" : "%d", i + 1);
    fputs("]}", o->nodes);
    for (int i = 0; i < film->nactor; i++) {
        const struct actor *a = &film->actor[i];
        if (a->type == ACTOR_SOLID)
            put_solid(o, i, a, x);
        else if (a->type == ACTOR_LINE)
            put_line(o, i, a, x, life);
        else
            put_spring(o, i, a, x);
    }
}

static void put_word(FILE *to, uint32_t x)
{
    const unsigned char bytes[] = {x & 255, x >> 8 & 255, x >> 16 & 255, x >> 24};
    fwrite(bytes, 1, sizeof bytes, to);
}

enum { PARTS = 8 };

/* text [PARTS]: of the streams in the order of the struct. */
static void put_file(FILE *to, const struct gltf *o, char *const *text)
{
    char *json = NULL;
    size_t n = 0;
    FILE *words = words_open(&json, &n);
    fprintf(words,
            "{\"asset\":{\"version\":\"2.0\",\"generator\":\"fmdsub\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
            "\"nodes\":[%s],"
            "\"meshes\":[%s],\"materials\":[%s],\"animations\":[{\"samplers\":[%s],\"channels\":[%s]}],"
            "\"accessors\":[%s],\"bufferViews\":[%s],\"buffers\":[{\"byteLength\":%u}]}",
            text[4], text[3], text[5], text[6], text[7], text[2], text[1], o->bytes);
    fflush(words);
    while (n % 4) putc(' ', words), fflush(words);
    words_close(words, &json);
    fputs("glTF", to);
    put_word(to, 2);
    put_word(to, 12 + 8 + (uint32_t)n + 8 + o->bytes);
    put_word(to, (uint32_t)n);
    fputs("JSON", to);
    fwrite(json, 1, n, to);
    put_word(to, o->bytes);
    fwrite("BIN", 1, 4, to);
    fwrite(text[0], 1, o->bytes, to);
    free(json);
}

enum status film_gltf(const struct film *film, struct stream *stream, struct report *report)
{
    struct gltf o = {.film = film};
    FILE **to[PARTS] = {&o.bin, &o.views, &o.accessors, &o.meshes, &o.nodes, &o.materials, &o.samplers, &o.channels};
    char *text[PARTS] = {0}, *all = NULL;
    size_t n[PARTS], size = 0;
    struct arena *life = arena_open();
    for (int i = 0; i < PARTS; i++) *to[i] = words_open(&text[i], &n[i]);
    put_things(&o, life);
    for (int i = 0; i < PARTS; i++) words_close(*to[i], &text[i]);
    FILE *file = words_open(&all, &size);
    put_file(file, &o, text);
    words_close(file, &all);
    const enum status status = stream_bytes(stream, all, size, report);
    for (int i = 0; i < PARTS; i++) free(text[i]);
    free(all);
    arena_close(life);
    return status;
}
