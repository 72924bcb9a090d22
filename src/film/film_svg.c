/* film_svg.c -- a film as one still picture: some postures over each other, the last one whole, those before paler.
 *
 * Mechanisms in the plane are seen from in front, those in space from above and one side.  Triangles that face away are
 * left out and the rest drawn from the back to the front; what is left of hiding is small where bodies are slender.  What is
 * narrower than a few pixels is drawn by its outline, so that mechanisms of hundreds of bodies make small files. */
#include <math.h>
#include <stdlib.h>

#include "film/film.h"
#include "la/rot.h"
#include "la/vec3.h"

enum { WIDE = 800, TALL = 500, EDGE = 30, POSTURES = 5, COILS = 14 };

/* One thing to draw: an area of n corners, or a piece of a line. */
struct stroke {
    int first, n; /* among the corners; n = 2: a line */
    double depth;
    unsigned color;
    double wide; /* of a line [px] */
};

struct still {
    const struct film *film;
    FILE *to;
    double view[9]; /* by row: to the right, up, to the eye */
    double low[2], scale;
    double narrow; /* what is narrower shows its outline alone [px] */
    struct stroke *stroke;
    int n, capacity;
    double *corner; /* [2 x ncorner] */
    int ncorner, corners;
    struct arena *life, *scratch;
};

static void project(double *at, double *depth, const struct still *o, const double *x)
{
    at[0] = v3_dot(o->view, x);
    at[1] = v3_dot(o->view + 3, x);
    *depth = v3_dot(o->view + 6, x);
}

/* Of n corners from here on, and what is known of it. */
static void add_stroke(struct still *o, const struct stroke *s)
{
    o->stroke = arena_more(o->life, o->stroke, o->n, &o->capacity, sizeof *o->stroke);
    o->stroke[o->n] = *s;
    o->stroke[o->n++].first = o->ncorner - s->n;
}

static void add_corner(struct still *o, const double *at)
{
    o->corner = arena_more(o->life, o->corner, o->ncorner, &o->corners, 2 * sizeof *o->corner);
    o->corner[2 * o->ncorner] = at[0];
    o->corner[2 * o->ncorner++ + 1] = at[1];
}

static unsigned shaded(unsigned color, double light)
{
    unsigned out = 0;
    for (int k = 16; k >= 0; k -= 8) out |= (unsigned)((color >> k & 255) * light) << k;
    return out;
}

/* Where a vertex of a solid is, in the world. */
static void stand(double *x, const struct actor *a, const double *R, const double *frame, int vertex)
{
    double local[3];
    v3_copy(local, a->mesh.x + 3 * vertex);
    m3_mul(x, R, local);
    v3_add(x, frame);
}

static void add_triangles(struct still *o, const struct actor *a, const double *R, const double *frame, int from,
                          int to)
{
    for (int t = from; t < to; t++) {
        struct stroke s = {.n = 3};
        double x[3][3], at[3][2], depth, u[3], v[3], out[3];
        for (int k = 0; k < 3; k++) {
            stand(x[k], a, R, frame, a->mesh.tri[3 * t + k]);
            project(at[k], &depth, o, x[k]);
            s.depth += depth / 3;
        }
        v3_diff(u, x[1], x[0]);
        v3_diff(v, x[2], x[0]);
        v3_cross(out, u, v);
        const double size = v3_norm(out), facing = v3_dot(out, o->view + 6);
        if (!(facing > 1e-9 * size)) continue;
        s.color = shaded(a->color, .65 + .35 * facing / size);
        for (int k = 0; k < 3; k++) add_corner(o, at[k]);
        add_stroke(o, &s);
    }
}

/* ---- outlines ---- */

static int by_place(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return x[0] != y[0] ? (x[0] > y[0]) - (x[0] < y[0]) : (x[1] > y[1]) - (x[1] < y[1]);
}

