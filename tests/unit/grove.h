/* grove.h -- random planar trees of rigid and flexible bodies (particles.h); what hangs on a flexible body stands at a
 * node. */
#ifndef FMDSUB_TESTS_GROVE_H
#define FMDSUB_TESTS_GROVE_H

#include <assert.h>

#include "tree/sweep.h"
#include "unit/particles.h"

enum grove_flag { GROVE_FAST = 1, GROVE_STIFFENING = 2, GROVE_ADRIFT = 4, GROVE_CHAIN = 8 };

struct grove {
    struct model m;
    struct model_body *body;
    struct model_joint *joint;
    struct cloud **cloud; /* [nbody] NULL: rigid, or at a node */
    bool *fast_joint, **fast_mode;
};

static inline void grove_flexible(struct grove *o, struct tree_dice *d, int i, bool stiffening, struct arena *arena)
{
    struct model_body *b = &o->body[i];
    struct cloud *c = o->cloud[i] = random_cloud(d, tree_pick(d, MODES + 1), stiffening, arena);
    b->flex = &c->body;
    b->nmode = c->body.n;
    b->mode_q = TAKE(arena, int, b->nmode);
    b->mode_v = TAKE(arena, int, b->nmode);
    b->mass = c->body.mass;
    b->inertia[2] = c->body.xx[0] + c->body.xx[4] + c->body.rot[8];
}

static inline void grove_node(struct grove *o, struct tree_dice *d, int i, int parent)
{
    struct model_body *b = &o->body[i], *p = &o->body[parent];
    double x[3];
    *b = (struct model_body){.name = "node", .parent = parent, .joint = i - 1, .at_node = true, .fast = p->fast};
    b->node = tree_pick(d, NODES);
    memcpy(b->R, p->R, sizeof b->R);
    tree_mv(x, p->R, p->flex->node[b->node].x);
    for (int c = 0; c < 3; c++) b->at[c] = p->at[c] + x[c];
    struct model_joint *j = &o->joint[i - 1];
    *j = (struct model_joint){.name = "hold", .type = JOINT_FIXED, .parent = parent, .child = i};
    memcpy(j->a, p->flex->node[b->node].x, sizeof j->a);
    for (int c = 0; c < 9; c += 4) j->Ea[c] = j->Eb[c] = 1;
}

/* Places in q and v: all that is fast, then the rest; the modes of every second body from its last to its first. */
static inline void grove_number(struct grove *o, bool which)
{
    struct model *m = &o->m;
    for (int i = 1; i < m->nbody; i++) {
        struct model_body *b = &o->body[i];
        struct model_joint *j = &o->joint[i - 1];
        for (int k = 0; o->fast_joint[i] == which && k < j->nv; k++, m->n++) j->iq[k] = j->iv[k] = m->n;
        for (int k = 0; k < b->nmode; k++) {
            int mode = i % 2 ? k : b->nmode - 1 - k;
            if (o->fast_mode[i][mode] == which) b->mode_q[mode] = b->mode_v[mode] = m->n, m->n++;
        }
    }
    m->nq = m->n;
    if (which) m->ns = m->n;
}

/* Body i on body `parent`, flexible in two of three cases. */
static inline void grove_body(struct grove *o, struct tree_dice *d, int i, int parent, unsigned flags, bool adrift,
                              struct arena *arena)
{
    struct model_body *b = &o->body[i];
    tree_body(b, d, 2);
    b->name = "body", b->parent = parent, b->joint = i - 1;
    if (tree_pick(d, 3)) grove_flexible(o, d, i, flags & GROVE_STIFFENING, arena);
    tree_joint(&o->joint[i - 1], d, o->body, parent, i, 2, adrift ? TREE_ADRIFT : 0);
    o->fast_joint[i] = flags & GROVE_FAST && tree_pick(d, 4) == 0;
    o->fast_mode[i] = TAKE(arena, bool, MODES);
    b->fast = o->body[parent].fast || (o->fast_joint[i] && o->joint[i - 1].nv > 0);
    for (int k = 0; k < b->nmode; k++) {
        o->fast_mode[i][k] = flags & GROVE_FAST && tree_pick(d, 4) == 0;
        b->fast = b->fast || o->fast_mode[i][k];
    }
}

