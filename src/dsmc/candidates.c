/* How many candidates, and the majorants to start from. */
#include "dsmc/dsmc.h"

void gg_dsmc_start_majorants(gg_dsmc *d)
{
  const gg_model *m = &d->model;
  double thermal = sqrt(d->now.temperature);
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) {
      double shift = m->sigma[gg_pair(i, j)] * m->shear_rate;
      double sure =
          gg_dsmc_sure_majorant(d->path[gg_pair(i, j)], gg_dsmc_features_of(d, i, j), 2 * d->now.fastest, shift);
      gg_dsmc_majorant_start(&d->now.majorant[gg_pair(i, j)], sure, thermal);
    }
}

uint64_t gg_dsmc_candidates(bool one_by_one, double mean, double *remainder, gg_rng *rng)
{
  if (one_by_one) return gg_common_rng_poisson(rng, mean);
  double due = *remainder + mean, whole = floor(due);
  *remainder = due - whole;
  return (uint64_t)whole;
}
