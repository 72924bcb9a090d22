/* closing.c -- see closing.h */
#include "loop/closing.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/scalar.h"
#include "la/rot.h"

/* --- the tangent -------------------------------------------------------------------------------- */

/* T of the posture that is factored, s of q: of the postures alone, to the last bit, whenever drives are asked for. */
static void lead_from(struct closing *o, const double *q)
{
    const struct loops *l = o->rows->loops;
    if (l->model->ndrive == 0) return;
    for (int i = 0; i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        struct tangent *t = &o->tangent[i];
        for (int k = 0; k < p->nlead; k++) {
            const int row = p->row[p->lead[k]];
            double *x = t->T + (size_t)k * (size_t)p->nr;
            memset(x, 0, sizeof *x * (size_t)p->nr);
            x[p->lead[k]] = 1;
            factor_solve(&o->solve->block[i].C_qd, x);
            t->s[k] = loops_measure_at(l, l->row[row].loop, q);
        }
    }
}

static struct made take_base(struct closing *o, const double *q)
{
    return (struct made){posture_take(&o->base, q, o->rows->tree->model->nq), o->split->number};
}

static bool is_made(const struct closing *o, struct made now)
{
    return now.posture == o->made.posture && now.split == o->made.split;
}

/* The tangent of what is factored, as that at q. */
static void tangent_from(struct closing *o, const double *q)
{
    for (int i = 0; i < o->split->npart; i++) {
        if (o->split->part[i].wide)
            factor_copy(&o->tangent[i].C_qd, &o->solve->block[i].C_qd);
        else
            factor_G(&o->solve->block[i].C_qd, o->tangent[i].G);
    }
    lead_from(o, q);
}

int closing_tangent(struct closing *o, const double *q)
{
    const int nq = o->rows->tree->model->nq;
    const struct made now = take_base(o, q);
    if (is_made(o, now)) return 1;
    o->made.posture = 0;
    if (solve_factor(o->solve, posture_is(&o->about, q, nq) ? o->at : q, 0, NULL) != OK) return 0;
    tangent_from(o, q);
    o->made = now;
    return 1;
}

int closing_tangent_about(struct closing *o, const double *q)
{
    static const double NEAR = 1e-6; /* it turns by as little: nothing beside what it misses at the end of a step */
    const int nq = o->rows->tree->model->nq;
    o->about.number = 0;
    if (o->factored) (void)solve_factor(o->solve, o->solve->at, 0, NULL); /* as the run before has left it */
    o->factored = false;
    if (!o->plain || !solve_is_near(o->solve, o->full, q, NEAR)) return closing_tangent(o, q);
    posture_take(&o->about, q, nq);
    memcpy(o->at, o->solve->at, sizeof *o->at * (size_t)nq);
    o->made = take_base(o, q);
    tangent_from(o, q);
    return 1;
}

void closing_find_bend(struct closing *o, const double *v, const double *a)
{
    const size_t bytes = sizeof *v * (size_t)o->rows->n;
    o->bends = true;
    memcpy(o->along, v, bytes);
    memcpy(o->bend, a, bytes);
    solve_follow(o->solve, o->bend, o->rows->loops->c2);
    for (int i = 0; i < o->rows->n; i++) o->bend[i] = a[i] - o->bend[i];
}

void closing_bend(struct closing *o, const double *v, const double *a)
{
    static const double NEAR = 1e-9; /* a first correction that is also the last */
    o->bends = false;
    if (o->first > NEAR) closing_find_bend(o, v, a);
}

/* h of a way h v of some coordinates; 0: it does not go along v. */
struct along {
    double xx, xv, vv;
};

static void add_along(struct along *a, const struct closing *o, const double *way, const int *at, int n)
{
    const double *per = o->rows->per, *v = o->along;
    for (int i = 0; i < n; i++) {
        const double x = way[at[i]] * per[at[i]], y = v[at[i]] * per[at[i]];
        a->xx += x * x;
        a->xv += x * y;
        a->vv += y * y;
    }
}

