/* bushing.c -- springs and dampers in all directions between two markers, right at any angle about one axis.
 *
 * Displacement.  d_i = e_i . (x_b - x_a) along axes e_i: those of the first marker, of the second, half-way between
 * them, or fixed in the world.  With w the angular velocity of these axes, d_i' = e_i . (v_b - v_a - w x (x_b - x_a)).
 *
 * Rotation.  That of the second marker's axes B against the first's, A, by swing and twist (kind/turn.h).  The swing does
 * not depend on the twist, so that V = (kx theta_x^2 + ky theta_y^2 + kz psi^2)/2 with kz = 0 is the same at any angle
 * about z.  (A quadratic form of the rotation vector is not: its stiffness against tilt grows with the turn about z.)
 * Dampers take W about the axes swung to the other marker's z axis (in the middle: as they are), which is z' across: a
 * body that spins about its tilted axis is not braked by those about x and y.
 *
 * z is the axis about which the stiffness is another than about the two others; all three differing, the softest.  If
 * all are the same the bushing is isotropic, whatever its damping, rest and preload p: with phi the rotation vector of
 * B exp(-rest) against A and psi the twist about p,
 *
 *     V = k phi.phi/2 - |p| psi,     phi' = T'W
 *
 * which is the same along axes of the first, of the second and in the middle.  For its dampers and for displacements
 * along axes in the middle z is then the axis about which damping is another, and that of the markers.  Beyond half a
 * turn phi is the shorter way back.
 *
 * Torques are opposite on the two bodies, and so are forces, which act at one point: at the marker of the body that
 * does not have the axes; half-way at the mean of both markers, with the torque by which these axes turn otherwise than
 * the mean of the bodies.  So both momenta are kept; the angular one not with axes of the world. */
#include "kind/bushing.h"

#include <math.h>
#include <string.h>

#include "kind/turn.h"
#include "la/rot.h"
#include "la/vec3.h"

/* --- rotations --------------------------------------------------------------------------------- */

/* The axis that differs from the other two; of three that differ the smallest; -1: none does. */
static int odd_one(const double *x)
{
    for (int i = 0; i < 3; i++)
        if (x[(i + 1) % 3] == x[(i + 2) % 3]) return x[i] == x[(i + 1) % 3] ? -1 : i;
    return x[0] < x[1] ? (x[0] < x[2] ? 0 : 2) : (x[1] < x[2] ? 1 : 2);
}

/* The axis of twist; -1: isotropic. */
static int twist_axis(const struct bushing *p)
{
    return odd_one(p->kr);
}

/* What turns are counted about: the axis of twist; of an isotropic bushing its preload, or where axes half-way change
 * sides with every turn and forces with them, z. */
static bool counted(double *axis, bool *in_world, const void *par)
{
    const struct bushing *p = par;
    const int z = twist_axis(p);
    const double size = v3_norm(p->preload_r);
    const bool sided = p->axes == AXES_MIDDLE && (v3_norm(p->preload) > 0 || v3_norm(p->rest) > 0);
    *in_world = p->axes == AXES_WORLD;
    v3_set(axis, z == 0, z == 1, z == 2 || z < 0);
    if (z < 0 && size > 0) v3_scale(axis, 1 / size, p->preload_r);
    return z >= 0 || size > 0 || sided;
}

/* The turns counted, about axis z; 0 where they are about none of the axes. */
static double counted_about(const struct bushing *p, int z, double twist)
{
    double axis[3];
    bool in_world;
    if (!counted(axis, &in_world, p) || fabs(axis[z]) != 1) return 0;
    return axis[z] * twist;
}

/* --- strains ----------------------------------------------------------------------------------- */

/* What a spring and damper does along s. */
static void spring(struct strain *s, struct affine law)
{
    const double x = s->s - law.rest;
    s->V = .5 * law.k * x * x - law.preload * x;
    s->f = law.preload - law.k * x;
    s->lost = -law.c * s->rate;
    s->ks = law.k;
    s->kv = law.c;
}

