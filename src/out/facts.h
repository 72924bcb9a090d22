/* facts.h -- what a run says of itself, as JSON.
 *
 * Built with cJSON; its numbers are put in as text from number_write, since its own printer loses
 * the last bit.  Texts that are not UTF-8 (a deck's file name may be anything) get U+FFFD for every
 * stray byte.  Every function returns NULL when memory ran out; cJSON_Delete takes NULL. */
#ifndef FMDSUB_OUT_FACTS_H
#define FMDSUB_OUT_FACTS_H

#include <cjson/cJSON.h>
#include <stdbool.h>

#include "base/arena.h"
#include "out/sink.h"

/* to[key] = item; takes the item in every case.  false: no memory. */
bool facts_add(cJSON *to, const char *key, cJSON *item);

cJSON *facts_text(const char *text, struct arena *scratch); /* NULL: null */
cJSON *facts_number(double x);                              /* not finite: null */
cJSON *facts_columns(const struct run_meta *meta);          /* array of names */

/* Members are added to `to`, an object; false: no memory. */
bool facts_meta(cJSON *to, const struct run_meta *meta, struct arena *scratch); /* all but the columns */
bool facts_pairs(cJSON *to, const struct pair *pairs, int n, struct arena *scratch);
bool facts_event(cJSON *to, double t, const char *kind, const char *text, struct arena *scratch);

/* `item` without blanks, between before and after, as one record on the stream; deletes it.  E_LIMIT
 * when item is NULL or there is no memory to print it. */
enum status facts_put(struct stream *stream, const char *before, cJSON *item, const char *after, struct report *report);

/* `item` on standard output, in a line or in many; deletes it.  E_LIMIT as there. */
enum status facts_print(cJSON *item, bool lines, struct report *report);

/* Sends what is whole and gives the stream up: E_LIMIT. */
enum status facts_no_memory(struct stream *stream, struct report *report);

#endif
