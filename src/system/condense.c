/* condense.c -- see condense.h: partition, closure, condensation.
 *
 * Partition: for each component of loops, LU of C_q with full pivoting picks as many rows as the rank and
 * the columns of the dependent coordinates; a column is taken late if the deck would rather have it independent. */
#include "system/condense.h"

#include <math.h>
#include <string.h>

#include "la/pivot.h"
#include "la/rot.h"
#include "la/vec3.h"

static const double CLOSED = 1e-9;    /* a Newton correction below this leaves its square */
static const double RANK = 1e-8;      /* least pivot over the first one */
static const double NOTHING = 1e-10;  /* a pivot of round-off: C_q is scaled to numbers of order 1 */
static const double ASSEMBLY = 1e-3;  /* |C| closed at all */
static const double LARGE = 3;        /* rate of a dependent coordinate per unit: time to look for a better split */
static const double KEEP_FAST = 1e-2; /* weight of fast columns in later choices */
static const double FAR = 1;          /* a correction this large after two iterations leads elsewhere */
enum { MOST_ITERATIONS = 20 };

struct component {
    int nk, *k;       /* coordinates: places in v */
    int nrow, *row;   /* all its rows; the first nr of `kept` are used */
    int nr, *kept;    /* [nrow] numbers in `row` */
    int *dep, *ind;   /* [nr], [nk - nr]: numbers in k */
    int ni, nfast;    /* nk - nr; fast ones among them */
    double *F;        /* [nr x nk] kept rows of C_q */
    double *A;        /* [nr x nr] C_qd, factored */
    double *G, *G0;   /* [nr x ni] -C_qd^-1 C_qi; at the base of point() */
    int *prow, *pcol; /* [max(nrow, nk)] */
    int band[2];      /* of A */
    double *x;        /* [max(nrow, nk)] */
    double *whole;    /* [nrow x nk] */
    bool *dependent;  /* [nk] work of take_split() */
    int *loop_of;     /* [nk] the first loop that a coordinate is in */
    double *weight;   /* [nk] */
    double chosen;    /* pivot ratio when the partition was chosen */
    double gain;      /* least gain() since then */
};

struct condense {
    const struct model *model;
    const struct sweep_ops *ops;
    const struct ode2 *tree;
    const struct moves *moves;
    struct sweep *sweep;
    struct loops *loops, *seen; /* at trial states; where condense_push() stood */
    int nt, ncomponent;
    struct component *component;
    int *column;  /* [nt] number in its component's k */
    int *owner;   /* [nt] component; -1: in none */
    int *ind;     /* [n] places of the independent ones */
    int *slot;    /* [nt] number among the independent ones; -1: dependent */
    bool *bound;  /* [nturn] a rate of this rotation is dependent */
    double *size; /* [nt] scale of a coordinate: 1, or the loops' length */
    struct condense_start start;
    struct ode2 ode;
    struct ode2_chart chart;
    struct ode2_breaks breaks;
    long charts;
    double *q, *v; /* start */
    /* workspace */
    double *C, *C2;            /* [rows] */
    double *vt, *at, *rt;      /* [nt] */
    double *zero;              /* [nt] */
    double *dx, *dxs, *base;   /* [nt], [nt], [nq] */
    double *G0_at;             /* [nq] where G0 holds */
    double *M;                 /* [nt x nt] */
    double *last_dx, *last_dt; /* [n], [nt]: of the last point(), for rate() */
    double *last_q;            /* [nq] its end */
    double *qtry, *way;        /* [nq], [nt] */
    double *side[2];           /* [nq] postures beside a singular one */
    double *aside, *mean;      /* [nt] */
    double *M_side;            /* [nt x nt] */
    int *split;                /* a component's split, to go back to */
};

static struct condense *condense_of(const struct ode2 *o)
{
    return o->self;
}

/* --- C_q, its factor, G -------------------------------------------------------------------------- */

/* The numbers of row r (a number in c->row) of the component's part of C_q, into x[0], x[ld], ... */
static void put_row(const struct condense *o, const struct component *c, int r, double *x, int ld)
{
    const struct loops *l = o->loops;
    int loop = l->row[c->row[r]].loop, nk = l->nk[loop];
    const double *from = l->Cq[loop] + (c->row[r] - l->first[loop]) * nk;
    for (int k = 0; k < nk; k++) x[(size_t)o->column[l->k[loop][k]] * (size_t)ld] = from[k];
}

/* Columns of a rotation, along the Cayley vector phi from the base in place of the angular velocity:
 * F := F T^-1,  T^-1 = (1 - [phi]x/2)/(1 + |phi|^2/4). */
static void along_phi(const struct condense *o, const struct component *c, const struct turn *t, const double *dx)
{
    const double phi[3] = {dx[t->iv[0]], dx[t->iv[1]], dx[t->iv[2]]};
    const double s = 1 / (1 + v3_dot(phi, phi) / 4);
    double *col[3];
    for (int k = 0; k < 3; k++) col[k] = c->F + (size_t)o->column[t->iv[k]] * (size_t)c->nr;
    for (int i = 0; i < c->nr; i++) {
        const double f[3] = {col[0][i], col[1][i], col[2][i]};
        double x[3]; /* f' [phi]x = (f x phi)' */
        v3_cross(x, f, phi);
        for (int k = 0; k < 3; k++) col[k][i] = s * (f[k] - x[k] / 2);
    }
}

/* F, A, factored; dx: along the Cayley vectors it holds, NULL: at the posture itself.  0: singular or not finite. */
static int factor(struct condense *o, struct component *c, const double *dx)
{
    for (int r = 0; r < c->nr; r++) put_row(o, c, c->kept[r], c->F + r, c->nr);
    for (int i = 0; dx && i < o->moves->nturn; i++) {
        const struct turn *t = &o->moves->turn[i];
        if (o->bound[i] && o->owner[t->iv[0]] == (int)(c - o->component)) along_phi(o, c, t, dx);
    }
    for (int j = 0; j < c->nr; j++) {
        int from = j > c->band[1] ? j - c->band[1] : 0, to = j + c->band[0] < c->nr ? j + c->band[0] + 1 : c->nr;
        memcpy(c->A + (size_t)j * (size_t)c->nr + from, c->F + (size_t)c->dep[j] * (size_t)c->nr + from,
               sizeof *c->A * (size_t)(to - from));
    }
    return pivot_rows(c->A, c->prow, c->band, c->nr, c->nr) == c->nr;
}

