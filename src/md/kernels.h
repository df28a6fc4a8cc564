/* The event loop's instances that predict eight pairs at a time, compiled once for every instruction set
 * (kernels_wide.c) and chosen when an engine is made. All of them give the same bits. */
#ifndef GG_MD_KERNELS_H
#define GG_MD_KERNELS_H

#include "md/state.h"
#include "simd/dispatch.h"

enum gg_boundary { GG_PERIODIC, GG_SHEARED, GG_WALLED, GG_FALLING };

typedef struct gg_kernel {
  gg_motion *run;
  gg_forecast *predict_all;
} gg_kernel;

gg_kernel gg_md_wide_baseline(enum gg_boundary boundary, bool mixture, enum gg_search_in where);
gg_kernel gg_md_wide_avx2(enum gg_boundary boundary, bool mixture, enum gg_search_in where);
gg_kernel gg_md_wide_avx512(enum gg_boundary boundary, bool mixture, enum gg_search_in where);

/* Those of a compiled set of instructions. */
gg_kernel gg_md_wide(gg_instructions set, enum gg_boundary boundary, bool mixture, enum gg_search_in where);

#endif
