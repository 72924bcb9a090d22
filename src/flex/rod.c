/* rod.c -- see rod.h */
#include "flex/rod.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

/* Abramowitz & Stegun 25.4.30 moved to 0 ... 1; part: Lagrange's polynomials integrated. */
const struct rod_gauss rod_gauss = {
    {0.046910077030668004, 0.23076534494715845, 0.50000000000000000, 0.76923465505284155, 0.95308992296933200},
    {0.11846344252809454, 0.23931433524968323, 0.28444444444444444, 0.23931433524968323, 0.11846344252809454},
    {
        {0.059231721264047272, -0.019570364359076037, 0.011254400818642956, -0.0055937936608121849, 0.0015881129678659985},
        {0.12815100567004528, 0.11965716762484162, -0.024592114619642200, 0.010318280670683357, -0.0027689943987696030},
        {0.11377628800422460, 0.26000465168064152, 0.14222222222222222, -0.020690316430958285, 0.0046871545238699412},
        {0.12123243692686415, 0.22899605457899988, 0.30903655906408664, 0.11965716762484162, -0.0096875631419507397},
        {0.11687532956022855, 0.24490812891049542, 0.27319004362580149, 0.25888469960875927, 0.059231721264047272},
    },
};

/* ---- mesh ---- */

static const double SAME = 1e-9; /* stations nearer than this are one */

static void insert(double *list, int *n, double x)
{
    int k = 0;
    while (k < *n && list[k] < x - SAME) k++;
    if (k < *n && list[k] <= x + SAME) return;
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

int rod_element(const struct rod *o, double s)
{
    int e = 0;
    while (e < o->nnode - 2 && o->s[e + 1] <= s + SAME * o->length) e++;
    return e;
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
    double t = (station - a->station) / (b->station - a->station);
#define MIX(x) o->x = (1 - t) * a->x + t * b->x
    MIX(A), MIX(Iy), MIX(Iz), MIX(J), MIX(ky), MIX(kz), MIX(twist), MIX(rotary), MIX(y), MIX(z);
#undef MIX
    o->station = station;
}

/* (T_yy, T_zz, T_yz) of the tensor diag(p, q) turned by the angle about x. */
static void turned(double *T, double p, double q, double angle)
{
    double c = cos(angle), s = sin(angle);
    T[0] = c * c * p + s * s * q;
    T[1] = s * s * p + c * c * q;
    T[2] = c * s * p - c * s * q;
}

static void put(double *A, int ld, int y, int z, const double *T)
{
    A[y + ld * y] = T[0];
    A[z + ld * z] = T[1];
    A[y + ld * z] = A[z + ld * y] = T[2];
}

static void take_section(struct rod_point *o, const struct flex_beam *beam, double station)
{
    struct flex_section c;
    double T[3];
    rod_section(&c, beam, station);
    o->m = beam->density * c.A;
    o->I[0] = beam->density * (c.Iy + c.Iz);
    turned(T, c.rotary * beam->density * c.Iy, c.rotary * beam->density * c.Iz, c.twist);
    put(o->I, 3, 1, 2, T);
    o->C[0] = beam->E * c.A;
    o->C[3 + 6 * 3] = beam->G * c.J;
    turned(T, beam->G * c.A * c.ky, beam->G * c.A * c.kz, c.twist);
    put(o->C, 6, 1, 2, T);
    turned(T, beam->E * c.Iy, beam->E * c.Iz, c.twist);
    put(o->C, 6, 4, 5, T);
}

/* ---- shape functions ---- */

static void stretch(double *N, int row, int strain, int column, double xi, double h)
{
    N[row + 12 * column] = 1 - xi;
    N[row + 12 * (column + 6)] = xi;
    N[strain + 12 * column] = -1 / h;
    N[strain + 12 * (column + 6)] = 1 / h;
}

/* Bending along row a (1: y, 2: z), section rotation about row b with sign (rz = v', ry = -w').  P is Phi =
 * 12 EI / (k G A h^2). */
static void bend(double *N, int a, int b, double sign, double xi, double h, double P)
{
    double mu = 1 / (1 + P), xi2 = xi * xi, xi3 = xi2 * xi;
    double v[4] = {1 - 3 * xi2 + 2 * xi3 + P * (1 - xi), h * (xi - 2 * xi2 + xi3 + P * (xi - xi2) / 2),
                   3 * xi2 - 2 * xi3 + P * xi, h * (xi3 - xi2 - P * (xi - xi2) / 2)};
    double turn[4] = {6 * (xi2 - xi) / h, 1 - 4 * xi + 3 * xi2 + P * (1 - xi), 6 * (xi - xi2) / h,
                      3 * xi2 - 2 * xi + P * xi};
    double bent[4] = {(12 * xi - 6) / (h * h), (6 * xi - 4 - P) / h, (6 - 12 * xi) / (h * h), (6 * xi - 2 + P) / h};
    double slid[4] = {-P / h, -P / 2, P / h, -P / 2};
    int column[4] = {a, 3 + b, 6 + a, 9 + b};
    for (int k = 0; k < 4; k++) {
        double *c = N + 12 * column[k], f = k % 2 ? mu * sign : mu;
        c[ROD_R + a] = f * v[k];
        c[ROD_THETA + b] = f * sign * turn[k];
        c[ROD_GAMMA + a] = f * slid[k];
        c[ROD_KAPPA + b] = f * sign * bent[k];
    }
}

/* From axes turned by the angle about x to beam axes: rows, then columns, three by three. */
static void turn_fields(double *N, double angle)
{
    double c = cos(angle), s = sin(angle);
    if (angle == 0) return;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < 12; k++)
            for (int a = 0; a < 12; a += 3) {
                double *y = pass ? N + k + 12 * (a + 1) : N + 12 * k + a + 1, *z = y + (pass ? 12 : 1);
                double ye = *y, ze = *z;
                *y = c * ye - s * ze;
                *z = s * ye + c * ze;
            }
}

