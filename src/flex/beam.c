/* beam.c -- see beam.h
 *
 * Second order: let the strains of the geometrically exact rod, Gamma = Lambda' r' - e_x and kappa = axial vector of
 * Lambda' dLambda/ds (both in beam axes; an initial twist drops out), be linear in the coordinates, so that the elastic
 * energy is exactly q'Kq/2.  Then, with Lambda = 1 + [theta]x + Lambda_2 and the linear fields r, theta, Gamma, kappa,
 *
 *     dLambda_2/ds = [theta]x [kappa]x,     dr_2/ds = Lambda_2 e_x + theta x Gamma,
 *     Lambda_2 = [theta]x^2/2 + [tau]x,     tau = int theta x kappa ds / 2,
 *
 * from zero at the reference.  Lambda_2 e_x holds the shortening by bending, -e_x/2 int (v'^2 + w'^2) ds; the others go
 * with torsion and with stretch, and make the result the same whichever node is the reference.  1/2 q'Sq = r_2.  In
 * space the inertia of sections and lumps turns with Lambda: a disk on a shaft has its gyroscopic moments, a blade's
 * sections the propeller moment. */
#include "flex/beam.h"

#include <math.h>
#include <string.h>

#include "flex/beam_stress.h"
#include "flex/craig.h"
#include "flex/rod.h"
#include "flex/statics.h"
#include "la/rot.h"
#include "la/vec3.h"

struct work {
    const struct flex_beam *beam;
    struct rod rod;
    struct band K, M;
    double start[3], axes[9]; /* of the beam, in the body: start against the centre of mass; x y z by column */
    double *inertia;          /* [9 x nlump] of lumps, beam axes */
    int reference, n, inner;  /* mesh node; coordinates, and those of them that move no joint */
    double *lambda, *Phi;     /* [n], [freedoms x n] beam axes */
    struct craig_edge edge;
};

/* ---- place and axes ---- */

/* B: beam axes in the world. */
static enum status orient(double *B, double *length, const struct flex_beam *o, struct report *report)
{
    double d[3], up[3] = {0, 0, 1}, y[3] = {0, 1, 0};
    v3_diff(d, o->b, o->a);
    *length = v3_norm(d);
    if (!(*length > 0)) return fail(report, E_MODEL, "the ends of the beam are one point");
    if (o->space == 3 && v3_norm(o->up) > 0)
        v3_copy(up, o->up);
    else if (o->space == 3 && hypot(d[0], d[1]) <= 1e-6 * *length)
        v3_copy(up, y);
    if (!matrix_of_axes(B, 0, d, 2, up)) return fail(report, E_MODEL, "the beam runs along its 'up'");
    return OK;
}

/* Start of the beam against the centre of mass, along the beam [m]. */
static double before(const struct work *w)
{
    double m = 0, ms = 0;
    for (int k = 0; k < ROD_GAUSS * (w->rod.nnode - 1); k++) {
        const struct rod_point *p = &w->rod.point[k];
        m += p->m * p->ds;
        ms += p->m * p->ds * p->s;
    }
    for (int k = 0; k < w->beam->nlump; k++) {
        m += w->beam->lump[k].mass;
        ms += w->beam->lump[k].mass * w->beam->lump[k].station * w->rod.length;
    }
    return -ms / m;
}

static void lump_inertia(struct work *w, struct arena *scratch)
{
    w->inertia = TAKE(scratch, double, 9 * w->beam->nlump);
    for (int k = 0; k < w->beam->nlump; k++) {
        double S[6], Bt[9], *I = w->inertia + 9 * k;
        for (int a = 0; a < 9; a++) Bt[a] = w->axes[a / 3 + 3 * (a % 3)];
        s3_turn(S, Bt, w->beam->lump[k].inertia);
        memcpy(I, (double[]){S[0], S[3], S[4], S[3], S[1], S[5], S[4], S[5], S[2]}, 9 * sizeof *I);
    }
}

/* From beam axes to body axes: n vectors. */
static void to_body(double *v, const double *axes, int n)
{
    for (int k = 0; k < n; k++) {
        double x[3] = {v[3 * k], v[3 * k + 1], v[3 * k + 2]};
        m3_mul(v + 3 * k, axes, x);
    }
}

static void place_at(double *x, const struct work *w, double s)
{
    v3_copy(x, w->start);
    v3_axpy(x, s, w->axes);
}

/* ---- modes ---- */

