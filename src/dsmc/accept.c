/* Which models the engine takes. */
#include "dsmc/dsmc.h"

gg_status gg_dsmc_accepts(const gg_model *m, gg_error *err)
{
  if (gg_flow_is_walled(m->flow))
    return gg_fail(err, GG_BAD_INPUT, "flow: walled flows need engine: md (Enskog Monte Carlo here is homogeneous)");
  if (m->gravity[0] != 0 || m->gravity[1] != 0 || m->gravity[2] != 0)
    return gg_fail(err, GG_BAD_INPUT, "gravity: must be 0 with engine: dsmc (a homogeneous gas falls freely)");
  if (m->thermostat != GG_NO_THERMOSTAT && m->flow != GG_HSS && m->flow != GG_USF)
    return gg_fail(err, GG_BAD_INPUT, "thermostat: only in flow: hss and usf");
  for (int i = 0; i < m->n_species; i++)
    if (m->n_of[i] < (m->n_species == 1 ? 2 : 1))
      return gg_fail(err, GG_BAD_INPUT, "dsmc.particles: at least 2 are needed, for collisions");
  if (m->n > UINT32_MAX / 2) return gg_fail(err, GG_BAD_INPUT, "dsmc.particles: at most %u", UINT32_MAX / 2);
  if (m->time_step == 0 || m->time_step > 10)
    return gg_fail(err, GG_BAD_INPUT, "dsmc.time_step: in mean free times, above 0 and up to 10, or auto");
  return GG_OK;
}
