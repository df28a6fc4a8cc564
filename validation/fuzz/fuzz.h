/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hostile input: each target is one function of some bytes, which must come back from it without an error of memory,
 * an overflow or a leak, whatever they are. Built with -Dfuzz=true libFuzzer drives it (docs/appendix/fuzzing.md
 * has the commands, `campaign` runs one, and goes on where it was left). Everywhere else replay.c gives it the kept
 * inputs (corpus/<target>, regressions/<target>) and seeded changes of them: tests of the suite `fuzz`. A finding is
 * mended in src, and its input is kept under regressions/<target>. */
#ifndef GG_FUZZ_H
#define GG_FUZZ_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