/* The axes that displacements are measured along; world. */
struct axes {
    double E[9], w[3];           /* by column; their angular velocity [rad/s] */
    bool own;                    /* they turn otherwise than the mean of the bodies by */
    double h[3], N[3], n_h, h_n; /* n_h N (h.W) - h_n h (N.W), W = w_b - w_a */
};

/* With cos alpha = |z_a + z_b|/2, alpha = theta/2, and N = h x c. */
static void take_middle(struct axes *o, const struct between *x, const struct turn *t)
{
    double W[3], sum[3], size;
    turn_middle(o->E, t);
    v3_sum(sum, t->A + 3 * t->z, t->B + 3 * t->z);
    size = v3_norm(sum) / 2;
    v3_copy(o->h, o->E + 3 * t->z);
    v3_cross(o->N, o->h, t->c);
    o->n_h = 1 / (4 * size * size);
    o->h_n = 1 / (4 * size * (1 + size));
    v3_diff(W, x->b.w, x->a.w);
    v3_sum(o->w, x->a.w, x->b.w);
    v3_scale(o->w, .5, o->w);
    v3_axpy(o->w, o->n_h * v3_dot(o->h, W), o->N);
    v3_axpy(o->w, -o->h_n * v3_dot(o->N, W), o->h);
    o->own = x->space == 3;
}

/* The axes, and the places where forces act. */
static void find_axes(struct axes *o, struct strains *to, const struct bushing *p, const struct between *x,
                      const struct turn *t)
{
    const struct frame *of = p->axes == AXES_SECOND ? &x->b : &x->a, *at = p->axes == AXES_SECOND ? &x->a : &x->b;
    *o = (struct axes){.own = false};
    v3_copy(to->at_a, x->a.x);
    v3_copy(to->at_b, x->b.x);
    if (p->axes == AXES_WORLD) {
        memcpy(o->E, p->on.drawn, sizeof o->E);
    } else if (p->axes == AXES_MIDDLE) {
        take_middle(o, x, t);
        v3_sum(to->at_a, x->a.x, x->b.x);
        v3_scale(to->at_a, .5, to->at_a);
        v3_copy(to->at_b, to->at_a);
    } else {
        memcpy(o->E, of->E, sizeof o->E);
        v3_copy(o->w, of->w);
        v3_copy(to->at_a, at->x);
        v3_copy(to->at_b, at->x);
    }
}

/* The torque that e_i x d has of its own in axes in the middle. */
static void couple(struct strain *s, const struct axes *m, const double *d)
{
    double C[3];
    v3_cross(C, s->dir, d);
    v3_scale(s->on_b, m->n_h * v3_dot(m->N, C), m->h);
    v3_axpy(s->on_b, -m->h_n * v3_dot(m->h, C), m->N);
    v3_scale(s->on_a, -1, s->on_b);
}

static void slide(struct strains *o, const struct bushing *p, const struct between *x, const struct turn *t)
{
    double d[3], rate[3], turned[3];
    struct axes m;
    find_axes(&m, o, p, x, t);
    v3_diff(d, x->b.x, x->a.x);
    v3_diff(rate, x->b.v, x->a.v);
    v3_cross(turned, m.w, d);
    v3_take(rate, turned);
    for (int i = 0; i < 3; i++) {
        struct strain *s = &o->of[o->n++];
        v3_copy(s->dir, m.E + 3 * i);
        s->s = v3_dot(s->dir, d);
        s->rate = v3_dot(s->dir, rate);
        s->slides = true;
        s->turns = m.own;
        if (s->turns) couple(s, &m, d);
        spring(s, (struct affine){p->k[i], p->c[i], p->rest[i], p->preload[i]});
    }
}

/* row of the axes A, which stand still, as one of the first marker's own: what takes its axes to the second's takes
 * on_a to row. */
static void carry_back(double *on_a, const double *row, const struct between *x)
{
    double in[3];
    m3_tmul(in, x->b.E, row);
    m3_mul(on_a, x->a.E, in);
}

