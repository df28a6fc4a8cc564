#include "run/result.h"

int gg_headline(const gg_model *m, gg_quantity list[GG_N_QUANTITIES])
{
  int n = 0;
  bool rough = m->rule != GG_SMOOTH;
  if (m->linear_response) {
    list[n++] = GG_Q_VISCOSITY_REDUCED;
    return n;
  }
  switch (m->flow) {
  case GG_EQUILIBRIUM:
    list[n++] = GG_Q_PRESSURE;
    list[n++] = GG_Q_COLLISION_RATE;
    break;
  case GG_HCS:
  case GG_HSS:
    if (!m->elastic && !(m->flow == GG_HSS && rough)) list[n++] = GG_Q_COOLING_RATE;
    if (rough) list[n++] = GG_Q_TEMPERATURE_RATIO;
    if (m->n_species > 1) list[n++] = GG_Q_PARTIAL_TEMPERATURE_RATIO;
    break;
  default:
    list[n++] = GG_Q_TEMPERATURE;
    list[n++] = GG_Q_PRESSURE;
    if (gg_flow_is_sheared(m->flow)) list[n++] = GG_Q_SHEAR_VISCOSITY;
    if (rough) list[n++] = GG_Q_TEMPERATURE_RATIO;
  }
  return n;
}
