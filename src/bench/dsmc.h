/* The scenes of `graingas bench dsmc`, for its files. */
#ifndef GG_CLI_BENCH_DSMC_H
#define GG_CLI_BENCH_DSMC_H

#include "bench/bench.h"

typedef enum gg_dsmc_kind {
  GG_DSMC_SMOOTH,
  GG_DSMC_ROUGH,
  GG_DSMC_FRICTIONAL,
  GG_DSMC_TWO,
  GG_DSMC_TWO_ROUGH,
  GG_DSMC_TAPPED,
  GG_DSMC_SHEARED,
  GG_DSMC_SHEARED_TAPPED,
  GG_DSMC_SHEARED_ROUGH,
  GG_DSMC_SHEARED_FRICTIONAL,
  GG_DSMC_SHEARED_TWO,
  GG_DSMC_KINDS
} gg_dsmc_kind;

/* bench_dsmc_scenes.c */
extern const gg_bench_feature gg_dsmc_features_timed[GG_DSMC_KINDS];

/* The scene of a gg_dsmc_kind. */
gg_contender gg_bench_dsmc_contender(const gg_bench *b, int kind, double phi, int64_t n);

/* bench_dsmc_precision.c: a sheet of its own. */
gg_status gg_bench_dsmc_precision(gg_bench *b, gg_error *err);
/* bench_dsmc_threads.c: sheets of its own. */
gg_status gg_bench_dsmc_paths(gg_bench *b, gg_error *err);
gg_status gg_bench_dsmc_threads(gg_bench *b, gg_error *err);

#endif
