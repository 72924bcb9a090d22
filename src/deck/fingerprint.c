/* fingerprint.c -- whether two decks say the same, whatever their text: numbers count by their values, parameters by
 * those that are used. */
#include <ctype.h>
#include <string.h>

#include "base/hash.h"
#include "deck/deck.h"

static uint64_t of_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text, strlen(text) + 1);
}

static bool value_of(double *x, const struct deck *deck, const struct scope *scope, const char *name)
{
    for (; scope; scope = scope->up)
        if (strcmp(scope->name, name) == 0) {
            *x = scope->value;
            return true;
        }
    return deck_parameter(x, name, deck) == 0;
}

/* The text, and the values of names in it that have one. */
static uint64_t of_formula(uint64_t hash, const struct deck *deck, const struct node *n)
{
    char name[80];
    double x;
    hash = of_text(hash, n->text);
    for (const char *p = n->text; *p;) {
        size_t len = 0;
        while (isalnum((unsigned char)p[len]) || p[len] == '_' || (len && p[len] == '.')) len++;
        if (len > 0 && len < sizeof name) {
            memcpy(name, p, len);
            name[len] = 0;
            if (value_of(&x, deck, n->scope, name)) hash = hash_bytes(hash, &x, sizeof x);
        }
        p += len ? len : 1;
    }
    return hash;
}

static uint64_t of_node(uint64_t hash, const struct deck *deck, const struct node *n)
{
    if (n->key) hash = of_text(hash, n->key);
    for (int i = 0; i < n->count; i++)
        if (!n->item[i]->implied) hash = of_node(hash, deck, n->item[i]);
    if (n->type != NODE_SCALAR) return hash_bytes(hash, "]", 1);
    if (n->has_value) return hash_bytes(hash, &n->value, sizeof n->value);
    return n->formula ? of_formula(hash, deck, n) : of_text(hash, n->text);
}

static bool is_among(const char *const *words, const char *word)
{
    while (*words && strcmp(*words, word) != 0) words++;
    return *words != NULL;
}

/* A default that was filled in says no more than a key that is not there: reading may or may not have come by it. */
uint64_t deck_fingerprint(const struct deck *deck, const char *const *sections, bool but)
{
    uint64_t hash = but ? deck->beside : HASH_NOTHING;
    for (int i = 0; i < deck->root->count; i++) {
        const struct node *n = deck->root->item[i];
        if (!n->implied && is_among(sections, n->key) != but) hash = of_node(hash, deck, n);
    }
    return hash;
}
