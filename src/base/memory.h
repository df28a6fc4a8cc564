/* Memory: how it is asked for, and what is said where it lacks.
 *
 * It may lack deep inside, where there is no way to say so (a residual of GSL's solvers, a warning, a JSON document
 * that leaves out what it has no room for), or where somebody makes do without what failed, a theory or its curves. It
 * is noted for the thread, and whoever began asks at the end: what was made in between is not the answer then, which is
 * not to depend on how much memory there was. Begins and ends nest; what an inner one finds, the outer one finds, too.
 */
#ifndef GG_COMMON_MEMORY_H
#define GG_COMMON_MEMORY_H

#include <stdbool.h>
#include <stdio.h>

#include "base/error.h"

/* calloc with an overflow check; NULL only with the message already written. */
void *gg_base_array_new(size_t count, size_t size, gg_error *err);

/* "out of memory", noted: GG_FAILED. */
gg_status gg_base_out_of_memory(gg_error *err);
/* "out of memory for " and what it was for. */
gg_status gg_base_out_of_memory_for(gg_error *err, const char *format, ...) GG_PRINTF(2, 3);

bool gg_base_memory_begin(void);
/* True: memory lacked since. `before` is what gg_base_memory_begin returned. */
bool gg_base_memory_end(bool before);
/* Note it where there is nothing to be said. */
void gg_base_memory_lacked(void);
/* The end of a call: its status, or GG_FAILED if it was GG_OK and memory lacked. */
gg_status gg_base_memory_check(bool before, gg_status status, gg_error *err);

/* Could some megabytes be had? Asked before libraries are called that do not look at what they get: FFTW ends the
 * program where its planner gets no memory, HDF5 where it lacks it in the midst of a file. */
bool gg_base_memory_is_room(void);

#endif
