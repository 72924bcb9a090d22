/* expr.h -- expressions of time, state and parameters, and their exact derivatives.
 *
 *     value    = sum
 *     sum      = product { ("+" | "-") product }
 *     product  = sign { ("*" | "/") sign }
 *     sign     = ("-" | "+") sign | power
 *     power    = atom [ "^" sign ]                       right to left; -2^2 = -4
 *     atom     = number | name | name "(" value { "," value } ")" | "(" value ")"
 *              | "if(" truth "," value "," value ")"
 *     truth    = both { "or" both };  both = not { "and" not };  not = "not" not | relation | "(" truth ")"
 *     relation = value ("<" | "<=" | ">" | ">=" | "==" | "!=") value
 *
 * The text becomes code for a small stack machine; what is constant is folded.  Evaluation allocates
 * nothing and calls only what is on the list of functions.  Slopes are by forward differentiation
 * of the code: exact but for round-off, one-sided at the corners of abs, min, max, mod, if, step, ramp. */
#ifndef FMDSUB_EXPR_EXPR_H
#define FMDSUB_EXPR_EXPR_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

struct expr;

/* A text is at most this long [bytes], nested this deep, and needs at most this many operands at a time. */
enum { EXPR_LENGTH = 65536, EXPR_DEPTH = 64, EXPR_STACK = 64 };

struct expr_error {
    size_t offset; /* bytes into the text */
    size_t length; /* bytes of the word it is about, at least 1; may reach the end of the text */
    bool limit;    /* too long or too deep rather than wrong */
    char text[160];
    char hint[160]; /* what to try; may be empty */
};

/* Names are the caller's: find() resolves a name (letters, digits, '_', dots: "hub.angle_rate"), either to a
 * constant (*slot = -1, *value) or to a slot (*slot >= 0).  0 if known; else 1, and it may write text and
 * hint of error, or 2: what is wrong with it was reported elsewhere. */
struct expr_names;
struct expr_stand_in {
    const char *text;
    const struct expr_names *names; /* of its own names */
};
struct expr_names {
    int (*find)(void *self, int *slot, double *value, const char *name, struct expr_error *error);
    void *self;
    /* NULL, or: does a text stand for the name, another expression, in brackets as it were?  Asked before find(). */
    bool (*stand_in)(struct expr_stand_in *o, void *self, const char *name);
};

/* 0: ok.  names may be NULL: none. */
int expr_parse(struct expr **out, const char *text, size_t len, const struct expr_names *names, struct arena *arena,
               struct expr_error *error);

/* The same for a truth by itself, "t > 1 and hub.angle < 0": its value is 1 or 0. */
int expr_parse_truth(struct expr **out, const char *text, size_t len, const struct expr_names *names,
                     struct arena *arena, struct expr_error *error);

/* e + x. */
struct expr *expr_plus(const struct expr *e, double x, struct arena *arena);

double expr_value(const struct expr *e, const double *slot);

/* The value, and d[i] = d value / d slot[which[i]] for i in [0,n). */
double expr_slopes(const struct expr *e, double *d, const double *slot, const int *which, int n);

/* The value, and first and second derivative along the slot `which`. */
double expr_jet(const struct expr *e, double *d, double *dd, const double *slot, int which);

/* The distinct slots read, ascending, at most max of them; returns how many there are. */
int expr_reads(const struct expr *e, int *slots, int max);
/* Has it no function that may bend or jump: are all its slopes continuous wherever it is finite?  true is sure. */
bool expr_is_smooth(const struct expr *e);

/* Bounds of the value while each slot goes from lo[i] to hi[i] or back, and its degree as a polynomial of those that move.
 * False where it may bend, jump or leave its domain in the inside of that box: sure of a smooth one that is narrow, and
 * said in vain of some that are wide. */
enum { EXPR_NO_POLYNOMIAL = 99 };
struct expr_span {
    double lo, hi;
    int degree;
};
bool expr_span(struct expr_span *o, const struct expr *e, const double *lo, const double *hi);

/* May it grow without bound: does it divide, raise to powers, take tangents?  false is sure. */
bool expr_may_have_poles(const struct expr *e);

/* A straight way of all slots, from a to b [n, at most EXPR_SLOTS]. */
enum { EXPR_SLOTS = 64 };
struct expr_way {
    const struct expr *e;
    const double *a, *b;
    int n;
};
/* Has the value a corner, a jump or a pole on the way? */
bool expr_bends(const struct expr_way *o);
/* Has it one of which the integral has no end, as 1/x has at 0?  *at: where, as a share of the way. */
bool expr_pole(double *at, const struct expr_way *o);
/* The largest jump on the way, from *before to *behind, poles apart.  false: there is none. */
bool expr_leap(double *before, double *behind, const struct expr_way *o);
/* The mean of the value over a way on which one slot alone moves, to round-off: cut at corners and jumps, with poles infinite;
 * *slope: what it gains with the end b of that slot.  Where the way is a point, the value and half its slope. */
double expr_mean(double *slope, const struct expr_way *o, int slot);

/* Known times at which it may bend or jump: `at`, and every period after and before it (0: once), where what is linear in
 * the slot `slot` alone, the time, changes sides in a comparison, or a function that bends there.  Returns how many there
 * are; corner: NULL, or room for them. */
struct expr_corner {
    double at, period, width; /* width: of the round-off of `at`, in units of the machine's */
};
int expr_corners(struct expr_corner *corner, const struct expr *e, int slot);
/* Does it bend or jump nowhere else?  false: that is not known. */
bool expr_corners_are_all(const struct expr *e, int slot);
/* The first of its times after t; infinity: none. */
double expr_corner_next(const struct expr_corner *c, double t);
/* Is t one of them, but for round-off?  Then *before: a time at which the expression is as it was before. */
bool expr_corner_meets(double *before, const struct expr_corner *c, double t);

/* Of a function of slot 0 alone, the time, with known corners [n]: times in (from, to) to stop at, so that steps which suit
 * what is before do not step over what is short; ascending.  What is less than a twentieth of all that it does is not
 * looked for.  Returns how many there are in at [room]. */
int expr_sudden(double *at, int room, const struct expr *e, const struct expr_corner *corner, int n, double from,
                double to);

/* Values [sides] that change sign where it bends or jumps and slots other than 0, the time, have a part in it; NAN: it
 * is on neither side, or not asked.  Returns how many there are; slot NULL: only that, 0: there is none at all. */
int expr_sides(double *side, const struct expr *e, const double *slot);

/* The functions there are, for messages and the manual; ends with a NULL name. */
struct expr_function {
    const char *name;
    int nmin, nmax; /* arguments */
    int op;         /* of the machine */
    const char *brief;
};
extern const struct expr_function expr_functions[];

/* Is this a word of the language (a function, pi, if, and, or, not), so no name of anything else? */
bool expr_is_word(const char *name);

/* Scans one number, [digits][.digits][e[+-]digits] without sign, at the start of a 0-terminated text: its length in
 * bytes, 0 if there is none.  *wrong: NULL, or what is wrong with it ("out of range", ...). */
size_t expr_number(double *out, const char *text, const char **wrong);

#endif
