/* flexible.h -- flexible bodies while a deck is read; private to the readers.
 *
 * A beam's keys are read with the bodies, but it is made only when all joints, measures and forces are known: every
 * place where one of them takes hold becomes a node. */
#ifndef FMDSUB_SCENE_FLEX_FLEXIBLE_H
#define FMDSUB_SCENE_FLEX_FLEXIBLE_H

#include "flex/beam.h"
#include "scene/build.h"

/* beam_keys.c: the tables */
struct beam_body_keys {
    const struct node *beam, *section, *sections, *material, *damping, *masses, *points, *stress;
    int modes, segments, stiffening;
};
struct beam_keys {
    const struct node *from, *to, *up;
    int elements, shear, rotary;
};
struct section_keys {
    const struct node *rectangle, *tube, *circle;
    double area, Iy, Iz, J, ky, kz, y, z, station, twist;
};
struct material_keys {
    double E, nu, G, density;
};
struct damping_keys {
    double alpha, beta, ratio;
};
struct lump_keys {
    double station, mass;
    const struct node *inertia;
};
struct station_keys {
    double station;
    const struct node *offset;
    int statics;
};
struct probe_keys {
    double station, y, z;
    int corner;
};
struct reduced_keys {
    const char *file;
    const struct node *at, *origin, *orient, *points;
    int modes;
};
extern const struct key keys_reduced[], keys_beam_body[], keys_beam[], keys_section[], keys_sections[], keys_material[],
    keys_damping[], keys_lump[], keys_station[], keys_probe[];

/* A beam that is still to be made. */
struct draft {
    struct flex_beam beam;
    bool round;               /* sections are circles: corners lie on them */
    bool shear, rotary;       /* as the deck wants them */
    bool unasked;             /* it says nothing of shear, which then is off */
    bool wrong;               /* and that was reported: no stress is judged by its sections */
    double length;            /* [m] */
    double stout[2];          /* see struct scene_body */
    double sheared;           /* the second of these where it bends most easily */
    double centre;            /* station of the centre of mass */
    const struct node *modes; /* where the deck gives their number; NULL: it does not */
    bool choose;              /* it does not, but wants them by evidence */
    double from, to;          /* of a beam cut into segments its part, in stations of the whole; else 0, 1 */
};

/* beam_sections.c: cross-sections and materials; 0 if all was well */
int read_material(struct builder *b, struct draft *o, const struct node *n, const char *what);
int read_sections(struct builder *b, struct draft *o, const struct beam_body_keys *k, const struct node *n,
                  const char *what);
/* Does a section of these give shear factors?  Then they count. */
bool gives_shear(const struct node *n);
/* Could it count: are there factors, given or of a shape, and a shear modulus? */
bool knows_shear(const struct node *section, const struct node *material);

/* plausible.c: a beam that looks like other units */
void warn_of_beam(struct builder *b, const struct draft *o, const struct node *material, const struct node *beam,
                  const struct node *section, const char *what);

/* beams.c: a body's beam; fills body and b->draft */
int read_beam(struct builder *b, struct scene_body *body, int index, const struct node *n);
/* A point {station: s, offset: [...]} of a beam: from the centre of mass, body axes. */
int read_station(struct builder *b, struct scene_point *o, int body, const struct node *n, const char *what);

/* reduced.c: a body from a file; a point of it by the name of a node; its named nodes as points */
int read_reduced(struct builder *b, struct scene_body *body, const struct node *n);
int read_node_name(struct builder *b, double *p, int body, const struct node *n);
void name_nodes(struct builder *b, int body, const struct node *points);

/* Mass and centre of mass of a beam that is not made. */
void weigh_beam(struct scene_body *body, struct draft *o);

/* segments.c: the last body read becomes n of them; how many more bodies the deck's segments make */
void cut_beam(struct builder *b, int index, int n);
int more_segments(struct builder *b, const struct node *bodies);
/* Fixed joints between them, behind all others. */
void join_segments(struct builder *b);
/* The part of a beam in segments that is nearest to a place, of two the first; NULL: no beam in segments is called so. */
const char *segment_at(const struct builder *b, const char *whole, const double *place);
/* A station of the deck in that of the part; is a point of the deck this body's? */
double station_in(const struct draft *o, double station);
bool holds_point(const struct builder *b, int body, const struct node *n);

/* evidence.c: modes: auto.  The first keep [all->inner] of a body's coordinates that the deck asks for. */
enum { MOST_CANDIDATES = 40 };
const struct flex_chosen *choose_modes(bool *keep, struct builder *b, int body, const struct flex_body *all);

/* flexible.c: nodes at all places in use, then the reduced bodies */
void make_flexible(struct builder *b);

#endif
