/* planar.c -- recursive Newton-Euler in the plane: motion outwards, forces inwards; see sweep.h.
 *
 * With rho from the parent's centre to the joint's point B on the child, c from B to the child's
 * centre, and displacements d along axes e_k that turn with the parent (J = rotation by a right angle):
 *
 *     r = r_p + rho + c                  w = w_p + turn u
 *     v = v_p + w_p J rho + e_k u_k + w J c
 *     a = a_p + al_p J rho - w_p^2 rho + 2 w_p J e_k u_k + e_k u_k' + al J c - w^2 c
 *
 *     F = m a - f + sum over children,   N = I al - n + sum (N_j + arm_j x F_j)
 *     row of a displacement: e_k . F,    of a rotation: turn (N + c x F)
 *
 * Luh, Walker & Paul, J. Dyn. Syst. Meas. Control 102 (1980) 69. */
#include "system/planar.h"

#include <math.h>
#include <string.h>

#include "system/planar_flex.h"

/* --- motion ------------------------------------------------------------------------------------ */

static inline void turn2(double *y, double c, double s, const double *x)
{
    y[0] = c * x[0] - s * x[1];
    y[1] = s * x[0] + c * x[1];
}

static inline double cross2(const double *x, const double *y)
{
    return x[0] * y[1] - x[1] * y[0];
}

/* Angle, axes, arms and position of x on p; rho comes along for the rates. */
static inline void place(struct part *restrict x, double *restrict rho, const struct part *restrict p,
                         const struct link *restrict l, const double *q)
{
    double b[2];
    turn2(rho, p->c, p->s, l->a);
    if (l->type == SLIDE || l->type == GLIDE) {
        int slides = l->type == SLIDE ? 1 : 2;
        for (int k = 0; k < slides; k++) {
            double d = q[l->iq[k]];
            turn2(x->e[k], p->c, p->s, l->e[k]);
            rho[0] += d * x->e[k][0];
            rho[1] += d * x->e[k][1];
        }
    }
    if (l->type == TURN || l->type == GLIDE) {
        x->phi = p->phi + l->turn * q[l->iq[l->nv - 1]];
        sincos(x->phi, &x->s, &x->c);
    } else {
        x->phi = p->phi, x->c = p->c, x->s = p->s;
    }
    turn2(b, x->c, x->s, l->b);
    for (int i = 0; i < 2; i++) {
        x->c_b[i] = -b[i];
        x->arm[i] = rho[i] - b[i];
        x->r[i] = p->r[i] + x->arm[i];
    }
}

static inline void move_on(struct part *restrict x, const double *restrict rho, const struct part *restrict p,
                           const struct link *restrict l, const double *v)
{
    x->w = p->w;
    if (l->type == TURN || l->type == GLIDE) x->w += l->turn * v[l->iv[l->nv - 1]];
    x->v[0] = p->v[0] - p->w * rho[1] - x->w * x->c_b[1];
    x->v[1] = p->v[1] + p->w * rho[0] + x->w * x->c_b[0];
    if (l->type == SLIDE || l->type == GLIDE)
        for (int k = 0; k < (l->type == SLIDE ? 1 : 2); k++) {
            x->v[0] += x->e[k][0] * v[l->iv[k]];
            x->v[1] += x->e[k][1] * v[l->iv[k]];
        }
}

static inline void speed_up(struct part *restrict x, const double *restrict rho, const struct part *restrict p,
                            const struct link *restrict l, const double *v, const double *a)
{
    double ww_p = p->w * p->w, ww = x->w * x->w;
    x->al = p->al;
    if (l->type == TURN || l->type == GLIDE) x->al += l->turn * a[l->iv[l->nv - 1]];
    x->a[0] = p->a[0] - p->al * rho[1] - ww_p * rho[0] - x->al * x->c_b[1] - ww * x->c_b[0];
    x->a[1] = p->a[1] + p->al * rho[0] - ww_p * rho[1] + x->al * x->c_b[0] - ww * x->c_b[1];
    if (l->type == SLIDE || l->type == GLIDE)
        for (int k = 0; k < (l->type == SLIDE ? 1 : 2); k++) {
            double u2 = 2 * p->w * v[l->iv[k]], da = a[l->iv[k]];
            x->a[0] += x->e[k][0] * da - x->e[k][1] * u2;
            x->a[1] += x->e[k][1] * da + x->e[k][0] * u2;
        }
}