/* A turn s with its row; still: of the world's axes. */
static void add_turn(struct strains *o, double s, const double *row, struct affine law, const struct between *x,
                     bool still)
{
    struct strain *to = &o->of[o->n++];
    v3_copy(to->on_b, row);
    v3_copy(to->on_a, row);
    if (still) carry_back(to->on_a, row, x);
    v3_scale(to->on_a, -1, to->on_a);
    to->s = s;
    to->rate = v3_dot(to->on_b, x->b.w) + v3_dot(to->on_a, x->a.w);
    to->slides = false;
    to->turns = true;
    spring(to, law);
}

static struct affine spring_about(const struct bushing *p, int i)
{
    return (struct affine){p->kr[i], 0, p->rest_r[i], p->preload_r[i]};
}

/* Along the angular velocity about the axes swung to the other's z axis, in the middle about those there. */
static void damp(struct strains *o, const struct bushing *p, const struct between *x, const struct turn *t)
{
    double D[9];
    if (p->axes == AXES_MIDDLE)
        turn_middle(D, t);
    else if (p->axes == AXES_SECOND)
        turn_swing_axes(D, t, t->B, t->A + 3 * t->z);
    else
        turn_swing_axes(D, t, t->A, t->B + 3 * t->z);
    for (int i = 0; i < 3; i++) add_turn(o, 0, D + 3 * i, (struct affine){.c = p->cr[i]}, x, p->axes == AXES_WORLD);
}

/* Where the stiffnesses against tilt are the same and that against twist is none, no other law is thinkable. */
static bool by_convention(const struct bushing *p, const struct turn *t)
{
    return p->kr[t->x] != p->kr[t->y] || p->kr[t->z] != 0;
}

static void swing_and_twist(struct strains *o, const struct bushing *p, const struct between *x, const struct turn *t)
{
    const bool still = p->axes == AXES_WORLD, middle = p->axes == AXES_MIDDLE, second = p->axes == AXES_SECOND;
    const double *E = second ? t->B : t->A, *za = t->A + 3 * t->z, *zb = t->B + 3 * t->z;
    const double *own = second ? zb : za, *other = second ? za : zb;
    double row[3], M[9];
    if (middle) turn_middle(M, t), E = M;
    for (int i = 1; i < 3; i++) {
        const int k = (t->z + i) % 3;
        const double *e = E + 3 * k;
        if (middle)
            turn_row_amid(row, t, e);
        else
            turn_row_along(row, t, e, own, other);
        add_turn(o, t->g * v3_dot(t->c, e), row, spring_about(p, k), x, still);
    }
    turn_row_twist(row, t);
    add_turn(o, t->psi, row, spring_about(p, t->z), x, still);
    if (by_convention(p, t)) o->tilt = t->theta;
}

/* Along the rotation vector from rest. */
static void isotropic(struct strains *o, const struct bushing *p, const struct between *x, const struct turn *t)
{
    const bool still = p->axes == AXES_WORLD;
    double back[3], R[9], rest[9], B[9], phi[3], T[9], row[3];
    v3_scale(back, -1, p->rest_r);
    matrix_of_vector(rest, back);
    m3_mulm(B, t->B, rest);
    m3_tmulm(R, t->A, B);
    vector_of_matrix(phi, R);
    vector_rate(T, phi);
    for (int i = 0; i < 3; i++) {
        m3_mul(row, t->A, T + 3 * i); /* phi_i' = (column i of T) . W */
        add_turn(o, phi[i], row, (struct affine){.k = p->kr[i]}, x, still);
    }
}

/* Axes by column with z along p. */
static void frame_along(double *E, const double *p)
{
    double e[3];
    const int least = fabs(p[0]) <= fabs(p[1]) && fabs(p[0]) <= fabs(p[2]) ? 0 : fabs(p[1]) <= fabs(p[2]) ? 1 : 2;
    v3_set(e, least == 0, least == 1, least == 2);
    matrix_of_axes(E, 2, p, 0, e);
}

/* The preload of an isotropic bushing, along the twist about its direction. */
static void load_isotropic(struct strains *o, const struct bushing *p, const struct between *x, const struct turn *t)
{
    const double size = v3_norm(p->preload_r);
    double E[9], row[3];
    struct turn of;
    if (!(size > 0)) return;
    frame_along(E, p->preload_r);
    m3_mulm(of.A, t->A, E);
    m3_mulm(of.B, t->B, E);
    turn_find(&of, 2, x->twist);
    turn_row_twist(row, &of);
    add_turn(o, of.psi, row, (struct affine){.preload = size}, x, p->axes == AXES_WORLD);
}

