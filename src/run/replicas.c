#include "run/replicas.h"

uint64_t gg_run_replicas_least(const gg_replicas *all)
{
  uint64_t least = all->state.due;
  for (int i = 0; i < all->n; i++)
    if (all->replica[i].clock.samples < least) least = all->replica[i].clock.samples;
  return least;
}

bool gg_run_replicas_are_level(const gg_replicas *all)
{
  return gg_run_replicas_least(all) == all->state.due;
}

static void level_bins(gg_replicas *all, int k)
{
  size_t per_block = 0;
  for (int i = 0; i < all->n; i++)
    if (all->replica[i].bins[k].per_block > per_block) per_block = all->replica[i].bins[k].per_block;
  for (int i = 0; i < all->n; i++)
    if (all->replica[i].bins[k].sum) gg_statistics_bins_coarsen(&all->replica[i].bins[k], per_block);
}

void gg_run_replicas_level(gg_replicas *all)
{
  size_t per_row = 0, rows = SIZE_MAX;
  for (int i = 0; i < all->n; i++) {
    const gg_replica *r = &all->replica[i];
    if (r->clock.samples < all->state.due) all->state.due = r->clock.samples;
    if (r->series.per_row > per_row) per_row = r->series.per_row;
  }
  for (int i = 0; i < all->n; i++) {
    gg_statistics_series_coarsen(&all->replica[i].series, per_row);
    if (all->replica[i].series.n < rows) rows = all->replica[i].series.n;
  }
  for (int i = 0; i < all->n; i++) all->replica[i].series.n = rows;
  for (int k = 0; k < all->replica[0].n_observables; k++) level_bins(all, k);
}
