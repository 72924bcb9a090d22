/* subcycle_coarse.c -- sweeps that evaluate a few minor steps and interpolate the others.
 *
 * After a whole sweep the rows of all minor steps are known, and the next one asks only by how much they have
 * changed.  That is smooth over the major step: what has changed is du and, in all minor steps alike, the point
 * about which they vibrate. So COARSE_POINTS minor steps near the Gauss points of the major one are evaluated.  A
 * polynomial through them gives the change of the sum of the slow rows, and the residual of the fast rows, by which
 * all d_k are corrected with the linear answer of response_run().
 *
 * It is not done where springs or dampers couple fast and slow coordinates, as the change is a vibration itself;
 * where slopes change; where a force may set in within a minor step that is not evaluated (an impact on an elastic
 * stop lost 0.1 percent of the energy); and where power flows in the minor steps, since work must be that of the motion
 * found, as that of the slow bodies is in any sweep. */
#include "base/stop.h"
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

enum {
    LEAST = 5,
    THIRD = 8
};                  /* minor steps from which a coarse sweep pays as the second, as the third one of a step */
enum { REST = 32 }; /* major steps without coarse sweeps after too many have failed */
static const double FADE = .8; /* of exponential averages */
static const double OLD =
    .5; /* weight of the average of whole sweeps, which is not renewed while coarse ones are taken */

static const double gauss[COARSE_POINTS] = {.1127016654, .5, .8872983346};

/* The minor steps that are evaluated. */
struct nodes {
    int n;                        /* of so many; 0: not found yet */
    int at[COARSE_POINTS];        /* their numbers */
    double weight[COARSE_POINTS]; /* in the sum over all minor steps: exact for polynomials through them */
    double power[COARSE_POINTS]
                [COARSE_POINTS]; /* coefficients of the Lagrange polynomial of each, in f = (k + 1/2)/n */
};

void subcycle_coarse_open(struct subcycle *c, struct arena *life)
{
    c->coarse.nodes = TAKE(life, struct nodes, 1);
    c->coarse.left = TAKE_MATRIX(life, double, c->ns, COARSE_POINTS);
    c->coarse.sum = TAKE(life, double, c->dec.ml);
    c->moved = TAKE_MATRIX(life, double, c->ns, 2);
}

/* May a step of at least so many minor steps have coarse sweeps? */
static bool able(const struct subcycle *c, int least)
{
    return c->ratio >= least && !c->resp.couples && !c->ode->bends;
}

/* A coarse second sweep that is not enough makes the step dearer than two whole sweeps would have; but these, too,
 * may need a third. */
void subcycle_coarse_plan(struct subcycle *c)
{
    struct coarse *o = &c->coarse;
    const struct newton *nt = &c->newton;
    double *learned = nt->way ? &o->missed : &o->whole;
    if (nt->count > 1) *learned = FADE * *learned + (1 - FADE) * (nt->count > 2);
    if (o->rest > 0) o->rest--;
    const double bearable = OLD * o->whole + (double)(c->ratio - COARSE_POINTS) / (c->ratio + COARSE_POINTS);
    if (o->missed > bearable) {
        o->rest = REST;
        o->missed = bearable * FADE;
    }
    o->on = false;
    o->varied = o->powered = false;
    c->newton.next = o->rest == 0 && able(c, LEAST);
}

/* After one whole sweep; or after two where the second was not allowed to be coarse: then little is left, and a
 * coarse sweep leaves a tenth of that.  (After a coarse second one, too, where its correction was small, it makes
 * decks/satellite-instrument.yaml cheaper at 100:1, but steps of order 4 dearer than auto's next choice.) */
bool subcycle_coarse_next(const struct subcycle *c)
{
    return c->newton.way ? c->newton.count == 1 && able(c, LEAST) : c->newton.count == 2 && able(c, THIRD);
}

bool subcycle_coarse_blind(const struct subcycle *c)
{
    return c->newton.way && gauss[0] * c->ratio >= 1;
}

/* rows := from + s times what fast unknowns e add to the slow rows of the fast bodies. */
INTO static inline void with_answer(struct subcycle *c, double *rows, const double *from, double s, const double *e)
{
    const int ml = c->dec.ml;
    if (c->dec.reach)
        gemv_from(rows, from, s, c->dec.MsW, e, ml, c->ns, ml);
    else
        copy(rows, from, ml);
    if (c->resp.drives) dense_gemv(rows, s, c->resp.Q, e, ml, c->ns, ml);
}

void subcycle_coarse_keep(struct subcycle *c, int k)
{
    if (k < c->ratio - JUMP_TERMS && !able(c, c->newton.way ? LEAST : THIRD)) return;
    with_answer(c, c->coarse.rows + (long)k * c->dec.ml, c->r + c->ns, -1 / c->h, c->es);
}

