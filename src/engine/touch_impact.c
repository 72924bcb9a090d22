/* touch_impact.c -- impacts: velocities that jump; see touch.h
 *
 *     M (v1 - v0) = G' p,   0 <= u_n1 + e min(u_n0, 0), p_n >= 0, one of them 0
 *
 * and the cone of friction on the rates across behind the impact, of joints by what they bear of p.  The loss is
 * -p.(u0 + u1)/2.  With friction and several contacts Newton's restitution can gain energy (Kane & Levinson, Dynamics (1985)):
 * then the largest share of e that gains none is taken. */
#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/accel.h"
#include "engine/motion.h"
#include "engine/touch_parts.h"

enum { HALVINGS = 40, PASSES = 60 };
static const double ENOUGH = 1e-9; /* of the impulses: where joints that rub have come to rest with what presses them */
static const double SLOWED = 1e-3; /* of the hardest impact in this step: where bouncing comes to its end */

/* How its gap is pulled to: by all but contacts, or as it was on the way here, where closed ones carry the other body. */
static double pulled(const struct touch *o, const struct cone *c, const struct state *x)
{
    const int n = o->ode->n;
    const double *G = o->end.G + c->row * n;
    return smaller(dot(G, o->a, n), dot(G, x->a, n));
}

/* With steps by tolerance: is what leaves with this speed, pulled back by an, next to rest?  So it is where it flies
 * no higher than impacts are found by much. */
static bool is_over(const struct touch *o, int i, double speed, double an)
{
    static const double FLAT = 100 * 1e-12; /* TOUCH_CLOSED */
    const double share = TOUCH_SMALL * o->stepper->options.tolerance, height = speed * speed / (-2 * an * o->size[i]);
    return share > 0 && ((speed <= share * o->top && height <= share) || height <= FLAT);
}

/* Restitution of the k-th: none of what is closed, and none where it would be back within the step. */
static double restitution(const struct touch *o, int k, const struct state *x, double h, int last)
{
    const int i = o->contact[k];
    const double e = o->c->of[i].restitution, un = o->u[o->cone[k].row], an = pulled(o, &o->cone[k], x);
    if (o->closed[i] || last || !(un < 0) || e == 0) return 0;
    if (an < 0 && (2 * e * -un < -an * h || is_over(o, i, e * -un, an))) return 0;
    return an < 0 && -un <= TOUCH_AT_REST * 1e-3 * o->top ? 0 : e;
}

/* l that brings u1 to where they are to be.  Joints that rub are pressed by the impact, by their own friction, too: by the
 * forces of a motion that does it all in next to no time, beside which no others count. */
static enum status find(struct touch *o, bool *found, const struct state *x, struct trouble *why)
{
    static const double BRIEF = 1e-9, ROUND_OFF = 1e-14; /* of a usual step, of the impulses */
    const double h = BRIEF * o->usual;
    double moved = INFINITY;
    zero(o->l, o->rows);
    for (int k = 0; k < PASSES && moved > ROUND_OFF; k++) {
        const struct instant at = {.t = x->t, .q = x->q, .v = x->v, .a = o->y, .ta = x->t, .tb = x->t};
        double most = DBL_MIN;
        copy(o->last, o->l, o->rows);
        if (k > 0) {
            zero(o->y, o->ode->n);
            touch_kick(o, o->y, o->l);
            for (int i = 0; i < o->ode->n; i++) o->y[i] /= h;
            TRY(touch_press(o, &at, h, k - 1, why));
        }
        *found = cone_solve(o->l, o->W, o->u1, o->cone, o->n, o->rows, o->top, 0, &o->work);
        if (!*found || !o->c->bound) return OK;
        for (int i = 0; i < o->rows; i++) most = larger(most, fabs(o->l[i]));
        moved = 0;
        for (int i = 0; i < o->rows; i++) moved = larger(moved, fabs(o->l[i] - o->last[i]) / most);
    }
    *found = moved <= ENOUGH;
    return OK;
}

/* l and the loss [J] with e times the restitutions. */
static enum status strike(struct touch *o, double *loss, double e, const struct state *x, struct trouble *why)
{
    for (int i = 0; i < o->rows; i++) o->u1[i] = o->u[i];
    for (int k = 0; k < o->n; k++) {
        const int row = o->cone[k].row;
        o->u1[row] += e * o->e[k] * smaller(o->u[row], 0);
    }
    bool found;
    TRY(find(o, &found, x, why));
    for (int i = 0; i < o->rows; i++) {
        o->u1[i] = o->u[i];
        for (int j = 0; j < o->rows; j++) o->u1[i] += o->W[i + j * o->rows] * o->l[j];
    }
    *loss = touch_taken(o);
    return found ? OK : trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, x->t);
}

