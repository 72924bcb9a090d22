/* scene.h -- a deck checked whole: SI units, every name resolved, every number in its range.
 *
 * Bodies and joints stand in the deck's order; body 0 is the ground.  Everything keeps its node, so
 * that later rooms can still point into the deck. */
#ifndef FMDSUB_SCENE_SCENE_H
#define FMDSUB_SCENE_SCENE_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/index.h"
#include "deck/deck.h"
#include "deck/diag.h"
#include "flex/body.h"
#include "kind/contact.h"
#include "kind/effect.h"
#include "kind/force.h"
#include "kind/joint.h"

struct marker {
    int body;
    double p[3]; /* from the body's centre of mass, body axes [m] */
};

struct scene_body {
    const char *name;
    const struct node *node;
    const char *whole; /* a part of a beam cut into segments: its name in the deck; NULL: not cut */
    bool touches;      /* it has a surface */
    double mass;
    double inertia[6];            /* xx yy zz xy xz yz about the centre of mass, body axes [kg m2] */
    double at[3];                 /* centre of mass when drawn, world [m] */
    double R[9];                  /* body axes when drawn, by column, world */
    int nmode;                    /* elastic coordinates; 0: rigid */
    const struct flex_body *flex; /* NULL: rigid, or its deck is wrong */
    const struct flex_body *full; /* with the stiffening that the deck has turned off; NULL: it has not */
    double stout[2];              /* of a beam, whether they count or not: rotary inertia I/(A l^2) and shear
                                   * E I/(kappa G A l^2) of its stoutest section; 0: not known */
    double origin[3];             /* the frame's origin when drawn: `at` but for round-off, world [m] */
};

struct scene_point {
    const char *name; /* "body.point" */
    struct marker at;
    bool statics; /* of a beam: what a force or moment here does to it at rest is among its coordinates */
};

/* A coordinate in a sum that is 0. */
struct scene_term {
    int joint, k; /* k-th rate of the joint */
    bool angular;
    double factor;
};

/* What holds a coordinate at the ends of its range. */
struct scene_hold {
    double restitution; /* of its impacts, of compliant stops at the speed */
    double speed;       /* 0: not given */
    double k, c;        /* compliant: see kind/unilateral.h; k 0: rigid */
    int root;
};

/* Friction in a joint: its force acts at the arm, see kind/contact.h. */
struct scene_friction {
    const struct node *node;
    struct contact_law law;
    double arm;    /* of a pin its radius [m]; of a slide 1 */
    double length; /* of a slide's guide [m], whose ends bear its moment; 0: nothing does */
};

struct scene_joint {
    const char *name;
    const struct node *node;
    const struct joint_kind *kind;
    int first, second;
    double at[3];   /* world, drawn */
    double from[3]; /* distance: the first body's point, at being the second's */
    double number;  /* of its kind, see kind/joint.h: length, ratio, radius; NAN: none */
    int nterm;      /* gear, rack: what they tie, 0 when drawn */
    struct scene_term term[2];
    double E[9];                           /* joint axes x, y, z by column, world, drawn */
    bool ranged;                           /* its coordinate should stay in range[0] ... range[1] */
    double range[2];                       /* an end may be infinite where it is held */
    const struct scene_hold *hold;         /* NULL: nothing holds it there */
    const struct scene_friction *friction; /* NULL: none */
    bool loop;                             /* the deck wants it out of the tree */
    bool own;                              /* reactions in joint axes */
};

struct scene_measure {
    const char *name; /* NULL: has none, made for one force */
    const struct node *node;
    enum measure_type type;
    bool angular;
    int joint, k;       /* MEASURE_COORDINATE: k-th rate of the joint */
    struct marker a, b; /* MEASURE_COORDINATE: of the ground */
    double axis[3];     /* axes of a's body */
    bool in_world;      /* a turn as the world sees it, axis in its axes */
    double drawn;       /* its value in the drawn position */
};

