/* parity.c -- see parity.h */
#include "flex/parity.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

static const double NOTHING = 1e-12; /* of the largest number of its table */

/* ---- turned ---- */

static double *turn_vectors(const double *old, const double *T, long many, struct arena *life)
{
    if (!old) return NULL;
    double *o = TAKE(life, double, 3 * many);
    for (long k = 0; k < many; k++) m3_mul(o + 3 * k, T, old + 3 * k);
    return o;
}

/* T B T' */
static void turn_block(double *o, const double *T, const double *B)
{
    double TB[9];
    m3_mulm(TB, T, B);
    m3_mulmt(o, TB, T);
}

static double *turn_blocks(const double *old, const double *T, long many, struct arena *life)
{
    if (!old) return NULL;
    double *o = TAKE(life, double, 9 * many);
    for (long k = 0; k < many; k++) turn_block(o + 9 * k, T, old + 9 * k);
    return o;
}

struct flex_body *flex_in_axes(const struct flex_body *old, const double *T, struct arena *life)
{
    const long n = old->n, nn = n * n;
    struct flex_body *o = TAKE(life, struct flex_body, 1);
    *o = *old;
    o->node = TAKE(life, struct flex_node, o->nnode);
    for (int k = 0; k < o->nnode; k++) {
        struct flex_node *to = &o->node[k];
        *to = old->node[k];
        m3_mul(to->x, T, old->node[k].x);
        to->phi = turn_vectors(to->phi, T, n, life);
        to->psi = turn_vectors(to->psi, T, n, life);
        to->S = turn_vectors(to->S, T, nn, life);
        to->T = turn_vectors(to->T, T, nn, life);
    }
    turn_block(o->xx, T, old->xx);
    turn_block(o->rot, T, old->rot);
    o->f = turn_vectors(old->f, T, n, life);
    o->xf = turn_blocks(old->xf, T, n, life);
    o->ff = turn_blocks(old->ff, T, nn, life);
    o->rpsi = turn_vectors(old->rpsi, T, n, life);
    o->s = turn_vectors(old->s, T, nn, life);
    o->xs = turn_blocks(old->xs, T, nn, life);
    return o;
}

/* ---- tables ---- */

/* Signs under the mirror, 1 where it changes: of vectors, of rotations, of 3 x 3 products, of plain numbers. */
static const int VECTOR[3] = {0, 0, 1}, ROTATION[3] = {1, 1, 0}, PRODUCT[9] = {0, 0, 1, 0, 0, 1, 1, 1, 0},
                 NUMBER[1] = {0};

struct table {
    const double *x; /* NULL: zero */
    const int *sign; /* [size] */
    int size;
    int by; /* coordinates that it is told by: 0, 1 or 2 */
};

enum { MOST_TABLES = 11, OF_NODE = 4 };

static void tables(struct table *to, const struct flex_body *o)
{
    const struct table all[MOST_TABLES] = {
        {o->f, VECTOR, 3, 1},    {o->xf, PRODUCT, 9, 1}, {o->rpsi, ROTATION, 3, 1}, {o->xx, PRODUCT, 9, 0},
        {o->rot, PRODUCT, 9, 0}, {o->ff, PRODUCT, 9, 2}, {o->ppsi, NUMBER, 1, 2},   {o->s, VECTOR, 3, 2},
        {o->xs, PRODUCT, 9, 2},  {o->K, NUMBER, 1, 2},   {o->D, NUMBER, 1, 2},
    };
    memcpy(to, all, sizeof all);
}

static void tables_of_node(struct table *to, const struct flex_node *o)
{
    const struct table all[OF_NODE] = {
        {o->phi, VECTOR, 3, 1}, {o->psi, ROTATION, 3, 1}, {o->S, VECTOR, 3, 2}, {o->T, ROTATION, 3, 2}};
    memcpy(to, all, sizeof all);
}

static double largest(const struct table *t, int n)
{
    double most = 0;
    const long many = !t->x ? 0 : (long)t->size * (t->by > 0 ? n : 1) * (t->by > 1 ? n : 1);
    for (long i = 0; i < many; i++) most = fmax(most, fabs(t->x[i]));
    return most;
}

/* What coordinate k shows of either sign, of the largest number. */
static void add_signs(double *shown, const struct table *t, int n, int k)
{
    const double most = largest(t, n);
    for (int i = 0; t->by == 1 && t->x && most > 0 && i < t->size; i++)
        shown[t->sign[i]] += fabs(t->x[t->size * k + i]) / most;
}

static bool is_odd(const struct flex_body *o, int k)
{
    struct table all[MOST_TABLES], node[OF_NODE];
    double shown[2] = {0, 0};
    tables(all, o);
    for (int i = 0; i < MOST_TABLES; i++) add_signs(shown, &all[i], o->n, k);
    for (int j = 0; j < o->nnode; j++) {
        tables_of_node(node, &o->node[j]);
        for (int i = 0; i < OF_NODE; i++) add_signs(shown, &node[i], o->n, k);
    }
    return shown[1] > shown[0];
}

/* Is all zero that the mirror forbids? */
static bool mirrors(const struct table *t, const bool *odd, int n)
{
    const double most = NOTHING * largest(t, n);
    const int rows = t->by > 0 ? n : 1, columns = t->by > 1 ? n : 1;
    for (int k = 0; t->x && k < columns; k++)
        for (int j = 0; j < rows; j++)
            for (int i = 0; i < t->size; i++) {
                const int sign = t->sign[i] + (t->by > 0 && odd[j]) + (t->by > 1 && odd[k]);
                if (sign % 2 && fabs(t->x[i + (long)t->size * (j + (long)n * k)]) > most) return false;
            }
    return true;
}

static double length(const struct flex_body *o)
{
    return sqrt((o->xx[0] + o->xx[4] + o->xx[8]) / o->mass);
}

bool flex_parity(bool *odd, const struct flex_body *o)
{
    struct table all[MOST_TABLES], node[OF_NODE];
    for (int k = 0; k < o->n; k++) odd[k] = is_odd(o, k);
    tables(all, o);
    for (int i = 0; i < MOST_TABLES; i++)
        if (!mirrors(&all[i], odd, o->n)) return false;
    for (int j = 0; j < o->nnode; j++) {
        if (fabs(o->node[j].x[2]) > NOTHING * length(o)) return false;
        tables_of_node(node, &o->node[j]);
        for (int i = 0; i < OF_NODE; i++)
            if (!mirrors(&node[i], odd, o->n)) return false;
    }
    return true;
}

/* Are the numbers i of each block of a table zero? */
static bool without(const struct table *t, int n, int i)
{
    const double most = NOTHING * largest(t, n);
    const long blocks = (long)(t->by > 0 ? n : 1) * (t->by > 1 ? n : 1);
    for (long k = 0; t->x && k < blocks; k++)
        if (fabs(t->x[i + t->size * k]) > most) return false;
    return true;
}

bool flex_is_plane(const struct flex_body *o)
{
    struct table all[MOST_TABLES], node[OF_NODE];
    tables(all, o);
    for (int i = 0; i < MOST_TABLES; i++)
        if (all[i].sign == PRODUCT && all[i].by > 0 && !without(&all[i], o->n, 8)) return false;
    for (int j = 0; j < o->nnode; j++) {
        tables_of_node(node, &o->node[j]);
        if (!without(&node[OF_NODE - 1], o->n, 2)) return false;
    }
    return true;
}
