/* spatial_build.c -- what the spatial recursion knows before it sees a state */
#include <assert.h>
#include <string.h>

#include "tree/spatial.h"

/* An axis of the second body is a column of R; one of the first body, too, if nothing turns it away. */
static bool stays(const struct freedom *f, const struct link *l, const struct joint_kind *kind)
{
    return f->second || l->turning == TURNS_NEVER ||
           (l->turning == TURNS_ABOUT_ONE && f->axis == kind->freedom[l->turn].axis);
}

static void build_freedoms(struct link *l, const struct model_joint *j, const struct joint_kind *kind)
{
    l->turning = joint_turning(kind, &l->turn);
    for (int k = j->nv - 1; k >= 0; k--) {
        const struct freedom *f = &kind->freedom[k];
        const bool in_R = stays(f, l, kind);
        l->turns[k] = f->turns;
        l->along[k] = joint_along(f, j->number);
        l->axis[k] =
            (in_R ? offsetof(struct part, R) : offsetof(struct part, E)) + 3 * sizeof(double) * (size_t)f->axis;
        if (!f->slides) continue;
        assert(l->nslide == 0 || (l->along[k + 1] == 1 && l->axis[k + 1] == l->axis[k] + 3 * sizeof(double)));
        l->slide = k;
        l->nslide++;
        l->apart |= !in_R;
    }
    assert(l->turning != TURNS_ABOUT_ONE || kind->freedom[l->turn].axis == 2);
    assert(l->turning != TURNS_CROSSED || (kind->freedom[l->turn].axis == 0 && kind->freedom[l->turn + 1].axis == 1));
}

/* The inner frame of a body in body axes: its tree joint's, where the rates are not in body axes. */
static void inner_frame(double *T, const struct link *l, const struct model_joint *j)
{
    if (l->turning == TURNS_FREELY)
        m3_unit(T);
    else
        memcpy(T, j->Eb, sizeof j->Eb);
}

static bool is_unit(const double *A)
{
    for (int i = 0; i < 9; i++)
        if (fabs(A[i] - (i % 4 == 0)) > 1e-15) return false;
    return true;
}

static void turn_inertia(double *inner, const double *T, const double *inertia)
{
    double back[9] = {T[0], T[3], T[6], T[1], T[4], T[7], T[2], T[5], T[8]};
    s3_turn(inner, back, inertia);
}

/* R_child = R_parent Ea J(q) Eb' with J = 1 in the drawn position. */
static void build_link(struct link *l, const struct link *parent, const struct model_joint *j,
                       const struct joint_kind *kind, const struct model_body *body)
{
    double drawn[9], inertia[6];
    l->parent = j->parent;
    l->nv = j->nv;
    build_freedoms(l, j, kind);
    memcpy(l->iq, j->iq, sizeof l->iq);
    memcpy(l->iv, j->iv, sizeof l->iv);
    inner_frame(l->turned, l, j);
    m3_mulmt(drawn, j->Ea, j->Eb);
    m3_mulm(l->Et, drawn, l->turned);
    m3_tmulm(l->Ea, parent->turned, l->Et);
    l->straight = is_unit(l->Ea);
    m3_tmulm(l->Et, parent->turned, j->Ea);
    m3_tmul(l->a, parent->turned, j->a);
    m3_tmul(l->b, l->turned, j->b);
    l->mass = body->mass;
    for (int k = 0; k < 6; k++) inertia[k] = body->inertia[k] + (body->held ? body->held[k] : 0);
    turn_inertia(l->inertia, l->turned, inertia);
    turn_inertia(l->swung, l->turned, body->swung ? body->swung : inertia);
}

static void build_ground(struct sweep *s, const struct model *m)
{
    struct part *x = &s->part[0];
    m3_unit(s->link[0].turned);
    memcpy(x->R, m->body[0].R, sizeof x->R);
    v3_copy(x->r, m->body[0].at);
    v3_scale(x->a, -1, m->gravity);
}

struct sweep *spatial_build(const struct model *m, enum purpose purpose, const bool *bodies, struct arena *life)
{
    struct sweep *s = TAKE(life, struct sweep, 1);
    s->model = m;
    s->nbody = m->nbody;
    s->n = m->n;
    rosters_build(&s->rosters, m, purpose, bodies, life);
    s->link = TAKE(life, struct link, m->nbody);
    s->part = TAKE(life, struct part, m->nbody);
    s->composite = TAKE(life, struct composite, m->nbody);
    s->articulated = TAKE(life, struct articulated, m->nbody);
    s->bias = TAKE(life, struct twist, m->nbody);
    s->zero = TAKE(life, double, m->n);
    build_ground(s, m);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &m->joint[m->body[i].joint];
        build_link(&s->link[i], &s->link[j->parent], j, model_kind(m, j->type), &m->body[i]);
    }
    routes_build(&s->routes, m, life);
    spatial_flex_build(s, m, life);
    return s;
}
