/* drives.c -- measures that move as functions of time */
#include <math.h>

#include "expr/expr.h"
#include "scene_read/parts.h"

/* What the value is counted from is added to it. */
static void count_from(struct builder *b, struct signal *o, double drawn)
{
    if (drawn == 0) return;
    if (o->expr) {
        *o = signal_of(expr_plus(o->expr, drawn, b->life), b->life);
        return;
    }
    double *x = TAKE(b->life, double, o->n);
    for (int i = 0; i < o->n; i++) x[i] = o->x[i] + drawn;
    o->x = x;
}

static int read_drive(struct builder *b, struct scene_drive *o, const struct node *n)
{
    char what[100];
    struct drive_keys k = {0};
    snprintf(what, sizeof what, "drive '%.60s'", n->key);
    *o = (struct scene_drive){.name = n->key, .node = n};
    if (read_map(n, what, &b->reader)) return 1;
    if (!node_find(n, "drive") && not_there(b, n, "drives", "drive")) return 1;
    if (read_keys(&k, keys_drive, n, NULL, what, &b->reader)) return 1;
    o->measure = measure_of(b, k.drive, what);
    int errors = read_time_signal(b, &o->value, k.value, what);
    if (o->measure < 0) return 1;
    if (k.drawn) count_from(b, &o->value, b->scene->measure[o->measure].drawn);
    if (b->scene->space == 3 && b->scene->measure[o->measure].type == MEASURE_ANGLE) {
        diag_error(b->diags, k.drive, AT_VALUE, "E-drive", "%s: an angle in space cannot be driven", what);
        diag_hint(b->diags, "drive the coordinate of a joint");
        return 1;
    }
    return errors;
}

void read_drives(struct builder *b, const struct node *n)
{
    if (!n || read_map(n, "'drives'", &b->reader)) return;
    struct scene *scene = b->scene;
    scene->drive = TAKE(b->life, struct scene_drive, n->count);
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
        struct scene_drive d;
        if (!wrong_name(b, n->item[i], "drive") && !read_drive(b, &d, n->item[i])) scene->drive[scene->ndrive++] = d;
    }
}

/* Does `initial:` place the coordinate?  What it says must fit the drive. */
static bool is_placed(const struct scene *scene, const struct scene_measure *m)
{
    for (int i = 0; i < scene->ninitial; i++) {
        const struct scene_initial *s = &scene->initial[i];
        if (m->type == MEASURE_COORDINATE && s->type == INITIAL_POSITION && s->joint == m->joint && s->k == m->k)
            return true;
    }
    return false;
}

void warn_of_drives(struct builder *b)
{
    static const double FITS = 1e-6;
    const struct scene *scene = b->scene;
    if (scene->from || scene->assemble) return;
    for (int i = 0; i < scene->ndrive; i++) {
        const struct scene_drive *d = &scene->drive[i];
        const struct scene_measure *m = &scene->measure[d->measure];
        double x[3];
        signal_motion(&d->value, x, 0);
        if (!isfinite(x[0]) || fabs(x[0] - m->drawn) <= FITS * (1 + fabs(m->drawn)) || is_placed(scene, m)) continue;
        diag_warn(b->diags, node_find(d->node, "value"), AT_VALUE, "W-drive-start",
                  "drive '%.60s' begins at %.9g, but is drawn at %.9g: the run starts with it moved there", d->name,
                  x[0], m->drawn);
        if (m->type == MEASURE_COORDINATE)
            diag_hint(b->diags, "if that is meant, place it by 'initial:' as well");
        else
            diag_hint(b->diags, "a %s is counted from zero, and with 'from: drawn' from where it is drawn",
                      m->type == MEASURE_DISTANCE ? "distance" : "measure");
    }
}
