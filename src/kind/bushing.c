/* bushing.c -- springs and dampers in all directions between two markers.
 *
 * In axes of the marker on a, with d = E'(x_b - x_a), its rate d' = E'(v_b - v_a - w_a x (x_b - x_a)), the rotation
 * vector phi of b's marker against a's, phi' = T' W, W the relative angular velocity:
 *
 *     V = (d.k d + phi.kr phi)/2,   losses  d'.c d' + W.cr W
 *
 * Forces act on both bodies at x_b: one line, so both momenta are kept. */
#include "kind/bushing.h"

#include <math.h>

#include "la/rot.h"
#include "la/vec3.h"

static void slide(struct strains *o, const struct bushing *p, const struct between *x)
{
    double d[3], rate[3], turned[3];
    v3_diff(d, x->b.x, x->a.x);
    v3_diff(rate, x->b.v, x->a.v);
    v3_cross(turned, x->a.w, d);
    v3_take(rate, turned);
    v3_copy(o->at_a, x->b.x);
    v3_copy(o->at_b, x->b.x);
    for (int i = 0; i < 3; i++) {
        struct strain *s = &o->of[o->n++];
        v3_copy(s->dir, x->a.E + 3 * i);
        s->s = v3_dot(s->dir, d);
        s->rate = v3_dot(s->dir, rate);
        s->slides = true;
        s->turns = false;
        s->law = (struct affine){p->k[i], p->c[i], 0, 0};
    }
}

/* A turn s about dir, which is in world axes. */
static void add_turn(struct strains *o, double s, const double *dir, const double *W, double k, double c)
{
    struct strain *to = &o->of[o->n++];
    v3_copy(to->on_b, dir);
    v3_scale(to->on_a, -1, dir);
    to->s = s;
    to->rate = v3_dot(dir, W);
    to->slides = false;
    to->turns = true;
    to->law = (struct affine){k, c, 0, 0};
}

static void turn(struct strains *o, const struct bushing *p, const struct between *x, const double *W)
{
    double R[9], phi[3], T[9], dir[3];
    m3_tmulm(R, x->a.E, x->b.E);
    vector_of_matrix(phi, R);
    vector_rate(T, phi);
    for (int i = 0; i < 3; i++) add_turn(o, 0, x->a.E + 3 * i, W, 0, p->cr[i]);
    for (int i = 0; i < 3; i++) {
        m3_mul(dir, x->a.E, T + 3 * i); /* phi_i' = (column i of T) . W */
        add_turn(o, phi[i], dir, W, p->kr[i], 0);
    }
}

static void strains(struct strains *o, const void *par, const struct between *x)
{
    const struct bushing *p = par;
    double W[3];
    o->n = 0;
    v3_diff(W, x->b.w, x->a.w);
    slide(o, p, x);
    if (x->space == 2)
        add_turn(o, x->a.E[8] * x->angle, x->a.E + 6, W, p->kr[2], p->cr[2]);
    else
        turn(o, p, x, W);
}

static const struct key keys[] = {
    MARKER_KEYS(struct bushing, on, "bushing"),
    PARAM_VECTOR(struct bushing, k, "stiffness", "N/m", 0, INFINITY, 0, "along its axes; default 0"),
    PARAM_VECTOR(struct bushing, kr, "rotation", "N m/rad", 0, INFINITY, KEY_ABOUT,
                 "stiffness about its axes; default 0"),
    PARAM_VECTOR(struct bushing, c, "damping", "N s/m", 0, INFINITY, 0, "along its axes; default 0"),
    PARAM_VECTOR(struct bushing, cr, "rotation_damping", "N m s/rad", 0, INFINITY, KEY_ABOUT,
                 "about its axes; default 0"),
    KEYS_END};

const struct force_kind force_bushing = {.name = "bushing",
                                         .brief = "springs and dampers in all directions between two bodies",
                                         .keys = keys,
                                         .size = sizeof(struct bushing),
                                         .strains = strains};
