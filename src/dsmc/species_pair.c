/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constants of the collisions of a pair of species, and the sum of their results. */
#include "dsmc/dsmc.h"

gg_dsmc_features gg_dsmc_features_of(const gg_dsmc *d, int i, int j)
{
  const gg_model *m = &d->model;
  gg_dsmc_features features = {.rule = gg_model_pair_rule(m, gg_pair(i, j)), .same = i == j};
  /* With spins, even a smooth pair needs a kernel that moves spins together with velocities. */
  if (m->rule != GG_SMOOTH && features.rule == GG_SMOOTH) features.rule = GG_ROUGH;
  if (m->shear_rate != 0) features.shear = m->boltzmann ? GG_DSMC_SHEARED_DILUTE : GG_DSMC_SHEARED_DENSE;
  features.sums = m->boltzmann ? GG_DSMC_LOSS : GG_DSMC_STRESS;
  if (d->tables || m->kicks) features = gg_dsmc_features_of_own(features);
  return features;
}

gg_dsmc_pass gg_dsmc_pass_of(gg_dsmc *d, int i, int j)
{
  const gg_model *m = &d->model;
  int o = gg_pair(i, j);
  gg_dsmc_population *one = &d->ensemble.of[i], *two = &d->ensemble.of[j];
  return (gg_dsmc_pass){.one = one,
                        .two = two,
                        .blocks = {gg_dsmc_all_blocks(one), gg_dsmc_all_blocks(two)},
                        .contact = m->contact[i][j],
                        .species = {i, j},
                        .law = m->law.e ? &m->law : NULL,
                        .law_unit = ldexp(1, -d->now.power),
                        .bound_margin = 1,
                        .tables = d->tables,
                        .loss_scale = d->tables ? ldexp(d->tables->scale[o], -d->now.power) : 0,
                        .sigma = m->sigma[o],
                        .shift = m->boltzmann ? 0 : m->sigma[o] * m->shear_rate};
}

double gg_dsmc_cross_section(const gg_dsmc *d, int i, int j)
{
  const gg_model *m = &d->model;
  int o = gg_pair(i, j);
  return m->sigma[o] * m->sigma[o] * m->chi[o] / m->volume;
}

uint64_t gg_dsmc_window(const gg_dsmc *d, int i, int j)
{
  return 20000 + (uint64_t)(d->model.n_of[i] + d->model.n_of[j]) * 3;
}

void gg_dsmc_add_pass(gg_dsmc *d, int pair, const gg_dsmc_pass *pass)
{
  gg_dsmc_state *s = &d->now;
  s->collisions += pass->collisions;
  s->candidates += pass->tried;
  s->overflows += pass->overflows;
  s->clamped += pass->clamped;
  s->transfer.collisions[pair] += pass->collisions;
  s->lost += pass->loss;
  s->transfer.loss[pair] += pass->loss + pass->given;
  s->transfer.given[pair] += pass->given;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) s->transfer.stress[pair][a][b] += pass->stress[a][b];
}

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