static void solve(const struct component *c, double *x)
{
    pivot_rows_solve(c->A, c->prow, c->band, x, c->nr, c->nr);
}

static void make_G(const struct component *c, double *G)
{
    for (int j = 0; j < c->ni; j++) {
        double *g = G + (size_t)j * (size_t)c->nr;
        const double *f = c->F + (size_t)c->ind[j] * (size_t)c->nr;
        for (int i = 0; i < c->nr; i++) g[i] = -f[i];
        solve(c, g);
    }
}

/* Poses at q and C_q there. */
static void look(struct condense *o, const double *q, const double *v)
{
    o->ops->move(o->sweep, q, v, ALL);
    loops_look(o->loops, o->sweep);
    loops_jacobian(o->loops, o->sweep);
}

static enum status factor_all(struct condense *o, const double *q, double t, struct trouble *why)
{
    look(o, q, o->zero);
    for (int i = 0; i < o->ncomponent; i++)
        if (!factor(o, &o->component[i], NULL))
            return trouble_set(why, TROUBLE_CLOSURE, o->loops->row[o->component[i].row[0]].loop, NAN, t);
    return OK;
}

static void spread(const struct condense *o, double *xt, const double *x)
{
    memset(xt, 0, sizeof *xt * (size_t)o->nt);
    for (int i = 0; i < o->ode.n; i++) xt[o->ind[i]] = x[i];
}

/* x_d := -C_qd^-1 C_qi x_i, with the factors at hand. */
static void follow(struct condense *o, double *xt)
{
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        memset(c->x, 0, sizeof *c->x * (size_t)c->nr);
        for (int j = 0; j < c->ni; j++) {
            double xi = xt[c->k[c->ind[j]]];
            const double *f = c->F + (size_t)c->ind[j] * (size_t)c->nr;
            for (int r = 0; xi != 0 && r < c->nr; r++) c->x[r] -= f[r] * xi;
        }
        solve(c, c->x);
        for (int r = 0; r < c->nr; r++) xt[c->k[c->dep[r]]] = c->x[r];
    }
}

/* x_d := -C_qd^-1 C'' , C'' with x_d = 0: (C_q v)_q v + C_qi a_i. */
static void accelerate(struct condense *o, double *at)
{
    loops_second(o->C2, o->loops);
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        for (int r = 0; r < c->nr; r++) c->x[r] = -o->C2[c->row[c->kept[r]]];
        solve(c, c->x);
        for (int r = 0; r < c->nr; r++) at[c->k[c->dep[r]]] = c->x[r];
    }
}

enum status condense_rates(struct condense *o, double *vt, double *at, const double *q, const double *v,
                           const double *a, double t, struct trouble *why)
{
    TRY(factor_all(o, q, t, why));
    spread(o, vt, v);
    follow(o, vt);
    if (!at) return OK;
    if (a)
        spread(o, at, a);
    else
        memset(at, 0, sizeof *at * (size_t)o->nt);
    o->ops->forward(o->sweep, q, vt, at, ALL);
    loops_look(o->loops, o->sweep);
    accelerate(o, at);
    return OK;
}

/* Pivot ratio of C_qd as last factored, lengths scaled. */
static double ratio(const struct condense *o, const struct component *c)
{
    double least = INFINITY, most = 0;
    for (int j = 0; j < c->nr; j++) {
        double x = fabs(c->A[(size_t)j * (size_t)(c->nr + 1)]) * o->size[c->k[c->dep[j]]];
        least = fmin(least, x);
        most = fmax(most, x);
    }
    return c->nr == 0 ? 1 : most > 0 ? least / most : 0;
}

static void move_point(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s);

/* --- r, M^, slopes ------------------------------------------------------------------------------- */

/* lambda = -C_qd^-T r_d of one component, in c->x by dependent rows: row kept[i] has x[i]. */
static void multipliers(const struct component *c, const double *rt)
{
    for (int r = 0; r < c->nr; r++) c->x[r] = -rt[c->k[c->dep[r]]];
    pivot_rows_tsolve(c->A, c->prow, c->band, c->x, c->nr, c->nr);
}

/* r = r_i + C_qi' lambda */
static void gather(struct condense *o, double *r, const double *rt)
{
    for (int i = 0; i < o->ode.n; i++) r[i] = rt[o->ind[i]];
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        multipliers(c, rt);
        for (int j = 0; j < c->ni; j++) {
            const double *f = c->F + (size_t)c->ind[j] * (size_t)c->nr;
            double sum = 0;
            for (int k = 0; k < c->nr; k++) sum += f[k] * c->x[k];
            r[o->slot[c->k[c->ind[j]]]] += sum;
        }
    }
}

void condense_lambda(struct condense *o, double *lambda, const double *rt)
{
    memset(lambda, 0, sizeof *lambda * (size_t)o->loops->nrow);
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        multipliers(c, rt);
        for (int r = 0; r < c->nr; r++) lambda[c->row[c->kept[r]]] = c->x[r];
    }
}

/* The tree names a row by its place in the whole v. */
static enum status in_own_rows(const struct condense *o, enum status status, struct trouble *why)
{
    if (status != OK && why && why->code != TROUBLE_LAW && why->index >= 0) why->index = o->slot[why->index];
    return status;
}

static enum status resid_there(struct condense *o, double *r, double *w, double *dk, const struct instant *x,
                               unsigned cls, struct trouble *why)
{
    TRY(condense_rates(o, o->vt, o->at, x->q, x->v, x->a, x->t, why));
    struct instant whole = *x;
    whole.v = o->vt;
    whole.a = o->at;
    TRY(in_own_rows(o, o->tree->ops->resid(o->tree, o->rt, w, dk, &whole, cls, why), why));
    gather(o, r, o->rt);
    for (int i = 0; i < o->ode.n; i++)
        if (!isfinite(r[i])) return trouble_set(why, TROUBLE_NOT_FINITE, i, r[i], x->t);
    return OK;
}

