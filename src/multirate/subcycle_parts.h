/* subcycle_parts.h -- what the files of sub-cycling share; the scheme and its equations are in subcycle.c.
 *
 *     subcycle.c           a major step: opened, iterated, accepted
 *     subcycle_centre.c    where W is formed
 *     subcycle_matrix.c    its matrices: W and u0 (S1), damping (S7), J (S11), that of the slow rows (S12)
 *     forecast.h           predictor: where the iteration begins
 *     subcycle_jump.c      for it: how the force on the fast coordinates jumps from one major step to the next
 *     subcycle_point.c     positions and velocities of the minor steps (S2)-(S4) and of the end (S9), from the unknowns
 *     subcycle_fast.c      one pass over the minor steps: residuals r_k (S6), d_k corrected
 *     subcycle_coarse.c    the same pass from the residuals of a few minor steps, the others interpolated
 *     subcycle_slow.c      slow bodies (S5), slow rows R (S8), du corrected and all d_k with it
 *     decouple.h           W and P (S1)
 *     response.h           the linearized answer of the minor steps to the slow unknown (S11), (S12)
 *     subcycle_accept.c    the step that has been found: its end (S9), its energy, what the next one needs of it
 *     subcycle_error.c     its local error, where steps are chosen by a tolerance or errors are summed over the run
 *     subcycle_coupling.c  part of it: of fast coordinates, since slow ones move straight (S13)-(S15)
 *     subcycle_resolve.c   do the minor steps resolve what vibrates in them?
 */
#ifndef FMDSUB_MULTIRATE_SUBCYCLE_PARTS_H
#define FMDSUB_MULTIRATE_SUBCYCLE_PARTS_H

#include <math.h>

#include "engine/local_error.h"
#include "engine/motion.h"
#include "engine/newton.h"
#include "multirate/decouple.h"
#include "multirate/forecast.h"
#include "multirate/response.h"

static const double STALE_SLOPE = .2; /* relative change of a slope that asks for a fresh factor */

/* subcycle_coupling.c: the jump of fast accelerations between major steps. */
struct subcycle_coupling {
    /* Of the last step that was taken; new_: of the one under way. */
    double *tail, *rate; /* [ns] fast accelerations and their rates extrapolated to its end */
    double *s;           /* [ns] amplitude of the sawtooth (S13): the last ones are too small by it */
    int terms;           /* minor steps that these are from; 0: not known */
    double *new_tail, *new_rate, *new_s;
    int new_terms;
    double *position, *velocity; /* [ns] errors of the fast coordinates by it (S15), sizes */
    double *x, *p, *dx, *dv;     /* [ns] scratch */
    double *stiff;               /* [ns x ns] scratch: M + (H^2/12) K, factored */
};

/* subcycle_error.c: the local error of a major step. */
struct subcycle_error {
    struct local_error slow, fast; /* after the last step that was taken: of v by major steps, of x by minor ones */
    struct local_error minor;      /* of x, while the minor steps are gone through */
    double *position, *velocity;   /* [n] errors of the last step, sizes */
    double *swing,
        *new_swing;       /* [nl] u' at the end of a major step less its extrapolation: largest so far, fading; now */
    double *more, *whole; /* [ns], [n] scratch */
    double *a, *bend;     /* [n] scratch */
    struct subcycle_coupling coupling;
};

enum { JUMP_TERMS = 3 };

/* subcycle_jump.c: the major step before, and the last residuals that the fast rows had in it. */
struct last_step {
    double h;      /* its minor step; 0: there is none */
    double *W;     /* [nl x ns] */
    double *Mss;   /* [ns x ns] */
    double *share; /* [ns] part of its slow bodies in the fast rows that does not depend on d_k */
    double *x, *y; /* [ns], [nl] x_n and H w */
    int terms;     /* columns of a and rows that there are */
    double *a;     /* [ns x JUMP_TERMS] accelerations of its minor steps, from the last one back */
    double *rows;  /* [ml x JUMP_TERMS] slow rows of the fast bodies there */
    double *jump;  /* [ns x JUMP_TERMS] jump of the force on the fast coordinates, and of its two differences */
};

enum { COARSE_POINTS = 3 };

/* subcycle_coarse.c: sweeps that evaluate only a few minor steps. */
struct coarse {
    bool on;             /* the sweep under way is one */
    bool varied;         /* slopes of a minor step have changed in this major step */
    bool powered;        /* power flows in minor steps */
    int rest;            /* major steps for which none will be tried */
    double missed;       /* share of the steps in which one did not suffice, exponentially averaged */
    double whole;        /* share of the steps without one in which two whole sweeps did not suffice, likewise */
    struct nodes *nodes; /* the minor steps that are evaluated */
    double *rows;        /* [ml x ratio] slow rows of the fast bodies in all minor steps, after the last whole sweep */
    double *sum;         /* [ml] H times their mean */
    double *left;        /* [ns x COARSE_POINTS] residual of the fast rows, as coefficients of powers of f_k */
};