static double slack(double EI, double GA, double h)
{
    return GA > 0 ? 12 * EI / (GA * h * h) : 0;
}

void rod_fields(double *N, const struct rod *o, int element, double s)
{
    const struct flex_beam *beam = o->beam;
    struct flex_section c;
    double h = o->s[element + 1] - o->s[element], xi = (s - o->s[element]) / h;
    rod_section(&c, beam, (o->s[element] + h / 2) / o->length);
    memset(N, 0, 12 * 12 * sizeof *N);
    stretch(N, ROD_R, ROD_GAMMA, 0, xi, h);
    stretch(N, ROD_THETA, ROD_KAPPA, 3, xi, h);
    bend(N, 1, 2, 1, xi, h, slack(beam->E * c.Iz, beam->G * c.A * c.ky, h));
    bend(N, 2, 1, -1, xi, h, slack(beam->E * c.Iy, beam->G * c.A * c.kz, h));
    turn_fields(N, c.twist);
}

void rod_build(struct rod *o, const struct flex_beam *beam, double length, struct arena *life)
{
    o->beam = beam;
    o->per = beam->space == 2 ? 3 : 6;
    o->length = length;
    mesh(o, beam, life);
    o->point = TAKE(life, struct rod_point, ROD_GAUSS * (o->nnode - 1));
    for (int k = 0; k < ROD_GAUSS * (o->nnode - 1); k++) {
        int e = k / ROD_GAUSS, g = k % ROD_GAUSS;
        double h = o->s[e + 1] - o->s[e];
        o->point[k].s = o->s[e] + rod_gauss.x[g] * h;
        o->point[k].ds = rod_gauss.w[g] * h;
        take_section(&o->point[k], beam, o->point[k].s / length);
        rod_fields(o->point[k].N, o, e, o->point[k].s);
    }
}

/* ---- matrices ---- */

/* Freedom k of an element, of twelve, in the mesh; -1: held by the plane. */
static int freedom(const struct rod *o, int element, int k)
{
    static const int flat[6] = {0, 1, -1, -1, -1, 2};
    int node = element + k / 6, own = o->per == 6 ? k % 6 : flat[k % 6];
    return own < 0 ? -1 : node * o->per + own;
}

/* Y [rows x 12] = A X, A [rows x rows]; X, Y in matrices of 12 rows. */
static void times(double *Y, const double *A, const double *X, int rows)
{
    for (int j = 0; j < 12; j++)
        for (int i = 0; i < rows; i++) {
            double sum = 0;
            for (int k = 0; k < rows; k++) sum += A[i + rows * k] * X[k + 12 * j];
            Y[i + 12 * j] = sum;
        }
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* K += N' C N ds over the strains, M += (m r'r + theta' I theta) ds. */
static void add_point(struct band *K, struct band *M, const struct rod *o, int element, const struct rod_point *p)
{
    double F[12 * 12], H[12 * 12];
    times(F, p->C, p->N + ROD_GAMMA, 6);
    times(H, p->I, p->N + ROD_THETA, 3);
    for (int j = 0; j < 12; j++)
        for (int i = j; i < 12; i++) {
            int a = freedom(o, element, i), b = freedom(o, element, j);
            const double *c = p->N + 12 * i;
            if (a < 0 || b < 0) continue;
            *band_at(K, a, b) += p->ds * dot(c + ROD_GAMMA, F + 12 * j, 6);
            *band_at(M, a, b) += p->ds * (p->m * dot(c, p->N + 12 * j, 3) + dot(c + ROD_THETA, H + 12 * j, 3));
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
    for (int k = 0; k < ROD_GAUSS * (o->nnode - 1); k++) add_point(K, M, o, k / ROD_GAUSS, &o->point[k]);
    for (int k = 0; k < beam->nlump; k++)
        add_lump(M, o, rod_node(o, beam->lump[k].station), beam->lump[k].mass, inertia + 9 * k);
}

void rod_apply(double *W, const double *N, const struct rod *o, int element, const double *Phi, int n)
{
    int size = o->nnode * o->per;
    memset(W, 0, (size_t)(12 * n) * sizeof *W);
    for (int j = 0; j < n; j++)
        for (int k = 0; k < 12; k++) {
            int a = freedom(o, element, k);
            double q = a < 0 ? 0 : Phi[a + (long)size * j];
            for (int i = 0; q != 0 && i < 12; i++) W[i + 12 * j] += N[i + 12 * k] * q;
        }
}
