/* The scenes of `graingas bench dsmc`: one feature at a time. */
#include <math.h>

#include "bench/bench_dsmc.h"

const gg_bench_feature gg_bench_dsmc_features[GG_BENCH_DSMC_KINDS] = {
    [GG_BENCH_DSMC_SMOOTH] = {"smooth", GG_BENCH_DSMC_SMOOTH},
    [GG_BENCH_DSMC_ROUGH] = {"rough", GG_BENCH_DSMC_SMOOTH},
    [GG_BENCH_DSMC_FRICTIONAL] = {"frictional", GG_BENCH_DSMC_ROUGH},
    [GG_BENCH_DSMC_TWO] = {"two species", GG_BENCH_DSMC_SMOOTH},
    [GG_BENCH_DSMC_TWO_ROUGH] = {"two species, rough", GG_BENCH_DSMC_ROUGH},
    [GG_BENCH_DSMC_SUMMED] = {"smooth, stress measured", GG_BENCH_DSMC_SMOOTH},
    [GG_BENCH_DSMC_SHEARED] = {"sheared smooth", GG_BENCH_DSMC_SMOOTH},
    [GG_BENCH_DSMC_SHEARED_SUMMED] = {"sheared smooth, stress measured", GG_BENCH_DSMC_SHEARED},
    [GG_BENCH_DSMC_SHEARED_ROUGH] = {"sheared rough, stress measured", GG_BENCH_DSMC_SHEARED_SUMMED},
    [GG_BENCH_DSMC_SHEARED_FRICTIONAL] = {"sheared frictional, stress measured", GG_BENCH_DSMC_SHEARED_ROUGH},
    [GG_BENCH_DSMC_SHEARED_TWO] = {"sheared, two species, stress measured", GG_BENCH_DSMC_SHEARED_SUMMED},
};

gg_timed_scene gg_bench_dsmc_scene(const gg_bench *b, int kind, double phi, int64_t n)
{
  const bool sheared = kind >= GG_BENCH_DSMC_SHEARED;
  gg_timed_scene c = {.scene = gg_bench_scene(b, GG_DSMC, phi, n),
                      .sums = kind == GG_BENCH_DSMC_SUMMED || kind > GG_BENCH_DSMC_SHEARED};
  gg_scene *s = &c.scene;
  c.against = gg_bench_dsmc_features[kind].against;
  s->flow = sheared ? GG_USF : GG_EQUILIBRIUM;
  const bool rough =
      kind == GG_BENCH_DSMC_ROUGH || kind == GG_BENCH_DSMC_TWO_ROUGH || kind == GG_BENCH_DSMC_SHEARED_ROUGH;
  const bool frictional = kind == GG_BENCH_DSMC_FRICTIONAL || kind == GG_BENCH_DSMC_SHEARED_FRICTIONAL;
  for (int p = 0; p < GG_PAIRS; p++) {
    s->collision.e[p] = sheared ? 0.9 : 1;
    s->collision.beta[p] = rough ? sheared ? 0 : 1 : frictional ? 0.4 : -1;
    s->collision.mu[p] = frictional ? 0.123 : INFINITY;
  }
  if (kind != GG_BENCH_DSMC_TWO && kind != GG_BENCH_DSMC_TWO_ROUGH && kind != GG_BENCH_DSMC_SHEARED_TWO) return c;
  s->n_species = 2;
  s->species[0].fraction = 0.5;
  s->species[1] = (gg_species){0.5, 1, 4, 0.4};
  return c;
}
