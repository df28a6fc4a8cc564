/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GG_CLONES: a function that is also compiled for wider registers; the loader chooses one when the program starts (ELF
 * with the GNU C library). For plain loops whose result does not depend on the width of registers. Such functions must
 * be static, since the symbol of the choice would be exported. */
#ifndef GG_SIMD_CLONES_H
#define GG_SIMD_CLONES_H

#include <stdlib.h> /* defines __GLIBC__ */

/* The loader chooses before the address and thread sanitizers are ready for instrumented functions. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GG_SANITIZED 1
#elif defined(__has_feature)
#define GG_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define GG_SANITIZED 0
#endif

#if !GG_SANITIZED && defined(GG_X86_64) && defined(__GLIBC__) && (!defined(__clang__) || __clang_major__ >= 14)
#define GG_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
/* For functions with code of their own for registers of 512 bits: GG_NARROW_CLONES marks the code for narrower
 * registers, GG_WIDE_TARGET that for 512 bits. Without a choice by the loader GG_WIDE_TARGET is undefined. */
#define GG_NARROW_CLONES __attribute__((target_clones("avx2", "default")))
#define GG_WIDE_TARGET __attribute__((target("avx512f")))
#else
#define GG_CLONES
#define GG_NARROW_CLONES
#endif

#endif