/* subcycle_resolve.c: each fast coordinate by itself, while the others recoil freely. */
struct resolve {
    double *M;      /* [ns x ns] scratch: Cholesky factor of M~_SS */
    double *own;    /* [ns] its inertia 1/(M~_SS^-1)_ii */
    double *square; /* [ns] its frequency squared, (M~_SS^-1 K_SS)_ii [rad^2/s^2] */
};

struct subcycle {
    const struct ode2 *ode;
    struct effort *effort;
    int n, ns, nl;          /* coordinates; fast, slow ones of these */
    int near;               /* slow coordinates that the minor steps move */
    double alpha;           /* damping of high frequencies (S7) */
    struct implicit *plain; /* the midpoint rule, where there are no fast coordinates */
    struct newton newton;
    struct decouple dec;
    struct response resp; /* of slopes that stay frozen from step to step while the iteration contracts */
    struct minor here;    /* J of a minor step whose slopes have changed */
    int local;            /* it is in use */
    struct forecast forecast;
    int guessed;       /* d_k are still the forecast's */
    double last_local; /* local error of the last step; negative: unknown */
    struct subcycle_error *error;
    bool looked; /* is the local error of the step under way measured? */
    struct last_step last;
    struct coarse coarse;
    struct resolve resolve;

    /* The major step under way. */
    int ratio;
    double h, H, t0, t1;        /* minor, major step; start, end [s] */
    const double *q0, *v0, *a0; /* state at its start */
    struct instant centre;      /* where W is formed */
    double *qcentre;            /* [nq] its position where that is not the start of the step */
    bool follows, again;        /* it is moved between sweeps; the step is solved twice */

    /* The unknowns, from sweep to sweep. */
    int capacity;        /* minor steps that d has room for */
    double *d, *dbefore; /* [ns x ratio] d_k; before the sweep */
    double *du, *u0, *w; /* [nl] of (S1), (S2) */

    /* On the way through the minor steps. */
    double *vs, *xn, *xbefore; /* [ns] v_S,k and x_k, after the last v_S,n and x_n; x_n before the sweep */
    double *q, *qmid, *qend;   /* [nq] q_k, q_k+1/2, q_k+1 */
    double *qnext;             /* [nq] q_k+1 when d_k has been corrected */
    bool outright;             /* the middles are found from q0, by their whole displacement */
    bool direct;               /* so they are where loops are closed, which is done there only */
    bool passes;               /* somebody asks for q_k */
    double *xmid;              /* [ns] x_k + dx_k/2 */
    double *none;              /* [n] zeros */
    double *v, *a;             /* [n] v_k, a_k; of the slow rows the near ones */
    double *dx;                /* [ns] dx_k */
    double *es;                /* [ns] residual r_k,S of the fast rows, then the correction of d_k */
    double *rest;              /* [ns] r_k,S */
    double *esum;              /* [ns] sum of these corrections */
    double *sum;               /* [n] sizes of the corrections of a sweep */

    /* The end of the step, and the slow bodies. */
    double *qn;                 /* [nq] q_n */
    bool ended;                 /* it has been found in this step, for these unknowns or earlier ones */
    bool halved, ajar;          /* so has qbar, directly; its loops were left open */
    double *qbar, *vbar, *abar; /* [nq], [n], [n] mean position, velocity, acceleration of (S5) */
    double *pull;               /* [near] du/H */
    double *slow;               /* [nl] slow rows of r_s */
    double *cs;                 /* [ns] part of r_s in the fast rows of every minor step */
    double *dsum;               /* [ns] sum of the d_k that r_s is for, less those found since */
    double *dmean;              /* [ns] its mean, as it was for r_s */
    double *R, *Du;             /* [nl] slow rows (S8), the correction of du */
    double *moved;              /* [ns x 2] effect of that correction on the fast rows: constant, linear in f_k */

    double *r;                   /* [n] of the last evaluation */
    double *dq;                  /* [n] a displacement */
    double *s1, *s2, *s3;        /* [ns] scratch */
    double work[POWER_CHANNELS]; /* by the sweep [J] */
    double push, square;         /* power of the residual [W]; energy of the correction */
};

/* --- matrices ----------------------------------------------------------------------------------- */

