/* graingas bench dsmc: what single precision gains, by kernel and size. */
#include "bench/bench_dsmc.h"

static const char caption[] =
    "Single precision: nanoseconds per accepted collision in double/in single precision, and the ratio of the rates, "
    "timed in turn; CPU time, one thread, phi 0.3; median (least - largest) of repeats";

static const int64_t sizes[] = {10000, 100000, 1000000};
/* Not what cools: with nothing to scale it back it would leave the range of single precision. */
static const gg_bench_dsmc_kind timed[] = {
    GG_BENCH_DSMC_SMOOTH,         GG_BENCH_DSMC_ROUGH,         GG_BENCH_DSMC_TWO,
    GG_BENCH_DSMC_TWO_ROUGH,      GG_BENCH_DSMC_SUMMED,        GG_BENCH_DSMC_SHEARED,
    GG_BENCH_DSMC_SHEARED_SUMMED, GG_BENCH_DSMC_SHEARED_ROUGH, GG_BENCH_DSMC_SHEARED_FRICTIONAL,
    GG_BENCH_DSMC_SHEARED_TWO};
enum { N_SIZES = 3, N_TIMED = sizeof timed / sizeof *timed };

static void note(gg_bench_sheet *sheet, int row, int column, int64_t n, const gg_timing r[2])
{
  gg_bench_sheet_put(sheet, row, column, "%.1f/%.1f ns %.2f (%.2f - %.2f)", 1e9 / r[0].own.rate, 1e9 / r[1].own.rate,
                     r[1].ratio, r[1].lowest, r[1].highest);
  json_array_append_new(sheet->rows,
                        json_pack("{s:s, s:f, s:I, s:f, s:f, s:f, s:f, s:f, s:s}", "scene",
                                  gg_bench_dsmc_features[timed[row]].name, "phi", 0.3, "particles", (json_int_t)n,
                                  "double", 1e9 / r[0].own.rate, "single", 1e9 / r[1].own.rate, "ratio", r[1].ratio,
                                  "least", r[1].lowest, "largest", r[1].highest, "unit", "ns per collision"));
}

gg_status gg_bench_dsmc_precision(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "precision", caption, 1, err);
  if (!sheet) return GG_FAILED;
  gg_bench_sheet_column(sheet, false, "scene, phi 0.3");
  for (int k = 0; k < N_TIMED; k++)
    gg_bench_sheet_put(sheet, gg_bench_sheet_row(sheet), 0, "%s", gg_bench_dsmc_features[timed[k]].name);
  for (int i = 0; i < (quick ? 1 : N_SIZES); i++) {
    int column = gg_bench_sheet_column(sheet, true, "N %lld", (long long)sizes[i]);
    for (int k = 0; k < N_TIMED; k++) {
      gg_timed_scene c[2];
      gg_timing r[2];
      c[0] = c[1] = gg_bench_dsmc_scene(b, timed[k], 0.3, sizes[i]);
      c[0].against = c[1].against = 0;
      c[1].scene.dsmc.precision = GG_SINGLE;
      GG_TRY(gg_bench_throughput_compare(c, 2, quick ? 3 : 10, quick ? 3 : 5, gg_bench_seconds(b, quick ? 0.05 : 0.3),
                                         r, err));
      note(sheet, k, column, sizes[i], r);
    }
    gg_bench_tell(b, "single precision, N %lld done", (long long)sizes[i]);
  }
  return GG_OK;
}
