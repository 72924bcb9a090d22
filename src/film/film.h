/* film.h -- a run as pictures: what is seen of a mechanism, and where it is at each record.
 *
 * Rigid bodies show their shape, or a ball at the centre of mass and bars to all that takes hold of them; flexible ones
 * the line through their nodes, between these a cubic by their rotations; joints, springs and rods between points show
 * as such.  Displacements of flexible bodies are those of first order: what is drawn is u = Phi q (flex/body.h). */
#ifndef FMDSUB_FILM_FILM_H
#define FMDSUB_FILM_FILM_H

#include "film/mesh.h"
#include "out/stream.h"
#include "sim/sim.h"

enum actor_type {
    ACTOR_SOLID, /* a frame: place [3], unit quaternion w x y z [4] */
    ACTOR_LINE,  /* a flexible body: the same of its frame, then its coordinates [n] */
    ACTOR_SPRING /* two points [6]; without coils a rod */
};

struct actor {
    enum actor_type type;
    const char *name;
    unsigned color;   /* 0xrrggbb */
    struct mesh mesh; /* SOLID: axes of the body, from its centre of mass */
    int body;         /* of the model */
    bool coils;
    struct model_point a, b; /* SPRING */
    int n, nv, npart;    /* LINE: coordinates; vertices; parts of which it is drawn, each from part[i] to part[i + 1] */
    const int *part;     /* [npart + 1] */
    double *base, *mode; /* [3 x nv], [3 x nv x n] */
    int stride, capacity;
    double *frame; /* [frames x stride] */
    int nstress, stresses;
    const int *place;      /* LINE, a beam: [nstress] of the body's places of stress, along it */
    const double *station; /* [nstress] 0 ... 1 along it, ascending */
    double *stress;        /* [frames x nstress] equivalent stress there [Pa] */
};

struct film {
    const char *title;
    int space;
    double size, low[3], high[3]; /* of all that is seen, at all times [m] */
    double mark;                  /* the same for marks of joints, bars and springs: less where there are many bodies */
    int nactor, actors, surfaces; /* from the last on they are surfaces */
    struct actor *actor;
    int frames, capacity;
    int ncolumn;
    const struct column *column; /* [ncolumn], t first */
    double *x;                   /* [frames x ncolumn] */
    struct arena *life;
};

/* For a run that is open: what is to be drawn; its records will evaluate the motion. */
void film_open(struct film *o, struct sim *sim, struct arena *life);
/* Adds a frame: the present state of the run, and its columns x [ncolumn]. */
void film_add(struct film *o, const struct sim *sim, const double *x);

/* x [3], u [3] := position (world axes) and elastic displacement of vertex i of a LINE in a frame [m]. */
void film_vertex(double *x, double *u, const struct actor *a, const double *frame, int i);

/* Adds an actor. */
struct actor *film_actor(struct film *o, enum actor_type type, const char *name, unsigned color);
/* film_surface.c: adds the surfaces of contacts; widens the picture by their size as drawn. */
void film_surfaces(struct film *o, const struct sim *sim);
void film_widen_surfaces(struct film *o, const struct scene *s);
/* Widens the picture so that it contains the point x [3]. */
void film_widen(struct film *o, const double *x);
/* After the last frame: planes are drawn as wide as the picture. */
void film_close(struct film *o, const struct sim *sim);

/* film_stress.c: finds the stress points of a beam along its line, from the deck; those of bodies from files are
 * left out.  Then adds their stresses in the present state to the frame. */
void film_stress_open(struct film *o, struct actor *a, const struct flex_body *f, const struct node *body);
void film_stress_add(struct film *o, const struct sim *sim, struct actor *a);
/* Equivalent stresses [nstress] in a frame [Pa]. */
const double *film_stress(const struct actor *a, int frame);
/* Values x [nstress] of the stress points, interpolated linearly to vertex i, constant beyond the ends; 0 without
 * such points. */
double film_along(const struct actor *a, const double *x, int i);

/* film_html.c, film_gltf.c, film_vtu.c, film_svg.c: the film as a file.  VTU: one more file for each frame, beside
 * that of the stream; SVG: a still of some frames over each other. */
enum status film_html(const struct film *o, struct stream *stream, struct report *report);
enum status film_gltf(const struct film *o, struct stream *stream, struct report *report);
enum status film_vtu(const struct film *o, struct stream *stream, struct report *report);
enum status film_svg(const struct film *o, struct stream *stream, struct report *report);

#endif
