/* condense_parts.h -- what the files of the condensation share.
 *
 *     rows.c             C and C_q at a posture
 *     solve.c            C_qd factored; rates and accelerations of the dependents, multipliers
 *     condense_reduce.c  r, M^ and slopes of the independents
 *     closing.c          dependents that close the loops; positions moved
 *     closing_again.c    the same from another posture nearby
 *     split.c            which coordinates are dependent
 *     split_order.c      in which order rows and dependents stand
 *     split_gain.c       how fast dependents go
 *     condense_start.c   the start: assembled, closed, or refused
 *     condense_assemble.c  a start that does not fit, projected
 *     condense_unique.c  which reactions redundant rows leave open
 *     condense_drive.c   drives: their time, their power, the impulse of their corners
 *     condense.c         building, and what others ask
 *
 * Each component has a rank and a split of its own.
 */
#ifndef FMDSUB_LOOP_CONDENSE_PARTS_H
#define FMDSUB_LOOP_CONDENSE_PARTS_H

#include "loop/condense.h"
#include "loop/rows.h"

/* C_qd, factored, and C_q at one posture. */
struct solved {
    double *A, *F;
    int *swap;
};

/* A number of C_q in a used row. */
struct entry {
    int e;    /* in F */
    int k;    /* its coordinate's place in v */
    int at;   /* of a dependent coordinate: in A's store; of an independent one: its number here */
    int slot; /* and among all independent ones */
};

/* The split of a component. */
struct part {
    const struct component *of;
    int nr, *kept;    /* [nrow] its rows, of which the first nr are used */
    int *dep, *ind;   /* [nr], [nk - nr]: numbers in k */
    int *place;       /* [nk] number in dep, or -1 - number in ind */
    int ni, nfast;    /* nk - nr; fast ones among them */
    int nlead, *lead; /* [nrow] kept rows of drives: numbers in `kept` */
    double *T0, *s0;  /* [nr x nlead] C_qd^-1 of their unit vectors; their measures; at the base of point() */
    int nof_dep;
    struct entry *of_dep, *of_ind;
    int *from; /* [nr + 1] where the rows of of_ind begin */
    double *A; /* C_qd, factored: A(i,j) = A[i + j ld] inside its band */
    int band[2], ld;
    double *G, *G0; /* [nr x ni] -C_qd^-1 C_qi; at the base of point() */
    struct room {   /* what A, G and G0 stand in: grows when a new split needs more */
        double *store;
        size_t size;
    } A_room, G_room, G0_room, base_room;
    int *prow, *pcol; /* [max(nrow, nk)] */
    double *pivot;    /* [min(nrow, nk)] */
    bool wide;        /* many independents: no G0, but what is solved with at the base of point() */
    struct solved base;
    double *probe;  /* [nk] */
    double *x;      /* [max(nrow, nk)] */
    double *whole;  /* [nrow x nk] of a small component; NULL: pivots are found by rows */
    int *loop_of;   /* [nk] the first loop that a coordinate is in, by their order */
    int *row_order; /* [nrow] */
    double *weight; /* [nk] */
    double chosen;  /* pivot ratio when the partition was chosen */
    double gain;    /* least component_gain() since then */
    bool away;      /* there is reason to look for a better split */
};

struct condense {
    struct open_tree *tree; /* of it, as they are used often: */
    const struct model *model;
    const struct sweep_ops *ops;
    const struct moves *moves;
    struct sweep *sweep;
    struct rows rows;
    struct loops *loops, *shown; /* at trial states, those of rows; where condense_push() stood */
    int nt, npart;
    struct part *part; /* of each component */
    int *ind;          /* [n] places of the independent ones */
    int *slot;         /* [nt] number among the independent ones; -1: dependent */
    bool *bound;       /* [nturn] a rate of this rotation is dependent */
    struct condense_start start;
    struct ode2 ode;
    struct ode2_chart chart;
    struct ode2_breaks breaks;
    long charts;
    double *q, *v; /* start */
    /* workspace */
    double *C, *C2;       /* [rows] */
    double *vt, *at, *rt; /* [nt] */
    double *va, *vb;      /* [nt] at the ends of an interval */
    double *zero;         /* [nt] */
    double *dx, *dxs;     /* [nt], [nt] */
    struct posture base;  /* of point() and of the tangent */
    long tangent;         /* base that G0, or what stands for it, is of; 0: none */
    double *last;         /* [nt] */
    long seen;            /* posture at which the loops are looked at; 0: none */
    long factored;        /* posture that C_q is of, and all components are factored at; 0: none */
    bool few;             /* independents, against the tree: M^ and slopes without its own matrices */
    double *M;            /* [nt x nt]; few: NULL */
    double *still, *Tx;   /* [nt] */
    double *Ty;           /* [2][n] */
    struct elements *elements;
    struct elastic *elastic;
    double *qtry, *way;           /* [nq], [nt] */
    double *side[2];              /* [nq] postures beside a singular one */
    double *aside, *mean;         /* [nt] */
    double *M_side, *M_jump;      /* [n x n] */
    int *split, *work;            /* a component's split, to go back to; [nt + rows] */
    struct arena *life, *scratch; /* scratch: of new splits */
    double holds;                 /* |C| up to which dropped rows hold; 0: there are none */
    int lost;                     /* of the last posture that could not be closed: the worst loop, */
    double lost_by;               /* its |C| at the nearest posture met */
};

/* --- C_q and its factor ---------------------------------------------------------------------------- */

