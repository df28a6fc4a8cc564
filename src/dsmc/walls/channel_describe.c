/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models that run between walls, and the description of the methods for a model. */
#include <math.h>
#include <stdio.h>

#include "common/surface/shapes.h"
#include "dsmc/dsmc.h"
#include "dsmc/walls/channel.h"

gg_status gg_dsmc_channel_accepts(const gg_model *m, gg_error *err)
{
  const double widest = m->boltzmann ? 0 : gg_common_model_widest(m);
  if (!gg_flow_runs_in(m->flow, GG_DSMC))
    return gg_base_fail(err, GG_BAD_INPUT, "flow: %s needs engine: md", gg_flow_of(m->flow)->word);
  for (int w = 0; w < m->n_surfaces; w++)
    if (m->surface[w].shape != GG_SHAPE_plane || m->surface[w].axis != 1)
      return gg_base_fail(err, GG_BAD_INPUT, "walls.ridges: needs engine: md; Monte Carlo is uniform along the walls");
  if (gg_common_surface_is_open_above(m) && m->gravity[1] >= 0)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "walls.top: open needs gravity towards the lower wall: gravity: [gx, gy < 0, gz]");
  if (m->thermostat != GG_NO_THERMOSTAT && !gg_flow_takes(m->flow, m->thermostat))
    return gg_base_fail(err, GG_BAD_INPUT, "thermostat: not in flow: %s", gg_flow_of(m->flow)->word);
  if (m->wave > 0 && (gg_model_is_sheared(m) || m->rule != GG_SMOOTH))
    return gg_base_fail(err, GG_BAD_INPUT, "start.wave: with engine: dsmc needs smooth grains and no imposed shear");
  if (m->box[1] < 2 * widest)
    return gg_base_fail(
        err, GG_BAD_INPUT,
        "particles: as in md they make the gap, which is %.3g diameters wide; at least %.3g are needed, "
        "two of the widest grain: give particles or aspect's second number a larger value",
        m->box[1], 2 * widest);
  if (m->n < 2 || m->n > UINT32_MAX / 2)
    return gg_base_fail(err, GG_BAD_INPUT, "dsmc.particles: %lld; allowed: 2 to %u", (long long)m->n, UINT32_MAX / 2);
  if (m->single)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "dsmc.precision: between walls, and with start.wave, velocities are kept in double precision");
  if (m->time_step == 0 || m->time_step > 1)
    return gg_base_fail(err, GG_BAD_INPUT, "dsmc.time_step: in mean free times, above 0 and up to 1, or auto");
  return GG_OK;
}

double gg_dsmc_channel_bytes(const gg_model *m)
{
  const double grain = sizeof(gg_dsmc_channel_motion) + (m->rule != GG_SMOOTH ? sizeof(gg_vec) : 0) + 5;
  return (double)m->n * (2 * grain + 4);
}

void gg_dsmc_channel_describe(const gg_model *m, void (*line)(void *context, const char *text), void *context)
{
  char text[160];
  const double width = gg_dsmc_channel_cell_width(m);
  snprintf(text, sizeof text, "%lld grains across a gap of %.4g d, uniform along the walls", (long long)m->n,
           m->box[1]);
  line(context, text);
  snprintf(text, sizeof text, "cells %.2g d wide, %.0f across the gap", width, ceil(m->box[1] / width));
  line(context, text);
  line(context, gg_dsmc_rule_line(m->rule));
  if (m->law.name) line(context, "e follows from the speed of each collision");
  if (m->kicks) line(context, "kicks at every contact between grains");
  if (m->turns) line(context, "torques act along the flights");
  if (m->wave > 0) line(context, "periodic across the gap, where the gas starts with a transverse wave");
  line(context, m->boltzmann
                    ? "Boltzmann limit: partners in the same cell, no contact value, no collisional stress"
                    : "Enskog: partners at a distance, contact value of the local density, collisional stress");
  snprintf(text, sizeof text, "step: %.2g mean free times where grains collide%s; flights are exact",
           gg_dsmc_channel_free_times(m), m->time_step > 0 ? "" : ", chosen");
  line(context, text);
  line(context, "a majorant for each cell, or block of narrow cells, and pair of species");
  if (m->n >= GG_DSMC_CHANNEL_LEAST_SHARED) line(context, "threads share parts of the grains and slabs of cells");
}
