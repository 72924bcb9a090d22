/* choice.c -- see choice.h */
#include "flex/choice.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"
#include "la/vec3.h"

enum { SAMPLES = 32 };
static const double SURE = 0.8; /* of the tolerance */
static const double GOLDEN = 0.61803398874989484820;
static const double NEAR = 0.05;    /* 1 - (W/w)^2 at resonance */
static const double SAME = 2e-6;    /* of squares: modes of one frequency */
static const double NOTHING = 1e-9; /* of a share, or of a group's largest view */

/* ---- answers ---- */

struct choosing {
    const struct flex_choosing *o;
    int n, all;            /* of the body, with the rigid motions before them */
    double *M, *K;         /* [all x all] */
    double *P, *V, *t;     /* [all x ncase] forces, [all x nview] views, [all] */
    bool *gone;            /* [all] it follows from others */
    struct choosing *spun; /* the same while it spins; NULL: it does not */
    double weight;         /* of tension */
    int loose;             /* rigid motions that nothing holds */
    double *answer, *less; /* [SAMPLES x ncase x nview] of all coordinates; of fewer */
    double *size;          /* [nfamily x ngroup] */
    int *at, m;            /* [all] which are taken */
    double *Ms, *Ks, *X, *lambda;
    double *g, *h; /* [all x ncase], [all x nview] */
};

static void fill_matrices(struct choosing *c)
{
    const struct flex_choosing *o = c->o;
    const int n = c->n, nr = o->nrigid, all = c->all;
    double *Me = c->Ms, *L = c->X;
    flex_mass(Me, o->all);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            c->M[nr + i + all * (nr + j)] = Me[i + n * j];
            c->K[nr + i + all * (nr + j)] = o->all->K[i + n * j];
        }
    for (int r = 0; r < nr; r++) {
        flex_inertia_load(L, o->all, o->rigid[r]);
        for (int i = 0; i < n; i++) c->M[r + all * (nr + i)] = c->M[nr + i + all * r] = -L[i];
        for (int s = 0; s < nr; s++)
            c->M[r + all * s] = o->mass[r + nr * s] + flex_inertia_between(o->all, o->rigid[r], o->rigid[s]);
    }
}

/* The centrifugal load of the spin w about x0: of -1/2 int |w x (x + u - x0)|^2 dm what is quadratic in the coordinates. */
static void add_spin(struct choosing *c)
{
    const struct flex_body *f = c->o->all;
    const int n = c->n, nr = c->o->nrigid;
    const double *w = c->o->spin, *x0 = c->o->about;
    double Z[9], at[3];
    for (int k = 0; k < 9; k++) Z[k] = (k % 4 == 0 ? v3_dot(w, w) : 0) - w[k % 3] * w[k / 3];
    m3_mul(at, Z, x0);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double *ff = f->ff + 9 * (i + n * j), *gg = f->ff + 9 * (j + n * i), *xs = f->xs + 9 * (i + n * j);
            double sum = -v3_dot(at, f->s + 3 * (i + n * j));
            for (int k = 0; k < 9; k++) sum += Z[k] * ((ff[k] + gg[k]) / 2 + xs[k]);
            c->K[nr + i + c->all * (nr + j)] -= sum;
        }
}

/* Forces and views with the rigid motions before them. */
static void fill_sides(struct choosing *c)
{
    const struct flex_choosing *o = c->o;
    const int nr = o->nrigid, all = c->all;
    for (int l = 0; l < o->ncase; l++) {
        memcpy(c->P + (long)all * l, o->cases[l].rigid, (size_t)nr * sizeof *c->P);
        memcpy(c->P + (long)all * l + nr, o->cases[l].p, (size_t)c->n * sizeof *c->P);
    }
    for (int v = 0; v < o->nview; v++) memcpy(c->V + (long)all * v + nr, o->view[v].c, (size_t)c->n * sizeof *c->V);
}

static void add_mass(struct choosing *c, const double *t, double mass)
{
    for (int j = 0; j < c->all; j++)
        for (int i = 0; i < c->all; i++) c->M[i + c->all * j] += mass * t[i] * t[j];
}

