/* film_surface.c -- the surfaces that touch: planes, balls or discs, bores, and curves as strings of bars. */
#include <math.h>

#include "film/film.h"
#include "kind/outline.h"
#include "la/vec3.h"
#include "scene/build.h"

enum { ROUND = 48, MOST_BARS = 400 };
static const unsigned STONE = 0xa8a49c;
static const double TURN = 2 * 3.14159265358979323846;

/* The i-th of n points along it, from its place. */
static void along(double *x, const struct scene_surface *s, int i, int n)
{
    double c[2] = {s->radius * cos(TURN * i / n), s->radius * sin(TURN * i / n)};
    const double ey[2] = {-s->normal[1], s->normal[0]}, *ex = s->normal;
    if (s->outline) {
        const struct outline *line = s->outline;
        const double lo = line->x[0], hi = line->closed ? lo + TURN : line->x[line->n - 1];
        outline_point(line, c, lo + (hi - lo) * i / n);
        v3_set(x, c[0] * ex[0] + c[1] * ey[0], c[0] * ex[1] + c[1] * ey[1], 0);
    } else {
        v3_set(x, c[0], c[1], 0);
    }
    v3_add(x, s->at.p);
}

static void add_curve(struct film *o, struct actor *a, const struct scene_surface *s)
{
    const int wanted = s->outline ? 4 * s->outline->n : ROUND, n = wanted < MOST_BARS ? wanted : MOST_BARS;
    double from[3], to[3];
    along(from, s, 0, n);
    for (int i = 1; i <= n; i++) {
        along(to, s, i, n);
        mesh_cylinder(&a->mesh, from, to, .006 * o->mark);
        v3_copy(from, to);
    }
}

/* A disc is its rim and a spoke, so that it is seen to turn. */
static void add_ball(struct film *o, struct actor *a, const struct scene_surface *s)
{
    double rim[3] = {s->radius, 0, 0};
    if (o->space == 3) {
        mesh_ball(&a->mesh, s->at.p, s->radius);
        return;
    }
    add_curve(o, a, s);
    v3_add(rim, s->at.p);
    mesh_cylinder(&a->mesh, s->at.p, rim, .004 * o->mark);
}

/* A thin plate under all that has been seen, or about its place on a body that moves. */
static void add_plane(struct film *o, struct actor *a, const struct scene_surface *s)
{
    const double thin = .004 * o->mark, way[3] = {s->normal[1], -s->normal[0], 0};
    double E[9], centre[3], seen[3], half[3];
    v3_diff(half, o->high, o->low);
    const double wide = .6 * v3_norm(half) + .1 * o->size;
    frame_about(E, s->normal, o->space == 2 ? way : NULL);
    v3_copy(centre, s->at.p);
    if (s->at.body == 0) {
        v3_sum(seen, o->low, o->high);
        v3_scale(seen, .5, seen);
        v3_diff(centre, s->at.p, seen);
        v3_scale(centre, v3_dot(centre, s->normal), s->normal);
        v3_add(centre, seen);
    }
    v3_axpy(centre, -thin, s->normal);
    v3_set(half, wide, o->space == 2 ? 3 * thin : wide, thin);
    mesh_box(&a->mesh, centre, E, half);
}

/* Who has a shape of his own is drawn by that. */
static bool is_drawn(const struct scene *scene, const struct scene_surface *s)
{
    const struct node *body = scene->body[s->at.body].node;
    return s->shape == SHAPE_SPHERE && body && node_find(body, "shape");
}

/* Planes and profiles have no end. */
void film_widen_surfaces(struct film *o, const struct scene *scene)
{
    for (int i = 0; i < scene->nsurface; i++) {
        const struct scene_surface *s = &scene->surface[i];
        double r = s->radius, at[3], x[3];
        if (s->shape == SHAPE_PLANE || s->shape == SHAPE_PROFILE) continue;
        for (int k = 0; s->outline && k < s->outline->n; k++) r = fmax(r, s->outline->y[k]);
        marker_drawn(at, scene, &s->at);
        for (int k = 0; k < 2 * scene->space; k++) {
            v3_copy(x, at);
            x[k / 2] += k % 2 ? r : -r;
            film_widen(o, x);
        }
    }
}

void film_surfaces(struct film *o, const struct sim *sim)
{
    o->surfaces = o->nactor;
    for (int i = 0; i < sim->scene->nsurface; i++) {
        const struct scene_surface *s = &sim->scene->surface[i];
        struct actor *a;
        if (is_drawn(sim->scene, s)) continue;
        a = film_actor(o, ACTOR_SOLID, s->name, STONE);
        a->body = sim->model->body_of[s->at.body];
        if (s->shape == SHAPE_SPHERE)
            add_ball(o, a, s);
        else if (s->shape != SHAPE_PLANE)
            add_curve(o, a, s);
    }
}

void film_close(struct film *o, const struct sim *sim)
{
    struct actor *a = o->actor + o->surfaces;
    for (int i = 0; i < sim->scene->nsurface; i++) {
        const struct scene_surface *s = &sim->scene->surface[i];
        if (is_drawn(sim->scene, s)) continue;
        if (s->shape == SHAPE_PLANE) add_plane(o, a, s);
        a++;
    }
}
