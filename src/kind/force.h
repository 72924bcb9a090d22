/* force.h -- what a force element promises.
 *
 * A law acts along a measure s: a joint coordinate, the distance of two points, an angle.  It is told
 * s and its rate and answers with the force and its slopes.  system/ does the rest, the same for all
 * kinds: the load
 *
 *     Q_F += (ds/dq)' f                                                      (2-1)
 *
 * and the slopes in the iteration matrix.  A signal is a value given in the deck as an expression
 * or as a table of time. */
#ifndef FMDSUB_KIND_FORCE_H
#define FMDSUB_KIND_FORCE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/keys.h"

struct expr;

struct law {
    double f;  /* [N] or [N m], positive when it drives s upwards */
    double ks; /* -df/ds [N/m] or [N m/rad] */
    double kv; /* -df/dv [N s/m] or [N m s/rad] */
};

struct force_kind {
    const char *name;  /* deck word, e.g. "spring" */
    const char *brief; /* one line for `fmdsub list` and the manual */
    const struct key *keys;
    size_t size; /* bytes of the parameter block `par` */

    /* Required.  The force at measure s, rate v, time t.  Runs in the step loop on trial states in any
     * order: never allocates, never fails, remembers nothing. */
    void (*law)(struct law *o, const void *par, double s, double v, double t);

    /* Optional.  Stored energy [J] for W_int of (2-26); without it the power f v is booked as loss
     * (dissipative) or work. */
    double (*stored)(const void *par, double s);

    /* Optional.  The part of f that is not from stored(), at rate v: its power goes to the damper channel. */
    double (*dissipative)(const void *par, double s, double v, double t);

    /* Optional (none: no).  Is f affine in s and v with these parameters?  Then its slopes never change and its
     * discrete gradient is the midpoint force. */
    bool (*linear)(const void *par);
};

/* par of "spring": f = preload - k (s - rest) - c v; s is counted from the measure's zero.  For a joint coordinate rest
 * is 0 by default, for a distance the distance in the drawn position. */
struct spring {
    double k, c, rest, preload;
    double cubic; /* [N/m3]: f -= cubic (s - rest)^3 */
};
extern const struct force_kind force_spring;
extern const struct force_kind force_damper; /* the same block, c only */

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
    FORCE_BUSHING /* six springs and dampers between two markers */
};

struct bushing {
    double k[3], kr[3]; /* [N/m], [N m/rad] along and about the axes of the marker on body a */
    double c[3], cr[3];
    double Ea[9], Eb[9]; /* marker axes by column in the axes of body a, body b; equal when drawn */
};

/* A value in time and state: an expression over slots (slot 0 is t), or a table of t, linear between
 * its points and constant beyond its ends. */
struct signal {
    const struct expr *expr; /* NULL: table */
    int n;
    const double *t, *x; /* [n], t ascending */
};
double signal_value(const struct signal *s, const double *slot);
bool signal_reads_time(const struct signal *s);
/* Value, and slopes d[i] along slots which[i]. */
double signal_slopes(const struct signal *s, double *d, const double *slot, const int *which, int n);
/* Of time alone: value x[0], rate x[1] and acceleration x[2] at t.  A table's rate is that of the piece before t; at
 * its first point, where motion begins, that behind it. */
void signal_motion(const struct signal *s, double *x, double t);
/* By how much the rate jumps at corners in [ta, tb). */
double signal_corner(const struct signal *s, double ta, double tb);
/* Right before the first of them; infinity: there is none. */
double signal_corner_time(const struct signal *s, double ta, double tb);
/* Does the value itself jump in [ta, tb)?  Then *at is right before the first place found, *before and *behind are the
 * values there; no motion follows it. */
bool signal_leap(const struct signal *s, double *at, double *before, double *behind, double ta, double tb);
/* The first point of a table after time t, where it may bend; infinity: none. */
double signal_next(const struct signal *s, double t);

#endif
