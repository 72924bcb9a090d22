/* keys.c -- see keys.h */
#include "base/keys.h"

#include <stdlib.h>
#include <string.h>

double key_value(const struct key *k, const void *block)
{
    const void *member = (const char *)block + k->offset;
    return k->type == KEY_REAL ? *(const double *)member : *(const int *)member;
}

bool key_is_default(const struct key *k, const void *block)
{
    const double x = k->type == KEY_BOOL ? strcmp(k->fallback, "true") == 0 : strtod(k->fallback, NULL);
    return key_value(k, block) == x;
}

int keys_count(const struct key *keys)
{
    int n = 0;
    while (keys[n].name) n++;
    return n;
}

const struct key *key_find(const struct key *keys, const char *name)
{
    for (const struct key *k = keys; k && k->name; k++)
        if (strcmp(k->name, name) == 0) return k;
    return NULL;
}