/* A := T'A T and the like, where x_p goes with x_i by `by`. */
static void join(double *A, int n, int i, int p, double by)
{
    for (int j = 0; j < n; j++) A[j + n * i] += by * A[j + n * p];
    for (int j = 0; j < n; j++) A[i + n * j] += by * A[p + n * j];
}

/* t'x = 0: the coordinate of a static displacement that it has most of follows from the others, and is gone. */
static void hold(struct choosing *c, const double *t)
{
    const int all = c->all;
    int p = -1;
    for (int i = c->o->nrigid + c->o->movable; i < all; i++)
        if (!c->gone[i] && (p < 0 || fabs(t[i]) > fabs(t[p]))) p = i;
    if (p < 0 || t[p] == 0) return;
    for (int i = 0; i < all; i++) {
        const double by = -t[i] / t[p];
        if (i == p || by == 0) continue;
        join(c->M, all, i, p, by);
        join(c->K, all, i, p, by);
        for (int l = 0; l < c->o->ncase; l++) c->P[i + (long)all * l] += by * c->P[p + (long)all * l];
        for (int v = 0; v < c->o->nview; v++) c->V[i + (long)all * v] += by * c->V[p + (long)all * v];
    }
    c->gone[p] = true;
}

static void add_ties(struct choosing *c)
{
    const int nr = c->o->nrigid;
    for (int held = 0; held < 2; held++)
        for (int k = 0; k < c->o->ntie; k++) {
            const struct flex_tie *tie = &c->o->tie[k];
            if (tie->held != held) continue;
            memcpy(c->t, tie->rigid, (size_t)nr * sizeof *c->t);
            memcpy(c->t + nr, tie->b, (size_t)c->n * sizeof *c->t);
            bool moves = false;
            for (int r = 0; r < nr; r++) moves = moves || fabs(tie->rigid[r]) > NOTHING;
            if (held && moves && c->loose > 0) c->loose--;
            if (held)
                hold(c, c->t);
            else
                add_mass(c, c->t, tie->mass);
        }
}

/* Modes of what is taken; false: none. */
static bool solve(struct choosing *c)
{
    const int m = c->m;
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++) {
            c->Ms[i + m * j] = c->M[c->at[i] + c->all * c->at[j]];
            c->Ks[i + m * j] = c->K[c->at[i] + c->all * c->at[j]];
        }
    return eigen_general(c->lambda, c->X, c->Ks, c->Ms, m) < 0;
}

static void project_on(double *to, const struct choosing *c, const double *of, int count)
{
    const int m = c->m;
    for (int l = 0; l < count; l++)
        for (int j = 0; j < m; j++) {
            double sum = 0;
            for (int i = 0; i < m; i++) sum += c->X[i + (long)m * j] * of[c->at[i] + (long)c->all * l];
            to[j + (long)m * l] = sum;
        }
}

/* How much of a mode's static answer is there at a sampled time; the first: at rest. */
static double part_at(const struct flex_choosing *o, const struct flex_case *l, double lambda, int sample)
{
    const double w = sqrt(lambda), d = (o->alpha + o->beta * lambda + 2 * o->zeta * w) / 2;
    if (sample == 0) return 1;
    if (!l->sudden) {
        const double x = 1 - l->omega * l->omega / lambda;
        return 1 / (fabs(x) > NEAR ? x : copysign(NEAR, x));
    }
    const double t = o->span * (sample * GOLDEN - floor(sample * GOLDEN));
    return exp(-d * t) * cos(w * t);
}

static void respond(double *answer, struct choosing *c)
{
    const struct flex_choosing *o = c->o;
    memset(answer, 0, (size_t)(SAMPLES * o->ncase * o->nview) * sizeof *answer);
    project_on(c->g, c, c->P, o->ncase);
    project_on(c->h, c, c->V, o->nview);
    for (int l = 0; l < o->ncase; l++) {
        const int samples = o->cases[l].sudden ? SAMPLES : 2;
        for (int j = c->loose; j < c->m; j++) {
            if (!(c->lambda[j] > 0)) continue;
            for (int s = 0; s < samples; s++) {
                const double x = c->g[j + (long)c->m * l] / c->lambda[j] * part_at(o, &o->cases[l], c->lambda[j], s);
                double *to = answer + (long)SAMPLES * o->nview * l + s;
                for (int v = 0; v < o->nview; v++) to[(long)SAMPLES * v] += x * c->h[j + (long)c->m * v];
            }
        }
    }
}

