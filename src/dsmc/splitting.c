/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/splitting.h"

#include <math.h>

int gg_dsmc_sweeps_of(const gg_dsmc_time_step *step, gg_dsmc_splitting splitting, double dt)
{
  if (splitting != GG_DSMC_SYMMETRIC) return 1;
  const double times = ceil((1 - 1e-9) * dt / step->splitting);
  return 2 * (int)fmax(1, fmin(times, GG_DSMC_MAX_SWEEPS / 2));
}

int gg_dsmc_sweeps_of_part(const gg_dsmc_time_step *step, gg_dsmc_splitting splitting, double dt, int parts)
{
  const int both = splitting == GG_DSMC_SYMMETRIC ? 2 : 1, sweeps = gg_dsmc_sweeps_of(step, splitting, dt);
  return both * ((sweeps + both * parts - 1) / (both * parts));
}

double gg_dsmc_strains_to_hold(int n_species, double span)
{
  return n_species > 2 ? 2 * fabs(span) : 0;
}

int gg_dsmc_list_substeps(int pairs, gg_dsmc_splitting splitting, int sweeps,
                          gg_dsmc_substep substep[GG_DSMC_MAX_SUBSTEPS])
{
  int n = 0;
  for (int k = 0; k < sweeps; k++)
    for (int q = 0; q < pairs; q++) {
      const bool reverse = (splitting == GG_DSMC_BACKWARD) != (k % 2 == 1);
      const int pair = reverse ? pairs - 1 - q : q;
      if (n > 0 && substep[n - 1].pair == pair)
        substep[n - 1].length++;
      else
        substep[n++] = (gg_dsmc_substep){pair, k, 1};
    }
  return n;
}
