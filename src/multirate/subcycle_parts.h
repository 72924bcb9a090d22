/* subcycle_parts.h -- what the files of sub-cycling share; the scheme and its equations are in subcycle.c.
 *
 *     subcycle.c         a major step: opened, iterated, accepted
 *     subcycle_accept.c  what is done with the one that was found: its end (S9), its energy, what is kept of it
 *     subcycle_matrix.c  what is formed at its start: W and u0 (S1), damping (S7), J (S11), the slow rows' matrix (S12)
 *     subcycle_point.c   where the unknowns lead: velocities and positions of minor steps (S2)-(S4), the end (S9)
 *     subcycle_fast.c    the minor steps of a sweep: r_k (S6), d_k corrected
 *     subcycle_coarse.c  the same where a few minor steps stand for all
 *     subcycle_jump.c    what is known of how forces jump from one major step to the next
 *     subcycle_slow.c    slow bodies (S5), slow rows R (S8), du corrected and all d_k with it
 *     decouple.h         W and P (S1)
 *     response.h         the minor steps' linearized answer to the slow unknown (S11), (S12)
 *     forecast.h         where the iteration begins
 *     subcycle_resolve.c do the minor steps resolve what vibrates in them?
 *     subcycle_error.c   what a step is off by, where steps go by a tolerance
 *     subcycle_coupling.c  what of that the fast coordinates have from the slow ones' straight line (S13)-(S15)
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

struct subcycle_coupling {
    double *tail, *rate,
        *s; /* [ns] accelerations, and their rates, that the minor steps of the last major one lead on to; how
                              * far its last ones were too small (S13) */
    double *new_tail, *new_rate, *new_s;
    int terms, new_terms;        /* minor steps that they had; 0: not known */
    double *x, *p, *dx, *dv;     /* [ns] scratch */
    double *stiff;               /* [ns x ns] */
    double *position, *velocity; /* [ns] what fast coordinates are off by for it */
};

struct subcycle_error {
    struct local_error slow, fast; /* of the last step that was taken: of v, of x */
    struct local_error minor;      /* of x, on the way through the minor steps */
    double *position, *velocity;   /* [n] sizes: of the last step */
    double *swing, *new_swing; /* [nl] of u' at the end of major steps, from what their means lead on to: the largest */
    double *more, *whole;      /* [ns], [n] scratch */
    struct subcycle_coupling coupling;
};

enum { JUMP_TERMS = 3 };

/* What the major step before was in, and what of it the fast rows saw last. */
struct last_step {
    double h;      /* its minor step; 0: there is none */
    double *W;     /* [nl x ns] */
    double *Mss;   /* [ns x ns] */
    double *share; /* [ns] of its slow bodies in the fast rows, whatever d_k is */
    double *x, *y; /* [ns], [nl] x_n and H w */
    int terms;     /* minor steps of which the next two are known */
    double *a;     /* [ns x JUMP_TERMS] accelerations of its minor steps, from the last one back */
    double *rows;  /* [ml x JUMP_TERMS] slow rows of the fast bodies there */
    double *jump;  /* [ns x JUMP_TERMS] what all that changes in the force on the fast ones, and in its differences */
};

enum { COARSE_POINTS = 3 };

/* Sweeps in which a few minor steps stand for all. */
struct coarse {
    bool on;       /* the sweep under way is one */
    bool varied;   /* slopes of a minor step have changed in this major step */
    int rest;      /* steps in which none will be tried */
    double missed; /* share of the steps in which one has not been enough, older ones fading */
    double whole;  /* and of those without one in which two whole ones have not been */
    double *rows;  /* [ml x ratio] slow rows of the fast bodies in all minor steps, as the last whole sweep left them */
    double *left;  /* [ns x COARSE_POINTS] what is left in the fast rows: of powers of f_k */
};

/* Of the fast coordinates, each by itself while the others recoil. */
struct resolve {
    double *M;            /* [ns x ns] factored: scratch */
    double *own, *square; /* [ns] inertia; square of the frequency [rad^2/s^2] */
};

struct subcycle {
    const struct ode2 *ode;
    struct effort *effort;
    struct implicit *plain; /* the midpoint rule: without fast coordinates */
    struct newton newton;
    struct decouple dec;
    struct response resp; /* frozen */
    struct minor here;    /* J of a minor step whose slopes have changed */
    int local;            /* it is in use */
    struct forecast forecast;
    int guessed;       /* d_k are the forecast's */
    double last_local; /* local error of the last step; negative: unknown */
    struct subcycle_error *error;
    bool looked; /* is the step under way measured? */
    int n, ns, nl;
    int near;     /* slow coordinates that the minor steps move */
    double alpha; /* (S7) */

