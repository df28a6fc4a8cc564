/* Sheets that both engines' benches have: rates by size and density, and what features cost by density. */
#include "bench/scene_grid.h"

gg_status gg_bench_rates(gg_bench *b, gg_bench_sheet *sheet, const gg_bench_grid *grid, const int64_t *sizes,
                         int n_sizes, gg_bench_note_rate *note, gg_error *err)
{
  bool quick = b->options->quick;
  gg_bench_sheet_column(sheet, true, "N");
  for (int d = 0; d < grid->n_densities; d++) gg_bench_sheet_column(sheet, true, "phi %.4g", grid->densities[d]);
  for (int i = 0; i < n_sizes; i++) {
    int row = gg_bench_sheet_row(sheet);
    gg_bench_sheet_put(sheet, row, 0, "%lld", (long long)sizes[i]);
    for (int d = 0; d < grid->n_densities; d++) {
      gg_throughput t;
      gg_scene s = grid->scene(b, 0, grid->densities[d], sizes[i]).scene;
      GG_TRY(gg_bench_throughput_measure(&s, false, grid->warmup(sizes[i], quick), quick ? 3 : 7,
                                         gg_bench_seconds(b, quick ? 0.3 : 1), &t, err));
      note(sheet, row, 1 + d, grid->densities[d], sizes[i], &t);
      gg_bench_tell(b, "phi %g N %lld: %.3g M/s", grid->densities[d], (long long)sizes[i], t.rate * 1e-6);
    }
  }
  return GG_OK;
}

static gg_bench_sheet *start_ratios(gg_bench *b, const char *caption, const gg_bench_feature *features, int n,
                                    gg_error *err)
{
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "ratios", caption, 2, err);
  if (!sheet) return NULL;
  gg_bench_sheet_column(sheet, false, "scene");
  gg_bench_sheet_column(sheet, false, "against");
  for (int k = 0; k < n; k++) {
    int row = gg_bench_sheet_row(sheet);
    gg_bench_sheet_put(sheet, row, 0, "%s", features[k].name);
    if (features[k].against != k) gg_bench_sheet_put(sheet, row, 1, "%s", features[features[k].against].name);
  }
  return sheet;
}

gg_status gg_bench_ratios(gg_bench *b, const char *caption, const gg_bench_grid *grid, const gg_bench_feature *features,
                          int n_features, int64_t n, double seconds, gg_bench_note_ratio *note, gg_error *err)
{
  bool quick = b->options->quick;
  gg_bench_sheet *sheet = start_ratios(b, caption, features, n_features, err);
  if (!sheet) return GG_FAILED;
  for (int d = 0; d < grid->n_densities; d++) {
    double phi = grid->densities[d];
    int column = gg_bench_sheet_column(sheet, true, "phi %.4g", phi);
    gg_timed_scene c[GG_MOST_TIMED];
    gg_timing r[GG_MOST_TIMED];
    for (int k = 0; k < n_features; k++) c[k] = grid->scene(b, k, phi, n);
    GG_TRY(gg_bench_throughput_compare(c, n_features, grid->warmup(n, quick), quick ? 5 : 9,
                                       gg_bench_seconds(b, quick ? 0.1 : seconds), r, err));
    for (int k = 0; k < n_features; k++) note(sheet, column, phi, n, k, &r[k]);
    gg_bench_tell(b, "ratios at phi %g N %lld done", phi, (long long)n);
  }
  return GG_OK;
}
