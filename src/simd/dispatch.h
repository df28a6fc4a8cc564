/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of a compiled set of instructions that runs on this processor. All sets leave the same bits. */
#ifndef GG_SIMD_DISPATCH_H
#define GG_SIMD_DISPATCH_H

#include <stdbool.h>

#include "base/error.h"
#include "simd/compiled_sets.h" /* GG_EACH_COMPILED_SET(X): X(GG_AVX2, avx2) for each set in this build */

typedef enum gg_instructions {
  GG_BASELINE, /* every processor of the family has it: SSE2, NEON */
  GG_AVX2,
  GG_AVX512,
  GG_INSTRUCTION_SETS
} gg_instructions;

/* True if this set is compiled (meson option `instructions`) and this processor has it. */
bool gg_simd_instructions_run_here(gg_instructions set);
/* The widest such set; GG_INSTRUCTION_SETS: none. */
gg_instructions gg_simd_instructions_best(void);
/* GG_FAILED, with a remedy, if there is no such set. */
gg_status gg_simd_instructions_check(gg_error *err);
const char *gg_simd_instructions_name(gg_instructions set); /* "AVX-512" */

#endif
