/* spatial.c -- recursive Newton-Euler in space: motion outwards, forces inwards; see sweep.h.
 *
 * With rho from the parent's centre to the joint's point B on the child (displacements e_k q_k included), c from B
 * to the child's centre, and the joint's own motion w_r = sum e_k u_k over rotations, d' = sum e_k u_k over
 * displacements:
 *
 *     r  = r_p + rho + c
 *     w  = w_p + w_r                     v = v_p + w_p x rho + d' + w x c
 *     al = al_p + al_r + w_p x w_r       a = a_p + al_p x rho + w_p x (w_p x rho) + 2 w_p x d' + sum e_k u_k'
 *                                            + al x c + w x (w x c)
 *
 * al_r is the rate of w_r as the parent sees it: sum e_k u_k', of crossed turns with (e_1 u_1) x (e_2 u_2)
 * for the second axis, which the first rotation turns; axes fixed in the child (spherical, free) are turned by
 * w_r itself and add w_r x w_r = 0.  A rate that turns and slides has a place in both sums.
 *
 *     F = m a - f + sum over children,   N = I al + w x I w - n + sum (N_j + arm_j x F_j)
 *     row of a displacement: e_k . F,    of a rotation: e_k . (N + c x F)
 *
 * Flexible bodies, and the bodies that stand at their nodes, have steps of their own in spatial_flex.c.
 *
 * Luh, Walker & Paul, J. Dyn. Syst. Meas. Control 102 (1980) 69. */
#include "tree/spatial.h"

#include <math.h>
#include <string.h>

#include "la/rot.h"
#include "la/turned.h"

/* --- positions ---------------------------------------------------------------------------------- */

/* R = E turned about its z by the angle. */
static inline void turn_z(double *restrict R, const double *restrict E, double angle)
{
    double s, c;
    turned(angle, &s, &c);
    for (int i = 0; i < 3; i++) {
        R[i] = c * E[i] + s * E[3 + i];
        R[3 + i] = c * E[3 + i] - s * E[i];
        R[6 + i] = E[6 + i];
    }
}

/* R = E turned about its x, then about the new y. */
static inline void turn_xy(double *restrict R, const double *restrict E, double x, double y)
{
    double sx, cx, sy, cy;
    turned(x, &sx, &cx);
    turned(y, &sy, &cy);
    for (int i = 0; i < 3; i++) {
        double z = cx * E[6 + i] - sx * E[3 + i];
        R[3 + i] = cx * E[3 + i] + sx * E[6 + i];
        R[i] = cy * E[i] - sy * z;
        R[6 + i] = sy * E[i] + cy * z;
    }
}

static inline void turn_quaternion(double *R, const double *E, const double *q, const int *iq)
{
    double Q[9];
    quat_matrix(Q, (double[]){q[iq[0]], q[iq[1]], q[iq[2]], q[iq[3]]});
    m3_mulm(R, E, Q);
}

/* d += the joint's displacements with coordinates, rates or accelerations u, their places being k. */
static inline void add_slides(double *restrict d, const struct part *restrict x, const struct link *restrict l,
                              const double *restrict u, const int *restrict k)
{
    const double *e = spatial_axis(x, l, l->slide);
    v3_axpy(d, l->along[l->slide] * u[k[l->slide]], e);
    if (l->nslide > 1) v3_axpy(d, u[k[l->slide + 1]], e + 3);
    if (l->nslide > 2) v3_axpy(d, u[k[l->slide + 2]], e + 6);
}

/* The displacement in rho; a ball's inner frame has not the joint's axes but the body's. */
static inline void slide(struct part *restrict x, const struct part *restrict p, const struct link *restrict l,
                         const double *restrict E, const double *restrict q)
{
    if (l->apart && l->turning == TURNS_FREELY)
        m3_mulm(x->E, p->R, l->Et);
    else if (l->apart)
        memcpy(x->E, E, sizeof x->E);
    add_slides(x->rho, x, l, q, l->iq);
}

/* Inner frame of x hanging on p, its axes and the displacement in rho, which starts from the joint's point on p. */
static inline void turn(struct part *restrict x, const struct part *restrict p, const struct link *restrict l,
                        const double *restrict q)
{
    double product[9];
    const double *E = p->R;
    if (!l->straight) {
        m3_mulm(product, p->R, l->Ea);
        E = product;
    }
    const int *iq = l->iq + l->turn;
    switch (l->turning) {
    case TURNS_NEVER:
        memcpy(x->R, E, sizeof x->R);
        break;
    case TURNS_ABOUT_ONE:
        turn_z(x->R, E, q[iq[0]]);
        break;
    case TURNS_CROSSED:
        memcpy(x->E, E, sizeof x->E);
        turn_xy(x->R, E, q[iq[0]], q[iq[1]]);
        break;
    case TURNS_FREELY:
        turn_quaternion(x->R, E, q, iq);
        break;
    }
    if (l->nslide) slide(x, p, l, E, q);
}

