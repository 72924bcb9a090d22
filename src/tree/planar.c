/* planar.c -- recursive Newton-Euler in the plane: motion outwards, forces inwards; see sweep.h.
 *
 * With rho from the parent's centre to the joint's point B on the child, c from B to the child's
 * centre, and displacements d along axes e_k that turn with the parent (J = rotation by a right angle):
 *
 *     r = r_p + arm,  arm = rho + c      w = w_p + turn u
 *     v = v_p + w_p J rho + e_k u_k + w J c
 *     a = a_p + al_p J rho - w_p^2 rho + 2 w_p J e_k u_k + e_k u_k' + al J c - w^2 c
 *
 *     F = m a - f + sum over children,   N = I al - n + sum (N_j + arm_j x F_j)
 *     row of a displacement: e_k . F,    of a rotation: turn (N + c x F)
 *
 * Flexible bodies, and the bodies that stand at their nodes, have steps of their own in planar_flex.c.
 *
 * Luh, Walker & Paul, J. Dyn. Syst. Meas. Control 102 (1980) 69. */
#include "tree/planar.h"

#include <math.h>
#include <string.h>

#include "la/turned.h"
#include "tree/planar_flex.h"

/* --- motion ------------------------------------------------------------------------------------ */

/* Angle, axes, arms and position of x on p. */
TWICE void place(struct part *restrict x, const struct part *restrict p, const struct link *restrict l, const double *q)
{
    double b[2];
    planar_turn(x->rho, p->c, p->s, l->a);
    if (l->type == SLIDE || l->type == GLIDE) {
        int slides = l->type == SLIDE ? 1 : 2;
        for (int k = 0; k < slides; k++) {
            double d = q[l->iq[k]];
            planar_turn(x->e[k], p->c, p->s, l->e[k]);
            x->rho[0] += d * x->e[k][0];
            x->rho[1] += d * x->e[k][1];
        }
    }
    if (l->type == TURN || l->type == GLIDE) {
        x->phi = p->phi + l->turn * q[l->iq[l->nv - 1]];
        turned(x->phi, &x->s, &x->c);
    } else {
        x->phi = p->phi, x->c = p->c, x->s = p->s;
    }
    planar_turn(b, x->c, x->s, l->b);
    for (int i = 0; i < 2; i++) {
        x->c_b[i] = -b[i];
        x->arm[i] = x->rho[i] - b[i];
        x->r[i] = p->r[i] + x->arm[i];
    }
}

/* The same of a hinge, what most trees are made of, to the same bits. */
TWICE void place_hinge(struct part *restrict x, const struct part *restrict p, const struct link *restrict l, double q)
{
    const double rho0 = p->c * l->a[0] - p->s * l->a[1], rho1 = p->s * l->a[0] + p->c * l->a[1];
    double sin, cos;
    x->phi = p->phi + l->turn * q;
    turned(x->phi, &sin, &cos);
    const double b0 = cos * l->b[0] - sin * l->b[1], b1 = sin * l->b[0] + cos * l->b[1];
    const double arm0 = rho0 - b0, arm1 = rho1 - b1;
    x->c = cos, x->s = sin;
    x->rho[0] = rho0, x->rho[1] = rho1;
    x->c_b[0] = -b0, x->c_b[1] = -b1;
    x->arm[0] = arm0, x->arm[1] = arm1;
    x->r[0] = p->r[0] + arm0, x->r[1] = p->r[1] + arm1;
}

TWICE void move_on(struct part *restrict x, const struct part *restrict p, const struct link *restrict l,
                   const double *v)
{
    x->w = p->w;
    if (l->type == TURN || l->type == GLIDE) x->w += l->turn * v[l->iv[l->nv - 1]];
    x->v[0] = p->v[0] - p->w * x->rho[1] - x->w * x->c_b[1];
    x->v[1] = p->v[1] + p->w * x->rho[0] + x->w * x->c_b[0];
    if (l->type == SLIDE || l->type == GLIDE)
        for (int k = 0; k < (l->type == SLIDE ? 1 : 2); k++) {
            x->v[0] += x->e[k][0] * v[l->iv[k]];
            x->v[1] += x->e[k][1] * v[l->iv[k]];
        }
}

TWICE void accelerate_part(struct part *restrict x, const struct part *restrict p, const struct link *restrict l,
                           const double *v, const double *a)
{
    double ww_p = p->w * p->w, ww = x->w * x->w;
    x->al = p->al;
    if (l->type == TURN || l->type == GLIDE) x->al += l->turn * a[l->iv[l->nv - 1]];
    x->a[0] = p->a[0] - p->al * x->rho[1] - ww_p * x->rho[0] - x->al * x->c_b[1] - ww * x->c_b[0];
    x->a[1] = p->a[1] + p->al * x->rho[0] - ww_p * x->rho[1] + x->al * x->c_b[0] - ww * x->c_b[1];
    if (l->type == SLIDE || l->type == GLIDE)
        for (int k = 0; k < (l->type == SLIDE ? 1 : 2); k++) {
            double u2 = 2 * p->w * v[l->iv[k]], da = a[l->iv[k]];
            x->a[0] += x->e[k][0] * da - x->e[k][1] * u2;
            x->a[1] += x->e[k][1] * da + x->e[k][0] * u2;
        }
}

