/* touch.h -- rigid contacts in steps of the implicit midpoint rule.
 *
 * Between impacts a contact is open or closed.  A step in which some are closed solves, for its velocities at the end v1
 * and impulses p,
 *
 *     M (v1 - v0) - h Q = Gn~' p_n + Gt' p_t,
 *     0 <= g(q1), p_n >= 0, one of them 0;   u_t(q1, v1) = 0 where |p_t| < mu p_n, else p_t = -mu p_n u_t/|u_t|
 *
 * at the middle, with Gn~ = Gn + c dq' such that Gn~ dq = g1 - g0 (Gonzalez, J. Nonlinear Sci. 6 (1996) 449): a contact
 * that stays closed does no work and does not drift; what sticks does not creep.  Then what is left of the velocity along
 * the rows that push is taken away, a loss of third order in h that is booked as an impact's.
 *
 * An open contact whose gap turns negative cuts the step where it is 0.  There is the impact: all contacts that touch, by
 * Newton's restitution on speeds of approach, with friction in the cone of the impulses.  Where the next flight would be
 * shorter than the step, restitution is 0 and the contact closes, so that bounces end.  With steps by tolerance that is
 * where it would leave with a tenth of the tolerance of the largest velocity, and no higher than that of a usual gap. */
#ifndef FMDSUB_ENGINE_TOUCH_H
#define FMDSUB_ENGINE_TOUCH_H

#include "base/arena.h"
#include "base/recall.h"
#include "engine/stepper.h"

enum touching { TOUCH_OPEN, TOUCH_SLIDES, TOUCH_STICKS };

enum touch_what { TOUCH_IMPACT, TOUCH_CLOSES, TOUCH_OPENS, TOUCH_STARTS_STICKING, TOUCH_STARTS_SLIDING };
struct touch_event {
    enum touch_what what;
    int contact;
    double t;
    double before, after; /* of an impact: rates of the gap */
    double impulse, loss; /* along the gap; of all of the impact [J] */
};

/* One contact, for records. */
struct touch_state {
    enum touching state;
    double force[3]; /* [1 + across] mean over the last step [N] or [N m] */
    double impulse;  /* along the gap since the start [N s] or [N m s] */
    long impacts;    /* likewise */
};

struct touch;

struct touch *touch_open(struct stepper *s, struct arena *life);

/* Where the run stands at the start, to go on with steps of about h: which contacts are closed.  A gap below 0: *overlap
 * is the deepest, of the contact *deepest; -1: none. */
enum status touch_begin(struct touch *o, int *deepest, double *overlap, const struct state *x, double h,
                        struct trouble *why);

/* As kind->step() of a scheme of one rate. */
enum status touch_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why);

/* The same for steps that are chosen by their error.  What happens where the run starts, once: an impact, *struck.  Then x
 * goes on from its t towards t1 by a step h, and ends where the first gap closes or friction changes: a smooth motion, whose
 * error can be told.  Where friction changes right at its start, *turned, x stays there, and goes on next time; *cuts: from
 * 0, how often friction has changed in trials from here.  E_NUMERIC: x as it was.  If that is to be kept, what happens
 * there: an impact, contacts that open, stick or slide, *changed; then x->a are accelerations behind it.  Or all goes back
 * to where that part began. */
enum status touch_first(struct touch *o, bool *struck, struct state *x, struct trouble *why);
enum status touch_part(struct touch *o, bool *turned, struct state *x, int *cuts, double h, double t1,
                       struct trouble *why);
enum status touch_meet(struct touch *o, bool *changed, struct state *x, struct trouble *why);
void touch_back(struct touch *o, struct state *x);

/* For steps of two rates: are all contacts open, and so far that none can close in a time H?  And at its end, x: were they?
 * Else touch_back(). */
enum status touch_far(struct touch *o, bool *far, const struct state *x, double H, struct trouble *why);
enum status touch_was_far(struct touch *o, bool *far, const struct state *x, double H, struct trouble *why);

/* What round-off of the gaps of the contacts that were closed last makes of velocities in a step h, friction of them along the
 * surface by its coefficient. */
double touch_noise(const struct touch *o, double h);

/* x->a := accelerations at x, with the forces of closed contacts. */
enum status touch_accelerations(struct touch *o, struct state *x, struct trouble *why);

/* Where drives move everything (n = 0): nothing may be pushed into anything; what rubs is shown as it is at x.
 * w [POWER_CHANNELS] += the powers [W] of what rubs at x and of the drives against it.  E_NUMERIC: there are no such
 * forces, as of a mechanism that its friction wedges. */
enum status touch_driven(struct touch *o, const struct state *x, struct trouble *why);
enum status touch_driven_power(struct touch *o, double *w, const struct state *x, struct trouble *why);
const struct touch_state *touch_state(const struct touch *o, int contact);
/* Forces [rows] of closed contacts at x itself, for accelerations there. */
enum status touch_forces(struct touch *o, double *f, const struct state *x, struct trouble *why);
/* What has happened since touch_clear(). */
int touch_events(const struct touch *o, const struct touch_event **list);
void touch_clear(struct touch *o);
long touch_impacts(const struct touch *o);
/* Those whose restitution was lowered, since with friction it would have gained energy. */
long touch_lowered(const struct touch *o);
/* Has any contact pushed since the start? */
bool touch_pushed(const struct touch *o);
/* Has friction of joints, and nothing else? */
bool touch_rubs(const struct touch *o);

void touch_recall(struct touch *o, struct recall *r);

#endif