void planar_hang(struct part *x, const struct part *p, const struct link *l, const double *q, const double *v,
                 const double *a)
{
    double rho[2];
    place(x, rho, p, l, q);
    if (v) move_on(x, rho, p, l, v);
    if (a) speed_up(x, rho, p, l, v, a);
}

void planar_place(struct sweep *s, const double *q, unsigned cls)
{
    if (s->bend) {
        planar_flex_outwards(s, q, NULL, NULL, cls);
        return;
    }
    const struct roster *o = &s->rosters.of[cls];
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        double rho[2];
        place(&s->part[o->body[i]], rho, &s->part[l->parent], l, q);
    }
}

static void move(struct sweep *s, const double *q, const double *v, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    s->accelerated = false;
    if (s->bend) {
        planar_flex_outwards(s, q, v, NULL, cls);
        return;
    }
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]], *p = &s->part[l->parent];
        double rho[2];
        place(x, rho, p, l, q);
        move_on(x, rho, p, l, v);
    }
}

static void forward(struct sweep *s, const double *q, const double *v, const double *a, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    if (!a) a = s->zero;
    s->accelerated = true;
    s->part[0].F[0] = s->part[0].F[1] = s->part[0].N = 0;
    if (s->bend) {
        planar_flex_outwards(s, q, v, a, cls);
        planar_flex_load(s, cls);
        return;
    }
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]], *p = &s->part[l->parent];
        double rho[2], bears = o->bears[i];
        place(x, rho, p, l, q);
        move_on(x, rho, p, l, v);
        speed_up(x, rho, p, l, v, a);
        x->F[0] = bears * l->mass * x->a[0];
        x->F[1] = bears * l->mass * x->a[1];
        x->N = bears * l->inertia * x->al;
    }
}

/* --- what elements ask and give ---------------------------------------------------------------- */

/* From the centre to the point p of body axes, world axes. */
static inline void offset(double *d, const struct sweep *s, int body, const double *p)
{
    double drawn[2];
    turn2(drawn, s->link[body].drawn[0], s->link[body].drawn[1], p);
    turn2(d, s->part[body].c, s->part[body].s, drawn);
}

static void point(const struct sweep *s, double *x, double *xv, int body, const double *p)
{
    const struct part *b = &s->part[body];
    double d[2];
    offset(d, s, body, p);
    x[0] = b->r[0] + d[0];
    x[1] = b->r[1] + d[1];
    xv[0] = b->v[0] - b->w * d[1];
    xv[1] = b->v[1] + b->w * d[0];
    x[2] = xv[2] = 0;
}

static void pose(const struct sweep *s, struct pose *o, int body)
{
    const struct part *b = &s->part[body];
    double z[2];
    turn2(z, b->c, b->s, s->link[body].drawn);
    memset(o, 0, sizeof *o);
    o->R[0] = o->R[4] = z[0];
    o->R[1] = z[1];
    o->R[3] = -z[1];
    o->R[8] = 1;
    o->w[2] = b->w;
    o->angle = b->phi;
    for (int i = 0; i < 2; i++) {
        o->r[i] = b->r[i];
        o->v[i] = b->v[i];
        if (s->accelerated) o->a[i] = b->a[i] + s->model->gravity[i];
    }
    if (s->accelerated) o->al[2] = b->al;
}