static inline void place(struct part *restrict x, const struct part *restrict p, const struct link *restrict l,
                         const double *restrict q)
{
    double b[3];
    m3_mul(x->rho, p->R, l->a);
    turn(x, p, l, q);
    m3_mul(b, x->R, l->b);
    v3_scale(x->c, -1, b);
    v3_diff(x->arm, x->rho, b);
    v3_sum(x->r, p->r, x->arm);
}

/* A loop of its own: right after their stores the loads of R in pairs would wait (12 ns a body of 65). */
void spatial_place(struct sweep *s, const double *q, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    s->accelerated = false;
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]], *p = &s->part[l->parent];
        struct node_body *node_body = spatial_node_body(s, o->body[i]);
        struct flexible *flexible = spatial_flexible(s, o->body[i]);
        if (node_body)
            spatial_node_body_place(x, node_body, p);
        else
            place(x, p, l, q);
        if (flexible) spatial_flex_place(flexible, x, l, q);
    }
}

/* --- velocities and accelerations --------------------------------------------------------------- */

/* A joint's own motion as its parent sees it, in world axes, and what both passes of a body need. */
struct motion {
    double wr[3], dv[3]; /* angular velocity; velocity of the displacement */
    double v_rho[3];     /* w_p x rho */
    double v_c[3];       /* w x c */
};

/* Sums over the joint's unit velocities: rotations into w, displacements into d (written where it slides). */
static inline void joint_sums(double *restrict w, double *restrict d, const struct part *restrict x,
                              const struct link *restrict l, const double *restrict u)
{
    const int *iv = l->iv + l->turn;
    switch (l->turning) {
    case TURNS_NEVER:
        v3_set(w, 0, 0, 0);
        break;
    case TURNS_ABOUT_ONE:
        v3_scale(w, u[iv[0]], x->R + 6);
        break;
    case TURNS_CROSSED:
        v3_scale(w, u[iv[0]], x->E);
        v3_axpy(w, u[iv[1]], x->R + 3);
        break;
    case TURNS_FREELY:
        v3_scale(w, u[iv[0]], x->R);
        v3_axpy(w, u[iv[1]], x->R + 3);
        v3_axpy(w, u[iv[2]], x->R + 6);
        break;
    }
    if (l->nslide == 0) return;
    v3_set(d, 0, 0, 0);
    add_slides(d, x, l, u, l->iv);
}

static inline void turn_on(struct part *restrict x, struct motion *restrict o, const struct part *restrict p,
                           const struct link *restrict l, const double *restrict v)
{
    joint_sums(o->wr, o->dv, x, l, v);
    v3_sum(x->w, p->w, o->wr);
    v3_cross(o->v_rho, p->w, x->rho);
    v3_cross(o->v_c, x->w, x->c);
}

static inline void move_on(struct part *restrict x, const struct motion *restrict o, const struct part *restrict p,
                           const struct link *restrict l)
{
    for (int i = 0; i < 3; i++) x->v[i] = p->v[i] + o->v_rho[i] + o->v_c[i];
    if (l->nslide) v3_add(x->v, o->dv);
}

/* (e_1 u_1) x (e_2 u_2). */
static inline void crossed_bias(double *al, const struct part *x, const struct link *l, const double *v)
{
    double both[3];
    v3_cross(both, x->E, x->R + 3);
    v3_axpy(al, v[l->iv[l->turn]] * v[l->iv[l->turn + 1]], both);
}

static inline void accelerate_part(struct part *restrict x, const struct motion *restrict o,
                                   const struct part *restrict p, const struct link *restrict l,
                                   const double *restrict v, const double *restrict a)
{
    double al[3], da[3];
    joint_sums(al, da, x, l, a);
    if (l->turning == TURNS_CROSSED) crossed_bias(al, x, l, v);
    v3_cross_add(al, p->w, o->wr);
    v3_sum(x->al, p->al, al);
    v3_copy(x->a, p->a);
    v3_cross_add(x->a, p->al, x->rho);
    v3_cross_add(x->a, p->w, o->v_rho);
    v3_cross_add(x->a, x->al, x->c);
    v3_cross_add(x->a, x->w, o->v_c);
    if (l->nslide) {
        double coriolis[3];
        v3_cross(coriolis, p->w, o->dv);
        v3_axpy(x->a, 2, coriolis);
        v3_add(x->a, da);
    }
}

static void move(struct sweep *s, const double *q, const double *v, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    s->accelerated = false;
    if (q) spatial_place(s, q, cls);
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]], *p = &s->part[l->parent];
        struct node_body *node_body = spatial_node_body(s, o->body[i]);
        struct flexible *flexible = spatial_flexible(s, o->body[i]);
        struct motion joint;
        if (node_body) {
            spatial_node_body_move(x, node_body, p);
        } else {
            turn_on(x, &joint, p, l, v);
            move_on(x, &joint, p, l);
        }
        if (flexible) spatial_flex_move(flexible, v);
    }
}

