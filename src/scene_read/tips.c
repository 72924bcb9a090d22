/* tips.c -- what a deck says by expressions and the program has words for */
#include <math.h>

#include "expr/expr.h"
#include "scene_read/parts.h"

enum { SIDES = 7, PLACES = 2 * SIDES };

static const double distance[SIDES] = {1e-3, .01, .1, 1, 10, 100, 1e3};

/* Slot of the measure along which f acts; -1: its expression reads none, or something else that is no rate. */
static int own_slot(const struct scene *scene, const struct scene_force *f)
{
    enum { MOST = 4 };
    const struct scene_measure *m = &scene->measure[f->measure];
    int read[MOST], own = -1;
    const int n = f->value[0].expr ? expr_reads(f->value[0].expr, read, MOST) : 0;
    if (n > MOST) return -1;
    for (int i = 0; i < n; i++) {
        const struct scene_slot *s = &f->slot[read[i]];
        const bool measure = s->type == SCENE_MEASURE && s->index == f->measure;
        const bool joint = s->type == SCENE_COORDINATE && m->type == MEASURE_COORDINATE && s->index == m->joint;
        if (measure || joint)
            own = read[i];
        else if (s->type != SCENE_MEASURE_RATE && s->type != SCENE_RATE)
            return -1;
    }
    return own;
}

/* f at all places along its measure, at rest. */
static void sample(double *y, const struct scene_force *f, int slot)
{
    double x[EXPR_SLOTS] = {0};
    for (int i = 0; i < PLACES; i++) {
        x[slot] = i < SIDES ? -distance[SIDES - 1 - i] : distance[i - SIDES];
        y[i] = expr_value(f->value[0].expr, x);
    }
}

/* Is it 0 on one side, and on the other, beyond some place, a push back towards it that grows with the way?  Places go from
 * `from` by `step`, the pushes first. */
static bool pushes_back(const double *y, int from, int step)
{
    int pushes = 0;
    while (pushes < PLACES && y[from + step * pushes] * step > 0) pushes++;
    for (int i = 1; i < pushes; i++)
        if (!(fabs(y[from + step * i]) < fabs(y[from + step * (i - 1)]))) return false;
    for (int i = pushes; i < PLACES; i++)
        if (y[from + step * i] != 0) return false;
    return pushes > 1 && pushes < PLACES - 1;
}

void tip_on_force(struct builder *b, const struct scene_force *f)
{
    double y[PLACES];
    const int slot = f->type == FORCE_VALUE ? own_slot(b->scene, f) : -1;
    if (slot < 0 || expr_is_smooth(f->value[0].expr)) return;
    sample(y, f, slot);
    if (!pushes_back(y, 0, 1) && !pushes_back(y, PLACES - 1, -1)) return;
    diag_tip(b->diags, f->node, AT_KEY, "W-expression-stop", "'%.60s' is a stop written as an expression", f->name);
    diag_hint(b->diags,
              "{unilateral: ..., stiffness: ..., from: ...} knows its energy, keeps it at any step and needs none "
              "that resolves the push; a joint's range: {hold: rigid} needs no stiffness");
}
