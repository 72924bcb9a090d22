/* force.h -- what a kind of force promises.
 *
 * A law acts along a measure s: a joint coordinate, the distance of two points, an angle.  It is given
 * s and its rate and answers with the force and its slopes.  Between two markers, one on each of two bodies, a kind
 * says which scalars of their relative motion it works along, and with what force each.  force/ does the rest, the same
 * for all kinds: the load
 *
 *     Q_F += (ds/dq)' f                                                      (2-1)
 *
 * and the slopes in the iteration matrix.  A signal is a value given in the deck as an expression
 * or as a table of time.
 *
 * A new kind is a file of its own and a line in FORCE_KINDS. */
#ifndef FMDSUB_KIND_FORCE_H
#define FMDSUB_KIND_FORCE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/keys.h"

struct expr;
struct node;

/* --- along a measure --------------------------------------------------------------------------- */

struct law {
    double f;  /* [N] or [N m], positive when it drives s upwards */
    double ks; /* -df/ds [N/m] or [N m/rad] */
    double kv; /* -df/dv [N s/m] or [N m s/rad] */
};

/* f = preload - k (s - rest) - c s' */
struct affine {
    double k, c, rest, preload;
};

/* --- between two markers ----------------------------------------------------------------------- */

/* A marker at an instant; world axes. */
struct frame {
    double x[3], v[3]; /* [m], [m/s] */
    double E[9], w[3]; /* axes by column; angular velocity [rad/s] */
};

/* The markers on the first and on the second body. */
struct between {
    int space;
    struct frame a, b;
    double angle; /* plane: of b against a since drawn, continuous [rad] */
    double twist; /* space: about the axis twist(), with the turns it has taken, to within less than half a turn */
};

/* A scalar of their relative motion and what works along it.  With v_a, v_b the velocities of the places at_a, at_b on
 * the two bodies
 *
 *     s' = dir . (v_b - v_a) + on_a . w_a + on_b . w_b
 *
 * so that a force f along s is f dir on b at at_b, -f dir on a at at_a, and the torques f on_a, f on_b. */
struct strain {
    double s, rate;          /* [m] or [rad]; [m/s] or [rad/s] */
    bool slides, turns;      /* are there forces, torques? */
    double dir[3];           /* unit; world axes */
    double on_a[3], on_b[3]; /* [1] or [m]; world axes */
    double V;                /* stored energy [J] */
    double f, lost; /* its force -dV/ds, positive when it drives s upwards; what is added to it and lost or put in */
    double ks, kv;  /* -d(f + lost)/ds, -d(f + lost)/ds' */
};

enum { MOST_STRAINS = 10 };
struct strains {
    int n;                   /* 0 when the kind is asked */
    double at_a[3], at_b[3]; /* [m] world */
    double tilt;             /* a rotation whose large values stiffnesses share by convention [rad]; 0 by default */
    struct strain of[MOST_STRAINS];
};

/* The head of the parameter block of such a force. */
struct markers {
    const struct node *bodies, *at, *axis; /* in the deck */
    double drawn[9], Ea[9], Eb[9];         /* their axes by column: drawn, world; in those of body a, of body b */
};

/* The keys that fill it. */
#define MARKER_KEYS(strukt, member, word)                                                                              \
    PARAM_NODE(strukt, member.bodies, word, "[body, body]", KEY_REQUIRED, "the two bodies"),                           \
        PARAM_NODE(strukt, member.at, "at", "point", KEY_REQUIRED, "where it stands when drawn, unloaded"),            \
        PARAM_NODE(strukt, member.axis, "axis", "vector", 0, "its z axis (2-D: x axis); default: the world's axes")

/* --- kinds ------------------------------------------------------------------------------------- */

struct force_kind {
    const char *name;  /* deck word, e.g. "spring" */
    const char *brief; /* one line for `fmdsub list` and the manual */
    const struct key *keys;
    size_t size; /* bytes of the parameter block `par` */
    bool rate; /* of a measure that the deck names by its rate, NAME_rate; behind a kind of the same word that is not */

    /* One of law() and strains() is required: it says whether a force is along a measure or between two markers.  All
     * functions run in the step loop on trial states in any order: they never allocate, never fail, remember nothing.
     *
     * The force at measure s, rate v, time t. */
    void (*law)(struct law *o, const void *par, double s, double v, double t);

    /* Optional.  There is a stored energy V for W_int of (2-26); without it the power f v is booked as loss
     * (dissipative) or work.  The mean force -(V(s1) - V(s0))/(s1 - s0) in f, without the difference of large numbers
     * and also at s1 = s0, and its slope along the middle of s0 and s1 in ks: -2 df/ds1. */
    void (*mean)(struct law *o, const void *par, double s0, double s1);

    /* Optional, with mean().  V [J]; without it V is summed by mean(), from step to step. */
    double (*stored)(const void *par, double s);

    /* Optional.  How far s, of strains() the first, is from where a push begins; negative where it pushes. */
    double (*clear)(const void *par, double s);
    /* Optional, with clear().  The push where that is negative, at rate v, were it free to pull: it acts where it is above 0.
     * *at_once: the part of it that is there as soon as it begins. */
    double (*whole)(double *at_once, const void *par, double s, double v);

    /* Optional.  Values at s, of a `rate` kind the rate, that change sign where f bends or jumps so that steps are to end there;
     * NAN: on neither side.  Returns how many there are; side NULL: only that. */
    int (*sides)(double *side, const void *par, double s);

    /* Optional, with mean().  Is there a corner or a jump of f between s0 and s1? */
    bool (*bends)(const void *par, double s0, double s1);
    bool sharp; /* where it acts, steps are solved to round-off, so that many bounces keep the energy */

