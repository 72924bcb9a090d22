/* split_reach.c -- by what coordinates are measured when splits are compared.
 *
 * An angle by 1 rad.  A displacement by the way round its loop, the sum of the arms there: per radian no angle of the
 * loop moves it by more than that.  A shorter measure would take a slider for quick, and for a good independent
 * coordinate, until it is all but at its dead centre. */
#include <math.h>

#include "la/vec3.h"
#include "loop/split.h"
#include "tree/sizes.h"

static double arms(const double *a, const double *b, bool on_ground)
{
    return (on_ground ? 0 : v3_norm(a)) + v3_norm(b);
}

/* joint [of the tree's v]: whose coordinate it is; NULL: of a flexible body. */
static void list_joints(const struct model_joint **joint, const struct model *m)
{
    for (int i = 0; i < m->njoint; i++)
        for (int k = 0; k < m->joint[i].nv; k++) joint[m->joint[i].iv[k]] = &m->joint[i];
}

static double way_round(const struct loops *l, int loop, const struct model_joint *const *joint)
{
    const struct model_loop *own = &l->model->loop[loop];
    const struct model_joint *last = NULL;
    double sum = 0;
    if (own->nterm || own->drive) return 0;
    sum = own->second ? arms(own->a, own->b, own->first == 0) : v3_norm(own->a);
    if (model_kind(l->model, own->type)->tie == TIE_POINTS) sum += own->number;
    for (int k = 0; k < l->nk[loop]; k++) {
        const struct model_joint *j = joint[l->k[loop][k]];
        if (j && j != last) sum += arms(j->a, j->b, j->parent == 0);
        last = j;
    }
    return sum;
}

void split_reach(struct split *o)
{
    const struct loops *l = o->rows->loops;
    const struct model *m = l->model;
    const struct arena_mark mark = arena_mark(o->scratch);
    const struct model_joint **joint = TAKE(o->scratch, const struct model_joint *, o->rows->n);
    list_joints(joint, m);
    for (int i = 0; i < o->rows->n; i++) o->reach[i] = o->rows->size[i];
    for (int loop = 0; loop < m->nloop; loop++) {
        const double round = way_round(l, loop, joint);
        for (int k = 0; k < l->nk[loop]; k++) {
            const int iv = l->k[loop][k];
            const struct model_joint *j = joint[iv];
            for (int i = 0; j && i < j->nv; i++)
                if (j->iv[i] == iv && sizes_is_length(m, j, i)) o->reach[iv] = fmax(o->reach[iv], round);
        }
    }
    arena_rewind(o->scratch, mark);
}
