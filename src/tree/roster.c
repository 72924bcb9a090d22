/* roster.c -- which bodies move when a class is evaluated; see sweep.h.
 *
 * The ground is on no list.  A slow body has only slow bodies on its path, so SLOW needs no others.
 * FAST needs the motion of every body that a fast element touches or reads, and of all bodies
 * on the path from there to the ground. */
#include <string.h>

#include "model/touch.h"
#include "tree/sweep.h"

static void touch(bool *moves, const struct touched *t)
{
    if (t->a >= 0) moves[t->a] = moves[t->b] = true;
}

static void touch_force(bool *moves, const struct model *m, const struct model_force *f)
{
    struct touched t;
    for (int i = 0; model_touched(&t, m, f, i); i++) touch(moves, &t);
}

static void list(struct roster *o, const bool *moves, const bool *bears, int nbody, struct arena *life)
{
    int *body = TAKE(life, int, nbody);
    char *with_mass = TAKE(life, char, nbody);
    for (int i = 1; i < nbody; i++) {
        if (!moves[i] && !bears[i]) continue;
        body[o->n] = i;
        with_mass[o->n++] = bears[i];
    }
    o->body = body;
    o->bears = with_mass;
}

/* What motion, forces and loops need: all bodies but nodes where nothing happens. */
static void find_wanted(bool *wanted, const struct model *m)
{
    for (int i = 0; i < m->nforce; i++) touch_force(wanted, m, &m->force[i]);
    for (int i = 0; i < m->nloop; i++) {
        const struct model_loop *l = &m->loop[i];
        if (l->nterm == 0) wanted[l->first] = wanted[l->second] = true;
        if (!l->drive) continue;
        const struct touched t = measure_touched(&m->measure[l->measure]);
        touch(wanted, &t);
    }
    for (int i = m->nbody - 1; i > 0; i--) {
        if (!m->body[i].at_node) wanted[i] = true;
        if (wanted[i]) wanted[m->body[i].parent] = true;
    }
}

/* Of the limbs that hold one of `bodies` all that they carry. */
static const bool *find_limbs(const struct model *m, const bool *bodies, struct arena *life)
{
    bool *limbs = TAKE(life, bool, m->nbody);
    for (int i = m->nbody - 1; i > 0; i--) {
        limbs[i] |= bodies[i];
        if (m->body[i].parent) limbs[m->body[i].parent] |= limbs[i];
    }
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].parent) limbs[i] = limbs[m->body[i].parent];
    return limbs;
}

double rosters_limbs(const struct model *m, struct arena *life)
{
    bool *fast = TAKE(life, bool, m->nbody);
    double sum = 0;
    for (int i = 1; i < m->nbody; i++) fast[i] = m->body[i].fast;
    const bool *limbs = find_limbs(m, fast, life);
    for (int i = 1; i < m->nbody; i++) sum += limbs[i];
    return m->nbody > 1 ? sum / (m->nbody - 1) : 1;
}

void roster_clear(const struct roster *o, double *M, int n)
{
    const size_t near = (size_t)o->near, rows = (size_t)n;
    if (o->near == n) memset(M, 0, sizeof *M * rows * rows);
    for (size_t j = 0; j < near && o->near < n; j++) memset(M + j * rows, 0, sizeof *M * near);
}

void rosters_build(struct rosters *o, const struct model *m, enum purpose purpose, const bool *bodies,
                   struct arena *life)
{
    bool *fast = TAKE(life, bool, m->nbody), *slow = TAKE(life, bool, m->nbody), *all = TAKE(life, bool, m->nbody);
    bool *moves = TAKE(life, bool, m->nbody), *none = TAKE(life, bool, m->nbody), *limbs = TAKE(life, bool, m->nbody);
    memset(o, 0, sizeof *o);
    if (purpose == FOR_STEPS)
        find_wanted(all, m);
    else
        memset(all, true, sizeof *all * (size_t)m->nbody);
    for (int i = 1; i < m->nbody; i++) {
        fast[i] = moves[i] = bodies ? bodies[i] : all[i] && m->body[i].fast;
        slow[i] = all[i] && !m->body[i].fast;
    }
    o->limbs = find_limbs(m, fast, life);
    for (int i = 1; i < m->nbody; i++) limbs[i] = all[i] && o->limbs[i];
    for (int i = 0; i < m->nforce && !bodies; i++)
        if (m->force[i].cls & FAST) touch_force(moves, m, &m->force[i]);
    for (int i = m->nbody - 1; i > 0; i--)
        if (moves[i]) moves[m->body[i].parent] = true;
    list(&o->of[FAST], moves, fast, m->nbody, life);
    list(&o->of[SLOW], none, slow, m->nbody, life);
    list(&o->of[ALL], none, all, m->nbody, life);
    list(&o->of[LIMBS], none, limbs, m->nbody, life);
    o->of[SLOW].near = o->of[ALL].near = o->of[LIMBS].near = m->n;
    o->of[FAST].near = bodies || m->near == 0 ? m->n : m->near;
}