static bool gains(const struct touch *o, double loss)
{
    return loss < -1e-12 * larger(fabs(loss), o->top * fabs(o->l[0]));
}

/* The largest share of the restitutions that gains no energy, where the whole does; none, e = 0, never gains. */
static enum status lower(struct touch *o, double *e, const struct state *x, struct trouble *why)
{
    double low = 0, high = *e, loss;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        TRY(strike(o, &loss, middle, x, why));
        *(gains(o, loss) ? &high : &low) = middle;
    }
    *e = low;
    return OK;
}

/* Those that leave so slowly that it is next to rest are to stay: points of one body that rattle would throw each
 * other off for ever. Nothing has pushed them, so they do not rub. Are there any? */
static bool hold_slow(struct touch *o, const struct state *x)
{
    bool any = false;
    for (int k = 0; k < o->n; k++) {
        struct cone *c = &o->cone[k];
        const double after = o->u1[c->row], an = pulled(o, c, x);
        if (!(after > TOUCH_AT_REST * o->top && an < 0 && is_over(o, o->contact[k], after, an))) continue;
        c->held = any = true;
        c->across = 0;
    }
    return any;
}

/* Would what leaves be back within the step?  It stays, as far as it pushes. */
static bool stays(const struct touch *o, const struct cone *c, const struct state *x, double h)
{
    const double after = o->u1[c->row], an = pulled(o, c, x);
    if (fabs(after) <= TOUCH_AT_REST * o->top) return true;
    return after > 0 && an < 0 && 2 * after < -an * h;
}

static void note_all(struct touch *o, const struct state *x, double h, double loss)
{
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k], was = o->closed[i];
        const double before = o->u[c->row], after = o->u1[c->row], p = o->l[c->row];
        o->closed[i] = stays(o, c, x, h);
        o->impulse[i] += p;
        if (p > 0 && !was) {
            o->impacts[i]++;
            o->all++;
            touch_note(o, (struct touch_event){TOUCH_IMPACT, i, x->t, before, after, p, loss});
        }
        if (o->closed[i] != was)
            touch_note(o, (struct touch_event){.what = was ? TOUCH_OPENS : TOUCH_CLOSES, .contact = i, .t = x->t});
        if (o->closed[i] != was || !touch_sticks(o, o->u, c) || !touch_sticks(o, o->u1, c))
            touch_set_slip(o, i, o->u1, c);
        if (!o->closed[i]) o->state[i] = TOUCH_OPEN;
        for (int j = 0; j <= c->across; j++) o->p[o->first[i] + j] = 0;
    }
    touch_keep_closed(o);
}

enum status touch_impact(struct touch *o, struct state *x, double h, int last, struct trouble *why)
{
    struct stepper *s = o->stepper;
    double loss = 0, e = 1;
    touch_choose(o, touch_merge(o, o->n, o->which, o->nclosed));
    TRY(touch_look(o, o->u, &o->end, x, why));
    TRY(touch_mass(o, x, why));
    TRY(accel_solve(s->accel, o->a, NULL, x->q, x->v, x->t, why));
    double most = 0;
    for (int k = 0; k < o->n; k++) most = larger(most, -o->u[o->cone[k].row]);
    o->hardest = larger(o->hardest, most);
    if (most > SLOWED * o->hardest) last = 0;
    for (int k = 0; k < o->n; k++) {
        const struct ode2_touch *of = &o->c->of[o->contact[k]];
        o->e[k] = restitution(o, k, x, h, last);
        o->cone[k].mu = of->sliding;
        o->top = larger(o->top, fabs(o->u[o->cone[k].row]));
    }
    TRY(strike(o, &loss, e, x, why));
    if (gains(o, loss)) {
        TRY(lower(o, &e, x, why));
        TRY(strike(o, &loss, e, x, why));
        o->lowered++;
    }
    if (hold_slow(o, x)) TRY(strike(o, &loss, e, x, why));
    for (int k = 0; k < o->n; k++) /* nothing gives way: it is driven */
        if (!(o->u1[o->cone[k].row] >= -SLOWED * o->hardest - TOUCH_AT_REST * o->top))
            return trouble_set(why, TROUBLE_CONTACT, o->contact[k], INFINITY, x->t);
    touch_strike(o, x->q, x->v, x->t);
    note_all(o, x, h, loss);
    o->took = 0;
    return stepper_start(s, x, why);
}
