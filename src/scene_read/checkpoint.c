/* checkpoint.c -- where a run keeps all that it needs to go on, and how often */
#include <string.h>

#include "base/text.h"
#include "scene_read/parts.h"

static int read_often(struct builder *b, struct checkpoint *o, const struct node *n)
{
    if (n->type == NODE_MAP) {
        struct every_keys k = {0};
        if (read_keys(&k, keys_checkpoint_every, n, NULL, "'every'", &b->reader)) return 1;
        o->steps = k.steps;
        return 0;
    }
    if (read_number(&o->every, n, NULL, &b->reader)) return 1;
    if (o->every > 0) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-range", "'every' must be positive");
    return 1;
}

void read_checkpoint(struct builder *b, const struct node *n)
{
    struct checkpoint *o = &b->scene->checkpoint;
    struct checkpoint_keys k = {0};
    if (!n || read_keys(&k, keys_checkpoint, n, NULL, "'checkpoint'", &b->reader)) return;
    if (read_often(b, o, k.every)) return;
    o->file = k.file;
    if (*k.file && !strchr(k.file, '/') && k.file[0] != '.') return;
    diag_error(b->diags, node_find(n, "file"), AT_VALUE, "E-checkpoint",
               "'file' is a plain name, of a file in the folder where the run is started");
}
