/* go_to.c -- --at: a run goes on to a time, for what looks at the system there */
#include <math.h>
#include <stdlib.h>

#include "cli/cli.h"
#include "sim/sim.h"

static const double MOST_MAJORS = 1e12;

enum status cli_go_to(struct sim *sim, const struct request *request, struct report *report)
{
    char *end;
    if (!request->at) return OK;
    double t = strtod(request->at, &end);
    if (end == request->at || *end || !(t >= 0) || !isfinite(t))
        return fail(report, E_USAGE, "--at takes a time, not '%.40s'", request->at);
    if (t == sim->x.t) return OK;
    if (t < sim->x.t) return fail(report, E_USAGE, "--at %.40s is before the start, t = %g s", request->at, sim->x.t);
    double majors = ceil((t - sim->origin.x) / (sim->plan.step * sim->plan.ratio) - 1e-9) - (double)sim->before;
    if (!(majors <= MOST_MAJORS))
        return fail(report, E_LIMIT, "--at %.40s is %.3g major steps away: the limit is %g", request->at, majors,
                    MOST_MAJORS);
    sim->plan.until = t;
    sim->majors = (long)fmax(1, majors);
    enum status status = sim_run(sim, NULL, report);
    return status == E_VERDICT ? OK : status;
}