    /* of the major step under way */
    int ratio;
    double h, H, t0, t1;
    const double *q0, *v0, *a0;
    struct instant centre; /* where W stands */

    /* unknowns, from sweep to sweep */
    int capacity;                /* minor steps that d has room for */
    double *d, *dbefore;         /* [ns x ratio] d_k; before the sweep */
    double *du, *u0, *w;         /* [nl] */
    double *vs, *xn, *xbefore;   /* [ns] v_S,k and x_k on the way, at its end v_S,n and x_n; x_n before the sweep */
    double *q, *qmid, *qend;     /* [nq] q_k, q_k+1/2, q_k+1 of the minor step under way */
    double *qnext;               /* [nq] q_k+1 when d_k has been corrected */
    double *qn;                  /* [nq] q_n */
    bool ended;                  /* it has been found in this step, for this or other unknowns */
    double *v, *a;               /* [n] v_k, a_k; near slow rows */
    double *qbar, *vbar, *abar;  /* [nq], [n], [n] where the slow bodies are asked */
    double *pull;                /* [near] du/H */
    double *slow;                /* [nl] slow rows of r_s */
    double *cs;                  /* [ns] what r_s brings to the fast rows of every minor step */
    double *dsum, *dmean, *esum; /* [ns] sum of d_k when the slow bodies were asked, less those found since; its mean;
                                  * sum of corrections */
    double *r;                   /* [n] of the last evaluation */
    double *es, *rest;           /* [ns] r_k,S, then the correction of d_k; r_k,S */
    double *R, *Du;              /* [nl] slow rows, the correction of du */
    struct last_step last;
    struct coarse coarse;
    struct resolve resolve;
    double *c, *g;               /* [ns] what it means for the fast rows: constant, linear in k */
    double *dq;                  /* [n] displacement */
    double *sum;                 /* [n] size of the corrections of a sweep */
    double *dx;                  /* [ns] dx_k */
    double *s1, *s2, *s3;        /* [ns] scratch */
    double work[POWER_CHANNELS]; /* of the sweep */
    double push, square;         /* power of what is left, energy of the correction */
};

/* --- matrices ----------------------------------------------------------------------------------- */

/* W, P and u0 at q (S1). */
enum status subcycle_decouple(struct subcycle *c, const double *q, double t, struct trouble *why);
/* All matrices at the start of the step. */
enum status subcycle_refresh(struct subcycle *c, struct trouble *why);
/* The same for the masses as they are now, with slopes and their answers as they were frozen. */
enum status subcycle_renew(struct subcycle *c, struct trouble *why);
/* J at x, for a minor step whose slopes are no longer the frozen ones. */
enum status subcycle_refresh_here(struct subcycle *c, const struct instant *x, struct trouble *why);

/* --- where du and d_k lead ---------------------------------------------------------------------- */

/* v_k,S = dx_k/h of d_k from v_S (S3). */
void subcycle_fast_velocity(struct subcycle *c, const double *d);
/* v_k = P (w, dx_k/h) (S4), as far as the minor steps move. */
void subcycle_velocity(struct subcycle *c, const double *d);
/* x1 = x0 (+) s h v_k, at time t, as far as the minor steps move. */
void subcycle_point(struct subcycle *c, double *x1, const double *x0, double s, double t);
/* The same where x1 holds a posture nearby; it is not x0. */
void subcycle_onward(struct subcycle *c, double *x1, const double *x0, double s, double t);
/* q after k minor steps that have led to x_k = c->xn, in one go: of motion that is `straight`. */
void subcycle_place(struct subcycle *c, double *q, int k);
/* x_n, v_S after d_k at v_k (S3). */
void subcycle_advance(struct subcycle *c, const double *d);
/* When minor step k ends. */
double subcycle_minor_end(const struct subcycle *c, int k);
/* w, x_n, v_S at the end, q_n, and the sum of the d_k. */
void subcycle_compose(struct subcycle *c);
/* dq = q_n (-) q_0, qbar half-way; its time. */
double subcycle_middle(struct subcycle *c);

/* --- a sweep ------------------------------------------------------------------------------------ */

/* r_s at du and d_k as they are composed (S5). */
enum status subcycle_slow_bodies(struct subcycle *c, struct trouble *why);
/* All minor steps: every d_k corrected (S6); R: what the fast bodies bring to the slow rows. */
enum status subcycle_fast_rows(struct subcycle *c, struct trouble *why);
/* es: the fast rows (S6) of a minor step at the trial point of d, x; c->r its fast bodies' share. */
enum status subcycle_minor_rows(struct subcycle *c, const double *d, double *power, double *dk, struct instant *x,
                                struct trouble *why);
