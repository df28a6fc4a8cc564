/* graingas bench dsmc: what blocks gain over one pair after another, and threads over one. */
#include "bench/bench_dsmc.h"
#include "dsmc/dsmc.h"

static const char paths_caption[] =
    "What blocks gain: the rate of collisions over that of the plain loop (one random pair after another, under one "
    "majorant), one thread, CPU time, timed in turn; median (least - largest) of repeats, and nanoseconds per "
    "collision of both";
static const char threads_caption[] =
    "What threads gain within one ensemble: the rate of collisions over that of one thread, by the clock, timed in "
    "turn; median (least - largest) of repeats, and processors busy on average";

static const int64_t sizes[] = {10000, 100000, 1000000};
static const gg_bench_dsmc_kind path_scenes[] = {GG_BENCH_DSMC_SMOOTH, GG_BENCH_DSMC_ROUGH, GG_BENCH_DSMC_TWO,
                                                 GG_BENCH_DSMC_SHEARED_SUMMED};
static const gg_bench_dsmc_kind thread_scenes[] = {GG_BENCH_DSMC_SMOOTH, GG_BENCH_DSMC_ROUGH, GG_BENCH_DSMC_TWO,
                                                   GG_BENCH_DSMC_SHEARED_SUMMED, GG_BENCH_DSMC_SHEARED_TWO};
#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

static const double dense = 0.3;

static void take_plain_path(gg_engine *engine)
{
  gg_dsmc *d = (gg_dsmc *)engine;
  for (int p = 0; p < GG_PAIRS; p++) d->path[p] = GG_DSMC_PLAIN;
  gg_dsmc_start_majorants(d);
}

static gg_bench_sheet *new_sheet(gg_bench *b, const char *key, const char *caption, const gg_bench_dsmc_kind *kinds,
                                 int n, gg_error *err)
{
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, key, caption, 1, err);
  if (!sheet) return NULL;
  gg_bench_sheet_column(sheet, false, "scene, phi 0.3");
  for (int k = 0; k < n; k++)
    gg_bench_sheet_put(sheet, gg_bench_sheet_row(sheet), 0, "%s", gg_bench_dsmc_features[kinds[k]].name);
  return sheet;
}

static int column(gg_bench_sheet *sheet, int64_t n)
{
  return gg_bench_sheet_column(sheet, true, "N %lld", (long long)n);
}

static void note(gg_bench_sheet *sheet, gg_bench_dsmc_kind kind, int64_t n, int threads, const gg_timing r[2])
{
  json_array_append_new(sheet->rows,
                        json_pack("{s:s, s:f, s:I, s:i, s:f, s:f, s:f, s:f, s:f, s:f, s:s}", "scene",
                                  gg_bench_dsmc_features[kind].name, "phi", dense, "particles", (json_int_t)n,
                                  "threads", threads, "ratio", r[1].ratio, "least", r[1].lowest, "largest",
                                  r[1].highest, "processors", r[1].own.processors, "mean_of_one", 1e9 / r[0].own.rate,
                                  "mean", 1e9 / r[1].own.rate, "unit", "ns per collision"));
}

gg_status gg_bench_dsmc_paths(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  gg_bench_sheet *sheet = new_sheet(b, "paths", paths_caption, path_scenes, COUNT(path_scenes), err);
  if (!sheet) return GG_FAILED;
  for (int i = 0; i < (quick ? 1 : COUNT(sizes)); i++) {
    int at = column(sheet, sizes[i]);
    for (int k = 0; k < COUNT(path_scenes); k++) {
      gg_timed_scene c[2] = {gg_bench_dsmc_scene(b, path_scenes[k], dense, sizes[i])};
      gg_timing r[2];
      c[0].against = 0;
      c[1] = c[0];
      c[0].prepare = take_plain_path;
      GG_TRY(gg_bench_throughput_compare(c, 2, quick ? 3 : 5, quick ? 3 : 5, gg_bench_seconds(b, quick ? 0.1 : 0.5), r,
                                         err));
      gg_bench_sheet_put(sheet, k, at, "%.1f (%.1f - %.1f) %.0f/%.1f ns", r[1].ratio, r[1].lowest, r[1].highest,
                         1e9 / r[0].own.rate, 1e9 / r[1].own.rate);
      note(sheet, path_scenes[k], sizes[i], 1, r);
    }
    gg_bench_tell(b, "blocks against the plain loop, N %lld done", (long long)sizes[i]);
  }
  return GG_OK;
}

gg_status gg_bench_dsmc_threads(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  int threads = b->options->threads;
  if (threads < 2) {
    gg_bench_tell(b, "one processor: threads are left out");
    return GG_OK;
  }
  gg_bench_sheet *sheet = new_sheet(b, "threads", threads_caption, thread_scenes, COUNT(thread_scenes), err);
  if (!sheet) return GG_FAILED;
  for (int i = 1; i < (quick ? 2 : COUNT(sizes)); i++) {
    int at = column(sheet, sizes[i]);
    for (int k = 0; k < COUNT(thread_scenes); k++) {
      gg_timed_scene c[2] = {gg_bench_dsmc_scene(b, thread_scenes[k], dense, sizes[i])};
      gg_timing r[2];
      c[0].against = 0;
      c[0].by_the_clock = true;
      c[1] = c[0];
      c[1].threads = threads;
      GG_TRY(gg_bench_throughput_compare(c, 2, 5, quick ? 5 : 9, gg_bench_seconds(b, quick ? 0.1 : 0.4), r, err));
      gg_bench_sheet_put(sheet, k, at, "%.2f (%.2f - %.2f) %.2f of %d", r[1].ratio, r[1].lowest, r[1].highest,
                         r[1].own.processors, threads);
      note(sheet, thread_scenes[k], sizes[i], threads, r);
    }
    gg_bench_tell(b, "%d threads against one, N %lld done", threads, (long long)sizes[i]);
  }
  return GG_OK;
}
