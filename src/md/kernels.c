/* The instances of the event loop and of the contact, and which of them a scene needs. */
#include <assert.h>

#include "md/impact.h"
#include "md/loop.h"

#define MOTION(name, sheared, mixture)                                                                                 \
  static void name(gg_md *e)                                                                                           \
  {                                                                                                                    \
    gg_loop(e, (gg_features){sheared, mixture});                                                                       \
  }
MOTION(periodic, false, false)
MOTION(periodic_mixture, false, true)
MOTION(sheared, true, false)
MOTION(sheared_mixture, true, true)

static gg_motion *const motions[2][2] = {{periodic, periodic_mixture}, {sheared, sheared_mixture}};

#define IMPACT(rule, mixture, contact_time, tap)                                                                       \
  static void rule##_##mixture##contact_time##tap(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)             \
  {                                                                                                                    \
    gg_impact_pair(e, (gg_impact_features){rule, mixture, contact_time, tap}, i, j, dr, c12);                          \
  }
#define IMPACTS(rule)                                                                                                  \
  IMPACT(rule, 0, 0, 0)                                                                                                \
  IMPACT(rule, 0, 0, 1)                                                                                                \
  IMPACT(rule, 0, 1, 0)                                                                                                \
  IMPACT(rule, 0, 1, 1)                                                                                                \
  IMPACT(rule, 1, 0, 0)                                                                                                \
  IMPACT(rule, 1, 0, 1)                                                                                                \
  IMPACT(rule, 1, 1, 0)                                                                                                \
  IMPACT(rule, 1, 1, 1)
IMPACTS(GG_SMOOTH)
IMPACTS(GG_ROUGH)
IMPACTS(GG_FRICTIONAL)

/* By mixture, contact time, tap. */
#define ROW(rule)                                                                                                      \
  {                                                                                                                    \
    {{rule##_000, rule##_001}, {rule##_010, rule##_011}},                                                              \
    {                                                                                                                  \
      {rule##_100, rule##_101},                                                                                        \
      {                                                                                                                \
        rule##_110, rule##_111                                                                                         \
      }                                                                                                                \
    }                                                                                                                  \
  }
static gg_impact *const impacts[3][2][2][2] = {ROW(GG_SMOOTH), ROW(GG_ROUGH), ROW(GG_FRICTIONAL)};

void gg_md_select(gg_md *e)
{
  bool mixture = e->model.n_species > 1, timed = e->last != NULL, tap = e->k.tap_open;
  assert((e->model.rule != GG_SMOOTH) == (e->spin != NULL));
  e->motion = motions[e->model.shear_rate != 0][mixture];
  e->impact = impacts[e->model.rule][mixture][timed][tap];
}

void gg_md_predict_all(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) {
    e->node[i].time = INFINITY;
    gg_queue_insert(&e->queue, e->node, i);
  }
  gg_features f = {e->model.shear_rate != 0, e->model.n_species > 1};
  for (uint32_t i = 0; i < e->n; i++) gg_predict(e, f, i);
}
