/* touch_parts.h -- what the files of touch.h share. */
#ifndef FMDSUB_ENGINE_TOUCH_PARTS_H
#define FMDSUB_ENGINE_TOUCH_PARTS_H

#include "engine/cone.h"
#include "engine/matrix.h"
#include "engine/path.h"
#include "engine/single.h"
#include "engine/touch.h"

enum { MOST_EVENTS = 256 };
enum { TOUCH_PARTS = 16 };                /* of a step, in which gaps are looked for that close and open again */
static const double TOUCH_CLOSED = 1e-12; /* of a usual gap: where an impact is found */
static const double TOUCH_DRAWN = 1e-9;   /* of a usual gap: where the run starts it is closed */
static const double TOUCH_AT_REST = 1e-9; /* of the largest velocity */
static const double TOUCH_SMALL = .1;     /* of the tolerance: what steps by tolerance need not follow */

/* Rows of contacts at an instant. */
struct touch_rows {
    double *G; /* [rows x n] row after row */
    double *b; /* [rows] */
};

/* What a step, or a trial of a part of it, may have to go back to. */
struct touch_saved {
    double t;
    struct single at;
    double work[POWER_CHANNELS], lost, left, struck; /* of the stepper */
    double top, took;                                /* as in struct touch, from here on */
    int begun, nevent, lost_events;
    long all, lowered;
    int nclosed, *which, npushed, *pushed;
    int nother, *other, *is_other; /* [m] contacts that may not be as they are here, else they are: looked at since */
    int *closed, *state;
    long *impacts;
    double *impulse, *p, *way;
};

struct touch {
    const struct ode2 *ode;
    const struct ode2_contact *c;
    struct stepper *stepper;
    double *size;   /* [m] usual gaps, those of the start */
    double longest; /* the longest of them, or 1 */
    double reach;   /* gaps above it are not looked at in the step under way */
    int *first;     /* [m] the first of a contact's rows among all */
    int *closed;    /* [m] */
    int nclosed;    /* of these, */
    int *which;     /* [m] ascending */
    int *state;     /* [m] enum touching */
    double *way;    /* [2 m] unit vectors across along which they slide, or slid last */
    double *p;      /* [rows] impulses of the last step, */
    double took;    /* that long; */
    int npushed;    /* of these contacts, [m], all others' are 0 */
    int *pushed;
    double *impulse; /* [m] since the start */
    long *impacts;   /* [m] */
    long all;        /* impacts */
    long lowered;    /* of these, such whose restitution with friction would have gained energy */
    double top;      /* largest velocity met, of any coordinate */
    double usual;    /* step [s] */
    bool jammed;     /* touch_forces() has found none */
    double rough;    /* round-off of the accelerations that it has started from */
    double hardest;  /* speed of an impact in the step under way */
    int begun;
    int nevent, lost_events;
    struct touch_event event[MOST_EVENTS];
    struct touch_state *shown; /* [m] */

    /* of the step under way */
    int *turns;        /* [m] enum touch_switch */
    int *forced;       /* [m] is it held, does it slide its way, whatever that takes? */
    double *held;      /* [all rows] forces there */
    double *heads;     /* [2 m] the ways along which they go, if they do */
    struct cone *cone; /* [m] those that are looked at */
    int n, rows;       /* of these; their rows */
    struct cone_work work;
    int *contact;    /* [m] their numbers, ascending */
    struct matrix J; /* of the step */
    double hfactor;  /* for which it was made; 0: none */
    struct matrix M; /* of impacts */
    struct touch_rows middle, end;
    double *X, *W;           /* [n x rows], [rows x rows] */
    double *u, *u1, *l;      /* [rows] */
    double *last;            /* [rows] l of the pass before */
    struct nearby g, g0, g1; /* gaps: as touch_gaps() has seen them, */
    struct {
        double *q, t, reach;               /* NAN: it has not */
    } seen;                                /* there; */
    double *e;                             /* [m] restitutions, in an impact */
    double *N, *f;                         /* [m] pressing forces of joints, [all rows] forces */
    double *off, *was;                     /* [m] by how much they are beside those of the motion; of the last time */
    double share;                          /* of that, by which they are mended */
    double *v1, *vm, *a, *dx, *r, *y, *vf; /* [n] */
    double *q, *q1;                        /* [nq] */
    struct path path;                      /* within a step */
    struct nearby among[TOUCH_PARTS + 1];  /* gaps on the way */
    double *weight;                        /* [n] of displacements, for Gonzalez' correction */
    struct touch_saved start, part;        /* before a step, before a part of it */
};

