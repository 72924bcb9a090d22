/* planar_build.c -- the tables of planar.h from a body's data, and room for what they give. */
#include <math.h>
#include <string.h>

#include "flex/planar_parts.h"
#include "la/tiles.h"

static bool all_zero(const double *x, int n)
{
    for (int i = 0; i < n; i++)
        if (x[i] != 0) return false;
    return true;
}

/* Tables [n x n] and bases [n] (NULL: zero) by block. */
static void panel_build(struct panel *o, int n, int blocks, double *const *table, double *const *base,
                        struct arena *life)
{
    int next = 0;
    o->n = n;
    o->size = tiles_rows(blocks * n);
    o->base = TAKE(life, double, o->size);
    for (int b = 0; b < blocks; b++) {
        o->table[b] = all_zero(table[b], n * n) ? NULL : table[b];
        if (o->table[b]) o->rows += n;
    }
    for (int pass = 0; pass < 2; pass++) /* those that are not zero first */
        for (int b = 0; b < blocks; b++)
            if ((o->table[b] == NULL) == pass) o->at[b] = next, next += n;
    o->rows = tiles_rows(o->rows);
    o->A = TAKE(life, double, (long)o->rows *n);
    for (int b = 0; b < blocks; b++) {
        if (base && base[b]) memcpy(o->base + o->at[b], base[b], sizeof(double) * (size_t)n);
        for (int ij = 0; o->table[b] && ij < n * n; ij++) o->A[tiles_at(o->at[b] + ij % n, ij / n, n)] = table[b][ij];
    }
}

static void form_build(struct form *o, const double *A, int n, struct arena *life)
{
    o->diagonal = true;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            if (i != j && A[i + n * j] != 0) o->diagonal = false;
    o->A = TAKE(life, double, o->diagonal ? n : n *n);
    if (!o->diagonal) memcpy(o->A, A, sizeof *A * (size_t)(n * n));
    for (int i = 0; o->diagonal && i < n; i++) o->A[i] = A[i + n * i];
}

/* Trace and scalar cross product of a 3 x 3 product a b' in the plane. */
static double trace2(const double *ab)
{
    return ab[0] + ab[4];
}

static double cross2(const double *ab)
{
    return ab[3] - ab[1];
}

static const double THIN = 1e-12; /* no extent, as in affine.c */

/* Of B = int x a' dm, of which x goes along e: a there along e; square to e. */
static double along(const double *e, const double *B)
{
    return e[0] * (e[0] * B[0] + e[1] * B[1]) + e[1] * (e[0] * B[3] + e[1] * B[4]);
}

static double square_to(const double *e, const double *B)
{
    return e[0] * (e[0] * B[3] + e[1] * B[4]) - e[1] * (e[0] * B[0] + e[1] * B[1]);
}

/* The parts of B that rho and tau are made of. */
static double rho_of(const struct flex_planar *k, const double *B)
{
    return k->cayley ? along(k->e1, B) : trace2(B);
}

static double tau_of(const struct flex_planar *k, const double *B)
{
    return k->cayley ? square_to(k->e1, B) : cross2(B);
}

/* Moments l and the first axis e of int x x' dm in the plane. */
static void principal(double *l, double *e, const double *xx)
{
    const double half = .5 * (xx[0] - xx[4]), mean = .5 * (xx[0] + xx[4]), root = hypot(half, xx[1]);
    const double angle = root > 0 ? .5 * atan2(xx[1], half) : 0;
    l[0] = mean + root;
    l[1] = mean - root;
    e[0] = cos(angle);
    e[1] = sin(angle);
}

static void take_extent(struct flex_planar *k, double jx, const double *e1, const struct flex_body *o,
                        struct arena *life)
{
    k->jx = jx;
    k->j_inv = k->jx > 0 ? 1 / k->jx : 0;
    k->e1[0] = e1[0];
    k->e1[1] = e1[1];
    k->e = TAKE(life, double, k->n);
    k->g = TAKE(life, double, k->n);
    for (int j = 0; j < k->n; j++) {
        k->e[j] = rho_of(k, o->xf + 9 * j);
        k->g[j] = tau_of(k, o->xf + 9 * j);
    }
}

