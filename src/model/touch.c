/* touch.c -- see touch.h */
#include "model/touch.h"

static struct touched bodies(int a, int b)
{
    return (struct touched){a, b, -1, -1};
}

static struct touched coordinate(int iq, int iv)
{
    return (struct touched){-1, -1, iq, iv};
}

struct touched measure_touched(const struct model_measure *s)
{
    return s->type == MEASURE_COORDINATE ? coordinate(s->iq, s->iv) : bodies(s->a.body, s->b.body);
}

static struct touched slot(const struct model *m, const struct model_slot *s)
{
    switch (s->type) {
    case SLOT_MEASURE:
    case SLOT_MEASURE_RATE:
        return measure_touched(&m->measure[s->index]);
    case SLOT_Q:
        return coordinate(s->index, -1);
    case SLOT_V:
        return coordinate(-1, s->index);
    case SLOT_TIME:
        break;
    }
    return coordinate(-1, -1);
}

bool model_touched(struct touched *o, const struct model *m, const struct model_force *f, int i)
{
    if (i == 0)
        *o = f->measure >= 0 ? measure_touched(&m->measure[f->measure]) : bodies(f->a.body, f->b.body);
    else if (i <= f->nslot)
        *o = slot(m, &f->slot[i - 1]);
    else
        return false;
    return true;
}
