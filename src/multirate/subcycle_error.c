/* subcycle_error.c -- the local error of a major step of sub-cycling, of each class in its decoupled variables: of
 * the slow velocities u over the major step, of the fast coordinates from the d_k of the minor steps, summed;
 * engine/local_error.h.
 *
 * u = v_L + W v_S, with the W of the step.  In earlier steps W was another, which would make u' jump by dW a_S.  So
 * the mean accelerations of v_L and v_S are remembered apart, and the W of the present step makes u' of their
 * differences. */
#include <math.h>

#include "base/scalar.h"
#include "engine/missed.h"
#include "engine/stepped.h"
#include "multirate/subcycle_parts.h"

void subcycle_error_open(struct subcycle *c, struct arena *life)
{
    struct subcycle_error *e = c->error = TAKE(life, struct subcycle_error, 1);
    local_error_open(&e->slow, c->n, life);
    local_error_open(&e->fast, c->ns, life);
    local_error_open(&e->minor, c->ns, life);
    e->position = TAKE(life, double, c->n);
    e->velocity = TAKE(life, double, c->n);
    e->swing = TAKE(life, double, c->nl);
    e->new_swing = TAKE(life, double, c->nl);
    e->more = TAKE(life, double, c->ns);
    e->whole = TAKE(life, double, c->n);
    e->a = TAKE(life, double, c->n);
    e->bend = TAKE(life, double, c->n);
    subcycle_coupling_open(c, life);
}

/* u [nl] of velocities or accelerations x [n], by the W of this step. */
static void on_base(const struct subcycle *c, double *u, const double *x)
{
    copy(u, x + c->ns, c->nl);
    decouple_recoil(&c->dec, u, 1, x);
}

static void measure_slow(struct subcycle *c, const double *dv, const double *a0)
{
    struct subcycle_error *e = c->error;
    local_error_try(&e->slow, dv, a0, c->H, stepped_late(NULL));
    on_base(c, e->position + c->ns, e->slow.position);
    on_base(c, e->velocity + c->ns, e->slow.velocity);
    for (int i = c->ns; i < c->n; i++) {
        e->position[i] = fabs(e->position[i]);
        e->velocity[i] = fabs(e->velocity[i]);
    }
}

/* Two minor steps alone do not show a change of the third derivative: it is taken from the last ones of the step
 * before. */
static void measure_pair(struct subcycle *c)
{
    struct subcycle_error *e = c->error;
    const double off = 2 * stepped_late(NULL) * c->h * c->h * c->h / (c->h + e->fast.h);
    for (int i = 0; i < c->ns && e->fast.known > 1; i++)
        e->velocity[i] = off * fabs(e->minor.jerk[i] - e->fast.jerk[i]);
}

/* Where there are several minor steps, from those of this major step alone, since d_k jumps at its start. */
static void measure_fast(struct subcycle *c)
{
    struct subcycle_error *e = c->error;
    const int n = c->ratio, first = n > 1 ? 1 : 0, second = n > 1 ? 2 : 0;
    local_error_copy(&e->minor, &e->fast);
    if (n > 1) local_error_forget(&e->minor);
    if (n == 1) subcycle_coupling_before(c);
    zero(e->position, c->ns);
    zero(e->velocity, c->ns);
    for (int k = 0; k < n; k++) {
        local_error_try(&e->minor, c->d + (long)k * c->ns, c->a0, c->h, stepped_late(NULL));
        local_error_keep(&e->minor, c->h);
        for (int i = 0; i < c->ns; i++) {
            if (k >= first) e->position[i] += fabs(e->minor.position[i]) * n / (n - first);
            if (k >= second) e->velocity[i] += fabs(e->minor.velocity[i]) * n / (n - second);
        }
    }
    if (n == 2) measure_pair(c);
}

/* The time by which the slow coordinates are late in this step. */
static double lag(const struct subcycle *c)
{
    double off = 0, fastest = 0;
    for (int i = 0; i < c->nl; i++) {
        off = larger(off, c->error->position[c->ns + i]);
        fastest = larger(fastest, fabs(c->u0[i]));
    }
    return fastest > 0 ? off / fastest : 0;
}

/* Fast coordinates that follow the slow ones are late by as much: it shifts their displacement in the whole step.
 * Used for the sums over a run, where (S15) would be too much: errors of stiff coordinates that follow a slow motion
 * do not add up. */
static void follow(struct subcycle *c)
{
    struct subcycle_error *e = c->error;
    const double late = lag(c);
    const int n = c->ratio;
    for (int i = 0; i < c->ns && n > 1; i++) {
        double mean = c->v0[i], change = 0;
        for (int k = 0; k < n; k++) {
            mean += (1 - (k + .5) / n) * c->d[(long)k * c->ns + i];
            change += c->d[(long)k * c->ns + i];
        }
        e->position[i] += late * fabs(mean);
        e->velocity[i] += late * fabs(change) / c->H;
    }
}