/* What a slot of an expression stands for. */
enum scene_slot_type {
    SCENE_TIME,
    SCENE_MEASURE,
    SCENE_MEASURE_RATE,
    SCENE_COORDINATE,
    SCENE_RATE,
    SCENE_MODE,
    SCENE_MODE_RATE
};
struct scene_slot {
    enum scene_slot_type type;
    int index; /* measure, joint or flexible body */
    int k;     /* which q (SCENE_COORDINATE) or v (SCENE_RATE) of the joint, which mode of the body */
};

/* A condition on time, coordinates, rates and measures. */
struct scene_condition {
    const struct node *node; /* NULL: none */
    const struct expr *expr;
    int nslot;
    const struct scene_slot *slot; /* [nslot]; slot 0 is t */
};

/* A named value that expressions read: an expression, which stands in for its name, or a table of time. */
struct scene_signal {
    const char *name;
    const struct node *node;
    bool is_table;
    struct signal table;
};

struct scene_force {
    const char *name;
    const struct node *node;
    enum force_type type;
    int measure; /* along which it acts; -1: between a and b */
    const struct force_kind *kind;
    const void *par; /* kind's block */
    struct signal value[3];
    int nslot;
    const struct scene_slot *slot; /* [nslot]; slot 0 is t */
    struct marker a, b;            /* of the ground where it has none: along a measure both, a load's a */
    bool torque, body_axes;
};

/* What may touch; here only pictures read it. */
enum shape { SHAPE_PLANE, SHAPE_POINT, SHAPE_POINTS, SHAPE_SPHERE, SHAPE_HOLE, SHAPE_PROFILE, SHAPE_CAM, SHAPES };
struct scene_surface {
    const char *name;
    enum shape shape;
    struct marker at; /* a point of the plane, centre, origin of the curve */
    double radius;
    double normal[3]; /* of a plane, axes of its body; of a curve its x axis */
    const struct outline *outline;
};

/* A rigid contact, by its pair: see kind/contact.h. */
struct scene_contact {
    const char *name;
    const struct node *node;
    enum contact_pair pair;
    struct contact_law law;
    int measure;        /* PAIR_STOP */
    int joint;          /* PAIR_FRICTION */
    double side;        /* it is closed from above: 1, from below: -1 */
    double limit;       /* [m] or [rad] */
    struct marker a, b; /* others, as in model.h */
    double normal[3], along[3];
    double radius, other;          /* PAIR_FRICTION: arm, length of the guide */
    const struct outline *outline; /* PAIR_OUTLINE: from b, its x axis along normal */
};

/* A measure that moves as a function of time, s(q) = c(t): rheonomic constraint. */
struct scene_drive {
    const char *name;
    const struct node *node;
    int measure;
    struct signal value; /* of t alone */
};

/* One coordinate, or all of a joint (k = -1); or a flexible body's elastic ones. */
struct scene_choice {
    const struct node *node;
    int joint, k; /* joint -1: of the body */
    int body;
};

enum initial_type {
    INITIAL_POSITION, /* q k of the joint */
    INITIAL_RATE,     /* v k of the joint */
    INITIAL_OMEGA,    /* spherical, free: angular velocity of second against first; x[3] */
    INITIAL_ROTATION  /* spherical, free: drawn world axes; unit quaternion x[4] */
};
struct scene_initial {
    const struct node *node;
    enum initial_type type;
    int joint, k; /* joint -1: mode k of the body */
    int body;
    double x[4];
    bool body_axes; /* INITIAL_OMEGA: in axes of the second body, else world */
};

/* What is done where the balance of energy shows that the step does not resolve what moves. */
enum guard { GUARD_TELL, GUARD_ACT };

struct integrate {
    const char *scheme;      /* deck word */
    double step;             /* minor step h [s] */
    int ratio;               /* n, H = n h */
    double until;            /* [s]; 0: the section is wrong, and that was reported */
    int guard;               /* enum guard */
    const void *options;     /* the schemes' own, see scene_read() */
    const char *because;     /* what `auto` has taken and why, in words; NULL: it had nothing to choose */
    double foretold;         /* evaluations that this is to take; NAN: not known */
    const struct node *end;  /* until as the deck gives it */
    const struct node *node; /* the section */
};

