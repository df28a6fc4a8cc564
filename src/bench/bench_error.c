/* graingas bench error: how wrong a run of so many seconds is, and after how many seconds it is wrong by less. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bench/error_chart.h"
#include "bench/error_state.h"
#include "plot/plot.h"

static const char seconds_caption[] =
    "Uniform shear: seconds of processor time, one core, warm-up included, until the true error (root of the mean "
    "square over seeds, against the truth of the next table) is 1, 0.1 and 0.01 %, with the way that is quickest; "
    "never: its floors are above; ?: they are not known so well. Beyond the times that were run by noise falling as "
    "1/sqrt(time after the warm-up). kurtosis_Cx: the fourth moment. first: the engine that has it first at 1 %, and "
    "how many times sooner";
static const char floors_caption[] =
    "The truth, its relative error and where it is from; what the number of grains shifts a mean by, relative, times "
    "N (dsmc and md); a split step of h mean free times, times h^2, with the order that steps 1 and 0.5 give; and "
    "single precision against double, relative";

static const double targets[] = {0.01, 0.001, 0.0001};
enum { N_TARGETS = 3, MOST_STATES = 12, SINGLE = 8, DOUBLE = 6 };

static const char *name_of(int q)
{
  return gg_common_quantity_name(gg_bench_error_course_quantity[q]);
}

/* Smooth grains have no spins. */
static bool has(const gg_error_state *s, int q)
{
  return isfinite(s->unit[q]) && s->unit[q] > 0;
}

/* -1 where no way has it: *seconds is INFINITY where that is sure of all of them, else NaN. */
static int quickest(const gg_error_state *s, gg_engine_kind engine, int q, double error, double *seconds)
{
  int best = -1;
  bool unsure = false;
  *seconds = INFINITY;
  for (int i = 0; i < GG_WAYS; i++) {
    if (!s->done[i] || gg_bench_error_methods[i].engine != engine) continue;
    const double t = gg_bench_seconds_to(s, i, q, error);
    unsure |= isnan(t);
    if (t < *seconds) *seconds = t, best = i;
  }
  if (best < 0 && unsure) *seconds = NAN;
  return best;
}

static bool is_run(const gg_error_state *s, int engine)
{
  return engine == GG_DSMC || s->done[0];
}

static void put_first(gg_bench_sheet *sheet, int row, int column, const double first[2])
{
  const int one = first[GG_MD] < first[GG_DSMC] ? GG_MD : GG_DSMC;
  const char *name = one == GG_MD ? "md" : "dsmc";
  if (isfinite(first[0]) && isfinite(first[1]))
    gg_bench_sheet_put(sheet, row, column, "%s, %.2g x", name, first[1 - one] / first[one]);
  else
    gg_bench_sheet_put(sheet, row, column, "%s",
                       isnan(first[0]) || isnan(first[1]) ? "?"
                       : isfinite(first[one])             ? name
                                                          : "-");
}

static void put_seconds(gg_bench_sheet *sheet, int row, const gg_error_state *s, int q)
{
  double first[2] = {INFINITY, INFINITY};
  for (int engine = 0; engine < 2; engine++)
    for (int k = 0; k < N_TARGETS; k++) {
      double t;
      const int way = quickest(s, (gg_engine_kind)engine, q, targets[k], &t);
      const int column = 2 + engine * N_TARGETS + k;
      if (k == 0) first[engine] = t;
      if (way < 0)
        gg_bench_sheet_put(sheet, row, column, "%s", isnan(t) ? "?" : is_run(s, engine) ? "never" : "-");
      else
        gg_bench_sheet_put(sheet, row, column, "%.2g s, N %lld%s%s", t, (long long)gg_bench_error_methods[way].n,
                           gg_bench_error_methods[way].single     ? ", single"
                           : gg_bench_error_methods[way].step > 0 ? ", split"
                                                                  : "",
                           gg_bench_error_methods[way].replicas > 1 ? ", replicas" : "");
    }
  put_first(sheet, row, 2 + 2 * N_TARGETS, first);
}

static json_t *number(double x)
{
  return isfinite(x) ? json_real(x) : json_null();
}

