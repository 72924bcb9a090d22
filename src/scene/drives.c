/* drives.c -- measures that move as functions of time */
#include "scene/build.h"

static int read_drive(struct builder *b, struct scene_drive *o, const struct node *n)
{
    char what[100];
    struct drive_keys k = {0};
    snprintf(what, sizeof what, "drive '%.60s'", n->key);
    *o = (struct scene_drive){.name = n->key, .node = n};
    if (read_map(n, what, &b->reader) || read_keys(&k, keys_drive, n, NULL, what, &b->reader)) return 1;
    o->measure = measure_of(b, k.drive, what);
    int errors = read_time_signal(b, &o->value, k.value, what);
    if (o->measure < 0) return 1;
    if (b->scene->space == 3 && b->scene->measure[o->measure].type == MEASURE_ANGLE) {
        diag_error(b->diags, k.drive, AT_VALUE, "E-drive", "%s: an angle in space cannot be driven", what);
        diag_hint(b->diags, "drive the coordinate of a joint");
        return 1;
    }
    return errors;
}

int read_drives(struct builder *b, const struct node *n)
{
    int errors = 0;
    if (!n) return 0;
    if (read_map(n, "'drives'", &b->reader)) return 1;
    struct scene *scene = b->scene;
    scene->drive = TAKE(b->life, struct scene_drive, n->count);
    for (int i = 0; i < n->count; i++) {
        struct scene_drive d;
        if (!may_own_columns(n->item[i]->key)) {
            diag_error(b->diags, n->item[i], AT_KEY, "E-name", "'%.60s' cannot name a drive", n->item[i]->key);
            errors++;
        } else if (read_drive(b, &d, n->item[i])) {
            errors++;
        } else {
            scene->drive[scene->ndrive++] = d;
        }
    }
    return errors;
}