/* Largest displacement positive; of a mode without any, the largest rotation. */
static double sign_of(const double *x, const struct rod *o)
{
    double most[2] = {0, 0}, sign[2] = {1, 1};
    for (int i = 0; i < o->nnode * o->per; i++) {
        int turn = i % o->per >= (o->per == 3 ? 2 : 3);
        if (fabs(x[i]) <= most[turn] * (1 + 1e-6)) continue;
        most[turn] = fabs(x[i]);
        sign[turn] = x[i] < 0 ? -1 : 1;
    }
    return sign[most[0] < 1e-6 * o->length * most[1]];
}

static enum status modes(struct work *w, struct arena *scratch, struct report *report)
{
    int *interface = TAKE(scratch, int, w->beam->ninterface), count = 0, size = w->K.n;
    for (int k = 0; k < w->beam->ninterface; k++) {
        int node = rod_node(&w->rod, w->beam->interface[k]), known = 0;
        while (known < count && interface[known] != node) known++;
        if (known == count) interface[count++] = node;
    }
    struct craig c = {&w->K, &w->M, w->rod.per, interface, count, w->beam->modes, w->beam->pick, w->beam->raw};
    if (c.raw && c.modes > size - c.per * count) c.modes = size - c.per * count;
    w->inner = c.modes;
    w->reference = interface[0];
    w->n = craig_count(&c);
    w->lambda = TAKE(scratch, double, w->n);
    w->Phi = TAKE(scratch, double, size * w->n);
    TRY(craig_reduce(w->lambda, w->Phi, &w->edge, &c, scratch, report));
    for (int j = 0; j < w->n; j++) {
        double *x = w->Phi + (long)size * j, sign = sign_of(x, &w->rod);
        for (int i = 0; i < size; i++) x[i] *= sign;
    }
    return OK;
}

static void stiffness(struct flex_body *o, const struct flex_beam *beam, const double *lambda)
{
    bool damped = beam->alpha != 0 || beam->beta != 0 || beam->zeta != 0;
    for (int j = 0; j < o->n; j++) {
        double root = sqrt(fmax(lambda[j], 0));
        o->K[j * (o->n + 1)] = lambda[j];
        o->D[j * (o->n + 1)] = beam->alpha + beam->beta * lambda[j] + 2 * beam->zeta * root;
        o->hertz[j] = root / (2 * acos(-1));
    }
    if (!damped) o->D = NULL;
}

/* Of coordinates that are no modes. */
static void full_stiffness(struct flex_body *o, const struct work *w, struct arena *scratch)
{
    craig_project(o->K, &w->K, w->Phi, w->n, TAKE(scratch, double, w->K.n));
    o->hertz = o->D = NULL;
}

/* ---- second order, along the beam ---- */

struct march {
    int n;
    double *T, *S;            /* [3 x n x n] tau and r_2 of pairs at the node reached, beam axes */
    double *W[ROD_GAUSS];     /* [12 x n] fields at the points of an element */
    double *slope[ROD_GAUSS]; /* [3 x n x n] integrands */
    double *turn[ROD_GAUSS];  /* [3 x n x n] tau */
    double *shift[ROD_GAUSS]; /* [3 x n x n] r_2 */
};

static void march_take(struct march *o, int n, bool second, struct arena *scratch)
{
    int size = second ? 3 * n * n : 0;
    *o = (struct march){.n = n, .T = TAKE(scratch, double, size), .S = TAKE(scratch, double, size)};
    for (int g = 0; g < ROD_GAUSS; g++) {
        o->W[g] = TAKE(scratch, double, 12 * n);
        o->slope[g] = TAKE(scratch, double, size);
        o->turn[g] = TAKE(scratch, double, size);
        o->shift[g] = TAKE(scratch, double, size);
    }
}

/* d tau/ds of the pair: (theta x kappa)/2, both orders. */
static void turn_slope(double *o, const double *a, const double *b)
{
    v3_cross(o, a + ROD_THETA, b + ROD_KAPPA);
    v3_cross_add(o, b + ROD_THETA, a + ROD_KAPPA);
    v3_scale(o, .5, o);
}

/* dr_2/ds of the pair: Lambda_2 e_x + theta x Gamma, both orders. */
static void shift_slope(double *o, const double *tau, const double *a, const double *b)
{
    const double *ta = a + ROD_THETA, *tb = b + ROD_THETA;
    v3_cross(o, ta, b + ROD_GAMMA);
    v3_cross_add(o, tb, a + ROD_GAMMA);
    o[0] -= ta[1] * tb[1] + ta[2] * tb[2];
    o[1] += (ta[0] * tb[1] + ta[1] * tb[0]) / 2 + tau[2];
    o[2] += (ta[0] * tb[2] + ta[2] * tb[0]) / 2 - tau[1];
}

