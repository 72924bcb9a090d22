/* load.c -- see load.h */
#include "sim/load.h"

#include <string.h>

#include "multirate/schemes.h"
#include "sim/parts.h"

enum status sim_load(struct scene **scene, const char *path, const struct deck_options *options, struct diags *diags,
                     struct arena *life, struct report *report)
{
    return sim_load_with(scene, path, options, 0, diags, life, report);
}

enum status sim_load_with(struct scene **scene, const char *path, const struct deck_options *options, unsigned unheard,
                          struct diags *diags, struct arena *life, struct report *report)
{
    struct deck *deck;
    TRY(deck_load(&deck, path, options, diags, life, report));
    const struct key_block schemes = stepper_options(life);
    enum status status = scene_read(scene, deck, &schemes, unheard, diags, life);
    if (status != OK && (*scene)->integrate.scheme) { /* all errors at once: the plan's too */
        struct sim sim = {.scene = *scene, .plan = (*scene)->integrate};
        (void)plan_steps(&sim, diags, life, NULL); /* they are in diags, and the deck is wrong as it is */
    }
    return status;
}

/* The section's own keys, then the options, which say whose they are. */
static const struct key *with_options(const struct key *own, struct arena *life)
{
    const struct key *options = stepper_options(life).keys;
    const int n = keys_count(own), more = keys_count(options);
    struct key *both = TAKE(life, struct key, n + more + 1);
    memcpy(both, own, sizeof *own * (size_t)n);
    memcpy(both + n, options, sizeof *options * (size_t)more);
    for (int i = n; i < n + more; i++) both[i].brief = stepper_brief(&both[i], life);
    return both;
}

bool sim_section(struct section *o, int i, struct arena *life)
{
    if (!scene_section(o, i)) return false;
    if (strcmp(o->path, "integrate") == 0) o->keys = with_options(o->keys, life);
    return true;
}
