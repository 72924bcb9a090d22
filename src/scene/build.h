/* build.h -- what the readers of a scene's parts share: names, places, plausible numbers.
 * For scene_flex and scene_read; nothing above needs it. */
#ifndef FMDSUB_SCENE_BUILD_H
#define FMDSUB_SCENE_BUILD_H

#include "deck/read.h"
#include "scene/scene.h"

struct draft;
struct builder {
    struct scene *scene;
    struct diags *diags;
    struct reader reader;
    const struct key *sections; /* the deck's own keys */
    struct arena *life;
    bool cut;                      /* there are beams in segments */
    struct draft **draft;          /* [nbody] flexible bodies that are still to be made; NULL: not one */
    const struct node *space_from; /* the vector or key that decided 2-D or 3-D */
    unsigned unheard;              /* effects (effect_bit()) against which the deck may say what it likes */
    unsigned denied;               /* those that `effects` turns off, heard or not */
};

/* keys of `orient` */
struct orient_keys {
    const struct node *x, *z, *axis, *quaternion;
    double angle;
};
extern const struct key keys_orient[];

/* places.c: vectors, points, frames */
/* A vector of the deck's space; 2-D: o[2] = 0.  what: "'at' of body 'rod'" */
int read_place(struct builder *b, double *o, const struct node *n, const char *what);
/* A unit vector; refuses the zero vector. */
int read_direction(struct builder *b, double *o, const struct node *n, const char *what);
/* A point: a vector (fixed on the ground) or "body" or "body.point". */
int read_point(struct builder *b, struct marker *o, const struct node *n, const char *what);
/* Where a marker stands when drawn, world. */
void marker_drawn(double *o, const struct scene *scene, const struct marker *m);
/* The marker of the world point x on a body. */
void marker_at(struct marker *o, const struct scene *scene, int body, const double *x);
/* A rotation matrix: 2-D a number, 3-D {z, x}, {axis, angle} or {quaternion}. */
int read_orientation(struct builder *b, double *R, const struct node *n, const char *what);
/* The same whose first is x [not zero]; z leans to the world's, for an upright x to the world's x axis. */
void frame_along(double *E, const double *x);
/* Where z of such a frame leans. */
const double *up_of(const double *x);
/* Three orthonormal columns whose third is z; x is as near as may be to `near` (NULL: any, always the same). */
void frame_about(double *E, const double *z, const double *near);

/* names.c: names to indices, near misses; -1 after an error */
int find_body(struct builder *b, const struct node *n);
int find_two_bodies(struct builder *b, int *first, int *second, const struct node *n, const char *what);
int find_measure(const struct scene *scene, const char *name, size_t len);
/* Says that a name is unknown, with the nearest of the list. */
void unknown_name(struct builder *b, const struct node *n, enum diag_at which, const char *code, const char *kind,
                  const char *name, const char *const *list, int count);
/* Adds the names of a joint's positions and rates to the list; how many, at most JOINT_MAX_Q + JOINT_MAX_V. */
int coordinate_names(const char **list, struct builder *b, const struct scene_joint *j);
/* All names that an expression or a measure may use, for near misses. */
int quantity_names(struct builder *b, const char *const **list);
/* The joint whose coordinate, rate or acceleration is called so; -1: none. */
int find_owner(const struct scene *scene, const char *name);
/* A quantity by name: fills a slot; 0 if unknown. */
int find_quantity(const struct scene *scene, struct scene_slot *o, const char *name);

/* Did --set make this member of a section by what it sets inside?  It was meant for one that is there: told, with the
 * nearest of them. */
bool not_there(struct builder *b, const struct node *n, const char *section, const char *kind);

/* Is the key no name, or one of those that columns of the program's own begin with?  1: told; what: "body". */
int wrong_name(struct builder *b, const struct node *n, const char *what);

/* Has a body a key that only one from a file has?  Its own word may be misspelt. */
bool is_from_file(const struct node *n);

/* Does the deck name it, but in a way that is wrong and was reported? */
bool known_but_wrong(const struct builder *b, const char *name);

/* plausible.c: warnings about numbers that look like other units */
void warn_of_gravity(struct builder *b, const struct node *n);
void warn_of_density(struct builder *b, const struct node *shape, double mass, double volume, const char *what);
void warn_of_angle(struct builder *b, const struct node *n, double angle);

/* Mass per volume that some solid thing has [kg/m3]. */
bool density_is_usual(double density);

/* inertia.c: a tensor [6] about the centre of mass; a number in the plane */
/* check: one that no body can have is an error, else a warning. */
int read_inertia(struct builder *b, double *J, const struct node *n, bool check, const char *what);

#endif