/* W, P and u0 at q (S1); others: as decouple_at() has it. */
enum status subcycle_decouple(struct subcycle *c, const double *q, double t, enum others others, struct trouble *why);
/* Are all matrices due at the start of the step? */
bool subcycle_refresh_due(const struct subcycle *c);
/* All matrices at the start of the step. */
enum status subcycle_refresh(struct subcycle *c, struct trouble *why);
/* The same for the masses as they are now, with slopes and their answers as they were frozen. */
enum status subcycle_renew(struct subcycle *c, struct trouble *why);
/* The same of the fast rows alone. */
enum status subcycle_renew_fast(struct subcycle *c, struct trouble *why);
/* J at x, for a minor step whose slopes are no longer the frozen ones. */
enum status subcycle_refresh_here(struct subcycle *c, const struct instant *x, struct trouble *why);

/* W and u0 where the step that begins wants them; fresh: nothing is known of the past. */
enum status subcycle_centre(struct subcycle *c, const struct step_options *options, bool fresh, struct trouble *why);
/* The same between sweeps, after subcycle_compose(), where that is due: was it moved? */
enum status subcycle_follow(struct subcycle *c, bool *moved, struct trouble *why);
/* And after the last sweep: the step is to be solved once more. */
enum status subcycle_centre_again(struct subcycle *c, struct trouble *why);

/* --- where du and d_k lead ---------------------------------------------------------------------- */

/* v_k,S = dx_k/h of d_k from v_S (S3). */
void subcycle_fast_velocity(struct subcycle *c, const double *d);
/* v_k = P (w, dx_k/h) (S4), of the coordinates that the minor steps move. */
void subcycle_velocity(struct subcycle *c, const double *d);
/* x1 = x0 (+) s h v_k, at time t, of the coordinates that the minor steps move. */
void subcycle_point(struct subcycle *c, double *x1, const double *x0, double s, double t);
/* The same where x1 holds a position nearby, from which loops are closed; x1 is not x0.  open: as onward() of ode2_move has
 * it. */
void subcycle_onward(struct subcycle *c, double *x1, const double *x0, double s, double t, int open);
/* v_k and a_k of d_k (S4), and qmid := the point at time t, half-way through minor step k. */
void subcycle_half_way(struct subcycle *c, const double *d, int k, double t);
/* q_k, after the minor steps that have led to x_k = c->xn, directly from q0: where motion_point() is additive (ode2's
 * `straight`). */
void subcycle_place(struct subcycle *c, int k);
/* v_k,S of d_k, and x_n, v_S after it (S3). */
void subcycle_advance(struct subcycle *c, const double *d);
/* When minor step k ends. */
static inline double subcycle_minor_end(const struct subcycle *c, int k)
{
    return k + 1 < c->ratio ? c->t0 + (k + 1) * c->h : c->t1;
}
/* w, x_n, v_S at the end, the sum of the d_k, and q_n if it is needed. */
void subcycle_compose(struct subcycle *c);
/* q_n, after subcycle_compose(). */
void subcycle_end(struct subcycle *c);
/* dq = q_n (-) q_0 and qbar, half-way, after subcycle_compose(); returns its time [s]. */
double subcycle_middle(struct subcycle *c);

/* --- a sweep ------------------------------------------------------------------------------------ */

/* r_s at du and d_k as they are composed (S5). */
enum status subcycle_slow_bodies(struct subcycle *c, struct trouble *why);
/* All minor steps: every d_k corrected (S6); R: part of the fast bodies in the slow rows. */
enum status subcycle_fast_rows(struct subcycle *c, struct trouble *why);
/* es: the fast rows (S6) of minor step k at the trial point of its d_k, x; c->r its fast bodies' share. */
enum status subcycle_minor_rows(struct subcycle *c, int k, double *power, double *dk, struct instant *x,
                                struct trouble *why);
/* Back to the start of the major step, before the minor ones are gone through. */
void subcycle_rewind(struct subcycle *c);
/* Half-way through minor steps, but for the times; those of minor step k. */
struct instant subcycle_half(const struct subcycle *c);
void subcycle_minor_time(const struct subcycle *c, struct instant *x, int k);

/* --- coarse sweeps ------------------------------------------------------------------------------ */

void subcycle_coarse_open(struct subcycle *c, struct arena *life);
/* Before a step: decides whether a coarse sweep will be tried after its first one. */
void subcycle_coarse_plan(struct subcycle *c);
/* Will the next sweep of the step under way be coarse, if nothing in it forbids that? */
bool subcycle_coarse_next(const struct subcycle *c);
/* May the second sweep be one, and without the first minor step? */
bool subcycle_coarse_blind(const struct subcycle *c);
/* Keeps the slow rows of minor step k, as they are after its correction c->es, where they will be needed. */
void subcycle_coarse_keep(struct subcycle *c, int k);
/* The same of their sum, which is in R, after all minor steps. */
void subcycle_coarse_kept(struct subcycle *c);
/* As subcycle_fast_rows(), but evaluates a few minor steps only: the change of their rows since the last whole sweep is
 * interpolated for the others, and the residual of the fast rows left in c->coarse.left. */