static void push(struct sweep *s, int body, const double *x, const double *f)
{
    struct part *b = &s->part[body];
    b->F[0] -= f[0];
    b->F[1] -= f[1];
    b->N -= (x[0] - b->r[0]) * f[1] - (x[1] - b->r[1]) * f[0];
}

static void twist(struct sweep *s, int body, const double *n)
{
    s->part[body].N -= n[2];
}

static void partial(const struct sweep *s, double *xv, double *w, int body, const double *x, int k)
{
    int o = s->routes.owner[k];
    const struct part *p = &s->part[o];
    memset(xv, 0, 3 * sizeof *xv);
    memset(w, 0, 3 * sizeof *w);
    if (!routes_above(&s->routes, o, body)) return;
    if (s->routes.local[k] >= s->link[o].nv) {
        planar_flex_partial(s, xv, w, body, x, k);
        return;
    }
    if (!planar_turns(&s->link[o], s->routes.local[k])) {
        memcpy(xv, p->e[s->routes.local[k]], 2 * sizeof *xv);
        return;
    }
    double turn = s->link[o].turn, at[2] = {p->r[0] - p->c_b[0], p->r[1] - p->c_b[1]};
    w[2] = turn;
    xv[0] = -turn * (x[1] - at[1]);
    xv[1] = turn * (x[0] - at[0]);
}

static int path(const struct sweep *s, const int **k, int body)
{
    *k = s->routes.path[body];
    return s->routes.npath[body];
}

/* --- forces inwards ---------------------------------------------------------------------------- */

static inline void bring_up(double *r, const struct part *x, struct part *p, const struct link *l)
{
    switch (l->type) {
    case GLIDE:
        r[l->iv[2]] += l->turn * (x->N + cross2(x->c_b, x->F));
        r[l->iv[1]] += x->e[1][0] * x->F[0] + x->e[1][1] * x->F[1];
        r[l->iv[0]] += x->e[0][0] * x->F[0] + x->e[0][1] * x->F[1];
        break;
    case TURN:
        r[l->iv[0]] += l->turn * (x->N + cross2(x->c_b, x->F));
        break;
    case SLIDE:
        r[l->iv[0]] += x->e[0][0] * x->F[0] + x->e[0][1] * x->F[1];
        break;
    case HELD:
        break;
    }
    p->F[0] += x->F[0];
    p->F[1] += x->F[1];
    p->N += x->N + cross2(x->arm, x->F);
}

void planar_bring_up(double *r, const struct part *x, struct part *p, const struct link *l)
{
    bring_up(r, x, p, l);
}

static void backward(struct sweep *s, double *r, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    if (s->bend) {
        planar_flex_inwards(s, r, cls);
        return;
    }
    for (int i = o->n - 1; i >= 0; i--) {
        const struct link *l = &s->link[o->body[i]];
        bring_up(r, &s->part[o->body[i]], &s->part[l->parent], l);
    }
}

static void energy(const struct sweep *s, double *kinetic, double *gravity)
{
    const double *g = s->model->gravity;
    double T = 0, V = 0;
    for (int i = 1; i < s->nbody; i++) {
        const struct part *x = &s->part[i];
        const struct link *l = &s->link[i];
        T += l->mass * (x->v[0] * x->v[0] + x->v[1] * x->v[1]) + l->inertia * x->w * x->w;
        V -= l->mass * (g[0] * x->r[0] + g[1] * x->r[1]);
    }
    *kinetic = .5 * T;
    *gravity = V;
    if (s->bend) planar_flex_energy(s, kinetic, gravity);
}

