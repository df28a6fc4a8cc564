/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "simd/dispatch.h"

#include "simd/levels.h"

#define COMPILED(set, name) [set] = true,
static const bool is_compiled[GG_INSTRUCTION_SETS] = {GG_EACH_COMPILED_SET(COMPILED)};

bool gg_simd_instructions_run_here(gg_instructions set)
{
  if (!is_compiled[set]) return false;
  return set == GG_BASELINE || (set == GG_AVX2 && gg_has_avx2()) || (set == GG_AVX512 && gg_has_avx512());
}

gg_instructions gg_simd_instructions_best(void)
{
  for (gg_instructions set = GG_INSTRUCTION_SETS; set-- > 0;)
    if (gg_simd_instructions_run_here(set)) return set;
  return GG_INSTRUCTION_SETS;
}

gg_status gg_simd_instructions_check(gg_error *err)
{
  if (gg_simd_instructions_best() != GG_INSTRUCTION_SETS) return GG_OK;
  return gg_base_fail(err, GG_FAILED,
                      "this build of graingas is for another processor: build it here, or with -Dinstructions=all");
}

const char *gg_simd_instructions_name(gg_instructions set)
{
  static const char *const names[] = {"baseline", "AVX2", "AVX-512"};
  return set < GG_INSTRUCTION_SETS ? names[set] : "none";
}
