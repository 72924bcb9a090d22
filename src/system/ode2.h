/* ode2.h -- a second-order system as an integrator sees it:
 *
 *     r(q, v, a, t) = M^(q,t) a - Q^(q,v,t) = 0                              (2-4)
 *
 * independent coordinates only, fast first: S = [0,ns), L = [ns,n).  q [nq] are positions, v and a
 * [n] quasi-velocities and their rates: for a spherical or free joint q holds a unit quaternion and v
 * the angular velocity in body axes; everywhere else q' = v.  Engines never add to q themselves.
 *
 * Pure in (chart, arguments): no memory of trial states, no allocation, the same bits when called
 * twice.  E_NUMERIC: this trial state cannot be reached (not finite, loop not closable); *why is
 * filled, nothing is printed.
 *
 * Three functions are required (a unit test's oscillator fills just these); the groups below them
 * may be NULL and have dense defaults. */
#ifndef FMDSUB_SYSTEM_ODE2_H
#define FMDSUB_SYSTEM_ODE2_H

#include <stdbool.h>
#include <stddef.h>

#include "base/nearby.h"
#include "base/rate.h"
#include "base/status.h"

struct ode2;

/* Channels of power, along v. */
enum channel { POWER_EXTERNAL, POWER_DRIVE, POWER_DAMPER, POWER_FRICTION, POWER_CHANNELS };

#define SHARP 1e12 /* above any change of a slope that one would write */

/* *dk without it; was it there? */
static inline int sharpened(double *dk)
{
    if (*dk < SHARP) return 0;
    *dk -= SHARP;
    return 1;
}

struct instant {
    double t;
    const double *q;       /* [nq] */
    const double *v, *a;   /* [n]; a NULL: zero */
    const double *qa, *qb; /* [nq] ends of the interval, for discrete gradients; NULL: point law */
    const double *va, *vb; /* [n] velocities at the ends, where v is their mean and a their difference over tb - ta;
                            * NULL: not such an interval.  Read where there is a settle(), see there */
    int jump;              /* velocities of a drive jump between: va and vb are not ends of one smooth motion */
    double ta, tb;         /* [s] times of the ends: drives move by their means over it; equal: as they are at t */
    bool looks;            /* slopes() here are for whoever watches a run: dk stays relative to those before */
};

struct ode2_ops {
    /* r [n]: the residual of the asked classes' bodies and elements, all rows (written, not added).
     * w [POWER_CHANNELS]: power along v by channel [W]; NULL: not wanted.
     * dk: largest relative change of a slope since the last slopes(), above .2 asks for a fresh
     * factor; plus SHARP where the solution is wanted to round-off; NULL: not wanted; systems without changing slopes
     * write 0. */
    enum status (*resid)(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x, unsigned cls,
                         struct trouble *why);
    /* M^ [n x n] by column, of the asked classes, exact and symmetric; of FAST, where `near` is known, its first `near` rows
     * and columns. */
    enum status (*mass)(const struct ode2 *o, double *M, const double *q, double t, unsigned cls, struct trouble *why);
    /* K = dr/dq, C = dr/dv of the stiff terms [n x n] by column; may be approximate; symmetric >= 0 for
     * potentials and dampers.  Either may be NULL. */
    enum status (*slopes)(const struct ode2 *o, double *K, double *C, const struct instant *x, unsigned cls,
                          struct trouble *why);
    /* K and C += what slopes() leaves out: how the inertia of parts that bend changes while they turn.  Unsymmetric,
     * may be approximate: for iteration matrices only.  x with a; right after slopes() there.  Optional. */
    enum status (*turning)(const struct ode2 *o, double *K, double *C, const struct instant *x, unsigned cls,
                           struct trouble *why);
};

/* An iterate that is itself to be corrected need not close loops: they were left open in q1, and may be after again(), by
 * the square of a small way. */
enum ode2_open { OPEN_BEFORE = 1, OPEN_AFTER = 2 };

