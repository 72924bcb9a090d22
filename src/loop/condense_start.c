/* condense_start.c -- from the drawn position to a closed start, or the reason why there is none.
 *
 * In order: the loops as drawn miss by little and are closed (rank, split, Newton); dropped rows hold a small way off
 * as well, or the rank drops at this posture only; the independent coordinates go to where `initial:` puts them; what
 * it says of the others must fit. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "loop/condense_parts.h"

static const double RANK = 1e-8;      /* least pivot over the first one */
static const double ASSEMBLY = 1e-3;  /* |C| closed at all */
static const double KEEP_FAST = 1e-2; /* weight of fast columns in later choices */
static const double WATCHED = 1e-5;   /* |C| up to which dropped rows hold on the way */
static const double HOLDS = 1e-9;     /* |C| of a whole state that is closed as it is */

static const char *row_name(const struct condense *o, int row)
{
    return o->model->loop[o->loops->row[row].loop].name;
}

static const char *place_name(const struct model *m, int iv)
{
    for (int i = 0; i < m->ncoordinate; i++)
        if (m->coordinate[i].iv == iv) return m->coordinate[i].name;
    for (int i = 0; i < m->njoint; i++)
        for (int k = 0; k < m->joint[i].nv; k++)
            if (m->joint[i].iv[k] == iv) return m->joint[i].name;
    return "?";
}

/* Is the coordinate one that the deck wants independent? */
static bool chosen_by_deck(const struct condense *o, int iv)
{
    return o->model->follow[iv] < 1e-3;
}

/* The deck's choice leaves C_qd singular: names a coordinate that must follow, and one that may lead. */
static enum status refuse_choice(struct condense *o, struct part *c, int asked)
{
    int instead = -1;
    for (int k = 0; k < c->of->nk; k++) c->weight[k] = 1;
    component_choose(o, c);
    for (int j = 0; j < c->ni && instead < 0; j++)
        if (!chosen_by_deck(o, c->of->k[c->ind[j]])) instead = c->of->k[c->ind[j]];
    if (instead < 0)
        return fail(&o->start.report, E_MODEL,
                    "'%s' cannot be independent: the loops leave %d freedom(s), and these are chosen",
                    place_name(o->model, asked), c->ni);
    return fail(&o->start.report, E_MODEL,
                "'%s' cannot be independent here: the loops' equations for the others are singular; try '%s'",
                place_name(o->model, asked), place_name(o->model, instead));
}

/* The deck's coordinate that makes the split impossible or all but singular; -1: none. */
static int to_blame(const struct condense *o, const struct part *c)
{
    static const double SINGULAR = 1e-7;
    for (int r = 0; r < c->nr; r++)
        if (chosen_by_deck(o, c->of->k[c->dep[r]])) return c->of->k[c->dep[r]];
    for (int j = 0; j < c->ni && c->chosen < SINGULAR; j++)
        if (chosen_by_deck(o, c->of->k[c->ind[j]])) return c->of->k[c->ind[j]];
    return -1;
}

/* Ranks and splits at q, where the loops miss by so much. */
static enum status split_all(struct condense *o, const double *q, double miss)
{
    rows_linearize(&o->rows, q);
    o->start.redundant = 0;
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        int urgent = 0;
        c->nr = component_rank(o, c, fmax(RANK, fmin(30 * miss, 1e-2)));
        c->ni = c->of->nk - c->nr;
        for (int k = 0; k < c->of->nk; k++) urgent += o->model->urgent[c->of->k[k]];
        c->nfast = urgent < c->ni ? urgent : c->ni;
        for (int k = 0; k < c->of->nk; k++) c->weight[k] = o->model->follow[c->of->k[k]];
        c->chosen = component_choose(o, c);
        o->start.redundant += c->of->nrow - c->nr;
        int asked = to_blame(o, c);
        if (asked >= 0) return refuse_choice(o, c, asked);
    }
    condense_number(o);
    return OK;
}

/* A number in [-1, 1] from another, always the same. */
static double scatter(unsigned i)
{
    unsigned x = (i + 1) * 2654435761u;
    x ^= x >> 15;
    x *= 2246822519u;
    x ^= x >> 13;
    return (double)(x >> 8) / 8388608 - 1;
}

