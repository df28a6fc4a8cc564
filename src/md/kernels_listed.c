/* Compiled several times, for one instruction set each: GG_ISA names it. */
#include "md/kernels.h"
#include "md/loop.h"

#ifndef GG_ISA
#define GG_ISA any
#endif
#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)

#define MOTION(name, ...)                                                                                              \
  static void run_##name(gg_md *e)                                                                                     \
  {                                                                                                                    \
    gg_loop(e, (gg_features){.listed = true, __VA_ARGS__});                                                            \
  }                                                                                                                    \
  static void all_##name(gg_md *e)                                                                                     \
  {                                                                                                                    \
    gg_forecast_all(e, (gg_features){.listed = true, __VA_ARGS__});                                                    \
  }
MOTION(periodic, .sheared = false)
MOTION(periodic_mixture, .mixture = true)
MOTION(sheared, .sheared = true)
MOTION(sheared_mixture, .sheared = true, .mixture = true)

gg_kernel JOIN(gg_md_listed_, GG_ISA)(bool is_sheared, bool mixture)
{
  static const gg_kernel kernels[2][2] = {
      {{run_periodic, all_periodic}, {run_periodic_mixture, all_periodic_mixture}},
      {{run_sheared, all_sheared}, {run_sheared_mixture, all_sheared_mixture}},
  };
  return kernels[is_sheared][mixture];
}
