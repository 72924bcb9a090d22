/* rod.c -- see rod.h */
#include "flex/rod.h"

#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/vec3.h"

/* Abramowitz & Stegun 25.4.30 moved to 0 ... 1; part: Lagrange's polynomials integrated. */
const struct rod_gauss rod_gauss = {
    {0.046910077030668004, 0.23076534494715845, 0.50000000000000000, 0.76923465505284155, 0.95308992296933200},
    {0.11846344252809454, 0.23931433524968323, 0.28444444444444444, 0.23931433524968323, 0.11846344252809454},
    {
        {0.059231721264047272, -0.019570364359076037, 0.011254400818642956, -0.0055937936608121849,
         0.0015881129678659985},
        {0.12815100567004528, 0.11965716762484162, -0.024592114619642200, 0.010318280670683357, -0.0027689943987696030},
        {0.11377628800422460, 0.26000465168064152, 0.14222222222222222, -0.020690316430958285, 0.0046871545238699412},
        {0.12123243692686415, 0.22899605457899988, 0.30903655906408664, 0.11965716762484162, -0.0096875631419507397},
        {0.11687532956022855, 0.24490812891049542, 0.27319004362580149, 0.25888469960875927, 0.059231721264047272},
    },
};

/* ---- mesh ---- */

static void insert(double *list, int *n, double x)
{
    int k = 0;
    while (k < *n && list[k] < x - ROD_SAME) k++;
    if (k < *n && list[k] <= x + ROD_SAME) return;
    memmove(list + k + 1, list + k, (size_t)(*n - k) * sizeof *list);
    list[k] = x;
    ++*n;
}

/* The stations where there must be a node, ascending. */
static int stops(double *list, const struct flex_beam *beam)
{
    int n = 0;
    insert(list, &n, 0);
    insert(list, &n, 1);
    for (int k = 0; k < beam->ninterface; k++) insert(list, &n, beam->interface[k]);
    for (int k = 0; k < beam->npoint; k++) insert(list, &n, beam->point[k]);
    for (int k = 0; k < beam->nlump; k++) insert(list, &n, beam->lump[k].station);
    for (int k = 0; k < beam->nsection; k++) insert(list, &n, fmin(fmax(beam->section[k].station, 0), 1));
    return n;
}

static int pieces(double gap, int elements)
{
    int k = (int)ceil(gap * elements - 1e-6);
    return k > 1 ? k : 1;
}

static void mesh(struct rod *o, const struct flex_beam *beam, struct arena *life)
{
    double *stop = TAKE(life, double, beam->ninterface + beam->npoint + beam->nlump + beam->nsection + 2);
    int n = stops(stop, beam), k = 0;
    o->nnode = 1;
    for (int a = 1; a < n; a++) o->nnode += pieces(stop[a] - stop[a - 1], beam->elements);
    o->s = TAKE(life, double, o->nnode);
    for (int a = 1; a < n; a++) {
        int m = pieces(stop[a] - stop[a - 1], beam->elements);
        for (int i = 1; i <= m; i++) o->s[++k] = o->length * (stop[a - 1] + (stop[a] - stop[a - 1]) * i / m);
    }
}

int rod_node(const struct rod *o, double station)
{
    int best = 0;
    for (int k = 1; k < o->nnode; k++)
        if (fabs(o->s[k] - station * o->length) < fabs(o->s[best] - station * o->length)) best = k;
    return best;
}

/* ---- sections ---- */

void rod_section(struct flex_section *o, const struct flex_beam *beam, double station)
{
    int k = 0;
    const struct flex_section *a = beam->section, *b;
    while (k + 1 < beam->nsection && a[k + 1].station <= station) k++;
    *o = a[k];
    if (k + 1 == beam->nsection || station <= a[k].station) return;
    a += k;
    b = a + 1;
    section_between(o, a, b, (station - a->station) / (b->station - a->station));
}

/* T [2 x 2] in a matrix of ld rows: the tensor diag(p, q) across the beam, turned by the angle about x. */
static void turned(double *T, int ld, double p, double q, double angle)
{
    double c = cos(angle), s = sin(angle);
    T[0] = c * c * p + s * s * q;
    T[1 + ld] = s * s * p + c * c * q;
    T[1] = T[ld] = c * s * p - c * s * q;
}

/* rho A and rho I.  Torsion always has inertia; in the plane nothing else turns than about z. */
static void section_mass(struct rod_point *o, const struct flex_beam *beam, double station)
{
    struct flex_section c;
    rod_section(&c, beam, station);
    double y = c.rotary * beam->density * c.Iy, z = c.rotary * beam->density * c.Iz;
    o->m = beam->density * c.A;
    if (beam->space == 2) {
        o->I[8] = z;
        return;
    }
    o->I[0] = beam->density * (c.Iy + c.Iz);
    turned(o->I + 4, 3, y, z, c.twist);
}

static double inverse(double x)
{
    return x > 0 ? 1 / x : 0;
}