/* By how much the dropped rows miss, of the last misfit; the worst. */
static double dropped_miss(const struct condense *o, int *worst)
{
    double most = 0;
    for (int i = 0; i < o->npart; i++) {
        const struct part *c = &o->part[i];
        for (int r = c->nr; r < c->of->nrow; r++) {
            const int row = c->of->row[c->kept[r]];
            if (fabs(o->C[row]) > most) most = fabs(o->C[row]), *worst = row;
        }
    }
    return most;
}

/* Do dropped rows still hold a small way off?  Redundant ones do; where C_q has lost rank at this very posture
 * only, the way along a direction that is too many leaves them at second order. */
static enum status look_for_branches(struct condense *o)
{
    static const double WAY = 1e-2, MISS = 1e-7;
    int row, worst = 0, lost = 0;
    double miss = 0;
    if (o->start.redundant == 0) return OK;
    for (unsigned trial = 0; trial < 3; trial++) {
        for (int i = 0; i < o->nt; i++) o->dx[i] = 0;
        for (int i = 0; i < o->ode.n; i++)
            o->dx[o->ind[i]] = WAY * o->rows.size[o->ind[i]] * scatter(trial * 1000u + (unsigned)i);
        if (!condense_tangent(o, o->q)) return OK;
        condense_predict(o);
        if (!condense_close(o, o->qtry, o->q, 1)) continue;
        rows_misfit(o->C, &row, &o->rows, o->qtry);
        int away = 0;
        for (int i = 0; i < o->npart; i++) {
            const struct part *c = &o->part[i];
            for (int r = c->nr; r < c->of->nrow; r++)
                away += fabs(o->C[c->of->row[c->kept[r]]]) > MISS + 10 * o->start.misfit;
        }
        if (away > lost) {
            lost = away;
            miss = dropped_miss(o, &worst);
        }
    }
    if (lost == 0) return OK;
    rows_misfit(o->C, &row, &o->rows, o->q);
    return fail(
        &o->start.report, E_MODEL,
        "rank of C_q drops by %d in this posture, and constraint '%s' misses by %.3g of the mechanism's size a "
        "small way off: a bifurcation, where the loops leave the way open, or a mechanism that is locked; start "
        "beside it",
        lost, row_name(o, worst), miss);
}

static enum status assemble(struct condense *o)
{
    struct condense_start *s = &o->start;
    double miss = s->misfit = rows_misfit(o->C, &s->misfit_row, &o->rows, o->q);
    if (!(miss <= ASSEMBLY))
        return fail(&s->report, E_MODEL,
                    "constraint '%s' closes a loop, and as drawn its bodies miss each other by %.3g of the mechanism's "
                    "size; at most %g is closed without 'initial: {assemble: true}'",
                    row_name(o, s->misfit_row), miss, ASSEMBLY);
    for (int pass = 0; pass < 2; pass++) {
        TRY(split_all(o, o->q, miss));
        memset(o->dx, 0, sizeof *o->dx * (size_t)o->nt);
        if (!condense_close(o, o->qtry, o->q, 1))
            return fail(&s->report, E_MODEL, "the loop of constraint '%s' cannot be closed",
                        row_name(o, s->misfit_row));
        for (int i = 0; i < o->nt; i++)
            if (fabs(o->dx[i]) > s->moved) s->moved = fabs(o->dx[i]), s->moved_at = i;
        memcpy(o->q, o->qtry, sizeof *o->q * (size_t)o->model->nq);
        int row = 0;
        miss = rows_misfit(o->C, &row, &o->rows, o->q);
        if (dropped_miss(o, &row) > fmax(1e-9, 3 * s->misfit))
            return fail(&s->report, E_MODEL, "constraint '%s' contradicts the others by %.3g of the mechanism's size",
                        row_name(o, row), miss);
    }
    return look_for_branches(o);
}

