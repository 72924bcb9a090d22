/* syntax.h -- libyaml's marks and errors as ours: private to this folder. */
#ifndef FMDSUB_DECK_SYNTAX_H
#define FMDSUB_DECK_SYNTAX_H

#include <stdbool.h>

#include <yaml.h>

#include "deck/diag.h"

/* A text that is being parsed. */
struct syntax {
    struct diags *diags;
    struct arena *arena;
    const struct source *source;
    int file;
    int shift; /* characters before the document in its first line */
};

struct span syntax_span(const struct syntax *b, yaml_mark_t from, yaml_mark_t to);

/* `key:value` without the space, which YAML takes for one text. */
/* `key:{` or `key:[`: the beginning of a text, for YAML. */
bool syntax_opens(const char *text);
bool syntax_lacks_space(const char *text, size_t len);

/* Tells the error that p stopped at.  Out of memory ends the program. */
void syntax_report(const struct syntax *b, const yaml_parser_t *p);

#endif