/* A, factored, of C_q as it is.  0: singular or not finite. */
int component_factor(struct part *c);
/* x [nr] -= C_qi of the independent numbers of xt [nt] */
void component_take(const struct part *c, double *x, const double *xt);
/* x [nr] := C_qd^-1 x */
void component_solve(const struct part *c, double *x);
/* G := -C_qd^-1 C_qi */
void component_G(const struct part *c, double *G);
/* Pivot ratio of C_qd as last factored, lengths scaled. */
double component_ratio(const struct condense *o, const struct part *c);
/* lambda = -C_qd^-T r_d of one component, in c->x by dependent rows: row kept[i] has x[i]. */
void component_multipliers(const struct part *c, const double *rt);
/* Drives as they are at t, by their means over [ta, tb] where that is an interval. */
void condense_time(struct condense *o, double t, double ta, double tb);
/* Does the rate of a drive jump in the interval of the last condense_time()? */
int condense_jumps(const struct condense *o);
/* E_NUMERIC where a drive or its rate is not finite, as condense_time() has left them. */
enum status condense_driven(const struct condense *o, bool accelerations, double t, struct trouble *why);
/* The posture NAN is one that could not be closed: says which loop was lost. */
enum status condense_lost(const struct condense *o, double t, struct trouble *why);
/* r [n] = r_i + C_qi' lambda of the tree's rt, which leaves the multipliers in component->x; w: NULL, or takes the
 * drives' power. */
void condense_gather(struct condense *o, double *r, double *w, const double *rt);
/* w += power of the drives, with the multipliers in component->x */
void component_power(const struct condense *o, const struct part *c, double *w);
/* As ode2 has it, where the tree has one. */
void condense_settle(const struct ode2 *ode, double *q1, double *v1, const struct instant *x);
/* E_NUMERIC where a dropped row no longer holds, at the posture looked at. */
enum status condense_contest(struct condense *o, double t, struct trouble *why);
/* As ode2_breaks has it. */
int condense_jump(const struct ode2 *ode, double *v, double *work, const double *q, double ta, double tb);
double condense_corner(const struct ode2 *ode, double ta, double tb);

/* o->still; y [nt] := M x of the tree with its bodies of cls, where condense_still() has been. */
void condense_still(struct condense *o, const double *q, unsigned cls);
void condense_momentum(struct condense *o, double *y, const double *x, unsigned cls);

/* All components looked at and factored at q, where the bodies then stand. */
enum status condense_factor(struct condense *o, const double *q, double t, struct trouble *why);
/* Least pivot ratio at the posture last factored. */
double condense_least_ratio(const struct condense *o);
/* x [n] of the independents into the whole xt [nt], dependents 0. */
void condense_spread(const struct condense *o, double *xt, const double *x);
/* x_d := -C_qd^-1 (C_qi x_i + C_t), with the factors and the drives' rates at hand. */
void condense_follow(struct condense *o, double *xt);

/* --- positions ------------------------------------------------------------------------------------ */

/* condense_rates() with the drives as condense_time() has left them. */
enum status condense_motion(struct condense *o, double *vt, double *at, const double *q, const double *v,
                            const double *a, double t, struct trouble *why);

/* G0 := G at q, or what stands for it, where condense_predict() starts; 0: singular there. */
int condense_tangent(struct condense *o, const double *q);
/* o->dx: independents given, dependents along the tangent, by drives too, which go to where they are by o->loops. */
void condense_predict(struct condense *o);
/* q1 = base (+) o->dx; of rotations that are wholly independent the fraction s of the way. */
void condense_put(struct condense *o, double *q1, const double *base, double s);
/* o->dx of the dependents -= C_qd^-1 C, with the factors and the o->C at hand; how much that is, in scales. */
double condense_correct(struct condense *o);
/* Closes q1 = base (+) o->dx by its dependents; 0: it cannot be. */
int condense_close(struct condense *o, double *q1, const double *base, double s);
/* The point() of condense_move: predicted and closed at time t; NAN where it cannot be. */
void condense_point(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t);
/* Its again(): closing_again.c. */
void condense_again(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t);

/* --- partition ------------------------------------------------------------------------------------ */

/* Loops in order, for loop_of and row_order. */
void component_order(struct condense *o, struct part *c);
/* Rank of C_q at the posture of the last rows_linearize(): pivots at least `least` times the first. */
int component_rank(struct condense *o, struct part *c, double least);
/* The best split of a component at the present posture; how good it is. */
double component_choose(struct condense *o, struct part *c);
/* Largest rate of a dependent coordinate per unit of an independent one, in scales, where C_qd is as factored last; at
 * the base of point(). */
double component_gain(const struct condense *o, const struct part *c);
double component_gain_at_base(const struct condense *o, const struct part *c);
/* y [nr] := G x, x [ni] */
void component_times_G(const struct part *c, const struct solved *at, double *y, const double *x);
/* Numbers the independent coordinates by the components' splits. */
void condense_number(struct condense *o);
/* Between major steps: a better split, if one is needed; 1: changed. */
int condense_rechart(struct ode2 *ode, double *q, double *v, double t);

/* --- start ---------------------------------------------------------------------------------------- */

/* Splits, and o->q, o->v closed at the deck's start; o->start.report says what is wrong. */
enum status condense_begin(struct condense *o, const double *q0, const double *v0);

/* o->q, v [nt]: the deck's q0, v0 with the least change in the mass metric that lets C = 0 and C' = 0 hold at t = 0. */
enum status condense_assemble(struct condense *o, double *v, const double *q0, const double *v0);

extern const struct ode2_ops condense_ops; /* condense_reduce.c */
/* ode2.price at the start. */
double condense_price(struct condense *o);
extern const struct ode2_move condense_move; /* closing.c */

#endif