/* From the drawn position to where `initial:` puts the independent coordinates, in small steps on the same branch. */
static enum status go_to_start(struct condense *o, const double *q0)
{
    enum { STEPS = 50 };
    double most = 0;
    int row;
    o->loops->share = 1;
    loops_when(o->loops, o->model->t0);
    if (rows_misfit(o->C, &row, &o->rows, q0) <= HOLDS) {
        memcpy(o->q, q0, sizeof *q0 * (size_t)o->model->nq);
        return OK;
    }
    moves_diff(o->moves, o->zero, q0, o->q); /* borrowed: wiped below */
    double *way = o->way;
    memcpy(way, o->zero, sizeof *way * (size_t)o->nt);
    memset(o->zero, 0, sizeof *way * (size_t)o->nt);
    for (int i = 0; i < o->ode.n; i++) most = fmax(most, fabs(way[o->ind[i]]) / o->rows.size[o->ind[i]]);
    for (int i = 0; i < o->loops->nrow; i++) most = fmax(most, fabs(o->loops->c[i] - o->loops->drawn[i]));
    if (most == 0) return OK;
    for (int k = 0; k < STEPS; k++) {
        o->loops->share = (k + 1.) / STEPS;
        loops_when(o->loops, o->model->t0);
        memset(o->dx, 0, sizeof *o->dx * (size_t)o->nt);
        for (int i = 0; i < o->ode.n; i++) o->dx[o->ind[i]] = way[o->ind[i]] / STEPS;
        int closed = condense_tangent(o, o->q);
        if (closed) condense_predict(o);
        if (!closed || !condense_close(o, o->qtry, o->q, 1))
            return fail(&o->start.report, E_MODEL,
                        "the start ('initial' and drives) cannot be reached: '%s' locks at %d %% of the way from the "
                        "drawn position",
                        o->model->loop[o->lost].name, 100 * k / STEPS);
        memcpy(o->q, o->qtry, sizeof *o->q * (size_t)o->model->nq);
    }
    for (int i = 0; i < o->model->nq; i++) { /* exactly what the deck says */
        int iv = o->model->coordinate[i].iv;
        if (iv >= 0 && o->slot[iv] >= 0) o->q[i] = q0[i];
    }
    memset(o->dx, 0, sizeof *o->dx * (size_t)o->nt);
    if (!condense_close(o, o->qtry, o->q, 1)) return fail(&o->start.report, E_MODEL, "'initial' cannot be reached");
    memcpy(o->q, o->qtry, sizeof *o->q * (size_t)o->model->nq);
    return OK;
}

/* What `initial:` says of coordinates that follow others must fit. */
static enum status agrees(struct condense *o, const double *q0, const double *v0)
{
    static const double FITS = 1e-6;
    char drives[60] = "";
    struct trouble why;
    const struct model *m = o->model;
    if (condense_rates(o, o->vt, NULL, o->q, o->v, NULL, o->model->t0, &why) != OK)
        return fail(&o->start.report, E_MODEL, "the loops are singular at the start");
    if (m->ndrive) snprintf(drives, sizeof drives, " and drives at t = %.9g", m->t0);
    for (int i = 0; i < m->ncoordinate; i++) {
        int iv = m->coordinate[i].iv;
        if (iv < 0 || o->slot[iv] >= 0) continue;
        if (m->said_q && m->said_q[i] && fabs(q0[i] - o->q[i]) > FITS * (1 + fabs(q0[i])))
            return fail(&o->start.report, E_MODEL, "initial '%s' %.9g does not fit the loops%s, which make it %.9g",
                        m->coordinate[i].name, q0[i], drives, o->q[i]);
        if (m->said_v && m->said_v[iv] && fabs(v0[iv] - o->vt[iv]) > FITS * (1 + fabs(v0[iv])))
            return fail(&o->start.report, E_MODEL,
                        "initial rate of '%s' %.9g does not fit the loops%s, which make it %.9g", m->coordinate[i].name,
                        v0[iv], drives, o->vt[iv]);
    }
    return OK;
}

/* In later choices, too, elastic coordinates follow only where nothing else can. */
static void keep_elastic(struct condense *o)
{
    for (int i = 1; i < o->model->nbody; i++) {
        const struct model_body *b = &o->model->body[i];
        for (int k = 0; k < b->nmode && b->component >= 0; k++)
            o->part[b->component].weight[o->rows.column[b->mode_v[k]]] = o->model->follow[b->mode_v[k]];
    }
}

/* By how much the dropped rows' rates miss for the velocities o->vt, at the posture looked at; the worst. */
static double dropped_rate(const struct condense *o, int *worst)
{
    const struct loops *l = o->loops;
    double most = 0;
    for (int i = 0; i < o->npart; i++) {
        const struct part *c = &o->part[i];
        for (int r = c->nr; r < c->of->nrow; r++) {
            const int row = c->of->row[c->kept[r]], loop = l->row[row].loop;
            double rate = -l->c1[row];
            for (int k = 0; k < l->nk[loop]; k++)
                rate += l->Cq[loop][(row - l->first[loop]) * l->nk[loop] + k] * o->vt[l->k[loop][k]];
            if (fabs(rate) > most) most = fabs(rate), *worst = row;
        }
    }
    return most;
}

