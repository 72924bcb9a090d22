/* choice_loads.c -- inertia of a flexible body as forces on its coordinates; see choice.h */
#include "flex/choice.h"
#include "la/vec3.h"

/* From the reference node to the centre of mass. */
static void arm(double *x, const struct flex_body *o)
{
    v3_scale(x, -1, o->node[o->reference].x);
}

void flex_inertia_load(double *p, const struct flex_body *o, const double *d)
{
    double a[3];
    arm(a, o);
    for (int k = 0; k < o->n; k++) {
        const double *xf = o->xf + 9 * k, *f = o->f + 3 * k;
        double h[3], moment[3] = {xf[7] - xf[5], xf[2] - xf[6], xf[3] - xf[1]}; /* int x x phi dm */
        v3_cross(h, a, f);
        v3_add(h, moment);
        v3_add(h, o->rpsi + 3 * k);
        p[k] = -v3_dot(d, f) - v3_dot(d + 3, h);
    }
}

double flex_inertia_between(const struct flex_body *o, const double *d, const double *e)
{
    double a[3], vd[3], ve[3], sum = 0;
    const double trace = o->xx[0] + o->xx[4] + o->xx[8];
    arm(a, o);
    v3_cross(vd, d + 3, a);
    v3_add(vd, d);
    v3_cross(ve, e + 3, a);
    v3_add(ve, e);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum += d[3 + i] * e[3 + j] * ((i == j ? trace : 0) - o->xx[i + 3 * j] + o->rot[i + 3 * j]);
    return sum + o->mass * v3_dot(vd, ve);
}

/* -w x (w x (x - x0)) = w^2 (x - x0) - w w.(x - x0) */
void flex_centrifugal_load(double *p, const struct flex_body *o, const double *w, const double *x0)
{
    const double ww = v3_dot(w, w), wx0 = v3_dot(w, x0);
    for (int k = 0; k < o->n; k++) {
        const double *xf = o->xf + 9 * k, *f = o->f + 3 * k;
        double sum = ww * (xf[0] + xf[4] + xf[8]) - ww * v3_dot(x0, f) + wx0 * v3_dot(w, f);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) sum -= w[i] * xf[i + 3 * j] * w[j];
        p[k] = sum;
    }
}
