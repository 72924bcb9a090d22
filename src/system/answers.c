/* answers.c -- what the output asks of a system where system_evaluate() has last looked at it; of one that steps in a plane
 * the one in space answers, but for angles of joints that close loops, which the plane knows with their turns. */
#include "base/inline.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "system/parts.h"

/* --- motion ------------------------------------------------------------------------------------- */

const double *system_rates(const struct system *s)
{
    return s->v;
}

const double *system_accelerations(const struct system *s)
{
    s = system_seen(s);
    return s->a;
}

void system_pose(const struct system *s, struct pose *o, int body)
{
    s = system_seen(s);
    s->ops->pose(s->view, o, body);
}

void system_point(const struct system *s, double *x, double *xv, double *xa, const struct model_point *p)
{
    s = system_seen(s);
    struct pose b;
    double d[3], turned[3];
    s->ops->pose(s->view, &b, p->body);
    m3_mul(d, b.R, p->p);
    v3_sum(x, b.r, d);
    v3_cross(turned, b.w, d); /* w x d */
    v3_sum(xv, b.v, turned);
    v3_copy(xa, b.a);
    v3_cross_add(xa, b.al, d);
    v3_cross_add(xa, b.w, turned);
}

/* Of the centre of mass of a flexible body, which is not where its frame is. */
APART void centre_of_bent(const struct system *s, struct pose *o, int body)
{
    s->ops->pose(s->view, o, body);
    elastic_centre(o, &s->tree.elastic, body, s->q, s->v, s->a);
}

void system_centre_stands(const struct system *s, struct pose *o, int body)
{
    s = system_seen(s);
    if (s->model->body[body].flex)
        centre_of_bent(s, o, body);
    else
        s->ops->at(s->view, o, body);
}

void system_centre_moves(const struct system *s, struct pose *o, int body)
{
    s = system_seen(s);
    if (s->model->body[body].flex)
        centre_of_bent(s, o, body);
    else
        s->ops->stir(s->view, o, body);
}

void system_displacement(const struct system *s, double *d, const struct model_point *p)
{
    s = system_seen(s);
    struct pose frame;
    double x[3], v[3], a[3], away[3];
    system_point(s, x, v, a, p);
    s->ops->pose(s->view, &frame, p->frame);
    v3_diff(away, x, frame.r);
    m3_tmul(d, frame.R, away);
    v3_take(d, p->drawn);
}

void system_rotation(const struct system *s, double *turn, const struct model_point *p)
{
    s = system_seen(s);
    struct pose frame, node;
    double R[9];
    s->ops->pose(s->view, &frame, p->frame);
    s->ops->pose(s->view, &node, p->body);
    m3_tmulm(R, frame.R, node.R); /* drawn, both stand alike */
    vector_of_matrix(turn, R);
    if (s->model->space == 2) turn[2] = angle_near(turn[2], node.angle - frame.angle);
}

double system_stress(const struct system *s, int body, int stress, enum bent_stress part)
{
    s = system_seen(s);
    return bent_stress(&s->model->body[body], stress, part, s->q);
}

void system_measure(const struct system *s, double *value, double *rate, int measure)
{
    s = system_seen(s);
    elements_measure(s->tree.elements, s->view, value, rate, measure, s->q, s->v);
}

/* --- forces ------------------------------------------------------------------------------------- */

/* From the joint's point on the parent to that on the child, world axes: what a sliding joint has slid. */
static void slid(const struct system *s, double *d, const struct model_joint *j)
{
    struct pose parent, child;
    double a[3], b[3];
    s->ops->pose(s->view, &parent, j->parent);
    s->ops->pose(s->view, &child, j->child);
    m3_mul(a, parent.R, j->a);
    m3_mul(b, child.R, j->b);
    v3_sum(d, child.r, b);
    v3_take(d, parent.r);
    v3_take(d, a);
}

/* On the deck's second body, about the joint's point on it: the child, or the parent, which feels the opposite. */
void system_reaction(const struct system *s, double *f, double *n, int joint)
{
    s = system_seen(s);
    const struct model_joint *j = &s->model->joint[joint];
    double d[3];
    s->ops->reaction(s->view, f, n, joint);
    if (!j->reversed) return;
    v3_scale(f, -1, f);
    v3_scale(n, -1, n);
    slid(s, d, j);
    v3_cross_add(n, d, f);
}

void system_loop_reaction(const struct system *s, double *f, double *n, int loop)
{
    s = system_seen(s);
    loops_reaction(s->shown, f, n, loop, s->lambda);
}

double system_loop_coordinate(const struct system *s, int loop, int order, int k)
{
    if (s->flat && s->flat->full->loop[loop].type != s->model->loop[loop].type && !loop_winds(s->flat->full, loop, k))
        s = s->seen;
    const struct model_loop *l = &s->model->loop[loop];
    struct pose first, second;
    s->ops->pose(s->view, &first, l->first);
    s->ops->pose(s->view, &second, l->second);
    const double x = loop_coordinate(s->model, loop, order, k, &first, &second);
    return order == 0 && s->windings && loop_winds(s->model, loop, k) ? windings_angle(s->windings, loop, k, x) : x;
}

void system_drive(const struct system *s, double *force, double *power, int loop)
{
    s = system_seen(s);
    loops_drive(s->shown, force, power, loop, s->lambda);
}

double system_loop_force(const struct system *s, int loop)
{
    s = system_seen(s);
    return loops_force(s->shown, loop, s->lambda);
}

void system_force(const struct system *s, double *force, double *elongation, double *power, int i)
{
    s = system_seen(s);
    *force = s->effect[i].force;
    *elongation = s->effect[i].elongation;
    *power = s->effect[i].power;
}

double system_force_torque(const struct system *s, int i)
{
    s = system_seen(s);
    return s->effect[i].torque;
}

/* --- sums --------------------------------------------------------------------------------------- */

void system_energies(const struct system *s, struct energies *e)
{
    s = system_seen(s);
    *e = s->energies;
}

/* p = sum m v,  L = sum (r x m v + I w) */
void system_momentum(const struct system *s, double *p, double *L)
{
    s = system_seen(s);
    v3_set(p, 0, 0, 0);
    v3_set(L, 0, 0, 0);
    for (int i = 0; i < s->tree.elastic.n; i++) {
        struct pose b;
        s->ops->pose(s->view, &b, s->tree.elastic.body[i].number);
        elastic_momentum(p, L, &s->tree.elastic.body[i], &b, s->q, s->v);
    }
    for (int i = 1; i < s->model->nbody; i++) {
        const struct model_body *body = &s->model->body[i];
        if (body->flex) continue;
        struct pose b;
        double mv[3], w[3], spin[3], world[3];
        s->ops->pose(s->view, &b, i);
        v3_scale(mv, body->mass, b.v);
        v3_add(p, mv);
        v3_cross_add(L, b.r, mv);
        m3_tmul(w, b.R, b.w);
        s3_mul(spin, body->inertia, w);
        m3_mul(world, b.R, spin);
        v3_add(L, world);
    }
}
