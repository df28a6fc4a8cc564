/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions compiled for wider registers, too: the one for this processor is chosen when the program starts. For plain
 * loops whose result does not depend on how many numbers a register holds; static ones, for
 * the choice itself would be seen from outside. Where the loader can choose (ELF with the GNU C library). */
#ifndef GG_SIMD_CLONES_H
#define GG_SIMD_CLONES_H

#include <stdlib.h> /* tells whose library it is */

/* The choice is made by the loader, before the address and thread sanitizers are ready for instrumented functions. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GG_SANITIZED 1
#elif defined(__has_feature)
#define GG_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define GG_SANITIZED 0
#endif

#if !GG_SANITIZED && defined(GG_X86_64) && defined(__GLIBC__) && (!defined(__clang__) || __clang_major__ >= 14)
#define GG_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GG_CLONES
#endif

#endif