/* What the body's inertia needs. */
static inline void bear(struct part *restrict x, const struct link *restrict l, double bears)
{
    x->F[0] = bears * l->mass * x->a[0];
    x->F[1] = bears * l->mass * x->a[1];
    x->N = bears * l->inertia * x->al;
}

/* --- the three passes ---------------------------------------------------------------------------- */

TWICE void place_all(struct sweep *s, const double *q, const struct roster *o, bool flexible)
{
    for (int i = 0; i < o->n; i++) {
        const int body = o->body[i];
        const struct link *l = &s->link[body];
        struct part *x = &s->part[body], *p = &s->part[l->parent];
        if (flexible && s->node_body[body])
            planar_node_body_place(x, s->node_body[body], p);
        else if (l->type == TURN)
            place_hinge(x, p, l, q[l->iq[0]]);
        else
            place(x, p, l, q);
        if (flexible && s->bend[body]) planar_flexible_place(s->bend[body], x, q);
    }
}

TWICE void move_all(struct sweep *s, const double *v, const struct roster *o, bool flexible)
{
    for (int i = 0; i < o->n; i++) {
        const int body = o->body[i];
        const struct link *l = &s->link[body];
        struct part *x = &s->part[body], *p = &s->part[l->parent];
        if (flexible && s->node_body[body])
            planar_node_body_move(x, s->node_body[body], p);
        else
            move_on(x, p, l, v);
        if (flexible && s->bend[body]) planar_flexible_move(s->bend[body], v);
    }
}

TWICE void accelerate_all(struct sweep *s, const double *v, const double *a, const struct roster *o, bool flexible)
{
    for (int i = 0; i < o->n; i++) {
        const int body = o->body[i];
        const struct link *l = &s->link[body];
        struct part *x = &s->part[body], *p = &s->part[l->parent];
        if (flexible && s->node_body[body])
            planar_node_body_accelerate(x, s->node_body[body], p);
        else
            accelerate_part(x, p, l, v, a);
        if (flexible && s->bend[body]) planar_flexible_accelerate(s->bend[body], a);
    }
}

TWICE void stir_all(struct sweep *s, const double *v, const double *a, const struct roster *o, bool flexible)
{
    for (int i = 0; i < o->n; i++) {
        const int body = o->body[i];
        const struct link *l = &s->link[body];
        struct part *x = &s->part[body], *p = &s->part[l->parent];
        if (flexible && s->node_body[body]) {
            planar_node_body_move(x, s->node_body[body], p);
            planar_node_body_accelerate(x, s->node_body[body], p);
        } else {
            move_on(x, p, l, v);
            accelerate_part(x, p, l, v, a);
        }
        if (!flexible || !s->bend[body]) continue;
        planar_flexible_move(s->bend[body], v);
        planar_flexible_accelerate(s->bend[body], a);
    }
}

/* A hinge, what most trees are made of: place(), move_on(), accelerate_part() and bear() in one, to the same bits. */
INTO static inline void swing(struct part *restrict x, const struct part *restrict p, const struct link *restrict l,
                              double q, double v, double a, double bears)
{
    const double rho0 = p->c * l->a[0] - p->s * l->a[1], rho1 = p->s * l->a[0] + p->c * l->a[1];
    const double w = p->w + l->turn * v, al = p->al + l->turn * a, phi = p->phi + l->turn * q;
    double sin, cos;
    turned(phi, &sin, &cos);
    const double b0 = cos * l->b[0] - sin * l->b[1], b1 = sin * l->b[0] + cos * l->b[1];
    const double arm0 = rho0 - b0, arm1 = rho1 - b1, ww_p = p->w * p->w, ww = w * w;
    const double a0 = p->a[0] - p->al * rho1 - ww_p * rho0 + al * b1 + ww * b0;
    const double a1 = p->a[1] + p->al * rho0 - ww_p * rho1 - al * b0 + ww * b1;
    x->phi = phi, x->c = cos, x->s = sin;
    x->w = w, x->al = al;
    x->rho[0] = rho0, x->rho[1] = rho1;
    x->c_b[0] = -b0, x->c_b[1] = -b1;
    x->arm[0] = arm0, x->arm[1] = arm1;
    x->r[0] = p->r[0] + arm0, x->r[1] = p->r[1] + arm1;
    x->v[0] = p->v[0] - p->w * rho1 + w * b1;
    x->v[1] = p->v[1] + p->w * rho0 - w * b0;
    x->a[0] = a0, x->a[1] = a1;
    x->F[0] = bears * l->mass * a0;
    x->F[1] = bears * l->mass * a1;
    x->N = bears * l->inertia * al;
}