/* Drives that ask for more than the mechanism has freedoms must agree at the start. */
static enum status contradiction(struct condense *o)
{
    static const double DISAGREE = 1e-6; /* |C|, and |C'| per second */
    struct trouble why;
    int row = 0;
    rows_misfit(o->C, &row, &o->rows, o->q);
    double by = dropped_miss(o, &row), rate = 0;
    if (by <= DISAGREE) {
        condense_rates(o, o->vt, NULL, o->q, o->v, NULL, o->model->t0, &why);
        rate = dropped_rate(o, &row);
        if (rate <= DISAGREE) return OK;
    }
    return fail(&o->start.report, E_MODEL,
                "%s '%s' contradicts the others at t = %.9g: by %.3g of the mechanism's size%s",
                o->model->loop[o->loops->row[row].loop].drive ? "drive" : "constraint", row_name(o, row), o->model->t0,
                rate > 0 ? rate : by, rate > 0 ? " per second" : "");
}

/* Drives begin where they are drawn. */
static enum status draw_drives(struct condense *o)
{
    struct loops *l = o->loops;
    int row;
    struct trouble why;
    if (o->model->ndrive == 0) return OK;
    loops_when(l, o->model->t0);
    if (condense_driven(o, false, o->model->t0, &why) != OK)
        return fail(&o->start.report, E_MODEL, "drive '%s' or a rate of it is not a number at t = %.9g",
                    o->model->loop[why.index].name, o->model->t0);
    for (int i = 0; i < l->nrow; i++) l->c[i] = 0;
    rows_misfit(o->C, &row, &o->rows, o->q);
    for (int i = 0; i < l->nrow; i++)
        if (o->model->loop[l->row[i].loop].drive) l->drawn[i] = o->C[i];
    l->share = 0;
    loops_when(l, o->model->t0);
    return OK;
}

/* Were rows dropped where a drive has a say? */
static bool is_contested(const struct condense *o)
{
    bool any = false;
    for (int i = 0; i < o->npart; i++) {
        const struct part *c = &o->part[i];
        bool led = false;
        for (int r = 0; r < c->of->nrow; r++) led |= o->model->loop[o->loops->row[c->of->row[r]].loop].drive != NULL;
        any |= led && c->nr < c->of->nrow;
    }
    return any;
}

/* The deck's start, which fits or is refused. */
static enum status place_start(struct condense *o, const double *q0, const double *v0)
{
    int row;
    TRY(assemble(o));
    TRY(go_to_start(o, q0));
    TRY(split_all(o, o->q, rows_misfit(o->C, &row, &o->rows, o->q)));
    for (int i = 0; i < o->ode.n; i++) o->v[i] = v0[o->ind[i]];
    return agrees(o, q0, v0);
}

/* The deck's start, made to fit. */
static enum status project_start(struct condense *o, const double *q0, const double *v0)
{
    int row;
    TRY(condense_assemble(o, o->way, q0, v0));
    TRY(split_all(o, o->q, rows_misfit(o->C, &row, &o->rows, o->q)));
    for (int i = 0; i < o->ode.n; i++) o->v[i] = o->way[o->ind[i]];
    return look_for_branches(o);
}

enum status condense_begin(struct condense *o, const double *q0, const double *v0)
{
    for (int i = 0; i < o->moves->nturn; i++) o->q[o->moves->turn[i].iq[0]] = 1;
    TRY(draw_drives(o));
    TRY(o->model->assemble ? project_start(o, q0, v0) : place_start(o, q0, v0));
    if (o->ode.n == 0 && o->model->ndrive == 0)
        return fail(&o->start.report, E_MODEL, "nothing can move: the loops leave 0 freedoms");
    if (is_contested(o)) TRY(contradiction(o));
    o->holds = o->start.redundant ? fmax(WATCHED, 10 * o->start.misfit) : 0;
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        for (int k = 0; k < c->of->nk; k++) c->weight[k] = o->model->urgent[c->of->k[k]] ? KEEP_FAST : 1;
        c->gain = component_gain(o, c);
    }
    keep_elastic(o);
    return OK;
}
