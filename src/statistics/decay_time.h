/* How long a slow mode remembers, from windows that are not much longer than that. An integral of its correlation
 * function needs a window of 50 correlation times, comes out half as long from ten, and calls short windows long
 * enough; when the function has fallen by a factor e is known better. */
#ifndef GG_DECAY_TIME_H
#define GG_DECAY_TIME_H

#include <stddef.h>

/* In rows, of n_runs stretches of n rows end to end, each a mode with white noise on top: the lag over which the
 * correlation falls by a factor e from that at lag 1, allowing for the mean being that of the rows themselves. 1/2
 * where neighbours are not correlated; n where it never falls so far. */
double gg_statistics_decay_time(const double *y, size_t n, size_t n_runs);

#endif
