/* evidence_motion.c -- how the joint that carries a flexible body moves: along the freedoms on its way from the ground, by
 * drives or by themselves, and how quickly. */
#include "scene_flex/evidence.h"

#include <math.h>
#include <string.h>

#include "la/rot.h"
#include "la/vec3.h"

/* ---- motions of the joint that carries it ---- */

/* The drive of a joint's k-th rate; NULL: none. */
static const struct signal *drive_of(const struct scene *s, int joint, int k)
{
    for (int i = 0; i < s->ndrive; i++) {
        const struct scene_measure *m = &s->measure[s->drive[i].measure];
        if (m->type == MEASURE_COORDINATE && m->joint == joint && m->k == k) return &s->drive[i].value;
    }
    return NULL;
}

static void find_rates(double *rate, const struct signal *s, double until)
{
    double x[3];
    signal_motion(s, x, 0);
    rate[0] = fabs(x[1]);
    for (int i = 0; i <= PACES; i++) {
        signal_motion(s, x, until * i / PACES);
        if (isfinite(x[1])) rate[1] = fmax(rate[1], fabs(x[1]));
    }
}

static bool is_forced(const struct scene *s, int joint, int k)
{
    for (int i = 0; i < s->nforce; i++) {
        const struct scene_measure *m = s->force[i].measure >= 0 ? &s->measure[s->force[i].measure] : NULL;
        if (m && m->type == MEASURE_COORDINATE && m->joint == joint && m->k == k) return true;
    }
    return false;
}

/* A motion v, w (world) at p in the directions of the reference node. */
static void at_reference(double *d, const struct evidence *e, const double *v, const double *w, const double *p)
{
    double at[3], lever[3], x[3];
    m3_mul(at, e->body->R, e->all->node[e->all->reference].x);
    v3_add(at, e->body->origin);
    v3_diff(lever, at, p);
    v3_cross(x, w, lever);
    v3_add(x, v);
    m3_tmul(d, e->body->R, x);
    m3_tmul(d + 3, e->body->R, w);
}

static void add_motion(struct evidence *e, const char *name, const double *v, const double *w, const double *p,
                       bool driven)
{
    double arm[3];
    if (e->nmotion == MOST_MOTIONS) return;
    struct motion *m = &e->motion[e->nmotion++];
    *m = (struct motion){.name = name, .turns = v3_norm(w) > 0, .driven = driven};
    at_reference(m->d, e, v, w, p);
    m3_tmul(m->axis, e->body->R, w);
    v3_diff(arm, p, e->body->origin);
    m3_tmul(m->p, e->body->R, arm);
}

/* Along all axes of the space. */
static void add_all_motions(struct evidence *e, const char *name)
{
    static const double none[3] = {0, 0, 0};
    const int space = e->b->scene->space;
    for (int i = 0; i < 6; i++) {
        const double x[3] = {i % 3 == 0, i % 3 == 1, i % 3 == 2};
        if (space == 2 && (i == 2 || i == 3 || i == 4)) continue;
        double at[3];
        m3_mul(at, e->body->R, e->all->node[e->all->reference].x);
        v3_add(at, e->body->origin);
        add_motion(e, name, i < 3 ? x : none, i < 3 ? none : x, at, false);
    }
    e->free = true;
}

static const char *freedom_name(const struct evidence *e, const struct scene_joint *j, int k)
{
    const struct freedom *f = &j->kind->freedom[k];
    return arena_print(e->b->life, "%s.%s", j->name, f->ball ? f->v : f->q);
}

static void add_freedoms(struct evidence *e, int joint)
{
    static const double none[3] = {0, 0, 0};
    const struct scene_joint *j = &e->b->scene->joint[joint];
    for (int k = 0; k < joint_size(j->kind, 1); k++) {
        const struct freedom *f = &j->kind->freedom[k];
        const double *axis = j->E + 3 * f->axis;
        const struct signal *drive = drive_of(e->b->scene, joint, k);
        const int at = e->nmotion;
        add_motion(e, freedom_name(e, j, k), f->slides ? axis : none, f->turns ? axis : none, j->at, drive != NULL);
        if (!drive) e->free = true;
        if (drive && e->nmotion > at) find_rates(e->motion[at].rate, drive, e->o.span);
    }
}

/* via[i]: the joint on the way of body i from the ground; -1: none.  Nearest first, as a tree grows. */
static void find_ways(int *via, const struct scene *s)
{
    bool more = true;
    for (int i = 0; i < s->nbody; i++) via[i] = -1;
    while (more) {
        more = false;
        for (int i = 0; i < s->njoint; i++) {
            const struct scene_joint *j = &s->joint[i];
            if (joint_is_tie(j->kind)) continue;
            for (int side = 0; side < 2; side++) {
                const int from = side ? j->second : j->first, to = side ? j->first : j->second;
                if (to == 0 || via[to] >= 0 || (from != 0 && via[from] < 0)) continue;
                via[to] = i;
                more = true;
            }
        }
    }
}

int other_end(const struct scene *s, int joint, int body)
{
    return s->joint[joint].first == body ? s->joint[joint].second : s->joint[joint].first;
}

/* Undriven motions [from, nmotion) are recoil; with a rigid body that hangs fixed between. */
static void add_recoil(struct evidence *e, int joint, int from)
{
    for (int i = from; i < e->nmotion && e->o.nrigid < MOST_RECOIL; i++) {
        if (e->motion[i].driven) continue;
        e->recoils[e->o.nrigid] = e->motion[i].name;
        e->forced[e->o.nrigid] = is_forced(e->b->scene, joint, i - from);
        memcpy(e->recoil[e->o.nrigid++], e->motion[i].d, sizeof e->recoil[0]);
    }
}