    /* Optional.  The part of f that is not from stored(), at rate v: its power goes to the damper channel. */
    double (*dissipative)(const void *par, double s, double v, double t);
    /* Optional, with mean() and dissipative().  The same over an interval with the mean force f. */
    double (*beside)(const void *par, double f, double s, double v);

    /* Optional (none: no).  Is f affine in s and v with these parameters, all but c s' from stored()?  Then how.  Its
     * slopes never change and its discrete gradient is the midpoint force. */
    bool (*affine)(struct affine *o, const void *par);

    /* The scalars between two markers, all members; par begins with struct markers. */
    void (*strains)(struct strains *o, const void *par, const struct between *x);

    /* Optional, of kinds whose first strain may be stiff: the forces f of strains over an interval from s0 to s1 and their slopes ks along its middle, as mean() has
     * them, where these are not those at the mean of s0 and s1. */
    void (*means)(struct strains *o, const void *par, const double *s0, const double *s1);

    /* Optional.  In space: is there an axis [3] (unit; axes of the markers as drawn) about which turns are counted, as a
     * measure NAME.twist?  in_world: it stays as drawn, the first body does not take it along. */
    bool (*twist)(double *axis, bool *in_world, const void *par);

    /* Optional (none: no).  Do its forces and torques on the two bodies have a moment in sum, as if from outside? */
    bool (*held)(const void *par);
};

/* The kinds, in the order of manual and lists: force_bushing in bushing.c, and so on. */
#define FORCE_KINDS(of) of(bushing) of(spring) of(damper) of(curve) of(curve_rate) of(unilateral)
#define FORCE_KIND(name) extern const struct force_kind force_##name;
FORCE_KINDS(FORCE_KIND)
#undef FORCE_KIND

/* The i-th; NULL past the last. */
const struct force_kind *force_kind_at(int i);

/* What a force acts along, and what a deck may ask for by name. */
enum measure_type {
    MEASURE_COORDINATE,   /* s = q[iq], rate v[iv] */
    MEASURE_DISTANCE,     /* |b - a| of two points */
    MEASURE_DISPLACEMENT, /* axis . (b - a), axis fixed in body of point a */
    MEASURE_ANGLE         /* of body b against body a about axis (body a axes); 2-D: continuous; 3-D: in (-pi, pi] */
};

enum force_type {
    FORCE_LAW,    /* kind->law along a measure */
    FORCE_VALUE,  /* a signal along a measure */
    FORCE_LOAD,   /* three signals: force at a point or torque on a body, world or body axes */
    FORCE_BETWEEN /* kind->strains between two markers */
};

/* A value in time and state: an expression over slots (slot 0 is t), or a table of t, linear between
 * its points and constant beyond its ends. */
struct signal {
    const struct expr *expr; /* NULL: table */
    int ncorner;
    const struct expr_corner *corner; /* [ncorner] of expr: known times at which it bends or jumps */
    bool cornered;                    /* and there are no others */
    int nstop;
    const double *stop; /* [nstop] ascending: where it becomes quick all at once, see signal_stop_at_sudden() */
    int n;
    const double *t, *x; /* [n], t ascending */
};
/* Of an expression over slots. */
struct arena;
struct signal signal_of(const struct expr *expr, struct arena *life);
/* Where the value is to be had at t: at a known corner on its side before, so that it does not matter with which sign
 * the deck compares; at t = 0, where motion begins, behind it.  For slot 0 of value and slopes. */
double signal_time(const struct signal *s, double t);
/* Is there such a corner at t, with another side?  Not at t = 0. */
bool signal_has_sides(const struct signal *s, double t);
/* The time, not before t, up to which it is known that it has no corner and no jump; t: that is not known. */
double signal_clear(const struct signal *s, double t);
double signal_value(const struct signal *s, const double *slot);
bool signal_reads_time(const struct signal *s);
/* Is it 0 always? */
bool signal_is_zero(const struct signal *s);
/* Value, and slopes d[i] along slots which[i]. */
double signal_slopes(const struct signal *s, double *d, const double *slot, const int *which, int n);
/* Of time alone: value x[0], rate x[1] and acceleration x[2] at t, as signal_time() has it.  A table's rate is that of the
 * piece before t; at its first point, where motion begins, that behind it. */
void signal_motion(const struct signal *s, double *x, double t);
/* By how much the rate jumps at corners in [ta, tb). */
double signal_corner(const struct signal *s, double ta, double tb);
/* Right before the first of them; infinity: there is none. */
double signal_corner_time(const struct signal *s, double ta, double tb);
/* Does the value itself jump in [ta, tb)?  Then *at is right before the first place found, *before and *behind are the
 * values there; no motion follows it. */
bool signal_jump(const struct signal *s, double *at, double *before, double *behind, double ta, double tb);
/* May the value grow without bound, and does it on the straight way of its slots [n] from a to b? */
bool signal_may_have_poles(const struct signal *s);
bool signal_pole(const struct signal *s, const double *a, const double *b, int n);
/* May it jump; the largest jump on such a way, from *before to *behind: false: none. */
bool signal_may_leap(const struct signal *s);
bool signal_leap(const struct signal *s, double *before, double *behind, const double *a, const double *b, int n);
/* As expr_sides(). */
int signal_sides(double *side, const struct signal *s, const double *slot);
/* Steps that choose themselves are to stop in (from, to) where an expression of time alone becomes quick all at once: for
 * signal_next(). */
void signal_stop_at_sudden(struct signal *s, double from, double to, struct arena *life);
/* And within each piece between two such stops or known corners: a step over all of it, which asks for the motion at its ends
 * and in its middle alone, may see nothing of it. */
void signal_stop_within(struct signal *s, double from, double to, struct arena *life);
/* The first point of a table, known corner or such stop after time t; infinity: none. */
double signal_next(const struct signal *s, double t);

#endif
