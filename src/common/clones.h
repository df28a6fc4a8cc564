/* Functions compiled for wider registers, too: the one for this processor is chosen when the program starts. For plain
 * loops whose result does not depend on how many numbers a register holds; static ones, for
 * the choice itself would be seen from outside. */
#ifndef GG_CLONES_H
#define GG_CLONES_H

#if defined(GG_X86_64) && (!defined(__clang__) || __clang_major__ >= 14)
#define GG_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GG_CLONES
#endif

#endif