static double step_along(const struct closing *o, const struct part *p, const double *way)
{
    static const double PARALLEL = .98; /* square of the cosine */
    struct along a = {0, 0, 0};
    add_along(&a, o, way, p->ind, p->ni);
    add_along(&a, o, way, p->dep, p->nr);
    return a.xv * a.xv > PARALLEL * a.xx * a.vv ? a.xv / a.vv : 0;
}

/* dx of the dependents off the tangent, h^2/2 of their bend, where the way goes along the velocities: h v, or so; by how much, in
 * scales. */
double closing_follow_bend(const struct closing *o, double *dx, const double *way)
{
    const double *per = o->rows->per;
    double far = 0;
    for (int i = 0; o->bends && i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        const double h = step_along(o, p, way), s = h * h / 2;
        for (int r = 0; s > 0 && r < p->nr; r++) {
            const int k = p->dep[r];
            const double off = s * o->bend[k];
            dx[k] += off;
            far = larger(far, fabs(off) * per[k]);
        }
    }
    return far;
}

void closing_recall(struct closing *o, struct recall *r)
{
    const int nq = o->rows->tree->model->nq;
    if (!r->back) o->factored = solve_is_near(o->solve, o->full, o->solve->at, 0);
    recall_within(r, "tangent");
    if (r->amid) {
        recall_one(r, "factored", o->factored);
        recall_list(r, "factored_at", o->solve->at, nq);
        recall_one(r, "first", o->first);
    }
    recall_one(r, "about", o->about.number);
    recall_list(r, "base", o->about.q, nq);
    recall_list(r, "at", o->at, nq);
    recall_one(r, "bends", o->bends);
    recall_list(r, "along", o->along, o->rows->n);
    recall_list(r, "bend", o->bend, o->rows->n);
    recall_without(r);
    if (r->back)
        o->made.posture = 0;
    else
        o->factored = false;
}

double closing_gain(const struct closing *o, int i)
{
    const struct part *p = &o->split->part[i];
    assert(o->made.posture && o->made.split == o->split->number);
    return p->wide ? split_gain_estimate(o->split, p, &o->tangent[i].C_qd) : split_gain(o->split, p, o->tangent[i].G);
}

void closing_predict(const struct closing *o, double *dx)
{
    const double *c = o->rows->loops->c;
    assert(o->made.posture && o->made.split == o->split->number);
    for (int i = 0; i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        const struct tangent *t = &o->tangent[i];
        if (p->wide) {
            for (int j = 0; j < p->ni; j++) o->y[j] = dx[p->ind[j]];
            factor_times_G(&t->C_qd, o->x, o->y);
        }
        for (int r = 0; r < p->nr; r++) {
            double sum = p->wide ? o->x[r] : 0;
            for (int j = 0; !p->wide && j < p->ni; j++) sum += t->G[r + (size_t)j * (size_t)p->nr] * dx[p->ind[j]];
            for (int k = 0; k < p->nlead; k++) sum += t->T[r + k * p->nr] * (c[p->row[p->lead[k]]] - t->s[k]);
            dx[p->dep[r]] = sum;
        }
    }
}

/* --- Newton's method ---------------------------------------------------------------------------- */

void closing_put(const struct closing *o, double *q1, const struct way *way)
{
    const struct moves *moves = &o->rows->tree->moves;
    moves_point(moves, q1, way->base, way->dx, 1);
    for (int i = 0; way->s != 1 && i < moves->nturn; i++) {
        const struct turn *t = &moves->turn[i];
        if (o->split->follows[i]) continue;
        double q[4], phi[3];
        for (int k = 0; k < 4; k++) q[k] = way->base[t->iq[k]];
        for (int k = 0; k < 3; k++) phi[k] = way->full[t->iv[k]];
        quat_move(q, q, phi, way->s);
        for (int k = 0; k < 4; k++) q1[t->iq[k]] = q[k];
    }
}

