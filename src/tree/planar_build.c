/* planar_build.c -- what the planar recursion knows before it sees a state */
#include <assert.h>
#include <math.h>
#include <string.h>

#include "tree/planar_flex.h"

/* Its class and the directions of its displacements. */
static void build_freedoms(struct link *l, const struct link *parent, const struct model_joint *j,
                           const struct freedom *freedom)
{
    static const int sizes[] = {[HELD] = 0, [TURN] = 1, [SLIDE] = 1, [GLIDE] = 3};
    const bool turns = j->nv && freedom[j->nv - 1].turns;
    const int slides = turns ? j->nv - 1 : j->nv;
    l->type = turns ? (slides ? GLIDE : TURN) : slides ? SLIDE : HELD;
    assert(j->nv == sizes[l->type]);
    for (int k = 0; k < slides; k++)
        planar_turn(l->e[k], parent->drawn[0], parent->drawn[1], j->Ea + 3 * freedom[k].axis);
}

static void build_link(struct link *l, const struct link *parent, const struct model_joint *j,
                       const struct joint_kind *kind, const struct model_body *body)
{
    l->parent = j->parent;
    l->nv = j->nv;
    build_freedoms(l, parent, j, kind->freedom);
    for (int k = 0; k < j->nv; k++) l->iq[k] = j->iq[k], l->iv[k] = j->iv[k];
    l->mass = body->mass;
    l->inertia = body->inertia[2] + (body->held ? body->held[2] : 0);
    l->turn = j->Ea[8] < 0 ? -1 : 1;
    /* drawn orientation: the parent's, then Ea Eb' */
    double c = 0, s = 0, turned[2];
    for (int k = 0; k < 3; k++) c += j->Ea[3 * k] * j->Eb[3 * k], s += j->Ea[3 * k + 1] * j->Eb[3 * k];
    double size = hypot(c, s);
    planar_turn(turned, c / size, s / size, parent->drawn);
    memcpy(l->drawn, turned, sizeof turned);
    planar_turn(l->a, parent->drawn[0], parent->drawn[1], j->a);
    planar_turn(l->b, l->drawn[0], l->drawn[1], j->b);
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

static struct sweep *build(const struct model *m, enum purpose purpose, const bool *bodies, struct arena *life)
{
    struct sweep *s = TAKE(life, struct sweep, 1);
    s->model = m;
    s->nbody = m->nbody;
    s->n = m->n;
    rosters_build(&s->rosters, m, purpose, bodies, life);
    s->link = TAKE(life, struct link, m->nbody);
    s->part = TAKE(life, struct part, m->nbody);
    s->bias = arena_take(life, (size_t)m->nbody, sizeof *s->bias);
    s->zero = TAKE(life, double, m->n);
    s->limb = TAKE(life, int, m->n);
    s->moving = TAKE(life, struct moving, m->nbody);
    build_ground(s, m);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &m->joint[m->body[i].joint];
        build_link(&s->link[i], &s->link[j->parent], j, model_kind(m, j->type), &m->body[i]);
        s->link[i].limb = j->parent ? s->link[j->parent].limb : i;
        s->limbs += !j->parent;
        for (int k = 0; k < s->link[i].nv; k++) s->limb[s->link[i].iv[k]] = s->link[i].limb;
        s->link[s->link[i].limb].last = i;
        s->link[i].pivot = s->link[i - 1].pivot + s->link[i - 1].nv;
    }
    routes_build(&s->routes, m, life);
    planar_flex_build(s, life);
    return s;
}

const struct sweep_ops sweep_planar = {.build = build,
                                       .place = planar_place,
                                       .move = planar_move,
                                       .accelerate = planar_accelerate,
                                       .stir_up = planar_stir_up,
                                       .forward = planar_forward,
                                       .point = planar_point,
                                       .pose = planar_pose,
                                       .at = planar_at,
                                       .stand = planar_stand,
                                       .stir = planar_stir,
                                       .push = planar_push,
                                       .twist = planar_twist,
                                       .backward = planar_backward,
                                       .mass = planar_mass,
                                       .partial = planar_partial,
                                       .row = planar_row,
                                       .rows = planar_rows,
                                       .path = planar_path,
                                       .factor_size = planar_factor_size,
                                       .factor = planar_factor,
                                       .solve = planar_solve,
                                       .moving_size = planar_moving_size,
                                       .moving_factor = planar_moving_factor,
                                       .moving_solve = planar_moving_solve,
                                       .bend_slopes = planar_bend_slopes,
                                       .energy = planar_energy,
                                       .reaction = planar_reaction,
                                       .aggregate = planar_aggregate,
                                       .adjust_motion = planar_adjust_motion};