/* Least pivot ratio at the posture last factored. */
static double least_ratio(const struct condense *o)
{
    double least = 1;
    for (int i = 0; i < o->ncomponent; i++) least = fmin(least, ratio(o, &o->component[i]));
    return least;
}

/* Postures on both sides of q, where C_qd is nearly singular: round-off eps of the closure would come into r as
 * eps/ratio^3.  r and M^ pass smoothly through such a posture, and their mean over the two sides differs from them by
 * ASIDE^2 only.  0: not nearly singular, or the sides are no better. */
static int look_aside(struct condense *o, const double *q)
{
    static const double NEARLY = 3e-4, ASIDE = 2e-3;
    const double here = least_ratio(o);
    struct trouble why;
    if (here >= NEARLY) return 0;
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < o->ode.n; i++) o->aside[i] = (side ? ASIDE : -ASIDE) * o->size[o->ind[i]];
        move_point(&o->ode, o->side[side], q, o->aside, 1);
        if (factor_all(o, o->side[side], 0, &why) != OK || least_ratio(o) < 2 * here) return 0;
    }
    return 1;
}

static enum status resid(const struct ode2 *ode, double *r, double *w, double *dk, const struct instant *x,
                         unsigned cls, struct trouble *why)
{
    struct condense *o = condense_of(ode);
    TRY(resid_there(o, r, w, dk, x, cls, why));
    if (!look_aside(o, x->q)) return OK;
    double w_side[2][POWER_CHANNELS];
    for (int side = 0; side < 2; side++) {
        struct instant there = *x;
        there.q = o->side[side];
        TRY(resid_there(o, side ? o->mean : r, w ? w_side[side] : NULL, dk, &there, cls, why));
    }
    for (int i = 0; i < ode->n; i++) r[i] = (r[i] + o->mean[i]) / 2;
    for (int i = 0; w && i < POWER_CHANNELS; i++) w[i] = (w_side[0][i] + w_side[1][i]) / 2;
    return OK;
}

/* X [nt x nt] := T' X T in place, its independent rows and columns; then moved together into Y [n x n]. */
static void congruence(struct condense *o, double *Y, double *X)
{
    const size_t nt = (size_t)o->nt, n = (size_t)o->ode.n;
    for (int i = 0; i < o->ncomponent; i++) {
        const struct component *c = &o->component[i];
        for (int j = 0; j < c->ni; j++)
            for (int r = 0; r < c->nr; r++) {
                double g = c->G[r + (size_t)j * (size_t)c->nr];
                double *to = X + nt * (size_t)c->k[c->ind[j]], *from = X + nt * (size_t)c->k[c->dep[r]];
                for (size_t k = 0; g != 0 && k < nt; k++) to[k] += g * from[k];
            }
    }
    for (int i = 0; i < o->ncomponent; i++) {
        const struct component *c = &o->component[i];
        for (int j = 0; j < c->ni; j++)
            for (int r = 0; r < c->nr; r++) {
                double g = c->G[r + (size_t)j * (size_t)c->nr];
                double *to = X + c->k[c->ind[j]], *from = X + c->k[c->dep[r]];
                for (size_t k = 0; g != 0 && k < n; k++) to[nt * (size_t)o->ind[k]] += g * from[nt * (size_t)o->ind[k]];
            }
    }
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) Y[i + n * j] = X[(size_t)o->ind[i] + nt * (size_t)o->ind[j]];
}

static enum status prepare_T(struct condense *o, const double *q, double t, struct trouble *why)
{
    TRY(factor_all(o, q, t, why));
    for (int i = 0; i < o->ncomponent; i++) make_G(&o->component[i], o->component[i].G);
    return OK;
}

static void symmetric(double *M, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) M[i + j * n] = M[j + i * n] = (M[i + j * n] + M[j + i * n]) / 2;
}

static enum status mass_there(struct condense *o, double *M, const double *q, double t, unsigned cls,
                              struct trouble *why)
{
    TRY(prepare_T(o, q, t, why));
    TRY(in_own_rows(o, o->tree->ops->mass(o->tree, o->M, q, t, cls, why), why));
    congruence(o, M, o->M);
    symmetric(M, o->ode.n);
    return OK;
}

static enum status mass(const struct ode2 *ode, double *M, const double *q, double t, unsigned cls, struct trouble *why)
{
    struct condense *o = condense_of(ode);
    const int nn = ode->n * ode->n;
    TRY(mass_there(o, M, q, t, cls, why));
    if (!look_aside(o, q)) return OK;
    TRY(mass_there(o, M, o->side[0], t, cls, why));
    TRY(mass_there(o, o->M_side, o->side[1], t, cls, why));
    for (int i = 0; i < nn; i++) M[i] = (M[i] + o->M_side[i]) / 2;
    return OK;
}

/* The change of G with q, which counts with the forces, is left out: modified Newton. */
static enum status slopes(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                          struct trouble *why)
{
    struct condense *o = condense_of(ode);
    TRY(prepare_T(o, x->q, x->t, why));
    spread(o, o->vt, x->v);
    follow(o, o->vt);
    struct instant whole = *x;
    whole.v = o->vt;
    whole.a = NULL;
    if (K) {
        TRY(in_own_rows(o, o->tree->ops->slopes(o->tree, o->M, NULL, &whole, cls, why), why));
        congruence(o, K, o->M);
    }
    if (C) {
        TRY(in_own_rows(o, o->tree->ops->slopes(o->tree, NULL, o->M, &whole, cls, why), why));
        congruence(o, C, o->M);
    }
    return OK;
}

static const struct ode2_ops ops = {.resid = resid, .mass = mass, .slopes = slopes};

/* --- positions ------------------------------------------------------------------------------------ */

/* q1 = base (+) dx; of rotations that are wholly independent the fraction s of the way. */
static void place(struct condense *o, double *q1, const double *base, double s)
{
    moves_point(o->moves, q1, base, o->dx, 1);
    for (int i = 0; s != 1 && i < o->moves->nturn; i++) {
        const struct turn *t = &o->moves->turn[i];
        if (o->bound[i]) continue;
        double q[4], phi[3];
        for (int k = 0; k < 4; k++) q[k] = base[t->iq[k]];
        for (int k = 0; k < 3; k++) phi[k] = o->dxs[t->iv[k]];
        quat_move(q, q, phi, s);
        for (int k = 0; k < 4; k++) q1[t->iq[k]] = q[k];
    }
}

