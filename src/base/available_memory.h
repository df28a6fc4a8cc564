/* How much memory is there for a run. */
#ifndef GG_MEMORY_H
#define GG_MEMORY_H

/* Bytes that this process can still have: what the system has, what its control groups and its own limits leave.
 * INFINITY where nothing tells. */
double gg_base_memory_available(void);

#endif
