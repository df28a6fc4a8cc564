/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models that the engine runs. */
#include "dsmc/dsmc.h"

gg_status gg_dsmc_accepts(const gg_model *m, gg_error *err)
{
  if (!gg_flow_runs_in(m->flow, GG_DSMC))
    return gg_base_fail(err, GG_BAD_INPUT, "flow: %s needs engine: md", gg_flow_of(m->flow)->word);
  if (m->gravity[0] != 0 || m->gravity[1] != 0 || m->gravity[2] != 0)
    return gg_base_fail(err, GG_BAD_INPUT, "gravity: must be 0 with engine: dsmc (a homogeneous gas falls freely)");
  if (m->thermostat != GG_NO_THERMOSTAT && !gg_flow_takes(m->flow, m->thermostat))
    return gg_base_fail(err, GG_BAD_INPUT, "thermostat: not this one in flow: %s", gg_flow_of(m->flow)->word);
  for (int i = 0; i < m->n_species; i++)
    if (m->n_of[i] < (m->n_species == 1 ? 2 : 1))
      return gg_base_fail(err, GG_BAD_INPUT, "dsmc.particles: at least 2 are needed, for collisions");
#ifdef GG_DOUBLE_ALONE
  if (m->single)
    return gg_base_fail(err, GG_BAD_INPUT, "dsmc.precision: this build of graingas has double precision only");
#endif
  if (m->n > UINT32_MAX / 2) return gg_base_fail(err, GG_BAD_INPUT, "dsmc.particles: at most %u", UINT32_MAX / 2);
  if (m->time_step == 0 || m->time_step > 10)
    return gg_base_fail(err, GG_BAD_INPUT, "dsmc.time_step: in mean free times, above 0 and up to 10, or auto");
  return GG_OK;
}
