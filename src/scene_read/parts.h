/* parts.h -- the readers of a deck's sections, and their key tables; private to scene_read/. */
#ifndef FMDSUB_SCENE_READ_PARTS_H
#define FMDSUB_SCENE_READ_PARTS_H

#include "kind/unilateral.h"
#include "scene/build.h"

/* sections.c: the tables; the sections that are the same for all joints and forces, with the options of the schemes [*n] */
const struct section *sections_fixed(int *n, const struct key_block *schemes, struct arena *life);
struct deck_keys {
    int version;
    const char *title;
    int units, space;
    const struct node *parameters, *include, *gravity, *bodies, *constraints, *measures, *tables, *signals, *states,
        *forces, *surfaces, *contacts, *drives, *initial, *partition, *integrate, *output, *checkpoint, *energy,
        *effects;
};
struct body_keys {
    double mass;
    const struct node *inertia, *at, *orient, *points, *shape;
    int inertia_check;
};
struct ground_keys {
    const struct node *points;
};
struct rod_keys {
    const struct node *from, *to;
};
struct shape_keys {
    const struct node *box, *cylinder, *rod, *sphere, *tube;
    double density;
};
struct measure_keys {
    const struct node *points, *axis;
};
struct value_keys { /* force, torque */
    const struct node *on, *value;
    int frame;
};
struct surface_keys {
    const struct node *on, *at, *normal, *along;
    double radius;
    struct points points;
};
struct contact_keys {
    const struct node *between, *friction;
    double restitution, speed, impact; /* impact: speed of impacts, 0: not given */
    struct unilateral push;            /* k 0: it is rigid */
};
struct friction_keys {
    double kinetic, holding; /* NAN: not given */
    double slip;             /* of compliant contacts */
};
struct rubbing_keys {
    double coefficient, kinetic, holding; /* NAN: not given */
    double radius, length, preload;
};
struct range_keys {
    double lower, upper; /* NAN: no end there */
    const struct node *hold;
};
struct drive_keys {
    const struct node *drive, *value;
    int drawn; /* 1: from where it is drawn */
};
struct first_order_keys {
    const struct node *rate;
    double start;
};
struct table_keys {
    struct points points;
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
    int deck; /* 1: any */
};
struct state_keys {
    int version;
    double t, length;
    int last_step;
    const char *deck, *tree, *check;
    const struct node *state, *angles, *memory;
};
struct output_keys {
    const struct node *every, *columns;
};
struct checkpoint_keys {
    const struct node *every;
    const char *file;
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
extern const struct key keys_deck[], keys_body[], keys_ground[], keys_shape[], keys_rod[], keys_distance[],
    keys_displacement[], keys_angle[], keys_force[], keys_torque[], keys_drive[], keys_table[], keys_partition[],
    keys_integrate[], keys_output[], keys_every[], keys_checkpoint[], keys_checkpoint_every[], keys_energy[],
    keys_omega[], keys_state[], keys_from[], keys_until[], keys_band[], keys_range[], keys_hold[], keys_plane[],
    keys_spot[], keys_spots[], keys_sphere[], keys_hole[], keys_profile[], keys_cam[], keys_contact[], keys_friction[],
    keys_pin_friction[], keys_slide_friction[], keys_first_order[];

/* the parts, in the order they are read; what is wrong is told to the diags of the builder */
/* states.c: quantities of first order join bodies, constraints, signals, forces and initial, before all of these */
void make_states(struct builder *b, struct deck_keys *k);
void read_bodies(struct builder *b, const struct node *n);
void read_joints(struct builder *b, const struct node *n);
void read_measures(struct builder *b, const struct node *n);
/* ties.c: the two points of a rod; when all joints are known, what gears and racks tie */
int read_rod(struct builder *b, struct scene_joint *j, const struct node *points, const char *what);
void read_ties(struct builder *b);
/* measures.c: a plain coordinate by name, "hub.angle", or by that of its joint if it has one only; 0, or 1 and an error
 */
int find_coordinate(struct builder *b, struct scene_measure *m, const struct node *n, const char *what);
/* stops.c: the range of a joint's coordinate; what holds it there, among forces and contacts; one that a drive moves */
int read_range(struct builder *b, struct scene_joint *j, const struct node *n, const char *what);
void make_stops(struct builder *b);
/* rubbing.c: friction in a joint; of a law its coefficients, one number or a pair */
int read_rubbing(struct builder *b, struct scene_joint *j, const struct node *n, const char *what);
void make_rubbing(struct builder *b);
int check_coefficients(struct builder *b, struct contact_law *law, double kinetic, double holding, const struct node *n,
                       const char *what);
void check_stops(struct builder *b);
/* contacts.c: behind the forces, whose stops are contacts, too */
/* compliant.c: what one that gives way is made of; keys of the other kind of contact are refused */
/* Restitution of one with a stiffness, if it has any. */
int check_loss(struct builder *b, const struct node *n, double e, double speed, const char *what);
int check_compliant(struct builder *b, const struct contact_keys *k, const struct node *n, const char *what);
void add_compliant(struct builder *b, const struct scene_contact *c, const struct contact_keys *k, double slip);
/* Refuses the key of n, if it is given, for the reason `why`. */
int refuse_beside(struct builder *b, const struct node *n, const char *key, const char *what, const char *why,
                  const char *hint);
void read_contacts(struct builder *b, const struct node *surfaces, const struct node *contacts);
/* tips.c: is the force one that the program has a word for? */
void tip_on_force(struct builder *b, const struct scene_force *f);
void read_forces(struct builder *b, const struct node *n);
/* signals.c: tables by name; signals, behind the measures */
void read_tables(struct builder *b, const struct node *n);
void read_signals(struct builder *b, const struct node *n);
/* The signal of this name, if it is a table; NULL: it is none. */
const struct signal *find_table_signal(const struct builder *b, const char *name);
/* forces.c: is it an expression of time and the motion? */
int check_expression(struct builder *b, const struct node *n);
/* Of a map that takes a 'table' or a 'file': is there one of them? */
int one_table(struct builder *b, const struct node *n);
int read_time_table(struct builder *b, struct signal *o, const struct node *n);
/* measures.c: may a measure or signal be called so?  1: told why not. */
int wrong_value_name(struct builder *b, const struct node *n, const char *what);
void read_drives(struct builder *b, const struct node *n);
/* When the start is known: drives that begin elsewhere than drawn, and nothing says so. */
void warn_of_drives(struct builder *b);
/* An expression or table of time alone. */
int read_time_signal(struct builder *b, struct signal *o, const struct node *n, const char *what);
int read_condition(struct builder *b, struct scene_condition *o, const struct node *n);
void read_initial(struct builder *b, const struct node *n);
void read_partition(struct builder *b, const struct node *n);
void read_integrate(struct builder *b, const struct node *n, const struct key_block *schemes);
void read_output(struct builder *b, const struct node *n);
void read_checkpoint(struct builder *b, const struct node *n);
/* effects.c: before the bodies, which it has a say in */
void read_effects(struct builder *b, const struct node *n);
/* Is it the name of an expression among the output's columns?  No force or condition reads these. */
bool is_output_formula(const struct deck *deck, const char *name);

/* What a force acts along: a joint, coordinate, measure by name, or [point, point]; -1 after an error. */
int measure_of(struct builder *b, const struct node *n, const char *what);
/* Adds a measure to the scene; its number. */
int measure_add(struct builder *b, const struct scene_measure *m);

#endif
