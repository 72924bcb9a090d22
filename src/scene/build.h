/* build.h -- what the readers of a scene's parts share; private to scene/. */
#ifndef FMDSUB_SCENE_BUILD_H
#define FMDSUB_SCENE_BUILD_H

#include "deck/read.h"
#include "scene/scene.h"

struct draft;
struct builder {
    struct scene *scene;
    struct diags *diags;
    struct reader reader;
    struct arena *life;
    struct draft **draft;          /* [nbody] flexible bodies that are still to be made; NULL: not one */
    const struct node *space_from; /* the vector or key that decided 2-D or 3-D */
};

/* sections.c: the tables */
struct deck_keys {
    int version;
    const char *title;
    int units, space;
    const struct node *parameters, *include, *gravity, *bodies, *constraints, *measures, *forces, *drives, *initial,
        *partition, *integrate, *output, *energy;
};
struct body_keys {
    double mass;
    const struct node *inertia, *at, *orient, *points, *shape;
};
struct ground_keys {
    const struct node *points;
};
struct shape_keys {
    const struct node *box, *cylinder, *rod, *sphere, *tube;
    double density;
};
struct orient_keys {
    const struct node *x, *z, *axis, *quaternion;
    double angle;
};
struct measure_keys {
    const struct node *points, *axis;
};
struct value_keys { /* force, torque */
    const struct node *on, *value;
    int frame;
};
struct drive_keys {
    const struct node *drive, *value;
};
struct table_keys {
    const struct node *table;
    const char *file;
};
struct bushing_keys {
    const struct node *bodies, *at, *axis, *stiffness, *rotation, *damping, *rotation_damping;
};
struct partition_keys {
    const struct node *fast, *independent;
};
struct band_keys {
    const struct node *modes;
    double above;
};
struct until_keys {
    const struct node *when;
    double latest;
};
struct from_keys {
    const struct node *from;
    int time; /* 1: keep */
};
struct state_keys {
    int version;
    double t;
    const struct node *state, *angles;
};
struct output_keys {
    const struct node *every, *columns;
};
struct every_keys {
    int steps;
};
struct energy_keys {
    double delta;
};
struct vector_keys {
    const struct node *value;
    int frame;
};
extern const struct key keys_deck[], keys_body[], keys_ground[], keys_shape[], keys_orient[], keys_distance[],
    keys_displacement[], keys_angle[], keys_force[], keys_torque[], keys_drive[], keys_table[], keys_bushing[],
    keys_partition[], keys_integrate[], keys_output[], keys_every[], keys_energy[], keys_omega[], keys_state[],
    keys_from[], keys_until[], keys_band[];

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
/* Three orthonormal columns whose third is z; x is as near as may be to `near` (NULL: any, always the same). */
void frame_about(double *E, const double *z, const double *near);

/* names.c: names to indices, near misses; -1 after an error */
int find_body(struct builder *b, const struct node *n);
int find_two_bodies(struct builder *b, int *first, int *second, const struct node *n, const char *what);
int find_joint(const struct scene *scene, const char *name, size_t len);
int find_measure(const struct scene *scene, const char *name, size_t len);
/* Says that a name is unknown, with the nearest of the list. */
void unknown_name(struct builder *b, const struct node *n, enum diag_at which, const char *code, const char *kind,
                  const char *name, const char *const *list, int count);
/* All names that an expression or a measure may use, for near misses. */
int quantity_names(struct builder *b, const char *const **list);
/* A quantity by name: fills a slot; 0 if unknown. */
int find_quantity(const struct scene *scene, struct scene_slot *o, const char *name);

/* the parts, in the order they are read; each returns the number of errors it reported */
int read_space(struct builder *b, const struct deck_keys *k);
int read_bodies(struct builder *b, const struct node *n);
int read_joints(struct builder *b, const struct node *n);
int read_measures(struct builder *b, const struct node *n);
/* ties.c: the two points of a rod; when all joints are known, what gears and racks tie */
int read_rod(struct builder *b, struct scene_joint *j, const struct node *points, double length, const char *what);
int read_ties(struct builder *b);
/* measures.c: a plain coordinate by name, "hub.angle", or by that of its joint if it has one only; 0, or 1 and an error
 */
int find_coordinate(struct builder *b, struct scene_measure *m, const struct node *n, const char *what);
/* plausible.c: warnings about numbers that look like other units */
void warn_of_gravity(struct builder *b, const struct node *n);
void warn_of_density(struct builder *b, const struct node *shape, double mass, double volume, const char *what);
void warn_of_angle(struct builder *b, const struct node *n, double angle);

/* A name, and not one of those that columns of the program's own begin with. */
bool may_own_columns(const char *name);

/* Has a body a key that only one from a file has?  Its own word may be misspelt. */
bool is_from_file(const struct node *n);

/* Does the deck name it, but in a way that is wrong and was told? */
bool known_but_wrong(const struct builder *b, const char *name);

int read_forces(struct builder *b, const struct node *n);
int read_drives(struct builder *b, const struct node *n);
/* When the start is known: drives that begin elsewhere than drawn, and nothing says so. */
void warn_of_drives(struct builder *b);
/* An expression or table of time alone. */
int read_time_signal(struct builder *b, struct signal *o, const struct node *n, const char *what);
int read_condition(struct builder *b, struct scene_condition *o, const struct node *n);
int read_initial(struct builder *b, const struct node *n);
/* Has the joint a rotation that is no angle? */
bool turns_freely(const struct builder *b, const struct scene_joint *j);
int read_partition(struct builder *b, const struct node *n);
int read_integrate(struct builder *b, const struct node *n);
int read_output(struct builder *b, const struct node *n);

/* The value of a measure in the drawn position. */
double measure_drawn(const struct scene *scene, const struct scene_measure *m);
/* What a force acts along: a joint, coordinate, measure by name, or [point, point]; -1 after an error. */
int measure_of(struct builder *b, const struct node *n, const char *what);
/* Adds a measure to the scene; its number. */
int measure_add(struct builder *b, const struct scene_measure *m);

#endif
