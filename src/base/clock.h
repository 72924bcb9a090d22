/* clock.h -- time for people and for benches; never part of the data. */
#ifndef FMDSUB_BASE_CLOCK_H
#define FMDSUB_BASE_CLOCK_H

double clock_wall(void); /* monotonic [s] */
double clock_cpu(void);  /* of this process [s] */

#endif
