/* belongs.c -- where a key belongs that a map does not know. */
#include <string.h>

#include "deck/stages.h"

static const char *last_word(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot ? dot + 1 : path;
}

static bool same_parent(const char *a, const char *b)
{
    const ptrdiff_t n = last_word(a) - a;
    return n == last_word(b) - b && !strncmp(a, b, (size_t)n);
}

/* Sections that hold a key, by name. */
struct places {
    const char *name[2]; /* the first ones */
    int n;
};

static void add_place(struct places *o, const char *name)
{
    for (int i = 0; i < o->n && i < 2; i++)
        if (!strcmp(name, o->name[i])) return;
    if (o->n++ < 2) o->name[o->n - 1] = name;
}

/* A key of a map that one of words[0..n) holds: "'elements' belongs into 'beam'". */
static bool inside(const char *key, const char *const *words, int n, struct reader *rd)
{
    struct places in = {{NULL}, 0};
    for (int k = 0; k < rd->nsection; k++) {
        const struct section *s = &rd->sections[k];
        const char *name = last_word(s->path);
        for (int i = 0; !s->word && i < n; i++)
            if (strcmp(words[i], name) == 0 && key_find(s->keys, key)) add_place(&in, name);
    }
    if (in.n == 1) diag_hint(rd->diags, "it belongs into '%s': %s: {%s: ...}", in.name[0], in.name[0], key);
    if (in.n == 2) diag_hint(rd->diags, "it belongs into '%s' or '%s'", in.name[0], in.name[1]);
    return in.n == 1 || in.n == 2;
}

/* A key of the map that holds that of `keys`, or of a section beside it. */
static bool beside(const char *key, const struct key *keys, struct reader *rd)
{
    struct places in = {{NULL}, 0};
    int own = 0;
    while (own < rd->nsection && (rd->sections[own].keys != keys || rd->sections[own].word)) own++;
    if (own == rd->nsection) return false;
    const char *path = rd->sections[own].path, *name = last_word(path);
    const size_t above = name > path ? (size_t)(name - path) - 1 : 0;
    for (int i = 0; i < rd->nsection; i++) {
        const struct section *s = &rd->sections[i];
        if (!strcmp(s->path, path) || !key_find(s->keys, key)) continue;
        if (above && strlen(s->path) == above && !strncmp(s->path, path, above)) {
            diag_hint(rd->diags, "it belongs beside '%s', not into it", name);
            return true;
        }
        if (same_parent(s->path, path)) add_place(&in, last_word(s->path));
    }
    if (in.n == 1) diag_hint(rd->diags, "it belongs into '%s', beside '%s'", in.name[0], name);
    if (in.n == 2) diag_hint(rd->diags, "it belongs into '%s' or '%s', beside '%s'", in.name[0], in.name[1], name);
    return in.n == 1 || in.n == 2;
}

bool suggest_section(const char *key, const char *const *words, int n, const struct key *keys, struct reader *rd)
{
    return inside(key, words, n, rd) || beside(key, keys, rd);
}