static void accelerate(struct sweep *s, const double *v, const double *a, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    s->accelerated = true;
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]], *p = &s->part[l->parent];
        struct node_body *node_body = spatial_node_body(s, o->body[i]);
        struct flexible *flexible = spatial_flexible(s, o->body[i]);
        struct motion joint;
        if (node_body) {
            spatial_node_body_accelerate(x, node_body, p);
        } else {
            turn_on(x, &joint, p, l, v);
            accelerate_part(x, &joint, p, l, v, a);
        }
        if (flexible) spatial_flex_accelerate(flexible, a);
    }
}

static void stir_up(struct sweep *s, const double *v, const double *a, unsigned cls)
{
    move(s, NULL, v, cls);
    accelerate(s, v, a, cls);
}

/* F = m a, N = I al + w x I w, the latter in the inner frame, where I stands still. */
static inline void collect_forces(struct part *restrict x, const struct link *restrict l)
{
    double w[3], al[3], L[3], N[3];
    m3_tmul(w, x->R, x->w);
    m3_tmul(al, x->R, x->al);
    s3_mul(L, l->swung, w);
    s3_mul(N, l->inertia, al);
    v3_cross_add(N, w, L);
    m3_mul(x->N, x->R, N);
    v3_scale(x->F, l->mass, x->a);
}

static inline void stay_light(struct part *x, struct flexible *f)
{
    v3_set(x->F, 0, 0, 0);
    v3_set(x->N, 0, 0, 0);
    if (f) memset(f->Q, 0, sizeof *f->Q * (size_t)f->n);
}

static inline void load(struct sweep *s, int body, bool bears)
{
    struct part *x = &s->part[body];
    struct flexible *flexible = spatial_flexible(s, body);
    if (!bears || spatial_node_body(s, body))
        stay_light(x, flexible);
    else if (flexible)
        spatial_flex_collect_forces(x, flexible);
    else
        collect_forces(x, &s->link[body]);
}

/* The last two passes and the loads at once, where every body is rigid. */
static void at_once(struct sweep *s, const double *v, const double *a, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    s->accelerated = true;
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]], *p = &s->part[l->parent];
        struct motion joint;
        turn_on(x, &joint, p, l, v);
        move_on(x, &joint, p, l);
        accelerate_part(x, &joint, p, l, v, a);
        if (o->bears[i])
            collect_forces(x, l);
        else
            stay_light(x, NULL);
    }
}

static void forward(struct sweep *s, const double *q, const double *v, const double *a, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    if (!a) a = s->zero;
    v3_set(s->part[0].F, 0, 0, 0);
    v3_set(s->part[0].N, 0, 0, 0);
    if (q && !s->nflexible) {
        spatial_place(s, q, cls);
        at_once(s, v, a, cls);
        return;
    }
    if (q) move(s, q, v, cls);
    accelerate(s, v, a, cls);
    for (int i = 0; i < o->n; i++) load(s, o->body[i], o->bears[i]);
}

/* --- forces inwards ---------------------------------------------------------------------------- */

static inline void rows(double *restrict r, const struct part *restrict x, const struct link *restrict l)
{
    double n[3];
    spatial_moment(n, x);
    for (int k = 0; k < l->nv; k++) r[l->iv[k]] += spatial_power(x, l, k, x->F, n);
}

static void backward(struct sweep *s, double *r, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    for (int i = o->n - 1; i >= 0; i--) {
        const struct link *l = &s->link[o->body[i]];
        const struct part *x = &s->part[o->body[i]];
        struct part *p = &s->part[l->parent];
        struct node_body *node_body = spatial_node_body(s, o->body[i]);
        const struct flexible *flexible = spatial_flexible(s, o->body[i]);
        if (node_body) spatial_node_body_load(node_body, x);
        if (flexible) spatial_flex_rows(r, flexible);
        rows(r, x, l);
        v3_add(p->F, x->F);
        v3_add(p->N, x->N);
        v3_cross_add(p->N, x->arm, x->F);
    }
}

const struct sweep_ops sweep_spatial = {.build = spatial_build,
                                        .place = spatial_place,
                                        .move = move,
                                        .accelerate = accelerate,
                                        .stir_up = stir_up,
                                        .forward = forward,
                                        .point = spatial_point,
                                        .pose = spatial_pose,
                                        .at = spatial_at,
                                        .stand = spatial_stand,
                                        .stir = spatial_stir,
                                        .push = spatial_push,
                                        .twist = spatial_twist,
                                        .backward = backward,
                                        .mass = spatial_mass,
                                        .partial = spatial_partial,
                                        .row = spatial_row,
                                        .rows = spatial_rows,
                                        .path = spatial_path,
                                        .factor_size = spatial_factor_size,
                                        .factor = spatial_factor,
                                        .solve = spatial_solve,
                                        .energy = spatial_energy,
                                        .reaction = spatial_reaction,
                                        .aggregate = spatial_aggregate,
                                        .adjust_motion = spatial_adjust_motion};
