/* roster.c -- which bodies move when a class is evaluated; see sweep.h.
 *
 * The ground is on no list.  A slow body has only slow bodies on its path, so SLOW needs no others.
 * FAST needs the motion of every body that a fast element touches or reads, and of all bodies
 * on the path from there to the ground. */
#include <string.h>

#include "system/sweep.h"

static void read_measure(bool *moves, const struct model *m, int i)
{
    const struct model_measure *s = &m->measure[i];
    if (s->type == MEASURE_COORDINATE) return;
    moves[s->a.body] = moves[s->b.body] = true;
}

static void read_force(bool *moves, const struct model *m, const struct model_force *f)
{
    if (f->type == FORCE_LAW || f->type == FORCE_VALUE) read_measure(moves, m, f->measure);
    if (f->type == FORCE_LOAD || f->type == FORCE_BUSHING) moves[f->b.body] = true;
    if (f->type == FORCE_BUSHING) moves[f->a.body] = true;
    for (int i = 0; i < f->nslot; i++)
        if (f->slot[i].type == SLOT_MEASURE || f->slot[i].type == SLOT_MEASURE_RATE)
            read_measure(moves, m, f->slot[i].index);
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

void rosters_build(struct rosters *o, const struct model *m, struct arena *life)
{
    bool *fast = TAKE(life, bool, m->nbody), *slow = TAKE(life, bool, m->nbody), *all = TAKE(life, bool, m->nbody);
    bool *moves = TAKE(life, bool, m->nbody), *none = TAKE(life, bool, m->nbody);
    memset(o, 0, sizeof *o);
    for (int i = 1; i < m->nbody; i++) {
        fast[i] = moves[i] = m->body[i].fast;
        slow[i] = !fast[i];
        all[i] = true;
    }
    for (int i = 0; i < m->nforce; i++)
        if (m->force[i].cls & FAST) read_force(moves, m, &m->force[i]);
    for (int i = m->nbody - 1; i > 0; i--)
        if (moves[i]) moves[m->body[i].parent] = true;
    list(&o->of[FAST], moves, fast, m->nbody, life);
    list(&o->of[SLOW], none, slow, m->nbody, life);
    list(&o->of[ALL], none, all, m->nbody, life);
}
