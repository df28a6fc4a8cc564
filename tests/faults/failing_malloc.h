/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Count all allocations of a process, libraries included, and let one fail. Linked into a test, or loaded before the C
 * library (LD_PRELOAD; glibc only). Then environment variables select the failure:
 *
 * MALLOC_FAIL_AT    number of the allocation, from 1 on; 0: none fails
 * MALLOC_FAIL_LAST  if set, all later allocations fail, too
 * MALLOC_FAIL_IN    count only allocations by a library whose name contains this word
 * MALLOC_REPORT     file to which "allocations failures" and the call stack of the first failure are written */
#ifndef GG_FAILING_MALLOC_H
#define GG_FAILING_MALLOC_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Start to count. at, last, in: as the variables above; in: may be NULL. */
void failing_malloc_arm(uint64_t at, int last, const char *in);
/* Let all allocations fail from the first at which `begun` returns true; earlier ones are not counted. */
void failing_malloc_arm_from(bool (*begun)(void));
/* Stop. Returns the number of allocations; *faults: the number that failed. */
uint64_t failing_malloc_disarm(uint64_t *faults);
/* Print the call stack of the first failure: library+offset(name) ..., innermost call first. */
void failing_malloc_where(FILE *to);
/* True if the first failure was inside a library or function whose name contains this word. */
int failing_malloc_was_in(const char *library);
/* Number of blocks allocated while armed and not freed; they are listed on `to` (may be NULL). *cached: number of
 * blocks of HDF5 and FFTW, which keep some for later calls. */
size_t failing_malloc_left(FILE *to, size_t *cached);

/* A build for scripts/coverage writes its counts at exit. Call this before _exit, which skips that. */
#ifdef COUNTS_LINES
extern void __gcov_dump(void);
#define failing_malloc_keep_counts() __gcov_dump()
#else
#define failing_malloc_keep_counts() (void)0
#endif

#endif
