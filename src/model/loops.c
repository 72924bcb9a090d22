/* loops.c -- which coordinates the loops tie together, and what that makes of them.
 *
 * Loop joint l ties the coordinates on the path of one of its bodies and not of the other: those on both
 * move its bodies as one; gears and racks tie two coordinates whatever these move.  A path that passes through a node
 * of a flexible body ties its elastic coordinates.  Loops that share such a joint or such a body are one component: one
 * block of C_q.  A component with a fast coordinate is fast: its dependent coordinates follow in the minor steps. */
#include <math.h>
#include <string.h>

#include "model/parts.h"

static int root(int *above, int i)
{
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
}

/* Marks the tree joints between the body and the ground: on[i] ^= 1. */
static void cross(const struct making *o, bool *on, int body)
{
    for (; body > 0; body = o->body[body].parent) on[o->body[body].joint] ^= true;
}

/* on[i]: loop l ties coordinates of tree joint i. */
static void mark_tied(const struct making *o, bool *on, const struct model_loop *l)
{
    memset(on, 0, sizeof *on * (size_t)o->m->njoint);
    for (int i = 0; i < l->nterm; i++) on[l->term[i].joint] = true;
    if (l->nterm) return;
    cross(o, on, l->first);
    cross(o, on, l->second);
}

/* Who holds the coordinates that tree joint i lets move its child: itself; at a node the flexible parent, whose
 * number lies behind those of joints. */
static int holder(const struct making *o, int i)
{
    const struct model_body *b = &o->body[o->joint[i].child];
    return b->at_node ? o->m->njoint + b->parent : i;
}

/* owner [njoint + nbody]: a loop that ties the holder's coordinates, -1: none; above: loops that share one, as trees.
 */
static void tie(const struct making *o, int *owner, int *above)
{
    const struct model *m = o->m;
    bool *on = TAKE(o->life, bool, m->njoint);
    for (int i = 0; i < m->njoint + m->nbody; i++) owner[i] = -1;
    for (int l = 0; l < m->nloop; l++) {
        above[l] = l;
        mark_tied(o, on, &o->loop[l]);
        for (int i = 0; i < m->njoint; i++) {
            if (!on[i]) continue;
            int h = holder(o, i);
            if (owner[h] >= 0) above[root(above, owner[h])] = root(above, l);
            owner[h] = l;
        }
    }
}

/* Largest local error of a drive over major steps H, H^2/12 times the change of its acceleration (Zienkiewicz & Xie,
 * Earthq. Eng. Struct. Dyn. 20 (1991) 871), from rates, so that corners count; as a share of its travel. */
static double local_error(const struct signal *c, double H, double from, double until)
{
    enum { MOST = 1000 };
    const double every = fmax(H, (until - from - H) / MOST);
    double worst = 0, travel = 0, x[3], first[3];
    signal_motion(c, first, from);
    for (double t = from; t + H <= until * (1 + 1e-12); t += every) {
        double a[3], mid[3], b[3];
        signal_motion(c, a, t);
        signal_motion(c, mid, t + H / 2);
        signal_motion(c, b, t + H);
        worst = fmax(worst, H / 3 * fabs(a[1] - 2 * mid[1] + b[1]));
        travel = fmax(travel, fabs(b[0] - first[0]));
    }
    signal_motion(c, x, until);
    travel = fmax(travel, fabs(x[0] - first[0]));
    return travel > 0 ? worst / travel : 0;
}

/* A drive that the major steps do not resolve makes its component fast: from the clock's start, so that a run that goes
 * on chooses as the whole one does. */
static void mark_quick_drives(const struct making *o, bool *fast)
{
    static const double RESOLVED = 1e-3;
    const struct integrate *p = &o->scene->integrate;
    const struct model *m = o->m;
    if (p->ratio <= 1 || !(p->step > 0)) return;
    for (int i = 0; i < m->ndrive; i++) {
        const struct model_loop *l = &o->loop[model_first_drive(m) + i];
        const double error = local_error(l->drive, p->step * p->ratio, fmin(0, o->scene->start), p->until);
        if (fast[l->component] || error <= RESOLVED) continue;
        fast[l->component] = true;
        diag_warn(
            o->diags, o->scene->drive[i].node, AT_KEY, "W-drive",
            "drive '%s' turns too quickly for the major step of %g s (local error %.2g of its travel): what it moves "
            "takes the minor step",
            l->name, p->step * p->ratio, error);
    }
}