/* Positions moved by quasi-displacements.  NULL: q1 = q0 + s dx, nq = n. */
struct ode2_move {
    /* q1 = q0 (+) s dx: the point at fraction s of the path that ends at q0 (+) dx.  For rotations
     * R1 = R0 cay(dx), and the fractions lie on the same axis.  Loops are closed and drives stand where they are at
     * the time t of q1; NaN where that cannot be.  q1 may be q0. */
    void (*point)(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s, double t);
    /* dx with q1 = q0 (+) dx. */
    void (*diff)(const struct ode2 *o, double *dx, const double *q1, const double *q0);
    /* The rate of dx where q1 = q0 (+) dx, at time t, moves with velocity v; exact (explicit schemes need its
     * order): for rotations dx' = (I + [dx]x/2 + dx dx'/4) v.  NaN where the loops cannot follow v. */
    void (*rate)(const struct ode2 *o, double *dxrate, const double *q1, const double *q0, const double *dx,
                 const double *v, double t);
    /* Optional.  off [n] := what the straight way h v of a step misses of a rotation whose velocity is v, changing by a:
     *
     *     |v|^order v,  with order 2 + v x a,    times h^(order + 1)/12 with order 2,
     *
     * from dx' above; for other coordinates 0, and for rotations that loops determine in part what the rest alone tells. */
    void (*bend)(const struct ode2 *o, double *off, const double *v, const double *a, int order);
    /* Optional.  point() for an iterate that is itself to be corrected, by again().  Are loops left open? */
    bool (*first)(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s, double t);
    /* Optional.  point() to round-off, where q1 holds what this or point() has given for the same q0, s, t and another
     * dx: found from there, with less work where they are near each other.  open: what of enum ode2_open holds.  Are loops
     * left open? */
    bool (*again)(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s, double t, int open);
    /* Optional.  The same where q1 holds any posture nearby, of any time; the less work the nearer, and less where
     * resid() has just been there.  OPEN_AFTER: by some 1e-12 of a usual change at most. */
    void (*onward)(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s, double t, int open);
};

/* Solvers that know the structure.  NULL, or a NULL member: dense. */
struct ode2_direct {
    /* a = M^-1 Q^: (2-4) solved.  w as in resid(). */
    enum status (*accel)(const struct ode2 *o, double *a, double *w, const double *q, const double *v, double t,
                         struct trouble *why);
    /* F := (cm M + cc C + ck K)(x), factored; the caller owns F [factor_size bytes].  With an a in x: right after
     * resid(ALL) there, and with what slopes() leaves out.
     * E_NUMERIC with TROUBLE_SINGULAR when the structure does not allow it: the caller goes dense. */
    size_t factor_size;
    double price; /* of it, as in struct ode2 */
    int least;    /* coordinates from which on it is less work than a dense one */
    enum status (*factor)(const struct ode2 *o, void *F, double cm, double cc, double ck, const struct instant *x,
                          struct trouble *why);
    /* x := F^-1 x. */
    void (*solve)(const struct ode2 *o, const void *F, double *x);
    /* F := M(q) + diag(d), d [n], factored likewise; a coordinate with d = INFINITY is held: its x of
     * solve() is 0, and the others move as if it were not there.  LIMBS: only what shares inertia with fast coordinates, the
     * rest of F stays as it was made last. */
    enum status (*stiffen)(const struct ode2 *o, void *F, const double *d, const double *q, double t, unsigned cls,
                           struct trouble *why);
    double limbs; /* that costs such a share of the whole */
};

/* Between accepted major steps only. */
struct ode2_chart {
    /* Angles known up to whole turns go on from q.  A better chart (partition, rotation base) there: 1 if it changed;
     * the vectors o->along then go with v. */
    int (*rechart)(struct ode2 *o, double *q, double *v, double t);
};

struct ode2_breaks {
    /* Next known kink in time after t (infinity: none). */
    double (*next)(const struct ode2 *o, double t);
    /* Do values that are told of time have another side at t than that before it, which all functions take there?  Then a
     * step from t that asks for them at t begins right behind it.  Optional. */
    int (*sides)(const struct ode2 *o, double t);
    /* Corners of drives in [ta, tb): *met := 1 if there is one, else 0; v takes their impulse at q, ta, and work +=
     * what it brought [J].  For schemes that ask for accelerations at points of time and so miss it.  NULL: no drives. */
    enum status (*jump)(const struct ode2 *o, int *met, double *v, double *work, const double *q, double ta, double tb,
                        struct trouble *why);
    /* Right before the first of these corners; infinity: there is none.  With jump(). */
    double (*corner)(const struct ode2 *o, double ta, double tb);
    /* Right after resid(ALL) with w, without accelerations, and mass(ALL) there: w as it is with accelerations a [n].  0: that
     * has to be asked of resid().  With jump(). */
    int (*power)(const struct ode2 *o, double *w, const double *a);
};

