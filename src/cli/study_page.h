/* study_page.h -- fmdsub study --report: a study as one page of HTML. */
#ifndef FMDSUB_CLI_STUDY_PAGE_H
#define FMDSUB_CLI_STUDY_PAGE_H

#include "out/stream.h"
#include "study/study.h"

struct study_page {
    const char *title, *name; /* of the deck */
    const char *deck;         /* its text */
    const char *command;      /* that made the page */
};

enum status study_page(const struct study *o, const struct study_page *page, struct stream *stream, struct arena *life,
                       struct report *report);

#endif
