/* stages.h -- the stages of deck_load, private to this folder.  Each works on deck->root in place and tells
 * deck->diags. */
#ifndef FMDSUB_DECK_STAGES_H
#define FMDSUB_DECK_STAGES_H

#include <sys/stat.h>

#include "deck/deck.h"
#include "deck/read.h"

/* include: of the deck's root; `self` is the deck's own file. */
void include_all(struct deck *deck, const struct stat *self);

/* Checks a text and makes its tree; NULL: reported. */
struct node *deck_parse(struct deck *deck, const struct source *s, const char *what);

/* All of an open file, which joins deck->read. */
enum status deck_read(struct source **out, int fd, const char *path, struct deck *deck, struct report *report);

/* Opens a file named by a node, inside the deck's folder; -1: reported. */
int deck_open_file(const struct node *n, struct deck *deck);
/* The same as a source; NULL: reported. */
struct source *source_beside(const struct node *file, struct deck *deck);

void hash_text(struct deck *deck, const char *text, size_t len);
/* A file that is named, and not merged into the tree. */
void hash_file(struct deck *deck, const struct source *s);

/* --set, in two rounds: early ones find their place in the deck as written, so that parameters and
 * repeat: see them; the late ones name what repeat: has made, or something new. */
struct set;
struct set *set_open(const struct deck_options *options, struct deck *deck);
void set_early(struct set *set, struct deck *deck);
void set_late(struct set *set, struct deck *deck);

/* What --set has put something else in the place of: its parameters are not unused for that. */
struct replaced {
    const struct replaced *before;
    struct node node;
};

void parameters_evaluate(struct deck *deck);

void repeat_all(struct deck *deck);
/* $(N) of parameters in texts that no repeat: has copied. */
void repeat_rest(struct deck *deck);

/* Who asks for a name: filled by the caller, then read for why it was not found. */
struct lookup {
    struct deck *deck;
    const struct scope *scope;
    const struct expr_names *more; /* NULL: none */
    int pending;                   /* a parameter that has no value yet; -1: none */
    bool broken;                   /* a parameter or signal whose error has been reported */
    const struct expr_names *own;  /* of the names in signals: as here, with no scope; NULL: signals are not read */
};
int lookup_find(void *self, int *slot, double *value, const char *name, struct expr_error *error);

enum evaluated { EVALUATED, REPORTED, PENDING };
enum evaluated evaluate(double *out, const struct node *n, struct lookup *lookup);

/* One parameter. */
enum parameter_state { WAITING, BUSY, KNOWN, BROKEN };
struct parameter {
    const char *name;
    struct node *node;
    enum parameter_state state;
    double value;
    bool used; /* something asked for it */
};

/* May a parameter or loop variable be called so?  Tells at n. */
bool variable_name(const char *name, const struct node *n, const char *code, struct diags *diags);

/* belongs.c: tells of a key that a map of `keys` does not know where it belongs: into one of its words [n], or beside it.  False: nowhere,
 * or in too many places. */
bool suggest_section(const char *key, const char *const *words, int n, const struct key *keys, struct reader *rd);

/* A number as text that reads back to the same double, fit for YAML 1.1 readers as well. */
const char *number_text(char out[40], double x);

#endif
