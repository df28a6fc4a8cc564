/* graingas bench: both engines in a measuring run, by kernel, size and density. */
#include <math.h>

#include "bench/bench.h"
#include "bench/throughput.h"

static const char caption[] =
    "Collisions per CPU-second, one core; uniform shear, e = 0.9, stress measured; median of repeats";

/* What is timed: sheared at e = 0.9, its stress measured as in a run. */
static const struct {
  const char *name;
  double beta, mu;
} kernels[] = {{"smooth", -1, INFINITY}, {"rough", 0, INFINITY}, {"frictional", 0.4, 0.123}};
enum { N_KERNELS = sizeof kernels / sizeof *kernels };

static const double densities[] = {0.01, 0.3};
static const int64_t sizes[] = {1000, 10000, 100000};
enum { N_DENSITIES = 2, N_SIZES = 3 };

static gg_scene scene_of(const gg_bench *b, gg_engine_kind engine, int kernel, double phi, int64_t n)
{
  gg_scene s = gg_bench_scene(b, engine, phi, n);
  s.collision.beta[0] = kernels[kernel].beta;
  s.collision.mu[0] = kernels[kernel].mu;
  return s;
}

static void note(gg_bench_sheet *sheet, const char *engine, double phi, int64_t n, const gg_throughput t[N_KERNELS])
{
  int row = gg_bench_sheet_row(sheet);
  gg_bench_sheet_put(sheet, row, 0, "%s", engine);
  gg_bench_sheet_put(sheet, row, 1, "%g", phi);
  gg_bench_sheet_put(sheet, row, 2, "%lld", (long long)n);
  for (int k = 0; k < N_KERNELS; k++) {
    gg_bench_sheet_put(sheet, row, 3 + k, "%.3g M/s (%.0f ns)", t[k].rate * 1e-6, 1e9 / t[k].rate);
    json_array_append_new(sheet->rows,
                          json_pack("{s:s, s:f, s:I, s:s, s:f, s:f, s:f, s:s}", "engine", engine, "phi", phi,
                                    "particles", (json_int_t)n, "kernel", kernels[k].name, "mean", t[k].rate, "slowest",
                                    t[k].slowest, "fastest", t[k].fastest, "unit", "collisions per CPU-second"));
  }
}

static gg_status measure(gg_bench *b, gg_bench_sheet *sheet, gg_engine_kind engine, gg_error *err)
{
  bool quick = b->options->quick;
  const char *name = gg_run_engine_ops_of(engine)->name;
  for (int d = 0; d < N_DENSITIES; d++)
    for (int i = 0; i < (quick ? N_SIZES - 1 : N_SIZES); i++) {
      gg_throughput t[N_KERNELS];
      for (int k = 0; k < N_KERNELS; k++) {
        gg_scene s = scene_of(b, engine, k, densities[d], sizes[i]);
        GG_TRY(gg_bench_throughput_measure(&s, true, 20, quick ? 3 : 5, gg_bench_seconds(b, quick ? 0.2 : 0.6), &t[k],
                                           err));
      }
      note(sheet, name, densities[d], sizes[i], t);
      gg_bench_tell(b, "%s phi %g N %lld done", name, densities[d], (long long)sizes[i]);
    }
  return GG_OK;
}

gg_status gg_bench_overview(gg_bench *b, gg_error *err)
{
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "throughput", caption, 3, err);
  if (!sheet) return GG_FAILED;
  gg_bench_sheet_column(sheet, false, "engine");
  gg_bench_sheet_column(sheet, true, "phi");
  gg_bench_sheet_column(sheet, true, "N");
  for (int k = 0; k < N_KERNELS; k++) gg_bench_sheet_column(sheet, true, "%s", kernels[k].name);
  GG_TRY(measure(b, sheet, GG_MD, err));
  return measure(b, sheet, GG_DSMC, err);
}