void subcycle_coarse_kept(struct subcycle *c)
{
    if (able(c, c->newton.way ? LEAST : THIRD)) with_answer(c, c->coarse.sum, c->R, -1, c->esum);
}

/* power := coefficients of the polynomial through 1 at f[i] and 0 at the other f. */
static void lagrange(double *power, const double *f, int i)
{
    int degree = 0;
    power[0] = 1;
    for (int j = 0; j < COARSE_POINTS; j++) {
        if (j == i) continue;
        const double per = 1 / (f[i] - f[j]);
        power[degree + 1] = 0;
        for (int m = ++degree; m >= 0; m--) power[m] = per * ((m > 0 ? power[m - 1] : 0) - f[j] * power[m]);
    }
}

static void find_nodes(struct nodes *p, int n)
{
    double f[COARSE_POINTS], sums[COARSE_POINTS] = {0};
    p->n = n;
    for (int i = 0; i < COARSE_POINTS; i++) p->at[i] = (int)(gauss[i] * n), f[i] = (p->at[i] + .5) / n;
    for (int k = 0; k < n; k++) {
        double power = 1;
        for (int m = 0; m < COARSE_POINTS; m++, power *= (k + .5) / n) sums[m] += power;
    }
    for (int i = 0; i < COARSE_POINTS; i++) {
        lagrange(p->power[i], f, i);
        p->weight[i] = dot(p->power[i], sums, COARSE_POINTS);
    }
}

INTO static inline void slow_sums(int ml, double *restrict R, const double *restrict r, const double *restrict rows,
                                  double h)
{
    for (int j = 0; j < ml; j++) R[j] += h * (r[j] - rows[j]);
}

INTO static inline void fast_sums(int ns, double *restrict left, const double *restrict power,
                                  const double *restrict es)
{
    for (int m = 0; m < COARSE_POINTS; m++)
        for (int j = 0; j < ns; j++) left[j + m * ns] += power[m] * es[j];
}

/* Adds node i, whose rows are c->es and c->r, to the sums. */
static void node_sums(struct subcycle *c, const struct nodes *p, int i)
{
    const int ns = c->ns, ml = c->dec.ml;
    const double weight = p->weight[i];
    slow_sums(ml, c->R, c->r + ns, c->coarse.rows + (long)p->at[i] * ml, c->h * weight);
    BY_FEW(fast_sums, ns, c->coarse.left, p->power[i], c->es);
    c->push += weight * dot(c->es, c->v, ns);
    copy(c->rest, c->es, ns);
    minor_solve(&c->resp.one, c->es, ns);
    c->square += weight * dot(c->rest, c->es, ns);
}

static enum status node(struct subcycle *c, const struct nodes *p, int i, struct instant *x, struct trouble *why)
{
    const int k = p->at[i];
    double power[POWER_CHANNELS], dk = 0;
    subcycle_minor_time(c, x, k);
    TRY(subcycle_minor_rows(c, k, power, &dk, x, why));
    c->coarse.varied |= sharpened(&dk);
    c->coarse.varied |= dk > STALE_SLOPE;
    subcycle_book(c, c->h * p->weight[i], power);
    node_sums(c, p, i);
    return OK;
}

enum status subcycle_coarse_rows(struct subcycle *c, struct trouble *why)
{
    struct instant x = subcycle_half(c);
    struct nodes *p = c->coarse.nodes;
    const bool straight = !c->ode->move || c->ode->straight;
    if (p->n != c->ratio) find_nodes(p, c->ratio);
    subcycle_rewind(c);
    copy(c->R, c->coarse.sum, c->dec.ml);
    zero(c->coarse.left, c->ns * COARSE_POINTS);
    for (int k = 0, i = 0; k <= p->at[COARSE_POINTS - 1]; k++) {
        const double *d = c->d + (long)k * c->ns;
        if (stop) return stop_status();
        if (k == p->at[i] && straight && c->passes) subcycle_place(c, k);
        if (k == p->at[i]) TRY(node(c, p, i++, &x, why));
        if (!straight) {
            subcycle_velocity(c, d);
            subcycle_point(c, c->q, c->q, 1, subcycle_minor_end(c, k));
        }
        subcycle_advance(c, d);
    }
    zero(c->dsum, c->ns);
    return OK;
}

void subcycle_coarse_recall(struct subcycle *c, struct recall *r)
{
    recall_within(r, "coarse");
    recall_one(r, "rest", c->coarse.rest);
    recall_one(r, "missed", c->coarse.missed);
    recall_one(r, "whole", c->coarse.whole);
    recall_without(r);
}
