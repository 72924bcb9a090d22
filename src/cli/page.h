/* page.h -- the parts of the manual that come from tables, as mdoc.
 *
 * A page holds each of them between two comment lines; man/refresh.sh writes them anew:
 *
 *     .\" from: fmdsub list page keys integrate
 *     .\" end */
#ifndef FMDSUB_CLI_PAGE_H
#define FMDSUB_CLI_PAGE_H

#include <stdio.h>

#include "base/keys.h"
#include "base/status.h"

/* What word [n] asks for: {"keys", PATH}, {"coordinates"}, {"functions"}, {"schemes"}, {"codes"}; E_USAGE: no such
 * part. */
enum status page_print(FILE *to, int n, char *const *word, struct report *report);

/* completion.c: word [n] is {SHELL}. */
enum status completion_print(FILE *to, int n, char *const *word, struct report *report);

/* What a key takes, in words: "number", "true or false"; of KEY_WORD and KEY_NODE what the table says. */
const char *page_type(const struct key *k);

#endif
