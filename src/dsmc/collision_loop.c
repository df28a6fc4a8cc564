/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions of a step: candidates for each pair of species, under its majorant. */
#include "dsmc/dsmc.h"

/* Candidates per unit time and unit of the majorant. */
static double candidate_rate(const gg_dsmc *d, gg_dsmc_features features, int i, int j)
{
  const gg_dsmc_population *one = &d->ensemble.of[i], *two = &d->ensemble.of[j];
  return gg_dsmc_candidates_per_unit(d->path[gg_pair(i, j)], features, one, two) * gg_dsmc_cross_section(d, i, j);
}

/* Prepare a pass for the callback: its candidates are distributed over `dt` from d->interval_begin. */
static void call_back(gg_dsmc *d, int i, int j, double dt, gg_dsmc_pass *pass)
{
  pass->callback = &d->callback;
  pass->species[0] = i;
  pass->species[1] = j;
  pass->time_step = pass->candidates ? dt / (double)pass->candidates : 0;
  pass->time = d->interval_begin + 0.5 * pass->time_step;
}

/* Collisions of one pair of species. `hold`: range of strains from `strain` on, in the direction of `span`, over which
 * the speed bounds must hold; 0: their scale follows the strain. */
static void collide_pair(gg_dsmc *d, int i, int j, double dt, double strain, double span, double hold)
{
  gg_dsmc_majorant *learned = &d->now.majorant[gg_pair(i, j)];
  gg_dsmc_path path = d->path[gg_pair(i, j)];
  gg_dsmc_features features = gg_dsmc_features_of(d, i, j);
  double thermal = sqrt(d->now.temperature), rate = candidate_rate(d, features, i, j) * dt,
         majorant = gg_dsmc_majorant_at(learned, thermal);
  /* After a majorant overflow: correction passes, each over the layer above. */
  for (double floor = 0; majorant > 0;) {
    gg_dsmc_pass pass = gg_dsmc_pass_of(d, i, j);
    pass.floor = floor;
    pass.majorant = majorant;
    pass.candidates = gg_dsmc_candidates(path == GG_DSMC_PLAIN || floor > 0, rate * majorant,
                                         &d->now.remainder[gg_pair(i, j)], &d->now.rng);
    if (d->callback.call) call_back(d, i, j, dt, &pass);
    pass.strain_step = pass.candidates ? span / (double)pass.candidates : 0;
    pass.strain = strain + 0.5 * pass.strain_step;
    gg_dsmc_ensemble_strain_bounds(&d->ensemble, span < 0 ? strain - hold : strain, hold);
    pass.bound_scale = d->ensemble.bound_scale;
    if (hold > 0) pass.bound_margin = gg_dsmc_bound_growth(hold);
    gg_dsmc_collide_pass(d->ensemble.kernels, path, features, &pass, &d->now.lanes, &d->now.rng);
    d->ensemble.bound_scale = pass.bound_scale;
    if (!(hold > 0)) d->ensemble.bound_strain = strain + span;
    gg_dsmc_add_pass(d, gg_pair(i, j), &pass);
    gg_dsmc_majorant_learn(learned, pass.largest, thermal, pass.tried, gg_dsmc_window(d, i, j));
    floor += majorant;
    if (pass.largest <= floor) break;
    majorant = fmax(1.1 * pass.largest, gg_dsmc_sure_majorant(path, features, 2 * d->now.fastest, pass.shift)) - floor;
  }
}

/* True if the ensemble collides in segments. Each species needs about a hundred blocks in a segment, and more if there
 * are many species, since substeps are shorter with more pairs of species. */
static bool uses_segments(const gg_dsmc *d)
{
  if (!d->schedule) return false;
  for (int i = 0; i < d->model.n_species; i++)
    for (int j = i; j < d->model.n_species; j++)
      if (d->path[gg_pair(i, j)] == GG_DSMC_PLAIN) return false;
  const int species = d->model.n_species > 2 ? d->model.n_species : 2;
  for (int i = 0; i < d->model.n_species; i++)
    if (d->ensemble.of[i].n_blocks < (size_t)(50 * species * d->ensemble.segments)) return false;
  return true;
}

void gg_dsmc_collide(gg_dsmc *d, double dt, double strain, double span, gg_dsmc_splitting splitting)
{
  if (uses_segments(d)) {
    gg_dsmc_collide_segments(d, dt, strain, span, splitting);
    return;
  }
  gg_dsmc_substep substep[GG_DSMC_MAX_SUBSTEPS];
  const int sweeps = gg_dsmc_sweeps_of(&d->now.step, splitting, dt);
  const int n = gg_dsmc_list_substeps(gg_pairs_of(d->model.n_species), splitting, sweeps, substep);
  const double begin = d->interval_begin, each = 1.0 / sweeps;
  const double hold = gg_dsmc_strains_to_hold(d->model.n_species, each * span);
  for (const gg_dsmc_substep *t = substep; t < substep + n; t++) {
    const gg_species_pair s = gg_common_pair_species(t->pair);
    const double from = t->begin * each, part = t->length * each;
    d->interval_begin = begin + from * dt;
    collide_pair(d, s.i, s.j, part * dt, strain + from * span, part * span, hold);
  }
  d->interval_begin = begin;
}
