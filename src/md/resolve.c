/* The instances of what a contact does, and which of them a scene needs. */
#include <assert.h>

#include "md/resolve.h"

#define COLLISION(rule, mixture, contact_time, sums, gaussian)                                                         \
  static void rule##_##mixture##contact_time##sums##gaussian(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)  \
  {                                                                                                                    \
    gg_md_resolve_pair(e, (gg_md_resolve_features){rule, mixture, contact_time, sums, gaussian, false, false}, i, j,   \
                       dr, c12);                                                                                       \
  }
#define FOUR(rule, mixture, contact_time)                                                                              \
  COLLISION(rule, mixture, contact_time, 0, 0)                                                                         \
  COLLISION(rule, mixture, contact_time, 0, 1)                                                                         \
  COLLISION(rule, mixture, contact_time, 1, 0)                                                                         \
  COLLISION(rule, mixture, contact_time, 1, 1)
#define SURFACE(rule, contact_time, sums)                                                                              \
  static void rule##_surface##contact_time##sums(gg_md *e, uint32_t i, int w)                                          \
  {                                                                                                                    \
    gg_md_resolve_surface(e, (gg_md_resolve_features){rule, true, contact_time, sums, false, false, false}, i, w);     \
  }                                                                                                                    \
  static void rule##_spinning##contact_time##sums(gg_md *e, uint32_t i, int w)                                         \
  {                                                                                                                    \
    gg_md_resolve_surface(                                                                                             \
        e, (gg_md_resolve_features){rule, true, contact_time, sums, false, rule != GG_SMOOTH, false}, i, w);           \
  }
#define INSTANCES(rule)                                                                                                \
  FOUR(rule, 0, 0)                                                                                                     \
  FOUR(rule, 0, 1)                                                                                                     \
  FOUR(rule, 1, 0) FOUR(rule, 1, 1) SURFACE(rule, 0, 0) SURFACE(rule, 0, 1) SURFACE(rule, 1, 0) SURFACE(rule, 1, 1)
INSTANCES(GG_SMOOTH)
INSTANCES(GG_ROUGH)
INSTANCES(GG_FRICTIONAL)

/* With a law of restitution, one for each rule: the law costs more than the tests of what else there is. */
#define BY_LAW(rule)                                                                                                   \
  static void rule##_by_law(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)                                   \
  {                                                                                                                    \
    gg_md_resolve_features f = {rule,       true, e->last != NULL, e->k.keeps_sums, e->thermostat == GG_GAUSSIAN,      \
                                .law = true};                                                                          \
    gg_md_resolve_pair(e, f, i, j, dr, c12);                                                                           \
  }
BY_LAW(GG_SMOOTH)
BY_LAW(GG_ROUGH)
BY_LAW(GG_FRICTIONAL)
static gg_md_resolution *const resolutions_by_law[] = {GG_SMOOTH_by_law, GG_ROUGH_by_law, GG_FRICTIONAL_by_law};

/* By rule, mixture, contact time, sums, Gaussian thermostat. */
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
static gg_md_resolution *const resolutions[3][2][2][2][2] = {ROW(GG_SMOOTH), ROW(GG_ROUGH), ROW(GG_FRICTIONAL)};
#undef ROW
#define ROW(rule) PAIR(rule##_surface)
static gg_md_surface_resolution *const surface_resolutions[3][2][2] = {ROW(GG_SMOOTH), ROW(GG_ROUGH),
                                                                       ROW(GG_FRICTIONAL)};
#undef ROW
#define ROW(rule) PAIR(rule##_spinning)
static gg_md_surface_resolution *const spinning_resolutions[3][2][2] = {ROW(GG_SMOOTH), ROW(GG_ROUGH),
                                                                        ROW(GG_FRICTIONAL)};

void gg_md_select_resolution(gg_md *e)
{
  bool mixture = e->model.n_species > 1, timed = e->last != NULL, sums = e->k.keeps_sums;
  gg_rule rule = e->model.rule;
  assert((rule != GG_SMOOTH) == (e->spin != NULL));
  e->resolve = e->model.law.name ? resolutions_by_law[rule]
                                 : resolutions[rule][mixture][timed][sums][e->thermostat == GG_GAUSSIAN];
  e->resolve_parted = e->resolve;
  if (gg_md_needs_parting(&e->model)) e->resolve = gg_md_resolve_parting;
  e->resolve_shown = e->resolve;
  if (e->callback) e->resolve = gg_md_show_collision;
  e->resolve_surface =
      e->spin ? spinning_resolutions[rule][timed][sums] : surface_resolutions[e->model.wall_rule][timed][sums];
}
