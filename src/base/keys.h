/* keys.h -- deck keys as data.
 *
 * One line per key gives the reader, the range check, `fmdsub list`, `fmdsub schema` and the manual
 * the same facts.  A table ends with an entry whose name is NULL.  The reader (deck/read.h) fills a
 * plain struct at the offsets given here. */
#ifndef FMDSUB_BASE_KEYS_H
#define FMDSUB_BASE_KEYS_H

#include <stdbool.h>
#include <stddef.h>

enum key_type {
    KEY_REAL,   /* double            a number or an expression of parameters */
    KEY_INT,    /* int               likewise, whole */
    KEY_BOOL,   /* int               true or false */
    KEY_WORD,   /* int               index into words, "newmark|midpoint|..." */
    KEY_TEXT,   /* const char *      any text */
    KEY_VECTOR, /* double[3]         [x, y, z], in 2-D decks [x, y], or with KEY_ABOUT the number z */
    KEY_TABLE,  /* struct points     rows [x, y] of numbers, x increasing */
    KEY_CSV,    /* struct points     the same from a file beside the deck, by name */
    KEY_NODE    /* const node *      a shape of its own (point, name, list, expression, map), read by its owner;
                                     words tells the shape for the manual: "point", "joint", "[body, body]" */
};

enum key_flag {
    KEY_REQUIRED = 1,
    KEY_ABOVE = 2,    /* lo itself is not allowed */
    KEY_BELOW = 4,    /* hi itself is not allowed */
    KEY_PLANAR = 8,   /* only in 2-D decks */
    KEY_SPATIAL = 16, /* only in 3-D decks */
    KEY_NEUTRAL = 32, /* its default is what those do that do not know it */
    KEY_META = 64,    /* a number that the meta record of a run gives */
    KEY_ABOUT = 128,  /* a vector about axes: turns, torques */
    KEY_DRAWN = 256   /* of a law along a measure: its default is the measure when drawn, a distance; else 0 */
};

struct points {
    int n;
    const double *x, *y; /* [n] */
};

struct key {
    const char *name;
    enum key_type type;
    size_t offset;    /* of the member it fills */
    const char *unit; /* "N/m"; NULL: none */
    double lo, hi;    /* range of the number, inclusive unless flagged */
    unsigned flags;
    const char *words;    /* KEY_WORD: choices joined by '|'; KEY_INT: a word that stands for 0; KEY_NODE: its shape */
    const char *fallback; /* default as deck text; NULL: stays as the struct was */
    const char *brief;    /* one line for the manual */
};

/* A table of keys and where it belongs. */
struct section {
    const char *path; /* "bodies.NAME", "constraints.NAME", "integrate" */
    const char *word; /* the kind's own key, "revolute", "spring"; NULL: the section has one kind only */
    const char *brief;
    const struct key *keys; /* ends with KEYS_END */
};

/* Values that are right one by one, but not together. */
struct misfit {
    const char *code, *key, *other; /* of the message; the keys to blame, the first that is given */
    char text[160];
    const char *hint;
};

/* A block that is read for its owner. */
struct key_block {
    const struct key *keys; /* ends with KEYS_END */
    size_t size;
};

/* The value in block of a key that is no text and no node, as a number: 0 or 1, the index of a word. */
double key_value(const struct key *k, const void *block);
/* Is it the default?  Of numbers, true and false. */
bool key_is_default(const struct key *k, const void *block);
/* Of a table: its keys; the one of this name, NULL: not there, or no table. */
int keys_count(const struct key *keys);
const struct key *key_find(const struct key *keys, const char *name);

#define KEYS_END                                                                                                       \
    {                                                                                                                  \
        0                                                                                                              \
    }

/* PARAM_REAL(struct spring, k, "stiffness", "N/m", 0, INFINITY, KEY_REQUIRED, NULL, "force per elongation") */
#define PARAM_REAL(strukt, member, word, unit_, lo_, hi_, flags_, fallback_, brief_)                                   \
    {                                                                                                                  \
        .name = word, .type = KEY_REAL, .offset = offsetof(strukt, member), .unit = unit_, .lo = lo_, .hi = hi_,       \
        .flags = flags_, .fallback = fallback_, .brief = brief_                                                        \
    }
#define PARAM_VECTOR(strukt, member, word, unit_, lo_, hi_, flags_, brief_)                                            \
    {                                                                                                                  \
        .name = word, .type = KEY_VECTOR, .offset = offsetof(strukt, member), .unit = unit_, .lo = lo_, .hi = hi_,     \
        .flags = flags_, .brief = brief_                                                                               \
    }
#define PARAM_INT(strukt, member, word, lo_, hi_, flags_, fallback_, brief_)                                           \
    {                                                                                                                  \
        .name = word, .type = KEY_INT, .offset = offsetof(strukt, member), .lo = lo_, .hi = hi_, .flags = flags_,      \
        .fallback = fallback_, .brief = brief_                                                                         \
    }
/* A whole number, or a word, which is 0. */
#define PARAM_COUNT(strukt, member, word, lo_, hi_, or_, flags_, fallback_, brief_)                                    \
    {                                                                                                                  \
        .name = word, .type = KEY_INT, .offset = offsetof(strukt, member), .lo = lo_, .hi = hi_, .flags = flags_,      \
        .words = or_, .fallback = fallback_, .brief = brief_                                                           \
    }
#define PARAM_BOOL(strukt, member, word, flags_, fallback_, brief_)                                                    \
    {                                                                                                                  \
        .name = word, .type = KEY_BOOL, .offset = offsetof(strukt, member), .flags = flags_, .fallback = fallback_,    \
        .brief = brief_                                                                                                \
    }
#define PARAM_WORD(strukt, member, word, words_, flags_, fallback_, brief_)                                            \
    {                                                                                                                  \
        .name = word, .type = KEY_WORD, .offset = offsetof(strukt, member), .words = words_, .flags = flags_,          \
        .fallback = fallback_, .brief = brief_                                                                         \
    }
#define PARAM_TEXT(strukt, member, word, flags_, fallback_, brief_)                                                    \
    {                                                                                                                  \
        .name = word, .type = KEY_TEXT, .offset = offsetof(strukt, member), .flags = flags_, .fallback = fallback_,    \
        .brief = brief_                                                                                                \
    }
/* A table in the deck, and one in a file; both may fill the same member. */
#define PARAM_TABLE(strukt, member, word, shape_, flags_, brief_)                                                      \
    {                                                                                                                  \
        .name = word, .type = KEY_TABLE, .offset = offsetof(strukt, member), .words = shape_, .flags = flags_,         \
        .brief = brief_                                                                                                \
    }
#define PARAM_CSV(strukt, member, word, flags_, brief_)                                                                \
    {                                                                                                                  \
        .name = word, .type = KEY_CSV, .offset = offsetof(strukt, member), .words = "text", .flags = flags_,           \
        .brief = brief_                                                                                                \
    }
#define PARAM_NODE(strukt, member, word, shape_, flags_, brief_)                                                       \
    {                                                                                                                  \
        .name = word, .type = KEY_NODE, .offset = offsetof(strukt, member), .words = shape_, .flags = flags_,          \
        .brief = brief_                                                                                                \
    }

#endif
