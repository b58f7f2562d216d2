/* clock.h - the time that has passed. */
#ifndef BASE_CLOCK_H
#define BASE_CLOCK_H

/* Seconds of CPU time of this process / of wall time, from an arbitrary
 * start. */
double clock_cpu(void);
double clock_wall(void);

#endif