/* What touches, see engine/touch.h: resid() and accel() know nothing of it. */
struct ode2_touch {
    double restitution;
    double holding, sliding; /* coefficients of friction where it sticks, where it slides */
    int across;              /* directions of friction; 0: smooth */
    double preload;          /* friction that no push makes, besides */
    bool joint;              /* friction alone: no gap, row 0 is 0, its push is told by bound() */
    double size;             /* a usual gap: of 1e-12 of it, it is closed */
};
struct ode2_contact {
    int m, nrow;                 /* contacts; 1 + across of them, summed */
    const struct ode2_touch *of; /* [m] */
    void *self;                  /* the owner's */
    /* Gaps at q, t: open above 0; of any above the reach, not to be near will do: of whom does not depend on calls before. */
    enum status (*gap)(const struct ode2_contact *o, struct nearby *g, double reach, const double *q, double t,
                       struct trouble *why);
    /* Of the contacts which[0..k), one behind the other, each with 1 + across rows: G [rows x n], row after row, the
     * gradient of the gap, then directions across; b [rows]: rates that come not from v but from what is driven. */
    enum status (*rows)(const struct ode2_contact *o, double *G, double *b, const int *which, int k, const double *q,
                        double t, struct trouble *why);
    /* N [m], of joints among which[0..k): the forces that press there at x, with x->a, while f [nrow] pushes along all rows.
     * NULL: there are none. */
    enum status (*bound)(const struct ode2_contact *o, double *N, const int *which, int k, const struct instant *x,
                         const double *f, struct trouble *why);
};

enum met { MET_NOT, MET_MAYBE, MET };

/* Of a push that is there at one end of a way and not at the other: it grows from 0 or falls to 0; or comes and goes on it; or
 * is there at once. */
enum edge_kind { EDGE_NONE, EDGE_BEND, EDGE_PULSE, EDGE_JUMP };

struct ode2 {
    int n;        /* independent velocities */
    int ns;       /* of these fast, the first ns */
    int nq;       /* positions, >= n */
    double price; /* of mass(), slopes(), turning() and a dense factor, in evaluations of resid(ALL); 0: not known */
    int near;     /* resid(FAST) depends on, and has rows in, the first `near` velocities only; 0: not known */
    const struct ode2_ops *ops;   /* required */
    const struct ode2_move *move; /* the rest optional */
    const struct ode2_direct *direct;
    const struct ode2_chart *chart;
    const struct ode2_breaks *breaks;
    const struct ode2_contact *contact; /* NULL: nothing touches */
    /* Kinetic energy [J] at a state, of what drives move, too; 0 where it is not known.  NULL: not known. */
    double (*kinetic)(const struct ode2 *o, const double *q, const double *v, double t);
    double (*size)(const struct ode2 *o, int i); /* a usual change of coordinate i; NULL: 1 */
    /* The fastest of what drives move at t, which may be none of the coordinates, in usual changes a second; NULL: there are
     * no drives. */
    double (*driven)(const struct ode2 *o, double t);
    /* Of a system in which something flies freely: where va and vb are given, resid(ALL) takes the change of its
     * momenta from end to end, so that a step keeps them.  Its centre of mass then is not quite where point() has put
     * it: at the end of a step settle() moves q1, which is x->qb where that is known, there, and v1, x->vb, by what is
     * left of the residual.  x->t is the middle of a step of the midpoint rule, and x->tb where an interval is several of them.
     * E_NUMERIC: the ends are no states of the system; q1 and v1 stay. */
    enum status (*settle)(const struct ode2 *o, double *q1, double *v1, const struct instant *x, struct trouble *why);
    /* Has what pushes only where bodies meet been met and left again between two states, unseen at both?  `between`: a state
     * on the way, at which it may be seen; NULL: none is known.  NULL: there is nothing of the kind. */
    enum met (*passed)(const struct ode2 *o, const struct instant *a, const struct instant *between,
                       const struct instant *b);
    /* Required with passed().  The part of the way between the states a and b that it has looked at last at which a push begins
     * or ends, of several that which is farthest from both; NAN: none does.  Of kinds *edge the last one goes
     * first, and of jumps the first on the way. */
    double (*edge)(const struct ode2 *o, enum edge_kind *kind);
    /* Values [nside] at a state that change sign where a force bends or jumps by it, each with that force; NAN: on neither
     * side. */
    int nside;
    void (*sides)(const struct ode2 *o, double *side, double *force, const struct instant *x);
    double *along[2]; /* the engine's: [n] displacements or changes of velocities, small; NULL: none */
    int straight;     /* displacements add up: from q0 by a and then by b is from q0 by a + b */
    int bends;        /* forces may jump or bend where nobody knows beforehand: by the state */
    int steep;        /* forces may change by much on a short way: any that no linear law gives */
    int workless;     /* all powers are 0 always: they need not be asked for */
    int pointwise;    /* nothing looks at qa and qb: they need not be known, and may be NULL */
    void *self;       /* the owner's */
};

static inline double ode2_usual(const struct ode2 *o, int i)
{
    return o->size ? o->size(o, i) : 1;
}

#endif
