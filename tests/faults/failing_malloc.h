/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The allocations of a whole process, libraries included, of which one can be made to fail: linked into a test, or put
 * before the C library (LD_PRELOAD; glibc only), where the environment says what fails:
 *
 * MALLOC_FAIL_AT    which allocation, from 1 on; 0: none, they are counted
 * MALLOC_FAIL_LAST  with anything: all later ones, too
 * MALLOC_FAIL_IN    only those that a library whose name holds this word asks for
 * MALLOC_REPORT     a file for "allocations failures", and where the first failure was */
#ifndef GG_FAILING_MALLOC_H
#define GG_FAILING_MALLOC_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* From now on allocations count; `in` as above, or NULL. */
void failing_malloc_arm(uint64_t at, int last, const char *in);
/* All allocations fail from the one on at which `begun` is true; before it none counts. */
void failing_malloc_arm_from(bool (*begun)(void));
/* No longer. How many there were, and of these how many failed. */
uint64_t failing_malloc_disarm(uint64_t *faults);
/* Where the first one failed: library+offset(name) ..., from the innermost call on. */
void failing_malloc_where(FILE *to);
/* Was the first failure one inside a library or function whose name holds this word? */
int failing_malloc_was_in(const char *library);
/* How many blocks made while armed are still there, told of to `to` (NULL: not). Those of HDF5 and FFTW, which keep
 * some for the next time, are counted apart. */
size_t failing_malloc_left(FILE *to, size_t *cached);

/* A build that counts what was run (scripts/coverage) writes its counts at exit; before _exit they have to be kept. */
#ifdef COUNTS_LINES
extern void __gcov_dump(void);
#define failing_malloc_keep_counts() __gcov_dump()
#else
#define failing_malloc_keep_counts() (void)0
#endif

#endif
