/* explain.c -- fmdsub explain CODE: the cure for an error; of a deck: explain_deck.c */
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"

enum { MOST_CODES = 200 };

static enum status unknown(const char *word, struct report *report)
{
    const char *codes[MOST_CODES];
    int n = 0;
    for (const struct diag_help *h = diag_helps; h->code && n < MOST_CODES; h++) codes[n++] = h->code;
    const char *nearest = text_nearest(word, codes, n);
    if (nearest) return fail(report, E_USAGE, "no code '%.40s': did you mean '%s'?", word, nearest);
    return fail(report, E_USAGE, "no code '%.40s' (`fmdsub explain` lists them)", word);
}

/* A code has neither; standard input is a deck. */
static bool is_deck(const char *word)
{
    static const char *const ends[] = {".yaml", ".yml", ".json"};
    if (strcmp(word, "-") == 0 || strchr(word, '/')) return true;
    for (int i = 0; i < 3; i++) {
        const size_t len = strlen(word), end = strlen(ends[i]);
        if (len > end && strcmp(word + len - end, ends[i]) == 0) return true;
    }
    return false;
}

enum status verb_explain(const struct request *request, struct arena *life, struct report *report)
{
    for (int i = 0; i < request->nword; i++)
        if (is_deck(request->word[i])) return explain_deck(request, life, report);
    if (request->format || request->nset)
        return fail(report, E_USAGE, "--format, --set and --until are for 'fmdsub explain DECK', with a deck");
    if (request->nword == 0) {
        for (const struct diag_help *h = diag_helps; h->code; h++) printf("%-22s %s\n", h->code, h->cure);
        return OK;
    }
    for (int i = 0; i < request->nword; i++) {
        const char *cure = diag_cure(request->word[i]);
        if (!cure) return unknown(request->word[i], report);
        printf("%s: %s\n", request->word[i], cure);
    }
    return OK;
}