static double area(const double *a, const double *b, const double *c)
{
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

/* The convex hull of x [2 x n], which is sorted: hull [2 x 2 n], counterclockwise (Andrew 1979). Returns its corners; what
 * lies on an edge but for round-off is none. */
static int outline(double *hull, double *x, int n)
{
    int m = 0;
    qsort(x, (size_t)n, 2 * sizeof *x, by_place);
    const double across = x[2 * n - 2] - x[0], flat = 1e-12 * across * across;
    for (int way = 0; way < 2; way++) {
        const int from = m;
        for (int i = 0; i < n; i++) {
            const double *at = x + 2 * (way ? n - 1 - i : i);
            while (m >= from + 2 && area(hull + 2 * (m - 2), hull + 2 * (m - 1), at) <= flat) m--;
            hull[2 * m] = at[0];
            hull[2 * m++ + 1] = at[1];
        }
        m--; /* the first one of the other way */
    }
    return m;
}

/* How wide an outline is, in the mean across its largest extent. */
static double width(const double *hull, int n)
{
    double sum = 0, longest = 0;
    for (int i = 1; i < n; i++) {
        longest = fmax(longest, hypot(hull[2 * i] - hull[0], hull[2 * i + 1] - hull[1]));
        if (i + 1 < n) sum += area(hull, hull + 2 * i, hull + 2 * i + 2);
    }
    return longest > 0 ? sum / longest : 0;
}

static void add_solid(struct still *o, const struct actor *a, const double *frame)
{
    static const double light = .88; /* of a ball, in the mean */
    const struct mesh *m = &a->mesh;
    double R[9];
    quat_matrix(R, frame + 3);
    for (int i = 0; i < m->nsolid; i++) {
        const bool last = i + 1 == m->nsolid;
        const int from = m->solid[2 * i], to = last ? m->nv : m->solid[2 * i + 2], n = to - from;
        const struct arena_mark mark = arena_mark(o->scratch);
        double *at = TAKE(o->scratch, double, 2 * n), *hull = TAKE(o->scratch, double, 4 * n), depth, x[3];
        struct stroke s = {.color = shaded(a->color, light)};
        for (int k = 0; k < n; k++) {
            stand(x, a, R, frame, from + k);
            project(at + 2 * k, &depth, o, x);
            s.depth += depth / n;
        }
        s.n = outline(hull, at, n);
        if (s.n > 2 && width(hull, s.n) * o->scale <= o->narrow) {
            for (int k = 0; k < s.n; k++) add_corner(o, hull + 2 * k);
            add_stroke(o, &s);
        } else {
            add_triangles(o, a, R, frame, m->solid[2 * i + 1], last ? m->nt : m->solid[2 * i + 3]);
        }
        arena_rewind(o->scratch, mark);
    }
}

static void add_piece(struct still *o, const double *a, const double *b, unsigned color, double wide)
{
    struct stroke s = {.n = 2, .color = color, .wide = wide};
    double da, db, at[2];
    project(at, &da, o, a);
    add_corner(o, at);
    project(at, &db, o, b);
    add_corner(o, at);
    s.depth = (da + db) / 2;
    add_stroke(o, &s);
}

static void add_line(struct still *o, const struct actor *a, const double *frame)
{
    double x[3], y[3], u[3];
    for (int p = 0; p < a->npart; p++)
        for (int k = a->part[p]; k + 1 < a->part[p + 1]; k++) {
            film_vertex(x, u, a, frame, k);
            film_vertex(y, u, a, frame, k + 1);
            add_piece(o, x, y, a->color, 4);
        }
}

/* A zigzag across the line of sight, or a rod. */
static void add_spring(struct still *o, const struct actor *a, const double *ends)
{
    double along[3], side[3], x[3], y[3];
    const int n = a->coils ? COILS : 1;
    v3_diff(along, ends + 3, ends);
    v3_cross(side, o->view + 6, along);
    const double size = v3_norm(side);
    v3_scale(side, size > 0 ? .02 * o->film->mark / size : 0, side);
    v3_copy(x, ends);
    for (int k = 1; k <= n; k++, v3_copy(x, y)) {
        v3_copy(y, ends);
        v3_axpy(y, (double)k / n, along);
        if (k < n) v3_axpy(y, k % 2 ? 1 : -1, side);
        add_piece(o, x, y, a->color, 1.5);
    }
}

static void add_posture(struct still *o, int frame)
{
    o->n = o->ncorner = 0;
    for (int i = 0; i < o->film->nactor; i++) {
        const struct actor *a = &o->film->actor[i];
        const double *at = a->frame + (size_t)frame * (size_t)a->stride;
        if (a->type == ACTOR_SOLID)
            add_solid(o, a, at);
        else if (a->type == ACTOR_LINE)
            add_line(o, a, at);
        else
            add_spring(o, a, at);
    }
}

static int by_depth(const void *a, const void *b)
{
    const struct stroke *x = a, *y = b;
    return (x->depth > y->depth) - (x->depth < y->depth);
}

/* Corners in tenths of pixels; those that fall on each other are one. */
static void put_corners(const struct still *o, const struct stroke *s)
{
    long before[2] = {0, 0};
    int put = 0;
    for (int k = 0; k < s->n; k++) {
        const double *at = o->corner + 2 * (s->first + k);
        const long here[2] = {lround(10 * (EDGE + (at[0] - o->low[0]) * o->scale)),
                              lround(10 * (TALL - EDGE - (at[1] - o->low[1]) * o->scale))};
        if (put && here[0] == before[0] && here[1] == before[1]) continue;
        fprintf(o->to, "%s%g %g", put++ ? "L" : "M", (double)here[0] / 10, (double)here[1] / 10);
        before[0] = here[0];
        before[1] = here[1];
    }
    if (s->n > 2) fputs("Z", o->to);
}

/* One path for what follows on each other in one colour. */
static void put_strokes(const struct still *o)
{
    for (int i = 0, end; i < o->n; i = end) {
        const struct stroke *s = &o->stroke[i];
        fprintf(o->to, "<path d=\"");
        for (end = i; end < o->n; end++) {
            const struct stroke *e = &o->stroke[end];
            if (e->color != s->color || e->wide != s->wide || (e->n > 2) != (s->n > 2)) break;
            put_corners(o, e);
        }
        if (s->n > 2)
            fprintf(o->to, "\" fill=\"#%06x\" stroke=\"#%06x\" stroke-width=\".5\"/>\n", s->color, s->color);
        else
            fprintf(o->to, "\" stroke=\"#%06x\" stroke-width=\"%g\"/>\n", s->color, s->wide);
    }
}

/* What is seen of all postures: where, and how large. */
static void frame_it(struct still *o, const int *frame, int n)
{
    double high[2] = {-INFINITY, -INFINITY};
    o->low[0] = o->low[1] = INFINITY;
    for (int p = 0; p < n; p++) {
        add_posture(o, frame[p]);
        for (int i = 0; i < o->n; i++)
            for (int k = 0; k < o->stroke[i].n; k++)
                for (int c = 0; c < 2; c++) {
                    const double x = o->corner[2 * (o->stroke[i].first + k) + c];
                    o->low[c] = fmin(o->low[c], x);
                    high[c] = fmax(high[c], x);
                }
    }
    const double wide = high[0] - o->low[0], tall = high[1] - o->low[1];
    const double least = .3 * o->film->size; /* a body by itself does not fill the picture */
    o->scale = fmin((WIDE - 2 * EDGE) / fmax(wide, least), (TALL - 2 * EDGE) / fmax(tall, least * TALL / WIDE));
    if (!isfinite(o->scale)) o->scale = 1;
    o->low[0] -= ((WIDE - 2 * EDGE) / o->scale - wide) / 2;
    o->low[1] -= ((TALL - 2 * EDGE) / o->scale - tall) / 2;
}

static void look(struct still *o)
{
    static const double flat[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double round = .6, up = .45; /* [rad] */
    const double space[9] = {cos(round), sin(round), 0, 0, 0, 0, sin(round) * cos(up), -cos(round) * cos(up), sin(up)};
    for (int i = 0; i < 9; i++) o->view[i] = o->film->space == 3 ? space[i] : flat[i];
    if (o->film->space == 3) v3_cross(o->view + 3, o->view + 6, o->view);
}

static void put_title(FILE *to, const char *text)
{
    for (; *text; text++) {
        const char c = *text;
        fputs(c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : (char[]){c, 0}, to);
    }
}

static void put_picture(struct still *o)
{
    static const double narrow = 7, narrow_if_pale = 60;
    int frame[POSTURES];
    for (int p = 0; p < POSTURES; p++) frame[p] = (o->film->frames - 1) * p / (POSTURES - 1);
    look(o);
    frame_it(o, frame, POSTURES);
    fprintf(o->to, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\">\n<title>", WIDE, TALL);
    put_title(o->to, o->film->title);
    fprintf(o->to, "</title>\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n", WIDE, TALL);
    for (int p = 0; p < POSTURES; p++) {
        o->narrow = p + 1 < POSTURES ? narrow_if_pale : narrow;
        add_posture(o, frame[p]);
        qsort(o->stroke, (size_t)o->n, sizeof *o->stroke, by_depth);
        fprintf(o->to, "<g opacity=\"%g\" fill=\"none\" stroke-linecap=\"round\">\n",
                p + 1 < POSTURES ? .12 + .08 * p : 1);
        put_strokes(o);
        fputs("</g>\n", o->to);
    }
    fputs("</svg>\n", o->to);
}

enum status film_svg(const struct film *film, struct stream *stream, struct report *report)
{
    char *text = NULL;
    size_t n = 0;
    struct still o = {.film = film, .to = words_open(&text, &n), .life = arena_open(), .scratch = arena_open()};
    put_picture(&o);
    words_close(o.to, &text);
    const enum status status = stream_bytes(stream, text, n, report);
    free(text);
    arena_close(o.scratch);
    arena_close(o.life);
    return status;
}
