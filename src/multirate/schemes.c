/* schemes.c -- all schemes by name, and their options together */
#include "multirate/schemes.h"

#include <string.h>

#include "engine/relay.h"

extern const struct stepper_kind step_subcycle, step_newmark, step_generalized_alpha, step_hht, step_midpoint,
    step_miao, step_daniel, step_neal_belytschko, step_rk4, step_dopri5, step_dop853, step_radau5, step_radau9,
    step_bdf;

const struct stepper_kind *const stepper_kinds[] = {
    &step_subcycle, &step_newmark,         &step_generalized_alpha,
    &step_hht,      &step_midpoint,        &step_miao,
    &step_daniel,   &step_neal_belytschko, &step_rk4,
    &step_dopri5,   &step_dop853,          &step_radau5,
    &step_radau9,
#ifdef CVODE
    &step_bdf,
#endif
    NULL,
};
const struct stepper_kind *const stepper_absent[] = {
#ifndef CVODE
    &step_bdf,
#endif
    NULL,
};
enum {
    BUILT = sizeof stepper_kinds / sizeof *stepper_kinds - 1,
    KINDS = BUILT + sizeof stepper_absent / sizeof *stepper_absent - 1
};

/* Of all: what a deck may say is the same in every build. */
static const struct stepper_kind *kind_at(int i)
{
    return i < BUILT ? stepper_kinds[i] : stepper_absent[i - BUILT];
}

static const struct stepper_kind *find(const struct stepper_kind *const *kind, const char *name)
{
    for (; *kind; kind++)
        if (strcmp((*kind)->name, name) == 0) return *kind;
    return NULL;
}

const struct stepper_kind *stepper_find(const char *name)
{
    return strcmp(name, step_relay.name) == 0 ? &step_relay : find(stepper_kinds, name);
}

const struct stepper_kind *stepper_find_absent(const char *name)
{
    return find(stepper_absent, name);
}

/* "newmark, miao: beta of (2-5)"; what most schemes read needs no names. */
const char *stepper_brief(const struct key *key, struct arena *life)
{
    const char *names = "";
    int n = 0;
    for (int i = 0; i < KINDS; i++) {
        if (!key_find(kind_at(i)->keys, key->name)) continue;
        names = arena_print(life, "%s%s%s", names, n++ ? ", " : "", kind_at(i)->name);
    }
    return 2 * n > KINDS ? key->brief : arena_print(life, "%s: %s", names, key->brief);
}

/* Puts a key where its member of the block stands, once. */
static void insert(struct key *table, int *n, const struct key *key)
{
    int at = *n;
    while (at > 0 && table[at - 1].offset > key->offset) at--;
    if (at > 0 && table[at - 1].offset == key->offset) return;
    memmove(table + at + 1, table + at, sizeof *table * (size_t)(*n - at));
    table[at] = *key;
    ++*n;
}

struct key_block stepper_options(struct arena *life)
{
    int n = 0, most = 0;
    for (int i = 0; i < KINDS; i++)
        for (const struct key *k = kind_at(i)->keys; k && k->name; k++) most++;
    struct key *table = TAKE(life, struct key, most + 1);
    for (int i = 0; i < KINDS; i++)
        for (const struct key *k = kind_at(i)->keys; k && k->name; k++) insert(table, &n, k);
    return (struct key_block){table, sizeof(struct step_options)};
}