/* What elements along the joint's own coordinates carry is taken out: the free directions. */
static void reaction(const struct sweep *s, double *f, double *n, int joint)
{
    int body = s->model->joint[joint].child;
    const struct part *x = &s->part[body];
    memset(f, 0, 3 * sizeof *f);
    memset(n, 0, 3 * sizeof *n);
    enum planar_type type = s->link[body].type;
    if (type == GLIDE) return;
    f[0] = x->F[0];
    f[1] = x->F[1];
    if (type != TURN) n[2] = x->N + cross2(x->c_b, x->F);
    if (type != SLIDE) return;
    double along = x->e[0][0] * f[0] + x->e[0][1] * f[1];
    f[0] -= along * x->e[0][0];
    f[1] -= along * x->e[0][1];
}

/* --- building ---------------------------------------------------------------------------------- */

static void build_link(struct link *l, const struct link *parent, const struct model_joint *j,
                       const struct model_body *body)
{
    static const enum planar_type types[JOINT_TYPES] = {[JOINT_FIXED] = HELD,
                                                        [JOINT_REVOLUTE] = TURN,
                                                        [JOINT_PRISMATIC] = SLIDE,
                                                        [JOINT_PLANAR] = GLIDE,
                                                        [JOINT_FREE] = GLIDE};
    l->parent = j->parent;
    l->type = types[j->type];
    l->nv = j->nv;
    for (int k = 0; k < j->nv; k++) l->iq[k] = j->iq[k], l->iv[k] = j->iv[k];
    l->mass = body->mass;
    l->inertia = body->inertia[2];
    l->turn = j->Ea[8] < 0 ? -1 : 1;
    /* drawn orientation: the parent's, then Ea Eb' */
    double c = 0, s = 0, turned[2];
    for (int k = 0; k < 3; k++) c += j->Ea[3 * k] * j->Eb[3 * k], s += j->Ea[3 * k + 1] * j->Eb[3 * k];
    double size = hypot(c, s);
    turn2(turned, c / size, s / size, parent->drawn);
    memcpy(l->drawn, turned, sizeof turned);
    turn2(l->a, parent->drawn[0], parent->drawn[1], j->a);
    turn2(l->b, l->drawn[0], l->drawn[1], j->b);
    turn2(l->e[0], parent->drawn[0], parent->drawn[1], l->type == SLIDE ? j->Ea + 6 : j->Ea);
    turn2(l->e[1], parent->drawn[0], parent->drawn[1], j->Ea + 3);
}

static void build_ground(struct sweep *s, const struct model *m)
{
    const struct model_body *ground = &m->body[0];
    struct part *x = &s->part[0];
    s->link[0].drawn[0] = ground->R[0];
    s->link[0].drawn[1] = ground->R[1];
    x->c = 1;
    for (int i = 0; i < 2; i++) {
        x->r[i] = ground->at[i];
        x->a[i] = -m->gravity[i];
    }
}

static struct sweep *build(const struct model *m, struct arena *life)
{
    struct sweep *s = TAKE(life, struct sweep, 1);
    s->model = m;
    s->nbody = m->nbody;
    s->n = m->n;
    rosters_build(&s->rosters, m, life);
    s->link = TAKE(life, struct link, m->nbody);
    s->part = TAKE(life, struct part, m->nbody);
    s->bias = arena_take(life, (size_t)m->nbody, sizeof *s->bias);
    s->zero = TAKE(life, double, m->n);
    build_ground(s, m);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &m->joint[m->body[i].joint];
        build_link(&s->link[i], &s->link[j->parent], j, &m->body[i]);
    }
    routes_build(&s->routes, m, life);
    planar_flex_build(s, life);
    return s;
}

const struct sweep_ops sweep_planar = {.build = build,
                                       .forward = forward,
                                       .move = move,
                                       .point = point,
                                       .pose = pose,
                                       .push = push,
                                       .twist = twist,
                                       .backward = backward,
                                       .mass = planar_mass,
                                       .partial = partial,
                                       .path = path,
                                       .factor_size = planar_factor_size,
                                       .factor = planar_factor,
                                       .solve = planar_solve,
                                       .energy = energy,
                                       .reaction = reaction,
                                       .gather = planar_gather,
                                       .hasten = planar_hasten};
