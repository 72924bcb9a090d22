/* fourth.h -- steps of two rates of order 4 (engine/composed.h), from what is known of how quick things move (quick.h). */
#ifndef FMDSUB_STUDY_FOURTH_H
#define FMDSUB_STUDY_FOURTH_H

#include "study/outcome.h"

/* By what a second of the run is off, over h^4 and H^4. */
struct fourth {
    double off[2];
    double span, every; /* [s] of the run; between records, 0: any */
};

/* As a short run by dopri5 of the deck sees it, with the deck's fast coordinates; false: it sees nothing. */
bool fourth_look(struct fourth *o, const struct scene *scene, struct diags *diags);

/* Steps that records are ends of, so that the run is off by `tolerance`; false: two rates are not worth while. */
bool fourth_setting(struct setting *setting, const struct fourth *o, double tolerance);

#endif