static struct flex_planar *build_across(const double *e1, double l, const struct flex_body *o, struct arena *life)
{
    struct flex_planar *k = TAKE(life, struct flex_planar, 1);
    k->n = o->n;
    k->cayley = true;
    k->f = TAKE(life, double, 2 * k->n);
    k->rpsi = TAKE(life, double, k->n);
    take_extent(k, l, (double[]){-e1[1], e1[0]}, o, life);
    return k;
}

/* Do the coordinates leave it as it is? */
static bool rests(const struct flex_planar *k, const struct flex_body *o)
{
    double most = 0, moved = 0;
    for (int j = 0; j < o->n; j++) {
        moved = fmax(moved, fmax(fabs(k->e[j]), fabs(k->g[j])));
        for (int i = 0; i < 9; i++) most = fmax(most, fabs(o->xf[i + 9 * j]));
    }
    for (int j = 0; o->xs && j < o->n * o->n; j++) {
        moved = fmax(moved, fmax(fabs(rho_of(k, o->xs + 9 * j)), fabs(tau_of(k, o->xs + 9 * j))));
        for (int i = 0; i < 9; i++) most = fmax(most, fabs(o->xs[i + 9 * j]));
    }
    return moved <= THIN * most;
}

/* What a body as in space has besides; where that rests, it is inertia that only turns. */
static void take_across(struct flex_planar *k, const double *e1, double l, const struct flex_body *o,
                        struct arena *life)
{
    struct flex_planar *more = build_across(e1, l, o, life);
    if (rests(more, o))
        k->rot += l;
    else
        k->across = more;
}

static void build_linear(struct flex_planar *k, const struct flex_body *o, struct arena *life)
{
    const int n = o->n;
    double l[2] = {trace2(o->xx), 0}, e1[2] = {1, 0};
    k->mass = o->mass;
    k->cayley = o->affine;
    k->rot = o->rot[8];
    k->m_inv = 1 / k->mass;
    if (o->affine) principal(l, e1, o->xx);
    take_extent(k, l[0], e1, o, life);
    if (l[1] > THIN * l[0]) take_across(k, e1, l[1], o, life);
    k->f = TAKE(life, double, 2 * n);
    k->rpsi = TAKE(life, double, n);
    for (int j = 0; j < n; j++) {
        k->f[j] = o->f[3 * j];
        k->f[j + n] = o->f[3 * j + 1];
        k->rpsi[j] = o->rpsi[3 * j + 2];
    }
}

/* Of a_i b_j over the similar parts of the fields: their scalar product (W) and cross product (P). */
static void similar(double *W, double *P, const struct flex_planar *k, int i, int j)
{
    const double *fx = k->f, *fy = k->f + k->n, *e = k->e, *g = k->g;
    *W = k->m_inv * (fx[i] * fx[j] + fy[i] * fy[j]) + k->j_inv * (e[i] * e[j] + g[i] * g[j]);
    *P = k->m_inv * (fx[i] * fy[j] - fy[i] * fx[j]) + k->j_inv * (e[i] * g[j] - g[i] * e[j]);
}

/* Symmetric parts of xs, by a pair of coordinates. */
static void stretch(double *se, double *sc, const struct flex_planar *k, const struct flex_body *o)
{
    const int n = o->n;
    for (int i = 0; o->xs && i < n; i++)
        for (int j = 0; j < n; j++) {
            const double *a = o->xs + 9 * (i + n * j), *b = o->xs + 9 * (j + n * i);
            se[i + n * j] = .5 * (rho_of(k, a) + rho_of(k, b));
            sc[i + n * j] = .5 * (tau_of(k, a) + tau_of(k, b));
        }
}

