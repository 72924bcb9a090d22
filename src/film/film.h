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

/* Of a run that is open; its records are to know the motion. */
void film_open(struct film *o, struct sim *sim, struct arena *life);
/* A record: what the run stands at, and its columns x. */
void film_add(struct film *o, const struct sim *sim, const double *x);

/* Where vertex i of a LINE stands at a frame, world axes; how far it is displaced. */
void film_vertex(double *x, double *u, const struct actor *a, const double *frame, int i);

/* Another of its actors; and film_surface.c: the surfaces that touch. */
struct actor *film_actor(struct film *o, enum actor_type type, const char *name, unsigned color);
void film_surfaces(struct film *o, const struct sim *sim);
/* Their size, as drawn. */
void film_widen_surfaces(struct film *o, const struct scene *s);
void film_widen(struct film *o, const double *x);
/* When all records are there: planes are as wide as what has been seen. */
void film_close(struct film *o, const struct sim *sim);

/* film_stress.c: where along a beam its places of stress are, as the deck has it; those of files are at nodes, and left out.
 * What they stand at with a record. */
void film_stress_open(struct film *o, struct actor *a, const struct flex_body *f, const struct node *body);
void film_stress_add(struct film *o, const struct sim *sim, struct actor *a);
/* Equivalent stresses [nstress] at that frame [Pa]. */
const double *film_stress(const struct actor *a, int frame);
/* What x [nstress] of the places is at vertex i: straight between them, constant beyond; 0 where there are none. */
double film_along(const struct actor *a, const double *x, int i);

/* film_vtu.c (files beside that of the stream, too), film_html.c, film_gltf.c, film_svg.c: the whole as a file; of the last, some postures over each other. */
enum status film_html(const struct film *o, struct stream *stream, struct report *report);
enum status film_gltf(const struct film *o, struct stream *stream, struct report *report);
enum status film_vtu(const struct film *o, struct stream *stream, struct report *report);
enum status film_svg(const struct film *o, struct stream *stream, struct report *report);

#endif
