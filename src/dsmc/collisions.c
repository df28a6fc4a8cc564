/* The collision half of a step: how many candidates each pair of species gets, under which bound. */
#include "dsmc/dsmc.h"

void gg_dsmc_bounds(gg_dsmc *d)
{
  const gg_model *m = &d->model;
  double thermal = sqrt(d->now.temperature);
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) {
      double shift = m->sigma[2 * i + j] * m->shear_rate;
      double bound = gg_rate_bound(d->path[gg_pair_index(i, j)], gg_dsmc_features(d, i, j), 2 * d->now.fastest, shift);
      gg_majorant_start(&d->now.majorant[gg_pair_index(i, j)], bound, thermal);
    }
}

/* Candidates per unit time and unit of bound. */
static double candidate_rate(const gg_dsmc *d, gg_features f, int i, int j)
{
  const gg_population *one = &d->ensemble.of[i], *two = &d->ensemble.of[j];
  return gg_candidates(d->path[gg_pair_index(i, j)], f, one, two) * gg_dsmc_cross_section(d, i, j);
}

/* How many candidates, `mean` on average, without a trace of the step: as a Poisson process has them where they come
 * one by one; eight at a time their number would vary too much, and fractions are carried over instead. */
static uint64_t candidates(gg_dsmc *d, int pair, double mean, bool more)
{
  if (d->path[pair] == GG_PATH_PLAIN || more) return gg_rng_poisson(&d->now.rng, mean);
  double due = d->now.owed[pair] + mean, whole = floor(due);
  d->now.owed[pair] = due - whole;
  return (uint64_t)whole;
}

static void collide_pair(gg_dsmc *d, int i, int j, double dt, double drift, double span)
{
  gg_majorant *majorant = &d->now.majorant[gg_pair_index(i, j)];
  gg_path path = d->path[gg_pair_index(i, j)];
  gg_features f = gg_dsmc_features(d, i, j);
  double thermal = sqrt(d->now.temperature), rate = candidate_rate(d, f, i, j) * dt,
         top = gg_majorant_bound(majorant, thermal);
  /* A layer above the bound is added for as long as some candidate stood out of it. */
  for (double base = 0, bound = top; bound > 0;) {
    gg_pairing p = gg_dsmc_pairing(d, i, j);
    p.floor = base;
    p.bound = bound;
    p.candidates = candidates(d, gg_pair_index(i, j), rate * bound, base > 0);
    if (d->watching.watch) gg_dsmc_show_to_watcher(d, i, j, dt, &p);
    p.drift_step = p.candidates ? span / (double)p.candidates : 0;
    p.drift = drift + 0.5 * p.drift_step;
    gg_ensemble_drift_tops(&d->ensemble, drift);
    p.top_unit = d->ensemble.top_unit;
    gg_collide(d->ensemble.kernels, path, f, &p, &d->now.lanes, &d->now.rng);
    d->ensemble.top_unit = p.top_unit;
    d->ensemble.top_drift = drift + span;
    gg_dsmc_hand_over(d, gg_pair_index(i, j), &p);
    gg_majorant_learn(majorant, p.worst, thermal, p.tried, gg_dsmc_window(d, i, j));
    base += bound;
    if (p.worst <= base) break;
    bound = fmax(1.1 * p.worst, gg_rate_bound(path, f, 2 * d->now.fastest, p.shift)) - base;
  }
}

/* In segments, and of blocks enough that a segment of each species has a hundred. */
static bool in_rounds(const gg_dsmc *d)
{
  if (!d->tournament) return false;
  for (int i = 0; i < d->model.n_species; i++)
    for (int j = i; j < d->model.n_species; j++)
      if (d->path[gg_pair_index(i, j)] == GG_PATH_PLAIN) return false;
  for (int i = 0; i < d->model.n_species; i++)
    if (d->ensemble.of[i].n_blocks < 100 * (size_t)d->ensemble.segments) return false;
  return true;
}

void gg_dsmc_collide(gg_dsmc *d, double dt, double drift, double span, gg_order_of_turns order)
{
  if (in_rounds(d)) {
    gg_dsmc_collide_in_rounds(d, dt, drift, span, order);
    return;
  }
  gg_turn turn[GG_MOST_TURNS];
  const int sweeps = gg_sweeps_of(&d->now.step, order, dt);
  const int n = gg_list_turns(d->model.n_species == 1 ? 1 : GG_PAIRS, order, sweeps, turn);
  const double begin = d->stretch, each = 1.0 / sweeps;
  for (const gg_turn *t = turn; t < turn + n; t++) {
    const int *ij = gg_species_of_pair[t->pair];
    const double from = t->begin * each, part = t->length * each;
    d->stretch = begin + from * dt;
    collide_pair(d, ij[0], ij[1], part * dt, drift + from * span, part * span);
  }
  d->stretch = begin;
}
