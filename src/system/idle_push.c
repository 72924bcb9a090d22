/* idle_push.c -- turns that move no mass: is anything at work along them, and how fast they are; see idle.h */
#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "system/idle_parts.h"

/* --- what acts along them ----------------------------------------------------------------------- */

struct pushing {
    const struct idle *idle;
    struct system *s;
    const struct ode2 *ode;
    double *v, *r, *turned; /* [n]; torques along the turns [n of them] */
    double usual;           /* largest torque met [N m] */
    struct arena *scratch;
};

/* o->turned := J e.w', which is Q^ along the turns: w' whatever makes it, drives, too. */
static bool torques(struct pushing *o, const double *q, const double *v, double t)
{
    struct trouble why;
    const struct instant x = {.t = t, .q = q, .v = v, .ta = t, .tb = t};
    if (o->ode->ops->resid(o->ode, o->r, NULL, NULL, &x, ALL, &why) != OK) return false;
    for (int i = 0; i < o->ode->n; i++) o->usual = fmax(o->usual, fabs(o->r[i]) * ode2_usual(o->ode, i));
    if (system_evaluate(o->s, q, v, t, EVALUATE_ACCELERATION, &why) != OK) return false;
    for (int i = 0; i < o->idle->n; i++) {
        const struct idle_turn *turn = &o->idle->turn[i];
        struct pose frame;
        double al[3];
        system_pose(o->s, &frame, turn->body);
        m3_tmul(al, frame.R, frame.al);
        o->turned[i] = turn->inertia * v3_dot(al, turn->axis);
    }
    return true;
}

/* x := a motion along the turns, each by about 1 rad or 1 rad/s. */
static bool along_turns(struct pushing *o, double *x, const double *q, double t, unsigned trial)
{
    struct inverse M;
    const struct arena_mark mark = arena_mark(o->scratch);
    struct turn_axis *of = TAKE(o->scratch, struct turn_axis, o->idle->n);
    for (int i = 0; i < o->idle->n; i++) {
        const struct idle_turn *turn = &o->idle->turn[i];
        const double rate = 1 + idle_scatter(trial + (unsigned)i) / 2;
        of[i] = (struct turn_axis){turn->body, turn->axis, rate * turn->inertia};
    }
    system_spin_row(o->s, x, q, t, of, o->idle->n);
    arena_rewind(o->scratch, mark);
    if (!inverse_build(&M, o->ode, q, t, o->scratch)) return false;
    inverse_apply(&M, x);
    return true;
}

/* Marks turns whose torque, o->turned less `even` of it, is more than round-off and would be seen in `span`. */
static void mark(bool *pushed, const struct pushing *o, const double *even, double span)
{
    static const double ROUND_OFF = 1e-8, SEEN = 1e-6; /* [1], [rad] */
    for (int i = 0; i < o->idle->n; i++) {
        const double torque = fabs(o->turned[i] - (even ? even[i] : 0));
        pushed[i] |= torque > ROUND_OFF * o->usual && torque / o->idle->turn[i].inertia * span * span > SEEN;
    }
}

/* By springs, where they have turned; by dampers, which a turn the other way tells from what is of its square. */
static void push_nearby(bool *pushed, struct pushing *o, const double *q, double t, double span)
{
    static const double FAR = .3;
    const int n = o->ode->n;
    double *x = TAKE(o->scratch, double, n), *back = TAKE(o->scratch, double, n);
    double *q1 = TAKE(o->scratch, double, o->ode->nq), *even = TAKE(o->scratch, double, o->idle->n);
    if (!along_turns(o, x, q, t, 7)) return;
    if (o->ode->move)
        o->ode->move->point(o->ode, q1, q, x, FAR, t);
    else
        for (int i = 0; i < n; i++) q1[i] = q[i] + FAR * x[i];
    if (!isnan(q1[0]) && torques(o, q1, o->v, t)) mark(pushed, o, NULL, span);
    for (int i = 0; i < n; i++) back[i] = -x[i];
    if (!torques(o, q, back, t)) return;
    memcpy(even, o->turned, sizeof *even * (size_t)o->idle->n);
    if (torques(o, q, x, t)) mark(pushed, o, even, span);
}