/* Before the minor steps: at the start of the major one. */
void subcycle_rewind(struct subcycle *c);
/* Times of minor step k. */
void subcycle_minor_time(const struct subcycle *c, struct instant *x, int k);

/* --- coarse sweeps ------------------------------------------------------------------------------ */

void subcycle_coarse_open(struct subcycle *c, struct arena *life);
/* Before a step: whether one will be tried after its first sweep. */
void subcycle_coarse_plan(struct subcycle *c);
/* Will the next sweep of the step under way be one, if nothing in it forbids that? */
bool subcycle_coarse_next(const struct subcycle *c);
/* The slow rows of minor step k are kept, where somebody will ask for them, as they are after its correction c->es. */
void subcycle_coarse_keep(struct subcycle *c, int k);
/* As subcycle_fast_rows(), from a few minor steps: how their rows have changed since the last whole sweep is
 * interpolated; what they leave of the fast rows is c, g. */
enum status subcycle_coarse_rows(struct subcycle *c, struct trouble *why);
void subcycle_coarse_recall(struct subcycle *c, struct recall *r);

/* --- its end --------------------------------------------------------------------------------------- */

/* x at the end of the step found; E_NUMERIC: that is no state of the system. */
enum status subcycle_accept(struct subcycle *c, struct stepper *s, struct state *x, struct trouble *why);

void subcycle_resolve_open(struct subcycle *c, struct arena *life);
/* With J. */
void subcycle_resolve_refresh(struct subcycle *c);
void subcycle_resolve_recall(struct subcycle *c, struct recall *r);
/* What of the motion of the step found its minor steps are too long for, so far. */
void subcycle_resolve(const struct subcycle *c, struct stepper *s);

/* --- from step to step -------------------------------------------------------------------------- */

void subcycle_last_open(struct subcycle *c, struct arena *life);
/* A step that is taken, after its sweeps. */
void subcycle_last_keep(struct subcycle *c);
/* After the first slow bodies of a step: the jump of the force and of its two differences [ns x JUMP_TERMS]; NULL: not
 * known. */
const double *subcycle_jump(struct subcycle *c);
void subcycle_last_recall(struct subcycle *c, struct recall *r);

/* R complete (S8); du corrected by it (S12), and all d_k with it. */
void subcycle_slow_rows(struct subcycle *c);

/* --- what the step is off by: slots and parts of the stepper's ------------------------------------ */

void subcycle_error_open(struct subcycle *c, struct arena *life);
/* Is the step that begins to be measured?  Those of a tolerance all; of fixed ones three behind one another now and then. */
bool subcycle_error_looks(struct stepper *s);
/* It was, and is told where nobody else asks for it. */
void subcycle_error_note(struct stepper *s, bool taken);
/* Of the step found, c->dsum its sum of d_k; of one of a single rate, dv [n] its change of velocities, a0 [n] the
 * accelerations at its start.  fixed: for the sums of engine/missed.h, not for the choice of steps. */
void subcycle_error_measure(struct subcycle *c, bool fixed);
void subcycle_error_single(struct subcycle *c, const double *dv, const double *a0);
struct step_error subcycle_error(struct stepper *s);
void subcycle_error_end(struct stepper *s, const double *a);
void subcycle_error_keep(struct stepper *s, bool taken);
void subcycle_error_recall(struct subcycle *c, struct recall *r);
void subcycle_coupling_open(struct subcycle *c, struct arena *life);
/* Of the step found, added to what its fast coordinates are off by; the step was taken. */
void subcycle_coupling_measure(struct subcycle *c);
void subcycle_coupling_keep(struct subcycle *c);
/* Before a single minor step behind several: e->minor is what the accelerations at its start should be. */
void subcycle_coupling_before(struct subcycle *c);
/* At its end e->more is how far accelerations a are from what theirs lead on to. */
void subcycle_coupling_end(struct subcycle *c, const double *a);
void subcycle_coupling_recall(struct subcycle *c, struct recall *r);

/* Work by channel of the power w over `time`. */
static inline void subcycle_book(struct subcycle *c, double time, const double *w)
{
    if (!(w[POWER_EXTERNAL] != 0 || w[POWER_DRIVE] != 0 || w[POWER_DAMPER] != 0 || w[POWER_FRICTION] != 0)) return;
    for (int i = 0; i < POWER_CHANNELS; i++) {
        c->work[i] += time * w[i];
        c->newton.powered |= w[i] != 0;
        c->newton.flow += fabs(time * w[i]);
    }
}

#endif