/* The squares of the second extent: slopes take them from here, what moves from the panels of the body. */
static void build_square_across(struct flex_planar *k, double *se, double *sc, struct arena *life)
{
    double *none = TAKE(life, double, k->n * k->n);
    double *const base[BLOCKS] = {k->f, k->f, k->e, k->g, NULL, NULL};
    panel_build(&k->shape, k->n, BLOCKS, (double *const[]){none, none, se, sc, none, none}, base, life);
    panel_build(&k->rates, k->n, RATES, (double *const[]){none, none, none, se, sc}, NULL, life);
    panel_build(&k->M, k->n, 1, (double *const[]){none}, NULL, life);
}

/* Symmetric parts of s and xs: the antisymmetric ones do no harm anywhere, if there are any. */
static void build_square(struct flex_planar *k, const struct flex_body *o, struct arena *life)
{
    const int n = o->n, nn = n * n;
    double *W = TAKE(life, double, nn), *P = TAKE(life, double, nn), *sx = TAKE(life, double, nn);
    double *sy = TAKE(life, double, nn), *se = TAKE(life, double, nn), *sc = TAKE(life, double, nn);
    k->rest = TAKE(life, double, nn);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const int ij = i + n * j, ji = j + n * i;
            double w, p;
            similar(&w, &p, k, j, i);
            if (k->across) {
                double w2, p2;
                similar(&w2, &p2, k->across, j, i);
                w += w2;
                p += p2;
            }
            const double both = .5 * (trace2(o->ff + 9 * ij) + trace2(o->ff + 9 * ji));
            const double turns = .5 * (o->ppsi[ij] + o->ppsi[ji]);
            W[ij] = both - w;
            k->rest[ij] = both + turns - w;
            P[ij] = .5 * (cross2(o->ff + 9 * ji) - cross2(o->ff + 9 * ij)) - p; /* P^_ji */
            if (o->s) {
                sx[ij] = .5 * (o->s[3 * ij] + o->s[3 * ji]);
                sy[ij] = .5 * (o->s[3 * ij + 1] + o->s[3 * ji + 1]);
            }
        }
    stretch(se, sc, k, o);
    const struct flex_planar *more = k->across;
    double *se2 = more ? TAKE(life, double, nn) : NULL, *sc2 = more ? TAKE(life, double, nn) : NULL;
    if (more) stretch(se2, sc2, more, o);
    if (more) build_square_across(k->across, se2, sc2, life);
    double *const base[] = {k->f, k->f + n, k->e, k->g, NULL, NULL, more ? more->e : NULL, more ? more->g : NULL};
    const int across = more ? ACROSS : 0;
    panel_build(&k->shape, n, BLOCKS + across, (double *const[]){sx, sy, se, sc, W, P, se2, sc2}, base, life);
    panel_build(&k->rates, n, RATES + across, (double *const[]){P, sx, sy, se, sc, se2, sc2}, NULL, life);
    panel_build(&k->M, n, 1, &k->rest, NULL, life);
}

static void build_node(struct node *o, const struct flex_node *from, int n, struct arena *life)
{
    double *phi = TAKE(life, double, 2 * n), *Sx = TAKE(life, double, n *n), *Sy = TAKE(life, double, n *n);
    o->psi = TAKE(life, double, n);
    o->x[0] = from->x[0];
    o->x[1] = from->x[1];
    for (int j = 0; j < n; j++) {
        phi[j] = from->phi[3 * j];
        phi[j + n] = from->phi[3 * j + 1];
        o->psi[j] = from->psi[3 * j + 2];
    }
    for (int ij = 0; from->S && ij < n * n; ij++) {
        Sx[ij] = from->S[3 * ij];
        Sy[ij] = from->S[3 * ij + 1];
    }
    panel_build(&o->d, n, 2, (double *const[]){Sx, Sy}, (double *const[]){phi, phi + n}, life);
    panel_build(&o->S, n, 2, (double *const[]){Sx, Sy}, NULL, life);
}