/* All at once, where every body is rigid; a NULL: motion down to velocities. */
TWICE void at_once(struct sweep *s, const double *q, const double *v, const double *a, const struct roster *o)
{
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]], *p = &s->part[l->parent];
        if (a && l->type == TURN) {
            swing(x, p, l, q[l->iq[0]], v[l->iv[0]], a[l->iv[0]], o->bears[i]);
            continue;
        }
        if (l->type == TURN)
            place_hinge(x, p, l, q[l->iq[0]]);
        else
            place(x, p, l, q);
        move_on(x, p, l, v);
        if (!a) continue;
        accelerate_part(x, p, l, v, a);
        bear(x, l, o->bears[i]);
    }
}

void planar_place(struct sweep *s, const double *q, unsigned cls)
{
    s->accelerated = false;
    if (s->bend)
        place_all(s, q, &s->rosters.of[cls], true);
    else
        place_all(s, q, &s->rosters.of[cls], false);
}

void planar_move(struct sweep *s, const double *q, const double *v, unsigned cls)
{
    s->accelerated = false;
    if (q && !s->bend) {
        at_once(s, q, v, NULL, &s->rosters.of[cls]);
        return;
    }
    if (q) planar_place(s, q, cls);
    if (s->bend)
        move_all(s, v, &s->rosters.of[cls], true);
    else
        move_all(s, v, &s->rosters.of[cls], false);
}

void planar_accelerate(struct sweep *s, const double *v, const double *a, unsigned cls)
{
    s->accelerated = true;
    if (s->bend)
        accelerate_all(s, v, a, &s->rosters.of[cls], true);
    else
        accelerate_all(s, v, a, &s->rosters.of[cls], false);
}

void planar_stir_up(struct sweep *s, const double *v, const double *a, unsigned cls)
{
    s->accelerated = true;
    if (s->bend)
        stir_all(s, v, a, &s->rosters.of[cls], true);
    else
        stir_all(s, v, a, &s->rosters.of[cls], false);
}

static void load(struct sweep *s, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    for (int i = 0; i < o->n; i++) {
        const int body = o->body[i];
        struct flexible *b = planar_flexible(s, body);
        if (b)
            planar_flexible_load(&s->part[body], b, o->bears[i]);
        else
            bear(&s->part[body], &s->link[body], o->bears[i]);
    }
}

void planar_forward(struct sweep *s, const double *q, const double *v, const double *a, unsigned cls)
{
    if (!a) a = s->zero;
    s->part[0].F[0] = s->part[0].F[1] = s->part[0].N = 0;
    if (q && !s->bend) {
        s->accelerated = true;
        at_once(s, q, v, a, &s->rosters.of[cls]);
        return;
    }
    if (q) planar_move(s, q, v, cls);
    planar_accelerate(s, v, a, cls);
    load(s, cls);
}

/* --- forces inwards ---------------------------------------------------------------------------- */

TWICE void collect_forces(double *r, const struct part *x, struct part *p, const struct link *l)
{
    const double F[2] = {x->F[0], x->F[1]}, N = x->N;
    if (l->type == TURN) { /* what most are */
        r[l->iv[0]] += l->turn * (N + v2_cross(x->c_b, F));
    } else if (l->type == GLIDE) {
        r[l->iv[2]] += l->turn * (N + v2_cross(x->c_b, F));
        r[l->iv[1]] += v2_dot(x->e[1], F);
        r[l->iv[0]] += v2_dot(x->e[0], F);
    } else if (l->type == SLIDE) {
        r[l->iv[0]] += v2_dot(x->e[0], F);
    }
    p->F[0] += F[0];
    p->F[1] += F[1];
    p->N += N + v2_cross(x->arm, F);
}

TWICE void backward(struct sweep *s, double *r, const struct roster *o, bool flexible)
{
    for (int i = o->n - 1; i >= 0; i--) {
        const int body = o->body[i];
        const struct link *l = &s->link[body];
        const struct part *x = &s->part[body];
        if (flexible && s->node_body[body]) planar_node_body_collect_forces(s->node_body[body], x);
        if (flexible && s->bend[body]) planar_flexible_collect_forces(r, s->bend[body]);
        collect_forces(r, x, &s->part[l->parent], l);
    }
}

/* The calls in it cost the other nothing so. */
APART void backward_bent(struct sweep *s, double *r, const struct roster *o)
{
    backward(s, r, o, true);
}

void planar_backward(struct sweep *s, double *r, unsigned cls)
{
    if (s->bend)
        backward_bent(s, r, &s->rosters.of[cls]);
    else
        backward(s, r, &s->rosters.of[cls], false);
}
