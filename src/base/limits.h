/* limits.h -- how much a process may take, told to the system, which counts everything. */
#ifndef FMDSUB_BASE_LIMITS_H
#define FMDSUB_BASE_LIMITS_H

#include <stdbool.h>

/* Memory in all [bytes]; a lower limit that is there stays.  false: the system does not take it. */
bool limit_memory(double bytes);
/* Three quarters of what the machine has, or the container: enough is left to end in good order. */
double limit_memory_default(void);

/* SIGALRM after so many seconds by the clock: `stop` is set, and what does not heed it within a tenth of that time and a
 * second more ends with a line on stderr and exit 7. */
bool limit_time(double seconds);

#endif