static void take_turn(struct turn *o, const struct bushing *p, const struct between *x, int z)
{
    double Q[9];
    memcpy(o->A, x->a.E, sizeof o->A);
    memcpy(o->B, x->b.E, sizeof o->B);
    if (p->axes == AXES_WORLD) {
        m3_mulmt(Q, x->b.E, x->a.E);
        memcpy(o->A, p->on.drawn, sizeof o->A);
        m3_mulm(o->B, Q, o->A);
    }
    turn_find(o, z, counted_about(p, z, x->twist));
}

/* The same by the axis about which damping is another. */
static void damp_isotropic(struct strains *o, const struct bushing *p, const struct between *x)
{
    const int z = odd_one(p->cr);
    struct turn t;
    take_turn(&t, p, x, z < 0 ? 2 : z);
    damp(o, p, x, &t);
}

static bool held(const void *par)
{
    return ((const struct bushing *)par)->axes == AXES_WORLD;
}

static void strains(struct strains *o, const void *par, const struct between *x)
{
    const struct bushing *p = par;
    const int z = x->space == 2 ? 2 : twist_axis(p);
    struct turn t;
    take_turn(&t, p, x, z < 0 ? 2 : z);
    if (x->space == 2) t.psi = x->a.E[8] * x->angle;
    slide(o, p, x, &t);
    if (x->space == 2) {
        add_turn(o, t.psi, x->a.E + 6, (struct affine){p->kr[2], p->cr[2], p->rest_r[2], p->preload_r[2]}, x, false);
    } else if (z < 0) {
        isotropic(o, p, x, &t);
        load_isotropic(o, p, x, &t);
        damp_isotropic(o, p, x);
    } else {
        swing_and_twist(o, p, x, &t);
        damp(o, p, x, &t);
    }
}

/* --- keys -------------------------------------------------------------------------------------- */

static const struct key keys[] = {
    MARKER_KEYS(struct bushing, on, "bushing"),
    PARAM_WORD(
        struct bushing, axes, "axes", "first|second|middle|world", 0, "first",
        "whose axes it measures along and pushes along: of the first body, the second, half-way between them, or "
        "fixed in the world"),
    PARAM_VECTOR(struct bushing, k, "stiffness", "N/m", 0, INFINITY, 0, "along its axes; default 0"),
    PARAM_VECTOR(struct bushing, kr, "rotation", "N m/rad", 0, INFINITY, KEY_ABOUT,
                 "stiffness about its axes; default 0"),
    PARAM_VECTOR(struct bushing, c, "damping", "N s/m", 0, INFINITY, 0, "along its axes; default 0"),
    PARAM_VECTOR(struct bushing, cr, "rotation_damping", "N m s/rad", 0, INFINITY, KEY_ABOUT,
                 "about its axes; default 0"),
    PARAM_VECTOR(struct bushing, preload, "preload", "N", -INFINITY, INFINITY, 0,
                 "force on the second body at rest, along its axes; default 0"),
    PARAM_VECTOR(struct bushing, preload_r, "rotation_preload", "N m", -INFINITY, INFINITY, KEY_ABOUT,
                 "torque on the second body at rest, about its axes; default 0"),
    PARAM_VECTOR(struct bushing, rest, "rest", "m", -INFINITY, INFINITY, 0,
                 "displacement at which stiffness gives no force; default 0, as drawn"),
    PARAM_VECTOR(struct bushing, rest_r, "rotation_rest", "rad", -INFINITY, INFINITY, KEY_ABOUT,
                 "rotation at which stiffness gives no torque; default 0, as drawn"),
    KEYS_END};

const struct force_kind force_bushing = {.name = "bushing",
                                         .brief = "springs and dampers in all directions between two bodies",
                                         .keys = keys,
                                         .size = sizeof(struct bushing),
                                         .strains = strains,
                                         .twist = counted,
                                         .held = held};
