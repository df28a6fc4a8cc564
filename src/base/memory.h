/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory: allocation, and failed allocations.
 *
 * An allocation may fail where no error is returned (in a residual of GSL's solvers, a warning, a JSON document), or
 * where the caller continues without the part that failed (a theory, its curves). Such failures are counted per thread.
 * The outermost frames compare the count. If it grew, they return an error, since results must not depend on the
 * available memory. */
#ifndef GG_BASE_MEMORY_H
#define GG_BASE_MEMORY_H

#include <stdbool.h>
#include <stdio.h>

#include "base/error.h"

/* Declarations: at the end of its block a pointer from malloc (at first NULL) is freed, and a struct is cleared by a
 * function that takes its address. */
#define GG_FREED GG_CLEARED(gg_base_freed)
#define GG_CLOSED GG_CLEARED(gg_base_closed) /* of a FILE, which may be NULL */
#define GG_CLEARED(clear) __attribute__((cleanup(clear)))
void gg_base_freed(void *place);
void gg_base_closed(FILE **place);
/* Hand over to *to what is no longer freed here. */
#define GG_HAND_OVER(to, from) (*(to) = (from), (from) = NULL)

/* calloc with an overflow check; NULL only with the message already written. */
void *gg_base_array_new(size_t count, size_t size, gg_error *err);

/* "out of memory", counted: GG_FAILED. */
gg_status gg_base_out_of_memory(gg_error *err);
/* "out of memory for " and what it was for. */
gg_status gg_base_out_of_memory_for(gg_error *err, const char *format, ...) GG_PRINTF(2, 3);

/* Allocations of this thread that have failed so far. */
unsigned gg_base_memory_failures(void);
/* Count one where there is no error to return. */
void gg_base_memory_lacked(void);
/* The end of a call: its status, or GG_FAILED if it was GG_OK and an allocation failed since `before`. */
gg_status gg_base_memory_check(unsigned before, gg_status status, gg_error *err);

/* True if some megabytes are available. Checked before calls of libraries that do not check their allocations: FFTW
 * ends the program if its planner gets no memory, HDF5 if memory is short in the midst of a file. */
bool gg_base_memory_is_room(void);

/* How much memory is there for a run. */

/* Bytes that this process can still have: what the system has, what its control groups and its own limits leave.
 * INFINITY if unknown. */
double gg_base_memory_available(void);

/* GSL ends the program on errors, out of memory among them, unless its handler says otherwise. From the first thread
 * that enters until the last one leaves errors are returned, and lack of memory is noted (memory.h); then the
 * handler is again what the calling program has set. */

void gg_base_gsl_enter(void);
void gg_base_gsl_leave(void);

#endif