/* The body in its mean frame, which stands on the reference node and turns by that much with q: no angular momentum
 * about the node but that of the turn, to first order.  Without S the fields mean what they say, and so does the
 * frame. */
static const struct flex_body *to_mean(double *mean, const struct flex_body *o, struct arena *life)
{
    const struct flex_node *at = &o->node[o->reference];
    struct flex_node turning = {.phi = TAKE(life, double, 3 * o->n), .psi = TAKE(life, double, 3 * o->n)};
    struct flex_body single = *o;
    const double J = trace2(o->xx) + o->rot[8] + o->mass * (at->x[0] * at->x[0] + at->x[1] * at->x[1]);
    if (!o->s) return o;
    memcpy(turning.x, at->x, sizeof turning.x);
    for (int j = 0; j < o->n; j++) {
        const double *f = o->f + 3 * j;
        mean[j] = (cross2(o->xf + 9 * j) + o->rpsi[3 * j + 2] - (at->x[0] * f[1] - at->x[1] * f[0])) / J;
        turning.psi[3 * j + 2] = mean[j];
    }
    single.node = &turning;
    single.nnode = 1;
    return flex_refer(&single, 0, life);
}

struct flex_planar *flex_planar_build(const struct flex_body *body, struct arena *life)
{
    struct flex_planar *k = TAKE(life, struct flex_planar, 1);
    k->n = body->n;
    k->mean = TAKE(life, double, k->n);
    k->pivot[0] = body->node[body->reference].x[0];
    k->pivot[1] = body->node[body->reference].x[1];
    const struct flex_body *o = to_mean(k->mean, body, life);
    build_linear(k, o, life);
    build_square(k, o, life);
    form_build(&k->K, o->K, o->n, life);
    if (o->D) form_build(&k->D, o->D, o->n, life);
    k->node = TAKE(life, struct node, body->nnode);
    for (int i = 0; i < body->nnode; i++) build_node(&k->node[i], &body->node[i], k->n, life);
    return k;
}

/* What does not change, for good. */
static void panel_start(double *out, const struct panel *o)
{
    memcpy(out, o->base, sizeof *out * (size_t)o->size);
}

static void core_take(struct flex_planar_core *o, const struct flex_planar *k, struct arena *life)
{
    o->work = TAKE(life, double, k->shape.size);
    o->rates = TAKE(life, double, k->rates.size + k->M.size);
    panel_start(o->work, &k->shape);
    panel_start(o->rates, &k->rates);
    panel_start(o->rates + k->rates.size, &k->M);
    o->Hx = o->work + k->shape.at[0];
    o->Hy = o->work + k->shape.at[1];
    o->E = o->work + k->shape.at[2];
    o->C = o->work + k->shape.at[3];
    o->W = o->work + k->shape.at[4];
    o->P = o->work + k->shape.at[5];
}

void flex_planar_shape_take(struct flex_planar_shape *o, const struct flex_planar *k, struct arena *life)
{
    core_take(&o->core, k, life);
    if (!k->across) return;
    core_take(&o->across, k->across, life);
    o->across.E = o->core.work + k->shape.at[BLOCKS];
    o->across.C = o->core.work + k->shape.at[BLOCKS + 1];
    o->across.se = o->core.rates + k->rates.at[RATES];
    o->across.sc = o->core.rates + k->rates.at[RATES + 1];
}

void flex_planar_place_take(struct flex_planar_place *o, const struct flex_planar *k, int node, struct arena *life)
{
    *o = (struct flex_planar_place){.work = TAKE(life, double, k->node[node].d.size + k->node[node].S.size)};
    panel_start(o->work, &k->node[node].d);
    panel_start(o->work + k->node[node].d.size, &k->node[node].S);
    o->dx = o->work + k->node[node].d.at[0];
    o->dy = o->work + k->node[node].d.at[1];
    o->dw = k->node[node].psi;
    if (k->cayley) o->dw = o->turn = TAKE(life, double, k->n);
}
