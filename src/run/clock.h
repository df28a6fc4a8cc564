/* Clocks, in seconds: the wall's, and the calling thread's CPU time. */
#ifndef GG_CLOCK_H
#define GG_CLOCK_H

double gg_wall_now(void);
double gg_cpu_now(void);

#endif
