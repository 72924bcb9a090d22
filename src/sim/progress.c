/* progress.c -- one line on a terminal: where the run is, when it will end */
#include "sim/parts.h"

enum { FIRST_AFTER = 1 };         /* [s] short runs stay silent */
static const double often = 0.25; /* [s] */

void progress_open(struct progress *p, FILE *to, double now, double t)
{
    *p = (struct progress){.to = to, .start = now, .shown = now, .from = t, .read = now};
}

void progress_show(struct progress *p, double now, double t, double until)
{
    if (!p->to || now - p->start < FIRST_AFTER || now - p->shown < often) return;
    double done = (t - p->from) / (until - p->from), left = done > 0 ? (now - p->start) * (1 - done) / done : 0;
    p->shown = now;
    p->wrote = true;
    fprintf(p->to, "\rt = %.4g of %.4g s, %3.0f %%, %.0f s to go   ", t, until, 100 * done, left);
    fflush(p->to);
}

void progress_close(struct progress *p)
{
    if (p->wrote) fprintf(p->to, "\r%60s\r", "");
}