double closing_correct(const struct closing *o, double *dx, const double *C)
{
    double most = 0, *x = o->x;
    const double *per = o->rows->per;
    assert(o->solve->factored.split == o->split->number);
    for (int i = 0; i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        const int n = p->nr, *row = p->row, *dep = p->dep;
        for (int r = 0; r < n; r++) x[r] = -C[row[r]];
        factor_solve(&o->solve->block[i].C_qd, x);
        for (int r = 0; r < n; r++) {
            const double size = fabs(x[r]) * per[dep[r]];
            dx[dep[r]] += x[r];
            if (size > most || isnan(size)) most = size;
        }
    }
    return most;
}

/* One Newton correction at q1 = base (+) dx, where C is what is missed; its size, or NAN. */
static double correct(struct closing *o, double *C, double *dx, const double *q1)
{
    rows_linearize(o->rows, q1);
    if (o->rows->constant)
        rows_values_at(C, o->rows, q1);
    else
        rows_values(C, o->rows);
    rows_turn(o->rows, dx, o->split->follows);
    return solve_as_it_is(o->solve, 0, NULL) == OK ? closing_correct(o, dx, C) : NAN;
}

/* What the loops miss by; the least of it on the way is kept. */
static double note(struct miss *miss, const struct rows *rows, const double *C)
{
    int row = 0;
    const double most = rows_worst(&row, rows, C);
    if (most < miss->by) *miss = (struct miss){rows->loops->row[row].loop, most};
    return most;
}

double closing_worth(const struct closing *o)
{
    const double ratio = solve_ratio(o->solve);
    return ratio * sqrt(ratio);
}

enum way_end closing_close(struct closing *o, double *q1, struct miss *miss, const struct way *way, double ajar)
{
    static const double CLOSED = 1e-9;     /* a Newton correction below this leaves its square */
    static const double NOTHING = 1e-15;   /* and one that is round-off */
    static const double ROUND_OFF = 1e-15; /* |C| that no correction makes less: C_qd is nearly singular */
    static const double FAR = 1;           /* a correction this large after two iterations leads elsewhere */
    enum { MOST_ITERATIONS = 20 };
    miss->by = INFINITY;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        closing_put(o, q1, way);
        const double size = correct(o, o->C, way->dx, q1);
        if (i == 0) o->first = size;
        const bool whole = o->solve->factored.posture; /* C_q is that of no Cayley vectors */
        if (size > CLOSED && size <= ajar && whole && size <= ajar * closing_worth(o)) {
            closing_put(o, q1, way);
            return WAY_AJAR;
        }
        const double left = size <= CLOSED ? 0 : note(miss, o->rows, o->C);
        if (!isfinite(size) || (i >= 2 && size > FAR)) return WAY_LOST;
        if (size <= NOTHING) return WAY_CLOSED;
        if (size > CLOSED && left > ROUND_OFF) continue;
        closing_put(o, q1, way);
        return WAY_CLOSED;
    }
    return WAY_LOST;
}

/* Where C_q is the same everywhere: all that is missed at the base goes in one correction. */
static int go_straight(struct closing *o, double *q1, struct miss *miss, const struct way *way)
{
    const struct made *factored = &o->solve->factored;
    if (!(factored->posture && factored->split == o->split->number) && solve_factor(o->solve, way->base, 0, NULL) != OK)
        return 0;
    rows_values_at(o->C, o->rows, way->base);
    for (int i = 0; i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        double *x = o->x;
        for (int r = 0; r < p->nr; r++) x[r] = -o->C[p->row[r]];
        factor_take(&o->solve->block[i].C_qd, x, way->dx);
        factor_solve(&o->solve->block[i].C_qd, x);
        for (int r = 0; r < p->nr; r++) way->dx[p->dep[r]] = x[r];
        for (int r = 0; r < p->nr; r++)
            if (!isfinite(x[r])) *miss = (struct miss){o->rows->loops->row[p->row[r]].loop, INFINITY};
        if (!isfinite(miss->by)) return 0;
    }
    closing_put(o, q1, way);
    return 1;
}