/* One Newton correction of all dependents at q1 = base (+) dx; returns its size in scales. */
static double correct(struct condense *o, const double *q1, int *worst)
{
    double most = 0;
    look(o, q1, o->zero);
    loops_values(o->C, o->loops);
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        if (!factor(o, c, o->dx)) return *worst = o->loops->row[c->row[0]].loop, NAN;
        for (int r = 0; r < c->nr; r++) c->x[r] = -o->C[c->row[c->kept[r]]];
        solve(c, c->x);
        for (int r = 0; r < c->nr; r++) {
            int k = c->k[c->dep[r]];
            double size = fabs(c->x[r]) / o->size[k];
            o->dx[k] += c->x[r];
            if (size <= most) continue;
            most = size;
            *worst = o->loops->row[c->row[c->kept[r]]].loop;
        }
        if (!isfinite(most)) return NAN;
    }
    return most;
}

/* Closes q1 = base (+) dx by its dependents; 0: it cannot be. */
static int close_loops(struct condense *o, double *q1, const double *base, double s)
{
    int worst = 0;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        place(o, q1, base, s);
        double size = correct(o, q1, &worst);
        if (!isfinite(size) || (i >= 2 && size > FAR)) return 0;
        if (size > CLOSED) continue;
        place(o, q1, base, s);
        return 1;
    }
    return 0;
}

static int same_base(struct condense *o, const double *q)
{
    if (memcmp(q, o->G0_at, sizeof *q * (size_t)o->model->nq) == 0) return 1;
    o->G0_at[0] = NAN;
    struct trouble why;
    if (factor_all(o, q, 0, &why) != OK) return 0;
    for (int i = 0; i < o->ncomponent; i++) make_G(&o->component[i], o->component[i].G0);
    memcpy(o->G0_at, q, sizeof *q * (size_t)o->model->nq);
    return 1;
}

/* dx_i given, dx_d along the tangent at the base. */
static void predict(struct condense *o)
{
    for (int i = 0; i < o->ncomponent; i++) {
        const struct component *c = &o->component[i];
        for (int r = 0; r < c->nr; r++) {
            double sum = 0;
            for (int j = 0; j < c->ni; j++) sum += c->G0[r + (size_t)j * (size_t)c->nr] * o->dx[c->k[c->ind[j]]];
            o->dx[c->k[c->dep[r]]] = sum;
        }
    }
}

static void move_point(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s)
{
    struct condense *o = condense_of(ode);
    const size_t nq = (size_t)o->model->nq;
    memcpy(o->base, q0, sizeof *q0 * nq);
    spread(o, o->dxs, dx);
    for (int i = 0; i < o->nt; i++) o->dx[i] = s * o->dxs[i];
    int closed = same_base(o, o->base);
    if (closed) {
        predict(o);
        closed = close_loops(o, q1, o->base, s);
    }
    for (size_t i = 0; !closed && i < nq; i++) q1[i] = NAN;
    for (int i = 0; i < ode->n; i++) o->last_dx[i] = s * dx[i];
    memcpy(o->last_dt, o->dx, sizeof *dx * (size_t)o->nt);
    memcpy(o->last_q, q1, sizeof *q1 * nq);
}

static void move_diff(const struct ode2 *ode, double *dx, const double *q1, const double *q0)
{
    struct condense *o = condense_of(ode);
    moves_diff(o->moves, o->dxs, q1, q0);
    for (int i = 0; i < ode->n; i++) dx[i] = o->dxs[o->ind[i]];
}

/* A rotation that is independent in part turns with all of its angular velocity: that follows from the
 * posture, which must be that of the last point(), with the same dx. */
static void move_rate(const struct ode2 *ode, double *dxrate, const double *dx, const double *v)
{
    struct condense *o = condense_of(ode);
    struct trouble why;
    spread(o, o->dxs, dx);
    spread(o, o->vt, v);
    bool partly = false;
    for (int i = 0; i < o->moves->nturn; i++) partly |= o->bound[i];
    if (partly && memcmp(dx, o->last_dx, sizeof *dx * (size_t)ode->n) == 0) {
        memcpy(o->dxs, o->last_dt, sizeof *dx * (size_t)o->nt);
        condense_rates(o, o->vt, NULL, o->last_q, v, NULL, 0, &why);
    }
    moves_rate(o->moves, o->at, o->dxs, o->vt);
    for (int i = 0; i < ode->n; i++) dxrate[i] = o->at[o->ind[i]];
}

static const struct ode2_move move = {.point = move_point, .diff = move_diff, .rate = move_rate};

/* --- partition ------------------------------------------------------------------------------------ */

/* Columns of displacements times the length: all numbers of C_q are then of like size. */
static void whole_matrix(struct condense *o, struct component *c)
{
    memset(c->whole, 0, sizeof *c->whole * (size_t)c->nrow * (size_t)c->nk);
    for (int r = 0; r < c->nrow; r++) put_row(o, c, r, c->whole + r, c->nrow);
    for (int k = 0; k < c->nk; k++)
        for (int r = 0; r < c->nrow; r++) c->whole[r + (size_t)k * (size_t)c->nrow] *= o->size[c->k[k]];
}

static int rank_of(struct condense *o, struct component *c, double least)
{
    whole_matrix(o, c);
    int rank = pivot_lu(c->whole, c->prow, c->pcol, c->nrow, c->nk, c->nrow, NULL, c->nrow, least);
    while (rank > 0 && fabs(c->whole[(size_t)(rank - 1) * (size_t)(c->nrow + 1)]) < NOTHING) rank--;
    return rank;
}

/* x [n] sorted by key[x], the smallest first. */
static void sort_by(int *x, int n, const int *key)
{
    for (int i = 1; i < n; i++) {
        int here = x[i], k = i;
        for (; k > 0 && (key ? key[x[k - 1]] > key[here] : x[k - 1] > here); k--) x[k] = x[k - 1];
        x[k] = here;
    }
}