/* nbody bodies; flexible ones have two nodes behind them, which hold the others; whether a joint or a mode is fast is
 * a matter of luck.  ADRIFT: one body on a free joint, all others on it, no gravity. */
static inline struct grove *random_grove(int nbody, unsigned seed, unsigned flags, struct arena *arena)
{
    struct tree_dice dice = {seed * 7919u + (unsigned)nbody * 104729u}, *d = &dice;
    struct grove *o = TAKE(arena, struct grove, 1);
    struct model *m = &o->m;
    const int most = 3 * nbody + 1;
    int *holder = TAKE(arena, int, most), nholder = 1, i = 1;
    o->body = TAKE(arena, struct model_body, most);
    o->joint = TAKE(arena, struct model_joint, most);
    o->cloud = TAKE(arena, struct cloud *, most);
    o->fast_joint = TAKE(arena, bool, most);
    o->fast_mode = TAKE(arena, bool *, most);
    o->body[0] = (struct model_body){.name = "ground", .R = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .parent = -1, .joint = -1};
    for (int made = 0; made < nbody; made++, i++) {
        const bool adrift = flags & GROVE_ADRIFT;
        const int low = adrift && made, body = i, pick = low + tree_pick(d, nholder - low);
        grove_body(o, d, i, holder[flags & GROVE_CHAIN ? nholder - 1 : pick], flags, adrift && !made, arena);
        if (!o->body[i].flex) holder[nholder++] = i;
        for (int k = 0; o->body[body].flex && k < 2; k++) {
            grove_node(o, d, ++i, body);
            holder[nholder++] = i;
        }
    }
    m->space = 2;
    m->body = o->body, m->joint = o->joint;
    m->nbody = i, m->njoint = i - 1;
    for (int c = 0; c < 2; c++) m->gravity[c] = flags & GROVE_ADRIFT ? 0 : tree_roll(d, -10, 10);
    grove_number(o, true);
    grove_number(o, false);
    double *q = TAKE(arena, double, m->n), *v = TAKE(arena, double, m->n);
    for (int k = 0; k < m->n; k++) q[k] = tree_roll(d, -1, 1), v[k] = tree_roll(d, -1, 1);
    m->q0 = q, m->v0 = v;
    return o;
}

/* --- one of them under test ---------------------------------------------------------------------- */

enum { MOST = 64, SEEDS = 40 };

struct fixture {
    struct arena *arena;
    struct grove *grove;
    struct model *m;
    struct sweep *s;
    int n;
    double q[MOST], v[MOST], a[MOST];
};

static inline void open_grove(struct fixture *f, int nbody, unsigned seed, unsigned flags)
{
    struct tree_dice d = {seed + 99};
    f->arena = arena_open();
    f->grove = random_grove(nbody, seed, flags, f->arena);
    f->m = &f->grove->m;
    f->s = sweep_planar.build(f->m, FOR_RECORDS, NULL, f->arena);
    f->n = f->m->n;
    assert(f->n <= MOST && f->m->nbody <= MOST);
    memcpy(f->q, f->m->q0, sizeof *f->q * (size_t)f->n);
    memcpy(f->v, f->m->v0, sizeof *f->v * (size_t)f->n);
    for (int i = 0; i < f->n; i++) f->a[i] = tree_roll(&d, -3, 3);
}

static inline void sweep_resid(double *r, struct fixture *f, const double *a, enum rate cls)
{
    memset(r, 0, sizeof *r * (size_t)f->n);
    sweep_planar.forward(f->s, f->q, f->v, a, cls);
    sweep_planar.backward(f->s, r, cls);
}

/* K q + D q' */
static inline void elastic_rows(double *r, const struct fixture *f)
{
    for (int i = 1; i < f->m->nbody; i++) {
        const struct model_body *b = &f->m->body[i];
        for (int k = 0; k < b->nmode; k++)
            for (int j = 0; j < b->nmode; j++) {
                r[b->mode_v[k]] += b->flex->K[k + b->nmode * j] * f->q[b->mode_q[j]];
                if (b->flex->D) r[b->mode_v[k]] += b->flex->D[k + b->nmode * j] * f->v[b->mode_v[j]];
            }
    }
}

#endif