int idle_pushed(bool *pushed, const struct idle *o, struct system *s, const double *q, double t, double t1)
{
    enum { TIMES = 32 };
    struct arena *scratch = arena_open();
    const struct ode2 *ode = system_ode2(s);
    struct pushing p = {.idle = o, .s = s, .ode = ode, .scratch = scratch};
    double **of[] = {&p.v, &p.r};
    int first = 0;
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) *of[i] = TAKE(scratch, double, ode->n);
    p.turned = TAKE(scratch, double, o->n);
    for (int k = 0; k <= (o->model->ndrive ? 0 : TIMES); k++) /* q is closed for drives at t only */
        if (torques(&p, q, p.v, t + (t1 - t) * k / TIMES)) mark(pushed, &p, NULL, t1 - t);
    push_nearby(pushed, &p, q, t, t1 - t);
    while (first < o->n && !pushed[first]) first++;
    arena_close(scratch);
    return first < o->n ? first : -1;
}

/* --- rates -------------------------------------------------------------------------------------- */

/* How fast it turns, by drives, too, at the last system_energy_at(). */
static double spin_of(const struct system *s, const struct idle_turn *turn)
{
    double w[3];
    system_frame_spin(s, w, turn->body);
    return v3_dot(w, turn->axis);
}

void idle_still(struct idle *o, struct system *s, const double *q, double *v, double t)
{
    struct arena *scratch = arena_open();
    const struct ode2 *ode = system_ode2(s);
    double *x = TAKE(scratch, double, ode->n), *row = TAKE(scratch, double, ode->n);
    struct inverse M;
    struct energies e;
    struct trouble why;
    const bool known = o->n > 0 && system_energy_at(s, &e, q, v, t, &why) == OK;
    for (int i = 0; i < o->n && known; i++) o->turn[i].dropped = spin_of(s, &o->turn[i]);
    for (int i = 0; i < o->n; i++) {
        const struct idle_turn *turn = &o->turn[i];
        system_spin_row(s, row, q, t, &(struct turn_axis){turn->body, turn->axis, 1}, 1);
        for (int k = 0; k < ode->n; k++) x[k] += turn->inertia * turn->dropped * row[k];
    }
    if (o->n && inverse_build(&M, ode, q, t, scratch)) {
        inverse_apply(&M, x);
        for (int k = 0; k < ode->n; k++) v[k] -= x[k];
    }
    arena_close(scratch);
}

/* K -= K x S' on one side, S x' K on the other; x moves one turn by 1 and no other, S is its spin. */
static void clear_one(double *K, const double *x, const double *S, int n)
{
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < n; i++) {
            const int along = side ? 1 : n, across = side ? n : 1;
            double sum = 0;
            for (int k = 0; k < n; k++) sum += K[i * across + k * along] * x[k];
            for (int k = 0; k < n; k++) K[i * across + k * along] -= sum * S[k];
        }
}

void idle_clear(const struct idle *o, struct system *s, double *K, double stiffness, const double *q, double t)
{
    struct arena *scratch = arena_open();
    const int n = system_ode2(s)->n;
    double *x = TAKE(scratch, double, n), *row = TAKE(scratch, double, n);
    struct inverse M;
    const bool known = o->n > 0 && inverse_build(&M, system_ode2(s), q, t, scratch);
    for (int i = 0; known && i < o->n; i++) {
        const struct idle_turn *turn = &o->turn[i];
        system_spin_row(s, row, q, t, &(struct turn_axis){turn->body, turn->axis, 1}, 1);
        for (int k = 0; k < n; k++) x[k] = turn->inertia * row[k];
        inverse_apply(&M, x);
        clear_one(K, x, row, n);
        for (int k = 0; k < n * n; k++) K[k] += stiffness * row[k % n] * row[k / n];
    }
    arena_close(scratch);
}

double idle_energy(int *most, const struct idle *o, const struct system *s)
{
    double sum = 0, top = -1;
    for (int i = 0; i < o->n; i++) {
        const double spin = spin_of(s, &o->turn[i]), energy = o->turn[i].inertia * spin * spin / 2;
        sum += energy;
        if (energy > top) top = energy, *most = i;
    }
    return sum;
}
