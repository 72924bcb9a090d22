/* loops.h -- the joints that close loops, ties and drives as equations between coordinates, C(q, t) = 0 (2-2).
 *
 * Rows are dimensionless: lengths over `length`, a length of the mechanism.  All but loops_build read or feed a
 * sweep at its last motion. */
#ifndef FMDSUB_LOOP_LOOPS_H
#define FMDSUB_LOOP_LOOPS_H

#include "base/arena.h"
#include "force/measure.h"
#include "model/model.h"
#include "tree/sweep.h"

enum { LOOP_ROWS = 6 }; /* of one loop at most */

struct equation; /* equations.h */

struct loop_row {
    int loop;
    const struct equation *says;
    int i, j; /* axes that it speaks of: of the first body, of the second */
};

/* Where a loop's two bodies stand. */
struct loop_place {
    struct pose A, B;
    double d[3], x[3]; /* from the first's point to the second's; the second's point, world */
    double seen[3];    /* the point's acceleration as the first body sees it, where the first equation asks for it */
    double sum;        /* of the tied coordinates */
};

/* The axes that a row speaks of, in the world: of the first body, of the second. */
struct loop_axes {
    double e[3], g[3];
};

/* The coordinates on a loop's ways to its first and its second body, from the body where they part.  If that is
 * flexible and they go on from two of its nodes, both begin with its modes. */
struct loop_ways {
    int from, n[2]; /* of path(): what both share; what follows */
    int same;       /* modes with which both begin */
};

/* Where a drive is at time t, its rate and acceleration. */
struct moved {
    double t, x[3];
};
enum { MOVED = 4 };

struct loops {
    const struct model *model;
    const struct sweep_ops *ops;
    double length; /* [m] */
    int nrow;
    struct loop_row *row;     /* [nrow], loop by loop */
    int *first;               /* [nloop + 1] first row of each loop */
    struct loop_place *place; /* [nloop] */
    struct loop_axes *axes;   /* [nrow] */
    int *nk, **k;             /* [nloop] coordinates tied: places in v */
    struct loop_ways *ways;   /* [nloop] */
    double **Cq;              /* [nloop] its rows of C_q, [rows x nk] by row */
    double *turned;           /* [nloop] about how far a screw has turned; NAN: its turns are not counted */
    double *scale;            /* [nloop] what the terms of a sum are divided by [m] or [rad] */
    struct measures measures;
    struct row grad;     /* of a driven measure; its work */
    struct action *act;  /* [nloop] of drives: the measure where the bodies stand */
    double t;            /* time that drives are set for */
    bool there;          /* they are where they are then: not beside it or in part */
    double from, to;     /* [s] their rates are means over that; both t: they are what they are then */
    double *c, *c1, *c2; /* [nrow] of drives: where they are, their rate and acceleration; else 0 */
    double *cw;          /* [nrow] the rate that their force works with */
    struct moved *moved; /* [ndrive x MOVED] drives at the times last asked for */
    double *drawn;       /* [nrow] of drives: their measure as drawn */
};

struct loops *loops_build(const struct model *m, const struct sweep_ops *ops, struct arena *life);

/* Drives as they are at t, and `beside`; then over [ta, tb], if that is longer than nothing, by their mean rate and
 * acceleration. */
void loops_when(struct loops *o, double t, double beside);
/* The same, but rates may be left as means: for who asks for places alone. */
void loops_where(struct loops *o, double t, double beside);
void loops_over(struct loops *o, double ta, double tb);
/* The fraction `share` of the way from where they are drawn to where they are at t. */
void loops_partly(struct loops *o, double t, double share);
/* Turns of screws are counted from here on, where loops_place() has been: from the drawn position (`anew`) or from what
 * they were at; or no more.  Until then a thread fits that is the nearest. */
enum counting { COUNT_NEVER, COUNT_ANEW, COUNT_ON };
void loops_count_turns(struct loops *o, enum counting how);
bool loops_have_screws(const struct loops *o);
/* Is C_q the same everywhere, and no body looked at: drives along coordinates, gears? */
bool loops_are_constant(const struct loops *o);
/* The largest rate of a drive at t: of angles [rad/s], of lengths in the mechanism's a second. */
double loops_fastest(struct loops *o, double t);
/* jump [nrow] of drives := by how much their rates jump at corners in [ta, tb); 0: nowhere. */
int loops_corners(double *jump, const struct loops *o, double ta, double tb);
/* Looks at the bodies where they stand: first of all, after each place(). */
void loops_place(struct loops *o, const struct sweep *s, const double *q);
double loops_measure(const struct loops *o, int l);                     /* of drive l, where the bodies stand */
double loops_measure_at(const struct loops *o, int l, const double *q); /* the same, but of a coordinate at q */
bool loops_drive_coordinates(const struct loops *o);                    /* all drives do */
void loops_values(double *C, const struct loops *o);                    /* C [nrow] at the time of loops_when() */
void loops_jacobian(struct loops *o, const struct sweep *s);            /* fills Cq */
/* C'' [nrow], after accelerate(), with the coordinates' own accelerations a where a row is of them: C_q a + (C_q v)_q v
 * + C_tt. */
void loops_second(double *C2, struct loops *o, const struct sweep *s, const double *a);
void loops_push(const struct loops *o, struct sweep *s, const double *lambda); /* applies -C_q' lambda */
/* Force of the drive along its measure [N] or [N m], and its power [W]. */
void loops_drive(const struct loops *o, double *force, double *power, int l, const double *lambda);
/* Force and moment about its point that loop joint l exerts on the deck's second body, world axes [3]; of a sum: 0. */
void loops_reaction(const struct loops *o, double *f, double *n, int l, const double *lambda);
/* A rod's force, positive when it drives its points apart [N]; of gears and racks the generalized force on their last
 * coordinate [N] or [N m]; of other loop joints 0. */
double loops_force(const struct loops *o, int l, const double *lambda);

#endif