void make_components(struct making *o)
{
    struct model *m = o->m;
    bool *fast = TAKE(o->life, bool, m->nloop);
    int *owner = TAKE(o->life, int, m->njoint + m->nbody), *above = TAKE(o->life, int, m->nloop);
    int *number = TAKE(o->life, int, m->nloop);
    o->component = TAKE(o->life, int, m->njoint);
    o->quick = TAKE(o->life, bool, m->njoint);
    o->supple = TAKE(o->life, bool, m->nbody);
    m->component = o->component;
    tie(o, owner, above);
    for (int l = 0; l < m->nloop; l++) number[l] = root(above, l) == l ? m->ncomponent++ : -1;
    for (int l = 0; l < m->nloop; l++) o->loop[l].component = number[root(above, l)];
    for (int i = 0; i < m->njoint; i++) {
        o->component[i] = owner[i] >= 0 ? o->loop[owner[i]].component : -1;
        for (int k = 0; owner[i] >= 0 && k < o->joint[i].nv; k++) fast[o->component[i]] |= is_fast(o, i, k);
    }
    for (int i = 1; i < m->nbody; i++) {
        struct model_body *b = &o->body[i];
        int loop = owner[m->njoint + i];
        if (loop >= 0) b->component = o->loop[loop].component;
        for (int k = 0; loop >= 0 && k < b->nmode; k++) fast[b->component] |= mode_is_fast(o, i, k);
    }
    mark_quick_drives(o, fast);
    for (int i = 0; i < m->njoint; i++) o->quick[i] = o->component[i] >= 0 && fast[o->component[i]];
    for (int i = 1; i < m->nbody; i++) o->supple[i] = o->body[i].component >= 0 && fast[o->body[i].component];
}

static void at_most(double *x, double most)
{
    if (*x > most) *x = most;
}

/* What the deck chooses stays independent, then what it calls fast, then what it gives a start. */
static double readiness(const struct making *o, int joint, int k)
{
    static const double CHOSEN = 1e-7, FAST_ONE = 1e-2, STARTED = 1e-1;
    const struct scene *s = o->scene;
    int index = o->scene_joint[joint];
    double x = 1;
    if (is_fast(o, joint, k)) at_most(&x, FAST_ONE);
    for (int i = 0; i < s->nindependent; i++) {
        const struct scene_choice *c = &s->independent[i];
        if (index >= 0 && c->joint == index && (c->k < 0 || position_place(o, index, c->k) == o->joint[joint].iq[k]))
            at_most(&x, CHOSEN);
    }
    for (int i = 0; i < s->ninitial; i++) {
        const struct scene_initial *c = &s->initial[i];
        if (index < 0 || c->joint != index) continue;
        bool whole = c->type == INITIAL_OMEGA || c->type == INITIAL_ROTATION;
        if (whole || rate_place(o, index, c->k) == o->joint[joint].iv[k]) at_most(&x, STARTED);
    }
    return x;
}

/* Elastic coordinates follow last: a small one of them would have to move far to close a loop. */
static double mode_readiness(const struct making *o, int body, int k)
{
    static const double CHOSEN = 1e-7, ELASTIC = 2e-3;
    const struct scene *s = o->scene;
    double x = ELASTIC;
    for (int i = 0; i < s->nindependent; i++) {
        const struct scene_choice *c = &s->independent[i];
        if (c->joint < 0 && o->body_of[c->body] == body && (c->k < 0 || c->k == k)) at_most(&x, CHOSEN);
    }
    return x;
}

/* What `initial:` gives leads on the way to the start, before all else: its positions in *q, its rates in *v.  Of what
 * is alike the first goes before. */
static void note_starts(const struct making *o, double *q, double *v)
{
    const int n = o->scene->ninitial;
    for (int i = 0; i < n; i++) {
        const struct scene_initial *c = &o->scene->initial[i];
        const double given = 1e-9 * (1 + (double)i / n);
        const bool whole = c->type == INITIAL_OMEGA || c->type == INITIAL_ROTATION;
        double *x = c->type == INITIAL_POSITION || c->type == INITIAL_ROTATION ? q : v;
        if (c->joint < 0) {
            const struct model_body *b = &o->body[o->body_of[c->body]];
            const int k = model_mode(b, c->k);
            if (k >= 0) at_most(&x[b->mode_v[k]], given);
        } else if (whole) {
            const struct model_joint *j = &o->joint[o->joint_of[c->joint]];
            for (int k = j->nv - 3; k < j->nv; k++) at_most(&x[j->iv[k]], given);
        } else {
            at_most(&x[rate_place(o, c->joint, c->k)], given);
        }
    }
}

static double *copy_of(const struct making *o, const double *x)
{
    const size_t n = (size_t)o->m->n;
    return memcpy(TAKE(o->life, double, n), x, n * sizeof *x);
}

void make_choice(struct making *o)
{
    struct model *m = o->m;
    if (m->nloop == 0) return;
    bool *urgent = TAKE(o->life, bool, m->n);
    double *follow = TAKE(o->life, double, m->n);
    for (int i = 0; i < m->njoint; i++)
        for (int k = 0; k < o->joint[i].nv; k++) {
            urgent[o->joint[i].iv[k]] = is_fast(o, i, k);
            follow[o->joint[i].iv[k]] = readiness(o, i, k);
        }
    for (int i = 1; i < m->nbody; i++)
        for (int k = 0; k < o->body[i].nmode; k++) {
            urgent[o->body[i].mode_v[k]] = mode_is_fast(o, i, k);
            follow[o->body[i].mode_v[k]] = mode_readiness(o, i, k);
        }
    double *q = copy_of(o, follow), *v = copy_of(o, follow);
    note_starts(o, q, v);
    m->urgent = urgent;
    m->follow = follow;
    m->follow_q = q;
    m->follow_v = v;
}
