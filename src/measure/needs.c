#include "measure/needs.h"

const char *gg_measure_needs_positions(const gg_model *m)
{
  return m->homogeneous ? "the Monte Carlo ensemble has no positions" : NULL;
}

const char *gg_measure_needs_homogeneity(const gg_model *m)
{
  return gg_flow_is_walled(m->flow) ? "between walls the gas depends on the place; measure profiles" : NULL;
}

const char *gg_measure_needs_bulk(const gg_model *m)
{
  const char *reason = gg_measure_needs_positions(m);
  return reason ? reason : gg_measure_needs_homogeneity(m);
}
