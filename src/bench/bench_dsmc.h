/* The scenes of `graingas bench dsmc`, for its files. */
#ifndef GG_BENCH_DSMC_H
#define GG_BENCH_DSMC_H

#include "bench/scene_grid.h"

typedef enum gg_bench_dsmc_kind {
  GG_BENCH_DSMC_SMOOTH,
  GG_BENCH_DSMC_ROUGH,
  GG_BENCH_DSMC_FRICTIONAL,
  GG_BENCH_DSMC_TWO,
  GG_BENCH_DSMC_TWO_ROUGH,
  GG_BENCH_DSMC_SUMMED,
  GG_BENCH_DSMC_SHEARED,
  GG_BENCH_DSMC_SHEARED_SUMMED,
  GG_BENCH_DSMC_SHEARED_ROUGH,
  GG_BENCH_DSMC_SHEARED_FRICTIONAL,
  GG_BENCH_DSMC_SHEARED_TWO,
  GG_BENCH_DSMC_KINDS
} gg_bench_dsmc_kind;

/* dsmc_scenes.c */
extern const gg_bench_feature gg_bench_dsmc_features[GG_BENCH_DSMC_KINDS];

/* The scene of a kind, and the kind that it is compared with. */
gg_timed_scene gg_bench_dsmc_scene(const gg_bench *b, int kind, double phi, int64_t n);

/* dsmc_precision.c: a sheet of its own. */
gg_status gg_bench_dsmc_precision(gg_bench *b, gg_error *err);
/* dsmc_threads.c: sheets of its own. */
gg_status gg_bench_dsmc_paths(gg_bench *b, gg_error *err);
gg_status gg_bench_dsmc_threads(gg_bench *b, gg_error *err);

#endif
