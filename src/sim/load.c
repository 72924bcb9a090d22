/* load.c -- see load.h */
#include "sim/load.h"

enum status sim_load(struct scene **scene, const char *path, const struct deck_options *options, struct diags *diags,
                     struct arena *life, struct report *report)
{
    struct deck *deck;
    TRY(deck_load(&deck, path, options, diags, life, report));
    return scene_read(scene, deck, diags, life);
}
