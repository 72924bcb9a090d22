/* film_svg.c -- a film as one still picture: some postures over each other, the last one whole, those before paler.
 *
 * Mechanisms in the plane are seen from in front, those in space from above and one side.  Triangles that face away are
 * left out and the rest drawn from the back to the front; what is left of hiding is small where bodies are slender. */
#include <math.h>
#include <stdlib.h>

#include "film/film.h"
#include "la/rot.h"
#include "la/vec3.h"

enum { WIDE = 800, TALL = 500, EDGE = 30, POSTURES = 5, COILS = 14 };

/* One thing to draw: a triangle, or a piece of a line. */
struct stroke {
    double x[3][2], depth;
    int n; /* 3 or 2 */
    unsigned color;
    double wide; /* of a line [px] */
};

struct still {
    const struct film *film;
    FILE *to;
    double view[9]; /* by row: to the right, up, to the eye */
    double low[2], scale;
    struct stroke *stroke;
    int n, capacity;
    struct arena *life;
};

static void project(double *at, double *depth, const struct still *o, const double *x)
{
    at[0] = v3_dot(o->view, x);
    at[1] = v3_dot(o->view + 3, x);
    *depth = v3_dot(o->view + 6, x);
}

static struct stroke *next_stroke(struct still *o)
{
    o->stroke = arena_more(o->life, o->stroke, o->n, &o->capacity, sizeof *o->stroke);
    return &o->stroke[o->n++];
}

static unsigned shaded(unsigned color, double light)
{
    unsigned out = 0;
    for (int k = 16; k >= 0; k -= 8) out |= (unsigned)((color >> k & 255) * light) << k;
    return out;
}

static void add_solid(struct still *o, const struct actor *a, const double *frame)
{
    double R[9], local[3], depth;
    quat_matrix(R, frame + 3);
    for (int t = 0; t < a->mesh.nt; t++) {
        struct stroke s = {.n = 3};
        double x[3][3], u[3], v[3], out[3];
        for (int k = 0; k < 3; k++) {
            v3_copy(local, a->mesh.x + 3 * a->mesh.tri[3 * t + k]);
            m3_mul(x[k], R, local);
            v3_add(x[k], frame);
            project(s.x[k], &depth, o, x[k]);
            s.depth += depth / 3;
        }
        v3_diff(u, x[1], x[0]);
        v3_diff(v, x[2], x[0]);
        v3_cross(out, u, v);
        const double size = v3_norm(out), facing = v3_dot(out, o->view + 6);
        if (!(facing > 1e-9 * size)) continue;
        s.color = shaded(a->color, .65 + .35 * facing / size);
        *next_stroke(o) = s;
    }
}

static void add_piece(struct still *o, const double *a, const double *b, unsigned color, double wide)
{
    struct stroke s = {.n = 2, .color = color, .wide = wide};
    double da, db;
    project(s.x[0], &da, o, a);
    project(s.x[1], &db, o, b);
    s.depth = (da + db) / 2;
    *next_stroke(o) = s;
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
    v3_scale(side, size > 0 ? .02 * o->film->size / size : 0, side);
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
    o->n = 0;
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

static void put_stroke(const struct still *o, const struct stroke *s)
{
    const bool area = s->n == 3;
    fprintf(o->to, "<path d=\"");
    for (int k = 0; k < s->n; k++)
        fprintf(o->to, "%s%.1f %.1f", k ? "L" : "M", EDGE + (s->x[k][0] - o->low[0]) * o->scale,
                TALL - EDGE - (s->x[k][1] - o->low[1]) * o->scale);
    if (area)
        fprintf(o->to, "Z\" fill=\"#%06x\" stroke=\"#%06x\" stroke-width=\".5\"/>\n", s->color, s->color);
    else
        fprintf(o->to, "\" stroke=\"#%06x\" stroke-width=\"%g\"/>\n", s->color, s->wide);
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
                    o->low[c] = fmin(o->low[c], o->stroke[i].x[k][c]);
                    high[c] = fmax(high[c], o->stroke[i].x[k][c]);
                }
    }
    const double wide = high[0] - o->low[0], tall = high[1] - o->low[1];
    o->scale = fmin((WIDE - 2 * EDGE) / fmax(wide, 1e-300), (TALL - 2 * EDGE) / fmax(tall, 1e-300));
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
    int frame[POSTURES];
    for (int p = 0; p < POSTURES; p++) frame[p] = (o->film->frames - 1) * p / (POSTURES - 1);
    look(o);
    frame_it(o, frame, POSTURES);
    fprintf(o->to, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\">\n<title>", WIDE, TALL);
    put_title(o->to, o->film->title);
    fprintf(o->to, "</title>\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n", WIDE, TALL);
    for (int p = 0; p < POSTURES; p++) {
        add_posture(o, frame[p]);
        qsort(o->stroke, (size_t)o->n, sizeof *o->stroke, by_depth);
        fprintf(o->to, "<g opacity=\"%g\" fill=\"none\" stroke-linecap=\"round\">\n",
                p + 1 < POSTURES ? .12 + .08 * p : 1);
        for (int i = 0; i < o->n; i++) put_stroke(o, &o->stroke[i]);
        fputs("</g>\n", o->to);
    }
    fputs("</svg>\n", o->to);
}

enum status film_svg(const struct film *film, struct stream *stream, struct report *report)
{
    char *text = NULL;
    size_t n = 0;
    struct still o = {.film = film, .to = words_open(&text, &n), .life = arena_open()};
    put_picture(&o);
    words_close(o.to, &text);
    const enum status status = stream_bytes(stream, text, n, report);
    free(text);
    arena_close(o.life);
    return status;
}