/* Where the motion of all that is driven is known. */
static int go_on(struct closing *o, double *q1, struct miss *miss, const double *q0, double s)
{
    moves_point(&o->rows->tree->moves, q1, q0, o->full, s);
    const int lost = solve_known(o->solve, q1);
    if (lost < 0) return 1;
    *miss = (struct miss){o->rows->loops->row[o->solve->known[lost].row].loop, INFINITY};
    return 0;
}

enum way_end closing_point(struct closing *o, double *q1, struct miss *miss, const double *q0, const double *dx,
                           double s, double ajar)
{
    split_spread(o->split, o->full, dx);
    if (o->rows->constant) miss->by = 0;
    if (o->solve->nknown) return go_on(o, q1, miss, q0, s) ? WAY_CLOSED : WAY_LOST;
    for (int i = 0; i < o->rows->n; i++) o->dx[i] = s * o->full[i];
    if (o->rows->constant)
        return go_straight(o, q1, miss, &(struct way){q0, o->full, s, o->dx}) ? WAY_CLOSED : WAY_LOST;
    if (!closing_tangent(o, q0)) return WAY_LOST;
    closing_predict(o, o->dx);
    closing_follow_bend(o, o->dx, o->dx);
    return closing_close(o, q1, miss, &(struct way){o->base.q, o->full, s, o->dx}, ajar);
}

/* --- building ----------------------------------------------------------------------------------- */

static void build_tangent(struct tangent *o, const struct part *p, const struct loops *l, struct arena *life)
{
    const struct component *c = p->of;
    int drives = 0;
    for (int r = 0; r < c->nrow; r++) drives += l->model->loop[l->row[c->row[r]].loop].drive != NULL;
    o->T = TAKE_MATRIX(life, double, drives, c->nrow);
    o->s = TAKE(life, double, drives);
    if (p->whole)
        store_for(&o->store, (size_t)c->nrow * (size_t)c->nk, life);
    else
        factor_build(&o->C_qd, p, TAKE(life, double, c->start[c->nrow]), life);
}

void closing_build(struct closing *o, struct solve *solve, struct arena *life)
{
    struct rows *rows = solve->rows;
    const struct split *split = solve->split;
    const int most = rows->n > rows->loops->nrow ? rows->n : rows->loops->nrow;
    *o = (struct closing){.rows = rows, .split = split, .solve = solve, .life = life};
    o->tangent = TAKE(life, struct tangent, split->npart);
    for (int i = 0; i < split->npart; i++) build_tangent(&o->tangent[i], &split->part[i], rows->loops, life);
    o->base.q = TAKE(life, double, rows->tree->model->nq);
    o->about.q = TAKE(life, double, rows->tree->model->nq);
    o->at = TAKE(life, double, rows->tree->model->nq);
    o->plain = loops_drive_coordinates(rows->loops);
    o->C = TAKE(life, double, rows->loops->nrow);
    o->x = TAKE(life, double, most);
    o->y = TAKE(life, double, most);
    o->along = TAKE(life, double, rows->n);
    o->bend = TAKE(life, double, rows->n);
    o->full = TAKE(life, double, rows->n);
    o->dx = TAKE(life, double, rows->n);
    o->last = TAKE(life, double, rows->n);
}

void closing_fit(struct closing *o, int i)
{
    const struct part *p = &o->split->part[i];
    struct tangent *t = &o->tangent[i];
    if (p->wide)
        factor_fit(&t->C_qd, o->life);
    else
        t->G = store_for(&t->store, (size_t)p->nr * (size_t)p->ni, o->life);
}
