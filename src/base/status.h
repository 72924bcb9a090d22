/* status.h -- the one way of failing.
 *
 * A function that can fail returns an enum status; the codes are the exit codes of the program.
 * The message is written once, where the fact is known, into a struct report; callers pass the
 * code on with TRY.  Numeric code writes no text: it fills a struct trouble, leaves the state as
 * it was, and returns E_NUMERIC; sim/ words it once, with names, when the run really stops.
 * What cannot happen is an assert. */
#ifndef FMDSUB_BASE_STATUS_H
#define FMDSUB_BASE_STATUS_H

/* A call that drops its status is reported by the compiler, through pointers, too. */
#if defined(__clang__)
#define NOT_DROPPED __attribute__((warn_unused_result))
#elif defined(__GNUC__) && __GNUC__ >= 11
#define NOT_DROPPED [[nodiscard]]
#else
#define NOT_DROPPED
#endif

__extension__ enum NOT_DROPPED status {
    OK = 0,
    E_VERDICT = 1, /* the run is whole, its verdict negative */
    E_USAGE = 2,   /* command line */
    E_DECK = 3,    /* deck text wrong */
    E_MODEL = 4,   /* right deck, no start */
    E_NUMERIC = 5, /* no convergence, singular, not finite */
    E_FILE = 6,    /* cannot open, read or write */
    E_LIMIT = 7,   /* a limit reached, memory */
    E_BUG = 70,
    E_SIGHUP = 129,
    E_SIGINT = 130,
    E_SIGPIPE = 141,
    E_SIGTERM = 143
};

#define TRY(call)                                                                                                      \
    do {                                                                                                               \
        enum status try_ = (call);                                                                                     \
        if (try_ != OK) return try_;                                                                                   \
    } while (0)

/* One message and its code; starts zeroed. */
struct report {
    enum status status;
    char text[1000];
};

/* Writes the message (the first one stays) and returns status.  report may be NULL. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
enum status
fail(struct report *report, enum status status, const char *format, ...);

/* kind of TROUBLE_CLOSURE: the loop says again what others say, and no longer the same */
enum { CLOSURE_REDUNDANT = 1 };

/* Why a trial state or a step was refused, in numbers. */
enum trouble_code {
    TROUBLE_NONE,
    TROUBLE_NOT_FINITE, /* a residual is not a number; index: row */
    TROUBLE_SINGULAR,   /* a matrix could not be factored; index: pivot; value: its ratio */
    TROUBLE_IDLE,       /* a turn that moves no mass has been set going; index: of it; value: its energy */
    TROUBLE_INERTIA,    /* the mass matrix is not positive for a body of negative inertia; index: of the body */
    TROUBLE_DIVERGED,   /* the iteration does not converge; index: worst row; value: error over tolerance */
    TROUBLE_REJECTED,   /* too many steps are given up: not to be halved but to end the run, E_LIMIT; value: how many */
    TROUBLE_CREEP,      /* steps lead nowhere, as where a force jumps against both ways; E_LIMIT; value: the last one */
    TROUBLE_TOO_SMALL,  /* the step fell below what t can resolve; value: the step */
    TROUBLE_MASS,       /* M^ not positive definite; index: coordinate */
    TROUBLE_LAW,        /* a force is not finite; kind: element kind, index: element */
    TROUBLE_CONDITION,  /* the condition that ends the run is not a number */
    TROUBLE_CLOSURE,    /* a loop cannot be closed, or its equations are singular; index: loop joint */
    TROUBLE_DRIVE,      /* a drive or a rate of it is not finite; index: loop joint */
    TROUBLE_MEMORY,     /* a matrix is larger than what is left; value: its bytes; the status is E_LIMIT */
    TROUBLE_CONTACT,    /* rigid contacts do not settle; index: one of them */
    TROUBLE_DEFLECTION  /* a flexible body is displaced by more than its length; index: body, value: in lengths */
};

struct trouble {
    enum trouble_code code;
    int kind;     /* meaning belongs to the code */
    int index;    /* row, element or joint; -1: none */
    double value; /* residual, ratio, ... */
    double t;     /* [s] */
};

/* Fills why (may be NULL) and returns E_NUMERIC. */
enum status trouble_set(struct trouble *why, enum trouble_code code, int index, double value, double t);

#endif