static double largest(const double *x)
{
    double most = 0;
    for (int s = 0; s < SAMPLES; s++) most = fmax(most, fabs(x[s]));
    return most;
}

static void fill_sizes(struct choosing *c)
{
    const struct flex_choosing *o = c->o;
    for (int l = 0; l < o->ncase; l++)
        for (int v = 0; v < o->nview; v++) {
            double *size = &c->size[o->cases[l].family + o->nfamily * o->view[v].group];
            *size = fmax(*size, largest(c->answer + (long)SAMPLES * (v + o->nview * l)));
        }
    for (int g = 0; g < o->ngroup; g++)
        for (int f = 0; f < o->nfamily; f++)
            if (c->size[f + o->nfamily * g] < NOTHING * c->size[f + o->nfamily * o->like[g]])
                c->size[f + o->nfamily * g] = 0;
}

/* Which of the movable are taken. */
static void take(struct choosing *c, const bool *keep)
{
    c->m = 0;
    for (int i = 0; i < c->all; i++) {
        const int k = i - c->o->nrigid;
        if (c->gone[i]) continue;
        if (k < 0 || k >= c->o->movable || keep[k]) c->at[c->m++] = i;
    }
}

/* The share of what is not taken, where it is largest. */
static double share_in(int *by, int *of, struct choosing *c, const bool *keep)
{
    const struct flex_choosing *o = c->o;
    double most = 0;
    *by = *of = -1;
    take(c, keep);
    if (c->m > 0 && !solve(c)) return INFINITY;
    respond(c->less, c);
    for (int l = 0; l < o->ncase; l++)
        for (int v = 0; v < o->nview; v++) {
            const long at = (long)SAMPLES * (v + o->nview * l);
            const double size = c->size[o->cases[l].family + o->nfamily * o->view[v].group];
            double off = 0;
            for (int s = 0; s < SAMPLES; s++) off = fmax(off, fabs(c->answer[at + s] - c->less[at + s]));
            if (o->view[v].tension) off *= c->weight;
            if (!(off > most * size) || !(size > 0)) continue;
            most = off / size;
            *by = l;
            *of = v;
        }
    return most;
}

/* At rest and spinning. */
static double share(int *by, int *of, struct choosing *c, const bool *keep)
{
    double most = share_in(by, of, c, keep);
    if (!c->spun) return most;
    int by1, of1;
    const double other = share_in(&by1, &of1, c->spun, keep);
    if (other <= most) return most;
    *by = by1;
    *of = of1;
    return other;
}

/* How far a change of the pull along the body changes its bending: its share of the stiffness, which adds up as phase while
 * the body swings. */
static double weight_of_pull(double lambda, const struct flex_choosing *o)
{
    return fmin(1, o->pull / lambda * fmax(1, sqrt(lambda) * o->span / 2));
}

static bool set_out(struct choosing *c, const struct flex_choosing *o, bool spins, const bool *keep,
                    struct arena *scratch)
{
    const int n = o->all->n, all = n + o->nrigid, size = SAMPLES * o->ncase * o->nview;
    *c = (struct choosing){.o = o,
                           .n = n,
                           .all = all,
                           .loose = o->nrigid,
                           .M = TAKE_MATRIX(scratch, double, all, all),
                           .K = TAKE_MATRIX(scratch, double, all, all),
                           .P = TAKE_MATRIX(scratch, double, all, o->ncase),
                           .V = TAKE_MATRIX(scratch, double, all, o->nview),
                           .t = TAKE(scratch, double, all),
                           .gone = TAKE(scratch, bool, all),
                           .answer = TAKE(scratch, double, size),
                           .less = TAKE(scratch, double, size),
                           .size = TAKE(scratch, double, o->nfamily * o->ngroup),
                           .at = TAKE(scratch, int, all),
                           .Ms = TAKE_MATRIX(scratch, double, all, all),
                           .Ks = TAKE_MATRIX(scratch, double, all, all),
                           .X = TAKE_MATRIX(scratch, double, all, all),
                           .lambda = TAKE(scratch, double, all),
                           .g = TAKE_MATRIX(scratch, double, all, o->ncase),
                           .h = TAKE_MATRIX(scratch, double, all, o->nview)};
    fill_matrices(c);
    if (spins) add_spin(c);
    fill_sides(c);
    add_ties(c);
    take(c, keep);
    if (!solve(c)) return false;
    if (c->loose < c->m && c->lambda[c->loose] > 0) c->weight = weight_of_pull(c->lambda[c->loose], o);
    respond(c->answer, c);
    fill_sizes(c);
    return true;
}