enum status subcycle_coarse_rows(struct subcycle *c, struct trouble *why);
void subcycle_coarse_recall(struct subcycle *c, struct recall *r);

/* --- its end --------------------------------------------------------------------------------------- */

/* x at the end of the step found; E_NUMERIC: that is no state of the system. */
enum status subcycle_accept(struct subcycle *c, struct stepper *s, struct state *x, struct trouble *why);

void subcycle_resolve_open(struct subcycle *c, struct arena *life);
/* Inertia and frequency of each fast coordinate, whenever J is formed. */
void subcycle_resolve_refresh(struct subcycle *c);
void subcycle_resolve_recall(struct subcycle *c, struct recall *r);
/* s->unresolved: the vibration of largest energy so far that the minor steps do not resolve, with the step just
 * found. */
void subcycle_resolve(const struct subcycle *c, struct stepper *s);

/* --- from step to step -------------------------------------------------------------------------- */

void subcycle_last_open(struct subcycle *c, struct arena *life);
/* c->last := the step just found. */
void subcycle_last_keep(struct subcycle *c);
/* After the first subcycle_slow_bodies() of a step: the jump of the force on the fast coordinates and of its two
 * differences [ns x JUMP_TERMS]; NULL: not known. */
const double *subcycle_jump(struct subcycle *c);
void subcycle_last_recall(struct subcycle *c, struct recall *r);

/* R complete (S8); du corrected by it (S12), and all d_k with it. */
void subcycle_slow_rows(struct subcycle *c);

/* --- the local error of a step (slots error, error_end, keep of struct stepper_kind) --------------- */

void subcycle_error_open(struct subcycle *c, struct arena *life);
/* Is the local error of the step that begins to be measured?  With a tolerance always; with fixed steps in bursts of
 * three, now and then (engine/missed.h). */
bool subcycle_error_looks(struct stepper *s);
/* After a step that was measured: with fixed steps its error goes into the sums of missed.h. */
void subcycle_error_note(struct stepper *s, bool taken);
/* Measures the step found; c->dsum holds the sum of its d_k.  fixed: for the sums of missed.h, not for the choice of
 * steps. */
void subcycle_error_measure(struct subcycle *c, bool fixed);
/* The same of a step without fast coordinates: dv [n] its change of velocities, a0 [n] the accelerations at its
 * start. */
void subcycle_error_single(struct subcycle *c, const double *dv, const double *a0);
struct step_error subcycle_error(struct stepper *s);
void subcycle_error_end(struct stepper *s, const double *a);
void subcycle_error_keep(struct stepper *s, bool taken);
void subcycle_error_recall(struct subcycle *c, struct recall *r);
void subcycle_coupling_open(struct subcycle *c, struct arena *life);
/* Adds (S15) of the step found to the errors of its fast coordinates. */
void subcycle_coupling_measure(struct subcycle *c);
/* The step was taken. */
void subcycle_coupling_keep(struct subcycle *c);
/* A major step of one minor step after one of several: before it, c->error->minor is set to the accelerations that
 * its start should have. */
void subcycle_coupling_before(struct subcycle *c);
/* And at its end c->error->more to the difference of the accelerations a [n] there from those extrapolated. */
void subcycle_coupling_end(struct subcycle *c, const double *a);
void subcycle_coupling_recall(struct subcycle *c, struct recall *r);

/* What has been evaluated beyond these counts was for that. */
static inline void subcycle_spent(struct subcycle *c, enum spent_on what, long slow, long fast)
{
    struct spent *o = &c->effort->spent[what];
    o->times++;
    o->slow += c->effort->slow - slow;
    o->fast += c->effort->fast - fast;
}

/* Work by channel of the power w over `time`; is there any? */
static inline bool subcycle_book(struct subcycle *c, double time, const double *w)
{
    if (!(w[POWER_EXTERNAL] != 0 || w[POWER_DRIVE] != 0 || w[POWER_DAMPER] != 0 || w[POWER_FRICTION] != 0))
        return false;
    for (int i = 0; i < POWER_CHANNELS; i++) {
        c->work[i] += time * w[i];
        c->newton.powered |= w[i] != 0;
        c->newton.flow += fabs(time * w[i]);
    }
    return true;
}

#endif
