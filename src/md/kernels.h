/* The event loop's instances for neighbour lists, compiled once for every instruction set (kernels_listed.c) and chosen
 * when an engine is made. All of them give the same bits. */
#ifndef GG_MD_KERNELS_H
#define GG_MD_KERNELS_H

#include "md/state.h"

typedef struct gg_kernel {
  gg_motion *run;
  gg_forecast *predict_all;
} gg_kernel;

gg_kernel gg_md_listed_any(bool sheared, bool mixture);
gg_kernel gg_md_listed_avx2(bool sheared, bool mixture);
gg_kernel gg_md_listed_avx512(bool sheared, bool mixture);

/* The best that this processor runs. */
gg_kernel gg_md_wide_kernel(bool sheared, bool mixture);

#endif
