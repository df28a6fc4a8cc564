#include "dsmc/kernel/kernels.h"

#include "dsmc/kernel/collide_blocks.h"
#include "dsmc/kernel/sweep.h"
#include "dsmc/parallel/segments.h"
#include "simd/dispatch.h"

static const struct {
  const char *name;
  gg_collide_blocks *(*kernel[2])(gg_features f); /* double, single */
} paths[GG_PATHS] = {
    [GG_PATH_PLAIN] = {"plain", {NULL}},
#ifdef GG_HAVE_BASELINE
    [GG_PATH_BASELINE] = {"blocks", {gg_collide_blocks_baseline, gg_collide_blocks_single_baseline}},
#endif
#ifdef GG_HAVE_AVX2
    [GG_PATH_AVX2] = {"blocks, AVX2", {gg_collide_blocks_avx2, gg_collide_blocks_single_avx2}},
#endif
#ifdef GG_HAVE_AVX512
    [GG_PATH_AVX512] = {"blocks, AVX-512", {gg_collide_blocks_avx512, gg_collide_blocks_single_avx512}},
#endif
};

bool gg_path_runs_here(gg_path path)
{
  return path == GG_PATH_PLAIN || gg_instructions_run_here((gg_instructions)(path - GG_PATH_BASELINE));
}

void gg_sweep_blocks(void *c, bool single, float *top, size_t n, double drift, double scale, gg_vec centre, double unit,
                     gg_sums *sums)
{
  gg_sweep *sweep = NULL;
#ifdef GG_HAVE_BASELINE
  sweep = single ? gg_sweep_single_baseline : gg_sweep_baseline;
#endif
#ifdef GG_HAVE_AVX2
  if (gg_path_runs_here(GG_PATH_AVX2)) sweep = single ? gg_sweep_single_avx2 : gg_sweep_avx2;
#endif
#ifdef GG_HAVE_AVX512
  if (gg_path_runs_here(GG_PATH_AVX512)) sweep = single ? gg_sweep_single_avx512 : gg_sweep_avx512;
#endif
  sweep(c, top, n, drift, scale, centre, unit, sums);
}

void gg_kick_blocks(void *c, bool single, float *top, size_t n, double drift, double size, double unit,
                    gg_rng_lanes *lanes)
{
  gg_kicks *kicks = NULL;
#ifdef GG_HAVE_BASELINE
  kicks = gg_kicks_baseline;
#endif
#ifdef GG_HAVE_AVX2
  if (gg_path_runs_here(GG_PATH_AVX2)) kicks = gg_kicks_avx2;
#endif
#ifdef GG_HAVE_AVX512
  if (gg_path_runs_here(GG_PATH_AVX512)) kicks = gg_kicks_avx512;
#endif
  kicks(c, single, top, n, drift, size, unit, lanes);
}

gg_path gg_path_choose(const gg_population *one, const gg_population *two)
{
  if (one->n_blocks < 100 || two->n_blocks < 100) return GG_PATH_PLAIN;
  gg_path path = GG_PATHS - 1;
  while (!gg_path_runs_here(path)) path--;
  return path;
}

double gg_candidates(gg_path path, gg_features f, const gg_population *one, const gg_population *two)
{
  if (path == GG_PATH_PLAIN) {
    double n = (double)one->n, pairs = f.same ? 0.5 * n * (n - 1) : n * (double)two->n;
    return 4 * M_PI * pairs;
  }
  return gg_block_candidates(gg_all_blocks(one), gg_all_blocks(two), f.same);
}

/* A draw of two blocks gives each of the pairs between them 1/8; among themselves they come in either order. */
double gg_block_candidates(gg_range one, gg_range two, bool themselves)
{
  return M_PI * 8 * (themselves ? 0.5 : 1) * ((double)one.n * (double)two.n);
}

double gg_rate_bound(gg_path path, gg_features f, double speed, double shift)
{
  if (f.shear != GG_SHEARED_DENSE) return speed;
  return speed + (path == GG_PATH_PLAIN ? 0.5 : GG_SHEAR_SHARE) * shift; /* |k_x k_y| <= 1/2 */
}

void gg_collide(gg_path path, gg_features f, gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng)
{
  if (path == GG_PATH_PLAIN)
    gg_collide_plain(f, p, rng);
  else
    paths[path].kernel[p->one->single](f)(p, lanes, rng);
}
