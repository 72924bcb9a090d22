/* second.c -- see second.h */
#include "flex/second.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"
#include "la/vec3.h"

/* A field (x.p) e_a, or e_a where p is NULL; moment: its second moment, the mass or l. */
struct field {
    int a;
    const double *p;
    double moment;
};

/* B of one field, from s or xs: how much of S_ij it is. */
static double share(const struct field *o, const struct flex_body *b, int ij)
{
    if (!o->p) return b->s[3 * ij + o->a] / o->moment;
    return v3_dot(o->p, b->xs + 9 * ij + 3 * o->a) / o->moment;
}

/* All fields that may be wanted; p [9], l [3] principal axes of xx. */
static int fields_of(struct field *o, const struct flex_body *b, double *p, double *l)
{
    int n = 0;
    double all = b->xx[0] + b->xx[4] + b->xx[8];
    double A[9];
    memcpy(A, b->xx, sizeof A);
    eigen_symmetric(l, p, A, 3);
    for (int a = 0; a < 3; a++) o[n++] = (struct field){a, NULL, b->mass};
    for (int k = 0; k < 3; k++)
        for (int a = 0; l[k] > 1e-9 * all && a < 3; a++) o[n++] = (struct field){a, p + 3 * k, l[k]};
    return n;
}

/* Keeps the fields of which S has anything at all; B goes with them. */
static int pick(struct field *field, int nfield, double *B, const struct flex_body *b)
{
    const int nn = b->n * b->n;
    int m = 0;
    double most = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < nfield; k++) {
            double *to = B + (long)m * nn, size = 0;
            for (int ij = 0; ij < nn; ij++) {
                int ji = ij / b->n + b->n * (ij % b->n);
                to[ij] = (share(&field[k], b, ij) + share(&field[k], b, ji)) / 2;
                size = fmax(size, fabs(to[ij]) * sqrt(field[k].moment));
            }
            if (pass == 0)
                most = fmax(most, size);
            else if (size > 1e-12 * most)
                field[m++] = field[k];
        }
    return m;
}

/* int (first) (second)' dm over a pair of fields: (e or x.p) e_a, (e or x.p) e_b. */
static double overlap(const struct field *f, const struct field *g)
{
    if (!f->p != !g->p) return 0;
    return f->p == g->p ? f->moment : 0;
}

/* Integrals of field f, the whole's coordinate j, alone and, of hinged bodies, with the body's own. */
static void add_field(struct flex_body *w, const struct flex_body *b, const struct field *f, int j)
{
    const int n = b->hinged ? b->n : 0;
    if (!f->p) w->f[3 * j + f->a] = b->mass;
    if (f->p) v3_scale(w->xf + 9 * j + 3 * f->a, f->moment, f->p); /* column a of x (x.p) e_a' */
    for (int i = 0; i < n; i++) {
        double phi[3]; /* int phi_i (1 or x.p) dm */
        if (f->p)
            m3_tmul(phi, b->xf + 9 * i, f->p);
        else
            v3_copy(phi, b->f + 3 * i);
        for (int c = 0; c < 3; c++) {
            w->ff[9 * (i + w->n * j) + 3 * f->a + c] = phi[c]; /* phi e_a' */
            w->ff[9 * (j + w->n * i) + 3 * c + f->a] = phi[c];
        }
    }
}

static void copy_own(struct flex_body *w, const struct flex_body *b)
{
    const int n = b->n;
    w->mass = b->mass;
    memcpy(w->xx, b->xx, sizeof w->xx);
    memcpy(w->rot, b->rot, sizeof w->rot);
    memcpy(w->f, b->f, 3 * sizeof *w->f * (size_t)n);
    memcpy(w->xf, b->xf, 9 * sizeof *w->xf * (size_t)n);
    memcpy(w->rpsi, b->rpsi, 3 * sizeof *w->rpsi * (size_t)n);
    for (int j = 0; j < n; j++) {
        memcpy(w->ff + 9 * w->n * j, b->ff + 9 * n * j, 9 * sizeof *w->ff * (size_t)n);
        memcpy(w->ppsi + w->n * j, b->ppsi + n * j, sizeof *w->ppsi * (size_t)n);
    }
}

/* M and c of the fields that were kept: x - x_0 has the coefficients -x_0 along e_a, p_a along (x.p) e_a. */
static void stretch(struct flex_second *o, const struct flex_body *b, const struct field *field, struct arena *life)
{
    const double *x0 = b->nnode ? b->node[b->reference].x : NULL;
    double square = 0;
    o->M = TAKE(life, double, o->m * o->m);
    o->c = TAKE(life, double, o->m);
    for (int k = 0; k < o->m; k++) {
        const struct field *f = &field[k];
        for (int h = 0; h < o->m; h++)
            if (field[h].a == f->a) o->M[k + o->m * h] = overlap(f, &field[h]);
        o->c[k] = f->p ? f->p[f->a] : x0 ? -x0[f->a] : 0;
        square += o->c[k] * o->c[k] * f->moment;
    }
    for (int k = 0; k < o->m; k++) o->c[k] = square > 0 ? o->c[k] / square : 0;
}

