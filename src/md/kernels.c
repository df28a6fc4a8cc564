/* The instances of the event loop and of the contacts, and which of them a scene needs. */
#include <assert.h>

#include "md/impact.h"
#include "md/kernels.h"
#include "md/loop.h"

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
MOTIONS(periodic, .sheared = false)
MOTIONS(sheared, .sheared = true)
MOTIONS(drifting, .sheared = true, .drifts = true)
MOTIONS(walled, .walled = true)
MOTIONS(falling, .walled = true, .gravity = true)

#define ROW(name)                                                                                                      \
  {                                                                                                                    \
    {run_##name, all_##name},                                                                                          \
    {                                                                                                                  \
      run_##name##_mixture, all_##name##_mixture                                                                       \
    }                                                                                                                  \
  }
static const gg_kernel plain[][2] = {
    [GG_PERIODIC] = ROW(periodic), [GG_SHEARED] = ROW(sheared), [GG_WALLED] = ROW(walled), [GG_FALLING] = ROW(falling)};
static const gg_kernel plain_drifting[] = ROW(drifting);
#undef ROW

#define IMPACT(rule, mixture, contact_time, tap, gaussian)                                                             \
  static void rule##_##mixture##contact_time##tap##gaussian(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)   \
  {                                                                                                                    \
    gg_impact_pair(e, (gg_impact_features){rule, mixture, contact_time, tap, gaussian, false}, i, j, dr, c12);         \
  }
#define FOUR(rule, mixture, contact_time)                                                                              \
  IMPACT(rule, mixture, contact_time, 0, 0)                                                                            \
  IMPACT(rule, mixture, contact_time, 0, 1)                                                                            \
  IMPACT(rule, mixture, contact_time, 1, 0)                                                                            \
  IMPACT(rule, mixture, contact_time, 1, 1)
#define WALL(rule, contact_time, tap)                                                                                  \
  static void rule##_wall##contact_time##tap(gg_md *e, uint32_t i, int upper)                                          \
  {                                                                                                                    \
    gg_impact_wall(e, (gg_impact_features){rule, true, contact_time, tap, false, false}, i, upper);                    \
  }                                                                                                                    \
  static void rule##_spinning##contact_time##tap(gg_md *e, uint32_t i, int upper)                                      \
  {                                                                                                                    \
    gg_impact_wall(e, (gg_impact_features){rule, true, contact_time, tap, false, rule != GG_SMOOTH}, i, upper);        \
  }
#define INSTANCES(rule)                                                                                                \
  FOUR(rule, 0, 0)                                                                                                     \
  FOUR(rule, 0, 1) FOUR(rule, 1, 0) FOUR(rule, 1, 1) WALL(rule, 0, 0) WALL(rule, 0, 1) WALL(rule, 1, 0) WALL(rule, 1, 1)
INSTANCES(GG_SMOOTH)
INSTANCES(GG_ROUGH)
INSTANCES(GG_FRICTIONAL)

/* By rule, mixture, contact time, tap, Gaussian thermostat. */
#define PAIR(x)                                                                                                        \
  {                                                                                                                    \
    {x##00, x##01},                                                                                                    \
    {                                                                                                                  \
      x##10, x##11                                                                                                     \
    }                                                                                                                  \
  }
#define ROW(rule)                                                                                                      \
  {                                                                                                                    \
    {PAIR(rule##_00), PAIR(rule##_01)},                                                                                \
    {                                                                                                                  \
      PAIR(rule##_10), PAIR(rule##_11)                                                                                 \
    }                                                                                                                  \
  }
static gg_impact *const impacts[3][2][2][2][2] = {ROW(GG_SMOOTH), ROW(GG_ROUGH), ROW(GG_FRICTIONAL)};
#undef ROW
#define ROW(rule) PAIR(rule##_wall)
static gg_wall_impact *const wall_impacts[3][2][2] = {ROW(GG_SMOOTH), ROW(GG_ROUGH), ROW(GG_FRICTIONAL)};
#undef ROW
#define ROW(rule) PAIR(rule##_spinning)
static gg_wall_impact *const spinning_impacts[3][2][2] = {ROW(GG_SMOOTH), ROW(GG_ROUGH), ROW(GG_FRICTIONAL)};

static enum gg_boundary boundary_of(const gg_md *e)
{
  if (e->model.shear_rate != 0) return GG_SHEARED;
  if (e->falls) return GG_FALLING;
  return e->model.walled ? GG_WALLED : GG_PERIODIC;
}

/* The nearest image of all that the cells around hold, at rest, must be the one looked at. */
static bool is_wide_enough(const gg_md *e)
{
  return e->model.shear_rate == 0 && e->cells.n[0] >= 4 && e->cells.n[1] >= 4 && e->cells.n[2] >= 4;
}

gg_kernel gg_md_wide(gg_instructions set, enum gg_boundary boundary, bool mixture, enum gg_search_in where)
{
#ifdef GG_HAVE_AVX512
  if (set == GG_AVX512) return gg_md_wide_avx512(boundary, mixture, where);
#endif
#ifdef GG_HAVE_AVX2
  if (set == GG_AVX2) return gg_md_wide_avx2(boundary, mixture, where);
#endif
#ifdef GG_HAVE_BASELINE
  if (set == GG_BASELINE) return gg_md_wide_baseline(boundary, mixture, where);
#endif
  return (gg_kernel){NULL, NULL};
}

void gg_md_select(gg_md *e)
{
  bool mixture = e->model.n_species > 1, timed = e->last != NULL, tap = e->k.tap_open;
  enum gg_search_in where = e->shell ? GG_LISTS : e->shared ? GG_SHARED_CELLS : e->row ? GG_DRIFTING_CELLS : GG_CELLS;
  gg_rule rule = e->model.rule;
  assert((rule != GG_SMOOTH) == (e->spin != NULL));
  enum gg_boundary boundary = boundary_of(e);
  gg_kernel kernel = e->row ? plain_drifting[mixture] : plain[boundary][mixture];
  bool lined = where == GG_LISTS || where == GG_SHARED_CELLS;
  if (lined || (!e->plain && (e->row || is_wide_enough(e))))
    kernel = gg_md_wide(gg_instructions_best(), boundary, mixture, where);
  e->motion = kernel.run;
  e->predict_all = kernel.predict_all;
  e->impact = impacts[rule][mixture][timed][tap][e->thermostat == GG_GAUSSIAN];
  e->watched = e->impact;
  if (e->watch) e->impact = gg_md_show_impact;
  e->wall_impact = e->spin ? spinning_impacts[rule][timed][tap] : wall_impacts[e->model.wall_rule][timed][tap];
}
