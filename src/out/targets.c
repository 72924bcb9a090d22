/* targets.c -- see targets.h */
#include "out/targets.h"

#include "out/stream.h"

/* The file itself and, where it is written in parts, the one beside it. */
static int identify(struct file_id *id, const struct target *t, struct arena *life)
{
    int n = 0;
    if (!t->path) return 0;
    const char *part = t->parted ? stream_part(t->path, life) : NULL;
    n += file_identify(&id[n], t->path, life);
    if (part) n += file_identify(&id[n], part, life);
    return n;
}

static bool meet(const struct target *a, const struct target *b, struct arena *life)
{
    struct file_id x[2], y[2];
    int nx = identify(x, a, life), ny = identify(y, b, life);
    for (int i = 0; i < nx; i++)
        for (int j = 0; j < ny; j++)
            if (file_same(&x[i], &y[j])) return true;
    return false;
}

static enum status overwrites(const struct target *t, bool part, struct arena *life, struct report *report)
{
    if (!part)
        return fail(report, E_USAGE, "%s '%.200s' would overwrite an input file: choose another name", t->option,
                    t->path);
    return fail(report, E_USAGE,
                "%s '%.200s' is written as '%.200s' first, which would overwrite an input file: choose another name",
                t->option, t->path, stream_part(t->path, life));
}

enum status targets_check(const struct target *target, int n, const struct files *read, struct arena *life,
                          struct report *report)
{
    for (int i = 0; i < n; i++) {
        struct file_id id[2];
        for (int k = identify(id, &target[i], life); k-- > 0;)
            if (files_hold(read, &id[k])) return overwrites(&target[i], k > 0, life, report);
        for (int j = 0; j < i; j++)
            if (meet(&target[i], &target[j], life))
                return fail(report, E_USAGE, "%s and %s name one file, '%.200s': give each its own", target[j].option,
                            target[i].option, target[i].path);
    }
    return OK;
}
