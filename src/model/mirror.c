/* mirror.c -- see mirror.h */
#include "model/mirror.h"

#include <math.h>

#include "flex/parity.h"
#include "la/vec3.h"
#include "model/flat_parts.h"

static const double PRINCIPAL = 1e-12; /* of a body's largest moment of inertia */

static const double origin[3] = {0, 0, 0};

static bool in_mirror(const struct flattening *o, double level, int body, const double *p)
{
    return flat_level(o, flat_height(o, body, p), level);
}

/* Of the first flexible body: the mirror goes through it. */
static double level_of(const struct flattening *o)
{
    int i = 1;
    while (!o->full->body[i].flex) i++;
    return flat_height(o, i, origin);
}

static bool is_principal(const struct flattening *o, int body)
{
    double J[6];
    s3_turn(J, o->T[body], o->full->body[body].inertia);
    return fmax(fabs(J[4]), fabs(J[5])) <= PRINCIPAL * fmax(J[0], fmax(J[1], J[2]));
}

static bool bodies_mirror(const struct flattening *o, double level)
{
    const struct model *m = o->full;
    for (int i = 1; i < m->nbody; i++)
        if (!in_mirror(o, level, i, origin) || (!m->body[i].flex && !is_principal(o, i))) return false;
    return true;
}

/* Both ends of a joint stand at one height, see flatten(). */
static bool joints_mirror(const struct flattening *o, double level)
{
    const struct model *m = o->full;
    for (int i = 0; i < m->nloop; i++) {
        const struct model_loop *l = &m->loop[i];
        if (!l->drive && !l->nterm && !in_mirror(o, level, l->first, l->a)) return false;
    }
    return true;
}

static bool measures_mirror(const struct flattening *o, double level)
{
    const struct model *m = o->full;
    for (int i = 0; i < m->nmeasure; i++) {
        const struct model_measure *s = &m->measure[i];
        if (s->type == MEASURE_COORDINATE || s->type == MEASURE_ANGLE) continue;
        if (!in_mirror(o, level, s->a.body, s->a.p) || !in_mirror(o, level, s->b.body, s->b.p)) return false;
    }
    return true;
}

/* Its component c, of which axes T has, along the normal: of a torque, across it. */
static bool acts_across(const struct model_force *f, const double *T)
{
    for (int c = 0; c < 3; c++) {
        const double along = T[2 + 3 * c], across = hypot(T[3 * c], T[1 + 3 * c]);
        if (!signal_is_zero(&f->value[c]) && fabs(f->torque ? across : along) > PRINCIPAL) return true;
    }
    return false;
}

static bool forces_mirror(const struct flattening *o, double level)
{
    const struct model *m = o->full;
    for (int i = 0; i < m->nforce; i++) {
        const struct model_force *f = &m->force[i];
        if (f->type != FORCE_LOAD) continue;
        if (acts_across(f, o->T[f->body_axes ? f->b.body : 0])) return false;
        if (!f->torque && !in_mirror(o, level, f->b.body, f->b.p)) return false;
    }
    return true;
}

static bool scene_mirrors(const struct flattening *o)
{
    const struct model *m = o->full;
    const double level = level_of(o);
    return fabs(v3_dot(m->gravity, o->P + 6)) <= PRINCIPAL * v3_norm(m->gravity) && bodies_mirror(o, level) &&
           joints_mirror(o, level) && measures_mirror(o, level) && forces_mirror(o, level);
}

/* Does anything of the deck move or read coordinate k of a body? */
static bool is_used(const struct model *m, const struct model_body *b, int k)
{
    if (m->q0[b->mode_q[k]] != 0 || m->v0[b->mode_v[k]] != 0) return true;
    for (int i = 0; i < m->nforce; i++)
        for (int j = 0; j < m->force[i].nslot; j++) {
            const struct model_slot *s = &m->force[i].slot[j];
            if ((s->type == SLOT_Q && s->index == b->mode_q[k]) || (s->type == SLOT_V && s->index == b->mode_v[k]))
                return true;
        }
    return false;
}

/* Odd modes of a body, of which *any := true; false: it has no mirror, or they do not rest. */
static bool find_odd(bool *odd, bool *any, const struct flattening *o, int body)
{
    const struct model_body *b = &o->full->body[body];
    struct arena_mark mark = arena_mark(o->life);
    const bool mirrors = flex_parity(odd, flex_in_axes(b->flex, o->T[body], o->life)) &&
                         (!b->full || flex_parity(odd, flex_in_axes(b->full, o->T[body], o->life)));
    arena_rewind(o->life, mark);
    for (int k = 0; mirrors && k < b->nmode; k++) {
        if (odd[k] && is_used(o->full, b, k)) return false;
        *any |= odd[k];
    }
    return mirrors;
}

static bool is_flexible(const struct model *m)
{
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].flex) return true;
    return false;
}

const bool *const *model_still(const struct model *m, struct arena *life)
{
    if (m->space == 2 || !is_flexible(m)) return NULL;
    struct model_spatial why;
    struct flattening o = flattening_of(m, &why, life);
    const bool **odd = TAKE(life, const bool *, m->nbody);
    bool any = false;
    o.bent = true;
    if (!flatten(&o) || !scene_mirrors(&o)) return NULL;
    for (int i = 1; i < m->nbody; i++) {
        if (!m->body[i].flex) continue;
        bool *of = TAKE(life, bool, m->body[i].nmode);
        if (!find_odd(of, &any, &o, i)) return NULL;
        odd[i] = of;
    }
    return any ? odd : NULL;
}