/* Inertia of a rigid body along recoil r and s. */
static double carried(const struct evidence *e, const struct scene_body *hub, int r, int s)
{
    double v[2][3], w[2][3], arm[3], at[3], lever[3], J[3];
    m3_mul(at, e->body->R, e->all->node[e->all->reference].x);
    v3_add(at, e->body->origin);
    v3_diff(lever, hub->at, at);
    m3_tmul(arm, e->body->R, lever);
    for (int k = 0; k < 2; k++) {
        const double *d = e->recoil[k ? s : r];
        double x[3];
        v3_cross(v[k], d + 3, arm);
        v3_add(v[k], d);
        m3_mul(x, e->body->R, d + 3);
        m3_tmul(w[k], hub->R, x);
    }
    s3_mul(J, hub->inertia, w[1]);
    return hub->mass * v3_dot(v[0], v[1]) + v3_dot(w[0], J);
}

static void add_carried(struct evidence *e, const struct scene_body *hub)
{
    const int n = e->o.nrigid;
    for (int r = 0; r < n; r++)
        for (int s = 0; s < n; s++) e->mass[r + n * s] += carried(e, hub, r, s);
}

void find_motions(struct evidence *e)
{
    const struct scene *s = e->b->scene;
    int *via = TAKE(e->b->life, int, s->nbody), joints = 0;
    find_ways(via, s);
    e->still = true;
    for (int i = e->index, up = 0; i > 0 && up < s->nbody; up++) {
        const int joint = via[i];
        if (joint < 0 || (i != e->index && (s->body[i].nmode > 0))) {
            e->any = true;
            break;
        }
        const int from = e->nmotion;
        add_freedoms(e, joint);
        if (e->nmotion > from && joints++ == 0) {
            add_recoil(e, joint, from);
            for (int k = e->index; k != i && e->o.nrigid;) {
                k = other_end(s, via[k], k);
                add_carried(e, &s->body[k]);
            }
        }
        i = other_end(s, joint, i);
    }
    e->still = e->nmotion == 0 && !e->any;
    if (e->any || joints > 1) add_all_motions(e, "motion");
}

/* The largest number that `initial` gives to a rate or an angular velocity, as it stands there. */
static double first_rate(const struct evidence *e, const struct node *n, bool rate)
{
    double most = 0, x;
    if (n->key && (strstr(n->key, "omega") || strstr(n->key, "_rate"))) rate = true;
    if (n->type == NODE_SCALAR)
        return rate && !n->reported && deck_number(&x, n, e->b->reader.deck) == OK && isfinite(x) ? fabs(x) : 0;
    for (int i = 0; i < n->count; i++) most = fmax(most, first_rate(e, n->item[i], rate));
    return most;
}

/* How far gravity and turns pull at the body. */
void find_pull(struct evidence *e)
{
    const struct node *initial = node_find(e->b->scene->deck->root, "initial");
    const bool turns = e->any || e->free;
    double rate = v3_norm(e->o.spin);
    if (turns && initial && initial->type == NODE_MAP) rate = fmax(rate, first_rate(e, initial, false));
    e->o.pull = v3_norm(e->b->scene->gravity) / e->length + rate * rate;
}

/* The fastest of the turns that drives make. */
void find_spin(struct evidence *e)
{
    for (int i = 0; i < e->nmotion; i++) {
        const struct motion *m = &e->motion[i];
        if (!m->turns || m->rate[1] <= v3_norm(e->o.spin)) continue;
        v3_scale(e->o.spin, m->rate[1], m->axis);
        v3_copy(e->o.about, m->p);
    }
}

/* ---- what drives and forces are like ---- */

double pace_of(const struct signal *s, int order, double until, bool *jumps)
{
    double before = 0, after, at, changes = 0, sizes = 0, x[3], last = 0, mean = 0, sum = 0;
    if (signal_jump(s, &at, &before, &after, 0, until)) *jumps = true;
    if (order > 1 && isfinite(signal_corner_time(s, 0, until))) *jumps = true;
    for (int i = 0; i <= PACES; i++) {
        signal_motion(s, x, until * i / PACES);
        sum += x[order];
    }
    mean = order > 0 ? 0 : sum / (PACES + 1);
    for (int i = 0; i <= PACES; i++) {
        signal_motion(s, x, until * i / PACES);
        const double now = x[order] - mean;
        if (i > 0) changes += (now - last) * (now - last);
        sizes += now * now;
        last = now;
    }
    return sizes > 0 && isfinite(sizes) ? sqrt(changes / sizes) * PACES / until : 0;
}

void find_pace(struct evidence *e)
{
    const struct scene *s = e->b->scene;
    e->smooth = true;
    for (int i = 0; i < s->ndrive; i++) {
        double x[3], most = 0;
        bool jumps = false;
        e->pace = fmax(e->pace, pace_of(&s->drive[i].value, 2, e->o.span, &jumps));
        for (int k = 0; k <= PACES; k++) {
            signal_motion(&s->drive[i].value, x, e->o.span * k / PACES);
            most = fmax(most, fabs(x[2]));
            if (isfinite(x[1])) e->pace = fmax(e->pace, fabs(x[1]));
        }
        signal_motion(&s->drive[i].value, x, 0);
        if (jumps || fabs(x[2]) > 0.01 * most || (x[1] != 0 && !e->at_rest)) e->smooth = false;
    }
    for (int i = 0; i < s->nforce; i++)
        for (int k = 0; k < 3; k++) {
            bool jumps = false;
            const struct signal *v = &s->force[i].value[k];
            if (s->force[i].type != FORCE_LOAD || signal_is_zero(v)) continue;
            if (s->force[i].nslot <= 1) pace_of(v, 0, e->o.span, &jumps);
            if ((jumps || s->force[i].nslot > 1) && e->free) e->smooth = false;
        }
}
