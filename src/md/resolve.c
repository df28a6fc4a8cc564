/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instances of the resolution of a contact, and the choice for a scene. */
#include <assert.h>

#include "md/resolution.h"
#include "md/resolve.h"

/* X for every rule, with and without contact-time rule; `one` and `two` are passed to X. */
#define EACH_CHOICE(X, rule, one, two) X(rule, 0, one, two) X(rule, 1, one, two)
#define EACH_RULE(X, one, two)                                                                                         \
  EACH_CHOICE(X, GG_SMOOTH, one, two) EACH_CHOICE(X, GG_ROUGH, one, two) EACH_CHOICE(X, GG_FRICTIONAL, one, two)
#define EACH_PAIR(X) EACH_RULE(X, 0, 0) EACH_RULE(X, 0, 1) EACH_RULE(X, 1, 0) EACH_RULE(X, 1, 1)
#define EACH_SURFACE(X) EACH_RULE(X, 0, 0) EACH_RULE(X, 1, 0)

#define PAIR(rule, timed, mixture, gaussian)                                                                           \
  static void pair_##rule##timed##mixture##gaussian(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)           \
  {                                                                                                                    \
    gg_md_resolve_pair(e, (gg_md_resolve_features){rule, mixture, timed, gaussian, false, false}, i, j, dr, c12);      \
  }
EACH_PAIR(PAIR)
#define PAIR_ENTRY(rule, timed, mixture, gaussian)                                                                     \
  [rule][timed][mixture][gaussian] = pair_##rule##timed##mixture##gaussian,
static gg_md_resolution *const resolutions[3][2][2][2] = {EACH_PAIR(PAIR_ENTRY)};

#define SURFACE(rule, timed, spins, none)                                                                              \
  static void surface_##rule##timed##spins(gg_md *e, uint32_t i, int surface)                                          \
  {                                                                                                                    \
    gg_md_resolve_features features = {rule, true, timed, false, spins && rule != GG_SMOOTH, false};                   \
    gg_md_resolve_surface(e, features, i, surface);                                                                    \
  }
EACH_SURFACE(SURFACE)
#define SURFACE_ENTRY(rule, timed, spins, none) [rule][timed][spins] = surface_##rule##timed##spins,
static gg_md_surface_resolution *const surface_resolutions[3][2][2] = {EACH_SURFACE(SURFACE_ENTRY)};

/* One instance for each rule with a law of restitution, kicks or torques, which cost more than testing the other
 * features. */
#define OWN(rule)                                                                                                      \
  static void rule##_own(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)                                      \
  {                                                                                                                    \
    gg_md_resolve_features f = {rule, true, e->last != NULL, e->heat == GG_HEAT_SCALES, .own = true};                  \
    gg_md_resolve_pair(e, f, i, j, dr, c12);                                                                           \
  }
OWN(GG_SMOOTH)
OWN(GG_ROUGH)
OWN(GG_FRICTIONAL)
static gg_md_resolution *const own_resolutions[] = {GG_SMOOTH_own, GG_ROUGH_own, GG_FRICTIONAL_own};

void gg_md_select_resolution(gg_md *e)
{
  bool mixture = e->model.n_species > 1, timed = e->last != NULL;
  gg_rule rule = e->model.rule;
  assert((rule != GG_SMOOTH) == (e->spin != NULL));
  e->resolve = gg_model_has_speed(&e->model) || e->model.turns
                   ? own_resolutions[rule]
                   : resolutions[rule][timed][mixture][e->heat == GG_HEAT_SCALES];
  e->resolve_parted = e->resolve;
  if (gg_md_needs_parting(&e->model)) e->resolve = gg_md_resolve_parting;
  e->resolve_shown = e->resolve;
  if (e->callback) e->resolve = gg_md_show_collision;
  const bool spins = e->spin != NULL;
  e->resolve_surface = surface_resolutions[spins ? rule : e->model.wall_rule][timed][spins];
  e->resolve_surface_shown = e->resolve_surface;
  if (e->callback) e->resolve_surface = gg_md_show_contact;
}