/* Where C_qd can have numbers; the rest of F and A is zero from now on. */
static void find_band(const struct condense *o, struct component *c)
{
    int below = 0, above = 0;
    memset(c->F, 0, sizeof *c->F * (size_t)c->nr * (size_t)c->nk);
    for (int r = 0; r < c->nr; r++) {
        int loop = o->loops->row[c->row[c->kept[r]]].loop;
        for (int j = 0; j < c->nr; j++)
            for (int k = 0; k < o->loops->nk[loop]; k++) {
                if (o->column[o->loops->k[loop][k]] != c->dep[j]) continue;
                if (r - j > below) below = r - j;
                if (j - r > above) above = j - r;
            }
    }
    c->band[0] = below;
    c->band[1] = above + below;
}

/* Splits the coordinates after pivot_lu has sorted them; fast ones first among the independent.  Rows and dependent
 * columns go from loop to loop, so that C_qd has its numbers near the diagonal. */
static void take_split(const struct condense *o, struct component *c)
{
    memcpy(c->kept, c->prow, sizeof *c->kept * (size_t)c->nrow);
    for (int k = 0; k < c->nk; k++) c->dependent[k] = false;
    for (int r = 0; r < c->nr; r++) {
        c->dep[r] = c->pcol[r];
        c->dependent[c->pcol[r]] = true;
    }
    sort_by(c->kept, c->nr, NULL);
    sort_by(c->dep, c->nr, c->loop_of);
    int n = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < c->nk; k++)
            if (!c->dependent[k] && o->model->urgent[c->k[k]] == (pass == 0)) c->ind[n++] = k;
    find_band(o, c);
}

static double quality(struct condense *o, struct component *c)
{
    return factor(o, c, NULL) ? ratio(o, c) : 0;
}

/* Numbers the independent coordinates: fast, then slow; coordinates in no loop are all independent.  A component
 * keeps its number of fast ones, whoever they are. */
static void number(struct condense *o)
{
    int n = 0;
    for (int i = 0; i < o->nt; i++) o->slot[i] = -1;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < o->nt; i++)
            if (o->owner[i] < 0 && o->model->urgent[i] == (pass == 0)) o->ind[n++] = i;
        for (int i = 0; i < o->ncomponent; i++) {
            const struct component *c = &o->component[i];
            for (int j = pass == 0 ? 0 : c->nfast; j < (pass == 0 ? c->nfast : c->ni); j++)
                o->ind[n++] = c->k[c->ind[j]];
        }
        if (pass == 0) o->ode.ns = n;
    }
    o->ode.n = n;
    for (int i = 0; i < n; i++) o->slot[o->ind[i]] = i;
    for (int i = 0; i < o->moves->nturn; i++) {
        o->bound[i] = false;
        for (int k = 0; k < 3; k++) o->bound[i] |= o->slot[o->moves->turn[i].iv[k]] < 0;
    }
    o->G0_at[0] = NAN;
}

/* The best split of a component at the present posture; how good it is. */
static double choose(struct condense *o, struct component *c)
{
    whole_matrix(o, c);
    pivot_lu(c->whole, c->prow, c->pcol, c->nrow, c->nk, c->nrow, c->weight, c->nr, 0);
    take_split(o, c);
    return quality(o, c);
}

static void keep_split(int *to, const struct component *c)
{
    memcpy(to, c->kept, sizeof *to * (size_t)c->nrow);
    memcpy(to + c->nrow, c->dep, sizeof *to * (size_t)c->nr);
    memcpy(to + c->nrow + c->nr, c->ind, sizeof *to * (size_t)c->ni);
}

static void put_back(const struct condense *o, struct component *c, const int *from)
{
    memcpy(c->kept, from, sizeof *from * (size_t)c->nrow);
    memcpy(c->dep, from + c->nrow, sizeof *from * (size_t)c->nr);
    memcpy(c->ind, from + c->nrow + c->nr, sizeof *from * (size_t)c->ni);
    find_band(o, c);
}

/* Largest rate of a dependent coordinate per unit of an independent one, in scales. */
static double gain(const struct condense *o, struct component *c)
{
    double most = 0;
    make_G(c, c->G);
    for (int j = 0; j < c->ni; j++)
        for (int r = 0; r < c->nr; r++) {
            double g = c->G[r + (size_t)j * (size_t)c->nr] * o->size[c->k[c->ind[j]]] / o->size[c->k[c->dep[r]]];
            most = fmax(most, fabs(g));
        }
    return most;
}

/* A new split, if dependent coordinates have come to run away from the independent ones and there is a better one.
 * Where all splits are singular alike, as in a flat posture, the rates stay moderate and nothing changes. */
static int improve(struct condense *o, struct component *c)
{
    double now = gain(o, c);
    c->gain = fmin(c->gain, now);
    if (now <= fmax(LARGE, 2 * c->gain)) return 0;
    keep_split(o->split, c);
    c->gain = choose(o, c) > 0 ? gain(o, c) : INFINITY;
    if (c->gain < now / 2) return 1;
    put_back(o, c, o->split);
    c->gain = now;
    return 0;
}

/* Between major steps: whole velocities first, then the splits, then the velocities of the new independent ones. */
static int rechart(struct ode2 *ode, double *q, double *v, double t)
{
    struct condense *o = condense_of(ode);
    struct trouble why;
    int changed = 0;
    if (condense_rates(o, o->vt, NULL, q, v, NULL, t, &why) != OK) return 0;
    for (int i = 0; i < o->ncomponent; i++)
        if (o->component[i].nr) changed |= improve(o, &o->component[i]);
    if (!changed) return 0;
    number(o);
    o->charts++;
    for (int i = 0; i < o->ode.n; i++) v[i] = o->vt[o->ind[i]];
    return 1;
}

/* --- start ---------------------------------------------------------------------------------------- */

static const char *row_name(const struct condense *o, int row)
{
    return o->model->loop[o->loops->row[row].loop].name;
}