static json_t *state_json(const gg_error_state *s, int q)
{
  return json_pack("{s:f, s:f, s:b, s:s}", "phi", s->phi, "e", s->e, "rough", s->rough, "quantity", name_of(q));
}

static void add_course(json_t *rows, const gg_error_state *s, int q, int i)
{
  const gg_course *c = &s->course[i];
  json_t *row = state_json(s, q), *t = json_array(), *error = json_array(), *uncertain = json_array();
  for (int k = 0; k < c->marks; k++) {
    double of_error, e = gg_bench_error_at(s, i, q, k, &of_error);
    json_array_append_new(t, number(c->seconds[k]));
    json_array_append_new(error, number(e));
    json_array_append_new(uncertain, number(of_error));
  }
  json_t *until = json_array();
  for (int k = 0; k < N_TARGETS; k++) json_array_append_new(until, number(gg_bench_seconds_to(s, i, q, targets[k])));
  json_object_set_new(row, "way", json_string(gg_bench_error_methods[i].name));
  json_object_set_new(row, "engine", json_string(gg_bench_error_methods[i].engine == GG_MD ? "md" : "dsmc"));
  json_object_set_new(row, "particles", json_integer((json_int_t)gg_bench_error_methods[i].n));
  json_object_set_new(row, "seeds", json_integer(c->seeds));
  json_object_set_new(row, "warmup_seconds", number(c->warmup));
  json_object_set_new(row, "error_of_a_second", number(s->noise[i][q]));
  json_object_set_new(row, "floor", number(s->floor[i][q]));
  json_object_set_new(row, "floor_stderr", number(s->shift_error[i][q]));
  json_object_set_new(row, "seconds", t);
  json_object_set_new(row, "relative_error", error);
  json_object_set_new(row, "stderr", uncertain);
  json_object_set_new(row, "seconds_to_0.01_0.001_0.0001", until);
  json_array_append_new(rows, row);
}

static void put_floors(gg_bench_sheet *sheet, int row, const gg_error_state *s, int q)
{
  const gg_by_size *md = &s->size[GG_MD][q], *dsmc = &s->size[GG_DSMC][q];
  const gg_course_end one = gg_bench_error_course_last(&s->course[DOUBLE], q),
                      two = gg_bench_error_course_last(&s->course[SINGLE], q);
  const double unit = s->unit[q], single = (two.mean - one.mean) / unit, e = hypot(one.error, two.error) / unit;
  gg_bench_sheet_put(sheet, row, 2, "%.6g", s->truth[GG_DSMC][q]);
  gg_bench_sheet_put(sheet, row, 3, "%.1e", s->truth_error[GG_DSMC][q] / unit);
  gg_bench_sheet_put(sheet, row, 4, "%s", s->source[GG_DSMC][q]);
  gg_bench_sheet_put(sheet, row, 5, "%+.2f +- %.2f", dsmc->per_grain / unit, dsmc->per_grain_error / unit);
  if (s->done[0]) gg_bench_sheet_put(sheet, row, 6, "%+.1f +- %.1f", md->per_grain / unit, md->per_grain_error / unit);
  gg_bench_sheet_put(sheet, row, 7, "%+.4f +- %.4f", s->step_coefficient[q], s->step_coefficient_error[q]);
  if (isfinite(s->step_order[q])) gg_bench_sheet_put(sheet, row, 8, "%.1f", s->step_order[q]);
  gg_bench_sheet_put(sheet, row, 9, "%+.1e +- %.0e", single, e);
  json_t *json = state_json(s, q);
  json_object_set_new(json, "truth", number(s->truth[GG_DSMC][q]));
  json_object_set_new(json, "truth_error", number(s->truth_error[GG_DSMC][q]));
  json_object_set_new(json, "source", json_string(s->source[GG_DSMC][q]));
  json_object_set_new(json, "dsmc_times_N",
                      json_pack("[o, o]", number(dsmc->per_grain / unit), number(dsmc->per_grain_error / unit)));
  json_object_set_new(json, "md_times_N",
                      json_pack("[o, o]", number(md->per_grain / unit), number(md->per_grain_error / unit)));
  json_object_set_new(json, "step",
                      json_pack("[o, o]", number(s->step_coefficient[q]), number(s->step_coefficient_error[q])));
  json_object_set_new(json, "step_order", number(s->step_order[q]));
  json_object_set_new(json, "single", json_pack("[o, o]", number(single), number(e)));
  json_array_append_new(sheet->rows, json);
}