/* ---- the choice ---- */

static double lambda_of(const struct flex_choosing *o, int k)
{
    return o->all->K[k + (long)o->all->n * k];
}

/* With all modes of its frequency. */
static void keep_group(bool *keep, const struct flex_choosing *o, int k)
{
    int a = k, b = k;
    while (a > 0 && lambda_of(o, a) - lambda_of(o, a - 1) <= SAME * lambda_of(o, a)) a--;
    while (b + 1 < o->movable && lambda_of(o, b + 1) - lambda_of(o, b) <= SAME * lambda_of(o, b + 1)) b++;
    for (int i = a; i <= b; i++) keep[i] = true;
}

static void tell_shares(struct flex_chosen *to, struct choosing *c, bool *keep)
{
    const struct flex_choosing *o = c->o;
    for (int k = 0; k < o->movable; k++) keep[k] = true;
    for (int k = 0; k < o->movable; k++) {
        int by, of;
        keep[k] = false;
        to->mode[k].share = share(&by, &of, c, keep);
        keep[k] = true;
        if (by < 0 || to->mode[k].share <= NOTHING) continue;
        to->mode[k].by = o->cases[by].name;
        to->mode[k].of = o->view[of].name;
    }
}

/* The one of largest share that is not kept; -1: none has any. */
static int next_of(const struct flex_chosen *to, const bool *keep)
{
    int best = -1;
    for (int k = 0; k < to->n; k++)
        if (!keep[k] && to->mode[k].share > NOTHING && (best < 0 || to->mode[k].share > to->mode[best].share)) best = k;
    return best;
}

static void select_modes(struct flex_chosen *to, struct choosing *c, bool *keep)
{
    const struct flex_choosing *o = c->o;
    int by, of;
    memset(keep, 0, (size_t)o->movable * sizeof *keep);
    for (int k = 0; k < o->least && k < o->movable; k++) keep_group(keep, o, k);
    if (o->movable == o->all->n) keep_group(keep, o, next_of(to, keep) < 0 ? 0 : next_of(to, keep));
    while ((to->left = share(&by, &of, c, keep)) > SURE * o->tolerance) {
        const int k = next_of(to, keep);
        if (k < 0) return;
        keep_group(keep, o, k);
    }
}

const struct flex_chosen *flex_choose(bool *keep, const struct flex_choosing *o, struct arena *life)
{
    struct flex_chosen *to = TAKE(life, struct flex_chosen, 1);
    struct arena *scratch = arena_open();
    struct choosing c, spun;
    *to = (struct flex_chosen){o->movable, TAKE(life, struct flex_chosen_mode, o->movable), o->tolerance, 0};
    for (int k = 0; k < o->movable; k++) {
        keep[k] = true;
        to->mode[k].hertz = sqrt(fmax(lambda_of(o, k), 0)) / (2 * acos(-1));
        to->mode[k].kind = o->all->statics ? o->all->statics->kind[k] : FLEX_MIXED;
    }
    if (set_out(&c, o, false, keep, scratch)) {
        if (v3_norm(o->spin) > 0 && o->all->s && set_out(&spun, o, true, keep, scratch)) c.spun = &spun;
        tell_shares(to, &c, keep);
        select_modes(to, &c, keep);
    }
    for (int k = 0; k < o->movable; k++) to->mode[k].kept = keep[k];
    arena_close(scratch);
    return to;
}