/* Largest |C| of all rows at q. */
static double misfit(struct condense *o, int *row, const double *q)
{
    double most = 0;
    o->ops->move(o->sweep, q, o->zero, ALL);
    loops_look(o->loops, o->sweep);
    loops_values(o->C, o->loops);
    for (int i = 0; i < o->loops->nrow; i++)
        if (!(fabs(o->C[i]) <= most)) most = fabs(o->C[i]), *row = i;
    return most;
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
static enum status refuse_choice(struct condense *o, struct component *c, int asked)
{
    int instead = -1;
    for (int k = 0; k < c->nk; k++) c->weight[k] = 1;
    choose(o, c);
    for (int j = 0; j < c->ni && instead < 0; j++)
        if (!chosen_by_deck(o, c->k[c->ind[j]])) instead = c->k[c->ind[j]];
    if (instead < 0)
        return fail(&o->start.report, E_MODEL,
                    "'%s' cannot be independent: the loops leave %d freedom(s), and these are chosen",
                    place_name(o->model, asked), c->ni);
    return fail(&o->start.report, E_MODEL,
                "'%s' cannot be independent here: the loops' equations for the others are singular; try '%s'",
                place_name(o->model, asked), place_name(o->model, instead));
}

/* The deck's coordinate that makes the split impossible or all but singular; -1: none. */
static int to_blame(const struct condense *o, const struct component *c)
{
    static const double SINGULAR = 1e-7;
    for (int r = 0; r < c->nr; r++)
        if (chosen_by_deck(o, c->k[c->dep[r]])) return c->k[c->dep[r]];
    for (int j = 0; j < c->ni && c->chosen < SINGULAR; j++)
        if (chosen_by_deck(o, c->k[c->ind[j]])) return c->k[c->ind[j]];
    return -1;
}

/* Ranks and splits at q, where the loops miss by so much. */
static enum status split_all(struct condense *o, const double *q, double miss)
{
    look(o, q, o->zero);
    o->start.redundant = 0;
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        int urgent = 0;
        c->nr = rank_of(o, c, fmax(RANK, fmin(30 * miss, 1e-2)));
        c->ni = c->nk - c->nr;
        for (int k = 0; k < c->nk; k++) urgent += o->model->urgent[c->k[k]];
        c->nfast = urgent < c->ni ? urgent : c->ni;
        for (int k = 0; k < c->nk; k++) c->weight[k] = o->model->follow[c->k[k]];
        c->chosen = choose(o, c);
        o->start.redundant += c->nrow - c->nr;
        int asked = to_blame(o, c);
        if (asked >= 0) return refuse_choice(o, c, asked);
    }
    number(o);
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

static double dropped_miss(const struct condense *o)
{
    double most = 0;
    for (int i = 0; i < o->ncomponent; i++) {
        const struct component *c = &o->component[i];
        for (int r = c->nr; r < c->nrow; r++) most = fmax(most, fabs(o->C[c->row[c->kept[r]]]));
    }
    return most;
}

/* Do dropped rows still hold a small way off?  Redundant ones do; where C_q has lost rank at this very posture
 * only, the way along a direction that is too many leaves them at second order. */
static enum status look_for_branches(struct condense *o)
{
    static const double WAY = 1e-2, MISS = 1e-7;
    int row, lost = 0;
    if (o->start.redundant == 0) return OK;
    for (unsigned trial = 0; trial < 3; trial++) {
        for (int i = 0; i < o->nt; i++) o->dx[i] = 0;
        for (int i = 0; i < o->ode.n; i++)
            o->dx[o->ind[i]] = WAY * o->size[o->ind[i]] * scatter(trial * 1000u + (unsigned)i);
        if (!same_base(o, o->q)) return OK;
        predict(o);
        if (!close_loops(o, o->qtry, o->q, 1)) continue;
        misfit(o, &row, o->qtry);
        int away = 0;
        for (int i = 0; i < o->ncomponent; i++) {
            const struct component *c = &o->component[i];
            for (int r = c->nr; r < c->nrow; r++) away += fabs(o->C[c->row[c->kept[r]]]) > MISS + 10 * o->start.misfit;
        }
        if (away > lost) lost = away;
    }
    if (lost == 0) return OK;
    misfit(o, &row, o->q);
    return fail(
        &o->start.report, E_MODEL,
        "rank of C_q drops by %d in this posture: a bifurcation, where the loops leave the way open; start beside it",
        lost);
}

static enum status assemble(struct condense *o)
{
    struct condense_start *s = &o->start;
    double miss = s->misfit = misfit(o, &s->misfit_row, o->q);
    if (!(miss <= ASSEMBLY))
        return fail(&s->report, E_MODEL,
                    "constraint '%s' closes a loop, and as drawn its bodies miss each other by %.3g of the mechanism's "
                    "size; at most %g is closed",
                    row_name(o, s->misfit_row), miss, ASSEMBLY);
    for (int pass = 0; pass < 2; pass++) {
        TRY(split_all(o, o->q, miss));
        memset(o->dx, 0, sizeof *o->dx * (size_t)o->nt);
        if (!close_loops(o, o->qtry, o->q, 1))
            return fail(&s->report, E_MODEL, "the loop of constraint '%s' cannot be closed",
                        row_name(o, s->misfit_row));
        for (int i = 0; i < o->nt; i++)
            if (fabs(o->dx[i]) > s->moved) s->moved = fabs(o->dx[i]), s->moved_at = i;
        memcpy(o->q, o->qtry, sizeof *o->q * (size_t)o->model->nq);
        int row = 0;
        miss = misfit(o, &row, o->q);
        if (dropped_miss(o) > fmax(1e-9, 3 * s->misfit))
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
    if (misfit(o, &row, q0) <= CLOSED) { /* a whole state that is closed as it is */
        memcpy(o->q, q0, sizeof *q0 * (size_t)o->model->nq);
        return OK;
    }
    moves_diff(o->moves, o->zero, q0, o->q); /* borrowed: wiped below */
    double *way = o->way;
    memcpy(way, o->zero, sizeof *way * (size_t)o->nt);
    memset(o->zero, 0, sizeof *way * (size_t)o->nt);
    for (int i = 0; i < o->ode.n; i++) most = fmax(most, fabs(way[o->ind[i]]) / o->size[o->ind[i]]);
    if (most == 0) return OK;
    for (int k = 0; k < STEPS; k++) {
        memset(o->dx, 0, sizeof *o->dx * (size_t)o->nt);
        for (int i = 0; i < o->ode.n; i++) o->dx[o->ind[i]] = way[o->ind[i]] / STEPS;
        int closed = same_base(o, o->q);
        if (closed) predict(o);
        if (!closed || !close_loops(o, o->qtry, o->q, 1))
            return fail(&o->start.report, E_MODEL, "'initial' cannot be reached: the loops lock at %d %% of the way",
                        100 * k / STEPS);
        memcpy(o->q, o->qtry, sizeof *o->q * (size_t)o->model->nq);
    }
    for (int i = 0; i < o->model->nq; i++) { /* exactly what the deck says */
        int iv = o->model->coordinate[i].iv;
        if (iv >= 0 && o->slot[iv] >= 0) o->q[i] = q0[i];
    }
    memset(o->dx, 0, sizeof *o->dx * (size_t)o->nt);
    if (!close_loops(o, o->qtry, o->q, 1)) return fail(&o->start.report, E_MODEL, "'initial' cannot be reached");
    memcpy(o->q, o->qtry, sizeof *o->q * (size_t)o->model->nq);
    return OK;
}

/* What `initial:` says of coordinates that follow others must fit. */
static enum status agrees(struct condense *o, const double *q0, const double *v0)
{
    static const double FITS = 1e-6;
    struct trouble why;
    const struct model *m = o->model;
    if (condense_rates(o, o->vt, NULL, o->q, o->v, NULL, 0, &why) != OK)
        return fail(&o->start.report, E_MODEL, "the loops are singular at the start");
    for (int i = 0; i < m->ncoordinate; i++) {
        int iv = m->coordinate[i].iv;
        if (iv < 0 || o->slot[iv] >= 0) continue;
        if (q0[i] != 0 && fabs(q0[i] - o->q[i]) > FITS * (1 + fabs(q0[i])))
            return fail(&o->start.report, E_MODEL, "initial '%s' %.9g does not fit the loops, which make it %.9g",
                        m->coordinate[i].name, q0[i], o->q[i]);
        if (v0[iv] != 0 && fabs(v0[iv] - o->vt[iv]) > FITS * (1 + fabs(v0[iv])))
            return fail(&o->start.report, E_MODEL,
                        "initial rate of '%s' %.9g does not fit the loops, which make it %.9g", m->coordinate[i].name,
                        v0[iv], o->vt[iv]);
    }
    return OK;
}

static enum status start(struct condense *o, const double *q0, const double *v0)
{
    for (int i = 0; i < o->moves->nturn; i++) o->q[o->moves->turn[i].iq[0]] = 1;
    TRY(assemble(o));
    TRY(go_to_start(o, q0));
    int row;
    TRY(split_all(o, o->q, misfit(o, &row, o->q)));
    for (int i = 0; i < o->ode.n; i++) o->v[i] = v0[o->ind[i]];
    TRY(agrees(o, q0, v0));
    if (o->ode.n == 0) return fail(&o->start.report, E_MODEL, "nothing can move: the loops leave 0 freedoms");
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        for (int k = 0; k < c->nk; k++) c->weight[k] = o->model->urgent[c->k[k]] ? KEEP_FAST : 1;
        c->gain = gain(o, c);
    }
    return OK;
}

/* --- building ------------------------------------------------------------------------------------- */

static void build_component(struct condense *o, int i, struct arena *life)
{
    const struct model *m = o->model;
    struct component *c = &o->component[i];
    c->k = TAKE(life, int, o->nt);
    c->row = TAKE(life, int, o->loops->nrow);
    for (int r = 0; r < o->loops->nrow; r++)
        if (m->loop[o->loops->row[r].loop].component == i) c->row[c->nrow++] = r;
    for (int k = 0; k < o->nt; k++) {
        if (o->owner[k] != i) continue;
        o->column[k] = c->nk;
        c->k[c->nk++] = k;
    }
    const int most = c->nrow > c->nk ? c->nrow : c->nk, size = c->nrow * c->nk;
    double **of[] = {&c->F, &c->G, &c->G0, &c->whole};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) *of[k] = TAKE(life, double, size);
    c->A = TAKE(life, double, c->nrow * c->nrow);
    c->kept = TAKE(life, int, c->nrow);
    c->dep = TAKE(life, int, most);
    c->ind = TAKE(life, int, c->nk);
    c->prow = TAKE(life, int, most);
    c->pcol = TAKE(life, int, most);
    c->x = TAKE(life, double, most);
    c->weight = TAKE(life, double, c->nk);
    c->dependent = TAKE(life, bool, c->nk);
    c->loop_of = TAKE(life, int, c->nk);
    for (int l = o->model->nloop - 1; l >= 0; l--)
        for (int k = 0; m->loop[l].component == i && k < o->loops->nk[l]; k++)
            c->loop_of[o->column[o->loops->k[l][k]]] = l;
}