static int row_of(gg_bench_sheet *sheet, const gg_error_state *s, int q)
{
  const int row = gg_bench_sheet_row(sheet);
  gg_bench_sheet_put(sheet, row, 0, "phi %g e %g %s", s->phi, s->e, s->rough ? "rough" : "smooth");
  gg_bench_sheet_put(sheet, row, 1, "%s", name_of(q));
  return row;
}

static void note(gg_bench_sheet *seconds, gg_bench_sheet *floors, const gg_error_state *s)
{
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    if (!has(s, q)) continue;
    put_seconds(seconds, row_of(seconds, s, q), s, q);
    put_floors(floors, row_of(floors, s, q), s, q);
    for (int i = 0; i < GG_WAYS; i++)
      if (s->done[i]) add_course(seconds->rows, s, q, i);
  }
}

static gg_status new_sheets(gg_bench *b, gg_bench_sheet *sheet[2], gg_error *err)
{
  static const char *const head[] = {"truth", "its error", "from", "1/N dsmc", "1/N md", "step h^2", "order", "single"};
  sheet[0] = gg_bench_new_sheet(b, "seconds", seconds_caption, 2, err);
  sheet[1] = gg_bench_new_sheet(b, "floors", floors_caption, 2, err);
  if (!sheet[0] || !sheet[1]) return GG_FAILED;
  for (int k = 0; k < 2; k++) {
    gg_bench_sheet_column(sheet[k], false, "shear");
    gg_bench_sheet_column(sheet[k], false, "quantity");
  }
  for (int engine = 0; engine < 2; engine++)
    for (int k = 0; k < N_TARGETS; k++)
      gg_bench_sheet_column(sheet[0], true, "%s %g %%", engine == GG_MD ? "md" : "dsmc", 100 * targets[k]);
  gg_bench_sheet_column(sheet[0], false, "first");
  for (int k = 0; k < 8; k++) gg_bench_sheet_column(sheet[1], k != 2, "%s", head[k]);
  return GG_OK;
}

/* Quick: the rough state of both densities above 0 at e = 0.9, and the smooth one at 0.01. */
static int list_states(gg_error_state *s, bool quick)
{
  static const double phi[] = {0, 0.01, 0.3}, e[] = {0.9, 0.7};
  int n = 0;
  for (int rough = 1; rough >= 0; rough--)
    for (int k = 0; k < 2; k++)
      for (int p = 0; p < 3; p++) {
        if (quick && (k == 1 || p == 0 || (!rough && p == 2))) continue;
        s[n].phi = phi[p], s[n].e = e[k], s[n++].rough = rough;
      }
  return n;
}

static gg_status measure(gg_bench *b, gg_error_state *s, gg_error *err)
{
  const bool quick = b->options->quick;
  const int n = list_states(s, quick);
  if (b->options->picture)
    GG_TRY(gg_plot_paper_check(b->options->picture, b->options->width, err)); /* before it has taken an hour */
  gg_bench_sheet *sheet[2];
  GG_TRY(new_sheets(b, sheet, err));
  for (int i = 0; i < n; i++) {
    GG_TRY(gg_bench_error_state_measure(b, &s[i], quick ? 4 : 6, gg_bench_seconds(b, quick ? 0.3 : 1.5), err));
    note(sheet[0], sheet[1], &s[i]);
    gg_bench_tell(b, "phi %g e %g %s done", s[i].phi, s[i].e, s[i].rough ? "rough" : "smooth");
  }
  b->measured = true;
  return b->options->picture ? gg_bench_error_chart_draw(s, n, b->options->picture, b->options->width, err) : GG_OK;
}

gg_status gg_bench_error(gg_bench *b, gg_error *err)
{
  gg_error_state *s = gg_base_array_new(MOST_STATES, sizeof *s, err);
  if (!s) return GG_FAILED;
  gg_status status = measure(b, s, err);
  free(s);
  return status;
}
