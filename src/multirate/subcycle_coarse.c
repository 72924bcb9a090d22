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
enum { REST = 64 }; /* major steps without coarse sweeps after too many have failed */
static const double FADE = .8; /* of exponential averages */
static const double OLD =
    .5; /* weight of the average of whole sweeps, which is not renewed while coarse ones are taken */

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
 * coarse sweep leaves a tenth of that. */
bool subcycle_coarse_next(const struct subcycle *c)
{
    return c->newton.way ? c->newton.count == 1 && able(c, LEAST) : c->newton.count == 2 && able(c, THIRD);
}

INTO static inline void add_rows(int ns, double *rows, double s, const double *A, const double *e, int ml)
{
    gemv_few(rows, s, A, e, ml, ns, ml);
}

void subcycle_coarse_keep(struct subcycle *c, int k)
{
    const int ml = c->dec.ml;
    if (k < c->ratio - JUMP_TERMS && !able(c, c->newton.way ? LEAST : THIRD)) return;
    double *rows = c->coarse.rows + (long)k * ml, per = -1 / c->h;
    copy(rows, c->r + c->ns, ml);
    if (c->dec.reach) BY_FEW(add_rows, c->ns, rows, per, c->dec.MsW, c->es, ml);
    if (c->resp.drives) BY_FEW(add_rows, c->ns, rows, per, c->resp.Q, c->es, ml);
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
    static const double gauss[COARSE_POINTS] = {.1127016654, .5, .8872983346};
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

/* Adds node i, whose rows are c->es and c->r, to the sums. */
static void node_sums(struct subcycle *c, const struct nodes *p, int i)
{
    const int ns = c->ns, ml = c->dec.ml;
    const double *rows = c->coarse.rows + (long)p->at[i] * ml, h = c->h * p->weight[i];
    for (int j = 0; j < ml; j++) c->R[j] += h * (c->r[ns + j] - rows[j]);
    for (int m = 0; m < COARSE_POINTS; m++)
        for (int j = 0; j < ns; j++) c->coarse.left[j + m * ns] += p->power[i][m] * c->es[j];
    for (int j = 0; j < ns; j++) {
        c->push += p->weight[i] * c->es[j] * c->v[j];
        c->rest[j] = c->es[j];
    }
    minor_solve(&c->resp.one, c->es, ns);
    c->square += p->weight[i] * dot(c->rest, c->es, ns);
}

static enum status node(struct subcycle *c, const struct nodes *p, int i, struct trouble *why)
{
    struct instant x = {.q = c->qmid, .v = c->v, .a = c->a, .qa = c->q, .qb = c->ode->pointwise ? NULL : c->qend};
    const int k = p->at[i];
    double power[POWER_CHANNELS], dk = 0;
    subcycle_minor_time(c, &x, k);
    TRY(subcycle_minor_rows(c, c->d + (long)k * c->ns, power, &dk, &x, why));
    c->coarse.varied |= sharpened(&dk);
    c->coarse.varied |= dk > STALE_SLOPE;
    subcycle_book(c, c->h * p->weight[i], power);
    node_sums(c, p, i);
    return OK;
}

enum status subcycle_coarse_rows(struct subcycle *c, struct trouble *why)
{
    struct nodes *p = c->coarse.nodes;
    const bool straight = !c->ode->move || c->ode->straight;
    if (p->n != c->ratio) find_nodes(p, c->ratio);
    subcycle_rewind(c);
    zero(c->coarse.left, c->ns * COARSE_POINTS);
    for (int k = 0, i = 0; k <= p->at[COARSE_POINTS - 1]; k++) {
        const double *d = c->d + (long)k * c->ns;
        if (stop) return stop_status();
        if (k == p->at[i] && straight) subcycle_place(c, k);
        if (k == p->at[i]) TRY(node(c, p, i++, why));
        if (straight) {
            subcycle_fast_velocity(c, d);
        } else {
            subcycle_velocity(c, d);
            subcycle_point(c, c->q, c->q, 1, subcycle_minor_end(c, k));
        }
        subcycle_advance(c, d);
    }
    for (int k = 0; k < c->ratio; k++) vector_move(c->R, c->R, c->h, c->coarse.rows + (long)k * c->dec.ml, c->dec.ml);
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