static void build_components(struct condense *o, struct arena *life)
{
    const struct model *m = o->model;
    o->ncomponent = m->ncomponent;
    o->component = TAKE(life, struct component, m->ncomponent);
    o->column = TAKE(life, int, o->nt);
    o->owner = TAKE(life, int, o->nt);
    o->size = TAKE(life, double, o->nt);
    for (int i = 0; i < m->njoint; i++)
        for (int k = 0; k < m->joint[i].nv; k++) o->owner[m->joint[i].iv[k]] = m->component[i];
    for (int i = 0; i < o->nt; i++) o->size[i] = 1;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        int slides = j->type == JOINT_PRISMATIC || j->type == JOINT_CYLINDRICAL ? 1
                     : j->type == JOINT_PLANAR                                  ? 2
                     : j->type == JOINT_FREE                                    ? m->space
                                                                                : 0;
        int from = j->type == JOINT_CYLINDRICAL ? 1 : 0;
        for (int k = from; k < from + slides; k++) o->size[j->iv[k]] = o->loops->length;
    }
    for (int i = 0; i < o->ncomponent; i++) build_component(o, i, life);
}

static void build_workspace(struct condense *o, struct arena *life)
{
    double **of[] = {&o->vt,      &o->at,      &o->rt, &o->zero, &o->dx,    &o->dxs,
                     &o->last_dx, &o->last_dt, &o->v,  &o->way,  &o->aside, &o->mean};
    double **places[] = {&o->q, &o->base, &o->G0_at, &o->last_q, &o->qtry, &o->side[0], &o->side[1]};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) *of[i] = TAKE(life, double, o->nt + 1);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) *places[i] = TAKE(life, double, o->model->nq + 1);
    o->C = TAKE(life, double, o->loops->nrow);
    o->C2 = TAKE(life, double, o->loops->nrow);
    o->M = TAKE(life, double, o->nt * o->nt);
    o->M_side = TAKE(life, double, o->nt * o->nt);
    o->ind = TAKE(life, int, o->nt);
    o->slot = TAKE(life, int, o->nt);
    o->split = TAKE(life, int, 2 * o->nt + o->loops->nrow);
    o->bound = TAKE(life, bool, o->moves->nturn);
}

