/* Compiled several times, for one instruction set each: GG_INSTRUCTIONS names it. */
#include "md/kernels.h"
#include "md/loop.h"

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)

#define MOTION(name, ...)                                                                                              \
  static void run_##name(gg_md *e)                                                                                     \
  {                                                                                                                    \
    gg_loop(e, (gg_features){__VA_ARGS__});                                                                            \
  }                                                                                                                    \
  static void all_##name(gg_md *e)                                                                                     \
  {                                                                                                                    \
    gg_forecast_all(e, (gg_features){__VA_ARGS__});                                                                    \
  }
#define MOTIONS(name, ...)                                                                                             \
  MOTION(name, __VA_ARGS__)                                                                                            \
  MOTION(name##_mixture, .mixture = true, __VA_ARGS__)
MOTIONS(periodic, .wide = true)
MOTIONS(drifting, .wide = true, .sheared = true, .drifts = true)
MOTIONS(walled, .wide = true, .walled = true)
MOTIONS(falling, .wide = true, .walled = true, .gravity = true)
MOTIONS(periodic_shared, .wide = true, .shared = true)
MOTIONS(sheared_shared, .wide = true, .shared = true, .sheared = true, .drifts = true)
MOTIONS(periodic_listed, .listed = true)
MOTIONS(sheared_listed, .listed = true, .sheared = true)

gg_kernel JOIN(gg_md_wide_, GG_INSTRUCTIONS)(enum gg_boundary boundary, bool mixture, enum gg_search_in where)
{
#define ROW(name)                                                                                                      \
  {                                                                                                                    \
    {run_##name, all_##name},                                                                                          \
    {                                                                                                                  \
      run_##name##_mixture, all_##name##_mixture                                                                       \
    }                                                                                                                  \
  }
  static const gg_kernel cells[][2] = {[GG_PERIODIC] = ROW(periodic),
                                       [GG_SHEARED] = ROW(drifting),
                                       [GG_WALLED] = ROW(walled),
                                       [GG_FALLING] = ROW(falling)};
  static const gg_kernel lists[][2] = {[GG_PERIODIC] = ROW(periodic_listed), [GG_SHEARED] = ROW(sheared_listed)};
  static const gg_kernel shared[][2] = {[GG_PERIODIC] = ROW(periodic_shared), [GG_SHEARED] = ROW(sheared_shared)};
  if (where == GG_SHARED_CELLS) return shared[boundary][mixture];
  return where == GG_LISTS ? lists[boundary][mixture] : cells[boundary][mixture];
}