/* touch_chosen.c: gaps g at x of all within a reach. */
enum status touch_gaps(struct touch *o, const struct state *x, double reach, struct trouble *why);
/* contact[0..n) become cone[0..n); their impulses are l.  No others change what is saved of them. */
void touch_choose(struct touch *o, int n);
void touch_choose_closed(struct touch *o);
/* contact[0..n), ascending, and list [nlist], likewise, in one: how many. */
int touch_merge(struct touch *o, int n, const int *list, int nlist);
/* Of those that are looked at, and there are no others, the ones with closed[i] are closed. */
void touch_keep_closed(struct touch *o);
/* Contact i may not be as it was saved. */
void touch_change(struct touch *o, int i);
/* p := their l, of others 0 */
void touch_keep(struct touch *o);
/* p [all rows] := their l, of others 0 */
void touch_spread(const struct touch *o, double *p);

/* touch.c */
void touch_note(struct touch *o, struct touch_event e);
/* u [rows] := G v + b */
void touch_rates(const struct touch *o, double *u, const struct touch_rows *R, const double *v);
/* Their rows R at x, and the rates u [rows] there. */
enum status touch_look(struct touch *o, double *u, struct touch_rows *R, const struct state *x, struct trouble *why);
/* Of one of them at rates u [rows]: how fast it slides; is it held across? */
double touch_slip(const double *u, const struct cone *c);
bool touch_sticks(const struct touch *o, const double *u, const struct cone *c);
/* o->top, if these velocities are larger. */
void touch_grow(struct touch *o, const double *v);
/* X := F^-1 G', W := G1 X */
void touch_compliance(struct touch *o, const struct matrix *F, const double *G, const double *G1);
/* The same with M at x and the rows `end`. */
enum status touch_mass(struct touch *o, const struct state *x, struct trouble *why);
/* Pushes of joints that rub, over a time h, as x and all l have them; count: of the iteration, from 0. */
enum status touch_press(struct touch *o, const struct instant *x, double h, int count, struct trouble *why);
/* By impulses l that bring rates u to u1 [J]. */
double touch_taken(const struct touch *o);
/* v += X p */
void touch_kick(const struct touch *o, double *v, const double *p);
/* v at q, t is struck by l, which bring u to u1: the loss, and what drives do. */
void touch_strike(struct touch *o, const double *q, double *v, double t);

/* touch_run.c */
void touch_save(struct touch_saved *o, const struct touch *t, const struct state *x);
void touch_restore(struct touch_saved *o, struct touch *t, struct state *x);
/* What touches at the start of the run and comes nearer. */
enum status touch_at_start(struct touch *o, struct state *x, double h, struct trouble *why);
/* From x->t towards t1, and no further than *most, to where the first gap is 0 or friction changes; *again: from where it
 * was, as *most has it, or as friction is from there on. */
enum status touch_to_next(struct touch *o, struct state *x, double *most, int *cuts, bool *again, double h, double t1,
                          struct trouble *why);
/* At the end of a part that was taken: what opens, sticks or slides from here on, and impacts; what would be back
 * within `back` stays. */
enum status touch_at_end(struct touch *o, struct state *x, double back, int *impacts, struct trouble *why);

/* touch_forces.c: n = 0, what slides and sticks at x, and its forces, kept as impulses of 1 s. */
enum status touch_driven_at(struct touch *o, const struct state *x, struct trouble *why);

/* touch_passed.c: has a gap that is open at both ends of the step h from o->part to x, where gaps are g0 and g, been closed
 * in between?  Then *met is how far into the step; else it stays. */
enum status touch_passed(struct touch *o, double *met, const struct state *x, double h, struct trouble *why);

/* touch_held.c: one step h of x with the closed contacts held, or x as it was. */
enum status touch_held(struct touch *o, struct state *x, double h, double t1, struct trouble *why);
/* Do joints that rub press as their friction makes them?  Where they do not, as of a mechanism that is wedged by forces
 * without bounds, there is no such motion. */
bool touch_pressed_so(const struct touch *o);
/* touch_impact.c: of all contacts that are looked at or closed. */
enum status touch_impact(struct touch *o, struct state *x, double h, int last, struct trouble *why);

/* touch_switch.c: changes between sticking and sliding in a step of x, from o->part */
enum touch_switch { SWITCH_NONE, SWITCH_STOPS, SWITCH_GOES, SWITCH_MAY_GO, SWITCH_DONE };
struct touch_try {
    void (*again)(struct touch *o, struct state *x); /* back to its start */
    enum status (*take)(struct touch *o, struct state *x, double h, double t1, struct trouble *why);
};
/* state and way of contact i, at rates u */
void touch_set_slip(struct touch *o, int i, const double *u, const struct cone *c);
/* Is there one in the step that led to x?  The kind to look for first. */
enum status touch_switches(struct touch *o, enum touch_switch *which, const struct state *x, struct trouble *why);
/* Then x is where it happens; or, *again, where the step h began, from which on it is so; or where it was. */
enum status touch_cut(struct touch *o, const struct touch_try *part, struct state *x, double h, enum touch_switch which,
                      bool *again, struct trouble *why);

#endif
