/* condense_parts.h -- what the files of the condensation share.
 *
 * rows.h says where the loops stand, split.h which coordinates depend on which, solve.h how they do, closing.h where
 * they go.  On top of these
 *
 *     condense.c           building, residuals, what others ask
 *     condense_reduce.c    M^ and slopes of the independents
 *     condense_move.c      positions
 *     condense_drive.c     drives: their time, their power, the impulse of their corners
 *     condense_rechart.c   a better split between steps
 *     condense_start.c     the start: assembled, closed, or refused
 *     condense_drawn.c     drives at the start
 *     condense_branches.c  a start where the loops leave the way open
 *     condense_assemble.c  a start that does not fit, projected
 *     condense_turns.c     whole turns of screws, at the start
 *     condense_unique.c    which reactions redundant rows leave open
 */
#ifndef FMDSUB_LOOP_CONDENSE_PARTS_H
#define FMDSUB_LOOP_CONDENSE_PARTS_H

#include "loop/closing.h"
#include "loop/condense.h"

enum { SIDES = 8 };

struct condense {
    struct open_tree *tree;
    const struct model *model;
    struct rows rows;
    struct split split;
    struct solve solve;
    struct closing closing;
    struct ode2 ode;
    struct ode2_chart chart;
    struct ode2_breaks breaks;
    struct condense_start start;
    double *q, *v; /* [nq], [n] start */
    double holds;  /* |C| up to which redundant rows hold; 0: there are none */
    double missed; /* the most that one has missed by, in a run that goes on; of loop missed_by */
    int missed_by;
    struct miss lost; /* the last way that could not be closed: point() can only say that there was one */
    bool few;         /* independents, against the tree: M^ and slopes without its own matrices */
    long charts;
    long moving; /* posture at which vt and at are those of the last residual; 0: of none */
    long judged; /* split that has been looked at: where C_q is the same everywhere, once is enough */
    struct nearest nearest;
    /* workspace */
    double *C, *lambda, *jump;  /* [rows] */
    double *vt, *at, *rt;       /* [nt] of the tree */
    double *va, *vb;            /* [nt] at the ends of an interval */
    double *zero, *dx, *to;     /* [nt] */
    double *still, *Tx;         /* [nt] */
    double *a, *beside, *mean;  /* [n] */
    double *qtry, *side[SIDES]; /* [nq] */
    double *M;                  /* [nt x nt]; few: NULL */
    double *M_side, *M_solve;   /* [n x n] */
    double *driven;             /* [n] work of power() */
    bool sided;                 /* M^ has been found last from postures beside */
    double *Ty;                 /* [2][n] */
};

/* --- drives: condense_drive.c ---------------------------------------------------------------------- */

/* Drives as they are at t, by their means over [ta, tb] where that is an interval. */
void condense_time(struct condense *o, double t, double ta, double tb);
/* Does the rate of a drive jump in the interval of the last condense_time()? */
int condense_jumps(const struct condense *o);
/* E_NUMERIC where a drive or its rate is not finite, as condense_time() has left them. */
enum status condense_driven(const struct condense *o, bool accelerations, double t, struct trouble *why);
/* w += power of the drives, with multipliers lambda [rows] */
void condense_power(const struct condense *o, double *w, const double *lambda);
/* power() of ode2_breaks. */
int condense_power_of(const struct ode2 *ode, double *w, const double *a);
/* driven() of ode2. */
double condense_fastest(const struct ode2 *ode, double t);
/* As ode2_breaks has it. */
enum status condense_jump(const struct ode2 *ode, int *met, double *v, double *work, const double *q, double ta,
                          double tb, struct trouble *why);
double condense_corner(const struct ode2 *ode, double ta, double tb);

/* --- positions: condense_move.c -------------------------------------------------------------------- */

extern const struct ode2_move condense_move;
/* Its point(), with drives `beside` where they are at t. */
void condense_point(struct condense *o, double *q1, const double *q0, const double *dx, double s, double t,
                    double beside);
/* The posture NAN is one that could not be closed: says which loop was lost. */
enum status condense_lost(const struct condense *o, double t, struct trouble *why);

/* --- r, M^, slopes: condense.c, condense_reduce.c -------------------------------------------------- */

/* The tree names a row by its place in the whole v; but first it may be a drive that is to blame. */
enum status condense_own_rows(const struct condense *o, enum status status, struct trouble *why);
/* Postures on both sides of q, where C_qd is nearly singular, and the shares of what is found there; 0: it is not, or the
 * sides are no better. */
extern const double condense_share[SIDES];
int condense_sides(struct condense *o, double *const side[SIDES], const double *q, double t);
enum status condense_mass(const struct ode2 *ode, double *M, const double *q, double t, unsigned cls,
                          struct trouble *why);
enum status condense_slopes(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                            struct trouble *why);
enum status condense_turning(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                             struct trouble *why);
/* still [nt]: what holds the tree at rest at q; y [nt] := M x of its bodies of cls, where that has been found. */
void condense_still(struct condense *o, double *still, const double *q, unsigned cls);
void condense_momentum(struct condense *o, double *y, const double *x, const double *still, unsigned cls);
/* ode2.price at the start. */
double condense_price(struct condense *o);

/* --- splits: condense_rechart.c -------------------------------------------------------------------- */

/* The best split of component i for C_q as it is, as split_choose() has it; its pivot ratio. */
double condense_choose(struct condense *o, int i, const double *unit, double fast);
/* From the start on the split of component i, as C_qd is factored, is watched: one that is poor by then, as near a dead
 * centre, is left at the first step. */
void condense_watch(struct condense *o, int i);
/* The independent coordinates by the splits. */
void condense_number(struct condense *o);
/* Between major steps: a better split, if one is needed; 1: changed. */
int condense_rechart(struct ode2 *ode, double *q, double *v, double t);

/* --- start ---------------------------------------------------------------------------------------- */

/* Splits, and o->q, o->v closed at the deck's start; o->start.report says what is wrong. */
enum status condense_begin(struct condense *o, const double *q0, const double *v0);

/* Turns of screws are counted, from the drawn position to q. */
void condense_count_turns(struct condense *o, const double *q);
/* Is q0 closed as it is, and no screw a whole turn off? */
bool condense_closed(struct condense *o, const double *q0);

/* Do redundant rows still hold a small way off o->q?  What they say does not where branches meet. */
enum status condense_search_branches(struct condense *o);
/* condense_start.c: who the start's report is about; velocities vt of all coordinates at the start. */
struct report *condense_blame(struct condense *o, int loop);
struct report *condense_blame_row(struct condense *o, int row);
enum status condense_start_rates(struct condense *o, double *vt);
/* condense_drawn.c: drives begin where they are drawn; what asks for more than the freedoms that there are must agree. */
enum status condense_draw_drives(struct condense *o);
enum status condense_agree(struct condense *o);

/* The constraint of a row; the largest of the redundant rows in C [rows], and the worst. */
const char *condense_row_name(const struct condense *o, int row);
double condense_redundant_miss(int *worst, const struct split *split, const double *C);

/* o->q, v [nt]: the deck's q0, v0 with the least change in the mass metric that lets C = 0 and C' = 0 hold at t = 0. */
enum status condense_assemble(struct condense *o, double *v, const double *q0, const double *v0);

#endif
