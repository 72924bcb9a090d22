/* explain.c -- fmdsub explain CODE: the cure for an error */
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

enum status verb_explain(const struct request *request, struct arena *life, struct report *report)
{
    (void)life;
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
