/* condense_start.c -- from the drawn position to a closed start, or the reason why there is none.
 *
 * In order: the loops as drawn miss by little and are closed (rank, split, Newton); dropped rows hold a small way off
 * as well, or the rank drops at this posture only; the independent coordinates go to where `initial:` puts them; what
 * it says of the others must fit. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "loop/condense_parts.h"

static const double RANK = 1e-8;     /* least pivot over the first one */
static const double ASSEMBLY = 1e-3; /* |C| closed at all */
static const double WATCHED = 1e-5;  /* |C| up to which dropped rows hold on the way */

const char *condense_row_name(const struct condense *o, int row)
{
    return o->model->loop[o->rows.loops->row[row].loop].name;
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

struct report *condense_blame(struct condense *o, int loop)
{
    o->start.blamed = loop;
    return &o->start.report;
}

struct report *condense_blame_row(struct condense *o, int row)
{
    return condense_blame(o, o->rows.loops->row[row].loop);
}

/* The deck's choice leaves C_qd singular: names a coordinate that must follow, and one that may lead. */
static enum status refuse_choice(struct condense *o, struct part *p, int asked)
{
    int instead = -1, chosen = 0;
    for (int k = 0; k < p->of->nk; k++) p->weight[k] = 1, chosen += chosen_by_deck(o, p->of->k[k]);
    split_choose(&o->split, p, o->rows.size, 1);
    for (int j = 0; j < p->ni && instead < 0; j++)
        if (!chosen_by_deck(o, p->ind[j])) instead = p->ind[j];
    if (instead < 0 || chosen > p->ni)
        return fail(condense_blame(o, BLAME_PARTITION), E_MODEL,
                    "'%s' cannot be independent: its loops leave %d freedom%s, and 'independent' has %d; take one out",
                    place_name(o->model, asked), p->ni, p->ni == 1 ? "" : "s", chosen);
    return fail(
        condense_blame(o, BLAME_PARTITION), E_MODEL,
        "'%s' cannot be independent in this posture: it is at a dead point, and the others do not follow from it; "
        "choose '%s' in its place",
        place_name(o->model, asked), place_name(o->model, instead));
}

/* The deck's coordinate that makes the split impossible or all but singular; -1: none. */
static int to_blame(const struct condense *o, const struct part *p)
{
    static const double SINGULAR = 1e-7;
    for (int r = 0; r < p->nr; r++)
        if (chosen_by_deck(o, p->dep[r])) return p->dep[r];
    for (int j = 0; j < p->ni && p->chosen < SINGULAR; j++)
        if (chosen_by_deck(o, p->ind[j])) return p->ind[j];
    return -1;
}

/* Ranks and splits at q, where the loops miss by so much, of coordinates that follow readily or not. */
static enum status split_all(struct condense *o, const double *follow, const double *q, double miss)
{
    rows_linearize(&o->rows, q);
    o->start.redundant = 0;
    for (int i = 0; i < o->split.npart; i++) {
        struct part *p = &o->split.part[i];
        int urgent = 0;
        p->nr = split_rank(&o->split, p, fmax(RANK, fmin(30 * miss, 1e-2)));
        p->ni = p->of->nk - p->nr;
        for (int k = 0; k < p->of->nk; k++) urgent += o->model->urgent[p->of->k[k]];
        p->nfast = urgent < p->ni ? urgent : p->ni;
        for (int k = 0; k < p->of->nk; k++) p->weight[k] = follow[p->of->k[k]];
        condense_choose(o, i, o->rows.size, 1);
        o->start.redundant += p->of->nrow - p->nr;
        const int asked = follow == o->model->follow ? to_blame(o, p) : -1;
        if (asked >= 0) return refuse_choice(o, p, asked);
    }
    condense_number(o);
    return OK;
}

/* The largest of the redundant rows in C [rows]; the worst. */
double condense_redundant_miss(int *worst, const struct split *split, const double *C)
{
    double most = 0;
    for (const struct part *p = split->part; p < split->part + split->npart; p++)
        for (int r = p->nr; r < p->of->nrow; r++)
            if (fabs(C[p->row[r]]) > most) most = fabs(C[p->row[r]]), *worst = p->row[r];
    return most;
}

/* o->q := o->q (+) dx, its dependents closed; 0: it cannot be. */
static int step_to(struct condense *o, double *dx)
{
    if (!closing_close(&o->closing, o->qtry, &o->lost, &(struct way){.base = o->q, .s = 1, .dx = dx}, 0)) return 0;
    memcpy(o->q, o->qtry, sizeof *o->q * (size_t)o->model->nq);
    return 1;
}

static enum status assemble(struct condense *o)
{
    struct condense_start *s = &o->start;
    double miss = s->misfit = rows_misfit(o->C, &s->misfit_row, &o->rows, o->q);
    if (!(miss <= ASSEMBLY))
        return fail(
            condense_blame_row(o, s->misfit_row), E_MODEL,
            "constraint '%s' closes a loop, and as drawn its bodies miss each other by %.3g of the mechanism's "
            "size (up to %g is closed): mend the places that the deck gives, or 'initial: {assemble: true}' moves "
            "the bodies",
            condense_row_name(o, s->misfit_row), miss, ASSEMBLY);
    for (int pass = 0; pass < 2; pass++) {
        TRY(split_all(o, o->model->follow_q, o->q, miss));
        memset(o->dx, 0, sizeof *o->dx * (size_t)o->rows.n);
        if (!step_to(o, o->dx))
            return fail(condense_blame_row(o, s->misfit_row), E_MODEL,
                        "constraint '%s' cannot close its loop near the posture as drawn, which misses by %.3g of the "
                        "mechanism's size: mend the places that the deck gives",
                        condense_row_name(o, s->misfit_row), s->misfit);
        for (int i = 0; i < o->rows.n; i++)
            if (fabs(o->dx[i]) > s->moved) s->moved = fabs(o->dx[i]), s->moved_at = i;
        int row = 0;
        miss = rows_misfit(o->C, &row, &o->rows, o->q);
        if (condense_redundant_miss(&row, &o->split, o->C) > fmax(1e-9, 3 * s->misfit))
            return fail(
                condense_blame_row(o, row), E_MODEL,
                "constraint '%s' contradicts the others by %.3g of the mechanism's size: they hold the same freedom; "
                "make their places agree, or take one out",
                condense_row_name(o, row), miss);
    }
    return condense_search_branches(o);
}

/* How far it is from o->q to q0, drives too, in scales; the way goes to `way`. */
static double way_to(double *way, const struct condense *o, const double *q0)
{
    const struct loops *l = o->rows.loops;
    const int *ind = o->split.ind;
    double most = 0;
    moves_diff(&o->tree->moves, way, q0, o->q);
    for (int i = 0; i < o->ode.n; i++) most = fmax(most, fabs(way[ind[i]]) / o->rows.size[ind[i]]);
    for (int i = 0; i < l->nrow; i++) most = fmax(most, fabs(l->c[i] - l->drawn[i]));
    return most;
}

/* From the drawn position to where `initial:` puts the independent coordinates, in small steps on the same branch. */
static enum status go_to_start(struct condense *o, const double *q0)
{
    enum { STEPS = 50 };
    loops_when(o->rows.loops, o->model->t0, 0);
    if (condense_closed(o, q0)) {
        memcpy(o->q, q0, sizeof *q0 * (size_t)o->model->nq);
        return OK;
    }
    if (way_to(o->to, o, q0) == 0) return OK;
    for (int k = 0; k < STEPS; k++) {
        loops_partly(o->rows.loops, o->model->t0, (k + 1.) / STEPS);
        memset(o->dx, 0, sizeof *o->dx * (size_t)o->rows.n);
        for (int i = 0; i < o->ode.n; i++) o->dx[o->split.ind[i]] = o->to[o->split.ind[i]] / STEPS;
        int closed = closing_tangent(&o->closing, o->q);
        if (closed) closing_predict(&o->closing, o->dx);
        if (!closed || !step_to(o, o->dx))
            return fail(
                condense_blame(o, o->lost.loop), E_MODEL,
                "the start that 'initial' and the drives ask for cannot be reached: constraint '%s' locks at %d %% of "
                "the way from the drawn position; ask for less, or draw the mechanism nearer to it",
                o->model->loop[o->lost.loop].name, 100 * k / STEPS);
    }
    for (int i = 0; i < o->model->nq; i++) { /* exactly what the deck says */
        int iv = o->model->coordinate[i].iv;
        if (iv >= 0 && o->split.slot[iv] >= 0) o->q[i] = q0[i];
    }
    memset(o->dx, 0, sizeof *o->dx * (size_t)o->rows.n);
    if (step_to(o, o->dx)) return OK;
    return fail(condense_blame(o, o->lost.loop), E_MODEL,
                "constraint '%s' cannot be closed where 'initial' puts the mechanism; draw it nearer to that",
                o->model->loop[o->lost.loop].name);
}

enum status condense_start_rates(struct condense *o, double *vt)
{
    if (condense_rates(o, vt, NULL, o->q, o->v, NULL, o->model->t0, NULL) == OK) return OK;
    return fail(
        &o->start.report, E_MODEL,
        "the mechanism stands at a dead point: its rates do not follow from each other; draw it in another posture, or "
        "set 'initial:' a little to one side [dead-point]");
}

/* What `initial:` says must fit the start o->q and its velocities vt. */
static enum status agrees(struct condense *o, const double *vt, const double *q0, const double *v0)
{
    static const double FITS = 1e-6;
    char drives[60] = "";
    const struct model *m = o->model;
    if (m->ndrive) snprintf(drives, sizeof drives, " and drives at t = %.9g", m->t0);
    for (int i = 0; i < m->ncoordinate; i++) {
        int iv = m->coordinate[i].iv;
        if (iv < 0) continue;
        if (m->given_q && m->given_q[i] && fabs(q0[i] - o->q[i]) > FITS * (1 + fabs(q0[i])))
            return fail(
                condense_blame(o, BLAME_INITIAL), E_MODEL,
                "initial '%s' %.9g does not fit the loops%s, which make it %.9g: leave it out, or add 'assemble: true'",
                m->coordinate[i].name, q0[i], drives, o->q[i]);
        if (m->given_v && m->given_v[iv] && fabs(v0[iv] - vt[iv]) > FITS * (1 + fabs(v0[iv])))
            return fail(condense_blame(o, BLAME_INITIAL), E_MODEL,
                        "initial rate of '%s' %.9g does not fit the loops%s, which make it %.9g: leave it out, or add "
                        "'assemble: true'",
                        m->coordinate[i].name, v0[iv], drives, vt[iv]);
    }
    return OK;
}

/* In later choices, too, elastic coordinates follow only where nothing else can. */
static void keep_elastic(struct condense *o)
{
    for (int i = 1; i < o->model->nbody; i++) {
        const struct model_body *b = &o->model->body[i];
        for (int k = 0; k < b->nmode && b->component >= 0; k++)
            o->split.part[b->component].weight[o->rows.column[b->mode_v[k]]] = o->model->follow[b->mode_v[k]];
    }
}

/* o->to [nt]: the velocities of the whole tree at o->q, those that the deck gives leading. */
static enum status lead_rates(struct condense *o, const double *v0, double miss)
{
    TRY(split_all(o, o->model->follow_v, o->q, miss));
    for (int i = 0; i < o->ode.n; i++) o->v[i] = v0[o->split.ind[i]];
    return condense_start_rates(o, o->to);
}

/* A posture where branches meet, and rates that say along which one it goes: the start is a little way along them, where
 * the loops have their rank.  False: they do not, or what closes there is another branch. */
static bool start_on_branch(struct condense *o, const double *q0, const double *v0)
{
    static const double BESIDE = 1e-6, SAME = 1e-2;
    double *flat = o->side[0], *vt = o->vt, most = 0;
    if (way_to(o->to, o, q0) > 0 || lead_rates(o, v0, 0) != OK || agrees(o, o->to, q0, v0) != OK) return false;
    for (int i = 0; i < o->rows.n; i++) most = fmax(most, fabs(o->to[i]) * o->rows.per[i]);
    if (most == 0) return false;
    memcpy(vt, o->to, sizeof *vt * (size_t)o->rows.n);
    memcpy(flat, o->q, sizeof *flat * (size_t)o->model->nq);
    moves_point(&o->tree->moves, o->q, flat, vt, BESIDE / most);
    memset(o->dx, 0, sizeof *o->dx * (size_t)o->rows.n);
    if (split_all(o, o->model->follow, o->q, 0) != OK || !step_to(o, o->dx)) return false;
    moves_diff(&o->tree->moves, o->to, o->q, flat);
    for (int i = 0; i < o->rows.n; i++)
        if (!(fabs(o->to[i] - BESIDE / most * vt[i]) <= SAME * BESIDE * o->rows.size[i])) return false;
    for (int i = 0; i < o->ode.n; i++) o->v[i] = vt[o->split.ind[i]];
    o->start.beside = BESIDE;
    return true;
}

/* The deck's start, made to fit. */
static enum status project_start(struct condense *o, const double *q0, const double *v0)
{
    int row;
    TRY(condense_assemble(o, o->to, q0, v0));
    TRY(split_all(o, o->model->follow, o->q, rows_misfit(o->C, &row, &o->rows, o->q)));
    for (int i = 0; i < o->ode.n; i++) o->v[i] = o->to[o->split.ind[i]];
    return condense_search_branches(o);
}

/* Drawn where branches meet, and more coordinates given than there are freedoms: they name one, if all of them fit. */
static bool start_named(struct condense *o, const double *q0, const double *v0)
{
    const struct model *m = o->model;
    int given = 0;
    for (int i = 0; i < m->ncoordinate && m->given_q; i++) given += m->coordinate[i].iv >= 0 && m->given_q[i];
    if (given < 2 || project_start(o, q0, v0) != OK || given <= o->ode.n) return false;
    o->start.misfit = o->start.moved = 0; /* of nothing that is drawn */
    return condense_start_rates(o, o->to) == OK && agrees(o, o->to, q0, v0) == OK;
}

/* The deck's start, which fits or is refused.  What it gives leads the way there, whatever is independent then. */
static enum status place_start(struct condense *o, const double *q0, const double *v0)
{
    const struct model *m = o->model;
    int row;
    const enum status assembled = assemble(o);
    const struct report refused = o->start.report;
    const int blamed = o->start.blamed;
    o->start.report = (struct report){0};
    if (assembled == E_MODEL && o->start.branches && (start_on_branch(o, q0, v0) || start_named(o, q0, v0))) return OK;
    o->start.report = refused;
    o->start.blamed = blamed;
    TRY(assembled);
    TRY(go_to_start(o, q0));
    const double miss = rows_misfit(o->C, &row, &o->rows, o->q);
    TRY(lead_rates(o, v0, miss));
    TRY(agrees(o, o->to, q0, v0));
    TRY(split_all(o, m->follow, o->q, miss));
    for (int i = 0; i < o->ode.n; i++) {
        const int iv = o->split.ind[i];
        o->v[i] = m->given_v && m->given_v[iv] ? v0[iv] : o->to[iv];
    }
    return OK;
}

enum status condense_begin(struct condense *o, const double *q0, const double *v0)
{
    for (int i = 0; i < o->tree->moves.nturn; i++) o->q[o->tree->moves.turn[i].iq[0]] = 1;
    TRY(condense_draw_drives(o));
    TRY(o->model->assemble ? project_start(o, q0, v0) : place_start(o, q0, v0));
    if (o->ode.n == 0 && o->model->ndrive == 0)
        return fail(
            &o->start.report, E_MODEL,
            "nothing can move: the loops leave 0 freedoms; take out a constraint that holds too much, or drive the "
            "mechanism");
    TRY(condense_agree(o));
    TRY(condense_start_rates(o, o->vt));
    o->holds = o->start.redundant ? fmax(WATCHED, 10 * o->start.misfit) : 0;
    for (int i = 0; i < o->split.npart; i++) {
        struct part *p = &o->split.part[i];
        for (int k = 0; k < p->of->nk; k++) p->weight[k] = 1;
        condense_watch(o, i);
    }
    keep_elastic(o);
    return OK;
}
