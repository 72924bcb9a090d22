/* load.c -- see load.h */
#include "sim/load.h"

#include "sim/parts.h"

enum status sim_load(struct scene **scene, const char *path, const struct deck_options *options, struct diags *diags,
                     struct arena *life, struct report *report)
{
    struct deck *deck;
    TRY(deck_load(&deck, path, options, diags, life, report));
    enum status status = scene_read(scene, deck, diags, life);
    if (status != OK && (*scene)->integrate.scheme) { /* all errors at once: the plan's too */
        struct sim sim = {.scene = *scene, .plan = (*scene)->integrate};
        (void)plan_steps(&sim, diags, NULL); /* they are in diags, and the deck is wrong as it is */
    }
    return status;
}
