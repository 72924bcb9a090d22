/* planar_flex_mass.c -- M^ in the plane with flexible bodies, by composite bodies.
 *
 * Wrenches are (N, Fx, Fy), twists (w, vx, vy).  With B_c = [psi; R (phi + S q)] [3 x n] the partial twists of the
 * body at node c, C_c the inertia of all that hangs on it held stiff, and X_c carrying a wrench from there to the
 * frame's origin, the modes' columns are
 *
 *     frame:  U = [G; R H] + sum X_c C_c B_c          modes:  Me + sum B_c' C_c B_c
 *
 * and U goes on inwards like any other wrench: to a joint's rows as s . f, at a node to the rows of the modes there
 * as B'f. */
#include <string.h>

#include "la/vec3.h"
#include "tree/planar_flex.h"

/* Inertia of the bent bodies about their frames' origins. */
void planar_flex_compose(struct sweep *s, const struct roster *o)
{
    for (int i = 0; i < o->n; i++) {
        struct flexible *b = s->bend[o->body[i]];
        struct part *x = &s->part[o->body[i]];
        if (!b || !o->bears[i]) continue;
        planar_flex_shape(b);
        x->cm = s->model->body[o->body[i]].mass;
        planar_flex_first_moment(x->cs, b);
        x->cj = b->shape.J;
    }
}

/* f = C u of the composite body x. */
static inline void wrench(double *f, const struct part *x, const double *u)
{
    f[0] = x->cj * u[0] + x->cs[0] * u[2] - x->cs[1] * u[1];
    f[1] = x->cm * u[1] - u[0] * x->cs[1];
    f[2] = x->cm * u[2] + u[0] * x->cs[0];
}

static inline void put(double *M, int n, int i, int j, double x)
{
    M[i + (size_t)n * j] = x;
    M[j + (size_t)n * i] = x;
}

/* Column col of all rows from body inwards, for the wrench f about its centre; f is used up. */
static void rise(double *M, const struct sweep *s, double *f, int body, int col)
{
    double u[3];
    for (int i = body; i > 0; i = s->link[i].parent) {
        const struct part *x = &s->part[i];
        const struct link *l = &s->link[i];
        const struct node_body *o = s->node_body[i];
        for (int k = 0; k < l->nv; k++) {
            planar_unit(u, x, l, k);
            put(M, s->n, l->iv[k], col, v3_dot(u, f));
        }
        for (int k = 0; o && k < o->of->n; k++) {
            planar_node_body_unit(u, o, k);
            put(M, s->n, o->of->iv[k], col, v3_dot(u, f));
        }
        f[0] += x->arm[0] * f[2] - x->arm[1] * f[1];
    }
}

void planar_flex_own(struct flexible *b)
{
    flex_planar_mass(b->M, b->U, b->kernel, &b->shape);
    for (int k = 0; k < b->n; k++) {
        double *U = b->U + 3 * k, x = U[1];
        U[1] = b->cs[0] * x - b->cs[1] * U[2];
        U[2] = b->cs[1] * x + b->cs[0] * U[2];
    }
}

void planar_flex_couple(const struct node_body *o, const double *I, const double *arm)
{
    const struct flexible *b = o->of;
    if (I[0] == 0 && I[3] == 0) return; /* nothing with mass hangs there */
    for (int k = 0; k < b->n; k++) {
        double u[3], f[3], *U = b->U + 3 * k;
        planar_node_body_unit(u, o, k);
        f[0] = I[0] * u[0] + I[1] * u[1] + I[2] * u[2];
        f[1] = I[1] * u[0] + I[3] * u[1] + I[4] * u[2];
        f[2] = I[2] * u[0] + I[4] * u[1] + I[5] * u[2];
        for (int i = k; i < b->n; i++) {
            planar_node_body_unit(u, o, i);
            b->M[i + b->n * k] += v3_dot(u, f);
        }
        U[0] += f[0] + arm[0] * f[2] - arm[1] * f[1];
        U[1] += f[1];
        U[2] += f[2];
    }
}

/* U and the modes' block of all bent bodies; those without mass have what hangs on them. */
static void collect(struct sweep *s, const struct roster *o)
{
    for (int i = 0; i < o->n; i++) {
        struct flexible *b = s->bend[o->body[i]];
        const struct part *x = &s->part[o->body[i]];
        const double I[6] = {x->cj, -x->cs[1], x->cs[0], x->cm, 0, x->cm};
        if (s->node_body[o->body[i]]) planar_flex_couple(s->node_body[o->body[i]], I, x->arm);
        if (!b) continue;
        memset(b->U, 0, sizeof *b->U * 3 * (size_t)b->n);
        memset(b->M, 0, sizeof *b->M * (size_t)(b->n * b->n));
        if (o->bears[i]) planar_flex_own(b);
    }
}

static void mode_columns(double *M, const struct sweep *s, int body)
{
    const struct flexible *b = s->bend[body];
    for (int k = 0; k < b->n; k++) {
        for (int i = k; i < b->n; i++) put(M, s->n, b->iv[i], b->iv[k], b->M[i + b->n * k]);
        rise(M, s, b->U + 3 * k, body, b->iv[k]);
    }
}

void planar_flex_columns(double *M, struct sweep *s, const struct roster *o)
{
    collect(s, o);
    for (int i = 0; i < o->n; i++) {
        const int body = o->body[i];
        const struct link *l = &s->link[body];
        double u[3], f[3];
        for (int k = 0; k < l->nv; k++) {
            planar_unit(u, &s->part[body], l, k);
            wrench(f, &s->part[body], u);
            rise(M, s, f, body, l->iv[k]);
        }
        if (s->bend[body]) mode_columns(M, s, body);
    }
}