static double next_kink(const struct ode2 *ode, double t)
{
    const struct ode2 *tree = condense_of(ode)->tree;
    return tree->breaks->next(tree, t);
}

struct condense *condense_build(const struct model *m, const struct sweep_ops *sweep, const struct ode2 *tree,
                                const struct moves *moves, const double *q0, const double *v0, struct arena *life)
{
    struct condense *o = TAKE(life, struct condense, 1);
    o->model = m;
    o->ops = sweep;
    o->tree = tree;
    o->moves = moves;
    o->nt = m->n;
    o->sweep = sweep->build(m, life);
    o->loops = loops_build(m, sweep, life);
    o->seen = loops_build(m, sweep, life);
    o->chart = (struct ode2_chart){.rechart = rechart};
    o->breaks = (struct ode2_breaks){.next = next_kink};
    o->ode = (struct ode2){.nq = m->nq,
                           .ops = &ops,
                           .move = &move,
                           .chart = &o->chart,
                           .breaks = tree->breaks ? &o->breaks : NULL,
                           .self = o};
    build_components(o, life);
    build_workspace(o, life);
    o->start.status = start(o, q0, v0);
    return o;
}

/* --- what others ask ------------------------------------------------------------------------------ */

const struct condense_start *condense_started(const struct condense *c)
{
    return &c->start;
}

const double *condense_q(const struct condense *c)
{
    return c->q;
}

const double *condense_v(const struct condense *c)
{
    return c->v;
}

const struct ode2 *condense_ode2(const struct condense *c)
{
    return &c->ode;
}

const struct loops *condense_loops(const struct condense *c)
{
    return c->loops;
}

void condense_push(struct condense *c, struct sweep *s, const double *lambda)
{
    loops_look(c->seen, s);
    loops_push(c->seen, s, lambda);
}

void condense_reaction(const struct condense *c, double *f, double *n, int loop, const double *lambda)
{
    loops_reaction(c->seen, f, n, loop, lambda);
}

double condense_worst(struct condense *c, const double *q)
{
    int row;
    return misfit(c, &row, q);
}

int condense_place(const struct condense *c, int i)
{
    return c->ind[i];
}

bool condense_independent(const struct condense *c, int iv)
{
    return c->slot[iv] >= 0;
}

long condense_charts(const struct condense *c)
{
    return c->charts;
}

bool condense_dropped(const struct condense *o, int row)
{
    for (int i = 0; i < o->ncomponent; i++) {
        const struct component *c = &o->component[i];
        for (int r = c->nr; r < c->nrow; r++)
            if (c->row[c->kept[r]] == row) return true;
    }
    return false;
}

double condense_ratio(struct condense *o)
{
    struct trouble why;
    double least = 1;
    if (factor_all(o, o->q, 0, &why) != OK) return 0;
    for (int i = 0; i < o->ncomponent; i++) least = fmin(least, ratio(o, &o->component[i]));
    return least;
}

/* lambda with C_q' lambda = 0: what the dropped row r of c is made of, less the row itself. */
static void null_vector(struct condense *o, struct component *c, int r, double *lambda)
{
    memset(lambda, 0, sizeof *lambda * (size_t)o->loops->nrow);
    memset(c->whole, 0, sizeof *c->whole * (size_t)c->nk);
    put_row(o, c, c->kept[r], c->whole, 1);
    for (int j = 0; j < c->nr; j++) c->x[j] = c->whole[c->dep[j]];
    pivot_rows_tsolve(c->A, c->prow, c->band, c->x, c->nr, c->nr);
    for (int k = 0; k < c->nr; k++) lambda[c->row[c->kept[k]]] = c->x[k];
    lambda[c->row[c->kept[r]]] = -1;
}

static void joint_forces(struct condense *o, double (*f)[6], const double *lambda)
{
    memset(o->rt, 0, sizeof *o->rt * (size_t)o->nt);
    o->ops->forward(o->sweep, o->q, o->zero, NULL, ALL);
    loops_look(o->loops, o->sweep);
    if (lambda) loops_push(o->loops, o->sweep, lambda);
    o->ops->backward(o->sweep, o->rt, ALL);
    for (int i = 0; i < o->model->njoint; i++) o->ops->reaction(o->sweep, f[i], f[i] + 3, i);
}

/* A null vector loads joints and moves nothing: joints that feel it are not unique. */
static void mark(struct condense *o, bool *unique, bool *unique_joint, const double *lambda)
{
    static const double FELT = 1e-8;
    struct arena *scratch = arena_open();
    double(*without)[6] = arena_take(scratch, (size_t)o->model->njoint, sizeof *without);
    double(*with)[6] = arena_take(scratch, (size_t)o->model->njoint, sizeof *with);
    joint_forces(o, without, NULL);
    joint_forces(o, with, lambda);
    for (int i = 0; i < o->loops->nrow; i++)
        if (fabs(lambda[i]) > FELT) unique[o->loops->row[i].loop] = false;
    for (int i = 0; i < o->model->njoint; i++)
        for (int k = 0; k < 6; k++)
            if (fabs(with[i][k] - without[i][k]) > FELT * (1 + fabs(without[i][k])) / o->loops->length)
                unique_joint[i] = false;
    arena_close(scratch);
}

void condense_mark(struct condense *o, bool *unique, bool *unique_joint)
{
    struct trouble why;
    for (int i = 0; i < o->model->nloop; i++) unique[i] = true;
    for (int i = 0; i < o->model->njoint; i++) unique_joint[i] = true;
    if (factor_all(o, o->q, 0, &why) != OK) return;
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        for (int r = c->nr; r < c->nrow; r++) {
            null_vector(o, c, r, o->C2);
            mark(o, unique, unique_joint, o->C2);
        }
    }
}
