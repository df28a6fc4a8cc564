/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which compiled set of instructions runs here. All of them leave the same bits. */
#ifndef GG_SIMD_DISPATCH_H
#define GG_SIMD_DISPATCH_H

#include <stdbool.h>

#include "base/error.h"
#include "simd/compiled_sets.h" /* GG_EACH_COMPILED_SET(X): X(GG_AVX2, avx2) for each set in this build */

typedef enum gg_instructions {
  GG_BASELINE, /* what every processor of the family has: SSE2, NEON */
  GG_AVX2,
  GG_AVX512,
  GG_INSTRUCTION_SETS
} gg_instructions;

/* Compiled into this build (meson option `instructions`), and known to this processor? */
bool gg_simd_instructions_run_here(gg_instructions set);
/* The widest of those; GG_INSTRUCTION_SETS if there is none. */
gg_instructions gg_simd_instructions_best(void);
/* GG_FAILED, with what to do, if there is none. */
gg_status gg_simd_instructions_check(gg_error *err);
const char *gg_simd_instructions_name(gg_instructions set); /* "AVX-512" */

#endif