struct flex_second *flex_second_build(const struct flex_body *b, struct arena *life)
{
    enum { MOST = 12 };
    struct flex_second *o = TAKE(life, struct flex_second, 1);
    struct field field[MOST];
    double p[9], l[3];
    o->n = b->n;
    if (b->s) {
        o->B = TAKE(life, double, (MOST + 1) * b->n * b->n);
        o->m = pick(field, fields_of(field, b, p, l), o->B, b);
        if (b->hinged) stretch(o, b, field, life);
    }
    o->whole = flex_body_take(b->n + o->m, 0, 0, false, life);
    copy_own(o->whole, b);
    for (int k = 0; k < o->m; k++) {
        add_field(o->whole, b, &field[k], b->n + k);
        for (int h = 0; b->hinged && h < o->m; h++)
            o->whole->ff[9 * (b->n + k + o->whole->n * (b->n + h)) + 3 * field[h].a + field[k].a] =
                overlap(&field[k], &field[h]);
    }
    return o;
}

/* Bq: dz/dq [n x m], dy/dq [n x m], y [m], M y [m]. */
struct slots {
    double *z1, *y1, *y, *My;
};

static struct slots slots_of(const struct flex_second *o, const double *Bq)
{
    const int nm = o->n * o->m;
    double *x = (double *)Bq; /* the caller's own */
    return (struct slots){x, x + nm, x + 2 * nm, x + 2 * nm + o->m};
}

size_t flex_second_room(const struct flex_second *o)
{
    return (size_t)(2 * o->n * o->m + 2 * o->m + 1);
}

void flex_second_at(double *x, double *Bq, const struct flex_second *o, const double *q)
{
    const int n = o->n, m = o->m;
    const struct slots at = slots_of(o, Bq);
    double square = 0;
    const bool whole = o->M != NULL;
    for (int i = 0; i < n; i++) x[i] = q[i];
    for (int k = 0; k < m; k++) {
        const double *B = o->B + (long)n * n * k;
        double *restrict y1 = at.y1 + n * k, y = 0;
        for (int i = 0; i < n; i++) y1[i] = 0;
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) y1[i] += B[i + n * j] * q[j];
        for (int i = 0; i < n; i++) y += y1[i] * q[i];
        at.y[k] = y / 2;
    }
    for (int k = 0; whole && k < m; k++) {
        at.My[k] = 0;
        for (int h = 0; h < m; h++) at.My[k] += o->M[k + m * h] * at.y[h];
        square += at.My[k] * at.y[k];
    }
    for (int k = 0; k < m; k++) {
        x[n + k] = at.y[k] - (whole ? o->c[k] * square / 2 : 0);
        for (int i = 0; i < n; i++) at.z1[i + n * k] = at.y1[i + n * k];
    }
    for (int k = 0; k < m; k++)
        for (int h = 0; whole && o->c[k] != 0 && h < m; h++)
            for (int i = 0; i < n; i++) at.z1[i + n * k] -= o->c[k] * at.My[h] * at.y1[i + n * h];
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

void flex_second_rate(double *x1, const struct flex_second *o, const double *Bq, const double *q1)
{
    const int n = o->n;
    for (int i = 0; i < n; i++) x1[i] = q1[i];
    for (int k = 0; k < o->m; k++) x1[n + k] = dot(Bq + n * k, q1, n);
}

/* What z'' has without q'': y''_k = q1'B_k q1, and of the term in c, -(y1'M y1 + (M y)'y''). */
static void curve(double *x2, const struct flex_second *o, const double *Bq, const double *q1)
{
    const int n = o->n, m = o->m;
    const struct slots at = slots_of(o, Bq);
    const bool whole = o->M != NULL;
    double sum = 0;
    for (int k = 0; k < m; k++) {
        const double *B = o->B + (long)n * n * k;
        double y2 = 0;
        for (int j = 0; j < n; j++) y2 += dot(B + n * j, q1, n) * q1[j];
        x2[n + k] += y2;
        if (whole) sum += at.My[k] * y2;
        for (int h = 0; whole && h < m; h++)
            if (o->M[k + m * h] != 0) sum += o->M[k + m * h] * dot(at.y1 + n * k, q1, n) * dot(at.y1 + n * h, q1, n);
    }
    for (int k = 0; whole && k < m; k++) x2[n + k] -= o->c[k] * sum;
}

void flex_second_acceleration(double *x2, const struct flex_second *o, const double *Bq, const double *q1,
                              const double *q2)
{
    const int n = o->n;
    for (int i = 0; i < n; i++) x2[i] = q2 ? q2[i] : 0;
    for (int k = 0; k < o->m; k++) x2[n + k] = q2 ? dot(Bq + n * k, q2, n) : 0;
    if (q1) curve(x2, o, Bq, q1);
}

void flex_second_mass(double *Me, const struct flex_second *o, const double *Bq, const double *whole)
{
    const int n = o->n, N = n + o->m;
    for (int j = 0; j < n; j++)
        for (int i = 0; i <= j; i++) {
            double x = whole[i + N * j];
            for (int k = 0; k < o->m; k++) {
                const double *column = whole + N * (n + k);
                double bi = Bq[i + n * k], bj = Bq[j + n * k], y = bi * column[j] + column[i] * bj;
                for (int h = 0; h < o->m; h++) y += bi * column[n + h] * Bq[j + n * h];
                x += y;
            }
            Me[i + n * j] = Me[j + n * i] = x;
        }
}