/* What straight ways miss of rotations, those of slow ones of major steps. */
static void measure_bend(struct subcycle *c, const double *dv)
{
    struct subcycle_error *e = c->error;
    const double slow = c->H * c->H * c->H * stepped_late(NULL), fast = slow / ((double)c->ratio * c->ratio);
    for (int i = 0; i < c->n; i++) e->a[i] = dv[i] / c->H;
    if (!motion_bend(c->ode, e->bend, c->v0, e->a, 2)) return;
    for (int i = 0; i < c->n; i++) e->position[i] += (i < c->ns ? fast : slow) * fabs(e->bend[i]);
}

void subcycle_error_measure(struct subcycle *c, bool fixed)
{
    decouple_out(&c->dec, c->error->whole, c->du, c->dsum, c->nl);
    measure_slow(c, c->error->whole, c->a0);
    measure_fast(c);
    measure_bend(c, c->error->whole);
    if (fixed)
        follow(c);
    else if (c->ns > 0)
        subcycle_coupling_measure(c);
}

void subcycle_error_single(struct subcycle *c, const double *dv, const double *a0)
{
    measure_slow(c, dv, a0);
    measure_bend(c, dv);
}

/* Has u' of slow coordinate i jumped at the end of the step by more than ever before?  Fast vibrations act on the slow
 * coordinates all the time; only their mean counts. */
static bool sudden(const struct subcycle *c, int i)
{
    enum { TIMES = 4 };
    const struct subcycle_error *e = c->error;
    return c->ns == 0 || (e->slow.known && fabs(e->new_swing[i]) > TIMES * e->swing[i]);
}

/* Largest mean acceleration of fast coordinate i in the minor steps. */
static double largest_mean(const struct subcycle *c, int i)
{
    double most = 0;
    for (int k = 0; k < c->ratio; k++) most = larger(most, fabs(c->d[(long)k * c->ns + i]));
    return most / c->h;
}

/* At the end of a major step the mean slow acceleration jumps, and with it those of the fast coordinates, by s
 * (S13).  A jump beyond that, and larger than any mean acceleration in this step, comes from a force that set in
 * during the last minor step. */
void subcycle_error_end(struct stepper *s, const double *a)
{
    struct subcycle *c = s->self;
    struct subcycle_error *e = c->error;
    local_error_end(&e->slow, e->whole, false, a, c->H);
    on_base(c, e->new_swing, e->whole);
    for (int i = 0; i < c->nl; i++) c->Du[i] = sudden(c, i) ? e->new_swing[i] : 0;
    local_error_apart(e->position + c->ns, e->velocity + c->ns, c->Du, c->H, c->nl);
    local_error_end(&e->minor, e->more, true, a, c->h);
    if (c->ratio == 1) subcycle_coupling_end(c, a);
    for (int i = 0; i < c->ns && c->ratio > 1; i++) {
        e->more[i] -= e->coupling.new_s[i];
        if (fabs(e->more[i]) <= largest_mean(c, i)) e->more[i] = 0;
    }
    local_error_apart(e->position, e->velocity, e->more, c->h, c->ns);
}

struct step_error subcycle_error(struct stepper *s)
{
    const struct subcycle *c = s->self;
    const struct subcycle_error *e = c->error;
    return (struct step_error){e->position, e->velocity, e->coupling.position, e->coupling.velocity};
}

void subcycle_error_keep(struct stepper *s, bool taken)
{
    struct subcycle *c = s->self;
    if (taken) {
        local_error_keep(&c->error->slow, c->H);
        local_error_copy(&c->error->fast, &c->error->minor);
        subcycle_coupling_keep(c);
        for (int i = 0; i < c->nl; i++)
            c->error->swing[i] = larger(.9 * c->error->swing[i], fabs(c->error->new_swing[i]));
    } else {
        local_error_forget(&c->error->slow);
        local_error_forget(&c->error->fast);
        c->error->coupling.terms = 0;
    }
}

bool subcycle_error_looks(struct stepper *s)
{
    const struct subcycle *c = s->self;
    struct missed *o = s->missed;
    if (!o) return true;
    if (!missed_looks(o)) return false;
    missed_begin(o, s->fresh, c->H);
    if (o->seen == 0) subcycle_error_keep(s, false);
    return true;
}

void subcycle_error_note(struct stepper *s, bool taken)
{
    enum { BURST = 3 };
    const struct subcycle *c = s->self;
    struct missed *o = s->missed;
    if (!o) return;
    if (!taken) {
        missed_break(o);
        return;
    }
    subcycle_error_keep(s, true);
    if (++o->seen >= BURST) missed_add(o, c->ode, c->error->position, c->error->velocity, c->v0, c->error->a);
}

void subcycle_error_recall(struct subcycle *c, struct recall *r)
{
    recall_within(r, "slow");
    local_error_recall(&c->error->slow, r);
    recall_without(r);
    recall_within(r, "fast");
    local_error_recall(&c->error->fast, r);
    recall_list(r, "swing", c->error->swing, (size_t)c->nl);
    subcycle_coupling_recall(c, r);
    recall_without(r);
}
