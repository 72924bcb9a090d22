/* deck.h -- one deck: text in, tree out.
 *
 *     read -> parse -> include: -> --set -> parameters: -> repeat: -> tree
 *
 * What is wrong with the text goes to diags, all of it, and work goes on where it can.  Numbers stay text until a
 * reader (read.h) asks for them. */
#ifndef FMDSUB_DECK_DECK_H
#define FMDSUB_DECK_DECK_H

#include <stdint.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/files.h"
#include "base/status.h"
#include "deck/diag.h"
#include "deck/node.h"
#include "deck/tree.h"
#include "expr/expr.h"

enum { DECK_BYTES = 1 << 24, INCLUDE_DEPTH = 16 };

struct deck_options {
    int nset;
    const char *const *set; /* "path=value" */
    const char *const
        *option;      /* [nset] the option that a setting came by, "--until"; NULL: --set, or all of them are */
    size_t max_bytes; /* of one file; 0: DECK_BYTES */
    const struct source *again; /* of path "-": standard input, read before; NULL: it has not been */
};

struct parameter;
struct replaced;

struct deck {
    struct arena *arena;
    struct diags *diags; /* with the sources */
    struct pool pool;
    struct node *root;  /* a map */
    const char *path;   /* as given; "<stdin>" */
    const char *name;   /* file name without .yaml: names the run */
    const char *folder; /* of files the deck names */
    struct files read;  /* the deck and all files that it names */
    uint64_t hash;      /* of all texts that made the deck: files, --set */
    uint64_t beside;    /* of the files that it names, but for included ones */
    size_t max_bytes;

    const struct replaced *replaced; /* by --set */

    int nparameter;
    struct parameter *parameter; /* by name */
    const char **parameter_name; /* [nparameter] */
    long copies;                 /* made by repeat: */
    struct arena *scratch;       /* for one expression at a time */
};

/* path "-": stdin.  OK: there is a tree, perhaps with errors in diags (diags_status tells); a caller may go on to
 * find more of them.  E_DECK, E_LIMIT: no tree, diags say why.  E_FILE, E_LIMIT with report filled: the file itself.
 * options may be NULL. */
enum status deck_load(struct deck **out, const char *path, const struct deck_options *options, struct diags *diags,
                      struct arena *arena, struct report *report);

/* A number, or an expression of parameters and loop variables.  E_DECK: reported, here or before. */
enum status deck_number(double *out, const struct node *n, struct deck *deck);

/* An expression of loop variables, parameters, signals, and names of the caller's, in this order.  E_DECK: reported.  Marks the node
 * as a formula. */
enum status deck_expr(struct expr **out, const struct node *n, const struct expr_names *names, struct deck *deck);

/* The same for a condition, "hub.angle > 1". */
enum status deck_truth(struct expr **out, const struct node *n, const struct expr_names *names, struct deck *deck);

/* Does it stand on the command line, as --set or what is short for it? */
bool deck_was_set(const struct deck *deck, const struct node *n);

/* A map that only the path of a --set made: its value stands in it. */
bool deck_was_made(const struct deck *deck, const struct node *n);

/* Of the root's members of these names [ends with NULL], or (but) of all others: the same for decks that say the same in
 * other words.  After they have been read. */
uint64_t deck_fingerprint(const struct deck *deck, const char *const *sections, bool but);

/* When all has been read: parameters of the deck's own text, or of --set, that nothing asked for. */
void deck_warn_unused(struct deck *deck);

/* The member of `signals` of this name; NULL: none.  deck_expr() and deck_truth() read the text of one where they meet its
 * name. */
const struct node *deck_signal(const struct deck *deck, const char *name);

/* The value of a parameter: 0 if there is one. */
int deck_parameter(double *out, const char *name, const struct deck *deck);

/* YAML that reads back to the same tree: parameters evaluated, repeat: and include: done, --set applied,
 * defaults of what was read filled in, numbers as they were read. */
void deck_print(FILE *to, const struct deck *deck);

/* Rows of numbers from a file beside the deck: x [rows x columns] by row. */
enum status deck_csv(double **x, int *rows, int columns, const struct node *file, struct deck *deck);

/* The map in a YAML file beside the deck, without include: or parameters: of its own; NULL: reported. */
const struct node *deck_yaml(const struct node *file, struct deck *deck);

/* The path of a file beside the deck, which joins the deck's hash; NULL: reported. */
const char *deck_file(const struct node *n, struct deck *deck);

#endif
