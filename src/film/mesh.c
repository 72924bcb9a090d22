/* mesh.c -- see mesh.h */
#include "film/mesh.h"

#include <math.h>

#include "la/vec3.h"

enum { SIDES = 12, RINGS = 6 };
static const double pi = 3.14159265358979323846;

static int vertex(struct mesh *o, double x, double y, double z)
{
    o->x = arena_more(o->life, o->x, o->nv, &o->vertices, 3 * sizeof *o->x);
    v3_set(o->x + 3 * o->nv, x, y, z);
    return o->nv++;
}

static int vertex_at(struct mesh *o, const double *x)
{
    return vertex(o, x[0], x[1], x[2]);
}

static void triangle(struct mesh *o, int a, int b, int c)
{
    o->tri = arena_more(o->life, o->tri, o->nt, &o->triangles, 3 * sizeof *o->tri);
    o->tri[3 * o->nt] = a;
    o->tri[3 * o->nt + 1] = b;
    o->tri[3 * o->nt + 2] = c;
    o->nt++;
}

static void begin_solid(struct mesh *o)
{
    o->solid = arena_more(o->life, o->solid, o->nsolid, &o->solids, 2 * sizeof *o->solid);
    o->solid[2 * o->nsolid] = o->nv;
    o->solid[2 * o->nsolid++ + 1] = o->nt;
}

void mesh_box(struct mesh *o, const double *centre, const double *R, const double *half)
{
    static const int face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    const int first = o->nv;
    begin_solid(o);
    for (int i = 0; i < 8; i++) {
        double at[3];
        v3_copy(at, centre);
        for (int k = 0; k < 3; k++) v3_axpy(at, i >> k & 1 ? half[k] : -half[k], R + 3 * k);
        vertex_at(o, at);
    }
    for (int i = 0; i < 6; i++) {
        triangle(o, first + face[i][0], first + face[i][1], first + face[i][2]);
        triangle(o, first + face[i][0], first + face[i][2], first + face[i][3]);
    }
}

/* Two directions square to d, and to each other. */
static void across(double *u, double *v, const double *d)
{
    const double least[3] = {fabs(d[0]) <= fabs(d[1]) && fabs(d[0]) <= fabs(d[2]),
                             fabs(d[1]) < fabs(d[0]) && fabs(d[1]) <= fabs(d[2]),
                             fabs(d[2]) < fabs(d[0]) && fabs(d[2]) < fabs(d[1])};
    v3_cross(u, d, least);
    v3_scale(u, 1 / v3_norm(u), u);
    v3_cross(v, d, u);
    v3_scale(v, 1 / v3_norm(v), v);
}

void mesh_cylinder(struct mesh *o, const double *a, const double *b, double radius)
{
    double d[3], u[3], v[3];
    v3_diff(d, b, a);
    if (!(v3_norm(d) > 0)) return;
    across(u, v, d);
    const int first = o->nv;
    begin_solid(o);
    for (int i = 0; i < SIDES; i++)
        for (int end = 0; end < 2; end++) {
            double at[3];
            v3_copy(at, end ? b : a);
            v3_axpy(at, radius * cos(2 * pi * i / SIDES), u);
            v3_axpy(at, radius * sin(2 * pi * i / SIDES), v);
            vertex_at(o, at);
        }
    const int ca = vertex_at(o, a), cb = vertex_at(o, b);
    for (int i = 0; i < SIDES; i++) {
        const int here = first + 2 * i, next = first + 2 * ((i + 1) % SIDES);
        triangle(o, here, next, here + 1);
        triangle(o, next, next + 1, here + 1);
        triangle(o, ca, next, here);
        triangle(o, cb, here + 1, next + 1);
    }
}

void mesh_ball(struct mesh *o, const double *centre, double radius)
{
    const int first = o->nv;
    begin_solid(o);
    for (int ring = 0; ring <= RINGS; ring++)
        for (int i = 0; i < SIDES; i++) {
            const double up = pi * ring / RINGS, round = 2 * pi * i / SIDES;
            vertex(o, centre[0] + radius * sin(up) * cos(round), centre[1] + radius * sin(up) * sin(round),
                   centre[2] + radius * cos(up));
        }
    for (int ring = 0; ring < RINGS; ring++)
        for (int i = 0; i < SIDES; i++) {
            const int a = first + SIDES * ring + i, b = first + SIDES * ring + (i + 1) % SIDES;
            if (ring) triangle(o, a, a + SIDES, b);
            if (ring + 1 < RINGS) triangle(o, b, a + SIDES, b + SIDES);
        }
}
