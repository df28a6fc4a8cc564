/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instruction levels of this processor, as kernels are compiled for them: x86-64-v3 (AVX2) and x86-64-v4 (AVX-512). The
 * compiler may use all instructions of a level; no processor has the tested ones without the rest of the level. */
#ifndef GG_SIMD_LEVELS_H
#define GG_SIMD_LEVELS_H

#include <stdbool.h>

static inline bool gg_has_avx2(void)
{
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

static inline bool gg_has_avx512(void)
{
#if defined(__x86_64__)
  return gg_has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
#else
  return false;
#endif
}

#endif
