/* rod_fields.c -- what columns of a beam's mesh mean along it: displacements, rotations, strains, forces; see rod.h. */
#include <string.h>

#include "flex/rod.h"

/* W [12 x n] = N times the rows of Phi that belong to the element. */
static void apply(double *W, const double *N, const struct rod *o, int element, const double *Phi, int n)
{
    int size = o->nnode * o->per;
    memset(W, 0, (size_t)(12 * n) * sizeof *W);
    for (int j = 0; j < n; j++)
        for (int k = 0; k < 12; k++) {
            int a = rod_freedom(o, element, k);
            double q = a < 0 ? 0 : Phi[a + (long)size * j];
            for (int i = 0; q != 0 && i < 12; i++) W[i + 12 * j] += N[i + 12 * k] * q;
        }
}

void rod_at_point(double *W, const struct rod *o, int point, const double *Phi, int n)
{
    apply(W, o->point[point].N, o, point / ROD_GAUSS, Phi, n);
}

void rod_at_node(double *W, const struct rod *o, int node, const double *Phi, int n)
{
    int size = o->nnode * o->per, element = node < o->nnode - 1 ? node : node - 1, first = 6 * (node - element);
    memset(W, 0, (size_t)(12 * n) * sizeof *W);
    for (int j = 0; j < n; j++)
        for (int k = 0; k < 6; k++) {
            int a = rod_freedom(o, element, first + k);
            if (a >= 0) W[k + 12 * j] = Phi[a + (long)size * j];
        }
}

/* Where the pull may jump, or ends: joints, places of loads, masses. */
static bool loaded(const struct rod *o, int node)
{
    const struct flex_beam *beam = o->beam;
    if (node == 0 || node == o->nnode - 1) return true;
    for (int i = 0; i < beam->ninterface; i++)
        if (rod_node(o, beam->interface[i]) == node) return true;
    for (int i = 0; i < beam->npoint; i++)
        if (rod_node(o, beam->point[i]) == node) return true;
    for (int i = 0; i < beam->nlump; i++)
        if (rod_node(o, beam->lump[i].station) == node) return true;
    return false;
}

static double middle(const struct rod *o, int element)
{
    return (o->s[element] + o->s[element + 1]) / 2;
}

/* The element across the nearer node that carries no load, else across the other; -1: none. */
static int neighbour(const struct rod *o, int element, double s)
{
    int nearer = s < middle(o, element) ? -1 : 1;
    for (int side = nearer, k = 0; k < 2; k++, side = -side)
        if (!loaded(o, side < 0 ? element : element + 1)) return element + side;
    return -1;
}

/* Row of force and moment at the right end of an element. */
static double load(const struct rod *o, int element, int row, const double *phi)
{
    double sum = 0;
    for (int k = 0; k < 12; k++) {
        int a = rod_freedom(o, element, k);
        if (a >= 0) sum += o->G[72 * element + 6 * k + row] * phi[a];
    }
    return sum;
}

/* Forces and torque of an element are its means; from middle to middle they are taken as linear. */
void rod_forces(double *Q, const struct rod *o, double station, const double *Phi, int n)
{
    double s = station * o->length, share = 0;
    int e = 0, size = o->nnode * o->per;
    while (e < o->nnode - 2 && o->s[e + 1] <= s + ROD_SAME * o->length) e++;
    const int other = neighbour(o, e, s);
    const double arm = o->s[e + 1] - s;
    if (other >= 0) share = (s - middle(o, e)) / (middle(o, other) - middle(o, e));
    for (int j = 0; j < n; j++) {
        const double *phi = Phi + (long)size * j;
        double *q = Q + 6 * j;
        for (int i = 0; i < 6; i++) q[i] = load(o, e, i, phi);
        q[4] -= arm * q[2];
        q[5] += arm * q[1];
        for (int i = 0; other >= 0 && i < 4; i++) q[i] += share * (load(o, other, i, phi) - q[i]);
    }
}