/* Columns by name or pattern, or one made of others. */
struct output_column {
    const char *name;        /* of an expression; NULL: node is the pattern */
    const struct node *node; /* the expression */
    int joint;               /* whose coordinate, rate or acceleration the pattern names outright; -1: no one's */
};

struct output {
    double every;    /* [s]; 0: not in seconds */
    int every_steps; /* major steps */
    int ncolumn;
    const struct output_column *column;   /* [ncolumn] in the order they are written */
    const struct node *node, *every_node; /* NULL: not given */
};

/* Where a run keeps all that it needs to go on. */
struct checkpoint {
    double every;     /* [s]; 0: not in seconds */
    int steps;        /* major steps */
    const char *file; /* a plain name; NULL: nowhere */
};

struct scene {
    const struct deck *deck;
    const char *title;
    int space; /* 2 or 3 */
    double gravity[3];
    struct index *bodies, *joints, *measures; /* by name */
    int nbody;
    struct scene_body *body; /* [nbody], 0 is the ground */
    int npoint;
    struct scene_point *point;
    int njoint;
    struct scene_joint *joint;
    int nmeasure;
    struct scene_measure *measure;
    int nsignal;
    struct scene_signal *signal;
    int nforce;
    struct scene_force *force;
    int nsurface;
    struct scene_surface *surface;
    int ncontact;
    struct scene_contact *contact;
    int ndrive;
    struct scene_drive *drive;
    int nfast;
    struct scene_choice *fast;
    bool fast_auto; /* the deck leaves them to the motion: `partition: auto` */
    int nindependent;
    struct scene_choice *independent;
    int ninitial;
    struct scene_initial *initial;
    double start;              /* when it starts [s]: 0, or the time of that state */
    const struct node *from;   /* {coordinate or rate: number, ...} of a final state; NULL: none */
    const struct node *angles; /* {measure: angle} of that state; NULL: none */
    const struct node *left;   /* all of it; NULL: none */
    const char *tree;          /* names of its tree's joints in order, with blanks between; NULL: not told */
    double length;             /* the mechanism's by that state [m]; 0: not told */
    bool keeps;                /* the run goes on at its time */
    bool any_deck;             /* it may be another deck's, or edited */
    bool at_rest;              /* start in static equilibrium, found from there */
    bool assemble;             /* start in the nearest state that loops and drives allow */
    struct integrate integrate;
    struct scene_condition when; /* ends the run */
    struct output output;
    struct checkpoint checkpoint;
    double delta; /* of (2-26) */
    struct effect_wishes effects;
    const struct node *effects_node; /* NULL: not given */
    unsigned off;                    /* effects of flexible bodies that the deck turns off, though there is some */
    unsigned in_beams;               /* rotary, shear: those that a beam has */
};

/* Checks the deck and fills a scene; all errors go to diags, the status is diags' own.  schemes: what the schemes read of
 * `integrate`, for the rooms above. */
enum status scene_read(struct scene **out, struct deck *deck, const struct key_block *schemes, unsigned unheard,
                       struct diags *diags, struct arena *life);

/* What a picture is called: the deck's title, or its name. */
static inline const char *scene_title(const struct scene *scene)
{
    return *scene->title ? scene->title : scene->deck->name;
}

/* Finds a joint's coordinate by the words after its name, "angle", "angle_rate": 1 for a position (k counts q), 2 for
 * a rate (k counts v), 3 for an acceleration, 0 for none. */
int scene_coordinate(const struct scene_joint *joint, const char *word, int *k);

/* The body, the joint of that name; -1: none. */
int scene_find_body(const struct scene *scene, const char *name, size_t len);
int scene_find_joint(const struct scene *scene, const char *name, size_t len);

/* "body.mode3", "body.mode3_rate" of a flexible body: 1 for the coordinate, 2 for its rate, 0 for neither; k from 0. */
int scene_mode(const struct scene *scene, const char *name, int *body, int *k);

/* The node of a flexible body on which a place of its drawn state stands: the nearest.  offset: from there, body axes.
 */
int scene_node(double *offset, const struct scene_body *body, const double *world);

/* The key tables by section, for `fmdsub list`, `fmdsub schema` and the manual. */
/* The i-th section; false past the end. */
bool scene_section(struct section *o, int i);

#endif
