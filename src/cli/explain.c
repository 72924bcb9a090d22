/* explain.c -- fmdsub explain CODE: the cure for an error */
#include "cli/cli.h"

enum status verb_explain(const struct request *request, struct arena *life, struct report *report)
{
    (void)life;
    if (request->nword == 0) {
        for (const struct diag_help *h = diag_helps; h->code; h++) printf("%-22s %s\n", h->code, h->cure);
        return OK;
    }
    for (int i = 0; i < request->nword; i++) {
        const char *cure = diag_cure(request->word[i]);
        if (!cure)
            return fail(report, E_USAGE, "no error code '%.40s' (`fmdsub explain` lists them)", request->word[i]);
        printf("%s: %s\n", request->word[i], cure);
    }
    return OK;
}
