/* sides.h -- where within a step a force bends or jumps that is given by an expression of the state, or by a table.
 *
 * Such forces tell values that change sign there (sides() of ode2.h).  The trial's way is the cubic of path.h,
 * velocities by one through accelerations; it is looked at at its ends and in its middle, and where a value is near 0,
 * beside how much it goes up and down, at its quarters, too, and at the least that a parabola through three of these
 * foretells: what comes and goes within a step is seen unless it does so within less than about a tenth of it.  Of a step in
 * which something turns by more than half a radian all parts are looked at in which it does not (passing.h).  Between
 * two places of another sign the edge is found by the Illinois rule (Dowell & Jarratt, BIT 11 (1971) 168).  The force
 * jumps there if what it changes by in the last bracket is more than a small part of what it does in the step, and as much in one that
 * is a hundred times narrower.  What comes and goes within the step, with more force than there is at both ends, the scheme's
 * own points may not meet at all: that is told besides. */
#ifndef FMDSUB_ENGINE_SIDES_H
#define FMDSUB_ENGINE_SIDES_H

#include "engine/adaptive.h"

/* NULL: no force has such values. */
struct sides *sides_open(const struct ode2 *ode, struct arena *life);
/* An edge in a trial: of what kind, at which part of it; of several jumps, where the last one is; how much of the
 * change of accelerations there is behind a bend, or would be there without it, at most all. */
struct edge {
    enum edge_kind kind;
    double at, last, beyond;
    double comes; /* a part of the trial behind which something comes and goes within it; 1: nothing does */
    bool located; /* on the trial's way, not by its ends alone */
};
/* That of a step between two states, with their accelerations: of jumps the first on the way, else of bends that which is
 * farthest from both ends.  Both stay as they are until the next call. */
struct edge sides_edge(struct sides *o, const struct state *from, const struct state *to);
/* Has a value another sign at the end of a step than at its start, which is the last call's end if its time is the same?  Where all
 * are far from 0 beside how they change, a few steps are not looked at. */
bool sides_parted(struct sides *o, const struct state *from, const struct state *to);
/* Does a force jump within the time h before the state at t, or behind it?  o may be NULL. */
bool sides_jump(struct sides *o, const struct adaptive *m, double t, double h);

#endif
