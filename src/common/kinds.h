/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choices that the model and the scene share. */
#ifndef GG_KINDS_H
#define GG_KINDS_H

#include <stdbool.h>

/* The engines, in the order in which results show them: X(KIND, name, title). A new engine is a row here, a folder, and
 * its gg_<name>_ops (common/engine.h). Code that treats one engine in a way of its own names its kind and says why. */
#define GG_ENGINES(X)                                                                                                  \
  X(MD, md, "event-driven molecular dynamics")                                                                         \
  X(DSMC, dsmc, "Enskog Monte Carlo")
#define GG_ENGINE_KIND(KIND, name, title) GG_##KIND,
typedef enum gg_engine_kind { GG_ENGINES(GG_ENGINE_KIND) GG_N_ENGINES } gg_engine_kind;
#undef GG_ENGINE_KIND

typedef enum gg_precision { GG_DOUBLE, GG_SINGLE } gg_precision;
/* The flow that peculiar velocities are relative to, in flows without walls: the imposed flow, or means of cells or of
 * slabs across y (after or before the imposed flow is subtracted). */
typedef enum gg_frame_kind {
  GG_FRAME_IMPOSED,
  GG_FRAME_CELLS,
  GG_FRAME_CELLS_LABORATORY,
  GG_FRAME_SLABS,
  GG_FRAME_SLABS_LABORATORY
} gg_frame_kind;

static inline bool gg_frame_has_slabs(gg_frame_kind frame)
{
  return frame == GG_FRAME_SLABS || frame == GG_FRAME_SLABS_LABORATORY;
}
static inline bool gg_frame_is_laboratory(gg_frame_kind frame)
{
  return frame == GG_FRAME_CELLS_LABORATORY || frame == GG_FRAME_SLABS_LABORATORY;
}

enum { GG_LOCAL_DENSITIES = 8 }; /* at most, of local_distributions */

typedef enum gg_contact_value {
  GG_CARNAHAN_STARLING,
  GG_LUN_SAVAGE,
  GG_KOLAFA,
  GG_VESCOVI,
  GG_CHIALVO_SUNDARESAN
} gg_contact_value;

#define GG_AUTO (-1.0) /* a number that the program is to choose */

#endif
