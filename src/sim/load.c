/* load.c -- see load.h */
#include "sim/load.h"

#include <string.h>

#include "multirate/schemes.h"
#include "sim/parts.h"

enum status sim_load(struct scene **scene, const char *path, const struct deck_options *options, struct diags *diags,
                     struct arena *life, struct report *report)
{
    struct deck *deck;
    TRY(deck_load(&deck, path, options, diags, life, report));
    const struct key_block schemes = stepper_options(life);
    enum status status = scene_read(scene, deck, &schemes, diags, life);
    if (status != OK && (*scene)->integrate.scheme) { /* all errors at once: the plan's too */
        struct sim sim = {.scene = *scene, .plan = (*scene)->integrate};
        (void)plan_steps(&sim, diags, NULL); /* they are in diags, and the deck is wrong as it is */
    }
    return status;
}

static const struct key *joined(const struct key *a, const struct key *b, struct arena *life)
{
    const int na = keys_count(a), nb = keys_count(b);
    struct key *both = TAKE(life, struct key, na + nb + 1);
    memcpy(both, a, sizeof *a * (size_t)na);
    memcpy(both + na, b, sizeof *b * (size_t)nb);
    return both;
}

bool sim_section(struct section *o, int i, struct arena *life)
{
    if (!scene_section(o, i)) return false;
    if (strcmp(o->path, "integrate") == 0) o->keys = joined(o->keys, stepper_options(life).keys, life);
    return true;
}
