/* Which models the engine takes, and what it makes of them. */
#include <stdio.h>

#include "common/thermostat.h"
#include "dsmc/dsmc.h"
#include "dsmc/thermostat.h"

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

void gg_dsmc_describe(const gg_model *m, void (*line)(void *context, const char *text), void *context)
{
  static const char *const rules[] = {"smooth grains: no spins are kept", "rough grains: spins, constant beta",
                                      "frictional grains: spins, Coulomb's law"};
  char text[160];
  snprintf(text, sizeof text, "%lld velocities in blocks of %d, in %s precision", (long long)m->n, GG_LANES,
           m->single ? "single" : "double");
  line(context, text);
  size_t blocks = 0;
  for (int i = 0; i < m->n_species; i++) blocks += ((size_t)m->n_of[i] + GG_LANES - 1) / GG_LANES;
  int segments = gg_segments_of(blocks);
  snprintf(text, sizeof text, "in %d segments, which threads share", segments);
  line(context, segments > 1 ? text : "not enough for threads to share");
  line(context, rules[m->rule]);
  line(context, m->boltzmann ? "Boltzmann limit: no contact value, no collisional stress, nothing of them computed"
                             : "Enskog: contact value and collisional stress");
  if (m->shear_rate == 0)
    line(context, "no shear: no streaming");
  else if (m->time_step > 0)
    line(context, "shear: streaming and collisions in turns, symmetric splitting");
  else
    line(context, "shear: streaming followed exactly between collisions");
  static const char *const thermostats[] = {"no thermostat", "Gaussian thermostat: returns what collisions destroy",
                                            "white-noise thermostat"};
  line(context, thermostats[gg_thermostat_of(m)]);
  line(context, m->n_species == 1 ? "one species: one majorant" : "two species: a majorant for each pair");
}