/* Strains by force F [3 x 3] and curvatures by moment B [3 x 3].  In the plane the bending that no freedom has is
 * given the stiffness of the one that has. */
static void section_give(double *F, double *B, const struct flex_beam *beam, double station)
{
    struct flex_section c;
    rod_section(&c, beam, station);
    int flat = beam->space == 2;
    memset(F, 0, 9 * sizeof *F);
    memset(B, 0, 9 * sizeof *B);
    F[0] = 1 / (beam->E * c.A);
    turned(F + 4, 3, inverse(beam->G * c.A * c.ky), inverse(beam->G * c.A * c.kz), c.twist);
    B[0] = 1 / (flat ? beam->E * c.Iz : beam->G * c.J);
    turned(B + 4, 3, 1 / (beam->E * (flat ? c.Iz : c.Iy)), 1 / (beam->E * c.Iz), c.twist);
}

/* ---- elements ---- */

/* What end loads Q = (force, moment at the right end) strain at a distance `arm` before the end: S [6 x 6]. */
static void strain_by_load(double *S, const struct flex_beam *beam, double station, double arm)
{
    double F[9], B[9];
    section_give(F, B, beam, station);
    for (int j = 0; j < 3; j++) {
        const double force[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const double moment[3][3] = {{0, 0, 0}, {0, 0, arm}, {0, -arm, 0}}; /* arm e_x x force */
        m3_mul(S + 6 * j, F, force[j]);
        m3_mul(S + 6 * j + 3, B, moment[j]);
        v3_set(S + 6 * (j + 3), 0, 0, 0);
        m3_mul(S + 6 * (j + 3) + 3, B, force[j]);
    }
}

/* T [6 x 12]: what the right end does beyond following the left one as a rigid body. */
static void relative(double *T, double h)
{
    memset(T, 0, 6 * 12 * sizeof *T);
    for (int a = 0; a < 6; a++) {
        T[a + 6 * a] = -1;
        T[a + 6 * (a + 6)] = 1;
    }
    T[1 + 6 * 5] = -h; /* theta x e_x h = (0, h rz, -h ry) */
    T[2 + 6 * 4] = h;
}

/* A += b' S ds, b = (force, moment) at the section by the end loads: what moves the end where the section strains. */
static void add_flexibility(double *A, const double *S, double arm, double ds)
{
    for (int j = 0; j < 6; j++) {
        const double *e = S + 6 * j;
        for (int i = 0; i < 6; i++) A[i + 6 * j] += ds * e[i];
        A[1 + 6 * j] += ds * arm * e[5];
        A[2 + 6 * j] -= ds * arm * e[4];
    }
}

/* o += theta x e_x + Gamma, the slope of the displacement. */
static void add_slope(double *o, double ds, const double *fields)
{
    const double *theta = fields + ROD_THETA;
    v3_axpy(o, ds, fields + ROD_GAMMA);
    o[1] += ds * theta[2];
    o[2] -= ds * theta[1];
}

/* theta and r at the Gauss points from the strains there: running integrals from the left node. */
static void integrate(struct rod_point *p, double h)
{
    for (int j = 0; j < 12; j++)
        for (int g = 0; g < ROD_GAUSS; g++) {
            double *theta = p[g].N + 12 * j + ROD_THETA;
            for (int a = 0; a < 3; a++) theta[a] = j == 3 + a;
            for (int k = 0; k < ROD_GAUSS; k++) v3_axpy(theta, h * rod_gauss.part[g][k], p[k].N + 12 * j + ROD_KAPPA);
        }
    for (int j = 0; j < 12; j++)
        for (int g = 0; g < ROD_GAUSS; g++) {
            double *r = p[g].N + 12 * j + ROD_R;
            for (int a = 0; a < 3; a++) r[a] = j == a;
            for (int k = 0; k < ROD_GAUSS; k++) add_slope(r, h * rod_gauss.part[g][k], p[k].N + 12 * j);
        }
}

/* N [6 x 12] strains = S G, into rows of N [12 x 12]. */
static void strains(double *N, const double *S, const double *G)
{
    for (int j = 0; j < 12; j++)
        for (int i = 0; i < 6; i++) {
            double sum = 0;
            for (int k = 0; k < 6; k++) sum += S[i + 6 * k] * G[k + 6 * j];
            N[ROD_GAMMA + i + 12 * j] = sum;
        }
}

static const double SHORT = .3;  /* of the elements asked for, and of a hundredth of the beam */
static const double SLIP = 1e-8; /* of length^2 int ds/EI */

/* Slip [2], along y and z by a force across: 12 EI/h^3 of a short element, as between two places close to each other,
 * would drown what bends the beam in round-off.  It slips by next to nothing of what the same force bends the beam. */
static void slip_of_short(double *slip, const struct rod *o)
{
    double F[9], B[9];
    slip[0] = slip[1] = 0;
    for (int k = 0; k < ROD_GAUSS * (o->nnode - 1); k++) {
        const int e = k / ROD_GAUSS, g = k % ROD_GAUSS;
        const double h = o->s[e + 1] - o->s[e], ds = SLIP * o->length * o->length * rod_gauss.w[g] * h;
        section_give(F, B, o->beam, (o->s[e] + rod_gauss.x[g] * h) / o->length);
        slip[0] += ds * B[8];
        slip[1] += ds * B[4];
    }
}

/* G = A^-1 T with the flexibility A; zero where A is not positive. */
static void build_element(struct rod *o, int element, const double *slip)
{
    struct rod_point *p = o->point + ROD_GAUSS * element;
    double A[36] = {0}, S[ROD_GAUSS][36], *G = o->G + 72 * element, right = o->s[element + 1];
    double h = right - o->s[element];
    for (int g = 0; g < ROD_GAUSS; g++) {
        p[g].s = o->s[element] + rod_gauss.x[g] * h;
        p[g].ds = rod_gauss.w[g] * h;
        section_mass(&p[g], o->beam, p[g].s / o->length);
        strain_by_load(S[g], o->beam, p[g].s / o->length, right - p[g].s);
        add_flexibility(A, S[g], right - p[g].s, p[g].ds);
    }
    if (h * fmax(o->beam->elements, 100) < SHORT * o->length)
        for (int a = 0; a < 2; a++) A[7 * (a + 1)] += slip[a];
    relative(G, h);
    if (dense_cholesky(A, 6, 6) < 0)
        dense_cholesky_solves(A, G, 6, 6, 12, 6);
    else
        memset(G, 0, 72 * sizeof *G);
    for (int g = 0; g < ROD_GAUSS; g++) strains(p[g].N, S[g], G);
    integrate(p, h);
}

void rod_build(struct rod *o, const struct flex_beam *beam, double length, struct arena *life)
{
    double slip[2];
    o->beam = beam;
    o->per = beam->space == 2 ? 3 : 6;
    o->length = length;
    mesh(o, beam, life);
    o->point = TAKE(life, struct rod_point, ROD_GAUSS * (o->nnode - 1));
    o->G = TAKE(life, double, 72 * (o->nnode - 1));
    slip_of_short(slip, o);
    for (int e = 0; e < o->nnode - 1; e++) build_element(o, e, slip);
}

/* ---- matrices ---- */

int rod_freedom(const struct rod *o, int element, int k)
{
    static const int flat[6] = {0, 1, -1, -1, -1, 2};
    int node = element + k / 6, own = o->per == 6 ? k % 6 : flat[k % 6];
    return own < 0 ? -1 : node * o->per + own;
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* K += T' G. */
static void add_stiffness(struct band *K, const struct rod *o, int element)
{
    double T[72], *G = o->G + 72 * element;
    relative(T, o->s[element + 1] - o->s[element]);
    for (int j = 0; j < 12; j++)
        for (int i = j; i < 12; i++) {
            int a = rod_freedom(o, element, i), b = rod_freedom(o, element, j);
            if (a >= 0 && b >= 0) *band_at(K, a, b) += dot(T + 6 * i, G + 6 * j, 6);
        }
}

/* M += (m r'r + theta' I theta) ds. */
static void add_mass(struct band *M, const struct rod *o, int element, const struct rod_point *p)
{
    for (int j = 0; j < 12; j++) {
        const double *right = p->N + 12 * j;
        double h[3];
        m3_mul(h, p->I, right + ROD_THETA);
        for (int i = j; i < 12; i++) {
            int a = rod_freedom(o, element, i), b = rod_freedom(o, element, j);
            const double *left = p->N + 12 * i;
            if (a >= 0 && b >= 0)
                *band_at(M, a, b) += p->ds * (p->m * v3_dot(left, right) + v3_dot(left + ROD_THETA, h));
        }
    }
}

static void add_lump(struct band *M, const struct rod *o, int node, double mass, const double *I)
{
    int first = node * o->per, flat = o->per == 3;
    for (int a = 0; a < 3 - flat; a++) *band_at(M, first + a, first + a) += mass;
    if (flat) *band_at(M, first + 2, first + 2) += I[8];
    for (int b = 0; !flat && b < 3; b++)
        for (int a = b; a < 3; a++) *band_at(M, first + 3 + a, first + 3 + b) += I[a + 3 * b];
}

void rod_matrices(struct band *K, struct band *M, const struct rod *o, const double *inertia, struct arena *life)
{
    const struct flex_beam *beam = o->beam;
    *K = band_take(o->nnode * o->per, 2 * o->per - 1, life);
    *M = band_take(o->nnode * o->per, 2 * o->per - 1, life);
    for (int e = 0; e < o->nnode - 1; e++) add_stiffness(K, o, e);
    for (int k = 0; k < ROD_GAUSS * (o->nnode - 1); k++) add_mass(M, o, k / ROD_GAUSS, &o->point[k]);
    for (int k = 0; k < beam->nlump; k++)
        add_lump(M, o, rod_node(o, beam->lump[k].station), beam->lump[k].mass, inertia + 9 * k);
}