/* end [size] and at[g]: running integrals of f[g] over an element of length h from start, forward from its left end
 * or backward from its right. */
static void run(double *end, double **at, double **f, int size, double h, bool back)
{
    for (int k = 0; k < size; k++) {
        double total = 0;
        for (int g = 0; g < ROD_GAUSS; g++) total += rod_gauss.w[g] * f[g][k];
        for (int g = 0; g < ROD_GAUSS; g++) {
            double sum = back ? -total : 0;
            for (int i = 0; i < ROD_GAUSS; i++) sum += rod_gauss.part[g][i] * f[i][k];
            at[g][k] = end[k] + h * sum;
        }
        end[k] += back ? -h * total : h * total;
    }
}

static void march_element(struct march *o, double h, bool back)
{
    int n = o->n;
    for (int g = 0; g < ROD_GAUSS; g++)
        for (int k = 0; k < n * n; k++) turn_slope(o->slope[g] + 3 * k, o->W[g] + 12 * (k % n), o->W[g] + 12 * (k / n));
    run(o->T, o->turn, o->slope, 3 * n * n, h, back);
    for (int g = 0; g < ROD_GAUSS; g++)
        for (int k = 0; k < n * n; k++)
            shift_slope(o->slope[g] + 3 * k, o->turn[g] + 3 * k, o->W[g] + 12 * (k % n), o->W[g] + 12 * (k / n));
    run(o->S, o->shift, o->slope, 3 * n * n, h, back);
}

/* ---- integrals and nodes ---- */

/* In the plane nothing tilts. */
static bool tilts(const struct flex_body *o, const struct work *w)
{
    return o->s && w->beam->space == 3;
}

/* Displacement and rotation of the fields W, body axes. */
static void linear(double *phi, double *psi, const double *W, const struct work *w)
{
    for (int j = 0; j < w->n; j++) {
        m3_mul(phi + 3 * j, w->axes, W + 12 * j + ROD_R);
        m3_mul(psi + 3 * j, w->axes, W + 12 * j + ROD_THETA);
    }
}

static void turn_tensor(double *T, const double *axes, const double *I)
{
    double X[9];
    m3_mulm(X, axes, I);
    m3_mulmt(T, X, axes);
}

static void add_element(struct flex_body *o, const struct work *w, struct march *m, int element, double *phi)
{
    for (int g = 0; g < ROD_GAUSS; g++) {
        const struct rod_point *p = &w->rod.point[ROD_GAUSS * element + g];
        double x[3], I[9], *psi = phi + 3 * w->n;
        linear(phi, psi, m->W[g], w);
        if (o->s) to_body(m->turn[g], w->axes, w->n * w->n);
        if (o->s) to_body(m->shift[g], w->axes, w->n * w->n);
        turn_tensor(I, w->axes, p->I);
        for (int a = 0; a < 9; a++) I[a] *= p->ds;
        place_at(x, w, p->s);
        flex_body_add(o, x, p->m * p->ds, I, phi, psi, o->s ? m->shift[g] : NULL, tilts(o, w) ? m->turn[g] : NULL);
    }
}

/* Lumps and nodes of the body that sit at a node of the mesh. */
static void at_node(struct flex_body *o, const struct work *w, const struct march *m, const int *mesh, int node,
                    double *phi)
{
    int n = w->n;
    double x[3], I[9], *psi = phi + 3 * n, *S = psi + 3 * n, *T = S + 3 * n * n, *W = m->W[0];
    rod_at_node(W, &w->rod, node, w->Phi, n);
    linear(phi, psi, W, w);
    place_at(x, w, w->rod.s[node]);
    if (o->s) {
        memcpy(S, m->S, (size_t)(3 * n * n) * sizeof *S);
        memcpy(T, m->T, (size_t)(3 * n * n) * sizeof *T);
        to_body(S, w->axes, 2 * n * n);
    }
    for (int k = 0; k < o->nnode; k++) {
        struct flex_node *c = &o->node[k];
        if (mesh[k] != node) continue;
        v3_copy(c->x, x);
        memcpy(c->phi, phi, (size_t)(3 * n) * sizeof *phi);
        memcpy(c->psi, psi, (size_t)(3 * n) * sizeof *psi);
        if (o->s) memcpy(c->S, S, (size_t)(3 * n * n) * sizeof *S);
        if (o->s) memcpy(c->T, T, (size_t)(3 * n * n) * sizeof *T);
    }
    for (int k = 0; k < w->beam->nlump; k++) {
        if (rod_node(&w->rod, w->beam->lump[k].station) != node) continue;
        turn_tensor(I, w->axes, w->inertia + 9 * k);
        flex_body_add(o, x, w->beam->lump[k].mass, I, phi, psi, o->s ? S : NULL, tilts(o, w) ? T : NULL);
    }
}

/* From the reference to one end. */
static void fill_side(struct flex_body *o, const struct work *w, struct march *m, const int *mesh, bool back,
                      double *phi)
{
    const struct rod *rod = &w->rod;
    int n = w->n, step = back ? -1 : 1, stop = back ? 0 : rod->nnode - 1;
    size_t bytes = o->s ? (size_t)(3 * n * n) * sizeof(double) : 0;
    memset(m->T, 0, bytes);
    memset(m->S, 0, bytes);
    for (int node = w->reference; node != stop; node += step) {
        int e = back ? node - 1 : node;
        for (int g = 0; g < ROD_GAUSS; g++) rod_at_point(m->W[g], rod, ROD_GAUSS * e + g, w->Phi, n);
        if (o->s) march_element(m, rod->s[e + 1] - rod->s[e], back);
        add_element(o, w, m, e, phi);
        at_node(o, w, m, mesh, node + step, phi);
    }
}

/* [o->nnode] */
static int *mesh_nodes(const struct flex_body *o, const struct work *w, struct arena *scratch)
{
    const struct flex_beam *beam = w->beam;
    int *mesh = TAKE(scratch, int, o->nnode), k = 0;
    for (int i = 0; i < beam->ninterface; i++) mesh[k++] = rod_node(&w->rod, beam->interface[i]);
    for (int i = 0; i < beam->npoint; i++) mesh[k++] = rod_node(&w->rod, beam->point[i]);
    mesh[k++] = 0;
    mesh[k++] = w->rod.nnode - 1;
    return mesh;
}

static void fill(struct flex_body *o, const struct work *w, const int *mesh, struct arena *scratch)
{
    const int n = w->n;
    double *phi = TAKE(scratch, double, 6 * n + 6 * n * n);
    struct march m;
    march_take(&m, n, o->s != NULL, scratch);
    at_node(o, w, &m, mesh, w->reference, phi);
    fill_side(o, w, &m, mesh, false, phi);
    fill_side(o, w, &m, mesh, true, phi);
}

/* ---- all ---- */

static enum status make(struct flex_body **out, double *at, struct work *w, struct arena *life, struct arena *scratch,
                        struct report *report)
{
    const struct flex_beam *beam = w->beam;
    double B[9], length, from;
    for (int k = 0; k < beam->nsection; k++)
        if (beam->space == 2 && beam->section[k].twist != 0)
            return fail(report, E_MODEL, "a beam in the plane has no twist");
    TRY(orient(B, &length, beam, report));
    m3_tmulm(w->axes, beam->R, B);
    rod_build(&w->rod, beam, length, scratch);
    lump_inertia(w, scratch);
    rod_matrices(&w->K, &w->M, &w->rod, w->inertia, scratch);
    TRY(modes(w, scratch, report));
    from = before(w);
    v3_scale(w->start, from, w->axes);
    v3_copy(at, beam->a);
    v3_axpy(at, -from, B);
    struct flex_body *o =
        flex_body_take(w->n, beam->ninterface + beam->npoint + 2, beam->nprobe, beam->stiffening, life);
    o->reference = 0;
    stiffness(o, beam, w->lambda);
    if (beam->raw) full_stiffness(o, w, scratch);
    o->inner = beam->raw ? w->inner : 0;
    o->edge = (struct flex_edge){.parted = w->edge.parted, .whole = {w->edge.whole[0], w->edge.whole[1]}};
    for (int k = 0; k < 2; k++) o->edge.hertz[k] = sqrt(w->edge.lambda[k]) / (2 * acos(-1));
    const int *mesh = mesh_nodes(o, w, scratch);
    fill(o, w, mesh, scratch);
    flex_statics_make(o, &w->rod, &w->K, &w->M, w->lambda, w->Phi, mesh, w->reference, w->axes, life, scratch);
    double *Q = TAKE(scratch, double, 6 * w->n);
    for (int k = 0; k < beam->nprobe; k++)
        TRY(beam_stress(&o->stress[k], beam, &w->rod, w->Phi, w->n, &beam->probe[k], Q, report));
    *out = o;
    return OK;
}

enum status flex_beam_make(struct flex_body **out, double *at, const struct flex_beam *o, struct arena *life,
                           struct report *report)
{
    struct arena *scratch = arena_open();
    struct work w = {.beam = o};
    enum status status = make(out, at, &w, life, scratch, report);
    arena_close(scratch);
    return status;
}
